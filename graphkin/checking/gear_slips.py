"""The usual slips with wheels: what the motion of a position would be with each of them.

Those that teachers of gear trains name: the numbers of teeth exchanged, external teeth taken for internal ones (the
sense), the carrier of an epicyclic train taken as standing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from graphkin.checking.slip_likelihood import Slipped
from graphkin.errors import GraphkinError
from graphkin.scene.contacts import PlacedGear
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.scene.symbol import Symbol, Value
from graphkin.solver import Motion, solve, value_of
from graphkin.words import Phrase

__all__ = ["slipped_gears"]


def slipped_gears(motion: Motion) -> tuple[Slipped, ...]:
    """The one position of a motion with each slip."""
    if not motion.scene.gears or not motion.ok[0]:
        return ()
    here = _standing_here(motion)
    made = []
    for phrase, share, gears in _slips(here):
        try:
            other = solve(replace(here, gears=gears))
        except (GraphkinError, ArithmeticError):
            continue  # with this slip nothing moves, so nobody's value comes from it
        if other.ok[0]:
            made.append(Slipped(phrase, share, partial(_value, other)))
    return tuple(made)


def _value(motion: Motion, symbol: Symbol) -> Value | None:
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
        replace(d, angle=value) if isinstance(d, AngleDriver) else replace(d, travel=value)
        for d, value in zip(scene.drivers, places, strict=True)
    )
    angles = {name: float(np.angle(motion.poses[name].u[0])) for name in scene.by_name if name in motion.poses}
    starts = {**scene.starts, **{wheel: angles[wheel] for g in scene.gears for wheel in g.wheels if wheel in angles}}
    return replace(scene, drivers=drivers, starts=starts)


def _slips(scene: Mechanism) -> Iterator[tuple[Phrase, float, tuple[PlacedGear, ...]]]:
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
