"""The dead points of a mechanism over the range of its driver, to fifty digits, and driver values given from them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from itertools import product

import numpy as np

from graphkin.errors import GraphkinError, Problem, Unsolvable
from graphkin.scene.model import Mechanism
from graphkin.search import last_true, least_value
from graphkin.solver.assemblies import choose_forms
from graphkin.solver.decimals import PI, meant_value, working
from graphkin.solver.discriminant import Discriminant, newton, touch
from graphkin.solver.dyads import DyadSolution
from graphkin.solver.engine import positions
from graphkin.solver.joints import Drive, driver_text
from graphkin.solver.pose import Array
from graphkin.structure import Cluster, Dyad, Structure, analyse, in_stages
from graphkin.words import Phrase, Wording, clauses, listed

__all__ = ["DeadPoint", "dead_points", "from_dead_point", "nearest_dead_point"]

GRID = 1440
FAR = 4.0
MOST_GROUPS = 6
TOUCH = 1e-9
NOTHING = Decimal(10) ** -36
STEP = Decimal(10) ** -12
BESIDE = 0.01
SAME = 1e-9


@dataclass(frozen=True)
class DeadPoint:
    """A value of the driver (rad, m) at which a group stands in a dead point.

    element : the group, by its place among the elements
    signs : the assembly of the groups before it
    sides : on which sides of it the mechanism assembles: -1 below, +1 above
    """

    value: Decimal
    element: int
    signs: Mapping[int, float]
    sides: tuple[int, ...]


def dead_points(structure: Structure, near: float = 0.0) -> list[DeadPoint]:
    """All dead points of all assemblies within half a turn (four sizes of the mechanism) of a value of its driver; of
    more than six groups those of the first six (``not_searched`` names the links of the others).

    Raises
    ------
    Unsolvable : it has a larger group, whose dead points are known only along its motion
    """
    for element in structure.elements:
        if isinstance(element, Cluster):
            where = Phrase("links", links=", ".join(element.links))
            raise Unsolvable("dead point", Problem(where, Phrase("dead points are found for groups of two")))
    if in_stages(structure.elements):
        where = Phrase("cams named", cams=", ".join(cam.link for cam in structure.scene.cams))
        raise Unsolvable("dead point", Problem(where, Phrase("dead points are found for mechanisms without cams")))
    found: list[DeadPoint] = []
    dyads = [i for i, e in enumerate(structure.elements) if isinstance(e, Dyad)][:MOST_GROUPS]
    for k, i in enumerate(dyads):
        for chosen in product((1.0, -1.0), repeat=k):
            signs = dict(zip(dyads, chosen, strict=False))
            for point in _of_group(structure, i, signs, _grid(structure, near)):
                if not any(p.element == i and p.signs == signs and _same(structure, p, point) for p in found):
                    found.append(point)
    return found


def _same(structure: Structure, one: DeadPoint, two: DeadPoint) -> bool:
    off = float(one.value - two.value)
    turning = structure.scene.drivers[0].turns
    return abs(math.remainder(off, 2 * math.pi) if turning else off) < SAME


def not_searched(structure: Structure) -> tuple[str, ...]:
    """Links of groups that stand behind so many others that not all their assemblies are tried."""
    dyads = [e for e in structure.elements if isinstance(e, Dyad)]
    return tuple(name for e in dyads[MOST_GROUPS:] for name in e.links)


def nearest_dead_point(structure: Structure, i: int, signs: Mapping[int, float], value: float) -> DeadPoint | None:
    """The dead point of a group within a hundredth of a radian (of the size) of a value of the only driver."""
    if len(structure.scene.drivers) != 1 or in_stages(structure.elements[: i + 1]):
        return None
    unit = 1.0 if structure.scene.drivers[0].turns else structure.scene.size
    grid = value + BESIDE * unit * np.linspace(-1.0, 1.0, 42)
    found = list(_of_group(structure, i, signs, grid))
    return min(found, key=lambda p: abs(float(p.value) - value), default=None)


def _grid(structure: Structure, near: float) -> Array:
    turning = structure.scene.drivers[0].turns
    wide = math.pi if turning else FAR * structure.scene.size
    # a step more on both sides, for what lies at the ends
    return np.asarray(near + wide * np.arange(-GRID // 2 - 1, GRID // 2 + 2) / (GRID // 2))


def _of_group(structure: Structure, i: int, signs: Mapping[int, float], grid: Array) -> Iterator[DeadPoint]:
    def gap(value: Array) -> Array:
        state = positions(
            structure, Drive.at(structure, value[:, None]), {**{j: np.asarray(s) for j, s in signs.items()}, i: _ONE},
            i + 1, rates=False,
        )  # fmt: skip
        before = [g.discriminant for j, g in state.groups.items() if j != i and isinstance(g, DyadSolution)]
        solved = state.groups[i]
        assert isinstance(solved, DyadSolution)
        held = np.logical_and.reduce([np.broadcast_to(b >= 0, value.shape) for b in before]) if before else True
        return np.where(held, np.broadcast_to(solved.discriminant, value.shape), np.nan)

    value = gap(grid)
    group = structure.elements[i]
    two_sided = isinstance(group, Dyad) and group.is_two_lines
    touched: set[int] = set()
    for k in range(1, len(grid) - 1):
        before, here, after = value[k - 1], value[k], value[k + 1]
        if np.isfinite(before + here + after) and abs(here) <= min(before, after) and here < max(before, after):
            about, least = least_value(gap, float(grid[k - 1]), float(grid[k + 1]))
            if abs(least) < TOUCH:
                touched |= {k - 1, k}
                yield from _touching(structure, i, signs, about)
    for k in range(len(grid) - 1):
        one, two = value[k], value[k + 1]
        if k in touched or not (np.isfinite(one) and np.isfinite(two)) or (one > 0) == (two > 0):
            continue
        low, high = (k, k + 1) if one > 0 else (k + 1, k)
        about = last_true(lambda x: gap(x) > 0, float(grid[low]), float(grid[high]))
        sides = (-1, 1) if two_sided else ((-1,) if low < high else (1,))
        exact = newton(_gap(structure, i, signs), about)
        if exact is not None:
            yield DeadPoint(exact, i, signs, sides)


def _touching(structure: Structure, i: int, signs: Mapping[int, float], about: float) -> Iterator[DeadPoint]:
    """Where the discriminant of a group comes to zero without sixteen digits telling whether it goes below: one change
    point, or two ends of the motion close to each other, or none."""
    gap = _gap(structure, i, signs)
    place = touch(gap, about)
    if place is None:
        return
    with working():
        least, doubt = gap.with_doubt([place])
        if abs(least) <= max(doubt, NOTHING):
            yield DeadPoint(place, i, signs, (-1, 1))
        elif least < 0:
            step = STEP
            bend = (gap(place + step) + gap(place - step) - 2 * least) / (step * step)
            away = (-2 * least / bend).sqrt() if bend > 0 else Decimal(0)
            for side in (-1, 1) if away else ():
                exact = newton(gap, place + side * away)
                if exact is not None:
                    yield DeadPoint(exact, i, signs, (side,))


_ONE = np.asarray(1.0)


def _gap(structure: Structure, i: int, signs: Mapping[int, float]) -> Discriminant:
    return Discriminant(structure, i, {j: np.asarray(s) for j, s in signs.items()})


def from_dead_point(structure: Structure) -> Structure:
    """The structure of the same scene with the value of its driver, which is given from a dead point.

    Raises
    ------
    Unsolvable : "dead point": there is none of that kind, or there are several and none is named
    """
    scene = structure.scene
    driver = scene.drivers[0]
    dead = driver.dead_point
    assert dead is not None
    with working():
        distance = meant_value(driver, dead.distance)
    side = 1 if distance > 0 else -1
    known: list[tuple[DeadPoint, int]] = []
    found: list[tuple[DeadPoint, Structure]] = []
    for point in dead_points(structure, dead.near or 0.0):
        for way in point.sides:
            with working():
                value = point.value + way * abs(distance)
            here = _at(structure, value)
            try:
                forms = choose_forms(here)
            except GraphkinError:
                continue
            if all(float(forms[j]) == s for j, s in point.signs.items()):
                known.append((point, way))
                found += [(point, here)] if way == side else []
    what = Phrase("driver of key", key=driver.key)
    others = _listed(scene, known)
    if not found:
        key = "no dead point at which the motion begins" if side > 0 else "no dead point at which the motion ends"
        wanted = [Phrase("change the sign of the distance or give"), *others]
        if missing := not_searched(structure):
            wanted.append(Phrase("links were not looked at", links=", ".join(missing), most=MOST_GROUPS))
        raise Unsolvable("dead point", Problem(what, Phrase(key), clauses(wanted)))
    if dead.near is None and len(found) > 1:
        names = listed([driver_text(scene, driver, float(p.value)) for p, _ in found])
        raise Unsolvable("dead point", Problem(what, Phrase("there are dead points at", names=names),
                                               Phrase("write near to tell which one")))
    turn = float(2 * PI) if driver.turns else math.inf

    def away(point: DeadPoint) -> float:
        off = abs(float(point.value) - (dead.near or 0.0))
        return min(off, abs(turn - off))

    taken = min(found, key=lambda pair: away(pair[0]))
    nearest, way = min(known, key=lambda pair: (away(pair[0]), pair[1] != side))
    if dead.near is not None and away(nearest) < away(taken[0]) - SAME:
        wish, at = (driver_text(scene, driver, x) for x in (dead.near, float(nearest.value)))
        key = "nearest dead point where the motion begins" if way > 0 else "nearest dead point where the motion ends"
        raise Unsolvable("dead point", Problem(
            what, Phrase(key, wish=wish, at=at), clauses([Phrase("change the sign of the distance or near"), *others])))
    return taken[1]


def _listed(scene: Mechanism, known: Sequence[tuple[DeadPoint, int]]) -> list[Phrase]:
    """The dead points of a scene in words, and what the motion does there."""
    ends: dict[Wording, list[int]] = {}
    for point, way in known:
        ends.setdefault(driver_text(scene, scene.drivers[0], float(point.value)), []).append(way)
    said = [
        Phrase(
            "the motion passes" if len(set(ways)) > 1 else "it begins there" if ways[0] > 0 else "it ends there", at=at
        )
        for at, ways in ends.items()
    ]
    return [Phrase("dead points", points=listed(said))] if said else []


def _at(structure: Structure, value: Decimal) -> Structure:
    scene = structure.scene
    driver = scene.drivers[0]
    assert driver.dead_point is not None
    exact = replace(driver.dead_point, exact=str(value))
    return analyse(replace(scene, drivers=(replace(driver, value=float(value), dead_point=exact),)))
