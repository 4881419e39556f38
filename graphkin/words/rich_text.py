"""Rich text: a sentence as words and symbols, kept apart from the table of words to the page.

Symbols are written in the notation of `graphkin.drawing.text`.  Words of a table hold theirs between dollar signs, or
as a rate with its index (``ω_{2}``); those of the gaps are what ``show`` gives as `Markup`.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from graphkin.words import Wording, parts

__all__ = ["Markup", "RichText", "as_markup", "as_plain", "rich_text"]

_RATE = re.compile(r"([ωα]_\{[^{}]*(?:\}|$))")  # in the words of a table; open where its index is a gap


class Markup(str):
    """A symbol, or several side by side."""


RichText = tuple[str, ...]
"""Words, and symbols as `Markup`, in turn."""


def _as_it_is(gap: object) -> str:
    return gap if isinstance(gap, str) else str(gap)


def rich_text(said: Wording, language: str, show: Callable[[object], str] = _as_it_is) -> RichText:
    """A sentence in words and symbols; symbols side by side are one.

    Parameters
    ----------
    show : writes what stands in a gap, a symbol as `Markup`

    >>> from graphkin.words import Phrase
    >>> rich_text(Phrase("design trial", ("2",)), "en")[:2]
    ('two trial cranks: turn ', 'B_{2}')
    >>> rich_text(Phrase("by rate seen", (Markup("v_{C}"), Markup("B"), "3")), "en")
    ('from ', 'B', ' lay off what ', 'ω_{3}', ' gives: from the pole to there ', 'v_{C}')
    """
    found: list[str] = []

    def add(is_symbol: bool, text: str) -> None:
        if found and isinstance(found[-1], Markup) == is_symbol:
            text = found.pop() + text
        found.append(Markup(text) if is_symbol else text)

    inside = index_open = False  # between dollar signs; at a rate of the table that waits for its index
    for part in parts(said, language, show):
        if isinstance(part, Markup):
            add(True, part)
            continue
        rest: str = part
        if index_open:
            index, closed, rest = rest.partition("}")
            add(True, index + closed)
            index_open = not closed
        for i, text in enumerate(rest.replace("$$", "\0").split("$")):
            inside ^= i > 0
            for k, piece in enumerate([text] if inside else _RATE.split(text)):
                if piece:
                    add(inside or k % 2 == 1, piece.replace("\0", "$$"))
                    index_open = index_open or (k % 2 == 1 and not piece.endswith("}"))
    return tuple(found)


def as_markup(text: RichText) -> str:
    """With symbols between dollar signs, as figures and papers set it."""
    return "".join(f"${part}$" if isinstance(part, Markup) else part for part in text)


def as_plain(text: RichText, index: str = "") -> str:
    """For a terminal, and for who does not see: ``v_B2`` or ``vB2``, as ``index`` stands before an index."""
    plain = (p.replace("_{", index).replace("{", "").replace("}", "") if isinstance(p, Markup) else p for p in text)
    return "".join(plain).replace("$$", "$")
