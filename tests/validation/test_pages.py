"""Every value on the pages of textbook problems: as graphkin says it, and what it makes of the printed one."""

from __future__ import annotations

import math
from functools import cache

import pytest

import graphkin
from graphkin.scene import library, mechanism_of

from .pages import PAGES, PROBLEMS, UNITS, Page, Value, answer

VALUES = [value for page in PAGES for value in page.values]
PRINTED = [value for value in VALUES if value.printed]
READINGS = [value for value in VALUES if value.asked.startswith("check ")]
DRAFTING = 0.012
"""What is left of a hand drawing's accuracy where graphkin has no prediction of it, relative."""


@pytest.mark.quick
@pytest.mark.parametrize("value", VALUES, ids=str)
def test_value(value: Value) -> None:
    turn = 2 * math.pi if value.unit == "deg" else math.inf
    assert abs(math.remainder(answer(value) - value.si, turn)) <= value.room


@cache
def verdicts(scene: str, at: float | None) -> dict[str, str]:
    """What graphkin says of all printed readings of a position."""
    metres = mechanism_of(scene).units.metres
    stated = {}
    for v in READINGS:
        if v.printed and (v.scene, v.at) == (scene, at):
            unit = 1.0 if v.unit.startswith("rad") else UNITS[v.unit] / metres
            stated[v.asked.removeprefix("check ")] = f"{float(v.printed) * unit:g}" if unit != 1.0 else v.printed
    judged = graphkin.audit(scene, answers={"the page": stated}, at=at).data["values"]
    return {row["symbol"]: row["verdict"] for row in judged}


def by_digits(value: Value) -> str:
    """Right to the digits printed, or by how far it is off; what has all digits of the exact one was not drawn."""
    digits, all_digits = (len(text.partition(".")[2]) for text in (value.printed, value.exact))
    off, last = abs(float(value.printed) - float(value.exact)), 10**-digits
    drawn = digits < all_digits and off <= DRAFTING * abs(float(value.exact))
    return "right" if off <= last * 1.001 else "within drafting accuracy" if drawn else "wrong"


@pytest.mark.parametrize("value", PRINTED, ids=str)
def test_verdict(value: Value) -> None:
    if value in READINGS:
        assert value.verdict == verdicts(value.scene, value.at)[value.asked.removeprefix("check ")]
    else:
        assert value.verdict == by_digits(value)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.scene)
def test_a_page_has_the_name_of_its_scene_which_comes_along(page: Page) -> None:
    assert (page.path.stem, True) == (page.scene, page.scene in library())


def test_every_page_is_in_the_list_of_problems() -> None:
    listed = (PROBLEMS.parent / "README.md").read_text(encoding="utf-8")
    assert [] == [page.scene for page in PAGES if f"[{page.scene}](problems/{page.path.name})" not in listed]
