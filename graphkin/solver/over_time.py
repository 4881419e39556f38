"""The motion at moments in time, where drivers move by laws: their rates change from one moment to the next.

Velocities are linear in the rates of the drivers, accelerations linear in their second rates and quadratic in their
rates (influence coefficients, Thomas and Tesar, ASME J. Mech. Des. 1982): they are put together from motions in which
one driver, or two, move at the rate 1.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from graphkin.scene.model import Mechanism
from graphkin.scene.over_time import at_time
from graphkin.solver.assemblies import choose_forms, own_values
from graphkin.solver.diagnosis import assembly_words, limit_why
from graphkin.solver.driver_range import driver_range, way_to
from graphkin.solver.joints import Drive
from graphkin.solver.mobility import structure_of
from graphkin.solver.motion import Motion, motion_of
from graphkin.solver.pose import Array, Pose
from graphkin.solver.rounding import UNIT, ErrorBound
from graphkin.structure import Structure
from graphkin.words import Wording

__all__ = ["over_time"]

FEW = 8 * UNIT
"""Relative error of putting a motion together."""


def over_time(of: Mechanism | Structure, times: Array, fine: bool = True) -> Motion:
    """The motion at moments (s) of the laws by which drivers move, from the scene's own assembly on.

    ``fine`` is False for curves: 16 digits throughout, and no reasons where the status is not ok.

    Raises
    ------
    Unsolvable : wrong mobility; of a single driver also where the scene's own position cannot be assembled
    CallError : a moment before or after all laws
    """
    structure = structure_of(of)
    scene = structure.scene
    moments = [at_time(scene, float(t)) for t in times]
    value = np.array([[values[d.key] for d in scene.drivers] for _, values in moments])
    rates = np.array([[d.values[1:] for d in moved.drivers] for moved, _ in moments])
    at = _one_driver(structure, value, fine) if value.shape[1] == 1 else _several_drivers(structure, value, fine)
    return _together(list(_terms(at, rates[..., 0], rates[..., 1])), structure.scene.size)


At = Callable[[Array], Motion]
"""The motion at all moments with these rates of the drivers, shape (drivers,), without second rates."""


def _one_driver(structure: Structure, value: Array, fine: bool) -> At:
    reach = driver_range(structure)
    offset, rounds = reach.sense * (value[:, 0] - reach.start[0]), np.zeros(len(value))
    if reach.full:
        rounds = np.floor(offset / abs(reach.wide))
        offset = np.remainder(offset, abs(reach.wide))
    along = reach.motion(offset, unit=True, fine=fine)  # at the rate 1 in its sense
    poses = {n: replace(p, v=reach.sense * p.v, omega=reach.sense * p.omega) for n, p in along.poses.items()}
    whole = reach.turned(np.ones(1))
    turned = {name: angle + rounds * whole[name] for name, angle in along.turned.items()}
    motion = replace(along, poses=poses, values=value, turned=turned)
    return lambda unit: motion


def _several_drivers(structure: Structure, value: Array, fine: bool) -> At:
    """Along the way from moment to moment; what is not reached is left out, and the way goes on from before it."""
    from graphkin.solver.continuity import follow_path

    forms = choose_forms(structure)
    assembly = assembly_words(structure, forms)
    here, found = own_values(structure.scene), []
    sums: list[dict[str, float]] = []
    good, why = np.ones(len(value), dtype=bool), list[Wording]([""] * len(value))
    for k, goal in enumerate(value):
        if not np.array_equal(here, goal):
            path = follow_path(structure, forms, here, goal) if k else way_to(structure, forms, goal)
            if path.limit is None:
                here, forms = goal, path.last_forms
                before = sums[-1] if sums else {}
                sums.append({n: before.get(n, 0.0) + float(by[0]) for n, by in path.turned(np.ones(1)).items()})
            else:
                good[k], why[k] = False, limit_why(structure, path)
        found.append(forms)
        sums[k:] = [sums[-1] if sums else {}]
    stacked = {i: np.stack([f[i] for f in found]) for i in forms}

    def at(unit: Array) -> Motion:
        drive = Drive(value, np.broadcast_to(unit, value.shape), np.zeros_like(value))
        motion = motion_of(structure, drive, stacked, assembly, good, fine=fine)
        said = tuple(a or b for a, b in zip(motion.reasons, why, strict=True))
        return replace(motion, reasons=said, turned={n: np.array([s.get(n, 0.0) for s in sums]) for n in motion.poses})

    return at


@dataclass(frozen=True)
class _Term:
    """A motion at constant rates, with what it counts for at each moment, shape (n,): in velocities; in accelerations
    by its accelerations (``square``) and by its velocities (``second``)."""

    motion: Motion
    factor: Array
    square: Array
    second: Array


def _terms(at: At, rate: Array, second: Array) -> Iterator[_Term]:
    """Each driver alone, and each two together for what their rates do to accelerations together, from which what each
    does alone is taken away."""
    one = np.eye(rate.shape[1])
    for k, unit in enumerate(one):
        own, others = rate[:, k], rate.sum(axis=1) - rate[:, k]
        yield _Term(at(unit), own, own * (own - others), second[:, k])
    nothing = np.zeros(len(rate))
    for k, m in combinations(range(len(one)), 2):
        yield _Term(at(one[k] + one[m]), nothing, rate[:, k] * rate[:, m], nothing)


def _together(terms: list[_Term], size: float) -> Motion:
    """The motion that terms make together, with the bound of it."""
    first = terms[0].motion
    poses = {name: _pose([(t, t.motion.poses[name]) for t in terms]) for name in first.poses}

    def sums(speeds: Callable[[Motion], Array], pushes: Callable[[Motion], Array]) -> tuple[Array, Array]:
        fast = sum((abs(t.factor) * speeds(t.motion) for t in terms), np.zeros(len(first)))
        pushed = sum((abs(t.square) * pushes(t.motion) + abs(t.second) * speeds(t.motion) for t in terms),
                     np.zeros(len(first)))  # fmt: skip
        return fast, pushed

    def most(field: str, turning: str, motion: Motion) -> Array:
        poses = motion.poses.values()
        return np.asarray(np.max([abs(getattr(p, field)) + size * abs(getattr(p, turning)) for p in poses], axis=0))

    largest = sums(lambda m: most("v", "omega", m), lambda m: most("a", "alpha", m))
    points = sums(lambda m: m.bound.velocity, lambda m: m.bound.acceleration)
    turning = sums(lambda m: m.bound.omega, lambda m: m.bound.alpha)
    rough = sums(lambda m: m.rough[0], lambda m: m.rough[1])
    lost = tuple(FEW * x for x in largest)
    bound = ErrorBound(
        first.bound.position, points[0] + lost[0], points[1] + lost[1],
        first.bound.angle, turning[0] + lost[0] / size, turning[1] + lost[1] / size,
    )  # fmt: skip
    return replace(first, poses=poses, bound=bound, rough=(rough[0] + lost[0], rough[1] + lost[1]))


def _pose(terms: list[tuple[_Term, Pose]]) -> Pose:
    place = terms[0][1]
    v, omega = (sum(t.factor * getattr(p, f) for t, p in terms) for f in ("v", "omega"))
    a, alpha = (
        sum(t.square * getattr(p, push) + t.second * getattr(p, speed) for t, p in terms)
        for push, speed in (("a", "v"), ("alpha", "omega"))
    )
    return Pose(place.z, place.u, v, omega, a, alpha)
