"""The analytic solution in tables for people: the units of the file, degrees, 0 for a value that is rounding alone."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from graphkin.errors import Unsolvable
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import listed_points, own_slides
from graphkin.solver.forces import Forces
from graphkin.study.quantities import Quantity, link_quantities, slide_quantities
from graphkin.table import Array
from graphkin.words import Phrase, Wording, say, word

if TYPE_CHECKING:
    from graphkin.api.solved import Solved


@dataclass(frozen=True)
class SolutionTable:
    """A table of every position of a solution.

    rows : name, and for each column its texts over the positions
    right : columns of numbers, which are aligned to the right
    """

    heads: Sequence[str]
    right: tuple[int, ...] = ()
    rows: list[tuple[str, Sequence[Sequence[str]]]] = field(default_factory=list)

    def at(self, k: int) -> list[list[str]]:
        """Its rows with a value at a position."""
        rows = ([name, *(column[k] for column in columns)] for name, columns in self.rows)
        return [row for row in rows if row[1]]


def solution_tables(solved: Solved, language: str) -> Iterator[tuple[str, Wording, list[SolutionTable]]]:
    """For each position the values of the drivers, the reason for a missing solution ("" where it is solved), and the
    tables, which are the same for all positions."""
    motion, scene = solved.motion, solved.mechanism
    asked = SolutionTable([word("quantity", language), "", ""], (1,))
    for column in (column for name in solved.find for column in solved.columns(name)):
        asked.rows.append((column.name, (_texts(column.values), [column.unit] * len(column.values))))
    tables = [asked] if solved.find else _whole(solved, language)
    for k, status in enumerate(motion.status):
        drivers = zip(scene.drivers, motion.values[k], strict=True)
        values = [f"{d.key} = {scene.unit_of(d).said(float(v))}" for d, v in drivers]
        values += [f"t = {solved.times[k]:.6g} s"] if solved.times else []
        yield ", ".join(values), "" if status == "ok" else motion.said(k), tables


def _texts(*parts: Array) -> list[str]:
    """Numbers, or the components of vectors, over the positions; "" for a missing one."""
    return ["" if any(map(math.isnan, row)) else ", ".join(f"{x:.6g}" for x in row) for row in zip(*parts, strict=True)]


def _whole(solved: Solved, language: str) -> list[SolutionTable]:
    scene, motion = solved.mechanism, solved.motion if solved.forces is None else solved.forces.motion
    push = scene.units.of("acceleration")

    def table(of: str, *right: int) -> SolutionTable:
        shown = {measure: scene.units.of(measure) for measure in ("length", "velocity", "acceleration", "force")}
        units = {measure: unit.text if language == "en" else unit.written for measure, unit in shown.items()}
        return SolutionTable(say(Phrase(f"heads of {of}", **units), language).split("|"), right)

    def columns(*quantities: Quantity) -> list[list[str]]:
        return [_texts(*quantity.parts(None, motion)) for quantity in quantities]

    links, points, slides = table("links", 1, 2, 3), table("points"), table("slides", 1, 2, 3)
    links.rows.extend((link.name, columns(*link_quantities(link.name))) for link in scene.links)
    pairs = own_slides(scene, motion.slides)
    for point, link in listed_points(scene, pairs):
        ref = PointRef(point, "" if point in scene.by_name[link].points else link)
        rates = (Quantity(Symbol(kind, ref)) for kind in ("place", "v", "a"))
        points.rows.append((f"{point}@{link}", columns(*rates)))
    for pair in pairs:
        term = push.of(motion.settled(motion.slide(pair.key).coriolis, "acceleration", 2.0))
        slides.rows.append((pair.key, [*columns(*slide_quantities(pair.key)), _texts(term.real, term.imag)]))
    if solved.forces is None:
        return [links, points, slides]
    forces, moments = table("forces", 2, 3), table("moments", 1)
    forces.rows.extend(_forces(solved.forces))
    moments.rows.extend(_moments(solved.forces))
    return [links, points, slides, forces, moments]


def _forces(found: Forces) -> Iterator[tuple[str, Sequence[Sequence[str]]]]:
    """Forces by components, size and direction."""
    for quantity in _loads(found, True):
        x, y = (_there(found, quantity, part) for part in quantity.parts(None, found.motion))
        way = ["–" if a == b == 0.0 else f"{math.degrees(math.atan2(b, a)):.6g}" for a, b in zip(x, y, strict=True)]
        yield quantity.name, (_texts(x, y), _texts(np.hypot(x, y)), way)


def _moments(found: Forces) -> Iterator[tuple[str, Sequence[Sequence[str]]]]:
    """Moments with their unit; excess work and inertia of the flywheel, if the scene asks for one."""
    motion = found.motion
    shown = [*_loads(found, False)]
    if motion.scene.loading.flywheel is not None:
        shown += [Quantity(Symbol.parse(name)) for name in ("excess_W", "J_F")]
    for quantity in shown:
        try:
            (values,) = quantity.parts(None, motion)
        except Unsolvable:  # no whole turn
            continue
        texts = _texts(_there(found, quantity, values))
        yield quantity.name, (texts, [quantity.unit(motion.scene).text] * len(texts))


def _loads(found: Forces, vectors: bool) -> Iterator[Quantity]:
    """Forces, or moments, each followed by its value with the loads that begin or end exactly here, if that differs."""
    for symbol in (symbol for symbol in found.values if symbol.is_vector is vectors):
        yield Quantity(symbol)
        if symbol in found.beside:
            yield Quantity(replace(symbol, plus=True))


def _there(found: Forces, quantity: Quantity, values: Array) -> Array:
    """Values of a force; NaN where the loads that begin or end here do not change it."""
    symbol = quantity.symbol
    beside = found.beside.get(replace(symbol, plus=False)) if symbol.plus else None
    return values if beside is None else np.where(np.isnan(beside), np.nan, values)
