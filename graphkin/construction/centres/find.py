"""All instant centres of a scene as a student finds them: the permanent ones, Kennedy's theorem, and what remains.

The motion of a link is measured on the velocity polygon; where two links have one velocity is their centre.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from heapq import heappop, heappush
from typing import Literal

from graphkin.construction.centres.pairs import (
    Line,
    LinkPair,
    Links,
    Normal,
    Place,
    ProjectiveChart,
    links_on_paper,
    normals,
    permanent,
    wedge,
)
from graphkin.construction.instruments import Instrument
from graphkin.construction.links_on_paper import LinkMotion
from graphkin.construction.scales import Scales
from graphkin.construction.sheet import Sheet
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef
from graphkin.words import Phrase

__all__ = [
    "ROUNDING", "Centre", "CentreRelation", "Centres", "CrossedCentre", "Known", "Search", "Worked",
    "closure", "found_on",
]  # fmt: skip

AT_REST = 1e-9
"""Two links whose relative motion is smaller than this part of the largest do not move relative to each other."""
MEASURED = 1e-15  # so far off a measured centre may be (on the unit sphere)
SLOW = 1e-3  # part of the largest motion below which a relative one is measured worse than that
ROUNDING = 2e-16
SURE = 1e-10
"""A crossing whose place may err by more than this (of the mechanism's size) is not taken."""
MOST_LINES = 24  # for one centre; a mechanism of many links has hundreds, and a few of them cross well
TOGETHER = 1e-9  # two centres nearer to each other (on the unit sphere) give no line


def measured(sheet: Sheet) -> dict[str, LinkMotion]:
    """Every link in the velocity polygon: one end point of it, and its angular velocity."""
    per_mm = sheet.scales.velocity / sheet.scales.length
    ends = sheet.ends["velocity"]
    ground = sheet.scene.frame.name
    found = {ground: LinkMotion(0j, 0j, 0.0)}
    for name, rate in sheet.omega.items():
        points = sheet.structure.links[name].points
        for ref, end in ends.items():
            if name != ground and (ref.link == name or (not ref.link and ref.point in points)):
                found[name] = LinkMotion(sheet.points[PointRef(ref.point)], end * per_mm, rate.value)
                break
    return found


def relative_centre(
    motions: Mapping[str, LinkMotion], pair: LinkPair, chart: ProjectiveChart, largest: float
) -> tuple[Place, float] | None:
    """Where two links have the same velocity, and how far the place may be off on the unit sphere; None where they do
    not move relative to each other, beside the ``largest`` strength of all links.

    Raises
    ------
    KeyError : the motion of one of the two was not measured
    """
    one, two = motions[pair[0]], motions[pair[1]]
    at = chart.middle
    place, strength = chart.pole(at, one.of(at) - two.of(at), one.omega - two.omega)
    return None if abs(strength) <= AT_REST * largest else (place, MEASURED * max(1.0, SLOW * largest / abs(strength)))


Way = Literal["velocity polygon", "superposition"]


@dataclass(frozen=True)
class Worked:
    """A position drawn, the motion of every link measured, and the way in which it was found.

    ``kept`` names what superposed motions let fit: the bars or sliding pairs that the trial polygons leave open.
    """

    sheet: Sheet
    motions: Mapping[str, LinkMotion]
    way: Way = "velocity polygon"
    kept: tuple[str, ...] = ()


def worked(sheet: Sheet) -> Worked:
    """How everything on a sheet moves."""
    trial = [group for group in sheet.groups if group.way == "superposition"]
    kept = tuple(name for group in trial for name in group.closing)
    return Worked(sheet, measured(sheet), "superposition" if trial else "velocity polygon", kept)


@dataclass(frozen=True)
class Centre:
    """One instant centre.

    ``place`` is homogeneous in the chart (None where undetermined); ``point`` in mm on paper, None at infinity, where
    ``direction`` is the way to it.  ``number`` counts the found ones in their order.  ``joint`` names the joint of a
    permanent one, ``lines`` are the two that cross in a found one; ``way`` names the construction of one that Kennedy's
    theorem does not give, ``why`` says why it does not, or why there is none.
    """

    pair: LinkPair
    kind: Literal["permanent", "found", "undetermined"]
    place: Place | None = None
    point: complex | None = None
    direction: complex | None = None
    number: int = 0
    joint: str = ""
    rolls: bool = False
    lines: tuple[CentreRelation, ...] = ()
    way: Way | Literal[""] = ""
    why: Phrase | None = None
    error: float = 0.0


@dataclass(frozen=True)
class Centres:
    """All centres of one position.  ``found`` gives them in the order in which they are found, the permanent first.

    ``kept`` names the bars that two superposed motions keep in their length, where the position was found by trial.
    """

    sheet: Sheet
    links: Links
    chart: ProjectiveChart
    table: Mapping[LinkPair, Centre]
    normals: tuple[Normal, ...]
    motions: Mapping[str, LinkMotion]
    kept: tuple[str, ...] = ()

    def of(self, a: str, b: str) -> Centre:
        """The centre of two links, in any order.  Raises KeyError for a pair that is none."""
        return self.table[self.links.pair(a, b)]

    def at(self, scales: Scales) -> Centres:
        """The same centres at other scales."""
        k = self.sheet.scales.length / scales.length
        poses = {name: pose.scaled(k) for name, pose in self.links.poses.items()}
        return Centres(
            self.sheet.at(scales),
            Links(self.links.scene, self.links.mm * k, poses),
            ProjectiveChart(self.chart.middle * k, self.chart.unit * k),
            {pair: replace(c, point=None if c.point is None else c.point * k) for pair, c in self.table.items()},
            tuple(replace(normal, foot=normal.foot * k) for normal in self.normals),
            {name: LinkMotion(m.at * k, m.velocity * k, m.omega) for name, m in self.motions.items()},
            self.kept,
        )

    @property
    def found(self) -> tuple[Centre, ...]:
        return tuple(sorted(self.table.values(), key=lambda c: c.number))

    @property
    def indeterminate(self) -> tuple[Centre, ...]:
        """Those that Kennedy's theorem does not give."""
        return tuple(c for c in self.found if c.way or c.kind == "undetermined")


def found_on(worked: Worked, scene: Mechanism, instrument: Instrument) -> Centres:
    """Every centre of every two links of a scene that is drawn."""
    links = links_on_paper(scene, 1.0 / worked.sheet.scales.length, worked.sheet.poses)
    chart = links.chart()
    table, slots = _search(links, chart, worked.motions, instrument, worked.way)
    return Centres(worked.sheet, links, chart, table, slots, worked.motions, worked.kept)


def _search(
    links: Links, chart: ProjectiveChart, motions: Mapping[str, LinkMotion], instrument: Instrument, way: Way
) -> tuple[dict[LinkPair, Centre], tuple[Normal, ...]]:
    slots = tuple(normals(links, chart))
    search = Search(links.pairs, links.names, slots)
    table: dict[LinkPair, Centre] = {}
    for p in permanent(links, chart).values():
        direction = chart.direction(p.place) if p.point is None else None
        table[p.pair] = Centre(p.pair, "permanent", p.place, p.point, direction, joint=p.joint, rolls=p.rolls)
        search.learn(p.pair, Known(p.place))
    at = chart.middle
    largest = max((abs(chart.pole(at, m.of(at), m.omega)[1]) for m in motions.values()), default=0.0)
    number = 0
    reach = _Reach(links, [normal.pair for normal in slots], motions, set(table))
    while len(table) < len(links.pairs):
        number += 1
        crossing = search.next()
        if crossing is not None:
            centre = _crossed(crossing, chart, number, instrument)
        else:
            centre = _otherwise(chart, motions, search, reach.best(table), number, way, largest)
        table[centre.pair] = centre
        if centre.place is not None:
            search.learn(centre.pair, Known(centre.place, max(centre.error, 2e-16)))
            reach.found(centre.pair)
    return {pair: table[pair] for pair in links.pairs}, slots


class _Reach:
    """Which centres the known ones lead to by triangles, were no two lines to fall together."""

    def __init__(
        self, links: Links, slots: list[LinkPair], motions: Mapping[str, LinkMotion], known: set[LinkPair]
    ) -> None:
        self.links, self.slots, self.motions = links, slots, motions
        self.order = sorted(links.pairs, key=self._plain, reverse=True)
        self.done = 0  # of the order
        self.reached: set[LinkPair] = set()
        self._grow(known)

    def _plain(self, pair: LinkPair) -> tuple[bool, bool]:
        return pair[0] in self.motions and pair[1] in self.motions, self.links.scene.frame.name in pair

    def _grow(self, known: set[LinkPair]) -> None:
        self.reached = closure(self.links.pairs, self.links.names, self.reached | known, self.slots)
        self.beyond = [pair for pair in self.links.pairs if pair not in self.reached]

    def found(self, pair: LinkPair) -> None:
        """Take in a centre whose place is known."""
        if pair not in self.reached:
            self._grow({pair})

    def best(self, table: Mapping[LinkPair, Centre]) -> LinkPair:
        """The missing centre that gives most others; measured ones before those that are not, then the frame's."""
        while self.order[self.done] in table:
            self.done += 1
        self.beyond = [pair for pair in self.beyond if pair not in table]
        # one that the triangles reach, if not surely, gives no more than they do
        return max([*self.beyond, self.order[self.done]], key=self._gain)

    def _gain(self, pair: LinkPair) -> tuple[bool, int, bool]:
        measurable, of_frame = self._plain(pair)
        if pair in self.reached:
            return measurable, 0, of_frame
        more = closure(self.links.pairs, self.links.names, self.reached | {pair}, self.slots)
        return measurable, len(more) - len(self.reached), of_frame


def _crossed(crossing: CrossedCentre, chart: ProjectiveChart, number: int, instrument: Instrument) -> Centre:
    place = crossing.place
    point = chart.point(place)
    if point is not None:
        pricked = instrument.point(point)
        if pricked != point:
            place, point = chart.at(pricked), pricked
    direction = chart.direction(place) if point is None else None
    return Centre(crossing.pair, "found", place, point, direction, number, lines=crossing.lines, error=crossing.error)


def _otherwise(
    chart: ProjectiveChart, motions: Mapping[str, LinkMotion], search: Search, pair: LinkPair, number: int, way: Way,
    largest: float,
) -> Centre:  # fmt: skip
    """A centre that Kennedy's theorem does not give now; ``largest`` is the strongest motion of a link."""
    why = _why(search, pair)
    found = None
    if pair[0] in motions and pair[1] in motions:
        found = relative_centre(motions, pair, chart, largest)
        if found is None:
            return Centre(pair, "undetermined", number=number, why=Phrase("centre no motion", pair))
    if found is None:
        return Centre(pair, "undetermined", number=number, why=why)
    place, error = found
    point = chart.point(place)
    direction = chart.direction(place) if point is None else None
    return Centre(pair, "found", place, point, direction, number, way=way, why=why, error=error)


def _why(search: Search, pair: LinkPair) -> Phrase:
    """Why Kennedy's theorem fails: too few triangles, or lines that fall together."""
    count = len(search.lines[pair])
    if count < 2:
        return Phrase("centre few lines", (*pair, count))
    return Phrase("centre lines together", pair)


# -- Kennedy's theorem -------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Known:
    """A centre already found: its place, and how far it may err on the unit sphere."""

    place: Place
    error: float = ROUNDING


@dataclass(frozen=True)
class CentreRelation:
    """A line on which a centre lies: through two centres with a third link, or the common normal of a pin in a slot.

    ``via`` is the third link ("" for a normal); ``through`` names the two centres, or the pin in slot.
    """

    pair: LinkPair
    line: Line
    error: float
    via: str
    through: tuple[LinkPair, LinkPair] | tuple[str]


@dataclass(frozen=True)
class CrossedCentre:
    """A centre found where two lines cross; ``sine`` of their angle on the sphere, ``error`` of the place."""

    pair: LinkPair
    place: Place
    lines: tuple[CentreRelation, CentreRelation]
    sine: float
    error: float


class Search:
    """The circle diagram as it fills: centres known, lines known for each missing one, the best crossing of each."""

    def __init__(self, pairs: Sequence[LinkPair], names: Sequence[str], normals: Sequence[Normal]) -> None:
        self.pairs, self.names, self.known = pairs, names, dict[LinkPair, Known]()
        self.lines: dict[LinkPair, list[CentreRelation]] = {pair: [] for pair in pairs}
        self.best: dict[LinkPair, CrossedCentre] = {}
        self._place = {pair: i for i, pair in enumerate(pairs)}
        self._ranked: list[tuple[int, int]] = []  # powers of ten of the errors, with the place of the pair: a heap
        self._bit = {name: 1 << i for i, name in enumerate(names)}
        # for each link a bit for every other whose centre with it is known, and for every one that needs no more lines
        self._joined, self._full = dict.fromkeys(names, 0), dict.fromkeys(names, 0)
        self._as_written = {(a, b): pair for pair in pairs for a, b in (pair, pair[::-1])}
        for normal in normals:
            self._add(CentreRelation(normal.pair, normal.line, ROUNDING, "", (normal.key,)))

    def learn(self, pair: LinkPair, known: Known) -> None:
        """Take in a centre, and with it all lines that it completes."""
        self.known[pair] = known
        for a, b in (pair, pair[::-1]):
            self._joined[a] |= self._bit[b]
        for a, b in (pair, pair[::-1]):
            # the triangle a, b, via: the side from a to via is missing, b is its third link
            wanted = self._joined[b] & ~(self._joined[a] | self._full[a] | self._bit[a])
            while wanted:
                first = wanted & -wanted
                wanted ^= first
                via = self.names[first.bit_length() - 1]
                self._relate(self._as_written[a, via], b, pair, self._as_written[b, via])

    def next(self) -> CrossedCentre | None:
        """The missing centre that is found best: the least error to be expected, counted in powers of ten, and among
        those the first in the order of the links.  None where no two lines cross so well that the place errs by no
        more than ``SURE`` (on the unit sphere)."""
        while self._ranked:
            pair = self.pairs[self._ranked[0][1]]
            if pair in self.known:
                heappop(self._ranked)
            else:
                return self.best[pair]
        return None

    def _relate(self, missing: LinkPair, via: str, one: LinkPair, two: LinkPair) -> None:
        a, b = self.known[one], self.known[two]
        line, sine = wedge(a.place, b.place)
        if sine > TOGETHER:
            if missing[0] not in one:
                one, two = two, one
            self._add(CentreRelation(missing, line, (a.error + b.error + ROUNDING) / sine, via, (one, two)))

    def _add(self, relation: CentreRelation) -> None:
        pair, lines = relation.pair, self.lines[relation.pair]
        if len(lines) == MOST_LINES:
            return
        for other in lines:
            error = other.error + relation.error + ROUNDING
            if pair in self.best and error >= self.best[pair].error:
                continue  # however well they cross
            place, sine = wedge(other.line, relation.line)
            if sine == 0.0 or (pair in self.best and error / sine >= self.best[pair].error):
                continue
            if place[2] < 0.0:
                place = -place[0], -place[1], -place[2]
            self.best[pair] = CrossedCentre(pair, place, (other, relation), sine, error / sine)
            if error / sine <= SURE:
                heappush(self._ranked, (math.ceil(math.log10(error / sine)), self._place[pair]))
        lines.append(relation)
        if len(lines) == MOST_LINES:
            for a, b in (pair, pair[::-1]):
                self._full[a] |= self._bit[b]


def closure(
    pairs: Sequence[LinkPair], names: Sequence[str], known: set[LinkPair], slots: Sequence[LinkPair]
) -> set[LinkPair]:
    """The centres that two closed triangles of the circle diagram can give, one after the other, lines never falling
    together.  ``slots`` are pairs with a common normal: one line each."""
    place = {name: i for i, name in enumerate(names)}
    slotted = Counter(slots)
    joined = [0] * len(names)  # for each link, a bit for every other whose centre with it is known

    def join(pair: LinkPair) -> None:
        a, b = place[pair[0]], place[pair[1]]
        joined[a] |= 1 << b
        joined[b] |= 1 << a

    have = set(known)
    for pair in have:
        join(pair)
    left = [pair for pair in pairs if pair not in have]
    grown = True
    while grown:
        grown = False
        missing = []
        for pair in left:
            triangles = (joined[place[pair[0]]] & joined[place[pair[1]]]).bit_count()
            if slotted[pair] + triangles >= 2:
                have.add(pair)
                join(pair)
                grown = True
            else:
                missing.append(pair)
        left = missing
    return {pair for pair in pairs if pair in have}
