"""One colour per link, the same in the mechanism and in every diagram; and which link a vector belongs to."""

from __future__ import annotations

from collections.abc import Mapping

from graphkin.drafting.sheet import Sheet
from graphkin.drawing import strokes
from graphkin.scene.model import Scene
from graphkin.scene.symbol import PointRef, Symbol

__all__ = ["colour_of_link", "colour_of_vector", "link_of_vector"]


def colour_of_link(scene: Scene, link: str) -> str:
    """Colour of a link; the frame is black."""
    name = link.split("/")[-1]
    return strokes.BLACK if name == scene.frame.name else strokes.link_colour(scene.order[name])


def link_of_vector(sheet: Sheet, symbol: Symbol) -> str:
    """The link whose motion a vector shows: that of its point, the common link of two points, or the sliding link of
    two coincident points."""
    scene = sheet.scene
    of, to = symbol.of, symbol.to
    if of is None:
        return symbol.link
    mine = _links(scene.holders, of)
    if to is None:
        moving = [name for name in mine if name != scene.frame.name]
        pivoted = [n for n in moving if any(scene.frame.name in scene.holders[p] for p in scene.by_name[n].points)]
        return (pivoted or moving or [scene.frame.name])[0]
    theirs = _links(scene.holders, to)
    common = [name for name in mine if name in theirs and name != scene.frame.name]
    if of.point != to.point and common:
        return common[0]
    sliding = {s.a for s in sheet.structure.slides} | {p.of for p in scene.pins}
    for name in (*mine, *theirs):
        if name in sliding:
            return name
    return (mine or theirs or [scene.frame.name])[0]


def colour_of_vector(sheet: Sheet, symbol: Symbol) -> str:
    return colour_of_link(sheet.scene, link_of_vector(sheet, symbol))


def _links(holders: Mapping[str, tuple[str, ...]], ref: PointRef) -> list[str]:
    return [ref.link] if ref.link else list(holders.get(ref.point, ()))
