"""A set of problems: a variant for each student, made by any executor, kept as it grows, none lost.

In the folder of results a hidden file holds the finished variants, a line each, until the set is whole; a set that was
interrupted finds them there and goes on.  Its name is the key of the set, so nothing of another set is ever used.
"""

from __future__ import annotations

import hashlib
import json
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import suppress
from dataclasses import asdict, dataclass, field, is_dataclass
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar

from graphkin.errors import GraphkinError
from graphkin.handout.variants import Answer, Range, Unfit, Variant, candidate, examined, varied_keys
from graphkin.version import __version__

__all__ = ["Failure", "Job", "Made", "MadeSet", "distinct", "jobs_of_rows", "jobs_of_seed", "make"]

ATTEMPTS = 60  # tries at one variant before it is given up
AHEAD = 4  # variants handed out for each worker, so that memory stays bounded and none waits

Source = Mapping[str, Any]
Render = Callable[[Variant], Mapping[str, bytes]]
Result = TypeVar("Result")


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


@dataclass(frozen=True)
class Failure:
    """A variant that could not be made."""

    name: str
    why: str


@dataclass
class MadeSet:
    """What a set came to: variants made, with their answers, and failures; the scenes are in the folder."""

    names: list[str] = field(default_factory=list)
    answers: dict[str, tuple[Answer, ...]] = field(default_factory=dict)
    remarks: dict[str, tuple[str, ...]] = field(default_factory=dict)
    failures: list[Failure] = field(default_factory=list)

    @property
    def ok(self) -> bool:
        """Whether every variant was made."""
        return not self.failures


def jobs_of_seed(source: Source, count: int, seed: int, spread: Range) -> Iterator[Job]:
    """One job for each of so many variants of a scene file."""
    digits = max(2, len(str(count)))
    for number in range(1, count + 1):
        yield Job(f"{number:0{digits}d}", number, source, spread, seed)


def jobs_of_rows(rows: Iterable[tuple[str, Source, Source | None, str]]) -> Iterator[Job]:
    """One job for each row of data: name, scene file, the file with the driver where it was, what is wrong with it."""
    for number, (name, source, base, trouble) in enumerate(rows, 1):
        yield Job(name, number, source, base=base, trouble=trouble)


def work(job: Job, attempt: int) -> Made:
    """The first good variant of a job from an attempt on; depends on nothing else, so it runs anywhere."""
    if job.spread is None:
        return _row(job)
    why: Counter[str] = Counter()
    for k in range(attempt, ATTEMPTS):
        source = _named(candidate(job.source, job.spread, job.seed, job.number, k), job.name)
        try:
            return Made(examined(source, _where_it_was(source, job.source), job.name), k)
        except Unfit as unfit:
            why[str(unfit)] += 1
    reason = why.most_common(1)[0][0] if why else "every attempt has the answers of another variant"
    return Made(None, ATTEMPTS, f"none of {ATTEMPTS} attempts is a good problem, for example: {reason}")


def _row(job: Job) -> Made:
    """A row of data as it stands; what makes it hard to draw is a remark."""
    why = job.trouble
    for base in (job.base, None) if job.base is not None else (None,):
        if job.trouble:
            break
        try:
            return Made(examined(_named(job.source, job.name), base, job.name, strict=False))
        except Unfit as unfit:
            why = str(unfit)
    return Made(None, 0, why)


def _named(source: Source, name: str) -> dict[str, Any]:
    title, zh = source.get("title", ""), source.get("title_zh", "")
    named = {"title": f"{title} (no. {name})"[:300], **({"title_zh": f"{zh}（第 {name} 题）"[:300]} if zh else {})}
    # published values and scales belong to the problem as it was
    kept = {k: v for k, v in source.items() if k not in ("printed", "title", "title_zh", "sheet")}
    sheet = {k: v for k, v in source.get("sheet", {}).items() if not k.endswith("_scale")}
    return {**named, **kept, **({"sheet": sheet} if sheet else {})}


def _where_it_was(source: Source, original: Source) -> dict[str, Any]:
    """The file with the drivers' values of the original, where its sketch holds."""
    made = json.loads(json.dumps(source))
    for path, kind in varied_keys(original):
        if kind in ("angle", "travel"):
            place, old = made, original
            for part in path[:-1]:
                place, old = place[part], old[part]  # type: ignore[index]
            place[path[-1]] = old[path[-1]]  # type: ignore[index]
    return dict(made)


def distinct(one: Sequence[Answer], others: Iterator[Sequence[Answer]]) -> bool:
    """Whether some answer differs from that of every other variant by more than both may be drawn wrong."""
    return all(
        any(abs(a.value - b.value) > a.tolerance + b.tolerance for a, b in zip(one, other, strict=True))
        for other in others
    )


def make(
    jobs: Sequence[Job],
    folder: Path | None = None,
    executor: Executor | None = None,
    workers: int = 1,
    keep: Callable[[Variant, Mapping[str, bytes]], None] | None = None,
    render: Render | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> MadeSet:
    """Make every variant of a set, in order, each different in its answers from those before.

    Parameters
    ----------
    folder : where finished variants are noted down, so that an interrupted set goes on
    executor : any that follows ``concurrent.futures.Executor``; without one the work is done here
    workers : how many variants it can work on at once
    keep : called with each variant in order, and with its rendered files
    render : called in the executor for each variant accepted; gives files by name
    progress : called with the number done and the number of all
    """
    made = MadeSet()
    notes = _Notes(folder, jobs, render)
    seen = notes.read()
    ahead = AHEAD * max(workers, 1)
    waiting = iter(jobs)
    queue: deque[tuple[Job, Callable[[], Made]]] = deque()
    rendering: deque[tuple[Job, Made, Variant, Callable[[], Mapping[str, bytes]]]] = deque()

    def refill() -> None:
        for job in islice(waiting, ahead - len(queue)):
            noted = seen.get(job.number)
            queue.append((job, partial(_given, noted) if noted else _started(executor, work, job, 0)))

    def settled(job: Job, result: Made) -> Made:
        while job.spread and result.variant and not distinct(result.variant.answers, iter(made.answers.values())):
            result = _started(executor, work, job, result.attempt + 1)()
        return result

    def hand_over(most: int) -> None:
        while len(rendering) > most:
            job, result, variant, files = rendering.popleft()
            try:
                if keep is not None:
                    keep(variant, files())
            except GraphkinError as error:
                made.failures.append(Failure(job.name, str(error).splitlines()[0]))
            notes.add(job, result)

    refill()
    while queue:
        job, started = queue.popleft()
        result = started() if job.number in seen else settled(job, started())
        if result.variant is None:
            made.failures.append(Failure(job.name, result.why))
            if job.number not in seen:
                notes.add(job, result)
        else:
            made.names.append(job.name)
            made.answers[job.name] = result.variant.answers
            if result.variant.remarks:
                made.remarks[job.name] = result.variant.remarks
            if job.number not in seen:
                files = _started(executor, render or _no_files, result.variant)
                rendering.append((job, result, result.variant, files))
                hand_over(ahead if executor is not None and render is not None else 0)
        if progress is not None:
            progress(len(made.names) + len(made.failures), len(jobs))
        refill()
    hand_over(0)
    notes.close()
    return made


def _no_files(_: Variant) -> Mapping[str, bytes]:
    return {}


def _given(made: Made) -> Made:
    return made


def _started(executor: Executor | None, task: Callable[..., Result], *args: Any) -> Callable[[], Result]:
    """Start a task in an executor: what is returned gives its result.  Without one it is done here."""
    future: Future[Result] | None = None
    if executor is not None and task is not _no_files:
        with suppress(BrokenExecutor):
            future = executor.submit(task, *args)

    def result() -> Result:
        if future is not None:
            with suppress(BrokenExecutor):
                return future.result()
        return task(*args)

    return result


class _Notes:
    """Finished variants, a line of JSON each."""

    def __init__(self, folder: Path | None, jobs: Sequence[Job], render: Render | None) -> None:
        self.path: Path | None = None
        if folder is not None and jobs:
            # other papers are another set
            papers = repr(render) if is_dataclass(render) else getattr(render, "__qualname__", "")
            key = hashlib.sha256(repr((__version__, ATTEMPTS, papers)).encode())
            for job in jobs:
                # jobs drawn from one seed share their scene: only the first is written out
                whole = asdict(job) if job.spread is None or job.number == 1 else (job.name, job.number)
                key.update(json.dumps(whole, sort_keys=True, default=str).encode())
            self.path = folder / f".set-{key.hexdigest()[:24]}.jsonl"

    def read(self) -> dict[int, Made]:
        """Finished jobs by number; a line that was cut off is dropped."""
        found: dict[int, Made] = {}
        if self.path is None or not self.path.exists():
            return found
        whole = 0
        with self.path.open("r+b") as stream:
            for line in stream:
                try:
                    note = json.loads(line)
                    found[note["number"]] = _made(note)
                except (ValueError, TypeError, KeyError):
                    break
                whole += len(line)
            stream.truncate(whole)
        return found

    def add(self, job: Job, made: Made) -> None:
        if self.path is None:
            return
        variant = asdict(made.variant) if made.variant else None
        note = {"number": job.number, "variant": variant, "attempt": made.attempt, "why": made.why}
        with self.path.open("a", encoding="utf-8") as stream:
            stream.write(json.dumps(note, ensure_ascii=False) + "\n")

    def close(self) -> None:
        if self.path is not None:
            self.path.unlink(missing_ok=True)


def _made(note: Mapping[str, Any]) -> Made:
    v = note["variant"]
    if v is None:
        return Made(None, note["attempt"], note["why"])
    answers = tuple(Answer(**a) for a in v["answers"])
    return Made(Variant(v["name"], v["source"], answers, tuple(v["remarks"])), note["attempt"], note["why"])
