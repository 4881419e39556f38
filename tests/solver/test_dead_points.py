"""Driver values given from a dead point: right to rounding however near, the assembly as sketched."""

from __future__ import annotations

import math

import mpmath as mp
import numpy as np
import pytest

import graphkin
from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.solver import Motion, solve, structure_of
from graphkin.solver.path.dead_points import dead_points
from tests import scenes

pytestmark = pytest.mark.quick

# 3-4-5: rod and rocker are in line at crank 90 and -90, and fold at 0
REACHING = """
[frame]
points = { A = [0, 0], D = [400, 0] }
[links.1]
points = ["A", "B"]
length = 300
[links.2]
points = ["B", "C"]
length = 200
[links.3]
points = ["C", "D"]
length = 300
[driver]
link = "1"
omega = 10
from = "dead point"
{driver}
[sketch]
C = {C}
"""

def at(driver: str, left: bool = True) -> Motion:
    place = "[300, 280]" if left else "[200, 20]"
    return solve(mechanism_of_text(REACHING.replace("{driver}", driver).replace("{C}", place), "scene"))


def rocker(distance: str) -> float:
    """Rate of the rocker at crank 90 deg less a distance, to 50 digits."""
    with mp.workdps(80):
        a, b, c, d = mp.mpf("0.3"), mp.mpf("0.2"), mp.mpf("0.3"), mp.mpf("0.4")
        q = mp.pi / 2 - mp.mpf(distance) * mp.pi / 180
        pin = a * mp.expj(q)
        line = pin - d
        far = abs(line)
        cosine = (c * c + far * far - b * b) / (2 * c * far)
        # the rate of the length of the diagonal, then of the angle between it and the rocker
        slip = (mp.conj(line) * (1j * 10 * pin)).real / far
        turn = (mp.conj(line) * (1j * 10 * pin)).imag / far**2
        bend = (1 / c - cosine / far) * slip / mp.sqrt(1 - cosine**2)
        return float(turn + bend)


@pytest.mark.parametrize("distance", ["1e-2", "1e-5", "1e-9", "1e-12"])
def test_a_rate_is_right_to_rounding_at_any_distance(distance: str) -> None:
    found = at(f"angle = -{distance}\nnear = 90").omega("3")[0]
    assert found == pytest.approx(rocker(distance), rel=1e-14)


def test_the_bound_stays_at_rounding() -> None:
    motion = at("angle = -1e-12\nnear = 90")
    assert motion.bound.omega[0] < 1e-14 * abs(motion.omega("3")[0])


def test_the_assembly_is_the_sketched_one() -> None:
    one, other = (at("angle = -1e-9\nnear = 90", left).omega("3")[0] for left in (True, False))
    assert one * other < 0


def test_a_motion_that_begins_has_positive_distances() -> None:
    assert at("angle = 1e-9\nnear = -90").status[0] == "ok"


def test_several_dead_points_are_listed() -> None:
    with pytest.raises(Unsolvable, match=r"at 0 deg, 90 deg; write near"):
        at("angle = -1e-9")


def test_without_a_dead_point_it_says_so() -> None:
    text = scenes.FOUR_BAR.replace("angle = 60", 'angle = 1e-9\nfrom = "dead point"')
    with pytest.raises(Unsolvable, match="no dead point"):
        solve(mechanism_of_text(text, "crank-rocker"))


def test_a_travel_may_count_from_a_dead_point() -> None:
    # crank and rod in line at 170
    text = scenes.PISTON.replace("travel = 150", 'travel = -1e-9\nfrom = "dead point"\nnear = 170')
    motion = solve(mechanism_of_text(text + "[sketch]\nB = [49, 1]\n", "scene"))
    with mp.workdps(60):
        s = mp.mpf(170) - mp.mpf("1e-9")
        crank = mp.acos((50**2 + s**2 - 120**2) / (100 * s))
    assert motion.angle("1")[0] == pytest.approx(float(crank), rel=1e-14)


def test_dead_points_have_fifty_digits() -> None:
    text = REACHING.replace("{driver}", "angle = -1e-9\nnear = 90").replace("{C}", "[300, 280]")
    found = max(p.value for p in dead_points(structure_of(mechanism_of_text(text, "scene"))))
    with mp.workdps(60):
        assert abs(mp.mpf(str(found)) - mp.pi / 2) < mp.mpf("1e-47")


def test_a_dead_position_tells_where_the_dead_point_lies() -> None:
    motion = solve(mechanism_of_text(scenes.PARALLELOGRAM, "scene"), at={"1": math.radians(180)})
    assert str(motion.why[0]).endswith("it lies at 1 = 180 deg, 0 deg away")


def test_every_public_function_takes_such_a_scene() -> None:
    text = REACHING.replace("{driver}", "angle = -5\nnear = 90").replace("{C}", "[300, 280]")
    given = graphkin.solve(mechanism_of_text(text, "scene")).motion
    assert np.degrees(given.scene.drivers[0].values[0]) == pytest.approx(85.0)
    assert graphkin.check(mechanism_of_text(text, "scene")).ok


NEAR = """
[frame]
points = { A = [0, 0] }
guides = { h = { through = [0, -35.712], angle = 0 } }
[links.1]
points = ["A", "B"]
length = 154.5
[links.2]
points = ["B", "C"]
length = 76.571073
[links.3]
points = ["C"]
on     = "0.h"
[driver]
link  = "1"
from  = "dead point"
near  = -46.6
angle = -1
omega = 10
"""


def test_the_nearest_dead_point_is_refused_with_the_list_where_the_motion_lies_on_its_other_side() -> None:
    with pytest.raises(Unsolvable, match=r"nearest to near = -46.6 deg is at -46.6147.* begins.*dead points: .*15.33"):
        structure_of(mechanism_of_text(NEAR, "near"))


def test_the_dead_point_nearest_to_the_wish_is_taken() -> None:
    driver = structure_of(mechanism_of_text(NEAR.replace("angle = -1", "angle = 1"), "near")).scene.drivers[0]
    # the pin is as far below the guide's foot as the rod reaches: asin((-35.712 - 76.571073) / 154.5), one degree on
    assert math.asin((-35.712 - 76.571073) / 154.5) + math.radians(1) == pytest.approx(driver.values[0], abs=1e-14)


@pytest.mark.parametrize("near", [0, 180])
def test_a_change_point_is_a_dead_point_to_start_from(near: float) -> None:
    driver = {"link": "1", "from": "dead point", "near": near, "angle": -1, "omega": 10}
    found = structure_of(mechanism_of(scenes.four_bar(50, 100, 50, 100, driver=driver))).scene.drivers[0]
    assert math.radians(near - 1) == pytest.approx(found.values[0], abs=1e-14)


def test_dead_points_half_a_turn_away_are_found() -> None:
    driver = {"link": "1", "from": "dead point", "angle": -1, "omega": 10}
    with pytest.raises(Unsolvable, match="there are dead points at -180 deg, 0 deg"):
        structure_of(mechanism_of(scenes.four_bar(50, 100, 50, 100, driver=driver)))


def test_a_dead_point_to_start_from_is_refused_by_the_link_that_rolls() -> None:
    scene = {
        **scenes.four_bar(20, 90, 40, 100, driver={"link": "w", "from": "dead point", "angle": 1, "omega": 10}),
        "gears": {"g": {"between": ["w", "1"], "teeth": [20, 20]}},
    }
    scene["frame"]["points"]["W"] = [-60, 0]
    scene["links"]["w"] = {"points": ["W"], "start": 0}
    with pytest.raises(Unsolvable, match="link 1: dead points are found for mechanisms without rolling links only"):
        structure_of(mechanism_of(scene))
