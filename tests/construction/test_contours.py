"""Contours of known shape in larger groups: seen from a link held still, then drawn as one link; a slip in it shows."""

from __future__ import annotations

import cmath
import copy
import math
from functools import cache
from typing import Any

import pytest

import graphkin
from graphkin.api.checked import Checked
from graphkin.checking.readings import read_off
from graphkin.checking.slips import Evidence
from graphkin.construction import execute, plan
from graphkin.construction.board.instruments import EXACT, nudged
from graphkin.construction.board.steps import ORDERS
from graphkin.construction.plan import Stages, positioned
from graphkin.construction.polygons import elements
from graphkin.construction.polygons.elements import contours
from graphkin.construction.polygons.polygons import OwnValues
from graphkin.plane import cross
from graphkin.scene import mechanism_of
from graphkin.scene.scene_tables import Tools
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import say
from tests.construction.test_groups import everything

FOUR_BAR: dict[str, Any] = {  # plate, bar, plate, bar: its first hinge is driven; it hangs on a crank and a pivot
    "frame": {"points": {"A": [0, 0], "G": [265, -55]}},
    "links": {
        "1": {"points": ["A", "F"], "length": 95},
        "2": {"points": ["B", "E"], "length": 124, "at": {"F": [90, -80]}},
        "3": {"points": ["C", "D"], "length": 119, "at": {"G": [52, 127]}},
        "4": {"points": ["B", "C"], "length": 150},
        "5": {"points": ["D", "E"], "length": 51},
    },
    "driver": {"link": "5", "relative_to": "2", "angle": 283, "omega": -3.7, "alpha": -30},
    "sketch": {"B": [134, 157], "C": [264, 82], "D": [154, 36], "E": [103, 37], "F": [34, 89]},
}
THROUGH_A_BLOCK: dict[str, Any] = {  # a block on link 4 is driven from link 1, and so is link 4, which hangs on it
    "frame": {"points": {"A": [0, 0]}, "guides": {"g": {"through": [60, 116], "angle": -61.6}}},
    "links": {
        "1": {"points": ["A", "D"], "length": 119},
        "4": {"points": ["D"], "guides": {"c": {"through": [-68, 43], "angle": 23.4},
                                          "b": {"through": [-107, 25], "angle": -74.8}}},
        "2": {"points": ["B", "C"], "length": 77, "on": "0.g", "angle_on": 47},
        "3": {"points": ["C"], "on": "4.c"},
        "5": {"points": ["B"], "on": "4.b"},
    },
    "driver": {"link": "1", "relative_to": "3", "angle": 120, "omega": 6, "alpha": -12},
    "sketch": {"D": [57, 104], "B": [18, 193], "C": [93, 174]},
}
TURNED_ALIKE: dict[str, Any] = {  # the special points lie on two links that turn alike, one carried over to the other
    "frame": {"points": {"A": [0, 0], "D": [138, -16], "F": [252, 199], "G": [344, 65]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 39},
        "2": {"points": ["B", "C"], "length": 116, "on": "5.g", "angle_on": -136},
        "3": {"points": ["C", "D"], "length": 130},
        "4": {"points": ["F"], "on": "6.g"},
        "5": {"points": ["E"], "guides": {"g": {"through": [-3, -43], "angle": 143}}},
        "6": {"points": ["E"], "guides": {"g": {"through": [159, 66], "angle": -116}}},
        "7": {"points": ["G"], "on": "6", "angle_on": 117},
    },
    "driver": {"link": "6", "relative_to": "5", "angle": -36, "omega": -10, "alpha": 29},
    "sketch": {"B": [20, 33], "C": [107, 110], "E": [58, 68]},
}
ON_A_GUIDE: dict[str, Any] = {  # the contour cannot turn: one of its plates slides on the frame
    "frame": {"guides": {"g": {"through": [103, 37], "angle": 20}, "h": {"through": [265, -55], "angle": 100}}},
    "links": {
        "2": {"points": ["E", "B"], "length": 124, "on": "0.g", "angle_on": 55.5},
        "3": {"points": ["C", "D"], "length": 119, "at": {"G": [52, 127]}},
        "4": {"points": ["B", "C"], "length": 150},
        "5": {"points": ["D", "E"], "length": 51},
        "6": {"points": ["G"], "on": "0.h"},
    },
    "driver": {"link": "5", "relative_to": "2", "angle": 283, "omega": -3.7, "alpha": -30},
    "sketch": {"B": [134, 157], "C": [264, 82], "D": [154, 36], "E": [103, 37], "G": [265, -55]},
}
IN_A_TRIAD: dict[str, Any] = {  # a plate on three bars, of which one is two with a driver; a second plate on three bars
    "frame": {"points": {"P": [60, 0], "Q": [240, -10], "R": [330, 220]}},
    "links": {
        "2": {"points": ["A", "B"], "length": 100.5, "at": {"C": [52.7, 75.6], "H": [-6, -40.8], "K": [114.4, -38.8]}},
        "3": {"points": ["D", "E"], "length": 110.5, "at": {"F": [55.2, 55.2], "L": [124, 71.5]}},
        "4": {"points": ["A", "D"], "length": 111.8},
        "5": {"points": ["B", "E"], "length": 114},
        "7": {"points": ["C", "G"], "length": 76.2},
        "8": {"points": ["G", "F"], "length": 53.9},
        "9": {"points": ["P", "H"], "length": 67.1},
        "10": {"points": ["Q", "K"], "length": 67.1},
        "11": {"points": ["R", "L"], "length": 94.3},
    },
    "driver": {"link": "8", "relative_to": "7", "angle": -91.4, "omega": 2, "alpha": -3},
    "sketch": {
        "A": [100, 100], "B": [200, 90], "C": [160, 170], "D": [120, 210], "E": [230, 200], "F": [180, 260],
        "G": [130, 240], "H": [90, 60], "K": [210, 50], "L": [250, 270],
    },
}
SCENES = {
    "four-bar": FOUR_BAR, "through a block": THROUGH_A_BLOCK, "turned alike": TURNED_ALIKE, "on a guide": ON_A_GUIDE,
}


@cache
def checked(name: str) -> Checked:
    return graphkin.check(SCENES[name])


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("more", [-8, 0, 5])
def test_a_driver_between_links_needs_no_trial_and_every_reading_agrees(name: str, more: float) -> None:
    scene = SCENES[name]
    result = graphkin.check(scene, at=scene["driver"]["angle"] + more)
    assert "special points" == result.data["construction"]
    assert set() == everything(scene) - {str(row.symbol) for row in result.report.rows}
    assert [] == [str(row.symbol) for row in result.report.rows if row.error > 1e-9 * max(abs(row.exact), 1e-3)]


@pytest.mark.parametrize(("name", "links"), [("four-bar", "2345"), ("through a block", "41"), ("on a guide", "2345")])
def test_whichever_link_of_a_contour_is_held_still_every_reading_agrees(
    name: str, links: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    usual = elements._rests_on
    for link in links:
        monkeypatch.setattr(
            elements, "_rests_on", lambda *args, link=link: [h for h in usual(*args) if h[0] == link]
        )
        result = graphkin.check(SCENES[name])
        assert {link} == {step.held for step in result.sheet.steps if step.reason == "seen from"}
        assert [] == [str(row.symbol) for row in result.report.rows if row.error > 1e-9 * max(abs(row.exact), 1e-3)]


@pytest.mark.parametrize("name", SCENES)
def test_steps_name_the_equation_in_which_their_vector_stands(name: str) -> None:
    sheet = checked(name).sheet
    equations = {e.number: (e.diagram, {t.symbol for side in e.sides for t in side}) for e in sheet.equations}
    assert [*range(1, len(equations) + 1)] == [e.number for e in sheet.equations]
    told = [step for step in sheet.steps if step.equation and step.diagram != "mechanism"]
    assert {step.equation for step in told} == set(equations)
    for step in told:
        diagram, symbols = equations[step.equation or 0]
        assert diagram == step.diagram
        if step.verb in ("lay off", "line") or step.reason in ("vector", "before its turn"):
            assert step.symbol in symbols


@pytest.mark.parametrize("name", SCENES)
def test_what_an_equation_takes_as_seen_from_a_held_link_is_drawn_so(name: str) -> None:
    sheet = checked(name).sheet
    terms = [t for e in sheet.equations if e.diagram == "velocity" for side in e.sides for t in side]
    found = [t.symbol for t in terms if t.direction.relation == "found" and t.symbol.to]
    found = [s for s in found if s.to and s.to.point not in sheet.special_points]
    ways = {(v.symbol.of, v.symbol.to) for v in sheet.vectors_seen("velocity")}
    assert [] == [s for s in found if (s.of, s.to) not in ways and (s.to, s.of) not in ways]


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("language", ["en", "zh"])
def test_no_step_has_blanks_or_takes_accelerations_for_velocities(name: str, language: str) -> None:
    sheet = checked(name).sheet
    said = [say(step.phrase, language).rstrip() for step in sheet.steps]
    assert not any("α" in one for one, step in zip(said, sheet.steps, strict=True) if step.diagram == "velocity")
    assert [] == [one for one in said if "= ," in one or "= ，" in one or one.endswith((",", "，方向"))]


def test_what_is_seen_from_the_held_link_is_told_and_laid_off_with_the_term_of_coriolis() -> None:
    sheet = checked("four-bar").sheet
    seen = [(step.held, step.diagram) for step in sheet.steps if step.reason == "seen from"]
    assert [("2", "velocity"), ("2", "acceleration")] == seen
    exact = {row.symbol: row.exact for row in checked("four-bar").report.rows}
    turned = {(s.kind, s.link): s.value for s in sheet.steps if s.reason == "rate" and s.held}
    for rate in ("omega", "alpha"):
        for link in "34":
            more = exact[Symbol(rate, link=link)] - exact[Symbol(rate, link="2")]
            assert turned[rate, link] == pytest.approx(more.real, rel=1e-9)
    # what the driver gives is laid off by its rule first
    assert ["v_D/D@2"] == [str(s.symbol) for s in sheet.steps if s.verb == "lay off" and s.diagram != "mechanism"][:1]
    assert {"v_F@3/F@2", "ak_F@3/F@2", "ar_F@3/F@2"} <= {str(symbol) for symbol in exact}


@pytest.mark.parametrize("name", SCENES)
def test_images_seen_from_a_held_link_name_their_corners_in_order_and_what_rests_by_no_vector(name: str) -> None:
    sheet = checked(name).sheet
    links = {link.name: link for link in (sheet.scene.frame, *sheet.scene.links)}
    for step in (step for step in sheet.steps if step.held and step.reason in ("similar", "division")):
        held = (step.symbol.to or PointRef("")).link
        for vector, corner in zip(step.begins, step.points, strict=False):
            assert (vector is None) == (corner in links[held].points)
            assert vector is None or (vector.of or PointRef("")).point == corner
        assert (step.symbol.of or PointRef("")).point == step.points[2]


def test_any_two_links_of_a_group_have_terms_of_coriolis_on_the_board_as_in_the_solver() -> None:
    result, motion = graphkin.check(FOUR_BAR, find=["ak_C@1/C@3", "ar_E@4/E@3"]), graphkin.solve(FOUR_BAR)
    for name in ("ak_C@1/C@3", "ar_E@4/E@3"):
        row = result[name]
        assert complex(row.exact) == pytest.approx(complex(motion[name][0]), rel=1e-9)
        assert complex(row.measured) == pytest.approx(complex(row.exact), rel=1e-9)


def test_links_of_which_one_is_not_of_the_group_have_none() -> None:
    assert graphkin.solve("triad-slider", find=["ak_E@4/E@3"])["ak_E@4/E@3"].shape == (1,)
    with pytest.raises(graphkin.CallError):
        graphkin.solve("triad-slider", find=["ak_E@4/E@2"])


def test_without_a_sliding_pair_none_is_offered() -> None:
    with pytest.raises(graphkin.CallError, match="this mechanism has none"):
        graphkin.check("four-bar-coupler-point", find=["ak_B@1/B@3"])


def test_a_rate_seen_from_a_held_link_bears_the_name_of_that_last() -> None:
    steps = checked("four-bar").sheet.steps
    (told,) = (say(step.phrase) for step in steps if str(step.symbol) == "v_D/D@2")
    assert "ω_52·ED" in told


@pytest.mark.parametrize("name", ["four-bar", "through a block"])
def test_a_contour_is_drawn_again_by_hands_that_err_in_one_of_its_acts(name: str) -> None:
    scene = mechanism_of(SCENES[name])
    planned, still = plan(scene, find=()), nudged("pencil", Tools())
    stages = Stages(planned, planned.scales, still)
    for act in range(1, still.acts + 1, 12):
        whole, gone_on = (
            {r.symbol: r.value for r in read_off(stages.by(nudged("pencil", Tools(), {act: 1.0}), first))}
            for first in (0, act)
        )
        for symbol, value in whole.items():
            assert gone_on[symbol] == pytest.approx(value, rel=1e-9, abs=1e-12), (act, symbol)


@pytest.mark.parametrize("name", ["four-bar", "through a block"])
def test_polygons_that_other_hands_go_on_with_leave_the_first_as_they_stood(name: str) -> None:
    planned = plan(mechanism_of(SCENES[name]), find=())
    begun = positioned(planned, planned.scales)
    before = copy.deepcopy(begun.ends), set(begun.special), copy.deepcopy(begun.seen)
    gone_on = begun.again(EXACT)
    for order, element in planned.in_order:
        elements.draw_element(gone_on, order, element)
    assert before == (begun.ends, begun.special, begun.seen)
    # how elements are drawn, once that is found
    same = {"chains", "contours", "plans"}
    changing = {key: value for key, value in vars(begun).items() if isinstance(value, dict | set | list)}
    assert same == {key for key, value in changing.items() if vars(gone_on)[key] is value}


def test_a_wrong_angular_velocity_of_the_held_link_is_followed_to_the_term_of_coriolis() -> None:
    planned = plan(mechanism_of(FOUR_BAR), find=())
    sheet = execute(planned)
    values = {r.symbol: r.value for r in read_off(sheet)}
    omega, coriolis = Symbol("omega", link="2"), Symbol.parse("ak_F@3/F@2")
    (followed,) = Evidence(planned, values.get, {}, lambda symbol: ()).following({omega: 1.2 * values[omega]}, coriolis)
    assert complex(followed) == pytest.approx(1.2 * complex(values[coriolis]), rel=1e-9)


def test_links_that_drivers_hold_to_each_other_are_one_contour() -> None:
    hinges = [(("2", "4"), 134 + 157j, None, False), (("4", "3"), 264 + 82j, None, False),
              (("3", "5"), 154 + 36j, None, False)]
    driven, free = ((("5", "2"), 103 + 37j, None, held) for held in (True, False))
    assert [("2", "3", "4", "5")] == contours("2345", [*hinges, driven], [])
    assert [] == contours("2345", [*hinges, free], [])
    assert [("2", "3", "4", "5")] == contours("2345", [*hinges, free], [("3", "2")])


def test_a_bar_square_to_the_guide_leaves_its_block_free() -> None:
    crank, bar = (("1", "2"), 0j, None, True), (("2", "3"), 20 + 30j, None, False)
    pin, along = (("3", "4"), 60 + 30j, None, False), (("4", "1"), 60 + 30j, 1 + 0j, False)
    assert [("1", "2", "3", "4")] == contours("1234", [crank, bar, pin, along], [])
    assert [] == contours("1234", [crank, bar, pin, (("4", "1"), 60 + 30j, 1j, False)], [])


def test_a_driven_block_is_held_along_its_guide() -> None:
    hinges = [(("1", "2"), 0j, None, False), (("2", "3"), 20 + 30j, None, False),
              (("3", "4"), 60 + 10j, None, False)]
    for driven, found in ((True, [("1", "2", "3", "4")]), (False, [])):
        assert found == contours("1234", [*hinges, (("4", "1"), 60 + 10j, 1 + 0j, driven)], [])


def test_two_links_that_a_driver_holds_at_their_hinge_are_no_contour() -> None:
    assert [] == contours("12", [(("1", "2"), 10 + 5j, None, True)], [])


def test_a_hinge_between_links_that_turn_alike_makes_them_one() -> None:
    joints = [(("1", "4"), 40 + 110j, None, False), (("3", "4"), 0j, 1 + 1j, False)]
    assert [("1", "4")] == contours("134", joints, [("1", "3")])


@pytest.mark.parametrize("size", [1e-12, 1.0, 1e9])
@pytest.mark.parametrize("angle", [0.0, 0.7, 2.9])
def test_how_large_and_how_turned_a_contour_is_drawn_changes_nothing(size: float, angle: float) -> None:
    by = cmath.rect(size, angle)
    crank, bar = (("1", "2"), 0j, None, True), (("2", "3"), by * (0.2 + 0.3j), None, False)
    for off, found in ((0.0, []), (1e-6, [("1", "2", "3", "4")])):
        way = by / size * cmath.rect(1.0, math.pi / 2 + off)
        block = [(("3", "4"), by * (0.6 + 0.3j), None, False), (("4", "1"), by * (0.6 + 0.3j), way, False)]
        assert found == contours("1234", [crank, bar, *block], [])


def test_links_that_drivers_hold_one_after_the_other_are_no_contour() -> None:
    assert [] == contours("123", [(("2", "3"), 20 + 30j, None, True), (("1", "2"), 0j, None, True)], [])


@pytest.mark.parametrize("name", ["four-bar", "through a block", "on a guide"])
def test_own_values_take_the_place_of_vectors_of_the_polygons_not_of_those_seen_from_a_held_link(name: str) -> None:
    taken: list[Symbol] = []

    def found(symbol: Symbol, _: complex, tip: complex) -> complex:
        taken.append(symbol)
        return tip

    sheet = execute(plan(mechanism_of(SCENES[name])), own_values=OwnValues(found=found))
    seen = {vector.symbol for order in ORDERS for vector in sheet.vectors_seen(order)}
    assert seen
    assert set() == seen & set(taken)


def test_a_special_point_of_a_contour_and_one_of_the_group_around_it_are_two_points() -> None:
    result = graphkin.check(IN_A_TRIAD)
    marked = [(step.point, step.link) for step in result.sheet.placing("special point")]
    assert 2 == len(marked) == len(dict(marked))
    assert [] == [str(row.symbol) for row in result.report.rows if row.error > 1e-8 * max(abs(row.exact), 1e-3)]


def joints_in(scene: dict[str, Any]) -> list[elements.Joint]:
    joints: list[elements.Joint] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(elements, "contours", lambda links, between, turning: joints.extend(between) or [])
        plan(mechanism_of(scene))
    return joints


def test_a_block_of_a_contour_slides_along_its_guide() -> None:
    sheet = checked("through a block").sheet
    along = {slide.links: slide.along(sheet.poses) for slide in sheet.structure.slides}
    blocks = {links: way for links, _, way, _ in joints_in(THROUGH_A_BLOCK) if way is not None}
    assert {("5", "4"), ("3", "4")} <= blocks.keys()
    assert [] == [links for links, way in blocks.items() if abs(cross(way, along[links])) > 1e-9]


def test_the_hinge_at_which_a_driver_acts_is_held_in_a_contour() -> None:
    assert [{"2", "5"}] == [{*links} for links, _, _, held in joints_in(FOUR_BAR) if held]
