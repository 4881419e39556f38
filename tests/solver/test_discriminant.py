"""Beside a limit of the motion fifty digits decide: refused, exactly at the limit, or past it on the one branch."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from graphkin.scene import mechanism_of
from graphkin.solver import solve
from tests.scenes import four_bar

# the crank of 100 brings the pin as far off the line of the slider as the rod of 50 reaches at 30 degrees
SLIDER = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 100},
        "2": {"points": ["B", "C"], "length": 50},
        "3": {"points": ["C"], "on": "0.h"},
    },
    "driver": {"link": "1", "angle": 20, "omega": 10},
}


@pytest.mark.quick
@pytest.mark.parametrize("beyond", [1e-6, 1e-9, 1e-11, 1e-13])
def test_a_hair_beyond_the_limit_the_links_do_not_reach(beyond: float) -> None:
    motion = solve(mechanism_of(SLIDER), {"1": float(np.radians(30 + beyond))})
    assert "not assembled" == motion.status[0]
    assert "30 deg" in motion.why[0]


@pytest.mark.quick
@pytest.mark.parametrize("degrees", [30.0, np.nextafter(30.0, 31.0)])
def test_as_near_as_a_decimal_of_the_file_is_the_limit_itself(degrees: float) -> None:
    assert "dead point" == solve(mechanism_of(SLIDER), {"1": float(np.radians(degrees))}).status[0]


def test_where_the_file_leaves_it_open_that_is_said() -> None:
    # the root of 1/2 has no short decimal: the rod ends its motion at 45 degrees, or a hair before or after that
    links = {**SLIDER["links"], "2": {"points": ["B", "C"], "length": 100 * 0.5**0.5}}  # type: ignore[dict-item]
    motion = solve(mechanism_of({**SLIDER, "links": links}), {"1": float(np.radians(45.0))})
    assert "dead point" == motion.status[0]
    assert "as far as the digits of the file tell" in motion.why[0]


@pytest.mark.parametrize(
    ("miss", "reached"), [(0.0, True), (1e-10, True), (1e-11, True), (-1e-11, False), (-1e-10, False)]
)
def test_past_a_flat_position_the_links_go_where_they_can(miss: float, reached: bool) -> None:
    motion = solve(mechanism_of(four_bar(50, 100, 50 + miss, 100)), {"1": float(np.radians(-60.0))})
    assert reached == motion.ok[0]
    if reached:
        # the parallelogram stays one in its change point; a linkage that does not lie flat stays on its side
        with mpmath.workdps(40):
            crank = 50 * mpmath.expjpi(mpmath.mpf(-1) / 3)
            line, rocker = 100 - crank, mpmath.mpf(repr(50 + miss))
            c = abs(line)
            along = (100**2 - rocker**2 + c**2) / (2 * c)
            side = mpmath.sqrt(100**2 - along**2) * (1 if miss else -1)
            right = complex(crank + line / c * mpmath.mpc(along, side))
        assert right / 1e3 == pytest.approx(complex(motion.position("C")[0]), abs=1e-13)
