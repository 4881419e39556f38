"""Where labels stand: clear of each other and of the drawing, inside their panel, nearer to their own mark than to any
other of its kind, or tied to it by a leader.

Each label has candidate places in rings of growing distance around its mark.  Those that the drawing forbids are sorted
out for all labels at once; then labels take places, the most constrained first, and labels left without one drive out
others (greedy point labelling with repair, after Christensen, Marks and Shieber, An empirical study of algorithms for
point-feature label placement, ACM Trans. Graphics 14, 1995).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import TypeAlias

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Line, Text
from graphkin.drawing.place.labels import (
    FORBIDDEN,
    LED_RINGS,
    RINGS,
    TANGLED,
    Label,
    LabelPanel,
    LabelPosition,
    LabelPositions,
    Mark,
    Placed,
    least_cost,
    meeting,
)
from graphkin.drawing.place.obstacles import Flags, Floats, Indices, Obstacles, Points
from graphkin.plane import added_up

__all__ = ["Placement", "place"]

# Rings looked at, one stage after the other, for the labels that have no place yet.
_STAGES = (0, 2, 5, len(RINGS))
# What a label is worth by its rank: so much more must others be worth together before it gives way to them.
_WORTH = (12, 5, 4, 3, 2, 1)
_DRIVES = 4  # how often labels may drive out others, for each label
_SPACE = complex(1.8, 0.9)  # mm between two labels, beside each other and one above the other
_TRIED = 40  # places tried to get round a vector
_LOOKED_AT = 120  # places of a label that is to make room
# Pushes for one label; what each costs the pushed one, more each time; what it costs to drop one that may be missing.
_PUSHES, _PUSHED, _DROPPED = 40, 8.0, 60.0
_MOVED = 2  # labels that make room for another at most
_DISPENSABLE = 4  # the rank from which labels may be missing
# What it costs that a key stands for a name, that a list tells a label by its ends, that it stands nowhere.
_KEY_COST, _TOLD_COST, _MISSING_COST = 10.0, 70.0, TANGLED
_TOLD = -1  # in place of a request
_NOTHING = Obstacles()
Place: TypeAlias = tuple[int, int]
"""A request and the index of one of its places, or ``_TOLD``."""
NOWHERE = LabelPosition(complex(np.nan, np.nan), 0j, 0.0, None)
"""Of a label that is told: it meets none."""


def place(
    labels: Sequence[Label], panel: Box, obstacles: Obstacles = _NOTHING, marks: Sequence[Mark] = ()
) -> tuple[Placed, ...]:
    """Give labels their places, in their order, those left out that are given up; the same input gives the same places.

    Parameters
    ----------
    labels : in the order of importance among equals
    panel : no label leaves it
    obstacles : what is drawn already
    marks : further points and segments that a reader could take a label for, besides those of the labels
    """
    return Placement(labels, panel, obstacles, marks).placed


class Placement:
    """Which label stands where; parameters as for `place`."""

    def __init__(
        self, labels: Sequence[Label], panel: Box, obstacles: Obstacles = _NOTHING, marks: Sequence[Mark] = ()
    ) -> None:
        self.labels, self.ranks = labels, [label.rank for label in labels]
        self.choices = LabelPanel(labels, panel, obstacles, marks)
        self.held = HeldPositions(len(labels), _SPACE)
        self.forms = list(range(len(labels)))  # the request by which each label stands, or ``_TOLD``
        self.faulty: set[int] = set()  # labels that stand where they do least harm
        self.telling = False  # whether a list may tell labels by their ends
        self.moves = 0  # how often room has been made
        # Labels for which none could be made: after how many moves, with how many keys, and who was in the way.
        self.stuck: dict[int, tuple[int, int, set[int]]] = {}
        if labels:
            self._settle()

    @property
    def told(self) -> list[int]:
        """The labels that a list tells by their ends."""
        return [i for i, form in enumerate(self.forms) if form == _TOLD]

    @property
    def placed(self) -> tuple[Placed, ...]:
        """The labels at their places, in their order; without such as may be missing and stand badly."""
        return tuple(
            self._placed(i, position) for i, position in sorted(self.held.standing.items())
            if self.ranks[i] < _DISPENSABLE or not self._badly(i)
        )  # fmt: skip

    def _placed(self, i: int, position: LabelPosition) -> Placed:
        request = self.forms[i]
        text, box = self.choices.texts[request], self.choices.boxes[request]
        leader = None if position.leader is None else Line(*position.leader, strokes.LEADER)
        at = complex(position.box.left - box.left, position.box.top - box.top)
        text = Text(at, text.runs, "start", text.colour, text.id, text.classes, text.step, text.since)
        return Placed(text, position.box, leader, i not in self.faulty, request != i)

    @property
    def crowded(self) -> list[int]:
        """The labels that stand badly, or nowhere though they have keys."""
        return [
            i for i, label in enumerate(self.labels)
            if (i in self.faulty or self._badly(i) if i in self.held.standing
                else self.forms[i] != _TOLD and label.key is not None and label.rank < _DISPENSABLE)
        ]  # fmt: skip

    def _settle(self) -> None:
        """Give every label a place, or give it up."""
        left = list(range(len(self.ranks)))
        for last in _STAGES[1:]:
            self.choices.look(left, last)
            left.sort(key=lambda i: (self.ranks[i] > 3, len(self.choices[i]), i))
            left = [i for i in left if not self._stand(i)]
            if not left:
                break
        crowded = bool(left)
        left = self._drive_out(sorted(left))
        self._ease(crowded)
        for i in left:
            if self.ranks[i] == 0:
                self._insist(i)
        self._untangle()

    def _stand(self, i: int) -> bool:
        """Take the cheapest place that no other label holds."""
        positions = self.choices[i]
        k = self.held.first_free(positions, len(positions))
        if k is None:
            return False
        self.held.take(i, positions.position(k))
        return True

    def _drive_out(self, left: list[int]) -> list[int]:
        """Place labels in a crowd by driving out whoever is in the way, who then finds a place in the same way; each
        time that a label is driven out it grows harder to drive out.  Returns those that stand nowhere in the end."""
        if not left:
            return []
        self.choices.look(left, len(RINGS))
        worth = np.array([_WORTH[min(rank, len(_WORTH) - 1)] for rank in self.ranks])
        weight = worth.copy()
        queue, hopeless = list(left), []
        best, state = worth[left].sum(), (list(left), dict(self.held.standing))
        for _ in range(_DRIVES * len(self.ranks)):
            if not queue:
                break
            i = queue.pop(0)
            self.choices.look([i], len(RINGS))
            positions = self.choices[i]
            met = self.held.met(positions, len(positions))
            lost = weight @ met
            if not len(positions) or (self.ranks[i] and lost.min() > weight[i]):
                hopeless.append(i)
                continue
            chosen = int(np.lexsort((positions.costs, lost))[0])
            for j in [j for j in self.held.standing if met[j, chosen]]:
                self.held.leave(j)
                weight[j] += worth[j]
                queue.append(j)
            self.held.take(i, positions.position(chosen))
            missing = worth[queue + hopeless].sum()
            if missing < best:
                best, state = missing, (sorted(queue + hopeless), dict(self.held.standing))
        lacking, standing = state
        self.held.put_back(standing)
        return lacking

    def _ease(self, freed: bool) -> None:
        """Move labels to better places: such as have come free (if any has), and such as are further off but cost
        less."""
        uneasy = [i for i, position in self.held.standing.items() if position.cost > least_cost(_STAGES[-2])]
        self.choices.look(sorted(uneasy), _STAGES[-1])
        for i in sorted(self.held.standing):
            if i not in uneasy and not freed:
                continue
            position, positions = self.held.standing[i], self.choices[i]
            better = positions.cheaper(position.cost)
            if better:
                self.held.leave(i)
                k = self.held.first_free(positions, better)
                self.held.take(i, position if k is None else positions.position(k))
                freed = freed or k is not None

    def _untangle(self) -> None:
        """Find places for labels that dashed lines run through, or whose leaders cross vectors or joints, if need be by
        moving those in their way."""
        for rings in LED_RINGS:
            tangled = [i for i in self.held.standing if i not in self.faulty and self._badly(i)]
            if not tangled:
                return
            tangled.sort(key=lambda i: (-self.held.standing[i].cost, i))
            self.choices.look_further(tangled, rings)
            for attempt in (self._make_room, self._make_room, self._push):  # once more, since others have made room
                for i in tangled:
                    if i in self.held.standing and self._badly(i):
                        attempt(i)

    def _badly(self, i: int) -> bool:
        """Whether a dashed line runs through a label, or its leader crosses what leaders are to go round."""
        return self._tangled(i) or self.choices.struck(self.held.standing[i])

    def _tangled(self, i: int) -> bool:
        """Whether the leader of a label crosses what leaders are to go round."""
        position = self.held.standing[i]
        return position.cost > TANGLED and self.choices.tangled(position)

    def shorten(self) -> None:
        """Put keys in place of names that stand badly and of those in their way; else have them told by their ends."""
        having = [i for i, label in enumerate(self.labels) if label.key is not None]
        crowded = sorted(self.crowded, key=lambda i: (-self._cost(i), i))
        self.choices.look_everywhere(self.choices.ask_for_keys([i for i in having if i in crowded]))
        for i in crowded:
            self._make_room(i)
        crowded = sorted(self.crowded, key=lambda i: (-self._cost(i), i))
        if crowded:
            self.choices.ask_for_keys([i for i in having if i not in self.choices.keys])
            for i in crowded:
                self._make_room(i)
        self.telling = True
        self.stuck.clear()
        for i in sorted(self.crowded, key=lambda i: (bool(self.labels[i].between), -self._cost(i), i)):
            self._make_room(i)

    def _cost(self, i: int) -> float:
        """What it costs that a label stands where it stands, or nowhere."""
        if i not in self.held.standing:
            return _TOLD_COST if self.forms[i] == _TOLD else _MISSING_COST
        if i in self.faulty:
            return FORBIDDEN
        return self.held.standing[i].cost + _KEY_COST * (self.forms[i] != i)

    def _make_room(self, i: int) -> None:
        """Move a label, and those in its way, to where they cost less together."""
        if self._is_stuck(i):
            return
        here, best = self.held.standing.get(i), self._cost(i)
        if here is not None:
            self.held.leave(i)
        chosen: dict[int, tuple[int, LabelPosition]] = {}
        if self.telling and self.labels[i].between and best > _TOLD_COST:
            chosen, best = {i: (_TOLD, NOWHERE)}, _TOLD_COST
        others: dict[int, tuple[Floats, list[Place], Points]] = {}
        for form, extra in self._forms(i):
            positions = self.choices[form]
            free = self.held.first_free(positions, positions.cheaper(best - extra))
            if free is not None:
                position = positions.position(free)
                chosen, best = {i: (form, position)}, position.cost + extra
            nearly = [*islice(self._nearly_free(positions, positions.cheaper(best - extra)), _TRIED)]
            there = np.array([position.forms for position, _ in nearly]).reshape(-1, 4).T
            clear: dict[int, Flags] = {}  # which of the others' places these positions leave free
            for n, (position, met) in enumerate(nearly):
                cost = position.cost + extra
                if cost >= best:
                    break
                moved = {i: (form, position)}
                for j in met.nonzero()[0].tolist():
                    if j not in others:
                        others[j] = self._others(j)
                    if j not in clear:
                        clear[j] = ~meeting(others[j][2], there, _SPACE)
                    rest = best - cost + self._cost(j)
                    further = [one for label, (_, one) in moved.items() if label != i]
                    elsewhere = self._elsewhere(others[j], clear[j][:, n], further, rest)
                    if elsewhere is None:
                        break
                    dear, moved[j] = elsewhere
                    cost += dear - self._cost(j)
                else:
                    if cost < best:
                        best, chosen = cost, moved
        if chosen:
            self.moves += 1
        else:
            self.stuck[i] = self.moves, len(self.choices.keys), {i, *others}
            if here is not None:
                self.held.take(i, here)
        for label, (form, place) in chosen.items():
            if form != _TOLD:
                self.held.take(label, place)
            elif label in self.held.standing:
                self.held.leave(label)
            self.faulty.discard(label)
            self.forms[label] = form

    def _push(self, i: int) -> None:
        """Put a label where its leader crosses nothing, and whoever stands there elsewhere in the same way; everything
        back where that comes to no end, or costs more."""
        before = dict(self.held.standing)
        pushed = np.full(len(self.ranks), _PUSHED)
        queue = [i]
        self.held.leave(i)
        for _ in range(_PUSHES):
            if not queue:
                break
            j = queue.pop(0)
            self.choices.look([j], len(RINGS))
            positions = self.choices[j]
            count = positions.cheaper(TANGLED)
            if not count:
                queue.append(j)
                break
            met = self.held.met(positions, count)
            chosen = int(np.argmin(positions.costs[:count] + pushed @ met))
            for k in met[:, chosen].nonzero()[0].tolist():
                self.held.leave(k)
                pushed[k] += _PUSHED
                queue.append(k)
            self.held.take(j, positions.position(chosen))
        after = self.held.standing
        cost = added_up(position.cost - before[j].cost for j, position in after.items() if position is not before[j])
        cost += added_up(_DROPPED - before[j].cost for j in queue)
        if cost >= 0 or any(self.ranks[j] < _DISPENSABLE for j in queue):
            self.held.put_back(before)
        self.moves += 1

    def _is_stuck(self, i: int) -> bool:
        """Whether no room could be made for a label, and nothing has changed since for it and those in its way."""
        moves, keys, concerned = self.stuck.get(i, (-1, 0, set()))
        return moves == self.moves and concerned.isdisjoint(list(self.choices.keys)[keys:])

    def _forms(self, i: int) -> list[tuple[int, float]]:
        """The requests by which a label may stand, and what they cost beside their places."""
        key = self.choices.keys.get(i)
        return [(i, 0.0), *([(key, _KEY_COST)] if key is not None else ())]

    def _others(self, j: int) -> tuple[Floats, list[Place], Points]:
        """Places of a label that no other is in the way of, the cheapest first: what they cost, which they are, and
        where, as `meeting` wants it."""
        found: list[tuple[float, Place]] = []
        for form, extra in self._forms(j):
            positions = self.choices[form]
            met = self.held.met(positions, min(_LOOKED_AT, len(positions)))
            free = (met.sum(axis=0) == met[j]).nonzero()[0]
            costs = (positions.costs[free] + extra).tolist()
            found += [(cost, (form, k)) for cost, k in zip(costs, free.tolist(), strict=True)]
        if self.telling and self.labels[j].between:
            found.append((_TOLD_COST, (_TOLD, 0)))
        found.sort()
        where = [place for _, place in found]
        stands = [NOWHERE.forms if form == _TOLD else self.choices[form].forms[:, k] for form, k in where]
        return np.array([cost for cost, _ in found]), where, np.array(stands, dtype=complex).reshape(-1, 4).T

    def _elsewhere(
        self, places: tuple[Floats, list[Place], Points], free: Flags, moved: Sequence[LabelPosition], most: float
    ) -> tuple[float, tuple[int, LabelPosition]] | None:
        """The cheapest of some places, as far as they are free, that costs less than so much and meets none of the
        labels that have moved, with its cost."""
        costs, where, stands = places
        free = free & (costs < most)
        for position in moved:
            free &= ~meeting(stands, np.array(position.forms)[:, None], _SPACE)[:, 0]
        if not free.any():
            return None
        form, k = where[first := int(free.argmax())]
        return float(costs[first]), (form, NOWHERE if form == _TOLD else self.choices[form].position(k))

    def _nearly_free(self, positions: LabelPositions, count: int) -> Iterator[tuple[LabelPosition, Flags]]:
        """Of the first places those that meet few other labels, cheapest first, with what they meet."""
        for first, last in positions.lots(count):
            met = self.held.met(positions, last)[:, first:]
            for k in (met.sum(axis=0) <= _MOVED)[: count - first].nonzero()[0].tolist():
                yield positions.position(first + k), met[:, k]

    def _insist(self, i: int) -> None:
        """Put a label where it does least harm, and give up those in its way that may be given up."""
        (positions, faults), important = self.choices.everywhere(i), np.array(self.ranks) == 0
        met = self.held.covered(positions)
        faults = faults + met[important].sum(axis=0)
        chosen = int(np.lexsort((positions.costs, met.sum(axis=0), faults))[0])
        for j in np.flatnonzero(met[:, chosen] & ~important):
            self.held.leave(int(j))
        if faults[chosen]:
            self.faulty.add(i)
        self.held.take(i, positions.position(chosen))


class HeldPositions:
    """The positions that labels hold with a space (mm, across and down) between them, and which places meet them."""

    def __init__(self, count: int, space: complex) -> None:
        self.space = space
        self.stands = np.zeros(count, dtype=bool)
        self.standing: dict[int, LabelPosition] = {}
        self.forms = np.zeros((4, count), dtype=complex)  # where labels stand or have stood
        self.numbers = np.full(count, -1, dtype=np.intp)  # and the numbers of these positions
        self.number: dict[LabelPosition, int] = {}
        # Of some of the first places of a label which others meet them, where these stand in positions of such numbers.
        self.known: dict[LabelPositions, tuple[Flags, Indices]] = {}

    def take(self, label: int, position: LabelPosition) -> None:
        self.standing[label] = position
        self.stands[label] = True
        self.forms[:, label] = position.forms
        self.numbers[label] = self.number.setdefault(position, len(self.number))

    def leave(self, label: int) -> None:
        del self.standing[label]
        self.stands[label] = False

    def put_back(self, standing: Mapping[int, LabelPosition]) -> None:
        """Let the labels hold positions that they have held at a time."""
        for label in tuple(self.standing):
            self.leave(label)
        for label, position in standing.items():
            self.take(label, position)

    def met(self, places: LabelPositions, count: int) -> Flags:
        """Which labels stand where they are met by which of the first places: labels in rows, places in columns."""
        known = self.known.get(places)
        if known is None or known[0].shape[1] < count:
            last = max((last for _, last in places.lots(count)), default=0)
            none = np.full(len(self.stands), -1, dtype=np.intp)
            known = self.known[places] = np.zeros((len(self.stands), last), dtype=bool), none
        over, numbers = known
        some = (self.stands & (numbers != self.numbers)).nonzero()[0]
        if some.size:
            over[some] = meeting(self.forms[:, some], places.forms[:, : over.shape[1]], self.space)
            numbers[some] = self.numbers[some]
        return over[:, :count] & self.stands[:, None]

    def covered(self, places: LabelPositions) -> Flags:
        """As `met` of all places, but that labels may stand as near to each other as they like."""
        over = np.zeros((len(self.stands), len(places)), dtype=bool)
        over[self.stands] = meeting(self.forms[:, self.stands], places.forms, 0j)
        return over

    def first_free(self, places: LabelPositions, count: int) -> int | None:
        """The index of the cheapest of the first ``count`` places that meets no label; None where all do."""
        for first, last in places.lots(count):
            free = np.flatnonzero(~self.met(places, last)[:, first:].any(axis=0))
            if free.size:
                return first + int(free[0]) if first + free[0] < count else None
        return None
