"""What touches in a mechanism: round outlines, sliding and rolling contacts, wheels with teeth.

A hollow outline (a ring) has a negative radius.  With the signs of the radii two discs touch, inside or outside, where
their centres are r1 + r2 apart, and the point of contact parts the line of centres as r1 : r2.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["PlacedContact", "PlacedDisc", "PlacedGear"]


@dataclass(frozen=True)
class PlacedDisc:
    """A round outline of link ``link`` about its point ``centre``; ``radius`` (m) is negative for a hollow one."""

    link: str
    name: str
    centre: str
    radius: float


@dataclass(frozen=True)
class PlacedContact:
    """Two outlines that touch in ``name``.

    ``one`` and ``two`` are the links in the order of the file.  ``discs`` are their outlines, None for the side that
    has the flat face, whose ``guide`` it is; radii bear the signs with which they meet (inside: the larger is hollow).
    ``left`` tells on which side of the guide the disc lies.  ``carrier`` is the link that holds both centres of a
    rolling pair, "" where no link does.  ``again`` marks a further contact of the same centre with the same link.
    """

    name: str
    one: str
    two: str
    discs: tuple[PlacedDisc | None, PlacedDisc | None]
    guide: str
    left: bool
    rolling: bool
    carrier: str = ""
    again: bool = False

    @property
    def links(self) -> tuple[str, str]:
        """Both links, in the order of the file."""
        return self.one, self.two

    @property
    def flat(self) -> bool:
        """Whether one side is a flat face."""
        return None in self.discs

    @property
    def round(self) -> tuple[PlacedDisc, ...]:
        """The discs."""
        return tuple(d for d in self.discs if d is not None)

    @property
    def face(self) -> str:
        """The link with the flat face, "" where there is none."""
        return (self.one if self.discs[0] is None else self.two) if self.flat else ""

    @property
    def block(self) -> str:
        """The name of the block (of a face) or the bar (of two discs) that replaces it."""
        if not self.flat:
            return "".join(d.centre for d in self.round)
        return f"{self.name if self.again else self.round[0].centre}/{self.face}"

    @property
    def normal_to_face(self) -> complex:
        """The direction from the face to the disc, counted from the guide's sense."""
        return 1j if self.left else -1j


@dataclass(frozen=True)
class PlacedGear:
    """Two wheels with teeth: pitch circles that roll on each other, their axes held by ``carrier``.

    ``teeth`` are numbers with signs (negative: internal), None for a rack; ``axes`` the points of the wheels' axes on
    the carrier (and on the wheels), "" for a rack, whose pitch line is ``guide`` of the second link and whose sliding
    pair with the carrier is ``slide``.
    """

    name: str
    wheels: tuple[str, str]
    teeth: tuple[float, float | None]
    carrier: str
    axes: tuple[str, str]
    guide: str = ""
    slide: str = ""

    @property
    def is_rack(self) -> bool:
        return self.teeth[1] is None
