"""Sweeps carried out: in memory, or piece by piece into tables in a folder, with how each design came out."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, replace
from pathlib import Path

from graphkin.errors import CallError, Problem
from graphkin.files import folder_alone, whole_file
from graphkin.jobs import Checkpoints, Progress, Workers
from graphkin.study.sweeps import Found, Outcome, PieceResult, Sweep, make
from graphkin.table import Table
from graphkin.table.csv_files import parquet_of_csv
from graphkin.words import Phrase, from_others

__all__ = ["collect", "designs_table", "write_tables"]


def collect(sweep: Sweep, workers: Workers, progress: Progress | None = None) -> Found:
    """A whole sweep in memory."""
    made: list[PieceResult] = []
    for piece in workers.results(make, ((sweep.piece(k, False),) for k in range(sweep.pieces))):
        made.append(piece)
        _count(sweep, len(made), progress)
    table = Table.joined([m.table for m in made if m.table is not None])
    return _found(sweep, ((m.outcomes, m.good) for m in made), table)


def write_tables(
    sweep: Sweep, folder: Path, workers: Workers, parquet: bool = False, progress: Progress | None = None
) -> Found:
    """Make what is missing of a sweep and write its tables into a folder; they appear whole or not at all.

    Parameters
    ----------
    parquet : whether table.parquet is written too
    progress : called with the rows that are done and all rows

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
            done = sweep.pieces - len(missing)
            _count(sweep, done, progress)
            results = workers.results(make, ((sweep.piece(k, True),) for k in missing))
            for number, made in zip(missing, results, strict=True):
                outcomes = [asdict(o) for o in made.outcomes]
                points.save(number, {"outcomes": outcomes, "good": made.good}, made.text)
                done += 1
                _count(sweep, done, progress)
            return replace(_merged(sweep, points, folder, parquet), damaged=damaged)
    except OSError as error:
        raise CallError(
            Problem(
                str(folder),
                Phrase("cannot be written", reason=from_others(error.strerror or str(error))),
                Phrase("give another folder with o"),
            )
        ) from None


def _merged(sweep: Sweep, points: Checkpoints, folder: Path, parquet: bool) -> Found:
    """All pieces in their order as tables in the folder of results; the pieces are removed."""
    facts = []
    files = [folder / "table.csv"]
    with whole_file(files[0], points.place) as out:
        sweep.head.write_csv(out)
        for piece in map(points.load, range(sweep.pieces)):
            if piece is None:
                wanted = "run the same command again; the disk may be failing"
                raise CallError(Problem(str(points.place), Phrase("a piece was damaged while the table was"), wanted))
            piece.copy(out)
            facts.append(piece.facts)
    found = _found(
        sweep, ((tuple(Outcome(**o) for o in f["outcomes"]), f["good"]) for f in facts), None
    )
    if sweep.designs.keys:
        files.append(folder / "designs.csv")
        with whole_file(files[-1], points.place) as out:
            designs_table(sweep, found.outcomes).write_csv(out)
    if parquet:
        files.append(folder / "table.parquet")
        with whole_file(files[-1], points.place) as out:
            parquet_of_csv(files[0], sweep.head, out)
    points.close()
    return replace(found, files=tuple(files))


def _count(sweep: Sweep, done: int, progress: Progress | None) -> None:
    if progress is not None:
        progress(min(sweep.rows, round(sweep.rows * done / sweep.pieces)), sweep.rows)


def _found(sweep: Sweep, made: Iterable[tuple[tuple[Outcome, ...], int]], table: Table | None) -> Found:
    """What a sweep came to, from what its pieces say: a design is "ok", "partly" so (some positions could not be
    given), or has the status of the first that could not."""
    good = 0
    parts: dict[int, list[Outcome]] = {}
    for outcomes, rows in made:
        good += rows
        for outcome in outcomes:
            parts.setdefault(outcome.design, []).append(outcome)
    whole = []
    for design, own in sorted(parts.items()):
        right = sum(o.good for o in own)
        said = next((o for o in own if o.why), own[0])
        status = "ok" if right == sweep.positions else "partly" if right else said.status
        cells = next((o.cells for o in own if o.cells), {})
        whole.append(Outcome(design, status, said.why, cells, right))
    return Found(sweep.rows, good, tuple(whole), table)


def designs_table(sweep: Sweep, outcomes: Sequence[Outcome]) -> Table:
    """A row for each design: what was replaced, how it came out, strokes, K, least transmission angles."""
    names = tuple(dict.fromkeys(name for o in outcomes for name in o.cells))
    rows = (
        (o.design + 1, *sweep.designs[o.design], o.status, *(o.cells.get(n) for n in names), o.why) for o in outcomes
    )
    return Table.of(("design", *sweep.designs.keys, "status", *names, "why"), rows)
