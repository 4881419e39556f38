"""The text of a scene, changed by key: comments, order and layout of the rest stay as they were written."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, get_args

from graphkin.errors import CallError, Problem, SceneError, some_of
from graphkin.files import Json, OwnTables, Tables
from graphkin.scene.scene import LARGEST_FILE, parsed
from graphkin.scene.scene_tables import SCENE, Convention
from graphkin.scene.tables import item_of
from graphkin.words import LANGUAGES, Phrase, Wording

MOST_CHANGES = 500


def changed(text: str, changes: Mapping[str, Json]) -> str:
    """The text with values put at keys (with dots, list items counted from 1: ``frame.points.D.1``).

    Parameters
    ----------
    text : of a scene file
    changes : value by key; None removes the entry.  Missing tables are made.

    Raises
    ------
    SceneError : the text is no TOML; CallError : a key that leads through a value
    """
    import tomlkit
    from tomlkit.exceptions import TOMLKitError

    parsed(text)  # its sentences name the line
    if len(changes) > MOST_CHANGES:
        raise CallError.of("changes", "found value", "at most at once", value=len(changes), most=MOST_CHANGES)
    try:
        document = tomlkit.parse(text)
        for key, value in changes.items():
            _put(document, key, value)
        made = tomlkit.dumps(document).rstrip() + "\n"
    except (TOMLKitError, TypeError, ValueError, KeyError) as error:
        raise CallError.of(some_of([*changes]), "cannot be changed", error=str(error)[:180]) from None
    if len(made) > LARGEST_FILE:
        raise CallError.of(Phrase("the file"), "would be larger than kb", largest=LARGEST_FILE // 1000)
    return made


def _put(document: Any, key: str, value: Any) -> None:
    import tomlkit

    parts = key.split(".")
    place: Any = document
    for depth, part in enumerate(parts[:-1]):
        if isinstance(place, list):
            place = place[_index(place, part, key)]
        elif hasattr(place, "keys"):
            if part not in place:
                if value is None:
                    return
                named = SCENE.holds_tables(parts[0])
                short = depth > 1 or (depth == 1 and not named)
                place[part] = tomlkit.inline_table() if short else tomlkit.table(is_super_table=named and not depth)
            place = place[part]
        else:
            raise CallError.of(key, "has nothing inside", names='.'.join(parts[:depth]))
    last = parts[-1]
    if isinstance(place, list):
        place[_index(place, last, key)] = value
    elif not hasattr(place, "keys"):
        raise CallError.of(key, "has nothing inside", names='.'.join(parts[:-1]))
    elif value is None:
        if last in place:
            del place[last]
    else:
        _set(place, last, value, top=len(parts) == 1)


def _set(place: Any, last: str, value: Any, top: bool = False) -> None:
    """Put a value and keep its comment; short tables stay on one line."""
    import tomlkit

    item: Any
    if isinstance(value, Mapping):
        nested = any(isinstance(part, Mapping) for part in value.values())
        small = len(value) <= 4 and "points" not in value and not nested
        item = tomlkit.inline_table() if _is_inline(place) or (small and not top) else tomlkit.table()
        if _is_inline(item):
            item.update(value)
        else:
            for name, part in value.items():
                _set(item, str(name), part)
            item.add(tomlkit.nl())  # a line is left free before the next head
    else:
        item = tomlkit.item(value)
        if hasattr(old := place.get(last), "trivia"):
            vars(item.trivia).update(vars(old.trivia))
    if _is_inline(place) and place and last not in place and not place.as_string().endswith(" }"):
        item.trivia.indent = " "  # behind the comma
    place[last] = item


def _is_inline(place: Any) -> bool:
    from tomlkit.items import InlineTable

    return isinstance(place, InlineTable)


def _index(place: list[Any], part: str, key: str) -> int:
    index = item_of(part, len(place))
    if index is None:
        raise CallError.of(key, "there is no item", "it has counted from 1", part=part, count=len(place))
    return index


# where things stand

_KEY = r"""(?:[A-Za-z0-9_-]+|"[^"]*"|'[^']*')"""
_HEAD = re.compile(rf"^\s*\[\[?\s*({_KEY}(?:\s*\.\s*{_KEY})*)\s*\]\]?")
_ENTRY = re.compile(rf"^(\s*)({_KEY}(?:\s*\.\s*{_KEY})*)\s*=")


def places(text: str) -> dict[str, int]:
    """The line (from 1) at which each key of a TOML text stands; keys with dots, the second driver is ``driver.2``.

    Texts that are no TOML are read line by line where possible.

    >>> places('[links.1]\\npoints = ["A", "B"]\\nlength = 150')
    {'links.1': 1, 'links.1.points': 2, 'links.1.length': 3}
    """
    lines: dict[str, int] = {}
    head: tuple[str, ...] = ()
    counts: dict[str, int] = {}
    for number, line in enumerate(text.splitlines(), 1):
        if table := _HEAD.match(line):
            head = _parts(table[1])
            if line.lstrip().startswith("[["):
                name = ".".join(head)
                counts[name] = counts.get(name, 0) + 1
                if counts[name] > 1:
                    head = (*head, str(counts[name]))
            lines.setdefault(".".join(head), number)
            continue
        if entry := _ENTRY.match(line):
            path = (*head, *_parts(entry[2]))
            lines.setdefault(".".join(path), number)
            opened = line.find("{", entry.end())
            if opened >= 0:
                _inside(line[opened:], path, number, lines)
    return lines


def _parts(name: str) -> tuple[str, ...]:
    return tuple(part.strip().strip("\"'") for part in re.findall(_KEY, name))


def _inside(line: str, path: tuple[str, ...], number: int, lines: dict[str, int]) -> None:
    """Keys of tables in braces, which stand on one line."""
    stack = [path]
    for piece in re.finditer(rf"({_KEY}(?:\s*\.\s*{_KEY})*)\s*=\s*(\{{)?|[{{}}]|\"[^\"]*\"", line):
        if piece[1]:
            inner = (*stack[-1], *_parts(piece[1]))
            lines.setdefault(".".join(inner), number)
            if piece[2]:
                stack.append(inner)
        elif piece[0] == "}" and len(stack) > 1:
            stack.pop()


_POINT = ("sketch.{point}", "frame.points.{point}", "frame")
_PLACES: Mapping[str, tuple[str, ...]] = {
    "link": ("links.{name}",), "link of name": ("links.{name}",), "links": ("links.{links}",),
    "point": _POINT, "point of point": _POINT, "status mobility": ("links",),
    "driver of driver": ("driver",), "driver of key and name": ("driver",),
}
"""The keys of a text that a phrase about a link, a point, a driver stands for."""


def line_of(problem: Problem, text: str) -> int:
    """The line (from 1) of a problem: of its key, or of the nearest table that holds it; 0 for the whole text."""
    where = problem.where
    known = places(text)
    keys = [str(where)]
    if isinstance(where, Phrase):
        if where.key == "line":
            return int(str(where.gaps["line"]))
        names = {gap: _first(name) for gap, name in where.gaps.items()}
        keys = [key.format_map(names) for key in _PLACES.get(where.key, ())]
    for key in keys:
        holder = key
        while holder:
            if holder in known:
                return known[holder]
            holder = holder.rpartition(".")[0]
    return 0


def _first(names: object) -> object:
    """The first of some names."""
    return _first(names.gaps["first"]) if isinstance(names, Phrase) and "first" in names.gaps else names


# what may be written


def completions(text: str, line: int, column: int) -> list[dict[str, Wording]]:
    """The words that may stand at a place of the text: keys of its table, or names of tables, points, links, guides.

    Parameters
    ----------
    line, column : from 1 and from 0, of the cursor

    Returns
    -------
    label and detail of each, the detail as a clause in any language
    """
    lines = text.split("\n")
    before = lines[line - 1][:column] if 0 < line <= len(lines) else ""
    head: tuple[str, ...] = ()
    for above in lines[: line - 1]:
        if table := _HEAD.match(above):
            head = _parts(table[1])
    if re.match(r"^\s*\[\[?[^\]]*$", before):
        tables = SCENE.keys_at(())
        return [{"label": name, "detail": tables[name]} for name in sorted(tables)]
    entry = _ENTRY.match(before)
    if entry is None:
        by_kind = [("driver", "<one>", kind) for kind in ("<angle>", "<slide>")]
        paths = by_kind if head[:1] == ("driver",) else [head]
        keys = {key: detail for path in paths for key, detail in SCENE.keys_at(path).items()}
        return [{"label": key, "detail": detail} for key, detail in keys.items()]
    names = _names(text, head, _parts(entry[2])[-1], before.count('"') % 2 == 1)
    return [{"label": name, "detail": ""} for name in names]


def _names(text: str, head: tuple[str, ...], key: str, quoted: bool) -> list[str]:
    try:
        made = parsed(text)
    except SceneError:
        made = {}
    links, (fixed, _) = table_in(made, "links"), frame_in(made)
    if key in ("points", "from", "through", "toward"):
        names = points_in(made)
    elif key in ("on", "in"):
        guides = {fixed: table_in(made, "frame"), **links}
        names = {*links} | {f"{name}.{guide}" for name, link in guides.items() for guide in table_in(link, "guides")}
    elif key in ("link", "of", "relative_to"):
        names = set(links)
    elif key == "length" and head == ("units",):
        names = {"mm", "cm", "m", "in", "ft"}
    else:
        names = {"convention": set(get_args(Convention)), "language": set(LANGUAGES),
                 "sense": {"clockwise", "counter-clockwise"}}.get(key, set())
    return sorted(names if quoted else {f'"{name}"' for name in names})


# what a text names, whatever is still missing


def table_in(made: object, name: str) -> OwnTables:
    """A table of a mapping, empty where there is none."""
    table = made.get(name) if isinstance(made, Mapping) else None
    return dict(table) if isinstance(table, Mapping) else {}


def frame_in(made: Tables) -> tuple[str, OwnTables]:
    frame = table_in(made, "frame")
    return str(frame.get("name", "0")), table_in(frame, "points")


def names_in(value: object) -> list[str]:
    return [str(name) for name in value] if isinstance(value, list) else []


def points_in(made: Tables) -> set[str]:
    points = {*table_in(made, "sketch"), *table_in(made, "drawn"), *table_in(made, "pins"), *frame_in(made)[1]}
    for link in table_in(made, "links").values():
        if isinstance(link, Mapping):
            points |= {*names_in(link.get("points")), *table_in(link, "at")}
    return points
