"""The instant centres over the way of the driver: their paths, and how the links move with them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphkin.scene.drivers import moves_by_law
from graphkin.scene.model import Mechanism
from graphkin.solver import Motion, driver_range, structure_of
from graphkin.solver.quantities import pole

__all__ = ["FRAMES", "CentrePaths", "centre_paths", "steady"]

FRAMES = 120
ENDS = 1e-3
"""Of a range that ends: so far inside it the motion turns back."""
NO_TURNING = 1e-9
"""Of the fastest link: what turns slower against another has its centre at infinity."""
Places = NDArray[np.complex128]


@dataclass(frozen=True)
class CentrePaths:
    """A motion there and back, or over a whole cycle, whose last frame is the first again (m, rad).

    origins, turned : of each link the place of its origin, and how far it has turned since the first frame
    points : places of the points of moving links
    centres : for each pair of links the place of their instant centre, NaN where it is at infinity or none
    cycle : whether the motion goes round, and not there and back
    """

    origins: Mapping[str, Places]
    turned: Mapping[str, NDArray[np.float64]]
    points: Mapping[str, Places]
    centres: Mapping[tuple[str, str], Places]
    cycle: bool


def steady(scene: Mechanism) -> Mechanism:
    """The scene with rates for drivers that stand still or move by a law: centres are there at rest too."""
    if any(d.values[1] for d in scene.drivers) and not moves_by_law(scene):
        return scene
    return replace(scene, drivers=tuple(d.at_rate(1.0) for d in scene.drivers))


def centre_paths(
    scene: Mechanism, values: Mapping[str, float] | None, pairs: Iterable[tuple[str, str]], frames: int = FRAMES
) -> CentrePaths:
    """Follow the centres of pairs of links over the whole way of the first driver, from these values (rad, m) on.

    Raises
    ------
    Unsolvable : wrong mobility, the start cannot be assembled or reached
    """
    reach = driver_range(structure_of(steady(scene)), values)
    low, high = reach.ends
    if reach.full:
        offsets = np.linspace(0.0, high, frames + 1)
    else:  # slower towards its ends
        low, high = low + ENDS * (high - low), high - ENDS * (high - low)
        begin = np.arccos(np.clip(-(0.0 - low) / (high - low) * 2 + 1, -1.0, 1.0))
        offsets = low + (high - low) * (1 - np.cos(begin + np.linspace(0.0, 2 * np.pi, frames + 1))) / 2
    motion = reach.motion(offsets, fine=False)
    ok = motion.ok
    links = [link.name for link in motion.scene.links]
    first = {name: motion.angle(name) for name in links}
    return CentrePaths(
        {name: np.asarray(motion.poses[name].z) for name in links},
        {name: reach.angle(motion, name) - reach.angle(motion, name)[0] if ok[0] else first[name] for name in links},
        {p: motion.position(p) for p in motion.scene.holders if p not in motion.scene.frame.points},
        {pair: _centre(motion, pair) for pair in pairs},
        reach.full,
    )


def _centre(motion: Motion, pair: tuple[str, str]) -> Places:
    q, omega = pole(*(motion.poses[link] for link in pair))
    fastest = np.max([np.abs(p.omega) for p in motion.poses.values()], axis=0)
    turns = motion.ok & (np.abs(omega) > NO_TURNING * fastest)
    with np.errstate(all="ignore"):
        return np.asarray(np.where(turns, q / omega, complex(np.nan, np.nan)))
