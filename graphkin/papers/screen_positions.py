"""The figures and steps of every position of the driver, for a screen: drawn in the same frames, every part with its
step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest
from typing import Literal, TypeAlias

from graphkin.account.headings import FIGURE_WORDS, drivers, number, term
from graphkin.account.notation import scale_statement
from graphkin.account.voice import capital
from graphkin.construction import Plan, execute
from graphkin.construction.centres import Centres
from graphkin.construction.polygon_acts import OnPlan
from graphkin.construction.scales import next_of_series
from graphkin.construction.sheet import DiagramName, Scales, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.figures.cam import cam_pictures, scaled_cam
from graphkin.drawing.figures.centres import background
from graphkin.drawing.figures.forces import group_equation, group_picture
from graphkin.drawing.figures.lever import lever_figure
from graphkin.drawing.figures.train import moving_plans, train_figure
from graphkin.drawing.force_stages import force_stages
from graphkin.drawing.ink.primitives import Group
from graphkin.drawing.parts.centre_marks import centre_marks, near_box
from graphkin.drawing.parts.insets import polygon_with_insets, strip_height
from graphkin.drawing.parts.mechanism import mechanism_piece
from graphkin.drawing.parts.polygon import extent
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups, moved_piece
from graphkin.drawing.stepwise import stepped
from graphkin.drawing.write.drawing import Drawing
from graphkin.drawing.write.svg import svg_element
from graphkin.papers.answer_key import way
from graphkin.papers.blocks import Said, said
from graphkin.papers.html import blocks_html, said_html, spoken_words, words_html
from graphkin.papers.lesson import Lesson, Stage, force_found, found_in, plain_words
from graphkin.papers.pictures import ROOM, bare_picture, equation_picture
from graphkin.papers.problem import equation_words, given
from graphkin.papers.solution import results_blocks, stage_title, step_items
from graphkin.words import about, languages

__all__ = ["POSITIONS", "Progress", "View", "common_scales", "positions_data"]

Progress = Callable[[int, int], None]  # positions done, and all of them
POSITIONS = 12
MECHANISM, POLYGON = (160.0, 218.0), 190.0  # mm that the mechanism in all positions and a polygon may fill
WIDE = 96.0  # mm of the sketch of a group, its polygon below
POLYGONS: tuple[DiagramName, ...] = ("velocity", "acceleration")
LISTED = ("figures", "steps")
FigureName: TypeAlias = Literal["mechanism", "velocity", "acceleration", "centres", "force"]


@dataclass(frozen=True)
class View:
    """One position on the screen: its drawing, and its centres where they can be had."""

    lesson: Lesson
    centres: Centres | None = None


def common_scales(plans: Sequence[Plan], paper: Scales) -> list[Scales]:
    """Scales for several positions: those of the paper, and coarser ones for the polygons that would be too large.

    The mechanism has one scale in all positions.
    """
    sheets = [execute(plan) for plan in plans]
    metres = sheets[0].scene.units.rates.metres
    whole = _joined(Box.around(sheet.points.values()) for sheet in sheets)
    on_paper = sheets[0].scales.length / paper.length
    length = (
        _coarser(paper.length * 1e3, on_paper * max(whole.width / MECHANISM[0], whole.height / MECHANISM[1])) * 1e-3
    )

    def fitting(sheet: Sheet, diagram: DiagramName) -> float:
        own = paper.of(diagram)
        size = _size(extent(sheet, diagram)) * sheet.scales.of(diagram)
        return _coarser(own / metres, size / own / POLYGON) * metres

    return [Scales(length, fitting(sheet, "velocity"), fitting(sheet, "acceleration")) for sheet in sheets]


def _size(box: Box) -> float:
    return max(box.width, box.height)


def _coarser(scale: float, factor: float) -> float:
    """The scale itself where it is coarse enough, else the first of the series so many times coarser."""
    if factor <= 1.0:
        return scale
    return next_of_series(scale * factor)


def positions_data(views: Sequence[View], progress: Progress | None = None) -> dict[str, object]:
    """Names, figures and steps of the positions, ready for the page, and the stages of all of them, each once.

    What is alike stands together, by key the values of all positions, of figures and steps row by row (None where a
    position has fewer): so packed it takes two thirds of the room.
    """
    frames = _Frames(views)
    positions = []
    for done, view in enumerate(views, 1):
        positions.append(frames.data(view))
        if progress is not None:
            progress(done, len(views))
    columns: dict[str, list[object]] = {key: [one[key] for one in positions] for key in positions[0]}
    for key in LISTED:
        columns[key] = [list(row) for row in zip_longest(*columns[key])]  # type: ignore[call-overload]
    return {"positions": columns, "stages": frames.stages}


def _described(lesson: Lesson, name: str, language: str) -> str:
    """What a polygon shows at this position, in words: each vector with its size and direction."""
    rows = (row for row in lesson.results if row.symbol.is_vector and row.symbol.measure == name)
    return "; ".join(
        f"{spoken_words(f'${lesson.letters.vector(row.symbol)}$', language)} "
        f"{number(lesson.in_unit(row.symbol, abs(row.true)), 4)} {lesson.unit(row.symbol)}, {way(row, language)}"
        for row in rows
    )


class _Frames:
    """The frames that hold the figures of all positions: equally large, and the fixed pivots always at their places."""

    def __init__(self, views: Sequence[View]) -> None:
        self.pieces = [
            mechanism_piece(v.lesson.sheet, v.lesson.letters, (MECHANISM[0] + 20, MECHANISM[1] + 20)) for v in views
        ]
        self.mechanism = _joined(box for _, box in self.pieces).grown(ROOM)
        self.polygons = {d: self._largest(views, d) for d in POLYGONS}
        self.views = list(views)
        self.cams = _cams(views[0].lesson)
        self.stages: list[dict[str, str]] = []
        backs = [ink_box(background(piece).drawn) or box for piece, box in self.pieces]
        shown = [(v.centres, back) for v, back in zip(views, backs, strict=True) if v.centres is not None]
        self.centres = _joined(near_box(c, back, MECHANISM) for c, back in shown).grown(ROOM) if shown else None

    def data(self, view: View) -> dict[str, object]:
        lesson = view.lesson
        first = languages(lesson.language)[0]
        figures = []
        for name, drawing in self._figures(view):
            layers = replace(drawing, children=stepped(drawing.children)) if name != "centres" else drawing
            layers = replace(layers, desc=f"{spoken_words(drivers(lesson.sheet, lesson.letters), first)}. "
                                          f"{_described(lesson, name, first)}")  # fmt: skip
            caption = f"{words_html(_title(lesson, name), first)} "
            figures.append({
                "name": name,
                "svg": svg_element(layers, named=name != "centres"),
                "caption": caption + f'<span class="scale">{words_html(self._scale(lesson, name), first)}</span>',
            })  # fmt: skip
        stages = lesson.stages
        shown, more, steps = self._forces(lesson, len(stages))
        return {
            "name": plain_words(drivers(lesson.sheet, lesson.letters)),
            "label": words_html(drivers(lesson.sheet, lesson.letters), first),
            "at": _at(lesson.sheet),
            "figures": [*figures, *_plans(lesson), *shown, *self.cams],
            "stages": [*(self._stage(lesson, stage) for stage in stages), *more],
            "results": blocks_html(results_blocks(lesson), first) if lesson.report.rows else "",
            "given": blocks_html(given(lesson), first),
            "steps": [
                {"d": stage.diagram, "e": k, "n": item.number, "html": said_html(item.words, "p")
                 + "".join(f'<p class="work">{words_html(line, first)}</p>' for line in item.work),
                 "text": " ".join(spoken_words(markup, each) for each, markup in item.words), **found_in(lesson, step)}
                for k, stage in enumerate(stages)
                for step, item in zip(stage.steps, step_items(lesson, stage), strict=True)
            ] + steps,
        }  # fmt: skip

    def _forces(
        self, lesson: Lesson, before: int
    ) -> tuple[list[dict[str, str]], list[int], list[dict[str, object]]]:
        """Figures, stages and steps of the forces, the numbers of the stages behind those of the motion."""
        forces = lesson.forces
        if forces is None:
            return [], [], []
        sheet = replace(lesson.sheet, scales=replace(lesson.sheet.scales, force=forces.per_mm))
        first = languages(lesson.language)[0]
        figures, numbers, steps = list[dict[str, str]](), list[int](), list[dict[str, object]]()
        told = force_stages(sheet, forces, lesson.letters, lesson.language)
        scale = words_html(scale_statement(sheet, lesson.letters.convention, "force"), first)
        for turn, stage in enumerate(told):
            name, svg = str(stage.figure), ""
            if stage.group is not None:
                name = f"force-{turn}"
                drawn = group_picture(
                    sheet, forces, stage, stage.group, lesson.letters, lesson.language, WIDE, f"-{turn}"
                )  # fmt: skip
                links = said(about("force on links", stage.group.links), lesson.language, ", ".join(stage.group.links))
                caption = f'{said_html(links)} <span class="scale">{scale}</span>'
                figures.append({"name": name, "svg": svg_element(drawn, named=True), "caption": caption})
                equation = group_equation(sheet, stage.group, lesson.letters, lesson.language, WIDE)
                svg = "" if equation is None else svg_element(equation)
            title = said_html(stage.title)
            if len(forces.states) > 1 and stage.group is not None:
                load = said("force with load" if stage.again else "force without load", lesson.language)
                title += f" <small>{said_html(load)}</small>"
            numbers.append(self._place_in_table({"title": title, "svg": svg}))
            steps += [
                {"d": name, "e": before + turn, "n": step.number, "html": said_html(step.words, "p")
                 + "".join(f'<p class="work">{words_html(line, first)}</p>' for line in step.work),
                 "text": " ".join(spoken_words(markup, each) for each, markup in step.words),
                 **force_found(lesson, stage, step)}
                for step in stage.steps
            ]  # fmt: skip
        lever = lever_figure(sheet, forces, language=lesson.language, convention=lesson.convention)
        if lever is not None:
            caption = said_html(said("lever", lesson.language))
            figures.append({"name": "lever", "svg": svg_element(lever), "caption": caption})
        return figures, numbers, steps

    def _stage(self, lesson: Lesson, stage: Stage) -> int:
        """Place of a stage in the table of all: most of them are the same in every position."""
        svg = ""
        if stage.equation is not None:
            words = equation_words(lesson, stage.equation)
            svg = svg_element(equation_picture(lesson.sheet, stage.equation, lesson.letters, lesson.language, words))
        return self._place_in_table({"title": said_html(stage_title(lesson, stage)), "svg": svg})

    def _place_in_table(self, whole: dict[str, str]) -> int:
        if whole not in self.stages:
            self.stages.append(whole)
        return self.stages.index(whole)

    def _scale(self, lesson: Lesson, name: FigureName) -> str:
        return scale_statement(lesson.sheet, lesson.letters.convention, "mechanism" if name == "centres" else name)

    def _figures(self, view: View) -> Iterator[tuple[FigureName, Drawing]]:
        lesson = view.lesson
        sheet, letters = lesson.sheet, lesson.letters
        piece, _ = self.pieces[self.views.index(view)]
        yield "mechanism", self._page(lesson, "mechanism", with_labels(piece, self.mechanism), self.mechanism)
        for diagram in POLYGONS:
            if not sheet.vectors(diagram):
                continue
            half = self.polygons[diagram] / 2
            middle = extent(sheet, diagram).centre
            panel = Box.around((middle - half, middle + half))
            strip = Box(panel.left, panel.bottom, panel.right, panel.bottom + self._strip(diagram))
            made, _ = polygon_with_insets(sheet, diagram, letters, lesson.language, panel, 0j, strip)
            yield diagram, self._page(lesson, diagram, made, panel.joined(strip))
        if view.centres is not None and self.centres is not None:
            back = background(piece)
            marks = centre_marks(view.centres, letters, self.centres, back.drawn)
            piece = with_labels(joined((back, marks)), self.centres)
            yield "centres", self._page(lesson, "centres", piece, self.centres)

    def _largest(self, views: Sequence[View], diagram: DiagramName) -> complex:
        """Width and height (mm) in which the polygon of every position has room: all are shown equally large."""
        boxes = [extent(v.lesson.sheet, diagram).grown(ROOM) for v in views]
        return complex(max(max(b.width for b in boxes), 70.0), max(b.height for b in boxes))

    def _strip(self, diagram: DiagramName) -> float:
        width = self.polygons[diagram].real
        return max(strip_height(v.lesson.sheet, diagram, width) for v in self.views)

    def _page(self, lesson: Lesson, name: FigureName, piece: Piece, panel: Box) -> Drawing:
        moved = moved_piece(piece, -panel.corners[0])
        title = _title(lesson, name)
        desc = drivers(lesson.sheet, lesson.letters)
        return Drawing(
            panel.width, panel.height, layer_groups(moved), title, plain_words(desc), languages(lesson.language)[0]
        )


def _plans(lesson: Lesson) -> Iterator[dict[str, str]]:
    """The velocity plans of what rolls, each there from the step on that ends it."""
    sheet, language = lesson.sheet, lesson.language
    figure = train_figure(sheet, language=language, convention=lesson.convention)
    for plan, page in zip(moving_plans(sheet), (figure, *figure.further) if figure else (), strict=True):
        own = [step.number for step in sheet.steps if step.diagram == plan.order and isinstance(step.act, OnPlan)]
        bare = bare_picture(page)
        drawn = replace(bare, children=(Group(bare.children, classes=(f"step-{own[-1]}",)),)) if own else bare
        told = said("plan" if plan.order == "velocity" else "plan accelerations", language)
        yield {"name": f"plan-{plan.order}", "svg": svg_element(drawn), "caption": _caption(told)}


def _cams(lesson: Lesson) -> list[dict[str, str]]:
    """Displacement diagram and inversion of each cam that is drawn by its law."""
    scene, language = lesson.sheet.scene, lesson.language
    return [
        {"name": f"{key.replace(' ', '-')}-{i}", "svg": svg_element(picture), "caption": _caption(said(key, language))}
        for i, cam in enumerate(scene.cams)
        for key, picture in zip(
            ("cam diagram", "cam figure"), cam_pictures(scene, scaled_cam(scene, cam), language), strict=True
        )
    ]


def _caption(told: Said) -> str:
    return said_html(tuple((each, capital(text)) for each, text in told))


def _at(sheet: Sheet) -> float:
    """The value of the first driver: degrees, or travel in scene units."""
    driver = sheet.scene.drivers[0]
    return round(float(sheet.scene.unit_of(driver).of(sheet.drivers[driver.key])), 3)


def _title(lesson: Lesson, figure: FigureName) -> str:
    return term(figure if figure == "centres" else FIGURE_WORDS[figure], lesson.language)


def _joined(boxes: Iterable[Box]) -> Box:
    first, *rest = list(boxes)
    for box in rest:
        first = first.joined(box)
    return first
