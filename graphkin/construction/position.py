"""The mechanism on paper: every link placed by compass and ruler, in the order of solution, and in which assembly."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from graphkin.construction.dyads import Choose, Meeting, Story, assemble, assembled, drive, meet
from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.links_on_paper import PlacedLinks, Pose, Poses
from graphkin.construction.mechanism_acts import (
    ArcOnPath,
    CompassArcs,
    FixedPoints,
    LaidOffAngle,
    LinkPoints,
    PathsCross,
)
from graphkin.construction.remarks import SharpCrossing, ShortArm
from graphkin.construction.sheet import Board, Cause, Placing
from graphkin.construction.strokes import Mark
from graphkin.construction.touching import coordinate_on_paper
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.symbol import PointRef
from graphkin.structure import (
    Cluster,
    Driven,
    Dyad,
    Element,
    Rolled,
    Structure,
    Turn,
    links_of,
    named_with_contact,
    pick,
)
from graphkin.structure.assembly import follow, out_of_reach, ways
from graphkin.structure.model import Coordinate
from graphkin.words import Phrase

__all__ = ["Branches", "as_meant", "branches_at", "draw_position", "place", "rolled_position", "start_board"]

TOUCH = 2e-14  # loci that miss each other by less, in their own size, touch
DEAD = 1e-7  # sine of a crossing below which a group is at a dead point
TURNS = 720  # positions looked at on the way round
MOST = 12.0  # turns, or as much of another driver's way
ROLL_STEP, SLIDE_STEP = math.radians(3.0), 0.02  # in which what rolls is followed (rad, and the mechanism's size)
Branches = Mapping[int, int]  # by place of the element: 0 the default assembly, 1 the other
Placed = dict[float, tuple[int, dict[str, Pose]]]


class TrialPlacing(Protocol):
    """By which trial positions a larger group is placed."""

    def place(self, paper: PlacedLinks) -> None:
        """Place the group among the links known already."""
        ...

    def steps(self, paper: PlacedLinks, so_far: PlacedLinks) -> Story:
        """What is drawn to place it."""
        ...


@dataclass(frozen=True)
class Position:
    """The links placed, and how each dyad was found."""

    paper: PlacedLinks
    meetings: Mapping[int, Meeting]
    causes: Sequence[tuple[int, Cause]] = ()  # acts of the hand up to which each link reaches


def place(
    structure: Structure,
    elements: Sequence[Element],
    mm: float,
    values: Mapping[str, float],
    branches: Branches,
    instrument: Instrument = EXACT,
    trials: Mapping[Cluster, TrialPlacing] | None = None,
) -> Position:
    """Place the links of the elements at some driver values.

    Parameters
    ----------
    mm : mm of paper for one m
    values : driver values (rad, m)
    branches : which of its assemblies each dyad takes
    instrument : what draws
    trials : by what trial positions each larger group is placed

    Raises
    ------
    Unsolvable
        the loci of a dyad miss each other ("not assembled") or only touch ("dead point")
    """
    paper = start_board(structure, mm, values, instrument)
    meetings: dict[int, Meeting] = {}
    causes: list[tuple[int, Cause]] = [(instrument.acts, Placing((structure.scene.frame.name,)))]

    def chosen(i: int, element: Dyad | Cluster) -> Poses:
        if isinstance(element, Cluster):
            (trials or {})[element].place(paper)
            return {}
        meeting = meetings[i] = meet(paper, element)
        _refuse(structure, element, meeting)
        return meeting.poses[branches.get(i, 0) % len(meeting.poses)]

    for element in assemble(paper, elements, chosen):
        causes.append((instrument.acts, Placing((element.link,) if isinstance(element, Driven) else element.links)))
    return Position(paper, meetings, causes)


def start_board(
    structure: Structure, mm: float, values: Mapping[str, float], instrument: Instrument = EXACT
) -> PlacedLinks:
    """The empty sheet with the fixed points pricked."""
    ground = structure.scene.frame.name
    paper = PlacedLinks(structure.links, mm, structure.followed(values), {ground: Pose(0j, 1 + 0j)}, instrument)
    if not instrument.faultless:
        paper.pricked.update({p: instrument.point(z * mm) for p, z in structure.links[ground].points.items()})
    return paper


def _refuse(structure: Structure, element: Dyad, meeting: Meeting) -> None:
    names = named_with_contact(structure, element)
    if meeting.gap < -1e-14 and not element.is_two_lines:
        raise Unsolvable(
            "not assembled",
            Problem(
                names,
                Phrase("the two loci of the group do not", kind=element.kind),
                Phrase("choose a driver value at which the mechanism"),
            ),
        )
    if not meeting.poses or meeting.sine < DEAD:
        raise Unsolvable(
            "dead point",
            Problem(
                names,
                Phrase("the group stands at a dead point its", kind=element.kind),
                Phrase("move the driver off this position"),
            ),
        )


def branches_at(
    structure: Structure,
    elements: Sequence[Element],
    values: Mapping[str, float],
    own: Mapping[str, float] | None = None,
    chosen: Mapping[int, int] | None = None,
) -> dict[int, int]:
    """The assembly of each dyad at some driver values.

    It is chosen once, at the scene's own position (``own`` values and ``chosen`` assemblies, where these are known),
    and followed from there without a jump; where the straight way is barred the other way round is tried.

    Raises
    ------
    Unsolvable
        status "not assembled": the motion does not reach the values; the message gives the limit
    """
    if own is None:
        own = {d.key: d.values[0] for d in structure.scene.drivers}
    if chosen is None:
        chosen = dict[int, int]()
        paper = start_board(structure, 1.0 / structure.scene.size, own)
        assembled(paper, elements, as_meant(structure, paper, chosen))
    chosen = dict(chosen)
    if all(values[k] == v for k, v in own.items()):
        return chosen
    limits = []
    for way in ways(structure.scene.drivers, [*own.values()], [values[k] for k in own], structure.rolls):
        target = dict(zip(own, way, strict=True))
        branches, limit = _follow(structure, elements, own, target, chosen)
        if limit is None:
            return branches
        limits.append({k: own[k] + limit * (target[k] - own[k]) for k in own})
    raise Unsolvable("not assembled", out_of_reach(structure.scene, values, limits))


def as_meant(structure: Structure, paper: PlacedLinks, chosen: dict[int, int]) -> Choose:
    """Each dyad in the assembly that the scene means at its own position, noted in ``chosen``."""

    def choose(i: int, element: Dyad | Cluster) -> Poses:
        assert isinstance(element, Dyad)
        meeting = meet(paper, element)
        _refuse(structure, element, meeting)
        candidates = [paper.fresh(poses) for poses in meeting.poses]
        chosen[i] = pick(structure.scene, element.links, candidates, 0).index
        return meeting.poses[chosen[i]]

    return choose


def _follow(
    structure: Structure,
    elements: Sequence[Element],
    own: Mapping[str, float],
    target: Mapping[str, float],
    chosen: Mapping[int, int],
) -> tuple[dict[int, int], float | None]:
    """Branches at the end of a straight path of driver values, or where it is barred (0 .. 1)."""
    turn = max(abs(target[k] - own[k]) for k in own)
    grid = np.linspace(0.0, 1.0, max(9, math.ceil(TURNS * min(turn / (2 * math.pi), MOST)) + 1))
    signs: dict[int, NDArray[np.float64]] = {}
    placed: Placed = {}
    branches = dict(chosen)
    for i, element in enumerate(elements):
        if not isinstance(element, Dyad):
            continue

        def gaps(ts: NDArray[np.float64], last: int = i) -> NDArray[np.float64]:
            return np.array(
                [_gap(structure, elements[: last + 1], own, target, chosen, signs, placed, float(t)) for t in ts]
            )

        start = gaps(np.zeros(1))[0]
        lines = element.is_two_lines
        way = math.copysign(1.0, start) if lines else 1.0
        passage = follow(
            lambda t, way=way, gaps=gaps: way * gaps(t),  # type: ignore[misc]
            grid, flips=not lines, touch=TOUCH,
        )
        if passage.limit is not None:
            return branches, passage.limit
        signs[i] = passage.flips
        branches[i] = chosen[i] if passage.sign(np.ones(1))[0] > 0 else 1 - chosen[i]
    return branches, None


def _gap(
    structure: Structure,
    elements: Sequence[Element],
    own: Mapping[str, float],
    target: Mapping[str, float],
    chosen: Mapping[int, int],
    flips: Mapping[int, NDArray[np.float64]],
    placed: Placed,
    t: float,
) -> float:
    """How well the loci of the last element cross at a place of the path.

    ``placed`` keeps how many elements stand at a place of the path, and their links, for those that come after.
    """
    paper = start_board(structure, 1.0 / structure.scene.size, {k: own[k] + t * (target[k] - own[k]) for k in own})
    first, poses = placed.get(t, (0, {}))
    paper.poses.update(poses)
    gap = -1.0

    def choose(place: int, element: Dyad | Cluster) -> Poses | None:
        nonlocal gap
        assert isinstance(element, Dyad)
        i = first + place
        if i == len(elements) - 1:
            placed[t] = i, dict(paper.poses)
        meeting = meet(paper, element)
        gap = meeting.gap
        flipped = int(np.searchsorted(flips[i], t)) % 2 if i in flips else 0
        return meeting.poses[(chosen[i] + flipped) % len(meeting.poses)] if meeting.poses else None

    assembled(paper, elements[first:], choose)
    return gap


def draw_position(
    board: Board,
    structure: Structure,
    elements: Sequence[Element],
    position: Position,
    branches: Mapping[int, int],
    trials: Mapping[Cluster, TrialPlacing] | None = None,
) -> dict[str, Phrase]:
    """Record how each link was placed; returns the words for each assembly, by the group's links."""
    paper = position.paper
    ground = structure.scene.frame
    fixed = tuple(Mark(PointRef(p), paper.point(ground.name, p)) for p in ground.points)
    board.do("mechanism", FixedPoints(ground.name, tuple(ground.points)), *fixed)
    named = set(ground.points)
    assembly: dict[str, Phrase] = {}
    so_far = PlacedLinks(paper.links, paper.mm, paper.values, {ground.name: paper.poses[ground.name]})
    for i, element in enumerate(elements):
        if isinstance(element, Driven):
            _, story = drive(so_far, element)
        elif isinstance(element, Cluster):
            story = (trials or {})[element].steps(paper, so_far)
        else:
            meeting = position.meetings[i]
            board.notice("mechanism", SharpCrossing(_inner_name(element), meeting.sharpness))
            _remark_arm(board, element, paper)
            index = branches.get(i, 0) % len(meeting.poses)
            story = meeting.tell(index)
            key = ", ".join(element.links)
            which = "one assembly" if element.is_two_lines else f"{element.kind} {index}"
            assembly[key] = Phrase(which, _assembly_names(element))
        found: set[str] = set()
        left = list(links_of(element))

        def known(name: str, found: set[str] = found) -> int:
            return len(structure.links[name].points.keys() & (named | found))

        for act, strokes in story:
            if isinstance(act, LaidOffAngle) and act.to == ground.name:
                act = replace(act, to="")
            board.do("mechanism", act, *strokes)
            if isinstance(act, CompassArcs | ArcOnPath | PathsCross):
                found.add(act.point)
            if isinstance(element, Cluster):  # what the next lines start from
                laid = act.link if isinstance(act, LaidOffAngle) else ""
                for name in [n for n in left if n == laid or known(n) > 1]:
                    left.remove(name)
                    _mark_points(board, structure, paper, name, named)
        while left:  # first the links that stand already: two of their points are known
            name = max(left, key=known)
            left.remove(name)
            _mark_points(board, structure, paper, name, named)
        for name in links_of(element):
            so_far.poses[name] = paper.poses[name]
    return assembly


def _mark_points(board: Board, structure: Structure, paper: PlacedLinks, name: str, named: set[str]) -> None:
    """The points of a placed link that do not stand on the paper yet."""
    points = structure.links[name].points
    fresh = tuple(p for p in points if p not in named)
    named.update(fresh)
    if fresh:
        marks = tuple(Mark(PointRef(p), paper.point(name, p)) for p in fresh)
        board.do("mechanism", LinkPoints(name, fresh, len(points) > 2), *marks)


def _remark_arm(board: Board, dyad: Dyad, paper: PlacedLinks) -> None:
    """How far the two points are apart that direct a guide."""
    one, two = dyad.outer_first, dyad.outer_second
    if not isinstance(dyad.inner, Turn) and isinstance(one, Turn) and isinstance(two, Turn):
        apart = abs(paper.point(one.b, one.point) - paper.point(two.b, two.point))
        board.notice("mechanism", ShortArm(dyad.links, (one.point, two.point), apart))


def _inner_name(dyad: Dyad) -> str | Phrase:
    """What the loci of a dyad find, for a remark."""
    if isinstance(dyad.inner, Turn):
        return dyad.inner.point
    return Phrase("these links", (", ".join(dyad.links),))


def _assembly_names(dyad: Dyad) -> tuple[object, ...]:
    def name(pair: object) -> str:
        return getattr(pair, "point", "") or getattr(pair, "key", "")

    return name(dyad.outer_first), name(dyad.inner), name(dyad.outer_second)


# -- what rolls --------------------------------------------------------------------------------------------------------


def rolled_position(
    structure: Structure, elements: Sequence[Element], own: Mapping[str, float], values: Mapping[str, float]
) -> tuple[dict[str, float], dict[int, int]]:
    """The driver values with those of everything that rolls (rad, m), and the assembly of each dyad there.

    The way is gone from the scene's own position in small steps, and how far the links have turned or slid on which it
    rolls is read off, whole turns included.

    Raises
    ------
    Unsolvable : "not assembled" where the motion does not go on, "not drawn" for groups larger than a dyad
    """
    for element in elements:
        if isinstance(element, Cluster):
            names = ", ".join(element.links)
            raise Unsolvable(
                "not drawn", Problem(Phrase("links", links=names), Phrase("a larger group beside what rolls is not"))
            )
    mm = 1.0 / structure.scene.size
    paper, chosen = start_board(structure, mm, own), dict[int, int]()
    start: dict[Coordinate, float] = {}

    def begun(driver: Rolled) -> float:
        start.update((c, coordinate_on_paper(structure, paper, c)) for c, _ in driver.factors)
        return driver.start

    assembled(paper, elements, as_meant(structure, paper, chosen), begun)
    near = dict(start)
    drivers = structure.scene.drivers
    long = max(abs(values[d.key] - own[d.key]) / (ROLL_STEP if d.turns else SLIDE_STEP / mm)
               for d in drivers)  # fmt: skip
    count = max(1, math.ceil(long))
    for k in range(1, count + 1):
        here = {key: own[key] + (values[key] - own[key]) * k / count for key in own} if k < count else dict(values)
        paper = _rolled_on(structure, elements, start_board(structure, mm, here), paper.poses, start, near, chosen)
    return {**values, **{key: v for key, v in paper.values.items() if key not in values}}, chosen


def _rolled_on(
    structure: Structure, elements: Sequence[Element], paper: PlacedLinks, before: Poses,
    start: Mapping[Coordinate, float], near: dict[Coordinate, float], chosen: dict[int, int],
) -> PlacedLinks:  # fmt: skip
    """All links a step further; ``near`` and ``chosen`` go on with them."""

    def choose(i: int, element: Dyad | Cluster) -> Poses:
        assert isinstance(element, Dyad)
        meeting = meet(paper, element)
        branch = meeting.nearest(before)
        if branch is None:
            wanted = Phrase("choose a driver value that the motion reaches")
            where = Phrase("links", links=", ".join(element.links))
            raise Unsolvable("not assembled", Problem(where, Phrase("their loci do not meet on the way"), wanted))
        chosen[i] = branch
        return meeting.poses[branch]

    def gone(driver: Rolled) -> float:
        value = driver.start
        for coordinate, factor in driver.factors:
            read = coordinate_on_paper(structure, paper, coordinate)
            if coordinate[0] == "angle":
                read += math.tau * round((near[coordinate] - read) / math.tau)
            near[coordinate] = read
            value += factor * (read - start[coordinate])
        return value

    assembled(paper, elements, choose, gone)
    return paper
