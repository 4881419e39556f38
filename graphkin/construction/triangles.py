"""Driven triangles drawn with one of their links held still, as if it were the frame.

What is found of the other link there, its place and how it moves, is the same whatever the held one does: it is carried
over to the mechanism as a driver at their common pair, and what is left of the group are dyads.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

from graphkin.construction.elements import draw_element
from graphkin.construction.follow import Choices
from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.links_on_paper import PlacedLinks, Poses, reading, stuck, travel
from graphkin.construction.polygons import Polygons
from graphkin.construction.position import Assembly, assembly_at, each_assembly, own_position, place
from graphkin.construction.scales import Scales
from graphkin.construction.sheet import Board
from graphkin.construction.steps import DIAGRAMS, ORDERS, Step
from graphkin.errors import Unsolvable
from graphkin.plane import dot
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef
from graphkin.structure import Driven, DrivenTriangle, Dyad, Element, LargerGroup, Structure, analyse, pick, without

FITS = 1e-6  # of the size: so well the slide must have its travel in an assembly


@dataclass(frozen=True)
class Inversion:
    """A driven triangle with its held link for a frame, in one of its two assemblies (``branch``).

    What it gives is the value of the stand-in at the common pair of both links (rad, m).
    """

    triangle: DrivenTriangle
    structure: Structure
    branch: int = 0

    @property
    def key(self) -> str:
        """Of the stand-in at the common pair."""
        return self.triangle.equivalent.key

    def placed(
        self, values: Mapping[str, float], mm: float = 0.0, instrument: Instrument = EXACT, board: Board | None = None
    ) -> PlacedLinks:
        """The triangle at driver values; ``mm`` of paper for one m, else of its size; recorded on a board.  Raises
        Unsolvable."""
        mm, assembly = mm or 1.0 / self.structure.scene.size, Assembly(values, {}, {0: self.branch})
        return place(self.structure, self.structure.elements, mm, assembly, instrument, board)

    def followed(self, own: Mapping[str, float], values: Mapping[str, float]) -> Inversion:
        """The same in the assembly at some driver values, followed from the scene's own."""
        key, elements = self.triangle.driver.key, self.structure.elements
        near = Assembly({key: own[key]}, self.placed(own).poses)
        return replace(self, branch=assembly_at(self.structure, elements, {key: values[key]}, near).branches[0])

    def value(self, values: Mapping[str, float]) -> float:
        """The stand-in's value as exact hands find it.  Raises Unsolvable where the triangle cannot be."""
        return self.read(self.placed(values))

    def near(self, before: float, value: float) -> float:
        """A value of the stand-in nearest to another: angles but for whole turns."""
        turns = self.triangle.equivalent.turns
        return before + math.remainder(value - before, math.tau) if turns else value

    def read(self, paper: PlacedLinks) -> float:
        """The stand-in's value off the links as they lie."""
        return reading(self.structure, self.triangle.equivalent, paper.poses, paper.mm)

    def has_its_travel(self, paper: PlacedLinks) -> bool:
        """Whether the driven slide itself stands as it is given: drawn last, it may also point the other way."""
        slide = self.structure.slide(self.triangle.driver.key)
        if slide.a not in paper.poses or slide.b not in paper.poses:
            return True
        return abs(travel(slide, paper.poses, paper.mm) - paper.values[slide.key] * paper.mm) < FITS

    def drawn(self, board: Board, scales: Scales, values: Mapping[str, float]) -> tuple[float, float, float]:
        """The triangle on a board of its own, with its two polygons, which stand on that of the mechanism as drawn with
        a link held still; what it gives at its common pair: value, rate and second rate (SI)."""
        apart = Board(board.instrument)
        paper = self.placed(values, 1.0 / scales.length, board.instrument, apart)
        polygons = Polygons(apart, self.structure, paper, scales)
        for order in ORDERS:
            draw_element(polygons, order, *self.structure.dyads.values())
        board.causes += apart.causes
        board.held_still += apart.steps
        pair, other = self.triangle.pair, self.triangle.links[0]
        if pair.turns:
            rate, second = (polygons.rates[order][other].value for order in ORDERS)
        else:
            # the other link cannot turn on the held one: all its points move alike
            along = paper.poses[pair.b].axis * pair.guide.direction * (1 if pair.a == other else -1)
            points = map(PointRef, self.structure.links[other].points)
            end = next(ref for ref in points if ref in polygons.ends["velocity"])
            rate, second = (dot(along, polygons.ends[order][end]) * scales.of(order) for order in ORDERS)
        return self.read(paper), rate, second

    def carried_over(self, found: Sequence[float]) -> Iterator[Step]:
        """What is carried over to each diagram: value, rate and second rate (SI) at the common pair."""
        t = self.triangle
        kinds = ("angle", "omega", "alpha") if t.pair.turns else ("travel", "velocity", "acceleration")
        for diagram, kind, value in zip(DIAGRAMS, kinds, found, strict=True):
            yield Step("carry over", "held still", diagram, held=t.held, link=t.links[0], pairs=(t.driver.key,),
                       kind=kind, value=value)  # fmt: skip


def opened_at_triangles(structure: Structure) -> Structure:
    """A structure with groups that driven triangles turn into dyads in their parts; itself where there are none."""
    parted = [group for group in structure.larger_groups if group.parts]
    if not parted:
        return structure
    instead = {t.driver: t.equivalent for group in parted for t in group.triangles}
    elements: list[Element] = []
    for e in structure.elements:
        elements += e.parts if isinstance(e, LargerGroup) and e.parts else (e,)
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


def own_assembly(
    structure: Structure, elements: Sequence[Element], inversions: Sequence[Inversion]
) -> tuple[list[Inversion], Assembly]:
    """Which assembly a scene with driven triangles means at its own position.

    Returns
    -------
    the triangles in it, and where the links lie, at all driver values with those of the stand-ins

    Raises
    ------
    Unsolvable : "not assembled"
    SceneError : a group has several assemblies and no sketch says which is meant
    """
    taken: list[Inversion] = []

    def of_group(_: Choices, paper: PlacedLinks, group: LargerGroup) -> Poses:
        parts = [element for element in group.parts if element in elements]
        found = list(_ways(paper, parts, [v for v in inversions if v.triangle in group.triangles]))
        if not found:
            raise stuck("not assembled", group.links, "no assembly of the group fits together here")
        index = pick(structure.scene, group.links, [paper.fresh(poses) for _, _, poses in found], None)
        triangles, paper.values, poses = found[index]
        taken.extend(triangles)
        return poses

    paper = own_position(Choices(structure, ()), elements, of_group)
    return taken, Assembly(paper.values, paper.poses)


def _ways(
    paper: PlacedLinks, elements: Sequence[Driven | Dyad], inversions: Sequence[Inversion]
) -> Iterator[tuple[list[Inversion], Mapping[str, float], Poses]]:
    """Every assembly of the dyads of a group and of its triangles: these, the driver values with the stand-ins', and
    where the links of the group lie."""
    members = [name for element in elements for name in element.members]
    for branches in product((0, 1), repeat=len(inversions)):
        triangles = [replace(v, branch=branch) for v, branch in zip(inversions, branches, strict=True)]
        try:
            values = {**paper.values, **{v.key: v.value(paper.values) for v in triangles}}
        except Unsolvable:
            continue
        begun = PlacedLinks(paper.links, paper.mm, values, dict(paper.poses), EXACT)
        for _, drawn in each_assembly(begun, elements):
            if all(v.has_its_travel(drawn) for v in triangles):
                yield triangles, values, {name: drawn.poses[name] for name in members}
