"""Quantities over a turn: one entry a kind.  Angles and travels with their rates, places of points, forces and moments,
and whatever else ``find`` names: each with its unit, its value in a motion, and its columns in a table."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from graphkin.scene.force_names import force_names, opposite
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Measure, Unit
from graphkin.solver import DriverRange, Motion, forces_of, listed_points, own_slides, senses_along, value_of
from graphkin.solver.pose import Array
from graphkin.solver.prepared import PreparedMechanism
from graphkin.solver.quantities import all_slides, transmission
from graphkin.structure import Structure, links_for
from graphkin.table import Column, Table
from graphkin.words import Wording

__all__ = [
    "Parts", "Quantity", "Words", "all_that_moves", "link_quantities", "motion_table", "named_quantity",
    "place_quantity", "rates_of", "settled", "slide_quantities", "symbol_quantity", "word_column",
]  # fmt: skip

Kind = Literal["theta", "omega", "alpha", "s", "v", "a", "place", "force", "moment", "transmission", "symbol"]
Parts = tuple[tuple[Array, ...], ...]
"""Of each quantity its values, two for a vector."""
Words = Sequence[Wording] | Array
IN_LINE = 1e-12
"""Two bars are in line where the square of the sine of their angle is no more: rounding tells no less."""

_KINDS: Mapping[str, tuple[Measure, Callable[[Motion, str], Array | None]]] = {
    "theta": ("angle", lambda motion, link: motion.angle(link)),
    "omega": ("angular velocity", lambda motion, link: motion.omega(link)),
    "alpha": ("angular acceleration", lambda motion, link: motion.alpha(link)),
    "s": ("length", lambda motion, pair: motion.slide(pair).travel),
    "v": ("velocity", lambda motion, pair: motion.slide(pair).velocity),
    "a": ("acceleration", lambda motion, pair: motion.slide(pair).acceleration),
    "place": ("length", lambda motion, ref: motion.position(*ref.split("@"))),
    "force": ("force", lambda motion, name: forces_of(motion).value(name)),
    "moment": ("moment", lambda motion, name: forces_of(motion).value(name)),
    "transmission": ("angle", lambda motion, links: _transmission(motion, links)),
}
"""What a quantity of each kind measures, and its value (SI) in a motion by the name of what it is of; of a ``symbol``
both are the symbol's own."""


def _transmission(motion: Motion, links: str) -> Array:
    """The transmission angle of the group of two links that has these."""
    dyad = next(d for d in motion.structure.dyads.values() if "-".join(d.links) == links)
    return transmission(motion.structure, dyad, motion.poses).angle


@dataclass(frozen=True)
class Quantity:
    """One quantity that changes over the turn: ``theta_3`` (angle of a link), ``s_6/1`` (travel of a sliding pair),
    their rates ``omega_3``, ``alpha_3``, ``v_6/1``, ``a_6/1``, the place of a point, a force or a moment by its name,
    the transmission angle of a group of two links ("4-5"), or another symbol of ``find``.

    along : of a vector that lies on a guide its part along that, with its sign, stands for it instead of its size
    """

    kind: Kind
    of: str
    symbol: Symbol | None = None
    along: bool = False

    @property
    def name(self) -> str:
        if self.is_load or self.kind == "place":
            return self.of
        return str(self.symbol) if self.symbol else f"{self.kind}_{self.of}"

    @property
    def measure(self) -> Measure:
        """What kind of number it is."""
        return self.symbol.measure if self.symbol else _KINDS[self.kind][0]

    @property
    def is_position(self) -> bool:
        """Whether it is an angle or a travel."""
        known = self.kind in ("theta", "s", "transmission")
        return known or (self.symbol is not None and self.symbol.scope == "position")

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
        """Whether one number of it is the size of a vector."""
        return self.kind == "force" or (self.symbol is not None and self.symbol.is_vector and not self.along)

    @property
    def is_vector(self) -> bool:
        """Whether tables show two components of it."""
        return self.kind == "place" or self.is_size

    @property
    def can_be_prepared(self) -> bool:
        """Whether a prepared mechanism gives it, as it stands in tables."""
        return self.symbol.kind in ("v", "a") if self.symbol else self.kind in ("place", "omega", "alpha", "s")

    def unit(self, scene: Mechanism, radians: bool = False) -> Unit:
        """Its unit in tables; with ``radians`` that in JSON."""
        return scene.units.of(self.measure, radians)

    def whole(self, motion: Motion) -> Array:
        """Its values in a motion (SI), complex for vectors, shape (n,)."""
        found = value_of(motion, self.symbol) if self.symbol else _KINDS[self.kind][1](motion, self.of)
        assert found is not None
        return found

    def values(self, reach: DriverRange | None, motion: Motion) -> Array:
        """Its values as real numbers (SI), shape (n,); in a motion of a range angles go on from those before."""
        if reach is not None and self.kind == "theta":
            return reach.angle(motion, self.of)
        if reach is not None and self.symbol is not None and self.symbol.kind == "theta":  # between two links
            return reach.angle(motion, self.symbol.link) - reach.angle(motion, self.symbol.other)
        found = self.whole(motion)
        senses = senses_along(motion, self.symbol) if self.symbol and self.along else None
        found = found if senses is None else found * senses.conjugate()
        return np.abs(found) if self.is_size else np.asarray(found.real)

    def parts(self, reach: DriverRange | None, motion: Motion) -> tuple[Array, ...]:
        """Its values in a motion (alone, or of a range) in the table's units, 0 where they are nothing but rounding:
        one array, or a vector's components."""
        found = self.values(reach, motion) if self.kind == "theta" else self.whole(motion)
        if self.is_load:
            found = settled(found, forces_of(motion).floors[self.kind == "moment"])
        else:
            found = motion.settled(found, self.measure, self._ends)
        value = self.unit(motion.scene).of(found)
        return (value.real, value.imag) if self.is_vector else (value,)

    def columns(self, scene: Mechanism, parts: Sequence[Array], sizes: bool = True) -> list[Column]:
        """Its columns, from its ``parts``; with ``sizes`` the size of a velocity, acceleration or force before them."""
        unit, heads = self.unit(scene).text, [self.name]
        if self.is_vector:
            heads = [f"x_{self.of}", f"y_{self.of}"] if self.kind == "place" else [f"{self.name}.x", f"{self.name}.y"]
        made = [Column(head, part, unit, self.name) for head, part in zip(heads, parts, strict=True)]
        sized = sizes and self.is_vector and self.kind != "place"
        return [Column(self.name, np.abs(parts[0] + 1j * parts[1]), unit, self.name), *made] if sized else made

    def residues(self, engine: PreparedMechanism) -> Array:
        """What rounding leaves of nothing in what a prepared mechanism gives of it, in the table's unit."""
        return np.asarray(engine.residues[engine.names.index(self.name + ".x" * self.is_vector)])

    def smooth(self, reach: DriverRange, motion: Motion) -> tuple[Array, Array]:
        """What is smooth where the quantity may not be, and grows with it: the square of a vector's size or of a
        distance, minus the cosine of twice an angle that is 90 degrees at most, else the quantity itself; and how far
        it may be off, 0 where that is not known.

        A rate that is nothing but rounding (no larger than the solver's own bound of its error) is 0.
        """
        value, bound = self.values(reach, motion), self._bound(motion)
        if self._folded:
            return np.asarray(-np.cos(2 * value)), 2 * bound
        if not self.is_position:
            value = np.where(np.abs(value) <= bound, 0.0, value)
        return (value**2, (2 * np.abs(value) + bound) * bound) if self.is_size or self._apart else (value, bound)

    def of_smooth(self, value: float) -> float:
        """Its value from what is smooth of it."""
        if self._folded:
            sine = (1.0 + value) / 2  # the square of it
            return math.asin(math.sqrt(min(1.0, sine))) if sine > IN_LINE else 0.0
        return math.sqrt(max(0.0, value)) if self._apart or self.is_size else value

    @property
    def _folded(self) -> bool:
        """Whether it is an angle that is 90 degrees at most."""
        return self.kind == "transmission" or (self.symbol is not None and self.symbol.kind in ("gamma", "pressure"))

    @property
    def _apart(self) -> bool:
        """Whether it is a distance."""
        return self.symbol is not None and self.symbol.kind == "d"

    @property
    def _ends(self) -> float:
        """How many places err in it: two points that are seen from each other."""
        return 1.0 if self.measure.startswith("ang") or self.kind == "place" else 2.0

    def _bound(self, motion: Motion) -> Array:
        """How far rounding may have moved it; 0 where that is not known."""
        if self.is_load:
            return np.nan_to_num(forces_of(motion).bound[self.kind == "moment"])
        of = motion.accuracy.of(self._links(motion))
        bound = {
            "angle": of.angle,
            "length": of.position,
            "angular velocity": of.omega,
            "velocity": of.velocity,
            "angular acceleration": of.alpha,
            "acceleration": of.acceleration,
        }[self.measure]
        return np.asarray(np.where(np.isfinite(bound), self._ends * bound, 0.0))

    def _links(self, motion: Motion) -> Iterable[str]:
        """The links whose errors it has; none where it takes more than them, as a transmission angle does."""
        if self.kind in ("theta", "omega", "alpha"):
            return (self.of,)
        if self.kind == "transmission":
            return ()
        if self.symbol is None:
            slide = next(s for s in motion.slides if s.key == self.of)
            return slide.a, slide.b
        return links_for(motion.structure, self.symbol) if self.symbol.scope == "motion" else ()


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


def rates_of(quantity: Quantity) -> tuple[Quantity, Quantity, Quantity]:
    """Position, rate and second rate of what an angle, a travel or a rate of one belongs to."""
    of_link = quantity.kind in ("theta", "omega", "alpha")
    return link_quantities(quantity.of) if of_link else slide_quantities(quantity.of)


def place_quantity(ref: PointRef) -> Quantity:
    """The place of a point."""
    return Quantity("place", str(ref))


def symbol_quantity(symbol: Symbol) -> Quantity:
    """What ``find`` names."""
    if symbol.kind in ("omega", "alpha"):
        return Quantity("omega" if symbol.kind == "omega" else "alpha", symbol.link)
    if symbol.kind == "s" or (symbol.kind == "theta" and not symbol.other):
        return Quantity("s" if symbol.kind == "s" else "theta", symbol.pair)
    return Quantity("symbol", str(symbol), symbol)


def named_quantity(scene: Mechanism, name: str) -> Quantity | None:
    """What a name shows that is no symbol of ``find``: the place of a point ("C", "B@3"), the angle of a link
    ("theta_3"), travel, velocity and acceleration of a sliding pair ("s_3/4", "v_3/4", "a_3/4"), a force or a moment
    ("F_5/6", "F_6/5", "F_5/6+", "M_2"); None for others."""
    kind, mark, rest = name.partition("_")
    forces, plain = force_names(scene), name.removesuffix("+")
    load = forces.get(plain) or forces.get(opposite(plain))
    if load is not None:
        return Quantity(load, name)
    if not mark:
        point, _, link = name.partition("@")
        here = point in scene.holders or any(c.name == point for c in scene.contacts)
        known = here and (not link or link in scene.by_name)
        return place_quantity(PointRef(point, link)) if known else None
    if kind == "theta" and any(link.name == rest for link in scene.links):
        return Quantity("theta", rest)
    if kind in ("s", "v", "a") and any(s.key == rest for s in scene.slidings):
        return slide_quantities(rest)["sva".index(kind)]
    return None


def all_that_moves(structure: Structure) -> tuple[Quantity, ...]:
    """Everything that moves: each pin once, and each point under a sliding pin."""
    scene, slides = structure.scene, own_slides(structure.scene, all_slides(structure))
    found = [q for link in scene.links for q in link_quantities(link.name)]
    seen: set[PointRef] = set()
    for point, link_name in listed_points(scene, slides):
        ref = PointRef(point) if point in scene.by_name[link_name].points else PointRef(point, link_name)
        if ref in seen or (not ref.link and point in scene.frame.points):
            continue
        seen.add(ref)
        found += [place_quantity(ref)] if not ref.link else []
        found += [symbol_quantity(Symbol(kind, ref)) for kind in ("v", "a")]
    found += [q for slide in slides for q in slide_quantities(slide.key)]
    found += [Quantity(kind, name) for name, kind in force_names(scene).items()]
    return tuple(found)


def motion_table(
    scene: Mechanism, shown: Sequence[Quantity], sizes: bool, first: int, values: Array, parts: Parts, status: Words,
    why: Words, times: Array | None = None,
) -> Table:  # fmt: skip
    """A row for each position of a motion, numbered from ``first`` + 1 on.

    Parameters
    ----------
    sizes : whether sizes of vectors stand before their components
    values : of the drivers, shape (n, drivers) (SI)
    parts : of each quantity that is shown, as ``Quantity.parts`` gives them
    status, why : of each position, or one of all
    times : of each position (s)
    """
    n = len(values)
    columns = [Column("position", np.arange(first + 1, first + n + 1))]
    columns += [] if times is None else [Column("time", times, "s")]
    for driver, value in zip(scene.drivers, values.T, strict=True):
        unit = scene.unit_of(driver)
        # a driver value is given, not found: without the last digit that the conversion to radians cost it
        driven = np.round(unit.of(value), 11) if driver.measure == "angle" else unit.of(value)
        columns.append(Column(f"driver_{driver.key}", driven, unit.text))
    for quantity, own in zip(shown, parts, strict=True):
        columns += quantity.columns(scene, own, sizes)
    return Table((*columns, word_column("status", status, n), word_column("why", why, n)), ("position",))


def word_column(name: str, words: Words, n: int) -> Column:
    """A column of words; a single one stands in every row."""
    values = np.empty(n, dtype=object)
    values[:] = str(words[0]) if len(words) == 1 else [str(word) for word in words]
    return Column(name, values)
