"""From what the TOML parser gives to `SceneTables`: every wrong key and value of the file at once.

A wrong entry is reported and taken out, a misspelt key is reported and read as the key that was meant, and what
remains is a valid file, so that the questions asked later (do the names exist, do the lengths meet) can still be
asked of it.  ``Flaws`` remembers what was taken out, so that nothing is reported twice.

What is wrong with the form of a file, in sentences: from the findings of pydantic to ``Problem``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from numbers import Integral, Real
from typing import Any

from pydantic import ValidationError

from graphkin.errors import Problem, SceneError, did_you_mean
from graphkin.files import OwnTables, Tables
from graphkin.scene.file_keys import KeyPath, value_at
from graphkin.scene.file_table import FileTable, entries, key_of, keys_of
from graphkin.scene.form import SCENE, table_at
from graphkin.scene.names import Flaws
from graphkin.scene.tables import SceneTables
from graphkin.words import Phrase, Wording, from_others

__all__ = ["checked", "clause_of", "keys_at", "path_name", "plain", "shown"]

MOST_VALUES = 20_000
DEEPEST = 8
UNKNOWN = "unexpected_keyword_argument"


def plain(source: Mapping[Any, object] | FileTable) -> OwnTables:
    """Copy a mapping, or typed tables, to plain dict, list, str, bool, int and float, so that the form can be checked
    strictly.

    Raises SceneError where a key is no text, or where the tables are nested too deeply or too many to be a scene.
    """
    left = MOST_VALUES

    def copy(value: object, path: KeyPath) -> object:
        nonlocal left
        left -= 1
        if len(path) > DEEPEST:
            raise SceneError(
                Problem(
                    path_name(path[:4]),
                    Phrase("is nested more than levels deep", most=DEEPEST),
                    Phrase("a scene needs at most four"),
                )
            )
        if left < 0:
            raise SceneError(
                Problem(
                    Phrase("the file"),
                    Phrase("holds more than values", most=MOST_VALUES),
                    Phrase("a scene is one mechanism"),
                )
            )
        if isinstance(value, FileTable):
            value = entries(value)
        elif hasattr(value, "tolist"):  # arrays and numbers of NumPy
            value = value.tolist()
        if isinstance(value, Mapping):
            for key in value:
                if not isinstance(key, str | int) or str(key).startswith(("<", "[")):  # signs that pydantic's paths use
                    raise SceneError(
                        Problem(path_name(path), Phrase("has the key", key=f"{key!a:.60}"), Phrase("keys are words"))
                    )
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

    made = copy(source, ())
    assert isinstance(made, dict)
    return made


def checked(raw: OwnTables) -> tuple[SceneTables, list[Problem], Flaws]:
    """Check the form of a file.  Returns what is valid in it, the problems, and what was taken out for them.

    ``raw`` comes from ``plain`` and is changed: wrong entries are taken out of it.
    Raises SceneError where nothing is left to ask about.
    """
    problems: dict[KeyPath, Problem] = {}
    gone: set[KeyPath] = set()
    for _ in range(50):
        try:
            return SCENE.validate_python(raw), list(problems.values()), Flaws(frozenset(gone))
        except ValidationError as error:
            found = error.errors(include_url=False)
        for item in sorted(found, key=lambda e: e["type"] != UNKNOWN):
            loc: KeyPath = tuple(item["loc"])
            path = written_path(loc)
            if item["type"] == "missing" and value_at(raw, path) is not None:
                continue  # it was there under a misspelt name
            if path not in problems:
                problems[path] = sentence(loc, path, dict(item))
            meant = _meant(loc, raw) if item["type"] == UNKNOWN else None
            if meant is not None:
                _read_as(raw, path, meant)
            else:
                cut = _take_out(raw, _cut(path))
                if item["type"] != UNKNOWN or isinstance(item["input"], list | dict):
                    gone.add(cut)
        if "links" not in raw or raw["links"] == {}:
            break
    raise SceneError(*problems.values())


def _meant(loc: KeyPath, raw: OwnTables) -> str | None:
    """The key that a misspelt one stands for, where it is near and not written as well, or both are tables."""
    table = value_at(raw, written_path(loc[:-1]))
    near = get_close_matches(str(loc[-1])[:60], keys_at(loc[:-1]), n=1, cutoff=0.75)
    if not near or not isinstance(table, dict) or loc[-1] not in table:
        return None
    both = [table[loc[-1]], table.get(near[0])]
    return near[0] if near[0] not in table or all(isinstance(t, dict) for t in both) else None


def _cut(path: KeyPath) -> KeyPath:
    """The smallest entry of the file that can be taken out for something wrong at ``path``."""
    head = path[:1]
    if head == ("links",):
        return path[: 4 if len(path) > 2 and path[2] in ("at", "guides", "discs") else 3]
    if head == ("frame",):
        return path[: 3 if len(path) > 1 and path[1] in ("points", "guides", "discs") else 2]
    if head == ("driver",):
        if path[-1] in ("link", "slide"):  # without it the form of the driver is not known
            return head
        return path[: 3 if len(path) > 1 and isinstance(path[1], int) else 2]
    if head == ("cams",):
        return path[: 3 if len(path) > 2 and path[2] not in ("follower", "law", "base") else 2]
    inside = (
        "pins", "contacts", "gears", "sketch", "drawn", "printed", "sheet", "units", "masses", "loads", "springs",
        "positions", "loops", "scans",
    )  # fmt: skip
    return path[:2] if head and head[0] in inside else head


def _read_as(raw: OwnTables, path: KeyPath, key: str) -> None:
    """Move a misspelt entry to the key that is meant; a table is added to the one that is there."""
    table = value_at(raw, path[:-1])
    value = table[path[-1]]
    moved = {**value, **table[key]} if key in table else value
    renamed = {key if k == path[-1] else k: v for k, v in table.items()}
    table.clear()
    table.update({**renamed, key: moved})


def _take_out(raw: OwnTables, path: KeyPath) -> KeyPath:
    """Take an entry out, or where it is not there (a required key) the table that misses it; return its path."""
    table = value_at(raw, path[:-1])
    if isinstance(table, dict) and path[-1] in table:
        del table[path[-1]]
        return path
    return _take_out(raw, path[:-1]) if len(path) > 1 else path


_BARE = re.compile(r"[A-Za-z0-9_-]+")
_NOUNS = {"count": "count", "g": "gravity", "mass": "mass", "rate": "rate", "weight": "weight", "delta": "fluctuation"}
"""What must be positive, where it is no length."""
_KINDS = {
    "string_type": Phrase("a text is wanted"),
    "float_type": Phrase("a number is wanted"),
    "bool_type": Phrase("true or false is wanted"),
    "list_type": Phrase("a list is wanted"),
    "dict_type": Phrase("a table is wanted"),
    "dataclass_type": Phrase("a table is wanted"),
}


def shown(value: object) -> Wording:
    """A value as it would be written in the file, shortened.

    >>> shown(True), shown("AB"), shown([1, 2.5])
    ('true', '"AB"', '[1, 2.5]')
    """
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        text = value.encode("unicode_escape").decode() if not value.isprintable() else value
        return f'"{text[:57]}..."' if len(text) > 60 else f'"{text}"'
    if isinstance(value, float):
        return f"{value:.15g}"
    if isinstance(value, int):
        return str(value) if abs(value) < 10**20 else Phrase("a number of too many digits")
    if isinstance(value, list):
        inner = ", ".join(str(shown(v)) for v in value[:4]) + (", ..." if len(value) > 4 else "")
        return f"[{inner}]"
    if isinstance(value, dict):
        return Phrase("a table" if value else "an empty table")
    return str(value)[:60] if value is not None else Phrase("nothing")


def path_name(path: Iterable[str | int]) -> str:
    """A path as its name: ``links.3.length``; the second of several drivers is ``driver.2``."""
    parts = []
    for part in path:
        if isinstance(part, int):
            parts.append(str(part + 1))
        else:
            parts.append(part if _BARE.fullmatch(part) and len(part) <= 60 else str(shown(part)))
    return ".".join(parts) or "the file"


def written_path(loc: KeyPath) -> KeyPath:
    return tuple(part for part in loc if not (isinstance(part, str) and part.startswith("<")) and part != "[key]")


def keys_at(loc: KeyPath) -> dict[str, str]:
    """The keys that may stand in the table at ``loc``, with their descriptions."""
    table = table_at(loc)
    return {} if table is None else {key_of(f): f.metadata.get("description", "") for f in keys_of(table)}


def clause_of(description: str) -> str:
    """The description of a key as a clause of a problem."""
    return description[:1].lower() + description[1:].rstrip(".")


def sentence(loc: KeyPath, path: KeyPath, item: OwnTables) -> Problem:
    where, kind, value, ctx = path_name(path), item["type"], item["input"], item.get("ctx", {})
    if kind == "missing":
        wanted = from_others(clause_of(keys_at(loc[:-1]).get(str(loc[-1]), "")))
        if loc == ("links",):
            wanted = Phrase("a scene has moving links links.1 and so")
        elif loc[0] == "driver" and loc[-1] == "link":
            wanted = Phrase("write link 1 for a driven angle or slide")
        return Problem(where, Phrase("is missing"), wanted)
    if kind == UNKNOWN:
        return Problem(
            where, Phrase("unknown table") if isinstance(value, dict) else Phrase("unknown key"), _about_key(loc)
        )
    if "[key]" in loc:
        return Problem(where, Phrase("is no name here", value=shown(path[-1])), _name_rule(ctx))
    if kind == "form":
        return Problem(where, Phrase("found value", value=shown(value)), Phrase(item["msg"]))
    if kind in _KINDS:
        wanted = _KINDS[kind]
        if kind == "string_type" and isinstance(value, int | float) and not isinstance(value, bool):
            wanted = Phrase("a text stands in quotation marks", value=shown(value))
        elif kind == "float_type" and isinstance(value, str):
            wanted = Phrase("a number is written without quotation marks")
        return Problem(where, Phrase("found value", value=shown(value)), wanted)
    if kind == "literal_error":
        choices = re.findall(r"'([^']*)'", ctx["expected"])
        names = ", ".join(f'"{c}"' for c in choices) or str(ctx["expected"])
        wanted = Phrase("one of is possible" if len(choices) > 1 else "is possible", names=names)
        near = did_you_mean(value[:60], choices) if isinstance(value, str) else wanted
        if near.key == "did you mean":
            wanted = Phrase("list comma of two", first=wanted, second=near)
        return Problem(where, Phrase("found value", value=shown(value)), wanted)
    if kind == "finite_number":
        return Problem(where, Phrase("found value", value=shown(value)), Phrase("a finite number is wanted"))
    if kind == "greater_than_equal":
        if ctx["ge"] > 0:
            key = "found a negative" if value < 0 else "found a zero" if value == 0 else "found far too small a"
            last = str(path[-1])
            noun = Phrase(f"noun {'scale' if last.endswith('scale') else _NOUNS.get(last, 'length')}")
            return Problem(where, Phrase(key, value=shown(value), noun=noun), Phrase("a must be positive", noun=noun))
        return Problem(
            where,
            Phrase("found value", value=shown(value)),
            Phrase("no number of a scene may be below", limit=f"{ctx['ge']:g}"),
        )
    if kind == "less_than_equal":
        return Problem(
            where,
            Phrase("found value", value=shown(value)),
            Phrase("no number of a scene may exceed", limit=f"{ctx['le']:g}"),
        )
    if kind in ("too_short", "too_long"):
        return Problem(where, *_about_size(loc, value))
    if kind == "string_too_long":
        return Problem(
            where,
            Phrase("is characters long", count=len(value)),
            Phrase("at most are possible", limit=ctx["max_length"]),
        )
    if kind == "string_pattern_mismatch":
        return Problem(where, Phrase("is no name here", value=shown(value)), _name_rule(ctx))
    return Problem(where, Phrase("found value", value=shown(value)), from_others(str(item["msg"])))


def _about_key(loc: KeyPath) -> Wording:
    key, here, top = str(loc[-1])[:60], keys_at(loc[:-1]), keys_at(())
    if key in top and len(loc) > 1:
        return (
            Phrase("belongs at the top of the file before", key=key)
            if key in ("title", "title_zh", "source", "source_zh", "find")
            else Phrase("is a table of its own", key=key)
        )
    if loc[0] == "driver" and key == "slide":
        return Phrase("a driver has either link a driven angle")
    return did_you_mean(key, here)


def _about_size(loc: KeyPath, value: object) -> tuple[Wording, Wording]:
    if loc == ("links",):
        return Phrase("there is none"), Phrase("a scene has moving links links.1 and so")
    wanted = {
        "on": Phrase("one guide or two are possible"),
        "in": Phrase("one guide or two are possible"),
        "angle_on": Phrase("one number for each guide is wanted"),
        "from": Phrase("two points of the link are wanted"),
        "r": Phrase("two lengths are wanted one for each point"),
        "driver": Phrase("two values of the driver are wanted"),
        "between": Phrase("two outlines or wheels are wanted 1.k 2.f"),
        "teeth": Phrase("two are wanted one for each wheel 20"),
    }
    return Phrase("found value", value=shown(value)), wanted.get(str(written_path(loc)[-1]), Phrase("a place is x y"))


def _name_rule(ctx: Tables) -> Wording:
    pattern = str(ctx.get("pattern", ""))
    if "max_length" in ctx:
        return Phrase("a name has at most letters and digits", limit=ctx["max_length"])
    if r"\." in pattern:
        return Phrase("a guide is written link for the link's")
    if "/" in pattern:
        return Phrase("a sliding pair is written link or sliding")
    if "A-Z][" in pattern:
        return Phrase("a point is named by a capital letter")
    return Phrase("a link or guide is named by letters")
