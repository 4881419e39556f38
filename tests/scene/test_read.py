"""What a scene file says arrives in the model: units, axes, points, guides, joints, drivers, questions."""

from __future__ import annotations

import math
import re

import pytest

from graphkin.errors import SceneError
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.model import Driver, Mechanism
from graphkin.scene.pairs import Pair, PlacedGuide
from graphkin.scene.spelling import read_cell
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Units

from .scenes import FOUR_BAR, SIX_BAR, changed

pytestmark = pytest.mark.quick

OWN = PlacedGuide("")
"""The own axis of a link."""


def read(text: str, *changes: tuple[str, str]) -> Mechanism:
    return mechanism_of_text(changed(text, *changes), "test")


def place(entry: str) -> complex:
    """Where the four-bar's coupler has E, in mm, with this entry in at."""
    return read(FOUR_BAR, ("E = [100, 50]", entry)).by_name["2"].points["E"] * 1e3


def test_lengths_are_in_metres() -> None:
    assert read(FOUR_BAR).by_name["1"].length == pytest.approx(0.15, rel=1e-15)


@pytest.mark.parametrize(("unit", "metres"), [("mm", 1e-3), ("cm", 1e-2), ("m", 1.0), ("in", 0.0254), ("ft", 0.3048)])
def test_every_unit_of_length_is_known(unit: str, metres: float) -> None:
    scene = read(FOUR_BAR, ("[frame]", f'[units]\nlength = "{unit}"\n[frame]'))
    assert scene.by_name["3"].length == pytest.approx(300 * metres, rel=1e-15)


def test_the_frame_is_named_0_where_no_name_is_given() -> None:
    assert read(FOUR_BAR, ('name = "4"\n', "")).frame.name == "0"


def test_links_keep_the_order_of_the_file() -> None:
    assert [link.name for link in read(SIX_BAR).links] == ["1", "2", "3", "4", "5"]


def test_a_bar_has_its_own_points_on_its_x_axis() -> None:
    link = read(FOUR_BAR).by_name["3"]
    assert list(link.points.items()) == [("C", 0), ("D", pytest.approx(0.3, rel=1e-15))]


def test_every_link_has_its_own_axis_as_a_guide() -> None:
    scene = read(FOUR_BAR)
    assert [(g.through, g.direction) for link in (scene.frame, *scene.links) for g in [link.guides[""]]] == [(0, 1)] * 4


def test_a_point_of_two_links_is_held_by_both() -> None:
    assert read(FOUR_BAR).holders["C"] == ("2", "3")


PLACED = {
    "E = [100, 50]": 100 + 50j,
    'E = { from = "B", r = 65, angle = 90 }': 65j,
    'E = { from = "C", r = 65 }': 565,
    'E = { from = "C", r = 65, toward = "B" }': 435,
    'E = { from = "C", r = 65, toward = "B", angle = 90 }': 500 - 65j,
    'E = { from = ["B", "C"], r = [300, 400], side = "left" }': 180 + 240j,
    'E = { from = ["B", "C"], r = [300, 400], side = "right" }': 180 - 240j,
    'E = { from = ["C", "B"], r = [400, 300], side = "left" }': 180 - 240j,
    'E = { from = ["B", "C"], r = [300, 200], side = "left" }': 300,
    'E = { from = ["B", "C"], r = [700, 200], side = "left" }': 700,
    'E = { from = ["B", "C"], r = [200, 700], side = "left" }': -200,
    'E = { from = "F", r = 10, toward = "G" }, F = { from = "G", r = 20, angle = 90 }, G = [1, 0]': 1 + 10j,
}


@pytest.mark.parametrize("entry", PLACED)
def test_a_further_point_lies_where_its_entry_says(entry: str) -> None:
    assert place(entry) == pytest.approx(PLACED[entry], abs=1e-9)


def test_an_own_point_may_be_placed_again_where_it_is() -> None:
    assert place("E = [1, 2], C = [500, 0]") == pytest.approx(1 + 2j)


def test_a_guide_goes_through_a_further_point_at_its_angle() -> None:
    guide = read(FOUR_BAR).by_name["2"].guides["s"]
    assert (guide.through, guide.direction) == (pytest.approx(0.1 + 0.05j), 1j)


def test_a_guide_may_point_toward_another_point_of_its_link() -> None:
    scene = read(FOUR_BAR, ('through = "E", angle = 90', 'through = "E", toward = "C"'))
    assert scene.by_name["2"].guides["s"].direction == pytest.approx((400 - 50j) / abs(400 - 50j))


def test_a_guide_of_the_frame_is_in_world_axes() -> None:
    guide = read(SIX_BAR).frame.guides["h"]
    assert (guide.through, guide.direction) == (pytest.approx(-0.164j), 1)


def test_sliding_pairs_name_guide_and_pin() -> None:
    assert read(SIX_BAR).slidings == (
        Pair.sliding("2", "3", OWN, pin="B"), Pair.sliding("4", "3", OWN, pin="D"),
        Pair.sliding("5", "6", PlacedGuide("h", -0.164j), pin="D"))


def test_an_oldham_block_slides_on_two_links_at_two_angles() -> None:
    text = """
[frame]
points = { A = [0, 0], B = [50, 0] }
[links.1]
points = ["A"]
[links.2]
on = ["1", "3"]
angle_on = [0, 90]
[links.3]
points = ["B"]
[driver]
link = "1"
angle = 30
rpm = 60
"""
    assert mechanism_of_text(text, "oldham").slidings == (
        Pair.sliding("2", "1", OWN), Pair.sliding("2", "3", OWN, 1j))


def test_one_guide_takes_its_angle_as_a_number_or_a_list() -> None:
    one, many = (read(SIX_BAR, ('"6.h"', f'"6.h"\nangle_on = {a}')).slidings[2].turn for a in ("90", "[90]"))
    assert (one, many) == (1j, 1j)


def test_a_pin_in_two_slots_is_one_constraint_for_each() -> None:
    text = changed(SIX_BAR, ('[links.4]\npoints = ["D"]\non     = "3"\n', ""),
                   ('points = ["D"]\non     = "6.h"', 'on = "6.h"\nat = { D = [0, 0] }'))
    scene = mechanism_of_text(text + '[pins.D]\nof = "5"\nin = ["3", "1"]\n', "pin")
    assert scene.slides[-2:] == (Pair.of_pin("D", "5", "3", OWN), Pair.of_pin("D", "5", "1", OWN))


def test_a_driven_angle_is_in_radians() -> None:
    assert read(FOUR_BAR).drivers == (Driver("1", "4", math.radians(60), 10.0, 0.0),)


def test_rpm_is_turns_per_minute() -> None:
    [driver] = read(FOUR_BAR, ("omega = 10", "rpm = -30")).drivers
    assert driver.values[1] == pytest.approx(-math.pi, rel=1e-15)


def test_a_driver_may_stand_still_and_speed_up() -> None:
    [driver] = read(FOUR_BAR, ("omega = 10", "omega = 0\nalpha = 2.5")).drivers
    assert driver.values[1:] == (0.0, 2.5)


def test_a_driver_may_be_relative_to_another_link() -> None:
    [driver] = read(FOUR_BAR, ("omega = 10", 'omega = 10\nrelative_to = "2"')).drivers
    assert driver.relative_to == "2"


def test_several_drivers_keep_their_order() -> None:
    second = '[[driver]]\nlink = "3"\nangle = 1\nomega = 0\n'
    scene = mechanism_of_text(FOUR_BAR.replace("[driver]", "[[driver]]") + second, "x")
    assert [d.key for d in scene.drivers] == ["1", "3"]


SLIDES = {'slide = "5"': "5/6", 'slide = "5/6"': "5/6", 'slide = "2"\nrelative_to = "3"': "2/3"}


@pytest.mark.parametrize("slide", SLIDES)
def test_a_driven_slide_is_known_by_its_pair(slide: str) -> None:
    [driver] = read(SIX_BAR, ('link  = "1"\nangle = 50\nomega = -10', f"{slide}\ntravel = 5\nvelocity = 6")).drivers
    key = SLIDES[slide]
    assert driver == Driver(*key.split("/"), pytest.approx(0.005), pytest.approx(0.006), 0.0, key)


def test_a_pin_in_a_slot_may_be_driven() -> None:
    text = changed(FOUR_BAR, ('link = "1"\nangle = 60\nomega = 10', 'slide = "E/4"\ntravel = 5\nvelocity = 6'))
    [driver] = mechanism_of_text(text + '[pins.E]\nof = "2"\nin = "4.g"\n', "x").drivers
    assert driver.key == "E/4"


def test_find_is_read_as_symbols_each_once() -> None:
    scene = read(FOUR_BAR, ('title = "Four-bar"', 'find = ["v_C", "omega_3", "a_B@3", "v_B@3/B@2", "v_C"]'))
    assert [str(s) for s in scene.question.find] == ["v_C", "omega_3", "a_B@3", "v_B@3/B@2"]


def test_printed_velocities_are_in_metres_per_second_and_rates_as_they_are() -> None:
    scene = mechanism_of_text(FOUR_BAR + "[printed]\nv_C = 480\nomega_3 = -2.82\na_C = [1000, -2000]\n", "x")
    assert scene.question.printed == {Symbol.parse("v_C"): pytest.approx(0.48), Symbol.parse("omega_3"): -2.82,
                             Symbol.parse("a_C"): pytest.approx(1 - 2j)}


def test_a_sketch_is_in_metres() -> None:
    assert mechanism_of_text(FOUR_BAR + "[sketch]\nC = [10, 20]\n", "x").sketch == {"C": pytest.approx(0.01 + 0.02j)}


def test_the_sheet_keeps_the_units_of_the_file() -> None:
    wishes = '[sheet]\nlength_scale = 2\nvelocity_scale = 10\nlanguage = "zh"\n'
    sheet = mechanism_of_text(FOUR_BAR + wishes, "x").question.sheet
    assert (sheet.length_scale, sheet.velocity_scale, sheet.acceleration_scale, sheet.language) == (2, 10, None, "zh")


def test_a_scene_without_a_title_has_its_name_for_one() -> None:
    assert read(FOUR_BAR, ('title = "Four-bar"\n', "")).question.title == "test"


def test_a_redundant_link_is_marked() -> None:
    scene = read(FOUR_BAR, ("length = 300", "length = 300\nredundant = true"))
    assert [link.redundant for link in scene.links] == [False, False, True]


SWINGING_BLOCK = """
[frame]
points = { A = [0, 0], C = [400, 0] }
[links.1]
points = ["A", "B"]
length = 200
[links.2]
points = ["B", "D"]
length = 700
[links.3]
points = ["C"]
on     = "2"
[driver]
link = "1"
angle = 30
omega = 10
"""
SCOTCH_YOKE = """
[frame]
name = "4"
points = { A = [0, 0] }
guides = { x = { through = "A", angle = 0 } }
[links.1]
points = ["A", "B"]
length = 100
[links.2]
points = ["B"]
on     = "3.s"
[links.3]
on     = "4.x"
guides = { s = { through = [0, 0], angle = 90 } }
[driver]
link = "1"
angle = 50
omega = 12
"""
CYLINDER = """
[frame]
points = { A = [0, 0], C = [400, 0] }
[links.1]
points = ["A", "B"]
length = 300
[links.3]
points = ["C"]
[links.2]
points = ["B"]
on     = "3"
[driver]
slide    = "2"
travel   = 420
velocity = 60
"""


def test_a_swinging_block_slides_on_the_axis_of_its_rod() -> None:
    assert mechanism_of_text(SWINGING_BLOCK, "x").slidings == (Pair.sliding("3", "2", OWN, pin="C"),)


def test_a_yoke_slides_by_its_own_origin_and_carries_a_slot() -> None:
    assert [(s.key, s.guide.name, s.pin) for s in mechanism_of_text(SCOTCH_YOKE, "x").slidings] == [
        ("2/3", "s", "B"), ("3/4", "x", "")]


def test_a_cylinder_drives_by_its_travel() -> None:
    driven = Driver("2", "3", pytest.approx(0.42), pytest.approx(0.06), 0.0, "2/3")
    assert mechanism_of_text(CYLINDER, "x").drivers == (driven,)


def test_the_own_axis_of_the_frame_is_a_guide() -> None:
    scene = read(SCOTCH_YOKE, ('on     = "4.x"', 'on     = "4"'))
    assert (scene.slidings[1].b, scene.slidings[1].guide.name) == ("4", "")


def test_arrays_of_another_library_are_numbers() -> None:
    numpy = pytest.importorskip("numpy")
    scene = mechanism_of({"frame": {"points": {"A": [numpy.float64(0), numpy.int64(0)]}},
                      "links": {"1": {"points": ["A", "B"], "length": numpy.float32(2.5)}}})
    assert scene.by_name["1"].length == pytest.approx(2.5e-3)


def test_a_scene_can_be_read_from_any_line_ending() -> None:
    assert mechanism_of_text(FOUR_BAR.replace("\n", "\r\n"), "x") == mechanism_of_text(FOUR_BAR, "x")


def test_names_are_not_mistaken_for_keys() -> None:
    text = re.sub(r'"3"|links\.3', lambda m: m[0].replace("3", "on"), FOUR_BAR)
    assert mechanism_of_text(text, "x").by_name["on"].bar == ("C", "D")


@pytest.mark.parametrize("key", ["omega", "rpm"])
def test_a_rate_whose_square_is_lost_is_refused(key):
    crank = '[frame]\npoints = { A = [0, 0] }\n[links.1]\npoints = ["A", "B"]\nlength = 1\n'
    text = f'{crank}[driver]\nlink = "1"\nangle = 0\n'
    with pytest.raises(SceneError, match="write 0, or at least 1e-15"):
        mechanism_of_text(f"{text}{key} = 1e-300", "slow")


@pytest.mark.parametrize(("cell", "name", "value"), [
    ("19.5 in/s", "v_B", 19.5 * 0.0254), ("3.2 in", "d_B/C", 3.2 * 0.0254), ("12.5 in./s², up", "a_B", 12.5 * 0.0254),
    ("30 lb-in", "M_2", 30 * 4.4482216152605 * 0.0254), ("30 ft-lb", "M_2", 30 * 4.4482216152605 * 0.3048),
    ("30 lb ft", "M_2", 30 * 4.4482216152605 * 0.3048), ("30 lbs", "F_1/2", 30 * 4.4482216152605),
    ("2 in the clockwise sense", "omega_3", -2.0), ("480 in direction -x", "v_B", 0.48),
])
def test_an_inch_is_a_unit_and_no_word_beside_a_value(cell: str, name: str, value: float) -> None:
    # in a scene in mm "3.2 in" was 3.2 mm
    assert value == pytest.approx(read_cell(cell, Symbol.parse(name), Units(speed="mm/s")).value)
