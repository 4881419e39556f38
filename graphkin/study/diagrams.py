"""Motion diagrams over the turn, as pages."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from graphkin.drawing import Box, Drawing, Group, Primitive, Stroke
from graphkin.drawing.chart import (
    SOLID_AND_DASHED,
    Axis,
    Chart,
    Curve,
    Marks,
    chart_group,
    degree_axis,
    legend,
    linear_axis,
)
from graphkin.scene.model import AngleDriver
from graphkin.study.coupler import coupler_points, curve_page
from graphkin.study.course import Course
from graphkin.study.measured import measured
from graphkin.study.paper import (
    HEIGHT,
    LEFT,
    RIGHT,
    WIDTH,
    axis_offsets,
    driver_axis,
    driver_number,
    first_offset,
    heading,
    number,
    title_of,
    unit_words,
    with_unit,
)
from graphkin.study.quantities import Quantity, link_quantities, slide_quantities
from graphkin.study.trace import Traced
from graphkin.study.turn import Output, Turn
from graphkin.words import Phrase, say, word

__all__ = ["diagrams"]

Array = NDArray[np.float64]

TOP, GAP = 40.0, 10.0
BESIDE = 1e-3
"""Of the course: so far beside a place that may be a dead point."""


def diagrams(turn: Turn, language: str = "en", positions: int = 12) -> dict[str, Drawing]:
    """The motion diagrams of each output and the curve of each coupler point, by name of file.

    Parameters
    ----------
    positions : where the values measured off the drawn polygons are laid over the curves; 0 for none
    """
    quantities = [o.quantity for o in turn.outputs]
    dots = measured(turn.course, quantities, positions) if positions else {q: [] for q in quantities}
    pages: dict[str, Drawing] = {}
    for output in turn.outputs:
        quantity = output.quantity
        kind = "link" if quantity.kind == "theta" else "slide"
        pages[f"motion-{kind}-{quantity.of.replace('/', '-')}"] = _motion_page(turn, output, dots[quantity], language)
    for point, link in coupler_points(turn.scene):
        pages[f"curve-{point}"] = curve_page(turn, point, link, language)
    return pages


def _motion_page(turn: Turn, output: Output, dots: Sequence[tuple[float, ...]], language: str) -> Drawing:
    scene, quantity = turn.scene, output.quantity
    turns = quantity.kind == "theta"
    curves = link_quantities(quantity.of) if turns else slide_quantities(quantity.of)
    traced = {t.quantity: t for t in turn.curves}
    x_axis = driver_axis(turn.course, language)
    offsets = axis_offsets(turn.course)
    motion = turn.course.motion(offsets)
    tall = (HEIGHT - TOP - 20.0 - 2 * GAP) / 3
    made: list[Primitive] = []
    for k, q in enumerate(curves):
        top = TOP + k * (tall + GAP)
        values = _shown(turn.course, q, offsets, q.values(turn.course, motion))
        marks = [(d[0], d[k + 1]) for d in dots]
        made.append(
            _panel(turn, q, traced.get(q), offsets, values, marks,
                   Box(LEFT, top, WIDTH - RIGHT, top + tall), x_axis, k == 2)
        )
    title = say(Phrase("motion of link" if turns else "motion of slide", (quantity.of.split("/")[0],)), language)
    head = heading(scene, title.replace("$", "$$"), _facts(turn, output, language), language)
    entries: list[tuple[Stroke | str, str]] = [(SOLID_AND_DASHED[0], word("analytic curve", language))]
    if dots:
        entries.append(("circle", word("measured dots", language)))
    entries += [("up", word("greatest", language)), ("down", word("least", language))]
    made += legend(complex(LEFT, TOP - 9.5), entries)  # type: ignore[arg-type]
    return Drawing(
        WIDTH, HEIGHT, (Group(head, id="heading"), *made), title=f"{title}: {title_of(scene, language)}",
        desc=" ".join(_facts(turn, output, language)), lang=language,
        metadata={"scene": scene.name, "units": scene.units.length, "output": quantity.of},
    )


def _facts(turn: Turn, output: Output, language: str) -> list[str]:
    """Stroke, K and limit positions in words."""
    scene, quantity, stroke = turn.scene, output.quantity, output.stroke
    if stroke is None:
        return [word("does not move" if output.position.constant is not None else "turns on", language)]
    unit = quantity.unit(scene, degrees=True)
    key = "swing is" if quantity.kind == "theta" else "stroke is"
    facts = [say(Phrase(key, (with_unit(quantity.in_units(scene, stroke, degrees=True), unit),)), language)]
    back = turn.quick_return(output)
    if back is not None:
        facts.append(say(Phrase("K is", (number(back[0]),)), language).replace("K", "$K$", 1))
    low, high = output.low, output.high
    assert low is not None
    assert high is not None
    driver = "deg" if isinstance(scene.drivers[0], AngleDriver) else scene.units.length
    places = [with_unit(driver_number(scene, e.driver), driver) for e in sorted((low, high), key=lambda e: e.driver)]
    facts.append(say(Phrase("limits at", (", ".join(places),)), language))
    return facts


def _x(course: Course, offset: Array) -> Array:
    """Where offsets lie on the axis of the driver, in its own unit."""
    scene = course.scene
    if not course.full:
        values = course.value(offset)
        return np.asarray(np.degrees(values) if isinstance(course.driver, AngleDriver) else values / scene.units.metres)
    high = course.ends[1]
    along = (np.asarray(offset) - first_offset(course)) % high
    along = np.where(along > high * (1 - 1e-12), 0.0, along)
    return np.asarray(np.degrees(along if course.sense > 0 else high - along))


def _shown(course: Course, quantity: Quantity, offset: Array, values: Array) -> Array:
    """Values in units of the figure; an angle of a link without a jump along the axis."""
    scene = course.scene
    values = np.asarray(values, dtype=float)
    if quantity.kind == "theta" and course.full:
        start = first_offset(course)
        values = np.where(offset < start - 1e-12, values + _gain(course, quantity), values)
        left = quantity.values(course, course.motion(np.array([start + BESIDE * course.ends[1]])))[0]
        values = values - 2 * np.pi * np.rint(left / (2 * np.pi))
    return np.array([quantity.in_units(scene, v, degrees=True) for v in values])


def _gain(course: Course, quantity: Quantity) -> float:
    """How far an angle gets over the whole course, in whole turns: beside the ends, which may be dead points."""
    high = course.ends[1]
    first, last = quantity.values(course, course.motion(np.array([BESIDE * high, high - BESIDE * high])))
    return float(2 * np.pi * np.rint((last - first) / (2 * np.pi)))


def _panel(
    turn: Turn,
    quantity: Quantity,
    traced: Traced | None,
    offsets: Array,
    values: Array,
    dots: Sequence[tuple[float, float]],
    panel: Box,
    x_axis: Axis,
    last: bool,
) -> Group:
    course, scene = turn.course, turn.scene
    x = _x(course, offsets)
    if course.full:
        # the axis ends where it begins, a turn later
        x[0], x[-1] = x_axis.low, x_axis.high
        gain = _gain(course, quantity) if quantity.kind == "theta" else 0.0
        values[-1] = values[0] + quantity.in_units(scene, gain, degrees=True)
    low, high = _span(course, values)
    letter, name = quantity.kind, quantity.of.split("/")[0]
    greek = {"theta": "θ", "omega": "ω", "alpha": "α"}.get(letter, letter)
    title = f"${greek}_{{{name}}}$ ({unit_words(quantity.unit(scene, degrees=True))})"
    y_axis = linear_axis(low, high, title, margin=0.14)
    if quantity.kind == "theta" and high - low > 60:
        y_axis = degree_axis(y_axis.low, y_axis.high, title, most=7)
    marks: list[Marks] = []
    if dots:
        at = np.array([d[0] for d in dots])
        read = np.array([d[1] for d in dots])
        if quantity.kind == "theta":
            # an angle measured on paper tells no whole turns
            near = quantity.values(course, course.motion(at))
            read = read + 2 * np.pi * np.rint((near - read) / (2 * np.pi))
        shown = _shown(course, quantity, at, read)
        known = np.isfinite(shown)
        marks.append(Marks(list(_x(course, at[known])), list(shown[known]), "circle"))
    for kind, shape in (("max", "up"), ("min", "down")):
        found = [e for e in (traced.extremes if traced else ()) if e.kind == kind]
        if found:
            places = np.array([e.offset for e in found])
            shown = _shown(course, quantity, places, np.array([e.value for e in found]))
            inside = [k for k, v in enumerate(shown) if y_axis.low <= v <= y_axis.high]
            labels = [number(float(shown[k])) for k in inside]
            at_x = _x(course, places)
            marks.append(Marks([float(at_x[k]) for k in inside], [float(shown[k]) for k in inside],
                               "up" if shape == "up" else "down", labels))
    chart = Chart(panel, x_axis, y_axis, (Curve(list(x), list(values)),), tuple(marks), last,
                  id=f"chart-{quantity.name.replace('/', '-')}", title=quantity.name)
    return chart_group(chart)


def _span(course: Course, values: Array) -> tuple[float, float]:
    """The range of values worth showing: near the ends of a limited motion rates grow without bound."""
    good = values[np.isfinite(values)]
    if not len(good):
        return 0.0, 1.0
    if course.full:
        return float(good.min()), float(good.max())
    low, high = np.percentile(good, (10, 90))
    wide = high - low
    return float(max(good.min(), low - 0.8 * wide)), float(min(good.max(), high + 0.8 * wide))
