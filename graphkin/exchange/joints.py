"""Mechanisms as lists of joints, each with the links that it joins: PMKS and pyslvs keep them so."""

from __future__ import annotations

from collections.abc import Sequence

from graphkin.exchange.bodies import FRAME, Bodies, BodySlide
from graphkin.frozen import dataclass

__all__ = ["FileJoint", "bodies_of"]


@dataclass(frozen=True)
class FileJoint:
    """A joint of so many links.

    kind : "R" turning; "P" the others slide on a line of the first link and keep their angle; "RP" a pin of the others
        runs on a line of the first link
    angle : of the line in the world (rad)
    """

    name: str
    kind: str
    place: complex
    links: tuple[str, ...]
    angle: float = 0.0


def bodies_of(title: str, joints: Sequence[FileJoint]) -> Bodies:
    """Bodies with the points of their joints; ``ground`` is the frame."""
    made = Bodies(title)
    names: dict[str, str] = {}
    for link in dict.fromkeys(link for joint in joints for link in joint.links):
        names[link] = made.body(FRAME if link.lower() == "ground" else link, [])
    made.bodies.setdefault(FRAME, [])
    for number, joint in enumerate(joints):
        point = made.point(joint.name or _letter(number), joint.place)
        first, *others = joint.links
        if joint.kind == "P" and others and names[others[0]] == FRAME:
            first, others = others[0], [first]  # who slides on whom makes no difference where neither turns
        if joint.kind == "R" or not others:
            for link in joint.links:
                made.bodies[names[link]].append(point)
            continue
        for link in others:
            made.bodies[names[link]].append(point)
        turns = joint.kind == "RP"
        made.slides.append(BodySlide(names[others[0]], point, names[first], joint.place, joint.angle, turns))
    return made


def _letter(number: int) -> str:
    """A, B, ... Z, A1, B1, ..."""
    turn, letter = divmod(number, 26)
    return chr(65 + letter) + (str(turn) if turn else "")
