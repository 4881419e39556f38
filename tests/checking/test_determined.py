"""Readings and stated values that can be held against nothing; a drawing that stopped is not ok."""

from __future__ import annotations

from typing import Any

import pytest

import graphkin
from graphkin.checking.readings import read_off
from graphkin.checking.report import compare
from graphkin.checking.uncertainty import Uncertainty
from graphkin.construction import draft
from graphkin.construction.steps import ReadOff
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol


def slider_crank(**driver: float) -> dict[str, Any]:
    return {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, -16], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 24},
            "2": {"points": ["B", "C"], "length": 58},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 60, **driver},
    }


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_pencil_at_rest_keeps_within_what_it_promises(seed: int) -> None:
    assert graphkin.check(slider_crank(omega=0, alpha=5), instrument="pencil", seed=seed).ok


def test_the_advice_at_rest_is_about_a_reading_that_has_a_value() -> None:
    advice = graphkin.check(slider_crank(omega=0, alpha=5), instrument="pencil", seed=1).advice
    assert advice is not None
    assert advice.symbol.kind in ("a", "at", "alpha")


@pytest.mark.parametrize("driver", [{"omega": 0}, {"omega": 1e-9}, {"omega": 0, "alpha": 5}, {"omega": 10}])
def test_a_drafting_program_reads_a_crank_at_any_speed(driver: dict[str, float]) -> None:
    assert graphkin.check(slider_crank(**driver), instrument="cad").ok


@pytest.mark.quick
def test_agreement_within_a_tolerance_that_accepts_anything_is_none() -> None:
    sheet = draft(mechanism_of("slider-crank-offset"))
    readings = read_off(sheet)
    exact = {r.symbol: r.value for r in readings}
    report = compare(sheet, readings, exact.__getitem__, rounding={"velocity": 1e3})
    led = {"v_B", "omega_1", "omega_3"}  # by the crank and the guide alone
    assert {None} == {row.ok for row in report.rows if row.reading.diagram == "velocity" and str(row.symbol) not in led}


@pytest.mark.quick
def test_a_report_of_readings_of_which_none_is_determined_is_not_ok() -> None:
    sheet = draft(mechanism_of("slider-crank-offset"))
    readings = [r for r in read_off(sheet) if str(r.symbol) in ("v_C", "v_C/B", "omega_2")]
    exact = {r.symbol: r.value for r in readings}
    assert not compare(sheet, readings, exact.__getitem__, rounding={"velocity": 1e3}).ok


@pytest.mark.quick
def test_a_reading_of_a_pencil_of_which_nothing_is_predicted_is_not_determined() -> None:
    sheet = draft(mechanism_of("slider-crank-offset"))
    readings = read_off(sheet)
    exact = {r.symbol: r.value for r in readings}
    known = {Symbol.parse("v_B"): Uncertainty(1e-6, ReadOff(Symbol.parse("v_B")), 1.0)}
    rows = compare(sheet, readings, exact.__getitem__, predicted=known).rows
    assert ["v_B"] == [str(row.symbol) for row in rows if row.ok]


def test_a_tiny_crank_in_a_large_mechanism_is_drawn_as_it_is_solved() -> None:
    scene = slider_crank(omega=10) | {"units": {"length": "m"}}
    scene["links"]["1"]["length"], scene["links"]["2"]["length"] = 1e-6, 1e3
    result = graphkin.check(scene)
    assert {True} == {row.ok for row in result.report.rows}


def beside_a_dead_point(printed: dict[str, float]) -> dict[str, Any]:
    return {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 100},
            "2": {"points": ["B", "C"], "length": 50},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 29.9999, "omega": 10},
        "printed": printed,
    }


def test_a_value_beside_a_dead_point_that_is_off_by_a_hair_cannot_be_judged() -> None:
    exact = graphkin.check(beside_a_dead_point({}))["omega_2"].exact.real
    (value,) = graphkin.audit(beside_a_dead_point({"omega_2": float(f"{exact * 1.00002:.9g}")})).data["values"]
    assert (None, True, None) == (value["verdict"], "why" in value, value["bound"])


def test_a_value_beside_a_dead_point_that_has_the_other_sign_is_wrong_all_the_same() -> None:
    exact = graphkin.check(beside_a_dead_point({}))["omega_2"].exact.real
    (value,) = graphkin.audit(beside_a_dead_point({"omega_2": float(f"{-exact:.9g}")})).data["values"]
    assert "wrong" == value["verdict"]


@pytest.mark.parametrize("off", [1.0, 1.04, 1.06])
def test_a_wrong_sign_in_a_drawing_that_is_off_too_is_recognised(off: float) -> None:
    exact = graphkin.check("slider-crank-offset")["alpha_2"].exact.real
    scene = graphkin.read("slider-crank-offset").replace("printed", {"alpha_2": float(f"{-exact * off:.4g}")})
    (value,) = graphkin.audit(scene).data["values"]
    assert ("wrong", "sign") == (value["verdict"], value.get("looks_like"))


def test_a_large_whole_number_rounded_beside_a_dead_point_is_not_called_wrong() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 10.7], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 79.8},
            "2": {"points": ["B", "C"], "length": 42.8},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 42.09455779248084, "omega": -11.67, "alpha": -28.2},
        "sketch": {"C": [62.215, 10.7]},
    }
    assert 2_649_564 == round(abs(graphkin.check(scene)["a_C"].exact) / 1000)
    ((_, (judged,)),) = graphkin.audit({**scene, "printed": {"a_C": 2650e6}}).people
    assert "not judged" == judged.verdict


BY_ITS_PISTON = {
    "units": {"length": "mm"},
    "frame": {"name": "4", "points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 23.8},
        "2": {"points": ["B", "C"], "length": 58.4},
        "3": {"points": ["C"], "on": "4.h"},
    },
    "driver": {"slide": "3", "travel": 82.2 - 5e-13, "velocity": 100, "acceleration": 50},
    "sketch": {"B": [23, 1]},
}


def test_what_the_driver_gives_is_determined_where_rounding_loses_the_group_behind_it() -> None:
    checked = graphkin.check(BY_ITS_PISTON)
    rows = {str(row.symbol): row for row in checked.report.rows}
    assert ["v_C", "omega_3", "a_C", "alpha_3"] == [name for name, row in rows.items() if row.ok]
    assert (0.1, 0.05) == (pytest.approx(rows["v_C"].measured), pytest.approx(rows["a_C"].true))
    assert {"v_B", "omega_1", "alpha_2"} <= {str(symbol) for symbol in checked.report.undetermined}
    assert not checked.ok  # nothing that was found is judged
