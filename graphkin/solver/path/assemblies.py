"""The assembly of every group at the scene's own position."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import added_up
from graphkin.solver.algebra.constraints import Constraints, solve_all
from graphkin.solver.algebra.dyads import TOUCH, DyadSolution
from graphkin.solver.algebra.pose import Array, Drive, Pose
from graphkin.solver.compiled.engine import SINGULAR, State, new_places, own_position
from graphkin.solver.drivers import own_values
from graphkin.solver.quantities import Posed
from graphkin.solver.sentences import driver_text
from graphkin.structure import (
    Driven,
    Dyad,
    LargerGroup,
    Structure,
    named_with_contact,
    pick,
    started,
)
from graphkin.structure.model import Coordinate
from graphkin.words import Phrase, Wording

if TYPE_CHECKING:
    from graphkin.solver.algebra.larger_groups import GroupSolved

STARTS = 360
ROUNDS = 80
SAME = 1e-6
NEAR = 1e-4
FOUND = 1e-13
FLAT, HOPELESS = 1e-7, 1e-5
"""Where the constraints are open all the same and no step closes them better, relatively, nothing more is found; the
second where they are further open than NEAR, since towards such a place steps only creep."""


def reading(structure: Structure, poses: Mapping[str, Pose], coordinate: Coordinate) -> Array:
    """An angle within a turn, or a travel, shape (n,) (rad, m)."""
    kind, name = coordinate
    if kind == "angle":
        return np.atleast_1d(np.angle(poses[name].u))
    return np.atleast_1d(Posed(structure, poses, structure.slides).travel(structure.slide(name)))


def choose_modes(structure: Structure, turned: Collection[int] = (), upto: int | None = None) -> dict[int, Array]:
    """The assembly mode of each group at the scene's own position: by drawn or sketched points, else by the rule for
    its kind.

    Parameters
    ----------
    turned : dyads in the opposite assembly, by their indices among the elements
    upto : only the elements before this one

    Returns
    -------
    dict from the element's place to the sign of a dyad (0-d array) or the places (members, 3) of a larger group, see
    ``larger_groups.mode_of``; of a rolling link the angle or travel of each link on which it rolls,
    there and now, whole turns included, shape (2 factors,)

    Raises
    ------
    SceneError
        no data choose between the assemblies of a larger group, or drawn points lie in none
    Unsolvable
        the mechanism cannot be assembled here ("not assembled"), or stands in a dead point ("dead point")
    """
    modes: dict[int, Array] = {}
    start: Mapping[str, Pose] = {}
    known: dict[int, float] = {}  # of the formulas of the groups before
    for i, element in enumerate(structure.elements[:upto]):
        if isinstance(element, Dyad):
            modes[i], known = _choose_sign(structure, i, element, modes, known, i in turned)
        elif isinstance(element, Driven):
            if element.rolled is not None:
                state = own_position(structure, modes, i)
                readings = [reading(structure, state.poses, coordinate)[0] for coordinate, _ in element.rolled.factors]
                modes[i] = np.repeat(readings, 2)
            if structure.scene.drawn:  # one place alone, which must be the drawn one
                state = own_position(structure, modes, i + 1)
                pick(structure.scene, (element.link,), [new_places(structure, i, (element.link,), state.poses)], 0)
        elif isinstance(element, LargerGroup) and element.rolling:
            from graphkin.solver.algebra.larger_groups import mode_of

            start = start or _started(structure)
            modes[i] = mode_of(structure, element, start)
        elif isinstance(element, LargerGroup):
            modes[i] = _choose_place(structure, i, element, own_position(structure, modes, i))
    return modes


def _started(structure: Structure) -> Mapping[str, Pose]:
    """All links at the scene's own position, with drivers in place of the rolling of links that move each other."""
    from graphkin.solver.algebra.larger_groups import GroupSolved

    there = started(structure)
    state = own_position(there, choose_modes(there))
    for i, group in state.groups.items():
        dead = group.condition[0] * SINGULAR > 1 if isinstance(group, GroupSolved) else (
            abs(group.sine[0]) < state.singular[0])
        if dead:
            raise Unsolvable("dead point", Problem(there.elements[i].named, "they start in a dead point",
                                                   "let what rolls start a little beside it"))
    return state.poses


def _choose_sign(
    structure: Structure, i: int, dyad: Dyad, modes: Mapping[int, Array], known: Mapping[int, float], turned: bool
) -> tuple[Array, dict[int, float]]:
    """The sign of a dyad, and the numbers of all formulas up to it with that sign, from the numbers up to the element
    before."""
    scene = structure.scene
    both = dict(known), dict(known)
    states = [own_position(structure, {**modes, i: np.array(sign)}, i + 1, numbers)
              for sign, numbers in zip((1.0, -1.0), both, strict=True)]
    solved = states[0].groups[i]
    assert isinstance(solved, DyadSolution)
    links = dyad.links or dyad.members  # what stands for two contacts of one link has no link of the file
    if dyad.is_two_lines:
        sign = float(np.sign(solved.sine[0])) or 1.0
        if abs(solved.sine[0]) >= states[0].singular[0]:
            pick(scene, links, [new_places(structure, i, links, states[0].poses)], 0)
        return np.array(sign), both[sign < 0]
    if not solved.discriminant[0] >= -TOUCH:
        named = named_with_contact(structure, dyad)
        remedy = _other_way(structure, i, modes) or _nearest(structure, i, modes)
        raise Unsolvable("not assembled", Problem(named, "they do not reach each other in the", remedy))
    if not abs(solved.sine[0]) >= states[0].singular[0]:
        return np.array(1.0), both[0]
    candidates = [new_places(structure, i, links, state.poses) for state in states]
    index = pick(scene, links, candidates, 0) ^ turned
    return np.array((1.0, -1.0)[index]), both[index]


def _other_way(structure: Structure, i: int, modes: Mapping[int, Array]) -> Wording:
    """The assembly of an earlier dyad with which all elements up to group ``i`` can be assembled, in words; "" where no
    single dyad is enough."""
    for k in reversed(range(i)):
        dyad = structure.elements[k]
        if isinstance(dyad, LargerGroup):
            return ""  # where a larger group lies would be another question
        if not isinstance(dyad, Dyad) or dyad.is_two_lines:
            continue
        now = new_places(structure, k, dyad.links, own_position(structure, modes, i).poses)
        state = own_position(structure, {**modes, k: -modes[k], i: np.array(1.0)}, i + 1)
        met = [g.discriminant[0] >= -TOUCH for g in state.groups.values() if isinstance(g, DyadSolution)]
        places = new_places(structure, k, dyad.links, state.poses)
        if all(met) and places:
            point = max(places, key=lambda p: abs(places[p] - now[p]))
            z = places[point] / structure.scene.units.metres
            sketched = f"{point} = [{z.real:.6g}, {z.imag:.6g}]"
            links = named_with_contact(structure, dyad)
            return Phrase("with links in their other assembly they do", links=links, sketched=sketched)
    return ""


def _nearest(structure: Structure, i: int, modes: Mapping[int, Array]) -> Wording:
    """The nearest value of the first driver at which all elements up to group ``i`` can be assembled."""
    from graphkin.solver.path.driver_path import Path, assembled

    if not all(e.explicit for e in structure.elements[:i]):
        return ""
    first, values = structure.scene.drivers[0], own_values(structure.scene)
    value = float(values[0])
    wide = np.pi if first.turns else 2 * structure.scene.size
    signs = {j: float(mode) for j, mode in modes.items()} | {i: 1.0}
    parts = assembled(Path.of_driver(structure, values), [*signs], value - wide, value + wide, signs)
    ends = [end for _, stretch in parts for end in (stretch.low, stretch.high)]
    if not ends:
        return Phrase("no value of the driver assembles them with")
    near = driver_text(structure.scene, first, min(ends, key=lambda end: abs(end - value)))
    return Phrase("the nearest position where they do is at", key=first.key, driver=near)


def _choose_place(structure: Structure, i: int, group: LargerGroup, before: State) -> Array:
    """All assemblies of a larger group by Newton's method from many starts, and the scene's own one; ``before`` is the
    mechanism up to it."""
    drive, known = before.drive, before.poses
    places = _assemblies(structure, group, drive, known)
    if not len(places):
        raise Unsolvable("not assembled", Problem(group.named,
                                                  "no assembly of this group was found in"))
    placed = [{**known, **Constraints(structure, group, known, drive).poses(place[None])} for place in places]
    candidates = [new_places(structure, i, group.links, poses) for poses in placed]
    return np.asarray(places[pick(structure.scene, group.links, candidates, None)])


def _assemblies(structure: Structure, group: LargerGroup, drive: Drive, known: Mapping[str, Pose]) -> Array:
    from graphkin.solver.algebra.larger_groups import solve_group

    place = _starts(structure, group, known)
    residual = _descended(Constraints(structure, group, known, drive), place)
    near = np.flatnonzero(residual < NEAR)
    if not len(near):
        return np.zeros((0, len(group.members), 3))
    rows = _apart(place, near[np.argsort(residual[near] >= FOUND, kind="stable")], structure.scene.size, SAME / 4)
    solved = solve_group(structure, group, known, drive[np.zeros_like(rows)], place[rows], rates=False)
    return _distinct(structure, group, solved)


def _descended(system: Constraints, place: Array) -> Array:
    """Move places to a minimum of the constraints' residuals; the places, and the largest residual of each.

    Levenberg and Marquardt's method: singular starts need no care (Nocedal and Wright, Numerical Optimization, 10.3).
    """
    active, damping = np.arange(len(place)), np.ones(len(place))
    residual = np.full(len(place), np.inf)
    residuals = system.residuals(system.at(place))
    for _ in range(ROUNDS):
        matrix = system.matrix(system.at(place[active]))
        turned = np.swapaxes(matrix, 1, 2)
        slope = (turned @ residuals[..., None])[..., 0]
        most = residual[active] = np.abs(residuals).max(axis=1)
        on = (most > FOUND) & ~(np.abs(slope).max(axis=1) < np.where(most > NEAR, HOPELESS, FLAT) * most)
        if not on.all():
            active, damping, matrix, turned, slope, residuals = (
                x[on] for x in (active, damping, matrix, turned, slope, residuals)
            )
            if not len(active):
                return residual
        normal = turned @ matrix
        diagonal = np.arange(matrix.shape[2])
        normal[:, diagonal, diagonal] += damping[:, None] * 1e-3
        trial = place[active] - system.scaled(solve_all(normal, slope))
        there = system.residuals(system.at(trial))
        better = np.sum(there**2, axis=1) < np.sum(residuals**2, axis=1)
        place[active[better]] = trial[better]
        damping = np.clip(np.where(better, damping / 5, damping * 4), 1e-12, 1e8)
        residuals = np.where(better[:, None], there, residuals)
    residual[active] = np.abs(residuals).max(axis=1)
    return residual


def _apart(place: Array, rows: Array, size: float, least: float) -> Array:
    """The first row of each place, in the order of the rows: places are distinct if links differ by at least ``least``
    (of the size, rad)."""
    turned = np.exp(1j * place[..., 2])
    kept: list[int] = []
    while len(rows):
        first = rows[0]
        kept.append(int(first))
        distance = np.hypot(*np.moveaxis(place[rows, :, :2] - place[first, :, :2], 2, 0)) / size
        far = np.maximum(distance, np.abs(turned[rows] - turned[first])).max(axis=1)
        rows = rows[far >= least]
    return np.array(sorted(kept), dtype=int)


def _starts(structure: Structure, group: LargerGroup, known: Mapping[str, Pose]) -> Array:
    """Starting places: spread over the mechanism; links with drawn or sketched points also near these."""
    scene = structure.scene
    rng = np.random.default_rng(20240229)
    marks = {
        p: complex(np.ravel(known[n].z + known[n].u * z)[0])
        for n in known
        for p, z in structure.links[n].points.items()
    }
    hints = {**scene.sketch, **scene.drawn}
    spots = np.array([*marks.values(), *hints.values()] or [0j])
    reach = max(scene.size, float(np.ptp(spots.real)), float(np.ptp(spots.imag)))
    n, m = STARTS, len(group.members)
    start = np.empty((n, m, 3))
    start[..., :2] = rng.uniform(-reach, reach, (n, m, 2)) + np.array([spots.real.mean(), spots.imag.mean()])
    start[..., 2] = rng.uniform(-np.pi, np.pi, (n, m))
    half = n // 2
    for k, name in enumerate(group.members):
        points = structure.links[name].points
        at = {p: hints.get(p, marks.get(p)) for p in points if p in hints or p in marks}
        pairs = [(points[p], w) for p, w in at.items() if w is not None]
        if not pairs:
            continue
        local = np.array([z for z, _ in pairs])
        world = np.array([w for _, w in pairs])
        turn = np.sum((world - world.mean()) * np.conj(local - local.mean()))
        angle = np.where(abs(turn) > 0, np.angle(turn) + rng.normal(0, 0.2, half), start[:half, k, 2])
        origin = world.mean() - np.exp(1j * angle) * local.mean()
        start[:half, k, 0], start[:half, k, 1], start[:half, k, 2] = origin.real, origin.imag, angle
    return start


def _distinct(structure: Structure, group: LargerGroup, solved: GroupSolved) -> Array:
    """The different assemblies; of those that differ only in the sense of a bar without length the one with the sliding
    link on the positive side."""
    from graphkin.solver.algebra.larger_groups import as_place

    names, size, place = group.members, structure.scene.size, as_place(solved.poses, group.members)
    rows = _apart(place, np.flatnonzero(solved.residual < 1e-11), size, SAME)
    posed = Posed(structure, solved.poses, tuple(p for p in group.pairs if not p.turns and {p.a, p.b} <= {*names}))
    travels = [posed.travel(slide) for slide in posed.slides]
    points = np.array([
        (pose.z + pose.u * z)[rows] for pose, link in ((solved.poses[k], structure.links[k]) for k in names)
        for z in link.points.values()
    ])
    kept: list[int] = []
    for k in sorted(range(len(rows)), key=lambda k: added_up(float(t[rows[k]]) for t in travels), reverse=True):
        if not any(points.size and np.abs(points[:, k] - points[:, other]).max() < SAME * size for other in kept):
            kept.append(k)
    return place[rows[sorted(kept)]]
