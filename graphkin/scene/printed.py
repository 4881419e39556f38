"""Values that somebody states, with the digits they are stated to."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation

from graphkin.scene.symbol import Symbol, Value
from graphkin.scene.tables import Units
from graphkin.words import Phrase, say

__all__ = ["Line", "Printed", "Unreadable", "stated"]

MOST_PARDONED = 0.01  # part of a value that rounding to one digit may take away
SMALLEST = -300  # power of ten of a last digit that a double still holds


class Unreadable(ValueError):
    """A text that states no such value; ``phrase`` says why, in any language."""

    def __init__(self, phrase: Phrase) -> None:
        super().__init__(say(phrase))
        self.phrase = phrase


@dataclass(frozen=True)
class Line:
    """A line through two points, or ``square`` to it, along which a vector is said to lie; ``directed``: from the first
    to the second."""

    one: str
    two: str
    square: bool = False
    directed: bool = False


@dataclass(frozen=True)
class Printed:
    """A stated value.

    ``value`` (SI) is a float, or a complex number for a vector given by two components; ``step`` (SI) one unit of its
    last digit; ``digits`` the number of its significant digits; ``texts`` its numbers as written, in scene units unless
    ``shown``, the whole cell, says otherwise.  ``direction`` (rad) is that of a vector given by size and direction,
    which may be meant otherwise by ``room``, and as its opposite where ``either``; ``lines`` are others along which it
    is said to lie.  ``signed`` is whether its number means a place on the line of the motion (a guide), also where it
    is positive; else a positive number is the size of a vector.
    """

    symbol: Symbol
    value: Value
    step: float
    digits: int
    texts: tuple[str, ...]
    shown: str = ""
    direction: float | None = None
    room: float = 0.0
    either: bool = False
    lines: tuple[Line, ...] = ()
    signed: bool = False

    @property
    def shows_sign(self) -> bool:
        """Whether a sign was written before its one number."""
        return len(self.texts) == 1 and self.texts[0].startswith(("+", "-", "\u2212"))

    @property
    def text(self) -> str:
        """What was written."""
        return self.shown or ", ".join(self.texts)

    @property
    def rounding(self) -> float:
        """How far a right value may lie from it (SI): half a unit of the last digit, but of a single digit never more
        than a hundredth.

        One digit says what was meant, it pardons nothing.  A zero is zero to the decimals written.
        """
        if not self.value:
            return (0.5 if any("." in text for text in self.texts) else MOST_PARDONED) * self.step
        most = MOST_PARDONED * abs(self.value) if self.digits < 2 else math.inf
        return min(0.5 * self.step, most) * (1 + 1e-9)

    @property
    def sure_digits(self) -> int:
        """Its significant digits without the zeros that a whole number ends in: 2 650 000 mm/s² may be 2.65 km/s²."""
        zeros = [0 if "." in t or "e" in t.lower() else len(t) - len(t.rstrip("0")) for t in self.texts if t.strip("0")]
        return max(1, self.digits - min(zeros, default=0))

    @property
    def coarse(self) -> float:
        """The same in the person's favour: a whole number that ends in a zero may be rounded to tens (0.52 m/s, written
        520 mm/s), where that is no more than one in a hundred."""
        if any("." in t or not t.endswith("0") for t in self.texts):
            return self.rounding
        return max(self.rounding, min(5.0 * self.step, MOST_PARDONED * abs(self.value)))


def stated(symbol: Symbol, texts: Sequence[str], units: Units, unit: float | None = None) -> Printed:
    """A value from its text, or the texts of its two components, in scene units, or in a ``unit`` (SI).

    Trailing zeros of whole numbers count as written: 480 is stated to the unit.  A component that is zero is zero to
    the accuracy of the other.

    Raises
    ------
    Unreadable : a text that is no number

    >>> v = stated(Symbol.parse("v_D"), ["480.0"], Units())
    >>> v.value, v.step, v.digits
    (0.48, 0.0001, 4)
    """
    unit = symbol.unit(units).si if unit is None else unit
    numbers = [_number(text) for text in texts]
    values = [float(n) * unit for n in numbers]
    last = max(int(n.as_tuple().exponent) for n in [n for n in numbers if n] or numbers)
    digits = max(len(n.as_tuple().digits) for n in numbers)
    value: Value = complex(*values) if len(values) == 2 else values[0]
    return Printed(symbol, value, 10.0**last * unit, digits, tuple(t.strip() for t in texts))


def _number(text: str) -> Decimal:
    plain = text.strip().replace("\u2212", "-")
    try:
        number = Decimal(plain)
    except InvalidOperation:
        raise Unreadable(Phrase("cell no number", (plain[:40],))) from None
    fine = number.is_finite() and int(number.as_tuple().exponent) < SMALLEST
    if not number.is_finite() or fine or not abs(number) < Decimal("1e15") or len(plain) > 40:
        raise Unreadable(Phrase("cell no size", (plain[:40],)))
    return number
