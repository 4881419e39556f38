"""The tables of a scene file that ask for more than one answer, or say what others found: named positions, a table of
published values, how the problem varies for a class."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias

from graphkin.scene.file_table import FileTable, about, closed

if TYPE_CHECKING:
    from collections.abc import Sequence

    Text = str
    SlideRef = str
    Count = int
    Share = float
    PositionName = str
    ShownName = str | int
    Start: TypeAlias = "float | StrokeStart"
    Asked = int
    Least = float
    Part = float
    Symbols = Sequence[str]
    Range = Sequence[float]
    Keys = Sequence[str]
    KeyLists = Sequence[Sequence[str]]

__all__ = ["Level", "Positions", "PrintedTable", "StrokeStart", "Vary"]


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


Level = Literal["easy", "usual", "hard"]


@dataclass(frozen=True)
class Vary(FileTable):
    """How a set of problems is drawn from a scene."""

    ranges: dict[str, Range] = field(
        default_factory=dict,
        metadata=about("Least and greatest value by key of the scene: \"links.2.length\" = [80, 120]."),
    )
    only: bool = field(default=False, metadata=about("Nothing varies but what has a range or is tied to it."))
    keep: Keys = field(default=(), metadata=about("Keys that stay as they are: driver.omega."))
    ratios: KeyLists = field(
        default=(), metadata=about("Lists of keys that keep their ratios: the others follow the first.")
    )
    find: Symbols = field(default=(), metadata=about("Quantities of which each variant asks some."))
    ask: Asked | None = field(default=None, metadata=about("How many of them; all if left out."))
    level: Level = field(
        default="usual",
        metadata=about("easy: lines cross well, transmission is good; hard: the lines may cross flatter."),
    )
    crossing: Least | None = field(
        default=None, metadata=about("Degrees at which lines cross at least; that of the level if left out.")
    )
    transmission: Least | None = field(
        default=None, metadata=about("Least transmission angle of two bars at the position, degrees.")
    )
    pressure: Least | None = field(
        default=None, metadata=about("Greatest pressure angle of a slide at the position, degrees.")
    )
    tolerance: Part | None = field(
        default=None, metadata=about("Part of an answer that a drawing may miss it by at most; 0.05 if left out.")
    )
