"""Designs: one scene with some of its numbers replaced, in a grid, a list, or as the rows of a CSV file; and the effect
of a scene file's keys on the numbers of its mechanism, found once by reading the scene a few times.

Nearly every number of a file acts in one of two ways: lengths, places and rates change as a straight line with it,
directions turn with an angle.  Three readings give the line or the turn, one more with all keys changed proves that
they act independently.  So points that are placed from others, in any unit, also follow as the reader places them.
"""

from __future__ import annotations

import copy
import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphkin.errors import CallError, Problem, SceneError, as_text, unfit
from graphkin.files import OwnTables, Tables, path_of
from graphkin.scene import mechanism_of
from graphkin.scene.model import Dimension, Mechanism, changed_beside, dimensions
from graphkin.scene.scene import put
from graphkin.scene.tables import path_of_key, value_at
from graphkin.solver.algebra.pose import turned
from graphkin.table import table_of, with_points
from graphkin.words import Phrase, listed

Value = float | str
MOST_DESIGNS = 10_000_000
MOST_ROWS = 1_000_000
MOST_BYTES = 200_000_000


@dataclass(frozen=True)
class Designs:
    """The replaced numbers of each design: keys of the scene file with dots, and their values.

    ``rows`` give a value for each of the first keys, ``grid`` the values of the others; every combination is a design,
    the last key changes fastest.  In a part ``first`` is the number of its first design, and ``kinds`` tells of the
    whole for each key whether some of its values are words.
    """

    keys: tuple[str, ...] = ()
    grid: tuple[tuple[Value, ...], ...] = ()
    rows: tuple[tuple[Value, ...], ...] | None = None
    first: int = 0
    kinds: tuple[bool, ...] | None = None

    def __len__(self) -> int:
        each = math.prod(len(values) for values in self.grid)
        return each if self.rows is None else each * len(self.rows)

    @cached_property
    def worded(self) -> tuple[bool, ...]:
        """For each key whether some of its values are words."""
        if self.kinds is not None:
            return self.kinds
        named = len(self.keys) - len(self.grid)
        words = [any(isinstance(r[k], str) for r in self.rows or ()) for k in range(named)]
        return (*words, *(any(isinstance(v, str) for v in values) for values in self.grid))

    def part(self, first: int, last: int) -> Designs:
        """The designs from one number to another, which is not included."""
        rows = tuple(self[k] for k in range(first, min(last, len(self))))
        return Designs(self.keys, (), rows if self.keys else None, first, self.worded)

    def __getitem__(self, index: int) -> tuple[Value, ...]:
        """The values of one design, in the order of the keys."""
        values: list[Value] = []
        for choices in reversed(self.grid):
            index, k = divmod(index, len(choices))
            values.append(choices[k])
        values.reverse()
        return (*(self.rows[index] if self.rows is not None else ()), *values)


def designs_of(
    given: Mapping[str, str | Sequence[Value] | Value] | None, table: str | os.PathLike[str] | None = None
) -> Designs:
    """Designs from grids and lists, and from a CSV file; both together give every combination.

    Parameters
    ----------
    given : for each key "a:b:n" (n values evenly from a to b), "a,b,c", a value, or a sequence of values
    table : a CSV file whose heads are the keys

    Raises
    ------
    CallError : naming every value, key and row that is wrong
    """
    if given is not None and not isinstance(given, Mapping):
        raise unfit("designs", given, "give values by keys links.1.length 40 50")
    problems: list[Problem] = []
    grid: dict[str, tuple[Value, ...]] = {}
    for key, values in ((as_text("designs", key), values) for key, values in (given or {}).items()):
        try:
            grid[key] = _values(values)
        except (TypeError, OverflowError):
            problems.append(Problem(f"--set {key}", "found value", "give a number or several", value=f"{values!r:.60}"))
        except ValueError as error:
            problems.append(Problem(f"--set {key}", error.args[0], "write key 40 60 21 key 40 50"))
    rows: tuple[tuple[Value, ...], ...] | None = None
    keys: tuple[str, ...] = ()
    if table is not None:
        keys, rows = read_designs(table)
        twice = [key for key in grid if key in keys]
        problems += [Problem(f"--set {key}", "is a column of too", "give it once", table=table) for key in twice]
    if problems:
        raise CallError(*problems)
    made = Designs((*keys, *grid), tuple(grid.values()), rows)
    if len(made) > MOST_DESIGNS:
        raise CallError.of("designs", "of them", "at most are possible", count=len(made), limit=MOST_DESIGNS)
    return made


def _values(given: str | Sequence[Value] | Value) -> tuple[Value, ...]:
    if isinstance(given, bool):
        raise ValueError(Phrase("found value", value=given))
    if isinstance(given, Real):  # those of NumPy too
        return (_finite(float(given)),)
    if not isinstance(given, str):
        values = tuple(v if isinstance(v, str) else _finite(float(v)) for v in list(given))  # type: ignore[arg-type]
        if not values:
            raise ValueError(Phrase("there are no values"))
        return values
    text = given.strip()
    parts = text.split(":")
    if len(parts) == 3:
        try:
            low, high, n = _finite(float(parts[0])), _finite(float(parts[1])), int(parts[2])
        except ValueError:
            raise ValueError(Phrase("is no grid", text=text)) from None
        if not 1 <= n <= MOST_DESIGNS:
            raise ValueError(Phrase("a grid of values", number=n))
        if n == 1:
            return (low,)
        # both ends exactly, and the same numbers on every machine
        return tuple(low + (high - low) * k / (n - 1) if k < n - 1 else high for k in range(n))
    if not text:
        raise ValueError(Phrase("there is no value"))
    return tuple(_value(part) for part in text.split(","))


def _value(text: str) -> Value:
    text = text.strip()
    if not text:
        raise ValueError(Phrase("a value is empty"))
    if text[0] == text[-1] == '"' and len(text) > 1:  # a text that is a number, as in the file
        return text[1:-1]
    try:
        return _finite(float(text))
    except ValueError:
        if text.lower().strip("+-") in ("inf", "nan", "infinity"):
            raise
        return text


def _finite(value: float) -> float:
    if not math.isfinite(value):
        raise ValueError(Phrase("is no number of a scene", value=value))
    return value


def read_designs(path: str | os.PathLike[str]) -> tuple[tuple[str, ...], tuple[tuple[Value, ...], ...]]:
    """Keys and rows of a CSV file of designs.  Raises CallError, naming the row."""
    shown, table = path_of(path), with_points(table_of(path, MOST_BYTES), path)
    if len(table.rows) > MOST_ROWS:
        raise CallError.of(str(shown), "holds more than designs", most=MOST_ROWS)
    keys = table.heads
    problems = [
        Problem(Phrase("row", name=shown, number=1), Phrase("stands twice of key", key=k))
        for i, k in enumerate(keys) if k in keys[:i]
    ]
    rows: list[tuple[Value, ...]] = []
    for number, line in table.rows:
        if len(line) != len(keys):
            problems.append(Problem(Phrase("row", name=shown, number=number), "has cells the head has", count=len(line),
                                    other=len(keys)))
            continue
        try:
            rows.append(tuple(_value(cell) for cell in line))
        except ValueError as error:
            problems.append(Problem(Phrase("row", name=shown, number=number), error.args[0]))
    if problems:
        raise CallError(*problems[:20])
    return keys, tuple(rows)


def applied(source: Tables, keys: Sequence[str], values: Sequence[Value]) -> OwnTables:
    """A scene's mapping with some numbers replaced.

    Keys are those of the file with dots: ``links.1.length``, ``frame.points.D.x`` (or ``.1``: items of lists are
    counted from 1, as in messages), ``driver.omega``, ``driver.2.angle`` of the second ``[[driver]]``.

    Raises
    ------
    CallError : naming every key that the scene does not have
    """
    made = copy.deepcopy(dict(source))
    problems = []
    for key, value in zip(keys, values, strict=True):
        problem = put(made, key, value)
        if problem is not None:
            problems.append(replace(problem, where=f"--set {key}"))
    if problems:
        raise CallError(*problems)
    return made


# what keys do


Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]

SAME = 1e-12
"""Numbers of two readings that differ by less, beside the largest of them, are the same."""


_Law = Callable[[Reals], Complexes]
"""A number of the mechanism by the values of a key."""


def _law(first: complex, change: complex, begin: float, step: float, turning: bool) -> _Law:
    """The law of a number: its value at ``begin`` plus its ``change`` over a ``step`` times the number of steps to the
    value, or turned by the value's change (deg)."""

    def along(value: ArrayLike) -> Complexes:
        numbers = np.asarray(value, dtype=float)
        return turned(np.radians(numbers)) if turning else numbers.astype(complex)

    start, end = along(begin), along(begin + step)
    return lambda values: np.asarray(first + change * ((along(values) - start) / (end - start)))


Numbers = Callable[[Mapping[str, Reals]], dict[Dimension, Complexes]]
"""The numbers of a mechanism that change, by values of keys in their units, shape (designs,) each.  Raises CallError
for a value that is no finite number, and for a length that is not positive."""


def design_keys(source: Tables, scene: Mechanism, keys: Sequence[str]) -> Numbers:
    """Find the effect of keys on the numbers of the mechanism (SI).

    Parameters
    ----------
    source : the tables and keys of the scene's file
    keys : with dots: "links.1.length", "frame.points.D.x", "driver.rate"

    Raises
    ------
    CallError : a key that the scene does not have, that holds no number, that changes no number of the mechanism or not
        by itself, or keys that do not act independently; a driver whose value or rate follows from dimensions
    """
    written = mechanism_of(source)
    if any(d.distance is not None or d.given_speed or d.position for d in written.drivers):
        raise CallError.of("designs", "the driver follows from dimensions", "give its value instead")
    laws: dict[str, dict[Dimension, _Law]] = {}
    changed: dict[str, float] = {}
    for key in keys:
        begin, step = _begin(source, key)
        changed[key] = begin + step
        read = [_read(source, {key: begin + k * step}) for k in range(3)]
        laws[key] = _laws(key, begin, step, [dimensions(mechanism) for mechanism in read])
        beside = dict.fromkeys(part for mechanism in read for part in changed_beside(written, mechanism))
        if beside:
            raise CallError.of(f"designs {key}", "changes more than dimensions", "sweep over it graphkin.sweep designs",
                               beside=listed([*beside]))
    given = dimensions(scene)

    def numbers(values: Mapping[str, Reals]) -> dict[Dimension, Complexes]:
        result: dict[Dimension, Complexes] = {}
        for key, of_key in values.items():
            low = 0.0 if key.endswith(".length") else -math.inf
            bad = ~(np.isfinite(of_key) & (of_key > low))
            if bad.any():
                wanted = Phrase("give lengths above 0") if low == 0 else Phrase("give finite numbers")
                raise CallError.of(f"designs {key}", "found value", wanted, value=f"{of_key[int(np.argmax(bad))]:g}")
            for name, law in laws[key].items():
                new = law(of_key)
                result[name] = result[name] + (new - given[name]) if name in result else new
        return result

    if len(keys) > 1:
        together = numbers({key: np.array([value]) for key, value in changed.items()})
        for name, expected in dimensions(_read(source, changed)).items():
            mine = complex(together[name][0]) if name in together else given[name]
            if abs(mine - expected) > 10 * SAME * max(abs(given[name]), abs(expected), scene.size):
                raise CallError.of(f"designs {', '.join(keys)}", "act on together not side by side",
                                   "sweep over them graphkin.sweep designs", name=name[1])
    return numbers


def _begin(source: Tables, key: str) -> tuple[float, float]:
    """A value of a key and a step from it: the file's value if it has one."""
    path = path_of_key(source, key)
    begin = None if path is None else value_at(source, path)
    if not isinstance(begin, Real) or begin == 0:  # of what is no number the reader says what is wrong
        return 0.0, 1.0
    return float(begin), abs(float(begin)) / 8


def _read(source: Tables, values: Mapping[str, float]) -> Mechanism:
    try:
        return mechanism_of(applied(source, tuple(values), tuple(values.values())))
    except SceneError as error:
        where = f"designs {', '.join(values)}"
        raise CallError.of(where, "changed by itself the scene no longer fits", error=error.reason) from None


def _laws(
    key: str, begin: float, step: float, readings: Sequence[Mapping[Dimension, complex]]
) -> dict[Dimension, _Law]:
    """The laws of all numbers that a key changes, from three readings a step apart."""
    laws: dict[Dimension, _Law] = {}
    w = complex(turned(np.radians(np.array([step])))[0])
    for name in readings[0]:
        a, b, c = (numbers[name] for numbers in readings)
        size = SAME * max(abs(a), abs(b), abs(c))
        if abs(b - a) <= size and abs(c - b) <= size:
            continue
        if abs((c - b) - (b - a)) <= size:
            laws[name] = _law(a, b - a, begin, step, turning=False)
        elif abs((c - b) - w * (b - a)) <= size:
            laws[name] = _law(a, b - a, begin, step, turning=True)
        else:
            raise CallError.of(f"designs {key}", "changes neither as a line nor as a",
                               "sweep over it graphkin.sweep designs", name=name[1])
    if not laws:
        raise CallError.of(f"designs {key}", "changes no dimension of the mechanism and no")
    return laws
