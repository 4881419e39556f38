"""Problems stated by coordinates: what is left out is taken from the drawn points, what is given twice must agree."""

from __future__ import annotations

import cmath
import math

import pytest

from graphkin.errors import SceneError
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.model import Driver, Mechanism

from .scenes import changed

pytestmark = pytest.mark.quick

# B at 3-4-5 from A, C above D, E on the coupler
FOUR_BAR = """\
[frame]
name = "4"
points = { A = [0, 0], D = [100, 0] }
guides = { u = { through = "A", toward = "C" } }
[links.1]
points = ["A", "B"]
[links.2]
points = ["B", "C"]
at = { E = "drawn", F = { from = "E", r = 10, toward = "B" } }
guides = { t = { through = "B", toward = "E" }, w = { through = "E", toward = "D" } }
[links.3]
points = ["D", "C"]
[driver]
link = "1"
omega = 10
[drawn]
B = [30, 40]
C = [100, 140]
E = [30, 140]
"""

CYLINDER = """\
[frame]
name = "4"
points = { A = [0, 0], C = [400, 0] }
[links.1]
points = ["A", "B"]
[links.2]
points = ["B"]
on = "3"
[links.3]
points = ["C"]
at = { P = "drawn" }
[driver]
slide = "2"
velocity = 60
[drawn]
B = [100, 400]
P = [360, 80]
"""

GUIDE_BAR = """\
[frame]
name = "4"
points = { A = [0, 280], C = [0, 0] }
guides = { h = { through = [0, -164], angle = 0 } }
[links.1]
points = ["A", "B"]
[links.2]
points = ["B"]
on = "3.s"
[links.3]
points = ["C"]
at = { T = [0, 60] }
guides = { s = { through = "T", angle = 0 } }
[links.5]
points = ["D"]
on = "4.h"
angle_on = 90
guides = { k = { through = "D", toward = "B" } }
[links.6]
points = ["D", "B"]
[driver]
link = "3"
omega = 1
[drawn]
B = [80, 340]
D = [-20, -164]
"""


def read(text: str, *changes: tuple[str, str]) -> Mechanism:
    return mechanism_of_text(changed(text, *changes), "test")


def messages(text: str, *changes: tuple[str, str]) -> list[str]:
    with pytest.raises(SceneError) as error:
        read(text, *changes)
    return [str(p) for p in error.value.problems]


def test_a_length_is_the_distance_of_the_drawn_points() -> None:
    scene = read(FOUR_BAR)
    assert [link.length for link in scene.links] == pytest.approx([0.05, abs(70 + 100j) * 1e-3, 0.14], rel=1e-14)


def test_a_drawn_point_of_a_link_is_seen_from_its_own_axes() -> None:
    assert read(FOUR_BAR).by_name["2"].points["E"] == pytest.approx(0.1j / ((70 + 100j) / abs(70 + 100j)), rel=1e-13)


def test_a_point_may_be_placed_from_a_drawn_one() -> None:
    points = read(FOUR_BAR).by_name["2"].points
    assert points["F"] == pytest.approx(points["E"] * 0.9, rel=1e-13)


def test_the_angle_of_the_driver_follows_from_the_drawn_points() -> None:
    assert read(FOUR_BAR).drivers == (Driver("1", "4", pytest.approx(math.atan2(4, 3)), 10.0, 0.0),)


def test_a_relative_angle_follows_from_the_drawn_points() -> None:
    [driver] = read(FOUR_BAR, ("omega = 10", 'omega = 10\nrelative_to = "3"')).drivers
    assert driver.values[0] == pytest.approx(math.atan2(4, 3) - math.pi / 2, rel=1e-13)


def test_a_guide_of_the_frame_may_point_toward_a_drawn_point() -> None:
    assert read(FOUR_BAR).frame.guides["u"].direction == pytest.approx((100 + 140j) / abs(100 + 140j), rel=1e-14)


def test_a_guide_of_a_link_may_point_toward_a_drawn_point_of_it() -> None:
    guide = read(FOUR_BAR).by_name["2"].guides["t"]
    assert guide.direction == pytest.approx(1j * abs(70 + 100j) / (70 + 100j), rel=1e-13)


def test_a_guide_of_a_link_may_point_toward_a_fixed_point() -> None:
    guide = read(FOUR_BAR).by_name["2"].guides["w"]
    turn = (70 + 100j) / abs(70 + 100j)
    assert guide.direction == pytest.approx((70 - 140j) / abs(70 - 140j) / turn, rel=1e-13)


def test_a_guide_of_a_sliding_link_is_seen_from_the_axes_it_keeps() -> None:
    guide = read(GUIDE_BAR).by_name["5"].guides["k"]
    assert guide.direction == pytest.approx((100 + 504j) / abs(100 + 504j) / 1j, rel=1e-13)


def test_the_travel_of_the_driver_follows_from_the_drawn_points() -> None:
    assert read(CYLINDER).drivers == (Driver("2", "3", pytest.approx(0.5, rel=1e-14), pytest.approx(0.06), 0.0, "2/3"),)


def test_a_cylinder_points_to_what_slides_in_it() -> None:
    assert read(CYLINDER).by_name["3"].points["P"] == pytest.approx(0.088 - 0.016j, rel=1e-12)


def test_a_guide_beside_its_pivot_turns_until_it_passes_through_what_slides_in_it() -> None:
    [driver] = read(GUIDE_BAR).drivers
    turn = cmath.exp(1j * driver.values[0])
    assert turn * complex(math.sqrt(0.08**2 + 0.34**2 - 0.06**2), 0.06) == pytest.approx(0.08 + 0.34j, rel=1e-12)


def test_the_first_in_the_file_decides_the_sense_of_a_swinging_guide() -> None:
    text = changed(CYLINDER, ("[driver]", '[links.5]\npoints = ["Q"]\non = "3"\n[driver]'),
                   ("[drawn]", "[drawn]\nQ = [700, -400]"))
    assert mechanism_of_text(text, "x").drivers[0].values[0] == pytest.approx(0.5)


def test_a_given_angle_turns_the_guide_before_what_slides_in_it_does() -> None:
    angle = math.degrees(math.atan2(-4, 3))
    scene = read(CYLINDER, ('slide = "2"\nvelocity = 60', f'link = "3"\nomega = 1\nangle = {angle!r}'))
    assert scene.by_name["3"].points["P"] == pytest.approx(-0.088 + 0.016j, rel=1e-12)


def test_a_link_with_one_own_point_and_all_else_drawn_has_its_axis_toward_the_drawn() -> None:
    text = changed(FOUR_BAR, ("[driver]", '[links.5]\npoints = ["C"]\nat = { Q = "drawn" }\n[driver]'))
    assert mechanism_of_text(text + "Q = [70, 100]\n", "x").by_name["5"].points["Q"] == pytest.approx(0.05, rel=1e-12)


def test_two_points_of_a_link_at_known_places_give_its_direction() -> None:
    text = changed(FOUR_BAR, ("[driver]", '[links.5]\npoints = ["C"]\nat = { P = [0, 50], Q = "drawn" }\n[driver]'))
    scene = mechanism_of_text(text + "P = [50, 140]\nQ = [100, 150]\n", "x")
    assert scene.by_name["5"].points["Q"] == pytest.approx(0.01, rel=1e-12)


def test_a_relative_angle_and_one_direction_give_the_other() -> None:
    text = changed(FOUR_BAR, ("[driver]", '[links.5]\npoints = ["C"]\nat = { Q = "drawn" }\n[driver]'),
                   ("omega = 10", 'omega = 10\nangle = 90\nrelative_to = "5"'))
    turn = (0.6 + 0.8j) / 1j
    assert mechanism_of_text(text + "Q = [100, 150]\n", "x").by_name["5"].points["Q"] == pytest.approx(
        0.01j / turn, rel=1e-12)


def test_the_travel_of_a_pin_in_a_slot_follows_from_the_drawn_points() -> None:
    text = changed(FOUR_BAR, ('link = "1"\nomega = 10', 'slide = "E/4"\nvelocity = 1'),
                   ("[driver]", '[pins.E]\nof = "2"\nin = "4.v"\n[driver]'),
                   ("guides = { u", "guides = { v = { through = [30, 0], angle = 90 }, u"))
    [driver] = mechanism_of_text(text, "x").drivers
    assert driver == Driver("E/4", "4", pytest.approx(0.14, rel=1e-12), pytest.approx(0.001), 0.0, "E/4")


def test_an_angle_beside_toward_is_kept_where_it_agrees() -> None:
    scene = read(FOUR_BAR, ('u = { through = "A", toward = "C" }', 'u = { through = "A", toward = "D", angle = 0 }'))
    assert scene.frame.guides["u"].direction == 1


def test_the_drawn_points_are_kept_for_the_choice_of_the_assembly() -> None:
    assert read(FOUR_BAR).drawn["C"] == pytest.approx(0.1 + 0.14j)


def test_statements_within_a_millionth_of_the_size_agree() -> None:
    assert read(FOUR_BAR, ('["A", "B"]', '["A", "B"]\nlength = 50.00005')).by_name["1"].length == pytest.approx(
        0.05000005, rel=1e-12)


def test_a_given_length_is_kept_where_it_agrees() -> None:
    assert read(FOUR_BAR, ('["A", "B"]', '["A", "B"]\nlength = 50')).by_name["1"].length == 50 * 1e-3


TWICE = {
    "length": (FOUR_BAR, ('["A", "B"]', '["A", "B"]\nlength = 51'), ["links.1.length", "51", "A and B", "50 apart"]),
    "place": (FOUR_BAR, ('E = "drawn"', "E = [80, 60]"), ["point E", "link 2", "[30, 140]"]),
    "mirrored": (FOUR_BAR, ('E = "drawn"', 'E = { from = ["B", "C"], r = [100, 70], side = "right" }'),
                 ["point E", "link 2", "[30, 140]"]),
    "fixed point": (FOUR_BAR, ("E = [30, 140]", "E = [30, 140]\nD = [101, 0]"),
                    ["drawn.D", "[101, 0]", "[100, 0]", "fixed"]),
    "angle": (FOUR_BAR, ("omega = 10", "omega = 10\nangle = 53"), ["driver.angle", "link 1", "53 deg", "53.1301"]),
    "travel": (CYLINDER, ('slide = "2"', 'slide = "2"\ntravel = 499'), ["driver.travel", "2/3", "499", "500"]),
    "beside the guide": (GUIDE_BAR, ("D = [-20, -164]", "D = [-20, -160]"), ["links.5.on", "4 beside", "4.h"]),
    "angle to the guide": (
        GUIDE_BAR, ('points = ["D"]', 'points = ["D", "B"]'), ["links.5.angle_on", "90 deg", "78.7775"]),
    "pin beside its slot": (
        FOUR_BAR, ("[driver]", '[pins.E]\nof = "2"\nin = "4.v"\n[driver]'), ["pins.E.in", "30 beside", "4.v"]),
    "bar of no length": (FOUR_BAR, ("B = [30, 40]", "B = [0, 0]"), ["links.1", "A and B", "same place"]),
}


@pytest.mark.parametrize("case", TWICE)
def test_what_is_given_twice_must_agree(case: str) -> None:
    text, change, fragments = TWICE[case]
    if "4.v" in change[1]:
        text = changed(text, ("guides = { u", 'guides = { v = { through = "A", angle = 90 }, u'))
    sentences = [s for s in messages(text, change) if all(f in s for f in fragments)]
    assert len(sentences) == 1, messages(text, change)


LEFT_OUT = {
    "length": (FOUR_BAR, ("C = [100, 140]\n", ""), ["links.2.length", "missing", "C in [drawn]"]),
    "travel": (CYLINDER, ("B = [100, 400]\n", ""), ["links.1.length", "missing", "B in [drawn]"]),
    "place": (FOUR_BAR + "Q = [1, 2]\n", (
        "[driver]", '[links.5]\npoints = ["C"]\nat = { Q = "drawn", R = [1, 1] }\n[driver]'),
              ["links.5.at.Q", "does not follow", "two points of link 5"]),
    "guide": (FOUR_BAR + "Q = [1, 2]\n", (
        "[driver]", '[links.5]\npoints = ["C"]\nat = { R = [1, 1] }\nguides = { q = { through = "C", toward = "Q" } }\n'
        '[links.6]\npoints = ["Q"]\non = "5.q"\nangle_on = 3\n[driver]'), ["links.5.guides.q", "does not follow"]),
}


@pytest.mark.parametrize("case", LEFT_OUT)
def test_what_the_drawn_points_do_not_give_is_missed(case: str) -> None:
    text, change, fragments = LEFT_OUT[case]
    sentences = messages(text, change)
    assert any(all(f in s for f in fragments) for s in sentences), sentences


def test_a_wrong_place_in_drawn_is_one_problem() -> None:
    assert [s.split(":")[0] for s in messages(FOUR_BAR, ("B = [30, 40]", "B = [30, inf]"))] == ["drawn.B.2"]


def test_a_driver_angle_that_the_drawn_points_do_not_make_is_told_with_both() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [400, 0]}},
        "links": {
            "1": {"points": ["A", "B"]},
            "2": {"points": ["B", "C"], "length": 500},
            "3": {"points": ["D", "C"], "length": 300},
        },
        "driver": {"link": "1", "angle": 50, "omega": 1},
        "drawn": {"B": [0, 150]},
    }
    with pytest.raises(SceneError, match="link 1: found 50 deg, but the given places make it 90"):
        mechanism_of(scene)
    assert math.radians(90) == pytest.approx(
        mechanism_of(scene | {"driver": {"link": "1", "omega": 1}}).drivers[0].value
    )


SLANTED = """\
[frame]
name = "4"
points = { A = [0, 0] }
guides = { s = { through = [0, -50], angle = 30 } }
[links.1]
points = ["A", "B"]
length = 40
[links.2]
points = ["B", "C"]
[links.3]
points = ["C"]
on = "4.s"
angle_on = 90
at = { P = "drawn" }
[driver]
link = "1"
omega = 1
[drawn]
B = [0, 40]
C = [86.60254037844386, 0]
P = [96.60254037844386, 20]
"""


def test_a_point_drawn_on_what_slides_along_a_slanted_guide_lies_in_its_own_axes_turned_with_the_guide():
    scene = mechanism_of_text(SLANTED, "x")
    assert complex(0.010, 0.020) / cmath.rect(1.0, math.radians(120)) == pytest.approx(scene.by_name["3"].points["P"])
