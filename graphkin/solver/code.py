"""Formulas written out as code: for one position in plain floats, for many as arrays in blocks that stay in cache.

Both come from the same lines in the same order; with equal sines and cosines of the driver they give equal numbers to
the last bit.  Names in the code are made from numbers only.  Compiled code: ``graphkin.solver.compiled``.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from decimal import Decimal
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import DTypeLike

from graphkin.solver.expressions import FLOATS, LEAVES, ExpressionGraph, Name, Real, operands
from graphkin.solver.pose import Array

__all__ = ["BLOCK", "Code", "defined"]

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
    "fmin": "fmin({}, {})",
    "fmax": "fmax({}, {})",
    "atan2": "atan2({}, {})",
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
    asked : what to compute
    fixed : inputs that are the same at all positions too, and are given among the params
    open_ : params that change too, as dimensions do from design to design, and are given among the inputs

    ``params`` and ``inputs`` name the numbers that it needs: those that are the same at all positions, and those that
    change, in the order in which they are to be given.
    """

    def __init__(
        self, graph: ExpressionGraph, asked: Sequence[Real], fixed: Container[Name] = (), open_: Container[Name] = ()
    ) -> None:
        self.graph = graph
        self.asked = [real.at for real in asked]
        self.order = graph.needed(asked)
        leaves = [graph.lines[at] for at in self.order]
        given = [line[1] for line in leaves if line[0] in ("param", "input")]
        changing = {line[1] for line in leaves if line[0] == "input" and line[1] not in fixed}
        changing |= {name for name in given if name in open_}
        self.fixed = fixed
        self.params = tuple(name for name in given if name not in changing)
        self.inputs = tuple(name for name in given if name in changing)
        self._param = {name: f"p[{k}]" for k, name in enumerate(self.params)}
        self._input = {name: k for k, name in enumerate(self.inputs)}
        self.varying: set[int] = set()
        for at in self.order:
            line = graph.lines[at]
            if line[1] in self._input if line[0] in LEAVES else any(k in self.varying for k in operands(line)):
                self.varying.add(at)

    # one position

    @cached_property
    def floats(self) -> Callable[[Sequence[float], Sequence[float]], tuple[float, ...]]:
        """Function of params and inputs to what is asked.  Raises ZeroDivisionError, OverflowError in a singular
        position."""
        made: Callable[[Sequence[float], Sequence[float]], tuple[float, ...]] = defined(self._one({}), FLOATS)
        return made

    @cached_property
    def decimals(self) -> Callable[[Sequence[Decimal], Sequence[Decimal]], tuple[Decimal, ...]]:
        """The same in 50 digits."""
        values = dict.fromkeys(self.graph.lines[at][1] for at in self.order if self.graph.lines[at][0] == "const")
        names = {x: f"k{n}" for n, x in enumerate(values)}
        numbers = {name: Decimal(x) for x, name in names.items()}
        made: Callable[[Sequence[Decimal], Sequence[Decimal]], tuple[Decimal, ...]]
        made = defined(self._one(names), {"sqrt": Decimal.sqrt, "fmin": min, "fmax": max, **numbers})
        return made

    def _one(self, constants: Mapping[float, str]) -> str:
        inputs = {name: f"i[{k}]" for name, k in self._input.items()}
        body, names = self._straight(self.order, inputs, constants)
        return "\n    ".join(["def made(p, i):", *body, _tuple(names[at] for at in self.asked)])

    def _straight(
        self,
        order: Sequence[int],
        inputs: Mapping[Name, str],
        constants: Mapping[float, str],
        kept: Container[int] = (),
        before: Mapping[int, str] | None = None,
    ) -> tuple[list[str], dict[int, str]]:
        """Assignments, one for each line that is used more than once or is to be kept, and what to write for each line;
        ``before`` are lines that are written already."""
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
                names[at] = constants.get(line[1], repr(line[1]))
                continue
            if line[0] in LEAVES:
                text, deep = inputs.get(line[1]) or self._param[line[1]], 0
            else:
                form = "sqrt({})" if line[0] == "root" and _plain(self.graph, line[1]) else _WRITTEN[line[0]]
                text = form.format(*(names[k] for k in line[1:]))
                deep = 1 + max(depth.get(k, 0) for k in line[1:])
            if uses.get(at, 0) > 1 or deep > 12 or at in kept:
                body.append(f"x{at} = {text}")
                text, deep = f"x{at}", 0
            names[at], depth[at] = text, deep
        return body, names

    def straight_same(self) -> tuple[list[str], dict[int, str]]:
        """Assignments for what is the same at all positions, and what to write for each of its lines."""
        order = [at for at in self.order if at not in self.varying]
        return self._straight(order, {}, {}, set(self._same[1]))

    def straight_varying(
        self, asked: Sequence[int], inputs: Mapping[Name, str], before: Mapping[int, str]
    ) -> tuple[list[str], dict[int, str]]:
        """The same for what changes, as far as some of the asked lines need it, after ``straight_same``."""
        order = [at for at in self.graph.needed([Real(self.graph, at) for at in asked]) if at in self.varying]
        return self._straight(order, inputs, {}, set(), before)

    # many positions

    @cached_property
    def _same(self) -> tuple[Callable[..., tuple[float, ...]], dict[int, int]]:
        """What is the same at all positions, in plain floats, as far as the rest needs it."""
        wanted: dict[int, int] = {}
        for at in self.order:
            if at in self.varying:
                for k in operands(self.graph.lines[at]):
                    if k not in self.varying:
                        wanted.setdefault(k, len(wanted))
        for at in self.asked:
            if at not in self.varying:
                wanted.setdefault(at, len(wanted))
        order = [at for at in self.order if at not in self.varying]
        body, names = self._straight(order, {}, {})
        text = "\n    ".join(["def made(p):", *body, _tuple(names.get(at, f"x{at}") for at in wanted)])
        return defined(text, FLOATS), wanted

    @cached_property
    def _blocks(self) -> tuple[Callable[..., None], int]:
        """Function that computes one block, and how many columns it needs to work in."""
        graph = self.graph
        wanted = self._same[1]
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
                body += [f"absolute({sources[0]}, {out})"] if not _plain(graph, line[1]) else []
                body.append(f"sqrt({out if body and not _plain(graph, line[1]) else sources[0]}, {out})")
            elif line[0] in ("fmin", "fmax"):
                body.append(f"{_UFUNCS[line[0]].__name__}({sources[0]}, {sources[1]}, out={out})")
            else:
                body.append(f"{_UFUNCS[line[0]].__name__}({', '.join([*sources, out])})")
        head = [
            "def made(u, i, o, r):",
            *_unpacked("u", len(wanted), "u"),
            *_unpacked("i", len(self._input), "i"),
            *_unpacked("o", len(self.asked), "o"),
            *_unpacked("r", count, "r"),
        ]
        text = "\n    ".join([*head, *body, *copies, "return None"])
        return defined(text, {f.__name__: f for f in _UFUNCS.values()}), count

    def same(self, params: Sequence[float], dtype: DTypeLike = np.float64) -> list[Array] | None:
        """What is the same at all positions; None where it cannot be computed."""
        try:
            return [np.array(x, dtype=dtype) for x in self._same[0](params)]
        except (ZeroDivisionError, OverflowError):
            return None

    def arrays(
        self, same: list[Array] | None, inputs: Sequence[Array], out: Sequence[Array], block: int = BLOCK
    ) -> None:
        """Compute columns.

        Parameters
        ----------
        same : as ``Code.same`` gives it
        inputs : real arrays of shape (n,)
        out : real arrays of shape (n,), filled; where a position is singular with inf or nan
        """
        if same is None:
            for column in out:
                column[...] = np.nan
            return
        n = len(out[0]) if len(out) else 0
        made, count = self._blocks
        with np.errstate(all="ignore"):
            work = np.empty((count, min(n, block)), dtype=out[0].dtype if n else float)
            if n <= block:
                made(same, inputs, out, work)
                return
            rows = list(work)
            for low in range(0, n, block):
                high = low + block
                if high > n:
                    rows = list(work[:, : n - low])
                made(same, [x[low:high] for x in inputs], [x[low:high] for x in out], rows)


def _plain(graph: ExpressionGraph, at: int) -> bool:
    """Whether a line can never be negative, so that its root needs no care."""
    return Real(graph, at).never_negative


def _unpacked(letter: str, count: int, source: str) -> list[str]:
    return [f"{', '.join(f'{letter}{k}' for k in range(count))}, = {source}"] if count else []


def _tuple(texts: Iterable[str]) -> str:
    return f"return ({''.join(f'{t}, ' for t in texts)})"


def defined(text: str, called: Mapping[str, object]) -> Any:
    """The function ``made`` that a text defines; ``called`` is what it calls."""
    space: dict[str, Any] = dict(called)
    exec(compile(text, "<formulas>", "exec"), space)
    return space["made"]
