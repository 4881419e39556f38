"""Special points of two moving links: which legs serve, which point is taken, and where there is none."""

from __future__ import annotations

import cmath
import math
from typing import Any

import pytest

import graphkin
from graphkin.api.checked import Checked
from graphkin.construction.board.steps import Step
from tests.construction.test_groups import CONTOUR, everything

IN_PARTS: dict[str, Any] = {  # one plate of three parts, the other of two, their hinges driven; two bars join them
    "frame": CONTOUR["frame"],
    "links": {
        "2": {"points": ["A", "B"], "length": 40},
        "3": {"points": ["B", "C"], "length": 60, "at": {"H": [20, 40]}},
        "4": {"points": ["C", "E"], "length": 75},
        "5": {"points": ["D", "F"], "length": 70},
        "6": {"points": ["G", "E"], "length": 80, "at": {"K": [70, -30]}},
        "7": {"points": ["H", "L"], "length": 28},
        "8": {"points": ["K", "F"], "length": 50},
        "9": {"points": ["L", "D"], "length": 25},
    },
    "driver": [
        CONTOUR["driver"],
        {"link": "7", "relative_to": "3", "angle": 45, "omega": 3, "alpha": 5},
        {"link": "9", "relative_to": "7", "angle": 20, "omega": 1, "alpha": -4},
        {"link": "8", "relative_to": "6", "angle": -60, "omega": -2, "alpha": 9},
    ],
    "sketch": CONTOUR["sketch"],
}


def bent_leg(off: float) -> dict[str, Any]:
    """One of the bars in two, of which the first is turned at a given rate, so many degrees off the line of both."""
    motion = graphkin.solve(CONTOUR).motion
    at = {p: complex(motion.position(p)[0]) * 1000 for p in "CDEF"}
    way = (at["E"] - at["C"]) / abs(at["E"] - at["C"]) * cmath.rect(1.0, math.radians(off))
    hinge = at["C"] + 30 * way
    halves = {"4": {"points": ["C", "X"], "length": 30}, "9": {"points": ["X", "E"], "length": abs(at["E"] - hinge)}}
    turned = {"link": "4", "angle": math.degrees(cmath.phase(way)), "omega": 2, "alpha": -7}
    sketch = {p: [z.real, z.imag] for p, z in {**at, "X": hinge}.items()}
    return {**CONTOUR, "links": {**CONTOUR["links"], **halves}, "driver": [CONTOUR["driver"], turned], "sketch": sketch}


def special(result: Checked) -> list[Step]:
    return [step for step in result.sheet.steps if step.reason == "special point"]


def off(result: Checked) -> list[str]:
    return [str(row.symbol) for row in result.report.rows if row.error > 1e-9 * max(abs(row.exact), 1e-3)]


def test_legs_may_lead_over_links_that_drivers_hold_on_both_sides() -> None:
    result = graphkin.check(IN_PARTS)
    assert ("special points", []) == (result.data["construction"], off(result))
    assert set() == everything(IN_PARTS) - {str(row.symbol) for row in result.report.rows}


def test_of_two_links_with_a_special_point_those_are_taken_that_have_their_joints_nearer_to_it() -> None:
    result = graphkin.check(IN_PARTS)
    at = {str(ref): z for ref, z in result.sheet.points.items()}
    (act,) = (act for act in special(result) if act.base)
    lies = at[act.point]
    near, far = ((at[p] + at[q]) / 2 for p, q in (("E", "F"), ("C", "D")))
    assert abs(lies - near) < abs(lies - far)
    assert {"E", "F"} == set(act.points)


@pytest.mark.parametrize(("turned", "way"), [(0.0, "special points"), (0.2, "superposition"), (5.0, "superposition")])
def test_a_leg_of_two_bars_serves_where_they_lie_in_line(turned: float, way: str) -> None:
    result = graphkin.check(bent_leg(turned))
    assert (way, []) == (result.data["construction"], off(result))
    assert (turned == 0.0) == any(act.base for act in special(result))


@pytest.mark.parametrize("way", [10.0, 33.0, -47.0])
def test_in_a_parallelogram_lies_no_special_point_that_could_be_told_of(way: float) -> None:
    b, along = cmath.rect(40, math.radians(70)), cmath.rect(1.0, math.radians(way))
    at = {"B": b, "C": 60 + 75j, "D": 120j, "E": 60 + 75j + 75 * along, "F": 120j + 75 * along, "G": 190 - 10j}

    def plate(p: str, q: str, third: str) -> dict[str, Any]:
        bar = at[q] - at[p]
        own = (at[third] - at[p]) * abs(bar) / bar
        return {"points": [p, q], "length": abs(bar), "at": {third: [own.real, own.imag]}}

    links = {**CONTOUR["links"], "3": plate("B", "C", "D"), "5": {"points": ["D", "F"], "length": 75},
             "6": plate("G", "E", "F")}
    scene = {**CONTOUR, "links": links, "sketch": {p: [at[p].real, at[p].imag] for p in "CDEF"}}
    result = graphkin.check(scene)
    assert ("superposition", []) == (result.data["construction"], off(result))
    trials = [step for step in result.sheet.steps if step.reason == "polygon"]
    assert [None, None] == [trial.far for trial in trials if trial.trial == 1]


def test_the_coriolis_term_of_a_point_beside_the_pin_is_that_of_the_link_from_which_it_is_seen() -> None:
    two_slots = {
        "frame": {"points": {"Z": [-100, -43]}},
        "links": {
            "2": {"points": ["N", "Z"], "length": 46,
                  "guides": {"p": {"through": [133, -23], "angle": -93}, "q": {"through": [228, -24], "angle": -24}}},
            "3": {"points": ["I", "W"], "length": 190, "at": {"V": [28, 40]}},
        },
        "pins": {"W": {"of": "3", "in": "2.p"}, "V": {"of": "3", "in": "2.q"}},
        "driver": [{"link": "3", "angle": -105, "omega": 10, "alpha": 5},
                   {"slide": "V/2", "travel": 59, "velocity": -30}],
        "sketch": {"N": [-134, -74], "W": [34, -68], "V": [107, 81]},
    }
    result = graphkin.check(two_slots)
    seen = 2 * abs(result["v_Z@2/Z@3"].exact) * 10
    assert (seen, []) == (pytest.approx(abs(result["ak_Z@2/Z@3"].exact)), off(result))
