"""The drawing board: the steps in which something is drawn, and what was read for them."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from typing import TypeVar

from graphkin.construction.instruments import Exact, Instrument
from graphkin.construction.remarks import OffTheSheet, Remark, SharpCrossing
from graphkin.construction.sheet import Act, Cause, DiagramName, Equation, Step, either_way
from graphkin.construction.strokes import Aid, Mark, Stroke, Vector
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, cross_lines
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase

__all__ = ["Board"]


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
