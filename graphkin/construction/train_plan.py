"""The velocity plan of a train of wheels: one line of velocities a link over its line of centres, rates read off a rate
scale; and the same of tangential accelerations.

The velocity of a link's places grows along its line in proportion to the height, so two known places, or one and a
known rate, give its line; where links touch, two lines meet.  Lines drawn parallel through a pole mark off the angular
rates.  Where neither is known, a rate is assumed and found by proportion from what is left open.
Sources: K. Kutzbach, Mehrgliedrige Radgetriebe und ihre Gesetze, Maschinenbau 6 (1927); VDI 2157.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from graphkin.construction.centre_lines import CentreLine, PlanLine, PlanScales, PlanTrial, Spot, TrainPlan
from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.proportional_division import divide
from graphkin.construction.scales import Extent, fitting_scale
from graphkin.construction.sizes import Order
from graphkin.construction.steps import Step
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import unit
from graphkin.structure import Mesh, Structure, meshes_of
from graphkin.structure.model import Coordinate
from graphkin.words import Phrase

__all__ = ["FOOT", "Travel", "Turned", "Wheels", "train_plan"]

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
        from graphkin.construction.centre_lines import centre_lines, trains

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
