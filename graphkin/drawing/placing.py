"""Where labels stand: clear of each other and of the drawing, inside their panel, nearer to their own mark than to any
other of its kind, or tied to it by a leader.

Each label has candidate places in rings of growing distance around its mark.  Those that the drawing forbids are sorted
out for all labels at once; then labels take places, the most constrained first, and labels left without one drive out
others (greedy point labelling with repair, after Christensen, Marks and Shieber, An empirical study of algorithms for
point-feature label placement, ACM Trans. Graphics 14, 1995).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.free_room import Field, least_cost
from graphkin.drawing.label_positions import RINGS, Asker, Mark, Seat, Seats, ends
from graphkin.drawing.obstacles import Obstacles
from graphkin.drawing.primitives import Line, Text
from graphkin.drawing.text import text_box

__all__ = ["Label", "Mark", "Placed", "place", "place_those_that_fit"]

# Rings looked at, one stage after the other, for the labels that have no place yet.
_STAGES = (0, 2, 5, len(RINGS))
# What a label is worth by its rank: so much more must others be worth together before it gives way to them.
_WORTH = (12, 5, 4, 3, 2, 1)
_DRIVES = 4  # how often labels may drive out others, for each label
_SPACE = 0.5  # between two labels, mm
_NOTHING = Obstacles()


@dataclass(frozen=True)
class Label:
    """A text that wants a place.

    Parameters
    ----------
    text : what to write; its ``at`` is not used
    mark : a point, or the two ends of a segment, that it names
    toward : directions (rad, counter-clockwise) from a point in the order of liking; for a segment the side whose
        normal is nearest to the first of them is liked
    """

    text: Text
    mark: Mark
    toward: tuple[float, ...] = ()


@dataclass(frozen=True)
class Placed:
    """A label at its place: the text, its box, and the leader that ties it to its mark where it needs one.

    ``clear`` is False where no place without a fault was found.
    """

    text: Text
    box: Box
    leader: Line | None = None
    clear: bool = True


def place(
    labels: Sequence[Label], panel: Box, obstacles: Obstacles = _NOTHING, marks: Sequence[Mark] = ()
) -> tuple[Placed, ...]:
    """Give each label a place; the same input gives the same places.

    Parameters
    ----------
    labels : in the order of importance among equals
    panel : no label leaves it
    obstacles : what is drawn already
    marks : further points and segments that a reader could take a label for, besides those of the labels
    """
    placed = place_those_that_fit(labels, (0,) * len(labels), panel, obstacles, marks)
    return tuple(one for one in placed if one is not None)


def place_those_that_fit(
    labels: Sequence[Label], ranks: Sequence[int], panel: Box, obstacles: Obstacles = _NOTHING,
    marks: Sequence[Mark] = (),
) -> tuple[Placed | None, ...]:  # fmt: skip
    """As `place`, with None for labels given up; one of rank 0 stands in any case, the others give way to what is
    worth more, the highest rank first."""
    if not labels:
        return ()
    texts = [replace(label.text, at=0j, anchor="start") for label in labels]
    boxes = [text_box(text) for text in texts]
    field = Field(panel, obstacles, (*(label.mark for label in labels), *marks))
    askers = [
        Asker(*ends(label.mark), complex(box.width, box.height) / 2, label.toward)
        for label, box in zip(labels, boxes, strict=True)
    ]
    board = _Board(askers, ranks, field)
    board.settle()
    return tuple(
        _placed(text, box, board.standing[i], board.clear[i]) if i in board.standing else None
        for i, (text, box) in enumerate(zip(texts, boxes, strict=True))
    )


def _placed(text: Text, box: Box, seat: Seat, clear: bool) -> Placed:
    leader = None if seat.leader is None else Line(*seat.leader, strokes.LEADER)
    at = complex(seat.left - box.left, seat.top - box.top)
    return Placed(replace(text, at=at), seat.box, leader, clear)


class _Board:
    """Who stands where."""

    def __init__(self, askers: Sequence[Asker], ranks: Sequence[int], field: Field) -> None:
        self.askers, self.ranks, self.field = askers, ranks, field
        self.found: dict[int, Seats] = {}
        self.seen = [0] * len(askers)  # rings looked at
        self.standing: dict[int, Seat] = {}
        self.clear = [True] * len(askers)

    def settle(self) -> None:
        """Give every label a place, or give it up."""
        left = list(range(len(self.askers)))
        for last in _STAGES[1:]:
            self._look(left, last)
            left.sort(key=lambda i: (self.ranks[i] > 3, len(self.found[i]), i))
            left = [i for i in left if not self._stand(i)]
            if not left:
                break
        left = self._drive_out(sorted(left))
        self._ease()
        for i in left:
            if self.ranks[i] == 0:
                self._insist(i)

    def _look(self, who: Sequence[int], last: int) -> None:
        """Look for places in the rings up to ``last`` that some labels have not yet seen."""
        for first in sorted({self.seen[i] for i in who if self.seen[i] < last}):
            some = [i for i in who if self.seen[i] == first]
            for i, seats in zip(some, self.field.free([self.askers[i] for i in some], first, last), strict=True):
                self.found[i] = self.found[i].joined(seats) if first else seats
                self.seen[i] = last

    def _stand(self, i: int) -> bool:
        """Take the cheapest place that no other label holds."""
        seats, others = self.found[i], tuple(self.standing.values())
        for seat in seats.first:
            if not any(seat.meets(other, _SPACE) for other in others):
                self.standing[i] = seat
                return True
        if len(seats) <= len(seats.first):
            return False
        free = np.flatnonzero(~seats.met(others, _SPACE).any(axis=1))
        if free.size:
            self.standing[i] = seats.seat(int(free[0]))
        return bool(free.size)

    def _drive_out(self, left: list[int]) -> list[int]:
        """Seat labels in a crowd by driving out whoever is in the way, who then seats itself the same way; each time
        that a label is driven out it grows harder to drive out.  Returns those that stand nowhere in the end."""
        worth = [_WORTH[min(rank, len(_WORTH) - 1)] for rank in self.ranks]
        weight = [*worth]
        queue, hopeless = list(left), []
        best, state = sum(worth[i] for i in left), (list(left), dict(self.standing))
        for _ in range(_DRIVES * len(self.askers)):
            if not queue:
                break
            i = queue.pop(0)
            self._look([i], len(RINGS))
            seats, standing = self.found[i], list(self.standing)
            met = seats.met([self.standing[j] for j in standing], _SPACE)
            lost = met @ np.array([weight[j] for j in standing], dtype=float)
            if not len(seats) or (self.ranks[i] and lost.min() > weight[i]):
                hopeless.append(i)
                continue
            chosen = int(np.lexsort((seats.costs, lost))[0])
            for j in (standing[k] for k in np.flatnonzero(met[chosen])):
                del self.standing[j]
                weight[j] += worth[j]
                queue.append(j)
            self.standing[i] = seats.seat(chosen)
            missing = sum(worth[j] for j in (*queue, *hopeless))
            if missing < best:
                best, state = missing, (sorted(queue + hopeless), dict(self.standing))
        lacking, self.standing = state
        return lacking

    def _ease(self) -> None:
        """Move labels to better places: such as have come free, and such as are further off but cost less."""
        uneasy = [i for i, seat in self.standing.items() if seat.cost > least_cost(_STAGES[-2])]
        self._look(sorted(uneasy), _STAGES[-1])
        for i in sorted(self.standing):
            seat = self.standing[i]
            if seat.cost > self.found[i].costs[0]:
                del self.standing[i]
                self._stand(i)

    def _insist(self, i: int) -> None:
        """Put a label where it does least harm, and give up those in its way that may be given up."""
        seats, standing = self.field.everywhere(self.askers[i]), list(self.standing)
        met = seats.met([self.standing[j] for j in standing], 0.0)
        important = np.array([self.ranks[j] == 0 for j in standing], dtype=bool)
        faults = seats.faults + met[:, important].sum(axis=1)
        chosen = int(np.lexsort((seats.costs, met.sum(axis=1), faults))[0])
        for k in np.flatnonzero(met[chosen] & ~important):
            del self.standing[standing[k]]
        self.clear[i] = bool(faults[chosen] == 0)
        self.standing[i] = seats.seat(chosen)
