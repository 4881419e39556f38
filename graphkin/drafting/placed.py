"""The position as it is drawn, step by step: how each link was placed, and in which assembly."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from graphkin.drafting.board import Board
from graphkin.drafting.dyads import Frame, drive
from graphkin.drafting.position import Position
from graphkin.drafting.sheet import Mark
from graphkin.scene.symbol import PointRef
from graphkin.structure import Driven, Dyad, Structure, Turn, links_of
from graphkin.words import Phrase

__all__ = ["draw_position"]

SHORT = 3.0  # mm on paper; a direction drawn through two points nearer than this errs by a pencil's width in ten


def draw_position(
    board: Board,
    structure: Structure,
    elements: Sequence[Driven | Dyad],
    position: Position,
    branches: Mapping[int, int],
) -> dict[str, Phrase]:
    """Record how each link was placed; returns the words for each assembly, by the group's links."""
    frame = position.frame
    ground = structure.scene.frame
    fixed = tuple(Mark(PointRef(p), frame.point(ground.name, p)) for p in ground.points)
    board.do("mechanism", Phrase("frame", (ground.name, ", ".join(ground.points))), *fixed)
    named = set(ground.points)
    assembly: dict[str, Phrase] = {}
    so_far = Frame(frame.links, frame.mm, frame.values, {ground.name: frame.poses[ground.name]})
    for i, element in enumerate(elements):
        if isinstance(element, Driven):
            _, story = drive(so_far, element)
        else:
            meeting = position.meetings[i]
            board.warn(min(meeting.sine, 1.0), _inner_name(element))
            _warn_short(board, element, frame)
            index = branches.get(i, 0) % len(meeting.poses)
            story = meeting.stories[index]
            key = ", ".join(element.links)
            assembly[key] = Phrase(
                f"{element.kind} {index}"
                if len(meeting.poses) > 1 or element.kind in ("RRR", "RRP", "RPR")
                else "one assembly",
                _assembly_names(element),
            )
        for phrase, strokes in story:
            board.do("mechanism", phrase, *strokes)
        for name in links_of(element):
            so_far.poses[name] = frame.poses[name]
            fresh = [p for p in structure.links[name].points if p not in named]
            marks = tuple(Mark(PointRef(p), frame.point(name, p)) for p in fresh)
            named.update(fresh)
            if marks and len(structure.links[name].points) > 2:
                board.do("mechanism", Phrase("transfer", (name, ", ".join(fresh))), *marks)
            elif marks:
                board.do("mechanism", Phrase("points", (name, ", ".join(fresh))), *marks)
    return assembly


def _warn_short(board: Board, dyad: Dyad, frame: Frame) -> None:
    """Say where a guide is directed by two points that lie too near to each other."""
    one, two = dyad.outer_first, dyad.outer_second
    if dyad.kind == "RPR" and isinstance(one, Turn) and isinstance(two, Turn):
        apart = abs(frame.point(one.b, one.point) - frame.point(two.b, two.point))
        if apart < SHORT:
            board.note(Phrase("short arm", (", ".join(dyad.links), one.point, f"{apart:.2g}", two.point)))


def _inner_name(dyad: Dyad) -> str:
    """What the loci of a dyad find, for a remark."""
    if isinstance(dyad.inner, Turn):
        return dyad.inner.point
    return f"links {', '.join(dyad.links)}"


def _assembly_names(dyad: Dyad) -> tuple[object, ...]:
    def name(pair: object) -> str:
        return getattr(pair, "point", "") or getattr(pair, "key", "")

    return name(dyad.outer_first), name(dyad.inner), name(dyad.outer_second)
