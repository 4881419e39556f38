"""Whole mechanisms: every joint closed, rates equal to differences in time, the same motion whatever drives it."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest

from graphkin.errors import CallError
from graphkin.scene import library, mechanism_of, mechanism_of_text
from graphkin.scene.model import Driver, Mechanism
from graphkin.solver import Motion, solve, sweep_in_blocks
from tests import scenes

from .checks import closure, differences, slowed

SOLVABLE = (
    "FOUR_BAR",
    "PARALLELOGRAM",
    "DOUBLE_PARALLELOGRAM",
    "OFFSET_SLIDER",
    "OFFSET_SWING",
    "GUIDE_OVER_CRANK",
    "TWO_SLOTS",
    "OLDHAM",
    "TRAMMEL",
    "CYLINDER",
    "ARM",
    "FIVE_BAR",
    "FLOATING",
    "TRIAD",
    "EQUAL_GUIDE",
)


def scene(name: str) -> Mechanism:
    return mechanism_of_text(getattr(scenes, name), name) if name.isupper() else mechanism_of(name)


@pytest.mark.parametrize("name", SOLVABLE)
def test_every_joint_is_closed(name: str) -> None:
    assert closure(solve(scene(name))) < 1e-14


@pytest.mark.parametrize("name", library())
def test_every_joint_of_the_scenes_that_come_along_is_closed(name: str) -> None:
    assert closure(solve(scene(name))) < 1e-14


@pytest.mark.parametrize("name", SOLVABLE)
def test_velocity_and_acceleration_are_the_rates_of_position(name: str) -> None:
    assert differences(slowed(scene(name), 0.1)) < 3e-6


KINDS = {
    "FOUR_BAR": "RRR",
    "OFFSET_SLIDER": "RRP",
    "GUIDE_OVER_CRANK": "RRP",
    "OFFSET_SWING": "RPR",
    "TWO_SLOTS": "PRP",
    "OLDHAM": "RPP",
    "CYLINDER": "RRR",
}


@pytest.mark.parametrize("name", KINDS)
def test_the_kind_of_the_dyad_is(name: str) -> None:
    assert [KINDS[name]] == [g.kind for g in solve(scene(name)).structure.groups]


# the same mechanism with another link or pair driven in the way it was found to move
REDRIVEN = [
    ("FOUR_BAR", "3", "0"), ("FOUR_BAR", "2", "0"), ("FOUR_BAR", "2", "1"), ("FOUR_BAR", "1", "2"),
    ("FOUR_BAR", "3", "2"), ("FOUR_BAR", "1", "3"), ("FIVE_BAR", "2", "3"), ("CYLINDER", "1", "0"),
    ("CYLINDER", "2", "0"), ("CYLINDER", "3", "1"), ("OFFSET_SLIDER", "2", "0"), ("OFFSET_SLIDER", "3/0", ""),
    ("OFFSET_SLIDER", "1", "3"), ("OFFSET_SWING", "3", "0"), ("OFFSET_SWING", "2/3", ""), ("OFFSET_SWING", "3", "1"),
    ("GUIDE_OVER_CRANK", "1/5", ""), ("GUIDE_OVER_CRANK", "2", "0"), ("TWO_SLOTS", "P/1", ""),
    ("TWO_SLOTS", "2/0", ""), ("OLDHAM", "2/1", ""), ("OLDHAM", "3", "0"), ("TRAMMEL", "P/0", ""),
    ("TRIAD", "3", "0"), ("TRIAD", "5", "0"), ("TRIAD", "4", "3"), ("sixbar-guide-40deg", "4/3", ""),
    ("sixbar-420rpm", "4", "1"),
]


def sides(scene: Mechanism, key: str) -> tuple[str, str]:
    """The links of a sliding pair, or the block of a pin in a slot and what it slides on."""
    sliding, _, on = key.partition("/")
    return (sliding if sliding in scene.by_name else key), on


def redriven(motion: Motion, key: str, base: str) -> Mechanism:
    """The scene with its first driver replaced, and every point sketched where the motion found it."""
    old = motion.scene
    if "/" in key:
        new = Driver(*sides(old, key), *(float(x[0]) for x in motion.slide(key)[:3]), key)
    else:
        rates = [float(f(key)[0] - f(base)[0]) for f in (motion.angle, motion.omega, motion.alpha)]
        new = Driver(key, base, *rates)
    places = {p: complex(motion.position(p)[0]) for p in old.holders if p not in old.frame.points}
    return replace(old, drivers=(new, *old.drivers[1:]), sketch=places, drawn={})


FIELDS = ("z", "v", "a", "u", "omega", "alpha")
"""In the order of the bounds."""


@pytest.mark.parametrize(("name", "key", "base"), REDRIVEN)
def test_the_motion_is_the_same_whatever_drives_it(name: str, key: str, base: str) -> None:
    expected = solve(scene(name))
    found = solve(redriven(expected, key, base or expected.scene.frame.name))
    off = dict.fromkeys(FIELDS, 0.0)
    for link in expected.scene.links:
        one, two = expected.poses[link.name], found.poses[link.name]
        off = {field: max(most, abs(getattr(one, field) - getattr(two, field))[0]) for field, most in off.items()}
    kept = {field: bound[0] for field, bound in zip(FIELDS, map(np.add, expected.bound, found.bound), strict=True)}
    assert [] == [field for field, most in off.items() if most > kept[field]]


def test_an_arm_adds_the_angles_of_its_relative_driver() -> None:
    assert np.degrees(solve(scene("ARM")).angle("2")[0]) == pytest.approx(90.0, abs=1e-12)


def test_two_pins_in_square_slots_hold_a_trammel() -> None:
    # E lies half a bar beyond Q: x = 50 cos, y = 150 sin of the bar's angle
    angle = np.radians(130.0)
    expected = complex(0.05 * np.cos(angle), 0.15 * np.sin(angle))
    assert expected == pytest.approx(solve(scene("TRAMMEL")).position("E")[0], abs=1e-15)


def test_a_cylinder_holds_its_ends_at_its_travel() -> None:
    motion = solve(scene("CYLINDER"))
    assert abs(motion.position("B") - motion.position("C"))[0] == pytest.approx(0.25, rel=1e-14)


def test_a_redundant_link_is_given_its_motion() -> None:
    motion = solve(scene("DOUBLE_PARALLELOGRAM"))
    assert motion.alpha("4")[0] == pytest.approx(motion.alpha("1")[0], rel=1e-13)


def test_a_redundant_link_with_a_single_pin_turns_with_the_guide_on_which_it_slides() -> None:
    motion = solve(mechanism_of({
        "frame": {"points": {"A": [0, 0], "D": [0, -90]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 40},
            "2": {"points": ["B"], "on": "3"},
            "3": {"points": ["D"]},
            "4": {"points": ["B"], "on": "3", "angle_on": 25, "redundant": True},
        },
        "driver": {"link": "1", "angle": 60, "omega": 10, "alpha": 5},
    }))
    expected = motion.angle("2") + np.radians(25.0), motion.omega("2"), motion.alpha("2")
    assert np.array(expected) == pytest.approx(np.array((motion.angle("4"), motion.omega("4"), motion.alpha("4"))))


@pytest.mark.parametrize("name", ["sixbar-AE70", "shaper-scheme-2", "triad-slider"])
def test_positions_in_blocks_are_those_of_one(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = mechanism_of(name)
    whole = solve(scene, sweep=37)
    monkeypatch.setattr(import_module("graphkin.solver.path.driver_range"), "BLOCK", 5)
    parts = solve(scene, sweep=37)
    assert whole.status.tolist() == parts.status.tolist()
    assert whole.why == parts.why
    for link, pose in whole.poses.items():
        for field in FIELDS:
            assert np.array_equal(getattr(pose, field), getattr(parts.poses[link], field), equal_nan=True)
    for part in whole.scene.links:
        assert np.array_equal(whole.angle(part.name), parts.angle(part.name), equal_nan=True)


def test_many_positions_keep_once_what_is_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(import_module("graphkin.solver.path.driver_range"), "BLOCK", 5)
    motion = solve(mechanism_of("shaper-scheme-2"), sweep=37)
    poses = motion.poses
    assert np.shares_memory(poses["3"].omega, poses["4"].omega)  # the block on its guide
    assert poses["2"].omega.strides == (0,) == poses["6"].u.strides  # the crank's rate, the ram's direction
    assert not np.shares_memory(poses["4"].u, poses["5"].u)
    assert motion.status.strides == (0,)


@pytest.mark.parametrize("name", ["OLDHAM", "DOUBLE_PARALLELOGRAM", "CYLINDER", "TWO_SLOTS"])
def test_links_turn_on_from_block_to_block(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = solve(scene(name), sweep=37)
    monkeypatch.setattr(import_module("graphkin.solver.path.driver_range"), "BLOCK", 5)
    blocks = list(sweep_in_blocks(scene(name), None, 37))
    for link in whole.scene.links:
        parts = np.concatenate([block.angle(link.name) for block in blocks])
        assert np.array_equal(whole.angle(link.name), parts, equal_nan=True)


def test_a_sweep_that_is_refused_has_its_reason_in_blocks_too() -> None:
    cylinder = scene("CYLINDER")
    far = {cylinder.drivers[0].key: 1e3}
    (refused,) = sweep_in_blocks(cylinder, far, 3)
    assert solve(cylinder, far, 3).why == refused.why
    assert refused.why[0].endswith("the motion reaches from 100 mm to 500 mm")


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"sweep": 0}, {"en": "sweep: 0 positions; give 1 or more", "zh": "sweep：0 个位置；请给 1 或更大"}),
        ({"sweep": -3}, {"en": "sweep: -3 positions; give 1 or more"}),
        ({"at": {"1": "x"}}, {"en": 'at "1": x is no driver value'}),
        ({"at": {"1": float("nan")}}, {"en": 'at "1": nan is no driver value'}),
    ],
)
def test_numbers_that_are_none_are_refused_in_a_sentence(given, said):
    with pytest.raises(CallError) as stop:
        solve(scene("FOUR_BAR"), **given)
    assert said == {language: stop.value.text(language) for language in said}
