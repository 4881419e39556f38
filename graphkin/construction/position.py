"""The mechanism on paper: every link placed by compass and ruler, in the order of solution, and in which assembly."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from graphkin.construction.dyads import Choose, Meeting, Story, assemble, assembled, drive, meet
from graphkin.construction.follow import Choices, moved_to
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
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.symbol import PointRef
from graphkin.structure import Cluster, Driven, Dyad, Element, Structure, links_of, named_with_contact, pick
from graphkin.words import Phrase

__all__ = ["Branches", "as_meant", "branches_at", "draw_position", "place", "start_board"]

DEAD = 1e-7  # sine of a crossing below which a group is at a dead point
Branches = Mapping[int, int]  # by place of the element: 0 the default assembly, 1 the other


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
    paper, branches = start_board(structure, 1.0 / structure.scene.size, own), dict(chosen or {})
    if chosen is None:
        assembled(paper, elements, as_meant(structure, paper, branches))
    if all(values[k] == v for k, v in own.items()):
        return branches
    if chosen is not None:
        assembled(paper, elements, in_branches(paper, branches))
    poses = moved_to(Choices(structure, elements), elements, own, values, paper.poses)
    paper = start_board(structure, 1.0 / structure.scene.size, values)

    def nearest(i: int, element: Dyad | Cluster) -> Poses:
        assert isinstance(element, Dyad)
        branches[i] = meet(paper, element).nearest(poses) or 0
        return {name: poses[name] for name in links_of(element)}

    assembled(paper, elements, nearest)
    return branches


def in_branches(paper: PlacedLinks, branches: Branches) -> Choose:
    """Each dyad in a known assembly."""

    def choose(i: int, element: Dyad | Cluster) -> Poses:
        assert isinstance(element, Dyad)
        return meet(paper, element).poses[branches[i]]

    return choose


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
            assembly[key] = Phrase(which, tuple(pair.key for pair in element.pairs))
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
    if not dyad.inner.turns and one.turns and two.turns:
        apart = abs(paper.point(one.b, one.point) - paper.point(two.b, two.point))
        board.notice("mechanism", ShortArm(dyad.links, (one.point, two.point), apart))


def _inner_name(dyad: Dyad) -> str | Phrase:
    """What the loci of a dyad find, for a remark."""
    if dyad.inner.turns:
        return dyad.inner.point
    return Phrase("these links", (", ".join(dyad.links),))
