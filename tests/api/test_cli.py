"""The command line as a user meets it: what is printed, what is written, and the exit status."""

from __future__ import annotations

import csv
import io
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from types import SimpleNamespace

import pytest

from graphkin.cli.output import plain_table, print_table, progress_bar
from tests import EVERYTHING
from tests.command import run, start

SIXBAR = "sixbar-guide-40deg"


HELP_ONLY = """
import sys
sys.argv = ["graphkin", "--help"]
from graphkin.cli import main
try:
    main()
except SystemExit:
    pass
assert "numpy" not in sys.modules
"""


def test_help_imports_no_numpy():
    done = subprocess.run([sys.executable, "-c", HELP_ONLY], capture_output=True, text=True)
    assert 0 == done.returncode, done.stderr


def test_importing_graphkin_imports_no_numpy():
    done = subprocess.run([sys.executable, "-c", "import sys, graphkin; assert 'numpy' not in sys.modules"])
    assert 0 == done.returncode


@pytest.mark.parametrize(
    "args",
    [
        ("draw", SIXBAR, "-o", "out"),
        ("handout", "no-such-scene"),
        *([
            ("check", SIXBAR, "--find", "a_D"),
            ("sweep", "sine-mechanism", "--positions", "4", "--json", "-o", "out"),
            ("scenes", "--json"),
            ("solve", "sixbar-AE70", "--at", "80", "--json"),
            ("centres", SIXBAR, "--json"),
            ("audit", "shaper-scheme-2"),
            ("study", "speed-accuracy", "no-such-scene"),
        ] if EVERYTHING else []),
    ],
    ids=lambda args: args[0],
)
def test_a_command_says_in_a_process_of_its_own_what_it_says_here(args, tmp_path):
    here, there = run(*args, cwd=tmp_path), start(*args, cwd=tmp_path)
    assert (here.returncode, here.stdout, here.stderr) == (there.returncode, there.stdout, there.stderr)


def test_a_table_in_a_file_is_that_of_a_terminal_wide_enough(monkeypatch):
    heads, rows = ["quantity", "量", ""], [["v_B", "1.25", "ok"], ["角速度", "-1000", "off"]]
    shown = io.StringIO()
    monkeypatch.setattr(shown, "isatty", lambda: True)
    monkeypatch.setattr(sys, "stdout", shown)
    monkeypatch.setenv("COLUMNS", "200")
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("TERM", "dumb")
    print_table(heads, rows, right=(1,))
    assert shown.getvalue() == plain_table(heads, rows, right=(1,)) + "\n"


def test_a_bar_shows_what_is_done_of_all_once_the_work_takes_a_second(monkeypatch, tmp_path):
    shown, clock = io.StringIO(), [0.0]
    monkeypatch.setattr(shown, "isatty", lambda: True)
    monkeypatch.setattr(sys, "stderr", shown)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr("graphkin.cli.output.time", SimpleNamespace(monotonic=lambda: clock[0]))

    def work(count):
        count(1, 40)
        assert "" == shown.getvalue()
        clock[0] = 1.1
        count(30, 40)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), progress_bar(True, tmp_path) as count:
        work(count)
    assert "30/40" in shown.getvalue()
    assert f"interrupted; what is done is kept in {tmp_path}" in shown.getvalue().replace("\n", "")


@pytest.mark.parametrize("shown", [True, False], ids=["in a file", "asked to be quiet"])
def test_no_bar_is_shown_where_nobody_looks(shown, monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: not shown)
    with progress_bar(shown) as count:
        assert count is None


def test_a_row_of_a_table_in_a_file_is_one_line_however_long():
    assert 5 == len(plain_table(["a", "b"], [["1", "x" * 500 + "\n" + "y" * 500]]).splitlines())


def loaded(*call: str) -> set[str]:
    """All modules that a process of its own has loaded when the command has ended."""
    program = "import sys, atexit; atexit.register(lambda: print(*sys.modules, file=sys.stderr)); "
    program += "from graphkin.cli import main; main()"
    done = subprocess.run([sys.executable, "-c", program, *call], capture_output=True, text=True, check=True)
    return set(done.stderr.split())


def test_a_check_waits_for_no_room_that_its_scene_does_not_need():
    rooms = ["forces", "centres", "limits", "measures", "trial", "cams_in_place", "rolling_on_paper"]
    idle = {f"graphkin.construction.{room}" for room in rooms}
    idle |= {"graphkin.drawing", "graphkin.study", "graphkin.api.drawn", "graphkin.papers", "multiprocessing"}
    idle |= {"matplotlib", "pyarrow", "rich.console", "scipy", "shapely", "svgwrite"}
    assert set() == idle & loaded("check", "shaper-scheme-2")


def test_a_sweep_without_figures_waits_for_no_drawing_board():
    program = "import graphkin, sys; s = graphkin.sweep('shaper-scheme-2'); s.table, s.data; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert set() == {"graphkin.construction", "graphkin.drawing", "matplotlib"} & set(done.stdout.split())


def test_the_version_is_printed():
    assert run("--version").stdout.startswith("graphkin ")


def test_scenes_lists_every_scene_with_its_mobility():
    rows = json.loads(run("scenes", "--json").stdout)
    assert {"name": SIXBAR, "mobility": 1}.items() <= next(r for r in rows if r["name"] == SIXBAR).items()


def test_scenes_copies_one_out_and_the_copy_checks(tmp_path):
    assert 0 == run("scenes", SIXBAR, "my.toml", "--copy", cwd=tmp_path).returncode
    assert 0 == run("check", "my.toml", cwd=tmp_path).returncode


def test_scenes_overwrites_no_file(tmp_path):
    (tmp_path / "my.toml").write_text("mine")
    assert 2 == run("scenes", SIXBAR, "my.toml", "--copy", cwd=tmp_path).returncode
    assert "mine" == (tmp_path / "my.toml").read_text()


def test_draw_writes_figures_readings_and_report(tmp_path):
    done = run("draw", SIXBAR, "-o", "out", cwd=tmp_path)
    assert 0 == done.returncode, done.stderr
    names = {p.name for p in (tmp_path / "out").iterdir()}
    assert {"mechanism.svg", "velocity.svg", "acceleration.svg", "sheet.svg", "readings.csv", "report.txt"} <= names


def test_draw_writes_to_a_folder_named_like_the_scene_and_nowhere_else(tmp_path):
    run("draw", SIXBAR, cwd=tmp_path)
    assert [SIXBAR] == [p.name for p in tmp_path.iterdir()]


def test_b3_lies_107_578_mm_from_the_pole_in_the_svg_itself(tmp_path):
    run("draw", SIXBAR, "-o", "out", cwd=tmp_path)
    tree = ET.parse(tmp_path / "out" / "velocity.svg")
    group = next(g for g in tree.iter("{http://www.w3.org/2000/svg}g") if g.get("id") == "v_B3")
    line = group[0]
    x1, y1, x2, y2 = (float(line.get(k)) for k in ("x1", "y1", "x2", "y2"))
    assert 107.578 == pytest.approx(((x2 - x1) ** 2 + (y2 - y1) ** 2) ** 0.5, abs=2e-3)


def test_the_readings_are_a_table(tmp_path):
    run("draw", SIXBAR, "-o", "out", cwd=tmp_path)
    rows = {r["symbol"]: r for r in csv.DictReader((tmp_path / "out" / "readings.csv").open())}
    assert 482.722 == pytest.approx(float(rows["v_D"]["measured"]), abs=1e-3)


def test_the_report_tells_every_step(tmp_path):
    run("draw", SIXBAR, "-o", "out", "--lang", "zh", cwd=tmp_path)
    text = (tmp_path / "out" / "report.txt").read_text(encoding="utf-8")
    assert "哥氏加速度" in text


@pytest.mark.parametrize("command", ["draw", "centres"])
def test_figures_speak_both_languages_on_one_sheet(tmp_path, command):
    run(command, SIXBAR, "-o", "out", "--lang", "both", cwd=tmp_path)
    figure = (tmp_path / "out" / "centres.svg").read_text(encoding="utf-8")
    assert {"Instant centres", "速度瞬心"} == {w for w in ("Instant centres", "速度瞬心") if w in figure}


@pytest.mark.parametrize("command", ["draw", "centres"])
def test_figures_in_both_languages_come_with_an_english_report(tmp_path, command):
    done = run(command, SIXBAR, "-o", "out", "--lang", "both", cwd=tmp_path)
    assert "agree with the analytic solution" in done.stdout, done.stderr


def test_a_report_has_one_language():
    said = run("check", SIXBAR, "--lang", "both").stderr.splitlines()
    assert ['graphkin: lang: "both"; known here: en, zh', 'graphkin: lang："both"；可用的有：en、zh'] == said


def test_the_same_scene_gives_the_same_bytes(tmp_path):
    run("draw", SIXBAR, "-o", "one", cwd=tmp_path)
    run("draw", SIXBAR, "-o", "two", cwd=tmp_path)
    one, two = ({p.name: p.read_bytes() for p in (tmp_path / n).iterdir()} for n in ("one", "two"))
    assert one == two


def test_solve_prints_the_contract_s_object():
    data = json.loads(run("solve", SIXBAR, "--json").stdout)
    assert {"length": "mm", "time": "s", "angle": "rad"} == data["units"]
    position = data["positions"][0]
    assert ("ok", -2.81912) == (position["status"], pytest.approx(position["links"]["3"]["omega"], abs=1e-5))
    assert 381.602 == pytest.approx(position["slides"]["2/3"]["travel"], abs=1e-3)


def test_a_sweep_gives_as_many_positions():
    assert 12 == len(json.loads(run("solve", SIXBAR, "--sweep", "12", "--json").stdout)["positions"])


def test_at_moves_the_named_driver():
    data = json.loads(run("solve", SIXBAR, "--at", "1=20", "--json").stdout)
    assert 0.34906585 == pytest.approx(data["positions"][0]["driver"]["1"])


def test_a_position_out_of_reach_is_status_3_with_the_object_printed():
    done = run("solve", "sixbar-AE70", "--at", "80", "--json")
    assert (3, "not assembled") == (done.returncode, json.loads(done.stdout)["positions"][0]["status"])
    assert "58.997" in done.stderr


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (("check", "no-such-scene"), "no-such-scene"),
        (("check", SIXBAR, "--find", "v_Q"), "Q"),
        (("check", SIXBAR, "--at", "fifty"), "fifty"),
        (("check", SIXBAR, "--at", "9=50"), "9"),
        (("draw", SIXBAR, "--format", "bmp"), "bmp"),
        (("draw", SIXBAR, "--lang", "tlh"), "tlh"),
        (("draw", SIXBAR, "--convention", "martian"), "martian"),
        (("check", SIXBAR, "--instrument", "crayon"), "crayon"),
        (("solve", SIXBAR, "--sweep", "0"), "0"),
    ],
)
def test_a_wrong_call_is_status_2_and_a_sentence(args, said, tmp_path):
    done = run(*args, cwd=tmp_path)
    assert 2 == done.returncode
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    assert [] == list(tmp_path.iterdir())


def test_all_problems_of_a_file_are_told_at_once(tmp_path):
    (tmp_path / "bad.toml").write_text(
        '[links.1]\npoints = ["A", "B"]\nlenght = -5\n[driver]\nlink = "7"\nomega = 1\nrpm = 2\n'
    )
    done = run("check", "bad.toml", cwd=tmp_path)
    assert 2 == done.returncode
    assert 'did you mean "length"' in done.stderr
    assert len(done.stderr.splitlines()) >= 3


def test_a_truss_is_refused_as_immobile(tmp_path):
    text = """
    [frame]
    points = { A = [0, 0], B = [100, 0] }
    [links.1]
    points = ["A", "C"]
    length = 80
    [links.2]
    points = ["B", "C"]
    length = 80
    [driver]
    link = "1"
    angle = 50
    omega = 1
    """
    (tmp_path / "truss.toml").write_text(text)
    done = run("check", "truss.toml", "--instrument", "pencil", "--json", cwd=tmp_path)
    assert 3 == done.returncode
    assert "mobility" in done.stderr
    assert "pencil" == json.loads(done.stdout)["instrument"]


NO_DRIVER = '[frame]\npoints = { A = [0, 0] }\n[links.1]\npoints = ["A", "B"]\nlength = 80\n'


def test_solve_prints_its_object_for_a_wrong_mobility_too(tmp_path):
    (tmp_path / "loose.toml").write_text(NO_DRIVER)
    done = run("solve", "loose.toml", "--json", cwd=tmp_path)
    assert 2 == done.returncode
    data = json.loads(done.stdout)
    assert 1 == data["mobility"]
    assert "no driver" in data["positions"][0]["why"]


@pytest.mark.parametrize("command", ["solve", "check", "draw", "centres", "sweep", "handout", "explain"])
def test_a_file_without_a_driver_is_at_fault_and_told_what_to_write(command, tmp_path):
    (tmp_path / "loose.toml").write_text(NO_DRIVER)
    done = run(command, "loose.toml", cwd=tmp_path)
    assert 2 == done.returncode
    assert "[driver]" in done.stderr


@pytest.mark.parametrize("command", ["solve", "check", "draw"])
def test_an_unknown_language_and_an_unknown_convention_are_told(command, tmp_path):
    for option, word in (("--lang", "de"), ("--convention", "german")):
        done = run(command, SIXBAR, option, word, cwd=tmp_path)
        assert 2 == done.returncode
        assert f'"{word}"; known here' in done.stderr
    assert [] == list(tmp_path.iterdir())


def test_check_and_solve_write_what_they_found_into_the_folder_given(tmp_path):
    assert 0 == run("check", SIXBAR, "-q", "-o", "out", cwd=tmp_path).returncode
    assert 0 == run("solve", SIXBAR, "-q", "-o", "out", cwd=tmp_path).returncode
    assert {"readings.csv", "report.txt", "solution.json"} == {p.name for p in (tmp_path / "out").iterdir()}


@pytest.mark.parametrize("asked", [(), ("--find", "a_C", "--find", "alpha_2", "--find", "at_C/B")])
@pytest.mark.parametrize("at", [0, 90, 180, 270])
def test_solve_prints_no_number_that_its_bound_does_not_tell_from_zero(asked, at):
    printed = run("solve", "slider-crank-offset", "--at", str(at), *asked).stdout
    assert [] == re.findall(r"\S*e-\d+|-0(?![.\d])", printed)
    assert "313.994" in printed or at != 90


def test_solve_speaks_chinese():
    assert "角加速度" in run("solve", SIXBAR, "--lang", "zh").stdout


@pytest.mark.parametrize("name", [SIXBAR, "double-butterfly", "hit16-double-guide", "triad-slider"])
def test_assemblies_of_groups_are_told_in_chinese_without_english(name):
    said = [line for line in run("solve", name, "--lang", "zh").stdout.splitlines() if "级杆组" in line]
    assert said
    assert [] == [line for line in said if re.search(r"[a-z]{2,}", line)]


def test_a_larger_group_is_drawn_and_how_is_said():
    done = run("check", "double-butterfly", "--json")
    assert 0 == done.returncode
    assert "superposition" == json.loads(done.stdout)["construction"]


@pytest.mark.parametrize(
    "call", [("check", "sixbar-guide-40deg"), ("check", "cam-flat-face"), ("solve", "oldham-coupling", "--sweep", "12")]
)
def test_zero_has_no_sign_in_what_programs_read(call):
    assert [] == re.findall(r"-0\.0(?![0-9e])", run(*call, "--json").stdout)


@pytest.mark.parametrize(
    ("call", "status", "problem"),
    [
        (("check", "broken.toml"), "scene", ("links.1.length", "found -3, a negative length", "found a negative")),
        (("check", "slider-crank-offset", "--find", "v_Q"), "call",
         ("find v_Q", 'there is no point "Q"', "there is no point")),
        (("solve", "shaper-scheme-2", "--at", "x"), "call", ("--at x", '"x" is no number', "is no number")),
    ],
)
@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_program_reads_what_is_wrong(tmp_path, call, status, problem, language):
    links = 'points = ["A", "B"]\nlength = -3\n'
    (tmp_path / "broken.toml").write_text(f"[frame]\npoints = {{ A = [0, 0] }}\n[links.1]\n{links}")
    call = [str(tmp_path / word) if word.endswith(".toml") else word for word in call]
    done = run(*call, "--json", "--lang", language)
    data = json.loads(done.stdout)
    told = data["problems"][0]
    assert (2, False, status) == (done.returncode, data["ok"], data["status"])
    assert problem == (told["where"], told["found"], told["id"])
    assert done.stderr.startswith("graphkin: ")


def test_a_program_reads_the_problems_of_what_cannot_be_assembled():
    done = run("check", "hydraulic-cylinder", "--at", "5000", "--json")
    data = json.loads(done.stdout)
    assert (3, "not assembled") == (done.returncode, data["status"])
    assert [["where", "found", "wanted", "id"]] == [list(problem) for problem in data["problems"]]


@pytest.mark.parametrize(("scene", "missing"), [("slider-crank-offset", "forces"), ("cam-flat-face", "")])
def test_a_figure_that_is_asked_for_and_cannot_be_drawn_is_told(tmp_path, scene, missing):
    done = run("draw", scene, "--figure", missing or "cam", "-o", str(tmp_path))
    told = f"graphkin: figure {missing}: the scene has nothing of it to draw\n" if missing else ""
    assert (0, told) == (done.returncode, done.stderr)


def test_a_sweep_names_the_files_that_it_wrote_and_no_others(tmp_path):
    (tmp_path / "mine.txt").write_text("kept")
    done = run("sweep", "four-bar-coupler-point", "--positions", "4", "-o", ".", cwd=tmp_path)
    assert 0 == done.returncode, done.stderr
    assert "\ntable.csv" in done.stdout
    assert "mine.txt" not in done.stdout


@pytest.mark.parametrize("values", ["a,b", "1:2", "-5"])
def test_designs_that_are_no_scenes_are_a_wrong_call(tmp_path, values):
    call = ["sweep", "four-bar-coupler-point", "--set", f"links.1.length={values}", "-o", "out"]
    done = run(*call, cwd=tmp_path)
    assert 2 == done.returncode
    assert f"links.1.length: found {values.split(',')[0]}" in done.stderr.replace('"', "")


@pytest.mark.parametrize("call", [["solve"], ["study", "stability"], []])
def test_h_is_short_for_help(call):
    assert run(*call, "--help").stdout == run(*call, "-h").stdout != ""


@pytest.mark.parametrize(
    ("call", "where", "found"),
    [
        (["solve", SIXBAR, "--bogus"], "graphkin solve", "No such option: --bogus"),
        (["solve"], "graphkin solve", "Missing argument"),
        (["solve", SIXBAR, "--sweep", "x"], "graphkin solve", "Invalid value for '--sweep'"),
        (["bogus"], "graphkin", "No such command 'bogus'"),
    ],
)
@pytest.mark.parametrize("language", [[], ["--lang", "zh"]])
def test_a_program_reads_what_is_wrong_with_its_options(call, where, found, language):
    done = run(*call, "--json", *language)
    said = json.loads(done.stdout)
    assert (2, False, "call") == (done.returncode, said["ok"], said["status"])
    (problem,) = said["problems"]
    assert where == problem["where"]
    assert problem["found"].startswith(found)
    assert problem["id"]
    assert done.stderr


@pytest.mark.parametrize("call", [[], [SIXBAR], ["--schema"], ["--new", "four-bar"], [SIXBAR, "--copy"]])
def test_quiet_scenes_print_nothing(call, tmp_path):
    assert ("", "", 0) == ((done := run("scenes", *call, "-q", cwd=tmp_path)).stdout, done.stderr, done.returncode)


def test_a_quiet_explanation_says_whether_there_is_a_mechanism():
    assert ("", 0) == ((done := run("explain", SIXBAR, "-q")).stdout, done.returncode)


def test_scenes_tell_a_program_what_was_written(tmp_path):
    copied = run("scenes", SIXBAR, "mine.toml", "--copy", "--json", cwd=tmp_path)
    assert {"files": ["mine.toml"]} == json.loads(copied.stdout)
    assert (tmp_path / "mine.toml").read_text("utf-8") == json.loads(run("scenes", SIXBAR, "--json").stdout)["text"]


def test_a_printed_value_that_is_none_is_told_in_chinese(tmp_path):
    scene = run("scenes", "four-bar-coupler-point").stdout + '\n[printed]\nv_C = "fast"\n'
    (tmp_path / "s.toml").write_text(scene, encoding="utf-8")
    told = run("audit", "s.toml", "--lang", "zh", cwd=tmp_path).stderr
    assert "printed.v_C：“fast”不是数" in told


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (["solve", "slider-crank-stroke-50"], "it is a design file: write graphkin design slider-crank-stroke-50"),
        (["design", SIXBAR], f"{SIXBAR}: is a scene, no design file"),
        (["check", "task.toml"], "design: unknown table; it is a design file"),
    ],
)
def test_a_design_and_a_scene_are_told_apart(call, told, tmp_path):
    (tmp_path / "task.toml").write_text('[design]\nkind = "slider-crank"\nstroke = 50\nK = 1.2\n')
    done = run(*call, cwd=tmp_path)
    assert (2, "") == (done.returncode, done.stdout)
    assert told in done.stderr


UNMOVABLE = """
[frame]
points = { A = [0, 0], D = [100, 0] }
[links.1]
points = ["A", "B"]
length = 80
[links.2]
points = ["B", "C"]
length = 50
[links.3]
points = ["D", "C"]
length = 60
[driver]
link = "1"
angle = 150
omega = 3
[printed]
omega_3 = 2
"""


@pytest.mark.parametrize(
    "call",
    [["solve"], ["solve", "--sweep", "2"], ["check"], ["draw"], ["centres"], ["centres", "--centrode", "2"], ["audit"],
     ["handout"], ["handout", "--template", "course-design"], ["sweep"], ["sweep", "--set", "links.1.length=85"]],
)
def test_a_program_reads_why_what_it_asked_cannot_be_solved(call, tmp_path):
    (tmp_path / "s.toml").write_text(UNMOVABLE)
    done = run(call[0], "s.toml", *call[1:], "--json", cwd=tmp_path)
    said = json.loads(done.stdout)
    assert (3, False, "not assembled") == (done.returncode, said["ok"], said["status"])
    assert {"where", "found", "wanted", "id"} == set(said["problems"][0])


def test_a_program_reads_why_a_mechanism_that_is_explained_cannot_move(tmp_path):
    strut = '[links.4]\npoints = ["A", "C"]\nlength = 70'
    (tmp_path / "s.toml").write_text(UNMOVABLE.replace("[printed]\nomega_3 = 2", strut))
    said = json.loads(run("explain", "s.toml", "--json", cwd=tmp_path).stdout)
    assert (False, "mobility") == (said["ok"], said["status"])
    assert said["problems"]


@pytest.mark.parametrize(
    ("args", "said"),
    [
        ("solve shaper-forces --position 3 --at 20", "--position: stands beside --at; write one of the two"),
        ("solve {} --at 1=50 --at 1=60", "--at: 1=60 is given twice for one driver; write --at 1=50 --at 2=30"),
        ("solve {} --at 50 --at 1=60", "--at: a bare value beside named ones; write --at 1=50 --at 2=30"),
        ("centres {} --motion --centrode 2", "--motion: stands beside --centrode; write one of the two"),
        ("sweep {} --set links.1.length", "--set links.1.length: says no key or no values; write --set"),
        ("sweep {} --set links.1.length=1 --set links.1.length=3",
         "--set links.1.length=3: the key is given twice; write KEY=40,50,60"),
        ("audit {} --grading equations", 'grading: "equations"; write equations=20,drawing=30,values=50'),
        ("handout {} --template course-design --export moodle",
         "template course-design: with --export; leave one of them out"),
        ("handout {} --students a.csv", "students: without a course design; add --template course-design"),
        ("handout {} --variants 3 --at 20",
         "variants: with --at or --positions; a set draws positions of its own, one each"),
        ("scenes --copy", "--copy: no scene is named; write graphkin scenes NAME --copy"),
        ("convert {} -o a.ggb", 'convert: ".ggb" is of no program that is written here; known: .toml, .linkage2'),
    ],
)
def test_options_that_do_not_go_together_are_refused_in_a_sentence(args: str, said: str):
    answer = run(*args.format("fourbar-150-500-300-400").split())
    assert (2, f"graphkin: {said}") == (answer.returncode, answer.stderr[: len(said) + 10])


@pytest.mark.parametrize(("command", "key"), [("convert", "scene"), ("explain", "links")])
def test_with_json_an_object_is_printed(command: str, key: str):
    assert key in json.loads(run(command, "fourbar-150-500-300-400", "--json").stdout)
