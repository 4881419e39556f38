"""Blocks as HTML, and documents as whole pages: every word of a scene escaped, figures as SVG in the page, symbols with
their words for screen readers (``v_{B3B2}`` is "velocity of B3 relative to B2")."""

from __future__ import annotations

import base64
import hashlib
import json
import re
import zlib
from collections.abc import Iterable
from functools import cache
from html import escape, unescape
from importlib.resources import files
from typing import TYPE_CHECKING

from markupsafe import Markup

from graphkin.account.spoken import spoken_symbol
from graphkin.drawing.font import Style, face_rules, families
from graphkin.drawing.text import is_italic
from graphkin.drawing.write.svg import svg_element
from graphkin.papers.blocks import Block, Document, Said, clean
from graphkin.words import word
from graphkin.words.symbols import Atom, Words, stretches

if TYPE_CHECKING:
    from jinja2 import Environment

ALIGNED = {"l": "", "r": Markup(' class="right"'), "c": Markup(' class="middle"')}
PIXEL = 25.4 / 96  # mm


def words_html(text: Words, language: str) -> str:
    """Words and symbols, which screen readers read in words of a language."""
    parts = []
    for part in stretches(text):
        if isinstance(part, str):
            parts.append(escape(clean(part)))
        else:
            aloud = escape(clean(spoken_symbol(part, language)))
            read = f' role="math" aria-label="{aloud}"' if aloud else ""
            parts.append(f'<span class="sym"{read}>{_atoms(part)}</span>')
    return "".join(parts)


def _atoms(atoms: tuple[Atom, ...]) -> str:
    parts = []
    for atom in atoms:
        text = escape(clean(atom.text))
        parts.append(f"<i>{text}</i>" if is_italic(atom.text) else text)
        sup = f"<sup>{_atoms(atom.sup)}</sup>" if atom.sup else ""
        sub = f"<sub>{_atoms(atom.sub)}</sub>" if atom.sub else ""
        parts.append(f'<span class="both">{sup}{sub}</span>' if sup and sub else sup + sub)
    return "".join(parts)


def said_html(said: Said, tag: str = "span") -> str:
    """Words in each language, each in an element with its language."""
    return "".join(
        f'<{tag} lang="{word("code in pages", each)}">{words_html(text, each)}</{tag}>' for each, text in said
    )


def blocks_html(blocks: Iterable[Block], language: str) -> str:
    """Blocks in order; parts that are the same in every language are read aloud in one."""
    return rendered("blocks.html", blocks=blocks, language=language, ALIGNED=ALIGNED)


def rendered(name: str, **values: object) -> str:
    """A file by its template in the folder ``templates``; inserted values are escaped, except `markupsafe.Markup`.

    Raises jinja2.UndefinedError where a value is missing.
    """
    return _templates().get_template(name).render(values)


@cache
def _templates() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    loader = PackageLoader("graphkin.papers")
    made = Environment(loader=loader, autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    made.filters |= {
        "base64": lambda data: base64.b64encode(data if isinstance(data, bytes) else data.encode()).decode(),
        "clean": clean,
        "kind": lambda block: type(block).__name__,
        "pixels": lambda mm: f"{mm / PIXEL:.0f}",
        "said": lambda said, tag="span": Markup(said_html(said, tag)),
        "svg": lambda drawing: Markup(svg_element(drawing)),
        "words": lambda text, language: Markup(words_html(text, language)),
    }
    return made


# whole pages


def document_page(document: Document) -> str:
    """A document as a page without scripts."""
    return whole_page(document, f"<main>\n{blocks_html(document.blocks, document.languages[0])}\n</main>")


def whole_page(document: Document, body: str, script: str = "", data: object = None) -> str:
    """A page in one file, which loads nothing and runs no script but its own.

    Parameters
    ----------
    body : its content (HTML)
    script : the name of its script, a file of this room
    data : the script's data, packed in the page
    """
    paper, code = document.paper, _file(script) if script else ""
    json_text = "" if data is None else json.dumps(
        data, ensure_ascii=False, allow_nan=False, sort_keys=True, separators=(",", ":")
    )
    name, rules = face_rules(_used_characters(body + json_text))
    style = rules + _file("page.css").replace("FAMILIES", families(name).replace("'", '"'))
    # in millimetres, since CSS has no names for papers larger than A3
    style += f"@page {{ size: {paper.width:g}mm {paper.height:g}mm }}\n"
    allowed = f"'{_hash(code)}'" if code else "'none'"
    policy = (
        f"default-src 'none'; style-src '{_hash(style)}'; script-src {allowed}; "
        "font-src data:; img-src data:; base-uri 'none'; form-action 'none'"
    )
    return rendered(
        "page.html",
        language=word("code in pages", document.languages[0]),
        title=document.title,
        policy=Markup(policy),
        style=Markup(style),
        body=Markup(body),
        script=Markup(code),
        # the positions are much alike: packed they take an eighth of the room
        packed=base64.b64encode(zlib.compress(json_text.encode(), 9)).decode() if json_text else "",
    )


@cache
def _file(name: str) -> str:
    return files("graphkin.papers").joinpath(name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


_BOLD = re.compile(
    r'<(h[1-6]|th)\b.*?</\1>|<tr class="asked">.*?</tr>|<tspan[^>]*font-weight="bold".*?</tspan>', re.DOTALL
)
_ITALIC = re.compile(r'<(i)>.*?</\1>|<tspan[^>]*font-style="italic".*?</tspan>', re.DOTALL)
_TAG = re.compile("<[^>]*>")
_UNSEEN = re.compile(r"<(style|title|desc)\b.*?</\1>", re.DOTALL)


def _used_characters(body: str) -> dict[Style, set[str]]:
    """The characters of a page in each font face, those of figures in a script included."""
    plain = _UNSEEN.sub("", unescape(body.replace('\\"', '"')))
    faces = {
        style: {c for match in pattern.finditer(plain) for c in _TAG.sub("", match[0])}
        for style, pattern in (("italic", _ITALIC), ("bold", _BOLD))
    }
    seen = set(_TAG.sub("", plain))
    letters = {c for c in seen if c.isalpha() and ord(c) < 0x400}
    return {"regular": seen, "italic": faces["italic"] | letters, "bold": faces["bold"]}
