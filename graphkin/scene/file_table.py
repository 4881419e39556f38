"""What the tables of a scene file have in common: their keys, with what the reader and the schema know of each."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import MISSING, Field, fields
from typing import ClassVar

__all__ = ["FileTable", "about", "closed", "entries", "key_of", "keys_of"]


def about(description: str, **more: object) -> dict[str, object]:
    """What the reader and the schema know of a key beside its type."""
    return {"description": description, **more}


def closed(description: str) -> dict[str, object]:
    """The same of a table whose keys are names of a pattern: no others may stand in it."""
    return about(description, json_schema_extra={"additionalProperties": False})


class FileTable:
    """A table of a scene file."""

    __pydantic_config__: ClassVar = {"extra": "forbid", "defer_build": True}


def keys_of(table: FileTable | type[FileTable]) -> Iterator[Field[object]]:
    """The fields of a table that stand in a file."""
    for key in fields(table):  # type: ignore[arg-type]  # each table is a dataclass
        if not key.metadata.get("beside"):
            yield key


def key_of(key: Field[object]) -> str:
    """A field's key in the file."""
    return str(key.metadata.get("alias", key.name))


def entries(table: FileTable) -> dict[str, object]:
    """The keys of a table as they stand in a file, without those that say what holds anyway.

    >>> from graphkin.scene.tables import Link
    >>> entries(Link(points=["A", "B"], length=120))
    {'points': ['A', 'B'], 'length': 120}
    """
    found = {}
    for key in keys_of(table):
        value = getattr(table, key.name)
        usual = key.default_factory() if key.default_factory is not MISSING else key.default
        empty = usual in ({}, ()) and isinstance(value, Mapping | list | tuple) and not value
        if not empty and not (type(value) is type(usual) and value == usual):
            found[key_of(key)] = value
    return found
