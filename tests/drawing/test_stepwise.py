from __future__ import annotations

import pytest

from graphkin.api.drawn import draw
from graphkin.checking.report import Report
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Line, Text, walk
from graphkin.drawing.stepwise import so_far, step_of, stepped
from graphkin.papers.lesson import Lesson
from graphkin.papers.pictures import parts
from graphkin.scene import library
from tests.drawn import drafted


def _layers(name, diagram):
    sheet, _ = drafted(name)
    return sheet, parts(Lesson(Report(sheet, ()), {}, "en", "chinese"), diagram)


@pytest.mark.parametrize("name", library())
@pytest.mark.parametrize("diagram", ["mechanism", "velocity", "acceleration"])
def test_every_part_bears_the_step_that_draws_it(name, diagram):
    _, layers = _layers(name, diagram)
    bare = [thing for layer in layers for thing in layer.children if step_of(thing) is None]
    # names of guides belong to what is given
    assert [] == [b for b in bare if not (isinstance(b, Text) and b.id.startswith("label-guide-"))]


def test_a_name_appears_with_what_it_names():
    _, layers = _layers("sixbar-guide-40deg", "acceleration")
    steps = {t.id: step_of(t) for t in walk(layers) if isinstance(t, Group | Text) and t.id}
    assert steps["ak_B3-B2"] == steps["label-ak_B3-B2"] == steps["sense-ak_B3-B2"] == 23


def test_what_comes_later_is_not_there():
    _, layers = _layers("sixbar-guide-40deg", "velocity")
    ids = {t.id for t in walk(so_far(layers, 9, 16)) if isinstance(t, Group)}
    assert "v_D3" in ids
    assert "v_D" not in ids
    assert {"v_D": 18} == {t.id: t.step for t in walk(layers) if isinstance(t, Group) and t.id == "v_D"}


def test_what_was_there_before_is_faded_and_what_is_new_is_not():
    _, layers = _layers("sixbar-guide-40deg", "velocity")
    before = {t.id: t for t in walk(layers) if isinstance(t, Group) and t.id}
    after = {t.id: t for t in walk(so_far(layers, 9, 16)) if isinstance(t, Group) and t.id}
    assert before["v_B3"] == after["v_B3"]
    assert before["v_B"] != after["v_B"]


def test_steps_are_given_once():
    _, layers = _layers("sixbar-guide-40deg", "velocity")
    assert layers == stepped(layers)


def test_letters_in_an_inset_appear_with_it_and_not_with_the_last_one():
    _, layers = _layers("loader-cylinder", "acceleration")
    insets = {t.id: t.step for t in walk(layers) if isinstance(t, Group) and "detail" in t.classes}
    captions = {t.id.removeprefix("label-"): t.step for t in walk(layers) if isinstance(t, Text)}
    assert {"detail-acceleration-1": 48, "detail-acceleration-2": 65} == insets
    assert insets == {id: captions[id] for id in insets}
    assert (48, 48) == (captions["detail-acceleration-B"], captions["detail-foot-an_E-H7"])


def test_a_file_leaves_unsaid_since_when_a_name_is_there_and_a_page_of_steps_says_it():
    (layer,) = (g for g in draw("sixbar-guide-40deg").figures["velocity"].children if g.id == "velocity")
    ends = [g for g in layer.children if "end" in g.classes]
    assert {None} == {g.step for g in ends}
    assert {g.since for g in ends} == {g.step for g in stepped(ends)} != {None}


@pytest.mark.parametrize(("name", "diagram", "part", "step"), [
    ("four-bar-coupler-point", "acceleration", "acceleration-C", 22),  # where two lines meet; its vector is drawn in 25
    ("four-bar-coupler-point", "acceleration", "a_C", 25),
    ("loader-cylinder", "mechanism", "dimensions", 7),  # a special point is found in 12, when the polygons have begun
    ("four-bar-coupler-point", "mechanism", "omega-3", 12),
])
def test_a_part_is_there_from_the_step_on_that_finds_it(name, diagram, part, step):
    _, layers = _layers(name, diagram)
    assert {part: step} == {t.id: t.step for t in walk(layers) if isinstance(t, Group) and t.id == part}


@pytest.mark.parametrize(("classes", "bands"), [((), 1), (("inset",), 0), (("ring",), 0)])
def test_what_is_new_has_a_pale_band_but_no_inset_and_no_ring(classes, bands):
    group = Group((Line(0j, 5 + 0j, strokes.LINK),), classes=classes, step=3)
    new = [thing for thing in so_far((group,), 3, 3) if isinstance(thing, Group) and thing.classes == ("new",)]
    assert bands == len(new)
