"""The usual slips in forces: what the forces of a position would be with each of them.

Those that teachers of kinetostatics name: a weight left out, an inertia force in the sense of the acceleration, kg for
N, the shifted inertia force on the wrong side, a load that does not act here, a moment of inertia left out.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from graphkin.checking.slip_likelihood import Slipped
from graphkin.scene.loads import LinkMass, Loading, LoadOn, SpringOn
from graphkin.scene.symbol import Symbol, Value
from graphkin.solver import Forces, Motion, forces_of
from graphkin.words import Phrase

__all__ = ["slipped_forces"]


def slipped_forces(motion: Motion) -> tuple[Slipped, ...]:
    """The forces at the one position of a motion with each slip."""
    if not motion.scene.loading or not motion.ok[0]:
        return ()
    made = []
    for phrase, share, loading in _slips(motion):
        scene = replace(motion.scene, loading=loading)
        there = replace(motion, structure=replace(motion.structure, scene=scene))
        made.append(Slipped(phrase, share, partial(_value, forces_of(there))))
    return tuple(made)


def _value(forces: Forces, symbol: Symbol) -> Value | None:
    """A force (N) or moment (N m), None for what there is not."""
    found = forces.value(str(symbol.here))
    if found is None or not np.isfinite(found[0]):
        return None
    return complex(found[0]) if symbol.is_vector else float(found[0].real)


def _slips(motion: Motion) -> Iterator[tuple[Phrase, float, Loading]]:
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
