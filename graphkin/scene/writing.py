"""A scene written out again: as the mapping of a scene file, and as its text."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from typing import Any

from graphkin.plane import degrees
from graphkin.scene.model import AngleDriver, Driver, Link, Scene

__all__ = ["as_mapping", "toml_text"]

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_TABLES_OF_TABLES = ("links", "pins")


def as_mapping(scene: Scene) -> dict[str, Any]:
    """The mapping of a scene file that reads as this scene, everything placed in the links' own axes.

    What was given by drawn points, arcs or polar entries stands there as lengths and places.
    """

    def length(value: float) -> float:
        return _tidy(value / scene.units.metres)

    def place(z: complex) -> list[float]:
        return [length(z.real), length(z.imag)]

    def guides(link: Link) -> dict[str, Any]:
        own = {n: g for n, g in link.guides.items() if n}
        return {n: {"through": place(g.through), "angle": _tidy(degrees(g.direction))} for n, g in own.items()}

    frame: dict[str, Any] = {"name": scene.frame.name}
    frame["points"] = {p: place(z) for p, z in scene.frame.points.items()}
    frame["guides"] = guides(scene.frame)
    links: dict[str, dict[str, Any]] = {}
    for link in scene.links:
        table: dict[str, Any] = {"points": list(link.bar)} if link.bar else {}
        if link.length is not None:
            table["length"] = length(link.length)
        pairs = [s for s in scene.slidings if s.link == link.name]
        if pairs:
            table["on"] = [_guide_name(s.on, s.guide) for s in pairs]
            table["angle_on"] = [_tidy(degrees(s.turn)) for s in pairs]
        table["at"] = {p: place(z) for p, z in link.points.items() if p not in link.bar}
        table["guides"] = guides(link)
        if link.redundant:
            table["redundant"] = True
        links[link.name] = {k: v for k, v in table.items() if v != {}}
    pins: dict[str, dict[str, Any]] = {}
    for pin in scene.pins:
        pins.setdefault(pin.point, {"of": pin.of, "in": []})["in"].append(_guide_name(pin.on, pin.guide))
    made: dict[str, Any] = {"title": scene.title, "title_zh": scene.title_zh, "source": scene.source}
    made["units"] = {"length": scene.units.length}
    made["frame"] = {k: v for k, v in frame.items() if v != {}}
    made["links"] = links
    made["pins"] = pins
    made["driver"] = [_driver(scene, d, length) for d in scene.drivers]
    made["sketch"] = {p: place(z) for p, z in {**scene.drawn, **scene.sketch}.items() if _moves(scene, p)}
    made["find"] = [str(s) for s in scene.find]
    return {k: v for k, v in made.items() if v not in ("", {}, [])}


def _moves(scene: Scene, point: str) -> bool:
    return point not in scene.frame.points


def _guide_name(link: str, guide: str) -> str:
    return f"{link}.{guide}" if guide else link


def _driver(scene: Scene, driver: Driver, length: Any) -> dict[str, Any]:
    if isinstance(driver, AngleDriver):
        base = {} if driver.relative_to == scene.frame.name else {"relative_to": driver.relative_to}
        angle = _tidy(math.degrees(driver.angle))
        return {"link": driver.link, **base, "angle": angle, "omega": _tidy(driver.omega), "alpha": _tidy(driver.alpha)}
    travel, velocity, second = (length(v) for v in driver.values)
    return {"slide": driver.key, "travel": travel, "velocity": velocity, "acceleration": second}


def _tidy(value: float) -> float:
    """A number without the noise of unit conversion."""
    return float(f"{value:.13g}") + 0.0


def toml_text(mapping: Mapping[str, Any]) -> str:
    """The text of a scene file from its mapping; reading it gives the mapping again.

    >>> print(toml_text({"title": "A", "links": {"1": {"points": ["A", "B"], "length": 2.0}}}), end="")
    title = "A"
    <BLANKLINE>
    [links.1]
    points = ["A", "B"]
    length = 2
    """
    head = [f"{_key(k)} = {_value(v)}" for k, v in mapping.items() if not _is_table(v)]
    blocks = ["\n".join(head)] if head else []
    for name, value in mapping.items():
        if isinstance(value, Mapping) and name in _TABLES_OF_TABLES:
            blocks += [_table(f"[{_key(name)}.{_key(k)}]", v) for k, v in value.items()]
        elif isinstance(value, Mapping):
            blocks.append(_table(f"[{_key(name)}]", value))
        elif _is_table(value):
            blocks += [_table(f"[[{_key(name)}]]", v) for v in value]
    return "\n\n".join(blocks) + "\n"


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping) or (
        isinstance(value, list) and bool(value) and all(isinstance(v, Mapping) for v in value)
    )


def _table(head: str, table: Mapping[str, Any]) -> str:
    return "\n".join([head, *(f"{_key(k)} = {_value(v)}" for k, v in table.items())])


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _text(key)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }" if value else "{}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    return _text(str(value))
