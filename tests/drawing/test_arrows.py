from __future__ import annotations

import pytest

from graphkin.drawing.ink import symbols as arrows
from graphkin.drawing.ink.primitives import Circle, Line, class_names
from graphkin.drawing.ink.symbols import arrow, head_size, vector_group

pytestmark = pytest.mark.quick


def test_the_line_runs_from_tail_to_tip_exactly():
    line, _ = arrow(1 + 2j, 51.123 + 7j)
    assert (line.start, line.end) == (1 + 2j, 51.123 + 7j)


def test_the_tip_of_the_arrowhead_is_the_tip_of_the_vector():
    _, head = arrow(0j, 40 + 30j)
    assert head.points[0] == 40 + 30j


@pytest.mark.parametrize(
    ("kind", "stated"), [(arrows.RESULTANT, (0.5, 3.0, 1.0)), (arrows.COMPONENT, (0.35, 2.5, 0.8))]
)
def test_line_and_arrowhead_have_the_sizes_of_the_standard(kind, stated):
    assert stated == (kind.stroke.width, *head_size(kind, 50.0))


@pytest.mark.parametrize("length", [0.05, 0.5, 1.0, 2.0, 3.5])
def test_a_short_vector_keeps_a_shaft_under_a_smaller_arrowhead(length):
    assert head_size(arrows.RESULTANT, length)[0] <= 0.75 * length


@pytest.mark.parametrize("length", [0.05, 1.0, 2.0, 3.5, 60.0])
@pytest.mark.parametrize("kind", [arrows.RESULTANT, arrows.COMPONENT])
def test_the_arrowhead_hides_the_end_of_the_inked_line(kind, length):
    line, _ = arrow(0j, complex(length), kind)
    head, width = head_size(kind, length)
    assert width * (length - line.inked_end.real) / head >= kind.stroke.width - 1e-12


def test_a_zero_vector_is_a_line_of_no_length_and_a_dot():
    line, dot = arrow(3 + 3j, 3 + 3j)
    assert (Line, Circle, line.end) == (type(line), type(dot), 3 + 3j)


def test_a_vector_group_begins_with_its_line():
    assert isinstance(vector_group("v_B", 7, 0j, 10 + 0j).children[0], Line)


def test_a_vector_group_says_its_step():
    group = vector_group("v_B", 7, 0j, 10 + 0j)
    assert class_names(group.classes, group.step) == ("vector", "step-07")
