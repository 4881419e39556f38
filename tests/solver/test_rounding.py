"""The bounds that run along with formulas hold for every change of the numbers that they allow."""

from __future__ import annotations

from decimal import Decimal, localcontext

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphkin.solver.code import Code
from graphkin.solver.decimals import cos_sin, meant
from graphkin.solver.expressions import ExpressionGraph, Real, Rounding, root
from graphkin.solver.pose import UNIT

number = st.floats(0.01, 100.0)
shift = st.floats(-1.0, 1.0)


def both(build, a: float, b: float, off_a: float, off_b: float) -> tuple[float, float, Decimal]:
    """A formula of two numbers in floats, its bound, and the exact value with the numbers moved within their bounds."""
    graph = ExpressionGraph()
    x, y, e, f = (graph.input(name) for name in ("a", "b", "ea", "eb"))
    formula = build(x, y)
    rounding = Rounding(graph, lambda real: e if real.at == x.at else f, graph.const(UNIT))
    code = Code(graph, [formula, rounding.of(formula)])
    given_ = {"a": a, "b": b, "ea": abs(off_a), "eb": abs(off_b)}
    value, bound = code.floats([], [given_[name] for name in code.inputs])
    exact = Code(graph, [formula])
    with localcontext() as context:
        context.prec = 800  # floats may be as small as 1e-324
        moved = {"a": Decimal(a) + Decimal(off_a), "b": Decimal(b) + Decimal(off_b)}
        return value, bound, exact.decimals([], [moved[name] for name in exact.inputs])[0]


FORMULAS = {
    "sum": lambda a, b: a + b,
    "difference": lambda a, b: a - b,
    "product": lambda a, b: a * b,
    "square": lambda a, b: a * a + b,
    "quotient": lambda a, b: a / b,
    "root": lambda a, b: root(a * b),
    "cancelling": lambda a, b: (a + b) * (a + b) - a * a - 2 * (a * b),
}


@pytest.mark.parametrize("name", FORMULAS)
@given(a=number, b=number, p=shift, q=shift)
def test_a_bound_holds(name: str, a: float, b: float, p: float, q: float) -> None:
    value, bound, exact = both(FORMULAS[name], a, b, p * 1e-6 * a, q * 1e-6 * b)
    assert abs(Decimal(value) - exact) <= Decimal(bound) * Decimal("1.000001")


def test_what_may_be_divided_by_zero_has_no_bound() -> None:
    graph = ExpressionGraph()
    x, e = graph.input("x"), graph.input("e")
    rounding = Rounding(graph, lambda real: e, graph.const(UNIT))
    quotient = 1.0 / x
    assert isinstance(quotient, Real)
    code = Code(graph, [rounding.of(quotient)])
    given_ = [{"x": 1.0, "e": 2.0}[name] for name in code.inputs]
    with pytest.raises(ZeroDivisionError):
        code.floats([], given_)


def test_a_short_decimal_is_meant_by_its_float() -> None:
    assert meant(0.15 * 3) == (Decimal("0.45"), True)


def test_a_float_without_a_short_decimal_stands_for_itself() -> None:
    assert meant(2**0.5) == (Decimal(2**0.5), False)


def test_cosine_and_sine_have_fifty_digits() -> None:
    import mpmath as mp

    with mp.workdps(60), localcontext() as context:
        context.prec = 800  # floats may be as small as 1e-324
        c, s = cos_sin(Decimal("2.5"))
        off = [abs(mp.mpf(str(x)) - f(mp.mpf("2.5"))) for x, f in ((c, mp.cos), (s, mp.sin))]
    assert max(off) < mp.mpf("1e-50")
