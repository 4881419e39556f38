"""Cams of a scene file: what they say, and every mistake by its name."""

from __future__ import annotations

import math
import tomllib

import pytest

from graphkin.errors import SceneError
from graphkin.scene import library_text, mechanism_of
from graphkin.scene.laws import LAWS, FollowerLaw, LiftPiece

pytestmark = pytest.mark.quick


def scene(name: str, cam: dict | None = None, law: list | None = None, **tables) -> dict:
    made = tomllib.loads(library_text(name))
    made["cams"]["1"] |= cam or {}
    if law is not None:
        made["cams"]["1"]["law"] = law
    return made | tables


def wrong(source: dict) -> list[str]:
    with pytest.raises(SceneError) as stop:
        mechanism_of(source)
    return [problem.where for problem in stop.value.problems]


RISE = {"to": 120, "rise": 24, "by": "345"}
FALL = {"to": 360, "fall": 24, "by": "345"}


@pytest.mark.parametrize(
    ("law", "where"),
    [
        ([RISE, {"to": 360}], "cams.1.law"),
        ([RISE, {**FALL, "to": 350}], "cams.1.law.2"),
        ([{"to": 120, "rise": 24}, FALL], "cams.1.law.1"),
        ([RISE, {"to": 100}, FALL], "cams.1.law.2"),
        ([{**RISE, "rise": -24}, FALL], "cams.1.law.1"),
        ([{**RISE, "fall": 24}, FALL], "cams.1.law.1"),
        ([RISE, {"to": 130, "by": "345"}, FALL], "cams.1.law.2"),
        ([], "cams.1.law"),
        ([RISE, {**FALL, "by": "sine"}], "cams.1.law.2.by"),
    ],
)
def test_a_law_that_cannot_be_is_told_by_its_piece(law, where):
    assert where in wrong(scene("cam-offset-roller", law=law))


@pytest.mark.parametrize(
    ("name", "cam", "where"),
    [
        ("cam-offset-roller", {"offset": -8}, "cams.1.offset"),
        ("cam-offset-roller", {"follower": "7"}, "cams.1.follower"),
        ("cam-offset-roller", {"follower": "1"}, "cams.1.follower"),
        ("cam-offset-roller", {"flat": True}, "cams.1.flat"),
        ("cam-offset-roller", {"sense": 2}, "cams.1.sense"),
        ("cam-offset-roller", {"allow": {"rise": 95}}, "cams.1.allow.rise"),
        ("cam-offset-roller", {"base": {"r": 5, "of": "pitch"}}, "cams.1.base.r"),
        ("cam-swinging-roller", {"offset": 3}, "cams.1.offset"),
        ("cam-swinging-roller", {"flat": True}, "cams.1.flat"),
    ],
)
def test_what_is_wrong_with_a_cam_is_told_by_its_key(name, cam, where):
    assert where in wrong(scene(name, cam))


def test_everything_wrong_with_a_cam_is_told_at_once():
    found = wrong(scene("cam-offset-roller", {"offset": 9, "sense": 2}, [RISE, {"to": 360}]))
    assert {"cams.1.sense", "cams.1.law"} == set(found) - {"cams.1.offset"}


def test_the_roller_is_added_to_a_base_circle_of_the_profile():
    assert 41e-3 == pytest.approx(mechanism_of("cam-offset-roller").cams[0].base, rel=1e-15)


def test_the_sketch_tells_the_side_of_a_swinging_follower():
    assert -1 == mechanism_of("cam-swinging-roller").cams[0].motion.side
    assert 1 == mechanism_of(scene("cam-swinging-roller", sketch={"B": [30, -40]})).cams[0].motion.side


@pytest.mark.parametrize("by", LAWS)
def test_each_law_rises_by_its_lift_with_the_derivatives_that_it_tells(by):
    law = FollowerLaw((LiftPiece(0.0, 2.0, 0.0, 3.0, by), LiftPiece(2.0, math.tau, 3.0, 0.0, by)))
    assert (0.0, pytest.approx(3.0)) == (law.at(0.0).lift, law.at(2.0).lift)
    h = 1e-4
    for angle in (0.3, 0.8, 1.3, 1.7, 3.0, 5.5):
        before, here, after = (law.at(angle + k * h) for k in (-1, 0, 1))
        for order in range(3):
            assert here[order + 1] == pytest.approx((after[order] - before[order]) / (2 * h), abs=2e-6)


def test_a_seam_belongs_to_the_later_piece():
    law = FollowerLaw((LiftPiece(0.0, 2.0, 0.0, 3.0, "uniform"), LiftPiece(2.0, math.tau, 3.0, 0.0, "uniform")))
    assert -3.0 / (math.tau - 2.0) == law.at(2.0 - 1e-14).slope
    assert 1.5 == law.at(-1e-14).slope


def test_a_guide_through_the_axis_has_no_offset_but_rounding():
    along, axis = math.radians(33), [16, -1.2]
    through = [axis[0] - 13.6 * math.cos(along), axis[1] - 13.6 * math.sin(along)]
    made = {
        "frame": {"points": {"A": axis}, "guides": {"v": {"through": through, "angle": 33}}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["B"], "on": "0.v"}},
        "cams": {"1": {"follower": "2", "base": {"r": 40}, "law": [
            {"to": 180, "rise": 20, "by": "345"}, {"to": 360, "fall": 20, "by": "cycloidal"}]}},
        "driver": {"link": "1", "angle": 20, "omega": 5},
    }
    assert 0.0 == mechanism_of(made).cams[0].motion.offset
