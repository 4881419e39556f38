"""How a number may have been copied wrong: digits swapped, misread, missed."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

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
    digits = [int(text[i]) for i in places]
    point = sum(i < text.find(".") for i in places) if "." in text else len(places)
    worth = 10.0 ** np.arange(point - 1, point - 1 - len(places), -1.0)
    sense = -1.0 if text.startswith("-") else 1.0
    unit = printed.step / stated(printed.symbol, [text], Units("m")).step
    goal, room = sense * near / unit, within / unit + 1e-9 * abs(float(text))
    own = _digits(text)
    for share, count, texts in _kinds(text, places, np.array(digits), worth, goal - abs(float(text)), room):
        for other in dict.fromkeys(texts):
            value = float(other) * unit
            if abs(value - near) <= within and _digits(other) != own and not _DOUBLE_ZERO.match(other):
                yield other, share / count, value


Kind = tuple[float, int, list[str]]


def _kinds(
    text: str, places: Sequence[int], digits: NDArray[np.int_], worth: NDArray[np.float64], goal: float, room: float
) -> Iterator[Kind]:  # fmt: skip
    """Each kind of error: its share, how many numbers it could come from, and those that differ from the text by about
    as much as ``goal``.

    Parameters
    ----------
    places, digits, worth : where the digits stand, what they are, and what one of each is worth
    """
    n = len(places)
    exchanged = (digits[1:] - digits[:-1]) * (worth[:-1] - worth[1:])
    near = np.flatnonzero(np.abs(exchanged - goal) <= room).tolist()
    pairs = [(places[k], places[k + 1]) for k in near]
    yield SWAPPED, n - 1, [_put(text, {i: text[j], j: text[i]}) for i, j in pairs]
    other = (np.arange(10)[None, :] - digits[:, None]) * worth[:, None]  # shape (digits, digits it may have been)
    once = np.argwhere(np.abs(other - goal) <= room).tolist()
    yield MISREAD, 10 * n, [_put(text, {places[k]: str(d)}) for k, d in once]
    missed = [text[:i] + d + text[i:] for i in (*places, places[-1] + 1) for d in "0123456789"]
    missed += [text[:i] + text[i + 1 :] for i in places]
    yield MISSED, len(missed), missed
    if n >= 6:
        twice = []
        for i, j in combinations(range(n), 2):
            both = np.argwhere(np.abs(other[i][:, None] + other[j][None, :] - goal) <= room).tolist()
            twice += [_put(text, {places[i]: str(a), places[j]: str(b)}) for a, b in both]
        yield TWICE_MISREAD, 100 * math.comb(n, 2), twice


def _digits(text: str) -> str:
    """The significant digits: numbers that share them differ by a power of ten, which is another slip."""
    return "".join(filter(str.isdigit, text)).strip("0")


def _put(text: str, digits: dict[int, str]) -> str:
    return "".join(digits.get(i, c) for i, c in enumerate(text))
