"""Positions by name: numbered over a turn, at a driver's value, or at a place of a stroke."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphkin.errors import GraphkinError, Problem, SceneError, Unsolvable
from graphkin.scene.model import Driver, Mechanism
from graphkin.scene.scene_tables import Positions, StrokeStart
from graphkin.scene.symbol import Symbol
from graphkin.search import last_true
from graphkin.solver.driver_range import DriverRange, range_of
from graphkin.solver.mobility import structure_of
from graphkin.solver.pose import Array
from graphkin.words import Phrase

TRIES = 24
SAME = 1e-9


@dataclass(frozen=True)
class PlacesByName:
    """The positions that a scene names, and their values of the first driver."""

    names: Positions
    reach: DriverRange

    @cached_property
    def values(self) -> Mapping[str, float]:
        """The value of the first driver at each position (rad, m), an angle within half a turn of the driver's own.

        Raises
        ------
        Unsolvable : a position lies on the stroke of a slide, but there is no whole turn
        """
        sense = -1.0 if self.reach.driver.values[1] < 0 else 1.0
        own = self.reach.scene.drivers[0].values[0]
        found = {name: self._value(self.names.place(name, self.first, sense)) for name in self.names.names}
        if self.reach.driver.turns:
            return {name: own + math.remainder(value - own, math.tau) for name, value in found.items()}
        return found

    @cached_property
    def first(self) -> float:
        """The value at position 1: by default the driver's own."""
        first = self.names.first
        return self.reach.scene.drivers[0].values[0] if first is None else self._value(first)

    def _value(self, place: float | StrokeStart | None) -> float:
        assert place is not None
        return self._on_stroke(place) if isinstance(place, StrokeStart) else place

    def _on_stroke(self, place: StrokeStart) -> float:
        """The driver's value at a place of a stroke."""
        sliding, guiding = place.stroke.split("/")
        symbol = Symbol("stroke", link=sliding, other=guiding)
        found = self.reach.extremes(symbol)
        begin, end = (found.low_offset, found.high_offset) if place.sense > 0 else (found.high_offset, found.low_offset)
        span = (end - begin) % math.tau
        start = found.low if place.sense > 0 else found.high
        goal = start + place.sense * place.at * found.stroke

        def before(part: Array) -> Array:
            travel = self.reach.motion((begin + part) % math.tau).slide(place.stroke).travel
            return np.asarray(place.sense * (travel - goal) < 0.0)

        part = span * place.at if place.at in (0.0, 1.0) else last_true(before, 0.0, span)
        return float(self.reach.value(np.array((begin + part) % math.tau)))

    def name_of(self, value: float) -> str:
        """The name of the position at a driver's value (rad, m), without whole turns; "" if it has none."""
        turning = self.reach.driver.turns
        for name, own in self.values.items():
            off = math.remainder(value - own, math.tau) if turning else (value - own) / self.reach.scene.size
            if abs(off) < SAME:
                return name
        return ""


def named_positions(scene: Mechanism) -> PlacesByName | None:
    """The positions that a scene names; None where it names none.  Raises Unsolvable."""
    if scene.question.positions is None:
        return None
    return PlacesByName(scene.question.positions, range_of(structure_of(scene)))


def standing(scene: Mechanism) -> Mechanism:
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
                places = named_positions(here)
                assert places is not None
                value = places.values[first.position]
            except (Unsolvable, SceneError) as error:
                stop = stop or error
                break
            if abs(math.remainder(value - guess, math.tau)) < 1e-12:
                return here
            guess = value
        else:
            return _at(scene, first, guess)
    raise stop or Unsolvable(
        "not assembled", Problem("driver.position", Phrase("is not found", position=first.position))
    )


def _at(scene: Mechanism, driver: Driver, value: float) -> Mechanism:
    turned = math.remainder(value, math.tau)
    return replace(scene, drivers=(driver.at_value(turned), *scene.drivers[1:]))
