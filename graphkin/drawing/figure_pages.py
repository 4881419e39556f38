"""One figure on a page of its own: mechanism, velocity polygon, acceleration polygon, with heading and scale."""

from __future__ import annotations

from graphkin.checking.report import Report
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters, letters_of, scale_statement
from graphkin.drawing.headings import (
    FIGURE_WORDS,
    describe,
    dimensions_in,
    drivers,
    facts,
    figure_title,
    punctuation,
    remarks,
    term,
    titles,
)
from graphkin.drawing.ink.primitives import Primitive, Run, Text
from graphkin.drawing.parts.insets import mechanism_detail, polygon_with_insets, strip_height
from graphkin.drawing.parts.mechanism import mechanism_piece
from graphkin.drawing.parts.polygon_on_page import extent
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, joined, layer_groups, moved_piece
from graphkin.drawing.sheet import background_piece, scan_piece, sheet_page
from graphkin.drawing.text import fitted, rich, wrapped
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import languages

__all__ = ["acceleration_figure", "figures", "mechanism_figure", "velocity_figure"]

LEAST_WIDTH = 130.0
MARGIN = 8.0  # of the page
ROOM = 12.0  # around the figure, for names
LINE = 5.0  # from one line of the heading to the next
SMALL_LINE = 3.7
FOOT = 14.0
BAR = 56.0  # room of the check bar in it


def mechanism_figure(sheet: Sheet, *, language: str | None = None, convention: str | None = None) -> Drawing:
    """The mechanism at its true scale, on a page of its own.

    Parameters
    ----------
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    return _figure(sheet, "mechanism", language, convention)


def velocity_figure(sheet: Sheet, *, language: str | None = None, convention: str | None = None) -> Drawing:
    """The velocity polygon at its true scale, on a page of its own; parameters as for `mechanism_figure`."""
    return _figure(sheet, "velocity", language, convention)


def acceleration_figure(sheet: Sheet, *, language: str | None = None, convention: str | None = None) -> Drawing:
    """The acceleration polygon at its true scale, on a page of its own; parameters as for `mechanism_figure`."""
    return _figure(sheet, "acceleration", language, convention)


def _figure(sheet: Sheet, diagram: DiagramName, language: str | None, convention: str | None) -> Drawing:
    spoken = language or sheet.scene.sheet.language
    letters = letters_of(sheet, convention or sheet.scene.sheet.convention)  # type: ignore[arg-type]
    piece, content = mechanism_piece(sheet, letters) if diagram == "mechanism" else (Piece(), extent(sheet, diagram))
    width = max(LEAST_WIDTH, content.width + 2 * (ROOM + MARGIN))
    head = _heading(sheet, diagram, letters, spoken, width - 2 * MARGIN)
    notes = [
        runs for each in languages(spoken) for note in remarks(sheet, each, letters)
        for runs in wrapped(note, 2.5, width - 2 * MARGIN)
    ]  # fmt: skip
    top = MARGIN + LINE * len(head) + SMALL_LINE * len(notes) + 2.0
    panel = Box(MARGIN, top, width - MARGIN, top + content.height + 2 * ROOM)
    origin = panel.centre - content.centre
    bottom = panel.bottom
    if diagram == "mechanism":
        piece = with_labels(moved_piece(piece, origin), panel)
        under = background_piece(sheet, origin, panel)
        piece = joined((under, piece, mechanism_detail(sheet, letters, spoken, panel, piece.drawn)))
    else:
        bottom += strip_height(sheet, diagram, panel.width)
        strip = Box(panel.left, panel.bottom, panel.right, bottom)
        piece, _ = polygon_with_insets(sheet, diagram, letters, spoken, panel, origin, strip)
    if sheet.scene.scans:
        piece = joined((scan_piece(sheet, diagram, origin, panel), piece))
    height = bottom + FOOT
    words: list[Primitive] = [
        Text(complex(MARGIN, MARGIN + 3.5 + LINE * i), runs, classes=("heading",)) for i, runs in enumerate(head)
    ]
    y = MARGIN + LINE * len(head) + 2.6
    words += [Text(complex(MARGIN, y + SMALL_LINE * i), runs, classes=("remark",)) for i, runs in enumerate(notes)]
    unit = dimensions_in(sheet, spoken) if diagram == "mechanism" else ""
    told = ",  ".join(filter(None, (scale_statement(sheet, letters.convention, diagram), unit)))
    words.append(Text(complex(MARGIN, height - 6.0), fitted(told, 3.5, width - 2 * MARGIN - BAR)))
    words += check_bar(complex(width - MARGIN - 50.0, height - 6.0), rich(term("check bar", spoken), 2.5))
    if diagram != "mechanism":
        steps = fitted(term("step number", spoken), 2.4, width - 2 * MARGIN)
        words.append(Text(complex(MARGIN, height - 2.2), steps))
    page = joined((piece, Piece({"labels": tuple(words)})))
    return Drawing(
        width,
        height,
        layer_groups(page),
        figure_title(sheet, FIGURE_WORDS[diagram], spoken),
        describe(sheet, (diagram,), spoken),
        languages(spoken)[0],
        facts(sheet, diagram),
    )


def _heading(
    sheet: Sheet, diagram: DiagramName, letters: Letters, language: str, width: float
) -> list[tuple[Run, ...]]:
    lines = [line for title in titles(sheet, language) for line in wrapped(title, 4.0, width, bold=True)]
    lines += wrapped(
        term(FIGURE_WORDS[diagram], language) + punctuation("colon", language) + drivers(sheet, letters), 3.2, width
    )
    return lines


def figures(
    sheet: Sheet,
    sheet_a4: Sheet | None = None,
    report: Report | None = None,
    language: str | None = None,
    convention: str | None = None,
) -> dict[str, Drawing]:
    """All figures of a scene by name: "mechanism", "velocity", "acceleration" where it was drawn, and "sheet" where its
    own drawing is given (``sheet_a4``, drafted in ``sheet_room(scene)``), with "sheet-2" where it goes on.

    ``report`` is the check of that drawing.
    """
    made = {
        "mechanism": mechanism_figure(sheet, language=language, convention=convention),
        "velocity": velocity_figure(sheet, language=language, convention=convention),
    }
    if sheet.vectors("acceleration"):
        made["acceleration"] = acceleration_figure(sheet, language=language, convention=convention)
    if sheet_a4 is not None:
        made["sheet"] = whole = sheet_page(sheet_a4, report, language=language, convention=convention)
        made.update({f"sheet-{number}": page for number, page in enumerate(whole.further, 2)})
    return made
