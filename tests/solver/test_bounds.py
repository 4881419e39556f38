"""The stated error bounds against 50 digits on random mechanisms (a hundred thousand: tests/bench/accuracy.py)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any
from unittest.mock import patch

import mpmath
import numpy as np
import pytest

from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.model import Dimension, Mechanism, dimensions, with_dimensions
from graphkin.scene.pairs import LawCam
from graphkin.solver import DriverRange, Motion, cams, driver_range, solve
from graphkin.solver.algebra import bounds
from graphkin.solver.algebra.constraints import Constraints
from graphkin.solver.algebra.pose import FIELDS, REAL, Array, Pose
from graphkin.solver.cams import follower_inputs
from graphkin.solver.compiled import engine
from tests import EVERYTHING, rolling_linkages, scenes
from tests.bench.accuracy import measure
from tests.bench.larger import measure_larger
from tests.bench.tally import KINDS, Tally

MANY = 20 if EVERYTHING else 1
RUNS: dict[str, Callable[[], Tally]] = {
    "16 digits throughout": lambda: measure(MANY * 180, 7, False, each=3),
    "as given out": lambda: measure(MANY * 180, 7, True, each=3),
    "larger groups": lambda: measure_larger(MANY * 48, 3, each=12),
}


@cache
def measured(run: str) -> Tally:
    return RUNS[run]()


@pytest.fixture(params=list(RUNS))
def tally(request: pytest.FixtureRequest) -> Tally:
    return measured(request.param)


def test_the_true_error_never_exceeds_the_bound(tally: Tally) -> None:
    assert tally.broken == []


@pytest.mark.parametrize("kind", KINDS)
def test_nine_bounds_in_ten_are_within_1000_times_the_true_error(tally: Tally, kind: str) -> None:
    assert tally.within(kind) > 0.88  # of a few hundred; of a hundred thousand it is more than 0.9


def test_next_to_no_position_of_dyads_is_refused() -> None:
    tally = measured("as given out")
    assert tally.refused < 0.02 * len(tally.ratios)


STEP = 1e-7
SCENES: dict[str, Any] = {
    **{name: getattr(scenes, name) for name in (
        "FOUR_BAR", "OFFSET_SLIDER", "OFFSET_SWING", "GUIDE_OVER_CRANK", "OLDHAM", "TRAMMEL", "CYLINDER", "FIVE_BAR",
        "FLOATING", "TRIAD",
    )},
    "wheel at its rim": rolling_linkages.wheel_at_its_rim(), "five-bar": rolling_linkages.five_bar_by_its_middle(),
    **{name: name for name in ("cam-offset-roller", "cam-swinging-roller", "geared-five-bar", "double-butterfly")},
}
FIXED = ("wheel at its rim", "five-bar", "cam-offset-roller", "cam-swinging-roller", "geared-five-bar")
"""Where places cannot change alone: what rolls would come apart, a cam has another profile."""


def mechanism(name: str) -> Mechanism:
    source = SCENES[name]
    return mechanism_of_text(source, name) if isinstance(source, str) and "\n" in source else mechanism_of(source)


def told(
    motion: Motion, number: complex | None, value: float = 0.0, given: float = 0.0, slack: float = 0.0
) -> dict[str, Any]:
    """The bounds of each link if nothing but one number is off: one of the file, or the driver's value by so much, or
    its rates by so much of themselves, or the lifts of cams by so much of their slack."""
    known = motion.accuracy
    structure = replace(known.structure)  # nothing is kept of what was written
    errors = np.zeros(known.drive.value.shape)
    errors[:, : len(structure.scene.drivers)] = np.eye(len(structure.scene.drivers))[0] * value
    for k, follower in enumerate(structure.followers, start=len(structure.scene.drivers)):
        errors[:, k] = abs(follower.ratios[0]) * value

    def converted(z: complex, direction: bool) -> tuple[float, float]:
        off = STEP if z == number else 0.0
        return off, off

    with patch.object(bounds, "GIVEN", given), patch.object(bounds, "conversion_error", converted):
        return bounds.error_bounds(structure, known.poses, known.drive, slack * known.slack, known.refined, errors)


def missed(one: Motion, two: Motion, name: str, further: Sequence[complex] = ()) -> list[float]:
    """The most by which points of a link, further ones too, and its turning, differ in two motions."""
    p, q = (m.poses[name] for m in (one, two))
    places = [0j, *one.structure.links[name].points.values(), *further]
    pairs = [(p.fixed(z), q.fixed(z)) for z in places]
    points = [max(abs(complex((getattr(a, f) - getattr(b, f))[0])) for a, b in pairs) for f in "zva"]
    return [*points, abs(complex((p.u - q.u)[0])), abs(p.omega - q.omega)[0], abs(p.alpha - q.alpha)[0]]


def changes(name: str) -> Iterator[tuple[Dimension, Motion, dict[str, Any]]]:
    """Each number of a mechanism, the motion with it changed a little, and the bounds that are told for that."""
    scene = mechanism(name)
    own = solve(scene)
    driver = scene.drivers[0]
    for dimension, z in dimensions(scene).items():
        kind = dimension[0]
        if kind == "value" and dimension[1] == 0:
            yield dimension, solve(scene, at={driver.key: driver.value + STEP}), told(own, None, value=STEP)
        elif kind in ("rate", "second") and dimension[1] == 0 and z:
            yield dimension, solve(with_dimensions(scene, {dimension: z + STEP})), told(own, None, given=STEP / abs(z))
        elif kind in ("point", "through", "direction", "turn") and name not in FIXED:
            turned = kind in ("direction", "turn")
            new = z * np.exp(1j * STEP) if turned else z + STEP * (0.6 + 0.8j)
            yield dimension, solve(with_dimensions(scene, {dimension: complex(new)})), told(own, z)


@pytest.mark.parametrize("name", SCENES)
def test_each_number_that_is_off_moves_the_links_within_the_bound_of_it(name: str) -> None:
    own = solve(mechanism(name))
    seen = 0
    for dimension, moved, found in changes(name):
        size = own.scene.size
        for link, most in found.items():
            change = missed(own, moved, link)
            # beside it rounding, and terms of second order
            for off, bound, whole in zip(change, most, (size, 1e3 * size, 1e6 * size, 1.0, 1e3, 1e6), strict=True):
                assert off <= 1.001 * float(bound[0]) + 1e-12 * whole, (dimension, link)
                seen += off > 1e-10
    assert seen


ROLLING = {name: getattr(rolling_linkages, name)() for name in (
    "planet_by_a_rod", "wheel_on_a_rocker", "rack_on_a_rocker",
)}


@cache
def reach_of(name: str) -> DriverRange:
    return driver_range(mechanism_of(ROLLING[name]) if name in ROLLING else mechanism(name))


def in_more_digits(all_: Pose) -> Pose:
    """All links in the digits of a long double, with directions of unit length."""
    kinds = {field: np.longdouble if field in REAL else np.clongdouble for field in FIELDS}
    wide = {field: getattr(all_, field).astype(kind) for field, kind in kinds.items()}
    return Pose(**{**wide, "u": wide["u"] / np.abs(wide["u"])})


@pytest.mark.skipif(bool(np.finfo(np.longdouble).eps > 1e-18), reason="a long double has no more digits here")
@pytest.mark.parametrize("longer", [0.0, 1e-12])
@pytest.mark.parametrize("name", [*(name for name in SCENES if name not in FIXED), *ROLLING])
def test_rounding_moves_no_constraint_and_no_rate_of_it_farther_than_is_told(name: str, longer: float) -> None:
    reach = reach_of(name)
    known = reach.motion(np.linspace(*reach.ends, 62)[1:-1], extended=False).accuracy
    known = known.rows(np.flatnonzero(known.ok))
    system = Constraints.whole(replace(known.structure), known.drive.followed(known.structure))
    all_, exact = system.of(known.poses), np.zeros_like(system.drive.value)
    all_.u[:, : system.layout.members] *= 1.0 + longer  # directions that are not quite of unit length
    with patch.object(bounds, "conversion_error", lambda *_: (0.0, 0.0)):  # every number of the file is right
        told = bounds._row_errors(system, all_, system.parts(all_, 2), np.zeros(len(known.ok), bool), [exact] * 3)
    moved = np.abs(system.constraints(in_more_digits(all_)) - system.constraints(all_))
    assert (moved <= told).all()


@pytest.mark.parametrize("name", [*(name for name in SCENES if name not in FIXED), *ROLLING])
def test_links_that_do_not_close_are_no_farther_off_than_is_told(name: str) -> None:
    reach = reach_of(name)
    motion = reach.motion(reach.ends[0] + 0.2 * np.diff(reach.ends))
    known, size = motion.accuracy, motion.scene.size
    place = 0.0 if name in ROLLING else STEP  # of what rolls no turns are counted: it may stand anywhere
    rng = np.random.default_rng(3)
    off = dict(motion.poses)
    for link in off.keys() - {motion.scene.frame.name}:
        true, by = off[link], STEP * rng.choice([-1.0, 1.0], 6) * rng.uniform(0.1, 1.0, 6)
        aside = size * np.exp(1j * rng.uniform(0.0, 6.3, 3))
        off[link] = Pose(
            true.z + place / STEP * by[0] * aside[0], true.u * np.exp(1j * place / STEP * by[3]),
            true.v + by[1] * aside[1], true.omega + by[4], true.a + by[2] * aside[2], true.alpha + by[5],
        )
    exact = 0 * known.drive.value, 0 * known.slack, np.zeros(1, bool)
    told = bounds.error_bounds(replace(known.structure), off, known.drive, exact[1], exact[2], exact[0])
    for link, most in told.items():
        under = [motion.poses[link].inverse().of(motion.poses[p.a]).z for p in known.structure.slides if p.b == link]
        changes = missed(motion, replace(motion, poses=off), link, [complex(z[0]) for z in under])
        assert all(off <= 1.001 * float(bound[0]) for off, bound in zip(changes, most, strict=True)), link


@pytest.mark.parametrize(("name", "at"), [
    ("cam-offset-roller", 20.0), ("cam-offset-roller", 70.0), ("cam-offset-roller", 200.0),
    ("cam-swinging-roller", 290.0), ("cam-swinging-roller", 160.0),
])
def test_what_a_law_is_off_moves_the_follower_within_the_bound_of_it(name: str, at: float) -> None:
    scene = mechanism(name)
    scene = replace(scene, drivers=(replace(scene.drivers[0], rate=7.0, second=90.0),))
    with patch.object(engine, "LOOKED_UP", STEP):
        own = solve(scene, at={scene.drivers[0].key: math.radians(at)})

    def off(cam: LawCam, turn: Array) -> Mapping[str, Array]:
        given = follower_inputs(cam, turn)
        rates = {"slope": given["slope"] * (1 + STEP), "second": given["second"] * (1 - STEP)}
        if "travel" in given:
            return {**given, **rates, "travel": given["travel"] * (1 + STEP)}
        turned = (given["cos"] + 1j * given["sin"]) * np.exp(1j * STEP)
        return {**given, **rates, "cos": turned.real, "sin": turned.imag}

    with patch.object(cams, "follower_inputs", off):
        moved = solve(scene, at={scene.drivers[0].key: math.radians(at)})
    with patch.object(bounds, "LOOKED_UP", STEP):
        found = told(own, None, slack=1.0)
    for link, most in found.items():
        for change, bound in zip(missed(own, moved, link), most, strict=True):
            assert change <= 1.001 * float(bound[0]) + 1e-12, link


def wild(system: Constraints, all_: Pose, seed: int) -> tuple[Constraints, Pose]:
    """The links anywhere, turning at any rate, their directions not quite of unit length; with the turns that rolling
    counts."""
    rng, n, count = np.random.default_rng(seed), len(system.drive), system.layout.members
    fields = {field: np.array(getattr(all_, field)) for field in FIELDS}
    for field in ("z", "v", "a"):
        fields[field][:, :count] = system.layout.size * (rng.normal(size=(n, count)) + 1j * rng.normal(size=(n, count)))
    for field in ("omega", "alpha"):
        fields[field][:, :count] = 3.0 * rng.normal(size=(n, count))
    angle = np.zeros(fields["u"].shape)
    angle[:, :count] = rng.uniform(-math.pi, math.pi, (n, count))
    fields["u"][:, :count] = np.exp(1j * angle[:, :count]) * (1.0 + 1e-13 * rng.normal(size=(n, count)))
    return replace(system, near=angle, kept=angle @ system.layout.rolled.T), Pose(**fields)


@pytest.mark.skipif(bool(np.finfo(np.longdouble).eps > 1e-18), reason="a long double has no more digits here")
@pytest.mark.parametrize("name", [*(name for name in SCENES if name not in FIXED), *ROLLING])
def test_rounding_of_links_anywhere_moves_no_constraint_farther_than_is_told(name: str) -> None:
    reach = reach_of(name)
    known = reach.motion(np.linspace(*reach.ends, 62)[1:-1], extended=False).accuracy
    known = known.rows(np.flatnonzero(known.ok))
    whole = Constraints.whole(replace(known.structure), known.drive.followed(known.structure))
    system, all_ = wild(whole, whole.of(known.poses), 5)
    exact = np.zeros_like(system.drive.value)
    with patch.object(bounds, "conversion_error", lambda *_: (0.0, 0.0)):
        told = bounds._row_errors(system, all_, system.parts(all_, 2), np.zeros(len(known.ok), bool), [exact] * 3)
    moved = np.abs(system.constraints(in_more_digits(all_)) - system.constraints(all_))
    assert (moved <= told).all()


@pytest.mark.skipif(bool(np.finfo(np.longdouble).eps > 1e-18), reason="a long double has no more digits here")
@pytest.mark.parametrize("name", ["FOUR_BAR", "OFFSET_SWING", "OLDHAM", "FIVE_BAR"])
def test_the_difference_of_the_rates_of_two_links_is_rounded_no_farther_than_is_told(name: str) -> None:
    reach = reach_of(name)
    known = reach.motion(np.linspace(*reach.ends, 62)[1:-1], extended=False).accuracy
    known = known.rows(np.flatnonzero(known.ok))
    whole = Constraints.whole(replace(known.structure), known.drive.followed(known.structure))
    system, all_ = wild(whole, whole.of(known.poses), 5)
    for field in ("omega", "alpha"):
        getattr(all_, field)[:, system.layout.members :] = 0.3
    exact = np.zeros_like(system.drive.value)
    with patch.object(bounds, "conversion_error", lambda *_: (0.0, 0.0)):
        told = bounds._row_errors(system, all_, system.parts(all_, 2), np.zeros(len(known.ok), bool), [exact] * 3)
    seen = 0
    for order, rate in enumerate((all_.omega, all_.alpha), start=1):
        one, two = (rate[:, links] for links in (system.layout.one, system.layout.two))
        missed = np.abs((one.astype(np.longdouble) - two) - (one - two))
        assert (missed <= told[order][:, system.layout.turn_rows]).all()
        seen += np.count_nonzero(missed)
    assert seen


def driven_slide(travel: float) -> Mechanism:
    """A crank of 3 m moved by its slider on a rod of 5 m, which comes to its end at 8 m."""
    return mechanism_of({
        "units": {"length": "m"},
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": "A", "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 3},
            "2": {"points": ["B", "C"], "length": 5},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"slide": "3", "travel": travel, "velocity": 1},
        "sketch": {"B": [2.9, 0.1]},
    })


@pytest.mark.parametrize("part", [0.05, 0.2, 0.3])
def test_errors_grow_beside_a_dead_point_no_more_than_is_told(part: float) -> None:
    own = solve(driven_slide(7.99))
    known, off = own.accuracy, part * 0.01  # of the distance from the end
    errors = np.full(known.drive.value.shape, off)
    told = bounds.error_bounds(replace(known.structure), known.poses, known.drive, known.slack, known.refined, errors)
    for travel in (7.99 - off, 7.99 + off):
        for link, most in told.items():
            changes = missed(own, solve(driven_slide(travel)), link)
            assert all(change <= float(bound[0]) for change, bound in zip(changes, most, strict=True)), link


def test_bounds_of_velocities_grow_by_the_cube_of_the_growth_of_places_of_accelerations_by_the_fifth_power() -> None:
    known = solve(driven_slide(7.99)).accuracy
    given = replace(known.structure), known.poses, known.drive, known.slack, known.refined
    angles = []
    for growth in (1.0, 2.0):
        with patch.object(
            bounds, "_growth", lambda inverse, *_, by=growth: (np.ones(1, bool), by * np.eye(inverse.shape[1])[None])
        ):
            most = bounds.error_bounds(*given)["1"]
        angles.append(np.concatenate((most.angle, most.omega, most.alpha)))
    assert [2**1, 2**3, 2**5] == pytest.approx((angles[1] / angles[0]).tolist(), rel=1e-9)


def test_what_is_computed_in_fifty_digits_is_rounded_once() -> None:
    own = solve(driven_slide(7.999999999))
    assert own.accuracy.refined.all()
    with mpmath.workdps(60):
        travel = mpmath.mpf("7.999999999")
        cosine = (9 + travel**2 - 25) / (6 * travel)
        u = own.poses["1"].u[0]
        missed_by = float(mpmath.hypot(mpmath.mpf(u.real) - cosine, mpmath.mpf(u.imag) - mpmath.sqrt(1 - cosine**2)))
    assert 0.0 < missed_by <= float(own.accuracy.links["1"].angle[0]) < 1e-15
