"""What there is to make of a set of problems, and what became of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from graphkin.papers.variants import Range, Variant

__all__ = ["Job", "Made", "jobs_of_rows", "jobs_of_seed"]

Source = Mapping[str, Any]


@dataclass(frozen=True)
class Job:
    """One variant to make: drawn from a seed within a range, or a row of given data.

    ``source`` is the scene file to vary, or that of the row; ``base`` the row's with the driver where it was;
    ``trouble`` what is wrong with a row.
    """

    name: str
    number: int
    source: Source
    spread: Range | None = None
    seed: int = 0
    base: Source | None = None
    trouble: str = ""


@dataclass(frozen=True)
class Made:
    """What became of a job: a variant with the attempt that gave it, or why there is none."""

    variant: Variant | None
    attempt: int = 0
    why: str = ""


def jobs_of_seed(source: Source, count: int, seed: int, spread: Range) -> Iterator[Job]:
    """One job for each of so many variants of a scene file."""
    digits = max(2, len(str(count)))
    for number in range(1, count + 1):
        yield Job(f"{number:0{digits}d}", number, source, spread, seed)


def jobs_of_rows(rows: Iterable[tuple[str, Source, Source | None, str]]) -> Iterator[Job]:
    """One job for each row of data: name, scene file, the file with the driver where it was, what is wrong with it."""
    for number, (name, source, base, trouble) in enumerate(rows, 1):
        yield Job(name, number, source, base=base, trouble=trouble)
