"""The figure of the structure: the numbered diagram with its compound hinges and high pairs, the mobility in numbers,
and the groups taken apart one by one against the order of solution, for one driver or for two side by side."""

from __future__ import annotations

from cmath import phase
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

from graphkin.account.notation import Notation
from graphkin.construction.board.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import GAP, Block, FigurePage, column, framed, panel, prose, row, rows
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import Circle, Group, Line, on_page
from graphkin.drawing.ink.symbols import JOINT_RADIUS
from graphkin.drawing.parts.mechanism import bare_mechanism, links_alone
from graphkin.drawing.parts.mechanism_on_paper import MechanismOnPaper
from graphkin.drawing.parts.touching import badges, replacing_links
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, cut_to, ink_box, joined, moved_piece
from graphkin.drawing.text import plain, rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import dot
from graphkin.scene.pairs import Pair
from graphkin.structure import Driven, Element, LargerGroup, Structure, replacement_told
from graphkin.words import Phrase, class_of, languages, listed, rich_text, say
from graphkin.words.symbols import RichText, Words, sign, spaced

DIAGRAM = (96.0, 84.0)  # mm, room of the numbered diagram
PART = (56.0, 46.0)  # of a group
BESIDE = 5.0  # between the diagram and its numbers
SIZE = 3.0
TOUCH = 1e-6
FITS = 4  # times that the diagram is drawn smaller, to fit
POINTS_SHARE = 0.8  # of the room of a group, for its points, where what reaches further is cut


def structure_figure(page: FigurePage, others: Sequence[Structure] = ()) -> Drawing:
    """The structure of a mechanism on a page.

    Parameters
    ----------
    others : the mechanism with other drivers, shown beside it
    """
    sheet = page.sheet
    counted = _counted(sheet.structure, page.language)
    diagram = panel(*DIAGRAM, lambda room: _diagram(sheet, page.letters, page.language, room))
    lines = [prose((text,), page.width - DIAGRAM[0] - BESIDE, SIZE, bold=bold) for text, bold in counted]
    groups = (_taken_apart(page, structure) for structure in (sheet.structure, *others))
    body = column(row(diagram, column(*lines), gap=BESIDE), *groups, gap=4.0)
    return page.drawing(
        page.term("structure"), body, None, title="structure",
        said=spaced(". ", (text for text, _ in counted)),
    )


def _diagram(sheet: Sheet, letters: Notation, spoken: str, panel: Box) -> Piece:
    """The numbered diagram, as large as it fits, with a badge at each compound hinge and each high pair."""
    box = Box.around(sheet.points.values() or (0j,))
    times = min((panel.width - 26.0) / max(box.width, 1.0), (panel.height - 26.0) / max(box.height, 1.0))
    piece, times = _fitted(lambda size: bare_mechanism(sheet.larger(size), letters), times, panel.grown(-2.0))
    here = MechanismOnPaper(sheet.larger(times), letters)
    labels = []
    for point, names in sheet.structure.hinges.items():
        count = len([n for n in names if n in sheet.scene.by_name])
        if count > 2 and point in here.places:
            labels.append(Label.of(rich(f"{count} − 1", 2.4, bold=True), on_page(here.places[point]), f"badge-{point}",
                                   colour=strokes.GREY, rank=1))
    labels += badges(here, spoken)
    dashed = Piece({"mechanism": replacing_links(here, JOINT_RADIUS)}, tuple(labels))
    stood_for = {f"label-guide-{b.slide.b}-{b.slide.guide.name}" for b in here.sliders
                 if b.slide.key in here.replaced_pairs}
    piece = replace(piece, labels=tuple(label for label in piece.labels if label.text.id not in stood_for))
    # a profile covers what lies under it
    whole = joined((dashed, piece) if sheet.scene.instead_of is None else (piece, dashed))
    ink = ink_box(whole.drawn) or panel
    return with_labels(moved_piece(whole, panel.centre - ink.centre), panel)


def _fitted(draw: Callable[[float], Piece], times: float, room: Box) -> tuple[Piece, float]:
    """A drawing at a size, smaller until it fits a room, with its size: discs and cams reach beyond the points, and
    symbols keep their size."""
    piece = draw(times)
    for _ in range(FITS):
        ink = ink_box(piece.drawn)
        over = 1.0 if ink is None else max(ink.width / room.width, ink.height / room.height)
        if over <= 1.0:
            break
        times /= over
        piece = draw(times)
    return piece, times


def _counted(structure: Structure, spoken: str) -> list[tuple[Words, bool]]:
    """The mobility with its numbers, its meaning, and the class of the mechanism."""
    m, drivers = structure.mobility, len(structure.scene.drivers)
    high = f" − {m.higher}" if m.higher else ""
    lines: list[tuple[Words, bool]] = [
        (RichText(sign("F"), " = 3 ", sign("n"), " − 2 ", sign("p", "L"), " − ", sign("p", "H"),
                  f" = 3 · {m.links} − 2 · {m.lower}{high} = {m.value}"), True),
    ]
    compound = {p: len([n for n in names if n in structure.scene.by_name]) for p, names in structure.hinges.items()}
    idle = [link.name for link in structure.scene.links if link.redundant]
    for each in languages(spoken):
        lines.append((say(Phrase("structure counts", links=m.links, lower=m.lower, higher=m.higher), each), False))
        lines.append((say(Phrase("structure definite", mobility=m.value, drivers=drivers), each), False))
        for point, count in compound.items():
            if count > 2:
                hinge = Phrase("structure compound", point=point, links=count, pairs=count - 1)
                lines.append((say(hinge, each), False))
        lines += [(rich_text(phrase, each), False) for phrase in replacement_told(structure)]
        if idle:
            lines.append((say(Phrase("structure redundant", links=listed(idle)), each), False))
        order = _class(structure)
        if order is not None:
            lines.append((say(Phrase("structure class", order=class_of(order)), each), True))
    return lines


def _class(structure: Structure) -> int | None:
    """The class of the mechanism: the highest of its groups; None where only wheels follow the driver."""
    led = any(not e.driver.given for e in structure.driven)
    return max((g.order for g in structure.groups), default=None if led else 1)


def _taken_apart(page: FigurePage, structure: Structure) -> Block:
    """The groups in the reverse order of solution, the drivers last, each in a panel of its own."""
    keys = [driver.key for driver in structure.scene.drivers]
    order = _class(structure) if structure.groups else None
    drivers = page.said("structure ungrouped", links=listed(keys)) if order is None else (
        page.said("structure driven by", links=listed(keys), order=class_of(order)))
    shown: list[Sequence[Element]] = [(group,) for group in reversed(structure.groups)]
    if structure.driven:  # a driver inside a group has no part of its own
        shown.append(structure.driven)
    parts = []
    for number, elements in enumerate(shown, 1):
        tag = f"{'-'.join(keys).replace('/', '-')}-{number}"
        part = panel(*PART, partial(_group, page.sheet, elements, page.letters, tag))
        named = [element for element in elements if not isinstance(element, Driven)
                 or element.link in page.sheet.scene.by_name]  # without blocks that replace a pair
        lines = (_told(page.sheet, element, each) for each in languages(page.language) for element in named)
        about = prose(lines, PART[0] - 2.0, 2.6)
        parts.append(column(framed(part), about, gap=1.0))
    return column(page.prose(drivers, SIZE, bold=True), *rows(parts, page.width, gap=3.0), gap=GAP)


def _told(sheet: Sheet, element: Element, language: str) -> str:
    """A driver with its reference link, a link that follows the drivers, or a group with its joints."""
    if not isinstance(element, Driven):
        inner, outer = _joints(element)
        group = Phrase(
            "structure group", links=element.named, order=class_of(element.order),
            kind="" if isinstance(element, LargerGroup) else f" {element.kind}",
            inner=listed([p.key for p in inner]), outer=listed([p.key for p in outer]),
        )
        return say(group, language)
    driver = element.driver
    if not driver.given:
        led = "structure led" if driver.rolls else "structure follower"
        return say(Phrase(led, link=element.link, leading=driver.links[0]), language)
    other = next(name for name in reversed(driver.links) if name != element.link)
    if other == sheet.scene.frame.name:
        return say(Phrase("structure driver", link=element.link), language)
    return say(Phrase("structure driver on link", link=element.link, base=other), language)


def _joints(element: Element) -> tuple[list[Pair], list[Pair]]:
    """Inner joints, between links of the group, and outer ones, to others."""
    inner = [p for p in element.all_pairs if {p.a, p.b} <= {*element.members}]
    return inner, [p for p in element.all_pairs if p not in inner]


def _group(sheet: Sheet, elements: Sequence[Element], letters: Notation, tag: str, panel: Box) -> Piece:
    """The links of a group alone, in their places, inner joints filled and outer ones open; links that replace a higher
    pair are dashed.  As large as the panel allows, but not larger than in the diagram of the sheet."""
    def drawn(times: float) -> Piece:
        return _drawn_apart(MechanismOnPaper(sheet.larger(times), letters), elements, f"group-{tag}")

    room = Box(0.0, 0.0, panel.width - 16.0, panel.height - 14.0)
    inner = panel.grown(-0.6)
    piece, _ = _fitted(drawn, 1.0, room)
    ink = ink_box(piece.drawn)
    if ink is None:
        return Piece()
    if ink.width > inner.width or ink.height > inner.height:  # rails cross the room, which the points are to fill
        points = {p for e in elements for n in e.members for p in sheet.structure.links[n].points}
        box = Box.around([z for ref, z in sheet.points.items() if not ref.link and ref.point in points] or [0j])
        sides = (room.width, box.width), (room.height, box.height)
        piece = drawn(min((1.0, *(POINTS_SHARE * side / size for side, size in sides if size > 0.0))))
        ink = ink_box(piece.drawn) or panel
    whole = moved_piece(piece, panel.centre - ink.centre)
    layers = {name: cut_to(things, inner) for name, things in whole.layers.items()}
    return with_labels(replace(whole, layers=layers), inner)


def _drawn_apart(here: MechanismOnPaper, elements: Sequence[Element], id: str) -> Piece:
    """Links of elements with their joints as a group, and the names of both."""
    structure = here.sheet.structure
    links = dict.fromkeys(n for e in elements for n in e.members)  # in one order, whatever the process
    joints = [_joints(element) for element in elements]
    inner = [pair for within, _ in joints for pair in within]
    outer = [pair for _, beyond in joints for pair in beyond]
    parts, labels = links_alone(here, links, 1, replaced=True)
    for name in links:
        dashed = strokes.REDUNDANT.coloured(here.colour(name))
        held = structure.links[name]
        shape = next((shape for shape in here.shapes if shape.link == name), None)
        ends = [here.places[p] for p in (held.bar if shape is None else held.points) if p in here.places]
        if shape is not None:
            parts += [Line.between(a, b, strokes.LINK.coloured(here.colour(name))) for a, b in shape.slots]
            parts += [Line.between(ends[0], z, dashed) for z in ends[1:] if z not in shape.points.values()]
        elif len(ends) > 1:  # the bar that replaces a contact
            parts.append(Line.between(ends[0], ends[1], dashed))
    # where links touch every link has its number already
    numbered = {shape.link for shape in here.shapes if shape.longest or here.scene.higher_pairs}
    known = {b.slide.key: b for b in here.sliders}
    rolling = {pair.block for pair in here.scene.higher_pairs if pair.rolling}  # their centres keep a distance
    for slide in (pair for pair in (*inner, *outer) if not pair.turns and pair.key not in rolling):
        stands = slide.key not in known or (slide.higher and slide.key in here.replaced_pairs)
        at = here.places[slide.pin] if stands and slide.pin else known[slide.key].at
        along = slide.along(here.sheet.poses)
        colour = here.colour(slide.a)
        parts += symbols.block(on_page(at), phase(along), colour)
        ends = [at - 8.0 * along, at + 8.0 * along]
        if slide.b not in links:  # the guide belongs to another link
            parts.append(Line.between(ends[0], ends[1], strokes.DIRECTION))
        elif stands:  # along a face, from its link to beyond the block
            origin = here.sheet.poses[slide.b].origin
            foot = at + dot(origin - at, along) * along
            far = max(ends, key=lambda z: abs(z - foot))
            dashed = strokes.REDUNDANT.coloured(here.colour(slide.b))
            spans = (origin, foot), (foot, far)
            parts += [Line.between(a, b, dashed) for a, b in spans if abs(b - a) > TOUCH]
        if slide.a in links and slide.a in here.scene.by_name and slide.a not in numbered:
            numbered.add(slide.a)
            labels.append(Label.of(plain(slide.a, bold=True), on_page(at), colour=colour, rank=1))
    pins = {pair.point: strokes.WHITE for pair in outer if pair.turns}
    if any(isinstance(e, Driven) for e in elements):  # where groups hang on it
        pins |= {p: strokes.WHITE for n in links for p in structure.links[n].points if p in structure.hinges}
    pins |= {pair.point: strokes.BLACK for pair in inner if pair.turns}
    for point, fill in pins.items():
        if point in here.places:
            at = on_page(here.places[point])
            parts.append(Circle(at, JOINT_RADIUS * 0.85, fill=fill, stroke=strokes.OUTLINE))
            labels.append(Label.of(rich(here.letters.point(point), 3.0), at))
    return Piece({"mechanism": (Group(tuple(parts), id=id),)}, tuple(labels))


FIGURES = (Figure("structure", structure_figure, "structures", of_all=True, place=6),)
