"""The mechanism on paper: every link placed by compass and ruler, in the order of solution, and the assembly: the
scene's own position by its data, others followed from it.

Larger groups are found by trial drawings: from one position of the driver to the next the trial starts where the last
one ended.  At the scene's own position they begin at values of the problem's sketch, or all places are found at which a
group closes.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import combinations

from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.construction.board.sheet import Board
from graphkin.construction.board.steps import FINDS_A_POINT, Mark, Reason, Step
from graphkin.construction.position.group_position import all_fits, each_assembly, place_by_trial, trial_steps
from graphkin.construction.position.links_on_paper import (
    Intersection,
    PlacedLinks,
    Steps,
    assemble,
    assembled,
    coordinate_on_paper,
    drive,
    meet,
    meeting,
    met_near,
    moved,
    rolled_near,
    start_board,
    stuck,
    travel,
    walk,
)
from graphkin.construction.position.reduced_mechanism import PlacedElements, ReducedMechanism, fitted
from graphkin.errors import Unsolvable
from graphkin.plane import Pose, Poses, added_up, unit
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import (
    Driven,
    Dyad,
    Element,
    LargerGroup,
    RollingRelation,
    Structure,
    analyse,
    cams_replaced,
    leading,
    needed,
    pick,
)
from graphkin.structure.assembly import out_of_reach, ways
from graphkin.words import Phrase, links_named

TRIALS = 3  # trial drivers used, one after the other, to find all assemblies
TWINS = 1e-6  # of the size: as near as this places are the same
ROUGHLY = 0.01  # of the size: so near to a sketch no nearer assembly is looked for
STEP, LONG_STEP = math.radians(2.0), math.radians(8.0)  # of the driver at most, with larger groups and without
BESIDE = 1e-4  # of a driver's span: from so far beside a dead point the motion is followed
HAIR = 1e-3  # of that travel: so near to the dead point the assemblies are chosen
TOUCHING = 2e-3  # sine between the loci of a dyad that stands there in its dead point, at most
SURPRISE = 1e-3  # so far from where it was expected a link may be found, in the size of the mechanism


@dataclass(frozen=True, eq=False, repr=False)
class Assembly:
    """The placing of elements at a position, and the assembly of each.

    Parameters
    ----------
    values : of the drivers (rad, m)
    poses : every link with the mechanism of size 1
    branches : the assembly of each dyad, by its index among the elements: 0 the default, 1 the other
    reduced : the reduced mechanism by whose trial positions each larger group is placed
    """

    values: Mapping[str, float]
    poses: Poses
    branches: Mapping[int, int] = field(default_factory=dict)
    reduced: Mapping[LargerGroup, ReducedMechanism] = field(default_factory=dict)


def place(
    structure: Structure, elements: Sequence[Element], mm: float, assembly: Assembly, instrument: Instrument = EXACT,
    board: Board | None = None,
) -> PlacedLinks:
    """Place the links of the elements at the driver values of an assembly.

    Parameters
    ----------
    mm : mm of paper for one m
    instrument : the hands that draw
    board : record of the placing of each link, the words for each assembly by the group's links, and the acts of an
        erring hand up to each link

    Raises
    ------
    Unsolvable
        the loci of a dyad miss each other ("not assembled") or only touch ("dead point")
    """
    paper, so_far = (start_board(structure, mm, assembly.values, hand) for hand in (instrument, EXACT))
    frame, met = structure.scene.frame, dict[Element, tuple[Intersection, int]]()
    erring = board is not None and instrument.errs is not None
    placed = [(instrument.acts, Phrase("placing", links=links_named([frame.name])))] if erring else []
    named = set(frame.points)
    done = 0 if board is None else len(board.causes)
    if board is not None:
        fixed = tuple(Mark(PointRef(p), paper.point(frame.name, p)) for p in frame.points)
        board.do(Step("mark", "frame", strokes=fixed, link=frame.name, points=tuple(frame.points)))

    def chosen(i: int, element: Dyad | LargerGroup) -> Poses:
        if isinstance(element, LargerGroup):
            place_by_trial(paper, assembly.reduced[element], assembly.poses)
            return {}
        intersection = meeting(structure, paper, element)
        index = assembly.branches.get(i, 0) % len(intersection.poses)
        met[element] = intersection, index
        return intersection.poses[index]

    for element in assemble(paper, elements, chosen):
        if board is None:
            continue
        if erring:
            placed.append((instrument.acts, Phrase("placing", links=element.named)))
        if isinstance(element, Driven):
            steps: Steps = (drive(so_far, element)[1],)
        elif isinstance(element, LargerGroup):
            steps = trial_steps(paper, so_far, assembly.reduced[element])
        else:
            steps = _dyad_steps(board, paper, element, *met[element])
        _record(board, paper, element, steps, named)
        so_far.poses.update({name: paper.poses[name] for name in element.members})
    if board is not None and erring:
        board.causes[done:] = placed
    return paper


def _dyad_steps(board: Board, paper: PlacedLinks, dyad: Dyad, intersection: Intersection, index: int) -> Steps:
    """The steps of a dyad's loci; on the board the words for its assembly, and the remarks on its accuracy."""
    whose, outer_first, outer_second = dyad.named, dyad.outer_first, dyad.outer_second
    point, turned = dyad.inner.point, Symbol("omega", link=(dyad.links or dyad.members)[0])
    result, finds = (point, Symbol("v", PointRef(point))) if dyad.inner.turns else (whose, turned)
    board.notice("mechanism", "sharp crossing", result=result, size=intersection.sharpness, finds=finds)
    if not dyad.inner.turns and outer_first.turns and outer_second.turns:
        arm = abs(paper.point(outer_first.b, outer_first.point) - paper.point(outer_second.b, outer_second.point))
        board.notice("mechanism", "short arm", mm=arm, links=whose, point=outer_first.point, other=outer_second.point)
    which = "one assembly" if dyad.is_two_lines else f"{dyad.kind} {index}"
    first, inner, last = (pair.key for pair in dyad.pairs)
    board.assembly[whose] = Phrase(which, first=first, inner=inner, last=last)
    return intersection.steps(index)


def _record(board: Board, paper: PlacedLinks, element: Element, steps: Steps, named: set[str]) -> None:
    """Record the placing of an element's links, and their points except those ``named``."""
    links, (ground, *_) = paper.links, paper.poses
    crossed: set[str] = set()
    left = list(element.members)

    def known(name: str) -> int:
        return len(links[name].points.keys() & (named | crossed))

    def mark(name: str) -> None:
        left.remove(name)
        fresh = tuple(p for p in links[name].points if p not in named)
        named.update(fresh)
        if fresh:
            marks = tuple(Mark(PointRef(p), paper.point(name, p)) for p in fresh)
            reason: Reason = "whole link" if len(links[name].points) > 2 else "points"
            board.do(Step("mark", reason, strokes=marks, link=name, points=fresh))

    for step in steps:
        step = replace(step, base="") if step.base == ground else step
        crossed.update({step.point} if step.reason in FINDS_A_POINT else ())
        board.do(step)
        if isinstance(element, LargerGroup):  # what the next lines start from
            laid = step.link if step.reason == "angle" else ""
            for name in [n for n in left if n == laid or known(n) > 1]:
                mark(name)
    while left:  # first the links that stand already: two of their points are known
        mark(max(left, key=known))


def assembly_at(
    structure: Structure, elements: Sequence[Element], values: Mapping[str, float], near: Assembly | None
) -> Assembly:
    """The assembly of some elements at driver values (rad, m), to which those of rolling links are added.

    Parameters
    ----------
    near : a known position, from which the motion is followed; without it the scene's own is found first

    Raises
    ------
    Unsolvable
        "not drawn": no link of a larger group can be left out so that dyads remain; "not assembled": the links do not
        fit at these values, or the motion does not reach them, with the limit in the message; "dead point"
    SceneError : a group has several assemblies and no sketch chooses
    """
    scene, placed = structure.scene, PlacedElements(structure, elements)
    at_start = all(values[d.key] == d.values[0] for d in scene.drivers)
    there = placed.at_start if at_start else placed
    if near is None:
        poses = poses_at(placed, values)
    else:
        poses = moved_to(placed, {key: near.values[key] for key in values}, values, near.poses)
    starts = {d.key: d.values[0] for d in there.structure.scene.drivers if d.key not in values}
    paper = start_board(structure, 1.0 / scene.size, {**values, **starts})
    branches: dict[int, int] = {}
    reduced: dict[LargerGroup, ReducedMechanism] = {}
    for i, element in enumerate(elements):
        if isinstance(element, Dyad):
            branches[i] = meet(paper, element).nearest(poses) or 0
        elif isinstance(element, LargerGroup):
            if at_start and element.rolling:  # as the problem gives it
                best = placed.standing(element, paper, poses)
            else:
                drawing = placed.best(element, paper, poses)
                best = None if drawing is None else drawing.reduced
            if best is None:
                raise stuck("dead point", element.named, "every trial drawing is at a dead point")
            reduced[element] = best.rolled_from(poses, paper.mm)
        paper.poses.update({name: poses[name] for name in element.members})
    rolling = [e.rolled for e in elements if e.rolled is not None]
    rolled = {r.key: coordinate_on_paper(structure, paper.poses, paper.mm, r.coordinate) for r in rolling}
    return Assembly({**values, **starts, **rolled}, poses, branches, reduced)


def poses_at(placed: PlacedElements, values: Mapping[str, float]) -> Poses:
    """The poses of some elements' links at driver values (rad, m), on paper of the mechanism's size, followed from the
    scene's own position; errors as for `assembly_at`."""
    start = {d.key: d.values[0] for d in placed.structure.scene.drivers}
    try:
        poses: Poses | Unsolvable = own_position(placed.at_start).poses
    except Unsolvable as stop:
        if stop.status != "dead point" or values == start:
            raise
        poses = stop
    return moved_to(placed, start, values, poses)


def off_the_own_position(dead: Unsolvable) -> Unsolvable:
    """The error of a dead point at the scene's own position, where another is asked for that is followed from it."""
    (problem, *_) = dead.problems
    return Unsolvable("dead point", replace(problem, wanted=Phrase("move the own position off")))


def cams_in_place(
    structure: Structure, asked: Sequence[Symbol], values: Mapping[str, float], bars: bool = True
) -> Structure:
    """The mechanism that replaces one with cams at driver values (rad, m), by the poses of the links that the asked
    quantities need.

    Parameters
    ----------
    bars : whether bars replace rollers and edges, if they can, else pins on the pitch curves

    Raises
    ------
    Unsolvable : a follower that does not come to its base circle, a position that cannot be assembled or reached
    """
    scene, mm = structure.scene, 1.0 / structure.scene.size
    moving = leading(structure, [pair.bodies[0] for pair in structure.touching if pair.by_law])
    elements = [e for i, e in enumerate(structure.elements) if i in moving or e in needed(structure, asked)]
    poses = poses_at(PlacedElements(structure, elements), values)
    rolling = {name for pair in scene.higher_pairs if pair.rolling for name in pair.bodies}
    starts = {**scene.starts, **{name: cmath.phase(poses[name].axis) for name in rolling & poses.keys()}}
    starts |= {s.key: travel(s, poses, mm) / mm for s in structure.slides if rolling and poses.keys() >= {*s.links}}
    in_metres = {name: pose.scaled(scene.size) for name, pose in poses.items()}
    return analyse(replace(cams_replaced(scene, in_metres, values, bars), starts=starts))


# others, followed from a known one


def moved_to(
    placed: PlacedElements, start: Mapping[str, float], values: Mapping[str, float], poses: Poses | Unsolvable
) -> Poses:
    """All links at driver values, followed from their poses at others (``start``), on paper of the mechanism's size.

    Parameters
    ----------
    poses : the links at ``start``; the error of a dead point there, at the scene's own position, where each way begins
        beside it, on its side

    Raises
    ------
    Unsolvable : "not assembled": the motion does not reach the values; the message gives the limit; "dead point": it
        cannot be followed from the scene's own position
    """
    if values == start and not isinstance(poses, Unsolvable):
        return poses
    scene = placed.structure.scene
    first, goal = [start[d.key] for d in scene.drivers], [values[d.key] for d in scene.drivers]
    limits: list[Mapping[str, float]] = []
    for end in ways(scene.drivers, first, goal, placed.structure.rolls):
        target = scene.by_driver(end)
        length = max(abs(target[d.key] - start[d.key]) / d.span(scene.size) for d in scene.drivers)
        longest = 1.0 / max(1, math.ceil(length / (STEP if placed.of else LONG_STEP)))

        def at(part: float, target: Mapping[str, float] = target) -> dict[str, float]:
            return {k: start[k] + part * (target[k] - start[k]) for k in start}

        def near(part: float, guess: Poses, there: Poses, at: Callable[[float], dict[str, float]] = at) -> Poses | None:
            return found_near(placed, at(part), guess, there, there)

        begin, there = 0.0, poses
        if isinstance(there, Unsolvable):
            begin = min(0.5, BESIDE / length) if length else 1.0
            beside = _beside_own_position(placed, at, begin)
            if beside is None:
                continue
            there = beside
        # nothing says yet where the links go: the first step is small
        steps = walk(near, there, begin, 1.0, longest, longest / 1e13, SURPRISE, longest / 64)
        part, reached = [(begin, there), *steps][-1]
        if part == 1.0:
            return reached
        limits.append(at(part))
    if isinstance(poses, Unsolvable) and not limits:
        raise off_the_own_position(poses)
    raise Unsolvable("not assembled", out_of_reach(scene, dict(zip(start, goal, strict=True)), limits))


def found_near(
    placed: PlacedElements, values: Mapping[str, float], guess: Poses, start: Poses, before: Poses | None = None
) -> dict[str, Pose] | None:
    """All links of the elements at driver values, near a guessed position, on paper of the mechanism's size; None where
    they do not fit nearby.  Rolling links are followed from ``start``, dyads from ``before`` (see `met_near`)."""
    structure = placed.structure
    paper = start_board(structure, 1.0 / structure.scene.size, values)

    def choose(_: int, element: Dyad | LargerGroup) -> Poses | None:
        if isinstance(element, Dyad):
            return met_near(paper, element, guess, before)
        drawing = placed.best(element, paper, guess)
        if drawing is not None and element.rolling:
            return fitted(placed.last[element].rolled_from(start, paper.mm), paper, guess)
        return None if drawing is None else drawing.closed()

    def rolled(driver: RollingRelation) -> float:
        return rolled_near(structure, paper, driver, start, guess)

    return dict(paper.poses) if assembled(paper, placed.elements, choose, rolled) else None


# the scene's own position


def own_position(
    placed: PlacedElements, of_group: Callable[[PlacedLinks, LargerGroup], Poses] | None = None
) -> PlacedLinks:
    """The links of some elements at the scene's own driver values, on paper of its size; ``of_group`` chooses the
    assembly of a larger group, by trial positions if None.  Raises as `meeting` and `pick`."""
    values = {d.key: d.values[0] for d in placed.structure.scene.drivers}
    return _placed_as_own(placed, values, of_group or partial(_group_by_sketch, placed))


def _beside_own_position(
    placed: PlacedElements, at: Callable[[float], Mapping[str, float]], part: float
) -> Poses | None:
    """The links at a part of a way from the scene's own position, a dead point, in the assemblies that they have there;
    None where they do not fit."""
    branches: dict[int, int] = {}
    of_group = partial(_group_by_sketch, placed.at_start)
    try:
        _placed_as_own(placed.at_start, at(HAIR * part), of_group, branches)
        return _placed_as_own(placed.at_start, at(part), of_group, branches).poses
    except Unsolvable:
        return None


def _placed_as_own(
    placed: PlacedElements, values: Mapping[str, float], of_group: Callable[[PlacedLinks, LargerGroup], Poses],
    beside: dict[int, int] | None = None,
) -> PlacedLinks:
    """The links of some elements at driver values, on paper of the mechanism's size, in the assemblies of the scene's
    own position.

    Parameters
    ----------
    beside : where the own position is a dead point, the assemblies of the dyads beside it, by the index of the element.
        Missing assemblies are added: the first one of a dyad whose loci nearly touch, the drawn or sketched one of
        another dyad
    """
    structure = placed.structure
    scene = structure.scene
    paper = start_board(structure, 1.0 / scene.size, values)
    wanted = {n for element in placed.elements for n in element.members}
    branches: dict[int, int] = {} if beside is None else beside
    if beside is not None:  # near the drawn points alone
        scene = replace(scene, drawn={}, sketch={**scene.sketch, **scene.drawn})

    def choose(i: int, element: Dyad | LargerGroup) -> Poses:
        if isinstance(element, LargerGroup):
            return of_group(paper, element)
        touching = None if beside is None else meet(paper, element)
        if touching is not None and touching.poses and touching.sine < TOUCHING:
            return touching.poses[branches.setdefault(i, 0)]
        poses = meeting(structure, paper, element).poses
        if i not in branches:
            branches[i] = pick(scene, element.links, [paper.fresh(places) for places in poses], 0)
        return poses[branches[i]]

    here = [element for element in structure.elements if wanted.intersection(element.members)]
    assembled(paper, here, choose, lambda driver: driver.start)
    return paper


def _group_by_sketch(placed: PlacedElements, paper: PlacedLinks, group: LargerGroup) -> Poses:
    """The scene's assembly of a larger group: the sketched one, improved until it fits; where the sketch does not give
    it, the fitting one nearest to the sketch."""
    structure = placed.structure
    sketched = list(_fits_by_sketch(placed, paper, group))
    fits = [fit for fit in sketched[-1:] if _is_told(structure, paper, fit)]
    if not fits:
        # by several trial drivers: what one passes over at its dead point another sees
        by_driver: dict[tuple[str, ...], ReducedMechanism] = {}
        for reduced in placed.of[group]:
            by_driver.setdefault(tuple(d.key for d in reduced.trial), reduced)
        some = list(by_driver.values())[:TRIALS]
        fits = [fit for reduced in some for fit in all_fits(reduced, paper)] + sketched
    if not fits:
        raise stuck("not assembled", group.named, "no trial position closes this group here")
    positions = _without_twins(structure, paper, group, fits)
    return positions[pick(structure.scene, group.links, [paper.fresh(poses) for poses in positions], None)]


def _fits_by_sketch(placed: PlacedElements, paper: PlacedLinks, group: LargerGroup) -> Iterator[dict[str, Pose]]:
    """Positions of a group near its sketch, up to the first that agrees with it: drawn at trial values of the sketch,
    in the assembly nearest to it, and improved until they fit."""
    structure, rough = placed.structure, sketched_poses(placed.structure, group, paper)
    for reduced in placed.of[group]:
        if not rough.keys() >= {name for driver in reduced.trial for name in driver.links}:
            continue
        values = reduced.values(rough, paper.mm)
        drawings = (drawn for _, drawn in each_assembly(reduced.opened(paper, values), reduced.elements))
        offs = ((added_up(_off_sketch(structure, paper, drawn.poses)), dict(drawn.poses)) for drawn in drawings)
        near = min(offs, key=lambda drawing: drawing[0], default=None)
        fit = None if near is None else fitted(reduced, paper, near[1], values)
        if fit is not None:
            yield fit
            if _is_told(structure, paper, fit):
                return


def sketched_poses(structure: Structure, group: LargerGroup, known: PlacedLinks) -> dict[str, Pose]:
    """The known links, and the sketched ones of a group: with a sketched point, and a direction by two points, or by
    sliding pairs and driven angles from another link."""
    scene, mm = structure.scene, known.mm
    places = {p: z * mm for p, z in {**scene.sketch, **scene.drawn}.items()}
    places |= {p: known.point(n, p) for n in known.poses for p in structure.links[n].points}
    points_of = {n: {p: z * mm for p, z in structure.links[n].points.items() if p in places} for n in group.members}
    axes = {name: pose.axis for name, pose in known.poses.items()}
    # the second link's direction is the first's times this
    joined = [(p.b, p.a, p.guide.direction * p.turn) for p in group.pairs if not p.turns]
    joined += [(*d.links[::-1], cmath.rect(1.0, known.values[d.key])) for d in group.drivers if d.turns]

    def spread() -> None:
        for base, name, turn in joined * len(joined):
            if base in axes:
                axes.setdefault(name, axes[base] * turn)
            elif name in axes:
                axes[base] = axes[name] * turn.conjugate()

    spread()
    for name, points in points_of.items():
        pairs = [(abs(points[b] - points[a]), a, b) for a, b in combinations(points, 2) if places[a] != places[b]]
        if pairs and name not in axes:
            _, a, b = max(pairs)
            axes[name] = unit((places[b] - places[a]) / (points[b] - points[a]))
    spread()
    poses = dict(known.poses)
    for name, points in points_of.items():
        if name in axes and points:
            point, place = next(iter(points.items()))
            poses[name] = Pose(places[point] - axes[name] * place, axes[name])
    return poses


def _off_sketch(structure: Structure, paper: PlacedLinks, poses: Poses) -> list[float]:
    """The distances (m) of the points of further links from their sketched places."""
    places = {**structure.scene.sketch, **structure.scene.drawn}
    return [abs(z - places[p]) for p, z in paper.fresh(poses).items() if p in places]


def _is_told(structure: Structure, paper: PlacedLinks, poses: Poses) -> bool:
    """Whether all points lie near their sketched places."""
    return max(_off_sketch(structure, paper, poses), default=0.0) <= ROUGHLY * structure.scene.size


def _without_twins(
    structure: Structure, paper: PlacedLinks, group: LargerGroup, fits: Sequence[dict[str, Pose]]
) -> list[dict[str, Pose]]:
    """The positions without doubles: of positions with equal places of all points the one with the sliding link on the
    positive side.  A fit at a value of the grid is met from both sides, and others differ only in the sense of a bar
    without length."""
    slides = [p for p in group.pairs if not p.turns and p.a in group.members and p.b in group.members]

    def positive(poses: Poses) -> float:
        return added_up(travel(slide, poses, paper.mm) for slide in slides)

    kept: list[tuple[dict[str, Pose], dict[str, complex]]] = []
    apart = TWINS * structure.scene.size
    for poses in sorted(fits, key=positive, reverse=True):
        places = paper.fresh(poses)
        # of links without points the links themselves
        if all(any(abs(z - other[p]) > apart for p, z in places.items())
               or (not places and moved(poses, kept_poses) > TWINS) for kept_poses, other in kept):
            kept.append((poses, places))
    return [poses for poses in fits if any(poses is kept_poses for kept_poses, _ in kept)]
