"""Every scene that comes along at several driver positions: no label overlaps, nothing runs off, both languages."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

import graphkin
from graphkin.checking.readings import read_off
from graphkin.checking.report import compare
from graphkin.drawing import svg_bytes
from graphkin.drawing.ink.primitives import Text, walk
from graphkin.errors import Unsolvable
from graphkin.scene import library, mechanism_of
from tests import EVERYTHING
from tests.drawn import drafts, figures
from tests.scenes import FIXED_PIN

POSITIONS = 24 if EVERYTHING else 3
# all positions of all scenes take minutes; else each scene stands in one of three
PLACES = [(name, turn) for i, name in enumerate(library()) for turn in range(POSITIONS) if EVERYTHING or turn == i % 3]
CONVENTIONS = ("chinese", "us", "british", "russian")


@pytest.mark.parametrize(("name", "turn"), PLACES)
def test_no_label_is_overlapped_crossed_or_cut(
    name: str, turn: int, violations: Callable[[bytes], list[str]]
) -> None:
    scene = mechanism_of(name)
    driver = scene.drivers[0]
    value = driver.values[0]
    step = 2 * math.pi / POSITIONS if driver.turns else 0.06 * abs(value) / POSITIONS
    at = {driver.key: value + turn * step}
    try:
        own, on_sheet = drafts(scene, at)
    except Unsolvable:
        pytest.skip("the motion does not reach this position")
    readings = read_off(on_sheet)
    measured = {r.symbol: r.value for r in readings}
    report = compare(on_sheet, readings, measured)
    language = ("en", "zh", "both")[turn % 3]
    convention = CONVENTIONS[turn % 4]
    drawn = figures(own, on_sheet, report, language, convention)
    assert {figure: [] for figure in drawn} == {figure: violations(svg_bytes(d)) for figure, d in drawn.items()}


def test_the_letters_of_a_trial_polygon_bear_its_numeral():
    figure = graphkin.draw("double-butterfly", figures=("acceleration",)).figures["acceleration"]
    named = {thing.id: thing.string for thing in walk(figure.children) if isinstance(thing, Text)}
    assert "j′II" == named["label-detail-trial-acceleration-2-a_J"]


MOVING_PIN = {
    **FIXED_PIN,
    "links": {
        "1": FIXED_PIN["links"]["1"],
        "2": {"points": ["C", "E"], "length": 120, "guides": {"s": {"through": "C", "angle": 0}}},
    },
    "pins": {"B": {"of": "1", "in": "2.s"}},
    "driver": {"slide": "B/2", "travel": 65, "velocity": 20},
}


@pytest.mark.parametrize(("scene", "named"), [(FIXED_PIN, "vC2"), (MOVING_PIN, "vB2")])
def test_the_arrow_at_a_driven_pin_in_a_slot_is_named_as_its_given_rate(scene: dict[str, Any], named: str) -> None:
    figure = graphkin.draw(scene, figures=("mechanism",)).figures["mechanism"]
    (label,) = (t for t in walk(figure.children) if isinstance(t, Text) and t.id.startswith("label-driver"))
    assert named == label.string


def test_vectors_too_short_to_be_drawn_at_one_place_are_told_with_their_own_values() -> None:
    figure = graphkin.draw("sixbar-AE70", at=-58.9, figures=("acceleration",)).figures["acceleration"]
    told = [t.string.replace(" ", "") for t in walk(figure.children) if isinstance(t, Text)]
    assert any(line.endswith("aBAn=aB=4000mm/s²,aF1=3887mm/s²") for line in told)
