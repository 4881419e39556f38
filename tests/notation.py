"""Rich text in the notation in which its `repr` shows it: ``$v_{B}$ = 3 mm/s``."""

from __future__ import annotations

from graphkin.words.symbols import Atom, RichText


def noted(notation: str) -> RichText:
    """Words with symbols between dollar signs; an index or a superscript is one character or stands in braces."""
    parts = notation.split("$")
    return RichText(*(RichText(*_read(part, 0)[0]) if i % 2 else part for i, part in enumerate(parts)))


def _read(notation: str, at: int) -> tuple[list[Atom], int]:
    """The atoms up to the closing brace or the end, and the place behind it."""
    atoms: list[Atom] = []
    while at < len(notation) and notation[at] != "}":
        character = notation[at]
        if character in "_^":
            inner, at = ([Atom(notation[at + 1])], at + 2) if notation[at + 1] != "{" else _read(notation, at + 2)
            atoms[-1] = atoms[-1]._replace(**{"sub" if character == "_" else "sup": tuple(inner)})
        else:
            atoms.append(Atom("′" if character == "'" else character))
            at += 1
    return atoms, at + 1
