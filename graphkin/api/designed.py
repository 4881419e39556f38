"""``graphkin design``: a mechanism for a task, constructed, measured, checked, and tried over a turn."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from graphkin.api.arguments import MOST_SEED, ON_SHEETS, hand_of, known_words, whole_number
from graphkin.api.results import Result, named
from graphkin.api.solved import solve
from graphkin.checking.closed_form import FoundLength, compare_lengths
from graphkin.construction import Sheet
from graphkin.construction.synthesis import construct
from graphkin.drawing import Drawing
from graphkin.drawing.chart import ChartPage
from graphkin.drawing.figures.constructions import Confirmed, choice_chart, design_figure, design_scale
from graphkin.errors import Unsolvable
from graphkin.files import Json
from graphkin.plane import degrees, direction, unit
from graphkin.scene.designs import (
    BarPositionsTask,
    CrankRockerTask,
    Design,
    DesignLike,
    FunctionTask,
    GuideBarTask,
    LimitsTask,
    SliderCrankTask,
    design_of,
    scene_table,
)
from graphkin.scene.scene import Scene, mechanism_of, toml_text
from graphkin.scene.symbol import Symbol
from graphkin.solver import structure_of
from graphkin.solver.path.driver_range import extremes, range_of
from graphkin.solver.synthesis import FreeDatum, Synthesis, choice, synthesise
from graphkin.table import Table
from graphkin.words import Neutral, Phrase, languages, say

CONFIRMS = 1e-6  # of what was asked: a turn found by searching for its limits


@dataclass(frozen=True, repr=False, eq=False)
class Designed(Result):
    """A mechanism found for a task: its drawing, its lengths, and the scene with them.

    ``designed["AB"]`` is a measured length beside the exact one, in the file's unit.
    """

    given: Design
    found: Synthesis
    sheet: Sheet
    rows: tuple[FoundLength, ...]
    language: str | None = None

    @property
    def name(self) -> str:
        return self.given.name

    @property
    def ok(self) -> bool:
        """Whether every drawn length agrees with the exact one, and a turn confirms the task; a position of the other
        assembly of the links is told, and is no fault."""
        either = isinstance(self.given.task, BarPositionsTask | FunctionTask)
        return all(row.ok for row in self.rows) and (either or all(result.ok for result in self.confirmed))

    def __getitem__(self, name: str) -> FoundLength:
        """A length by its name.  Raises CallError for an unknown one."""
        length = named({row.symbol: row for row in self.rows}, name, where="length")
        return replace(length, unit=self.given.units.length)

    @cached_property
    def scene(self) -> Scene:
        """The mechanism as a scene, its crank turning at 1 rad/s."""
        return Scene.of(scene_table(self.given, self.found.lengths, self.found.places), self.given.name)

    @cached_property
    def confirmed(self) -> tuple[Confirmed, ...]:
        """The asked values beside those of the scene."""
        task, metres = self.given.task, self.given.units.metres

        def row(quantity: Phrase, asked: float, measured: float, size: float) -> Confirmed:
            unit = {"design stroke value": self.given.units.length, "design K value": ""}.get(quantity.key, "deg")
            return Confirmed(quantity, asked, measured, abs(measured - asked) <= CONFIRMS * size, unit)

        if isinstance(task, BarPositionsTask | FunctionTask):
            return tuple(
                row(quantity, asked, asked + (math.nan if bar is None else math.remainder(degrees(bar) - asked, 360.0)),
                    360.0)
                for quantity, asked, bar in self._directions(task)
            )
        name = {GuideBarTask: "stroke_5/0", SliderCrankTask: "stroke_3/0"}.get(type(task), "swing_3")
        output = extremes(range_of(structure_of(mechanism_of(self.scene))), Symbol.parse(name))
        if isinstance(task, LimitsTask):
            # which limit is which: by the turns that bring them together
            ends = math.degrees(output.low), math.degrees(output.high)
            gaps = [min((math.remainder(end - asked, 360.0) for end in ends), key=abs) for asked in task.angles]
            return tuple(
                row(Phrase("design limit value", angle=f"{asked:.6g}°"), asked, asked + gap, 360.0)
                for asked, gap in zip(task.angles, gaps, strict=True)
            )
        if isinstance(task, CrankRockerTask):
            first = row(Phrase("design swing value"), task.swing, math.degrees(output.stroke), 360.0)
        else:
            first = row(Phrase("design stroke value"), task.stroke, output.stroke / metres, task.stroke)
        return first, row(Phrase("design K value"), task.K, output.ways.ratio, task.K)

    def _directions(
        self, task: BarPositionsTask | FunctionTask
    ) -> Iterator[tuple[Phrase, float, complex | None]]:
        """The asked directions of the rocker or of the bar: in words, asked (degrees), and in the motion of the scene
        (None where it does not reach them)."""
        places, turned = self.found.places, self.found.turned
        if isinstance(task, FunctionTask):
            for crank, rocker in task.pairs:
                solved = self._solved(crank + 180.0 * ("AB" in turned), "D", "C")
                back = direction(180.0 * ("CD" in turned))
                yield Phrase("design pair value", crank=f"{crank:.6g}"), rocker, solved and solved * back
            return
        first, second = ("M", "N") if "M" in places else ("B", "C")
        # the turn from MN to the bar BC
        turn = unit((places["C"] - places["B"]) / (places["N"] - places["M"])) if first == "M" else 1.0
        for i, bar in enumerate(task.positions, 1):
            place = bar.B if first == "B" else task.positions[0].moved(places["M"], bar)
            solved = self._solved(degrees(place - places["A"]), first, second)
            yield Phrase("design position value", position=str(i)), degrees(bar.C - bar.B), solved and solved * turn

    def _solved(self, crank: float, first: str, second: str) -> complex | None:
        """The vector from a point to another with the crank at an angle (degrees), by the motion to it; None where that
        does not reach it."""
        import numpy as np

        try:
            motion = solve(self.scene, at=crank).motion
        except Unsolvable:
            return None
        start, end = (complex(np.broadcast_to(motion.point(name).z, 1)[0]) for name in (first, second))
        return end - start if motion.ok[0] else None

    @cached_property
    def choice(self) -> FreeDatum | None:
        """The free datum with its best value for the transmission; None without a free datum."""
        free = choice(self.given.task)
        return free if free is not None and 1.002 * free.low < free.best < 0.998 * free.high else None

    @property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin design --json`` prints."""
        made: dict[str, Json] = {
            "kind": self.given.task.kind,
            "ok": self.ok,
            "units": {"length": self.given.units.length},
            "scales": {"length": self.sheet.scales.length},
            "lengths": dict(self.found.lengths),
            "points": {name: [z.real, z.imag] for name, z in self.found.pivots.items()},
            "readings": [
                {"symbol": row.symbol, "on_paper_mm": row.on_paper, "measured": row.measured, "exact": row.exact,
                 "error": row.error, "tolerance": row.tolerance if math.isfinite(row.tolerance) else None,
                 "direction_error_rad": 0.0, "ok": row.ok}
                for row in self.rows
            ],
            "confirmed": [
                {"what": str(result.what), "asked": result.asked,
                 "found": result.found if math.isfinite(result.found) else None, "ok": result.ok}
                for result in self.confirmed
            ],
        }
        if self.found.turned:
            made["turned"] = list(self.found.turned)
        if self.found.least is not None:
            made["least_transmission_angle_deg"] = self.found.least
        if self.choice is not None:
            free = self.choice
            made["choice"] = {"key": free.key, "from": free.low, "to": free.high, "best": free.best,
                              "least_transmission_angle_deg": free.least}
        return made

    @property
    def table(self) -> Table:
        """The lengths: mm on paper, measured, exact, in the file's unit."""
        rows, unit = [(row.symbol, row.on_paper, row.measured, row.exact) for row in self.rows], self.given.units.length
        return Table.of(("symbol", "on_paper", "measured", "exact"), rows, units=("", "mm", unit, unit))

    def phrases(self) -> list[Phrase]:
        """The sentences on the result."""
        made = [Phrase("turned bar", bar=name) for name in self.found.turned]
        made += [Phrase("other assembly", position=result.what) for result in self.confirmed if not result.ok]
        if self.found.least is not None:
            made.append(Phrase("least angle is", angle=Neutral(f"{self.found.least:.2f}°")))
        free = self.choice
        if free is not None and self.found.least is not None and free.least > self.found.least + 0.005:
            made.append(Phrase("best choice", datum=Phrase(f"datum {free.key}"), low=f"{free.low:.5g}",
                               high=f"{free.high:.5g}", unit=self.given.units.length, angle=f"{free.least:.2f}",
                               best=f"{free.best:.5g}", here=f"{self.found.least:.2f}"))
        return made

    def sentences(self, language: str) -> list[str]:
        return [say(phrase, language) for phrase in self.phrases()]

    @cached_property
    def figures(self) -> dict[str, Drawing | ChartPage]:
        """The construction ("design"), and with a free datum the chart of its choice ("choice")."""
        spoken = self.language or self.given.sheet.language
        made: dict[str, Drawing | ChartPage] = {
            "design": design_figure(self.given, self.sheet, self.rows, self.confirmed, self.phrases(), spoken)
        }
        if self.choice is not None and self.found.least is not None:
            free = self.choice
            now = getattr(self.given.task, free.key)
            made["choice"] = choice_chart(self.given, free.key, free.at, (free.low, free.high), (now, self.found.least),
                                          (free.best, free.least), languages(spoken)[0])
        return made

    @property
    def files(self) -> Mapping[str, bytes]:
        """The scene with the found lengths."""
        return {"scene.toml": toml_text(self.scene.to_dict()).encode()}

    def __repr__(self) -> str:
        lengths = ", ".join(f"{name} {length:.6g}" for name, length in self.found.lengths.items())
        return f"<Designed {self.given.name}: {lengths}>"


def design(
    file: DesignLike,
    *,
    out: str | os.PathLike[str] | None = None,
    formats: Sequence[str] = ("svg",),
    language: str | None = None,
    instrument: str = "exact",
    seed: int = 0,
) -> Designed:
    """Find a mechanism for a task: drawn, measured, checked against the closed form, tried over a turn.

    Parameters
    ----------
    file : a design file, the name of a bundled one, or a mapping of the same shape
    out : folder for design.svg, with a free datum choice.svg, and scene.toml
    language : "en", "zh" or "both" for the figure; the file's own if None
    instrument, seed : as for `check`

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : no mechanism meets the wishes, with the nearest values that one can meet

    Examples
    --------
    >>> found = design({"design": {"kind": "slider-crank", "stroke": 50, "offset": 16, "K": 1.2}})
    >>> f"crank {found['AB'].measured:.4f}, rod {found['BC'].measured:.4f}, {found.ok}"
    'crank 23.8220, rod 58.3700, True'
    """
    known_words(formats, language, None, instrument, known_languages=ON_SHEETS)
    whole_number("seed", seed, 0, MOST_SEED)
    given = design_of(file)
    synthesis = synthesise(given.task)
    natural = construct(given.task, max(synthesis.lengths.values()) / 100.0)
    scale = design_scale(given, natural)
    hand = hand_of(given.sheet, instrument, seed)
    sheet = construct(given.task, scale, hand)
    rows = compare_lengths(given.task, sheet, synthesis.lengths, given.sheet.tools)
    return Designed(given, synthesis, sheet, rows, language).saved(out, formats)
