"""What alone is asked of the solver."""

from __future__ import annotations

import json
import math
import sys

import pytest

import graphkin

from ..command import run

pytestmark = pytest.mark.quick

SIXBAR = "sixbar-guide-40deg"


def test_only_what_is_asked_is_given_in_its_order() -> None:
    solved, whole = graphkin.solve(SIXBAR, find=["omega_3", "v_D", "theta_3"]), graphkin.solve(SIXBAR)
    (position,) = solved.data["positions"]
    v = whole["v_D"][0]
    wanted = {"omega_3": whole["omega_3"][0], "v_D": [v.real, v.imag], "theta_3": math.radians(whole["theta_3"][0])}
    assert ["omega_3", "v_D", "theta_3"] == list(position["values"])
    assert wanted == position["values"]
    assert not {"links", "points", "slides"} & set(position)


def test_the_table_has_the_asked_between_driver_and_status() -> None:
    table = graphkin.solve(SIXBAR, sweep=4, find="v_D").table
    assert ("position", "driver_1", "v_D", "v_D.x", "v_D.y", "status", "why") == table.names


def test_the_command_finds_the_same() -> None:
    answer = run("solve", SIXBAR, "--find", "v_D", "--json")
    assert graphkin.solve(SIXBAR, find="v_D").data == json.loads(answer.stdout)
    assert "v_D.x      -482.722   mm/s" in run("solve", SIXBAR, "--find", "v_D").stdout


def test_everything_that_names_nothing_is_told() -> None:
    with pytest.raises(graphkin.CallError) as refusal:
        graphkin.solve(SIXBAR, find=["v_Q", "v_D", "omega_9"])
    assert 2 == len(refusal.value.problems)


@pytest.mark.parametrize(
    ("scene", "symbol"),
    [("fourbar-150-500-300-400", "d_A/D"), ("loader-cylinder", "omega_2"), ("cam-swinging-roller", "d_A/C")],
)
def test_what_asks_for_not_every_driver_is_checked(scene: str, symbol: str) -> None:
    done = run("check", scene, "--find", symbol)
    assert (0, True) == (done.returncode, f" {symbol} " in done.stdout), done.stderr


def test_one_reading_is_not_called_all_readings() -> None:
    shown = run("check", "fourbar-150-500-300-400", "--find", "d_A/D").stdout
    assert shown.rstrip().endswith("The reading agrees with the analytic solution.")


def test_a_name_that_is_not_there_is_told_in_the_reader_s_language() -> None:
    told = run("check", SIXBAR, "--find", "v_B@99", "--find", "v_Q", "--lang", "zh").stderr
    assert ("没有构件“99”" in told, "没有点“Q”" in told) == (True, True), told


def test_what_leads_over_no_contact_tells_of_none() -> None:
    assert "at contact" not in run("check", "cam-swinging-roller", "--find", "d_A/C").stdout


WRONG = ["v_B/B", "ak_B@1/C@2", "v_Q", "omega_9", "v_B at 9", "v_2/3", "C", "B@3", "v_9/3", "speed", "v_D.x",
         "omega_3.x"]


@pytest.mark.parametrize("name", WRONG)
def test_a_name_that_cannot_be_drawn_is_refused_alike_in_a_file_and_in_a_call(name: str) -> None:
    with pytest.raises(graphkin.CallError) as called:
        graphkin.check(SIXBAR, find=[name])
    with pytest.raises(graphkin.SceneError) as filed:
        graphkin.check(graphkin.read(SIXBAR).replace("find", [name]))
    assert [str(p.wanted) for p in called.value.problems] == [str(p.wanted) for p in filed.value.problems]


@pytest.mark.parametrize(("name", "instead"), [("v_2/3", "v_B@2/B@3"), ("a_2/3", "a_B@2/B@3"), ("D", "x_D, y_D"),
                                               ("v_D.x", "v_D"), ("v_5/6", "v_D@5/D@6")])
def test_what_stands_in_tables_alone_is_refused_with_what_a_drawing_has(name: str, instead: str) -> None:
    assert graphkin.solve(SIXBAR, find=name).table[name if "_" in name else f"x_{name}"].size
    told = run("check", SIXBAR, "--find", name).stderr
    assert f"is given by tables alone: solve and sweep have it; of a drawing ask for {instead}" in told


@pytest.mark.parametrize(("scene", "rate"), [("geneva-step", "v_B/2"), ("loader-cylinder", "v_7/6"),
                                             ("slider-crank-offset", "a_3/4"),
                                             ("cam-eccentric-flat-rocker", "v_O/2")])
def test_what_a_drawing_has_instead_of_a_rate_along_a_guide_can_be_asked_of_it(scene: str, rate: str) -> None:
    with pytest.raises(graphkin.CallError) as refused:
        graphkin.check(scene, find=rate)
    instead = str(refused.value.problems[0].wanted).rpartition(" ")[2]
    assert graphkin.check(scene, find=instead)[instead]


LETTERED = {
    "frame": {"name": "F", "points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
    "links": {"1": {"points": ["A", "B"], "length": 20}, "2": {"points": ["B", "C"], "length": 60},
              "G": {"points": ["C"], "on": "F.h"}},
    "driver": {"link": "1", "angle": 60, "omega": 10},
}


def test_a_rate_along_a_guide_has_no_component_where_its_links_are_letters() -> None:
    with pytest.raises(graphkin.CallError, match='"v_G/F" is no vector'):
        graphkin.solve(LETTERED, find="v_G/F.x")


def test_a_name_of_two_points_is_of_a_sliding_pair_where_they_are_links() -> None:
    solved = graphkin.solve(LETTERED)
    assert solved["v_C"][0].real == pytest.approx(solved["v_G/F"][0], rel=1e-12)
    assert solved["v_C/B"][0] == pytest.approx(solved["v_C"][0] - solved["v_B"][0], rel=1e-12)


IN_TABLES = [
    *((SIXBAR, name) for name in (
        "v_D", "v_B@3/B@2", "v_2/3", "a_2/3", "s_2/3", "C", "B@3", "v_D.x", "v_B@3/D.y", "ak_B@3/B@2", "ar_B@3/B@2.y",
        "omega_3", "x_D", "y_B", "theta_3", "theta_3/4", "d_B/D", "d_P13/D", "gamma_4-5", "pressure_5",
    )),
    *(("fourbar-150-500-300-400", name) for name in ("an_C", "at_C/B", "gamma_2-3", "d_B/D", "at_C.y")),
    *(("geneva-step", name) for name in ("v_B/2", "a_B/2", "ak_B@2/B", "theta_2/1")),
    ("cam-swinging-roller", "pressure_2"), ("hit16-double-guide", "v_4/5"),
    *(("shaper-forces", name) for name in ("F_5/6", "F_6/5.y", "M_2", "M_6/1", "Mi_4")),
]


@pytest.mark.parametrize(("scene", "name"), IN_TABLES)
def test_a_quantity_has_a_value_by_the_same_name_in_solve_and_prepare(scene: str, name: str) -> None:
    solved, ready = graphkin.solve(scene, find=name), graphkin.prepare(scene, find=name)
    assert solved[name] == pytest.approx(ready[name], rel=1e-9, abs=1e-9 * abs(solved[name][0]))
    assert solved[name].unit == ready[name].unit == ready.units[name]


REFUSED = [*((SIXBAR, name) for name in (
    "v_B/3", "s_B/3", "v_2/3.x", "C.x", "an_C", "an_C/B", "an_C.x", "omega_B", "stroke_5/6", "K_5/6", "4-5", "v_9",
    "v_Q", "v_D at 7", "F_5/6", "gamma_1-5", "ak_B@1/C@2", "speed",
)), *(("shaper-forces", name) for name in ("F_2", "Fi_5", "h_4", "arm_G_6", "P_cut", "v_5/6"))]


@pytest.mark.parametrize(("scene", "name"), REFUSED)
def test_a_name_of_nothing_is_refused_with_the_same_words_by_solve_and_prepare(scene: str, name: str) -> None:
    said = []
    for verb in (graphkin.solve, graphkin.prepare):
        with pytest.raises(graphkin.CallError) as refusal:
            verb(scene, find=name)
        said.append(str(refusal.value))
    assert said[0] == said[1]


@pytest.mark.parametrize(("scene", "name"), [("shaper-forces", "v_5/6"), (SIXBAR, "v_B/3"), (SIXBAR, "a_1/6")])
def test_a_rate_of_no_sliding_pair_is_refused_with_the_pairs_there_are_by_a_drawing_too(scene: str, name: str) -> None:
    said = []
    for verb in (graphkin.solve, graphkin.check):
        with pytest.raises(graphkin.CallError) as refusal:
            verb(scene, find=name)
        (problem,) = refusal.value.problems
        said.append((str(problem.found), str(problem.wanted)))
    assert "there is no such sliding pair" == said[0][0]
    assert said[0] == said[1]


def test_a_column_of_answers_may_be_the_distance_of_a_centre() -> None:
    answers = {"Ann": {"d_P13/D": "555", "d_B/C": "381.6"}}
    judged = graphkin.audit(SIXBAR, answers=answers).data["values"]
    assert [("d_P13/D", "right"), ("d_B/C", "right")] == [(value["symbol"], value["verdict"]) for value in judged]


@pytest.mark.parametrize("name", ["v_D", "a_B@3", "v_B@3/D"])
def test_a_component_is_given_by_the_name_of_its_column(name: str) -> None:
    solved = graphkin.solve(SIXBAR, sweep=3)
    x, y = (solved[f"{name}.{axis}"] for axis in "xy")
    assert [(x + 1j * y)[k] for k in range(3)] == pytest.approx(solved[name].tolist(), rel=1e-12)
    assert ("position", "driver_1", f"{name}.x", "status", "why") == graphkin.sweep(
        SIXBAR, positions=3, find=f"{name}.x").table.names


def test_what_is_asked_by_name_is_solved_once(monkeypatch):
    from graphkin import solver

    solve, asked = solver.solve, []
    monkeypatch.setattr(solver, "solve", lambda *given, **named: asked.append(given) or solve(*given, **named))
    solved = graphkin.solve("shaper-scheme-2", find=["v_C", "omega_4"])
    assert (1,) == solved["v_C"].shape
    assert (1, 1) == (len(solved.table), len(asked))


def test_a_long_sweep_has_each_position_once_whether_it_is_whole_or_comes_in_blocks(monkeypatch):
    monkeypatch.setattr(sys.modules["graphkin.solver.path.driver_range"], "BLOCK", 8)
    solved = graphkin.solve("shaper-scheme-2", sweep=20)
    assert [8, 8, 4] == [len(block.motion) for block in solved.blocks()]
    in_blocks = list(solved.entries())
    assert solved.table["driver_2"] % 360 == pytest.approx(
        [math.degrees(entry["driver"]["2"]) % 360 for entry in in_blocks], abs=1e-9)
    assert in_blocks == list(solved.entries())


def test_the_frame_rests_for_who_asks() -> None:
    checked = graphkin.check(SIXBAR, find=["omega_6", "alpha_6"])
    assert checked.ok
    assert [0, 0] == [checked[name].measured for name in ("omega_6", "alpha_6")]


@pytest.mark.parametrize("name", ["h_3", "arm_G_3", "arm_P_cut"])
@pytest.mark.parametrize("command", ["check", "solve"])
def test_what_belongs_to_forces_is_refused_without_any(command: str, name: str) -> None:
    answer = run(command, SIXBAR, "--find", name)
    assert (2, "") == (answer.returncode, answer.stdout)
    assert "nothing makes any" in answer.stderr


def test_a_force_with_what_begins_is_the_force_where_nothing_begins() -> None:
    checked, solved = (call("shaper-forces", find=["F_5/6+"]) for call in (graphkin.check, graphkin.solve))
    assert solved["F_5/6+"][0] == pytest.approx(checked["F_5/6+"].measured, rel=1e-9)


@pytest.mark.parametrize(("scene", "name"), [(SIXBAR, "swing_3"), ("engine-gas-force", "J_F")])
def test_a_prepared_mechanism_has_no_column_of_the_whole_turn(scene: str, name: str) -> None:
    with pytest.raises(graphkin.CallError, match=f"{name}: belongs to the whole turn, not to one position"):
        graphkin.prepare(scene, find=[name])


@pytest.mark.parametrize(("name", "said"), [("swing_5/6", "names no link"), ("excess_W", "belongs to a flywheel"),
                                            ("swing_3", "it stands in the summary")])
def test_a_sweep_refuses_what_is_no_column_by_what_it_is(name: str, said: str) -> None:
    with pytest.raises(graphkin.CallError, match=said):
        graphkin.sweep(SIXBAR, find=[name])


@pytest.mark.parametrize("part", ["an_D", "at_D"])
def test_a_part_of_no_rotation_is_refused_by_its_name_on_the_drawing_as_in_numbers(part: str) -> None:
    said = f"{part}: no link makes this part; D turns about no fixed point; write {part}/A with A on its link"
    for call in (graphkin.check, graphkin.solve):
        with pytest.raises(graphkin.CallError) as refused:
            call("sixbar-guide-40deg", find=[part])
        assert said == str(refused.value)
