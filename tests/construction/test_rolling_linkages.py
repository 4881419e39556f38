"""Wheels and links that move each other, on the drawing board."""

from __future__ import annotations

import math

import pytest

from graphkin import check, solve
from graphkin.construction import draft
from graphkin.construction.board.steps import TrialPositions
from graphkin.construction.plan import plan
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol
from graphkin.solver import solve as solved
from tests.rolling_linkages import (
    ROLLING_LINKAGES,
    cylinder_and_wheel,
    five_bar_by_its_middle,
    planet_by_a_rod,
    rack_on_a_rocker,
    wheel_at_its_rim,
    wheel_on_a_rocker,
)


@pytest.mark.parametrize("made", ROLLING_LINKAGES)
@pytest.mark.parametrize("further", [0, 12])
def test_every_reading_agrees_with_the_solver(made, further):
    scene = made()
    driver = scene["driver"]
    result = check(scene, at=driver.get("angle", driver.get("travel")) + further)
    assert result.ok
    for row in result.report.rows:
        assert row.exact == pytest.approx(row.reading.value, rel=1e-8, abs=1e-8)


def test_the_start_is_laid_off_as_given_and_other_positions_are_found_by_trial():
    scene = mechanism_of(wheel_at_its_rim())
    drawn = [draft(scene, at).steps for at in (None, {"1": 1.5})]
    assert [True, False] == [any(s.reason == "rolling" for s in steps) for steps in drawn]
    trials = [[s for s in steps if isinstance(s, TrialPositions)] for steps in drawn]
    assert [(), ("K",)] == [next((trial.rolling for trial in tried), ()) for tried in trials]


def test_a_wheel_on_a_rail_is_tried_at_angles_of_its_bar_to_the_x_axis():
    made = cylinder_and_wheel()
    made["frame"]["guides"]["rail"]["angle"] = 10
    scene, at = mechanism_of(made), {"2/1": 0.156}
    (tried,) = (step for step in draft(scene, at).steps if isinstance(step, TrialPositions))
    assert [Symbol.parse("theta_3")] == [*tried.moved]
    assert float(solved(scene, at=at).angle("3")[0]) == pytest.approx(tried.divided[-1][0][0], abs=math.radians(0.02))


def test_a_wheel_on_a_rail_is_drawn_as_turning_about_where_it_touches():
    sheet = draft(mechanism_of(wheel_at_its_rim()))
    first = sheet.equations[1]
    assert [["v_P"], ["v_P/K@3"], ["v_B", "v_P/B"]] == [[str(t.symbol) for t in side] for side in first.sides]
    assert ["special points"] == [*sheet.groups.values()]


def test_the_motion_of_the_contact_s_points_may_be_asked_for_alone():
    result = check(wheel_at_its_rim(), find=["an_K@3/K@0", "v_K@3/K@0"])
    assert result.ok
    drawn = abs(result["an_K@3/K@0"].measured)  # mm/s2
    assert 40 * result["omega_3"].exact ** 2 == pytest.approx(drawn, rel=1e-9)


def test_where_trial_dyads_fold_more_is_left_out():
    scene = five_bar_by_its_middle()
    for name, length in {"1": 44.595, "2": 109.034, "3": 93.495, "4": 43.93}.items():
        scene["links"][name]["length"] = length
    scene["links"]["4"]["start"], scene["driver"]["angle"] = 70.492, 47.672
    scene["gears"]["g"]["teeth"] = [30, 30]
    # bars 3 and 4 come into line between the two, where the cranks go on
    one, two = (solve(scene, at=at).data["positions"][0]["links"] for at in (60, 64))
    assert math.sin(one["3"]["angle"] - one["4"]["angle"]) * math.sin(two["3"]["angle"] - two["4"]["angle"]) < 0
    assert check(scene, at=64).ok


def test_a_plan_is_made_again_at_the_values_that_it_tells():
    first = plan(mechanism_of(wheel_at_its_rim()))
    assert first.exact.rates["omega"] == plan(first.structure, first.values).exact.rates["omega"]


def test_a_pencil_stays_within_its_predicted_uncertainty():
    assert check(wheel_at_its_rim(), at=70, instrument="pencil", seed=3).ok


def test_a_wheel_in_a_ring_has_at_the_contact_what_both_radii_give():
    sheet = draft(mechanism_of(planet_by_a_rod()))
    omega, vector = sheet.rates["omega"]["3"].value, sheet.vectors["acceleration"][Symbol.parse("a_K@3")]
    assert 0.080 * 0.025 / (0.080 - 0.025) * omega**2 == pytest.approx(abs(vector.span) * sheet.scales.acceleration)
    (size,) = {t.size for e in sheet.equations for side in e.sides for t in side if str(t.symbol) == "a_K@3" and t.size}
    assert "ω_3²·ρ_3ρ_0/(ρ_0 − ρ_3)" == str(size)


@pytest.mark.parametrize("made", [wheel_at_its_rim, wheel_on_a_rocker])
def test_a_wheel_that_rolls_is_not_drawn_a_second_time_at_its_contact(made):
    assert check(made()).at_contacts is None


def test_a_rack_starts_at_its_travel_as_at_the_angle_of_its_wheel():
    scene = rack_on_a_rocker()
    wheel, slide = (solve(scene).data["positions"][0][kind] for kind in ("links", "slides"))
    del scene["links"]["3"]["start"]
    scene["links"]["5"]["start"] = slide["5/4"]["travel"]
    found = solve(scene).data["positions"][0]["links"]["3"]
    assert [wheel["3"][key] for key in found] == pytest.approx([*found.values()])
    result = check(scene)
    assert result.ok
    (start,) = (step for step in result.sheet.steps if step.reason == "rolling")
    assert slide["5/4"]["travel"] == pytest.approx(start.mm * result.sheet.scales.length * 1e3)


def test_pitch_points_of_two_groups_have_letters_of_their_own():
    first = five_bar_by_its_middle()
    other = {**dict(zip("ABCDE", "PQRST", strict=True)), **{name: f"1{name}" for name in "1234"}}
    second = {
        key: {other[name]: {**link, "points": [other[p] for p in link["points"]]} for name, link in value.items()}
        if key == "links" else {other[name]: [x + 500, y] for name, (x, y) in value.items()}
        for key, value in {**first, **first["frame"]}.items() if key in ("links", "points", "sketch")
    }
    scene = {
        "frame": {"points": first["frame"]["points"] | second["points"]},
        "links": first["links"] | second["links"],
        "gears": first["gears"] | {"h": {**first["gears"]["g"], "between": ["11", "14"]}},
        "driver": [first["driver"], {**first["driver"], "link": "12"}],
        "sketch": first["sketch"] | second["sketch"],
    }
    sheet = draft(mechanism_of(scene))
    marks = {s.point: s.strokes[0].at * sheet.scales.length for s in sheet.steps if s.reason == "pitch point"}
    # 20 teeth against 40: a third of the 100 mm between the centres
    assert [pytest.approx(0.1 / 3), pytest.approx(0.5 + 0.1 / 3)] == list(marks.values())
