"""The figure of the structure: the numbered diagram with its compound hinges and high pairs, the mobility in numbers,
and the groups taken apart one by one against the order of solution, for one driver or for two beside each other."""

from __future__ import annotations

from cmath import phase
from collections.abc import Sequence
from dataclasses import replace

from graphkin.construction.sheet import Sheet
from graphkin.drawing import strokes, symbols
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters, letters_of
from graphkin.drawing.drawing import Drawing
from graphkin.drawing.headings import facts, figure_title, term
from graphkin.drawing.labels import Label
from graphkin.drawing.mechanism import bare_mechanism, links_alone
from graphkin.drawing.mechanism_on_paper import MechanismOnPaper, page
from graphkin.drawing.page_text import titled
from graphkin.drawing.piece import Piece, ink_box, joined, layer_groups, moved_piece, with_labels
from graphkin.drawing.primitives import Circle, Group, Line, Polygon, Primitive, Text
from graphkin.drawing.symbols import JOINT_RADIUS
from graphkin.drawing.text import plain, rich, symbol, wrapped
from graphkin.drawing.touching import replacing_links
from graphkin.structure import Cluster, Driven, Dyad, Element, Pair, Slide, Structure, Turn, links_of, replaced_pairs
from graphkin.words import Phrase, class_of, languages, say

__all__ = ["structure_figure"]

WIDTH, MARGIN = 190.0, 8.0
DIAGRAM = (96.0, 84.0)  # mm, room of the numbered diagram
PART = (56.0, 46.0)  # of a group
LINE, SIZE = 5.0, 3.0
TOUCH = 1e-6
FITS = 4  # times that the diagram is drawn smaller, to fit


def structure_figure(
    sheet: Sheet, others: Sequence[Structure] = (), *, language: str | None = None, convention: str | None = None
) -> Drawing:
    """The structure of a mechanism on a page.

    Parameters
    ----------
    others : the same mechanism with other drivers, shown beside it
    language : "en", "zh" or "both"; the scene's own if None
    convention : letters of points; the scene's own if None
    """
    spoken = language or sheet.scene.sheet.language
    letters = letters_of(sheet, convention or sheet.scene.sheet.convention)  # type: ignore[arg-type]
    words, y = titled(sheet, spoken, term("structure", spoken), MARGIN)
    y += 3.0
    panel = Box(MARGIN, y, MARGIN + DIAGRAM[0], y + DIAGRAM[1])
    pieces = [_diagram(sheet, letters, spoken, panel)]
    column = Box(panel.right + 5.0, y, WIDTH - MARGIN, panel.bottom)
    row = column.top
    for text, bold in _counted(sheet.structure, spoken):
        for runs in wrapped(text, SIZE, column.width, bold=bold):
            row += LINE
            words.append(Text(complex(column.left, row), runs))
    y = max(panel.bottom, row) + 4.0
    for structure in (sheet.structure, *others):
        y = _taken_apart(sheet, structure, letters, spoken, y, pieces, words)
    page_ = joined((*pieces, Piece({"labels": tuple(words)})))
    return Drawing(
        WIDTH, y + 4.0, layer_groups(page_), figure_title(sheet, "structure", spoken),
        ". ".join(text.replace("$", "") for text, _ in _counted(sheet.structure, spoken)),
        languages(spoken)[0], facts(sheet, "structure"),
    )  # fmt: skip


def _diagram(sheet: Sheet, letters: Letters, spoken: str, panel: Box) -> Piece:
    """The numbered diagram, as large as it fits, with a badge at each compound hinge and each high pair."""
    box = Box.around(sheet.points.values())
    room = min((panel.width - 26.0) / max(box.width, 1.0), (panel.height - 26.0) / max(box.height, 1.0))
    small = _scaled(sheet, room)
    piece = bare_mechanism(small, letters)
    for _ in range(FITS):  # discs and cams reach beyond the points, symbols keep their size
        drawn = ink_box(piece.drawn)
        over = 1.0 if drawn is None else max(drawn.width / (panel.width - 4.0), drawn.height / (panel.height - 4.0))
        if over <= 1.0:
            break
        room /= over
        small = _scaled(sheet, room)
        piece = bare_mechanism(small, letters)
    here = MechanismOnPaper(small, letters)
    labels = []
    for point, names in sheet.structure.hinges.items():
        count = len([n for n in names if n in sheet.scene.by_name])
        if count > 2 and point in here.places:
            text = Text(0j, rich(f"{count} − 1", 2.4, bold=True), "start", strokes.GREY, f"badge-{point}", ("label",))
            labels.append(Label(text, page(here.places[point]), rank=1))
    for pin in sheet.scene.pins:
        if pin.point in here.places:
            name = f"badge-{pin.point}-{pin.on}"
            text = Text(0j, symbol("p_{H}", 3.0), "start", strokes.GREY, name, ("label",))
            labels.append(Label(text, page(here.places[pin.point]), rank=1))
    for contact in sheet.scene.contacts:
        if contact.name in here.places and (contact.carrier or not contact.rolling):
            text = Text(0j, symbol("p_{H}", 3.0), "start", strokes.GREY, f"badge-{contact.name}", ("label",))
            labels.append(Label(text, page(here.places[contact.name]), rank=1))
    for cam in here.cams:
        if cam.roller:
            text = Text(0j, plain(term("own turning", spoken), 2.4), "start", strokes.GREY,
                        f"badge-roller-{cam.cam.follower}", ("label",))  # fmt: skip
            labels.append(Label(text, page(cam.point), rank=1))
    whole = joined((replacing_links(here), piece, Piece(labels=tuple(labels))))
    ink = ink_box(whole.drawn) or panel
    return with_labels(moved_piece(whole, panel.centre - ink.centre), panel)


def _scaled(sheet: Sheet, times: float) -> Sheet:
    """The same places so many times as large, of any hands."""
    return replace(
        sheet,
        scales=replace(sheet.scales, length=sheet.scales.length / times),
        poses={name: pose.scaled(times) for name, pose in sheet.poses.items()},
        points={ref: z * times for ref, z in sheet.points.items()},
        steps=(),
    )


def _counted(structure: Structure, spoken: str) -> list[tuple[str, bool]]:
    """The mobility with its numbers, what it means, and the class of the mechanism."""
    m, drivers = structure.mobility, len(structure.scene.drivers)
    high = f" − {m.higher}" if m.higher else ""
    lines = [
        (f"$F$ = 3 $n$ − 2 $p_{{L}}$ − $p_{{H}}$ = 3 · {m.links} − 2 · {m.lower}{high} = {m.value}", True),
    ]
    compound = {p: len([n for n in names if n in structure.scene.by_name]) for p, names in structure.hinges.items()}
    idle = [link.name for link in structure.scene.links if link.redundant]
    order = max((_order(g) for g in structure.groups), default=1)
    for each in languages(spoken):
        lines.append((say(Phrase("structure counts", (m.links, m.lower, m.higher)), each), False))
        lines.append((say(Phrase("structure definite", (m.value, drivers)), each), False))
        for point, count in compound.items():
            if count > 2:
                lines.append((say(Phrase("structure compound", (point, count, count - 1)), each), False))
        for pin in (structure.scene.instead_of or structure.scene).pins:
            lines.append((say(Phrase("structure high pair", (pin.point, pin.on)), each), False))
        for cam in structure.scene.cams:
            lines.append((say(Phrase("structure cam", (cam.link, cam.follower)), each), False))
            if cam.roller:
                lines.append((say(Phrase("structure roller", (cam.follower,)), each), False))
        lines += [(say(phrase, each), False) for phrase in replaced_pairs(structure)]
        if idle:
            lines.append((say(Phrase("structure redundant", (", ".join(idle),)), each), False))
        lines.append((say(Phrase("structure class", (class_of(order),)), each), True))
    return lines


def _order(group: Dyad | Cluster) -> int:
    return group.order if isinstance(group, Cluster) else 2


def _taken_apart(
    sheet: Sheet, structure: Structure, letters: Letters, spoken: str, y: float, pieces: list[Piece],
    words: list[Primitive],
) -> float:  # fmt: skip
    """The groups in the reverse order of solution, the drivers last, each in a panel of its own."""
    order = max((_order(g) for g in structure.groups), default=1)
    names = ", ".join(d.key for d in structure.scene.drivers)
    for each in languages(spoken):
        y += LINE
        text = say(Phrase("structure driven by", (names, class_of(order))), each)
        words.append(Text(complex(MARGIN, y), rich(text, SIZE, bold=True)))
    groups = [*reversed(structure.groups)]
    driven = [e for e in structure.elements if isinstance(e, Driven)]
    shown: list[tuple[str, Sequence[Element]]] = [(str(k), (g,)) for k, g in enumerate(groups, 1)]
    if driven:  # a driver inside a group has no part of its own
        shown.append((str(len(shown) + 1), driven))
    x, bottom = MARGIN, y
    for number, elements in shown:
        if x + PART[0] > WIDTH - MARGIN + 0.1:
            x, y = MARGIN, bottom + 2.0
        panel = Box(x, y + 2.0, x + PART[0], y + 2.0 + PART[1])
        tag = f"{names.replace('/', '-').replace(', ', '-')}-{number}"
        pieces.append(_group(sheet, elements, letters, panel, tag))
        line = panel.bottom
        for text in _about(elements, spoken):
            for runs in wrapped(text, 2.6, PART[0] - 2.0):
                line += 4.0
                words.append(Text(complex(x, line), runs))
        bottom = max(bottom, line)
        x += PART[0] + 3.0
    return bottom + 4.0


def _about(elements: Sequence[Element], spoken: str) -> list[str]:
    said = []
    for each in languages(spoken):
        for element in elements:
            if isinstance(element, Driven):
                said.append(say(Phrase("structure driver", (element.link,)), each))
                continue
            inner, outer = _joints(element)
            args = (
                ", ".join(element.links), "" if isinstance(element, Cluster) else f" {element.kind}",
                class_of(_order(element)), ", ".join(map(_named, inner)), ", ".join(map(_named, outer)),
            )  # fmt: skip
            said.append(say(Phrase("structure group", args), each))
    return said


def _joints(element: Dyad | Cluster) -> tuple[list[Pair], list[Pair]]:
    """Inner joints, between links of the group, and outer ones, to others."""
    if isinstance(element, Dyad):
        welds = [w.pair for body in element.bodies for w in body.welds]
        return [element.inner, *welds], [element.outer_first, element.outer_second]
    own = set(element.members)
    inner = [p for p in element.pairs if {p.a, p.b} <= own]
    return inner, [p for p in element.pairs if not {p.a, p.b} <= own]


def _named(pair: Pair) -> str:
    return pair.point if isinstance(pair, Turn) else pair.key


def _group(sheet: Sheet, elements: Sequence[Element], letters: Letters, panel: Box, tag: str) -> Piece:
    """The links of a group alone, where they lie, inner joints filled and outer ones open."""
    links = {n for e in elements for n in links_of(e)}
    inner: list[Pair] = []
    outer: list[Pair] = []
    for element in elements:
        more = ([], [element.pair]) if isinstance(element, Driven) else _joints(element)
        inner += more[0]
        outer += more[1]
    here = MechanismOnPaper(sheet, letters)
    frame = Group((Polygon(panel.corners, "", strokes.DIMENSION),), classes=("panel",))
    spots = [z for shape in here.shapes if shape.link in links for part in shape.segments for z in part]
    spots += [b.at for b in here.sliders if b.slide.a in links]
    spots += [here.places[p] for n in links if n in sheet.structure.links
              for p in sheet.structure.links[n].points if p in here.places]  # fmt: skip
    if not spots:
        return Piece({"construction": (frame,)})
    box = Box.around(map(page, spots))
    times = min((PART[0] - 22.0) / max(box.width, TOUCH), (PART[1] - 20.0) / max(box.height, TOUCH), 1.0)
    here = MechanismOnPaper(_scaled(sheet, times), letters)
    parts, labels = links_alone(here, links, 1)
    for name in links:
        tips = [here.places[p] for p in sheet.structure.links[name].bar if p in here.places]
        if name not in here.scene.by_name and len(tips) == 2:  # the bar that replaces a contact
            parts.append(Line(page(tips[0]), page(tips[1]), strokes.REDUNDANT.coloured(here.colour(name))))
    for b in here.sliders:
        if b.slide.key in {p.key for p in (*inner, *outer) if isinstance(p, Slide)}:
            parts += symbols.block(page(b.at), phase(b.along), here.colour(b.slide.a))
            if b.slide.b not in links:  # the guide belongs to another link
                ends = page(b.at - 8.0 * b.along), page(b.at + 8.0 * b.along)
                parts.append(Line(*ends, strokes.DIRECTION))
            if b.slide.a in links and not any(s.link == b.slide.a and s.longest for s in here.shapes):
                text = Text(0j, plain(b.slide.a.split("/")[-1], bold=True), "start", here.colour(b.slide.a),
                            classes=("label",))  # fmt: skip
                labels.append(Label(text, page(b.at), rank=1))
    for pairs, fill in ((outer, strokes.WHITE), (inner, strokes.BLACK)):
        for pair in pairs:
            if isinstance(pair, Turn) and pair.point in here.places:
                at = page(here.places[pair.point])
                parts.append(Circle(at, JOINT_RADIUS * 0.85, fill=fill, stroke=strokes.OUTLINE))
                letter = Text(0j, symbol(letters.point(pair.point), 3.0), "start", classes=("label",))
                labels.append(Label(letter, at))
    piece = Piece({"mechanism": (Group(tuple(parts), id=f"group-{tag}"),)}, tuple(labels))
    ink = ink_box(piece.drawn) or panel
    placed = with_labels(moved_piece(piece, panel.centre - ink.centre), panel.grown(-0.6))
    return joined((Piece({"construction": (frame,)}), placed))
