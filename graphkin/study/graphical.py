"""Graphical differentiation and integration of a motion diagram, with chords and a pole.

The ordinates are measured on the drawn positions.  A line from the pole, H mm before the ordinate axis, parallel to a
chord of the diagram cuts the axis at the mean rate of that interval: with the scales mu_y and mu_t the derivative has
the scale mu_y / (mu_t H).  Integrating, the line from the pole to the height of the middle ordinate is the chord's
direction, and the scale is mu_y mu_t H (Artobolevsky, Theory of Mechanisms and Machines, ch. 4).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphkin.checking.readings import read_off
from graphkin.construction import Sheet, draft
from graphkin.construction.scales import next_of_series
from graphkin.drawing import Drawing
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Polyline, Primitive, Run, Stroke, Text
from graphkin.drawing.ink.symbols import POINTER, arrowhead
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.piece import Piece, layer_groups
from graphkin.drawing.text import fitted, plain, rich, symbol, wrapped
from graphkin.errors import CallError, GraphkinError, Problem, Unsolvable, did_you_mean
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import DriverRange, Motion
from graphkin.study.charts import number, title_of
from graphkin.table import Column, Table
from graphkin.words import Phrase, say, word

__all__ = [
    "Chords", "Ordinate", "Way", "chords_page", "chords_table", "graphical", "known_ordinate",
    "ordinate_chains",
]  # fmt: skip

Array = NDArray[np.float64]
Way = Literal["derivative", "integral"]

INTERVALS = 24  # of a turn
WIDE = 144.0  # mm, of the time axis
TALL = 44.0  # mm, of the greatest ordinate
POLES = (40.0, 30.0, 25.0, 20.0, 15.0, 10.0)  # mm; the longest at which the lines stay on the paper is taken
INSIDE = 0.02  # of a range that ends, left out at its ends, where rates may grow without bound


@dataclass(frozen=True)
class Ordinate:
    """A quantity with a sign that may be differentiated or integrated: angle, travel or coordinate, or a rate of one.

    name : "theta_4", "omega_4", "alpha_4"; "s_6/1", "v_6/1", "a_6/1"; "x_C", "v_C.x", "a_C.x"
    symbol : as it is asked of a drawing
    along : of a vector the direction of unit length along which it counts; 1 for numbers
    """

    name: str
    symbol: Symbol
    along: complex = 1.0

    def drawn(self, sheet: Sheet) -> float | None:
        """Its value (SI) on a drawing; None where it is not there."""
        readings = read_off(sheet, (self.symbol,))
        return (complex(readings[0].value) * self.along.conjugate()).real if readings else None

    def solved(self, reach: DriverRange, motion: Motion) -> Array:
        """Its values (SI) in a motion; angles go on from those before."""
        if self.symbol.kind == "theta":
            return reach.angle(motion, self.symbol.link)
        return np.asarray((motion.value(self.symbol) * self.along.conjugate()).real)


@dataclass(frozen=True)
class Chords:
    """A diagram that is differentiated or integrated on paper (mm), and what it gives, beside the exact values (SI).

    Parameters
    ----------
    x, y : nodes of the given diagram; shape (n + 1,); of an integral ``y`` holds the ordinates in the middles, (n,)
    pole : its distance H before the ordinate axis
    rays : where the lines from the pole cut the ordinate axis, (n,)
    found : what comes out, in the middles (n,) of a derivative, at the nodes (n + 1,) of an integral
    exact : the solver's values there; of an integral from its start on
    means : of a derivative the exact mean rates of the intervals, which chords give
    per_x, per_y, per_found : rad or m of the driver's way, and SI, for one mm
    """

    way: Way
    given: Ordinate
    result: Ordinate
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
        return np.asarray((self.x[1:] + self.x[:-1]) / 2)

    @property
    def places(self) -> Array:
        """Where the results stand on the time axis (mm)."""
        return self.middles if self.way == "derivative" else self.x

    @property
    def measured(self) -> Array:
        """The results, measured (SI)."""
        return np.asarray(self.found * self.per_found)

    @property
    def off(self) -> float:
        """How far the method is off at most, as a part of the greatest exact value: chords are no tangents."""
        most = float(np.max(np.abs(self.exact), initial=0.0))
        return float(np.max(np.abs(self.measured - self.exact))) / most if most else 0.0

    def table(self, scene: Mechanism, driver: str, values: Array, unit: str) -> Table:
        """A row for each result: driver, mm on paper, measured, exact, difference; in scene units, degrees."""
        own = scene.units.of(self.result.symbol.measure)
        measured, exact = own.of(self.measured), own.of(self.exact)
        return Table((
            Column(f"driver_{driver}", values, unit),
            Column("on_paper_mm", np.round(self.found, 4), "mm"),
            Column(self.result.name, measured, own.text),
            Column("exact", exact, own.text),
            Column("difference", measured - exact, own.text),
        ))  # fmt: skip


def ordinate_chains(scene: Mechanism) -> Iterator[tuple[Ordinate, ...]]:
    """Position, rate and second rate of each link, of each sliding pair (of one on the frame the rates too, which are
    those of its pin along the guide), and of each point along both axes."""
    for link in (link.name for link in scene.links):
        yield tuple(Ordinate(f"{kind}_{link}", Symbol(kind, link=link)) for kind in ("theta", "omega", "alpha"))
    for pair in scene.slidings:
        travel = Ordinate(f"s_{pair.key}", Symbol("s", link=pair.link, other=pair.on))
        rates = "va" if pair.on == scene.frame.name and pair.pin is not None else ""
        along = scene.frame.guides[pair.guide].direction if rates else 1.0
        yield travel, *(Ordinate(f"{k}_{pair.key}", Symbol(k, PointRef(pair.pin or "")), along) for k in rates)
    for point in map(PointRef, scene.holders):
        for axis, along in (("x", 1.0 + 0j), ("y", 1j)):
            moving = (Ordinate(f"{kind}_{point}.{axis}", Symbol(kind, point), along) for kind in "va")
            yield Ordinate(f"{axis}_{point}", Symbol(axis, point)), *moving


def _chain_of(scene: Mechanism, name: str) -> tuple[tuple[Ordinate, ...], int]:
    """A quantity by its name: its place among position, rate and second rate.

    Raises
    ------
    CallError : no such quantity, or one without a sign
    """
    places = {one.name: (chain, k) for chain in ordinate_chains(scene) for k, one in enumerate(chain)}
    if name not in places:
        found = Phrase("is no quantity with a sign here")
        raise CallError(Problem(Phrase("quantity of name", name=f"{name:.60}"), found, did_you_mean(name, places)))
    return places[name]


def known_ordinate(scene: Mechanism, name: str, way: Way) -> tuple[Ordinate, Ordinate]:
    """What is differentiated or integrated, and what comes out.

    Raises
    ------
    CallError : no such quantity, none that comes out, or a driver that does not move evenly
    """
    chain, k = _chain_of(scene, name)
    wanted = k + (1 if way == "derivative" else -1)
    if not 0 <= wanted < len(chain):
        says = (
            Phrase("has no further rate here")
            if way == "derivative"
            else Phrase("is a position integrate a rate of it")
        )
        raise CallError(Problem(f"{way} of {name}", says, Phrase("one of", names=', '.join(o.name for o in chain))))
    _, rate, second = scene.drivers[0].values
    if rate == 0.0 or second != 0.0:
        raise CallError(
            Problem(
                f"{way} of {name}",
                Phrase("the driver does not move evenly"),
                Phrase("give it a rate and no second rate"),
            )
        )
    return chain[k], chain[wanted]


def graphical(reach: DriverRange, name: str, way: Way) -> Chords:
    """Differentiate or integrate the diagram of a quantity over the driver's range.

    Raises
    ------
    CallError : no such quantity; the rate asked for is none; a driver that does not move evenly
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
    at = nodes if way == "derivative" else middles
    values = _drawn(reach, given, at)
    if given.symbol.measure == "angle":
        values = np.unwrap(values)
    unit = scene.units.of(given.symbol.measure)
    per_y = unit.si * next_of_series(float(unit.of(np.max(np.abs(values), initial=1e-300))) / TALL)
    y = values / per_y
    widths = np.diff(x)
    there = reach.motion(middles if way == "derivative" else nodes)
    exact = np.asarray(result.solved(reach, there), dtype=float)
    means = np.zeros(0)
    if way == "derivative":
        slopes = np.diff(y) / widths
        pole = next((h for h in POLES if h * np.max(np.abs(slopes)) <= TALL), POLES[-1])
        rays = slopes * pole
        found, per_found = rays, per_y / (per_x * pole)
        means = np.diff(np.asarray(given.solved(reach, reach.motion(nodes)), dtype=float)) / (per_x * widths)
    else:
        # so that the broken line stays on the paper
        steps = y * widths
        tallest = max(float(np.ptp(np.concatenate([[0.0], np.cumsum(steps)]))), 1e-300)
        pole = next((h for h in reversed(POLES) if tallest / h <= TALL), POLES[0])
        rays = y
        found = np.concatenate([[0.0], np.cumsum(steps / pole)])
        per_found = per_y * per_x * pole
        exact = exact - exact[0]
    return Chords(way, given, result, x, y, pole, rays, found, exact, means, at, per_x, per_y, per_found)


def _drawn(reach: DriverRange, given: Ordinate, offsets: Array) -> Array:
    """The ordinates, measured on a drawing of each position."""
    scene, found = reach.scene, []
    for offset in offsets:
        values = dict(zip((d.key for d in scene.drivers), reach.values(np.array([offset]))[0].tolist(), strict=True))
        try:
            value = given.drawn(draft(reach.structure, values, (given.symbol,)))
        except GraphkinError as error:
            raise Unsolvable("not drawn", *error.problems) from None
        if value is None:
            raise Unsolvable("not drawn", Problem(given.name, Phrase("cannot be measured on the drawing of this")))
        found.append(value)
    return np.array(found)


WIDTH, MARGIN = 210.0, 10.0
ORIGIN = 52.0  # mm from the left edge: room for the pole
ROOM = 7.0  # above and below a diagram
GAP = 16.0
CURVE, EXACT = Stroke(0.5), Stroke(0.25, (2.4, 1.0), "#b0470b")
CHORD = Stroke(0.25, (), "#0b62a5")
RAY, ACROSS = Stroke(0.13, (), "#0b62a5"), Stroke(0.1, (), "#909090")
AXIS, TICK = Stroke(0.25), 1.2
PARTS = 6  # of an interval, in a curve through its ends
_GREEK = {"theta": "θ", "omega": "ω", "alpha": "α"}


def markup_of(one: Ordinate) -> str:
    """The letter of a quantity: ``θ_{4}``, ``s_{61}``, ``v_{Cx}``."""
    kind, _, rest = one.name.partition("_")
    return f"{_GREEK.get(kind, kind)}_{{{rest.replace('/', '').replace('.', '').replace('@', '')}}}"


def _per_mm(unit: str) -> str:
    return f"({unit})/mm" if "/" in unit else f"{unit}/mm"


def chords_page(chords: Chords, reach: DriverRange, language: str) -> Drawing:
    """Draw it.  One mm of the file is one mm on paper, so that what a ruler measures times the scale is the value."""
    scene = reach.scene
    of_given, of_result = scene.units.of(chords.given.symbol.measure), scene.units.of(chords.result.symbol.measure)
    given, result = markup_of(chords.given), markup_of(chords.result)
    title = say(Phrase(f"graphical {chords.way}", (f"${result}$", f"${given}$")), language)
    per_y, per_found = of_given.of(chords.per_y), of_result.of(chords.per_found)
    scales = (
        f"$μ_{{{given[0]}}}$ = {number(per_y)} {_per_mm(of_given.written)}",
        f"$μ_{{t}}$ = {number(chords.per_x)} s/mm", f"$H$ = {number(chords.pole)} mm",
        f"$μ_{{{result[0]}}}$ = {number(per_found)} {_per_mm(of_result.written)}",
    )  # fmt: skip
    facts = [",  ".join(scales), say(Phrase(f"graphical {chords.way} off", (f"{100 * chords.off:.2g}",)), language)]
    words: list[Primitive] = [
        Text(complex(MARGIN, 15.0), rich(title, 4.6, bold=True), classes=("heading",)),
        Text(complex(MARGIN, 20.5), fitted(title_of(scene, language), 3.2, WIDTH - 2 * MARGIN)),
    ]
    y = 22.0
    for fact in facts:
        for runs in wrapped(fact, 3.0, WIDTH - 2 * MARGIN):
            y += 4.4
            words.append(Text(complex(MARGIN, y), runs))
    exact = chords.exact / chords.per_found
    upper, lower = (chords.y, np.concatenate([chords.found, exact]))
    top = complex(ORIGIN, y + ROOM + 8.0 + max(0.0, float(upper.max())))
    middle = top.imag + max(0.0, -float(upper.min())) + ROOM
    bottom = complex(ORIGIN, middle + GAP + max(0.0, float(lower.max())))
    end = bottom.imag + max(0.0, -float(lower.min())) + ROOM
    drawn = [*_axes(chords, top, chords.y, given, reach), *_axes(chords, bottom, lower, result, reach)]
    thin: list[Primitive] = []
    if chords.way == "derivative":
        _derivative(chords, top, bottom, drawn, thin)
    else:
        _integral(chords, top, bottom, drawn, thin)
    solved = tuple(bottom + complex(x, -v) for x, v in zip(chords.places, exact, strict=True))
    drawn.append(Group((Polyline(_smooth(solved), EXACT),), id="exact", classes=("exact",)))
    foot = complex(MARGIN, end + 8.0)
    words += _legend(foot, chords, language)
    words += check_bar(complex(WIDTH - MARGIN - 50.0, end + 14.0), rich(word("check bar", language), 2.5))
    page = Piece({"construction": tuple(thin), "answers": tuple(drawn), "labels": tuple(words)})
    return Drawing(
        WIDTH, end + 20.0, layer_groups(page), f"{title.replace('$', '')}: {title_of(scene, language)}",
        " ".join(fact.replace("$", "") for fact in facts), language,
        {"scene": scene.name, "units": scene.units.length, "given": chords.given.name, "result": chords.result.name,
         "pole": chords.pole, "scales": {"given": per_y, "time": chords.per_x, "result": per_found}},
    )  # fmt: skip


def chords_table(chords: Chords, reach: DriverRange) -> bytes:
    """What comes out, as CSV."""
    scene, driver = reach.scene, reach.driver
    share = chords.places / chords.x[-1]
    nodes = np.interp(share, [0.0, 1.0], [chords.at[0], chords.at[-1]])
    if chords.way == "integral":  # ordinates stand in the middles
        half = (chords.at[1] - chords.at[0]) / 2
        nodes = np.interp(share, [0.0, 1.0], [chords.at[0] - half, chords.at[-1] + half])
    values = reach.value(nodes)
    unit = scene.unit_of(driver)
    return chords.table(scene, driver.key, np.round(unit.of(values), 9), unit.text).csv().encode("utf-8-sig")


def _axes(chords: Chords, origin: complex, values: Array, letter: str, reach: DriverRange) -> list[Primitive]:
    wide, high, low = float(chords.x[-1]), max(0.0, float(values.max())), max(0.0, -float(values.min()))
    parts: list[Primitive] = []
    for start, tip in ((origin, origin + wide + 8.0), (origin + 1j * low, origin - 1j * (high + 6.0))):
        head = arrowhead(tip, tip - start, POINTER.head_length, POINTER.head_width, strokes.BLACK)
        parts += [Line(start, tip, AXIS, 2.0), head]
    n, below = len(chords.x) - 1, origin.imag + low + 4.2  # no curve runs there
    step = next(k for k in (1, 2, 3, 4, 6, 12, 24, n) if 144.0 / n * k >= 5.5 or k == n)
    for k, x in enumerate(chords.x):
        at = origin + x
        parts.append(Line(at, at + 1j * TICK * (1.0 if k % step else 1.6), AXIS))
        if k and k % step == 0:
            parts.append(Text(complex(at.real, below), plain(str(k), 2.2), "middle", classes=("label",)))
    parts.append(Text(origin - 1j * (high + 7.5), symbol(letter, 3.5), "middle", classes=("label",)))
    parts.append(Text(origin + wide + 9.0 + 1.0j, symbol("t", 3.5), classes=("label",)))
    return [Group(tuple(parts), classes=("axes",))]


def _pole(chords: Chords, origin: complex, thin: list[Primitive]) -> complex:
    """The pole before the ordinate axis, with its distance."""
    pole = origin - chords.pole
    thin += [Line(pole, origin, AXIS), Circle(pole, 0.7, "#ffffff", strokes.OUTLINE)]
    thin.append(Text(pole - 1.8 + 1.0j, symbol("P", 3.5), "end", classes=("label",)))
    above = pole - 1j * (max(0.0, float(chords.rays.max())) + 3.0)
    thin += _dimensioned(above, above + chords.pole, rich(f"$H$ = {number(chords.pole)}", 2.4))
    for tall in chords.rays:
        thin.append(Line(pole, origin - 1j * float(tall), RAY))
    return pole


def _dimensioned(start: complex, end: complex, words: tuple[Run, ...]) -> list[Primitive]:
    """A level dimension line with its value above it."""
    ends = ((start, end), (end, start))
    heads = [arrowhead(tip, tip - tail, POINTER.head_length, POINTER.head_width, strokes.BLACK) for tail, tip in ends]
    bars = [Line(z - 1.2j, z + 1.2j, strokes.DIMENSION) for z in (start, end)]
    middle = (start + end) / 2 - 1.0j
    return [Line(start, end, strokes.DIMENSION), *bars, *heads, Text(middle, words, "middle", classes=("label",))]


def _derivative(chords: Chords, top: complex, bottom: complex, drawn: list[Primitive], thin: list[Primitive]) -> None:
    nodes = tuple(top + complex(x, -v) for x, v in zip(chords.x, chords.y, strict=True))
    thin += [Group((Line(a, b, CHORD),), id=f"chord-{k}", classes=("chord",))
             for k, (a, b) in enumerate(pairwise(nodes), 1)]  # fmt: skip
    drawn += [Polyline(_smooth(nodes), CURVE), *(Circle(z, 0.45, "#000000") for z in nodes)]
    _pole(chords, bottom, thin)
    ends = tuple(bottom + complex(x, -v) for x, v in zip(chords.middles, chords.found, strict=True))
    thin += [Line(complex(bottom.real, z.imag), z, ACROSS) for z in ends]
    thin += [Line(complex(z.real, top.imag), z, ACROSS) for z in ends]
    drawn.append(Group((Polyline(_smooth(ends), CURVE),), id="result", classes=("result",)))
    drawn += [Circle(z, 0.6, "#ffffff", strokes.OUTLINE) for z in ends]


def _integral(chords: Chords, top: complex, bottom: complex, drawn: list[Primitive], thin: list[Primitive]) -> None:
    ends = tuple(top + complex(x, -v) for x, v in zip(chords.middles, chords.y, strict=True))
    drawn += [Polyline(_smooth(ends), CURVE), *(Circle(z, 0.45, "#000000") for z in ends)]
    _pole(chords, top, thin)
    thin += [Line(complex(top.real, z.imag), z, ACROSS) for z in ends]
    thin += [Line(z, complex(z.real, top.imag), ACROSS) for z in ends]
    nodes = tuple(bottom + complex(x, -v) for x, v in zip(chords.x, chords.found, strict=True))
    thin += [Group((Line(a, b, CHORD),), id=f"chord-{k}", classes=("chord",))
             for k, (a, b) in enumerate(pairwise(nodes), 1)]  # fmt: skip
    drawn.append(Group((Polyline(_smooth(nodes), CURVE),), id="result", classes=("result",)))
    drawn += [Circle(z, 0.6, "#ffffff", strokes.OUTLINE) for z in nodes]


def _smooth(points: tuple[complex, ...]) -> tuple[complex, ...]:
    """A curve through points, as one draws it with a French curve: in each the slope of its neighbours' chord."""
    z = np.array(points)
    if len(z) < 3:
        return points
    slopes = np.gradient(z)
    u = np.linspace(0.0, 1.0, PARTS, endpoint=False)[:, None]
    a, b, s, t = z[:-1], z[1:], slopes[:-1], slopes[1:]
    curve = (1 + 2 * u) * (1 - u) ** 2 * a + u * (1 - u) ** 2 * s + u * u * (3 - 2 * u) * b + u * u * (u - 1) * t
    return (*curve.T.ravel().tolist(), points[-1])


def _legend(at: complex, chords: Chords, language: str) -> list[Primitive]:
    entries = ((CURVE, f"by {chords.way}"), (CHORD, "chords"), (EXACT, "analytic curve"))
    parts: list[Primitive] = []
    x = at.real
    for stroke, key in entries:
        parts.append(Line(complex(x, at.imag - 0.9), complex(x + 9.0, at.imag - 0.9), stroke))
        parts.append(Text(complex(x + 11.0, at.imag), rich(word(key, language), 2.8)))
        x += 46.0
    return parts
