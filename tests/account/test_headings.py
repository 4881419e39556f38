"""Figures in sentences, for those who do not see them."""

from __future__ import annotations

import re

import pytest

import graphkin
from graphkin.account.headings import describe, structure_words
from graphkin.api.report_text import report_text
from graphkin.scene import mechanism_of
from tests.scenes import slider_crank

SLIDER_CRANK = slider_crank(30, 80, driver={"link": "1", "angle": 60, "omega": 1e-9})


@pytest.mark.parametrize(
    ("language", "said"), [("en", "The fixed link 0 has the point A."), ("zh", "机架 0 上有点 A。")]
)
def test_a_frame_with_one_point_has_no_points(language: str, said: str) -> None:
    assert said == structure_words(mechanism_of(SLIDER_CRANK), language)[0]


def test_powers_of_ten_are_written_as_such() -> None:
    sheet = graphkin.check(SLIDER_CRANK).sheet
    said = describe(sheet, ("velocity", "acceleration"), "en")
    assert "·10⁻⁸ mm/s" in said
    assert "e-" not in said


def test_arms_of_forces_are_listed_in_chinese_with_its_comma():
    assert re.search(r"图上力臂：\S+ [\d.]+ mm、\S+ [\d.]+ mm、", report_text(graphkin.check("shaper-forces"), "zh"))
