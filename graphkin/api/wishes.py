"""What callers wish of figures and papers, in words: formats, language, convention, instrument."""

from __future__ import annotations

from collections.abc import Sequence
from typing import get_args

from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.scene.model import Convention
from graphkin.words import BOTH, LANGUAGES

__all__ = ["FORMATS", "INSTRUMENTS", "ON_SHEETS", "known_words"]

FORMATS = ("svg", "pdf", "png")
INSTRUMENTS = ("exact", "cad", "pencil")
CONVENTIONS: tuple[str, ...] = get_args(Convention)
ON_SHEETS = (*LANGUAGES, BOTH)
"""Languages of figures and papers; a table or a report has one."""


def known_words(
    formats: Sequence[str] | None = None,
    language: str | None = None,
    convention: str | None = None,
    instrument: str | None = None,
    *,
    known_formats: Sequence[str] = FORMATS,
    known_languages: Sequence[str] = LANGUAGES,
) -> None:
    """Refuse words that mean nothing, all of them together; None is not asked, or stands for the scene's own.

    Raises
    ------
    CallError : every unknown word, with the nearest right one or all there are; no format at all
    """
    if isinstance(formats, str):
        raise CallError(Problem("format", f'"{formats}" is a text', f'give a list: ["{formats}"]'))
    wishes = [("format", word, known_formats) for word in formats or ()]
    wishes += [
        (where, word, known)
        for where, word, known in (
            ("lang", language, known_languages),
            ("convention", convention, CONVENTIONS),
            ("instrument", instrument, INSTRUMENTS),
        )
        if word is not None
    ]
    wrong = [Problem(where, f'"{w}"', did_you_mean(w, known)) for where, w, known in wishes if w not in known]
    if formats is not None and not formats:
        wrong.append(Problem("format", "none given", f"known here: {', '.join(known_formats)}"))
    if wrong:
        raise CallError(*wrong)
