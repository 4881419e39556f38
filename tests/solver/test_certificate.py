"""Larger groups are given out with a certificate, or refused by name."""

from __future__ import annotations

import numpy as np
import pytest

from graphkin.scene import mechanism_of_text
from graphkin.solver import driver_range, solve, structure_of
from graphkin.solver.algebra import larger_groups as group
from graphkin.solver.algebra.pose import Drive
from graphkin.solver.compiled.engine import positions
from graphkin.solver.drivers import own_values
from graphkin.solver.path.assemblies import choose_modes
from tests import scenes


@pytest.mark.parametrize("text", [scenes.TRIAD, scenes.FLOATING, scenes.MOVED_PARALLELOGRAM])
def test_an_ordinary_position_is_certified_with_room_to_spare(text: str) -> None:
    structure = structure_of(mechanism_of_text(text, "scene"))
    modes = {i: f[None] for i, f in choose_modes(structure).items()}
    state = positions(structure, Drive.at(structure, own_values(structure.scene)[None]), modes)
    assert [g.certificate[0] < 1e-6 for g in state.groups.values()] == [True]


def test_what_is_no_certain_position_is_refused_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(group.GroupSolved, "certificate", property(lambda solved: np.full(len(solved.residual), 0.7)))
    motion = solve(mechanism_of_text(scenes.TRIAD, "scene"))
    assert "links 2, 3, 4, 5 are so near to their dead point" in motion.why[0]


@pytest.mark.parametrize("away", [1e-10, 1e-11])
def test_a_refused_group_is_said_to_be_so_far_from_its_dead_point(away: float) -> None:
    scene = mechanism_of_text(scenes.TRIAD, "scene")
    limit = float(driver_range(scene).value(np.array(driver_range(scene).ends))[1])
    motion = solve(scene, at={"1": limit - away})
    assert motion.status[0] == "dead point"
    said = float(motion.why[0].split(", about ")[1].removesuffix(" deg away"))
    assert np.degrees(away) == pytest.approx(said, rel=0.2)


def test_a_larger_group_stays_within_its_bound() -> None:
    # the same motion with the crank driven, where all is in closed form
    floating = solve(mechanism_of_text(scenes.FLOATING, "scene"), at={"2": np.radians(40)})
    crank = solve(
        mechanism_of_text(scenes.FOUR_BAR.replace("omega = 10\nalpha = -30", "omega = 1"), "scene"),
        at={"1": float(floating.angle("1")[0])},
    )
    ratio = crank.omega("3")[0] / crank.omega("2")[0]
    bound = floating.bound.omega[0] / abs(floating.omega("2")[0])
    assert abs(floating.omega("3")[0] / floating.omega("2")[0] - ratio) < 4 * bound


def test_the_assemblies_of_a_larger_group_have_different_words() -> None:
    own = "C = [110, 90]\nD = [200, 100]\nE = [130, 170]"
    other = "C = [95.28, 102.51]\nD = [184.18, 88.49]\nE = [135.81, 166.98]"
    words = {solve(mechanism_of_text(scenes.TRIAD.replace(own, s), "scene")).assembly[0] for s in (own, other)}
    assert len(words) == 2
