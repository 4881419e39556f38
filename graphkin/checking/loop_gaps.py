"""The gaps of vector loops with stated angles and travels in place of the drawn ones."""

from __future__ import annotations

import cmath
from collections.abc import Mapping

from graphkin.construction.board.sheet import Sheet
from graphkin.construction.position.links_on_paper import travel
from graphkin.plane import added_up
from graphkin.scene.symbol import Symbol
from graphkin.structure.loops import Loop, loops_of
from graphkin.structure.model import Coordinate


def places_of_loops(sheet: Sheet) -> tuple[dict[str, complex], dict[str, float]]:
    """The unit vector of each link's own axis, and the travel (m) of each sliding pair, as drawn."""
    poses, scale = sheet.poses, sheet.scales.length
    axes = {name: pose.axis for name, pose in poses.items()}
    placed = (slide for slide in sheet.structure.slides if poses.keys() >= {*slide.links})
    return axes, {slide.key: travel(slide, poses, 1.0 / scale) * scale for slide in placed}


def loop_gaps(sheet: Sheet, stated: Mapping[Symbol, complex | float]) -> dict[Symbol, tuple[str, float]]:
    """For each stated angle of a link or travel of a sliding pair the name of the loop that gives it, and the gap of
    that loop (m) with all stated values in place of the drawn ones."""
    coordinates = {symbol: coordinate for symbol in stated if (coordinate := _of_loop(symbol)) is not None}
    gaps: dict[Symbol, tuple[str, float]] = {}
    for loop in loops_of(sheet.structure) if coordinates else ():
        vectors = stated_arrows(sheet, loop, stated)
        for symbol, coordinate in coordinates.items():
            kind, name = coordinate
            if vectors and (kind, loop.ties.get(name, name) if kind == "angle" else name) in loop.unknowns:
                gaps.setdefault(symbol, (loop.name, abs(added_up(vectors, 0j))))
    return gaps


def stated_arrows(sheet: Sheet, loop: Loop, stated: Mapping[Symbol, complex | float]) -> tuple[complex, ...]:
    """The arrows of a loop (m) with the stated angles and travels; none if it is not drawn, or no value is stated."""
    axes, travels = places_of_loops(sheet)
    if not all(a.link in axes and (not a.slide or a.slide in travels) for a in loop.arrows):
        return ()
    turned, moved = {}, {}  # of all links that turn with a stated one
    for symbol, value in stated.items():
        kind, name = _of_loop(symbol) or ("", "")
        if kind == "travel" and name in travels:
            moved[name] = float(value.real)
        elif kind == "angle" and name in axes and name in loop.ties:
            turned[loop.ties[name]] = cmath.rect(1.0, float(value.real)) / axes[name]
    if not any(loop.ties[a.link] in turned or a.slide in moved for a in loop.arrows):
        return ()
    return tuple(
        arrow.coefficient * axes[arrow.link] * turned.get(loop.ties[arrow.link], 1.0)
        * (moved.get(arrow.slide, travels[arrow.slide]) if arrow.slide else 1.0)
        for arrow in loop.arrows
    )


def _of_loop(symbol: Symbol) -> Coordinate | None:
    if symbol.kind == "theta" and not symbol.other and not symbol.at:
        return "angle", symbol.link
    return ("travel", symbol.pair) if symbol.kind == "s" and not symbol.at else None
