"""Instant centres of the validation problems against an independent solver."""

from __future__ import annotations

import cmath
import json
import math
from functools import cache
from pathlib import Path

import pytest

from graphkin.construction.centres import Centres, find_centres
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol

CASES = json.loads((Path(__file__).parent / "truth_centres.json").read_text())["cases"]
mechanism = cache(mechanism_of)
PLACES = [(name, at) for name, rows in CASES.items() for at in rows]


def centres_at(name: str, degrees: float) -> Centres:
    scene = mechanism(name)
    return find_centres(scene, {scene.drivers[0].key: math.radians(degrees)})


def deviation(centres: Centres, pair: str, true: list[float | str]) -> float:
    """Distance from the true place in the mechanism's size, or the angle between the ways to them (rad) where it lies
    further off than ten sizes or at infinity."""
    scene = centres.scene
    unit = centres.sheet.scales.length / scene.units.metres
    size = scene.size / scene.units.metres
    found = centres.of(*pair.split("-"))
    middle = centres.chart.middle * unit
    if true[0] == "inf":
        way = complex(*true[1:])
    else:
        place = complex(*true)
        if abs(place) <= 10 * size:
            assert found.point is not None
            return abs(found.point * unit - place) / size
        way = place - middle
    mine = found.direction if found.point is None else found.point * unit - middle
    assert mine is not None
    return abs(math.remainder(cmath.phase(mine / way), math.pi))


@pytest.mark.parametrize(("name", "at"), PLACES)
def test_every_centre_lies_where_the_reference_has_it(name: str, at: str) -> None:
    centres = centres_at(name, float(at))
    assert max(deviation(centres, pair, true) for pair, true in CASES[name][at].items()) <= 1e-9


@pytest.mark.parametrize("name", CASES)
def test_there_is_a_centre_for_every_two_links(name: str) -> None:
    centres = centres_at(name, float(next(iter(CASES[name]))))
    count = len(mechanism_of(name).links) + 1
    assert count * (count - 1) // 2 == sum(c.place is not None for c in centres.table.values())


def test_the_centre_of_cam_and_follower_lies_28_603_mm_from_the_cam_pivot() -> None:
    centres = find_centres(mechanism_of("cam-eccentric-flat-rocker"))
    point = centres.of("1", "2").point
    assert point is not None
    assert abs(point) * centres.sheet.scales.length * 1e3 == pytest.approx(28.60332296715029, rel=1e-12)


def test_the_cam_gives_the_follower_2_63374_rad_per_s_by_centres() -> None:
    centres = find_centres(mechanism_of("cam-eccentric-flat-rocker"))
    assert centres.velocity(Symbol.parse("omega_2")) == pytest.approx(2.633742889782669, rel=1e-12)
