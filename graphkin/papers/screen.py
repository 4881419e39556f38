"""The worked solution as a page to step through: the figures and steps of every position of the driver, drawn in the
same frames, every part with its step; the results of each step, for readers who try it first; and the mechanism in
motion, as plain numbers over the driver's range.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import reduce
from itertools import combinations, zip_longest
from typing import Literal, TypeAlias

import numpy as np
from markupsafe import Markup

from graphkin.account.forces import ForceStage, InForces
from graphkin.account.given import drivers
from graphkin.account.headings import FIGURE_WORDS, number, term
from graphkin.account.notation import Notation, scale_statement
from graphkin.account.spoken import spoken_words
from graphkin.account.voice import capital, whole_sentence
from graphkin.checking.report import COVERAGE
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import DiagramName, Step
from graphkin.drawing.box import Box
from graphkin.drawing.figures.centres import background, centre_marks, near_box
from graphkin.drawing.figures.constructions import cam_pictures, scaled_cam
from graphkin.drawing.figures.forces import group_equation, group_picture, lever_figure
from graphkin.drawing.figures.train import PLAN_WORDS, train_pages
from graphkin.drawing.ink.primitives import Primitive, on_page
from graphkin.drawing.parts.insets import polygon_with_insets, strip_height
from graphkin.drawing.parts.mechanism import mechanism_piece
from graphkin.drawing.parts.polygon import extent
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups, moved_piece
from graphkin.drawing.stepwise import stepped, unstepped
from graphkin.drawing.write.drawing import Drawing
from graphkin.drawing.write.svg import svg_element
from graphkin.files import Json
from graphkin.jobs import Progress
from graphkin.papers.blocks import Block, Heading, Said, StepItem, sentences
from graphkin.papers.documents import (
    force_stages_of,
    results_blocks,
    scene_title,
    solution,
    stage_title,
    step_items,
    task_with_source,
    way,
)
from graphkin.papers.html import blocks_html, rendered, said_html, whole_page, words_html
from graphkin.papers.lesson import MECHANISM, Lesson, rows_in_order
from graphkin.papers.pictures import POLYGONS, ROOM, bare_picture, equation_picture
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import Motion, solve
from graphkin.solver.algebra.pose import Array
from graphkin.solver.quantities import pole
from graphkin.words import bodies_named, gaps_of, word
from graphkin.words.symbols import sign

WIDE = 96.0  # mm of the sketch of a group, its polygon below
LISTED = ("figures", "steps")
LEAST, MOST = 0.01, 0.08  # parts of a value: what is taken for right at least, and at most
FRAMES = 72  # positions of the mechanism in motion
FAR = 3.0  # mechanisms: a centre that lies farther away is not shown

FigureName: TypeAlias = Literal["mechanism", "velocity", "acceleration", "centres", "force"]
Figure: TypeAlias = dict[str, str]
"""A figure of the page: its name, its drawing as SVG, its caption as HTML."""


def handout_page(
    lesson: Lesson,
    views: Sequence[Lesson],
    start: int,
    progress: Progress | None,
    moving: Mapping[str, object],
    worked: Iterable[Block],
) -> str:
    """The worked solution as a page to step through.

    Parameters
    ----------
    lesson : the solution on paper, for printing
    views : a lesson for each position of the driver on the screen
    start : the index of the given position
    progress : called with the number of finished positions and of all
    moving : the motion that the page plays (`motion_data`)
    worked : the stages of the solution (`solution_blocks`)
    """
    stages = tuple(worked)
    whole, first = solution(lesson, stages), lesson.first
    paper = lesson.sheet.scene.question.sheet.paper
    data = {
        **positions_data(views, progress),
        "start": start,
        "moving": moving,
        "room": _tolerances(lesson),
        "words": {  # sentences whose gaps the page fills by their names
            name: _side_by_side(lesson.said(key, **{gap: f"{{{gap}}}" for gap in gaps_of(key)}))
            for name, key in SPOKEN.items()
        },
    }
    shown = lesson.said("positions words" if len(views) > 1 else "position words", count=len(views))
    body = rendered(
        "handout.html",
        title=scene_title(lesson),
        given=Markup(blocks_html(task_with_source(lesson), first)),
        paper=Markup(blocks_html((Heading(scene_title(lesson), 2), *stages), first)),
        results=Markup(blocks_html(results_blocks(lesson), first)),
        hint=sentences(lesson.said("keys"), shown, lesson.said("print hint", paper=paper)),
        buttons=BUTTONS,
        say=lambda key: Markup(said_html(lesson.said(key))),
        plain=lambda key: _side_by_side(lesson.said(key)),
    )
    return whole_page(whole, body, "viewer.js", data)


BUTTONS = (
    ("first", "|◀", "first step"), ("previous", "◀", "previous step"), ("next", "▶", "next step"),
    ("last", "▶|", "last step"), ("equation", "▶▶", "next equation"),
)
SPOKEN = {
    "stepOf": "step of", "right": "trial right", "off": "trial off", "turned": "trial turned", "enter": "trial enter",
    "hint1": "hint equation", "hint2": "hint direction", "hint3": "hint size", "play": "play", "pause": "pause",
    "ccw": "counter-clockwise", "cw": "clockwise", "hidden": "step hidden", "velocity": "velocity polygon",
    "acceleration": "acceleration polygon", "mechanism": "mechanism", "figure": "figure numbered",
}
"""What the page itself says, by the names of its script: keys of the table."""


def _side_by_side(words: Said) -> str:
    return " / ".join(str(text) for _, text in words)


def positions_data(views: Sequence[Lesson], progress: Progress | None) -> dict[str, object]:
    """Names, figures and steps of the positions for the page, and the stages of all of them, each once.

    Values are grouped by key over all positions, those of figures and steps row by row (None where a position has
    fewer): packed so, they take two thirds of the space.

    Parameters
    ---------
    views : a lesson for each position, with its instant centres if they exist
    progress : called with the number of positions done and the number of all
    """
    pieces = [mechanism_piece(v.sheet, v.letters, (MECHANISM[0] + 20, MECHANISM[1] + 20)) for v in views]
    frames, cams = _frames(views, pieces), [*_cams(views[0])]
    stages: list[dict[str, str]] = []  # most of them are the same in every position
    positions = []
    for done, (view, (piece, _)) in enumerate(zip(views, pieces, strict=True), 1):
        position, sections = _position(view, piece, frames, cams)
        for stage in sections:
            if stage not in stages:
                stages.append(stage)
        positions.append(position | {"stages": [stages.index(stage) for stage in sections]})
        if progress is not None:
            progress(done, len(views))
    columns: dict[str, list[object]] = {key: [row[key] for row in positions] for key in positions[0]}
    for key in LISTED:
        columns[key] = [list(row) for row in zip_longest(*columns[key])]  # type: ignore[call-overload]
    return {"positions": columns, "stages": stages}


Frames: TypeAlias = Mapping["FigureName", tuple[Box, float]]
"""The frames (mm) that hold the figures of all positions, equally large, and the height of the strip below them; the
fixed pivots are always at their places, a polygon has its middle at nought."""


def _frames(views: Sequence[Lesson], pieces: Sequence[tuple[Piece, Box]]) -> Frames:
    frames: dict[FigureName, tuple[Box, float]] = {}
    frames["mechanism"] = reduce(Box.joined, (box for _, box in pieces)).grown(ROOM), 0.0
    for diagram in POLYGONS:
        boxes = [extent(view.sheet, diagram).grown(ROOM) for view in views]
        size = complex(max(max(b.width for b in boxes), 70.0), max(b.height for b in boxes))
        low = max(strip_height(view.sheet, diagram, size.real) for view in views)
        frames[diagram] = Box.around((-size / 2, size / 2)), low
    near = [
        near_box(view.centres, ink_box(background(piece).drawn) or box, MECHANISM)
        for view, (piece, box) in zip(views, pieces, strict=True) if view.centres is not None
    ]
    return frames | ({"centres": (reduce(Box.joined, near).grown(ROOM), 0.0)} if near else {})


StageTold: TypeAlias = tuple[dict[str, str], str, Sequence[tuple[StepItem, dict[str, Json]]]]
"""A stage with its title and equation (HTML, SVG), the name of its figure, and its steps with what each finds."""


def _position(
    lesson: Lesson, piece: Piece, frames: Frames, cams: Sequence[Figure]
) -> tuple[dict[str, object], list[dict[str, str]]]:
    """A position for the page, and its stages."""
    first = lesson.first
    name = drivers(lesson.sheet, lesson.letters)
    figures = [*_figures(lesson, piece, frames), *_plans(lesson)]
    plans = {figure["name"].removeprefix("plan-") for figure in figures if figure["name"].startswith("plan-")}
    stages, steps = list[dict[str, str]](), list[dict[str, object]]()
    for count, (stage, figure, items) in enumerate((*_motion(lesson, plans), *_forces(lesson, figures))):
        stages.append(stage)
        for item, finds in items:
            work = "".join(f'<p class="work">{words_html(line, first)}</p>' for line in item.work)
            aloud = " ".join(spoken_words(text, each) for each, text in item.words)
            words = {"n": item.number, "html": said_html(item.words, "p") + work, "text": aloud}
            steps.append({"d": figure, "e": count, **words, **finds})
    driver = lesson.sheet.scene.drivers[0]
    at = lesson.sheet.scene.unit_of(driver).of(lesson.sheet.drivers[driver.key])
    return {
        "name": str(name),
        "label": words_html(name, first),
        "at": round(float(at), 3),
        "figures": [*figures, *cams],
        "stages": [],
        "results": blocks_html(results_blocks(lesson), first) if lesson.report.rows else "",
        "given": blocks_html(task_with_source(lesson), first),
        "steps": steps,
    }, stages


def _motion(lesson: Lesson, plans: Container[str]) -> Iterator[StageTold]:
    """The stages of the position and of the polygons; steps on a velocity plan show its figure, if there is one."""

    def finds(step: Step) -> dict[str, Json]:
        shown: dict[str, Json] = {"d": f"plan-{step.diagram}"} if step.plan and step.diagram in plans else {}
        return shown | _found(lesson, step)

    for stage in lesson.stages:
        svg = svg_element(equation_picture(lesson, stage.equation)) if stage.equation is not None else ""
        items = zip(step_items(lesson, stage), map(finds, stage.steps), strict=True)
        yield {"title": said_html(stage_title(lesson, stage)), "svg": svg}, stage.diagram, [*items]


# figures of a position


def _figure(name: str, drawing: Drawing, caption: str, scale: str = "", named: bool = False) -> Figure:
    """A figure with its caption (HTML), and its scale after it."""
    shown = f'{caption} <span class="scale">{scale}</span>' if scale else caption
    return {"name": name, "svg": svg_element(drawing, named=named), "caption": shown}


def _figures(lesson: Lesson, piece: Piece, frames: Frames) -> Iterator[Figure]:
    """Mechanism, polygons and centres, with their description: each vector with its size and direction."""
    first, letters = lesson.first, lesson.letters
    at = drivers(lesson.sheet, letters)
    for name, drawn, panel in _drawings(lesson, piece, frames):
        is_stepped = name != "centres"
        children: tuple[Primitive, ...] = layer_groups(moved_piece(drawn, -panel.corners[0]))
        vectors = word("list semicolon", first).join(
            f"{spoken_words(letters.vector(row.symbol), first)} "
            f"{number(lesson.in_unit(row.symbol, abs(row.true)), 4)} {lesson.unit(row.symbol)}, {way(row, first)}"
            for row in lesson.results if row.symbol.is_vector and row.symbol.measure.name == name
        )
        title = term(FIGURE_WORDS[name] if name != "centres" else name, lesson.language)
        spoken = whole_sentence(spoken_words(at, first), first) + word("between sentences", first) + vectors
        shown = stepped(children) if is_stepped else children
        drawing = Drawing(panel.width, panel.height, shown, title, str(spoken), first)
        scale = scale_statement(lesson.sheet, letters.convention, name if name != "centres" else "mechanism")
        yield _figure(name, drawing, words_html(title, first), words_html(scale, first), named=is_stepped)


def _drawings(lesson: Lesson, piece: Piece, frames: Frames) -> Iterator[tuple[FigureName, Piece, Box]]:
    """Each figure by its name, and its panel (mm)."""
    sheet, letters = lesson.sheet, lesson.letters
    frame, _ = frames["mechanism"]
    yield "mechanism", with_labels(piece, frame), frame
    for diagram in POLYGONS:
        if sheet.vectors[diagram]:
            frame, low = frames[diagram]
            middle, size = extent(sheet, diagram).centre, complex(frame.width, frame.height)
            panel = Box.around((middle - size / 2, middle + size / 2))
            strip = Box(panel.left, panel.bottom, panel.right, panel.bottom + low)
            made, _ = polygon_with_insets(sheet, diagram, letters, lesson.language, panel, 0j, strip)
            yield diagram, made, panel.joined(strip)
    if lesson.centres is not None and "centres" in frames:
        frame, _ = frames["centres"]
        back = background(piece)
        marks = centre_marks(lesson.centres, letters, frame, back.drawn)
        yield "centres", with_labels(joined((back, marks)), frame), frame


def _plans(lesson: Lesson) -> Iterator[Figure]:
    """The velocity plans of rolling links, step by step."""
    for plan, page in train_pages(lesson.page("plan")).items():
        bare, order = bare_picture(page), lesson.sheet.trains[plan - 1].order
        drawn = replace(bare, children=stepped(bare.children))
        yield _figure(f"plan-{order}", drawn, _caption(lesson.said(PLAN_WORDS[order])))


def _cams(lesson: Lesson) -> Iterator[Figure]:
    """Displacement diagram and inversion of each cam drawn by its law."""
    scene, language = lesson.sheet.scene, lesson.language
    for i, cam in enumerate(scene.cams):
        pictures = cam_pictures(scene, cam, scaled_cam(scene, cam), language)
        for key, picture in zip(("cam diagram", "cam figure"), pictures, strict=True):
            drawn = replace(picture, children=unstepped(picture.children))
            yield _figure(f"{key.replace(' ', '-')}-{i}", drawn, _caption(lesson.said(key)))


def _caption(words: Said) -> str:
    return said_html(tuple((each, capital(text)) for each, text in words))


def _forces(lesson: Lesson, figures: list[Figure]) -> Iterator[StageTold]:
    """The stages of the forces, after those of the motion; their figures are added to the others."""
    sheet = lesson.sheet
    if not sheet.forces:
        return
    scale = words_html(scale_statement(sheet, lesson.letters.convention, "force"), lesson.first)
    for turn, (stage, load, items) in enumerate(force_stages_of(lesson)):
        name, svg, group = str(stage.figure), "", stage.group
        title = said_html(lesson.said(stage.title.key, **stage.title.gaps))
        if group.links:
            name, page = f"force-{turn}", lesson.page("forces", WIDE)
            drawn = group_picture(page, stage, f"-{turn}")
            whose = lesson.said("force on links", links=bodies_named(group.links))
            figures.append(_figure(name, drawn, said_html(whose), scale, named=True))
            equation = group_equation(page, group)
            svg = "" if equation is None else svg_element(equation)
        title += f" <small>{said_html(load)}</small>" if load else ""
        forces = (_force_found(lesson, stage, words) for words in stage.steps)
        yield {"title": title, "svg": svg}, name, [*zip(items, forces, strict=True)]
    lever = lever_figure(lesson.page("lever"))
    if lever is not None:
        figures.append(_figure("lever", lever, said_html(lesson.said("lever"))))


# what a step finds, to be tried first


def _find(lesson: Lesson, symbol: Symbol, value: complex | float) -> dict[str, Json]:
    """A quantity to find: symbol, name, size in its unit, and direction (degrees) or sense; none for a zero."""
    if not value:
        return {}
    size = float(f"{lesson.in_unit(symbol, abs(value)):.5g}")
    named = words_html(lesson.letters.vector(symbol), lesson.first)
    find: dict[str, Json] = {"symbol": str(symbol), "name": named, "size": size, "unit": lesson.unit(symbol)}
    if isinstance(value, complex):
        return {"find": find | {"angle": round(math.degrees(cmath.phase(value)), 1)}}
    return {"find": find | {"sense": 1 if value > 0 else -1}}


def _found(lesson: Lesson, step: Step) -> dict[str, Json]:
    """The result of a step of the motion: its measured rate, or its last vector."""
    sheet = lesson.sheet
    if step.finds_rate:
        rate, symbol = sheet.rates[step.kind].get(step.link), Symbol(step.kind, link=step.link)
        return {} if rate is None else _find(lesson, symbol, rate.value)
    vectors = [vector for vector in step.vectors if vector.span]
    if not vectors:
        return {}
    return _find(lesson, vectors[-1].symbol, vectors[-1].span * sheet.scales.of(step.diagram))


def _force_found(lesson: Lesson, stage: ForceStage, words: InForces) -> dict[str, Json]:
    """The result of a step of the forces that finds a single force or moment."""
    if len(words.step.finds) != 1:
        return {}
    (symbol,) = words.step.finds
    back = replace(symbol, link=symbol.other, other=symbol.link) if symbol.other else symbol
    for side, sense in ((symbol, 1.0), (back, -1.0)):
        value = stage.state.moments.get(side) or stage.state.vectors.get(side)
        if value:
            return _find(lesson, symbol, sense * value)
    return {}


def _tolerances(lesson: Lesson) -> dict[str, float]:
    """The relative tolerance of an answer by symbol: that of the key, within bounds."""
    parts = {}
    for row in lesson.results:
        spread = lesson.tolerance.get(row.symbol)
        size = abs(row.true)
        if spread is not None and size:
            part = COVERAGE * spread.deviation / size
            parts[str(row.symbol)] = round(min(max(part, LEAST), MOST), 4) if math.isfinite(part) else MOST
    return parts


# the mechanism in motion

Track: TypeAlias = list[float | None]
"""Coordinates of a place over the motion, [x0, y0, x1, y1, ...], to 0.01 mm."""
Place: TypeAlias = Callable[[Array], int]
"""Number of the track on which a place (mm) moves; each is kept once."""


def motion_data(
    sheet: Sheet, letters: Notation, values: Mapping[str, float] | None, count: int = FRAMES
) -> dict[str, Json]:
    """All moving points and vectors for the page, in mm on paper at the scales of the handout; the page joins places,
    it computes nothing.  Empty where the driver does not move.

    Returns
    ------
    ``at`` : values of the first driver (degrees, or travel in scene units); ``tracks`` : coordinates of each place over
    them, [x0, y0, x1, y1, ...]; ``bars`` : places joined, with the number of their link; ``lines`` : ends of guides;
    ``points``, ``centres`` : places with their names; ``fixed`` : fixed places; ``velocity``, ``acceleration`` :
    vectors as pairs of places and names of ends
    """
    scene = sheet.scene.whole  # what stands for a cam does so at one position only
    motion = solve(scene, at=values, sweep=count)
    rows = rows_in_order(motion.ok)
    if len(rows) < 2:
        return {}
    tracks: list[Track] = []

    def place(z: Array) -> int:
        track: Track = []
        for at in on_page(np.asarray(z))[rows].tolist():
            sound = math.isfinite(at.real) and math.isfinite(at.imag)
            track += [round(at.real, 2) + 0.0, round(at.imag, 2) + 0.0] if sound else [None, None]
        if track not in tracks:
            tracks.append(track)
        return tracks.index(track)

    length = sheet.scales.length
    places = {
        (link.name, point): place(motion.position(point, link.name) / length)
        for link in scene.links
        for point in link.points
    }
    fixed = {p: place(np.full(len(motion.ok), z / length)) for p, z in scene.frame.points.items()}
    shared = {point: number for (_, point), number in places.items()} | fixed
    size = scene.size / length
    bars = [
        [number, *(fixed.get(p, places[link.name, p]) for p in link.points)]
        for number, link in enumerate(scene.links)
        if len(link.points) > 1
    ]
    driver = scene.drivers[0]
    unit = scene.units.metres if "/" in driver.key else math.pi / 180.0
    guides = {(s.b, s.guide.name): s for s in scene.slides}.values()
    return {
        "at": [round(float(v) / unit, 3) for v in motion.values[rows, 0]],
        "driver": str(sign("s" if "/" in driver.key else "φ", driver.key)),
        "unit": f" {scene.units.length}" if "/" in driver.key else "°",
        "bars": bars,
        "lines": [[place(end) for end in _guide(motion, slide, size, length)] for slide in guides],
        "points": [[number, str(letters.point(p))] for p, number in shared.items()],
        "fixed": sorted(fixed.values()),
        "blocks": [[places[s.a, s.pin]] for s in scene.slidings if (s.a, s.pin) in places],
        "centres": list(_centres(motion, place, tracks, letters, size, length)),
        "velocity": _vectors(motion, sheet, letters, "velocity", place),
        "acceleration": _vectors(motion, sheet, letters, "acceleration", place),
        "tracks": tracks,
    }


def _guide(motion: Motion, slide: Pair, size: float, length: float) -> list[Array]:
    """Both ends of a guide: of the frame through the whole mechanism, of a link along the link."""
    placed = slide.guide
    if slide.b == motion.scene.frame.name:
        ends = (placed.through / length + sense * size * placed.direction for sense in (-1, 1))
        return [np.full(len(motion.ok), end) for end in ends]
    pose, reach = motion.poses[slide.b], 0.6 * size
    start = (pose.z + pose.u * placed.through) / length
    return [start + along * pose.u * placed.direction for along in (-0.15 * reach, reach)]


def _centres(
    motion: Motion, place: Place, tracks: Sequence[Track], letters: Notation, size: float, length: float
) -> Iterator[list[int | str]]:
    """Instant centres within reach; permanent ones have the names of their points."""
    scene = motion.scene
    middle = np.mean(list(scene.frame.points.values()) or [0j]) / length
    for a, b in combinations([scene.frame.name, *(link.name for link in scene.links)], 2):
        q, omega = pole(motion.poses[b], motion.poses[a])
        with np.errstate(all="ignore"):
            z = np.where(np.abs(omega) > 0, q / omega, np.nan) / length
        z = np.where(np.abs(z - middle) < FAR * size, z, np.nan + 0j)
        known = len(tracks)
        if np.isfinite(z).any() and (number := place(z)) == known:
            pair = (b, a) if a == scene.frame.name else (a, b)
            yield [number, str(letters.centre(pair))]


def _vectors(motion: Motion, sheet: Sheet, letters: Notation, diagram: DiagramName, place: Place) -> dict[str, Json]:
    """Absolute vectors from the pole, relative ones between their end points."""
    kind, scene = "v" if diagram == "velocity" else "a", motion.scene
    ends = dict[PointRef, int]()
    for ref in sheet.ends[diagram]:
        # not a point of the frame, nor one that is only there to draw
        fixed = ref.point in scene.frame.points and ref.link in ("", scene.frame.name)
        known = ref.link in ("", *motion.poses) and any(ref.point in link.points for link in scene.links)
        if known and not fixed:
            try:
                ends[ref] = place(motion.value(Symbol(kind, ref)) / sheet.scales.of(diagram))
            except (KeyError, ValueError):
                continue
    vectors = [(-1, number) for number in dict.fromkeys(ends.values())]
    relative = [s for s in sheet.vectors[diagram] if s.to is not None and s.to in ends and s.of in ends]
    # components of accelerations hide between two ends that are joined
    for symbol in (*(s for s in relative if s.kind == kind), *(relative if diagram == "acceleration" else ())):
        assert symbol.to is not None
        assert symbol.of is not None
        vectors.append((ends[symbol.to], ends[symbol.of]))
    named: list[list[Json]] = [
        [number, str(letters.end(diagram, ref) or letters.vector(Symbol(kind, ref)))]
        for ref, number in ends.items()
    ]
    return {"vectors": [list(pair) for pair in dict.fromkeys(vectors)], "ends": named}
