"""Axes on axes: rates agree with what moving them a little in time gives."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest

from graphkin.scene.tables import Measure
from graphkin.solver.algebra.pose import ErrorBound, Pose, rest

pytestmark = pytest.mark.quick

NUMBERS = {"z": 0.3 - 0.2j, "v": -1.1 + 0.4j, "a": 0.7 + 2.1j, "turn": 0.8, "omega": 1.7, "alpha": -2.3}
OTHER = {"z": -0.5 + 0.1j, "v": 0.6 + 0.9j, "a": -1.2 + 0.3j, "turn": -2.1, "omega": -0.9, "alpha": 3.1}


def pose(n: dict[str, complex]) -> Pose:
    return Pose(*(np.array([x]) for x in (n["z"], np.exp(1j * n["turn"]), n["v"], n["omega"], n["a"], n["alpha"])))


def motion(n: dict[str, complex], t: mp.mpf) -> tuple[mp.mpc, mp.mpf]:
    """Place and angle at time t."""
    return n["z"] + mp.mpc(n["v"]) * t + mp.mpc(n["a"]) * t * t / 2, n["turn"] + n["omega"] * t + n["alpha"] * t * t / 2


def composed(t: mp.mpf) -> mp.mpc:
    z, turn = motion(NUMBERS, t)
    inner, _ = motion(OTHER, t)
    return z + mp.expj(turn) * inner


def inverted(t: mp.mpf) -> mp.mpc:
    z, turn = motion(NUMBERS, t)
    return -mp.expj(-turn) * z


@pytest.mark.parametrize(("order", "field"), [(0, "z"), (1, "v"), (2, "a")])
def test_composition_has_guiding_and_coriolis_terms(order: int, field: str) -> None:
    with mp.workdps(40):
        expected = complex(mp.diff(composed, 0, order))
    assert getattr(pose(NUMBERS).of(pose(OTHER)), field)[0] == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(("order", "field"), [(0, "z"), (1, "v"), (2, "a")])
def test_inverse_has_its_rates(order: int, field: str) -> None:
    with mp.workdps(40):
        expected = complex(mp.diff(inverted, 0, order))
    assert getattr(pose(NUMBERS).inverse(), field)[0] == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("field", ["z", "u", "v", "omega", "a", "alpha"])
def test_a_pose_on_its_inverse_is_at_rest(field: str) -> None:
    one = pose(NUMBERS)
    assert getattr(one.of(one.inverse()), field)[0] == pytest.approx(getattr(rest(), field)[0], abs=1e-14)


def test_a_link_that_stands_nowhere_has_neither_coordinate() -> None:
    nowhere = rest().still(1).where(np.array([False]))
    assert [True, True] == [bool(np.isnan(part[0])) for part in (nowhere.z.real, nowhere.z.imag)]


def test_a_bound_is_known_up_to_second_rates() -> None:
    bound = ErrorBound(*(np.full(2, float(k)) for k in range(6)))
    assert [1.0, 1.0] == bound.of(Measure("velocity", length=1, order=1)).tolist()
    assert [5.0, 5.0] == bound.of(Measure("angular acceleration", angle=1, order=2)).tolist()
    assert [np.inf, np.inf] == bound.of(Measure("third rate", length=1, order=3)).tolist()
