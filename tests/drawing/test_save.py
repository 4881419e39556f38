from __future__ import annotations

import os
import subprocess
import sys

import pytest

from graphkin.drawing import Drawing, save
from graphkin.errors import CallError

PAGE = Drawing(20.0, 10.0, ())


@pytest.mark.parametrize(("name", "head"), [("a.svg", b"<?xml"), ("a.pdf", b"%PDF"), ("a.PNG", b"\x89PNG")])
def test_the_format_goes_by_the_name(tmp_path, name, head):
    assert save(PAGE, tmp_path / name).read_bytes().startswith(head)


def test_an_unknown_ending_names_the_known_ones(tmp_path):
    with pytest.raises(CallError, match="svg, pdf, png"):
        save(PAGE, tmp_path / "a.gif")


def test_a_failed_write_leaves_nothing_behind(tmp_path, monkeypatch):
    def refuse(*args):
        raise OSError("no")

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(OSError, match="no"):
        save(PAGE, tmp_path / "a.svg")
    assert list(tmp_path.iterdir()) == []


def test_a_file_of_the_same_name_is_replaced(tmp_path):
    (tmp_path / "a.svg").write_text("old")
    assert b"old" not in save(PAGE, tmp_path / "a.svg").read_bytes()


def test_a_file_is_as_readable_as_any_other(tmp_path):
    (tmp_path / "other").write_text("")
    assert save(PAGE, tmp_path / "a.svg").stat().st_mode == (tmp_path / "other").stat().st_mode


def test_importing_the_room_loads_no_writer():
    program = "import sys, graphkin.drawing; print(*{'svgwrite', 'matplotlib', 'numpy'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""
