"""Diagrams of any quantity that is asked for, each alone."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import graphkin


def test_what_is_asked_alone_is_drawn_alone() -> None:
    swept = graphkin.sweep("shaper-scheme-2", positions=12, find=["omega_4", "gamma_5-6"])
    assert ["diagram-omega_4", "diagram-gamma_5-6"] == list(swept.figures)


def test_the_table_holds_positions_too(tmp_path: Path) -> None:
    swept = graphkin.sweep("fourbar-150-500-300-400", tmp_path, positions=12, find=["gamma_2-3"], at=0)
    cosine = (500**2 + 300**2 - 250**2) / (2 * 500 * 300)
    assert math.degrees(math.acos(cosine)) == pytest.approx(swept.table["gamma_2-3"][0], rel=1e-12)


def test_the_least_transmission_angle_is_an_extreme_of_its_diagram() -> None:
    swept = graphkin.sweep("fourbar-150-500-300-400", positions=12, find=["gamma_2-3"])
    curve = swept.data["curves"]["gamma_2-3"]
    least = min(e["value"] for e in curve["extremes"])
    assert math.acos((500**2 + 300**2 - 250**2) / (2 * 500 * 300)) == pytest.approx(least, rel=1e-9)


def test_an_extreme_of_a_range_that_ends_is_local_where_the_quantity_goes_beyond_it() -> None:
    text = graphkin.sweep("sixbar-AE70", positions=12, find=["omega_2"]).text
    assert "local maximum" in text
    assert "; maximum" not in text
