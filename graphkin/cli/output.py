"""The output of commands: JSON objects, tables, paths of files, and a progress bar for long work."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from graphkin.errors import Problem, Unsolvable, printable, some_of
from graphkin.files import json_text
from graphkin.words import Phrase, Wording, say

if TYPE_CHECKING:
    from rich.progress import Progress

    from graphkin.api.results import Result
    from graphkin.cli.options import Given


def show(text: str, err: bool = False) -> None:
    """Print lines of text, on stderr if they are no result; control characters are written out."""
    typer.echo("\n".join(map(printable, text.split("\n"))), err=err)


def asked_languages(arguments: Sequence[str]) -> tuple[str, ...]:
    """The languages that a command is asked for, English where none or an unknown one is given.

    >>> asked_languages(["draw", "four-bar", "--lang", "zh"]), asked_languages(["--lang=both"]), asked_languages([])
    (('zh',), ('en', 'zh'), ('en',))
    """
    from graphkin.words import BOTH, LANGUAGES, languages

    given, asked = "", list(arguments)
    for word, following in zip(asked, [*asked, ""][1:], strict=True):
        given = following if word == "--lang" else word[7:] if word.startswith("--lang=") else given
    return languages(given) if given in (*LANGUAGES, BOTH) else LANGUAGES[:1]


def complain(*faults: Problem | Wording) -> None:
    """Print on stderr problems, or deviations from the request, in the languages that the command is asked for."""
    for language in asked_languages(sys.argv[1:]):
        for fault in faults:
            text = fault.text(language) if isinstance(fault, Problem) else say(fault, language)
            show(f"graphkin: {text}", err=True)


def print_json(data: object) -> None:
    typer.echo(json_text(data))


def print_paths(paths: Iterable[Path]) -> None:
    """One path a line."""
    show("\n".join(str(path) for path in paths))


def print_table(heads: Sequence[str], rows: Sequence[Sequence[str]], right: tuple[int, ...] = ()) -> None:
    """A table, if there are rows; the columns of numbers named in ``right`` stand to the right.

    In a terminal it is fitted to the width; elsewhere each row is one line, however long.
    """
    if rows and sys.stdout.isatty():
        _show_table(heads, rows, right)
    elif rows:
        typer.echo(plain_table(heads, rows, right))


def plain_table(heads: Sequence[str], rows: Sequence[Sequence[str]], right: tuple[int, ...] = ()) -> str:
    """The lines of a table for a file or another program."""
    from rich.cells import cell_len  # the rest of rich takes longer to import than a check does

    heads, *rows = [list(map(printable, row)) for row in (heads, *rows)]
    widths = [max(cell_len(text) for text in column) for column in zip(heads, *rows, strict=True)]

    def line(cells: Sequence[str]) -> str:
        blanks = [" " * (width - cell_len(cell)) for cell, width in zip(cells, widths, strict=True)]
        placed = [f"{b}{c}" if i in right else f"{c}{b}" for i, (c, b) in enumerate(zip(cells, blanks, strict=True))]
        return f" {'   '.join(placed)} "

    rule = f" {'─' * (len(line([''] * len(widths))) - 2)} "
    return "\n".join([" " * len(rule), line(heads), rule, *map(line, rows), " " * len(rule)])


def _show_table(heads: Sequence[str], rows: Sequence[Sequence[str]], right: tuple[int, ...]) -> None:
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for i, head in enumerate(heads):
        table.add_column(head, justify="right" if i in right else "left", overflow="fold")
    for row in rows:
        table.add_row(*(Text(printable(cell)) for cell in row))
    Console().print(table)


@contextmanager
def answering(answer: Mapping[str, object] | Callable[[Unsolvable], Mapping[str, object]]) -> Iterator[None]:
    """Give an answer to a program also where the mechanism cannot be solved.

    Parameters
    ----------
    answer : what it says beside ok, status, reason and problems; or a function that makes all of it but these
    """
    try:
        yield
    except Unsolvable as error:
        error.answer = answer(error) if callable(answer) else {**answer, "status": error.status, "why": error.why}
        raise


def print_failed(status: str, problems: Iterable[Problem], answer: Mapping[str, object]) -> None:
    """What a program that asked for JSON reads of a command that failed, after what there is of its answer."""
    if "--json" in sys.argv[1:]:
        rows = [problem.data for problem in problems]
        print_json({**answer, "ok": False, "status": status, "problems": rows})


def finish(given: Given, result: Result, paths: Iterable[Path] = (), files: bool = False) -> None:
    """Print a result for programs, with ``files`` if written, or the paths for people; leave with 1 if it is not ok."""
    paths = list(paths)
    if given.json:
        data = result.data
        print_json({**data, "files": [str(path) for path in paths]} if files and isinstance(data, dict) else data)
    elif paths and not given.quiet:
        print_paths(paths)
    if not result.ok:
        raise typer.Exit(1)


def show_unused(heads: Sequence[str]) -> None:
    """Name the unused columns of a table."""
    if heads:
        complain(Phrase("columns left alone", names=some_of(heads)))


@contextmanager
def progress_bar(shown: bool, target: Path | None = None) -> Iterator[Callable[[int, int], None] | None]:
    """A progress bar on stderr, if that is a terminal and the work takes longer than a second.  Of a run that keeps its
    finished work in the folder ``target`` it is said after an interruption how to continue."""
    bar = None
    if shown and sys.stderr.isatty():
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

        columns = BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
        bar = Progress(*columns, console=Console(stderr=True), transient=True)
    try:
        yield _counting(bar) if bar else None
    except KeyboardInterrupt:
        if target is not None:
            complain(Phrase("interrupted what is done is kept in the", target=target))
        raise
    finally:
        if bar:
            bar.stop()


def _counting(bar: Progress) -> Callable[[int, int], None]:
    """Count the finished work on a bar, which is shown after a second."""
    task = bar.add_task("", total=None)
    started = time.monotonic()

    def count(done: int, total: int) -> None:
        if time.monotonic() - started > 1.0 and not bar.live.is_started:
            bar.start()
        bar.update(task, completed=done, total=total)

    return count
