"""Places in the tables of a scene file: by their path, or by their key with dots (``links.2.length``)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphkin.files import OwnTables, Tables

__all__ = ["KeyPath", "item_of", "path_of_key", "put_at", "value_at"]

KeyPath = tuple[str | int, ...]
"""A place in a file: keys, and numbers of items of lists."""


def item_of(part: str, count: int) -> int | None:
    """Which item of a list of so many a part of a key names: counted from 1, or ``x`` and ``y`` of a place.

    >>> item_of("2", 3), item_of("y", 2), item_of("0", 2), item_of("z", 3)
    (1, 1, None, None)
    """
    index = {"x": 0, "y": 1}.get(part, int(part) - 1 if part.isdecimal() else -1)
    return index if 0 <= index < count else None


def path_of_key(tables: Tables, key: str) -> KeyPath | None:
    """The path of a key with dots; None where there is nothing.

    >>> path_of_key({"frame": {"points": {"D": [3, 4]}}}, "frame.points.D.y")
    ('frame', 'points', 'D', 1)
    >>> path_of_key({"frame": {"points": {"D": [3, 4]}}}, "frame.points.E.y") is None
    True
    """
    path: list[str | int] = []
    place: object = tables
    for part in key.split("."):
        step = item_of(part, len(place)) if isinstance(place, list | tuple) else part
        place = None if step is None else value_at(place, (step,))
        if step is None or place is None:
            return None
        path.append(step)
    return tuple(path)


def value_at(place: object, path: KeyPath) -> Any:
    """What stands at a path of tables, or of a part of them; None where there is nothing.

    >>> value_at({"driver": [{"angle": 40}]}, ("driver", 0, "angle")), value_at({"driver": []}, ("driver", 0, "angle"))
    (40, None)
    """
    for step in path:
        if isinstance(place, Mapping):
            place = place.get(step)
        elif isinstance(place, list | tuple) and isinstance(step, int) and step < len(place):
            place = place[step]
        else:
            return None
    return place


def put_at(tables: OwnTables, path: KeyPath, value: object) -> None:
    """Put a value at a path whose tables are there.  Raises TypeError where they are not."""
    value_at(tables, path[:-1])[path[-1]] = value
