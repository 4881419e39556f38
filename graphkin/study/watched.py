"""What the table of a sweep shows: what is asked, or everything that moves, in the scene's units and degrees."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphkin.scene.model import AngleDriver, Scene
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import Motion, listed_points
from graphkin.solver.redundant import all_slides
from graphkin.structure import Structure
from graphkin.study.course import Course
from graphkin.study.quantities import Quantity, link_quantities, slide_quantities, symbol_quantity
from graphkin.table import Column

__all__ = ["Watched", "driver_columns", "in_si", "watched_of"]

Array = NDArray[Any]


@dataclass(frozen=True)
class Watched:
    """A quantity, or the place of a point, in one to three columns of the table.

    size : whether a vector's size stands before its components
    """

    what: Quantity | PointRef
    size: bool = False

    @property
    def name(self) -> str:
        return str(self.what) if isinstance(self.what, PointRef) else self.what.name

    @property
    def is_vector(self) -> bool:
        return isinstance(self.what, PointRef) or self.what.symbol is not None

    def parts(self, course: Course, motion: Motion) -> tuple[Array, ...]:
        """Its values in a motion of a course (SI): one array, or the components of a vector."""
        if isinstance(self.what, PointRef):
            vector = motion.position(self.what.point, self.what.link)
        elif self.what.symbol is not None:
            vector = motion.value(self.what.symbol)
        else:
            return (np.asarray(self.what.values(course, motion)),)
        return vector.real, vector.imag

    def columns(self, scene: Scene, parts: Sequence[Array]) -> list[Column]:
        """Its columns, from its values in SI."""
        metres, length = scene.units.metres, scene.units.length
        if isinstance(self.what, PointRef):
            return [
                Column(f"{axis}_{self.what}", part / metres, length, self.name)
                for axis, part in zip("xy", parts, strict=True)
            ]
        unit = self.what.unit(scene, degrees=True)
        if not self.is_vector:
            value = parts[0]
            if self.what.measure == "angle":
                value = np.degrees(value)
            elif not self.what.measure.startswith("angular"):
                value = value / metres
            return [Column(self.name, value, unit, self.name)]
        x, y = parts
        size = [Column(self.name, np.abs(x + 1j * y) / metres, unit, self.name)] if self.size else []
        ends = zip((".x", ".y"), (x, y), strict=True)
        return [*size, *(Column(self.name + end, part / metres, unit, self.name) for end, part in ends)]


def watched_of(structure: Structure, asked: Sequence[Symbol]) -> tuple[Watched, ...]:
    """What a table shows: what is asked, or everything (each pin once, and each point under a sliding pin)."""
    if asked:
        return tuple(Watched(symbol_quantity(s), s.is_vector) for s in asked)
    scene, slides = structure.scene, all_slides(structure)
    found = [Watched(q) for link in scene.links for q in link_quantities(link.name)]
    seen: set[PointRef] = set()
    for point, link_name in listed_points(scene, slides):
        ref = PointRef(point) if point in scene.by_name[link_name].points else PointRef(point, link_name)
        if ref in seen or (not ref.link and point in scene.frame.points):
            continue
        seen.add(ref)
        found += [Watched(ref)] if not ref.link else []
        found += [Watched(symbol_quantity(Symbol(kind, ref))) for kind in ("v", "a")]
    found += [Watched(q) for slide in slides for q in slide_quantities(slide.key)]
    return tuple(found)


def driver_columns(scene: Scene, values: Array) -> list[Column]:
    """Columns of the drivers' values (SI), shape (n, drivers)."""
    # a driver value is given, not found: without the last digit that the conversion to radians cost it
    return [
        Column(f"driver_{d.key}", np.round(np.degrees(v), 11), "deg")
        if isinstance(d, AngleDriver)
        else Column(f"driver_{d.key}", v / scene.units.metres, scene.units.length)
        for d, v in zip(scene.drivers, values.T, strict=True)
    ]


def in_si(scene: Scene, column: Column) -> Array:
    """The values of a column in SI."""
    if column.unit == "deg":
        return np.radians(column.values)
    return column.values * scene.units.metres if column.unit.startswith(scene.units.length) else column.values
