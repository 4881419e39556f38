"""The worked solution: step by step with reasons, equations and figures as far as drawn, results, and their check."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

from graphkin.checking import Compared
from graphkin.drafting.sheet import Equation
from graphkin.drawing.headings import drivers, number
from graphkin.handout.blocks import (
    Beside,
    Block,
    Document,
    Heading,
    Paragraph,
    Picture,
    Said,
    StepItem,
    Steps,
    Table,
    Together,
    said,
    sentences,
    spoken,
)
from graphkin.handout.lesson import Lesson, Stage
from graphkin.handout.paper import paper_of
from graphkin.handout.pictures import WORDS, Layers, equation_picture, parts, stage_picture
from graphkin.handout.problem import given, paper_title, scene_title
from graphkin.handout.sentences import plain_words
from graphkin.words import Phrase, languages, say, word

__all__ = ["equation_words", "results_blocks", "solution", "solution_blocks", "stage_title", "step_items"]


def solution(lesson: Lesson) -> Document:
    """The worked solution of a lesson."""
    blocks = (
        Heading(scene_title(lesson), 1),
        *solution_blocks(lesson, tuple(given(lesson))),
        *results_blocks(lesson),
    )
    title = paper_title(lesson, "worked solution")
    return Document(title, languages(lesson.language), blocks, paper_of(lesson.sheet.scene))


def solution_blocks(lesson: Lesson, lead: tuple[Paragraph, ...] = ()) -> Iterator[Block]:
    """Stage by stage; ``lead`` stands before the first."""
    layers: dict[str, Layers] = {}
    for stage in lesson.stages:
        if stage.diagram not in layers:
            layers[stage.diagram] = parts(lesson.sheet, stage.diagram, lesson.letters, lesson.language)
        yield Together(tuple(_stage(lesson, stage, layers[stage.diagram], lead if stage is lesson.stages[0] else ())))


def results_blocks(lesson: Lesson) -> Iterator[Block]:
    """Remarks on the construction, results, and their check."""
    yield from _remarks(lesson)
    yield Together(
        (
            Heading(said("results", lesson.language)),
            Paragraph(spoken(drivers(lesson.sheet, lesson.letters), lesson.language)),
            _results(lesson),
            Paragraph(_verdict(lesson)),
            Paragraph(sentences(*(said(key, lesson.language) for key in ("check words", "sense words"))), small=True),
        )
    )


def stage_title(lesson: Lesson, stage: Stage) -> Said:
    """What a stage is about: the position, an equation and its kind, or the vectors asked for besides."""
    if stage.diagram == "mechanism":
        return said("the position", lesson.language)
    if stage.equation is None:
        return said("further vectors", lesson.language)
    return tuple(
        (
            each,
            say(Phrase("equation numbered", (stage.equation.number,)), each)
            + word("colon", each)
            + word(f"for {stage.diagram}", each),
        )
        for each in languages(lesson.language)
    )


def step_items(lesson: Lesson, stage: Stage) -> tuple[StepItem, ...]:
    """The steps of a stage in words and numbers."""
    speaker = lesson.speaker
    return tuple(
        StepItem(
            step.number,
            tuple((each, speaker.step(step, each)) for each in languages(lesson.language)),
            speaker.work(step),
        )
        for step in stage.steps
    )


def equation_words(lesson: Lesson, equation: Equation) -> str:
    """An equation on one line: ``v_B3 = v_B2 + v_B3B2``."""
    sides = (" + ".join(plain_words(f"${lesson.letters.vector(t.symbol)}$") for t in side) for side in equation.sides)
    return " = ".join(sides)


def _stage(
    lesson: Lesson, stage: Stage, layers: Layers, lead: tuple[Paragraph, ...]
) -> Iterator[Heading | Paragraph | Steps | Picture | Beside]:
    sheet, letters, language = lesson.sheet, lesson.letters, lesson.language
    heading = Heading(stage_title(lesson, stage))
    steps = Steps(step_items(lesson, stage))
    drawn = stage_picture(sheet, layers, stage.diagram, letters, language, stage.first, stage.last)
    start = next(step.number for step in sheet.steps if step.diagram == stage.diagram)
    key, args = (
        ("figure whole", (stage.last,)) if stage.first == start else ("figure so far", (stage.last, stage.first))
    )
    caption = tuple(
        (each, say(Phrase(key, (word(WORDS[stage.diagram], each), *args)), each)) for each in languages(language)
    )
    figure = Picture(drawn, caption)
    beside: tuple[Heading | Paragraph | Steps, ...] = (steps,)
    if stage.equation is not None:
        yield heading
        words = equation_words(lesson, stage.equation)
        yield Picture(equation_picture(sheet, stage.equation, letters, language, words), joined=True)
    else:
        beside = (*lead, heading, steps)
    if drawn.width <= paper_of(sheet.scene).narrow:
        yield Beside(beside, figure)
    else:
        yield from beside
        yield figure


def _remarks(lesson: Lesson) -> Iterator[Block]:
    sheet = lesson.sheet
    notes = [*sheet.notes, *((sheet.stopped,) if sheet.stopped else ())]
    if notes:
        yield Heading(said("remarks", lesson.language), 3)
    for note in notes:
        yield Paragraph(tuple((each, lesson.speaker.sentence(note, each)) for each in languages(lesson.language)))


def _results(lesson: Lesson) -> Table:
    heads = tuple(said(key, lesson.language) for key in ("quantity", "on paper", "measured", "exact", "unit", "sense"))
    rows, bold = [], set()
    for i, row in enumerate(lesson.results):
        symbol = row.symbol
        if symbol in lesson.questions:
            bold.add(i)
        rows.append((
            f"${lesson.letters.vector(symbol)}$",
            f"{row.reading.on_paper:.2f}",
            number(_plain(lesson, row, row.reading.value), 5),
            number(_plain(lesson, row, row.exact), 5),
            lesson.unit(symbol),
            way(row, lesson.language),
        ))  # fmt: skip
    return Table(heads, tuple(rows), "lrrrll", frozenset(bold))


def _plain(lesson: Lesson, row: Compared, value: complex | float) -> float:
    size = abs(value) if row.symbol.is_vector else abs(float(value.real))
    return lesson.in_unit(row.symbol, size)


def way(row: Compared, language: str) -> str:
    """Direction of a vector in degrees, or the sense of a rate in words; "" where it is zero."""
    value = row.exact
    if row.symbol.is_vector:
        if row.reading.on_paper < 1e-6:
            return ""
        angle = round(math.degrees(cmath.phase(complex(value))), 1) + 0.0
        return f"{180.0 if angle == -180.0 else angle:.1f}°".replace("-", "−")
    if abs(value) < 1e-9:
        return ""
    key = "counter-clockwise" if value.real > 0 else "clockwise"
    return " ".join(word(key, each) for each in languages(language))


def _verdict(lesson: Lesson) -> Said:
    rows = lesson.report.rows
    wrong = [row for row in rows if not row.ok]
    phrase = Phrase("not all agree", (len(wrong), len(rows))) if wrong else Phrase("all agree", (len(rows),))
    return tuple((each, lesson.speaker.sentence(phrase, each)) for each in languages(lesson.language))
