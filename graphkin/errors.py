"""Errors as data: the place, the value found, the right form.

Text for the terminal, the notebook and the tests is made here and nowhere else.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

from graphkin.words import Phrase, Wording, clause_of, joined, listed, say, word

PAGE = 4000
"""Characters of a clause that are shown."""
MOST_NAMED = 12
_LONG_WORD = re.compile("[!-~\x00]{300,}")


@dataclass(frozen=True, init=False)
class Problem:
    """One problem.

    Parameters
    ----------
    where : its subject, by name as in the file ("links.3.length", "point D")
    found : the value found, as a clause: its id in the tables of words, or a phrase ("-5, a length must be positive")
    wanted : the right form, as a clause; empty where ``found`` is enough
    gaps : the values for the gaps of both, by their names

    >>> print(Problem("link 3", "link is the frame", "give one of them", name="3"))
    link 3: link 3 is the frame; give one of them
    """

    where: Wording
    found: Wording
    wanted: Wording

    def __init__(self, where: Wording, found: Wording, wanted: Wording = "", **gaps: object) -> None:
        vars(self).update(where=where, found=clause_of(found, gaps), wanted=clause_of(wanted, gaps))

    def __str__(self) -> str:
        return self.text()

    @property
    def data(self) -> dict[str, str | None]:
        """The problem for a program: its clauses in English, and ``id``, the key of ``found``, or of ``wanted`` where a
        name or a number was found, the same in every language; None where neither is of a table."""
        said = [clause.key for clause in (self.found, self.wanted) if isinstance(clause, Phrase)]
        return {
            "where": str(self.where), "found": str(self.found), "wanted": str(self.wanted),
            "id": said[0] if said else None,
        }

    @property
    def fact(self) -> Phrase:
        """What is wrong, without what would be right, as a phrase."""
        return Phrase("where and what", where=self.where, found=self.found)

    @property
    def sentence(self) -> Phrase:
        """The problem as a phrase."""
        return Phrase("and what is wanted", text=self.fact, wanted=self.wanted) if self.wanted else self.fact

    def text(self, language: str = "en") -> str:
        """The problem in a sentence of a language."""
        where, fault = (printable(_shortened(say(part, language))) for part in (self.where, self.found))
        # what would be right may be several lines, to be pasted
        wanted = "\n".join(map(printable, _shortened(say(self.wanted, language)).split("\n")))
        text = word("where and what", language).format(where=where, found=fault)
        return word("and what is wanted", language).format(text=text, wanted=wanted) if wanted else text


def _shortened(text: str) -> str:
    """A text that somebody wrote, with its overlong words cut, and no longer than a page."""
    text = _LONG_WORD.sub(lambda word: f"{word[0][:80]}…{word[0][-20:]}", text)
    return text if len(text) <= PAGE else f"{text[:PAGE]}…"


class GraphkinError(Exception):
    """The base of all errors that graphkin raises on purpose.  ``problems`` holds the facts, ``answer`` what a program
    reads beside them."""

    exit_code = 2
    status = "wrong"
    answer: Mapping[str, object] = {}

    def __init__(self, *problems: Problem) -> None:
        self.problems = problems
        super().__init__("\n".join(str(p) for p in problems))

    @classmethod
    def of(cls, where: Wording, found: Wording, wanted: Wording = "", **gaps: object) -> Self:
        """The error of one problem, by its clauses (see `Problem`)."""
        return cls(Problem(where, found, wanted, **gaps))

    def text(self, language: str = "en") -> str:
        """The problems in a language, a line for each."""
        return "\n".join(p.text(language) for p in self.problems)

    @property
    def reason(self) -> Wording:
        """The problems as a phrase of one line."""
        return joined("problem after problem", (problem.sentence for problem in self.problems))

    def __reduce__(self) -> tuple[type[GraphkinError], tuple[Problem, ...]]:
        return type(self), self.problems


class SceneError(GraphkinError):
    """The scene file gives no mechanism; every problem of the file is listed (exit status 2)."""

    status = "scene"


class CallError(GraphkinError):
    """The call is wrong: an unknown option value, an unknown scene or symbol (exit status 2)."""

    status = "call"


class Unsolvable(GraphkinError):
    """The mechanism cannot be solved as asked (exit status 3).

    ``status`` is one of "not assembled", "dead point", "mobility", "not drawn".
    """

    exit_code = 3

    def __init__(self, status: str, *problems: Problem) -> None:
        super().__init__(*problems)
        self.status = status

    def __reduce__(self) -> tuple[type[Unsolvable], tuple[object, ...]]:  # type: ignore[override]
        return type(self), (self.status, *self.problems)

    @property
    def why(self) -> str:
        """The reason in one line, in English."""
        return str(self.reason)


class Disagreement(GraphkinError):
    """A drawing that disagrees with the analytic solver: no paper is made of it (exit status 1)."""

    exit_code = 1
    status = "disagreement"


class NoDriver(Unsolvable):
    """The scene file names no driver of a mechanism that can move: a fault of the file (exit status 2)."""

    exit_code = 2


# C0 and C1 codes and DEL, ends of lines that are none on paper, and marks that turn the direction of writing
_CONTROL = re.compile("[\x00-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069\ud800-\udfff]")


def printable(text: str) -> str:
    """A text in one line without commands to a terminal: control characters are written out.

    >>> printable("a title \x1b[2J")
    'a title \\\\x1b[2J'
    """
    return _CONTROL.sub(lambda match: match[0].encode("unicode_escape", "surrogatepass").decode(), text)


def unfit(where: Wording, value: object, wanted: Wording, **gaps: object) -> CallError:
    """The error of a value of the wrong kind.

    >>> print(unfit("seed", [1], "give a whole number"))
    seed: found [1]; give a whole number
    """
    return CallError.of(where, "found value", wanted, **gaps, value=f"{value!r:.60}")


def as_text(where: str, value: object) -> str:
    """A caller's name as a text.  Raises CallError for numbers, lists and None.

    >>> as_text("link", "2")
    '2'
    """
    if not isinstance(value, str) and not type(value).__module__.startswith("graphkin."):  # a symbol
        raise unfit(where, value, "give a name as a text")
    return str(value)


def as_list(where: str, value: object, wanted: Wording) -> list[Any]:
    """A caller's items as a list; a text is one item.  Raises CallError for a value that is no list.

    >>> as_list("find", ("v_B", "v_C"), "give symbols"), as_list("find", "v_B", "give symbols")
    (['v_B', 'v_C'], ['v_B'])
    """
    try:
        return [value] if isinstance(value, str) else list(value)  # type: ignore[call-overload]
    except TypeError:
        raise unfit(where, value, wanted) from None


def some_of(names: Sequence[str]) -> Wording:
    """The first names of many, as an argument of a sentence.

    >>> str(some_of([*"ABCDEFGHIJKLMNO"]))
    'A, B, C, D, E, F, G, H, I, J, K, L, ...'
    """
    return listed([*names[:MOST_NAMED], *["..."] * (len(names) > MOST_NAMED)])


def did_you_mean(name: str, known: Iterable[str]) -> Phrase:
    """A clause that proposes the nearest known word, or names the known words if none is near.

    >>> print(did_you_mean("lenght", ["length", "points"]))
    did you mean "length"?
    >>> print(did_you_mean("Q", ["A", "B"]))
    known here: A, B
    """
    names = sorted(set(known))
    from difflib import get_close_matches  # of a slip only

    near = get_close_matches(name, names, n=1, cutoff=0.6)
    if not near:
        near = [n for n in names if n.lower() == name.lower()]
    if near:
        return Phrase("did you mean", name=near[0])
    return Phrase("known here", names=some_of(names)) if names else Phrase("there is none here")
