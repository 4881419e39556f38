"""The problem sheet: the mechanism to scale, what is given and asked, room to solve it with ruler and compass."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from graphkin.account.forces import given_loads
from graphkin.account.headings import FIGURE_WORDS, drivers, number, rolling_starts, titles
from graphkin.account.notation import pole
from graphkin.account.voice import whole_sentence
from graphkin.construction.steps import DiagramName
from graphkin.drawing.box import Box
from graphkin.drawing.parts.given_shapes import given_shapes
from graphkin.drawing.tables import given_lengths, given_teeth
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers import blocks
from graphkin.papers.blocks import Heading, Paragraph, Picture, Said, Together, in_each, said, sentences, spoken
from graphkin.papers.lesson import Lesson, plain_words
from graphkin.papers.paper import A4, Paper, paper_of
from graphkin.papers.pictures import (
    LEAST_FRAME,
    POLYGONS,
    blank_equations,
    blank_sums,
    draw_frame,
    equation_picture,
    force_space,
    mechanism_picture,
    workspace,
)
from graphkin.plane import added_up
from graphkin.scene.model import Mechanism
from graphkin.words import Phrase, languages, say, word
from graphkin.words.written import in_markup

__all__ = ["given", "labelled", "paper_title", "problem", "reach", "scene_title"]

BOUND = "\u00a0"  # between a number and its unit no line ends
RPM = 30.0 / math.pi
HEAD = 22.0  # mm for a heading and the lines under it
LINE, ROW = 6.0, 7.0  # mm of a line of words, and of a row to fill in
ROOM_BETWEEN = 8.0  # mm around what stands on a page


def problem(lesson: Lesson) -> blocks.Document:
    """The problem sheet of a lesson."""
    language, paper = lesson.language, paper_of(lesson.sheet.scene)
    bare = mechanism_picture(lesson)
    how = sentences(*(said(key, language) for key in ("solve here", "print true", "sense words")))
    words = (*given(lesson), Paragraph(how, small=True))
    moving = [d for d in POLYGONS if lesson.sheet.vectors(d)]
    shown = all(_space(lesson, bare, [d], paper) for d in moving)
    wide = not shown
    if wide:
        paper = paper.facing  # two facing pages of the smaller paper; the mechanism stands on each with a pole
        shown = all(_space(lesson, bare, [d], paper) for d in moving)
    tall = HEAD + LINE * (len(words) + 1) + bare.height + ROW * (len(lesson.questions) + 2)
    on_polygons = shown and bool(moving) and bare.width > paper.narrow and tall > paper.body.height
    first: tuple[blocks.Block, ...] = (*words, Picture(bare))
    if wide or on_polygons:
        first = words  # the mechanism stands on the pages of the polygons
    elif bare.width <= paper.narrow:
        first = (blocks.Beside(words, Picture(bare)),)
    heads = tuple(said(key, language) for key in ("quantity", "on paper", "value", "unit", "sense"))
    rows = tuple(
        (f"${lesson.letters.vector(s)}$", "" if s.is_vector or s.measure == "length" else "–", "", lesson.unit(s), "")
        for s in lesson.questions
    )
    both = _space(lesson, bare, POLYGONS, paper) if wide and len(moving) == len(POLYGONS) else None
    before, after = _polygon_pages(lesson, bare, paper, both)
    whole: tuple[blocks.Block, ...] = (
        Heading(scene_title(lesson), 1),
        blocks.Fields(tuple(said(key, language) for key in ("name of student", "class of student", "date"))),
        *first,
        Together((Heading(said("your results", language)), blocks.TableBlock(heads, rows, "lcclc", roomy=True))),
        *before,
        Paragraph(said("your sums", language), small=True, fills=True),
        *after,
        *_forces(lesson, bare, paper),
    )
    return blocks.Document(paper_title(lesson, "problem sheet"), languages(language), whole, paper, paper.folded)


def _space(
    lesson: Lesson, bare: Drawing, diagrams: Sequence[DiagramName], paper: Paper, above: float = 0.0
) -> Drawing | None:
    """Mechanism and poles together below the heading of a page, and so many mm of equations above them."""
    return workspace(lesson, bare, diagrams, Box(0.0, 0.0, paper.body.width, paper.body.height - HEAD - above))


def _polygon_pages(
    lesson: Lesson, bare: Drawing, paper: Paper, both: Drawing | None
) -> tuple[list[blocks.Block], list[blocks.Block]]:
    """The equations that stand before the sums, and a page for each polygon, or one for both."""
    drawn = [d for d in POLYGONS if any(e.diagram == d for e in lesson.sheet.equations)]
    names = {d: said(FIGURE_WORDS[d], lesson.language) for d in drawn}
    room = paper.body.width / 2 - ROOM_BETWEEN if paper.folded else paper.body.width
    asked = {d: _equations(lesson, d, min(room, A4.body.width)) for d in drawn}
    frames = {d: _space(lesson, bare, [d], paper, _height(asked[d]) + ROOM_BETWEEN) for d in drawn if both is None}
    beside = both is None and all(frames.values())
    before: list[blocks.Block] = [Together((Heading(names[d]), *asked[d])) for d in drawn if asked[d] and not beside]
    if both is not None:
        told = in_each(
            lesson.language, lambda each: word("list comma", each).join(dict(name)[each] for name in names.values())
        )
        return before, [Heading(told, fresh=True), Together((_poles(lesson, drawn), Picture(both)))]
    after: list[blocks.Block] = []
    for d in drawn:
        frame = (frames[d] if beside else _space(lesson, bare, [d], paper)) or draw_frame(lesson, d)
        equations = asked[d] if beside else ()
        after += [Heading(names[d], fresh=True), *equations, Together((_poles(lesson, [d]), Picture(frame)))]
    return before, after


def _poles(lesson: Lesson, diagrams: Sequence[DiagramName]) -> Paragraph:
    """From which poles polygons are to be drawn."""
    poles = [f"${pole(lesson.letters.convention, diagram)}$" for diagram in diagrams]
    names = word("list comma", languages(lesson.language)[0]).join(poles)
    return Paragraph(said("your polygon", lesson.language, names), small=True)


def _equations(lesson: Lesson, diagram: DiagramName, width: float) -> tuple[Paragraph | Picture, ...]:
    """What a sheet gives of the equations: blanks; at the level "easy" the equations, at "hard" nothing."""
    equations = [e for e in lesson.sheet.equations if e.diagram == diagram]
    if lesson.level == "hard":
        return ()
    if lesson.level == "easy":
        return tuple(Picture(equation_picture(lesson, e)) for e in equations)
    blank = blank_equations(lesson, equations, width)
    return Paragraph(said("your equations", lesson.language), small=True), Picture(blank)


def _height(asked: Sequence[Paragraph | Picture]) -> float:
    """The height of what a sheet gives of equations (mm)."""
    return added_up(block.drawing.height + 3.0 for block in asked if isinstance(block, Picture))


def _forces(lesson: Lesson, bare: Drawing, paper: Paper) -> Iterator[blocks.Block]:
    """The equations of the groups cut free, and room for their polygons beside the mechanism, from which directions and
    arms are taken; the equations go before where a page does not hold both."""
    forces, language = lesson.forces, lesson.language
    if forces is None:
        return
    heading = said("forces", language)
    counts = [len(g.polygon) for g in forces.states[0].groups if g.way != "drawn system" and len(g.polygon) > 1]
    asked: tuple[Paragraph | Picture, ...] = ()
    if counts and lesson.level != "hard":
        blank = blank_sums(lesson, counts, min(paper.body.width, A4.body.width))
        asked = (Paragraph(said("your force equations", language), small=True), Picture(blank))
    page = Box(0.0, 0.0, paper.body.width, paper.body.height - HEAD - ROOM_BETWEEN)
    beside = page.height - _height(asked) >= LEAST_FRAME
    if not beside:
        yield Together((Heading(heading), *asked))
    room = Box(0.0, 0.0, page.width, page.height - (_height(asked) if beside else 0.0))
    yield Heading(heading, fresh=True)
    yield from asked if beside else ()
    drawn = force_space(lesson, bare, room)
    yield Together((Paragraph(said("your forces", language), small=True), Picture(drawn)))


def paper_title(lesson: Lesson, key: str) -> str:
    """The title of one of the papers, in the first language: that of the scene, and which paper it is."""
    first = languages(lesson.language)[0]
    return plain_words(scene_title(lesson)[0][1]) + word("colon", first) + word(key, first)


def scene_title(lesson: Lesson) -> Said:
    """The title of the scene in each language of the handout."""
    found = titles(lesson.sheet, lesson.language)
    both = tuple(zip(languages(lesson.language), found, strict=False))
    return both if len(found) > 1 else spoken(found[0], lesson.language)


# -- what is given -----------------------------------------------------------------------------------------------------


def given(lesson: Lesson) -> Iterator[Paragraph]:
    """What is given, in sentences: lengths, fixed points, guides, drivers; then what is asked, and the source."""
    scene, letters, language = lesson.sheet.scene, lesson.letters, lesson.language
    unit, metres = scene.units.length, scene.units.metres
    lengths = [f"${name}$ = {value}{BOUND}{unit}" for name, value in given_lengths(scene, letters)]
    fixed = [
        f"${letters.point(p)}$ ({number(z.real / metres)}, {number(z.imag / metres)}){BOUND}{unit}"
        for p, z in scene.frame.points.items()
    ]
    yield from _formulas(lesson, "lengths given", [*lengths, *given_teeth(scene, language)])
    yield from _formulas(lesson, "fixed points", fixed)
    yield from _clauses(lesson, "guides", {each: _guides(lesson, each) for each in languages(language)})
    shapes = {each: given_shapes(scene, letters, each) for each in languages(language)}
    yield from _clauses(lesson, "links given", shapes)
    yield from _formulas(lesson, "driver", [*drivers(lesson.sheet, letters).split(",  "), *_speeds(scene)])
    for sense in _senses(scene):
        yield Paragraph(lesson.sentence(sense))
    yield from _formulas(lesson, "rolling starts", rolling_starts(lesson.sheet))
    for load in given_loads(lesson.sheet, letters) if scene.loading else ():
        yield Paragraph(tuple((each, whole_sentence(say(load, each), each)) for each in languages(language)))
    yield from _formulas(lesson, "find", [f"${letters.vector(s)}$" for s in lesson.questions], "symbol comma")
    yield from reach(lesson)
    names = languages(language)
    own = {each: in_markup(scene.question.source_in(each)) for each in names}
    if len(set(own.values())) > 1:
        told = ((each, word("source", each) + word("colon", each) + text) for each, text in own.items() if text)
        yield Paragraph(tuple(told), small=True)
    elif own[names[0]]:
        label = " ".join(word("source", each) for each in names) + word("colon", names[-1])
        yield Paragraph(spoken(label + own[names[0]], language), small=True)


def _guides(lesson: Lesson, language: str) -> list[str]:
    """Each guide of the frame that has a name, by a point of it and its direction."""
    scene, told = lesson.sheet.scene, []
    for guide in scene.frame.guides.values():
        name = f"${lesson.letters.guide(guide.name, scene.frame.name)}$"
        x, y = (number(part / scene.units.metres) for part in (guide.through.real, guide.through.imag))
        angle = number(math.degrees(math.atan2(guide.direction.imag, guide.direction.real)))
        key = {"0": "guide level", "90": "guide upright"}.get(angle, "guide at")
        if guide.name:
            told.append(say(Phrase(key, (name, x, y, scene.units.length, angle)), language))
    return told


def reach(lesson: Lesson) -> Iterator[Paragraph]:
    """That only a part of the mechanism is on the paper, where nothing asked for needs the rest."""
    return (Paragraph(lesson.sentence(phrase)) for phrase in lesson.sheet.left_out)


def _speeds(scene: Mechanism) -> Iterator[str]:
    """Speeds of drivers in r/min, where these are the round ones."""
    for driver in scene.drivers:
        if driver.turns and driver.rate and driver.rpm is None:  # a given one stands there already
            rpm = float(f"{driver.rate * RPM:.9g}")
            if len(number(rpm)) < len(number(driver.rate)):
                yield f"$n_{{{driver.link}}}$ = {number(rpm)}{BOUND}r/min"


def _senses(scene: Mechanism) -> Iterator[Phrase]:
    """Which way drivers turn, and whether that is ever faster."""
    for driver in scene.drivers:
        if driver.turns and driver.rate:
            sense = "clockwise" if driver.rate < 0 else "counter-clockwise"
            on = "" if driver.relative_to == scene.frame.name else Phrase("seen from link", (driver.relative_to,))
            even = "" if driver.law is not None else Phrase("at constant speed")
            faster = Phrase("ever faster" if driver.second * driver.rate > 0 else "ever slower")
            yield Phrase(f"driver turns {sense}", (driver.link, on, faster if driver.second else even))


def _formulas(lesson: Lesson, key: str, items: Sequence[str], between: str = "list comma") -> Iterator[Paragraph]:
    """Formulas, where there are some, with their label; on papers of two languages once, with both labels."""
    first, *others = languages(lesson.language)
    text = word(between, first).join(items)
    if items and not others:
        yield Paragraph(((first, labelled(key, text, first)),))
    elif items:
        label = " ".join(word(key, each) for each in (first, *others)) + word("colon", first)
        whole = label + " " * (not label.endswith(" ")) + text + word("full stop", first)
        yield Paragraph(spoken(whole, lesson.language))


def _clauses(lesson: Lesson, key: str, told: dict[str, list[str]]) -> Iterator[Paragraph]:
    """Clauses in each language, where there are some, with their label."""
    if any(told.values()):
        yield Paragraph(in_each(lesson.language, lambda each: labelled(key, "; ".join(told[each]), each)))


def labelled(key: str, text: str, language: str) -> str:
    """A text behind a word of the table and a colon, as a sentence."""
    return word(key, language) + word("colon", language) + text + word("full stop", language)
