"""The figure of a synthesis: the construction at its true scale, its steps in words, the lengths measured beside the
exact ones, and what a turn of the found mechanism confirms."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from graphkin.account.headings import number, term, written
from graphkin.checking.closed_form import FoundLength
from graphkin.construction.scales import Extent, fitting_scale
from graphkin.construction.synthesis import (
    DesignAngle,
    DesignCircle,
    DesignLine,
    DesignPoint,
    DesignSheet,
    DesignStroke,
    LineKind,
)
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import WORKED, Block, panel, picture, row, steps, table, worked_page
from graphkin.drawing.chart import ChartPage
from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Primitive, Stroke, Text, on_page
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, cut_to, joined, moved_piece
from graphkin.drawing.text import rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.scene.designs import BarPositionsTask, Design
from graphkin.version import __version__
from graphkin.words import Phrase, as_markup, as_plain, languages, rich_text, say, word
from graphkin.words.written import amount, on_paper, product

if TYPE_CHECKING:
    from graphkin.drawing.chart import Figure

__all__ = [
    "Confirmed", "asked_words", "choice_chart", "construction_picture", "design_figure", "design_scale",
    "step_words",
]  # fmt: skip

ROOM = 9.0  # mm around the construction, for names
PANEL = (168.0, 128.0)  # mm that the construction may fill
FAR, WHOLE = 2.2, 1.3  # a help point, or the whole of a circle, that makes the figure so many times larger is cut off
_KINDS: dict[LineKind, Stroke] = {
    "given": strokes.LINK, "construction": strokes.CONSTRUCTION, "direction": strokes.DIRECTION,
    "limit": Stroke(0.35, (3.0, 1.0)), "mechanism": Stroke(0.7),
}  # fmt: skip
_NAME = re.compile(r"([A-Z])(\d*)")


@dataclass(frozen=True)
class Confirmed:
    """What was asked beside what the found mechanism does, in words and numbers of a unit ("mm", "deg", "")."""

    what: Phrase
    asked: float
    found: float
    ok: bool
    unit: str = ""

    def shown(self, value: float) -> str:
        """One of the two with its unit."""
        if not math.isfinite(value):
            return "–"
        return number(value) + {"deg": "°", "": ""}.get(self.unit, f" {self.unit}")


def design_scale(design: Design, natural: DesignSheet) -> float:
    """Units of length for one mm of paper: the file's own, or the finest of the series at which the construction
    fits; ``natural`` is it at any scale."""
    if design.sheet.length_scale:
        return design.sheet.length_scale / (design.units.metres * 1e3)
    box = _content(natural)
    return fitting_scale(Extent(box.width, box.height), PANEL, natural.scale)


def _content(sheet: DesignSheet) -> Box:
    """What must be seen, y up: all points, help points that lie far off left out."""
    points = [s.at for step in sheet.steps for s in step.strokes if isinstance(s, DesignPoint) and s.name != "O"]
    ends = [z for step in sheet.steps for s in step.strokes if isinstance(s, DesignLine) and s.kind != "direction"
            for z in (s.a, s.b)]  # fmt: skip
    centres = [sheet.points[name] for name in ("O",) if name in sheet.points]
    box = Box.around([*points, *(z for z in ends if z not in centres)])
    circles = [
        Box.around((s.centre,)).grown(s.radius)
        for step in sheet.steps for s in step.strokes if isinstance(s, DesignCircle) and not s.near
    ]  # fmt: skip
    for far, more in (*((FAR, Box.around((z,))) for z in centres), *((WHOLE, one) for one in circles)):
        wider = box.joined(more)
        if max(wider.width, wider.height) <= far * max(box.width, box.height):
            box = wider
    return box


def design_figure(
    design: Design, sheet: DesignSheet, rows: Sequence[FoundLength], confirmed: Sequence[Confirmed],
    notes: Iterable[Phrase], language: str,
) -> Drawing:  # fmt: skip
    """Draw a synthesis on a page of its own.

    Parameters
    ----------
    rows : the lengths measured and compared
    notes : sentences to be said of the result
    language : "en", "zh" or "both"
    """
    unit, every = design.units.length, languages(language)
    parts = [
        _construction(sheet),
        *(steps((step.number, step_words(step.phrase, each)) for step in sheet.steps) for each in every),
        _tables(design, sheet.scale, rows, confirmed, language),
    ]  # fmt: skip
    spoken = " ".join(as_plain(rich_text(s.phrase, every[0])) + "." for s in sheet.steps)
    found = "; ".join(f"{row.symbol} = {row.measured:.6g} {unit}" for row in rows)
    facts = {"kind": design.task.kind, "units": {"length": unit, "paper": "mm"}, "instrument": sheet.hand.name}
    return worked_page(
        (design.title_in(each) or design.name for each in every), asked_words(design, language), parts, notes,
        _scale(design, sheet), title="design figure", said=f"{spoken} {found}", language=language,
        metadata=_facts(design, sheet) | facts,
    )  # fmt: skip


def _scale(design: Design, sheet: DesignSheet) -> str:
    return f"1 mm = {number(sheet.scale)} {design.units.length}"


def _facts(design: Design, sheet: DesignSheet) -> dict[str, object]:
    return {"figure": "design", "design": design.name, "scales": {"length": sheet.scale}, "graphkin": __version__}


def _construction(sheet: DesignSheet, upto: int | None = None) -> Block:
    """The construction, as far as a step, in the room of all of it."""
    content = _content(sheet)
    content = Box(content.left, -content.bottom, content.right, -content.top)  # y down
    shown = [step for step in sheet.steps if upto is None or step.number <= upto]

    def drawn(room: Box) -> Piece:
        origin = room.centre - content.centre
        around = room.moved(-origin)
        strokes = joined([_strokes(step.strokes, step.number, around) for step in shown])
        return moved_piece(with_labels(strokes, around), origin)

    return panel(WORKED, max(content.height, 40.0) + 2 * ROOM, drawn)


def step_words(phrase: Phrase, language: str) -> str:
    """A step in words, its symbols between dollar signs."""
    return as_markup(rich_text(phrase, language))


def construction_picture(design: Design, sheet: DesignSheet, language: str, upto: int | None = None) -> Drawing:
    """The construction by itself, as far as a step, on a figure as large as all of it."""
    return picture(_construction(sheet, upto), "design figure", language, _facts(design, sheet), _scale(design, sheet))


def asked_words(design: Design, language: str) -> str:
    """What the file asks, in its own names."""
    task, unit = design.task, design.units.length
    parts = []
    for key, value in vars(task).items():
        if isinstance(value, float):
            size = f" {unit}" if key not in ("K", "swing") else "°" if key == "swing" else ""
            name = key if key in ("K", "BC") else term(f"datum {key}", language)
            parts.append(f"{name} = {number(value)}{size}")
        elif key == "pairs":
            parts += [f"{number(a)}° → {number(b)}°" for a, b in value]
        elif key == "angles" and value and task.kind == "limits":
            parts.append(f"{number(value[0])}°, {number(value[1])}°")
        elif isinstance(task, BarPositionsTask) and key == "positions":
            for k, place in enumerate(task.positions, 1):
                lies = f", {number(task.angles[k - 1])}°" if task.BC else f", $C_{{{k}}}$ {_at(place.C)}"
                parts.append(f"$B_{{{k}}}$ {_at(place.B)}{lies}")
        elif isinstance(value, complex):
            parts.append(f"{key} {_at(value)}")
    if not parts:
        return term("design figure", language)
    last = languages(language)[-1] if len(languages(language)) == 1 else "en"
    mark = word("list semicolon" if getattr(task, "positions", None) else "list comma", last)
    return f"{term('given wish', language)}{word('colon', last)}{mark.join(parts)}"


def _at(z: complex) -> str:
    return f"({number(z.real)}, {number(z.imag)})"


def _strokes(made: Sequence[DesignStroke], step: int, panel: Box) -> Piece:
    """The strokes of one step, y down, cut at the panel."""
    lines: list[Primitive] = []
    marks: list[Primitive] = []
    labels: list[Label] = []
    for stroke in made:
        if isinstance(stroke, DesignLine):
            line = Line(on_page(stroke.a), on_page(stroke.b), _KINDS[stroke.kind])
            inside = cut_to((line,), panel)
            (marks if stroke.kind in ("given", "mechanism") else lines).extend(inside)
        elif isinstance(stroke, DesignCircle):
            lines += _arcs(stroke, panel)
        elif isinstance(stroke, DesignAngle):
            part, label = _angle(stroke)
            lines += part
            labels.append(label)
        else:
            at = on_page(stroke.at)
            if not (panel.left <= at.real <= panel.right and panel.top <= at.imag <= panel.bottom):
                continue
            if not stroke.name:
                marks.append(Group(symbols.turning_pair(at, radius=0.5), classes=("point",), step=step))
                continue
            shape = symbols.fixed_pivot(at) if stroke.pivot else symbols.turning_pair(at, radius=0.9)
            name = stroke.name
            marks.append(Group(tuple(shape), id=f"point-{name}", classes=("point",), step=step))
            labels.append(Label.of(rich(_letter(name)), at, f"label-point-{name}", step=step))
    group = (Group(tuple(lines), classes=("strokes",), step=step),) if lines else ()
    things = tuple(thing if isinstance(thing, Group) else Group((thing,), step=step) for thing in marks)
    return Piece({"construction": group, "mechanism": things}, tuple(labels))


def _letter(name: str) -> str:
    found = _NAME.fullmatch(name)
    if found is None:
        return name
    letter, index = found.groups()
    return f"${letter}_{{{index}}}$" if index else f"${letter}$"


def _angle(stroke: DesignAngle) -> tuple[list[Primitive], Label]:
    first, second = cmath.phase(stroke.first), cmath.phase(stroke.second)
    if second < first:
        second += 2 * math.pi
    radius = min(12.0, 0.4 * abs(stroke.first))
    apex = on_page(stroke.apex)
    middle = apex + (radius + 1.0) * cmath.rect(1.0, -(first + second) / 2)
    text = f"${stroke.name}$ = {number(stroke.value)}°" if stroke.name else f"{number(stroke.value)}°"
    label = Label.of(rich(text, 2.8), middle, toward=((first + second) / 2,), rank=1)
    return [Arc(apex, radius, first, second, strokes.DIMENSION)], label


def _arcs(stroke: DesignCircle, panel: Box) -> list[Primitive]:
    """A circle as far as it lies in the panel, or its arcs near points."""
    centre, radius = on_page(stroke.centre), stroke.radius
    if stroke.near:
        half = min(0.35, 6.0 / radius)
        angles = [cmath.phase(z - stroke.centre) for z in stroke.near]
        return [Arc(centre, radius, a - half, a + half, strokes.CONSTRUCTION) for a in angles]
    if panel.holds(Box.around((centre,)).grown(radius)):
        return [Circle(centre, radius, stroke=strokes.CONSTRUCTION)]
    cuts: list[float] = []
    for level, across in ((panel.left, False), (panel.right, False), (panel.top, True), (panel.bottom, True)):
        share = ((level - centre.imag) if across else (level - centre.real)) / radius
        if abs(share) < 1.0:
            angle = -math.asin(share) if across else math.acos(share)
            cuts += [angle, math.pi - angle] if across else [angle, -angle]
    ordered = sorted(angle % (2 * math.pi) for angle in cuts)
    found: list[Primitive] = []
    for a, b in zip(ordered, [*ordered[1:], ordered[0] + 2 * math.pi] if ordered else [], strict=True):
        z = centre + radius * cmath.rect(1.0, -(a + b) / 2)
        if panel.left <= z.real <= panel.right and panel.top <= z.imag <= panel.bottom:
            found.append(Arc(centre, radius, a, b, strokes.CONSTRUCTION))
    return found


def _tables(
    design: Design, scale: float, rows: Sequence[FoundLength], confirmed: Sequence[Confirmed], language: str
) -> Block:
    """Lengths on paper, measured, exact; beside them what a turn confirms."""
    unit, per, every = design.units.length, amount(scale, 12), languages(language)

    def read(mm: float) -> str:
        return written(product(on_paper(mm), per))

    lengths = table(
        [[word("length found", each), word("on paper", each), f"{word('measured', each)} ({unit})",
          f"{word('exact', each)} ({unit})"] for each in every],
        [[one.symbol if one.symbol == "ram" else f"${one.symbol}$", on_paper(one.on_paper), read(one.on_paper),
          number(one.exact)] for one in rows], (26.0, 24.0, 28.0, 28.0), layer="answers",
    )  # fmt: skip
    if not confirmed:
        return lengths
    turned = table(
        [[word(key, each) for key in ("confirmed", "given wish", "by the turn")] for each in every],
        [[" ".join(dict.fromkeys(say(one.what, each) for each in every)), one.shown(one.asked), one.shown(one.found)]
         for one in confirmed], (34.0, 20.0, 22.0),
        layer="answers",
    )  # fmt: skip
    return row(lengths, turned, gap=4.0)


CHART_WIDTH, CHART_HEIGHT = 150.0, 95.0


def choice_chart(
    design: Design, key: str, at: Callable[[float], float | None], span: tuple[float, float],
    here: tuple[float, float], best: tuple[float, float], language: str,
) -> ChartPage:  # fmt: skip
    """The least transmission angle over the values that a free datum may have, with the design's own and the best."""
    import numpy as np

    from graphkin.drawing.chart import (
        SOLID_AND_DASHED,
        add_labels,
        add_panel,
        add_words,
        count_steps,
        degree_step,
        look,
        marker,
    )

    # a range without end is shown as far as it tells
    low, high = max(span[0], min(here[0], best[0]) / 4), min(span[1], 4 * max(here[0], best[0]))
    low = span[0] if span[0] > low / 3 else low
    x = np.linspace(low, high, 241)
    y = np.array([angle if (angle := at(float(value))) is not None else np.nan for value in x])
    title = say(Phrase("choice chart", (word(f"datum {key}", language),)), language)

    def paint(figure: Figure) -> None:
        add_words(figure, Text(complex(8.0, 10.0), rich(title, 4.0, bold=True)))
        box = Box(20.0, 22.0, CHART_WIDTH - 8.0, CHART_HEIGHT - 16.0)
        axes = add_panel(figure, box, "choice", f"{word('least angle', language)} (°)",
                         f"{word(f'datum {key}', language)} ({design.units.length})")  # fmt: skip
        axes.set_xlim(low, high)
        top = 5.0 * math.ceil((float(np.nanmax(y)) + 3.0) / 5.0)
        axes.set_ylim(0.0, top)
        count_steps(axes.xaxis)
        count_steps(axes.yaxis, degree_step(top, 9))
        axes.plot(x, y, **look(SOLID_AND_DASHED[0]))
        axes.plot([here[0]], [here[1]], **marker("circle"))
        axes.plot([best[0]], [best[1]], **marker("up"))
        both = dict.fromkeys((here, best))
        marks = [(f"{number(value, 4)}: {number(angle, 4)}°", (value, angle)) for value, angle in both]
        add_labels(axes, marks, toward=((-math.pi / 2,), (math.pi / 2,))[: len(marks)])

    facts = {"figure": "choice", "design": design.name, "graphkin": __version__}
    return ChartPage(CHART_WIDTH, CHART_HEIGHT, paint, title=title, desc=title, lang=language, metadata=facts)
