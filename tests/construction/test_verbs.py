"""A verb of the hand that errs by a tenth of a degree or by a thousandth is seen in the readings, wherever it draws: in
force polygons and levers, plans of trains, cams by inversion, and syntheses."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import pytest

import graphkin
from graphkin.construction import draft, trains
from graphkin.construction.board.instruments import Instrument
from graphkin.construction.cam_sheet import division
from graphkin.construction.forces import force_readings, force_scales, with_forces
from graphkin.construction.synthesis import construct
from graphkin.construction.tasks import measured
from graphkin.scene import mechanism_of
from graphkin.scene.designs import design_of, designs
from tests.construction.test_trains import TRAINS
from tests.solver.test_forces import loaded

TURNED = cmath.rect(1.0, math.radians(0.1))
LONGER = 1.001
ASIDE = 0.1 + 0.1j  # mm, from point to point
SEEN = 1e-9  # of the largest reading: what is off by more fails the check
Values = Mapping[object, complex]


@dataclass(eq=False)
class OneVerbErrs(Instrument):
    """Hands that err in one verb, always by the same."""

    errs_in: str = ""
    used: set[str] = field(default_factory=set)

    def _turned(self, verb: str, along: complex) -> complex:
        self.used.add(verb)
        return along * TURNED if verb == self.errs_in else along

    def _longer(self, verb: str, mm: float) -> float:
        self.used.add(verb)
        return mm * LONGER if verb == self.errs_in else mm

    def direction(self, along: complex) -> complex:
        return self._turned("direction", along)

    def angle(self, along: complex) -> complex:
        return self._turned("angle", along)

    def read_direction(self, along: complex) -> complex:
        return self._turned("read direction", along)

    def length(self, mm: float) -> float:
        return self._longer("length", mm)

    def compass(self, mm: float) -> float:
        return self._longer("compass", mm)

    def read(self, mm: float) -> float:
        return self._longer("read", mm)

    def point(self, at: complex) -> complex:
        self.used.add("point")
        self.acts += 1  # a point like all others would only move them together
        return at + self.acts * ASIDE if self.errs_in == "point" else at


def unseen(draw: Callable[[Instrument], Values]) -> set[str]:
    """The verbs of a drawing whose error no reading shows."""
    hand = OneVerbErrs()
    right = draw(hand)
    most = max(map(abs, right.values()))

    def shown(wrong: Values) -> bool:
        return any(abs(wrong[name] - value) > SEEN * most for name, value in right.items())

    assert hand.used
    return {verb for verb in hand.used if not shown(draw(OneVerbErrs(errs_in=verb)))}


@pytest.mark.parametrize("scene", [
    "boom-lifted", "engine-gas-force", "rocker-return-spring", "shaper-forces", "sine-mechanism-forces",
    "toggle-press-force", loaded(graphkin.read("double-butterfly").to_dict(), 5),
])
def test_in_forces(scene):
    sheet = draft(mechanism_of(scene))
    scales = force_scales(sheet)
    assert set() == unseen(
        lambda hand: {r.symbol: r.value for r in force_readings(with_forces(sheet, hand, scales), hand)}
    )


@pytest.mark.parametrize("name", TRAINS)
def test_in_plans_of_trains(name, monkeypatch):
    scene, drawn_by = mechanism_of(TRAINS[name][0]), trains.train_plan

    def rates(hand: Instrument) -> Values:
        monkeypatch.setattr(trains, "train_plan", lambda plan, wanted, units, _: drawn_by(plan, wanted, units, hand))
        found = draft(scene).rates.items()
        return {(kind, link): rate.value for kind, of_links in found for link, rate in of_links.items()}

    assert set() == unseen(rates)


@pytest.mark.parametrize("name", ["cam-offset-roller", "cam-swinging-roller", "cam-flat-face"])
def test_in_cams(name):
    (cam,) = mechanism_of(name).cams

    def follower(hand: Instrument) -> Values:
        drawn = division(cam, math.radians(40.0), 1e3, hand)
        return {name: getattr(drawn, name) for name in ("point", "contact", "normal", "lift")}

    assert set() == unseen(follower)


@pytest.mark.parametrize("name", designs())
def test_in_syntheses(name):
    task = design_of(name).task
    scale = max(measured(construct(task)).values()) / 100.0
    given = {"compass"} if task.kind == "guide-bar" else set()  # takes the rod, whose length is no result
    assert given == unseen(lambda hand: measured(construct(task, scale, hand)))
