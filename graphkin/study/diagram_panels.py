"""One panel of a motion diagram: a quantity over the driver, its extremes, what was measured, what is allowed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from graphkin.drawing.chart import BEHIND, SOLID_AND_DASHED, add_labels, count_steps, degree_step, look, marker
from graphkin.drawing.ink.primitives import Stroke
from graphkin.scene.model import Mechanism
from graphkin.study.driver_axis import DriverAxis, number
from graphkin.study.extremes import Extreme, Traced
from graphkin.study.quantities import Quantity
from graphkin.study.turn import TurnStudy
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    from graphkin.drawing.chart import Axes, Look

__all__ = ["LIMIT", "MARGIN", "DiagramPanel", "draw_panel", "panel_of", "quantity_title", "signs_of", "span_of"]

Array = NDArray[np.float64]

MARGIN = 0.14
"""Of the range of values, above and below the curve: room for the labels of its extremes."""
ZERO = Stroke(0.18)
LIMIT = Stroke(0.18, (4.0, 0.9, 0.9, 0.9))
ROUNDING = 1e-10  # part of what a panel shows that is nothing but rounding
ALLOWED = "#e4e4e4"
LEAST_GAMMA = 40.0
"""Degrees: the least transmission angle that is usually allowed (Sun Huan, Mechanical Principles, ch. 8: 40 to 50), and
90 less it the greatest pressure angle."""
EMPTY: Array = np.zeros((0, 2))


@dataclass(frozen=True)
class DiagramPanel:
    """What one panel shows, in units of the figure.

    curve, dots, laid_over : shape (n, 2), driver and value; the last are values from elsewhere
    extremes : with the value as it is shown, in ``span`` alone; ``local`` the kinds of those beyond which the quantity
        goes elsewhere in a range that ends, ``unbounded`` whether it grows without bound towards an end
    allowed : the values within which a transmission or pressure angle shall stay; ``falling``: up to which that of a
        cam's follower may go as it falls
    """

    quantity: Quantity
    title: str
    curve: Array
    dots: Array
    extremes: tuple[tuple[Extreme, float, float], ...]
    span: tuple[float, float]
    local: frozenset[Extreme] = frozenset()
    unbounded: bool = False
    allowed: tuple[float, float] | None = None
    falling: float | None = None
    laid_over: Array = field(default_factory=lambda: EMPTY)

    @property
    def counts_degrees(self) -> bool:
        return self.quantity.kind == "theta" and self.span[1] - self.span[0] > 60 * (1 + 2 * MARGIN)


class _Ends(Protocol):
    """What is drawn from left to right: its ends, and the step of its ticks."""

    @property
    def left(self) -> float: ...

    @property
    def right(self) -> float: ...

    @property
    def step(self) -> float: ...


def draw_panel(axes: Axes, panel: DiagramPanel, axis: _Ends, limits: Sequence[float], language: str) -> None:
    """One panel; zero lines and limit positions lie behind the curve."""
    axes.set_xlim(axis.left, axis.right)
    axes.set_ylim(*panel.span)
    count_steps(axes.xaxis, axis.step)
    count_steps(axes.yaxis, degree_step(panel.span[1] - panel.span[0], 7) if panel.counts_degrees else None)
    if panel.allowed is not None:
        axes.axhspan(*panel.allowed, color=ALLOWED, linewidth=0.0, zorder=0.5)
        inside = [value for value in (*panel.allowed, panel.falling) if value and 0.0 < value < 90.0]
        for value in inside:
            axes.axhline(value, zorder=BEHIND, **look(LIMIT))
    axes.axhline(0.0, zorder=BEHIND, **look(ZERO))
    for limit in limits:
        axes.axvline(limit, zorder=BEHIND, **look(LIMIT))
    axes.plot(*panel.curve.T, **look(SOLID_AND_DASHED[0]))
    axes.plot(*panel.dots.T, **marker("circle"))
    axes.plot(*panel.laid_over.T, **marker("cross"))
    labels, toward = [], []
    for extreme, x, value in panel.extremes:
        kind = extreme.kind
        axes.plot([x], [value], **marker("up" if kind == "max" else "down"))
        mark = f" ({word('local', language)})" if extreme in panel.local else ""
        nothing = abs(value) < ROUNDING * (panel.span[1] - panel.span[0])
        labels.append((("0" if nothing else number(value)) + mark, (x, value)))
        toward.append((math.pi / 2 if kind == "max" else -math.pi / 2,))
    add_labels(axes, labels, toward=toward)


def quantity_title(scene: Mechanism, quantity: Quantity) -> str:
    """Symbol and unit of a quantity as markup."""
    letter, name = str(quantity.kind), quantity.of.split("/")[0]
    if quantity.symbol is not None:
        letter, name = quantity.symbol.kind, str(quantity.symbol).removeprefix(f"{quantity.symbol.kind}_")
    greek = {"theta": "θ", "omega": "ω", "alpha": "α", "gamma": "γ", "pressure": "α^{p}", "d": "l"}.get(letter, letter)
    return f"${greek}_{{{name.replace('@', '')}}}$ ({quantity.unit(scene).written})"


def panel_of(
    turn: TurnStudy, axis: DriverAxis, quantity: Quantity, traced: Traced | None, dots: Sequence[tuple[float, float]],
    laid_over: Sequence[tuple[float, float]] = (),
) -> DiagramPanel:
    """What the panel of a quantity shows.

    Parameters
    ----------
    dots, laid_over : offset of the driver and value (SI) of what was measured on the drawing, and of what somebody else
        measured
    """
    reach, scene = turn.reach, turn.scene
    offsets = axis.offsets
    x = axis.at(offsets)
    values = _shown(axis, quantity, offsets, quantity.values(reach, axis.motion))
    if reach.full:
        # the axis ends where it begins, a turn later
        x[0], x[-1] = axis.left, axis.right
        gain = _gain(axis, quantity) if quantity.kind == "theta" else 0.0
        values[-1] = values[0] + quantity.unit(scene).of(gain)
    title = quantity_title(scene, quantity)
    points, others = (_points(axis, quantity, some) for some in (dots, laid_over))
    curve = np.stack([x, values], axis=1)
    low, high = span_of(curve, points, bounded=reach.full or quantity.is_position)
    low, high = min([low, *others[:, 1].tolist()]), max([high, *others[:, 1].tolist()])
    span = low - MARGIN * (high - low), high + MARGIN * (high - low)
    extremes = [e for e in (traced.extremes if traced else ()) if e.kind != "end"]
    places = np.array([e.offset for e in extremes])
    shown = _shown(axis, quantity, places, np.array([e.value for e in extremes]))
    marked = [
        (e, float(place), float(value)) for e, place, value in zip(extremes, axis.at(places), shown, strict=True)
        if span[0] <= value <= span[1]
    ]  # fmt: skip
    local = frozenset(e for e, _, _ in marked if traced and turn.is_local(traced, e))
    unbounded = traced is not None and turn.is_unbounded(traced)
    return DiagramPanel(
        quantity, title, curve, points, tuple(marked), span, local, unbounded, *_allowed(quantity, scene), others
    )  # fmt: skip


def _allowed(quantity: Quantity, scene: Mechanism) -> tuple[tuple[float, float] | None, float | None]:
    """Within what (degrees) a transmission or pressure angle shall stay; of a cam's follower what the scene allows as
    it rises, and as it falls."""
    symbol = quantity.symbol
    cam = next((c for c in scene.cams if symbol and symbol.kind == "pressure" and c.follower == symbol.link), None)
    if cam is not None and any(cam.allowed):
        rise, fall = (math.degrees(limit) if limit else None for limit in cam.allowed)
        return (0.0, float(rise or fall or 0.0)), fall if rise else None
    return _usual(quantity), None


def _usual(quantity: Quantity) -> tuple[float, float] | None:
    kind = quantity.symbol.kind if quantity.symbol is not None else ""
    return {"gamma": (LEAST_GAMMA, 90.0), "pressure": (0.0, 90.0 - LEAST_GAMMA)}.get(kind)


def _points(axis: DriverAxis, quantity: Quantity, pairs: Sequence[tuple[float, float]]) -> Array:
    """Offsets and values (SI) as points of the panel."""
    if not len(pairs):
        return EMPTY
    reach = axis.reach
    at, read = np.array(pairs, dtype=float).T
    if quantity.measure == "angle" and quantity.kind == "theta":
        # an angle that is measured tells no whole turns
        near = quantity.values(reach, axis.motion_at(at))
        read = read + 2 * np.pi * np.rint((near - read) / (2 * np.pi))
    points = np.stack([axis.at(at), _shown(axis, quantity, at, read)], axis=1)
    return np.asarray(points[np.isfinite(points).all(axis=1)])


def signs_of(panels: Sequence[DiagramPanel], language: str) -> list[tuple[Look, str]]:
    """What the marks of some panels mean, as entries of a legend."""
    entries = [(look(SOLID_AND_DASHED[0]), word("analytic curve", language))]
    if any(len(panel.dots) for panel in panels):
        entries.append((marker("circle"), word("measured dots", language)))
    if any(len(panel.laid_over) for panel in panels):
        entries.append((marker("cross"), word("laid over", language)))
    for kind, key in (("max", "greatest"), ("min", "least")):
        shown = [e in panel.local for panel in panels for e, _, _ in panel.extremes if e.kind == kind]
        if shown:
            named = f"local {key}" if all(shown) else key
            entries.append((marker("up" if kind == "max" else "down"), word(named, language)))
    for panel in panels:
        if panel.allowed is not None:
            low, high = panel.allowed
            told = f"≥ {low:g}°" if high == 90.0 else f"≤ {high:g}°"
            if panel.falling:
                told = say(Phrase("rising and falling", (f"{high:g}°", f"{panel.falling:g}°")), language)
            own = panel.quantity.symbol is not None and panel.allowed != _usual(panel.quantity)
            entries.append((look(LIMIT), say(Phrase("allowed by scene" if own else "allowed band", (told,)), language)))
    return entries


def _shown(axis: DriverAxis, quantity: Quantity, offset: Array, values: Array) -> Array:
    """Values in units of the figure; an angle of a link without a jump along the axis."""
    reach = axis.reach
    values = np.asarray(values, dtype=float)
    if quantity.kind == "theta" and reach.full:
        values = np.where(offset < axis.first - 1e-12, values + _gain(axis, quantity), values)
        left = quantity.values(reach, axis.beside_ends)[2]
        values = values - 2 * np.pi * np.rint(left / (2 * np.pi))
    return np.asarray(quantity.unit(reach.scene).of(values))


def _gain(axis: DriverAxis, quantity: Quantity) -> float:
    """How far an angle gets over the whole range, in whole turns: beside the ends, which may be dead points."""
    first, last = quantity.values(axis.reach, axis.beside_ends)[:2]
    return float(2 * np.pi * np.rint((last - first) / (2 * np.pi)))


def span_of(curve: Array, dots: Array, bounded: bool) -> tuple[float, float]:
    """The range of values worth showing: all of it, but of what grows without bound near the ends of a limited
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
