"""The instruments of the board: exact hands, a drafting program, or a pencil with its errors.

Every act of laying off, setting, pricking or reading goes through an instrument, so that its errors are carried into
all later strokes.
"""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, cross_lines
from graphkin.scene.scene_tables import Tools
from graphkin.words.written import MOST, computed, figures, on_paper

EXACT_NAME = "exact"  # of the instrument that errs nowhere
LAST_PLACE = 0.01  # mm; of a length as it is written
UNIFORM = math.sqrt(12)  # a value read to the nearest mark errs evenly within a mark: its width over sqrt(12)
PARALLEL = 1e-12  # sine below which two lines have no crossing at all
USUAL = Tools()
ON_SCREEN = 0.01  # mm, degrees; what a drafting program shows


@dataclass(eq=False)
class Instrument:
    """Hands and eyes at the board; lengths in mm on paper, directions as unit complex numbers.

    Parameters
    ----------
    faultless : whether the construction itself is exact, drawn in double precision; then only reading may err
    acts : number of errors made so far
    errs : function of the number of an act (from 1) to its error, in standard deviations of its tool; None without
        errors
    tools : their accuracy
    step : the steps to which a screen shows lengths (mm) and angles (degrees); 0 shows all figures
    notes : whether a number is used as it is written down; errors of first order are found by hands that do not round,
        since the jumps of rounding are no measure of them
    """

    name: str = EXACT_NAME
    faultless: bool = True
    acts: int = 0
    errs: Callable[[int], float] | None = None
    tools: Tools = USUAL
    step: float = 0.0
    notes: bool = False

    def _error(self, deviation: float) -> float:
        """The error of one act: the deviation of the tool (mm, deg) times a random number; 0 of exact hands."""
        if self.errs is None:
            return 0.0
        self.acts += 1
        return deviation * self.errs(self.acts)

    def length(self, mm: float) -> float:
        """Lay off a length with the ruler."""
        return mm if self.faultless else mm + self._error(self.reading_error)

    def laid_off(self, start: complex, span: complex) -> complex:
        """Lay off a vector from a place (mm); returns its end."""
        size = abs(span)
        return self.point(start + self.direction(span / size) * self.length(size)) if size > 0.0 else start

    def compass(self, mm: float) -> float:
        """Take a radius between the points of the compass."""
        return mm if self.faultless else mm + self._error(self.tools.compass)

    def direction(self, along: complex) -> complex:
        """Set the ruler square to or along a line, with a set square."""
        return along if self.faultless else _turned(along, self._error(self.tools.set_square))

    def angle(self, along: complex) -> complex:
        """Lay off an angle with the protractor."""
        return along if self.faultless else self.read_direction(along)

    def point(self, at: complex) -> complex:
        """Prick a point."""
        if self.faultless:
            return at
        across = self.tools.line_width / 2
        return at + complex(self._error(across), self._error(across))

    def crossing(
        self, target: object, p: complex, d: complex, q: complex, e: complex, status: str = "dead point",
        wanted: str = "move the driver off this position",
    ) -> complex:
        """Prick the place (mm) where two drawn lines meet, each through a point along a vector.

        Parameters
        ----------
        target : the point or vector found there, as an error names it
        status, wanted : of the error, and its remedy

        Raises
        ------
        Unsolvable : ``status``: the lines are parallel and meet nowhere
        """
        at = cross_lines(p, d, q, e)
        if at is None or abs(cross(d, e)) < PARALLEL * abs(d) * abs(e):
            raise Unsolvable(status, Problem(str(target), "the two lines that should find it are", wanted))
        return self.point(at)

    @property
    def reading_error(self) -> float:
        """Standard deviation of a length read off the ruler (mm)."""
        return self.tools.ruler / UNIFORM

    def read(self, mm: float) -> float:
        """Read a length off the ruler."""
        if self.errs is None:
            return round(mm / self.step) * self.step if self.step else mm
        read = mm + self._error(self.reading_error)
        return float(on_paper(read)) if self._rounds else read

    def read_signed(self, mm: float) -> float:
        """Read a length with a sense off the ruler."""
        return self.read(abs(mm)) * (1.0 if mm >= 0.0 else -1.0)

    def read_direction(self, along: complex) -> complex:
        """Read an angle off the protractor."""
        if self.errs is not None:
            return _turned(along, self._error(self.tools.protractor / UNIFORM))
        shown = round(math.degrees(cmath.phase(along)) / self.step) * self.step if self.step else None
        return along if shown is None else cmath.rect(1.0, math.radians(shown))

    @property
    def _rounds(self) -> bool:
        """Whether written numbers are rounded; a ruler without steps has no last figure."""
        return self.notes and self.tools.ruler >= LAST_PLACE

    def noted(self, value: float, *read: float, carried: int = MOST) -> float:
        """A number computed from readings (mm) as it is written down: with their figures, ``carried`` at most."""
        if not self._rounds:
            return value
        return float(computed(value, min([carried, *(figures(on_paper(mm)) for mm in read)])))


EXACT = Instrument()


def cad() -> Instrument:
    """A drafting program: draws exactly, but shows lengths to 0.01 mm and angles to 0.01 degree."""
    return Instrument("cad", step=ON_SCREEN)


def pencil(tools: Tools, seed: int) -> Instrument:
    """A pencil in a human hand: every act errs at random, the same way for the same seed."""
    dice = random.Random(seed)
    return Instrument("pencil", False, tools=tools, errs=lambda _: dice.gauss(0.0, 1.0), notes=True)


def nudged(name: str, tools: Tools, errs: Mapping[int, float] | None = None) -> Instrument:
    """The hands of an instrument that err in some acts only, by a number of standard deviations of each."""
    screen, few = name == "cad", errs or {}
    tools = Tools(ruler=ON_SCREEN, protractor=ON_SCREEN) if screen else tools
    return Instrument(name, screen, tools=tools, errs=lambda n: few.get(n, 0.0))


def erring(name: str, tools: Tools, seed: int) -> Instrument:
    """The hands of an instrument that err in every act at random, the same way for the same seed."""
    dice = random.Random(f"together {seed}")
    return replace(nudged(name, tools), errs=lambda _: dice.gauss(0.0, 1.0))


def _turned(along: complex, deg: float) -> complex:
    """A direction turned by an angle (deg)."""
    return along * cmath.rect(1.0, math.radians(deg))
