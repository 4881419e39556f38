"""What a sheet says of guides that links carry and of how links sit on their guides: given data and dimensions."""

import pytest

from graphkin import draw, handout
from graphkin.account.given import given_drivers, given_loads, given_shapes, rolled_starts
from graphkin.account.notation import notation_of
from graphkin.construction import draft
from graphkin.drawing.ink.primitives import Text, walk
from graphkin.scene import mechanism_of
from graphkin.words import rich_text

OLDHAM = {
    "frame": {"name": "4", "points": {"A": [0, 0], "B": [30, 0]}},
    "links": {
        "1": {"points": ["A"]},
        "2": {"points": ["M"], "on": ["1", "3"], "angle_on": [0, -60]},
        "3": {"points": ["B"]},
    },
    "driver": {"link": "1", "angle": 70, "omega": 12},
    "sketch": {"M": [10, 30]},
}
YOKE = {
    "units": {"length": "in"},
    "frame": {"name": "4", "points": {"A": [0, 0]}, "guides": {"x": {"through": [0, -1], "angle": 10}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 2.5},
        "2": {"points": ["B"], "on": "3.s"},
        "3": {"points": ["C"], "on": "4.x", "guides": {"s": {"through": [-6, 0.5], "angle": 70}}},
    },
    "driver": {"link": "1", "angle": 40, "rpm": 90},
}
CARRIAGE = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, -60], "angle": 15}}},
    "links": {
        "1": {"points": ["P"], "on": "0.h", "at": {"Q": [70, 30]}},
        "2": {"points": ["A", "B"], "length": 80},
        "3": {"points": ["B", "Q"], "length": 90},
    },
    "driver": {"slide": "1", "travel": 20, "velocity": 50, "acceleration": -100},
    "sketch": {"B": [-20, 70]},
}
ACROSS = {**CARRIAGE, "links": {**CARRIAGE["links"], "1": {**CARRIAGE["links"]["1"], "angle_on": 90}}}
ARM = {  # a guide bar with an arm beside its axis
    "frame": {"points": {"A": [0, 80], "C": [0, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 30},
        "2": {"points": ["B"], "on": "3"},
        "3": {"points": ["C"], "at": {"D": {"from": "C", "r": 60, "angle": -130}}},
    },
    "driver": {"link": "1", "angle": 20, "omega": 5},
}


SLANTED_SLOT = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"y": {"through": "A", "angle": 90}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 10},
        "2": {"points": ["B"], "on": "3"},
        "3": {"points": ["P"], "on": "0.y", "angle_on": -60},
    },
    "driver": {"link": "1", "angle": 60, "omega": 10},
}


def given(scene, language="en"):
    sheet = draft(mechanism_of(scene))
    return [*map(repr, given_shapes(sheet.scene, notation_of(sheet, "chinese"), language))]


@pytest.mark.parametrize(
    ("told", "scene"),
    [
        (["guide 3 at 60° to guide 1"], OLDHAM),
        (["guide $s$ on 3: (−6, 0.5) in from $C$ along $x$, 70° to it"], YOKE),
        (["$Q$ (70, 30) mm from $P$ along $h$"], CARRIAGE),
        (["$Q$ (−30, 70) mm from $P$ along $h$"], ACROSS),
        (["$CD$ at −130° to the axis of 3"], ARM),
        (["guide $s$ on 3: (−140, 0) mm from $C$ along $x$, 90° to it"], "scotch-yoke"),
        (["the axis of 3 at 90° to $y$"], "sine-mechanism"),
        (["the axis of 3 at −60° to $y$"], SLANTED_SLOT),
        ([], "whitworth"),
    ],
)
def test_the_given_data_say_how_links_are_shaped_beyond_their_lengths(told, scene):
    assert told == given(scene)


def test_they_say_it_in_chinese():
    assert ["构件 3 的导路 $s$：沿 $x$ 距 $C$ (−6, 0.5) in，与其成 70°"] == given(YOKE, "zh")


@pytest.mark.parametrize("name", ["whitworth", "geneva-step", "scotch-yoke"])
def test_a_sheet_in_two_languages_has_both_sentences_whole(name):
    each = zip(given(name, "en"), given(name, "zh"), strict=True)
    assert [" ".join(both) for both in each] == given(name, "both")


def test_the_problem_sheet_says_it_in_both_languages():
    text = handout(YOKE, language="both").files["problem.html"].decode()
    assert "构件 3 的导路" in text
    assert "in from" in text


@pytest.mark.parametrize(
    ("wanted", "scene"),
    [
        ({"60°", "30", "70°"}, OLDHAM),
        ({"10°", "1"}, YOKE),
        ({"15°", "60", "70", "30", "s1=20"}, CARRIAGE),
        ({"140", "90°"}, "scotch-yoke"),
        ({"90°"}, "sine-mechanism"),
        ({"s1=120"}, "elliptic-trammel"),
        ({"s23=520"}, "hydraulic-cylinder"),
    ],
)
def test_slanted_guides_places_on_links_and_driven_travels_are_dimensioned(wanted, scene):
    figure = draw(scene, figures=("mechanism",)).figures["mechanism"]
    shown = {thing.string.replace(" ", "") for thing in walk(figure.children) if isinstance(thing, Text)}
    assert set() == wanted - shown


def test_a_point_beside_its_guide_is_dimensioned_along_it_and_not_by_its_distance():
    figure = draw(CARRIAGE, figures=("mechanism",)).figures["mechanism"]
    assert "76.158" not in {thing.string for thing in walk(figure.children) if isinstance(thing, Text)}


@pytest.mark.parametrize(
    ("told", "scene"),
    [
        (["$φ_{1}$ = 20°", "$ω_{1}$ = 0 rad/s"], {**ARM, "driver": {"link": "1", "angle": 20, "omega": 0}}),
        (["$φ_{1}$ = 40°", "$n_{1}$ = 90 r/min", "$ω_{1}$ = 9.42478 rad/s"], YOKE),
        (["$s_{1}$ = 20 mm", "$v_{1}$ = 50 mm/s", "$a_{1}$ = −100 mm/s²"], CARRIAGE),
    ],
)
def test_a_driver_is_told_with_its_rate_even_at_rest(told, scene):
    sheet = draft(mechanism_of(scene))
    assert told == [*map(repr, given_drivers(sheet, notation_of(sheet, "chinese")))]


@pytest.mark.parametrize(
    ("name", "starts"),
    [
        ("geared-five-bar", ["$φ_{4}$ = 60° ($φ_{1}$ = 40°)"]),
        ("gears-epicyclic", ["$φ_{2}$ = 0° ($φ_{1}$ = 0°)", "$φ_{3}$ = 30° ($φ_{1}$ = 0°)"]),
        ("wheel-on-rail", ["$s_{C}$ = 0 mm ($φ_{1}$ = 90°)"]),
        ("disc-on-disc", []),
    ],
)
def test_a_problem_tells_how_wheels_stand_that_carry_further_points(name, starts):
    scene = mechanism_of(name)
    assert starts == [*map(repr, rolled_starts(draft(scene)))]
    if starts:
        problem = handout(name, formats=("html",), positions=1).files["problem.html"].decode()
        assert "Rolling starts at" in problem


def test_a_wheel_that_has_but_its_axis_is_told_without_its_angle():
    train = {
        "frame": {"points": {"A": [0, 0], "B": [60, 0]}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["B"]}},
        "gears": {"g": {"between": ["1", "2"], "teeth": [20, 40]}},
        "driver": {"link": "1", "angle": 10, "omega": 5},
    }
    assert [] == rolled_starts(draft(mechanism_of(train)))


PRESS = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, -10], "angle": 30}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 40}, "2": {"points": ["B", "C"], "length": 120},
        "3": {"points": ["C"], "on": "0.h"},
    },
    "driver": {"link": "1", "angle": 60, "omega": 5},
    "masses": {"2": {"at": [60, 8], "mass": 3}},
    "loads": {"P": {"on": "3", "at": [15, 0], "force": 60, "angle": 180, "follows": "3"},
              "Q": {"on": "2", "at": "C", "force": 8, "angle": 45}},
}


def of_loads(**tables: object) -> list[str]:
    """The given masses and loads of the press."""
    sheet = draft(mechanism_of({**PRESS, **tables}))
    return [repr(rich_text(phrase, "en")) for phrase in given_loads(sheet, notation_of(sheet, "chinese"))]


def test_the_point_at_which_a_force_acts_is_given() -> None:
    told = of_loads()
    assert "$P$ = 60 N on link 3 at (15, 0) mm from $C$ along $h$, 180° from the axis of link 3" in told
    assert "$P_{Q}$ = 8 N on link 2 at $C$, direction 45°" in told


def test_a_mass_beside_all_points_has_a_place_in_the_axes_of_its_link() -> None:
    assert "$m_{2}$ = 3 kg at (60, 8) mm from $B$ along $BC$" in of_loads()


SPRING = {"s": {"between": ["A", "C"], "rate": 2, "free": 12, "preload": 0.5}}


def test_a_spring_is_given_with_its_ends_and_its_numbers_in_the_units_of_the_file() -> None:
    told = of_loads(units={"length": "cm", "force": "kN"}, springs=SPRING)
    assert ("spring s from $A$ (link 0) to $C$ (link 2): rate 2 kN/cm, free length 12 cm, preload 0.5 kN; "
            "$P_{s}$ acts on link 0") in told


def test_weights_that_do_not_pull_down_have_a_direction() -> None:
    assert "weights pull in the direction −160°" in of_loads(gravity={"angle": 200})
    assert not [told for told in of_loads(gravity={}) if told.startswith("weights")]


def test_the_line_of_a_balancing_force_is_given() -> None:
    # without it the force that is sought is any
    assert "$F_{1}$ on link 1 at $B$, 90° from the axis of link 1" == of_loads(
        balance={"on": "1", "at": "B", "angle": "square"})[-1]
    assert "$F_{1}$ on link 1 at $B$, direction 10°" == of_loads(balance={"on": "1", "at": "B", "angle": 10})[-1]
