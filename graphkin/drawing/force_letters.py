"""Forces and moments as each school writes them: joint forces, inertia forces, weights, loads, and their parts.

Chinese: F_R56, F_I6 (Sun Huan, Mechanical Principles); us: F_56, F_i6, W_6 (Norton, Design of Machinery); british the
same; russian: R_56, Φ_6, G_6 (Artobolevsky, Theory of mechanisms and machines).
"""

from __future__ import annotations

from graphkin.scene.sheet_tables import Convention
from graphkin.scene.symbol import Symbol

__all__ = ["force_letters", "part_mark"]

_INERTIA = {"chinese": ("F", "I"), "us": ("F", "i"), "british": ("F", "i"), "russian": ("Φ", "")}


def part_mark(convention: Convention, part: str) -> str:
    """The superscript of a part of a force, normal or tangential."""
    return {"t": "τ"}.get(part, part) if convention == "russian" else part


def force_letters(convention: Convention, symbol: Symbol, part: str = "") -> str:
    r"""A force, moment, shift or arm as a symbol without dollar signs: ``F_{R56}``, ``F^{t}_{R45}``, ``M_{2}``.

    >>> force_letters("chinese", Symbol.parse("F_4/5"), "t"), force_letters("russian", Symbol.parse("F_4/5+"))
    ('F^{t}_{R45}', 'R^{+}_{45}')
    """
    letter, index = _named(convention, symbol)
    above = part_mark(convention, part) + ("+" if symbol.plus else "")
    return letter + (f"^{{{above}}}" if above else "") + (f"_{{{index}}}" if index else "")


def _named(convention: Convention, symbol: Symbol) -> tuple[str, str]:
    comma = "," if max(len(symbol.link), len(symbol.other)) > 1 else ""
    links = symbol.link + (comma + symbol.other if symbol.other else "")
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
