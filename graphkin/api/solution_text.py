"""The analytic solution in tables for people: the units of the file, degrees, 0 for a value that is rounding alone."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from graphkin.errors import Unsolvable
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import MEASURES
from graphkin.solver import listed_points, own_slides
from graphkin.solver.forces import Forces
from graphkin.study.quantities import link_quantities, parts_of, slide_quantities
from graphkin.table import Array
from graphkin.words import Phrase, Wording, listed, say, word

if TYPE_CHECKING:
    from graphkin.api.solved import Solved


Row = tuple[str, Sequence[Sequence[str]]]
"""A name, and for each column its texts over the positions."""
Texts = tuple[Sequence[str], tuple[int, ...], list[Row]]
"""A table of all positions: heads, the columns of numbers, rows."""


def solution_tables(
    solved: Solved, language: str
) -> Iterator[tuple[str, Wording, list[tuple[Sequence[str], list[list[str]], tuple[int, ...]]]]]:
    """For each position the values of the drivers, the reason for a missing solution ("" where it is solved), and the
    tables of what has a value there: heads, rows, the columns of numbers."""
    motion, scene = solved.motion, solved.mechanism
    asked: list[Row] = [
        (column.name, (_texts(column.values), [column.unit] * len(column.values)))
        for name in solved.find for column in solved.columns(name)
    ]  # fmt: skip
    heads = [word("quantity", language), "", ""]
    tables: list[Texts] = [(heads, (1,), asked)] if solved.find else _whole(solved, language)
    for k, status in enumerate(motion.status):
        drivers = zip(scene.drivers, motion.values[k], strict=True)
        values = [f"{d.key} = {scene.unit_of(d).said(float(v))}" for d, v in drivers]
        values += [f"t = {solved.times[k]:.6g} s"] if solved.times else []
        here = [
            (heads, [[name, *(column[k] for column in columns)] for name, columns in rows if columns[0][k]], right)
            for heads, right, rows in tables
        ]
        yield say(listed(values), language), "" if status == "ok" else motion.said(k), here


def _texts(*parts: Array) -> list[str]:
    """Numbers, or the components of vectors, over the positions; "" for a missing one."""
    return ["" if any(map(math.isnan, row)) else ", ".join(f"{x:.6g}" for x in row) for row in zip(*parts, strict=True)]


def _whole(solved: Solved, language: str) -> list[Texts]:
    scene, motion = solved.mechanism, solved.motion if solved.forces is None else solved.forces.motion
    push = scene.units.of("acceleration")

    def table(of: str, rows: Iterable[Row], *right: int) -> Texts:
        shown = {measure: scene.units.of(measure) for measure in ("length", "velocity", "acceleration", "force")}
        units = {measure: unit.text if language == "en" else unit.written for measure, unit in shown.items()}
        return say(Phrase(f"heads of {of}", **units), language).split("|"), right, [*rows]

    def columns(*quantities: Symbol) -> list[list[str]]:
        return [_texts(*parts_of(quantity, None, motion)) for quantity in quantities]

    links = [(link.name, columns(*link_quantities(link.name))) for link in scene.links]
    pairs = own_slides(scene, motion.slides)
    points, slides = list[Row](), list[Row]()
    for point, link in listed_points(scene, pairs):
        ref = PointRef(point, "" if point in scene.by_name[link].points else link)
        points.append((f"{point}@{link}", columns(*(Symbol(kind, ref) for kind in ("place", "v", "a")))))
    for pair in pairs:
        term = push.of(motion.settled(motion.slide(pair.key)[3], MEASURES["acceleration"], 2.0))
        slides.append((pair.key, [*columns(*slide_quantities(pair.key)), _texts(term.real, term.imag)]))
    tables = [table("links", links, 1, 2, 3), table("points", points), table("slides", slides, 1, 2, 3)]
    if solved.forces is not None:
        tables += [table("forces", _forces(solved.forces), 2, 3), table("moments", _moments(solved.forces), 1)]
    return tables


def _forces(found: Forces) -> Iterator[Row]:
    """Forces by components, size and direction."""
    for quantity in _loads(found, True):
        x, y = (_there(found, quantity, part) for part in parts_of(quantity, None, found.motion))
        way = ["–" if a == b == 0.0 else f"{math.degrees(math.atan2(b, a)):.6g}" for a, b in zip(x, y, strict=True)]
        yield str(quantity), (_texts(x, y), _texts(np.hypot(x, y)), way)


def _moments(found: Forces) -> Iterator[Row]:
    """Moments with their unit; excess work and inertia of the flywheel, if the scene asks for one."""
    motion = found.motion
    shown = [*_loads(found, False)]
    if motion.scene.loading.flywheel is not None:
        shown += map(Symbol.parse, ("excess_W", "J_F"))
    for quantity in shown:
        try:
            (values,) = parts_of(quantity, None, motion)
        except Unsolvable:  # no whole turn
            continue
        texts = _texts(_there(found, quantity, values))
        yield str(quantity), (texts, [quantity.unit(motion.scene.units).text] * len(texts))


def _loads(found: Forces, vectors: bool) -> Iterator[Symbol]:
    """Forces, or moments, each followed by its value with the loads that begin or end exactly here, if that differs."""
    for symbol in (symbol for symbol in found.values if symbol.is_vector is vectors):
        yield symbol
        if symbol in found.beside:
            yield replace(symbol, plus=True)


def _there(found: Forces, quantity: Symbol, values: Array) -> Array:
    """Values of a force; NaN where the loads that begin or end here do not change it."""
    beside = found.beside.get(replace(quantity, plus=False)) if quantity.plus else None
    return values if beside is None else np.where(np.isnan(beside), np.nan, values)
