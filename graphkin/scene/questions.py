"""What a scene asks for, what was published about it, and the points that it sketches or draws."""

from __future__ import annotations

from graphkin.errors import Problem
from graphkin.scene.file import SceneFile
from graphkin.scene.names import Names
from graphkin.scene.sentences import path_name
from graphkin.scene.symbol import Symbol

__all__ = ["asked", "published", "unknown_places"]


def _symbol(where: str, text: str, names: Names) -> Symbol | Problem:
    """A symbol whose point and links exist, or what is wrong with it."""
    try:
        symbol = Symbol.parse(text[:120])
    except ValueError as error:
        return Problem(where, str(error))
    if symbol.of is None:
        return names.no_link(where, symbol.link) or symbol
    for ref in (symbol.of, symbol.to):
        if ref is not None:
            missing = names.no_point(where, ref.point) or (names.no_link(where, ref.link) if ref.link else None)
            if missing:
                return missing
    if symbol.to == symbol.of:
        return Problem(where, f'"{text}" is relative to itself', "name two different points")
    if symbol.kind in ("ak", "ar") and symbol.to and symbol.to.point != symbol.of.point:
        return Problem(where, f'"{text}" names two different points',
                       f"it is between coincident points of two links, for example {symbol.kind}_B@3/B@2")
    return symbol


def asked(file: SceneFile, names: Names, problems: list[Problem]) -> tuple[Symbol, ...]:
    """The symbols of ``find``, each once, in its order."""
    found = [_symbol(path_name(("find", text)), text, names) for text in file.find or ()]
    problems += [s for s in found if isinstance(s, Problem)]
    return tuple(dict.fromkeys(s for s in found if isinstance(s, Symbol)))


def published(
    file: SceneFile, names: Names, metres: float, problems: list[Problem]
) -> dict[Symbol, float | complex]:
    """The values of ``[printed]`` in SI: vectors times ``metres``, angular rates as they are."""
    values: dict[Symbol, float | complex] = {}
    for text, value in file.printed.items():
        where = path_name(("printed", text))
        symbol = _symbol(where, text, names)
        if isinstance(symbol, Problem):
            problems.append(symbol)
        elif isinstance(value, list):
            if symbol.is_vector:
                values[symbol] = complex(*value) * metres
            else:
                problems.append(Problem(where, "found two numbers", "an angular rate is one number"))
        else:
            values[symbol] = float(value) * metres if symbol.is_vector else float(value)
    return values


def unknown_places(file: SceneFile, names: Names) -> list[Problem]:
    """Sketched and drawn points that no link has."""
    wanted = [(f"{table}.{point}", point) for table in ("sketch", "drawn") for point in getattr(file, table)]
    return [p for where, point in wanted if (p := names.no_point(where, point))]
