"""Symbols in words, for who hears them."""

import pytest

from graphkin.account.spoken import spoken_vector, spoken_words
from graphkin.scene.symbol import Symbol


@pytest.mark.parametrize(("english", "chinese", "markup"), [
    ("velocity of B3 relative to B2", "B3 相对 B2 的速度", "$v_{B3B2}$"),
    ("velocity of B3 relative to B2", "B3 相对 B2 的速度", "$V_{B3/B2}$"),
    ("normal acceleration of C relative to B", "C 相对 B 的法向加速度", "$a^{n}_{CB}$"),
    ("tangential acceleration of C relative to B", "C 相对 B 的切向加速度", "$a^{t}_{CB}$"),
    ("tangential acceleration of C relative to B", "C 相对 B 的切向加速度", "$a^{τ}_{CB}$"),
    ("Coriolis acceleration of B3 relative to B2", "B3 相对 B2 的哥氏加速度", "$A^{c}_{B3/B2}$"),
    ("angular velocity of link 3 squared length C B", "构件 3 的角速度 平方 长度 C B", "$ω_{3}^{2} l_{CB}$"),
    ("alpha 5 p", "阿尔法 5 p", "$α^{p}_{5}$"),
])  # fmt: skip
def test_a_symbol_of_each_convention_is_read_as_what_it_is(english: str, chinese: str, markup: str):
    assert (english, chinese) == (spoken_words(markup, "en"), spoken_words(markup, "zh"))


def test_a_vector_is_named_in_each_language_of_a_sheet():
    said = spoken_vector(Symbol.parse("ar_B@3/B@2"), "both")
    english, chinese = said.split(" / ")
    assert "sliding acceleration of B of link 3 relative to B of link 2" == english
    assert "构件 3 上的 B 相对 构件 2 上的 B 的相对加速度" == chinese
