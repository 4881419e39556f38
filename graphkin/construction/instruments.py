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
from typing import Protocol

from graphkin.scene.sheet import Tools
from graphkin.words.written import computed, on_paper

__all__ = ["EXACT", "EXACT_NAME", "Cad", "ErringInstrument", "Exact", "Instrument", "erring", "nudged", "pencil"]

EXACT_NAME = "exact"  # of the instrument that errs nowhere


class Instrument(Protocol):
    """Hands and eyes at the board; lengths in mm on paper, directions as unit complex numbers."""

    @property
    def name(self) -> str: ...

    @property
    def faultless(self) -> bool:
        """Whether the construction itself is exact."""
        ...

    @property
    def acts(self) -> int:
        """Number of errors made so far."""
        ...

    def length(self, mm: float) -> float:
        """Lay off a length with the ruler."""
        ...

    def compass(self, mm: float) -> float:
        """Take a radius between the points of the compass."""
        ...

    def direction(self, along: complex) -> complex:
        """Set the ruler square to or along a line, with a set square."""
        ...

    def angle(self, along: complex) -> complex:
        """Lay off an angle with the protractor."""
        ...

    def point(self, at: complex) -> complex:
        """Prick a point."""
        ...

    def read(self, mm: float) -> float:
        """Read a length off the ruler."""
        ...

    def read_direction(self, along: complex) -> complex:
        """Read an angle off the protractor."""
        ...

    def noted(self, value: float, carried: int) -> float:
        """A number computed from readings as it is written down, with the figures that they carry."""
        ...


@dataclass(frozen=True)
class Exact:
    """Draws and reads in double precision: nothing is lost but rounding."""

    name: str = EXACT_NAME
    faultless: bool = True
    acts: int = 0

    def length(self, mm: float) -> float:
        return mm

    def compass(self, mm: float) -> float:
        return mm

    def direction(self, along: complex) -> complex:
        return along

    def angle(self, along: complex) -> complex:
        return along

    def point(self, at: complex) -> complex:
        return at

    def read(self, mm: float) -> float:
        return mm

    def read_direction(self, along: complex) -> complex:
        return along

    def noted(self, value: float, carried: int) -> float:
        return value


EXACT = Exact()
CAD_MM = 0.01
CAD_DEG = 0.01


@dataclass(frozen=True)
class Cad(Exact):
    """A drafting program: draws exactly, but shows lengths to 0.01 mm and angles to 0.01 degree."""

    name: str = "cad"

    def read(self, mm: float) -> float:
        return round(mm / CAD_MM) * CAD_MM

    def read_direction(self, along: complex) -> complex:
        return cmath.rect(1.0, math.radians(round(math.degrees(cmath.phase(along)) / CAD_DEG) * CAD_DEG))


@dataclass
class ErringInstrument:
    """Hands that err: each act adds an error, ``errs`` standard deviations of what its tool can do.

    ``errs`` gets the number of the act (from 1); ``acts`` counts them.  On a ``screen`` only reading errs.  Who
    ``notes`` uses a number as it is written down; errors of first order are told by hands that do not, for what
    rounding jumps by is no measure of them.
    """

    tools: Tools
    errs: Callable[[int], float]
    name: str = "pencil"
    screen: bool = False
    notes: bool = False
    acts: int = 0

    @property
    def faultless(self) -> bool:
        return self.screen

    def _error(self, deviation: float) -> float:
        self.acts += 1
        return deviation * self.errs(self.acts)

    def length(self, mm: float) -> float:
        return mm if self.screen else mm + self._error(self.tools.ruler / _UNIFORM)

    def compass(self, mm: float) -> float:
        return mm if self.screen else mm + self._error(self.tools.compass)

    def direction(self, along: complex) -> complex:
        return along if self.screen else _turned(along, self._error(self.tools.set_square))

    def angle(self, along: complex) -> complex:
        return along if self.screen else _turned(along, self._error(self.tools.protractor / _UNIFORM))

    def point(self, at: complex) -> complex:
        if self.screen:
            return at
        across = self.tools.line_width / 2
        return at + complex(self._error(across), self._error(across))

    @property
    def reading_error(self) -> float:
        """Standard deviation of a length read off the ruler (mm)."""
        return self.tools.ruler / _UNIFORM

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
        return _turned(along, self._error(self.tools.protractor / _UNIFORM))


LAST_PLACE = 0.01  # mm; of a length as it is written
_UNIFORM = math.sqrt(12)  # a value read to the nearest mark errs evenly within a mark: its width over sqrt(12)
_SCREEN = Tools(ruler=CAD_MM, protractor=CAD_DEG)
_NEVER: Mapping[int, float] = {}


def pencil(tools: Tools, seed: int) -> ErringInstrument:
    """A pencil in a human hand: every act errs at random, the same way for the same seed."""
    dice = random.Random(seed)
    return ErringInstrument(tools, lambda _: dice.gauss(0.0, 1.0), notes=True)


def nudged(name: str, tools: Tools, errs: Mapping[int, float] = _NEVER) -> ErringInstrument:
    """The hands of an instrument that err in some acts only, by so many standard deviations of each."""
    screen = name == "cad"
    return ErringInstrument(_SCREEN if screen else tools, lambda n: errs.get(n, 0.0), name, screen)


def erring(name: str, tools: Tools, seed: int) -> ErringInstrument:
    """The hands of an instrument that err in every act at random, the same way for the same seed."""
    hand = nudged(name, tools)
    dice = random.Random(f"together {seed}")
    return replace(hand, errs=lambda _: dice.gauss(0.0, 1.0))


def _turned(along: complex, deg: float) -> complex:
    return along * cmath.rect(1.0, math.radians(deg))
