"""What callers of the public functions may give, and what is said of the rest."""

from __future__ import annotations

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
        (lambda: graphkin.draw(SIXBAR, formats="svg"), 'format: "svg" is a text; give a list: ["svg"]'),
        (lambda: graphkin.draw(SIXBAR, formats=()), "format: none given; known here: svg, pdf, png"),
    ],
)
def test_a_wrong_argument_is_told_in_a_sentence(call, said):
    with pytest.raises(graphkin.CallError) as refusal:
        call()
    assert str(refusal.value).startswith(said)
