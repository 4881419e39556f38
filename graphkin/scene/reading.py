"""From what the TOML parser gives to a ``SceneFile``: every wrong key and value of the file at once.

A wrong entry is reported and taken out, a misspelt key is reported and read as the key that was meant, and what
remains is a valid file, so that the questions asked later (do the names exist, do the lengths meet) can still be
asked of it.  ``Flaws`` remembers what was taken out, so that nothing is reported twice.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from numbers import Integral, Real
from typing import Any

from pydantic import ValidationError

from graphkin.errors import Problem, SceneError
from graphkin.scene.file import SceneFile
from graphkin.scene.sentences import Path, keys_at, path_name, sentence, written_path

__all__ = ["Flaws", "checked", "plain"]

MOST_VALUES = 20_000
DEEPEST = 8


@dataclass(frozen=True)
class Flaws:
    """The paths of the entries that were reported and taken out of the file."""

    paths: frozenset[Path] = frozenset()

    def under(self, *prefix: str) -> bool:
        """True where something at or under this path, or a table that holds it, was taken out."""
        n = len(prefix)
        return any(p[:n] == prefix or p == prefix[: len(p)] for p in self.paths)

    def names(self, *table: str) -> set[str]:
        """The names of the entries of a table that were taken out as a whole."""
        n = len(table)
        return {str(p[n]) for p in self.paths if len(p) == n + 1 and p[:n] == table}


def plain(source: Mapping[Any, Any]) -> dict[str, Any]:
    """Copy a mapping to plain dict, list, str, bool, int and float, so that the form can be checked strictly.

    Raises SceneError where a key is no text, or where the tables are nested too deeply or too many to be a scene.
    """
    left = MOST_VALUES

    def copy(value: Any, path: Path) -> Any:
        nonlocal left
        left -= 1
        if len(path) > DEEPEST:
            raise SceneError(Problem(path_name(path[:4]), f"is nested more than {DEEPEST} levels deep",
                                     "a scene needs at most four"))
        if left < 0:
            raise SceneError(Problem("the file", f"holds more than {MOST_VALUES} values", "a scene is one mechanism"))
        if isinstance(value, Mapping):
            for key in value:
                if not isinstance(key, str | int) or str(key).startswith(("<", "[")):  # signs that pydantic's paths use
                    raise SceneError(Problem(path_name(path), f"has the key {key!a:.60}", "keys are words"))
            return {str(key): copy(item, (*path, str(key))) for key, item in value.items()}
        if isinstance(value, list | tuple):
            return [copy(item, (*path, i)) for i, item in enumerate(value)]
        if isinstance(value, bool):
            return value
        if isinstance(value, str):
            return str(value)
        if isinstance(value, Integral):
            whole = int(value)
            return whole if abs(whole) < 10**300 else math.inf if whole > 0 else -math.inf
        if isinstance(value, Real):
            return float(value)
        return value

    made: dict[str, Any] = copy(source, ())
    return made


def checked(raw: dict[str, Any]) -> tuple[SceneFile, list[Problem], Flaws]:
    """Check the form of a file.  Returns what is valid in it, the problems, and what was taken out for them.

    ``raw`` comes from ``plain`` and is changed: wrong entries are taken out of it.
    Raises SceneError where nothing is left to ask about.
    """
    problems: dict[Path, Problem] = {}
    gone: set[Path] = set()
    for _ in range(50):
        try:
            return SceneFile.model_validate(raw), list(problems.values()), Flaws(frozenset(gone))
        except ValidationError as error:
            found = error.errors(include_url=False)
        for item in sorted(found, key=lambda e: e["type"] != "extra_forbidden"):
            loc: Path = tuple(item["loc"])
            path = written_path(loc)
            if item["type"] == "missing" and _value_at(raw, path) is not None:
                continue  # it was there under a misspelt name
            if path not in problems:
                problems[path] = sentence(loc, path, dict(item))
            meant = _meant(loc, raw) if item["type"] == "extra_forbidden" else None
            if meant is not None:
                _read_as(raw, path, meant)
            else:
                cut = _take_out(raw, _cut(path))
                if item["type"] != "extra_forbidden" or isinstance(item["input"], list | dict):
                    gone.add(cut)
        if "links" not in raw or raw["links"] == {}:
            break
    raise SceneError(*problems.values())


def _meant(loc: Path, raw: dict[str, Any]) -> str | None:
    """The key that a misspelt one stands for, where it is near and not written as well, or both are tables."""
    table = _value_at(raw, written_path(loc[:-1]))
    near = get_close_matches(str(loc[-1])[:60], keys_at(loc[:-1]), n=1, cutoff=0.75)
    if not near or not isinstance(table, dict) or loc[-1] not in table:
        return None
    both = [table[loc[-1]], table.get(near[0])]
    return near[0] if near[0] not in table or all(isinstance(t, dict) for t in both) else None


def _cut(path: Path) -> Path:
    """The smallest entry of the file that can be taken out for something wrong at ``path``."""
    head = path[:1]
    if head == ("links",):
        return path[: 4 if len(path) > 2 and path[2] in ("at", "guides") else 3]
    if head == ("frame",):
        return path[: 3 if len(path) > 1 and path[1] in ("points", "guides") else 2]
    if head == ("driver",):
        if path[-1] in ("link", "slide"):  # without it the form of the driver is not known
            return head
        return path[: 3 if len(path) > 1 and isinstance(path[1], int) else 2]
    return path[:2] if head and head[0] in ("pins", "sketch", "drawn", "printed", "sheet", "units") else head


def _value_at(raw: Any, path: Path) -> Any:
    for part in path:
        if isinstance(raw, dict):
            raw = raw.get(part)
        elif isinstance(raw, list) and isinstance(part, int) and part < len(raw):
            raw = raw[part]
        else:
            return None
    return raw


def _read_as(raw: dict[str, Any], path: Path, key: str) -> None:
    """Move a misspelt entry to the key that is meant; a table is added to the one that is there."""
    table = _value_at(raw, path[:-1])
    value = table[path[-1]]
    moved = {**value, **table[key]} if key in table else value
    renamed = {key if k == path[-1] else k: v for k, v in table.items()}
    table.clear()
    table.update({**renamed, key: moved})


def _take_out(raw: dict[str, Any], path: Path) -> Path:
    """Take an entry out, or where it is not there (a required key) the table that misses it; return its path."""
    table = _value_at(raw, path[:-1])
    if isinstance(table, dict) and path[-1] in table:
        del table[path[-1]]
        return path
    return _take_out(raw, path[:-1]) if len(path) > 1 else path
