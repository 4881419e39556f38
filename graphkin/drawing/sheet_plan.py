"""Plans of a sheet's page, and the choice of the plan that suits a mechanism.

The usual plan has the equations under the mechanism.  Others give the mechanism or the polygons more room; if the scene
wishes for scales that fit none of them, writing goes to a further page, and then the paper grows.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product

from graphkin.construction import Room
from graphkin.construction.board.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.plane import added_up
from graphkin.scene.model import Mechanism
from graphkin.scene.scene_tables import PAPERS

MARGIN, GUTTER, CAPTION = 10.0, 2.0, 5.5
HEAD, BLOCK = 11.0, 16.0  # heading above, title block below
FILL = 0.87  # of a panel, by the polygon with the finest scale
AROUND_MECHANISM = (13.0, 15.0)  # mm for symbols and names
FOR_DIMENSIONS = 14.0  # mm above and below a mechanism that gives room to the equations
LEAST_POLYGON, LEAST_BESIDE = 40.0, 14.0  # mm: height of a polygon's panel, and of writing below both
# Width of the mechanism's panel by that of the page: the usual one, others, and one with nothing below it.
SPLITS, SLENDER = (0.483, 0.36, 0.6), 0.28
# Height of a polygon's panel by that of the page: the usual one, and that beside which few readings have room.
POLYGON, HIGHER = 0.315, 0.36
FEW = 3  # moving links
# Height of the mechanism's panel by that of a polygon's: the usual one, and such as tall mechanisms may have.
HEIGHTS = (1.08, 1.33, 1.43)
NARROWEST, WIDEST = 0.26, 0.66  # width of the mechanism's panel where the writing has a continuation
# What a plan costs beside the usual one, in tenfold finer scales: less room for the equations, a column too narrow for
# them, less room below the polygons, a continuation, a larger paper.
TALL, NARROW, STRIP, LESS_BELOW, CONTINUED, LARGER = 0.28, 0.35, 0.45, 0.1, 3.0, 5.0


@dataclass(frozen=True)
class SheetPlan:
    """The places of panels on the page (mm), without their captions; None for a panel on a further page."""

    width: float
    height: float
    mechanism: Box
    velocity: Box
    acceleration: Box
    block: Box
    cost: float
    equations: Box | None = None
    given: Box | None = None
    readings: Box | None = None
    beside: Box | None = None  # room for writing below polygons that leave some of theirs

    @property
    def page(self) -> Box:
        """The page within its margins."""
        return Box(MARGIN, MARGIN, self.width - MARGIN, self.height - MARGIN)

    @property
    def room(self) -> Room:
        """The room for the figures in it."""
        mechanism = self.mechanism.width - AROUND_MECHANISM[0], self.mechanism.height - AROUND_MECHANISM[1]
        return Room(mechanism, (self.velocity.width * FILL, self.velocity.height * FILL), cost=self.cost)

    def holds(self, sizes: tuple[tuple[float, float], ...]) -> bool:
        """Whether mechanism and polygons of these widths and heights fit."""
        rooms = self.room.mechanism, self.room.polygon, self.room.polygon
        return all(
            width <= room[0] * (1 + 1e-9) and height <= room[1] * (1 + 1e-9)
            for (width, height), room in zip(sizes, rooms, strict=True)
        )


def sheet_room(scene: Mechanism) -> Room:
    """The room for drafting a sheet for ``sheet_page``: ``draft(scene, room=sheet_room(scene))``."""
    first, *others = (plan.room for plan in _plans(scene))
    return Room(first.mechanism, first.polygon, others=tuple(others), keeps_wishes=True)


def sheet_plan(sheet: Sheet) -> SheetPlan:
    """The cheapest plan with room for the figures as drawn."""
    plans = sorted(_plans(sheet.scene), key=lambda plan: plan.cost)
    sizes = sheet.drawn_sizes
    return next((plan for plan in plans if plan.holds(sizes)), plans[0])


def with_less_mechanism(plan: SheetPlan, sheet: Sheet) -> Iterator[SheetPlan]:
    """Plans whose mechanism leaves more room to the equations below it."""
    panel, equations = plan.mechanism, plan.equations
    if equations is None or equations.right != panel.right:
        return  # they stand elsewhere
    spare = panel.height - sheet.drawn_sizes[0][1] - AROUND_MECHANISM[1] - FOR_DIMENSIONS
    for share in (0.5, 1.0) if spare > 0 else ():
        up = share * spare
        yield replace(plan, mechanism=panel._replace(bottom=panel.bottom - up),
                      equations=equations._replace(top=equations.top - up))


def with_less_polygons(plan: SheetPlan, heights: Sequence[float]) -> Iterator[SheetPlan]:
    """Plans whose polygons, of these heights (mm) with their names, leave room for writing below them."""
    velocity, acceleration = plan.velocity, plan.acceleration
    if plan.equations is None or velocity.left != acceleration.left:
        return
    spare = [max(0.0, panel.height - max(LEAST_POLYGON, high))
             for panel, high in zip((velocity, acceleration), heights, strict=True)]
    for chosen in ((0,), (1,), (0, 1)):
        less = [spare[i] if i in chosen else 0.0 for i in (0, 1)]
        if not all(less[i] for i in chosen) or added_up(less) < LEAST_BESIDE:
            continue
        bottom = acceleration.bottom - added_up(less)
        yield replace(
            plan, velocity=velocity._replace(bottom=velocity.bottom - less[0]),
            acceleration=acceleration._replace(top=acceleration.top - less[0], bottom=bottom),
            beside=acceleration._replace(top=bottom + GUTTER),
        )


def _plans(scene: Mechanism) -> Iterator[SheetPlan]:
    """All plans, the usual one first; larger papers if the scene wishes for scales."""
    wishes = scene.question.sheet
    wished = any((wishes.length_scale, wishes.velocity_scale, wishes.acceleration_scale))
    landscape = wishes.orientation == "landscape"
    sizes = sorted(PAPERS.values())
    larger = [size for size in sizes if size[0] > min(wishes.size)] if wished else []
    for times, (short, long) in enumerate([(min(wishes.size), max(wishes.size)), *larger]):
        width, height = (long, short) if landscape else (short, long)
        roomy = times > 0 or len(scene.links) <= FEW
        cost = LARGER * times
        if landscape:
            yield from _landscape(width, height, cost, wished)
        else:
            yield from _portrait(width, height, cost, wished, roomy)


def _portrait(width: float, height: float, cost: float, wished: bool, roomy: bool) -> Iterator[SheetPlan]:
    for polygon in (POLYGON, HIGHER) if roomy else (POLYGON,):
        more = cost + LESS_BELOW * (polygon != POLYGON)
        for split, tall in product(SPLITS, HEIGHTS):
            dear = TALL + 0.01 * tall if tall > HEIGHTS[0] else 0.0
            yield _upright(width, height, split, polygon, tall, more + dear + NARROW * (split != SPLITS[0]))
        for split in (*SPLITS, SLENDER):
            yield _upright(width, height, split, polygon, None, more + STRIP + 0.1 * (split != SPLITS[0]))
    if wished:
        for step in range(9):
            split = NARROWEST + (WIDEST - NARROWEST) * step / 8
            yield _upright(width, height, split, None, None, cost + CONTINUED)


def _upright(
    width: float, height: float, split: float, polygon: float | None, tall: float | None, cost: float
) -> SheetPlan:
    """A page with the polygons below each other beside the mechanism.

    Parameters
    ----------
    split : width of the mechanism's panel by that of the page
    polygon : height of a polygon's panel by that of the page; None: both fill it, the writing on a continuation
    tall : height of the mechanism's panel by that of a polygon's, with the equations below it; None: as tall as both
        polygons, the equations between the given and the readings
    """
    page = Box(MARGIN, MARGIN, width - MARGIN, height - MARGIN)
    block = page._replace(top=page.bottom - BLOCK)
    top = page.top + HEAD + CAPTION
    middle = page.left + split * page.width
    high = polygon * page.height if polygon else (block.top - 2 * GUTTER - CAPTION - top) / 2
    velocity = Box(middle + GUTTER, top, page.right, top + high)
    acceleration = velocity.moved(complex(0, high + CAPTION + GUTTER))
    mechanism = Box(page.left, top, middle, top + tall * high if tall else acceleration.bottom)
    plan = SheetPlan(width, height, mechanism, velocity, acceleration, block, cost)
    if polygon is None:
        return plan
    low = Box(page.left, acceleration.bottom + GUTTER + CAPTION, page.right, block.top - GUTTER)
    given = low._replace(right=page.left + (0.27 if tall else 0.2) * page.width)
    if tall:
        equations = Box(page.left, mechanism.bottom + GUTTER + CAPTION, middle, acceleration.bottom)
    else:
        equations = low._replace(left=given.right + 2 * GUTTER, right=page.left + 0.56 * page.width)
    readings = low._replace(left=(given if tall else equations).right + 2 * GUTTER)
    return replace(plan, equations=equations, given=given, readings=readings)


def _landscape(width: float, height: float, cost: float, wished: bool) -> Iterator[SheetPlan]:
    page = Box(MARGIN, MARGIN, width - MARGIN, height - MARGIN)
    top = page.top + HEAD + CAPTION
    block = page._replace(top=page.bottom - BLOCK)
    third = (page.width - 2 * GUTTER) / 3
    for share, continued in product((1 / 3, 0.22, 0.46), (False, True) if wished else (False,)):
        bottom = block.top - GUTTER if continued else top + third * 0.98
        wide = share * (page.width - 2 * GUTTER)
        each = (page.width - 2 * GUTTER - wide) / 2
        first = Box(page.left, top, page.left + wide, bottom)
        second = Box(first.right + GUTTER, top, first.right + GUTTER + each, bottom)
        dear = cost + CONTINUED * continued + NARROW * (share != 1 / 3)
        plan = SheetPlan(width, height, first, second, second.moved(complex(each + GUTTER, 0)), block, dear)
        if not continued:
            low = Box(page.left, bottom + GUTTER + CAPTION, page.right, block.top - GUTTER)
            near, far = page.left + 0.17 * page.width, page.left + 0.53 * page.width
            plan = replace(plan, equations=low._replace(left=near + GUTTER, right=far), given=low._replace(right=near),
                           readings=low._replace(left=far + GUTTER))
        yield plan
