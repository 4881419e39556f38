"""The placement of labels: clear of each other and of the drawing, inside their panel, nearer to their own mark than to
any other of its kind, or tied to it by a leader.

Each label has places around its mark that the drawing leaves free, each at a cost.  First labels take the cheapest free
place, the most constrained label first; then moves are made until none gains: a label goes to a place where it and the
labels in its way cost less together, these going to free places, or nowhere (greedy point labelling with repair, after
Christensen, Marks and Shieber, An empirical study of algorithms for point-feature label placement, ACM Trans. Graphics
14, 1995).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Line, Text
from graphkin.drawing.place.labels import FORBIDDEN, Label, LabelPanel, Mark, Places, meeting
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
LOT = 8  # places of all labels looked at together for some in which no label stands
IN_THE_WAY = 2  # labels that make room for another at most
TOLD, NOWHERE = -1, -2  # in place of a request
NOTHING = Obstacles()
NO_FORM = (math.nan, 0.0, 0.0, 0.0), (math.nan, 0.0, 0.0, 0.0)


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


def place(
    labels: Sequence[Label], panel: Box, obstacles: Obstacles = NOTHING, marks: Sequence[Mark] = ()
) -> tuple[Placed, ...]:
    """Give labels their places, in their order, without those given up; the same input gives the same places.

    Parameters
    ----------
    labels : in the order of importance among equals
    panel : no label leaves it
    obstacles : the strokes already drawn
    marks : further points and segments for which a label could be mistaken, besides those of the labels
    """
    return Placement(labels, panel, obstacles, marks).placed


class Stand(NamedTuple):
    """The place of a label: its request (``TOLD`` in a list, ``NOWHERE``), its cost (mm), x and y (mm) of its middle,
    half size, foot and tip of its leader, and whether it has a fault."""

    request: int
    cost: float
    form: Sequence[Sequence[float]] = NO_FORM
    bad: bool = False

    @classmethod
    def at(cls, places: Places, k: int | np.intp) -> Stand:
        """The stand at one of some places."""
        return cls(int(places.owners[k]), float(places.costs[k]), places.forms[:, :, k].tolist(), bool(places.bad[k]))


class Placement:
    """The labels' places; parameters as for `place`."""

    def __init__(
        self, labels: Sequence[Label], panel: Box, obstacles: Obstacles = NOTHING, marks: Sequence[Mark] = ()
    ) -> None:
        self.labels = labels
        self.choices = LabelPanel(labels, panel, obstacles, marks)
        self.lacking = [Stand(NOWHERE, MISSING[min(label.rank, len(MISSING) - 1)]) for label in labels]
        self.stands = [*self.lacking]
        self.forms = np.array([stand.form for stand in self.stands]).reshape(-1, 2, 4).transpose(1, 2, 0).copy()
        self.telling = False  # whether a list may tell labels by their ends
        self._list_places()
        order = ((label.rank >= DISPENSABLE, len(self.choices.found[i].costs), i) for i, label in enumerate(labels))
        self._stand([i for _, _, i in sorted(order)])
        self._settle(range(len(labels)))
        for i, label in enumerate(labels):
            if label.rank == 0 and self.stands[i].request == NOWHERE:
                self._insist(i)
        self.choices.look_further(self._wanting)
        self._list_places()
        self._settle(self._wanting)
        for i in self._wanting:
            self._push(i)

    @property
    def _wanting(self) -> list[int]:
        """The labels with a fault, or without a place."""
        return [i for i, one in enumerate(self.stands) if one.bad or one.request == NOWHERE]

    @property
    def told(self) -> list[int]:
        """The labels that a list names by their ends."""
        return [i for i, stand in enumerate(self.stands) if stand.request == TOLD]

    @property
    def placed(self) -> tuple[Placed, ...]:
        """The labels at their places, in their order."""
        return tuple(self._placed(i, one) for i, one in enumerate(self.stands) if one.request >= 0)

    def _placed(self, i: int, stand: Stand) -> Placed:
        middle, half, foot, tip = map(complex, *stand.form)
        text, own = self.choices.texts[stand.request], self.choices.boxes[stand.request]
        box = Box.around((middle - half, middle + half))
        at = complex(box.left - own.left, box.top - own.top)
        text = Text(at, text.runs, "start", text.colour, text.id, text.classes, text.step, text.since)
        leader = None if foot == tip else Line(foot, tip, strokes.LEADER)
        return Placed(text, box, leader, stand.cost < FORBIDDEN, stand.request != i)

    @property
    def crowded(self) -> list[int]:
        """The labels with a fault, or without a place though they have keys and must be placed."""
        keyed = [label.key is not None and label.rank < DISPENSABLE for label in self.labels]
        return [i for i in self._wanting if self.stands[i].request != NOWHERE or keyed[i]]

    def shorten(self) -> None:
        """Replace names with faults, and names in their way, by keys; else list them by their ends."""
        crowded, keys = self.crowded, self.choices.ask_for_keys()
        self.choices.look_further([keys[i] for i in crowded if i in keys])
        self._list_places()
        self._settle(crowded)
        self.telling = True
        self._settle(self.crowded)

    def _settle(self, some: Iterable[int]) -> None:
        """Move some labels, the costliest first, while any move gains."""
        waiting = set(some)
        for _ in range(ROUNDS):
            for i in sorted(waiting, key=lambda i: (-self.stands[i].cost, i)):
                if not self._improve(i):
                    waiting.discard(i)
            if not waiting:
                break

    def _take(self, i: int, stand: Stand) -> None:
        self.stands[i] = stand
        self.forms[:, :, i] = stand.form

    def _list_places(self) -> None:
        """List the places of all labels again, with their numbers by label: for its name and for its key, which costs
        more, the cheapest first."""
        lots = [self.choices.found[i] for i in range(len(self.labels))]
        if not lots:
            return
        for i, request in self.choices.keys.items():
            keys = self.choices.found[request]
            lot = Places.stacked((lots[i], keys._replace(costs=keys.costs + KEY_COST)))
            lots[i] = lot.picked(np.argsort(lot.costs, kind="stable"))
        bounds = accumulate((len(lot.costs) for lot in lots), initial=0)
        self.numbers = [np.arange(*span) for span in pairwise(bounds)]
        self.places = Places.stacked(lots)

    def _others_in(self, i: int, some: Indices) -> Flags:
        """Whether labels (rows), except one, stand in some places (columns)."""
        others = meeting(self.forms, self.places.picked(some).forms, SPACE)
        others[i] = False
        return others

    def _stand(self, order: Sequence[int]) -> None:
        """Let labels take, in order, the cheapest free place."""
        if not order:
            return
        lots = [self.numbers[i][:LOT] for i in order]
        places = self.places.picked(np.concatenate(lots))  # in which mostly there is a free one for each
        met, shut = meeting(places.forms, places.forms, SPACE), np.zeros(len(places.costs), dtype=bool)
        first = 0
        for i, lot in zip(order, lots, strict=True):
            last = first + len(lot)
            free = (~shut[first:last]).nonzero()[0]
            if free.size:
                self._take(i, Stand.at(self.places, lot[free[0]]))
                shut |= met[first + free[0]]
            elif self._stand_further(i):
                shut |= meeting(self.forms[:, :, i : i + 1], places.forms, SPACE)[0]
            first = last

    def _stand_further(self, i: int) -> bool:
        """Let a label take its cheapest free place; whether there is one."""
        places = self.numbers[i]
        free = np.flatnonzero(~self._others_in(i, places).any(axis=0))
        if free.size:
            self._take(i, Stand.at(self.places, places[free[0]]))
        return bool(free.size)

    def _improve(self, i: int) -> bool:
        """Move a label, and a few in its way, to places of lower total cost; whether there are such places."""
        here, without = self.stands[i], self._without(i)
        least = min(here.cost - GAIN, without.cost)
        costs = self.places.costs[self.numbers[i]]
        if here.cost <= without.cost and not (costs[:1] < least).any():
            return False
        offers, met = self._offers(i, int(np.searchsorted(costs, least)))
        crowd = sorted({j for others in met for j in others})
        room, lots, clear = self._room(i, crowd, offers, least)
        costs, room_costs = self.places.costs[offers].tolist(), self.places.costs[room].tolist()
        forms = self.places.picked(room).forms
        shut: dict[int, Flags] = {}  # what each place of those in the way leaves clear
        best, moved = without if without.cost < here.cost else here, dict[int, int]()
        for n, others in enumerate(met):
            left, cost, goes = clear[n], costs[n], dict[int, int]()
            for j in others:
                lot, lacking = lots[j], self._without(j).cost
                k = lot.start + int(left[lot].argmax()) if lot.start < lot.stop else -1
                goes[j] = k = k if k >= 0 and left[k] and room_costs[k] < lacking else -1
                cost += (room_costs[k] if k >= 0 else lacking) - self.stands[j].cost
                if cost >= least:
                    break
                if k >= 0 and j != others[-1]:
                    if k not in shut:
                        shut[k] = ~meeting(forms[:, :, k : k + 1], forms, SPACE)[0]
                    left = left & shut[k]
            else:
                if cost < least:
                    least, best, moved = cost, Stand.at(self.places, offers[n]), goes
        if best == here:
            return False
        self._take(i, best)
        for j, k in moved.items():
            self._take(j, Stand.at(self.places, room[k]) if k >= 0 else self._without(j))
        return True

    def _push(self, i: int) -> None:
        """Put a label in a cheap place, occupied or not, and let the displaced labels find places; undo it if that
        costs more."""
        before = list(self.stands)
        places = self.numbers[i][:PUSHED]
        if places.size:
            met = self._others_in(i, places)
            k = int(np.argmin(self.places.costs[places] + PUSH * met.sum(axis=0)))
            self._take(i, Stand.at(self.places, places[k]))
            pushed = np.flatnonzero(met[:, k]).tolist()
            for j in pushed:
                self._take(j, self._without(j))
            self._settle(pushed)
        if added_up(one.cost for one in self.stands) > added_up(one.cost for one in before) - GAIN:
            for j, stand in enumerate(before):
                if self.stands[j] != stand:
                    self._take(j, stand)

    def _without(self, i: int) -> Stand:
        """The stand of a label without a place: in a list by the ends of its vector, or nowhere."""
        telling = self.telling and self.labels[i].between and self.lacking[i].cost > TOLD_COST
        return Stand(TOLD, TOLD_COST) if telling else self.lacking[i]

    def _offers(self, i: int, count: int) -> tuple[Indices, list[list[int]]]:
        """The first places of a label, up to a free one, in which few labels stand, and these labels."""
        places = self.numbers[i][:count]
        met = self._others_in(i, places)
        crowd = met.sum(axis=0)
        free = np.flatnonzero(crowd == 0)[:1]
        few = np.flatnonzero(crowd[: free[0] if free.size else None] <= IN_THE_WAY)[:TRIED]
        some = np.concatenate((few, free))
        return places[some], [np.flatnonzero(others).tolist() for others in met.T[some]]

    def _room(
        self, i: int, some: Sequence[int], offers: Indices, least: float
    ) -> tuple[Indices, dict[int, slice], Flags]:
        """Places of some labels that only labels to be moved obstruct, the cheapest first; those of each label; and
        whether each offered place (rows) leaves them (columns) clear.

        Places too costly for the labels' savings are left out, if all are to cost less than ``least``.
        """
        if not some:
            return offers[:0], {}, np.empty((len(offers), 0), dtype=bool)
        known = self.places.costs
        now = [self.stands[j].cost for j in some]
        saved = max(
            cost - known[self.numbers[j]].min(initial=min(cost, self._without(j).cost))
            for j, cost in zip(some, now, strict=True)
        )
        most = least - known[offers[0]] + saved + ROUNDING
        counts = [np.searchsorted(known[self.numbers[j]], cost + most) for j, cost in zip(some, now, strict=True)]
        lots = [self.numbers[j][: min(LOOKED_AT, count)] for j, count in zip(some, counts, strict=True)]
        places, labels = np.concatenate(lots), np.repeat(some, [len(lot) for lot in lots])
        standing_offered = np.concatenate((self.forms, self.places.picked(offers).forms), axis=-1)
        met = meeting(standing_offered, self.places.picked(places).forms, SPACE)
        standing, offered = met[: len(self.labels)], met[len(self.labels) :]
        standing[i] = standing[labels, np.arange(len(labels))] = False
        free = np.flatnonzero(~standing.any(axis=0))
        bounds = np.searchsorted(labels[free], [*some, len(self.labels)]).tolist()
        spans = {j: slice(*span) for j, span in zip(some, pairwise(bounds), strict=True)}
        return places[free], spans, ~offered[:, free]

    def _insist(self, i: int) -> None:
        """Put a label in its least harmful place, and give up labels in its way that may be given up."""
        places = self.choices.everywhere(i)
        met = meeting(self.forms, places.forms, (0.0, 0.0))
        worth = np.array([min(FORBIDDEN, stand.cost) for stand in self.lacking])
        k = int(np.argmin(places.costs + worth @ met))
        for j in np.flatnonzero(met[:, k]).tolist():
            if self.labels[j].rank:
                self._take(j, self.lacking[j])
        self._take(i, Stand.at(places, k)._replace(cost=FORBIDDEN, bad=True))
