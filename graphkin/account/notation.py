"""The notation of each school: poles, end points, component marks, directions, instant centres, scale statements,
forces.

All symbols are in the notation of `graphkin.words.symbols` (without dollar signs unless stated). Chinese: Sun Huan,
Mechanical Principles; us: Norton, Design of Machinery; british: Hannah and Stephens, Mechanics of Machines; russian:
Artobolevsky, Theory of Mechanisms and Machines.  Forces and moments: chinese F_R56, F_I6; us and british
F_56, F_i6, W_6; russian R_56, Φ_6, G_6.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Literal

from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import PARTS, DiagramName, Direction, Size, Term
from graphkin.scene.scene_tables import Convention
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Unit
from graphkin.words.written import true_minus

Rows = Literal["rows", "over", "table", "underlines"]

_POLES: Mapping[str, tuple[str, str]] = {
    "chinese": ("p", "p'"),
    "us": ("O_{v}", "O_{a}"),
    "british": ("o", "o'"),
    "russian": ("p", "π"),
}
# superscripts of the parts of an acceleration: normal, tangential, Coriolis, sliding
_PARTS: Mapping[str, tuple[str, str, str, str]] = {
    "chinese": ("n", "t", "k", "r"),
    "us": ("n", "t", "c", "s"),
    "british": ("n", "t", "c", "s"),
    "russian": ("n", "τ", "k", "r"),
}
_ROWS: Mapping[str, Rows] = {"chinese": "rows", "us": "over", "british": "table", "russian": "underlines"}
PART_MARKS = {mark: kind for marks in _PARTS.values() for mark, kind in zip(marks, PARTS, strict=True)}
"""The part of an acceleration by the mark that it bears in some convention."""
_NAME = re.compile(r"([A-Za-z]+)(.*)")


def pole(convention: Convention, diagram: DiagramName) -> str:
    """The letter of the pole of a diagram."""
    return _POLES[convention][diagram == "acceleration"]


def rows_of(convention: Convention) -> Rows:
    """The display of known and unknown sizes and directions: rows under the terms, marks over them, a table, lines."""
    return _ROWS[convention]


def as_vector(convention: Convention, magnitude: str) -> str:
    r"""A symbol as a vector, distinct from its magnitude: ``\mathbf{v}_{B3B2}``, russian ``\vec{v}_{B3B2}``.

    Sun Huan, Norton, Hannah and Stephens print vectors bold or without a mark; Russian books and blackboards have a
    mark over the letter.
    """
    mark = "vec" if convention == "russian" else "mathbf"
    return rf"\{mark}{{{magnitude[0]}}}{magnitude[1:]}"


@dataclass(frozen=True)
class Notation:
    """Names of quantities in a convention, on a sheet or on a diagram.

    ``blocks`` gives for a pin that runs in a guide the link of its index where coincident points are distinguished (the
    pin B of block 2 is written B2 beside B3); ``holders`` the links of each point.
    """

    convention: Convention
    blocks: Mapping[str, str] = field(default_factory=dict)
    holders: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def point(self, name: str) -> str:
        """A point of the mechanism: capital letter, digits as an index."""
        letter, rest = _parted(name)
        return f"{letter}_{{{rest}}}" if rest else letter

    def ref(self, ref: PointRef) -> str:
        """A point of a link as an index: ``B3``."""
        link = ref.link or self.blocks.get(ref.point, "")
        if not link:
            return ref.point
        return f"{ref.point}_{{{link}}}" if ref.point[-1].isdigit() else f"{ref.point}{link}"

    def arrow(self, symbol: Symbol) -> str:
        r"""A vector as such, in an equation or at its arrow: ``\mathbf{v}_{B3B2}``."""
        return as_vector(self.convention, self.vector(symbol))

    def vector(self, symbol: Symbol) -> str:
        """The magnitude of a vector, or a rate: ``v_{B3B2}``, ``a^{n}_{CB}``, ``ω_{3}``; seen from link 2 held still,
        ``a^{n(2)}_{CB}``; the rate of a sliding pair ``v_{61}``, a component along an axis ``v_{Cx}``."""
        if symbol.at:
            return f"{self.vector(symbol.here)}({symbol.at})"
        if symbol.scope == "force":
            return force_letters(self.convention, symbol)
        kind, us = symbol.entry, self.convention == "us"
        if symbol.scope != "motion":
            names = "".join(self.ref(ref) for ref in (symbol.of, symbol.to) if ref) + _pair(symbol)
            above = f"^{{{kind.mark}}}" if kind.mark else ""
            return f"{kind.letter or kind.name}{above}_{{{names + symbol.name.replace('-', '')}}}"
        if symbol.of is None:
            return f"{kind.letter or (kind.name.upper() if us else kind.name)}_{{{_pair(symbol)}}}"
        index = self.ref(symbol.of)
        if symbol.to is not None:
            index += ("/" if us else "") + self.ref(symbol.to)
        index += symbol.axis
        letter = symbol.kind[0].upper() if us else symbol.kind[0]
        marks = dict(zip(PARTS, _PARTS[self.convention], strict=True)).get(symbol.kind, "")
        marks += f"({symbol.seen})" if symbol.seen else ""
        return f"{letter}^{{{marks}}}_{{{index}}}" if marks else f"{letter}_{{{index}}}"

    def term(self, term: Term) -> str:
        """A vector in an equation, of a force its part."""
        part = force_letters(self.convention, term.symbol, term.part) if term.part else self.vector(term.symbol)
        return ("−" if term.turned else "") + as_vector(self.convention, part)

    def end(self, diagram: DiagramName, ref: PointRef) -> str:
        """The end point of a vector from the pole: small letter, primed in the acceleration polygon; in the us
        convention the vector is named instead."""
        if self.convention == "us":
            return ""
        letter, rest = _parted(ref.point)
        link = ref.link or self.blocks.get(ref.point, "")
        if not rest and not link and letter.lower() == _POLES[self.convention][0]:
            # the pole has this letter already; O of link 4 is not the point O4
            holders = self.holders[ref.point]
            link = next((name for name in holders if ref.point + name not in self.holders), holders[0])
        index = f"{rest},{link}" if rest and link else rest + link
        prime = "'" if diagram == "acceleration" else ""
        return letter.lower() + (f"_{{{index}}}" if index else "") + prime

    def foot(self, role: str, end: PointRef, number: int, link: str, alone: bool) -> str:
        """The point between two components of one acceleration; "" where the convention names the vectors instead.

        ``number`` counts the feet on the path to an end point, ``link`` is the link of the component, ``alone`` marks
        the only foot of its kind: it needs no index, but n' always has one in Chinese books.
        """
        marks: dict[str, str] = dict(zip(PARTS.values(), _PARTS[self.convention], strict=True))
        if self.convention == "us" or role not in marks:
            return ""
        if self.convention == "british":
            letter, rest = _parted(end.point)
            index = ",".join(filter(None, (rest, end.link or self.blocks.get(end.point, ""), str(number))))
            return f"{letter.lower()}_{{{index}}}'"
        indexed = link and (not alone or (self.convention == "chinese" and role == "normal"))
        return marks[role] + (f"_{{{link}}}" if indexed else "") + "'"

    def direction(self, direction: Direction | None, frame: str) -> str:
        """A direction in an equation row or at its line: ``⊥BC``, ``∥CB``, ``B→A``; "" if none is written."""
        if direction is None or not direction.names:
            return ""
        names = "".join(self.point(n) if len(direction.names) > 1 else self.guide(n, frame) for n in direction.names)
        if direction.relation == "towards":
            return "→".join(self.point(n) for n in direction.names)
        return ("∥" if direction.relation == "along" else "⊥") + names

    def centre(self, pair: Sequence[str]) -> str:
        """The instant centre of two links in the order of counting: P in the chinese and russian convention, else I."""
        a, b = sorted(pair, key=in_counting_order)
        comma = "," if max(len(a), len(b)) > 1 else ""
        return f"{'P' if self.convention in ('chinese', 'russian') else 'I'}_{{{a}{comma}{b}}}"

    def guide(self, name: str, frame: str) -> str:
        """A guide by its name; the frame's own axis is x."""
        if name == f"x{frame}":
            return "x"
        if "-" in name:  # n-n, t-t of what touches
            return name
        letter, rest = _parted(name)
        return f"{letter}_{{{rest}}}" if letter and rest else name

    def size(self, rule: Size) -> str:
        """The rule that gives a size: ``ω_{1}^{2} l_{AB}``."""
        factor = self.vector(rule.factor) if isinstance(rule.factor, Symbol) else self.length(rule.factor)
        return rule.written(factor).replace("²", "^{2}").replace("·", " ").replace("/ρ", " / ρ")

    def length(self, names: Sequence[str]) -> str:
        """The length of a bar: ``l_{AB}``."""
        return f"l_{{{''.join(names)}}}"


def in_counting_order(link: str) -> tuple[bool, int, str]:
    """The sort key of links: numbers first, by value."""
    return not link.isdigit(), int(link) if link.isdigit() else 0, link


@lru_cache(maxsize=64)
def _parted(name: str) -> tuple[str, str]:
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


def scale_statement(sheet: Sheet, convention: Convention, diagram: DiagramName) -> str:
    """The scale of a figure, as words with symbols between dollar signs.

    >>> from graphkin.scene import mechanism_of
    >>> from graphkin.construction import draft
    >>> scale_statement(draft(mechanism_of("sixbar-guide-40deg")), "british", "velocity")
    '1 cm = 100 mm/s'
    """
    unit = unit_of(sheet, diagram)
    per = sheet.scales.of(diagram) / unit.si
    if convention == "us":
        return f"1 mm = {_number(per)} {unit.written}"
    if convention == "british":
        return f"1 cm = {_number(10 * per)} {unit.written}"
    index = {"mechanism": "l", "velocity": "v", "acceleration": "a", "force": "F"}[diagram]
    over, _, under = unit.written.partition("/")
    shown = f"{over}/({under}·mm)" if under and convention == "russian" else per_mm(unit.written)
    return f"$μ_{{{index}}}$ = {_number(per)} {shown}"


def per_mm(unit: str) -> str:
    """A unit for one mm of paper: ``mm/mm``, ``(mm/s)/mm``."""
    return f"({unit})/mm" if "/" in unit else f"{unit}/mm"


def unit_of(sheet: Sheet, diagram: DiagramName) -> Unit:
    """The unit of a diagram's vectors."""
    return sheet.scene.units.of("length" if diagram == "mechanism" else diagram)


def _number(value: float) -> str:
    text = f"{value:.10g}"
    if "e" in text:
        head, power = text.split("e")
        return f"{head}·$10^{{{true_minus(str(int(power)))}}}$"
    return text


_INERTIA = {"chinese": ("F", "I"), "us": ("F", "i"), "british": ("F", "i"), "russian": ("Φ", "")}


def force_letters(convention: Convention, symbol: Symbol, part: str = "") -> str:
    r"""A force, moment, shift or arm as a symbol without dollar signs: ``F_{R56}``, ``F^{t}_{R45}``, ``M_{2}``.

    >>> force_letters("chinese", Symbol.parse("F_4/5"), "t"), force_letters("russian", Symbol.parse("F_4/5+"))
    ('F^{t}_{R45}', 'R^{+}_{45}')
    """
    letter, index = _named(convention, symbol)
    above = ("τ" if part == "t" and convention == "russian" else part) + ("+" if symbol.plus else "")
    return letter + (f"^{{{above}}}" if above else "") + (f"_{{{index}}}" if index else "")


def _pair(symbol: Symbol) -> str:
    """A link, or a pair of links, parted where a name has several signs: ``61``, ``10,1``."""
    comma = "," if max(len(symbol.link), len(symbol.other)) > 1 else ""
    return symbol.link + (comma + symbol.other if symbol.other else "")


def _named(convention: Convention, symbol: Symbol) -> tuple[str, str]:
    links = _pair(symbol)
    at = f",{symbol.of.point}" if symbol.of else ""
    letter, mark = _INERTIA[convention]
    match symbol.kind:
        case "F" if symbol.other:
            if convention == "russian":
                return "R", links + at
            return "F", ("R" if convention == "chinese" else "") + links + at
        case "F":
            return "F", symbol.link
        case "Fi":
            return letter, mark + symbol.link
        case "Mi":
            return "M", (mark or "Φ") + symbol.link
        case "G":
            return ("W" if convention in ("us", "british") else "G"), symbol.link
        case "P":
            own = "M" if symbol.turning else "P"
            return own, "" if symbol.name == own else symbol.name
        case "M" if symbol.other:
            return "M", links + at
        case "arm":
            return "h", "".join(_named(convention, Symbol.parse(symbol.name)))
        case _:
            return symbol.kind, symbol.link
