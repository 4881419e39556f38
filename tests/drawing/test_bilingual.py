"""What a sheet in two languages says twice, and what once."""

import re

import pytest

from graphkin import centres, draw
from graphkin.drawing import Text
from graphkin.drawing.bilingual import all_in_both, in_both
from graphkin.drawing.ink.primitives import walk


def texts(figure) -> list[str]:
    return [t.string for t in walk(figure.children) if isinstance(t, Text)]


def test_a_formula_that_both_languages_share_is_written_once():
    said = "arms on paper: $G$ 13.17 mm; in m: × 0.005 m/mm", "图上力臂：$G$ 13.17 mm；换算为 m：× 0.005 m/mm"
    assert ("arms on paper 图上力臂: $G$ 13.17 mm; in m 换算为 m: × 0.005 m/mm",) == in_both(said)


def test_a_bracket_that_spans_a_formula_keeps_the_sentences_apart():
    said = "rate of $R$ (link 3): 1.6 N/mm", "$R$ 刚度（构件 3：1.6 N/mm）"
    assert said == in_both(said)


def test_brackets_that_match_are_filled_in_both_languages():
    said = "from $A$ (link 3) to $B$: rate 1.6 N/mm", "由 $A$（构件 3）至 $B$：刚度 1.6 N/mm"
    assert ("from 由 $A$ (link 3 构件 3) to 至 $B$: rate 刚度 1.6 N/mm",) == in_both(said)


def test_the_numbers_of_a_spring_stand_once_in_two_languages():
    said = " ".join(texts(draw("rocker-return-spring", language="both", figures=("forces",)).figures["forces"]))
    assert 1 == said.count("1.6 N/mm")


@pytest.mark.parametrize(("language", "said"), [("en", "(internal teeth)"), ("both", "(internal teeth 内齿)")])
def test_internal_teeth_are_said_to_be_internal_and_have_no_sign(language, said):
    shown = texts(draw("gears-epicyclic", language=language, figures=("sheet",)).figures["sheet"])
    assert [True] == [said in text and "−" not in text for text in shown if "70" in text and "z" in text]


def test_lists_that_do_not_match_stand_one_after_the_other():
    assert ["a = 1 mm", "b", "甲 = 1 mm"] == all_in_both((["a = 1 mm", "b"], ["甲 = 1 mm"]))


@pytest.mark.parametrize("name", ["shaper-scheme-2", "elliptic-trammel"])
def test_velocities_by_centres_name_each_centre_as_often_in_two_languages_as_in_one(name):
    told = [
        " ".join(t.string for t in walk(centres(name, language=each).figure.children)
                 if isinstance(t, Text) and "told" in t.classes)
        for each in ("en", "both")
    ]  # fmt: skip
    one, both = ([re.sub(r"\s", "", s) for s in re.findall(r"P\s*\d\s*\d", words)] for words in told)
    assert one
    assert one == both


@pytest.mark.parametrize("figure", ["forces", "lever"])
def test_numbers_of_forces_stand_once_on_a_sheet_in_two_languages(figure):
    long = [
        sorted(re.findall(r"\d+\.\d{3,}|\d{5,}", " ".join(texts(draw("shaper-forces", language=each,
               figures=(figure,)).figures[figure]))))
        for each in ("en", "both")
    ]  # fmt: skip
    assert long[0]
    assert long[0] == long[1]


def test_a_unit_that_both_languages_write_alike_stands_once():
    figure = draw("sixbar-420rpm", language="both", figures=["mechanism"]).figures["mechanism"]
    assert any("dimensions in / 尺寸单位 m" in text for text in texts(figure))


def test_a_sentence_with_words_between_many_numbers_stands_in_each_language():
    one = "frame may be chosen from 46.2 to 73.3 mm; the greatest angle, 44.02°, is had with 71.5 mm (here 43.36°)"
    other = "机架可在 46.2 到 73.3 mm 之间选取；取 71.5 mm 时最小传动角最大，为 44.02°（本设计为 43.36°）"
    assert (one, other) == in_both((one, other))
