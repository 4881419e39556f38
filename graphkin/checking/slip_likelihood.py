"""The likelihood of each known slip for a stated value: its frequency times the likelihood of the stated digits, as a
number computed (to its last digit) or drawn (with the predicted deviation); the stated values with their verdicts; and
errors in copying a number: digits swapped, misread, missed."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphkin.scene.symbol import Printed, Symbol, Value, stated
from graphkin.scene.tables import Units
from graphkin.words import Phrase, joined

Reals = NDArray[np.float64]
Verdict = Literal["right", "within drafting accuracy", "right from own values", "wrong", "not judged"]

CHANCE = 0.15  # a wrong value lies anywhere, within its own size
BAD = 3.0  # bounds of drafting: so far off a drawn value may lie that still shows what it was meant for
CLUMSY = 0.08  # part of it, for a drawing that is worse than it should be
NEAT = 0.01  # part of it within which most drawings lie
SURE = 6.0  # so much commoner must a slip be than chance, where only its neighbourhood fits
CLEARLY = 3.0 * (1 - 1e-9)  # so much likelier must a named slip be than chance, and than every other
MOST_EQUAL = 3  # slips that fit equally; more of them explain nothing
NEVER = 1e-4  # so near a value was meant right, whatever else lies there
COMPUTED = 1e-5  # relative error of values worked out with rounded ones
TAILS = 8.0  # deviations beyond which nothing is drawn


def comparable(printed: Printed, value: Value, line: complex | None) -> Value:
    """A value as it would be stated in the form of the printed one."""
    if not printed.symbol.is_vector:
        return float(value.real)
    if isinstance(printed.value, complex):
        return complex(value)
    if printed.value >= 0 and not (printed.signed and line is not None):
        return abs(value)
    # a signed number for a vector has a sense: along its line, if it has one
    signed = (complex(value) * complex(line).conjugate()).real if line is not None else -abs(value)
    return signed if isinstance(value, complex) else float(value)


@dataclass(frozen=True)
class Suspect:
    """An explanation: the value that it would give (SI), and its share among wrong values (rough, from experience).

    ``drawn`` tells whether it may have the errors of a drawing, ``copied`` whether the right value was copied wrong,
    ``of_components`` whether it is a slip in two components, which no size shows; ``follows_from`` are earlier wrong
    values of the same person from which it follows.
    """

    phrase: Phrase
    value: Value
    share: float
    drawn: bool = True
    copied: bool = False
    of_components: bool = False
    follows_from: tuple[Symbol, ...] = ()


@dataclass(frozen=True)
class Suspects:
    """Explanations in arrays, so that a value is compared with all of them at once; an entry for each."""

    all: tuple[Suspect, ...]

    @cached_property
    def values(self) -> NDArray[np.complex128]:
        return np.array([complex(s.value) for s in self.all], dtype=complex)

    @cached_property
    def directed(self) -> NDArray[np.bool_]:
        """Whether a value is a vector, not a size."""
        return np.array([isinstance(s.value, complex) for s in self.all], dtype=bool)

    @cached_property
    def shares(self) -> Reals:
        return np.array([s.share for s in self.all])

    @cached_property
    def drawn(self) -> NDArray[np.bool_]:
        return np.array([s.drawn for s in self.all], dtype=bool)

    def comparable(self, printed: Printed, line: complex | None) -> NDArray[np.float64] | NDArray[np.complex128]:
        """The values as they would be stated in the form of the printed value (see `comparable`)."""
        values = self.values
        if not printed.symbol.is_vector:
            return values.real
        if isinstance(printed.value, complex):
            return values
        values = np.where([s.of_components for s in self.all], np.nan, values)
        if printed.value >= 0 and not (printed.signed and line is not None):
            return np.abs(values)
        signed = (values * line.conjugate()).real if line is not None else -np.abs(values)
        return np.where(self.directed, signed, values.real)


@dataclass(frozen=True)
class Judged:
    """A stated value with its verdict.

    ``exact`` is the value for comparison: signed where it has a sense, a complex number against two components, else
    the size of the vector (SI).  ``bound`` is the error of a pencil drawing (0 where it cannot be predicted, infinite
    where a drawing has no bound: then a value that is not right is "not judged", unless a slip explains it to the
    digit), ``line`` the positive sense of a vector that has one.  ``follows_from`` are earlier wrong values of the same
    person from which it follows.  ``apart`` is how far it lies from the value of its slip, over that value, where it
    was drawn badly besides.  ``gap`` is, for a wrong angle or travel, the vector loop that gives it, and the
    loop's gap with all stated values in it (m).
    """

    printed: Printed
    exact: Value
    verdict: Verdict = "right"
    bound: float = 0.0
    line: complex | None = None
    looks_like: Phrase | None = None
    follows_from: tuple[Symbol, ...] = ()
    apart: float | None = None
    gap: tuple[str, float] | None = None

    @property
    def off(self) -> Value:
        """The stated value less the exact one; of an angle without whole turns."""
        return self.printed.symbol.difference(self.printed.value, self.exact)

    @property
    def deviation(self) -> float | None:
        """The relative deviation, None where the exact value is zero."""
        if self.exact == 0:
            return None
        return abs(self.off) / abs(self.exact) if isinstance(self.exact, complex) else self.off.real / self.exact

    def by_errors(self) -> float:
        """The probability density of the stated value as the right value with errors of drawing alone."""
        return float(likelihood(self.printed, abs(self.off), self.bound / 3, abs(self.exact)))

    def weighed(self, suspects: Suspects) -> Iterator[tuple[Suspect, float]]:
        """The explanations that fit, each with its weight: share times likelihood (per unit of the value)."""
        values = suspects.comparable(self.printed, self.line)
        size = np.abs(values)
        spread = np.where(suspects.drawn, self._relative * size, 0.0)
        weights = suspects.shares * likelihood(self.printed, np.abs(self.printed.value - values), spread, size)
        weights[self._changes_nothing(values)] = 0.0
        if not self.printed.value:  # nobody writes 0 for what is small
            weights[size > NEVER * abs(self.exact)] = 0.0
        for k in np.flatnonzero(weights > 0.0).tolist():
            yield suspects.all[k], float(weights[k])

    def copied(self) -> Iterator[tuple[Suspect, float]]:
        """The likeliest slip of the pen from the right value, as in `weighed`."""
        spread = self.bound / 3 if math.isfinite(self.bound) else 0.0
        reach = TAILS * spread + self.printed.step + COMPUTED * abs(self.exact)
        if isinstance(self.exact, complex):
            return
        best = 0.0, "", 0.0
        for text, share, other in transcription_errors(self.printed, self.exact, reach):
            fits = likelihood(self.printed, abs(other - self.exact), spread, abs(self.exact))
            best = max(best, (share * float(fits), text, share), key=lambda error: error[0])
        weight, text, share = best
        if weight:
            yield Suspect(Phrase("slip pen", name=text), self.exact, share, copied=True), weight

    def drawn_badly(self, suspects: Suspects) -> Suspect | None:
        """A slip in a drawing of larger errors: of slips much more probable than chance the clearly likeliest."""
        if not self.printed.value or not suspects.all:
            return None
        values = suspects.comparable(self.printed, self.line)
        size = np.abs(values)
        bound = self.bound / abs(self.exact) if self.exact else 0.0
        reach = max(CLUMSY, min(BAD * bound, 2 * CLUMSY)) * size
        deviation = np.abs(self.printed.value - values)
        within = np.minimum(reach, np.maximum(deviation, NEAT * size))
        by_chance = CHANCE * 2 * within / max(abs(self.printed.value), abs(self.exact))
        near = suspects.drawn & (deviation <= reach) & (0.5 * self.printed.step <= reach)
        near &= (suspects.shares > SURE * by_chance) & ~self._changes_nothing(values)
        near &= deviation < abs(self.off)  # else it is the right value that was drawn badly
        if not near.any():
            return None
        least = np.maximum(np.maximum(deviation, reach / 3), self.printed.step / 2)
        weights = np.where(near, suspects.shares / least, 0.0)
        best = suspects.all[int(np.argmax(weights))]
        equal = np.flatnonzero(CLEARLY * weights > weights.max())
        return best if all(suspects.all[k].phrase == best.phrase for k in equal) else None

    def shows(self, suspect: Suspect) -> bool:
        """Whether the stated value is that of an explanation to the digit."""
        value = comparable(self.printed, suspect.value, self.line)
        return suspect.copied or abs(self.printed.value - value) <= self.printed.rounding + COMPUTED * abs(value)

    @property
    def _relative(self) -> float:
        """The deviation of a drawing over the value."""
        return self.bound / 3 / abs(self.exact) if self.exact and math.isfinite(self.bound) else 0.0

    def _changes_nothing(self, values: NDArray[np.float64] | NDArray[np.complex128]) -> NDArray[np.bool_]:
        """The slips that give the right value in the form of the written one, shape (suspects,), bool."""
        return np.asarray(np.abs(values - self.exact) <= NEVER * abs(self.exact))


def likelihood(printed: Printed, deviation: float | Reals, spread: float | Reals, size: float | Reals) -> Reals:
    """Probability density of a stated value at a distance ``off`` from the value of each explanation: half of the
    values computed, half drawn with a deviation ``spread`` of a value of this size; 0: not drawn."""
    half = 0.5 * printed.step + COMPUTED * size
    wide = np.hypot(spread, printed.step / math.sqrt(12))
    with np.errstate(under="ignore", divide="ignore", invalid="ignore"):
        bell = 0.5 * np.exp(-0.5 * (deviation / wide) ** 2) / (wide * math.sqrt(math.tau))
        return np.where(deviation <= half, 0.25 / half, 0.0) + np.where(np.greater(spread, 0.0), bell, 0.0)


def clearest(weighed: Iterable[tuple[Suspect, float]], chance: float) -> Suspect | None:
    """The explanation that is clearly likelier than chance; of several that are not clearly less likely what follows
    from own values, else the likeliest with the words of all; None where too many fit."""
    ranked = sorted(weighed, key=lambda suspect: -suspect[1])
    if not ranked or ranked[0][1] <= CLEARLY * chance:
        return None
    equal = [suspect for suspect, weight in ranked if CLEARLY * weight > ranked[0][1]]
    best = next((suspect for suspect in equal if suspect.follows_from), equal[0])
    phrases = dict.fromkeys(suspect.phrase for suspect in equal)
    if best.follows_from or len(phrases) == 1:
        return best
    return replace(best, phrase=joined("one or other", phrases)) if len(phrases) <= MOST_EQUAL else None


_DOUBLE_ZERO = re.compile(r"[+-]?0\d")  # nobody writes so
SWAPPED, MISREAD, TWICE_MISREAD, MISSED = 0.05, 0.05, 0.02, 0.02


def transcription_errors(
    printed: Printed, near: float = 0.0, within: float = math.inf
) -> Iterator[tuple[str, float, float]]:
    """The numbers from which a stated number may have been copied wrong, if they lie ``within`` a distance of ``near``
    (SI): text, share among wrong values, value (SI).

    The share of each kind of error is divided among all the numbers it could come from, so that a short number, a digit
    away from many others, explains nothing.
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
    written = _digits(text)
    for share, count, texts in _kinds(text, places, np.array(digits), worth, goal - abs(float(text)), room):
        for other in dict.fromkeys(texts):
            value = float(other) * unit
            if abs(value - near) <= within and _digits(other) != written and not _DOUBLE_ZERO.match(other):
                yield other, share / count, value


Kind = tuple[float, int, list[str]]


def _kinds(
    text: str, places: Sequence[int], digits: NDArray[np.int_], worth: NDArray[np.float64], goal: float, room: float
) -> Iterator[Kind]:
    """Each kind of error: its share, how many numbers it could come from, and those about ``goal`` off the text.

    Parameters
    ----------
    places, digits, worth : the places of the digits in the text, the digits, and the value of a unit of each
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
    """The significant digits: a power of ten, another slip, leaves them."""
    return "".join(filter(str.isdigit, text)).strip("0")


def _put(text: str, digits: dict[int, str]) -> str:
    return "".join(digits.get(i, c) for i, c in enumerate(text))
