"""Vectors that are nothing but rounding are zero, and what was measured from them.

Exact hands lose some 1e-16 of the largest vector, and more where lines cross at a small angle.  A normal component is
v squared over a length, and so is as certain as the velocity that it comes from, however short.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from graphkin.construction.seen_from import vectors_seen
from graphkin.construction.sheet import Rate, Remark, Sheet
from graphkin.construction.steps import Aid, DiagramName, Step, Stroke, Vector
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import greatest_before
from graphkin.words import Phrase

__all__ = ["MOST_LOST", "without_residues"]

LOST = 1e-13  # of the largest vector, by rounding, where lines cross square
MOST_LOST = 1e-9  # what is larger is no residue, however lines cross


def without_residues(sheet: Sheet) -> Sheet:
    """A sheet of exact hands, each vector that is nothing but rounding made zero, with the rates measured from it."""
    zero = _residues(sheet)
    if not zero:
        return sheet
    rates = {
        "omega": _rates(sheet.omega, zero, sheet.scales.velocity / sheet.scales.length),
        "alpha": _rates(sheet.alpha, zero, sheet.scales.acceleration / sheet.scales.length),
    }
    return replace(
        sheet,
        steps=tuple(_step(step, zero, rates) for step in sheet.steps),
        omega=rates["omega"],
        alpha=rates["alpha"],
        noticed=tuple(
            (name, replace(remark, size=0.0) if remark.key == "zero vector" and remark.of[0] in zero else remark)
            for name, remark in sheet.noticed
        ),
    )


def _residues(sheet: Sheet) -> frozenset[Symbol]:
    scales, size = sheet.scales, sheet.scene.size
    velocity, acceleration = _drawn(sheet, "velocity"), _drawn(sheet, "acceleration")
    fastest, pushed = _largest(sheet, velocity), _largest(sheet, acceleration)
    lost_before, lost = _lost(sheet, ("mechanism", "velocity")), _lost(sheet, ("mechanism", "velocity", "acceleration"))
    zero = {s for s, vector in velocity.items() if 0.0 < abs(vector.span) <= lost_before(s) * fastest(s)}
    still = zero | {symbol for symbol, vector in velocity.items() if vector.span == 0.0}
    fixed, touching = sheet.scene.frame.points, {c.name for c in sheet.scene.contacts}

    def residue(symbol: Symbol) -> float:
        # a motion without acceleration still has velocities, whose rounding is carried on as v squared over a length
        most = pushed(symbol)
        carried = max(most, (fastest(symbol) * scales.velocity) ** 2 / size / scales.acceleration) * lost(symbol)
        # beside a dead point v squared over a length far exceeds all accelerations
        return min(carried, MOST_LOST * most) if most > carried else carried

    for symbol, vector in acceleration.items():
        # at a contact the curvatures give a normal part where nothing slides too
        squares = () if symbol.of is not None and symbol.of.point in touching else _speeds(symbol, fixed)
        speed = next((s for s in squares if s in velocity), None)
        nothing = abs(vector.span) <= residue(symbol) if speed is None else speed in still
        if nothing and vector.span != 0.0:
            zero.add(symbol)
    return frozenset(zero)


def _drawn(sheet: Sheet, diagram: DiagramName) -> dict[Symbol, Vector | Aid]:
    """The vectors of a diagram, those among them that are seen from a held link."""
    return {**{one.symbol: one for one in vectors_seen(sheet, diagram)}, **sheet.vectors(diagram)}


def _largest(sheet: Sheet, vectors: Mapping[Symbol, Vector | Aid]) -> Callable[[Symbol], float]:
    """The largest vector that leads to one (mm)."""
    return greatest_before(sheet.structure, ((symbol, abs(vector.span)) for symbol, vector in vectors.items()))


def _lost(sheet: Sheet, diagrams: tuple[DiagramName, ...]) -> Callable[[Symbol], float]:
    """What rounding may have cost of a vector, as a part of the largest that leads to it."""
    sharp = [(_crossing(r), 1.0 / max(r.size, 1e-9))
             for name, r in sheet.noticed if name in diagrams and r.key == "sharp crossing"]  # fmt: skip
    sharpest = greatest_before(sheet.structure, sharp)
    return lambda symbol: min(MOST_LOST, LOST * max(sharpest(symbol), 1.0) ** 2)


def _crossing(remark: Remark) -> Symbol:
    """What a crossing finds, as a quantity: its own, or the velocity of a point or of links."""
    (of,) = remark.of
    if isinstance(of, Phrase):
        return Symbol("omega", link=str(of.args[0]).split(", ")[0])
    try:
        return Symbol.parse(str(of))
    except ValueError:
        return Symbol("v", PointRef(str(of)))


def _speeds(symbol: Symbol, fixed: Mapping[str, complex]) -> tuple[Symbol, ...]:
    """The velocity whose square a normal component is: relative, or from the pole where its start is fixed."""
    if symbol.kind != "an" or symbol.to is None:
        return ()
    return (Symbol("v", symbol.of, symbol.to), *((Symbol("v", symbol.of),) if symbol.to.point in fixed else ()))


def _step(step: Step, zero: frozenset[Symbol], rates: Mapping[str, Mapping[str, Rate]]) -> Step:
    strokes: tuple[Stroke, ...] = tuple(
        replace(s, tip=s.tail) if isinstance(s, Vector | Aid) and s.symbol in zero else s for s in step.strokes
    )
    step = replace(step, strokes=strokes)
    if step.reason == "sum of rates":
        return replace(step, value=rates[step.kind][step.links[0]].value)
    if step.symbol not in zero:
        return step
    if step.reason == "rate":
        return replace(step, value=0.0)
    return replace(step, mm=0.0) if step.mm else step


def _rates(rates: Mapping[str, Rate], zero: frozenset[Symbol], per_mm: float) -> dict[str, Rate]:
    """Rates without what came from residues; a driver's own rate on top of one stays."""
    found = {}
    for name, rate in rates.items():
        if rate.vector in zero:
            residue = rate.mm / rate.arm_mm * per_mm if rate.arm_mm else 0.0
            rate = replace(rate, value=0.0 if abs(rate.value) <= 2.0 * residue else rate.value, mm=0.0)
        found[name] = rate
    return found
