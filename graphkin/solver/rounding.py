"""How far rounding may have moved the result of a formula: a bound beside every operation, itself a formula; and one
for each of the six numbers of a pose.

Running error analysis (Higham, Accuracy and Stability of Numerical Algorithms, sec. 3.3) without leaving out terms of
second order: with x' = x + e and |e| <= E for each operand, each rule below holds for every such e, and every operation
adds one rounding of what it gave.  Where a divisor is not known to differ from zero the bound is infinite.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from graphkin.solver.expressions import ExpressionGraph, Real, fmax, fmin, operands, root

__all__ = ["Rounding"]


class Rounding:
    """The bounds of the formulas of a graph, written into the same graph.

    Parameters
    ----------
    given : bound of a number that is given (param or input), by its line
    unit : how far one rounding may move a number, relatively
    exact : lines whose own error is not looked at
    """

    def __init__(
        self, graph: ExpressionGraph, given: Callable[[Real], Real], unit: Real, exact: Iterable[int] = ()
    ) -> None:
        self.graph = graph
        self.unit = unit
        self._given = given
        self._known: dict[int, Real] = dict.fromkeys(exact, graph.const(0))

    def of(self, asked: Real) -> Real:
        """The bound of a formula."""
        waiting = [asked.at]
        while waiting:
            at = waiting[-1]
            missing = [k for k in operands(self.graph.lines[at]) if k not in self._known]
            if missing:
                waiting += missing
            else:
                waiting.pop()
                if at not in self._known:
                    self._known[at] = self._bound(Real(self.graph, at))
        return self._known[asked.at]

    def _bound(self, x: Real) -> Real:
        kind = x.line[0]
        if kind == "const" or x.at in self.graph.rests:
            return self.graph.const(0)
        if kind in ("param", "input"):
            return self._given(x)
        parts = [Real(self.graph, k) for k in x.line[1:]]
        errors = [self._known[k] for k in x.line[1:]]
        if kind in ("neg", "abs"):
            return errors[0]
        one = errors[0]
        if kind == "root":
            # |sqrt(p + e) - sqrt(p)| <= |e| / sqrt(p) and <= sqrt(|e|)
            moved = one if one.value == 0 else fmin(one / x, root(one))
            return moved + self.unit * abs(x)
        two = errors[1]
        if kind in ("fmin", "fmax"):
            return fmax(one, two)
        a, b = parts
        rounded = self.unit * abs(x)
        if kind == "sum":
            return one + two
        if kind in ("add", "sub"):
            return one + two + rounded
        if kind == "mul":
            if _exact(a) or _exact(b):
                return abs(a) * two + abs(b) * one
            if a.at == b.at:
                return (2.0 * abs(a) + one) * one + rounded
            return (abs(a) + one) * two + abs(b) * one + rounded
        if kind == "div":
            if two.value == 0:
                return one / abs(b) + rounded
            left = fmax(abs(b) - two, self.graph.const(0))
            return (one + abs(x) * two) / left + rounded
        raise ValueError(f"no bound for {kind}")


def _exact(x: Real) -> bool:
    """Whether multiplying by this only changes sign and exponent."""
    return x.value in (0.5, 2.0, -0.5, -2.0) or (x.line[0] == "input" and x.line[1][0] == "sign")
