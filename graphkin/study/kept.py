"""Finished chunks of a sweep kept as files, and merged into tables.

In the folder of results a hidden folder holds them until the tables are whole; a sweep that was interrupted finds them
there and goes on.  Its name is the key of the sweep, so nothing of another sweep is ever used.
"""

from __future__ import annotations

import csv
import json
import os
import shutil
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np

from graphkin.study.chunks import Done, Plan
from graphkin.study.table import csv_cell

__all__ = ["Kept", "Swept"]


@dataclass(frozen=True)
class Swept:
    """What a sweep gave: files of the tables, rows in all, rows that are ok, and how each design came out.

    tables : "table.csv", "designs.csv" and, where pyarrow is installed, "table.parquet", in the folder
    outcomes : for each status how many designs have it
    """

    folder: Path
    tables: tuple[str, ...]
    rows: int
    good: int
    outcomes: dict[str, int]


@dataclass(frozen=True)
class Kept:
    """The chunks of a sweep that are done, as files in a hidden folder."""

    place: Path
    plan: Plan
    parquet: bool

    def open(self) -> None:
        """Make the folder, with a manifest that says in words what it holds."""
        self.place.mkdir(exist_ok=True)
        manifest = self.place / "manifest.json"
        if not manifest.exists():
            facts = {
                "what": "finished chunks of a graphkin sweep; the same command goes on from here",
                "scene": self.plan.name,
                "key": self.plan.key,
                "chunks": self.plan.chunks,
                "rows": self.plan.rows,
            }
            _whole(manifest, json.dumps(facts, indent=1).encode())

    def missing(self) -> list[int]:
        """Chunks that are not done."""
        have = {p.name for p in self.place.iterdir()}
        endings = (".csv", ".json", ".bin") if self.parquet else (".csv", ".json")
        return [k for k in range(self.plan.chunks) if any(f"{k:07d}{e}" not in have for e in endings)]

    def keep(self, chunk: int, done: Done) -> None:
        """Put a chunk into the folder; the file that counts comes last."""
        if self.parquet:
            _whole(self.place / f"{chunk:07d}.bin", done.numbers)
        facts = {"designs": done.designs, "good": done.good}
        _whole(self.place / f"{chunk:07d}.json", json.dumps(facts).encode())
        _whole(self.place / f"{chunk:07d}.csv", done.text)

    def merge(self, folder: Path) -> Swept:
        """All chunks in their order as tables in the folder of results; the chunks are removed."""
        plan = self.plan
        outcomes: dict[str, int] = {}
        facts = [json.loads((self.place / f"{k:07d}.json").read_bytes()) for k in range(plan.chunks)]
        good = sum(f["good"] for f in facts)
        designs = _outcomes(plan, [d for f in facts for d in f["designs"]])
        for entry in designs:
            outcomes[entry[1]] = outcomes.get(entry[1], 0) + 1
        made: dict[str, Path] = {"table.csv": self._table_csv()}
        if plan.designs.keys:
            made["designs.csv"] = self.place / "designs"
            _whole(made["designs.csv"], _designs_csv(plan, designs))
        if self.parquet:
            made["table.parquet"] = self._table_parquet()
        for name, path in made.items():
            os.replace(path, folder / name)
        shutil.rmtree(self.place)
        return Swept(folder, tuple(made), plan.rows, good, outcomes)

    def _table_csv(self) -> Path:
        path = self.place / "table"
        with open(path, "wb") as stream:
            head = [csv_cell(c) for part in self.plan.heads for c in part]
            stream.write((",".join(head) + "\n").encode())
            for k in range(self.plan.chunks):
                with open(self.place / f"{k:07d}.csv", "rb") as chunk:
                    shutil.copyfileobj(chunk, stream)
        return path

    def _table_parquet(self) -> Path:
        import pyarrow as pa
        from pyarrow import parquet

        plan = self.plan
        _, names, after = plan.heads
        whole = [pa.int64()] * (2 if plan.designs.keys else 1)
        fields = [(n, pa.float64()) for n in names] + [(n, pa.string()) for n in after]
        lead = [("design", whole[0])] if plan.designs.keys else []
        schema = pa.schema([*lead, ("position", pa.int64()), *fields])
        path = self.place / "binary"
        with parquet.ParquetWriter(path, schema, compression="zstd") as writer:
            for k in range(plan.chunks):
                task = plan.task(k)
                n = task.last - task.first
                numbers = np.frombuffer((self.place / f"{k:07d}.bin").read_bytes()).reshape(-1, len(names))
                ends = [_last_cells(line) for line in _lines(self.place / f"{k:07d}.csv")]
                columns: list[Any] = []
                if plan.designs.keys:
                    columns.append(np.repeat([d + 1 for d, _ in task.designs], n))
                columns.append(np.tile(np.arange(task.first, task.last) + 1, len(task.designs)))
                columns += [pa.array(numbers[:, i], mask=np.isnan(numbers[:, i])) for i in range(len(names))]
                columns += [[e[i] for e in ends] for i in range(2)]
                writer.write_table(pa.table(columns, schema=schema))
        return path


def _lines(path: Path) -> IO[str]:
    return open(path, encoding="utf-8", newline="")


def _last_cells(line: str) -> tuple[str, str]:
    """Status and reason at the end of a line of the table."""
    cells = next(csv.reader([line]))
    return cells[-2], cells[-1]


def _outcomes(plan: Plan, parts: Sequence[Any]) -> list[tuple[int, str, str, dict[str, float | str | None]]]:
    """How each design came out, from what its chunks say: "ok", "partly" (some positions could not be given), or why
    none could."""
    entries: dict[int, tuple[int, list[str], dict[str, float | str | None]]] = {}
    for design, status, why, cells, good in parts:
        before, said, have = entries.get(design, (0, [], {}))
        entries[design] = (before + good, said or ([status, why] if why else []), have or cells)
    found = []
    for design, (good, said, cells) in sorted(entries.items()):
        status = "ok" if good == plan.positions else "partly" if good else said[0]
        found.append((design, status, said[1] if said else "", cells))
    return found


def _designs_csv(plan: Plan, designs: Sequence[tuple[int, str, str, dict[str, float | str | None]]]) -> bytes:
    """A row for each design: what was replaced, how it came out, strokes, K, least transmission angles."""
    names: dict[str, None] = {}
    for _, _, _, cells in designs:
        names.update(dict.fromkeys(cells))
    lines = [["design", *plan.designs.keys, "status", *names, "why"]]
    for index, status, why, cells in designs:
        values = [csv_cell(v) for v in plan.designs[index]]
        lines.append([str(index + 1), *values, status, *(csv_cell(cells.get(n)) for n in names), csv_cell(why)])
    head = [csv_cell(c) for c in lines[0]]
    return ("\n".join(",".join(line) for line in [head, *lines[1:]]) + "\n").encode()


def _whole(path: Path, content: bytes) -> None:
    """Write a file so that it is there whole or not at all."""
    handle, temporary = tempfile.mkstemp(prefix=".", dir=path.parent)
    with os.fdopen(handle, "wb") as stream:
        stream.write(content)
    os.replace(temporary, path)
