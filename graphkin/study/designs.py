"""Designs: one scene with some of its numbers replaced, in a grid, a list, or as the rows of a CSV file."""

from __future__ import annotations

import copy
import csv
import io
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from numbers import Real

from graphkin.errors import CallError, Problem, as_text
from graphkin.files import OwnTables, Tables, opened, path_of
from graphkin.scene.scene import put
from graphkin.words import Phrase, from_others

__all__ = ["Designs", "Value", "applied", "designs_of", "read_designs"]

Value = float | str
MOST_DESIGNS = 10_000_000
MOST_ROWS = 1_000_000


@dataclass(frozen=True)
class Designs:
    """What is replaced in each design: keys of the scene file with dots, and their values.

    ``rows`` give one value for the first keys each, ``grid`` the values of the others; every combination is a design,
    the last key changes fastest.
    """

    keys: tuple[str, ...] = ()
    grid: tuple[tuple[Value, ...], ...] = ()
    rows: tuple[tuple[Value, ...], ...] | None = None

    def __len__(self) -> int:
        each = math.prod(len(values) for values in self.grid)
        return each if self.rows is None else each * len(self.rows)

    @cached_property
    def worded(self) -> tuple[bool, ...]:
        """For each key whether some of its values are words."""
        named = len(self.keys) - len(self.grid)
        words = [any(isinstance(r[k], str) for r in self.rows or ()) for k in range(named)]
        return (*words, *(any(isinstance(v, str) for v in values) for values in self.grid))

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
    table : a CSV file whose head names the keys

    Raises
    ------
    CallError : naming every value, key and row that is wrong
    """
    if given is not None and not isinstance(given, Mapping):
        raise CallError(
            Problem(
                "designs",
                Phrase("found value", value=f"{given!r:.60}"),
                Phrase("give values by keys links.1.length 40 50"),
            )
        )
    problems: list[Problem] = []
    grid: dict[str, tuple[Value, ...]] = {}
    for key, values in ((as_text("designs", key), values) for key, values in (given or {}).items()):
        try:
            grid[key] = _values(values)
        except (TypeError, OverflowError):
            problems.append(
                Problem(
                    f"--set {key}", Phrase("found value", value=f"{values!r:.60}"), Phrase("give a number or several")
                )
            )
        except ValueError as error:
            problems.append(Problem(f"--set {key}", error.args[0], Phrase("write key 40 60 21 key 40 50")))
    rows: tuple[tuple[Value, ...], ...] | None = None
    keys: tuple[str, ...] = ()
    if table is not None:
        keys, rows = read_designs(table)
        twice = [key for key in grid if key in keys]
        problems += [
            Problem(f"--set {key}", Phrase("is a column of too", table=table), Phrase("give it once")) for key in twice
        ]
    if problems:
        raise CallError(*problems)
    made = Designs((*keys, *grid), tuple(grid.values()), rows)
    if len(made) > MOST_DESIGNS:
        raise CallError(
            Problem("designs", Phrase("of them", count=len(made)), Phrase("at most are possible", limit=MOST_DESIGNS))
        )
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
    shown = path_of(path)
    try:
        with opened(shown) as stream:
            text = io.TextIOWrapper(stream, encoding="utf-8-sig", newline="")
            lines = list(islice(csv.reader(text), MOST_ROWS + 2))
    except OSError as error:
        raise CallError(
            Problem(str(shown), Phrase("cannot be read", reason=from_others(error.strerror or str(error))))
        ) from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise CallError(Problem(str(shown), Phrase("is no csv file", error=error))) from None
    lines = [line for line in lines if any(cell.strip() for cell in line)]
    if len(lines) < 2:
        raise CallError(
            Problem(
                str(shown), Phrase("holds no designs"), Phrase("the first row names keys links.1.length the others")
            )
        )
    if len(lines) > MOST_ROWS + 1:
        raise CallError(Problem(str(shown), Phrase("holds more than designs", most=MOST_ROWS)))
    keys = tuple(cell.strip() for cell in lines[0])
    problems = [
        Problem(f"{shown}, row 1", Phrase("stands twice of key", key=k)) for i, k in enumerate(keys) if k in keys[:i]
    ]
    rows: list[tuple[Value, ...]] = []
    for number, line in enumerate(lines[1:], start=2):
        if len(line) != len(keys):
            problems.append(
                Problem(
                    Phrase("row", name=shown, number=number),
                    Phrase("has cells the head has", count=len(line), other=len(keys)),
                )
            )
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
