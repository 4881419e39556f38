"""What draws and reads at the board: exact hands, a drafting program, or a pencil with its errors.

Everything laid off, set, pricked or read goes through an instrument, so that what it does wrong is carried into all
that is drawn after it.
"""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from graphkin.scene.scene_tables import Tools
from graphkin.words.written import computed, on_paper

__all__ = ["EXACT", "EXACT_NAME", "Cad", "ErringInstrument", "Instrument", "erring", "nudged", "pencil"]

EXACT_NAME = "exact"  # of the instrument that errs nowhere


@dataclass(eq=False)
class Instrument:
    """Hands and eyes at the board; lengths in mm on paper, directions as unit complex numbers.  These are exact: they
    draw and read in double precision.

    Parameters
    ----------
    faultless : whether the construction itself is exact
    acts : number of errors made so far
    """

    name: str = EXACT_NAME
    faultless: bool = True
    acts: int = 0

    def length(self, mm: float) -> float:
        """Lay off a length with the ruler."""
        return mm

    def compass(self, mm: float) -> float:
        """Take a radius between the points of the compass."""
        return mm

    def direction(self, along: complex) -> complex:
        """Set the ruler square to or along a line, with a set square."""
        return along

    def angle(self, along: complex) -> complex:
        """Lay off an angle with the protractor."""
        return along

    def point(self, at: complex) -> complex:
        """Prick a point."""
        return at

    def read(self, mm: float) -> float:
        """Read a length off the ruler."""
        return mm

    def read_signed(self, mm: float) -> float:
        """Read a length off the ruler that has a sense."""
        return self.read(abs(mm)) * (1.0 if mm >= 0.0 else -1.0)

    def read_direction(self, along: complex) -> complex:
        """Read an angle off the protractor."""
        return along

    def noted(self, value: float, carried: int) -> float:
        """A number computed from readings as it is written down, with the figures that they carry."""
        return value


EXACT = Instrument()
CAD_MM = 0.01
CAD_DEG = 0.01


@dataclass(eq=False)
class Cad(Instrument):
    """A drafting program: draws exactly, but shows lengths to 0.01 mm and angles to 0.01 degree."""

    name: str = "cad"

    def read(self, mm: float) -> float:
        return round(mm / CAD_MM) * CAD_MM

    def read_direction(self, along: complex) -> complex:
        return cmath.rect(1.0, math.radians(round(math.degrees(cmath.phase(along)) / CAD_DEG) * CAD_DEG))


@dataclass(eq=False, kw_only=True)
class ErringInstrument(Instrument):
    """Hands that err: each act adds an error, ``errs`` standard deviations of what its tool can do.

    ``errs`` gets the number of the act (from 1).  On a screen, which is ``faultless``, only reading errs.  Who
    ``notes`` uses a number as it is written down; errors of first order are told by hands that do not, for what
    rounding jumps by is no measure of them.
    """

    tools: Tools
    errs: Callable[[int], float]
    name: str = "pencil"
    faultless: bool = False
    notes: bool = False

    def _error(self, deviation: float) -> float:
        self.acts += 1
        return deviation * self.errs(self.acts)

    def length(self, mm: float) -> float:
        return mm if self.faultless else mm + self._error(self.reading_error)

    def compass(self, mm: float) -> float:
        return mm if self.faultless else mm + self._error(self.tools.compass)

    def direction(self, along: complex) -> complex:
        return along if self.faultless else _turned(along, self._error(self.tools.set_square))

    def angle(self, along: complex) -> complex:
        return along if self.faultless else self.read_direction(along)

    def point(self, at: complex) -> complex:
        across = self.tools.line_width / 2
        return at if self.faultless else at + complex(self._error(across), self._error(across))

    @property
    def reading_error(self) -> float:
        """Standard deviation of a length read off the ruler (mm)."""
        return self.tools.ruler / UNIFORM

    def read(self, mm: float) -> float:
        read = mm + self._error(self.reading_error)
        return float(on_paper(read)) if self._rounds else read

    @property
    def _rounds(self) -> bool:
        """Whether numbers are rounded where they are written down; a ruler without steps has no last figure."""
        return self.notes and self.tools.ruler >= LAST_PLACE

    def noted(self, value: float, carried: int) -> float:
        return float(computed(value, carried)) if self._rounds else value

    def read_direction(self, along: complex) -> complex:
        return _turned(along, self._error(self.tools.protractor / UNIFORM))


LAST_PLACE = 0.01  # mm; of a length as it is written
UNIFORM = math.sqrt(12)  # a value read to the nearest mark errs evenly within a mark: its width over sqrt(12)


def pencil(tools: Tools, seed: int) -> ErringInstrument:
    """A pencil in a human hand: every act errs at random, the same way for the same seed."""
    dice = random.Random(seed)
    return ErringInstrument(tools=tools, errs=lambda _: dice.gauss(0.0, 1.0), notes=True)


def nudged(name: str, tools: Tools, errs: Mapping[int, float] | None = None) -> ErringInstrument:
    """The hands of an instrument that err in some acts only, by so many standard deviations of each."""
    screen, few = name == "cad", errs or {}
    tools = Tools(ruler=CAD_MM, protractor=CAD_DEG) if screen else tools
    return ErringInstrument(tools=tools, errs=lambda n: few.get(n, 0.0), name=name, faultless=screen)


def erring(name: str, tools: Tools, seed: int) -> ErringInstrument:
    """The hands of an instrument that err in every act at random, the same way for the same seed."""
    dice = random.Random(f"together {seed}")
    return replace(nudged(name, tools), errs=lambda _: dice.gauss(0.0, 1.0))


def _turned(along: complex, deg: float) -> complex:
    return along * cmath.rect(1.0, math.radians(deg))
