"""The drawing board, and what draws on it: exact hands, a drafting program, or a pencil with its errors.

Everything laid off, set, pricked or read goes through an instrument, so that what it does wrong is carried into all
that is drawn after it.
"""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from typing import Protocol, TypeVar

from graphkin.construction.remarks import OffTheSheet, Remark, SharpCrossing
from graphkin.construction.sheet import EXACT_NAME, DiagramName, Equation, Step, either_way
from graphkin.construction.steps import Act, Cause
from graphkin.construction.strokes import Aid, Mark, Stroke, Vector
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, cross_lines
from graphkin.scene.sheet_tables import Tools
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase
from graphkin.words.written import computed, on_paper

__all__ = ["EXACT", "Board", "Cad", "Exact", "Hand", "Instrument", "erring", "nudged", "pencil"]


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
class Hand:
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


def pencil(tools: Tools, seed: int) -> Hand:
    """A pencil in a human hand: every act errs at random, the same way for the same seed."""
    dice = random.Random(seed)
    return Hand(tools, lambda _: dice.gauss(0.0, 1.0), notes=True)


def nudged(name: str, tools: Tools, errs: Mapping[int, float] = _NEVER) -> Hand:
    """The hands of an instrument that err in some acts only, by so many standard deviations of each."""
    screen = name == "cad"
    return Hand(_SCREEN if screen else tools, lambda n: errs.get(n, 0.0), name, screen)


def erring(name: str, tools: Tools, seed: int) -> Hand:
    """The hands of an instrument that err in every act at random, the same way for the same seed."""
    hand = nudged(name, tools)
    dice = random.Random(f"together {seed}")
    return replace(hand, errs=lambda _: dice.gauss(0.0, 1.0))


def _turned(along: complex, deg: float) -> complex:
    return along * cmath.rect(1.0, math.radians(deg))


_Thing = TypeVar("_Thing")
PARALLEL = 1e-12  # sine below which two lines have no crossing at all


@dataclass
class Board:
    """Steps in the order in which they are done, and what was read; the one thing in this room that grows.

    ``arms`` are the lengths (mm) read between two points of the mechanism, ``lengths`` those of vectors: what has been
    read once is used at each later use.
    """

    instrument: Instrument
    steps: list[Step] = field(default_factory=list)
    equations: list[Equation] = field(default_factory=list)
    noticed: list[tuple[DiagramName, Remark]] = field(default_factory=list)
    causes: list[tuple[int, Cause]] = field(default_factory=list)  # acts of the hand up to which each step reaches
    arms: dict[frozenset[str], float] = field(default_factory=dict)
    lengths: dict[Symbol, float] = field(default_factory=dict)

    def again(self, hand: Instrument) -> Board:
        """What stands on the board, to go on with by other hands."""
        kept = {name: copy(value) for name, value in vars(self).items() if name != "instrument"}
        return Board(hand, **kept)

    def do(self, diagram: DiagramName, act: Act, *strokes: Stroke, equation: int | None = None) -> None:
        """Record one step."""
        self.steps.append(Step(len(self.steps) + 1, diagram, act, tuple(strokes), equation))
        self.causes.append((self.instrument.acts, act))

    def read_arm(self, between: Sequence[str], mm: float) -> float:
        """The distance of two points on paper (mm), read when it is first needed."""
        return self._read(self.arms, frozenset(between), mm)

    def read_vector(self, symbol: Symbol, mm: float) -> float:
        """The length of a vector on paper (mm), read when it is first needed."""
        return self._read(self.lengths, either_way(symbol), mm)

    def _read(self, kept: dict[_Thing, float], thing: _Thing, mm: float) -> float:
        if isinstance(self.instrument, Exact):
            return self.instrument.read(mm)  # it shows the same each time
        if thing not in kept:
            kept[thing] = self.instrument.read(mm)
        return kept[thing]

    def pricked(self, diagram: DiagramName, mark: Mark) -> bool:
        """Whether an end point stands there already: two lines have met in it, or the last vector ends in it and now
        bears its letter."""
        if any(mark in step.strokes for step in self.steps if step.diagram == diagram):
            return True
        last = self.steps[-1]
        ends = (s.tip for s in last.strokes if last.diagram == diagram and isinstance(s, Vector | Aid))
        if mark.at not in ends:
            return False
        self.steps[-1] = replace(last, strokes=(*last.strokes, mark))
        return True

    def notice(self, diagram: DiagramName, remark: Remark) -> None:
        """Take note of what may have to be said, at this scale or at another."""
        self.noticed.append((diagram, remark))

    def cross(self, diagram: DiagramName, p: complex, d: complex, q: complex, e: complex, what: str) -> complex:
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
                Problem(
                    what, Phrase("the two lines that should find it are"), Phrase("move the driver off this position")
                ),
            )
        self.notice(diagram, SharpCrossing(what, sine))
        at = cross_lines(p, d, q, e)
        assert at is not None
        self.notice(diagram, OffTheSheet(what, max(abs(at - p), abs(at - q))))
        return self.instrument.point(at)
