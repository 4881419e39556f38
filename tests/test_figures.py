"""The committed gallery is what the program draws."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

from tests.letters import STYLES, Notation, faces, letters, shown, unpacked, whole

FIGURES = Path(__file__).parent.parent / "figures"
_spec = importlib.util.spec_from_file_location("make", FIGURES / "make.py")
make = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(make)


FIRST = {figure: name for name in reversed(make.GALLERY) for figure in make.GALLERY[name]}
"""The first folder that has a figure of each kind: these are drawn under ``-m quick`` too."""


@pytest.mark.parametrize("name", [
    pytest.param(name, marks=pytest.mark.quick) if name in FIRST.values() else name for name in make.GALLERY
])
def test_a_committed_figure_is_redrawn_byte_by_byte_but_for_how_its_letters_are_packed(name):
    drawn = {file: unpacked(svg) for file, svg in make.redraw(name).items()}
    assert {file: unpacked((FIGURES / name / file).read_bytes()) for file in drawn} == drawn


@pytest.fixture(scope="module")
def family() -> Notation:
    """All letters from which those of a figure are cut; an italic or bold face borrows from the upright."""
    own = letters({style: whole(style) for style in STYLES.values()})
    return {style: own["regular"] | held for style, held in own.items()}


@pytest.mark.parametrize("name", make.GALLERY)
def test_a_committed_figure_brings_the_letters_it_shows_with_the_outlines_of_the_family(name, family):
    for file in sorted((FIGURES / name).glob("*.svg")):
        svg = file.read_text(encoding="utf-8")
        held = letters(faces(svg))
        assert {style: {c: family[style][c] for c in found} for style, found in held.items()} == held
        if "<tspan" in svg:  # a chart sets its texts otherwise
            assert shown(svg) == {style: {*found} for style, found in held.items()}


def test_every_folder_of_the_gallery_is_redrawn():
    folders = {p.name for p in FIGURES.iterdir() if p.is_dir() and p.name[0] not in "_."}
    assert {*make.GALLERY, *make.STUDIES, "examples"} == folders


@pytest.mark.parametrize("name", make.GALLERY)
def test_no_figure_is_left_over(name):
    source = "design.toml" if name.startswith("design-") else "scene.toml"
    wanted = {source, *(f"{figure}.svg" for figure in make.GALLERY[name])}
    assert wanted == {p.name for p in (FIGURES / name).iterdir()}
