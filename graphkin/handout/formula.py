"""Numbers of a data table that are given by other columns: "0.3 O4B", "O4B*(1 + cos(asin(O2A/O2O4)))/2"."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Mapping

__all__ = ["names_in", "value_of"]

LONGEST = 200
_OPERATORS: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
_FUNCTIONS: Mapping[str, Callable[[float], float]] = {
    "sqrt": math.sqrt,
    "sin": lambda d: math.sin(math.radians(d)),
    "cos": lambda d: math.cos(math.radians(d)),
    "tan": lambda d: math.tan(math.radians(d)),
    "asin": lambda x: math.degrees(math.asin(x)),
    "acos": lambda x: math.degrees(math.acos(x)),
    "atan": lambda x: math.degrees(math.atan(x)),
}
_PRODUCT = re.compile(r"(?<![A-Za-z0-9_])(\d+(?:\.\d+)?)\s*(?=[A-Za-z(])")


def value_of(text: str, known: Mapping[str, float]) -> float:
    """The number that a cell stands for: plain, or made of names by + - * / and functions; angles in degrees.

    Raises
    ------
    ValueError : it is no number and no such formula, or names something unknown

    >>> value_of("0.3 O4B", {"O4B": 580.0})
    174.0
    """
    plain = text.strip().replace("\u2212", "-")
    try:
        value = float(plain)
    except ValueError:
        value = _evaluated(_tree(plain), known)
    if not math.isfinite(value):
        raise ValueError(f'"{plain[:40]}" is no number')
    return value


def names_in(text: str) -> set[str]:
    """The names that a cell needs; none for a plain number or what is no formula."""
    try:
        float(text.strip().replace("\u2212", "-"))
    except ValueError:
        try:
            tree = _tree(text)
        except ValueError:
            return set()
        return {n.id for n in ast.walk(tree) if isinstance(n, ast.Name)} - set(_FUNCTIONS)
    return set()


def _tree(text: str) -> ast.expr:
    if len(text) > LONGEST:
        raise ValueError(f"a formula of {len(text)} signs is too long")
    try:
        return ast.parse(_PRODUCT.sub(r"\1*", text.strip()), mode="eval").body
    except (SyntaxError, RecursionError, MemoryError, ValueError):
        raise ValueError(f'"{text[:40]}" is no number') from None


def _evaluated(node: ast.expr, known: Mapping[str, float]) -> float:
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            return float(number)
        case ast.Name(id=name) if name in known:
            return known[name]
        case ast.Name(id=name):
            raise ValueError(f'"{name}" is no column with a number')
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return -_evaluated(inner, known)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            try:
                return _OPERATORS[type(op)](_evaluated(left, known), _evaluated(right, known))
            except ZeroDivisionError:
                raise ValueError("divides by zero") from None
        case ast.Call(func=ast.Name(id=name), args=[one], keywords=[]) if name in _FUNCTIONS:
            try:
                return _FUNCTIONS[name](_evaluated(one, known))
            except ValueError:
                raise ValueError(f"{name} has no value there") from None
    raise ValueError("only + - * /, sqrt, sin, cos, tan, asin, acos, atan and names of columns are possible")
