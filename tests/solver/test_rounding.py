"""Numbers of the file are meant as they are written, and computed with in fifty digits; so are formulas."""

from __future__ import annotations

import random
from decimal import Decimal, localcontext

import pytest

from graphkin.scene import mechanism_of
from graphkin.solver import structure_of
from graphkin.solver.compiled.engine import discriminant_of
from graphkin.solver.drivers import cos_sin, meant, working
from graphkin.solver.path.assemblies import choose_modes
from tests.mechanisms import random_scene
from tests.scenes import four_bar


def test_a_short_decimal_is_meant_by_its_float() -> None:
    assert meant(0.15 * 3) == (Decimal("0.45"), True)


def test_a_float_without_a_short_decimal_stands_for_itself() -> None:
    assert meant(2**0.5) == (Decimal(2**0.5), False)


def test_cosine_and_sine_have_fifty_digits() -> None:
    import mpmath as mp

    with mp.workdps(60), localcontext() as context:
        context.prec = 800  # floats may be as small as 1e-324
        c, s = cos_sin(Decimal("2.5"))
        off = [abs(mp.mpf(str(x)) - f(mp.mpf("2.5"))) for x, f in ((c, mp.cos), (s, mp.sin))]
    assert max(off) < mp.mpf("1e-50")


def test_a_discriminant_is_told_as_well_as_the_digits_of_the_file_tell_it() -> None:
    # the coupler of 50 root 2 is no decimal; with the crank at 60 degrees the line from B to D has the square 7500
    structure = structure_of(mechanism_of(four_bar(50, 50 * 2**0.5, 60, 100)))
    dyad = next(iter(structure.dyads))
    with localcontext() as context:
        context.prec = 60
        value, doubt = discriminant_of(structure, dyad, {}).with_doubt(0, [Decimal("1.047")])
        long1, long2, line = Decimal(50 * 2**0.5) / 1000, Decimal("0.06"), Decimal("0.1")
        c, s = cos_sin(Decimal("1.047"))
        square = (line - c / 20) ** 2 + (s / 20) ** 2

        def exact(coupler: Decimal) -> Decimal:
            both, less = (coupler + long2) ** 2, (coupler - long2) ** 2
            return (both - square) * (square - less) / (2 * coupler * long2) ** 2

        off = long1 * Decimal(3 * 2.0**-53)
        moved = max(abs(exact(long1 + sign * off) - exact(long1)) for sign in (1, -1))
    assert abs(value - exact(long1)) < Decimal("1e-16")
    assert moved <= doubt <= 10 * moved


@pytest.mark.parametrize("seed", range(12))
def test_no_change_of_all_open_numbers_together_moves_a_discriminant_farther_than_its_doubt(seed: int) -> None:
    chance = random.Random(seed)
    kinds = [chance.choice(["RRR", "RRP", "RPR"]) for _ in range(3)]
    structure = structure_of(mechanism_of(random_scene(seed, tuple(kinds), "crank")))
    signs = choose_modes(structure)
    told = 0
    with working():
        for i in structure.dyads:
            discriminant = discriminant_of(structure, i, signs)
            value, doubt = discriminant.with_doubt(0)
            numbers = discriminant._numbers(0, ())
            for _ in range(20):
                moved = {name: number + chance.choice([1, -1]) * error for name, (number, error) in numbers.items()}
                assert abs(discriminant._row(moved)[0] - value) <= doubt
            told += doubt > 0
    assert told
