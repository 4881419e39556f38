"""Tasks with a construction of their own, a synthesis or a cam: their steps, and the board, without a mechanism."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from graphkin.construction.board.scales import Scales
from graphkin.construction.board.sheet import Board, Sheet
from graphkin.construction.board.steps import Mark, Step, Stroke, TaskReason, Verb
from graphkin.construction.touching import CamStation
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross_line_arc, unit
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.structure import analyse
from graphkin.words import Phrase
from graphkin.words.symbols import Words, sign, spaced
from graphkin.words.written import amount, on_paper, true_minus

DECIMALS = range(2, 9)
"""Of lengths (mm) from which others are reckoned, until that is true as it is written."""
NO_MECHANISM = Mechanism("", PlacedLink("0", {}, (), {}), (), (), ())


@dataclass(frozen=True)
class TaskStep(Step):
    """A step of a task.

    Parameters
    ----------
    angles : laid off, or between lines (rad)
    K : the ratio of the times of both strokes
    divisions : of a cam's displacement diagram, the follower turned back about the cam at each (mm)
    """

    angles: tuple[float, ...] = ()
    K: float = 0.0
    divisions: tuple[CamStation, ...] = ()

    def gap(self, name: str) -> object:
        """The value of a gap in its sentence: an argument, angles in degrees, given radii as they are; or numbers in
        figures."""
        match name.partition("."):
            case "K", _, _:
                return f"{self.K:.6g}"
            case "divisions", _, _:
                return str(len(self.divisions))
            case "angles", _, i:
                return true_minus(f"{math.degrees(self.angles[int(i)]):.6g}")
            case "circles", _, i:
                return amount(self.radii[int(i)], 4)
            case "measured", _, _:
                read = zip(self.points, self.radii, strict=True)
                return spaced(",  ", (length_letters(bar) + f" = {on_paper(mm)} mm" for bar, mm in read))
            case ("across" | "upward" | "unit" | "crank" | "rocker"), _, _:
                return self._quotients[name]
        return super().gap(name)

    @property
    def _quotients(self) -> dict[str, str]:
        """Crank and rocker as the frame times the unit over the coordinates of Q (mm), with the decimals that make the
        quotients true as they are written."""
        frame, unit, *sides = self.radii
        written = [on_paper(abs(frame * unit / side)) for side in sides]
        for decimals in DECIMALS:
            base, per, *ends = (round(mm, decimals) for mm in self.radii)
            if all(on_paper(abs(base * per / end)) == text for end, text in zip(ends, written, strict=True) if end):
                break
        sizes, names = [f"{abs(end):.{decimals}f}" for end in ends], ("across", "upward")
        signed = (f"−{size}" if end < 0.0 else size for size, end in zip(sizes, ends, strict=True))
        return {**dict(zip(names, signed, strict=True)), **{f"{n}.size": z for n, z in zip(names, sizes, strict=True)},
                "unit": f"{per:.{decimals}f}", **dict(zip(("crank", "rocker"), written, strict=True))}


def length_letters(name: str) -> Words:
    """A measured length: the letters of a bar, or a word such as "ram"."""
    return sign(name) if name.isupper() else name


@dataclass
class TaskBoard(Board):
    """The board of a task.

    Parameters
    ----------
    scale : of the task's unit, of a cam m, for one mm of paper
    """

    scale: float = 1.0

    def step(self, verb: Verb, reason: TaskReason, *strokes: Stroke, **arguments: Any) -> None:
        """Record a step with its strokes and arguments."""
        self.do(TaskStep(verb, reason, strokes=strokes, **arguments))

    @property
    def sheet(self) -> Sheet:
        """The board as a sheet."""
        marks = (mark for step in self.steps for mark in step.each(Mark))
        points = {mark.ref: mark.at for mark in marks if mark.ref.point}
        return Sheet(
            NO_MECHANISM, analyse(NO_MECHANISM), self.instrument.name, Scales(self.scale, 1.0, 1.0), points,
            tuple(self.steps),
        )

    def mm(self, length: float) -> float:
        """A length of the task on paper."""
        return length / self.scale

    def lay_off(self, start: complex, along: complex, mm: float) -> complex:
        """Lay off a length in a direction by the set square."""
        return self.instrument.point(start + self.instrument.length(mm) * self.instrument.direction(along))

    def lay_off_angle(self, start: complex, along: complex, mm: float) -> complex:
        """Lay off a length in a direction by the protractor."""
        return self.instrument.point(start + self.instrument.length(mm) * self.instrument.angle(along))

    def plot(self, at: complex) -> complex:
        """A point by its coordinates."""
        x, y = (self.instrument.length(self.mm(side)) for side in (at.real, at.imag))
        return self.instrument.point(complex(x, y))

    def meet(self, key: str, p: complex, d: complex, q: complex, e: complex) -> complex:
        """The crossing of two lines, each through a point along a direction.  Raises Unsolvable where they are
        parallel."""
        return self.instrument.crossing(key, p, d, q, e, "not drawn", "other data")

    def cut(self, key: str, p: complex, d: complex, centre: complex, radius: float) -> tuple[complex, complex]:
        """The points where a line cuts a circle, the point farther along d first.  Raises Unsolvable where it does not
        cut it."""
        crossings = cross_line_arc(p, d, centre, radius)
        if crossings is None:
            raise not_drawn(key, "the line does not reach the circle", "other data")
        return self.instrument.point(crossings[0]), self.instrument.point(crossings[1])

    def bisector(self, a: complex, b: complex) -> tuple[complex, complex]:
        """A point and the direction of the perpendicular bisector, drawn by two pairs of compass arcs."""
        return self.instrument.point((a + b) / 2), self.instrument.direction(1j * unit(b - a))

    def measure(self, *strokes: Stroke, **bars: tuple[complex, complex]) -> None:
        """A step in which the lengths of bars are read off the paper (mm), each by its name."""
        lengths = tuple(self.instrument.read(abs(b - a)) for a, b in bars.values())
        self.step("read", "design measured", *strokes, points=(*bars,), radii=lengths)


def not_drawn(key: str, finding: str, wanted: str) -> Unsolvable:
    """The error of a task that has no drawing: the key of the file, and the phrases of its finding and of a remedy."""
    return Unsolvable("not drawn", Problem(key, Phrase(finding), Phrase(wanted)))


def measured(sheet: Sheet) -> dict[str, float]:
    """The measured lengths of a synthesis (mm on paper) by the letters of each bar; "ram": the distance of its line
    from C."""
    read = (step for step in sheet.steps if isinstance(step, TaskStep) and step.reason == "design measured")
    return {name: mm for step in read for name, mm in zip(step.points, step.radii, strict=True)}
