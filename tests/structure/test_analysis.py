"""Mobility, and the groups in the order of solution."""

from __future__ import annotations

import math
import pickle
from cmath import rect
from collections.abc import Callable
from typing import Any

import pytest

import graphkin
from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.symbol import Symbol
from graphkin.solver import solve
from graphkin.structure import Driven, Dyad, LargerGroup, Structure, analyse, links_for, replacement_told
from tests import scenes
from tests.rolling_linkages import cylinder_and_wheel, five_bar_by_its_middle, planet_by_a_rod, wheel_at_its_rim

pytestmark = pytest.mark.quick

FRAME = "[frame]\npoints = { A = [0, 0], D = [400, 0] }\n"
CRANK = '[links.1]\npoints = ["A", "B"]\nlength = 150\n'
ROD = '[links.2]\npoints = ["B", "C"]\nlength = 500\n'
ROCKER = '[links.3]\npoints = ["C", "D"]\nlength = 300\n'
DRIVER = '[driver]\nlink = "1"\nangle = 60\nomega = 10\n'
FOUR_BAR = FRAME + CRANK + ROD + ROCKER + DRIVER


def structure(text: str) -> Structure:
    return analyse(mechanism_of_text(text, "scene"))


def kinds(found: Structure) -> list[str]:
    return ["driven" if isinstance(e, Driven) else e.kind for e in found.elements]


MOBILITY = {"sixbar-guide-40deg": (5, 7, 0), "cam-eccentric-flat-rocker": (2, 2, 1), "sixbar-coupler-1A": (5, 7, 0)}


@pytest.mark.parametrize("name", MOBILITY)
def test_the_count_of_mobility_has_links_lower_and_higher_pairs(name: str) -> None:
    found = analyse(mechanism_of(name)).mobility
    assert (found.links, found.lower, found.higher) == MOBILITY[name]


def test_a_hinge_of_three_links_counts_as_two_turning_pairs() -> None:
    more = '[links.4]\npoints = ["C", "E"]\nlength = 100\n[links.5]\npoints = ["E", "F"]\nlength = 300\n'
    text = FOUR_BAR.replace("D = [400, 0]", "D = [400, 0], F = [600, 0]").replace("[driver]", more + "[driver]")
    assert structure(text).mobility.lower == 7


ORDERS = {
    "fourbar-150-500-300-400": ["driven", "RRR"],
    "sixbar-guide-40deg": ["driven", "RPR", "PRP"],
    "shaper-scheme-2": ["driven", "RPR", "RRP"],
    "sixbar-coupler-1A": ["driven", "RRR", "RRR"],
    "hit-two-RPR": ["driven", "RPR", "RPR"],
    "hydraulic-cylinder": ["RRR"],
    "oldham-coupling": ["driven", "RPP"],
}


@pytest.mark.parametrize("name", ORDERS)
def test_the_groups_in_the_order_of_solution_are(name: str) -> None:
    assert kinds(analyse(mechanism_of(name))) == ORDERS[name]


def test_the_order_of_solution_is_not_that_of_the_file() -> None:
    text = FRAME + ROCKER + ROD + CRANK + DRIVER
    assert [e.link for e in structure(text).elements if isinstance(e, Driven)] == ["1"]
    assert kinds(structure(text)) == ["driven", "RRR"]


def test_the_first_body_of_rrr_is_on_the_link_written_first() -> None:
    group = structure(FRAME + ROCKER + ROD + CRANK + DRIVER).groups[0]
    assert isinstance(group, Dyad)
    assert (group.first.links, group.second.links) == (("3",), ("2",))


def test_a_driver_between_rod_and_rocker_makes_a_body_of_both() -> None:
    text = FOUR_BAR.replace('link = "1"', 'link = "3"\nrelative_to = "2"')
    group = structure(text).groups[0]
    assert isinstance(group, Dyad)
    assert sorted(len(b.links) for b in group.bodies) == [1, 2]


def test_a_driver_between_two_of_three_links_at_one_hinge_makes_a_dyad() -> None:
    # crank 1 and arm 4 turn about A, 4 held to 1 by the driver; 1 and 4 both hang on the frame there, as one body
    text = FOUR_BAR.replace("[driver]", '[links.4]\npoints = ["A", "E"]\nlength = 80\n[driver]')
    text = text.replace('link = "1"', 'link = "4"\nrelative_to = "1"') + "\n"
    two = (
        '[[driver]]\nlink = "4"\nrelative_to = "1"\nangle = 60\nomega = 10\n[[driver]]\nlink = "2"\nrelative_to = "1"\n'
    )
    found = structure(text.split("[driver]")[0] + two + "angle = -40\nomega = 1\n")
    assert kinds(found) == ["RRR", "driven"]


def test_a_driven_coupler_is_a_group_of_class_three() -> None:
    group = structure(
        FOUR_BAR.replace('link = "1"', 'link = "2"') + "[sketch]\nB = [75, 130]\nC = [550, 260]\n"
    ).groups[0]
    assert isinstance(group, LargerGroup)
    assert (group.order, group.kind) == (3, "group of 1, 2, 3")


@pytest.mark.parametrize("base", ["2", "3"])  # the second link itself, or a block that slides on it
@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0)])
def test_a_link_turned_from_a_later_one_that_a_driver_turns_is_a_driven_link(base: str, order: tuple[int, ...]) -> None:
    drivers = [{"link": "1", "relative_to": base, "angle": 40, "omega": 3, "alpha": -1},
               {"link": "2", "angle": 70, "omega": 2, "alpha": 0.5},
               {"slide": "3", "travel": 20, "velocity": 15, "acceleration": -7}]
    scene: dict[str, Any] = {
        "frame": {"points": {"A": [0, 0]}},
        "links": {
            "1": {"points": ["A", "P"], "length": 100},
            "2": {"points": ["P", "Q"], "length": 60, "guides": {"g": {"through": [10, 5], "angle": 30}}},
            "3": {"points": ["S"], "on": "2.g"},
        },
        "driver": [drivers[i] for i in order],
    }
    assert {Driven} == {type(element) for element in analyse(mechanism_of(scene)).elements}
    motion, turn = solve(mechanism_of(scene)), 30 if base == "3" else 0
    p, q = 0.1 * rect(1, math.radians(110 + turn)), 0.06 * rect(1, math.radians(70))
    assert p + q == pytest.approx(complex(motion.position("Q")[0]), rel=1e-13)
    assert 1j * (5 * p + 2 * q) == pytest.approx(complex(motion.velocity("Q")[0]), rel=1e-13)
    second = (-0.5j - 25) * p + (0.5j - 4) * q
    assert second == pytest.approx(complex(motion.acceleration("Q")[0]), rel=1e-13)
    assert [True, True] == [graphkin.check(scene, at=at).ok for at in (None, {"1": 63, "2": -20})]


def test_a_plate_on_three_bars_is_a_group_of_class_three() -> None:
    found = structure(scenes.TRIAD)
    assert isinstance(found.groups[0], LargerGroup)
    assert (found.groups[0].links, found.groups[0].order) == (("2", "3", "4", "5"), 3)


def test_a_closed_contour_of_four_pairs_is_a_group_of_class_four() -> None:
    # two ternary links joined by two bars, each hung on a known link: B of the crank, G of the frame
    text = """
[frame]
points = { A = [0, 0], G = [300, 0] }
[links.1]
points = ["A", "B"]
length = 50
[links.2]
points = ["B", "C"]
length = 100
at = { E = [50, 60] }
[links.3]
points = ["G", "D"]
length = 100
at = { F = [50, -60] }
[links.4]
points = ["C", "D"]
length = 150
[links.5]
points = ["E", "F"]
length = 160
[driver]
link = "1"
angle = 50
omega = 6
"""
    group = structure(text).groups[0]
    assert isinstance(group, LargerGroup)
    assert group.order == 4


def test_a_driven_cylinder_in_a_closed_contour_counts_as_one_bar() -> None:
    group = structure("""
[frame]
points = { A = [0, 0], B = [800, 0] }
[links.1]
points = ["A", "C"]
length = 900
at = { P = [500, 150] }
[links.2]
points = ["B", "D"]
length = 700
at = { Q = [300, 90] }
[links.3]
points = ["C", "D"]
length = 620
[links.4]
points = ["P"]
on = "5"
[links.5]
points = ["Q"]
[driver]
slide = "4"
travel = 300
velocity = 45
""").groups[0]
    assert isinstance(group, LargerGroup)
    assert group.order == 4


def test_the_block_of_a_pin_is_not_counted_among_the_links() -> None:
    assert analyse(mechanism_of("cam-eccentric-flat-rocker")).groups[0].links == ("2",)


def test_a_driver_too_many_is_counted() -> None:
    text = (
        FRAME
        + CRANK
        + ROD
        + ROCKER
        + '[[driver]]\nlink = "1"\nangle = 60\nomega = 1\n[[driver]]\nlink = "2"\nangle = 1\nomega = 1\n'
    )
    with pytest.raises(Unsolvable, match=r"F = 3\*3 - 2\*4 = 1, but 2 drivers given"):
        structure(text)


def test_a_part_held_too_much_is_named_with_the_part_that_is_free() -> None:
    # one bar too many in the four-bar, and a free pendulum: the count is right, the mechanism is not
    more = '[links.4]\npoints = ["A", "C"]\nlength = 420\n[links.5]\npoints = ["D", "E"]\nlength = 50\n'
    with pytest.raises(Unsolvable, match="links left free: 5"):
        structure(FOUR_BAR.replace("[driver]", more + "[driver]"))


TWO_GEARS = """
[frame]
points = { A = [0, 0] }
[links.1]
points = ["A", "B"]
length = 30
[links.2]
points = ["B"]
[links.3]
points = ["A"]
[links.4]
points = ["A"]
[gears.a]
between = ["0", "2"]
teeth = [40, 30]
carrier = "1"
[gears.b]
between = ["2", "3"]
teeth = [14, 29]
carrier = "1"
[[driver]]
link = "2"
angle = 36
omega = 3
[[driver]]
link = "3"
angle = 77
omega = 1
"""


def test_wheels_driven_twice_are_held_too_much_where_another_link_is_free() -> None:
    with pytest.raises(Unsolvable, match="links held too much: 1, 2, 3; links left free: 4"):
        structure(TWO_GEARS)


def test_a_driver_that_turns_a_link_from_one_on_which_it_slides_is_refused_by_name() -> None:
    crank = {"points": ["A", "B"], "length": 40}
    scene = mechanism_of({
        "frame": {"points": {"A": [0, 0], "C": [100, 0]}},
        "links": {"1": crank, "2": {"points": ["B"], "on": "3"}, "3": {"points": ["C"]}},
        "driver": {"link": "2", "relative_to": "3", "angle": 0, "omega": 1},
        "sketch": {"B": [30, 30]},
    })
    with pytest.raises(Unsolvable, match="other drivers already give how link 2 moves on link 3"):
        analyse(scene)


def test_drivers_that_turn_no_wheel_seen_from_the_frame_are_refused_by_name() -> None:
    scene = mechanism_of({
        "frame": {"points": {"A": [0, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 40}, "2": {"points": ["B", "C"], "length": 9},
                  "3": {"points": ["A"]}},
        "gears": {"g": {"between": ["2", "3"], "teeth": [20, -60], "carrier": "1"}},
        "driver": [{"link": "2", "relative_to": "1", "angle": 0, "omega": 1},
                   {"link": "3", "relative_to": "2", "angle": 0, "omega": 1}],
    })
    with pytest.raises(Unsolvable, match="driver 3: slides, wheels and other drivers already give"):
        analyse(scene)


def test_drivers_of_wheels_that_turn_alike_whatever_their_carrier_does_are_refused_by_name() -> None:
    gears = {name: {"between": [name, "3"], "teeth": [40, 20], "carrier": "4"} for name in "12"}
    scene = mechanism_of({
        "frame": {"points": {"A": [0, 0]}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["A"]}, "3": {"points": ["B", "C"], "length": 9},
                  "4": {"points": ["A", "B"], "length": 60}},
        "gears": gears,
        "driver": [{"link": name, "angle": 0, "omega": 1} for name in "12"],
    })
    with pytest.raises(Unsolvable, match="driver 2: slides, wheels and other drivers already give how link 2 moves"):
        analyse(scene)


def test_what_is_held_too_much_is_told_without_a_word_of_another_language() -> None:
    with pytest.raises(Unsolvable) as refusal:
        structure(TWO_GEARS)
    assert refusal.value.text("zh").startswith("自由度：约束过多的构件：1、2、3；自由的构件：4")


def test_a_link_marked_redundant_that_is_needed_is_named() -> None:
    with pytest.raises(Unsolvable, match="link 3, marked redundant, is not counted"):
        structure(FOUR_BAR.replace("[links.3]\n", "[links.3]\nredundant = true\n"))


@pytest.mark.parametrize(("scene", "order"), [
    (wheel_at_its_rim, 2), (cylinder_and_wheel, 2), (planet_by_a_rod, 2), (five_bar_by_its_middle, 3),
])
def test_a_rod_and_the_wheel_that_it_moves_are_a_dyad_about_where_it_rolls(
    scene: Callable[[], dict[str, Any]], order: int
) -> None:
    (group,) = (e for e in analyse(mechanism_of(scene())).elements if isinstance(e, LargerGroup))
    assert order == group.order


def test_a_structure_is_pickled_without_what_was_made_of_it() -> None:
    made = structure(FOUR_BAR)
    solve(made, sweep=4)
    assert made.kept
    again = pickle.loads(pickle.dumps(made))
    assert ({}, made.elements) == (again.kept, again.elements)


def test_a_pin_in_a_slot_is_told_among_the_higher_pairs() -> None:
    said = [str(phrase) for phrase in replacement_told(analyse(mechanism_of("geneva-step")))]
    assert ["pin B in a slot of link 2 is a higher pair"] == said


def test_results_kept_with_a_structure_are_told_apart_by_what_is_asked() -> None:
    structure = analyse(mechanism_of("shaper-scheme-2"))
    first, second = (links_for(structure, Symbol("omega", link=link)) for link in ("3", "4"))
    assert ({"3"}, {"4"}) == (first, second)
    assert second is links_for(structure, Symbol("omega", link="4"))
