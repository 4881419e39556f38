"""Motion diagrams over the turn, as pages."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from graphkin.drawing import Box, ChartPage, Drawing
from graphkin.drawing.chart import (
    BEHIND,
    SOLID_AND_DASHED,
    add_labels,
    add_legend,
    add_panel,
    add_words,
    count_steps,
    degree_step,
    look,
    marker,
)
from graphkin.drawing.primitives import Stroke
from graphkin.scene.model import AngleDriver
from graphkin.solver import DriverRange
from graphkin.study.coupler import coupler_points, curve_page
from graphkin.study.driver_axis import (
    HEIGHT,
    LEFT,
    RIGHT,
    WIDTH,
    DriverAxis,
    driver_axis,
    driver_number,
    heading,
    number,
    title_of,
)
from graphkin.study.measured import measured
from graphkin.study.quantities import Quantity, link_quantities, slide_quantities
from graphkin.study.trace import Extreme, Traced
from graphkin.study.turn import Output, TurnStudy
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    from graphkin.drawing.chart import Axes, Figure

__all__ = ["diagrams"]

Array = NDArray[np.float64]

TOP, GAP = 40.0, 10.0
BESIDE = 1e-3
"""Of the driver's range: so far beside a place that may be a dead point."""
MARGIN = 0.14
"""Of the range of values, above and below the curve: room for the labels of its extremes."""
ZERO = Stroke(0.18)
ASKED_HEIGHT = 95.0  # mm, of the panel of one quantity alone
LIMIT = Stroke(0.18, (4.0, 0.9, 0.9, 0.9))


def diagrams(
    turn: TurnStudy, language: str = "en", positions: int = 12, asked: Sequence[Quantity] = ()
) -> dict[str, ChartPage | Drawing]:
    """The motion diagrams of each output and the curve of each coupler point, by name of file; where quantities are
    asked for, the diagram of each of these alone.

    Parameters
    ----------
    positions : where the values measured off the drawn polygons are laid over the curves; 0 for none
    """
    if asked:
        names = [q.name.replace("/", "-").replace("@", "") for q in asked]
        return {f"diagram-{name}": _asked_page(turn, q, language) for name, q in zip(names, asked, strict=True)}
    quantities = [o.quantity for o in turn.outputs]
    dots = measured(turn.reach, quantities, positions) if positions else {q: [] for q in quantities}
    pages: dict[str, ChartPage | Drawing] = {}
    for output in turn.outputs:
        quantity = output.quantity
        kind = "link" if quantity.kind == "theta" else "slide"
        pages[f"motion-{kind}-{quantity.of.replace('/', '-')}"] = _motion_page(turn, output, dots[quantity], language)
    for point, link in coupler_points(turn.scene):
        pages[f"curve-{point}"] = curve_page(turn, point, link, language)
    return pages


@dataclass(frozen=True)
class _Panel:
    """What one panel shows, in units of the figure.

    curve, dots : shape (n, 2), driver and value; extremes : with the value as it is shown, in ``span`` alone
    """

    quantity: Quantity
    title: str
    curve: Array
    dots: Array
    extremes: tuple[tuple[Extreme, float, float], ...]
    span: tuple[float, float]

    @property
    def counts_degrees(self) -> bool:
        return self.quantity.kind == "theta" and self.span[1] - self.span[0] > 60 * (1 + 2 * MARGIN)


def _motion_page(turn: TurnStudy, output: Output, dots: Sequence[tuple[float, ...]], language: str) -> ChartPage:
    scene, quantity = turn.scene, output.quantity
    turns = quantity.kind == "theta"
    curves = link_quantities(quantity.of) if turns else slide_quantities(quantity.of)
    traced = {t.quantity: t for t in turn.curves}
    axis = driver_axis(turn.reach, language)
    panels = [_panel(turn, axis, q, traced.get(q), [(d[0], d[k + 1]) for d in dots]) for k, q in enumerate(curves)]
    limits = sorted(
        {float(axis.at(np.array(e.offset))) for e in (output.low, output.high) if e is not None and e.kind != "end"}
    )  # those at the ends of the axis are its frame
    kinds = {e.kind for panel in panels for e, _, _ in panel.extremes}
    title = say(Phrase("motion of link" if turns else "motion of slide", (quantity.of.split("/")[0],)), language)
    facts = _facts(turn, output, language)
    tall = (HEIGHT - TOP - 20.0 - 2 * GAP) / 3

    def paint(figure: Figure) -> None:
        add_words(figure, *heading(scene, title.replace("$", "$$"), facts, language))
        entries = [(look(SOLID_AND_DASHED[0]), word("analytic curve", language))]
        if dots:
            entries.append((marker("circle"), word("measured dots", language)))
        if "max" in kinds:
            entries.append((marker("up"), word("greatest", language)))
        if "min" in kinds:
            entries.append((marker("down"), word("least", language)))
        if limits:
            entries.append((look(LIMIT), word("limit marks", language)))
        add_legend(figure, complex(LEFT, TOP - 9.5), entries)
        for k, panel in enumerate(panels):
            top = TOP + k * (tall + GAP)
            last = k == len(panels) - 1
            box = Box(LEFT, top, WIDTH - RIGHT, top + tall)
            axes = add_panel(figure, box, panel.quantity.name.replace("/", "-"), panel.title, axis.title * last)
            _draw(axes, panel, axis, limits)
            axes.tick_params(labelbottom=last)

    return ChartPage(
        WIDTH, HEIGHT, paint, title=f"{title}: {title_of(scene, language)}", desc=" ".join(facts), lang=language,
        metadata={"scene": scene.name, "units": scene.units.length, "output": quantity.of},
    )  # fmt: skip


def _asked_page(turn: TurnStudy, quantity: Quantity, language: str) -> ChartPage:
    """The diagram of one quantity over the driver."""
    scene = turn.scene
    axis = driver_axis(turn.reach, language)
    traced = next((t for t in turn.curves if t.quantity == quantity), None)
    panel = _panel(turn, axis, quantity, traced, [])
    title = say(Phrase("diagram of", (panel.title,)), language)
    kinds = [e.kind for e, _, _ in panel.extremes]

    def paint(figure: Figure) -> None:
        add_words(figure, *heading(scene, title, [], language))
        entries = [(look(SOLID_AND_DASHED[0]), word("analytic curve", language))]
        entries += [(marker("up"), word("greatest", language))] if "max" in kinds else []
        entries += [(marker("down"), word("least", language))] if "min" in kinds else []
        add_legend(figure, complex(LEFT, TOP - 9.5), entries)
        box = Box(LEFT, TOP, WIDTH - RIGHT, TOP + ASKED_HEIGHT)
        axes = add_panel(figure, box, panel.quantity.name.replace("/", "-"), panel.title, axis.title)
        _draw(axes, panel, axis, [])

    return ChartPage(
        WIDTH, TOP + ASKED_HEIGHT + 20.0, paint, title=f"{quantity.name}: {title_of(scene, language)}",
        desc=quantity.name, lang=language,
        metadata={"scene": scene.name, "units": scene.units.length, "quantity": quantity.name},
    )  # fmt: skip


def _draw(axes: Axes, panel: _Panel, axis: DriverAxis, limits: Sequence[float]) -> None:
    """One panel; zero lines and limit positions lie behind the curve."""
    axes.set_xlim(axis.left, axis.right)
    axes.set_ylim(*panel.span)
    count_steps(axes.xaxis, axis.step)
    count_steps(axes.yaxis, degree_step(panel.span[1] - panel.span[0], 7) if panel.counts_degrees else None)
    axes.axhline(0.0, zorder=BEHIND, **look(ZERO))
    for limit in limits:
        axes.axvline(limit, zorder=BEHIND, **look(LIMIT))
    axes.plot(*panel.curve.T, **look(SOLID_AND_DASHED[0]))
    axes.plot(*panel.dots.T, **marker("circle"))
    labels, toward = [], []
    for kind, x, value in ((e.kind, x, value) for e, x, value in panel.extremes):
        axes.plot([x], [value], **marker("up" if kind == "max" else "down"))
        labels.append((number(value), (x, value)))
        toward.append((math.pi / 2 if kind == "max" else -math.pi / 2,))
    add_labels(axes, labels, toward=toward)


def _facts(turn: TurnStudy, output: Output, language: str) -> list[str]:
    """Stroke, K and limit positions in words."""
    scene, quantity, stroke = turn.scene, output.quantity, output.stroke
    if stroke is None:
        return [word(output.without, language)]
    unit = quantity.unit(scene, degrees=True)
    key = "swing is" if quantity.kind == "theta" else "stroke is"
    facts = [say(Phrase(key, (_with_unit(quantity.in_units(scene, stroke, degrees=True), unit),)), language)]
    back = turn.quick_return(output)
    if back is not None:
        facts.append(say(Phrase("K is", (number(back[0]),)), language).replace("K", "$K$", 1))
    low, high = output.low, output.high
    assert low is not None
    assert high is not None
    driver = "deg" if isinstance(scene.drivers[0], AngleDriver) else scene.units.length
    places = [_with_unit(driver_number(scene, e.driver), driver) for e in sorted((low, high), key=lambda e: e.driver)]
    facts.append(say(Phrase("limits at", (", ".join(places),)), language))
    return facts


def _unit_words(unit: str) -> str:
    """A unit as it is printed."""
    return {"deg": "°"}.get(unit, unit.replace("s2", "s²"))


def _with_unit(value: float, unit: str) -> str:
    """A number with its unit."""
    return f"{number(value, 6)}{'' if unit == 'deg' else ' '}{_unit_words(unit)}"


def _panel(
    turn: TurnStudy, axis: DriverAxis, quantity: Quantity, traced: Traced | None, dots: Sequence[tuple[float, float]]
) -> _Panel:
    reach, scene = turn.reach, turn.scene
    offsets = axis.offsets
    x = axis.at(offsets)
    values = _shown(axis, quantity, offsets, quantity.values(reach, reach.motion(offsets)))
    if reach.full:
        # the axis ends where it begins, a turn later
        x[0], x[-1] = axis.left, axis.right
        gain = _gain(reach, quantity) if quantity.kind == "theta" else 0.0
        values[-1] = values[0] + quantity.in_units(scene, gain, degrees=True)
    letter, name = str(quantity.kind), quantity.of.split("/")[0]
    if quantity.symbol is not None:
        letter, name = quantity.symbol.kind, str(quantity.symbol).removeprefix(f"{quantity.symbol.kind}_")
    greek = {"theta": "θ", "omega": "ω", "alpha": "α", "gamma": "γ", "pressure": "α^{p}", "d": "l"}.get(letter, letter)
    title = f"${greek}_{{{name.replace('@', '')}}}$ ({_unit_words(quantity.unit(scene, degrees=True))})"
    at = np.array([d[0] for d in dots])
    read = np.array([d[1] for d in dots])
    if len(dots) and quantity.kind == "theta":
        # an angle measured on paper tells no whole turns
        near = quantity.values(reach, reach.motion(at))
        read = read + 2 * np.pi * np.rint((near - read) / (2 * np.pi))
    points = np.stack([axis.at(at), _shown(axis, quantity, at, read)], axis=1) if len(dots) else np.zeros((0, 2))
    points = points[np.isfinite(points).all(axis=1)]
    curve = np.stack([x, values], axis=1)
    low, high = _span(curve, points, bounded=reach.full or quantity.is_position)
    span = low - MARGIN * (high - low), high + MARGIN * (high - low)
    extremes = [e for e in (traced.extremes if traced else ()) if e.kind != "end"]
    places = np.array([e.offset for e in extremes])
    shown = _shown(axis, quantity, places, np.array([e.value for e in extremes]))
    marked = [
        (e, float(place), float(value)) for e, place, value in zip(extremes, axis.at(places), shown, strict=True)
        if span[0] <= value <= span[1]
    ]  # fmt: skip
    return _Panel(quantity, title, curve, points, tuple(marked), span)


def _shown(axis: DriverAxis, quantity: Quantity, offset: Array, values: Array) -> Array:
    """Values in units of the figure; an angle of a link without a jump along the axis."""
    reach = axis.reach
    values = np.asarray(values, dtype=float)
    if quantity.kind == "theta" and reach.full:
        values = np.where(offset < axis.first - 1e-12, values + _gain(reach, quantity), values)
        left = quantity.values(reach, reach.motion(np.array([axis.first + BESIDE * reach.ends[1]])))[0]
        values = values - 2 * np.pi * np.rint(left / (2 * np.pi))
    return np.array([quantity.in_units(reach.scene, v, degrees=True) for v in values])


def _gain(reach: DriverRange, quantity: Quantity) -> float:
    """How far an angle gets over the whole range, in whole turns: beside the ends, which may be dead points."""
    high = reach.ends[1]
    first, last = quantity.values(reach, reach.motion(np.array([BESIDE * high, high - BESIDE * high])))
    return float(2 * np.pi * np.rint((last - first) / (2 * np.pi)))


def _span(curve: Array, dots: Array, bounded: bool) -> tuple[float, float]:
    """The range of values worth showing: all of it, but of rates that grow without bound near the ends of a limited
    motion what most of the way needs, and what is measured."""
    x, good = curve[np.isfinite(curve[:, 1])].T
    if not len(good):
        return 0.0, 1.0
    low, high = float(good.min()), float(good.max())
    if not bounded:
        order = np.argsort(x)
        even = np.interp(np.linspace(x.min(), x.max(), len(x)), x[order], good[order])
        least, most = np.percentile(even, (10, 90))
        wide = 0.8 * (most - least)
        low = max(low, min([float(least - wide), *dots[:, 1].tolist()]))
        high = min(high, max([float(most + wide), *dots[:, 1].tolist()]))
    if not high - low > 1e-12 * max(abs(low), abs(high)):  # a constant
        half = abs(high) / 2 or 0.5
        return low - half, high + half
    return low, high
