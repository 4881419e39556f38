"""Driven triangles drawn with one of their links held still, as if it were the frame.

What is found of the other link there, its place and how it moves, is the same whatever the held one does: it is carried
over to the mechanism as a driver at their common pair, and what is left of the group are dyads.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

from graphkin.construction.assembly import assembly_at
from graphkin.construction.elements import draw_element
from graphkin.construction.instruments import EXACT
from graphkin.construction.links_on_paper import (
    PlacedLinks,
    Pose,
    Poses,
    assembled,
    drive,
    meant,
    meet,
    reading,
    start_board,
    travel,
)
from graphkin.construction.polygons import Polygons
from graphkin.construction.position import draw_position, place
from graphkin.construction.scales import Scales
from graphkin.construction.sheet import Board
from graphkin.construction.steps import DIAGRAMS, ORDERS, Step
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import dot
from graphkin.scene.model import Driver, Mechanism
from graphkin.scene.symbol import PointRef
from graphkin.structure import Driven, DrivenTriangle, Dyad, Element, LargerGroup, Structure, analyse, pick, without
from graphkin.words import Phrase

__all__ = ["Inversion", "carried_over", "drawn_apart", "inversions_of", "opened_at_triangles", "own_assembly"]

FITS = 1e-6  # of the size: so well the slide must have its travel in an assembly


@dataclass(frozen=True)
class Inversion:
    """A driven triangle with its held link for a frame."""

    triangle: DrivenTriangle
    structure: Structure

    @property
    def key(self) -> str:
        """Of the stand-in at the common pair."""
        return self.triangle.equivalent.key

    def branch(self, own: Mapping[str, float], values: Mapping[str, float], branch: int) -> int:
        """The assembly of the triangle at some driver values, followed from the scene's own."""
        key = self.triangle.driver.key
        start = place(self.structure, self.structure.elements, 1.0 / self.structure.scene.size, own, {0: branch})
        near = {key: own[key]}, start.paper.poses
        return assembly_at(self.structure, self.structure.elements, {key: values[key]}, near)[0][0]

    def value(self, values: Mapping[str, float], branch: int) -> float:
        """The stand-in's value (rad, m) as exact hands find it.  Raises Unsolvable where the triangle cannot be."""
        mm = 1.0 / self.structure.scene.size
        return self.read(place(self.structure, self.structure.elements, mm, values, {0: branch}).paper)

    def near(self, before: float, value: float) -> float:
        """A value of the stand-in nearest to another: angles but for whole turns."""
        turns = self.triangle.equivalent.turns
        return before + math.remainder(value - before, math.tau) if turns else value

    def read(self, paper: PlacedLinks) -> float:
        """The stand-in's value (rad, m) off the links as they lie."""
        return reading(self.structure, self.triangle.equivalent, paper.poses, paper.mm)


def opened_at_triangles(structure: Structure) -> Structure:
    """A structure with groups that driven triangles turn into dyads in their parts; itself where there are none."""
    elements: list[Element] = []
    instead: dict[Driver, Driver] = {}
    for e in structure.elements:
        if isinstance(e, LargerGroup) and e.parts:
            elements += e.parts
            instead |= {t.driver: t.equivalent for t in e.triangles}
        else:
            elements.append(e)
    if not instead:
        return structure
    scene = structure.scene
    drivers = tuple(instead.get(d, d) for d in scene.drivers)
    return replace(structure, scene=replace(scene, drivers=drivers), elements=tuple(elements))


def inversions_of(structure: Structure) -> tuple[Inversion, ...]:
    """The driven triangles of a structure, in the order in which their groups are drawn."""
    triangles = (triangle for group in structure.larger_groups if group.parts for triangle in group.triangles)
    return tuple(Inversion(t, analyse(_held(structure.scene, t))) for t in triangles)


def _held(scene: Mechanism, triangle: DrivenTriangle) -> Mechanism:
    """The links of a triangle alone, the held one for a frame."""
    alone = without(scene, {link.name for link in scene.links} - {triangle.held, *triangle.links})
    links = tuple(link for link in alone.links if link.name != triangle.held)
    frame = scene.by_name[triangle.held]
    return replace(alone, frame=frame, links=links, drivers=(triangle.driver,), sketch={}, drawn={})


@dataclass(frozen=True)
class _Way:
    """One assembly of a group: that of each triangle, the driver values with the stand-ins', and the links."""

    triangles: tuple[int, ...]
    values: Mapping[str, float]
    poses: Mapping[str, Pose]


def own_assembly(
    structure: Structure,
    opened: Structure,
    elements: Sequence[Driven | Dyad],
    inversions: Sequence[Inversion],
    own: Mapping[str, float],
) -> tuple[dict[str, int], dict[str, float], Poses]:
    """Which assembly a scene with driven triangles means at its own position.

    Returns
    -------
    that of each triangle by the key of its stand-in, all driver values with those of the stand-ins, and where the links
    lie with the mechanism of size 1

    Raises
    ------
    Unsolvable : "not assembled"
    SceneError : a group has several assemblies and no sketch says which is meant
    """
    paper = start_board(opened, 1.0 / structure.scene.size, own)
    taken: dict[str, int] = {}
    i = 0
    while i < len(elements):
        group = next((e for e in structure.larger_groups if elements[i] in e.parts), None)
        if group is None:
            assembled(paper, elements[i : i + 1], lambda _, dyad: meant(opened, paper, dyad))  # type: ignore[arg-type]
            i += 1
            continue
        run = [j for j in range(i, len(elements)) if elements[j] in group.parts]
        mine = [v for v in inversions if v.triangle in group.triangles]
        found = list(_ways(paper, elements, run, mine))
        if not found:
            names = ", ".join(group.links)
            raise Unsolvable(
                "not assembled",
                Problem(Phrase("links", links=names), Phrase("no assembly of the group fits together here")),
            )
        index = pick(structure.scene, group.links, [paper.fresh(way.poses) for way in found], None).index
        way = found[index]
        taken.update({v.key: branch for v, branch in zip(mine, way.triangles, strict=True)})
        paper.values = way.values
        paper.poses.update(way.poses)
        i = run[-1] + 1
    return taken, dict(paper.values), dict(paper.poses)


def _ways(
    paper: PlacedLinks, elements: Sequence[Driven | Dyad], run: Sequence[int], inversions: Sequence[Inversion]
) -> Iterator[_Way]:
    """Every assembly of the dyads of a group and of its triangles."""
    for branches in product((0, 1), repeat=len(inversions)):
        try:
            given = {v.key: v.value(paper.values, branch) for v, branch in zip(inversions, branches, strict=True)}
        except Unsolvable:
            continue
        values = {**paper.values, **given}
        begun = PlacedLinks(paper.links, paper.mm, values, dict(paper.poses), EXACT)
        for poses in _assembled(begun, [elements[i] for i in run]):
            if all(_has_its_travel(begun, v, poses) for v in inversions):
                yield _Way(branches, values, poses)


def _assembled(paper: PlacedLinks, elements: Sequence[Driven | Dyad]) -> Iterator[dict[str, Pose]]:
    """The links in every assembly of the dyads."""
    if not elements:
        yield {}
        return
    element, *left = elements
    if isinstance(element, Driven):
        several: Sequence[Poses] = ({element.link: drive(paper, element)[0]},)
    else:
        several = meet(paper, element).poses
    for poses in several:
        further = PlacedLinks(paper.links, paper.mm, paper.values, {**paper.poses, **poses})
        for rest in _assembled(further, left):
            yield {**poses, **rest}


def _has_its_travel(paper: PlacedLinks, inversion: Inversion, poses: Mapping[str, Pose]) -> bool:
    """Whether the driven slide itself stands as it is given: drawn last, it may also point the other way."""
    slide = inversion.structure.slide(inversion.triangle.driver.key)
    if slide.a not in poses or slide.b not in poses:
        return True
    return abs(travel(slide, poses, paper.mm) - paper.values[slide.key] * paper.mm) < FITS


# -- driven triangles, drawn apart -------------------------------------------------------------------------------------


def drawn_apart(
    board: Board, inversion: Inversion, scales: Scales, values: Mapping[str, float], branch: int
) -> tuple[float, float, float]:
    """The triangle on a board of its own, with its two polygons, which stand on that of the mechanism as drawn with
    a link held still; what it gives at its common pair: value, rate and second rate (SI)."""
    apart, structure = Board(board.instrument), inversion.structure
    elements = [*structure.dyads.values()]
    position = place(structure, elements, 1.0 / scales.length, values, {0: branch}, board.instrument)
    draw_position(apart, structure, elements, position, {0: branch})
    apart.causes[:] = position.causes
    polygons = Polygons(apart, structure, position.paper, scales)
    for order in ORDERS:
        draw_element(polygons, order, elements[0])
    board.causes += apart.causes
    board.held_still += apart.steps
    return inversion.read(position.paper), *_rates_apart(inversion, polygons)


def carried_over(t: DrivenTriangle, found: Sequence[float]) -> Iterator[Step]:
    """What is carried over from a triangle to each diagram: value, rate and second rate (SI) at its common pair."""
    kinds = ("angle", "omega", "alpha") if t.pair.turns else ("travel", "velocity", "acceleration")
    for diagram, kind, value in zip(DIAGRAMS, kinds, found, strict=True):
        yield Step("carry over", "held still", diagram, held=t.held, link=t.links[0], pairs=(t.driver.key,),
                   kind=kind, value=value)  # fmt: skip


def _rates_apart(inversion: Inversion, polygons: Polygons) -> tuple[float, float]:
    pair, other = inversion.triangle.pair, inversion.triangle.links[0]
    if pair.turns:
        return polygons.rates["velocity"][other].value, polygons.rates["acceleration"][other].value
    # the other link cannot turn on the held one: all its points move alike
    along = polygons.paper.poses[pair.b].axis * pair.guide.direction * (1 if pair.a == other else -1)
    points = [PointRef(p) for p in inversion.structure.links[other].points]
    end = next(ref for ref in points if ref in polygons.ends["velocity"])
    speed, push = (dot(along, polygons.ends[order][end]) * polygons.scales.of(order) for order in ORDERS)
    return speed, push
