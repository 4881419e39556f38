"""The tables of a scene file that say what touches: round outlines, contacts, and wheels with teeth."""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING, Literal

from graphkin.frozen import dataclass
from graphkin.scene.file_table import FileTable, about

if TYPE_CHECKING:
    from collections.abc import Sequence

    Number = float
    Switch = bool
    LinkName = str
    PointName = str
    TwoOutlines = Sequence[str]
    TwoTeeth = Sequence[float | str]

__all__ = ["Contact", "Disc", "Gear"]


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
