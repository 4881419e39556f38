"""The paper of a handout: its size, what fits between its margins, and the scales that suit it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from graphkin.construction import Plan, Room, execute, plan
from graphkin.construction.sheet import Scales
from graphkin.drawing.box import Box
from graphkin.drawing.polygon_on_page import extent
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import PAPERS
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


def paper_of(scene: Mechanism) -> Paper:
    """The paper that a scene asks for."""
    return Paper(*scene.sheet.size)


def paper_plan(of: Mechanism | Structure, values: Mapping[str, float] | None, asked: Sequence[Symbol]) -> Plan:
    """What to draw, at the scene's own scales where the figures fit the paper so, at coarser ones where they do not."""
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
    sheet = execute(own)
    most = paper.most
    boxes = (Box.around(sheet.points.values()), extent(sheet, "velocity"), extent(sheet, "acceleration"))
    rooms = (most.mechanism, most.polygon, most.polygon)
    fits = [box.width <= room[0] and box.height <= room[1] for box, room in zip(boxes, rooms, strict=True)]
    if all(fits):
        return own
    roomed = own.scales_for(most)
    pairs = zip(
        fits,
        (own.scales.length, own.scales.velocity, own.scales.acceleration),
        (roomed.length, roomed.velocity, roomed.acceleration),
        strict=True,
    )
    return replace(own, scales=Scales(*(mine if good else other for good, mine, other in pairs)))
