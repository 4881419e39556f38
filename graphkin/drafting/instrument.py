"""What draws: the exact instrument, and the place where a finite pencil comes in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

__all__ = ["EXACT", "Exact", "Instrument"]


class Instrument(Protocol):
    """Hands that lay off, set square and prick; what they return is what stands on paper."""

    @property
    def name(self) -> str: ...

    def length(self, mm: float) -> float:
        """Lay off a length (mm)."""
        ...

    def direction(self, along: complex) -> complex:
        """Set a ruler along a direction (unit complex number)."""
        ...

    def point(self, at: complex) -> complex:
        """Prick a point found (mm)."""
        ...


@dataclass(frozen=True)
class Exact:
    """Draws in double precision: nothing is lost but rounding."""

    name: str = "exact"

    def length(self, mm: float) -> float:
        return mm

    def direction(self, along: complex) -> complex:
        return along

    def point(self, at: complex) -> complex:
        return at


EXACT = Exact()
