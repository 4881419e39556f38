"""Whether a group of two links closes, decided in fifty digits where sixteen cannot tell; and where it just does.

The discriminant of a dyad is positive where it closes, zero where its two assemblies meet, negative where its links do
not reach each other.  Beside it stands how far the digits that the file leaves open may move it: a number that is
written as a short decimal is taken to be that decimal.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal

import numpy as np

from graphkin.solver.decimals import meant_value, working
from graphkin.solver.engine import extended_precision_of
from graphkin.solver.expressions import Real
from graphkin.solver.joints import Drive
from graphkin.solver.pose import Array
from graphkin.solver.program import Program
from graphkin.solver.rounding import Rounding
from graphkin.structure import Structure

__all__ = ["Discriminant", "closes", "least_closes", "newton", "touch"]

SMALL = Decimal(10) ** -20
BESIDE = Decimal("1e-5")
"""A least value farther away, of the path, is another one."""
LAST_DIGITS = Decimal(10) ** -48
ROUNDING = Decimal(10) ** -36
"""What fifty digits leave open of a discriminant at a place that is found from it."""


class Discriminant:
    """The discriminant of a dyad in fifty digits, behind dyads only.

    Parameters
    ----------
    i : the dyad, by its place among the elements
    forms : the assembly of the groups before it
    drive : positions whose driver values are taken as they are written; the scene's own if None
    """

    def __init__(self, structure: Structure, i: int, forms: Mapping[int, Array], drive: Drive | None = None) -> None:
        known = {**{j: form for j, form in forms.items() if j < i}, i: np.ones(1)}
        self._extended = extended_precision_of(structure, known, ("closing", i), lambda p: _with_doubt(p, i), drive)

    def __call__(self, *values: Decimal) -> Decimal:
        """At values of the drivers.  Raises ArithmeticError where the groups before it have no place."""
        value, _ = self._extended.row(0, dict(enumerate(values)))
        return value

    def with_doubt(self, values: Sequence[Decimal]) -> tuple[Decimal, Decimal]:
        """The same, and how far the file leaves it open: wholly where the groups before it have no place."""
        try:
            value, doubt = self._extended.row(0, dict(enumerate(values)))
        except ArithmeticError:
            return Decimal(0), Decimal("Infinity")
        return value, doubt

    def written(self, k: int) -> tuple[Decimal, Decimal]:
        """The same at a position."""
        value, doubt = self._extended.row(k)
        return value, doubt


def _with_doubt(program: Program, i: int) -> list[Real]:
    found = program.groups[i].discriminant
    return [found, Rounding(program.graph, program.bounds.error_of, program.bounds.unit).of(found)]


def closes(structure: Structure, i: int, forms: Mapping[int, Array], drive: Drive) -> tuple[Array, Array]:
    """Whether a dyad closes at values of the drivers as they are written: 1, -1, or 0 where it stands at its limit as
    far as can be told; and whether it is the file that leaves it open.  Shapes (n,)."""
    discriminant = Discriminant(structure, i, forms, drive)
    found, open_ = np.zeros(len(drive), dtype=int), np.zeros(len(drive), dtype=bool)
    with working():
        for k in range(len(drive)):
            try:
                value, doubt = discriminant.written(k)
            except ArithmeticError:
                continue
            found[k] = _sign(value, doubt)
            open_[k] = found[k] == 0 and doubt > ROUNDING
    return found, open_


def least_closes(
    structure: Structure, i: int, forms: Mapping[int, Array], start: Sequence[float], end: Sequence[float], about: float
) -> tuple[float, int] | None:
    """Where the discriminant of a dyad is least on a straight path of driver values (rad, m), near a parameter of it,
    and what ``closes`` says there; None where there is no such place."""
    discriminant = Discriminant(structure, i, forms)
    with working():
        first = [meant_value(d, x) for d, x in zip(structure.scene.drivers, start, strict=True)]
        way = [meant_value(d, x) - a for d, x, a in zip(structure.scene.drivers, end, first, strict=True)]

        def at(t: Decimal) -> list[Decimal]:
            return [a + t * w for a, w in zip(first, way, strict=True)]

        place = touch(lambda t: discriminant(*at(t)), about)
        if place is None or abs(place - Decimal(about)) > BESIDE:
            return None
        return float(place), _sign(*discriminant.with_doubt(at(place)))


def _sign(value: Decimal, doubt: Decimal) -> int:
    return 0 if abs(value) <= max(doubt, ROUNDING) else 1 if value > 0 else -1


def touch(function: Callable[[Decimal], Decimal], about: float) -> Decimal | None:
    """Where a function is least: its derivative is zero."""
    step = SMALL.sqrt()
    return newton(lambda x: (function(x + step) - function(x - step)) / (2 * step), about)


def newton(function: Callable[[Decimal], Decimal], about: float | Decimal) -> Decimal | None:
    """A zero of a function in fifty digits, its derivative by differences; None where there is none near."""
    with working():
        x = Decimal(about)
        try:
            for _ in range(60):
                slope = (function(x + SMALL) - function(x - SMALL)) / (2 * SMALL)
                move = function(x) / slope
                x = x - move
                if abs(move) < LAST_DIGITS * (1 + abs(x)):
                    return x if abs(x) > 100 * LAST_DIGITS else Decimal(0)
        except ArithmeticError:
            return None
    return None
