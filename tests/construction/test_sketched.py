"""Where a sketch puts the links of a larger group: those without two sketched points by the guides at their points."""

from __future__ import annotations

from typing import Any

import pytest

import graphkin
from graphkin.construction.position.links_on_paper import PlacedLinks
from graphkin.construction.position.position import sketched_poses
from graphkin.plane import dot
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import PointRef
from graphkin.structure import LargerGroup, analyse

BESIDE_A_GUIDE: dict[str, Any] = {  # the guides of link 5 lie beside its pin: they tell how it is turned
    "frame": {"points": {"A": [0, 0], "C": [252.366, 194.709]}},
    "links": {
        "1": {"points": ["A", "D"], "length": 61.263, "guides": {"g": {"through": [-70.161, -237.669],
                                                                      "angle": -167.54}}},
        "2": {"points": ["C"], "on": "5.g1", "angle_on": 88.7},
        "3": {"points": ["B"], "on": "1.g", "angle_on": -58.1},
        "4": {"points": ["D"], "on": "5.g2"},
        "5": {"points": ["B"], "guides": {"g1": {"through": [-88.488, 100.358], "angle": 69.1},
                                          "g2": {"through": [-97.121, -232.721], "angle": -4.5}}},
    },
    "driver": {"link": "1", "angle": 116.14, "omega": 10.45},
    "sketch": {"B": [216.86, 76.06], "D": [-26.99, 55.0]},
}
TURNED_ALIKE: dict[str, Any] = {  # one angle for links 2, 3, 4, 5: that at which all their guides pass their pins
    "frame": {"points": {"E": [81.75, 270.022]}, "guides": {"g": {"through": [69.194, -25.306], "angle": -50.1},
                                                            "h": {"through": [185.81, 59.693], "angle": -115}}},
    "links": {
        "1": {"points": ["D"], "on": "0.g"},
        "2": {"points": ["C"], "guides": {"g4": {"through": [-5.899, -21.891], "angle": 194.6}}, "on": "6.g3",
              "angle_on": 30},
        "3": {"points": ["D"], "on": "2.g4", "angle_on": -2.8},
        "4": {"points": ["C"], "guides": {"g2": {"through": [105.885, -250.291], "angle": -57.9}}, "on": "5.g5",
              "angle_on": -6.6},
        "5": {"points": ["B"], "guides": {"g5": {"through": [22.332, -152.882], "angle": 212.3}}},
        "6": {"points": ["B"], "guides": {"g3": {"through": [190.118, -51.612], "angle": 36.7}}, "on": "0.h"},
        "7": {"points": ["E"], "on": "4.g2"},
    },
    "driver": {"slide": "1", "travel": -23.883, "velocity": -161.6},
    "sketch": {"B": [208.5, 108.3], "C": [71.6, 4.9], "D": [53.9, -7.0]},
}
NO_POINT: dict[str, Any] = {  # link 3 has no point: the guide on which it runs, and that on it, tell its place
    "frame": {"points": {"A": [0, 0], "C": [63.83, 171.664]}},
    "links": {
        "1": {"points": ["A", "D"], "length": 54.639},
        "2": {"points": ["B"], "guides": {"g1": {"through": [43.337, 1.377], "angle": -112.4}}},
        "3": {"guides": {"g2": {"through": [-75.554, 71.396], "angle": 141.3}}, "on": "4.g3", "angle_on": 30},
        "4": {"points": ["D"], "guides": {"g3": {"through": [78.475, -52.892], "angle": -69}}, "on": "2.g1"},
        "5": {"points": ["B", "C"], "length": 138.024, "on": "3.g2", "angle_on": -10.17},
    },
    "driver": {"link": "1", "angle": 48.59, "omega": -10.06},
    "sketch": {"B": [138.5, 55.6], "D": [36.1, 41.0]},
}
ROD: dict[str, Any] = {  # cylinder 4 points at G, and at nothing else: its rod lies on it, not behind
    "frame": {"points": {"A": [0, 0], "D": [201.804, -48.256], "G": [118.464, 25.768]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 61.998},
        "2": {"points": ["B", "C"], "length": 136.756, "at": {"H": [24.143, 20.477]}, "on": "6.g2",
              "angle_on": -30.11},
        "3": {"points": ["C", "D"], "length": 160.739},
        "4": {"points": ["E"]},
        "5": {"points": ["E", "F"], "length": 183.227, "guides": {"g1": {"through": [118.704, -75.175],
                                                                        "angle": 0.97}}},
        "6": {"guides": {"g2": {"through": [152.579, 15.513], "angle": -154.5}}, "on": "5.g1", "angle_on": 56},
        "7": {"points": ["F", "H"], "length": 63.717},
        "8": {"points": ["G"], "on": "4"},
    },
    "driver": [{"link": "1", "angle": 71.16, "omega": 5.4}, {"slide": "8", "travel": 116.966, "velocity": 42.2}],
    "sketch": {"B": [20.0, 58.7], "C": [149.2, 103.6], "E": [235.4, 29.9], "F": [82.0, 130.1], "H": [36.1, 86.0]},
}
SCENES = {"beside a guide": BESIDE_A_GUIDE, "turned alike": TURNED_ALIKE, "no point": NO_POINT, "rod": ROD}


@pytest.mark.parametrize("name", SCENES)
def test_the_links_lie_where_an_exact_sketch_shows_them(name: str) -> None:
    scene = SCENES[name]
    motion = graphkin.solve(scene).motion
    at = {p: 1e3 * complex(motion.point(p).z[0]) for p in scene["sketch"]}
    sheet = graphkin.check({**scene, "sketch": {p: [z.real, z.imag] for p, z in at.items()}}).sheet
    per = 1e3 * sheet.scales.length
    assert {p: sheet.points[PointRef(p)] * per for p in at} == pytest.approx(at, abs=1e-6 * 1e3 * sheet.scene.size)


def test_a_guide_of_which_nothing_but_its_pin_is_sketched_lies_towards_what_slides_on_it() -> None:
    sheet = graphkin.check(ROD).sheet
    along = sheet.poses["4"].axis * sheet.structure.slide("8/4").guide.direction
    assert dot(sheet.poses["8"].origin - sheet.poses["4"].origin, along) > 0.0


def test_directions_are_told_by_two_sketched_points_and_by_sliding_pairs_from_them() -> None:
    """Those of link 3 by its guide on the crank, of link 4 by D and K, of link 5 by its guide for link 4, of link 2 by
    the other one."""
    block = {**BESIDE_A_GUIDE["links"]["4"], "at": {"K": [30.0, 12.0]}}
    scene = {**BESIDE_A_GUIDE, "links": {**BESIDE_A_GUIDE["links"], "4": block}}
    sheet = graphkin.check(scene).sheet
    (group,) = (e for e in sheet.structure.elements if isinstance(e, LargerGroup))
    per = 1e3 * sheet.scales.length
    places = {p: sheet.points[PointRef(p)] * per for p in "BDK"}
    exact = mechanism_of({**scene, "sketch": {p: [z.real, z.imag] for p, z in places.items()}})
    known = {name: pose for name, pose in sheet.poses.items() if name not in group.members}
    paper = PlacedLinks(sheet.structure.links, 1.0 / sheet.scales.length, dict(sheet.drivers), known)
    told = sketched_poses(analyse(exact), group, paper)
    assert set(group.members) & set(told) == {"2", "3", "4", "5"}
    for name in "2345":
        here, drawn = told[name], sheet.poses[name]
        assert (drawn.axis, drawn.origin) == pytest.approx((here.axis, here.origin), abs=1e-6)
