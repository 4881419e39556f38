"""Where what rolls and moves each other stands at the scene's own position: a driver for each rolling relation.

Rolling keeps a sum of angles and travels, but does not say which: at one position as many of them are given as there
are relations, by ``start``, by drawn or sketched points, else an angle of 0.  Without its rolling, and driven so, the
mechanism is one that stands at that position.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice, product

from graphkin.scene.model import AngleDriver, AnyDriver, Mechanism, SlideDriver
from graphkin.structure.model import Cluster, RollingRelation, Structure
from graphkin.structure.rolling import drawn_angle

__all__ = ["start_drivers", "unrolled"]

MOST = 200  # choices that are looked at


def unrolled(scene: Mechanism, names: Sequence[str]) -> Mechanism:
    """The scene in which some contacts slide that roll, and some wheels do not mesh."""
    contacts = (replace(c, rolling=False) if c.name in names else c for c in scene.contacts)
    return replace(
        scene,
        contacts=tuple(c for c in contacts if c.rolling or not c.carrier),
        gears=tuple(g for g in scene.gears if g.name not in names),
    )


def start_drivers(structure: Structure, groups: Sequence[Cluster]) -> Iterator[tuple[AnyDriver, ...]]:
    """A driver for each rolling relation of some groups, in the order of the groups: those that the scene tells first.
    Which of them hold the mechanism remains to be seen."""
    each = [_of(structure, group, relation) for group in groups for relation in group.rolling]
    taken = {d.key for d in structure.drivers}
    ranked = sorted(
        islice(product(*each), MOST**2),
        key=lambda chosen: (max(rank for rank, _ in chosen), sum(rank for rank, _ in chosen)),
    )
    for chosen in ranked[:MOST]:
        keys = {driver.key for _, driver in chosen}
        if len(keys) == len(chosen) and not keys & taken:
            yield tuple(driver for _, driver in chosen)


def _of(structure: Structure, group: Cluster, relation: RollingRelation) -> list[tuple[int, AnyDriver]]:
    """What can be given for a relation, and how well it is told: as the start of what rolls, of another link of the
    group, by a sketched bar, not at all."""
    scene, inside = structure.scene, set(group.members)
    found: list[tuple[int, AnyDriver]] = []
    others = [("angle", n) for n in group.links if ("angle", n) not in relation.terms and n in scene.starts]
    for coordinate in (*reversed(list(relation.terms)), *others):
        kind, name = coordinate
        if kind == "travel":
            slide = structure.slide(name)
            if name in scene.starts and inside & {slide.a, slide.b}:
                found.append((1, SlideDriver(name, scene.starts[name], 0.0, 0.0)))
        elif name in inside and name in scene.by_name:
            start = scene.starts.get(name)
            drawn = None if start is not None else drawn_angle(scene, structure.links[name])
            rank = (0 if coordinate in relation.terms else 1) if start is not None else 2 if drawn is not None else 3
            found.append((rank, _turned(structure, name, start if start is not None else drawn or 0.0)))
    return found


def _turned(structure: Structure, name: str, angle: float) -> AngleDriver:
    """A driver by which a link's own axis stands at an angle (rad): from a link to which it is pinned and that never
    turns, where there is one."""
    still = _still(structure)
    pinned = [n for names in structure.hinges.values() if name in names for n in names if n in still]
    frame = structure.scene.frame.name
    base = frame if frame in pinned or not pinned else pinned[0]
    return AngleDriver(name, base, cmath.phase(cmath.rect(1.0, angle) / still[base]), 0.0, 0.0)


def _still(structure: Structure) -> Mapping[str, complex]:
    """The own axes of links that slide on the frame, or on such links, and so never turn."""
    found = {structure.scene.frame.name: 1 + 0j}
    grown = True
    while grown:
        grown = False
        for s in structure.slides:
            turn = s.guide.direction * s.turn
            if s.b in found and s.a not in found:
                found[s.a], grown = found[s.b] * turn, True
            elif s.a in found and s.b not in found:
                found[s.b], grown = found[s.a] / turn, True
    return found
