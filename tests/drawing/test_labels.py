from __future__ import annotations

import cmath
import itertools
from dataclasses import replace
from itertools import combinations

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from graphkin.drawing.box import Box
from graphkin.drawing.ink import symbols as arrows
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polygon, Text
from graphkin.drawing.ink.strokes import DIRECTION, LINK
from graphkin.drawing.ink.symbols import turning_pair, vector_group
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.obstacles import Obstacles
from graphkin.drawing.place.piece import obstacles_of
from graphkin.drawing.place.placement import Placement
from graphkin.drawing.text import rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.drawing.write.svg import svg_bytes
from tests.notation import noted

PANEL = Box(5.0, 5.0, 155.0, 105.0)


def label(markup: str, mark, *toward: float) -> Label:
    return Label(Text(0j, rich(noted(markup))), mark, toward)


def place(*given):
    return Placement(*given).placed


def polygon(tips: list[complex], pole: complex = 30 + 70j):
    """A velocity polygon as it comes along: vectors from the pole, relative ones between tips, dashed directions."""
    children, labels = [], [label("$p$", pole)]
    for i, tip in enumerate(tips):
        children.append(vector_group(f"v_{i}", i, pole, tip))
        labels += [label(f"$v_{{B_{i}}}$", (pole, tip)), label(f"$b_{i}$", tip)]
    for i, (a, b) in enumerate(itertools.pairwise(tips)):
        if abs(b - a) < 1.0:
            continue
        children.append(vector_group(f"w_{i}", i, a, b, arrows.COMPONENT))
        labels.append(label(f"$v_{{C_{i}B}}$", (a, b)))
        across = PANEL.clip_line(a, 1j * (b - a))
        children += [Line(*across, DIRECTION)] if across else []
    return tuple(children), labels


def figure(children, labels) -> tuple[bytes, tuple]:
    placed = place(labels, PANEL, obstacles_of(children))
    leaders = tuple(p.leader for p in placed if p.leader)
    texts = Group(tuple(p.text for p in placed), layer="labels")
    return svg_bytes(Drawing(160.0, 110.0, (*children, *leaders, texts))), placed


tips = st.lists(
    st.builds(lambda x, y: complex(x / 100, y / 100), st.integers(2000, 14000), st.integers(2000, 9500)),
    min_size=1,
    max_size=6,
    unique=True,
)


@settings(max_examples=60, deadline=None)
@given(tips)
def test_no_label_of_any_polygon_touches_what_is_drawn(violations, points):
    svg, _ = figure(*polygon(points))
    assert violations(svg) == []


@settings(max_examples=40, deadline=None)
@given(tips)
def test_every_label_is_inside_its_panel(points):
    _, placed = figure(*polygon(points))
    assert all(PANEL.holds(p.box) for p in placed)


@settings(max_examples=40, deadline=None)
@given(tips)
def test_a_label_is_nearest_to_its_own_point_or_has_a_leader(points):
    children, labels = polygon(points)
    _, placed = figure(children, labels)
    marks = [wanted.mark for wanted in labels if isinstance(wanted.mark, complex)]
    for wanted, p in zip(labels, placed, strict=True):
        if isinstance(wanted.mark, complex) and p.leader is None:
            assert p.box.distance(wanted.mark) <= min(p.box.distance(mark) for mark in marks) + 1e-9


def test_coincident_points_have_a_label_each():
    placed = place([label("$b_2$", 50 + 50j), label("$b_3$", 50 + 50j)], PANEL)
    assert not placed[0].box.overlaps(placed[1].box)


def test_a_label_stands_where_it_is_liked():
    (placed,) = place([label("$B$", 50 + 50j, cmath.pi)], PANEL)
    assert placed.box.right < 50


def test_a_label_gives_way_to_a_joint():
    joint = turning_pair(50 + 50j)
    (placed,) = place([label("$B$", 50 + 50j)], PANEL, obstacles_of(joint))
    assert placed.box.distance(50 + 50j) > joint[0].radius


def test_a_label_stands_beside_its_vector_without_a_leader():
    (placed,) = place([label("$v_B$", (20 + 50j, 120 + 50j))], PANEL)
    assert placed.leader is None


def test_the_name_of_a_vector_between_vectors_has_a_leader_but_not_between_points():
    wanted = label("$v_B$", (40 + 50j, 80 + 50j))
    vectors = [(40 + y * 1j, 80 + y * 1j) for y in (48, 52)]
    points = [x + y * 1j for x in range(40, 81, 2) for y in (48, 52)]
    assert place([wanted], PANEL, Obstacles(), vectors)[0].leader is not None
    assert place([wanted], PANEL, Obstacles(), points)[0].leader is None


def test_the_name_of_a_vector_stands_square_off_its_middle():
    vector = 20 + 50j, 120 + 50j
    (placed,) = place([label("$v_B$", vector)], PANEL, Obstacles(solid=(vector,)))
    assert (70.0, 49.3) == pytest.approx((placed.box.centre.real, placed.box.bottom))


def test_a_name_at_a_point_makes_room_for_one_that_has_no_other_place():
    walls = Obstacles(solid=((40 + 49j, 62 + 49j), (40 + 51j, 62 + 51j), (40 + 20j, 40 + 49j), (62 + 20j, 62 + 49j)))
    first, second = label("$B$", 50 + 50j), label("$v$", (42 + 49j, 60 + 49j))
    placed = place([first, second], Box(30.0, 40.0, 72.0, 60.0), walls)
    assert [True, True] == [one.clear for one in placed]
    assert not placed[0].box.overlaps(placed[1].box)


def test_a_label_in_a_crowd_has_a_leader_to_its_mark():
    marks = [50 + 50j, *(50 + 50j + cmath.rect(1.2, k) for k in range(6))]
    placed = place([label(f"$P_{{{i}4}}$", mark) for i, mark in enumerate(marks)], PANEL)
    led = [p for p in placed if p.leader]
    assert led
    assert all(p.leader.start in {complex(round(m.real, 3), round(m.imag, 3)) for m in marks} for p in led)


def test_the_same_labels_get_the_same_places():
    children, labels = polygon([80 + 30j, 90 + 60j, 60 + 90j])
    assert figure(children, labels)[0] == figure(children, labels)[0]


def test_a_panel_without_room_is_owned_up_to():
    (placed,) = place([label("$v_B$ of the ram", 5 + 5j)], Box(0.0, 0.0, 8.0, 8.0))
    assert not placed.clear


def test_no_labels_need_no_places():
    assert place([], PANEL) == ()


def test_a_tint_is_no_obstacle_but_its_edge_is():
    tint = Polygon((0j, 60 + 0j, 60 + 60j, 0 + 60j), "#ddeeff", LINK)
    found = obstacles_of((tint,))
    assert (len(found.solid), found.areas) == (4, ())


def test_a_block_leaves_no_room_inside():
    found = obstacles_of((Polygon((0j, 8 + 0j, 8 + 5j, 0 + 5j), "#ffffff", LINK),))
    assert (0j, 8 + 5j) in found.solid


def test_a_circle_is_an_area():
    assert obstacles_of((Circle(5 + 5j, 1.0, "#000000"),)).areas == (Box(4.0, 4.0, 6.0, 6.0),)


@pytest.mark.parametrize("radius", [8.0, 100.0, 432.0])
def test_an_arc_is_an_obstacle_where_it_lies_however_large_it_is(radius):
    chords = obstacles_of((Arc(0j, radius, 1.0, 2.0, LINK),)).solid
    assert pytest.approx(radius, abs=0.5) == min(abs(a + b) / 2 for a, b in chords)


def test_dashed_lines_may_be_crossed_where_nothing_else_is_free():
    everywhere = Obstacles(dashed=tuple((complex(x, 0.0), complex(x, 120.0)) for x in range(0, 160, 2)))
    (placed,) = place([label("$B$", 50 + 50j)], PANEL, everywhere)
    assert placed.clear


@pytest.mark.parametrize("length", [0.0, 0.3, 2.0])
def test_a_tiny_vector_is_labelled_as_well(length):
    (placed,) = place([label("$v_C$", (50 + 50j, 50 + length + 50j))], PANEL)
    assert placed.clear


def test_a_crowd_of_fifteen_labels_in_one_centimetre_stays_legible(violations):
    crowd = [30 + 70j + complex(6 - 3 * (3 * i % 5), 5 - 2.5 * (2 * i % 5)) for i in range(5)]
    svg, _ = figure(*polygon(crowd))
    assert violations(svg) == []


def between_walls(**more) -> Placement:
    """A vector upright between two others, with room for a short name beside it, not for a long one."""
    walls = tuple(Line(complex(x, 5), complex(x, 105), LINK) for x in (46, 54))
    vector = Line(50 + 20j, 50 + 90j, LINK)
    name = replace(label("$a_{CBDEFGHKLMN}$ long", (50 + 20j, 50 + 90j)), **more)
    return Placement([name], Box(40.0, 5.0, 60.0, 105.0), obstacles_of((*walls, vector)))


def test_a_key_stands_where_a_name_has_no_room():
    placement = between_walls(key=Text(0j, rich("(7)", 2.0)))
    assert placement.crowded == [0]
    placement.shorten()
    (placed,) = placement.placed
    assert (placement.crowded, placed.keyed, placed.leader) == ([], True, None)
    assert 46 < placed.box.left < placed.box.right < 54


def test_a_name_without_a_key_stays_where_it_is():
    placement = between_walls()
    before = placement.placed
    placement.shorten()
    assert before == placement.placed


def test_leaders_do_not_cross_each_other():
    crowd = [30 + 70j + complex(6 - 3 * (3 * i % 5), 5 - 2.5 * (2 * i % 5)) for i in range(5)]
    _, placed = figure(*polygon(crowd))
    ends = [(p.leader.start, p.leader.end) for p in placed if p.leader]
    leaders = [shapely.LineString([(a.real, a.imag), (b.real, b.imag)]) for a, b in ends]
    assert len(leaders) > 2
    assert not any(one.crosses(other) and not one.touches(other) for one, other in combinations(leaders, 2))
