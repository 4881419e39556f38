"""Tasks with a construction of their own: their steps are scaled and told as all others."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import get_args

import pytest

from graphkin.construction import EXACT, Scales, pencil
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import Bar, CompassArc, Curve, Ray, Stroke, TaskReason
from graphkin.construction.cam_sheet import cam_sheet, divisions
from graphkin.construction.synthesis import construct
from graphkin.construction.tasks import measured
from graphkin.construction.touching import CamStation
from graphkin.scene import mechanism_of
from graphkin.scene.designs import design_of, designs
from graphkin.scene.scene_tables import Tools
from graphkin.words import area, say
from tests.solver.test_cams import LIBRARY

pytestmark = pytest.mark.quick
PLACES = [{"B": [10, 60], "angle": 10}, {"B": [35, 80], "angle": -8}, {"B": [70, 82], "angle": -35}]
TASKS = {name: design_of(name).task for name in designs()}
TASKS |= {
    "pivots": design_of({"design": {"kind": "three-positions", "BC": 80, "positions": PLACES, "A": [11, -35],
                                    "D": [57, 28]}}).task,
    "even": design_of({"design": {"kind": "crank-rocker", "swing": 60, "rocker": 75, "K": 1, "frame": 100}}).task,
}


CAMS = {name: mechanism_of(name).cams[0] for name in LIBRARY}
CAMS["knife edge"] = replace(CAMS["cam-offset-roller"], roller=0.0)
CAMS["radial"] = replace(CAMS["knife edge"], motion=replace(
    CAMS["knife edge"].motion, foot=CAMS["knife edge"].axis, offset=0.0))


def numbers(value: object) -> Iterator[complex]:
    """All numbers of a value, in order."""
    if isinstance(value, float | complex):
        yield value
    elif isinstance(value, tuple):
        for part in value:
            yield from numbers(part)
    elif is_dataclass(value):
        for field in fields(value):
            yield from numbers(getattr(value, field.name))


def size(task: object) -> float:
    return max(measured(construct(task)).values()) / 100.0  # type: ignore[arg-type]


@pytest.mark.parametrize("name", TASKS)
def test_a_synthesis_at_another_scale_is_the_one_drawn_there(name: str) -> None:
    task, scale = TASKS[name], size(TASKS[name])
    there = construct(task, scale / 2.5)
    scaled = construct(task, scale).at(Scales(scale / 2.5, 1.0, 1.0))
    assert [*numbers(there.steps)] == pytest.approx([*numbers(scaled.steps)], rel=1e-9, abs=1e-9)
    assert there.points == pytest.approx(scaled.points, rel=1e-9, abs=1e-9)
    assert measured(there) == pytest.approx(measured(scaled), rel=1e-9)
    assert [str(step.phrase) for step in there.steps] == [str(step.phrase) for step in scaled.steps]


def test_a_synthesis_by_hands_that_err_is_drawn_anew_at_another_scale() -> None:
    sheet = construct(TASKS["even"], 1.0, pencil(Tools(), 1))
    with pytest.raises(ValueError, match="drawn anew"):
        sheet.at(Scales(2.0, 1.0, 1.0))


@pytest.mark.parametrize("name", CAMS)
def test_a_cam_at_another_scale_is_the_one_drawn_there(name: str) -> None:
    there, sheet = cam_sheet(CAMS[name], 4e-4), cam_sheet(CAMS[name], 1e-3)
    scaled = sheet.at(Scales(4e-4, 1.0, 1.0))
    assert [*numbers(there.steps)] == pytest.approx([*numbers(scaled.steps)], rel=1e-9, abs=1e-9)
    assert [str(step.phrase) for step in there.steps] == [str(step.phrase) for step in scaled.steps]
    kept = [(d.degree, d.lift, d.pressure) for d in divisions(sheet)]
    assert kept == [(d.degree, d.lift, d.pressure) for d in divisions(scaled)]


def strokes(name: str, reason: str) -> tuple[tuple[CamStation, ...], tuple[Stroke, ...]]:
    """The divisions of a cam, and the strokes of a step."""
    sheet = cam_sheet(CAMS[name], 1e-3)
    return divisions(sheet), next(step.strokes for step in sheet.steps if step.reason == reason)


def test_the_normals_of_a_cam_are_drawn_from_its_contacts_to_the_centres_of_the_roller() -> None:
    drawn_at, lines = strokes("cam-offset-roller", "cam step normals")
    assert [Ray(d.contact, d.normal, d.point) for d in drawn_at] == [*lines]


def test_a_flat_face_is_drawn_from_its_foot_to_its_contact() -> None:
    drawn_at, (*faces, _) = strokes("cam-flat-face", "cam step faces")
    assert [Bar(d.point, d.contact) for d in drawn_at] == faces


def test_the_arcs_of_a_swinging_follower_pass_the_base_circle_and_the_pitch_curve() -> None:
    drawn_at, arcs = strokes("cam-swinging-roller", "cam step swings")
    for d, arc in zip(drawn_at, arcs, strict=True):
        assert isinstance(arc, CompassArc)
        assert [arc.radius] * 2 == pytest.approx([abs(z - d.line) for z in (d.base, arc.at)])


def test_rollers_touch_the_profile_that_is_drawn_last() -> None:
    drawn_at, (*rollers, pitch, profile) = strokes("cam-offset-roller", "cam step rollers")
    assert isinstance(profile, Curve)
    assert isinstance(pitch, Curve)
    for d, roller in zip(drawn_at, rollers, strict=True):
        assert isinstance(roller, CompassArc)
        assert roller.radius == pytest.approx(min(abs(z - roller.centre) for z in profile.curve), abs=0.1)
        assert 0 == pytest.approx(min(abs(z - d.point) for z in pitch.curve), abs=1.5)


def drawn() -> Iterator[Sheet]:
    """Every kind of task."""
    for task in TASKS.values():
        yield construct(task, size(task), EXACT)
    for cam in CAMS.values():
        yield cam_sheet(cam, 1e-3)


def test_every_reason_of_a_task_is_drawn_with_one_verb_and_told_in_words_of_its_table() -> None:
    verbs: dict[str, set[str]] = {}
    for step in (step for sheet in drawn() for step in sheet.steps):
        verbs.setdefault(step.reason, set()).add(step.verb)
        assert {step.sentence} <= {*area("synthesis"), *area("cams")}
        assert all(say(step.phrase, language) for language in ("en", "zh"))
    assert {*get_args(TaskReason)} == verbs.keys()
    assert [] == [reason for reason, of in verbs.items() if len(of) > 1]


@pytest.mark.parametrize("name", TASKS)
def test_steps_of_a_task_are_numbered_in_their_order(name: str) -> None:
    steps = construct(TASKS[name], size(TASKS[name])).steps
    assert [*range(1, len(steps) + 1)] == [step.number for step in steps]
