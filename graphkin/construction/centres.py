"""All instant centres of a scene as a student finds them: permanent centres of the joints, Kennedy's theorem with its
circle diagram, and the other centres by the motion of the links, measured on the velocity polygon.

Velocities by centres: from the driver to every link by the shortest chain of centres, measured on the figure.

The point P_ij belongs to both links and has one velocity: omega_i * P_ij P_i0 = omega_j * P_ij P_j0, the same sense of
turning where P_i0 and P_j0 lie on one side of P_ij, the opposite where it lies between them; a point X of link j then
moves with omega_j * P_j0 X square to P_j0 X (Norton, Design of Machinery, 6.5).  The distances are measured as products
of homogeneous coordinates, so that a centre at infinity needs no rule of its own, as of links that turn alike, or
sliders.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from heapq import heappop, heappush
from itertools import combinations
from typing import Literal

from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.construction.board.projective import Line, Place, ProjectiveChart, product, wedge
from graphkin.construction.board.scales import Scales
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.plan import draft
from graphkin.construction.touching import Touching
from graphkin.plane import Pose, dot
from graphkin.scene.model import Driver, Loading, Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Structure, analyse, part_of
from graphkin.words import Phrase

LinkPair = tuple[str, str]

AT_REST = 1e-9
"""Two links whose relative motion is smaller than this part of the largest do not move relative to each other."""
MEASURED = 1e-15  # so far off a measured centre may be (on the unit sphere)
SLOW = 1e-3  # part of the largest motion below which a relative one is measured worse than that
ROUNDING = 2e-16
SURE = 1e-10
"""A crossing whose place may err by more than this (of the mechanism's size) is not taken."""
MOST_LINES = 24  # for one centre; a mechanism of many links has hundreds, and a few of them cross well
TOGETHER = 1e-9  # two centres nearer to each other (on the unit sphere) give no line


@dataclass(frozen=True)
class CentreRelation:
    """A line through a centre: through two centres with a third link, or the common normal of a pin in a slot or of a
    sliding contact.

    ``through`` names the two centres, or the pin in slot; ``error`` bounds the line's error on the unit sphere.
    """

    pair: LinkPair
    line: Line
    error: float
    through: tuple[LinkPair, LinkPair] | tuple[str]


@dataclass(frozen=True)
class Centre:
    """An instant centre.

    ``place`` is homogeneous in the chart (None where undetermined); ``point`` in mm on paper, None at infinity, where
    ``direction`` points to it; ``error`` bounds the place's error on the unit sphere.  ``number`` counts the found
    centres in order.  ``joint`` names the joint of a permanent centre, ``lines`` are the two that cross in a found one;
    ``way`` names the construction of a centre that Kennedy's theorem does not give, ``why`` is the reason for that, or
    for a missing centre.
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
    way: Literal["velocity polygon", "superposition", ""] = ""
    why: Phrase | None = None
    error: float = ROUNDING


@dataclass(frozen=True, eq=False, repr=False)
class Turning:
    """The motion of a link by centres.

    Parameters
    ----------
    strength : of the centre's homogeneous coordinates, as in `ProjectiveChart.velocity` (1/s)
    omega : angular velocity (rad/s)
    chain : the links from the driver to this one, each measured from its predecessor
    error : bound of the strength's error (1/s), since centres near each other measure badly
    """

    link: str
    strength: float
    omega: float
    chain: tuple[str, ...]
    error: float = 0.0


@dataclass(frozen=True, eq=False, repr=False)
class Centres:
    """The links of a scene on paper, and the centres of every two of them.

    Parameters
    ----------
    scene : the scene of the links; the sheet may show it at another speed of its driver
    sheet : the position drawn
    poses : the pose of every link; blocks that replace a pin in a slot are no links, a redundant link is one if turning
        pairs hold two of its points
    table : the centres by pair of links
    """

    scene: Mechanism
    sheet: Sheet
    poses: Mapping[str, Pose]
    table: Mapping[LinkPair, Centre] = field(default_factory=dict)

    def of(self, a: str, b: str) -> Centre:
        """The centre of two links, in any order.  Raises KeyError for an unknown pair."""
        return self.table[self.pair(a, b)]

    def at(self, scales: Scales) -> Centres:
        """The centres at other scales."""
        k = self.sheet.scales.length / scales.length
        table = {pair: replace(c, point=None if c.point is None else c.point * k) for pair, c in self.table.items()}
        poses = {name: pose.scaled(k) for name, pose in self.poses.items()}
        return replace(self, sheet=self.sheet.at(scales), poses=poses, table=table)

    @property
    def found(self) -> tuple[Centre, ...]:
        """The centres in the order of construction, the permanent ones first."""
        return tuple(sorted(self.table.values(), key=lambda c: c.number))

    @property
    def indeterminate(self) -> tuple[Centre, ...]:
        """The centres that Kennedy's theorem does not give."""
        return tuple(c for c in self.found if c.way or c.kind == "undetermined")

    @cached_property
    def kept(self) -> tuple[str, ...]:
        """The constraints that superposed trial motions fulfil, if the motion was found by trial: the bars or sliding
        pairs that the trial polygons leave open."""
        return tuple(dict.fromkeys(name for step in self.sheet.steps for name in step.closing))

    @property
    def mm(self) -> float:
        """The mm of paper for one m."""
        return 1.0 / self.sheet.scales.length

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The links, the frame first, then in the order of the file."""
        named = (self.scene.frame.name, *(link.name for link in self.scene.links))
        return tuple(name for name in named if name in self.poses)

    @cached_property
    def pairs(self) -> tuple[LinkPair, ...]:
        """All pairs of links, each written in the order of the file, the frame last."""
        return tuple(self.pair(a, b) for a, b in combinations(self.names, 2))

    def pair(self, a: str, b: str) -> LinkPair:
        """Two links in the order in which their centre is written."""
        order = self.scene.order
        return (a, b) if order[a] < order[b] else (b, a)

    @cached_property
    def touching(self) -> Touching:
        """The higher pairs of the links."""
        return Touching(self.scene, self.mm, self.poses)

    def point(self, name: str) -> complex:
        """A pin or a point of any link, or the point of a contact, on paper (mm)."""
        if name in self.scene.contact_at:
            return self.touching.of(self.scene.contact_at[name]).at
        holder = next(n for n in self.scene.holders[name] if n in self.poses)
        return self.poses[holder].place(self.scene.by_name[holder].points[name] * self.mm)

    @cached_property
    def chart(self) -> ProjectiveChart:
        """The chart about the middle of all points and of all links' origins."""
        spots = [self.point(p) for p, names in self.scene.holders.items() if any(n in self.poses for n in names)]
        spots += [self.poses[n].origin for n in self.names]
        xs = [z.real for z in spots]
        ys = [z.imag for z in spots]
        half = abs(complex(max(xs) - min(xs), max(ys) - min(ys))) / 2
        middle = complex(min(xs) + max(xs), min(ys) + max(ys)) / 2
        return ProjectiveChart(middle, half or self.scene.size * self.mm)

    # velocities by centres

    @cached_property
    def turning(self) -> dict[str, Turning]:
        """The motion of every link that a chain of centres reaches from a driver; a link at rest is among them.  With
        several drivers the first that moves is the start."""
        return _chained(self)

    @property
    def moving_pins(self) -> tuple[Symbol, ...]:
        """The velocities of all pins that links move."""
        frame, links = self.scene.frame, set(self.names) - {self.scene.frame.name}
        pins = (p for p, names in self.scene.holders.items() if p not in frame.points and links.intersection(names))
        return tuple(Symbol("v", PointRef(p)) for p in pins)

    def turning_of(self, ref: PointRef) -> Turning | None:
        """The motion of a point's link: of the first known link with the point."""
        holders = [ref.link] if ref.link else self.scene.holders[ref.point]
        return next((self.turning[name] for name in holders if name in self.turning), None)

    def velocity(self, symbol: Symbol) -> complex | float | None:
        """A velocity (m/s) or an angular velocity (rad/s) by centres, measured on the figure; None where no chain leads
        to it, and for other quantities."""
        if symbol.kind == "omega":
            return self.turning[symbol.link].omega if symbol.link in self.turning else None
        if symbol.kind != "v" or symbol.of is None:
            return None
        of, to = self._velocity(symbol.of), self._velocity(symbol.to) if symbol.to else 0j
        return None if of is None or to is None else of - to

    def _velocity(self, ref: PointRef) -> complex | None:
        """The velocity of a point about the centre of its link and the frame, v = omega r square to the arm (m/s); None
        where the motion of its link is not known."""
        turning, frame = self.turning_of(ref), self.scene.frame.name
        if turning is None:
            return None
        place = None if turning.link == frame else self.of(turning.link, frame).place
        if place is None or turning.strength == 0.0:
            return 0j
        return self.chart.velocity(place, turning.strength, self.point(ref.point)) / self.mm

    def velocity_error(self, symbol: Symbol) -> float:
        """The error bound of a velocity by centres (m/s, rad/s) from the rounding of the centres' places."""
        chart, frame = self.chart, self.scene.frame.name
        refs = [ref for ref in (symbol.of, symbol.to) if ref is not None]
        spots = [chart.middle + chart.unit, *(self.point(ref.point) for ref in refs)]
        reach = 1.0 + max(abs(z - chart.middle) for z in spots) / chart.unit
        whole = 0.0
        for ref in refs or [PointRef("", symbol.link)]:
            turning = self.turning_of(ref)
            if turning is not None and turning.link != frame:
                # a motion of nothing may be off by all there is, where centres fall together
                whole += turning.error + abs(turning.strength) * self.of(turning.link, frame).error
        return whole * reach * (1.0 if symbol.link else chart.unit / self.mm)


def find_centres(
    of: Mechanism | Structure, at: Mapping[str, float] | None = None, instrument: Instrument = EXACT,
    sheet: Sheet | None = None, near: Centres | None = None,
) -> Centres:
    """Find every centre of every two links on the drawing board.

    Parameters
    ----------
    of, at, instrument : a mechanism or its structure, and as for `draft`
    sheet : the scene drawn at this position already; it is used if every link is on it
    near : the centres at other driver values, from which a scene with larger groups is followed; without them the
        scene's own position is found first

    Raises
    ------
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    scene = of.scene if isinstance(of, Structure) else of
    moving = _moving(scene)
    if sheet is None or moving is not scene or not set(sheet.structure.links) <= set(sheet.poses):
        unloaded = replace(moving, loading=Loading()) if moving.loading else moving
        sheet = draft(of if unloaded is scene else unloaded, at, (), instrument, near=near.sheet if near else None)
    if any(pair.by_law for pair in scene.acting):
        scene = sheet.scene  # with the pins on pitch curves and faces, which have normals
    return _with_table(_placed(scene, sheet), instrument)


def centres_on(sheet: Sheet, asked: Sequence[Symbol], instrument: Instrument = EXACT) -> Centres:
    """The centres of the part that leads to the asked quantities, on a sheet that shows it; errors as for
    `find_centres`."""
    part = part_of(sheet.structure, asked)
    if part is not sheet.scene:
        sheet = replace(sheet, scene=part, structure=analyse(part))
    return find_centres(part, {d.key: sheet.drivers[d.key] for d in part.drivers}, instrument, sheet)


def _moving(scene: Mechanism) -> Mechanism:
    """The scene itself, or at unit speed if its single driver is at rest: centres do not depend on the speed."""
    if len(scene.drivers) != 1 or scene.drivers[0].values[1] != 0.0:
        return scene
    driver = scene.drivers[0]
    return replace(scene, drivers=(replace(driver, rate=driver.span(scene.size)),))


def _placed(scene: Mechanism, sheet: Sheet) -> Centres:
    """Links placed by the drawing, and redundant links placed by two turning pairs."""
    poses = {name: pose for name, pose in sheet.poses.items() if name in scene.by_name}
    for link in scene.links:
        if link.name in poses:
            continue
        so_far = Centres(scene, sheet, poses)
        held = [p for p in link.points if any(n in poses for n in scene.holders[p])]
        if len(held) >= 2 and link.points[held[0]] != link.points[held[1]]:
            here, there = so_far.point(held[0]), so_far.point(held[1])
            axis = (there - here) / ((link.points[held[1]] - link.points[held[0]]) * so_far.mm)
            local = link.points[held[0]] * so_far.mm
            poses = {**poses, link.name: Pose(here - axis * local, axis / abs(axis))}
    return Centres(scene, sheet, poses)


def measured(links: Centres) -> dict[str, tuple[complex, float, float]]:
    """The motion of every link in the velocity polygon: the velocity of its point in the middle of the chart (mm/s on
    paper), by one of its end points, its angular velocity (rad/s), and what this has lost where its vector was taken
    for rounding: over a short arm that may be much."""
    sheet, ground = links.sheet, links.sheet.scene.frame.name
    per_mm, ends = sheet.scales.velocity / sheet.scales.length, sheet.ends["velocity"]
    motions = {ground: (0j, 0.0, 0.0)}
    for name, rate in sheet.rates["omega"].items():
        points = sheet.structure.links[name].points
        ref = next((r for r in ends if r.link == name or (not r.link and r.point in points)), None)
        if name == ground or ref is None:
            continue
        arm = links.chart.middle - sheet.points[PointRef(ref.point)]
        read, lost = rate.vector, 0.0
        if read and rate.mm == 0.0 and rate.arm:
            tip, tail = (ends.get(point, 0j) if point else 0j for point in (read.of, read.to))
            lost = abs(tip - tail) * sheet.scales.velocity / rate.arm
        motions[name] = ends[ref] * per_mm + 1j * rate.value * arm, rate.value, lost
    return motions


# what joints give


def _permanent(links: Centres) -> Iterator[Centre]:
    """The centres that turning, sliding and rolling pairs give; k links at one hinge share k (k - 1) / 2 of them."""
    chart, poses = links.chart, links.poses
    for point, holders in links.scene.holders.items():
        for a, b in combinations([name for name in holders if name in poses], 2):
            z = links.point(point)
            yield Centre(links.pair(a, b), "permanent", chart.at(z), z, joint=point)
    for s in links.scene.slidings:
        if s.a in poses and s.b in poses:
            place = chart.towards(1j * s.along(poses))
            far = chart.direction(place)
            yield Centre(links.pair(s.a, s.b), "permanent", place, direction=far, joint=s.key)
    for touch in links.touching.rolling() if links.scene.higher_pairs else ():
        yield Centre(links.pair(*touch.links), "permanent", chart.at(touch.at), touch.at, joint=touch.name, rolls=True)


def _normals(links: Centres) -> Iterator[CentreRelation]:
    """The common normals: of a pin in a slot the line through the pin square to the slot, and those of contacts, also
    of rolling ones, whose centres are permanent."""
    scene, poses = links.scene, links.poses
    for slide in scene.slides:
        of, on = slide.bodies
        if slide.higher and of in poses and on in poses and of != on:
            along = slide.along(poses)
            at, start = links.touching.place(of, slide.pin), poses[on].place(slide.guide.through * links.mm)
            line = links.chart.line(start + along * dot(at - start, along), 1j * along)
            yield CentreRelation(links.pair(of, on), line, ROUNDING, (slide.key,))
    for _, touch in links.touching.contacts() if scene.higher_pairs else ():
        line = links.chart.line(touch.at, touch.normal)
        yield CentreRelation(links.pair(*touch.links), line, ROUNDING, (touch.name,))


# Kennedy's theorem


class CircleDiagram:
    """The circle diagram while it is filled, at first with the common normals alone.

    links : the links of the centres
    normals : the number of common normals of each pair
    table : the centres so far, in their order
    lines : the known lines of each missing centre
    best : the crossing of two of them with the least error
    order : the index of each pair in the order of links
    ranked : of sure crossings the error in powers of ten and the pair's index, the least first; those in the table are
        skipped
    joined : by link the links of centres with it that closed triangles of the circle diagram can give in turn, if no
        two lines coincide
    reached : these centres
    placed : by link the centres of known place with others, and the places
    """

    def __init__(self, links: Centres, normals: Sequence[CentreRelation]) -> None:
        self.links, self.normals = links, Counter(line.pair for line in normals)
        self.table: dict[LinkPair, Centre] = {}
        self.lines: dict[LinkPair, list[CentreRelation]] = {pair: [] for pair in links.pairs}
        self.best: dict[LinkPair, Centre] = {}
        self.order = {pair: k for k, pair in enumerate(links.pairs)}
        self.ranked: list[tuple[int, int, LinkPair]] = []
        self.placed: dict[str, dict[str, tuple[Centre, Place]]] = {name: {} for name in links.names}
        self.joined: dict[str, set[str]] = {name: set() for name in links.names}
        for line in normals:
            self.draw(line)
        self.reached = self.reached_with([p for p in links.pairs if self.normals[p] >= 2], self.joined)

    def take(self, centre: Centre) -> None:
        """Add a centre, and all lines that it completes."""
        self.table[centre.pair] = centre
        if centre.place is None:
            return
        if centre.pair not in self.reached:
            self.reached |= self.reached_with([centre.pair], self.joined)
        both = (centre.pair, centre.pair[::-1])
        for a, b in both:
            self.placed[a][b] = centre, centre.place
        for a, b in both:
            # the triangles a, b, via: the side from a to via is missing
            missing = self.placed[b].keys() - self.placed[a].keys() - {a}
            for via in [name for name in self.links.names if name in missing]:
                other, place = self.placed[b][via]
                pair = self.links.pair(a, via)
                if len(self.lines[pair]) == MOST_LINES:
                    continue
                line, sine = wedge(centre.place, place)
                if sine > TOGETHER:
                    ends = (centre.pair, other.pair) if pair[0] in centre.pair else (other.pair, centre.pair)
                    error = (centre.error + other.error + ROUNDING) / sine
                    self.draw(CentreRelation(pair, line, error, ends))

    def draw(self, relation: CentreRelation) -> None:
        """Add a line for a missing centre: it crosses the drawn ones."""
        pair, lines = relation.pair, self.lines[relation.pair]
        for other in lines:
            error = other.error + relation.error + ROUNDING
            least = self.best[pair].error if pair in self.best else math.inf
            if error >= least:
                continue  # however well they cross
            place, sine = wedge(other.line, relation.line)
            if sine == 0.0 or error / sine >= least:
                continue
            if place[2] < 0.0:
                place = -place[0], -place[1], -place[2]
            self.best[pair] = Centre(pair, "found", place, lines=(other, relation), error=error / sine)
            if error / sine <= SURE:
                heappush(self.ranked, (math.ceil(math.log10(error / sine)), self.order[pair], pair))
        lines.append(relation)

    def crossing(self) -> Centre | None:
        """The missing centre with the best crossing: the least expected error, counted in powers of ten, and among
        equal ones the first in the order of the links.  None where no two lines cross with an error of at most ``SURE``
        (on the unit sphere)."""
        while self.ranked and self.ranked[0][2] in self.table:
            heappop(self.ranked)
        return self.best[self.ranked[0][2]] if self.ranked else None

    def reached_with(self, fresh: list[LinkPair], joined: dict[str, set[str]]) -> set[LinkPair]:
        """The pairs ``fresh``, and those that triangles give with them and with all ``joined`` ones, to which they are
        added."""
        have: set[LinkPair] = set()
        while fresh:
            pair = fresh.pop()
            have.add(pair)
            for a, b in (pair, pair[::-1]):
                joined[a].add(b)
                for via in joined[b]:
                    if via != a and via not in joined[a]:
                        missing = self.links.pair(a, via)
                        if self.normals[missing] + len(joined[a] & joined[via]) >= 2 and missing not in have:
                            fresh.append(missing)
                            have.add(missing)
        return have

    def to_measure(self, motions: Collection[str]) -> LinkPair:
        """The missing centre that gives most others; of links with measured motion first, then of the frame."""
        frame = self.links.scene.frame.name

        def gain(pair: LinkPair) -> tuple[bool, int, bool]:
            joined = {name: set(others) for name, others in self.joined.items()}
            more = 0 if pair in self.reached else len(self.reached_with([pair], joined))
            return pair[0] in motions and pair[1] in motions, more, frame in pair

        missing = [pair for pair in self.links.pairs if pair not in self.table]
        sought = [pair for pair in missing if pair not in self.reached]
        # those that the triangles reach, if not surely, give no more than the triangles do: the first of the best
        # is enough, which saves the work of a power of the number of links
        within = [pair for pair in missing if pair[0] in motions and pair[1] in motions] or missing
        of_frame = [pair for pair in within if frame in pair]
        return max([*sought, (of_frame or within)[0]], key=gain)


def _with_table(links: Centres, instrument: Instrument) -> Centres:
    """The centres of links on paper."""
    normals, motions, chart = list(_normals(links)), measured(links), links.chart
    diagram = CircleDiagram(links, normals)
    for centre in _permanent(links):
        if centre.pair not in diagram.table:
            diagram.take(centre)
    largest = max((abs(chart.pole(v, omega)[1]) for v, omega, _ in motions.values()), default=0.0)
    number = 0
    while len(diagram.table) < len(links.pairs):
        number += 1
        centre = diagram.crossing() or _otherwise(diagram, motions, largest)
        if centre.place is not None:
            point, place = chart.point(centre.place), centre.place
            if point is not None and centre.lines and not instrument.faultless:
                point = instrument.point(point)
                place = chart.at(point)
            direction = chart.direction(place) if point is None else None
            centre = replace(centre, place=place, point=point, direction=direction)
        diagram.take(replace(centre, number=number))
    return replace(links, table={pair: diagram.table[pair] for pair in links.pairs})


def _otherwise(
    diagram: CircleDiagram, motions: Mapping[str, tuple[complex, float, float]], largest: float
) -> Centre:
    """A centre that Kennedy's theorem does not give now: where two links have the same velocity, by their `measured`
    motions; these may differ by nothing beside the ``largest``."""
    pair = diagram.to_measure(motions)
    # too few triangles, or lines that fall together
    count = len(diagram.lines[pair])
    links = {"first": pair[0], "second": pair[1]}
    few, together = Phrase("centre few lines", **links, lines=count), Phrase("centre lines together", **links)
    why = few if count < 2 else together
    if not motions.keys() >= {*pair}:
        return Centre(pair, "undetermined", why=why)
    (velocity, omega, lost), (other_velocity, other_omega, other_lost) = motions[pair[0]], motions[pair[1]]
    place, strength = diagram.links.chart.pole(velocity - other_velocity, omega - other_omega)
    if abs(strength) <= AT_REST * largest:
        return Centre(pair, "undetermined", why=Phrase("centre no motion", **links))
    error = MEASURED * max(1.0, SLOW * largest / abs(strength)) + (lost + other_lost) / abs(strength)
    method: Literal["superposition", "velocity polygon"] = "superposition" if diagram.links.kept else "velocity polygon"
    return Centre(pair, "found", place, way=method, why=why, error=error)


# velocities by centres


CERTAIN = 1e-6  # of the driver's own: a link whose motion may err by more waits for a longer chain that gives it better


def _chained(centres: Centres) -> dict[str, Turning]:
    """The motion of every link from the links before it, the shortest chains first; from one translating link to
    another, whose common centre lies at infinity too, only where no other chain leads there."""
    frame = centres.scene.frame.name
    moving = [d for d in centres.scene.drivers if d.values[1] != 0.0]
    if not moving:
        return {name: Turning(name, 0.0, 0.0, (name,)) for name in centres.names}
    turnings = {frame: Turning(frame, 0.0, 0.0, (frame,)), **_driven(centres, moving[0])}
    steps = max(len(t.chain) for t in turnings.values())
    largest = CERTAIN * max(abs(t.strength) for t in turnings.values())
    while len(turnings) < len(centres.names):
        fresh: dict[str, Turning] = {}
        last = steps > len(centres.names)  # no further chain gives anything better
        known = [t for t in turnings.values() if t.link != frame and (last or len(t.chain) == steps)]
        for name in (name for name in centres.names if name not in turnings):
            # from one link to the next by their common centre
            threes = [(centres.of(t.link, frame), centres.of(name, t.link), centres.of(name, frame)) for t in known]
            chains = [_carried(t, *three, (*t.chain, name)) for t, three in zip(known, threes, strict=True)
                      if last or any(centre.point is not None for centre in three)]
            best = min((t for t in chains if t is not None), key=lambda turning: turning.error, default=None)
            if best is not None and (last or best.error <= max(largest, CERTAIN * abs(best.strength))):
                fresh[name] = best
        if not fresh and last:
            break
        turnings.update(fresh)
        steps += 1
    return turnings


def _driven(centres: Centres, driver: Driver) -> dict[str, Turning]:
    """The links that the driver's own pair moves, from its rate: turning about their common centre, or sliding."""
    chart, structure, frame = centres.chart, centres.sheet.structure, centres.scene.frame.name
    slide = None if driver.turns else structure.slide(driver.key)
    a, b = driver.links if slide is None else (slide.body, slide.b)
    centre = centres.of(a, b)
    if centre.place is None:
        return {}
    once, reach = centre.place[2], 1.0
    if slide is not None:
        at = centres.point(slide.pin) if slide.higher else chart.middle
        along = slide.along(centres.poses)
        once = dot(chart.velocity(centre.place, 1.0, at), along) / centres.mm
        reach = (abs(at - chart.middle) + chart.unit) / centres.mm
    if once == 0.0:
        return {}
    strength = driver.values[1] / once
    first = Turning(a, strength, strength * centre.place[2], (a,), abs(strength / once) * centre.error * reach)
    if b == frame:
        return {a: first}
    back = Turning(b, -first.strength, -first.omega, (b,), first.error)
    if a == frame:
        return {b: back}
    # two moving links: the difference of their motions is known
    carried = (_carried(turning, centre, centres.of(other, frame), centres.of(turning.link, frame), turning.chain)
             for turning, other in ((first, b), (back, a)))
    return {turning.link: turning for turning in carried if turning is not None}


def _carried(
    turning: Turning, known: Centre, common: Centre, wanted: Centre, chain: tuple[str, ...]
) -> Turning | None:
    """From a motion about ``known`` the motion about ``wanted``, three centres on a line, with the motion about
    ``common`` as their difference; None where a centre is missing, or the last two coincide.

    k * known - m * wanted is a multiple of common: k (known x common) = m (wanted x common).
    """
    if known.place is None or common.place is None or wanted.place is None:
        return None
    line, parting = wedge(wanted.place, common.place)
    over, sine = wedge(known.place, common.place)
    if parting == 0.0:
        return None
    ratio = product(over, line) * sine / parting
    error_of_ratio = (known.error + common.error + 2 * (sine / parting) * (wanted.error + common.error)) / parting
    strength, error = turning.strength * ratio, turning.error * abs(ratio) + abs(turning.strength) * error_of_ratio
    return Turning(chain[-1], strength, strength * wanted.place[2], chain, error)
