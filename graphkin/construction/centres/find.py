"""All instant centres of a scene as a student finds them: the permanent ones, Kennedy's theorem, and what remains.

The motion of a link is measured on the velocity polygon; where two links have one velocity is their centre.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from graphkin.construction.centres.kennedy import CentreRelation, CrossedCentre, Known, Search, closure
from graphkin.construction.centres.pairs import (
    LinkPair,
    Links,
    Normal,
    Place,
    ProjectiveChart,
    links_on_paper,
    normals,
    permanent,
)
from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.links_on_paper import LinkMotion
from graphkin.construction.plan import draft
from graphkin.construction.room import Room, scales_for
from graphkin.construction.sheet import Sheet
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Structure, analyse, part_of
from graphkin.words import Phrase

__all__ = ["Centre", "Centres", "Worked", "centres_on", "find_centres", "work"]

AT_REST = 1e-9
"""Two links whose relative motion is smaller than this part of the largest do not move relative to each other."""


MEASURED = 1e-15  # so far off a measured centre may be (on the unit sphere)
SLOW = 1e-3  # part of the largest motion below which a relative one is measured worse than that


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


def work(
    of: Mechanism | Structure,
    at: Mapping[str, float] | None = None,
    instrument: Instrument = EXACT,
    near: Sheet | None = None,
) -> Worked:
    """Draw everything of a scene and measure how it moves; parameters and exceptions are those of `draft`."""
    return worked(draft(of, at, (), instrument, near=near))


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

    def in_room(self, room: Room) -> Centres:
        """The same centres on a figure that fills a room."""
        scales = scales_for(self.sheet, room)
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


def find_centres(
    of: Mechanism | Structure, at: Mapping[str, float] | None = None, instrument: Instrument = EXACT,
    sheet: Sheet | None = None, near: Centres | None = None,
) -> Centres:  # fmt: skip
    """Find every centre of every two links on the drawing board.

    Parameters
    ----------
    of, at, instrument : a mechanism or its structure, and as for `draft`
    sheet : the scene drawn at this position already; it is used if every link stands on it
    near : the centres at other driver values, from which a scene with larger groups is followed; without them the
        scene's own position is found first

    Raises
    ------
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    scene = of.scene if isinstance(of, Structure) else of
    moving = _moving(scene)
    if sheet is not None and moving is scene and set(sheet.structure.links) <= set(sheet.poses):
        found = worked(sheet)
    else:
        found = work(of if moving is scene else moving, at, instrument, near.sheet if near is not None else None)
    if scene.cams and scene.instead_of is None:
        scene = found.sheet.scene  # with the pins on pitch curves and faces, which have normals
    links = links_on_paper(scene, 1.0 / found.sheet.scales.length, found.sheet.poses)
    chart = links.chart()
    table, slots = _search(links, chart, found.motions, instrument, found.way)
    return Centres(found.sheet, links, chart, table, slots, found.motions, found.kept)


def centres_on(sheet: Sheet, asked: Sequence[Symbol], instrument: Instrument = EXACT) -> Centres:
    """The centres of what leads to the asked, on a sheet that shows it; errors as for `find_centres`."""
    part = part_of(sheet.structure, asked)
    if part is not sheet.scene:
        sheet = replace(sheet, scene=part, structure=analyse(part))
    return find_centres(part, {d.key: sheet.drivers[d.key] for d in part.drivers}, instrument, sheet)


def _moving(scene: Mechanism) -> Mechanism:
    """The scene itself, or at unit speed where its one driver stands still: centres do not depend on the speed."""
    if len(scene.drivers) != 1 or scene.drivers[0].values[1] != 0.0:
        return scene
    driver = scene.drivers[0]
    if isinstance(driver, AngleDriver):
        return replace(scene, drivers=(replace(driver, omega=1.0),))
    return replace(scene, drivers=(replace(driver, velocity=scene.size),))


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
