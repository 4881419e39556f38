"""The flywheel that keeps a machine even: work between driving and resisting moment over a cycle.

The driving moment is constant and does in a cycle the work that the balance does: where it is less than the balance
needs, kinetic energy falls, where it is more, it rises.  The greatest difference of it is the excess work W, and a
flywheel of J_F = W / (delta omega^2) keeps the coefficient of speed fluctuation (Sun Huan, Mechanical Principles, ch.
7; Norton, Design of Machinery, ch. 11).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.solver.driver_range import DriverRange
from graphkin.solver.external_forces import Action, load_edges
from graphkin.solver.forces import balances, forces_of
from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array
from graphkin.words import Phrase, Wording

__all__ = ["FlywheelStudy", "MomentArea", "flywheel_of", "needed_moment"]

PANEL = np.radians(10.0)
"""Between two edges of loads the moment is smooth: over so much of the driver twelve nodes give its work to the last
digits (Gauss and Legendre)."""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


@dataclass(frozen=True)
class MomentArea:
    """An area between the two moments over the driver, from one crossing to the next, offsets growing; ``work`` is that
    of the driving moment beyond the needed one (J), below zero where it is less."""

    first: float
    last: float
    work: float


@dataclass(frozen=True)
class FlywheelStudy:
    """A flywheel on a link.

    driving : constant driving moment on the driver (N m), in its sense positive
    work : of a cycle (J)
    areas : between driving and needed moment, over one cycle from the start on
    excess : the greatest difference of kinetic energy (J)
    slowest, fastest : offsets of the driver where the speed is least and greatest
    speed : mean angular velocity of the link (rad/s)
    inertia : of the flywheel (kg m2)
    """

    link: str
    delta: float
    driving: float
    work: float
    areas: tuple[MomentArea, ...]
    excess: float
    slowest: float
    fastest: float
    speed: float
    inertia: float


def needed_moment(reach: DriverRange, offset: Array) -> Array:
    """What the balance comes to as a moment on the driver, in its sense positive (N m), shape (n,)."""
    motion, moved = reach.motion(offset), reach.motion(offset, unit=True, fine=False)
    forces = forces_of(motion)
    made = np.zeros(len(motion))
    for one in balances(motion):
        value = forces.moments[one.key] if one.along is None else forces.forces[one.key]
        place = None if one.along is None else one.at
        for link, sign in ((one.second, 1.0), (one.first, -1.0)):
            made = made + Action("", link, place, sign * value).power(moved)
    return np.asarray(made)


def flywheel_of(reach: DriverRange) -> FlywheelStudy:
    """The flywheel that a scene asks for.

    Raises
    ------
    Unsolvable : the driver makes no whole turn, the link does not turn on and on, or nothing moves
    """
    if "flywheel" not in reach.kept:
        reach.kept["flywheel"] = _found(reach)
    study: FlywheelStudy = reach.kept["flywheel"]
    return study


def _found(reach: DriverRange) -> FlywheelStudy:
    wanted = reach.scene.loading.flywheel
    assert wanted is not None
    if not reach.driver.turns or not reach.full or len(reach.scene.drivers) > 1:
        raise _without(Phrase("the mechanism runs through no cycle one driver"), "leave [flywheel] out")
    speed = _mean_speed(reach, wanted.link)
    if not speed:
        rests = not reach.driver.rate
        found = Phrase("the driver rests") if rests else Phrase("link does not turn on and on", link=wanted.link)
        raise _without(found, Phrase("give it a speed") if rests else Phrase("put the flywheel on one that does"))
    edges = _panels(reach)
    work = _work(reach, edges[:-1], edges[1:])
    if not np.isfinite(work).all():
        raise _without(Phrase("the balance does no work in some position"), Phrase("balance at the driver"))
    cycle = float(edges[-1] - edges[0])
    driving = float(work.sum()) / cycle
    crossings = _crossings(reach, edges, driving)
    places = np.array(sorted({0.0, cycle, *crossings}))
    stored = np.concatenate([[0.0], np.cumsum(driving * np.diff(edges) - work)])
    energy = np.array([_stored(reach, edges, stored, driving, x) for x in places])
    areas = tuple(MomentArea(float(a), float(b), float(d)) for a, b, d in
                  zip(places[:-1], places[1:], np.diff(energy), strict=True))  # fmt: skip
    low, high = int(np.argmin(energy)), int(np.argmax(energy))
    excess = float(energy[high] - energy[low])
    inertia = excess / (wanted.delta * speed**2)
    return FlywheelStudy(
        wanted.link, wanted.delta, driving, driving * cycle, areas, excess, float(places[low]), float(places[high]),
        speed, inertia,
    )  # fmt: skip


def _without(found: Wording, wanted: Wording) -> Unsolvable:
    return Unsolvable("no flywheel", Problem("flywheel", found, wanted))


def _mean_speed(reach: DriverRange, link: str) -> float:
    """Mean angular velocity of a link over a cycle (rad/s)."""
    ends: Motion = reach.motion(np.array(reach.ends))
    turned = float(np.diff(reach.angle(ends, link))[0])
    driver = reach.driver
    return float(np.rint(turned / (2 * np.pi)) * 2 * np.pi / abs(reach.wide) * abs(driver.rate))


def _panels(reach: DriverRange) -> Array:
    """Ends of panels over one cycle, edges of loads among them."""
    low, high = reach.ends
    hard = np.unique(np.concatenate([[low, high], np.clip(load_edges(reach), low, high)]))
    parts = [np.linspace(a, b, int(np.ceil((b - a) / PANEL)) + 1)[:-1] for a, b in pairwise(hard.tolist())]
    return np.concatenate([*parts, [high]])


def _work(reach: DriverRange, first: Array, last: Array) -> Array:
    """Work that the balance does over panels (J)."""
    half = (last - first) / 2
    nodes = (first + last)[:, None] / 2 + half[:, None] * NODES
    needed = needed_moment(reach, nodes.ravel()).reshape(nodes.shape)
    return np.asarray((needed * WEIGHTS).sum(axis=1) * half)


def _crossings(reach: DriverRange, edges: Array, driving: float) -> list[float]:
    """Where the needed moment crosses the driving one; where it jumps across it, too."""
    inside = (edges[:-1, None] + np.diff(edges)[:, None] * np.linspace(1e-6, 1 - 1e-6, 24)).ravel()
    above = needed_moment(reach, inside) > driving
    found = []
    for k in np.flatnonzero(above[1:] != above[:-1]):
        a, b, after = float(inside[k]), float(inside[k + 1]), bool(above[k + 1])
        for _ in range(3):
            places = np.linspace(a, b, 65)
            same = (needed_moment(reach, places[1:-1]) > driving) == after
            first = int(np.argmax(np.append(same, True)))
            a, b = float(places[first]), float(places[first + 1])
        near = edges[np.argmin(np.abs(edges - a))]
        found.append(float(near) if a - 1e-6 < near < b + 1e-6 else (a + b) / 2)
    return found


def _stored(reach: DriverRange, edges: Array, stored: Array, driving: float, at: float) -> float:
    """Kinetic energy gained since the start (J)."""
    k = min(int(np.searchsorted(edges, at, side="right")) - 1, len(edges) - 2)
    rest = float(_work(reach, edges[k : k + 1], np.array([at]))[0])
    return float(stored[k] + driving * (at - edges[k]) - rest)
