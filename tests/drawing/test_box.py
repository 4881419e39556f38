from __future__ import annotations

import pytest

from graphkin.drawing.box import Box

pytestmark = pytest.mark.quick

BOX = Box(0.0, 0.0, 10.0, 5.0)


def test_a_segment_is_cut_where_it_leaves_the_box():
    assert BOX.clip(-5 + 2j, 15 + 2j) == (0 + 2j, 10 + 2j)


def test_a_segment_keeps_its_sense_when_cut():
    assert BOX.clip(15 + 2j, -5 + 2j) == (10 + 2j, 0 + 2j)


def test_a_segment_inside_is_not_touched():
    assert BOX.clip(1 + 1j, 3 + 4j) == (1 + 1j, 3 + 4j)


def test_a_segment_past_a_corner_is_gone():
    assert BOX.clip(-1 + 4j, 2 + 7.1j) is None


@pytest.mark.parametrize("through", [3 + 2j, 3 + 200j, -1e4 - 1e4j + (3 + 2j)])
def test_an_endless_line_reaches_both_edges(through):
    start, end = BOX.clip_line(complex(3, through.imag), 1j)
    assert (pytest.approx(3.0), pytest.approx(0.0), pytest.approx(5.0)) == (start.real, start.imag, end.imag)


def test_an_endless_line_beside_the_box_is_gone():
    assert BOX.clip_line(11 + 2j, 1j) is None


def test_boxes_that_only_touch_do_not_overlap():
    assert not BOX.overlaps(Box(10.0, 0.0, 12.0, 5.0))


def test_the_distance_from_a_corner_is_straight():
    assert BOX.distance(13 + 9j) == pytest.approx(5.0)


def test_a_box_shrinks_at_most_to_nothing():
    assert BOX.grown(-9).height == 0.0
