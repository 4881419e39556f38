"""A page asks first for what each step finds; a lesson knows its languages, its paper and the pages of its figures."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

import pytest

from graphkin.checking.readings import report_on
from graphkin.construction import draft
from graphkin.papers.blocks import sentences
from graphkin.papers.documents import document
from graphkin.papers.lesson import Lesson
from graphkin.papers.screen import positions_data
from graphkin.scene import mechanism_of
from graphkin.solver import solve

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def engine() -> Lesson:
    """The engine with its forces, on A3."""
    scene = mechanism_of("engine-gas-force")
    scene = scene.asking(sheet=replace(scene.question.sheet, paper="A3"))
    return Lesson(report_on(draft(scene), solve(scene)), {}, "both", "us")


def test_each_step_asks_for_its_last_result_in_the_unit_of_the_scene(engine: Lesson) -> None:
    rows = positions_data([engine], None)["positions"]["steps"]
    asked = {step["find"]["symbol"]: step["find"] for (step,) in rows if "find" in step}
    exact = {str(row.symbol): row.true for row in engine.report.rows}
    assert {"omega_3", "v_B/A", "a_S3", "F_4/3", "M_2"} <= set(asked)
    for name in ("omega_3", "alpha_3", "M_2"):
        assert (abs(exact[name]), math.copysign(1, exact[name])) == (
            pytest.approx(asked[name]["size"], rel=1e-4), asked[name]["sense"])
    vectors = {"v_B/A": 1e3 * exact["v_B/A"], "a_S3": 1e3 * exact["a_S3"], "F_4/3": -exact["F_3/4"]}
    for name, vector in vectors.items():
        assert abs(vector) == pytest.approx(asked[name]["size"], rel=1e-4)
        assert math.degrees(cmath.phase(vector)) == pytest.approx(asked[name]["angle"], abs=0.06)
    assert "velocity of B relative to A" in asked["v_B/A"]["name"]


def test_a_paper_has_the_languages_the_size_and_the_first_title_of_its_lesson(engine: Lesson) -> None:
    made = document(engine, "answer key", ())
    assert ("en", ("en", "zh")) == (engine.first, tuple(made.languages))
    assert made.title.endswith(": Answer key")
    assert made.paper == engine.paper
    assert made.paper.body.width > 250.0
    assert ["answer key", "参考答案"] == [str(text).lower() for _, text in engine.said("answer key")]


def test_the_page_of_a_figure_is_as_wide_as_asked(engine: Lesson) -> None:
    page = engine.page("forces", 96.0)
    assert (96.0, "forces", "both", engine.letters) == (page.width, page.name, page.language, page.letters)


def test_sentences_follow_each_other_in_each_language() -> None:
    joined = sentences((("en", "One."), ("zh", "一。")), (("en", "Two."), ("zh", "二。")))
    assert [("en", "One. Two."), ("zh", "一。二。")] == [(language, str(text)) for language, text in joined]
