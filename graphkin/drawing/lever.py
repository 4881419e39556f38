"""The figure of Zhukovsky's lever: the velocity polygon turned by 90 degrees, each force at the end point of its
point's velocity, arms about the pole, and the sum of moments that gives what balances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from graphkin.construction.forces.force_sheet import ForceSheet, ForceState, Lever, LeverRow
from graphkin.construction.sheet import Extent, Sheet, fitting_scale
from graphkin.drawing.bilingual import in_both
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters, as_vector, force_letters, letters_of, pole, scale_statement
from graphkin.drawing.force_words import lever_sum
from graphkin.drawing.headings import drivers, facts, figure_title, term, written
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, Run, Text
from graphkin.drawing.ink.symbols import COMPONENT, RESULTANT, arrow
from graphkin.drawing.page_text import titled
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, cut_to, joined, layer_groups, middle_of, moved_piece
from graphkin.drawing.text import fitted, rich, symbol, wrapped
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import unit
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, languages, say
from graphkin.words.written import amount, on_paper, product

__all__ = ["lever_figure", "lever_on_page"]

WIDTH, MARGIN = 190.0, 8.0
HIGHEST = 130.0  # mm of a lever
ARROW, ROOM = 14.0, 20.0  # mm of an arrow that only shows a direction, and around the lever
ROW, SIZE = 4.6, 2.8
SHORT = 0.3  # mm: a nearer end point is at the pole
DIGITS = 5


def lever_figure(
    sheet: Sheet, forces: ForceSheet, *, language: str | None = None, convention: str | None = None
) -> Drawing | None:
    """A lever for each driver, at the scale of the velocities; None where nothing that balances moves.

    Parameters
    ----------
    sheet, forces : what is drawn of motion and of forces
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    shown = [(k, state, lever) for k, state in enumerate(forces.states) for lever in forces.levers[k]]
    if not shown:
        return None
    spoken = language or sheet.scene.sheet.language
    letters = letters_of(sheet, convention or sheet.scene.sheet.convention)  # type: ignore[arg-type]
    words, y = titled(sheet, spoken, f"{term('lever', spoken)}:  {drivers(sheet, letters)}", MARGIN)
    y += 1.5
    inside = WIDTH - 2 * MARGIN
    for each in languages(spoken):
        reasons = [say(Phrase("lever reason", (f"${pole(letters.convention, 'velocity')}$",)), each)]
        reasons += [say(Phrase("lever couple"), each)] * any(row.pair for _, _, one in shown for row in one.rows)
        reasons += [say(Phrase("lever virtual"), each)] * any(one.virtual for _, _, one in shown)
        for runs in (r for text in reasons for r in wrapped(text, SIZE, inside)):
            y += ROW
            words.append(Text(complex(MARGIN, y), runs))
    y += 3.0
    pieces: list[Piece] = []
    for number_, (k, state, lever) in enumerate(shown):
        if len(forces.states) > 1:
            for each in languages(spoken):
                y += ROW
                key = "force with load" if k else "force without load"
                words.append(Text(complex(MARGIN, y), rich(say(Phrase(key), each), SIZE, bold=True)))
            y += 2.0
        scaled, per_mm = lever_on_page(sheet, lever)
        box = _extent(scaled)
        panel = Box(MARGIN, y, WIDTH - MARGIN, y + box.height + 2 * ROOM)
        pieces.append(_drawn(sheet, scaled, letters, panel, panel.centre - box.centre, str(number_ or "")))
        y = panel.bottom
        at_scale = replace(sheet, scales=replace(sheet.scales, velocity=per_mm))
        told = scale_statement(at_scale, letters.convention, "velocity")
        words.append(Text(complex(MARGIN, y - 2.0), fitted(told, 3.2, 100.0)))
        y = _table(words, sheet, state, scaled, per_mm, letters, spoken, y + 2.0)
        y += 4.0
    words += check_bar(complex(WIDTH - MARGIN - 50.0, y + 3.0), rich(term("check bar", spoken), 2.4))
    page = joined((*pieces, Piece({"labels": tuple(words)})))
    per = lever_on_page(sheet, shown[0][2])[1] / sheet.scene.units.rates.metres
    return Drawing(
        WIDTH, y + 8.0, layer_groups(page), figure_title(sheet, "lever", spoken),
        say(Phrase("lever described"), languages(spoken)[0]), languages(spoken)[0],
        facts(sheet, "lever") | {"scales": {"velocity": float(f"{per:.12g}")}},
    )  # fmt: skip


def lever_on_page(sheet: Sheet, lever: Lever) -> tuple[Lever, float]:
    """A lever of a size that a page shows, and m/s for one of its mm: the sheet's own where it is no virtual one."""
    box = _extent(lever)
    wide, high = WIDTH - 2 * (MARGIN + ROOM), HIGHEST
    if not lever.virtual and box.width <= wide and box.height <= high:
        return lever, lever.per_mm
    metres = sheet.scene.units.rates.metres
    extent = Extent(box.width * lever.per_mm, box.height * lever.per_mm)
    per_mm = fitting_scale(extent, (wide, high), 1.0 / metres) * metres
    times = lever.per_mm / per_mm

    def larger(row: LeverRow) -> LeverRow:
        pair = None if row.pair is None else (row.pair[0] * times, row.pair[1] * times)
        return replace(row, at=row.at * times, arm=row.arm * times, moment=row.moment * times, pair=pair)

    made = replace(
        lever, per_mm=per_mm, ends={name: z * times for name, z in lever.ends.items()},
        rows=tuple(map(larger, lever.rows)), unknown=larger(lever.unknown),
    )  # fmt: skip
    return made, made.per_mm


def _extent(lever: Lever) -> Box:
    spots = [0j, *(row.at for row in lever.rows), *(z for row in lever.rows for z in row.pair or ())]
    spots += [z for z in lever.ends.values() if abs(z) > SHORT]
    return Box.around([z.conjugate() for z in spots])


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
        thin.append(Line(0j, end.conjugate(), strokes.RELATIVE))
        written_ = ", ".join(_end(letters, name) for name in names[:3])
        thin.append(Circle(end.conjugate(), 0.5, fill=strokes.BLACK))
        labels.append(Label(Text(0j, symbol(written_), "start", classes=("label",)), end.conjugate(), rank=1))
    mark = Text(0j, symbol(pole(letters.convention, "velocity")), "start", classes=("label",))
    labels.append(Label(mark, 0j, rank=0))
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
            shapes = arrow(at.conjugate(), tip.conjugate(), RESULTANT if found else COMPONENT, colour)
            arrows.append(Group(shapes, id=name, classes=("acting",)))
            markup = force_letters(letters.convention, row.symbol)
            named = as_vector(letters.convention, markup) if row.pair is None else f"{markup}/l"
            named = f"−{named}" if row.turned else named
            text = Text(0j, symbol(named, 3.0), "start", colour, f"label-{name}", ("label",))
            labels.append(Label(text, (at.conjugate(), tip.conjugate()), rank=0))
        if row.pair is None and abs(row.arm) > SHORT and ends_of:
            along = ends_of[0][1]
            foot = -1j * along * row.arm
            lines = [Line(0j, foot.conjugate(), strokes.DIMENSION)]
            if abs(foot - row.at) > SHORT:
                lines.append(Line(foot.conjugate(), row.at.conjugate(), strokes.DIRECTION))
            thin.append(Group(tuple(lines), classes=("arm",)))
            arm = force_letters(letters.convention, Symbol("arm", name=str(row.symbol))) + ("'" if row.turned else "")
            label = Text(0j, symbol(arm, 2.8), "start", strokes.GREY, classes=("label",))
            labels.append(Label(label, (0j, foot.conjugate()), rank=2))
    thin.append(Circle(0j, 0.9, fill=strokes.WHITE, stroke=strokes.OUTLINE))
    piece = Piece({"velocity": tuple(thin), "forces": tuple(arrows)}, tuple(labels))
    placed = moved_piece(piece, origin)
    layers = {name: cut_to(things, panel) for name, things in placed.layers.items()}
    labels_in = tuple(label for label in placed.labels if panel.holds(Box.around([middle_of(label.mark)])))
    return with_labels(Piece(layers, labels_in), panel)


def _end(letters: Letters, name: str) -> str:
    point, _, link = name.partition("@")
    return letters.end("velocity", PointRef(point, link)) or letters.point(point)


def _forces_at(row: LeverRow) -> list[tuple[complex, complex]]:
    """Where a row's force or pair of forces stands, and its direction."""
    if not row.force:
        return []
    if row.pair is None:
        return [(row.at, unit(row.force))] if row.symbol.is_vector else []
    tail, tip = row.pair
    return [(tip, unit(row.force)), (tail, -unit(row.force))]


def _table(
    words: list[Primitive], sheet: Sheet, state: ForceState, lever: Lever, per_mm: float, letters: Letters, spoken: str,
    y: float,
) -> float:  # fmt: skip
    """Force, arm and moment of each row, their sum, and what balances beside the value of the polygons."""
    units = sheet.scene.units
    columns = (MARGIN, MARGIN + 45.0, MARGIN + 80.0, MARGIN + 125.0)
    heads = (term("force heads", spoken), f"{units.force}", f"{term('arm', spoken)}, mm",
             f"{term('moment about pole', spoken)}, {units.force}·mm")  # fmt: skip
    y += 4.0
    words += [Text(complex(x, y), rich(head, 2.5)) for x, head in zip(columns, heads, strict=True)]
    words.append(Line(complex(MARGIN, y + 1.4), complex(WIDTH - MARGIN, y + 1.4), strokes.OUTLINE))
    y += 0.8
    for row in lever.rows:
        if not row.force:
            continue
        y += ROW
        words += _row(row, columns, y, units.newtons, letters)
    y += 1.4
    words.append(Line(complex(MARGIN, y), complex(WIDTH - MARGIN, y), strokes.DIMENSION))
    sums = zip(*(lever_sum(sheet, state, lever, letters, each) for each in languages(spoken)), strict=True)
    for said, bold in zip(sums, (False, True), strict=True):
        for line in in_both(said):
            y += ROW
            words.append(Text(complex(MARGIN, y), rich(line, SIZE, bold=bold)))
    return y


def _row(
    row: LeverRow, columns: Sequence[float], y: float, newtons: float, letters: Letters
) -> list[Text]:
    size = amount(abs(row.force) / newtons, DIGITS)
    arm = on_paper(abs(row.arm))
    sign = "−" if row.moment < 0 else ""
    whole = f"{sign}{written(product(size, arm, carried=DIGITS))}" if row.arm else "0"
    opposite = "−" if row.turned else ""
    name = f"{opposite}${force_letters(letters.convention, row.symbol)}$" + (" / $l$" if row.pair is not None else "")
    cells: list[tuple[Run, ...]] = [rich(text, SIZE) for text in (name, written(size), written(arm), whole)]
    return [Text(complex(x, y), runs) for x, runs in zip(columns, cells, strict=True)]
