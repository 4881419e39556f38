"""Refusals in other languages: the clauses of a problem, made in English where it is found, by the table of a language.

A table (``refusals/zh.toml``) has the clauses with their gaps, so a clause is known again by what stands between its
gaps.  Names, keys and numbers stay as they are, and so does a clause that no table has.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

from graphkin.errors import Problem

__all__ = ["clauses", "refused", "refused_as"]

_FOLDER = Path(__file__).parent / "refusals"
_GAP = re.compile(r"\{(\d?)\}")
_DEEPEST = 4
_LONGEST = 2000
"""Gaps within gaps that are looked into, and characters of a clause that is still looked up."""
_SHORT, _NAMING = 14, ("link", "point", "driver", "position", "line", "slide", "variant")
_NAMES = r"([^:; ]+(?:(?:, | and )[^:; ]+)*)"
"""A short clause that begins so ("links {}") names something: no other words stand in its gap."""
_LITTLE, _NAME = 4, r"(\S+(?: (?:mm|cm|m|in|ft))?)"
"""With no more letters than these ("{} and {}") it stands between names and numbers."""
_FEW, _IN_CLAUSE = 12, "(?:(?!; ).)"
"""With no more letters than these ("{} = {} deg") it is of one clause and reaches into no other."""


@cache
def clauses(language: str) -> dict[str, str]:
    """The clauses of refusals by the English ones; none for English, nor for a language without a table of them."""
    import tomllib

    path = _FOLDER / f"{language}.toml"
    return tomllib.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def refused(text: str, language: str) -> str:
    """What is said of a refusal, or the name of what it is about, in a language.

    >>> refused("links 2, 3", "zh"), refused("found -5, a negative length", "zh"), refused("links.2.length", "zh")
    ('构件 2, 3', '读到 -5，长度为负', 'links.2.length')
    """
    known = clauses(language)
    return _said(text, language, _DEEPEST) if known and len(text) <= _LONGEST else text


def refused_as(problem: Problem, language: str) -> str:
    """A problem in a sentence of a language."""
    return str(problem) if language == "en" else problem.text(lambda text: refused(text, language), "：", "；")


def _said(text: str, language: str, depth: int) -> str:
    known = clauses(language)
    if text in known:
        return known[text]
    for pattern, said, quoted in _patterns(language):
        found = pattern.fullmatch(text) if depth else None
        if found:
            gaps = [
                one if one is None or as_written else _said(one, language, depth - 1)
                for one, as_written in zip(found.groups(), quoted, strict=True)
            ]
            return _filled(said, gaps)
    for between, mark in (("; ", "；"), (": ", "：")):
        first, there, rest = text.partition(between)
        one = _said(first, language, depth - 1) if there and depth else first
        if there and depth and (one != first or between == "; "):  # else somebody's own words
            other = _said(rest, language, depth)
            if (one, other) != (first, rest):
                return f"{one}{mark}{other}"
    return text


def _filled(said: str, gaps: list[str]) -> str:
    following = iter(gaps)
    return _GAP.sub(lambda gap: gaps[int(gap[1])] if gap[1] else next(following), said)


@cache
def _patterns(language: str) -> tuple[tuple[re.Pattern[str], str, tuple[bool, ...]], ...]:
    """Clauses with gaps, those first that say most themselves; and which of the gaps stand in quotation marks."""
    with_gaps = [(english, said) for english, said in clauses(language).items() if "{}" in english]
    with_gaps.sort(key=lambda pair: -len(pair[0].replace("{}", "")))
    made = []
    for english, said in with_gaps:
        pieces = english.split("{}")
        own = len("".join(pieces).strip())
        little, sign = own <= _LITTLE, _IN_CLAUSE if own <= _FEW and "; " not in english else "."
        naming = len(english) <= _SHORT and english.startswith(_NAMING)
        gap, last = (_NAME, _NAME) if little else (_NAMES, _NAMES) if naming else (f"({sign}+?)", f"({sign}+)")
        pattern = gap.join(map(re.escape, pieces[:-1])) + last + re.escape(pieces[-1])
        made.append((re.compile(pattern, re.DOTALL), said, tuple(p.endswith(('"', "'", "<")) for p in pieces[:-1])))
    return tuple(made)
