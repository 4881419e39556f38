"""Cams by their law: motion, contact and profile against published values, differences, and envelopes."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

import graphkin
from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of
from graphkin.scene.laws import Lift
from graphkin.solver.cams import cam_at, cam_with

LAWS = ("parabolic", "harmonic", "cycloidal", "345", "4567")
LIBRARY = ("cam-offset-roller", "cam-swinging-roller", "cam-flat-face")


def random_cam(seed: int) -> dict:
    """A cam scene of any kind: follower, tip, side, sense, offset, laws."""
    r = random.Random(seed)
    swings, sense = seed % 3 == 2, r.choice((1, -1))
    flat = seed % 3 == 1
    ends = sorted(r.uniform(60, 300) for _ in range(3))
    h = r.uniform(8, 20)
    law = [{"to": ends[0], "rise": h, "by": r.choice(LAWS)}, {"to": ends[1]},
           {"to": ends[2], "fall": h, "by": r.choice(LAWS)}, {"to": 360}]
    cam = {"follower": "2", "law": law, "sense": sense, "base": {"r": 60, "of": r.choice(("profile", "pitch"))}}
    cam |= {"flat": True} if flat else {"roller": 10} if r.random() < 0.7 else {}
    axis = [r.uniform(-20, 20), r.uniform(-20, 20)]
    frame = {"points": {"A": axis}}
    if swings:
        frame["points"]["C"] = [axis[0] + r.uniform(110, 130), axis[1] + r.uniform(-30, 30)]
        follower = {"points": r.choice((["C", "B"], ["B", "C"])), "length": r.uniform(85, 100)}
    else:
        angle, off = r.uniform(0, 360), r.uniform(-15, 15)
        a = math.radians(angle)
        frame["guides"] = {"g": {"through": [axis[0] + off * math.sin(a), axis[1] - off * math.cos(a)], "angle": angle}}
        follower = {"points": ["B"], "on": "0.g", "angle_on": r.choice((0, 30))}
    driver = {"link": "1", "angle": r.uniform(0, 360), "omega": r.uniform(-9, 9), "alpha": r.uniform(-9, 9)}
    made = {"frame": frame, "links": {"1": {"points": ["A"]}, "2": follower}, "cams": {"1": cam}, "driver": driver}
    if swings:
        made["sketch"] = {"B": [axis[0] + 60, axis[1] + r.choice((80, -80))]}
    return made


@pytest.mark.quick
def test_the_offset_roller_follower_has_its_published_values():
    scene = graphkin.read("cam-offset-roller").replace("driver.alpha", 4)
    entry = graphkin.solve(scene).data["positions"][0]
    assert 1 == graphkin.solve(scene).data["mobility"]
    assert [0.0, 171.06460816166978] == pytest.approx(entry["points"]["B@2"]["velocity"], rel=1e-13)
    assert [0.0, 1185.6112707320156] == pytest.approx(entry["points"]["B@2"]["acceleration"], rel=1e-13)
    cam = entry["cams"]["1"]
    assert 8.090140682897257 == pytest.approx(cam["lift"], rel=1e-14)
    assert [10.403098420077978, 39.628837716382805] == pytest.approx(cam["contact"], rel=1e-13)
    assert [-317.03070173106244, -87.83982080104595] == pytest.approx(cam["slip"], rel=1e-13)
    assert 0.2702900171583776 == pytest.approx(cam["pressure"], rel=1e-13)


@pytest.mark.parametrize("seed", range(6))
def test_rates_are_those_of_the_positions(seed):
    scene, h = random_cam(seed), 1e-4
    driver = scene["driver"]
    first, here, last = (graphkin.solve(scene, at=driver["angle"] + k * math.degrees(h)).motion for k in (-1, 0, 1))
    before, at, after = (motion.position("B", "2")[0] for motion in (first, here, last))
    slope, bend = (after - before) / (2 * h), (after - 2 * at + before) / h**2
    velocity, acceleration = here.velocity("B", "2")[0], here.acceleration("B", "2")[0]
    assert velocity == pytest.approx(slope * driver["omega"], abs=1e-7)
    assert acceleration == pytest.approx(bend * driver["omega"] ** 2 + slope * driver["alpha"], abs=3e-5)


@pytest.mark.parametrize("seed", range(6))
def test_the_drawing_agrees_with_the_law(seed):
    checked = graphkin.check(random_cam(seed))
    assert checked.ok
    assert max(row.error for row in checked.report.rows if row.symbol.is_vector) < 1e-10


@pytest.mark.quick
@pytest.mark.parametrize("seed", range(9))
def test_the_profile_lies_a_roller_radius_inside_the_pitch_curve(seed):
    cam = mechanism_of(random_cam(seed)).cams[0]
    if cam.flat:
        pytest.skip("no pitch curve")
    at = cam_at(cam, np.linspace(0, math.tau, 721))
    assert np.full(721, cam.roller) == pytest.approx(np.abs(at.pitch - at.profile), abs=1e-15)


@pytest.mark.parametrize("seed", range(9))
def test_the_profile_is_the_envelope_of_the_follower(seed):
    """Moved along its normal, with the curvature told, and nearest to the roller's centre of all its points."""
    cam = mechanism_of(random_cam(seed)).cams[0]
    degree, h = np.linspace(0, math.tau, 500)[1:-1] + 1e-3, 1e-6
    before, at, after = (cam_at(cam, degree + k * h) for k in (-1, 0, 1))
    along = (after.profile - before.profile) / (2 * h)
    normal = at.normal * np.conj(at.turn)
    assert np.zeros(len(degree)) == pytest.approx((along * np.conj(normal)).real, abs=1e-9)
    turned = np.angle(after.normal * np.conj(after.turn) / (before.normal * np.conj(before.turn))) / (2 * h)
    smooth = np.abs(before.radius - after.radius) < 1e-5 * np.abs(at.radius)
    told = np.abs(along) / np.abs(turned)
    assert np.abs(at.radius)[smooth] == pytest.approx(told[smooth], rel=1e-4)


@pytest.mark.quick
def test_a_disc_s_own_law_drawn_back_gives_the_circle():
    """An eccentric disc under a knife edge in line lifts by e cos t + sqrt(R2 - e2 sin2 t) - (R - e)."""
    e, R = 12.0, 40.0
    cam = mechanism_of({
        "frame": {"points": {"A": [0, 0]}, "guides": {"g": {"through": "A", "angle": 90}}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["B"], "on": "0.g"}},
        "cams": {"1": {"follower": "2", "law": [{"to": 180, "rise": 2 * e, "by": "harmonic"},
                                                {"to": 360, "fall": 2 * e, "by": "harmonic"}],
                       "base": {"r": R - e}, "flat": True}},
        "driver": {"link": "1", "angle": 0, "omega": 1},
    }).cams[0]
    # the flat face is lifted by e (1 - cos t) by a circle of radius R about a centre e off the axis
    profile = cam_at(cam, np.linspace(0, math.tau, 361)).profile
    centre = (profile[90] + profile[270]) / 2
    assert np.full(361, R * 1e-3) == pytest.approx(np.abs(profile - centre), abs=1e-15)
    assert e * 1e-3 == pytest.approx(abs(centre), rel=1e-13)


UNDER = {
    "roller on a line": ({"points": ["B"], "on": "0.g", "discs": {"w": {"centre": "B", "r": 12}}}, "w", 12),
    "edge on a line": ({"points": ["B"], "on": "0.g", "discs": {"w": {"centre": "B", "r": 1e-6}}}, "w", 0),
    "face on a line": ({"points": ["B"], "on": "0.g", "guides": {"f": {"through": "B", "angle": 90}}}, "f", None),
    "roller on an arm": ({"points": ["C", "B"], "length": 100, "discs": {"w": {"centre": "B", "r": 12}}}, "w", 12),
    "edge on an arm": ({"points": ["C", "B"], "length": 100, "discs": {"w": {"centre": "B", "r": 1e-6}}}, "w", 0),
}


@pytest.mark.parametrize("name", UNDER)
def test_what_a_disc_does_to_its_follower_drawn_back_by_inversion_is_the_disc(name):
    follower, part, roller = UNDER[name]
    e, R, off = 22.0, 40.0, 4.0
    frame = {"points": {"A": [0, 0], "C": [110, 15]}, "guides": {"g": {"through": [off, 0], "angle": 90}}}
    turned = graphkin.solve({
        "frame": frame,
        "links": {"1": {"points": ["A", "O"], "length": e, "discs": {"k": {"centre": "O", "r": R}}}, "2": follower},
        "contacts": {"K": {"between": ["1.k", f"2.{part}"], "side": "outside" if part == "w" else "left"}},
        "sketch": {"B": [60, 60] if "arm" in name else [0, 80]}, "driver": {"link": "1", "angle": 0, "omega": 1},
    }, sweep=36).motion
    plain = {k: v for k, v in follower.items() if k in ("points", "on", "length")}
    cam = mechanism_of({
        "frame": frame, "links": {"1": {"points": ["A"]}, "2": plain},
        "cams": {"1": {"follower": "2", "law": [{"to": 360}], "base": {"r": 50, "of": "profile"},
                       **({"flat": True} if roller is None else {}), **({"roller": roller} if roller else {})}},
        "sketch": {"B": [60, 60]}, "driver": {"link": "1", "angle": 0, "omega": 1},
    }).cams[0]
    if "arm" in name:
        line = np.angle(cam.axis - cam.motion.centre)
        told = [cam.motion.side * x for x in (turned.angle("2") - line, turned.omega("2"), turned.alpha("2"))]
        told[0] = np.mod(told[0], math.tau)
    else:
        told = [np.asarray(x).imag for x in (turned.position("B"), turned.velocity("B"), turned.acceleration("B"))]
    lift = Lift(told[0] - cam.beginning(), told[1], told[2], np.zeros(36))
    profile = cam_with(cam, np.arange(36) * math.tau / 36, lift).profile
    assert np.full(36, R * 1e-3) == pytest.approx(np.abs(profile - e * 1e-3), abs=2e-9 if roller == 0 else 1e-12)


@pytest.mark.parametrize("name", LIBRARY)
def test_a_sweep_a_prepared_mechanism_and_single_positions_agree(name):
    swept = graphkin.solve(name, sweep=24)
    prepared = graphkin.prepare(name, find=["v_B", "a_B"]).sweep(24)
    one = graphkin.solve(name, at=float(swept.table["driver_1"][7]))
    assert one["a_B"][0] == pytest.approx(swept["a_B"][7], rel=1e-12)
    assert swept["a_B"] == pytest.approx(prepared["a_B"], rel=1e-12, abs=1e-9)


def test_a_follower_that_does_not_come_to_the_base_circle_is_told_with_what_would_do():
    scene = graphkin.read("cam-swinging-roller").replace("cams.1.base.r", 5)
    with pytest.raises(Unsolvable, match="between 15 mm and 165 mm"):
        graphkin.solve(scene)


def test_a_follower_does_not_drive_its_cam():
    made = graphkin.read("cam-swinging-roller").to_dict()
    made["driver"] = {"link": "2", "angle": 100, "omega": 1}
    with pytest.raises(Unsolvable, match="drive cam 1"):
        graphkin.solve(made)


@pytest.mark.parametrize("name", LIBRARY)
def test_stroke_and_speed_ratio_of_a_follower_are_drawn_as_the_law_says(name):
    link = "swing_2" if "swing" in name else "stroke_2/0"
    expected = 24 if "flat" not in name else 20
    row = graphkin.check(name, find=[link])[link]
    assert (True, pytest.approx(expected)) == (row.ok, row.measured)


@pytest.mark.parametrize("name", LIBRARY)
def test_a_pencil_draws_the_stroke_of_a_follower_within_what_it_promises(name):
    link = "swing_2" if "swing" in name else "stroke_2/0"
    assert graphkin.check(name, find=[link], instrument="pencil", seed=1)[link].ok


def test_a_roller_on_a_straight_stretch_of_the_pitch_curve_is_not_drawn_a_second_time_at_its_contact():
    inflected = graphkin.read("cam-offset-roller").replace("cams.1.base", {"r": 30, "of": "pitch"})
    drawn = [graphkin.check(inflected, at=angle).at_contacts is not None for angle in (19.49253920288448, 40)]
    assert [False, True] == drawn


GEARED = {
    "frame": {"points": {"A": [0, 0], "O": [-60, 0]}, "guides": {"g": {"through": "A", "angle": 90}}},
    "links": {"3": {"points": ["O"]}, "1": {"points": ["A"]}, "2": {"points": ["B"], "on": "0.g"}},
    "gears": {"g": {"between": ["3", "1"], "teeth": [20, 40]}},
    "cams": {"1": {"follower": "2", "law": [{"to": 120, "rise": 20, "by": "345"}, {"to": 360, "fall": 20, "by": "345"}],
                   "base": {"r": 30}, "roller": 8}},
    "driver": {"link": "3", "angle": 50, "omega": 6},
}


@pytest.mark.parametrize("at", [None, 400])
def test_a_cam_that_a_gear_turns_is_drawn_where_the_gear_has_brought_it(at):
    checked = graphkin.check(GEARED, at=at)
    assert checked.ok
    solved = graphkin.solve(GEARED, at=at).data["positions"][0]
    assert -3 == pytest.approx(solved["links"]["1"]["omega"])
