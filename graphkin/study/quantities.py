"""What can be watched over a turn: angles and travels with their rates, anything that ``find`` names, transmission."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from graphkin.scene.force_names import force_names, opposite
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Measure, Unit
from graphkin.solver import DriverRange, Motion, forces_of, senses_along
from graphkin.solver.pose import Array
from graphkin.structure import links_for

__all__ = ["Quantity", "force_quantity", "link_quantities", "settled", "slide_quantities", "symbol_quantity"]

Kind = Literal["theta", "omega", "alpha", "s", "v", "a", "force", "moment", "symbol"]
_MEASURES: dict[str, Measure] = {
    "theta": "angle",
    "omega": "angular velocity",
    "alpha": "angular acceleration",
    "s": "length",
    "v": "velocity",
    "a": "acceleration",
    "force": "force",
    "moment": "moment",
}


@dataclass(frozen=True)
class Quantity:
    """One number that changes over the turn: ``theta_3`` (angle of a link), ``s_6/1`` (travel of a sliding pair), their
    rates ``omega_3``, ``alpha_3``, ``v_6/1``, ``a_6/1``, a force (by its size) or a moment by its name, or another
    symbol of ``find`` (a vector by its size, or ``along`` the guide that it lies on, with its sign)."""

    kind: Kind
    of: str
    symbol: Symbol | None = None
    along: bool = False

    @property
    def name(self) -> str:
        if self.is_load:
            return self.of
        return str(self.symbol) if self.symbol else f"{self.kind}_{self.of}"

    @property
    def measure(self) -> Measure:
        """What kind of number it is."""
        return _MEASURES[self.kind] if self.symbol is None else self.symbol.measure

    @property
    def is_position(self) -> bool:
        """Whether it is an angle or a travel."""
        return self.kind in ("theta", "s") or (self.symbol is not None and self.symbol.scope == "position")

    @property
    def is_speed(self) -> bool:
        """Whether it is a velocity or an angular velocity."""
        return self.measure in ("velocity", "angular velocity")

    @property
    def is_load(self) -> bool:
        """Whether it is a force or a moment."""
        return self.kind in ("force", "moment")

    @property
    def is_size(self) -> bool:
        """Whether it is the size of a vector."""
        return self.kind == "force" or (self.symbol is not None and self.symbol.is_vector and not self.along)

    def unit(self, scene: Mechanism, radians: bool = False) -> Unit:
        """Its unit in tables; with ``radians`` that in JSON."""
        return scene.units.of(self.measure, radians)

    def values(self, reach: DriverRange | None, motion: Motion) -> Array:
        """Its values in a motion (SI), shape (n,); in one of a range angles go on from those before."""
        if self.symbol is not None:
            if self.symbol.kind == "theta" and reach is not None:  # between two links, without jumps
                return reach.angle(motion, self.symbol.link) - reach.angle(motion, self.symbol.other)
            found = motion.value(self.symbol)
            senses = senses_along(motion, self.symbol) if self.along else None
            found = found if senses is None else found * senses.conjugate()
            return np.abs(found) if self.is_size else np.asarray(found.real)
        if self.is_load:
            load = forces_of(motion).value(self.of)
            assert load is not None
            return np.abs(load) if self.is_size else load
        if self.kind == "theta":
            return motion.angle(self.of) if reach is None else reach.angle(motion, self.of)
        if self.kind == "omega":
            return motion.omega(self.of)
        if self.kind == "alpha":
            return motion.alpha(self.of)
        slide = motion.slide(self.of)
        return {"s": slide.travel, "v": slide.velocity, "a": slide.acceleration}[self.kind]

    def smooth(self, reach: DriverRange, motion: Motion) -> tuple[Array, Array]:
        """What is smooth where the quantity may not be: the square of a vector's size or of a distance, the cosine of
        twice an angle that is 90 degrees at most, else the quantity itself; and how far it may be off, 0 where that is
        not known.

        A rate that is nothing but rounding (no larger than the solver's own bound of its error) is 0.
        """
        value, bound = self.values(reach, motion), self._bound(motion)
        if self.symbol is not None and self.symbol.kind in ("gamma", "pressure"):
            return np.asarray(np.cos(2 * value)), 2 * bound
        if not self.is_position:
            value = np.where(np.abs(value) <= bound, 0.0, value)
        squared = self.is_size or (self.symbol is not None and self.symbol.kind == "d")
        return (value**2, (2 * np.abs(value) + bound) * bound) if squared else (value, bound)

    def _bound(self, motion: Motion) -> Array:
        """How far rounding may have moved it; 0 where that is not known."""
        if self.is_load:
            return np.nan_to_num(forces_of(motion).bound[self.kind == "moment"])
        of = motion.bound_of(self._links(motion))
        bound = {
            "angle": of.angle,
            "length": of.position,
            "angular velocity": of.omega,
            "velocity": of.velocity,
            "angular acceleration": of.alpha,
            "acceleration": of.acceleration,
        }[self.measure]
        # of two points that are seen from each other
        both = 1.0 if self.measure.startswith("ang") else 2.0
        return np.asarray(np.where(np.isfinite(bound), both * bound, 0.0))

    def settled(self, motion: Motion, value: Array) -> Array:
        """Values of it in a motion (SI), 0 where they are nothing but rounding; a vector's by its components."""
        if self.is_load:
            floor = forces_of(motion).floors[self.kind == "moment"]
        else:
            # of two points that are seen from each other
            both = 1.0 if self.measure.startswith("ang") else 2.0
            floor = both * motion.floors.get(self.measure, np.zeros(1))
        return settled(value, floor)

    def _links(self, motion: Motion) -> Iterable[str]:
        """The links whose errors it has; none where it takes more than them, as a transmission angle does."""
        if self.kind in ("theta", "omega", "alpha"):
            return (self.of,)
        if self.symbol is None:
            slide = next(s for s in motion.slides if s.key == self.of)
            return slide.a, slide.b
        return links_for(motion.structure, self.symbol) if self.symbol.scope == "motion" else ()

    def of_smooth(self, value: float) -> float:
        """A position from what is smooth of it."""
        if self.symbol is not None and self.symbol.kind in ("gamma", "pressure"):
            return math.acos(min(1.0, max(-1.0, value))) / 2
        return math.sqrt(max(0.0, value)) if self.symbol is not None and self.symbol.kind == "d" else value


def settled(value: Array, floor: Array) -> Array:
    """Values, 0 where they are not above what rounding amounts to; complex ones by their parts."""
    if np.iscomplexobj(value):
        return settled(value.real, floor) + 1j * settled(value.imag, floor)
    return np.asarray(np.where(np.abs(value) <= floor, 0.0, value))


def link_quantities(link: str) -> tuple[Quantity, Quantity, Quantity]:
    """Angle, angular velocity and angular acceleration of a link."""
    return Quantity("theta", link), Quantity("omega", link), Quantity("alpha", link)


def slide_quantities(key: str) -> tuple[Quantity, Quantity, Quantity]:
    """Travel, velocity and acceleration of a sliding pair."""
    return Quantity("s", key), Quantity("v", key), Quantity("a", key)


def force_quantity(scene: Mechanism, name: str) -> Quantity | None:
    """A force or a moment of a scene by its name, ``F_6/5`` and ``F_5/6+`` among them; None for what is none."""
    known, plain = force_names(scene), name.removesuffix("+")
    kind = known.get(plain) or known.get(opposite(plain))
    return None if kind is None else Quantity(kind, name)


def symbol_quantity(symbol: Symbol) -> Quantity:
    """What ``find`` names."""
    if symbol.kind in ("omega", "alpha"):
        return Quantity("omega" if symbol.kind == "omega" else "alpha", symbol.link)
    if symbol.kind == "s" or (symbol.kind == "theta" and not symbol.other):
        return Quantity("s" if symbol.kind == "s" else "theta", symbol.pair)
    return Quantity("symbol", str(symbol), symbol)
