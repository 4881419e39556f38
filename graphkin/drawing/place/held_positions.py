"""The positions that labels hold, and which places lie free between them.

Whether boxes and leaders meet is asked of many at once as linear forms of the page: how far a point lies from a middle,
across and down, or from the line of a leader, against what both take there (separating axes).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from graphkin.drawing.place.label_positions import LOTS, LabelForms, LabelPosition, LabelPositions, leader_forms
from graphkin.drawing.place.meeting import ON_LINE, Flags, Floats, Indices

__all__ = ["HeldPositions"]

# Where it stands in the forms of a held position: as factors of 1, x, y the distances of a point from the middle of its
# box, from the middle of its leader and from the line of that; as factors of 1, half width, half height of a box there
# how near it must be to meet; 1 with middle, half size, foot and tip.
_DISTANCES, _REACHES, _MIDDLE, _HALF = slice(15), slice(15, 30), slice(30, 33), slice(33, 36)
_FOOT, _TIP, _NUMBERS = slice(36, 39), slice(39, 42), 42
_BOX_DISTANCES, _NORMAL, _BOX_REACHES = slice(6), slice(12, 15), slice(15, 21)
_NO_LEADER: tuple[float, ...] = (1.0, 0.0, 0.0) * 3
_NOWHERE: tuple[float, ...] = (0.0, 0.0, 0.0) * 3


@dataclass
class _Known:
    """Which labels, at positions of these numbers (-1: not known), are met by which of the first places of a label."""

    over: Flags
    places: int
    numbers: Indices


class HeldPositions:
    """The positions that labels hold with a space (mm, across and down) between them, and which places meet them."""

    def __init__(self, count: int, space: complex) -> None:
        self.space = space
        self.stands = np.zeros(count, dtype=bool)
        self.standing: dict[int, LabelPosition] = {}
        self.leaders: dict[int, LabelPosition] = {}  # those of them that have one
        self.last: dict[int, LabelPosition] = {}  # those that labels hold or have held
        self.numbers = np.full(count, -1, dtype=np.intp)  # and their numbers
        self.number: dict[LabelPosition, int] = {}
        self.forms = np.empty((2 * count, _NUMBERS))
        self.known: dict[LabelPositions, _Known] = {}

    def take(self, label: int, position: LabelPosition) -> None:
        self.standing[label] = position
        self.stands[label] = True
        if position.leader is not None:
            self.leaders[label] = position
        if self.last.get(label) is position:
            return
        self.last[label] = position
        number = self.numbers[label] = self.number.setdefault(position, len(self.number))
        if number == len(self.forms):
            self.forms = np.concatenate((self.forms, np.empty_like(self.forms)))
        if number == len(self.number) - 1:
            self.forms[number] = _forms(position, self.space)

    def leave(self, label: int) -> None:
        del self.standing[label]
        self.stands[label] = False
        self.leaders.pop(label, None)

    def put_back(self, standing: Mapping[int, LabelPosition]) -> None:
        """Let the labels hold positions that they have held at a time."""
        for label in tuple(self.standing):
            self.leave(label)
        for label, position in standing.items():
            self.take(label, position)

    def met(self, places: LabelPositions, count: int) -> Flags:
        """Which labels stand where they are met by which of the first places, as `LabelPosition.meets` says: labels in
        rows, places in columns."""
        known = self.known.get(places)
        if known is None:
            none = np.full(len(self.stands), -1, dtype=np.intp)
            known = self.known[places] = _Known(np.zeros((len(self.stands), len(places)), dtype=bool), 0, none)
        if known.places:
            some = (self.stands & (known.numbers != self.numbers)).nonzero()[0]
            if some.size:
                known.over[some, : known.places] = self._met(places, 0, known.places, some)
                known.numbers[some] = self.numbers[some]
        if known.places < count:
            first, last = known.places, min(last for last in (*LOTS, len(places)) if last >= count)
            some = self.stands.nonzero()[0]
            if some.size:
                known.over[some, first:last] = self._met(places, first, last, some)
            known.numbers, known.places = np.where(self.stands, self.numbers, -1), last
        return known.over[:, :count] & self.stands[:, None]

    def covered(self, places: LabelPositions) -> Flags:
        """As `met` of all places, but that labels may stand as near to each other as they like."""
        near = HeldPositions(len(self.stands), 0j)
        near.put_back(self.standing)
        return near.met(places, len(places))

    def _met(self, places: LabelPositions, first: int, last: int, labels: Indices) -> Flags:
        """Which labels stand where they are met by which of the places from ``first`` to ``last``."""
        held, half = self.forms[self.numbers[labels]], (1.0, places.half.real, places.half.imag)
        forms, start = places.forms, places.first
        distances = held[:, _DISTANCES].reshape(-1, 3) @ places.middles(first, last)
        near = np.abs(distances, out=distances) < (held[:, _REACHES].reshape(-1, 3) @ half)[:, None]
        box_x, box_y, leader_x, leader_y, line = near.reshape(len(labels), 5, -1).transpose(1, 0, 2)
        over: Flags = box_x & box_y
        over |= leader_x & leader_y & line
        led = max(places.first_led, first)
        if led < last:
            over[:, led - first :] |= _met_by_leaders(held, forms, slice(start + led, start + last))
        return over

    def first_free(self, places: LabelPositions, count: int) -> int | None:
        """The index of the cheapest of the first ``count`` places that meets no label; None where all do."""
        for k in self._promising(places, count):
            position = places.position(k)
            for other in (self.standing if k == 0 or position.leader is not None else self.leaders).values():
                if position.meets(other, self.space):
                    break
            else:
                return k
        return None

    def _promising(self, places: LabelPositions, count: int) -> Iterator[int]:
        """The cheapest of some places, which is mostly free, and those of them whose boxes overlap none."""
        if count:
            yield 0
        held, half = self.forms[self.numbers[self.stands]], (1.0, places.half.real, places.half.imag)
        for first, last in places.lots(count):
            distances = held[:, _BOX_DISTANCES].reshape(-1, 3) @ places.middles(first, last)
            near = np.abs(distances, out=distances) < (held[:, _BOX_REACHES].reshape(-1, 3) @ half)[:, None]
            free = np.flatnonzero(~(near[::2] & near[1::2]).any(axis=0))
            yield from (k for k in (first + free).tolist() if 0 < k < count)

    def first_known_free(self, places: LabelPositions, count: int) -> int | None:
        """As `first_free`, for places of which is asked again what they meet."""
        for first, last in places.lots(count):
            free = np.flatnonzero(~self.met(places, last)[:, first:].any(axis=0))
            if free.size:
                found = first + int(free[0])
                return found if found < count else None
        return None


def _forms(position: LabelPosition, space: complex) -> tuple[float, ...]:
    """The linear forms of a held position, as above; distances from no leader are too long."""
    left, top, right, bottom = position[:4]
    x, y, half_x, half_y = (left + right) / 2, (top + bottom) / 2, (right - left) / 2, (bottom - top) / 2
    foot = tip = 0j
    distances, reaches = _NO_LEADER, _NOWHERE
    if position.leader is not None:
        foot, tip = position.leader
        distances, reaches = leader_forms(foot.real, foot.imag, tip.real - foot.real, tip.imag - foot.imag)
    return (
        -x, 1.0, 0.0, -y, 0.0, 1.0, *distances,
        half_x + space.real, 1.0, 0.0, half_y + space.imag, 0.0, 1.0, *reaches,
        1.0, x, y, 1.0, half_x, half_y, 1.0, foot.real, foot.imag, 1.0, tip.real, tip.imag,
    )  # fmt: skip


def _met_by_leaders(held: Floats, forms: LabelForms, some: slice) -> Flags:
    """Which positions are met by the leaders of some places."""
    distances, reaches = (form[..., some].reshape(3, -1) for form in forms.leaders)
    apart = held[:, _MIDDLE] @ distances
    near = np.abs(apart, out=apart) < held[:, _HALF] @ reaches
    across, down, line = near.reshape(len(held), 3, -1).transpose(1, 0, 2)
    under: Flags = across & down
    under &= line
    its_normal, own_normal = held[:, _NORMAL], forms.leaders[0][:, 2, some]
    crossed = (its_normal @ forms.feet[:, some]) * (its_normal @ forms.tips[:, some]) < -ON_LINE
    crossed &= (held[:, _FOOT] @ own_normal) * (held[:, _TIP] @ own_normal) < -ON_LINE
    under |= crossed
    return under
