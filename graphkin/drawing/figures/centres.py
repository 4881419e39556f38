"""The figure of the instant centres: the mechanism pale behind all its centres; beside it the circle diagram (links as
points on a circle, centres as the lines between them, numbered in the order of construction) and the construction of
each centre; below the velocities taken through them.  A centre whose lines have no room for their names there has a
small picture of its own.

Centres are marked by kind, with the lines near what they find, and arrows to those that lie far away.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import combinations, pairwise

import numpy as np

from graphkin.account.centres import line_through, place_of, velocity_sentences
from graphkin.account.headings import describe, figure_title, number, term
from graphkin.account.notation import Notation, in_counting_order
from graphkin.construction.board.scales import Room
from graphkin.construction.centres import Centre, CentreRelation, Centres, LinkPair
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import (
    GAP,
    HEAD_LINE,
    SIZE,
    TOLD,
    Block,
    FigurePage,
    column,
    framed,
    numbered,
    numeral,
    panel,
    prose,
    row,
    rows,
)
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Group,
    Line,
    Polygon,
    Primitive,
    Segment,
    Text,
    on_page,
    walk,
)
from graphkin.drawing.ink.strokes import colour_of_link, pale
from graphkin.drawing.ink.symbols import POINTER, arrow
from graphkin.drawing.parts.mechanism import bare_mechanism
from graphkin.drawing.parts.mechanism_on_paper import MechanismOnPaper
from graphkin.drawing.parts.touching import replacing_links
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_crowd, without
from graphkin.drawing.place.obstacles import clearest
from graphkin.drawing.place.piece import Piece, ink_box, joined, moved_piece, obstacles_of, renamed
from graphkin.drawing.plate import centred
from graphkin.drawing.text import SMALLEST, plain, rich, runs_width, stacked, text_box, wrapped
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import cross, dot, unit
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, languages, listed, rich_text, word
from graphkin.words.symbols import RichText, Words, sign, spaced


def id_of(pair: LinkPair) -> str:
    """A centre as an id."""
    return "centre-" + "-".join(sorted(pair))


# the circle diagram

HALF = 1.9  # mm of a line left out to either side of its number
CLEAR, WIDE = 1.55, 3.0  # mm from a number's middle to anything else, at least and at best
KNOT, OUTSIDE = 3.5, 2.2  # letters of the names of links, and their distance from the circle
ROUNDING = 1e-6  # mm
SHARES = 0.1 + 0.01 * np.arange(81)  # of a side, where its number may stand


def circle_diagram(centres: Centres, middle: complex, radius: float) -> Group:
    """The diagram about a page point.

    Links stand clockwise in the order of counting, the first at the top; a found line has its number where it has most
    room, and none where there is too little.
    """
    names = sorted(centres.names, key=in_counting_order)
    spokes = {n: cmath.rect(1.0, 2 * math.pi * k / len(names)) * -1j for k, n in enumerate(names)}
    sides = {c: (middle + radius * spokes[c.pair[0]], middle + radius * spokes[c.pair[1]]) for c in centres.found}
    lines: list[Primitive] = []
    numbers: list[Primitive] = []
    taken: list[complex] = []
    for centre, (a, b) in sides.items():
        if centre.place is None:
            continue
        stroke = strokes.PERMANENT if centre.kind == "permanent" else strokes.OTHERWISE if centre.way else strokes.FOUND
        at = None
        if centre.number:
            at = _free(a, b, [side for side in sides.values() if side != (a, b)], taken, middle, radius)
        parts: tuple[Line, ...] = (Line(a, b, stroke),)
        name = "-".join(sorted(centre.pair))
        if at is not None:
            taken.append(at)
            gap = HALF * (b - a) / abs(b - a)
            parts = Line(a, at - gap, stroke), Line(at + gap, b, stroke)
            runs = plain(str(centre.number), 2.3)
            numbers.append(Text(at + 0.75j, runs, "middle", id=f"label-side-{name}", classes=("label",)))
        lines.append(Group(parts, id=f"side-{name}", classes=("side", centre.kind)))
    thin = strokes.DIMENSION.coloured(strokes.GREY)
    outline = (Arc(middle, radius, k * math.pi, (k + 1) * math.pi, thin) for k in (0, 1))
    knots: list[Primitive] = []
    for name, spoke in spokes.items():
        colour, runs = colour_of_link(centres.scene, name), plain(name, KNOT, bold=True)
        box = text_box(Text(0j, runs, "middle", colour))
        there = middle + (radius + OUTSIDE + max(box.width * abs(spoke.real), box.height) / 2) * spoke
        foot = there - 1j * (box.top + box.bottom) / 2
        knots += [Circle(middle + radius * spoke, 1.1, colour),
                  Text(foot, runs, "middle", colour, f"label-circle-{name}", ("label",))]
    whole = (*outline, *lines, *numbers, *knots)
    return Group(whole, id="circle-diagram", classes=("circle-diagram",))


def _free(
    a: complex, b: complex, others: Sequence[tuple[complex, complex]], taken: Sequence[complex],
    middle: complex, radius: float,
) -> complex | None:
    """The place on a side that lies farthest from all other sides, from the circle and from placed numbers; None where
    a number would touch one of them."""
    places = a + (b - a) * SHARES
    near = [radius - np.abs(places - middle), *(np.abs(places - w) - HALF for w in taken)]
    starts, spans = (np.array(ends)[:, None] for ends in ([p for p, _ in others], [q - p for p, q in others]))
    near += [*(np.abs(cross(places - starts, spans)) / np.abs(spans))]
    room: list[float] = np.minimum.reduce([np.full(len(places), WIDE), *near]).tolist()
    spots: list[complex] = places.tolist()
    # of two places that are alike the first: rounding, so that the last bit does not choose
    most, half = max(room) - 2 * ROUNDING, (a + b) / 2
    widest = (k for k, wide in enumerate(room) if wide > most)
    best = max(widest, key=lambda k: (round(room[k], 6), -round(abs(spots[k] - half), 6)))
    return spots[best] if room[best] > CLEAR else None


# marks of centres

TOGETHER = 1.3  # mm: centres so near to each other share one mark
BEYOND = 5.0  # mm of a construction line beyond what it finds
ARROW, FAR_CLEAR = 11.0, 7.0  # mm, to what lies off the figure; between it and what is drawn
ASIDES = [s * k * 6.0 for k in range(18) for s in ((1, -1) if k else (1,))]  # mm, where an arrow may stand
IN_LINE = 4  # names of centres at one place


def mark_of(centre: Centre, frame: str, at: complex) -> tuple[Primitive, ...]:
    """The mark of a centre at a page point: permanent ones in rings (the fixed filled), found ones as dots in a cross,
    centres found by another method as lozenges."""
    line = strokes.RELATIVE
    if centre.kind == "permanent":
        inner = strokes.BLACK if frame in centre.pair else strokes.WHITE
        return Circle(at, 2.1, "", line), Circle(at, 1.0, inner, line)
    if centre.way:
        return (Polygon((at - 1.5, at - 1.5j, at + 1.5, at + 1.5j), strokes.WHITE, line),)
    across = (unit(1 + 1j), unit(1 - 1j))
    return *(Line(at - 1.7 * w, at + 1.7 * w, strokes.OUTLINE) for w in across), Circle(at, 0.65, strokes.BLACK)


def _lines_of(centre: Centre, letters: Notation) -> RichText:
    """The lines that cross in a centre, by the centres on each, or as the normal of a pin in a slot."""
    named = (line_through(line, letters.centre, lambda pin: sign("n", pin.partition("/")[0])) for line in centre.lines)
    return spaced(" × ", named)


def near_box(centres: Centres, mechanism: Box, most: tuple[float, float]) -> Box:
    """The box (mm about the world's origin, y down) of the mechanism and of the centres near enough to be shown with
    it: the nearest first, while the whole stays within a width and height."""
    box = mechanism
    spots = [on_page(c.point) for c in centres.found if c.point is not None]
    for z in sorted(spots, key=mechanism.distance):
        larger = box.joined(Box.around((z,)).grown(3.0))
        if larger.width <= most[0] and larger.height <= most[1]:
            box = larger
    return box


def centre_marks(centres: Centres, letters: Notation, panel: Box, drawn: tuple[Primitive, ...]) -> Piece:
    """All centres of a figure about the world's origin (y down); ``drawn`` is the mechanism, from which arrows to
    centres outside the panel keep clear."""
    inside, frame = panel.grown(-2.5), centres.scene.frame.name
    known = [c for c in centres.found if c.place is not None]
    far = [c for c in known if _off(c, inside)]
    near = _grouped((c for c in known if not _off(c, inside)), lambda a, b: abs(_spot(a) - _spot(b)) < TOGETHER)
    lines = [line for c in (*(c for group in near for c in group), *far) for line in _lines(centres, c, panel)]
    names = [
        Label.of(rich(_lines_of(c, letters), SMALLEST), _spot(c), f"label-lines-{id_of(c.pair)}",
                 colour=strokes.GREY, rank=3) for group in near for c in group if c.lines
    ]
    marks: list[Primitive] = []
    for group in near:
        spot = _spot(group[0])
        for c in group:  # one mark: that of the best known; every name has a group of its own
            mark = mark_of(c, frame, spot) if c is group[0] else (Circle(_spot(c), 0.3, strokes.BLACK),)
            step = (f"step-{c.number:02d}",) if c.number else ()
            marks.append(Group(mark, id=id_of(c.pair), classes=("centre", c.kind, *step)))
        runs = stacked(_names(group, letters), 3.5)
        names.append(Label.of(runs, spot, f"label-{id_of(group[0].pair)}", classes=("centre",),
                              key=_key(group, letters) if len(group) > 1 else None))
    solid = [*obstacles_of(drawn).solid, *((line.start, line.end) for line in lines)]
    for spot in (_spot(group[0]) for group in near):
        solid += [(spot - 4.0, spot + 4.0), (spot - 4.0j, spot + 4.0j)]
    for group in _grouped(far, _one_way):  # those at infinity in one direction share an arrow
        tail, tip = _pointer(inside, solid, group[0])
        solid.append((tail, tip))
        marks += [Group(arrow(tail, tip, POINTER) if c is group[0] else (), id=id_of(c.pair),
                        classes=("centre", "far", c.kind)) for c in group]
        names.append(Label.of(stacked(_far_names(centres, group, letters), 3.2), (tail, tip),
                              f"label-{id_of(group[0].pair)}", classes=("centre",), key=_key(group, letters)))
    # over the tint of links, under the marks
    found_by = Group(tuple(lines), id="centre-lines", classes=("construction",))
    return Piece({"centres": (found_by, *marks)}, tuple(names))


def _spot(centre: Centre) -> complex:
    """The place of a centre on the page."""
    return on_page(centre.point or 0j)


def _off(centre: Centre, inside: Box) -> bool:
    """Whether a centre lies at infinity, or outside a part of the page."""
    return centre.point is None or inside.distance(on_page(centre.point)) > 0.0


def _grouped(some: Iterable[Centre], alike: Callable[[Centre, Centre], bool]) -> list[list[Centre]]:
    """Centres in groups of like ones, by the first of each group."""
    groups: list[list[Centre]] = []
    for centre in some:
        home = next((group for group in groups if alike(group[0], centre)), None)
        if home is None:
            groups.append([centre])
        else:
            home.append(centre)
    return groups


def _one_way(a: Centre, b: Centre) -> bool:
    return a.direction is not None and b.direction is not None and abs(cross(a.direction, b.direction)) < 1e-9


def _names(group: Sequence[Centre], letters: Notation, tail: str = "") -> list[RichText]:
    """The names of centres at one place, in lines."""
    names = [letters.centre(c.pair) for c in group]
    lines = [spaced(", ", names[i : i + IN_LINE]) for i in range(0, len(names), IN_LINE)]
    return [*(line + "," for line in lines[:-1]), lines[-1] + tail]


def _key(group: Sequence[Centre], letters: Notation) -> Text:
    """The name of the first of several centres, for all of them."""
    return Text(0j, rich(letters.centre(group[0].pair) + ", …" * (len(group) > 1), 3.2))


def _far_names(centres: Centres, group: Sequence[Centre], letters: Notation) -> list[RichText]:
    """Names of centres at infinity; for a far centre with its distance from a fixed pivot."""
    first, scene = group[0], centres.scene
    if first.point is None:
        return _names(group, letters, " → ∞")
    point = next(iter(scene.frame.points), None) or next(iter(scene.holders))
    far = abs(first.point - centres.point(point)) / centres.mm / scene.units.metres
    return [letters.point(point) + letters.centre(first.pair) + f" = {number(far, 4)} {scene.units.length}"]


def _lines(centres: Centres, centre: Centre, panel: Box) -> Iterator[Line]:
    """The two lines that cross in a centre, each from its given centres to just beyond it, cut at the panel; towards a
    centre at infinity up to the edge of the panel."""
    for relation in centre.lines:
        a, b, c = relation.line
        if abs(complex(a, b)) <= 1e-12 * abs(c):
            continue  # the line at infinity
        along = on_page(unit(complex(-b, a)))
        known = [on_page(z) for z in _leads_through(centres, relation)]
        if centre.point is None:
            ends = [panel.clip(z - 1e4 * along, z + 1e4 * along) for z in known[:1]]
        else:
            here = on_page(centre.point)
            base = known[0] if known else here - BEYOND * along
            *shares, end = [dot(z - base, along) for z in (*known, here)]
            low, high = min([*shares, end]), max([*shares, end])
            low, high = (low - BEYOND if end == low else low), (high + BEYOND if end == high else high)
            ends = [panel.clip(base + low * along, base + high * along)]
        yield from (Line(*chord, strokes.OF_CENTRES) for chord in ends if chord is not None and chord[0] != chord[1])


def _leads_through(centres: Centres, relation: CentreRelation) -> Iterator[complex]:
    """The places (mm, y up) on a line: of its two centres, or of the pin to whose path it is square."""
    for held in relation.through:
        if not isinstance(held, str):
            point = centres.of(*held).point
            if point is not None:
                yield point
        elif (name := held.split("/")[0]) in centres.scene.holders:
            yield centres.point(name)


def _pointer(inside: Box, solid: Sequence[Segment], centre: Centre) -> Segment:
    """The place of an arrow to a far centre: it points straight at the centre, clear of strokes, near the edge."""
    prices: list[float] = []
    arrows: list[Segment] = []
    middle = inside.centre
    far = None if centre.point is None else on_page(centre.point)
    if far is not None:
        headings = [unit(far - middle)]
    else:
        assert centre.direction is not None
        headings = [on_page(centre.direction), -on_page(centre.direction)]
    for turned, straight in enumerate(headings):
        for aside in ASIDES:
            start = middle + 1j * straight * aside
            aim = straight if far is None else unit(far - start)
            chord = inside.clip(start, start + 1e4 * aim)
            if chord is None:
                continue
            for back in (0.0, 4.0, 10.0):
                if abs(chord[1] - chord[0]) >= ARROW + back:
                    tip = chord[1] - back * aim
                    prices.append(0.12 * abs(aside) + 0.5 * back + 3.0 * turned)
                    arrows.append((tip - ARROW * aim, tip))
    assert arrows, "a panel is larger than an arrow"
    tails, tips = np.array(arrows).T[..., None]
    points = tails + (tips - tails) * np.arange(4) / 3
    drawn = np.array(solid, dtype=complex).reshape(-1, 2)
    return arrows[clearest(np.array(prices), ((points, FAR_CLEAR, 1.0),), drawn)]


# the figure

ROOM = 9.0  # mm around the centres, for names
MOST = (150.0, 150.0)  # mm that the mechanism with its near centres may fill
SMALLEST_FIGURE = (70.0, 60.0)
SMALL = Room(mechanism=(60.0, 50.0))  # mm, of the mechanism where each centre is drawn by itself
SIDE, BESIDE = 62.0, 2.0  # width of the column beside the mechanism, and between the two
NAME = 9.0  # least width of the name of a centre in the list
RADIUS = {3: 15.0, 4: 17.0, 5: 20.0, 6: 22.0}
LEGEND = ("legend",)


def centres_figure(page: FigurePage, centres: Centres) -> Drawing:
    """Draw all centres of a position on a page; centres whose lines have no room for their names there again on further
    pages, each in a picture of its own."""
    sheet, letters = page.sheet, page.letters
    back = background(bare_mechanism(sheet, letters), "touch")
    if sheet.scene.instead_of is not None:  # the bars to centres of curvature, which have centres too
        back = joined((Piece({"construction": replacing_links(MechanismOnPaper(sheet, letters))}), back))
    content = near_box(centres, ink_box(back.drawn) or Box(-20.0, -20.0, 20.0, 20.0), MOST)
    side = _side(page, centres)
    wide = max(content.width, SMALLEST_FIGURE[0]) + 2 * ROOM - BESIDE
    high = max(content.height + 2 * ROOM, SMALLEST_FIGURE[1] + 2 * ROOM, side.height)
    page = page.wide_enough(wide + BESIDE + side.width)
    figure = centred(
        content, wide, high, lambda around: joined((back, centre_marks(centres, letters, around, back.drawn))),
        lambda whole, around: named_centres(whole, around, centres),
    )
    velocities = velocity_sentences(centres)
    body = column(row(figure, side, gap=BESIDE), _report(page, centres, velocities), gap=GAP)
    said = describe(sheet, ("mechanism",), page.language) + "\n" + _description(page, centres, velocities)
    made = page.drawing(
        page.at_drivers(page.term("centres")), body, page.scale("mechanism"), title="centres", said=said)
    some = untold(centres, figure.piece.drawn)
    return replace(made, further=tuple(_centre_by_centre(page, centres, some))) if some else made


def background(piece: Piece, *also: str) -> Piece:
    """The mechanism alone, pale: without lengths, rate arrows and compass arcs; with groups of the classes ``also``."""
    kept = tuple(
        part for part in piece.layers["mechanism"]
        if isinstance(part, Group) and {"frame", "link", "point", "cam", *also} & set(part.classes)
    )
    names = tuple(name for name in piece.labels if name.text.id.startswith(("label-point-", "label-link-")))
    return Piece({"mechanism": pale(kept)}, names, piece.marks)


def _side(page: FigurePage, centres: Centres) -> Block:
    """The column beside the mechanism: circle diagram, legend, and the centres in the order of construction, with their
    constructions."""
    letters = page.letters
    radius = RADIUS.get(len(centres.names), 23.0)
    rows = [
        (c.number, letters.centre(c.pair), _how_found(c, letters, page.language))
        for c in centres.found if c.number
    ]
    wide = max([NAME, *(runs_width(rich(name, SIZE)) + 1.5 for _, name, _ in rows)])
    # long names of links need more room, in the circle diagram and in the list: of each line, and the × at its end
    longest = max(runs_width(plain(name, KNOT, bold=True)) for name in centres.names)
    lines = [runs_width(runs) + 3.0 for *_, how in rows for runs in wrapped(how, SIZE, 0.0)]
    width = max(SIDE, 2 * (radius + OUTSIDE + longest), 7.0 + wide + max(lines, default=0.0))
    circle = panel(width, 2 * radius + 18.0, lambda room: Piece(
        {"centres": (circle_diagram(centres, room.centre, radius),)}))
    title = prose((page.term("circle diagram"),), width, 3.2, bold=True, line=HEAD_LINE, classes=LEGEND)
    order = (
        row(numeral(number, 7.0, classes=LEGEND), prose((name,), wide, classes=LEGEND),
            prose((how,), width - 7.0 - wide, classes=LEGEND))
        for number, name, how in rows
    )
    return column(title, circle, column(*_legend(page, centres), gap=0.8), column(*order), gap=1.5)


def _legend(page: FigurePage, centres: Centres) -> Iterator[Block]:
    """The mark of each kind of centre."""
    frame = centres.scene.frame.name
    kinds: dict[str, Callable[[Centre], bool]] = {
        "permanent fixed": lambda c: c.kind == "permanent" and frame in c.pair,
        "permanent moving": lambda c: c.kind == "permanent" and frame not in c.pair,
        "by Kennedy": lambda c: c.kind == "found" and not c.way, "otherwise": lambda c: bool(c.way),
    }
    for kind, holds in kinds.items():
        first = next((c for c in centres.found if holds(c)), None)
        if first is not None:
            mark = Block(Piece({"centres": mark_of(first, frame, 3.0 + 2.0j)}), 0.0, 8.0)
            yield row(mark, prose((page.term(kind),), SIDE - 8.0, classes=LEGEND))


def _how_found(centre: Centre, letters: Notation, language: str) -> Words:
    """The construction of a centre in short: the two lines that cross, or the name of another method."""
    return _lines_of(centre, letters) or term(f"way {centre.way or 'none'}", language)


def _report(page: FigurePage, centres: Centres, velocities: Sequence[Phrase]) -> Block:
    """The centres that Kennedy's theorem does not give, with the reason, and the velocities by centres: their formulas
    once, with the further languages in brief."""
    lines: list[Words] = []
    formulas: list[Words] = []
    every = languages(page.language)
    for each in every:
        for centre in centres.indeterminate:
            by = Phrase(f"centre {centre.way}", centre=centre.pair, kept=listed(centres.kept)) if centre.way else None
            sentences = [_rich(phrase, each, page.letters) for phrase in (centre.why, by) if phrase is not None]
            lines.append(spaced(word("sentence joint", each), sentences))
    for phrase in velocities:
        sentences = [_rich(phrase, each, page.letters) for each in every]
        brief = [word(f"{phrase.key} briefly", each, "") for each in every[1:]]
        formulas += (spaced(" ", (sentences[0], *brief)),) if brief and all(brief) else dict.fromkeys(sentences)
    head = [page.term("velocities by centres")] if velocities else []
    wide = page.width
    return column(prose(lines, wide, 3.0, classes=TOLD), prose(head, wide, 3.2, bold=True, classes=TOLD),
                  prose(formulas, wide, 3.0, classes=TOLD))


def _rich(phrase: Phrase, language: str, letters: Notation) -> RichText:
    """A sentence with its symbols in the letters of a convention."""

    def show(argument: object) -> Words:
        if isinstance(argument, Symbol):
            return letters.vector(argument)
        if isinstance(argument, PointRef):
            return letters.point(argument.point)
        return letters.centre(argument) if isinstance(argument, tuple) else str(argument)

    return rich_text(phrase, language, show)


def _description(page: FigurePage, centres: Centres, velocities: Sequence[Phrase]) -> str:
    """Every centre in words, for readers who do not see the figure."""
    letters = page.letters
    said = []
    for each in languages(page.language):
        for centre in centres.found:
            place = "?" if centre.direction is None else "∞"
            if centre.point is not None:
                place = f"({', '.join(f'{x:.4g}' for x in place_of(centres, centre) or ())})"
            how = _how_found(centre, letters, each) if centre.number else centre.joint
            said.append(f"{letters.centre(centre.pair).plain('')} {place}: {RichText(how).plain('')}")
        said += [_rich(phrase, each, letters).plain("") for phrase in velocities]
    return "\n".join(said)


# where names have no room

WIDTH = 194.0  # mm of a page between its margins
COLUMNS, ROWS = 2, 3
PICTURE, BETWEEN = (95.5, 76.0), 3.0  # mm, width and height of a picture, and between pictures
APART, INSIDE = 1.0, 3.0  # mm from the frame of a picture to names, and to what it shows
LETTER = 3.0
ROUNDS = 4  # how often names are placed anew without those that have no clear place


def named_centres(piece: Piece, panel: Box, centres: Centres) -> Piece:
    """A figure of centres with its names in their places; in a crowd without names of found centres that would stand on
    others or have leaders through joints: `untold` returns these too."""
    for _ in range(ROUNDS):
        named, crowded = with_crowd(piece, panel)
        ids = _overlapping(named) if crowded else set()
        overlapping = ([label for label in some if label.text.id in ids and _found(label, centres)]
                       for some in (crowded, piece.labels))
        marks = {label.mark for label in next(filter(None, overlapping), ())}
        if not marks:
            break
        piece = replace(piece, labels=tuple(label for label in piece.labels if label.mark not in marks))
    return named


def _overlapping(named: Piece) -> set[str]:
    """The names that stand on others, or have leaders through joints."""
    written = named.layers["labels"]
    texts = {part.id: text_box(part) for part in written if isinstance(part, Text)}
    joints = obstacles_of(without(named, texts).drawn).areas
    ids = {id for pair in combinations(texts, 2) if texts[pair[0]].overlaps(texts[pair[1]]) for id in pair}
    return ids | {
        name.id for leader, name in pairwise(written) if isinstance(leader, Line) and isinstance(name, Text)
        and any(joint.clip(leader.start, leader.end) and joint.distance(leader.start) > 0.0 for joint in joints)
    }


def _found(label: Label, centres: Centres) -> bool:
    """Whether a name belongs to centres that are all crossings of two lines."""
    at = label.mark
    if isinstance(at, tuple) or "centre" not in label.text.classes:
        return False
    return all(c.lines for c in centres.found if c.point is not None and abs(_spot(c) - at) < TOGETHER)


def untold(centres: Centres, drawn: Sequence[Primitive]) -> tuple[Centre, ...]:
    """The found centres within a figure whose lines have no names on it."""
    parts = walk(drawn)
    ids = {part.id for part in parts if isinstance(part, Text)}
    near = {part.id for part in parts if isinstance(part, Group) and "centre" in part.classes
            and "far" not in part.classes}
    return tuple(c for c in centres.found if c.lines and id_of(c.pair) in near
                 and f"label-lines-{id_of(c.pair)}" not in ids)


def _centre_by_centre(page: FigurePage, centres: Centres, some: Sequence[Centre]) -> Iterator[Drawing]:
    """Pages with a small picture of each of some centres: the mechanism, the two lines through known centres, and their
    crossing."""
    letters = page.letters
    small = centres.at(centres.sheet.scales_for(SMALL))
    behind = Piece(background(bare_mechanism(small.sheet, letters), "touch").layers)
    page = replace(page, sheet=small.sheet, width=WIDTH)
    for i in range(0, len(some), COLUMNS * ROWS):
        pictures, said = [], [figure_title(small.sheet, "lines of centres", page.language)]
        for centre in (small.of(*crowded.pair) for crowded in some[i : i + COLUMNS * ROWS]):
            equation = letters.centre(centre.pair) + " = " + _lines_of(centre, letters)
            said.append(f"{centre.number}. {equation.plain('')}")
            picture = panel(*PICTURE, partial(_picture, small, centre, behind, letters))
            pictures.append(column(numbered(centre.number, equation, PICTURE[0], LETTER), framed(picture), gap=0.6))
        yield page.drawing(
            page.term("lines of centres"), column(*rows(pictures, WIDTH, BETWEEN), gap=BETWEEN),
            page.scale("mechanism"), title="lines of centres", said="\n".join(said),
        )


def _picture(centres: Centres, centre: Centre, behind: Piece, letters: Notation, room: Box) -> Piece:
    """A centre with its two lines and the centres on them."""
    through = dict.fromkeys(pair for line in centre.lines for pair in line.through if not isinstance(pair, str))
    known = (centres.of(*pair) for pair in through)
    alone = replace(centres, table={c.pair: replace(c, lines=()) for c in known} | {centre.pair: centre})
    inside = room.grown(-INSIDE)
    content = near_box(alone, ink_box(behind.drawn) or Box(-10.0, -10.0, 10.0, 10.0), (inside.width, inside.height))
    origin = inside.centre - content.centre
    around = room.grown(-APART).moved(-origin)
    piece, crowded = with_crowd(joined((behind, centre_marks(alone, letters, around, behind.drawn))), around)
    piece = without(piece, {label.text.id for label in crowded if label.rank > 2})  # told above the picture
    return renamed(moved_piece(piece, origin), f"-{centre.number}")


FIGURES = (Figure("centres", centres_figure, "centres", lambda scene: True, place=5),)
