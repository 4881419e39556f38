"""Graphical differentiation and integration of a motion diagram, with chords and a pole.

The ordinates are measured on the drawn positions.  A line from the pole, H mm before the ordinate axis, parallel to a
chord of the diagram cuts the axis at the mean rate of that interval: with the scales mu_y and mu_t the derivative has
the scale mu_y / (mu_t H).  Integrating, the line from the pole to the height of the middle ordinate is the chord's
direction, and the scale is mu_y mu_t H (Artobolevsky, Theory of Mechanisms and Machines, ch. 4).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphkin.checking.readings import read_off
from graphkin.construction import Sheet, draft
from graphkin.construction.scales import next_of_series
from graphkin.errors import CallError, GraphkinError, Problem, Unsolvable, did_you_mean
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Measure
from graphkin.solver import DriverRange, Motion
from graphkin.table import Column, Table
from graphkin.words import Phrase

__all__ = ["Chords", "Ordinate", "Way", "graphical", "known_ordinate"]

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
    drawn : its value (SI) on a drawing, None where it is not there
    solved : its values in a motion
    """

    name: str
    measure: Measure
    asked: tuple[Symbol, ...]
    drawn: Callable[[Sheet], float | None]
    solved: Callable[[DriverRange, Motion], Array]


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
        own = scene.units.of(self.result.measure)
        measured, exact = own.of(self.measured), own.of(self.exact)
        return Table((
            Column(f"driver_{driver}", values, unit),
            Column("on_paper_mm", np.round(self.found, 4), "mm"),
            Column(self.result.name, measured, own.text),
            Column("exact", exact, own.text),
            Column("difference", measured - exact, own.text),
        ))  # fmt: skip


def _chain_of(scene: Mechanism, name: str) -> tuple[tuple[Ordinate, ...], int]:
    """A quantity by its name: its place among position, rate and second rate.

    Raises
    ------
    CallError : no such quantity, or one without a sign
    """
    kind, _, rest = name.partition("_")
    links = [link.name for link in scene.links]
    if kind in ("theta", "omega", "alpha") and rest in links:
        return _of_link(rest), ("theta", "omega", "alpha").index(kind)
    if kind in ("s", "v", "a") and any(p.key == rest for p in scene.slidings):
        chain = _of_slide(scene, rest)
        k = "sva".index(kind)
        if k < len(chain):
            return chain, k
    point, dot, axis = rest.partition(".")
    if kind in ("x", "y") and rest in scene.holders:
        return _of_point(rest, kind), 0
    if kind in ("v", "a") and dot and axis in ("x", "y") and point in scene.holders:
        return _of_point(point, axis), "-va".index(kind)
    known = [f"{k}_{n}" for n in links for k in ("theta", "omega", "alpha")]
    known += [f"s_{p.key}" for p in scene.slidings] + [f"x_{p}" for p in scene.holders]
    usual = Phrase("name an angle a travel a coordinate or")
    wanted = did_you_mean(name, known) or usual
    raise CallError(
        Problem(Phrase("quantity of name", name=f"{name:.60}"), Phrase("is no quantity with a sign here"), wanted)
    )


def _of_link(link: str) -> tuple[Ordinate, ...]:
    def drawn(symbol: Symbol) -> Callable[[Sheet], float | None]:
        return lambda sheet: _read(sheet, symbol)

    kinds: tuple[tuple[str, Measure], ...] = (
        ("theta", "angle"), ("omega", "angular velocity"), ("alpha", "angular acceleration")
    )  # fmt: skip
    solved: tuple[Callable[[DriverRange, Motion], Array], ...] = (
        lambda reach, motion: reach.angle(motion, link),
        lambda reach, motion: motion.omega(link),
        lambda reach, motion: motion.alpha(link),
    )
    found = []
    for (kind, measure), values in zip(kinds, solved, strict=True):
        symbol = Symbol(kind, link=link)
        found.append(Ordinate(f"{kind}_{link}", measure, (symbol,), drawn(symbol), values))
    return tuple(found)


def _of_slide(scene: Mechanism, key: str) -> tuple[Ordinate, ...]:
    """Travel; and, of a link that slides on the frame, its rates, which are those of its pin along the guide."""
    pair = next(p for p in scene.slidings if p.key == key)
    travel = Symbol("s", link=pair.link, other=pair.on)
    first = Ordinate(
        f"s_{key}", "length", (travel,), lambda sheet: _read(sheet, travel), lambda _, motion: motion.slide(key).travel
    )
    if pair.on != scene.frame.name or pair.pin is None:
        return (first,)
    along = scene.frame.guides[pair.guide].direction
    v, a = Symbol("v", PointRef(pair.pin)), Symbol("a", PointRef(pair.pin))
    return (
        first,
        Ordinate(f"v_{key}", "velocity", (v,), lambda sheet: _along(sheet, v, along),
                 lambda _, motion: motion.slide(key).velocity),
        Ordinate(f"a_{key}", "acceleration", (a,), lambda sheet: _along(sheet, a, along),
                 lambda _, motion: motion.slide(key).acceleration),
    )  # fmt: skip


def _of_point(point: str, axis: str) -> tuple[Ordinate, ...]:
    along = 1.0 + 0j if axis == "x" else 1j
    place, v, a = Symbol(axis, PointRef(point)), Symbol("v", PointRef(point)), Symbol("a", PointRef(point))

    def part(values: NDArray[np.complex128]) -> Array:
        return np.asarray(values.real if axis == "x" else values.imag)

    return (
        Ordinate(f"{axis}_{point}", "length", (place,), lambda sheet: _read(sheet, place),
                 lambda _, motion: part(motion.position(point))),
        Ordinate(f"v_{point}.{axis}", "velocity", (v,), lambda sheet: _along(sheet, v, along),
                 lambda _, motion: part(motion.value(v))),
        Ordinate(f"a_{point}.{axis}", "acceleration", (a,), lambda sheet: _along(sheet, a, along),
                 lambda _, motion: part(motion.value(a))),
    )  # fmt: skip


def _read(sheet: Sheet, symbol: Symbol) -> float | None:
    return next((float(r.value.real) for r in read_off(sheet, (symbol,))), None)


def _along(sheet: Sheet, symbol: Symbol, along: complex) -> float | None:
    value = next((complex(r.value) for r in read_off(sheet, (symbol,))), None)
    return None if value is None else (value * along.conjugate()).real


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
    if given.measure == "angle":
        values = np.unwrap(values)
    unit = scene.units.of(given.measure)
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
        values = {d.key: float(v) for d, v in zip(scene.drivers, reach.start, strict=True)}
        values[scene.drivers[0].key] = float(reach.value(np.array(offset)))
        try:
            value = given.drawn(draft(reach.structure, values, given.asked))
        except GraphkinError as error:
            raise Unsolvable("not drawn", *error.problems) from None
        if value is None:
            raise Unsolvable("not drawn", Problem(given.name, Phrase("cannot be measured on the drawing of this")))
        found.append(value)
    return np.array(found)
