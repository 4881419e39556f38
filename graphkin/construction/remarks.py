"""What is to be remarked on a construction, typed; whether there is anything to say depends on the scale of the figure.

Each remark knows whether it ``holds`` at the scale of its lengths (mm on paper), its sentence (``phrase``), and itself
at another scale (``scaled``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Self

from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase

__all__ = [
    "AtContact", "Magnified", "OffTheSheet", "ParallelLegs", "Remark", "SharpCrossing", "ShortArm", "ZeroVector",
]  # fmt: skip

REACH = 2000.0  # mm to either side: how far a construction line is drawn
SHARP = math.sin(math.radians(15.0))
SHORT = 3.0  # mm on paper; a direction drawn through two points nearer than this errs by a pencil's width in ten


@dataclass(frozen=True)
class SharpCrossing:
    """Two lines cross at so small an angle (its sine) that the place of the crossing is uncertain."""

    of: str | Phrase
    sine: float

    @property
    def holds(self) -> bool:
        return self.sine < SHARP

    @property
    def phrase(self) -> Phrase:
        return Phrase("sharp crossing", (self.of, f"{math.degrees(math.asin(self.sine)):.2g}"))

    def scaled(self, times: float) -> Self:
        return self


@dataclass(frozen=True)
class OffTheSheet:
    """Two lines cross so far from where they start that rulers do not reach: the place is computed."""

    of: str
    mm: float

    @property
    def holds(self) -> bool:
        return self.mm > REACH

    @property
    def phrase(self) -> Phrase:
        return Phrase("off the sheet", (self.of,))

    def scaled(self, times: float) -> Self:
        return replace(self, mm=self.mm * times)


@dataclass(frozen=True)
class ZeroVector:
    """A vector that may be zero."""

    symbol: Symbol
    mm: float

    @property
    def holds(self) -> bool:
        return self.mm == 0.0

    @property
    def phrase(self) -> Phrase:
        return Phrase("zero vector", (self.symbol,))

    def scaled(self, times: float) -> Self:
        return replace(self, mm=self.mm * times)


@dataclass(frozen=True)
class ShortArm:
    """A guide directed by two points that lie too near to each other."""

    links: tuple[str, ...]
    points: tuple[str, str]
    mm: float

    @property
    def holds(self) -> bool:
        return self.mm < SHORT

    @property
    def phrase(self) -> Phrase:
        return Phrase("short arm", (", ".join(self.links), self.points[0], f"{self.mm:.2g}", self.points[1]))

    def scaled(self, times: float) -> Self:
        return replace(self, mm=self.mm * times)


@dataclass(frozen=True)
class Magnified:
    """What a trial polygon leaves open and is read wrong moves end points of the links by so many ``times`` as much."""

    links: tuple[str, ...]
    times: float

    @property
    def holds(self) -> bool:
        return self.times > 2.0

    @property
    def phrase(self) -> Phrase:
        return Phrase("magnified", (", ".join(self.links), f"{self.times:.2g}"))

    def scaled(self, times: float) -> Self:
        return self


@dataclass(frozen=True)
class ParallelLegs:
    """Two legs of a link leave it free along one direction: their special point lies at infinity."""

    joints: tuple[str, str]

    @property
    def holds(self) -> bool:
        return True

    @property
    def phrase(self) -> Phrase:
        return Phrase("parallel legs", self.joints)

    def scaled(self, times: float) -> Self:
        return self


@dataclass(frozen=True)
class AtContact:
    """A sliding contact is drawn at the contact itself, not by what replaces it; or, ``on_curve``, the point of a
    follower as a pin on the pitch curve."""

    contact: str
    on_curve: bool = False

    @property
    def holds(self) -> bool:
        return True

    @property
    def phrase(self) -> Phrase:
        return Phrase("at pitch curve" if self.on_curve else "at contact", (self.contact,))

    def scaled(self, times: float) -> Self:
        return self


Remark = AtContact | Magnified | ParallelLegs | SharpCrossing | OffTheSheet | ZeroVector | ShortArm
