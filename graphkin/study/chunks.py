"""A sweep cut into chunks of work: each is computed alone, anywhere, and gives the same bytes wherever it is.

The cutting depends on nothing but the sweep itself, so that the result is the same whatever runs it.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from graphkin.errors import GraphkinError, Unsolvable
from graphkin.scene import read
from graphkin.scene.model import Scene
from graphkin.scene.symbol import Symbol
from graphkin.solver import solve_structure, structure_of
from graphkin.study.course import Course, course_of
from graphkin.study.designs import Designs, Value, applied
from graphkin.study.summary import row
from graphkin.study.table import Column, columns_of, csv_cell, csv_lines, driver_columns, table_numbers
from graphkin.study.turn import study_turn
from graphkin.version import __version__

__all__ = ["Done", "Plan", "Task", "work"]

Outcome = tuple[int, str, str, dict[str, float | str | None], int]

BLOCK = 16384
"""Positions in a chunk, about."""
FORMAT = 1


@dataclass(frozen=True)
class Plan:
    """A whole sweep.

    source : the scene, or the mapping of its file where designs replace numbers in it
    at : driver values to start from (SI), by driver key
    """

    source: Scene | Mapping[str, Any]
    name: str
    designs: Designs
    positions: int
    asked: tuple[Symbol, ...] = ()
    at: tuple[tuple[str, float], ...] = ()

    @property
    def rows(self) -> int:
        """Rows of the table."""
        return len(self.designs) * self.positions

    @cached_property
    def key(self) -> str:
        """A key that two sweeps share only if they give the same results."""
        source = repr(self.source) if isinstance(self.source, Scene) else json.dumps(self.source, default=str)
        asked = [str(s) for s in self.asked]
        parts = (__version__, FORMAT, BLOCK, source, self.name, self.designs, self.positions, asked, self.at)
        return hashlib.sha256(repr(parts).encode()).hexdigest()[:24]

    @property
    def scene(self) -> Scene:
        """The scene itself, with nothing replaced."""
        return self.source if isinstance(self.source, Scene) else read(self.source)

    @cached_property
    def chunks(self) -> int:
        """How many chunks the sweep has."""
        if self.positions > BLOCK:
            return len(self.designs) * -(-self.positions // BLOCK)
        return -(-len(self.designs) // max(1, BLOCK // self.positions))

    @cached_property
    def columns(self) -> tuple[Column, ...]:
        """The columns of numbers of the table, without the drivers'.  Raises Unsolvable for a wrong mobility."""
        scene = self.scene
        return columns_of(scene, solve_structure(structure_of(scene)), self.asked)

    @cached_property
    def heads(self) -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
        """Heads of the table: before the numbers, the numbers, after them."""
        before = ("design", *self.designs.keys, "position") if self.designs.keys else ("position",)
        return before, (*driver_columns(self.scene), *(c.name for c in self.columns)), ("status", "why")

    def task(self, chunk: int, binary: bool = False) -> Task:
        """One chunk, with all that is needed to compute it."""
        if self.positions > BLOCK:
            design, block = divmod(chunk, -(-self.positions // BLOCK))
            some, first = range(design, design + 1), block * BLOCK
            last = min(first + BLOCK, self.positions)
        else:
            each = max(1, BLOCK // self.positions)
            some = range(chunk * each, min((chunk + 1) * each, len(self.designs)))
            first, last = 0, self.positions
        designs = tuple((k, self.designs[k]) for k in some)
        keys = self.designs.keys
        return Task(self.key, self.source, keys, designs, self.positions, first, last, self.columns, self.at, binary)



@dataclass(frozen=True)
class Task:
    """Some designs of a sweep, or some positions of one."""

    key: str
    source: Scene | Mapping[str, Any]
    keys: tuple[str, ...]
    designs: tuple[tuple[int, tuple[Value, ...]], ...]
    positions: int
    first: int
    last: int
    columns: tuple[Column, ...]
    at: tuple[tuple[str, float], ...]
    binary: bool


@dataclass(frozen=True)
class Done:
    """What a chunk gives.

    text : its lines of the table
    numbers : float64 bytes of the table's numbers, for binary tables
    designs : for each design the chunk holds positions of: its number from 0, the status and the reason of the first
        position that has none, its cells in the table of designs (where its first position is in the chunk), and
        its positions that are ok
    good : positions that are ok
    """

    text: bytes
    numbers: bytes
    designs: tuple[Outcome, ...]
    good: int


def work(task: Task) -> Done:
    """Compute one chunk.  What goes wrong with a design is said in its rows; nothing is raised for it."""
    parts = [_design(task, design, values) for design, values in task.designs]
    return Done(
        b"".join(p.text for p in parts),
        b"".join(p.numbers for p in parts),
        tuple(d for p in parts for d in p.designs),
        sum(p.good for p in parts),
    )


_COURSES: dict[tuple[str, int], Course | tuple[str, str]] = {}
"""The course of the design that was computed last: the chunks of a long one share it."""


def _course(task: Task, design: int, values: tuple[Value, ...]) -> Course | tuple[str, str]:
    """The course of a design, or the status and the reason why it has none."""
    found = _COURSES.get((task.key, design))
    if found is None:
        found = _new_course(task, values)
        _COURSES.clear()
        _COURSES[task.key, design] = found
    return found


def _new_course(task: Task, values: tuple[Value, ...]) -> Course | tuple[str, str]:
    try:
        scene = task.source
        if not isinstance(scene, Scene):
            scene = read(applied(scene, task.keys, values))
        return course_of(scene, dict(task.at))
    except Unsolvable as error:
        return error.status, error.why
    except GraphkinError as error:
        return "wrong scene", " ".join(str(p) for p in error.problems)


def _design(task: Task, design: int, values: tuple[Value, ...]) -> Done:
    course = _course(task, design, values)
    lead = [str(design + 1), *(csv_cell(v) for v in values)] if task.keys else []
    n = task.last - task.first
    cells: dict[str, float | str | None] = {}
    if isinstance(course, tuple):
        status, why = course
        drivers = 1 if isinstance(task.source, Scene) else len(_driver_tables(task.source))
        numbers = np.full((n, drivers + len(task.columns)), np.nan)
        tail = [f"{csv_cell(status)},{csv_cell(why)}"] * n
        good = 0
    else:
        motion = course.motion(course.table_offsets(task.positions, task.first, task.last))
        numbers = table_numbers(course, task.columns, motion)
        tail = [f"{s},{csv_cell(w)}" if w else f"{s}," for s, w in zip(motion.status.tolist(), motion.why, strict=True)]
        good = int(motion.ok.sum())
        bad = next((k for k in range(n) if motion.why[k]), None)
        status, why = ("ok", "") if bad is None else (str(motion.status[bad]), motion.why[bad])
        if task.keys and task.first == 0:
            cells = row(study_turn(course, everything=False))
    head = [(*lead, str(k + 1)) for k in range(task.first, task.last)]
    text = csv_lines(head, numbers, tail).encode()
    binary = np.ascontiguousarray(numbers).tobytes() if task.binary else b""
    return Done(text, binary, ((design, status, why, cells, good),) if task.keys else (), good)


def _driver_tables(source: Mapping[str, Any]) -> list[Any]:
    given = source.get("driver", [])
    return given if isinstance(given, list) else [given]
