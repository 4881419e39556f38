"""What is known of a vector before it is drawn: the rule of its size, and its direction as it is written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from graphkin.scene.symbol import Symbol

__all__ = ["Direction", "Given", "RateTimes", "Size", "SquareOverRadius"]


@dataclass(frozen=True)
class Direction:
    """A direction as it is written in an equation row: square to or along what is named.

    ``names`` are the letters of a bar (``("B", "C")``) or the name of a guide (``("h",)``); ``relation`` is "square",
    "along", "towards" (from the first to the second) or "turned" (the relative velocity turned by 90 degrees in the
    sense of the guide's rotation).
    """

    relation: Literal["square", "along", "towards", "turned"]
    names: tuple[str, ...]


@dataclass(frozen=True)
class Given:
    """A size that the problem gives."""

    def __str__(self) -> str:
        return "given"


@dataclass(frozen=True)
class RateTimes:
    """An angular rate of ``links`` (one, or two for a relative one) times a bar's length or a vector's size.

    >>> str(RateTimes("omega", ("3",), ("B", "C"), square=True))
    'ω_{3}²·BC'
    """

    rate: Literal["omega", "alpha"]
    links: tuple[str, ...]
    factor: tuple[str, str] | Symbol
    square: bool = False
    twice: bool = False

    def __str__(self) -> str:
        letter = "ω" if self.rate == "omega" else "α"
        factor = str(self.factor) if isinstance(self.factor, Symbol) else "".join(self.factor)
        return f"{'2' * self.twice}{letter}_{{{''.join(self.links)}}}{'²' * self.square}·{factor}"


@dataclass(frozen=True)
class SquareOverRadius:
    """The square of a relative velocity over the radius of curvature (m) of the path.

    >>> str(SquareOverRadius(Symbol.parse("v_B@2/B@1"), 0.05))
    '(v_B@2/B@1)²/ρ'
    """

    velocity: Symbol
    radius: float

    def __str__(self) -> str:
        return f"({self.velocity})²/ρ"


Size = Given | RateTimes | SquareOverRadius
