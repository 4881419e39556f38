"""Insets: the senses of Coriolis terms and parts of a polygon that are too small for a ruler, in a strip or in free
corners of its panel; and an enlarged place of the mechanism where the symbols of points overlap.  Under a figure lie
the scene's picture, and scans of drawings with their read lines.

The inset of a Coriolis term shows its sense: 2 ω v stands square to the sliding velocity v, on the side to which the
guide's ω turns it.
"""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

from graphkin.account.headings import term
from graphkin.account.notation import Notation
from graphkin.account.voice import ZERO
from graphkin.checking.scans import judge_scans
from graphkin.construction.board.instruments import EXACT_NAME
from graphkin.construction.board.scales import Scales
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import DiagramName, Size, Vector
from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import (
    Circle,
    Group,
    Line,
    Polygon,
    Primitive,
    Scan,
    Text,
    map_tree,
    on_page,
)
from graphkin.drawing.ink.strokes import colour_of_vector
from graphkin.drawing.ink.symbols import COMPONENT, RESULTANT, arrow, sense_arc
from graphkin.drawing.parts import polygon
from graphkin.drawing.parts.mechanism import bare_mechanism
from graphkin.drawing.parts.polygon import (
    Detail,
    PolygonOnPage,
    polygon_lines,
    polygon_piece,
)
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_crowd, with_labels, without
from graphkin.drawing.place.numbers import step_numbers
from graphkin.drawing.place.obstacles import Obstacles, free_boxes
from graphkin.drawing.place.piece import Piece, cut_to, dated, joined, middle_of, moved_piece, obstacles_of
from graphkin.drawing.text import fitted, plain, rich, runs_width, text_box
from graphkin.plane import cross, unit
from graphkin.scene.model import PlacedPicture
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words.symbols import RichText, Words, rate
from graphkin.words.written import roman

SMALL_INSET = 24.0, 21.0  # mm
ROUNDING = 1e-6  # mm
MOST_DETAILS, MOST_CROWDS = 3, 3


def polygon_with_insets(
    sheet: Sheet, diagram: DiagramName, letters: Notation, language: str, panel: Box, origin: complex,
    strip: Box | None = None,
) -> tuple[Piece, list[CoriolisTerm]]:
    """A polygon with names and insets in their places.

    Parameters
    ----------
    panel : room of the polygon (mm)
    origin : page point of its pole
    strip : the strip of insets in rows; None for free corners of the panel

    Returns
    -------
    the piece, and the Coriolis terms without room for their insets
    """
    terms, small = coriolis_terms(sheet, diagram), polygon.details(sheet, diagram)[:MOST_DETAILS]
    count = len(terms) + len(small)
    here = PolygonOnPage(sheet, diagram, letters, language, panel, origin)
    lines = polygon_lines(here)
    plain = polygon_piece(here, (), lines)
    boxes = _boxes(panel, plain, strip, count, INSET)
    shown = terms[: len(boxes)]
    boxes += _boxes(panel, plain, None, len(shown) + len(small) - len(boxes), SMALL_INSET, boxes)
    enlarged = small[: len(boxes) - len(shown)]
    drawn = polygon_piece(here, enlarged, lines) if enlarged else plain
    figure, pieces, crowd = _with_details(here, enlarged, drawn, boxes[len(shown) :], boxes)
    crowded = polygon.crowds(here, enlarged, crowd)[:MOST_CROWDS] if len(enlarged) == len(small) else []
    for size in (INSET, SMALL_INSET) if crowded else ():
        more = boxes + _boxes(panel, plain, strip, len(crowded), size, boxes)
        if len(more) > len(boxes):
            there = [*enlarged, *crowded][: len(more) - len(shown)]
            clearer = _with_details(here, there, polygon_piece(here, there, lines), more[len(shown) :], more)
            if len(clearer[2]) < len(crowd):
                enlarged, boxes, (figure, pieces, _) = there, more, clearer
            break
    pieces = [*(coriolis_inset(sheet, term, letters, box) for term, box in zip(shown, boxes, strict=False)), *pieces]
    around = obstacles_of(figure.drawn) + Obstacles(areas=tuple(boxes))
    keyed = {label.step for label in figure.layers["labels"] if isinstance(label, Text) and label.step is not None}
    names = {label.id: text_box(label) for label in figure.layers["labels"] if isinstance(label, Text)}
    arrows = [(step, here.drawn(vector), names.get(f"label-{vector.symbol.id}")) for step, vector in here.in_order]
    numbers = Piece({"labels": step_numbers(arrows, keyed, panel, around)})
    numerals = polygon.ring_numerals(polygon.rings(here, enlarged), around + obstacles_of(numbers.drawn), panel)
    return joined((figure, numbers, numerals, *pieces)), terms[len(shown) :]


def _boxes(
    panel: Box, drawn: Piece, strip: Box | None, count: int, size: tuple[float, float], taken: Sequence[Box] = ()
) -> list[Box]:
    """Up to ``count`` boxes for insets besides the taken ones, in free places of a strip first; clear of the strokes on
    the panel."""
    free: list[Box] = []
    if count < 1:
        return free
    if strip is not None:
        many = per_row(strip.width) * int((strip.height + ROUNDING) // (INSET[1] + GUTTER))
        free = inset_boxes(strip, many)[len(taken) : len(taken) + count]
    if count > len(free):
        around = obstacles_of(drawn.drawn) + Obstacles(areas=(*taken, *free))
        free += free_boxes(count - len(free), size, panel, around)
    return free


def _with_details(
    here: PolygonOnPage, enlarged: Sequence[Detail], drawn: Piece, boxes: Sequence[Box], fences: Sequence[Box]
) -> tuple[Piece, list[Piece], tuple[Label, ...]]:
    """A polygon as ``drawn``, with its names, the insets of its enlarged parts, each in its box, and the badly
    placed names."""
    pieces = []
    shown: set[str] = set()
    repeated: set[str] = set()  # with the letters that stand at other vectors too
    for number, (detail, box) in enumerate(zip(enlarged, boxes, strict=False), 1):
        middle, reach = here.at(detail.centre), detail.radius + 0.6
        points = [name for name in drawn.labels if isinstance(name.mark, complex) and abs(name.mark - middle) <= reach]
        inset, letters = _detail_inset(here, detail, box, number, points)
        pieces.append(inset)
        repeated |= letters
        shown |= {id for id in letters if detail.crowd is not None or id.startswith("label-foot-")}
    drawn = replace(drawn, labels=tuple(label for label in drawn.labels if label.text.id not in shown))
    figure, crowd = with_crowd(drawn, here.panel, fences)
    repeated &= {label.text.id for label in crowd}
    return without(figure, repeated), pieces, tuple(label for label in crowd if label.text.id not in repeated)


def strip_height(sheet: Sheet, diagram: DiagramName, width: float) -> float:
    """Height (mm) of a strip of a width that holds all insets of a polygon."""
    count = len(coriolis_terms(sheet, diagram)) + len(polygon.details(sheet, diagram)[:MOST_DETAILS])
    return -(-count // per_row(width)) * (INSET[1] + GUTTER)


def _detail_inset(
    here: PolygonOnPage, detail: Detail, box: Box, number: int, points: Sequence[Label]
) -> tuple[Piece, set[str]]:
    """The inset of an enlarged place in a box of the page, with its names, and the ids of those that stand in it for
    others on the polygon; ``points`` are the letters of the points in it."""
    inner = _inside(box, CAPTION)
    letters = here.letters

    def at(z: complex) -> complex:
        return inner.centre + detail.factor * on_page(z - detail.centre)

    parts: list[Primitive] = []
    names: dict[str, Label] = {}  # by the id of the name on the polygon
    shown = {v.symbol for v in detail.vectors}
    shifts = polygon.side_by_side(v.scaled(detail.factor) for v in detail.vectors)
    for _, vector in here.in_order:
        kind = RESULTANT if vector.role == "resultant" else COMPONENT
        colour = here.colours[vector.symbol]
        shift = on_page(shifts.get(vector.symbol, 0j))
        tail, tip = at(vector.tail) + shift, at(vector.tip) + shift
        clipped = inner.clip(tail, tip)
        if vector.symbol in shown and clipped is not None:
            parts += arrow(clipped[0], tip, kind, colour)
            names[f"label-{vector.symbol.id}"] = Label.of(
                rich(letters.arrow(vector.symbol), 2.8), clipped, f"label-detail-{vector.symbol.id}", colour=colour,
                rank=1, step=detail.crowd,
            )
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
            parts.append(Circle(spot, polygon.END_RADIUS, fill=strokes.BLACK))
            id = f"label-detail-{point.text.id.removeprefix('label-')}"
            name = point.text._replace(id=id, step=detail.crowd, since=here.since(detail))
            names[point.text.id] = Label(name, spot, point.toward, rank=1)
    enlarged = term("detail", here.language, scale=f"{detail.factor:g}")
    words = f"{roman(number)}: {enlarged}", f"{roman(number)} ({detail.factor:g} : 1)"
    id, classes = f"detail-{here.diagram}-{number}", ("inset", "detail")
    drawn = _inset(box, here.diagram, parts, words, polygon.NUMERAL, id, classes, step=detail.crowd)
    named = with_labels(dated(replace(drawn, labels=tuple(names.values())), here.since(detail)), inner)
    written = {text.id for text in named.layers["labels"] if isinstance(text, Text)}
    return named, {id for id, name in names.items() if name.text.id in written}


def _inside(box: Box, caption: float) -> Box:
    """The part of an inset above its caption, whose height is given (mm)."""
    return Box(box.left + 0.6, box.top + 0.6, box.right - 0.6, box.bottom - caption)


def _inset(
    box: Box, layer: str, parts: Sequence[Primitive], words: Sequence[Words], size: float, id: str,
    classes: tuple[str, ...], up: float = 1.6, step: int | None = None,
) -> Piece:
    """Parts in the frame of an inset, with the first words that fit in its middle, ``up`` mm above its lower edge, else
    the last."""
    wide = box.width - 1.6
    texts = [fitted(text, size, wide) for text in words]
    caption = next((runs for runs in texts if runs_width(runs) <= wide), texts[-1])
    said = Text(complex(box.centre.real, box.bottom - up), caption, "middle", id=f"label-{id}", step=step)
    group = Group((Polygon(box.corners, "", strokes.DIMENSION), *parts), id=id, classes=classes, step=step)
    return Piece({layer: (group,), "labels": (said,)})


CLOSE = 5.0  # mm: the symbols of nearer points overlap
TOGETHER = 0.5  # mm: nearer points are one place
RING_ABOUT = 2.4  # mm from them to the ring about them, outside their symbols
FACTORS = (2.0, 2.5, 5.0, 10.0, 20.0)
APART = 11.0  # mm between them in the detail
SIZE = (34.0, 34.0)  # mm of the inset
CAPTION = 5.0


def mechanism_with_inset(
    sheet: Sheet, letters: Notation, language: str, piece: Piece, origin: complex, panel: Box
) -> Piece:
    """A mechanism with names in their places, the scene's picture under it, and the inset for its two nearest points.

    Parameters
    ----------
    piece : as `mechanism_piece` draws it
    origin : page point of the world's origin
    panel : room of it all (mm)
    """
    scan = sheet.scene.question.background
    under = Piece({"background": (_laid(scan, 1 / sheet.scales.length, origin, panel),)} if scan is not None else {})
    whole = moved_piece(piece, origin)
    named, near = with_labels(whole, panel), _nearest(sheet)
    boxes = free_boxes(1, SIZE, panel, obstacles_of(named.drawn)) if near is not None else []
    if near is None or not boxes:
        return joined((under, named))
    start, end = (sheet.points[ref] for ref in near)
    circle = Circle(origin + on_page(start + end) / 2, abs(start - end) / 2 + RING_ABOUT, stroke=strokes.CONSTRUCTION)
    ring = Group((circle,), id="ring-mechanism", classes=("ring",))
    # the names anew: they keep off the ring and the inset
    named = with_crowd(joined((whole, Piece({"labels": (ring,)}))), panel, boxes)[0]
    numeral = polygon.ring_numerals([ring], obstacles_of(named.drawn) + Obstacles(areas=tuple(boxes)), panel)
    return joined((under, named, numeral, _mechanism_detail(sheet, letters, language, near, boxes[0])))


def _mechanism_detail(
    sheet: Sheet, letters: Notation, language: str, near: tuple[PointRef, PointRef], box: Box
) -> Piece:
    """The inset for two near points in a box of the page."""
    start, end = (sheet.points[ref] for ref in near)
    factor = next((f for f in FACTORS if f * abs(start - end) >= APART), FACTORS[-1])
    middle = (start + end) / 2
    inner = _inside(box, CAPTION)
    scales = sheet.scales
    larger = sheet.at(Scales(scales.length / factor, scales.velocity, scales.acceleration))
    shift = inner.centre - on_page(factor * middle)
    bare = moved_piece(bare_mechanism(larger, letters), shift)
    kept = {f"label-point-{ref.point}" for ref in near}
    names = tuple(name for name in bare.labels if name.text.id in kept and inner.distance(middle_of(name.mark)) == 0.0)
    bodies = map_tree(bare.layers["mechanism"], _without_id)
    named = with_labels(Piece({"mechanism": cut_to(bodies, inner)}, names), inner)
    words = f"{roman(1)}: " + term("detail", language, scale=f"{factor:g}")
    parts, classes = named.layers["mechanism"], ("inset", "detail")
    frame = _inset(box, "mechanism", parts, (words,), polygon.NUMERAL, "detail-mechanism", classes)
    labels = tuple(
        part._replace(id=f"label-detail-{part.id.removeprefix('label-')}", step=None, since=None)
        if isinstance(part, Text) else part for part in named.layers.get("labels", ())
    )
    return joined((Piece({"labels": labels}), frame))


def _nearest(sheet: Sheet) -> tuple[PointRef, PointRef] | None:
    """The two nearest joints, if their symbols overlap; none for erring hands, which would draw them anew."""
    if sheet.instrument != EXACT_NAME:
        return None
    points = [
        (ref, z) for ref, z in sheet.points.items() if not ref.link and len(sheet.scene.holders.get(ref.point, ())) > 1
    ]
    pairs = [(abs(z - w), a, b) for i, (a, z) in enumerate(points) for b, w in points[:i]]
    close = [pair for pair in pairs if TOGETHER < pair[0] < CLOSE]
    return min(close, key=lambda pair: pair[0])[1:] if close else None


def _without_id(part: Primitive) -> Primitive:
    """The primitive without its id, which the mechanism itself has."""
    return Group(part.children, "", part.classes) if isinstance(part, Group) else part


CoriolisTerm: TypeAlias = tuple[Vector, Vector, Size | None]
"""A Coriolis vector, its sliding velocity, and the rule for its size."""
REACH = 8.0  # mm of the arrows
INSET = 32.0, 26.0  # mm
GUTTER = 2.0  # mm between insets


def coriolis_terms(sheet: Sheet, diagram: DiagramName = "acceleration") -> list[CoriolisTerm]:
    """Each Coriolis vector of a polygon that is not zero, with its sliding velocity and the rule for its size."""
    velocities = {symbol: v for symbol, v in sheet.vectors["velocity"].items() if abs(v.span) > ZERO}
    rules = {t.symbol: t.size for e in sheet.equations for side in e.sides for t in side}
    terms = []
    for vector in sheet.vectors[diagram].values():
        of, to = vector.symbol.of, vector.symbol.to
        velocity = velocities.get(Symbol("v", of, to), velocities.get(Symbol("v", of)))
        if vector.role == "coriolis" and abs(vector.span) >= ZERO and velocity is not None:
            terms.append((vector, velocity, rules.get(vector.symbol)))
    return terms


def coriolis_inset(sheet: Sheet, term: CoriolisTerm, letters: Notation, box: Box) -> Piece:
    """The inset of a Coriolis term in a box of the page, with its names."""
    vector, velocity, rule = term
    slip, turned = unit(velocity.span), unit(vector.span)
    sense = 1 if cross(slip, turned) > 0 else -1
    inner = _inside(box, 6.2)
    centre = inner.centre - REACH / 2 * on_page(slip + turned)
    colour = colour_of_vector(sheet, vector.symbol)
    tips = [centre + REACH * on_page(direction) for direction in (slip, turned)]
    arc = sense_arc(centre, 3.6, phase(slip) + sense * math.pi / 4, sense, math.radians(72))
    parts = (
        *arrow(centre, tips[0], COMPONENT, strokes.BLACK),
        *arrow(centre, tips[1], COMPONENT, colour),
        *arc,
        Circle(centre, 0.4, fill=strokes.BLACK),
    )
    id = vector.symbol.id
    middle = centre + 3.6 * on_page(unit(slip + turned))
    links = "".join(rule.links) if rule and rule.rule == "rate" and rule.rate == "omega" else ""

    def label(kind: str, name: RichText, at: complex, direction: complex, rank: int = 0) -> Label:
        return Label.of(rich(name, 2.8), at, f"label-inset-{kind}{id}", toward=(phase(direction),), rank=rank)

    names = [
        label("v-", letters.arrow(velocity.symbol), tips[0], slip),
        label("", letters.arrow(vector.symbol), tips[1], turned),
    ]
    if links:
        names.append(label("omega-", rate("omega", links), middle, slip + turned, 1))
    name = letters.vector(vector.symbol)
    words = (name + " = " + letters.size(rule), name) if rule else (name,)
    piece = _inset(box, "acceleration", parts, words, 2.8, f"sense-{id}", ("inset",), up=2.3)
    drawn = [step.number for step in sheet.steps if vector in step.strokes]
    return with_labels(dated(replace(piece, labels=tuple(names)), max(drawn, default=None)), inner)


def coriolis_rows(
    sheet: Sheet, terms: Sequence[CoriolisTerm], letters: Notation, room: Box, gap: float
) -> tuple[Piece, Sequence[CoriolisTerm]]:
    """Insets of Coriolis terms in rows, ``gap`` mm apart, from the top of a room, and the terms without room there."""
    rows = max(0, int((room.height + ROUNDING + gap) // (INSET[1] + gap)))
    boxes = inset_boxes(room, min(len(terms), rows * per_row(room.width)), gap)
    drawn = joined(coriolis_inset(sheet, term, letters, box) for term, box in zip(terms, boxes, strict=False))
    return drawn, terms[len(boxes) :]


def per_row(width: float) -> int:
    """The number of insets side by side in a width (mm), at least one."""
    return max(1, int((width + GUTTER) // (INSET[0] + GUTTER)))


def inset_boxes(strip: Box, count: int, gap: float = GUTTER) -> list[Box]:
    """``count`` boxes of insets in rows, ``gap`` mm apart, from the upper left corner of a strip."""
    places = (divmod(i, per_row(strip.width)) for i in range(count))
    corners = ((strip.left + k * (INSET[0] + GUTTER), strip.top + row * (INSET[1] + gap)) for row, k in places)
    return [Box(x, y, x + INSET[0], y + INSET[1]) for x, y in corners]


def _laid(picture: PlacedPicture, mm: float, origin: complex, panel: Box) -> Scan:
    """A picture cut to a panel of a page where the origin of its places lies at ``origin``, with ``mm`` for one unit of
    them."""
    corner, step = (on_page(z) * mm for z in (picture.corner, picture.step))
    return Scan(origin + corner, step, picture.width, picture.height, picture.kind, picture.data, panel.corners)


def scan_piece(sheet: Sheet, diagram: DiagramName, origin: complex, panel: Box) -> Piece:
    """The scans of a figure, cut to a panel (mm, y down) in which the pole, or the world's origin, lies at ``origin``:
    the picture, if there is one, and the read lines, the wrong line bold and with a name."""
    under: list[Primitive] = []
    lines: list[Primitive] = []
    for judged in judge_scans(sheet, diagram):
        if judged.picture is not None:
            under.append(_laid(judged.picture, 1.0, origin, panel))
        for line in judged.lines:
            ends = panel.clip(origin + on_page(line.tail), origin + on_page(line.tip))
            if ends is None:
                continue
            wrong = line is judged.off
            drawn: tuple[Primitive, ...] = (Line(*ends, strokes.READ_OFF if wrong else strokes.READ),)
            if wrong:
                at = (ends[0] + ends[1]) / 2 + 1.2 - 1.2j
                name = plain(line.name, 3.0)
                drawn += (Text(at, name, "start", strokes.READ_OFF.colour, classes=("label", "off")),)
            lines.append(Group(drawn, id=f"read-{line.name.replace('/', '-').replace('@', '')}", classes=("read",)))
    return Piece({"background": tuple(under), "answers": tuple(lines)} if under or lines else {})
