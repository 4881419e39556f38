"""A group larger than a dyad placed on paper by trial positions.

A part of the group is left out, and a link of it is moved in steps; its free end describes a curve, which the arc or
the line of the left-out part cuts at the wanted place.  The gap between the two nearest trials is divided
proportionally, until the left-out part fits.

With one trial value the gap changes its sense between two neighbouring trials, and is divided between them; the new
trial replaces that with a gap of its sense (regula falsi).  With several, the gaps of one trial more than there are
values are taken as linear; the position so found replaces the trial with the largest gap (Hain, Applied Kinematics;
Ortega and Rheinboldt, Iterative solution of nonlinear equations in several variables: the sequential secant method).

At the scene's own position the gaps of trial drawings are closed over the whole range of a trial driver, or on a grid
of several.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from itertools import chain, pairwise, product

import numpy as np

from graphkin.construction.board.instruments import EXACT
from graphkin.construction.board.proportional_division import divide, shares
from graphkin.construction.board.steps import (
    Bar,
    CompassArc,
    Curve,
    MeasuredGap,
    Step,
    Stroke,
    TrialPositions,
    TrialRow,
)
from graphkin.construction.position.links_on_paper import PlacedLinks, Steps, drive, meet, stuck, walk
from graphkin.construction.position.reduced_mechanism import ReducedMechanism, TrialDrawing, best_first, fitted
from graphkin.errors import Unsolvable
from graphkin.plane import Pose, Poses
from graphkin.scene.model import Driver
from graphkin.scene.symbol import Symbol
from graphkin.structure import Driven, Dyad
from graphkin.words import links_named

POINTS = 7  # trial positions drawn
BETWEEN = 6  # parts into which the curve between two of them is divided
AWAY = 0.35  # of the trial driver (rad, or the mechanism's size): how far the first trial is from the last
AGAIN = 2  # times that a trial drawing is drawn which does not close by hands that err
SHORTEST = 1.0 / 16  # part of the way by which links known already are moved to where hands put them, at least
BEFORE = 0.45  # part of the trial positions that lie before the place sought; so that none falls on it
DIVISIONS, UNSEEN = 4, 0.02  # divisions at most, until so little (mm, degrees) is missed
CHANGE = 1e-6  # of a trial value, to see how the gaps change at the last trial
STEP = 0.06  # from trial to trial of several drivers (rad, or the mechanism's size), as many parts of it before
GRID = 360  # trial values looked at over a turn
MOST_IMPROVED = 200  # trial drawings on a grid of several trial drivers, those with the smallest gaps
COARSE = 12  # values of each of several trial drivers
Branch = tuple[int, ...]  # which assembly each dyad of a reduced mechanism takes, in the order of drawing
LEAST = 1e-3  # of the largest singular value: trials that tell less about one of what is moved are not divided


def place_by_trial(paper: PlacedLinks, reduced: ReducedMechanism, poses: Poses) -> None:
    """Place a group among the known links, at final poses of all links with the mechanism of size 1.

    If errors of the hand bring a trial drawing to a dead point it is drawn again, with another part left out.

    Raises
    ------
    Unsolvable : "not assembled": the left-out part fits nowhere near
    """
    size = paper.mm * reduced.structure.scene.size
    guess = {name: pose.scaled(size) for name, pose in poses.items()}
    if paper.instrument.faultless:
        paper.poses.update(_fit(paper, reduced, guess))
        return

    there = {name: guess.get(name, pose) for name, pose in paper.poses.items()}
    known = replace(paper, instrument=EXACT, poses=there, pricked={})
    # rolling links have their given places in their own reduced mechanism only
    others = () if reduced.starts else best_first(reduced.structure, reduced.group, known, guess)
    stops: list[Unsolvable] = []
    for tried in chain([reduced], others):
        for _ in range(AGAIN):
            try:
                _placed_by_hand(paper, tried, guess)
            except Unsolvable as stop:
                stops.append(stop)
            else:
                return
    raise stops[0]


def trial_steps(paper: PlacedLinks, so_far: PlacedLinks, reduced: ReducedMechanism) -> Steps:
    """The steps that place a group: the trial curve with the line or arc that it must meet, then each part of the group
    in its place."""
    poses = {**so_far.poses, **{n: paper.poses[n] for n in reduced.group.members}}
    values = np.array(reduced.values(poses, paper.mm))
    steps: list[Step] = []
    for driver in reduced.starts:
        if driver.turns:
            axis = cmath.phase(paper.poses[driver.link].axis)
            steps.append(Step("lay off", "rolling", link=driver.link, value=axis))
        else:
            steps.append(Step("lay off", "rolling", pairs=(driver.key,), mm=driver.values[0] * paper.mm))
    if reduced.trial:
        steps.append(_trial_positions(so_far, reduced, poses, values))
    board = replace(reduced.opened(so_far, values.tolist()), instrument=EXACT)
    for element in reduced.elements:
        if isinstance(element, Driven):
            pose, laid = drive(board, element)
            axis = cmath.phase(pose.axis)  # found by trial, whatever it was tried against
            steps.append(replace(laid, value=axis, base="") if laid.reason == "angle" else laid)
        else:
            intersection = meet(board, element)
            best = intersection.nearest(poses)
            steps += intersection.steps(best) if best is not None else ()
        board.poses.update({name: poses[name] for name in element.members})
    return tuple(steps)


def _fit(paper: PlacedLinks, reduced: ReducedMechanism, guess: Poses) -> dict[str, Pose]:
    """The group by exact hands among links near their guessed places; these are moved there in steps if it does not
    close at once."""
    known = replace(paper, instrument=EXACT)
    there = replace(known, poses={name: guess.get(name, known.poses[name]) for name in known.poses}, pricked={})
    exact = {p: there.point(n, p) for n in there.poses for p in known.links[n].points if p in known.pricked}

    def near(part: float, expected: Poses, _: Poses) -> Poses | None:
        there.pricked = {p: z + part * (known.pricked[p] - z) for p, z in exact.items()}
        there.poses = {n: _between(guess.get(n, pose), pose, part) for n, pose in known.poses.items()}
        fit = fitted(reduced, known if part == 1.0 else there, expected)
        return None if fit is None else {**fit, **there.poses}

    start = {**{name: guess[name] for name in reduced.group.members}, **there.poses}
    *_, (part, fit_poses) = (0.0, start), *walk(near, start, 0.0, 1.0, 1.0, SHORTEST)
    if part < 1.0:
        raise stuck("not assembled", reduced.group.named, "no trial position closes this group here")
    return {name: pose for name, pose in fit_poses.items() if name in reduced.group.members}


def _between(start: Pose, end: Pose, part: float) -> Pose:
    """A pose between two: place and axis divided in one proportion, ``part`` of the way from the first."""
    axis = start.axis + part * (end.axis - start.axis)
    return Pose(start.origin + part * (end.origin - start.origin), axis / abs(axis))


def _placed_by_hand(paper: PlacedLinks, reduced: ReducedMechanism, guess: Poses) -> None:
    """The last trial by erring hands, its gaps as they find and read them, and the drawing that follows from these by
    their change with the trial values."""
    poses = {**paper.poses, **_fit(paper, reduced, guess)}
    values = np.array(reduced.values(poses, paper.mm))

    def drawn(at: np.ndarray, refusal: str) -> TrialDrawing:
        drawing = TrialDrawing.of(reduced, paper, poses, at)
        if drawing is None:
            raise stuck("not assembled", reduced.group.named, refusal)
        return drawing

    if reduced.trial:
        trial = drawn(values, "a trial drawing does not close")
        size = paper.mm * reduced.structure.scene.size
        gaps = [
            gap if constraint.is_angle else paper.instrument.read(gap * size) / size
            for gap, constraint in zip(trial.gaps, reduced.removed, strict=True)
        ]
        exact = replace(paper, instrument=EXACT, pricked={})
        slopes = []
        for change in CHANGE * np.eye(len(values)):
            low, high = (TrialDrawing.of(reduced, exact, poses, values + sign * change) for sign in (-1, 1))
            if low is None or high is None:
                raise stuck("dead point", links_named(reduced.group.links), "the trial drawing is at a dead point")
            slopes.append((high.gaps - low.gaps) / (2 * CHANGE))
        values = values - np.linalg.solve(np.array(slopes).T, np.array(gaps))
    last = drawn(values, "the last trial drawing does not close")
    paper.pricked.update(last.drawn.pricked)
    paper.poses.update(reduced.put_back(last.drawn))
    paper.settle([r.left_out for r in reduced.removed if r.left_out])


# what is drawn and measured in trial positions


def _trial_positions(known: PlacedLinks, reduced: ReducedMechanism, poses: Poses, values: np.ndarray) -> Step:
    """The step of the trial positions of a group with these final poses and values."""
    tried, alone = _trial_drawings(known, reduced, poses, values), len(values) == 1
    point, strokes = _curve(known, reduced, poses, [trial.drawn for trial in tried]) if alone else ("", ())
    rolling = tuple(r.name for r in reduced.removed if r.rolling is not None)
    angles = [d for d in reduced.structure.scene.drivers if d.turns]
    instead = tuple(
        (r.left_out, r.other_side, r.turned) for r in reduced.removed
        if r.left_out and r.slides and any(r.left_out in d.links for d in angles)
    )
    driven, left_out = tuple(d.key for d in reduced.trial), tuple(r.name for r in reduced.removed if r.rolling is None)
    group = reduced.group
    positions = TrialPositions(
        "trial", "positions", strokes=strokes, links=group.links, group=group.named, driven=driven, left_out=left_out,
        point=point, count=POINTS, rolling=rolling, instead=instead,
    )
    return _measured(positions, known, reduced, poses, tried[:: BETWEEN if alone else 1]) if tried else positions


def _trial_drawings(
    known: PlacedLinks, reduced: ReducedMechanism, poses: Poses, values: np.ndarray
) -> list[TrialDrawing]:
    """Drawings at trial values about the place sought: of one trial driver on either side of it, of several each
    further one with another of them changed; so near that all can be drawn, none where even the nearest cannot."""
    exact, count, last = replace(known, instrument=EXACT), len(values), (POINTS - 1) * BETWEEN
    if count == 1:
        away, steps = AWAY, np.arange(last + 1)[:, None] / last - BEFORE
    else:
        away, steps = STEP, np.vstack([np.zeros(count), np.eye(count)]) - BEFORE
    for _ in range(6):
        drawings: dict[int, TrialDrawing] = {}
        for i in sorted(range(len(steps)), key=lambda i: float(np.abs(steps[i]).max())):
            beside = next((drawings[j].drawn.poses for j in (i - 1, i + 1) if count == 1 and j in drawings), poses)
            drawing = TrialDrawing.of(reduced, exact, beside, values + away * steps[i])
            if drawing is None:
                break
            drawings[i] = drawing
        else:
            return [drawings[i] for i in range(len(steps))]
        away /= 2.0
    return []


def _curve(
    known: PlacedLinks, reduced: ReducedMechanism, poses: Poses, tried: Sequence[PlacedLinks]
) -> tuple[str, tuple[Stroke, ...]]:
    """The free end in some trial positions, and the arc or the line that it must meet; none where an angle or a driver
    is left out."""
    removed = reduced.removed[0]
    if not removed.ends or not tried:
        return "", ()
    ends = removed.ends
    if removed.kind == "bar" and ends[0][1] not in reduced.group.members:
        ends = ends[::-1]  # the free end is the one that moves
    (point, link), base = ends[0], removed.other_side if removed.slides else ""

    def at(lying: Poses, point: str, link: str) -> complex:
        return lying[link].place(known.links[link].points[point] * known.mm)

    def seen(lying: Poses) -> complex:
        """The free end seen from its counterpart: from the bar's other end, or from the link with the guide."""
        if base:
            return poses[base].place(lying[base].local(at(lying, point, link)))
        return at(lying, point, link) - at(lying, *ends[1]) + at(poses, *ends[1])

    places, free = tuple(seen(drawn.poses) for drawn in tried), at(poses, point, link)
    goal: Stroke
    if base:
        size = max((abs(z) for each in known.links.values() for z in each.points.values()), default=0.0)
        reach = removed.along(poses) * 0.2 * known.mm * size
        goal = Bar(free - reach, free + reach, "")
    else:
        goal = CompassArc(at(poses, *ends[1]), abs(free - at(poses, *ends[1])), free)
    return point, (Curve(places, places[::BETWEEN], point), goal)


def _measured(
    positions: TrialPositions, known: PlacedLinks, reduced: ReducedMechanism, poses: Poses,
    tried: Sequence[TrialDrawing],
) -> TrialPositions:
    """Trial positions with their gaps, and the divisions of these (rad, m), drawn near the final poses of the links."""
    size = reduced.structure.scene.size
    exact = replace(known, instrument=EXACT)
    moved = [_moved(known, reduced, driver) for driver in reduced.trial]

    def row(trial: TrialDrawing) -> TrialRow:
        values = (v + ahead if symbol.measure.is_angle else v * size
                  for v, (symbol, ahead) in zip(trial.at, moved, strict=True))
        misses = (gap if r.is_angle else gap * size for gap, r in zip(trial.gaps, reduced.removed, strict=True))
        return tuple(map(float, values)), tuple(map(float, misses))

    trials, before, alone, left = tuple(map(row, tried)), 0, len(moved) == 1, [*tried]
    if alone:
        over = [i for i, (first, second) in enumerate(pairwise(tried)) if first.gaps[0] * second.gaps[0] < 0.0]
        sides = min(over, key=lambda i: abs(i + 0.5 - BEFORE * (len(tried) - 1)), default=None)
        before = (sides or 0) + 1
        left = [] if sides is None else left[sides : sides + 2]
    parts: tuple[float, ...] = ()
    divided: list[TrialRow] = []
    replaced: list[int] = []
    while left and len(divided) < DIVISIONS:
        gaps = [trial.gaps for trial in left]
        sizes = np.linalg.svd(np.array([gap - gaps[0] for gap in gaps[1:]]), compute_uv=False)
        if sizes[-1] <= LEAST * sizes[0] or not sizes[0]:
            break
        nearer = TrialDrawing.of(reduced, exact, poses, divide([trial.at for trial in left], gaps))
        if nearer is None:
            break
        parts = parts or tuple(map(float, shares(gaps)))
        divided.append(row(nearer))
        least = (math.radians(UNSEEN) if r.is_angle else UNSEEN / known.mm for r in reduced.removed)
        if all(abs(miss) < unseen for miss, unseen in zip(divided[-1][1], least, strict=True)):
            break
        same_sense = nearer.gaps[0] * gaps[1][0] >= 0.0
        gone = int(same_sense) if alone else int(np.argmax([np.abs(gap).max() for gap in gaps]))
        left[gone] = nearer
        replaced.append(gone + 1)
    missed = []
    for r in reduced.removed:
        length, names = 0.0, tuple[str, ...]((r.name,))
        if r.driver is not None and r.driver.turns:
            names = r.driver.links[::-1]
        elif r.kind in ("bar", "guide"):
            names = (*(point for point, _ in r.ends), *(slide.key for slide in r.slides))
        if r.kind == "bar":
            first, second = (reduced.structure.links[r.left_out].points[point] for point in names)
            length = abs(second - first)
        missed.append(MeasuredGap(r.kind, names, length, r.is_angle))
    return replace(
        positions, moved=tuple(symbol for symbol, _ in moved), missed=tuple(missed), trials=trials,
        divided=tuple(divided), before=before, parts=() if alone else parts, replaced=() if alone else tuple(replaced),
    )


def _moved(known: PlacedLinks, reduced: ReducedMechanism, driver: Driver) -> tuple[Symbol, float]:
    """The quantity that a trial driver moves, and the lead of its angle (rad) where it counts from the x axis."""
    base, ground = driver.relative_to, reduced.structure.scene.frame.name
    if not driver.turns:
        return Symbol.parse(f"s_{driver.key}"), 0.0
    lead = 0.0
    if (block := reduced.structure.blocks.get(base)) is not None:  # it turns as the link with its guide
        base, lead = block.b, cmath.phase(block.guide.direction)
    if base in known.poses:  # a link that stands already: its angle is taken to the x axis
        return Symbol("theta", link=driver.link), lead + cmath.phase(known.poses[base].axis)
    return Symbol("theta", link=driver.link, other="" if base == ground else base), lead


# where the gaps of trial drawings close


def all_fits(reduced: ReducedMechanism, known: PlacedLinks) -> Iterator[dict[str, Pose]]:
    """Every position of the trial drivers and every assembly of the trial dyads at which the left-out part fits."""
    spans = [_span(driver) for driver in reduced.trial]
    if len(spans) == 1:
        yield from fits_between(reduced, known, *spans[0])
        return
    # of several drivers each place of a grid is improved
    axes = [[start + (end - start) * (n + 0.5) / COARSE for n in range(COARSE)] for start, end in spans]
    trials = [(max(map(abs, gaps)), values, branches)
              for values in product(*axes) for branches, gaps in _gaps(reduced, known, values).items()]
    for _, values, branches in sorted(trials, key=lambda trial: trial[0])[:MOST_IMPROVED]:
        paper = _drawn(reduced, known, values, branches)
        if paper is None:
            continue
        near = fitted(reduced, known, paper.poses, values)
        if near is not None:
            yield near


def _span(driver: Driver) -> tuple[float, float]:
    """The range of a trial driver: a turn, or four sizes of the mechanism."""
    return (-math.pi, math.pi) if driver.turns else (-2.0, 2.0)


def fits_between(
    reduced: ReducedMechanism, known: PlacedLinks, start: float, end: float
) -> Iterator[dict[str, Pose]]:
    """The positions between two values of a single trial driver in which the left-out part fits."""
    low, high = _span(reduced.trial[0])
    parts = max(1, round(GRID * (end - start) / (high - low)))
    grid = [start + (end - start) * i / parts for i in range(parts + 1)]
    # a value is drawn once for all assemblies: where one cannot be drawn on, others often cannot either
    drawn_at = cache(lambda value: _gaps(reduced, known, (value,)))
    for branches in product((0, 1), repeat=sum(isinstance(e, Dyad) for e in reduced.elements)):

        def gap(value: float, branches: Branch = branches) -> float:
            return drawn_at(value).get(branches, (math.nan,))[0]

        for first, second in pairwise((value, gap(value)) for value in grid):
            closed = _closed_between(gap, first, second)
            paper = None if closed is None else _drawn(reduced, known, (closed,), branches)
            if paper is not None and abs(reduced.gaps(paper)[0]) < 1e-9:
                yield reduced.put_back(paper)


def _closed_between(
    gap: Callable[[float], float], first: tuple[float, float], second: tuple[float, float]
) -> float | None:
    """The trial value at which a gap closes between two values with their gaps, nan for those that cannot be drawn;
    None where it does not close."""
    from graphkin.search import last_true, zero_between

    (a, fa), (b, fb) = (second, first) if math.isnan(first[1]) else (first, second)
    if math.isnan(fb) and not math.isnan(fa):  # up to the last that can be drawn
        b = last_true(lambda values: np.array([not math.isnan(gap(float(value))) for value in values]), a, b, 2)
        fb = gap(b)
    # nan compares false; a gap that leaps has passed half a turn, not zero
    if not fa * fb <= 0.0 or abs(fa - fb) > 1.0:
        return None
    return zero_between(gap, a, b)


def _gaps(reduced: ReducedMechanism, known: PlacedLinks, values: Sequence[float]) -> dict[Branch, list[float]]:
    """The gaps in every assembly of the trial dyads at some values, without those that cannot be drawn; a dyad is drawn
    once for all assemblies of later ones."""
    papers = each_assembly(reduced.opened(known, values), reduced.elements)
    return {branches: reduced.gaps(paper) for branches, paper in papers}


def each_assembly(
    paper: PlacedLinks, elements: Sequence[Driven | Dyad], branches: Branch = ()
) -> Iterator[tuple[Branch, PlacedLinks]]:
    """Every assembly of some dyads that can be drawn, with the links in it on the same paper."""
    if not elements:
        yield branches, paper
        return
    element, *left = elements
    if isinstance(element, Driven):
        paper.poses[element.link], _ = drive(paper, element)
        yield from each_assembly(paper, left, branches)
        return
    for branch, poses in enumerate(meet(paper, element).poses):
        paper.poses.update(poses)
        yield from each_assembly(paper, left, (*branches, branch))


def _drawn(
    reduced: ReducedMechanism, known: PlacedLinks, values: Sequence[float], branches: Branch
) -> PlacedLinks | None:
    """A trial drawing of the group; None where two loci do not meet."""
    papers = each_assembly(reduced.opened(known, values), reduced.elements)
    return next((paper for drawn, paper in papers if drawn == branches), None)
