"""The drawing board: lines across the sheet, their crossings, and the list of steps as it grows."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from shapely import LineString, Point

from graphkin.drafting.instrument import Instrument
from graphkin.drafting.sheet import DiagramName, Equation, Step, Stroke
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, cross_lines
from graphkin.words import Phrase

__all__ = ["REACH", "Board"]

REACH = 2000.0  # mm to either side: how far a construction line is drawn
SHARP = math.sin(math.radians(15.0))
PARALLEL = 1e-12  # sine below which two lines have no crossing at all


@dataclass
class Board:
    """Steps in the order in which they are done; the one thing in this room that grows."""

    instrument: Instrument
    steps: list[Step] = field(default_factory=list)
    equations: list[Equation] = field(default_factory=list)
    notes: list[Phrase] = field(default_factory=list)
    causes: list[tuple[int, Phrase]] = field(default_factory=list)  # acts of the hand up to which each step reaches

    def do(self, diagram: DiagramName, phrase: Phrase, *strokes: Stroke, equation: int | None = None) -> None:
        """Record one step."""
        self.steps.append(Step(len(self.steps) + 1, diagram, phrase, tuple(strokes), equation))
        self.causes.append((self.instrument.acts, phrase))

    def note(self, phrase: Phrase) -> None:
        if phrase not in self.notes:
            self.notes.append(phrase)

    def warn(self, sine: float, what: str) -> None:
        """Say where two lines cross at so small an angle that the place of the crossing is uncertain."""
        if sine < SHARP:
            self.note(Phrase("sharp crossing", (what, f"{math.degrees(math.asin(sine)):.2g}")))

    def cross(self, p: complex, d: complex, q: complex, e: complex, what: str) -> complex:
        """Where the line through p along d meets the line through q along e, drawn as ruler lines.

        Raises
        ------
        Unsolvable
            status "dead point": the lines are parallel and meet nowhere
        """
        d, e = self.instrument.direction(d), self.instrument.direction(e)
        sine = abs(cross(d, e))
        if sine < PARALLEL:
            raise Unsolvable(
                "dead point",
                Problem(what, "the two lines that should find it are parallel", "move the driver off this position"),
            )
        self.warn(sine, what)
        one = LineString([_xy(p - REACH * d), _xy(p + REACH * d)])
        two = LineString([_xy(q - REACH * e), _xy(q + REACH * e)])
        found = one.intersection(two)
        if not isinstance(found, Point):
            # the ruler lines end before they meet: the place is computed, and said
            self.note(Phrase("off the sheet", (what,)))
            far = cross_lines(p, d, q, e)
            assert far is not None
            return self.instrument.point(far)
        return self.instrument.point(complex(found.x, found.y))


def _xy(z: complex) -> tuple[float, float]:
    return z.real, z.imag
