"""One component of a motion on paper, and what somebody may take where the drawing has something else: a component left
out, a value of their own for a drawn one.

A drawing with a slip shows what follows from it; nothing else of the construction changes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from graphkin.construction.sizes import Direction, Size
from graphkin.construction.strokes import Role
from graphkin.scene.symbol import Symbol

__all__ = ["NO_SLIP", "Component", "Slip"]


@dataclass(frozen=True)
class Component:
    """One term of a relative motion in an equation: its vector on paper (mm) if known, else only its direction."""

    symbol: Symbol
    role: Role
    along: complex
    span: complex | None
    written: Direction
    size: Size | None = None


def _same_term(part: Component) -> Component:
    return part


def _same_vector(_: Symbol, tail: complex, tip: complex) -> complex:
    return tip


def _same_line(_: Symbol, along: complex) -> complex:
    return along


def _same_rate(_: Symbol, value: float) -> float | None:
    return None


@dataclass(frozen=True)
class Slip:
    """Four places where a value may be another than the drawn one.

    ``term`` gets each term of an equation before it is laid off; ``found`` each vector found (end points by image
    included) by tail and tip, mm on paper, and returns its tip; ``rate`` each angular rate measured (rad/s, rad/s2),
    and returns None where it stays; ``line`` the direction of each line along which a vector of unknown size is drawn.
    """

    term: Callable[[Component], Component] = _same_term
    found: Callable[[Symbol, complex, complex], complex] = _same_vector
    rate: Callable[[Symbol, float], float | None] = _same_rate
    line: Callable[[Symbol, complex], complex] = _same_line


NO_SLIP = Slip()
