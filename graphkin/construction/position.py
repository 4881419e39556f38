"""The mechanism on paper: every link placed by compass and ruler, in the order of solution, and in which assembly."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from graphkin.construction.group_position import GroupTrial
from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.links_on_paper import Meeting, PlacedLinks, Poses, assemble, drive, meet, refuse, start_board
from graphkin.construction.sheet import Board
from graphkin.construction.steps import FINDS_A_POINT, Cause, Mark, Step
from graphkin.scene.symbol import PointRef
from graphkin.structure import (
    Driven,
    Dyad,
    Element,
    LargerGroup,
    Structure,
)
from graphkin.words import Phrase

__all__ = ["Branches", "draw_position", "place"]

Branches = Mapping[int, int]  # by place of the element: 0 the default assembly, 1 the other


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
    trials: Mapping[LargerGroup, GroupTrial] | None = None,
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
    causes: list[tuple[int, Cause]] = [(instrument.acts, _placing(structure.scene.frame.name))]

    def chosen(i: int, element: Dyad | LargerGroup) -> Poses:
        if isinstance(element, LargerGroup):
            (trials or {})[element].place(paper)
            return {}
        meeting = meetings[i] = meet(paper, element)
        refuse(structure, element, meeting)
        return meeting.poses[branches.get(i, 0) % len(meeting.poses)]

    for element in assemble(paper, elements, chosen):
        links = (element.link,) if isinstance(element, Driven) else element.links
        causes.append((instrument.acts, _placing(*links)))
    return Position(paper, meetings, causes)


def _placing(*links: str) -> Phrase:
    """The pricking and placing of links, as a cause of what is uncertain."""
    return Phrase("placing", (", ".join(links),))


def draw_position(
    board: Board,
    structure: Structure,
    elements: Sequence[Element],
    position: Position,
    branches: Mapping[int, int],
    trials: Mapping[LargerGroup, GroupTrial] | None = None,
) -> None:
    """Record how each link was placed, and the words for each assembly, by the group's links."""
    paper = position.paper
    ground = structure.scene.frame
    fixed = tuple(Mark(PointRef(p), paper.point(ground.name, p)) for p in ground.points)
    board.do(Step("mark", "frame", strokes=fixed, link=ground.name, points=tuple(ground.points)))
    named = set(ground.points)
    so_far = PlacedLinks(paper.links, paper.mm, paper.values, {ground.name: paper.poses[ground.name]})
    for i, element in enumerate(elements):
        if isinstance(element, Driven):
            _, story = drive(so_far, element)
        elif isinstance(element, LargerGroup):
            story = (trials or {})[element].steps(paper, so_far)
        else:
            meeting = position.meetings[i]
            board.notice("mechanism", "sharp crossing", _inner_name(element), size=meeting.sharpness)
            _remark_arm(board, element, paper)
            index = branches.get(i, 0) % len(meeting.poses)
            story = meeting.tell(index)
            key = ", ".join(element.links)
            which = "one assembly" if element.is_two_lines else f"{element.kind} {index}"
            board.assembly[key] = Phrase(which, tuple(pair.key for pair in element.pairs))
        found: set[str] = set()
        left = list(element.members)

        def known(name: str, found: set[str] = found) -> int:
            return len(structure.links[name].points.keys() & (named | found))

        for step in story:
            board.do(replace(step, base="") if step.base == ground.name else step)
            if step.reason in FINDS_A_POINT:
                found.add(step.point)
            if isinstance(element, LargerGroup):  # what the next lines start from
                laid = step.link if step.reason == "angle" else ""
                for name in [n for n in left if n == laid or known(n) > 1]:
                    left.remove(name)
                    _mark_points(board, structure, paper, name, named)
        while left:  # first the links that stand already: two of their points are known
            name = max(left, key=known)
            left.remove(name)
            _mark_points(board, structure, paper, name, named)
        for name in element.members:
            so_far.poses[name] = paper.poses[name]


def _mark_points(board: Board, structure: Structure, paper: PlacedLinks, name: str, named: set[str]) -> None:
    """The points of a placed link that do not stand on the paper yet."""
    points = structure.links[name].points
    fresh = tuple(p for p in points if p not in named)
    named.update(fresh)
    if fresh:
        marks = tuple(Mark(PointRef(p), paper.point(name, p)) for p in fresh)
        board.do(Step("mark", "whole link" if len(points) > 2 else "points", strokes=marks, link=name, points=fresh))


def _remark_arm(board: Board, dyad: Dyad, paper: PlacedLinks) -> None:
    """How far the two points are apart that direct a guide."""
    one, two = dyad.outer_first, dyad.outer_second
    if not dyad.inner.turns and one.turns and two.turns:
        apart = abs(paper.point(one.b, one.point) - paper.point(two.b, two.point))
        board.notice("mechanism", "short arm", ", ".join(dyad.links), one.point, two.point, size=apart)


def _inner_name(dyad: Dyad) -> str | Phrase:
    """What the loci of a dyad find, for a remark."""
    if dyad.inner.turns:
        return dyad.inner.point
    return Phrase("these links", (", ".join(dyad.links),))
