"""Positions with names, and values over a turn: where a stroke begins, and tables judged row by row."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

import graphkin
from graphkin.errors import CallError, SceneError

SHAPER: dict[str, Any] = graphkin.read("shaper-scheme-2").to_dict() | {
    "printed": {},
    "positions": {
        "count": 12,
        "first": {"stroke": "6/1", "at": 0, "sense": 1},
        "also": {"1'": {"stroke": "6/1", "at": 0.05, "sense": 1}, "7'": 143.2},
    },
}


def at(name: str) -> dict[str, Any]:
    return graphkin.solve(SHAPER, at=name).data["positions"][0]  # type: ignore[no-any-return]


def test_position_1_stands_where_the_stroke_begins() -> None:
    # the ram's farthest place on the left: C is a rod's length beyond B, the bar at its dead position
    b = 580 * complex(-90 / 350, math.sqrt(1 - (90 / 350) ** 2))
    left = b.real - math.sqrt(174**2 - (570.24828641905436 - b.imag) ** 2)
    assert left == pytest.approx(at("1")["slides"]["6/1"]["travel"], rel=1e-12)


def test_a_part_of_the_stroke_is_done_where_it_is_said() -> None:
    begin, later = (at(name)["slides"]["6/1"]["travel"] for name in ("1", "1'"))
    assert later - begin == pytest.approx(0.05 * 0.58 * 2 * 90 / 350 * 1000, rel=1e-10)


def test_positions_are_numbered_in_the_sense_of_the_driver() -> None:
    one, two = (at(name)["driver"]["2"] for name in ("1", "2"))
    assert math.remainder(two - one, 2 * math.pi) == pytest.approx(-math.pi / 6)


def test_a_driver_may_stand_at_a_named_position() -> None:
    driver = {"link": "2", "rpm": -64, "position": 7}
    placed = graphkin.solve(SHAPER | {"driver": driver}).data["positions"][0]
    assert ("7", at("7")["driver"]["2"]) == (placed["name"], pytest.approx(placed["driver"]["2"]))


def test_what_is_asked_of_another_position_is_drawn_there() -> None:
    checked = graphkin.check(SHAPER, find=["v_C", "v_C at 10"])
    assert [checked["v_C"].exact, graphkin.check(SHAPER, at="10")["v_C"].exact] == [
        checked["v_C"].exact, pytest.approx(checked["v_C at 10"].measured)]


def test_an_unknown_position_is_refused_with_the_nearest_name() -> None:
    with pytest.raises(CallError, match='position 13: there is no position of that name; did you mean "3"'):
        graphkin.check(SHAPER, at="13")


def test_all_that_is_wrong_with_positions_is_said_at_once() -> None:
    wrong = SHAPER["positions"] | {"first": {"stroke": "6/2"}, "show": ["13"], "also": {"1": 20}}
    with pytest.raises(SceneError) as caught:
        graphkin.read(SHAPER | {"positions": wrong})
    assert {"positions.first.stroke", "positions.show", "positions.also.1"} == {p.where for p in caught.value.problems}


def test_quoted_digits_decide_what_a_computed_value_may_be_off() -> None:
    printed = {"by": "computation", "v_C": "421", "omega_4": "-0.740", "a_C": "3580"}
    verdicts = [v["verdict"] for v in graphkin.audit(SHAPER | {"printed": printed}).data["values"]]
    assert ["right", "right", "wrong"] == verdicts


def test_rows_of_a_table_are_judged_each_at_its_own_position() -> None:
    rows = [{"at": 14.900596687829875, "v_C": "420.8"}, {"at": "1", "omega_4": "0.0", "v_C": 500}]
    found = graphkin.audit(SHAPER | {"printed_rows": rows}).data["values"]
    assert ["right", "right", "wrong"] == [v["verdict"] for v in found]


def test_a_table_beside_the_scene_is_found_and_its_one_wrong_value_named(tmp_path: Path) -> None:
    turn = graphkin.sweep(SHAPER, positions=36, find=["x_C", "omega_4"], at=0).table
    lines = [f"{d:.0f},{x:.3f},{w:.4f}" for d, x, w in zip(turn["driver_2"], turn["x_C"], turn["omega_4"], strict=True)]
    lines[7] = f"-70,100,{turn['omega_4'][7]:.4f}"
    (tmp_path / "t.csv").write_text("\n".join(["at,x_C,omega_4", *lines]))
    scene = graphkin.read(SHAPER | {"printed_table": {"file": "t.csv", "by": "computation"}})
    scene.save(tmp_path / "s.toml")
    values = graphkin.audit(tmp_path / "s.toml").data["values"]
    assert [(-70, "x_C")] == [(v["at"], v["symbol"]) for v in values if v["verdict"] != "right"]


def test_what_is_asked_of_another_position_is_solved_there() -> None:
    names = ["v_C at 10", "C at 10", "omega_4 at 1", "omega_4"]
    solved, there = graphkin.solve(SHAPER, find=names), graphkin.solve(SHAPER, at="10")
    assert there["v_C"][0] == pytest.approx(solved["v_C at 10"][0], rel=1e-12)
    assert there["C"][0] == pytest.approx(solved["C at 10"][0], rel=1e-12)
    (entry,) = solved.data["positions"]
    assert 0 == pytest.approx(entry["values"]["omega_4 at 1"], abs=1e-12)
    assert graphkin.solve(SHAPER)["omega_4"][0] == pytest.approx(entry["values"]["omega_4"], rel=1e-12)


def test_a_position_without_forces_is_refused_where_they_are_asked_of_it() -> None:
    loaded = SHAPER | {"loads": {"P": {"on": "2", "moment": 5}}, "balance": {"on": "6", "at": "C", "angle": 0}}
    assert "ok" == graphkin.solve(loaded, find=["v_C at 1"]).data["positions"][0]["status"]
    with pytest.raises(graphkin.Unsolvable, match="position 1: dead point"):
        graphkin.solve(loaded, find=["F_5/6 at 1"])


def test_a_table_has_no_column_of_one_position() -> None:
    for call in (graphkin.sweep, graphkin.prepare):
        with pytest.raises(CallError, match="v_C at 10: is of position 10 alone, no column; ask for v_C"):
            call(SHAPER, find=["v_C at 10"])
    with pytest.raises(CallError, match="is of position 10 alone"):
        graphkin.solve(SHAPER, find=["v_C at 10"], sweep=3)


def test_papers_of_one_position_ask_nothing_of_another() -> None:
    made = graphkin.handout(SHAPER, find=["omega_4", "v_C at 10"], formats=["html"])
    assert ["omega_4"] == [row.symbol for row in made.key if row.asked]
    assert ["papers are of one position: left out v_C at 10"] == [str(note) for note in made.notes]
    with pytest.raises(CallError, match="write them of that position: --find v_C --position 10"):
        graphkin.handout(SHAPER, find=["v_C at 10"], formats=["html"])
