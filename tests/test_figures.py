"""The committed gallery is what the program draws."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

FIGURES = Path(__file__).parent.parent / "figures"
_spec = importlib.util.spec_from_file_location("make", FIGURES / "make.py")
make = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(make)


FIRST = {figure: name for name in reversed(make.GALLERY) for figure in make.GALLERY[name]}
"""The first folder that has a figure of each kind: these are drawn under ``-m quick`` too."""


@pytest.mark.parametrize("name", [
    pytest.param(name, marks=pytest.mark.quick) if name in FIRST.values() else name for name in make.GALLERY
])  # fmt: skip
def test_a_committed_figure_is_redrawn_byte_by_byte(name):
    drawn = make.redraw(name)
    assert {f: (FIGURES / name / f).read_bytes() for f in drawn} == drawn


def test_every_folder_of_the_gallery_is_redrawn():
    folders = {p.name for p in FIGURES.iterdir() if p.is_dir() and p.name[0] not in "_."}
    assert {*make.GALLERY, *make.STUDIES, "examples"} == folders


@pytest.mark.parametrize("name", make.GALLERY)
def test_no_figure_is_left_over(name):
    source = "design.toml" if name.startswith("design-") else "scene.toml"
    wanted = {source, *(f"{figure}.svg" for figure in make.GALLERY[name])}
    assert wanted == {p.name for p in (FIGURES / name).iterdir()}
