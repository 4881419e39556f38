from __future__ import annotations

import pytest

from graphkin.construction import draft
from graphkin.drawing.conventions import letters_of
from graphkin.papers.lesson import Speaker, plain_words, stages
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
