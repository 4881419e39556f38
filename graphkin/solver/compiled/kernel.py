"""Formulas compiled for the processor, if numba is installed (the extra ``fast``).

Names in the text are made from numbers only.  Positions come in blocks whose columns stay in the first cache, several
at once in the vector registers: the loops are free of branches, and a block's inputs lie apart from its outputs.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from itertools import pairwise
from threading import Thread
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from graphkin.errors import CallError
from graphkin.solver.algebra.expressions import Code, ExpressionGraph, Name, Real, defined, operands

TILE = 512
"""Positions that compiled code computes together."""
FINE = 64
"""Of the cosines of a block so many are computed, and one of each so many; the others are products of these."""
COARSE = TILE // FINE
ROOM = 2 * (TILE + FINE + COARSE)
CHECKS = 128
"""A loop with more checks of its columns against each other is not compiled for several positions at once (LLVM)."""
LONG = 100_000
"""From so many positions on the threads pay."""
MANY = 500_000
"""From so many positions on compiled code is worth the second or two that compiling takes."""
HALF_PI = math.pi / 2


class Kernel:
    """The compiled function that fills the columns of some formulas.

    Parameters
    ----------
    turning : whether the first driver is an angle
    even : whether its values are at even steps, or given as an array

    Raises
    ------
    CallError : numba is not installed
    """

    def __init__(self, code: Code, turning: bool, even: bool) -> None:
        self.run = _compiled(kernel_text(code, turning, even))

    def __call__(self, low: int, high: int, *given: object) -> None:
        """Fill the columns at the positions from one to another, which is not included.

        Parameters
        ----------
        given : params p with the start and the whole way of the driver after them; at even steps the number of steps
            of the whole way and that of the first position, else the values; columns, shape (columns, positions)
        """
        if high - low < LONG:
            self.run(low, high, *given)
            return
        import numba

        bounds = np.linspace(low, high, numba.get_num_threads() + 1).astype(int).tolist()
        others = [Thread(target=self.run, args=(*part, *given)) for part in pairwise(bounds[1:])]
        for other in others:
            other.start()
        self.run(bounds[0], bounds[1], *given)
        for other in others:
            other.join()


def pays(count: int) -> bool:
    """Whether compiling pays for a number of positions, and is possible."""
    return count >= MANY and find_spec("numba") is not None


def kernel_text(code: Code, turning: bool, even: bool) -> str:
    """The text of the function that a ``Kernel`` runs."""
    code = _with_shared_divisions(code)
    names: dict[Name, str] = {("cos", 0): "cosine[k]", ("sin", 0): "sine[k]"}
    names["travel", 0] = "start + step * (ahead + k)" if even else "travel[k]"
    head, before = code.straight_invariants()
    count, columns = len(code.params), len(code.asked)
    lines = [f"def made(low, high, p, {'n, first' if even else 'v'}, o):", *head]
    if even:
        lines += [f"start, step = p[{count}], p[{count + 1}] / n"]
        lines += [] if turning else [f"start += 0.5 * (step - p[{count + 1}])"]
    if turning:
        lines += [f"room = empty({ROOM})", f"cosine, sine = room[:{TILE}], room[{TILE}:{2 * TILE}]"]
        lines += ["fine(step, room)"] if even else []
    lines += [f"for b in range(low, high, {TILE}):", f"    m = min({TILE}, high - b)"]
    if turning:
        lines += ["    products(start, step, first + b, m, room)" if even else "    turns(v[b:b + m], cosine, sine)"]
    elif even:
        lines += ["    ahead = first + b"]
    else:
        lines += ["    travel = v[b:b + m]"]
    lines += [f"    o{k} = o[{k}, b:b + m]" for k in range(columns)]
    each = _together(2 if turning else not even)
    for first in range(0, columns, each):
        some = code.asked[first : first + each]
        body, made = code.straight_varying(some, names, before)
        lines += ["    for k in range(m):", *(f"        {x}" for x in body)]
        lines += [f"        o{k}[k] = {made[at]}" for k, at in enumerate(some, start=first)]
    return "\n    ".join(lines)


def _together(reads: int) -> int:
    """The number of columns filled in one loop that reads ``reads`` columns: each pair of columns of which one is
    written takes a check that they lie apart, and with more than 128 checks the loop would be compiled for one position
    at a time.  Numbers that several loops need are computed in each, which takes less time than memory."""
    return max(w for w in range(1, 17) if w * (w - 1) // 2 + w * reads <= CHECKS or w == 1)


def _with_shared_divisions(code: Code) -> Code:
    """The formulas with 1 / x in place of x / x^2 for a root x (or a signed one): divisions take longest."""
    graph = ExpressionGraph()
    made: dict[int, Real] = {}
    for at in code.order:
        kind, *rest = code.graph.lines[at]
        parts = [made[k] for k in operands(code.graph.lines[at])]
        made[at] = graph.line(kind, *(x.at for x in parts)) if parts else graph.line(kind, *rest)
        if kind == "mul":
            made[at] = _reciprocal(*parts) or _reciprocal(*reversed(parts)) or made[at]
    return Code(graph, [made[at] for at in code.asked], code.fixed)


def _reciprocal(x: Real, over: Real) -> Real | None:
    """1 / x for the product of x = sqrt(q) or x = sign sqrt(q) with 1 / q."""
    graph = x.graph
    parts = [Real(graph, k) for k in operands(x.line)] if x.line[0] == "mul" else [x]
    roots = [part for part in parts if part.line[0] == "root"]
    others = [part for part in parts if part.line[0] != "root"]
    if len(roots) != 1 or any(part.line[0] not in ("input", "param") or part.line[1][0] != "sign" for part in others):
        return None
    if over.line[0] != "div" or Real(graph, over.line[1]).value != 1 or over.line[2] != roots[0].line[1]:
        return None
    return graph.line("div", graph.const(1.0).at, x.at)


Function = TypeVar("Function", bound=Callable[..., object])


@cache
def _compiled(text: str) -> Callable[..., None]:
    """The compiled function that a text defines.  Raises CallError without numba."""
    called = _library()
    made: Callable[..., None] = called["njit"](defined([text], called))
    return made


@cache
def _library() -> dict[str, Any]:
    """The functions that the texts call."""
    try:
        import numba  # type: ignore[import-not-found, import-untyped, unused-ignore]
    except ImportError:
        raise CallError.of("compiled", "needs numba which is not installed", 'pip install "graphkin[fast]"') from None

    def njit(function: Function, inside: bool = False) -> Function:
        options = {"error_model": "numpy", "fastmath": {"contract"}, "nogil": True, "forceinline": inside}
        made: Function = numba.njit(function, **options)
        return made

    turn = njit(_turn, True)

    def turns(values: NDArray[np.float64], cosine: NDArray[np.float64], sine: NDArray[np.float64]) -> None:
        for k in range(len(values)):
            cosine[k], sine[k] = turn(values[k])

    def fine(step: float, room: NDArray[np.float64]) -> None:
        """Cosines and sines of the first steps."""
        cosine, sine = room[2 * TILE : 2 * TILE + FINE], room[2 * TILE + FINE : 2 * TILE + 2 * FINE]
        for k in range(FINE):
            cosine[k], sine[k] = turn(step * k)

    def products(start: float, step: float, first: int, count: int, room: NDArray[np.float64]) -> None:
        """Cosines and sines of start + step k for k from ``first`` on: each the product of a coarse and a fine turn,
        two roundings more; exact at quarter turns."""
        fine_c, fine_s = room[2 * TILE : 2 * TILE + FINE], room[2 * TILE + FINE : 2 * TILE + 2 * FINE]
        coarse_c, coarse_s = room[ROOM - 2 * COARSE : ROOM - COARSE], room[ROOM - COARSE :]
        for j in range(COARSE):
            coarse_c[j], coarse_s[j] = turn(start + step * (first + FINE * j))
        for j in range(COARSE):
            c, s = coarse_c[j], coarse_s[j]
            cosine, sine = room[FINE * j : FINE * (j + 1)], room[TILE + FINE * j : TILE + FINE * (j + 1)]
            for k in range(FINE):
                cosine[k] = c * fine_c[k] - s * fine_s[k]
                sine[k] = s * fine_c[k] + c * fine_s[k]
        begin, end = (start + step * first) / HALF_PI, (start + step * (first + count - 1)) / HALF_PI
        for quarter in range(math.ceil(min(begin, end) - 1e-6), math.floor(max(begin, end) + 1e-6) + 1):
            k = round((quarter - begin) * HALF_PI / step)
            if 0 <= k < count:
                room[k], room[TILE + k] = turn(start + step * (first + k))

    space: dict[str, object] = {"sqrt": math.sqrt, "atan2": math.atan2, "fmin": min, "fmax": max, "empty": np.empty}
    return space | {"njit": njit, "turns": njit(turns), "fine": njit(fine), "products": njit(products)}


def _turn(angle: float) -> tuple[float, float]:
    """Cosine and sine in plain operations, so that several can be computed at once.

    The polynomials are those of fdlibm (Sun Microsystems, 1993: k_sin.c, k_cos.c), right to the last digit but one; a
    quarter turn within the rounding of the angle gives an exact zero.
    """
    q = np.rint(angle * 0.6366197723675814)
    r = ((angle - q * 1.5707963267341256) - q * 6.077100506303966e-11) - q * 2.0222662487959506e-21
    z = r * r
    s = r + r * z * (
        -1.66666666666666324348e-01 + z * (8.33333333332248946124e-03 + z * (
        -1.98412698298579493134e-04 + z * (2.75573137070700676789e-06 + z * (
        -2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))))
    h = 0.5 * z
    w = 1.0 - h
    c = w + (((1.0 - w) - h) + z * z * (
        4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * (
        2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07 + z * (
        2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))))))
    s = s if abs(r) > 4e-16 * abs(angle) else 0.0
    m = q - 4.0 * math.floor(q * 0.25)
    d = abs(m - 2.0) - 1.0
    e = 1.0 - abs(m - 1.0)
    return d * c - e * s, e * c + d * s
