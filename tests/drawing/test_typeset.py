from __future__ import annotations

import pytest

from graphkin.account.notation import as_vector
from graphkin.drawing.font import EM, glyph
from graphkin.drawing.ink.primitives import Text
from graphkin.drawing.text import plain, rich, run_box, runs_width, text_box, width, wrapped
from graphkin.words import symbols
from graphkin.words.symbols import sign
from tests.notation import noted


def symbol(notation, size=3.5):
    return rich(noted(f"${notation}$"), size)


def by_text(runs):
    return {run.text: run for run in runs}


def test_an_index_stands_lower_and_smaller():
    runs = by_text(symbol("v_{B}"))
    assert (runs["B"].size, runs["B"].y > 0) == (2.5, True)


def test_an_index_of_an_index_is_two_millimetres_high():
    assert by_text(symbol("v_{B_3}"))["3"].size == 2.0


def test_nothing_is_smaller_than_two_millimetres():
    assert min(run.size for run in symbol("v_{B_{3_4}}", size=2.5)) == 2.0


def test_sub_and_superscript_stand_above_each_other():
    runs = by_text(symbol("a^{n}_{C}"))
    assert abs(runs["n"].x - runs["C"].x) < 0.2


def test_stacked_sub_and_superscript_do_not_overlap():
    runs = by_text(symbol("a^{n}_{C}"))
    assert run_box(runs["n"]).bottom <= run_box(runs["C"]).top + 0.4  # room for descenders that n has not


@pytest.mark.parametrize("letter", ["v", "a", "F", "Φ", "l"])
def test_the_arrow_of_a_vector_stands_over_its_letter(letter):
    arrow, under = rich(as_vector("russian", sign(letter, "CB")))[:2]
    assert ("→", letter, True) == (arrow.text, under.text, under.italic)
    low, tall = glyph("→").box[1] * arrow.size / EM, glyph(letter, "italic").box[3] * under.size / EM
    assert 0.1 < under.y - arrow.y + low - tall < 0.3  # mm between the two
    inked = [arrow.x + glyph("→").box[k] * arrow.size / EM for k in (0, 2)]
    assert abs(sum(inked) / 2 - under.x - width(letter, under.size, True) / 2) < 0.4


def test_what_is_raised_stands_beyond_the_arrow_of_a_vector():
    arrow, *_, part = rich(as_vector("russian", sign("a", above="n")))
    assert arrow.x + glyph("→").box[2] * arrow.size / EM < part.x


def test_letters_of_symbols_are_italic():
    assert by_text(symbol("ω_{3}"))["ω"].italic


def test_digits_of_symbols_are_upright():
    assert not by_text(symbol("ω_{3}"))["3"].italic


def test_chinese_is_upright_in_symbols_too():
    assert not by_text(symbol("v_{滑}"))["滑"].italic


def test_an_apostrophe_becomes_a_prime():
    assert [run.text for run in symbol("p'")] == ["p", "′"]


def test_a_hyphen_becomes_a_minus():
    assert "−" in "".join(run.text for run in symbol("-v"))


def test_words_between_symbols_are_upright_and_in_order():
    runs = rich(noted("velocity $v_B$ of the ram"))
    assert [(r.text, r.italic) for r in runs] == [("velocity", False), ("v", True), ("B", True), ("of the ram", False)]


def test_the_space_after_a_word_is_kept_as_room():
    first, second = rich(noted("to $v$"))
    assert second.x == pytest.approx(width("to ", first.size))


def test_runs_follow_each_other_without_overlap():
    runs = rich(noted("大小 √ ? 方向 $⊥BC$ and $μ_v$ = 10 (mm/s)/mm"))
    ends = [run.x + width(run.text, run.size, run.italic) for run in runs]
    assert all(end <= run.x + 1e-9 for end, run in zip(ends, runs[1:], strict=False))


def test_words_read_no_notation():
    assert rich("5 $ for $v_B$")[0].text == "5 $ for $v_B$"


def test_plain_words_read_no_notation():
    assert plain("v_{B} $x$")[0].text == "v_{B} $x$"


@pytest.mark.parametrize("words", ["the circle about $C", "the arc $C_{1$"])
def test_a_symbol_that_a_table_does_not_close_is_refused(words):
    with pytest.raises(ValueError, match="not closed"):
        symbols.noted(words)


@pytest.mark.parametrize("notation", ["$C_{1}C_{2}$", "the swing $ψ$ = 3", "$AD$/$AB$", "$B_{2}C$"])
def test_the_symbols_of_a_table_are_read_with_their_indices(notation):
    assert notation == repr(symbols.noted(notation))


@pytest.mark.parametrize("notation", ["$a^{n}_{CB}$ and $p'$", "$v_{B_{3}}$ = 2", "$a^{n(2)}_{CB}$(7)"])
def test_rich_text_shows_itself_in_its_notation(notation):
    assert notation == repr(noted(notation))


def test_rich_text_in_an_f_string_is_refused_since_its_symbols_would_be_lost():
    with pytest.raises(TypeError, match=r"str\(\)"):
        f"{sign('v')}"


def test_a_text_anchored_at_its_end_ends_there():
    assert text_box(Text(50 + 10j, rich(noted("$a^n_{C/B}$")), "end")).right == pytest.approx(50.0)


def test_a_text_anchored_at_its_middle_has_as_much_on_both_sides():
    box = text_box(Text(50 + 10j, rich(noted("$v_{B}$ = 0")), "middle"))
    assert box.left + box.right == pytest.approx(100.0)


def test_empty_words_have_no_run():
    assert plain("  ") == ()


def test_the_width_of_no_runs_is_zero():
    assert runs_width(()) == 0.0


def test_a_prime_behind_an_index_stands_above_it_at_the_letter():
    letter, index, prime = rich(noted("$d_5'$"))
    assert ("d", "5", "′") == (letter.text, index.text, prime.text)
    assert (prime.x, prime.y) == pytest.approx((width("d", 3.5, italic=True), letter.y))


def test_a_line_may_break_between_a_chinese_comma_and_a_symbol():
    first, second = wrapped("转动，" + sign("ω", "3"), 3.5, 12.0)
    assert ("转动，", "ω") == ("".join(run.text for run in first), second[0].text)


def test_a_symbol_is_never_broken():
    first, second = wrapped(sign("v", "B3B2") + " found", 3.5, 2.0)
    assert ("vB3B2", "found") == ("".join(run.text for run in first), "".join(run.text for run in second))
