"""The letters that end points bear in the polygons of one sheet in one convention, and names of bars in its letters."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters, pole
from graphkin.drawing.parts.polygon_on_page import SAME, NamedPoint, PolygonOnPage, named_points
from graphkin.scene.symbol import PointRef

__all__ = ["EndLetters", "Markup", "names_in_letters"]

EVERYWHERE = Box(-math.inf, -math.inf, math.inf, math.inf)
_POINT = r"[A-Z][a-z]*\d*"
_POINT_NAMES = re.compile(f"(?:{_POINT})+")


class Markup(str):
    """A symbol in the notation of `graphkin.drawing.text`."""


def names_in_letters(letters: Letters, text: str) -> list[str] | None:
    """A list of points or bars, ``O4A, B``, each in the letters of a convention; None where it is none."""
    names = text.split(", ")
    if not all(map(_POINT_NAMES.fullmatch, names)):
        return None
    return ["".join(letters.point(name) for name in re.findall(_POINT, bar)) for bar in names]


@dataclass(frozen=True)
class EndLetters:
    """End points by their letters; where the convention names vectors instead, none but the pole has one."""

    sheet: Sheet
    letters: Letters

    def at(self, diagram: DiagramName, at: complex | None) -> Markup | None:
        """The letter of a place of a polygon."""
        points = self._points.get(diagram, ())
        letter = next((p.letter for p in points if at is not None and abs(p.at - at) <= SAME), "")
        return Markup(letter) if letter else None

    def place(self, diagram: DiagramName, ref: PointRef) -> complex | None:
        """Where an end point lies (mm from the pole)."""
        point = self._named(diagram, ref)
        return None if point is None else point.at

    def of(self, diagram: DiagramName, ref: PointRef) -> Markup | None:
        """The letter of an end point; what is at rest is the pole."""
        if ref.point in self.sheet.scene.frame.points and ref.link in ("", self.sheet.scene.frame.name):
            return Markup(pole(self.letters.convention, diagram))
        point = self._named(diagram, ref)
        return None if point is None else Markup(point.letter)

    def _named(self, diagram: DiagramName, ref: PointRef) -> NamedPoint | None:
        # where coincident points are told apart the point alone is that of its block
        refs = (ref, PointRef(ref.point)) if self.letters.blocks.get(ref.point) == ref.link else (ref,)
        return next((p for one in refs for p in self._points.get(diagram, ()) if p.ref == one), None)

    @cached_property
    def _points(self) -> Mapping[DiagramName, tuple[NamedPoint, ...]]:
        diagrams: tuple[DiagramName, ...] = ("velocity", "acceleration")
        pages = {d: PolygonOnPage(self.sheet, d, self.letters, "en", EVERYWHERE, 0j, ()) for d in diagrams}
        return {diagram: named_points(page) for diagram, page in pages.items()}
