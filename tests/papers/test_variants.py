"""Sets of problems: valid, different, the same whatever makes them, none lost; tables of data as exercises do."""

from __future__ import annotations

import json
import math
import os
import re
import signal
import subprocess
import sys
import time
import tomllib
from concurrent.futures import BrokenExecutor, ThreadPoolExecutor
from pathlib import Path

import pytest

import graphkin
from graphkin.api.classroom.problem_sets import problem_set
from graphkin.construction import draft
from graphkin.construction.board.steps import Ray
from graphkin.errors import CallError, Problem, Unsolvable
from graphkin.papers import variants as room
from graphkin.papers.data_rows import columns_of, replaced, value_of
from graphkin.papers.fresh_numbers import round_step
from graphkin.papers.variants import Answer, _within_reach, asked_of
from graphkin.plane import cross
from graphkin.scene import library_text, mechanism_of
from graphkin.scene.symbol import Symbol

SIXBAR = "sixbar-guide-40deg"
SHAPER = "shaper-scheme-2"
FOUR_BAR = "fourbar-150-500-300-400"
HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("set")
    return problem_set(SHAPER, variants=3, seed=7, out=folder)


@pytest.fixture(scope="module")
def four_bars():
    """The table of a small set, made one after another."""
    return problem_set(FOUR_BAR, variants=4, seed=1).table.csv()


def scenes(made):
    return [mechanism_of(path) for path in sorted(made.folder.glob("*.toml"))]


def test_as_many_are_made_as_are_asked_for(made):
    assert (3, 3, ()) == (len(made.answers), len(scenes(made)), made.failures)


def test_the_scene_files_give_the_answers(made):
    for scene, answers in zip(scenes(made), made.answers.values(), strict=True):
        motion = graphkin.solve(scene).motion
        for symbol, answer in zip(asked_of(scene), answers, strict=True):
            found = motion.value(symbol)[0]
            right = abs(found) / scene.units.metres if symbol.is_vector else found.real
            assert right == pytest.approx(answer.value, rel=1e-9)


def test_every_drawing_of_a_variant_agrees_with_the_solver(made):
    assert all(graphkin.check(scene).ok for scene in scenes(made)[:3])


def test_no_lines_cross_under_20_degrees(made):
    for scene in scenes(made):
        sheet = draft(scene, find=asked_of(scene))
        for equation in sheet.equations:
            rays = [s for t in sheet.steps if t.equation == equation.number for s in t.strokes if isinstance(s, Ray)]
            if len(rays) == 2:
                assert abs(cross(rays[0].along, rays[1].along)) >= math.sin(math.radians(20)) - 1e-9


def test_every_asked_vector_is_longer_than_10_mm(made):
    for scene in scenes(made):
        rows = graphkin.check(scene, find=asked_of(scene)).report.rows
        assert all(r.reading.on_paper >= 10 for r in rows if r.symbol in asked_of(scene))


def test_every_two_differ_in_an_answer_by_more_than_both_tolerances(made):
    sets = list(made.answers.values())
    assert all(room.distinct(one, iter(sets[:i])) for i, one in enumerate(sets))


def test_two_within_their_tolerances_are_not_distinct():
    assert not room.distinct([Answer("v", 100, 2)], iter([[Answer("v", 103, 2)]]))


def test_the_numbers_are_round(made):
    for scene in scenes(made):
        crank = scene.by_name["2"].length / scene.units.metres
        assert 0 == pytest.approx(math.remainder(crank, round_step(90)), abs=1e-9)


def test_threads_and_seeds_give_the_same_set_as_one_after_another(four_bars, tmp_path):
    with ThreadPoolExecutor(3) as pool:
        again = problem_set(FOUR_BAR, variants=4, seed=1, out=tmp_path, executor=pool, workers=3)
    assert four_bars == again.table.csv()


def test_a_broken_executor_loses_nothing(four_bars):
    class Broken(ThreadPoolExecutor):
        def submit(self, *_, **__):
            raise BrokenExecutor

    assert four_bars == problem_set(FOUR_BAR, variants=4, seed=1, executor=Broken(1), workers=2).table.csv()


def test_a_variant_whose_papers_fail_is_listed(tmp_path):
    def refuse(variant):
        raise CallError(Problem("papers", "no"))

    made = problem_set(FOUR_BAR, variants=2, seed=1, out=tmp_path, render=refuse)
    assert [("01", "papers: no"), ("02", "papers: no")] == [(f.name, str(f.why)) for f in made.failures]


def test_another_seed_gives_another_set(four_bars):
    assert four_bars != problem_set(FOUR_BAR, variants=4, seed=2).table.csv()


def test_an_interrupted_set_goes_on_where_it_was(four_bars, tmp_path, monkeypatch):

    def stop(done, _):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        problem_set(FOUR_BAR, variants=4, seed=1, out=tmp_path, progress=stop)
    (kept,) = tmp_path.glob(".set-*")
    (kept / ".0000003.k3j_x9a1").write_text('{"number": 3, "vari')
    worked = []
    work = room.work
    monkeypatch.setattr(room, "work", lambda job, attempt: worked.append(job.number) or work(job, attempt))
    again = problem_set(FOUR_BAR, variants=4, seed=1, out=tmp_path)
    assert (four_bars, [3, 4]) == (again.table.csv(), worked)


def test_a_variant_that_cannot_be_made_is_listed_with_the_reason(monkeypatch):
    monkeypatch.setattr(room, "ATTEMPTS", 0)
    made = problem_set(FOUR_BAR, variants=2, seed=1)
    assert (2, False) == (len(made.failures), made.ok)


def test_variants_are_rendered_and_their_files_kept(tmp_path):
    problem_set(FOUR_BAR, variants=2, seed=1, out=tmp_path, render=lambda variant: {"sheet.txt": variant.name.encode()})
    assert b"02" == (tmp_path / f"{FOUR_BAR}-02-sheet.txt").read_bytes()


def test_a_scene_stated_by_drawn_points_has_variants_too():
    scene = {
        "frame": {"name": "4", "points": {"A": [0, 0], "D": [100, 0]}},
        "links": {"1": {"points": ["A", "B"]}, "2": {"points": ["B", "C"]}, "3": {"points": ["D", "C"]}},
        "drawn": {"B": [30, 30], "C": [110, 70]},
        "driver": {"link": "1", "omega": 10},
    }
    assert problem_set(scene, variants=2, seed=3).ok


def test_the_design_table_of_the_shaper_runs_as_it_stands(tmp_path):
    made = problem_set(SHAPER, rows=HERE / "shaper-schemes.csv", out=tmp_path)
    assert (["I", "II", "III"], True) == (list(made.answers), made.ok)
    assert 420.788 == pytest.approx(made.answers["II"][0].value, abs=1e-3)


def test_rows_by_group_number_name_what_they_change(tmp_path):
    rows = "group,links.1.length,frame.points.A.y,driver.angle\n1,120,280,50\n2,118,270,75\n"
    (tmp_path / "rows.csv").write_text(rows)
    made = problem_set(SIXBAR, rows=tmp_path / "rows.csv", out=tmp_path)
    assert 118 == tomllib.loads((tmp_path / f"{SIXBAR}-2.toml").read_text())["links"]["1"]["length"]
    assert made.ok


def test_a_bad_row_is_a_failure_and_the_others_are_made(tmp_path):
    (tmp_path / "rows.csv").write_text("group,AB\n../1,120\n2,wide\n3,-5\n")
    made = problem_set(SIXBAR, rows=tmp_path / "rows.csv", out=tmp_path)
    assert (["1"], ["2", "3"]) == (list(made.answers), [f.name for f in made.failures])


@pytest.mark.parametrize(("status", "row"), [(2, "wide"), (2, "-5"), (3, "10")])
def test_a_row_that_is_no_scene_is_not_one_that_cannot_be_assembled(status, row, tmp_path):
    (tmp_path / "rows.csv").write_text(f"links.2.length\n{row}\n")
    made = problem_set(FOUR_BAR, rows=tmp_path / "rows.csv", out=tmp_path)
    assert [status] == [failure.exit_code for failure in made.failures]


def test_a_row_hard_to_draw_is_made_with_a_remark(tmp_path):
    (tmp_path / "rows.csv").write_text("group,phi1\n1,100\n2,80\n")
    made = problem_set(SIXBAR, rows=tmp_path / "rows.csv")
    assert made.ok
    assert "mm on paper only" in " ".join([str(remark) for one in made.variants for remark in one.remarks])


def test_remarks_and_failures_are_said_in_the_language_of_the_set(tmp_path):
    (tmp_path / "rows.csv").write_text("group,phi1\n1,100\n2,wide\n")
    table = problem_set(SIXBAR, rows=tmp_path / "rows.csv", language="zh").table.csv()
    assert "mm on paper only" not in table
    assert re.search(r"在图上只有 [\d.]+ mm[\s\S]*未作成：", table)


def test_a_set_that_goes_on_says_the_remarks_of_its_first_run(tmp_path):
    (tmp_path / "rows.csv").write_text("group,phi1\n1,100\n2,80\n")

    def render(variant):
        if variant.name == "2" and not (tmp_path / "ready").exists():
            raise CallError(Problem("papers", "no"))
        return {}

    problem_set(SIXBAR, rows=tmp_path / "rows.csv", out=tmp_path, render=render)
    (tmp_path / "ready").touch()
    problem_set(SIXBAR, rows=tmp_path / "rows.csv", out=tmp_path, render=render, language="zh")
    table = (tmp_path / "answers.csv").read_text(encoding="utf-8-sig")
    assert ("在图上只有" in table, "on paper only" in table) == (True, False)


@pytest.mark.parametrize(
    ("head", "key"),
    [
        ("n2 (r/min)", "driver.rpm"),
        ("l_O2A", "links.2.length"),
        ("lO4B/mm", "links.4.length"),
        ("O2O4", "frame.points.O2.y"),
        ("O4S4", "links.4.at.S4.x"),
        ("φ", "driver.angle"),
        ("位置 φ", "driver.angle"),
        ("曲柄转速 n2（r/min）", "driver.rpm"),
        ("driver.alpha", "driver.alpha"),
    ],
)
def test_a_head_is_understood(head, key):
    source = tomllib.loads(library_text(SHAPER))
    data, _ = columns_of(source, ["group", head])
    assert key in [k for k, _ in replaced(source, data, ["1", "60"])]


def test_a_speed_keeps_the_sense_of_the_scene():
    source = tomllib.loads(library_text(SHAPER))
    assert [("driver.rpm", -60.0)] == replaced(source, columns_of(source, ["n2"])[0], ["60"])


def test_a_column_that_is_no_datum_is_left_alone():
    data, others = columns_of(tomllib.loads(library_text(SHAPER)), ["方案", "n2", "G4 (N)"])
    assert ([1], [0, 2]) == ([*data], others)


@pytest.mark.parametrize(("text", "value"), [("0.3 lO4B", 174), ("2*(O4B-80)", 1000), ("-5e1", -50), ("asin(0.5)", 30)])
def test_a_cell_may_be_given_by_other_columns(text, value):
    assert value == pytest.approx(value_of(text, {"lO4B": 580, "O4B": 580}))


@pytest.mark.parametrize(
    "text", ["__import__('os')", "9**9**9", "O4B.real", "1/0", "nan", "x", "(" * 500, "sqrt(-1)", "[1]", "True"]
)
def test_a_cell_can_do_nothing_but_arithmetic(text):
    with pytest.raises(ValueError):
        value_of(text, {"O4B": 1.0})


def test_variants_of_a_scene_without_a_driver_are_refused_as_the_scene_is():
    scene = {key: table for key, table in graphkin.read(FOUR_BAR).to_dict().items() if key not in ("driver", "find")}
    with pytest.raises(Unsolvable, match="no driver given"):
        problem_set(scene, variants=2)


def test_variants_and_rows_together_are_refused(tmp_path):
    with pytest.raises(CallError):
        problem_set(SIXBAR, variants=3, rows=tmp_path / "x.csv")


def test_the_data_of_a_set_is_json(made):
    assert json.loads(json.dumps(made.data, allow_nan=False))["ok"]


def test_whatever_goes_wrong_with_one_the_others_are_made(tmp_path):
    def render(variant):
        if variant.name == "01":
            raise RuntimeError("out of ink")
        return {"sheet.txt": b"x"}

    made = problem_set(FOUR_BAR, variants=2, seed=1, out=tmp_path, render=render)
    assert (["02"], [("01", "RuntimeError: out of ink")]) == (
        list(made.answers),
        [(f.name, f.why) for f in made.failures],
    )


def test_papers_that_failed_are_tried_again_and_the_others_are_not(tmp_path):
    worked = []

    def render(variant):
        worked.append(variant.name)
        if worked == ["01"]:
            raise CallError(Problem("papers", "no"))
        return {"sheet.txt": b"x"}

    problem_set(FOUR_BAR, variants=2, seed=1, out=tmp_path, render=render)
    assert problem_set(FOUR_BAR, variants=2, seed=1, out=tmp_path, render=render).ok
    assert ["01", "02", "01"] == worked


def test_a_variant_whose_file_is_gone_is_made_again(tmp_path):
    def stop(done, _):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        problem_set(FOUR_BAR, variants=3, seed=1, out=tmp_path, progress=stop)
    (tmp_path / f"{FOUR_BAR}-01.toml").unlink()
    problem_set(FOUR_BAR, variants=3, seed=1, out=tmp_path)
    assert (tmp_path / f"{FOUR_BAR}-01.toml").exists()


def test_an_executor_that_loses_its_workers_loses_no_variant(four_bars):
    class Lossy(ThreadPoolExecutor):
        def submit(self, *_, **__):
            future = super().submit(lambda: None)
            future.result()
            lost = type(future)()
            lost.set_exception(RuntimeError("the worker is gone"))
            return lost

    assert four_bars == problem_set(FOUR_BAR, variants=4, seed=1, executor=Lossy(1), workers=2).table.csv()


def test_what_a_killed_process_left_half_written_is_removed(tmp_path):
    (tmp_path / f".{FOUR_BAR}-01.toml.k3j_x9a1").write_text("title = ")
    problem_set(FOUR_BAR, variants=1, seed=1, out=tmp_path)
    assert {f"{FOUR_BAR}-01.toml", "answers.csv", "answers_template.csv"} == {p.name for p in tmp_path.iterdir()}


def test_a_killed_set_goes_on(tmp_path):
    call = [sys.executable, "-c", "from graphkin.cli import main; main()", "handout", FOUR_BAR, "--variants", "4",
            "--format", "html", "--workers", "2", "-q", "-o", str(tmp_path)]
    first = subprocess.Popen(call, start_new_session=True)
    deadline = time.monotonic() + 60
    while not list(tmp_path.glob("*-01.toml")) and time.monotonic() < deadline:
        time.sleep(0.05)
    os.kill(first.pid, signal.SIGKILL)
    first.wait()
    done = subprocess.run(call, capture_output=True, text=True, timeout=120)
    assert 0 == done.returncode, done.stderr
    assert 4 == len(list(tmp_path.glob("*.toml")))
    assert [] == list(tmp_path.glob(".*"))


def test_a_set_asks_what_is_asked(tmp_path):
    made = problem_set(FOUR_BAR, variants=2, seed=1, out=tmp_path, find=["omega_3"])
    assert {("omega_3",)} == {tuple(a.symbol for a in answers) for answers in made.answers.values()}
    assert all([str(s) for s in scene.question.find] == ["omega_3"] for scene in scenes(made))


def test_an_answer_that_a_pencil_cannot_give_within_15_percent_is_not_asked_for(made):
    assert all(a.tolerance <= 0.15 * abs(a.value) for answers in made.answers.values() for a in answers)


def test_where_a_variant_comes_from_is_not_said_of_other_numbers(made):
    assert not any(scene.question.source for scene in scenes(made))


def test_the_title_of_a_variant_names_no_scheme_and_position_of_other_numbers(made):
    assert "Shaper with a swinging guide bar (no. 01)" == scenes(made)[0].question.title


def test_of_discs_and_geared_bars_what_they_move_is_asked_not_what_is_given():
    names = "disc-on-disc", "geared-five-bar"
    asked = {name: [str(s) for s in asked_of(graphkin.solve(name).mechanism)] for name in names}
    assert {"disc-on-disc": ["v_B", "a_B", "omega_2", "alpha_2"], "geared-five-bar": ["v_C", "a_C"]} == asked


def test_a_row_whose_answer_a_pencil_can_miss_says_so_and_only_that_row(tmp_path):
    (tmp_path / "rows.csv").write_text("name,driver.angle\na,60\nb,25\n")
    made = problem_set(FOUR_BAR, rows=tmp_path / "rows.csv", find=["omega_3"])
    said = {variant.name: [*map(str, variant.remarks)] for variant in made.variants}
    assert {"a": [], "b": ["omega_3 cannot be drawn more closely than to 5 %"]} == said


@pytest.mark.parametrize(("fewest", "asked"), [(2, ["v_E", "omega_5"]), (1, ["omega_5"])])
def test_one_quantity_that_a_pencil_finds_is_asked_where_two_are_not_to_be_had(fewest, asked):
    values = [(Symbol.parse("v_E"), 0.1), (Symbol.parse("omega_5"), -0.7)]
    missed = {Symbol.parse("v_E"): 0.009, Symbol.parse("omega_5"): 0.02}
    assert asked == [str(s) for s in _within_reach(values, missed, 0.05, fewest)]


def test_a_force_that_a_mechanism_never_carries_does_not_keep_its_variants_from_being_made():
    (answers,) = problem_set("boom-lifted", variants=1, seed=3, workers=1).answers.values()
    assert {"F_2", "F_4/1", "F_1/2", "F_3/2", "F_4/3"} == {a.symbol for a in answers}
    assert ["F_3/2"] == [a.symbol for a in answers if a.value == 0]


def test_what_cannot_vary_is_refused_in_its_time(monkeypatch):
    monkeypatch.setattr(room, "PATIENCE", 0.5)
    source = graphkin.read("shaper-forces").to_dict() | {"vary": {"tolerance": 0.001}}
    begun = time.process_time()
    (failure,) = problem_set(source, variants=1, workers=1).failures
    assert 1.5 > time.process_time() - begun
    assert re.search(r"cannot be drawn more closely than to 0.1 % \(\d+ times\); ask for less", str(failure.why))


def test_a_profile_that_cannot_be_cut_where_the_velocity_drops_is_told_at_one_place() -> None:
    law = [{"to": 120, "rise": 20, "by": "uniform"}, {"to": 180}, {"to": 300, "fall": 20, "by": "345"}, {"to": 360}]
    scene = graphkin.read("cam-flat-face").replace("cams.1.law", law)
    told = [str(phrase) for phrase in room._uncut(mechanism_of(scene))]
    assert ["the profile of cam 1 cannot be cut at 120 degrees"] == told
