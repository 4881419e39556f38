"""The motion where drivers move by laws: every output over the time, its extremes, and their diagrams."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from graphkin.construction.scales import next_of_series
from graphkin.drawing import Box
from graphkin.drawing.chart import ChartPage, add_legend, add_panel, add_words
from graphkin.files import Json
from graphkin.scene.drivers import time_span
from graphkin.scene.model import Mechanism
from graphkin.solver import Motion, over_time, structure_of
from graphkin.structure import Structure
from graphkin.study.diagram_panels import MARGIN, DiagramPanel, draw_panel, quantity_title, signs_of
from graphkin.study.driver_axis import HEIGHT, LEFT, RIGHT, WIDTH, heading, number, title_of
from graphkin.study.extremes import Extreme
from graphkin.study.quantities import Quantity, link_quantities, slide_quantities
from graphkin.study.turn import output_links, output_slides
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    from graphkin.drawing.chart import Figure

__all__ = ["TimeStudy", "study_time"]

Array = NDArray[np.float64]
POINTS = 361
BEFORE = 1e-9
"""Of the whole time: so long before a seam the piece before it is looked at."""
TOP, GAP = 40.0, 10.0


@dataclass(frozen=True)
class TimeStudy:
    """What outputs do over the time: of each the quantities that are watched, in groups of a page each."""

    scene: Mechanism
    pages: tuple[tuple[str, tuple[Quantity, ...]], ...]

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        return tuple(dict.fromkeys(q for _, own in self.pages for q in own))

    @cached_property
    def times(self) -> Array:
        """Moments that show the motion: even ones, seams of laws, and just before them."""
        low, high = time_span(self.scene)
        seams = [p.start for d in self.scene.drivers if d.law is not None for p in d.law.parts]
        inner = np.array([t for t in seams if low < t < high])
        even = np.linspace(low, high, POINTS)
        return np.unique(np.concatenate([even, inner, inner - BEFORE * (high - low)]))

    @cached_property
    def structure(self) -> Structure:
        return structure_of(self.scene)

    @cached_property
    def motion(self) -> Motion:
        return over_time(self.structure, self.times, fine=False)

    def values(self, quantity: Quantity) -> Array:
        """Values over ``times`` (SI), NaN where there is none."""
        return np.asarray(quantity.values(None, self.motion), dtype=float)

    @cached_property
    def extremes(self) -> dict[Quantity, tuple[Extreme, ...]]:
        """Of each quantity the least and the greatest value; their offset and driver is the time (s)."""
        return {q: tuple(self._extremes(q)) for q in self.quantities}

    def _extremes(self, quantity: Quantity) -> Iterator[Extreme]:
        values = self.values(quantity)
        good = np.isfinite(values)
        if not good.any() or np.ptp(values[good]) <= 1e-12 * np.max(np.abs(values[good])):
            return
        for kind, best in (("min", np.nanargmin), ("max", np.nanargmax)):
            k = int(best(values))
            low, high = self.times[max(k - 1, 0)], self.times[min(k + 1, len(self.times) - 1)]
            at, value = float(self.times[k]), float(values[k])
            for _ in range(2):
                near = np.linspace(low, high, 41)
                found = np.asarray(quantity.values(None, over_time(self.structure, near, fine=False)), dtype=float)
                if quantity.measure == "angle":  # whole turns as on the curve
                    found = found + 2 * np.pi * np.rint((value - found) / (2 * np.pi))
                j = int(best(np.where(np.isfinite(found), found, value)))
                at, value = float(near[j]), float(found[j])
                low, high = near[max(j - 1, 0)], near[min(j + 1, 40)]
            yield Extreme("min" if kind == "min" else "max", at, at, value)

    def diagrams(self, language: str) -> dict[str, ChartPage]:
        """A page for each output: its position, rate and second rate over the time."""
        return {name: self._page(quantities, language) for name, quantities in self.pages}

    def _page(self, quantities: Sequence[Quantity], language: str) -> ChartPage:
        panels = [self._panel(q) for q in quantities]
        low, high = time_span(self.scene)
        axis = _TimeAxis(low, high, next_of_series((high - low) / 12))
        subject = quantities[0]
        key = {"theta": "motion of link", "s": "motion of slide"}.get(subject.kind, "diagram of")
        shown = quantity_title(self.scene, subject) if key == "diagram of" else subject.of.split("/")[0]
        title = say(Phrase(key, (shown,)), language)
        drives = [d.key for d in self.scene.drivers if d.law is not None]
        facts = [say(Phrase("over the time", (", ".join(drives), number(low), number(high))), language)]
        tall = (HEIGHT - TOP - 20.0 - 2 * GAP) / 3

        def paint(figure: Figure) -> None:
            add_words(figure, *heading(self.scene, title, facts, language))
            add_legend(figure, complex(LEFT, TOP - 9.5), signs_of(panels, language))
            for k, panel in enumerate(panels):
                top, last = TOP + k * (tall + GAP), k == len(panels) - 1
                box = Box(LEFT, top, WIDTH - RIGHT, top + tall)
                name = panel.quantity.name.replace("/", "-")
                axes = add_panel(figure, box, name, panel.title, word("time axis", language) * last)
                draw_panel(axes, panel, axis, [], language)
                axes.tick_params(labelbottom=last)

        return ChartPage(
            WIDTH, TOP + len(panels) * (tall + GAP) + 10.0, paint, title=f"{title}: {title_of(self.scene, language)}",
            desc=" ".join(facts), lang=language,
            metadata={"scene": self.scene.name, "units": self.scene.units.length, "over": "time"},
        )  # fmt: skip

    def _panel(self, quantity: Quantity) -> DiagramPanel:
        unit = quantity.unit(self.scene)
        values = np.asarray(unit.of(self.values(quantity)))
        good = values[np.isfinite(values)]
        low, high = (float(good.min()), float(good.max())) if len(good) else (0.0, 1.0)
        if not high - low > 1e-12 * max(abs(low), abs(high)):  # a constant
            low, high = low - (abs(low) / 2 or 0.5), high + (abs(high) / 2 or 0.5)
        span = low - MARGIN * (high - low), high + MARGIN * (high - low)
        marked = tuple((e, e.offset, unit.of(e.value)) for e in self.extremes[quantity])
        title = quantity_title(self.scene, quantity)
        return DiagramPanel(quantity, title, np.stack([self.times, values], axis=1), np.zeros((0, 2)), marked, span)

    def lines(self, language: str) -> list[str]:
        """Of each quantity the least and the greatest value, with the moment of it, as lines of text."""
        low, high = time_span(self.scene)
        drives = [d.key for d in self.scene.drivers if d.law is not None]
        lines = [say(Phrase("over the time", (", ".join(drives), number(low), number(high))), language)]
        for quantity, extremes in self.extremes.items():
            unit = quantity.unit(self.scene)
            told = []
            for e in extremes:
                key = "least at time" if e.kind == "min" else "greatest at time"
                value = unit.said(e.value)
                told.append(say(Phrase(key, (value, number(e.offset))), language))
            if extremes:
                lines.append(f"  {quantity.name}{word('colon', language)}{word('list comma', language).join(told)}")
        return lines

    @cached_property
    def data(self) -> dict[str, Json]:
        """The same as plain data: scene units, radians, seconds."""
        low, high = time_span(self.scene)
        found: dict[str, Json] = {}
        for quantity, extremes in self.extremes.items():
            ends, unit = {"min": "least", "max": "greatest"}, quantity.unit(self.scene, radians=True)
            found[quantity.name] = {
                ends[e.kind]: {"value": unit.of(e.value), "time": e.offset} for e in extremes
            }
        return {"title": self.scene.title, "time": [low, high], "outputs": found}


@dataclass(frozen=True)
class _TimeAxis:
    """The time (s) from left to right."""

    left: float
    right: float
    step: float


def study_time(scene: Mechanism, asked: Sequence[Quantity] = ()) -> TimeStudy:
    """What is watched over the time: what is asked, each alone; else the drivers and every output with its rates."""
    if asked:
        named = ((f"diagram-{q.name.replace('/', '-').replace('@', '')}", (q,)) for q in asked)
        return TimeStudy(scene, tuple(named))
    pages: list[tuple[str, tuple[Quantity, ...]]] = []
    turning = [d.link for d in scene.drivers if d.turns_about(scene.frame.name)]
    sliding = [d.key for d in scene.drivers if not d.turns]
    start = over_time(scene, np.array(time_span(scene)[:1]))
    turning += [name for name in output_links(scene) if name not in turning]
    sliding += [key for key in output_slides(start) if key not in sliding]
    pages += [(f"motion-link-{name}", link_quantities(name)) for name in turning]
    pages += [(f"motion-slide-{key.replace('/', '-')}", slide_quantities(key)) for key in sliding]
    return TimeStudy(scene, tuple(pages))
