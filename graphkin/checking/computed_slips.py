"""The usual slips that are told by computing with each of them, not by drawing: in forces, and with wheels.

Those that teachers of kinetostatics name: a weight left out, an inertia force in the sense of the acceleration, kg for
N, the shifted inertia force on the wrong side, a load that does not act here, a moment of inertia left out.

Those that teachers of gear trains name: the numbers of teeth exchanged, external teeth taken for internal ones (the
sense), the carrier of an epicyclic train taken as standing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from graphkin.checking.slip_likelihood import Slipped
from graphkin.errors import GraphkinError
from graphkin.scene.contacts import PlacedGear
from graphkin.scene.loads import LinkMass, Loading, LoadOn, SpringOn
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.scene.symbol import Symbol, Value
from graphkin.solver import Forces, Motion, forces_of, solve, value_of
from graphkin.words import Phrase

__all__ = ["slipped_forces", "slipped_gears"]


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
        replace(d, angle=value) if isinstance(d, AngleDriver) else replace(d, travel=value)
        for d, value in zip(scene.drivers, places, strict=True)
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
