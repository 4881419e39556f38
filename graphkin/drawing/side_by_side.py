"""Vectors of one line that would cover each other, side by side: how far each is shifted off its true place."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from graphkin.construction.strokes import Vector
from graphkin.plane import cross, dot
from graphkin.scene.symbol import Symbol

__all__ = ["side_by_side"]

APART = 1.0  # mm between two of them
ON_ONE_LINE = 0.3  # mm: nearer to a line than this, an arrow covers what lies there
OVERLAP = 1.0  # mm that two must have in common
LEAST = 2.0  # mm: a shorter vector is drawn again larger


def side_by_side(vectors: Iterable[Vector]) -> Mapping[Symbol, complex]:
    """For each vector that would cover another, or lie under it, its shift square to itself (mm, y up).

    Of those on one line the longest resultant stays; what is equal or opposite lies beside it.
    """
    shown = [v for v in vectors if abs(v.span) >= LEAST]
    shown.sort(key=lambda v: (v.role != "resultant", -round(abs(v.span), 6)))
    lanes: list[tuple[Vector, int]] = []
    shifts: dict[Symbol, complex] = {}
    for vector in shown:
        taken = {lane for other, lane in lanes if _cover(vector, other)}
        lane = next(n for k in range(len(lanes) + 1) for n in ((k, -k) if k else (0,)) if n not in taken)
        lanes.append((vector, lane))
        if lane:
            shifts[vector.symbol] = lane * APART * 1j * _way(vector)
    return shifts


def _way(vector: Vector) -> complex:
    """The direction of the line of a vector, the same for one and its opposite."""
    way = vector.span / abs(vector.span)
    return -way if (round(way.real, 6), round(way.imag, 6)) < (0.0, 0.0) else way


def _cover(one: Vector, two: Vector) -> bool:
    longer, shorter = (one, two) if abs(one.span) >= abs(two.span) else (two, one)
    way = longer.span / abs(longer.span)
    ends = [z - longer.tail for z in (shorter.tail, shorter.tip)]
    if any(abs(cross(way, z)) > ON_ONE_LINE for z in ends):
        return False
    low, high = sorted(dot(way, z) for z in ends)
    return min(high, abs(longer.span)) - max(low, 0.0) > OVERLAP
