"""``graphkin sweep`` and ``graphkin.sweep``."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import graphkin
from graphkin.cli.commands import app_of
from graphkin.errors import CallError, Unsolvable
from graphkin.scene import library_text
from graphkin.scene.symbol import Symbol
from graphkin.study import sweeps
from graphkin.table import Table
from tests.mechanisms import redriven
from tests.scenes import four_bar, slider_crank
from tests.solver.test_forces import loaded

NAME = "slider-crank-s50-e16-K1.2"


def call(*arguments: str) -> tuple[int, str]:
    result = CliRunner().invoke(app_of(), ["sweep", *arguments])
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result.exit_code, result.stdout


def test_json_gives_back_stroke_and_K(tmp_path: Path) -> None:
    code, text = call(NAME, "-o", str(tmp_path), "--json")
    slider = json.loads(text)["outputs"][0]
    assert (0, 50.0, 1.2) == (code, pytest.approx(slider["stroke"], rel=1e-12), pytest.approx(slider["K"], rel=1e-12))


def test_designs_of_a_scene_without_a_driver_are_refused_as_the_scene_is() -> None:
    scene = {key: table for key, table in graphkin.read("fourbar-150-500-300-400").to_dict().items() if key != "driver"}
    with pytest.raises(Unsolvable, match="no driver given"):
        graphkin.sweep(scene | {"find": ["omega_3"]}, designs={"links.1.length": [50, 60]})


def test_a_driven_slide_without_a_way_is_swept_where_it_stands() -> None:
    (reach,) = graphkin.sweep(loaded(redriven(3000), 3000), positions=6).data["ranges"]
    assert reach["low"] == reach["high"]


def test_table_has_as_many_rows_as_positions(tmp_path: Path) -> None:
    call(NAME, "-o", str(tmp_path), "--positions", "12", "-q")
    assert len((tmp_path / "table.csv").read_text().splitlines()) == 13


def test_figures_are_written_in_the_formats_asked_for(tmp_path: Path) -> None:
    call(NAME, "-o", str(tmp_path), "--format", "svg,pdf", "-q")
    assert {"motion-slide-3-4.svg", "motion-slide-3-4.pdf"} <= {p.name for p in tmp_path.iterdir()}


def test_find_limits_the_columns() -> None:
    head = graphkin.sweep(NAME, positions=1, find=["omega_2"]).table.csv().splitlines()[0]
    assert head == "position,driver_1 (deg),omega_2 (rad/s),status,why"


def test_arrays_are_those_of_the_solver() -> None:
    motion = graphkin.solve(NAME, sweep=500).motion
    swept = graphkin.sweep(NAME, positions=500, find=["v_B", "C", "omega_2", "a_C", "at_C/B"])
    quick = graphkin.sweep(NAME, positions=500, find=["v_B", "C", "omega_2", "a_C"])
    assert [True, False] == [isinstance(kept, Table) for kept in (swept.over.content, quick.over.content)]
    right_of = {name: motion.value(Symbol.parse(name)) for name in ("v_B", "a_C", "omega_2")}
    right_of["C"] = motion.position("C")
    for name, si in right_of.items():
        right = si if name == "omega_2" else si * 1000
        np.testing.assert_allclose(swept[name], right, rtol=0, atol=1e-12 * np.abs(right).max())
        np.testing.assert_allclose(quick[name], right, rtol=0, atol=1e-12 * np.abs(right).max())


def test_arrays_of_everything_are_named_by_what_they_are() -> None:
    swept, motion = graphkin.sweep(NAME, positions=12), graphkin.solve(NAME, sweep=12).motion
    np.testing.assert_allclose(motion.position("C") * 1000, swept["C"], rtol=1e-12)
    np.testing.assert_allclose(motion.slide("3/4")[1] * 1000, swept["v_3/4"], atol=1e-9)
    np.testing.assert_allclose(np.degrees(motion.angle("2")), swept["theta_2"], atol=1e-10)


def test_places_angles_and_travels_can_be_asked_for() -> None:
    whole, some = graphkin.sweep(NAME, positions=12), graphkin.sweep(NAME, positions=12, find=["C", "theta_2", "s_3/4"])
    for name in ("C", "theta_2", "s_3/4"):
        np.testing.assert_allclose(whole[name], some[name], rtol=1e-12)
    assert ("x_C (mm)", "y_C (mm)", "theta_2 (deg)", "s_3/4 (mm)") == some.table.heads[2:6]


def test_what_names_nothing_is_told_all_at_once() -> None:
    with pytest.raises(CallError) as refusal:
        graphkin.sweep(NAME, find=["v_X", "theta_9", "s_9/4"])
    assert 3 == len(refusal.value.problems)


def test_drivers_are_in_the_table() -> None:
    swept, motion = graphkin.sweep(NAME, positions=12), graphkin.solve(NAME, sweep=12).motion
    np.testing.assert_allclose(np.degrees(motion.values[:, 0]), swept.table["driver_1"], atol=1e-10)


def test_arrays_over_designs_have_a_row_for_each() -> None:
    designs = {"links.1.length": [150, 1500]}
    swept = graphkin.sweep("fourbar-150-500-300-400", positions=12, find=["v_C"], designs=designs)
    assert ((2, 12), [True, False]) == (swept["v_C"].shape, np.isfinite(swept["v_C"]).all(axis=1).tolist())


def test_what_the_motion_does_not_reach_is_nan_with_its_reason() -> None:
    swept = graphkin.sweep("sixbar-AE70", positions=12, find=["v_B"])
    bad = np.isnan(swept["v_B"])
    assert (8, 4) == (bad.sum(), swept.good)
    assert all("the motion reaches from" in why for why in swept.table["why"][bad])


def test_what_comes_from_the_prepared_engine_is_what_the_solver_gives() -> None:
    for name in ("sixbar-AE70", "shaper-scheme-2", "hydraulic-cylinder"):
        point = next(p for link in reversed(graphkin.read(name).mechanism.links) for p in link.points)
        quick = graphkin.sweep(name, positions=90, find=[f"v_{point}"])
        whole = graphkin.sweep(name, positions=90, find=[f"v_{point}", f"a_{point}"], at=_own(name))
        assert (True, None) == (quick.over.base.engine is not None, whole.over.base.engine)
        one, other = quick[f"v_{point}"], whole[f"v_{point}"]
        assert np.array_equal(quick.table["status"], whole.table["status"])
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-9 * np.nanmax(np.abs(other)))


def _own(name: str) -> float:
    scene = graphkin.read(name).mechanism
    driver = scene.drivers[0]
    return scene.unit_of(driver).of(driver.value)


def test_nothing_is_studied_that_is_not_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("graphkin.study.turn.study_turn", None)
    monkeypatch.setattr("graphkin.solver.prepared.range_of", None)  # the range is followed once, by the design
    assert 3 == len(graphkin.sweep(NAME, positions=3, find=["v_B"])["v_B"])


def test_a_written_sweep_gives_its_arrays_back(tmp_path: Path) -> None:
    here = graphkin.sweep(NAME, positions=30, find=["v_C", "at_C/B"])
    there = graphkin.sweep(NAME, out=tmp_path, positions=30, find=["v_C", "at_C/B"])
    np.testing.assert_array_equal(here["v_C"], there["v_C"])
    assert here.table.csv() == there.table.csv() == (tmp_path / "table.csv").read_text()


def test_what_is_in_memory_writes_the_files_of_the_command(tmp_path: Path) -> None:
    call(NAME, "-o", str(tmp_path / "a"), "-q")
    graphkin.sweep(NAME).write(tmp_path / "b")
    one, other = ({p.name: p.read_bytes() for p in (tmp_path / x).iterdir()} for x in "ab")
    assert one.keys() == other.keys()
    assert one["table.csv"] == other["table.csv"]


def test_xarray_has_units_and_what_is_replaced_as_coordinates() -> None:
    pytest.importorskip("xarray", reason="xarray is not installed")
    lengths = [150.0, 160.0]
    data = graphkin.sweep(
        "fourbar-150-500-300-400", positions=6, find=["omega_3"], designs={"links.1.length": lengths}
    ).to_xarray()
    assert ("rad/s", lengths) == (data.omega_3.attrs["units"], data["links.1.length"].values.tolist())


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
    scene = four_bar(50, 100, 100, 400)
    with pytest.raises(Unsolvable):
        graphkin.sweep(scene)


def test_designs_of_a_scene_that_is_read_are_those_of_its_file() -> None:
    designs = {"links.1.length": "20:22:3"}
    read, named = (graphkin.sweep(s, designs=designs, positions=4) for s in (graphkin.read(NAME), NAME))
    assert named.table.csv() == read.table.csv()


def test_designs_are_counted_by_outcome() -> None:
    swept = graphkin.sweep("fourbar-150-500-300-400", positions=12, designs={"links.1.length": [150, 1500]})
    assert {"ok": 1, "not assembled": 1} == dict(swept.outcomes)


def test_summary_is_told_in_chinese(tmp_path: Path) -> None:
    assert "曲柄摇杆机构" in call("fourbar-150-500-300-400", "-o", str(tmp_path), "--lang", "zh")[1]


def test_a_notebook_shows_summary_and_diagrams() -> None:
    shown = graphkin.sweep(NAME, positions=1)._repr_html_()
    assert "<svg" in shown
    assert "K = 1.2" in shown


def test_rows_are_numbered_as_the_scene_numbers_its_positions() -> None:
    numbered = {"count": 12, "first": {"stroke": "6/1", "at": 0, "sense": 1}}
    scene = graphkin.read("shaper-scheme-2").replace("positions", numbered)
    table = graphkin.sweep(scene, find=["C"]).table
    assert (12, 1) == (len(table), table["position"][0])
    # position 1 is the start of the stroke; the crank turns clockwise
    assert table["x_C (mm)"][0] == pytest.approx(-322.8693781, abs=1e-6)
    assert [-30.0] * 11 == pytest.approx(np.diff(table["driver_2 (deg)"]))


@pytest.mark.parametrize("velocity", [60, -60])
def test_solve_sweep_and_prepare_go_in_the_sense_of_a_driven_slide(velocity: float) -> None:
    scene = tomllib.loads(library_text("boom-lifted"))
    scene["driver"]["velocity"] = velocity
    swept = graphkin.sweep(scene, positions=7, find=["theta_1"])
    travels = swept["driver_2/3"]
    assert [velocity > 0] * 6 == (np.diff(travels) > 0).tolist()
    solved = graphkin.solve(scene, sweep=7)
    assert travels.tolist() == pytest.approx(solved["driver_2/3"].tolist(), rel=1e-9)
    assert swept["theta_1"].tolist() == pytest.approx(solved["theta_1"].tolist(), rel=1e-9)
    prepared = graphkin.prepare(scene, find=["theta_1"]).sweep(7)
    assert prepared.driver.tolist() == pytest.approx(travels.tolist(), rel=1e-9)


def test_positions_whose_balance_does_no_work_are_not_solved_in_a_sweep_either(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene = {
        "frame": {"name": "0", "points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 50},
            "2": {"points": ["B", "C"], "length": 150},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 0, "omega": 10},
        "loads": {"L": {"on": "1", "moment": 10}},
        "balance": {"on": "2"},  # the rod does not turn at 90 and 270 degrees
    }
    swept, solved = graphkin.sweep(scene, positions=4), graphkin.solve(scene, sweep=4)
    assert ["ok", "dead point", "ok", "dead point"] == swept.table["status"].tolist()
    assert solved.table == swept.table
    assert "the balance does no work in this position" in swept.table["why"][1]
    assert 2 == swept.good
    assert np.isfinite(swept["F_1/2"][0])
    assert ["ok"] * 4 == graphkin.sweep(scene, positions=4, find=["v_C"]).table["status"].tolist()
    asked = ["F_1/2", "v_C"]  # where forces are not known the motion is
    ready = graphkin.prepare(scene, find=asked)
    forces = graphkin.sweep(scene, positions=4, find=asked)
    monkeypatch.setattr(sweeps, "BLOCK", 1)
    prepared = ready.sweep(4)
    assert forces.table["why"].tolist() == prepared.table["why"].tolist()
    for name in asked:
        np.testing.assert_allclose(forces.table[f"{name}.x"], prepared.table[f"{name}.x"], rtol=1e-9, atol=1e-9)
    assert [True] * 4 == np.isfinite(prepared.table["v_C"]).tolist()


def test_designs_have_the_numbers_of_the_scenes_that_they_say() -> None:
    shaper, find, lengths = graphkin.read("shaper-scheme-2"), ["v_C", "omega_4"], [80.0, 100.0]
    swept = graphkin.sweep(shaper, find=find, positions=12, designs={"links.2.length": lengths})
    for k, length in enumerate(lengths):
        alone = graphkin.sweep(shaper.replace("links.2.length", length), find=find, positions=12)
        for name in find:
            assert alone[name] == pytest.approx(swept[name][k], rel=1e-12, abs=1e-9)


def test_a_link_that_swings_is_not_said_to_turn_fully() -> None:
    # the rocker of the four-bar would be a crank of the slider by its lengths alone
    said = graphkin.sweep("sixbar-420rpm", positions=4).text
    assert "Mechanism 1, 2, 3, 6: crank-rocker; turns fully: 1" in said
    assert "Mechanism 3, 4, 5, 6: in-line slider-crank; its lengths alone would let turn fully: 3" in said


def test_nothing_is_said_to_turn_fully_where_no_link_on_the_frame_does() -> None:
    said = graphkin.sweep(four_bar(300, 100, 330, 350), positions=4).text
    assert "double-rocker (its coupler can turn fully)\n" in said


def dwelling(angle: float = 30, rise: str = "345") -> dict[str, object]:
    """A cam whose follower rests at both ends of its stroke."""
    return {
        "frame": {"points": {"A": [0, 0]}, "guides": {"g": {"through": "A", "angle": 90}}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["B"], "on": "0.g"}},
        "cams": {"1": {"follower": "2", "base": {"r": 80}, "law": [
            {"to": 100, "rise": 20, "by": rise}, {"to": 130}, {"to": 150}, {"to": 350, "fall": 20, "by": "345"},
            {"to": 360},
        ]}},
        "driver": {"link": "1", "angle": angle, "omega": 10},
    }


def test_a_K_that_leaves_out_dwells_says_so() -> None:
    assert "K = 2 (θ = 60°, dwells not counted)" in graphkin.sweep(dwelling(), positions=4).text


@pytest.mark.parametrize("angle", [30, 130, 140, 200, 355])
def test_a_dwell_is_told_from_its_beginning_to_its_end(angle: float) -> None:
    said = graphkin.sweep(dwelling(angle), positions=4).text
    assert (True, True) == ("100 mm @ 100° – 150°" in said, "80 mm @ 350° – 0°" in said)
    speed = next(line for line in said.splitlines() if "v_2/0" in line)
    assert {"100° – 150°", "350° – 0°"} == set(speed.partition("zero at ")[2].split(", "))


def test_a_speed_that_stays_the_greatest_is_told_from_where_it_begins() -> None:
    assert "maximum 114.592 @ 0° – 100°" in graphkin.sweep(dwelling(rise="uniform"), positions=4).text


def test_where_no_link_turns_fully_the_flywheel_is_named_once():
    boom = graphkin.read("boom-lifted").to_dict() | {"flywheel": {"on": "1", "delta": 0.05}}
    told = "flywheel: the mechanism runs through no cycle: one driver must turn fully; leave [flywheel] out"
    assert told in graphkin.sweep(boom).text.split("\n")


def test_a_train_that_closes_after_several_turns_says_so():
    train = graphkin.read("geared-five-bar").replace("gears.g.teeth", [20, 30])
    assert "turns fully; the motion repeats after 3 turns of the driver" in graphkin.sweep(train).text


def loaded_slider(rod: float) -> dict[str, object]:
    """A slider 40 beside its crank of 100, loaded on a part of its stroke: it takes a rod of 140 to turn fully."""
    driver = {"link": "1", "angle": 10, "omega": 5}
    scene = slider_crank(100, rod, driver=driver, masses={"3": {"at": "C", "mass": 2}})
    scene["frame"]["guides"]["h"]["through"] = [0, -40]
    part = {"stroke": "3/0", "sense": 1, "from": 0.1, "to": 0.9}
    return scene | {"loads": {"P": {"on": "3", "at": "C", "force": 100, "against": "3/0", "when": part}}}


@pytest.mark.parametrize("own", [80, 200])
@pytest.mark.parametrize(("find", "status"), [(None, "ok"), (["v_C", "F_1/2"], "no whole turn")])
def test_designs_without_the_stroke_of_a_load_have_their_motion_beside_those_that_have_forces(
    own: float, find: list[str] | None, status: str, tmp_path: Path
) -> None:
    designs = {"links.2.length": [80, 200]}
    swept = graphkin.sweep(loaded_slider(own), designs=designs, positions=4, find=find, out=tmp_path)
    assert (4, 4) == (np.isnan(swept["F_1/2"][0]).sum(), np.isfinite(swept["F_1/2"][1]).sum())
    assert [True, False, True, True] == np.isfinite(swept["v_C"][0]).tolist()
    assert [status, "ok"] == swept.table["status"][[0, 4]].tolist()
    assert swept.table["why"][0].startswith("loads.P.when.stroke: belongs to a whole turn, which")


def test_a_design_with_another_driver_has_nothing_in_the_column_of_the_scene_s_own() -> None:
    swept = graphkin.sweep(four_bar(150, 500, 300, 400), designs={"driver.link": ["1", "3"]}, positions=2)
    assert [60, 240] == pytest.approx(swept["driver_1"][0])
    assert np.isnan(swept["driver_1"][1]).all()
    assert np.isfinite(swept["omega_2"][:, 0]).all()


def test_motion_diagrams_have_the_letters_of_the_convention_that_is_asked_for():
    scene = graphkin.read(NAME).to_dict()
    american = graphkin.sweep(scene | {"sheet": {"convention": "us"}}).figures
    asked = graphkin.sweep(scene, convention="us").figures
    assert {name: figure.content("svg") for name, figure in american.items()} == {
        name: figure.content("svg") for name, figure in asked.items()
    }
