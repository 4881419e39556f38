"""A figure brings its letters along: the same glyphs, widths and bytes on every machine."""

from __future__ import annotations

import io
import re
import xml.etree.ElementTree as ET
from base64 import b64decode
from pathlib import Path

import pytest
from fontTools.ttLib import TTFont

import graphkin
from graphkin import draw
from graphkin.drawing import Drawing, Text, svg_bytes
from graphkin.drawing.font import FOLDER, glyph, holds, part
from graphkin.drawing.font_widths import runs_width
from graphkin.drawing.text import rich
from graphkin.drawing.woff2 import as_brotli, code_for
from graphkin.words import LANGUAGES

LIBRARY = Path(graphkin.__file__).parent / "scene" / "library"
SVG = "{http://www.w3.org/2000/svg}"


def faces(svg: str) -> dict[str, TTFont]:
    """The embedded faces by their look."""
    rules = re.findall(r"@font-face\{font-family:'[^']*'([^}]*?);src:url\(data:font/woff2;base64,([^)]*)\)", svg)
    return {look.strip(";"): TTFont(io.BytesIO(b64decode(data))) for look, data in rules}


@pytest.fixture(scope="module")
def sheet() -> str:
    return draw("shaper-scheme-2", language="both").figures["sheet"].content("svg").decode()


def test_every_letter_of_a_sheet_is_in_the_face_that_comes_with_it(sheet):
    held = {look: {chr(code) for code in font.getBestCmap()} for look, font in faces(sheet).items()}
    missing = set()
    for span in ET.fromstring(sheet).iter(f"{SVG}tspan"):
        look = "font-weight:bold" if span.get("font-weight") else "font-style:italic" if span.get("font-style") else ""
        missing |= set(span.text or "") - held[look]
    assert set() == missing


def test_every_run_states_the_length_that_its_glyphs_have(sheet):
    fonts = faces(sheet)
    wrong = []
    for span in ET.fromstring(sheet).iter(f"{SVG}tspan"):
        look = "font-weight:bold" if span.get("font-weight") else "font-style:italic" if span.get("font-style") else ""
        cmap, advances = fonts[look].getBestCmap(), fonts[look]["hmtx"]
        long = sum(advances[cmap[ord(c)]][0] for c in span.text) / 1000 * float(span.get("font-size"))
        if abs(long - float(span.get("textLength"))) > 0.02:
            wrong.append(span.text)
    assert [] == wrong


@pytest.mark.parametrize(("figure", "language", "most"), [("velocity", "en", 8_000), ("sheet", "zh", 22_000)])
def test_a_figure_brings_few_kilobytes_of_letters(figure, language, most):
    svg = draw("four-bar-coupler-point", language=language).figures[figure].content("svg").decode()
    assert sum(map(len, re.findall(r"base64,([^)]*)", svg))) < most


@pytest.mark.parametrize("style", ["regular", "italic", "bold"])
def test_a_part_of_a_face_has_the_outlines_of_the_whole(style):
    whole, cut = TTFont(FOLDER / f"{style}.ttf"), TTFont(io.BytesIO(part(style, "()Bv′ω")))
    assert {chr(c) for c in cut.getBestCmap()} == set("()Bv′ω")
    for code, name in cut.getBestCmap().items():
        assert whole["glyf"][whole.getBestCmap()[code]] == cut["glyf"][name]


def test_a_part_that_is_packed_again_has_the_same_bytes():
    first = part("italic", "abc")
    part.cache_clear()
    assert first == part("italic", "abc")


@pytest.mark.parametrize("size", [1, 6, 129, 130, 2113, 2114, 22_594, 70_000])
def test_a_reader_of_brotli_gets_back_what_was_packed(size):
    import brotli

    few, many = code_for(b"glyphs of few kinds" * 9), code_for(bytes(range(256)))
    data = bytes(k * k % 251 for k in range(size))
    assert data + data == brotli.decompress(as_brotli([(data, few), (b"", few), (data, many)]))


def test_the_family_has_all_chinese_of_the_tables_of_words_and_of_the_scenes():
    from graphkin.words import _table

    texts = [text for language in LANGUAGES for text in _table(language).values()]
    texts += [path.read_text(encoding="utf-8") for path in sorted(LIBRARY.rglob("*.toml"))]
    lacking = {c for text in texts for c in text if not holds(c)}
    assert set() == lacking, "run figures/make_fonts.py"


def test_a_sign_that_no_face_has_is_left_to_the_reader():
    svg = svg_bytes(Drawing(20.0, 10.0, (Text(5 + 5j, rich("A \U0001f600")),))).decode()
    assert "\U0001f600" in svg
    assert {ord("A"), ord(" ")} == set(faces(svg)[""].getBestCmap())


def test_a_text_is_as_wide_as_its_glyphs():
    letters = "Velocity polygon"
    assert pytest.approx(3.5 * sum(glyph(c).advance for c in letters) / 1000) == runs_width(rich(letters, 3.5))
