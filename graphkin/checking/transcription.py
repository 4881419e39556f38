"""How a number may have been copied wrong: digits swapped, misread, missed."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from itertools import combinations, pairwise

from graphkin.scene.printed import Printed, stated
from graphkin.scene.tables import Units

__all__ = ["transcription_errors"]

_DOUBLE_ZERO = re.compile(r"[+-]?0\d")  # nobody writes so
SWAPPED, MISREAD, TWICE_MISREAD, MISSED = 0.05, 0.05, 0.02, 0.02


def transcription_errors(
    printed: Printed, near: float = 0.0, within: float = math.inf
) -> Iterator[tuple[str, float, float]]:
    """What may have stood where a number was copied from, if it lies ``within`` so much of what it is ``near`` (SI):
    text, share among wrong values, value (SI).

    The share of each kind of error is divided among all the numbers it could come from, so that a short number, which
    is a digit away from anything, explains nothing.
    """
    if len(printed.texts) != 1:
        return
    text = printed.texts[0]
    places = [i for i, c in enumerate(text) if c.isdigit()]
    if len(places) < 3 or "e" in text.lower():
        return
    swapped = [_put(text, {i: text[j], j: text[i]}) for i, j in pairwise(places)]
    once = [_put(text, {i: d}) for i in places for d in "0123456789"]
    missed = [text[:i] + d + text[i:] for i in (*places, places[-1] + 1) for d in "0123456789"]
    missed += [text[:i] + text[i + 1 :] for i in places]
    kinds = [(SWAPPED, swapped), (MISREAD, once), (MISSED, missed)]
    if len(places) >= 6:
        digits = "0123456789"
        twice = [_put(text, {i: a, j: b}) for i, j in combinations(places, 2) for a in digits for b in digits]
        kinds.append((TWICE_MISREAD, twice))
    own = _digits(text)
    unit = printed.step / stated(printed.symbol, [text], Units("m")).step
    for share, texts in kinds:
        for other in dict.fromkeys(texts):
            value = float(other) * unit
            if abs(value - near) <= within and _digits(other) != own and not _DOUBLE_ZERO.match(other):
                yield other, share / len(texts), value


def _digits(text: str) -> str:
    """The significant digits: numbers that share them differ by a power of ten, which is another slip."""
    return "".join(filter(str.isdigit, text)).strip("0")


def _put(text: str, digits: dict[int, str]) -> str:
    return "".join(digits.get(i, c) for i, c in enumerate(text))
