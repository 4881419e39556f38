"""What rolls, as its rates are found beside the polygons: by velocity plans, one for each train."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

from graphkin.construction.board import Instrument
from graphkin.construction.polygon_acts import PlanDrawn, PlanTravel, PlanTried
from graphkin.construction.sheet import Order
from graphkin.construction.steps import Act
from graphkin.errors import Problem, Unsolvable
from graphkin.structure import Structure, meshes_of
from graphkin.structure.model import Coordinate
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.construction.centre_lines import CentreLine, TrainPlan
    from graphkin.construction.train_plan import Travel, Turned

__all__ = ["Wheels"]


@dataclass(frozen=True)
class Wheels:
    """The trains of a mechanism on their lines of centres, and the plans drawn of them so far."""

    structure: Structure
    on: tuple[tuple[CentreLine, ...], ...]
    drawn: Mapping[tuple[Order, int], TrainPlan]

    @classmethod
    def of(cls, structure: Structure) -> Wheels:
        scene, links = structure.scene, structure.links
        here = [g for g in scene.gears if {*g.wheels, g.carrier} <= links.keys()]
        touching = [c for c in scene.contacts if {*c.links} <= links.keys()]
        meshes = meshes_of(scene, touching, here, links)
        if not meshes:
            return cls(structure, (), {})
        from graphkin.construction.centre_lines import centre_lines, trains

        ground = scene.frame.name
        return cls(structure, tuple(centre_lines(one, links, ground) for one in trains(meshes, ground)), {})

    def found(
        self, order: Order, coordinate: Coordinate, rates: Mapping[str, float], travel: Travel, turns: list[Turned],
        hand: Instrument,
    ) -> tuple[Wheels, float, float]:  # fmt: skip
        """These wheels with the plan that leads to a rate (rad/s, rad/s2) or the speed of a slide (m/s, m/s2), that
        value, and the length read for it (mm).

        Raises
        ------
        Unsolvable : "not drawn": no plan leads to it
        """
        kind, name = coordinate
        alike = self._alike(name) if kind == "angle" else {name}
        for k, on in enumerate(self.on):
            own = {n for line in on for n in line.links}
            slides = {m.slide for line in on for m in line.meshes}
            inside = sorted(alike & (own if kind == "angle" else slides), key=lambda n: n != name)
            if not inside:
                continue
            plan = self.drawn.get((order, k))
            wanted: tuple[list[str], list[str]] = (inside[:1], []) if kind == "angle" else ([], inside[:1])
            if plan is None or not _leads(plan, wanted):
                units = self.structure.scene.units.rates.metres
                ground = self.structure.scene.frame.name
                from graphkin.construction.train_plan import train_plan

                plan = train_plan(order, on, rates, travel, turns, ground, wanted, units, hand)
                if plan is None:
                    continue
            made = replace(self, drawn={**self.drawn, (order, k): plan})
            if kind == "travel":
                value, mm = plan.travels[inside[0]]
                return made, value, abs(mm)
            line = plan.line(inside[0])
            assert line is not None
            return made, line.rate, abs(line.foot)
        raise Unsolvable(
            "not drawn", Problem(Phrase("link of name", name=name), Phrase("no velocity plan leads to what rolls here"))
        )

    def _alike(self, name: str) -> set[str]:
        """Links that turn as one does, because they slide on each other."""
        alike, grown = {name}, True
        while grown:
            more = {n for s in self.structure.slides if {s.a, s.b} & alike for n in (s.a, s.b)} - alike
            alike, grown = alike | more, bool(more)
        return alike

    def acts(self, before: Wheels, order: Order) -> Iterator[Act]:
        """What was drawn since, as acts."""
        for key, plan in self.drawn.items():
            if key[0] != order or before.drawn.get(key) is plan:
                continue
            had = before.drawn.get(key)
            old = {(one.link, one.on) for one in had.lines} if had else set()
            rate: Literal["omega", "alpha"] = "omega" if order == "velocity" else "alpha"
            named = self.structure.scene.by_name
            if plan.trial is not None:
                yield PlanTried(rate, plan.trial.links, plan.trial.assumed, plan.trial.apart, plan.trial.found)
            for one in plan.lines:
                if (one.link, one.on) not in old and one.link in named:
                    yield PlanDrawn(rate, one.link, one.by, one.rate_known, abs(one.foot), plan.scales.rate, one.rate)
            new = {k: v for k, v in plan.travels.items() if had is None or k not in had.travels}
            for slide, (value, mm) in new.items():
                yield PlanTravel(rate, slide, abs(mm), plan.scales.speed, value)


def _leads(plan: TrainPlan, wanted: tuple[list[str], list[str]]) -> bool:
    links, slides = wanted
    return all(plan.line(n) is not None for n in links) and all(key in plan.travels for key in slides)
