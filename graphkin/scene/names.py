"""Which names a scene has, and whether what refers to them finds them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.errors import Problem, did_you_mean
from graphkin.scene.file_keys import KeyPath
from graphkin.scene.tables import SceneTables
from graphkin.words import Phrase

__all__ = ["Flaws", "Names"]


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
class Names:
    """The names of a file, the frame's included.

    ``points`` and ``guides`` are by link.  ``unsure`` are the links of which a wrong entry was taken out that may
    have held names, so that a name not found there is no second problem; "" stands for all links.
    """

    frame: str
    points: Mapping[str, tuple[str, ...]]
    guides: Mapping[str, frozenset[str]]
    unsure: frozenset[str]
    contacts: frozenset[str] = frozenset()

    @classmethod
    def of(cls, file: SceneTables, flaws: Flaws) -> Names:
        frame = file.frame.name
        lost = flaws.names("links")
        points = {name: tuple(dict.fromkeys((*link.points, *link.at, *sorted(flaws.names("links", name, "at")))))
                  for name, link in file.links.items()}
        guides = {name: frozenset(link.guides) | flaws.names("links", name, "guides")
                  for name, link in file.links.items()}
        points |= dict.fromkeys(lost, ())
        guides |= dict.fromkeys(lost, frozenset())
        if frame not in points:
            points[frame] = (*file.frame.points, *sorted(flaws.names("frame", "points")))
            guides[frame] = frozenset(file.frame.guides) | flaws.names("frame", "guides")
        harmless = {"length", "on", "angle_on", "redundant"}
        unsure = lost | {str(p[1]) for p in flaws.paths if p[0] == "links" and len(p) == 3 and p[2] not in harmless}
        if flaws.under("frame", "name") or any(p[0] == "frame" and len(p) == 2 for p in flaws.paths):
            unsure |= {frame, ""}
        if unsure:
            unsure |= {""}
        return cls(frame, points, guides, frozenset(unsure), frozenset(file.contacts) | flaws.names("contacts"))

    def no_link(self, where: str, name: str, moving: bool = False) -> Problem | None:
        """The problem of a link that does not exist, None if it does; ``moving`` where the frame would not do."""
        if name in self.points or ("" in self.unsure and self.frame in self.unsure):
            return None
        known = [link for link in self.points if not (moving and link == self.frame)]
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
