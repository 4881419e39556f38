"""Which scales show a mechanism and its polygons in the room that a figure has: the scene's own, or those of the
1-2-2.5-5 series that fill the paper."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from graphkin.construction.scales import Extent, fitting_scale
from graphkin.construction.seen_from import vectors_seen
from graphkin.construction.sheet import Scales, Sheet
from graphkin.construction.steps import DIAGRAMS, ORDERS, Aid, DiagramName, Order, Vector
from graphkin.construction.touching import Touching, outlines_on_paper
from graphkin.scene.model import Mechanism

__all__ = [
    "Room", "chosen_scales", "drawn_sizes", "extents_around", "extents_of", "leading_on", "scales_for",
]  # fmt: skip


@dataclass(frozen=True)
class Room:
    """Width and height (mm) that the mechanism and each polygon may fill.

    ``others`` are rooms that may be taken instead, where their scales are so much finer (in powers of ten, of all three
    figures together) as they ``cost`` more; with ``keeps_wishes`` scales that the scene wishes for are kept in a room
    that holds them.
    """

    mechanism: tuple[float, float] = (150.0, 150.0)
    polygon: tuple[float, float] = (140.0, 140.0)
    others: tuple[Room, ...] = ()
    cost: float = 0.0
    keeps_wishes: bool = False


UNMET = 40.0  # what a wish that a room does not hold costs, as `Room.cost`
INTO_MARGIN = 1.1  # times as large as its room may trial polygons be: panels have a margin for names, and figures grow


def chosen_scales(scene: Mechanism, extents: Mapping[DiagramName, Extent], room: Room | None) -> Scales:
    """The scene's own scales, and for those it does not give the finest of the series that fit the room."""
    fast = scene.units.rates.metres
    sheet = scene.question.sheet
    wanted = sheet.length_scale, sheet.velocity_scale, sheet.acceleration_scale
    wishes = [wish * per if wish else None for wish, per in zip(wanted, (1e-3, fast, fast), strict=True)]
    space = room or Room()
    best: tuple[float, list[float]] | None = None
    for one in (space, *space.others):
        cost, scales = one.cost, []
        for name, wish in zip(DIAGRAMS, wishes, strict=True):
            most = one.mechanism if name == "mechanism" else one.polygon
            unit = scene.units.metres if name == "mechanism" else fast
            fitting = fitting_scale(extents[name], most, 1.0 / unit) * unit
            if wish is not None and (room is None or space.keeps_wishes):
                if room is None or wish * (1 + 1e-9) >= _least(extents[name], one, name):
                    scales.append(wish)
                    continue
                cost += UNMET
            scales.append(fitting)
            cost += math.log10(fitting)
        if best is None or cost < best[0] - 1e-9:
            best = cost, scales
    assert best is not None
    return Scales(*best[1])


def _least(extent: Extent, room: Room, name: DiagramName) -> float:
    """The scale (m, m/s, m/s2 for one mm) at which something just fits a room."""
    width, height = room.mechanism if name == "mechanism" else room.polygon
    return max(extent.width / width, extent.height / height)


def extents_around(
    places: Iterable[complex], vectors: Callable[[Order], Iterable[Vector | Aid]], scales: Scales
) -> dict[DiagramName, Extent]:
    """Extents of the mechanism and of both polygons, pole included."""
    extents: dict[DiagramName, Extent] = {"mechanism": Extent.around(places, scales.length)}
    for order in ORDERS:
        drawn = [*vectors(order)]
        true, every = (
            Extent.around([0j, *(z for v in some for z in (v.tail, v.tip))], scales.of(order))
            for some in ([v for v in drawn if not (isinstance(v, Aid) and v.trial)], drawn)
        )
        width, height = max(true.width, every.width / INTO_MARGIN), max(true.height, every.height / INTO_MARGIN)
        extents[order] = Extent(width, height)
    return extents


def scales_for(sheet: Sheet, room: Room) -> Scales:
    """The finest scales of the series at which a sheet fits a room; vectors that only a question asks for left out."""
    return chosen_scales(sheet.scene, extents_of(sheet), room)


def drawn_sizes(sheet: Sheet) -> tuple[tuple[float, float], ...]:
    """Width and height (mm) of the mechanism and of both polygons as they are drawn, as scales are chosen by them."""
    extents = extents_of(sheet)
    return tuple(
        (extents[name].width / sheet.scales.of(name), extents[name].height / sheet.scales.of(name)) for name in DIAGRAMS
    )


def leading_on(sheet: Sheet, order: Order) -> list[Aid]:
    """What must find room although it only leads on: vectors seen from held links, and trial polygons."""
    return [*vectors_seen(sheet, order), *sheet.trials(order)]


def extents_of(sheet: Sheet) -> dict[DiagramName, Extent]:
    def vectors(order: Order) -> Iterator[Vector | Aid]:
        for step in sheet.steps:
            if step.diagram == order and step.reason != "asked":
                yield from (s for s in step.strokes if isinstance(s, Vector))
        yield from leading_on(sheet, order)

    outlines = outlines_on_paper(sheet.scene, sheet.poses, 1.0 / sheet.scales.length)
    places = [*sheet.points.values(), *(z for o in outlines.values() for z in o)]
    places += Touching(sheet.scene, 1.0 / sheet.scales.length, sheet.poses).outermost()
    return extents_around(places, vectors, sheet.scales)
