"""Wrong forces are called by the slip that gives them."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import graphkin
from graphkin import solver
from graphkin.checking.slips import slipped_forces
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol
from tests.scenes import slider_crank

SHAPER = Path(__file__).parent.parent / "validation" / "forces" / "shaper-scheme-2.toml"
AT = {"7": 14.900596687829875, "10": -75.09940331217012}


def by_hand(**tables):
    """The balance of the shaper at position 10 with other tables."""
    scene = graphkin.read(SHAPER).to_dict()
    for path, value in tables.items():
        *where, last = path.split("__")
        table = scene
        for key in where:
            table = table[key]
        if value is None:
            del table[last]
        else:
            table[last] = value
    return graphkin.solve(scene, at=AT["10"])["M_2"][0]


SLIPS = {
    "slip load not here": {"loads__P__when": None},
    "slip inertia left out": {"masses__4__inertia": 0.0},
    "slip weight left out": {"gravity__g": 1e-12, "masses__4": {"at": "S4", "mass": 220 / 9.8, "inertia": 1.2},
                             "masses__6": {"at": "C", "mass": 800 / 9.8}},
}


@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_gives_what_the_scene_with_it_gives(slip):
    motion = solver.solve(mechanism_of(SHAPER), at={"2": math.radians(AT["10"])})
    values = [of(Symbol.parse("M_2")) for phrase, _, of in slipped_forces(motion) if phrase.key == slip]
    wrong = by_hand(**SLIPS[slip])
    assert any(wrong == pytest.approx(value, rel=1e-8) for value in values)


def test_a_wrong_force_of_the_frame_is_called_by_its_slip():
    # position 7, by hand: the guide carries the ram's weight and the moments of the rod
    scene = graphkin.read(SHAPER).to_dict()
    right = graphkin.solve(scene)
    push, cut = right["Fi_6"][0].real, -9000.0
    slope = right["F_5/6"][0].imag / right["F_5/6"][0].real
    scene["printed"] = {"F_1/6": f"{abs(800 + (cut - push) * slope):.4f}", "by": "computation"}
    (value,) = graphkin.audit(scene).data["values"]
    assert "wrong" == value["verdict"]
    assert "inertia force in the sense of the acceleration (link 6)" == value["looks_like"]


def test_drawn_forces_are_right_within_what_a_pencil_keeps():
    scene = graphkin.read(SHAPER.parent / "engine.toml").to_dict()
    exact = abs(graphkin.solve(scene)["F_2/3"][0])
    scene["printed"] = {"F_2/3": round(exact * 1.004)}
    (value,) = graphkin.audit(scene).data["values"]
    assert "within drafting accuracy" == value["verdict"]


@pytest.mark.parametrize(("force", "mass", "called"), [
    ("N", "kg", "N taken for kg in the inertia forces"),
    ("lbf", "lb", "inertia forces in lb·m/s² taken for lbf: not divided by 9.80665"),
])
def test_an_inertia_force_too_large_by_g_is_called_in_the_units_of_its_scene(force, mass, called):
    scene = slider_crank(50, 180, units={"length": "mm", "force": force, "mass": mass}, gravity={"g": 9.80665},
                         masses={"2": {"at": [60, 0], "mass": 3, "inertia": 0.02}})
    exact = abs(graphkin.solve(scene)["Fi_2"][0])
    (value,) = graphkin.audit(scene | {"printed": {"Fi_2": f"{exact * 9.80665:.5g}"}}).data["values"]
    assert called == value["looks_like"]
