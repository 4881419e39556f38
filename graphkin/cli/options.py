"""Every argument and option of the command line, declared once, in ``options.toml``; a command is a function of the
given values, with the names of its options."""

from __future__ import annotations

import inspect
import os
import tomllib
from collections.abc import Callable
from functools import cache, wraps
from pathlib import Path
from types import SimpleNamespace
from typing import Any, TypeVar

import typer

from graphkin.errors import CallError, Problem
from graphkin.words import BOTH, LANGUAGES

T = TypeVar("T")
At = float | str | dict[str, float] | None
"""Driver values as public functions take them."""
Texts = list[str] | None

KINDS: dict[str, Any] = {"text": str | None, "texts": Texts, "number": int | None, "path": Path | None}
FLAGS = {"out": ("-o", "--out"), "quiet": ("-q", "--quiet"), "browser": ()}
SPOKEN = {"lang": LANGUAGES, "lang of open": LANGUAGES, "lang of sheets": (*LANGUAGES, BOTH)}


def _declared(name: str, about: dict[str, Any]) -> inspect.Parameter:
    """An argument or an option as a parameter of a command.

    Parameters
    ----------
    about : its entry in ``options.toml``
    """
    word, how = name.split()[0], {"metavar": "|".join(SPOKEN.get(name, ())) or None, **about}
    is_argument, default, kind = how.pop("argument", False), how.pop("default", None), how.pop("kind", "")
    if how.pop("required", False):
        default, asked = ..., str
    else:
        asked = KINDS[kind] if kind else type(default)
    default = Path(default) if kind == "path" and default else default
    if is_argument:
        declared = typer.Argument(default, **how)
    else:
        declared = typer.Option(default, *FLAGS.get(word, (f"--{word}",)), **how)
    return inspect.Parameter(word, inspect.Parameter.KEYWORD_ONLY, default=declared, annotation=asked)


@cache
def _options() -> dict[str, dict[str, Any]]:
    return tomllib.loads((Path(__file__).parent / "options.toml").read_text(encoding="utf-8"))


class Given(SimpleNamespace):
    """The values given to a command, by the names of its options."""

    @property
    def values(self) -> At:
        """Driver values, or the name of a position."""
        return driver_values(getattr(self, "at", None), getattr(self, "position", None))

    @property
    def formats(self) -> list[str]:
        return split_words(self.format)

    def call(self, function: Callable[..., T], **others: Any) -> T:
        """The result of a public function for the given values: each of its parameters is the option of that name, with
        its default where no value was given; files are written later.

        Parameters
        ----------
        others : values of parameters that differ from their options
        """
        first, *names = inspect.signature(function).parameters
        given = {**vars(self), "at": self.values, "language": self.lang, "figures": getattr(self, "figure", None)}
        wishes = {name: given[name] for name in names if name != "out" and given.get(name) not in (None, "", [])}
        if "formats" in names:
            wishes["formats"] = self.formats
        return function(given[first], **wishes | others)

    @property
    def speaks(self) -> bool:
        """Whether it prints for people."""
        return not self.json and not self.quiet


Command = Callable[[Given], None]
"""A command: a function of the given values."""


def command(*names: str) -> Callable[[Command], Command]:
    """Name the options of a command.

    Parameters
    ----------
    names : of its options in ``options.toml``, in the order of the help
    """

    def named(run: Command) -> Command:
        vars(run)["options"] = names
        return run

    return named


def with_options(run: Command) -> Callable[..., None]:
    """A command with its options as parameters, for the command line."""

    @wraps(run)
    def called(**given: Any) -> None:
        run(Given(**given))

    called.__annotations__ = {}
    parameters = [_declared(name, _options()[name]) for name in vars(run)["options"]]
    called.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    return called


def split_words(words: str) -> list[str]:
    """Words between commas: formats.

    >>> split_words("svg, PDF,")
    ['svg', 'pdf']
    """
    return [word.strip().lower() for word in words.split(",") if word.strip()]


def driver_values(at: list[str] | None, position: str | None = None) -> At:
    """Driver values of the command line: DEG, or LINK=DEG; or the name of a position.

    >>> driver_values(["50"]), driver_values(["1=50", "2=30"])
    (50.0, {'1': 50.0, '2': 30.0})
    """
    if position is not None:
        if at:
            raise CallError.of("--position", "stands beside at of nothing", "write one of the two")
        return position
    if not at:
        return None
    named: dict[str, float] = {}
    for text in at:
        name, _, number = text.rpartition("=")
        try:
            value = float(number)
        except ValueError:
            raise CallError.of(f"--at {text}", "is no number", "write at 50 or at 1 50", number=number) from None
        if name in named:
            raise CallError.of("--at", "is given twice for one driver", "write at 1 50 at 2 30", text=text)
        named[name] = value
    if len(named) > 1 and "" in named:
        raise CallError.of("--at", "a bare value beside named ones", "write at 1 50 at 2 30")
    return named.get("", named)


def named_numbers(texts: list[str], wrong: Callable[[str, str], Problem]) -> dict[str, float]:
    """Numbers by name, as ``NAME=VALUE`` gives them.

    Parameters
    ----------
    wrong : the problem of a text without a number
    """
    numbers: dict[str, float] = {}
    for text in texts:
        name, _, number = text.partition("=")
        try:
            numbers[name.strip()] = float(number)
        except ValueError:
            raise CallError(wrong(text, number)) from None
    return numbers


def processes(workers: int | None) -> int | None:
    """The number of processes, by default the number of cores."""
    return workers if workers is not None else os.cpu_count()
