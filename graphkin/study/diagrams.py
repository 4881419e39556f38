"""Motion diagrams over the turn, as pages; with position, velocity and acceleration of outputs measured on drawn
polygons at a few positions; and coupler curves with marks at equal steps of the driver, in scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from graphkin.construction import Sheet, draft, execute, plan
from graphkin.construction.board.scales import next_of_series
from graphkin.drawing import Box, Circle, Drawing, Group, Polyline, Stroke
from graphkin.drawing.boxes import FigurePage, column, prose
from graphkin.drawing.chart import ChartPage
from graphkin.drawing.figures.centres import background
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import on_page
from graphkin.drawing.parts.mechanism import bare_mechanism
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, moved_piece
from graphkin.drawing.text import rich
from graphkin.errors import GraphkinError, Unsolvable
from graphkin.scene.model import Mechanism, forces_named
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Unit
from graphkin.solver import DriverRange
from graphkin.solver.values import FlywheelStudy
from graphkin.study import charts
from graphkin.study.force_diagrams import flywheel_page, force_page, polar_page
from graphkin.study.graphical import drawn, on_paper, ordinate_chains
from graphkin.study.quantities import course_of, rates_of
from graphkin.study.turn import Output, TurnStudy
from graphkin.words import Phrase, listed, rich_text, say, word
from graphkin.words.symbols import Words, sign

LaidOver = Mapping[Symbol, Sequence[tuple[float, float]]]
"""Values measured elsewhere: offset of the driver's range and value (SI)."""


def diagrams(
    turn: TurnStudy, language: str = "en", positions: int = 12, asked: Sequence[Symbol] = (),
    over: LaidOver = MappingProxyType({}),
) -> dict[str, ChartPage | Drawing]:
    """The motion diagrams of each output and the curve of each coupler point, by name of file; if quantities are asked
    for, only the diagram of each of these.

    Parameters
    ----------
    positions : the number of positions whose values, measured on the drawn polygons, are drawn on the curves; 0 for
        none
    over : values measured elsewhere, drawn on the curves
    """
    axis = charts.DriverAxis(turn.reach)
    if asked:
        made: dict[str, ChartPage | Drawing] = {}
        for quantity in asked:
            if quantity.is_load:
                made |= _force_pages(turn, axis, quantity, language)
            else:
                others = over.get(quantity, ())
                panel = charts.motion_panel(turn, axis, quantity, (), others)
                facts = _apart(turn, quantity, others, language)
                made[charts.figure_name([quantity])] = charts.chart_page(axis, [panel], facts, language)
        return made
    quantities = [o.quantity for o in turn.outputs]
    dots = measured(turn.reach, quantities, positions) if positions else {q: [] for q in quantities}
    pages: dict[str, ChartPage | Drawing] = {}
    for output in turn.outputs:
        quantity = output.quantity
        page = _motion_page(turn, axis, output, dots[quantity], over, language)
        pages[charts.figure_name(rates_of(quantity))] = page
    known = turn.reach.known
    points = [(point, link) for point, link in coupler_points(turn.scene)
              if np.isfinite(known.position(point, link)).all()]
    if points:  # of a mechanism that is singular throughout there are none
        values = turn.scene.by_driver(known.values[0])
        links = [Symbol("theta", link=link.name) for link in turn.scene.links]
        with suppress(Unsolvable):  # a mechanism that no pencil can draw has no such page
            sheet = draft(turn.reach.structure, values, links)
            pages |= {f"curve-{point}": curve_page(sheet, axis, point, link, language) for point, link in points}
    return pages | _balance_pages(turn, language)


def _force_pages(
    turn: TurnStudy, axis: charts.DriverAxis, quantity: Symbol, language: str
) -> dict[str, ChartPage | Drawing]:
    """A force or a moment over the driver; the polar diagram too of a force known somewhere."""
    name = charts.figure_name([quantity])
    pages: dict[str, ChartPage | Drawing] = {name: force_page(turn.reach, quantity, language)}
    if quantity.is_vector and np.isfinite(course_of(quantity, turn.reach, axis.motion)).any():
        pages[name.replace("diagram", "polar", 1)] = polar_page(turn.reach, quantity, language)
    return pages


def _balance_pages(turn: TurnStudy, language: str) -> dict[str, ChartPage | Drawing]:
    """The balancing load of a mechanism with loads, and the flywheel that it asks for."""
    pages: dict[str, ChartPage | Drawing] = {}
    for force in forces_named(turn.scene):
        if force.kind in ("F", "M") and not force.other:
            with suppress(Unsolvable):  # the text says why there are no forces
                pages[f"diagram-{force}"] = force_page(turn.reach, force, language)
    if isinstance(turn.flywheel, FlywheelStudy):
        pages["flywheel"] = flywheel_page(turn.reach, turn.flywheel, language)
    return pages


def _motion_page(
    turn: TurnStudy, axis: charts.DriverAxis, output: Output, dots: Sequence[tuple[float, ...]], over: LaidOver,
    language: str,
) -> ChartPage:
    """Position, rate and second rate of an output, below each other."""
    quantity = output.quantity
    panels = [
        charts.motion_panel(turn, axis, q, [(d[0], d[k]) for d in dots], over.get(q, ()))
        for k, q in enumerate(rates_of(quantity), 1)
    ]
    limits = sorted(
        {float(axis.at(np.array(e.offset))) for e in (*output.lows, *output.highs) if e.kind != "end"}
    )  # those at the ends of the axis are its frame
    return charts.chart_page(axis, panels, _facts(turn, output, language), language, limits)


def _apart(turn: TurnStudy, quantity: Symbol, over: Sequence[tuple[float, float]], language: str) -> list[str]:
    """The deviation of values from elsewhere from theory, if there are any: root of the mean square, and the
    greatest."""
    if not over:
        return []
    at, read = np.array(over, dtype=float).T
    deviation = read - np.asarray(course_of(quantity, turn.reach, turn.reach.motion(at)), dtype=float)
    if quantity.measure.is_angle:
        deviation = np.remainder(deviation + np.pi, 2 * np.pi) - np.pi
    deviation = np.abs(deviation[np.isfinite(deviation)])
    if not len(deviation):
        return []
    unit = quantity.unit(turn.scene.units)
    sizes = np.sqrt(np.mean(deviation**2)), deviation.max()
    mean, greatest = (_said(float(size), unit, 3) for size in sizes)
    return [say(Phrase("laid over apart", values=len(deviation), mean=mean, greatest=greatest), language)]


def _facts(turn: TurnStudy, output: Output, language: str) -> list[Words]:
    """Stroke, K and limit positions in words."""
    scene, quantity, stroke = turn.scene, output.quantity, output.stroke
    if stroke is None:
        return [word(output.without, language)]
    unit = quantity.unit(scene.units)
    kind = "swing" if quantity.kind == "theta" else "stroke"
    facts: list[Words] = [say(Phrase(f"{kind} is", **{kind: _said(stroke, unit)}), language)]
    back = turn.quick_return(output)
    if back is not None:
        facts.append(rich_text(Phrase("K is", ratio=charts.number(back[0])), language))
    drivers = sorted(e.driver for e in (*output.lows, *output.highs))
    places = [_said(value, scene.unit_of(scene.drivers[0])) for value in drivers]
    facts.append(say(Phrase("limits at", places=listed(places)), language))
    return facts


def _said(value: float, unit: Unit, digits: int = 6) -> str:
    """A value (SI) in its unit."""
    return unit.beside(charts.number(unit.of(value), digits))


def measured(
    reach: DriverRange, outputs: Sequence[Symbol], count: int = 12
) -> dict[Symbol, list[tuple[float, ...]]]:
    """For each output (its angle or travel) the readings of the drawing at evenly spread positions.

    Returns
    -------
    for each output a list of (offset of the driver, position, velocity, acceleration), SI, measured on paper; positions
    that cannot be drawn, or outputs that lie behind a group that compass and ruler cannot draw, are left out
    """
    scene = reach.scene
    known = {chain[0]: chain for chain in ordinate_chains(scene) if len(chain) == 3}
    chains = {q: known[q] for q in outputs if q in known}
    readings: dict[Symbol, list[tuple[float, ...]]] = {q: [] for q in outputs}
    asked = [on_paper(scene, symbol)[0] for chain in chains.values() for symbol in chain]
    low, high = reach.ends
    count *= max(reach.turns, 1)
    sheet: Sheet | None = None
    for k in range(count if asked else 0):
        offset = low + (high - low) * (k / count if reach.full else (k + 0.5) / count)
        values = scene.by_driver(reach.values(np.array([offset]))[0])
        try:
            # the assembly is followed from the last position
            sheet = execute(plan(reach.structure, values, asked, near=sheet))
        except GraphkinError:
            continue
        for quantity, chain in chains.items():
            read = [drawn(sheet, symbol) for symbol in chain]
            if None not in read:
                readings[quantity].append((offset, *(value for value in read if value is not None)))
    return readings


TICKS = 12
DOT = 0.85  # mm, radius of a mark on the curve
CURVE_ROOM = complex(150.0, 180.0)  # mm, width and height at most of a coupler curve with its mechanism


def coupler_points(scene: Mechanism) -> tuple[tuple[str, str], ...]:
    """Points of couplers, links neither pivoted to the frame nor sliding on it, with their link; not points that other
    links share."""
    plain = {link.name for link in scene.links if scene.pivots(link.name) or scene.rail(link.name)}
    points: list[tuple[str, str]] = []
    for link in scene.links:
        if link.name in plain:
            continue
        for point in link.points:
            if not any(h in plain for h in scene.holders[point]) and point not in [p for p, _ in points]:
                points.append((point, link.name))
    return tuple(points)


def curve_page(sheet: Sheet, axis: charts.DriverAxis, point: str, link: str, language: str) -> Drawing:
    """The path of a coupler point in scale, with marks at equal steps of the driver, and the mechanism of a sheet: at
    its own position, or in the middle of its range where that is singular."""
    reach, scene = axis.reach, axis.scene
    low, high = reach.ends
    path = axis.motion.position(point, link)
    path = path[np.isfinite(path)]
    steps = TICKS * max(reach.turns, 1)
    if reach.full:
        ticks = (axis.first + np.arange(steps) * (high - low) / steps) % high
    else:
        values = np.radians(axis.ticks) if reach.driver.turns else axis.ticks * scene.units.metres
        ticks = (values - reach.start[0]) * reach.sense
    at = reach.motion(ticks).position(point, link)
    places = [complex(reach.known.position(p)[0]) for p in scene.holders]
    world = Box.around([*path.tolist(), *places])
    need = 1e3 * max(world.width / CURVE_ROOM.real, world.height / CURVE_ROOM.imag)
    sheet = sheet.at(replace(sheet.scales, length=1e-3 * next_of_series(need))) if need else sheet
    page = FigurePage.of(sheet, "curve", language, None)
    mm = 1.0 / sheet.scales.length
    numbers = np.round(scene.unit_of(scene.drivers[0]).of(reach.value(ticks)), 9) + 0.0
    numbers = numbers % (360 * reach.turns) if reach.full else numbers
    marks = [(on_page(complex(z) * mm), n) for z, n in zip(at, numbers, strict=True) if np.isfinite(z)]
    unit = "°" if reach.driver.turns else ""
    labels = tuple(Label.of(rich(f"{charts.number(n, 4)}{unit}", 2.5), z) for z, n in marks)
    line = Polyline(tuple(on_page(complex(z) * mm) for z in path), Stroke(0.5))
    title = rich_text(Phrase("curve of point", point=sign(point)), language)
    group = Group((line, *(Circle(z, DOT, strokes.BLACK, Stroke(0.25)) for z, _ in marks)), id=f"curve-{point}",
                  classes=("curve",), title=title.plain())
    whole = joined((background(bare_mechanism(sheet, page.letters)), Piece({"answers": (group,)}, labels)))
    content = (ink_box(whole.drawn) or Box.around(line.points)).grown(8.0)
    page = page.wide_enough(content.width)

    def drawn(room: Box) -> Piece:
        origin = room.centre - content.centre
        return moved_piece(with_labels(whole, room.moved(-origin)), origin)

    facts = []
    if reach.driver.turns and reach.full:
        begin = 0 if reach.sense > 0 else 360
        facts.append(say(Phrase("ticks at", step=str(360 // TICKS), begin=str(begin)), language))
    body = column(page.panel(content.height, drawn), prose(facts, page.width, 3.0))
    made = page.drawing(title, body, page.scale("mechanism"), title="mechanism", said="; ".join(facts))
    return replace(made, title=f"{group.title}: {scene.question.title_in(language)}")
