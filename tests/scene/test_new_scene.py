"""A new scene of one's own lengths is a file that is read, solved and drawn as it is."""

from __future__ import annotations

import pytest

import graphkin
from graphkin.scene.scene import NEW, new_scene

from ..command import run

pytestmark = pytest.mark.quick


@pytest.mark.parametrize("kind", NEW)
def test_a_new_scene_is_checked_as_it_is(kind, tmp_path):
    (tmp_path / "new.toml").write_text(new_scene(kind, {}), encoding="utf-8")
    assert graphkin.check(tmp_path / "new.toml").ok


def test_the_lengths_are_those_that_were_given(tmp_path):
    path = tmp_path / "mine.toml"
    answer = run("scenes", "--new", "four-bar", str(path), "--set", "crank=12.5", "--set", "rpm=-30")
    scene = graphkin.read(path)
    lengths = [link.length for link in scene.links.values()]
    assert (0, [12.5, 500, 300], -30) == (answer.returncode, lengths, scene.driver.rpm)


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["fourbar"], 'graphkin: --new: "fourbar"; did you mean "four-bar"?'),
        (["four-bar", "--set", "krank=1"], 'graphkin: --new four-bar: asks for no "krank"; did you mean "crank"?'),
        (["four-bar", "--set", "crank=-1"], "graphkin: crank: found -1; a length is positive"),
        (["four-bar", "--set", "rpm=1e9", "--set", "crank=2e9"],
         "graphkin: crank: found 2e+09; give a finite number below 1e9"),
        (["four-bar", "--lang", "xx"], 'graphkin: lang: "xx"; known here: en, zh'),
        (["four-bar", "--set", "crank=x"], 'graphkin: --set crank=x: "x" is no number; write --set crank=150'),
    ],
)
def test_what_is_wrong_is_told(args, said):
    answer = run("scenes", "--new", *args)
    assert (2, said) == (answer.returncode, answer.stderr.strip())


def test_lengths_without_a_new_scene_are_refused():
    done = run("scenes", "--set", "crank=12.5")
    assert (2, "graphkin: --set: without --new") == (done.returncode, done.stderr.partition(";")[0])
