"""Files are there whole or not at all, as the user has new files; a folder is one program's at a time."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path

import pytest

from graphkin.errors import CallError
from graphkin.files import folder_alone, opened, whole_file

HOLDS = """
import sys
from pathlib import Path
from graphkin.files import folder_alone
with folder_alone(Path(sys.argv[1])):
    print("here", flush=True)
    sys.stdin.read()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of POSIX")
def test_only_files_are_opened(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", "/dev/zero"):
        with pytest.raises(OSError, match="it is a pipe or a device, no file"):
            opened(path)


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of POSIX")
def test_what_the_shell_hands_over_open_is_read() -> None:
    handed = subprocess.run(
        [sys.executable, "-c", "from graphkin.files import opened; print(opened('/dev/stdin').read())"],
        input=b"here", capture_output=True, check=True,
    )
    assert b"b'here'\n" == handed.stdout


def test_a_file_that_fails_leaves_the_one_before(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"before")

    def interrupted() -> None:
        with whole_file(tmp_path / "a") as out:
            out.write(b"half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert (b"before", ["a"]) == ((tmp_path / "a").read_bytes(), [p.name for p in tmp_path.iterdir()])


def test_a_file_is_on_the_disk_before_it_takes_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    held: list[tuple[int, bool]] = []
    flush = os.fsync

    def fsync(handle: int) -> None:
        held.append((os.fstat(handle).st_size, (tmp_path / "a").exists()))
        flush(handle)

    monkeypatch.setattr(os, "fsync", fsync)
    with whole_file(tmp_path / "a") as out:
        out.write(b"whole")
    assert [(5, False)] == held


@pytest.mark.skipif(sys.platform == "win32", reason="modes of POSIX")
def test_a_new_file_has_the_mode_of_all_new_files(tmp_path: Path) -> None:
    with whole_file(tmp_path / "a") as out:
        out.write(b"1")
    (tmp_path / "b").write_bytes(b"1")
    assert (tmp_path / "b").stat().st_mode == (tmp_path / "a").stat().st_mode


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")
def test_a_full_disk_leaves_nothing_half_written(tmp_path: Path) -> None:
    def onto_a_full_disk() -> None:
        with whole_file(tmp_path / "a") as out, open("/dev/full", "wb", buffering=0) as full:
            out.write(b"half")
            full.write(b"the rest")

    with pytest.raises(OSError, match="No space left"):
        onto_a_full_disk()
    assert [] == list(tmp_path.iterdir())


def test_a_second_program_is_told_who_writes_into_the_folder(tmp_path: Path) -> None:
    call = [sys.executable, "-c", HOLDS, str(tmp_path)]
    with subprocess.Popen(call, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as first:
        assert first.stdout is not None
        assert "here\n" == first.stdout.readline()
        with pytest.raises(CallError, match=f"another graphkin is writing into it .process {first.pid} on "), \
                folder_alone(tmp_path):
            pass
        first.kill()
    with folder_alone(tmp_path):
        pass
    assert [] == list(tmp_path.iterdir())


@pytest.mark.skipif(sys.platform == "win32", reason="locks of POSIX")
def test_a_file_system_that_knows_no_locks_takes_results_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(handle: int, operation: int) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr("fcntl.flock", refuse)
    with folder_alone(tmp_path):
        (tmp_path / "a").touch()
    assert [tmp_path / "a"] == list(tmp_path.iterdir())
