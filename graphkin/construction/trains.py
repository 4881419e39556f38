"""The velocity plan of a train of wheels: one line of velocities a link over its line of centres, rates read off a rate
scale; and the same of tangential accelerations.

What rolls keeps its rates when the carrier of its axes is bent or straightened, as long as no distance of two axes that
it holds changes.  So all axes of a train are laid on one line as far as that goes; a pair of wheels whose axes stand on
a line already, but not so far apart, gets a line of its own.

The velocity of a link's places grows along its line in proportion to the height, so two known places, or one and a
known rate, give its line; where links touch, two lines meet.  Lines drawn parallel through a pole mark off the angular
rates.  Where neither is known, a rate is assumed and found by proportion from what is left open.
Sources: K. Kutzbach, Mehrgliedrige Radgetriebe und ihre Gesetze, Maschinenbau 6 (1927); VDI 2157.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.proportional_division import divide
from graphkin.construction.scales import Extent, fitting_scale
from graphkin.construction.steps import Order, PlanTrial, Step
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, dot, unit
from graphkin.scene.model import PlacedLink
from graphkin.structure import Mesh, Structure, meshes_of
from graphkin.structure.model import Coordinate
from graphkin.words import Phrase

__all__ = [
    "CentreLine", "PlanLine", "PlanScales", "Spot", "TrainPlan", "Wheels", "centre_lines", "train_plan",
]  # fmt: skip

ALIKE = 1e-9  # of a length: heights that are one
WIDE, HIGH = 62.0, 100.0
"""mm that velocities and heights may take on paper."""
FOOT = 80.0
"""mm that the rates may take on the rate scale."""
POLE = 30.0
"""mm from the pole to the rate scale, where that shows the rates; less where they are far apart."""
MOST_ASSUMED = 4
Travel = Callable[[str], float | None]
Turned = tuple[str, str, float]
"""Two links and the given rate of the first from the second (rad/s, rad/s2): 0 where one slides on the other."""


# -- lines of centres --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Spot:
    """A place of a line of centres at which some links have one velocity: an axis by its point, or where two roll on
    each other by the name of that pair.  ``height`` in m."""

    name: str
    height: float
    links: tuple[str, ...]
    rolls: bool


@dataclass(frozen=True)
class CentreLine:
    """Pairs that roll, with their axes on one line.

    ``still`` is the place that velocities are counted from: it belongs to the frame, or else they are those relative
    to that axis.
    """

    meshes: tuple[Mesh, ...]
    spots: tuple[Spot, ...]
    still: str
    in_frame: bool

    @property
    def links(self) -> tuple[str, ...]:
        """Links with a line in the plan, in the order of the pairs."""
        return tuple(dict.fromkeys(name for mesh in self.meshes for name in mesh.links))

    def spots_of(self, link: str) -> tuple[Spot, ...]:
        """The places of a link, from below."""
        return tuple(sorted((s for s in self.spots if link in s.links), key=lambda s: s.height))

    def spot(self, name: str) -> Spot:
        """A place by its name."""
        return next(s for s in self.spots if s.name == name)


def trains(meshes: Sequence[Mesh], ground: str) -> tuple[tuple[Mesh, ...], ...]:
    """Pairs that hang together by links that move."""
    groups: list[tuple[set[str], list[Mesh]]] = []
    for mesh in meshes:
        links, members = set(mesh.links) - {ground}, [mesh]
        for other in [g for g in groups if g[0] & links]:
            groups.remove(other)
            links |= other[0]
            members = other[1] + members
        groups.append((links, members))
    return tuple(tuple(members) for _, members in groups)


def centre_lines(train: Iterable[Mesh], links: Mapping[str, PlacedLink], ground: str) -> tuple[CentreLine, ...]:
    """The lines on which the axes of a train are laid.

    Parameters
    ----------
    train : pairs that roll
    links : with the points of the carriers in their own axes (m)
    ground : the frame's name
    """
    made: list[tuple[dict[str, float], list[Mesh]]] = []
    left = list(train)
    while left:
        # the train is followed from pair to pair, so that a line reaches as far as it can
        mesh = next((m for m in left if made and any(p in made[-1][0] for p in m.axes)), left[0])
        left.remove(mesh)
        for heights, members in made:
            if any(p in heights for p in mesh.axes) and _laid(mesh, heights, members, links):
                members.append(mesh)
                break
        else:
            fixed = [p for p in mesh.axes if p in links[ground].points]
            heights = {(*fixed, mesh.axes[0])[0]: 0.0}
            _laid(mesh, heights, [], links)
            made.append((heights, [mesh]))
    return tuple(_line(members, heights, links, ground) for heights, members in made)


def _apart(mesh: Mesh, links: Mapping[str, PlacedLink]) -> float:
    held = links[mesh.carrier].points
    return abs(held[mesh.axes[1]] - held[mesh.axes[0]])


def _laid(
    mesh: Mesh, heights: dict[str, float], members: Sequence[Mesh], links: Mapping[str, PlacedLink]
) -> bool:
    """Lay a pair's axes on a line where they fit; False where they stand there at other distances."""
    one, two = mesh.axes
    if not two:
        return one in heights
    far = _apart(mesh, links)
    if one in heights and two in heights:
        return abs(abs(heights[two] - heights[one]) - far) <= ALIKE * far
    known, new = (one, two) if one in heights else (two, one)
    held = links[mesh.carrier].points
    way = 1.0
    others = [p for p in heights if p != known and p in held and held[p] != held[known]]
    if others:
        # a carrier that is straight stays so
        near = others[0]
        up = held[near] - held[known]
        sense = 1.0 if heights[near] > heights[known] else -1.0
        along = dot(held[new] - held[known], up) / abs(up)
        straight = abs(cross(held[new] - held[known], up)) <= ALIKE * abs(up) * far
        way = sense * (1.0 if along > 0 else -1.0) if straight else -sense
    elif members:
        near_height = next((h for p, h in heights.items() if p != known and h != heights[known]), None)
        way = -1.0 if near_height is not None and near_height > heights[known] else 1.0
    heights[new] = heights[known] + way * far
    return True


def _line(
    members: Sequence[Mesh], heights: Mapping[str, float], links: Mapping[str, PlacedLink], ground: str
) -> CentreLine:
    at: dict[str, dict[str, None]] = {}
    spots = []
    for mesh in members:
        one, two = mesh.axes
        at.setdefault(one, {}).update(dict.fromkeys((mesh.wheels[0], mesh.carrier)))
        part, rest = mesh.parts
        if rest is None:
            height = heights[one] + float(part)
        else:
            at.setdefault(two, {}).update(dict.fromkeys((mesh.wheels[1], mesh.carrier)))
            height = heights[one] + (heights[two] - heights[one]) * float(part / (part + rest))
        spots.append(Spot(mesh.name, height, mesh.wheels, True))
    axes = [Spot(p, heights[p], tuple(names), False) for p, names in at.items()]
    every = (*axes, *spots)
    fixed = [s for s in every if ground in s.links]
    if not fixed:
        fixed = [s for s in axes if s.name in links[ground].points]
    start = fixed[0] if fixed else axes[0]
    return CentreLine(tuple(members), every, start.name, bool(fixed))


# -- a plan as drawn ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class PlanScales:
    """What 1 mm of a plan is: m, m/s (m/s2), rad/s (rad/s2); and how far the pole stands from the rate scale (mm)."""

    length: float
    speed: float
    rate: float

    @property
    def pole(self) -> float:
        return self.speed / self.length / self.rate


@dataclass(frozen=True)
class PlanLine:
    """The line of a link over the line of centres ``on`` (its number).

    by : the names of the places that give it: two, or one and the rate (``rate_known``); of a link that slides along
        ``beside`` the line is parallel to that one's
    ends : its lowest and its highest place (mm; velocity to the right, height upwards)
    foot : what it marks off on the rate scale, as read (mm), counter-clockwise to the right
    rate : what that says (rad/s, rad/s2)
    """

    link: str
    on: int
    by: tuple[str, ...]
    rate_known: bool
    ends: tuple[complex, complex]
    foot: float
    rate: float
    beside: str = ""
    trial: bool = False


@dataclass(frozen=True)
class TrainPlan:
    """A plan as drawn.  ``velocities`` (mm) are those of the places, by line of centres and place; ``travels`` of the
    racks (m/s, m/s2) by sliding pair, with the length read (mm)."""

    order: str
    scales: PlanScales
    on: tuple[CentreLine, ...]
    lines: tuple[PlanLine, ...]
    velocities: Mapping[tuple[int, str], float]
    travels: Mapping[str, tuple[float, float]]
    trial: PlanTrial | None = None

    def line(self, link: str) -> PlanLine | None:
        """The line of a link from which its rate is read, else its first."""
        own = [one for one in self.lines if one.link == link]
        return next((one for one in own if not one.rate_known), own[0] if own else None)


# -- how it is drawn ---------------------------------------------------------------------------------------------------


@dataclass
class _Drawing:
    """A plan as it grows."""

    on: Sequence[CentreLine]
    scales: PlanScales
    rates: dict[str, float]
    travel: Travel
    turns: Sequence[Turned]
    ground: str
    hand: Instrument
    speeds: dict[tuple[int, str], float] = field(default_factory=dict)
    lines: dict[tuple[int, str], PlanLine] = field(default_factory=dict)
    travels: dict[str, tuple[float, float]] = field(default_factory=dict)
    gaps: list[float] = field(default_factory=list)
    assumed: set[str] = field(default_factory=set)

    def begin(self) -> None:
        self.rates[self.ground] = 0.0
        for i, line in enumerate(self.on):
            self.speeds[i, line.still] = 0.0

    def go_on(self) -> None:
        """Draw every line that what stands there gives."""
        grown = True
        while grown:
            grown = False
            for one, other, value in self.turns:
                grown |= self._turned(one, other, value) or self._turned(other, one, -value)
            for i, line in enumerate(self.on):
                for mesh in line.meshes:
                    grown |= self._slides(i, mesh) if mesh.parts[1] is None else False
                for link in line.links:
                    grown |= (i, link) not in self.lines and self._line(i, link)

    def _turned(self, one: str, other: str, value: float) -> bool:
        if other not in self.rates or one in self.rates:
            return False
        self.rates[one] = self.rates[other] + value
        return True

    def _mm(self, spot: Spot) -> float:
        return spot.height / self.scales.length

    def _line(self, i: int, link: str) -> bool:
        spots = self.on[i].spots_of(link)
        known = [s for s in spots if (i, s.name) in self.speeds]
        if not known:
            return False
        if link in self.rates:
            start = min(known, key=lambda s: (s.name != self.on[i].still, s.rolls))
            slope = -self.rates[link] * self.scales.length / self.scales.speed
            by: tuple[str, ...] = (start.name,)
            given = True
        else:
            low, high = known[0], known[-1]
            if high.height == low.height:
                return False
            run = self.speeds[i, high.name] - self.speeds[i, low.name]
            slope = run / (self._mm(high) - self._mm(low))
            start, by, given = low, (low.name, high.name), False
        x, y = self.speeds[i, start.name], self._mm(start)
        for spot in spots:
            at = x + slope * (self._mm(spot) - y)
            if spot.name not in by:
                at = self.hand.point(complex(at, self._mm(spot))).real
            if (i, spot.name) not in self.speeds:
                self.speeds[i, spot.name] = at
            elif spot.name not in by:
                self.gaps.append(at - self.speeds[i, spot.name])
        foot, rate = self._read(link, slope, given)
        reach = [self._mm(s) for s in spots]
        if len(reach) == 1:
            reach += [0.0] if reach[0] else [0.25 * HIGH]
        ends = [complex(x + slope * (h - y), h) for h in (min(reach), max(reach))]
        beside = next((m.carrier if link == m.wheels[1] else m.wheels[1] for m in self.on[i].meshes
                       if m.parts[1] is None and link in (m.carrier, m.wheels[1])), "")  # fmt: skip
        self.lines[i, link] = PlanLine(
            link, i, by, given, (ends[0], ends[1]), foot, rate, beside if given else "", link in self.assumed
        )
        if link not in self.rates:
            self.rates[link] = rate
        return True

    def _read(self, link: str, slope: float, given: bool) -> tuple[float, float]:
        if given:
            return -slope * self.scales.pole, self.rates[link]
        along = self.hand.direction(unit(complex(slope, 1.0)))
        foot = -along.real / along.imag * self.scales.pole
        read = self.hand.read(abs(foot))
        foot = read if foot >= 0 else -read
        return foot, foot * self.scales.rate

    def _slides(self, i: int, mesh: Mesh) -> bool:
        """The lines of a rack and of what it slides along stand as far apart as it is fast."""
        carrier = mesh.carrier
        if carrier not in self.rates:
            return False
        axis, pitch = self.on[i].spot(mesh.axes[0]), self.on[i].spot(mesh.name)
        lean = -self.rates[carrier] * self.scales.length / self.scales.speed * (self._mm(pitch) - self._mm(axis))
        ends = self.speeds.get((i, axis.name)), self.speeds.get((i, pitch.name))
        given = self.travel(mesh.slide)
        if given is not None:
            run = mesh.sense * given / self.scales.speed
            if ends[0] is not None and ends[1] is None:
                self.speeds[i, pitch.name] = ends[0] + lean + self.hand.length(run)
                return True
            if ends[1] is not None and ends[0] is None:
                self.speeds[i, axis.name] = ends[1] - lean - self.hand.length(run)
                return True
        elif mesh.slide not in self.travels and ends[0] is not None and ends[1] is not None:
            run = ends[1] - ends[0] - lean
            read = self.hand.read(abs(run)) * (1 if run >= 0 else -1)
            self.travels[mesh.slide] = mesh.sense * read * self.scales.speed, read
            return True
        return False

    def open_links(self) -> list[str]:
        """Links of which a rate may be assumed: one place of theirs is known."""
        return [
            link for i, line in enumerate(self.on) for link in line.links
            if link not in self.rates and any((i, s.name) in self.speeds for s in line.spots_of(link))
        ]  # fmt: skip

    def has(self, links: Sequence[str], slides: Sequence[str]) -> bool:
        return all(n in self.rates for n in links) and all(
            key in self.travels or self.travel(key) is not None for key in slides
        )


@dataclass(frozen=True)
class _Given:
    """What a plan begins with."""

    on: Sequence[CentreLine]
    rates: Mapping[str, float]
    travel: Travel
    turns: Sequence[Turned]
    ground: str
    wanted: tuple[Sequence[str], Sequence[str]]

    def drawn(self, scales: PlanScales, hand: Instrument, assumed: Mapping[str, float]) -> _Drawing:
        """What follows, with rates assumed one after the other."""
        made = _Drawing(self.on, scales, dict(self.rates), self.travel, self.turns, self.ground, hand)
        made.begin()
        made.go_on()
        for link, rate in assumed.items():
            made.rates[link] = rate
            made.assumed.add(link)
            made.go_on()
        # what two links that slide on each other or that a driver turns leave open, on the rate scale
        made.gaps += [(made.rates[a] - made.rates[b] - value) / scales.rate
                      for a, b, value in self.turns if a in made.rates and b in made.rates]  # fmt: skip
        return made

    @property
    def fastest(self) -> float:
        return max((abs(r) for r in self.rates.values()), default=0.0) or 1.0

    def trials(self, names: Sequence[str]) -> list[dict[str, float]]:
        """The assumptions of each trial: none turns in the first, then each in turn."""
        first = dict.fromkeys(names, 0.0)
        return [first, *({**first, own: self.fastest} for own in names)]

    def closes(self, scales: PlanScales, names: Sequence[str]) -> bool:
        """Whether what the trials leave open finds the rates assumed, and these what is wanted."""
        made = [self.drawn(scales, EXACT, one) for one in self.trials(names)]
        slopes = np.array([one.gaps for one in made[1:]]) - np.array(made[0].gaps)
        most = float(np.abs(slopes).max(initial=0.0))
        found = most > 0.0 and np.linalg.matrix_rank(slopes, 1e-9 * most) == len(names)
        return bool(found) and made[0].has(*self.wanted)

    def to_assume(self, scales: PlanScales) -> list[str] | None:
        """Links whose rates have to be assumed; None where none lead to what is wanted."""
        names: list[str] = []
        for _ in range(MOST_ASSUMED):
            free = self.drawn(scales, EXACT, dict.fromkeys(names, 0.0)).open_links()
            for one in dict.fromkeys(free):
                if self.closes(scales, [*names, one]):
                    return [*names, one]
            if not free:
                return None
            names.append(free[0])
        return None


def train_plan(
    order: str, on: Sequence[CentreLine], rates: Mapping[str, float], travel: Travel, turns: Sequence[Turned],
    ground: str, wanted: tuple[Sequence[str], Sequence[str]], units: float, hand: Instrument = EXACT,
) -> TrainPlan | None:  # fmt: skip
    """Draw a plan; None where it does not lead to what is wanted.

    Parameters
    ----------
    order : "velocity" or "acceleration"
    on : the lines of centres
    rates : known rates by link (rad/s, rad/s2)
    travel : the known speed (m/s, m/s2) of a sliding pair, None where it is not known
    turns : links that turn from one another at given rates
    ground : the frame's name
    wanted : links whose rates, sliding pairs whose speeds are to be found
    units : m of the length unit, for the scales
    hand : what draws and reads
    """
    given, natural = _Given(on, rates, travel, turns, ground, wanted), PlanScales(1.0, 1.0, 1.0)
    rough = given.drawn(natural, EXACT, {})
    names: list[str] | None = []
    if not rough.has(*wanted):
        names = given.to_assume(natural)
        if names is None:
            return None
        rough, _ = _by_trial(given, natural, EXACT, names)
    if not any((*rough.rates.values(), *rough.speeds.values())):
        hand = EXACT  # every line lies on that of the centres: there is nothing to draw
    scales = _scales(rough, units)
    drawing, trial = _by_trial(given, scales, hand, names) if names else (given.drawn(scales, hand, {}), None)
    lines = tuple(drawing.lines.values())
    return TrainPlan(order, scales, tuple(on), lines, drawing.speeds, drawing.travels, trial)


def _by_trial(
    given: _Given, scales: PlanScales, hand: Instrument, names: Sequence[str]
) -> tuple[_Drawing, PlanTrial]:
    """A plan in which some rates are found by proportion from trials."""
    trials = given.trials(names)
    gaps = [given.drawn(scales, hand, one).gaps for one in trials]
    found = tuple(map(float, divide([[*one.values()] for one in trials], gaps)))
    apart = tuple(tuple(map(float, row)) for row in gaps)
    told = PlanTrial(tuple(names), tuple(tuple(one.values()) for one in trials), apart, found)
    return given.drawn(scales, hand, dict(zip(names, found, strict=True))), told


def _scales(rough: _Drawing, units: float) -> PlanScales:
    """The finest of the series at which the widest line of centres fits, and a rate scale that shows all rates."""
    high = max(max(h) - min(h) for h in ([s.height for s in line.spots] for line in rough.on))
    speeds = [[0.0, *(v for (j, _), v in rough.speeds.items() if j == i)] for i in range(len(rough.on))]
    wide = max(max(v) - min(v) for v in speeds)
    length = fitting_scale(Extent(0.0, high), (1.0, HIGH), 1.0 / units) * units
    speed = fitting_scale(Extent(wide, 0.0), (WIDE, 1.0), 1.0 / units) * units
    turns = [0.0, *(line.rate for line in rough.lines.values())]
    fits = fitting_scale(Extent(max(turns) - min(turns), 0.0), (FOOT, 1.0), 1.0)
    tall = fitting_scale(Extent(speed / length, 0.0), (POLE, 1.0), 1.0)
    return PlanScales(length, speed, max(fits, tall) if wide else 1.0)


# -- the trains of a mechanism -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Wheels:
    """The trains of a mechanism on their lines of centres, and the plans drawn of them so far."""

    structure: Structure
    on: tuple[tuple[CentreLine, ...], ...]
    drawn: Mapping[tuple[Order, int], TrainPlan]

    @classmethod
    def of(cls, structure: Structure) -> Wheels:
        scene, links = structure.scene, structure.links
        here = [g for g in scene.gears if {*g.wheels, g.carrier} <= links.keys()]
        touching = [c for c in scene.contacts if {*c.links} <= links.keys()]
        meshes = meshes_of(scene, touching, here, links)
        if not meshes:
            return cls(structure, (), {})
        ground = scene.frame.name
        return cls(structure, tuple(centre_lines(one, links, ground) for one in trains(meshes, ground)), {})

    def found(
        self, order: Order, coordinate: Coordinate, rates: Mapping[str, float], travel: Travel, turns: list[Turned],
        hand: Instrument,
    ) -> tuple[Wheels, float, float]:  # fmt: skip
        """These wheels with the plan that leads to a rate (rad/s, rad/s2) or the speed of a slide (m/s, m/s2), that
        value, and the length read for it (mm).

        Raises
        ------
        Unsolvable : "not drawn": no plan leads to it
        """
        kind, name = coordinate
        alike = self._alike(name) if kind == "angle" else {name}
        for k, on in enumerate(self.on):
            own = {n for line in on for n in line.links}
            slides = {m.slide for line in on for m in line.meshes}
            inside = sorted(alike & (own if kind == "angle" else slides), key=lambda n: n != name)
            if not inside:
                continue
            plan = self.drawn.get((order, k))
            wanted: tuple[list[str], list[str]] = (inside[:1], []) if kind == "angle" else ([], inside[:1])
            if plan is None or not _leads(plan, wanted):
                units = self.structure.scene.units.rates.metres
                ground = self.structure.scene.frame.name
                plan = train_plan(order, on, rates, travel, turns, ground, wanted, units, hand)
                if plan is None:
                    continue
            made = replace(self, drawn={**self.drawn, (order, k): plan})
            if kind == "travel":
                value, mm = plan.travels[inside[0]]
                return made, value, abs(mm)
            line = plan.line(inside[0])
            assert line is not None
            return made, line.rate, abs(line.foot)
        raise Unsolvable(
            "not drawn", Problem(Phrase("link of name", name=name), Phrase("no velocity plan leads to what rolls here"))
        )

    def _alike(self, name: str) -> set[str]:
        """Links that turn as one does, because they slide on each other."""
        alike, grown = {name}, True
        while grown:
            more = {n for s in self.structure.slides if {s.a, s.b} & alike for n in (s.a, s.b)} - alike
            alike, grown = alike | more, bool(more)
        return alike

    def steps(self, before: Wheels, order: Order) -> Iterator[Step]:
        """What was drawn since."""
        for key, plan in self.drawn.items():
            if key[0] != order or before.drawn.get(key) is plan:
                continue
            had = before.drawn.get(key)
            old = {(one.link, one.on) for one in had.lines} if had else set()
            rate: Literal["omega", "alpha"] = "omega" if order == "velocity" else "alpha"
            named = self.structure.scene.by_name
            if plan.trial is not None:
                yield Step("divide", "plans", order, kind=rate, per_mm=plan.scales.rate, data=plan.trial)
            for one in plan.lines:
                if (one.link, one.on) not in old and one.link in named:
                    yield Step(
                        "read", "given on plan" if one.rate_known else "plan", order, kind=rate, link=one.link,
                        points=one.by, mm=abs(one.foot), per_mm=plan.scales.rate, value=one.rate,
                    )  # fmt: skip
            new = {k: v for k, v in plan.travels.items() if had is None or k not in had.travels}
            for slide, (value, mm) in new.items():
                yield Step("read", "plan travel", order, pairs=(slide,), mm=abs(mm), per_mm=plan.scales.speed,
                           value=value)  # fmt: skip


def _leads(plan: TrainPlan, wanted: tuple[list[str], list[str]]) -> bool:
    links, slides = wanted
    return all(plan.line(n) is not None for n in links) and all(key in plan.travels for key in slides)
