"""Places for labels, one and many of one label; and whether labels at two are in each other's way."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, TypeVar

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Line, Segment, Text
from graphkin.drawing.place.meeting import Flags, Floats, Indices, Points
from graphkin.plane import cross

__all__ = ["LEADER_SPACE", "LOTS", "Columns", "LabelForms", "LabelPosition", "LabelPositions", "Placed", "leader_forms"]

LOTS = (0, 40, 120, 240, 720)
"""First places of the lots in which places are judged, the cheapest first."""
T = TypeVar("T", float, Floats)

LEADER_SPACE = 0.25  # mm between a leader and the box of any other label


class LabelPosition(NamedTuple):
    """A place for a label: its box (mm), what it costs in looks (mm), its leader from mark to box, and left, top, right
    and bottom of what both take."""

    left: float
    top: float
    right: float
    bottom: float
    cost: float
    leader: Segment | None
    reach: tuple[float, float, float, float]

    @property
    def box(self) -> Box:
        return Box(self.left, self.top, self.right, self.bottom)

    def meets(self, other: LabelPosition, space: complex) -> bool:
        """Whether two labels come nearer than a space (mm, across and down), or one's leader crosses the other or its
        leader."""
        left, top, right, bottom, _, leader, reach = self
        its_left, its_top, its_right, its_bottom, _, its_leader, its_reach = other
        if (
            left - space.real < its_right and its_left < right + space.real and top - space.imag < its_bottom
            and its_top < bottom + space.imag
        ):  # fmt: skip
            return True
        if leader is None and its_leader is None:
            return False
        left, top, right, bottom = reach
        its_left, its_top, its_right, its_bottom = its_reach
        if (
            left > its_right + LEADER_SPACE or its_left > right + LEADER_SPACE or top > its_bottom + LEADER_SPACE
            or its_top > bottom + LEADER_SPACE
        ):  # fmt: skip
            return False
        if leader is not None and other.lies_under(leader):
            return True
        if its_leader is None:
            return False
        return self.lies_under(its_leader) or (leader is not None and _crosses(leader, its_leader))

    def lies_under(self, leader: Segment) -> bool:
        """Whether a leader runs over the box, or nearly."""
        a, b = leader
        x1, x2, left, right = a.real, b.real, self.left - LEADER_SPACE, self.right + LEADER_SPACE
        if (x1 < left and x2 < left) or (x1 > right and x2 > right):
            return False
        y1, y2, top, bottom = a.imag, b.imag, self.top - LEADER_SPACE, self.bottom + LEADER_SPACE
        if (y1 < top and y2 < top) or (y1 > bottom and y2 > bottom):
            return False
        dx, dy = x2 - x1, y2 - y1
        off = abs(dx * ((top + bottom) / 2 - y1) - dy * ((left + right) / 2 - x1))
        return off <= (right - left) / 2 * abs(dy) + (bottom - top) / 2 * abs(dx)


@dataclass(frozen=True)
class Placed:
    """A label at its place: the text, its box, and the leader that ties it to its mark where it needs one.

    ``clear`` is False where no place without a fault was found; ``keyed`` says that its key stands for it.
    """

    text: Text
    box: Box
    leader: Line | None = None
    clear: bool = True
    keyed: bool = False


class Columns(NamedTuple):
    """Places, of one label or of several, as arrays: centres, costs, feet and tips of leaders, whether there is one."""

    centres: Points
    costs: Floats
    feet: Points
    tips: Points
    led: Flags

    def at(self, some: Flags | Indices | slice) -> Columns:
        """Some of the places."""
        return Columns(self.centres[some], self.costs[some], self.feet[some], self.tips[some], self.led[some])


class LabelForms:
    """Linear forms of places, of one label or of several: in columns 1 and the middles of boxes, feet and tips of
    leaders; and of each leader, by factor, form and place, what `leader_forms` says."""

    def __init__(self, columns: Columns) -> None:
        self.columns = columns

    @cached_property
    def middles(self) -> Floats:
        return _points(self.columns.centres)

    @cached_property
    def feet(self) -> Floats:
        return _points(self.columns.feet)

    @cached_property
    def tips(self) -> Floats:
        return _points(self.columns.tips)

    @cached_property
    def leaders(self) -> tuple[Floats, Floats]:
        _, x, y = self.feet
        _, tip_x, tip_y = self.tips
        distances, reaches = np.empty((2, 3, 3, len(x)))
        for forms, found in zip((distances, reaches), leader_forms(x, y, tip_x - x, tip_y - y), strict=True):
            for k, factor in enumerate(found):
                forms[k % 3, k // 3] = factor
        return distances, reaches


def leader_forms(x: T, y: T, along_x: T, along_y: T) -> tuple[tuple[T | float, ...], tuple[T | float, ...]]:
    """For a leader from a foot along a way: the distances of a point from its middle, across and down, and from its
    line, each as factors of 1 and the point, the last times its length; and below what distances it meets a box there,
    as factors of 1, half width and half height.  No way meets none."""
    wide, high, one, none = abs(along_x), abs(along_y), 1.0, 0.0
    distances = (
        -x - along_x / 2, one, none, -y - along_y / 2, none, one, along_y * x - along_x * y, -along_y, along_x
    )  # fmt: skip
    reaches = (
        wide / 2 + LEADER_SPACE, one, none, high / 2 + LEADER_SPACE, none, one, (wide + high) * LEADER_SPACE, high, wide
    )  # fmt: skip
    return distances, reaches


class LabelPositions:
    """Places of one label, whose box has a half size, cheapest first: a part of many places, of which the forms are
    known."""

    def __init__(self, half: complex, columns: Columns, forms: LabelForms | None = None, first: int = 0) -> None:
        self.half, self.columns, self.costs = half, columns, columns.costs
        self.forms, self.first = forms or LabelForms(columns), first
        self._made: dict[int, LabelPosition] = {}

    def __len__(self) -> int:
        return len(self.costs)

    @cached_property
    def _listed(self) -> tuple[list[complex], list[float], list[complex], list[complex], list[bool]]:
        centres, costs, feet, tips, led = self.columns
        return centres.tolist(), costs.tolist(), feet.tolist(), tips.tolist(), led.tolist()

    @cached_property
    def first_led(self) -> int:
        """The index of the first place that has a leader."""
        return int(self.columns.led.argmax()) if self.columns.led.any() else len(self)

    def middles(self, first: int, last: int) -> Floats:
        """1 and the middles of the boxes from ``first`` to ``last``, in columns."""
        return self.forms.middles[:, self.first + first : self.first + last]

    def position(self, index: int) -> LabelPosition:
        """The place of an index."""
        made = self._made.get(index)
        if made is None:
            centres, costs, feet, tips, led = self._listed
            centre, half, leader = centres[index], self.half, None
            left, top, right, bottom = reach = (
                centre.real - half.real, centre.imag - half.imag, centre.real + half.real, centre.imag + half.imag
            )  # fmt: skip
            if led[index]:
                leader = foot, _ = feet[index], tips[index]
                x, y = foot.real, foot.imag
                reach = min(left, x), min(top, y), max(right, x), max(bottom, y)
            made = LabelPosition(left, top, right, bottom, costs[index], leader, reach)
            self._made[index] = made
        return made

    def cheaper(self, cost: float) -> int:
        """How many cost less."""
        return int(np.searchsorted(self.costs, cost))

    def lots(self, count: int) -> Iterator[tuple[int, int]]:
        """First and end of the lots that hold the first ``count``."""
        for first, last in zip(LOTS, (*LOTS[1:], len(self)), strict=True):
            if first < count:
                yield first, min(last, len(self))


def _crosses(one: Segment, other: Segment) -> bool:
    """As `crosses`, for two lines."""
    (a, b), (c, d) = one, other
    apart = cross(b - a, c - a) * cross(b - a, d - a)
    return apart < 0 and cross(d - c, a - c) * cross(d - c, b - c) < 0


def _points(points: Points) -> Floats:
    """1 and the points, across and down, in columns."""
    return np.array((np.ones(len(points)), points.real, points.imag))
