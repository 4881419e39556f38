"""What is done of a set of problems, noted down beside its files, so that an interrupted set goes on.

In the folder of results a hidden file holds the finished variants, a line each, until the set is whole.  Its name is
the key of the set, so nothing of another set is ever used; a variant whose files are gone is made again.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, is_dataclass
from pathlib import Path
from typing import Any

from graphkin.papers.jobs import Job, Made
from graphkin.papers.variants import Answer, Variant
from graphkin.version import __version__

__all__ = ["Notes"]


class Notes:
    """Finished variants of one set in one folder (none: nothing is noted)."""

    def __init__(
        self, folder: Path | None, jobs: Sequence[Job], render: Callable[..., object] | None, attempts: int
    ) -> None:
        self.path: Path | None = None
        if folder is not None and jobs:
            # other papers are another set
            papers = repr(render) if is_dataclass(render) else getattr(render, "__qualname__", "")
            key = hashlib.sha256(repr((__version__, attempts, papers)).encode())
            for job in jobs:
                # jobs drawn from one seed share their scene: only the first is written out
                whole = asdict(job) if job.spread is None or job.number == 1 else (job.name, job.number)
                key.update(json.dumps(whole, sort_keys=True, default=str).encode())
            self.path = folder / f".set-{key.hexdigest()[:24]}.jsonl"

    def read(self) -> dict[int, Made]:
        """Finished jobs by number; a line that was cut off is dropped, and one whose files are not all there."""
        found: dict[int, Made] = {}
        if self.path is None or not self.path.exists():
            return found
        whole = 0
        with self.path.open("r+b") as stream:
            for line in stream:
                try:
                    note = json.loads(line)
                    made = _made(note)
                    there = all((self.path.parent / name).is_file() for name in note["files"])
                except (ValueError, TypeError, KeyError):
                    break
                whole += len(line)
                if there:
                    found[note["number"]] = made
            stream.truncate(whole)
        return found

    def add(self, job: Job, made: Made, files: Iterable[str] = ()) -> None:
        """Note what became of a job, once its files are written."""
        if self.path is None:
            return
        variant = asdict(made.variant) if made.variant else None
        note = {
            "number": job.number, "variant": variant, "attempt": made.attempt, "why": made.why, "files": list(files),
        }  # fmt: skip
        with self.path.open("a", encoding="utf-8") as stream:
            stream.write(json.dumps(note, ensure_ascii=False) + "\n")

    def close(self) -> None:
        """Take the notes away: the set is whole."""
        if self.path is not None:
            self.path.unlink(missing_ok=True)


def _made(note: Mapping[str, Any]) -> Made:
    v = note["variant"]
    if v is None:
        return Made(None, note["attempt"], note["why"])
    answers = tuple(Answer(**a) for a in v["answers"])
    return Made(Variant(v["name"], v["source"], answers, tuple(v["remarks"])), note["attempt"], note["why"])
