"""What a scene leaves open and its own position decides: the sense of guides, the rate of a driver by a point's speed.

What slides on a swinging or turning guide lies on its positive side where nobody says which way it points, but where
links that hang on it reach each other only the other way round, and in one way alone, that is meant.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import combinations

import numpy as np

from graphkin.errors import GraphkinError, Problem, Unsolvable
from graphkin.scene.model import AngleDriver
from graphkin.scene.symbol import PointRef
from graphkin.solver.assemblies import choose_forms, new_places, own_values
from graphkin.solver.dyads import DyadSolution
from graphkin.solver.engine import SINGULAR, State, positions
from graphkin.solver.joints import Drive
from graphkin.solver.pose import Array
from graphkin.structure import Cluster, Driven, Dyad, Rolled, Slide, Structure, analyse, links_of, pick
from graphkin.structure.assembly import TOUCH

__all__ = ["at_given_speed", "with_sensible_slots"]

MOST = 4
"""Guides that may point either way are tried in all combinations up to so many."""


def with_sensible_slots(structure: Structure) -> Structure:
    """The structure with points sketched so that guides point the only way in which all that hangs on them reaches;
    itself where the rule does, or where several ways or none would do.

    Only dyads are looked at, up to the first larger group.
    """
    free = _free_guides(structure)
    if not free:
        return structure
    if _reached(structure, {}) is not None:
        return structure
    found = []
    for count in range(1, len(free) + 1):
        for some in combinations(free, count):
            state = _reached(structure, dict.fromkeys(some, True))
            if state is not None:
                found.append((some, state))
        if found:
            break
    if len(found) != 1:
        return structure
    (some, state), scene = found[0], structure.scene
    sketch = dict(scene.sketch)
    for k in some:
        sketch |= new_places(structure, k, links_of(structure.elements[k]), state)
    return analyse(replace(scene, sketch=sketch))


def _elements(structure: Structure) -> Iterator[tuple[int, Dyad]]:
    """The dyads before the first larger group, and before anything that rolls."""
    for i, element in enumerate(structure.elements):
        if isinstance(element, Cluster) or (isinstance(element, Driven) and isinstance(element.driver, Rolled)):
            return
        if isinstance(element, Dyad):
            yield i, element


def _free_guides(structure: Structure) -> list[int]:
    """Dyads of a slider on a bar, which nothing tells how to lie, and on which something hangs that may not reach."""
    scene, told = structure.scene, {*structure.scene.sketch, *structure.scene.drawn}
    dyads = [*_elements(structure)]
    found = []
    for i, dyad in dyads:
        own = {p for name in dyad.links for p in structure.links[name].points}
        known = {p for j in range(i) for n in links_of(structure.elements[j]) for p in structure.links[n].points}
        fresh = own - known - set(scene.frame.points)
        if dyad.is_slider_on_bar and isinstance(dyad.inner, Slide) and fresh and not fresh & told and dyads[-1][0] > i:
            found.append(i)
    return found[:MOST]


def _reached(structure: Structure, turned: Mapping[int, bool]) -> State | None:
    """Everything up to the last dyad, guides turned as they are told; None where something does not reach."""
    drive = Drive.at(structure, own_values(structure.scene)[None])
    forms: dict[int, Array] = {}
    state: State | None = None
    for i, dyad in _elements(structure):
        both = []
        for sign in (1.0, -1.0):
            both.append(positions(structure, drive, {**forms, i: np.array([sign])}, i + 1, rates=False))
        solved = both[0].groups[i]
        assert isinstance(solved, DyadSolution)
        if not dyad.is_two_lines and not solved.discriminant[0] >= -TOUCH:
            return None
        try:
            index = 0 if dyad.is_two_lines else pick(
                structure.scene, dyad.links, [new_places(structure, i, dyad.links, one) for one in both], 0
            ).index  # fmt: skip
        except GraphkinError:
            return None
        index = 1 - index if turned.get(i) else index
        forms[i], state = np.array([(1.0, -1.0)[index]]), both[index]
    return state


STANDS = 1e-9  # of the size a radian: a point that moves by less stands still


def at_given_speed(structure: Structure) -> Structure:
    """The structure of the same scene with the rate of its driver, at which a point has its given speed.

    With the driver at one radian a second the point has the velocity v; at the speed asked the driver turns speed / |v|
    times as fast.

    Raises
    ------
    Unsolvable : "dead point": the point stands still here however fast the driver turns, or a group is at a dead point
    SceneError : a group has several assemblies and no sketch tells which
    """
    scene = structure.scene
    driver = scene.drivers[0]
    assert isinstance(driver, AngleDriver)
    assert driver.given_speed is not None
    name, speed = driver.given_speed
    own = own_values(scene)[None]
    forms = {i: f[None] for i, f in choose_forms(structure).items()}
    state = positions(structure, Drive(own, np.ones((1, 1)), np.zeros((1, 1))), forms, sure=False)
    ref = PointRef(name)
    holder = next(link for link in scene.holders[ref.point] if link != scene.frame.name)
    pose = state.poses[holder]
    arm = pose.u * structure.links[holder].points[name]
    once = abs(complex(np.ravel(pose.v + 1j * pose.omega * arm)[0]))
    if not np.isfinite(once) or once <= STANDS * scene.size or once >= scene.size / SINGULAR:
        said = "has no finite speed here" if once > STANDS * scene.size else "stands still here, however fast it turns"
        raise Unsolvable("dead point", Problem(f'driver "{driver.key}": {name}', said, "give omega, or another place"))
    return analyse(replace(scene, drivers=(replace(driver, omega=speed / once, given_speed=None),)))
