"""The motion of drivers that move by laws: every output over time, its extremes, and their diagrams."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphkin.construction.board.scales import next_of_series
from graphkin.drawing.chart import ChartPage
from graphkin.files import Json
from graphkin.scene.drivers import time_span
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.search import changes, extrapolated
from graphkin.solver import Motion, over_time
from graphkin.structure import Structure
from graphkin.study.charts import Axis, Panel, chart_page, figure_name, number, panel_of
from graphkin.study.extremes import GROWS, Extreme
from graphkin.study.quantities import course_of, link_quantities, slide_quantities
from graphkin.study.turn import output_links, output_slides
from graphkin.study.turn_data import known
from graphkin.words import Phrase, listed, rich_text, say, word
from graphkin.words.symbols import RichText

Array = NDArray[np.float64]
POINTS = 361
BEFORE = 1e-9
"""Of the whole time: so long before a seam the piece before it is looked at."""
BESIDE = np.array([-1e-6, 1e-6, -1e-8, 1e-8])
"""Of the whole time: so long beside where the motion ends or begins within it a rate is seen to grow without bound."""


@dataclass(frozen=True)
class TimeAxis(Axis):
    """The time (s) over which drivers move by their laws."""

    structure: Structure

    @property
    def scene(self) -> Mechanism:
        return self.structure.scene

    @cached_property
    def times(self) -> Array:
        """Moments that show the motion: even ones, seams of laws and just before them, and where it ends or begins."""
        return np.unique(np.concatenate([self._sampled[0], self.stops]))

    @cached_property
    def _sampled(self) -> tuple[Array, Motion]:
        """The moments known beforehand, and the motion there."""
        even = np.linspace(*self.ends, POINTS)
        at = np.unique(np.concatenate([even, self._seams, self._seams - self._before]))
        return at, over_time(self.structure, at, extended=False)

    @cached_property
    def stops(self) -> list[float]:
        """The moments within the time at which the motion ends or begins."""
        at, motion = self._sampled
        return changes(lambda t: (motion if t is at else over_time(self.structure, t, extended=False)).ok, at)

    @cached_property
    def _seams(self) -> Array:
        """The moments (s) inside the time at which one piece of a law follows another."""
        low, high = self.ends
        parts = [part for driver in self.scene.drivers if driver.law is not None for part in driver.law.parts]
        return np.array([t for part in parts for t in (part.start, part.end) if low < t < high])

    @property
    def _before(self) -> float:
        """How long before a seam the piece before it is looked at (s)."""
        low, high = self.ends
        return BEFORE * (high - low)

    @cached_property
    def motion(self) -> Motion:
        return over_time(self.structure, self.times, extended=False) if self.stops else self._sampled[1]

    @property
    def ends(self) -> tuple[float, float]:
        return time_span(self.scene)

    @property
    def step(self) -> float:
        low, high = self.ends
        return next_of_series((high - low) / 12)

    def title(self, language: str) -> RichText:
        return rich_text(Phrase("time axis"), language)

    def at(self, places: Array) -> Array:
        return places

    def course(self, quantity: Symbol) -> Array:
        """A quantity over ``times`` (SI), NaN where it is missing."""
        return np.asarray(course_of(quantity, None, self.motion), dtype=float)

    def extremes(self, quantity: Symbol, places: Array, values: Array) -> tuple[Extreme, Extreme]:
        """As of every axis; just before a seam of laws at the seam itself, with the value to which the piece comes;
        infinite where a rate grows without bound, towards where the motion ends or begins within the time."""
        extremes = {e.kind: self._at_seam(quantity, e) for e in super().extremes(quantity, places, values)}
        for stop in () if quantity.is_position else self.stops:
            far, near = self.values(quantity, stop + BESIDE * (self.ends[1] - self.ends[0])).reshape(2, 2)
            for value in near[np.abs(near) > GROWS * np.abs(far)].tolist():
                kind: Literal["max", "min"] = "max" if value > 0 else "min"
                extremes[kind] = Extreme(kind, stop, stop, math.copysign(math.inf, value))
        return extremes["max"], extremes["min"]

    def _at_seam(self, quantity: Symbol, extreme: Extreme) -> Extreme:
        steps = np.arange(1.0, 4.0)
        for seam in self._seams:
            if -2 * self._before < extreme.offset - seam < 0.0:
                before = self.values(quantity, seam - self._before * steps)
                value, _ = extrapolated(before.tolist(), steps.tolist())
                return replace(extreme, offset=float(seam), driver=float(seam), value=value)
        return extreme

    def values(self, quantity: Symbol, places: Array) -> Array:
        low, high = self.ends
        within = (places >= low) & (places <= high)  # a law says nothing of what comes before and after it
        values = np.full(np.shape(places), np.nan)
        values[within] = course_of(quantity, None, over_time(self.structure, places[within], extended=False))
        if not quantity.measure.is_angle:
            return values
        # whole turns as on the curve
        near = np.interp(places, self.times, self.course(quantity))
        return np.asarray(values + 2 * np.pi * np.rint((near - values) / (2 * np.pi)))


@dataclass(frozen=True)
class TimeStudy:
    """The motion of outputs over time: ``groups`` of quantities, each shown on a page."""

    axis: TimeAxis
    groups: tuple[tuple[Symbol, ...], ...]

    @cached_property
    def extremes(self) -> dict[Symbol, tuple[Extreme, ...]]:
        """The least and the greatest value of each quantity, none of a constant one; their offset and driver is the
        time (s)."""
        extremes = dict[Symbol, tuple[Extreme, ...]]()
        for quantity in (q for quantities in self.groups for q in quantities):
            values = self.axis.course(quantity)
            good = values[np.isfinite(values)]
            still = not len(good) or np.ptp(good) <= 1e-12 * np.max(np.abs(good))
            extremes[quantity] = () if still else self.axis.extremes(quantity, self.axis.times, values)[::-1]
        return extremes

    def diagrams(self, language: str) -> dict[str, ChartPage]:
        """A page for each group of quantities over the time."""
        axis, facts = self.axis, [self._fact(language)]

        def panel(quantity: Symbol) -> Panel:
            shown, extremes = axis.shown(quantity, axis.times, axis.course(quantity)), self.extremes[quantity]
            curve, away = np.stack([axis.times, shown], axis=1), any(math.isinf(e.value) for e in extremes)
            return panel_of(axis, quantity, curve, extremes, away)

        return {figure_name(quantities): chart_page(axis, [*map(panel, quantities)], facts, language, over="time")
                for quantities in self.groups}

    def _fact(self, language: str) -> str:
        """The drivers, and the span of time."""
        drives = listed([d.key for d in self.axis.scene.drivers if d.law is not None])
        begin, end = map(number, self.axis.ends)
        return say(Phrase("over the time", drivers=drives, begin=begin, end=end), language)

    def lines(self, language: str) -> list[str]:
        """The least and the greatest value of each quantity, with their moments, as lines of text."""
        lines = [self._fact(language)]
        for quantity, extremes in self.extremes.items():
            unit = quantity.unit(self.axis.scene.units)
            ends = []
            for e in extremes:
                key = "least at time" if e.kind == "min" else "greatest at time"
                said = Phrase(key, quantity=unit.said(e.value), time=number(e.offset))
                if math.isinf(e.value):
                    said = Phrase("grows without bound at", place=f"{number(e.offset)} s")
                ends.append(say(said, language))
            if extremes:
                lines.append(f"  {quantity}{word('colon', language)}{word('list comma', language).join(ends)}")
        return lines

    @cached_property
    def data(self) -> dict[str, Json]:
        """The study as plain data: scene units, radians, seconds."""
        scene, outputs = self.axis.scene, dict[str, Json]()
        for quantity, extremes in self.extremes.items():
            ends, unit = {"min": "least", "max": "greatest"}, quantity.unit(scene.units, radians=True)
            outputs[str(quantity)] = {
                ends[e.kind]: {**known(unit.of(e.value) + 0.0, "grows without bound there"), "time": e.offset}
                for e in extremes
            }
        return {"title": scene.question.title, "time": [*self.axis.ends], "outputs": outputs}


def study_time(structure: Structure, asked: Sequence[Symbol] = ()) -> TimeStudy:
    """The study over time of the asked quantities, each on a page; else of the drivers and every output with its
    rates."""
    axis, scene = TimeAxis(structure), structure.scene
    if asked:
        return TimeStudy(axis, tuple((quantity,) for quantity in asked))
    turning = [d.link for d in scene.drivers if d.turns_about(scene.frame.name)]
    sliding = [d.key for d in scene.drivers if not d.turns]
    start = over_time(structure, np.array(axis.ends[:1]))
    turning += output_links(scene)
    sliding += output_slides(start)
    return TimeStudy(axis, (*map(link_quantities, turning), *map(slide_quantities, sliding)))
