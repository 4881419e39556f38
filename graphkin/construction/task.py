"""What is to be drawn, before it is: the position, the assembly, and by which equation each group."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from graphkin.construction.inversion import Inversion
from graphkin.construction.net import TwoUnknowns
from graphkin.construction.sheet import ORDERS, Limits, Order, Sheet
from graphkin.scene.symbol import Symbol
from graphkin.structure import Cluster, Dyad, Element, Structure, links_of, needed
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.construction.group_plan import GroupPlan
    from graphkin.construction.group_position import GroupTrial

__all__ = ["Task"]


@dataclass(frozen=True)
class Task:
    """What is to be drawn, at which position, in which assembly, and by which equation for each dyad.

    ``opened`` is the structure with groups that driven triangles turn into dyads in their parts, ``triangles`` are
    these, each with its assembly; ``values`` are the drivers', those at the triangles' pairs included; ``limits`` are
    the limit positions of what is asked, on paper of the mechanism's size.  ``acting`` and ``growing`` as in `Sheet`.
    With ``touching`` sliding contacts are drawn themselves, not what replaces them.
    """

    structure: Structure
    opened: Structure
    asked: tuple[Symbol, ...]
    elements: tuple[Element, ...]
    values: Mapping[str, float]
    branches: Mapping[int, int]
    trials: Mapping[Cluster, GroupTrial]
    chains: Mapping[Dyad, TwoUnknowns]
    plans: Mapping[Cluster, GroupPlan]
    triangles: tuple[tuple[Inversion, int], ...]
    limits: Mapping[str, Limits]
    acting: Mapping[str, bool | None]
    growing: tuple[Sheet, ...]
    touching: bool = field(default=False, kw_only=True)

    @cached_property
    def drawn(self) -> Mapping[Order, tuple[Element, ...]]:
        """What each polygon needs for what is asked: accelerations only of what leads to accelerations."""
        pushes = [s for s in self.asked if s.measure in ("acceleration", "angular acceleration")]
        wanted = needed(self.opened, pushes) if pushes else []
        every = not self.asked or any(s.scope in ("force", "cycle") for s in self.asked)
        pushed = self.elements if every else tuple(e for e in self.elements if e in wanted)
        return {"velocity": self.elements, "acceleration": pushed}

    @cached_property
    def left_out(self) -> tuple[Phrase, ...]:
        """What nothing asked for needs."""
        wanted = needed(self.opened, self.asked)
        placed = {n for e in self.elements for n in links_of(e)}
        pushed = {n for e in self.drawn["acceleration"] for n in links_of(e)}
        gone = {n for e in self.opened.elements if e not in wanted for n in links_of(e)}
        names = [link.name for link in self.structure.scene.links]
        without = [n for n in names if n in gone], [n for n in names if n in placed - pushed]
        keys = "left out elements", "left out accelerations"
        return tuple(Phrase(key, (", ".join(links),)) for key, links in zip(keys, without, strict=True) if links)

    @property
    def in_order(self) -> Iterator[tuple[Order, Element]]:
        """What is drawn in the polygons, element by element."""
        for order in ORDERS:
            for element in self.drawn[order]:
                yield order, element
