"""Symbols in words, for who hears them."""

import pytest

from graphkin.account.notation import Notation
from graphkin.account.spoken import spoken_vector, spoken_words
from graphkin.construction.board.steps import Size
from graphkin.scene.symbol import Symbol
from graphkin.words.symbols import sign


@pytest.mark.parametrize(("english", "chinese", "school", "name"), [
    ("velocity of B3 relative to B2", "B3 相对 B2 的速度", "chinese", "v_B@3/B@2"),
    ("velocity of B3 relative to B2", "B3 相对 B2 的速度", "us", "v_B@3/B@2"),
    ("normal acceleration of C relative to B", "C 相对 B 的法向加速度", "chinese", "an_C/B"),
    ("tangential acceleration of C relative to B", "C 相对 B 的切向加速度", "chinese", "at_C/B"),
    ("tangential acceleration of C relative to B", "C 相对 B 的切向加速度", "russian", "at_C/B"),
    ("Coriolis acceleration of B3 relative to B2", "B3 相对 B2 的哥氏加速度", "us", "ak_B@3/B@2"),
    ("velocity of Pin", "Pin 的速度", "chinese", "v_Pin"),
    ("alpha 5 p", "阿尔法 5 p", "chinese", "pressure_5"),
])
def test_a_symbol_of_each_convention_is_read_as_what_it_is(english: str, chinese: str, school: str, name: str):
    symbol = Notation(school).vector(Symbol.parse(name))
    assert (english, chinese) == (spoken_words(symbol, "en"), spoken_words(symbol, "zh"))


def test_a_rule_is_read_factor_by_factor():
    rule = Notation("chinese").size(Size("rate", ("3",), ("C", "B"), square=True))
    assert "angular velocity of link 3 squared length C B" == spoken_words(rule, "en")


def test_a_letter_that_only_looks_like_a_quantity_is_read_as_a_letter():
    assert "v C" == spoken_words(sign("v", "C"), "en")


def test_a_vector_is_named_in_each_language_of_a_sheet():
    said = spoken_vector(Symbol.parse("ar_B@3/B@2"), "both")
    english, chinese = said.split(" / ")
    assert "sliding acceleration of B of link 3 relative to B of link 2" == english
    assert "构件 3 上的 B 相对构件 2 上的 B 的相对加速度" == chinese
