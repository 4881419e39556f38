"""Where labels stand: clear of each other and of the drawing, inside their panel, nearer to their own mark than to any
other of its kind, or tied to it by a leader.

Each label has candidate places in rings of growing distance around its mark.  Those that the drawing forbids are sorted
out for all labels at once; then labels take places, the most constrained first, and labels left without one drive out
others (greedy point labelling with repair, after Christensen, Marks and Shieber, An empirical study of algorithms for
point-feature label placement, ACM Trans. Graphics 14, 1995).

Whether boxes and leaders meet is asked of many at once as linear forms of the page: how far a point lies from a middle,
across and down, or from the line of a leader, against what both take there (separating axes).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Line, Text
from graphkin.drawing.place.labels import (
    FORBIDDEN,
    LED_RINGS,
    LOTS,
    RINGS,
    TANGLED,
    Label,
    LabelPanel,
    LabelPosition,
    LabelPositions,
    Mark,
    Placed,
    leader_forms,
    least_cost,
)
from graphkin.drawing.place.obstacles import ON_LINE, Flags, Floats, Indices, Obstacles
from graphkin.drawing.text import box_about
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
# Where it stands in the forms of a held position: as factors of 1, x, y the distances of a point from the middle of its
# box, from the middle of its leader and from the line of that; as factors of 1, half width, half height of a box there
# how near it must be to meet; 1 with middle, half size, foot and tip.
_DISTANCES, _REACHES, _MIDDLE, _HALF = slice(15), slice(15, 30), slice(30, 33), slice(33, 36)
_FOOT, _TIP, _NUMBERS = slice(36, 39), slice(39, 42), 42
_BOX_DISTANCES, _NORMAL, _BOX_REACHES = slice(6), slice(12, 15), slice(15, 21)
_NO_LEADER: tuple[float, ...] = (1.0, 0.0, 0.0) * 3
_NOWHERE: tuple[float, ...] = (0.0, 0.0, 0.0) * 3


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


class _Choices:
    """What labels, and keys in their place, may choose from: a text, its box, and places as far as they have been
    looked at.  A request is the number of a label, or one behind them for the key of one."""

    def __init__(self, labels: Sequence[Label], panel: Box, obstacles: Obstacles, marks: Sequence[Mark]) -> None:
        self.labels = labels
        self.texts = [label.text for label in labels]
        self.boxes = [box_about(text.runs) for text in self.texts]
        self.asked = list(zip(labels, self.boxes, strict=True))
        self.panel = LabelPanel(panel, obstacles, marks, self.asked)
        self.found: dict[int, LabelPositions] = {}
        self.seen = [0] * len(labels)  # rings looked at
        self.keys: dict[int, int] = {}  # the request for the key of a label

    def __getitem__(self, request: int) -> LabelPositions:
        """The places of a request; those of a key, which may never be in question, are looked for here."""
        if request not in self.found:
            (self.found[request],) = self.panel.free([request], 0, len(RINGS))
        return self.found[request]

    def look(self, who: Sequence[int], last: int) -> None:
        """Look for places in the rings up to ``last`` that some labels have not yet seen."""
        for first in sorted({self.seen[i] for i in who if self.seen[i] < last}):
            some = [i for i in who if self.seen[i] == first]
            known = [self.found[i] for i in some] if first else ()
            self.found |= zip(some, self.panel.free(some, first, last, known), strict=True)
            for i in some:
                self.seen[i] = last

    def look_further(self, who: Sequence[int], rings: tuple[float, ...]) -> None:
        """Look for places of some labels with leaders in further rings (mm)."""
        self.found |= zip(who, self.panel.further(who, rings, [self.found[i] for i in who]), strict=True)

    def look_everywhere(self, who: Sequence[int]) -> None:
        """Look for places of some requests in all rings, and for further ones."""
        if who:
            self.found |= zip(who, self.panel.everywhere_free(who), strict=True)

    def ask_for_keys(self, some: Sequence[int]) -> range:
        """Let keys of some labels want places too; returns their requests."""
        first = len(self.asked)
        for i in some:
            label = self.labels[i]
            assert label.key is not None
            classes = ("label", *label.key.classes)
            self.texts.append(replace(label.key, id=label.text.id, classes=classes, since=label.text.since))
            self.boxes.append(box_about(label.key.runs))
            self.asked.append((label, self.boxes[-1]))
        self.panel.ask(self.asked)
        requests = range(first, len(self.asked))
        self.keys |= zip(some, requests, strict=True)
        return requests

    def forms(self, i: int) -> list[tuple[int, float]]:
        """The requests by which a label may stand, and what they cost beside their places."""
        return [(i, 0.0), *((key, _KEY_COST) for key in (self.keys.get(i),) if key is not None)]


class Placement:
    """Which label stands where; parameters as for `place`."""

    def __init__(
        self, labels: Sequence[Label], panel: Box, obstacles: Obstacles = _NOTHING, marks: Sequence[Mark] = ()
    ) -> None:
        self.labels, self.ranks = labels, [label.rank for label in labels]
        self.choices = _Choices(labels, panel, obstacles, marks)
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
        at = complex(position.left - box.left, position.top - box.top)
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
        return self._tangled(i) or self.choices.panel.struck(self.held.standing[i])

    def _tangled(self, i: int) -> bool:
        """Whether the leader of a label crosses what leaders are to go round."""
        position = self.held.standing[i]
        return position.cost > TANGLED and self.choices.panel.tangled(position)

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
        chosen: dict[int, tuple[int, LabelPosition | None]] = {}
        if self.telling and self.labels[i].between and best > _TOLD_COST:
            chosen, best = {i: (_TOLD, None)}, _TOLD_COST
        others: dict[int, list[tuple[float, int, int]]] = {}  # their places that are free but for this label and them
        for form, extra in self.choices.forms(i):
            positions = self.choices[form]
            free = self.held.first_known_free(positions, positions.cheaper(best - extra))
            if free is not None:
                position = positions.position(free)
                chosen, best = {i: (form, position)}, position.cost + extra
            nearly = self._nearly_free(positions, positions.cheaper(best - extra))
            for position, meeting in islice(nearly, _TRIED):
                cost = position.cost + extra
                if cost >= best:
                    break
                moved: dict[int, tuple[int, LabelPosition | None]] = {i: (form, position)}
                taken = [position]
                for j in meeting.nonzero()[0].tolist():
                    if j not in others:
                        others[j] = self._others(j)
                    rest = best - cost + self._cost(j)
                    for dear, own, k in others[j]:
                        if dear >= rest:
                            break
                        its = None if own == _TOLD else self.choices[own].position(k)
                        if its is not None:
                            if any(its.meets(one, _SPACE) for one in taken):
                                continue
                            taken.append(its)
                        moved[j] = own, its
                        cost += dear - self._cost(j)
                        break
                    if j not in moved:
                        break
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
            if place is not None:
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

    def _others(self, j: int) -> list[tuple[float, int, int]]:
        """Places of a label that no other is in the way of: what they cost, their request and index."""
        found = []
        for form, extra in self.choices.forms(j):
            positions = self.choices[form]
            met = self.held.met(positions, min(_LOOKED_AT, len(positions)))
            free = (met.sum(axis=0) == met[j]).nonzero()[0]
            costs = (positions.costs[free] + extra).tolist()
            found += [(cost, form, k) for cost, k in zip(costs, free.tolist(), strict=True)]
        if self.telling and self.labels[j].between:
            found.append((_TOLD_COST, _TOLD, 0))
        return sorted(found)

    def _nearly_free(self, positions: LabelPositions, count: int) -> Iterator[tuple[LabelPosition, Flags]]:
        """Of the first places those that meet few other labels, cheapest first, with what they meet."""
        for first, last in positions.lots(count):
            met = self.held.met(positions, last)[:, first:]
            for k in (met.sum(axis=0) <= _MOVED)[: count - first].nonzero()[0].tolist():
                yield positions.position(first + k), met[:, k]

    def _insist(self, i: int) -> None:
        """Put a label where it does least harm, and give up those in its way that may be given up."""
        (positions, faults), important = self.choices.panel.everywhere(i), np.array(self.ranks) == 0
        met = self.held.covered(positions)
        faults = faults + met[important].sum(axis=0)
        chosen = int(np.lexsort((positions.costs, met.sum(axis=0), faults))[0])
        for j in np.flatnonzero(met[:, chosen] & ~important):
            self.held.leave(int(j))
        if faults[chosen]:
            self.faulty.add(i)
        self.held.take(i, positions.position(chosen))


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
        distances = held[:, _DISTANCES].reshape(-1, 3) @ places.middles[:, first:last]
        near = np.abs(distances, out=distances) < (held[:, _REACHES].reshape(-1, 3) @ half)[:, None]
        box_x, box_y, leader_x, leader_y, line = near.reshape(len(labels), 5, -1).transpose(1, 0, 2)
        over: Flags = box_x & box_y
        over |= leader_x & leader_y & line
        led = max(places.first_led, first)
        if led < last:
            over[:, led - first :] |= _met_by_leaders(held, places, slice(led, last))
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
            distances = held[:, _BOX_DISTANCES].reshape(-1, 3) @ places.middles[:, first:last]
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
        -x, 1.0, 0.0, -y, 0.0, 1.0, *distances, half_x + space.real, 1.0, 0.0, half_y + space.imag, 0.0, 1.0, *reaches,
        1.0, x, y, 1.0, half_x, half_y, 1.0, foot.real, foot.imag, 1.0, tip.real, tip.imag,
    )  # fmt: skip


def _met_by_leaders(held: Floats, places: LabelPositions, some: slice) -> Flags:
    """Which positions are met by the leaders of some places."""
    distances, reaches = (form[..., some].reshape(3, -1) for form in places.leaders)
    apart = held[:, _MIDDLE] @ distances
    near = np.abs(apart, out=apart) < held[:, _HALF] @ reaches
    across, down, line = near.reshape(len(held), 3, -1).transpose(1, 0, 2)
    under: Flags = across & down
    under &= line
    its_normal, own_normal = held[:, _NORMAL], places.leaders[0][:, 2, some]
    crossed = (its_normal @ places.feet[:, some]) * (its_normal @ places.tips[:, some]) < -ON_LINE
    crossed &= (held[:, _FOOT] @ own_normal) * (held[:, _TIP] @ own_normal) < -ON_LINE
    under |= crossed
    return under
