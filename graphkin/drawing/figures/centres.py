"""The figure of the instant centres: the mechanism pale behind all its centres; beside it the circle diagram (links as
points on a circle, centres as the lines between them, numbered as they were found) and how each centre was found; below
the velocities taken through them.  Centres whose lines have no room for their names there stand each in a small picture
of its own.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise, permutations

import numpy as np

from graphkin.account.centres import place_of, velocity_sentences
from graphkin.account.headings import describe, figure_title, term
from graphkin.account.notation import Letters, in_counting_order
from graphkin.construction.centre_speeds import Turning
from graphkin.construction.centres import Centre, Centres
from graphkin.construction.scales import Room
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import (
    GAP,
    HEAD_LINE,
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
)  # fmt: skip
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Primitive, Stroke, Text, on_page, walk
from graphkin.drawing.ink.strokes import colour_of_link, pale
from graphkin.drawing.parts.centre_marks import TOGETHER, centre_marks, line_name, mark_of, near_box
from graphkin.drawing.parts.mechanism import bare_mechanism
from graphkin.drawing.parts.mechanism_on_paper import MechanismOnPaper
from graphkin.drawing.parts.touching import replacing_links
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_crowd, without
from graphkin.drawing.place.piece import Piece, ink_box, joined, moved_piece, obstacles_of, renamed
from graphkin.drawing.text import plain, text_box
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import cross
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Markup, Phrase, RichText, as_markup, as_plain, languages, rich_text, word

__all__ = ["FIGURES", "background", "centres_figure", "circle_diagram", "stroke_of"]

HALF = 1.9  # mm of a line left out to either side of its number
CLEAR = 1.55  # mm from a number's middle to anything else
LEGEND = ("legend",)
PERMANENT, FOUND, OTHERWISE = Stroke(0.5), Stroke(0.25), Stroke(0.35, (2.4, 0.9))


def stroke_of(centre: Centre) -> Stroke | None:
    """How the line of a centre is drawn; None where it is not determined."""
    if centre.place is None:
        return None
    return PERMANENT if centre.kind == "permanent" else OTHERWISE if centre.way else FOUND


def circle_diagram(centres: Centres, middle: complex, radius: float) -> tuple[Primitive, ...]:
    """Draw the diagram about a page point.

    Links stand clockwise in the order of counting, the first at the top; a line found bears its number where along it
    there is most room, none where there is too little.
    """
    names = sorted(centres.names, key=in_counting_order)
    ways = {n: cmath.rect(1.0, 2 * math.pi * k / len(names)) * -1j for k, n in enumerate(names)}
    sides = [(c, middle + radius * ways[c.pair[0]], middle + radius * ways[c.pair[1]]) for c in centres.found]
    lines: list[Primitive] = []
    numbers: list[Primitive] = []
    taken: list[complex] = []
    for centre, a, b in sides:
        stroke = stroke_of(centre)
        if stroke is None:
            continue
        name = "-".join(sorted(centre.pair))
        at = (
            None
            if not centre.number
            else _free(a, b, [(p, q) for _, p, q in sides if (p, q) != (a, b)], taken, middle, radius)
        )
        parts: tuple[Line, ...] = (Line(a, b, stroke),)
        if at is not None:
            taken.append(at)
            gap = HALF * (b - a) / abs(b - a)
            parts = Line(a, at - gap, stroke), Line(at + gap, b, stroke)
            runs = plain(str(centre.number), 2.3)
            numbers.append(Text(at + 0.75j, runs, "middle", id=f"label-side-{name}", classes=("label",)))
        lines.append(Group(parts, id=f"side-{name}", classes=("side", centre.kind)))
    thin = Stroke(0.18, (), strokes.GREY)
    outline = (Arc(middle, radius, 0.0, math.pi, thin), Arc(middle, radius, math.pi, 2 * math.pi, thin))
    whole = (*outline, *lines, *numbers, *_knots(centres, names, ways, middle, radius))
    return (Group(whole, id="circle-diagram", classes=("circle-diagram",)),)


def _free(
    a: complex, b: complex, others: Sequence[tuple[complex, complex]], taken: Sequence[complex],
    middle: complex, radius: float,
) -> complex | None:  # fmt: skip
    """The place on a side that lies furthest from all other sides, from the circle and from numbers that stand already;
    None where a number would touch one of them."""

    places = np.array([a + (b - a) * (0.1 + 0.01 * k) for k in range(81)])
    near = [radius - np.abs(places - middle), *(np.abs(places - w) - HALF for w in taken)]
    near += [np.abs(cross(places - p, np.array(q - p))) / abs(q - p) for p, q in others]
    room = np.minimum.reduce([np.full(81, 9.0), *near]).tolist()
    off = np.abs(places - (a + b) / 2).tolist()
    # of two places that are alike the first: rounding, so that the last bit does not choose
    best = max(range(81), key=lambda k: (round(min(room[k], 3.0), 6), -round(off[k], 6)))
    return complex(places[best]) if room[best] > CLEAR else None


def _knots(
    centres: Centres, names: Sequence[str], ways: Mapping[str, complex], middle: complex, radius: float
) -> list[Primitive]:
    """The links as points on the circle with their numbers."""
    drawn: list[Primitive] = []
    for name in names:
        at, colour = middle + radius * ways[name], colour_of_link(centres.scene, name)
        drawn.append(Circle(at, 1.1, colour))
        runs = plain(name, 3.5, bold=True)
        box = text_box(Text(0j, runs, "middle", colour))
        there = middle + (radius + 2.2 + max(box.width, box.height) / 2) * ways[name]
        foot = there - 1j * (box.top + box.bottom) / 2
        drawn.append(Text(foot, runs, "middle", colour, f"label-circle-{name}", ("label",)))
    return drawn


ROOM = 9.0  # mm around the centres, for names
MOST = (150.0, 150.0)  # mm that the mechanism with its near centres may fill
SMALLEST = (70.0, 60.0)
SMALL = Room(mechanism=(60.0, 50.0))  # mm, of the mechanism where each centre is drawn by itself
SIDE, BESIDE = 62.0, 2.0  # width of the column beside the mechanism, and between the two
RADIUS = {3: 15.0, 4: 17.0, 5: 20.0, 6: 22.0}


def centres_figure(
    centres: Centres, turning: Mapping[str, Turning], *, language: str | None = None, convention: str | None = None
) -> Drawing:
    """Draw all centres of a position on a page of its own; those whose lines have no room for their names there again
    on further pages, each in a picture of its own.

    Parameters
    ----------
    turning : the velocities by centres (`graphkin.construction.centres.speeds`)
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    sheet = centres.sheet
    page = FigurePage.of(sheet, "centres", language, convention)
    spoken, letters = page.language, page.letters
    back = background(bare_mechanism(sheet, letters), "touch")
    if sheet.scene.instead_of is not None:  # the bars to centres of curvature, which have centres too
        back = joined((Piece({"construction": replacing_links(MechanismOnPaper(sheet, letters))}), back))
    mechanism = ink_box(back.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    content = near_box(centres, mechanism, MOST)
    side = _side(centres, letters, spoken)
    wide = max(content.width, SMALLEST[0]) + 2 * ROOM - BESIDE
    high = max(content.height + 2 * ROOM, SMALLEST[1] + 2 * ROOM, side.height)
    page = page.wide_enough(wide + BESIDE + SIDE)

    def drawn(room: Box) -> Piece:
        origin = room.centre - content.centre
        around = room.moved(-origin)  # about the world's origin, as the mechanism is drawn
        whole = joined((back, centre_marks(centres, letters, around, back.drawn)))
        return moved_piece(named_centres(whole, around, centres), origin)

    figure = panel(wide, high, drawn)
    report = _report(centres, turning, letters, spoken, page.width)
    made = page.drawing(
        page.at_drivers(page.term("centres")),
        column(row(figure, side, gap=BESIDE), report, gap=GAP), page.scale("mechanism"), title="centres",
        said=describe(sheet, ("mechanism",), spoken) + "\n" + _description(centres, turning, letters, spoken),
    )  # fmt: skip
    some = untold(centres, figure.piece.drawn)
    if not some:
        return made
    small = centres.at(centres.sheet.scales_for(SMALL))
    again = [small.of(*centre.pair) for centre in some]
    return replace(made, further=centre_steps(small, again, _mechanism_behind(small, letters), letters, spoken))


def _mechanism_behind(centres: Centres, letters: Letters) -> Piece:
    """The mechanism of a drawing, pale, without names."""
    pale = background(bare_mechanism(centres.sheet, letters), "touch")
    return Piece(pale.layers)


def background(piece: Piece, *also: str) -> Piece:
    """The mechanism alone, pale: without lengths, senses and compass arcs; with groups of ``also`` these classes."""
    kept = tuple(
        thing for thing in piece.layers["mechanism"]
        if isinstance(thing, Group) and {"frame", "link", "point", "cam", *also} & set(thing.classes)
    )  # fmt: skip
    names = tuple(name for name in piece.labels if name.text.id.startswith(("label-point-", "label-link-")))
    return Piece({"mechanism": pale(kept)}, names, piece.marks)


def _side(centres: Centres, letters: Letters, language: str) -> Block:
    """The column beside the mechanism: circle diagram, legend, and the order in which centres were found."""
    radius = RADIUS.get(len(centres.names), 23.0)
    circle = panel(SIDE, 2 * radius + 18.0, lambda room: Piece(
        {"centres": circle_diagram(centres, room.centre, radius)}))
    title = prose((term("circle diagram", language),), SIDE, 3.2, bold=True, line=HEAD_LINE, classes=LEGEND)
    legend, order = column(*_legend(centres, language), gap=0.8), column(*_order(centres, letters, language))
    return column(title, circle, legend, order, gap=1.5)


def _legend(centres: Centres, language: str) -> Iterator[Block]:
    """The mark of each kind of centre."""
    frame = centres.scene.frame.name
    kinds: dict[str, Callable[[Centre], bool]] = {
        "permanent fixed": lambda c: c.kind == "permanent" and frame in c.pair,
        "permanent moving": lambda c: c.kind == "permanent" and frame not in c.pair,
        "by Kennedy": lambda c: c.kind == "found" and not c.way, "otherwise": lambda c: bool(c.way),
    }  # fmt: skip
    for kind, holds in kinds.items():
        one = next((c for c in centres.found if holds(c)), None)
        if one is not None:
            mark = Block(Piece({"centres": tuple(mark_of(one, frame, 3.0 + 2.0j))}), 0.0, 8.0)
            yield row(mark, prose((term(kind, language),), SIDE - 8.0, classes=LEGEND))


def _order(centres: Centres, letters: Letters, language: str) -> Iterator[Block]:
    """The centres in the order in which they were found, and how."""
    for centre in (one for one in centres.found if one.number):
        how = how_found(centre, letters, language, centres)
        name = prose((f"${letters.centre(centre.pair)}$",), 9.0, classes=LEGEND)
        told = prose((how,), SIDE - 16.0, classes=LEGEND)
        yield row(numeral(centre.number, 7.0, classes=LEGEND), name, told)


def how_found(centre: Centre, letters: Letters, language: str, centres: Centres) -> str:
    """The construction of a centre in short: the two lines that cross, or the name of another way."""
    if centre.lines:
        return " × ".join(line_name(line, letters) for line in centre.lines)
    if centre.way:
        return term(f"way {centre.way}", language)
    return term("way none", language)


def _report(centres: Centres, turning: Mapping[str, Turning], letters: Letters, language: str, width: float) -> Block:
    """What Kennedy's theorem does not give and why, and the velocities by centres."""
    lines: list[str] = []
    for each in languages(language):
        for centre in centres.indeterminate:
            sentences = [_say(centre.why, each, letters)] if centre.why else []
            if centre.way:
                kept = ", ".join(centres.kept)
                sentences.append(_say(Phrase(f"centre {centre.way}", (centre.pair, kept)), each, letters))
            lines.append(word("sentence joint", each).join(sentences))
    spoken = velocity_sentences(centres, turning)
    head = [term("velocities by centres", language)] if spoken else []
    found = [said for phrase in spoken for said in _in_all(phrase, language, letters)]
    return column(prose(lines, width, 3.0, classes=TOLD), prose(head, width, 3.2, bold=True, classes=TOLD),
                  prose(found, width, 3.0, classes=TOLD))  # fmt: skip


def _in_all(phrase: Phrase, language: str, letters: Letters) -> tuple[str, ...]:
    """A sentence in each language of a sheet: its formulas and symbols once, with the further languages in brief."""
    first, *others = languages(language)
    said = _say(phrase, first, letters)
    brief = [word(f"{phrase.key} briefly", each, "") for each in others]
    if others and all(brief):
        return (" ".join((said, *brief)),)
    return tuple(dict.fromkeys((said, *(_say(phrase, each, letters) for each in others))))


def _rich(phrase: Phrase, language: str, letters: Letters) -> RichText:
    """A sentence with its symbols as a convention writes them."""

    def show(argument: object) -> str:
        if isinstance(argument, Symbol):
            return Markup(letters.vector(argument))
        if isinstance(argument, PointRef):
            return Markup(letters.point(argument.point))
        return Markup(letters.centre(argument)) if isinstance(argument, tuple) else str(argument)

    return rich_text(phrase, language, show)


def _say(phrase: Phrase, language: str, letters: Letters) -> str:
    return as_markup(_rich(phrase, language, letters))


def _description(centres: Centres, turning: Mapping[str, Turning], letters: Letters, language: str) -> str:
    """Every centre in words, for those who do not see the figure."""
    said = []
    for each in languages(language):
        for centre in centres.found:
            name = letters.centre(centre.pair).replace("_{", "").replace("}", "")
            place = "?" if centre.direction is None else "∞"
            if centre.point is not None:
                place = f"({', '.join(f'{x:.4g}' for x in place_of(centres, centre) or ())})"
            how = how_found(centre, letters, each, centres) if centre.number else centre.joint
            said.append(f"{name} {place}: {how.replace('$', '').replace('_{', '').replace('}', '')}")
        said += [
            as_plain(_rich(phrase, each, letters))
            for phrase in velocity_sentences(centres, turning)
        ]
    return "\n".join(said)


WIDTH = 194.0  # mm of a page between its margins
COLUMNS, ROWS = 2, 3
PICTURE, BETWEEN = (95.5, 76.0), 3.0  # mm, width and height of a picture, and between pictures
APART, INSIDE = 1.0, 3.0  # mm from the frame of a picture to names, and to what it shows
LETTER = 3.0
ROUNDS = 4  # how often names are placed anew without those that have no clear place


def named_centres(piece: Piece, panel: Box, centres: Centres) -> Piece:
    """A figure of centres with its names in their places; in a crowd without those of found centres that would stand on
    others or have leaders through joints, which `untold` then returns too."""
    for _ in range(ROUNDS):
        named, crowded = with_crowd(piece, panel)
        ids = _overlapping(named) if crowded else set()
        marks = {label.mark for label in crowded if label.text.id in ids and _found(label, centres)}
        if not marks:
            break
        piece = replace(piece, labels=tuple(label for label in piece.labels if label.mark not in marks))
    return named


def _overlapping(named: Piece) -> set[str]:
    """The names that stand on others, or have leaders through joints."""
    written = named.layers["labels"]
    texts = {thing.id: text_box(thing) for thing in written if isinstance(thing, Text)}
    joints = obstacles_of(without(named, texts).drawn).areas
    ids = {a for a, b in permutations(texts, 2) if texts[a].overlaps(texts[b])}
    return ids | {
        name.id for leader, name in pairwise(written) if isinstance(leader, Line) and isinstance(name, Text)
        and any(one.clip(leader.start, leader.end) and one.distance(leader.start) > 0.0 for one in joints)
    }  # fmt: skip


def _found(label: Label, centres: Centres) -> bool:
    """Whether a name is that of centres that all lie where two lines cross."""
    at = label.mark
    if isinstance(at, tuple) or not label.text.id.startswith("label-centre-"):
        return False
    near = [c for c in centres.found if c.point is not None and abs(on_page(c.point) - at) < TOGETHER]
    return all(c.lines for c in near)


def untold(centres: Centres, drawn: Sequence[Primitive]) -> tuple[Centre, ...]:
    """The found centres within a figure whose lines are not named in what is drawn of it."""
    things = [*walk(tuple(drawn))]
    ids = {thing.id for thing in things if isinstance(thing, Text)}
    near = {thing.id for thing in things if isinstance(thing, Group) and "centre" in thing.classes
            and "far" not in thing.classes}  # fmt: skip
    names = {centre: "centre-" + "-".join(sorted(centre.pair)) for centre in centres.found if centre.lines}
    return tuple(c for c, name in names.items() if name in near and f"label-lines-{name}" not in ids)


def centre_steps(
    centres: Centres, some: Sequence[Centre], behind: Piece, letters: Letters, language: str
) -> tuple[Drawing, ...]:
    """Pages with a picture of some centres each: the mechanism, the two lines through the centres that are known, and
    where they meet.

    Parameters
    ----------
    centres : on a drawing of a scale that a picture has room for
    behind : its mechanism, pale
    """
    page = FigurePage(centres.sheet, "centres", language, letters, WIDTH)
    each = COLUMNS * ROWS
    return tuple(_page(page, centres, some[i : i + each], behind) for i in range(0, len(some), each))


def _page(page: FigurePage, centres: Centres, some: Sequence[Centre], behind: Piece) -> Drawing:
    pictures, said = [], [figure_title(centres.sheet, "lines of centres", page.language)]
    for centre in some:
        by = " × ".join(line_name(line, page.letters) for line in centre.lines)
        told = f"${page.letters.centre(centre.pair)}$ = {by}"
        said.append(f"{centre.number}. " + told.replace("$", "").replace("_{", "").replace("}", ""))
        picture = panel(*PICTURE, partial(_picture, centres, centre, behind, page.letters))
        pictures.append(column(numbered(centre.number, told, PICTURE[0], LETTER), framed(picture), gap=0.6))
    return page.drawing(
        page.term("lines of centres"), column(*rows(pictures, WIDTH, BETWEEN), gap=BETWEEN), page.scale("mechanism"),
        title="lines of centres", said="\n".join(said),
    )  # fmt: skip


def _picture(centres: Centres, centre: Centre, behind: Piece, letters: Letters, room: Box) -> Piece:
    """One centre with its two lines and the centres through which they lead."""
    through = dict.fromkeys(pair for line in centre.lines for pair in line.through if not isinstance(pair, str))
    known = (centres.of(*pair) for pair in through)
    table = {c.pair: replace(c, lines=()) for c in known} | {centre.pair: centre}
    alone = replace(centres, table=table)
    inside = room.grown(-INSIDE)
    content = near_box(alone, ink_box(behind.drawn) or Box(-10.0, -10.0, 10.0, 10.0), (inside.width, inside.height))
    origin = inside.centre - content.centre
    around = room.grown(-APART).moved(-origin)
    piece, crowded = with_crowd(joined((behind, centre_marks(alone, letters, around, behind.drawn))), around)
    piece = without(piece, {label.text.id for label in crowded if label.rank > 2})  # told above the picture
    return renamed(moved_piece(piece, origin), f"-{centre.number}")


FIGURES = (Figure("centres", centres_figure, "centres", lambda scene: True, place=5),)
