"""Formulas are kept for all mechanisms of one form: whatever tells two of them apart is a number that stays open."""

from __future__ import annotations

from typing import Any

import pytest

import graphkin
from graphkin.scene import library, mechanism_of
from graphkin.solver import structure_of
from graphkin.solver.compiled.program import program_of

PURE = {0.0, 1.0, -1.0, 2.0, 3.0, 4.0, 0.5}
"""Numbers of the formulas themselves."""


def sun_and_planet(teeth: list[int], carrier: str = "1") -> dict[str, Any]:
    """Watt's: the planet is one with the connecting rod BC, the sun turns about A."""
    return {
        "frame": {"points": {"A": [0, 0], "D": [100, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30},
            "2": {"points": ["A"], "start": 10},
            "3": {"points": ["B", "C"], "length": 100},
            "4": {"points": ["D", "C"], "length": 45},
        },
        "gears": {"g": {"between": ["2", "3"], "teeth": teeth, "carrier": carrier}},
        "driver": {"link": "1", "angle": 60, "omega": 10},
        "sketch": {"C": [115, 26]},
    }


def rack_on_a_slider(y: float) -> dict[str, Any]:
    """A slider-crank whose slider carries a rack, in which a wheel about D turns; its radius is y + 35."""
    return {
        "frame": {"points": {"A": [0, 0], "D": [90, -35]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30},
            "2": {"points": ["B", "C"], "length": 95},
            "3": {"points": ["C"], "on": "0.h", "guides": {"r": {"through": [0, y], "angle": 0}}},
            "4": {"points": ["D"]},
        },
        "gears": {"g": {"between": ["4", "3.r"], "teeth": [22, "rack"]}},
        "driver": {"link": "1", "angle": 55, "omega": 10},
    }


def sun_and_planet_discs(r: float) -> dict[str, Any]:
    """The sun and the planet as discs that roll on each other; r is the sun's radius."""
    tables = sun_and_planet([1, 1])
    del tables["gears"]
    tables["links"]["2"]["discs"] = {"s": {"centre": "A", "r": r}}
    tables["links"]["3"]["discs"] = {"p": {"centre": "B", "r": 30 - r}}
    return tables | {"contacts": {"K": {"between": ["2.s", "3.p"], "rolling": True}}}


ROLLING = sun_and_planet([20, 37]), rack_on_a_slider(-13), sun_and_planet_discs(13)


@pytest.mark.parametrize("source", [*library(), *ROLLING], ids=lambda s: s if isinstance(s, str) else "rolls")
def test_a_program_holds_no_number_of_a_mechanism(source):
    structure = structure_of(mechanism_of(source))
    program = program_of(structure, tuple(True for _ in structure.drivers)).program
    assert {line[1] for line in program.graph.lines if line[0] == "const"} <= PURE


def by_willis(teeth: tuple[float, float]) -> float:
    """w2 = w1 + (w1 - w3) z3 / z2, with w3 of the four-bar linkage without wheels."""
    tables = sun_and_planet([1, 1])
    del tables["gears"], tables["links"]["2"]
    rod = float(graphkin.solve(tables)["omega_3"][0])
    return 10 + (10 - rod) * teeth[1] / teeth[0]


def test_the_sun_turns_by_its_own_teeth_whatever_was_solved_before():
    for teeth in ((20, 20), (20, 40), (20, 37), (37, 20), (20, -60), (20, 20)):
        assert by_willis(teeth) == pytest.approx(graphkin.solve(sun_and_planet([*teeth]))["omega_2"][0], rel=1e-12)


def test_the_sun_turns_by_its_own_radius_whatever_was_solved_before():
    for r in (15, 10, 13, 26, 15):
        assert by_willis((r, 30 - r)) == pytest.approx(graphkin.solve(sun_and_planet_discs(r))["omega_2"][0], rel=1e-12)


def test_designs_of_a_sweep_have_their_own_ratios():
    designs = {"links.3.guides.r.through.y": [-13, -20, -13]}
    table = graphkin.sweep(rack_on_a_slider(-13), designs=designs, positions=1, find=["omega_4"]).table
    motion = graphkin.solve(rack_on_a_slider(-13)).motion
    slider = 1000 * float(motion.velocity("C")[0].real)
    assert [-slider / 22, -slider / 15, -slider / 22] == pytest.approx(table["omega_4"].tolist(), rel=1e-12)
