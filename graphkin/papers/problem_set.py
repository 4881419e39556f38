"""A set of problems: a variant for each student, made by whatever works, kept as it grows, none lost.

In the folder of results a hidden one holds what is finished until the set is whole; a variant whose files are gone is
made again.
"""

from __future__ import annotations

import json
import re
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, is_dataclass
from itertools import islice
from pathlib import Path

from graphkin.errors import GraphkinError, Unsolvable
from graphkin.files import OwnTables, Tables
from graphkin.jobs import Checkpoints, Progress, Started, Workers, key_of
from graphkin.papers.fresh_numbers import Spread, candidate, varied_keys
from graphkin.papers.variants import Answer, Unfit, Variant, examined
from graphkin.papers.vary_rules import level_of
from graphkin.scene import mechanism_of
from graphkin.structure import analyse

__all__ = ["Failure", "Job", "MadeSet", "Render", "accepted", "distinct", "jobs_of_rows", "jobs_of_seed", "make"]

MANY = 12  # of them for everything that may be asked, then as many for two of it at least, then for one
AMONG = 12  # candidates with larger groups among which one is looked for of which a pencil finds two quantities
ATTEMPTS = 120  # tries at one variant before it is given up
PATIENCE, LONGER = 3.0, 9.0  # s of the processor, after which no further one is begun; with larger groups

# of a title: the data that it names ("…, scheme 2, position 7", "… 150, 500, 300")
_DATA = re.compile(r"(?:\s+[\d.]+(?=[,、]\s*\d))?\s*[,:，：;；(（、][^,:，：;；(（、]*\d.*$")

Render = Callable[[Variant], Mapping[str, bytes]]


@dataclass(frozen=True)
class Job:
    """One variant to make: drawn from a seed within a range, or a row of given data.

    ``source`` is the scene file to vary, or that of the row; ``base`` the row's with the driver where it was;
    ``trouble`` what is wrong with a row.
    """

    name: str
    number: int
    source: Tables
    spread: Spread | None = None
    seed: int = 0
    base: Tables | None = None
    trouble: str = ""


@dataclass(frozen=True)
class Attempt:
    """What became of a job: a variant with the attempt that gave it, or why there is none."""

    variant: Variant | None
    attempt: int = 0
    why: str = ""


@dataclass(frozen=True)
class Failure:
    """A variant that could not be made."""

    name: str
    why: str
    exit_code: int = Unsolvable.exit_code


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


def jobs_of_seed(source: Tables, count: int, seed: int, spread: Spread) -> Iterator[Job]:
    """One job for each of so many variants of a scene file."""
    digits = max(2, len(str(count)))
    for number in range(1, count + 1):
        yield Job(f"{number:0{digits}d}", number, source, spread, seed)


def jobs_of_rows(rows: Iterable[tuple[str, Tables, Tables | None, str]]) -> Iterator[Job]:
    """One job for each row of data: name, scene file, the file with the driver where it was, what is wrong with it."""
    for number, (name, source, base, trouble) in enumerate(rows, 1):
        yield Job(name, number, source, base=base, trouble=trouble)


def work(job: Job, attempt: int) -> Attempt:
    """The first good variant of a job from an attempt on; depends on nothing else, so it runs anywhere.

    Only how soon it is given up depends on the machine.
    """
    if job.spread is None:
        return _row(job)
    why: Counter[str] = Counter()
    begun = time.process_time()
    large = bool(analyse(mechanism_of(job.source)).larger_groups)
    lone: Attempt | None = None  # of which a pencil finds one quantity
    for k in range(attempt, ATTEMPTS):
        if time.process_time() - begun > (LONGER if large else PATIENCE) or (lone is not None and k - attempt >= AMONG):
            break
        try:
            fewest = 1 if large else (0, 2, 1)[min((k - attempt) // MANY, 2)]
            # lengths much unlike its own seldom let a larger group assemble
            spread = job.spread.narrower() if large and k % 2 else job.spread
            source = _named(candidate(job.source, spread, job.seed, job.number, k), job.name)
            was = _where_it_was(source, job.source)
            bounds = level_of(job.source)
            made = Attempt(found := examined(source, was, job.name, bounds=bounds, fewest=fewest), k)
            if not large or len(found.answers) > 1 or source.get("find"):
                return made
            lone = lone or made
        except Unfit as unfit:
            why[str(unfit)] += 1
        except Exception as error:  # whatever goes wrong with one must not take the others along
            why[_reason(error)] += 1
    if lone is not None:
        return lone
    reason = "every attempt has the answers of another variant"
    if why:
        reason = "for example: {} ({} times)".format(*why.most_common(1)[0])
    easier = 'ask for less in "find", narrow [vary] ranges, or allow more by [vary] tolerance = 0.1 or level = "hard"'
    return Attempt(None, ATTEMPTS, f"none of {why.total()} attempts is a good problem, {reason}; {easier}")


def _row(job: Job) -> Attempt:
    """A row of data as it stands; what makes it hard to draw is a remark."""
    why = job.trouble
    for base in (job.base, None) if job.base is not None else (None,):
        if job.trouble:
            break
        try:
            return Attempt(examined(_named(job.source, job.name), base, job.name, strict=False))
        except Unfit as unfit:
            why = str(unfit)
        except Exception as error:
            why = _reason(error)
    return Attempt(None, 0, why)


def _named(source: Tables, name: str) -> OwnTables:
    title, zh = (_DATA.sub("", str(source.get(key, ""))) for key in ("title", "title_zh"))
    named = {"title": f"{title} (no. {name})"[:300], **({"title_zh": f"{zh}（第 {name} 题）"[:300]} if zh else {})}
    # where it comes from, published values and scales belong to the problem as it was
    own = ("printed", "source", "source_zh", "title", "title_zh", "sheet", "vary")
    kept = {k: v for k, v in source.items() if k not in own}
    level = (source.get("vary") or {}).get("level")
    if level:  # it says what a sheet gives, too
        kept["vary"] = {"level": level}
    sheet = {k: v for k, v in source.get("sheet", {}).items() if not k.endswith("_scale")}
    return {**named, **kept, **({"sheet": sheet} if sheet else {})}


def _where_it_was(source: Tables, original: Tables) -> OwnTables:
    """The file with the drivers' values of the original, where its sketch holds."""
    made = json.loads(json.dumps(source))
    for path, kind in varied_keys(original):
        if kind in ("angle", "travel", "moment") or (path[0] == "driver" and "law" in path):
            place, old = made, original
            for part in path[:-1]:
                place, old = place[part], old[part]  # type: ignore[index]
            place[path[-1]] = old[path[-1]]  # type: ignore[index]
    return dict(made)


def distinct(one: Sequence[Answer], others: Iterator[Sequence[Answer]]) -> bool:
    """Whether some answer differs from that of every other variant by more than both may be drawn wrong."""
    for other in others:
        known = {a.symbol: a for a in other}
        shared = [(a, known[a.symbol]) for a in one if a.symbol in known]
        if shared and all(abs(a.value - b.value) <= a.tolerance + b.tolerance for a, b in shared):
            return False
    return True


def make(
    jobs: Sequence[Job],
    workers: Workers,
    folder: Path | None = None,
    keep: Callable[[Variant, Mapping[str, bytes]], Iterable[str]] | None = None,
    render: Render | None = None,
    progress: Progress | None = None,
    finish: Callable[[MadeSet], None] | None = None,
) -> MadeSet:
    """Make every variant of a set, in order, each different in its answers from those before.

    Parameters
    ----------
    folder : where finished variants are kept, so that an interrupted set goes on
    keep : called with each variant in order, and with its rendered files; gives the names of the files it wrote
    render : called by the workers for each variant accepted; gives files by name
    progress : called with the number done and the number of all
    finish : called with the whole set, before the checkpoints of what is done are taken away

    A variant whose papers cannot be made or written is a failure, and the next call tries it again.
    """
    made = MadeSet()
    points = Checkpoints.of(folder, "set", _key(jobs, render)) if folder is not None and jobs else None
    done = _finished(points)
    if points is not None:
        points.open(variants=len(jobs))
    again = False

    def settle(job: Job, result: Attempt, papers: Started[RenderedPapers] | None) -> None:
        nonlocal again
        rendered = papers.result() if papers is not None else RenderedPapers()
        why = result.why or rendered.why
        files: tuple[str, ...] = ()
        if papers is not None and keep is not None and result.variant is not None and not why:
            try:
                files = tuple(keep(result.variant, rendered.files))
            except Exception as error:
                why = _reason(error)
        if result.variant is not None and why:
            again = True
        elif points is not None and job.number not in done:
            points.save(job.number, {**asdict(result), "files": files})
        if result.variant is None or why:
            made.failures.append(Failure(job.name, why, rendered.exit_code))
        else:
            made.names.append(job.name)
            made.answers[job.name] = result.variant.answers
            if result.variant.remarks:
                made.remarks[job.name] = result.variant.remarks
        if progress is not None:
            progress(len(made.names) + len(made.failures), len(jobs))

    waiting: deque[tuple[Job, Attempt, Started[RenderedPapers] | None]] = deque()
    for job, result in accepted(jobs, done, workers):
        new = result.variant is not None and job.number not in done
        waiting.append((job, result, workers.start(_rendered, render, result.variant) if new else None))
        while len(waiting) > (workers.ahead if render is not None else 0):
            settle(*waiting.popleft())
    for one in waiting:
        settle(*one)
    if finish is not None:
        finish(made)
    if points is not None and not again:
        points.close()
    return made


def accepted(jobs: Iterable[Job], done: Mapping[int, Attempt], workers: Workers) -> Iterator[tuple[Job, Attempt]]:
    """What becomes of each job, in order; variants drawn from a seed are distinct from all before them."""
    taken: list[tuple[Answer, ...]] = []
    refused: Attempt | None = None
    queue: deque[tuple[Job, Started[Attempt] | None]] = deque()
    left = iter(jobs)
    while True:
        # nothing is begun beside the first before it has shown that the scene can vary
        for job in islice(left, (1 + workers.ahead if taken or refused else 1) - len(queue)):
            queue.append((job, None if job.number in done or refused else workers.start(work, job, 0)))
        if not queue:
            return
        job, started = queue.popleft()
        if refused is not None:
            yield job, refused
            continue
        result = done[job.number] if started is None else started.result()
        if result.variant is None and job.spread is not None and not taken:
            refused = result  # what no attempt at the first one makes a good problem, none at the others will
        while (
            started is not None
            and job.spread is not None
            and result.variant is not None
            and not distinct(result.variant.answers, iter(taken))
        ):
            result = workers.start(work, job, result.attempt + 1).result()
        if result.variant is not None:
            taken.append(result.variant.answers)
        yield job, result


def _key(jobs: Sequence[Job], render: Render | None) -> str:
    """A key of the set: other papers are another set."""
    papers = repr(render) if is_dataclass(render) else getattr(render, "__qualname__", "")
    # jobs drawn from one seed share their scene: only the first is written out
    drawn = (asdict(job) if job.spread is None or job.number == 1 else (job.name, job.number) for job in jobs)
    return key_of(ATTEMPTS, papers, *drawn)


def _finished(points: Checkpoints | None) -> dict[int, Attempt]:
    """Finished jobs by number, of those whose files are all there."""
    found: dict[int, Attempt] = {}
    if points is not None:
        for number, piece in points.done()[0].items():
            if all((points.place.parent / name).is_file() for name in piece.facts["files"]):
                found[number] = _made(piece.facts)
    return found


def _made(facts: Tables) -> Attempt:
    v = facts["variant"]
    if v is None:
        return Attempt(None, facts["attempt"], facts["why"])
    answers = tuple(Answer(**a) for a in v["answers"])
    return Attempt(Variant(v["name"], v["source"], answers, tuple(v["remarks"])), facts["attempt"], facts["why"])


@dataclass(frozen=True)
class RenderedPapers:
    """Rendered files by name, or why there are none."""

    files: Mapping[str, bytes] = field(default_factory=dict)
    why: str = ""
    exit_code: int = Unsolvable.exit_code


def _rendered(render: Render | None, variant: Variant) -> RenderedPapers:
    try:
        return RenderedPapers(render(variant)) if render is not None else RenderedPapers()
    except Exception as error:  # whatever goes wrong with one must not take the others along
        return RenderedPapers(why=_reason(error), exit_code=getattr(error, "exit_code", Unsolvable.exit_code))


def _reason(error: Exception) -> str:
    """What went wrong in one line; what the program did not foresee with the kind of error."""
    text = (str(error).splitlines() or [""])[0][:300]
    return text if isinstance(error, GraphkinError) else f"{type(error).__name__}: {text}"
