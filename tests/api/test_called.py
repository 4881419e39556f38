"""What callers of the public functions may give, and what is said of the rest."""

from __future__ import annotations

import numpy as np
import pytest

import graphkin

pytestmark = pytest.mark.quick

SIXBAR = "sixbar-guide-40deg"


def test_one_symbol_may_stand_without_a_list():
    assert graphkin.check(SIXBAR, find=["v_D"]).data == graphkin.check(SIXBAR, find="v_D").data


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: graphkin.check(SIXBAR, at="50"), "at 1: '50' is no driver value"),
        (lambda: graphkin.check(SIXBAR, at={"1": float("nan")}), "at 1: nan is no driver value"),
        (lambda: graphkin.solve(SIXBAR, sweep=2.5), "sweep: 2.5 positions; give a whole number"),
        (lambda: graphkin.solve(SIXBAR, sweep="12"), "sweep: found '12'; give a whole number from 1 to 10000000"),
        (lambda: graphkin.sweep(SIXBAR, positions=None), "positions: found None; give a whole number"),
        (lambda: graphkin.handout(SIXBAR, positions="6"), "positions: found '6'; give a whole number from 1 to 72"),
        (lambda: graphkin.check(SIXBAR, instrument="pencil", seed="x"), "seed: found 'x'; give a whole number"),
        (lambda: graphkin.check(SIXBAR, find=3), 'find: found 3; give symbols: ["v_B", "omega_3"]'),
        (lambda: graphkin.check(SIXBAR, find=[None]), 'find: "None" is no quantity'),
        (lambda: graphkin.check(SIXBAR, instrument=3), 'instrument: "3"'),
        (lambda: graphkin.draw(SIXBAR, language=3), 'lang: "3"'),
        (lambda: graphkin.draw(SIXBAR, formats=3), "format: found 3; give a list: svg, pdf, png"),
        (lambda: graphkin.problem_set(SIXBAR, variants=True), "variants: found True; give a whole number"),
        (lambda: graphkin.draw(SIXBAR, formats="svg"), 'format: "svg" is a text; give a list: ["svg"]'),
        (lambda: graphkin.draw(SIXBAR, formats=()), "format: none given; known here: svg, pdf, png"),
    ],
)
def test_a_wrong_argument_is_told_in_a_sentence(call, said):
    with pytest.raises(graphkin.CallError) as refusal:
        call()
    assert str(refusal.value).startswith(said)


def test_whole_numbers_may_be_those_of_numpy():
    one, two = (graphkin.check(SIXBAR, instrument="pencil", seed=seed) for seed in (np.int64(3), 3))
    assert one.data == two.data
    assert 4 == len(graphkin.solve(SIXBAR, sweep=np.uint8(4)).motion)
