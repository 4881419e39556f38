"""Joints and their forces by name: which link is named first, and what the force of a pin on a link is called.

Links at one point: the first that has it (the frame, or the link written first) is paired with each later one.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Slide, Structure

__all__ = ["JointNames", "opposite"]


def opposite(symbol: Symbol) -> Symbol:
    """The force or couple of the second link on the first."""
    return Symbol(symbol.kind, symbol.of, link=symbol.other, other=symbol.link)


@dataclass(frozen=True)
class JointNames:
    """The names of the joint forces of a mechanism.  The block of a pin in a slot has no name of its own: what it
    carries is the force between the link of the pin and the link of the slot."""

    structure: Structure

    @cached_property
    def blocks(self) -> Mapping[str, tuple[str, str]]:
        """For each block the link of its pin and that of its slot."""
        return {pin.key: (pin.of, pin.on) for pin in self.structure.scene.pins if pin.key in self.structure.links}

    @cached_property
    def holders(self) -> Mapping[str, tuple[str, ...]]:
        """The links that meet at each hinge, blocks left out."""
        return {p: tuple(n for n in names if n not in self.blocks) for p, names in self.structure.hinges.items()}

    @cached_property
    def _shared(self) -> Counter[frozenset[str]]:
        pairs = [frozenset((names[0], later)) for names in self.holders.values() for later in names[1:]]
        pairs += [frozenset((s.a, s.b)) for s in self.structure.slides if not s.slot]
        pairs += [frozenset(ends) for ends in self.blocks.values()]
        return Counter(pairs)

    def between(self, first: str, second: str, point: str | None, kind: str = "F") -> Symbol:
        """The force (couple) of one link on another at a joint."""
        several = point and self._shared[frozenset((first, second))] > 1
        return Symbol(kind, PointRef(point) if several and point else None, link=first, other=second)

    def of_pin(self, point: str, link: str) -> Symbol:
        """What the force of the pin at a point on a link is called."""
        if link in self.blocks:
            of, on = self.blocks[link]
            return self.between(of, on, point)
        names = self.holders[point]
        if link != names[0]:
            return self.between(names[0], link, point)
        if len(names) == 2:
            return self.between(names[1], link, point)
        block = [ends for ends in self.blocks.values() if ends[0] == link] if len(names) == 1 else []
        if len(block) == 1:
            return self.between(block[0][1], link, point)
        return Symbol("F", link=point, other=link)

    def of_slide(self, slide: Slide, kind: str = "F") -> Symbol:
        """The force (couple) of the guiding link on the sliding one."""
        if slide.slot:
            of, on = self.blocks[slide.key]
            return self.between(on, of, slide.pin, kind)
        return self.between(slide.b, slide.a, slide.pin, kind)

    def turning(self) -> Iterator[tuple[str, str, str]]:
        """Every turning pair: its point, the first link, the later one."""
        for point, names in self.holders.items():
            for later in names[1:]:
                yield point, names[0], later
