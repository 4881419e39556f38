"""The worked solution: step by step with reasons, equations and figures as far as drawn, results, and their check."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from graphkin.account.headings import FIGURE_WORDS, drivers, written
from graphkin.account.notation import scale_statement
from graphkin.checking.report import exact, measured
from graphkin.drawing.figures.forces import group_equation, group_picture
from graphkin.drawing.figures.lever import lever_figure
from graphkin.drawing.figures.train import moving_plans, train_figure
from graphkin.drawing.force_stages import ForceStage, force_stages
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers.answer_key import length_on_paper, unsigned, way
from graphkin.papers.blocks import (
    Beside,
    Block,
    Document,
    Heading,
    Paragraph,
    Picture,
    Said,
    StepItem,
    Steps,
    TableBlock,
    Together,
    in_each,
    numbered,
    said,
    sentences,
    spoken,
)
from graphkin.papers.lesson import Lesson, Stage
from graphkin.papers.paper import paper_of
from graphkin.papers.pictures import Layers, bare_picture, equation_picture, parts, stage_picture
from graphkin.papers.problem import given, paper_title, scene_title
from graphkin.words import Phrase, about, languages, say, word

__all__ = ["beginning", "results_blocks", "solution", "solution_blocks", "stage_title", "step_items"]

MANY = 6  # steps that stand in two columns above their figure


def solution(lesson: Lesson, worked: Iterable[Block] | None = None) -> Document:
    """The worked solution of a lesson; ``worked`` are its stages, where they are there already."""
    stages = solution_blocks(lesson, beginning(lesson)) if worked is None else worked
    blocks = (Heading(scene_title(lesson), 1), *stages, *results_blocks(lesson))
    title = paper_title(lesson, "worked solution")
    return Document(title, languages(lesson.language), blocks, paper_of(lesson.sheet.scene))


def beginning(lesson: Lesson) -> tuple[Paragraph, ...]:
    """What is given, and how the numbers of the steps are to be read."""
    return (*given(lesson), Paragraph(said("bracket words", lesson.language), small=True))


def solution_blocks(lesson: Lesson, lead: tuple[Paragraph, ...] = ()) -> Iterator[Block]:
    """Stage by stage; ``lead`` stands before the first."""
    layers: dict[str, Layers] = {}
    first: int | None = None  # of steps that the next figure of their diagram shows too
    figure = train_figure(lesson.sheet, language=lesson.language, convention=lesson.convention)
    orders: list[str] = [plan.order for plan in moving_plans(lesson.sheet)] if figure is not None else []
    # velocity plans of what rolls, and those of the tangential accelerations, each a figure
    plans = dict(zip(orders, map(bare_picture, (figure, *figure.further) if figure else ()), strict=True))
    count = 0  # of the figures
    for stage, after in zip(lesson.stages, (*lesson.stages[1:], None), strict=True):
        if stage.diagram not in layers:
            layers[stage.diagram] = parts(lesson, stage.diagram)
        opening = lead if stage is lesson.stages[0] else ()
        if stage.equation is None and all(step.per_mm for step in stage.steps):  # drawn on the plan of a train alone
            plan = plans.pop(stage.diagram, None)
            count += plan is not None
            yield Together(tuple(_plan_blocks(lesson, stage.diagram, plan, count, stage)))
        elif _leads_on(stage, after):
            steps = Steps(step_items(lesson, stage), parted=len(stage.steps) > 1)
            yield Together((*_told(lesson, stage, count + 1), steps))
            first = stage.first
        else:
            count += 1
            yield Together(tuple(_stage(lesson, stage, layers[stage.diagram], opening, first or stage.first, count)))
            first = None
        if stage.diagram in plans and any(step.per_mm for step in stage.steps):
            count += 1
            yield Together(tuple(_plan_blocks(lesson, stage.diagram, plans.pop(stage.diagram), count)))
    for order, plan in plans.items():
        count += 1
        yield Together(tuple(_plan_blocks(lesson, order, plan, count)))
    yield from _force_blocks(lesson, count)


def _plan_blocks(
    lesson: Lesson, order: str, figure: Drawing | None, count: int, stage: Stage | None = None
) -> Iterator[Heading | Steps | Picture]:
    """A velocity plan with its steps; without a figure where nothing of it moves."""
    told = said("plan" if order == "velocity" else "plan accelerations", lesson.language)
    yield Heading(told)
    if stage is not None:
        yield Steps(step_items(lesson, stage), parted=len(stage.steps) > 1)
    if figure is not None:
        yield Picture(figure, numbered(count, told), floats=True)


def _force_blocks(lesson: Lesson, count: int) -> Iterator[Block]:
    """Force polygons group by group, and Zhukovsky's lever; ``count`` figures stand before them."""
    sheet, forces, language = lesson.sheet, lesson.forces, lesson.language
    if forces is None:
        return
    statement = Paragraph(spoken(scale_statement(lesson.scaled, lesson.letters.convention, "force"), language))
    lead: tuple[Heading | Paragraph, ...] = (Heading(said("forces", language)), statement)
    lever = lever_figure(sheet, forces, language=language, convention=lesson.convention)
    for turn, stage in enumerate(force_stages(lesson.scaled, forces, lesson.letters, language)):
        steps = Steps(tuple(StepItem(step.number, step.words, step.work) for step in stage.steps))
        title = stage.title
        if len(forces.states) > 1 and stage.group is not None:
            load = said("force with load" if stage.again else "force without load", language)
            title = tuple((each, f"{one}  ({text})") for (each, one), (_, text) in zip(title, load, strict=True))
        count += stage.group is not None
        yield Together((*lead, Heading(title, 3), *_force_pictures(lesson, stage, f"-{turn}", count), steps))
        lead = ()
        if stage.figure == "lever" and lever is not None:
            count += 1
            yield Picture(bare_picture(lever), numbered(count, said("lever", language)))
            lever = None


def _force_pictures(lesson: Lesson, stage: ForceStage, tag: str, count: int) -> Iterator[Picture]:
    """The equation of a group over its rows, and the group cut free beside its polygon."""
    forces, group, language = lesson.forces, stage.group, lesson.language
    if forces is None or group is None:
        return
    width = paper_of(lesson.sheet.scene).body.width
    equation = group_equation(lesson.scaled, group, lesson.letters, language, width)
    if equation is not None:
        yield Picture(equation, joined=True)
    drawn = group_picture(lesson.scaled, forces, stage, group, lesson.letters, language, width, tag)
    told = said(about("figure of forces", group.links), language, ", ".join(group.links))
    yield Picture(drawn, numbered(count, told))


def results_blocks(lesson: Lesson) -> Iterator[Block]:
    """Remarks on the construction, results, and whether the readings of the table agree."""
    language = lesson.language
    if lesson.sheet.notes:
        yield Heading(said("remarks", language), 3)
    for note in lesson.sheet.notes:
        yield Paragraph(lesson.sentence(note))
    rows = [row for row in lesson.results if row.ok is not None]
    wrong = [row for row in rows if row.ok is False]
    agree = Phrase(about("all agree", rows), (len(rows),))
    verdict = lesson.sentence(Phrase("not all agree", (len(wrong), len(rows))) if wrong else agree)
    how = sentences(*(said(key, language) for key in ("check words", "sense words")))
    yield Together((
        Heading(said("results", language)),
        Paragraph(spoken(drivers(lesson.sheet, lesson.letters), language)),
        _results(lesson),
        Paragraph(verdict),
        Paragraph(how, small=True),
    ))  # fmt: skip


def stage_title(lesson: Lesson, stage: Stage) -> Said:
    """What a stage is about: the position, an equation and its kind, or the vectors asked for besides."""
    equation = stage.equation
    if stage.diagram == "mechanism":
        return said("the position", lesson.language)
    if equation is None:
        return said("further vectors", lesson.language)
    numbered_one = Phrase("equation numbered", (equation.number,))
    return in_each(
        lesson.language,
        lambda each: say(numbered_one, each) + word("colon", each) + word(f"for {stage.diagram}", each),
    )


def step_items(lesson: Lesson, stage: Stage) -> tuple[StepItem, ...]:
    """The steps of a stage in words and numbers."""
    account, names = lesson.account, languages(lesson.language)
    return tuple(
        StepItem(step.number, tuple((each, account.step(step, each)) for each in names), account.work(step))
        for step in stage.steps
    )


def _leads_on(stage: Stage, after: Stage | None) -> bool:
    """Whether the next figure shows the steps of a stage as well: a driver's few vectors, all known."""
    if stage.equation is None or after is None or after.equation is None or after.diagram != stage.diagram:
        return False
    return not any(step.reason == "direction" for step in stage.steps)


def _told(lesson: Lesson, stage: Stage, count: int) -> Iterator[Heading | Paragraph | Picture]:
    """What stands above the steps of an equation: the equation over its rows, and why it is so; ``count`` is the number
    of the figure that shows them."""
    equation = stage.equation
    assert equation is not None
    where = dict(said("see figure", lesson.language, count))
    yield Heading(tuple((each, f"{title}{where[each]}") for each, title in stage_title(lesson, stage)))
    yield Picture(equation_picture(lesson, equation), joined=True)
    why = in_each(lesson.language, lambda each: lesson.account.why(equation, each))
    if any(text for _, text in why):
        yield Paragraph(why, small=True)


def _stage(
    lesson: Lesson, stage: Stage, layers: Layers, lead: tuple[Paragraph, ...], begun: int, count: int
) -> Iterator[Heading | Paragraph | Steps | Picture | Beside]:
    """A stage with its figure, on which what is new since step ``begun`` stands out."""
    sheet = lesson.sheet
    drawn = stage_picture(lesson, layers, stage.diagram, begun, stage.last)
    start = next(step.number for step in sheet.steps if step.diagram == stage.diagram)
    args: tuple[int, ...] = (stage.last,)
    key = "figure whole" if begun == start else "figure with step"
    if start != begun != stage.last:
        key, args = "figure so far", (stage.last, begun)
    named = FIGURE_WORDS[stage.diagram]
    caption = in_each(lesson.language, lambda each: say(Phrase(key, (word(named, each), *args)), each))
    figure = Picture(drawn, numbered(count, caption), floats=True)
    narrow = drawn.width <= paper_of(sheet.scene).narrow
    steps = Steps(step_items(lesson, stage), parted=not narrow and len(stage.steps) >= MANY)
    beside: tuple[Heading | Paragraph | Steps, ...] = (steps,)
    if stage.equation is not None:
        yield from _told(lesson, stage, count)
    else:
        beside = (*lead, Heading(stage_title(lesson, stage)), steps)
    if narrow:
        yield Beside(beside, figure)
    else:
        yield from beside
        yield figure


def _results(lesson: Lesson) -> TableBlock:
    heads = tuple(said(key, lesson.language) for key in ("quantity", "on paper", "measured", "exact", "unit", "sense"))
    units = lesson.sheet.scene.units
    rows = tuple(
        (
            f"${lesson.letters.vector(row.symbol)}$",
            length_on_paper(row),
            unsigned(row, written(measured(row.reading, lesson.report.scales, units, row))),
            unsigned(row, written(exact(row, units))),
            lesson.unit(row.symbol),
            way(row, lesson.language),
        )
        for row in lesson.results
    )
    bold = frozenset(i for i, row in enumerate(lesson.results) if row.symbol in lesson.questions)
    return TableBlock(heads, rows, "lrrrll", bold)
