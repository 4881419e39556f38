"""The drawing board: what it draws, in what order, and what it says when a line meets nowhere."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace
from typing import Any

import pytest

import graphkin
from graphkin.construction import Scales, cad, draft, pencil
from graphkin.construction.board.sheet import Remark, without_residues
from graphkin.construction.board.steps import CompassArc, Ray, Vector
from graphkin.errors import Unsolvable
from graphkin.plane import cross, dot
from graphkin.scene import library, mechanism_of
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import LargerGroup

SIXBAR = "sixbar-guide-40deg"


def _vector(sheet, name):
    symbol = Symbol.parse(name)
    return sheet.vectors["velocity" if symbol.kind == "v" else "acceleration"][symbol]


def test_b3_lies_107_578_mm_from_the_pole_at_10_mm_per_s_a_mm():
    sheet = draft(mechanism_of(SIXBAR))
    assert 107.578 == pytest.approx(abs(sheet.ends["velocity"][PointRef("B", "3")]), abs=5e-4)


def test_the_scales_are_those_the_scene_asks_for():
    scales = draft(mechanism_of(SIXBAR)).scales
    assert (2e-3, 1e-2, 1e-1) == pytest.approx((scales.length, scales.velocity, scales.acceleration))


def test_a_sliding_vector_is_parallel_to_its_guide():
    sheet = draft(mechanism_of(SIXBAR))
    guide = sheet.poses["3"].axis
    assert 0 == pytest.approx(cross(_vector(sheet, "ar_B@3/B@2").span, guide), abs=1e-11)


def test_a_tangential_vector_is_square_to_its_bar():
    sheet = draft(mechanism_of(SIXBAR))
    bar = sheet.points[PointRef("B")] - sheet.points[PointRef("C")]
    assert 0 == pytest.approx(dot(_vector(sheet, "at_B@3/C").span, bar), abs=1e-9)


def test_the_coriolis_vector_is_the_sliding_velocity_turned_with_the_guide():
    sheet = draft(mechanism_of(SIXBAR))
    slip = _vector(sheet, "v_B@3/B@2").span
    sense = 1j if sheet.rates["omega"]["3"].value > 0 else -1j
    assert 0 == pytest.approx(cmath.phase(_vector(sheet, "ak_B@3/B@2").span / (sense * slip)), abs=1e-12)


@pytest.mark.parametrize("name", library())
def test_every_equation_closes(name):
    sheet = draft(mechanism_of(name))
    special = sheet.special_points
    for equation in sheet.equations:
        seen = {one.symbol: one for one in sheet.vectors_seen(equation.diagram)}
        vectors = {**seen, **sheet.vectors[equation.diagram]}
        terms = [t.symbol for side in equation.sides for t in side]
        if any(ref is not None and ref.point in special for s in terms for ref in (s.of, s.to)):
            continue  # what belongs to a special point only leads on, and is measured nowhere
        ends = [sum(vectors[t.symbol].span for t in side) for side in equation.sides]
        for end in ends[1:]:
            assert 0 == pytest.approx(abs(end - ends[0]), abs=1e-9), equation


@pytest.mark.parametrize("name", library())
def test_no_equation_is_drawn_with_more_than_two_unknown_sizes(name):
    for equation in draft(mechanism_of(name)).equations:
        terms = [t for side in equation.sides for t in side if t.direction_known]
        # what lies along one line counts once; a larger group has equations that only close what is known already
        lines = {t.direction for t in terms if not t.size_known}
        assert len(lines) in ((0, 1, 2) if isinstance(equation.element, LargerGroup) else (0, 2)), equation


def test_an_image_is_similar_to_its_link_and_turned_the_same_way():
    sheet = draft(mechanism_of("four-bar-coupler-point"))
    link = next(n for n, k in sheet.structure.links.items() if len(k.points) == 3 and n != sheet.scene.frame.name)
    names = [PointRef(p) for p in sheet.structure.links[link].points]
    for diagram in ("velocity", "acceleration"):
        a, b, c = (sheet.ends[diagram][n] for n in names)
        p, q, r = (sheet.points[n] for n in names)
        assert (r - p) / (q - p) == pytest.approx((c - a) / (b - a), rel=1e-9), diagram


def test_a_position_is_found_with_compass_arcs_of_the_given_lengths():
    sheet = draft(mechanism_of("fourbar-150-500-300-400"))
    arcs = [s for step in sheet.steps for s in step.strokes if isinstance(s, CompassArc)]
    assert [0.3, 0.5] == pytest.approx(sorted(arc.radius * sheet.scales.length for arc in arcs))


def test_a_direction_line_is_drawn_before_the_vector_on_it():
    steps = draft(mechanism_of(SIXBAR)).steps
    ray = next(s.number for s in steps for x in s.strokes if isinstance(x, Ray) and str(x.symbol) == "v_B@3")
    vector = next(s.number for s in steps if s.reason == "vector" and str(s.symbol) == "v_B@3")
    assert ray < vector


def test_steps_are_numbered_from_one_without_gaps():
    steps = draft(mechanism_of(SIXBAR)).steps
    assert list(range(1, len(steps) + 1)) == [s.number for s in steps]


def test_what_is_asked_for_limits_what_is_drawn():
    scene = mechanism_of(SIXBAR)
    few = draft(scene, find=[Symbol.parse("omega_3")])
    assert {"6", "1", "2", "3"} == set(few.poses)
    assert len(few.steps) < len(draft(scene).steps)


def test_a_vector_asked_for_that_stands_in_no_equation_is_drawn():
    sheet = draft(mechanism_of("four-bar-coupler-point"), find=[Symbol.parse("an_P/B"), Symbol.parse("at_P/B")])
    arm = sheet.points[PointRef("P")] - sheet.points[PointRef("B")]
    assert 0 == pytest.approx(cross(_vector(sheet, "an_P/B").span, arm), abs=1e-9)
    assert 0 == pytest.approx(dot(_vector(sheet, "at_P/B").span, arm), abs=1e-9)


def test_a_zero_velocity_is_said_not_drawn_askew():
    scene = mechanism_of("slider-crank-offset")
    still = replace(scene, drivers=(replace(scene.drivers[0], rate=0.0, second=0.0),))
    sheet = draft(still)
    assert any(r.key == "zero vector" for r in sheet.remarks)
    assert all(abs(end) < 1e-9 for end in sheet.ends["velocity"].values())


def test_lines_that_meet_far_away_are_crossed_all_the_same_and_it_is_said():
    scene = mechanism_of("slider-crank-s50-e16-K1.2")
    near = scene.asking(sheet=replace(scene.question.sheet, velocity_scale=0.05))
    sheet = draft(near)
    assert any(r.key == "off the sheet" for r in sheet.remarks)
    v_c = sheet.ends["velocity"][PointRef("C")] * sheet.scales.velocity
    whole = draft(scene)
    assert whole.ends["velocity"][PointRef("C")] * whole.scales.velocity == pytest.approx(v_c, rel=1e-12)


def test_a_dead_point_is_refused_by_name():
    mapping = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 100},
            "2": {"points": ["B", "C"], "length": 100},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 90, "omega": 1},
    }
    with pytest.raises(Unsolvable, match="2, 3"):
        draft(mechanism_of(mapping))


CLASS_III = {
    "title": "triad with a dyad before it",
    "frame": {"points": {"A": [0, 0], "E": [100, 0], "F": [60, 120], "G": [-60, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 30},
        "2": {"points": ["C", "D"], "length": 50, "at": {"H": {"from": ["C", "D"], "r": [40, 40], "side": "left"}}},
        "3": {"points": ["B", "C"], "length": 45},
        "4": {"points": ["E", "D"], "length": 50},
        "5": {"points": ["F", "H"], "length": 50},
        "6": {"points": ["B", "K"], "length": 60},
        "7": {"points": ["G", "K"], "length": 60},
    },
    "driver": {"link": "1", "angle": 60, "omega": 1},
    "sketch": {"C": [30, 65], "D": [80, 50], "H": [55, 90]},
}


def test_a_group_of_class_three_is_drawn_by_its_special_point():
    sheet = draft(mechanism_of(CLASS_III))
    assert [("special points", ("2", "3", "4", "5"))] == [(way, g.links) for g, way in sheet.groups.items()]
    assert {PointRef(p) for p in "CDHK"} <= set(sheet.ends["acceleration"])


def test_the_motion_does_not_reach_past_its_limit():
    with pytest.raises(Unsolvable, match=r"58\.997"):
        draft(mechanism_of("sixbar-AE70"), at={"1": 1.4})


def test_a_parallelogram_goes_on_as_one_through_its_change_point():
    mapping = {
        "frame": {"points": {"A": [0, 0], "D": [100, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 40},
            "2": {"points": ["B", "C"], "length": 100},
            "3": {"points": ["D", "C"], "length": 40},
        },
        "driver": {"link": "1", "angle": 60, "omega": 1},
    }
    sheet = draft(mechanism_of(mapping), at={"1": cmath.pi * 4 / 3})
    assert sheet.poses["1"].axis == pytest.approx(sheet.poses["3"].axis, abs=1e-9)


def slotted_plate(offset: float) -> dict[str, Any]:
    """A plate about C with a slot for the pin of a crank, which passes C at a distance of 68 mm."""
    return {
        "frame": {"points": {"A": [0, 0], "C": [-148, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 80},
            "2": {"points": ["C"], "guides": {"s": {"through": [0, offset], "angle": 0}}},
        },
        "pins": {"B": {"of": "1", "in": "2.s"}},
        "driver": {"link": "1", "angle": 90, "omega": 5},
    }


@pytest.mark.parametrize("offset", [60, 67.9, 67.9999])
def test_a_dyad_keeps_its_assembly_where_the_other_comes_near(offset):
    pin = 80 * cmath.rect(1, math.radians(260)) + 148
    along = math.sqrt(abs(pin) ** 2 - offset**2)  # the plate's x axis points from the foot of the offset to the pin
    sheet = draft(mechanism_of(slotted_plate(offset)), at={"1": math.radians(260)})
    assert pin / complex(along, offset) == pytest.approx(sheet.poses["2"].axis, abs=1e-9)


def test_a_turn_is_drawn_all_round_where_the_other_assembly_of_a_dyad_comes_near():
    assert graphkin.check(slotted_plate(67.999) | {"find": ["swing_2"]}, at=100).ok


def test_whole_turns_are_left_out_of_the_way_to_a_position():
    scene = mechanism_of("sixbar-AE70")
    once, thrice = (draft(scene, at={"1": 0.5 + turns * 2 * cmath.pi}) for turns in (0, 3))
    assert once.points[PointRef("C")] == pytest.approx(thrice.points[PointRef("C")], abs=1e-9)


def test_velocities_need_no_acceleration_polygon():
    sheet = draft(mechanism_of(SIXBAR), find=[Symbol.parse("v_D")])
    assert {} == sheet.vectors["acceleration"]
    assert _vector(sheet, "v_D") == _vector(draft(mechanism_of(SIXBAR)), "v_D")


def test_a_sheet_at_other_scales_is_the_same_construction_larger():
    sheet = draft(mechanism_of(SIXBAR))
    s = sheet.scales
    other = sheet.at(Scales(s.length / 2, s.velocity / 4, s.acceleration * 2))
    for diagram, times in (("velocity", 4.0), ("acceleration", 0.5)):
        for symbol, vector in sheet.vectors[diagram].items():
            assert other.vectors[diagram][symbol].span == pytest.approx(times * vector.span, rel=1e-15)
    assert {r: 2 * z for r, z in sheet.points.items()} == other.points
    first, second = ({n: r.value for n, r in s.rates["alpha"].items()} for s in (sheet, other))
    assert first == second
    for kind, times in (("omega", 4.0), ("alpha", 0.5)):
        assert {n: (times * r.mm, r.arm) for n, r in sheet.rates[kind].items()} == {
            n: (r.mm, r.arm) for n, r in other.rates[kind].items()
        }


def test_a_rate_read_off_a_velocity_plan_is_as_long_at_every_scale():
    sheet = draft(mechanism_of("gears-epicyclic"))
    s = sheet.scales
    assert sheet.rates["omega"] == sheet.at(Scales(s.length / 2, s.velocity / 4, s.acceleration)).rates["omega"]
    assert any(rate.mm for rate in sheet.rates["omega"].values())


@pytest.mark.parametrize(("beside", "kept"), [(0.0, 0.0), (5.0, 5.0)])
def test_a_rate_read_off_what_rounding_leaves_is_zero_but_for_a_driver_on_top_of_it(beside, kept):
    sheet = draft(mechanism_of("four-bar-coupler-point"))
    rate, tiny = sheet.rates["omega"]["2"], 1e-20  # mm

    def with_tiny(step):
        strokes = (replace(s, tail=0j, tip=tiny + 0j) if isinstance(s, Vector) and s.symbol == rate.vector else s
                   for s in step.strokes)
        return replace(step, strokes=tuple(strokes))

    left = tiny * sheet.scales.velocity / rate.arm
    rates = sheet.rates["omega"] | {"2": replace(rate, mm=tiny, value=beside + left)}
    other = replace(sheet, steps=tuple(map(with_tiny, sheet.steps)), rates=sheet.rates | {"omega": rates})
    assert kept == without_residues(other).rates["omega"]["2"].value


def test_a_remark_belongs_to_the_scale_of_its_figure():
    sheet = draft(mechanism_of("slider-crank-s50-e16-K1.2"))
    s = sheet.scales
    larger = sheet.at(Scales(s.length, s.velocity / 1000, s.acceleration))
    assert [False, True] == [any(r.key == "off the sheet" for r in one.remarks) for one in (sheet, larger)]


def test_a_sheet_drawn_by_hands_that_err_is_not_had_at_another_scale():
    scene = mechanism_of(SIXBAR)
    sheet = draft(scene, instrument=pencil(scene.question.sheet.tools, 1))
    with pytest.raises(ValueError, match="pencil"):
        sheet.at(Scales(1.0, 1.0, 1.0))


V_B = Symbol.parse("v_B")


def test_a_given_length_is_taken_as_given_however_short_it_is_on_paper():
    mapping = {
        "frame": {"points": {"A": [0, 0], "D": [400, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 0.001},
            "2": {"points": ["B", "C"], "length": 400},
            "3": {"points": ["D", "C"], "length": 150},
        },
        "driver": {"link": "1", "angle": 60, "omega": 3},
        "sketch": {"C": [400, 150]},
    }
    sheet = draft(mechanism_of(mapping), instrument=cad())
    assert 3e-6 == pytest.approx(abs(sheet.vectors["velocity"][V_B].span) * sheet.scales.velocity, rel=1e-12)


def test_a_found_arm_that_a_drafting_program_reads_as_nothing_is_refused_by_name():
    mapping = {
        "frame": {"points": {"A": [0, 0], "C": [100, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 100.001},
            "2": {"points": ["B"], "on": "3.s"},
            "3": {"points": ["C"], "guides": {"s": {"through": "C", "angle": 0}}},
        },
        "driver": {"link": "1", "angle": 0, "omega": 3},
        "sketch": {"B": [100.001, 0]},
    }
    with pytest.raises(Unsolvable, match="too short to be read"):
        draft(mechanism_of(mapping), instrument=cad())


ON_ONE_PIN: dict[str, Any] = {  # crank and link 3 turn about A: the equation of group 2, 3 leads from A to A
    "frame": {"points": {"A": [0, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 60, "guides": {"g": {"through": [-30, 36], "angle": -22}}},
        "2": {"on": "1.g", "angle_on": 35, "guides": {"h": {"through": [-5, -42], "angle": 55}}},
        "3": {"points": ["A"], "on": "2.h"},
    },
    "driver": {"link": "1", "angle": 40, "omega": 10},
}


def test_an_equation_may_come_back_to_the_pin_at_which_it_begins() -> None:
    result = graphkin.check(ON_ONE_PIN)
    assert result.ok
    terms = [term for equation in result.sheet.equations for side in equation.sides for term in side]
    assert {"ar_A@2/A@1", "ar_A@2/A@3"} <= {str(term.symbol) for term in terms}


@pytest.mark.parametrize("height", [40, -40])
def test_the_limit_positions_of_a_follower_stand_its_lift_apart_on_either_side_of_its_pivot(height: int) -> None:
    scene = graphkin.read("cam-swinging-roller").replace("sketch.B", [30, height]).mechanism
    low, high = draft(scene, find=[Symbol.parse("swing_2")]).limits["2"]
    assert math.radians(24) == pytest.approx(high.angle - low.angle)
    assert math.radians(24) == pytest.approx(cmath.phase(high.poses["2"].axis / low.poses["2"].axis))


@pytest.mark.parametrize(("remark", "said"), [
    (Remark("velocity", "sharp crossing", {"result": "B"}, size=math.sin(math.radians(5.0))),
     "cross at 5 degrees only"),
    (Remark("mechanism", "short arm", {"links": "link 2", "point": "A", "other": "B"}, mm=2.0),
     "A lies only 2 mm from B on paper"),
    (Remark("velocity", "magnified", {"links": "link 2"}, size=3.0), "by up to 3 times as much"),
])
def test_a_remark_tells_an_angle_a_length_or_a_factor(remark, said):
    assert remark.holds
    assert said in str(remark.phrase)


def test_a_vector_with_a_length_is_not_said_to_be_none():
    sheet = draft(mechanism_of("four-bar-coupler-point"))
    lengths = [remark.mm for remark in sheet.noticed if remark.key == "zero vector"]
    assert min(lengths) > 1.0
    assert [] == [remark for remark in sheet.remarks if remark.key == "zero vector"]


def test_an_arm_is_short_below_3_mm_and_a_crossing_off_the_sheet_beyond_2_m():
    arms = [Remark("mechanism", "short arm", {}, mm=mm).holds for mm in (2.9, 3.1)]
    crossings = [Remark("velocity", "off the sheet", {}, mm=mm).holds for mm in (2001.0, 1999.0)]
    assert [True, False] == arms == crossings


def test_the_arm_of_a_guide_is_noted_with_its_length_on_paper():
    sheet = draft(mechanism_of("whitworth"))
    (arm,) = (remark.mm for remark in sheet.noticed if remark.key == "short arm")
    ends = [sheet.points[PointRef(point)] for point in ("A", "O4")]
    assert arm == pytest.approx(abs(ends[1] - ends[0]))


def test_a_train_has_room_for_its_pitch_circles() -> None:
    # the ring of 70 mm radius is the largest
    assert (0.14, 0.14) == pytest.approx(draft(mechanism_of("gears-epicyclic")).extents["mechanism"])


def test_a_cam_has_room_for_its_outline() -> None:
    # from 40 mm behind the axis to 60 mm before it, where the lift of 20 mm is greatest
    assert 0.1 == pytest.approx(draft(mechanism_of("cam-flat-face")).extents["mechanism"][1], rel=1e-3)


def test_a_crossed_parallelogram_goes_on_through_its_change_point():
    mapping = {
        "frame": {"points": {"A": [0, 0], "D": [80, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 40},
            "2": {"points": ["B", "C"], "length": 80},
            "3": {"points": ["D", "C"], "length": 40},
        },
        "driver": {"link": "1", "angle": 45, "omega": 1},
        "sketch": {"C": [71.4, -39.1]},
    }
    # frame and rod cross: the tangents of half the angles are as -(80 + 40) to 80 - 40
    follower = 2 * math.atan(-3 * math.tan(math.radians(-91.136 / 2)))
    sheet = draft(mechanism_of(mapping), at={"1": math.radians(-91.136)})
    assert cmath.rect(1, follower) == pytest.approx(sheet.poses["3"].axis, abs=1e-9)
