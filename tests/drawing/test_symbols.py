from __future__ import annotations

import math
from types import SimpleNamespace

import pytest

from graphkin import draw
from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polygon, Text, walk
from graphkin.drawing.ink.symbols import (
    block,
    fixed_pivot,
    guide,
    hatched_line,
    hull,
    sense_arc,
    slot,
    turning_pair,
)
from graphkin.drawing.parts.mechanism import _welds
from graphkin.drawing.parts.mechanism_on_paper import LinkShape
from graphkin.drawing.place.dimensions import angle_dimension, check_bar, dimension
from graphkin.drawing.text import plain
from graphkin.drawing.write.drawing import Drawing
from graphkin.drawing.write.svg import svg_bytes


def test_a_turning_pair_is_an_open_circle():
    (circle,) = turning_pair(5 + 5j)
    assert (circle.fill, circle.centre) == (strokes.WHITE, 5 + 5j)


def test_the_foot_of_a_fixed_pivot_stands_below_it():
    assert all(line.start.imag > 10 for line in fixed_pivot(10 + 10j) if isinstance(line, Line))


def test_the_foot_can_point_to_the_right():
    assert all(line.start.real > 10 for line in fixed_pivot(10 + 10j, angle=0.0) if isinstance(line, Line))


def test_hatching_lies_on_the_right_of_the_way():
    _, *hatches = hatched_line(0j, 20 + 0j)
    assert all(hatch.end.imag > 0 for hatch in hatches)


def test_the_hatching_of_a_guide_lies_outside():
    edges = [line for line in guide(0j, 0.0, 30.0, 4.6) if isinstance(line, Line)]
    assert all(abs(line.end.imag) >= 2.3 - 1e-9 for line in edges)


def test_a_guide_has_an_edge_on_either_side_the_left_one_first():
    lines = guide(0j, 0.0, 30.0)
    half = len(lines) // 2
    assert [-1] * half + [1] * half == [math.copysign(1, line.start.imag) for line in lines]


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.5])
def test_the_long_side_of_a_block_lies_along_its_guide(angle):
    (box,) = block(3 + 4j, angle)
    side = (box.points[1] - box.points[0]).conjugate()  # y up
    assert math.atan2(side.imag, side.real) == pytest.approx(angle)


def test_a_slot_reaches_half_its_width_past_its_centres():
    arcs = [shape for shape in slot(10 + 10j, 30 + 10j, width=2.6) if isinstance(shape, Arc)]
    assert pytest.approx(max(arc.at((arc.start + arc.end) / 2).real for arc in arcs)) == 31.3


def test_the_hull_of_points_has_none_within():
    assert {0j, 10 + 0j, 5 + 8j} == set(hull((0j, 10 + 0j, 5 + 8j, 5 + 3j)))


def test_points_on_a_line_have_no_area():
    assert {0j, 20 + 10j} == set(hull((0j, 20 + 10j, 10 + 5j)))


def test_the_area_of_a_link_is_a_light_tint_of_its_colour():
    (link,) = [one for one in walk(draw("four-bar-coupler-point", figures=["mechanism"]).figures["mechanism"].children)
               if isinstance(one, Group) and one.id == "link-2"]
    area = next(one for one in link.children if isinstance(one, Polygon))
    assert strokes.tint(area.stroke.colour) == area.fill


@pytest.mark.parametrize("sense", [1, -1])
def test_the_arrowhead_of_a_sense_points_along_the_turn(sense):
    arc, head = sense_arc(0j, 8.0, 0.3, sense)
    tip, base = head.points[0], (head.points[1] + head.points[2]) / 2
    turn = (base.conjugate() * tip).imag  # y down: negative is counter-clockwise
    assert math.copysign(1, -turn) == sense
    assert arc.radius == 8.0


def test_an_acceleration_has_two_arrowheads():
    assert sum(isinstance(shape, Polygon) for shape in sense_arc(0j, 8.0, 0.3, 1, heads=2)) == 2


def test_the_check_bar_is_fifty_millimetres_long():
    bar = check_bar(10 + 10j, plain("50 mm"))[0]
    assert abs(bar.end - bar.start) == 50.0


@pytest.mark.parametrize("length", [3.0, 8.0, 20.0, 80.0])
@pytest.mark.parametrize("way", [1, 1j, 0.6 + 0.8j, -0.8 + 0.6j])
def test_the_number_of_a_dimension_is_crossed_by_no_line(violations, length, way):
    parts = dimension(100 + 100j, 100 + 100j + length * way, 9.0, plain("122.5"))
    assert violations(svg_bytes(Drawing(250.0, 250.0, parts))) == []


def test_the_arrowheads_of_a_dimension_stand_on_the_extension_lines():
    tips = {part.points[0] for part in dimension(0j, 40 + 0j, 9.0, plain("40")) if isinstance(part, Polygon)}
    assert tips == {9j, 40 + 9j}


def test_the_number_of_an_angle_stands_clear_of_its_arc(violations):
    parts = angle_dimension(100 + 100j, 14.0, 0.0, math.radians(50), plain("50°"))
    assert violations(svg_bytes(Drawing(200.0, 200.0, parts))) == []


def test_every_symbol_is_of_known_primitives():
    shapes = (*fixed_pivot(9 + 9j), *guide(9 + 9j, 0.0, 20.0), *slot(0j, 9 + 0j), *check_bar(0j, plain("50 mm")))
    assert {type(shape) for shape in shapes} <= {Line, Polygon, Circle, Arc, Text}


def test_a_fixed_pivot_is_small_beside_a_mechanism():
    lines = [line for line in fixed_pivot(0j) if isinstance(line, Line)]
    box = Box.around(point for line in lines for point in (line.start, line.end))
    assert max(box.width, box.height) < 8.5


@pytest.mark.parametrize(("length", "inside"), [(40.0, True), (3.0, False)])
def test_the_arrowheads_of_a_short_dimension_stand_outside_it(length, inside):
    heads = [part for part in dimension(0j, length + 0j, 8.0, plain("3", 2.8)) if isinstance(part, Polygon)]
    assert [inside] * 2 == [all(-1e-9 <= z.real <= length + 1e-9 for z in head.points) for head in heads]


@pytest.mark.parametrize(("places", "welds"), [({}, 1), ({"B": 10 + 0j}, 0)])
def test_two_bars_of_a_link_are_welded_where_no_joint_is(places, welds):
    shape = LinkShape("2", {}, bars=((0j, 10 + 0j), (10 + 0j, 10 + 10j)))
    assert welds == len(_welds(SimpleNamespace(places=places), shape, strokes.BLACK))
