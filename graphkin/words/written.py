"""Numbers as they stand on a sheet: lengths as a ruler gives them, and products and quotients that are true as written.

A length on paper is written to 0.01 mm; a result has as many figures as its data, and is computed from the written
numbers, so that a reader who does the sum gets the same.
"""

from __future__ import annotations

import cmath
import math
import re
from decimal import Context, Decimal
from functools import reduce

MOST = 5  # figures of a computed number
FINER = range(MOST, MOST + 4)  # figures, where those few do not give what they should as they are written
LEAST = 0.05  # mm; what is shorter is read where it is drawn larger
ROUNDED = 1e-12  # mm on a sheet of some hundred: what the sixteenth digit leaves
EXACT = Context(prec=40)
"""Sums with all the digits of numbers as they are written."""
LONGEST = 9  # figures that somebody writes
_RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def on_paper(mm: float) -> str:
    """A length on paper (mm): to 0.01 mm; three figures of one that only its own scale shows; 0 of rounding alone.

    >>> on_paper(107.5778), on_paper(0.0612), on_paper(1e-15), on_paper(3.21e-7)
    ('107.58', '0.06', '0', '3.21e-7')
    """
    if abs(mm) < ROUNDED:
        return "0"
    return f"{mm:.2f}" if abs(mm) >= LEAST else amount(mm, 3)


def figures(*written: str) -> int:
    """The number of figures of a result of these numbers: the least of theirs.

    >>> figures("0.06"), figures("107.58", "3.00")
    (1, 3)
    """
    return min(len(_number(text).as_tuple().digits) for text in written)


def product(*factors: str, carried: int | None = None) -> str:
    """The product of numbers as they are written, exact, or to ``carried`` figures.

    >>> product("5.55", "100"), product("0.06", "200"), product("2", "2.8193", "575.4", carried=4)
    ('555', '12', '3244')
    """
    whole = reduce(EXACT.multiply, map(_number, factors))
    return _plain(_rounded(whole, carried) if carried else whole)


def difference(first: str, second: str) -> str:
    """The distance of two numbers as they are written.

    >>> difference("-10", "-2.8191"), difference("0.5", "0.5")
    ('7.1809', '0')
    """
    return _plain(EXACT.abs(EXACT.subtract(_number(first), _number(second))))


def quotient(over: str, under: str, carried: int) -> str:
    """The quotient of two numbers as they are written, to ``carried`` figures."""
    return _plain(_rounded(EXACT.divide(_number(over), _number(under)), carried))


def to_lay_off(value: float, per: float, mm: float) -> tuple[str, str]:
    """A value at a scale of ``per`` a mm, with figures that make the written quotient true; its length on paper (mm).

    >>> to_lay_off(228.0374, 2.5, 91.21496), to_lay_off(9000.0, 100.0, 90.0)
    (('228.037', '91.21'), ('9000', '90.00'))
    """
    length, scale = on_paper(mm), amount(per, 12)
    tried = (amount(value, carried) for carried in FINER)
    return next((text for text in tried if is_quotient(length, text, scale)), amount(value, MOST)), length


def is_quotient(value: str, over: str, under: str) -> bool:
    """Whether a number is the quotient of two others, all as they are written.

    >>> is_quotient("90.00", "9000", "100"), is_quotient("91.21", "228.04", "2.5")
    (True, False)
    """
    whole = _number(value)
    step = Decimal(1).scaleb(int(whole.as_tuple().exponent))
    off = EXACT.subtract(EXACT.divide(_number(over), _number(under)), whole)
    return EXACT.abs(EXACT.add(off, off)) <= step


def increased(value: str, more: str) -> str:
    """The sum of two numbers as they are written.

    >>> increased("9", "2.89"), increased("0.5", "-0.5")
    ('11.89', '0')
    """
    return _plain(EXACT.add(_number(value), _number(more)))


def increase(value: float, more: float) -> str:
    """The sum of two computed numbers as they are written, and in brackets the true sum where it differs.

    >>> increase(-0.0416166, 0.0832332), increase(2.0, -3.0)
    ('−0.041617 + 0.083233 = 0.041616 (0.041617)', '2 − 3 = −1')
    """
    tiny = 1e-12 * max(abs(value), abs(more))
    base, added = (amount(part if abs(part) > tiny else 0.0, MOST) for part in (value, more))
    whole, finer = increased(base, added), amount(value + more if abs(value + more) > tiny else 0.0, MOST)
    sign = "−" if added.startswith("-") else "+"
    exact = "" if whole == finer else f" ({printed(finer)})"
    return f"{printed(base)} {sign} {printed(added.removeprefix('-'))} = {printed(whole)}{exact}"


def amount(value: float, carried: int = 6) -> str:
    """A given number to at most ``carried`` figures, without the rounding behind them.

    >>> amount(0.1 + 0.2), amount(1e6 / 3), amount(120.0)
    ('0.3', '333333', '120')
    """
    return _plain(Decimal(f"{value:.{carried}g}"))


def as_given(value: float, carried: int = MOST + 1) -> str:
    """A number of the problem with all its figures; the distance of two given points to ``carried`` figures.

    >>> as_given(113.442), as_given(1234.5678), as_given(50**0.5)
    ('113.442', '1234.5678', '7.07107')
    """
    whole = amount(value, 12)
    return whole if figures(whole) <= LONGEST else amount(value, carried)


def computed(value: float, carried: int) -> str:
    """A computed number to ``carried`` figures; places before the point are never cut.

    >>> computed(31472.0465, 4), computed(-0.367949, 4), computed(120.0, 2)
    ('31472', '-0.3679', '120')
    """
    return _plain(_rounded(Decimal(f"{value:.15g}"), carried))


def true_minus(text: str) -> str:
    """Numbers with the minus sign of print in place of the hyphen of a keyboard.

    >>> true_minus("-2.5")
    '−2.5'
    """
    return text.replace("-", "−")


def in_sentence(words: str) -> str:
    """A sentence with the minus sign of print before its numbers; the hyphens of names stay.

    >>> in_sentence("P1-6 at -30°, （-5 mm）")
    'P1-6 at −30°, （−5 mm）'
    """
    return re.sub(r"(?<![\w./-])-(?=\d)", "−", words)


def printed(text: str) -> str:
    """A number for people, alone or with its unit: powers of ten as such, a typographic minus sign.

    >>> printed("-2.5"), printed("1.2e-07 %")
    ('−2.5', '1.2·10⁻⁷ %')
    """
    return true_minus(re.sub(r"(?<=\d)e([+-]?\d+)", lambda power: "·10" + f"{int(power[1])}".translate(_RAISED), text))


def pointing(span: complex) -> str:
    """The direction of a vector in degrees, to a tenth, above -180 to 180.

    >>> pointing(2j), pointing(1 - 1j), pointing(-1 - 1e-9j), pointing(1 - 1e-9j)
    ('90.0', '−45.0', '180.0', '0.0')
    """
    angle = round(math.degrees(cmath.phase(span)), 1) + 0.0
    return true_minus(f"{180.0 if angle == -180.0 else angle:.1f}")


def roman(number: int) -> str:
    """A number from 1 on in Roman numerals, as trials, insets and loops are counted.

    >>> [roman(number) for number in (1, 4, 6, 9, 14)]
    ['I', 'IV', 'VI', 'IX', 'XIV']
    """
    text = ""
    for value, letters in ((10, "X"), (9, "IX"), (5, "V"), (4, "IV"), (1, "I")):
        count, number = divmod(number, value)
        text += count * letters
    return text


def _number(text: str) -> Decimal:
    return Decimal(text.replace("−", "-"))


def _rounded(value: Decimal, carried: int) -> Decimal:
    """The number to ``carried`` figures; places before the point are never cut."""
    if not value:
        return Decimal(0)
    step = Decimal(1).scaleb(min(value.adjusted() - carried + 1, 0))
    return value.quantize(step, context=EXACT)


def _plain(value: Decimal) -> str:
    """The number without an exponent where possible, and without needless zeros."""
    if not value:
        return "0"
    value = value.normalize(EXACT)
    if -5 <= value.adjusted() < 9:
        return f"{value:f}"
    head, power = f"{value:e}".split("e")
    return f"{head}e{int(power)}"
