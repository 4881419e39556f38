"""A place of the mechanism where points lie so near to each other that their symbols overlap, drawn again larger."""

from __future__ import annotations

from graphkin.construction.sheet import EXACT_NAME, Scales, Sheet
from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters
from graphkin.drawing.headings import term
from graphkin.drawing.mechanism import bare_mechanism
from graphkin.drawing.mechanism_on_paper import page
from graphkin.drawing.obstacles import free_boxes, obstacles_of
from graphkin.drawing.piece import Piece, cut_to, middle_of, moved_piece, with_labels
from graphkin.drawing.primitives import Group, Polygon, Primitive, Text
from graphkin.drawing.text import fitted
from graphkin.scene.symbol import PointRef

__all__ = ["mechanism_detail"]

CLOSE = 5.0  # mm: the symbols of nearer points overlap
TOGETHER = 0.5  # mm: nearer points are one place
FACTORS = (2.0, 2.5, 5.0, 10.0, 20.0)
APART = 11.0  # mm between them in the detail
SIZE = (34.0, 34.0)  # mm of the inset
CAPTION = 5.0


def mechanism_detail(
    sheet: Sheet, letters: Letters, language: str, panel: Box, drawn: tuple[Primitive, ...]
) -> Piece:
    """The inset for the two nearest points, in a free corner of the panel, nothing
    where all lie apart, where there is no room, or for hands that err, who would draw it anew.

    ``drawn`` is everything on the panel, its names too.
    """
    near = _nearest(sheet)
    if near is None or sheet.instrument != EXACT_NAME:
        return Piece()
    one, two = (sheet.points[ref] for ref in near)
    factor = next((f for f in FACTORS if f * abs(one - two) >= APART), FACTORS[-1])
    middle = (one + two) / 2
    boxes = free_boxes(1, SIZE, panel, obstacles_of(drawn))
    if not boxes:
        return Piece()
    box = boxes[0]
    inner = Box(box.left + 0.6, box.top + 0.6, box.right - 0.6, box.bottom - CAPTION)
    scales = sheet.scales
    larger = sheet.at(Scales(scales.length / factor, scales.velocity, scales.acceleration))
    shift = inner.centre - page(factor * middle)
    bare = moved_piece(bare_mechanism(larger, letters), shift)
    kept = {f"label-point-{ref.point}" for ref in near}
    names = tuple(
        name for name in bare.labels if name.text.id in kept and inner.distance(middle_of(name.mark)) == 0.0
    )
    inside = Piece({"mechanism": cut_to(_plain(bare.layers["mechanism"]), inner)}, names)
    named = with_labels(inside, inner)
    letters_of_both = ", ".join(f"${letters.point(ref.point)}$" for ref in near)
    words = fitted(f"{term('detail', language).replace('{0}', f'{factor:g}')}, {letters_of_both}", 2.6, box.width - 1.6)
    caption = Text(complex(box.centre.real, box.bottom - 1.6), words, "middle", id="label-detail-mechanism")
    frame = Group(
        (Polygon(box.corners, "", strokes.DIMENSION), *named.layers["mechanism"]), id="detail-mechanism",
        classes=("inset", "detail"),
    )  # fmt: skip
    labels = tuple(_renamed(thing) for thing in named.layers.get("labels", ()))
    return Piece({"mechanism": (frame,), "labels": (*labels, caption)})


def _nearest(sheet: Sheet) -> tuple[PointRef, PointRef] | None:
    """The two joints that lie nearest to each other, if so near that their symbols overlap."""
    points = [
        (ref, z) for ref, z in sheet.points.items() if not ref.link and len(sheet.scene.holders.get(ref.point, ())) > 1
    ]
    pairs = [(abs(z - w), a, b) for i, (a, z) in enumerate(points) for b, w in points[:i]]
    close = [pair for pair in pairs if TOGETHER < pair[0] < CLOSE]
    return min(close, key=lambda pair: pair[0])[1:] if close else None


def _plain(things: tuple[Primitive, ...]) -> tuple[Primitive, ...]:
    """Without the ids, which the mechanism itself bears."""
    return tuple(
        Group(_plain(thing.children), "", thing.classes) if isinstance(thing, Group) else thing for thing in things
    )


def _renamed(thing: Primitive) -> Primitive:
    if isinstance(thing, Text):
        id = f"label-detail-{thing.id.removeprefix('label-')}"
        return Text(thing.at, thing.runs, thing.anchor, thing.colour, id, thing.classes)
    return thing
