"""Whole HTML pages: one file each, which loads nothing and runs no script but its own."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Sequence
from functools import lru_cache
from html import escape
from importlib.resources import files

from graphkin.handout.blocks import Document, Heading, Said, said
from graphkin.handout.clean import clean
from graphkin.handout.html import blocks_html, said_html
from graphkin.handout.lesson import Lesson
from graphkin.handout.problem import given, scene_title
from graphkin.handout.solution import results_blocks, solution, solution_blocks
from graphkin.handout.viewer import Progress, View, positions_data
from graphkin.words import word

__all__ = ["document_page", "handout_page"]


def document_page(document: Document) -> str:
    """A document as a page without scripts."""
    return _page(document, f"<main>\n{blocks_html(document.blocks)}\n</main>")


def handout_page(lesson: Lesson, views: Sequence[View], start: int = 0, progress: Progress | None = None) -> str:
    """The worked solution as a page to step through.

    Parameters
    ----------
    lesson : the solution on paper, which is what is printed
    views : the positions of the driver that the screen shows
    start : which of them is the given one
    progress : called with the number of positions done and the number of all
    """
    whole = solution(lesson)

    def words(key: str, *args: object) -> str:
        return said_html(said(key, lesson.language, *args))

    paper = lesson.sheet.scene.sheet.paper
    data = {
        **positions_data(views, progress),
        "start": start,
        "words": {"stepOf": _plain(said("step of", lesson.language, "{0}", "{1}"))},
    }
    buttons = "".join(
        f'<button type="button" data-go="{go}"><span aria-hidden="true">{sign}</span> {words(key)}</button>'
        for go, sign, key in (
            ("first", "|◀", "first step"), ("previous", "◀", "previous step"), ("next", "▶", "next step"),
            ("last", "▶|", "last step"), ("equation", "▶▶", "next equation"),
        )
    )  # fmt: skip
    body = f"""<header>
<h1>{said_html(scene_title(lesson))}</h1>
<div class="given">{blocks_html(given(lesson))}</div>
</header>
<main>
<section id="viewer" class="viewer" aria-label="{_attribute(said("step by step", lesson.language))}" hidden>
<div class="controls">
<div class="buttons" role="group" aria-label="{_attribute(said("step slider", lesson.language))}">{buttons}</div>
<label for="step">{words("step slider")}</label>
<input type="range" id="step" min="1" max="1" step="1" value="1"><output id="step-out" for="step"></output>
<label for="place">{words("position slider")}</label>
<input type="range" id="place" min="0" max="0" step="1" value="0"><output id="place-out" for="place"></output>
<div id="live" class="live" role="status" aria-live="polite"></div>
</div>
<p class="hint">{words("keys")} {words("positions words", len(views))} {words("print hint", paper)}</p>
<div class="stage">
<div id="list" class="list" role="region" aria-label="{_attribute(said("steps", lesson.language))}"></div>
<div id="figures" class="figures" role="region" aria-label="{_attribute(said("the figures", lesson.language))}"></div>
</div>
</section>
<article class="paper">
{blocks_html((Heading(scene_title(lesson), 2), *solution_blocks(lesson, tuple(given(lesson)))))}
</article>
<section class="results">
{blocks_html(results_blocks(lesson))}
</section>
</main>
<script type="application/json" id="positions">{_json(data)}</script>"""
    return _page(whole, body, _file("viewer.js"))


def _page(document: Document, body: str, script: str = "") -> str:
    paper = document.paper
    # in millimetres, since CSS has no names for papers larger than A3
    style = _file("page.css") + f"@page {{ size: {paper.width:g}mm {paper.height:g}mm }}\n"
    allowed = f"'{_hash(script)}'" if script else "'none'"
    policy = (
        f"default-src 'none'; style-src '{_hash(style)}'; script-src {allowed}; "
        "img-src data:; base-uri 'none'; form-action 'none'"
    )
    tail = f"\n<script>{script}</script>" if script else ""
    return f"""<!DOCTYPE html>
<html lang="{word("code in pages", document.languages[0])}">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(clean(document.title))}</title>
<style>{style}</style>
</head>
<body>
{body}{tail}
</body>
</html>
"""


@lru_cache(maxsize=4)
def _file(name: str) -> str:
    return files("graphkin.handout").joinpath(name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def _json(data: object) -> str:
    """Data in a script element: no sign in it can end the element."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, sort_keys=True, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _plain(words: Said) -> str:
    return " / ".join(text for _, text in words)


def _attribute(words: Said) -> str:
    return escape(_plain(words))
