"""The figure of several positions: limit positions dashed, numbered ones thin, the crank's angles between them, stroke,
swing and K, the least transmission angle at its position, and the paths of points of couplers."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from graphkin.account.headings import number
from graphkin.account.notation import Notation
from graphkin.checking.readings import read_off
from graphkin.construction import Plan, execute, plan
from graphkin.construction.board.sheet import LimitPosition, Sheet
from graphkin.construction.position.limits import TurnOfCrank
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import GAP, FigurePage, column
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes
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
)
from graphkin.drawing.ink.symbols import BLOCK_LENGTH, BLOCK_WIDTH
from graphkin.drawing.parts.mechanism import bare_mechanism
from graphkin.drawing.parts.mechanism_on_paper import MechanismOnPaper
from graphkin.drawing.place.dimensions import DimensionClearance, Parts, angle_dimension, dimension
from graphkin.drawing.place.labels import Label, Mark
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, moved_piece, obstacles_of
from graphkin.drawing.plate import Plate
from graphkin.drawing.text import plain, rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.errors import GraphkinError, Unsolvable
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Dyad, Structure
from graphkin.structure.transmission import joint_of_dyad
from graphkin.words import Neutral, Wording
from graphkin.words.symbols import RichText, sign, spaced
from graphkin.words.written import in_sentence

ROOM = 16.0  # mm around the figure, for names
OFFSETS = tuple(side * far for far in (9.0, 12.5, 17.0, 22.0, 28.0, 35.0, 43.0, 52.0) for side in (-1.0, 1.0))  # mm
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9)  # of an arc, where its number may stand
# Radii of arcs: of theta and of the crank's ways, by the crank's length, and of a swing (mm).
AROUND, WITHIN, SWING_RADII = (
    (1.18, 1.3, 1.5, 1.65, 1.9), (0.55, 0.4, 0.7, 0.85, 1.35, 1.5, 1.75, 2.0), (16.0, 20.0, 25.0, 31.0, 13.0)
)
MARKS = ("theta", "stroke", "K", "gamma")  # of a scene that says none
NARROWER = 40  # times that a place is halved in
NUMBERED, PATH = Stroke(0.18), Stroke(0.25, (4.0, 0.8, 0.5, 0.8))


_Least: TypeAlias = tuple[Sheet | Wording, float, tuple[complex, complex, complex]]


@dataclass(frozen=True)
class Shown:
    """The content of the figure, all at one scale.

    own : the scene's own position
    output, limits : a sliding pair or a link, and its low and high limit position; none where it has none
    numbered : other positions by name
    least : the position of the least transmission angle of the last group, or the reason why it is not drawn; the angle
        (rad); its joint and its two sides
    paths : places (mm) of points of couplers over a turn
    measured : readings of the whole turn (m, rad), by kind ("stroke", "swing", "K", "theta_lag")
    without : the reason for missing limit positions, by the asked stroke or swing
    """

    own: Sheet
    output: str
    limits: tuple[Sheet, ...]
    numbered: Mapping[str, Sheet]
    least: _Least | None
    paths: Mapping[str, Sequence[complex]]
    measured: Mapping[str, float]
    marks: tuple[str, ...]
    without: Mapping[Symbol, Wording] = field(default_factory=dict)


def shown_positions(planned: Plan, values: Mapping[str, float]) -> Shown:
    """The positions that a scene's ``[positions]`` show; without them the limit positions.

    Parameters
    ----------
    planned : the plan of the scene's own position
    values : the named positions, the first driver's value (rad, m) at each

    Raises
    ------
    Unsolvable : a named position that cannot be assembled or reached
    """
    structure, scene = planned.structure, planned.structure.scene
    sheet = execute(planned)
    positions = scene.question.positions
    show, marks = (positions.show, tuple[str, ...](positions.marks)) if positions else (("limits",), MARKS)
    every = positions.names[: positions.count] if positions and "all" in show else ()
    key = scene.drivers[0].key

    def drawn(value: float) -> Sheet:
        return execute(plan(structure, {**sheet.drivers, key: value}, ())).at(sheet.scales)

    numbered = {name: drawn(value) for name, value in values.items() if name in (*show, *every)}
    output = ""
    limits: tuple[Sheet, ...] = ()
    without: dict[Symbol, Wording] = {}
    measured: dict[str, float] = {}
    for output in _outputs(scene, structure) if "limits" in show else ():
        kinds = ("stroke" if "/" in output else "swing", "K", "theta_lag")
        asked = tuple(Symbol.parse(f"{kind}_{output}") for kind in kinds)
        try:
            turned = execute(plan(structure, sheet.drivers, asked)).at(sheet.scales)
            low, high = turned.limits[output]
            limits = drawn(low.value), drawn(high.value)
        except Unsolvable as stop:  # no whole turn, not of all links, or an output that turns on and on
            problem = stop.problems[0]
            without[asked[0]] = problem.found if problem.where == str(asked[0]) else problem.fact
            continue
        if low.rest or high.rest:  # the strokes are not parted by two positions of the crank
            marks = tuple(mark for mark in marks if mark != "theta")
        measured = {r.symbol.kind: float(r.value.real) for r in read_off(turned) if r.symbol in asked}
        break
    turn = _turn(structure, sheet)
    least = _least(structure, turn, drawn) if turn and "gamma" in marks else None
    paths = _paths(structure, turn, sheet) if turn else {}
    return Shown(sheet, output, limits, numbered, least, paths, measured, marks, {} if limits else without)


def _outputs(scene: Mechanism, structure: Structure) -> list[str]:
    """Outputs whose limits are shown, the likeliest first: the output of position 1, slides on the frame, rockers."""
    frame, outputs = scene.frame, []
    if scene.question.positions is not None:
        places = (scene.question.positions.first, *scene.question.positions.also.values())
        outputs += [place.stroke for place in places if place is not None and not isinstance(place, float)]
    last = [n for g in reversed(structure.groups) for n in g.links]
    outputs += [s.key for name in last for s in structure.slides if s.a == name and s.b == frame.name and not s.higher]
    outputs += [name for name in last if any(p in frame.points for p in structure.links[name].points)]
    return list(dict.fromkeys(outputs))


def _turn(structure: Structure, sheet: Sheet) -> TurnOfCrank | None:
    size = sheet.scales.length / structure.scene.size
    poses = {name: pose.scaled(size) for name, pose in sheet.poses.items()}
    if structure.scene.instead_of is not None:  # bars in a cam's place hold here alone
        return None
    if not set(structure.links) <= set(poses) or not structure.scene.drivers[0].turns:
        return None
    try:
        return TurnOfCrank.of(structure, structure.elements, sheet.drivers, poses, "positions")
    except GraphkinError:
        return None


def _paths(structure: Structure, turn: TurnOfCrank, sheet: Sheet) -> dict[str, list[complex]]:
    """The paths of points of couplers, links without a pivot or a guide on the frame."""
    frame = structure.scene.frame
    held = {n for n, link in structure.links.items() if any(p in frame.points for p in link.points)}
    held |= {n for s in structure.slides for n in (s.a, s.b) if frame.name in (s.a, s.b)} | {frame.name}
    mm = structure.scene.size / sheet.scales.length
    paths: dict[str, list[complex]] = {}
    for name, link in structure.links.items():
        for point, local in link.points.items():
            if point in structure.scene.holders and not held & set(structure.scene.holders[point]):
                paths.setdefault(point, [
                    (position.poses[name].origin + position.poses[name].axis * local / structure.scene.size) * mm
                    for position in turn.positions
                ])
    return paths


def _least(structure: Structure, turn: TurnOfCrank, drawn: Callable[[float], Sheet]) -> _Least | None:
    """The position of the least transmission angle of the last group with an inner pin."""
    group = next((g for g in reversed(structure.groups) if isinstance(g, Dyad) and g.inner.turns), None)
    if group is None:
        return None
    joint = joint_of_dyad(structure, group)

    def directions(turned: LimitPosition) -> tuple[complex, complex]:
        return joint.directions(lambda link, place: turned.poses[link].place(place / structure.scene.size))

    def gamma(turned: LimitPosition) -> float:
        first, second = directions(turned)
        across = first.conjugate() * second
        return math.atan2(abs(across.imag), abs(across.real))

    k = min(range(len(turn.positions)), key=lambda i: gamma(turn.positions[i]))
    best = turn.positions[k]
    step = turn.positions[1].value - turn.positions[0].value
    for _ in range(NARROWER):  # the least lies between its neighbours
        step /= 2
        near = ((value, turn.near(value, best.poses)) for value in (best.value - step, best.value + step))
        best = min([best, *(LimitPosition(value, poses) for value, poses in near if poses)], key=gamma)
    try:
        sheet = drawn(best.value)
    except Unsolvable as stop:  # where the links of the group lie in line
        return stop.problems[0].fact, gamma(best), (0j, 0j, 0j)
    inner = group.inner
    pose = sheet.poses[inner.a]
    at = pose.place(structure.links[inner.a].points[inner.point] / sheet.scales.length)
    first, second = directions(best)
    return sheet, gamma(best), (at, -first, -second)


# the figure


def positions_figure(page: FigurePage, shown: Shown) -> Drawing:
    """The mechanism in several positions on one figure, at its true scale."""
    sheet, letters = page.sheet, page.letters
    numbered = [_position(position, letters, NUMBERED, f"position-{name}") for name, position in shown.numbered.items()]
    limits = [_position(position, letters, strokes.LIMIT, f"limit-{shown.output.replace('/', '-')}-{end}")
              for end, position in zip(("low", "high"), shown.limits, strict=False)]
    least = []
    if shown.least is not None and isinstance(shown.least[0], Sheet):
        least = [_position(shown.least[0], letters, NUMBERED, "least-transmission"), _gamma(*shown.least[1:])]
    paths = Piece({"construction": tuple(
        Group((Polyline(tuple(map(on_page, places)), PATH),), id=f"path-{point}", classes=("path",))
        for point, places in shown.paths.items() if len(places) > 1
    )})
    back: tuple[Primitive, ...] = ()
    if (crank := _limits_of_crank(shown)) is not None:  # drawn beyond its pivot in its second limit position
        _, pivot, _, second = crank
        back = (Line.between(pivot, pivot - 1.35 * second, strokes.DIRECTION),)
    answers = Piece({"answers": back} if back else {})
    drawn = joined((paths, *numbered, *limits, *least, answers, bare_mechanism(sheet, letters)))
    whole = joined((drawn, _dimensions(shown, drawn), _numbers(shown)))
    box = ink_box(whole.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    page = page.wide_enough(box.width + 2 * ROOM)
    lines = _measured_lines(shown, page)
    figure = page.panel(
        box.height + 2 * ROOM, lambda room: with_labels(moved_piece(whole, room.centre - box.centre), room))
    return page.drawing(
        page.term("positions"), column(page.prose(lines, 3.0), figure, gap=GAP), page.scale("mechanism"),
        title="positions", said=spaced(". ", (page.term("positions"), *lines)),
    )


def _position(sheet: Sheet, letters: Notation, stroke: Stroke, id: str) -> Piece:
    """The bars, blocks and pins of one position, without names."""
    here = MechanismOnPaper(sheet, letters)
    parts: list[Primitive] = []
    for shape in here.shapes:
        pen = stroke.coloured(here.colour(shape.link))
        parts += [Polygon(tuple(map(on_page, shape.corners)), "", pen)] if shape.corners else []
        parts += [Line.between(a, b, pen) for a, b in shape.bars]
    for b in (slider for slider in here.sliders if not slider.slide.higher):
        half, across = b.along * BLOCK_LENGTH * 0.35, 1j * b.along * BLOCK_WIDTH * 0.35
        corners = (b.at + half + across, b.at + half - across, b.at - half - across, b.at - half + across)
        parts.append(Polygon(tuple(map(on_page, corners)), "", strokes.DIMENSION.coloured(here.colour(b.slide.a))))
    moving = [on_page(z) for p, z in here.places.items() if here.moving(p) and p not in here.scene.frame.points]
    parts += [Circle(z, 0.7, fill=strokes.WHITE, stroke=strokes.DIMENSION) for z in moving]
    return Piece({"mechanism": (Group(tuple(parts), id=id, classes=("position",)),)}, marks=tuple(moving))


def _crank_end(sheet: Sheet) -> tuple[complex, complex] | None:
    """Pivot and far pin of the driven crank on paper; None for another driver."""
    driver = sheet.scene.drivers[0]
    if not driver.turns:
        return None
    pivot = next(iter(sheet.scene.pivots(driver.link)), None)
    points = sheet.scene.whole.by_name[driver.link].points  # of a cam none of what stands for it
    far = [p for p in points if p != pivot and len(sheet.scene.holders[p]) > 1]
    if pivot is None or not far:
        return None
    return sheet.points[PointRef(pivot)], sheet.points[PointRef(far[0])]


def _numbers(shown: Shown) -> Piece:
    """The names of the positions at the crank's pin, or at the driven slide's."""
    labels = []
    for name, sheet in shown.numbered.items():
        ends = _crank_end(sheet)
        if ends is not None and ends[1] != ends[0]:
            labels.append(Label.of(plain(name, 2.6), on_page(ends[1]), f"label-position-{name}",
                                   toward=(cmath.phase(ends[1] - ends[0]),)))
    return Piece(labels=tuple(labels))


def _dimensions(shown: Shown, drawn: Piece) -> Piece:
    """Angles between the crank's limit positions, strokes and swings, clear of all strokes; numbers without such a
    place at their arcs or lines are labels."""
    ink = obstacles_of(drawn.drawn)
    # no number stands on a dashed limit position either
    room = DimensionClearance(replace(ink, solid=ink.solid + ink.dashed, dashed=()), None)
    parts: list[Primitive] = []
    labels: list[Label] = []
    for id, crossing, choices in (*_travel(shown), *_crank(shown)):
        taken = room.take(choices, 0 if crossing else 2, ends_on_line=crossing, crossing=crossing)
        if taken is not None:
            parts += taken
            continue
        *lines, text = choices[0]
        assert isinstance(text, Text)
        mark: Mark = 0j
        match lines:  # the number stands at the middle of its arc, or at its line, behind two extension lines
            case [Arc() as arc, *_]:
                mark = arc.at((arc.start + arc.end) / 2)
            case [_, _, Line(start, end), *_]:
                mark = start, end
        labels.append(Label(text._replace(anchor="start", id=f"label-{id}", classes=("label",)), mark))
        parts += lines
    return Piece({"answers": tuple(parts)} if parts else {}, tuple(labels))


def _limits_of_crank(shown: Shown) -> tuple[float, complex, complex, complex] | None:
    """The angle theta (rad), the pivot and the two limit positions of the crank from it; None for a crank that is
    driven from another moving link, whose driver's value is no angle on the figure."""
    if not shown.own.scene.drivers[0].turns_about(shown.own.scene.frame.name):
        return None
    lag = shown.measured.get("theta_lag")
    if not shown.limits or lag is None or "theta" not in shown.marks:
        return None
    low, high = map(_crank_end, shown.limits)
    if low is None or high is None:
        return None
    return lag, low[0], low[1] - low[0], high[1] - high[0]


_Wanted: TypeAlias = tuple[str, bool, Sequence[Parts]]
"""A dimension that wants a place: its name, whether its line may run over what is drawn, and its forms, the best
first."""


def _arcs(centre: complex, radii: Sequence[float], start: float, end: float, words: tuple[Run, ...]) -> Sequence[Parts]:
    """An angle with arcs of some radii, its number at several shares of each."""
    return [angle_dimension(on_page(centre), radius, start, end, words, share) for radius in radii for share in SHARES]


def _crank(shown: Shown) -> Iterator[_Wanted]:
    """The angle theta between the crank's limit positions, and the crank's two angles between them, in the driver's
    sense."""
    crank = _limits_of_crank(shown)
    if crank is None:
        return
    lag, pivot, first, second = crank
    radius, start = abs(first), cmath.phase(first)
    sense = -1.0 if shown.own.scene.drivers[0].values[1] < 0 else 1.0
    back = WITHIN[1], WITHIN[0], *WITHIN[2:]
    for name, from_, to, sizes in (("out", first, second, WITHIN), ("back", second, first, back)):
        begin, swept = cmath.phase(from_), (sense * (cmath.phase(to) - cmath.phase(from_))) % math.tau
        if radius > 8.0 and swept < math.tau - 0.05:
            written = rich(f"{number(math.degrees(swept), 5)}°", 2.4)
            yield name, True, _arcs(pivot, [size * radius for size in sizes], begin, begin + sense * swept, written)
    turn = math.remainder(cmath.phase(-second) - start, math.tau)
    if abs(turn) > 0.02:  # after the longer arcs, which could not go round its number
        shown_lag = rich(sign("θ") + f" = {number(math.degrees(lag), 5)}°", 2.8)
        yield "theta", True, _arcs(pivot, [size * radius for size in AROUND], start, start + turn, shown_lag)


def _travel(shown: Shown) -> Iterator[_Wanted]:
    """The stroke of a slide or the swing of a link, dimensioned between the limit positions."""
    output = shown.output
    units = shown.own.scene.units
    stroke = shown.measured.get("stroke")
    swing = shown.measured.get("swing")
    if "stroke" not in shown.marks or not shown.limits:
        return
    if stroke is not None:
        a, b = (on_page(position.poses[output.split("/")[0]].origin) for position in shown.limits)
        words = rich(sign("H") + f" = {number(stroke / units.metres, 6)} {units.length}", 2.8)
        if abs(b - a) > 1.0:
            yield f"stroke-{output.replace('/', '-')}", False, [dimension(a, b, offset, words) for offset in OFFSETS]
    elif swing is not None:
        low = shown.limits[0]
        pivot = next(iter(low.scene.pivots(output)), None)
        if pivot is not None:
            begin = cmath.phase(low.poses[output].axis)
            words = rich(sign("ψ") + f" = {number(math.degrees(swing), 5)}°", 2.8)
            yield f"swing-{output}", True, _arcs(low.points[PointRef(pivot)], SWING_RADII, begin, begin + swing, words)


def _least_words(gamma: float) -> RichText:
    return sign("γ", "min") + f" = {number(round(math.degrees(gamma), 9), 5)}°"


def _gamma(gamma: float, sides: tuple[complex, complex, complex]) -> Piece:
    """The least transmission angle as an arc at its joint."""
    joint, first, second = sides
    start, end = cmath.phase(first), cmath.phase(second)
    if abs(math.remainder(end - start, math.tau)) > math.pi / 2:  # the acute one of the two
        start = cmath.phase(-first)
    turn = math.remainder(end - start, math.tau)
    plate, words = Plate(), rich(_least_words(gamma), 2.8)
    lines = [Line.between(joint, joint + 11.0 * cmath.rect(1.0, angle), strokes.DIRECTION)
             for angle in (start, start + turn)]
    arc = angle_dimension(on_page(joint), 8.0, start, start + turn, words)[:2]
    if gamma > 0.02:  # else the two sides are one line
        plate.put("answers", *lines, *arc, id="least-gamma")
    plate.name(words, joint + 8.0 * cmath.rect(1.0, start + turn / 2), "label-least-gamma")
    return plate.piece


def _measured_lines(shown: Shown, page: FigurePage) -> list[RichText]:
    """The readings of the whole turn, in words."""
    metres, unit = shown.own.scene.units.metres, shown.own.scene.units.length
    kinds: dict[str, tuple[str, float, str]] = {
        "stroke": ("H", 1.0 / metres, f" {unit}"), "swing": ("ψ", math.degrees(1.0), "°"),
        "theta_lag": ("θ", math.degrees(1.0), "°"), "K": ("K", 1.0, ""),
    }
    said: list[RichText] = []
    if shown.limits:
        values = spaced(",  ", (
            sign(letter) + f" = {number(shown.measured[kind] * per, 7)}{after}"
            for kind, (letter, per, after) in kinds.items()
            if kind in shown.measured and (kind != "K" or "K" in shown.marks)
        ))
        said += page.said("positions of", pair=Neutral(shown.output), values=Neutral(values))
    why = [page.said("no limits", output=page.letters.vector(s), reason=reason) for s, reason in shown.without.items()]
    if shown.least is not None and not isinstance(shown.least[0], Sheet):
        why.append(page.said("no least angle", angle=_least_words(shown.least[1]), reason=shown.least[0]))
    return said + [line.with_words(in_sentence) for lines in why for line in lines]


FIGURES = (
    Figure("positions", positions_figure, "positions", lambda scene: scene.question.positions is not None,
           of_all=True, place=7),
)
