"""Where a command prints to: pipes that close, disks that are full, terminals, and those who interrupt."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from ..command import PROGRAM, run

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
@pytest.mark.parametrize("module", ["typer", "graphkin.cli.check", "numpy", "graphkin.construction.plan"])
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
