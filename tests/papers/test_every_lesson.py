"""What is said of a construction holds in every scene and convention; what is said of one is in `test_lesson`."""

from __future__ import annotations

import cmath
import math
import re

import pytest

from graphkin import audit, read
from graphkin.account.account import telling, why
from graphkin.account.notation import notation_of
from graphkin.account.voice import Account
from graphkin.api.classroom.handouts import handout
from graphkin.construction import draft
from graphkin.papers.lesson import stages
from graphkin.scene import library, mechanism_of


def test_stages_hold_every_step_once_in_order():
    for name in library():
        sheet = draft(mechanism_of(name))
        assert [s.number for s in sheet.steps] == [step.number for stage in stages(sheet) for step in stage.steps]


def test_symbols_in_sentences_are_closed_in_every_scene_and_convention():
    for name in library():
        sheet = draft(mechanism_of(name))
        for convention in ("chinese", "us", "british", "russian"):
            speaker = Account(sheet, notation_of(sheet, convention))
            for step in sheet.steps:
                for markup in (
                    speaker.sentence(step.phrase, "en"),
                    speaker.sentence(step.phrase, "zh"),
                    *telling(speaker, step).work,
                ):
                    assert "$" not in str(markup)
                    assert not {"{", "}", "@", "\x02", "\x03"} & set(str(markup)), (name, markup)


@pytest.mark.parametrize("name", ["disc-on-disc", "scotch-yoke", "swinging-block", "triad-slider", "whitworth"])
def test_every_term_that_an_equation_draws_has_a_reason(name):
    lesson = handout(name, language="en", formats=("pdf",)).lesson
    for equation in lesson.sheet.equations:
        said = str(why(lesson.account, equation, "en"))
        terms = {t.symbol for side in equation.sides for t in side if t.direction_known} - {equation.sides[0][0].symbol}
        named = [str(lesson.letters.coincident(s.of)) for s in terms if s.of and s.kind in ("v", "an", "ar", "ak")]
        assert [] == [name for name in named if name not in said]


def test_a_point_laid_off_by_rates_is_where_its_printed_lengths_and_angles_lead():
    lesson = handout("contour-four-bars", formats=("html",), positions=1).lesson
    steps = [step for step in lesson.sheet.steps if step.reason == "rates" and not step.held]
    assert ["velocity", "acceleration"] == [step.diagram for step in steps]
    for step in steps:
        told = re.findall(r"= ([\d.]+) mm,  (−?[\d.]+)°", " ".join(map(str, telling(lesson.account, step).work)))
        laid = sum(cmath.rect(float(mm), math.radians(float(way.replace("−", "-")))) for mm, way in told)
        drawn = {s.of.point: v.span for s, v in lesson.sheet.vectors[step.diagram].items() if s.of and s.to is None}
        assert abs(laid - (drawn["C"] - drawn["B"])) < 0.1


@pytest.mark.parametrize("name", ["cam-offset-roller", "cam-flat-face", "disc-on-disc", "wheel-on-rail"])
def test_a_problem_asks_for_quantities_that_an_audit_reads(name):
    # of points and bars that stand in for a cam or a contact no answer can be stated
    scene = {key: table for key, table in read(name).to_dict().items() if key not in ("find", "printed")}
    questions = handout(scene, language="en", formats=("html",), positions=1).lesson.questions
    assert questions
    assert audit(scene | {"printed": {str(symbol): 1.0 for symbol in questions}})


def test_the_image_of_a_link_that_does_not_turn_is_one_point():
    # of a bar whose ends fall together no similar triangle can be drawn
    cranks = {
        "frame": {"points": {"A": [0, 0], "D": [80, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 50}, "3": {"points": ["D", "C"], "length": 50},
            "2": {"points": ["B", "C"], "length": 80, "at": {"M": [40, 30]}},
        },
        "driver": {"link": "1", "angle": 70, "omega": 4, "alpha": 3}, "sketch": {"C": [97, 47]},
    }
    page = handout(cranks, language="en", formats=("html",), positions=1).files["handout.html"].decode()
    said = re.sub("<[^>]*>", "", page)
    assert "Image of link 2: b and c fall together, so the image is one point: m lies there too" in said
    assert "triangle bcm similar" not in said
