"""Polygons of several positions beside each other."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

import graphkin
from graphkin.checking import readings as readings_module
from graphkin.checking.readings import read_off
from graphkin.construction.board.sheet import Reading, Sheet
from graphkin.errors import Disagreement

NUMBERED = {"count": 12, "first": {"stroke": "6/1", "at": 0, "sense": 1}, "show": ["3", "9"]}


@cache
def page() -> str:
    scene = graphkin.read("shaper-scheme-2").replace("positions", NUMBERED)
    return graphkin.draw(scene, figures=["polygons"]).figures["polygons"].content("svg").decode()


def line_of(svg: str, name: str) -> complex:
    found = re.search(f'id="{name}"[^>]*>(?:<title>[^<]*</title>)?<line([^>]*)/>', svg)
    x1, y1, x2, y2 = (float(re.search(f'{a}="([^"]*)"', found[1])[1]) for a in ("x1", "y1", "x2", "y2"))
    return complex(x2 - x1, y1 - y2)


@pytest.mark.parametrize("name", ["3", "9"])
def test_each_position_has_its_own_vectors_at_the_common_scale(name: str) -> None:
    svg = page()
    scene = graphkin.read("shaper-scheme-2").replace("positions", NUMBERED)
    velocity = graphkin.solve(scene, at=name).data["positions"][0]["points"]["B@4"]["velocity"]
    scale = float(re.search(r'"velocity":([0-9.]+)', svg)[1])
    measured = line_of(svg, f"v_B-at-{name}") * scale
    assert velocity == pytest.approx([measured.real, measured.imag], abs=2e-3 * scale)


def test_no_id_stands_twice() -> None:
    ids = re.findall(r' id="([^"]*)"', page())
    assert len(set(ids)) == len(ids)


def test_driver_values_may_stand_for_names_and_further_positions_stand_on_further_pages() -> None:
    drawn = graphkin.draw("shaper-scheme-2", figures=["polygons"], beside=[10, 50, 90, 130])
    assert ["polygons", "polygons-2"] == list(drawn.figures)


def test_one_position_alone_is_refused() -> None:
    with pytest.raises(graphkin.CallError, match="beside each other"):
        _ = graphkin.draw("shaper-scheme-2", figures=["polygons"], beside=[10]).figures


def test_a_value_that_is_drawn_wrong_in_another_position_alone_is_not_written(monkeypatch: pytest.MonkeyPatch) -> None:
    own = graphkin.read("sixbar-420rpm").mechanism.drivers[0].value

    def wrong(sheet: Sheet, *given: Any) -> list[Reading]:
        readings = read_off(sheet, *given)
        here = sheet.drivers["1"] == pytest.approx(own)
        return readings if here else [replace(reading, value=1.001 * reading.value) for reading in readings]

    monkeypatch.setattr(readings_module, "read_off", wrong)
    assert graphkin.draw("sixbar-420rpm", figures=["velocity"]).files
    with pytest.raises(Disagreement, match="by the drawing"):
        assert graphkin.draw("sixbar-420rpm", figures=["polygons"], beside=[45, 80]).figures


def test_further_drivers_stand_where_the_call_puts_them() -> None:
    svg = [
        graphkin.draw("loader-cylinder", at={"2": 70, "7/6": travel}, figures=["polygons"], beside=[66, 70])
        .figures["polygons"].content("svg")
        for travel in (180, 185)
    ]  # fmt: skip
    assert svg[0] != svg[1]
