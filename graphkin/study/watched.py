"""What the table of a sweep shows: what is asked, or everything that moves, in the scene's units and degrees."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import DriverRange, Motion, listed_points
from graphkin.solver.redundant import all_slides
from graphkin.structure import Structure
from graphkin.study.quantities import Quantity, link_quantities, slide_quantities, symbol_quantity
from graphkin.table import Column

__all__ = ["Watched", "driver_columns", "everything", "watched_named", "watched_symbol"]

Array = NDArray[Any]


@dataclass(frozen=True)
class Watched:
    """A quantity, or the place of a point, in one to three columns of the table.

    size : whether a vector's size stands before its components
    symbol : as it is asked for; None for places, angles, and what slides do
    """

    what: Quantity | PointRef
    size: bool = False
    symbol: Symbol | None = None

    @property
    def name(self) -> str:
        return str(self.what) if isinstance(self.what, PointRef) else self.what.name

    @property
    def is_vector(self) -> bool:
        return isinstance(self.what, PointRef) or self.what.symbol is not None

    @property
    def can_be_prepared(self) -> bool:
        """Whether a prepared mechanism gives it, as it stands in the table."""
        if isinstance(self.what, PointRef):
            return True
        if self.what.symbol is not None:
            return self.what.symbol.kind in ("v", "a")
        return self.what.kind in ("omega", "alpha", "s")

    def parts(self, reach: DriverRange | None, motion: Motion) -> tuple[Array, ...]:
        """Its values in a motion (alone, or of a range), in the table's units: one array, or a vector's components."""
        metres = motion.scene.units.metres
        if isinstance(self.what, PointRef):
            vector = motion.position(self.what.point, self.what.link)
        elif self.what.symbol is not None:
            vector = motion.value(self.what.symbol)
        else:
            value = np.asarray(self.what.values(reach, motion))
            if self.what.measure == "angle":
                return (np.degrees(value),)
            return (value if self.what.measure.startswith("angular") else value / metres,)
        return vector.real / metres, vector.imag / metres

    def columns(self, scene: Mechanism, parts: Sequence[Array]) -> list[Column]:
        """Its columns, from its values."""
        if isinstance(self.what, PointRef):
            heads, unit = [f"{axis}_{self.what}" for axis in "xy"], str(scene.units.length)
        else:
            heads = [f"{self.name}.x", f"{self.name}.y"] if self.is_vector else [self.name]
            unit = self.what.unit(scene, degrees=True)
        size = [Column(self.name, np.abs(parts[0] + 1j * parts[1]), unit, self.name)] if self.size else []
        return [*size, *(Column(h, part, unit, self.name) for h, part in zip(heads, parts, strict=True))]


def watched_symbol(symbol: Symbol) -> Watched:
    """What a symbol of ``find`` shows."""
    return Watched(symbol_quantity(symbol), symbol.is_vector, symbol)


def watched_named(scene: Mechanism, name: str) -> Watched | None:
    """What a name shows that is no symbol of ``find``: the place of a point ("C", "B@3"), the angle of a link
    ("theta_3"), travel, velocity and acceleration of a sliding pair ("s_3/4", "v_3/4", "a_3/4"); None for others."""
    kind, mark, rest = name.partition("_")
    if not mark:
        point, _, link = name.partition("@")
        known = point in scene.holders and (not link or link in scene.by_name)
        return Watched(PointRef(point, link)) if known else None
    if kind == "theta" and any(link.name == rest for link in scene.links):
        return Watched(link_quantities(rest)[0])
    if kind in ("s", "v", "a") and any(s.key == rest for s in scene.slidings):
        return Watched(slide_quantities(rest)["sva".index(kind)])
    return None


def everything(structure: Structure) -> tuple[Watched, ...]:
    """Everything that moves: each pin once, and each point under a sliding pin."""
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


def driver_columns(scene: Mechanism, values: Array) -> list[Column]:
    """Columns of the drivers' values (SI), shape (n, drivers)."""
    # a driver value is given, not found: without the last digit that the conversion to radians cost it
    return [
        Column(f"driver_{d.key}", np.round(np.degrees(v), 11), "deg")
        if isinstance(d, AngleDriver)
        else Column(f"driver_{d.key}", v / scene.units.metres, scene.units.length)
        for d, v in zip(scene.drivers, values.T, strict=True)
    ]

