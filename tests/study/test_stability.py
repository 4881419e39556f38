"""Where methods fail: how fast is as theory tells, and nothing that graphkin gives is wrong without saying so."""

from __future__ import annotations

import csv
import math
import re
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from graphkin.api.studied import Stability
from graphkin.errors import CallError
from graphkin.study.equations import _eliminated
from graphkin.study.error_laws import (
    ErrorLaw,
    Singularity,
    in_powers,
    laws_table,
    lessons,
    stability_pages,
    to_json,
)
from graphkin.study.singular_positions import KINDS, run_singularities
from graphkin.words import Phrase, gaps_of, say
from tests.drawing.chart_words import off_the_page, overlapping

SLOPE = 0.15
MEANINGFUL = 0.05  # an error beyond this is no answer


@cache
def singularity(kind: str) -> Singularity:
    return run_singularities([kind], samples=1)[0]


LAWS = [
    *[(f"dead point {kind}", law) for kind in ("RRR", "RRP", "RPR") for law in (
        "place closed form", "velocity closed form", "acceleration closed form", "velocity Newton",
        "all from the dead point", "velocity exact drawing", "velocity pencil",
    )],
    ("crossing height", "height by squares"), ("crossing height", "height by Heron"),
    ("angle near zero", "angle by arccos"), ("angle near zero", "angle by atan2"),
    ("differences", "velocity complex step"),
    ("parallel lines", "centre place"), ("parallel lines", "centre velocity"),
    ("parallel lines", "centre place pencil"), ("parallel lines", "centre velocity pencil"),
    ("near ground", "place bar"), ("near ground", "acceleration Coriolis"), ("near ground", "acceleration bar"),
    ("guide flip", "place bar"), ("guide flip", "acceleration Coriolis"), ("guide flip", "acceleration bar"),
    ("guide flip", "acceleration bar drawn"),
    ("slow sliding", "velocity sliding"), ("slow sliding", "velocity bar"),
    ("slow sliding", "velocity sliding pencil"), ("slow sliding", "velocity bar pencil"),
    ("small scale", "pencil points"),
]


def test_the_reference_solves_systems_of_any_numbers_with_the_largest_pivots_first() -> None:
    solution = np.array([Fraction(5, 3), Fraction(-1, 7), Fraction(2)], dtype=object)
    matrix = np.array([[0, 2, 1], [3, 0, 0], [5, 1, 0]], dtype=object) * Fraction(1)
    assert solution.tolist() == _eliminated(matrix, matrix @ solution).tolist()
    floats = _eliminated(np.array([[1e-60, 1.0], [1.0, 1.0]], dtype=object), np.array([1.0, 2.0], dtype=object))
    assert [1.0, 1.0] == floats.tolist()


@pytest.mark.parametrize(("kind", "law"), LAWS)
def test_an_error_grows_as_theory_tells(kind: str, law: str) -> None:
    found = singularity(kind)[law]
    assert found.theory == pytest.approx(found.slope, abs=SLOPE)


@pytest.mark.parametrize(("which", "theory"), [(0, 2.0), (1, -1.0), (2, 2.0), (3, -2.0)])
def test_differences_lose_to_truncation_on_one_side_and_to_rounding_on_the_other(which: int, theory: float) -> None:
    assert theory == pytest.approx(singularity("differences").laws[which].slope, abs=SLOPE)


def test_a_crank_near_the_ground_length_makes_coriolis_grow_as_the_first_power() -> None:
    assert -1.0 == pytest.approx(singularity("near ground").growth[0].slope, abs=SLOPE)


def test_a_crank_near_the_ground_length_makes_the_bar_accelerate_as_the_second_power() -> None:
    assert -2.0 == pytest.approx(singularity("near ground").growth[1].slope, abs=SLOPE)


def every_law() -> list[tuple[str, ErrorLaw]]:
    return [(kind, law) for kind in KINDS for law in singularity(kind).laws]


def test_every_law_that_has_a_theory_is_asserted() -> None:
    named = {(kind, law.key) for kind, law in every_law() if law.theory is not None}
    assert named - {("differences", "velocity differences"), ("differences", "acceleration differences")} == set(LAWS)


@pytest.mark.parametrize("kind", ["dead point RRR", "dead point RRP", "dead point RPR"])
def test_the_solver_states_a_bound_that_its_velocity_keeps(kind: str) -> None:
    law = singularity(kind)["velocity closed form"]
    kept = [e <= b for e, b in zip(law.error, law.bound, strict=True) if math.isfinite(e)]
    assert all(kept)


def test_the_solver_states_a_bound_that_its_acceleration_keeps_before_a_flip() -> None:
    law = singularity("guide flip")["acceleration bar solved"]
    assert all(e <= max(b, 1e-17) for e, b in zip(law.error, law.bound, strict=True) if math.isfinite(e))


@pytest.mark.parametrize("kind", ["dead point RRR", "dead point RRP", "dead point RPR", "guide flip"])
def test_the_solver_refuses_before_its_rates_mean_nothing(kind: str) -> None:
    laws = [law for law in singularity(kind).laws if "closed form" in law.key or "solved" in law.key]
    assert all(e < MEANINGFUL for law in laws for e in law.error if math.isfinite(e))


@pytest.mark.parametrize("kind", ["dead point RRR", "dead point RRP", "dead point RPR", "guide flip"])
def test_the_solver_refuses_in_the_end(kind: str) -> None:
    assert all(law.refuses_from for law in singularity(kind).laws if "closed form" in law.key or "solved" in law.key)


@pytest.mark.parametrize("kind", ["dead point RRR", "dead point RRP", "dead point RPR", "guide flip"])
def test_a_drawing_warns_before_its_reading_means_nothing(kind: str) -> None:
    law = next(law for law in singularity(kind).laws if "draw" in law.key)
    assert law.warns_from is not None
    assert all(x <= law.warns_from for x, e in zip(law.x, law.error, strict=True) if e > 1e-6)


@pytest.mark.parametrize("kind", ["dead point RRR", "dead point RRP", "dead point RPR"])
def test_a_pencil_refuses_before_its_arcs_could_miss_each_other(kind: str) -> None:
    law = singularity(kind)["velocity pencil"]
    assert law.refuses_from is not None
    assert all(math.isnan(e) for x, e in zip(law.x, law.error, strict=True) if x <= law.refuses_from)


def test_a_centre_is_given_as_a_direction_before_its_place_means_nothing() -> None:
    law = singularity("parallel lines")["centre place"]
    assert max(e for e in law.error if math.isfinite(e)) < MEANINGFUL


def test_a_velocity_through_a_centre_at_infinity_is_right() -> None:
    assert max(singularity("parallel lines")["centre velocity"].error) < 1e-14


def test_the_chart_says_the_slopes_on_its_curves() -> None:
    text = stability_pages([singularity("crossing height")])["stability"]._repr_svg_()
    assert "(−1)" in text


def test_the_table_has_a_row_for_each_point() -> None:
    found = [singularity("crossing height"), singularity("near ground")]
    points = sum(len(law.x) for t in found for law in (*t.laws, *t.growth))
    assert 1 + points == len(laws_table(found).csv().splitlines())


def test_an_unknown_kind_of_the_result_is_named() -> None:
    found = Stability((singularity("crossing height"),), "en")
    with pytest.raises(CallError, match="crossing height"):
        found["crossing"]


def test_a_refusal_is_null_in_the_data() -> None:
    laws = to_json([singularity("guide flip")])["singularities"][0]["laws"]
    assert laws[3]["points"][-1][1] is None


@pytest.mark.parametrize("language", ["en", "zh"])
def test_no_two_labels_of_the_charts_overlap(language: str) -> None:
    for chart in stability_pages([singularity(kind) for kind in KINDS], language).values():
        assert [] == overlapping(chart)
        assert [] == off_the_page(chart)


def test_the_curves_show_the_errors_of_the_table() -> None:
    found = singularity("crossing height")
    panel = stability_pages([found])["stability"].figure().axes[0]
    shown = [[tuple(p) for p in line.get_xydata()] for line in panel.lines]
    assert shown == [list(zip(law.x, law.error, strict=True)) for law in found.laws]


@pytest.mark.parametrize("kind", ["dead point RRR", "dead point RRP", "dead point RPR"])
def test_a_distance_given_from_the_dead_point_loses_nothing(kind: str) -> None:
    assert max(singularity(kind)["all from the dead point"].error) < 1e-14


def test_the_committed_example_shows_the_slopes_of_theory() -> None:
    table = Path(__file__).parents[2] / "figures" / "stability" / "stability.csv"
    with table.open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["theory"]]
    assert {"singularity": 11} == {"singularity": len({row["singularity"] for row in rows})}
    assert all(abs(float(row["slope"]) - float(row["theory"])) <= SLOPE for row in rows)


LOWERED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")


def test_what_is_concluded_is_what_was_measured():
    found = tuple(map(singularity, KINDS))
    by_key = {one.key: one for one in found}
    height, dead = by_key["crossing height"], by_key["dead point RRR"]
    assert in_powers(height["height by squares"].worst) == height.fates[0].gaps["squares"]
    assert in_powers(dead["velocity closed form"].refuses_from) == dead.fates[0].gaps["distance"]
    pencil = next(lesson for lesson in lessons(found) if lesson.key == "lesson pencil")
    gaps = (pencil.gaps[name] for name in ("times", "distance", "pencil", "doubles"))
    times, at, drawn, doubles = (float(a.replace("·10", "e").translate(LOWERED)) for a in gaps)
    assert drawn / doubles == pytest.approx(times, rel=0.1)
    assert drawn == pytest.approx(dead["velocity pencil"].near(at), rel=0.06)


@pytest.mark.parametrize("times", [0.01, 100.0])
def test_conclusions_follow_what_is_measured(times):
    found = singularity("crossing height")
    other = replace(found, laws=tuple(replace(law, error=tuple(times * e for e in law.error)) for law in found.laws))
    angle = singularity("angle near zero")
    (one,), (two,) = lessons((found, angle)), lessons((other, angle))
    assert [in_powers(times * law.worst) for law in found.laws] == [two.gaps["squares"], two.gaps["heron"]]
    assert [one.gaps["arccos"], one.gaps["atan2"]] == [two.gaps["arccos"], two.gaps["atan2"]]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_no_conclusion_has_a_number_that_was_not_measured(language):
    keys = "fate height", "fate arccos", "fate scale", "fate centre", "lesson pencil", "lesson digits"
    fixed = [say(Phrase(key, **dict.fromkeys(gaps_of(key), "")), language) for key in keys]
    assert [] == [text for text in fixed if re.search(r"\d", text.replace("c² − m²", "").replace("atan2", ""))]
