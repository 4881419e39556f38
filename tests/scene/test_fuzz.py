"""Whatever is in a file, the reader gives a scene or a SceneError, nothing else."""

from __future__ import annotations

import copy
import math
import tomllib
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from graphkin.errors import Problem, SceneError
from graphkin.scene import library, library_text, mechanism_of, mechanism_of_text

from . import test_drawn
from .scenes import FOUR_BAR, SIX_BAR

FEW = settings(max_examples=100, deadline=None, suppress_health_check=list(HealthCheck))
KEYS = ["title", "links", "frame", "points", "length", "on", "angle_on", "at", "guides", "driver", "pins", "of", "in",
        "from", "r", "angle", "toward", "through", "side", "drawn", "sketch", "find", "printed", "1", "2", "3", "A",
        "B", "C", "<list>", "<polar>", "[key]", "omega", "link", "slide", "name", "units", "sheet", "redundant"]
WORDS = st.sampled_from(["A", "B", "C", "D", "E", "1", "2", "3", "4", "6", "6.h", "3.s", "2/3", "drawn", "left", "v_B",
                         "a_B@3", "omega_3", "mm", ""])
NUMBERS = st.sampled_from([0, 1, -1, 2.5, 1e-300, 1e300, math.inf, math.nan, -0.0, 10**400, 90]) | st.floats()
SIGNS = st.characters(exclude_categories=["Cs"])  # all of UTF-8, without the seconds in which its table is made
SCALARS = WORDS | NUMBERS | st.booleans() | st.none() | st.text(SIGNS, max_size=5) | st.binary(max_size=3)
VALUES = st.recursive(
    SCALARS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(KEYS), inner, max_size=4),
    max_leaves=12)
SEEDS = [tomllib.loads(t) for t in (FOUR_BAR, SIX_BAR, test_drawn.FOUR_BAR, test_drawn.CYLINDER, test_drawn.GUIDE_BAR,
                                    *(library_text(n) for n in library()[:8]))]


def scene_or_problems(source: Any) -> None:
    problems: tuple[Problem, ...] = ()
    places: list[complex] = []
    try:
        scene = mechanism_of(source)
        places = [z for link in (scene.frame, *scene.links) for z in link.points.values()]
    except SceneError as error:
        problems = error.problems
    assert places or problems or scene.links
    assert all(math.isfinite(abs(z)) for z in places)
    assert [p for p in problems if not p.where or not p.found or "\n" in str(p)] == []


def paths(node: Any, here: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    children = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    return [p for key, child in children for p in [(*here, key), *paths(child, (*here, key))]]


@FEW
@given(st.dictionaries(st.sampled_from(KEYS) | st.text(SIGNS, max_size=4), VALUES, max_size=6))
def test_any_mapping_gives_a_scene_or_its_problems(source: dict[str, Any]) -> None:
    scene_or_problems(source)


@settings(FEW, max_examples=350)
@given(st.data())
def test_a_scene_with_anything_put_in_place_of_an_entry_gives_a_scene_or_its_problems(data: st.DataObject) -> None:
    source = copy.deepcopy(data.draw(st.sampled_from(SEEDS)))
    for _ in range(data.draw(st.integers(1, 4))):
        known = paths(source)
        path = data.draw(st.sampled_from(known))
        table = source
        for part in path[:-1]:
            table = table[part]
        kind = data.draw(st.sampled_from(["value", "word", "drop", "rename", "swap"]))
        if kind == "drop":
            del table[path[-1]]
        elif kind == "rename" and isinstance(table, dict):
            table[data.draw(st.sampled_from(KEYS))] = table.pop(path[-1])
        elif kind == "swap":
            node = source
            for part in data.draw(st.sampled_from(known)):
                node = node[part] if isinstance(node, dict | list) else node
            table[path[-1]] = copy.deepcopy(node)
        else:
            table[path[-1]] = data.draw(VALUES if kind == "value" else WORDS | NUMBERS)
        if not source:
            break
    scene_or_problems(source)


@FEW
@given(st.text(SIGNS, max_size=80) | st.text(alphabet='[]{}="\'.,#\n\\u019AaBb ', max_size=60))
def test_any_text_that_is_no_scene_gives_problems(text: str) -> None:
    problems: tuple[Problem, ...] = ()
    try:
        mechanism_of_text(text, text)
    except SceneError as error:
        problems = error.problems
    assert problems
