"""Variants of a problem: the same mechanism with other round numbers, solvable on paper, no two with the same answer;
and sets of them, one for each student, made by any workers and kept while they grow.

A hidden folder in the folder of results holds the finished variants until the set is complete; a variant with missing
files is made again.
"""

from __future__ import annotations

import copy
import math
import re
import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, is_dataclass, replace
from functools import partial
from itertools import islice, pairwise
from pathlib import Path

from graphkin.checking.readings import read_off
from graphkin.checking.uncertainty import predict
from graphkin.construction import Sheet, execute
from graphkin.construction.board.steps import Ray
from graphkin.errors import Disagreement, GraphkinError, Unsolvable
from graphkin.files import OwnTables, Tables
from graphkin.jobs import Checkpoints, Progress, Workers, key_of
from graphkin.papers.fresh_numbers import LEVELS, Bounds, Spread, candidate, level_of, round_step, varied_keys
from graphkin.papers.paper import paper_plan
from graphkin.plane import cross
from graphkin.scene import mechanism_of
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import put_at, value_at
from graphkin.solver import Motion, solve
from graphkin.solver.cams import study_cam
from graphkin.solver.path.named_positions import standing
from graphkin.solver.values import exact_values
from graphkin.structure import Dyad, LargerGroup, analyse
from graphkin.words import Phrase, Wording, as_data, from_data, from_others

LEAST_READING = 10.0  # mm on paper
AMPLE = 0.8  # of a tolerance, to which errors that act together may still add
MOST_ASKED = 6  # of what a pencil does not miss
NOTHING = 1e-9  # of the greatest value of its sort: what is smaller is zero
MANY = 12  # of them for everything that may be asked, then as many for two of it at least, then for one
AMONG = 12  # candidates with larger groups among which one is looked for of which a pencil finds two quantities
ATTEMPTS = 120  # tries at one variant before it is given up
PATIENCE, LONGER = 3.0, 9.0  # s of the processor, after which no further one is begun; with larger groups

# of a title: the data that it names ("…, scheme 2, position 7", "… 150, 500, 300")
_DATA = re.compile(r"(?:\s+[\d.]+(?=[,、]\s*\d))?\s*[,:，：;；(（、][^,:，：;；(（、]*\d.*$")


@dataclass(frozen=True)
class Answer:
    """A right answer in the file's unit (vectors by size), and the tolerance of a pencil drawing."""

    symbol: str
    value: float
    tolerance: float
    unit: str = ""


@dataclass(frozen=True)
class Variant:
    """A variant: its name, the mapping of its scene file, its answers, remarks on it, and the attempt that gave it; or
    the reason ``why`` it could not be made, with its exit code."""

    name: str
    source: Tables = field(default_factory=dict)
    answers: tuple[Answer, ...] = ()
    remarks: tuple[Wording, ...] = ()
    attempt: int = 0
    why: Wording = ""
    exit_code: int = Unsolvable.exit_code

    @property
    def scene(self) -> Mechanism:
        """The variant as a scene."""
        return standing(mechanism_of(self.source))

    def failed(self, error: Exception) -> Variant:
        """The variant as failed: its papers could not be made."""
        return replace(self, why=_reason(error), exit_code=getattr(error, "exit_code", Unsolvable.exit_code))


class Unfit(Exception):
    """The error of a candidate that makes no good problem, with the reason."""

    def __init__(self, why: Wording, exit_code: int = Unsolvable.exit_code) -> None:
        super().__init__(why)
        self.why, self.exit_code = why, exit_code


def asked_of(scene: Mechanism) -> tuple[Symbol, ...]:
    """The questions of a problem: the scene's own ``find``, else the motion of the last group's joint, and the rates of
    the links about fixed pivots; without groups the motions of followers: wheels, racks, followers of cams."""
    if scene.question.find:
        return scene.question.find
    structure = analyse(scene)
    driven = {e.link for e in structure.driven}
    turning = [k.name for k in scene.links if k.name not in driven and scene.pivots(k.name)]
    symbols: list[Symbol] = []
    last = next(reversed(structure.groups), None)
    if last is not None:
        if isinstance(last, Dyad):  # its end first, or what lies inside it
            joints: tuple[Pair, ...] = (last.outer_second, last.inner, last.outer_first)
        else:
            inside = [p for p in last.pairs if {p.a, p.b} <= set(last.members)]
            joints = (*reversed(inside), *(p for p in last.pairs if p not in inside))
        names = [p.point or p.pin for p in joints]
        known = {*scene.frame.points, *(d.centre for k in scene.links if k.name in driven for d in k.discs.values())}
        rolled = {e.link for e in structure.driven if any(d.rolls for d in e.drivers)}
        known |= {p for k in scene.links if k.name in rolled for p in k.points}
        moving = next((n for n in names if n and n not in known), None)
        symbols += [Symbol.parse(f"{k}_{moving}") for k in ("v", "a")] if moving else []
    symbols += [Symbol(kind, link=name) for name in turning for kind in ("omega", "alpha")]
    return tuple(symbols) or tuple(_led(scene))


def _led(scene: Mechanism) -> Iterator[Symbol]:
    """The rates of the links that follow the drivers, if they are not given, and the motion of the last point."""
    drivers = {d.key.partition("/")[0] for d in scene.drivers}
    led = [link for link in scene.links if link.name not in drivers]
    sliding = {pair.a for pair in scene.slidings}
    unsteady = any(d.values[2] for d in scene.drivers)
    for link in led:
        if link.name not in sliding:
            yield Symbol("omega", link=link.name)
            if unsteady or scene.law_of(link.name) is not None:
                yield Symbol("alpha", link=link.name)
    for link in reversed(led or scene.links):
        moving = [p for p in (link.bar or link.points) if p not in scene.frame.points]
        if moving:
            yield from (Symbol.parse(f"{kind}_{moving[-1]}") for kind in ("v", "a"))
            return


def _of_larger_groups(scene: Mechanism, asked: Sequence[Symbol]) -> Iterator[Symbol]:
    """Further questions on larger groups: the motion of the points that they find, the rates of their links."""
    known = set(scene.frame.points)
    for group in analyse(scene).elements:
        links = [scene.by_name[name] for name in group.members if name in scene.by_name]
        if isinstance(group, LargerGroup):
            points = dict.fromkeys(p for link in links for p in link.points if p not in known)
            names = [f"{k}_{p}" for k in "va" for p in points]
            names += [f"{kind}_{link.name}" for kind in ("omega", "alpha") for link in links]
            yield from (s for s in map(Symbol.parse, names) if s not in asked)
        known |= {p for link in links for p in link.points}


def examined(
    source: Tables, base: Tables | None, name: str, strict: bool = True, bounds: Bounds = LEVELS["usual"],
    fewest: int = 0,
) -> Variant:
    """A variant from the mapping of a scene file, if it makes a good problem.

    Parameters
    ----------
    source : the scene file
    base : if the driver's value was changed, the file with its old value, from which the assembly is followed
    strict : refuse a variant that cannot be drawn well; else note it in the remarks
    bounds : the least crossing angle of lines, and the greatest error of an answer by pencil
    fewest : ask only for quantities that a pencil drawing gives well, at least this many, if the scene has no
        questions; 0: for all

    Raises
    ------
    Unfit : it does not assemble here, or (strict) lines cross too flat, a reading is under 10 mm, or a pencil drawing
        can miss an answer by too much
    """
    try:
        made = _moved(source, base) if base is not None else dict(source)
        made["find"] = [str(s) for s in asked_of(mechanism_of(made))]
        scene = standing(mechanism_of(made))
        motion = solve(scene)
        if motion.status[0] != "ok":
            raise Unfit(motion.said(0))
        remarks: list[Wording] = [*_flat(motion, bounds), *_uncut(scene)]
        if remarks and strict:
            raise Unfit(remarks[0])
        asked = asked_of(scene)
        chosen = strict and fewest > 0 and not source.get("find")
        if chosen:
            asked = (*asked, *_of_larger_groups(scene, asked))
        planned = paper_plan(scene, None, asked, share=False)
        sheet = execute(planned)
        there = {reading.symbol for reading in read_off(sheet)}
        each = tuple(symbol for s in asked for symbol in s.both if not symbol.plus or symbol in there)
        answers = tuple(_answers(scene, motion, sheet, each))
        idle = {s for s, value in answers if not value and s.scope == "force"}  # what a mechanism never loads
        remarks += _remarks(sheet, () if chosen else tuple(s for s in asked if s not in idle), bounds.crossing)
        if remarks and strict:
            raise Unfit(remarks[0])
    except Unsolvable as error:
        status = Phrase(f"status {error.status}")
        raise Unfit(Phrase("status and why", status=status, why=error.reason)) from None
    except GraphkinError as error:
        raise Unfit(error.problems[0].sentence, error.exit_code) from None
    except ArithmeticError as error:
        raise Unfit(Phrase("unfit out of range", error=from_others(error))) from None
    if strict:  # what errors do together only adds to it
        unread = {s for s, _ in answers if any(_unread(sheet, (s,)))} if chosen else idle
        read = tuple((s, value) for s, value in answers if (value or not chosen) and s not in unread)  # what moves
        if not read and not idle:
            raise Unfit(next(_unread(sheet, asked), Phrase("unfit nothing moves")))
        most = {s: bounds.tolerance * abs(value) for s, value in read}
        spare = max(0, len(read) - fewest) if chosen else 0
        errors = predict(planned, "pencil", scene.question.sheet.tools, together=False, most=most, spare=spare)
        first = {s: u.bound for s, u in errors.items()}
        if chosen:
            usual = asked_of(scene)
            asked = _within_reach(read, first, bounds.tolerance, fewest)
            asked = usual if set(usual) <= set(asked) else asked[:MOST_ASKED]
            read = answers = tuple(answer for answer in answers if answer[0] in asked)
            made["find"] = [str(s) for s in asked]
        for symbol, value in read:
            if why := _missed(symbol, value, first.get(symbol, 0.0), bounds.tolerance):
                raise Unfit(why)
    predicted = predict(planned, "pencil", scene.question.sheet.tools)
    bounded = []
    for symbol, value in answers:
        bound = predicted[symbol].bound if symbol in predicted else 0.0
        unit = symbol.unit(scene.units)
        why = None if symbol in idle else _missed(symbol, value, bound, bounds.tolerance)
        if why:
            if strict or not math.isfinite(bound):
                raise Unfit(why)
            remarks.append(why)
        bounded.append(Answer(str(symbol), float(f"{unit.of(value):.12g}"), float(f"{unit.of(bound):.6g}"), unit.text))
    return Variant(name, made, tuple(bounded), tuple(remarks))


def _missed(symbol: Symbol, value: float, bound: float, tolerance: float) -> Phrase | None:
    """The reason against an answer whose error by pencil may exceed the allowed part of it; None for others."""
    if not math.isfinite(bound):
        return Phrase("unfit near dead point", symbol=str(symbol))
    if bound > tolerance * abs(value):
        return Phrase("unfit missed", symbol=str(symbol), percent=f"{100 * tolerance:.2g}")
    return None


def _within_reach(
    answers: Sequence[tuple[Symbol, float]], bounds: Mapping[Symbol, float], tolerance: float, fewest: int
) -> tuple[Symbol, ...]:
    """The quantities that a pencil gives well, if they are at least ``fewest``, else all."""
    kept = tuple(s for s, value in answers if bounds.get(s, 0.0) <= AMPLE * tolerance * abs(value))
    return kept if len(kept) >= fewest else tuple(s for s, _ in answers)


def _moved(source: Tables, base: Tables) -> OwnTables:
    """The file with its driver's value reached from that of ``base``, and a sketch that gives this assembly."""
    start, goal = standing(mechanism_of(base)), standing(mechanism_of(source))
    motion = solve(start, {d.key: d.values[0] for d in goal.drivers})
    if motion.status[0] != "ok":
        raise Unfit(motion.said(0))
    made = copy.deepcopy(dict(source))
    made["sketch"] = {}
    step = round_step(start.size / start.units.metres)
    for point, names in start.holders.items():
        if start.frame.name not in names:
            z = complex(motion.position(point)[0]) / start.units.metres
            made["sketch"][point] = [float(f"{round(c / step) * step:.12g}") for c in (z.real, z.imag)]
    return made


def _flat(motion: Motion, bounds: Bounds) -> Iterator[Phrase]:
    """The groups of two links with a transmission angle below the allowed one."""
    structure = motion.structure
    for dyad in structure.elements:
        if not isinstance(dyad, Dyad) or (not bounds.transmission and bounds.pressure >= math.pi / 2):
            continue
        angle = float(motion.value(Symbol("transmission", name=dyad.label))[0])
        if dyad.kind == "RRR" and angle < bounds.transmission:
            yield Phrase("unfit transmission", group=dyad.named, degrees=f"{math.degrees(angle):.0f}")
        if dyad.kind != "RRR" and math.pi / 2 - angle > bounds.pressure:
            yield Phrase("unfit pressure", group=dyad.named, degrees=f"{90 - math.degrees(angle):.0f}")


def _uncut(scene: Mechanism) -> Iterator[Phrase]:
    """The cams whose profile turns back on itself."""
    for cam in scene.cams:
        for stretch in study_cam(cam).undercut:
            begin, last = (f"{math.degrees(angle):.0f}" for angle in stretch)
            key = "unfit profile" if begin != last else "unfit corner of profile"
            yield Phrase(key, link=cam.link, begin=begin, end=last)


def _remarks(sheet: Sheet, asked: tuple[Symbol, ...], crossing: float) -> Iterator[Phrase]:
    """Remarks on difficulties in drawing or reading a sheet."""
    for equation in sheet.equations:
        rays = [s for step in sheet.steps if step.equation == equation.number for s in step.strokes]
        lines = [r for r in rays if isinstance(r, Ray)]
        for line, two in pairwise(lines):
            angle = math.asin(min(1.0, abs(cross(line.along, two.along))))
            if angle < crossing:
                yield Phrase("unfit crossing", degrees=f"{math.degrees(angle):.0f}")
    yield from _unread(sheet, asked)


def _unread(sheet: Sheet, asked: tuple[Symbol, ...]) -> Iterator[Phrase]:
    """The asked quantities that cannot be read well on a sheet."""
    readings = {r.symbol: r for r in read_off(sheet, asked)}
    for symbol in asked:
        if symbol not in readings:
            yield Phrase("unfit not drawn", symbol=str(symbol))
        elif (mm := readings[symbol].on_paper) is not None and mm < LEAST_READING:
            turning = not symbol.is_vector and symbol.scope == "motion"
            rates = sheet.rates[symbol.kind] if turning else {}
            # not of a rate that is given or shared
            if not turning or (symbol.link in rates and rates[symbol.link].vector is not None):
                yield Phrase("unfit short", symbol=str(symbol), mm=f"{mm:.1f}")


def _answers(
    scene: Mechanism, motion: Motion, sheet: Sheet, asked: tuple[Symbol, ...]
) -> Iterator[tuple[Symbol, float]]:
    """The exact answers; the drawing must agree with each of them."""
    drawn = {r.symbol: r.value for r in read_off(sheet, asked)}
    values = {symbol: complex(value) for symbol, value in exact_values(motion, asked).items()}
    for symbol, value in values.items():
        least = NOTHING * max(abs(other) for s, other in values.items() if s.measure == symbol.measure)
        if symbol in drawn and abs(drawn[symbol] - value) > max(1e-6 * abs(value), least, 1e-15):
            raise Disagreement.of(str(symbol), "the drawing and the solver disagree")
        yield symbol, 0.0 if abs(value) < least else abs(value) if symbol.is_vector else value.real


# a set of them

Render = Callable[[Variant], Mapping[str, bytes]]
Papers = Callable[[], tuple[Variant, Mapping[str, bytes]]]
"""Waits for the files of a variant."""


@dataclass(frozen=True)
class Job:
    """A variant to make: drawn from a seed within a range, or from a row of given data.

    ``source`` is the scene file to vary, or the file of the row; ``base`` the row's file with the driver's old value;
    ``trouble`` are the problems of a row.
    """

    name: str
    number: int
    source: Tables
    spread: Spread | None = None
    seed: int = 0
    base: Tables | None = None
    trouble: Wording = ""


def work(job: Job, attempt: int) -> Variant:
    """The first good variant of a job from an attempt on; it depends on its arguments alone, so it runs anywhere.

    Only the time after which it is given up depends on the machine.
    """
    if job.spread is None:
        return _row(job)
    refusals: list[Wording] = []
    begun = time.process_time()
    large = bool(analyse(mechanism_of(job.source)).larger_groups)
    lone: Variant | None = None  # of which a pencil finds one quantity
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
            made = replace(examined(source, was, job.name, bounds=bounds, fewest=fewest), attempt=k)
            if not large or len(made.answers) > 1 or source.get("find"):
                return made
            lone = lone or made
        except Exception as error:  # whatever goes wrong with one must not take the others along
            refusals.append(_reason(error))
    if lone is not None:
        return lone
    if not refusals:
        return Variant(job.name, why=Phrase("unfit all alike"))
    why, times = Counter(refusals).most_common(1)[0]
    return Variant(job.name, why=Phrase("unfit all", count=len(refusals), why=why, times=times))


def _row(job: Job) -> Variant:
    """A variant of a row of data as it is; difficulties in drawing it are remarks."""
    failed = Variant(job.name, why=job.trouble, exit_code=GraphkinError.exit_code)
    for base in (job.base, None) if job.base is not None else (None,):
        if job.trouble:
            break
        try:
            return examined(_named(job.source, job.name), base, job.name, strict=False)
        except Exception as error:
            failed = failed.failed(error)
    return failed


def _named(source: Tables, name: str) -> OwnTables:
    title, zh = (_DATA.sub("", str(source.get(key, ""))) for key in ("title", "title_zh"))
    named = {"title": f"{title} (no. {name})"[:300], **({"title_zh": f"{zh}（第 {name} 题）"[:300]} if zh else {})}
    # where it comes from, published values and scales belong to the problem as it was
    left_out = ("printed", "source", "source_zh", "title", "title_zh", "sheet", "vary")
    kept = {k: v for k, v in source.items() if k not in left_out}
    level = (source.get("vary") or {}).get("level")
    if level:  # it says what a sheet gives, too
        kept["vary"] = {"level": level}
    sheet = {k: v for k, v in source.get("sheet", {}).items() if not k.endswith("_scale")}
    return {**named, **kept, **({"sheet": sheet} if sheet else {})}


def _where_it_was(source: Tables, original: Tables) -> OwnTables:
    """The file with the drivers' values of the original, for which its sketch holds."""
    made = copy.deepcopy(dict(source))
    for path, kind in varied_keys(original):
        if kind in ("angle", "travel", "moment") or (path[0] == "driver" and "law" in path):
            put_at(made, path, value_at(original, path))
    return made


def distinct(answers: Sequence[Answer], others: Iterable[Sequence[Answer]]) -> bool:
    """Whether for every other variant some answer differs by more than both tolerances."""
    for other in others:
        known = {a.symbol: a for a in other}
        shared = [(a, known[a.symbol]) for a in answers if a.symbol in known]
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
    finish: Callable[[Sequence[Variant]], None] | None = None,
) -> tuple[Variant, ...]:
    """Make every variant of a set, in order, each different in its answers from those before.

    Parameters
    ----------
    folder : the folder of finished variants, so that an interrupted set is continued
    keep : called with each variant in order, and with its rendered files; gives the names of the files it wrote
    render : called by the workers for each variant accepted; gives files by name
    progress : called with the number of finished variants and of all
    finish : called with the whole set, before its checkpoints are removed

    A variant whose papers cannot be made or written is a failure, and the next call tries it again.
    """
    made: list[Variant] = []
    called, given = (render.func, render.args) if isinstance(render, partial) else (render, ())
    papers = repr(called) if is_dataclass(called) else getattr(called, "__qualname__", "")  # others are another set
    # jobs drawn from one seed share their scene: only the first is written out
    drawn = (asdict(job) if job.spread is None or job.number == 1 else (job.name, job.number) for job in jobs)
    whole = ATTEMPTS, papers, given, *drawn
    points = Checkpoints.of(folder, "set", key_of(*whole)) if folder is not None and jobs else None
    done = {} if points is None else _finished(points)
    if points is not None:
        points.open(variants=len(jobs))
    refused: list[Job] = []  # by who makes or keeps the papers

    def settle(job: Job, variant: Variant, papers: Papers | None) -> None:
        files: tuple[str, ...] = ()
        if papers is not None:
            variant, rendered = papers()
            try:
                files = tuple(keep(variant, rendered)) if keep is not None and not variant.why else ()
            except Exception as error:
                variant = variant.failed(error)
        if papers is not None and variant.why:
            refused.append(job)
        elif points is not None and job.number not in done:
            words = {"remarks": [*map(as_data, variant.remarks)], "why": as_data(variant.why)}
            points.save(job.number, {**asdict(variant), **words, "files": files})
        made.append(variant)
        if progress is not None:
            progress(len(made), len(jobs))

    waiting: deque[tuple[Job, Variant, Papers | None]] = deque()
    for job, variant in accepted(jobs, done, workers):
        new = not variant.why and job.number not in done
        waiting.append((job, variant, workers.start(_rendered, render, variant) if new else None))
        while len(waiting) > (workers.ahead if render is not None else 0):
            settle(*waiting.popleft())
    for rendering in waiting:
        settle(*rendering)
    if finish is not None:
        finish(made)
    if points is not None and not refused:
        points.close()
    return tuple(made)


def accepted(jobs: Iterable[Job], done: Mapping[int, Variant], workers: Workers) -> Iterator[tuple[Job, Variant]]:
    """The result of each job, in order; variants drawn from a seed differ from all before them."""
    taken: list[tuple[Answer, ...]] = []
    refused: Variant | None = None
    queue: deque[tuple[Job, Callable[[], Variant] | None]] = deque()
    left = iter(jobs)
    while True:
        # nothing is begun beside the first before it has shown that the scene can vary
        for job in islice(left, (1 + workers.ahead if taken or refused else 1) - len(queue)):
            queue.append((job, None if job.number in done or refused else workers.start(work, job, 0)))
        if not queue:
            return
        job, started = queue.popleft()
        if refused is not None:
            yield job, replace(refused, name=job.name)
            continue
        variant = done[job.number] if started is None else started()
        if variant.why and job.spread is not None and not taken:
            refused = variant  # what no attempt at the first one makes a good problem, none at the others will
        drawn = started is not None and job.spread is not None
        while drawn and not variant.why and not distinct(variant.answers, taken):
            variant = workers.start(work, job, variant.attempt + 1)()
        if not variant.why:
            taken.append(variant.answers)
        yield job, variant


def _finished(points: Checkpoints) -> dict[int, Variant]:
    """Finished jobs by number, if their files are complete."""
    variants: dict[int, Variant] = {}
    for number, piece in points.done()[0].items():
        facts = dict(piece.facts)
        if all((points.place.parent / name).is_file() for name in facts.pop("files")):
            answers, remarks = (Answer(**known) for known in facts["answers"]), map(from_data, facts["remarks"])
            read = {"answers": tuple(answers), "remarks": tuple(remarks), "why": from_data(facts["why"])}
            variants[number] = Variant(**{**facts, **read})
    return variants


def _rendered(render: Render | None, variant: Variant) -> tuple[Variant, Mapping[str, bytes]]:
    """A variant with its papers by name, or failed, with the reason."""
    try:
        return variant, render(variant) if render is not None else {}
    except Exception as error:  # whatever goes wrong with one must not take the others along
        return variant.failed(error), {}


def _reason(error: Exception) -> Wording:
    """The reason of a failure; for an unforeseen error a line with its kind."""
    if isinstance(error, Unfit):
        return error.why
    if isinstance(error, GraphkinError) and error.problems:
        return error.problems[0].sentence
    return f"{type(error).__name__}: {(str(error).splitlines() or [''])[0][:300]}"
