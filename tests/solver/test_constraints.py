"""The constraints of all links of a mechanism: their derivative and its rates are those that differences tell."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.solver import solve
from graphkin.solver.algebra import bounds
from graphkin.solver.algebra.constraints import Constraints
from graphkin.solver.algebra.pose import Array, Pose
from graphkin.solver.path.assemblies import _descended
from tests import scenes

STEP = 1e-6
SCENES = ("TRIAD", "FLOATING", "OFFSET_SLIDER", "OFFSET_SWING", "GUIDE_OVER_CRANK", "OLDHAM", "CYLINDER", "FIVE_BAR")


def of_all(name: str) -> tuple[Constraints, Pose]:
    source = getattr(scenes, name)
    scene = mechanism_of_text(source, name) if isinstance(source, str) else mechanism_of(source)
    known = solve(scene).accuracy
    system = Constraints.whole(known.structure, known.drive)
    return system, system.of(known.poses)


def moved(system: Constraints, all_: Pose, by: Array) -> Pose:
    """All links moved by parts (x / size, y / size, angle) of each member."""
    x, y, turn = np.moveaxis(by.reshape(-1, 3), 1, 0)
    z, u, count = all_.z.copy(), all_.u.copy(), len(turn)
    z[:, :count] += system.layout.size * (x + 1j * y)
    u[:, :count] *= np.exp(1j * turn)
    return replace(all_, z=z, u=u)


def later(all_: Pose, t: float) -> Pose:
    turn = np.exp(1j * (t * all_.omega + t * t / 2 * all_.alpha))
    z = all_.z + t * all_.v + t * t / 2 * all_.a
    return replace(all_, z=z, u=all_.u * turn, v=all_.v + t * all_.a, omega=all_.omega + t * all_.alpha)


def columns(system: Constraints, all_: Pose, steps: Sequence[Array]) -> Array:
    pairs = [(system.residuals(moved(system, all_, s)), system.residuals(moved(system, all_, -s))) for s in steps]
    return np.stack([(one - two)[0] for one, two in pairs], axis=1) / (2 * STEP)


@pytest.mark.parametrize("name", SCENES)
def test_the_matrix_is_the_derivative_of_the_constraints(name: str) -> None:
    system, all_ = of_all(name)
    by = columns(system, all_, [*STEP * np.eye(3 * system.layout.members)])
    assert by == pytest.approx(system.matrix(all_)[0], abs=1e-8)


@pytest.mark.parametrize("name", SCENES)
def test_the_rates_of_the_matrix_are_those_along_the_motion(name: str) -> None:
    system, all_ = of_all(name)
    _, first, second = system.matrices(system.parts(all_, 2))
    t = 1e-4 / max(np.abs(all_.omega).max(), np.abs(all_.alpha).max() ** 0.5, np.abs(all_.v).max() / system.layout.size)
    ahead, here, behind = (system.matrix(later(all_, x)) for x in (t, 0.0, -t))
    assert (ahead - behind) / 2 == pytest.approx(first * t, abs=1e-5 * np.abs(first).max() * t + 1e-14)
    assert ahead - 2 * here + behind == pytest.approx(second * t * t, abs=1e-3 * np.abs(second).max() * t * t + 1e-14)


@pytest.mark.parametrize("name", SCENES)
def test_no_entry_of_the_matrix_changes_more_than_is_told_for_errors_of_place(name: str) -> None:
    system, all_ = of_all(name)
    rng = np.random.default_rng(5)
    here, parts = system.matrix(all_), system.parts(all_, 2)
    for error in STEP * rng.uniform(0.0, 1.0, (40, 1, 3 * system.layout.members)):
        off = moved(system, all_, (error * rng.choice([-1.0, 1.0], error.shape))[0])
        change = np.abs(system.matrix(off) - here)
        assert (change <= bounds._changes(system, parts, error) * (1 + 1e-4) + 1e-15).all()


def test_a_place_to_which_a_start_descends_is_open_by_the_residual_that_is_given_for_it() -> None:
    system, _ = of_all("TRIAD")
    place = np.random.default_rng(3).uniform(-1.0, 1.0, (60, system.layout.members, 3))
    residual = _descended(system, place)
    assert np.abs(system.residuals(system.at(place))).max(axis=1) == pytest.approx(residual, abs=1e-14)


def test_starts_beside_a_position_descend_to_it() -> None:
    system, solved = of_all("TRIAD")
    place = np.random.default_rng(3).normal(0.0, 0.03, (60, system.layout.members, 3))
    place += np.stack((solved.z.real, solved.z.imag, np.angle(solved.u)), axis=2)[:, : system.layout.members]
    assert np.zeros(60) == pytest.approx(_descended(system, place), abs=1e-12)


def test_a_start_among_others_descends_to_where_it_does_alone() -> None:
    system, _ = of_all("TRIAD")
    starts = np.random.default_rng(3).uniform(-1.0, 1.0, (12, system.layout.members, 3))
    together, alone = starts.copy(), np.split(starts.copy(), 12)
    _descended(system, together)
    for start in alone:
        _descended(system, start)
    assert np.concatenate(alone) == pytest.approx(together, abs=1e-9)
