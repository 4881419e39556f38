"""The problem sheet: the mechanism to scale, what is given and asked, room to solve it with ruler and compass."""

from __future__ import annotations

import math
from collections.abc import Iterator

from graphkin.drawing.conventions import pole
from graphkin.drawing.headings import drivers, number, titles
from graphkin.drawing.tables import given_lengths
from graphkin.handout.blocks import (
    Beside,
    Block,
    Document,
    Fields,
    Heading,
    Paragraph,
    Picture,
    Said,
    Table,
    said,
    spoken,
)
from graphkin.handout.lesson import Lesson
from graphkin.handout.pictures import NARROW, WORDS, blank_equations, draw_frame, mechanism_picture, parts
from graphkin.handout.sentences import plain_words
from graphkin.scene.model import Guide
from graphkin.words import Phrase, languages, say, word

__all__ = ["given", "problem", "scene_title"]


def problem(lesson: Lesson) -> Document:
    """The problem sheet of a lesson."""
    language = lesson.language
    layers = parts(lesson.sheet, "mechanism", lesson.letters, language)
    figure = Picture(mechanism_picture(lesson.sheet, layers, lesson.letters, language))
    words = (*given(lesson), Paragraph(_joined(said("solve here", language), said("print true", language)), small=True))
    blocks: list[Block] = [
        Heading(scene_title(lesson), 1),
        Fields((said("name of student", language), said("class of student", language), said("date", language))),
    ]
    if figure.drawing.width <= NARROW:
        blocks.append(Beside(words, figure))
    else:
        blocks += [*words, figure]
    for diagram in ("velocity", "acceleration"):
        equations = [e for e in lesson.sheet.equations if e.diagram == diagram]
        if equations and lesson.sheet.vectors(diagram):
            blocks.append(Heading(said(WORDS[diagram], language), 2, fresh=True))
            blocks.append(Paragraph(said("your equations", language), small=True))
            blocks.append(Picture(blank_equations(equations, lesson.letters, language), joined=True))
            blocks.append(
                Paragraph(said("your polygon", language, f"${pole(lesson.letters.convention, diagram)}$"), small=True)
            )
            blocks.append(Picture(draw_frame(lesson.sheet, diagram, lesson.letters, language)))
    blocks.append(Heading(said("your results", language), 2))
    blocks.append(_blank_table(lesson))
    title = f"{plain_words(scene_title(lesson)[0][1])}: {word('problem sheet', languages(language)[0])}"
    return Document(title, languages(language), tuple(blocks))


def scene_title(lesson: Lesson) -> Said:
    """The title of the scene in each language of the handout."""
    spoken_in = languages(lesson.language)
    found = titles(lesson.sheet, lesson.language)
    return tuple(zip(spoken_in, found, strict=False)) if len(found) > 1 else spoken(found[0], lesson.language)


def given(lesson: Lesson) -> Iterator[Paragraph]:
    """What is given, in sentences: lengths, fixed points, guides, drivers; then what is asked, and the source."""
    scene, letters = lesson.sheet.scene, lesson.letters
    unit, metres = scene.units.length, scene.units.metres
    lengths = ", ".join(f"${name}$ = {number(value)} {unit}" for name, value in given_lengths(scene, letters))
    fixed = ", ".join(
        f"${letters.point(p)}$ ({number(z.real / metres)}, {number(z.imag / metres)}) {unit}"
        for p, z in scene.frame.points.items()
    )
    for key, text in (("lengths given", lengths), ("fixed points", fixed)):
        if text:
            yield Paragraph(_labelled(lesson, key, text))
    guides = [g for g in scene.frame.guides.values() if g.name]
    if guides:
        yield Paragraph(
            tuple(
                (each, _line("guides", "; ".join(_guide(lesson, g, each) for g in guides), each))
                for each in languages(lesson.language)
            )
        )
    yield Paragraph(_labelled(lesson, "driver", drivers(lesson.sheet, letters)))
    asked = ", ".join(f"${letters.vector(s)}$" for s in lesson.questions)
    if asked:
        yield Paragraph(_labelled(lesson, "find", asked))
    if scene.source:
        label = " ".join(word("source", each) for each in languages(lesson.language))
        yield Paragraph(spoken(f"{label}: {scene.source.replace('$', '$$')}", lesson.language), small=True)


def _guide(lesson: Lesson, guide: Guide, language: str) -> str:
    scene = lesson.sheet.scene
    name = f"${lesson.letters.guide(guide.name, scene.frame.name)}$"
    x, y = (number(part / scene.units.metres) for part in (guide.through.real, guide.through.imag))
    angle = number(math.degrees(math.atan2(guide.direction.imag, guide.direction.real)))
    return say(Phrase("guide at", (name, x, y, scene.units.length, angle)), language)


def _labelled(lesson: Lesson, key: str, text: str) -> Said:
    return tuple((each, _line(key, text, each)) for each in languages(lesson.language))


def _line(key: str, text: str, language: str) -> str:
    return word(key, language) + word("colon", language) + text + word("full stop", language)


def _joined(*several: Said) -> Said:
    """Sentences one after the other, by language."""
    by_language: dict[str, list[str]] = {}
    for one in several:
        for each, text in one:
            by_language.setdefault(each, []).append(text)
    return tuple((each, word("between sentences", each).join(parts)) for each, parts in by_language.items())


def _blank_table(lesson: Lesson) -> Table:
    heads = tuple(said(key, lesson.language) for key in ("quantity", "on paper", "value", "unit", "sense"))
    rows = tuple((f"${lesson.letters.vector(s)}$", "", "", lesson.unit(s), "") for s in lesson.questions)
    return Table(heads, rows, "lcclc", roomy=True)
