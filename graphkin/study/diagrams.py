"""Motion diagrams over the turn, as pages; with position, velocity and acceleration of outputs as they are measured off
drawn polygons at a few positions."""

from __future__ import annotations

import cmath
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from graphkin.construction import Plan, Sheet, execute, plan
from graphkin.drawing import Box, Drawing
from graphkin.drawing.chart import ChartPage, add_legend, add_panel, add_words, look
from graphkin.errors import GraphkinError
from graphkin.scene.force_names import force_names
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Unit
from graphkin.solver import DriverRange
from graphkin.solver.flywheel import FlywheelStudy
from graphkin.study.coupler import coupler_points, curve_page
from graphkin.study.diagram_panels import LIMIT, DiagramPanel, draw_panel, panel_of, signs_of
from graphkin.study.driver_axis import (
    HEIGHT,
    LEFT,
    RIGHT,
    WIDTH,
    DriverAxis,
    driver_axis,
    heading,
    number,
    title_of,
)
from graphkin.study.flywheel_page import flywheel_page
from graphkin.study.force_diagrams import force_page, polar_page
from graphkin.study.quantities import Quantity, link_quantities, slide_quantities
from graphkin.study.turn import Output, TurnStudy
from graphkin.words import Phrase, say, word
from graphkin.words.written import in_markup

if TYPE_CHECKING:
    from graphkin.drawing.chart import Figure

__all__ = ["LaidOver", "diagrams", "measured"]

LaidOver = Mapping[Quantity, Sequence[tuple[float, float]]]
"""Values measured elsewhere: offset of the driver's range and value (SI)."""

TOP, GAP = 40.0, 10.0
ASKED_HEIGHT = 95.0  # mm, of the panel of one quantity alone


def diagrams(
    turn: TurnStudy, language: str = "en", positions: int = 12, asked: Sequence[Quantity] = (),
    over: LaidOver = MappingProxyType({}),
) -> dict[str, ChartPage | Drawing]:
    """The motion diagrams of each output and the curve of each coupler point, by name of file; where quantities are
    asked for, the diagram of each of these alone.

    Parameters
    ----------
    positions : where the values measured off the drawn polygons are laid over the curves; 0 for none
    over : what somebody else has measured, laid over the curves
    """
    axis = driver_axis(turn.reach, language)
    if asked:
        made: dict[str, ChartPage | Drawing] = {}
        for quantity in asked:
            if quantity.is_load:
                made |= _force_pages(turn, quantity, language)
            else:
                made[f"diagram-{_file(quantity)}"] = _asked_page(turn, axis, quantity, over, language)
        return made
    quantities = [o.quantity for o in turn.outputs]
    dots = measured(turn.reach, quantities, positions) if positions else {q: [] for q in quantities}
    pages: dict[str, ChartPage | Drawing] = {}
    for output in turn.outputs:
        quantity = output.quantity
        kind = "link" if quantity.kind == "theta" else "slide"
        name = f"motion-{kind}-{quantity.of.replace('/', '-')}"
        pages[name] = _motion_page(turn, axis, output, dots[quantity], over, language)
    for point, link in coupler_points(turn.scene):
        if not np.isfinite(turn.reach.known.position(point, link)).all():
            continue  # singular throughout
        pages[f"curve-{point}"] = curve_page(turn, axis, point, link, language)
    return pages | _balance_pages(turn, language)


def _file(quantity: Quantity) -> str:
    return quantity.name.replace("/", "-").replace("@", "")


def _force_pages(turn: TurnStudy, quantity: Quantity, language: str) -> dict[str, ChartPage | Drawing]:
    """A force or a moment over the driver; of a force the polar diagram too."""
    pages: dict[str, ChartPage | Drawing] = {f"diagram-{_file(quantity)}": force_page(turn.reach, quantity, language)}
    if quantity.is_size:
        pages[f"polar-{_file(quantity)}"] = polar_page(turn.reach, quantity, language)
    return pages


def _balance_pages(turn: TurnStudy, language: str) -> dict[str, ChartPage | Drawing]:
    """What balances a mechanism that carries loads, and the flywheel that it asks for."""
    pages: dict[str, ChartPage | Drawing] = {}
    for name, kind in force_names(turn.scene).items():
        if name[:2] in ("F_", "M_") and "/" not in name:
            pages[f"diagram-{name}"] = force_page(turn.reach, Quantity(kind, name), language)
    if isinstance(turn.flywheel, FlywheelStudy):
        pages["flywheel"] = flywheel_page(turn.reach, turn.flywheel, language)
    return pages


def _motion_page(
    turn: TurnStudy, axis: DriverAxis, output: Output, dots: Sequence[tuple[float, ...]], over: LaidOver, language: str,
) -> ChartPage:
    scene, quantity = turn.scene, output.quantity
    turns = quantity.kind == "theta"
    curves = link_quantities(quantity.of) if turns else slide_quantities(quantity.of)
    traced = {t.quantity: t for t in turn.curves}
    panels = [
        panel_of(turn, axis, q, traced.get(q), [(d[0], d[k + 1]) for d in dots], over.get(q, ()))
        for k, q in enumerate(curves)
    ]
    limits = sorted(
        {float(axis.at(np.array(e.offset))) for e in (output.low, output.high) if e is not None and e.kind != "end"}
    )  # those at the ends of the axis are its frame
    title = say(Phrase("motion of link" if turns else "motion of slide", (quantity.of.split("/")[0],)), language)
    facts = _facts(turn, output, language)
    tall = (HEIGHT - TOP - 20.0 - 2 * GAP) / 3

    def paint(figure: Figure) -> None:
        add_words(figure, *heading(scene, in_markup(title), facts, language))
        entries = signs_of(panels, language)
        if limits:
            entries.append((look(LIMIT), word("limit marks", language)))
        add_legend(figure, complex(LEFT, TOP - 9.5), entries)
        for k, panel in enumerate(panels):
            top = TOP + k * (tall + GAP)
            last = k == len(panels) - 1
            box = Box(LEFT, top, WIDTH - RIGHT, top + tall)
            name = panel.quantity.name.replace("/", "-")
            axes = add_panel(figure, box, name, _headed(panel, language), axis.title * last)
            draw_panel(axes, panel, axis, limits, language)
            axes.tick_params(labelbottom=last)

    return ChartPage(
        WIDTH, HEIGHT, paint, title=f"{title}: {title_of(scene, language)}", desc=" ".join(facts), lang=language,
        metadata={"scene": scene.name, "units": scene.units.length, "output": quantity.of},
    )  # fmt: skip


def _asked_page(
    turn: TurnStudy, axis: DriverAxis, quantity: Quantity, over: LaidOver, language: str
) -> ChartPage:
    """The diagram of one quantity over the driver."""
    scene = turn.scene
    traced = next((t for t in turn.curves if t.quantity == quantity), None)
    panel = panel_of(turn, axis, quantity, traced, [], over.get(quantity, ()))
    title = say(Phrase("diagram of", (panel.title,)), language)
    facts = [panel_fact] if (panel_fact := _apart(turn, quantity, over.get(quantity, ()), language)) else []

    def paint(figure: Figure) -> None:
        add_words(figure, *heading(scene, title, facts, language))
        add_legend(figure, complex(LEFT, TOP - 9.5), signs_of([panel], language))
        box = Box(LEFT, TOP, WIDTH - RIGHT, TOP + ASKED_HEIGHT)
        axes = add_panel(figure, box, panel.quantity.name.replace("/", "-"), _headed(panel, language), axis.title)
        draw_panel(axes, panel, axis, [], language)

    return ChartPage(
        WIDTH, TOP + ASKED_HEIGHT + 20.0, paint, title=f"{quantity.name}: {title_of(scene, language)}",
        desc=quantity.name, lang=language,
        metadata={"scene": scene.name, "units": scene.units.length, "quantity": quantity.name},
    )  # fmt: skip


def _headed(panel: DiagramPanel, language: str) -> str:
    """The title of a panel; with it that the quantity grows without bound."""
    more = word("list comma", language) + word("unbounded", language)
    return panel.title + more * panel.unbounded


def _apart(turn: TurnStudy, quantity: Quantity, over: Sequence[tuple[float, float]], language: str) -> str:
    """How far values from elsewhere lie off the theory: root of the mean square, and the most."""
    if not over:
        return ""
    at, read = np.array(over, dtype=float).T
    off = read - np.asarray(quantity.values(turn.reach, turn.reach.motion(at)), dtype=float)
    if quantity.measure == "angle":
        off = np.remainder(off + np.pi, 2 * np.pi) - np.pi
    off = np.abs(off[np.isfinite(off)])
    if not len(off):
        return ""
    unit = quantity.unit(turn.scene)
    sizes = np.sqrt(np.mean(off**2)), off.max()
    told = (_said(float(v), unit, 3) for v in sizes)
    return say(Phrase("laid over apart", (len(off), *told)), language)


def _facts(turn: TurnStudy, output: Output, language: str) -> list[str]:
    """Stroke, K and limit positions in words."""
    scene, quantity, stroke = turn.scene, output.quantity, output.stroke
    if stroke is None:
        return [word(output.without, language)]
    unit = quantity.unit(scene)
    key = "swing is" if quantity.kind == "theta" else "stroke is"
    facts = [say(Phrase(key, (_said(stroke, unit),)), language)]
    back = turn.quick_return(output)
    if back is not None:
        facts.append(say(Phrase("K is", (number(back[0]),)), language).replace("K", "$K$", 1))
    low, high = output.low, output.high
    assert low is not None
    assert high is not None
    places = [_said(value, scene.unit_of(scene.drivers[0])) for value in sorted((low.driver, high.driver))]
    facts.append(say(Phrase("limits at", (", ".join(places),)), language))
    return facts


def _said(value: float, unit: Unit, digits: int = 6) -> str:
    """A value (SI) in its unit."""
    return unit.beside(number(unit.of(value), digits))


def measured(
    reach: DriverRange, outputs: Sequence[Quantity], count: int = 12
) -> dict[Quantity, list[tuple[float, ...]]]:
    """For each output (its angle or travel) what the drawing gives at evenly spread positions.

    Returns
    -------
    for each output a list of (offset of the driver, position, velocity, acceleration), SI, measured on paper; positions
    that cannot be drawn, or outputs that lie behind a group that compass and ruler cannot draw, are left out
    """
    scene = reach.scene
    asked = [s for q in outputs for s in _symbols(scene, q)]
    found: dict[Quantity, list[tuple[float, ...]]] = {q: [] for q in outputs}
    if not asked:
        return found
    low, high = reach.ends
    count *= max(reach.turns, 1)
    last: Plan | None = None
    sheet: Sheet | None = None
    for k in range(count):
        offset = low + (high - low) * (k / count if reach.full else (k + 0.5) / count)
        values = {d.key: float(v) for d, v in zip(scene.drivers, reach.start, strict=True)}
        values[scene.drivers[0].key] = float(reach.value(np.array(offset)))
        try:
            # the assembly is followed from the last position
            last = plan(reach.structure, values, asked, near=sheet, follows=last)
            sheet = execute(last)
        except GraphkinError:
            continue
        for quantity in outputs:
            read = _read(sheet, quantity)
            if read is not None:
                found[quantity].append((offset, *read))
    return found


def _symbols(scene: Mechanism, quantity: Quantity) -> list[Symbol]:
    if quantity.kind == "theta":
        return [Symbol("omega", link=quantity.of), Symbol("alpha", link=quantity.of)]
    pin = _pin(scene, quantity.of)
    return [Symbol("v", PointRef(pin)), Symbol("a", PointRef(pin))] if pin else []


def _pin(scene: Mechanism, key: str) -> str | None:
    """The first point of a link that slides along the frame."""
    return next((s.pin for s in scene.slidings if s.key == key and s.on == scene.frame.name), None)


def _read(sheet: Sheet, quantity: Quantity) -> tuple[float, float, float] | None:
    scene, name = sheet.scene, quantity.of
    if quantity.kind == "theta":
        if name not in sheet.poses or name not in sheet.omega or name not in sheet.alpha:
            return None
        return cmath.phase(sheet.poses[name].axis), sheet.omega[name].value, sheet.alpha[name].value
    pin = _pin(scene, name)
    pair = next(s for s in scene.slidings if s.key == name)
    guide = scene.frame.guides[pair.guide]
    speeds, pushes = sheet.vectors("velocity"), sheet.vectors("acceleration")
    if pin is None or PointRef(pin) not in sheet.points:
        return None
    v, a = speeds.get(Symbol("v", PointRef(pin))), pushes.get(Symbol("a", PointRef(pin)))
    if v is None or a is None:
        return None
    along = guide.direction.conjugate()
    place = sheet.points[PointRef(pin)] * sheet.scales.length
    arm = scene.by_name[pair.link].points[pin] * pair.turn
    return (
        ((place - guide.through) * along).real - arm.real,
        (v.span * along).real * sheet.scales.velocity,
        (a.span * along).real * sheet.scales.acceleration,
    )
