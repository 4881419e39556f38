from __future__ import annotations

import string

import pytest

from graphkin.drawing.text import width, wrapped

SIGNS = string.ascii_letters + string.digits + " .,:;?!()[]/*'ωαμπτεφψθβγδλρ√′·°≈≤≥±→"
STYLES = {"": {}, "Italic": {"italic": True}, "Bol": {"bold": True}}


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("character", SIGNS)
def test_a_letter_fits_into_its_stated_width(true_width, style, character):
    assert true_width(character, style) <= width(character, 1.0, **STYLES[style]) + 0.006


@pytest.mark.parametrize("style", STYLES)
def test_a_sentence_is_measured_to_three_percent(true_width, style):
    words = "Acceleration polygon of the oscillating guide bar, link 3"
    assert true_width(words, style) == pytest.approx(width(words, 1.0, **STYLES[style]), rel=0.03)


def test_chinese_is_one_em_a_sign():
    assert width("速度多边形", 3.5) == pytest.approx(5 * 3.5)


def test_no_chinese_line_ends_with_an_opening_bracket_or_begins_with_a_closing_one():
    said = "装载机构：连杆、摇杆（含油缸）支承一板，逆时针"
    for wide in range(10, 40):
        lines = ["".join(run.text for run in runs) for runs in wrapped(said, 3.0, float(wide))]
        assert said == "".join(lines)
        assert not [line for line in lines if line[-1] in "（逆时" or line[0] in "）：、时针"]
