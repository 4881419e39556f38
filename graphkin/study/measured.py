"""Motion measured off drawn polygons: position, velocity and acceleration of outputs at a few positions of a turn."""

from __future__ import annotations

import cmath
from collections.abc import Sequence

import numpy as np

from graphkin.construction import Plan, Sheet, execute, plan
from graphkin.errors import GraphkinError
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import DriverRange
from graphkin.study.quantities import Quantity

__all__ = ["measured"]


def measured(
    reach: DriverRange, outputs: Sequence[Quantity], count: int = 12
) -> dict[Quantity, list[tuple[float, ...]]]:
    """For each output (its angle or travel) what the drawing gives at evenly spread positions.

    Returns
    -------
    for each output a list of (offset of the driver, position, velocity, acceleration), SI, measured on paper; positions
    that cannot be drawn, or outputs that lie behind a group that compass and ruler cannot draw, are left out
    """
    scene = reach.scene
    asked = [s for q in outputs for s in _symbols(scene, q)]
    found: dict[Quantity, list[tuple[float, ...]]] = {q: [] for q in outputs}
    if not asked:
        return found
    low, high = reach.ends
    count *= max(reach.turns, 1)
    last: Plan | None = None
    sheet: Sheet | None = None
    for k in range(count):
        offset = low + (high - low) * (k / count if reach.full else (k + 0.5) / count)
        values = {d.key: float(v) for d, v in zip(scene.drivers, reach.start, strict=True)}
        values[scene.drivers[0].key] = float(reach.value(np.array(offset)))
        try:
            # the assembly is followed from the last position
            last = plan(reach.structure, values, asked, near=sheet, follows=last)
            sheet = execute(last)
        except GraphkinError:
            continue
        for quantity in outputs:
            read = _read(sheet, quantity)
            if read is not None:
                found[quantity].append((offset, *read))
    return found


def _symbols(scene: Mechanism, quantity: Quantity) -> list[Symbol]:
    if quantity.kind == "theta":
        return [Symbol("omega", link=quantity.of), Symbol("alpha", link=quantity.of)]
    pin = _pin(scene, quantity.of)
    return [Symbol("v", PointRef(pin)), Symbol("a", PointRef(pin))] if pin else []


def _pin(scene: Mechanism, key: str) -> str | None:
    """The first point of a link that slides along the frame."""
    return next((s.pin for s in scene.slidings if s.key == key and s.on == scene.frame.name), None)


def _read(sheet: Sheet, quantity: Quantity) -> tuple[float, float, float] | None:
    scene, name = sheet.scene, quantity.of
    if quantity.kind == "theta":
        if name not in sheet.poses or name not in sheet.omega or name not in sheet.alpha:
            return None
        return cmath.phase(sheet.poses[name].axis), sheet.omega[name].value, sheet.alpha[name].value
    pin = _pin(scene, name)
    pair = next(s for s in scene.slidings if s.key == name)
    guide = scene.frame.guides[pair.guide]
    speeds, pushes = sheet.vectors("velocity"), sheet.vectors("acceleration")
    if pin is None or PointRef(pin) not in sheet.points:
        return None
    v, a = speeds.get(Symbol("v", PointRef(pin))), pushes.get(Symbol("a", PointRef(pin)))
    if v is None or a is None:
        return None
    along = guide.direction.conjugate()
    place = sheet.points[PointRef(pin)] * sheet.scales.length
    arm = scene.by_name[pair.link].points[pin] * pair.turn
    return (
        ((place - guide.through) * along).real - arm.real,
        (v.span * along).real * sheet.scales.velocity,
        (a.span * along).real * sheet.scales.acceleration,
    )
