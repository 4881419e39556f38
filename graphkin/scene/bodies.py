"""The bodies of a scene file: the frame and the moving links, their points, guides and round outlines; pins in slots;
and the reading of a file by them: which names it has, whether what refers to them finds them, and what was found wrong.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Tag

from graphkin.errors import Problem, did_you_mean
from graphkin.scene.tables import (
    FileTable,
    GuideRefs,
    KeyPath,
    LinkName,
    Magnitude,
    NameOrPlace,
    Number,
    Numbers,
    Place,
    PointName,
    PointNames,
    Switch,
    TwoLengths,
    TwoPoints,
    Units,
    file_table,
    forms,
    key,
)
from graphkin.words import Phrase, Wording

__all__ = ["Compass", "Disc", "Flaws", "Frame", "Guide", "Link", "Pin", "Polar", "Reading", "references"]


@file_table
class Polar(FileTable):
    """A point at a distance and an angle from another point of the link."""

    origin: PointName = key("The point of the link from which r is measured.", name="from")
    r: Magnitude = key("Distance.", unit="length")
    angle: Number = key("Degrees from the link's own x axis, or from the direction given by toward.", default=0.0)
    toward: PointName | None = key("The point of the link at which angle is 0.", default=None)


@file_table
class Compass(FileTable):
    """A point by its distances from two others of the link: the corner of a plate by its sides."""

    origins: TwoPoints = key("The two points of the link.", name="from")
    r: TwoLengths = key("The two distances.", unit="length")
    side: Literal["left", "right"] = key("Side of the directed line from the first to the second.")


FramePlace = Annotated[
    Annotated[Place, Tag("<list>")] | Annotated[Polar, Tag("<polar>")] | Annotated[Compass, Tag("<compass>")],
    forms("write x y from a r 400 angle"),
]
At = Annotated[
    Annotated[Place, Tag("<list>")]
    | Annotated[Polar, Tag("<polar>")]
    | Annotated[Compass, Tag("<compass>")]
    | Annotated[Literal["drawn"], Tag("<name>")],
    forms("write x y from c r 65 angle"),
]


@file_table
class Guide(FileTable):
    """A straight guide: any point of it and its direction; or a slot along a circle: its centre and radius."""

    through: NameOrPlace | None = key(
        "A point of the link by name, or [x, y] in the link's own axes.", unit="length", default=None
    )
    angle: Number | None = key("Direction in degrees from the link's own x axis.", default=None)
    toward: PointName | None = key(
        "Instead of angle: the point that the guide points to (of the link, fixed or drawn).", default=None
    )
    centre: NameOrPlace | None = key(
        "Of a circular slot: a point of the link, or [x, y] in the link's own axes.", unit="length", default=None
    )
    r: Magnitude | None = key("Radius of a circular slot.", unit="length", default=None)
    ends: Place | None = key(
        "Where a circular slot is drawn: from one to the other, degrees from the link's own x axis.", unit="angle",
        default=None,
    )  # fmt: skip


@file_table
class Disc(FileTable):
    """A round outline that a link carries."""

    centre: PointName = key("A point of the link.")
    r: Number = key("Its radius; negative: hollow, the body lies outside (a ring).", unit="length")


@file_table
class Frame(FileTable):
    """The fixed link."""

    name: LinkName = key('Name of the fixed link, "0" if not given.', default="0")
    points: dict[PointName, FramePlace] = key(
        "Fixed pivots, [x, y] each, or polar from another, or by the distances from two others.", unit="length",
        closed=True, default_factory=dict,
    )  # fmt: skip
    guides: dict[LinkName, Guide] = key("Straight guides by name.", closed=True, default_factory=dict)
    discs: dict[LinkName, Disc] = key("Round outlines by name.", closed=True, default_factory=dict)


@file_table
class Link(FileTable):
    """A moving link."""

    points: PointNames = key(
        "Own points: two for a bar, one for a bar of no fixed length or a block, or none.", default=()
    )
    length: Magnitude | None = key("Distance of the two own points.", unit="length", default=None)
    on: GuideRefs | None = key(
        'What the link slides on: "3" (own axis of link 3), "6.h" (a guide), or two of them.', default=None
    )
    angle_on: Numbers | None = key(
        "Degrees from the guide to the link's own x axis; one number for each guide.", default=None
    )
    at: dict[PointName, At] = key("Further points.", unit="length", closed=True, default_factory=dict)
    guides: dict[LinkName, Guide] = key("Straight guides by name.", closed=True, default_factory=dict)
    discs: dict[LinkName, Disc] = key("Round outlines by name.", closed=True, default_factory=dict)
    start: Number | None = key(
        "Where rolling leaves it open: degrees of its own axis (of a link with on, its travel) at the "
        "scene's own driver value; 0 if left out.", default=None,
    )  # fmt: skip
    redundant: Switch = key("The link only repeats what others already hold.", default=False)

    @property
    def guide_refs(self) -> list[str]:
        """What it slides on."""
        return _as_list(self.on)


@file_table
class Pin(FileTable):
    """A pin that runs in slots."""

    of: LinkName = key("The link that has the pin.")
    slots: GuideRefs = key('The guide it runs in ("3.s"), or a list of guides.', name="in")

    @property
    def guide_refs(self) -> list[str]:
        """What it runs in."""
        return _as_list(self.slots)


def _as_list(refs: str | Sequence[str] | None) -> list[str]:
    """Names of guides, written alone or in a list."""
    return [] if refs is None else [refs] if isinstance(refs, str) else list(refs)


def references(entry: object) -> tuple[str, ...]:
    """The points of a link from which one is placed."""
    if isinstance(entry, Polar):
        return (entry.origin,) if entry.toward is None else (entry.origin, entry.toward)
    return tuple(entry.origins) if isinstance(entry, Compass) else ()


@dataclass(frozen=True)
class Flaws:
    """The paths of the entries that were reported and taken out of the file."""

    paths: frozenset[KeyPath] = frozenset()

    def under(self, *prefix: str) -> bool:
        """True where something at or under this path, or a table that holds it, was taken out."""
        n = len(prefix)
        return any(p[:n] == prefix or p == prefix[: len(p)] for p in self.paths)

    def names(self, *table: str) -> set[str]:
        """The names of the entries of a table that were taken out as a whole."""
        n = len(table)
        return {str(p[n]) for p in self.paths if len(p) == n + 1 and p[:n] == table}


@dataclass(frozen=True)
class Reading:
    """A file under reading, the names in it, and the problems found so far, to which each reader adds its own.

    ``points`` and ``guides`` are by link, the frame's included.  ``unsure`` are the links of which a wrong entry was
    taken out that may have held names, so that a name not found there is no second problem; "" stands for all links.
    """

    frame: Frame
    links: Mapping[str, Link]
    units: Units
    flaws: Flaws
    problems: list[Problem]
    points: Mapping[str, tuple[str, ...]]
    guides: Mapping[str, frozenset[str]]
    contacts: frozenset[str]
    unsure: frozenset[str]

    @classmethod
    def of(
        cls, frame: Frame, links: Mapping[str, Link], contacts: Mapping[str, object], units: Units, flaws: Flaws,
        problems: list[Problem],
    ) -> Reading:  # fmt: skip
        """The reading of a file by what is valid in it, what was taken out, and what was found wrong with its form."""
        lost = flaws.names("links")
        points = {name: tuple(dict.fromkeys((*link.points, *link.at, *sorted(flaws.names("links", name, "at")))))
                  for name, link in links.items()}
        guides = {name: frozenset(link.guides) | flaws.names("links", name, "guides") for name, link in links.items()}
        points |= dict.fromkeys(lost, ())
        guides |= dict.fromkeys(lost, frozenset())
        if frame.name not in points:
            points[frame.name] = (*frame.points, *sorted(flaws.names("frame", "points")))
            guides[frame.name] = frozenset(frame.guides) | flaws.names("frame", "guides")
        harmless = {"length", "on", "angle_on", "redundant"}
        unsure = lost | {str(p[1]) for p in flaws.paths if p[0] == "links" and len(p) == 3 and p[2] not in harmless}
        if flaws.under("frame", "name") or any(p[0] == "frame" and len(p) == 2 for p in flaws.paths):
            unsure |= {frame.name, ""}
        if unsure:
            unsure |= {""}
        touching = frozenset(contacts) | flaws.names("contacts")
        return cls(frame, links, units, flaws, problems, points, guides, touching, frozenset(unsure))

    @property
    def metres(self) -> float:
        """One length unit of the file in m."""
        return self.units.metres

    @property
    def bodies(self) -> list[tuple[str, str, Frame | Link]]:
        """Every link, the frame last: its place in the file, its name, its table."""
        moving = [(f"links.{name}", name, link) for name, link in self.links.items()]
        return [*moving, ("frame", self.frame.name, self.frame)]

    def say(self, where: Wording, found: Wording, wanted: Wording) -> None:
        """Note a problem."""
        self.problems.append(Problem(where, found, wanted))

    def wrong(self, *problems: Problem | None) -> bool:
        """Note what of these is a problem; whether there is one."""
        there = [problem for problem in problems if problem is not None]
        self.problems.extend(there)
        return bool(there)

    def no_link(self, where: str, name: str, moving: bool = False) -> Problem | None:
        """The problem of a link that does not exist, None if it does; ``moving`` where the frame would not do."""
        if name in self.points or ("" in self.unsure and self.frame.name in self.unsure):
            return None
        known = [link for link in self.points if not (moving and link == self.frame.name)]
        return Problem(where, Phrase("there is no link", name=name), did_you_mean(name, known))

    def no_point(self, where: str, point: str) -> Problem | None:
        """The problem of a point that no link has."""
        everywhere = {p for own in self.points.values() for p in own} | self.contacts
        if point in everywhere or "" in self.unsure:
            return None
        return Problem(where, Phrase("no link has a point", point=point), did_you_mean(point, everywhere))

    def no_point_of(self, where: str, link: str, point: str) -> Problem | None:
        """The problem of a point that this link does not have."""
        own = self.points.get(link, ())
        if point in own or link in self.unsure:
            return None
        return Problem(where, Phrase("is nowhere placed on link", point=point, link=link), did_you_mean(point, own))

    def no_guide(self, where: str, ref: str) -> Problem | None:
        """The problem of a guide LINK or LINK.GUIDE that does not exist."""
        link, _, guide = ref.partition(".")
        missing = self.no_link(where, link)
        if missing or not guide or link in self.unsure or guide in self.guides.get(link, ()):
            return missing
        own = self.guides.get(link, frozenset())
        hint = did_you_mean(guide, own) if own else Phrase("its own axis is the guide", link=link)
        return Problem(where, Phrase("link has no guide", link=link, guide=guide), hint)
