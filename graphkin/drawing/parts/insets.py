"""What stands in insets: the senses of Coriolis terms and parts of a polygon that are too small for a ruler, in a strip
or in free corners of its panel; and a place of the mechanism where points lie so near to each other that their symbols
overlap, drawn again larger."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from graphkin.account.headings import term
from graphkin.account.notation import Letters
from graphkin.construction.instruments import EXACT_NAME
from graphkin.construction.sheet import DiagramName, Scales, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import text_box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Polygon, Primitive, Text, map_tree, on_page
from graphkin.drawing.ink.strokes import colour_of_vector
from graphkin.drawing.ink.symbols import COMPONENT, RESULTANT, arrow
from graphkin.drawing.parts.coriolis import (
    GUTTER,
    INSET,
    CoriolisTerm,
    coriolis_terms,
    inset_boxes,
    named_inset,
    per_row,
)
from graphkin.drawing.parts.mechanism import bare_mechanism
from graphkin.drawing.parts.polygon import polygon_piece, rings, step_numbers
from graphkin.drawing.parts.polygon_on_page import END_RADIUS, Detail, PolygonOnPage, crowds, details, side_by_side
from graphkin.drawing.place.labels import Label, Obstacles
from graphkin.drawing.place.names import with_crowd, with_labels, without
from graphkin.drawing.place.obstacles import free_boxes, obstacles_of
from graphkin.drawing.place.piece import Piece, cut_to, dated, joined, middle_of, moved_piece
from graphkin.drawing.text import fitted, symbol
from graphkin.scene.symbol import PointRef

__all__ = ["mechanism_detail", "polygon_with_insets", "strip_height"]

SMALL_INSET = 24.0, 21.0  # mm
ROUNDING = 1e-6  # mm
MOST_DETAILS, MOST_CROWDS = 3, 3


def polygon_with_insets(
    sheet: Sheet, diagram: DiagramName, letters: Letters, language: str, panel: Box, origin: complex,
    strip: Box | None = None,
) -> tuple[Piece, list[CoriolisTerm]]:  # fmt: skip
    """A polygon with names and insets in their places.

    Parameters
    ----------
    panel : room of the polygon (mm)
    origin : page point of its pole
    strip : where insets stand in rows; None for free corners of the panel

    Returns
    -------
    the piece, and the Coriolis terms for whose insets there was no room
    """
    senses, small = _coriolis(sheet, diagram), details(sheet, diagram)[:MOST_DETAILS]
    count = len(senses) + len(small)
    bare = PolygonOnPage(sheet, diagram, letters, language, panel, origin, ())
    plain = polygon_piece(bare)
    boxes = _boxes(panel, plain, strip, count, INSET)
    shown = senses[: len(boxes)]
    boxes += _boxes(panel, plain, None, len(shown) + len(small) - len(boxes), SMALL_INSET, boxes)
    enlarged = small[: len(boxes) - len(shown)]
    here = replace(bare, enlarged=tuple(enlarged))
    figure, pieces, crowd = _with_details(here, polygon_piece(here) if enlarged else plain, boxes[len(shown) :], boxes)
    crowded = crowds(here, crowd)[:MOST_CROWDS] if len(enlarged) == len(small) else []
    if crowded:
        there = replace(here, enlarged=(*enlarged, *crowded))
        added = _in_the_room_left(there, figure, len(enlarged), strip, boxes)
        if added:
            here, figure, boxes, pieces = there, added[0], [*boxes, *added[2]], [*pieces, *added[1]]
        else:
            more = boxes + (
                _boxes(panel, plain, strip, len(crowded), INSET, boxes)
                or _boxes(panel, plain, strip, len(crowded), SMALL_INSET, boxes)
            )
            if len(more) > len(boxes):
                there = replace(here, enlarged=there.enlarged[: len(more) - len(shown)])
                clearer = _with_details(there, polygon_piece(there), more[len(shown) :], more)
                if len(clearer[2]) < len(crowd):
                    here, boxes, (figure, pieces, _) = there, more, clearer
    pieces = [*(named_inset(sheet, one, letters, box) for one, box in zip(shown, boxes, strict=False)), *pieces]
    around = obstacles_of(figure.drawn) + Obstacles(areas=tuple(boxes))
    keyed = {one.step for one in figure.layers["labels"] if isinstance(one, Text) and one.step is not None}
    names = {one.id: text_box(one) for one in figure.layers["labels"] if isinstance(one, Text)}
    arrows = [
        (step, here.drawn(vector), names.get(f"label-{vector.symbol.id}"))
        for step, vector in here.in_order() if step not in keyed
    ]  # fmt: skip
    numbers = Piece({"labels": step_numbers(arrows, panel, around)})
    return joined((figure, numbers, *pieces)), senses[len(shown) :]


def _boxes(
    panel: Box, drawn: Piece, strip: Box | None, count: int, size: tuple[float, float], taken: Sequence[Box] = ()
) -> list[Box]:
    """Up to ``count`` boxes for insets beside those that are taken, in free places of a strip first; clear of what is
    drawn on the panel."""
    found: list[Box] = []
    if count < 1:
        return found
    if strip is not None:
        many = per_row(strip.width) * int((strip.height + ROUNDING) // (INSET[1] + GUTTER))
        found = inset_boxes(strip, many)[len(taken) : len(taken) + count]
    if count > len(found):
        around = obstacles_of(drawn.drawn) + Obstacles(areas=(*taken, *found))
        found += free_boxes(count - len(found), size, panel, around)
    return found


def _with_details(
    here: PolygonOnPage, own: Piece, boxes: Sequence[Box], fences: Sequence[Box]
) -> tuple[Piece, list[Piece], tuple[Label, ...]]:
    """A polygon, ``own`` as drawn, with its names, the insets of what is drawn again larger, each in its box, and the
    names that stand badly."""
    pieces = []
    shown: set[str] = set()
    again: set[str] = set()  # with the letters that stand at other vectors too
    for number, (one, box) in enumerate(zip(here.enlarged, boxes, strict=False), 1):
        pieces.append(_named_detail(here, own, one, box, number))
        letters = _shown_in(pieces[-1])
        again |= letters
        shown |= {id for id in letters if one.crowd is not None or id.startswith("label-foot-")}
    own = replace(own, labels=tuple(label for label in own.labels if label.text.id not in shown))
    figure, crowd = with_crowd(own, here.panel, fences)
    again &= {label.text.id for label in crowd}
    return without(figure, again), pieces, tuple(label for label in crowd if label.text.id not in again)


def _in_the_room_left(
    here: PolygonOnPage, figure: Piece, first: int, strip: Box | None, taken: Sequence[Box]
) -> tuple[Piece, list[Piece], list[Box]] | None:
    """A figure with its names, those left out that insets in boxes beside them have, the insets from the number
    ``first`` on, and their boxes; None where there is no room for all of them and their rings."""
    crowded, own = here.enlarged[first:], polygon_piece(here)
    for size in (INSET, SMALL_INSET):
        boxes = _boxes(here.panel, figure, strip, len(crowded), size, taken)
        if len(boxes) < len(crowded):
            continue
        pieces = [
            _named_detail(here, own, one, box, number)
            for number, (one, box) in enumerate(zip(crowded, boxes, strict=True), first + 1)
        ]
        figure = without(figure, set().union(*map(_shown_in, pieces)))
        written = [text_box(thing) for thing in figure.layers["labels"] if isinstance(thing, Text)]
        if any(one.strikes(here.at(one.centre), box) for one in crowded for box in written):
            return None
        construction = (*figure.layers["construction"], *list(rings(here))[first:])
        return replace(figure, layers={**figure.layers, "construction": construction}), pieces, boxes
    return None


def _named_detail(here: PolygonOnPage, own: Piece, one: Detail, box: Box, number: int) -> Piece:
    return with_labels(*_detail_inset(here, one, box, number, _points_in(own, here, one)))


def _shown_in(inset: Piece) -> set[str]:
    """The ids of the names in the figure that an inset has."""
    return {
        text.id.replace("label-detail-", "label-") for text in inset.layers["labels"] if isinstance(text, Text)
    }


def _points_in(piece: Piece, here: PolygonOnPage, detail: Detail) -> list[Label]:
    """The letters of points in a place that is drawn again larger."""
    middle = here.at(detail.centre)
    return [
        one for one in piece.labels if isinstance(one.mark, complex) and abs(one.mark - middle) <= detail.radius + 0.6
    ]


def strip_height(sheet: Sheet, diagram: DiagramName, width: float) -> float:
    """Height (mm) of a strip of a width that holds all insets of a polygon."""
    count = len(_coriolis(sheet, diagram)) + len(details(sheet, diagram)[:MOST_DETAILS])
    return -(-count // per_row(width)) * (INSET[1] + GUTTER)


def _coriolis(sheet: Sheet, diagram: DiagramName) -> list[CoriolisTerm]:
    return coriolis_terms(sheet) if diagram == "acceleration" else []


def _detail_inset(
    here: PolygonOnPage, detail: Detail, box: Box, number: int, points: Sequence[Label]
) -> tuple[Piece, Box]:
    """The inset in a box of the page, and the part of it in which its names may stand; ``points`` are the letters of
    the points in it."""
    inner = Box(box.left + 0.6, box.top + 0.6, box.right - 0.6, box.bottom - 5.0)
    sheet, letters = here.sheet, here.letters

    def at(z: complex) -> complex:
        return inner.centre + detail.factor * on_page(z - detail.centre)

    parts: list[Primitive] = [Polygon(box.corners, "", strokes.DIMENSION)]
    names = []
    own = {v.symbol for v in detail.vectors}
    shifts = side_by_side(v.scaled(detail.factor) for v in detail.vectors)
    for _, vector in here.in_order():
        kind = RESULTANT if vector.role == "resultant" else COMPONENT
        colour = colour_of_vector(sheet, vector.symbol)
        shift = on_page(shifts.get(vector.symbol, 0j))
        tail, tip = at(vector.tail) + shift, at(vector.tip) + shift
        clipped = inner.clip(tail, tip)
        if vector.symbol in own and clipped is not None:
            parts += arrow(clipped[0], tip, kind, colour)
            text = Text(0j, symbol(letters.arrow(vector.symbol), 2.8), "start", colour,
                        f"label-detail-{vector.symbol.id}", ("label",), detail.crowd)
            names.append(Label(text, clipped, rank=1))
            continue
        if clipped is None or abs(clipped[1] - clipped[0]) < 0.5:
            continue
        if inner.distance(tip) < 1e-9 and abs(clipped[1] - clipped[0]) > 3.0:
            parts += arrow(clipped[0], tip, kind, colour)
        else:
            parts.append(Line(*clipped, kind.stroke.coloured(colour)))
    for point in points:
        assert isinstance(point.mark, complex)
        spot = inner.centre + detail.factor * (point.mark - here.at(detail.centre))
        if inner.distance(spot) == 0.0:
            parts.append(Circle(spot, END_RADIUS, fill=strokes.BLACK))
            id = f"label-detail-{point.text.id.removeprefix('label-')}"
            name = replace(point.text, id=id, step=detail.crowd, since=here.since(detail))
            names.append(Label(name, spot, point.toward, rank=1))
    words = f"{term('detail', here.language).replace('{0}', f'{detail.factor:g}')}"
    id = f"detail-{here.diagram}-{number}"
    runs = fitted(words, 2.6, box.width - 1.6)
    caption = Text(complex(box.centre.real, box.bottom - 1.6), runs, "middle", id=f"label-{id}", step=detail.crowd)
    group = Group(tuple(parts), id=id, classes=("inset", "detail"), step=detail.crowd)
    return dated(Piece({here.diagram: (group,), "labels": (caption,)}, tuple(names)), here.since(detail)), inner


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
    shift = inner.centre - on_page(factor * middle)
    bare = moved_piece(bare_mechanism(larger, letters), shift)
    kept = {f"label-point-{ref.point}" for ref in near}
    names = tuple(
        name for name in bare.labels if name.text.id in kept and inner.distance(middle_of(name.mark)) == 0.0
    )
    inside = Piece({"mechanism": cut_to(map_tree(bare.layers["mechanism"], _plain), inner)}, names)
    named = with_labels(inside, inner)
    letters_of_both = ", ".join(f"${letters.point(ref.point)}$" for ref in near)
    words = fitted(f"{term('detail', language).replace('{0}', f'{factor:g}')}, {letters_of_both}", 2.6, box.width - 1.6)
    caption = Text(complex(box.centre.real, box.bottom - 1.6), words, "middle", id="label-detail-mechanism")
    frame = Group(
        (Polygon(box.corners, "", strokes.DIMENSION), *named.layers["mechanism"]), id="detail-mechanism",
        classes=("inset", "detail"),
    )  # fmt: skip
    labels = map_tree(named.layers.get("labels", ()), _renamed)
    return Piece({"mechanism": (frame,), "labels": (*labels, caption)})


def _nearest(sheet: Sheet) -> tuple[PointRef, PointRef] | None:
    """The two joints that lie nearest to each other, if so near that their symbols overlap."""
    points = [
        (ref, z) for ref, z in sheet.points.items() if not ref.link and len(sheet.scene.holders.get(ref.point, ())) > 1
    ]
    pairs = [(abs(z - w), a, b) for i, (a, z) in enumerate(points) for b, w in points[:i]]
    close = [pair for pair in pairs if TOGETHER < pair[0] < CLOSE]
    return min(close, key=lambda pair: pair[0])[1:] if close else None


def _plain(thing: Primitive) -> Primitive:
    """Without its id, which the mechanism itself bears."""
    return Group(thing.children, "", thing.classes) if isinstance(thing, Group) else thing


def _renamed(thing: Primitive) -> Primitive:
    if isinstance(thing, Text):
        id = f"label-detail-{thing.id.removeprefix('label-')}"
        return Text(thing.at, thing.runs, thing.anchor, thing.colour, id, thing.classes)
    return thing
