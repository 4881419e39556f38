"""Tasks with a construction of their own: their steps, and the sheet on which no mechanism is drawn yet."""

from __future__ import annotations

import math
from dataclasses import dataclass

from graphkin.construction.board.scales import Scales
from graphkin.construction.board.sheet import Board, Sheet
from graphkin.construction.board.steps import Mark, Step
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.structure import analyse
from graphkin.words.symbols import Words, sign, spaced
from graphkin.words.written import on_paper

DECIMALS = range(2, 9)
"""Of lengths (mm) from which others are reckoned, until that is true as it is written."""
NO_MECHANISM = Mechanism("", PlacedLink("0", {}, (), {}), (), (), ())


@dataclass(frozen=True)
class TaskStep(Step):
    """A step of a task.

    Parameters
    ----------
    point, points : the point that it finds or carries along, and those from which it is found; or the measured bars
    mm, lengths : lengths on paper
    angles : laid off, or between lines (rad)
    K : the ratio of the times of both strokes
    """

    point: str = ""
    points: tuple[str, ...] = ()
    mm: float = 0.0
    lengths: tuple[float, ...] = ()
    angles: tuple[float, ...] = ()
    K: float = 0.0

    @property
    def degrees(self) -> tuple[str, ...]:
        """The angles as they are written (degrees)."""
        return tuple(f"{math.degrees(angle):.6g}" for angle in self.angles)

    def gap(self, name: str) -> object:
        """The value of a gap in its sentence: an argument, or numbers in figures."""
        match name:
            case "K":
                return f"{self.K:.6g}"
            case "lengths":
                read = zip(self.points, self.lengths, strict=True)
                return spaced(",  ", (length_letters(bar) + f" = {on_paper(mm)} mm" for bar, mm in read))
            case "across" | "upward" | "unit" | "crank" | "rocker":
                return self._quotients[name]
        return super().gap(name)

    @property
    def _quotients(self) -> dict[str, str]:
        """Crank and rocker as the frame times the unit over the coordinates of Q (mm), with the decimals that make the
        quotients true as they are written."""
        frame, unit, *sides = self.lengths
        written = [on_paper(abs(frame * unit / side)) for side in sides]
        for decimals in DECIMALS:
            base, per, *ends = (round(mm, decimals) for mm in self.lengths)
            if all(on_paper(abs(base * per / end)) == text for end, text in zip(ends, written, strict=True) if end):
                break
        figures = (*(f"{end:.{decimals}f}" for end in (*ends, per)), *written)
        return dict(zip(("across", "upward", "unit", "crank", "rocker"), figures, strict=True))


def length_letters(name: str) -> Words:
    """A measured length: the letters of a bar, or a word such as "ram"."""
    return sign(name) if name.isupper() else name


def task_sheet(board: Board, length: float) -> Sheet:
    """The sheet of a task.

    Parameters
    ----------
    length : of the task's unit, for one mm of paper
    """
    marks = (stroke for step in board.steps for stroke in step.strokes if isinstance(stroke, Mark))
    return Sheet(
        NO_MECHANISM, analyse(NO_MECHANISM), board.instrument.name, Scales(length, 1.0, 1.0),
        {mark.ref: mark.at for mark in marks if mark.ref.point}, tuple(board.steps), readings=dict(board.readings),
    )  # fmt: skip
