"""The velocity plan of a train of wheels: one line of velocities a link over its line of centres, rates read off a rate
scale; and likewise the plan of tangential accelerations.

Rolling wheels keep their rates when the carrier of their axes is bent or straightened, while the distances of axes that
it holds stay.  So all axes of a train are laid on one line where possible; a pair of wheels with axes on a line
already, but at another distance, gets a line of its own.

The velocity of a link's places grows along its line in proportion to the height, so two known places, or one place and
a known rate, give its line; at a contact of links two lines meet.  Parallels through a pole give the angular rates.  If
neither is known, a rate is assumed and found by proportion from the gaps. Sources: K. Kutzbach, Mehrgliedrige
Radgetriebe und ihre Gesetze, Maschinenbau 6 (1927); VDI 2157.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.construction.board.proportional_division import divide
from graphkin.construction.board.scales import fitting_scale
from graphkin.construction.board.steps import Bar, Order, Step
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, dot, unit
from graphkin.scene.model import PlacedLink
from graphkin.scene.pairs import PlacedGear
from graphkin.scene.symbol import Symbol
from graphkin.structure import Structure, meshes_of
from graphkin.structure.model import Coordinate
from graphkin.words import Phrase

ALIKE = 1e-9  # of a length: heights that are one
WIDE, HIGH = 62.0, 100.0
"""mm that velocities and heights may take on paper."""
FOOT = 80.0
"""mm that the rates may take on the rate scale."""
POLE = 30.0
"""mm from the pole to the rate scale, where that shows the rates; less where they are far apart."""
MOST_ASSUMED = 4
Turned = tuple[str, str, float]
"""Two links and the given rate of the first from the second (rad/s, rad/s2): 0 where one slides on the other."""


# lines of centres


@dataclass(frozen=True)
class Spot:
    """A place of a line of centres at which some links have the same velocity: an axis by its point, or a contact of
    rolling by the name of the pair.  ``height`` in m."""

    name: str
    height: float
    links: tuple[str, ...]
    rolls: bool


@dataclass(frozen=True)
class CentreLine:
    """Rolling pairs with their axes on one line.

    ``still`` is the reference place of velocities: it belongs to the frame, or else the velocities are relative to that
    axis.
    """

    meshes: tuple[PlacedGear, ...]
    spots: tuple[Spot, ...]
    still: str
    in_frame: bool

    @property
    def links(self) -> tuple[str, ...]:
        """Links with a line in the plan, in the order of the pairs."""
        return tuple(dict.fromkeys(name for mesh in self.meshes for name in mesh.members))

    def spots_of(self, link: str) -> tuple[Spot, ...]:
        """The places of a link, from below."""
        return tuple(sorted((s for s in self.spots if link in s.links), key=lambda s: s.height))

    def spot(self, name: str) -> Spot:
        """A place by its name."""
        return next(s for s in self.spots if s.name == name)


def trains(
    meshes: Sequence[PlacedGear], ground: str, turns: Sequence[Turned] = ()
) -> tuple[tuple[PlacedGear, ...], ...]:
    """Rolling pairs connected by moving links, also by links that turn from one another at given rates."""
    groups: list[tuple[set[str], list[PlacedGear]]] = []
    tied = [({first, second}, list[PlacedGear]()) for first, second, _ in turns]
    for links, members in (*tied, *(({*mesh.members}, [mesh]) for mesh in meshes)):
        links -= {ground}
        for other in [g for g in groups if g[0] & links]:
            groups.remove(other)
            links |= other[0]
            members = other[1] + members
        groups.append((links, members))
    return tuple(tuple(members) for _, members in groups if members)


def centre_lines(train: Iterable[PlacedGear], links: Mapping[str, PlacedLink], ground: str) -> tuple[CentreLine, ...]:
    """The lines on which the axes of a train are laid.

    Parameters
    ----------
    train : rolling pairs
    links : with the points of the carriers in their own axes (m)
    ground : the frame's name
    """
    made: list[tuple[dict[str, float], list[PlacedGear]]] = []
    left = list(train)
    while left:
        # the train is followed from pair to pair, so that a line reaches as far as it can
        mesh = next((m for m in left if made and any(p in made[-1][0] for p in m.axes)), left[0])
        left.remove(mesh)
        for heights, members in made:
            if any(p in heights for p in mesh.axes) and _laid(mesh, heights, links):
                members.append(mesh)
                break
        else:
            start = next((p for p in mesh.axes if p in links[ground].points), mesh.axes[0])
            made.append(({start: 0.0}, [mesh]))
            _laid(mesh, made[-1][0], links)
    return tuple(_line(members, heights, links, ground) for heights, members in made)


def _laid(mesh: PlacedGear, heights: dict[str, float], links: Mapping[str, PlacedLink]) -> bool:
    """Lay a pair's axes on a line if they fit; False if they are there at other distances."""
    first, second = mesh.axes
    if not second:
        return first in heights
    held = links[mesh.carrier].points
    far = abs(held[second] - held[first])
    if first in heights and second in heights:
        return abs(abs(heights[second] - heights[first]) - far) <= ALIKE * far
    known, new = (first, second) if first in heights else (second, first)
    base = heights[known]
    near = next((p for p in heights if p in held and p != known and held[p] != held[known]), None)
    if near is not None:
        # a carrier that is straight stays so
        up, out = held[near] - held[known], held[new] - held[known]
        on = dot(out, up) > 0 and abs(cross(out, up)) <= ALIKE * abs(up) * far
        upward = on == (heights[near] > base)
    else:
        other = next((h for h in heights.values() if h != base), base)
        upward = other <= base
    heights[new] = base + (far if upward else -far)
    return True


def _line(
    members: Sequence[PlacedGear], heights: Mapping[str, float], links: Mapping[str, PlacedLink], ground: str
) -> CentreLine:
    """A line of centres with its places: axes, and contacts of rolling."""
    at: dict[str, dict[str, None]] = {}
    spots = []
    for mesh in members:
        first, second = mesh.axes
        for axis, wheel in zip(mesh.axes, mesh.bodies, strict=True):
            if axis:
                at.setdefault(axis, {}).update(dict.fromkeys((wheel, mesh.carrier)))
        part, rest = mesh.teeth
        reach = part if rest is None else (heights[second] - heights[first]) * (part / (part + rest))
        spots.append(Spot(mesh.name, heights[first] + reach, mesh.bodies, True))
    axes = [Spot(p, heights[p], tuple(names), False) for p, names in at.items()]
    fixed = [s for s in (*axes, *spots) if ground in s.links]
    start = (*fixed, *(s for s in axes if s.name in links[ground].points), axes[0])[0]
    return CentreLine(tuple(members), (*axes, *spots), start.name, bool(fixed or start.name in links[ground].points))


# a plan as drawn


@dataclass
class TrainPlan:
    """A plan; it grows while it is drawn.

    Parameters
    ----------
    order, on : the order of its rates, and the lines of centres
    rates : of links, first the known ones, the frame included (rad/s, rad/s2)
    speeds : of sliding pairs, the known ones (m/s, m/s2)
    turns : links that turn from one another at given rates
    length, speed, turning : the value of 1 mm of it: m, m/s (m/s2), rad/s (rad/s2)
    lines : the step that draws the line of a link, between its lowest and its highest place (mm; velocity to the right,
        height upwards), and reads its rate or lays it off, by line of centres and link
    velocities : of places (mm), by line of centres and place
    travels : the step that reads the speed of a rack (m/s, m/s2), by sliding pair
    followed : the links of the turns by which a rate was found
    gaps : the differences at places found twice (mm)
    trial : the assumed rates, found by proportion
    """

    order: Order
    on: Sequence[CentreLine]
    rates: dict[str, float]
    speeds: Mapping[str, float]
    turns: Sequence[Turned]
    length: float = 1.0
    speed: float = 1.0
    turning: float = 1.0
    lines: dict[tuple[int, str], Step] = field(default_factory=dict)
    velocities: dict[tuple[int, str], float] = field(default_factory=dict)
    travels: dict[str, Step] = field(default_factory=dict)
    followed: set[tuple[str, str]] = field(default_factory=set)
    gaps: list[float] = field(default_factory=list)
    trial: Step | None = None

    @property
    def pole(self) -> float:
        """The distance of the pole from the rate scale (mm)."""
        return self.speed / self.length / self.turning

    @property
    def rate(self) -> Literal["omega", "alpha"]:
        """The kind of the rate scale."""
        return "omega" if self.order == "velocity" else "alpha"

    def line(self, link: str) -> Step | None:
        """The line of a link from which its rate is read, else its first."""
        steps = [step for (_, name), step in self.lines.items() if name == link]
        return next((step for step in steps if step.reason == "plan"), steps[0] if steps else None)

    def step(self, wanted: Coordinate) -> Step | None:
        """The step that reads a rate, or the speed of a sliding pair, or lays it off."""
        kind, name = wanted
        return self.line(name) if kind == "angle" else self.travels.get(name)

    def leads(self, wanted: Coordinate) -> bool:
        """Whether a rate, or the speed of a sliding pair, is found."""
        return wanted[1] in self.rates if wanted[0] == "angle" else {*self.travels, *self.speeds} >= {wanted[1]}

    def drawn(self, hand: Instrument, assumed: Mapping[str, float]) -> TrainPlan:
        """This undrawn plan with all its lines, with rates assumed in turn."""
        still = {(i, line.still): 0.0 for i, line in enumerate(self.on)}
        plan = replace(self, rates=dict(self.rates), lines={}, velocities=still, travels={}, followed=set(), gaps=[])
        plan._go_on(hand)
        for link, rate in assumed.items():
            plan.rates[link] = rate
            plan._go_on(hand)
        # what two links that slide on each other or that a driver turns leave open, on the rate scale
        plan.gaps += [(plan.rates[a] - plan.rates[b] - value) / self.turning for a, b, value in self.turns
                      if a in plan.rates and b in plan.rates and (a, b) not in plan.followed]
        return plan

    def _go_on(self, hand: Instrument) -> None:
        """Draw every line that follows from the drawn ones."""
        grown = True
        while grown:
            grown = False
            for first, second, value in self.turns:
                for link, known, rate in ((first, second, value), (second, first, -value)):
                    if known in self.rates and link not in self.rates:
                        self.rates[link] = self.rates[known] + rate
                        self.followed.add((first, second))
                        grown = True
            for i, line in enumerate(self.on):
                for mesh in line.meshes:
                    grown |= mesh.is_rack and self._slides(hand, i, mesh)
                for link in line.links:
                    grown |= (i, link) not in self.lines and self._line(hand, i, link)

    def _line(self, hand: Instrument, i: int, link: str) -> bool:
        """The line of a link by its rate or by two places; False where neither is known."""
        mm, spots = 1.0 / self.length, self.on[i].spots_of(link)
        known = [s for s in spots if (i, s.name) in self.velocities]
        given = link in self.rates
        if not known or (not given and known[0].height == known[-1].height):
            return False
        start = min(known, key=lambda s: (s.name != self.on[i].still, s.rolls)) if given else known[0]
        by = (start.name,) if given else (start.name, known[-1].name)
        x, y = self.velocities[i, start.name], start.height * mm
        if given:
            slope = -self.rates[link] * self.length / self.speed
        else:
            slope = (self.velocities[i, by[-1]] - x) / (known[-1].height * mm - y)
        for spot in (s for s in spots if s.name not in by):
            at = hand.point(complex(x + slope * (spot.height * mm - y), spot.height * mm)).real
            if (i, spot.name) in self.velocities:
                self.gaps.append(at - self.velocities[i, spot.name])
            self.velocities.setdefault((i, spot.name), at)
        if given:
            foot, rate = -slope * self.pole, self.rates[link]
        else:
            along = hand.direction(unit(complex(slope, 1.0)))
            foot = hand.read_signed(-along.real / along.imag * self.pole)
            rate = self.rates[link] = foot * self.turning
        reach = [s.height * mm for s in spots]
        if len(reach) == 1:  # towards the other places of the train
            far = max((s.height * mm for s in self.on[i].spots), key=abs)
            reach += [0.0] if reach[0] else [far * min(1.0, 0.25 * HIGH / abs(far))]
        low, high = (complex(x + slope * (h - y), h) for h in (min(reach), max(reach)))
        self.lines[i, link] = Step(
            "read", "given on plan" if given else "plan", self.order, (Bar(low, high, link),), kind=self.rate,
            link=link, points=by, mm=abs(foot), per_mm=self.turning, value=rate,
        )
        return True

    def _slides(self, hand: Instrument, i: int, mesh: PlacedGear) -> bool:
        """Draw the lines of a rack and of its guide, whose distance is the rack's speed."""
        if mesh.carrier not in self.rates:
            return False
        axis, pitch = self.on[i].spot(mesh.axes[0]), self.on[i].spot(mesh.name)
        lean = -self.rates[mesh.carrier] / self.speed * (pitch.height - axis.height)
        at, on = self.velocities.get((i, axis.name)), self.velocities.get((i, pitch.name))
        if mesh.slide in self.speeds:
            run = mesh.sense * self.speeds[mesh.slide] / self.speed
            if at is not None and on is None:
                self.velocities[i, pitch.name] = at + lean + hand.length(run)
            elif on is not None and at is None:
                self.velocities[i, axis.name] = on - lean - hand.length(run)
            return (at is None) != (on is None)
        if mesh.slide in self.travels or at is None or on is None:
            return False
        run = on - at - lean
        read = hand.read_signed(run)
        self.travels[mesh.slide] = Step("read", "plan travel", self.order, pairs=(mesh.slide,), mm=abs(read),
                                        per_mm=self.speed, value=mesh.sense * read * self.speed)
        return True

    def trials(self, names: Sequence[str]) -> list[dict[str, float]]:
        """The rates assumed in each trial: none turns in the first, then each in turn, as fast as the fastest known."""
        fastest = max((abs(r) for r in self.rates.values()), default=0.0) or 1.0
        first = dict.fromkeys(names, 0.0)
        return [first, *({**first, name: fastest} for name in names)]

    def by_trial(self, hand: Instrument, names: Sequence[str]) -> TrainPlan:
        """This plan drawn with rates found by proportion from trials."""
        if not names:
            return self.drawn(hand, {})
        trials = self.trials(names)
        gaps = [self.drawn(hand, assumed).gaps for assumed in trials]
        values = tuple(map(float, divide([[*assumed.values()] for assumed in trials], gaps)))
        gaps_in_rows = tuple(tuple(map(float, row)) for row in gaps)
        rates = tuple((Symbol(self.rate, link=name), rate) for name, rate in zip(names, values, strict=True))
        trial = Step("divide", "plans", self.order, rates=rates, apart=gaps_in_rows)
        return replace(self.drawn(hand, dict(zip(names, values, strict=True))), trial=trial)

    def to_assume(self, wanted: Coordinate) -> list[str] | None:
        """Links whose rates must be assumed so that the trials give them and the wanted value; None if none lead to
        it."""
        names: list[str] = []
        for _ in range(MOST_ASSUMED):
            plan = self.drawn(EXACT, dict.fromkeys(names, 0.0))
            if not names and plan.leads(wanted):
                return names
            # of these one place is known
            free = [link for i, line in enumerate(self.on) for link in line.links if link not in plan.rates
                    and any((i, s.name) in plan.velocities for s in line.spots_of(link))]
            for assumed in dict.fromkeys(free):
                if self._closes([*names, assumed], wanted):
                    return [*names, assumed]
            if not free:
                break
            names.append(free[0])
        return None

    def _closes(self, names: Sequence[str], wanted: Coordinate) -> bool:
        """Whether the gaps of the trials give the assumed rates, and these the wanted value."""
        first, *others = (self.drawn(EXACT, plan) for plan in self.trials(names))
        slopes = np.array([plan.gaps for plan in others]) - np.array(first.gaps)
        most = float(np.abs(slopes).max(initial=0.0))
        return most > 0.0 and bool(np.linalg.matrix_rank(slopes, 1e-9 * most) == len(names)) and first.leads(wanted)


def train_plan(plan: TrainPlan, wanted: Coordinate, units: float, hand: Instrument = EXACT) -> TrainPlan | None:
    """Draw a plan; None where it does not lead to the wanted value.

    Parameters
    ----------
    plan : with the known values, nothing drawn
    wanted : a link whose rate, or a sliding pair whose speed is to be found
    units : m of the length unit, for the scales
    hand : the hands that draw and read
    """
    names = plan.to_assume(wanted)
    if names is None:
        return None
    rough = plan.by_trial(EXACT, names)
    if not any((*rough.rates.values(), *rough.velocities.values())):
        hand = EXACT  # every line lies on that of the centres: there is nothing to draw
    return _scaled(plan, rough, units).by_trial(hand, names)


def _scaled(plan: TrainPlan, rough: TrainPlan, units: float) -> TrainPlan:
    """A roughly drawn plan at the finest scales of the series at which its widest line of centres fits, and a rate
    scale shows all rates."""
    high = max(max(h) - min(h) for h in ([s.height for s in line.spots] for line in rough.on))
    speeds = [[0.0, *(v for (j, _), v in rough.velocities.items() if j == i)] for i in range(len(rough.on))]
    wide, turns = max(max(v) - min(v) for v in speeds), [0.0, *(line.value for line in rough.lines.values())]
    length = fitting_scale((0.0, high), (1.0, HIGH), 1.0 / units) * units
    speed = fitting_scale((wide, 0.0), (WIDE, 1.0), 1.0 / units) * units
    fits = fitting_scale((max(turns) - min(turns), 0.0), (FOOT, 1.0), 1.0)
    tall = fitting_scale((speed / length, 0.0), (POLE, 1.0), 1.0)
    return replace(plan, length=length, speed=speed, turning=max(fits, tall) if wide else 1.0)


# the trains of a mechanism

def rolled(
    structure: Structure, drawn: list[TrainPlan], order: Order, wanted: Coordinate, rates: Mapping[str, float],
    travel: Callable[[str], float | None], turns: list[Turned], hand: Instrument,
) -> tuple[float, float, list[Step]]:
    """A rate (rad/s, rad/s2) or the speed of a slide (m/s, m/s2) on the plan that leads to it, the length read for it
    (mm), and the steps of a new plan.  Wheels whose motion needs other results first get a plan of their own, at scales
    that suit it, in which the rates known by then are laid off.

    Parameters
    ----------
    drawn : the plans of the mechanism drawn so far, to which a new plan is added
    rates : known rates by link (rad/s, rad/s2)
    travel : function to the known speed (m/s, m/s2) of a sliding pair, None where it is unknown
    turns : links that turn from one another at given rates

    Raises
    ------
    Unsolvable : "not drawn": no plan leads to it
    """
    scene, links, (kind, name) = structure.scene, structure.links, wanted
    alike = structure.turning_with(name) if kind == "angle" else {name}
    meshes, ground = meshes_of(scene, structure.touching, links), scene.frame.name
    # where a driver turns a link from one of another train, one may need the other
    for train in dict.fromkeys((*trains(meshes, ground), *trains(meshes, ground, turns))):
        on = centre_lines(train, links, scene.frame.name)
        slides = [mesh.slide for mesh in train if mesh.slide]
        members = {n for line in on for n in line.links} if kind == "angle" else slides
        inside = sorted(alike.intersection(members), key=lambda n: n != name)
        if not inside:
            continue
        here: Coordinate = (kind, inside[0])
        there = (plan for plan in drawn if plan.order == order and plan.on == on)
        plan, steps = next((plan for plan in there if plan.step(here) is not None), None), list[Step]()
        if plan is None:
            speeds = {key: speed for key in slides if (speed := travel(key)) is not None}
            begun = TrainPlan(order, on, {**rates, scene.frame.name: 0.0}, speeds, turns)
            plan = train_plan(begun, here, scene.units.rates.metres, hand)
            if plan is None:
                continue
            drawn.append(plan)
            # drawn beside the train, not on the polygon
            lines = (replace(step, strokes=()) for step in plan.lines.values() if step.link in scene.by_name)
            trial = () if plan.trial is None else (plan.trial,)
            steps = [replace(step, plan=len(drawn)) for step in (*trial, *lines, *plan.travels.values())]
        step = plan.step(here)
        assert step is not None
        return step.value, step.mm, steps
    raise Unsolvable("not drawn", Problem(Phrase("link of name", name=name),
                                          "no velocity plan leads to what rolls here"))
