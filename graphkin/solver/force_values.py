"""Exact values of forces and moments by their symbols: at one position, or as columns for a prepared mechanism, solved
with the motion, since there are no formulas of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import dot
from graphkin.scene.force_names import force_names, opposite
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol, Value
from graphkin.solver.driver_range import DriverRange
from graphkin.solver.external_forces import without_line
from graphkin.solver.forces import Forces, forces_of
from graphkin.solver.mobility import structure_of
from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array, Pose
from graphkin.solver.redundant import all_slides
from graphkin.solver.solve import solve
from graphkin.words import Phrase

__all__ = ["force_heads", "force_rows", "force_values"]


def force_values(motion: Motion) -> tuple[Callable[[Symbol], Value], float]:
    """What gives the exact force (N), moment (N m), shift of an inertia force (m) or arm on Zhukovsky's lever (m/s: the
    power of a force over its size) of a symbol at the one position of a motion; and how far rounding may have moved any
    force (N).

    At rest an arm is that of the driver's value growing at a unit rate.

    Raises
    ------
    Unsolvable : "dead point": the balance does no work
    """
    motion = _of_cams(motion)
    forces = forces_of(motion)
    for name, where in without_line(motion).items():
        if where[0]:
            found = Phrase("its two points coincide in this position so")
            raise Unsolvable(
                "dead point", Problem(f"springs.{name}", found, Phrase("move the driver off this position"))
            )
    if not forces.ok[0]:
        drivers = ", ".join(d.key for d in motion.scene.drivers)
        raise Unsolvable(
            "dead point",
            Problem(
                Phrase("driver of driver", driver=drivers),
                Phrase("the balance does no work in this position of nothing"),
            ),
        )
    moving = motion if any(d.values[1] for d in motion.scene.drivers) else _growing(motion)

    def value(symbol: Symbol) -> Value:
        if symbol.kind == "h":
            return _shift(forces, symbol.link)
        if symbol.kind == "arm":
            return _arm(moving, forces, symbol.name)
        bare = replace(symbol, plus=False, at="")
        if symbol.plus and (found := _beside(forces, bare)) is not None:
            return found
        known = forces.value(str(bare))
        return float("nan") if known is None else _plain(known)

    return value, float(forces.bound[0][0])


def _of_cams(motion: Motion) -> Motion:
    """The motion of a mechanism with cams itself, where another stands in its place; the links move alike."""
    whole = motion.scene.instead_of
    if whole is None:
        return motion
    structure = structure_of(whole)
    return replace(motion, structure=structure, slides=all_slides(structure))


def _plain(value: np.ndarray) -> Value:
    return complex(value[0]) if np.iscomplexobj(value) else float(value[0])


def _beside(forces: Forces, symbol: Symbol) -> Value | None:
    """A value with the loads that begin or end exactly here; None where they change nothing."""
    for name, sign in ((symbol, 1.0), (replace(symbol, link=symbol.other, other=symbol.link), -1.0)):
        found = forces.beside.get(str(name))
        if found is not None and not np.isnan(found[0]):
            return _plain(np.asarray(sign * found))
    return None


def _shift(forces: Forces, link: str) -> float:
    force, moment = abs(_plain(forces.forces[f"Fi_{link}"])), forces.moments[f"Mi_{link}"]
    return float(moment[0]) / force if force else 0.0


def _arm(moving: Motion, forces: Forces, name: str) -> float:
    kind, _, rest = name.partition("_")
    loading = moving.scene.loading
    pose: Pose
    if kind == "P":
        acting = [(one.name, (one.link, one.at)) for one in loading.loads]
        acting += [(one.name, one.ends[0]) for one in loading.springs]
        link, at = next(place for named, place in acting if named == rest)
        pose = moving.poses[link].fixed(at)
    elif kind == "F":
        return _of_balance(moving, forces, name)
    else:
        mass = next(one for one in loading.masses if one.link == rest)
        pose = moving.poses[mass.link].fixed(mass.at)
    force = _plain(forces.forces[name])
    if not force:
        force = _plain(forces.beside.get(name, forces.forces[name]))
    return _along(complex(np.ravel(pose.v)[0]), complex(force))


def _along(velocity: complex, force: complex) -> float:
    return dot(velocity, force / abs(force)) if force else 0.0


def _of_balance(moving: Motion, forces: Forces, name: str) -> float:
    """Of a balancing force: the part of its point's velocity along its line, positive in the line's own sense."""
    scene, said = moving.scene, moving.scene.loading.balance
    if said is not None:
        pose = moving.poses[said.link]
        along = 1j * complex(np.ravel(pose.u)[0]) if said.square else said.turn
        return dot(complex(np.ravel(pose.fixed(said.at).v)[0]), along)
    return float(moving.slide(scene.drivers[0].key).velocity[0])


def _growing(motion: Motion) -> Motion:
    """The same position with the first driver's value growing at a unit rate."""
    scene = motion.scene.instead_of or motion.scene
    drivers = tuple(d.at_rate(1.0 if d is scene.drivers[0] else 0.0) for d in scene.drivers)
    values = {d.key: float(v) for d, v in zip(scene.drivers, motion.values[0], strict=True)}
    return solve(replace(scene, drivers=drivers), at=values)


def force_heads(scene: Mechanism, name: str) -> tuple[str, ...]:
    """The heads of the columns of a force (two, ``F_5/6.x`` and ``F_5/6.y``) or a moment; none for what is neither."""
    known, plain = force_names(scene), name.removesuffix("+")
    kind = known.get(plain) or known.get(opposite(plain))
    return (f"{name}.x", f"{name}.y") if kind == "force" else (name,) if kind else ()


def force_rows(
    reach: DriverRange, names: Sequence[str], values: Array, bounded: bool = False
) -> tuple[list[Array], list[Array], Array]:
    """Forces and moments at values of the first driver (rad, m), shape (n,).

    Returns
    -------
    rows : one for each head of each name, in the scene's units
    bounds : for each name how far rounding may have moved its rows, where that is wanted (``bounded``)
    ok : bool, shape (n,): where the motion comes, and its balance does work
    """
    forces, per = forces_of(reach.motion(reach.offsets(values))), reach.scene.units.newtons
    rows, bounds = [], []
    for name in names:
        value = forces.value(name)
        assert value is not None
        vector = np.iscomplexobj(value)
        rows += [part / per for part in ((value.real, value.imag) if vector else (value,))]
        bounds += [forces.bound[0 if vector else 1] / per] if bounded else []
    return rows, bounds, forces.ok
