"""What the table of a sweep shows of a mechanism: what is asked, or everything that moves, in the scene's units and
degrees; as arrays where the mechanism can be prepared, and as the table itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphkin.errors import CallError
from graphkin.scene.force_names import force_names
from graphkin.scene.model import Mechanism
from graphkin.scene.over_time import moments, moves_by_law
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Unit
from graphkin.solver import (
    DriverRange,
    Motion,
    driver_range,
    forces_of,
    listed_points,
    over_time,
    own_slides,
    prepare,
    structure_of,
    value_of,
)
from graphkin.solver.named_positions import named_positions
from graphkin.solver.pose import Array
from graphkin.solver.prepared import PreparedMechanism
from graphkin.solver.redundant import all_slides
from graphkin.structure import Structure, in_stages
from graphkin.study.quantities import (
    Quantity,
    force_quantity,
    link_quantities,
    settled,
    slide_quantities,
    symbol_quantity,
)
from graphkin.table import Column, Table, have
from graphkin.words import Wording

__all__ = [
    "BLOCK",
    "MANY",
    "Arrays",
    "FollowedDesign",
    "SweepQuantity",
    "all_that_moves",
    "motion_table",
    "quantity_named",
    "quantity_of_symbol",
    "word_column",
]

Parts = tuple[tuple[Array, ...], ...]
Words = Sequence[Wording] | Array

BLOCK = 16384
"""Positions that are computed and written together, about."""
MANY = 500_000
"""From so many positions on compiled code is worth the second or two that compiling takes."""


@dataclass(frozen=True)
class SweepQuantity:
    """A quantity, or the place of a point, in one to three columns of the table.

    size : whether a vector's size stands before its components
    symbol : as it is asked for; None for places, angles, and what slides do
    """

    what: Quantity | PointRef
    size: bool = False
    symbol: Symbol | None = None

    @property
    def name(self) -> str:
        return str(self.what) if isinstance(self.what, PointRef) else self.what.name

    @property
    def is_vector(self) -> bool:
        return isinstance(self.what, PointRef) or self.what.is_size

    @property
    def can_be_prepared(self) -> bool:
        """Whether a prepared mechanism gives it, as it stands in the table."""
        if isinstance(self.what, PointRef):
            return True
        if self.what.symbol is not None:
            return self.what.symbol.kind in ("v", "a")
        return self.what.kind in ("omega", "alpha", "s")

    def residues(self, engine: PreparedMechanism) -> Array:
        """What rounding leaves of nothing in what an engine gives of it, in the table's unit."""
        return np.asarray(engine.residues[engine.names.index(self.name + ".x" * self.is_vector)])

    def parts(self, reach: DriverRange | None, motion: Motion) -> tuple[Array, ...]:
        """Its values in a motion (alone, or of a range), in the table's units: one array, or a vector's components."""
        if isinstance(self.what, PointRef):
            found = settled(motion.position(self.what.point, self.what.link), motion.floors["length"])
        elif self.what.is_load:
            load = forces_of(motion).value(self.what.of)
            assert load is not None
            found = load
        elif self.what.symbol is not None:
            found = value_of(motion, self.what.symbol)
        else:
            found = np.asarray(self.what.values(reach, motion))
        if isinstance(self.what, Quantity):
            found = self.what.settled(motion, found)
        value = self.unit(motion.scene).of(found)
        return (value.real, value.imag) if self.is_vector else (value,)

    def unit(self, scene: Mechanism) -> Unit:
        """Its unit in the table."""
        return scene.units.of("length") if isinstance(self.what, PointRef) else self.what.unit(scene)

    def columns(self, scene: Mechanism, parts: Sequence[Array]) -> list[Column]:
        """Its columns, from its values."""
        if isinstance(self.what, PointRef):
            heads = [f"{axis}_{self.what}" for axis in "xy"]
        else:
            heads = [f"{self.name}.x", f"{self.name}.y"] if self.is_vector else [self.name]
        unit = self.unit(scene).text
        size = [Column(self.name, np.abs(parts[0] + 1j * parts[1]), unit, self.name)] if self.size else []
        return [*size, *(Column(h, part, unit, self.name) for h, part in zip(heads, parts, strict=True))]


def quantity_of_symbol(symbol: Symbol) -> SweepQuantity:
    """What a symbol of ``find`` shows."""
    return SweepQuantity(symbol_quantity(symbol), symbol.is_vector, symbol)


def quantity_named(scene: Mechanism, name: str) -> SweepQuantity | None:
    """What a name shows that is no symbol of ``find``: the place of a point ("C", "B@3"), the angle of a link
    ("theta_3"), travel, velocity and acceleration of a sliding pair ("s_3/4", "v_3/4", "a_3/4"), a force or a moment
    ("F_5/6", "M_2"); None for others."""
    kind, mark, rest = name.partition("_")
    force = force_quantity(scene, name)
    if force is not None:
        return SweepQuantity(force, force.is_size)
    if not mark:
        point, _, link = name.partition("@")
        here = point in scene.holders or any(c.name == point for c in scene.contacts)
        known = here and (not link or link in scene.by_name)
        return SweepQuantity(PointRef(point, link)) if known else None
    if kind == "theta" and any(link.name == rest for link in scene.links):
        return SweepQuantity(link_quantities(rest)[0])
    if kind in ("s", "v", "a") and any(s.key == rest for s in scene.slidings):
        return SweepQuantity(slide_quantities(rest)["sva".index(kind)])
    return None


def all_that_moves(structure: Structure) -> tuple[SweepQuantity, ...]:
    """Everything that moves: each pin once, and each point under a sliding pin."""
    scene, slides = structure.scene, own_slides(structure.scene, all_slides(structure))
    found = [SweepQuantity(q) for link in scene.links for q in link_quantities(link.name)]
    seen: set[PointRef] = set()
    for point, link_name in listed_points(scene, slides):
        ref = PointRef(point) if point in scene.by_name[link_name].points else PointRef(point, link_name)
        if ref in seen or (not ref.link and point in scene.frame.points):
            continue
        seen.add(ref)
        found += [SweepQuantity(ref)] if not ref.link else []
        found += [SweepQuantity(symbol_quantity(Symbol(kind, ref))) for kind in ("v", "a")]
    found += [SweepQuantity(q) for slide in slides for q in slide_quantities(slide.key)]
    found += [SweepQuantity(Quantity(kind, name)) for name, kind in force_names(scene).items()]
    return tuple(found)


def motion_table(
    scene: Mechanism, watched: Sequence[SweepQuantity], first: int, values: Array, parts: Parts, status: Words,
    why: Words, times: Array | None = None,
) -> Table:  # fmt: skip
    """A row for each position of a motion, numbered from ``first`` + 1 on.

    Parameters
    ----------
    values : of the drivers, shape (n, drivers) (SI)
    parts : of each quantity that is watched, as ``SweepQuantity.parts`` gives them
    status, why : of each position, or one of all
    times : of each position (s)
    """
    n = len(values)
    columns = [Column("position", np.arange(first + 1, first + n + 1))]
    columns += [] if times is None else [Column("time", times, "s")]
    for driver, value in zip(scene.drivers, values.T, strict=True):
        unit = scene.unit_of(driver)
        # a driver value is given, not found: without the last digit that the conversion to radians cost it
        shown = np.round(unit.of(value), 11) if driver.measure == "angle" else unit.of(value)
        columns.append(Column(f"driver_{driver.key}", shown, unit.text))
    for quantity, own in zip(watched, parts, strict=True):
        columns += quantity.columns(scene, own)
    return Table((*columns, word_column("status", status, n), word_column("why", why, n)), ("position",))


def word_column(name: str, words: Words, n: int) -> Column:
    """A column of words; a single one stands in every row."""
    values = np.empty(n, dtype=object)
    values[:] = str(words[0]) if len(words) == 1 else [str(word) for word in words]
    return Column(name, values)


@dataclass(frozen=True)
class Arrays:
    """What a prepared mechanism gives at all positions of a sweep.

    parts : for each quantity that is watched its values in the units of the table, two for a vector; NaN where not ok
    residues : what rounding leaves of nothing in each
    ok : bool, shape (positions,)
    good : how many are ok
    """

    parts: Parts
    residues: tuple[Array, ...]
    ok: Array
    good: int

    @property
    def settled(self) -> Parts:
        """The values as people read them: 0 where they are nothing but what rounding leaves."""
        both = zip(self.parts, self.residues, strict=True)
        return tuple(tuple(settled(part, residue) for part in own) for own, residue in both)


@dataclass(frozen=True)
class FollowedDesign:
    """One mechanism, whose motion is followed.

    asked : what the table shows; nothing: everything that moves
    at : driver values to start from (SI), by driver key; nothing: the scene's position 1, or its own position
    """

    scene: Mechanism
    asked: tuple[SweepQuantity, ...]
    at: tuple[tuple[str, float], ...]

    @cached_property
    def structure(self) -> Structure:
        return structure_of(self.scene)

    @cached_property
    def watched(self) -> tuple[SweepQuantity, ...]:
        """What the table shows."""
        return self.asked or all_that_moves(self.structure)

    @cached_property
    def start(self) -> dict[str, float]:
        """Driver values of the first row, where it is not the scene's own position.  Raises Unsolvable."""
        places = named_positions(self.scene) if not self.at else None
        if places is None or not places.reach.full:
            return dict(self.at)
        return {self.scene.drivers[0].key: places.first}

    @cached_property
    def reach(self) -> DriverRange:
        """The range of its first driver.  Raises Unsolvable."""
        return driver_range(self.structure, self.start)

    @cached_property
    def engine(self) -> PreparedMechanism | None:
        """The mechanism prepared for what is asked; None where everything is asked, or something that the formulas do
        not give, where a larger group has no closed form, or where it starts elsewhere than the scene."""
        if not self.asked or not all(w.can_be_prepared for w in self.asked):
            return None
        if self.at or self.scene.positions is not None or moves_by_law(self.scene):
            return None
        if in_stages(self.structure.elements):
            return None
        try:
            return prepare(self.structure, [w.name for w in self.asked], self.scene.units.per_si, along=self.reach)
        except CallError:  # a redundant link is none of its
            return None

    def arrays(self, n: int) -> Arrays | None:
        """All of n positions at once, where the mechanism can be prepared; very many by compiled code."""
        if self.engine is None:
            return None
        return self.arrays_of(self.engine, *self.engine.sweep(n, fast=n >= MANY and have("numba")))

    def arrays_of(self, engine: PreparedMechanism, columns: Array, ok: Array) -> Arrays:
        """What an engine gave, shapes (columns, positions) and (positions,), by what is watched."""
        good = len(ok) if engine.clear else int(np.count_nonzero(ok))
        if good < len(ok):
            columns[:, ~ok] = np.nan
        by_name = dict(zip(engine.names, columns, strict=True))
        ends = {True: (".x", ".y"), False: ("",)}
        parts = tuple(tuple(by_name[w.name + e] for e in ends[w.is_vector]) for w in self.watched)
        return Arrays(parts, tuple(w.residues(engine) for w in self.watched), ok, good)

    def table(self, n: int, first: int, last: int) -> Table:
        """Positions ``first`` to ``last`` (not included) of n: driver values, what is watched, status and reason."""
        if self.engine is not None:
            found = self.engine.columns(self.reach.grid(n, first, last).values)
            return self.table_of(self.arrays_of(self.engine, *found), n, first, last)
        if moves_by_law(self.scene):
            times = np.array(moments(self.scene, n)[first:last])
            motion = over_time(self.structure, times)
            parts = tuple(w.parts(None, motion) for w in self.watched)
            return motion_table(self.scene, self.watched, first, motion.values, parts, motion.status, motion.why, times)
        motion = self.reach.motion(self.reach.table_offsets(n, first, last))
        parts = tuple(w.parts(self.reach, motion) for w in self.watched)
        return motion_table(self.scene, self.watched, first, motion.values, parts, motion.status, motion.why)

    def table_of(self, arrays: Arrays, n: int, first: int, last: int) -> Table:
        """The table of what a prepared mechanism gave at positions ``first`` to ``last`` of n."""
        rows = last - first
        values = np.repeat(self.reach.start[None], rows, axis=0)
        values[:, 0] = self.reach.grid(n, first, last).values
        status, why = np.full(rows, "ok", object), np.full(rows, "", object)
        parts = arrays.settled
        bad = np.flatnonzero(~arrays.ok) if arrays.good < rows else np.zeros(0, int)
        for some in (bad[k : k + BLOCK] for k in range(0, len(bad), BLOCK)):
            # why there is nothing there the solver says, and it has the last word on whether there is
            motion = self.reach.motion(self.reach.table_offsets(n, first, last)[some])
            for own, watched in zip(parts, self.watched, strict=True):
                for part, found in zip(own, watched.parts(self.reach, motion), strict=True):
                    part[some] = found
            status[some], why[some] = motion.status.tolist(), motion.why
        return motion_table(self.scene, self.watched, first, values, parts, status, why)

    def blank(self, first: int, last: int, status: str = "", why: str = "") -> Table:
        """The table of positions that have no values."""
        nothing = np.full(last - first, np.nan)
        parts = tuple((nothing,) * (1 + w.is_vector) for w in self.watched)
        values = np.stack([nothing] * len(self.scene.drivers), axis=1)
        times = nothing if moves_by_law(self.scene) else None
        return motion_table(self.scene, self.watched, first, values, parts, [status], [why], times)
