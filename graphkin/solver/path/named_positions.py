"""Positions by name: numbered over a turn, at a driver's value, or at a place of a stroke."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from graphkin.errors import GraphkinError, Problem, SceneError, Unsolvable
from graphkin.scene.model import Driver, Mechanism
from graphkin.scene.scene_tables import StrokeStart
from graphkin.scene.symbol import Symbol
from graphkin.search import last_true
from graphkin.solver.algebra.pose import Array
from graphkin.solver.mobility import structure_of
from graphkin.solver.path.driver_range import DriverRange, extremes, range_of

TRIES = 24
SAME = 1e-9


def named_positions(scene: Mechanism) -> Mapping[str, float]:
    """The value of the first driver at each position that a scene names (rad, m), an angle within half a turn of the
    driver's own; empty where it names none.

    Raises
    ------
    Unsolvable : a position lies on the stroke of a slide, but there is no whole turn
    """
    positions = scene.question.positions
    if positions is None:
        return {}
    reach = range_of(structure_of(scene))
    driver, first = reach.scene.drivers[0], first_position(reach)
    sense, start = -1.0 if driver.values[1] < 0 else 1.0, driver.values[0]
    values = {name: _value(reach, positions.place(name, first, sense)) for name in positions.names}
    if driver.turns:
        return {name: start + math.remainder(value - start, math.tau) for name, value in values.items()}
    return values


def first_position(reach: DriverRange) -> float:
    """The value of the first driver at position 1 (rad, m): by default the driver's own.  Raises as
    ``named_positions``."""
    positions = reach.scene.question.positions
    first = None if positions is None else positions.first
    return reach.scene.drivers[0].values[0] if first is None else _value(reach, first)


def _value(reach: DriverRange, place: float | StrokeStart | None) -> float:
    """The driver's value at a place, which may lie on a stroke."""
    assert place is not None
    if not isinstance(place, StrokeStart):
        return place
    limits = extremes(reach, Symbol.parse(f"stroke_{place.stroke}"))
    ends = (limits.low_offset, limits.low), (limits.high_offset, limits.high)
    (begin, start), (end, _) = ends if place.sense > 0 else ends[::-1]
    span, goal = (end - begin) % math.tau, start + place.sense * place.at * limits.stroke

    def before(part: Array) -> Array:
        travel = reach.motion((begin + part) % math.tau).slide(place.stroke)[0]
        return place.sense * (travel - goal) < 0.0

    part = span * place.at if place.at in (0.0, 1.0) else last_true(before, 0.0, span)
    return float(reach.value(np.array((begin + part) % math.tau)))


def name_at(scene: Mechanism, positions: Mapping[str, float], value: float) -> str:
    """The name of the position at a driver's value (rad, m), without whole turns; "" if it has none."""
    driver = scene.drivers[0]
    for name, position in positions.items():
        difference = math.remainder(value - position, math.tau) if driver.turns else (value - position) / scene.size
        if abs(difference) < SAME:
            return name
    return ""


def standing(scene: Mechanism) -> Mechanism:
    """A scene with the values and rates of its drivers computed: at a named position, at a distance from a dead point,
    and from the speed of a point.

    Raises
    ------
    Unsolvable : no position of the driver leads to the stroke that is named, or the point rests there
    """
    there = _at_its_position(scene)
    if any((d.distance is not None and not d.exact) or d.given_speed for d in there.drivers):
        return structure_of(there).scene
    return there


def _at_its_position(scene: Mechanism) -> Mechanism:
    """A scene with its driver at a named position, its value computed.

    The assembly is that of the position itself: the value is searched from positions around the turn, and taken where
    it reproduces itself.

    Raises
    ------
    Unsolvable : no position of the driver leads to the stroke that is named
    """
    first = scene.drivers[0] if scene.drivers else None
    if first is None or not first.position:
        return scene
    stop: GraphkinError | None = None
    for k in range(TRIES):
        guess = math.tau * k / TRIES
        for _ in range(3):
            try:
                here = _at(scene, first, guess)
                value = named_positions(here)[first.position]
            except (Unsolvable, SceneError) as error:
                stop = stop or error
                break
            if abs(math.remainder(value - guess, math.tau)) < 1e-12:
                return here
            guess = value
        else:
            return _at(scene, first, guess)
    raise stop or Unsolvable("not assembled", Problem("driver.position", "is not found", position=first.position))


def _at(scene: Mechanism, driver: Driver, value: float) -> Mechanism:
    turned = math.remainder(value, math.tau)
    return replace(scene, drivers=(driver.at_value(turned), *scene.drivers[1:]))
