"""The acts by which a mechanism is placed on the paper, and the sentence of each."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from graphkin.words import Phrase
from graphkin.words.written import on_paper

__all__ = [
    "ArcOnPath",
    "CompassArcs",
    "FixedPoints",
    "GuideThrough",
    "GuideTouching",
    "HeldStill",
    "LaidOffAngle",
    "LaidOffTravel",
    "LinkPoints",
    "Missed",
    "Moved",
    "OnMechanism",
    "PathDrawn",
    "PathsCross",
    "PitchPoint",
    "RollingStarts",
    "SlidToMeet",
    "SpecialPoint",
    "TrialPositions",
    "TrialRow",
    "TrialTable",
    "mechanism_phrase",
]


@dataclass(frozen=True)
class FixedPoints:
    """The fixed points marked."""

    frame: str
    points: tuple[str, ...]


@dataclass(frozen=True)
class LaidOffAngle:
    """The angle (rad) of a driven link, about a hinge, to the x axis or to another link (``to``)."""

    link: str
    angle: float
    hinge: str
    to: str = ""


@dataclass(frozen=True)
class LaidOffTravel:
    """The travel of a driven sliding pair."""

    pair: str
    mm: float


@dataclass(frozen=True)
class CompassArcs:
    """Two arcs of these radii about known points find a third."""

    about: tuple[str, str]
    point: str
    radii: tuple[float, float]


@dataclass(frozen=True)
class PathDrawn:
    """The straight path of a point that slides."""

    point: str
    pair: str


@dataclass(frozen=True)
class ArcOnPath:
    """An arc of a radius about a known point finds another on its path."""

    about: str
    point: str
    mm: float


@dataclass(frozen=True)
class GuideThrough:
    """A guide drawn from its pivot through the pivot of what slides on it."""

    pivot: str
    through: str
    pair: str


@dataclass(frozen=True)
class GuideTouching:
    """A guide at a distance from its pivot, drawn as a tangent from the pivot of what slides on it."""

    pivot: str
    through: str
    mm: float
    pair: str


@dataclass(frozen=True)
class PathsCross:
    """A point lies where its two straight paths cross."""

    point: str
    pairs: tuple[str, str]


@dataclass(frozen=True)
class SlidToMeet:
    """A link shifted along one pair until its other guide meets a point."""

    point: str
    along: str
    until: str


@dataclass(frozen=True)
class LinkPoints:
    """The new points of a link marked; ``transferred`` where they come with the shape of a whole link."""

    link: str
    points: tuple[str, ...]
    transferred: bool


@dataclass(frozen=True)
class HeldStill:
    """What a driven slide gives of one link on another that is held still: the angle or the travel at their common pair
    (rad, m), or its rate (rad/s, m/s) or second rate (rad/s2, m/s2)."""

    held: str
    link: str
    slide: str
    gives: Literal["angle", "travel", "omega", "velocity", "alpha", "acceleration"]
    value: float


@dataclass(frozen=True)
class Moved:
    """What is moved in trial positions: a link ``name`` that is turned, by degrees from the link ``base`` ("" for the x
    axis), or the pair whose travel is changed (``turned`` false; mm on paper)."""

    name: str
    base: str
    turned: bool


@dataclass(frozen=True)
class Missed:
    """What is measured of what was left out, with the ``names`` that it lies between and the ``length`` of a bar (mm on
    paper): degrees where it is an ``angle``, else mm."""

    kind: Literal["bar", "guide", "turn", "travel", "guides", "rolled"]
    names: tuple[str, ...]
    length: float
    angle: bool


TrialRow: TypeAlias = tuple[tuple[float, ...], tuple[float, ...]]
"""The values of what is moved in a trial position, and what is missed there."""


@dataclass(frozen=True)
class TrialTable:
    """What is measured in the trial positions of a group, and divided.

    ``divided`` are positions that proportional division gives, one after the other, the last one where nothing is
    missed.  Where one thing is moved the first lies between the trial number ``before`` (from 1) and the next; where
    several are, each further trial differs from the first in one of them, ``parts`` of these steps together make the
    first that is divided, and each that is divided takes the place of the trial number ``instead`` (from 1).
    """

    moved: tuple[Moved, ...]
    missed: tuple[Missed, ...]
    trials: tuple[TrialRow, ...]
    divided: tuple[TrialRow, ...]
    before: int = 0
    parts: tuple[float, ...] = ()
    instead: tuple[int, ...] = ()

    def scaled(self, times: float) -> TrialTable:
        """The same with its lengths so many times as large."""
        x = [1.0 if one.turned else times for one in self.moved]
        y = [1.0 if one.angle else times for one in self.missed]

        def rows(old: tuple[TrialRow, ...]) -> tuple[TrialRow, ...]:
            return tuple((_times(values, x), _times(misses, y)) for values, misses in old)

        missed = tuple(replace(one, length=one.length * times) for one in self.missed)
        return replace(self, missed=missed, trials=rows(self.trials), divided=rows(self.divided))


def _times(values: tuple[float, ...], by: list[float]) -> tuple[float, ...]:
    return tuple(v * k for v, k in zip(values, by, strict=True))


@dataclass(frozen=True)
class TrialPositions:
    """A group placed by trial: ``driven`` names what is moved, ``left_out`` the link (or driver) left out until it
    fits, ``rolling`` the contacts or gears at which as much must have rolled off as since the scene's own position,
    ``point`` the free point whose trial curve is drawn ("" for none), in ``count`` trial positions, ``table`` what is
    measured in them.  ``instead`` are driven blocks left out, each with the link that is driven in its stead and by how
    much the block is turned from it (rad)."""

    links: tuple[str, ...]
    driven: tuple[str, ...]
    left_out: tuple[str, ...]
    point: str
    count: int
    rolling: tuple[str, ...] = ()
    table: TrialTable | None = None
    instead: tuple[tuple[str, str, float], ...] = ()


@dataclass(frozen=True)
class RollingStarts:
    """The angle (rad) to the x axis at which a link stands that rolls, or the travel (mm) of a pair, given at the
    scene's own position."""

    name: str
    gives: Literal["angle", "travel"]
    value: float


@dataclass(frozen=True)
class SpecialPoint:
    """The special point of a link, where the lines of two legs with these joints cross (Assur); or of a link relative
    to another that moves, ``base``; ``driven`` where a driver in a leg gives them different velocities there."""

    point: str
    link: str
    joints: tuple[str, str]
    base: str = ""
    driven: bool = False


@dataclass(frozen=True)
class PitchPoint:
    """The point where two wheels roll on each other, a point of both links."""

    point: str
    links: tuple[str, str]


OnMechanism = (
    FixedPoints | LaidOffAngle | LaidOffTravel | CompassArcs | PathDrawn | ArcOnPath | GuideThrough | GuideTouching
    | PathsCross | SlidToMeet | LinkPoints | HeldStill | PitchPoint | RollingStarts | SpecialPoint
    | TrialPositions
)  # fmt: skip


def mechanism_phrase(act: OnMechanism) -> Phrase:
    """An act in the mechanism as a sentence to be."""
    match act:
        case FixedPoints(frame, points):
            return Phrase("frame", (frame, ", ".join(points)))
        case LaidOffAngle(link, angle, hinge, to):
            key = "lay off angle to" if to else "lay off angle"
            return Phrase(key, (link, f"{math.degrees(angle):.6g}", hinge, to))
        case LaidOffTravel(pair, mm):
            return Phrase("lay off travel", (pair, on_paper(mm)))
        case CompassArcs(about, point, radii):
            return Phrase("arcs", (*about, point, *map(on_paper, radii)))
        case PathDrawn(point, pair):
            return Phrase("path", (point, pair))
        case ArcOnPath(about, point, mm):
            return Phrase("arc on path", (about, point, on_paper(mm)))
        case GuideThrough(pivot, through, pair):
            return Phrase("line of guide", (pivot, through, pair))
        case GuideTouching(pivot, through, mm, pair):
            return Phrase("tangent", (pivot, through, on_paper(mm), pair))
        case PathsCross(point, pairs):
            return Phrase("paths", (point, *pairs))
        case SlidToMeet(point, along, until):
            return Phrase("slide to meet", (point, along, until))
        case LinkPoints(link, points, transferred):
            return Phrase("transfer" if transferred else "points", (link, ", ".join(points)))
        case HeldStill(held, link, slide, gives, value):
            shown = math.degrees(value) if gives == "angle" else value
            return Phrase(f"held still {gives}", (held, link, slide, f"{shown:.6g}"))
        case PitchPoint(point, links):
            return Phrase("pitch point", (point, *links))
        case SpecialPoint(point, link, joints, base, driven):
            if base:
                key = "relative special point driven" if driven else "relative special point"
                return Phrase(key, (point, base, link, *joints))
            return Phrase("special point", (point, link, *joints))
        case RollingStarts(name, "angle", value):
            return Phrase("rolling starts at angle", (name, f"{math.degrees(value):.6g}"))
        case RollingStarts(name, _, value):
            return Phrase("rolling starts at travel", (name, on_paper(value)))
        case TrialPositions(links, driven, left_out, point, count, rolling):
            key = "trial positions" if point else "trial positions without curve"
            if rolling:
                key = "trial positions rolling and others" if left_out else "trial positions rolling"
            args = (links, driven, left_out, rolling)
            told = Phrase(key, (*(", ".join(names) for names in args[:3]), point, count, ", ".join(rolling)))
            for block, link, turned in act.instead:
                told = Phrase("driven in its stead", (told, block, link, f"{math.degrees(turned) + 0.0:.6g}"))
            return told
