"""What a sheet in two languages says twice, and what once."""

import re

import pytest

from graphkin import cam, centres, centrodes, design, draw
from graphkin.drawing import Text
from graphkin.drawing.ink.primitives import walk
from graphkin.words import Neutral, Phrase, in_all, rich_text
from graphkin.words.symbols import sign


def texts(figure) -> list[str]:
    return [t.string for t in walk(figure.children) if isinstance(t, Text)]


def test_a_formula_that_both_languages_share_is_written_once():
    said = Phrase("force arms", arms=Neutral(sign("G"), " 13.17 mm"), scale=Neutral("× 0.005 m/mm"))
    assert ["arms on paper 图上力臂: $G$ 13.17 mm; in m 换算为 m: × 0.005 m/mm"] == [*map(repr, in_all(said, "both"))]


def test_a_place_is_told_in_each_language_behind_the_masses_that_stand_once():
    said = " ".join(texts(draw("shaper-forces", language="both", figures=("forces",)).figures["forces"]))
    assert "J4=1.2kg·m²atS4在S4;m6=81.633kg" in re.sub(r"\s", "", said)


def test_what_a_construction_tells_to_who_does_not_see_ends_its_sentences_as_its_language_does():
    described = [design("guide-bar-stroke-100", language="zh").figures["design"].desc,
                 cam("cam-flat-face", language="zh").figures["cam"].desc]
    assert [[], []] == [re.findall(r".\. |.\.$", text) for text in described]


def test_formulas_in_another_order_keep_the_sentences_apart():
    gaps = zip(("datum", "low", "high", "unit", "angle", "best", "here"), map(Neutral, "a123456"), strict=True)
    said = Phrase("given masses", first=Neutral("b = 2"), second=Phrase("best choice", **dict(gaps)))
    assert 2 == len(in_all(said, "both"))


def test_a_sentence_without_a_formula_stands_in_each_language_whole():
    said = Phrase(
        "given spring", name="R", point=sign("A"), link="3", other_point=sign("B"), other_link="4", rate="1.6 N/mm",
        free="60 mm", preload="12 N", force=sign("P"),
    )
    assert (rich_text(said, "en"), rich_text(said, "zh")) == in_all(said, "both")


def test_what_is_the_same_in_both_languages_stands_once():
    assert (sign("F") + " = 2 N",) == in_all(sign("F") + " = 2 N", "both")


def test_the_numbers_of_a_spring_stand_once_in_two_languages():
    said = " ".join(texts(draw("rocker-return-spring", language="both", figures=("forces",)).figures["forces"]))
    assert 1 == said.count("1.6 N/mm")


@pytest.mark.parametrize(("language", "said"), [("en", "(internal teeth)"), ("both", "(internal teeth 内齿)")])
def test_internal_teeth_are_said_to_be_internal_and_have_no_sign(language, said):
    shown = texts(draw("gears-epicyclic", language=language, figures=("sheet",)).figures["sheet"])
    assert [True] == [said in text and "−" not in text for text in shown if "70" in text and "z" in text]


@pytest.mark.parametrize("name", ["shaper-scheme-2", "elliptic-trammel"])
def test_velocities_by_centres_name_each_centre_as_often_in_two_languages_as_in_one(name):
    told = [
        " ".join(t.string for t in walk(centres(name, language=each).figure.children)
                 if isinstance(t, Text) and "told" in t.classes)
        for each in ("en", "both")
    ]
    one, both = ([re.sub(r"\s", "", s) for s in re.findall(r"P\s*\d\s*\d", words)] for words in told)
    assert one
    assert one == both


@pytest.mark.parametrize("figure", ["forces", "lever"])
def test_numbers_of_forces_stand_once_on_a_sheet_in_two_languages(figure):
    long = [
        sorted(re.findall(r"\d+\.\d{3,}|\d{5,}", " ".join(texts(draw("shaper-forces", language=each,
               figures=(figure,)).figures[figure]))))
        for each in ("en", "both")
    ]
    assert long[0]
    assert long[0] == long[1]


def test_a_unit_that_both_languages_write_alike_stands_once():
    figure = draw("sixbar-420rpm", language="both", figures=["mechanism"]).figures["mechanism"]
    assert any("dimensions in / 尺寸单位 m" in text for text in texts(figure))



@pytest.mark.parametrize(("name", "english", "chinese"), [
    ("triad-slider", "Sonlink4:wherethelinesofthelegsat", "构件4上的S：C、E处两支链延长线"),
    ("engine-gas-force", "VS3bytheimageoflink3", "由构件3的影像得VS3"),
    ("gears-epicyclic", "goesonoverleaf转下页", "转下页"),
])
def test_the_words_beside_the_equations_stand_in_both_languages(name, english, chinese):
    shown = texts(draw(name, language="both", figures=("sheet",)).figures["sheet"])
    said = re.sub(r"\s", "", "".join(shown))
    assert [True, True] == [english in said, chinese in said]


def test_the_legend_of_centrodes_stands_in_both_languages():
    said = re.sub(r"\s", "", "".join(texts(centrodes("four-bar-coupler-point", link="2", language="both").figure)))
    assert [True, True] == ["fixedcentrode" in said, "定瞬心线" in said]


def test_a_further_page_of_forces_is_numbered_in_both_languages():
    second = draw("shaper-forces", language="both", figures=("forces",)).figures["forces"].further[0]
    assert "Sheet 2 第 2 页" in texts(second)
