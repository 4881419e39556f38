"""The problem sheet: the mechanism to scale, what is given and asked, room to solve it with ruler and compass."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from graphkin.account.forces import given_loads
from graphkin.account.headings import FIGURE_WORDS, drivers, number, rolling_starts, titles
from graphkin.account.notation import pole
from graphkin.account.voice import whole_sentence
from graphkin.construction.sheet import Equation
from graphkin.construction.steps import DiagramName
from graphkin.drawing.box import Box
from graphkin.drawing.parts.given_shapes import given_shapes
from graphkin.drawing.tables import given_lengths, given_teeth
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers.blocks import (
    Beside,
    Block,
    Document,
    Fields,
    Heading,
    Paragraph,
    Picture,
    Said,
    TableBlock,
    Together,
    said,
    sentences,
    spoken,
)
from graphkin.papers.lesson import Lesson, plain_words
from graphkin.papers.paper import A4, Paper, paper_of
from graphkin.papers.pictures import (
    LEAST_FRAME,
    POLYGONS,
    Layers,
    blank_equations,
    blank_sums,
    draw_frame,
    equation_picture,
    force_space,
    mechanism_picture,
    parts,
    shared_workspace,
    workspace,
)
from graphkin.plane import added_up
from graphkin.scene.model import Mechanism, PlacedGuide
from graphkin.words import Phrase, languages, say, word
from graphkin.words.written import in_markup

__all__ = ["equation_words", "given", "labelled", "paper_title", "problem", "reach", "scene_title"]

BOUND = "\u00a0"  # between a number and its unit no line ends
RPM = 30.0 / math.pi


def problem(lesson: Lesson) -> Document:
    """The problem sheet of a lesson."""
    language, paper = lesson.language, paper_of(lesson.sheet.scene)
    layers = parts(lesson.sheet, "mechanism", lesson.letters, language)
    figure = Picture(mechanism_picture(lesson.sheet, layers, lesson.letters, language))
    how = sentences(*(said(key, language) for key in ("solve here", "print true", "sense words")))
    words = (*given(lesson), Paragraph(how, small=True))
    blocks: list[Block] = [
        Heading(scene_title(lesson), 1),
        Fields((said("name of student", language), said("class of student", language), said("date", language))),
    ]
    spaces = [(d, _workspace(lesson, d, layers, paper)) for d in POLYGONS if lesson.sheet.vectors(d)]
    wide = any(space is None for _, space in spaces)
    if wide:
        paper = paper.facing  # two facing pages of the smaller paper; the mechanism stands on each with a pole
        spaces = [(d, _workspace(lesson, d, layers, paper)) for d, _ in spaces]
    shown = all(space is not None for _, space in spaces) and bool(spaces)
    tall = HEAD + LINE * (len(words) + 1) + figure.drawing.height + ROW * (len(lesson.questions) + 2)
    if wide and spaces:
        blocks += words
    elif shown and figure.drawing.width > paper.narrow and tall > paper.body.height:
        blocks += words  # the mechanism stands on the pages of the polygons
    elif figure.drawing.width <= paper.narrow:
        blocks.append(Beside(words, figure))
    else:
        blocks += [*words, figure]
    blocks.append(Together((Heading(said("your results", language), 2), _blank_table(lesson))))
    both = _shared_workspace(lesson, layers, paper) if wide else None
    before, after = _polygon_pages(lesson, layers, paper, both)
    sums = Paragraph(said("your sums", language), small=True, fills=True)
    blocks += [*before, sums, *after, *_forces(lesson, layers, paper)]
    return Document(paper_title(lesson, "problem sheet"), languages(language), tuple(blocks), paper, _folded(paper))


def _folded(paper: Paper) -> bool:
    """Whether a page is as two smaller ones beside each other."""
    return paper.width > paper.height


def _polygon_pages(
    lesson: Lesson, layers: Layers, paper: Paper, both: Drawing | None
) -> tuple[list[Block], list[Block]]:
    """The equations that stand before the sums, and a page for each polygon, or one for both."""
    language = lesson.language
    drawn = [d for d in POLYGONS if any(e.diagram == d for e in lesson.sheet.equations)]
    names = {d: said(FIGURE_WORDS[d], language) for d in drawn}
    room = paper.body.width / 2 - ROOM_BETWEEN if _folded(paper) else paper.body.width
    asked = {d: _equations(lesson, d, min(room, A4.body.width)) for d in drawn}
    frames = {}
    for d in drawn if both is None else ():
        high = added_up(block.drawing.height + 3.0 for block in asked[d] if isinstance(block, Picture))
        frames[d] = _workspace(lesson, d, layers, paper, high + ROOM_BETWEEN)
    beside = both is None and all(frames.values())
    before: list[Block] = [Together((Heading(names[d]), *asked[d])) for d in drawn if asked[d] and not beside]
    if both is not None:
        told = tuple(
            (each, word("list comma", each).join(dict(name)[each] for name in names.values()))
            for each in languages(language)
        )
        return before, [Heading(told, fresh=True), Together((_poles(lesson, drawn), Picture(both)))]
    after: list[Block] = []
    for d in drawn:
        space = frames[d] if beside else _workspace(lesson, d, layers, paper)
        frame = space or draw_frame(lesson.sheet, d, lesson.letters, language)
        equations = asked[d] if beside else ()
        after += [Heading(names[d], fresh=True), *equations, Together((_poles(lesson, [d]), Picture(frame)))]
    return before, after


def _poles(lesson: Lesson, diagrams: Sequence[DiagramName]) -> Paragraph:
    """From which poles polygons are to be drawn."""
    names = word("list comma", languages(lesson.language)[0]).join(
        f"${pole(lesson.letters.convention, diagram)}$" for diagram in diagrams
    )
    return Paragraph(said("your polygon", lesson.language, names), small=True)


def _equations(lesson: Lesson, diagram: DiagramName, width: float) -> tuple[Paragraph | Picture, ...]:
    """What a sheet gives of the equations: blanks; at the level "easy" the equations, at "hard" nothing."""
    equations = [e for e in lesson.sheet.equations if e.diagram == diagram]
    language, vary = lesson.language, lesson.sheet.scene.question.vary
    level = vary.level if vary is not None else "usual"
    if level == "hard":
        return ()
    if level == "easy":
        return tuple(
            Picture(equation_picture(lesson.sheet, e, lesson.letters, language, equation_words(lesson, e)))
            for e in equations
        )
    blank = blank_equations(equations, lesson.letters, language, width)
    return Paragraph(said("your equations", language), small=True), Picture(blank)


def equation_words(lesson: Lesson, equation: Equation) -> str:
    """An equation on one line: ``v_B3 = v_B2 + v_B3B2``."""
    sides = (" + ".join(plain_words(f"${lesson.letters.vector(t.symbol)}$") for t in side) for side in equation.sides)
    return " = ".join(sides)


HEAD = 22.0  # mm for a heading and the lines under it
LINE, ROW = 6.0, 7.0  # mm of a line of words, and of a row to fill in
ROOM_BETWEEN = 8.0  # mm around what stands on a page


def _workspace(
    lesson: Lesson, diagram: DiagramName, layers: Layers, paper: Paper, above: float = 0.0
) -> Drawing | None:
    """Mechanism and pole together below the heading of a page, and so many mm of equations above them."""
    body = paper.body
    page = Box(0.0, 0.0, body.width, body.height - HEAD - above)
    return workspace(lesson.sheet, diagram, layers, lesson.letters, lesson.language, page)


def _shared_workspace(lesson: Lesson, layers: Layers, paper: Paper) -> Drawing | None:
    """Mechanism and both poles on one page below its heading."""
    page = Box(0.0, 0.0, paper.body.width, paper.body.height - HEAD)
    return shared_workspace(lesson.sheet, layers, lesson.letters, lesson.language, page)


def _forces(lesson: Lesson, layers: Layers, paper: Paper) -> Iterator[Block]:
    """The equations of the groups cut free, and room for their polygons beside the mechanism, from which directions and
    arms are taken; the equations go before where a page does not hold both."""
    sheet, forces, language = lesson.sheet, lesson.forces, lesson.language
    if forces is None:
        return
    scaled = replace(sheet, scales=replace(sheet.scales, force=forces.per_mm))
    heading = said("forces", language)
    counts = [len(g.polygon) for g in forces.states[0].groups if g.way != "drawn system" and len(g.polygon) > 1]
    asked: tuple[Paragraph | Picture, ...] = ()
    if counts and (sheet.scene.question.vary is None or sheet.scene.question.vary.level != "hard"):
        blank = blank_sums(counts, lesson.letters, language, min(paper.body.width, A4.body.width))
        asked = (Paragraph(said("your force equations", language), small=True), Picture(blank))
    high = added_up(block.drawing.height + 3.0 for block in asked if isinstance(block, Picture))
    page = Box(0.0, 0.0, paper.body.width, paper.body.height - HEAD - ROOM_BETWEEN)
    beside = page.height - high >= LEAST_FRAME
    if not beside:
        yield Together((Heading(heading, 2), *asked))
    room = Box(0.0, 0.0, page.width, page.height - (high if beside else 0.0))
    yield Heading(heading, 2, fresh=True)
    yield from asked if beside else ()
    drawn = force_space(scaled, layers, lesson.letters, language, room)
    yield Together((Paragraph(said("your forces", language), small=True), Picture(drawn)))


def paper_title(lesson: Lesson, key: str) -> str:
    """The title of one of the papers, in the first language: that of the scene, and which paper it is."""
    first = languages(lesson.language)[0]
    return plain_words(scene_title(lesson)[0][1]) + word("colon", first) + word(key, first)


def scene_title(lesson: Lesson) -> Said:
    """The title of the scene in each language of the handout."""
    spoken_in = languages(lesson.language)
    found = titles(lesson.sheet, lesson.language)
    return tuple(zip(spoken_in, found, strict=False)) if len(found) > 1 else spoken(found[0], lesson.language)


def given(lesson: Lesson) -> Iterator[Paragraph]:
    """What is given, in sentences: lengths, fixed points, guides, drivers; then what is asked, and the source."""
    scene, letters = lesson.sheet.scene, lesson.letters
    unit, metres = scene.units.length, scene.units.metres
    lengths = [f"${name}$ = {value}{BOUND}{unit}" for name, value in given_lengths(scene, letters)]
    fixed = [
        f"${letters.point(p)}$ ({number(z.real / metres)}, {number(z.imag / metres)}){BOUND}{unit}"
        for p, z in scene.frame.points.items()
    ]
    for key, items in (("lengths given", [*lengths, *given_teeth(scene, lesson.language)]), ("fixed points", fixed)):
        if items:
            yield Paragraph(_labelled(lesson, key, items, "list comma"))
    guides = [g for g in scene.frame.guides.values() if g.name]
    if guides:
        yield Paragraph(
            tuple(
                (each, labelled("guides", "; ".join(_guide(lesson, g, each) for g in guides), each))
                for each in languages(lesson.language)
            )
        )
    shapes = {each: given_shapes(scene, letters, each) for each in languages(lesson.language)}
    if any(shapes.values()):
        told = ((each, labelled("links given", "; ".join(said), each)) for each, said in shapes.items())
        yield Paragraph(tuple(told))
    moving = [*drivers(lesson.sheet, letters).split(",  "), *_speeds(scene)]
    yield Paragraph(_labelled(lesson, "driver", moving, "list comma"))
    for sense in _senses(scene):
        yield Paragraph(tuple((each, lesson.account.sentence(sense, each)) for each in languages(lesson.language)))
    if starts := rolling_starts(lesson.sheet):
        yield Paragraph(_labelled(lesson, "rolling starts", starts, "list comma"))
    if scene.loading:
        for load in given_loads(lesson.sheet, letters):
            yield Paragraph(tuple((each, whole_sentence(say(load, each), each)) for each in languages(lesson.language)))
    asked = [f"${letters.vector(s)}$" for s in lesson.questions]
    if asked:
        yield Paragraph(_labelled(lesson, "find", asked, "symbol comma"))
    yield from reach(lesson)
    names = languages(lesson.language)
    own = {each: in_markup(scene.question.source_in(each)) for each in names}
    if len(set(own.values())) > 1:
        told = ((each, word("source", each) + word("colon", each) + text) for each, text in own.items() if text)
        yield Paragraph(tuple(told), small=True)
    elif own[names[0]]:
        label = " ".join(word("source", each) for each in names) + word("colon", names[-1])
        yield Paragraph(spoken(label + own[names[0]], lesson.language), small=True)


def _guide(lesson: Lesson, guide: PlacedGuide, language: str) -> str:
    scene = lesson.sheet.scene
    name = f"${lesson.letters.guide(guide.name, scene.frame.name)}$"
    x, y = (number(part / scene.units.metres) for part in (guide.through.real, guide.through.imag))
    angle = number(math.degrees(math.atan2(guide.direction.imag, guide.direction.real)))
    key = {"0": "guide level", "90": "guide upright"}.get(angle, "guide at")
    return say(Phrase(key, (name, x, y, scene.units.length, angle)), language)


def reach(lesson: Lesson) -> Iterator[Paragraph]:
    """That only a part of the mechanism is on the paper, where nothing asked for needs the rest."""
    for phrase in lesson.sheet.left_out:
        yield Paragraph(tuple((each, lesson.account.sentence(phrase, each)) for each in languages(lesson.language)))


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


def _labelled(lesson: Lesson, key: str, items: Sequence[str], between: str) -> Said:
    """Formulas with their label; on papers of two languages once, with both labels."""
    names = languages(lesson.language)
    text = word(between, names[0]).join(items)
    if len(names) == 1:
        return ((names[0], labelled(key, text, names[0])),)
    label = " ".join(word(key, each) for each in names) + word("colon", names[0])
    return spoken(label + " " * (not label.endswith(" ")) + text + word("full stop", names[0]), lesson.language)


def labelled(key: str, text: str, language: str) -> str:
    """A text behind a word of the table and a colon, as a sentence."""
    return word(key, language) + word("colon", language) + text + word("full stop", language)


def _blank_table(lesson: Lesson) -> TableBlock:
    heads = tuple(said(key, lesson.language) for key in ("quantity", "on paper", "value", "unit", "sense"))
    rows = tuple(
        (f"${lesson.letters.vector(s)}$", "" if s.is_vector or s.measure == "length" else "–", "", lesson.unit(s), "")
        for s in lesson.questions
    )
    return TableBlock(heads, rows, "lcclc", roomy=True)
