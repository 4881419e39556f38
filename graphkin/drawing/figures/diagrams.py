"""A figure on a page of its own: mechanism, velocity polygon, acceleration polygon, with heading and scale; and the
polygons of several positions beside each other, all at the same scales, a column a position.

While a hand moves the mechanism its links, vectors and letters are drawn at once, without the search for free room;
dimensions, insets and rate arrows come when the hand rests and the figure is drawn in full.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

from graphkin.account.given import drivers
from graphkin.account.headings import (
    FIGURE_WORDS,
    describe,
    dimensions_in,
    figure_title,
    remarks,
    term,
)
from graphkin.account.voice import Account
from graphkin.checking.readings import read_off
from graphkin.checking.report import measured
from graphkin.construction import Room, Scales
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import DiagramName
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import GAP, Block, FigurePage, column, framed, line, panel, prose, row
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink.primitives import Text, page_direction
from graphkin.drawing.parts.insets import (
    mechanism_with_inset,
    polygon_with_insets,
    scan_piece,
    strip_height,
)
from graphkin.drawing.parts.mechanism import bare_mechanism, mechanism_piece
from graphkin.drawing.parts.polygon import PolygonOnPage, extent, polygon_piece
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups, middle_of, moved_piece, renamed
from graphkin.drawing.text import box_about
from graphkin.drawing.write.drawing import Drawing
from graphkin.scene.model import Mechanism
from graphkin.scene.scene_tables import DIAGRAMS
from graphkin.words import languages
from graphkin.words.symbols import spaced
from graphkin.words.written import printed

ROOM = 12.0  # mm around the figure, for names


def diagram_figure(diagram: DiagramName, page: FigurePage) -> Drawing | None:
    """The mechanism or one of its polygons at its true scale, on a page of its own; None for accelerations that were
    not drawn."""
    page = replace(page, name=diagram)
    sheet, spoken, letters = page.sheet, page.language, page.letters
    if diagram == "acceleration" and not sheet.vectors[diagram]:
        return None
    piece, content = mechanism_piece(sheet, letters) if diagram == "mechanism" else (Piece(), extent(sheet, diagram))
    page = page.wide_enough(content.width + 2 * ROOM)
    strip = 0.0 if diagram == "mechanism" else strip_height(sheet, diagram, page.width)

    def drawn(room: Box) -> Piece:
        around = Box(room.left, room.top, room.right, room.bottom - strip)
        origin = around.centre - content.centre
        if diagram == "mechanism":
            whole = mechanism_with_inset(sheet, letters, spoken, piece, origin, around)
        else:
            insets = Box(room.left, around.bottom, room.right, room.bottom)
            whole, _ = polygon_with_insets(sheet, diagram, letters, spoken, around, origin, insets)
        return joined((scan_piece(sheet, diagram, origin, around), whole)) if sheet.scene.question.scans else whole

    account = Account(sheet, letters)
    notes = [account.sentence(note, each) for each in languages(spoken) for note in remarks(sheet)]
    words = prose(notes, page.width, 2.5, classes=("remark",))
    title = FIGURE_WORDS[diagram]
    unit = dimensions_in(sheet, spoken) if diagram == "mechanism" else ""
    return page.drawing(
        page.at_drivers(page.term(title)), column(words, page.panel(content.height + 2 * ROOM + strip, drawn), gap=GAP),
        spaced(",  ", filter(None, (page.scale(diagram), unit))), title=title, said=describe(sheet, (diagram,), spoken),
        note="" if diagram == "mechanism" else term("step number", page.language, number="(9)"),
    )


def diagram_figures(page: FigurePage, names: Sequence[DiagramName] = DIAGRAMS) -> dict[str, Drawing]:
    """The drawn figures of a sheet by name."""
    figures = ((name, diagram_figure(name, page)) for name in names)
    return {name: figure for name, figure in figures if figure is not None}


def contacts_figure(page: FigurePage) -> Drawing:
    """The polygons at the points of contact, a page each."""
    velocity, *further = diagram_figures(page, DIAGRAMS[1:]).values()
    return replace(velocity, further=tuple(further))


def _touches(scene: Mechanism) -> bool:
    return any(pair.replaced for pair in scene.higher_pairs) or bool(scene.replacing)


MOVING = 20.0  # mm around what is drawn while a hand moves it
ASIDE = 1.6  # mm from a point, or from the middle of a segment, to the box of its name


def figure_in_motion(diagram: DiagramName, page: FigurePage) -> Drawing:
    """The mechanism or one of its polygons, every name beside its mark, wherever that is."""
    sheet, spoken, letters = page.sheet, page.language, page.letters
    if diagram == "mechanism":
        piece = bare_mechanism(sheet, letters)
        content = ink_box(piece.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    else:
        content = extent(sheet, diagram)
        panel = content.grown(MOVING)
        piece = polygon_piece(PolygonOnPage(sheet, diagram, letters, languages(spoken)[0], panel, 0j))
    size = complex(content.width + 2 * MOVING, content.height + 2 * MOVING)
    piece = moved_piece(piece, size / 2 - content.centre)
    named = joined((piece, Piece({"labels": tuple(_beside(label) for label in piece.labels if label.rank < 3)})))
    title = figure_title(sheet, FIGURE_WORDS[diagram], spoken)
    return Drawing(size.real, size.imag, layer_groups(named), title, "", languages(spoken)[0])


def _beside(label: Label) -> Text:
    """A name on the preferred side of its mark, by default right above it."""
    box = box_about(label.text.runs)
    if label.toward:
        away = page_direction(label.toward[0])
    elif isinstance(label.mark, tuple) and label.mark[0] != label.mark[1]:
        along = (label.mark[1] - label.mark[0]) / abs(label.mark[1] - label.mark[0])
        away = along * (-1j if along.real >= 0 else 1j)
    else:
        away = page_direction(0.8)
    half = abs(away.real) * box.width / 2 + abs(away.imag) * box.height / 2
    centre = middle_of(label.mark) + away * (half + ASIDE)
    return label.text._replace(at=centre - box.centre, anchor="start", since=None)


GUTTER = 4.0  # mm between panels
PANELS: Mapping[int, tuple[float, float]] = {1: (190.0, 100.0), 2: (93.0, 96.0), 3: (89.67, 92.0)}
"""Width and height (mm) of the panels, by the columns of a page."""
ROOM_BESIDE = 20.0  # of a panel, for names
MOST = 3  # columns of a page


def polygons_beside(page: FigurePage, sheets: Sequence[tuple[str, Sheet]]) -> Drawing:
    """The polygons of positions beside each other, continued on further pages.

    Parameters
    ----------
    sheets : the name of each position, and the exact drawing there
    """
    columns = min(MOST, len(sheets))
    wide, tall = PANELS[columns]
    page = replace(page, width=columns * (wide + GUTTER) - GUTTER)
    room = Room((wide - ROOM_BESIDE, tall - ROOM_BESIDE), (wide - ROOM_BESIDE, tall - ROOM_BESIDE))
    of_each = [sheet.scales_for(room) for _, sheet in sheets]
    coarsest = (max(scales.of(order) for scales in of_each) for order in DIAGRAMS[1:])
    scales = Scales(page.sheet.scales.length, *coarsest)
    drawn = [(name, sheet.at(scales)) for name, sheet in sheets]
    shown = DIAGRAMS[1:] if any(sheet.vectors["acceleration"] for _, sheet in sheets) else DIAGRAMS[1:2]
    pages = [_page(page, drawn[k : k + columns], shown, (wide, tall)) for k in range(0, len(drawn), columns)]
    further = (replace(drawing, title=f"{drawing.title} ({number})") for number, drawing in enumerate(pages[1:], 2))
    return replace(pages[0], further=tuple(further))


def _page(
    page: FigurePage, some: Sequence[tuple[str, Sheet]], shown: Sequence[DiagramName], size: tuple[float, float]
) -> Drawing:
    page = replace(page, sheet=some[0][1])
    names = [name for name, _ in some]
    positions = (_position(page, name, sheet, shown, size) for name, sheet in some)
    colon = page.punctuation("colon")
    scales = (page.term(FIGURE_WORDS[diagram]) + colon + page.scale(diagram) for diagram in shown)
    return page.drawing(
        spaced(";  ", scales), row(*positions, gap=GUTTER), "", title="polygons",
        said=page.punctuation("symbol comma").join(names), metadata={"positions": names},
    )


def _position(
    page: FigurePage, name: str, sheet: Sheet, shown: Sequence[DiagramName], size: tuple[float, float]
) -> Block:
    """The polygons of a position below each other, and the measured values of the scene's questions there."""
    letters, units = page.letters, sheet.scene.units

    def polygon(diagram: DiagramName, room: Box) -> Piece:
        content = extent(sheet, diagram, room.grown(-3.0))
        origin = room.centre - content.centre
        drawn, _ = polygon_with_insets(sheet, diagram, letters, page.language, room.grown(-0.8), origin)
        return renamed(drawn, f"-at-{_plain(name)}")

    said = term("position named", page.language, position=name)
    named = sheet.scene.question.positions is not None and name in sheet.scene.question.positions.names
    head = (said + page.punctuation("colon")) * named + drivers(sheet, letters)
    readings = [
        letters.vector(r.symbol) + f" = {printed(measured(r, units))} {r.symbol.unit(units).written}"
        for r in read_off(sheet, [s for s in sheet.scene.question.find if s.scope == "motion" and not s.at])
    ] if sheet.scene.question.find else []
    panels = (framed(panel(*size, partial(polygon, diagram))) for diagram in shown)
    return column(line(head, size[0], 3.2), column(*panels, prose((spaced(";  ", readings),), size[0]), gap=GUTTER))


def _plain(name: str) -> str:
    """A name for an id: a prime becomes p."""
    return "".join(c if c.isalnum() else "p" if c in "'′" else "-" for c in name)


FIGURES = (
    *(Figure(name, partial(diagram_figure, name), by_itself=lambda scene: True, place=place)
      for place, name in enumerate(DIAGRAMS, 1)),
    Figure("polygons", polygons_beside, "sheets beside", of_all=True, place=8),
    Figure("contacts", contacts_figure, "sheet at contacts", _touches, of_all=True, place=10),
)
