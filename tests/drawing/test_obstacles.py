"""What takes the first free of its places."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.drawing.box import Box
from graphkin.drawing.place.obstacles import Obstacles, cheapest, clearest, first_free, free_boxes, short_buffers

PANEL = Box(0.0, 0.0, 100.0, 100.0)
HALF = 3 + 2j
PLACES = np.array((20 + 20j, 50 + 50j, 80 + 80j))
LINE, BOX = ((20 - 5j, 20 + 40j),), (Box(48.0, 48.0, 52.0, 52.0),)


@pytest.mark.parametrize(("around", "index"), [
    (Obstacles(), 0),
    (Obstacles(solid=LINE), 1),
    (Obstacles(dashed=LINE), 1),
    (Obstacles(solid=LINE, areas=BOX), 2),
    (Obstacles(solid=LINE, areas=(*BOX, Box(70.0, 70.0, 90.0, 90.0))), None),
])
def test_a_box_takes_the_first_of_its_places_on_which_nothing_stands(around, index):
    assert [index] == first_free([PLACES], [HALF], around, 0.5)


@pytest.mark.parametrize(("clear", "index"), [(0.9, 0), (1.1, 1)])
def test_a_box_stands_so_far_off_what_is_drawn_and_off_the_edge_of_its_panel(clear, index):
    beside = Obstacles(solid=((24 + 0j, 24 + 40j),))
    assert [index] == first_free([PLACES], [HALF], beside, clear)
    at_the_edge = np.array((4 + 20j, 50 + 50j))
    assert [index] == first_free([at_the_edge], [HALF], Obstacles(), clear, PANEL)


def test_boxes_are_in_the_way_of_those_behind_them():
    apart = np.array((20 + 20j, 26 + 20j, 26.4 + 20j, 27 + 20j))
    assert [0, 2] == first_free([apart, apart], [HALF, HALF], Obstacles(), 0.3)
    assert [0, 1] == first_free([apart, apart], [HALF, HALF], Obstacles(), 0.0)


def test_a_place_that_is_none_is_not_taken():
    nowhere = complex(np.nan, np.nan)
    assert [None, 1] == first_free([np.array([nowhere]), np.array((nowhere, 5 + 5j))], [HALF] * 2, Obstacles(), 0.5)


def test_boxes_at_the_edge_of_a_panel_begin_in_its_corners():
    found = free_boxes(3, (20.0, 10.0), PANEL, Obstacles(areas=(Box(90.0, 90.0, 99.0, 99.0),)))
    assert [Box(0.0, 90.0, 20.0, 100.0), Box(80.0, 0.0, 100.0, 10.0), Box(0.0, 0.0, 20.0, 10.0)] == found
    assert [] == free_boxes(1, (120.0, 10.0), PANEL, Obstacles())


WALL = np.array([(0j, 10 + 0j)])


def test_the_place_that_wants_room_which_a_stroke_takes_pays_for_what_is_lacking():
    middles = np.array([[5 + 1j], [5 + 3j]])  # the nearer place lacks 2 mm, the further one none
    assert 1 == clearest(np.array([0.0, 1.5]), ((middles, 3.0, 1.0),), WALL)
    assert 0 == clearest(np.array([0.0, 2.5]), ((middles, 3.0, 1.0),), WALL)
    assert 1 == clearest(np.array([0.0, 2.5]), ((middles, 3.0, 1.5),), WALL)


def test_of_places_that_cost_alike_but_for_rounding_the_first_is_taken():
    middles = np.array([[5 + 9j], [5 + 9j], [5 + 9j]])
    assert 1 == clearest(np.array([2.0, 1.0 + 1e-12, 1.0]), ((middles, 3.0, 1.0),), WALL)


def test_a_place_that_is_cheaper_or_dearer_by_rounding_alone_is_not_taken_for_one_before_it():
    for rounding in (-5e-7, 5e-7):
        charges = np.array([1.0] * 60 + [1.0 + rounding])
        assert 0 == cheapest([(0.0, place) for place in range(61)], charges.__getitem__)


@pytest.mark.parametrize("room", [7.0, 100.0])
def test_the_cheapest_of_many_places_is_found_though_the_dearest_are_not_looked_at(room: float) -> None:
    middles = np.array([[complex(5, k)] for k in range(200)])
    prices = np.array([0.001 * k for k in range(200)])
    assert room == clearest(prices, ((middles, room, 1.0),), WALL)


def test_the_buffer_of_numpy_is_as_it_was_after_an_error_in_a_figure_too():
    @short_buffers()
    def failing():
        raise KeyError(np.getbufsize())

    usual = np.getbufsize()
    with pytest.raises(KeyError) as stop:
        failing()
    assert usual > stop.value.args[0]
    assert usual == np.getbufsize()
