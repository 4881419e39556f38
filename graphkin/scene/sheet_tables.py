"""The tables of a scene file that wish something of the drawn sheet: paper, scales, letters, tools, a picture below."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from graphkin.scene.file_table import FileTable, about, closed

if TYPE_CHECKING:
    from collections.abc import Sequence

    Magnitude = float
    Tool = float
    Text = str
    Language = str
    PointName = str
    EndName = str
    Place = Sequence[float]

__all__ = ["PAPERS", "Background", "Convention", "ReadScan", "SheetWishes", "Tools"]

Convention = Literal["chinese", "us", "british", "russian"]


@dataclass(frozen=True)
class Tools(FileTable):
    """What the tools of a pencil drawing can do; used with --instrument pencil.

    A step is that to which a value is read or laid off; the others are standard deviations.
    """

    line_width: Tool = field(
        default=0.2, metadata=about("Width of a pencil line (mm); a point is pricked within half of it.")
    )
    ruler: Tool = field(default=0.1, metadata=about("Step of the ruler (mm): 0.5, or 0.1 interpolated."))
    compass: Tool = field(default=0.1, metadata=about("Standard deviation of a compass radius (mm)."))
    set_square: Tool = field(default=0.1, metadata=about("Standard deviation of a direction set (degrees)."))
    protractor: Tool = field(default=0.5, metadata=about("Step of the protractor (degrees)."))


PAPERS = {
    "A5": (148.0, 210.0), "A4": (210.0, 297.0), "A3": (297.0, 420.0), "A2": (420.0, 594.0), "A1": (594.0, 841.0),
    "A0": (841.0, 1189.0),
}  # fmt: skip


@dataclass(frozen=True)
class Background(FileTable):
    """A photograph or scan to lie under the mechanism."""

    file: Text = field(metadata=about("A PNG or JPEG, by its path from the scene file."))
    points: dict[PointName, Place] = field(
        metadata=closed("Two points of the frame or of [drawn], with their pixels [x, y] from the left upper corner.")
    )


@dataclass(frozen=True)
class ReadScan(FileTable):
    """A drawing that somebody made of a figure, with what was read off the scan of it, in pixels."""

    points: dict[EndName, Place] = field(
        metadata=about(
            "Two ends that lie right, and so set scale and direction: of a polygon pole, B, B@3 or the symbol of a "
            "part whose tip it is (an_C/B); of the mechanism points. Pixels [x, y] from the left upper corner."
        )
    )
    read: dict[EndName, Place] = field(metadata=about("The other ends as they were read off, in pixels."))
    file: Text | None = field(
        default=None, metadata=about("The scan itself, under the exact figure: PNG or JPEG, from the scene file.")
    )
    within: Magnitude = field(
        default=0.01, metadata=about("What a line may be off, as a part of the longest: 0.01 if left out.")
    )


@dataclass(frozen=True)
class SheetWishes(FileTable):
    """Wishes for the drawn sheet; scales are None where graphkin is to choose."""

    paper: Literal["A5", "A4", "A3", "A2", "A1", "A0"] = "A4"
    orientation: Literal["portrait", "landscape"] = "portrait"
    length_scale: Magnitude | None = field(default=None, metadata=about("mm of mechanism per mm of paper."))
    velocity_scale: Magnitude | None = field(default=None, metadata=about("Units of speed per mm of paper."))
    acceleration_scale: Magnitude | None = field(default=None, metadata=about("(unit of speed/s) per mm of paper."))
    force_scale: Magnitude | None = field(default=None, metadata=about("Force units per mm of paper."))
    loops: bool = field(default=False, metadata=about("Vector loops as a further page of the sheet."))
    convention: Convention = "chinese"
    language: Language = "en"
    tools: Tools = field(default=Tools(), metadata=about("Tools of a pencil drawing.", alias="instrument"))
    background: Background | None = field(
        default=None, metadata=about("A photograph or scan under the mechanism, at true scale.")
    )

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the paper (mm, ISO 216)."""
        short, long = PAPERS[self.paper]
        return (long, short) if self.orientation == "landscape" else (short, long)
