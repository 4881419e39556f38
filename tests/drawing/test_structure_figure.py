"""The figure of the structure: the count in numbers, and every group in the reverse order of solution."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import pytest

import graphkin
from graphkin.account.notation import Notation
from graphkin.drawing import svg_bytes
from graphkin.drawing.figures.structure import PART
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Polygon, walk
from graphkin.drawing.parts.mechanism_on_paper import MechanismOnPaper
from graphkin.drawing.parts.touching import block_on_circle
from graphkin.drawing.place.piece import ink_box
from graphkin.errors import CallError
from tests.rolling_linkages import Scene, planet_by_a_rod, rack_on_a_rocker, wheel_at_its_rim
from tests.scene.test_circular_slots import with_block, with_pin

SVG = "{http://www.w3.org/2000/svg}"


def drawn(name: str | Scene, driver: str = "", language: str = "en") -> ET.Element:
    figures = graphkin.draw(name, figures=["structure"], driver=driver, language=language).figures
    return ET.fromstring(svg_bytes(figures["structure"]))


@pytest.fixture(scope="module")
def shaper() -> ET.Element:
    return drawn("shaper-scheme-2", "6")


def words(root: ET.Element) -> str:
    return " ".join(" ".join(e.itertext()) for e in root.iter("{http://www.w3.org/2000/svg}text"))


def test_the_groups_of_both_drivers_are_taken_apart(shaper: ET.Element) -> None:
    ids = {e.get("id") for e in shaper.iter()}
    assert {f"group-{driver}-{k}" for driver in ("2", "6-1") for k in (1, 2, 3)} <= ids


def test_the_mobility_stands_there_in_numbers(shaper: ET.Element) -> None:
    assert "moving links n = 5, lower pairs 7, higher pairs 0" in words(shaper)


def test_an_index_is_read_aloud_without_its_markup(shaper: ET.Element) -> None:
    described = shaper.findtext("{http://www.w3.org/2000/svg}desc")
    assert described is not None
    assert described.startswith("F = 3 n − 2 p L − p H = 3 · 5 − 2 · 7 = 1. ")


def test_each_group_tells_its_kind_class_and_joints(shaper: ET.Element) -> None:
    assert "links 5, 6: RRP class II, inner C, outer B, 6/1" in words(shaper)


def test_a_compound_hinge_has_its_badge() -> None:
    assert "badge-B" in {e.get("id") for e in drawn("toggle-press").iter()}


@pytest.mark.parametrize(("scene", "higher"), [(planet_by_a_rod(), True), (wheel_at_its_rim(), False)])
def test_a_wheel_that_rolls_is_a_higher_pair_where_a_link_holds_its_centre(scene: Scene, higher: bool) -> None:
    assert higher == ("badge-K" in {e.get("id") for e in drawn(scene).iter()})


def test_a_follower_is_drawn_to_its_flat_face() -> None:
    # the disc's top lies 40 mm above its centre, which the eccentricity of 15 mm lifts by 15 sin 40
    sheet = graphkin.check("cam-eccentric-flat-slider").sheet
    (face,) = [shape.bars[0] for shape in MechanismOnPaper(sheet, Notation("chinese")).shapes if shape.link == "2"]
    per_mm = sheet.scales.length * 1e3
    assert pytest.approx(40 + 15 * math.sin(math.radians(40))) == face[0].imag * per_mm


@pytest.mark.parametrize(("scene", "blocks"), [(with_pin(), 0), (with_block(), 1)])
def test_a_block_in_a_circular_slot_is_drawn_and_none_for_a_pin(scene: Scene, blocks: int) -> None:
    here = MechanismOnPaper(graphkin.check(scene).sheet, Notation("chinese"))
    assert blocks == sum(bool(block_on_circle(here, link)) for link in here.scene.by_name)


def test_a_driver_that_is_no_link_is_refused() -> None:
    with pytest.raises(CallError, match='driver 9: there is no link "9"'):
        _ = graphkin.draw("shaper-scheme-2", figures=["structure"], driver="9").figures


@pytest.mark.parametrize("wish", [{"driver": "3"}, {"beside": [10, 50]}])
def test_what_belongs_to_one_figure_is_refused_without_it(wish):
    (name,) = wish
    with pytest.raises(CallError, match=f"{name}: is of the figure .* alone; ask for it"):
        graphkin.draw("shaper-scheme-2", figures=["velocity"], **wish)



def test_a_cam_stays_in_its_panel_and_its_rollers_own_turning_is_told() -> None:
    root = drawn("cam-offset-roller")
    cam = next(e for e in root.iter("{http://www.w3.org/2000/svg}g") if e.get("id") == "cam-1")
    shape = next(cam.iter("{http://www.w3.org/2000/svg}polygon"))
    corners = [tuple(map(float, corner.split(","))) for corner in shape.get("points").split()]
    assert min(y for _, y in corners) > 15.0  # below the heading
    assert max(x for x, _ in corners) < 110.0  # left of the words
    assert "own turning" in words(root)
    assert "in a slot" not in words(root)


def test_a_driver_inside_a_group_has_no_empty_panel() -> None:
    root = drawn("scissor-lift", language="zh")
    panels = [e for e in root.iter("{http://www.w3.org/2000/svg}g") if e.get("class") == "panel"]
    assert 1 == len(panels)
    assert "级杆组，" in words(root)


@pytest.fixture(scope="module")
def rack() -> ET.Element:
    figures = graphkin.draw(rack_on_a_rocker(), at=20, figures=["structure"]).figures
    return ET.fromstring(svg_bytes(figures["structure"]))


def test_a_group_with_a_rack_is_as_large_as_its_panel_which_cuts_the_rack(rack: ET.Element) -> None:
    group = next(e for e in rack.iter(f"{SVG}g") if e.get("id") == "group-1-1")
    pins = [[float(e.get(key)) for key in ("cx", "cy")] for e in group.iter(f"{SVG}circle")]
    assert 0.3 * PART[0] < max(x for x, _ in pins) - min(x for x, _ in pins)
    ends = [float(e.get(key)) for e in group.iter(f"{SVG}line") for key in ("x1", "x2")]
    assert max(ends) - min(ends) < PART[0]


def test_a_link_of_a_group_has_one_number(rack: ET.Element) -> None:
    assert 2 == [*map("".join, (e.itertext() for e in rack.iter(f"{SVG}text")))].count("5")  # diagram and group


def test_points_that_serve_the_construction_are_not_on_the_structure() -> None:
    ids = {e.get("id") for e in drawn("loader-cylinder").iter()}
    assert {"point-E"} == {"point-E", "point-S"} & ids


HIGHER = (
    "cam-eccentric-flat-rocker", "cam-eccentric-flat-slider", "cam-flat-face", "cam-offset-roller",
    "cam-swinging-roller", "disc-on-disc", "geared-five-bar", "gears-epicyclic", "geneva-step",
    "hypocycloid-straight-line", "wheel-on-rail",
)


@pytest.mark.parametrize("name", [*HIGHER, "elliptic-trammel", "loader-cylinder", "scissor-lift", "whitworth"])
def test_what_is_taken_apart_stays_in_its_panel(name: str) -> None:
    figure = graphkin.draw(name, figures=["structure"]).figures["structure"]
    groups = [g for layer in figure.children for g in layer.children if isinstance(g, Group)]
    panels = [ink_box(g.children) for g in groups if "panel" in g.classes]
    apart = [ink_box(g.children) for g in groups if g.id.startswith("group-")]
    assert apart
    for panel, drawn in zip(panels, apart, strict=True):
        assert panel.left < drawn.left
        assert drawn.right < panel.right
        assert panel.top < drawn.top
        assert drawn.bottom < panel.bottom


@pytest.mark.parametrize("name", HIGHER)
def test_with_one_freedom_one_link_is_called_the_driver(name: str) -> None:
    said = words(drawn(name))
    assert 1 == said.count("with the frame: class I")
    assert "class 1" not in said


def test_a_wheel_that_follows_is_no_driver() -> None:
    said = words(drawn("gears-epicyclic"))
    assert "link 2 follows: rolling ties it to the driver" in said
    assert "link 3 follows: rolling ties it to the driver" in said
    assert "a mechanism of class" not in said


@pytest.mark.parametrize(
    ("name", "links"),
    [
        ("cam-offset-roller", "links 2, OB: RRP"),
        ("cam-flat-face", "link 2 and the block at O: RPP"),
        ("cam-eccentric-flat-rocker", "link 2 and the block at O: RPR"),
        ("disc-on-disc", "link 2 and the bar OB: RRR"),
        ("geneva-step", "link 2 and the block at B: RPR"),
    ],
)
def test_a_dyad_has_two_links_that_of_the_replacement_among_them(name: str, links: str) -> None:
    assert links in words(drawn(name))


@pytest.mark.parametrize("name", ["cam-offset-roller", "cam-flat-face", "cam-swinging-roller"])
def test_the_mobility_of_a_cam_is_counted_again_after_its_replacement(name: str) -> None:
    assert "F = 3 · 3 − 2 · 4 − 0 = 1" in " ".join(words(drawn(name)).split())


def test_the_bar_that_replaces_a_cam_hangs_on_its_crank() -> None:
    figure = graphkin.draw("cam-offset-roller", figures=["structure"]).figures["structure"]
    groups = {g.id: g for layer in figure.children for g in layer.children if isinstance(g, Group)}
    for key in ("group-1-1", "group-1-2"):
        parts = groups[key].children
        (bar,) = (x for x in parts if isinstance(x, Line) and x.stroke.dash == strokes.REDUNDANT.dash)
        pins = {x.centre for x in parts if isinstance(x, Circle)}
        assert pins == {bar.start, bar.end}


def test_a_wheel_that_rolls_is_replaced_by_no_block() -> None:
    figure = graphkin.draw("wheel-on-rail", figures=["structure"]).figures["structure"]
    assert 1 == sum(isinstance(x, Polygon) for x in walk(figure.children))  # that around its panel


def test_a_block_without_points_is_taken_apart_and_handed_out() -> None:
    scene = {"frame": {"guides": {"g": {"through": [0, 0], "angle": 0}}}, "links": {"1": {"on": "0.g"}},
             "driver": {"slide": "1", "travel": 20, "velocity": 30}}
    figure = graphkin.draw(scene, figures=("structure",)).figures["structure"]
    assert "driver 1 with the frame: class I" in svg_bytes(figure).decode()
    assert 1 == len(graphkin.handout(scene, formats=("html",)).lesson.stages)
