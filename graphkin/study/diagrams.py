"""Motion diagrams over the turn and coupler curves, as pages."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from graphkin.drawing import Box, Drawing, Group, Line, Polyline, Primitive, Stroke, Text, strokes
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
    marker,
    next_step,
)
from graphkin.drawing.metrics import runs_width
from graphkin.drawing.obstacles import obstacles_of
from graphkin.drawing.placing import Label, place
from graphkin.drawing.symbols import block_with_pin, fixed_pivot, rigid_link, turning_pair
from graphkin.drawing.symbols import guide as guide_symbol
from graphkin.drawing.typeset import rich
from graphkin.scene.model import AngleDriver, Scene
from graphkin.study.course import Course
from graphkin.study.measured import measured
from graphkin.study.quantities import Quantity, link_quantities, slide_quantities
from graphkin.study.trace import Traced
from graphkin.study.turn import Output, Turn
from graphkin.words import Phrase, say, word

__all__ = ["coupler_points", "diagrams"]

Array = NDArray[np.float64]

WIDTH, HEIGHT = 210.0, 297.0
LEFT, RIGHT, TOP, GAP = 26.0, 14.0, 40.0, 10.0
POINTS = 721
TICKS = 12


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
        pages[f"curve-{point}"] = _curve_page(turn, point, link, language)
    return pages


def coupler_points(scene: Scene) -> tuple[tuple[str, str], ...]:
    """Points of links that are neither pivoted to the frame nor slide on it, with their link: those that no other kind
    of link carries."""
    frame = scene.frame
    guided = {s.link for s in scene.slidings if s.on == frame.name}
    plain = {link.name for link in scene.links if any(p in frame.points for p in link.points)} | guided
    found: list[tuple[str, str]] = []
    for link in scene.links:
        if link.name in plain:
            continue
        for point in link.points:
            if not any(h in plain for h in scene.holders[point]) and point not in [p for p, _ in found]:
                found.append((point, link.name))
    return tuple(found)


def _motion_page(turn: Turn, output: Output, dots: Sequence[tuple[float, ...]], language: str) -> Drawing:
    scene, quantity = turn.scene, output.quantity
    turns = quantity.kind == "theta"
    curves = link_quantities(quantity.of) if turns else slide_quantities(quantity.of)
    traced = {t.quantity: t for t in turn.curves}
    x_axis = _driver_axis(turn.course, language)
    offsets = _offsets(turn.course)
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
    head = _heading(scene, title, _facts(turn, output, language), language)
    entries: list[tuple[Stroke | str, str]] = [(SOLID_AND_DASHED[0], word("analytic curve", language))]
    if dots:
        entries.append(("circle", word("measured dots", language)))
    entries += [("up", word("greatest", language)), ("down", word("least", language))]
    made += legend(complex(LEFT, TOP - 9.5), entries)  # type: ignore[arg-type]
    return Drawing(
        WIDTH, HEIGHT, (Group(head, id="heading"), *made), title=f"{title}: {_title(scene, language)}",
        desc=" ".join(_facts(turn, output, language)), lang=language,
        metadata={"scene": scene.name, "units": scene.units.length, "output": quantity.of},
    )


def _title(scene: Scene, language: str) -> str:
    return (scene.title_zh if language == "zh" and scene.title_zh else scene.title).replace("$", "$$")


def _heading(scene: Scene, title: str, facts: Sequence[str], language: str) -> tuple[Primitive, ...]:
    return (
        Text(complex(LEFT, 15.0), rich(title.replace("$", "$$"), 5.0, bold=True)),
        Text(complex(LEFT, 20.5), rich(_title(scene, language), 3.5)),
        Text(complex(LEFT, 25.5), rich("; ".join(facts), 3.5)),
    )


def _number(value: float, digits: int = 5) -> str:
    return f"{value:.{digits}g}".replace("-", "−")


def _unit(unit: str) -> str:
    return {"deg": "°", "rad/s2": "rad/s²"}.get(unit, unit.replace("s2", "s²"))


def _with_unit(value: float, unit: str, digits: int = 6) -> str:
    return f"{_number(value, digits)}{'' if unit == 'deg' else ' '}{_unit(unit)}"


def _facts(turn: Turn, output: Output, language: str) -> list[str]:
    """Stroke, K and limit positions in words."""
    scene, quantity, stroke = turn.scene, output.quantity, output.stroke
    if stroke is None:
        return [word("does not move" if output.position.constant is not None else "turns on", language)]
    unit = quantity.unit(scene, degrees=True)
    key = "swing is" if quantity.kind == "theta" else "stroke is"
    facts = [say(Phrase(key, (_with_unit(quantity.in_units(scene, stroke, degrees=True), unit),)), language)]
    back = turn.quick_return(output)
    if back is not None:
        facts.append(say(Phrase("K is", (_number(back[0]),)), language).replace("K", "$K$", 1))
    low, high = output.low, output.high
    assert low is not None
    assert high is not None
    driver = "deg" if isinstance(scene.drivers[0], AngleDriver) else scene.units.length
    places = [_with_unit(_driver_number(scene, e.driver), driver) for e in sorted((low, high), key=lambda e: e.driver)]
    facts.append(say(Phrase("limits at", (", ".join(places),)), language))
    return facts


def _driver_number(scene: Scene, value: float) -> float:
    return math.degrees(value) if isinstance(scene.drivers[0], AngleDriver) else value / scene.units.metres


def _driver_axis(course: Course, language: str) -> Axis:
    """The driver's value from left to right as it moves."""
    scene, driver = course.scene, course.driver
    name = driver.key.split("/")[0]
    angle = isinstance(driver, AngleDriver)
    symbol = f"$φ_{{{name}}}$ (°)" if angle else f"$s_{{{name}}}$ ({scene.units.length})"
    title = say(Phrase("of the driver", (symbol,)), language)
    if course.full:
        low, high = 0.0, 360.0 * course.turns
    else:
        low, high = sorted(_driver_number(scene, float(course.value(np.array(e)))) for e in course.ends)
    axis = degree_axis(low, high, title) if angle else linear_axis(low, high, title, most=12, margin=0.0)
    if course.sense > 0:
        return axis
    return Axis(axis.high, axis.low, axis.ticks, axis.title)


def _offsets(course: Course) -> Array:
    """Offsets in the order in which they are drawn, left to right; dense near the ends of a limited motion."""
    low, high = course.ends
    if not course.full:
        half = np.linspace(0, np.pi, POINTS)
        return np.asarray(low + (high - low) * np.sin(half / 2) ** 2)
    return np.asarray((np.linspace(0.0, high, POINTS) + _first(course)) % high)


def _first(course: Course) -> float:
    """The offset at which the axis begins: driver at 0 going up, or at whole turns going down."""
    high = course.ends[1]
    return float((-course.start[0] * course.sense) % high)


def _x(course: Course, offset: Array) -> Array:
    """Where offsets lie on the axis of the driver, in its own unit."""
    scene = course.scene
    if not course.full:
        values = course.value(offset)
        return np.asarray(np.degrees(values) if isinstance(course.driver, AngleDriver) else values / scene.units.metres)
    high = course.ends[1]
    along = (np.asarray(offset) - _first(course)) % high
    along = np.where(along > high * (1 - 1e-12), 0.0, along)
    return np.asarray(np.degrees(along if course.sense > 0 else high - along))


def _shown(course: Course, quantity: Quantity, offset: Array, values: Array) -> Array:
    """Values in units of the figure; an angle of a link without a jump along the axis."""
    scene = course.scene
    values = np.asarray(values, dtype=float)
    if quantity.kind == "theta" and course.full:
        low, high, left = quantity.values(course, course.motion(np.array([*course.ends, _first(course)])))
        values = np.where(offset < _first(course) - 1e-12, values + (high - low), values)
        values = values - 2 * np.pi * np.rint(left / (2 * np.pi))
    return np.array([quantity.in_units(scene, v, degrees=True) for v in values])


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
        ends = _shown(course, quantity, np.array([1.0, 1.0]) * course.ends[1],
                      quantity.values(course, course.motion(np.array(course.ends))))
        values[-1] = values[0] + (ends[1] - ends[0])
    low, high = _span(course, values)
    letter, name = quantity.kind, quantity.of.split("/")[0]
    greek = {"theta": "θ", "omega": "ω", "alpha": "α"}.get(letter, letter)
    title = f"${greek}_{{{name}}}$ ({_unit(quantity.unit(scene, degrees=True))})"
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
        marks.append(Marks(list(_x(course, at)), list(_shown(course, quantity, at, read)), "circle"))
    for kind, shape in (("max", "up"), ("min", "down")):
        found = [e for e in (traced.extremes if traced else ()) if e.kind == kind]
        if found:
            places = np.array([e.offset for e in found])
            shown = _shown(course, quantity, places, np.array([e.value for e in found]))
            inside = [k for k, v in enumerate(shown) if y_axis.low <= v <= y_axis.high]
            labels = [_number(float(shown[k])) for k in inside]
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


def _curve_page(turn: Turn, point: str, link: str, language: str) -> Drawing:
    """The path of a coupler point in scale, with marks at equal steps of the driver, and the mechanism at its own
    position."""
    course, scene = turn.course, turn.scene
    low, high = course.ends
    offsets = np.linspace(low, high, POINTS)
    path = course.motion(offsets).position(point, link)
    first = _first(course) if course.full else low
    steps = TICKS * max(course.turns, 1)
    if course.full:
        ticks = (first + np.arange(steps) * (high - low) / steps) % high
    else:
        at_axis = np.array([v for v, _ in _driver_axis(course, language).ticks])
        angle = isinstance(course.driver, AngleDriver)
        values = np.radians(at_axis) if angle else at_axis * scene.units.metres
        ticks = (values - course.start[0]) * course.sense
    at = course.motion(ticks).position(point, link)
    here = course.motion(np.zeros(1))
    places = {p: complex(here.position(p)[0]) for p in scene.holders}
    world = Box.around([*path[np.isfinite(path)].tolist(), *places.values()])
    width, height, need = min(((w, h, _need(world, w, h)) for w, h in ((WIDTH, HEIGHT), (HEIGHT, WIDTH))),
                              key=lambda page: next_step(page[2]))
    panel = _curve_panel(width, height)
    mm = 1e3 / next_step(need)  # of paper for one metre
    middle = world.centre

    def page(z: complex) -> complex:
        w = (z - middle) * mm
        return panel.centre + complex(w.real, -w.imag)

    skeleton = _skeleton(turn, places, page)
    dots = [marker(page(complex(z)), "disc") for z in at if math.isfinite(abs(z))]
    axis_unit = "°" if isinstance(course.driver, AngleDriver) else ""
    numbers = [_driver_number(scene, float(course.value(t))) for t in ticks]
    numbers = [round(n, 9) + 0.0 for n in numbers]
    if course.full:
        numbers = [n % (360 * course.turns) for n in numbers]
    labels = [
        Label(Text(0j, rich(f"{_number(n, 4)}{axis_unit}", 2.5)), page(complex(z)))
        for n, z in zip(numbers, at, strict=True) if math.isfinite(abs(z))
    ]
    names = [Label(Text(0j, rich(f"${p}$", 3.5)), page(z)) for p, z in places.items()]
    line = Polyline(tuple(page(complex(z)) for z in path[np.isfinite(path)]), Stroke(0.5))
    placed = place([*names, *labels], panel, obstacles_of((*skeleton, line, *dots)))
    words: list[Primitive] = []
    for label in placed:
        words += [label.text] + ([label.leader] if label.leader else [])
    title = say(Phrase("curve of point", (f"${point}$",)), language)
    scale = 1e3 / mm / (scene.units.metres * 1e3)
    facts = [f"1 mm = {scale:g} {scene.units.length}"]
    if isinstance(course.driver, AngleDriver) and course.full:
        begin = 0 if course.sense > 0 else 360
        facts.append(say(Phrase("ticks at", (str(360 // TICKS), str(begin))), language))
    plain = title.replace("$", "")
    return Drawing(
        width,
        height,
        (
            Group(_heading_rich(scene, title, facts, language), id="heading"),
            Group(tuple(skeleton), id="mechanism", layer="mechanism"),
            Group((line, *dots), id=f"curve-{point}", layer="curve", title=plain),
            Group(tuple(words), id="labels", layer="labels"),
            *_check_bar(panel, language),
        ),
        title=f"{plain}: {_title(scene, language)}",
        desc="; ".join(facts),
        lang=language,
        metadata={"scene": scene.name, "units": scene.units.length, "scales": {"length": scale}},
    )


def _curve_panel(width: float, height: float) -> Box:
    return Box(LEFT - 8, 32.0, width - RIGHT + 4, height - 20.0)


def _need(world: Box, width: float, height: float) -> float:
    """Millimetres of mechanism to one of paper, for all to fit."""
    panel = _curve_panel(width, height).grown(-12.0)
    return max(world.width / panel.width, world.height / panel.height) * 1e3 or 1.0


def _skeleton(turn: Turn, places: dict[str, complex], page: Callable[[complex], complex]) -> list[Primitive]:
    """The mechanism at its own position, thin: links, blocks, guides, pivots."""
    scene = turn.scene
    motion = turn.course.motion(np.zeros(1))
    made: list[Primitive] = []
    blocks: list[Primitive] = []
    for pair in motion.slides:
        guide = motion.poses[pair.b]
        at = page(complex(motion.poses[pair.a].z[0]))
        angle = float(np.angle(guide.u[0] * pair.guide.direction))
        if pair.b == scene.frame.name:
            made += guide_symbol(at, angle, 24.0)
        elif scene.by_name[pair.b].points:
            begin = next(iter(scene.by_name[pair.b].points))
            made.append(Line(page(places[begin]), at, strokes.LINK.coloured(strokes.GREY)))
        blocks += block_with_pin(at, angle)
    for each in scene.links:
        corners = tuple(page(places[p]) for p in each.points)
        if len(corners) > 1:
            made += rigid_link(corners, strokes.GREY)
    for p, z in places.items():
        made += fixed_pivot(page(z)) if p in scene.frame.points else turning_pair(page(z))
    return [*made, *blocks]


def _heading_rich(scene: Scene, title: str, facts: Sequence[str], language: str) -> tuple[Primitive, ...]:
    runs = rich(title, 5.0, bold=True)
    return (Text(complex(LEFT, 15.0), runs), *_heading(scene, " ", facts, language)[1:])


def _check_bar(panel: Box, language: str) -> tuple[Primitive, ...]:
    y = panel.bottom + 6.0
    runs = rich(word("check bar", language), 2.5)
    end = complex(panel.right, y)
    start = end - 50.0
    ends = [Line(p - 1.2j, p + 1.2j, strokes.DIMENSION) for p in (start, end)]
    text = Text(complex(panel.right - 25 - runs_width(runs) / 2, y + 3.8), runs)
    return Line(start, end, strokes.DIMENSION), *ends, text

