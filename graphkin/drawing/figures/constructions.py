"""The figures of tasks with a single construction, on a page of its own at its true scale: its steps in words, a table,
and the results.

Of a synthesis the measured lengths beside the exact ones, and the values of the found mechanism over a turn.  Of a cam
the displacement diagram divided and numbered, the cam by inversion, and the pressure angle at each division.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphkin.account.headings import number, term
from graphkin.account.voice import account_of
from graphkin.checking.closed_form import FoundLength
from graphkin.construction.board.scales import extent_of, fitting_scale
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import Angle, Bar, CompassArc, Curve, Mark, Ray, Step
from graphkin.construction.board.steps import Stroke as DrawnStroke
from graphkin.construction.cam_sheet import cam_sheet, divisions
from graphkin.construction.tasks import length_letters
from graphkin.construction.touching import CamStation
from graphkin.drawing import chart
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import STEP, WORKED, Block, FigurePage, picture, row, spoken, table, worked_page
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Group,
    Line,
    Polygon,
    Polyline,
    Primitive,
    Run,
    Stroke,
    Text,
    on_page,
    page_direction,
)
from graphkin.drawing.place.piece import Piece, cut_to, ink_box
from graphkin.drawing.plate import Plate, centred
from graphkin.drawing.text import plain, rich, runs_width
from graphkin.drawing.write.drawing import Drawing
from graphkin.plane import degrees
from graphkin.scene.designs import BarPositionsTask, Design
from graphkin.scene.laws import TURN
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import LawCam, SlidingFollower, SwingingFollower
from graphkin.version import __version__
from graphkin.words import Phrase, in_all, languages, say, word
from graphkin.words.symbols import RichText, Words, sign, spaced
from graphkin.words.written import amount, on_paper, printed, product

# a synthesis

ROOM = 9.0  # mm around the construction, for names
PANEL = (168.0, 128.0)  # mm that the construction may fill
FAR, WHOLE = 2.2, 1.3  # a help point, or the whole of a circle, that makes the figure so many times larger is cut off
_LINES: dict[str, Stroke] = {
    "given": strokes.LINK, "construction": strokes.CONSTRUCTION, "limit": strokes.LIMIT,
    "mechanism": Stroke(0.7),
}


@dataclass(frozen=True)
class Confirmed:
    """An asked value beside that of the found mechanism, in words and numbers of a unit ("mm", "deg", "")."""

    what: Phrase
    asked: float
    found: float
    ok: bool
    unit: str = ""

    def shown(self, value: float) -> str:
        """Either value with its unit."""
        if not math.isfinite(value):
            return "–"
        return number(value) + {"deg": "°", "": ""}.get(self.unit, f" {self.unit}")


def design_scale(design: Design, natural: Sheet) -> float:
    """Units of length for one mm of paper: the file's own, or the finest of the series at which the construction fits;
    ``natural`` is the construction at any scale."""
    if design.sheet.length_scale:
        return design.sheet.length_scale / (design.units.metres * 1e3)
    box = _content(natural)
    return fitting_scale((box.width, box.height), PANEL, natural.scales.length)


def _content(sheet: Sheet) -> Box:
    """The box to be shown (mm, y down): all points, without far help points."""
    made = [stroke for step in sheet.steps for stroke in step.strokes]
    far = [s.at for s in made if isinstance(s, Mark) and s.ref.point == "O"]
    near = [s.at for s in made if isinstance(s, Mark) and s.ref.point != "O"]
    near += [z for s in made if isinstance(s, Bar) for z in (s.a, s.b) if z not in far]
    box = Box.around(map(on_page, near))
    circles = [Box.around((on_page(s.centre),)).grown(s.radius)
               for s in made if isinstance(s, CompassArc) and s.whole]
    for most, more in (*((FAR, Box.around((on_page(z),))) for z in far), *((WHOLE, circle) for circle in circles)):
        wider = box.joined(more)
        if max(wider.width, wider.height) <= most * max(box.width, box.height):
            box = wider
    return box


def design_figure(
    design: Design, sheet: Sheet, rows: Sequence[FoundLength], confirmed: Sequence[Confirmed],
    notes: Iterable[Phrase], language: str,
) -> Drawing:
    """Draw a synthesis on a page of its own.

    Parameters
    ----------
    rows : the measured and compared lengths
    notes : sentences on the result
    language : "en", "zh" or "both"
    """
    unit, names = design.units.length, (design.title_in(each) or design.name for each in languages(language))
    said = spoken(account_of(sheet), (step.phrase for step in sheet.steps), language)
    lengths = "; ".join(f"{row.symbol} = {row.measured:.6g} {unit}" for row in rows)
    facts = {"kind": design.task.kind, "units": {"length": unit, "paper": "mm"}, "instrument": sheet.instrument}
    return worked_page(
        names, asked_words(design, language), [_construction(sheet)], sheet,
        _tables(design, sheet.scales.length, rows, confirmed, language), notes, _design_scale(design, sheet),
        title="design figure", said=f"{said} {lengths}", language=language,
        metadata=_design_facts(design, sheet) | facts,
    )


def _design_scale(design: Design, sheet: Sheet) -> str:
    return f"1 mm = {number(sheet.scales.length)} {design.units.length}"


def _design_facts(design: Design, sheet: Sheet) -> dict[str, object]:
    scales = {"length": sheet.scales.length}
    return {"figure": "design", "design": design.name, "scales": scales, "graphkin": __version__}


def construction_picture(design: Design, sheet: Sheet, language: str, upto: int | None = None) -> Drawing:
    """The construction by itself, up to a step, on a figure of the size of the whole."""
    return picture(_construction(sheet, upto), "design figure", language, _design_facts(design, sheet),
                   _design_scale(design, sheet))


def asked_words(design: Design, language: str) -> RichText:
    """The questions of the file, in its names."""
    task, unit = design.task, design.units.length
    parts = list[Words]()
    for key, value in vars(task).items():
        if isinstance(value, float):
            size = {"K": "", "swing": "°"}.get(key, f" {unit}")
            parts.append(f"{key if key in ('K', 'BC') else term(f'datum {key}', language)} = {number(value)}{size}")
        elif key == "pairs":
            parts += [f"{number(a)}° → {number(b)}°" for a, b in value]
        elif key == "angles":
            parts.append(f"{number(value[0])}°, {number(value[1])}°")
        elif isinstance(task, BarPositionsTask) and key == "positions":
            for k, place in enumerate(task.positions, 1):
                end = sign("C", str(k)) + f" {_at(place.C)}"
                lies = f"{number(degrees(place.C - place.B))}°" if task.BC else end
                parts.append(sign("B", str(k)) + f" {_at(place.B)}, " + lies)
        elif isinstance(value, complex):
            parts.append(f"{key} {_at(value)}")
    last = languages(language)[-1] if len(languages(language)) == 1 else "en"
    mark = word("list semicolon" if getattr(task, "positions", None) else "list comma", last)
    return term("given wish", language) + word("colon", last) + spaced(mark, parts)


def _at(z: complex) -> str:
    return f"({number(z.real)}, {number(z.imag)})"


def _construction(sheet: Sheet, upto: int | None = None) -> Block:
    """The construction, up to a step, in the room of the whole."""
    content = _content(sheet)

    def drawn(room: Box) -> Piece:
        plate = Plate()
        for step in sheet.steps[:upto]:
            _draw(plate, step.strokes, step.number, room)
        return plate.piece

    return centred(content, WORKED, max(content.height, 40.0) + 2 * ROOM, drawn)


def _draw(plate: Plate, made: Sequence[DrawnStroke], step: int, room: Box) -> None:
    """The strokes of a step, cut at the room: help lines, and over them the mechanism with its points."""
    lines: list[Primitive] = []
    for stroke in made:
        match stroke:
            case Bar(a, b, _, kind):
                cut = cut_to((Line.between(a, b, _LINES[kind]),), room)
                if kind not in ("given", "mechanism"):
                    lines += cut
                    continue
                for line in cut:
                    plate.put("mechanism", line, step=step)
            case Ray(through, _, to) if to is not None:
                lines += cut_to((Line.between(through, to, strokes.DIRECTION),), room)
            case CompassArc():
                lines += _arcs(stroke, room)
            case Angle(at, a, b, value, name):
                first, second = cmath.phase(a - at), cmath.phase(b - at)
                second += TURN * (second < first)
                radius, middle = min(12.0, 0.4 * abs(a - at)), (first + second) / 2
                lines.append(Arc(on_page(at), radius, first, second, strokes.DIMENSION))
                said = (sign(name) + " = " if name else "") + f"{number(math.degrees(value))}°"
                plate.name(rich(said, 2.8), at + (radius + 1.0) * cmath.rect(1.0, middle), toward=(middle,), rank=1)
            case Mark(ref, at, fixed) if room.distance(on_page(at)) == 0.0:
                name, z = ref.point, on_page(at)
                shape = symbols.fixed_pivot(z) if fixed else symbols.turning_pair(z, radius=0.9 if name else 0.5)
                id = f"point-{name}" if name else ""
                plate.put("mechanism", *shape, id=id, classes=("point",), step=step)
                if name:
                    plate.name(rich(sign(name[0], name[1:])), at, f"label-{id}", step=step)
    if lines:
        plate.put("construction", *lines, classes=("strokes",), step=step)


def _arcs(drawn: CompassArc, room: Box) -> list[Primitive]:
    """The part of a whole circle in the room, or an arc near its point."""
    middle, radius = on_page(drawn.centre), drawn.radius

    def arc(start: float, end: float) -> Arc:
        return Arc(middle, radius, start, end, strokes.CONSTRUCTION)

    if not drawn.whole:
        half, angle = min(0.35, 6.0 / radius), cmath.phase(drawn.at - drawn.centre)
        return [arc(angle - half, angle + half)]
    if room.holds(Box.around((middle,)).grown(radius)):
        return [Circle(middle, radius, stroke=strokes.CONSTRUCTION)]
    cuts: list[float] = []
    for share in ((edge - middle.real) / radius for edge in (room.left, room.right)):
        cuts += [math.acos(share), -math.acos(share)] if abs(share) < 1.0 else []
    for share in ((edge - middle.imag) / radius for edge in (room.top, room.bottom)):
        cuts += [-math.asin(share), math.pi + math.asin(share)] if abs(share) < 1.0 else []
    ordered = sorted(angle % TURN for angle in cuts)
    ends = zip(ordered, [*ordered[1:], ordered[0] + TURN] if ordered else [], strict=True)
    return [arc(a, b) for a, b in ends if room.distance(middle + radius * page_direction((a + b) / 2)) == 0.0]


def _tables(
    design: Design, scale: float, rows: Sequence[FoundLength], confirmed: Sequence[Confirmed], language: str
) -> Block:
    """Lengths on paper, measured, exact; beside them the values over a turn."""
    unit, per, every = design.units.length, amount(scale, 12), languages(language)
    lengths = table(
        [[word("length found", each), word("on paper", each), f"{word('measured', each)} ({unit})",
          f"{word('exact', each)} ({unit})"] for each in every],
        [[length_letters(length.symbol), on_paper(length.on_paper),
          printed(product(on_paper(length.on_paper), per)), number(length.exact)] for length in rows],
        (26.0, 24.0, 28.0, 28.0), layer="answers",
    )
    turned = table(
        [[word(key, each) for key in ("confirmed", "given wish", "by the turn")] for each in every],
        [[" ".join(dict.fromkeys(say(value.what, each) for each in every)), value.shown(value.asked),
          value.shown(value.found)] for value in confirmed], (34.0, 20.0, 22.0), layer="answers",
    )
    return row(lengths, turned, gap=4.0)


CHART_WIDTH, CHART_HEIGHT = 150.0, 95.0


def choice_chart(
    design: Design, key: str, at: Callable[[float], float | None], span: tuple[float, float],
    here: tuple[float, float], best: tuple[float, float], language: str,
) -> chart.ChartPage:
    """The least transmission angle over the values that a free datum may have, with the design's own and the best."""
    # a range without end is shown as far as it tells
    low, high = max(span[0], min(here[0], best[0]) / 4), min(span[1], 4 * max(here[0], best[0]))
    low = span[0] if span[0] > low / 3 else low
    x = np.linspace(low, high, 241)
    y = np.array([angle if (angle := at(float(value))) is not None else np.nan for value in x])
    title = say(Phrase("choice chart", datum=word(f"datum {key}", language)), language)

    def paint(figure: chart.Figure) -> None:
        chart.add_words(figure, Text(complex(8.0, 10.0), rich(title, 4.0, bold=True)))
        box = Box(20.0, 22.0, CHART_WIDTH - 8.0, CHART_HEIGHT - 16.0)
        axes = chart.add_panel(figure, box, "choice", f"{word('least angle', language)} (°)",
                               f"{word(f'datum {key}', language)} ({design.units.length})")
        axes.set_xlim(low, high)
        top = 5.0 * math.ceil((float(np.nanmax(y)) + 3.0) / 5.0)
        axes.set_ylim(0.0, top)
        chart.count_steps(axes.xaxis)
        chart.count_steps(axes.yaxis, chart.degree_step(top, 9))
        axes.plot(x, y, **chart.look(chart.SOLID_AND_DASHED[0]))
        axes.plot([here[0]], [here[1]], **chart.marker("circle"))
        axes.plot([best[0]], [best[1]], **chart.marker("up"))
        both = dict.fromkeys((here, best))
        marks = [(f"{number(value, 4)}: {number(angle, 4)}°", (value, angle)) for value, angle in both]
        chart.add_labels(axes, marks, toward=((-math.pi / 2,), (math.pi / 2,))[: len(marks)])

    facts = {"figure": "choice", "design": design.name, "graphkin": __version__}
    return chart.ChartPage(CHART_WIDTH, CHART_HEIGHT, paint, title=title, desc=title, lang=language, metadata=facts)


# a cam

GUTTER = 8.0  # mm between columns of the table
CAM_PANEL = (150.0, 140.0)  # mm that the cam may fill
SMALL = 2.4
NUMBERS_APART = 0.2  # mm, to either side of a number
LONG = 180.0  # mm for a turn of the cam in the diagram
HIGH = (16.0, 40.0)  # mm that the lifts take there
PAST = 5.0  # mm that a ray goes on beyond what it carries
BEGUN = 2  # steps, to the circles, with which a problem sheet begins
ROWS = 10


def scaled_cam(scene: Mechanism, cam: LawCam) -> Sheet:
    """The construction of a cam at the scale of its figure: as the scene wishes, or the finest of the series at which
    the cam fits the page."""
    if scene.question.sheet.length_scale:
        return cam_sheet(cam, scene.question.sheet.length_scale * 1e-3)
    natural = cam_sheet(cam, cam.base / 50.0)
    drawn_at = divisions(natural)
    far = [*(z for curve in _curves(natural) for z in curve.curve), *(d.point for d in drawn_at)]
    far += [d.line for d in drawn_at] if cam.turns else []
    room = CAM_PANEL[0] - 2 * PAST - 8.0, CAM_PANEL[1] - 2 * PAST - 8.0
    per = scene.units.metres
    return cam_sheet(cam, fitting_scale(extent_of(far, 1.0), room, natural.scales.length / per) * per)


def _curves(sheet: Sheet) -> list[Curve]:
    """The pitch curve under a roller, and the profile."""
    return [curve for step in sheet.steps for curve in step.each(Curve)]


def cam_figure(scene: Mechanism, cam: LawCam, sheet: Sheet, notes: Sequence[Phrase], language: str) -> Drawing:
    """Draw a cam on a page of its own.

    Parameters
    ----------
    notes : sentences on its values
    language : "en", "zh" or "both"
    """
    names = (scene.question.title_in(each) or scene.name for each in languages(language))
    units, scales = {"length": scene.units.length, "paper": "mm"}, {"length": sheet.scales.length / scene.units.metres}
    facts = {"units": units, "scales": scales, "instrument": sheet.instrument}
    said = spoken(account_of(sheet), (*(step.phrase for step in sheet.steps), *notes), language)
    return worked_page(
        names, _given(scene, cam, language), [_diagram(scene, cam, sheet, language), _cam(scene, cam, sheet)], sheet,
        _table(scene, cam, sheet), notes, _scale(scene, sheet), title="cam figure", said=said, language=language,
        metadata=_facts(scene, cam) | facts,
    )


def _scale(scene: Mechanism, sheet: Sheet) -> RichText:
    return sign("μ", "l") + f" = {number(sheet.scales.length / scene.units.metres)} {scene.units.length}/mm"


def _facts(scene: Mechanism, cam: LawCam) -> dict[str, object]:
    return {"figure": "cam", "scene": scene.name, "cam": cam.link, "graphkin": __version__}


def cam_pictures(
    scene: Mechanism, cam: LawCam, sheet: Sheet, language: str, begun: bool = False
) -> tuple[Drawing, Drawing]:
    """The displacement diagram and the cam, each by itself; ``begun`` leaves out the parts to be found."""
    facts = _facts(scene, cam)
    return (picture(_diagram(scene, cam, sheet, language, begun), "cam diagram", language, facts),
            picture(_cam(scene, cam, sheet, begun), "cam figure", language, facts, _scale(scene, sheet)))


def cam_given(scene: Mechanism, cam: LawCam, language: str) -> RichText:
    """The given data of a cam with the pieces of its law, in a language."""
    unit, pieces = _unit(scene, cam), []
    for piece in cam.law.pieces:
        said = f"{number(math.degrees(piece.start))}°–{number(math.degrees(piece.end))}°"
        lift = _lift(scene, cam, piece.high - piece.low)
        pieces.append(f"{said} {_law(piece.by, language)}"
                      + (f" {'+' if lift > 0 else '−'}{number(abs(lift))}{unit}" if piece.by else ""))
    comma, semicolon = (word(f"list {mark}", language) for mark in ("comma", "semicolon"))
    return _given(scene, cam, language) + semicolon + comma.join(pieces)


def _law(by: str, language: str) -> str:
    """The law of a piece; that of a dwell is none."""
    return term(f"law {by or 'dwell'}", language, by)


def _given(scene: Mechanism, cam: LawCam, language: str) -> RichText:
    """The given base circle, roller, offset, and law."""
    lengths = {sign("r", "0"): cam.base, sign("r", "r"): cam.roller}
    if isinstance(cam.motion, SlidingFollower):
        lengths[sign("e")] = cam.motion.offset
    else:
        lengths |= {sign("l"): cam.motion.arm, sign("a"): abs(cam.axis - cam.motion.centre)}
    parts = (letter + f" = {number(length / scene.units.metres)} {scene.units.length}"
             for letter, length in lengths.items() if length)
    kind = term("cam flat" if cam.flat else "cam roller" if cam.roller else "cam edge", language)
    sense = "counter-clockwise" if cam.sense > 0 else "clockwise"
    backwards = any(d.link == cam.link and d.turns and d.values[1] * cam.sense < 0.0 for d in scene.drivers)
    turning = Phrase("cam turns back" if backwards else "cam turns", sense=Phrase(sense))
    turns = spaced(" ", in_all(turning, language))
    return kind + "; " + spaced(",  ", parts) + "; " + turns


def _lift(scene: Mechanism, cam: LawCam, lift: float) -> float:
    """A lift in the scene's unit, or degrees."""
    return math.degrees(lift) if cam.turns else lift / scene.units.metres


def _unit(scene: Mechanism, cam: LawCam) -> str:
    """The unit of a lift after a number."""
    return "°" if cam.turns else f" {scene.units.length}"


def _diagram(scene: Mechanism, cam: LawCam, sheet: Sheet, language: str, begun: bool = False) -> Block:
    """The displacement diagram; with ``begun`` only its axes with the pieces of the law and the divisions."""
    law = cam.law
    span, low = _lift(scene, cam, law.greatest - law.least) or 1.0, _lift(scene, cam, law.least)
    rise = (law.greatest - law.least) / sheet.scales.length
    same = not cam.turns and HIGH[0] <= rise <= HIGH[1]
    per = span / rise if same else fitting_scale((span, span), (HIGH[1], HIGH[1]), 1.0)
    left, floor = 5.0, span / per + 6.0
    origin, top = complex(left, floor), complex(left, floor - span / per)

    def at(degree: float, lift: float) -> complex:
        return complex(left + LONG * degree / TURN, floor - (_lift(scene, cam, lift) - low) / per)

    def cell(z: complex, runs: tuple[Run, ...], anchor: str = "middle") -> None:
        labels.append(Text(z, runs, anchor, classes=("cell",)))

    curve = tuple(at(degree, part.at(degree).lift) for part in law.parts for degree in part.places(120))
    drawn: list[Primitive] = [Line(origin, origin + LONG + 5.0, strokes.DIMENSION),
                              Line(origin, top - 5.0j, strokes.DIMENSION)]
    labels: list[Primitive] = []
    divided = [(d.degree, law.least if begun else d.lift, str(k)) for k, d in enumerate(divisions(sheet))]
    free = below = 0.0  # of numbers, and of angles too wide for their pieces, from here on
    for degree, lift, name in (*divided, *((TURN, lift, "") for _, lift, _ in divided[:1])):
        foot, written = at(degree, law.least), plain(name, SMALL)
        drawn.append(Line(foot, foot + 1.0j if begun else at(degree, lift), strokes.CONSTRUCTION))
        half = runs_width(written) / 2 + NUMBERS_APART
        if name and foot.real - half >= free:
            cell(foot + 3.2j, written)
            free = foot.real + half
    for piece in law.pieces:
        start, end = at(piece.start, law.least) + 6.8j, at(piece.end, law.least) + 6.8j
        short = f"{number(math.degrees(piece.end - piece.start))}°"
        whole, bare = (rich(words, SMALL) for words in (f"{short} {_law(piece.by, language)}", short))
        room, middle, half = (end - start).real - 2.0, (start + end) / 2, runs_width(bare) / 2 + NUMBERS_APART
        if runs_width(bare) <= room:
            cell(middle + 1.0j, whole if runs_width(whole) <= room else bare)
        elif middle.real - half >= below:
            cell(middle + 3.4j, bare)
            below = middle.real + half
        drawn += [Line(z - 1.4j, z + 1.4j, strokes.CONSTRUCTION) for z in (start, end)]
    unit = _unit(scene, cam)
    h, s = (sign("ψ" if unit == "°" else letter) for letter in "hs")
    scale = sign("μ", "φ") + f" = {number(360.0 / LONG)}°/mm,  " + sign("μ", "s") + f" = {number(per)}{unit}/mm"
    scale += ",  " + h + f" = {number(span)}{unit}"
    cell(origin + 13.0j, rich(scale, SMALL + 0.4), "start")
    labels += [Text(top + (1.0 - 3.0j), rich(s, STEP)), Text(origin + (LONG + 5.5 - 1.0j), rich(sign("φ"), STEP))]
    if not begun:
        drawn.append(Polyline(curve, strokes.LINK))
    shape = Group(tuple(drawn), id="displacement", classes=("diagram",))
    return Block(Piece({"construction": (shape,), "labels": tuple(labels)}), floor + 14.0, WORKED)


def _cam(scene: Mechanism, cam: LawCam, sheet: Sheet, begun: bool = False) -> Block:
    """The cam with its construction; with ``begun`` only the circles and the follower at its start."""
    plate, drawn_at, mm = Plate(), divisions(sheet), 1.0 / sheet.scales.length
    start, far, base = drawn_at[0], max(abs(d.point) for d in drawn_at), cam.base * mm
    colour, other = (strokes.colour_of_link(scene, link) for link in (cam.link, cam.follower))
    outline = tuple(map(on_page, _curves(sheet)[-1].curve))
    profile = Polygon(outline, strokes.tint(colour), Stroke(0.7, (), colour))
    # what finds the cam lies over its tint
    plate.put("construction", *[profile] * (not begun), id=f"cam-{cam.link}", classes=("cam",))
    for step in sheet.steps[: BEGUN if begun else None]:
        _draw_inversion(plate, step, drawn_at, far + cam.roller * mm + PAST, 0.35 * base)
    sense = symbols.sense_arc(0j, max(5.0, 0.3 * base), 0.6, cam.sense, math.radians(60))
    plate.put("construction", *sense, classes=("strokes",))
    bar = strokes.LINK.coloured(other)
    follower: list[Primitive] = [Circle(on_page(start.point), cam.roller * mm, stroke=bar)] if cam.roller else []
    follower += [_face(start, 8.0, bar)] if cam.flat else []
    end = start.line if cam.turns else start.point + (far - abs(start.point) + 12.0) * start.way
    follower.append(Line.between(start.point, end, bar))
    if cam.turns:
        follower += symbols.fixed_pivot(on_page(start.line))
    elif not cam.flat:
        follower += symbols.pin(on_page(start.point), other)
    plate.put("mechanism", *follower, id=f"link-{cam.follower}", classes=("link",))
    plate.put("mechanism", *symbols.fixed_pivot(0j), id=f"point-{cam.point}", classes=("point",))
    named = {cam.point: 0j}
    if isinstance(cam.motion, SwingingFollower):
        named |= {cam.motion.pivot: start.line, cam.motion.tip: start.point}
    for name, z in named.items():
        plate.name(rich(sign(name)), z, f"label-point-{name}")
    box = ink_box(plate.piece.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    box = box.joined(Box.around(outline)).grown(6.0)
    return centred(box, WORKED, box.height, lambda around: plate.piece)


def _draw_inversion(plate: Plate, step: Step, drawn_at: Sequence[CamStation], reach: float, half: float) -> None:
    """The strokes of a step, those of divisions where these are far enough apart; lines and pivots with their numbers.

    Parameters
    ----------
    reach : how far from the axis the lines of a sliding follower are drawn (mm)
    half : of the length of a face (mm)
    """
    lines, ends, shown = list[Primitive](), dict[int, complex](), _shown(drawn_at)
    for k, stroke in enumerate(step.strokes):
        match stroke:
            case CompassArc(0j, radius):
                lines.append(Circle(0j, radius, stroke=strokes.CONSTRUCTION))
            case Curve(curve) if stroke is not step.strokes[-1]:
                lines.append(Polyline(tuple(map(on_page, curve)), strokes.PITCH))
            case _ if k not in shown:
                continue
            case CompassArc(centre, radius, _, True):
                lines.append(Circle(on_page(centre), radius, stroke=strokes.CONSTRUCTION))
            case CompassArc(pivot, arm, at):
                first, last = (cmath.phase(z - pivot) for z in (drawn_at[k].base, at))
                turned = math.remainder(last - first, TURN) / 2
                middle, beyond = first + turned, abs(turned) + 3.0 / arm
                lines.append(Arc(on_page(pivot), arm, middle - beyond, middle + beyond, strokes.CONSTRUCTION))
            case Mark(_, at):
                lines.append(Circle(on_page(at), 0.5, stroke=strokes.CONSTRUCTION))
                ends[k] = at
            case Ray(foot, along, None):
                ends[k] = foot + math.sqrt(max(reach**2 - abs(foot) ** 2, 0.0)) * along
                lines.append(Line.between(foot, ends[k], strokes.CONSTRUCTION))
            case Ray(through, along, to) if to is not None:
                lines.append(Line.between(through, to + 6.0 * along, strokes.DIRECTION))
            case Bar():
                lines.append(_face(drawn_at[k], half, strokes.CONSTRUCTION))
    for k, at in ends.items():
        plate.name(plain(str(k), SMALL), at, f"label-division-{k}", toward=(cmath.phase(at),), rank=1)
    if lines:
        plate.put("construction", *lines, classes=("strokes",), step=step.number)


def _shown(drawn_at: Sequence[CamStation]) -> list[int]:
    """The drawn divisions: neighbours are at least a millimetre and a half apart at the base circle."""
    shown: list[int] = []
    for k, d in enumerate(drawn_at):
        if all(abs(d.base - drawn_at[other].base) >= 1.5 for other in shown):
            shown.append(k)
    return shown


def _face(d: CamStation, half: float, stroke: Stroke) -> Line:
    """A face, ``half`` mm to both sides and beyond its contact."""
    across = 1j * d.way
    contact = ((d.contact - d.point) * across.conjugate()).real
    low, high = min(-half, contact - 3.0), max(half, contact + 3.0)
    return Line.between(d.point + low * across, d.point + high * across, stroke)


def _table(scene: Mechanism, cam: LawCam, sheet: Sheet) -> Block:
    """Number, cam degree, lift and pressure angle of each division, in columns beside each other."""
    unit, drawn_at = _unit(scene, cam).strip(), divisions(sheet)
    heads: list[Words] = ["", sign("φ") + " (°)", sign("ψ" if unit == "°" else "s") + f" ({unit})", sign("α") + " (°)"]
    columns = -(-len(drawn_at) // ROWS)
    count = -(-len(drawn_at) // columns)
    cells = [[str(k), f"{math.degrees(d.degree):.2f}", f"{_lift(scene, cam, d.lift):.3f}",
              f"{math.degrees(d.pressure):.2f}"] for k, d in enumerate(drawn_at)]
    wide = (WORKED - GUTTER * (columns - 1)) / columns
    widths = [share * wide for share in (0.16, 0.26, 0.32, 0.26)]
    tables = (table([heads], cells[k : k + count], widths, layer="answers") for k in range(0, len(cells), count))
    return row(*tables, gap=GUTTER)


def cams_figure(page: FigurePage, cams: Sequence[tuple[LawCam, Sheet, Sequence[Phrase]]]) -> Drawing | None:
    """A page for each cam; None without cams.

    Parameters
    ----------
    cams : each with its construction, and sentences on its values
    """
    pages = [cam_figure(page.sheet.scene, *of_cam, page.language) for of_cam in cams]
    return replace(pages[0], further=tuple(pages[1:])) if pages else None


FIGURES = (Figure("cam", cams_figure, "cams", lambda scene: bool(scene.cams), place=9),)
