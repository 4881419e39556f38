"""Quantities over a turn: their values in a motion, their columns in a table, and the smooth functions by which their
extremes are sought."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from graphkin.scene.model import Mechanism, forces_named
from graphkin.scene.symbol import Symbol
from graphkin.solver import DriverRange, Motion, listed_points, own_slides
from graphkin.solver.algebra.pose import Array
from graphkin.solver.forces import ends_of, settled_value, value_of
from graphkin.solver.quantities import all_slides
from graphkin.solver.values import of_cycle
from graphkin.structure import Structure, links_for
from graphkin.table import Column, Table
from graphkin.words import Wording

Parts = tuple[tuple[Array, ...], ...]
"""Of each quantity its values, two for a vector."""
Words = Sequence[Wording] | Array
IN_LINE = 1e-12
"""Two bars are in line where the square of the sine of their angle is no more: rounding tells no less."""


def course_of(quantity: Symbol, reach: DriverRange | None, motion: Motion) -> Array:
    """The values of a quantity in a motion as real numbers (SI), of a vector its size, shape (n,); angles are
    continuous, over a range from its start on."""
    if quantity.kind == "theta":
        angle, other = motion.angle if reach is None else partial(reach.angle, motion), quantity.other
        return angle(quantity.link) - angle(other) if other else angle(quantity.link)
    value = (of_cycle if quantity.scope == "cycle" else value_of)(motion, quantity)
    return np.abs(value) if quantity.is_vector else np.asarray(value.real)


def parts_of(quantity: Symbol, reach: DriverRange | None, motion: Motion) -> tuple[Array, ...]:
    """The values of a quantity in a motion (alone, or of a range) in the table's units, 0 where they are rounding
    alone: one array, or a vector's components."""
    if quantity.is_angle_of_link or quantity.scope == "cycle":
        value = motion.settled(course_of(quantity, reach, motion), quantity.measure)
    else:
        value = settled_value(motion, quantity)
    shown = quantity.unit(motion.scene.units).of(value)
    return (shown.real, shown.imag) if len(quantity.heads) == 2 else (shown,)


def columns_of(quantity: Symbol, scene: Mechanism, parts: Sequence[Array], sizes: bool = True) -> list[Column]:
    """The columns of a quantity, from its ``parts``; with ``sizes`` the size of a velocity, acceleration or force
    before them."""
    unit, name = quantity.unit(scene.units).text, str(quantity)
    made = [Column(head, part, unit, name) for head, part in zip(quantity.heads, parts, strict=True)]
    return [Column(name, np.abs(parts[0] + 1j * parts[1]), unit, name), *made] if sizes and quantity.is_vector else made


def smooth_course(quantity: Symbol, reach: DriverRange, motion: Motion) -> tuple[Array, Array]:
    """A smooth function that grows with a quantity: the square of a vector's size or of a distance, minus the cosine of
    twice an angle of at most 90 degrees, else the quantity itself; and its error bound, 0 where it is unknown.

    A rate that is rounding alone (no larger than the solver's own bound of its error) is 0.
    """
    value, bound = course_of(quantity, reach, motion), _bound(quantity, motion)
    if quantity.entry.acute:
        return np.asarray(-np.cos(2 * value)), bound
    if not quantity.is_position:
        value = np.where(np.abs(value) <= bound, 0.0, value)
    return (value**2, (2 * np.abs(value) + bound) * bound) if quantity.is_unsigned else (value, bound)


def of_smooth(quantity: Symbol, value: float) -> float:
    """The value of a quantity from its smooth function."""
    if quantity.entry.acute:
        sine = (1.0 + value) / 2  # the square of it
        return math.asin(math.sqrt(min(1.0, sine))) if sine > IN_LINE else 0.0
    return math.sqrt(max(0.0, value)) if quantity.is_unsigned else value


def _bound(quantity: Symbol, motion: Motion) -> Array:
    """The bound of a quantity's rounding error, by the links whose errors it has; 0 where it is unknown."""
    # none of a quantity of further links, as a transmission angle
    moves = quantity.scope == "motion" or quantity.is_of_output
    bound = motion.accuracy.of(links_for(motion.structure, quantity) if moves else ()).of(quantity.measure)
    return np.where(np.isfinite(bound), ends_of(quantity) * bound, 0.0)


def link_quantities(link: str) -> tuple[Symbol, Symbol, Symbol]:
    """Angle, angular velocity and angular acceleration of a link."""
    return rates_of(Symbol("theta", link=link))


def slide_quantities(key: str) -> tuple[Symbol, Symbol, Symbol]:
    """Travel, velocity and acceleration of a sliding pair."""
    sliding, _, guiding = key.partition("/")
    return rates_of(Symbol("s", link=sliding, other=guiding))


def rates_of(quantity: Symbol) -> tuple[Symbol, Symbol, Symbol]:
    """Position, rate and second rate of the point, the sliding pair or the link of a quantity."""
    kinds = "place v a" if quantity.of else "s v a" if quantity.other else "theta omega alpha"
    position, rate, second = (replace(quantity, kind=kind) for kind in kinds.split())
    return position, rate, second


def all_that_moves(structure: Structure) -> tuple[Symbol, ...]:
    """The quantities of all that moves: each pin once, and each point under a sliding pin."""
    scene, slides = structure.scene, own_slides(structure.scene, all_slides(structure))
    moving = [q for link in scene.links for q in link_quantities(link.name)]
    for ref, _ in listed_points(scene, slides):
        if ref.link or ref.point not in scene.frame.points:
            moving += rates_of(Symbol("place", ref))[1 if ref.link else 0 :]
    moving += [q for slide in slides for q in slide_quantities(slide.key)]
    return *dict.fromkeys(moving), *forces_named(scene)


def motion_table(
    scene: Mechanism, shown: Sequence[Symbol], sizes: bool, first: int, values: Array, parts: Parts, status: Words,
    why: Words, times: Array | None = None,
) -> Table:
    """A row for each position of a motion, numbered from ``first`` + 1 on.

    Parameters
    ----------
    sizes : whether sizes of vectors stand before their components
    values : of the drivers, shape (n, drivers) (SI)
    parts : of each quantity that is shown, as `parts_of` gives them
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
    for quantity, components in zip(shown, parts, strict=True):
        columns += columns_of(quantity, scene, components, sizes)
    return Table((*columns, word_column("status", status, n), word_column("why", why, n)), ("position",))


def word_column(name: str, words: Words, n: int) -> Column:
    """A column of words; a single one stands in every row."""
    known = np.array([str(word) for word in words], dtype=object)  # without it NumPy makes each as wide as the widest
    return Column(name, np.full(n, known))
