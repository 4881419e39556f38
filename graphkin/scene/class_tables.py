"""The tables of a scene file that are for a class: how its problem may vary, and for what there are points."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from graphkin.scene.file_table import FileTable, about, closed

if TYPE_CHECKING:
    from collections.abc import Sequence

    Asked = int
    Symbols = Sequence[str]
    Range = Sequence[float]
    Keys = Sequence[str]
    KeyLists = Sequence[Sequence[str]]

__all__ = ["Level", "Vary"]

Level = Literal["easy", "usual", "hard"]


@dataclass(frozen=True)
class Vary(FileTable):
    """How a set of problems is drawn from a scene."""

    ranges: dict[str, Range] = field(
        default_factory=dict,
        metadata=closed("Least and greatest value by key of the scene: \"links.2.length\" = [80, 120]."),
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
