"""Against 50 digits: the solver reproduces position, velocity and acceleration to rounding, and its bound holds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import mpmath as mp
import numpy as np
import pytest

from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.solver import Motion, solve
from tests import scenes
from tests.solver.checks import to_json

D = 50


@dataclass(frozen=True)
class Loop:
    """A mechanism of one loop: unknowns by the driver's angle, and the asked point, in mm."""

    text: str
    alpha: float
    omega: float
    closed: Callable[..., list[mp.mpf]]
    point: Callable[..., mp.mpc]
    name: tuple[str, str]
    guess: Callable[[Motion], list[float]]


def _rad(x: str) -> mp.mpf:
    return mp.mpf(x) * mp.pi / 180


def _ray(x: mp.mpf) -> mp.mpc:
    return mp.mpc(mp.cos(x), mp.sin(x))


def _turn(x: str) -> mp.mpc:
    return _ray(_rad(x))


def _four_bar(q: mp.mpf, a: mp.mpf, b: mp.mpf) -> list[mp.mpf]:
    gap = 150 * _ray(q) + 500 * _ray(a) - 400 - 300 * _ray(b)
    return [gap.real, gap.imag]


def _offset_slider(q: mp.mpf, a: mp.mpf, s: mp.mpf) -> list[mp.mpf]:
    pin = mp.mpc(10, 25) + _turn("12") * s + _turn("47") * mp.mpc(8, -14)
    gap = 40 * _ray(q) + 130 * _ray(a) - pin
    return [gap.real, gap.imag]


def _offset_swing(q: mp.mpf, b: mp.mpf, s: mp.mpf) -> list[mp.mpf]:
    gap = 40 * _ray(q) - mp.mpc(90, -20) - _ray(b) * (mp.mpc(5, 12) + _turn("140") * s)
    return [gap.real, gap.imag]


LOOPS = {
    "RRR": Loop(
        scenes.FOUR_BAR, -30, 10, _four_bar,
        lambda q, a, b: 150 * _ray(q) + _ray(a) * mp.mpc(200, 100), ("E", "2"),
        lambda m: [m.angle("2")[0], m.angle("3")[0] + np.pi],
    ),
    "RRP": Loop(
        scenes.OFFSET_SLIDER, 9, 4, _offset_slider,
        lambda q, a, s: 40 * _ray(q) + 130 * _ray(a), ("C", "2"),
        lambda m: [m.angle("2")[0], 1000 * m.slide("3/0")[0][0]],
    ),
    "RPR": Loop(
        scenes.OFFSET_SWING, 9, 4, _offset_swing,
        lambda q, b, s: mp.mpc(90, -20) + 50 * _ray(b), ("D", "3"),
        lambda m: [m.angle("3")[0], 1000 * m.slide("2/3")[0][0]],
    ),
}


@pytest.mark.parametrize("degrees", ["60", "75", "200", "-33.3"])
@pytest.mark.parametrize("kind", LOOPS)
def test_a_point_is_right_within_the_bound_and_a_few_roundings(kind: str, degrees: str) -> None:
    loop = LOOPS[kind]
    motion = solve(mechanism_of_text(loop.text, kind), at={"1": np.radians(float(degrees))})
    with mp.workdps(D):

        def at(t: mp.mpf) -> mp.mpc:
            q = _rad(degrees) + loop.omega * t + mp.mpf(loop.alpha) * t * t / 2
            x = mp.findroot(lambda *u: loop.closed(q, *u), [mp.mpf(float(g)) for g in loop.guess(motion)], tol=1e-70)
            return loop.point(q, *x)

        expected = [complex(mp.diff(at, 0, n)) for n in range(3)]
    found = motion.point(*loop.name)
    bound = to_json(motion)["positions"][0]["error_bound"]
    missed = [abs(1000 * x[0] - e) for x, e in zip((found.z, found.v, found.a), expected, strict=True)]
    assert missed[0] < 1e-14 * 500
    assert missed[1] < min(bound["velocity"], 1e-13 * max(map(abs, expected)))
    assert missed[2] < min(bound["acceleration"], 1e-13 * max(map(abs, expected)))


def test_the_bound_of_the_worked_example_is_near_rounding() -> None:
    bound = to_json(solve(mechanism_of("sixbar-guide-40deg")))["positions"][0]["error_bound"]
    assert 1e-13 < bound["velocity"] < 1e-10
    assert 1e-12 < bound["acceleration"] < 1e-9


def test_the_error_does_not_grow_with_the_number_of_positions() -> None:
    scene = mechanism_of("shaper-scheme-2")
    motion = solve(scene, sweep=20000)
    last = solve(scene, at={"1" if scene.drivers[0].key == "1" else scene.drivers[0].key: float(motion.values[-1, 0])})
    link = scene.links[-1].name
    assert motion.poses[link].a[-1] == pytest.approx(last.poses[link].a[0], rel=1e-14)
