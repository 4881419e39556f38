"""The stated error bounds against 50 digits on random mechanisms (a hundred thousand: tests/bench/accuracy.py)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from graphkin.scene import mechanism_of
from graphkin.solver import solve
from graphkin.solver.bounds import carried
from graphkin.solver.drivers import Drive
from graphkin.solver.group_errors import Rows
from graphkin.solver.larger_groups import System
from graphkin.solver.pose import Array, ErrorBound, Pose
from tests import EVERYTHING, rolling_linkages
from tests.bench.accuracy import measure
from tests.bench.larger import measure_larger
from tests.bench.tally import KINDS, Tally

MANY = 20 if EVERYTHING else 1
RUNS: dict[str, Callable[[], Tally]] = {
    "16 digits throughout": lambda: measure(MANY * 180, 7, False, each=3),
    "as given out": lambda: measure(MANY * 180, 7, True, each=3),
    "larger groups": lambda: measure_larger(MANY * 48, 3, each=12),
}


@cache
def measured(run: str) -> Tally:
    return RUNS[run]()


@pytest.fixture(params=list(RUNS))
def tally(request: pytest.FixtureRequest) -> Tally:
    return measured(request.param)


def test_the_true_error_never_exceeds_the_bound(tally: Tally) -> None:
    assert tally.broken == []


@pytest.mark.parametrize("kind", KINDS)
def test_nine_bounds_in_ten_are_within_1000_times_the_true_error(tally: Tally, kind: str) -> None:
    assert tally.within(kind) > 0.88  # of a few hundred; of a hundred thousand it is more than 0.9


def test_next_to_no_position_of_dyads_is_refused() -> None:
    tally = measured("as given out")
    assert tally.refused < 0.02 * len(tally.ratios)


STEP = 1e-7
NO_ERROR = ErrorBound(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
ERRORS = {"position": "z", "velocity": "v", "acceleration": "a", "angle": "u", "omega": "omega", "alpha": "alpha"}


def moved(pose: Pose, error: str, along: complex = 1.0) -> Pose:
    """A frame with an error of ``STEP`` in one of its six numbers."""
    if error == "angle":
        return replace(pose, u=pose.u * np.exp(1j * STEP))
    by = STEP if error in ("omega", "alpha") else STEP * along
    return replace(pose, **{ERRORS[error]: getattr(pose, ERRORS[error]) + by})


@pytest.mark.parametrize("error", ERRORS)
@pytest.mark.parametrize("arm", ["z", "v", "a"])
def test_each_error_of_a_frame_reaches_the_end_of_an_arm(error: str, arm: str) -> None:
    frame: Any = Pose(0j, 1 + 0j, 0j, 0.7, 0j, -1.3)
    point = replace(Pose(0j, 1 + 0j, 0j, 0.0, 0j, 0.0), **{arm: 2.0 - 1.0j})
    way: Any = tuple(abs(x) for x in (point.z, point.v, point.a))
    bound = carried(replace(NO_ERROR, **{error: STEP}), frame, way)
    there, true = moved(frame, error).of(point), frame.of(point)
    for field, most in zip("zva", bound.of_point, strict=True):
        assert abs(getattr(there, field) - getattr(true, field)) <= most * (1 + 1e-5) + 1e-15


@pytest.mark.parametrize("make", [rolling_linkages.wheel_at_its_rim, rolling_linkages.five_bar_by_its_middle])
@pytest.mark.parametrize("error", ERRORS)
def test_each_error_of_a_link_reaches_the_constraints_of_its_group(make: Callable[[], Any], error: str) -> None:
    motion = solve(mechanism_of(make()))
    structure = motion.structure
    drive = Drive.at(structure, motion.values).followed(structure)
    system = System.whole(structure, drive)
    poses = {**system.known, **{name: motion.poses[name].spread(1) for name in system.group.members}}
    rolled = np.zeros((1, len(system.group.rolling)))

    def rates(changed: dict[str, Pose]) -> Array:
        return system.constraints(system.of(changed))

    for name in system.group.members:
        errors = {name: ErrorBound(*(np.full(1, STEP if k == error else 0.0) for k in ERRORS))}
        rows = Rows(system, poses, errors, lambda _: 0.0, rolled)
        change = np.max([np.abs(rates({**poses, name: moved(poses[name], error, along)}) - rates(poses))
                         for along in (1.0, 1j)], axis=0)  # fmt: skip
        for order in range(3):
            most = np.array([float(np.ravel(row)[0]) for row in rows.off(order)])
            assert (change[order, 0] <= most * (1 + 1e-5) + 1e-14).all(), (name, order)
