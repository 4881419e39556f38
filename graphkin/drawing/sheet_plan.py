"""Where everything stands on a sheet: panels of the mechanism and of the polygons, equations, data, readings."""

from __future__ import annotations

from dataclasses import dataclass

from graphkin.drafting import Room
from graphkin.drafting.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.scene.model import Scene

__all__ = ["BLOCK", "GUTTER", "MARGIN", "SheetPlan", "sheet_plan", "sheet_room"]

PAPERS = {"A4": (210.0, 297.0), "A3": (297.0, 420.0), "A2": (420.0, 594.0), "A1": (594.0, 841.0), "A0": (841.0, 1189.0)}
MARGIN, GUTTER, CAPTION = 10.0, 2.0, 5.5
HEAD, BLOCK = 11.0, 16.0  # heading above, title block below
FILL = 0.87  # of a panel, by the polygon with the finest scale
AROUND_MECHANISM = (13.0, 15.0)  # mm for symbols and names
# Height of the mechanism's panel by that of a polygon's: the usual one, and such as tall mechanisms may have.
HEIGHTS = (1.08, 1.33, 1.43)


@dataclass(frozen=True)
class SheetPlan:
    """Where everything stands on the page (mm); panels without their captions."""

    width: float
    height: float
    mechanism: Box
    velocity: Box
    acceleration: Box
    equations: Box
    given: Box
    readings: Box
    block: Box


def sheet_room(scene: Scene) -> Room:
    """The room in which a sheet for ``sheet_page`` is to be drafted: ``draft(scene, room=sheet_room(scene))``."""
    plans = _plans(scene)
    first, *others = (_mechanism_room(plan) for plan in plans)
    panel = plans[0].velocity
    return Room(first, (panel.width * FILL, panel.height * FILL), tuple(others))


def _mechanism_room(plan: SheetPlan) -> tuple[float, float]:
    return plan.mechanism.width - AROUND_MECHANISM[0], plan.mechanism.height - AROUND_MECHANISM[1]


def _plans(scene: Scene) -> tuple[SheetPlan, ...]:
    """The usual plan of a page, and those for taller mechanisms."""
    short, long = PAPERS.get(scene.sheet.paper, PAPERS["A4"])
    if scene.sheet.orientation == "landscape":
        return (_landscape(long, short),)
    return tuple(_portrait(short, long, tall) for tall in HEIGHTS)


def sheet_plan(sheet: Sheet) -> SheetPlan:
    """The first plan whose room holds the mechanism as it is drawn."""
    plans = _plans(sheet.scene)
    size = Box.around(sheet.points.values()) if sheet.points else Box(0.0, 0.0, 0.0, 0.0)
    for plan in plans:
        room = _mechanism_room(plan)
        if size.width <= room[0] + 1e-6 and size.height <= room[1] + 1e-6:
            return plan
    return plans[0]


def _portrait(width: float, height: float, tall: float) -> SheetPlan:
    page = Box(MARGIN, MARGIN, width - MARGIN, height - MARGIN)
    top = page.top + HEAD + CAPTION
    split = page.left + 0.483 * page.width
    polygon = 0.315 * page.height  # height of a polygon's panel
    right = split + GUTTER
    velocity = Box(right, top, page.right, top + polygon)
    acceleration = velocity.moved(complex(0, polygon + CAPTION + GUTTER))
    mechanism = Box(page.left, top, split, top + tall * polygon)
    equations = Box(page.left, mechanism.bottom + GUTTER + CAPTION, split, acceleration.bottom)
    block = Box(page.left, page.bottom - BLOCK, page.right, page.bottom)
    low = acceleration.bottom + GUTTER + CAPTION
    third = page.left + 0.27 * page.width
    given = Box(page.left, low, third, block.top - GUTTER)
    readings = Box(third + 2 * GUTTER, low, page.right, block.top - GUTTER)
    return SheetPlan(width, height, mechanism, velocity, acceleration, equations, given, readings, block)


def _landscape(width: float, height: float) -> SheetPlan:
    page = Box(MARGIN, MARGIN, width - MARGIN, height - MARGIN)
    top = page.top + HEAD + CAPTION
    panel = (page.width - 2 * GUTTER) / 3
    bottom = top + panel * 0.98
    boxes = [
        Box(page.left + i * (panel + GUTTER), top, page.left + i * (panel + GUTTER) + panel, bottom) for i in range(3)
    ]
    block = Box(page.left, page.bottom - BLOCK, page.right, page.bottom)
    low = bottom + GUTTER + CAPTION
    one, two = page.left + 0.17 * page.width, page.left + 0.53 * page.width
    given = Box(page.left, low, one, block.top - GUTTER)
    equations = Box(one + GUTTER, low, two, block.top - GUTTER)
    readings = Box(two + GUTTER, low, page.right, block.top - GUTTER)
    return SheetPlan(width, height, boxes[0], boxes[1], boxes[2], equations, given, readings, block)
