"""The loop of a wrong published angle shows its gap."""

from __future__ import annotations

import math
import re

import pytest

import graphkin

LENGTH = 34.4  # mm, of link 5 of the six-bar


def scene(off: float):
    links = graphkin.solve("sixbar-coupler-1A").data["positions"][0]["links"]
    angles = {f"theta_{n}": math.degrees(links[n]["angle"]) for n in ("2", "3", "5", "6")}
    printed = {"by": "computation", **angles, "theta_5": angles["theta_5"] + off}
    return graphkin.read("sixbar-coupler-1A").replace("printed", printed)


def test_a_wrong_angle_tells_the_loop_that_it_leaves_open_and_how_far() -> None:
    values = {v["symbol"]: v for v in graphkin.audit(scene(5.0)).data["values"]}
    gap = 2 * LENGTH * math.sin(math.radians(2.5))
    assert {"loop": "II", "gap": pytest.approx(gap, rel=1e-6)} == values["theta_5"]["loop_gap"]
    assert "loop_gap" not in values["theta_3"]


def test_the_figure_of_the_loops_draws_the_gap_to_scale() -> None:
    figure = graphkin.draw(scene(5.0), figures=["loops"]).figures["loops"]
    svg = figure.content("svg").decode()
    ends = re.search('id="gap-II"[^>]*><line([^>]*)/>', svg)
    x1, y1, x2, y2 = (float(re.search(f'{a}="([^"]*)"', ends[1])[1]) for a in ("x1", "y1", "x2", "y2"))
    scale = figure.metadata["scales"]["length"]
    assert 2 * LENGTH * math.sin(math.radians(2.5)) == pytest.approx(scale * math.hypot(x2 - x1, y2 - y1), abs=2e-3)


def test_right_angles_leave_nothing_open() -> None:
    assert "gap-" not in graphkin.draw(scene(0.0), figures=["loops"]).figures["loops"].content("svg").decode()
