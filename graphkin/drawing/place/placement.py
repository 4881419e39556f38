"""The placement of labels: clear of each other and of the drawing, inside their panel, nearer to their own mark than to
any other of its kind, or tied to it by a leader.

Each label has places around its mark that the drawing leaves free, each at a cost.  First labels take the cheapest free
place, the most constrained label first; then moves are made until none gains: a label goes to a place where it and the
labels in its way cost less together, these going to free places, or nowhere (greedy point labelling with repair, after
Christensen, Marks and Shieber, An empirical study of algorithms for point-feature label placement, ACM Trans. Graphics
14, 1995).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Line, Text
from graphkin.drawing.place.labels import FORBIDDEN, NOWHERE, TOLD, Label, LabelPanel, Mark, intersections, outlined
from graphkin.drawing.place.obstacles import Flags, Indices, Obstacles
from graphkin.plane import added_up

SPACE = 1.8, 0.9  # mm between two labels, beside each other and one above the other
# What it costs that a label stands nowhere, by its rank: from the last two on it may be missing rather than have a
# leader across vectors.
MISSING = (1e9, 3000.0, 2000.0, 200.0, 105.0, 100.0)
DISPENSABLE = 4
# What it costs that a key stands for a name, and that a list tells a label by the ends of its vector.
KEY_COST, TOLD_COST = 10.0, 70.0
GAIN = 1.0  # mm: for less no label is moved
PUSHED, PUSH = 200, 10.0
ROUNDS = 6
TRIED, LOOKED_AT = 45, 100  # places tried that others stand in, and places that these may make room in
ROUNDING = 1e-6  # mm
IN_THE_WAY = 2  # labels that make room for another at most
NOTHING = Obstacles()


@dataclass(frozen=True)
class Placed:
    """A label at its place: the text, its box, and its leader to the mark if it needs one.

    ``clear`` is False if no faultless place was found; ``keyed`` tells that its key replaces it.
    """

    text: Text
    box: Box
    leader: Line | None = None
    clear: bool = True
    keyed: bool = False


class Placement:
    """Places of labels; the same input gives the same places.

    labels : in the order of importance among equals
    panel : no label leaves it
    obstacles : the strokes already drawn
    marks : further points and segments for which a label could be mistaken, besides those of the labels
    stands : the number of each label's place in the table of its panel
    paid : what each label costs there (mm)
    met : the places (columns) that labels (rows) leave no room in where they stand, but for those just ``moved``
    """

    def __init__(
        self, labels: Sequence[Label], panel: Box, obstacles: Obstacles = NOTHING, marks: Sequence[Mark] = ()
    ) -> None:
        self.labels = labels
        self.panel = LabelPanel(labels, panel, obstacles, marks)
        self.lacking = [MISSING[min(label.rank, len(MISSING) - 1)] for label in labels]
        self.stands, self.paid = [NOWHERE] * len(labels), [*self.lacking]
        self.met, self.moved = np.empty((len(labels), 0), dtype=bool), set[int]()
        self.telling = False  # whether a list may tell labels by their ends
        self.outlines = np.empty((20, 2, 0))
        self._list_places()
        order = ((label.rank >= DISPENSABLE, len(self.numbers[i]), i) for i, label in enumerate(labels))
        self._stand([i for _, _, i in sorted(order)])
        self._settle(range(len(labels)))
        for i, label in enumerate(labels):
            if label.rank == 0 and self.stands[i] == NOWHERE:
                self._insist(i)
        self.panel.look_further(self._wanting)
        self._list_places()
        self._settle(self._wanting)
        for i in self._wanting:
            self._push(i)

    @property
    def _wanting(self) -> list[int]:
        """The labels with a fault, or without a place."""
        return [i for i, k in enumerate(self.stands) if k == NOWHERE or self.panel.places.bad[k]]

    @property
    def told(self) -> list[int]:
        """The labels that a list names by their ends."""
        return [i for i, k in enumerate(self.stands) if k == TOLD]

    @property
    def placed(self) -> tuple[Placed, ...]:
        """The labels at their places, in their order."""
        return tuple(self._placed(i, k) for i, k in enumerate(self.stands) if k not in (NOWHERE, TOLD))

    def _placed(self, i: int, k: int) -> Placed:
        form = self.panel.places.forms[:, :, k].tolist()
        middle, half, foot, tip = (complex(*corner) for corner in form)
        request = int(self.panel.places.owners[k])
        text, bounds = self.panel.texts[request], self.panel.boxes[request]
        low, high = middle - half, middle + half
        box = Box(low.real, low.imag, high.real, high.imag)
        text = text._replace(at=complex(box.left - bounds.left, box.top - bounds.top), anchor="start")
        leader = None if foot == tip else Line(foot, tip, strokes.LEADER)
        return Placed(text, box, leader, self.paid[i] < FORBIDDEN, request != i)

    @property
    def crowded(self) -> list[int]:
        """The labels with a fault, or without a place though they have keys and must be placed."""
        keyed = [label.key is not None and label.rank < DISPENSABLE for label in self.labels]
        return [i for i in self._wanting if self.stands[i] != NOWHERE or keyed[i]]

    def shorten(self) -> None:
        """Replace names with faults, and names in their way, by keys; else list them by their ends."""
        crowded, keys = self.crowded, self.panel.ask_for_keys()
        self.panel.look_further([keys[i] for i in crowded if i in keys])
        self._list_places()
        self._settle(crowded)
        self.telling = True
        self._settle(self.crowded)

    def _settle(self, some: Iterable[int]) -> None:
        """Move some labels, the costliest first, while any move gains."""
        waiting = set(some)
        for _ in range(ROUNDS):
            for i in sorted(waiting, key=lambda i: (-self.paid[i], i)):
                if not self._improve(i):
                    waiting.discard(i)
            if not waiting:
                break

    def _list_places(self) -> None:
        """List the places of all labels again: their numbers by label, for its name and for its key, which costs more,
        the cheapest first; and judge the new ones beside the labels that stand."""
        table, known = self.panel.places, self.outlines.shape[2]
        if known == len(table.costs):
            return
        new = outlined(table.forms[:, :, known:], SPACE)
        met = np.zeros((len(self.labels), new.shape[2]), dtype=bool)
        if known:
            standing = [i for i, k in enumerate(self.stands) if k != NOWHERE and i not in self.moved]
            met[standing] = intersections(self.outlines.take([self.stands[i] for i in standing], axis=2), new)
            new, met = np.concatenate((self.outlines, new), axis=2), np.hstack((self.met, met))
        self.outlines, self.met = new, met
        self.costs = table.costs + KEY_COST * (table.owners >= len(self.labels))
        self.numbers = [self.panel.numbers[i] for i in range(len(self.labels))]
        for i, request in self.panel.keys.items():
            both = np.concatenate((self.numbers[i], self.panel.numbers[request]))
            self.numbers[i] = both[np.argsort(self.costs[both], kind="stable")]
        self.prices = [self.costs[numbers] for numbers in self.numbers]
        self.cheapest = [float(prices[0]) if prices.size else np.inf for prices in self.prices]

    def _take(self, i: int, k: int, cost: float) -> None:
        """Let a label stand in a place."""
        self.stands[i], self.paid[i] = k, cost
        self.moved.add(i)

    def _others_in(self, i: int, some: Indices) -> Flags:
        """Whether labels (rows), except one, stand in some places (columns)."""
        if self.moved:
            moved = sorted(self.moved)
            self.met[moved] = intersections(self.outlines.take([self.stands[j] for j in moved], axis=2), self.outlines)
            self.moved.clear()
        others = self.met.take(some, axis=1)
        others[i] = False
        return others

    def _stand(self, order: Sequence[int]) -> None:
        """Let labels take, in order, the cheapest free place."""
        for i in order:
            free = self.numbers[i][~self._others_in(i, self.numbers[i]).any(axis=0)]
            if free.size:
                self._take(i, int(free[0]), float(self.costs[free[0]]))

    def _improve(self, i: int) -> bool:
        """Move a label, and a few in its way, to places of lower total cost; whether there are such places."""
        paid, (gone, without) = self.paid[i], self._without(i)
        least = min(paid - GAIN, without)
        if paid <= without and self.cheapest[i] >= least:
            return False
        offers, met = self._offers(i, int(self.prices[i].searchsorted(least)))
        crowd = sorted({j for others in met for j in others})
        room, lots = self._room(i, crowd, offers, least)
        taken = self.outlines.take(room, axis=2)
        clear, beside = ~intersections(self.outlines.take(offers, axis=2), taken), dict[int, Flags]()
        costs, room_costs = self.costs[offers].tolist(), self.costs[room].tolist()
        best, moved = (gone, without) if without < paid else None, dict[int, int]()
        for n, others in enumerate(met):
            left, cost, goes = clear[n], costs[n], dict[int, int]()
            for j in others:
                lot, lacking = lots[j], self._without(j)[1]
                k = lot.start + int(left[lot].argmax()) if lot.start < lot.stop else -1
                goes[j] = k = k if k >= 0 and left[k] and room_costs[k] < lacking else -1
                cost += (room_costs[k] if k >= 0 else lacking) - self.paid[j]
                if cost >= least:
                    break
                if k >= 0 and j != others[-1]:
                    if k not in beside:
                        beside[k] = ~intersections(taken[:, :, k : k + 1], taken)[0]
                    left = left & beside[k]
            else:
                if cost < least:
                    least, best, moved = cost, (int(offers[n]), costs[n]), goes
        if best is None:
            return False
        self._take(i, *best)
        for j, k in moved.items():
            self._take(j, *((int(room[k]), room_costs[k]) if k >= 0 else self._without(j)))
        return True

    def _push(self, i: int) -> None:
        """Put a label in a cheap place, occupied or not, and let the displaced labels find places; undo it if that
        costs more."""
        before = self.stands.copy(), self.paid.copy()
        places = self.numbers[i][:PUSHED]
        if places.size:
            met = self._others_in(i, places)
            k = int(np.argmin(self.costs[places] + PUSH * met.sum(axis=0)))
            self._take(i, int(places[k]), float(self.costs[places[k]]))
            pushed = np.flatnonzero(met[:, k]).tolist()
            for j in pushed:
                self._take(j, *self._without(j))
            self._settle(pushed)
        if added_up(self.paid) > added_up(before[1]) - GAIN:
            for j, (k, cost) in enumerate(zip(*before, strict=True)):
                if self.stands[j] != k:
                    self._take(j, k, cost)

    def _without(self, i: int) -> tuple[int, float]:
        """The stand of a label without a place, and its cost: in a list by the ends of its vector, or nowhere."""
        telling = self.telling and self.labels[i].between and self.lacking[i] > TOLD_COST
        return (TOLD, TOLD_COST) if telling else (NOWHERE, self.lacking[i])

    def _offers(self, i: int, count: int) -> tuple[Indices, list[list[int]]]:
        """The first places of a label, up to a free one, in which few labels stand, and these labels."""
        places = self.numbers[i][:count]
        met = self._others_in(i, places)
        crowd = met.sum(axis=0)
        free = (crowd == 0).nonzero()[0][:1]
        few = (crowd[: free[0] if free.size else None] <= IN_THE_WAY).nonzero()[0][:TRIED]
        some = np.concatenate((few, free))
        others = iter(met.T[some].nonzero()[1].tolist())
        return places[some], [[*islice(others, count)] for count in crowd[some].tolist()]

    def _room(
        self, i: int, some: Sequence[int], offers: Indices, least: float
    ) -> tuple[Indices, dict[int, slice]]:
        """Places of some labels that only labels to be moved obstruct, the cheapest first; and each label's.

        Places too costly for the labels' savings are left out, if all are to cost less than ``least``.
        """
        if not some:
            return offers[:0], {}
        now = [self.paid[j] for j in some]
        saved = max(cost - min(self.cheapest[j], cost, self._without(j)[1]) for j, cost in zip(some, now, strict=True))
        most = least - self.costs[offers[0]] + saved + ROUNDING
        counts = [self.prices[j][:LOOKED_AT].searchsorted(cost + most) for j, cost in zip(some, now, strict=True)]
        lots = [self.numbers[j][:count] for j, count in zip(some, counts, strict=True)]
        places, labels = np.concatenate(lots), np.repeat(some, counts)
        standing = self._others_in(i, places)
        standing[labels, np.arange(len(labels))] = False
        free = np.flatnonzero(~standing.any(axis=0))
        bounds = np.searchsorted(labels[free], [*some, len(self.labels)]).tolist()
        spans = {j: slice(*span) for j, span in zip(some, pairwise(bounds), strict=True)}
        return places[free], spans

    def _insist(self, i: int) -> None:
        """Put a label in its least harmful place, and give up labels in its way that may be given up."""
        places, table = self.panel.everywhere(i), self.panel.places
        standing, everywhere = (outlined(forms, (0.0, 0.0)) for forms in (
            table.forms.take(self.stands, axis=2), places.forms))
        met = intersections(standing, everywhere)
        worth = np.array([min(FORBIDDEN, lacking) for lacking in self.lacking])
        k = int(np.argmin(places.costs + worth @ met))
        for j in np.flatnonzero(met[:, k]).tolist():
            if self.labels[j].rank:
                self._take(j, NOWHERE, self.lacking[j])
        self.panel.add(places.picked(np.array([k]))._replace(costs=np.array([FORBIDDEN]), bad=np.array([True])))
        self._list_places()
        self._take(i, len(table.costs), FORBIDDEN)
