"""The page's questions and their answers, without a browser: texts changed by key, points pulled, mechanisms built."""

from __future__ import annotations

import json
import tomllib
from base64 import b64decode
from io import BytesIO
from zipfile import ZipFile

import pytest

import graphkin
from graphkin.api.classroom.problem_sets import ProblemSet
from graphkin.board.answers import QUESTIONS, answer, scene_link, text_of_link
from graphkin.board.pictures import FigureOptions, shown
from graphkin.board.scene_text import changed, line_of, places
from graphkin.board.shelf import Shelf, mark_of
from graphkin.errors import CallError, Problem
from graphkin.papers.variants import Variant
from graphkin.scene.scene import library_text, mechanism_of
from graphkin.words import Phrase, Wording, links_named

pytestmark = pytest.mark.quick

SIXBAR = library_text("sixbar-420rpm")
DESK = Shelf(first="sixbar-420rpm")


def asked(question: str, **message: object) -> dict:
    return answer(DESK, {"do": question, "text": SIXBAR, **message})


def told(question: str, **message: object) -> dict:
    found = asked(question, **message)
    assert found["ok"], found
    return found


@pytest.mark.parametrize("table", ["links", "pins", "contacts", "gears", "cams", "masses", "loads", "springs"])
def test_a_table_that_a_text_does_not_have_yet_gets_a_head_of_its_own(table: str) -> None:
    made = changed('title = "A"\n', {f"{table}.K.of": "2"})
    assert f'title = "A"\n\n[{table}.K]\nof = "2"\n' == made



def test_every_change_keeps_the_comments_and_the_rest_of_the_text() -> None:
    made = changed(SIXBAR, {"links.2.length": 0.35, "frame.points.D.x": 0.41})
    assert SIXBAR.replace("length = 0.34", "length = 0.35").replace("D = [0.4,", "D = [0.41,") == made


def test_an_entry_is_taken_out_and_a_table_made() -> None:
    made = tomllib.loads(changed(SIXBAR, {"source": None, "sketch.C": [1, 2]}))
    assert "source" not in made
    assert {"C": [1, 2]} == made["sketch"]


def test_lines_of_keys_are_known_in_tables_and_braces() -> None:
    text = '[frame]\npoints = { A = [0, 0], B = { from = "A", r = 2 } }\n[[driver]]\nlink = "1"\n[[driver]]\nlink = "2"'
    found = places(text)
    assert [2, 2, 4, 6] == [found[k] for k in ("frame.points.A", "frame.points.B.r", "driver.link", "driver.2.link")]


@pytest.mark.parametrize(("where", "line"), [
    ("links.2.length", 20), (Phrase("link of name", name="3"), 22), (Phrase("line", line=7), 7),
    ("links.2.nothing", 18), (Phrase("point", point="A"), 11), (links_named(["3", "2"]), 22), ("nowhere", 0),
])
def test_a_problem_stands_at_the_line_it_is_about(where: Wording, line: int) -> None:
    assert line == line_of(Problem(where, "is wrong"), SIXBAR)


def test_a_wrong_length_is_told_at_its_line() -> None:
    wrong = asked("show", text=SIXBAR.replace("length = 0.34", "length = -0.34"))
    assert not wrong["ok"]
    assert [20] == [one["line"] for one in wrong["problems"]]
    assert "a length must be positive" in wrong["problems"][0]["text"]


def test_a_scene_is_answeredwhole_with_its_readings_and_steps() -> None:
    found = told("show", figures=["mechanism", "velocity", "centres"])
    assert {"mechanism", "velocity", "centres"} == set(found["figures"])
    assert found["agrees"]
    assert 'id="point-B"' in found["figures"]["mechanism"]
    assert {"A": "frame", "B": "driver", "C": "lengths"} == {p: found["points"][p]["pull"] for p in "ABC"}
    assert (0.0, 360.0, True) == (found["range"]["low"], found["range"]["high"], found["range"]["turns"])
    assert list(range(1, len(found["steps"]) + 1)) == [step["n"] for step in found["steps"]]


def test_steps_of_forces_follow_those_of_the_motion() -> None:
    found = told("show", text=library_text("shaper-forces"), figures=["forces"])
    steps = [step for step in found["steps"] if step["figure"] in ("forces", "lever")]
    assert {"forces", "lever"} == {step["figure"] for step in steps}
    assert f'step-{steps[0]["n"]:02d}' in found["figures"]["forces"]


def test_a_pulled_crank_pin_turns_the_driver_and_leaves_the_text() -> None:
    found = told("pull", point="B", x=0.0, y=3.0, final=True)
    assert pytest.approx(90.0) == found["at"]["1"]
    assert found["text"] == SIXBAR


def test_while_a_hand_moves_the_figures_follow_at_the_same_scale() -> None:
    still = told("show")
    moved = told("pull", point="B", x=0.0, y=3.0, final=False, quick=True, scales=still["scales"])
    assert still["scales"] == moved["scales"]
    exact = graphkin.solve("sixbar-420rpm", at=90).motion
    for point in "BCEF":
        z = complex(exact.position(point)[0])
        assert pytest.approx(z) == complex(moved["points"][point]["x"], moved["points"][point]["y"])
    assert 'id="v_C"' in moved["figures"]["velocity"]


@pytest.mark.parametrize("final", [True, False])
def test_a_pulled_joint_changes_the_lengths_so_that_it_lies_there(final: bool) -> None:
    found = told("pull", point="C", x=0.43, y=0.12, final=final, quick=not final)
    assert pytest.approx((0.43, 0.12), abs=2e-4) == (found["points"]["C"]["x"], found["points"]["C"]["y"])
    b = graphkin.solve("sixbar-420rpm").motion.position("B")[0]
    if final:
        links = tomllib.loads(found["text"])["links"]
        assert pytest.approx(abs(0.43 + 0.12j - b), abs=1e-4) == links["2"]["length"]
        assert "# coupler" in found["text"]
    else:
        assert {"links.2.length", "links.3.length"} == set(found["changes"])


def test_a_block_of_the_frame_is_pulled_along_its_guide() -> None:
    text = library_text("slider-crank-offset")
    found = answer(Shelf(), {"do": "pull", "text": text, "point": "C", "x": 120.0, "y": 90.0, "final": True})
    assert pytest.approx((120.0, 20.0), abs=0.1) == (found["points"]["C"]["x"], found["points"]["C"]["y"])
    b = graphkin.solve("slider-crank-offset").motion.position("B")[0] * 1e3
    assert pytest.approx(abs(120 + 20j - b), abs=0.1) == tomllib.loads(found["text"])["links"]["2"]["length"]


def test_a_pulled_point_of_the_frame_moves() -> None:
    found = told("pull", point="D", x=0.42, y=-0.21, final=True)
    assert [0.42, -0.21] == tomllib.loads(found["text"])["frame"]["points"]["D"]


def test_where_the_mechanism_does_not_reach_its_last_position_is_drawn_and_the_reason_said() -> None:
    text = library_text("sixbar-AE70")
    found = answer(Shelf(), {"do": "show", "text": text, "at": {"1": 100.0}, "figures": ["mechanism"]})
    assert found["ok"]
    assert pytest.approx(58.997, abs=0.01) == found["at"]["1"]
    assert "not assembled" in found["limit"]
    quick = {"do": "show", "text": text, "at": {"1": 100.0}, "quick": True, "language": "zh"}
    for moving in (True, False):
        found = answer(Shelf(), {**quick, "quick": moving})
        assert "不能装配" in found["limit"]
        assert "not assembled" not in found["limit"]
    assert "构件 4、5" in found["range"]["why"]


@pytest.mark.parametrize("quick", [True, False])
def test_the_motion_is_answeredwhere_a_load_has_no_stroke(quick: bool) -> None:
    text = changed(library_text("toggle-press-force"), {"links.1.length": 260, "driver.angle": 40, "flywheel": None,
                                                        "find": [], "sketch.B": [80, -230]})
    answered = answer(Shelf(), {"do": "show", "text": text, "figures": ["mechanism"], "quick": quick})
    assert answered["ok"], answered
    assert {"mechanism"} == set(answered["figures"])


@pytest.mark.parametrize(("chinese", "question"), [
    ('question："opne"；是否指“open”？', {"do": "opne"}),
    ("点 Q：没有这个点；可用的有：A、B、C、D、E、F", {"do": "pull", "point": "Q", "x": 1, "y": 2}),
    ("bar：起点与终点重合；请把它拖到别处", {"do": "build", "step": {"what": "bar", "from": [1, 2], "to": [1, 2]}}),
    ('"zz"：这里没有这个机构文件', {"do": "open", "name": "zz"}),
])
def test_what_is_refused_is_said_in_the_language_of_the_question(chinese: str, question: dict) -> None:
    found = answer(DESK, {"text": SIXBAR, "language": "zh", **question})
    assert found["problems"][0]["text"].startswith(chinese)


@pytest.mark.parametrize(("sentence", "question"), [
    ("the scene: found None; give its text", {"do": "show", "text": None}),
    ("at: found 'x'; give a number for each driver", {"do": "show", "at": {"1": "x"}}),
    ("at: found nan; give a number for each driver", {"do": "keep", "at": {"1": float("nan")}}),
    ("at: found True; give a number for each driver", {"do": "show", "at": {"1": True}}),
    ("pull: found 'a'; name a point and a place", {"do": "pull", "point": "B", "x": "a", "y": 0}),
    ("changes: found 7; give values by key", {"do": "change", "changes": 7}),
    ("angle: found 'x'; give degrees", {"do": "build", "step": {"what": "slider", "point": [1, 2], "angle": "x"}}),
    ("speed: found inf; give a finite number below 1e9",
     {"do": "build", "text": SIXBAR + "[sketch]\nB = [1, 2]",
      "step": {"what": "drive", "link": "1", "speed": float("inf")}}),
    ("piece: found []; say what to build", {"do": "build", "step": []}),
    ("complete: found None; give line and column", {"do": "complete", "line": 3}),
    ("variants: found 61; give a number from 1 to 60", {"do": "export", "kind": "variants", "count": 61}),
    ("figures: found 'sheet'", {"do": "show", "figures": "sheet"}),
])
def test_what_a_question_lacks_is_said_with_what_it_needs(sentence: str, question: dict) -> None:
    found = answer(DESK, {"text": SIXBAR, **question})
    assert [sentence] == [problem["text"] for problem in found["problems"]]


def test_what_the_page_leaves_out_or_sends_as_null_is_as_it_begins() -> None:
    plain = told("show", figures=["mechanism"])
    nulls = dict.fromkeys(("name", "at", "language", "convention", "instrument", "seed", "scales", "quick"))
    assert plain == told("show", figures=["mechanism"], **nulls, more="unknown")


def test_what_may_be_written_is_explained_in_the_language_of_the_question() -> None:
    lines = SIXBAR[: SIXBAR.index("[links.1]")].count("\n") + 2
    english, chinese = (told("complete", line=lines, column=0, language=language) for language in ("en", "zh"))
    details = {one["label"]: one["detail"] for one in english["options"]}
    assert "Distance of the two own points." == details["length"]
    assert "自身两点的距离" == {one["label"]: one["detail"] for one in chinese["options"]}["length"]


def test_the_page_is_told_in_which_sense_the_driver_moves() -> None:
    assert 1 == told("show")["drivers"][0]["sense"]
    clockwise = SIXBAR.replace("[driver]\n", '[driver]\nsense = "clockwise"\n')
    assert -1 == told("show", text=clockwise)["drivers"][0]["sense"]


def test_a_position_is_kept_in_the_file_with_its_assembly() -> None:
    text = told("keep", at={"1": 200.0})["text"]
    assert 200.0 == tomllib.loads(text)["driver"]["angle"]
    kept = graphkin.solve(tomllib.loads(text)).motion
    there = graphkin.solve("sixbar-420rpm", at=200).motion
    assert pytest.approx(complex(there.position("F")[0])) == complex(kept.position("F")[0])


LAW = library_text("fourbar-150-500-300-400").partition("[driver]")[0] + """[driver]
link = "1"
law  = { from = 20, pieces = [{ to = 0.5, rise = 90, by = "345" }, { to = 1, fall = 90, by = "harmonic" }] }
time = 0.75
"""
DEAD = library_text("sixbar-AE70").partition("[driver]")[0] + """[driver]
link  = "1"
from  = "dead point"
angle = 8
omega = 10
near  = -60
"""


@pytest.mark.parametrize(("text", "at"), [
    (LAW, None), (LAW, {"1": 70.0}), (DEAD, {"1": 12.0}), (library_text("geared-five-bar"), {"1": 140.0}),
    (library_text("double-butterfly"), {"2": 59.0}),
])
def test_a_position_is_kept_with_the_moment_of_a_law_drawn_lengths_and_starts_of_wheels(text: str, at: dict) -> None:
    kept = answer(Shelf(), {"do": "keep", "text": text, "at": at})
    asked, found = graphkin.solve(tomllib.loads(text), at=at), graphkin.solve(tomllib.loads(kept["text"]))
    for point in "BC":
        for value in ("position", "velocity"):
            there, here = (complex(getattr(each.motion, value)(point)[0]) for each in (asked, found))
            assert pytest.approx(there, rel=1e-7) == here


def test_a_driver_with_a_law_ranges_over_its_law() -> None:
    found = answer(Shelf(), {"do": "show", "text": LAW, "figures": []})["range"]
    assert (20.0, 110.0, False, "its law goes from 20° to 110°") == (*map(found.get, ("low", "high", "turns", "why")),)


@pytest.mark.parametrize("question", [{"do": "export", "kind": "svg"}, {"do": "pull", "point": "C", "x": 1, "y": 1}])
def test_a_position_that_is_not_reached_is_told_at_the_line_of_its_driver(question: dict) -> None:
    text = library_text("sixbar-AE70")
    found = answer(Shelf(), {"text": text, "at": {"1": 100.0}, **question})
    assert [text.splitlines().index("[driver]") + 1] == [problem["line"] for problem in found["problems"]]
    assert "driver 1 at 100°: not assembled" in found["problems"][0]["text"]


def built(*steps: dict) -> str:
    text = ""
    for step in steps:
        found = answer(Shelf(), {"do": "build", "text": text, "step": step})
        assert found["ok"], found
        text = found["text"]
    return text


def test_a_four_bar_is_built_from_nothing_and_agrees_with_its_check() -> None:
    text = built(
        {"what": "pivot", "at": [0, 0]}, {"what": "pivot", "at": [100, 0]},
        {"what": "bar", "from": "A", "to": [20, 30]}, {"what": "bar", "from": "C", "to": [110, 80]},
        {"what": "bar", "from": "B", "to": "D"},
        {"what": "point", "link": "2", "at": [60, 90]}, {"what": "drive", "link": "1"},
    )
    scene = tomllib.loads(text)
    assert graphkin.check(scene).ok
    motion = graphkin.solve(scene).motion
    assert pytest.approx(0.06 + 0.09j, abs=1e-6) == complex(motion.position("E")[0])


def test_a_slider_crank_and_a_quick_return_are_built() -> None:
    slider = built(
        {"what": "pivot", "at": [0, 0]}, {"what": "bar", "from": "A", "to": [30, 40]},
        {"what": "bar", "from": "B", "to": [150, 10]}, {"what": "slider", "point": "C", "angle": 0},
        {"what": "drive", "link": "1"},
    )
    assert graphkin.check(tomllib.loads(slider)).ok
    whitworth = built(
        {"what": "pivot", "at": [0, 0]}, {"what": "pivot", "at": [0, -100]},
        {"what": "bar", "from": "A", "to": [40, 30]},
        {"what": "slotted", "point": "B"}, {"what": "block", "point": "C", "link": "2"}, {"what": "drive", "link": "1"},
    )
    assert graphkin.check(tomllib.loads(whitworth)).ok


def test_what_is_built_so_far_shows_its_mobility_and_its_sketch() -> None:
    text = built({"what": "pivot", "at": [0, 0]}, {"what": "bar", "from": "A", "to": [20, 30]})
    found = answer(Shelf(), {"do": "show", "text": text})
    assert not found["ok"]
    assert {"A": [0.0, 0.0], "B": [20.0, 30.0]} == found["draft"]["points"]
    assert "F = 3·1 − 2·1 − 0 = 1; nothing drives it yet" == found["mobility"]


def test_what_too_few_drivers_move_is_told_as_undetermined() -> None:
    text = built(
        {"what": "pivot", "at": [0, 0]}, {"what": "bar", "from": "A", "to": [20, 30]},
        {"what": "bar", "from": "B", "to": [60, 30]}, {"what": "drive", "link": "1"},
    )
    told = answer(Shelf(), {"do": "show", "text": text})["mobility"]
    assert told.endswith("= 2, but the number of drivers is 1: it moves, but its motion is not determined")


@pytest.mark.parametrize("wrong", ['points = [["A", "B"], "C"]', "length = inf", "length = 2026-12-01"])
def test_what_no_name_or_number_of_json_can_be_is_told_as_any_other_error(wrong: str) -> None:
    found = answer(DESK, {"do": "show", "text": SIXBAR.replace("length = 0.34", f"{wrong} #")})
    assert not found["ok"]
    json.dumps(found, allow_nan=False)


@pytest.mark.parametrize("wrong", ["inf", "nan", "1" + "0" * 400])
def test_an_unfinished_mechanism_is_shown_without_numbers_that_no_scene_has(wrong: str) -> None:
    text = f"[frame]\npoints.A = [0, {wrong}]\nguides.h = {{ through = [1, 2], angle = {wrong} }}"
    found = answer(Shelf(), {"do": "show", "text": text})
    json.dumps(found, allow_nan=False)
    assert ({}, [{"through": [1, 2], "angle": 0.0}]) == (found["draft"]["points"], found["draft"]["guides"])


def test_a_pivot_of_an_unfinished_mechanism_lies_toward_the_point_that_it_names() -> None:
    text = """
    [frame.points]
    A = [0, 0]
    B = [0, 10]
    C = { from = "A", r = 5, toward = "B" }
    D = { from = "A", r = 2, toward = "B", angle = -90 }
    E = { from = "A", r = 2, toward = "F" }
    """
    points = answer(Shelf(), {"do": "show", "text": text})["draft"]["points"]
    assert (pytest.approx([0.0, 5.0]), pytest.approx([2.0, 0.0])) == (points["C"], points["D"])
    assert "E" not in points


def test_a_bar_between_two_new_points_names_them_apart() -> None:
    made = tomllib.loads(built({"what": "bar", "from": [0, 0], "to": [20, 30]}))
    assert ["A", "B"] == made["links"]["1"]["points"]
    assert {"A": [0.0, 0.0], "B": [20.0, 30.0]} == made["sketch"]


def test_what_is_deleted_takes_along_what_hung_on_it() -> None:
    text = built(
        {"what": "pivot", "at": [0, 0]}, {"what": "bar", "from": "A", "to": [20, 30]}, {"what": "drive", "link": "1"},
        {"what": "delete", "link": "1"},
    )
    assert not {"driver", "sketch"} & {k for k, v in tomllib.loads(text).items() if v}


SLIDER = """[frame]
points = { A = [0, 0], D = [0, 30] }
guides = { h = { through = "D", angle = 90 } }
[links.1]
points = ["A", "B"]
length = 15
at = { E = [10, 5] }
[links.2]
points = ["C"]
on = "0.h"
[links.3]
points = ["F"]
on = "0"
[sketch]
B = [9, 12]
C = [5, 40]
E = [2, 11]
F = [20, 4]
"""


@pytest.mark.parametrize(
    ("step", "changes"),
    [
        ({"what": "fix", "point": "E"}, {"frame.points.E": [2, 11], "sketch.E": None}),
        ({"what": "pin", "point": "E", "of": "1", "link": "2"}, {"pins": {"E": {"of": "1", "in": "2"}}}),
        ({"what": "drive", "link": "2"}, {"driver": {"slide": "2", "travel": 10.0, "velocity": 100.0}}),
        ({"what": "drive", "link": "3", "speed": 7}, {"driver": {"slide": "3", "travel": 20.0, "velocity": 7.0}}),
        ({"what": "delete", "point": "E"}, {"links.1.at.E": None, "sketch.E": None}),
        ({"what": "delete", "point": "D"}, {"frame.points.D": None}),
        ({"what": "delete", "point": "B"}, {"links.1": None, "sketch.B": None, "sketch.E": None}),
    ],
)
def test_a_piece_changes_what_it_names_and_nothing_else(step: dict, changes: dict) -> None:
    made = answer(Shelf(), {"do": "build", "text": SLIDER, "step": step})["text"]
    assert tomllib.loads(changed(SLIDER, changes)) == tomllib.loads(made)


@pytest.mark.parametrize(
    ("sentence", "question"),
    [
        ("point Q: has no place in the sketch", {"do": "build", "step": {"what": "fix", "point": "Q"}}),
        ("point Q: there is no such point", {"do": "build", "step": {"what": "pin", "point": "Q"}}),
        ("point Q: there is no such point", {"do": "build", "step": {"what": "delete", "point": "Q"}}),
        ('link "9": there is no such link', {"do": "build", "step": {"what": "drive", "link": "9"}}),
        ("link 2: has no axis of its own; give it two points first",
         {"do": "build", "step": {"what": "point", "link": "2", "at": [1, 2]}}),
        ("changes: found 501; at most 500 at once", {"do": "change", "changes": {f"A{i}": 1 for i in range(501)}}),
        ("links.1.length.x: links.1.length has nothing inside", {"do": "change", "changes": {"links.1.length.x": 3}}),
        ("frame.points.A.3: there is no item 3; it has 2, counted from 1",
         {"do": "change", "changes": {"frame.points.A.3": 3}}),
        ("the file: would be larger than 1000 kB", {"do": "change", "changes": {"title": "x" * 1_000_000}}),
        ("figure: there is nothing to draw; choose another figure", {"do": "export", "kind": "svg", "figures": []}),
    ],
)
def test_a_piece_or_change_that_cannot_be_is_told_in_a_sentence(sentence: str, question: dict) -> None:
    text = SIXBAR if question["do"] == "export" else SLIDER
    found = answer(Shelf(), {"text": text, **question})
    assert [sentence] == [one["text"][: len(sentence)] for one in found["problems"]]


def test_a_point_pulled_onto_what_it_is_measured_from_stays() -> None:
    text = changed(library_text("fourbar-150-500-300-400"), {"links.2.at.M": {"from": "B", "r": 20, "angle": 30}})
    pin = answer(Shelf(), {"do": "show", "text": text, "figures": []})["points"]["B"]
    found = answer(Shelf(), {"do": "pull", "text": text, "point": "M", "x": pin["x"], "y": pin["y"]})
    assert {"links.2.at.M.r": 20} == found["changes"]


def test_figures_over_the_turn_and_papers_are_handed_out(monkeypatch) -> None:
    monkeypatch.setattr("graphkin.table.have", lambda name: False)  # without Typst there are pages alone
    four_bar = library_text("fourbar-150-500-300-400")
    found = answer(Shelf(), {"do": "diagrams", "text": four_bar, "find": ["omega_3"]})
    assert ["diagram-omega_3"] == list(found["figures"])
    made = answer(Shelf(), {"do": "export", "text": four_bar, "kind": "papers", "name": "a.toml"})
    files = ["answers_template.csv", "handout.html", "key.csv", "key.html", "problem.html"]
    assert ("a-papers.zip", files) == (made["name"], ZipFile(BytesIO(b64decode(made["data"]))).namelist())


def test_all_pages_of_a_figure_are_handed_out() -> None:
    forces = {"do": "export", "text": library_text("sine-mechanism-forces"), "name": "e.toml", "figures": ["forces"]}
    made = answer(Shelf(), {**forces, "kind": "svg"})
    pages = ["e-forces.svg", "e-forces-2.svg"]
    assert ("e-forces.zip", pages) == (made["name"], ZipFile(BytesIO(b64decode(made["data"]))).namelist())
    assert "e-forces.pdf" == answer(Shelf(), {**forces, "kind": "pdf"})["name"]


def test_variants_of_which_none_can_be_made_are_refused_with_the_reason(monkeypatch) -> None:
    none = ProblemSet(mechanism_of(tomllib.loads(SIXBAR)), (Variant("01", why="no round numbers"),))
    monkeypatch.setattr("graphkin.api.classroom.problem_sets.problem_set", lambda *_, **__: none)
    assert "01: no round numbers" == asked("export", kind="variants")["problems"][0]["text"]


@pytest.mark.parametrize("wrong", ["links.1.points", "links.1.at", "links.1.guides", "frame.points", "frame.guides"])
def test_names_are_completed_beside_an_entry_that_is_none_yet(wrong: str) -> None:
    text = changed(SLIDER, {wrong: [[5]], "links.3.points": None})
    line = text.split("\n").index('on = "0"') + 1
    for key, offered in (("points", "C"), ("on", "1")):
        made = text.replace('on = "0"', f'{key} = ""')
        found = answer(Shelf(), {"do": "complete", "text": made, "line": line, "column": len(key) + 4})
        assert offered in [each["label"] for each in found["options"]]


def test_units_are_not_offered_as_the_length_of_a_link() -> None:
    text = '[units]\nlength = ""\n[links.1]\nlength = \n'
    offered = [answer(Shelf(), {"do": "complete", "text": text, "line": n, "column": 10})["options"] for n in (2, 4)]
    assert [["cm", "ft", "in", "m", "mm"], []] == [[each["label"] for each in some] for some in offered]


def test_keys_and_names_are_completed() -> None:
    keys = [one["label"] for one in told("complete", line=18, column=0)["options"]]
    assert {"points", "length", "on"} <= set(keys)
    line = SIXBAR.splitlines().index('on     = "6.h"') + 1
    assert {"6.h", "3"} <= {one["label"] for one in told("complete", line=line, column=10)["options"]}


def test_a_link_carries_the_scene() -> None:
    assert SIXBAR == text_of_link(told("link")["link"])
    assert SIXBAR == told("open", link=scene_link(SIXBAR))["text"]


@pytest.mark.parametrize("link", ["graphkin:", "graphkin:%%%", "graphkin:eJw", "x" * 5000])
def test_a_broken_link_is_refused_in_a_sentence(link: str) -> None:
    with pytest.raises(CallError, match="carries no scene"):
        text_of_link(link)


def test_a_link_that_would_unpack_to_gigabytes_is_refused() -> None:
    with pytest.raises(CallError, match="carries no scene"):
        text_of_link(scene_link("a" * 30_000_000))


@pytest.mark.parametrize("kind", ["svg", "pdf", "png", "dxf", "scene"])
def test_figures_and_scene_are_handed_out(kind: str) -> None:
    found = told("export", kind=kind, figures=["velocity"])
    assert found["name"].endswith("toml" if kind == "scene" else kind)
    assert len(found["data"]) > 500


@pytest.mark.parametrize("message", [
    None, 5, [], {}, {"do": 7}, {"do": "show"}, {"do": "show", "text": 5}, {"do": "show", "text": "x = ["},
    {"do": "show", "text": SIXBAR, "at": {"1": "x"}}, {"do": "show", "text": SIXBAR, "at": {"9": 1.0}},
    {"do": "show", "text": SIXBAR, "figures": ["x"]}, {"do": "show", "text": SIXBAR, "language": "xx"},
    {"do": "pull", "text": SIXBAR, "point": "Q", "x": 0, "y": 0},
    {"do": "pull", "text": SIXBAR, "point": "B", "x": "a"}, {"do": "change", "text": SIXBAR, "changes": 7},
    {"do": "change", "text": SIXBAR, "changes": {"links.2.length.x": 5}},
    {"do": "build", "text": SIXBAR, "step": {"what": "rocket"}},
    {"do": "build", "text": SIXBAR, "step": {"what": "bar"}},
    {"do": "open", "name": "../../etc/passwd"}, {"do": "save", "text": "", "name": "../x.toml"},
    {"do": "export", "text": SIXBAR, "kind": "exe"},
    {"do": "export", "text": SIXBAR, "kind": "variants", "count": 10**9},
    {"do": "complete", "text": SIXBAR, "line": -5, "column": 10**9}, {"do": "watch"}, {"do": "thumbnail"},
])
def test_every_wrong_message_is_told_what_is_wrong(message: object) -> None:
    found = answer(DESK, message)
    if isinstance(message, dict) and message.get("do") in ("complete", "watch"):
        assert found["ok"]
        return
    assert not found["ok"]
    assert all(one["text"] for one in found["problems"])


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_figure_has_its_name_on_the_page(language: str) -> None:
    found = told("names", language=language)
    assert all(f"figure {name}" in found["words"] for name in found["figures"])


def test_questions_of_the_page_are_those_that_are_answered() -> None:
    assert {"show", "pull", "save"} <= set(QUESTIONS)


@pytest.mark.parametrize("file", ["/etc/hostname", "../x.png", "sub/x.png", ".x.png", "x.png"])
@pytest.mark.parametrize("table", ["sheet.background", "scans.velocity"])
def test_a_scene_on_the_page_reads_no_file_from_elsewhere(file: str, table: str) -> None:
    text = SIXBAR + f'\n[{table}]\nfile = "{file}"\npoints = {{ A = [1, 2], D = [3, 4] }}\n'
    found = asked("show", text=text)
    assert "names files of its own folder" in found["problems"][0]["text"]


# files


def test_a_file_is_saved_whole_with_the_version_before_beside_it(tmp_path) -> None:
    path = tmp_path / "my.toml"
    path.write_text(SIXBAR, encoding="utf-8")
    shelf = Shelf.of(str(path))
    assert "my.toml" == shelf.first
    mark = shelf.save("my.toml", "title = 'x'\n", mark_of(SIXBAR))
    assert ("title = 'x'\n", SIXBAR) == (path.read_text(), (tmp_path / "my.toml~").read_text())
    assert mark == mark_of("title = 'x'\n")


def test_what_somebody_else_has_changed_is_not_overwritten(tmp_path) -> None:
    path = tmp_path / "my.toml"
    path.write_text(SIXBAR, encoding="utf-8")
    shelf = Shelf.of(str(path))
    path.write_text("title = 'theirs'\n", encoding="utf-8")
    assert "title = 'theirs'\n" == shelf.changed("my.toml", mark_of(SIXBAR))
    with pytest.raises(CallError, match="changed by somebody else"):
        shelf.save("my.toml", "title = 'mine'\n", mark_of(SIXBAR))
    assert "title = 'theirs'\n" == path.read_text()


@pytest.mark.parametrize("name", [
    "other.toml", "../my.toml", "my.toml~", ".hidden.toml", "a/b.toml", "/etc/x.toml", "",
])
def test_nothing_but_the_opened_file_is_written(tmp_path, name: str) -> None:
    (tmp_path / "my.toml").write_text(SIXBAR, encoding="utf-8")
    with pytest.raises(CallError):
        Shelf.of(str(tmp_path / "my.toml")).save(name, "x = 1\n", "")
    with pytest.raises(CallError):
        Shelf().save("my.toml", "x = 1\n", "")
    assert ["my.toml"] == [p.name for p in tmp_path.iterdir()]


def test_a_folder_takes_new_scene_files_but_no_path_out_of_it(tmp_path) -> None:
    shelf = Shelf.of(str(tmp_path))
    shelf.save("new.toml", SIXBAR, "")
    assert SIXBAR == (tmp_path / "new.toml").read_text()
    (tmp_path / "out.toml").symlink_to(tmp_path.parent / "elsewhere.toml")
    for name in ("../x.toml", "out.toml", "x.txt"):
        with pytest.raises(CallError):
            shelf.save(name, "x = 1\n", "")


@pytest.mark.parametrize("at", [29.9999999999, 30.0, 30.00000000000001, 30.0000000000001, 30.00000000001, 30.1])
def test_beside_a_limit_the_page_says_the_same_while_a_hand_moves_as_when_it_rests(at: float) -> None:
    scene = mechanism_of(
        {
            "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
            "links": {
                "1": {"points": ["A", "B"], "length": 100},
                "2": {"points": ["B", "C"], "length": 50},
                "3": {"points": ["C"], "on": "0.h"},
            },
            "driver": {"link": "1", "angle": 20, "omega": 10},
        }
    )
    moving, resting = (shown(scene, {"1": at}, FigureOptions(figures=("velocity",)), quick) for quick in (True, False))
    assert (resting["at"], resting["limit"]) == (moving["at"], moving["limit"])
    assert (at < 30) == (moving["limit"] == "")


def test_what_several_drivers_do_not_reach_is_told_alike_while_a_hand_moves_and_when_it_rests() -> None:
    bars = {"1": ("AB", 40), "2": ("BC", 60), "3": ("CD", 60), "4": ("ED", 40)}
    cranks = [{"link": "1", "angle": 90, "omega": 1}, {"link": "4", "angle": 90, "omega": 2}]
    scene = mechanism_of({
        "frame": {"points": {"A": [0, 0], "E": [100, 0]}}, "driver": cranks, "sketch": {"C": [50, 73]},
        "links": {name: {"points": [*ends], "length": long} for name, (ends, long) in bars.items()},
    })

    def why(quick: bool) -> str:
        with pytest.raises(graphkin.Unsolvable) as found:
            shown(scene, {"1": 200, "4": 0}, FigureOptions(figures=("velocity",)), quick)
        return str(found.value)

    assert why(False) == why(True)


def test_the_steps_on_the_page_are_read_aloud_in_its_language() -> None:
    found = told("show", language="zh")
    assert 'aria-label="B 的速度"' in "".join(step["html"] for step in found["steps"])


def test_the_page_offers_each_language_by_its_own_name() -> None:
    assert {"en": "English", "zh": "中文"} == told("names", language="zh")["languages"]


def test_the_languages_of_a_sheet_are_completed() -> None:
    options = told("complete", text='[sheet]\nlanguage = ', line=2, column=11)["options"]
    assert ['"en"', '"zh"'] == [option["label"] for option in options]


@pytest.mark.parametrize("message", [
    {"do": "link", "text": "\ud800"}, {"do": "save", "name": "mine.toml", "text": "\ud800"},
    {"do": "change", "text": SIXBAR, "changes": {"title": "\ud800"}},
])
def test_half_a_character_is_refused_in_words(message):
    found = answer(Shelf(), message)
    assert not found["ok"]
    assert "\\ud800" in found["problems"][0]["text"]


def test_a_point_that_does_not_exist_is_not_said_to_follow_from_others():
    found = answer(Shelf(), {"do": "pull", "text": SIXBAR, "point": "Q", "x": 1, "y": 2})
    assert "point Q: there is no such point; known here: A, B, C, D, E, F" == found["problems"][0]["text"]
