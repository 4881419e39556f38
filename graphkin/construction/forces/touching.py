"""What touches, as pairs that carry the same forces at a drawn position: a sliding contact, or a cam with its follower,
is a pin that runs along the common tangent, rolling a pin at the contact, teeth a pin that runs along the line of
centres.

Forces ask for the position alone, so these stand at the contact itself, whatever replaces it in motion; without
friction a sliding contact pushes along the common normal, teeth along the tangent of the pitch circles in the pitch
point (what they also push apart the axes hold), and what rolls in both ways.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from graphkin.construction.forces.group_figure import NORMAL, TANGENT
from graphkin.construction.sheet import Pose, Sheet
from graphkin.construction.touching import Touch, Touching
from graphkin.scene.model import Mechanism, PinInSlot, PlacedGuide, PlacedLink
from graphkin.scene.symbol import PointRef
from graphkin.structure import Structure, analyse

__all__ = ["held_by_pairs"]


def held_by_pairs(sheet: Sheet) -> Sheet:
    """The same drawing with the structure in which forces are found; itself where nothing touches."""
    scene = sheet.scene
    if not (scene.contacts or scene.gears or scene.cams):
        return sheet
    made = _Pairs(sheet, {link.name: link for link in (scene.frame, *scene.links)})
    for touch in Touching(scene, 1.0 / sheet.scales.length, sheet.poses).touches():
        if touch.means == "rolls":
            for link in touch.links:
                made.with_point(link, touch.name, touch.at)
        elif touch.means == "meshes":
            made.guide(touch, NORMAL, touch.normal)
        else:
            made.guide(touch, TANGENT, 1j * touch.normal)
    return made.sheet_of(scene)


@dataclass
class _Pairs:
    """The links with the pairs that they get."""

    sheet: Sheet
    links: dict[str, PlacedLink]
    pins: list[PinInSlot] = field(default_factory=list)
    places: dict[PointRef, complex] = field(default_factory=dict)
    blocks: dict[str, Pose] = field(default_factory=dict)

    def guide(self, touch: Touch, line: str, along: complex) -> None:
        """A pin of the second link runs in a slot of the first."""
        first, second = touch.links
        self.with_point(second, touch.name, touch.at)
        pose, link = self.sheet.poses[first], self.links[first]
        slot = PlacedGuide(line, self._local(first, touch.at), along / pose.axis)
        while slot.name in link.guides:
            slot = replace(slot, name=slot.name + "'")
        self.links[first] = replace(link, guides={**link.guides, slot.name: slot})
        self.pins.append(PinInSlot(touch.name, second, first, slot.name))
        self.blocks[self.pins[-1].key] = Pose(touch.at, along)

    def _local(self, link: str, at: complex) -> complex:
        pose = self.sheet.poses[link]
        return (at - pose.origin) / pose.axis * self.sheet.scales.length

    def with_point(self, link: str, point: str, at: complex) -> None:
        own = self.links[link]
        self.links[link] = replace(own, points={**own.points, point: self._local(link, at)})
        self.places[PointRef(point)] = at

    def sheet_of(self, scene: Mechanism) -> Sheet:
        """The drawing with these pairs instead of what touches."""
        links = tuple(self.links[link.name] for link in (scene.instead_of or scene).links)  # without bars for cams
        other = replace(
            scene, frame=self.links[scene.frame.name], links=links, pins=(*_own_pins(scene), *self.pins), contacts=(),
            gears=(), cams=(), slots=(scene.instead_of or scene).slots,
        )  # fmt: skip
        structure: Structure = analyse(other)
        poses: Mapping[str, Pose] = {**self.sheet.poses, **self.blocks}
        return replace(self.sheet, structure=structure, poses=poses, points={**self.sheet.points, **self.places})


def _own_pins(scene: Mechanism) -> tuple[PinInSlot, ...]:
    """The pins in slots of a scene, those left out that stand for cams in its motion."""
    return (scene.instead_of or scene).pins
