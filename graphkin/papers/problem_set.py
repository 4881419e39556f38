"""A set of problems: a variant for each student, made by any executor, kept as it grows, none lost."""

from __future__ import annotations

import json
import re
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any, TypeVar

from graphkin.errors import GraphkinError
from graphkin.papers.jobs import Job, Made
from graphkin.papers.notes import Notes
from graphkin.papers.variants import Answer, Unfit, Variant, candidate, examined, varied_keys

__all__ = ["Failure", "MadeSet", "distinct", "make"]

ATTEMPTS = 60  # tries at one variant before it is given up
AHEAD = 4  # variants handed out for each worker, so that memory stays bounded and none waits

# of a title: the data that it names ("…, scheme 2, position 7", "… 150, 500, 300")
_DATA = re.compile(r"(?:\s+[\d.]+(?=[,、]\s*\d))?\s*[,:，：;；(（、][^,:，：;；(（、]*\d.*$")

Source = Mapping[str, Any]
Render = Callable[[Variant], Mapping[str, bytes]]
Result = TypeVar("Result")


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


def work(job: Job, attempt: int) -> Made:
    """The first good variant of a job from an attempt on; depends on nothing else, so it runs anywhere."""
    if job.spread is None:
        return _row(job)
    why: Counter[str] = Counter()
    for k in range(attempt, ATTEMPTS):
        try:
            source = _named(candidate(job.source, job.spread, job.seed, job.number, k), job.name)
            return Made(examined(source, _where_it_was(source, job.source), job.name), k)
        except Unfit as unfit:
            why[str(unfit)] += 1
        except Exception as error:  # whatever goes wrong with one must not take the others along
            why[_reason(error)] += 1
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
        except Exception as error:
            why = _reason(error)
    return Made(None, 0, why)


def _named(source: Source, name: str) -> dict[str, Any]:
    title, zh = (_DATA.sub("", str(source.get(key, ""))) for key in ("title", "title_zh"))
    named = {"title": f"{title} (no. {name})"[:300], **({"title_zh": f"{zh}（第 {name} 题）"[:300]} if zh else {})}
    # where it comes from, published values and scales belong to the problem as it was
    kept = {k: v for k, v in source.items() if k not in ("printed", "source", "title", "title_zh", "sheet")}
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
    keep: Callable[[Variant, Mapping[str, bytes]], Iterable[str]] | None = None,
    render: Render | None = None,
    progress: Callable[[int, int], None] | None = None,
    finish: Callable[[MadeSet], None] | None = None,
) -> MadeSet:
    """Make every variant of a set, in order, each different in its answers from those before.

    Parameters
    ----------
    folder : where finished variants are noted down, so that an interrupted set goes on
    executor : any that follows ``concurrent.futures.Executor``; without one, and where it fails, the work is done here
    workers : how many variants it can work on at once
    keep : called with each variant in order, and with its rendered files; gives the names of the files it wrote
    render : called in the executor for each variant accepted; gives files by name
    progress : called with the number done and the number of all
    finish : called with the whole set, before the notes of what is done are taken away

    A variant whose papers cannot be made or written is a failure, and the next call tries it again.
    """
    made = MadeSet()
    notes = Notes(folder, jobs, render, ATTEMPTS)
    seen = notes.read()
    ahead = AHEAD * max(workers, 1)
    waiting = iter(jobs)
    taken: list[tuple[Answer, ...]] = []  # answers of every variant accepted, whatever becomes of its papers
    queue: deque[tuple[Job, Callable[[], Made]]] = deque()
    rendering: deque[tuple[Job, Made, Variant, Callable[[], _Papers]]] = deque()

    def refill() -> None:
        for job in islice(waiting, ahead - len(queue)):
            noted = seen.get(job.number)
            queue.append((job, partial(_given, noted) if noted else _started(executor, work, job, 0)))

    def settled(job: Job, result: Made) -> Made:
        while job.spread and result.variant and not distinct(result.variant.answers, iter(taken)):
            result = _started(executor, work, job, result.attempt + 1)()
        return result

    def fail(job: Job, why: str) -> None:
        made.failures.append(Failure(job.name, why))
        count()

    def succeed(job: Job, variant: Variant) -> None:
        made.names.append(job.name)
        made.answers[job.name] = variant.answers
        if variant.remarks:
            made.remarks[job.name] = variant.remarks
        count()

    def count() -> None:
        if progress is not None:
            progress(len(made.names) + len(made.failures), len(jobs))

    whole = True

    def hand_over(most: int) -> None:
        nonlocal whole
        while len(rendering) > most:
            job, result, variant, started = rendering.popleft()
            papers = started()
            why = papers.why
            written: tuple[str, ...] = ()
            if not why and keep is not None:
                try:
                    written = tuple(keep(variant, papers.files))
                except Exception as error:
                    why = _reason(error)
            if why:
                whole = False
                fail(job, why)
            else:
                notes.add(job, result, written)
                succeed(job, variant)

    refill()
    while queue:
        job, started = queue.popleft()
        result = started() if job.number in seen else settled(job, started())
        if result.variant is None:
            hand_over(0)
            if job.number not in seen:
                notes.add(job, result)
            fail(job, result.why)
        else:
            taken.append(result.variant.answers)
            if job.number in seen:
                hand_over(0)
                succeed(job, result.variant)
            else:
                rendering.append((job, result, result.variant, _started(executor, _rendered, render, result.variant)))
                hand_over(ahead if executor is not None and render is not None else 0)
        refill()
    hand_over(0)
    if finish is not None:
        finish(made)
    if whole:
        notes.close()
    return made


@dataclass(frozen=True)
class _Papers:
    """Rendered files by name, or why there are none."""

    files: Mapping[str, bytes] = field(default_factory=dict)
    why: str = ""


def _rendered(render: Render | None, variant: Variant) -> _Papers:
    try:
        return _Papers(render(variant)) if render is not None else _Papers()
    except Exception as error:  # whatever goes wrong with one must not take the others along
        return _Papers(why=_reason(error))


def _reason(error: Exception) -> str:
    """What went wrong in one line; what the program did not foresee with the kind of error."""
    text = (str(error).splitlines() or [""])[0][:300]
    return text if isinstance(error, GraphkinError) else f"{type(error).__name__}: {text}"


def _given(made: Made) -> Made:
    return made


def _started(executor: Executor | None, task: Callable[..., Result], *args: Any) -> Callable[[], Result]:
    """Start a task that raises nothing: what is returned gives its result.

    Without an executor it is done here, and where the executor fails it (a broken pool, a lost worker, what cannot be
    sent there).
    """
    future: Future[Result] | None = None
    if executor is not None:
        with suppress(Exception):
            future = executor.submit(task, *args)

    def result() -> Result:
        if future is not None:
            with suppress(Exception):
                return future.result()
        return task(*args)

    return result
