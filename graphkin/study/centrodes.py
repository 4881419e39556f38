"""Centrodes: the paths of an instant centre over the motion, in the frame and in the link that turns about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphkin.construction.centres import LinkPair
from graphkin.errors import CallError
from graphkin.scene.drivers import moves_by_law
from graphkin.scene.model import Mechanism
from graphkin.solver import Motion, driver_range, solve, structure_of
from graphkin.solver.quantities import pole

NO_TURNING = 1e-9
"""Of the fastest link: what turns slower against another has its centre at infinity."""
POSITIONS = 3600
STILL = 1e-9
"""Of the drivers' fastest rate: a link that turns slower does not turn.  Of the size of the mechanism: a centre that
moves less rests."""
FRAMES = 120
ENDS = 1e-3
"""Of a range that ends: so far inside it the motion turns back."""


@dataclass(frozen=True)
class Centrode:
    """The instant centre of a link against the frame over a sweep of the driver.

    fixed : complex, shape (n,), its place in the frame (m); NaN where the position is not solved or the link does not
        turn
    moving : complex, shape (n,), its place in the link's own axes (m)
    joined : bool, shape (n - 1,), whether the curves continue from a place to the next: not where the link ceases to
        turn between the two, so that the centre passes through infinity
    """

    fixed: NDArray[np.complex128]
    moving: NDArray[np.complex128]
    joined: NDArray[np.bool_]


def centrode(motion: Motion, link: str) -> Centrode:
    """The centrodes of a link from a sweep.

    The centre lies at z + i v / omega, where no point of the link has a velocity; in the link's axes that is
    i v / (omega u) (Bottema and Roth, Theoretical Kinematics, ch. VIII; Norton, Design of Machinery, 6.6).
    """
    pose = motion.poses[link]
    turns = motion.ok & (np.abs(pose.omega) > 0.0)
    omega = np.where(turns, pose.omega, np.nan)
    with np.errstate(invalid="ignore"):
        arm = 1j * pose.v / omega
    fixed, moving = pose.z + arm, arm * np.conj(pose.u)
    joined = (omega[:-1] * omega[1:] > 0.0) & turns[:-1] & turns[1:]
    return Centrode(np.asarray(fixed), np.asarray(moving), np.asarray(joined))


def turning_centrodes(scene: Mechanism, values: Mapping[str, float] | None, link: str) -> tuple[Motion, Centrode]:
    """The motion over the whole turn of the first driver from these values (rad, m) on, and the centrodes of a link.

    Raises
    ------
    CallError : the link does not turn, or turns about a fixed pivot
    Unsolvable : wrong mobility, the start cannot be assembled or reached
    """
    motion = solve(scene, at=values, sweep=POSITIONS)
    curves, rates = centrode(motion, link), np.abs(motion.omega(link)[motion.ok])
    if not len(rates) or rates.max() <= STILL * max(abs(d.values[1]) for d in scene.drivers):
        raise CallError.of(f"centrode {link}", "the link never turns its centre is always", "name a link that turns")
    places = curves.fixed[np.isfinite(curves.fixed)]
    if np.abs(places - places[0]).max() <= STILL * scene.size:
        raise CallError.of(f"centrode {link}", "the link turns about a fixed pivot its",
                           "name a link with no fixed pivot")
    return motion, curves


def steady(scene: Mechanism) -> Mechanism:
    """The scene with unit rates for drivers at rest or driven by a law: a mechanism at rest has centres too."""
    if any(d.values[1] for d in scene.drivers) and not moves_by_law(scene):
        return scene
    return replace(scene, drivers=tuple(d.at_rate(1.0) for d in scene.drivers))


def played(scene: Mechanism, values: Mapping[str, float]) -> tuple[Motion, dict[str, NDArray[np.float64]]]:
    """The motion over the whole range of the first driver, from these values (rad, m) on: a turn, or there and back,
    slower towards the ends, so that the last frame is the first again; and the angle of each link from its first (rad).

    Raises
    ------
    Unsolvable : wrong mobility, the start cannot be assembled or reached
    """
    reach = driver_range(structure_of(steady(scene)), values)
    low, high = reach.ends
    offsets = np.linspace(0.0, high, FRAMES + 1)
    if not reach.full:
        low, high = low + ENDS * (high - low), high - ENDS * (high - low)
        begin = np.arccos(np.clip(1.0 + 2.0 * low / (high - low), -1.0, 1.0))
        offsets = low + (high - low) * (1 - np.cos(begin + np.linspace(0.0, 2 * np.pi, FRAMES + 1))) / 2
    motion = reach.motion(offsets, extended=False)
    names = [link.name for link in motion.scene.links]
    if not motion.ok[0]:
        return motion, {name: motion.angle(name) for name in names}
    return motion, {name: reach.angle(motion, name) - reach.angle(motion, name)[0] for name in names}


def pole_path(motion: Motion, pair: LinkPair) -> NDArray[np.complex128]:
    """The places of a centre over a motion (m), NaN where it is at infinity or none."""
    q, omega = pole(*(motion.poses[link] for link in pair))
    fastest = np.max([np.abs(p.omega) for p in motion.poses.values()], axis=0)
    turns = motion.ok & (np.abs(omega) > NO_TURNING * fastest)
    with np.errstate(all="ignore"):
        return np.where(turns, q / omega, complex(np.nan, np.nan))


def branches(places: NDArray[np.complex128], joined: NDArray[np.bool_]) -> list[list[complex]]:
    """The places in runs that a pen draws without lifting; the end of a turn joins its start."""
    pieces = np.split(places, np.flatnonzero(~joined) + 1)
    runs = [run for run in (piece[np.isfinite(piece)].tolist() for piece in pieces) if run]
    if len(places) and np.isfinite(places[0]) and np.isfinite(places[-1]) and joined[0] and joined[-1]:
        step = abs(places[1] - places[0]) + abs(places[-1] - places[-2])
        if abs(places[0] - places[-1]) <= step:
            runs[-1].append(complex(places[0]))
    return runs
