"""The figure of several positions: limit positions, numbered ones, and what is measured of the whole turn."""

from __future__ import annotations

import cmath
import math
import xml.etree.ElementTree as ET

import pytest

import graphkin
from graphkin.api.drawn import Drawn
from graphkin.drawing import svg_bytes
from graphkin.drawing.ink.primitives import Group, Line, Text, on_page, walk
from graphkin.drawing.place.piece import obstacles_of
from graphkin.drawing.text import text_box
from graphkin.drawing.write.drawing import Drawing
from graphkin.errors import Unsolvable
from graphkin.papers.pictures import bare_picture
from graphkin.scene import Scene
from tests.mechanisms import floating_cylinder, redriven

FOUR_BAR = graphkin.read("fourbar-150-500-300-400").to_dict() | {"positions": {"count": 4, "first": 0}}


@pytest.fixture(scope="module")
def figure() -> ET.Element:
    return ET.fromstring(svg_bytes(graphkin.draw(FOUR_BAR, figures=["positions"]).figures["positions"]))


def ids(root: ET.Element) -> set[str]:
    return {str(e.get("id")) for e in root.iter() if e.get("id")}


def test_limit_and_numbered_positions_are_drawn(figure: ET.Element) -> None:
    wanted = {"limit-3-low", "limit-3-high", *(f"position-{k}" for k in range(1, 5))}
    assert wanted <= ids(figure)


def test_numbers_stand_at_the_cranks_pins(figure: ET.Element) -> None:
    assert {f"label-position-{k}" for k in range(1, 5)} <= ids(figure)


def test_the_coupler_points_path_and_the_least_transmission_angle_are_there(figure: ET.Element) -> None:
    assert {"path-M", "least-gamma"} <= ids(figure)


def test_the_least_transmission_angle_is_that_with_the_crank_along_the_frame(figure: ET.Element) -> None:
    (text,) = (e for e in figure.iter() if e.get("id") == "label-least-gamma")
    assert "22.332°" in "".join(text.itertext())


def test_a_scene_with_positions_has_the_figure_by_itself() -> None:
    wanted = graphkin.draw(FOUR_BAR).wanted
    assert ("mechanism", "velocity", "acceleration", "sheet", "centres", "positions") == wanted


def test_what_is_measured_stays_with_the_figure_where_its_titles_are_left_out() -> None:
    bare = bare_picture(graphkin.draw(FOUR_BAR, figures=["positions"]).figures["positions"])
    written = [e for e in ET.fromstring(svg_bytes(bare)).iter() if e.tag.endswith("}text")]
    assert any("1.366094" in "".join(text.itertext()) for text in written)


@pytest.mark.parametrize("name", ["shaper-forces", "fourbar-150-500-300-400", "whitworth"])
def test_no_line_runs_through_a_stroke_an_angle_or_the_swing(name: str) -> None:
    drawing = graphkin.draw(name, figures=["positions"]).figures["positions"]
    ink = obstacles_of(drawing.children)
    boxes = {
        thing.string: text_box(thing)
        for group in drawing.children if group.id == "answers"
        for thing in walk(group.children) if isinstance(thing, Text)
    }
    assert boxes
    struck = [words for words, box in boxes.items() if any(box.clip(*line) for line in (*ink.solid, *ink.dashed))]
    assert [] == struck


def limits_alone(driver: str) -> dict[str, object]:
    """A crank-rocker whose `[positions]` ask for nothing but the limits, driven by its crank 2 or its rocker 4."""
    return {
        "frame": {"name": "1", "points": {"A": [0, 0], "D": [100, 0]}},
        "links": {
            "2": {"points": ["A", "B"], "length": 30},
            "3": {"points": ["B", "C"], "length": 90},
            "4": {"points": ["D", "C"], "length": 60},
        },
        "driver": {"link": driver, "angle": {"2": 60, "4": 110}[driver], "omega": 2},
        "positions": {"show": ["limits"]},
    }


def words_of(drawn: Drawn) -> str:
    parts = walk(drawn.figures["positions"].children)
    return " ".join("".join(run.text for run in part.runs) for part in parts if isinstance(part, Text))


@pytest.mark.parametrize(
    ("language", "said"),
    [
        ("en", "No limit positions are drawn (ψ2: belongs to a whole turn, but driver 4 does not turn fully (it"),
        ("zh", "未画极限位置（ψ2：属于整周运动，但原动件 4 不能转整周（"),
    ],
)
def test_limits_that_there_are_not_are_said_not_to_be(language: str, said: str) -> None:
    drawn = graphkin.draw(limits_alone("4"), figures=["positions"], language=language)
    assert said in words_of(drawn)


@pytest.fixture
def parallelogram() -> Scene:
    """Two cranks of 150 on a frame of 400, whose links lie in line twice a turn."""
    scene = graphkin.read("fourbar-150-500-300-400").replace("links.2.length", 400)
    return scene.replace("links.3.length", 150)


@pytest.mark.parametrize(("language", "said"), [
    ("en", "= 0°, is not drawn (links 2, 3: the RRR group stands at a dead point, its"),
    ("zh", "= 0°（构件 2、3：RRR 杆组处于死点，其轨迹只相切）。"),
])
def test_why_the_least_transmission_angle_of_a_change_point_is_not_drawn_is_said(
    parallelogram: Scene, language: str, said: str
) -> None:
    assert said in words_of(graphkin.draw(parallelogram, figures=["positions"], language=language))


def test_a_least_transmission_angle_too_small_for_an_arc_has_its_number(parallelogram: Scene) -> None:
    scene = parallelogram.replace("links.3.length", 150.001)
    # arccos((400² + 150.001² - 250²) / (2 · 400 · 150.001))
    assert "γmin= 0.1654°" in words_of(graphkin.draw(scene, figures=["positions"], language="en"))


def test_a_named_position_in_a_change_point_is_called_a_dead_point(parallelogram: Scene) -> None:
    scene = parallelogram.replace("positions", {"count": 4, "first": 0})
    for figure in ("positions", "polygons"):
        with pytest.raises(Unsolvable, match="dead point: links 2, 3 have BC and CD in line"):
            graphkin.draw(scene, figures=[figure]).figures[figure]


def test_the_angle_at_which_a_driver_stops_has_the_minus_sign_of_print() -> None:
    mirrored = limits_alone("4") | {"driver": {"link": "4", "angle": -110, "omega": 2}, "sketch": {"B": [0, -30]}}
    drawn = graphkin.draw(mirrored, figures=["positions"], language="en")
    assert "(it stops near −86.18 deg)" in words_of(drawn)


def test_limits_that_there_are_need_no_number_of_positions() -> None:
    drawn = graphkin.draw(limits_alone("2"), figures=["positions"], language="en")
    assert (b"limit-4-low" in svg_bytes(drawn.figures["positions"]), "No limit" in words_of(drawn)) == (True, False)


@pytest.mark.parametrize("driver", ["2", "4"])
def test_a_scene_that_shows_its_limits_alone_has_tables_of_a_turn(driver: str) -> None:
    assert len(graphkin.sweep(limits_alone(driver)).table) == 36
    assert graphkin.course_design(limits_alone(driver)).ok


@pytest.fixture(scope="module")
def cam_with_dwells() -> Drawing:
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"g": {"through": "A", "angle": 90}}},
        "links": {"1": {"points": ["A"], "at": {"E": [20, 0]}}, "2": {"points": ["B"], "on": "0.g"}},
        "cams": {"1": {"follower": "2", "base": {"r": 80}, "law": [
            {"to": 60, "rise": 20, "by": "345"}, {"to": 160}, {"to": 340, "fall": 20, "by": "345"}, {"to": 360},
        ]}},
        "driver": {"link": "1", "angle": 30, "omega": 10},
    }
    return graphkin.draw(scene, figures=["positions"]).figures["positions"]


def test_a_cam_with_dwells_has_no_angle_between_two_positions_of_it_and_no_path_of_bars_in_its_place(
    cam_with_dwells: Drawing,
) -> None:
    figure = ET.fromstring(svg_bytes(cam_with_dwells))
    drawn = {id for id in ids(figure) if id.startswith(("theta", "out", "back", "least", "path"))}
    assert set() == drawn


def lines_at_limits(drawing: Drawing) -> list[list[Line]]:
    """The lines of the low limit position and those of the high one: the cam's from A to E, then the follower's."""
    limits = [t for t in walk(drawing.children) if isinstance(t, Group) and t.id.startswith("limit-")]
    return [[t for t in limit.children if isinstance(t, Line)] for limit in sorted(limits, key=lambda g: g.id)][::-1]


def test_the_limits_of_a_follower_lie_its_lift_apart(cam_with_dwells: Drawing) -> None:
    (_, low), (_, high) = lines_at_limits(cam_with_dwells)
    assert pytest.approx(-10.0j) == high.start - low.start  # 20 mm at 1:2, y down


def test_a_cam_stands_at_the_end_of_a_dwell_where_its_follower_has_its_limit(cam_with_dwells: Drawing) -> None:
    arms = [on_page(cam.end - cam.start) for cam, _ in lines_at_limits(cam_with_dwells)]
    assert pytest.approx([0.0, 160.0]) == [math.degrees(cmath.phase(arm)) for arm in arms]


STOPPED = {
    "frame": {"name": "0", "points": {"A": [0, 0], "D": [100, 0], "G": [-120, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 30}, "2": {"points": ["B", "C"], "length": 90},
        "3": {"points": ["D", "C"], "length": 60}, "4": {"points": ["B", "E"], "length": 60},
        "5": {"points": ["G", "E"], "length": 40},
    },
    "driver": {"link": "1", "angle": 160, "omega": 10},
}


@pytest.mark.parametrize(("scene", "wanted"), [
    (floating_cylinder(900), {
        "No limit positions are drawn (ψ1: belongs to a whole turn, but the driver slides).",
        "未画极限位置（ψ1：属于整个循环，但原动件是移动的）。",
    }),
    (STOPPED, {"No limit positions are drawn (ψ3: driver 1 at 389.926435 deg: the motion does not reach it)."}),
])
def test_why_no_limit_positions_are_drawn_is_said_whole_in_both_languages(
    scene: dict[str, object], wanted: set[str]
) -> None:
    figure = graphkin.draw(scene, figures=["positions"], language="both").figures["positions"]
    lines = {thing.string for thing in walk(figure.children) if isinstance(thing, Text)}
    assert set() == wanted - lines, lines


def test_no_angle_theta_is_drawn_of_a_crank_that_is_driven_from_another_moving_link() -> None:
    scene = redriven(5333)  # 1 is driven from 4: theta is one of its turning from there
    drawn = graphkin.draw(scene, figures=["positions"], language="en")
    answers = next(group for group in drawn.figures["positions"].children if group.id == "answers")
    texts = [thing.string for thing in walk(answers.children) if isinstance(thing, Text)]
    assert (["ψ= 57.728°"], True) == (texts, "θ= 12.78882°" in words_of(drawn))


def test_a_swing_that_is_no_mark_has_no_dimension(figure: ET.Element) -> None:
    scene = FOUR_BAR | {"positions": {"count": 4, "first": 0, "marks": ["K"]}}
    without = ET.fromstring(svg_bytes(graphkin.draw(scene, figures=["positions"]).figures["positions"]))
    texts = (["".join(e.itertext()) for e in root.iter() if e.tag.endswith("}text")] for root in (figure, without))
    assert [2, 1] == [sum("ψ" in text for text in some) for some in texts]  # in words it is told all the same
