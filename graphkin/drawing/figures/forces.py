"""The sheet of forces: given masses and loads, each group cut free, its polygon beside the sketch of its links with the
forces on them, its equations and readings, in the order in which they are found, and the readings with their check; on
as many pages as it takes."""

from __future__ import annotations

from cmath import phase
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from graphkin.account.forces import (
    ForceAccount,
    ForceStage,
    corner_at,
    corners,
    given_loads,
)
from graphkin.account.headings import figure_title, term
from graphkin.account.notation import Letters, as_vector, force_letters
from graphkin.checking.report import Report
from graphkin.construction.forces.force_sheet import ForceGroup, ForceSheet, ForceVector
from graphkin.construction.sheet import Sheet
from graphkin.construction.steps import Vector
from graphkin.construction.touching import Touching, outlines_on_paper
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import MARGIN, Block, FigurePage, column, framed, pages, panel, prose, row, rows
from graphkin.drawing.equations import write_sum
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, Text, on_page
from graphkin.drawing.ink.symbols import COMPONENT, JOINT_RADIUS, RESULTANT, arrow, vector_group
from graphkin.drawing.parts.mechanism import links_alone
from graphkin.drawing.parts.mechanism_on_paper import MechanismOnPaper
from graphkin.drawing.parts.polygon import side_by_side
from graphkin.drawing.parts.touching import marks_cut_free
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, cut_to, ink_box, joined, layer_groups, middle_of, moved_piece
from graphkin.drawing.stepwise import tied
from graphkin.drawing.tables import TableRow, readings_table
from graphkin.drawing.text import symbol
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import added_up, unit
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase, about, languages, listed, say

__all__ = ["FIGURES", "group_equation", "group_picture"]

SKETCH = 64.0  # mm, width of a sketch
AROUND = 11.0  # mm of room around a polygon
LEAST, SMALLEST, NARROW = 46.0, 26.0, 40.0  # mm, least heights of a sketch and a polygon, and width
APART, CLOSE, INSIDE = 4.0, 2.0, 0.6  # mm between groups, between the parts of one, and inside a frame


def forces_figure(
    sheet: Sheet, forces: ForceSheet, report: Report | None = None, *, language: str | None = None,
    convention: str | None = None,
) -> Drawing:  # fmt: skip
    """The forces of a drawn position on pages of the scene's paper.

    Parameters
    ----------
    sheet, forces : what is drawn of motion and of forces
    report : readings held against the exact values; without it there is no table
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    sheet = replace(sheet, scales=replace(sheet.scales, force=forces.per_mm))
    page = FigurePage.of(sheet, "forces", language, convention)
    width, height = sheet.scene.question.sheet.size
    boxes = [
        extent_of((*vectors, *inside)).grown(AROUND)
        for state in forces.states for group in state.groups for _, vectors, inside in polygons_of(group)
    ]  # fmt: skip
    page = replace(page, width=max(width - 2 * MARGIN, *(box.width for box in boxes), 0.0))
    below = page.at_drivers(page.term("forces"))
    spare = page.height_for(below, height)
    needed = max((box.height for box in boxes), default=0.0) + 2 * page.prose(("force",)).height
    room, height = max(spare, needed), height + max(0.0, needed - spare)  # a larger paper for a wished scale
    blocks = [_given(page, forces), *_groups(page, forces, room)]
    if report is not None:
        rows = [TableRow(row.reading, row) for row in report.rows if row.symbol.scope == "force"]
        blocks += _tables(replace(page, sheet=replace(sheet, scales=report.scales)), rows)
    units = sheet.scene.units
    scales = {"length": sheet.scales.length * 1e3, "force": sheet.scales.force / units.newtons}
    first, *further = (
        page.drawing(
            below, body, page.scale("force"), title="forces", said=page.said("force described")[0], height=height,
            note=say(Phrase("sheet number", (number,)), languages(page.language)[0]) if number > 1 else "",
            metadata={"scales": {name: float(f"{per:.12g}") for name, per in scales.items()}},
        ) for number, body in enumerate(pages(blocks, room, APART), 1)
    )  # fmt: skip
    further = [replace(one, title=f"{one.title} ({number})") for number, one in enumerate(further, 2)]
    return replace(first, further=tuple(further))


def _groups(page: FigurePage, forces: ForceSheet, room: float) -> Iterator[Block]:
    """Group by group in the order in which forces are found; where loads begin or end here, without and with them."""
    names: Counter[str] = Counter()
    state = None
    for stage in ForceAccount(page.sheet, forces, page.letters).stages():
        if stage.group is None:
            continue
        if len(forces.states) > 1 and stage.state is not state:
            yield page.prose((Phrase("force with load" if stage.again else "force without load"),), bold=True)
        state = stage.state
        yield from _group(page, forces, stage, stage.group, room, names)


def _given(page: FigurePage, forces: ForceSheet) -> Block:
    """Masses and loads, inertia forces, springs."""
    account = ForceAccount(page.sheet, forces, page.letters)
    inertia = [*map(account.inertia, forces.inertias.values())]
    return column(
        page.prose((page.term("given"),), bold=True), page.prose(given_loads(page.sheet, page.letters)),
        page.prose((Phrase("force inertia"),) * bool(inertia), bold=True), page.prose(inertia),
        page.prose(account.springs()),
    )  # fmt: skip


def _group(
    page: FigurePage, forces: ForceSheet, stage: ForceStage, group: ForceGroup, room: float, names: Counter[str]
) -> Iterator[Block]:
    """A group: its caption, its sketch beside its polygon, and what is written below; in parts where a page does not
    hold it."""
    caption = page.prose((text for _, text in stage.heading(page.language)), 3.2, bold=True)
    first, *more = _pictures(page, forces, stage, group, names)
    parts = column(caption, first, gap=CLOSE), *more, _below(page, forces, stage, group)
    whole = column(*parts, gap=CLOSE)
    yield from parts if more or whole.height > room else (whole,)


def group_picture(
    sheet: Sheet, forces: ForceSheet, stage: ForceStage, group: ForceGroup, letters: Letters, spoken: str, width: float,
    tag: str,
) -> Drawing:  # fmt: skip
    """The sketch of a group cut free with its polygons, every part with its step, and nothing written below; ``tag``
    ends the names of its parts."""
    page = FigurePage(sheet, "forces", spoken, letters, width)
    whole = column(*_pictures(page, forces, stage, group, Counter(), tag), gap=CLOSE)
    parts = tied(layer_groups(whole.piece))  # leaders come with their names
    return Drawing(max(width, whole.width), whole.height, parts, figure_title(sheet, "forces", spoken),
                   page.said("force described")[0], languages(spoken)[0])  # fmt: skip


def _pictures(
    page: FigurePage, forces: ForceSheet, stage: ForceStage, group: ForceGroup, names: Counter[str], tag: str = ""
) -> Iterator[Block]:
    """The sketch of a group beside its polygon, or above its polygons."""
    suffix = ("-with" if stage.again else "") + tag
    polygons = [(link, vectors, inside, extent_of((*vectors, *inside)).grown(AROUND))
                for link, vectors, inside in polygons_of(group)]  # fmt: skip
    alone = len(polygons) == 1 and polygons[0][3].width <= page.width - SKETCH - APART
    wide = SKETCH if alone else page.width
    high = max(LEAST, sketch_height(page.sheet, group, wide), polygons[0][3].height if alone else 0.0)
    sketch = framed(panel(wide, high, lambda room: free_body(
        page.sheet, forces, stage, group, page.letters, room.grown(-INSIDE), "-".join(group.links) + suffix)))

    def polygon(
        link: str, vectors: Sequence[ForceVector], inside: Sequence[ForceVector], width: float, height: float
    ) -> Block:
        return framed(panel(width, height, lambda room: drawn_polygon(
            page.sheet, stage, link, vectors, inside, page.letters, room.grown(-INSIDE), names, suffix)))

    if alone:
        yield row(sketch, polygon("", *polygons[0][1:3], page.width - SKETCH - APART, high), gap=APART)
        return
    yield sketch
    singles = []
    for link, vectors, inside, box in polygons:
        drawn = polygon(link, vectors, inside, max(box.width, NARROW), max(box.height, SMALLEST))
        said = (" / ".join(page.said("force on link", link)),) if link else ()
        singles.append(column(prose(said, drawn.width, 2.4), drawn))
    yield from rows(singles, page.width, gap=2.0)


def _below(page: FigurePage, forces: ForceSheet, stage: ForceStage, group: ForceGroup) -> Block:
    """Moments with their reasons, the vector equation with its rows, and what was read off."""
    sheet, letters = page.sheet, page.letters
    said = stage.told("moments", "system")
    if len(group.polygon) > 1 and group.way == "polygon":
        said.append(Phrase(about("force reason polygon", group.links), (listed(group.links),)))
    equation = group_equation(sheet, group, letters, page.language, page.width)
    rows_of = equation and (Piece({"labels": (Group(equation.children, id=""),)}), equation.height)
    couples, read = stage.told("couples"), ForceAccount(sheet, forces, letters).read_off(stage.state, group)
    return column(
        page.prose(said), Block(*rows_of) if rows_of else None,
        page.prose((*couples, *([";  ".join(read.values())] if read else []))), gap=CLOSE,
    )  # fmt: skip


def group_equation(sheet: Sheet, group: ForceGroup, letters: Letters, language: str, width: float) -> Drawing | None:
    """The equation of a group over its rows of sizes and directions; None where it is drawn by one system."""
    if group.way == "drawn system" or len(group.polygon) < 2:
        return None
    written = write_sum(sheet, tuple(vector.term for vector in group.polygon), letters, language, width)
    title = term("forces", language)
    return Drawing(written.width, written.height, written.children, title, "", languages(language)[0])


def _tables(page: FigurePage, some: Sequence[TableRow]) -> Iterator[Block]:
    """The readings with their check, parted where they do not fit one page."""
    left = list(some)
    while left:
        most = min(len(left), 80)
        height = 10.0 + 4.2 * -(-most // 2) + 3.7 * (len(languages(page.language)) - 1)
        area = Box(0.0, 0.0, page.width, height)
        readings, shown = readings_table(page.sheet, left[:most], page.letters, page.language, area)
        caption = page.prose((page.term("readings"),), 3.2, bold=True)
        yield column(caption, Block(Piece({"answers": readings}), height))
        if shown == 0:
            return
        left = left[shown:]


ARROW, NEXT = 11.0, 4.0  # mm of an arrow that only shows a direction, and how much longer the next along the same line
NEAR = 0.5
ROOM = 2 * ARROW + 6.0  # mm around the links for arrows
HIGHEST = 82.0  # mm of a sketch
EDGE = 9.0  # mm of its panel for names
TRIES = 6


def links_cut_free(group: ForceGroup) -> tuple[str, ...]:
    """The links of a group with the blocks among them."""
    return tuple(dict.fromkeys((*group.links, *(v.link for v in group.polygon))))


def free_body(
    sheet: Sheet, forces: ForceSheet, stage: ForceStage, group: ForceGroup, letters: Letters, panel: Box, tag: str
) -> Piece:
    """The sketch of a group in a panel, not larger than the mechanism is drawn."""
    box = _extent(sheet, group)
    times = min((panel.width - ROOM) / max(box.width, 1e-6), (panel.height - ROOM) / max(box.height, 1e-6), 1.0)
    for _ in range(TRIES):
        piece = _sketch(sheet, forces, stage, group, letters, times, tag)
        solid = joined(Piece({name: things}) for name, things in piece.layers.items() if name != "construction")
        ink = ink_box(solid.drawn) or panel
        over = max(ink.width / (panel.width - EDGE), ink.height / (panel.height - EDGE))
        if over <= 1.0:
            break
        times *= min(0.95 / over, 0.9)
    placed = moved_piece(piece, panel.centre - ink.centre)
    inside = panel.grown(-1.0)
    layers = {name: cut_to(things, inside) for name, things in placed.layers.items()}
    labels = tuple(label for label in placed.labels if inside.holds(Box.around([middle_of(label.mark)])))
    return with_labels(Piece(layers, labels), panel)


def _sketch(
    sheet: Sheet, forces: ForceSheet, stage: ForceStage, group: ForceGroup, letters: Letters, times: float, tag: str
) -> Piece:
    """The sketch at so many times the size of the mechanism as it is drawn, about the mechanism's own origin."""
    links = set(links_cut_free(group))
    here = MechanismOnPaper(sheet.larger(times), letters)
    parts, labels = _links(here, links)
    marks = marks_cut_free(here, frozenset(links), tag)
    more = [*marks.layers["construction"], *_arms(stage, group, times)]
    arrows, named = _arrows(sheet, group, stage, letters, times, tag)
    shifted = list(shifted_lines(forces, links, times))
    more += [line for line, _ in shifted]
    named += [label for _, label in shifted]
    return Piece(
        {"mechanism": (Group(tuple(parts), id=f"free-body-{tag}"),), "construction": tuple(more), "forces": arrows},
        (*named, *labels, *marks.labels),
    )


def sketch_height(sheet: Sheet, group: ForceGroup, width: float) -> float:
    """How high a sketch wants to be that is so wide (mm)."""
    box = _extent(sheet, group)
    times = min((width - ROOM) / max(box.width, 1e-6), 1.0)
    return min(HIGHEST, box.height * times + ROOM)


def _extent(sheet: Sheet, group: ForceGroup) -> Box:
    """The box around the places of a group, as on a page (mm, y down)."""
    spots = [v.at for v in _forces(group)] + _points(sheet, set(links_cut_free(group)))
    return Box.around([on_page(z) for z in spots])


def _points(sheet: Sheet, links: set[str]) -> list[complex]:
    known = sheet.structure.links
    found = [sheet.poses[name].origin for name in links if name in sheet.poses]
    for ref, z in sheet.points.items():
        if not ref.link and any(ref.point in known[n].points for n in links if n in known):
            found.append(z)
    mm = 1.0 / sheet.scales.length
    for cam, profile in outlines_on_paper(sheet.scene, sheet.poses, mm).items():
        found += profile if cam in links else ()
    return found + Touching(sheet.scene, mm, sheet.poses).outermost(links)


def _links(here: MechanismOnPaper, links: set[str]) -> tuple[list[Primitive], list[Label]]:
    parts, labels = links_alone(here, links, 2)
    for one in here.sliders:
        if one.slide.a in links:
            parts += symbols.block(on_page(one.at), phase(one.along), here.colour(one.slide.a))
    for point, z in here.places.items():
        known = here.sheet.structure.links
        if any(point in known[n].points for n in links if n in known):
            joint = point in here.sheet.structure.hinges
            size = JOINT_RADIUS * 0.85 if joint else JOINT_RADIUS * 0.5
            fill = strokes.WHITE if joint else strokes.BLACK
            parts.append(Circle(on_page(z), size, fill=fill, stroke=strokes.OUTLINE))
            labels.append(Label.of(symbol(here.letters.point(point), 3.0), on_page(z), rank=1))
    return parts, labels


def _forces(group: ForceGroup) -> Sequence[ForceVector]:
    """What acts on the group from outside; of a group drawn link by link everything."""
    if group.polygon:
        return [v for v in group.polygon if v.span]
    return [v for polygon in group.inner.values() for v in polygon if v.span]


def _arrows(
    sheet: Sheet, group: ForceGroup, stage: ForceStage, letters: Letters, times: float, tag: str
) -> tuple[tuple[Primitive, ...], list[Label]]:
    """An arrow for each force at its place, all of one length, and an arc for each couple."""
    drawn: list[Primitive] = []
    labels: list[Label] = []
    taken: list[tuple[complex, complex]] = []
    near = _extent(sheet, group).grown(ARROW / times)
    lines = {symbol: at for symbol, (at, _) in group.lines.items() if near.holds(Box.around([on_page(at)]))}
    outside = set(links_cut_free(group))
    for n, vector in enumerate(_forces(group)):
        if not group.polygon and _within(vector, outside):
            continue
        along = unit(vector.span)
        at = lines.get(vector.symbol, vector.at) * times
        again = sum(abs(at - z) < NEAR and abs(along - e) < 0.1 for z, e in taken)
        taken.append((at, along))
        tail, tip = on_page(at), on_page(at + along * (ARROW + NEXT * again))
        kind = COMPONENT if vector.known or vector.part else RESULTANT
        colour = colour_of_force(sheet, vector)
        group_id, step = f"acts-{tag}-{n}", stage.on_links(vector)
        drawn.append(Group(arrow(tail, tip, kind, colour), id=group_id, classes=("acting",), step=step))
        markup = letters_of_force(letters, vector)
        labels.append(Label.of(symbol(markup, 3.0), (tail, tip), f"label-{group_id}", colour=colour, step=step))
    turning = [(t.symbol, t.link, t.moment) for t in stage.state.known if t.moment]
    for one in group.couples:
        sought = one.unknown.symbol
        if (sought.other in outside and sought.link not in outside) or not sought.other:
            turning.append((sought, sought.other or one.links[0], one.value))
    places: list[complex] = []
    for named, link, moment in turning:
        if link not in outside or not moment:
            continue
        at = _middle(sheet, link) * times
        radius = 4.2 + 2.0 * sum(abs(at - z) < NEAR for z in places)
        places.append(at)
        arc = symbols.sense_arc(on_page(at), radius, 0.9, 1 if moment > 0 else -1)
        group_id, step = f"acts-{tag}-{named.id}", stage.number_of("couples", named) or stage.known
        drawn.append(Group(arc, id=group_id, classes=("acting",), step=step))
        labels.append(Label.of(symbol(force_letters(letters.convention, named), 3.0),
                               on_page(at + radius * 0.7 * (1 + 1j)), f"label-{group_id}", step=step))  # fmt: skip
    return tuple(drawn), labels


def shifted_lines(forces: ForceSheet, links: set[str], times: float) -> Iterator[tuple[Primitive, Label]]:
    """Where inertia forces act together with their couples: lines at the distance h from the centres of mass."""
    for link, one in forces.inertias.items():
        if link not in links or one.shifted is None or not one.h:
            continue
        along, at, centre = unit(one.force), one.shifted * times, one.centre * times
        if abs(at - centre) < 1.0:
            continue
        line = Line(on_page(at - 5.0 * along), on_page(at + ARROW * along), strokes.DIRECTION)
        across = Line(on_page(centre), on_page(at), strokes.DIMENSION)
        yield Group((line, across), classes=("shifted",)), Label.of(symbol(f"h_{{{link}}}", 2.8),
                (on_page(centre), on_page(at)), colour=strokes.GREY, rank=2)  # fmt: skip


def colour_of_force(sheet: Sheet, vector: ForceVector) -> str:
    """Black for what was known; else that of the link that a force comes from or, of the frame's, acts on."""
    if vector.known:
        return strokes.BLACK
    names = vector.symbol.link, vector.symbol.other, vector.link
    moving = (n for n in names if n != sheet.scene.frame.name and n in sheet.scene.order)
    return strokes.colour_of_link(sheet.scene, next(moving, vector.link))


def _within(vector: ForceVector, links: set[str]) -> bool:
    """Whether a force is one between two links of the group."""
    return vector.symbol.kind == "F" and {vector.symbol.link, vector.symbol.other} <= links


def letters_of_force(letters: Letters, vector: ForceVector) -> str:
    r"""A force as a vector, with its part; ``−`` before the opposite of what its symbol says."""
    markup = force_letters(letters.convention, vector.symbol, vector.part)
    return ("−" if vector.turned else "") + as_vector(letters.convention, markup)


def _middle(sheet: Sheet, link: str) -> complex:
    mass = next((m for m in sheet.scene.loading.masses if m.link == link), None)
    pose = sheet.poses[link]
    at = mass.at if mass is not None else added_up(sheet.structure.links[link].points.values(), 0j) / max(
        1, len(sheet.structure.links[link].points)
    )
    return pose.origin + pose.axis * at / sheet.scales.length


def _arms(stage: ForceStage, group: ForceGroup, times: float) -> list[Primitive]:
    """Arms of the moments by which parts were found, from the point to the line of each force."""
    arms: list[Primitive] = []
    for equation in (*group.moments, *(c for c in group.couples if not c.unknown.symbol.other)):
        sought = equation.unknown
        step = stage.number_of("moments", sought.symbol, sought.part) or stage.number_of("couples", sought.symbol)
        found: list[Primitive] = []
        for one in equation.terms:
            if one.arm is None or abs(one.arm) * times < 1.0:
                continue
            a, b = on_page(one.about * times), on_page(one.foot * times)
            found.append(Line(a, b, strokes.DIRECTION))
        arms += [Group(tuple(found), classes=("arms",), step=step)] if found else []
    return arms


SHORT = 0.02  # mm: a shorter force is a dot


def polygons_of(group: ForceGroup) -> list[tuple[str, Sequence[ForceVector], Sequence[ForceVector]]]:
    """The polygons of a group that are drawn apart: the link it is of ("" for the whole group), its vectors, and forces
    inside that close part of it."""
    closing: list[ForceVector] = []
    own: list[tuple[str, Sequence[ForceVector], Sequence[ForceVector]]] = []
    drawn = {frozenset((v.symbol.link, v.symbol.other)): {v.tail, v.tip} for v in group.polygon if v.symbol.other}
    for link, vectors in group.inner.items():
        body = vectors[:-1]
        if group.polygon and body == group.polygon[: len(body)]:
            last = vectors[-1]  # of a pin in a slot it is the force of the slot
            there = drawn.get(frozenset((last.symbol.link, last.symbol.other)))
            closing += [] if there == {last.tail, last.tip} else [last]
        else:
            own.append((link, vectors, ()))
    own = [one for one in own if any(abs(v.span) > SHORT for v in one[1])]
    return [("", group.polygon, [v for v in closing if abs(v.span) > SHORT]), *own] if group.polygon else own


def extent_of(vectors: Sequence[ForceVector]) -> Box:
    """The box around a polygon as on a page (mm, y down)."""
    return Box.around([on_page(z) for v in vectors for z in (v.tail, v.tip)] or [0j])


def drawn_polygon(
    sheet: Sheet, stage: ForceStage, link: str, vectors: Sequence[ForceVector], inside: Sequence[ForceVector],
    letters: Letters, panel: Box, names: Counter[str], suffix: str,
) -> Piece:  # fmt: skip
    """A polygon in the middle of a panel at its true scale; ``link`` as in `polygons_of`."""
    arrows: list[Primitive] = []
    labels: list[Label] = []
    thin: list[Primitive] = []
    shifts = side_by_side(_as_drawn(v) for v in (*vectors, *inside))
    for vector in (*vectors, *inside):
        if abs(vector.span) <= SHORT:
            continue
        shift = shifts.get(_key(vector), 0j)
        tail, tip = on_page(vector.tail + shift), on_page(vector.tip + shift)
        step = stage.in_polygon(vector, vector.link if vector in inside else link)
        if shift:
            aside = (Line(on_page(z), w, strokes.CONSTRUCTION) for z, w in ((vector.tail, tail), (vector.tip, tip)))
            thin.append(Group(tuple(aside), step=step))
        colour = colour_of_force(sheet, vector)
        kind = COMPONENT if vector.known or vector.part else RESULTANT
        name = _unique(vector, names, suffix)
        arrows.append(vector_group(name, step, tail, tip, kind, colour, classes=("force",)))
        markup, own = letters_of_force(letters, vector), f"label-{name}"
        text = Text(0j, symbol(markup, 3.2), "start", colour, own, ("label",), step)
        rank = 0 if not vector.known or abs(vector.span) > 3.0 else 2
        labels.append(Label(text, (tail, tip), rank=rank, between=_between(stage, link, vector)))
    for whole, tail, tip in _wholes(vectors):
        name = _unique(whole, names, suffix)
        colour = colour_of_force(sheet, whole)
        ends = on_page(tail), on_page(tip)
        step = stage.in_polygon(whole, link)
        arrows.append(vector_group(name, step, *ends, RESULTANT, colour, classes=("force",)))
        markup, own = letters_of_force(letters, whole), f"label-{name}"
        labels.append(Label.of(symbol(markup, 3.2), ends, own, colour=colour, step=step,
                               between=_between(stage, link, whole)))  # fmt: skip
    for letter, place, vector in corners(stage.group) if stage.group is not None and not link else ():
        names[f"corner-{letter}"] += 1
        own = f"label-corner-{letter}-{names[f'corner-{letter}']}{suffix}"
        labels.append(Label.of(symbol(letter, 3.0), on_page(place + shifts.get(_key(vector), 0j)), own, rank=1,
                               step=stage.in_polygon(vector, link)))  # fmt: skip
    zero = [v for v in vectors if abs(v.span) <= SHORT and not v.known]
    for vector in zero:
        thin.append(Circle(on_page(vector.tip), 0.4, fill=strokes.BLACK))
    for vector in (v for v in vectors if not v.known):
        thin += _direction(vector, stage.in_polygon(vector, link))
    piece = Piece({"construction": tuple(thin), "forces": tuple(arrows)}, tuple(labels))
    return with_labels(moved_piece(piece, panel.centre - extent_of(vectors).centre), panel)


def _between(stage: ForceStage, link: str, vector: ForceVector) -> str:
    """The letters of the corners between which a force stands, of a polygon that has them."""
    if stage.group is None or link:
        return ""
    ends = [corner_at(stage.group, place) for place in (vector.tail, vector.tip)]
    return "→".join(ends) if all(ends) and ends[0] != ends[1] else ""


def _key(vector: ForceVector) -> Symbol:
    """A symbol that tells the parts of a force apart."""
    return replace(vector.symbol, at=vector.part)


def _as_drawn(vector: ForceVector) -> Vector:
    return Vector(_key(vector), vector.tail, vector.tip, "relative")


def _direction(vector: ForceVector, step: int) -> Iterator[Primitive]:
    """The line along which a force was drawn, a little past its ends."""
    if vector.part == "t" or abs(vector.span) <= SHORT:
        return
    e = vector.span / abs(vector.span)
    for z, w in ((vector.tail, vector.tail - 6.0 * e), (vector.tip, vector.tip + 6.0 * e)):
        yield Group((Line(on_page(z), on_page(w), strokes.DIRECTION),), classes=("direction",), step=step)


def _wholes(vectors: Sequence[ForceVector]) -> Iterator[tuple[ForceVector, complex, complex]]:
    """Forces of which both parts stand in a polygon, whole."""
    for one, two in zip(vectors, (*vectors[1:], *vectors[:1]), strict=True):
        if one.symbol == two.symbol and {one.part, two.part} == {"t", "n"} and abs(one.tip - two.tail) < SHORT:
            whole = replace(one, part="", by="closing", tip=two.tip)
            if abs(whole.span) > SHORT and abs(one.span) > SHORT and abs(two.span) > SHORT:
                yield whole, one.tail, two.tip


def _unique(vector: ForceVector, names: Counter[str], suffix: str) -> str:
    """Its symbol as an id, counted where it is drawn again."""
    name = vector.symbol.id + (f"-{vector.part}" if vector.part else "") + suffix
    names[name] += 1
    return name if names[name] == 1 else f"{name}-again{names[name] - 1}"


FIGURES = (Figure("forces", forces_figure, "forces", lambda scene: bool(scene.loading), of_all=True, place=13),)
