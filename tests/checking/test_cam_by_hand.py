"""Cams drawn division by division by hands that err."""

from __future__ import annotations

import math
import re

import pytest

from graphkin import cam, handout
from graphkin.checking.closed_form import predict_cam
from graphkin.checking.uncertainty import COVERAGE
from graphkin.construction import EXACT, pencil
from graphkin.construction.cam_sheet import division_by_hand

SCENES = ("cam-offset-roller", "cam-swinging-roller", "cam-flat-face")


def drawn(name):
    (made,) = cam(name).made
    return made.sheet, made.mechanism.question.sheet.tools


@pytest.mark.parametrize("name", SCENES)
def test_exact_hands_read_what_the_sheet_has(name):
    sheet, _ = drawn(name)
    for d in sheet.divisions:
        lift, pressure = division_by_hand(sheet.cam, d.degree, 1 / sheet.scale, EXACT)
        assert d.lift == pytest.approx(lift, abs=1e-13)
        assert d.pressure == pytest.approx(abs(pressure), abs=1e-13)


@pytest.mark.parametrize("name", SCENES)
def test_a_pencil_keeps_what_is_predicted(name):
    sheet, tools = drawn(name)
    beyond = count = 0
    for d, off in zip(sheet.divisions, predict_cam(sheet, "pencil", tools), strict=True):
        right = division_by_hand(sheet.cam, d.degree, 1 / sheet.scale, EXACT)
        for seed in range(20):
            read = division_by_hand(sheet.cam, d.degree, 1 / sheet.scale, pencil(tools, seed))
            beyond += abs(read[0] - right[0]) > COVERAGE * off["lift"]
            beyond += abs(math.remainder(read[1] - right[1], math.pi)) > COVERAGE * off["pressure"] + 1e-12
            count += 2
    assert beyond <= 0.01 * count


def test_a_drafting_program_reads_a_hundredth():
    sheet, tools = drawn("cam-offset-roller")
    for off in predict_cam(sheet, "cad", tools):
        assert 0.01 / math.sqrt(12) == pytest.approx(math.degrees(off["pressure"]))


def test_the_key_accepts_what_the_drawing_can_do(tmp_path):
    handout("cam-swinging-roller", language="en", formats=("html",)).write(tmp_path)
    key = re.sub("<[^>]*>", " ", (tmp_path / "cam-key.html").read_text())
    bounds = [(float(a), float(b)) for a, b in re.findall(r"([\d.]+) … ([\d.]+)\s+°", key)]
    sheet, tools = drawn("cam-swinging-roller")
    off = predict_cam(sheet, "pencil", tools)[2]["pressure"]
    low, high = bounds[2]
    assert 2 * math.degrees(COVERAGE * off) == pytest.approx(high - low, abs=0.1)
    assert len({round(b - a, 1) for a, b in bounds}) > 3
