"""Where labels stand: clear of each other and of the drawing, inside their panel, nearer to their own mark than to any
other of its kind, or tied to it by a leader.

Each label has candidate places in rings of growing distance around its mark.  Those that the drawing forbids are sorted
out for all labels at once; then labels take places, the most constrained first, and labels left without one drive out
others (greedy point labelling with repair, after Christensen, Marks and Shieber, An empirical study of algorithms for
point-feature label placement, ACM Trans. Graphics 14, 1995).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import text_box
from graphkin.drawing.label_candidates import RINGS, LabelRequest, Mark, ends
from graphkin.drawing.label_positions import (
    FEW,
    MANY,
    SOME,
    TANGLED,
    FoundPositions,
    HeldPositions,
    LabelPanel,
    LabelPosition,
    LabelPositions,
    least_cost,
)
from graphkin.drawing.obstacles import Flags, Obstacles
from graphkin.drawing.primitives import Line, Text

__all__ = ["Label", "Mark", "Placed", "place"]

# Rings looked at, one stage after the other, for the labels that have no place yet.
_STAGES = (0, 2, 5, len(RINGS))
# What a label is worth by its rank: so much more must others be worth together before it gives way to them.
_WORTH = (12, 5, 4, 3, 2, 1)
_DRIVES = 4  # how often labels may drive out others, for each label
_SPACE = 0.9  # between two labels, mm
_TRIED = 40  # places tried to get round a vector
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
    rank : one of rank 0 must stand, others are given up where there is no room, the highest rank first
    key : what may stand in its place in a crowd, the text being listed elsewhere
    """

    text: Text
    mark: Mark
    toward: tuple[float, ...] = ()
    rank: int = 0
    key: Text | None = None


@dataclass(frozen=True)
class Placed:
    """A label at its place: the text, its box, and the leader that ties it to its mark where it needs one.

    ``clear`` is False where no place without a fault was found, ``tangled`` says that the leader crosses a vector, a
    link, a joint or an arrowhead.
    """

    text: Text
    box: Box
    leader: Line | None = None
    clear: bool = True
    tangled: bool = False


def place(
    labels: Sequence[Label], panel: Box, obstacles: Obstacles = _NOTHING, marks: Sequence[Mark] = (),
    found: FoundPositions | None = None,
) -> tuple[Placed, ...]:  # fmt: skip
    """Give labels their places, in their order, those left out that are given up; the same input gives the same places.

    Parameters
    ----------
    labels : in the order of importance among equals
    panel : no label leaves it
    obstacles : what is drawn already
    marks : further points and segments that a reader could take a label for, besides those of the labels
    found : what calls for the same panel, obstacles and marks, those of the labels too, share of their search
    """
    if not labels:
        return ()
    texts = [_moved(label.text, 0j) for label in labels]
    boxes = [text_box(text) for text in texts]
    requests = [
        LabelRequest(*ends(label.mark), complex(box.width, box.height) / 2, label.toward)
        for label, box in zip(labels, boxes, strict=True)
    ]
    asked = LabelPanel(panel, obstacles, marks, requests, {} if found is None else found)
    placement = _Placement([label.rank for label in labels], asked)
    placement.settle()
    return tuple(
        _placed(text, box, placement.standing[i], placement.clear[i], placement.tangled(i))
        for i, (text, box) in enumerate(zip(texts, boxes, strict=True))
        if i in placement.standing
    )


def _placed(text: Text, box: Box, position: LabelPosition, clear: bool, tangled: bool) -> Placed:
    leader = None if position.leader is None else Line(*position.leader, strokes.LEADER)
    at = complex(position.left - box.left, position.top - box.top)
    return Placed(_moved(text, at), position.box, leader, clear, tangled)


def _moved(text: Text, at: complex) -> Text:
    return Text(at, text.runs, "start", text.colour, text.id, text.classes, text.step)


class _Placement:
    """Who stands where."""

    def __init__(self, ranks: Sequence[int], panel: LabelPanel) -> None:
        self.ranks, self.panel = ranks, panel
        self.found: dict[int, LabelPositions] = {}
        self.seen = [0] * len(ranks)  # rings looked at
        self.standing: dict[int, LabelPosition] = {}
        self.held = HeldPositions(len(ranks))  # the same as arrays
        self.clear = [True] * len(ranks)

    def _take(self, i: int, position: LabelPosition) -> None:
        self.standing[i] = position
        self.held.take(i, position)

    def _leave(self, i: int) -> None:
        del self.standing[i]
        self.held.leave(i)

    def settle(self) -> None:
        """Give every label a place, or give it up."""
        left = list(range(len(self.ranks)))
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
        self._untangle()

    def _look(self, who: Sequence[int], last: int) -> None:
        """Look for places in the rings up to ``last`` that some labels have not yet seen."""
        for first in sorted({self.seen[i] for i in who if self.seen[i] < last}):
            some = [i for i in who if self.seen[i] == first]
            for i, positions in zip(some, self.panel.free(some, first, last), strict=True):
                self.found[i] = self.found[i].joined(positions) if first else positions
                self.seen[i] = last

    def _stand(self, i: int) -> bool:
        """Take the cheapest place that no other label holds."""
        positions, others = self.found[i], tuple(self.standing.values())
        for position in positions.first:
            for other in others:
                if position.meets(other, _SPACE):
                    break
            else:
                self._take(i, position)
                return True
        for first, last in ((FEW, SOME), (SOME, MANY), (MANY, len(positions))):
            if first < len(positions):
                free = np.flatnonzero(~positions.part(first, last).met(self.held, _SPACE).any(axis=1))
                if free.size:
                    self._take(i, positions.position(first + int(free[0])))
                    return True
        return False

    def _drive_out(self, left: list[int]) -> list[int]:
        """Place labels in a crowd by driving out whoever is in the way, who then finds a place in the same way; each
        time that a label is driven out it grows harder to drive out.  Returns those that stand nowhere in the end."""
        if not left:
            return []
        worth = np.array([_WORTH[min(rank, len(_WORTH) - 1)] for rank in self.ranks])
        weight = worth.copy()
        queue, hopeless = list(left), []
        best, state = worth[left].sum(), (list(left), dict(self.standing))
        for _ in range(_DRIVES * len(self.ranks)):
            if not queue:
                break
            i = queue.pop(0)
            self._look([i], len(RINGS))
            positions = self.found[i]
            met = positions.met(self.held, _SPACE)
            lost = met @ weight
            if not len(positions) or (self.ranks[i] and lost.min() > weight[i]):
                hopeless.append(i)
                continue
            chosen = int(np.lexsort((positions.costs, lost))[0])
            for j in [j for j in self.standing if met[chosen, j]]:
                self._leave(j)
                weight[j] += worth[j]
                queue.append(j)
            self._take(i, positions.position(chosen))
            missing = worth[queue + hopeless].sum()
            if missing < best:
                best, state = missing, (sorted(queue + hopeless), dict(self.standing))
        lacking, standing = state
        self.standing, self.held = {}, HeldPositions(len(self.ranks))
        for i, position in standing.items():
            self._take(i, position)
        return lacking

    def _ease(self) -> None:
        """Move labels to better places: such as have come free, and such as are further off but cost less."""
        uneasy = [i for i, position in self.standing.items() if position.cost > least_cost(_STAGES[-2])]
        self._look(sorted(uneasy), _STAGES[-1])
        for i in sorted(self.standing):
            position = self.standing[i]
            if position.cost > self.found[i].costs[0]:
                self._leave(i)
                self._stand(i)

    def _untangle(self) -> None:
        """Find places for labels whose leaders cross vectors or joints, if need be by moving those in their way."""
        tangled = [i for i in self.standing if self.clear[i] and self.tangled(i)]
        if not tangled:
            return
        tangled.sort(key=lambda i: (-self.standing[i].cost, i))
        for i, positions in zip(tangled, self.panel.further(tangled), strict=True):
            self.found[i] = self.found[i].joined(positions)
        for i in tangled:
            self._make_room(i)

    def tangled(self, i: int) -> bool:
        """Whether the leader of a label crosses what leaders are to go round."""
        position = self.standing[i]
        return position.cost > TANGLED and self.panel.tangled(position)

    def _make_room(self, i: int) -> None:
        """Move a label, and one in its way, to where they cost less together."""
        here, found = self.standing[i], self.found[i]
        positions = found.part(0, int(np.searchsorted(found.costs, here.cost)))
        self._leave(i)
        best, chosen = here.cost, {i: here}
        others: dict[int, list[int]] = {}  # its places that are free but for the label
        for position, meeting in islice(self._nearly_free(positions), _TRIED):
            if position.cost >= best:
                break
            if not meeting.any():
                best, chosen = position.cost, {i: position}
                continue
            j = int(np.argmax(meeting))
            its = self.found[j]
            if j not in others:
                met = its.met(self.held, _SPACE)
                others[j] = np.flatnonzero(met.sum(axis=1) == met[:, j]).tolist()
            for k in others[j]:
                cost = position.cost + float(its.costs[k]) - self.standing[j].cost
                if cost >= best:
                    break
                moved = its.position(k)
                if not moved.meets(position, _SPACE):
                    best, chosen = cost, {i: position, j: moved}
                    break
        for label, position in chosen.items():
            self._take(label, position)

    def _nearly_free(self, positions: LabelPositions) -> Iterator[tuple[LabelPosition, Flags]]:
        """Places that meet at most one other label, cheapest first, with what they meet."""
        for first, last in ((0, SOME), (SOME, MANY), (MANY, len(positions))):
            met = positions.part(first, last).met(self.held, _SPACE)
            for k in np.flatnonzero(met.sum(axis=1) <= 1):
                yield positions.position(first + int(k)), met[k]

    def _insist(self, i: int) -> None:
        """Put a label where it does least harm, and give up those in its way that may be given up."""
        positions, important = self.panel.everywhere(i), np.array(self.ranks) == 0
        met = positions.met(self.held, 0.0)
        faults = positions.faults + met[:, important].sum(axis=1)
        chosen = int(np.lexsort((positions.costs, met.sum(axis=1), faults))[0])
        for j in np.flatnonzero(met[chosen] & ~important):
            self._leave(int(j))
        self.clear[i] = bool(faults[chosen] == 0)
        self._take(i, positions.position(chosen))
