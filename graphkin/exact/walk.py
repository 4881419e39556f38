"""A larger group along a path: from position to position, through change points, to the end of its motion."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from graphkin.exact.cluster import ClusterSolved
from graphkin.exact.pose import Array

__all__ = ["Walk", "walk_cluster"]

CLOSE = 2e-13
"""A position is found where no constraint is open by more, with lengths in the size."""
LEAST = 1e-13
BEND = 0.2
AT_END = 1e-9
NARROW = 1e-6
"""A gap in the motion that is narrower than this (of the path) is a change point, as for groups of two links."""

At = Callable[[float, Array], tuple[ClusterSolved, Array]]


@dataclass(frozen=True)
class Walk:
    """Where a group was found along the path parameter.

    nodes, places : parameters, shape (n,), and places there, shape (n, members, 3)
    end : where its motion ends, None if it does not
    flips : change points that it passed
    """

    nodes: Array
    places: Array
    end: float | None
    flips: tuple[float, ...]

    def start(self, t: Array) -> Array:
        """Places from which Newton's method starts, shape (n, members, 3)."""
        flat = self.places.reshape(len(self.nodes), -1)
        columns = [np.interp(t, self.nodes, flat[:, k]) for k in range(flat.shape[1])]
        return np.stack(columns, axis=1).reshape(len(t), -1, 3)


def walk_cluster(at: At, place: Array, size: float, end: float, most: float) -> Walk:
    """Walk with a tangent predictor; a step is taken only if Newton's method confirms what was predicted.

    The sign of the determinant tells the assembly.  Where it changes and the motion goes on in the same direction the
    group has passed a change point; where nothing is found any more the motion ends.

    Parameters
    ----------
    at : function of a parameter and a starting place to what is found there and its rate by the parameter
    most : largest step
    """
    weight = np.array([size, size, 1.0])
    here, slope = at(0.0, place)
    sense = np.sign(here.determinant[0])
    t, step = 0.0, most / 2
    nodes, places, flips = [0.0], [here.place[0]], []
    while t < end:
        step = min(step, end - t)
        guess = places[-1] + step * slope
        there, new_slope = at(t + step, guess)
        off = float(np.max(np.abs((there.place[0] - guess) / weight)))
        moved = float(np.max(np.abs((there.place[0] - places[-1]) / weight)))
        found = there.missed[0] < CLOSE and bool(np.all(np.isfinite(new_slope)))
        good = found and off < min(0.03, 0.003 + 0.3 * moved) and _bend(slope, new_slope, weight) < BEND
        if good and np.sign(there.determinant[0]) != sense:
            passed = _passed(at, t, places[-1], slope, step, there, new_slope, weight)
            if passed is not None:
                flips.append(passed[0])
                nodes += [x for x, _ in passed[1]]
                places += [p for _, p in passed[1]]
                sense = -sense
            good = passed is not None
        if good:
            t, slope = t + step, new_slope
            nodes.append(t)
            places.append(there.place[0])
            step = min(most, step * (2.0 if off < 0.005 else 1.2))
            continue
        step /= 2
        if step < LEAST:
            break
    if t < end and end - t < AT_END:
        # the end of the path is itself singular: what stands there says so
        t = end
    return Walk(np.array(nodes), np.array(places), None if t >= end else t, tuple(flips))


def _bend(slope: Array, new_slope: Array, weight: Array) -> float:
    """How much the direction of the motion changes over a step, relatively.

    At a change point the other branch leaves in another direction, however small the step.
    """
    most = max(float(np.max(np.abs(slope / weight))), float(np.max(np.abs(new_slope / weight))))
    return float(np.max(np.abs((new_slope - slope) / weight))) / (most or 1.0)


def _passed(
    at: At, t: float, place: Array, slope: Array, step: float, there: ClusterSolved, new_slope: Array, weight: Array
) -> tuple[float, list[tuple[float, Array]]] | None:
    """The change point inside a step, and places close to it on both sides; None if the step is not one smooth motion.

    On the smooth motion the place is a cubic in the parameter by both ends and both rates, and the determinant goes
    through zero once.  The other branch at a change point leaves it in another direction.
    """
    last = there.place[0]

    def between(s: float) -> Array:
        return np.asarray(
            (1 + 2 * s) * (1 - s) ** 2 * place
            + s * (1 - s) ** 2 * step * slope
            + s * s * (3 - 2 * s) * last
            + s * s * (s - 1) * step * new_slope
        )

    low, high = 0.0, 1.0
    sign = -np.sign(there.determinant[0])
    for _ in range(60):
        middle = (low + high) / 2
        if (high - low) * step < NARROW / 8:
            break
        found, _ = at(t + middle * step, between(middle))
        if not found.missed[0] < CLOSE:
            # so close to the point, or in a gap: the sides decide
            break
        low, high = (middle, high) if np.sign(found.determinant[0]) == sign else (low, middle)
    flip = (low + high) / 2
    sides: list[tuple[float, Array]] = []
    far = max(high - low, NARROW / step)
    for s in (flip - 30 * far, flip - far, flip + far, flip + 30 * far):
        if not 0 < s < 1:
            continue
        found, _ = at(t + s * step, between(s))
        off = np.max(np.abs((found.place[0] - between(s)) / weight))
        expected = sign if s < flip else -sign
        if not found.missed[0] < CLOSE or off > 1e-3 * abs(s - flip) * step + 1e-7 or (
            np.sign(found.determinant[0]) != expected
        ):
            return None
        sides.append((t + s * step, found.place[0]))
    if (high - low) * step > NARROW or len(sides) < 2:
        return None
    return t + flip * step, sides
