"""Sliding contacts drawn at the contact itself, against what replaces them and against the solver."""

from __future__ import annotations

import pytest

from graphkin import check, draw

FRAME = {"points": {"A": [0, 0], "C": [110, 15]}, "guides": {"g": {"through": [4, 0], "angle": 80}}}
ECCENTRIC = {"points": ["A", "O"], "length": 22, "discs": {"k": {"centre": "O", "r": 40}}}
FOLLOWERS = {
    "flat arm": ({"points": ["C"], "guides": {"f": {"through": [0, 6], "angle": 5}}}, "f"),
    "round arm": ({"points": ["C", "B"], "length": 70, "discs": {"r": {"centre": "B", "r": 12}}}, "r"),
    "hollow arm": ({"points": ["C", "B"], "length": 105, "discs": {"r": {"centre": "B", "r": -85}}}, "r"),
    "flat slider": ({"on": "0.g", "guides": {"f": {"through": [0, 0], "angle": 95}}}, "f"),
    "round slider": ({"points": ["B"], "on": "0.g", "discs": {"r": {"centre": "B", "r": 12}}}, "r"),
}


def scene(name):
    follower, part = FOLLOWERS[name]
    return {
        "frame": FRAME, "links": {"1": ECCENTRIC, "2": follower}, "contacts": {"K": {"between": ["1.k", f"2.{part}"]}},
        "driver": {"link": "1", "angle": 50, "omega": 9, "alpha": -4},
    }  # fmt: skip


@pytest.mark.parametrize("name", FOLLOWERS)
def test_both_ways_and_the_solver_agree(name):
    result = check(scene(name))
    assert result.ok
    for row in result.at_contacts.report.rows:
        assert row.exact == pytest.approx(row.reading.value, rel=1e-9, abs=1e-9)


def test_a_face_s_contact_wanders_with_the_square_of_the_relative_rate():
    other = check("cam-eccentric-flat-rocker").at_contacts
    driven = {r: other[r].exact for r in ("omega_1", "omega_2")}
    slip = abs(other["v_K@2/K@1"].exact)
    turned = driven["omega_2"] - driven["omega_1"]
    assert abs(2 * abs(turned) * slip - turned**2 * 0.05) == pytest.approx(abs(other["an_K@2/K@1"].exact), rel=1e-12)


def test_the_figure_of_contacts_has_both_polygons():
    pages = draw("disc-on-disc", figures=["contacts"]).figures
    assert ["contacts", "contacts-2"] == list(pages)
    assert 'id="ak_K2-K1"' in pages["contacts-2"]._repr_svg_()


def test_each_reading_says_what_the_other_way_gives():
    rows = {row["symbol"]: row for row in check("disc-on-disc").data["readings"]}
    assert rows["alpha_2"]["measured"] == pytest.approx(rows["alpha_2"]["at_contact"], rel=1e-9)


@pytest.mark.parametrize("name", ["cam-offset-roller", "cam-swinging-roller"])
def test_a_roller_turns_about_the_centre_of_curvature_of_its_pitch_curve(name):
    result = check(name)
    assert "omega_OB" in {str(row.symbol) for row in result.report.rows}
    for row in (*result.report.rows, *result.at_contacts.report.rows):
        assert row.exact == pytest.approx(row.reading.value, rel=1e-9, abs=1e-9)


WHEEL_BY_ROD = {
    "frame": {"points": {"A": [0, 30]}, "guides": {"r": {"through": [0, 0], "angle": 0}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 25}, "2": {"points": ["B", "C"], "length": 90},
        "3": {"points": ["C", "P"], "length": 20, "discs": {"w": {"centre": "C", "r": 30}}, "start": 20},
    },
    "contacts": {"K": {"between": ["3.w", "0.r"], "rolling": True}},
    "driver": {"link": "1", "angle": 50, "omega": 6, "alpha": 2},
    "sketch": {"C": [100, 30]},
}  # fmt: skip


def test_a_wheel_that_a_rod_rolls_swings_by_the_stroke_over_its_radius():
    assert 50 / 30 == pytest.approx(check(WHEEL_BY_ROD, find=["swing_3"])["swing_3"].measured)


def test_a_rod_whose_wheel_is_not_asked_for_is_held_by_it_all_the_same():
    assert check(WHEEL_BY_ROD, find=["omega_2"]).ok
