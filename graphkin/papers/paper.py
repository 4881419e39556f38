"""The paper of a handout: its size, the space between its margins, and the scales that suit it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from graphkin.construction import Plan, Room, plan
from graphkin.construction.board.scales import Scales
from graphkin.drawing.box import Box
from graphkin.errors import CallError, Problem
from graphkin.scene.model import Mechanism
from graphkin.scene.scene_tables import DIAGRAMS, PAPERS
from graphkin.scene.symbol import Symbol
from graphkin.structure import Structure
from graphkin.words import Phrase

SIDE, TOP, BOTTOM = 15.0, 13.0, 15.0  # mm, margins
CAPTION = 7.0  # mm that a line under a figure takes
HEAD = 22.0  # mm for a heading and the lines under it
BESIDE = 36.0  # mm around a mechanism, for names, dimensions and its scale
AROUND = 32.0  # mm around a polygon that is still to be drawn, and between both
LEAST_WIDE = 90.0  # mm of a frame, for its check bar
LEAST_DRAWN = 70.0  # mm of a figure that a pencil draws well
PARTS = (0.85, 0.75, 0.65, 0.55, 0.48)
COLUMN = 92.0  # mm: a column of words beside a figure, with the gap between them


@dataclass(frozen=True)
class Paper:
    """A sheet of paper in reading position (mm)."""

    width: float
    height: float

    @property
    def body(self) -> Box:
        """The space of a page between its margins, with a caption below it."""
        return Box(0.0, 0.0, self.width - 2 * SIDE, self.height - TOP - BOTTOM - CAPTION)

    @property
    def facing(self) -> Paper:
        """Two such pages side by side, or above each other if they are wide: the next larger paper."""
        upright = self.height >= self.width
        return Paper(2 * self.width, self.height) if upright else Paper(self.width, 2 * self.height)

    @property
    def folded(self) -> bool:
        """Whether a page is set as two smaller ones beside each other."""
        return self.width > self.height

    @property
    def narrow(self) -> float:
        """The greatest width of a figure with words beside it."""
        return self.body.width - COLUMN

    def room(self, on_a4: Room, part: float = 1.0) -> Room:
        """A room in proportion to this paper as the given one, or a part of it, to A4."""
        wide, high = part * self.body.width / A4.body.width, part * self.body.height / A4.body.height
        mechanism, polygon = ((x * wide, y * high) for x, y in (on_a4.mechanism, on_a4.polygon))
        return Room(mechanism, polygon)


FILLED = Room()  # what figures are to fill at scales that the scene does not give
MOST = Room((160.0, 180.0), (157.0, 190.0))  # what they may fill, under a heading in two languages
A4 = Paper(*PAPERS["A4"])
PaperName: TypeAlias = Literal["A5", "A4", "A3", "A2", "A1", "A0"]
LARGER: tuple[PaperName, ...] = ("A4", "A3", "A2", "A1")


def paper_of(scene: Mechanism) -> Paper:
    """The paper that a scene asks for."""
    return Paper(*scene.question.sheet.size)


NAMES = ("length", "velocity", "acceleration")


def _mixed(first: Scales, kept: Mapping[str, object], second: Scales) -> Scales:
    """The scales of kept figures from the first, the others from the second."""
    return Scales(*(getattr(first if kept[name] else second, name) for name in NAMES))


def paper_plan(
    of: Mechanism | Structure, values: Mapping[str, float] | None, asked: Sequence[Symbol], share: bool = True
) -> Plan:
    """The plan of the drawing: at the scales that the scene wishes, on a larger paper if necessary, else at scales that
    fit; with ``share`` mechanism and polygon are on one page if they stay large enough.  Quantities asked of another
    position ("v_C at 10") are left out.

    Raises
    ------
    CallError : all quantities are asked of other positions
    """
    here = tuple(symbol for symbol in asked if not symbol.at)
    if asked and not here:
        raise CallError(*(Problem(f"find {symbol}", Phrase("papers are of one position"),
                                  Phrase("take that position", symbol=symbol.here, position=symbol.at))
                          for symbol in asked))
    fitted = plan(of, values, here)
    scene = fitted.structure.scene
    paper = paper_of(scene)
    wished = {name: getattr(scene.question.sheet, f"{name}_scale") for name in NAMES}
    if paper != A4:
        filled = fitted.exact.scales_for(paper.room(FILLED))
        fitted = replace(fitted, scales=_mixed(fitted.scales, wished, filled))
    fits = _fits(fitted, paper)
    if not all(fits.values()):
        larger = _larger(fitted, paper, wished)
        if larger is not None:
            whole = of if isinstance(of, Mechanism) else of.scene
            return paper_plan(whole.asking(sheet=replace(whole.question.sheet, paper=larger)), values, asked, share)
        roomed = fitted.exact.scales_for(paper.room(MOST))
        fitted = replace(fitted, scales=_mixed(fitted.scales, fits, roomed))
    return _sharing(fitted, paper, wished) if share else fitted


def _sharing(whole: Plan, paper: Paper, wished: Mapping[str, float | None]) -> Plan:
    """The plan at scales that let the mechanism share a page with each polygon, since directions are carried over, if
    the scene leaves them open and the figures stay large enough for a pencil; else unchanged."""
    if _share(whole, paper):
        return whole
    for part in PARTS:
        both = whole.scales, whole.exact.scales_for(paper.room(FILLED, part))
        coarser = (max(getattr(scales, name) for scales in both[: 1 if wished[name] else 2]) for name in NAMES)
        tried = replace(whole, scales=Scales(*coarser))
        if _share(tried, paper):
            sizes = zip(_sizes(tried), _sizes(whole), strict=True)
            return tried if all(max(less) >= min(LEAST_DRAWN, max(size)) for less, size in sizes) else whole
    return whole


def _sizes(planned: Plan) -> list[tuple[float, float]]:
    """Width and height (mm) of the mechanism and of both polygons."""
    pairs = ((planned.exact.extents[diagram], planned.scales.of(diagram)) for diagram in DIAGRAMS)
    return [(width / per, height / per) for (width, height), per in pairs]


def _share(planned: Plan, paper: Paper) -> bool:
    """Whether the mechanism, with its dimensions, fits beside or above each polygon."""
    (wide, high), *polygons = _sizes(planned)
    wide, high, body = wide + BESIDE, high + BESIDE, paper.body
    for across, up in polygons:
        across, up = max(across + AROUND, LEAST_WIDE), up + AROUND
        beside = wide + across <= body.width and max(high, up) <= body.height - HEAD
        if not beside and (max(wide, across) > body.width or high + up > body.height - HEAD):
            return False
    return True


def _fits(planned: Plan, paper: Paper) -> dict[str, bool]:
    """Whether each of the three figures fits the paper."""
    most = paper.room(MOST)
    rooms = zip(NAMES, _sizes(planned), (most.mechanism, most.polygon, most.polygon), strict=True)
    return {name: size[0] <= room[0] and size[1] <= room[1] for name, size, room in rooms}


def _larger(planned: Plan, paper: Paper, wished: Mapping[str, float | None]) -> PaperName | None:
    """The next paper on which the figures at the wished scales fit, None where they fit already or on no paper."""

    def serves(size: Paper) -> bool:
        return all(fit or wished[name] is None for name, fit in _fits(planned, size).items())

    if serves(paper):
        return None
    for name in LARGER:
        size = PAPERS[name]
        turned = Paper(*(size if paper.height >= paper.width else size[::-1]))
        if size[0] > min(paper.width, paper.height) and serves(turned):
            return name
    return None
