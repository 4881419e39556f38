"""Exact values by symbol at one position: of the motion, of the whole turn, and forces."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from graphkin.errors import CallError, Problem
from graphkin.scene.force_names import no_force
from graphkin.scene.symbol import Symbol, Value
from graphkin.solver.driver_range import DriverRange, driver_range
from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array
from graphkin.solver.solve import solve
from graphkin.words import Phrase

__all__ = ["exact_values", "senses_along", "value_of"]


def value_of(motion: Motion, symbol: Symbol) -> Array:
    """A quantity of the motion or a force by its symbol: complex for vectors, real for others (SI), shape (n,).

    Raises
    ------
    CallError : the symbol names nothing here
    Unsolvable : a load acts on a part of a stroke, or a flywheel is asked for, and the driver makes no whole turn
    """
    if symbol.scope not in ("force", "cycle"):
        return motion.value(symbol)
    problem = no_force(motion.scene, str(symbol), symbol)
    if problem is not None:
        raise CallError(problem)
    if symbol.scope == "cycle":
        from graphkin.solver.flywheel import flywheel_of

        wheel = flywheel_of(driver_range(motion.structure))
        return np.full(len(motion), wheel.excess if symbol.kind == "excess" else wheel.inertia)
    from graphkin.solver.forces import forces_of

    found = forces_of(motion).value(str(symbol.here))
    if found is None:
        raise CallError(Problem(str(symbol), Phrase("is read off the drawing alone"), Phrase("ask check for it")))
    return found


def senses_along(motion: Motion, symbol: Symbol) -> Array | None:
    """Unit vectors of the positive sense of a velocity or acceleration that lies along the straight guide of a sliding
    pair, shape (n,): of a point of what slides in the frame, and of coincident points relative to each other; None for
    any other symbol."""
    of, to, frame = symbol.of, symbol.to, motion.scene.frame.name
    if of is None or symbol.seen or symbol.kind not in ("v", "a", "ar"):
        return None
    for slide in motion.slides:
        if slide.guide.curvature:
            continue
        if to is None:
            mine = motion.structure.links[slide.a].points if slide.a in motion.structure.links else {}
            along = slide.b == frame and (of.link == slide.a or (not of.link and of.point in mine))
        else:
            along = slide.pin == of.point == to.point and {of.link, to.link} - {""} <= {slide.a, slide.b}
        if along:
            return np.asarray(motion.poses[slide.b].u * slide.guide.direction)
    return None


def exact_values(motion: Motion, asked: Sequence[Symbol] = ()) -> Callable[[Symbol], Value]:
    """What gives the exact value of a symbol at the one position of a motion (SI), those of the whole turn among the
    asked too.  Raises Unsolvable where there is no whole turn."""
    scene = motion.scene
    values = {d.key: float(v) for d, v in zip(scene.drivers, motion.values[0], strict=True)}
    of_turn: Mapping[Symbol, float] = {}
    if any(s.scope == "turn" for s in asked):
        reach = driver_range(motion.structure, values)
        of_turn = {s: _of_turn(reach, s) for s in asked if s.scope == "turn"}

    @cache
    def of_forces() -> Callable[[Symbol], Value]:
        from graphkin.solver.force_values import force_values

        return force_values(motion)[0]

    def value(symbol: Symbol) -> Value:
        if symbol in of_turn:
            return of_turn[symbol]
        if symbol.scope == "force" and no_force(scene.instead_of or scene, str(symbol), symbol) is None:
            return of_forces()(symbol)
        found = value_of(motion, symbol)[0]
        if symbol.kind == "d" and math.isnan(found):  # the centre of links at rest: that of any motion
            found = _in_motion(motion, values).value(symbol)[0]
        return complex(found) if symbol.is_vector else float(found.real)

    return value


def _of_turn(reach: DriverRange, symbol: Symbol) -> float:
    from graphkin.solver.whole_turn import extremes

    found = extremes(reach, symbol)
    return {"K": found.ratio, "theta_lag": found.lag}.get(symbol.kind, found.stroke)


def _in_motion(motion: Motion, values: Mapping[str, float]) -> Motion:
    """The same position with the first driver at unit speed."""
    scene, first = motion.scene, motion.scene.drivers[0]
    faster = replace(first, **{"omega" if first.turns else "velocity": 1.0})  # type: ignore[arg-type]
    return solve(replace(scene, drivers=(faster, *scene.drivers[1:])), at=values)
