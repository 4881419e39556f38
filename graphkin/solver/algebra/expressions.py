"""Formulas as data: every operation once, in order; and the code that computes them.

A formula is built by computing with ``Real`` and ``Vec`` in place of floats and complex numbers.  Factors 0 and 1 are
folded away, equal operations are computed once, and operations that no asked formula needs are never written.

Code for one position in plain floats, or decimals, and code for many as arrays come from the same lines in the same
order; with equal sines and cosines of the driver floats and arrays are equal to the last bit.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from decimal import Decimal
from functools import cached_property
from typing import Any, TypeVar, overload

import numpy as np
from numpy.typing import DTypeLike, NDArray

Line = tuple[Any, ...]
"""One operation: ("add", i, j), ("root", i), ("const", 2.0), ("param", name), ("input", name)."""

Name = tuple[str | int, ...]
"""What tells apart the numbers that formulas are given: ("point", link, point, "x"), ("rate", driver), ..."""

LEAVES = ("const", "param", "input")


class ExpressionGraph:
    """The lines of all formulas built on it; equal lines are one line.  In a sum whose rounding is needed ("sum" in
    place of "add") no term is folded away."""

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

    def needed(self, asked: Iterable[int], known: Iterable[int] = ()) -> list[int]:
        """The lines from the known to the asked ones, each after its operands, near its use."""
        done = set(known)
        order: list[int] = []
        for line in asked:
            stack = [(line, False)]
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
    """The greater of two numbers, nan if either is nan, unlike ``max``."""
    return a if a != a or a > b else b


FLOATS: Mapping[str, Callable[..., float]] = {
    "sqrt": math.sqrt, "fmin": _fmin, "fmax": _fmax, "atan2": math.atan2,
}
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
}
"""What formulas in 50 digits call."""


def operands(line: Line) -> tuple[int, ...]:
    """The lines from which a line takes its numbers."""
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

    def __add__(self, other: Real | float) -> Real:
        if isinstance(other, Vec):
            return NotImplemented
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

    def __sub__(self, other: Real | float) -> Real:
        if isinstance(other, Vec):
            return NotImplemented
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
    def __mul__(self, other: Real | float) -> Real: ...
    @overload
    def __mul__(self, other: complex) -> Vec: ...
    def __mul__(self, other: Real | complex) -> Real | Vec:
        if isinstance(other, complex):
            return Vec(self, self.graph.const(0)) * other
        if isinstance(other, Vec):
            return NotImplemented
        b = self._of(other)
        mine, its = self.value, b.value
        if mine is not None and its is not None:
            return self.graph.const(mine * its)
        for factor, rest, value in ((self, b, mine), (b, self, its)):
            if value == 0:
                return factor
            if value == 1:
                return rest
            if value == -1:
                return -rest
            if factor.line[0] == "neg":
                return -(Real(self.graph, factor.line[1]) * rest)
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

    @property
    def real(self) -> Real:
        return self


class Vec:
    """A plane vector given by the formulas of its components; it computes like a complex number."""

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
    """Square root of the size of a number, so that a zero that rounding made negative stays near zero."""
    if not isinstance(x, Real):
        return np.sqrt(np.abs(x))
    if x.value is not None:
        return x.graph.const(abs(x.value) ** 0.5)
    if x.line[0] == "mul" and x.line[1] == x.line[2]:
        return abs(Real(x.graph, x.line[1]))
    return x.graph.line("root", x.at)


def size(z: Any) -> Any:
    """The size of a plane vector, or of each of an array of them."""
    return root(z.real * z.real + z.imag * z.imag) if isinstance(z, Vec) else np.abs(z)


def angle_of(direction: Any) -> Any:
    """The angle of a direction, in (-pi, pi] (rad)."""
    if isinstance(direction, Vec):
        return direction.real.graph.line("atan2", direction.imag.at, direction.real.at)
    angle = np.angle(direction)
    return np.where(angle == -np.pi, np.pi, angle)


def fmin(x: Number, y: Number) -> Number:
    """The smaller of two numbers; if one is nan, the other."""
    if not isinstance(x, Real):
        return np.fmin(x, y)
    return x.graph.line("fmin", x.at, y.at)


def fmax(x: Number, y: Number) -> Number:
    """The greater of two numbers."""
    if not isinstance(x, Real):
        return np.fmax(x, y)
    return x.graph.line("fmax", *sorted((x.at, y.at)))


def two_sum(a: Number, b: Number) -> tuple[Number, Number]:
    """A rounded sum, and its rounding error (Knuth, The Art of Computer Programming, vol. 2).

    Of formulas the two belong together: their exact sum has no rounding.
    """
    if not isinstance(a, Real) or (a.value is not None and b.value is not None):
        s = a + b
    else:
        s = a.graph.line("sum", a.at, b.at)
    back = s - a
    return s, (a - (s - back)) + (b - back)


# the code that computes formulas: for one position in plain floats, for many as arrays in blocks that stay in cache

BLOCK = 8192
"""Positions that are computed together: some dozens of columns of this length stay in the cache."""

_WRITTEN = {
    "add": "({} + {})",
    "sum": "({} + {})",
    "sub": "({} - {})",
    "mul": "({} * {})",
    "div": "({} / {})",
    "neg": "(-{})",
    "abs": "abs({})",
    "root": "sqrt(abs({}))",
    **{name: name + "({}, {})" for name in ("fmin", "fmax", "atan2")},
}
_UFUNCS = {
    "add": np.add,
    "sum": np.add,
    "sub": np.subtract,
    "mul": np.multiply,
    "div": np.divide,
    "neg": np.negative,
    "abs": np.absolute,
    "fmin": np.fmin,
    "fmax": np.maximum,  # unlike np.fmax it hands on nan: what one term does not know, the greatest does not
    "sqrt": np.sqrt,
    "atan2": np.arctan2,
}


class Code:
    """The code that computes some formulas.

    Parameters
    ----------
    asked : the formulas to compute
    fixed : inputs that are also the same at all positions, and are given among the params
    varied : params that change, as dimensions from design to design, and are given among the inputs
    """

    def __init__(
        self, graph: ExpressionGraph, asked: Sequence[Real], fixed: Container[Name] = (), varied: Container[Name] = ()
    ) -> None:
        self.graph = graph
        self.asked = [real.at for real in asked]
        self.fixed, self._varied = fixed, varied

    @cached_property
    def order(self) -> list[int]:
        """All lines that it computes, each after its operands."""
        return self.graph.needed(self.asked)

    @cached_property
    def leaves(self) -> list[Name]:
        """The names of all numbers that it needs."""
        return [line[1] for line in (self.graph.lines[at] for at in self.order) if line[0] in ("param", "input")]

    @cached_property
    def _changing(self) -> set[Name]:
        inputs = {line[1] for line in (self.graph.lines[at] for at in self.order) if line[0] == "input"}
        return {name for name in self.leaves if name in self._varied or (name in inputs and name not in self.fixed)}

    @cached_property
    def params(self) -> tuple[Any, ...]:
        """Names of the numbers that are the same at all positions, in the order in which they are to be given."""
        return tuple(name for name in self.leaves if name not in self._changing)

    @cached_property
    def inputs(self) -> tuple[Any, ...]:
        """Names of the numbers that change, in the order in which they are to be given."""
        return tuple(name for name in self.leaves if name in self._changing)

    @cached_property
    def _param(self) -> dict[Name, str]:
        return {name: f"p[{k}]" for k, name in enumerate(self.params)}

    @cached_property
    def _input(self) -> dict[Name, int]:
        return {name: k for k, name in enumerate(self.inputs)}

    @cached_property
    def varying(self) -> set[int]:
        """The lines that change from position to position."""
        lines: set[int] = set()
        for at in self.order:
            line = self.graph.lines[at]
            if line[1] in self._input if line[0] in LEAVES else any(k in lines for k in operands(line)):
                lines.add(at)
        return lines

    # one position

    def values(
        self, given: Callable[[Name], Any], known: dict[int, Any],
        operations: Mapping[str, Callable[..., Any]] = OPERATIONS,
    ) -> list[Any]:
        """The asked formulas at one position, without written code: in plain floats, or in the numbers of the
        operations.

        Parameters
        ----------
        given : params and inputs by their names
        known : the numbers of lines by their indices; computed ones are added

        Raises
        ------
        ZeroDivisionError, OverflowError : a singular position; of decimals any ArithmeticError
        """
        lines = self.graph.lines
        for at in self.graph.needed(self.asked, known) if known else self.order:
            kind, *of = lines[at]
            if kind == "const":
                known[at] = operations[kind](of[0])
            elif kind in LEAVES:
                known[at] = given(of[0])
            elif len(of) == 2:
                known[at] = operations[kind](known[of[0]], known[of[1]])
            else:
                known[at] = operations[kind](known[of[0]])
        return [known[at] for at in self.asked]

    @cached_property
    def floats(self) -> Callable[[Sequence[float], Sequence[float]], tuple[float, ...]]:
        """Function of params and inputs to the asked numbers.  Raises ZeroDivisionError, OverflowError in a singular
        position."""
        inputs = {name: f"i[{k}]" for name, k in self._input.items()}
        body, names = self._straight(self.order, inputs)
        return defined(["def made(p, i):", *body, _tuple(names[at] for at in self.asked)], FLOATS)

    def _straight(
        self,
        order: Sequence[int],
        inputs: Mapping[Name, str],
        kept: Container[int] = (),
        before: Mapping[int, str] | None = None,
    ) -> tuple[list[str], dict[int, str]]:
        """Assignments, one for each line that is used more than once or kept, and the text of each line; ``before`` are
        written lines."""
        uses: dict[int, int] = {}
        for at in order:
            for k in operands(self.graph.lines[at]):
                uses[k] = uses.get(k, 0) + 1
        for at in self.asked:
            uses[at] = uses.get(at, 0) + 1
        body: list[str] = []
        names: dict[int, str] = dict(before or {})
        depth: dict[int, int] = {}
        for at in order:
            line = self.graph.lines[at]
            if line[0] == "const":
                names[at] = repr(line[1])
                continue
            if line[0] in LEAVES:
                text, deep = inputs.get(line[1]) or self._param[line[1]], 0
            else:
                never_negative = line[0] == "root" and Real(self.graph, line[1]).never_negative
                form = "sqrt({})" if never_negative else _WRITTEN[line[0]]
                text = form.format(*(names[k] for k in line[1:]))
                deep = 1 + max(depth.get(k, 0) for k in line[1:])
            if uses.get(at, 0) > 1 or deep > 12 or at in kept:
                body.append(f"x{at} = {text}")
                text, deep = f"x{at}", 0
            names[at], depth[at] = text, deep
        return body, names

    def straight_invariants(self) -> tuple[list[str], dict[int, str]]:
        """Assignments for numbers that are the same at all positions, and the text of each of their lines."""
        order = [at for at in self.order if at not in self.varying]
        return self._straight(order, {}, set(self._invariants[1]))

    def straight_varying(
        self, asked: Sequence[int], inputs: Mapping[Name, str], before: Mapping[int, str]
    ) -> tuple[list[str], dict[int, str]]:
        """Assignments for changing numbers that some of the asked lines need, and their texts, after
        ``straight_invariants``."""
        order = [at for at in self.graph.needed(asked) if at in self.varying]
        return self._straight(order, inputs, set(), before)

    # many positions

    @cached_property
    def _invariants(self) -> tuple[Callable[..., tuple[float, ...]], dict[int, int]]:
        """Function to the numbers that are the same at all positions and that the others need, in plain floats."""
        wanted: dict[int, int] = {}
        for at in self.order:
            if at in self.varying:
                for k in operands(self.graph.lines[at]):
                    if k not in self.varying:
                        wanted.setdefault(k, len(wanted))
        for at in self.asked:
            if at not in self.varying:
                wanted.setdefault(at, len(wanted))
        body, names = self._straight([at for at in self.order if at not in self.varying], {})
        return defined(["def made(p):", *body, _tuple(names.get(at, f"x{at}") for at in wanted)], FLOATS), wanted

    @cached_property
    def _blocks(self) -> tuple[Callable[..., None], int]:
        """Function that computes a block, and the number of columns that it needs for work."""
        graph = self.graph
        wanted = self._invariants[1]
        place = {at: f"u{k}" for at, k in wanted.items()}
        last: dict[int, int] = {}
        order = [at for at in self.order if at in self.varying]
        for n, at in enumerate(order):
            for k in operands(graph.lines[at]):
                last[k] = n
        given: dict[int, int] = {}
        copies: list[str] = []
        for k, at in enumerate(self.asked):
            if at not in self.varying:
                copies.append(f"o{k}[...] = {place[at]}")
            elif at in given or graph.lines[at][0] in LEAVES:
                source = f"o{given[at]}" if at in given else f"i{self._input[graph.lines[at][1]]}"
                copies.append(f"o{k}[...] = {source}")
            else:
                given[at] = k
        free: list[str] = []
        count = 0
        body: list[str] = []
        for n, at in enumerate(order):
            line = graph.lines[at]
            if line[0] in LEAVES:
                place[at] = f"i{self._input[line[1]]}"
                continue
            sources = [place[k] for k in line[1:]]
            free += sorted({place[k] for k in line[1:] if last[k] == n and place[k].startswith("r")})
            if at in given:
                place[at] = f"o{given[at]}"
            elif free:
                place[at] = free.pop()
            else:
                place[at] = f"r{count}"
                count += 1
            out = place[at]
            if line[0] == "root":
                if not Real(graph, line[1]).never_negative:
                    body.append(f"absolute({sources[0]}, {out})")
                    sources = [out]
                body.append(f"sqrt({sources[0]}, {out})")
            elif line[0] in ("fmin", "fmax"):
                body.append(f"{_UFUNCS[line[0]].__name__}({sources[0]}, {sources[1]}, out={out})")
            else:
                body.append(f"{_UFUNCS[line[0]].__name__}({', '.join([*sources, out])})")
        head = [
            "def made(u, i, o, r):",
            *_unpacked("u", len(wanted)),
            *_unpacked("i", len(self._input)),
            *_unpacked("o", len(self.asked)),
            *_unpacked("r", count),
        ]
        return defined([*head, *body, *copies, "return None"], {f.__name__: f for f in _UFUNCS.values()}), count

    def invariants(self, params: Sequence[float], dtype: DTypeLike = np.float64) -> list[Array] | None:
        """The numbers that are the same at all positions; None where they cannot be computed."""
        try:
            return [np.array(x, dtype=dtype) for x in self._invariants[0](params)]
        except (ZeroDivisionError, OverflowError):
            return None

    def arrays(
        self, invariants: list[Array] | None, inputs: Sequence[Array], out: Sequence[Array], block: int = BLOCK
    ) -> None:
        """Compute columns.

        Parameters
        ----------
        invariants : as ``Code.invariants`` gives them
        inputs : real arrays of shape (n,)
        out : real arrays of shape (n,) to fill; inf or nan at a singular position
        """
        if invariants is None:
            for column in out:
                column[...] = np.nan
            return
        n = len(out[0]) if len(out) else 0
        made, count = self._blocks
        with np.errstate(all="ignore"):
            work = np.empty((count, min(n, block)), dtype=out[0].dtype if n else float)
            if n <= block:
                made(invariants, inputs, out, work)
                return
            for low in range(0, n, block):
                some = slice(low, low + block)
                made(invariants, [x[some] for x in inputs], [x[some] for x in out], work[:, : n - low])


def _unpacked(letter: str, count: int) -> list[str]:
    return [f"{', '.join(f'{letter}{k}' for k in range(count))}, = {letter}"] if count else []


def _tuple(texts: Iterable[str]) -> str:
    return f"return ({''.join(f'{t}, ' for t in texts)})"


def defined(lines: Sequence[str], called: Mapping[str, object]) -> Callable[..., Any]:
    """The function ``made`` that its head and the lines of its body define; ``called`` are the functions that it
    calls."""
    space: dict[str, Any] = dict(called)
    exec(compile("\n    ".join(lines), "<formulas>", "exec"), space)
    return space["made"]  # type: ignore[no-any-return]
