"""The figure of Zhukovsky's lever: the velocity polygon turned by 90 degrees, each force at the end point of its
point's velocity, arms about the pole, and the sum of moments that gives what balances."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from graphkin.account.forces import SHORT, ForceAccount, lever_on_page, spots_of
from graphkin.account.headings import written
from graphkin.account.notation import Letters, as_vector, force_letters, pole
from graphkin.checking.report import Report
from graphkin.construction.forces.force_sheet import ForceSheet, ForceState, Lever, MomentTerm
from graphkin.construction.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import Block, FigurePage, column, table
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, on_page
from graphkin.drawing.ink.symbols import COMPONENT, RESULTANT, arrow
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, cut_to, middle_of, moved_piece
from graphkin.drawing.text import symbol
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import unit
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, languages, word
from graphkin.words.written import amount, on_paper, product

__all__ = ["FIGURES", "lever_figure"]

ARROW, ROOM = 14.0, 20.0  # mm of an arrow that only shows a direction, and around the lever
COLUMNS = 42.0, 34.0, 34.0, 64.0  # mm: force, its size, arm, moment
DIGITS = 5


def lever_figure(
    sheet: Sheet, forces: ForceSheet, report: Report | None = None, *, language: str | None = None,
    convention: str | None = None,
) -> Drawing | None:
    """A lever for each driver, at the scale of the velocities; None where nothing that balances moves.

    Parameters
    ----------
    sheet, forces : what is drawn of motion and of forces
    report : its check, where that has scales of its own
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    shown = [(k, state, lever) for k, state in enumerate(forces.states) for lever in state.levers]
    if not shown:
        return None
    sheet = sheet if report is None else replace(sheet, scales=report.scales)
    page = FigurePage.of(sheet, "lever", language, convention)
    why = [Phrase("lever reason", (f"${pole(page.convention, 'velocity')}$",))]
    why += [Phrase("lever couple")] * any(row.pair for _, _, lever in shown for row in lever.rows)
    why += [Phrase("lever virtual")] * any(lever.virtual for _, _, lever in shown)
    body = [page.prose(why)]
    for number, (k, state, lever) in enumerate(shown):
        if len(forces.states) > 1:
            body.append(page.prose((Phrase("force with load" if k else "force without load"),), bold=True))
        body += _lever(page, ForceAccount(sheet, forces, page.letters), state, lever, str(number or ""))
    per = lever_on_page(sheet, shown[0][2])[1] / sheet.scene.units.rates.metres
    return page.drawing(
        page.at_drivers(page.term("lever")), column(*body, gap=3.0), "", title="lever",
        said=page.said("lever described")[0], metadata={"scales": {"velocity": float(f"{per:.12g}")}},
    )  # fmt: skip


def _lever(
    page: FigurePage, account: ForceAccount, state: ForceState, lever: Lever, tag: str
) -> Iterator[Block]:
    """A lever, its scale, the moment of each force, their sum, and what balances beside the value of the polygons."""
    scaled, per_mm = lever_on_page(page.sheet, lever)
    box, units = Box.around(map(on_page, spots_of(scaled))), page.sheet.scene.units
    yield page.panel(
        box.height + 2 * ROOM,
        lambda room: _drawn(page.sheet, scaled, page.letters, room, room.centre - box.centre, tag),
    )
    yield page.prose([page.scale("velocity", per_mm)], 3.2)
    heads = [
        [word("force heads", each), units.force, f"{word('arm', each)}, mm",
         f"{word('moment about pole', each)}, {units.force}·mm"] for each in languages(page.language)
    ]  # fmt: skip
    yield table(heads, [_row(row, units.newtons, page.letters) for row in scaled.rows if row.force], COLUMNS)
    total, balance = account.lever(state, scaled)
    yield column(page.prose((total,)), page.prose((balance,), bold=True))


def _drawn(sheet: Sheet, lever: Lever, letters: Letters, panel: Box, origin: complex, tag: str) -> Piece:
    """The turned polygon with the forces on it."""
    thin: list[Primitive] = []
    arrows: list[Primitive] = []
    labels: list[Label] = []
    ends: dict[complex, list[str]] = {}
    for name, end in lever.ends.items():
        link = name.partition("@")[2]
        if abs(end) > SHORT and (not link or link in sheet.scene.by_name):
            ends.setdefault(complex(round(end.real, 2), round(end.imag, 2)), []).append(name)
    for end, names in ends.items():
        thin.append(Line(0j, on_page(end), strokes.RELATIVE))
        written_ = ", ".join(_end(letters, name) for name in names[:3])
        thin.append(Circle(on_page(end), 0.5, fill=strokes.BLACK))
        labels.append(Label.of(symbol(written_), on_page(end), rank=1))
    labels.append(Label.of(symbol(pole(letters.convention, "velocity")), 0j))
    taken: list[tuple[complex, complex]] = []
    balance = [(replace(lever.unknown, force=lever.unknown.force * (lever.value or 1.0)), True)]
    for row, found in [*((row, False) for row in lever.rows if row.force), *balance]:
        colour = strokes.LINK_COLOURS[1] if found else strokes.BLACK
        ends_of = _forces_at(row)
        for n, (at, along) in enumerate(ends_of):
            again = sum(abs(at - z) < 0.5 and abs(along - e) < 0.1 for z, e in taken)
            taken.append((at, along))
            tip = at + along * (ARROW + 4.0 * again)
            which = f"{row.symbol.id}-opposite" if row.turned else row.symbol.id
            name = f"lever-{which}{f'-{n + 1}' if len(ends_of) > 1 else ''}{tag}"
            shapes = arrow(on_page(at), on_page(tip), RESULTANT if found else COMPONENT, colour)
            arrows.append(Group(shapes, id=name, classes=("acting",)))
            markup = force_letters(letters.convention, row.symbol)
            named = as_vector(letters.convention, markup) if row.pair is None else f"{markup}/l"
            named = f"−{named}" if row.turned else named
            labels.append(Label.of(symbol(named, 3.0), (on_page(at), on_page(tip)), f"label-{name}", colour=colour))
        if row.pair is None and row.arm and abs(row.arm) > SHORT and ends_of:
            along = ends_of[0][1]
            foot = -1j * along * row.arm
            lines = [Line(0j, on_page(foot), strokes.DIMENSION)]
            if abs(foot - row.at) > SHORT:
                lines.append(Line(on_page(foot), on_page(row.at), strokes.DIRECTION))
            thin.append(Group(tuple(lines), classes=("arm",)))
            arm = force_letters(letters.convention, Symbol("arm", name=str(row.symbol))) + ("'" if row.turned else "")
            labels.append(Label.of(symbol(arm, 2.8), (0j, on_page(foot)), colour=strokes.GREY, rank=2))
    thin.append(Circle(0j, 0.9, fill=strokes.WHITE, stroke=strokes.OUTLINE))
    piece = Piece({"velocity": tuple(thin), "forces": tuple(arrows)}, tuple(labels))
    placed = moved_piece(piece, origin)
    layers = {name: cut_to(things, panel) for name, things in placed.layers.items()}
    labels_in = tuple(label for label in placed.labels if panel.holds(Box.around([middle_of(label.mark)])))
    return with_labels(Piece(layers, labels_in), panel)


def _end(letters: Letters, name: str) -> str:
    point, _, link = name.partition("@")
    return letters.end("velocity", PointRef(point, link)) or letters.point(point)


def _forces_at(row: MomentTerm) -> list[tuple[complex, complex]]:
    """Where a row's force or pair of forces stands, and its direction."""
    if not row.force:
        return []
    if row.pair is None:
        return [(row.at, unit(row.force))] if row.symbol.is_vector else []
    tail, tip = row.pair
    return [(tip, unit(row.force)), (tail, -unit(row.force))]


def _row(row: MomentTerm, newtons: float, letters: Letters) -> tuple[str, str, str, str]:
    """A force with its arm and moment."""
    size, arm = amount(abs(row.force) / newtons, DIGITS), on_paper(abs(row.arm or 0.0))
    moment = f"{'−' * (row.moment < 0)}{written(product(size, arm, carried=DIGITS))}" if row.arm else "0"
    name = f"{'−' * row.turned}${force_letters(letters.convention, row.symbol)}$" + " / $l$" * (row.pair is not None)
    return name, written(size), written(arm), moment


FIGURES = (Figure("lever", lever_figure, "forces", lambda scene: bool(scene.loading), of_all=True, place=14),)
