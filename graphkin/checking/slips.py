"""What a wrong value may be instead: the right value of a common slip, with how common it is; or what follows from
somebody's own values, the drawing gone on with from them in place of the drawn ones.

The slips are those that teachers of the graphical method name (Sun Huan, Mechanical Principles, ch. 3; Norton, Design
of Machinery, ch. 6 and 7): a sign, a unit, the Coriolis term, one component in place of the whole, the scale of the
other polygon, another vector of the same polygon, the other assembly.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from graphkin.checking.readings import read_off
from graphkin.checking.slip_likelihood import Slipped, Suspect, Suspects
from graphkin.checking.uncertainty import Uncertainty
from graphkin.construction import GoneOn, Plan, Sheet, Slip, execute
from graphkin.construction.polygons import Component
from graphkin.construction.steps import Order
from graphkin.errors import GraphkinError
from graphkin.plane import added_up, unit
from graphkin.scene.model import LinkMass, Loading, LoadOn, Mechanism, PlacedGear, SpringOn
from graphkin.scene.symbol import PointRef, Symbol, Value
from graphkin.solver import Forces, Motion, forces_of, solve, value_of
from graphkin.structure import Pair
from graphkin.words import Phrase

__all__ = ["CANCELLING", "NOTHING", "Consequences", "Evidence", "ExpectedValue", "ValuesElsewhere", "slipped_forces"]

def _line_of(sheet: Sheet, symbol: Symbol) -> complex | None:
    """Unit vector of the positive sense of a vector symbol, None where nothing gives it one.

    A point that slides in the frame, and one that slides relative to a coincident one: the guide's sense.  A tangential
    acceleration: counter-clockwise.
    """
    if symbol.of is None:
        return None
    if symbol.kind == "at":
        start = sheet.points.get(PointRef(symbol.to.point)) if symbol.to else _pivot(sheet, symbol.of)
        end = sheet.points.get(PointRef(symbol.of.point))
        return 1j * unit(end - start) if start is not None and end is not None and end != start else None
    if symbol.kind not in ("v", "a", "ar"):
        return None
    for slide in sheet.structure.slides:
        if _along(sheet, slide, symbol):
            pose = sheet.poses.get(slide.b)
            return pose.axis * slide.guide.direction if pose else None
    return None


def _along(sheet: Sheet, slide: Pair, symbol: Symbol) -> bool:
    """Whether a vector lies along a guide."""
    of, to, frame = symbol.of, symbol.to, sheet.scene.frame.name
    assert of is not None
    if to is not None:
        both = {of.link, to.link} - {""}
        return slide.pin == of.point == to.point and both <= {slide.a, slide.b}
    slider = sheet.structure.links[slide.a]
    return slide.b == frame and (of.link == slide.a or (not of.link and of.point in slider.points))


def _pivot(sheet: Sheet, of: PointRef) -> complex | None:
    scene = sheet.scene
    for link in scene.links:
        if of.point in link.points and of.link in ("", link.name):
            fixed = next((p for p in link.points if p in scene.frame.points and p != of.point), None)
            if fixed:
                return sheet.points.get(PointRef(fixed))
    return None


NOTHING = 1e-9  # of the greatest value of its sort: what is smaller is zero
CANCELLING = ("motion", "position", "force")  # scopes of what may be a difference that leaves nothing


@dataclass(frozen=True)
class ExpectedValue:
    """What stated values of one symbol are held against (SI): the right value, without what is left where it cancels;
    the greatest exact value of its sort that is drawn; what a pencil keeps within (0 where nothing is predicted,
    infinite where it tells nothing); the unit vector of its positive sense, None where nothing gives it one."""

    right: Value
    largest: float
    bound: float
    line: complex | None


ValuesElsewhere = Callable[[Symbol], Sequence[tuple[str, Value]]]
RPM = 60.0 / math.tau
LENGTHS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
INCHES = ("in", "ft")
DEGREE = 180.0 / math.pi


@dataclass(frozen=True)
class Evidence:
    """Everything known of a scene at one position, against which values are judged.

    ``exact`` gives the exact value of a symbol, ``elsewhere`` its exact values at other positions with their names,
    ``variants`` those of other problems of a set, ``predicted`` the uncertainty of a pencil drawing.
    """

    plan: Plan
    exact: Callable[[Symbol], Value]
    predicted: Mapping[Symbol, Uncertainty]
    elsewhere: ValuesElsewhere
    variants: ValuesElsewhere = lambda symbol: ()
    motion: Motion | None = None

    @cached_property
    def slipped(self) -> tuple[Slipped, ...]:
        """The forces with each of their usual slips, and the motion with each of those in its wheels."""
        return (*slipped_forces(self.motion), *slipped_gears(self.motion)) if self.motion is not None else ()

    @cached_property
    def sheet(self) -> Sheet:
        """The plan drawn without a slip."""
        return execute(self.plan)

    @cached_property
    def consequences(self) -> Consequences:
        """What follows from somebody's own values."""
        return Consequences(self.plan, self.sheet)

    @cached_property
    def others(self) -> Mapping[Symbol, Value]:
        """The exact values of everything drawn."""
        return {r.symbol: self.exact(r.symbol) for r in read_off(self.sheet)}

    @cached_property
    def altered(self) -> tuple[Slipped, ...]:
        """The drawing with each slip in a term, and in each other assembly."""
        found = []
        for phrase, share, drawn in (*_assemblies(self.plan), *_terms(self.plan, self.sheet)):
            try:
                values = {r.symbol: r.value for r in read_off(drawn())}
            except (GraphkinError, ArithmeticError):
                continue  # with this slip nothing can be drawn, so nobody's value comes from it
            found.append(Slipped(phrase, share, values.get))
        return tuple(found)

    @cached_property
    def _held(self) -> dict[Symbol, ExpectedValue]:
        return {}

    def held(self, symbol: Symbol) -> ExpectedValue:
        """What stated values of a symbol are held against; worked out once."""
        if symbol not in self._held:
            exact = self.exact(symbol)
            alike = [abs(v) for s, v in self.others.items() if dimension(s) == dimension(symbol)]
            largest = max([abs(exact), *alike]) or math.inf
            residue = symbol.scope in CANCELLING and abs(exact) <= NOTHING * largest
            uncertainty = self.predicted.get(symbol)
            bound = uncertainty.bound if uncertainty else 0.0
            bound = math.inf if symbol.scope == "motion" and bound > largest else bound
            right = type(exact)(0.0) if residue else exact
            self._held[symbol] = ExpectedValue(right, largest, bound, _line_of(self.sheet, symbol))
        return self._held[symbol]

    @cached_property
    def _explanations(self) -> dict[Symbol, Suspects]:
        return {}

    def suspects(self, symbol: Symbol) -> Suspects:
        """Every explanation for a wrong value of a symbol; looked for once."""
        if symbol not in self._explanations:
            self._explanations[symbol] = Suspects(tuple(_suspects(self, symbol)))
        return self._explanations[symbol]


Altered = tuple[Phrase, float, Callable[[], Sheet]]


def _assemblies(plan: Plan) -> Iterator[Altered]:
    for i, branch in plan.branches.items():
        other = {**plan.branches, i: 1 - branch}
        yield Phrase("slip assembly"), 0.05, lambda other=other: execute(plan.with_branches(other))  # type: ignore[misc]


def _terms(plan: Plan, sheet: Sheet) -> Iterator[Altered]:
    roles = {"coriolis": [("left out", 0.0, 0.1), ("reversed", -1.0, 0.08), ("factor", 0.5, 0.04)],
             "normal": [("left out", 0.0, 0.05), ("reversed", -1.0, 0.04)]}  # fmt: skip
    for role, ways in roles.items():
        names = [v.symbol for v in sheet.vectors("acceleration").values() if v.role == role]
        groups = [(n,) for n in names] + ([tuple(names)] if len(names) > 1 else [])
        for group in groups:
            for way, factor, share in ways:
                shown = ", ".join(str(n) for n in group)
                phrase = Phrase(f"slip {role} {way}", (shown,))
                slip = Slip(term=_times(group, factor))
                yield phrase, share / len(groups), lambda slip=slip: execute(plan, slip=slip)  # type: ignore[misc]


def _times(symbols: tuple[Symbol, ...], factor: float) -> Callable[[Component], Component]:
    def changed(part: Component) -> Component:
        if part.span is None or part.symbol not in symbols:
            return part
        return replace(part, span=part.span * factor)

    return changed


def _suspects(case: Evidence, symbol: Symbol) -> Iterator[Suspect]:
    """Every explanation for a wrong value of a symbol."""
    exact = case.exact(symbol)
    yield Suspect(Phrase("slip sign"), -exact, 0.15)
    yield from _slipped(case.slipped, symbol, exact)
    gravity = abs(case.plan.structure.scene.loading.gravity)
    if gravity and symbol.kind in ("G", "Fi", "Mi"):
        yield Suspect(Phrase("slip kg for N"), exact / gravity, 0.08)
        yield Suspect(Phrase("slip N for kg"), exact * gravity, 0.08)
    if symbol.kind == "ak":
        yield Suspect(Phrase("slip coriolis factor", (str(symbol),)), exact / 2, 0.1)
    for altered in _slipped(case.altered, symbol, exact):
        yield altered
        yield Suspect(Phrase("slip and sign", (altered.phrase,)), -altered.value, 0.1 * altered.share)
    yield from _factors(case, symbol, exact)
    yield from _own_parts(case, symbol)
    yield from _relative(case, symbol, exact)
    yield from _others(case, symbol, exact)
    own = case.variants(symbol)
    for name, value in own:
        yield Suspect(Phrase("slip variant", (name,)), value, 0.3 / len(own))
    places = case.elsewhere(symbol)
    for name, value in places:
        yield Suspect(Phrase("slip position", (name,)), value, 0.05 / len(places), drawn=False)


def _slipped(slips: Sequence[Slipped], symbol: Symbol, exact: Value) -> Iterator[Suspect]:
    """The values of a symbol with each slip that changes it."""
    for slip in slips:
        value = slip.value(symbol)
        if value is not None and abs(value - exact) > 1e-6 * abs(exact):
            yield Suspect(slip.phrase, value, slip.share)


def _factors(case: Evidence, symbol: Symbol, exact: Value) -> Iterator[Suspect]:
    second = symbol.measure in ("acceleration", "angular acceleration")
    for power in (1, 2, 3):
        for factor in (10.0**power, 0.1**power):
            yield Suspect(Phrase("slip factor", (f"{factor:g}",)), exact * factor, 0.02)
    for name, factor in (("rpm", RPM), ("degrees", DEGREE)):
        for way in (factor, 1 / factor):
            yield Suspect(Phrase(f"slip {name}"), exact * way, 0.01 if symbol.is_vector else 0.03)
            if second:
                yield Suspect(Phrase(f"slip {name}"), exact * way**2, 0.01)
    by_rpm = any(d.rpm for d in case.plan.structure.scene.drivers)
    for factor in (60.0, 1 / math.tau):  # n taken for n/60, or n/60 for omega
        yield Suspect(Phrase("slip rpm"), exact * factor, 0.02 if by_rpm else 0.005)
    for factor in _other_lengths(case, symbol):
        yield Suspect(Phrase("slip factor", (f"{factor:.4g}",)), exact * factor, 0.02)
    yield Suspect(Phrase("slip double"), exact * 2, 0.02)
    yield Suspect(Phrase("slip half"), exact / 2, 0.02)
    scales, wanted = case.plan.scales, case.plan.structure.scene.question.sheet
    if symbol.scope != "motion":
        return
    if wanted.velocity_scale and wanted.acceleration_scale:
        ratio = scales.velocity / scales.acceleration
        phrase = Phrase("slip velocity scale") if second else Phrase("slip acceleration scale")
        yield Suspect(phrase, exact * (ratio if second else 1 / ratio), 0.05)
    given = wanted.acceleration_scale if second else wanted.velocity_scale
    if given and symbol.is_vector:
        # the length on paper written down as if it were the value, in scene units
        yield Suspect(Phrase("slip millimetres"), exact / given, 0.05)


def _other_lengths(case: Evidence, symbol: Symbol) -> Iterator[float]:
    """What a value is multiplied by in another unit of length, where powers of ten do not say it: in and ft."""
    own = case.plan.structure.scene.units.length
    if own in INCHES and symbol.measure in ("velocity", "acceleration", "length"):
        yield from (LENGTHS[own] / metres for unit, metres in LENGTHS.items() if unit != own)


def _relative(case: Evidence, symbol: Symbol, exact: Value) -> Iterator[Suspect]:
    """What is relative to another point of the same link, or to a link that one is joined to, in place of the whole."""
    scene = case.plan.structure.scene
    if symbol.kind in ("omega", "alpha"):
        beside = _beside(scene, symbol.link)
        for name in beside:
            value = exact - case.exact(Symbol(symbol.kind, link=name))
            yield Suspect(Phrase("slip relative rate", (name,)), value, 0.08 / len(beside))
        return
    if symbol.kind not in ("v", "a") or symbol.of is None or symbol.to is not None:
        return
    for link in scene.links:
        if symbol.of.point not in link.points or symbol.of.link not in ("", link.name):
            continue
        others = [Symbol(symbol.kind, symbol.of, PointRef(p)) for p in link.points if p != symbol.of.point]
        for other in others:
            if other not in case.others and other.to and other.to.point not in scene.frame.points:
                value = exact - case.exact(Symbol(symbol.kind, other.to))
                yield Suspect(Phrase("slip relative", (str(other),)), value, 0.08 / len(others))


def _beside(scene: Mechanism, link: str) -> tuple[str, ...]:
    """The moving links that share a turning pair with one, or carry it as a wheel."""
    own = next((k.points for k in scene.links if k.name == link), {})
    carriers = {g.carrier for g in scene.gears if link in g.wheels} - {scene.frame.name}
    return tuple(k.name for k in scene.links if k.name != link and (k.name in carriers or set(k.points) & set(own)))


def _own_parts(case: Evidence, symbol: Symbol) -> Iterator[Suspect]:
    """One component of an acceleration in place of the whole."""
    if symbol.kind != "a":
        return
    for other, value in case.others.items():
        key = {"an": "normal", "at": "tangential", "ak": "coriolis", "ar": "sliding"}.get(other.kind)
        if key and other.of == symbol.of:
            yield Suspect(Phrase(f"slip {key} only", (str(other),)), value, 0.05)
    for other in _about_pivots(case, symbol):
        key = "normal" if other.kind == "an" else "tangential"
        yield Suspect(Phrase(f"slip {key} only", (str(other),)), case.exact(other), 0.05)


def _about_pivots(case: Evidence, symbol: Symbol) -> Iterator[Symbol]:
    """The components about a fixed pivot of a point found by the image, where no such vector is drawn."""
    if symbol.of is None or symbol.to is not None:
        return
    scene = case.plan.structure.scene
    for link in scene.links:
        if symbol.of.link in ("", link.name) and symbol.of.point in link.points:
            for pivot in sorted(set(link.points) & set(scene.frame.points) - {symbol.of.point}):
                about = (Symbol(kind, symbol.of, PointRef(pivot)) for kind in ("an", "at"))
                yield from (other for other in about if other not in case.others)


def _others(case: Evidence, symbol: Symbol, exact: Value) -> Iterator[Suspect]:
    alike = [(o, v) for o, v in case.others.items() if o != symbol and dimension(o) == dimension(symbol)]
    for other, value in alike:
        relative = symbol.to is None and other.to is not None and other.of is not None and symbol.of is not None
        if relative and other.of and symbol.of and other.of.point == symbol.of.point and other.kind == symbol.kind:
            yield Suspect(Phrase("slip relative", (str(other),)), value, 0.08)
        else:
            yield Suspect(Phrase("slip other", (str(other),)), value, 0.1 / len(alike))
    if not symbol.is_vector:
        return
    for other, value in ((symbol, exact), *alike):
        for axis, part in (("x", value.real), ("y", value.imag)):
            if abs(part) > 1e-6 * abs(value) and abs(abs(part) - abs(value)) > 1e-6 * abs(value):
                own = other == symbol
                key = "slip component" if own else "slip other component"
                yield Suspect(Phrase(key, (axis, str(other))), part, 0.05 if own else 0.05 / len(alike))


def dimension(symbol: Symbol) -> str:
    """Quantities of one dimension bear one name."""
    if symbol.scope != "motion":
        return symbol.measure
    if not symbol.is_vector:
        return symbol.kind
    return "v" if symbol.kind == "v" else "a"


# -- what follows from somebody's own values ---------------------------------------------------------------------------


class Consequences:
    """What follows on a drawing from somebody's own values of what is drawn before; ``base`` is the plan drawn without
    them."""

    def __init__(self, plan: Plan, base: Sheet) -> None:
        self.base = base
        self.drawing = GoneOn(plan, plan.scales, lambda own: _own_values(plan, base, own))
        self.steps: dict[Symbol, float] = {}

    def values(self, own: Mapping[Symbol, Value], of: Symbol) -> tuple[Value, ...]:
        """What a symbol comes to, drawn on from somebody's own values of other symbols (SI).

        Parameters
        ----------
        own : the values taken for granted, those of them that are drawn before it; of a vector given by its size the
            direction stays as drawn
        of : what is asked; its own value is not used

        Returns
        -------
        The value of the drawing, then for a sum of terms the sum of these
        """
        try:
            polygons = self.drawing.to(of, {s: v for s, v in own.items() if self.before(s, of)})
        except (GraphkinError, ArithmeticError):
            return ()  # a drawing that cannot be gone on with
        if polygons is None:
            return ()
        order: Order = "velocity" if of.kind in ("v", "omega") else "acceleration"
        if not of.is_vector:
            return (polygons.rates[order][of.link].value,)
        drawn, scale = polygons.drawn[order], self.base.scales.of(order)
        values: list[Value] = [drawn[of].span * scale]
        for equation in polygons.board.equations:
            if not any(len(side) == 1 and side[0].symbol == of for side in equation.sides):
                continue
            for side in equation.sides:
                spans = [drawn[t.symbol].span for t in side if t.symbol in drawn]
                if len(side) > 1 and len(spans) == len(side):
                    values.append(added_up(spans, 0j) * scale)
        return tuple(values)

    def before(self, one: Symbol, other: Symbol) -> bool:
        """Whether a quantity is known on the drawing before another, which can then follow from it."""
        return self._step(one) < self._step(other)

    def _step(self, symbol: Symbol) -> float:
        if symbol not in self.steps:
            self.steps[symbol] = _step(self.base, symbol)
        return self.steps[symbol]


def _step(sheet: Sheet, symbol: Symbol) -> float:
    """When a quantity is known on the drawing; a rate follows the vector that it is measured from."""
    if symbol.scope != "motion":
        return 0.0
    if not symbol.is_vector:
        rate = (sheet.omega if symbol.kind == "omega" else sheet.alpha).get(symbol.link)
        if rate is not None and rate.same_as:
            return _step(sheet, Symbol(symbol.kind, link=rate.same_as))
        return _step(sheet, rate.vector) + 0.5 if rate is not None and rate.vector else 0.0
    return float(sheet.drawn_in.get(symbol, math.inf))


def _own_values(plan: Plan, base: Sheet, own: Mapping[Symbol, Value]) -> Slip:
    """The drawing gone on with from somebody's own values (SI) in place of the drawn ones."""

    def ratio(symbol: Symbol | None) -> float:
        """The person's value over the drawn one, 1 where there is none."""
        if symbol is None or symbol not in own:
            return 1.0
        if symbol.is_vector:
            drawn = base.vectors("velocity").get(symbol)
            size = abs(drawn.span) * base.scales.velocity if drawn else 0.0
            return abs(own[symbol]) / size if size else 1.0
        rate = base.omega.get(symbol.link)
        return float(own[symbol].real) / rate.value if rate and rate.value else 1.0

    def sized(symbol: Symbol, drawn: complex) -> complex:
        """A vector on paper with the person's own size, or their own components."""
        value = own[symbol]
        scale = base.scales.velocity if symbol.kind == "v" else base.scales.acceleration
        if isinstance(value, complex):
            return value / scale
        return drawn / abs(drawn) * (abs(value) / scale) if drawn else drawn

    def term(part: Component) -> Component:
        """A known term with the person's own size, or made from the person's own velocities."""
        if part.span is None:
            return part
        if part.symbol in own:
            return replace(part, span=sized(part.symbol, part.span))
        of, to = part.symbol.of, part.symbol.to
        drawn = base.vectors("acceleration").get(part.symbol)
        if of is None or drawn is None or part.role not in ("coriolis", "normal"):
            return part
        if part.role == "coriolis":
            factor = ratio(Symbol("v", of, to)) * ratio(_guide_turns(plan, of, to))
        else:
            fixed = to is None or to.point in plan.structure.scene.frame.points
            factor = (abs(ratio(Symbol("v", of, to))) * abs(ratio(Symbol("v", of)) if fixed else 1)) ** 2
        return replace(part, span=drawn.span * factor) if factor != 1.0 else part

    def found(symbol: Symbol, tail: complex, tip: complex) -> complex:
        return tail + sized(symbol, tip - tail) if symbol in own else tip

    def rate(symbol: Symbol, value: float) -> float | None:
        return float(own[symbol].real) if symbol in own else None

    return Slip(term, found, rate)


def _guide_turns(plan: Plan, of: PointRef, to: PointRef | None) -> Symbol | None:
    """The angular velocity of the guide between two coincident points, or of the link from which one is seen."""
    links = {r.link for r in (of, to) if r}
    for slide in plan.structure.slides:
        if slide.pin == of.point and links & {slide.a, slide.b}:
            return Symbol("omega", link=slide.b)
    return Symbol("omega", link=to.link) if to and to.link else None  # a link of a contour, held still


# -- slips in forces and gears -----------------------------------------------------------------------------------------


def slipped_forces(motion: Motion) -> tuple[Slipped, ...]:
    """The forces at the one position of a motion with each slip."""
    if not motion.scene.loading or not motion.ok[0]:
        return ()
    made = []
    for phrase, share, loading in _force_slips(motion):
        scene = replace(motion.scene, loading=loading)
        there = replace(motion, structure=replace(motion.structure, scene=scene))
        made.append(Slipped(phrase, share, partial(_force_value, forces_of(there))))
    return tuple(made)


def _force_value(forces: Forces, symbol: Symbol) -> Value | None:
    """A force (N) or moment (N m), None for what there is not."""
    found = forces.value(str(symbol.here))
    if found is None or not np.isfinite(found[0]):
        return None
    return complex(found[0]) if symbol.is_vector else float(found[0].real)


def _force_slips(motion: Motion) -> Iterator[tuple[Phrase, float, Loading]]:
    loading = motion.scene.loading
    masses, loads, idle = loading.masses, *_standing(motion)
    down = loading.gravity
    weights = tuple(_weight(mass, mass.mass * down) for mass in masses) if down else ()

    def with_all(
        masses: Sequence[LinkMass] = masses, weights: Sequence[LoadOn] = weights, loads: Sequence[LoadOn] = loads,
        springs: Sequence[SpringOn] = loading.springs,
    ) -> Loading:  # fmt: skip
        return Loading(0j, tuple(masses), (*weights, *loads), loading.balance, springs=tuple(springs))

    some = [(mass.link,) for mass in masses]
    every = [tuple(mass.link for mass in masses)] if len(masses) > 1 else []
    for links in (*some, *every):
        shown, share = ", ".join(links), 1.0 / len((*some, *every))
        if down:
            without = [weight for weight in weights if weight.link not in links]
            yield Phrase("slip weight left out", (shown,)), 0.15 * share, with_all(weights=without)
        turned = [_scaled(mass, links, -1.0, -1.0) for mass in masses]
        yield Phrase("slip inertia force with", (shown,)), 0.15 * share, with_all(turned)
        none = [_scaled(mass, links, 0.0, 0.0) for mass in masses]
        yield Phrase("slip inertia force left out", (shown,)), 0.1 * share, with_all(none)
        if any(mass.inertia for mass in masses if mass.link in links):
            flat = [_scaled(mass, links, 1.0, 0.0) for mass in masses]
            yield Phrase("slip inertia left out", (shown,)), 0.12 * share, with_all(flat)
            other = [_scaled(mass, links, 1.0, -1.0) for mass in masses]
            yield Phrase("slip arm side", (shown,)), 0.1 * share, with_all(other)
    if down:
        small = tuple(replace(weight, size=weight.size / abs(down)) for weight in weights)
        yield Phrase("slip kg for N"), 0.08, with_all(weights=small)
        heavy = [_scaled(mass, every[0] if every else some[0], abs(down), 1.0) for mass in masses]
        yield Phrase("slip N for kg"), 0.08, with_all(heavy)
    for load in loads:
        others = [one for one in loads if one is not load]
        phrase = Phrase("slip load left out", (load.name,))
        yield phrase, 0.1 / len(loads), with_all(loads=others)
        turned_round = [*others, replace(load, size=-load.size)]
        yield Phrase("slip load reversed", (load.name,)), 0.06 / len(loads), with_all(loads=turned_round)
    for spring in loading.springs:
        besides, each = [one for one in loading.springs if one is not spring], 1.0 / len(loading.springs)
        yield Phrase("slip spring left out", (spring.name,)), 0.1 * each, with_all(springs=besides)
        pushing = replace(spring, rate=-spring.rate, preload=-spring.preload)
        yield Phrase("slip spring reversed", (spring.name,)), 0.06 * each, with_all(springs=[*besides, pushing])
        whole = replace(spring, free=0.0)
        yield Phrase("slip free length", (spring.name,)), 0.1 * each, with_all(springs=[*besides, whole])
    for load in idle:
        yield Phrase("slip load not here", (load.name,)), 0.15 / len(idle), with_all(loads=(*loads, load))


def _standing(motion: Motion) -> tuple[tuple[LoadOn, ...], tuple[LoadOn, ...]]:
    """The loads that act at the position, and those that do not, each as it stands there."""
    scene = motion.scene
    here = forces_of(motion)
    always = Loading(
        0j, scene.loading.masses, tuple(replace(load, phase=None) for load in scene.loading.loads),
        scene.loading.balance, springs=scene.loading.springs,
    )  # fmt: skip
    there = forces_of(replace(motion, structure=replace(motion.structure, scene=replace(scene, loading=always))))
    acting: list[LoadOn] = []
    idle: list[LoadOn] = []
    for load in scene.loading.loads:
        key = f"P_{load.name}"
        table, whole = (here.forces, there.forces) if load.is_force else (here.moments, there.moments)
        acts, value = bool(table[key][0]), whole[key][0]
        if not value:
            continue
        bare = replace(load, phase=None)
        if load.is_force:
            bare = replace(bare, size=abs(value), turn=complex(value / abs(value)), follows="", against="")
        (acting if acts else idle).append(bare)
    return tuple(acting), tuple(idle)


def _weight(mass: LinkMass, force: complex) -> LoadOn:
    return LoadOn(f"weight{mass.link}", mass.link, abs(force), True, mass.at, force / abs(force))


def _scaled(mass: LinkMass, links: Sequence[str], force: float, couple: float) -> LinkMass:
    if mass.link not in links:
        return mass
    return replace(mass, mass=mass.mass * force, inertia=mass.inertia * couple)


def slipped_gears(motion: Motion) -> tuple[Slipped, ...]:
    """The one position of a motion with each slip."""
    if not motion.scene.gears or not motion.ok[0]:
        return ()
    here = _standing_here(motion)
    made = []
    for phrase, share, gears in _gear_slips(here):
        try:
            other = solve(replace(here, gears=gears))
        except (GraphkinError, ArithmeticError):
            continue  # with this slip nothing moves, so nobody's value comes from it
        if other.ok[0]:
            made.append(Slipped(phrase, share, partial(_gear_value, other)))
    return tuple(made)


def _gear_value(motion: Motion, symbol: Symbol) -> Value | None:
    """A velocity, an acceleration or a rate (SI), None for anything else."""
    if symbol.scope != "motion":
        return None
    found = value_of(motion, symbol)[0]
    if not np.isfinite(found):
        return None
    return complex(found) if symbol.is_vector else float(found.real)


def _standing_here(motion: Motion) -> Mechanism:
    """The scene with its drivers and wheels where the motion has them."""
    scene = motion.scene
    places = (float(value) for value in motion.values[0])
    drivers = tuple(
        replace(d, value=value) for d, value in zip(scene.drivers, places, strict=True)
    )
    angles = {name: float(np.angle(motion.poses[name].u[0])) for name in scene.by_name if name in motion.poses}
    starts = {**scene.starts, **{wheel: angles[wheel] for g in scene.gears for wheel in g.wheels if wheel in angles}}
    return replace(scene, drivers=drivers, starts=starts)


def _gear_slips(scene: Mechanism) -> Iterator[tuple[Phrase, float, tuple[PlacedGear, ...]]]:
    frame, each = scene.frame.name, 1.0 / len(scene.gears)
    for gear in scene.gears:
        ways: list[tuple[str, float, PlacedGear]] = []
        one, two = gear.teeth
        if two is not None:
            turned = replace(gear, teeth=(math.copysign(two, one), math.copysign(one, two)))
            ways = [("slip teeth exchanged", 0.08, turned), ("slip teeth sense", 0.1, replace(gear, teeth=(one, -two)))]
        if frame not in (gear.carrier, *gear.wheels):
            ways.append(("slip carrier", 0.1, replace(gear, carrier=frame)))
        for key, share, other in ways:
            yield Phrase(key, (gear.name,)), share * each, tuple(other if g is gear else g for g in scene.gears)
        if two is not None and len(scene.gears) > 1:  # of the wheels themselves, where they mesh with others too
            swapped = {(gear.wheels[0], abs(one)): abs(two), (gear.wheels[1], abs(two)): abs(one)}
            gears = tuple(_with(g, swapped) for g in scene.gears)
            yield Phrase("slip teeth exchanged", (gear.name,)), 0.08 * each, gears


def _with(gear: PlacedGear, numbers: Mapping[tuple[str, float], float]) -> PlacedGear:
    """A mesh with other numbers of teeth, by link and number before; a rack has none."""
    one, two = (
        z if z is None else math.copysign(numbers.get((link, abs(z)), abs(z)), z)
        for link, z in zip(gear.wheels, gear.teeth, strict=True)
    )
    return replace(gear, teeth=(one or gear.teeth[0], two))
