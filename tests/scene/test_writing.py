"""A scene written out reads as the same scene."""

from __future__ import annotations

import tomllib

import numpy as np
import pytest

from graphkin.scene import library, library_text, mechanism_of, mechanism_of_text
from graphkin.scene.files import toml_text
from graphkin.scene.scene_tables import as_mapping
from graphkin.solver import solve


@pytest.mark.parametrize("name", library())
def test_the_text_of_a_scene_file_gives_its_mapping_again(name):
    raw = tomllib.loads(library_text(name))
    assert raw == tomllib.loads(toml_text(raw))


@pytest.mark.parametrize("name", library())
def test_a_resolved_scene_written_out_moves_alike(name):
    scene = mechanism_of(name)
    again = mechanism_of_text(toml_text(as_mapping(scene)), name)
    one, two = solve(scene), solve(again)
    for link in scene.links:
        np.testing.assert_allclose(one.alpha(link.name), two.alpha(link.name), rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("title", ['a "quote"', "back\\slash", "[links]", "李 \u202e x", "'''", "\x7f"])
def test_no_text_breaks_out_of_its_string(title):
    assert {"title": title} == tomllib.loads(toml_text({"title": title}))
