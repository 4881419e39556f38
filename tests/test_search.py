"""Zeros, extremes and intervals of functions whose values are known."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from graphkin.search import (
    FIRST_PIECES,
    angles_between,
    changes,
    extrapolated,
    greatest_and_least,
    intervals,
    last_true,
    least_value,
    places_between,
    resolve,
    zero_between,
)

pytestmark = pytest.mark.quick

Array = NDArray[np.float64]


def column(values: Array) -> tuple[Array, Array]:
    return values[:, None], np.zeros((len(values), 1))


def test_zeros_of_a_sine() -> None:
    pieces = resolve(lambda t: column(np.sin(3 * t)), 0.1, 4.0)
    assert [np.pi / 3, 2 * np.pi / 3, np.pi] == pytest.approx(pieces.zeros(0).tolist(), abs=1e-14)


def test_extremes_of_a_sharp_peak_between_the_nodes() -> None:
    pieces = resolve(lambda t: column(1 / (1e-5 + (t - 0.123456789) ** 2)), 0.0, 1.0)
    assert [0.123456789] == pytest.approx(pieces.extremes(0).tolist(), abs=1e-9)


def test_two_zeros_close_together_are_both_found() -> None:
    pieces = resolve(lambda t: column((t - 0.4) * (t - 0.4002)), 0.0, 1.0)
    assert [0.4, 0.4002] == pytest.approx(pieces.zeros(0).tolist(), abs=1e-10)


def test_a_curve_that_comes_close_to_zero_has_no_zero() -> None:
    assert len(resolve(lambda t: column((t - 0.4) ** 2 + 1e-8), 0.0, 1.0).zeros(0)) == 0


@pytest.mark.parametrize("amplitude", [1e-2, 1e-4, 1e-5, 1e-6, 1e-7])
@pytest.mark.parametrize("level", [-0.8, 0.155, 0.7])
def test_an_extreme_where_two_pieces_meet_is_found_once(amplitude: float, level: float) -> None:
    for place in (np.arange(1, FIRST_PIECES) / FIRST_PIECES).tolist():
        pieces = resolve(lambda t, at=place: column(level + amplitude * np.cos(3 * (t - at))), 0.0, 1.0)  # type: ignore[misc]
        assert [place] == pytest.approx([turn.place for turn in pieces.turns(0)], abs=1e-6)


@pytest.mark.parametrize("top", [0.27, 0.98])
def test_the_greatest_value_is_told_of_the_peak_that_falls_between_samples(top: float) -> None:
    def peaks(at: Array) -> Array:
        return np.asarray(0.99 * np.exp(-(((at - 0.61) / 0.08) ** 2)) + np.exp(-(((at - top) / 0.08) ** 2)))

    places = np.linspace(0.0, 1.0, 14)
    (place, greatest), _ = greatest_and_least(peaks, places, peaks(places), 1e-9)
    exact = peaks(at := np.linspace(0.0, 1.0, 100001))
    assert (at[exact.argmax()], exact.max()) == pytest.approx((place, greatest), abs=1e-5)


def test_an_extreme_where_a_turn_begins_is_counted_once() -> None:
    assert len(resolve(lambda t: column(np.cos(t)), 0.0, 2 * np.pi, periodic=True).extremes(0)) == 2


def test_rounding_about_a_constant_is_constant() -> None:
    rng = np.random.default_rng(1)
    pieces = resolve(lambda t: column(3.0 + 1e-16 * rng.normal(size=len(t))), 0.0, 1.0)
    assert pieces.is_constant(0)


def test_noise_about_zero_is_not_looked_into() -> None:
    calls: list[int] = []

    def noise(t: Array) -> tuple[Array, Array]:
        calls.append(len(t))
        return column(1e-17 * np.sin(1e9 * t))

    resolve(noise, 0.0, 1.0, floor=np.ones(1))
    assert len(calls) == 1


def test_extremes_of_a_curve_that_grows_without_bound_at_its_ends() -> None:
    # 1 / sin has its least value in the middle
    pieces = resolve(lambda t: column(1 / np.sin(t)), 0.0, np.pi, weight=np.ones((2, 1)))
    assert [np.pi / 2] == pytest.approx(pieces.extremes(0).tolist(), abs=1e-12)


def test_value_at_an_end_comes_from_the_polynomial() -> None:
    assert resolve(lambda t: column(np.exp(t)), 0.0, 1.0).at(1.0, 0) == pytest.approx(np.e, rel=1e-14)


def test_what_may_be_rounding_is_not_looked_into() -> None:
    calls: list[int] = []

    def noise(t: Array) -> tuple[Array, Array]:
        calls.append(len(t))
        return column(2.0 + 1e-10 * np.sin(1e9 * t))[0], np.full((len(t), 1), 1e-8)

    assert [] == resolve(noise, 0.0, 1.0).extremes(0).tolist()
    assert len(calls) == 1


def test_a_curve_turns_where_it_leaves_a_stretch_along_which_it_stands_still() -> None:
    # it stands at 1 up to the seam, and up to the end of the turn, where the next one begins
    pieces = resolve(
        lambda t: column(np.where(t < 2.0, 1.0, 1.0 + np.sin(np.pi * (t - 2.0)))), 0.0, 4.0, True, seams=np.array([2.0])
    )
    turns = [(t.place, t.sense) for t in pieces.turns(0)]
    assert [(2.0, -1.0), (2.5, 1.0), (3.5, -1.0)] == [(pytest.approx(at, abs=1e-12), sense) for at, sense in turns]


def test_whether_a_curve_turns_where_it_leaves_nothing_is_the_callers_choice() -> None:
    pieces = resolve(
        lambda t: column(np.where(t < 2.0, 0.0, np.sin(np.pi * (t - 2.0)) ** 2)), 0.0, 4.0, True, seams=np.array([2.0])
    )
    at_rest, moving = ([t.place for t in pieces.turns(0, at_rest=both) if t.at_seam] for both in (True, False))
    assert ([2.0], []) == (at_rest, moving)


@pytest.mark.parametrize("seam", [0.0, 1.0])
def test_a_curve_that_jumps_turns_at_both_sides_of_the_jump(seam: float) -> None:
    pieces = resolve(
        lambda t: column(np.mod(t - seam, 4.0) - 2.0), 0.0, 4.0, periodic=True, seams=np.array([seam])
    )
    turns = [(t.place, t.value, t.sense, t.at_seam) for t in pieces.turns(0)]
    assert [] == turns or {(seam, True)} == {(place, at_seam) for place, _, _, at_seam in turns}
    assert [-2.0, 2.0] == pytest.approx(sorted(pieces.levels(0).ravel().tolist()))


def test_a_curve_that_stands_still_for_a_moment_turns_nowhere() -> None:
    assert [] == resolve(lambda t: column((t - 0.4) ** 3), 0.0, 1.0).turns(0)


def test_where_a_curve_has_no_values_it_has_no_zeros() -> None:
    pieces = resolve(lambda t: column(np.where(np.abs(t - 0.3) < 1e-3, np.nan, t - 0.6)), 0.0, 1.0)
    assert [0.6] == pytest.approx(pieces.zeros(0).tolist(), abs=1e-12)


def test_a_condition_holds_up_to_the_last_digit_either_way() -> None:
    assert (2.0**0.5, -(2.0**0.5)) == pytest.approx(
        (last_true(lambda x: x * x < 2.0, 0.0, 2.0), last_true(lambda x: x * x < 2.0, 0.0, -2.0)), rel=1e-15
    )


def test_a_dear_condition_is_asked_place_by_place() -> None:
    asked: list[int] = []

    def holds(x: Array) -> NDArray[np.bool_]:
        asked.append(len(x))
        return x < 0.3

    assert (pytest.approx(0.3, abs=1e-3), {1}) == (last_true(holds, 0.0, 1.0, 2, 1e-3), set(asked))


def test_intervals_go_from_the_first_place_to_the_last_at_most() -> None:
    grid = np.linspace(0.0, 2 * np.pi, 50)
    assert [0.0, np.pi / 2, 3 * np.pi / 2, 2 * np.pi] == pytest.approx(
        [x for ends in intervals(lambda x: np.cos(x) >= 0.0, grid) for x in ends], abs=1e-15
    )


def test_a_condition_that_holds_at_the_first_place_alone_changes_there() -> None:
    assert [0.0] == changes(lambda x: x <= 0.0, np.linspace(0.0, 1.0, 5))


def test_a_valley_is_found_beside_places_without_a_value() -> None:
    with np.errstate(invalid="ignore"):
        place, value = least_value(lambda x: (x - 0.3) ** 2 + 1.0 + 0.0 * np.sqrt(0.9 - x), 0.0, 1.0)
    assert (pytest.approx(0.3, abs=1e-7), 1.0) == (place, value)


@pytest.mark.parametrize("middle", [0.5, 0.4375, 0.3])
def test_a_flat_extreme_is_found_wherever_pieces_meet(middle: float) -> None:
    pieces = resolve(lambda t: column(np.sin(np.pi * (t - middle)) ** 4 + 2.0), 0.0, 1.0, periodic=True)
    least = [turn.place for turn in pieces.turns(0) if turn.sense < 0]
    assert [middle] == pytest.approx(least, abs=1e-4)


def test_a_flat_extreme_where_a_turn_begins_is_found_once() -> None:
    pieces = resolve(lambda t: column(np.sin(np.pi * t) ** 4), 0.0, 1.0, periodic=True)
    assert [0.0, 0.5] == pytest.approx(sorted(turn.place % 1.0 for turn in pieces.turns(0)), abs=1e-4)


def test_an_extreme_where_two_pieces_meet_is_found_beside_values_that_may_be_off() -> None:
    pieces = resolve(lambda t: ((3.0 - np.cos(t))[:, None], np.full((len(t), 1), 2e-8)), 0.0, 2 * np.pi, periodic=True)
    assert [0.0, np.pi] == pytest.approx(sorted(turn.place % (2 * np.pi) for turn in pieces.turns(0)), abs=1e-6)


@pytest.mark.parametrize("ends", [(0.0, 3.0), (3.0, 0.0)])
def test_a_zero_between_two_places_has_all_digits(ends: tuple[float, float]) -> None:
    assert pytest.approx(np.sqrt(2.0), rel=4e-16) == zero_between(lambda x: x**9 - np.sqrt(2.0) ** 9, *ends)


def test_a_bent_function_is_looked_at_few_times_for_its_zero() -> None:
    places: list[float] = []
    zero_between(lambda x: places.append(x) or np.expm1(5.0 * (x - 0.3)), 0.0, 1.0)  # type: ignore[func-returns-value]
    assert 15 >= len(places)


def test_the_search_for_a_zero_ends_where_a_function_has_no_value() -> None:
    assert 0.4 < zero_between(lambda x: np.nan if 0.4 < x < 0.6 else x - 0.5, 0.0, 1.0) < 0.6


def test_a_polynomial_is_extrapolated_to_its_value_at_0() -> None:
    steps = [1.0, 2.0, 4.0, 5.0]
    # without the last the parabola is off by 0.5 * 1 * 2 * 4
    assert (7.0, 4.0) == pytest.approx(extrapolated([7.0 - x + 0.5 * x**3 for x in steps], steps))


def test_places_by_an_angle_and_their_angles_are_each_others_inverse() -> None:
    angle = np.array([0.0, 0.3, 1.5, 1.7, np.pi])
    places = places_between(angle, -2.0, 3.0)
    assert [-2.0, 0.5 - 2.5 * np.cos(0.3), 3.0] == pytest.approx(places[[0, 1, 4]].tolist())
    assert angle.tolist() == pytest.approx(angles_between(places, -2.0, 3.0).tolist())


def test_two_turns_nearer_to_each_other_than_the_farther_look_are_both_found() -> None:
    def cubic(t: NDArray[np.float64]) -> NDArray[np.float64]:
        u = np.sin(t - 1.0)
        return np.asarray(u**3 / 3 - 1.5e-3**2 * u)

    assert 6 == len(resolve(lambda t: column(cubic(t)), 0.0, 2 * np.pi, periodic=True).turns(0))
