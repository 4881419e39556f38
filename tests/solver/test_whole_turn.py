"""Strokes over a turn whose limit positions are told by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.symbol import Symbol
from graphkin.solver import driver_range
from graphkin.solver.path.driver_range import extremes
from tests import scenes

CRANK, COUPLER, ROCKER, GROUND, ROD = 30.0, 100.0, 60.0, 90.0, 120.0


def swung_through(guide: float) -> dict[str, Any]:
    """A rocker that swings through its line with a rod, so that the slider dwells at both ends of the swing (mm)."""
    scene = scenes.four_bar(CRANK, COUPLER, ROCKER, GROUND)
    scene["frame"]["guides"] = {"g": {"through": [GROUND, 0], "angle": guide}}
    scene["links"] |= {"5": {"points": ["C", "F"], "length": ROD}, "6": {"points": ["F"], "on": "4.g"}}
    c, s = (f(math.radians(guide)) for f in (math.cos, math.sin))
    return scene | {"driver": {"link": "1", "angle": 0, "omega": 10}, "sketch": {"C": [100, 60],
                                                                               "F": [GROUND + 180 * c, 180 * s]}}


def at_limit(reach: float) -> tuple[float, float]:
    """Directions (deg) of rocker and crank where crank and coupler are in line, their far end that far off."""
    off = math.acos((GROUND**2 + ROCKER**2 - reach**2) / (2 * GROUND * ROCKER))
    x, y = GROUND - ROCKER * math.cos(off), ROCKER * math.sin(off)
    return 180 - math.degrees(off), math.degrees(math.atan2(y, x)) + (0 if reach > COUPLER else 180)


@pytest.mark.parametrize("toward", [-0.3, 0.3])
def test_of_two_dwells_that_differ_little_the_deeper_ends_the_stroke(toward: float) -> None:
    limits = [at_limit(COUPLER + CRANK), at_limit(COUPLER - CRANK)]
    guide = (limits[0][0] + limits[1][0]) / 2 + toward
    rocker, crank = max(limits, key=lambda limit: abs(limit[0] - guide))
    off = math.radians(rocker - guide)
    travel = ROCKER * math.cos(off) + math.sqrt(ROD**2 - (ROCKER * math.sin(off)) ** 2)
    found = extremes(driver_range(mechanism_of(swung_through(guide))), Symbol.parse("stroke_6/4"))
    assert (pytest.approx((ROCKER + ROD - travel) / 1e3, rel=1e-12), pytest.approx(math.radians(crank), abs=1e-9)) == (
        found.stroke, found.low_offset,
    )


def test_of_two_equal_dwells_that_at_the_smaller_angle_of_the_crank_is_meant() -> None:
    limits = [at_limit(COUPLER + CRANK), at_limit(COUPLER - CRANK)]
    found = extremes(
        driver_range(mechanism_of(swung_through((limits[0][0] + limits[1][0]) / 2))), Symbol.parse("stroke_6/4")
    )
    first = min(crank % 360 for _, crank in limits)
    assert math.radians(first) == pytest.approx(found.low_offset, abs=1e-9)


DWELLS = """
[frame]
name = "0"
points = {{ A = [0, 0], C = [90, 0] }}
guides = {{ g = {{ through = "C", angle = 0 }} }}
[links.1]
points = ["A"]
[links.2]
points = ["C", "B"]
length = 75
[links.3]
points = ["B", "D"]
length = 200
[links.4]
points = ["D"]
on = "0.g"
[cams.1]
follower = "2"
law = [ {{ to = 100, rise = 24, by = "345" }}, {{ to = 150 }}, {{ to = 350, fall = 24, by = "345" }}, {{ to = 360 }} ]
base = {{ r = 35 }}
[sketch]
B = [30, 40]
D = [220, 0]
[driver]
link = "1"
angle = {angle}
omega = {omega}
"""


@pytest.mark.parametrize("angle", [0.0, 37.0, 100.0])
@pytest.mark.parametrize(("omega", "leaves"), [(10, [0, 150]), (-10, [100, 350])])
@pytest.mark.parametrize("output", ["swing_2", "stroke_4/0"])
def test_what_dwells_has_its_limits_where_it_leaves_them(
    output: str, omega: float, leaves: list[float], angle: float
) -> None:
    reach = driver_range(mechanism_of_text(DWELLS.format(angle=angle, omega=omega), "cam"))
    found = extremes(reach, Symbol.parse(output))
    places = np.degrees(reach.value(np.array([found.low_offset, found.high_offset]))) % 360
    assert leaves == pytest.approx(sorted((places + 1e-6).round(5) % 360), abs=1e-4)


@pytest.mark.parametrize("omega", [10, -10])
@pytest.mark.parametrize("output", ["2", "4/0"])
def test_K_counts_no_dwells(output: str, omega: float) -> None:
    # 100 degrees of rise and 200 of fall
    found = extremes(
        driver_range(mechanism_of_text(DWELLS.format(angle=37, omega=omega), "cam")), Symbol.parse(f"K_{output}")
    )
    assert (pytest.approx(2.0, rel=1e-9), pytest.approx(math.pi / 3, rel=1e-9)) == (found.ways.ratio, found.ways.lag)


def test_a_redundant_crank_turns_on_and_on_as_the_others_do() -> None:
    reach = driver_range(mechanism_of_text(scenes.DOUBLE_PARALLELOGRAM, "scene"))
    with pytest.raises(Unsolvable, match="link 4 turns on and on"):
        extremes(reach, Symbol.parse("swing_4"))
    two = reach.sweep(2)  # half a turn apart: the angles alone do not tell which way round
    assert pytest.approx(two.angle("3")) == two.angle("4")
