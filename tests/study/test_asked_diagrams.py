"""Diagrams of any quantity that is asked for, each alone."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

import graphkin
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol
from graphkin.solver import driver_range
from graphkin.study.charts import DriverAxis
from graphkin.study.quantities import course_of


def test_what_is_asked_alone_is_drawn_alone() -> None:
    swept = graphkin.sweep("shaper-scheme-2", positions=12, find=["omega_4", "gamma_5-6"])
    assert ["diagram-omega_4", "diagram-gamma_5-6"] == list(swept.figures)


def test_the_table_holds_positions_too(tmp_path: Path) -> None:
    swept = graphkin.sweep("fourbar-150-500-300-400", out=tmp_path, positions=12, find=["gamma_2-3"], at=0)
    cosine = (500**2 + 300**2 - 250**2) / (2 * 500 * 300)
    assert math.degrees(math.acos(cosine)) == pytest.approx(swept.table["gamma_2-3"][0], rel=1e-12)


def test_the_least_transmission_angle_is_an_extreme_of_its_diagram() -> None:
    swept = graphkin.sweep("fourbar-150-500-300-400", positions=12, find=["gamma_2-3"])
    curve = swept.data["curves"]["gamma_2-3"]
    least = min(e["value"] for e in curve["extremes"])
    assert math.acos((500**2 + 300**2 - 250**2) / (2 * 500 * 300)) == pytest.approx(least, rel=1e-9)


def test_an_extreme_of_a_range_that_ends_is_local_where_the_quantity_goes_beyond_it() -> None:
    swept = graphkin.sweep("sixbar-AE70", positions=12, find=["omega_2"])
    assert "local maximum" in swept.text
    assert "; maximum" not in swept.text
    ended, turning = (sweep.data["curves"]["omega_2"]["extremes"]
                      for sweep in (swept, graphkin.sweep("fourbar-150-500-300-400", positions=2)))
    assert {True} == {extreme["local"] for extreme in ended if extreme["kind"] == "max"}
    assert [] == [extreme for extreme in turning if "local" in extreme]


def words_of(page) -> str:
    return " ".join(re.findall(">([^<>]+)</", page.content("svg").decode()))


def test_a_diagram_calls_no_local_extreme_a_maximum() -> None:
    words = words_of(graphkin.sweep("sixbar-AE70", positions=2, find=["omega_2"]).figures["diagram-omega_2"])
    assert (True, False) == ("local maximum" in words, re.search(r"(?<!local )maximum", words) is not None)
    assert "grows without bound" in words


def test_the_diagram_of_a_transmission_angle_shows_what_is_allowed() -> None:
    page = graphkin.sweep("fourbar-150-500-300-400", positions=2, find=["gamma_2-3"]).figures["diagram-gamma_2-3"]
    assert "usually allowed: ≥ 40°" in words_of(page)


def test_values_measured_elsewhere_lie_over_the_theory_that_they_are_held_against(tmp_path: Path) -> None:
    theory = graphkin.solve("shaper-scheme-2", at=30).data["positions"][0]["links"]["4"]["omega"]
    (tmp_path / "class.csv").write_text(f"at,omega_4\n30,{theory + 0.03}\n120,\n")
    swept = graphkin.sweep("shaper-scheme-2", positions=2, measured=tmp_path / "class.csv")
    assert ["diagram-omega_4"] == list(swept.figures)
    words = words_of(swept.figures["diagram-omega_4"])
    assert "values measured elsewhere (1) deviate from the theory by 0.03 rad/s" in words
    (axes,) = swept.figures["diagram-omega_4"].figure().axes
    (dot,) = [line for line in axes.lines if line.get_marker() == "x"]
    assert (30.0, theory + 0.03) == pytest.approx((dot.get_xdata()[0], dot.get_ydata()[0]))


@pytest.mark.parametrize(("cells", "shown"), [(("-550", "300"), (-550.0, 300.0)), (("550", "300"), (550.0, 300.0))])
def test_values_measured_along_a_guide_are_laid_over_the_theory_with_their_sign(tmp_path, cells, shown) -> None:
    (tmp_path / "class.csv").write_text(f"at,v_C\n60,{cells[0]}\n240,{cells[1]}\n")
    swept = graphkin.sweep("shaper-scheme-2", positions=2, measured=tmp_path / "class.csv")
    assert ["diagram-v_C"] == list(swept.figures)
    (axes,) = swept.figures["diagram-v_C"].figure().axes
    (dots,) = [line for line in axes.lines if line.get_marker() == "x"]
    assert shown == pytest.approx(tuple(dots.get_ydata()))
    theory = max(axes.lines, key=lambda line: len(line.get_xdata())).get_ydata()
    assert (shown[0] < 0) == (min(theory) < 0)


def test_values_measured_elsewhere_need_the_place_of_each_row(tmp_path: Path) -> None:
    (tmp_path / "class.csv").write_text("name,omega_4\nAnn,1\n")
    with pytest.raises(graphkin.CallError, match="no column at"):
        graphkin.sweep("shaper-scheme-2", measured=tmp_path / "class.csv")


def test_the_pressure_angle_of_a_cams_follower_is_swept_with_what_the_scene_allows() -> None:
    swept = graphkin.sweep("cam-offset-roller", positions=12, find=["pressure_2"])
    alone = graphkin.solve("cam-offset-roller").data["positions"][0]["cams"]["1"]["pressure"]
    assert math.degrees(alone) == pytest.approx(swept.table["pressure_2"][0], abs=1e-9)
    words = words_of(swept.figures["diagram-pressure_2"])
    assert "allowed: ≤ 30° as it rises, ≤ 70° as it falls" in words
    assert "e−" not in words  # no residue where it is nought


def test_the_limits_of_a_cams_pressure_angle_stand_beside_no_other_quantity_of_its_follower() -> None:
    swept = graphkin.sweep("cam-swinging-roller", positions=12, find=["omega_2", "pressure_2"])
    allowed = {name: "allowed" in words_of(figure) for name, figure in swept.figures.items()}
    assert {"diagram-omega_2": False, "diagram-pressure_2": True} == allowed


def test_the_diagram_of_the_angle_between_two_links_has_no_leap_of_a_turn() -> None:
    reach = driver_range(mechanism_of("four-bar-coupler-point"))
    axis, angle = DriverAxis(reach), Symbol.parse("theta_2/1")
    curve = axis.curve(angle, axis.offsets, course_of(angle, reach, axis.motion))
    assert np.abs(np.diff(curve[:, 1])).max() < 1.0


def test_values_measured_elsewhere_do_not_go_with_designs(tmp_path: Path) -> None:
    (tmp_path / "class.csv").write_text("at,v_C\n90,800\n")
    with pytest.raises(graphkin.CallError, match="measured: do not go with designs"):
        graphkin.sweep("shaper-scheme-2", measured=tmp_path / "class.csv", designs={"links.2.length": [80, 90]})
