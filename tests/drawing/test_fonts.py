"""A figure brings its letters along: the same glyphs, widths and bytes on every machine."""

from __future__ import annotations

import io
import re
import sys
import xml.etree.ElementTree as ET
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from fontTools.ttLib import TTFont

import graphkin
from graphkin import draw
from graphkin.drawing import Drawing, Text, font, svg_bytes
from graphkin.drawing.font import glyph, holds, part
from graphkin.drawing.text import rich, runs_width
from graphkin.words import LANGUAGES
from tests.letters import SVG, faces, letters, shown, whole

LIBRARY = Path(graphkin.__file__).parent / "scene" / "library"


@pytest.fixture(scope="module")
def sheet() -> str:
    return draw("shaper-scheme-2", language="both").figures["sheet"].content("svg").decode()


def test_the_letters_of_a_sheet_are_those_that_come_with_it(sheet):
    assert shown(sheet) == {style: {*held} for style, held in letters(faces(sheet)).items()}


def test_every_run_states_the_length_that_its_glyphs_have(sheet):
    fonts = faces(sheet)
    wrong = []
    for span in ET.fromstring(sheet).iter(f"{SVG}tspan"):
        style = "bold" if span.get("font-weight") else "italic" if span.get("font-style") else "regular"
        cmap, advances = fonts[style].getBestCmap(), fonts[style]["hmtx"]
        long = sum(advances[cmap[ord(c)]][0] for c in span.text) / 1000 * float(span.get("font-size"))
        if abs(long - float(span.get("textLength"))) > 0.02:
            wrong.append(span.text)
    assert [] == wrong


@pytest.mark.parametrize(("figure", "language", "most"), [("velocity", "en", 9_600), ("sheet", "zh", 24_500)])
def test_a_figure_brings_few_kilobytes_of_letters(figure, language, most):
    svg = draw("four-bar-coupler-point", language=language).figures[figure].content("svg").decode()
    assert sum(map(len, re.findall(r"base64,([^)]*)", svg))) < most


@pytest.mark.parametrize("style", ["regular", "italic", "bold"])
def test_a_part_of_a_face_has_the_widths_and_outlines_of_the_whole(style):
    cut = letters({style: TTFont(io.BytesIO(part(style, frozenset("()Bv′ω"))))})[style]
    assert set("()Bv′ω") == {*cut}
    of_all = letters({style: whole(style)})[style]
    assert {character: of_all[character] for character in cut} == cut


def test_a_part_of_a_face_bears_the_name_of_the_family_alone():
    names = TTFont(io.BytesIO(part("italic", frozenset("abc"))))["name"].names
    assert ["Graphkin Serif"] == list(map(str, names))


def test_a_part_that_is_packed_again_has_the_same_bytes():
    first = part("italic", frozenset("abc"))
    part.cache_clear()
    assert first == part("italic", frozenset("abc"))


def test_letters_that_were_packed_once_are_kept():
    part("italic", frozenset("abc"))
    packed = part.cache_info().misses
    part("italic", frozenset("cba"))
    assert packed == part.cache_info().misses


def test_the_name_of_the_faces_does_not_tell_how_they_are_packed(monkeypatch):
    name, _ = font.face_rules({"regular": "ab"})
    monkeypatch.setattr(font, "part", lambda *_: b"packed by another version")
    assert name == font.face_rules({"regular": "ba"})[0]
    assert name != font.face_rules({"regular": "abc"})[0]


def test_the_family_has_all_chinese_of_the_tables_of_words_and_of_the_scenes():
    from graphkin.words import _table

    texts = [text for language in LANGUAGES for text in _table(language).values()]
    texts += [path.read_text(encoding="utf-8") for path in sorted(LIBRARY.rglob("*.toml"))]
    lacking = {c for text in texts for c in text if not holds(c)}
    assert set() == lacking, "run figures/make_fonts.py"


def test_a_sign_that_no_face_has_is_left_to_the_reader():
    svg = svg_bytes(Drawing(20.0, 10.0, (Text(5 + 5j, rich("A \U0001f600")),))).decode()
    assert "\U0001f600" in svg
    assert {ord("A"), ord(" ")} == set(faces(svg)["regular"].getBestCmap())


def test_a_text_is_as_wide_as_its_glyphs():
    letters = "Velocity polygon"
    assert pytest.approx(3.5 * sum(glyph(c).advance for c in letters) / 1000) == runs_width(rich(letters, 3.5))


def test_a_sign_that_only_the_regular_face_has_is_that_sign_in_every_face():
    regular = glyph("丁")
    assert regular is not None
    assert [regular, regular] == [glyph("丁", "italic"), glyph("丁", "bold")]


def test_two_threads_read_a_face_at_once():
    whole, often = [glyph(c) for c in "ABCD"], sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(4) as threads:
            for _ in range(20):
                for style in ("regular", "italic", "bold"):
                    font._face(style)[0].close()
                font._face.cache_clear()
                glyph.cache_clear()
                assert whole == list(threads.map(glyph, "ABCD"))
    finally:
        sys.setswitchinterval(often)
