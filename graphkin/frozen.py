"""Frozen dataclasses as of `dataclasses`, made in a fifth of the time: the check of a scene waits for two hundred.

`dataclasses` writes and compiles six functions for a frozen class.  Here one is, which takes the values of the fields;
what shows, compares and hashes them and refuses a change are closures over their names.
"""

from __future__ import annotations

import dataclasses
from dataclasses import MISSING, FrozenInstanceError
from operator import attrgetter
from reprlib import recursive_repr

TYPE_CHECKING = False  # that of typing, without waiting for typing
if TYPE_CHECKING:
    from collections.abc import Callable
    from dataclasses import dataclass
    from typing import Any

__all__ = ["dataclass"]


class _Factory:
    """Stands in a signature for a value that is made where none is given."""

    def __repr__(self) -> str:
        return "<factory>"


_FACTORY = _Factory()


def _dataclass(
    cls: type | None = None, /, *, frozen: bool = False, eq: bool = True, repr: bool = True, kw_only: bool = False,
    **more: bool,
) -> Any:  # fmt: skip
    """The decorator of `dataclasses`: the same options, the same classes; those not frozen are left to it."""
    if cls is None:
        return lambda cls: _dataclass(cls, frozen=frozen, eq=eq, repr=repr, kw_only=kw_only, **more)
    if not frozen or more:
        return dataclasses.dataclass(cls, frozen=frozen, eq=eq, repr=repr, kw_only=kw_only, **more)
    dataclasses.dataclass(cls, init=False, repr=False, eq=False, kw_only=kw_only)  # finds the fields
    fields = dataclasses.fields(cls)
    methods: dict[str, Callable[..., Any]] = {
        "__init__": _init(cls, fields), "__setattr__": _set, "__delattr__": _delete,
    }  # fmt: skip
    if repr:
        methods["__repr__"] = _repr([f.name for f in fields if f.repr])
    if eq:
        methods["__eq__"], methods["__hash__"] = _comparing(fields)
    for name, method in methods.items():
        if cls.__dict__.get(name) is None:  # that of a class which says how it compares: its hash is None
            setattr(cls, name, method)
    return cls


def _init(cls: type, fields: tuple[dataclasses.Field[Any], ...]) -> Callable[..., None]:
    """Takes a value for each field, in the order of the fields; those by keyword alone come last."""
    known: dict[str, Any] = {"_factory": _FACTORY}
    taken: dict[bool, list[str]] = {False: [], True: []}
    lines = ["_own = self.__dict__"]
    for f in fields:
        name, value = f.name, f.name
        if f.default_factory is not MISSING:
            known[f"_make_{name}"] = f.default_factory
            value = f"_make_{name}() if {name} is _factory else {name}" if f.init else f"_make_{name}()"
            usual = "=_factory"
        elif f.default is not MISSING:
            known[f"_usual_{name}"] = f.default
            usual = f"=_usual_{name}"
        else:
            usual = ""
        if f.init:
            taken[bool(f.kw_only)].append(name + usual)
        elif f.default_factory is MISSING:
            continue  # is set later, or stays that of the class
        lines.append(f"_own[{name!r}] = {value}")
    if hasattr(cls, "__post_init__"):
        lines.append("self.__post_init__()")
    parameters = ", ".join(["self", *taken[False], *(["*", *taken[True]] if taken[True] else [])])
    exec(f"def __init__({parameters}):\n " + "\n ".join(lines), known)
    made: Callable[..., None] = known["__init__"]
    made.__qualname__ = f"{cls.__qualname__}.__init__"
    made.__annotations__ = {**{f.name: f.type for f in fields if f.init}, "return": None}
    return made


def _set(self: object, name: str, value: object) -> None:
    raise FrozenInstanceError(f"cannot assign to field {name!r}")


def _delete(self: object, name: str) -> None:
    raise FrozenInstanceError(f"cannot delete field {name!r}")


def _repr(names: list[str]) -> Callable[[object], str]:
    @recursive_repr()
    def __repr__(self: object) -> str:
        return f"{type(self).__qualname__}({', '.join(f'{name}={getattr(self, name)!r}' for name in names)})"

    return __repr__


def _comparing(fields: tuple[dataclasses.Field[Any], ...]) -> tuple[Callable[..., bool], Callable[..., int]]:
    compared = _values([f.name for f in fields if f.compare])
    hashed = _values([f.name for f in fields if (f.compare if f.hash is None else f.hash)])

    def __eq__(self: object, other: object) -> bool:
        return compared(self) == compared(other) if other.__class__ is self.__class__ else NotImplemented

    def __hash__(self: object) -> int:
        return hash(hashed(self))

    return __eq__, __hash__


def _values(names: list[str]) -> Callable[[object], tuple[Any, ...]]:
    if len(names) > 1:
        return attrgetter(*names)
    return lambda self: tuple([getattr(self, name) for name in names])


if not TYPE_CHECKING:
    dataclass = _dataclass
