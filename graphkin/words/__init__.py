"""Words in each language: one table for each, of all sentences for steps, notes and headings.

A phrase is a key with its arguments; the sentence is made where it is shown, in the reader's language.
The tables are the files of this folder, ``en.toml`` and ``zh.toml``: a further language is one more file with the same
keys, and every command knows it.

A gap is filled with words, with a symbol (`graphkin.words.symbols`), or with both; ``{link:omega}`` in a table is the
symbol with the value of the gap as its index, and words of a table hold further symbols between dollar signs.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from string import Formatter
from typing import Any, TypeAlias, TypeVar

from graphkin.words.symbols import RichText, Words, noted, plain, rate, sign

_TABLES = {path.stem: path for path in Path(__file__).parent.glob("*.toml")}
LANGUAGES = tuple(sorted(_TABLES, key=lambda name: (name != "en", name)))
"""Languages that have a table; English, which the others translate, first."""
BOTH = "both"
"""English and Chinese on one sheet."""


@cache
def _areas(language: str) -> Mapping[str, Mapping[str, str]]:
    """The words of a language by area and key.

    A table has one entry a line, its texts between double quotes as in JSON, or as they are between single ones.  Read
    so, it takes a fifth of the time of a TOML reader, and saves a short command a twentieth of its own.
    """

    def unquoted(text: str) -> str:
        if text[0] == '"' and "\\" in text:
            return str(json.loads(text))
        return text[1:-1] if text[0] in "\"'" else text

    areas: dict[str, dict[str, str]] = {}
    for line in _TABLES[language].read_text(encoding="utf-8").split("\n"):
        if line.startswith("["):
            words = areas.setdefault(unquoted(line[1:-1]), {})
        elif line and not line.startswith("#"):
            key, _, text = line.partition(" = ")
            words[unquoted(key)] = unquoted(text)
    return areas


@cache
def _table(language: str) -> Mapping[str, str]:
    return {key: text for area in _areas(language).values() for key, text in area.items()}


def area(name: str, language: str = "en") -> Mapping[str, str]:
    """All words of an area of the table by their keys, as a page takes them along."""
    return _areas(language)[name]


class Phrase:
    """A sentence before it is said: its key in the table and the values of its gaps (names, symbols, numbers, phrases).

    The gaps are named (``{link}`` in the table).  As a text it is English.

    >>> str(Phrase("link is the frame", name="4"))
    'link 4 is the frame'
    """

    __slots__ = ("gaps", "key")

    def __init__(self, key: str, /, **gaps: object) -> None:
        self.key, self.gaps = key, gaps

    def __repr__(self) -> str:
        written = [repr(self.key), *(f"{name}={gap!r}" for name, gap in self.gaps.items())]
        return f"Phrase({', '.join(written)})"

    def __str__(self) -> str:
        return say(self)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Phrase) and repr(self) == repr(other)

    def __hash__(self) -> int:
        return hash(repr(self))


Wording: TypeAlias = Phrase | Words
"""What is said in the reader's language, or the same in every one: a name, a number, a line of a file."""
Said = TypeVar("Said")


def as_data(said: object) -> Any:
    """A statement for a file: a phrase as its key with its gaps, whose values become numbers and texts.

    >>> as_data(Phrase("points", link=2, points=Phrase("listed", first="B", second="C")))
    ['points', {'link': 2, 'points': ['listed', {'first': 'B', 'second': 'C'}]}]
    """
    if isinstance(said, Phrase):
        return [said.key, {name: as_data(gap) for name, gap in said.gaps.items()}]
    return said if isinstance(said, int | float) else str(said)


def from_data(kept: Any) -> Any:
    """The statement of which ``as_data`` gave these data.

    >>> str(from_data(["points", {"link": 2, "points": ["listed", {"first": "B", "second": "C"}]}]))
    'mark B, C on link 2'
    """
    if not isinstance(kept, list):
        return kept
    key, gaps = kept
    return Phrase(key, **{name: from_data(gap) for name, gap in gaps.items()})


def say(phrase: Wording, language: str = "en", show: Callable[[object], Words] = str) -> str:
    """The sentence in a language as plain text.  ``show`` writes each argument.

    >>> say(Phrase("points", link="2", points="B, C"))
    'mark B, C on link 2'
    """
    said = parts(phrase, language, show)
    text = "".join(map(plain, said))
    return "".join(map(plain, _closed_up(said))) if _APART.search(text) else text


def _as_it_is(gap: object) -> Words:
    return gap if isinstance(gap, str | RichText) else str(gap)


def rich_text(said: Wording, language: str, show: Callable[[object], Words] = _as_it_is) -> RichText:
    """The sentence in a language with its symbols.  ``show`` writes each argument.

    >>> rich_text(Phrase("by rate seen", **{"symbol": sign("v", "C"), "start.0": sign("B"), "seen": "3"}), "en")
    from $B$ lay off what $ω_{3}$ gives: from the pole to there $v_{C}$
    """
    return RichText(*_closed_up(parts(said, language, show)))


_APART = re.compile("[\u4e00-\u9fff] [\u4e00-\u9fff]")


def _closed_up(parts: Iterable[Words]) -> list[Words]:
    """Parts without a space where Chinese meets Chinese, as of a phrase in the gap of another."""
    closed: list[Words] = []
    for part in parts:
        before = closed[-1] if closed else ""
        if isinstance(part, str) and isinstance(before, str) and part and before:
            if _APART.fullmatch(before[-1] + part[:2]):
                part = part[1:]
            elif _APART.fullmatch(before[-2:] + part[0]):
                closed[-1] = before[:-1]
        closed.append(part)
    return closed


def clause_of(said: Wording, gaps: Mapping[str, object]) -> Wording:
    """The sentence of a problem by its id, with the given gaps that its words have; a text that is no id stays as it
    is: a phrase, or a name, a number, a command that is the same in every language."""
    if not isinstance(said, str) or said not in area("problems"):
        return said
    return Phrase(said, **{gap: gaps[gap] for gap in gaps_of(said)})


class Neutral(RichText):
    """A formula or a value with its unit: the same in every language, so that a sheet in two languages has it once."""


def parts(said: Wording, language: str, show: Callable[[object], Words] = str) -> list[Words]:
    """The parts of a sentence in their order: the words of the table, and each gap as ``show`` writes it.

    >>> parts(Phrase("points", link="2", points="B, C"), "en")
    ['mark ', 'B, C', ' on link ', '2']
    """
    if not isinstance(said, Phrase):
        return [said]
    written: list[Words] = []
    for words, gap, of in _pieces(said.key, language):
        if words:
            written.append(words)
        if gap is None:
            continue
        fill = said.gaps[gap]
        if of:
            index = plain(show(fill), "")
            written.append(rate(of, index) if of in ("omega", "alpha") else sign(of, index))
        elif isinstance(fill, Phrase):
            written += parts(fill, language, show)
        else:
            written.append(show(fill))
    return written


@cache
def _pieces(key: str, language: str) -> tuple[tuple[Words, str | None, str], ...]:
    """The words of a key, each with the name of the gap behind it, and the symbol whose index that gap is."""
    pieces: list[tuple[Words, str | None, str]] = []
    before = ""
    for words, gap, of, _ in Formatter().parse(_table(language)[key]):
        before += words
        if gap is not None:  # a brace that stands for itself parts the words too
            pieces.append((_with_symbols(before), gap, of or ""))
            before = ""
    return (*pieces, (_with_symbols(before), None, ""))


def _with_symbols(words: str) -> Words:
    return noted(words) if "$" in words else words


def has_words(key: str) -> bool:
    """Whether the table has words of a key."""
    return key in _table("en")


@cache
def gaps_of(key: str) -> tuple[str, ...]:
    """The names of the gaps of a sentence.

    >>> gaps_of("points")
    ('points', 'link')
    """
    return tuple(dict.fromkeys(name for _, name, _ in _pieces(key, "en") if name))


def filled(keys: Iterable[str], gap: Callable[[str], object]) -> Phrase | None:
    """The first of some sentences whose gaps can all be filled by their names; None where there is none.

    Parameters
    ----------
    keys : of the sentences, from the fullest to the barest; a key may have gaps of its own
    gap : the value of a gap by its name; None where it has none

    >>> symbol = {"bar": "BC", "kind": "omega", "seen": "3", "symbol": "v_C/B", "told": None}
    >>> str(filled(["{kind} turning", "{kind} zero"], symbol.get))
    'ω_3 = v_C/B / BC = 0'
    """
    for pattern in keys:
        variants = {name: gap(name) for _, name, _, _ in Formatter().parse(pattern) if name}
        if None in variants.values():
            continue
        key = pattern.format_map(variants)
        gaps = {name: gap(name) for name in gaps_of(key)}
        if None not in gaps.values():
            return Phrase(key, **gaps)
    return None


def in_all(said: Wording, language: str) -> tuple[RichText, ...]:
    """A statement in every language of a sheet, as lines: one line where its `Neutral` parts stand in one order, with
    the words of both languages around them, else a line for each language.

    >>> in_all(Phrase("force line shifted", force=sign("F"), distance="2", unit="mm"), "both")
    (The line of action of $F$ lies 2 mm off that point., $F$ 的作用线偏离该点 2 mm。)
    >>> in_all(Phrase("given moment", size=Neutral(sign("M"), " = 2 N·m"), link="3"), "both")
    ($M$ = 2 N·m on link 3 作用于构件 3,)
    """
    every = languages(language)
    lines = tuple(dict.fromkeys(rich_text(said, each) for each in every))
    if len(lines) == 1:
        return lines
    (ours, shared), (theirs, others) = (_around_neutral(said, each) for each in every)
    if not shared or shared != others:
        return lines
    around = [_both(first, second) for first, second in zip(ours, theirs, strict=True)]
    whole = RichText(*(part for pair in zip(around, (*shared, RichText()), strict=True) for part in pair))
    return (whole.stripped(" "),)


def _around_neutral(said: Wording, language: str) -> tuple[list[RichText], list[RichText]]:
    """The words around the neutral parts, and these parts, one fewer."""
    words, neutral = [RichText()], list[RichText]()
    for part in parts(said, language, _as_it_is):
        if isinstance(part, Neutral):
            neutral.append(part)
            words.append(RichText())
        else:
            words[-1] += part
    return words, neutral


_MARKS = " ;:,.()；：，。、（）"


def _both(first: RichText, second: RichText) -> RichText:
    """Words in both languages, with the marks of the first."""
    more = second.stripped(_MARKS)
    if not more or more == first.stripped(_MARKS):
        return first
    head, marks = first.cut(" :;,=")
    return head + " " + more + (marks or " ") if head.stripped(_MARKS) else (first or " ") + more + " "


def about(key: str, names: Sequence[object]) -> str:
    """The key of a sentence about several things, or of the sentence about a single one."""
    return key if len(names) > 1 else f"{key} one"


def joined(key: str, parts: Iterable[Said]) -> Said | Phrase:
    """Names or phrases, at least one, joined: the words of a key, with gaps ``first`` and ``second``, between each two.

    >>> str(joined("one and other", "ABC"))
    'A and B and C'
    """
    left: list[Said | Phrase] = [*parts]
    while len(left) > 1:  # two by two: a thousand names are ten phrases deep
        pairs = zip(left[::2], left[1::2], strict=False)
        left = [*(Phrase(key, first=first, second=second) for first, second in pairs), *left[len(left) & ~1 :]]
    return left[0]


def listed(names: Sequence[Said]) -> Said | Phrase | str:
    """Names or phrases as an argument of a sentence: a list with the marks of its language; "" where there is none.

    >>> say(Phrase("points", link="2", points=listed(["B", "C", "D"])))
    'mark B, C, D on link 2'
    """
    return joined("listed", names) if names else ""


def links_named(names: Sequence[object]) -> Phrase:
    """Links, one at least, by their names.

    >>> str(links_named(["2"])), str(links_named(["2", "3"]))
    ('link 2', 'links 2, 3')
    """
    return Phrase("links", links=listed(names)) if len(names) > 1 else Phrase("link of name", name=names[0])


def bodies_named(names: Sequence[str]) -> Phrase:
    """Links without the blocks of pins in slots; of blocks alone those at their pins; ``B/`` is a pin without them.

    >>> str(bodies_named(["2", "B/2"])), str(bodies_named(["P/1", "P/0"])), str(bodies_named(["B/"]))
    ('link 2', 'the blocks at P', 'the pin at B')
    """
    links = [name for name in names if "/" not in name]
    points = dict.fromkeys(name.split("/")[0] for name in names)
    if links:
        return links_named(links)
    key = "pin at point" if names[0].endswith("/") else about("blocks at points", names)
    return Phrase(key, points=listed([*points]))


def clauses(parts: Sequence[Wording]) -> Wording:
    """Clauses, at least one, with the marks of the language between them.

    >>> say(clauses(["known only to me", Phrase("give it once")]))
    'known only to me; give it once'
    """
    return joined("clauses", parts)


def from_others(sentence: Wording | Exception) -> Wording:
    """A sentence of another program (the operating system, the TOML parser, the command line), or that of its error,
    known by its words in the table of English; an unknown sentence stays as it is.

    >>> say(from_others("No such command 'drw'."), "zh"), say(from_others(OSError(13, "Permission denied")), "zh")
    ('没有命令“drw”', '没有权限')
    """
    if isinstance(sentence, Exception):
        first = next(iter(sentence.args), None)
        text = str(first if isinstance(sentence, KeyError) else sentence)
        sentence = getattr(sentence, "strerror", None) or (first if isinstance(first, Phrase) else text)
    if not isinstance(sentence, str):
        return sentence
    for key, pattern in _sentences_of_others():
        if match := pattern.fullmatch(sentence):
            gaps = {name: from_others(gap) for name, gap in match.groupdict().items()}
            return Phrase(key, **gaps | ({"near": listed(match["near"].split(", "))} if "near" in gaps else {}))
    return sentence


@cache
def _sentences_of_others() -> tuple[tuple[str, re.Pattern[str]], ...]:
    def pattern(text: str) -> re.Pattern[str]:
        parts = enumerate(re.split(r"\{(\w+)\}", text))
        written = (f"(?P<{part}>.+?)" if i % 2 else re.escape(part.format()) for i, part in parts)
        return re.compile("".join(written), re.DOTALL)

    return tuple((key, pattern(text)) for key, text in area("others").items())


def sense_of(turn: float) -> Phrase:
    """The sense of a turn, or of an angular rate, by its sign.

    >>> str(sense_of(-2.0))
    'clockwise'
    """
    return Phrase("clockwise" if turn < 0.0 else "counter-clockwise")


def class_of(order: int) -> Phrase | str:
    """The class of a group as a numeral of each language, Roman as far as the table goes."""
    return Phrase(f"class {order}") if f"class {order}" in _table("en") else str(order)


def word(key: str, language: str = "en", otherwise: str | None = None) -> str:
    """A heading or a term in a language; ``otherwise`` where the table does not have it."""
    return _table(language)[key] if otherwise is None else _table(language).get(key, otherwise)


def languages(language: str) -> tuple[str, ...]:
    """The languages of a sheet: `BOTH` means two.

    >>> languages("both"), languages("zh")
    (('en', 'zh'), ('zh',))
    """
    return ("en", "zh") if language == BOTH else (language,)
