"""Graphical differentiation and integration: chords give mean rates, what is drawn is what is stated."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import graphkin
from graphkin.scene import mechanism_of
from graphkin.solver import driver_range
from graphkin.study.graphical import graphical


def chords(scene: str, name: str, way: str):
    return graphical(driver_range(mechanism_of(scene)), name, way)


@pytest.mark.parametrize(("scene", "name"), [
    ("shaper-scheme-2", "s_6/1"), ("fourbar-150-500-300-400", "omega_3"), ("slotter-75-150", "x_C"),
    ("hydraulic-cylinder", "theta_2"),
])
def test_lines_parallel_to_the_chords_cut_off_the_mean_rates(scene: str, name: str) -> None:
    one = chords(scene, name, "derivative")
    assert one.means == pytest.approx(one.measured, abs=1e-9 * np.max(np.abs(one.means)))


def test_a_travel_integrated_from_its_velocity_comes_back_after_a_turn() -> None:
    one = chords("shaper-scheme-2", "v_6/1", "integral")
    assert 0.0 == pytest.approx(one.measured[-1], abs=1e-4 * np.ptp(one.measured))
    assert one.off < 0.005


def test_the_method_is_nearer_with_the_square_of_the_interval() -> None:
    # a sine: mean and middle differ by (h / 2)^2 / 6 of it
    one = chords("scotch-yoke", f"s_{mechanism_of('scotch-yoke').slidings[-1].key}", "derivative")
    h = 2 * np.pi / 24
    assert (h / 2) ** 2 / 6 == pytest.approx(one.off, rel=0.02)


def test_the_page_is_true_to_scale_and_parallel() -> None:
    page = graphkin.sweep("shaper-scheme-2", positions=2, differentiate=["s_6/1"]).figures["derivative-s_6-1"]
    svg = page.content("svg").decode()
    one = chords("shaper-scheme-2", "s_6/1", "derivative")
    k = 5
    (path,) = re.findall(rf'id="chord-{k + 1}">\s*<path d="M ([^"]*)"', svg)
    x1, y1, x2, y2 = map(float, path.replace("L", "").split())
    assert one.rays[k] / one.pole == pytest.approx(-(y2 - y1) / (x2 - x1), abs=1e-3)
    # of matplotlib's points 72 are an inch
    assert np.diff(one.x)[k] == pytest.approx((x2 - x1) / 72 * 25.4, abs=1e-3)


def test_files_hold_the_results_with_what_the_solver_says(tmp_path: Path) -> None:
    graphkin.sweep("shaper-scheme-2", out=tmp_path, positions=2, find=["v_C"], integrate=["omega_4"])
    table = (tmp_path / "integral-omega_4.csv").read_text("utf-8-sig").splitlines()
    assert ("driver_2 (deg),on_paper_mm (mm),theta_4 (deg),exact (deg),difference (deg)", 26) == (table[0], len(table))


def test_what_cannot_be_differentiated_is_said() -> None:
    with pytest.raises(graphkin.CallError, match="no quantity with a sign"):
        graphkin.sweep("shaper-scheme-2", positions=2, differentiate=["v_C"])
    with pytest.raises(graphkin.CallError, match="is a position"):
        graphkin.sweep("shaper-scheme-2", positions=2, integrate=["theta_4"])
