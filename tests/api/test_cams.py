"""``graphkin cam``: what is found of cams, their points, figures and files."""

from __future__ import annotations

import io
import json
import math
import re

import numpy as np
import pytest

import graphkin
from graphkin.checking.closed_form import compare_cam
from graphkin.construction.cam_sheet import cam_sheet
from graphkin.errors import CallError
from graphkin.scene import mechanism_of
from graphkin.solver.cam_profile import cam_at
from graphkin.solver.cam_study import study_cam
from tests.command import run
from tests.solver.test_cams import LIBRARY, random_cam


@pytest.mark.quick
@pytest.mark.parametrize("seed", range(6))
def test_extremes_are_those_of_many_positions(seed):
    cam = mechanism_of(random_cam(seed)).cams[0]
    study, at = study_cam(cam), cam_at(cam, np.linspace(0, math.tau, 8001)[:-1])
    rising, falling = at.slope > 1e-9, at.slope < -1e-9
    assert study.rise.value == pytest.approx(at.pressure[rising].max(), abs=5e-3)
    assert study.rise.value >= at.pressure[rising].max() - 1e-13
    assert study.fall.value >= at.pressure[falling].max() - 1e-13
    assert abs(study.velocity.value) == pytest.approx(np.abs(at.slope).max(), rel=5e-3)
    convex = at.radius if cam.flat else at.radius[at.radius + cam.roller > 0]
    assert study.radius.value == pytest.approx(convex.min(), abs=3e-4)


@pytest.mark.parametrize("seed", range(6))
def test_the_cam_drawn_by_inversion_is_the_computed_one(seed):
    assert compare_cam(cam_sheet(mechanism_of(random_cam(seed)).cams[0], 1e-3)).ok


def test_a_roller_that_is_too_large_is_told_with_the_largest_that_would_do():
    scene = graphkin.read("cam-offset-roller").replace("cams.1.base", {"r": 41, "of": "pitch"})
    found = graphkin.cam(scene.replace("cams.1.roller", 40.5))
    one = found["1"]
    assert not found.ok
    assert len(one.study.undercut) == 1
    (said,) = [text for text in one.sentences("en") if "undercut" in text]
    most = float(re.search(r"at most ([\d.]+) mm", said)[1])
    held = graphkin.cam(scene.replace("cams.1.roller", most - 1e-3))
    assert () == held["1"].study.undercut


def test_the_nearest_base_circle_keeps_the_allowed_pressure_angle():
    scene = graphkin.read("cam-offset-roller").replace("cams.1.allow.fall", 25)
    one = graphkin.cam(scene)["1"]
    assert (True, False) == one.study.judged
    better = scene.replace("cams.1.base.r", one.wanted_base * 1e3)
    assert 25 == pytest.approx(math.degrees(graphkin.cam(better)["1"].study.fall.value), abs=1e-4)


def test_velocity_and_acceleration_that_jump_are_told():
    law = [{"to": 120, "rise": 24, "by": "uniform"}, {"to": 360, "fall": 24, "by": "harmonic"}]
    scene = graphkin.read("cam-offset-roller").replace("cams.1.law", law)
    assert {(1, 0), (1, 120)} == {(j.order, round(math.degrees(j.degree))) for j in graphkin.cam(scene)["1"].study.jumps
                                  if j.order == 1}  # fmt: skip


@pytest.mark.quick
def test_the_table_has_a_row_a_degree_with_the_heads_of_the_contract(tmp_path):
    graphkin.draw("cam-offset-roller", tmp_path, figures=["cam"])
    lines = (tmp_path / "cam.csv").read_text().splitlines()
    assert "cam,angle_deg,lift,pitch_x,pitch_y,profile_x,profile_y,pressure_deg" == lines[0]
    assert 361 == len(lines)
    rows = np.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    assert rows[:, 1].tolist() == list(range(360))
    pitch, profile = rows[:, 3] + 1j * rows[:, 4], rows[:, 5] + 1j * rows[:, 6]
    assert np.full(360, 9.0) == pytest.approx(np.abs(pitch - profile), abs=1e-9)


def test_a_flat_face_has_no_pitch_curve_in_the_table():
    table = graphkin.cam("cam-flat-face").table
    assert np.isnan(table["pitch_x"]).all()
    assert ",,," in table.csv().splitlines()[1] or ",," in table.csv().splitlines()[1]


@pytest.mark.parametrize("name", LIBRARY)
def test_the_profile_for_the_mill_keeps_within_a_millionth_of_a_millimetre(name):
    one = graphkin.cam(name)["1"]
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.read(io.StringIO(one.profile_dxf().decode()))
    (curve,) = document.modelspace().query("LWPOLYLINE")
    assert curve.closed
    vertices = [(complex(x, y), bulge) for x, y, bulge in curve.get_points("xyb")]
    ends = [z for z, _ in vertices[1:]] + [vertices[0][0]]
    points = cam_at(one.cam, np.linspace(0, math.tau, 1000)).profile * 1e3
    off = np.full(len(points), np.inf)
    for (p, bulge), q in zip(vertices, ends, strict=True):
        chord = q - p
        near = np.abs(points - (p + q) / 2) <= abs(chord) * 0.75 + 1e-9
        if abs(chord) < 1e-12 or not near.any():
            continue
        if abs(bulge) < 1e-12:
            far = np.abs(((points[near] - p) * np.conj(chord)).imag) / abs(chord)
        else:
            centre = (p + q) / 2 + 1j * chord * (1 - bulge**2) / (4 * bulge)
            far = np.abs(np.abs(points[near] - centre) - abs(p - centre))
        off[near] = np.minimum(off[near], far)
    assert off.max() < 1e-6


@pytest.mark.parametrize("language", ["en", "zh", "both"])
def test_the_figure_names_every_division(language):
    found = graphkin.cam("cam-offset-roller", language=language)
    svg = found.figures["cam"].content("svg").decode()
    assert all(f'id="label-division-{k}"' in svg for k in range(18))
    assert 'id="cam-1"' in svg


def test_the_command_writes_its_files_and_says_what_it_found(tmp_path):
    done = run("cam", "cam-swinging-roller", "-o", str(tmp_path), "--format", "svg,dxf", "--step", "0.5")
    assert 0 == done.returncode
    assert {"cam.svg", "cam.dxf", "cam.csv", "profile-1.dxf"} == {path.name for path in tmp_path.iterdir()}
    assert 721 == len((tmp_path / "cam.csv").read_text().splitlines())
    assert "greatest pressure angle of the rise: 28.8087°" in done.stdout


def test_the_command_s_json_has_each_cam(tmp_path):
    done = run("cam", "cam-flat-face", "--json", "-o", str(tmp_path))
    data = json.loads(done.stdout)
    assert (True, 20) == (data["ok"], pytest.approx(data["cams"]["1"]["rise"]))


def test_a_scene_without_a_cam_is_told_so():
    with pytest.raises(CallError, match="has no cam"):
        graphkin.cam("shaper-scheme-2")


EXERCISE = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"g": {"through": "A", "angle": 90}}},
    "links": {
        "1": {"points": ["A", "O"], "length": 11.5, "discs": {"k": {"centre": "O", "r": 16.5}}},
        "2": {"points": ["B"], "on": "0.g", "discs": {"w": {"centre": "B", "r": 5}}},
    },
    "contacts": {"K": {"between": ["1.k", "2.w"]}},
    "driver": {"link": "1", "angle": 0, "omega": 10},
}


def test_an_eccentric_disc_is_measured_as_the_cam_that_it_is():
    disc = graphkin.cam(EXERCISE).data["discs"]["K"]
    assert (10, 5) == pytest.approx((disc["base"]["pitch"], disc["base"]["profile"]), abs=1e-12)
    assert (23, 0) == pytest.approx((disc["rise"], disc["offset"]), abs=1e-12)
    assert math.asin(11.5 / 21.5) == pytest.approx(disc["pressure"]["greatest"], rel=1e-12)
    assert 0 == pytest.approx(math.sin(disc["pressure"]["at"]), abs=1e-7)


def test_a_disc_under_a_flat_rocker_has_no_pressure_angle():
    disc = graphkin.cam("cam-eccentric-flat-rocker").data["discs"]["K"]
    assert 28 == pytest.approx(disc["base"]["profile"])
    assert 0 == pytest.approx(disc["pressure"]["greatest"], abs=1e-7)
