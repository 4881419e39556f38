"""What is wrong with contacts and gears is told by name, all at once."""

import copy
import math
import tomllib
from pathlib import Path

import pytest

import graphkin
from graphkin.errors import SceneError
from graphkin.scene.scene import as_mapping, mechanism_of, read

LIBRARY = Path(graphkin.__file__).parent / "scene" / "library"
DISC = {
    "frame": {"points": {"A": [0, 0], "C": [80, 0]}},
    "links": {
        "1": {"points": ["A", "O"], "length": 22, "discs": {"k": {"centre": "O", "r": 50}}},
        "2": {"points": ["C"], "guides": {"f": {"through": "C", "angle": 0}}},
    },
    "contacts": {"K": {"between": ["1.k", "2.f"]}},
    "driver": {"link": "1", "angle": 90, "omega": 10},
}
WHEELS = {
    "frame": {"points": {"A": [0, 0], "B": [50, 0]}},
    "links": {"1": {"points": ["A"]}, "2": {"points": ["B"]}},
    "gears": {"g": {"between": ["1", "2"], "teeth": [20, 30]}},
    "driver": {"link": "1", "angle": 0, "omega": 12},
}


def changed(scene, path, value):
    made = copy.deepcopy(scene)
    *way, last = path.split(".")
    place = made
    for key in way:
        place = place[key]
    place[last] = value
    return made


@pytest.mark.parametrize(
    ("path", "value", "where", "words"),
    [
        ("links.1.discs.k.r", 0, "links.1.discs.k.r", "found 0"),
        ("links.1.discs.k.centre", "Q", "links.1.discs.k.centre", "Q is nowhere placed on link 1"),
        ("links.1.discs.k.r", -50, "contacts.K.between", "1.k is hollow"),
        ("contacts.K.between", ["1.k", "2.q"], "contacts.K.between", 'no disc and no guide "q"'),
        ("contacts.K.between", ["1.k", "7.f"], "contacts.K.between", 'there is no link "7"'),
        ("contacts.K.between", ["1.k", "1"], "contacts.K.between", "outlines of the same link 1"),
        ("contacts.K.between", ["1", "2.f"], "contacts.K.between", "are two guides"),
        ("contacts.K.side", "inside", "contacts.K.side", "with a flat face"),
        ("contacts.K.side", "above", "contacts.K.side", 'found "above"'),
        ("contacts.K.rolls", True, "contacts.K.rolls", 'did you mean "rolling"?'),
        ("contacts", {"O": {"between": ["1.k", "2.f"]}}, "contacts.O", "a point of a link already"),
    ],
)
def test_a_wrong_contact_is_named(path, value, where, words):
    with pytest.raises(SceneError) as told:
        mechanism_of(changed(DISC, path, value))
    assert any(where == p.where and words in f"{p.found} {p.wanted}" for p in told.value.problems), told.value.problems


@pytest.mark.parametrize(
    ("path", "value", "where", "words"),
    [
        ("gears.g.teeth", [0, 30], "gears.g.teeth", "found 0"),
        ("gears.g.teeth", [20.5, 30], "gears.g.teeth", "found 20.5"),
        ("gears.g.teeth", [30, -20], "gears.g.teeth", "a ring has more teeth"),
        ("gears.g.teeth", ["rack", 20], "gears.g.teeth", 'the first is "rack"'),
        ("gears.g.teeth", [20, "rack"], "gears.g", "no link holds the wheel's axis and the rack's slide"),
        ("gears.g.between", ["1", "1"], "gears.g.between", "meshes with itself"),
        ("gears.g.between", ["1", "9"], "gears.g.between", 'there is no link "9"'),
        ("gears.g.carrier", "2", "gears.g.carrier", "is one of the wheels"),
        ("links.2.points", ["A"], "gears.g", "no link holds both axes"),
        ("frame.points.B", [0, 0], "gears.g", "both axes lie at the same place"),
    ],
)
def test_a_wrong_gear_is_named(path, value, where, words):
    with pytest.raises(SceneError) as told:
        mechanism_of(changed(WHEELS, path, value))
    assert any(where == p.where and words in f"{p.found} {p.wanted}" for p in told.value.problems), told.value.problems


def test_a_scene_with_contacts_reads_as_it_was_written():
    scene = mechanism_of("disc-on-disc")
    assert scene.contacts == mechanism_of(as_mapping(scene)).contacts


def test_contacts_can_be_changed_by_key():
    smaller = read("disc-on-disc").replace("links.1.discs.k.r", 30)
    assert 0.03 == smaller.mechanism.contacts[0].radii[0]


def test_a_contact_that_cannot_be_made_is_named():
    apart = changed(DISC, "links.2", {"points": ["C", "B"], "length": 5, "discs": {"w": {"centre": "B", "r": 1}}})
    apart["contacts"]["K"]["between"] = ["1.k", "2.w"]
    why = graphkin.solve(apart).data["positions"][0]["why"]
    assert "contact K of links 1, 2" in why


def test_discs_that_a_carrier_does_not_hold_apart_by_their_radii_are_named():
    wheels = changed(WHEELS, "gears", {})
    wheels["frame"]["discs"] = {"r": {"centre": "A", "r": 30}}
    wheels["links"]["2"] = {"points": ["P"], "discs": {"w": {"centre": "P", "r": 15}}}
    wheels["links"]["1"] = {"points": ["A", "P"], "length": 40}
    wheels["contacts"] = {"K": {"between": ["2.w", "0.r"], "rolling": True}}
    with pytest.raises(SceneError) as told:
        mechanism_of(wheels)
    assert "holds the centres 40 apart, the radii make it 45" in str(told.value)


@pytest.mark.parametrize(
    ("name", "changes", "where"),
    [
        ("wheel-on-rail", {"drawn": {"C": [0, 29]}}, "contacts.K"),
        ("wheel-on-rail", {"drawn": {"C": [0, -30]}}, "contacts.K"),
        ("disc-on-disc", {"drawn": {"B": [54, 53]}, "links.2.length": 70.178344238}, "contacts.K"),
        ("cam-offset-roller", {"drawn": {"B": [8, 100]}}, "drawn.B"),
        ("gears-epicyclic", {"drawn": {"P": [60, 20]}}, "drawn.P"),
        ("geared-five-bar", {"drawn": {"D": [60, 20]}}, "links.4.start"),
    ],
)
def test_what_is_drawn_and_cannot_touch_or_start_so_is_named(name, changes, where):
    text = (LIBRARY / f"{name}.toml").read_text(encoding="utf-8")
    made = tomllib.loads(text)
    for path, value in changes.items():
        made = changed(made, path, value)
    with pytest.raises(SceneError) as told:
        graphkin.solve(made)
    assert where in {problem.where for problem in told.value.problems}


def test_a_wheel_written_out_with_where_it_starts_may_be_driven_elsewhere():
    made = as_mapping(graphkin.solve("wheel-on-rail").mechanism)
    assert "start" in made["links"]["1"]
    made["driver"] = {"link": "1", "angle": 30, "omega": -2}
    assert 30 == pytest.approx(math.degrees(mechanism_of(made).drivers[0].values[0]))


def test_where_rolling_starts_is_an_angle_of_a_link_or_the_travel_of_one_that_slides():
    made = changed(WHEELS, "links.2.start", -30)
    made["frame"]["guides"] = {"h": {"through": [0, -20], "angle": 0}}
    made["links"]["3"] = {"on": "0.h", "start": 15}
    made["gears"]["r"] = {"between": ["1", "3"], "teeth": [20, "rack"]}
    starts = mechanism_of(made).starts
    assert (pytest.approx(math.radians(-30)), pytest.approx(0.015)) == (starts["2"], starts["3/0"])


RACK = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, -20], "angle": 0}}},
    "links": {
        "1": {"points": ["A"]},
        "2": {"points": ["R"], "on": "0.h", "guides": {"p": {"through": "R", "angle": 0}}},
    },
    "gears": {"g": {"between": ["1", "2.p"], "teeth": [20, "rack"]}},
    "driver": {"link": "1", "angle": 0, "omega": 3},
}
TWO_DISCS, SWINGING, EPICYCLIC = (
    read(name).to_dict() for name in ("disc-on-disc", "cam-swinging-roller", "gears-epicyclic")
)


@pytest.mark.parametrize(
    ("scene", "path", "value", "sentence"),
    [
        (DISC, "links.1.guides", {"k": {"through": "O", "angle": 0}},
         "links.1.discs.k: 1.k is the name of a guide too; give one of them another"),
        (TWO_DISCS, "contacts.K.side", "left",
         'contacts.K.side: found "left" with two discs; two discs touch "outside" or "inside"'),
        (TWO_DISCS, "links.1.discs.k.r", -40,
         'contacts.K.side: found "outside" with a hollow outline; leave side out, or write "inside"'),
        (WHEELS, "gears.g.teeth", [-20, -30],
         "gears.g.teeth: both have internal teeth; one of them has external teeth"),
        (WHEELS, "gears.g.between", ["1.k", "2"],
         'gears.g.between: found "1.k"; a wheel is named by its link alone'),
        (EPICYCLIC, "gears.sun.carrier", "0",
         "gears.sun.carrier: link 0 does not hold both axes; it shares a point with link 1 and another with link 3"),
        (RACK, "gears.g.teeth", [-20, "rack"],
         "gears.g.teeth: found -20 with a rack; the wheel of a rack has external teeth"),
        (RACK, "links.2.guides.p.angle", 10,
         "gears.g: the pitch line is not parallel to the slide 2/0; name a guide of link 2 along which it slides"),
        (RACK, "frame.guides.h.through", [0, 0],
         "gears.g: the wheel's axis lies on the pitch line of the rack; the distance of the two is the radius of the "
         "wheel"),
        (SWINGING, "cams", {"0": SWINGING["cams"]["1"]}, "cams.0: link 0 is the frame; a cam turns"),
        (SWINGING, "cams", {"7": SWINGING["cams"]["1"]}, 'cams.7: there is no link "7"; known here: 1, 2'),
        (SWINGING, "links.2.points", ["A", "B"],
         "cams.1.follower: swings about the cam's own axis A; its pivot lies elsewhere"),
    ],
)
def test_what_touches_wrongly_is_told_in_one_sentence(scene, path, value, sentence):
    with pytest.raises(SceneError) as told:
        mechanism_of(changed(scene, path, value))
    assert sentence == str(told.value)


def inside(first, second):
    discs = changed(changed(TWO_DISCS, "links.1.discs.k.r", first), "links.2.discs.w.r", second)
    return changed(discs, "contacts.K.side", "inside")


@pytest.mark.parametrize(("radii", "sentence"), [
    ((-40, -15), "contacts.K.between: 1.k and 2.w are both hollow; one of them has a positive radius"),
    ((-10, 15), "contacts.K.between: the hollow outline 1.k is no larger than what is in it; its radius must be the "
     "larger one"),
    ((15, 15), "contacts.K.side: both radii are equal; inside, one must be smaller than the other"),
])
def test_radii_that_do_not_touch_inside_are_told_in_one_sentence(radii, sentence):
    with pytest.raises(SceneError) as told:
        mechanism_of(inside(*radii))
    assert sentence == str(told.value)


@pytest.mark.parametrize("radii", [(90, 15), (40, 95), (-90, 15)])
def test_inside_the_larger_of_two_discs_is_the_hollow_one(radii):
    (contact,) = mechanism_of(inside(*radii)).contacts
    assert [abs(r) == max(map(abs, radii)) for r in radii] == [r < 0.0 for r in contact.radii]
