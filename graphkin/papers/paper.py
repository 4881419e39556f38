"""The paper of a handout: its size, what fits between its margins, and the scales that suit it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from graphkin.construction import Plan, Room, execute, plan
from graphkin.construction.sheet import Scales
from graphkin.drawing.box import Box
from graphkin.drawing.polygon_on_page import extent
from graphkin.scene.model import Mechanism
from graphkin.scene.sheet_tables import PAPERS
from graphkin.scene.symbol import Symbol
from graphkin.structure import Structure

__all__ = ["A4", "Paper", "paper_of", "paper_plan"]

SIDE, TOP, BOTTOM = 15.0, 13.0, 15.0  # mm, margins
CAPTION = 7.0  # mm that a line under a figure takes
COLUMN = 92.0  # mm: a column of words beside a figure, with the gap between them


@dataclass(frozen=True)
class Paper:
    """A sheet of paper, as it is read (mm)."""

    width: float
    height: float

    @property
    def body(self) -> Box:
        """What a page holds between its margins, with a caption below it."""
        return Box(0.0, 0.0, self.width - 2 * SIDE, self.height - TOP - BOTTOM - CAPTION)

    @property
    def facing(self) -> Paper:
        """Two such pages side by side, or one above the other where they are wide: the next larger paper."""
        upright = self.height >= self.width
        return Paper(2 * self.width, self.height) if upright else Paper(self.width, 2 * self.height)

    @property
    def narrow(self) -> float:
        """Width of a figure so narrow that words stand beside it."""
        return self.body.width - COLUMN

    @property
    def filled(self) -> Room:
        """What figures are to fill at scales that the scene does not give: on A4 150 mm, polygons 140."""
        return self._room((150.0, 150.0), (140.0, 140.0))

    @property
    def most(self) -> Room:
        """What figures may fill, under a heading in two languages: on A4 160 by 180 mm, polygons 157 by 190."""
        return self._room((160.0, 180.0), (157.0, 190.0))

    def _room(self, mechanism: tuple[float, float], polygon: tuple[float, float]) -> Room:
        wide, high = self.body.width / A4.body.width, self.body.height / A4.body.height
        return Room(
            mechanism=(mechanism[0] * wide, mechanism[1] * high), polygon=(polygon[0] * wide, polygon[1] * high)
        )


A4 = Paper(*PAPERS["A4"])
PaperName: TypeAlias = Literal["A5", "A4", "A3", "A2", "A1", "A0"]
LARGER: tuple[PaperName, ...] = ("A4", "A3", "A2", "A1")


def paper_of(scene: Mechanism) -> Paper:
    """The paper that a scene asks for."""
    return Paper(*scene.sheet.size)


def paper_plan(of: Mechanism | Structure, values: Mapping[str, float] | None, asked: Sequence[Symbol]) -> Plan:
    """What to draw: at the scales that the scene wishes, on a larger paper if need be, else at those that fit."""
    own = plan(of, values, asked)
    scene = own.structure.scene
    paper, given = paper_of(scene), scene.sheet
    if paper != A4:
        filled = own.scales_for(paper.filled)
        own = replace(
            own,
            scales=Scales(
                own.scales.length if given.length_scale else filled.length,
                own.scales.velocity if given.velocity_scale else filled.velocity,
                own.scales.acceleration if given.acceleration_scale else filled.acceleration,
            ),
        )
    fits = _fits(own, paper)
    if all(fits):
        return own
    wishes = (given.length_scale, given.velocity_scale, given.acceleration_scale)
    larger = _larger(own, paper, wishes)
    if larger is not None:
        whole = of if isinstance(of, Mechanism) else of.scene
        return paper_plan(replace(whole, sheet=replace(whole.sheet, paper=larger)), values, asked)
    roomed = own.scales_for(paper.most)
    pairs = zip(
        fits,
        (own.scales.length, own.scales.velocity, own.scales.acceleration),
        (roomed.length, roomed.velocity, roomed.acceleration),
        strict=True,
    )
    return replace(own, scales=Scales(*(mine if good else other for good, mine, other in pairs)))


def _fits(own: Plan, paper: Paper) -> list[bool]:
    """Whether each of the three figures fits the paper."""
    sheet = execute(own)
    most = paper.most
    boxes = (Box.around(sheet.points.values()), extent(sheet, "velocity"), extent(sheet, "acceleration"))
    rooms = (most.mechanism, most.polygon, most.polygon)
    return [box.width <= room[0] and box.height <= room[1] for box, room in zip(boxes, rooms, strict=True)]


def _larger(own: Plan, paper: Paper, wishes: Sequence[float | None]) -> PaperName | None:
    """The next paper on which the figures of wished scales fit, None where they fit already or nowhere."""
    if all(fit or wish is None for fit, wish in zip(_fits(own, paper), wishes, strict=True)):
        return None
    for name in LARGER:
        size = PAPERS[name]
        if size[0] <= min(paper.width, paper.height):
            continue
        turned = size if paper.height >= paper.width else size[::-1]
        if all(fit or wish is None for fit, wish in zip(_fits(own, Paper(*turned)), wishes, strict=True)):
            return name
    return None
