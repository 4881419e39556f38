"""Where the gaps of trial drawings close: over the whole range of a trial driver, between two of its values, or
on a grid of several.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from itertools import pairwise, product

from graphkin.construction.dyads import drive, meet
from graphkin.construction.follow import fitted
from graphkin.construction.links_on_paper import PlacedLinks
from graphkin.construction.reduced_mechanism import ReducedMechanism
from graphkin.construction.sheet import Pose
from graphkin.scene.model import AngleDriver
from graphkin.structure import Driven, Dyad

__all__ = ["all_fits", "fits_between"]

GRID = 360  # trial values looked at over a turn
COARSE = 12  # values of each of several trial drivers

Branches = tuple[int, ...]  # which assembly each dyad of a reduced mechanism takes, in the order of drawing


def all_fits(reduced: ReducedMechanism, known: PlacedLinks) -> Iterator[dict[str, Pose]]:
    """Every position of the trial drivers and every assembly of the trial dyads at which what was left out fits."""
    if len(reduced.trial) == 1:
        yield from fits_between(reduced, known, *_span(reduced, 0))
    else:
        yield from _on_a_grid(reduced, known)


def _span(reduced: ReducedMechanism, i: int) -> tuple[float, float]:
    """Where a trial driver may stand: a turn, or four sizes of the mechanism."""
    return (-math.pi, math.pi) if isinstance(reduced.trial[i], AngleDriver) else (-2.0, 2.0)


def _on_a_grid(reduced: ReducedMechanism, known: PlacedLinks) -> Iterator[dict[str, Pose]]:
    """Several trial drivers: each place of a grid improved."""
    axes = []
    for i in range(len(reduced.trial)):
        start, end = _span(reduced, i)
        axes.append([start + (end - start) * (n + 0.5) / COARSE for n in range(COARSE)])
    trials = []
    for values in product(*axes):
        for branches, gaps in _gaps(reduced, known, values)[0].items():
            trials.append((max(abs(g) for g in gaps), values, branches))
    trials.sort(key=lambda one: one[0])
    for _, values, branches in trials[:200]:
        frame = _drawn(reduced, known, values, branches)
        if frame is None:
            continue
        near = fitted(reduced, known, frame.poses, values)
        if near is not None:
            yield near


def fits_between(
    reduced: ReducedMechanism, known: PlacedLinks, start: float, end: float
) -> Iterator[dict[str, Pose]]:
    low, high = _span(reduced, 0)
    parts = max(1, round(GRID * (end - start) / (high - low)))
    grid = [start + (end - start) * i / parts for i in range(parts + 1)]
    # a value is drawn once for all assemblies: where one cannot be drawn on, others often cannot either
    drawn_at = cache(lambda value: _gaps(reduced, known, (value,)))
    for branches in product((0, 1), repeat=sum(isinstance(e, Dyad) for e in reduced.elements)):

        def gap(value: float, branches: Branches = branches) -> float:
            gaps, _ = drawn_at(value)
            return gaps[branches][0] if branches in gaps else math.nan

        def rooms(value: float, branches: Branches = branches) -> list[float]:
            _, found = drawn_at(value)
            return [found[before] for k in range(len(branches)) if (before := branches[:k]) in found]

        for pair in pairwise((value, gap(value)) for value in grid):
            (a, one), (b, two) = _inside(gap, rooms, *pair)
            # nan compares false; a gap that leaps has passed half a turn, not zero
            if not one * two <= 0.0 or abs(one - two) > 1.0:
                continue
            frame = _drawn(reduced, known, (_root(gap, a, b, one, two),), branches)
            if frame is not None and abs(reduced.gaps(frame)[0]) < 1e-9:
                yield reduced.put_back(frame)


def _gaps(
    reduced: ReducedMechanism, known: PlacedLinks, values: Sequence[float]
) -> tuple[dict[Branches, list[float]], dict[Branches, float]]:
    """The gaps in every assembly of the trial dyads at some values, those that cannot be drawn left out; and how far
    the loci of each dyad reach over each other (negative: they do not meet), by the assemblies of those before it.

    A dyad is drawn once for all assemblies of those after it.
    """
    frame = reduced.opened(known, values)
    found: dict[Branches, list[float]] = {}
    rooms: dict[Branches, float] = {}

    def draw(elements: Sequence[Driven | Dyad], branches: Branches) -> None:
        if not elements:
            found[branches] = reduced.gaps(frame)
            return
        element = elements[0]
        if isinstance(element, Driven):
            frame.poses[element.link], _ = drive(frame, element)
            draw(elements[1:], branches)
            return
        meeting = meet(frame, element)
        rooms[branches] = meeting.gap
        for branch, poses in enumerate(meeting.poses):
            frame.poses.update(poses)
            draw(elements[1:], (*branches, branch))

    draw(reduced.elements, ())
    return found, rooms


def _drawn(
    reduced: ReducedMechanism, known: PlacedLinks, values: Sequence[float], branches: Branches
) -> PlacedLinks | None:
    """A trial drawing of the group; None where two loci do not meet."""
    frame = reduced.opened(known, values)
    wanted = iter(branches)
    for element in reduced.elements:
        if isinstance(element, Driven):
            frame.poses[element.link], _ = drive(frame, element)
            continue
        meeting, branch = meet(frame, element), next(wanted)
        if branch >= len(meeting.poses):
            return None
        frame.poses.update(meeting.poses[branch])
    return frame


def _inside(
    gap: Callable[[float], float],
    rooms: Callable[[float], Sequence[float]],
    one: tuple[float, float],
    two: tuple[float, float],
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Two trial values with their gaps; where only one can be drawn, the other is moved to the last that can: by
    proportional division of how far the loci of the dyad reach over each other that cannot be drawn first, halving
    where that is slow (as `_root`).

    rooms : how far those of each dyad do at a value, as far as they can be drawn
    """
    if math.isnan(one[1]) == math.isnan(two[1]):
        return one, two
    good, bad = (one, two[0]) if math.isnan(two[1]) else (two, one[0])
    last, near = good, abs(good[0] - bad) * 2.0**-45
    share, side, stopped = 1.0, 0, -1
    for count in range(180):
        if abs(last[0] - bad) <= near:
            break
        apart = rooms(bad)
        if len(apart) - 1 != stopped:
            share, side, stopped = 1.0, 0, len(apart) - 1
        room, short = rooms(last[0])[stopped], apart[stopped]
        room, short = (room * share, short) if side < 0 else (room, short * share)
        middle = (last[0] + bad) / 2
        if room >= 0.0 > short and count % 4 < 3:
            # a little off both ends, for one of them may be the last already
            part = near / 2 / abs(bad - last[0])
            middle = last[0] + (bad - last[0]) * min(max(room / (room - short), part), 1 - part)
        there = gap(middle)
        if math.isnan(there):
            share, side, bad = share / 2 if side < 0 else 1.0, -1, middle
        else:
            share, side, last = share / 2 if side > 0 else 1.0, 1, (middle, there)
    return good, last


def _root(gap: Callable[[float], float], a: float, b: float, fa: float, fb: float) -> float:
    """Where a gap closes between two trial values: proportional division, halving where that is slow (regula falsi,
    Illinois variant)."""
    side = 0
    for _ in range(100):
        c = (fa * b - fb * a) / (fa - fb) if fa != fb else (a + b) / 2
        if not min(a, b) < c < max(a, b):
            c = (a + b) / 2
        fc = gap(c)
        if fc == 0.0 or math.isnan(fc) or abs(b - a) <= 4e-16 * max(abs(a), abs(b), 1.0):
            return c
        if (fc > 0) == (fb > 0):
            b, fb = c, fc
            fa = fa / 2 if side == -1 else fa
            side = -1
        else:
            a, fa = c, fc
            fb = fb / 2 if side == 1 else fb
            side = 1
    return c
