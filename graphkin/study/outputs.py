"""The points of a mechanism whose motion is looked at when methods are compared."""

from __future__ import annotations

from dataclasses import dataclass

from graphkin.scene.symbol import PointRef
from graphkin.structure import Structure

__all__ = ["Output", "outputs_of"]


@dataclass(frozen=True)
class Output:
    """A point of a link, or of ``link`` where it lies under that pin (not ``own``)."""

    point: str
    link: str
    own: bool = True

    @property
    def ref(self) -> PointRef:
        """How it is written in a symbol."""
        return PointRef(self.point) if self.own else PointRef(self.point, self.link)


def outputs_of(structure: Structure) -> tuple[Output, ...]:
    """Every moving point by the first moving link that has it, and the points of guides under sliding pins."""
    scene = structure.scene
    fixed = scene.frame.points
    found = [Output(p, link.name) for link in scene.links if not link.redundant for p in link.points if p not in fixed]
    firsts = {o.point: o for o in reversed(found)}
    unders = [
        Output(s.pin, s.b, False)
        for s in structure.slides
        if s.pin and s.b != scene.frame.name and s.b in scene.by_name and s.pin not in structure.links[s.b].points
    ]
    return (*dict.fromkeys(firsts[o.point] for o in found), *unders)
