"""What the solver has to say in words: where the motion ends, why a position is dead, which assembly was taken."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from graphkin.solver.decimals import meant_value
from graphkin.solver.dyads import DyadSolution
from graphkin.solver.engine import SINGULAR, State, positions
from graphkin.solver.joints import Drive, driver_text
from graphkin.solver.pose import Array
from graphkin.structure import (
    Cluster,
    Dyad,
    Slide,
    Structure,
    Turn,
    in_stages,
    named_with_contact,
)
from graphkin.words import Phrase, Wording

if TYPE_CHECKING:
    from graphkin.solver.continuity import Path
    from graphkin.solver.larger_groups import ClusterSolved

__all__ = ["assembly_words", "limit_why", "singular", "without_singular"]

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
    """For each group where it stands in a dead point, shape (n,); near one, where no bound is known, too."""
    dyads = [i for i, solved in state.groups.items() if isinstance(solved, DyadSolution)]
    if state.bounds is not None and dyads:
        lost = ~np.isfinite(sum(np.broadcast_to(b, (n,)) for b in state.bounds))
        sines = [np.broadcast_to(np.abs(state.groups[i].sine), (n,)) for i in dyads]  # type: ignore[union-attr]
        weakest = np.argmin(np.nan_to_num(sines, nan=0.0), axis=0)
        for k, i in enumerate(dyads):
            # far from any dead point a bound is lost only by the length of a chain: there it is given as unknown
            yield i, lost & (weakest == k) & ~(sines[k] >= WEAK)
    for i, solved in state.groups.items():
        if isinstance(solved, DyadSolution):
            yield i, np.broadcast_to(~(np.abs(solved.sine) >= state.singular), (n,))
        else:
            refused = ~(solved.residual < OPEN) | ~(solved.certificate < CERTIFIED)
            yield i, ~(solved.condition * SINGULAR <= 1) | refused


def without_singular(
    structure: Structure, state: State, values: Array, forms: Mapping[int, Array], status: Array, why: Sequence[Wording]
) -> tuple[Array, list[Wording]]:
    """Status and reasons of positions, those told apart that are ok but for a group in a singular position.

    Parameters
    ----------
    values, forms : of the drivers and assemblies that were solved, shapes (n, drivers) and (n, ...)
    status, why : as far as known
    """
    status, reasons = status.copy(), list(why)
    _beyond_limits(structure, state, values, forms, status, reasons)
    for i, dead in singular(structure, state, len(status)):
        for k in np.flatnonzero(dead & (status == "ok")):
            own = {j: f[k : k + 1] for j, f in forms.items()}
            apart = _apart(structure, i, values[k], own)
            status[k] = "not assembled" if apart else "dead point"
            reasons[k] = apart or _dead_why(structure, i, values[k], own)
    return status, reasons


def _beyond_limits(
    structure: Structure, state: State, values: Array, forms: Mapping[int, Array], status: Array, reasons: list[Wording]
) -> None:
    """Positions so near to a limit of the motion that sixteen digits do not tell on which side: refused where fifty
    digits say that the links do not reach each other, put on the limit where the file leaves it open.

    ``status`` and ``reasons`` are changed.
    """
    from graphkin.solver.discriminant import closes

    n = len(status)
    for i, solved in state.groups.items():
        group = structure.elements[i]
        if not isinstance(solved, DyadSolution) or not isinstance(group, Dyad) or group.is_two_lines:
            continue
        discriminant = np.broadcast_to(solved.discriminant, (n,))
        near = np.flatnonzero((np.abs(discriminant) < CLOSE) & (status == "ok"))
        if not len(near):
            continue
        own = {j: np.broadcast_to(f, (n, *np.shape(f)[1:]))[near] for j, f in forms.items() if j <= i}
        if in_stages(structure.elements[:i]):
            side, left_open = np.where(discriminant[near] < 0, -1, 1), np.zeros(len(near), dtype=bool)
        else:
            one = np.ones((len(near), values.shape[1]))
            side, left_open = closes(structure, i, own, Drive(values[near], one, 0 * one))
        for k, s, either in zip(near.tolist(), side.tolist(), left_open.tolist(), strict=True):
            here = {j: f[k : k + 1] for j, f in forms.items() if j <= i}
            if s < 0:
                links, place = Phrase("links", links=", ".join(group.links)), _where(structure, i, values[k], here)
                status[k] = "not assembled"
                reasons[k] = Phrase("just beyond the end of their motion", links=links, place=place)
            elif either:
                why = _dead_why(structure, i, values[k], here)
                status[k], reasons[k] = "dead point", Phrase("as far as the digits of the file tell", why=why)


def _apart(structure: Structure, i: int, values: Array, forms: Mapping[int, Array]) -> Wording:
    """What to say of a dyad whose guides are parallel and not one line, so that they meet nowhere; "" of any other:
    a hair further on it would lie far away."""
    group = structure.elements[i]
    if not (isinstance(group, Dyad) and group.is_two_lines):
        return ""
    one = np.ones((1, len(values)))
    size = structure.scene.size
    for driver, turns in enumerate(d.turns for d in structure.scene.drivers):
        nudged = values[None].copy()
        nudged[0, driver] += HAIR * (1.0 if turns else size)
        solved = positions(structure, Drive(nudged, one, 0 * one), forms, i + 1, rates=False).groups[i]
        assert isinstance(solved, DyadSolution)
        if max(abs(complex(np.ravel(pose.z)[0])) for pose in (solved.first, solved.second)) > FAR_OFF * size:
            links = Phrase("links", links=", ".join(group.links))
            return Phrase("have parallel guides that lie apart", links=links)
    return ""


def limit_why(structure: Structure, path: Path, between: tuple[float, float] | None = None) -> Phrase:
    """Why a path ends, at which driver value, and between which values the motion runs; None where more than one driver
    moves."""
    scene = structure.scene
    by = structure.elements[path.by if path.by is not None else 0]
    assert isinstance(by, Dyad | Cluster)
    moved = np.flatnonzero(path.end != path.start)
    column = int(moved[0]) if len(moved) else 0
    driver = scene.drivers[column]
    end = float(path.values(np.array([path.reach]))[0][column])
    links = named_with_contact(structure, by) if isinstance(by, Dyad) else Phrase("links", links=", ".join(by.links))
    where = {"links": links, "ending": _ending(by), "driver": driver.key, "value": driver_text(scene, driver, end)}
    if between is None:
        return Phrase("end on the straight way there", **where)
    low, high = (driver_text(scene, driver, value) for value in between)
    return Phrase("end between which the motion reaches", **where, low=low, high=high)


def _ending(group: Dyad | Cluster) -> Phrase:
    if isinstance(group, Dyad) and group.is_two_lines:
        return _dyad_words(group).dead
    return Phrase("reach the end of their motion")


def _dead_why(structure: Structure, i: int, values: Array, forms: Mapping[int, Array]) -> Phrase:
    """Why group ``i`` stands in a dead point: an infinite rate, or a velocity that is not unique."""
    from graphkin.solver.larger_groups import ClusterSolved

    scene = structure.scene
    group = structure.elements[i]
    assert isinstance(group, Dyad | Cluster)
    one = np.ones((1, len(scene.drivers)))
    solved = positions(structure, Drive(values[None], one, 0 * one), forms, i + 1, sure=False).groups[i]
    links = (
        named_with_contact(structure, group)
        if isinstance(group, Dyad)
        else Phrase("links", links=", ".join(group.links))
    )
    if isinstance(solved, ClusterSolved):
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
        if group.is_slider_on_bar and abs(e2) < 1e-6 * scene.size:
            first, second = (getattr(p, "point", "") for p in group.outer)
            ending, branch = Phrase("have no direction of their own", first=first, second=second), True
        else:
            ending = _dyad_words(group).dead
    end = Phrase("the velocity is not unique here the motion") if branch else Phrase("a rate is infinite here")
    if not isinstance(solved, ClusterSolved):
        where = _where(structure, i, values, forms)
    return Phrase("stand at a dead point", links=links, ending=ending, end=end, place=where)


def _fold_where(structure: Structure, solved: ClusterSolved, values: Array) -> Wording:
    """Where the dead point of a larger group lies by the bend of its constraints, as they are beside it: along the
    motion that would be free there they open as sigma s + a s2, against the b t of the driver (Seydel, Practical
    Bifurcation and Stability Analysis, ch. 2).  Nothing of several drivers, and where rounding has moved it as far."""
    if len(structure.scene.drivers) != 1 or solved.condition[0] * HIDDEN > 1:
        return ""
    u, sigma, free = np.linalg.svd(solved.matrix[0])
    place = solved.place[:, : len(solved.system.group.members)]
    way = ASIDE * solved.system.scaled(free[None, -1])
    ahead, behind = (solved.system.matrix(solved.system.at(place + side))[0] for side in (way, -way))
    bend = float(u[:, -1] @ (ahead - behind) @ free[-1]) / (4 * ASIDE)
    off = float(sigma[-1] ** 2 / (4 * bend * (u[:, -1] @ solved.right_side[0])))
    return _lies_at(structure, float(values[0]) + off, abs(off), about=True)


def _where(structure: Structure, i: int, values: Array, forms: Mapping[int, Array]) -> Wording:
    """Where the dead point lies, and how far away."""
    from graphkin.solver.dead_points import nearest_dead_point

    signs = {j: float(np.ravel(f)[0]) for j, f in forms.items() if isinstance(structure.elements[j], Dyad) and j < i}
    value = float(values[0])
    point = nearest_dead_point(structure, i, signs, value)
    if point is None:
        return ""
    away = float(abs(point.value - meant_value(structure.scene.drivers[0], value)))
    return _lies_at(structure, float(point.value), away if away > 1e-30 else 0.0)


def _lies_at(structure: Structure, value: float, away: float, about: bool = False) -> Phrase:
    scene, driver = structure.scene, structure.scene.drivers[0]
    key, figures = ("it lies at about", 2) if about else ("it lies at", 3)
    distance: Wording = f"{away / scene.units.metres:.{figures}g} {scene.units.length}"
    if driver.turns:
        distance = Phrase("so many degrees", value=f"{np.degrees(away):.{figures}g}")
    return Phrase(key, driver=driver.key, value=driver_text(scene, driver, value), distance=distance)


def assembly_words(structure: Structure, forms: Mapping[int, Array]) -> tuple[Phrase, ...]:
    """For each group which assembly was taken, in the order of ``structure.groups``."""
    words: list[Phrase] = []
    for i, element in enumerate(structure.elements):
        if isinstance(element, Dyad):
            said = _dyad_words(element)
            words.append(said.positive if float(forms[i]) > 0 else said.negative)
        elif isinstance(element, Cluster):
            words.append(_cluster_words(structure, element, np.asarray(forms[i])))
    return tuple(words)


def _cluster_words(structure: Structure, group: Cluster, place: Array) -> Phrase:
    """Sides of the inner joints of a larger group, each seen from the next joint on its one link to that on the other,
    and where the first of them lies: two assemblies may have all sides in common."""
    row = (place if place.ndim == 2 else place[0])[: len(group.members)]
    at = {name: (complex(x, y), np.exp(1j * angle)) for name, (x, y, angle) in zip(group.members, row, strict=True)}

    def world(link: str, point: str) -> complex:
        origin, turned = at[link]
        return complex(origin + turned * structure.links[link].points[point])

    def other(link: str, point: str) -> str | None:
        turns = (p.point for p in group.pairs if isinstance(p, Turn) and link in (p.a, p.b))
        return next((p for p in turns if p != point), None)

    said: list[Phrase] = []
    where: Phrase | None = None
    for pair in group.pairs:
        if not {pair.a, pair.b} <= set(group.members):
            continue
        if isinstance(pair, Slide):
            origin, turned = at[pair.b]
            along = (at[pair.a][0] - origin) / turned - pair.guide.through
            positive = (along / pair.guide.direction).real > 0
            side_key = "assembled with it positive" if positive else "assembled with it negative"
            said.append(Phrase(side_key, (pair.a, _guide(pair))))
            continue
        first, second = other(pair.a, pair.point), other(pair.b, pair.point)
        if first is None or second is None:
            continue
        inner, one, two = world(pair.a, pair.point), world(pair.a, first), world(pair.b, second)
        z = inner / structure.scene.units.metres
        where = where or Phrase("assembled at", (pair.point, f"{z.real:.5g}", f"{z.imag:.5g}"))
        side = ((two - one).conjugate() * (inner - one)).imag
        said.append(_beside(side > 0, pair.point, first, second))
    said += [where] if where else []
    return reduce(lambda one, other: Phrase("listed", (one, other)), said or [Phrase("assembled as in the scene")])


def _beside(left: bool, inner: str, first: str, second: str) -> Phrase:
    return Phrase("assembled left" if left else "assembled right", (inner, first, second))


class _DyadWords(NamedTuple):
    """What a dyad is said to be: in its positive and in its negative assembly, and at a dead point."""

    positive: Phrase
    negative: Phrase
    dead: Phrase


def _dyad_words(dyad: Dyad) -> _DyadWords:
    first, inner, second = (getattr(p, "point", "") for p in (dyad.outer_first, dyad.inner, dyad.outer_second))
    guide = next((_guide(p) for p in (dyad.outer_second, dyad.inner) if isinstance(p, Slide)), "")
    only = Phrase("assembled only so")
    return {
        "RRR": _DyadWords(
            _beside(True, inner, first, second), _beside(False, inner, first, second),
            Phrase("have in line", first=f"{first}{inner}", second=f"{inner}{second}"),
        ),
        "RRP": _DyadWords(
            Phrase("assembled further along", (guide,)), Phrase("assembled less far along", (guide,)),
            Phrase("have square to the guide", bar=f"{first}{inner}"),
        ),
        "RPR": _DyadWords(
            Phrase("assembled on the positive side", (guide,)), Phrase("assembled on the negative side", (guide,)),
            Phrase("have square to the guide", bar=f"{second}{first}"),
        ),
    }.get(dyad.kind, _DyadWords(only, only, Phrase("have parallel guides")))  # fmt: skip


def _guide(pair: Slide) -> str:
    return f"{pair.b}.{pair.guide.name}" if pair.guide.name else pair.b
