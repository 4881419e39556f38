"""What is to be drawn for what is asked, and at which scales."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from graphkin.drafting.board import Board
from graphkin.drafting.chains import Chain
from graphkin.drafting.instrument import EXACT
from graphkin.drafting.plot import Order
from graphkin.drafting.polygons import Polygons
from graphkin.drafting.position import branches_at, place
from graphkin.drafting.scales import Room, chosen_scales
from graphkin.drafting.sheet import Scales
from graphkin.scene.model import AngleDriver, Scene
from graphkin.scene.symbol import Symbol
from graphkin.structure import Cluster, Driven, Dyad, Element, Structure, analyse, links_of, needed
from graphkin.words import Phrase

__all__ = ["ORDERS", "Plan", "plan"]

ORDERS: tuple[Order, ...] = ("velocity", "acceleration")


@dataclass(frozen=True)
class Plan:
    """What is to be drawn, at which position and scales, in which assembly, and by which equation for each dyad."""

    structure: Structure
    asked: tuple[Symbol, ...]
    elements: tuple[Driven | Dyad, ...]
    values: Mapping[str, float]
    branches: Mapping[int, int]
    scales: Scales
    stopped: Phrase | None
    chains: Mapping[Dyad, Chain] = field(default_factory=dict)

    @cached_property
    def drawn(self) -> Mapping[Order, tuple[Driven | Dyad, ...]]:
        """What each polygon needs for what is asked: accelerations only of what leads to accelerations."""
        return {order: _drawn(self.structure, self.elements, self.asked, order) for order in ORDERS}

    @cached_property
    def left_out(self) -> tuple[Phrase, ...]:
        """What nothing asked for needs."""
        wanted = needed(self.structure, self.asked)
        placed = {n for e in self.elements for n in links_of(e)}
        pushed = {n for e in self.drawn["acceleration"] for n in links_of(e)}
        gone = {n for e in self.structure.elements if e not in wanted for n in links_of(e)}
        names = [link.name for link in self.structure.scene.links]
        without = [n for n in names if n in gone], [n for n in names if n in placed - pushed]
        keys = "left out elements", "left out accelerations"
        return tuple(Phrase(key, (", ".join(links),)) for key, links in zip(keys, without, strict=True) if links)


def _drawn(
    structure: Structure, elements: Sequence[Driven | Dyad], asked: Sequence[Symbol], order: Order
) -> tuple[Driven | Dyad, ...]:
    if order == "velocity" or not asked:
        return tuple(elements)
    pushes = [s for s in asked if s.kind not in ("v", "omega")]
    wanted = needed(structure, pushes) if pushes else []
    return tuple(e for e in elements if e in wanted)


def plan(
    scene: Scene,
    at: Mapping[str, float] | None = None,
    find: Iterable[Symbol] | None = None,
    room: Room | None = None,
) -> Plan:
    """Decide what to draw; parameters and errors as for `draft`."""
    structure = analyse(scene)
    asked = tuple(scene.find if find is None else find)
    wanted = needed(structure, asked)
    elements = _drawable(wanted)
    values = {d.key: d.values[0] for d in scene.drivers} | dict(at or {})
    branches = branches_at(structure, elements, values)
    orders = {order: _drawn(structure, elements, asked, order) for order in ORDERS}
    trial = _trial(structure, orders, values, branches)
    scales = chosen_scales(trial, room)
    return Plan(structure, asked, tuple(elements), values, branches, scales, _stopped(wanted), trial.chains)


def _stopped(elements: Sequence[Element]) -> Phrase | None:
    """Which group compass and ruler cannot draw, and why."""
    for e in elements:
        if isinstance(e, Cluster):
            return Phrase("stopped", (", ".join(e.links), e.order))
    return None


def _drawable(elements: Sequence[Element]) -> list[Driven | Dyad]:
    """The elements that need no larger group."""
    lost: set[str] = set()
    kept: list[Driven | Dyad] = []
    for element in elements:
        if isinstance(element, Cluster):
            lost.update(element.members)
        elif lost & _leans_on(element):
            lost.update(links_of(element))
        else:
            kept.append(element)
    return kept


def _leans_on(element: Driven | Dyad) -> set[str]:
    if isinstance(element, Driven):
        names = {element.pair.a, element.pair.b}
        if isinstance(element.driver, AngleDriver):
            names |= {element.driver.link, element.driver.relative_to}
        return names
    return {n for pair in (element.outer_first, element.outer_second) for n in (pair.a, pair.b)}


def _trial(
    structure: Structure,
    drawn: Mapping[Order, Sequence[Driven | Dyad]],
    values: Mapping[str, float],
    branches: Mapping[int, int],
) -> Polygons:
    """Both polygons drawn once at any scale, to see how large they come out."""
    trial = Scales(structure.scene.size / 100.0, 1.0, 1.0)
    frame = place(structure, drawn["velocity"], 1.0 / trial.length, values, branches).frame
    polygons = Polygons(Board(EXACT), structure, frame, trial)
    for order in ORDERS:
        for element in drawn[order]:
            polygons.draw(order, element)
    return polygons
