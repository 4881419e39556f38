"""Where labels stand: clear of each other and of the drawing, inside their panel, nearer to their own mark than to any
other of its kind, or tied to it by a leader.

Each label has candidate places in rings of growing distance around its mark.  Those that the drawing forbids are sorted
out for all labels at once; then labels take places, the most constrained first, and labels left without one push a
neighbour to another of its own places (greedy point labelling with repair, after Christensen, Marks and Shieber, An
empirical study of algorithms for point-feature label placement, ACM Trans. Graphics 14, 1995).
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice, pairwise

from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.candidates import RINGS, Asker, Candidate, Field, Mark, Places, least_cost
from graphkin.drawing.metrics import text_box
from graphkin.drawing.obstacles import Obstacles
from graphkin.drawing.primitives import Line, Text

__all__ = ["Label", "Mark", "Placed", "place"]

# Rings looked at, one stage after the other, for the labels that have no place yet.
_STAGES = (0, 2, 4, 7, len(RINGS))
# How often labels may drive out others, and that each considers only one in so many of its places, near ones and far.
_DRIVES, _STRIDE = 120, 3
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
    if not labels:
        return ()
    texts = [replace(label.text, at=0j, anchor="start") for label in labels]
    boxes = [text_box(text) for text in texts]
    field = Field(panel, obstacles, (*(label.mark for label in labels), *marks))
    askers = [
        Asker(label.mark, complex(box.width, box.height) / 2, label.toward)
        for label, box in zip(labels, boxes, strict=True)
    ]
    board = _Board(askers, field)
    board.settle()
    placed = []
    for text, box, candidate, clear in zip(texts, boxes, board.taken, board.clear, strict=True):
        leader = None if candidate.leader is None else Line(*candidate.leader, strokes.LEADER)
        at = complex(candidate.box.left - box.left, candidate.box.top - box.top)
        placed.append(Placed(replace(text, at=at), candidate.box, leader, clear))
    return tuple(placed)


class _Board:
    """Who stands where."""

    def __init__(self, askers: Sequence[Asker], field: Field) -> None:
        self.askers, self.field = askers, field
        self.found: list[list[Places]] = [[] for _ in askers]
        self.seen = [0] * len(askers)  # rings looked at
        self.standing: dict[int, Candidate] = {}
        self.clear = [True] * len(askers)

    @property
    def taken(self) -> list[Candidate]:
        return [self.standing[i] for i in range(len(self.askers))]

    def settle(self) -> None:
        """Give every label a place."""
        left = list(range(len(self.askers)))
        for first, last in pairwise(_STAGES):
            self._look(left, first, last)
            order = sorted(left, key=lambda i: (sum(map(len, self.found[i])), i))
            left = sorted(i for i in order if not self._stand(i))
            left = [i for i in left if not self._push(i)]
            if not left:
                break
        left = self._drive_out(left)
        self._ease()
        for i in left:
            self.clear[i] = False
            self.standing[i] = self._least_bad(i)

    def _drive_out(self, left: list[int]) -> list[int]:
        """Seat labels in a crowd by driving out whoever is in the way, who then seats itself the same way; each time
        that a label is driven out it grows harder to drive out.  Returns those that stand nowhere in the end."""
        weight = [1] * len(self.askers)
        queue, hopeless = list(left), []
        best, state = list(left), dict(self.standing)
        for _ in range(_DRIVES):
            if not queue:
                break
            i = queue.pop(0)
            self._look([i], self.seen[i], len(RINGS))
            choices = [
                (sum(weight[j] for j in rivals), at.cost, n, at, rivals)
                for n, at in enumerate(islice(self._places(i), 0, None, _STRIDE))
                for rivals in (self._rivals(at, len(self.askers)),)
            ]
            if not choices:
                hopeless.append(i)
                continue
            _, _, _, at, rivals = min(choices)
            for j in rivals:
                del self.standing[j]
                weight[j] += 1
                queue.append(j)
            self.standing[i] = at
            if len(queue) + len(hopeless) < len(best):
                best, state = sorted(queue + hopeless), dict(self.standing)
        self.standing = state
        return best

    def _ease(self) -> None:
        """Move labels to better places: such as have come free, and such as are further off but cost less."""
        for first, last in pairwise(_STAGES[1:]):
            uneasy = [i for i in sorted(self.standing) if self.standing[i].cost > least_cost(first)]
            self._look([i for i in uneasy if self.seen[i] == first], first, last)
        for i in sorted(self.standing):
            del self.standing[i]
            self._stand(i)

    def _look(self, who: list[int], first: int, last: int) -> None:
        if first == last or not who:
            return
        for i, places in zip(who, self.field.free([self.askers[i] for i in who], first, last), strict=True):
            self.found[i].append(places)
            self.seen[i] = last

    def _places(self, i: int) -> Iterator[Candidate]:
        """Places found so far, cheapest first."""
        return heapq.merge(*self.found[i], key=lambda candidate: candidate.cost)

    def _stand(self, i: int) -> bool:
        for candidate in self._places(i):
            if not self._rivals(candidate, 1):
                self.standing[i] = candidate
                return True
        return False

    def _push(self, i: int) -> bool:
        """Take a place that one other label holds, where that one finds another."""
        for candidate in self._places(i):
            rivals = self._rivals(candidate, 2)
            if len(rivals) != 1:
                continue
            rival = rivals[0]
            was = self.standing.pop(rival)
            self.standing[i] = candidate
            if self._stand(rival):
                return True
            self.standing[rival] = was
            del self.standing[i]
        return False

    def _rivals(self, candidate: Candidate, enough: int) -> list[int]:
        """Labels that stand in the way, as many as are enough to know."""
        rivals = []
        for j, other in self.standing.items():
            if candidate.meets(other, _SPACE):
                rivals.append(j)
                if len(rivals) == enough:
                    break
        return rivals

    def _least_bad(self, i: int) -> Candidate:
        places = self.field.everywhere(self.askers[i])
        return min(
            places,
            key=lambda place: (
                place.faults + sum(place.meets(other, 0.0) for other in self.standing.values()),
                place.cost,
            ),
        )
