"""Mechanisms made ready: the same numbers one by one, in blocks, in chunks and compiled, and those of ``solve``."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from importlib.util import find_spec

import numpy as np
import pytest

from graphkin.errors import CallError
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver import prepared, solve
from graphkin.solver.compiled.kernel import kernel_text
from graphkin.solver.prepared import PreparedMechanism
from tests import scenes

NUMBA = pytest.mark.skipif(find_spec("numba") is None, reason="the extra fast is not installed")
ASKED = ("C", "v_C", "a_C", "omega_3", "alpha_3")


def prepare(scene: Mechanism, asked: Sequence[str]) -> PreparedMechanism:
    return prepared.prepare(scene, [*map(Symbol.parse, asked)])


def four_bar() -> PreparedMechanism:
    return prepare(mechanism_of_text(scenes.FOUR_BAR, "four-bar"), ASKED)


def test_the_columns_are_those_of_solve() -> None:
    columns, _ = four_bar().sweep(50)
    motion = solve(mechanism_of_text(scenes.FOUR_BAR, "four-bar"), sweep=50)
    expected = [
        x
        for z in (motion.position("C"), motion.velocity("C"), motion.acceleration("C"))
        for x in (z.real, z.imag)
    ] + [motion.omega("3"), motion.alpha("3")]
    for mine, theirs in zip(columns, expected, strict=True):
        assert mine == pytest.approx(theirs, abs=1e-14 * np.abs(expected).max())


def test_each_vector_has_two_columns() -> None:
    assert four_bar().names[:4] == ("x_C", "y_C", "v_C.x", "v_C.y")


def test_one_position_in_plain_floats_is_the_same_to_the_last_bit() -> None:
    ready = four_bar()
    values = np.linspace(-3, 3, 40)
    columns, _ = ready.columns(values)
    assert [ready.at(float(v)) for v in values] == [tuple(row) for row in columns.T.tolist()]


@pytest.mark.parametrize(("name", "count"), [("sixbar-AE70", 237), ("boom-lifted", 721)])
def test_a_sweep_of_a_limited_range_has_the_positions_that_its_range_reaches(name: str, count: int) -> None:
    ready = prepare(mechanism_of(name), ["omega_2"])
    columns, ok = ready.sweep(721)
    reached = ready.range.reaches(ready.range.offsets(ready.range.grid(721).values))
    assert reached.tolist() == ok.tolist() == np.isfinite(columns[0]).tolist()
    assert count == ok.sum()


def test_a_sweep_in_pieces_is_the_sweep() -> None:
    ready = four_bar()
    whole, _ = ready.sweep(1000)
    pieces = np.hstack([ready.columns(ready.range.grid(1000, k, k + 250).values)[0] for k in range(0, 1000, 250)])
    assert pieces == pytest.approx(whole, abs=1e-14 * np.abs(whole).max())


def test_one_position_is_there_where_positions_of_an_array_are() -> None:
    for scene in (mechanism_of("sixbar-AE70"), mechanism_of_text(scenes.CYLINDER, "c")):
        ready = prepare(scene, ("v_B",))
        beside = np.add.outer(ready.range.value(np.array(ready.range.ends)), 1e-16 * np.arange(-40, 41)).ravel()
        values = np.concatenate([np.linspace(-7, 7, 301), beside])
        _, ok = ready.columns(values)
        assert ok.tolist() == [ready.at(float(v)) is not None for v in values]
        assert 0 < ok[:301].sum() < 301


@pytest.mark.parametrize("n", [1999, 2000, 50000])
def test_many_even_steps_are_as_exact_as_single_ones(n: int) -> None:
    ready = four_bar()
    columns, _ = ready.sweep(n)
    single, _ = ready.columns(ready.range.grid(n).values)
    assert np.abs(columns - single).max() < 2e-14 * np.abs(single).max()


@NUMBA
def test_compiled_columns_are_those_of_numpy() -> None:
    ready = prepare(mechanism_of_text(scenes.FOUR_BAR, "four-bar"), ("C", "v_C", "omega_3"))
    slow, _ = ready.sweep(200_000)
    fast, _ = ready.sweep(200_000, fast=True)
    assert np.abs(fast - slow).max() < 2e-14 * np.abs(slow).max()


MANY = ("B", "C", "B@3", "v_B", "v_C", "a_B", "a_C", "v_C/B", "omega_2", "omega_3", "alpha_2", "alpha_3")


@NUMBA
def test_many_compiled_columns_are_those_of_numpy() -> None:
    ready = prepare(mechanism_of_text(scenes.FOUR_BAR, "four-bar"), MANY)
    slow, _ = ready.sweep(120_000)
    fast, _ = ready.sweep(120_000, fast=True)
    assert np.abs(fast - slow).max() < 2e-14 * np.abs(slow).max()


def test_no_compiled_loop_fills_more_columns_than_can_be_told_apart() -> None:
    ready = prepare(mechanism_of_text(scenes.FOUR_BAR, "four-bar"), MANY)
    loops = kernel_text(ready.code, True, True).split("for k in range(m)")[1:]
    assert [loop.count("[k] = ") for loop in loops] == [14, 6]


@pytest.mark.parametrize("order", ["123", "132"], ids=["rod first", "barrel first"])
def test_a_cylinder_whose_rod_slides_off_its_hinge_turns_as_its_triangle_gives(order: str) -> None:
    links = {
        "1": {"points": ["A", "B"], "length": 400},
        "2": {"points": ["B"], "on": "3.g"},
        "3": {"points": ["C"], "guides": {"g": {"through": [0, 30], "angle": 0}}},
    }
    scene = {
        "frame": {"points": {"A": [0, 0], "C": [200, -300]}},
        "links": {name: links[name] for name in order},
        "driver": {"slide": "2", "travel": 520, "velocity": 60},
    }
    rates = prepare(mechanism_of(scene), ("omega_1", "omega_3")).at(0.520)
    c, rod = 200 - 300j, 520 + 30j  # of C from A, of B from C in the barrel's axes
    angle = math.acos((400**2 + abs(c) ** 2 - abs(rod) ** 2) / (2 * 400 * abs(c)))
    b = cmath.rect(400, cmath.phase(c) + angle)
    arm = 520 * 60 / (1j * b * (b - c).conjugate()).real  # of |B - C|^2 = travel^2 + 30^2
    barrel = (1j * arm * b / (b - c) - 60 / rod).imag  # of B - C = rod e^(i theta)
    assert rates == pytest.approx((arm, barrel), rel=1e-12)


def test_positions_out_of_reach_are_marked() -> None:
    _, ok = prepare(mechanism_of("sixbar-AE70"), ("v_C",)).columns(np.radians([50, 58.9, 59.1, 180, 301.1]))
    assert ok.tolist() == [True, True, False, False, True]


def test_positions_out_of_reach_have_no_numbers_one_by_one() -> None:
    assert prepare(mechanism_of("sixbar-AE70"), ("v_C",)).at(3.0) is None


def test_a_change_point_is_marked_as_dead() -> None:
    _, ok = prepare(mechanism_of_text(scenes.PARALLELOGRAM, "p"), ("omega_3",)).columns(np.radians([170, 180, 190]))
    assert ok.tolist() == [True, False, True]


def test_a_parallelogram_stays_one_through_its_change_points() -> None:
    columns, ok = prepare(mechanism_of_text(scenes.PARALLELOGRAM, "p"), ("omega_2",)).sweep(77)
    assert np.abs(columns[0, ok]).max() < 1e-9


def test_columns_hold_no_number_where_there_is_no_such_position_and_everywhere_else_one() -> None:
    prepared = prepare(mechanism_of_text(scenes.PARALLELOGRAM, "p"), ("a_C", "alpha_2"))
    columns, ok = prepared.columns(np.radians([0, 90, 180]))
    assert [False, True, False] == ok.tolist()
    assert [[False, True, False]] * 3 == np.isfinite(columns).tolist()


AE70, PARALLELOGRAM = mechanism_of("sixbar-AE70"), mechanism_of_text(scenes.PARALLELOGRAM, "p")


def test_no_position_that_does_not_exist_is_computed_or_looked_at() -> None:
    ready = prepare(AE70, ("v_C",))
    _, away, careful = ready._divided(ready.range.grid(10_000))
    _, ok = ready.columns(ready.range.grid(10_000).values)
    assert (int((~ok).sum()), 0) == (sum(gap.stop - gap.start for gap in away), len(careful))


def test_only_positions_at_change_points_are_looked_at() -> None:
    ready = prepare(PARALLELOGRAM, ("v_C",))
    _, _, careful = ready._divided(ready.range.grid(3000))
    assert [1000, 2500] == careful.tolist()  # the driver begins at 60 degrees


def test_a_position_between_what_is_clear_and_the_end_of_the_motion_is_there() -> None:
    ready = prepare(AE70, ("v_C",))
    clear, end = ready.range.clear[-1, 1], ready.range.ends[1]
    steps = ((n, int(end / (2 * np.pi) * n)) for n in range(1001, 100_000))
    n, last = next((n, k) for n, k in steps if clear < 2 * np.pi * k / n < end - 1e-9)
    assert [True, False] == ready.sweep(n)[1][last : last + 2].tolist()


@pytest.mark.parametrize("fast", [False, pytest.param(True, marks=NUMBA)])
@pytest.mark.parametrize("scene", [AE70, PARALLELOGRAM])
def test_many_positions_with_ends_or_change_points_are_those_of_few(scene: Mechanism, fast: bool) -> None:
    ready = prepare(scene, ("v_C", "omega_3"))
    for n in (1440, 3001):
        values = ready.range.grid(n).values
        few = [ready.columns(some) for some in np.array_split(values, 6)]
        expected, there = (np.concatenate(parts, axis=-1) for parts in zip(*few, strict=True))
        for columns, ok in (ready.sweep(n, fast=fast), ready.columns(values, fast=fast)):
            assert there.tolist() == ok.tolist()
            assert expected == pytest.approx(columns, rel=1e-9, abs=1e-12, nan_ok=True)


def test_a_travel_is_that_of_solve() -> None:
    columns, _ = prepare(mechanism_of("shaper-scheme-2"), ("s_3/4", "theta_4")).sweep(10)
    motion = solve(mechanism_of("shaper-scheme-2"), sweep=10)
    assert columns[0] == pytest.approx(motion.slide("3/4")[0], abs=1e-15)


def test_a_driven_slide_is_swept_inside_its_range() -> None:
    ready = prepare(mechanism_of_text(scenes.CYLINDER, "c"), ("v_B",))
    assert ready.range.grid(10).values == pytest.approx(0.1 + 0.4 * (np.arange(10) + 0.5) / 10, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "what"),
    [("Q", "Q"), ("v_Q", "Q"), ("omega_9", "9"), ("s_1/2", "1/2"), ("an_C/A", "an_C/A")],
)
def test_a_name_that_names_nothing_is_refused(name: str, what: str) -> None:
    with pytest.raises(CallError, match=what):
        prepare(mechanism_of_text(scenes.FOUR_BAR, "four-bar"), (name,))


def test_a_larger_group_is_solved_as_by_solve() -> None:
    scene = mechanism_of("double-butterfly")
    columns, ok = prepare(scene, ("a_E", "omega_5")).sweep(4)
    motion = solve(scene, sweep=4)
    expected = [motion.acceleration("E").real, motion.acceleration("E").imag, motion.omega("5")]
    assert ok.all()
    assert columns == pytest.approx(np.array(expected), abs=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize(("past", "clear"), [(1e-3, True), (1e-9, False)])
def test_only_a_turn_that_comes_to_no_dead_point_is_swept_without_a_look_at_each_position(past, clear) -> None:
    scene = mechanism_of(scenes.four_bar(100, 300, 101, 299 + past, sketch={"C": [300, 101]}))
    ready = prepare(scene, ["omega_3"])
    assert (True, clear) == (ready.whole, ready.clear)
    columns, ok = ready.sweep(720)
    solved = solve(scene, sweep=720)
    assert solved.ok.tolist() == ok.tolist()
    assert pytest.approx(solved.omega("3")[ok], rel=1e-7) == columns[0][ok]
