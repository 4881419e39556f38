"""A line of a larger group's construction drawn a tenth of a degree off: whichever it is, the check fails."""

from __future__ import annotations

import cmath
import math
from typing import Any

import pytest

import graphkin
from graphkin import solver
from graphkin.checking.readings import read_off
from graphkin.construction import OwnValues, Plan, draft, execute, plan
from graphkin.construction.board.steps import Ray, TrialPositions
from graphkin.construction.polygons.polygons import Polygons
from graphkin.construction.position import reduced_mechanism
from graphkin.construction.position.links_on_paper import PlacedLinks
from graphkin.construction.position.reduced_mechanism import RemovedConstraint
from graphkin.errors import SceneError
from graphkin.plane import cross
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol
from tests.construction.test_contours import FOUR_BAR, ON_A_GUIDE, TURNED_ALIKE
from tests.construction.test_groups import (
    BARE,
    CONTOUR,
    SLIDING,
    UNBARRED,
    WELDED,
    driven_inside,
    parallel_legs,
    two_plates,
)

OFF = math.radians(0.1)
TURNED = cmath.rect(1.0, OFF)
POLYGONS: dict[str, Any] = {
    "special point": "triad-slider", "several special points": "single-flier",
    "special point, cylinder": "loader-cylinder",
    "special point, driven inside": driven_inside("guide of the plate in a swivelling block"),
    "special point of two links": CONTOUR, "two links, none with points": SLIDING,
    "special point at infinity": parallel_legs(False), "special point at infinity, moving": parallel_legs(True),
    "no special point but at infinity": two_plates(False),
    "contour": FOUR_BAR, "contour that cannot turn": ON_A_GUIDE,
    "contour without bars": BARE, "contour with a driven hinge": WELDED, "special point carried over": TURNED_ALIKE,
    "special points without bars": UNBARRED,
    "trial polygons": "contour-four-bars", "trial polygons of an eight-bar": "double-butterfly",
}


def wrong(planned: Plan, motion: solver.Motion, own_values: OwnValues) -> set[str]:
    largest: dict[str, float] = {}
    off: dict[str, float] = {}
    for reading in read_off(execute(planned, own_values=own_values)):
        exact, kind = complex(motion.value(reading.symbol)[0]), reading.symbol.kind[0]
        largest[kind] = max(largest.get(kind, 0.0), abs(exact))
        off[str(reading.symbol)] = abs(reading.value - exact)
    return {symbol for symbol, error in off.items() if error > 1e-9 * largest[symbol[0]]}


@pytest.mark.parametrize("name", POLYGONS)
def test_each_line_of_a_group_turned_by_a_tenth_of_a_degree_makes_readings_wrong(name: str) -> None:
    scene = mechanism_of(POLYGONS[name])
    planned, motion, lines = plan(scene), solver.solve(scene), list[Symbol]()

    def noted(symbol: Symbol, along: complex) -> complex:
        lines.append(symbol)
        return along

    sheet = execute(planned, own_values=OwnValues(line=noted))
    rays = [s for step in sheet.steps for s in step.strokes if isinstance(s, Ray)]
    # a line that only leads back to where it begins may lie as it likes
    still = {ray.symbol for ray in rays if ray.to is not None and abs(ray.to - ray.through) < 1e-9}
    assert set() == wrong(planned, motion, OwnValues())
    unseen = {
        str(one) for one in lines
        if not wrong(
            planned, motion, OwnValues(line=lambda symbol, way, one=one: way * TURNED if symbol == one else way)
        )
    }
    assert unseen <= set(map(str, still))
    assert len(unseen) < len(lines) / 3


@pytest.mark.parametrize("name", ["special point", "contour", "special point at infinity, moving", "trial polygons"])
def test_check_fails_where_a_line_is_turned_by_a_tenth_of_a_degree(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    begun = Polygons.begun
    first: list[Symbol] = []

    def line(symbol: Symbol, along: complex) -> complex:
        first.append(symbol)
        return along * TURNED if symbol == first[0] else along

    monkeypatch.setattr(Polygons, "begun", lambda *args: begun(*args[:4], OwnValues(line=line)))
    assert not graphkin.check(POLYGONS[name]).ok


ARCS = ["triad-slider", "single-flier", "double-butterfly", "contour-four-bars", "loader-cylinder"]


@pytest.mark.parametrize("name", ARCS)
def test_check_fails_where_the_arc_that_trial_positions_meet_lies_a_tenth_of_a_degree_off(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    steps = draft(mechanism_of(name)).steps
    (arc,) = (step.missed[0] for step in steps if isinstance(step, TrialPositions) and step.missed)
    assert "bar" == arc.kind
    hinges = RemovedConstraint._hinges

    def turned(self: RemovedConstraint, paper: PlacedLinks) -> list[tuple[complex, complex]]:
        places = zip(self.ends, hinges(self, paper), strict=True)
        return [(own, at * (TURNED if point == arc.names[0] else 1)) for (point, _), (own, at) in places]

    monkeypatch.setattr(RemovedConstraint, "_hinges", turned)
    assert not agrees(name)


def agrees(scene: str) -> bool:
    """Whether a scene is drawn as it is computed, and as the points lie of which the problem says where."""
    try:
        return bool(graphkin.check(scene).ok)
    except SceneError as refused:
        assert "what is given twice must agree" in str(refused)
        return False


@pytest.mark.parametrize("scene", [BARE, SLIDING], ids=["guides missed", "an angle missed"])
def test_check_fails_where_the_guide_that_trial_positions_meet_is_turned_by_a_tenth_of_a_degree(
    scene: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    gap = RemovedConstraint.gap
    monkeypatch.setattr(reduced_mechanism, "cross", lambda along, way: cross(along * TURNED, way))
    monkeypatch.setattr(RemovedConstraint, "gap", lambda self, *args: gap(self, *args) + OFF * self.is_angle)
    assert not graphkin.check(scene).ok
