"""The tables of a scene file that say what touches, and by which laws something moves: round outlines, contacts, wheels
with teeth; followers of cams (with base circle and allowed pressure angles), drivers over the time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from graphkin.scene.cams import SPELLINGS
from graphkin.scene.file_table import FileTable, about

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import TypeAlias

    Number = float
    Switch = bool
    LinkName = str
    PointName = str
    TwoOutlines = Sequence[str]
    TwoTeeth = Sequence[float | str]
    Magnitude = float
    LawPieces: TypeAlias = "Sequence[LawPiece]"
    TimePieces: TypeAlias = "Sequence[TimePiece]"
    Knots: TypeAlias = "Sequence[Sequence[float]]"

__all__ = ["AllowedPressure", "BaseCircle", "Cam", "Contact", "Disc", "DriverLaw", "Gear", "LawPiece", "TimePiece"]


@dataclass(frozen=True)
class Disc(FileTable):
    """A round outline that a link carries."""

    centre: PointName = field(metadata=about("A point of the link."))
    r: Number = field(metadata=about("Its radius; negative: hollow, the body lies outside (a ring)."))


@dataclass(frozen=True)
class Contact(FileTable):
    """Two outlines that touch."""

    between: TwoOutlines = field(
        metadata=about('Two discs ("1.k", "2.w"), or a disc and a straight guide (a flat face: "1.k", "2.f").')
    )
    side: Literal["left", "right", "outside", "inside"] | None = field(
        default=None,
        metadata=about("Of a face: the side of the directed guide on which the disc lies, left if left out. "
                       "Of two discs: outside (if left out), or inside, the smaller in the larger."),
    )
    rolling: Switch = field(default=False, metadata=about("true: rolls without slip; false: slides."))


@dataclass(frozen=True)
class Gear(FileTable):
    """Two wheels with teeth, or a wheel and a rack."""

    between: TwoOutlines = field(metadata=about('The two wheels ("2", "4"); a rack, second, or a guide of it ("3.r").'))
    teeth: TwoTeeth = field(metadata=about('Numbers of teeth; negative: internal teeth; "rack" for the second.'))
    carrier: LinkName | None = field(
        default=None,
        metadata=about("The link that holds both axes (the wheel's axis and the rack's slide); found if left out."),
    )


if TYPE_CHECKING:
    LawName = Literal["uniform", "parabolic", "harmonic", "cycloidal", "345", "4567"] | str
else:
    LawName = Literal[SPELLINGS]  # as many as there are laws


@dataclass(frozen=True)
class LawPiece(FileTable):
    """A piece of the law of a follower, from where the piece before it ends: a rise, a fall, or a dwell."""

    to: Number = field(metadata=about("Degrees of the cam at which it ends; the last piece ends at 360."))
    rise: Number | None = field(
        default=None, metadata=about("By how much the follower rises: length, or degrees of one that swings.")
    )
    fall: Number | None = field(default=None, metadata=about("Instead of rise: by how much it falls."))
    by: LawName | None = field(default=None, metadata=about("The law of a rise or fall."))


@dataclass(frozen=True)
class BaseCircle(FileTable):
    """The base circle of a cam."""

    r: Magnitude = field(metadata=about("Its radius."))
    of: Literal["profile", "pitch"] = field(
        default="profile", metadata=about("Of the profile, or of the pitch curve, on which the roller's centre runs.")
    )


@dataclass(frozen=True)
class AllowedPressure(FileTable):
    """Greatest pressure angles that are allowed."""

    rise: Number | None = field(default=None, metadata=about("Degrees, while the follower rises."))
    fall: Number | None = field(default=None, metadata=about("Degrees, while it falls."))


@dataclass(frozen=True)
class Cam(FileTable):
    """A cam that turns about its first point, given by the law of its follower."""

    follower: LinkName = field(
        metadata=about("The link that it moves: on a guide of the frame, or swinging about a point of the frame.")
    )
    law: LawPieces = field(metadata=about('Pieces of the law: [{ to = 60, rise = 28, by = "harmonic" }, ...].'))
    base: BaseCircle = field(metadata=about('The base circle: { r = 30, of = "profile" }.'))
    sense: Literal[1, -1] = field(
        default=1, metadata=about("The cam degree is sense times the cam's own angle; -1: a cam that turns clockwise.")
    )
    offset: Number | None = field(
        default=None,
        metadata=about("Distance of a sliding follower's line from the axis, positive where the axis is to its left."),
    )
    roller: Magnitude | None = field(default=None, metadata=about("Radius of the roller; a knife edge if left out."))
    flat: Switch = field(default=False, metadata=about("A flat face square to the line of a sliding follower."))
    allow: AllowedPressure | None = field(default=None, metadata=about("Greatest pressure angles, judged."))


@dataclass(frozen=True)
class TimePiece(FileTable):
    """A piece of the law of a driver, from where the piece before it ends: a rise, a fall, or a dwell."""

    to: Number = field(metadata=about("Seconds at which it ends."))
    rise: Number | None = field(default=None, metadata=about("By how much the driver's value grows: degrees, travel."))
    fall: Number | None = field(default=None, metadata=about("Instead of rise: by how much it falls."))
    by: LawName | None = field(default=None, metadata=about("The law of a rise or fall."))


@dataclass(frozen=True)
class DriverLaw(FileTable):
    """How a driver moves over the time, from 0 s on: by one law, by several one after the other, or by a table."""

    origin: Number | None = field(
        default=None, metadata=about("The driver's value at 0 s: degrees, or travel.", alias="from")
    )
    to: Number | None = field(default=None, metadata=about("The driver's value at the end."))
    rise: Number | None = field(
        default=None, metadata=about("Instead of to: by how much the value grows; negative where it falls.")
    )
    duration: Magnitude | None = field(default=None, metadata=about("Seconds from the beginning to the end."))
    by: LawName | None = field(default=None, metadata=about("The law by which it goes from one to the other."))
    pieces: TimePieces = field(
        default=(), metadata=about('Several, with dwells: [{ to = 0.5, rise = 90, by = "cycloidal" }, { to = 0.8 }].')
    )
    table: Knots = field(
        default=(),
        metadata=about("Instead of laws: [[time, value], ...], joined by a cubic without acceleration at its ends."),
    )
