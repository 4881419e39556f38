from __future__ import annotations

import pytest

from graphkin.api.handouts import handout
from graphkin.construction import draft
from graphkin.drawing.conventions import letters_of
from graphkin.papers.lesson import Speaker, plain_words, stages
from graphkin.papers.reasons import reasons
from graphkin.scene import library, mechanism_of

pytestmark = pytest.mark.quick


def _six_bar():
    sheet = draft(mechanism_of("sixbar-guide-40deg"))
    return sheet, Speaker(sheet, letters_of(sheet, "chinese"))


def test_every_equation_is_one_stage_and_the_position_another():
    sheet, _ = _six_bar()
    assert [None, 1, 2, 3, 4, 5, 6] == [s.equation and s.equation.number for s in stages(sheet)]


def test_stages_hold_every_step_once_in_order():
    for name in library():
        sheet = draft(mechanism_of(name))
        assert [s.number for s in sheet.steps] == [step.number for stage in stages(sheet) for step in stage.steps]


def test_an_angular_velocity_is_computed_from_what_was_measured():
    sheet, speaker = _six_bar()
    step = next(s for s in sheet.steps if s.phrase.key == "omega cw")
    assert ("$ω_{3}$ = 1075.8 mm/s / 381.6 mm = 2.819 rad/s",) == speaker.work(step)


def test_a_coriolis_part_is_computed_from_a_measured_rate_and_a_measured_velocity():
    sheet, speaker = _six_bar()
    step = next(s for s in sheet.steps if s.phrase.key == "lay off coriolis")
    assert "2 × 2.8191 × 575.41 = 3244.3 mm/s²" in speaker.work(step)[0]


def test_a_sentence_ends_and_begins_as_its_language_does():
    sheet, speaker = _six_bar()
    step = next(s for s in sheet.steps if s.phrase.key == "lay off coriolis")
    english, chinese = (speaker.sentence(step.phrase, each) for each in ("en", "zh"))
    assert ("L", ".", "。") == (english[0], english[-1], chinese[-1])


def test_symbols_in_sentences_are_closed_in_every_scene_and_convention():
    for name in library():
        sheet = draft(mechanism_of(name))
        for convention in ("chinese", "us", "british", "russian"):
            speaker = Speaker(sheet, letters_of(sheet, convention))
            for step in sheet.steps:
                for markup in (
                    speaker.sentence(step.phrase, "en"),
                    speaker.sentence(step.phrase, "zh"),
                    *speaker.work(step),
                ):
                    assert "$" not in plain_words(markup)
                    assert not {"{", "}", "@", "\x02", "\x03"} & set(plain_words(markup)), (name, markup)


def _reasons(name, language):
    lesson = handout(name, language=language, formats=("pdf",)).lesson
    return {e.number: " ".join(w for p in reasons(lesson, e) for _, w in p.words) for e in lesson.sheet.equations}


def test_every_equation_says_why_and_nothing_twice():
    told = _reasons("shaper-scheme-2", "en")
    assert "$A_{4}$ turns about the fixed pivot $O_{4}$ with link 4" in told[2]
    assert "$A_{4}$ and $A_{3}$ coincide at this moment; link 3 slides on link 4" in told[2]
    assert "$C$ moves with link 6 along the fixed guide" in told[3]
    assert "$C$ and $B$ are points of the rigid link 5" in told[3]
    assert 1 == sum("coincide" in told[n] for n in (1, 2, 3))


def test_the_sense_of_a_coriolis_term_follows_from_the_two_arrows():
    said = _reasons("shaper-scheme-2", "zh")[5]
    assert "$v_{A4A3}$ 指向 76.9°，构件 4 顺时针转动，故指向 −13.1°" in said
