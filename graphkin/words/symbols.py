"""Rich text: words and symbols as parts, which each writer sets in its own way and none reads back.

`sign` makes a symbol of a letter, its index and the mark above it; ``+`` joins it to words.  The tables of words hold
theirs between dollar signs, which are read with the table: ``$C_{1}$``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache
from typing import NamedTuple, TypeAlias

_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
_TYPED = {"′": "'"}


class Atom(NamedTuple):
    """A character of a symbol with its index, superscript and marks.

    ``meaning`` is of the first of a quantity: its kind and the names in its index, by which it is read aloud.
    """

    text: str
    sub: tuple[Atom, ...] = ()
    sup: tuple[Atom, ...] = ()
    bold: bool = False
    arrow: bool = False
    meaning: tuple[str, ...] = ()


Stretch: TypeAlias = str | tuple[Atom, ...]
"""Words, or a symbol: several side by side are one."""


class RichText:
    """Words and the atoms of symbols in order; as a text it is plain, with ``_`` before an index.

    >>> text = sign("v", "B2") + " = 3 mm/s"
    >>> str(text), text
    ('v_B2 = 3 mm/s', $v_{B2}$ = 3 mm/s)
    """

    __slots__ = ("parts",)
    parts: tuple[str | Atom, ...]

    def __init__(self, *texts: Words | Atom) -> None:
        parts: list[str | Atom] = []
        for text in texts:
            more = text.parts if isinstance(text, RichText) else (text,) if text else ()
            if parts and more and isinstance(more[0], str) and isinstance(parts[-1], str):
                parts[-1] += more[0]  # words meet only where two texts meet
                more = more[1:]
            parts += more
        self.parts = tuple(parts)

    def __add__(self, other: Words) -> RichText:
        return RichText(self, other)

    def __radd__(self, other: str) -> RichText:
        return RichText(other, self)

    def __bool__(self) -> bool:
        return bool(self.parts)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, RichText) and self.parts == other.parts

    def __hash__(self) -> int:
        return hash(self.parts)

    def __str__(self) -> str:
        return self.plain()

    def __format__(self, spec: str) -> str:
        raise TypeError("rich text is joined with +, which keeps its symbols, or made plain by str()")

    def __repr__(self) -> str:
        shown = (part if isinstance(part, str) else f"${notation(part, _TYPED)}$" for part in stretches(self))
        return "".join(shown)

    @property
    def atoms(self) -> tuple[Atom, ...]:
        """All of it as atoms, the characters of words too."""
        return tuple(atom for part in self.parts for atom in (map(Atom, part) if isinstance(part, str) else (part,)))

    def plain(self, index: str = "_") -> str:
        """Plain text, with ``index`` before an index; a power follows the index, a mark of a component precedes it.

        >>> (sign("a", "CB", "n") + " = " + sign("ω", "2", "2") + " " + sign("l", "CB")).plain()
        'a^n_CB = ω_2² l_CB'
        """
        return "".join([part if isinstance(part, str) else _plain(part, index) for part in self.parts])

    def with_words(self, change: Callable[[str], str]) -> RichText:
        """The text with its words changed, its symbols as they are."""
        return RichText(*(change(part) if isinstance(part, str) else part for part in self.parts))

    def stripped(self, marks: str) -> RichText:
        """The text without some marks at both ends of its words."""
        parts = list(self.parts)
        if parts and isinstance(parts[0], str):
            parts[0] = parts[0].lstrip(marks)
        if parts and isinstance(parts[-1], str):
            parts[-1] = parts[-1].rstrip(marks)
        return RichText(*parts)

    def cut(self, marks: str) -> tuple[RichText, str]:
        """The text up to the marks at its end, and these."""
        *before, last = self.parts or ("",)
        if not isinstance(last, str):
            return self, ""
        head = last.rstrip(marks)
        return RichText(*before, head), last[len(head) :]


Words: TypeAlias = str | RichText
"""A text without symbols, or with them."""


def stretches(text: Words) -> Iterator[Stretch]:
    """Words and symbols in turn."""
    symbol: tuple[Atom, ...] = ()
    for part in (text,) if isinstance(text, str) else text.parts:
        if isinstance(part, Atom):
            symbol += (part,)
            continue
        if symbol:
            yield symbol
            symbol = ()
        yield part
    if symbol:
        yield symbol


def spaced(between: Words, texts: Iterable[Words]) -> RichText:
    """Texts with the same words between each two.

    >>> str(spaced(", ", (sign("A"), "B")))
    'A, B'
    """
    parts: list[Words] = []
    for text in texts:
        parts += (between, text) if parts else (text,)
    return RichText(*parts)


@lru_cache(maxsize=8192)
def sign(letters: str, below: Words = "", above: Words = "", meaning: tuple[str, ...] = ()) -> RichText:
    """A symbol: one or several letters, the last with its index and the marks above it; ``'`` is a prime.

    >>> sign("a", "CB", "n"), sign("p'"), sign("B", sign("C", "1"))
    ($a^{n}_{CB}$, $p'$, $B_{C_{1}}$)
    """
    primed = letters.replace("'", "′")
    last = Atom(primed[-1], _inner(below), _inner(above), meaning=meaning)
    return RichText(*map(Atom, primed[:-1]), last)


def rate(kind: str, link: str, above: str = "") -> RichText:
    """The angular velocity ("omega") or acceleration ("alpha") of a link, or of a pair of links."""
    return sign("ω" if kind == "omega" else "α", link, above, (kind, link))


def _inner(text: Words) -> tuple[Atom, ...]:
    return tuple(map(Atom, text.replace("'", "′"))) if isinstance(text, str) else text.atoms


def plain(text: Words, index: str = "_") -> str:
    """A text for terminals and titles, as `RichText.plain`."""
    return text if isinstance(text, str) else text.plain(index)


def _plain(part: Atom, index: str) -> str:
    if not part.sub and not part.sup:
        return part.text
    above, below = ("".join(_plain(atom, index) for atom in atoms) for atoms in (part.sup, part.sub))
    below = f"{index}{below}" if below else ""
    if above.isdigit():
        return part.text + below + above.translate(_RAISED)
    return part.text + (f"^{above}" if above else "") + below


def notation(atoms: Iterable[Atom], letters: Mapping[str, str]) -> str:
    """Atoms as tables and LaTeX write them, with ``\\mathbf`` and ``\\vec`` for the marks of vectors; ``letters`` are
    those that are written otherwise."""
    written = ""
    for atom in atoms:
        letter = letters.get(atom.text, atom.text)
        letter = rf"\mathbf{{{letter}}}" if atom.bold else rf"\vec{{{letter}}}" if atom.arrow else letter
        above, below = (notation(part, letters) for part in (atom.sup, atom.sub))
        written += letter + (f"^{{{above}}}" if above else "") + (f"_{{{below}}}" if below else "")
    return written


# the notation of the tables of words


def noted(markup: str) -> RichText:
    """The words of a table with symbols between dollar signs, their indices in braces.

    Raises
    ------
    ValueError : a dollar sign or a brace is not closed

    >>> noted("the circle meets $C_{1}C_{2}$")
    the circle meets $C_{1}C_{2}$
    """
    parts = markup.split("$")
    if len(parts) % 2 == 0:
        raise ValueError(f"a dollar sign is not closed in {markup!r}")
    return RichText(*(_symbol(part) if i % 2 else part for i, part in enumerate(parts)))


def _symbol(markup: str) -> RichText:
    symbol = RichText()
    while markup:
        letters, _, after = markup.partition("_{")
        index, closed, rest = after.partition("}")
        if after and not closed:
            raise ValueError(f"a brace is not closed in {markup!r}")
        symbol, markup = symbol + sign(letters, index), rest
    return symbol
