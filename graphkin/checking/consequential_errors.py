"""What follows from somebody's own values: the drawing gone on with from them, in place of the drawn ones."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from graphkin.construction import GoneOn, Plan, Sheet, Slip
from graphkin.construction.sizes import Component, Order
from graphkin.errors import GraphkinError
from graphkin.plane import added_up
from graphkin.scene.symbol import PointRef, Symbol, Value

__all__ = ["Consequences"]


class Consequences:
    """What follows on a drawing from somebody's own values of what is drawn before; ``base`` is the plan drawn without
    them."""

    def __init__(self, plan: Plan, base: Sheet) -> None:
        self.base = base
        self.drawing = GoneOn(plan, plan.scales, lambda own: _Inputs(plan, base, own).slip)
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


@dataclass(frozen=True)
class _Inputs:
    plan: Plan
    base: Sheet
    own: Mapping[Symbol, Value]

    @property
    def slip(self) -> Slip:
        return Slip(self.term, self.found, self.rate)

    def term(self, part: Component) -> Component:
        """A known term with the person's own size, or made from the person's own velocities."""
        if part.span is None:
            return part
        scale = self.base.scales.velocity if part.symbol.kind == "v" else self.base.scales.acceleration
        if part.symbol in self.own:
            return replace(part, span=_sized(self.own[part.symbol], part.span, scale))
        of, to = part.symbol.of, part.symbol.to
        drawn = self.base.vectors("acceleration").get(part.symbol)
        if of is None or drawn is None:
            return part
        if part.role == "coriolis":
            factor = self._ratio(Symbol("v", of, to)) * self._ratio(self._guide_turns(of, to))
            return replace(part, span=drawn.span * factor) if factor != 1.0 else part
        if part.role == "normal":
            factor = abs(self._ratio(Symbol("v", of, to))) * abs(self._ratio(Symbol("v", of)) if self._fixed(to) else 1)
            return replace(part, span=drawn.span * factor**2) if factor != 1.0 else part
        return part

    def found(self, symbol: Symbol, tail: complex, tip: complex) -> complex:
        if symbol not in self.own:
            return tip
        scale = self.base.scales.velocity if symbol.kind == "v" else self.base.scales.acceleration
        return tail + _sized(self.own[symbol], tip - tail, scale)

    def rate(self, symbol: Symbol, value: float) -> float | None:
        own = self.own.get(symbol)
        return None if own is None else float(own.real)

    def _ratio(self, symbol: Symbol | None) -> float:
        """The person's value over the drawn one, 1 where there is none."""
        if symbol is None or symbol not in self.own:
            return 1.0
        own = self.own[symbol]
        if symbol.is_vector:
            drawn = self.base.vectors("velocity").get(symbol)
            size = abs(drawn.span) * self.base.scales.velocity if drawn else 0.0
            return abs(own) / size if size else 1.0
        rate = self.base.omega.get(symbol.link)
        return float(own.real) / rate.value if rate and rate.value else 1.0

    def _guide_turns(self, of: PointRef, to: PointRef | None) -> Symbol | None:
        """The angular velocity of the guide between two coincident points, or of the link from which one is seen."""
        links = {r.link for r in (of, to) if r}
        for slide in self.plan.structure.slides:
            if slide.pin == of.point and links & {slide.a, slide.b}:
                return Symbol("omega", link=slide.b)
        return Symbol("omega", link=to.link) if to and to.link else None  # a link of a contour, held still

    def _fixed(self, to: PointRef | None) -> bool:
        return to is None or to.point in self.plan.structure.scene.frame.points


def _sized(own: Value, drawn: complex, scale: float) -> complex:
    """A vector on paper with somebody's own size, or their own components."""
    if isinstance(own, complex):
        return own / scale
    return drawn / abs(drawn) * (abs(own) / scale) if drawn else drawn
