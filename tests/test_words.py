"""Words in each language: one table for each, complete, and a further language is one more of them."""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from pathlib import Path

import pytest

import graphkin
from graphkin.words import LANGUAGES

TABLES = Path(graphkin.__file__).parent / "words"


def areas(language: str) -> dict[str, dict[str, str]]:
    return tomllib.loads((TABLES / f"{language}.toml").read_text(encoding="utf-8"))


def words(language: str) -> dict[str, str]:
    return {key: text for area in areas(language).values() for key, text in area.items()}


def gaps(text: str) -> set[str]:
    return set(re.findall(r"(?<!\{)\{(\d)\}", text.replace("{{{", "{")))


@pytest.mark.parametrize("language", LANGUAGES[1:])
def test_a_language_has_every_word_that_english_has(language):
    assert {area: list(table) for area, table in areas("en").items()} == {
        area: list(table) for area, table in areas(language).items()
    }


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_key_stands_in_one_area_only(language):
    assert [] == [k for k, n in Counter(key for area in areas(language).values() for key in area).items() if n > 1]


@pytest.mark.parametrize("language", LANGUAGES[1:])
def test_a_sentence_has_the_same_gaps_in_every_language(language):
    english = words("en")
    assert {} == {k: text for k, text in words(language).items() if gaps(text) != gaps(english[k])}


def test_english_is_the_first_language():
    assert "en" == LANGUAGES[0]
