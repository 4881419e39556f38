"""Formulas as data: every operation once, in order, ready to be written out as code, or computed one by one.

A formula is built by computing with ``Real`` and ``Vec`` in place of floats and complex numbers.  What is known to be 0
or 1 is folded away, what is computed twice is computed once, and what leads to nothing asked is never written out.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Mapping
from decimal import Decimal
from typing import Any, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "DECIMALS", "FLOATS", "LEAVES", "OPERATIONS", "ExpressionGraph", "Line", "Real", "Vec", "components",
    "fmax", "fmin", "operands", "root", "two_sum",
]  # fmt: skip

Line = tuple[Any, ...]
"""One operation: ("add", i, j), ("root", i), ("const", 2.0), ("param", name), ("input", name)."""

Name = tuple[str | int, ...]
"""What tells apart the numbers that formulas are given: ("point", link, point, "x"), ("rate", driver), ..."""

LEAVES = ("const", "param", "input")


class ExpressionGraph:
    """The lines of all formulas built on it; equal lines are one line.  Of a sum whose rounding is looked at ("sum" in
    place of "add") nothing is folded away."""

    def __init__(self) -> None:
        self.lines: list[Line] = []
        self._place: dict[Line, int] = {}

    def line(self, *line: str | float | Name) -> Real:
        """The formula of one operation."""
        at = self._place.get(line)
        if at is None:
            at = self._place[line] = len(self.lines)
            self.lines.append(line)
        return Real(self, at)

    def const(self, value: float) -> Real:
        """A number that is the same for all mechanisms."""
        return self.line("const", float(value) + 0.0)

    def param(self, name: Name) -> Real:
        """A number that is the same at all positions."""
        return self.line("param", name)

    def input(self, name: Name) -> Real:
        """A number that changes from position to position."""
        return self.line("input", name)

    def needed(self, asked: Iterable[Real]) -> list[int]:
        """The lines that lead to what is asked, each after those it needs, near to where it is used."""
        done: set[int] = set()
        order: list[int] = []
        for real in asked:
            stack = [(real.at, False)]
            while stack:
                at, ready = stack.pop()
                if ready:
                    order.append(at)
                elif at not in done:
                    done.add(at)
                    stack.append((at, True))
                    stack += [(k, False) for k in reversed(operands(self.lines[at])) if k not in done]
        return order


def _fmin(a: float, b: float) -> float:
    return b if a != a or b < a else a


def _fmax(a: float, b: float) -> float:
    """Unlike ``max`` it hands on nan: what one term does not know, the greatest does not."""
    return a if a != a or a > b else b


FLOATS: Mapping[str, Callable[..., float]] = {
    "sqrt": math.sqrt, "fmin": _fmin, "fmax": _fmax, "atan2": math.atan2,
}  # fmt: skip
"""What formulas of one position call."""
OPERATIONS: Mapping[str, Callable[..., Any]] = {
    **FLOATS,
    "add": operator.add,
    "sum": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": operator.truediv,
    "neg": operator.neg,
    "abs": abs,
    "root": lambda x: math.sqrt(abs(x)),
    "const": float,
}
"""What formulas of one position call that are computed one by one."""
DECIMALS: Mapping[str, Callable[..., Any]] = {
    **OPERATIONS, "root": lambda x: abs(x).sqrt(), "fmin": min, "fmax": max, "const": Decimal,
}  # fmt: skip
"""What formulas in 50 digits call."""


def operands(line: Line) -> tuple[int, ...]:
    """The lines that a line takes its numbers from."""
    return () if line[0] in LEAVES else line[1:]


class Real:
    """A real number given by a formula."""

    __array_ufunc__ = None
    __slots__ = ("at", "graph")

    def __init__(self, graph: ExpressionGraph, at: int) -> None:
        self.graph = graph
        self.at = at

    @property
    def line(self) -> Line:
        return self.graph.lines[self.at]

    @property
    def value(self) -> float | None:
        """The number, where it is the same for all mechanisms."""
        line = self.graph.lines[self.at]
        return line[1] if line[0] == "const" else None

    def _of(self, other: Real | float) -> Real:
        return other if isinstance(other, Real) else self.graph.const(other)

    def __neg__(self) -> Real:
        if self.value is not None:
            return self.graph.const(-self.value)
        if self.line[0] == "neg":
            return Real(self.graph, self.line[1])
        if self.line[0] == "sub":
            return self.graph.line("sub", self.line[2], self.line[1])
        return self.graph.line("neg", self.at)

    @overload
    def __add__(self, other: Real | float) -> Real: ...
    @overload
    def __add__(self, other: Vec | complex) -> Vec: ...
    def __add__(self, other: Real | Vec | complex) -> Real | Vec:
        if isinstance(other, Vec | complex):
            return Vec(self, self.graph.const(0)) + other
        b = self._of(other)
        mine, its = self.value, b.value
        if mine is not None and its is not None:
            return self.graph.const(mine + its)
        if mine == 0 or its == 0:
            return b if mine == 0 else self
        if b.line[0] == "neg":
            return self - Real(self.graph, b.line[1])
        if self.line[0] == "neg":
            return b - Real(self.graph, self.line[1])
        return self.graph.line("add", *sorted((self.at, b.at)))

    __radd__ = __add__

    @overload
    def __sub__(self, other: Real | float) -> Real: ...
    @overload
    def __sub__(self, other: Vec | complex) -> Vec: ...
    def __sub__(self, other: Real | Vec | complex) -> Real | Vec:
        if isinstance(other, Vec | complex):
            return Vec(self, self.graph.const(0)) - other
        b = self._of(other)
        if self.value is not None and b.value is not None:
            return self.graph.const(self.value - b.value)
        if b.value == 0 or self.value == 0:
            return self if b.value == 0 else -b
        if self.at == b.at:
            return self.graph.const(0)
        if b.line[0] == "neg":
            return self + Real(self.graph, b.line[1])
        return self.graph.line("sub", self.at, b.at)

    @overload
    def __rsub__(self, other: float) -> Real: ...
    @overload
    def __rsub__(self, other: complex) -> Vec: ...
    def __rsub__(self, other: complex) -> Real | Vec:
        return -(self - other) if isinstance(other, complex) else self._of(other) - self

    @overload
    def __mul__(self, other: Real | float) -> Real: ...
    @overload
    def __mul__(self, other: Vec | complex) -> Vec: ...
    def __mul__(self, other: Real | Vec | complex) -> Real | Vec:
        if isinstance(other, Vec | complex):
            return Vec(self, self.graph.const(0)) * other
        b = self._of(other)
        mine, its = self.value, b.value
        if mine is not None and its is not None:
            return self.graph.const(mine * its)
        for one, two, value in ((self, b, mine), (b, self, its)):
            if value == 0:
                return one
            if value == 1:
                return two
            if value == -1:
                return -two
            if one.line[0] == "neg":
                return -(Real(self.graph, one.line[1]) * two)
        if self.at == b.at and self.line[0] == "root":
            return abs(Real(self.graph, self.line[1]))
        return self.graph.line("mul", *sorted((self.at, b.at)))

    __rmul__ = __mul__

    def __truediv__(self, other: Real | float) -> Real:
        b = self._of(other)
        if self.value == 0 or b.value == 1:
            return self
        if self.value is not None and b.value:
            return self.graph.const(self.value / b.value)
        return self.graph.line("div", self.at, b.at)

    def __rtruediv__(self, other: float) -> Real:
        return self._of(other) / self

    def __abs__(self) -> Real:
        if self.value is not None:
            return self.graph.const(abs(self.value))
        if self.line[0] == "neg":
            return abs(Real(self.graph, self.line[1]))
        return self if self.never_negative else self.graph.line("abs", self.at)

    @property
    def never_negative(self) -> bool:
        """Whether the number cannot be below zero, by the form of the formula."""
        kind = self.line[0]
        if kind in ("abs", "root"):
            return True
        if kind == "mul":
            return bool(self.line[1] == self.line[2])
        if kind in ("add", "fmax"):
            return all(Real(self.graph, k).never_negative for k in self.line[1:])
        return bool(kind == "const" and self.line[1] >= 0)

    def conjugate(self) -> Real:
        return self

    @property
    def real(self) -> Real:
        return self

    @property
    def imag(self) -> Real:
        return self.graph.const(0)


class Vec:
    """A plane vector given by the formulas of its components: computes as a complex number does."""

    __array_ufunc__ = None
    __slots__ = ("imag", "real")

    def __init__(self, real: Real, imag: Real) -> None:
        self.real = real
        self.imag = imag

    def _of(self, other: Vec | Real | complex) -> Vec:
        if isinstance(other, Vec):
            return other
        graph = self.real.graph
        if isinstance(other, Real):
            return Vec(other, graph.const(0))
        return Vec(graph.const(complex(other).real), graph.const(complex(other).imag))

    def __neg__(self) -> Vec:
        return Vec(-self.real, -self.imag)

    def __add__(self, other: Vec | Real | complex) -> Vec:
        b = self._of(other)
        return Vec(self.real + b.real, self.imag + b.imag)

    __radd__ = __add__

    def __sub__(self, other: Vec | Real | complex) -> Vec:
        b = self._of(other)
        return Vec(self.real - b.real, self.imag - b.imag)

    def __rsub__(self, other: Real | complex) -> Vec:
        return self._of(other) - self

    def __mul__(self, other: Vec | Real | complex) -> Vec:
        b = self._of(other)
        return Vec(self.real * b.real - self.imag * b.imag, self.real * b.imag + self.imag * b.real)

    __rmul__ = __mul__

    def __truediv__(self, other: Real | float) -> Vec:
        """By a real number."""
        return Vec(self.real / other, self.imag / other)

    def __eq__(self, other: object) -> bool:
        """Whether it is that number in every mechanism."""
        if not isinstance(other, int | float | complex):
            return NotImplemented
        return self.real.value == complex(other).real and self.imag.value == complex(other).imag

    __hash__ = None  # type: ignore[assignment]

    def conjugate(self) -> Vec:
        return Vec(self.real, -self.imag)


def components(x: Real | Vec) -> tuple[Real, ...]:
    """A number by itself, a vector by its two components."""
    return (x.real, x.imag) if isinstance(x, Vec) else (x,)


Array = NDArray[Any]
Number = TypeVar("Number", Real, Array)


def root(x: Number) -> Number:
    """Square root of the size of a number: where rounding has put a zero below zero it stays near zero."""
    if not isinstance(x, Real):
        return np.sqrt(np.abs(x))
    if x.value is not None:
        return x.graph.const(abs(x.value) ** 0.5)
    if x.line[0] == "mul" and x.line[1] == x.line[2]:
        return abs(Real(x.graph, x.line[1]))
    return x.graph.line("root", x.at)


def fmin(x: Number, y: Number) -> Number:
    """The smaller of two numbers; the other one where one is not a number."""
    if not isinstance(x, Real):
        smaller: Array = np.fmin(x, y)
        return smaller
    return x.graph.line("fmin", x.at, y.at)


def fmax(x: Number, y: Number) -> Number:
    """The greater of two numbers."""
    if not isinstance(x, Real):
        greater: Array = np.fmax(x, y)
        return greater
    if x.at == y.at or (y.value == 0 and x.never_negative):
        return x
    return x.graph.line("fmax", *sorted((x.at, y.at)))


def two_sum(a: Number, b: Number) -> tuple[Number, Number]:
    """A sum as it is rounded, and what rounding has taken from it (Knuth, The Art of Computer Programming, vol. 2).

    Of formulas the two are meant to be used together: as a pair they have no rounding.
    """
    if not isinstance(a, Real) or (a.value is not None and b.value is not None):
        s = a + b
    else:
        s = a.graph.line("sum", a.at, b.at)
    back = s - a
    return s, (a - (s - back)) + (b - back)
