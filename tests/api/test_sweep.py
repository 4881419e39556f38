"""``graphkin sweep`` and ``graphkin.sweep``."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

import graphkin
from graphkin.cli import app
from graphkin.errors import CallError, Unsolvable

NAME = "slider-crank-s50-e16-K1.2"


def call(*arguments: str) -> tuple[int, str]:
    result = CliRunner().invoke(app, ["sweep", *arguments])
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result.exit_code, result.stdout


def test_json_gives_back_stroke_and_K(tmp_path: Path) -> None:
    code, text = call(NAME, "-o", str(tmp_path), "--json")
    slider = json.loads(text)["outputs"][0]
    assert (0, 50.0, 1.2) == (code, pytest.approx(slider["stroke"], rel=1e-12), pytest.approx(slider["K"], rel=1e-12))


def test_table_has_as_many_rows_as_positions(tmp_path: Path) -> None:
    call(NAME, "-o", str(tmp_path), "--positions", "12", "-q")
    assert len((tmp_path / "table.csv").read_text().splitlines()) == 13


def test_figures_are_written_in_the_formats_asked_for(tmp_path: Path) -> None:
    call(NAME, "-o", str(tmp_path), "--format", "svg,pdf", "-q")
    assert {"motion-slide-3-4.svg", "motion-slide-3-4.pdf"} <= {p.name for p in tmp_path.iterdir()}


def test_find_limits_the_columns() -> None:
    head = graphkin.sweep(NAME, positions=1, find=["omega_2"]).table.splitlines()[0]
    assert head == "position,driver_1 (deg),omega_2 (rad/s),status,why"


def test_a_wrong_key_is_a_wrong_call(tmp_path: Path) -> None:
    with pytest.raises(CallError, match="did you mean"):
        call(NAME, "-o", str(tmp_path), "--set", "links.1.lengt=1:2:3")


def test_nothing_is_written_where_the_call_is_wrong(tmp_path: Path) -> None:
    with pytest.raises(CallError):
        call(NAME, "-o", str(tmp_path / "new"), "--set", "links.9.length=1:2:3")
    assert not (tmp_path / "new").exists()


def test_no_solvable_design_is_exit_3(tmp_path: Path) -> None:
    assert call("fourbar-150-500-300-400", "-o", str(tmp_path), "--set", "links.1.length=1500", "-q")[0] == 3


def test_a_scene_that_cannot_be_assembled_is_unsolvable() -> None:
    scene = {
        "frame": {"name": "4", "points": {"A": [0, 0], "D": [400, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 50},
            "2": {"points": ["B", "C"], "length": 100},
            "3": {"points": ["D", "C"], "length": 100},
        },
        "driver": {"link": "1", "angle": 60, "omega": 10},
    }
    with pytest.raises(Unsolvable):
        graphkin.sweep(scene)


def test_designs_need_the_file_not_a_scene_that_is_read() -> None:
    with pytest.raises(CallError, match="read already"):
        graphkin.sweep(graphkin.read(NAME), designs={"links.1.length": "20:22:3"})


def test_designs_are_counted_by_outcome() -> None:
    swept = graphkin.sweep("fourbar-150-500-300-400", positions=12, designs={"links.1.length": [150, 1500]})
    assert {"ok": 1, "not assembled": 1} == dict(swept.outcomes)


def test_summary_is_told_in_chinese(tmp_path: Path) -> None:
    assert "曲柄摇杆机构" in call("fourbar-150-500-300-400", "-o", str(tmp_path), "--lang", "zh")[1]


def test_a_notebook_shows_summary_and_diagrams() -> None:
    shown = graphkin.sweep(NAME, positions=1)._repr_html_()
    assert "<svg" in shown
    assert "K = 1.2" in shown
