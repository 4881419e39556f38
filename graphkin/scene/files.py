"""Scene files as texts: those that come along and those of a user, found and read; TOML as tables, tables as TOML."""

from __future__ import annotations

import math
import os
import re
import tomllib
from collections.abc import Mapping
from importlib.resources import files
from importlib.resources.abc import Traversable
from string import Template

from graphkin.errors import CallError, Problem, SceneError, did_you_mean
from graphkin.files import OwnTables, Tables, opened
from graphkin.words import Phrase, Wording, from_others

__all__ = [
    "LARGEST_FILE", "NEW", "file_text", "files_named", "library", "library_text", "new_scene", "parsed", "shelf",
    "toml_text",
]  # fmt: skip

LARGEST_FILE = 1_000_000
DEEPEST = 16
"""Levels of a key, and of brackets in brackets: more than any scene has, and few enough for the parser, whose memory
grows with the square of a key's parts."""
_PARTS = re.compile(
    r'''"""(?:[^"\\]|\\.|"(?!""))*+(?:""")?|'{3}(?:[^']|'(?!''))*+(?:'{3})?'''  # strings of several lines
    r'''|"(?:[^"\\\n]|\\.)*+"?|'[^'\n]*+'?|\#[^\n]*+|[][{}.=,\n]''', re.DOTALL)  # fmt: skip
"""Strings and comments of a TOML text, whole, and the signs that part its keys and values."""
_AT_LINE = re.compile(r"^(.*?)\s*\(at (?:line (\d+), column (\d+)|(end of document))\)$", re.DOTALL)


def files_named(folder: Traversable) -> tuple[str, ...]:
    """Names of the TOML files of a folder without their ending, sorted."""
    return tuple(sorted(f.name.removesuffix(".toml") for f in folder.iterdir() if f.name.endswith(".toml")))


def shelf() -> Traversable:
    """The folder of what comes along."""
    return files("graphkin.scene") / "library"


def library() -> tuple[str, ...]:
    """Names of the scenes that come along, sorted."""
    return files_named(shelf())


def library_text(name: str) -> str:
    """The text of a scene that comes along.  Raises SceneError for a name that is not there."""
    if name not in library():
        raise SceneError(_no_scene(name))
    return (shelf() / f"{name}.toml").read_text(encoding="utf-8")


def parsed(text: str) -> OwnTables:
    """The mapping of a TOML text.  Raises SceneError with the line that is wrong."""
    if len(text) > LARGEST_FILE:
        raise SceneError(_too_large())
    deep = Problem(Phrase("the file"), Phrase("is nested too deeply"), Phrase("a scene needs at most four levels"))
    if _depth(text) > DEEPEST:
        raise SceneError(deep)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise SceneError(_syntax(str(error), text)) from None
    except RecursionError:
        raise SceneError(deep) from None
    except ValueError as error:
        if "int_max_str_digits" in str(error):
            found = Phrase("is not toml a number of thousands of")
            wanted = Phrase("no number of a scene may exceed 1e")
            raise SceneError(Problem(Phrase("the file"), found, wanted)) from None
        found = Phrase("is not toml of message", message=error)
        raise SceneError(Problem(Phrase("the file"), found, Phrase("see https toml.io"))) from None


def _depth(text: str) -> int:
    """The most parts that a key of a TOML text has, or brackets that stand in each other."""
    most = brackets = dots = 0
    for part in _PARTS.finditer(text):
        sign = part[0]
        if sign == ".":
            dots += 1
        elif sign in "[{":
            brackets, dots = brackets + 1, 0
        elif sign in "]}":
            brackets, dots = max(brackets - 1, 0), 0
        elif sign in "=,\n":
            dots = 0
        most = max(most, brackets, dots)
    return most


def file_text(path: str) -> str:
    """The text of a file.  Raises SceneError where there is no such text."""
    shown = path if path.isprintable() and len(path) <= 200 else ascii(path)[:200]
    try:
        if os.path.isdir(path):
            raise SceneError(Problem(shown, Phrase("is a directory"), Phrase("name a scene file in it")))
        with opened(path) as stream:
            data = stream.read(LARGEST_FILE + 1)
    except FileNotFoundError:
        raise SceneError(_no_scene(path, shown)) from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        found = Phrase("cannot be read", reason=from_others(reason))
        raise SceneError(Problem(shown or Phrase("the scene"), found)) from None
    if len(data) > LARGEST_FILE:
        raise SceneError(_too_large())
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        wanted = Phrase("a scene file is toml saved as utf-8")
        raise SceneError(Problem(Phrase("line", line=line), Phrase("is not utf-8 text"), wanted)) from None


def _too_large() -> Problem:
    found = Phrase("is larger than kb", largest=LARGEST_FILE // 1000)
    return Problem(Phrase("the file"), found, Phrase("a scene file is one mechanism as toml"))


def _no_scene(name: str, shown: str = "") -> Problem:
    shown = shown or name
    if name.endswith(".toml") or "/" in name or os.sep in name:
        return Problem(shown, Phrase("there is no such file"), Phrase("name a scene file or a scene that"))
    return Problem(shown or Phrase("the scene"), Phrase("there is no such file and no scene"),
                   did_you_mean(name[:60], library()))


def _syntax(message: str, text: str) -> Problem:
    """What the TOML parser says, with the line it happened in."""
    match = _AT_LINE.match(message)
    if not match:
        return Problem(Phrase("the file"), Phrase("is not toml of message", message=message))
    line = int(match[2]) if match[2] else text.count("\n") + 1
    lines = text.splitlines()
    here = lines[line - 1].strip() if line <= len(lines) else ""
    said = from_others(match[1][:1].lower() + match[1][1:])
    if here and here.isprintable():
        said = Phrase("where and what", where=said, found=here[:80])
    hint = _toml_hint(match[1], here)
    return Problem(Phrase("line", line=line), Phrase("is not toml", text=said), hint)


def _toml_hint(message: str, line: str) -> Wording:
    wide = re.search("[\u2018-\u201f\u3000-\u3002\uff01-\uff5e]", re.sub(r'"[^"]*"|#.*', "", line))
    if wide:
        return Phrase("outside of texts only ascii signs are possible", sign=wide[0])
    if "key part" in message or "inline table" in message:
        return Phrase("a table in braces stands on one line")
    if "overwrite" in message or "twice" in message or "Cannot declare" in message:
        return Phrase("a key or table may stand only once")
    if "Invalid value" in message:
        return Phrase("texts and names stand in quotation marks numbers")
    return Phrase("write key value numbers with a point texts")


def toml_text(mapping: Tables) -> str:
    """The text of a scene file from its mapping; reading it gives the mapping again.

    >>> print(toml_text({"title": "A", "links": {"1": {"points": ["A", "B"], "length": 2.0}}}), end="")
    title = "A"
    <BLANKLINE>
    [links.1]
    points = ["A", "B"]
    length = 2
    """
    import tomlkit
    from tomlkit.items import Table

    def value(given: object) -> object:
        if isinstance(given, Mapping):
            inline = tomlkit.inline_table()
            for key, item in given.items():
                inline.append(key, value(item))
            return inline
        if isinstance(given, list | tuple):
            return [value(item) for item in given]
        return int(given) if isinstance(given, float) and given.is_integer() and abs(given) < 1e15 else given

    def table(given: Tables) -> Table:
        made = tomlkit.table()
        for key, item in given.items():
            made.append(key, value(item))
        return made

    text = tomlkit.document()
    for key in sorted(mapping, key=lambda key: _is_table(mapping[key])):  # tables come after what stands alone
        given = mapping[key]
        if key in ("links", "pins", "contacts", "gears", "cams") and _is_table(given):
            made = tomlkit.table(is_super_table=True)
            for name, item in given.items():
                made.append(name, table(item))
            text.append(key, made)
        elif isinstance(given, Mapping):
            text.append(key, table(given))
        elif _is_table(given):
            several = tomlkit.aot()
            for item in given:
                several.append(table(item))
            text.append(key, several)
        else:
            text.append(key, value(given))
    return text.as_string()


def _is_table(value: object) -> bool:
    return isinstance(value, Mapping) or (
        isinstance(value, list) and bool(value) and all(isinstance(v, Mapping) for v in value)
    )


# -- new scenes --------------------------------------------------------------------------------------------------------

NEW: Mapping[str, Mapping[str, float]] = {
    "four-bar": {"crank": 150, "coupler": 500, "rocker": 300, "frame": 400, "angle": 60, "rpm": 60},
    "slider-crank": {"crank": 50, "rod": 200, "offset": 0, "angle": 60, "rpm": 60},
    "guide-bar": {"crank": 100, "centres": 250, "angle": 60, "rpm": 60},
    "swinging-block": {"crank": 100, "centres": 250, "angle": 60, "rpm": 60},
}
"""Kinds of mechanisms of which a commented file comes along, to go on from with one's own lengths: what each asks for,
with a value that works (mm, degrees, rpm)."""


def new_scene(kind: str, given: Mapping[str, float]) -> str:
    """The text of a new scene file.

    Parameters
    ----------
    given : lengths and driver by their names, as far as they are not to be the usual ones

    Raises
    ------
    CallError : an unknown kind, an unknown name, a length that is not positive
    """
    if kind not in NEW:
        raise CallError(Problem("--new", f'"{kind}"', did_you_mean(kind, NEW)))
    asks = NEW[kind]
    problems = [Problem(f"--new {kind}", Phrase("asks for no", number=name), did_you_mean(name, asks))
                for name in given if name not in asks]  # fmt: skip
    for name, value in given.items():
        signed = name in ("offset", "angle", "rpm")
        if not math.isfinite(value) or abs(value) > 1e9 or (not signed and value <= 0):
            wanted = Phrase("a finite number") if signed else Phrase("a length is positive")
            problems.append(Problem(name, Phrase("found value", value=f"{value:g}"), wanted))
    if problems:
        raise CallError(*problems)
    text = (shelf() / "new" / f"{kind}.toml").read_text(encoding="utf-8")
    return Template(text).substitute({name: f"{value:g}" for name, value in {**asks, **given}.items()})
