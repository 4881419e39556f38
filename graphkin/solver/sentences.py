"""The sentences of the solver: values of drivers, ends of the motion, assemblies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce

import numpy as np

from graphkin.scene.model import Driver, Mechanism
from graphkin.scene.pairs import Pair
from graphkin.solver.algebra.pose import Array
from graphkin.structure import Dyad, LargerGroup, Structure, named_with_contact
from graphkin.words import Phrase, Wording

ROUNDING = 5e-15
"""A driver value (rad, m) that is no more is 0."""


def limit_why(
    structure: Structure, by: int, moved: Sequence[int], values: Sequence[float],
    between: tuple[float, float] | None = None,
) -> Phrase:
    """The reason why a path of the drivers ends.

    Parameters
    ----------
    by : the group that ends it, by its index among the elements
    moved, values : the drivers that move, and the values of all at its end (rad, m)
    between : values between which the motion runs; None where more than one driver moves
    """
    scene, group = structure.scene, structure.elements[by]
    assert isinstance(group, Dyad | LargerGroup)
    column = moved[0] if len(moved) else 0
    driver = scene.drivers[column]
    ending = Phrase("reach the end of their motion")
    if isinstance(group, Dyad) and group.is_two_lines:
        _, _, ending = dyad_words(group)
    where = {"links": named_with_contact(structure, group), "ending": ending, "driver": driver.key,
             "value": driver_text(scene, driver, values[column])}
    if between is None:
        return Phrase("end on the straight way there", **where)
    low, high = (driver_text(scene, driver, value) for value in between)
    return Phrase("end between which the motion reaches", **where, low=low, high=high)


def lies_at(structure: Structure, value: float, away: float, about: bool = False) -> Phrase:
    """The place of a dead point: the value of the driver, and the distance to it (rad, m)."""
    scene, driver = structure.scene, structure.scene.drivers[0]
    key, figures = ("it lies at about", 2) if about else ("it lies at", 3)
    distance: Wording = f"{away / scene.units.metres:.{figures}g} {scene.units.length}"
    if driver.turns:
        distance = Phrase("so many degrees", value=f"{np.degrees(away):.{figures}g}")
    return Phrase(key, driver=driver.key, value=driver_text(scene, driver, value), distance=distance)


def assembly_words(structure: Structure, modes: Mapping[int, Array]) -> tuple[Phrase, ...]:
    """The assembly of each group, in the order of ``structure.groups``."""
    words: list[Phrase] = []
    for i, element in enumerate(structure.elements):
        if isinstance(element, Dyad):
            positive, negative, _ = dyad_words(element)
            words.append(positive if float(modes[i]) > 0 else negative)
        elif isinstance(element, LargerGroup):
            words.append(_place_words(structure, element, np.asarray(modes[i])))
    return tuple(words)


def _place_words(structure: Structure, group: LargerGroup, place: Array) -> Phrase:
    """The sides of a larger group's inner joints, each seen from the next joint on its first link to that on the
    second, and the place of the first: two assemblies may have all sides in common."""
    row = (place if place.ndim == 2 else place[0])[: len(group.members)]
    at = {name: (complex(x, y), np.exp(1j * angle)) for name, (x, y, angle) in zip(group.members, row, strict=True)}

    def world(link: str, point: str) -> complex:
        origin, turned = at[link]
        return complex(origin + turned * structure.links[link].points[point])

    def other(link: str, point: str) -> str | None:
        turns = (p.point for p in group.pairs if p.turns and link in (p.a, p.b))
        return next((p for p in turns if p != point), None)

    said: list[Phrase] = []
    where: Phrase | None = None
    for pair in group.pairs:
        if not {pair.a, pair.b} <= set(group.members):
            continue
        if not pair.turns:
            origin, turned = at[pair.b]
            along = (at[pair.a][0] - origin) / turned - pair.guide.through
            positive = (along / pair.guide.direction).real > 0
            side_key = "assembled with it positive" if positive else "assembled with it negative"
            said.append(Phrase(side_key, point=pair.a, guide=_guide(pair)))
            continue
        first, second = other(pair.a, pair.point), other(pair.b, pair.point)
        if first is None or second is None:
            continue
        inner, start, end = world(pair.a, pair.point), world(pair.a, first), world(pair.b, second)
        z = inner / structure.scene.units.metres
        where = where or Phrase("assembled at", point=pair.point, x=f"{z.real:.5g}", y=f"{z.imag:.5g}")
        side = ((end - start).conjugate() * (inner - start)).imag
        said.append(_beside(side > 0, pair.point, first, second))
    said += [where] if where else []
    said = said or [Phrase("assembled as in the scene")]
    return reduce(lambda left, right: Phrase("listed", first=left, second=right), said)


def _beside(left: bool, inner: str, first: str, second: str) -> Phrase:
    return Phrase("assembled left" if left else "assembled right", point=inner, first=first, second=second)


def dyad_words(dyad: Dyad) -> tuple[Phrase, Phrase, Phrase]:
    """The words for a dyad in its positive and in its negative assembly, and at a dead point."""
    first, inner, second = (p.point for p in dyad.pairs)
    guide = next((_guide(p) for p in (dyad.outer_second, dyad.inner) if not p.turns), "")
    if dyad.kind == "RRR":
        in_line = Phrase("have in line", first=f"{first}{inner}", second=f"{inner}{second}")
        return _beside(True, inner, first, second), _beside(False, inner, first, second), in_line
    if dyad.kind == "RRP":
        square = Phrase("have square to the guide", bar=f"{first}{inner}")
        return Phrase("assembled further along", guide=guide), Phrase("assembled less far along", guide=guide), square
    if dyad.kind == "RPR":
        square = Phrase("have square to the guide", bar=f"{second}{first}")
        positive = Phrase("assembled on the positive side", guide=guide)
        negative = Phrase("assembled on the negative side", guide=guide)
        return positive, negative, square
    only = Phrase("assembled only so")
    return only, only, Phrase("have parallel guides")


def _guide(pair: Pair) -> str:
    return f"{pair.b}.{pair.guide.name}" if pair.guide.name else pair.b


def driver_text(scene: Mechanism, driver: Driver, value: float) -> Wording:
    """A driver value in its own unit, 0 where it is rounding alone."""
    value = value if abs(value) > ROUNDING else 0.0
    if driver.turns:
        return Phrase("so many degrees", value=f"{np.degrees(value):.10g}")
    return f"{value / scene.units.metres:.10g} {scene.units.length}"
