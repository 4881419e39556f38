"""Which lengths and angles of a mechanism are dimensioned."""

import math

import pytest

from graphkin import draw, read
from graphkin.drawing import Box, Text
from graphkin.drawing.ink.primitives import Arc, Group, Line, walk
from graphkin.drawing.ink.strokes import HATCHING
from graphkin.drawing.parts.dimensioning import LENGTHS
from graphkin.drawing.place.dimensions import DimensionClearance, dimension
from graphkin.drawing.place.obstacles import Obstacles
from graphkin.drawing.text import rich, text_box
from graphkin.scene import library
from graphkin.words.written import as_given
from tests.drawn import drafted
from tests.scenes import four_bar

SCENE = {
    "units": {"length": "mm"},
    "frame": {"name": "4", "points": {"A": [0, 0], "D": [113, 0], "G": [11, 94]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 40},
        "2": {"points": ["B", "C"], "length": 110, "at": {"E": {"from": "C", "r": 50, "angle": 90}}},
        "3": {"points": ["D", "C"], "length": 70},
    },
    "driver": {"link": "1", "angle": 50, "rpm": 30, "alpha": 5},
    "sketch": {"C": [110, 70]},
}


def words(figure) -> list[str]:
    return [thing.string for thing in walk(figure.children) if isinstance(thing, Text)]


def test_fixed_points_are_dimensioned_from_the_pivot_of_the_driver():
    assert {"113", "11", "94"} <= set(words(draw(SCENE).figures["mechanism"]))


def test_a_sheet_short_of_room_has_the_frames_dimensions_closer_and_their_numbers_clear_of_dashed_lines():
    panel = draw("single-flier", figures=("sheet",)).figures["sheet"]
    assert {"113", "11", "94"} <= set(words(panel))
    numbers = [thing for thing in walk(panel.children) if isinstance(thing, Text) and thing.string == "83.8689"]
    legs = [one for one in walk(panel.children) if isinstance(one, Group) and "special" in one.classes]
    crossed = [
        line for leg in legs for line in walk(leg.children)
        if isinstance(line, Line) and text_box(numbers[0]).clip(line.start, line.end)
    ]
    assert legs
    assert [] == crossed


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("sixbar-guide-40deg", {"280", "164"}), ("slider-crank-s50-e16-K1.2", {"16"}), ("toggle-press", {"300", "200"}),
        ("slotter-75-150", {"150", "93"}), ("sixbar-coupler-1A", {"153.5", "87.5"}),
    ],
)
def test_a_narrow_panel_has_the_frames_dimensions_within_the_mechanism(name, wanted):
    assert wanted - set(words(draw(name, figures=("sheet",)).figures["sheet"])) == set()


# eight-bars are too crowded for some of theirs
@pytest.mark.parametrize("name", sorted({*library()} - {"double-butterfly", "single-flier"}))
def test_every_bar_has_its_length(name):
    sheet, _ = drafted(name)
    scene = sheet.scene.instead_of or sheet.scene  # bars in place of a cam have no length of their own
    lengths = {as_given(link.length / scene.units.metres) for link in scene.links if link.length and not link.redundant}
    assert lengths - set(words(draw(name, figures=("mechanism",)).figures["mechanism"])) == set()


def test_the_angle_of_the_crank_is_dimensioned():
    assert "50°" in words(draw(SCENE).figures["mechanism"])


def test_a_corner_that_is_round_is_given_by_its_angle():
    assert {"90°", "50"} <= set(words(draw(SCENE).figures["mechanism"]))


def test_a_given_speed_stays_in_turns_per_minute():
    assert any("n1=30r/min" in text.replace(" ", "") for text in words(draw(SCENE).figures["mechanism"]))


def test_a_given_angular_acceleration_is_an_arc_with_two_heads():
    groups = [thing for thing in walk(draw(SCENE).figures["mechanism"].children) if isinstance(thing, Group)]
    assert ["driver-1", "driver-1-alpha"] == sorted(thing.id for thing in groups if thing.id.startswith("driver-"))


def test_the_unit_of_dimensions_is_told_where_it_is_not_the_millimetre():
    told = words(draw({**SCENE, "units": {"length": "in"}}).figures["mechanism"])
    assert any(text.endswith("dimensions in inches") for text in told)


def test_pivots_whose_symbols_overlap_are_ringed_and_drawn_again_larger_under_the_same_numeral():
    page = draw("sixbar-rotating-guide-35rpm", figures=("sheet",)).figures["sheet"]
    things = {thing.id: thing for thing in walk(page.children) if isinstance(thing, Group | Text)}
    assert {"ring-mechanism", "detail-mechanism"} <= things.keys()
    assert ("I", "I: Detail 5 : 1") == tuple(
        things[f"label-{name}-mechanism"].string for name in ("ring", "detail"))


def test_links_differ_in_black_and_white():
    drawn = walk(draw("sixbar-coupler-1A").figures["mechanism"].children)
    links = [thing for thing in drawn if isinstance(thing, Group) and "link" in thing.classes]
    looks = [tuple(p.stroke.dash for p in walk(g.children) if not isinstance(p, Text) and p.stroke) for g in links]
    assert len(links) == len({frozenset(look) for look in looks})


@pytest.mark.parametrize(("name", "degrees"), [
    ("toggle-press", 235), ("whitworth", 195), ("sixbar-coupler-2B", 285), ("double-butterfly", 105),
    ("slotter-75-150", 0),
])
def test_the_angle_of_the_crank_stands_on_every_mechanism(name: str, degrees: float) -> None:
    texts = words(draw(name, at=degrees, figures=["mechanism"], language="en").figures["mechanism"])
    ways = {f"{way:g}°".replace("-", "−") for way in (degrees, (degrees + 180) % 360 - 180)}
    assert any(text == shown or text.endswith((f"={shown}", f"= {shown}")) for text in texts for shown in ways), texts


@pytest.mark.parametrize(("degrees", "said"), [(1, "φ1= 1°"), (3, "3°")])
def test_a_small_angle_has_an_arc_that_is_seen_or_is_written_at_its_pivot(degrees: float, said: str) -> None:
    figure = draw(four_bar(50, 120, 90, 130), at=degrees, figures=["mechanism"]).figures["mechanism"]
    assert said in words(figure)
    drawn = next(group for group in walk(figure.children) if isinstance(group, Group) and group.id == LENGTHS)
    assert [] == [arc for arc in drawn.children if isinstance(arc, Arc) and abs(arc.end - arc.start) * arc.radius < 0.5]


def test_a_small_angle_of_a_link_or_a_guide_has_its_number_where_no_arc_is_seen() -> None:
    scene = four_bar(50, 120, 90, 130)
    scene["links"]["2"]["at"] = {"E": [60 * math.cos(math.radians(1)), 60 * math.sin(math.radians(1))]}
    slanted = read("slider-crank-offset").replace("frame.guides.h.angle", 1.5)
    assert "1°" in words(draw(scene, at=55, figures=["sheet"]).figures["sheet"])
    assert "1.5°" in words(draw(slanted, at=130, figures=["sheet"]).figures["sheet"])


def test_an_angle_beyond_180_degrees_is_dimensioned_as_it_is_given():
    assert "235°" in words(draw("toggle-press", at=235, figures=["mechanism"]).figures["mechanism"])


@pytest.mark.parametrize(("name", "lengths"), [
    ("hit16-double-guide", {"100", "200"}), ("sixbar-coupler-1A", {"87.5", "153.5", "41.7"}),
    ("sixbar-1A-last-link", {"41.7"}), ("toggle-press-force", {"300", "200"}), ("cam-offset-roller", {"8"}),
])
def test_distances_in_the_frame_stand_on_the_mechanism_of_the_sheet(name, lengths):
    page = walk(draw(name, figures=("sheet",)).figures["sheet"].children)
    dimensions = next(thing for thing in page if isinstance(thing, Group) and thing.id == "dimensions")
    assert lengths <= {thing.string for thing in walk(dimensions.children) if isinstance(thing, Text)}


def test_a_pin_in_a_named_slot_of_the_frame_leaves_its_distance_dimensioned():
    scene = {
        "units": {"length": "mm"},
        "frame": {"name": "0", "points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 20], "angle": 0}}},
        "links": {"1": {"points": ["A", "B"], "length": 40}, "2": {"points": ["B", "C"], "length": 120}},
        "pins": {"C": {"of": "2", "in": "0.h"}},
        "driver": {"link": "1", "angle": 40, "rpm": 100},
    }
    assert "20" in words(draw(scene).figures["mechanism"])


def test_a_guide_that_is_given_has_its_name_in_the_figure_though_no_equation_names_it():
    assert {"x", "s"} <= set(words(draw("scotch-yoke", figures=["mechanism"]).figures["mechanism"]))


def test_a_slot_in_the_frame_is_hatched_on_both_sides():
    scene = {
        "units": {"length": "mm"},
        "frame": {"name": "4", "points": {"A": [0, 0]}, "guides": {"k": {"through": [60, 30], "angle": 20}}},
        "links": {"1": {"points": ["A", "B"], "length": 30}, "2": {"points": ["B", "C"], "length": 90}},
        "pins": {"C": {"of": "2", "in": "4.k"}}, "sketch": {"C": [110, 50]},
        "driver": {"link": "1", "angle": 60, "omega": 10},
    }
    figure = draw(scene, figures=["mechanism"]).figures["mechanism"]
    (frame,) = (g for g in groups(figure.children) if g.id == "link-4")
    feet = [part.start for part in walk(frame.children) if isinstance(part, Line) and part.stroke == HATCHING]
    middle = sum(feet) / len(feet)
    across = {round((z * (0.9396926 + 0.3420201j)).imag, 2) for z in feet if z.real > middle.real}  # y runs downwards
    assert 2 == len(across)


def groups(children):
    for child in children:
        if isinstance(child, Group):
            yield child
            yield from groups(child.children)


SYMBOL, LINE = Obstacles(areas=(Box(19.0, 66.0, 21.0, 67.0),)), Obstacles(solid=((15 + 66j, 25 + 66j),))


@pytest.mark.parametrize(("around", "over", "offset"), [
    (Obstacles(), False, 22.0), (SYMBOL, False, -22.0), (SYMBOL, True, -22.0), (LINE, False, -22.0), (LINE, True, 22.0),
])
def test_an_extension_line_runs_over_no_symbol_and_over_a_line_where_that_is_allowed(around, over, offset):
    ends, runs = (20 + 50j, 60 + 50j), rich("40", 2.8)
    taken = DimensionClearance(around, None).take((dimension(*ends, by, runs) for by in (22.0, -22.0)), over=over)
    assert taken is not None
    assert offset == pytest.approx((taken[0].end - ends[0]).imag - math.copysign(1.5, offset))


def test_a_dimension_runs_over_a_line_where_all_its_places_do():
    around = Obstacles(solid=(*LINE.solid, (15 + 34j, 25 + 34j)))
    drawn = (dimension(20 + 50j, 60 + 50j, by, rich("40", 2.8)) for by in (22.0, -22.0))
    taken = DimensionClearance(around, None).take(drawn)
    assert taken is not None
    assert 22.0 == pytest.approx((taken[0].end - 20 - 50j).imag - 1.5)


def test_the_radius_of_a_slot_without_room_for_a_dimension_stands_at_the_slot() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [120, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30},
            "3": {"points": ["D"], "guides": {"s": {"centre": [-60, 60], "r": 70, "ends": [-80, 60]}}},
        },
        "pins": {"B": {"of": "1", "in": "3.s"}},
        "driver": {"link": "1", "angle": 60, "omega": 10},
    }
    figure = draw(scene, figures=("mechanism",)).figures["mechanism"]
    texts = [thing.string for thing in walk(figure.children) if isinstance(thing, Text)]
    assert [1, 0] == [texts.count(said) for said in ("R 70", "70")]


def test_the_numbers_of_distances_on_one_line_stand_clear_of_each_other():
    """Past the end of a distance that has no room for its number lies the middle of the next."""
    ends = (0j, 4.85j, "12.1246"), (4.85j, 19.6j, "36.745")
    short, next_ = (dimension(start, end, 0.0, rich(number, 2.8)) for start, end, number in ends)
    assert DimensionClearance(Obstacles(), None).take([(*short, *next_)], 0) is None
