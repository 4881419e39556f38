"""What is wrong with the form of a file, in sentences: from the findings of pydantic to ``Problem``."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from pydantic import BaseModel

from graphkin.errors import Problem, did_you_mean
from graphkin.scene import file as tables

__all__ = ["Path", "keys_at", "path_name", "sentence", "shown", "written_path"]

Path = tuple[str | int, ...]
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_TABLES: tuple[tuple[tuple[str, ...], type[BaseModel]], ...] = (
    ((), tables.SceneFile),
    (("units",), tables.UnitsTable),
    (("frame",), tables.FrameTable),
    (("frame", "guides", "*"), tables.GuideTable),
    (("links", "*"), tables.LinkTable),
    (("links", "*", "guides", "*"), tables.GuideTable),
    (("links", "*", "at", "*", "<polar>"), tables.Polar),
    (("links", "*", "at", "*", "<compass>"), tables.Compass),
    (("pins", "*"), tables.PinTable),
    (("driver", "<one>", "<angle>"), tables.AngleDriverTable),
    (("driver", "<one>", "<slide>"), tables.SlideDriverTable),
    (("driver", "<list>", "*", "<angle>"), tables.AngleDriverTable),
    (("driver", "<list>", "*", "<slide>"), tables.SlideDriverTable),
    (("sheet",), tables.SheetTable),
)
_KINDS = {
    "string_type": "a text is wanted",
    "float_type": "a number is wanted",
    "bool_type": "true or false is wanted",
    "list_type": "a list is wanted",
    "dict_type": "a table is wanted",
    "model_type": "a table is wanted",
    "model_attributes_type": "a table is wanted",
}


def shown(value: object) -> str:
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
        return str(value) if abs(value) < 10**20 else "a number of too many digits"
    if isinstance(value, list):
        inner = ", ".join(shown(v) for v in value[:4]) + (", ..." if len(value) > 4 else "")
        return f"[{inner}]"
    if isinstance(value, dict):
        return "a table" if value else "an empty table"
    return str(value)[:60] if value is not None else "nothing"


def path_name(path: Iterable[str | int]) -> str:
    """A path as its name: ``links.3.length``; the second of several drivers is ``driver.2``."""
    parts = []
    for part in path:
        if isinstance(part, int):
            parts.append(str(part + 1))
        else:
            parts.append(part if _BARE.fullmatch(part) and len(part) <= 60 else shown(part))
    return ".".join(parts) or "the file"


def written_path(loc: Path) -> Path:
    return tuple(part for part in loc if not (isinstance(part, str) and part.startswith("<")) and part != "[key]")


def keys_at(loc: Path) -> dict[str, str]:
    """The keys that may stand in the table at ``loc``, with their descriptions."""
    for pattern, table in _TABLES:
        if len(pattern) == len(loc) and all(p in ("*", part) for p, part in zip(pattern, loc, strict=True)):
            return {f.alias or name: f.description or "" for name, f in table.model_fields.items()}
    return {}


def sentence(loc: Path, path: Path, item: dict[str, Any]) -> Problem:
    where, kind, value, ctx = path_name(path), item["type"], item["input"], item.get("ctx", {})
    if kind == "missing":
        text = keys_at(loc[:-1]).get(str(loc[-1]), "")
        if loc == ("links",):
            text = "a scene has moving links, [links.1] and so on"
        elif loc[0] == "driver" and loc[-1] == "link":
            text = 'write link = "1" for a driven angle or slide = "2" for a driven sliding pair'
        return Problem(where, "is missing", text[:1].lower() + text[1:].rstrip(".") if text else "")
    if kind == "extra_forbidden":
        return Problem(where, "unknown table" if isinstance(value, dict) else "unknown key", _about_key(loc))
    if "[key]" in loc:
        return Problem(where, f"{shown(path[-1])} is no name here", _name_rule(ctx))
    if kind == "form":
        return Problem(where, f"found {shown(value)}", item["msg"])
    if kind in _KINDS:
        wanted = _KINDS[kind]
        if kind == "string_type" and isinstance(value, int | float) and not isinstance(value, bool):
            wanted = f'a text stands in quotation marks: "{shown(value)}"'
        elif kind == "float_type" and isinstance(value, str):
            wanted = "a number is written without quotation marks"
        return Problem(where, f"found {shown(value)}", wanted)
    if kind == "literal_error":
        choices = re.findall(r"'([^']*)'", ctx["expected"])
        near = did_you_mean(value[:60], choices) if isinstance(value, str) else ""
        tail = f", {near}" if near.startswith("did") else ""
        words = ("one of " if len(choices) > 1 else "") + ", ".join(f'"{c}"' for c in choices)
        return Problem(where, f"found {shown(value)}", f"{words} is possible{tail}")
    if kind == "finite_number":
        return Problem(where, f"found {shown(value)}", "a finite number is wanted")
    if kind == "greater_than_equal":
        if ctx["ge"] > 0:
            what = "a negative" if value < 0 else "a zero" if value == 0 else "far too small a"
            noun = "scale" if str(path[-1]).endswith("scale") else "length"
            return Problem(where, f"found {shown(value)}, {what} {noun}", f"a {noun} must be positive")
        return Problem(where, f"found {shown(value)}", f"no number of a scene may be below {ctx['ge']:g}")
    if kind == "less_than_equal":
        return Problem(where, f"found {shown(value)}", f"no number of a scene may exceed {ctx['le']:g}")
    if kind in ("too_short", "too_long"):
        return Problem(where, *_about_size(loc, value))
    if kind == "string_too_long":
        return Problem(where, f"is {len(value)} characters long", f"at most {ctx['max_length']} are possible")
    if kind == "string_pattern_mismatch":
        return Problem(where, f"{shown(value)} is no name here", _name_rule(ctx))
    return Problem(where, f"found {shown(value)}", str(item["msg"]))


def _about_key(loc: Path) -> str:
    key, here, top = str(loc[-1])[:60], keys_at(loc[:-1]), keys_at(())
    if key in top and len(loc) > 1:
        return f"{key} belongs at the top of the file, before the first table" if key in (
            "title", "title_zh", "source", "find") else f"[{key}] is a table of its own"
    if loc[0] == "driver" and key == "slide":
        return "a driver has either link (a driven angle) or slide (a driven sliding pair)"
    return did_you_mean(key, here)


def _about_size(loc: Path, value: Any) -> tuple[str, str]:
    if loc == ("links",):
        return "there is none", "a scene has moving links, [links.1] and so on"
    wanted = {
        "on": "one guide or two are possible",
        "in": "one guide or two are possible",
        "angle_on": "one number for each guide is wanted",
        "from": "two points of the link are wanted",
        "r": "two lengths are wanted, one for each point",
    }
    return f"found {shown(value)}", wanted.get(str(written_path(loc)[-1]), "a place is [x, y]")


def _name_rule(ctx: Mapping[str, Any]) -> str:
    pattern = str(ctx.get("pattern", ""))
    if "max_length" in ctx:
        return f"a name has at most {ctx['max_length']} letters and digits"
    if r"\." in pattern:
        return 'a guide is written "LINK" for the link\'s own axis or "LINK.GUIDE"'
    if "/" in pattern:
        return 'a sliding pair is written "LINK", or "SLIDING/GUIDING"'
    if "A-Z][" in pattern:
        return "a point is named by a capital letter, then letters or digits"
    return "a link or guide is named by letters and digits"
