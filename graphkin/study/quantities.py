"""Quantities over a turn: one entry a kind.  Angles and travels with their rates, places of points, forces and moments,
and whatever else ``find`` names: each with its unit, its value in a motion, and its columns in a table."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from graphkin.scene.model import Mechanism, forces_named
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Measure, Unit
from graphkin.solver import DriverRange, Motion, listed_points, own_slides
from graphkin.solver.algebra.pose import Array
from graphkin.solver.forces import forces_of
from graphkin.solver.quantities import all_slides
from graphkin.solver.values import senses_along, settled_value, value_of
from graphkin.structure import Structure, links_for
from graphkin.table import Column, Table
from graphkin.words import Wording

Parts = tuple[tuple[Array, ...], ...]
"""Of each quantity its values, two for a vector."""
Words = Sequence[Wording] | Array
IN_LINE = 1e-12
"""Two bars are in line where the square of the sine of their angle is no more: rounding tells no less."""


@dataclass(frozen=True)
class Quantity:
    """One quantity that changes over the turn, by its symbol: ``theta_3`` (angle of a link), ``s_6/1`` (travel of a
    sliding pair), their rates ``omega_3``, ``alpha_3``, ``v_6/1``, ``a_6/1``, the place of a point, a force or a
    moment, the transmission angle of a group of two links ("transmission_4-5"), or another quantity of ``find``.

    along : whether a vector on a guide is given by its signed component along it instead of its size
    """

    symbol: Symbol
    along: bool = False

    @property
    def name(self) -> str:
        return str(self.symbol)

    @property
    def kind(self) -> str:
        return self.symbol.kind

    @property
    def of(self) -> str:
        """The link or the sliding pair that it is of; the place of a point, a force or a moment itself."""
        return self.name if self.kind == "place" or self.symbol.is_load else self.symbol.pair

    @property
    def measure(self) -> Measure:
        """The kind of its number."""
        return self.symbol.measure

    @property
    def order(self) -> int | None:
        """The order of its derivative by time of a link's angle or a sliding pair's travel; None for other
        quantities."""
        relative = self.kind == "theta" and not self.is_angle
        return None if self.symbol.of or relative else self.symbol.order

    @property
    def is_angle(self) -> bool:
        """Whether it is the angle of a link, which may turn on and on."""
        return self.kind == "theta" and not self.symbol.other

    @property
    def is_position(self) -> bool:
        """Whether it is an angle, a travel, or another position."""
        return self.symbol.scope == "position"

    @property
    def is_load(self) -> bool:
        """Whether it is a force or a moment."""
        return self.symbol.is_load

    @property
    def is_size(self) -> bool:
        """Whether one of its numbers is the size of a vector."""
        return self.symbol.is_vector and not self.along

    @property
    def is_unsigned(self) -> bool:
        """Whether it is never negative, and zero only at a least value: a size, a distance, an angle of at most 90
        degrees."""
        return self.is_size or self._apart or self._folded

    @property
    def is_vector(self) -> bool:
        """Whether tables show two components of it."""
        return self.kind == "place" or self.is_size

    @property
    def can_be_prepared(self) -> bool:
        """Whether a prepared mechanism gives it as tables show it."""
        given = self.symbol.order is not None and self.kind != "theta"
        return given and not (self.symbol.is_rate_of_pair or self.symbol.axis)

    def unit(self, scene: Mechanism, radians: bool = False) -> Unit:
        """Its unit in tables; with ``radians`` in JSON."""
        return scene.units.of(self.measure, radians)

    def whole(self, motion: Motion) -> Array:
        """Its values in a motion (SI), complex for vectors, shape (n,)."""
        if self.is_angle:
            return motion.angle(self.symbol.link)
        return value_of(motion, self.symbol)

    def values(self, reach: DriverRange | None, motion: Motion) -> Array:
        """Its values as real numbers (SI), shape (n,); angles are continuous, over a range from its start on."""
        if self.kind == "theta":
            angle, other = motion.angle if reach is None else partial(reach.angle, motion), self.symbol.other
            return angle(self.symbol.link) - angle(other) if other else angle(self.symbol.link)
        found = self.whole(motion)
        along_path = senses_along(motion, self.symbol) if self.along else None
        found = found if along_path is None else found * along_path.conjugate()
        return np.abs(found) if self.is_size else np.asarray(found.real)

    def parts(self, reach: DriverRange | None, motion: Motion) -> tuple[Array, ...]:
        """Its values in a motion (alone, or of a range) in the table's units, 0 where they are rounding alone: one
        array, or a vector's components."""
        if self.is_angle:
            found = motion.settled(self.values(reach, motion), self.measure)
        else:
            found = settled_value(motion, self.symbol)
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

    def smooth(self, reach: DriverRange, motion: Motion) -> tuple[Array, Array]:
        """A smooth function that grows with the quantity: the square of a vector's size or of a distance, minus the
        cosine of twice an angle of at most 90 degrees, else the quantity itself; and its error bound, 0 where it is
        unknown.

        A rate that is rounding alone (no larger than the solver's own bound of its error) is 0.
        """
        value, bound = self.values(reach, motion), self._bound(motion)
        if self._folded:
            return np.asarray(-np.cos(2 * value)), 2 * bound
        if not self.is_position:
            value = np.where(np.abs(value) <= bound, 0.0, value)
        return (value**2, (2 * np.abs(value) + bound) * bound) if self.is_size or self._apart else (value, bound)

    def of_smooth(self, value: float) -> float:
        """Its value from its smooth function."""
        if self._folded:
            sine = (1.0 + value) / 2  # the square of it
            return math.asin(math.sqrt(min(1.0, sine))) if sine > IN_LINE else 0.0
        return math.sqrt(max(0.0, value)) if self._apart or self.is_size else value

    def of_extrapolated(self, value: float) -> float:
        """An extrapolated value: angles of at most 90 degrees are not negative, and 0 where they are rounding alone."""
        return 0.0 if self._folded and value < IN_LINE else value

    @property
    def _folded(self) -> bool:
        """Whether it is an angle of at most 90 degrees."""
        return self.symbol.entry.acute

    @property
    def _apart(self) -> bool:
        """Whether it is a distance."""
        return self.symbol.entry.distance

    @property
    def _ends(self) -> float:
        """The number of places whose errors it has: two for points seen from each other."""
        return 1.0 if self.measure.angle or self.kind == "place" else 2.0

    def _bound(self, motion: Motion) -> Array:
        """The bound of its rounding error; 0 where it is unknown."""
        if self.is_load:
            return np.nan_to_num(forces_of(motion).bound[self.measure.length])
        bound = motion.accuracy.of(self._links(motion)).of(self.measure)
        return np.asarray(np.where(np.isfinite(bound), self._ends * bound, 0.0))

    def _links(self, motion: Motion) -> Iterable[str]:
        """The links whose errors it has; none for a quantity of further links, as a transmission angle."""
        moves = self.symbol.scope == "motion" or self.order == 0
        return links_for(motion.structure, self.symbol) if moves else ()


def link_quantities(link: str) -> tuple[Quantity, Quantity, Quantity]:
    """Angle, angular velocity and angular acceleration of a link."""
    angle, rate, second = (Quantity(Symbol(kind, link=link)) for kind in ("theta", "omega", "alpha"))
    return angle, rate, second


def slide_quantities(key: str) -> tuple[Quantity, Quantity, Quantity]:
    """Travel, velocity and acceleration of a sliding pair."""
    sliding, _, guiding = key.partition("/")
    travel, rate, second = (Quantity(Symbol(kind, link=sliding, other=guiding)) for kind in ("s", "v", "a"))
    return travel, rate, second


def rates_of(quantity: Quantity) -> tuple[Quantity, Quantity, Quantity]:
    """Position, rate and second rate of what an angle, a travel or a rate of one belongs to."""
    symbol = quantity.symbol
    return slide_quantities(symbol.pair) if symbol.other else link_quantities(symbol.link)


def all_that_moves(structure: Structure) -> tuple[Quantity, ...]:
    """The quantities of all that moves: each pin once, and each point under a sliding pin."""
    scene, slides = structure.scene, own_slides(structure.scene, all_slides(structure))
    found = [q for link in scene.links for q in link_quantities(link.name)]
    seen: set[PointRef] = set()
    for point, link_name in listed_points(scene, slides):
        ref = PointRef(point) if point in scene.by_name[link_name].points else PointRef(point, link_name)
        if ref in seen or (not ref.link and point in scene.frame.points):
            continue
        seen.add(ref)
        found += [Quantity(Symbol("place", ref))] if not ref.link else []
        found += [Quantity(Symbol(kind, ref)) for kind in ("v", "a")]
    found += [q for slide in slides for q in slide_quantities(slide.key)]
    return (*found, *map(Quantity, forces_named(scene)))


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
