"""The check: right drawings pass, planted errors are caught."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import graphkin
from graphkin.construction import plan
from graphkin.construction.polygons import equations
from graphkin.errors import Unsolvable
from graphkin.scene import library, mechanism_of
from graphkin.scene.symbol import Symbol
from graphkin.solver import driver_range
from graphkin.structure import LargerGroup
from tests import EVERYTHING
from tests.mechanisms import KINDS, random_scene
from tests.scenes import four_bar

SIXBAR = "sixbar-guide-40deg"
# larger groups take their time
POSITIONS, LARGER = (12, 12) if EVERYTHING else (3, 2)


def over_its_range(name: str) -> tuple[list[float], float | None]:
    """Driver values in the scene's unit, all over the range that the motion reaches, and one beyond its end."""
    whole = driver_range(mechanism_of(name))
    larger = any(isinstance(group, LargerGroup) for group in whole.structure.groups)
    low, high = whole.ends
    n = LARGER if larger else POSITIONS
    inside = whole.value(low + (np.arange(n) + 0.5) / n * (high - low)).tolist()
    unit = math.radians(1) if whole.driver.turns else whole.scene.units.metres
    ends = not whole.full and whole.limited[1]  # what rolls goes on, and only does not close
    beyond = None if not ends else float(whole.value(np.array(high + 0.02 * (high - low))))
    return [value / unit for value in inside], None if beyond is None else beyond / unit


@pytest.mark.parametrize("name", library())
def test_every_scene_that_comes_along_passes_over_its_range(name):
    values, beyond = over_its_range(name)
    for value in values:
        result = graphkin.check(name, at=value)
        assert result.report.ok, [str(r.symbol) for r in result.report.rows if not r.ok]
        assert all(abs(r.direction_error) < 1e-6 for r in result.report.rows)
    if beyond is not None:
        with pytest.raises(Unsolvable) as refusal:
            graphkin.check(name, at=beyond)
        assert "not assembled" == refusal.value.status


@given(seed=st.integers(0, 10**6), kinds=st.lists(st.sampled_from(KINDS), min_size=1, max_size=4))
@settings(max_examples=40, deadline=None)
def test_any_class_ii_mechanism_is_drawn_as_it_is_solved(seed, kinds):
    try:
        result = graphkin.check(random_scene(seed, tuple(kinds)))
    except Unsolvable as refusal:
        # a random place can come to lie at a dead point, nothing else may be refused
        assert refusal.status == "dead point"
        return
    assert result.ok, [str(r.symbol) for r in result.report.rows if not r.ok]


def test_a_coriolis_vector_the_wrong_way_round_is_caught(monkeypatch):
    right = equations._slide_parts

    def wrong(plot, order, edge, slide):
        found = right(plot, order, edge, slide)
        return [replace(p, span=-p.span) if p.role == "coriolis" else p for p in found]

    monkeypatch.setattr(equations, "_slide_parts", wrong)
    result = graphkin.check(SIXBAR)
    assert not result.ok
    assert "a_D" in [str(r.symbol) for r in result.report.rows if not r.ok]


def test_a_guide_turned_by_a_tenth_of_a_degree_is_caught(monkeypatch):
    right = plan.__globals__["analyse"]

    def turned(scene):
        structure = right(scene)
        off = cmath.rect(1, math.radians(0.1))
        slides = {
            s.key: replace(s, guide=replace(s.guide, direction=s.guide.direction * off)) for s in structure.slides
        }
        slides = {k: v if k == "5/6" else structure.slide(k) for k, v in slides.items()}
        elements = []
        for e in structure.elements:
            for field in ("outer_first", "inner", "outer_second"):
                pair = getattr(e, field, None)
                if pair is not None and getattr(pair, "key", "") in slides:
                    e = replace(e, **{field: slides[pair.key]})
            elements.append(e)
        return replace(structure, slides=tuple(slides.values()), elements=tuple(elements))

    monkeypatch.setitem(plan.__globals__, "analyse", turned)
    assert not graphkin.check(SIXBAR).ok


def test_a_normal_component_away_from_the_pivot_is_caught(monkeypatch):
    right = equations._rigid_parts

    def wrong(plot, order, edge):
        found = right(plot, order, edge)
        return [replace(p, span=-p.span) if p.role == "normal" else p for p in found]

    monkeypatch.setattr(equations, "_rigid_parts", wrong)
    assert not graphkin.check("fourbar-150-500-300-400").ok


def test_an_angular_velocity_of_the_wrong_sense_is_caught(monkeypatch):
    monkeypatch.setattr(equations, "cross", lambda a, b: -(a.real * b.imag - a.imag * b.real))
    assert not graphkin.check("fourbar-150-500-300-400").ok


def test_a_reading_is_length_on_paper_times_the_scale():
    result = graphkin.check(SIXBAR)
    row = result["v_B@3"]
    assert row.on_paper * result.scales["velocity"] == pytest.approx(abs(row.measured), rel=1e-15)


@pytest.mark.parametrize(
    "symbol",
    ["v_D", "a_B@3", "v_B@2/B@3", "ak_B@2/B@3", "ar_D@5/D@3", "an_B/A", "omega_3", "alpha_4", "v_B@5", "v_D/B"],
)
def test_whatever_is_asked_for_is_read_off(symbol):
    result = graphkin.check(SIXBAR, find=[symbol])
    assert result.ok
    assert Symbol.parse(symbol) in [r.symbol for r in result.report.rows]


def test_the_json_of_a_check_gives_vectors_by_size_and_rates_with_sign():
    rows = {r["symbol"]: r for r in graphkin.check(SIXBAR).data["readings"]}
    assert 554.668 == pytest.approx(rows["a_D"]["measured"], abs=1e-3)
    assert -2.81912 == pytest.approx(rows["omega_3"]["measured"], abs=1e-5)
    assert {"length": 2, "velocity": 10, "acceleration": 100} == graphkin.check(SIXBAR).data["scales"]


PARALLELOGRAM = four_bar(50, 200, 50, 200, sketch={"C": [225, 43]})


def test_rates_that_are_all_zero_are_judged_by_the_vectors_they_come_from():
    assert graphkin.check(PARALLELOGRAM).ok


def test_a_trammel_driven_by_its_bar_is_drawn_whole():
    trammel = {
        "frame": {"guides": {"x": {"through": [0, 0], "angle": 0}, "y": {"through": [0, 0], "angle": 90}}},
        "links": {"2": {"points": ["B", "C"], "length": 100}},
        "pins": {"B": {"of": "2", "in": "0.x"}, "C": {"of": "2", "in": "0.y"}},
        "driver": {"link": "2", "angle": 130, "omega": 3},
    }
    result = graphkin.check(trammel)
    assert result.complete
    assert result.ok


@pytest.mark.parametrize("angle", [-89.99, -89.9])
def test_a_guide_bar_just_before_its_flip_is_judged_by_what_rounding_leaves(angle):
    flip = {
        "frame": {"points": {"A": [0, 0], "C": [0, -100]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 100},
            "2": {"points": ["B"], "on": "3"},
            "3": {"points": ["C"]},
        },
        "driver": {"link": "1", "angle": angle, "omega": 10},
    }
    assert graphkin.check(flip).ok


def test_links_too_short_to_be_seen_beside_the_others_are_told_by_name():
    dots = {
        "frame": {"points": {"A": [0, 0], "D": [100, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 1e-9},
            "2": {"points": ["B", "C"], "length": 100},
            "3": {"points": ["C", "D"], "length": 1e-9},
        },
        "driver": {"link": "1", "angle": 40, "omega": 10},
    }
    with pytest.raises(graphkin.SceneError, match=r"frame\.points\.D: lies 100 away, beside a bar of 1e-09"):
        graphkin.check(dots)


@pytest.mark.parametrize(("before", "known"), [(1e-8, True), (1e-9, True), (2e-10, False)])
def test_forces_are_judged_by_what_rounding_leaves_of_them_near_a_dead_point(before, known):
    # B at 100 mm from D: links 2 and 3 are stretched out
    end = math.degrees(math.acos((90**2 + 100**2 - 100**2) / (2 * 90 * 100)))
    rows = graphkin.check({
        "frame": {"points": {"A": [0, 0], "D": [100, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 90},
            "2": {"points": ["B", "C"], "length": 40},
            "3": {"points": ["D", "C"], "length": 60},
        },
        "sketch": {"C": [60, 60]},
        "loads": {"P": {"on": "3", "at": "C", "force": 100, "angle": 20}},
        "driver": {"link": "1", "angle": end - before, "omega": 1},
    }).report.rows
    pairs = [row for row in rows if row.reading.symbol.kind == "F"]
    assert {True if known else None} == {row.ok for row in pairs}
    # they differ by more than is allowed elsewhere
    assert 1e-9 < max(abs(row.reading.value - row.exact) / abs(row.exact) for row in pairs)


@pytest.mark.parametrize("angle", [0, 30])
def test_a_pin_driven_evenly_along_a_slot_has_no_acceleration_but_rounding(angle):
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, -50], "angle": angle}}},
        "links": {"1": {"points": ["A", "B"], "length": 90}, "2": {"points": ["B", "C"], "length": 130}},
        "pins": {"C": {"of": "2", "in": "0.h"}},
        "driver": {"slide": "C/0", "travel": 60, "velocity": -30},
    }
    assert graphkin.check(scene).ok
