r"""Symbols in text: the common notation of all texts, read in one place; each writer sets the atoms.

A symbol stands between dollar signs: ``$v_{B3B2}$``, ``$a^{n}_{C/B}$``.  An index or a superscript is one character or
stands in braces, a prime is ``'``, ``\mathbf{v}`` is bold, ``\vec{v}`` has an arrow; a dollar sign itself is ``$$``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

_BOLD, _ARROWED = r"\mathbf", r"\vec"


@dataclass(frozen=True)
class Atom:
    """A character of a symbol with its index, superscript, prime and marks."""

    text: str
    sub: tuple[Atom, ...] = ()
    sup: tuple[Atom, ...] = ()
    bold: bool = False
    arrow: bool = False


def parsed(markup: str) -> tuple[str | tuple[Atom, ...], ...]:
    """The parts of words with symbols between dollar signs: stretches of words, and symbols as atoms.

    Raises
    ------
    ValueError : a dollar sign or a brace is not closed, or an index follows no character

    >>> parsed("so $v_{B}$ is found")[::2]
    ('so ', ' is found')
    """
    both = (symbol(part) if i % 2 else part for i, part in enumerate(in_turn(markup)))
    return tuple(part for part in both if part)


def in_turn(markup: str) -> list[str]:
    """Words and symbols in turn, words first.  Raises ValueError where a dollar sign is not closed."""
    parts = markup.replace("$$", "\0").split("$")
    if len(parts) % 2 == 0:
        raise ValueError(f"a dollar sign is not closed in {markup!r}; a dollar sign itself is written $$")
    return [part.replace("\0", "$") for part in parts]


def symbol(markup: str) -> tuple[Atom, ...]:
    """The atoms of a symbol, without dollar signs.  Raises ValueError as ``parsed``."""
    atoms, end = _read(markup, 0)
    if end < len(markup):
        raise ValueError(f"a brace is closed but not opened in {markup!r}")
    return atoms


def plain_words(markup: str) -> str:
    """Words with symbols as one plain line, for terminals and titles.

    >>> plain_words("$a^{n}_{CB}$ = $ω_{2}^{2}$ $l_{CB}$ = 3·$10^{−7}$")
    'a^n_CB = ω_2^2 l_CB = 3·10^−7'
    """
    return "".join(part if isinstance(part, str) else plain(part) for part in parsed(markup))


def plain(atoms: Sequence[Atom], index: str = "_") -> str:
    """Atoms as plain text: ``v_B2`` or ``vB2``, with ``index`` before an index; a power follows the index, a mark of a
    component precedes it."""
    written = ""
    for atom in atoms:
        above, below = plain(atom.sup, index), plain(atom.sub, index)
        power, below = f"^{above}" if above else "", f"{index}{below}" if below else ""
        written += atom.text + (below + power if above.isdigit() else power + below)
    return written


def _read(markup: str, at: int) -> tuple[tuple[Atom, ...], int]:
    """Atoms from a place up to the closing brace or the end, and the place of that."""
    atoms: list[Atom] = []
    while at < len(markup) and markup[at] != "}":
        character = markup[at]
        if character in "_^":
            if not atoms:
                raise ValueError(f"an index has nothing to stand at in {markup!r}")
            inner, at = _argument(markup, at + 1)
            last = atoms[-1]
            if last.sub if character == "_" else last.sup:
                raise ValueError(f"two indices in the same place in {markup!r}; put both in one pair of braces")
            atoms[-1] = replace(last, sub=inner) if character == "_" else replace(last, sup=inner)
        elif character == "{":
            inner, at = _argument(markup, at)
            atoms += inner
        elif markup.startswith(_BOLD, at):
            inner, at = _argument(markup, at + len(_BOLD))
            atoms += [replace(atom, bold=True) for atom in inner]
        elif markup.startswith(_ARROWED, at):
            inner, at = _argument(markup, at + len(_ARROWED))
            atoms += [replace(atom, arrow=True) for atom in inner]
        else:
            atoms.append(Atom("′" if character == "'" else character))
            at += 1
    return tuple(atoms), at


def _argument(markup: str, at: int) -> tuple[tuple[Atom, ...], int]:
    """The content of the braces at a place, or its one character; and the place behind it."""
    if at >= len(markup) or markup[at] == "}":
        raise ValueError(f"an index is empty in {markup!r}")
    if markup[at] != "{":
        return (Atom("′" if markup[at] == "'" else markup[at]),), at + 1
    inner, end = _read(markup, at + 1)
    if end >= len(markup):
        raise ValueError(f"a brace is not closed in {markup!r}")
    if not inner:
        raise ValueError(f"there is nothing between braces in {markup!r}")
    return inner, end + 1
