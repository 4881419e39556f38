"""Leaders go round what they do not name: joints, arrowheads, vectors; numbers of steps stand at their own vector."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from functools import cache

import pytest
import shapely

from graphkin import draw
from graphkin.drawing import Box, Text
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, walk
from graphkin.drawing.place.numbers import beside_ring, step_numbers
from graphkin.drawing.place.obstacles import Obstacles
from graphkin.drawing.text import text_box

SVG = "{http://www.w3.org/2000/svg}"
drawn = cache(draw)


def line(element: ET.Element) -> shapely.LineString:
    x1, y1, x2, y2 = (float(element.get(key)) for key in ("x1", "y1", "x2", "y2"))
    return shapely.LineString([(x1, y1), (x2, y2)])


def read(scene: str, figure: str) -> tuple[list[shapely.LineString], list[shapely.LineString], list[shapely.Polygon]]:
    """Leaders, lines of vectors, and joints of a finished figure."""
    root = ET.fromstring(drawn(scene).figures[figure].content("svg"))
    groups = list(root.iter(f"{SVG}g"))
    labels = next(group for group in groups if group.get("id") == "labels")
    vectors = [line(group[0]) for group in groups if "vector" in (group.get("class") or "").split()]
    circles = [c for c in root.iter(f"{SVG}circle") if float(c.get("r")) <= 1.6]
    joints = [shapely.Point(float(c.get("cx")), float(c.get("cy"))).buffer(float(c.get("r"))) for c in circles]
    return [line(one) for one in labels if one.tag == f"{SVG}line"], vectors, joints


FIVE = ("mechanism", "velocity", "acceleration", "sheet", "centres")


@pytest.mark.parametrize(("scene", "figure"), [
    *(("sixbar-AE70", figure) for figure in FIVE), *(("sixbar-1A-last-link", figure) for figure in FIVE),
    ("double-butterfly", "sheet"),
])
def test_no_leader_runs_through_a_joint(scene, figure):
    leaders, _, joints = read(scene, figure)
    assert not [one for one in leaders for joint in joints
                if one.intersects(joint) and joint.distance(shapely.Point(one.coords[0])) > 1.3]


@pytest.mark.parametrize("scene", ["sixbar-AE70", "shaper-scheme-2", "sixbar-guide-40deg"])
def test_hardly_a_leader_runs_across_a_velocity(scene):
    leaders, vectors, _ = read(scene, "velocity")
    crossed = [one for one in leaders for vector in vectors
               if one.intersects(vector) and vector.distance(shapely.Point(one.coords[0])) > 0.45]
    assert len(crossed) <= 1


def test_what_a_crowd_has_no_room_for_is_listed_behind_the_number_of_its_step():
    root = ET.fromstring(drawn("loader-cylinder").figures["sheet"].content("svg"))
    texts = {text.get("id"): text for text in root.iter(f"{SVG}text") if text.get("id")}
    listed = {id.removeprefix("listed-"): text for id, text in texts.items() if id.startswith("listed-label-")}
    numbered = {id: entry for id, entry in listed.items() if id in texts}  # others by end letters
    assert numbered
    assert all("→" in "".join(entry.itertext()) for id, entry in listed.items() if id not in numbered)
    for id, entry in numbered.items():
        (step,) = {c for c in texts[id].get("class").split() if c.startswith("step-") and c != "step-number"}
        groups = [g for g in root.iter(f"{SVG}g") if step in (g.get("class") or "").split()]
        number = f"({int(step.removeprefix('step-'))})"
        wanted = "direction" if id.startswith("label-direction-") else id.removeprefix("label-")
        assert wanted in [name for g in groups for name in (g.get("id"), *g.get("class").split())]
        assert number == "".join(texts[id].itertext())
        assert "".join(entry.itertext()).startswith(number)
        assert len("".join(entry.itertext())) > len(number)


@pytest.mark.parametrize(("scene", "figure", "one", "other"), [
    ("slotter-75-150", "sheet", "label-velocity-C", "label-direction-17"),
    ("sixbar-guide-40deg", "velocity", "label-velocity-D", "label-direction-15"),
])
def test_letters_on_one_line_do_not_run_together(scene, figure, one, other):
    texts = {thing.id: thing for thing in walk(drawn(scene).figures[figure].children) if isinstance(thing, Text)}
    a, b = text_box(texts[one]), text_box(texts[other])
    assert max(a.left - b.right, b.left - a.right) >= 1.7 or max(a.top - b.bottom, b.top - a.bottom) >= 0.9


def test_the_letter_of_a_small_foot_stands_in_its_inset_alone():
    root = ET.fromstring(drawn("sixbar-AE70").figures["acceleration"].content("svg"))
    letters = [text.get("id") for text in root.iter(f"{SVG}text") if "foot-an_C-B" in (text.get("id") or "")]
    assert letters == ["label-detail-foot-an_C-B"]


def crossed(scene: str, figure: str) -> int:
    leaders, vectors, _ = read(scene, figure)
    foot = shapely.Point
    return sum(one.intersects(vector) and vector.distance(foot(one.coords[0])) > 0.45
               for one in leaders for vector in vectors)


@pytest.mark.parametrize("scene", ["shaper-forces", "hit-two-RPR", "hydraulic-cylinder", "boom-lifted"])
def test_no_leader_of_these_sheets_runs_across_a_vector(scene):
    assert crossed(scene, "sheet") == 0


@pytest.mark.parametrize(("scene", "figure"), [
    ("sixbar-rotating-guide-35rpm", "velocity"), ("sixbar-1A-last-link", "acceleration"), ("wheel-on-rail", "sheet"),
    ("disc-on-disc", "acceleration"), ("double-butterfly", "sheet"),
])
def test_a_name_with_no_room_makes_others_move_before_its_leader_runs_across_two_vectors(scene, figure):
    assert crossed(scene, figure) <= 1


def texts_of(scene: str, figure: str, **options: str) -> dict[str, str]:
    root = ET.fromstring(drawn(scene, **options).figures[figure].content("svg"))
    return {text.get("id"): "".join(text.itertext()) for text in root.iter(f"{SVG}text") if text.get("id")}


@pytest.mark.parametrize(("scene", "figure"), [
    ("disc-on-disc", "acceleration"), ("disc-on-disc", "sheet"), ("disc-on-disc", "contacts-2"),
    ("loader-cylinder", "sheet"), ("sixbar-rotating-guide-scheme2", "sheet"),
])
def test_no_leader_runs_across_a_vector_in_a_crowd(scene, figure):
    assert crossed(scene, figure) == 0


def test_a_vector_with_no_room_even_for_its_number_is_told_by_the_letters_of_its_ends():
    texts = texts_of("disc-on-disc", "contacts-2")
    assert texts["listed-label-a_O"].replace(" ", "") == "(18)aO:p′→o′"
    assert "label-a_O" not in texts


def test_an_auxiliary_vector_with_no_room_for_its_name_is_told_by_the_number_of_its_step():
    texts = texts_of("scissor-lift", "velocity")
    assert texts["listed-label-special-v_Q-Q3"].replace(" ", "") == "(16)vQ7Q3"
    assert texts["label-special-v_Q-Q3"] == "(16)"
    assert crossed("scissor-lift", "velocity") == 0


def test_a_force_with_no_room_for_its_name_is_told_by_the_letters_of_its_corners():
    texts = texts_of("sine-mechanism-forces", "forces", convention="us")
    assert texts["listed-label-F_1-2-t"].replace(" ", "") == "F12t:g→a"
    assert "label-F_1-2-t" not in texts


def test_a_letter_without_a_clear_place_stands_in_an_inset_with_a_ring_about_its_point():
    root = ET.fromstring(drawn("scissor-lift").figures["velocity"].content("svg"))
    texts = texts_of("scissor-lift", "velocity")
    assert "label-velocity-P" not in texts
    assert texts["label-detail-velocity-P"] == "p3"
    point = next(group for group in root.iter(f"{SVG}g") if group.get("id") == "velocity-P")
    ring = next(group for group in root.iter(f"{SVG}g") if group.get("id") == "ring-velocity-1")
    dot, around = (next(group.iter(f"{SVG}circle")) for group in (point, ring))
    at, middle = (shapely.Point(float(one.get("cx")), float(one.get("cy"))) for one in (dot, around))
    assert at.distance(middle) < float(around.get("r"))


@pytest.mark.parametrize("scene", ["boom-lifted", "toggle-press-force"])
def test_letters_of_corners_stand_clear_of_the_forces_of_their_polygon(scene):
    assert crossed(scene, "forces") == 0


def test_a_compass_arc_runs_over_the_block_whose_pin_it_finds_and_under_the_pin():
    layers = {group.id: group for group in drawn("slider-crank-offset").figures["mechanism"].children}
    order = [one.id or " ".join(one.classes) for one in layers["mechanism"].children]
    assert order.index("link-3") < order.index("compass") < order.index("point-C")


def test_the_crossing_of_the_arcs_that_find_a_tangent_is_joined_to_the_pivot_of_its_guide():
    # the arcs crossed at an empty place
    layers = {group.id: group for group in drawn("cam-eccentric-flat-rocker").figures["mechanism"].children}
    ((line,),) = (group.children for group in layers["construction"].children if "tangent" in group.classes)
    arcs = [thing for group in layers["construction"].children if "compass" in group.classes
            for thing in walk(group.children) if isinstance(thing, Arc)]
    crossing = [arc for arc in arcs if abs(abs(line.start - arc.centre) - arc.radius) < 1e-9]
    assert 2 == len(crossing)
    pivot = next(group for group in layers["mechanism"].children if group.id == "point-O")
    assert line.end == pytest.approx(next(one.centre for one in walk(pivot.children) if isinstance(one, Circle)))


def test_a_number_without_room_at_its_vector_stands_beside_its_name():
    texts = [thing for thing in walk(drawn("disc-on-disc").figures["acceleration"].children) if isinstance(thing, Text)]
    (number,) = [text_box(text) for text in texts if text.string == "(28)"]
    (name,) = [text_box(text) for text in texts if text.id == "label-a_B"]
    assert max(number.left - name.right, name.left - number.right, number.top - name.bottom,
               name.top - number.bottom) == pytest.approx(0.5)


@pytest.mark.parametrize(("scene", "point"), [("toggle-press", "B"), ("sixbar-420rpm", "C")])
def test_no_compass_arc_runs_along_a_bar_so_close_that_it_looks_like_a_splinter_of_it(scene, point):
    layers = {group.id: group for group in drawn(scene).figures["mechanism"].children}
    things = [group for layer in layers.values() for group in layer.children if isinstance(group, Group)]
    joint = next(group for group in things if group.id == f"point-{point}")
    at = next(thing.centre for thing in walk(joint.children) if isinstance(thing, Circle))
    arcs = [thing for group in things if "compass" in group.classes for thing in walk(group.children)]
    ends = [end for arc in arcs for end in (arc.at(arc.start), arc.at(arc.end))
            if abs(abs(arc.centre - at) - arc.radius) < 1e-6 and 1.0 < abs(end - at) < 8.0]
    bars = [shapely.LineString([(z.real, z.imag) for z in (arc.centre, at)]) for arc in arcs
            if abs(abs(arc.centre - at) - arc.radius) < 1e-6]
    assert len(bars) == 2
    assert ends
    assert min(bar.distance(shapely.Point(end.real, end.imag)) for bar in bars for end in ends) > 1.2


def test_no_vector_runs_between_a_point_and_its_letter_that_has_no_leader():
    scene, figure, point = "double-butterfly", "acceleration", "pole-acceleration"
    things = [*walk(drawn(scene).figures[figure].children)]
    at = next(thing.centre for thing in walk(next(one for one in things if isinstance(one, Group) and one.id == point)
                                             .children) if isinstance(thing, Circle))
    index = next(i for i, one in enumerate(things) if isinstance(one, Text) and one.id == f"label-{point}")
    near = text_box(things[index]).nearest(at)
    way = shapely.LineString([(z.real, z.imag) for z in (at + 0.45 * (near - at) / abs(near - at), near)])
    _, vectors, _ = read(scene, figure)
    assert isinstance(things[index - 1], Line) or not any(vector.intersects(way) for vector in vectors)


def test_the_number_of_the_step_of_a_short_vector_stands_before_its_name():
    texts = texts_of("slotter-75-150", "acceleration")
    assert "(25)aA3O3n" == texts["label-an_A3-O3"].replace(" ", "")
    assert "aA3" == texts["label-a_A3"].replace(" ", "")  # a long one has it elsewhere


def test_a_vector_that_is_carried_over_has_its_name_in_a_crowd_too():
    assert "aB3B2k" == texts_of("boom-lifted", "sheet")["label-carried-ak_B3-B2"].replace(" ", "")


def test_the_leader_of_a_rings_numeral_ends_before_it(violations):
    drawing = draw("double-butterfly", at=110, figures=["acceleration"], language="en", convention="russian")
    assert [] == violations(drawing.figures["acceleration"].content("svg"))


@pytest.mark.parametrize(("other", "above"), [(53.6, True), (60.0, False)])
def test_the_number_of_a_step_stands_where_no_other_vector_is_nearer(other: float, above: bool) -> None:
    ends = (20 + 50j, 80 + 50j), (20 + 1j * other, 80 + 1j * other)
    arrows = [(step, each, None) for step, each in zip((7, 8), ends, strict=True)]
    (number,) = step_numbers(arrows, {8}, Box(0.0, 0.0, 100.0, 100.0), Obstacles(solid=ends))
    assert above == (text_box(number).centre.imag < 50.0)


@pytest.mark.parametrize(("taken", "led"), [(2.0, False), (9.0, True)])
def test_a_numeral_far_from_its_ring_has_a_leader_from_its_edge(taken: float, led: bool) -> None:
    centre, panel = 50 + 50j, Box(0.0, 0.0, 100.0, 100.0)
    around = Obstacles(areas=(Box(50 - taken, 50 - taken, 50 + taken, 50 + taken),))
    place = beside_ring(Box(0.0, 0.0, 2.0, 2.0), centre, 3.0, around, panel)
    assert place is not None
    middle, leader = place
    assert led == (leader is not None)
    assert leader is None or 3.0 == pytest.approx(abs(leader[0] - centre))
    assert not around.areas[0].holds(Box.around((middle,)))
