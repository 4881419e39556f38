"""Sweeps: a mechanism, or many designs of it, followed over the range of the driver; in memory, or into files.

The table is cut into pieces that depend on the sweep alone, so that they are the same on every machine and at any time:
an interrupted sweep is continued in its folder from the finished pieces.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from graphkin.errors import CallError, GraphkinError, Unsolvable, as_text, did_you_mean
from graphkin.files import Tables, folder_alone, whole_file
from graphkin.jobs import Checkpoints, Progress, Workers, key_of
from graphkin.scene import mechanism_of
from graphkin.scene.drivers import moments, moves_by_law
from graphkin.scene.model import Dimension, Mechanism, dimensions, same_but_for_dimensions
from graphkin.scene.symbol import Symbol
from graphkin.solver import DriverRange, Motion, driver_range, over_time, structure_of
from graphkin.solver.algebra.pose import Array
from graphkin.solver.compiled.kernel import pays
from graphkin.solver.forces import forces_of, settled
from graphkin.solver.path.named_positions import first_position, standing
from graphkin.solver.prepared import PreparedMechanism, prepare
from graphkin.structure import Structure
from graphkin.study.designs import Designs, applied
from graphkin.study.prepared_designs import PreparedMechanisms
from graphkin.study.quantities import Parts, Words, all_that_moves, motion_table, parts_of
from graphkin.table import Column, Table, Tabled, Values, parquet_of_csv, table_of_csv
from graphkin.words import Wording, as_data, from_data, from_others

if TYPE_CHECKING:
    import xarray

ALONE = Designs()
"""A scene by itself."""
BLOCK = 16384
"""Positions that are computed and written together, about."""
MOST_DESIGNS = 64
"""Designs in a piece, so that all workers have some."""
LONG = 5.0
"""Seconds of work (estimated) from which processes pay."""


Arrays = tuple[Array, Array]
"""What a prepared mechanism gives at all positions of a sweep: its columns, shape (columns, positions), NaN where there
is no such position; and where there is, shape (positions,)."""


@dataclass(frozen=True)
class FollowedDesign:
    """A mechanism whose motion is followed.

    asked : the quantities of the table; empty: all motions
    at : driver values to start from (SI), by driver key; empty: the scene's position 1, or its own position
    among : whether it is one of many designs, whose table has columns for forces that some of them do not have
    """

    scene: Mechanism
    asked: tuple[Symbol, ...] = ()
    at: tuple[tuple[str, float], ...] = ()
    among: bool = False

    @classmethod
    def prepared(cls, engine: PreparedMechanism) -> FollowedDesign:
        """A mechanism that is prepared already, whatever its quantities."""
        design = cls(engine.structure.scene, (*engine.wanted, *engine.solved))
        design.__dict__.update(structure=engine.structure, reach=engine.range, engine=engine)
        return design

    @cached_property
    def structure(self) -> Structure:
        return structure_of(self.scene)

    @cached_property
    def watched(self) -> tuple[Symbol, ...]:
        """The quantities of the table: the asked ones, or all that are known."""
        every = self.asked or all_that_moves(self.structure)
        if self.asked or self.among or self.unloaded is None:
            return every
        return tuple(symbol for symbol in every if not symbol.is_load)

    @cached_property
    def unloaded(self) -> Unsolvable | None:
        """The reason why no forces are known: a load acts on a part of a stroke, and there is no whole turn."""
        for load in self.scene.loading.loads:
            try:
                if load.phase and load.phase.stroke:
                    self.reach.stroke(load.phase.stroke)
            except Unsolvable as stop:
                return load.without_stroke(stop)
        return None

    @cached_property
    def start(self) -> dict[str, float]:
        """Driver values of the first row, if it is not the scene's own position.  Raises Unsolvable."""
        reach = None if self.at or self.scene.question.positions is None else driver_range(self.structure)
        if reach is None or not reach.full:
            return dict(self.at)
        return {self.scene.drivers[0].key: first_position(reach)}

    @cached_property
    def reach(self) -> DriverRange:
        """The range of its first driver.  Raises Unsolvable."""
        return driver_range(self.structure, self.start)

    @cached_property
    def engine(self) -> PreparedMechanism | None:
        """The mechanism prepared for the asked quantities; None if all are asked, or one that the formulas do not give,
        if a larger group has no closed form, or if it starts elsewhere than the scene."""
        if not self.asked or not all(map(_is_prepared, self.asked)):
            return None
        if self.at or self.scene.question.positions is not None or moves_by_law(self.scene):
            return None
        if not all(e.explicit for e in self.structure.elements):
            return None
        ready = prepare(self.structure, self.asked, self.scene.units, along=self.reach)
        return None if ready.solved else ready  # a redundant link is none of its

    @cached_property
    def places(self) -> Mapping[str, tuple[tuple[int, ...], str]]:
        """The rows of each prepared quantity, and of each of its components, with its unit, by their names."""
        places = dict[str, tuple[tuple[int, ...], str]]()
        names = () if self.engine is None else self.engine.names
        for quantity in self.asked if names else ():
            unit, rows = quantity.unit(self.scene.units).text, tuple(map(names.index, quantity.heads))
            places |= {head: ((k,), unit) for head, k in zip(quantity.heads, rows, strict=True)}
            places[str(quantity)] = rows, unit
        return places

    def table(self, n: int, first: int, last: int, arrays: Arrays | None = None) -> Table:
        """Positions ``first`` to ``last`` (not included) of n: driver values, quantities, status and reason;
        ``arrays`` if the prepared mechanism gave them already."""
        if self.engine is not None:
            given, offset = self.reach.grid(n, first, last).values, self.reach.table_offsets(n, np.arange(first, last))
            columns, ok = self.engine.columns(given) if arrays is None else arrays
            values, missing = _driven(self.reach.start[None], given[None]), np.flatnonzero(~ok)
            return self.table_of(columns, values, [(missing, self, offset[missing])], first)
        times = np.array(moments(self.scene, n)[first:last]) if moves_by_law(self.scene) else None
        if times is not None:
            motion = over_time(self.structure, times)
        else:
            motion = self.reach.motion(self.reach.table_offsets(n, np.arange(first, last)))
        reach, nothing = None if times is not None else self.reach, np.full(len(motion), np.nan)
        parts = tuple((nothing,) * len(w.heads) if w.is_load and self.among and self.unloaded is not None
                      else parts_of(w, reach, motion) for w in self.watched)
        motion = self._known(motion)
        return self._rows(first, motion.values, parts, motion.status, motion.why, times)

    def table_of(self, columns: Array, values: Array, missing: Iterable[Missing], first: int = 0) -> Table:
        """The table of a prepared mechanism's columns, 0 where they are rounding alone.

        Parameters
        ----------
        values : of the drivers, shape (rows, drivers) (rad, m)
        """
        assert self.engine is not None
        by_head = dict(zip(self.engine.names, map(settled, columns, self.engine.residues), strict=False))
        parts, rows = tuple(tuple(by_head[head] for head in w.heads) for w in self.watched), len(values)
        absent = [gone for gone in missing if len(gone[0])]
        if not absent:
            return self._rows(first, values, parts, ["ok"], [""])
        status, why = np.full(rows, "ok", object), np.full(rows, "", object)
        for without, design, offset in absent:
            if isinstance(design, tuple):
                values[without], (status[without], why[without]) = np.nan, design
                continue
            for k in range(0, len(without), BLOCK):
                # why there is nothing there the solver says, and it has the last word on whether there is
                some, motion = without[k : k + BLOCK], design.reach.motion(offset[k : k + BLOCK])
                for watched, components in zip(self.watched, parts, strict=True):
                    for component, solved in zip(components, parts_of(watched, design.reach, motion), strict=True):
                        component[some] = solved
                known = self._known(motion)
                status[some], why[some] = known.status.tolist(), known.why
        return self._rows(first, values, parts, status, why)

    def _known(self, motion: Motion) -> Motion:
        """A motion, not solved where asked forces are unknown."""
        if not any(w.is_load for w in self.watched):
            return motion
        if not self.among or self.unloaded is None:
            return forces_of(motion).known_motion
        status = np.where(motion.ok & bool(self.asked), self.unloaded.status, motion.status)
        reasons = (self.unloaded.reason if ok else why for ok, why in zip(motion.ok, motion.reasons, strict=True))
        return replace(motion, status=status, reasons=tuple(reasons))

    def blank(self, first: int, last: int, status: str = "", why: str = "") -> Table:
        """The table of positions without values."""
        nothing = np.full(last - first, np.nan)
        parts = tuple((nothing,) * len(w.heads) for w in self.watched)
        values = np.stack([nothing] * len(self.scene.drivers), axis=1)
        times = nothing if moves_by_law(self.scene) and self.engine is None else None
        return self._rows(first, values, parts, [status], [why], times)

    def _rows(
        self, first: int, values: Array, parts: Parts, status: Words, why: Words, times: Array | None = None
    ) -> Table:
        """The table of the quantities."""
        return motion_table(
            self.scene, self.watched, bool(self.asked), first, values, parts, status, why, times
        )


def _is_prepared(quantity: Symbol) -> bool:
    """Whether a prepared mechanism gives a quantity as tables show it: none of rates along guides, and no angle, which
    is continuous over a turn."""
    given = quantity.order is not None and quantity.kind != "theta"
    return given and not (quantity.is_rate_of_pair or quantity.axis)


Missing = tuple[Array, FollowedDesign | tuple[str, Wording], Array]
"""Rows of a table for which a prepared mechanism has nothing, with the design of which the solver says why, or its
status and reason, and the offsets of the first driver in its range (rad, m)."""


@dataclass(frozen=True)
class Outcome:
    """The outcome of a design.

    design : its number from 0
    status, why : "ok"; "partly" (some positions have no values, with the reason of the first); or the reason why none
        has
    cells : range, strokes, K, least transmission angles (see `graphkin.study.turn_data.design_row`)
    good : positions that are ok
    """

    design: int
    status: str
    why: Wording
    cells: Mapping[str, float | str | None]
    good: int


@dataclass(eq=False, repr=False)  # not frozen: that would take longer than a hundred positions
class Sweep(Tabled):
    """A sweep: positions of one mechanism, or of many designs of it; a piece of it is a sweep again.

    ``sweep["v_C"]`` is an asked quantity by its name, as an array: complex for vectors, in the scene's length unit,
    degrees for angles, NaN where it is missing; shape (positions,), over designs (designs, positions).  ``table`` also
    has the drivers' values and the status of each position; it is made when it is first read.

    base : the scene itself as a design, without replaced values; all pieces share it
    source : the numbers of each design: the mapping of the scene's file in which they are replaced, or the prepared
        mechanisms
    some : first and last position (not included) of each design; None for all
    content : the table, its file, or the arrays of a prepared mechanism of which it is made; None before it is made
    given : values of the first driver in its own unit, as the arrays; None for those of the whole range
    """

    base: FollowedDesign
    name: str
    positions: int
    designs: Designs = ALONE
    source: Tables | PreparedMechanisms | None = None
    some: tuple[int, int] | None = None
    content: Table | Path | Arrays | None = None
    given: Array | None = None

    # its values

    def __len__(self) -> int:
        return self.rows

    def __getitem__(self, name: str) -> Array:
        """An asked quantity by its name, or any column of the table.  Raises CallError for an unknown one."""
        name = as_text("name", name)
        if isinstance(self.content, tuple) and self.base.engine is not None and name in self.base.places:
            rows, unit = self.base.places[name]
            parts = [settled(self.content[0][row], self.base.engine.residues[row]) for row in rows]
            return Values.of(parts[0] if len(parts) == 1 else parts[0] + 1j * parts[1], unit)
        # of a vector its size, if it has one, and its components
        columns = [column for column in self.table.columns if column.symbol == name] or [self.table.column(name)]
        values = columns[0].values if len(columns) == 1 else columns[-2].values + 1j * columns[-1].values
        shown = values.reshape(self._shown)
        return Values.of(shown, columns[0].unit) if columns[0].unit else shown

    @property
    def _shown(self) -> tuple[int, ...]:
        """The shape of its arrays."""
        if isinstance(self.content, tuple):
            return self.content[1].shape
        return (len(self.designs), self.positions) if self.designs.keys else (self.positions,)

    @property
    def values(self) -> Array:
        """The arrays of a prepared mechanism, shape (columns, ...) in the order of its names."""
        assert isinstance(self.content, tuple)
        columns, engine = self.content[0], self.base.engine
        assert engine is not None
        return columns[: len(engine.names)] if engine.bounded else columns

    @property
    def ok(self) -> Array:
        """Whether each position is solved: not where the motion does not reach it, and not at dead points."""
        if isinstance(self.content, tuple):
            return self.content[1]
        return np.asarray(self.table["status"] == "ok").reshape(self._shown)

    @property
    def driver(self) -> Array:
        """Values of the first driver (degrees, or the scene's length unit), shape (positions,) or as ``ok``."""
        driver = self.scene.drivers[0]
        if self.given is None and isinstance(self.content, tuple):
            return np.asarray(self.scene.unit_of(driver).of(self.base.reach.grid(self.positions).values))
        return self[f"driver_{driver.key}"] if self.given is None else self.given

    def bound(self, name: str) -> Array:
        """A bound of the rounding error of a quantity in its unit, as ``ok``: for both components of a vector; infinite
        where it is unknown.  Raises CallError where bounds were not asked for."""
        engine = self.base.engine
        if not isinstance(self.content, tuple) or engine is None or not engine.bounded:
            raise CallError.of("bound", "no bounds were asked for", "prepare with bounds true")
        names = [*map(str, (*engine.wanted, *engine.solved))]
        if name not in names:
            raise CallError.of(f'"{name}"', "was not asked for", did_you_mean(name, names))
        return np.asarray(self.content[0][len(engine.names) + names.index(name)])

    @cached_property
    def table(self) -> Table:
        """A row for each position: the asked quantities in the scene's units, degrees for angles, and its status."""
        if isinstance(self.content, Table):
            return self.content
        if isinstance(self.content, Path):
            return table_of_csv(self.content, self.head)
        if self.content is None:
            return collect(self, Workers())[0]
        return self._of_arrays(*self.content)

    def _of_arrays(self, columns: Array, ok: Array) -> Table:
        """The table of the arrays of a prepared mechanism: designs of which positions are missing are followed."""
        base, n, source = self.base, self.positions, self.source
        if self.given is None:
            return base.table(n, 0, n, (columns, ok))
        si = self.scene.unit_of(self.scene.drivers[0]).si
        given, ok = np.broadcast_to(self.given, ok.shape).reshape(-1, n) * si, ok.reshape(-1, n)
        starts = source.starts if isinstance(source, PreparedMechanisms) else base.reach.start[None]

        def missing() -> Iterator[Missing]:
            for k in np.flatnonzero(~ok.all(axis=1)).tolist():
                design, rows = _followed(self, k), np.flatnonzero(~ok[k])
                driven = given[k, rows]
                yield k * n + rows, design, driven if isinstance(design, tuple) else design.reach.offsets(driven)

        table = base.table_of(columns.reshape(len(columns), -1), _driven(starts, given), missing())
        position, *others = table.columns
        position = replace(position, values=np.tile(np.arange(1, n + 1), len(ok)))
        return _of_designs(replace(table, columns=(position, *others)), self.designs, n)

    def to_xarray(self) -> xarray.Dataset:
        """The table as a data set of xarray with units, over ``position`` or over ``design`` and ``position``, with the
        replaced values as coordinates of the designs.  Raises CallError where it is not installed."""
        data = self.table.to_xarray()
        return data.assign_coords({key: ("design", data[key].values[:, 0]) for key in self.designs.keys})

    def __eq__(self, other: object) -> bool:
        return self.table == other.table if isinstance(other, Sweep) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.table)

    def __repr__(self) -> str:
        return f"<Sweep of {self.name}: {int(self.ok.sum())} of {self.rows} positions>"

    # its pieces

    @property
    def rows(self) -> int:
        """Rows of the table."""
        return len(self.designs) * self.positions

    @property
    def numbers(self) -> int:
        """The approximate count of numbers in the table."""
        return self.rows * (2 * len(self.base.watched) + 1)

    @property
    def scene(self) -> Mechanism:
        """The scene itself, without replaced values."""
        return self.base.scene

    @cached_property
    def head(self) -> Table:
        """The table without rows.  Raises Unsolvable for a wrong mobility."""
        return _of_designs(self.base.blank(0, 0), self.designs.part(0, 0), 0)

    @cached_property
    def key(self) -> str:
        """A key that two sweeps share only if they give the same results."""
        base, source = self.base, dict(self.source) if isinstance(self.source, Mapping) else repr(self.scene)
        return key_of(BLOCK, source, self.name, repr(self.designs), self.positions, repr(base.asked), base.at)

    @property
    def long(self) -> bool:
        """Whether it takes so long that processes pay."""
        each = 0.05 if self.designs.keys else 0.0
        return len(self.designs) * each + self.numbers * 2e-7 > LONG

    @property
    def _shape(self) -> tuple[int, int]:
        """The number of designs in a piece, and of pieces for the positions of one design."""
        return max(1, min(BLOCK // self.positions, MOST_DESIGNS)), -(-self.positions // BLOCK)

    @property
    def pieces(self) -> int:
        """The number of pieces of the sweep."""
        together, along = self._shape
        return -(-len(self.designs) // together) * along

    def piece(self, number: int) -> Sweep:
        """A piece: some designs, or some positions of one."""
        together, along = self._shape
        group, block = divmod(number, along)
        some = block * BLOCK, min((block + 1) * BLOCK, self.positions)
        # the values of all other designs stay at home
        return replace(self, designs=self.designs.part(group * together, (group + 1) * together), some=some)


def _driven(starts: Array, given: Array) -> Array:
    """Values of all drivers, shape (designs * positions, drivers), from those of the first, shape (designs, positions):
    the others stand at their start, shape (designs, drivers)."""
    values = np.repeat(starts, given.shape[1], axis=0)
    values[:, 0] = given.ravel()
    return values


def made(sweep: Sweep) -> tuple[Table, list[Outcome]]:
    """The table of a piece, and the outcome of each of its designs.  Failures of a design are told in its rows and not
    raised."""
    designs = sweep.designs
    followed = [_followed(sweep, k) for k in range(len(designs))]
    first, last = sweep.some or (0, sweep.positions)
    arrays = _together(sweep, followed) if last - first == sweep.positions and designs.keys else {}
    tables, outcomes, alike = [], [], sweep.base.blank(0, 0)
    for k, design in enumerate(followed):
        table, outcome = _rows(sweep, designs.first + k, design, arrays.get(k), first, last)
        tables.append(_like(alike, table))
        outcomes.append(outcome)
    return _of_designs(Table.joined(tables), designs, last - first), outcomes


def made_text(sweep: Sweep) -> tuple[bytes, list[Outcome]]:
    """The piece with the rows of the table as those of a CSV file."""
    (table, outcomes), out = made(sweep), io.BytesIO()
    table.write_csv(out, head=False)
    return out.getvalue(), outcomes


def _together(sweep: Sweep, designs: Sequence[FollowedDesign | tuple[str, Wording]]) -> dict[int, Arrays]:
    """The results of the prepared scene for designs that are the scene with other dimensions in the same assembly, as
    of ``prepare(...).over(...)``."""
    try:
        ready = sweep.base.engine
    except Unsolvable:
        return {}
    if ready is None or ready.signs is None:
        return {}
    mode, alike = ready.range.modes(np.zeros(1)), dict[int, Mapping[Dimension, complex]]()
    for number, design in enumerate(designs):
        if isinstance(design, FollowedDesign) and same_but_for_dimensions(sweep.scene, design.scene):
            here = design.reach.modes(np.zeros(1))
            if all(np.array_equal(here[i], mode[i]) for i in mode):
                alike[number] = dimensions(design.scene)
    columns_of = {name: np.array([numbers[name] for numbers in alike.values()]) for name in ready.dimensions}
    given = {name: column for name, column in columns_of.items() if (column != ready.dimensions[name]).any()}
    if not given:
        return {}
    together = PreparedMechanisms(ready, given).together
    numbers = np.array([*alike])[together]
    if not len(numbers):
        return {}
    columns, ok, _ = PreparedMechanisms(ready, {name: x[together] for name, x in given.items()}).sweep(sweep.positions)
    return {number: (columns[:, k], ok[k]) for k, number in enumerate(numbers.tolist())}


def _rows(
    sweep: Sweep, number: int, design: FollowedDesign | tuple[str, Wording], arrays: Arrays | None, first: int,
    last: int,
) -> tuple[Table, Outcome]:
    """Some positions of a design, and its outcome."""
    if isinstance(design, tuple):
        status, why = design
        return sweep.base.blank(first, last, status, str(why)), Outcome(number, status, why, {}, 0)
    n = sweep.positions
    table, cells = design.table(n, first, last, arrays), dict[str, float | str | None]()
    if sweep.designs.keys and first == 0:
        from graphkin.study.turn import study_turn
        from graphkin.study.turn_data import design_row

        cells = design_row(study_turn(design.reach, everything=False))
    return table, _outcome(number, table, cells)


def _outcome(number: int, table: Table, cells: Mapping[str, float | str | None]) -> Outcome:
    """The outcome of the rows of a design, by the first without values."""
    bad = np.flatnonzero(table["status"] != "ok")
    row = bad[0] if len(bad) else 0
    return Outcome(number, table["status"][row], table["why"][row], cells, len(table) - len(bad))


def _like(other: Table, table: Table) -> Table:
    """A table in the columns of another: what a design with other drivers or units does not have is missing."""
    if table.heads == other.heads:
        return table
    values = {column.head: column.values for column in table.columns}
    nothing = np.full(len(table), np.nan)
    return replace(other, columns=tuple(replace(c, values=values.get(c.head, nothing)) for c in other.columns))


def _followed(sweep: Sweep, number: int) -> FollowedDesign | tuple[str, Wording]:
    """A design with its path, or the status and the reason why it has none."""
    try:
        design, source = sweep.base, sweep.source
        if isinstance(source, PreparedMechanisms):
            reach = source.reach(number)
            design = replace(design, scene=reach.scene)
            design.__dict__.update(structure=reach.structure, reach=reach)
        elif source is not None:
            replaced = applied(source, sweep.designs.keys, sweep.designs[number])
            design = replace(design, scene=standing(mechanism_of(replaced)))
        _ = design.reach
        return design
    except Unsolvable as error:
        return error.status, error.reason
    except GraphkinError as error:
        return "wrong scene", error.reason


def _of_designs(table: Table, designs: Designs, n: int) -> Table:
    """The table of designs, ``n`` rows of each in turn, after their numbers and their replaced values."""
    if not designs.keys:
        return table
    rows = [designs[k] for k in range(len(designs))]
    numbers = Column("design", np.repeat(designs.first + 1 + np.arange(len(rows)), n))
    replaced: list[Column] = []
    for k, (key, word) in enumerate(zip(designs.keys, designs.worded, strict=True)):
        values = [str(row[k]) if word else row[k] for row in rows]
        replaced.append(Column(key, np.repeat(np.array(values, object if word else float), n)))
    return Table((numbers, *replaced, *table.columns), ("design", "position"))


def at_once(sweep: Sweep) -> tuple[Sweep, tuple[Outcome, ...]] | None:
    """All positions of a scene that can be prepared, very many by compiled code: with the arrays of which its table is
    made when it is read, or the table where the solver has to say why there is nothing.  None for others."""
    design, n = sweep.base, sweep.positions
    if sweep.designs.keys or design.engine is None:
        return None
    arrays = design.engine.sweep(n, fast=pays(n))
    if arrays[1].all():
        return replace(sweep, content=arrays), (Outcome(0, "ok", "", {}, n),)
    table = design.table(n, 0, n, arrays)
    return replace(sweep, content=table), _joined(sweep, [_outcome(0, table, {})])


def collect(sweep: Sweep, workers: Workers, progress: Progress | None = None) -> tuple[Table, tuple[Outcome, ...]]:
    """The table of a whole sweep in memory, and the outcome of each of its designs."""
    tables, outcomes = list[Table](), list[Outcome]()
    for table, ends in workers.results(made, ((sweep.piece(k),) for k in range(sweep.pieces))):
        tables.append(table)
        outcomes += ends
        _count(sweep, len(tables), progress)
    return Table.joined(tables), _joined(sweep, outcomes)


def write_tables(
    sweep: Sweep, folder: Path, workers: Workers, parquet: bool = False, progress: Progress | None = None
) -> tuple[tuple[Path, ...], tuple[Outcome, ...], int]:
    """Make the missing pieces of a sweep and write its tables into a folder; they appear whole or not at all.

    Parameters
    ----------
    parquet : whether table.parquet is written too
    progress : called with the number of finished rows and of all

    Returns
    -------
    The files, table.csv first; the outcome of each design; the number of damaged pieces of an earlier run, which were
    made again

    Raises
    ------
    CallError : the folder cannot be written, or another program is writing into it
    """
    # what is wrong with the scene itself is said before anything is written
    _ = sweep.head
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with folder_alone(folder):
            points = Checkpoints.of(folder, "sweep", sweep.key)
            points.open(scene=sweep.name, pieces=sweep.pieces, rows=sweep.rows)
            finished, damaged = points.done()
            missing = [k for k in range(sweep.pieces) if k not in finished]
            _count(sweep, len(finished), progress)
            results = workers.results(made_text, ((sweep.piece(k),) for k in missing))
            for k, (number, (text, outcomes)) in enumerate(zip(missing, results, strict=True), 1):
                points.save(number, {"outcomes": [{**asdict(o), "why": as_data(o.why)} for o in outcomes]}, text)
                _count(sweep, len(finished) + k, progress)
            return *_merged(sweep, points, folder, parquet), damaged
    except OSError as error:
        raise CallError.of(str(folder), "cannot be written", "give another folder with o",
                           reason=from_others(error)) from None


def _merged(
    sweep: Sweep, points: Checkpoints, folder: Path, parquet: bool
) -> tuple[tuple[Path, ...], tuple[Outcome, ...]]:
    """All pieces in their order as tables in the folder of results; the pieces are removed."""
    of_pieces = list[Outcome]()
    files = [folder / "table.csv"]
    with whole_file(files[0], points.place) as out:
        sweep.head.write_csv(out)
        for piece in map(points.load, range(sweep.pieces)):
            if piece is None:
                raise CallError.of(str(points.place), "a piece was damaged while the table was", "run it again")
            piece.copy(out)
            of_pieces += [Outcome(**{**o, "why": from_data(o["why"])}) for o in piece.facts["outcomes"]]
    outcomes = _joined(sweep, of_pieces)
    if sweep.designs.keys:
        files.append(folder / "designs.csv")
        with whole_file(files[-1], points.place) as out:
            designs_table(sweep, outcomes).write_csv(out)
    if parquet:
        files.append(folder / "table.parquet")
        with whole_file(files[-1], points.place) as out:
            parquet_of_csv(files[0], sweep.head, out)
    points.close()
    return tuple(files), outcomes


def _count(sweep: Sweep, done: int, progress: Progress | None) -> None:
    if progress is not None:
        progress(min(sweep.rows, round(sweep.rows * done / sweep.pieces)), sweep.rows)


def _joined(sweep: Sweep, outcomes: Sequence[Outcome]) -> tuple[Outcome, ...]:
    """The outcome of each design from its pieces in order: it is "ok", "partly" so (some positions failed), or has the
    status of the first that failed."""
    whole = []
    for design, pieces in groupby(outcomes, lambda outcome: outcome.design):
        parts = list(pieces)
        good = sum(o.good for o in parts)
        said = next((o for o in parts if o.why), parts[0])
        status = "ok" if good == sweep.positions else "partly" if good else said.status
        whole.append(Outcome(design, status, said.why, parts[0].cells, good))
    return tuple(whole)


def designs_table(sweep: Sweep, outcomes: Sequence[Outcome]) -> Table:
    """A row for each design: replaced values, outcome, strokes, K, least transmission angles."""
    names = tuple(dict.fromkeys(name for o in outcomes for name in o.cells))
    rows = (
        (o.design + 1, *sweep.designs[o.design], o.status, *map(o.cells.get, names), str(o.why)) for o in outcomes
    )
    return Table.of(("design", *sweep.designs.keys, "status", *names, "why"), rows)
