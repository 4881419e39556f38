"""A mechanism made ready to give a few quantities at very many positions, or at one in microseconds."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from graphkin.scene.model import Dimension, Mechanism, dimensions
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Measure, Units
from graphkin.solver.algebra.bounds import error_bounds
from graphkin.solver.algebra.expressions import Code, Name, Real, Vec
from graphkin.solver.algebra.pose import GIVEN, UNIT, Array, Drive, turned
from graphkin.solver.compiled.engine import SINGULAR, State, positions
from graphkin.solver.compiled.kernel import LONG, Kernel
from graphkin.solver.compiled.program import DimensionedProgram, Program, program_of
from graphkin.solver.drivers import GivenValues, UniformGrid, quarter
from graphkin.solver.forces import forces_of, settled_value, value_of
from graphkin.solver.mobility import structure_of
from graphkin.solver.path.dead_points import singular
from graphkin.solver.path.driver_range import DriverRange, range_of
from graphkin.solver.quantities import Posed, bound_of_symbol, formula_of_symbol
from graphkin.structure import Structure, kept_with

CHUNK = 16384  # positions in a piece, so that all columns of one stay in the cache
PRODUCTS = 4
"""Roundings in the cosine and sine of an angle, those of many even steps included."""
RESIDUE = 16 * UNIT  # of what moves: a few roundings
BESIDE = 1e-12
"""A position as near to the end of the motion (rad) is looked at."""
FEW = 1000
"""So many positions are looked at one by one sooner than the parts of the range are found that need no look."""


@dataclass(frozen=True)
class PreparedMechanism:
    """A mechanism with its assembly followed over the range of its first driver, and the code for what is asked.

    asked : the formulas of the columns, except those of solved quantities
    wanted : the asked quantities that have formulas
    units : of the columns, as tables have them; SI without any
    bounded : whether columns of bounds follow all others, one for each quantity; they are made from the constraints of
        all links, some hundred times slower than the values
    solved : the asked quantities without formulas, as forces: they come last, and are solved position by position,
        some hundred times slower
    open : numbers of the formulas that are given for each design
    """

    range: DriverRange
    asked: tuple[Real, ...]
    dimensioned: DimensionedProgram
    wanted: tuple[Symbol, ...]
    units: Units | None = None
    bounded: bool = False
    solved: tuple[Symbol, ...] = ()
    open: frozenset[Name] = frozenset()

    def __reduce__(self) -> tuple[object, ...]:
        # what was asked is pickled, the code for it is made anew
        assert not self.open
        return prepare, (self.structure, (*self.wanted, *self.solved), self.units, self.bounded, self.range)

    @cached_property
    def columns_of(self) -> dict[str, Symbol]:
        """The quantity of each column; of a vector two, "v_B.x" and "v_B.y"."""
        return {head: symbol for symbol in (*self.wanted, *self.solved) for head in symbol.heads}

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The names of the columns."""
        return tuple(self.columns_of)

    @property
    def rows(self) -> int:
        """The rows of the array of columns: bounds come last."""
        return len(self.names) + (len(self.wanted) + len(self.solved)) * self.bounded

    def _factor(self, symbol: Symbol) -> float:
        return _factor(symbol.measure, self.units)

    @cached_property
    def residues(self) -> Array:
        """The size of a few roundings in each column, by the size of the mechanism and the motion of its drivers, shape
        (columns,); 0 of solved quantities, which have none left."""
        scene, rate, second = self.structure.scene, 0.0, 0.0
        for driver in scene.drivers:
            by = 1.0 if driver.turns else 1.0 / scene.size
            rate, second = rate + by * abs(driver.values[1]), second + by * abs(driver.values[2])

        def left(symbol: Symbol) -> float:
            if symbol in self.solved:
                return 0.0
            usual: float = symbol.measure.usual(scene.size, rate, second + rate**2)
            return RESIDUE * usual * self._factor(symbol)

        return np.array([left(symbol) for symbol in self.columns_of.values()])

    @cached_property
    def by_newton(self) -> bool:
        """Whether there is a larger group, whose poses are found by Newton's method before the formulas are used."""
        return not all(e.explicit for e in self.structure.elements)

    # the way of the driver

    @property
    def structure(self) -> Structure:
        return self.range.structure

    @cached_property
    def turns(self) -> bool:
        """Whether the first driver is an angle."""
        return self.range.driver.turns

    @cached_property
    def signs(self) -> dict[Name, float] | None:
        """The assembly of each group, if it is the same everywhere."""
        if len(self.range.ahead.flips) or len(self.range.behind.flips) or self.by_newton:
            return None
        return self._signs(0.0)

    def _signs(self, offset: float) -> dict[Name, float]:
        """The assembly of each group at an offset."""
        modes = self.range.modes(np.array([offset / abs(self.range.wide)]))
        return {("sign", i): float(mode[0]) for i, mode in modes.items() if mode.ndim == 1}

    @cached_property
    def _parts(self) -> Array:
        """The parts of the range in which no position needs examination, as ``DriverRange.clear``."""
        return np.zeros((0, 2)) if self.by_newton else self.range.clear

    @cached_property
    def _regular(self) -> bool:
        """Whether no position of a whole turn needs examination."""
        return self.whole and np.array_equal(self._parts, [[0.0, abs(self.range.wide)]])

    @cached_property
    def clear(self) -> bool:
        """Whether no position needs examination: a whole turn of one assembly, far from every dead point."""
        return self._regular and not self.solved and not self.bounded

    @cached_property
    def _of_table(self) -> list[tuple[float, float, int]]:
        """The first and the last offset of a table in each clear part of the range, with its number, and in what the
        motion does not reach, with -1; in increasing order."""
        (low, high), turn = self.range.ends, 2 * math.pi
        parts = [(begin, end, k) for k, (begin, end) in enumerate(self._parts.tolist())]
        if self.turns and not self.whole:
            repeats = not self.range.rolls_apart
            parts += [(max(begin + turn, high), end + turn, k) for begin, end, k in parts if repeats]
            parts.append((high + BESIDE, low + turn - BESIDE if repeats else math.inf, -1))
        return sorted(parts)

    def _divided(self, steps: GivenValues | UniformGrid) -> tuple[list[tuple[int, slice | Array]], list[slice], Array]:
        """The positions in each clear part of the range, by its number; those that the motion does not reach; and
        the others, which are looked at one by one."""
        clear, away, careful, last = list[tuple[int, slice | Array]](), list[slice](), list[Array](), 0
        if not isinstance(steps, UniformGrid):
            offset = self.range.offsets(steps.values)
            part_of = np.searchsorted(self._parts[:, 0], offset, "right") - 1
            part_of[offset > np.append(self._parts[:, 1], -np.inf)[part_of]] = -1
            return [(k, np.flatnonzero(part_of == k)) for k in range(len(self._parts))], [], np.flatnonzero(part_of < 0)
        origin, following = self.range.table_offsets(steps.n, np.arange(2)).tolist()
        step = following - origin
        for begin, end, part in self._of_table if step else ():
            first = max(last, math.ceil((begin - origin) / step) - steps.first)
            stop = math.floor(min((end - origin) / step, steps.last - 1)) + 1 - steps.first
            if first >= stop:
                continue
            if first > last:
                careful.append(np.arange(last, first))
            if part < 0:
                away.append(slice(first, stop))
            else:
                clear.append((part, slice(first, stop)))
            last = stop
        return clear, away, np.concatenate([*careful, np.arange(last, len(steps))])

    def _reached(self, steps: GivenValues | UniformGrid, some: Array | None = None) -> Array:
        """Whether the motion reaches all positions, or some; of a grid by their numbers, which takes a sixth less time
        for a sweep than by its values."""
        reach, some = self.range, np.arange(len(steps)) if some is None else some
        if not isinstance(steps, UniformGrid):
            return reach.reaches(reach.offsets(steps.values[some]))
        if not self.turns:
            return np.ones(len(some), dtype=bool)  # even steps of a travel lie inside the range
        offset, (low, high) = reach.table_offsets(steps.n, steps.first + some), reach.ends
        ahead = offset <= high
        return ahead if reach.rolls_apart else np.asarray(ahead | (offset >= low + 2 * math.pi))

    # code

    @cached_property
    def _held(self) -> dict[Name, float]:
        """Units, rates of the drivers, and values of those but the first."""
        held: dict[Name, float] = {("per", s.measure.name): self._factor(s) for s in self.wanted}
        count = len(self.structure.scene.drivers)
        for k, driver in enumerate(self.structure.drivers):
            _, rate, second = driver.values
            held["rate", k], held["second", k] = rate, second
            if 0 < k < count:
                u = complex(turned(self.range.start[k : k + 1])[0])
                held["cos", k], held["sin", k], held["travel", k] = u.real, u.imag, float(self.range.start[k])
        return held

    @cached_property
    def _value_errors(self) -> Array:
        """The error bounds of the values of drivers and their followers over the range, shape (drivers,)."""
        scene = self.structure.scene
        ends = np.abs(self.range.start) + abs(self.range.wide) * (np.arange(len(scene.drivers)) == 0)
        followers = [abs(d.values[0]) + float(np.abs(d.ratios) @ ends) for d in self.structure.followers]
        turning = np.array([d.turns for d in self.structure.drivers])
        return GIVEN * np.array([*ends, *followers]) + PRODUCTS * UNIT * turning

    @cached_property
    def code(self) -> Code:
        """The code of the asked formulas for positions in one assembly that need no examination."""
        return Code(self.dimensioned.program.graph, self.asked, self.fixed.keys() | self._signs(0.0).keys(), self.open)

    @cached_property
    def examined(self) -> Code:
        """The code of the asked formulas, and after them of the sines of groups, for positions that are looked at."""
        program = self.dimensioned.program
        return Code(program.graph, (*self.asked, *(group.sine for group in program.groups.values())), self.fixed)

    @cached_property
    def checks(self) -> Code:
        """The discriminants of its groups."""
        program = self.dimensioned.program
        return Code(program.graph, [group.discriminant for group in program.groups.values()], self.fixed, self.open)

    @cached_property
    def by_design(self) -> Code:
        """The code of the asked formulas with the open numbers among the params: for designs in turn."""
        return Code(self.dimensioned.program.graph, self.asked, {*self.fixed, *self.open})

    @cached_property
    def fixed(self) -> dict[Name, float]:
        """Numbers of the formulas that are no dimensions and the same everywhere."""
        numbers = {**self._held, **(self.signs or {})}
        return {name: number for name, number in numbers.items() if name not in self.open}

    @cached_property
    def dimensions(self) -> dict[Dimension, complex]:
        """The numbers in which its designs may differ (SI)."""
        return dimensions(self.structure.scene)

    @kept_with
    def opened(self, names: frozenset[Name], moving: tuple[bool, ...]) -> PreparedMechanism:
        """The mechanism with some numbers of the formulas open, to be given for each design; made once.  ``moving``
        tells for each driver whether it has a second rate in some of them."""
        dimensioned = program_of(self.structure, moving, names)
        asked = formulas(dimensioned.program, self.structure, self.wanted, self.units)
        return replace(self, dimensioned=dimensioned, asked=tuple(by_columns(asked).values()), open=names)

    def given(self, code: Code) -> list[float]:
        return self.dimensioned.params(code.params, self.fixed)

    @kept_with
    def invariants(self, code: Code) -> list[Array] | None:
        """The numbers that are the same at all positions, and in all designs; computed once."""
        return code.invariants(self.given(code))

    # one position

    def at(self, value: float) -> tuple[float, ...] | None:
        """The asked quantities at one value of the first driver, in plain floats; None where the position does not
        exist or is a dead point.  With solved quantities the bounds come after them."""
        return self._one(value)

    @cached_property
    def _one(self) -> Callable[[float], tuple[float, ...] | None]:
        if self.by_newton or self.solved:
            return self._by_columns
        code = self.examined
        function, params, names, count = code.floats, self.given(code), code.inputs, len(self.asked)
        everywhere, steady, around = self.whole, self.signs is not None, self.turns and not self.range.rolls_apart
        start, sense, (low, high) = float(self.range.start[0]), self.range.sense, self.range.ends
        place = {"cos": 0, "sin": 1, "travel": 2}
        order = [place.get(name[0], 3) for name in names]

        def one(value: float) -> tuple[float, ...] | None:
            if not everywhere:
                # what the range says of arrays (``reaches``), in plain floats
                offset = sense * (value - start)
                if around and not low <= offset <= high:
                    offset %= 2 * math.pi
                    offset -= 2 * math.pi if offset > high else 0.0
                if not low <= offset <= high:
                    return None
            given = (*quarter(value), value)
            if steady:
                inputs = [given[k] for k in order]
            else:
                signs = self.signs_at(np.array([value]))
                inputs = [given[k] if k < 3 else float(signs[n][0]) for k, n in zip(order, names, strict=True)]
            try:
                numbers = function(params, inputs)
            except (ZeroDivisionError, OverflowError):
                return None
            for sine in numbers[count:]:
                if -SINGULAR < sine < SINGULAR:
                    return None
            return numbers[:count]

        return one

    def _by_columns(self, value: float) -> tuple[float, ...] | None:
        columns, ok = self.columns(np.array([value]))
        return tuple(columns[:, 0].tolist()) if ok[0] else None

    @property
    def whole(self) -> bool:
        return self.range.full

    def _modes_at(self, value: Array) -> dict[int, Array]:
        """The assembly mode of each group at values of the first driver; beyond its range the mode at its end."""
        return self.range.modes(self.range.offsets(value) / abs(self.range.wide))

    def signs_at(self, value: Array) -> dict[Name, Array]:
        """The assembly of each group at values of the first driver, if it changes."""
        return {("sign", i): mode for i, mode in self._modes_at(value).items() if mode.ndim == 1}

    # many

    @cached_property
    def numbers(self) -> list[Array]:
        """The inputs of compiled code in each clear part of the range: the params, then start and way of the driver
        over its range."""
        grid = self.range.grid(1)
        assert isinstance(grid, UniformGrid)  # where the motion starts it is
        fixed = ({**self.fixed, **self._signs(float(part.mean()))} for part in self._parts)
        return [np.array([*self.dimensioned.params(self.code.params, known), grid.start, grid.way]) for known in fixed]

    @cached_property
    def on_grid(self) -> Kernel:
        """The code at even steps; with open numbers for designs in turn."""
        return Kernel(self.by_design if self.open else self.code, self.turns, True)

    @cached_property
    def _at_values(self) -> Kernel:
        return Kernel(self.code, self.turns, False)

    def columns(self, values: Array, out: Array | None = None, fast: bool = False) -> tuple[Array, Array]:
        """The asked quantities at many values of the first driver.

        Parameters
        ----------
        values : shape (n,) (rad, m)
        out : array for them, shape (len(names), n)
        fast : compile the formulas with numba, and run them on all cores where the positions are many; the first call
            takes some seconds

        Returns
        -------
        columns : shape (len(names), n), in SI; NaN where not ok
        ok : bool, shape (n,): False where the motion does not reach the position, and at dead points

        Raises
        ------
        CallError : ``fast`` without numba
        """
        values = np.asarray(values, dtype=float)
        out = np.empty((self.rows, len(values))) if out is None else out
        return out, self._all(GivenValues(values), out, fast)

    def _all(self, steps: GivenValues | UniformGrid, out: Array, fast: bool) -> Array:
        """All columns: those of formulas, below them the solved ones, at last the bounds of both, infinite where they
        are unknown; NaN where the position does not exist."""
        count, n = len(self.asked), len(steps)
        ok = self._formulas(steps, out[:count], fast) if count or not self.solved else self._reached(steps)
        if not (self.solved or self.bounded):
            return ok
        bounds = out[len(self.names) :]
        if self.solved:
            ok = ok & self._solve(steps.values, out[count : len(self.names)], bounds[len(self.wanted) :])
        for k in range(0, n if self.bounded and self.wanted else 0, CHUNK):
            some = slice(k, k + CHUNK)
            self._bounds(steps.values[some], ok[some], bounds[: len(self.wanted), some])
        bounds[np.isnan(bounds)] = np.inf
        if not ok.all():
            np.copyto(out, np.nan, where=~ok)
        return ok

    def _solve(self, values: Array, rows: Array, bounds: Array) -> Array:
        """The columns of solved quantities at values of the first driver, bounds of those that are forces, and whether
        all are known there."""
        motion = self.range.motion(self.range.offsets(values))
        forces = forces_of(motion) if any(symbol.is_load for symbol in self.solved) else None
        columns = {symbol: settled_value(motion, symbol) * self._factor(symbol) for symbol in self.solved}
        for row, part in zip(rows, by_columns(columns).values(), strict=True):
            row[:] = part
        for row, symbol in zip(bounds, self.solved if self.bounded else (), strict=True):
            bound = forces.bound[symbol.measure.length] if forces and symbol.is_load else math.inf
            row[:] = bound * self._factor(symbol)
        return motion.ok if forces is None else forces.ok

    def _formulas(self, steps: GivenValues | UniformGrid, out: Array, fast: bool) -> Array:
        """The columns of formulas, and whether the position exists; NaN where it does not."""
        n, compiled = len(steps), fast and not self.by_newton
        if self._regular:
            self._clear(0, steps, slice(0, n), out, compiled)
            return _every(n)
        clear, away, careful = self._divided(steps) if n > FEW else ([], [], np.arange(n))
        ok = np.ones(n, dtype=bool)
        for part, some in clear:
            self._clear(part, steps, some, out, compiled)
        for gap in away:
            ok[gap], out[:, gap] = False, np.nan
        for some in (careful[k : k + CHUNK] for k in range(0, len(careful), CHUNK)):
            out[:, some], ok[some] = self._examined(steps, some)
        return ok

    def _clear(
        self, part: int, steps: GivenValues | UniformGrid, some: slice | Array, out: Array, compiled: bool
    ) -> None:
        """The columns at positions of a clear part of the range."""
        numbers = self.numbers[part]
        if not isinstance(some, slice):
            columns = np.empty((len(out), len(some)))
            self._clear(part, steps[some], slice(0, len(some)), columns, compiled)
            out[:, some] = columns
        elif compiled:
            kernel = self.on_grid if isinstance(steps, UniformGrid) else self._at_values
            kernel(some.start, some.stop, numbers, *steps.given, out)
        else:
            invariants = self.code.invariants(numbers[:-2].tolist())
            for k in range(some.start, some.stop, CHUNK):
                few = slice(k, min(k + CHUNK, some.stop))
                given = self._driven(steps[few])
                self.code.arrays(invariants, [given[name] for name in self.code.inputs], list(out[:, few]))

    def _driven(self, steps: GivenValues | UniformGrid) -> dict[Name, Array]:
        """The inputs of the formulas that the first driver gives."""
        if not self.turns:
            return {("travel", 0): steps.values}
        cosine, sine = steps.turn
        return {("cos", 0): cosine, ("sin", 0): sine}

    def _examined(self, steps: GivenValues | UniformGrid, some: Array) -> tuple[Array, Array]:
        """The columns at positions that are looked at one by one, and whether these exist; NaN where they do not."""
        reached, count = self._reached(steps, some), len(self.asked)
        columns, there = np.full((count, len(some)), np.nan), steps[some[reached]]
        if not len(there):
            return columns, reached
        given, ok = self._driven(there), np.ones(len(there), dtype=bool)
        given |= self.signs_at(there.values) if self.signs is None else {}
        if self.by_newton:
            state = self._state(there.values)
            given |= state.given
            for _, dead in singular(self.structure, state, len(there)):
                ok &= ~dead
        numbers = np.empty((len(self.examined.asked), len(there)))
        inputs = [given[name] for name in self.examined.inputs]
        self.examined.arrays(self.invariants(self.examined), inputs, list(numbers))
        ok &= (np.abs(numbers[count:]) >= SINGULAR).all(axis=0)
        numbers[:, ~ok] = np.nan
        columns[:, reached], reached[reached] = numbers[:count], ok
        return columns, reached

    def _bounds(self, value: Array, ok: Array, out: Array) -> None:
        """Bounds of the rounding errors of each quantity's columns, at the values that are ok."""
        if not ok.any():
            return
        structure, state = self.structure, self._state(value[ok])
        errors = np.broadcast_to(self._value_errors, state.drive.value.shape)
        links = error_bounds(structure, state.poses, state.drive, state.slack, state.refined, errors)
        posed = Posed(structure, state.poses, structure.slides)
        for row, symbol in zip(out, self.wanted, strict=True):
            row[ok] = bound_of_symbol(posed, symbol, links) * self._factor(symbol)

    def _state(self, value: Array) -> State:
        """The mechanism at values of the first driver that the motion reaches, in 16 digits."""
        drivers = np.repeat(self.range.start[None], len(value), axis=0)
        drivers[:, 0] = value
        return positions(self.structure, Drive.at(self.structure, drivers), self._modes_at(value), extended=False)

    def sweep(self, n: int, out: Array | None = None, fast: bool = False) -> tuple[Array, Array]:
        """``columns`` at n positions of the whole range."""
        out = np.empty((self.rows, n)) if out is None else out
        if fast and n < LONG and self.clear:
            # nothing but the call: at some hundred positions each line here would be felt
            self.on_grid.run(0, n, self.numbers[0], n, 0, out)
            return out, _every(n)
        return out, self._all(self.range.grid(n), out, fast)


@lru_cache
def _every(n: int) -> Array:
    """n times True, not to be written."""
    return np.ndarray((n,), np.bool_, b"\1", 0, (0,))


def prepare(
    scene: Mechanism | Structure,
    asked: Sequence[Symbol],
    units: Units | None = None,
    bounded: bool = False,
    along: DriverRange | None = None,
) -> PreparedMechanism:
    """Make a mechanism ready for many positions.

    Parameters
    ----------
    scene : a scene, or its structure
    asked : quantities of a position, each once
    units : of the columns, as tables have them; SI without any
    bounded : after all others a column for each quantity, with a bound of its values' rounding errors
    along : the range of its first driver, if it is known already

    Raises
    ------
    CallError : a quantity that the mechanism does not have
    Unsolvable, SceneError : as for ``solve``
    """
    structure = structure_of(scene)
    dimensioned = program_of(structure, tuple(d.values[2] != 0 for d in structure.drivers))
    made = formulas(dimensioned.program, structure, asked, units)
    along, solved = along or range_of(structure), tuple(symbol for symbol in asked if symbol not in made)
    for symbol in solved:
        value_of(along.motion(np.zeros(1)), symbol)
    return PreparedMechanism(
        along, tuple(by_columns(made).values()), dimensioned, tuple(made), units, bounded, solved
    )


def _factor(measure: Measure, units: Units | None) -> float:
    """The factor from a quantity in SI to the columns' unit."""
    return 1.0 if units is None else float(units.of(measure).of(1.0))


def formulas(
    program: Program, structure: Structure, asked: Iterable[Symbol], units: Units | None = None
) -> dict[Symbol, Real | Vec]:
    """The formula of each quantity that has one, in ``units`` as tables have them, SI without any."""
    made: dict[Symbol, Real | Vec] = {}
    posed = Posed(structure, program.poses, structure.slides, program.number)
    for symbol in asked:
        formula = formula_of_symbol(posed, symbol)
        if formula is not None and _factor(symbol.measure, units) != 1.0:
            formula = formula * program.graph.param(("per", symbol.measure.name))
        if formula is not None:
            made[symbol] = formula
    return made


def by_columns(values: Mapping[Symbol, Any]) -> dict[str, Any]:
    """Values, or formulas, by the names of columns: of a vector its two components."""
    return {head: getattr(value, part) for symbol, value in values.items()
            for head, part in zip(symbol.heads, ("real", "imag"), strict=False)}
