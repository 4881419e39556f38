"""The structure of a scene for the solver: data that the scene leaves open are decided by its own position: the sense
of guides, the rate of a driver by a point's speed; and the reason for a wrong mobility (redundant but mobile,
over-constrained, not to be closed, wrongly counted).

A link on a swinging or turning guide of unknown sense lies on the guide's positive side, unless the links that hang on
it reach each other only with the opposite sense.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from graphkin.errors import GraphkinError, Problem, Unsolvable
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef
from graphkin.solver.algebra.pose import Drive
from graphkin.solver.compiled.engine import SINGULAR, State, new_places, own_position, positions
from graphkin.solver.drivers import meant_value, own_values, working
from graphkin.solver.path.assemblies import choose_modes
from graphkin.solver.path.dead_points import SAME, DeadPoint, dead_points, singular
from graphkin.solver.quantities import Posed
from graphkin.solver.redundant import Fit, fit
from graphkin.solver.sentences import driver_text
from graphkin.structure import Dyad, LargerGroup, Structure, analyse, mobility_of
from graphkin.words import Phrase, Wording, clauses, links_named, listed

NEARBY = 0.01


def structure_of(scene: Mechanism | Structure) -> Structure:
    """The structure of a scene, with a driver's value given from a dead point computed; a structure is returned as it
    is.

    Raises
    ------
    Unsolvable
        status "mobility", with the diagnosis: if the count fails, each link is left out in turn, the rest is solved,
        and the link is fitted back into it, in position, velocity and acceleration, here and at a position nearby
    """
    scene = scene.whole
    if isinstance(scene, Structure):
        return scene
    try:
        structure = analyse(scene)
        if structure.lifting:
            from graphkin.solver.cams import meeting_followers

            structure = meeting_followers(structure)
    except Unsolvable as stop:
        diagnosis = _diagnosis(scene) if stop.status == "mobility" else None
        if diagnosis is None:
            raise
        raise Unsolvable("mobility", *stop.problems, diagnosis) from None
    if any(d.distance is not None and not d.exact for d in scene.drivers):
        structure = from_dead_point(structure)
    if structure.slides:
        structure = with_sensible_guides(structure)
    if any(d.given_speed for d in scene.drivers):
        return at_given_speed(structure)
    return structure


def _diagnosis(scene: Mechanism) -> Problem | None:
    tried: list[tuple[str, Fit, bool]] = []
    driven = {name for d in scene.drivers for name in (scene.body_of(d.link), *d.links)}
    for link in reversed(scene.links):
        if link.redundant or link.name in driven:
            continue
        without = replace(
            scene, links=tuple(replace(x, redundant=True) if x.name == link.name else x for x in scene.links), drawn={}
        )
        try:
            structure = analyse(without)
            modes = choose_modes(structure)
        except GraphkinError:
            continue
        fits: list[Fit] = []
        for shift in (0.0, NEARBY):
            # a small step of every driver: an angle, or a part of the size
            step = shift * (scene.size if any("/" in d.key for d in scene.drivers) else 1.0)
            value = own_values(scene)[None] + step
            state = positions(structure, Drive.at(structure, value), {i: f[None] for i, f in modes.items()})
            laid = fit(without, link, state.poses)
            if laid is None or any(dead[0] for _, dead in singular(structure, state, 1)):
                break
            fits.append(laid)
        if len(fits) == 2:
            tried.append((link.name, fits[0], bool(fits[0].fits_within()[0] and fits[1].position[0] < 1e-9)))
    # a driver too many does not make a link one too many
    counted = 0 < mobility_of(scene).value < len(scene.drivers)
    return _verdict([x for x in tried if x[2] or not counted])


def _verdict(tried: list[tuple[str, Fit, bool]]) -> Problem | None:
    mobile = [name for name, _, moves in tried if moves]
    if mobile:
        return Problem(Phrase("link of name", name=mobile[0]), "it only repeats what the other links already",
                       "write redundant true in links", link=mobile[0])
    here = [name for name, laid, _ in tried if laid.position[0] < 1e-9]
    if here:
        return Problem(Phrase("link of name", name=here[0]), "it fits in this position but locks the",
                       "leave link out or one of its joints", value=here[0])
    if tried:
        name, laid, _ = min(tried, key=lambda x: float(x[1].position[0]))
        return Problem(Phrase("link of name", name=name), "it does not fit between the others here",
                       "leave link out or one of its joints", position=f'{100 * float(laid.position[0]):.3g}',
                       value=name)
    return None


MOST = 4
"""Guides that may point either way are tried in all combinations up to so many."""


def with_sensible_guides(structure: Structure) -> Structure:
    """The structure with points sketched so that guides have the only senses in which all links that hang on them
    reach; itself where the rule is enough, or where several senses or none are possible.

    Only dyads up to the first larger group are examined.
    """
    free = _free_guides(structure)
    choices: list[tuple[tuple[int, ...], State]] = []
    if not free or _reached(structure, ()) is not None:
        return structure
    for count in range(1, len(free) + 1):
        tried = ((some, _reached(structure, some)) for some in combinations(free, count))
        choices = [(some, state) for some, state in tried if state is not None]
        if choices:
            break
    if len(choices) != 1:
        return structure
    (some, state), scene = choices[0], structure.scene
    sketch = dict(scene.sketch)
    for k in some:
        sketch |= new_places(structure, k, structure.elements[k].members, state.poses)
    return analyse(replace(scene, sketch=sketch))


def _elements(structure: Structure) -> Iterator[tuple[int, Dyad]]:
    """The dyads before the first larger group, and before rolling links."""
    for i, element in enumerate(structure.elements):
        if isinstance(element, LargerGroup) or element.rolled:
            return
        if isinstance(element, Dyad):
            yield i, element


def _free_guides(structure: Structure) -> list[int]:
    """Dyads of a slider on a bar without data for their sense, on which links hang that may not reach."""
    scene, given = structure.scene, {*structure.scene.sketch, *structure.scene.drawn}
    dyads = [*_elements(structure)]
    free = []
    for i, dyad in dyads:
        points = {p for name in dyad.links for p in structure.links[name].points}
        known = {p for j in range(i) for n in structure.elements[j].members for p in structure.links[n].points}
        fresh = points - known - set(scene.frame.points)
        if dyad.kind == "RPR" and not dyad.inner.turns and fresh and not fresh & given and dyads[-1][0] > i:
            free.append(i)
    return free[:MOST]


def _reached(structure: Structure, turned: Collection[int]) -> State | None:
    """All elements up to the last dyad, with some of the guides reversed; None where links do not reach."""
    last = max(i for i, _ in _elements(structure)) + 1
    try:
        modes = choose_modes(structure, turned, last)
    except GraphkinError:
        return None
    return own_position(structure, modes, last)


STANDS = 1e-9  # of the size a radian: a point that moves by less stands still


def at_given_speed(structure: Structure) -> Structure:
    """The structure of the same scene with the rate of its driver, at which a point has its given speed.

    With the driver at one radian a second the point has the velocity v; at the speed asked the driver turns speed / |v|
    times as fast.

    Raises
    ------
    Unsolvable : "dead point": the point rests here at any rate of the driver, or a group is at a dead point
    SceneError : a group has several assemblies and no sketch chooses
    """
    scene = structure.scene
    driver = scene.drivers[0]
    assert driver.given_speed is not None
    name, speed = driver.given_speed
    values = own_values(scene)[None]
    modes = {i: f[None] for i, f in choose_modes(structure).items()}
    state = positions(structure, Drive.at_unit_rates(values), modes, extended=False)
    posed = Posed(structure, state.poses, structure.slides)
    once = abs(complex(np.ravel(posed.point(PointRef(name)).v)[0]))
    if not np.isfinite(once) or once <= STANDS * scene.size or once >= scene.size / SINGULAR:
        resting = "stands still here however fast it turns"
        said = "has no finite speed here" if once > STANDS * scene.size else resting
        raise Unsolvable("dead point", Problem(Phrase("driver of key and name", key=driver.key, name=name), said,
                                               "give omega or another place"))
    return analyse(replace(scene, drivers=(replace(driver, rate=speed / once, given_speed=None),)))


def from_dead_point(structure: Structure) -> Structure:
    """The structure of the same scene with the value of its driver, which is given from a dead point.

    Raises
    ------
    Unsolvable : "dead point": there is none of that kind, or several and none is named
    """
    scene = structure.scene
    driver = scene.drivers[0]
    assert driver.distance is not None
    with working():
        distance = meant_value(driver, driver.distance)
    side = 1 if distance > 0 else -1
    known: list[tuple[DeadPoint, int]] = []
    starts: list[tuple[DeadPoint, Structure]] = []
    for point in dead_points(structure, driver.near or 0.0):
        for sense in point.sides:
            with working():
                value = point.value + sense * abs(distance)
            here = analyse(replace(scene, drivers=(replace(driver, value=float(value), exact=str(value)),)))
            try:
                modes = choose_modes(here)
            except GraphkinError:
                continue
            if all(float(modes[j]) == s for j, s in point.signs.items()):
                known.append((point, sense))
                starts += [(point, here)] if sense == side else []
    where = Phrase("driver of key", key=driver.key)
    others = _listed(scene, known)
    if not starts:
        from graphkin.solver.path.driver_path import MOST_GROUPS, not_tried

        key = "no dead point at which the motion begins" if side > 0 else "no dead point at which the motion ends"
        wanted = [Phrase("change the sign of the distance or give"), *others]
        if missing := not_tried(structure):
            behind = links_named([name for links in missing for name in links])
            wanted.append(Phrase("links were not looked at", links=behind, most=MOST_GROUPS))
        raise Unsolvable("dead point", Problem(where, Phrase(key), clauses(wanted)))
    if driver.near is None and len(starts) > 1:
        names = listed([driver_text(scene, driver, float(p.value)) for p, _ in starts])
        raise Unsolvable("dead point", Problem(where, "there are dead points at", "write near to tell which one",
                                               names=names))

    def away(point: DeadPoint) -> float:
        return abs(driver.wrapped(float(point.value) - (driver.near or 0.0)))

    taken = min(starts, key=lambda pair: away(pair[0]))
    nearest, sense = min(known, key=lambda pair: (away(pair[0]), pair[1] != side))
    if driver.near is not None and away(nearest) < away(taken[0]) - SAME:
        wish, at = (driver_text(scene, driver, x) for x in (driver.near, float(nearest.value)))
        key = "nearest dead point where the motion begins" if sense > 0 else "nearest dead point where the motion ends"
        raise Unsolvable("dead point", Problem(where, Phrase(key, wish=wish, at=at), clauses([
            Phrase("change the sign of the distance or near"), *others])))
    return taken[1]


def _listed(scene: Mechanism, known: Sequence[tuple[DeadPoint, int]]) -> list[Phrase]:
    """The dead points of a scene in words, with the motion on their sides."""
    ends: dict[Wording, list[int]] = {}
    for point, sense in known:
        ends.setdefault(driver_text(scene, scene.drivers[0], float(point.value)), []).append(sense)
    said = [
        Phrase("the motion passes" if len({*senses}) > 1 else "it begins there" if senses[0] > 0 else "it ends there",
               at=at)
        for at, senses in ends.items()
    ]
    return [Phrase("dead points", points=listed(said))] if said else []
