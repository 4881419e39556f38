"""Limit positions, strokes, K, transmission, classes: held against published and independent values."""

from __future__ import annotations

import cmath
import json
import math
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import graphkin
from graphkin.api.arguments import as_scene
from graphkin.api.report_text import turn_text
from graphkin.construction import draft
from graphkin.errors import Unsolvable
from graphkin.scene import library, mechanism_of, mechanism_of_text
from graphkin.scene.symbol import Symbol
from graphkin.solver import driver_range, structure_of
from graphkin.solver.path.driver_range import extremes
from graphkin.study.extremes import Extreme, Traced, trace
from graphkin.study.quantities import course_of
from graphkin.study.turn import Output, TurnStudy, four_bar_class, loops, study_turn
from graphkin.study.turn_data import to_json
from tests import scenes
from tests.mechanisms import random_scene, redriven

TRUTH = json.loads((Path(__file__).parents[1] / "validation" / "limits.json").read_text())
LIMITS = {
    "shaper_ii": "shaper-scheme-2",
    "slotter": "slotter-75-150",
    "sixbar_rotating_guide_35rpm": "sixbar-rotating-guide-35rpm",
    "sixbar_rotating_guide_s2": "sixbar-rotating-guide-scheme2",
    "sixbar_420rpm": "sixbar-420rpm",
    "sixbar_guide_40deg": "sixbar-guide-40deg",
    "slider_crank_k12": "slider-crank-s50-e16-K1.2",
}


@lru_cache
def turn_of(name: str) -> TurnStudy:
    return study_turn(driver_range(mechanism_of(name)))


@lru_cache
def redriven_turn(seed: int) -> TurnStudy:
    """The turn of a random mechanism that another link drives: several tests ask for other values of the same."""
    return study_turn(driver_range(as_scene(redriven(seed))))


def slider(turn: TurnStudy) -> Output:
    return next(o for o in turn.outputs if o.quantity.kind == "s")


@pytest.mark.parametrize(("case", "name"), LIMITS.items())
def test_stroke_as_published(case: str, name: str) -> None:
    truth = TRUTH["limits"][case]
    metres = 1.0 if truth["unit"] == "m" else 1e-3
    assert truth["stroke"] * metres == pytest.approx(slider(turn_of(name)).stroke, rel=1e-10)


@pytest.mark.parametrize(("case", "name"), LIMITS.items())
def test_K_as_published(case: str, name: str) -> None:
    turn = turn_of(name)
    back = turn.quick_return(slider(turn))
    assert back is not None
    assert TRUTH["limits"][case]["K"] == pytest.approx(back[0], rel=1e-10)


@pytest.mark.parametrize(("case", "name"), LIMITS.items())
def test_limit_positions_lie_where_published(case: str, name: str) -> None:
    expected = [d["crank_deg"] for d in TRUTH["limits"][case]["dead_positions"]]
    found = sorted(math.degrees(e.driver) for e in slider(turn_of(name)).position.extremes)
    assert expected == pytest.approx(found, abs=1e-10)


def test_slider_crank_gives_back_the_stroke_it_was_made_for() -> None:
    assert slider(turn_of("slider-crank-s50-e16-K1.2")).stroke == pytest.approx(0.05, rel=1e-12)


def test_K_of_a_driver_that_turns_clockwise_is_that_of_one_that_turns_the_other_way() -> None:
    scene = dict(FOUR_BAR, driver={"link": "1", "angle": 60, "omega": -3})
    both = [study_turn(driver_range(mechanism_of(s))) for s in (FOUR_BAR, scene)]
    one, other = (t.quick_return(t.outputs[0]) for t in both)
    assert one == pytest.approx(other, rel=1e-12)


def test_least_transmission_angle_of_the_four_bar() -> None:
    least = turn_of("fourbar-150-500-300-400").transmission[0]
    assert TRUTH["fourbar_150_500_300_400"]["min_transmission_deg"] == pytest.approx(
        math.degrees(least.angle), rel=1e-10
    )


def test_the_least_transmission_angle_is_told_at_every_place_of_it() -> None:
    assert [math.pi / 2, 3 * math.pi / 2] == pytest.approx(turn_of("rotating-guide-bar").transmission[0].drivers)
    boom = graphkin.sweep("boom-lifted", positions=2)  # in line with its pivots at both ends, 400 on 360.555
    assert "1, 2, 3: 0° (2/3 = 39.4449 mm, 760.555 mm)" in boom.text
    (told,) = boom.data["transmission"]
    assert [39.4449, 760.555] == pytest.approx(told["drivers"], rel=1e-6)
    assert told["driver"] == told["drivers"][0]


def test_a_transmission_angle_that_changes_by_rounding_alone_is_the_same_in_every_position() -> None:
    # near the ends, where guides become parallel, it had 60 places
    scene = {
        "frame": {"points": {"A": [34, -29]}, "guides": {"g": {"through": [-28.6, 122.6], "angle": -127}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30, "guides": {
                "g": {"through": [16, 130], "angle": 30}, "h": {"through": [83, 18], "angle": -75}}},
            "2": {"on": "0.g", "points": ["P"]},
            "3": {"on": "1.g", "points": ["P"]},
            "5": {"points": ["P"], "on": "6.g"},
            "6": {"on": "1.h", "guides": {"g": {"through": [-48, -75], "angle": -160}}},
        },
        "driver": {"link": "1", "angle": 53, "omega": 6.65},
        "sketch": {"P": [-57.5, 84.2]},
    }
    _, least = study_turn(driver_range(mechanism_of(scene))).transmission
    assert () == least.drivers
    assert 20 == pytest.approx(math.degrees(least.angle), abs=1e-7)


def test_every_pin_at_a_crossing_of_slots_has_a_transmission_angle_of_its_own() -> None:
    # groups of blocks alone have no links: the last of them was told, without a name
    guides = {"v": {"through": [100, 0], "angle": 80}, "w": {"through": [160, 0], "angle": 60}}
    guides["u"] = {"through": [0, 20], "angle": 0}
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": guides},
        "links": {
            "1": {"points": ["A"]},
            "2": {"points": ["P", "Q"], "length": 60}, "3": {"points": ["Q"], "on": "0.u"},
            "4": {"points": ["R", "S"], "length": 90}, "5": {"points": ["S"], "on": "0.u"},
        },
        "pins": {"P": {"of": "2", "in": ["1", "0.v"]}, "R": {"of": "4", "in": ["1", "0.w"]}},
        "driver": {"link": "1", "angle": 10, "omega": 2},
    }
    swept = graphkin.sweep(scene, positions=2)
    (high,) = {bound["high"] for bound in swept.data["ranges"] if bound["reached"]}
    for pin, angle in (("P", 80), ("R", 60)):
        (line,) = (line for line in swept.text.splitlines() if f"PRP {pin}" in line)
        least = math.radians(angle) - high
        assert f"{math.degrees(least):.6g}°" in line


def test_in_a_change_point_the_transmission_angle_is_zero() -> None:
    assert study_turn(driver_range(mechanism_of_text(scenes.PARALLELOGRAM, "p"))).transmission[0].angle == 0.0


def test_least_transmission_angle_of_the_slider_crank() -> None:
    least = turn_of("slider-crank-s50-e16-K1.2").transmission[0]
    assert TRUTH["slider_crank_synthesis"]["min_transmission_deg"] == pytest.approx(
        math.degrees(least.angle), rel=1e-10
    )


def test_pressure_angle_of_the_rotating_guide_bar_is_30_degrees_at_most() -> None:
    # asin(0.5 sin phi1)
    assert turn_of("rotating-guide-bar").transmission[0].pressure == pytest.approx(math.radians(30), rel=1e-10)


def test_swing_of_the_rocker() -> None:
    swing = turn_of("fourbar-150-500-300-400").outputs[0].stroke
    assert TRUTH["fourbar_150_500_300_400"]["rocker_swing_deg"] == pytest.approx(math.degrees(swing))


def test_range_of_a_driver_without_full_turn_to_full_precision() -> None:
    # the guide bar AF touches the circle of F
    assert turn_of("sixbar-AE70").ranges[0].high == pytest.approx(math.asin(60 / 70), abs=1e-14)


def test_another_range_in_which_it_assembles_is_told() -> None:
    other = turn_of("sixbar-AE70").ranges[1:]
    assert [math.pi + math.asin(60 / 70)] == pytest.approx([r.high for r in other], abs=1e-12)


def test_position_at_the_end_of_the_motion_keeps_its_digits() -> None:
    # at the end AF is square to EF: EF stands at 90 degrees more than the driver
    high = turn_of("sixbar-AE70").outputs[0].highs[0]
    assert math.asin(60 / 70) + math.pi / 2 == pytest.approx(high.value, abs=1e-11)


def test_rates_that_grow_without_bound_have_no_zeros_there() -> None:
    alpha = next(t for t in turn_of("sixbar-AE70").curves if str(t.quantity) == "alpha_4")
    assert alpha.zeros == (0.0,)


WEDGE: dict[str, Any] = {
    "frame": {"guides": {"x": {"through": [0, 0], "angle": 0}, "y": {"through": [0, 0], "angle": 90}}},
    "links": {
        "1": {"on": "0.x", "guides": {"s": {"through": [0, 10], "angle": 30}}},
        "2": {"points": ["P"], "on": "0.y"},
    },
    "pins": {"P": {"of": "2", "in": "1.s"}},
    "driver": {"slide": "1", "travel": -30, "velocity": 12},
}


def discs(first: float, second: float) -> dict[str, Any]:
    """Two discs that roll on each other; the second moves a slide by a rod on its crank of 10."""
    links: dict[str, Any] = {
        "1": {"points": ["A"], "discs": {"k": {"centre": "A", "r": first}}},
        "2": {"points": ["D"], "at": {"Q": [10, 0]}, "discs": {"k": {"centre": "D", "r": second}}},
        "3": {"points": ["Q", "T"], "length": 80},
        "4": {"points": ["T"], "on": "0"},
    }
    return {
        "frame": {"points": {"A": [0, 0], "D": [50, 0]}},
        "links": links,
        "contacts": {"K": {"between": ["1.k", "2.k"], "rolling": True}},
        "driver": {"link": "1", "angle": 0, "omega": 3},
    }


def test_what_a_slide_drives_that_is_followed_no_further_has_no_limit_positions() -> None:
    (output,) = study_turn(driver_range(mechanism_of(WEDGE))).outputs
    assert (None, "nowhere limited", ()) == (output.stroke, output.without, output.position.extremes)


def test_a_range_that_ends_at_one_side_only_has_one_limit_position() -> None:
    # a guide 20 beside its pivot in the frame, on a driven pin
    scene = {
        "frame": {"points": {"D": [0, 0]}},
        "links": {
            "1": {"points": ["C"], "on": "0"},
            "2": {"points": ["C"], "on": "3.s"},
            "3": {"points": ["D"], "guides": {"s": {"through": [0, 20], "angle": 0}}},
        },
        "driver": {"slide": "1", "travel": 100, "velocity": 5},
    }
    told = graphkin.sweep(scene, positions=2).data
    own, other = ((stretch["low"], stretch["high"]) for stretch in told["ranges"])
    assert ((pytest.approx(20), None), (None, pytest.approx(-20))) == (own, other)
    (output,) = told["outputs"]
    assert "it has no two limit positions as far as its motion is followed" == output["why"]
    assert [("end", pytest.approx(20))] == [(limit["kind"], limit["driver"]) for limit in output["limit_positions"]]


def test_a_slide_that_comes_back_less_than_it_goes_has_no_stroke_and_goes_on() -> None:
    # a yoke on a point beyond the rim of a wheel that rolls on a rail
    rail = {"guides": {"rail": {"through": [0, 0], "angle": 0}, "x": {"through": [0, 90], "angle": 0}}}
    wheel = {"points": ["C", "P"], "length": 45, "discs": {"w": {"centre": "C", "r": 30}}}
    yoke = {"on": "0.x", "guides": {"s": {"through": [0, 0], "angle": 90}}}
    scene = {
        "frame": rail, "links": {"1": wheel, "2": yoke}, "pins": {"P": {"of": "1", "in": "2.s"}},
        "contacts": {"K": {"between": ["1.w", "0.rail"], "rolling": True}},
        "driver": {"link": "1", "angle": 0, "omega": -2}, "drawn": {"C": [0, 30], "P": [45, 30]},
    }
    (output,) = study_turn(driver_range(mechanism_of(scene))).outputs
    assert output.position.extremes
    assert (None, "slides on") == (output.stroke, output.without)


def test_what_lies_beyond_a_motion_that_is_followed_no_further_is_no_other_assembly() -> None:
    found = study_turn(driver_range(mechanism_of(WEDGE))).ranges
    assert [(False, False)] == [stretch.ends for stretch in found]


def test_a_wheel_whose_motion_does_not_close_turns_on_and_on() -> None:
    (output,) = turn_of("gears-epicyclic").outputs
    assert (None, "turns on") == (output.stroke, output.without)


def test_limit_positions_are_not_where_a_motion_is_followed_no_further() -> None:
    wheel, slide = study_turn(driver_range(mechanism_of(discs(21, 29)))).outputs
    assert (None, "turns on") == (wheel.stroke, wheel.without)
    assert {0.12, 0.14} == {round(e.value, 9) for e in slide.position.extremes}


FOUR_BAR = scenes.four_bar(150, 500, 300, 400)


@pytest.mark.parametrize(
    ("lengths", "name", "turning"),
    [
        ((150, 500, 300, 400), "crank-rocker", ("1",)),
        ((300, 500, 150, 400), "crank-rocker", ("3",)),
        ((300, 350, 330, 100), "double-crank", ("1", "3")),
        ((300, 100, 330, 350), "double-rocker", ()),
        ((300, 500, 250, 400), "triple-rocker", ()),
        ((200, 400, 200, 400), "change point", ("1", "3")),
    ],
)
def test_class_of_a_four_bar(lengths: tuple[float, ...], name: str, turning: tuple[str, ...]) -> None:
    loop = study_turn(driver_range(mechanism_of(scenes.four_bar(*lengths))), everything=False).loops[0]
    assert (loop.name, loop.turns) == (name, turning)


@pytest.mark.parametrize(
    ("lengths", "turning"),
    [
        ((150, 150, 400, 400), ("crank",)),  # the rocker would need BD = 0 to go round
        ((400, 150, 150, 400), ("rocker",)),
        ((150, 400, 400, 150), ("crank", "rocker")),
        ((400, 400, 150, 150), ("crank", "rocker")),
        ((150, 150, 150, 150), ("crank", "rocker")),
    ],
)
def test_of_a_kite_the_short_bars_turn_fully_against_their_neighbours(
    lengths: tuple[float, ...], turning: tuple[str, ...]
) -> None:
    assert ("change point", True, turning) == four_bar_class(*lengths)


def test_a_bar_as_long_as_the_others_together_leaves_no_motion() -> None:
    assert "stretched four-bar" == four_bar_class(150, 200, 50, 400)[0]


@pytest.mark.parametrize(
    ("centres", "offset", "turning"), [(100, 50, ("1", "3")), (200, 50, ("1",)), (150, 0, ("1", "3"))]
)
def test_a_guide_bar_at_a_change_point_goes_round_unless_its_pivot_lies_outside_the_crank_s_circle(
    centres: float, offset: float, turning: tuple[str, ...]
) -> None:
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [centres, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 150},
            "2": {"points": ["B"], "on": "3.s"},
            "3": {"points": ["D", "C"], "length": 400, "guides": {"s": {"through": [0, offset], "angle": 0}}},
        },
        "driver": {"link": "1", "angle": 60, "omega": 1},
    }
    turn = study_turn(driver_range(mechanism_of(scene)))
    assert ("guide bar at a change point", turning) == (turn.loops[0].name, turn.loops[0].turns)
    assert ("3" not in turning) == (turn.outputs[0].stroke is not None)


@pytest.mark.parametrize(
    ("scene", "name"),
    [
        ("whitworth", "rotating guide bar (Whitworth)"),
        ("slotter-75-150", "swinging guide bar"),
        ("swinging-block", "oscillating block"),
        ("slider-crank-offset", "offset slider-crank"),
        ("scotch-yoke", "Scotch yoke"),
        ("cam-eccentric-flat-rocker", "swinging guide bar"),
    ],
)
def test_inversion_is_named(scene: str, name: str) -> None:
    assert turn_of(scene).loops[0].name == name


def test_the_offset_of_a_bar_in_a_block_is_that_of_both_pivots_across_the_guide() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0], "C": [200, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 60},
            "2": {"points": ["B"], "guides": {"s": {"through": [0, 10], "angle": 0}}},
            "3": {"points": ["P"], "on": "2.s", "at": {"C": [0, 15]}},
        },
        "driver": {"link": "1", "angle": 50, "omega": 3},
    }
    (loop,) = loops(structure_of(mechanism_of(scene)))
    assert {"crank": 0.06, "centres": 0.2, "offset": 0.025} == pytest.approx(loop.lengths)


def test_the_offset_of_a_slider_is_that_of_its_pin() -> None:
    scene = scenes.slider_crank(30, 100)
    scene["frame"]["guides"]["h"]["through"] = [0, -16]
    scene["links"]["3"] = {"points": ["P"], "on": "0.h", "at": {"C": [5, 12]}}
    (loop,) = loops(structure_of(mechanism_of(scene)))
    assert {"crank": 0.03, "rod": 0.1, "offset": 0.004} == pytest.approx(loop.lengths)


def test_a_rod_as_long_as_its_crank_lets_it_turn_fully() -> None:
    (loop,) = loops(structure_of(mechanism_of(scenes.slider_crank(50, 50))))
    assert ("in-line slider-crank at a change point", ("1",)) == (loop.name, loop.turns)


@pytest.mark.parametrize("name", ["fourbar-150-500-300-400", "shaper-scheme-2", "slotter-75-150"])
def test_extremes_of_velocity_lie_where_the_acceleration_is_zero(name: str) -> None:
    turn = turn_of(name)
    curves = {str(t.quantity): t for t in turn.curves}
    key = slider(turn).quantity.pair if name != "fourbar-150-500-300-400" else None
    speed, push = (curves["v_" + key], curves["a_" + key]) if key else (curves["omega_3"], curves["alpha_3"])
    assert sorted(push.zeros) == pytest.approx(sorted(e.driver for e in speed.extremes), abs=1e-12)


def test_extremes_of_acceleration_are_found_off_the_grid() -> None:
    # greatest |a| of a crank in line with its slot: at both ends of the stroke
    curve = next(t for t in turn_of("sine-mechanism").curves if str(t.quantity) == "a_3/4")
    assert [math.pi / 2, 3 * math.pi / 2] == pytest.approx(sorted(e.driver for e in curve.extremes), abs=1e-10)


@pytest.mark.parametrize("name", library())
def test_no_value_of_a_fine_grid_exceeds_the_extremes(name: str) -> None:
    turn = study_turn(driver_range(mechanism_of(name)), everything=False)
    low, high = turn.reach.ends
    motion = turn.reach.motion(np.linspace(low, high, 181)[1:-1])
    for output in turn.outputs:
        if not output.lows or not output.highs:
            continue
        values = course_of(output.quantity, turn.reach, motion)
        room = 1e-11 * max(1.0, abs(output.highs[0].value))
        assert output.lows[0].value - room <= np.nanmin(values)
        assert np.nanmax(values) <= output.highs[0].value + room


@pytest.mark.parametrize("name", ["sixbar-AE70", "elliptic-trammel", "swinging-block", "hit-two-RPR"])
def test_json_holds_no_nan(name: str) -> None:
    assert json.dumps(to_json(turn_of(name)), allow_nan=False)


def test_parallelogram_repeats_after_one_turn_and_its_antiparallel_form_is_not_reached() -> None:
    turn = study_turn(driver_range(mechanism_of(scenes.four_bar(150, 400, 150, 400))), everything=False)
    assert (turn.reach.turns, turn.outputs[0].swings) == (1, False)


def test_wrong_mobility_is_refused_by_name() -> None:
    scene = scenes.four_bar(150, 500, 300, 400)
    scene["links"]["5"] = {"points": ["A", "C"], "length": 450}
    with pytest.raises(Unsolvable):
        driver_range(mechanism_of(scene))


def test_a_driven_slide_has_its_other_range() -> None:
    other = study_turn(driver_range(mechanism_of_text(scenes.CYLINDER, "c"))).ranges[1]
    assert (other.low, other.high) == pytest.approx((-0.5, -0.1), abs=1e-9)


def test_the_other_range_of_a_driven_slide_has_both_its_ends() -> None:
    other = study_turn(driver_range(mechanism_of_text(scenes.CYLINDER, "c"))).ranges[1]
    assert (True, True) == other.ends


GEARED: dict[str, object] = {
    # a rocker that does not turn fully moves a pair of bars by two wheels
    "frame": {"points": {"A": [0, 0], "D": [400, 0], "G": [500, 200], "H": [700, 150]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 350},
        "2": {"points": ["B", "C"], "length": 200},
        "3": {"points": ["D", "C"], "length": 300},
        "4": {"points": ["G", "E"], "length": 60},
        "5": {"points": ["E", "F"], "length": 220},
        "6": {"points": ["H", "F"], "length": 180},
    },
    "gears": {"g": {"between": ["3", "4"], "teeth": [20, 20]}},
    "driver": {"link": "1", "angle": 40, "omega": 1},
    "sketch": {"C": [300, 280], "E": [540, 240], "F": [650, 320]},
}


def test_groups_behind_wheels_whose_other_ranges_are_unknown_are_named() -> None:
    assert ("5", "6") == study_turn(driver_range(mechanism_of(GEARED)), everything=False).not_searched


def test_a_larger_group_whose_other_ranges_are_unknown_is_named() -> None:
    turn = study_turn(driver_range(mechanism_of_text(scenes.MOVED_PARALLELOGRAM, "p")), everything=False)
    assert turn.not_searched == ("1", "2", "3", "5")


CAM = """
[frame]
name = "0"
points = {{ A = [0, 0] }}
guides = {{ g = {{ through = "A", angle = 90 }} }}
[links.1]
points = ["A"]
[links.2]
points = ["B"]
on = "0.g"
[cams.1]
follower = "2"
law = [ {{ to = 100, rise = 20, by = "{by}" }}, {{ to = 150 }}, {{ to = 350, fall = 20, by = "{by}" }}, {{ to = 360 }} ]
base = {{ r = 80 }}
[driver]
link = "1"
angle = {angle}
omega = 10
"""
RISE, FALL = math.radians(100), math.radians(200)


def follower(by: str, angle: float) -> TurnStudy:
    return study_turn(driver_range(mechanism_of_text(CAM.format(by=by, angle=angle), "cam")))


@pytest.mark.parametrize("angle", [0.0, 37.0, 100.0, 150.0])
@pytest.mark.parametrize("by", ["harmonic", "cycloidal", "345", "4567"])
def test_a_follower_with_dwells_is_at_rest_where_they_begin_and_end(by: str, angle: float) -> None:
    speed = next(c for c in follower(by, angle).curves if c.quantity.kind == "v" and c.quantity.pair == "2/0")
    assert [0, 100, 150, 350] == pytest.approx(sorted(math.degrees(z) for z in speed.zeros), abs=1e-10)


@pytest.mark.parametrize("angle", [0.0, 37.0, 100.0, 150.0])
@pytest.mark.parametrize("by", ["harmonic", "cycloidal", "345", "4567"])
def test_a_follower_with_dwells_has_its_limits_where_it_leaves_them(by: str, angle: float) -> None:
    output = slider(follower(by, angle))
    assert 0.02 == pytest.approx(output.stroke, rel=1e-12)
    assert [150, 0] == pytest.approx([math.degrees(e.driver) for e in (output.highs[0], output.lows[0])], abs=1e-10)
    assert len(output.position.extremes) == 2


@pytest.mark.parametrize("angle", [0.0, 37.0, 100.0, 350.0])
@pytest.mark.parametrize("by", ["harmonic", "parabolic", "345"])
def test_K_of_a_follower_is_that_of_rise_and_fall_without_dwells(by: str, angle: float) -> None:
    turn = follower(by, angle)
    assert (2.0, math.pi / 3) == pytest.approx(turn.quick_return(slider(turn)), rel=1e-9)


@pytest.mark.parametrize("angle", [0.0, 37.0, 100.0])
def test_an_acceleration_that_jumps_has_its_extremes_at_the_jumps(angle: float) -> None:
    curves = follower("harmonic", angle).curves
    found = next(c for c in curves if c.quantity.kind == "a" and c.quantity.pair == "2/0").extremes
    rise, fall = (math.pi**2 * 0.02 * 10**2 / (2 * wide**2) for wide in (RISE, FALL))
    expected = {(0, "max", rise), (100, "min", -rise), (150, "min", -fall), (350, "max", fall)}
    assert [x for e in sorted(expected) for x in (e[0], e[2])] == pytest.approx(
        [x for e in sorted(found, key=lambda e: e.driver) for x in (math.degrees(e.driver), e.value)], rel=1e-11
    )
    assert [e[1] for e in sorted(expected)] == [e.kind for e in sorted(found, key=lambda e: e.driver)]


@pytest.mark.parametrize("angle", [0.0, 37.0, 350.0])
def test_an_acceleration_that_jumps_to_zero_is_zero_from_there_on(angle: float) -> None:
    found = next(c for c in follower("harmonic", angle).curves if c.quantity.kind == "a" and c.quantity.pair == "2/0")
    assert [0, 50, 100, 150, 250, 350] == pytest.approx(sorted(math.degrees(z) for z in found.zeros), abs=1e-10)


@pytest.mark.parametrize("angle", [0.0, 50.0])
def test_a_curve_that_jumps_where_it_is_steep_has_its_value_before_the_jump(angle: float) -> None:
    arm, rod, swing = 0.075, 0.2, math.radians(24)
    text = """
[frame]
name = "0"
points = { A = [0, 0], C = [90, 0] }
guides = { g = { through = "C", angle = 0 } }
[links.1]
points = ["A"]
[links.2]
points = ["C", "B"]
length = 75
[links.3]
points = ["B", "D"]
length = 200
[links.4]
points = ["D"]
on = "0.g"
[cams.1]
follower = "2"
law = [ { to = 100, rise = 24, by = "parabolic" }, { to = 150 }, { to = 360, fall = 24, by = "parabolic" } ]
base = { r = 35 }
[sketch]
B = [30, 40]
D = [220, 0]
[driver]
link = "1"
angle = ANGLE
omega = 10
""".replace("ANGLE", str(angle))
    curves = study_turn(driver_range(mechanism_of_text(text, "cam"))).curves
    found = next(c for c in curves if c.quantity.kind == "a" and c.quantity.pair == "4/0")
    # the bar at half of its rise: the law of cosines gives where it stands at the base circle
    start = math.pi - math.acos((0.09**2 + arm**2 - 0.035**2) / (2 * 0.09 * arm))
    theta, omega = start - swing / 2, -2 * swing * 10 / RISE
    sin, cos = math.sin(theta), math.cos(theta)
    along = math.sqrt(rod**2 - (arm * sin) ** 2)
    first = -arm * sin - arm**2 * sin * cos / along
    second = -arm * cos - arm**2 * (cos**2 - sin**2) / along - (arm**2 * sin * cos) ** 2 / along**3
    before = second * omega**2 - first * 4 * swing * 10**2 / RISE**2
    at = next(e for e in found.extremes if abs(math.degrees(e.driver) - 50) < 1e-9)
    assert (before, "max") == (pytest.approx(at.value, rel=1e-12), at.kind)


def test_a_parabolic_law_has_the_acceleration_of_its_halves() -> None:
    found = next(c for c in follower("parabolic", 20.0).curves if c.quantity.kind == "a" and c.quantity.pair == "2/0")
    ends = found.furthest(1.0), found.furthest(-1.0)
    size = 4 * 0.02 * 10**2 / RISE**2
    assert [size, -size] == pytest.approx([end.value for end in ends if end], rel=1e-12)


@pytest.mark.quick
@pytest.mark.parametrize("angle", [0, 17, 90, 133, 211])
@pytest.mark.parametrize("crank", [35, 37.3, 81])
def test_a_slider_in_line_with_its_crank_has_no_quick_return_at_all(angle, crank):
    turn = study_turn(driver_range(mechanism_of({
        "frame": {"points": {"A": [12, -7]}, "guides": {"g": {"through": "A", "angle": angle}}},
        "links": {"1": {"points": ["A", "B"], "length": crank}, "2": {"points": ["B", "C"], "length": 90},
                  "3": {"points": ["C"], "on": "0.g"}},
        "driver": {"link": "1", "angle": angle + 50, "omega": 10},
    })))
    (one,) = (turn.quick_return(o) for o in turn.outputs if o.quantity.pair == "3/0")
    assert (1.0, 0.0) == one


def stephenson_three(**driver: float) -> dict[str, object]:
    """A four-bar with a dyad at its coupler that ends the motion, while the four-bar itself could turn on."""
    return {
        "frame": {"name": "1", "points": {"A0": [0, 0], "B0": [120, 0], "D0": [200, 40]}},
        "links": {
            "2": {"points": ["A0", "A"], "length": 40},
            "3": {
                "points": ["A", "B"],
                "length": 110,
                "at": {"C": {"from": ["A", "B"], "r": [90, 70], "side": "left"}},
            },
            "4": {"points": ["B0", "B"], "length": 80},
            "5": {"points": ["C", "D"], "length": 100},
            "6": {"points": ["D0", "D"], "length": 70},
        },
        "driver": {"link": "2", "angle": 60, "omega": 10, **driver},
    }


@pytest.mark.parametrize(
    ("name", "zeros"), [("alpha_3", [1.59131]), ("alpha_4", []), ("omega_3", []), ("omega_4", [32.0892])]
)
def test_what_stays_finite_where_another_group_ends_the_motion_has_no_zero_there(name: str, zeros: list[float]) -> None:
    traced = {str(t.quantity): t for t in study_turn(driver_range(mechanism_of(stephenson_three()))).curves}
    assert zeros == pytest.approx(np.degrees(traced[name].zeros).tolist(), abs=1e-4)


@pytest.mark.parametrize("angle", [60.0, 83.8, -13.5])
@pytest.mark.parametrize("alpha", [0.0, 20.0, -150.0])
def test_zeros_over_a_limited_range_are_the_changes_of_sign(angle: float, alpha: float) -> None:
    study = study_turn(driver_range(mechanism_of(stephenson_three(angle=angle, alpha=alpha))))
    low, high = study.reach.ends
    offset = low + (high - low) * np.sin(np.linspace(0, np.pi / 2, 2001)[1:-1]) ** 2
    motion = study.reach.motion(offset, extended=False)
    for one in study.curves:
        if one.constant is None and one.quantity.kind in ("omega", "alpha"):
            values = course_of(one.quantity, study.reach, motion)
            at = np.flatnonzero(values[:-1] * values[1:] < 0)
            seen = np.sort((study.reach.value(offset[at]) + study.reach.value(offset[at + 1])) / 2)
            assert seen.tolist() == pytest.approx(sorted(one.zeros), abs=2e-3), str(one.quantity)


SWUNG: dict[str, object] = {
    # a bar about O, moved by a pin that slides past O at 40 mm
    "frame": {"points": {"O": [0, 0]}, "guides": {"h": {"through": [0, 40], "angle": 0}}},
    "links": {
        "1": {"points": ["P"], "on": "0.h"},
        "2": {"points": ["O"], "guides": {"s": {"through": "O", "angle": 0}}},
        "3": {"points": ["P"], "on": "2.s"},
    },
    "driver": {"slide": "1/0", "travel": 30, "velocity": 20},
}


def test_no_zero_and_no_extreme_is_invented_where_a_slide_is_only_not_followed_further() -> None:
    curves = {str(t.quantity): t for t in study_turn(driver_range(mechanism_of(SWUNG))).curves}
    alpha, omega = curves["alpha_2"], curves["omega_2"]
    # tan theta = 40 / x: omega is greatest at x = 0, and alpha at x = 40 / sqrt 3 to either side
    assert [0.0] == pytest.approx(alpha.zeros, abs=1e-12)
    assert [0.0] == pytest.approx([e.driver for e in omega.extremes], abs=1e-9)
    far = 0.04 / math.sqrt(3)
    assert [-far, far] == pytest.approx([e.driver for e in alpha.extremes], abs=1e-9)


@pytest.mark.parametrize(("name", "key"), [("elliptic-trammel", "s_3/4"), ("scissor-lift", "s_8/1"),
                                           ("scissor-lift", "theta_2")])
def test_what_is_nought_at_an_end_of_the_motion_is_told_as_0(name: str, key: str) -> None:
    curve = next(t for t in turn_of(name).curves if str(t.quantity) == key)
    assert 0.0 in [e.value for e in curve.extremes if e.kind == "end"]


def test_an_angle_of_0_at_an_end_of_the_motion_is_told_as_0_where_the_scene_stands_there() -> None:
    # -1.341658913e-08° @ 170 mm
    swing = mechanism_of_text(scenes.PISTON.replace("travel = 150", "travel = 170"), "piston")
    ends = next(t for t in study_turn(driver_range(swing)).curves if str(t.quantity) == "theta_1").extremes
    assert [math.pi, 0.0] == pytest.approx([e.value for e in ends], abs=1e-9)
    assert 0.0 == ends[-1].value


def test_an_extreme_a_hundredth_of_a_degree_from_the_end_of_the_motion_is_found() -> None:
    study = study_turn(driver_range(mechanism_of({
        "frame": {
            "name": "1",
            "points": {"A0": [0, 0], "B0": [90.53, 17.28], "D0": [206.78, 30.78]},
            "guides": {"h": {"through": "D0", "angle": -15}},
        },
        "links": {
            "2": {"points": ["A0", "A"], "length": 84.22},
            "3": {"points": ["A", "B"], "length": 128.47, "at": {"C": [17.68, 13.33]}},
            "4": {"points": ["B0", "B"], "length": 113.24},
            "5": {"points": ["C", "D"], "length": 170.86},
            "6": {"points": ["D"], "on": "1.h"},
        },
        "driver": {"link": "2", "angle": 130.03, "omega": 10},
    })))
    slider = next(t for t in study.curves if str(t.quantity) == "s_6/1")
    places = [math.degrees(e.driver) for e in slider.extremes if e.kind != "end"]
    assert any(abs(place - 19.2707) < 2e-3 for place in places)


@pytest.mark.parametrize(
    ("seed", "least", "places"),
    [
        (7007, [33.0635], [300.938]),
        (7014, [87.62775, 90.0], [None, None]),
        (7511, [0.0, 68.5851], [155.481, 155.481]),  # in line at an end
    ],
)
def test_the_least_transmission_angle_is_told_where_the_ends_of_the_range_cannot_be_computed(
    seed: int, least: list[float], places: list[float | None]
) -> None:
    turn = redriven_turn(seed)
    assert least == pytest.approx([math.degrees(found.angle) for found in turn.transmission], abs=1e-4)
    assert all(found.angle >= 0.0 for found in turn.transmission)
    drivers = [math.degrees(found.drivers[0]) if found.drivers else None for found in turn.transmission]
    assert places == [None if at is None else pytest.approx(at, abs=1e-3) for at in drivers]


def test_a_mechanism_that_stands_nowhere_has_no_outputs() -> None:
    assert () == redriven_turn(7504).outputs


def test_an_angle_has_its_value_at_an_end_where_other_links_go_away() -> None:
    # link 1 turns against link 4 as its driver does, while blocks run off their guides: from end to end half a turn
    turn = redriven_turn(7014)
    position = next(output for output in turn.outputs if output.quantity.pair == "1")
    assert math.pi == pytest.approx(position.stroke, abs=1e-9)
    assert "goes away" == next(output.without for output in turn.outputs if output.quantity.pair == "3/0")


def test_a_rate_that_only_rounding_moves_is_constant() -> None:
    turn = redriven_turn(7014)
    alpha = next(traced for traced in turn.curves if str(traced.quantity) == "alpha_1")
    assert -5.707581566305764 == pytest.approx(alpha.constant, rel=1e-9)


def test_an_end_that_cannot_be_computed_is_not_said_to_go_away() -> None:
    # the solver finds no position nearer than a hundredth of the range to one end
    outputs = redriven_turn(7054).outputs
    assert {("not computed", None)} == {(output.without, output.stroke) for output in outputs}


def test_an_acceleration_that_is_least_along_a_flat_bottom_has_its_least_value_there() -> None:
    reach = driver_range(mechanism_of("slotter-75-150"))
    size = Symbol.parse("a_B")
    fine = course_of(size, reach, reach.motion(np.linspace(0.0, math.tau, 721)))
    course = next(t for t in study_turn(reach, [size]).curves if t.quantity == size)
    assert course.least is not None
    assert (fine.min(), 0.75 * math.tau) == pytest.approx((course.least.value, course.least.offset), rel=1e-6)


def test_no_zero_is_told_where_rounding_hides_a_rate_near_an_end() -> None:
    turn = study_turn(driver_range(mechanism_of(random_scene(190021, ("PRP", "RRP", "pin"), "slot", True))))
    course = next(t for t in turn.curves if str(t.quantity) == "alpha_5")
    assert [0.249575382] == pytest.approx(course.zeros, abs=1e-9)


def test_a_range_of_another_assembly_that_overlaps_that_of_the_motion_is_told_beyond_it() -> None:
    scene = mechanism_of(random_scene(190025, ("slotted", "pin"), "slider", False))
    own, other = study_turn(driver_range(scene)).ranges
    assert own.high == other.low < 0.1 < other.high


def test_no_extreme_is_told_where_a_rate_only_grows_towards_an_end() -> None:
    reach = driver_range(mechanism_of(redriven(17029)))
    rate = Symbol.parse("v_P8/1")
    course = next(t for t in study_turn(reach, [rate]).curves if t.quantity == rate)
    assert ["min", "max", "min", "max"] == [e.kind for e in course.extremes]


@pytest.mark.parametrize(("name", "zeros"), [("gamma_2-3", 0), ("pressure_3", 2)])
def test_an_angle_of_90_degrees_at_most_is_zero_only_where_it_is_least(name: str, zeros: int) -> None:
    angle = Symbol.parse(name)
    turn = study_turn(driver_range(mechanism_of("four-bar-coupler-point")), [angle])
    assert zeros == len(next(t for t in turn.curves if t.quantity == angle).zeros)


def test_an_angle_at_an_end_where_other_links_go_away_has_eleven_digits() -> None:
    # at both ends, half a turn apart, link 7 stands the same way
    turn = redriven_turn(7014)
    swing = next(output for output in turn.outputs if output.quantity.pair == "7").position
    low, *_, high = (e.value for e in swing.extremes if e.kind == "end")
    assert low == pytest.approx(high, abs=1e-11)


def test_a_distance_that_goes_away_at_an_end_is_not_zero_where_it_is_least() -> None:
    distance = Symbol.parse("d_P3/P6")
    turn = study_turn(driver_range(mechanism_of(random_scene(190121, ("RRP", "PRP"), "slot", False))), [distance])
    course = next(t for t in turn.curves if t.quantity == distance)
    assert () == course.zeros
    assert 0.0262676 == pytest.approx(min(e.value for e in course.extremes), abs=1e-7)


def test_the_rate_of_a_contra_parallelogram_has_its_extremes_in_line() -> None:
    # crank 30 on a frame of 20: in line the rocker turns 5 times as fast as the crank, or a fifth as fast
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [20, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30}, "2": {"points": ["B", "C"], "length": 20},
            "3": {"points": ["D", "C"], "length": 30},
        },
        "driver": {"link": "1", "angle": 90, "omega": -5},
        "sketch": {"C": [30, -40]},
    }
    turn = study_turn(driver_range(mechanism_of(scene)))
    rate, second = (next(t for t in turn.curves if str(t.quantity) == name) for name in ("omega_3", "alpha_3"))
    assert [0.0, math.pi] == pytest.approx(sorted(zero % math.tau for zero in second.zeros), abs=1e-8)
    assert [-25.0, -1.0] == pytest.approx(sorted(e.value for e in rate.extremes), abs=1e-7)


def test_angles_at_both_ends_where_other_links_go_away_are_each_of_its_own_end() -> None:
    # by polynomials through ten and twelve positions of the solver
    turn = redriven_turn(7007)
    swing = next(output for output in turn.outputs if output.quantity.pair == "5").position
    ends = [e.value for e in swing.extremes if e.kind == "end"]
    assert [-3.98568951327, 0.09813559657] == pytest.approx(ends, abs=1e-10)


def test_zeros_are_told_of_the_curves_whose_zeros_are_sought() -> None:
    curves = to_json(turn_of("slider-crank-offset"))["curves"]
    assert {"theta_2": False, "omega_2": True} == {name: "zeros" in curves[name] for name in ("theta_2", "omega_2")}


@pytest.mark.parametrize("start", [60, 200, 350])
def test_links_stand_alike_in_a_limit_position_whatever_whole_turns_one_has_made_against_the_other(start):
    swept = graphkin.sweep("four-bar-coupler-point", positions=3, find=["theta_2/1"], at=start)
    stretched = min(swept.data["outputs"][0]["limit_positions"], key=lambda limit: limit["value"])
    assert [pytest.approx(stretched["driver"])] == swept.data["curves"]["theta_2/1"]["zeros"]


def test_the_speed_of_a_follower_is_zero_where_its_rate_is_and_nowhere_less():
    curves = graphkin.sweep("cam-offset-roller", positions=3, find=["v_2/0", "v_B"]).data["curves"]
    assert curves["v_2/0"]["zeros"] == curves["v_B"]["zeros"]
    assert 0.0 == min(extreme["value"] for extreme in curves["v_B"]["extremes"])


TOGGLE = {
    "units": {"length": "in"},
    "frame": {"points": {"A": [0, 0], "D": [11, 9]}, "guides": {"v": {"through": [11, 0], "angle": -90}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 3}, "2": {"points": ["B", "C"], "length": 12},
        "3": {"points": ["D", "C"], "length": 8}, "4": {"points": ["C", "E"], "length": 8},
        "5": {"points": ["E"], "on": "0.v"},
    },
    "driver": {"link": "1", "angle": 35, "omega": -12},
    "sketch": {"C": [11, 1], "E": [11, -7]},
}


def turned_toggle(degrees: float, omega: float) -> dict[str, Any]:
    """The toggle with its frame turned about A."""
    turn = cmath.rect(1.0, math.radians(degrees))

    def at(x: float, y: float) -> list[float]:
        z = complex(x, y) * turn
        return [z.real, z.imag]

    frame = {"points": {"A": [0, 0], "D": at(11, 9)}, "guides": {"v": {"through": at(11, 0), "angle": degrees - 90}}}
    sketch = {"C": at(11, 1), "E": at(11, -7)}
    return {**TOGGLE, "frame": frame, "sketch": sketch, "driver": {"link": "1", "angle": 35 + degrees, "omega": omega}}


@pytest.mark.parametrize("at", [35, 200])
@pytest.mark.parametrize(("degrees", "omega"), [(0, -12), (100, -12), (-140, 12)])
def test_k_is_that_of_both_strokes_where_a_limit_is_reached_twice_a_turn_however_the_frame_lies(
    at: float, degrees: float, omega: float
) -> None:
    # both bars of the toggle stretch out twice a turn: K was that of the stretch at the smaller angle of the crank
    scene = turned_toggle(degrees, omega)
    (drawn,) = (row for row in graphkin.check(scene, find=["K_5/0"]).data["readings"] if row["symbol"] == "K_5/0")
    outputs = graphkin.sweep(scene, at=at + degrees, positions=4).data["outputs"]
    (output,) = [output for output in outputs if output.get("slide") == "5/0"]
    low, first, last = turned_limits(scene)
    ways = abs(first - low), math.tau - abs(last - low)
    assert max(ways) / min(ways) == pytest.approx(output["K"], rel=3e-4)
    assert output["K"] == pytest.approx(drawn["exact"], rel=1e-9)
    assert output["K"] == pytest.approx(drawn["measured"], rel=1e-9)


def turned_limits(scene: dict[str, Any]) -> tuple[float, float, float]:
    """The crank's angles (rad) where the slide is nearest, and where it is farthest for the first and the last time
    after that, by samples a hundredth of a degree apart."""
    travel = graphkin.solve(scene, sweep=36_000)["s_5/0"]
    travel = np.roll(travel, -int(np.argmin(travel)))
    tops = [k for k in range(1, len(travel) - 1) if travel[k - 1] < travel[k] >= travel[k + 1]]
    most = max(travel[tops])
    first, *_, last = (math.radians(k / 100) for k in tops if travel[k] > most - 1e-4)
    return 0.0, first, last


def test_a_distance_that_comes_to_nothing_is_0_there_and_nowhere_else() -> None:
    scene = scenes.four_bar(150, 500, 300, 400, sketch={"C": [500, 290]})
    scene["frame"]["points"]["Q"] = [90, 120]
    (distance,) = trace(driver_range(mechanism_of(scene)), [Symbol.parse("d_B/Q")])
    assert distance.least is not None
    assert (0.0, pytest.approx(math.atan2(120, 90), abs=1e-12)) == (distance.least.value, distance.zeros[0])
    assert 1 == len(distance.zeros)


def test_a_distance_that_comes_near_to_nothing_is_what_it_is() -> None:
    (distance,) = trace(driver_range(mechanism_of(scenes.slider_crank(50, 50.02))), [Symbol.parse("d_C/A")])
    assert distance.least is not None
    assert (0.00002, ()) == (pytest.approx(distance.least.value, rel=1e-9), distance.zeros)


def test_a_stretch_of_zero_goes_on_over_the_zero_of_the_driver() -> None:
    law = [{"to": 40}, {"to": 100, "rise": 20, "by": "345"}, {"to": 160}, {"to": 340, "fall": 20, "by": "345"}]
    scene = graphkin.read("cam-flat-face").to_dict()
    scene["cams"]["1"]["law"] = [*law, {"to": 360}]
    (speed,) = trace(driver_range(mechanism_of(scene)), [Symbol.parse("v_2/0")])
    assert [(100, 160), (340, 40)] == [pytest.approx(np.degrees(ends)) for ends in speed.zero_stretches]


def test_of_extremes_that_differ_little_the_furthest_is_the_greatest() -> None:
    first, second = (Extreme("max", place, place, value) for place, value in ((1.0, 2.0), (3.0, 2.001)))
    assert second == Traced(Symbol.parse("v_C"), (first, second), ()).furthest(1.0)


def told(scene: str | dict[str, object], language: str = "en") -> list[str]:
    return turn_text(study_turn(driver_range(mechanism_of(scene)), everything=True), language)


def test_a_motion_without_an_end_is_told_as_far_as_it_is_followed() -> None:
    assert told("gears-epicyclic")[0] == (
        "Range of the driver 1: no end as far as the motion is followed, from -1440° to 1440°")


def test_the_range_of_one_driver_of_several_is_told_with_the_values_of_the_others() -> None:
    five_bar = {
        "frame": {"points": {"A": [0, 0], "D": [120, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 50}, "2": {"points": ["B", "C"], "length": 90},
                  "3": {"points": ["C", "E"], "length": 90}, "4": {"points": ["D", "E"], "length": 60}},
        "driver": [{"link": "1", "angle": 100, "omega": 1}, {"link": "4", "angle": 60, "omega": 2}],
    }
    assert told(five_bar)[0].startswith("Range of the driver 1 (4 = 60°): -88.1152° – 126.328°")
    assert told(five_bar, "zh")[0].startswith("原动件活动范围 1（4 = 60°）：")


def test_a_place_found_nearer_to_nought_than_a_search_tells_is_told_as_nought() -> None:
    # the coupler of a change-point four-bar drives: where the bars lie in one line, two zeros fall together
    scene = scenes.four_bar(70, 140, 110, 180, driver={"link": "2", "angle": 22, "omega": 2}, sketch={"C": [170, 109]})
    said = " ".join(told(scene))
    assert "at 2 = 0° two assemblies meet" in said
    assert "e-0" not in said


def test_lists_and_brackets_of_a_turn_are_chinese_in_chinese() -> None:
    said = "\n".join(told("slotter-75-150", "zh"))
    assert "基本机构 1、2、3、6：" in said
    assert [] == [sign for sign in (", ", " (", ": ") if sign in said]


@pytest.mark.parametrize(("teeth", "why"), [(140, None), (200, "it has no two limit positions as far as")])
def test_a_slide_that_turns_back_once_as_far_as_it_is_followed_does_not_go_on_and_on(teeth, why):
    scene = {
        "frame": {"points": {"A": [0, 0], "B": [20 + teeth, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A"]},
            "2": {"points": ["B", "C"], "length": 30, "start": 35},
            "3": {"points": ["C", "D"], "length": 90},
            "4": {"points": ["D"], "on": "0.h"},
        },
        "gears": {"g": {"between": ["1", "2"], "teeth": [20, teeth]}},
        "driver": {"link": "1", "angle": 20, "omega": 5},
    }
    # in the eight turns that are followed the wheel with 200 teeth turns by 288 degrees
    output = next(output for output in graphkin.sweep(scene, positions=4).data["outputs"] if "slide" in output)
    assert (60, None) == (pytest.approx(output["stroke"]), why) or output["why"].startswith(why)


@pytest.mark.parametrize("sense", [1, -1])
def test_of_strokes_that_repeat_in_a_turn_that_after_the_crank_s_zero_counts_also_where_rounding_is_below_it(
    sense: int,
) -> None:
    # a yoke that goes up and down as sin drives a slider, farthest out with the crank at 0 and at 180
    scene = mechanism_of({
        "frame": {
            "points": {"A": [0, 0]}, "guides": {"h": {"through": "A", "angle": 0}, "v": {"through": "A", "angle": 90}},
        },
        "links": {
            "1": {"points": ["A", "B"], "length": 30},
            "2": {"points": ["C"], "on": "0.v", "guides": {"s": {"through": [0, 0], "angle": -90}}},
            "4": {"points": ["C", "E"], "length": 80}, "5": {"points": ["E"], "on": "0.h"},
        },
        "pins": {"B": {"of": "1", "in": "2.s"}},
        "driver": {"link": "1", "angle": 10, "omega": 10 * sense},
        "sketch": {"C": [0, 20], "E": [75, 0]}, "find": ["K_5/0"],
    })
    found = extremes(reach := driver_range(scene), Symbol.parse("s_5/0"))
    computed = np.exp(1j * reach.value(np.array([found.low_offset, found.high_offset])))
    ((low, high),) = draft(scene).limits.values()
    drawn = np.exp(1j * np.array([low.value, high.value]))
    assert [1j * sense, 1.0] == pytest.approx(computed, abs=1e-9)
    assert [1j * sense, 1.0] == pytest.approx(drawn, abs=1e-9)
