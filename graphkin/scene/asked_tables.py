"""The tables of a scene file that ask for more than one position, or say what others found: named positions, a table of
published values."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias

from graphkin.scene.file_table import FileTable, about, closed

if TYPE_CHECKING:
    Text = str
    SlideRef = str
    Count = int
    Share = float
    PositionName = str
    ShownName = str | int
    Start: TypeAlias = "float | StrokeStart"

__all__ = ["Positions", "PrintedTable", "StrokeStart"]


@dataclass(frozen=True)
class StrokeStart(FileTable):
    """A place on the stroke of a slide."""

    stroke: SlideRef = field(metadata=about('The sliding pair: "5/6".'))
    at: Share = field(default=0.0, metadata=about("Part of the stroke that is done, 0 to 1."))
    sense: Literal[1, -1] = field(
        default=1, metadata=about("1: of the stroke that goes along the guide's sense, -1: against it.")
    )


@dataclass(frozen=True)
class Positions(FileTable):
    """Positions with names."""

    count: Count | None = field(
        default=None, metadata=about("So many positions over a turn, numbered from 1 in the sense of the driver.")
    )
    first: Start | None = field(
        default=None, metadata=about("Position 1: a driver value, or the start of a stroke; the driver's own value.")
    )
    also: dict[PositionName, Start] = field(
        default_factory=dict, metadata=closed("Further positions by name, each a driver value or a place of a stroke.")
    )
    show: tuple[ShownName, ...] = field(
        default=("limits", "all"), metadata=about('On the figure: "limits", "all", or names of positions.')
    )
    marks: tuple[Literal["theta", "stroke", "K", "gamma"], ...] = field(
        default=("theta", "stroke", "K", "gamma"), metadata=about("What is drawn and dimensioned there.")
    )


@dataclass(frozen=True)
class PrintedTable(FileTable):
    """A table of published values in a file beside the scene."""

    file: Text = field(metadata=about("A CSV file: heads are symbols, one column is called at."))
    by: Literal["drawing", "computation"] = field(
        default="drawing", metadata=about("How the values were found; computed ones are judged by their digits.")
    )
