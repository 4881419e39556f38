"""The table of a sweep: a row for each position, in the scene's units, degrees for angles."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from graphkin.scene.model import AngleDriver, Scene
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import Motion, listed_points
from graphkin.study.course import Course
from graphkin.study.quantities import Quantity, link_quantities, slide_quantities, symbol_quantity

__all__ = ["Column", "columns_of", "csv_cell", "csv_lines", "driver_columns", "table_numbers"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Column:
    """One column of numbers: a quantity, or a component ("x", "y") of a vector or a position of a point."""

    name: str
    quantity: Quantity | None = None
    part: str = ""
    symbol: Symbol | None = None
    place: PointRef | None = None

    def values(self, course: Course, motion: Motion) -> Array:
        """Its numbers in the scene's units, angles in degrees, shape (n,)."""
        scene = course.scene
        if self.quantity is not None:
            value = self.quantity.values(course, motion)
            if self.quantity.measure == "angle":
                return np.degrees(value)
            return value if self.quantity.measure.startswith("angular") else value / scene.units.metres
        if self.symbol is not None:
            vector = motion.value(self.symbol)
        else:
            assert self.place is not None
            vector = motion.position(self.place.point, self.place.link)
        return np.asarray((vector.real if self.part == "x" else vector.imag) / scene.units.metres)


def columns_of(scene: Scene, motion: Motion, asked: Sequence[Symbol]) -> tuple[Column, ...]:
    """The columns of a table: what is asked, or everything (each pin once, and each point under a sliding pin)."""
    if asked:
        return tuple(chain.from_iterable(_of_symbol(scene, s) for s in asked))
    found: list[Column] = []
    for link in scene.links:
        found += [_of(scene, q) for q in link_quantities(link.name)]
    seen: set[str] = set()
    for point, link_name in listed_points(motion):
        ref = PointRef(point) if point in scene.by_name[link_name].points else PointRef(point, link_name)
        if str(ref) in seen or (not ref.link and point in scene.frame.points):
            continue
        seen.add(str(ref))
        length = scene.units.length
        if not ref.link:
            found += [Column(f"{part}_{ref} ({length})", part=part, place=ref) for part in "xy"]
        for kind, unit in (("v", f"{length}/s"), ("a", f"{length}/s2")):
            symbol = Symbol(kind, ref)
            found += [Column(f"{symbol}.{part} ({unit})", part=part, symbol=symbol) for part in "xy"]
    for slide in motion.slides:
        found += [_of(scene, q) for q in slide_quantities(slide.key)]
    return tuple(found)


def _of(scene: Scene, quantity: Quantity) -> Column:
    return Column(f"{quantity.name} ({quantity.unit(scene, degrees=True)})", quantity)


def _of_symbol(scene: Scene, symbol: Symbol) -> list[Column]:
    quantity = symbol_quantity(symbol)
    found = [_of(scene, quantity)]
    if symbol.is_vector:
        unit = quantity.unit(scene)
        found += [Column(f"{symbol}.{part} ({unit})", part=part, symbol=symbol) for part in "xy"]
    return found


def driver_columns(scene: Scene) -> tuple[str, ...]:
    """Heads of the columns that hold the drivers' values."""
    length = scene.units.length
    return tuple(f"driver_{d.key} ({'deg' if isinstance(d, AngleDriver) else length})" for d in scene.drivers)


def table_numbers(course: Course, columns: Sequence[Column], motion: Motion) -> Array:
    """Driver values, then the columns, shape (n, drivers + columns); NaN where a position has no value."""
    scene = course.scene
    # a driver value is given, not found: without the last digit that the conversion to radians cost it
    drivers = [
        np.round(np.degrees(values), 11) if isinstance(d, AngleDriver) else values / scene.units.metres
        for d, values in zip(scene.drivers, motion.values.T, strict=True)
    ]
    return np.stack([*drivers, *(c.values(course, motion) for c in columns)], axis=1)


def csv_lines(head: Sequence[Sequence[str]], numbers: Array, tail: Sequence[str]) -> str:
    """Lines of CSV: text cells, numbers in their shortest form that reads back the same, a last text cell.

    Parameters
    ----------
    head : the text cells before the numbers, a list for each row
    numbers : shape (n, columns); NaN gives an empty cell
    tail : the text after the numbers, as it is to stand in the file
    """
    lines = []
    for before, row, after in zip(head, numbers.tolist(), tail, strict=True):
        cells = ["" if value != value else repr(value) for value in row]
        lines.append(",".join((*before, *cells, after)))
    return "\n".join(lines) + "\n" if lines else ""


def csv_cell(value: object) -> str:
    """One cell of a CSV file: quoted where it must be."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    text = repr(value) if isinstance(value, float) else str(value)
    if any(c in text for c in ',"\n\r'):
        return '"' + text.replace('"', '""') + '"'
    return text
