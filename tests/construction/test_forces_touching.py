"""Forces drawn where outlines touch, wheels mesh or roll, and cams move followers: as the solver has them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import graphkin
from graphkin.construction import touching
from tests import with_tables
from tests.construction.test_forces import judged
from tests.solver.test_forces import loaded

TOUCHING = with_tables("contacts", "gears", "cams")


def scene(name, at=None):
    made = loaded(graphkin.read(name).to_dict(), 5)
    if at is not None:
        made["driver"]["angle"] = at
    return made


@pytest.mark.parametrize("name", TOUCHING)
def test_forces_of_what_touches_agree_with_the_solver(name):
    assert (True, []) == judged(scene(name))


@pytest.mark.parametrize("name", ["disc-on-disc", "cam-eccentric-flat-rocker"])
def test_a_sliding_contact_pushes_along_its_normal(name):
    normal = np.ravel(graphkin.solve(name).data["positions"][0]["contacts"]["K"]["normal"])
    force = graphkin.check(scene(name))["F_1/2"].measured
    assert 0.0 == pytest.approx(normal[0] * force.imag - normal[1] * force.real, abs=1e-9 * abs(force))


def test_teeth_push_along_the_tangent_of_the_pitch_circles():
    checked = graphkin.check(scene("geared-five-bar"))
    assert 0.0 == pytest.approx(checked["F_1/4"].measured.real, abs=1e-9 * abs(checked["F_1/4"].measured))


def test_what_rolls_is_held_along_the_rail_and_square_to_it():
    given = {
        "units": {"length": "mm"},
        "frame": {"name": "0", "points": {"Z": [0, 0]}, "guides": {"f": {"through": [0, 0], "angle": 0}}},
        "links": {"1": {"points": ["C"], "discs": {"k": {"centre": "C", "r": 30}}, "start": 0}},
        "contacts": {"K": {"between": ["1.k", "0.f"], "rolling": True}},
        "driver": {"link": "1", "angle": 0, "omega": 1},
        "loads": {"P": {"on": "1", "at": "C", "force": 50, "angle": -60}},
    }
    checked = graphkin.check(given)
    assert -50 * np.exp(-1j * np.pi / 3) == pytest.approx(checked["F_0/1"].measured)
    assert 0.03 * 50 * np.cos(np.pi / 3) == pytest.approx(checked["M_1"].measured)


@pytest.mark.parametrize("name", ["gears-epicyclic", "cam-offset-roller"])
def test_forces_at_rest_are_drawn_of_wheels_and_cams_too(name):
    made = scene(name, 20)
    made["driver"] |= {"omega": 0.0, "alpha": 0.0}
    assert (True, []) == judged(made)


def test_a_force_at_a_contact_may_be_asked_for_alone():
    checked = graphkin.check(scene("disc-on-disc"), find=["F_2/1", "M_1"])
    assert [True, True] == [row["ok"] for row in checked.data["readings"] if row["symbol"] in ("F_2/1", "M_1")]


def test_a_contact_that_pushes_askew_is_found(monkeypatch):
    right = touching.Touching.touches
    monkeypatch.setattr(
        touching.Touching, "touches", lambda own: (replace(t, normal=t.normal * 1.01j) for t in right(own))
    )
    rows = graphkin.check(scene("disc-on-disc", 70)).report.rows
    assert {"F_1/2", "M_1"} <= {str(row.symbol) for row in rows if row.ok is False}
