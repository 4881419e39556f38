"""Explanations of a wrong value: the value of a common slip, with its frequency; or the value that follows from the
person's own earlier values, from which the drawing is continued in place of the drawn ones.

The slips are those that teachers of the graphical method name (Sun Huan, Mechanical Principles, ch. 3; Norton, Design
of Machinery, ch. 6 and 7): a sign, a unit, the Coriolis term, one component in place of the whole, the scale of the
other polygon, another vector of the same polygon, the other assembly.  A slip on the path to a value is one change: of
a term, a branch, a load, a mesh; the same drawing or the same solver then gives every quantity.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from typing import TypeVar

import numpy as np

from graphkin.checking.readings import read_off
from graphkin.checking.report import Uncertainty
from graphkin.checking.slip_likelihood import Suspect, Suspects
from graphkin.construction import AS_DRAWN, OwnValues, Plan, Sheet, Stages, execute, plan_with_forces
from graphkin.construction.board.steps import PARTS, Order, Term
from graphkin.errors import GraphkinError
from graphkin.plane import added_up, unit
from graphkin.scene.model import LinkMass, Loading, LoadOn, Mechanism, PlacedLink
from graphkin.scene.pairs import HigherPair, PlacedGear
from graphkin.scene.scene_tables import STANDARD_GRAVITY
from graphkin.scene.symbol import PointRef, Symbol, Value
from graphkin.solver import Motion, solve
from graphkin.solver.forces import Forces, forces_of, senses_along, value_of
from graphkin.solver.values import as_drawn, exact_values
from graphkin.words import Phrase, Wording, listed

NOTHING = 1e-9  # of the greatest value of its sort: what is smaller is zero
CANCELLING = ("motion", "position", "force")  # scopes of what may be a difference that leaves nothing
RPM = 60.0 / math.tau
DEGREE = 180.0 / math.pi
LENGTHS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
INCHES = ("in", "ft")

T = TypeVar("T")
ValuesElsewhere = Callable[[Symbol], Sequence[tuple[str, Value]]]
"""Exact values of a symbol elsewhere, with the names of the places."""
Values = Callable[[Symbol], Value | None]
Alteration = tuple[Phrase, float, Callable[[], Values]]
"""A slip in words, its share among wrong values (rough, from experience), and what makes everything with it."""
Slipped = tuple[Phrase, float, Values]
"""A slip in words, its share, and what each quantity comes to with it (SI; None: nothing)."""


@dataclass(frozen=True)
class ExpectedValue:
    """The values for comparison with stated values of a symbol (SI): the right value, without the rounding of one that
    cancels; the greatest exact drawn value of its kind; the error of a pencil (0 where it is not predicted, infinite
    where it has no bound); the unit vector of its positive sense, None where it has none."""

    right: Value
    largest: float
    bound: float
    line: complex | None


@dataclass(frozen=True)
class Evidence:
    """The evidence on a scene at one position.

    ``exact`` gives the exact value of a symbol, ``elsewhere`` its exact values at other positions with their names,
    ``variants`` those of other problems of a set, ``predicted`` the uncertainty of a pencil drawing.
    """

    plan: Plan
    exact: Callable[[Symbol], Value]
    predicted: Mapping[Symbol, Uncertainty]
    elsewhere: ValuesElsewhere = lambda symbol: ()
    variants: ValuesElsewhere = lambda symbol: ()
    motion: Motion | None = None

    @classmethod
    def of(cls, planned: Plan, motion: Motion, predicted: Mapping[Symbol, Uncertainty]) -> Evidence:
        """The evidence at the position of a plan, all of it drawn: slips are found on the path asked and beside it."""
        whole = plan_with_forces(planned.structure, planned.values, (), ())
        drawn = planned if set(planned.elements) == set(whole.elements) else whole
        here = as_drawn(motion, planned.structure)
        return cls(drawn, lambda symbol: exact_values(here, [symbol])[symbol], predicted)

    @cached_property
    def sheet(self) -> Sheet:
        """The plan drawn without a slip."""
        return execute(self.plan)

    @cached_property
    def others(self) -> Mapping[Symbol, Value]:
        """The exact values of all drawn quantities."""
        return {r.symbol: self.exact(r.symbol) for r in read_off(self.sheet)}

    @cached_property
    def slipped(self) -> tuple[Slipped, ...]:
        """The forces with each of their usual slips, and the motion with each usual slip in its wheels."""
        return (*slipped_forces(self.motion), *_made(_gear_slips(self.motion))) if self.motion is not None else ()

    @cached_property
    def altered(self) -> tuple[Slipped, ...]:
        """The drawing with each slip in a term, and in each other assembly."""
        return _made((*_assemblies(self.plan), *_terms(self.plan, self.sheet)))

    @cached_property
    def held(self) -> Callable[[Symbol], ExpectedValue]:
        """The values for comparison with stated values of a symbol; computed once for each."""
        return cache(self._held)

    def _held(self, symbol: Symbol) -> ExpectedValue:
        exact = self.exact(symbol)
        alike = [abs(v) for s, v in self.others.items() if _sort(s) == _sort(symbol)]
        largest = max([abs(exact), *alike]) or math.inf
        residue = symbol.scope in CANCELLING and abs(exact) <= NOTHING * largest
        uncertainty = self.predicted.get(symbol)
        bound = uncertainty.bound if uncertainty else 0.0
        bound = math.inf if symbol.scope == "motion" and bound > largest else bound
        return ExpectedValue(type(exact)(0.0) if residue else exact, largest, bound, self._line(symbol))

    def _line(self, symbol: Symbol) -> complex | None:
        """The unit vector of the positive sense of a vector symbol, None where it has none: along a guide the guide's
        sense, of a tangential acceleration counter-clockwise."""
        of, scene, points = symbol.of, self.sheet.scene, self.sheet.points
        if symbol.kind == "at" and of is not None:
            pivots = (p for k in _links_of(scene, of) for p in scene.pivots(k.name) if p != of.point)
            about = symbol.to.point if symbol.to else next(pivots, "")
            start, end = points.get(PointRef(about)), points.get(PointRef(of.point))
            return 1j * unit(end - start) if start is not None and end is not None and end != start else None
        lines = None if self.motion is None else senses_along(as_drawn(self.motion, self.plan.structure), symbol)
        return None if lines is None else complex(lines[0])

    @cached_property
    def suspects(self) -> Callable[[Symbol], Suspects]:
        """All explanations of a wrong value of a symbol; found once for each."""
        return cache(lambda symbol: Suspects(tuple(_suspects(self, symbol))))

    # what follows from somebody's own values

    @cached_property
    def _stages(self) -> Stages:
        of_person = partial(_own_values, self.plan, self.sheet)
        return Stages(self.plan, self.plan.scales, own_values=of_person)

    def following(self, answers: Mapping[Symbol, Value], of: Symbol) -> tuple[Value, ...]:
        """The value of a symbol, drawn from the person's own values of other symbols (SI).

        Parameters
        ----------
        answers : of the person, of which those drawn before it count; a vector given by its size keeps its direction
        of : the asked symbol; the person's value of it is not used

        Returns
        -------
        The value of the drawing, then for a sum of terms the sum of these
        """
        try:
            polygons = self._stages.to(of, {s: v for s, v in answers.items() if self.before(s, of)})
        except (GraphkinError, ArithmeticError, np.linalg.LinAlgError):
            return ()  # a drawing that cannot be gone on with
        if polygons is None:
            return ()
        order: Order = "velocity" if of.kind in ("v", "omega") else "acceleration"
        if not of.is_vector:
            return (polygons.rates[order][of.link].value,)
        drawn, scale = polygons.drawn[order], self.sheet.scales.of(order)
        values: list[Value] = [drawn[of].span * scale]
        for equation in polygons.board.equations:
            if not any(len(side) == 1 and side[0].symbol == of for side in equation.sides):
                continue
            for side in equation.sides:
                spans = [drawn[t.symbol].span for t in side if t.symbol in drawn]
                if len(side) > 1 and len(spans) == len(side):
                    values.append(added_up(spans, 0j) * scale)
        return tuple(values)

    def by_rates(self, answers: Mapping[Symbol, Value], of: Symbol) -> tuple[float, tuple[Symbol, ...]] | None:
        """The size of the acceleration of a point about a fixed pivot (SI) by the person's rates, and these; None where
        they state no angular acceleration, or the tangential component from which it follows."""
        scene, point = self.sheet.scene, of.of
        if of.kind != "a" or point is None or of.to is not None:
            return None
        if any(s.kind == "at" and s.of is not None and s.of.point == point.point for s in answers):
            return None
        for link in _links_of(scene, point):
            rates = Symbol("omega", link=link.name), Symbol("alpha", link=link.name)
            pivots = [link.points[name] for name in scene.pivots(link.name)]
            if pivots and rates[1] in answers:
                omega, alpha = (float(answers[s].real if s in answers else self.exact(s).real) for s in rates)
                arm = abs(link.points[point.point] - pivots[0])
                return arm * math.hypot(omega**2, alpha), tuple(s for s in rates if s in answers)
        return None

    def before(self, earlier: Symbol, later: Symbol) -> bool:
        """Whether a quantity is known on the drawing before another, which can then follow from it."""
        return _step(self.sheet, earlier) < _step(self.sheet, later)


def _made(alterations: Iterable[Alteration]) -> tuple[Slipped, ...]:
    """The values with each of some slips."""
    slipped = []
    for phrase, share, values in alterations:
        with suppress(GraphkinError, ArithmeticError):  # with it nothing can be drawn, so nobody's value comes from it
            slipped.append((phrase, share, values()))
    return tuple(slipped)


def _drawn(plan: Plan, own_values: OwnValues = AS_DRAWN) -> Values:
    """The readings from a plan drawn with a slip."""
    return {r.symbol: r.value for r in read_off(execute(plan, own_values=own_values))}.get


def _assemblies(plan: Plan) -> Iterator[Alteration]:
    for i, branch in plan.assembly.branches.items():
        other = {**plan.assembly.branches, i: 1 - branch}
        yield Phrase("slip assembly"), 0.05, lambda other=other: _drawn(plan.with_branches(other))  # type: ignore[misc]


OF_TERMS = (
    ("coriolis", "left out", 0.0, 0.1), ("coriolis", "reversed", -1.0, 0.08), ("coriolis", "factor", 0.5, 0.04),
    ("normal", "left out", 0.0, 0.05), ("normal", "reversed", -1.0, 0.04),
)
"""What is done wrong with terms of a role: in words, by what factor they change, and its share."""


def _terms(plan: Plan, sheet: Sheet) -> Iterator[Alteration]:
    """Each slip in one term, and in all of its role."""
    drawn = sheet.vectors["acceleration"].values()
    names = {role: [v.symbol for v in drawn if v.role == role] for role, *_ in OF_TERMS}
    for role, symbols in names.items():
        groups = [(n,) for n in symbols] + ([tuple(symbols)] if len(symbols) > 1 else [])
        for group in groups:
            shown = listed([*map(str, group)])
            for key, factor, share in (slip[1:] for slip in OF_TERMS if slip[0] == role):
                slip = OwnValues(term=_times(group, factor))
                yield Phrase(f"slip {role} {key}", name=shown), share / len(groups), partial(_drawn, plan, slip)


def _times(symbols: tuple[Symbol, ...], factor: float) -> Callable[[Term], Term]:
    def changed(part: Term) -> Term:
        if part.span is None or part.symbol not in symbols:
            return part
        return replace(part, span=part.span * factor)

    return changed


def _suspects(case: Evidence, symbol: Symbol) -> Iterator[Suspect]:
    """Every explanation for a wrong value of a symbol."""
    exact = case.exact(symbol)
    yield Suspect(Phrase("slip sign"), -exact, 0.5)
    if isinstance(exact, complex):
        x, y = exact.real, exact.imag
        for phrase, value in (
            (Phrase("slip component sign", axis="x"), complex(-x, y)),
            (Phrase("slip component sign", axis="y"), complex(x, -y)),
            (Phrase("slip components exchanged"), complex(y, x)),
        ):
            yield Suspect(phrase, value, 0.05, of_components=True)
    yield from _slipped(case.slipped, symbol, exact)
    if symbol.kind == "ak":
        yield Suspect(Phrase("slip coriolis factor", name=str(symbol)), exact / 2, 0.1)
    for altered in _slipped(case.altered, symbol, exact):
        yield altered
        yield Suspect(Phrase("slip and sign", slip=altered.phrase), -altered.value, 0.1 * altered.share)
    yield from _factors(case, symbol, exact)
    yield from _own_parts(case, symbol)
    yield from _relative(case, symbol, exact)
    yield from _others(case, symbol, exact)
    variants = case.variants(symbol)
    for name, value in variants:
        yield Suspect(Phrase("slip variant", name=name), value, 0.3 / len(variants))
    places = case.elsewhere(symbol)
    for name, value in places:
        yield Suspect(Phrase("slip position", name=name), value, 0.05 / len(places), drawn=False)


def _slipped(slips: Sequence[Slipped], symbol: Symbol, exact: Value) -> Iterator[Suspect]:
    """The values of a symbol with each slip that changes it; one made in more places to no effect is left out."""
    given = list[tuple[str, Value]]()
    for phrase, share, values in slips:
        value = values(symbol)
        if value is None or abs(value - exact) <= 1e-6 * abs(exact):
            continue
        if not any(key == phrase.key and abs(value - other) <= 1e-6 * abs(value) for key, other in given):
            given.append((phrase.key, value))
            yield Suspect(phrase, value, share)


def _factors(case: Evidence, symbol: Symbol, exact: Value) -> Iterator[Suspect]:
    """The value in another unit, doubled or halved, or by the scale of the other polygon."""
    scene, scales, measure = case.plan.structure.scene, case.plan.scales, symbol.measure
    second, plain = measure.order == 2, measure.name in ("angle", "number")
    units = [(f"{factor:g}", factor) for power in (1, 2, 3) for factor in (10.0**power, 0.1**power) if not plain]
    unit_name = scene.units.length
    if unit_name in INCHES and measure.is_of_motion and measure.length:  # no powers of ten
        lengths = (LENGTHS[unit_name] / metres for unit, metres in LENGTHS.items() if unit != unit_name)
        units += [(f"{factor:.4g}", factor) for factor in lengths]
    for shown, factor in units:
        yield Suspect(Phrase("slip factor", factor=shown), exact * factor, 0.02)
    for name, factor in (("rpm", RPM), ("degrees", DEGREE)):
        for times in (factor, 1 / factor) if measure.order or (measure.is_angle and name == "degrees") else ():
            yield Suspect(Phrase(f"slip {name}"), exact * times, 0.01 if symbol.is_vector else 0.03)
            if second:
                yield Suspect(Phrase(f"slip {name}"), exact * times**2, 0.01)
    for factor in (60.0, 1 / math.tau) if measure.order else ():  # n taken for n/60, or n/60 for omega
        yield Suspect(Phrase("slip rpm"), exact * factor, 0.02 if any(d.rpm for d in scene.drivers) else 0.005)
    for name, factor in (("double", 2.0), ("half", 0.5)) if not plain else ():
        yield Suspect(Phrase(f"slip {name}"), exact * factor, 0.02)
    if symbol.scope != "motion":
        return
    wanted = scene.question.sheet
    if wanted.velocity_scale and wanted.acceleration_scale:
        ratio = scales.velocity / scales.acceleration
        phrase = Phrase("slip velocity scale") if second else Phrase("slip acceleration scale")
        yield Suspect(phrase, exact * (ratio if second else 1 / ratio), 0.05)
    given = wanted.acceleration_scale if second else wanted.velocity_scale
    if given and symbol.is_vector:
        # the length on paper written down as if it were the value, in scene units
        yield Suspect(Phrase("slip millimetres"), exact / given, 0.05)


def _links_of(scene: Mechanism, of: PointRef) -> Iterator[PlacedLink]:
    """The links that have a point."""
    return (link for link in scene.links if of.point in link.points and of.link in ("", link.name))


def _relative(case: Evidence, symbol: Symbol, exact: Value) -> Iterator[Suspect]:
    """A relative value, to another point of the same link or to a joined link, in place of the absolute one."""
    scene = case.plan.structure.scene
    if symbol.kind in ("omega", "alpha"):
        beside = _beside(scene, symbol.link)
        for name in beside:
            value = exact - case.exact(Symbol(symbol.kind, link=name))
            yield Suspect(Phrase("slip relative rate", name=name), value, 0.08 / len(beside))
    if symbol.kind not in ("v", "a") or symbol.of is None or symbol.to is not None:
        return
    for link in _links_of(scene, symbol.of):
        others = [Symbol(symbol.kind, symbol.of, PointRef(p)) for p in link.points if p != symbol.of.point]
        for other in others:
            if other not in case.others and other.to and other.to.point not in scene.frame.points:
                value = exact - case.exact(Symbol(symbol.kind, other.to))
                yield Suspect(Phrase("slip relative", name=str(other)), value, 0.08 / len(others))


def _beside(scene: Mechanism, link: str) -> tuple[str, ...]:
    """The moving links that share a turning pair with a link, or carry it as a wheel."""
    points = next((k.points for k in scene.links if k.name == link), {})
    carriers = {g.carrier for g in scene.gears if link in g.bodies} - {scene.frame.name}
    return tuple(k.name for k in scene.links if k.name != link and (k.name in carriers or set(k.points) & set(points)))


def _own_parts(case: Evidence, symbol: Symbol) -> Iterator[Suspect]:
    """A component of an acceleration in place of the whole: drawn, or about a pivot if an image gave the point."""
    if symbol.kind != "a" or symbol.of is None:
        return
    parts = [other for other in case.others if other.of == symbol.of]
    if symbol.to is None:
        scene = case.plan.structure.scene
        for link in _links_of(scene, symbol.of):
            for pivot in sorted({*scene.pivots(link.name)} - {symbol.of.point}):
                parts += [Symbol(kind, symbol.of, PointRef(pivot)) for kind in ("an", "at")]
    for other in dict.fromkeys(parts):
        if other.kind in PARTS:
            yield Suspect(Phrase(f"slip {PARTS[other.kind]} only", name=str(other)), case.exact(other), 0.05)


def _others(case: Evidence, symbol: Symbol, exact: Value) -> Iterator[Suspect]:
    alike = [(o, v) for o, v in case.others.items() if o != symbol and _sort(o) == _sort(symbol)]
    for other, value in alike:
        if symbol.kind == "a" and other.kind in PARTS and other.of == symbol.of:
            continue  # it is named as a component
        relative = symbol.to is None and other.to is not None and other.of is not None and symbol.of is not None
        if relative and other.of and symbol.of and other.of.point == symbol.of.point and other.kind == symbol.kind:
            yield Suspect(Phrase("slip relative", name=str(other)), value, 0.08)
        else:
            yield Suspect(Phrase("slip other", name=str(other)), value, 0.1 / len(alike))
    if not symbol.is_vector:
        return
    for other, value in ((symbol, exact), *alike):
        for axis, part in (("x", value.real), ("y", value.imag)):
            if abs(part) > 1e-6 * abs(value) and abs(abs(part) - abs(value)) > 1e-6 * abs(value):
                same = other == symbol
                key = "slip component" if same else "slip other component"
                yield Suspect(Phrase(key, axis=axis, name=str(other)), part, 0.05 if same else 0.05 / len(alike))


def _sort(symbol: Symbol) -> str:
    """The kind of a quantity by a common name; an arm of the lever, a velocity on paper, is a kind of its own."""
    return "arm" if symbol.kind == "arm" else symbol.measure.name


# somebody's own values


def _step(sheet: Sheet, symbol: Symbol) -> float:
    """The step at which a quantity is known on the drawing; a rate follows its measured vector."""
    if symbol.scope != "motion":
        return 0.0
    if not symbol.is_vector:
        rate = sheet.rates[symbol.kind].get(symbol.link)
        if rate is not None and rate.same_as:
            return _step(sheet, Symbol(symbol.kind, link=rate.same_as))
        return _step(sheet, rate.vector) + 0.5 if rate is not None and rate.vector else 0.0
    return float(sheet.drawn_in.get(symbol, math.inf))


def _own_values(plan: Plan, base: Sheet, answers: Mapping[Symbol, Value]) -> OwnValues:
    """The changes with which a drawing continues from the person's own values (SI) in place of the drawn ones."""

    def ratio(symbol: Symbol | None) -> float:
        """The person's value over the drawn one, 1 where there is none."""
        if symbol is None or symbol not in answers:
            return 1.0
        if symbol.is_vector:
            drawn = base.vectors["velocity"].get(symbol)
            size = abs(drawn.span) * base.scales.velocity if drawn else 0.0
            return abs(answers[symbol]) / size if size else 1.0
        rate = base.rates["omega"].get(symbol.link)
        return float(answers[symbol].real) / rate.value if rate and rate.value else 1.0

    def sized(symbol: Symbol, drawn: complex) -> complex:
        """A vector on paper with the person's own size, or their own components."""
        value = answers[symbol]
        scale = base.scales.velocity if symbol.kind == "v" else base.scales.acceleration
        if isinstance(value, complex):
            return value / scale
        return drawn / abs(drawn) * (abs(value) / scale) if drawn else drawn

    def term(part: Term) -> Term:
        """A known term with the person's own size, or made from the person's own velocities."""
        if part.span is None:
            return part
        if part.symbol in answers:
            return replace(part, span=sized(part.symbol, part.span))
        of, to = part.symbol.of, part.symbol.to
        drawn = base.vectors["acceleration"].get(part.symbol)
        if of is None or drawn is None or part.role not in ("coriolis", "normal"):
            return part
        if part.role == "coriolis":
            factor = ratio(Symbol("v", of, to)) * ratio(_guide_turns(plan, of, to))
        else:
            fixed = to is None or to.point in plan.structure.scene.frame.points
            factor = (abs(ratio(Symbol("v", of, to))) * abs(ratio(Symbol("v", of)) if fixed else 1)) ** 2
        return replace(part, span=drawn.span * factor) if factor != 1.0 else part

    def found(symbol: Symbol, tail: complex, tip: complex) -> complex:
        return tail + sized(symbol, tip - tail) if symbol in answers else tip

    def rate(symbol: Symbol, value: float) -> float | None:
        return float(answers[symbol].real) if symbol in answers else None

    return OwnValues(term, found, rate)


def _guide_turns(plan: Plan, of: PointRef, to: PointRef | None) -> Symbol | None:
    """The angular velocity of the guide between two coincident points, or of the link from which a point is seen."""
    links = {r.link for r in (of, to) if r}
    for slide in plan.structure.slides:
        if slide.pin == of.point and links & {slide.a, slide.b}:
            return Symbol("omega", link=slide.b)
    return Symbol("omega", link=to.link) if to and to.link else None  # a link of a contour, held still


# slips in forces and gears

OF_MASSES = (
    ("slip inertia force with", 0.15, -1.0, -1.0), ("slip inertia force left out", 0.1, 0.0, 0.0),
    ("slip inertia left out", 0.12, 1.0, 0.0), ("slip arm side", 0.1, 1.0, -1.0),
)
"""What is done wrong with inertia: in words, its share, and by what factors forces and couples change."""


def slipped_forces(motion: Motion) -> tuple[Slipped, ...]:
    """The forces at the one position of a motion with each slip."""
    return _made(_force_slips(motion))


def _force_slips(motion: Motion) -> Iterator[Alteration]:
    if not motion.scene.loading or not motion.ok[0]:
        return
    loading = motion.scene.loading
    masses, springs, (loads, idle), down = loading.masses, loading.springs, _standing(motion), loading.gravity
    weights = tuple(LoadOn(f"weight{mass.link}", mass.link, mass.mass * abs(down), True, mass.at, down / abs(down))
                    for mass in masses) if down else ()
    right = Loading(0j, masses, (*weights, *loads), loading.balance, springs=springs)

    def slip(key: str, of: Wording | None, share: float, **changes: Sequence[object]) -> Alteration:
        wrong = replace(right, **{name: tuple(things) for name, things in changes.items()})  # type: ignore[arg-type]
        return Phrase(key, name=of), share, partial(_forces, motion, wrong)

    every = [tuple(mass.link for mass in masses)] if masses else []
    groups = [*((mass.link,) for mass in masses), *(every if len(masses) > 1 else ())]
    for links in groups:
        shown, each = listed(links), 1.0 / len(groups)
        if down:
            pulled = [load for load in right.loads if load not in weights or load.link not in links]
            yield slip("slip weight left out", shown, 0.15 * each, loads=pulled)
        turns = any(mass.inertia for mass in masses if mass.link in links)
        for key, share, force, couple in OF_MASSES:
            if turns or force != 1.0:
                yield slip(key, shown, share * each, masses=[_scaled(mass, links, force, couple) for mass in masses])
    units = motion.scene.units
    if masses and math.isclose(units.newtons / units.kilograms, STANDARD_GRAVITY):  # kgf and kg, lbf and lb
        heavy = [_scaled(mass, every[0], STANDARD_GRAVITY, STANDARD_GRAVITY) for mass in masses]
        wrong = replace(right, masses=tuple(heavy))
        yield Phrase("slip not over g", mass=units.mass, force=units.force), 0.08, partial(_forces, motion, wrong)
    elif down:
        small = (replace(weight, size=weight.size / abs(down)) for weight in weights)
        yield slip("slip kg for N", None, 0.08, loads=(*small, *loads))
        heavy = [_scaled(mass, every[0], abs(down), 1.0) for mass in masses]
        yield slip("slip N for kg", None, 0.08, masses=heavy)
    for load in loads:
        each, reversed_load = 1.0 / len(loads), replace(load, size=-load.size)
        yield slip("slip load left out", load.name, 0.1 * each, loads=_instead(right.loads, load))
        yield slip("slip load reversed", load.name, 0.06 * each, loads=_instead(right.loads, load, reversed_load))
    for spring in springs:
        each, pushing = 1.0 / len(springs), replace(spring, rate=-spring.rate, preload=-spring.preload)
        for key, share, instead in (
            ("slip spring left out", 0.1, ()), ("slip spring reversed", 0.06, (pushing,)),
            ("slip free length", 0.1, (replace(spring, free=0.0),)),
        ):
            yield slip(key, spring.name, share * each, springs=_instead(springs, spring, *instead))
    for load in idle:
        yield slip("slip load not here", load.name, 0.15 / len(idle), loads=(*right.loads, load))


def _instead(members: Sequence[T], replaced: T, *others: T) -> tuple[T, ...]:
    """The members with others in place of one."""
    return tuple(kept for member in members for kept in (others if member is replaced else (member,)))


def _under(motion: Motion, loading: Loading) -> Forces:
    """The forces of a motion under other loads."""
    scene = replace(motion.scene, loading=loading)
    return forces_of(replace(motion, structure=replace(motion.structure, scene=scene)))


def _forces(motion: Motion, loading: Loading) -> Values:
    """The forces (N) and moments (N m) at a motion's position under other loads."""
    forces = _under(motion, loading)

    def value(symbol: Symbol) -> Value | None:
        course = forces.value(symbol)
        return None if course is None else _finite(symbol, course[0])

    return value


def _finite(symbol: Symbol, value: complex) -> Value | None:
    """The value of a symbol, a vector or a number; None where it is not finite."""
    if not np.isfinite(value):
        return None
    return complex(value) if symbol.is_vector else float(value.real)


def _standing(motion: Motion) -> tuple[tuple[LoadOn, ...], tuple[LoadOn, ...]]:
    """The loads that act at the position, and those that do not, each as it is there."""
    loading = motion.scene.loading
    always = replace(loading, gravity=0j, loads=tuple(replace(load, phase=None) for load in loading.loads))
    here, there = forces_of(motion), _under(motion, always)
    acting: list[LoadOn] = []
    idle: list[LoadOn] = []
    for load in loading.loads:
        acting_now, value = (forces.values[load.symbol][0] for forces in (here, there))
        if not value or (not acting_now and value_of(motion, replace(load.symbol, plus=True))[0]):
            continue  # one that begins or ends just here is no slip
        bare = replace(load, phase=None)
        if load.is_force:
            bare = replace(bare, size=abs(value), turn=complex(value / abs(value)), follows="", against="")
        (acting if acting_now else idle).append(bare)
    return tuple(acting), tuple(idle)


def _scaled(mass: LinkMass, links: Sequence[str], force: float, couple: float) -> LinkMass:
    if mass.link not in links:
        return mass
    return replace(mass, mass=mass.mass * force, inertia=mass.inertia * couple)


def _gear_slips(motion: Motion) -> Iterator[Alteration]:
    """The slips in the teeth and the carrier of each mesh, at the one position of a motion."""
    if not motion.scene.gears or not motion.ok[0]:
        return
    scene, each = _standing_here(motion), 1.0 / len(motion.scene.gears)

    def slip(key: str, gear: PlacedGear, share: float, instead: Mapping[HigherPair, PlacedGear]) -> Alteration:
        pairs = tuple(instead.get(pair, pair) for pair in scene.higher_pairs)
        return Phrase(key, name=gear.name), share * each, partial(_motions, replace(scene, higher_pairs=pairs))

    for gear in scene.gears:
        first, second = gear.teeth
        if second is not None:
            turned = replace(gear, teeth=(math.copysign(second, first), math.copysign(first, second)))
            outside = replace(gear, teeth=(first, -second))
            yield slip("slip teeth exchanged", gear, 0.08, {gear: turned})
            yield slip("slip teeth sense", gear, 0.1, {gear: outside})
        if scene.frame.name not in (gear.carrier, *gear.bodies):
            standing = replace(gear, carrier=scene.frame.name)
            yield slip("slip carrier", gear, 0.1, {gear: standing})
        if second is not None and len(scene.gears) > 1:  # of the wheels themselves, where they mesh with others too
            swapped = {(gear.bodies[0], abs(first)): abs(second), (gear.bodies[1], abs(second)): abs(first)}
            yield slip("slip teeth exchanged", gear, 0.08, {g: _with(g, swapped) for g in scene.gears})


def _motions(scene: Mechanism) -> Values:
    """Velocities, accelerations and rates (SI) of a scene; no values where it cannot move."""
    motion = solve(scene)

    def value(symbol: Symbol) -> Value | None:
        there = motion.ok[0] and symbol.scope == "motion"
        return _finite(symbol, value_of(motion, symbol)[0]) if there else None

    return value


def _standing_here(motion: Motion) -> Mechanism:
    """The scene with its drivers and wheels at the motion's position."""
    scene = motion.scene
    places = (float(value) for value in motion.values[0])
    drivers = tuple(replace(d, value=value) for d, value in zip(scene.drivers, places, strict=True))
    angles = {name: float(np.angle(motion.poses[name].u[0])) for name in scene.by_name if name in motion.poses}
    starts = {**scene.starts, **{wheel: angles[wheel] for g in scene.gears for wheel in g.bodies if wheel in angles}}
    return replace(scene, drivers=drivers, starts=starts)


def _with(gear: PlacedGear, numbers: Mapping[tuple[str, float], float]) -> PlacedGear:
    """A mesh with other numbers of teeth, given by link and old number; a rack has none."""
    first, second = (
        z if z is None else math.copysign(numbers.get((link, abs(z)), abs(z)), z)
        for link, z in zip(gear.bodies, gear.teeth, strict=True)
    )
    return replace(gear, teeth=(first or gear.teeth[0], second))
