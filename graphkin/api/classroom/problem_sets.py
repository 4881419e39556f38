"""Sets of problems: a variant for each student, drawn from a seed or given by the rows of a table."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import nullcontext
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from graphkin.api.arguments import (
    MOST_SEED,
    ON_SHEETS,
    as_scene,
    asked_symbols,
    known_words,
    known_workers,
    require_callable,
    whole_number,
)
from graphkin.api.results import OfScene, Result, named
from graphkin.errors import CallError, GraphkinError, Problem, Unsolvable, printable, some_of
from graphkin.files import Json, OwnTables, Tables, folder_alone, path_of, write_files
from graphkin.jobs import Progress, Workers
from graphkin.papers.data_rows import columns_of, replaced
from graphkin.papers.documents import answers_template
from graphkin.papers.exports import BANKED, bank
from graphkin.papers.fresh_numbers import Spread, rules_checked, varied_keys
from graphkin.papers.pdf import one_after_another
from graphkin.papers.variants import (
    Answer,
    Job,
    Render,
    Variant,
    accepted,
    asked_of,
    make,
)
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike, as_mapping, safe_name, toml_text, written
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import KeyPath, value_at
from graphkin.solver import driver_range, structure_of
from graphkin.study.designs import applied
from graphkin.table import Rows, Table, table_of, with_points
from graphkin.words import Phrase, clauses, languages, say

MOST = 100_000
MOST_OF_A_TURN = 355.0  # degrees: a driver that goes farther is free to stand anywhere


@dataclass(frozen=True, repr=False, eq=False)
class ProblemSet(OfScene, Result):
    """A set of problems: its variants, the table of all answers, its remarks in a language, and the written files."""

    mechanism: Mechanism
    variants: tuple[Variant, ...]
    unused: tuple[str, ...] = ()
    folder: Path | None = None
    language: str = "en"

    @property
    def answers(self) -> dict[str, tuple[Answer, ...]]:
        """The answers of the variants made, by their names, in order."""
        return {variant.name: variant.answers for variant in self.variants if not variant.why}

    @property
    def failures(self) -> tuple[Variant, ...]:
        """The variants that could not be made, each with its reason."""
        return tuple(variant for variant in self.variants if variant.why)

    @property
    def ok(self) -> bool:
        """Whether every variant was made."""
        return not self.failures

    @property
    def data(self) -> dict[str, Json]:
        """All answers, remarks and failures, for programs."""
        variants: list[dict[str, Json]] = [
            {
                "name": variant.name,
                "answers": [{"symbol": a.symbol, "value": a.value, "tolerance": a.tolerance} for a in variant.answers],
                **({"remarks": [*map(str, variant.remarks)]} if variant.remarks else {}),
            }
            for variant in self.variants if not variant.why
        ]
        failures = [{"name": f.name, "why": str(f.why)} for f in self.failures]
        return {"ok": self.ok, "variants": variants, "failures": failures, "unused": list(self.unused)}

    @cached_property
    def table(self) -> Table:
        """A row for each variant: its name, and each answer with its tolerance; failures at the end."""
        units = {a.symbol: a.unit for answers in self.answers.values() for a in answers}
        symbols = list(units) or [str(s) for s in asked_of(self.mechanism)]
        rows: list[tuple[object, ...]] = []
        for variant in sorted(self.variants, key=lambda variant: bool(variant.why)):
            known = {a.symbol: (a.value, a.tolerance) for a in variant.answers if not variant.why}
            said = Phrase("variant failed", why=variant.why) if variant.why else clauses(variant.remarks or [""])
            remark = printable(say(said, self.language))
            rows.append((variant.name, *(x for s in symbols for x in known.get(s, (None, None))), remark))
        heads = ("name", *(c for s in symbols for c in (s, f"{s} +-")), "remarks")
        beside = ("", *(units.get(s, "") for s in symbols for _ in range(2)), "")
        return Table.of(heads, rows, ("", *[".6g"] * (2 * len(symbols)), ""), beside)

    def __getitem__(self, name: str) -> tuple[Answer, ...]:
        """The answers of a variant by its name.  Raises CallError for a variant that was not made."""
        return tuple(named(self.answers, name, Phrase("no variant of this name")))

    @property
    def files(self) -> Mapping[str, bytes]:
        """answers.csv, as a spreadsheet opens it."""
        return {"answers.csv": self.table.csv().encode("utf-8-sig")}

    def __repr__(self) -> str:
        return f"<ProblemSet {self.mechanism.name}>"


def problem_set(
    scene: SceneLike,
    *,
    find: Iterable[str | Symbol] | None = None,
    variants: int | None = None,
    rows: str | os.PathLike[str] | None = None,
    spread: Spread | None = None,
    render: Render | None = None,
    out: str | os.PathLike[str] | None = None,
    language: str | None = None,
    seed: int = 0,
    executor: Executor | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> ProblemSet:
    """Make a set of problems from one scene: the same mechanism with other numbers for each student.

    Parameters
    ----------
    scene : as for `solve`
    variants, seed : their number, newly drawn; each assembles, has round numbers, crosses no lines under 20 degrees,
        shows every asked reading over 10 mm long, and differs in its answers from all others by more than the tolerance
    rows : instead, a CSV file with a row of data for each group or student (see `graphkin.papers.data_rows`)
    out : folder for a scene file of each variant, the rendered files and answers.csv; an interrupted set is continued
    spread : the relative variation of the numbers
    executor, workers : an executor like ``concurrent.futures.Executor``; or a number of own processes
    render : function that gives files by name for a variant, called where the variants are made (so it must be
        picklable)
    progress : called with the number of finished variants and of all
    find : the asked quantities; the scene's own if None, or else the motion of the last joint and the rates of links
        about fixed pivots
    language : of the remarks and of the table for a class to fill in; the scene's own if None

    Returns
    -------
    ProblemSet; a variant that cannot be made is among its failures, with the reason

    Raises
    ------
    SceneError, CallError : the scene, the table or the call is wrong
    """
    if (variants is None) == (rows is None):
        raise CallError.of("variants", "neither or both of variants and rows", "give one of them")
    known_words(language=language, known_languages=ON_SHEETS)
    require_callable("render", render)
    require_callable("progress", progress)
    workers = known_workers(executor, workers)
    if spread is not None and not isinstance(spread, Spread):
        raise CallError.of("spread", "found value", "give a spread", value=f'{spread!r:.60}')
    source, name = _source(scene, find)
    given = as_scene(source)
    jobs, unused = _jobs(source, variants, seed, rows, spread or Spread())
    folder = path_of(out) if out is not None else None
    speaking = languages(language or given.question.sheet.language)[0]
    left: list[Path] = []
    if folder is not None:
        write_files(folder, {})
        # what a killed process has left half-written
        pattern = re.compile(rf"\.{re.escape(name)}-.*\.[a-z0-9_]{{8}}")
        left = [path for path in folder.glob(".*") if pattern.fullmatch(path.name)]

    def keep(variant: Variant, files: Mapping[str, bytes]) -> list[str]:
        if folder is None:
            return []
        stem = f"{name}-{variant.name}"
        scene_file = {f"{stem}.toml": toml_text(variant.source).encode()}
        # what a platform reads as a folder has the variant in its name
        renamed = {n if "/" in n else f"{stem}-{safe_name(n)}": f for n, f in files.items()}
        return [str(path.relative_to(folder)) for path in write_files(folder, {**scene_file, **renamed})]

    def finish(variants: Sequence[Variant]) -> None:
        if folder is not None:
            made = ProblemSet(given, tuple(variants), unused, folder, speaking)
            made.write(folder)
            if made.answers:
                asked = dict.fromkeys(Symbol.parse(a.symbol) for answers in made.answers.values() for a in answers)
                lines = [("", "", name) for name in made.answers]
                blank = answers_template(tuple(asked), given.units, speaking, lines, "variant")
                write_files(folder, {"answers_template.csv": blank.csv().encode("utf-8-sig")})
            for paper in ("problem", "key"):
                papers = [folder / f"{name}-{variant}-{paper}.pdf" for variant in made.answers]
                if papers and all(path.is_file() for path in papers):
                    whole = one_after_another([path.read_bytes() for path in papers])
                    write_files(folder / f"{paper}s", {f"all-{paper}s.pdf": whole})
            single = [{file: folder / f"{name}-{variant}-{file}" for file in BANKED} for variant in made.answers]
            here = [{file: path.read_bytes() for file, path in files.items() if path.is_file()} for files in single]
            write_files(folder, bank(name, here))
            for path in left:
                path.unlink(missing_ok=True)

    with folder_alone(folder) if folder is not None else nullcontext(), Workers(executor, workers) as working:
        made = make(jobs, working, folder, keep, render, progress, finish)
    return ProblemSet(given, made, unused, folder, speaking)


def _source(scene: SceneLike, find: Iterable[str | Symbol] | None = None) -> tuple[OwnTables, str]:
    """The mapping of a scene file, as it was written if possible, with what is asked, and the scene's name."""
    read = as_scene(scene)
    if isinstance(scene, Mechanism) or read.drawn:
        # drawn points tie every number to the position: lengths stand on their own
        source, name = as_mapping(read), read.name
    else:
        tables, name = written(scene)
        source, name = dict(tables), safe_name(name)
    if find is not None:
        source["find"] = [str(s) for s in asked_symbols(as_scene(source), find)]
    return source, name


def _jobs(
    source: Tables, variants: int | None, seed: int, rows: str | os.PathLike[str] | None, spread: Spread
) -> tuple[Sequence[Job], tuple[str, ...]]:
    if rows is None:
        count = whole_number("variants", variants, 1, MOST)
        rules_checked(source)
        asked_symbols(as_scene(source), (source.get("vary") or {}).get("find", ()))
        if not varied_keys(source):
            raise CallError.of("variants", "nothing in the scene can vary", "give lengths and a driver")
        spread = spread if spread.reach else replace(spread, reach=_reach(as_scene(source)))
        seed = whole_number("seed", seed, -MOST_SEED, MOST_SEED)
        digits = max(2, len(str(count)))
        jobs = [Job(f"{number:0{digits}d}", number, source, spread, seed) for number in range(1, count + 1)]
        return jobs, ()
    table, data, others = _data_of(source, rows)
    return list(_jobs_of_rows(source, data, others, table.rows)), tuple(table.heads[i] for i in others[1:])


def _reach(scene: Mechanism) -> tuple[float, float] | None:
    """The least and greatest angle (degrees) of a first driver that cannot turn fully; None for another."""
    structure = structure_of(scene)
    if not structure.scene.drivers[0].turns:
        return None
    reach = driver_range(structure)
    low, high = sorted(np.degrees(reach.value(np.array(reach.ends))).tolist())
    return None if reach.full or high - low > MOST_OF_A_TURN else (low, high)


def _data_of(source: Tables, rows: str | os.PathLike[str]) -> tuple[Rows, dict[int, str], list[int]]:
    """A table of data, its data columns and the others (`columns_of`).  Raises CallError if none is a datum."""
    table = with_points(table_of(rows), rows)
    data, others = columns_of(source, table.heads)
    if not data:
        raise CallError.of(str(rows), "no column is a datum of the scene",
                           "write heads like links.1.length o4b n2 or phi1", names=some_of(table.heads))
    return table, data, others


def schemes_of(
    scene: SceneLike, rows: str | os.PathLike[str]
) -> tuple[dict[str, Mechanism], tuple[tuple[str, ...], ...]]:
    """The mechanisms of a table of data by their names, and the table as it was written, the names first.

    Raises
    ------
    CallError : no column is a datum of the scene; every row that gives no scene
    """
    source, _ = _source(scene)
    table, data, others = _data_of(source, rows)
    made: dict[str, Mechanism] = {}
    problems: list[Problem] = []
    for (line, _), job in zip(table.rows, _jobs_of_rows(source, data, others, table.rows), strict=True):
        if job.trouble:
            problems.append(Problem(Phrase("line of students and line", students=rows, line=line), job.trouble))
        else:
            made[job.name] = as_scene(job.source)
    if problems:
        raise CallError(*problems)
    order = [i for i in range(len(table.heads)) if i not in others[:1]]
    lines = [tuple(cells[i] if i < len(cells) else "" for i in order) for _, cells in table.rows]
    heads = ("", *(table.heads[i] for i in order))
    return made, (heads, *((name, *line) for name, line in zip(made, lines, strict=True)))


def drawn_schemes(
    scene: SceneLike, variants: int, seed: int = 0, find: Iterable[str | Symbol] | None = None
) -> tuple[dict[str, Mechanism], tuple[tuple[str, ...], ...]]:
    """Mechanisms with other numbers, drawn as for a problem set, by name, and the table of their data, the names first.

    Raises
    ------
    SceneError, CallError : the scene or the call is wrong
    Unsolvable : a variant that makes no good problem with any numbers
    """
    source, _ = _source(scene, find)
    jobs, _ = _jobs(source, variants, seed, None, Spread())
    made: dict[str, Mechanism] = {}
    lines: list[tuple[str, ...]] = []
    keys = [path for path, _ in varied_keys(source)]
    with Workers(None, 1) as working:
        for job, variant in accepted(jobs, {}, working):
            if variant.why:
                raise Unsolvable("not drawn", Problem(Phrase("variant of name", name=job.name), variant.why))
            made[job.name] = variant.scene
            lines.append((job.name, *(f"{float(value_at(variant.source, path)):.6g}" for path in keys)))
    return made, (("", *(_head_of(source, path) for path in keys)), *lines)


def _head_of(source: Tables, path: KeyPath) -> str:
    """The head of a datum in a table: the letters of a bar, the place of a point, or its key."""
    if path[0] in ("gears", "cams") or "discs" in path:
        return ".".join(str(part + 1) if isinstance(part, int) else part for part in path[1:] if part != "discs")
    if path[0] == "links":
        points = source["links"][path[1]].get("points", ())
        return "".join(points) if len(points) == 2 else f"{path[1]}"
    if path[0] == "frame":
        return f"{path[2]}.{'xy'[int(path[-1])]}" if isinstance(path[-1], int) else f"{path[2]}.{path[-1]}"
    return str(path[-1])


def _jobs_of_rows(
    source: Tables, data: Mapping[int, str], others: Sequence[int], lines: Sequence[tuple[int, tuple[str, ...]]]
) -> Iterator[Job]:
    """A job for each row of data: its scene file, that file with the driver unchanged, its problems."""
    used: set[str] = set()
    for number, (line, cells) in enumerate(lines, 1):
        name = next((safe_name(cells[i]) for i in others[:1] if i < len(cells)), f"line-{line}")
        while name in used:
            name = f"{name}-{line}"
        used.add(name)
        try:
            settings = dict(replaced(source, data, cells))
            moving = {k for k in settings if k.startswith("driver") and k.endswith((".angle", ".travel"))}
            before = {k: value for k, value in settings.items() if k not in moving}
            made, base = (applied(source, list(some), list(some.values())) for some in (settings, before))
            yield Job(name, number, made, base=base if moving else None)
        except GraphkinError as error:
            yield Job(name, number, {}, trouble=error.problems[0].sentence)
        except ValueError as error:
            yield Job(name, number, {}, trouble=error.args[0])
