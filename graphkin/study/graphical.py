"""Graphical differentiation and integration of a motion diagram, with chords and a pole.

The ordinates are measured on the drawn positions.  A line from the pole, H mm before the ordinate axis, parallel to a
chord of the diagram cuts the axis at the mean rate of that interval: with the scales mu_y and mu_t the derivative has
the scale mu_y / (mu_t H).  Integrating, the line from the pole to the height of the middle ordinate is the chord's
direction, and the scale is mu_y mu_t H (Artobolevsky, Theory of Mechanisms and Machines, ch. 4).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from graphkin.account.notation import per_mm
from graphkin.account.spoken import spoken_words
from graphkin.checking.readings import read_off
from graphkin.construction import Sheet, draft
from graphkin.construction.board.scales import next_of_series
from graphkin.drawing import Box, Stroke, Text
from graphkin.drawing.chart import ChartPage, add_legend, add_panel, add_words, look, marker
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.text import fitted, rich, wrapped
from graphkin.errors import CallError, GraphkinError, Problem, Unsolvable, did_you_mean
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import DriverRange
from graphkin.study.charts import lettered, number
from graphkin.study.quantities import course_of, link_quantities, slide_quantities
from graphkin.table import Column, Table
from graphkin.words import Phrase, listed, rich_text, say, word
from graphkin.words.symbols import Words, sign, spaced

if TYPE_CHECKING:
    from graphkin.drawing.chart import Axes, Figure

Array = NDArray[np.float64]
Way = Literal["derivative", "integral"]

INTERVALS = 24  # of a turn
WIDE = 144.0  # mm, of the time axis
TALL = 44.0  # mm, of the greatest ordinate
POLES = (40.0, 30.0, 25.0, 20.0, 15.0, 10.0)  # mm; the longest at which the lines stay on the paper is taken
INSIDE = 0.02  # of a range that ends, left out at its ends, where rates may grow without bound


def on_paper(scene: Mechanism, symbol: Symbol) -> tuple[Symbol, complex]:
    """The drawn form of a quantity with a sign: a number, or the vector of which it is a component; and the unit vector
    along which it counts.  A rate of a sliding pair on the frame is the rate of its pin along the guide."""
    if symbol.axis:
        return symbol.whole, 1.0 + 0j if symbol.axis == "x" else 1j
    if not symbol.is_rate_of_pair:
        return symbol, 1.0 + 0j
    pair = scene.sliding(symbol.pair)
    return Symbol(symbol.kind, PointRef(pair.pin)), pair.guide.direction


def drawn(sheet: Sheet, symbol: Symbol) -> float | None:
    """The value (SI) of a quantity with a sign on a drawing; None where it is not drawn."""
    vector, along = on_paper(sheet.scene, symbol)
    readings = read_off(sheet, (vector,))
    return (complex(readings[0].value) * along.conjugate()).real if readings else None


@dataclass(frozen=True)
class Chords:
    """A diagram differentiated or integrated on paper (mm), and its results, beside the exact values (SI).

    x, y : nodes of the given diagram; shape (n + 1,); of an integral ``y`` holds the ordinates in the middles, (n,)
    pole : its distance H before the ordinate axis
    rays : the ordinates at which the lines from the pole cut the ordinate axis, (n,)
    found : the results, in the middles (n,) of a derivative, at the nodes (n + 1,) of an integral
    exact : the solver's values there; of an integral from its start on
    means : of a derivative the exact mean rates of the intervals, which the chords give
    at : offsets of the driver at the results
    per_x, per_y, per_found : rad or m of the driver, and SI, for one mm
    """

    way: Way
    given: Symbol
    result: Symbol
    x: Array
    y: Array
    pole: float
    rays: Array
    found: Array
    exact: Array
    means: Array
    at: Array
    per_x: float
    per_y: float
    per_found: float

    @property
    def middles(self) -> Array:
        return (self.x[1:] + self.x[:-1]) / 2

    @property
    def places(self) -> Array:
        """The places of the results on the time axis (mm)."""
        return self.middles if self.way == "derivative" else self.x

    @property
    def measured(self) -> Array:
        """The results, measured (SI)."""
        return self.found * self.per_found

    @property
    def off(self) -> float:
        """The greatest error of the method over the greatest exact value: chords are no tangents."""
        most = float(np.max(np.abs(self.exact), initial=0.0))
        return float(np.max(np.abs(self.measured - self.exact))) / most if most else 0.0


def ordinate_chains(scene: Mechanism) -> Iterator[tuple[Symbol, ...]]:
    """Position, rate and second rate of each link, of each sliding pair (on the frame with rates, those of its pin
    along the guide), and of each point along both axes."""
    for link in scene.links:
        yield link_quantities(link.name)
    for pair in scene.slidings:
        yield slide_quantities(pair.key)[: 3 if pair.b == scene.frame.name and pair.pin else 1]
    for point in map(PointRef, scene.holders):
        for axis in ("x", "y"):
            yield Symbol(axis, point), *(Symbol(kind, point, axis=axis) for kind in "va")


def known_ordinate(scene: Mechanism, name: str, way: Way) -> tuple[Symbol, Symbol]:
    """The given quantity, and its derivative or integral.

    Raises
    ------
    CallError : no such quantity, or one without a sign; no result of it; a driver that does not move evenly
    """
    chains = {str(symbol): (chain, k) for chain in ordinate_chains(scene) for k, symbol in enumerate(chain)}
    if name not in chains:
        raise CallError.of(Phrase("quantity of name", name=f"{name:.60}"), "is no quantity with a sign here",
                           did_you_mean(name, chains))
    chain, k = chains[name]
    subject = Phrase("derivative of name" if way == "derivative" else "integral of name", name=name)
    wanted = k + (1 if way == "derivative" else -1)
    if not 0 <= wanted < len(chain):
        says = "has no further rate here" if way == "derivative" else "is a position integrate a rate of it"
        raise CallError.of(subject, says, "one of", names=listed([*map(str, chain)]))
    _, rate, second = scene.drivers[0].values
    if rate == 0.0 or second != 0.0:
        raise CallError.of(subject, "the driver does not move evenly", "give it a rate and no second rate")
    return chain[k], chain[wanted]


def graphical(reach: DriverRange, name: str, way: Way) -> Chords:
    """Differentiate or integrate the diagram of a quantity over the driver's range.

    Raises
    ------
    CallError : no such quantity; no rate of it; a driver that does not move evenly
    Unsolvable : a position cannot be drawn
    """
    scene = reach.scene
    given, result = known_ordinate(scene, name, way)
    rate = scene.drivers[0].values[1]
    low, high = reach.ends
    if not reach.full:
        low, high = low + INSIDE * (high - low), high - INSIDE * (high - low)
    nodes = np.linspace(low, high, INTERVALS * max(reach.turns, 1) + 1)
    middles = (nodes[1:] + nodes[:-1]) / 2
    x = np.linspace(0.0, WIDE, len(nodes))
    per_x = (high - low) / WIDE / abs(rate)  # s
    drawn, at = (nodes, middles) if way == "derivative" else (middles, nodes)
    values = _drawn(reach, given, drawn)
    if given.measure.is_angle:
        values = np.unwrap(values)
    unit = scene.units.of(given.measure)
    per_y = unit.si * next_of_series(float(unit.of(np.max(np.abs(values), initial=1e-300))) / TALL)
    y = values / per_y
    widths = np.diff(x)
    exact = np.asarray(course_of(result, reach, reach.motion(at)), dtype=float)
    means = np.zeros(0)
    if way == "derivative":
        slopes = np.diff(y) / widths
        pole = next((h for h in POLES if h * np.max(np.abs(slopes)) <= TALL), POLES[-1])
        rays = slopes * pole
        ordinates, per_found = rays, per_y / (per_x * pole)
        means = np.diff(np.asarray(course_of(given, reach, reach.motion(nodes)), dtype=float)) / (per_x * widths)
    else:
        # so that the broken line stays on the paper
        steps = y * widths
        tallest = max(float(np.ptp(np.concatenate([[0.0], np.cumsum(steps)]))), 1e-300)
        pole = next((h for h in reversed(POLES) if tallest / h <= TALL), POLES[0])
        rays = y
        ordinates = np.concatenate([[0.0], np.cumsum(steps / pole)])
        per_found = per_y * per_x * pole
        exact = exact - exact[0]
    return Chords(way, given, result, x, y, pole, rays, ordinates, exact, means, at, per_x, per_y, per_found)


def _drawn(reach: DriverRange, given: Symbol, offsets: Array) -> Array:
    """The ordinates, measured on a drawing of each position."""
    scene, ordinates = reach.scene, []
    for offset in offsets:
        values = scene.by_driver(reach.values(np.array([offset]))[0])
        try:
            value = drawn(draft(reach.structure, values, (on_paper(scene, given)[0],)), given)
        except GraphkinError as error:
            raise Unsolvable("not drawn", *error.problems) from None
        if value is None:
            raise Unsolvable("not drawn", Problem(str(given), "cannot be measured on the drawing of this"))
        ordinates.append(value)
    return np.array(ordinates)


WIDTH, MARGIN = 210.0, 8.0
LEFT, RIGHT = 46.0, 4.0  # mm of a panel before the ordinate axis, with room for the pole, and beyond the last node
ROOM = 7.0  # above and below a diagram
GAP = 16.0
STEP = 5.5  # between numbers of nodes
CURVE, EXACT = Stroke(0.5), Stroke(0.25, (2.4, 1.0), "#b0470b")
CHORD = Stroke(0.25, (), "#0b62a5")
RAY, ACROSS = Stroke(0.13, (), "#0b62a5"), Stroke(0.1, (), "#909090")
AXIS = Stroke(0.25)
PARTS = 6  # of an interval, in a curve through its ends


def chords_page(chords: Chords, reach: DriverRange, language: str) -> ChartPage:
    """The page of a diagram with its result.  One mm of the file is one mm on paper, so that a length by ruler times
    the scale is the value."""
    scene = reach.scene
    of_given, of_result = scene.units.of(chords.given.measure), scene.units.of(chords.result.measure)
    given, result = lettered(scene, chords.given), lettered(scene, chords.result)
    title = rich_text(Phrase(f"graphical {chords.way}", result=result, curve=given), language)
    per_y, per_found = of_given.of(chords.per_y), of_result.of(chords.per_found)
    scales = (
        sign("μ", str(given)[0]) + f" = {number(per_y)} {per_mm(of_given.written)}",
        sign("μ", "t") + f" = {number(chords.per_x)} s/mm", sign("H") + f" = {number(chords.pole)} mm",
        sign("μ", str(result)[0]) + f" = {number(per_found)} {per_mm(of_result.written)}",
    )
    accuracy = Phrase(f"graphical {chords.way} off", error=f"{100 * chords.off:.2g}")
    facts: list[Words] = [spaced(",  ", scales), say(accuracy, language)]
    lines = [runs for fact in facts for runs in wrapped(fact, 3.0, WIDTH - 2 * MARGIN)]
    exact = chords.exact / chords.per_found
    upper, lower = (
        (min(0.0, float(y.min())) - ROOM, max(0.0, float(y.max())) + ROOM)
        for y in (chords.y, np.concatenate([chords.found, exact]))
    )
    top = 22.0 + 4.4 * len(lines) + ROOM
    middle = top + upper[1] - upper[0]
    end = middle + GAP + lower[1] - lower[0]

    def paint(figure: Figure) -> None:
        add_words(
            figure,
            Text(complex(MARGIN, 15.0), rich(title, 4.6, bold=True)),
            Text(complex(MARGIN, 20.5), fitted(scene.question.title_in(language), 3.2, WIDTH - 2 * MARGIN)),
            *(Text(complex(MARGIN, 22.0 + 4.4 * k), runs) for k, runs in enumerate(lines, 1)),
        )
        above = _panel(figure, chords, top, upper, "given", given + f" ({of_given.written})")
        below = _panel(figure, chords, middle + GAP, lower, "result", result + f" ({of_result.written})")
        at_nodes, at_middles = (above, below) if chords.way == "derivative" else (below, above)
        # where the lines from the pole are, which are parallel to the chords
        origin = complex(MARGIN + LEFT, top + upper[1] if at_middles is above else end + lower[0])
        _pole(figure, chords, at_middles, origin)
        values = {above: chords.y, below: chords.found}
        nodes = np.stack([chords.x, values[at_nodes]], axis=1)
        for k in range(len(nodes) - 1):
            at_nodes.plot(*nodes[k : k + 2].T, gid=f"chord-{k + 1}", **look(CHORD))
        for x, y in zip(chords.middles, values[at_middles], strict=True):
            at_middles.plot([0.0, x], [y, y], **look(ACROSS))
            for axes in (above, below):
                axes.axvline(x, zorder=0.6, **look(ACROSS))
        below.plot(*_smooth(chords.places, exact), gid="exact", **look(EXACT))
        for axes, filled in ((above, "#000000"), (below, "#ffffff")):
            x = chords.x if axes is at_nodes else chords.middles
            axes.plot(*_smooth(x, values[axes]), gid="curve" if axes is above else "found", **look(CURVE))
            axes.plot(x, values[axes], **{**marker("circle"), "markersize": 2.5, "markerfacecolor": filled})
        entries = ((CURVE, f"by {chords.way}"), (CHORD, "chords"), (EXACT, "analytic curve"))
        legend = [(look(stroke), word(key, language)) for stroke, key in entries]
        add_legend(figure, complex(MARGIN, end + 10.0), legend)
        check = rich(say(Phrase("check bar", length="50 mm"), language), 2.5)
        add_words(figure, *check_bar(complex(WIDTH - MARGIN - 50.0, end + 16.0), check))

    return ChartPage(
        WIDTH, end + 22.0, paint, f"{title.plain()}: {scene.question.title_in(language)}",
        spoken_words(spaced(" ", facts), language), language,
        {"scene": scene.name, "units": scene.units.length, "given": str(chords.given), "result": str(chords.result),
         "pole": chords.pole, "scales": {"given": per_y, "time": chords.per_x, "result": per_found}},
    )


def chords_table(chords: Chords, reach: DriverRange) -> bytes:
    """A row for each result: driver, mm on paper, measured, exact, difference; in scene units, degrees, as CSV."""
    scene, driver = reach.scene, reach.driver
    place, unit = scene.unit_of(driver), scene.units.of(chords.result.measure)
    measured, exact = unit.of(chords.measured), unit.of(chords.exact)
    table = Table((
        Column(f"driver_{driver.key}", np.round(place.of(reach.value(chords.at)), 9), place.text),
        Column("on_paper_mm", np.round(chords.found, 4), "mm"),
        Column(str(chords.result), measured, unit.text),
        Column("exact", exact, unit.text),
        Column("difference", measured - exact, unit.text),
    ))
    return table.csv().encode("utf-8-sig")


def _panel(figure: Figure, chords: Chords, top: float, span: tuple[float, float], id: str, title: Words) -> Axes:
    """A panel whose values are mm on paper, with its two axes and the numbers of the nodes."""
    box = Box(MARGIN, top, MARGIN + LEFT + WIDE + RIGHT, top + span[1] - span[0])
    axes = add_panel(figure, box, id, title, sign("t"))
    n = len(chords.x) - 1
    step = next(k for k in (1, 2, 3, 4, 6, 12, 24, n) if WIDE / n * k >= STEP or k == n)
    axes.set(xlim=(-LEFT, WIDE + RIGHT), ylim=span, yticks=[], xticks=chords.x[::step])
    axes.set_xticklabels([str(k) for k in range(0, n + 1, step)])
    axes.axhline(0.0, **look(AXIS))
    axes.axvline(0.0, **look(AXIS))
    return axes


def _pole(figure: Figure, chords: Chords, axes: Axes, origin: complex) -> None:
    """Draw the pole before the ordinate axis with its distance, and the lines from it; ``origin`` of the panel in mm of
    the page."""
    for tall in chords.rays:
        axes.plot([-chords.pole, 0.0], [0.0, tall], **look(RAY))
    axes.plot([-chords.pole], [0.0], **marker("circle"))
    level = max(0.0, float(chords.rays.max())) + 3.0
    ends = {"arrowstyle": "<|-|>", "linewidth": 0.4, "facecolor": "#000000", "shrinkA": 0.0, "shrinkB": 0.0}
    axes.annotate("", (-chords.pole, level), (0.0, level), arrowprops=ends, annotation_clip=False)
    add_words(
        figure,
        Text(origin - chords.pole - 1.8 + 1.0j, rich(sign("P"), 3.5), "end", classes=("label",)),
        Text(
            origin - chords.pole / 2 - 1j * (level + 1.0), rich(sign("H") + f" = {number(chords.pole)}", 2.4), "middle"
        ),
    )


def _smooth(x: Array, y: Array) -> Array:
    """A curve through points, as drawn with a French curve: at each point the slope of its neighbours' chord; shape (2,
    points)."""
    z = np.stack([x, y])
    if len(x) < 3:
        return z
    slopes = np.gradient(z, axis=1)
    u = np.linspace(0.0, 1.0, PARTS, endpoint=False)[:, None, None]
    a, b, s, t = z[:, :-1], z[:, 1:], slopes[:, :-1], slopes[:, 1:]
    curve = (1 + 2 * u) * (1 - u) ** 2 * a + u * (1 - u) ** 2 * s + u * u * (3 - 2 * u) * b + u * u * (u - 1) * t
    return np.concatenate([curve.transpose(1, 2, 0).reshape(2, -1), z[:, -1:]], axis=1)
