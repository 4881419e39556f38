"""The notation of each school: poles, end points, component marks, directions, instant centres, scales, forces.

Chinese: Sun Huan,
Mechanical Principles; us: Norton, Design of Machinery; british: Hannah and Stephens, Mechanics of Machines; russian:
Artobolevsky, Theory of Mechanisms and Machines.  Forces and moments: chinese F_R56, F_I6; us and british
F_56, F_i6, W_6; russian R_56, Φ_6, G_6.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Literal

from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import PARTS, DiagramName, Direction, Size, Term
from graphkin.scene.scene_tables import Convention
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Unit
from graphkin.words.symbols import Atom, RichText, Words, plain, rate, sign
from graphkin.words.written import printed

Rows = Literal["rows", "over", "table", "underlines"]

_POLES: Mapping[str, tuple[RichText, RichText]] = {
    "chinese": (sign("p"), sign("p'")),
    "us": (sign("O", "v"), sign("O", "a")),
    "british": (sign("o"), sign("o'")),
    "russian": (sign("p"), sign("π")),
}
# superscripts of the parts of an acceleration by their kinds
_PARTS: Mapping[str, Mapping[str, str]] = {
    "chinese": {"an": "n", "at": "t", "ak": "k", "ar": "r"},
    "us": {"an": "n", "at": "t", "ak": "c", "ar": "s"},
    "british": {"an": "n", "at": "t", "ak": "c", "ar": "s"},
    "russian": {"an": "n", "at": "τ", "ak": "k", "ar": "r"},
}
_ROWS: Mapping[str, Rows] = {"chinese": "rows", "us": "over", "british": "table", "russian": "underlines"}
_NAME = re.compile(r"([A-Za-z]+)(.*)")


def pole(convention: Convention, diagram: DiagramName) -> RichText:
    """The letter of the pole of a diagram."""
    return _POLES[convention][diagram == "acceleration"]


def rows_of(convention: Convention) -> Rows:
    """The display of known and unknown sizes and directions: rows under the terms, marks over them, a table, lines."""
    return _ROWS[convention]


@lru_cache(maxsize=2048)
def as_vector(convention: Convention, magnitude: RichText) -> RichText:
    """A symbol as a vector, distinct from its magnitude: its letter bold, russian with an arrow.

    Sun Huan, Norton, Hannah and Stephens print vectors bold or without a mark; Russian books and blackboards have a
    mark over the letter.
    """
    letter, *others = magnitude.atoms
    arrow = convention == "russian"
    return RichText(Atom(letter.text, letter.sub, letter.sup, not arrow, arrow, letter.meaning), *others)


@dataclass(frozen=True, eq=False, repr=False)
class Notation:
    """Names of quantities in a convention, on a sheet or on a diagram.

    ``blocks`` gives for a pin that runs in a guide the link of its index where coincident points are distinguished (the
    pin B of block 2 is written B2 beside B3); ``holders`` the links of each point.
    """

    convention: Convention
    blocks: Mapping[str, str] = field(default_factory=dict)
    holders: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def point(self, name: str) -> RichText:
        """A point of the mechanism: capital letter, digits as an index."""
        letter, rest = _parted(name)
        return sign(letter, rest) if letter else RichText(rest)

    def bar(self, names: Iterable[str]) -> RichText:
        """A bar, or a figure of points, by the letters of its ends."""
        return RichText(*map(self.point, names))

    def ref(self, ref: PointRef) -> RichText:
        """A point of a link as an index: ``B3``."""
        return _index(self._on_link(ref))

    def _on_link(self, ref: PointRef) -> PointRef:
        """A point with the link of its index."""
        return PointRef(ref.point, ref.link or self.blocks.get(ref.point, ""))

    def _indexed(self, ref: PointRef, *more: str) -> tuple[str, str]:
        """The letter of a point and its index: its digits, its link where coincident points are distinguished."""
        letter, rest = _parted(ref.point)
        return letter, ",".join(filter(None, (rest, self._on_link(ref).link, *more)))

    def coincident(self, ref: PointRef) -> RichText:
        """A point, with the link as a further index where coincident points are distinguished: ``B_2``, ``O_4,2``."""
        return sign(*self._indexed(ref))

    def arrow(self, symbol: Symbol) -> RichText:
        """A vector as such, in an equation or at its arrow."""
        return as_vector(self.convention, self.vector(symbol))

    def vector(self, symbol: Symbol) -> RichText:
        """The magnitude of a vector, or a rate: ``v_B3B2``, ``a^n_CB``, ``ω_3``; seen from link 2 held still,
        ``a^n(2)_CB``; the rate of a sliding pair ``v_61``, a component along an axis ``v_Cx``."""
        if symbol.at:
            return self.vector(symbol.here) + sign(f"({symbol.at})")
        if symbol.scope == "force":
            return force_letters(self.convention, symbol)
        kind, us = symbol.entry, self.convention == "us"
        if symbol.scope != "motion":
            names = RichText(*(self.ref(ref) for ref in (symbol.of, symbol.to) if ref), _pair(symbol))
            return sign(kind.letter or kind.name, names + symbol.name.replace("-", ""), kind.mark)
        if symbol.of is None:
            if kind.letter:
                return rate(kind.name, _pair(symbol))
            return sign(kind.name.upper() if us else kind.name, _pair(symbol))
        of, to = self._on_link(symbol.of), self._on_link(symbol.to) if symbol.to else None
        return _of_points(self.convention, symbol.kind, of, to, symbol.axis, symbol.seen)

    def term(self, term: Term) -> RichText:
        """A vector in an equation, of a force its part."""
        part = force_letters(self.convention, term.symbol, term.part) if term.part else self.vector(term.symbol)
        vector = as_vector(self.convention, part)
        return sign("−") + vector if term.turned else vector

    def end(self, diagram: DiagramName, ref: PointRef) -> RichText:
        """The end point of a vector from the pole: a small letter, primed for accelerations; "us" names the vector."""
        if self.convention == "us":
            return RichText()
        letter, index = self._indexed(ref)
        if not index and letter.lower() == str(_POLES[self.convention][0]):
            # the pole has this letter already; O of link 4 is not the point O4
            holders = self.holders[ref.point]
            index = next((name for name in holders if ref.point + name not in self.holders), holders[0])
        name = sign(letter.lower(), index)
        return name + sign("'") if diagram == "acceleration" else name

    def foot(self, role: str, end: PointRef, number: int, link: Words, alone: bool) -> RichText:
        """The point between two components of one acceleration; "" where the convention names the vectors instead.

        ``number`` counts the feet on the path to an end point, ``link`` is the link of the component, ``alone`` marks
        the only foot of its kind: it needs no index, but n' always has one in Chinese books.
        """
        marks: Mapping[str, str] = {PARTS[kind]: mark for kind, mark in _PARTS[self.convention].items()}
        if self.convention == "us" or role not in marks:
            return RichText()
        if self.convention == "british":
            letter, index = self._indexed(end, str(number))
            return sign(letter.lower(), index) + sign("'")
        indexed = link and (not alone or (self.convention == "chinese" and role == "normal"))
        return sign(marks[role], link if indexed else "") + sign("'")

    def direction(self, direction: Direction | None, frame: str) -> RichText:
        """A direction in an equation row or at its line: ``⊥BC``, ``∥CB``, ``B→A``; "" if none is written."""
        if direction is None or not direction.names:
            return RichText()
        if direction.relation == "towards":
            first, second = map(self.point, direction.names)
            return RichText(first, sign("→"), second)
        only, *others = direction.names
        names = self.bar(direction.names) if others else self.guide(only, frame)
        return sign("∥" if direction.relation == "along" else "⊥") + names

    def centre(self, pair: Sequence[str]) -> RichText:
        """The instant centre of two links in the order of counting: P in the chinese and russian convention, else I."""
        a, b = sorted(pair, key=in_counting_order)
        comma = "," if max(len(a), len(b)) > 1 else ""
        return sign("P" if self.convention in ("chinese", "russian") else "I", a + comma + b)

    def guide(self, name: str, frame: str) -> RichText:
        """A guide by its name; the frame's own axis is x, and n-n, t-t are those of what touches."""
        letter, rest = _parted("x" if name == f"x{frame}" else name)
        return sign(letter, rest) if letter and "-" not in name else sign(name)

    def size(self, rule: Size) -> RichText:
        """The rule that gives a size: ``ω_1^2 l_AB``."""
        factor = self.vector(rule.factor) if isinstance(rule.factor, Symbol) else self.length(rule.factor)
        return RichText(*rule.written(factor, " ", " / ").atoms)

    def length(self, names: Sequence[str]) -> RichText:
        """The length of a bar: ``l_AB``."""
        return sign("l", "".join(names), meaning=("length", " ".join(names)))


def _index(ref: PointRef) -> RichText:
    return sign(ref.point, ref.link) if ref.point[-1].isdigit() else sign(ref.point + ref.link)


@lru_cache(maxsize=2048)
def _of_points(convention: Convention, kind: str, of: PointRef, to: PointRef | None, axis: str, seen: str) -> RichText:
    """A vector by its points, each with the link of its index; every figure writes each of them several times."""
    us, first, second = convention == "us", _index(of) + axis, _index(to) if to else RichText()
    above = f"({seen})" if seen else ""
    meaning = kind, plain(first, ""), plain(second, ""), above
    below = first + "/" + second if us and second else first + second
    return sign(kind[0].upper() if us else kind[0], below, _PARTS[convention].get(kind, "") + above, meaning)


def in_counting_order(link: str) -> tuple[bool, int, str]:
    """The sort key of links: numbers first, by value."""
    return not link.isdigit(), int(link) if link.isdigit() else 0, link


@lru_cache(maxsize=64)
def _parted(name: str) -> tuple[str, str]:
    """The letters of a name, and the rest of it; of another name "" and all."""
    match = _NAME.fullmatch(name)
    return (match[1], match[2]) if match else ("", name)


def notation_of(sheet: Sheet, convention: Convention) -> Notation:
    """The names on one sheet."""
    blocks: dict[str, set[str]] = {}
    holders = sheet.scene.holders
    for symbol in (*sheet.vectors["velocity"], *sheet.vectors["acceleration"]):
        if symbol.of is None or symbol.to is None or symbol.of.point != symbol.to.point:
            continue
        for ref in (symbol.of, symbol.to):
            if ref.link in holders.get(ref.point, ()):
                blocks.setdefault(ref.point, set()).add(ref.link)
    return Notation(convention, {point: min(links) for point, links in blocks.items() if len(links) == 1}, holders)


def scale_statement(sheet: Sheet, convention: Convention, diagram: DiagramName) -> Words:
    """The scale of a figure.

    >>> from graphkin.scene import mechanism_of
    >>> from graphkin.construction import draft
    >>> scale_statement(draft(mechanism_of("sixbar-guide-40deg")), "british", "velocity")
    '1 cm = 100 mm/s'
    """
    unit = unit_of(sheet, diagram)
    per = sheet.scales.of(diagram) / unit.si
    if convention == "us":
        return f"1 mm = {printed(f'{per:.10g}')} {unit.written}"
    if convention == "british":
        return f"1 cm = {printed(f'{10 * per:.10g}')} {unit.written}"
    index = {"mechanism": "l", "velocity": "v", "acceleration": "a", "force": "F"}[diagram]
    over, _, under = unit.written.partition("/")
    shown = f"{over}/({under}·mm)" if under and convention == "russian" else per_mm(unit.written)
    return sign("μ", index) + f" = {printed(f'{per:.10g}')} {shown}"


def per_mm(unit: str) -> str:
    """A unit for one mm of paper: ``mm/mm``, ``(mm/s)/mm``."""
    return f"({unit})/mm" if "/" in unit else f"{unit}/mm"


def unit_of(sheet: Sheet, diagram: DiagramName) -> Unit:
    """The unit of a diagram's vectors."""
    return sheet.scene.units.of("length" if diagram == "mechanism" else diagram)


_INERTIA = {"chinese": ("F", "I"), "us": ("F", "i"), "british": ("F", "i"), "russian": ("Φ", "")}


def force_letters(convention: Convention, symbol: Symbol, part: str = "") -> RichText:
    """A force, moment, shift or arm as a symbol.

    >>> force_letters("chinese", Symbol.parse("F_4/5"), "t"), force_letters("russian", Symbol.parse("F_4/5+"))
    ($F^{t}_{R45}$, $R^{+}_{45}$)
    """
    letter, index = _named(convention, symbol)
    above = ("τ" if part == "t" and convention == "russian" else part) + ("+" if symbol.plus else "")
    return sign(letter, index, above)


def _pair(symbol: Symbol) -> str:
    """A link, or a pair of links, parted where a name has several signs: ``61``, ``10,1``."""
    comma = "," if max(len(symbol.link), len(symbol.other)) > 1 else ""
    return symbol.link + (comma + symbol.other if symbol.other else "")


def _named(convention: Convention, symbol: Symbol) -> tuple[str, str]:
    links = _pair(symbol)
    at = f",{symbol.of.point}{symbol.of.link}" if symbol.of else ""
    letter, mark = _INERTIA[convention]
    match symbol.kind:
        case "F" if symbol.other:
            if convention == "russian":
                return "R", links + at
            return "F", ("R" if convention == "chinese" else "") + links + at
        case "F":
            return "F", symbol.link + at
        case "Fi":
            return letter, mark + symbol.link
        case "Mi":
            return "M", (mark or "Φ") + symbol.link
        case "G":
            return ("W" if convention in ("us", "british") else "G"), symbol.link
        case "P":
            usual = "M" if symbol.turning else "P"
            return usual, "" if symbol.name == usual else symbol.name
        case "M" if symbol.other:
            return "M", links + at
        case "arm":
            return "h", "".join(_named(convention, Symbol.parse(symbol.name)))
        case _:
            return symbol.kind, symbol.link
