"""In which groups the forces are found: in those of the mechanism driven where it is balanced, last group first."""

from __future__ import annotations

from dataclasses import dataclass, replace

from graphkin.errors import Unsolvable
from graphkin.scene.cams import LawCam
from graphkin.scene.model import AngleDriver, AnyDriver, SlideDriver
from graphkin.scene.symbol import Symbol
from graphkin.structure import Cluster, Driven, Dyad, Element, Rolled, Structure, analyse

__all__ = ["BalanceForm", "balance_of", "force_groups"]


@dataclass(frozen=True)
class BalanceForm:
    """What balances at a driver: a moment (``along`` is 0) or a force on ``link`` at a place of its own axes (m), its
    opposite on ``other``; ``along`` is a direction in the frame, ``square`` one square to the link's own axis."""

    symbol: Symbol
    link: str
    other: str
    at: complex = 0j
    along: complex = 0j
    square: bool = False
    slide: str = ""

    @property
    def is_moment(self) -> bool:
        return self.symbol.kind == "M"


def balance_of(structure: Structure, driver: AnyDriver) -> BalanceForm:
    """What balances in place of a driver of a structure: what the scene says, else a moment where it turns and a force
    along the guide where it slides."""
    scene = structure.scene
    said = scene.loading.balance
    if said is not None:
        symbol = Symbol("M" if said.kind == "moment" else "F", link=said.link)
        along = 0j if said.kind == "moment" else said.turn
        return BalanceForm(symbol, said.link, scene.frame.name, said.at, along, said.square)
    if isinstance(driver, AngleDriver):
        return BalanceForm(Symbol("M", link=driver.link), driver.link, driver.relative_to)
    slide = structure.slide(driver.key)
    of = next((pin.of for pin in scene.pins if pin.key == driver.key), slide.a)
    return BalanceForm(Symbol("F", link=of), slide.a, slide.b, slide=slide.key)


def force_groups(structure: Structure) -> tuple[Element, ...]:
    """The groups of the mechanism, in the order of solution, were it driven where it is balanced: a force or a moment
    there leaves so many equations to each group as it has unknown forces.

    Where no driver stands for the balance, all moving links are one group.
    """
    scene = structure.scene
    said = scene.loading.balance
    if said is None or len(scene.drivers) != 1:
        return structure.elements
    own = scene.drivers[0]
    frame = scene.frame.name
    if isinstance(own, AngleDriver) and (own.link, own.relative_to) == (said.link, frame) and said.kind == "moment":
        return structure.elements
    slide = next((s for s in structure.slides if {s.a, s.b} == {said.link, frame}), None)
    driver: AnyDriver = AngleDriver(said.link, frame, 0.0, 0.0, 0.0)
    if said.kind == "force" and slide is not None:
        driver = SlideDriver(slide.key, 0.0, 0.0, 0.0)
    try:
        return analyse(replace(scene, drivers=(driver,))).elements
    except Unsolvable:
        members = tuple(name for name in structure.links if name != frame)
        real = tuple(link.name for link in scene.links if link.name in members)
        return (Cluster(members, (), (driver,), real, 3),)


def driver_of(element: Element) -> tuple[AnyDriver, ...]:
    """The drivers that act in a group."""
    if isinstance(element, Driven):
        return () if isinstance(element.driver, LawCam | Rolled) else (element.driver,)
    if isinstance(element, Dyad):
        return tuple(weld.driver for body in element.bodies for weld in body.welds)
    return element.drivers
