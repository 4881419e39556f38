"""Wheels and links that move each other, on the drawing board."""

from __future__ import annotations

import pytest

from graphkin import check
from graphkin.construction import draft
from graphkin.construction.mechanism_acts import RollingStarts, TrialPositions
from graphkin.scene import mechanism_of
from tests.rolling_linkages import ROLLING_LINKAGES, wheel_at_its_rim


@pytest.mark.parametrize("made", ROLLING_LINKAGES)
@pytest.mark.parametrize("further", [0, 12])
def test_every_reading_agrees_with_the_solver(made, further):
    scene = made()
    driver = scene["driver"]
    result = check(scene, at=driver.get("angle", driver.get("travel")) + further)
    assert result.ok
    for row in result.report.rows:
        assert row.exact == pytest.approx(row.reading.value, rel=1e-8, abs=1e-8)


def test_the_start_is_laid_off_as_given_and_other_positions_are_found_by_trial():
    scene = mechanism_of(wheel_at_its_rim())
    acts = [[step.act for step in draft(scene, at).steps] for at in (None, {"1": 1.5})]
    assert [True, False] == [any(isinstance(a, RollingStarts) for a in told) for told in acts]
    assert [(), ("K",)] == [next((a.rolling for a in told if isinstance(a, TrialPositions)), ()) for told in acts]


def test_a_wheel_on_a_rail_is_drawn_as_turning_about_where_it_touches():
    sheet = draft(mechanism_of(wheel_at_its_rim()))
    first = sheet.equations[1]
    assert [["v_P"], ["v_P/K@3"], ["v_B", "v_P/B"]] == [[str(t.symbol) for t in side] for side in first.sides]
    assert ["special points"] == [group.way for group in sheet.groups]


def test_a_pencil_stays_within_its_predicted_uncertainty():
    assert check(wheel_at_its_rim(), at=70, instrument="pencil", seed=3).ok
