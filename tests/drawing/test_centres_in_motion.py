"""Instant centres in motion."""

import cmath
import math
import xml.etree.ElementTree as ET

import pytest

import graphkin
from graphkin.drawing import svg_bytes
from graphkin.drawing.ink.primitives import Circle, Group, walk

SVG = "{http://www.w3.org/2000/svg}"
SWINGING = {
    "frame": {"points": {"A": [0, 0], "D": [100, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 80},
        "2": {"points": ["B", "C"], "length": 90},
        "3": {"points": ["D", "C"], "length": 60},
    },
    "driver": {"link": "1", "angle": 40, "omega": 0},
    "sketch": {"C": [120, 60]},
}


def groups(drawing):
    return {thing.id: thing for thing in walk(drawing.children) if isinstance(thing, Group)}


def place(group, frame):
    """Where the dot of a centre is at a frame (mm on the page)."""
    dot = [thing.centre for thing in group.children if isinstance(thing, Circle)][-1]
    return dot + (group.motion.moves[frame] if group.motion else 0)


@pytest.mark.parametrize("frame", [0, 17, 60, 111, 120])
def test_a_centre_stands_at_each_frame_where_it_is_drawn_at_that_position(frame):
    scene = "slider-crank-s50-e16-K1.2"
    there = graphkin.centres(scene)
    own = groups(there.in_motion)
    found = graphkin.centres(scene, at=graphkin.read(scene).driver.angle + 3 * frame)
    for pair in ("1-3", "2-4"):
        x, y = found.data["centres"][pair]["point"]
        pivot = place(own["centre-1-4"], 0)
        expected = pivot + complex(x, -y) * there.centres.mm / 1000
        name = "centre-" + "-".join(sorted(pair.split("-")))
        if own[name].motion.moves[frame] is not None:
            assert expected == pytest.approx(place(own[name], frame), abs=1e-9)


@pytest.mark.parametrize("frame", [17, 60, 111])
def test_joints_and_links_are_carried_to_where_they_lie_at_that_position(frame):
    scene = "slider-crank-s50-e16-K1.2"
    there = graphkin.centres(scene)
    own = groups(there.in_motion)
    start = graphkin.read(scene).driver.angle
    places = [graphkin.solve(scene, at=start + 3 * k).data["positions"][0]["points"] for k in (0, frame)]
    for part, point in (("point-B", "B@2"), ("point-C", "C@3"), ("link-2", "B@2"), ("link-3", "C@3")):
        (x0, y0), (x, y) = (table[point]["position"] for table in places)
        expected = complex(x - x0, y0 - y) * there.centres.mm / 1000
        assert expected == pytest.approx(own[part].motion.moves[frame], abs=1e-9)


def test_links_turn_with_the_motion():
    motion = groups(graphkin.centres("slider-crank-s50-e16-K1.2").in_motion)["link-1"].motion
    assert [0, -90, -180, -360] == pytest.approx([motion.turns[k] for k in (0, 30, 60, 120)])


def test_a_motion_that_ends_goes_there_and_back_and_comes_to_where_it_began():
    motion = groups(graphkin.centres(SWINGING).in_motion)["link-3"].motion
    assert abs(motion.turns[-1]) < 1e-9
    assert max(map(abs, motion.turns)) > 30


def test_the_picture_plays_and_every_frame_of_it_is_a_number():
    page = ET.fromstring(svg_bytes(graphkin.centres("slider-crank-s50-e16-K1.2").in_motion, debug=True))
    played = [e for e in page.iter() if e.tag in (SVG + "animateTransform", SVG + "animate")]
    assert {"translate", "rotate", None} >= {e.get("type") for e in played}
    assert {121} == {len(e.get("values").split(";")) for e in played}


def test_the_path_of_a_centre_of_a_rolling_pair_of_bars_is_a_circle():
    # a crank as long as its rod on a line through its pivot: the rod's centre against the frame runs on a circle
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 50},
            "2": {"points": ["B", "C"], "length": 50},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 30, "omega": 1},
    }
    own = groups(graphkin.centres(scene).in_motion)
    pivot = place(own["centre-0-1"], 0)
    for frame in (0, 7, 13):
        offset = place(own["centre-0-2"], frame) - pivot
        assert 2 * abs(place(own["centre-1-2"], frame) - pivot) == pytest.approx(abs(offset), rel=1e-9)
        assert -math.radians(30 + 3 * frame) == pytest.approx(cmath.phase(offset), abs=1e-9)
