"""The figures of forces, on one page or more.

The sheet of forces: given masses and loads, each group cut free, its polygon beside the sketch of its links with the
forces on them, its equations and readings, in the order of construction, and the readings with their check.
Zhukovsky's lever: the velocity polygon turned by 90 degrees, each force at the end point of its point's velocity, arms
about the pole, and the sum of moments that gives the balancing load.
"""

from __future__ import annotations

from cmath import phase
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from graphkin.account.forces import SHORT as SEEN
from graphkin.account.forces import (
    ForceStage,
    force_stages,
    lever_scale,
    lever_sum,
    read_off,
    spots_of,
    told_of,
)
from graphkin.account.given import given_loads
from graphkin.account.headings import figure_title
from graphkin.account.notation import Notation, as_vector, force_letters, pole
from graphkin.account.voice import Account
from graphkin.checking.report import Report
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import Vector
from graphkin.construction.forces.steps import BY_MOMENTS, COUPLES, ForceGroup, ForceVector, Lever, MomentTerm
from graphkin.construction.touching import Touching
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import MARGIN, Block, FigurePage, column, framed, pages, panel, prose, row, rows, table
from graphkin.drawing.equations import write_sum
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, on_page
from graphkin.drawing.ink.symbols import COMPONENT, JOINT_RADIUS, RESULTANT
from graphkin.drawing.parts.mechanism import links_alone
from graphkin.drawing.parts.mechanism_on_paper import MechanismOnPaper
from graphkin.drawing.parts.polygon import side_by_side
from graphkin.drawing.parts.touching import marks_cut_free
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups, moved_piece
from graphkin.drawing.plate import Plate, cut_piece
from graphkin.drawing.stepwise import tied
from graphkin.drawing.tables import TableRow, readings_table
from graphkin.drawing.text import rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import added_up, unit
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase, bodies_named, languages, rich_text, word
from graphkin.words.symbols import RichText, Words, sign, spaced
from graphkin.words.written import printed

SKETCH = 64.0  # mm, width of a sketch
AROUND = 11.0  # mm of room around a polygon
LEAST, SMALLEST, NARROW = 46.0, 26.0, 40.0  # mm, least heights of a sketch and a polygon, and width
APART, CLOSE, INSIDE = 4.0, 2.0, 0.6  # mm between groups, between the parts of one, and inside a frame


def forces_figure(page: FigurePage, report: Report) -> Drawing:
    """The forces of a drawn position on pages of the scene's paper.

    Parameters
    ----------
    report : readings compared with the exact values
    """
    sheet = page.sheet
    width, height = sheet.scene.question.sheet.size
    boxes = [box for state in page.sheet.forces for group in state.groups for *_, box in _polygons(group)]
    page = replace(page, width=max(width - 2 * MARGIN, *(box.width for box in boxes), 0.0))
    below = page.at_drivers(page.term("forces"))
    spare = page.height_for(below, height)
    needed = max((box.height for box in boxes), default=0.0) + 2 * page.prose(("force",)).height
    room, height = max(spare, needed), height + max(0.0, needed - spare)  # a larger paper for a wished scale
    rows = [TableRow(row) for row in report.rows if row.symbol.scope == "force"]
    blocks = [_given(page), *_groups(page, room), *_tables(page, rows, room)]
    units = sheet.scene.units
    scales = {"length": sheet.scales.length * 1e3, "force": sheet.scales.force / units.newtons}
    first, *further = (
        page.drawing(
            below, body, page.scale("force"), title="forces", said=page.said("force described")[0], height=height,
            note=" ".join(map(str, page.said("sheet number", number=number))) if number > 1 else "",
            metadata={"scales": {name: float(f"{per:.12g}") for name, per in scales.items()}},
        ) for number, body in enumerate(pages(blocks, room, APART), 1)
    )
    further = [replace(drawn, title=f"{drawn.title} ({number})") for number, drawn in enumerate(further, 2)]
    return replace(first, further=tuple(further))


def _given(page: FigurePage) -> Block:
    """Masses and loads, inertia forces, springs."""
    account = Account(page.sheet, page.letters)
    inertia = [line for statement in told_of(account, page.sheet.inertias.values()) for line in statement.sums]
    return column(
        page.prose((page.term("given"),), bold=True), page.prose(given_loads(page.sheet, page.letters)),
        page.prose((Phrase("force inertia"),) * bool(inertia), bold=True), page.prose(inertia),
        page.prose(statement.said for statement in told_of(account, page.sheet.springs)),
    )


def _groups(page: FigurePage, room: float) -> Iterator[Block]:
    """Group by group in the order of construction, each with its caption and the text below it, in parts if it does not
    fit a page, but sketch and polygons on one as long as it holds them; if loads begin or end here, without and with
    them."""
    names: Counter[str] = Counter()
    state = None
    account = Account(page.sheet, page.letters)
    for stage in force_stages(account):
        if not stage.group.links:
            continue
        if len(page.sheet.forces) > 1 and stage.state is not state:
            yield _loaded(page, stage.again)
        state = stage.state
        caption = page.prose((rich_text(stage.title, each) for each in languages(page.language)), 3.2, bold=True)
        first, *more = _pictures(page, stage, names)
        text = _below(page, account, stage)
        pictures = column(caption, first, *more, gap=CLOSE)
        whole = column(pictures, text, gap=CLOSE)
        if whole.height <= room and not more:
            yield whole
        elif pictures.height <= room:
            yield from (pictures, text)
        else:
            yield from (column(caption, first, gap=CLOSE), *more, text)


def _loaded(page: FigurePage, acts: bool) -> Block:
    """Whether loads act that begin or end here."""
    return page.prose((Phrase("force with load" if acts else "force without load"),), bold=True)


def group_picture(page: FigurePage, stage: ForceStage, tag: str) -> Drawing:
    """The sketch of a group cut free with its polygons, every part with its step, without text below.

    Parameters
    ----------
    page : of a sheet with the scale of the forces, at the greatest width of the picture
    tag : ends the names of its parts
    """
    whole = column(*_pictures(page, stage, Counter(), tag), gap=CLOSE)
    parts = tied(layer_groups(whole.piece))  # leaders come with their names
    return Drawing(max(page.width, whole.width), whole.height, parts, figure_title(page.sheet, "forces", page.language),
                   str(page.said("force described")[0]), languages(page.language)[0])


def _pictures(
    page: FigurePage, stage: ForceStage, names: Counter[str], tag: str = ""
) -> Iterator[Block]:
    """The sketch of a group beside its polygon, or above its polygons."""
    suffix = ("-with" if stage.again else "") + tag
    polygons = _polygons(stage.group)
    alone = len(polygons) == 1 and polygons[0][3].width <= page.width - SKETCH - APART
    wide = SKETCH if alone else page.width
    extent = _extent(page.sheet, stage.group)
    shown = extent.height * min((wide - ROOM) / max(extent.width, 1e-6), 1.0)
    high = max(LEAST, min(HIGHEST, shown + ROOM), polygons[0][3].height if alone else 0.0)
    named = "-".join(stage.group.links).replace("/", "-") + suffix
    sketch = framed(panel(wide, high, lambda room: _free_body(page, stage, room.grown(-INSIDE), named)))

    def polygon(drawn: _Polygon, width: float, height: float) -> Block:
        return framed(panel(
            width, height, lambda room: _drawn_polygon(page, stage, drawn, room.grown(-INSIDE), names, suffix)))

    if alone:
        yield row(sketch, polygon(polygons[0], page.width - SKETCH - APART, high), gap=APART)
        return
    yield sketch
    singles = []
    for polygon_apart in polygons:
        links, *_, box = polygon_apart
        drawn = polygon(polygon_apart, max(box.width, NARROW), max(box.height, SMALLEST))
        said = (spaced(" / ", page.said("force on links alone", links=bodies_named(links))),) if links else ()
        singles.append(column(prose(said, drawn.width, 2.4), drawn))
    yield from rows(singles, page.width, gap=2.0)


def _below(page: FigurePage, account: Account, stage: ForceStage) -> Block:
    """Moments with their reasons, the vector equation with its rows, and the readings."""
    group, said = stage.group, stage.told(*BY_MOMENTS, "system")
    if len(group.polygon) > 1 and group.way == "polygon":
        said.append(Phrase("force reason polygon", links=bodies_named(group.links)))
    equation = group_equation(page, group)
    couples, read = stage.told(*COUPLES), spaced(";  ", read_off(account, group, group.read))
    return column(
        page.prose(said),
        None if equation is None else Block(Piece({"labels": (Group(equation.children),)}), equation.height),
        page.prose((*couples, read) if read else couples), gap=CLOSE,
    )


def group_equation(page: FigurePage, group: ForceGroup) -> Drawing | None:
    """The equation of a group over its rows of sizes and directions; None where it is drawn by one system."""
    if group.way == "drawn system" or len(group.polygon) < 2:
        return None
    terms = tuple(vector.term for vector in group.polygon)
    sum_ = write_sum(page.sheet, terms, page.letters, page.language, page.width)
    return Drawing(sum_.width, sum_.height, sum_.piece.drawn, page.term("forces"), "", languages(page.language)[0])


def _tables(page: FigurePage, some: Sequence[TableRow], room: float) -> Iterator[Block]:
    """The readings with their check, in parts if they do not fit a page of a height (mm)."""
    left, account = list(some), Account(page.sheet, page.letters)
    while left:
        caption = page.prose((page.term("readings"),), 3.2, bold=True)
        area = Box(0.0, 0.0, page.width, room - caption.height)
        readings, shown = readings_table(page.sheet, left, page.letters, page.language, area)
        left = left[shown:] if shown else []
        notes = ((note, each) for note in page.sheet.force_notes * (not left) for each in languages(page.language))
        sentences = prose((account.sentence(note, each) for note, each in notes), page.width)
        yield column(caption, readings, sentences)


# a group cut free

ARROW, NEXT = 11.0, 4.0  # mm of an arrow that only shows a direction, and how much longer the next along the same line
NEAR = 0.5
ROOM = 2 * ARROW + 6.0  # mm around the links for arrows
HIGHEST = 82.0  # mm of a sketch
EDGE = 9.0  # mm of its panel for names
TRIES = 6


def _cut_free(group: ForceGroup) -> tuple[str, ...]:
    """The links of a group with the blocks among them."""
    return tuple(dict.fromkeys((*group.links, *(v.link for v in group.polygon))))


def _free_body(page: FigurePage, stage: ForceStage, panel: Box, tag: str) -> Piece:
    """The sketch of a group in a panel, not larger than the mechanism is drawn."""
    box = _extent(page.sheet, stage.group)
    times = min((panel.width - ROOM) / max(box.width, 1e-6), (panel.height - ROOM) / max(box.height, 1e-6), 1.0)
    for _ in range(TRIES):
        piece = _sketch(page, stage, times, tag)
        solid = joined(Piece({name: things}) for name, things in piece.layers.items() if name != "construction")
        ink = ink_box(solid.drawn) or panel
        over = max(ink.width / (panel.width - EDGE), ink.height / (panel.height - EDGE))
        if over <= 1.0:
            break
        times *= min(0.95 / over, 0.9)
    return with_labels(cut_piece(moved_piece(piece, panel.centre - ink.centre), panel.grown(-1.0)), panel)


def _extent(sheet: Sheet, group: ForceGroup) -> Box:
    """The box around the places of a group, as on a page (mm, y down)."""
    links, known, mm = set(_cut_free(group)), sheet.structure.links, 1.0 / sheet.scales.length
    spots = [v.at for v in _outside(group)] + [sheet.poses[name].origin for name in links if name in sheet.poses]
    spots += [z for ref, z in sheet.points.items()
              if not ref.link and any(ref.point in known[n].points for n in links if n in known)]
    return Box.around(map(on_page, spots + Touching(sheet.scene, mm, sheet.poses).outermost(links)))


def _sketch(page: FigurePage, stage: ForceStage, times: float, tag: str) -> Piece:
    """The sketch at ``times`` the size of the drawn mechanism, about the mechanism's own origin."""
    plate, links = Plate(), set(_cut_free(stage.group))
    here = MechanismOnPaper(page.sheet.larger(times), page.letters)
    parts, labels = _links(here, links)
    marks = marks_cut_free(here, frozenset(links), tag)
    plate.put("mechanism", *parts, id=f"free-body-{tag}")
    plate.put("construction", *marks.layers["construction"])
    _arms(plate, stage, times)
    _acting(plate, page, stage, times, tag)
    for link, pushed in page.sheet.inertias.items():
        if link in links and pushed.shifted is not None and pushed.h:
            # where it acts together with its couple: a line at the distance h from the centre of mass
            along, at, centre = unit(pushed.force), pushed.shifted * times, pushed.centre * times
            if abs(at - centre) >= 1.0:
                line = Line.between(at - 5.0 * along, at + ARROW * along, strokes.DIRECTION)
                across = Line.between(centre, at, strokes.DIMENSION)
                plate.put("construction", line, across, classes=("shifted",))
                plate.name(rich(sign("h", link), 2.8), (centre, at), colour=strokes.GREY, rank=2)
    plate.labels += (*labels, *marks.labels)
    return plate.piece


def _links(here: MechanismOnPaper, links: set[str]) -> tuple[list[Primitive], list[Label]]:
    parts, labels = links_alone(here, links, 2)
    for slider in here.sliders:
        if slider.slide.a in links:
            parts += symbols.block(on_page(slider.at), phase(slider.along), here.colour(slider.slide.a))
    known = here.sheet.structure.links
    for point, z in here.places.items():
        if any(point in known[n].points for n in links if n in known):
            joint = point in here.sheet.structure.hinges
            size, fill = (0.85, strokes.WHITE) if joint else (0.5, strokes.BLACK)
            parts.append(Circle(on_page(z), JOINT_RADIUS * size, fill=fill, stroke=strokes.OUTLINE))
            labels.append(Label.of(rich(here.letters.point(point), 3.0), on_page(z), rank=1))
    return parts, labels


def _outside(group: ForceGroup) -> Sequence[ForceVector]:
    """The forces on the group from outside; of a group drawn link by link all forces."""
    return [v for polygon in ([group.polygon] if group.polygon else group.inner.values()) for v in polygon if v.span]


def _acting(plate: Plate, page: FigurePage, stage: ForceStage, times: float, tag: str) -> None:
    """An arrow for each force at its place, all of one length, and an arc for each couple."""
    sheet, group, letters = page.sheet, stage.group, page.letters
    taken: list[tuple[complex, complex]] = []
    near = _extent(sheet, group).grown(ARROW / times)
    lines = {symbol: at for symbol, at in group.lines.items() if near.holds(Box.around([on_page(at)]))}
    outside = set(_cut_free(group))
    for n, vector in enumerate(_outside(group)):
        of = vector.symbol
        if not group.polygon and of.kind == "F" and of.other and {of.link, vector.link} <= outside:
            continue  # between two links of the group
        along, at = unit(vector.span), lines.get(of, vector.at) * times
        stacked = sum(abs(at - z) < NEAR and abs(along - e) < 0.1 for z, e in taken)
        taken.append((at, along))
        tip = at + along * (ARROW + NEXT * stacked)
        plate.arrow("forces", f"acts-{tag}-{n}", at, tip, _letters_of(letters, vector),
                    kind=_kind(vector), colour=_colour(sheet, vector), classes=("acting",),
                    step=group.on_links(vector))
    first, *_ = group.steps
    turning = [(first, load) for load in first.acting if not load.force]
    turning += [(step, step.found) for step in group.moments(*COUPLES)]
    places: list[complex] = []
    for step, couple in turning:
        inner = step is not first and couple.off in outside and couple.symbol.other
        if couple.link not in outside or not couple.moment or inner:
            continue
        named, at = couple.symbol, _middle(sheet, couple.link) * times
        radius = 4.2 + 2.0 * sum(abs(at - z) < NEAR for z in places)
        places.append(at)
        arc = symbols.sense_arc(on_page(at), radius, 0.9, 1 if couple.moment > 0 else -1)
        name = f"acts-{tag}-{named.id}"
        plate.put("forces", *arc, id=name, classes=("acting",), step=step.number)
        letter = rich("−" * couple.turned + force_letters(letters.convention, named), 3.0)
        plate.name(letter, at + radius * 0.7 * (1 + 1j), f"label-{name}", step=step.number)


def _kind(vector: ForceVector) -> symbols.ArrowKind:
    return COMPONENT if vector.known or vector.part else RESULTANT


def _colour(sheet: Sheet, vector: ForceVector) -> str:
    """Black for known forces; else the colour of the link from which a force comes or, for forces of the frame, on
    which it acts."""
    if vector.known:
        return strokes.BLACK
    names = vector.symbol.link, vector.symbol.other, vector.link
    moving = (n for n in names if n != sheet.scene.frame.name and n in sheet.scene.order)
    return strokes.colour_of_link(sheet.scene, next(moving, vector.link))


def _letters_of(letters: Notation, vector: ForceVector) -> RichText:
    """A force as a vector, with its part; ``−`` before the opposite of its symbol."""
    force = force_letters(letters.convention, vector.symbol, vector.part)
    return "−" * vector.turned + as_vector(letters.convention, force)


def _middle(sheet: Sheet, link: str) -> complex:
    """The centre of mass of a link, or the middle of its points (mm)."""
    mass = next((m for m in sheet.scene.loading.masses if m.link == link), None)
    points, pose = sheet.structure.links[link].points.values(), sheet.poses[link]
    at = added_up(points, 0j) / max(1, len(points)) if mass is None else mass.at
    return pose.place(at / sheet.scales.length)


def _arms(plate: Plate, stage: ForceStage, times: float) -> None:
    """Arms of the moments by which parts were found, from the point to the line of each force."""
    for step in stage.group.moments(*BY_MOMENTS, "balance"):
        lines = [Line.between(term.about * times, term.foot * times, strokes.DIRECTION)
                 for term in step.terms if term.arm is not None and abs(term.arm) * times >= 1.0]
        if lines:
            plate.put("construction", *lines, classes=("arms",), step=step.number)


# polygons

SHORT = 0.02  # mm: a shorter force is a dot

_Polygon = tuple[tuple[str, ...], Sequence[ForceVector], Sequence[ForceVector], Box]
"""A polygon drawn apart: its links (none for the whole group), its vectors, forces inside that close part of it, and
its panel at least (mm, y down)."""


def _polygons(group: ForceGroup) -> list[_Polygon]:
    """The polygons of a group that are drawn separately."""
    closing: list[ForceVector] = []
    alone: list[tuple[tuple[str, ...], Sequence[ForceVector], Sequence[ForceVector]]] = []
    drawn = {frozenset((v.symbol.link, v.symbol.other)): {v.tail, v.tip} for v in group.polygon if v.symbol.other}
    for links, vectors in group.inner.items():
        if group.polygon and vectors[:-1] == group.polygon[: len(vectors) - 1]:
            last = vectors[-1]  # of a pin in a slot it is the force of the slot
            there = drawn.get(frozenset((last.symbol.link, last.symbol.other)))
            closing += [last] if there != {last.tail, last.tip} and abs(last.span) > SHORT else []
        elif any(abs(v.span) > SHORT for v in vectors):
            alone.append((links, vectors, ()))
    whole = [((), group.polygon, closing)] if group.polygon else []
    return [(links, vectors, inside, _box((*vectors, *inside)).grown(AROUND))
            for links, vectors, inside in (*whole, *alone)]


def _box(vectors: Sequence[ForceVector]) -> Box:
    """The box around a polygon as on a page (mm, y down)."""
    return Box.around([on_page(z) for v in vectors for z in (v.tail, v.tip)] or [0j])


def _drawn_polygon(
    page: FigurePage, stage: ForceStage, polygon: _Polygon, panel: Box, names: Counter[str], suffix: str
) -> Piece:
    """A polygon in the middle of a panel at its true scale."""
    plate, sheet = Plate(), page.sheet
    links, vectors, inside, _ = polygon
    lettered, group = {} if links else stage.group.corners, stage.group
    shifts = side_by_side(Vector(_key(v), v.tail, v.tip) for v in (*vectors, *inside))

    def arrow(vector: ForceVector, tail: complex, tip: complex, step: int, rank: int = 0) -> None:
        name = vector.symbol.id + (f"-{vector.part}" if vector.part else "") + suffix
        names[name] += 1
        name += f"-again{names[name] - 1}" if names[name] > 1 else ""
        ends = vector.ends if lettered else ()
        between = spaced(sign("→"), map(sign, ends)) if len(set(ends)) > 1 else RichText()
        plate.arrow("forces", name, tail, tip, _letters_of(page.letters, vector), 3.2, kind=_kind(vector),
                    colour=_colour(sheet, vector), classes=("vector", "force"), step=step, rank=rank, between=between)

    for vector in (*vectors, *inside):
        if abs(vector.span) <= SHORT:
            continue
        shift = shifts.get(_key(vector), 0j)
        tail, tip = vector.tail + shift, vector.tip + shift
        step = group.in_polygon(vector, links)
        if shift:
            aside = (Line.between(true, shown, strokes.CONSTRUCTION)
                     for true, shown in ((vector.tail, tail), (vector.tip, tip)))
            plate.put("construction", *aside, step=step)
        arrow(vector, tail, tip, step, 0 if not vector.known or abs(vector.span) > 3.0 else 2)
    for whole in _wholes(vectors):
        arrow(whole, whole.tail, whole.tip, group.in_polygon(whole, links))
    for letter, (place, vector) in lettered.items():
        names[f"corner-{letter}"] += 1
        name = f"label-corner-{letter}-{names[f'corner-{letter}']}{suffix}"
        plate.name(rich(sign(letter), 3.0), place + shifts.get(_key(vector), 0j), name, rank=1,
                   step=group.in_polygon(vector, links))
    unknown = [v for v in vectors if not v.known]
    for vector in (v for v in unknown if abs(v.span) <= SHORT):
        plate.circle("construction", vector.tip, 0.4, strokes.BLACK)
    for vector in (v for v in unknown if v.part != "t" and abs(v.span) > SHORT):
        # the line along which it was drawn, a little past its ends
        past = 6.0 * unit(vector.span)
        step = group.in_polygon(vector, links)
        for end, beyond in ((vector.tail, vector.tail - past), (vector.tip, vector.tip + past)):
            line = Line.between(end, beyond, strokes.DIRECTION)
            plate.put("construction", line, classes=("direction",), step=step)
    return with_labels(moved_piece(plate.piece, panel.centre - _box(vectors).centre), panel)


def _key(vector: ForceVector) -> Symbol:
    """A symbol that distinguishes the parts of a force."""
    return replace(vector.symbol, at=vector.part)


def _wholes(vectors: Sequence[ForceVector]) -> Iterator[ForceVector]:
    """Forces with both parts in a polygon, as whole vectors."""
    for first, second in zip(vectors, (*vectors[1:], *vectors[:1]), strict=True):
        both = first.symbol == second.symbol and {first.part, second.part} == {"t", "n"}
        if both and abs(first.tip - second.tail) < SHORT:
            ends = first.ends[0], second.ends[1]
            whole = replace(first, part="", by="closing", tip=second.tip, ends=ends)
            if min(abs(whole.span), abs(first.span), abs(second.span)) > SHORT:
                yield whole


# Zhukovsky's lever

LEVER_ARROW, LEVER_ROOM = 14.0, 20.0  # mm of an arrow that only shows a direction, and around the lever
COLUMNS = 42.0, 34.0, 34.0, 64.0  # mm: force, its size, arm, moment


def lever_figure(page: FigurePage, report: Report | None = None) -> Drawing | None:
    """A lever for each driver, at the scale of the velocities; None where no balancing load moves."""
    shown = [(k, lever) for k, state in enumerate(page.sheet.forces) for lever in state.levers]
    if not shown:
        return None
    sheet = page.sheet
    why = [Phrase("lever reason", pole=pole(page.convention, "velocity"))]
    why += [Phrase("lever couple")] * any(row.pair for _, lever in shown for row in lever.rows)
    why += [Phrase("lever virtual")] * any(lever.virtual for _, lever in shown)
    body = [page.prose(why)]
    for number, (k, lever) in enumerate(shown):
        body += [_loaded(page, k > 0)] * (len(page.sheet.forces) > 1)
        body += _lever(page, lever, str(number or ""))
    per = lever_scale(sheet, shown[0][1]) / sheet.scene.units.rates.metres
    return page.drawing(
        page.at_drivers(page.term("lever")), column(*body, gap=3.0), "", title="lever",
        said=page.said("lever described")[0], metadata={"scales": {"velocity": float(f"{per:.12g}")}},
    )


def _lever(page: FigurePage, lever: Lever, tag: str) -> Iterator[Block]:
    """A lever, its scale, the moment of each force, their sum, and the balancing load beside that of the polygons."""
    per_mm, units = lever_scale(page.sheet, lever), page.sheet.scene.units
    box, drawn = Box.around(map(on_page, spots_of(lever, per_mm))), _drawn_lever(page, lever, per_mm, tag)
    yield page.panel(box.height + 2 * LEVER_ROOM, lambda room: with_labels(
        cut_piece(moved_piece(drawn, room.centre - box.centre), room), room))
    yield page.prose([page.scale("velocity", per_mm)], 3.2)
    heads = [
        [word("force heads", each), units.force, f"{word('arm', each)}, mm",
         f"{word('moment about pole', each)}, {units.force}·mm"] for each in languages(page.language)
    ]
    rows = [(_named(row, page.letters), *map(printed, written)) for row, *written in lever_sum(page.sheet, lever)[0]]
    yield table(heads, rows, COLUMNS)
    *_, statement = told_of(Account(page.sheet, page.letters), lever.steps, lever=lever)
    yield column(page.prose((statement.said,)), page.prose(statement.sums, bold=True))


def _drawn_lever(page: FigurePage, lever: Lever, per_mm: float, tag: str) -> Piece:
    """The turned polygon with the forces on it, at a scale (m/s for one mm)."""
    plate, letters, convention = Plate(), page.letters, page.convention
    ends: dict[complex, list[RichText]] = {}
    for ref, velocity in lever.ends.items():
        end = velocity / per_mm
        if abs(end) > SEEN and (not ref.link or ref.link in page.sheet.scene.by_name):
            letter = letters.end("velocity", ref) or letters.point(ref.point)
            ends.setdefault(complex(round(end.real, 2), round(end.imag, 2)), []).append(letter)
    for end, names in ends.items():
        plate.line("velocity", 0j, end, strokes.RELATIVE)
        plate.circle("velocity", end, 0.5, strokes.BLACK)
        plate.name(rich(spaced(sign(", "), names[:3])), end, rank=1)
    plate.name(rich(pole(convention, "velocity")), 0j)
    taken: list[tuple[complex, complex]] = []
    sought = lever.unknown.acting
    balance = replace(lever.unknown, acting=replace(sought, force=sought.force * (lever.value or 1.0)))
    for term in (*(known for known in lever.rows if known.acting.force), balance):
        balances = term is balance
        acting = _forces_at(term, per_mm)
        letter = force_letters(convention, term.symbol)
        turned = term.acting.turned
        named = ("−" * turned) + (as_vector(convention, letter) if term.pair is None else letter + sign("/l"))
        for n, (at, along) in enumerate(acting, 1):
            stacked = sum(abs(at - z) < NEAR and abs(along - e) < 0.1 for z, e in taken)
            taken.append((at, along))
            name = f"{term.symbol.id}{'-opposite' * turned}{f'-{n}' if len(acting) > 1 else ''}"
            plate.arrow("forces", f"lever-{name}{tag}", at, at + along * (LEVER_ARROW + NEXT * stacked), named,
                        kind=RESULTANT if balances else COMPONENT, classes=("acting",),
                        colour=strokes.LINK_COLOURS[1] if balances else strokes.BLACK)
        if term.pair is None and term.arm and abs(term.arm) > SEEN * per_mm and acting:
            at, along = acting[0]
            foot = -1j * along * term.arm / per_mm
            lines = [Line(0j, on_page(foot), strokes.DIMENSION)]
            if abs(foot - at) > SEEN:
                lines.append(Line.between(foot, at, strokes.DIRECTION))
            plate.put("velocity", *lines, classes=("arm",))
            arm = force_letters(convention, Symbol("arm", name=str(term.symbol)))
            arm += sign("'") if turned else ""
            plate.name(rich(arm, 2.8), (0j, foot), colour=strokes.GREY, rank=2)
    plate.circle("velocity", 0j, 0.9, strokes.WHITE, strokes.OUTLINE)
    return plate.piece


def _forces_at(row: MomentTerm, per_mm: float) -> list[tuple[complex, complex]]:
    """The places of a row's force or pair of forces (mm at a scale), and its direction."""
    force = row.acting.force
    if not force:
        return []
    if row.pair is None:
        return [(row.acting.at / per_mm, unit(force))] if row.symbol.is_vector else []
    tail, tip = (z / per_mm for z in row.pair)
    return [(tip, unit(force)), (tail, -unit(force))]


def _named(row: MomentTerm, letters: Notation) -> Words:
    """A force on the lever by name."""
    name = "−" * row.acting.turned + force_letters(letters.convention, row.acting.symbol)
    return name + " / " + sign("l") if row.pair is not None else name


FIGURES = (
    Figure("forces", forces_figure, "forces", lambda scene: bool(scene.loading), of_all=True, place=13),
    Figure("lever", lever_figure, "forces", lambda scene: bool(scene.loading), of_all=True, place=14),
)
