"""What callers wish of figures, and files of a result: all of them in one folder, each whole or not at all."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from graphkin.errors import CallError, Problem, did_you_mean

__all__ = ["half_written", "known_wishes", "write_files"]

FORMATS = ("svg", "pdf", "png")
LANGUAGES = ("en", "zh", "both")
CONVENTIONS = ("chinese", "us", "british", "russian")


def known_wishes(formats: Sequence[str], language: str | None, convention: str | None) -> None:
    """Refuse formats, languages and conventions that there are not; None stands for the scene's own.

    Raises
    ------
    CallError : every wrong word, with the nearest right one
    """
    wishes: list[tuple[str, str, tuple[str, ...]]] = [("format", word, FORMATS) for word in formats or ("",)]
    wishes += [("lang", language, LANGUAGES)] if language is not None else []
    wishes += [("convention", convention, CONVENTIONS)] if convention is not None else []
    wrong = [(where, word, known) for where, word, known in wishes if word not in known]
    if wrong:
        raise CallError(*(Problem(where, f'"{word}"', did_you_mean(word, known)) for where, word, known in wrong))


def write_files(folder: Path, files: Mapping[str, bytes]) -> list[Path]:
    """Write files by name into a folder, which is made if it is not there; returns their paths.

    Raises
    ------
    CallError : the folder cannot be written
    """
    from graphkin.drawing.save import write_whole

    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in files.items():
            write_whole(folder / name, content)
    except OSError as error:
        where = Problem(str(folder), f"cannot be written: {error.strerror}", "give another folder with -o")
        raise CallError(where) from None
    return [folder / name for name in files]


def half_written(folder: Path, stem: str) -> list[Path]:
    """What a process that was killed while writing files of this stem has left in a folder."""
    pattern = re.compile(rf"\.{re.escape(stem)}-.*\.[a-z0-9_]{{8}}")
    return [path for path in folder.glob(".*") if pattern.fullmatch(path.name)]
