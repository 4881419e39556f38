"""Sliding contacts drawn at the contact itself, against what replaces them and against the solver."""

from __future__ import annotations

import json
import math
import re
from types import SimpleNamespace

import pytest

from graphkin import centres, check, draw, read
from graphkin.construction.touching import Touch, Touching

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
    }


FINGER = {
    "frame": {"points": {"A": [0, 0], "C": [120, 0]}},
    "links": {
        "1": {"points": ["A", "O"], "length": 15, "discs": {"k": {"centre": "O", "r": 40}}},
        "2": {"points": ["C", "D"], "length": 70},
        "3": {"points": ["D", "E"], "length": 30, "discs": {"w": {"centre": "E", "r": 10}}},
    },
    "contacts": {"K": {"between": ["1.k", "3.w"]}}, "sketch": {"E": [40, 30]},
    "driver": [{"link": "1", "angle": 50, "omega": 8, "alpha": 1},
               {"link": "3", "relative_to": "2", "angle": 60, "omega": 2, "alpha": -3}],
}
FEET = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"ceiling": {"through": [0, 90], "angle": 10},
                                                   "wall": {"through": [100, 0], "angle": 80}}},
    "links": {
        "1": {"points": ["A", "O"], "length": 12, "discs": {"k": {"centre": "O", "r": 30}}},
        "2": {"points": ["P", "Q"], "length": 90, "at": {"R": [30, 40]},
              "discs": {"p": {"centre": "P", "r": 10}, "q": {"centre": "Q", "r": 12}, "r": {"centre": "R", "r": 8}}},
    },
    "contacts": {"K": {"between": ["1.k", "2.p"]}, "L": {"between": ["2.q", "0.wall"]},
                 "M": {"between": ["2.r", "0.ceiling"], "side": "right"}},
    "sketch": {"P": [5.9, 51.6], "Q": [95, 44], "R": [39, 89]},
    "driver": {"link": "1", "angle": 80, "omega": 6, "alpha": 2},
}
TWO_FACES = {
    "frame": {"points": {"A": [0, 0], "C": [100, 0], "F": [160, 60]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 20},
        "2": {"points": ["B", "P"], "length": 70, "discs": {"p": {"centre": "P", "r": 10}}},
        "3": {"points": ["C"], "at": {"S": [60, 0]}, "guides": {"f": {"through": [0, 6], "angle": 0}}},
        "4": {"points": ["S", "T"], "length": 50},
        "5": {"points": ["F", "T"], "length": 45, "guides": {"h": {"through": [0, 0], "angle": 20}}},
    },
    "contacts": {"K": {"between": ["2.p", "3.f"]}, "L": {"between": ["2.p", "5.h"]}},
    "sketch": {"P": [80, 30], "S": [110, 60], "T": [150, 100]}, "driver": {"link": "1", "angle": 70, "omega": 5},
}
SLOT = {
    "frame": {"points": {"A": [0, 0], "C": [90, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 25},
        "2": {"points": ["C"], "guides": {"s": {"centre": [20, 40], "r": 80}}},
    },
    "pins": {"B": {"of": "1", "in": "2.s"}}, "driver": {"link": "1", "angle": 70, "omega": 9, "alpha": 4},
}
FURTHER = {
    "driver inside": FINGER, "three contacts of one link": FEET, "superposition": TWO_FACES, "circular slot": SLOT,
    "flat face by law": "cam-flat-face",
    "links named by words": json.loads(re.sub(r'"([1-5])(?=[".])', r'"link\1', json.dumps(TWO_FACES))),
}


@pytest.mark.parametrize("name", FURTHER)
def test_both_ways_agree_in_every_class_of_group(name):
    result = check(FURTHER[name])
    first = {row.symbol: row.reading.value for row in result.report.rows}
    both = [(row, first[row.symbol]) for row in result.at_contacts.report.rows if row.symbol in first]
    assert len(both) >= 10
    for row, other in both:
        assert row.exact == pytest.approx(other, rel=1e-9, abs=1e-9)
        assert row.exact == pytest.approx(row.reading.value, rel=1e-9, abs=1e-9)


def test_a_law_s_face_slips_on_the_cam_by_radius_and_rate():
    other = check("cam-flat-face").at_contacts  # contact 48.2918 + 0.3820 mm from the axis: |v_K1| / omega
    below = other["v_K@1"].exact.real
    assert -below == pytest.approx(other["v_K@2/K@1"].exact.real)
    assert other["v_K@2"].exact.real == 0.0


def test_pencil_draws_both_ways_within_what_is_predicted():
    result = check("disc-on-disc", instrument="pencil", seed=3)
    row = result.at_contacts["alpha_2"]
    assert result.at_contacts.ok
    assert 0.01 * abs(row.exact) < row.tolerance < 0.5 * abs(row.exact)


def test_a_pin_in_a_straight_slot_touches_at_its_own_centre():
    rows = check("geneva-step").data["readings"]
    assert [row["measured"] for row in rows] == [row["at_contact"] for row in rows]


def test_what_stands_for_a_cam_at_one_position_does_not_move_on():
    page = centres("cam-offset-roller").in_motion._repr_svg_()
    assert 'id="cam-1"' in page
    assert 'id="follower-2"' in page
    assert 'id="point-O"' not in page


def test_limit_positions_of_a_cam_are_no_angles_of_a_crank():
    page = draw("cam-offset-roller", figures=["positions"]).figures["positions"]._repr_svg_()
    assert "24 mm" in "".join(re.findall(r">([^<]*)<", page))
    assert "210°" not in page  # what a crank would turn between them


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
    assert abs(2 * abs(turned) * slip - turned**2 * 50) == pytest.approx(abs(other["an_K@2/K@1"].exact), rel=1e-12)


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
}


def test_a_wheel_that_a_rod_rolls_swings_by_the_stroke_over_its_radius():
    assert math.degrees(50 / 30) == pytest.approx(check(WHEEL_BY_ROD, find=["swing_3"])["swing_3"].measured)


def test_a_rod_whose_wheel_is_not_asked_for_is_held_by_it_all_the_same():
    assert check(WHEEL_BY_ROD, find=["omega_2"]).ok


def test_a_wheel_that_the_shaft_of_a_cam_turns_stands_where_it_has_rolled() -> None:
    scene = read("cam-flat-face").to_dict()
    scene["frame"]["points"]["P"] = [60, 0]
    scene["links"]["3"] = {"points": ["P", "Q"], "length": 20, "start": 30}
    scene["gears"] = {"g": {"between": ["1", "3"], "teeth": [20, 40]}}
    result = check(scene, at=100, find=["theta_3"])
    # 30 degrees less half of the 40 that the cam has turned
    assert 10 == pytest.approx(result["theta_3"].measured, abs=1e-12)


@pytest.mark.parametrize(("name", "drawn"), [("geneva-step", True), ("slotter-75-150", False)])
def test_readings_at_contacts_are_those_of_pins_in_slots_not_of_blocks(name, drawn):
    assert drawn == ("at_contact" in check(name).data["readings"][0])


def test_a_link_that_slides_on_another_has_no_part_in_the_path_of_a_pin_in_its_circular_slot():
    scene = {
        "frame": {"points": {"A": [0, 0], "F": [150, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 60},
            "2": {"on": "1", "guides": {"c": {"centre": [100, 30], "r": 70}}},
            "4": {"points": ["F", "P"], "length": 80},
        },
        "pins": {"P": {"of": "4", "in": "2.c"}},
        "driver": [{"link": "1", "angle": 20, "omega": 3}, {"link": "4", "angle": 100, "omega": -2}],
        "sketch": {"P": [136, 79]},
    }
    assert check(scene).ok


def test_two_cams_touch_at_places_with_letters_of_their_own() -> None:
    cam = SimpleNamespace(by_law=False, bodies=("1", "2"))

    class TwoCams(Touching):
        def each(self):
            return iter([(cam, Touch("K", cam.bodies, 0j, 1j, "slides"))] * 2)

    scene = SimpleNamespace(holders={"K": ("3",)}, contact_at={})
    assert ["K'", "K''"] == [touch.name for touch in TwoCams(scene, 1.0, {}).touches()]
