"""The papers of a lesson: the problem sheet with room to solve it with ruler and compass; the worked solution, step by
step with reasons, equations and the figures of each stage; the answer key with the tolerances of a pencil drawing, also
as CSV, and the table for a class.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import astuple, dataclass, replace

from graphkin import table
from graphkin.account.account import telling, why
from graphkin.account.forces import ForceStage, force_stages
from graphkin.account.given import (
    drivers,
    fixed_guides,
    given_drivers,
    given_lengths,
    given_loads,
    given_shapes,
    given_teeth,
    place_of,
    rolled_starts,
    rolling_starts,
)
from graphkin.account.headings import FIGURE_WORDS, number, titles
from graphkin.account.notation import pole, scale_statement
from graphkin.checking.report import COVERAGE, Compared, exact, measured, paper
from graphkin.construction.board.steps import DiagramName, PointNames
from graphkin.drawing.box import Box
from graphkin.drawing.figures.constructions import cam_given
from graphkin.drawing.figures.forces import group_equation, group_picture, lever_figure
from graphkin.drawing.figures.train import PLAN_WORDS, train_pages
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers import pictures
from graphkin.papers.blocks import (
    Beside,
    Block,
    Document,
    Fields,
    Heading,
    Paragraph,
    Picture,
    Said,
    StepItem,
    TableBlock,
    Together,
    finished,
    in_each,
    numbered,
    once,
    said_each,
    sentences,
    table_of,
)
from graphkin.papers.lesson import Lesson, Stage
from graphkin.papers.paper import A4, Paper
from graphkin.plane import added_up, degrees
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Units
from graphkin.words import Neutral, Phrase, about, joined, languages, listed, rich_text, say, sense_of, word
from graphkin.words.symbols import RichText, Words, sign, spaced
from graphkin.words.written import LEAST, amount, pointing, printed

BOUND = "\u00a0"  # between a number and its unit no line ends
RPM = 30.0 / math.pi
HEAD = 22.0  # mm for a heading and the lines under it
LINE, ROW = 6.0, 7.0  # mm of a line of words, and of a row to fill in
ROOM_BETWEEN = 8.0  # mm around what stands on a page


def problem(lesson: Lesson) -> Document:
    """The problem sheet of a lesson."""
    language, paper = lesson.language, lesson.paper
    bare = pictures.mechanism_picture(lesson)
    how = sentences(*(lesson.said(key) for key in ("solve here", "print true", "sense words")))
    words = (*task(lesson), Paragraph(how, small=True))
    moving = [d for d in pictures.POLYGONS if lesson.sheet.vectors[d]]
    shown = all(_space(lesson, bare, [d], paper) for d in moving)
    wide = not shown
    if wide:
        paper = paper.facing  # two facing pages of the smaller paper; the mechanism stands on each with a pole
        shown = all(_space(lesson, bare, [d], paper) for d in moving)
    tall = HEAD + LINE * (len(words) + 1) + bare.height + ROW * (len(lesson.questions) + 2)
    on_polygons = shown and bool(moving) and bare.width > paper.narrow and tall > paper.body.height
    first: tuple[Block, ...] = (*words, Picture(bare))
    if wide or on_polygons:
        first = words  # the mechanism stands on the pages of the polygons
    elif bare.width <= paper.narrow:
        first = (Beside(words, Picture(bare)),)
    asked = [
        {"quantity": lesson.letters.vector(s), "unit": lesson.unit(s),
         "on paper": "" if s.is_vector or s.measure.is_length else "–"}
        for s in lesson.questions
    ]
    blank = table_of(language, asked, ("quantity", "on paper", "value", "unit", "sense"), roomy=True)
    both = _space(lesson, bare, pictures.POLYGONS, paper) if wide and len(moving) == len(pictures.POLYGONS) else None
    before, after = _polygon_pages(lesson, bare, paper, both)
    whole: tuple[Block, ...] = (
        Heading(scene_title(lesson), 1),
        Fields(said_each(language, ("name of student", "class of student", "date"))),
        *first,
        Together((Heading(lesson.said("your results")), blank)),
        *before,
        Paragraph(lesson.said("your sums"), small=True, fills=True),
        *after,
        *_forces(lesson, bare, paper),
    )
    return replace(document(lesson, "problem sheet", whole), paper=paper, folded=paper.folded)


def _space(
    lesson: Lesson, bare: Drawing, diagrams: Sequence[DiagramName], paper: Paper, above: float = 0.0
) -> Drawing | None:
    """Mechanism and poles together below the heading of a page, with ``above`` mm of equations above them."""
    return pictures.workspace(lesson, bare, diagrams, Box(0.0, 0.0, paper.body.width, paper.body.height - HEAD - above))


def _polygon_pages(
    lesson: Lesson, bare: Drawing, paper: Paper, both: Drawing | None
) -> tuple[list[Block], list[Block]]:
    """The equations before the sums, and a page for each polygon, or one for both."""
    drawn = [d for d in pictures.POLYGONS if any(e.diagram == d for e in lesson.sheet.equations)]
    names = {d: lesson.said(FIGURE_WORDS[d]) for d in drawn}
    room = paper.body.width / 2 - ROOM_BETWEEN if paper.folded else paper.body.width
    asked = {d: _equations(lesson, d, min(room, A4.body.width)) for d in drawn}
    frames = {d: _space(lesson, bare, [d], paper, _height(asked[d]) + ROOM_BETWEEN) for d in drawn if both is None}
    beside = both is None and all(frames.values())
    before: list[Block] = [Together((Heading(names[d]), *asked[d])) for d in drawn if asked[d] and not beside]
    if both is not None:
        title = in_each(
            lesson.language,
            lambda each: spaced(word("symbol comma", each), (dict(name)[each] for name in names.values())),
        )
        return before, [Heading(title, fresh=True), Together((_poles(lesson, drawn), Picture(both)))]
    after: list[Block] = []
    for d in drawn:
        frame = (frames[d] if beside else _space(lesson, bare, [d], paper)) or pictures.draw_frame(lesson, d)
        equations = asked[d] if beside else ()
        after += [Heading(names[d], fresh=True), *equations, Together((_poles(lesson, [d]), Picture(frame)))]
    return before, after


def _poles(lesson: Lesson, diagrams: Sequence[DiagramName]) -> Paragraph:
    """The poles from which polygons are to be drawn."""
    poles = [pole(lesson.letters.convention, diagram) for diagram in diagrams]
    return Paragraph(lesson.said(about("your polygon", poles), poles=listed(poles)), small=True)


def _equations(lesson: Lesson, diagram: DiagramName, width: float) -> tuple[Paragraph | Picture, ...]:
    """The equations on a sheet: blanks; at the level "easy" the equations, at "hard" none."""
    equations = [e for e in lesson.sheet.equations if e.diagram == diagram]
    if lesson.level == "hard":
        return ()
    if lesson.level == "easy":
        return tuple(Picture(pictures.equation_picture(lesson, e)) for e in equations)
    blank = pictures.blank_equations(lesson, equations, width)
    return Paragraph(lesson.said("your equations"), small=True), Picture(blank)


def _height(asked: Sequence[Paragraph | Picture]) -> float:
    """The height of the equations on a sheet (mm)."""
    return added_up(block.drawing.height + 3.0 for block in asked if isinstance(block, Picture))


def _forces(lesson: Lesson, bare: Drawing, paper: Paper) -> Iterator[Block]:
    """The equations of the groups cut free, and room for their polygons beside the mechanism, from which directions and
    arms are taken; the equations are on a page before if both do not fit on one."""
    if not lesson.sheet.forces:
        return
    heading = lesson.said("forces")
    counts = [len(g.polygon) for g in lesson.sheet.forces[0].groups if g.way != "drawn system" and len(g.polygon) > 1]
    asked: tuple[Paragraph | Picture, ...] = ()
    if counts and lesson.level != "hard":
        sums = [(count, ["+"] * (count - 1), "= 0") for count in counts]
        blank = pictures.blanks(lesson, sums, min(paper.body.width, A4.body.width))
        asked = (Paragraph(lesson.said("your force equations"), small=True), Picture(blank))
    page = Box(0.0, 0.0, paper.body.width, paper.body.height - HEAD - ROOM_BETWEEN)
    beside = page.height - _height(asked) >= pictures.LEAST_FRAME
    if not beside:
        yield Together((Heading(heading), *asked))
    room = Box(0.0, 0.0, page.width, page.height - (_height(asked) if beside else 0.0))
    yield Heading(heading, fresh=True)
    yield from asked if beside else ()
    drawn = pictures.force_space(lesson, bare, room)
    yield Together((Paragraph(lesson.said("your forces"), small=True), Picture(drawn)))


def document(lesson: Lesson, key: str, blocks: Iterable[Block]) -> Document:
    """A paper of a lesson; its title is that of the scene and its own name, in the first language."""
    title = str(scene_title(lesson)[0][1]) + word("colon", lesson.first) + word(key, lesson.first)
    return Document(title, languages(lesson.language), tuple(blocks), lesson.paper)


def scene_title(lesson: Lesson) -> Said:
    """The title of the scene in each language of the handout."""
    names = titles(lesson.sheet, lesson.language)
    both = tuple(zip(languages(lesson.language), names, strict=False))
    return both if len(names) > 1 else once(names[0], lesson.language)


# what is given


def task(lesson: Lesson) -> Iterator[Paragraph]:
    """The given data and the question."""
    yield from given(lesson)
    yield from _formulas(lesson, "find", [lesson.letters.vector(s) for s in lesson.questions], "symbol comma")
    yield from coincident_points(lesson)
    yield from reach(lesson)


def coincident_points(lesson: Lesson) -> Iterator[Paragraph]:
    """The meaning of the asked points that are told apart by their link, ``B_3``, and of the + of asked forces."""
    ends = (ref for symbol in lesson.questions for ref in (symbol.of, symbol.to) if ref is not None)
    points = dict.fromkeys(
        Phrase("coincident point", point=PointRef(ref.point, link), link=link, place=PointNames((ref.point,)))
        for ref in ends if (link := ref.link or lesson.letters.blocks.get(ref.point))
    )
    if points:
        yield Paragraph(lesson.sentence(joined("list comma of two", points)))
    if any(symbol.plus for symbol in lesson.questions):
        yield Paragraph(lesson.said("plus is with load"))


def given(lesson: Lesson) -> Iterator[Paragraph]:
    """The given data in sentences: lengths, fixed points, guides, drivers, loads."""
    scene, letters, language = lesson.sheet.scene, lesson.letters, lesson.language
    unit = scene.units.length
    lengths = [name + f" = {value}{BOUND}{unit}" for name, value in given_lengths(scene, letters)]
    fixed = [letters.point(p) + f" {place_of(z, scene)}{BOUND}{unit}" for p, z in scene.frame.points.items()]
    yield from _formulas(lesson, "lengths given", [*lengths, *given_teeth(scene, language)])
    yield from _formulas(lesson, "fixed points", fixed)
    yield from _clauses(lesson, "guides", {each: _guides(lesson, each) for each in languages(language)})
    shapes = {each: given_shapes(scene, letters, each) for each in languages(language)}
    yield from _clauses(lesson, "links given", shapes)
    for cam in scene.whole.cams:
        laws = ((each, Phrase("given cam", link=cam.link, law=Neutral(cam_given(scene.whole, cam, each))))
                for each in languages(language))
        yield Paragraph(finished(tuple((each, rich_text(law, each)) for each, law in laws)))
        for point in scene.by_name[cam.link].points:
            if point not in scene.whole.by_name[cam.link].points:
                yield Paragraph(lesson.sentence(Phrase("centre of cam", point=PointNames((point,)), link=cam.link)))
    yield from _formulas(lesson, "driver", [*given_drivers(lesson.sheet, letters), *_speeds(scene)])
    for sense in _senses(scene):
        yield Paragraph(lesson.sentence(sense))
    starts = [*rolling_starts(lesson.sheet), *rolled_starts(lesson.sheet)]
    yield from _formulas(lesson, "rolling starts", starts)
    for load in given_loads(lesson.sheet, letters) if scene.loading else ():
        if load.key == "given balance" and scene.question.find:
            continue  # what is asked for stands below
        yield Paragraph(lesson.sentence(load))


def task_with_source(lesson: Lesson) -> Iterator[Paragraph]:
    """The task with its source, which may tell a result or the way to it: not for who is to solve it."""
    yield from task(lesson)
    language, names = lesson.language, languages(lesson.language)
    sources = {each: lesson.sheet.scene.question.source_in(each) for each in names}
    if len(set(sources.values())) > 1:
        labelled = ((each, word("source", each) + word("colon", each) + text) for each, text in sources.items() if text)
        yield Paragraph(tuple(labelled), small=True)
    elif sources[names[0]]:
        label = " ".join(word("source", each) for each in names) + word("colon", names[-1])
        yield Paragraph(once(label + sources[names[0]], language), small=True)


def _guides(lesson: Lesson, language: str) -> list[Words]:
    """Each named guide of the frame, by a point of it and its direction."""
    scene, phrases = lesson.sheet.scene, list[Words]()
    for name, place, angle in fixed_guides(scene, lesson.letters):
        key = {"0": "guide level", "90": "guide upright"}.get(angle, "guide at")
        phrase = Phrase(key, guide=name, place=place, unit=scene.units.length, angle=angle)
        phrases.append(rich_text(phrase, language))
    return phrases


def reach(lesson: Lesson) -> Iterator[Paragraph]:
    """The sentence that only a part of the mechanism is on the paper, if the asked quantities need no more."""
    return (Paragraph(lesson.sentence(phrase)) for phrase in lesson.sheet.left_out)


def _speeds(scene: Mechanism) -> Iterator[RichText]:
    """Speeds of drivers in r/min, where these are round numbers."""
    for driver in scene.drivers:
        if driver.turns and driver.rate and driver.rpm is None:  # a given one stands there already
            rpm = float(f"{driver.rate * RPM:.9g}")
            if len(number(rpm)) < len(number(driver.rate)):
                yield sign("n", driver.link) + f" = {number(rpm)}{BOUND}r/min"


def _senses(scene: Mechanism) -> Iterator[Phrase]:
    """The senses of drivers, and whether they turn faster and faster."""
    for driver in scene.drivers:
        if driver.turns and driver.rate:
            on = "" if driver.relative_to == scene.frame.name else Phrase("seen from link", link=driver.relative_to)
            even = "" if driver.law is not None else Phrase("at constant speed")
            faster = Phrase("ever faster" if driver.second * driver.rate > 0 else "ever slower")
            law = faster if driver.second else even
            yield Phrase("driver turns", link=driver.link, sense=sense_of(driver.rate), base=on, law=law)


def _formulas(lesson: Lesson, key: str, items: Sequence[RichText], between: str = "list comma") -> Iterator[Paragraph]:
    """Formulas, if there are any, with their label; on papers of two languages once, with both labels."""
    first, *others = languages(lesson.language)
    text = spaced(word(between, first), items)
    if items and not others:
        yield Paragraph(((first, labelled(key, text, first)),))
    elif items:
        label = " ".join(word(key, each) for each in (first, *others)) + word("colon", first)
        whole = label + " " * (not label.endswith(" ")) + text + word("full stop", first)
        yield Paragraph(once(whole, lesson.language))


def _clauses(lesson: Lesson, key: str, clauses: Mapping[str, Sequence[Words]]) -> Iterator[Paragraph]:
    """Clauses in each language, if there are any, with their label."""
    if any(clauses.values()):
        whole = {each: spaced(word("list semicolon", each), some) for each, some in clauses.items()}
        yield Paragraph(in_each(lesson.language, lambda each: labelled(key, whole[each], each)))


def labelled(key: str, text: Words, language: str) -> Words:
    """A text behind a word of the table and a colon, as a sentence."""
    return word(key, language) + word("colon", language) + text + word("full stop", language)


# the answer key


@dataclass(frozen=True)
class KeyRow:
    """A line of the key, in scene units: the size of a vector, a rate with its sign.

    ``tolerance`` is three predicted standard deviations of a pencil drawing, None where the prediction has no bound.
    """

    symbol: str
    unit: str
    asked: bool
    on_paper: float | None
    exact: float
    tolerance: float | None
    direction: float | None


def key_rows(lesson: Lesson) -> tuple[KeyRow, ...]:
    """The lines of the key."""
    rows = []
    for row in lesson.results:
        symbol, spread, mm = row.symbol, lesson.tolerance.get(row.symbol), row.reading.on_paper
        bounded = spread is not None and math.isfinite(spread.deviation)
        size = abs(row.true) if symbol.is_vector else float(row.true.real)
        if mm is not None:  # what a residue has on paper is no length
            mm = 0.0 if row.measured == 0.0 else float(amount(mm, 3)) if mm < LEAST else round(mm, 3)
        rows.append(KeyRow(
            symbol=str(symbol),
            unit=lesson.unit(symbol),
            asked=symbol in lesson.questions,
            on_paper=mm,
            exact=lesson.in_unit(symbol, size),
            tolerance=lesson.in_unit(symbol, COVERAGE * spread.deviation) if spread is not None and bounded else None,
            direction=round(degrees(complex(row.exact)), 3) + 0.0 if symbol.is_vector and size > 0.0 else None,
        ))
    return tuple(rows)


def result_cells(lesson: Lesson) -> Iterator[dict[str, Words]]:
    """The cells of each result, by the keys of their heads."""
    units = lesson.sheet.scene.units
    for line, row in zip(key_rows(lesson), lesson.results, strict=True):
        placed, is_length = row.symbol.scope == "position", row.symbol.is_vector or row.symbol.measure.is_length
        size = line.exact if placed else abs(line.exact)
        read, right = measured(row.reading, units, row), exact(row, units)
        tolerance, accept = accepted(size, line.tolerance or 0.0, -math.inf if placed else 0.0)
        yield {
            "quantity": lesson.letters.vector(row.symbol),
            "on paper": printed(paper(row.reading, row)) if is_length else "–",  # a rate has no length of its own
            "measured": unsigned(row, printed(read)), "exact": unsigned(row, printed(right)), "value": number(size, 5),
            "course difference": f"{100 * abs(float(read) / float(right) - 1.0):.2f}" if float(right) else "–",
            "tolerance": tolerance, "accept": accept, "unit": line.unit, "sense": way(row, lesson.language),
        }


def accepted(value: float, tolerance: float, least: float) -> tuple[str, str]:
    """The tolerance of a value for a pencil drawing, to two figures, and the accepted range; dashes where it has no
    bound, and for a value that every drawing makes zero."""
    if not tolerance or not math.isfinite(tolerance):
        return "–", "–"
    places = 1 - math.floor(math.log10(tolerance))  # negative for tens and hundreds

    def told(number: float) -> str:
        return printed(f"{round(number, places):.{max(0, places)}f}")

    return f"± {told(tolerance)}", f"{told(max(value - tolerance, least))} … {told(value + tolerance)}"


def results_table(lesson: Lesson, *keys: str) -> TableBlock:
    """The results in columns with these heads, asked ones in bold."""
    asked = [i for i, row in enumerate(lesson.results) if row.symbol in lesson.questions]
    return table_of(lesson.language, result_cells(lesson), keys, asked)


def answer_key(lesson: Lesson) -> Document:
    """The answer key of a lesson."""
    tools = lesson.sheet.scene.question.sheet.tools
    words = lesson.said(
        "key words", points=f"{tools.line_width / 2:g}", ruler=f"{tools.ruler:g}",
        compass=f"{tools.compass:g}", directions=f"{tools.set_square:g}",
    )
    return document(lesson, "answer key", (
        Heading(scene_title(lesson), 1),
        Heading(lesson.said("answer key")),
        *reach(lesson),
        results_table(lesson, "quantity", "on paper", "value", "tolerance", "accept", "unit", "sense"),
        Paragraph(sentences(words, lesson.said("sense words")), small=True),
    ))


def key_table(lesson: Lesson) -> table.Table:
    """The key as a table, in scene units."""
    heads = ("symbol", "unit", "asked", "on_paper_mm", "exact", "tolerance", "direction_deg")
    return table.Table.of(heads, map(astuple, key_rows(lesson)), ("", "", "", "", ".9g", ".3g", ".3f"))


def answers_template(
    asked: Sequence[Symbol], units: Units, language: str, lines: Iterable[Sequence[str]] = (("", ""),), *more: str
) -> table.Table:
    """A table for a class to fill in, as ``audit`` reads it: names, numbers, each quantity, for a vector its direction.

    Parameters
    ----------
    lines : the filled-in rows
    more : keys of the heads of their further columns
    """
    lead = [word(key, language) for key in ("name in a class", "id in a class", *more)]
    heads = list[str]()
    for symbol in asked:
        heads.append(head_of(symbol, units))
        heads += [f"{symbol} {word('direction of', language)}"] if symbol.is_vector else []
    return table.Table.of([*lead, *heads], [[*line, *[""] * len(heads)] for line in lines])


def head_of(symbol: Symbol, units: Units) -> str:
    """A quantity with its unit, as the head of a column."""
    unit = symbol.unit(units).text
    return f"{symbol} ({unit})" if unit else str(symbol)


def unsigned(row: Compared, text: str) -> str:
    """A value without its sign where its sense is in words; a place keeps its sign."""
    return text if _is_place(row.symbol) else text.removeprefix("−")


def _is_place(symbol: Symbol) -> bool:
    """Whether its sign tells a side, not a sense: a position, or the arm or shift of a force."""
    return symbol.scope == "position" or (symbol.scope == "force" and not symbol.is_load)


def way(row: Compared, language: str) -> str:
    """Direction of a vector in degrees, or the sense of a rate in words; "" where it is zero."""
    value = row.true
    if value == 0.0 or row.symbol.scope not in ("motion", "force") or _is_place(row.symbol):
        return ""
    if row.symbol.is_vector:
        return f"{pointing(complex(value))}°"
    key = "counter-clockwise" if value.real > 0 else "clockwise"
    return " ".join(word(key, each) for each in languages(language))


# the worked solution


MANY = 6  # steps that stand in two columns above their figure


def solution(lesson: Lesson, worked: Iterable[Block] | None = None) -> Document:
    """The worked solution of a lesson; ``worked`` are its stages, if they are made already."""
    stages = solution_blocks(lesson, beginning(lesson)) if worked is None else worked
    return document(lesson, "worked solution", (Heading(scene_title(lesson), 1), *stages, *results_blocks(lesson)))


def beginning(lesson: Lesson) -> tuple[Paragraph, ...]:
    """The given data, and a note on the numbers of the steps."""
    return (*task_with_source(lesson), Paragraph(lesson.said("bracket words"), small=True))


def solution_blocks(lesson: Lesson, lead: tuple[Paragraph, ...] = ()) -> Iterator[Block]:
    """The solution stage by stage; ``lead`` comes before the first."""
    layers: dict[str, pictures.Layers] = {}
    first: int | None = None  # of steps that the next figure of their diagram shows too
    # velocity plans of what rolls, and those of the tangential accelerations, each a figure
    plans = train_pages(lesson.page("plan"))
    pages = [[plans.pop(n) for n in dict.fromkeys(step.plan for step in stage.steps) if n in plans]
             for stage in lesson.stages]
    drawn = iter([stage for stage in lesson.stages if not stage.of_plans][1:])
    leads_on = [stage.of_plans or _leads_on(stage, next(drawn, None)) for stage in lesson.stages]
    count = 0  # of the figures
    for k, (stage, shown) in enumerate(zip(lesson.stages, pages, strict=True)):
        if stage.diagram not in layers:
            layers[stage.diagram] = pictures.parts(lesson, stage.diagram)
        opening = lead if stage is lesson.stages[0] else ()
        if stage.of_plans:
            yield Together(tuple(_plan_blocks(lesson, stage.diagram, shown, count, stage)))
            count += len(shown)
            continue
        if leads_on[k]:
            plans_before = sum(map(len, pages[k : leads_on.index(False, k)]))
            lines = _told(lesson, stage, count + plans_before + 1)
            yield Together((*lines, *step_items(lesson, stage, len(stage.steps) > 1)))
            first = first or stage.first
        else:
            count += 1
            yield Together(tuple(_stage(lesson, stage, layers[stage.diagram], opening, first or stage.first, count)))
            first = None
        if shown:
            yield Together(tuple(_plan_blocks(lesson, stage.diagram, shown, count)))
            count += len(shown)
    for plan, page in plans.items():
        yield Together(tuple(_plan_blocks(lesson, lesson.sheet.trains[plan - 1].order, [page], count)))
        count += 1
    yield from _force_blocks(lesson, count)


def _plan_blocks(
    lesson: Lesson, order: str, pages: Iterable[Drawing], count: int, stage: Stage | None = None
) -> Iterator[Heading | StepItem | Picture]:
    """The pages of velocity plans with their steps, none where no part of them moves, after ``count`` figures."""
    title = lesson.said(PLAN_WORDS[order])
    yield Heading(title)
    if stage is not None:
        yield from step_items(lesson, stage, len(stage.steps) > 1)
    for page in pages:
        count += 1
        yield Picture(pictures.bare_picture(page), numbered(count, title), floats=True)


def force_stages_of(lesson: Lesson) -> Iterator[tuple[ForceStage, Said, tuple[StepItem, ...]]]:
    """The stages of the forces, each with the words that tell the drawing with the load from that without it (none
    where there is but one drawing), and its steps."""
    sheet, language = lesson.sheet, lesson.language
    for stage in force_stages(lesson.account):
        several = len(sheet.forces) > 1 and bool(stage.group.links)
        load = lesson.said("force with load" if stage.again else "force without load") if several else ()
        steps = ((s.step.number, in_each(language, s.sentence), s.work_in(language)) for s in stage.steps)
        yield stage, load, tuple(StepItem(*step) for step in steps)


def _force_blocks(lesson: Lesson, count: int) -> Iterator[Block]:
    """Force polygons group by group, and Zhukovsky's lever; ``count`` figures come before them."""
    sheet = lesson.sheet
    if not sheet.forces:
        return
    statement = Paragraph(once(scale_statement(sheet, lesson.letters.convention, "force"), lesson.language))
    lead: tuple[Heading | Paragraph, ...] = (Heading(lesson.said("forces")), statement)
    lever = lever_figure(lesson.page("lever"))
    for turn, (stage, load, steps) in enumerate(force_stages_of(lesson)):
        title = lesson.said(stage.title.key, **stage.title.gaps)
        if load:
            both = zip(title, load, strict=True)
            title = tuple((each, name + "  (" + text + ")") for (each, name), (_, text) in both)
        count += bool(stage.group.links)
        yield Together((*lead, Heading(title, 3), *_force_pictures(lesson, stage, f"-{turn}", count), *steps))
        lead = ()
        if stage.figure == "lever" and lever is not None:
            count += 1
            yield Picture(pictures.bare_picture(lever), numbered(count, lesson.said("lever")))
            lever = None


def _force_pictures(lesson: Lesson, stage: ForceStage, tag: str, count: int) -> Iterator[Picture]:
    """The equation of a group over its rows, and the group cut free beside its polygon."""
    group = stage.group
    if not group.links:
        return
    page = lesson.page("forces", lesson.paper.body.width)
    equation = group_equation(page, group)
    if equation is not None:
        yield Picture(equation, joined=True)
    drawn = group_picture(page, stage, tag)
    caption = group.told("figure of forces")
    yield Picture(drawn, numbered(count, in_each(lesson.language, lambda each: rich_text(caption, each))))


def results_blocks(lesson: Lesson) -> Iterator[Block]:
    """Remarks on the construction, results, and whether the readings of the table agree."""
    if lesson.sheet.notes:
        yield Heading(lesson.said("remarks"), 3)
    for note in lesson.sheet.notes:
        yield Paragraph(lesson.sentence(note))
    rows = [row for row in lesson.results if row.ok is not None]
    wrong = [row for row in rows if row.ok is False]
    agree = Phrase(about("all agree", rows), readings=len(rows))
    verdict = lesson.sentence(Phrase("not all agree", wrong=len(wrong), readings=len(rows)) if wrong else agree)
    how = sentences(*(lesson.said(key) for key in ("check words", "sense words")))
    yield Together((
        Heading(lesson.said("results")),
        Paragraph(once(drivers(lesson.sheet, lesson.letters), lesson.language)),
        results_table(lesson, "quantity", "on paper", "measured", "exact", "unit", "sense"),
        Paragraph(verdict),
        Paragraph(how, small=True),
    ))


def stage_title(lesson: Lesson, stage: Stage) -> Said:
    """The subject of a stage: the position, an equation and its kind, a velocity plan, or the other asked vectors."""
    equation = stage.equation
    if stage.diagram == "mechanism":
        return lesson.said("the position")
    if equation is None:
        return lesson.said(PLAN_WORDS[stage.diagram] if stage.of_plans else "further vectors")
    numbered_one = Phrase("equation numbered", number=equation.number)
    return in_each(
        lesson.language,
        lambda each: say(numbered_one, each) + word("colon", each) + word(f"for {stage.diagram}", each),
    )


def step_items(lesson: Lesson, stage: Stage, parted: bool = False) -> tuple[StepItem, ...]:
    """The steps of a stage in words and numbers."""
    return tuple(
        StepItem(words.step.number, in_each(lesson.language, words.sentence), words.work, parted)
        for words in (telling(lesson.account, step) for step in stage.steps)
    )


def _leads_on(stage: Stage, after: Stage | None) -> bool:
    """Whether the next figure shows the steps of a stage as well: a driver's few vectors, all known."""
    if stage.equation is None or after is None or after.equation is None or after.diagram != stage.diagram:
        return False
    return not any(step.reason == "direction" for step in stage.steps)


def _told(lesson: Lesson, stage: Stage, count: int) -> Iterator[Heading | Paragraph | Picture]:
    """The head of an equation's steps: the equation over its rows, its reasons; ``count`` numbers their figure."""
    equation = stage.equation
    assert equation is not None
    where = dict(lesson.said("see figure", figure=count))
    yield Heading(tuple((each, title + where[each]) for each, title in stage_title(lesson, stage)))
    yield Picture(pictures.equation_picture(lesson, equation), joined=True)
    reasons = in_each(lesson.language, lambda each: why(lesson.account, equation, each))
    if any(text for _, text in reasons):
        yield Paragraph(reasons, small=True)


def _stage(
    lesson: Lesson, stage: Stage, layers: pictures.Layers, lead: tuple[Paragraph, ...], begun: int, count: int
) -> Iterator[Heading | Paragraph | StepItem | Picture | Beside]:
    """A stage with its figure, on which strokes after step ``begun`` are emphasised."""
    sheet = lesson.sheet
    drawn = pictures.stage_picture(lesson, layers, stage.diagram, begun, stage.last)
    start = sheet.of(stage.diagram)[0].number
    key = "figure whole" if begun == start else "figure with step"
    if start != begun != stage.last:
        key = "figure so far"
    named = Phrase(FIGURE_WORDS[stage.diagram])
    caption = lesson.said(key, figure=named, step=stage.last, first=begun)
    figure = Picture(drawn, numbered(count, caption), floats=True)
    narrow = drawn.width <= lesson.paper.narrow
    steps = step_items(lesson, stage, parted=not narrow and len(stage.steps) >= MANY)
    beside: tuple[Heading | Paragraph | StepItem, ...] = steps
    if stage.equation is not None:
        yield from _told(lesson, stage, count)
    else:
        beside = (*lead, Heading(stage_title(lesson, stage)), *steps)
    if narrow:
        yield Beside(beside, figure)
    else:
        yield from beside
        yield figure
