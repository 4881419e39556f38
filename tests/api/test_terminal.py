"""Where a command prints to: pipes that close, disks that are full, terminals, and those who interrupt."""

from __future__ import annotations

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import pytest
import tomlkit

import graphkin
from graphkin.cli.output import print_table

from ..command import PROGRAM, run
from ..scenes import four_bar

SIXBAR = "sixbar-guide-40deg"
CALL = [*PROGRAM, "check", SIXBAR]
POSIX = pytest.mark.skipif(sys.platform == "win32", reason="pipes, signals and /dev/full of POSIX")


@POSIX
def test_a_reader_that_goes_away_changes_nothing() -> None:
    reads, writes = os.pipe()
    os.close(reads)
    ended = subprocess.run(CALL, stdout=writes, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writes)
    assert (0, "") == (ended.returncode, ended.stderr)


@POSIX
def test_a_full_disk_under_what_is_printed_is_a_sentence() -> None:
    with open("/dev/full", "w") as full:
        ended = subprocess.run(CALL, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    said = "graphkin: what is printed cannot be written: No space left on device\n"
    assert (2, said) == (ended.returncode, ended.stderr)


@POSIX
@pytest.mark.parametrize("module", ["typer", "graphkin.cli.verbs", "numpy", "graphkin.construction.plan"])
def test_an_interruption_while_a_command_loads_ends_it_without_a_traceback(module: str) -> None:
    interrupting = f"""
import os, signal, sys
class Interrupting:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Interrupting())
from graphkin.cli import main
main()
"""
    call = [sys.executable, "-c", interrupting, "check", SIXBAR]
    ended = subprocess.run(call, capture_output=True, text=True, check=False)
    assert (130, "") == (ended.returncode, ended.stdout)
    assert "Traceback" not in ended.stderr


@pytest.mark.parametrize("bad", ["\x1b[2J", "\x9b31m", "\u202e", "\x7f"])
def test_control_characters_of_a_file_never_reach_the_terminal(tmp_path: Path, bad: str) -> None:
    quoted = json.dumps(bad).replace("\x7f", "\\u007f").replace("\x9b", "\\u009b")
    (tmp_path / "bad.toml").write_text(f'title = "a"\n[links.{quoted}]\npoints = ["A", {quoted}]\n', encoding="utf-8")
    said = run("check", str(tmp_path / "bad.toml"))
    assert 2 == said.returncode
    assert bad not in said.stderr
    assert "is no name" in said.stderr


@POSIX
def test_an_interruption_that_comes_while_an_object_is_deleted_is_not_lost() -> None:
    lost = """import signal, time
from graphkin.cli import commands
class Deleted:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)
def command(interrupted):
    Deleted()
    time.sleep(20)
commands._run = command
commands.main(signal.default_int_handler)"""
    begin = time.monotonic()
    ended = subprocess.run([sys.executable, "-c", lost], capture_output=True, text=True, check=False)
    assert (130, "") == (ended.returncode, ended.stderr)
    assert time.monotonic() - begin < 20.0


@POSIX
def test_a_sweep_that_is_interrupted_twice_ends_at_once_with_all_its_processes(tmp_path: Path) -> None:
    varied = "links.2.length=80:100:4000"
    call = [*PROGRAM, "sweep", "slider-crank-offset", "--set", varied, "--workers", "2", "-o", "out"]
    with subprocess.Popen(call, cwd=tmp_path, stderr=subprocess.PIPE, text=True, start_new_session=True) as program:
        deadline = time.monotonic() + 30
        while not list(tmp_path.glob("out/.sweep-*/0*")) and time.monotonic() < deadline:
            time.sleep(0.02)
        begin = time.monotonic()
        for _ in range(2):
            os.killpg(program.pid, signal.SIGINT)
            time.sleep(0.01)
        # a process that lives on would hold the pipe of stderr open
        said = program.communicate(timeout=20)[1]
        assert time.monotonic() - begin < 5.0  # less than one, where nothing else runs
    assert 130 == program.returncode
    told = "graphkin: interrupted; what is done is kept in out, the same command goes on\n"
    assert said in ("", told)


@POSIX
@pytest.mark.parametrize(
    ("call", "locale", "title"),
    [
        ((), "C.UTF-8", "Slotter: swinging"),
        (("--lang", "zh"), "C.UTF-8", "插床导杆机构"),
        ((), "zh_CN.UTF-8", "插床导杆机构"),
        (("--lang", "en"), "zh_CN.UTF-8", "Slotter: swinging"),
    ],
)
def test_scenes_are_listed_in_eighty_columns_with_their_titles_in_one_language(call, locale, title) -> None:
    import pty

    from rich.cells import cell_len

    master, slave = pty.openpty()
    shell = {**os.environ, "COLUMNS": "80", "LC_ALL": locale, "PYTHONUTF8": "1", "TERM": "dumb"}
    with subprocess.Popen([*PROGRAM, "scenes", *call], stdout=slave, env=shell) as program:
        os.close(slave)
        shown = b""
        with contextlib.suppress(OSError):  # the other end is closed
            while part := os.read(master, 65536):
                shown += part
    assert 0 == program.returncode
    lines = shown.decode().splitlines()
    assert max(map(cell_len, lines)) <= 80
    (row,) = [line for line in lines if " slotter-75-150 " in line]
    assert title in row
    assert ("插床" in row) == ("插床" in title)


def test_a_table_loses_nothing_in_eighty_columns(capsys, monkeypatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("TERM", "dumb")
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    audited = graphkin.audit(SIXBAR)
    for rows in ([audited.heads, *audited.rows], [["文件名", "名称", "F"], ["loader-cylinder", "装载机构" * 20, "2"]]):
        print_table(rows[0], rows[1:])
        shown = Counter(capsys.readouterr().out)
        assert Counter("".join(map("".join, rows)).replace(" ", "")) == shown - Counter({c: shown[c] for c in " ─\n"})


NUMBER = re.compile(r"[-−]?\d+(\.\d+)?(e-?\d+)?(, -?\d+(\.\d+)?(e-?\d+)?)?")
UNIT = re.compile(r"(mm|cm|m|deg|rad|N m|kN m|kN|N|kg m2)(/s2?)?|")


def without_unit(printed: str) -> list[str]:
    """The numbers in printed tables that have no unit, in the head of their column or in their row."""
    wrong, heads, lines = [], None, printed.splitlines()
    for k, line in enumerate(lines):
        if k + 1 < len(lines) and set(lines[k + 1].strip()) == {"─"}:
            heads = re.split(r"\s{2,}", line.strip())
        elif not line.strip():
            heads = None
        elif heads and "─" not in line:
            cells = re.split(r"\s{2,}", line.strip())
            beside = any(UNIT.fullmatch(cell) and cell for cell in cells)
            wrong += [
                line for i, cell in enumerate(cells[1:], 1)
                if NUMBER.fullmatch(cell) and not beside and (i >= len(heads) or "(" not in heads[i])
            ]
    return wrong


@pytest.mark.parametrize(
    "command",
    [
        ["solve", "boom-lifted"], ["solve", "shaper-forces", "--sweep", "2"], ["check", "boom-lifted"],
        ["solve", "sixbar-guide-40deg", "--find", "v_D", "--find", "theta_3"], ["audit", "shaper-scheme-2"],
        ["design", "crank-rocker-swing-32"], ["draw", "slider-crank-offset", "--figure", "velocity"],
    ],
)
def test_every_number_of_a_printed_table_has_its_unit(command: list[str], tmp_path: Path) -> None:
    printed = run(*command, cwd=tmp_path).stdout
    numbers = "\n".join(line for line in without_unit(printed) if not re.match(r"\s*(K|e|eta)\b", line))
    assert "─" in printed
    assert "" == numbers


@pytest.mark.parametrize(
    ("command", "said"),
    [
        (["solve", "sixbar-guide-40deg", "--at", "75"], "driver 1 = 75°"),
        (["solve", "boom-lifted"], "driver 2/3 = 520 mm"),
        (["solve", "fourbar-150-500-300-400", "--loops"], "lengths in mm, angles in degrees, speeds in mm/s and rad/s"),
        (["centres", "sixbar-guide-40deg"], "0, 389.924 mm"),
        (["check", "shaper-forces", "--find", "excess_W"], "1375.4 N m"),
    ],
)
def test_what_is_printed_beside_tables_has_its_unit(command: list[str], said: str, tmp_path: Path) -> None:
    assert said in run(*command, cwd=tmp_path).stdout


def test_speeds_are_headed_by_their_own_unit(tmp_path: Path) -> None:
    """Lengths in mm and speeds in m/s: the head of velocities is that of the values."""
    scene = four_bar(150, 500, 300, 400, units={"length": "mm", "speed": "m/s"}, sketch={"C": [500, 290]})
    graphkin.Scene.of(scene, "fast").save(tmp_path / "fast.toml")
    printed = run("solve", "fast.toml", cwd=tmp_path).stdout
    assert re.search(r"velocity \(m/s\) +acceleration \(m/s2\)", printed)
    assert "-1.29904, 0.75" in printed
def test_a_value_before_a_group_beside_its_dead_point_is_printed(tmp_path: Path) -> None:
    from tests.study.test_turn import stephenson_three

    scene = tmp_path / "scene.toml"
    scene.write_text(tomlkit.dumps(stephenson_three()))
    one = run("solve", str(scene), "--at=83.8756", "--find", "alpha_3", "--find", "a_C").stdout
    whole = run("solve", str(scene), "--at=83.8756").stdout
    row = next(line.split() for line in one.splitlines() if "alpha_3" in line)
    links = {line.split()[0]: line.split() for line in whole.splitlines() if line.strip()}
    assert (["alpha_3", "20.6242", "rad/s2"], ["3", "20.8626", "-0.987874", "20.6242"]) == (row, links["3"])
    assert {"-2082.06,", "-3132.74"} <= {*links["C@3"]} & {*links["C@5"]}
