"""Whole HTML pages, one file each, which load nothing and run no script but their own: a document, or the worked
solution to step through, every position of the driver drawn in the same frames, every part with its step.
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
import zlib
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from html import escape
from importlib.resources import files

from graphkin.drawing.embedded import face_rules, families
from graphkin.papers.blocks import Block, Document, Heading, Said, clean, said
from graphkin.papers.html import blocks_html, said_html, used_characters
from graphkin.papers.lesson import Lesson, tolerances
from graphkin.papers.problem import given, scene_title
from graphkin.papers.screen_positions import Progress, View, positions_data
from graphkin.papers.solution import results_blocks, solution, solution_blocks
from graphkin.words import languages, word

__all__ = ["document_page", "handout_page"]


def document_page(document: Document) -> str:
    """A document as a page without scripts."""
    return _page(document, f"<main>\n{blocks_html(document.blocks, document.languages[0])}\n</main>")


def handout_page(
    lesson: Lesson,
    views: Sequence[View],
    start: int = 0,
    progress: Progress | None = None,
    moving: Mapping[str, object] | None = None,
    worked: Iterable[Block] | None = None,
) -> str:
    """The worked solution as a page to step through.

    Parameters
    ----------
    lesson : the solution on paper, which is what is printed
    views : the positions of the driver that the screen shows
    start : which of them is the given one
    progress : called with the number of positions done and the number of all
    moving : what the page plays (`graphkin.papers.moving`)
    worked : the stages of the solution, where they are there already
    """
    stages = tuple(solution_blocks(lesson, tuple(given(lesson))) if worked is None else worked)
    whole = solution(lesson, stages)
    first = languages(lesson.language)[0]

    def words(key: str, *args: object) -> str:
        return said_html(said(key, lesson.language, *args))

    paper = lesson.sheet.scene.sheet.paper
    data = {
        **positions_data(views, progress),
        "start": start,
        "moving": dict(moving or {}),
        "room": tolerances(lesson),
        "words": {key: _plain(said(of, lesson.language, *gaps)) for key, of, gaps in SPOKEN},
    }
    buttons = "".join(
        f'<button type="button" data-go="{go}"><span aria-hidden="true">{sign}</span> {words(key)}</button>'
        for go, sign, key in (
            ("first", "|◀", "first step"), ("previous", "◀", "previous step"), ("next", "▶", "next step"),
            ("last", "▶|", "last step"), ("equation", "▶▶", "next equation"),
        )
    )  # fmt: skip
    names = _attribute(said("the figures", lesson.language))
    keys = said("keys", lesson.language)
    hints = zip(keys, said("positions words", lesson.language, len(views)), said("print hint", lesson.language, paper),
                strict=True)  # fmt: skip
    hint = tuple((each, word("between sentences", each).join((a, b, c))) for (each, a), (_, b), (_, c) in hints)
    body = f"""<header>
<h1>{said_html(scene_title(lesson))}</h1>
<div class="given" id="given">{blocks_html(given(lesson), first)}</div>
</header>
<main>
<section id="viewer" class="viewer" aria-labelledby="steps-title" hidden>
<h2 id="steps-title">{words("step by step")}</h2>
<div class="controls">
<div class="buttons" role="group" aria-label="{_attribute(said("step slider", lesson.language))}">{buttons}
<button type="button" id="play" aria-pressed="false" hidden>{words("play")}</button>
<label class="choice"><input type="checkbox" id="try"> {words("try first")}</label></div>
<label for="step">{words("step slider")}</label>
<input type="range" id="step" min="1" max="1" step="1" value="1"><output id="step-out" for="step"></output>
<label for="place">{words("position slider")}</label>
<input type="range" id="place" min="0" max="0" step="1" value="0"><output id="place-out" for="place"></output>
<div id="live" class="live" role="status" aria-live="polite"></div>
<form id="trial" class="trial" hidden>
<label>{words("size")} <input id="trial-size" inputmode="decimal" autocomplete="off"></label>
<output id="trial-unit"></output>
<label>{words("trial way")} <input id="trial-way" autocomplete="off"></label>
<button type="submit">{words("try it")}</button> <button type="button" id="trial-hint">{words("hint")}</button>
<button type="button" id="trial-show">{words("show step")}</button>
<output id="trial-said" aria-live="polite"></output>
</form>
</div>
<p class="hint">{said_html(hint)}</p>
<div class="stage">
<div id="list" class="list" role="region" aria-label="{_attribute(said("steps", lesson.language))}"></div>
<div class="pinned"><div id="tabs" class="tabs" role="group" aria-label="{names}"></div>
<div id="figures" class="figures" role="region" aria-label="{names}"></div></div>
</div>
<div id="motion" class="motion" role="region" aria-labelledby="motion-title" hidden>
<h3 id="motion-title">{words("motion")}</h3>
<p class="hint">{words("motion words")}</p>
<div class="choices"><label class="choice"><input type="checkbox" id="traces" checked> {words("traces")}</label>
<label class="choice"><input type="checkbox" id="poles" checked> {words("instant centres shown")}</label>
<label class="choice"><input type="checkbox" id="centre-paths"> {words("centre paths shown")}</label></div>
<label for="turn">{words("position slider")}</label>
<input type="range" id="turn" min="0" max="0" step="1" value="0"><output id="turn-out" for="turn"></output>
<div id="moving" class="moving no-centre-paths"></div>
</div>
</section>
<article class="paper" id="paper">
{blocks_html((Heading(scene_title(lesson), 2), *stages), first)}
</article>
<section class="results" id="results">
{blocks_html(results_blocks(lesson), first)}
</section>
</main>
"""
    return _page(whole, body, _file("viewer.js"), _json(data))


SPOKEN = (
    ("stepOf", "step of", ("{0}", "{1}")), ("right", "trial right", ()), ("off", "trial off", ()),
    ("turned", "trial turned", ()), ("enter", "trial enter", ()), ("hint1", "hint equation", ("{0}",)),
    ("hint2", "hint direction", ("{0}",)), ("hint3", "hint size", ("{0}", "{1}")), ("play", "play", ()),
    ("pause", "pause", ()), ("ccw", "counter-clockwise", ()), ("cw", "clockwise", ()), ("hidden", "step hidden", ()),
    ("velocity", "velocity polygon", ()), ("acceleration", "acceleration polygon", ()), ("mechanism", "mechanism", ()),
    ("figure", "figure numbered", ("{0}", "")),
)  # fmt: skip


def _page(document: Document, body: str, script: str = "", data: str = "") -> str:
    paper = document.paper
    # in millimetres, since CSS has no names for papers larger than A3
    name, rules = face_rules(used_characters(body + data))
    style = rules + _file("page.css").replace("FAMILIES", families(name).replace("'", '"'))
    style += f"@page {{ size: {paper.width:g}mm {paper.height:g}mm }}\n"
    allowed = f"'{_hash(script)}'" if script else "'none'"
    policy = (
        f"default-src 'none'; style-src '{_hash(style)}'; script-src {allowed}; "
        "font-src data:; img-src data:; base-uri 'none'; form-action 'none'"
    )
    # the positions are much alike: packed they take an eighth of the room
    packed = base64.b64encode(zlib.compress(data.encode(), 9)).decode() if data else ""
    tail = f'\n<script type="text/plain" id="positions">{packed}</script>' if data else ""
    tail += f"\n<script>{script}</script>" if script else ""
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
    return files("graphkin.papers").joinpath(name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


_ESCAPE = re.compile("<(?=!|script)", re.IGNORECASE)


def _json(data: object) -> str:
    """Data in a script element: no sign in it can end the element, nor begin a comment in it."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, sort_keys=True, separators=(",", ":"))
    text = _ESCAPE.sub(r"\\u003c", text.replace("</", "<\\/"))  # not every one: there are many thousands
    return text.replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _plain(words: Said) -> str:
    return " / ".join(text for _, text in words)


def _attribute(words: Said) -> str:
    return escape(_plain(words))
