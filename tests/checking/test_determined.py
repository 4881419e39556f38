"""Readings and stated values that can be held against nothing; a drawing that stopped is not ok."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

import graphkin
from graphkin.checking.readings import read_off, report_on
from graphkin.checking.report import Compared, Uncertainty, compare, deviation
from graphkin.construction import draft
from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Measure
from graphkin.solver import solve
from graphkin.solver.values import Lost
from graphkin.words import Phrase
from graphkin.words.written import printed


def slider_crank(**driver: float) -> dict[str, Any]:
    return {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, -16], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 24},
            "2": {"points": ["B", "C"], "length": 58},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 60, **driver},
    }


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_pencil_at_rest_keeps_within_what_it_promises(seed: int) -> None:
    assert graphkin.check(slider_crank(omega=0, alpha=5), instrument="pencil", seed=seed).ok


def test_the_advice_at_rest_is_about_a_reading_that_has_a_value() -> None:
    advice = graphkin.check(slider_crank(omega=0, alpha=5), instrument="pencil", seed=1).advice
    assert advice is not None
    assert advice.gaps["symbol"].kind in ("a", "at", "alpha")


@pytest.mark.parametrize("driver", [{"omega": 0}, {"omega": 1e-9}, {"omega": 0, "alpha": 5}, {"omega": 10}])
def test_a_drafting_program_reads_a_crank_at_any_speed(driver: dict[str, float]) -> None:
    assert graphkin.check(slider_crank(**driver), instrument="cad").ok


@pytest.mark.quick
def test_agreement_within_a_tolerance_that_accepts_anything_is_none() -> None:
    sheet = draft(mechanism_of("slider-crank-offset"))
    readings = read_off(sheet)
    exact = {r.symbol: r.value for r in readings}
    report = compare(sheet, readings, exact, rounding=dict.fromkeys(exact, Lost(velocity=1e3)))
    led = {"v_B", "omega_1", "omega_3"}  # by the crank and the guide alone
    assert {None} == {row.ok for row in report.rows if row.reading.diagram == "velocity" and str(row.symbol) not in led}


@pytest.mark.quick
@pytest.mark.parametrize(("verdict", "part"), [(True, 0.0), (True, 1e-15), (None, 1e-14), (None, 1e-10), (True, 1e-6)])
def test_where_rounding_is_not_slight_a_value_above_the_last_digits_and_within_it_is_not_determined(
    verdict: bool | None, part: float,
) -> None:
    sheet = draft(mechanism_of("slider-crank-offset"))
    exact = {r.symbol: r.value for r in read_off(sheet)}
    v_c, largest = Symbol.parse("v_C"), max(abs(v) for symbol, v in exact.items() if str(symbol) in ("v_B", "v_C/B"))
    exact[v_c] = complex(part * largest)
    readings = [replace(r, value=exact[r.symbol]) for r in read_off(sheet)]
    rough = Lost(velocity=1e-9 * largest, acceleration=1e-9, slight=False)
    rows = compare(sheet, readings, exact, rounding=dict.fromkeys(exact, rough)).rows
    assert [verdict] == [row.ok for row in rows if row.symbol == v_c]


@pytest.mark.quick
def test_a_report_of_readings_of_which_none_is_determined_is_not_ok() -> None:
    sheet = draft(mechanism_of("slider-crank-offset"))
    readings = [r for r in read_off(sheet) if str(r.symbol) in ("v_C", "v_C/B", "omega_2")]
    exact = {r.symbol: r.value for r in readings}
    assert not compare(sheet, readings, exact, rounding=dict.fromkeys(exact, Lost(velocity=1e3))).ok


@pytest.mark.quick
def test_a_reading_of_a_pencil_of_which_nothing_is_predicted_is_not_determined() -> None:
    sheet = draft(mechanism_of("slider-crank-offset"))
    readings = read_off(sheet)
    exact = {r.symbol: r.value for r in readings}
    known = {Symbol.parse("v_B"): Uncertainty(1e-6, Phrase("reading", symbol=Symbol.parse("v_B")), 1.0)}
    rows = compare(sheet, readings, exact, predicted=known).rows
    assert ["v_B"] == [str(row.symbol) for row in rows if row.ok]


def test_a_tiny_crank_in_a_large_mechanism_is_drawn_as_it_is_solved() -> None:
    scene = slider_crank(omega=10) | {"units": {"length": "m"}}
    scene["links"]["1"]["length"], scene["links"]["2"]["length"] = 1e-6, 1e3
    result = graphkin.check(scene)
    assert {True} == {row.ok for row in result.report.rows}


def beside_a_dead_point(printed: dict[str, float]) -> dict[str, Any]:
    return {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 100},
            "2": {"points": ["B", "C"], "length": 50},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 29.9999, "omega": 10},
        "printed": printed,
    }


def test_a_value_beside_a_dead_point_that_is_off_by_a_hair_cannot_be_judged() -> None:
    exact = graphkin.check(beside_a_dead_point({}))["omega_2"].exact.real
    (value,) = graphkin.audit(beside_a_dead_point({"omega_2": float(f"{exact * 1.00002:.9g}")})).data["values"]
    assert (None, True, None) == (value["verdict"], "why" in value, value["bound"])


def test_a_value_beside_a_dead_point_that_has_the_other_sign_is_wrong_all_the_same() -> None:
    exact = graphkin.check(beside_a_dead_point({}))["omega_2"].exact.real
    (value,) = graphkin.audit(beside_a_dead_point({"omega_2": float(f"{-exact:.9g}")})).data["values"]
    assert "wrong" == value["verdict"]


@pytest.mark.parametrize(("off", "percent"), [(1.0, None), (1.04, 4.0), (1.06, 6.0)])
def test_a_wrong_sign_in_a_drawing_that_is_off_too_is_recognised(off: float, percent: float | None) -> None:
    exact = graphkin.check("slider-crank-offset")["alpha_2"].exact.real
    scene = graphkin.read("slider-crank-offset").replace("printed", {"alpha_2": float(f"{-exact * off:.4g}")})
    (value,) = graphkin.audit(scene).data["values"]
    assert ("wrong", "sign", percent) == (value["verdict"], value["looks_like"], value.get("looks_like_off_pct"))


def test_a_large_whole_number_rounded_beside_a_dead_point_is_not_called_wrong() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 10.7], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 79.8},
            "2": {"points": ["B", "C"], "length": 42.8},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 42.09455779248084, "omega": -11.67, "alpha": -28.2},
        "sketch": {"C": [62.215, 10.7]},
    }
    assert 2_649_564 == round(abs(graphkin.check(scene)["a_C"].exact) / 1000)
    ((_, (judged,)),) = graphkin.audit({**scene, "printed": {"a_C": 2650e6}}).people
    assert "not judged" == judged.verdict


BY_ITS_PISTON = {
    "units": {"length": "mm"},
    "frame": {"name": "4", "points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 23.8},
        "2": {"points": ["B", "C"], "length": 58.4},
        "3": {"points": ["C"], "on": "4.h"},
    },
    "driver": {"slide": "3", "travel": 82.2 - 5e-13, "velocity": 100, "acceleration": 50},
    "sketch": {"B": [23, 1]},
}


def test_what_the_driver_gives_is_determined_where_rounding_loses_the_group_behind_it() -> None:
    scene = mechanism_of(BY_ITS_PISTON)
    report = report_on(draft(scene), solve(scene))
    rows = {str(row.symbol): row for row in report.rows}
    assert ["v_C", "omega_3", "a_C", "alpha_3"] == [name for name, row in rows.items() if row.ok]
    assert (0.1, 0.05) == (pytest.approx(rows["v_C"].measured), pytest.approx(rows["a_C"].true))
    assert {"v_B", "omega_1", "alpha_2"} <= {str(symbol) for symbol in report.undetermined}
    assert report.settles_nothing  # nothing that was found is judged


@pytest.mark.parametrize(
    ("scene", "at"),
    [("elliptic-trammel", 199.9999999999), ("sixbar-AE70", 58.997280866), ("hydraulic-cylinder", 39.4448724537),
     (BY_ITS_PISTON, None)],
)
def test_beside_a_dead_point_that_leaves_nothing_to_judge_a_check_names_it_and_is_not_called_wrong(
    scene: str | dict[str, Any], at: float | None
) -> None:
    # the drawing of what a cylinder drives said that the motion does not reach it
    with pytest.raises(Unsolvable, match="so near a dead point that the drawing determines nothing") as stop:
        graphkin.check(scene, at=at)
    assert "dead point" == stop.value.status


def test_a_pencil_that_determines_nothing_beside_a_dead_point_is_advised_to_draw_exactly() -> None:
    with pytest.raises(Unsolvable, match="determines nothing that it finds; draw exactly, with another"):
        graphkin.check("sixbar-AE70", at=58.9, instrument="pencil")
    assert graphkin.check("sixbar-AE70", at=58.9).ok


@pytest.mark.quick
@pytest.mark.parametrize(("share", "shown"), [(0.031, "3.1 %"), (31.2, "3100 %"), (2.5e-9, "2.5·10⁻⁷ %")])
def test_a_deviation_is_shown_in_per_cent_however_large_or_small_it_is(share: float, shown: str) -> None:
    sheet = draft(mechanism_of("slider-crank-offset"))
    reading = next(r for r in read_off(sheet) if str(r.symbol) == "omega_2")
    row = Compared(reading, reading.value, share * abs(reading.value), math.inf, 0.0)
    assert shown == printed(deviation(row, sheet.scene.units))


def loops_beside_a_dead_point(angle: float) -> dict[str, Any]:
    """C and all that hangs on it is nearly at a dead point; B, E and F are points of the crank."""
    return {
        "units": {"length": "ft"},
        "frame": {"points": {"A": [0, 0]},
                  "guides": {"g2": {"through": [-187.11612304490623, -15.089157129515335],
                                    "angle": -78.94992418765644}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 136.66179597464438,
                  "guides": {"g1": {"through": [198.99331419363455, 194.36987755065223],
                                    "angle": -168.30072546004033}},
                  "at": {"F": {"from": ["A", "B"], "r": [121.79359394048747, 245.62302317784346], "side": "right"}}},
            "2": {"points": ["C"], "on": "1.g1", "angle_on": 114.88742698588686},
            "3": {"points": ["C"], "on": "0.g2",
                  "at": {"D": {"from": "C", "r": 119.96961953184787, "angle": -35.70985385624916}}},
            "4": {"points": ["A", "E"], "length": 160.77046011629275,
                  "guides": {"g3": {"through": [-4.0184918053886225, -0.029076513119654424],
                                    "angle": -269.5854334181873}}},
            "5": {"points": ["F"], "on": "6"},
            "6": {"points": ["C"]},
        },
        "pins": {"D": {"of": "3", "in": "4.g3"}},
        "driver": {"link": "1", "angle": angle, "rpm": -61.45711285577262, "alpha": 43.24601968573202},
        "sketch": {"C": [-196.93513323726478, 35.19061761610405], "E": [-42.52131367543874, 155.04540860444538]},
    }


@pytest.mark.parametrize("angle", [269.05, 269.2, 269.25])
def test_small_accelerations_beside_a_dead_point_are_drawn_as_they_are(angle: float) -> None:
    omega = -61.45711285577262 * 2 * math.pi / 60
    result = graphkin.check(loops_beside_a_dead_point(angle))
    # l sqrt(omega^4 + alpha^2), some 1e-8 of the accelerations of what slides
    whole = 136.66179597464438 * 0.3048 * math.hypot(omega**2, 43.24601968573202)
    (row,) = (row for row in result.report.rows if str(row.symbol) == "a_B")
    assert whole == pytest.approx(abs(row.reading.value), rel=1e-5)
    assert [] == [str(row.symbol) for row in result.report.rows if row.ok is False]


def stephenson(angle: float) -> dict[str, Any]:
    """Links 3 and 4 move quietly where 5 and 6, which hang on them, come into line."""
    return {
        "units": {"length": "mm"},
        "frame": {"name": "1", "points": {"A0": [0, 0], "B0": [120, 0], "D0": [200, 40]}},
        "links": {
            "2": {"points": ["A0", "A"], "length": 40},
            "3": {"points": ["A", "B"], "length": 110,
                  "at": {"C": {"from": ["A", "B"], "r": [90, 70], "side": "left"}}},
            "4": {"points": ["B0", "B"], "length": 80},
            "5": {"points": ["C", "D"], "length": 100},
            "6": {"points": ["D0", "D"], "length": 70},
        },
        "driver": {"link": "2", "angle": angle, "omega": 10},
    }


@pytest.mark.parametrize("angle", [83.8756, 83.875642, -13.66839])
def test_what_comes_before_a_group_at_its_dead_point_is_drawn_and_judged_as_without_it(angle: float) -> None:
    whole = stephenson(angle)
    before = dict(whole, links={name: link for name, link in whole["links"].items() if name in "234"})
    rows = {str(row.symbol): row for row in graphkin.check(whole).report.rows}
    for alone in graphkin.check(before).report.rows:
        row = rows[str(alone.symbol)]
        assert alone.measured == pytest.approx(row.measured, rel=1e-9)
        assert alone.true == pytest.approx(row.true, rel=1e-9)
        assert row.tolerance == pytest.approx(alone.tolerance, rel=0.1)
    assert 15 < abs(rows["alpha_3"].measured)


def test_a_value_that_rounding_may_have_made_is_not_called_zero_beside_a_dead_point() -> None:
    rows = graphkin.check(stephenson(83.8756421)).report.rows
    called_zero = [str(row.symbol) for row in rows if row.ok and row.exact != 0.0 and 0.0 in (row.measured, row.true)]
    assert [] == called_zero


@pytest.mark.quick
@pytest.mark.parametrize(("off", "agrees"), [(1e-10, True), (1e-7, False)])
def test_exact_hands_may_be_off_by_a_billionth_of_the_largest_and_by_no_more(off: float, agrees: bool) -> None:
    sheet = draft(mechanism_of("engine-gas-force"))
    readings = read_off(sheet)
    exact = {r.symbol: r.value for r in readings}
    largest: dict[Measure, float] = {}
    for symbol, value in exact.items():
        largest[symbol.measure] = max(largest.get(symbol.measure, 0.0), abs(value))
    report = compare(sheet, readings, {s: value + off * largest[s.measure] for s, value in exact.items()})
    judged = [row for row in report.rows if row.symbol.measure.name in ("velocity", "acceleration", "force", "angle")]
    assert {agrees} == {row.ok for row in judged if row.ok is not None}


@pytest.mark.quick
def test_what_rounding_leaves_of_a_moment_is_what_it_leaves_of_a_force_times_the_size() -> None:
    sheet = draft(mechanism_of("engine-gas-force"))
    readings = read_off(sheet)
    exact = {r.symbol: r.value for r in readings}
    loads = ("force", "moment")
    forces, moments = ([abs(v) for s, v in exact.items() if s.measure.name == measure] for measure in loads)
    report = compare(sheet, readings, exact, rounding=dict.fromkeys(exact, Lost(force=1e-9 * max(forces))))
    expected = 1e-9 * max(*moments, max(forces) * sheet.scene.size)
    floors = {row.floor for row in report.rows if row.symbol.measure.name == "moment"}
    assert [pytest.approx(expected)] == list(floors)
