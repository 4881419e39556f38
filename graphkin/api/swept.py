"""``graphkin sweep``: the motion of the whole turn, as a study, tables and diagrams; and the same over designs."""

from __future__ import annotations

import html
import os
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from graphkin.api.arguments import At, SceneLike, as_scene, asked_symbols, driver_values, known_words
from graphkin.api.files import write_files
from graphkin.errors import CallError, Problem
from graphkin.scene import library, library_text
from graphkin.scene.model import Scene
from graphkin.scene.symbol import Symbol

if TYPE_CHECKING:
    from graphkin.drawing import Drawing
    from graphkin.study import Plan, Progress, Turn
    from graphkin.study import Swept as Tables

__all__ = ["Swept", "sweep"]

MOST_POSITIONS = 1_000_000_000
IN_MEMORY = 2_000_000
"""Rows of a table that are kept in memory where no folder is given."""


@dataclass(frozen=True, repr=False)
class Swept:
    """The motion over a turn of one scene, or of many designs of it.

    turn : the study of the scene itself (limit positions, K, transmission, classes, extremes; SI); None over designs
    tables : the text of "table.csv" and "designs.csv", or where they were written if a folder was given
    outcomes : over designs how many came out with each status
    """

    plan: Plan
    turn: Turn | None
    tables: Mapping[str, str | Path]
    rows: int
    good: int
    outcomes: Mapping[str, int]
    language: str

    @property
    def ok(self) -> bool:
        """Whether one position at least is solved."""
        return self.good > 0

    @cached_property
    def data(self) -> dict[str, Any]:
        """The object that ``graphkin sweep --json`` prints."""
        from graphkin.study import to_json

        data: dict[str, Any] = to_json(self.turn) if self.turn is not None else {"title": self.plan.scene.title}
        data["positions"] = {"rows": self.rows, "ok": self.good}
        if self.plan.designs.keys:
            data["designs"] = {
                "keys": list(self.plan.designs.keys), "count": len(self.plan.designs), "outcomes": dict(self.outcomes)
            }
        data["files"] = [str(p) for p in self.tables.values() if isinstance(p, Path)]
        return data

    @cached_property
    def figures(self) -> Mapping[str, Drawing]:
        """Motion diagrams of the outputs and coupler curves by name; none over designs."""
        from graphkin.study import diagrams

        return {} if self.turn is None else diagrams(self.turn, self.language)

    @property
    def table(self) -> str:
        """The table as the text of a CSV file."""
        held = self.tables["table.csv"]
        return held.read_text(encoding="utf-8") if isinstance(held, Path) else held

    def write_figures(self, folder: str | os.PathLike[str], formats: Sequence[str] = ("svg",)) -> list[Path]:
        """Write the figures; returns the paths.  Raises CallError for an unknown format or a folder that cannot be
        written."""
        from graphkin.drawing.save import drawing_bytes

        known_words(formats)
        files = {f"{n}.{kind}": drawing_bytes(f, kind) for n, f in self.figures.items() for kind in formats}
        return write_files(Path(folder), files)

    def __repr__(self) -> str:
        return f"<Swept {self.plan.scene.name}: {self.good} of {self.rows} positions>"

    def _repr_html_(self) -> str:
        from graphkin.api.report_text import told_turn

        lines = told_turn(self)
        shown = f"<pre>{html.escape(lines)}</pre>"
        if self.turn is None:
            return shown
        from graphkin.drawing import svg_bytes

        return shown + "".join(svg_bytes(f).decode() for f in list(self.figures.values())[:2])


def sweep(
    scene: SceneLike,
    out: str | os.PathLike[str] | None = None,
    positions: int = 36,
    find: Iterable[str | Symbol] | None = None,
    at: At = None,
    designs: Mapping[str, str | float | Sequence[float | str]] | None = None,
    designs_file: str | os.PathLike[str] | None = None,
    executor: Executor | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    formats: Sequence[str] = ("svg",),
    language: str | None = None,
    progress: Progress | None = None,
) -> Swept:
    """Follow a scene over the whole turn of its driver, alone or as many designs.

    Parameters
    ----------
    scene, at, find : as for `check`; over designs a file, a name or a mapping
    out : folder for table.csv (and table.parquet where pyarrow is installed), designs.csv and the figures; an
        interrupted sweep into the same folder goes on where it stopped
    positions : rows of the table, over a turn from the scene's own value on, or over the range of a driven slide
    designs : numbers to replace, by keys of the scene file with dots: {"links.1.length": "40:60:21"} is a grid of 21,
        "40,50,60" or a sequence a list; several keys give every combination
    designs_file : a CSV file whose head names such keys
    executor : any ``concurrent.futures.Executor``; the result is the same, byte for byte
    workers : number of processes instead; scheduler: address of a Dask cluster instead
    progress : called with the rows done and all rows

    Raises
    ------
    SceneError, CallError : the scene or the call is wrong
    Unsolvable : wrong mobility; without designs also where the scene's own position cannot be assembled

    Examples
    --------
    >>> swept = sweep("slider-crank-s50-e16-K1.2", positions=12)
    >>> slider = swept.data["outputs"][0]
    >>> f"stroke {slider['stroke']:.10f}, K {slider['K']:.10f}"
    'stroke 50.0000000000, K 1.2000000000'
    """
    from graphkin.study import Plan, course_of, designs_of, have_parquet, run, study_turn
    from graphkin.study import scheduler as cluster

    known_words(formats, language)
    _checked_call(positions, workers, executor, scheduler)
    made = designs_of(designs, designs_file)
    source = _mapping(scene) if made.keys else as_scene(scene)
    given = as_scene(source)
    if made.keys and isinstance(scene, str | os.PathLike):
        name = given.name if isinstance(scene, Mapping) else Path(scene).stem
    else:
        name = given.name
    if made.keys and isinstance(source, Mapping) and len(made):
        from graphkin.study.designs import applied

        applied(source, made.keys, made[0])  # keys that the scene does not have
    asked = asked_symbols(given, find)
    start = driver_values(given, at) or {}
    plan = Plan(source, name, made, positions, asked, tuple(sorted(start.items())))
    turn = None if made.keys else study_turn(course_of(given, start), asked)
    spoken = language or given.sheet.language
    through = cluster(scheduler) if scheduler else executor
    try:
        if out is None:
            if plan.rows > IN_MEMORY:
                raise CallError(Problem("sweep", f"{plan.rows} rows", "give a folder, out=... or -o"))
            with TemporaryDirectory() as folder:
                done = run(plan, Path(folder), through, workers, progress=progress)
                tables: dict[str, str | Path] = {
                    t: (Path(folder) / t).read_text(encoding="utf-8") for t in done.tables
                }
            return _swept(plan, turn, tables, done, spoken)
        done = run(plan, Path(out), through, workers, have_parquet(), progress)
    finally:
        if scheduler and through is not None:
            through.shutdown()
    swept = _swept(plan, turn, {t: Path(out) / t for t in done.tables}, done, spoken)
    if turn is not None:
        swept.write_figures(out, formats)
    return swept


def _swept(plan: Plan, turn: Turn | None, tables: Mapping[str, str | Path], done: Tables, language: str) -> Swept:
    return Swept(plan, turn, tables, done.rows, done.good, done.outcomes, language)


def _checked_call(
    positions: int, workers: int | None, executor: Executor | None, scheduler: str | None
) -> None:
    problems = []
    if not 1 <= positions <= MOST_POSITIONS:
        problems.append(Problem("positions", f"{positions}", f"give a number from 1 to {MOST_POSITIONS}"))
    if workers is not None and not 1 <= workers <= 1024:
        problems.append(Problem("workers", f"{workers}", "give a number from 1 to 1024"))
    if sum(x is not None for x in (executor, scheduler)) > 1:
        problems.append(Problem("executor", "is given beside a scheduler", "give one of them"))
    if problems:
        raise CallError(*problems)


def _mapping(scene: SceneLike) -> Mapping[str, Any]:
    """The tables and keys of a scene's file."""
    if isinstance(scene, Mapping):
        return scene
    if isinstance(scene, Scene):
        raise CallError(Problem("designs", "of a scene that is read already", "give its file, its name or a mapping"))
    as_scene(scene)  # every problem of the file
    text = library_text(str(scene)) if str(scene) in library() and not Path(scene).is_file() else None
    return tomllib.loads(text if text is not None else Path(scene).read_text(encoding="utf-8-sig"))
