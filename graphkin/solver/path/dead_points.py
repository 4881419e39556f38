"""The dead points of a mechanism over the range of its driver, to fifty digits, and driver values given from them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.solver.algebra.bounds import most_of
from graphkin.solver.algebra.dyads import DyadSolution
from graphkin.solver.algebra.pose import Array, Drive
from graphkin.solver.compiled.engine import SINGULAR, State, closes, positions
from graphkin.solver.drivers import meant_value
from graphkin.solver.sentences import dyad_words, lies_at
from graphkin.structure import Dyad, LargerGroup, Structure, named_with_contact
from graphkin.words import Phrase, Wording, listed

if TYPE_CHECKING:
    from graphkin.solver.algebra.larger_groups import GroupSolved
    from graphkin.solver.path.driver_path import Path

MARGIN = 1e-3
"""Of the way that is searched: so much more on both sides, for what lies at its ends."""
BESIDE = 0.01
SAME = 1e-9


@dataclass(frozen=True, eq=False, repr=False)
class DeadPoint:
    """A value of the driver (rad, m) at which a group stands in a dead point.

    element : the group, by its place among the elements
    signs : the assembly of the groups before it
    sides : the sides on which the mechanism assembles: -1 below, +1 above
    """

    value: Decimal
    element: int
    signs: Mapping[int, float]
    sides: tuple[int, ...]


def dead_points(structure: Structure, near: float = 0.0) -> list[DeadPoint]:
    """All dead points of all assemblies within half a turn (four sizes of the mechanism) of a value of its driver; of
    more than seven groups those of the first seven (``not_tried`` names the links of the others).

    Raises
    ------
    Unsolvable : it has a larger group, whose dead points are known only along its motion
    """
    from graphkin.solver.path.driver_path import FAR, MOST_GROUPS, Path

    for group in structure.larger_groups:
        where = group.named
        raise Unsolvable("dead point", Problem(where, "dead points are found for groups of two"))
    for element in (e for e in structure.driven if not e.explicit):
        if element.driver.rolls:
            raise Unsolvable("dead point", Problem(element.named, Phrase("dead points are found where nothing rolls")))
        where = Phrase("cams named", cams=listed([e.lifted.link for e in structure.driven if e.lifted]))
        raise Unsolvable("dead point", Problem(where, Phrase("dead points are found for mechanisms without cams")))
    driver = structure.scene.drivers[0]
    wide = (1 + MARGIN) * driver.span(structure.scene.size) * (math.pi if driver.turns else FAR)
    path, dyads = Path.of_driver(structure, np.zeros(1)), [*structure.dyads][:MOST_GROUPS]
    points: list[DeadPoint] = []
    for k, i in enumerate(dyads):
        candidates = _of_group(path, dyads[:k], i, near - wide, near + wide, {})
        for point in sorted(candidates, key=lambda p: [-sign for sign in p.signs.values()]):
            alike = (p for p in points if p.element == i and p.signs == point.signs)
            if all(abs(driver.wrapped(float(p.value - point.value))) >= SAME for p in alike):
                points.append(point)
    return points


def _of_group(
    path: Path, before: Sequence[int], i: int, low: float, high: float, signs: Mapping[int, float]
) -> Iterator[DeadPoint]:
    """The dead points of a dyad between two values of the driver, after some others whose assemblies are given or both
    tried."""
    from graphkin.solver.path.driver_path import assembled, stretches

    group = path.structure.elements[i]
    assert isinstance(group, Dyad)
    for known, part in assembled(path, before, low, high, signs):
        chosen = {j: float(known.modes[j](np.zeros(1))) for j in before}
        tried = known.with_sign(i, 1.0)
        for stretch in stretches(tried, i, part.low, part.high):
            ends = [(tried.exact_zero(i, end), side) for end, side, ended in
                    zip((stretch.low, stretch.high), (1, -1), stretch.ends, strict=True) if ended]
            touched = (touches[0] for t in stretch.touches if (touches := tried.exact_touches(i, t, BESIDE)))
            yield from (DeadPoint(value, i, chosen, (-1, 1)) for value in touched)
            for value, side in ends:
                if value is not None:
                    yield DeadPoint(value, i, chosen, (-1, 1) if group.is_two_lines else (side,))


OPEN = 1e-9
CERTIFIED = 0.5
CLOSE = 1e-9
"""Where a discriminant is less, sixteen digits may not tell on which side of a limit a position lies."""
WEAK = 1e-3
"""Sine below which a group is near its dead point."""
HIDDEN = 1e-8
"""Where a group passes on errors by one over this, they hide how far its dead point is."""
ASIDE = 1e-4
"""How far a group is put aside to see how its constraints bend."""
HAIR, FAR_OFF = 1e-7, 1e2
"""A step of a driver (rad, or of the size), and what is far away (of the size)."""


def singular(structure: Structure, state: State, n: int) -> Iterator[tuple[int, Array]]:
    """The positions in which each group is at a dead point, shape (n,), or near one where no bound is known."""
    dyads = [i for i, solved in state.groups.items() if isinstance(solved, DyadSolution)]
    if dyads:
        sines = [np.broadcast_to(np.abs(state.groups[i].sine), (n,)) for i in dyads]  # type: ignore[union-attr]
        weakest = np.argmin(np.nan_to_num(sines, nan=0.0), axis=0)
        # far from any dead point a bound is lost only by the length of a chain: there it is given as unknown
        lost = np.any([~(sine >= WEAK) for sine in sines], axis=0)
        if lost.any():
            bound = most_of(state.bounds(structure, lost).values())
            lost[lost] = ~np.logical_and.reduce([np.isfinite(part) for part in bound])
        for k, i in enumerate(dyads):
            yield i, lost & (weakest == k) & ~(sines[k] >= WEAK)
    for i, solved in state.groups.items():
        if isinstance(solved, DyadSolution):
            yield i, np.broadcast_to(~(np.abs(solved.sine) >= state.singular), (n,))
        else:
            refused = ~(solved.residual < OPEN) | ~(solved.certificate < CERTIFIED)
            yield i, ~(solved.condition * SINGULAR <= 1) | refused


def without_singular(
    structure: Structure, state: State, values: Array, modes: Mapping[int, Array], status: Array, why: Sequence[Wording]
) -> tuple[Array, list[Wording]]:
    """Status and reasons of positions, also of those that are solved except for a group in a singular position.

    Parameters
    ----------
    values, modes : of the drivers and assemblies that were solved, shapes (n, drivers) and (n, ...)
    status, why : as known so far
    """
    status, reasons = status.copy(), list(why)
    _beyond_limits(structure, state, values, modes, status, reasons)
    for i, dead in singular(structure, state, len(status)):
        for k in np.flatnonzero(dead & (status == "ok")):
            mode = {j: f[k : k + 1] for j, f in modes.items()}
            why_open = _apart(structure, i, values[k], mode)
            status[k] = "not assembled" if why_open else "dead point"
            reasons[k] = why_open or _dead_why(structure, i, values[k], mode)
    return status, reasons


def _beyond_limits(
    structure: Structure, state: State, values: Array, modes: Mapping[int, Array], status: Array, reasons: list[Wording]
) -> None:
    """Decide positions so near to a limit of the motion that sixteen digits do not give the side: refused where fifty
    digits show that the links do not reach each other, put on the limit where the file's digits leave it open.

    ``status`` and ``reasons`` are changed.
    """

    n = len(status)
    for i, solved in state.groups.items():
        group = structure.elements[i]
        if not isinstance(solved, DyadSolution) or not isinstance(group, Dyad) or group.is_two_lines:
            continue
        discriminant = np.broadcast_to(solved.discriminant, (n,))
        near = np.flatnonzero((np.abs(discriminant) < CLOSE) & (status == "ok"))
        if not len(near):
            continue
        mode = {j: np.broadcast_to(f, (n, *np.shape(f)[1:]))[near] for j, f in modes.items() if j <= i}
        if not all(e.explicit for e in structure.elements[:i]):
            side, left_open = np.where(discriminant[near] < 0, -1, 1), np.zeros(len(near), dtype=bool)
        else:
            side, left_open = closes(structure, i, mode, Drive.at_unit_rates(values[near]))
        for k, s, either in zip(near.tolist(), side.tolist(), left_open.tolist(), strict=True):
            here = {j: f[k : k + 1] for j, f in modes.items() if j <= i}
            if s < 0:
                links, place = group.named, _where(structure, i, values[k], here)
                status[k] = "not assembled"
                reasons[k] = Phrase("just beyond the end of their motion", links=links, place=place)
            elif either:
                why = _dead_why(structure, i, values[k], here)
                status[k], reasons[k] = "dead point", Phrase("as far as the digits of the file tell", why=why)


def _apart(structure: Structure, i: int, values: Array, modes: Mapping[int, Array]) -> Wording:
    """The sentence on a dyad whose guides are parallel and not collinear, so that they meet nowhere and the dyad is far
    away just beyond, or parallel wherever the drivers stand; "" for another dyad."""
    group = structure.elements[i]
    if not (isinstance(group, Dyad) and group.is_two_lines):
        return ""
    size, parallel = structure.scene.size, True
    for column, driver in enumerate(structure.scene.drivers):
        nudged = np.repeat(values[None], 2, axis=0)
        nudged[:, column] += np.array([HAIR, BESIDE]) * driver.span(size)
        both = {j: np.repeat(f, 2, axis=0) for j, f in modes.items()} | {i: np.ones(2)}
        before, state = (positions(structure, Drive.at_unit_rates(nudged), both, k, rates=False) for k in (i, i + 1))
        solved, known = state.groups[i], [before.poses[name].u for name in group.outside]
        assert isinstance(solved, DyadSolution)
        # of guides that do not turn at all the sine is no number
        parallel &= bool(np.all(~(np.abs(solved.sine) >= SINGULAR)) and all(np.isfinite(u).all() for u in known))
        far = max(abs(complex(np.ravel(pose.z)[0])) for pose in (solved.first, solved.second)) > FAR_OFF * size
        if far and not parallel:
            return Phrase("have parallel guides that lie apart", links=group.named)
    return Phrase("have parallel guides everywhere", links=group.named) if parallel else ""


def _dead_why(structure: Structure, i: int, values: Array, modes: Mapping[int, Array]) -> Phrase:
    """The reason for a dead point of group ``i``: an infinite rate, or a velocity that is not unique."""
    from graphkin.solver.algebra.larger_groups import GroupSolved

    scene = structure.scene
    group = structure.elements[i]
    assert isinstance(group, Dyad | LargerGroup)
    solved = positions(structure, Drive.at_unit_rates(values[None]), modes, i + 1, extended=False).groups[i]
    links = named_with_contact(structure, group)
    if isinstance(solved, GroupSolved):
        if not solved.residual[0] < OPEN:
            return Phrase("no position was found here", links=links)
        u, _, _ = np.linalg.svd(np.nan_to_num(solved.matrix[0]))
        branch = abs(float(u[:, -1] @ solved.right_side[0])) <= 1e-5 * float(np.linalg.norm(solved.right_side[0]))
        where = "" if branch else _fold_where(structure, solved, values)
        if not solved.certificate[0] < CERTIFIED and solved.condition[0] * SINGULAR <= 1:
            key = "so near to where two assemblies meet" if branch else "so near to their dead point"
            return Phrase(key, links=links, place=where)
        ending = Phrase("have a singular position")
    else:
        e1, e2, right_side = (complex(np.ravel(x)[0]) for x in (solved.e1, solved.e2, solved.right_side))
        along = e1 if abs(e1) > abs(e2) or not np.isfinite(abs(e2)) else e2
        across = abs((along.conjugate() * right_side).imag) / (abs(along) or 1.0)
        branch = not across > 1e-5 * abs(right_side)
        assert isinstance(group, Dyad)
        if group.kind == "RPR" and abs(e2) < 1e-6 * scene.size:
            first, second = (p.point for p in group.outer)
            ending, branch = Phrase("have no direction of their own", first=first, second=second), True
        else:
            ending = dyad_words(group)[2]
    end = Phrase("the velocity is not unique here the motion") if branch else Phrase("a rate is infinite here")
    if not isinstance(solved, GroupSolved):
        where = _where(structure, i, values, modes)
        if branch and _stands_alone(structure, i, values, modes):
            end = Phrase("they assemble here and nowhere beside")
    return Phrase("stand at a dead point", links=links, ending=ending, end=end, place=where)


def _stands_alone(structure: Structure, i: int, values: Array, modes: Mapping[int, Array]) -> bool:
    """Whether dyad ``i`` assembles at a value of the only driver, but not a hundredth (rad, of the size) beside it."""
    driver, rate = structure.scene.drivers[0], np.ones((2, 1))
    if len(values) > 1:
        return False
    beside = values + BESIDE * driver.span(structure.scene.size) * np.array([[-1.0], [1.0]])
    there = {j: np.repeat(f, 2, axis=0) for j, f in modes.items()}
    solved = positions(structure, Drive(beside, rate, 0 * rate), there, i + 1, rates=False).groups[i]
    assert isinstance(solved, DyadSolution)
    return bool(np.all(np.asarray(solved.discriminant) < -OPEN))


def _fold_where(structure: Structure, solved: GroupSolved, values: Array) -> Wording:
    """The place of a larger group's dead point by the second derivative of its constraints near it: along the motion
    that is free there their residual is sigma s + a s2, against b t of the driver (Seydel, Practical Bifurcation and
    Stability Analysis, ch. 2).  None for several drivers, and where the rounding error is as large."""
    if len(structure.scene.drivers) != 1 or solved.condition[0] * HIDDEN > 1:
        return ""
    u, sigma, free = np.linalg.svd(solved.matrix[0])
    place = solved.place[:, : len(solved.system.group.members)]
    shift = ASIDE * solved.system.scaled(free[None, -1])
    ahead, behind = (solved.system.matrix(solved.system.at(place + side))[0] for side in (shift, -shift))
    second = float(u[:, -1] @ (ahead - behind) @ free[-1]) / (4 * ASIDE)
    distance = float(sigma[-1] ** 2 / (4 * second * (u[:, -1] @ solved.right_side[0])))
    return lies_at(structure, float(values[0]) + distance, abs(distance), about=True)


def _where(structure: Structure, i: int, values: Array, modes: Mapping[int, Array]) -> Wording:
    """The place of a group's dead point within a hundredth of a radian (of the size) of the value of the only driver,
    and its distance."""
    from graphkin.solver.path.driver_path import Path

    if len(structure.scene.drivers) != 1 or not all(e.explicit for e in structure.elements[: i + 1]):
        return ""
    driver, value = structure.scene.drivers[0], float(values[0])
    signs = {j: float(np.ravel(f)[0]) for j, f in modes.items() if j in structure.dyads and j < i}
    near = BESIDE * driver.span(structure.scene.size)
    points = _of_group(Path.of_driver(structure, np.zeros(1)), [*signs], i, value - near, value + near, signs)
    point = min(points, key=lambda p: abs(float(p.value) - value), default=None)
    if point is None:
        return ""
    away = float(abs(point.value - meant_value(driver, value)))
    return lies_at(structure, float(point.value), away if away > 1e-30 else 0.0)
