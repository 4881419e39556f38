"""``graphkin sweep``: the motion over the whole turn, of a scene or of many designs: as a study, tables and
diagrams."""

from __future__ import annotations

import html
import os
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from graphkin.api.arguments import (
    CHART_FORMATS,
    At,
    as_scene,
    asked_symbols,
    columns_shown,
    driver_values,
    in_convention,
    known_words,
    known_workers,
    require_callable,
    whole_number,
)
from graphkin.api.results import OfScene, Result
from graphkin.checking.answers import AnswersLike, as_answers
from graphkin.errors import CallError, Problem, as_list, as_text
from graphkin.files import Json, path_of, write_files
from graphkin.jobs import Progress, Workers, cluster
from graphkin.scene.drivers import moves_by_law
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike, written
from graphkin.scene.symbol import Symbol
from graphkin.solver import solve, structure_of
from graphkin.solver.forces import senses_along
from graphkin.study.designs import applied, designs_of
from graphkin.study.sweeps import FollowedDesign, Outcome, Sweep, at_once, collect, designs_table, write_tables
from graphkin.table import Array, Table, have
from graphkin.words import Phrase, listed, say, word

if TYPE_CHECKING:
    import xarray

    from graphkin.drawing import Drawing
    from graphkin.drawing.chart import ChartPage
    from graphkin.study.graphical import Chords, Way
    from graphkin.study.over_time import TimeStudy
    from graphkin.study.turn import TurnStudy

MOST_POSITIONS = 1_000_000_000
MOST_MOMENTS = 100_000
ROWS = 36
IN_MEMORY = 200_000_000
"""Numbers of a table that are kept in memory where no folder is given."""


@dataclass(frozen=True, repr=False, eq=False)
class Swept(OfScene, Result):
    """The motion over a turn of one scene, or of many designs of it.

    ``swept["v_C"]`` is an asked quantity by its name, as an array: complex for vectors, in the scene's length unit,
    degrees for angles; over designs of shape (designs, positions).  ``table`` also has the drivers' values and the
    status of each position.  Table, study and figures are made when they are first asked for.  ``paths`` are the files
    written to a given folder.

    over : the sweep itself
    by_design : the outcome of each design, or of the scene itself
    damaged : damaged pieces of an earlier run, which were made again
    written : the files of its tables
    """

    figure_formats = CHART_FORMATS

    over: Sweep
    by_design: tuple[Outcome, ...]
    language: str
    measured: Mapping[Symbol, Sequence[tuple[float, float]]] = field(default_factory=dict)
    on_paper: tuple[tuple[Way, str], ...] = ()
    damaged: int = 0
    written: tuple[Path, ...] = ()
    paths: list[Path] = field(default_factory=list)

    @property
    def mechanism(self) -> Mechanism:
        return self.over.scene

    @property
    def rows(self) -> int:
        """Positions of all designs."""
        return self.over.rows

    @property
    def good(self) -> int:
        """Positions that are solved."""
        return sum(outcome.good for outcome in self.by_design)

    @property
    def ok(self) -> bool:
        """Whether at least one position is solved."""
        return self.good > 0

    @property
    def outcomes(self) -> Mapping[str, int]:
        """Over designs the number of designs with each status."""
        return Counter(outcome.status for outcome in self.by_design) if self.over.designs.keys else {}

    def __getitem__(self, name: str) -> Array:
        """An asked quantity by its name, or any column of the table: NaN where it is missing.  Raises CallError for an
        unknown one."""
        return self.over[name]

    @property
    def table(self) -> Table:
        """A row for each position: the asked quantities in the scene's units, degrees for angles, and its status."""
        return self.over.table

    @cached_property
    def designs(self) -> Table | None:
        """Over designs a row for each: replaced values, status, strokes, K, least transmission angles."""
        return designs_table(self.over, self.by_design) if self.over.designs.keys else None

    @cached_property
    def turn(self) -> TurnStudy | None:
        """The study of the scene itself (limit positions, K, transmission, classes, extremes); None over designs."""
        from graphkin.study.turn import study_turn

        if self.over.designs.keys or moves_by_law(self.over.scene):
            return None
        base = self.over.base
        return study_turn(base.reach, [q for q in base.asked if q.kind != "place" and not q.is_load])

    @cached_property
    def time(self) -> TimeStudy | None:
        """The study over time of a scene whose drivers move by laws; None for others, and over designs."""
        if self.over.designs.keys or not moves_by_law(self.over.scene):
            return None
        from graphkin.study.over_time import study_time  # it loads the drawing board

        return study_time(self.over.base.structure, self._wished)

    @property
    def _wished(self) -> list[Symbol]:
        """The quantities asked besides the scene's own wishes: only these are drawn."""
        by_scene = [str(s) for s in self.over.scene.question.find]
        wished = [q for q in self.over.base.asked if q.kind != "place"]
        return wished if [str(q) for q in self.over.base.asked] != by_scene else []

    @cached_property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin sweep --json`` prints."""
        from graphkin.study.turn_data import to_json

        titled: dict[str, Json] = {"title": self.over.scene.question.title}
        data = to_json(self.turn) if self.turn is not None else titled
        if self.time is not None:
            data = dict(self.time.data)
        data["positions"] = {"rows": self.rows, "ok": self.good}
        if self.over.designs.keys:
            data["designs"] = {
                "keys": list(self.over.designs.keys), "count": len(self.over.designs), "outcomes": dict(self.outcomes)
            }
        data["files"] = [str(p) for p in self.written]
        return data

    @cached_property
    def figures(self) -> Mapping[str, ChartPage | Drawing]:
        """Motion diagrams of the outputs and coupler curves by name; none over designs."""
        from graphkin.study.diagrams import diagrams

        if self.time is not None:
            return self.time.diagrams(self.language)
        if self.turn is None:
            return {}
        # what is asked alone is drawn alone; without that the outputs and the coupler curves
        asked = self._wished
        offsets = self.turn.reach.offsets
        over = {q: [(float(offsets(np.array(at))), x) for at, x in pairs] for q, pairs in self.measured.items()}
        if over:
            signed = {quantity.whole: quantity for quantity in over}
            asked = list(dict.fromkeys((*(signed.get(q, q) for q in asked), *over)))
        pages = {}
        if asked or not self.chords:
            pages = diagrams(self.turn, self.language, asked=asked, over=over)
        if self.chords:
            from graphkin.study.graphical import chords_page

            pages |= {name: chords_page(chords, self.turn.reach, self.language) for name, chords in self.chords.items()}
        return pages

    @cached_property
    def chords(self) -> Mapping[str, Chords]:
        """The diagrams differentiated or integrated on paper, by the names of their figures."""
        if not self.on_paper:
            return {}
        from graphkin.study.graphical import graphical  # it loads the drawing board

        reach = self.over.base.reach
        return {f"{way}-{name.replace('/', '-')}": graphical(reach, name, way) for way, name in self.on_paper}

    def to_xarray(self) -> xarray.Dataset:
        """The table as a data set of xarray, as of a ``Sweep``.  Raises CallError where it is not installed."""
        return self.over.to_xarray()

    @property
    def tables(self) -> Mapping[str, Table]:
        """table.csv, and table.parquet where pyarrow is installed; over designs designs.csv."""
        designs = {"designs.csv": self.designs} if self.designs is not None else {}
        return {"table.csv": self.table, **designs, **({"table.parquet": self.table} if have("pyarrow") else {})}

    @property
    def files(self) -> Mapping[str, bytes]:
        """The tables of the diagrams differentiated or integrated on paper."""
        if not self.on_paper:
            return {}
        from graphkin.study.graphical import chords_table

        return {f"{name}.csv": chords_table(chords, self.over.base.reach) for name, chords in self.chords.items()}

    def write_figures(
        self, folder: str | os.PathLike[str], formats: Sequence[str] = ("svg",), text: str = "glyphs"
    ) -> list[Path]:
        """Write the files of ``write`` without the tables; returns the paths.  Raises CallError for an unknown format
        or a folder that cannot be written."""
        return write_files(path_of(folder), {**self.pages(formats, text), **self.files})

    @property
    def text(self) -> str:
        """The whole summary as lines of text."""
        from graphkin.api.report_text import turn_text

        lines = [self.mechanism.question.title_in(self.language)]
        if self.turn is not None:
            lines += turn_text(self.turn, self.language)
        if self.time is not None:
            lines += self.time.lines(self.language)
        if self.over.designs.keys:
            outcomes = [f"{n} {word(f'status {status}', self.language)}" for status, n in self.outcomes.items()]
            solved = Phrase("designs solved", designs=len(self.over.designs), outcomes=listed(outcomes))
            lines.append(say(solved, self.language))
        if self.damaged:
            lines.append(say(Phrase("pieces damaged", pieces=self.damaged), self.language))
        lines.append(say(Phrase("positions solved", solved=self.good, positions=self.rows), self.language))
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"<Swept {self.mechanism.name}: {self.good} of {self.rows} positions>"

    def _repr_html_(self) -> str:
        shown = f"<pre>{html.escape(self.text)}</pre>"
        if self.turn is None and self.time is None:
            return shown
        return shown + "".join(f._repr_svg_() for f in list(self.figures.values())[:2])


def sweep(
    scene: SceneLike,
    *,
    at: At = None,
    find: Iterable[str | Symbol] | None = None,
    positions: int | None = None,
    designs: Mapping[str, str | float | Sequence[float | str]] | None = None,
    designs_file: str | os.PathLike[str] | None = None,
    measured: AnswersLike | None = None,
    differentiate: Iterable[str] = (),
    integrate: Iterable[str] = (),
    out: str | os.PathLike[str] | None = None,
    formats: Sequence[str] = ("svg",),
    text: str = "glyphs",
    language: str | None = None,
    convention: str | None = None,
    executor: Executor | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress | None = None,
) -> Swept:
    """Follow a scene over the whole turn of its driver, alone or as many designs.

    Velocities, accelerations and rates that ``find`` names come at the speed of the prepared engine (see
    `graphkin.solver.prepare`): a million positions in some milliseconds.  The other results are made when they are
    asked for.

    Parameters
    ----------
    scene, at : as for `solve`
    find : quantities of the table, the symbols of `check` and "C" (place of a point), "theta_3" (angle of a link),
        "s_3/4" (travel of a sliding pair); the scene's own if None, or else all motions
    out : folder for table.csv (and table.parquet where pyarrow is installed), designs.csv and the figures; an
        interrupted sweep into the same folder is continued
    positions : rows of the table, over a turn from the scene's own value on, or over the range of a driven slide; of a
        scene with named positions from position 1 on, by default their count; else 36
    designs : numbers to replace, by keys of the scene file with dots: {"links.1.length": "40:60:21"} is a grid of 21,
        "40,50,60" or a sequence a list; several keys give every combination
    designs_file : a CSV file whose heads are such keys
    executor : any ``concurrent.futures.Executor``; the result is the same, byte for byte
    workers : number of processes instead, for a sweep that takes some seconds; scheduler: address of a Dask cluster
        instead
    progress : called with the rows done and all rows
    language, convention : as for `draw`
    text : letters of an SVG as text with its "glyphs", or as "outlines"
    measured : a CSV file with a row for each position (a column ``at``: driver value or name of a position) and symbols
        as heads: values measured elsewhere, drawn into the diagrams of these quantities

    differentiate, integrate : angles, travels, coordinates or rates of them ("s_6/1", "theta_4", "omega_4", "x_C",
        "v_C.x") whose diagrams are differentiated or integrated on paper, with chords and a pole, measured and compared
        with the solver

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
    >>> swept = sweep("shaper-scheme-2", positions=100_000, find=["v_C"])
    >>> f"{abs(swept['v_C']).max():.0f} mm/s at most"
    '1346 mm/s at most'
    """
    known_words(formats, language, text=text, known_formats=CHART_FORMATS)
    require_callable("progress", progress)
    positions = None if positions is None else whole_number("positions", positions, 1, MOST_POSITIONS)
    if executor is not None and scheduler is not None:
        raise CallError.of("executor", "is given beside a scheduler", "give one of them")
    workers = known_workers(executor, workers)
    wishes = {
        name: [as_text(name, quantity) for quantity in as_list(name, names, Phrase("give names s_6 1"))]
        for name, names in (("differentiate", differentiate), ("integrate", integrate))
    }
    made = designs_of(designs, designs_file)
    source, name = written(scene) if made.keys else (as_scene(scene), "")
    given = in_convention(as_scene(source), convention)
    if isinstance(source, Mapping) and len(made):
        applied(source, made.keys, made[0])  # keys that the scene does not have
    if not given.drivers:
        structure_of(given)  # a sentence: what drives is missing
    if moves_by_law(given):
        positions = positions if positions is None else whole_number("positions", positions, 1, MOST_MOMENTS)
        along = {"at": at, "measured": measured, **{name: names or None for name, names in wishes.items()}}
        if wrong := [name for name, wish in along.items() if wish is not None]:  # they count along the driver
            refusal = Phrase("does not go with a driver that moves")
            wanted = Phrase("leave it out or give omega instead of")
            raise CallError(*(Problem(name, refusal, wanted) for name in wrong))
    start = driver_values(given, at) or {}
    if positions is None:
        positions = (given.question.positions.count if given.question.positions else 0) or ROWS
    ways: dict[Way, list[str]] = {"derivative": wishes["differentiate"], "integral": wishes["integrate"]}
    on_paper = tuple((way, name) for way, names in ways.items() for name in names)
    if on_paper:
        from graphkin.study.graphical import known_ordinate  # it loads the drawing board

        for way, name in on_paper:
            known_ordinate(given, name, way)
        if made.keys:
            raise CallError.of("differentiate, integrate", "do not go with designs", "give one design")
    if measured is not None and made.keys:
        raise CallError.of("measured", "do not go with designs", "give one design")
    elsewhere = {} if measured is None else _elsewhere(given, measured)
    if find is None and elsewhere:
        find = [*elsewhere]
    base = FollowedDesign(given, _asked(given, find), tuple(sorted(start.items())), bool(made.keys))
    over = Sweep(base, name or given.name, positions, made, source if isinstance(source, Mapping) else None)
    spoken = language or given.question.sheet.language
    if out is None:
        if over.numbers > IN_MEMORY:
            raise CallError.of("sweep", "rows", "give a folder out or o", number=over.rows)
        quickly = at_once(over)
        if quickly is not None:
            return Swept(*quickly, spoken, elsewhere, on_paper)
    if not made.keys and over.base.engine is None and not moves_by_law(given):
        _ = over.base.reach  # a start that cannot be assembled
    through = cluster(as_text("scheduler", scheduler)) if scheduler is not None else executor
    try:
        with Workers(through, workers if over.long else None) as working:
            if out is None:
                content, outcomes = collect(over, working, progress)
                return Swept(replace(over, content=content), outcomes, spoken, elsewhere, on_paper)
            files, outcomes, damaged = write_tables(over, path_of(out), working, have("pyarrow"), progress)
    finally:
        if scheduler is not None and through is not None:
            through.shutdown()
    swept = Swept(replace(over, content=files[0]), outcomes, spoken, elsewhere, on_paper, damaged, files, [*files])
    if not made.keys:
        swept.paths.extend(swept.write_figures(out, formats, text))
    return swept


def _elsewhere(scene: Mechanism, measured: AnswersLike) -> dict[Symbol, list[tuple[float, float]]]:
    """Values measured elsewhere, each with the first driver's value (rad, m): SI, of a vector its size, or, where the
    column has signs, its place along the guide on which it lies."""
    rows, _ = as_answers(scene, measured)
    if any(row.at is None for row in rows):
        raise CallError.of("measured", "has no column at", "write the driver's value of each row under")
    places = [(driver_values(scene, row.at) or {})[scene.drivers[0].key] for row in rows]
    answers = [answer for row in rows for answer in row.values]
    signed = {answer.symbol for answer in answers if answer.shows_sign}
    signed -= {answer.symbol for answer in answers if isinstance(answer.value, complex)}
    along = {s for s in signed if s.is_vector and senses_along(solve(scene), s) is not None}
    elsewhere: dict[Symbol, list[tuple[float, float]]] = {}
    for row, place in zip(rows, places, strict=True):
        for answer in (answer for answer in row.values if answer.symbol.scope != "turn" and not answer.symbol.at):
            quantity = replace(answer.symbol, along=True) if answer.symbol in along else answer.symbol
            value = abs(answer.value) if quantity.is_vector else float(answer.value.real)
            elsewhere.setdefault(quantity, []).append((place, value))
    return elsewhere


def _asked(scene: Mechanism, find: Iterable[str | Symbol] | None) -> tuple[Symbol, ...]:
    """The asked quantities in their order.  Raises CallError with every name of none."""
    if find is None:
        by_scene = scene.question.find
        shown = (s for s in by_scene if s.scope not in ("turn", "cycle") and s.kind not in ("h", "arm") and not s.at)
        return asked_symbols(scene, tuple(shown), drawn=False)
    asked: list[Symbol] = []
    problems: list[Problem] = []
    for name in [find] if isinstance(find, Symbol) else as_list("find", find, Phrase("give symbols v_b omega_3")):
        try:
            (quantity,) = columns_shown(scene, [name])
        except CallError as error:
            problems += error.problems
            continue
        if quantity.scope in ("turn", "cycle"):
            problems.append(Problem(f"find {name}", "is of the whole turn no column", "it stands in the summary"))
        asked.append(quantity)
    if problems:
        raise CallError(*problems)
    return tuple(asked)
