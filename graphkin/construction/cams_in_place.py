"""The mechanism that is drawn in place of one with cams: what replaces each cam at this position, the assembly of the
other groups kept on the way to it."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from graphkin.construction.follow import Choices
from graphkin.construction.links_on_paper import PlacedLinks, Poses, travel
from graphkin.construction.position import assembly_at, own_position
from graphkin.construction.sheet import LimitPosition, Limits
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.cams import SwingingFollower
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.structure import Structure, analyse, part_of
from graphkin.structure.assembly import ways
from graphkin.structure.replacement import cams_replaced
from graphkin.words import Phrase

STEP = math.radians(3.0)


def cams_in_place(structure: Structure, values: Mapping[str, float], bars: bool = True) -> Structure:
    """What stands for a mechanism with cams at driver values (rad, m); with ``bars`` for rollers and edges, as far as
    they can, else pins on the pitch curves.

    Raises
    ------
    Unsolvable : a follower that does not come to its base circle, a position that cannot be assembled or reached
    """
    scene = structure.scene
    own = {d.key: d.values[0] for d in scene.drivers}
    if not structure.groups or structure.larger_groups:
        return analyse(_replaced(scene, values, {}, bars))
    first, goal = [own[d.key] for d in scene.drivers], [values[d.key] for d in scene.drivers]
    way = next(iter(ways(scene.drivers, first, goal)), goal)
    moved = zip(scene.drivers, first, way, strict=True)
    far = max((abs(b - a) / d.span(scene.size) for d, a, b in moved), default=0.0)
    count = math.ceil(far / STEP)
    seen: Mapping[str, complex] = {}
    for k in range(count):
        at = {d.key: a + (b - a) * k / count for d, a, b in zip(scene.drivers, first, way, strict=True)}
        structure = analyse(_replaced(scene, at, seen))
        paper, links = _placed(structure), structure.scene.links
        seen = {p: paper.point(link.name, p) / paper.mm for link in links for p in link.points}
    return analyse(_replaced(scene, values, seen, bars))


def _replaced(
    scene: Mechanism, values: Mapping[str, float], seen: Mapping[str, complex], bars: bool = False
) -> Mechanism:
    """The scene with all cams replaced; their angles come from the drivers, or are drawn."""
    turns: dict[str, float] = {}
    for cam in scene.cams:
        driver = next((d for d in scene.drivers if d.key == cam.link), None)
        if driver is not None and driver.turns_about(scene.frame.name):
            turns[cam.link] = values[driver.key]
        else:
            part = part_of(analyse(scene), [Symbol("theta", link=cam.link)])
            behind = analyse(_replaced(part, values, seen)) if part.cams else analyse(part)  # cams that move this one
            poses = _placed(behind).poses if part.cams else _moved_to(behind, values)
            turns[cam.link] = cmath.phase(poses[cam.link].axis)
    return replace(cams_replaced(scene, turns, values, seen, bars), starts=_rolled(scene, values))


def _moved_to(structure: Structure, values: Mapping[str, float]) -> Poses:
    """The links of a mechanism without cams, moved from its own position to driver values, on paper of its size."""
    return assembly_at(structure, structure.elements, {d.key: values[d.key] for d in structure.scene.drivers}).poses


def _rolled(scene: Mechanism, values: Mapping[str, float]) -> dict[str, float]:
    """Where what rolls stands at driver values (rad, m), by link or sliding pair; as far as no cam moves it."""
    names = {n for gear in scene.gears for n in gear.wheels} | {n for c in scene.contacts if c.rolling for n in c.links}
    names -= {scene.frame.name}
    if not names:
        return dict(scene.starts)
    part = part_of(analyse(scene), [Symbol("theta", link=name) for name in sorted(names)])
    if part.cams:
        return dict(scene.starts)
    structure = analyse(part)
    poses, mm = _moved_to(structure, values), 1.0 / part.size
    found = {name: cmath.phase(poses[name].axis) for name in names if name in poses}
    travels = {p.key: travel(structure.slide(p.key), poses, mm) / mm for p in part.slidings}
    return {**scene.starts, **found, **travels}


def _placed(structure: Structure) -> PlacedLinks:
    """A mechanism at its own driver values, on paper of its size."""
    return own_position(Choices(structure, structure.elements), structure.elements)


def follower_limits(structure: Structure, asked: Sequence[Symbol], values: Mapping[str, float]) -> dict[str, Limits]:
    """The limit positions of followers, on paper of the mechanism's size, as the law gives them, by the sliding pair or
    the link; of what stands still there for a while, the end of it.

    Raises
    ------
    Unsolvable : of what is no follower of the driven cam
    """
    whole = structure.scene.instead_of
    assert whole is not None
    found: dict[str, Limits] = {}
    for symbol in asked:
        if symbol.scope != "turn" or symbol.pair in found:
            continue
        cam = next((c for c in whole.cams if symbol.pair in (c.follower, getattr(c.motion, "pair", ""))), None)
        driver = whole.drivers[0]
        if cam is None or not driver.turns or (driver.link, driver.relative_to) != (
            cam.link, whole.frame.name
        ):  # fmt: skip
            said = Phrase("is drawn of followers of the driven cam"), Phrase("ask for s_ theta_ or d_ at single")
            raise Unsolvable("no whole turn", Problem(str(symbol), *said))
        ends = []
        for lift in (cam.law.least, cam.law.greatest):
            value = cam.leaves(lift, -1 if driver.rate < 0.0 else 1)
            there = {**values, driver.key: value}
            paper = _placed(cams_in_place(analyse(whole), there))
            ends.append(LimitPosition(value, dict(paper.poses)))
        backwards = isinstance(cam.motion, SwingingFollower) and cam.motion.side < 0
        low, high = ends[::-1] if backwards else ends
        swing = cam.law.greatest - cam.law.least
        found[symbol.pair] = Limits(low, high, swing)
    return found
