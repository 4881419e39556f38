"""A statement in two languages, its formulas and numbers written once: each gap between them has the words of both.

>>> in_both(("greatest velocity: 187.5 mm/s at $φ$ = 205°", "最大速度 187.5 mm/s，$φ$ = 205°"))
('greatest velocity 最大速度: 187.5 mm/s at $φ$ = 205°',)
>>> in_both(("the guide is straight", "导路为直线"))
('the guide is straight', '导路为直线')
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from difflib import SequenceMatcher
from itertools import chain

__all__ = ["all_in_both", "in_both"]

_TOKEN = re.compile(r"\$[^$]*\$|[A-Za-z]+|\d+(?:\.\d+)?|\s+|.")
_LATIN = str.maketrans("；：，（）。", ";:,().")
_MARKS = " ;:,.()；：，。、（）"
_BRACKETS = re.compile(r"([()])")
_TAIL = re.compile(r"[\s:;,=]*$")
_DATA = re.compile(r"=.*\d|\d [A-Za-z]+|\d\.\d{3}")


def all_in_both(lists: Sequence[Sequence[str]]) -> list[str]:
    """Lists of statements, one for each language: each in both languages where the lists match, else one after the
    other."""
    if len({len(one) for one in lists}) > 1:
        return list(chain.from_iterable(lists))
    return list(chain.from_iterable(map(in_both, zip(*lists, strict=True))))


def in_both(said: Sequence[str]) -> tuple[str, ...]:
    """One statement (markup) in each language of a sheet, as lines: one if they share formulas in the same order, or
    are the same; else one for each language."""
    lines = tuple(dict.fromkeys(said))
    if len(lines) != 2:
        return lines
    one, other = (_TOKEN.findall(line) for line in lines)
    pairs = SequenceMatcher(None, [t.translate(_LATIN) for t in one], [t.translate(_LATIN) for t in other], False)
    blocks = [(one[block.a : block.a + block.size], block) for block in pairs.get_matching_blocks()]
    if not any(_tells(tokens) for tokens, _ in blocks):
        return lines
    parts: list[str] = []
    i = k = 0
    for tokens, block in blocks:
        if _tells(tokens) or any(token[0] == "$" for token in tokens) or block.size == 0:
            between = _between(one[i : block.a], other[k : block.b])
            if between is None or _numbers(one[i : block.a]) != _numbers(other[k : block.b]):
                return lines
            parts += [between, *tokens]
            i, k = block.a + block.size, block.b + block.size
    whole = re.sub(" +([;:,])", r"\1", "".join(parts))
    return (re.sub("(?<![,;]) {2,}", " ", whole).strip(),)


def _tells(tokens: Sequence[str]) -> bool:
    """Whether tokens hold a formula, a number with its unit, or one of many figures."""
    return _DATA.search("".join(tokens)) is not None


def _numbers(tokens: Sequence[str]) -> list[str]:
    return sorted(token for token in tokens if re.fullmatch(r"\d+\.\d+", token))


def _between(one: Sequence[str], other: Sequence[str]) -> str | None:
    """A gap in both languages, bracket by bracket; None where their brackets do not match, as one that spans a
    formula."""
    ours, theirs = (_BRACKETS.split("".join(tokens).translate(_LATIN)) for tokens in (one, other))
    if not {"（", "）"} & set("".join(other).strip(_MARKS)):
        return _gap(one, other)
    if ours[1::2] != theirs[1::2]:
        return None
    said = [a if i % 2 else _gap([a], [b]) for i, (a, b) in enumerate(zip(ours, theirs, strict=True))]
    return re.sub(r" +\)", ")", "".join(said))


def _gap(one: Iterable[str], other: Iterable[str]) -> str:
    """What stands between formulas, in both languages, with the marks of the first."""
    text, more = "".join(one), "".join(other).strip(_MARKS)
    if not more or more.translate(_LATIN) == text.strip(_MARKS):
        return text
    head = _TAIL.sub("", text)
    tail = text[len(head) :]
    return f"{head} {more}{tail or ' '}" if head.strip(_MARKS) else f"{text} {more} "
