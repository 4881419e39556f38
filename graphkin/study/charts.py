"""Charts over the driver's range, or over time, by one painter: a page has a heading, facts, a legend, and panels below
each other, each with a curve, its extremes, measured points, and allowed values."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from graphkin.account.notation import Notation
from graphkin.construction.board.scales import next_of_series
from graphkin.drawing import Box, Text, chart
from graphkin.drawing.ink.primitives import Stroke
from graphkin.drawing.text import rich
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.search import greatest_and_least
from graphkin.solver import DriverRange, Motion
from graphkin.study.extremes import Extreme, driver_value
from graphkin.study.quantities import course_of
from graphkin.study.turn import TurnStudy
from graphkin.words import Phrase, rich_text, say, word
from graphkin.words.symbols import RichText, Words, sign, spaced
from graphkin.words.written import printed

Array = NDArray[np.float64]

WIDTH, HEIGHT = 210.0, 297.0
LEFT, RIGHT, TOP, GAP = 26.0, 14.0, 40.0, 10.0
ALONE, THIRD = 95.0, (HEIGHT - TOP - 20.0 - 2 * GAP) / 3
"""Height of a panel that stands alone, and of one of three (mm)."""
POINTS = 721
FINE = 1e-6
"""Of the axis: as near as this the places of extremes are sought."""
BESIDE = 1e-3
"""Of the driver's range: so far beside a place that may be a dead point."""
MARGIN = 0.14
"""Of the range of values, above and below the curve: room for the labels of its extremes."""
ZERO, LEAP = Stroke(0.18), Stroke(0.25, (1.2, 0.9))
LIMIT = Stroke(0.18, (4.0, 0.9, 0.9, 0.9))
ROUNDING = 1e-10  # part of what a panel shows that is nothing but rounding
ALLOWED = "#e4e4e4"
LEAST_GAMMA = 40.0
"""Degrees: the least transmission angle that is usually allowed (Sun Huan, Mechanical Principles, ch. 8: 40 to 50), and
90 less it the greatest pressure angle."""
EMPTY: Array = np.zeros((0, 2))


def headed_page(
    scene: Mechanism, tall: float, paint: Callable[[chart.Figure], None], title: Words, facts: Sequence[Words],
    language: str, of: str, desc: str, **metadata: object,
) -> chart.ChartPage:
    """A page with its title, the title of the scene and facts below each other, and below them what ``paint`` puts on
    the figure; ``of`` is its subject in plain words."""
    scene_title = scene.question.title_in(language)

    def painted(figure: chart.Figure) -> None:
        chart.add_words(
            figure,
            Text(complex(LEFT, 15.0), rich(title, 5.0, bold=True)),
            Text(complex(LEFT, 20.5), rich(scene_title, 3.5)),
            Text(complex(LEFT, 25.5), rich(spaced(word("list semicolon", language), facts), 3.5)),
        )
        paint(figure)

    return chart.ChartPage(
        WIDTH, tall, painted, f"{of}: {scene_title}", desc, language, {"scene": scene.name, **metadata}
    )


def number(value: float, digits: int = 5) -> str:
    """A number to ``digits`` digits, for people."""
    return printed(f"{value:.{digits}g}")


# the axis


class Axis(ABC):
    """The horizontal axis, and the motion over it.

    Places on it are offsets of the driver's range, or moments (s).
    """

    @property
    @abstractmethod
    def scene(self) -> Mechanism: ...

    @property
    @abstractmethod
    def ends(self) -> tuple[float, float]:
        """Its left and its right end."""

    @property
    @abstractmethod
    def step(self) -> float:
        """The step of its ticks."""

    @abstractmethod
    def title(self, language: str) -> RichText:
        """Its title."""

    @abstractmethod
    def at(self, places: Array) -> Array:
        """The coordinates of places on the axis."""

    @abstractmethod
    def values(self, quantity: Symbol, places: Array) -> Array:
        """A quantity at places (SI), NaN where it is missing."""

    def shown(self, quantity: Symbol, places: Array, values: Array) -> Array:
        """Values (SI) in units of the figure."""
        return np.asarray(quantity.unit(self.scene.units).of(values))

    def extremes(self, quantity: Symbol, places: Array, values: Array) -> tuple[Extreme, Extreme]:
        """The greatest and the least of a sampled course (SI); a size within the error from its place is 0."""
        within = FINE * float(np.ptp(places))
        (top, greatest), (bottom, least) = greatest_and_least(
            lambda at: self.values(quantity, at), places, values, within
        )
        if quantity.is_vector and least > 0.0:  # nought where it grows steadily to both sides, as an edge does
            near, far = self.values(quantity, bottom + within * np.array([-1.0, 1.0, -10.0, 10.0])).reshape(2, 2)
            least = 0.0 if np.nanmax([*near, least]) < 0.3 * np.nanmin([*far, np.inf]) else least
        return Extreme("max", top, self.driver(top), greatest), Extreme("min", bottom, self.driver(bottom), least)

    def driver(self, place: float) -> float:
        """The value of a place in words and tables: the moment itself, or the driver's value (rad, m)."""
        return place


@dataclass(frozen=True)
class DriverAxis(Axis):
    """The driver's value as it moves, over its whole range: degrees, or the scene's unit of length; of a whole turn
    from 0 on, up or down."""

    reach: DriverRange

    @property
    def scene(self) -> Mechanism:
        return self.reach.scene

    @property
    def ends(self) -> tuple[float, float]:
        reach = self.reach
        if reach.full:
            low, high = 0.0, 360.0 * reach.turns
        else:
            unit = self.scene.unit_of(reach.driver)
            low, high = sorted(unit.of(reach.value(np.array(reach.ends))).tolist())
        return (low, high) if reach.sense > 0 else (high, low)

    @property
    def step(self) -> float:
        wide = abs(self.ends[1] - self.ends[0])
        if self.reach.driver.turns:
            return chart.degree_step(wide)
        # a slide that its own place alone lets stand has no way
        return next_of_series((wide or self.scene.size / self.scene.units.metres) / 12)

    def title(self, language: str) -> RichText:
        driver = self.reach.driver
        name, unit = driver.key.split("/")[0], "°" if driver.turns else self.scene.units.length
        symbol = sign("φ" if driver.turns else "s", name) + f" ({unit})"
        return rich_text(Phrase("of the driver", driver=symbol), language)

    @cached_property
    def first(self) -> float:
        """The offset of the driver's range at the left end."""
        reach = self.reach
        return float((-reach.start[0] * reach.sense) % reach.ends[1]) if reach.full else reach.ends[0]

    @cached_property
    def offsets(self) -> Array:
        """Offsets of the range in drawing order; dense near the ends of a limited motion."""
        low, high = self.reach.ends
        if not self.reach.full:
            half = np.linspace(0, np.pi, POINTS)
            return low + (high - low) * np.sin(half / 2) ** 2
        return (np.linspace(0.0, high, POINTS) + self.first) % high

    @cached_property
    def motion(self) -> Motion:
        """The motion at its offsets, for all curves over it."""
        return self.reach.motion(self.offsets, extended=False)

    @cached_property
    def beside_ends(self) -> Motion:
        """The motion near the start and the end of a whole range, and near the left end of the axis."""
        high = self.reach.ends[1]
        beside = np.array([BESIDE * high, high - BESIDE * high, self.first + BESIDE * high])
        return self.reach.motion(beside, extended=False)

    @property
    def ticks(self) -> Array:
        low, high = sorted(self.ends)
        first, last = math.ceil(low / self.step - 1e-9), math.floor(high / self.step + 1e-9)
        return np.asarray(self.step * np.arange(first, last + 1))

    def at(self, places: Array) -> Array:
        reach = self.reach
        if not reach.full:
            return np.asarray(self.scene.unit_of(reach.driver).of(reach.value(places)))
        high = reach.ends[1]
        along = (np.asarray(places) - self.first) % high
        along = np.where(along > high * (1 - 1e-12), 0.0, along)
        return np.degrees(along if reach.sense > 0 else high - along)

    def values(self, quantity: Symbol, places: Array) -> Array:
        places = places % self.reach.ends[1] if self.reach.full else places
        return course_of(quantity, self.reach, self.reach.motion(places, extended=False))

    def extremes(self, quantity: Symbol, places: Array, values: Array) -> tuple[Extreme, Extreme]:
        """As of every axis; of a whole turn also between the places where it ends and begins anew."""
        if not self.reach.full:
            return super().extremes(quantity, places, values)
        high = self.reach.ends[1]
        most, least = super().extremes(quantity, np.unwrap(places, period=high), values)
        return replace(most, offset=most.offset % high), replace(least, offset=least.offset % high)

    def shown(self, quantity: Symbol, places: Array, values: Array) -> Array:
        """Values (SI) in units of the figure; an angle of a link without a jump along the axis."""
        values = np.asarray(values, dtype=float)
        if quantity.kind == "theta" and self.reach.full:
            values = np.where(places < self.first - 1e-12, values + self.gain(quantity), values)
            left = course_of(quantity, self.reach, self.beside_ends)[2]
            values = values - 2 * np.pi * np.rint(left / (2 * np.pi))
        return super().shown(quantity, places, values)

    def gain(self, quantity: Symbol) -> float:
        """The change of an angle over the whole range, in whole turns, taken near the ends, which may be dead
        points."""
        first, last = course_of(quantity, self.reach, self.beside_ends)[:2]
        return float(2 * np.pi * np.rint((last - first) / (2 * np.pi)))

    def driver(self, place: float) -> float:
        return driver_value(self.reach, place)

    def curve(self, quantity: Symbol, offsets: Array, values: Array) -> Array:
        """The curve of a quantity from its values (SI): of a whole turn the axis ends where it begins, a turn later."""
        x, shown = self.at(offsets), self.shown(quantity, offsets, values)
        if self.reach.full:
            x[0], x[-1] = self.ends
            if quantity.kind == "theta":
                shown[-1] = shown[0] + quantity.unit(self.scene.units).of(self.gain(quantity))
        return np.stack([x, shown], axis=1)

    def points(self, quantity: Symbol, pairs: Sequence[tuple[float, float]]) -> Array:
        """Offsets and values (SI) as points of a panel."""
        if not len(pairs):
            return EMPTY
        at, read = np.array(pairs, dtype=float).T
        if quantity.kind == "theta":
            # an angle that is measured tells no whole turns
            read = read + 2 * np.pi * np.rint((self.values(quantity, at) - read) / (2 * np.pi))
        points = np.stack([self.at(at), self.shown(quantity, at, read)], axis=1)
        return points[np.isfinite(points).all(axis=1)]


# a panel


@dataclass(frozen=True)
class Panel:
    """The content of a panel, in units of the figure.

    curve, dots, laid_over : shape (n, 2), place on the axis and value; ``laid_over`` are values from elsewhere
    extremes : with place and value as shown, inside ``span`` only
    unbounded : whether it grows without bound towards an end of the range
    allowed : the limits of a transmission or pressure angle; ``falling``: the limit of a cam follower's pressure angle
        in its fall
    jumps : the points after which the curve jumps
    """

    quantity: Symbol
    title: Words
    curve: Array
    dots: Array
    extremes: tuple[tuple[Extreme, float, float], ...]
    span: tuple[float, float]
    unbounded: bool = False
    allowed: tuple[float, float] | None = None
    falling: float | None = None
    laid_over: Array = field(default_factory=lambda: EMPTY)
    jumps: tuple[int, ...] = ()

    @property
    def without_bound(self) -> str:
        """The phrase for a quantity that grows without bound; a motion does so at ends only."""
        return "grows without bound" if self.quantity.is_load else "unbounded"


def panel_of(
    axis: Axis, quantity: Symbol, curve: Array, extremes: Sequence[Extreme], unbounded: bool = False,
    dots: Array = EMPTY, laid_over: Array = EMPTY, jumps: Sequence[int] = (), bounded: bool | None = None,
) -> Panel:
    """The panel of a quantity over an axis, in units of the figure; the span of a force includes zero.

    Parameters
    ----------
    curve, unbounded, dots, laid_over, jumps : as a `Panel` shows them
    bounded : whether the span fits all values, not those of most of the range; None: unless it is ``unbounded``
    """
    low, high = span_of(curve, dots, not unbounded if bounded is None else bounded)
    reached = [0.0] if quantity.is_load else laid_over[:, 1].tolist()
    low, high = min([low, *reached]), max([high, *reached])
    room = MARGIN * (high - low)
    span = low - room, high + room
    places = np.array([e.offset for e in extremes])
    shown = axis.shown(quantity, places, np.array([e.value for e in extremes]))
    marked = tuple(
        (e, float(place), float(value)) for e, place, value in zip(extremes, axis.at(places), shown, strict=True)
        if span[0] <= value <= span[1]
    )
    allowed, falling = _allowed(quantity, axis.scene)
    title = lettered(axis.scene, quantity) + f" ({quantity.unit(axis.scene.units).written})"
    return Panel(
        quantity, title, curve, dots, marked, span, unbounded=unbounded, allowed=allowed, falling=falling,
        laid_over=laid_over, jumps=tuple(jumps),
    )


def motion_panel(
    turn: TurnStudy, axis: DriverAxis, quantity: Symbol, dots: Sequence[tuple[float, float]] = (),
    laid_over: Sequence[tuple[float, float]] = (),
) -> Panel:
    """The panel of a quantity of the motion over the driver.

    Parameters
    ----------
    dots, laid_over : offset of the driver and value (SI) of points measured on the drawing, and of points that somebody
        else measured
    """
    traced = next((t for t in turn.curves if t.quantity == quantity), None)
    curve = axis.curve(quantity, axis.offsets, course_of(quantity, turn.reach, axis.motion))
    extremes = [e for e in (traced.extremes if traced else ()) if e.kind != "end"]
    return panel_of(
        axis, quantity, curve, extremes, traced is not None and traced.unbounded, axis.points(quantity, dots),
        axis.points(quantity, laid_over), bounded=turn.reach.full or quantity.is_position,
    )


def lettered(scene: Mechanism, symbol: Symbol) -> RichText:
    """A quantity in the letters of the scene's convention."""
    return Notation(scene.question.sheet.convention).vector(symbol)


def _allowed(quantity: Symbol, scene: Mechanism) -> tuple[tuple[float, float] | None, float | None]:
    """The limits (degrees) of a transmission or pressure angle; for a cam's follower the scene's limits in its rise,
    and in its fall."""
    cam = scene.law_of(quantity.link) if quantity.kind == "pressure" else None
    if cam is not None and any(cam.allowed):
        rise, fall = (math.degrees(limit) if limit else None for limit in cam.allowed)
        return (0.0, float(rise or fall or 0.0)), fall if rise else None
    return _usual(quantity), None


def _usual(quantity: Symbol) -> tuple[float, float] | None:
    return {"gamma": (LEAST_GAMMA, 90.0), "pressure": (0.0, 90.0 - LEAST_GAMMA)}.get(quantity.kind)


def span_of(curve: Array, dots: Array, bounded: bool) -> tuple[float, float]:
    """The range of values to show: all values, but for a quantity that grows without bound near the ends of a limited
    motion the values of most of the range, and the measured points."""
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


# the painter


def figure_name(quantities: Sequence[Symbol]) -> str:
    """The name of the figure of a quantity, or of an output with its rates."""
    quantity = quantities[0]
    if len(quantities) == 1:
        return f"diagram-{str(quantity).replace('/', '-').replace('@', '')}"
    return f"motion-{'link' if quantity.kind == 'theta' else 'slide'}-{quantity.pair.replace('/', '-')}"


def chart_page(
    axis: Axis, panels: Sequence[Panel], facts: Sequence[Words], language: str, limits: Sequence[float] = (),
    title: Words = "", **metadata: object,
) -> chart.ChartPage:
    """A page with the panel of a quantity, or with those of an output and its rates below each other.

    Parameters
    ----------
    limits : places on the axis of limit positions
    title : of a quantity, if it is not the diagram of what its panel shows
    """
    scene, quantity = axis.scene, panels[0].quantity
    of, about = str(quantity), {"quantity": str(quantity)}
    title = title or rich_text(Phrase("diagram of", quantity=panels[0].title), language)
    if len(panels) > 1:
        mover = "link" if quantity.kind == "theta" else "slide"
        of = say(Phrase(f"motion of {mover}", **{mover: quantity.pair.split("/")[0]}), language)
        title, about = of, {"output": quantity.pair}
    tall = THIRD if len(panels) > 1 else ALONE

    def paint(figure: chart.Figure) -> None:
        marks = [(chart.look(LIMIT), word("limit marks", language))] if limits else []
        chart.add_legend(figure, complex(LEFT, TOP - 9.5), [*legend_of(panels, language), *marks])
        for k, panel in enumerate(panels):
            top, last = TOP + k * (tall + GAP), k == len(panels) - 1
            name = str(panel.quantity).replace("/", "-")
            without = word("list comma", language) + word(panel.without_bound, language)
            headed = panel.title + without if panel.unbounded else panel.title
            box = Box(LEFT, top, WIDTH - RIGHT, top + tall)
            axes = chart.add_panel(figure, box, name, headed, axis.title(language) if last else "")
            draw_panel(axes, panel, axis, language, limits)
            axes.tick_params(labelbottom=last)

    return headed_page(
        scene, TOP + len(panels) * (tall + GAP) - GAP + 20.0, paint, title, facts, language, of,
        " ".join(map(str, facts)) or of, **{"units": scene.units.length, **about, **metadata},
    )


def draw_panel(axes: chart.Axes, panel: Panel, axis: Axis, language: str, limits: Sequence[float] = ()) -> None:
    """Draw a panel; zero lines and limit positions lie behind the curve."""
    axes.set_xlim(*axis.ends)
    axes.set_ylim(*panel.span)
    chart.count_steps(axes.xaxis, axis.step)
    wide = panel.span[1] - panel.span[0]
    in_degrees = panel.quantity.kind == "theta" and wide > 60 * (1 + 2 * MARGIN)
    chart.count_steps(axes.yaxis, chart.degree_step(wide, 7) if in_degrees else None)
    if panel.allowed is not None:
        axes.axhspan(*panel.allowed, color=ALLOWED, linewidth=0.0, zorder=0.5)
        inside = [value for value in (*panel.allowed, panel.falling) if value and 0.0 < value < 90.0]
        for value in inside:
            axes.axhline(value, zorder=chart.BEHIND, **chart.look(LIMIT))
    axes.axhline(0.0, zorder=chart.BEHIND, **chart.look(ZERO))
    for limit in limits:
        axes.axvline(limit, zorder=chart.BEHIND, **chart.look(LIMIT))
    draw_pieces(axes, panel.curve, panel.jumps)
    axes.plot(*panel.dots.T, **chart.marker("circle"))
    axes.plot(*panel.laid_over.T, **chart.marker("cross"))
    labels, toward = [], []
    for extreme, x, value in panel.extremes:
        kind = extreme.kind
        axes.plot([x], [value], **chart.marker("up" if kind == "max" else "down"))
        mark = f" ({word('local', language)})" if extreme.local else ""
        nothing = abs(value) < ROUNDING * wide
        labels.append((("0" if nothing else number(value)) + mark, (x, value)))
        toward.append((math.pi / 2 if kind == "max" else -math.pi / 2,))
    chart.add_labels(axes, labels, toward=toward)


def draw_pieces(axes: chart.Axes, curve: Array, jumps: Sequence[int]) -> None:
    """Draw a curve, shape (n, 2), with dashed jumps."""
    for piece in np.split(curve, [k + 1 for k in jumps]):
        axes.plot(*piece.T, **chart.look(chart.SOLID_AND_DASHED[0]))
    for k in jumps:
        axes.plot(*curve[k : k + 2].T, **chart.look(LEAP))


def legend_of(panels: Sequence[Panel], language: str) -> list[tuple[chart.Look, str]]:
    """The meaning of the marks of some panels, as entries of a legend."""
    entries = [(chart.look(chart.SOLID_AND_DASHED[0]), word("analytic curve", language))]
    if any(len(panel.dots) for panel in panels):
        entries.append((chart.marker("circle"), word("measured dots", language)))
    if any(len(panel.laid_over) for panel in panels):
        entries.append((chart.marker("cross"), word("laid over", language)))
    for kind, key in (("max", "greatest"), ("min", "least")):
        shown = [e.local for panel in panels for e, _, _ in panel.extremes if e.kind == kind]
        if shown:
            named = f"local {key}" if all(shown) else key
            entries.append((chart.marker("up" if kind == "max" else "down"), word(named, language)))
    for panel in panels:
        if panel.allowed is not None:
            low, high = panel.allowed
            band = f"≥ {low:g}°" if high == 90.0 else f"≤ {high:g}°"
            if panel.falling:
                band = say(Phrase("rising and falling", rising=f"{high:g}°", falling=f"{panel.falling:g}°"), language)
            by_scene = panel.allowed != _usual(panel.quantity)
            key = "allowed by scene" if by_scene else "allowed band"
            entries.append((chart.look(LIMIT), say(Phrase(key, angle=band), language)))
    if any(panel.jumps for panel in panels):
        entries.append((chart.look(LEAP), word("load jumps", language)))
    return entries
