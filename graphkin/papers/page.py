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
from importlib.resources import files

from markupsafe import Markup

from graphkin.drawing.font import face_rules, families
from graphkin.papers.blocks import Block, Document, Heading, Said, said
from graphkin.papers.html import blocks_html, rendered, said_html, used_characters
from graphkin.papers.lesson import Lesson
from graphkin.papers.problem import given, scene_title
from graphkin.papers.screen import Progress, positions_data, tolerances
from graphkin.papers.solution import results_blocks, solution, solution_blocks
from graphkin.words import languages, word

__all__ = ["document_page", "handout_page"]


def document_page(document: Document) -> str:
    """A document as a page without scripts."""
    return _page(document, f"<main>\n{blocks_html(document.blocks, document.languages[0])}\n</main>")


def handout_page(
    lesson: Lesson,
    views: Sequence[Lesson],
    start: int = 0,
    progress: Progress | None = None,
    moving: Mapping[str, object] | None = None,
    worked: Iterable[Block] | None = None,
) -> str:
    """The worked solution as a page to step through.

    Parameters
    ----------
    lesson : the solution on paper, which is what is printed
    views : a lesson for each position of the driver that the screen shows
    start : which of them is the given one
    progress : called with the number of positions done and the number of all
    moving : what the page plays (`graphkin.papers.screen.motion_data`)
    worked : the stages of the solution, where they are there already
    """
    stages = tuple(solution_blocks(lesson, tuple(given(lesson))) if worked is None else worked)
    whole = solution(lesson, stages)
    first = languages(lesson.language)[0]

    paper = lesson.sheet.scene.sheet.paper
    data = {
        **positions_data(views, progress),
        "start": start,
        "moving": dict(moving or {}),
        "room": tolerances(lesson),
        "words": {key: _plain(said(of, lesson.language, *gaps)) for key, of, gaps in SPOKEN},
    }
    keys = said("keys", lesson.language)
    shown = said("positions words" if len(views) > 1 else "position words", lesson.language, len(views))
    hints = zip(keys, shown, said("print hint", lesson.language, paper), strict=True)
    hint = tuple((each, word("between sentences", each).join((a, b, c))) for (each, a), (_, b), (_, c) in hints)
    body = rendered(
        "handout.html",
        title=scene_title(lesson),
        given=Markup(blocks_html(given(lesson), first)),
        paper=Markup(blocks_html((Heading(scene_title(lesson), 2), *stages), first)),
        results=Markup(blocks_html(results_blocks(lesson), first)),
        hint=hint,
        buttons=BUTTONS,
        say=lambda key: Markup(said_html(said(key, lesson.language))),
        plain=lambda key: _plain(said(key, lesson.language)),
    )
    return _page(whole, body, _file("viewer.js"), _json(data))


BUTTONS = (
    ("first", "|◀", "first step"), ("previous", "◀", "previous step"), ("next", "▶", "next step"),
    ("last", "▶|", "last step"), ("equation", "▶▶", "next equation"),
)  # fmt: skip
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
    return rendered(
        "page.html",
        language=word("code in pages", document.languages[0]),
        title=document.title,
        policy=Markup(policy),
        style=Markup(style),
        body=Markup(body),
        script=Markup(script),
        packed=packed,
    )


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
