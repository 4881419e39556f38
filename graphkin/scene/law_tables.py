"""The tables of a scene file that say how a driver moves over the time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from graphkin.scene.cam_tables import LawName
from graphkin.scene.file_table import FileTable, about

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import TypeAlias

    Number = float
    Magnitude = float
    TimePieces: TypeAlias = "Sequence[TimePiece]"
    Knots: TypeAlias = "Sequence[Sequence[float]]"

__all__ = ["DriverLaw", "TimePiece"]


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
