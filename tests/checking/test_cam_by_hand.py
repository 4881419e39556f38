"""Cams drawn division by division by hands that err."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import pytest

from graphkin import cam, check, handout, read
from graphkin.checking.closed_form import compare_cam, predict_cam
from graphkin.checking.report import COVERAGE
from graphkin.construction import pencil
from graphkin.construction.cam_sheet import cam_sheet, division, divisions
from graphkin.construction.touching import station
from graphkin.scene import mechanism_of
from graphkin.scene.scene_tables import Tools

SCENES = ("cam-offset-roller", "cam-swinging-roller", "cam-flat-face")


def drawn(name):
    (made,) = cam(name).made
    return made.cam, made.sheet, made.mechanism.question.sheet.tools


def leaning_apart(one, other):
    """How far two normals lean apart (rad): a line has no sense."""
    return abs(math.remainder(one.leaning - other.leaning, math.pi))


@pytest.mark.parametrize("name", SCENES)
def test_exact_hands_draw_each_division_as_the_law_has_it(name):
    cam, sheet, _ = drawn(name)
    for d in divisions(sheet):
        exact = station(cam, d.degree).scaled(1 / sheet.scales.length)
        assert exact.lift == pytest.approx(d.lift, abs=1e-13)
        assert exact.pressure == pytest.approx(d.pressure, abs=1e-13)
        for place in ("line", "base", "point", "contact", "normal", "way"):
            assert 0 == pytest.approx(abs(getattr(exact, place) - getattr(d, place)), abs=1e-12)


@pytest.mark.parametrize("name", SCENES)
def test_a_pencil_keeps_what_is_predicted(name):
    cam, sheet, tools = drawn(name)
    beyond = count = 0
    for right, off in zip(divisions(sheet), predict_cam(cam, sheet, "pencil", tools), strict=True):
        for seed in range(20):
            read = division(cam, right.degree, 1 / sheet.scales.length, pencil(tools, seed))
            beyond += abs(read.lift - right.lift) > COVERAGE * off["lift"]
            beyond += leaning_apart(read, right) > COVERAGE * off["pressure"] + 1e-12
            count += 2
    assert beyond <= 0.01 * count


@pytest.mark.parametrize("offset", [30.0, 40.0, 55.0])
def test_a_flat_face_stands_on_the_base_circle_however_far_its_line_runs_from_the_axis(offset):
    (cam,) = mechanism_of(read("cam-flat-face").replace("frame.guides.g.through", [offset, 0])).cams
    sheet = cam_sheet(cam, 1e-3)
    assert compare_cam(cam, sheet).ok
    assert all(math.isfinite(off["lift"]) for off in predict_cam(cam, sheet, "pencil", Tools()))


def test_a_line_that_only_touches_the_base_circle_is_drawn_to_where_it_touches():
    scene = read("cam-offset-roller")
    (cam,) = mechanism_of(scene).cams
    touching = replace(cam, base=abs(cam.motion.offset))
    sheet = cam_sheet(touching, 1e-3)
    assert compare_cam(touching, sheet).ok
    assert touching.base * 1e3 == pytest.approx(abs(divisions(sheet)[0].base), abs=1e-12)


def test_a_drafting_program_reads_a_hundredth():
    cam, sheet, tools = drawn("cam-offset-roller")
    for off in predict_cam(cam, sheet, "cad", tools):
        assert 0.01 / math.sqrt(12) == pytest.approx(math.degrees(off["pressure"]))


def test_the_key_accepts_what_the_drawing_can_do(tmp_path):
    handout("cam-swinging-roller", language="en", formats=("html",)).write(tmp_path)
    key = re.sub("<[^>]*>", " ", (tmp_path / "cam-key.html").read_text())
    bounds = [(float(a), float(b)) for a, b in re.findall(r"([\d.]+) … ([\d.]+)\s+°", key)]
    cam, sheet, tools = drawn("cam-swinging-roller")
    off = predict_cam(cam, sheet, "pencil", tools)[2]["pressure"]
    low, high = bounds[2]
    assert 2 * math.degrees(COVERAGE * off) == pytest.approx(high - low, abs=0.1)
    assert len({round(b - a, 1) for a, b in bounds}) > 3


def test_a_follower_that_swings_faster_than_its_cam_has_its_normal_out_of_the_cam():
    rise, fall = {"to": 20, "rise": 30, "by": "harmonic"}, {"to": 80, "fall": 30, "by": "harmonic"}
    scene = read("cam-swinging-roller").replace("cams.1.law", [rise, {"to": 60}, fall, {"to": 360}])
    (cam,) = mechanism_of(scene).cams
    assert max(abs(cam.law.at(math.radians(d)).slope) for d in range(20)) > 1.0
    assert compare_cam(cam, cam_sheet(cam, 1e-3)).ok


def test_the_normals_of_a_swinging_follower_pass_a_point_that_parts_the_line_of_pivots_as_its_step_tells():
    cam, sheet, _ = drawn("cam-swinging-roller")
    assert "distances from A and C are as dψ/dφ to 1" in str(sheet.steps[-1].phrase)
    for d in divisions(sheet):
        slope = cam.law.at(d.degree).slope
        assert abs(slope) == pytest.approx(abs(d.centre) / abs(d.centre - d.line), abs=1e-12)
        # on the line of pivots, and the normal leads there
        assert 0 == pytest.approx((d.centre / d.line).imag, abs=1e-12)
        assert 0 == pytest.approx(((d.point - d.centre) / d.normal).imag, abs=1e-9)
        opposite = cam.motion.side * cam.sense * slope < 0
        assert not slope or opposite == (0 < (d.centre / d.line).real < 1)


def test_the_normals_of_a_sliding_follower_pass_a_point_ds_dphi_from_the_axis():
    cam, sheet, _ = drawn("cam-offset-roller")
    assert "ds/dφ away from A" in str(sheet.steps[-1].phrase)
    for d in divisions(sheet):
        slope = cam.law.at(d.degree).slope
        assert abs(slope) == pytest.approx(abs(d.centre) * sheet.scales.length, abs=1e-12)


def test_the_swing_of_a_follower_that_a_lift_turns_clockwise_begins_at_the_greatest_lift() -> None:
    low, high = check("cam-swinging-roller", find=["swing_2"]).sheet.limits["2"]
    assert (math.radians(-24), 0.0) == pytest.approx((low.angle, high.angle))
