"""Finding a scene: a file, the name of a scene that comes along, a text, or a mapping."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Mapping
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from graphkin.errors import Problem, SceneError, did_you_mean
from graphkin.files import OwnTables, Tables, opened
from graphkin.scene.mapping import as_mapping
from graphkin.scene.model import Mechanism
from graphkin.scene.written import Scene, resolved
from graphkin.words import Phrase, Wording, from_others

__all__ = [
    "SceneLike",
    "file_text",
    "files_named",
    "library",
    "library_text",
    "mechanism_of",
    "mechanism_of_text",
    "parsed",
    "read",
    "written",
]

SceneLike = Scene | Mechanism | str | os.PathLike[str] | Tables
"""A scene in any of its forms: built, read, a file, the name of one that comes along, or a mapping."""

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


def _shelf() -> Traversable:
    return files("graphkin.scene") / "library"


def library() -> tuple[str, ...]:
    """Names of the scenes that come along, sorted."""
    return files_named(_shelf())


def library_text(name: str) -> str:
    """The text of a scene that comes along.  Raises SceneError for a name that is not there."""
    if name not in library():
        raise SceneError(_no_scene(name))
    return (_shelf() / f"{name}.toml").read_text(encoding="utf-8")


def read(source: str | os.PathLike[str] | Tables) -> Scene:
    """Read a scene.

    Parameters
    ----------
    source : a path, the name of a scene that comes along, or what a TOML parser makes of a scene file

    Raises
    ------
    SceneError : naming everything that is wrong with the scene, or that there is none

    Examples
    --------
    >>> scene = read("slotter-75-150")
    >>> faster = scene.replace("driver.rpm", 90)
    >>> scene.driver.rpm, faster.driver.rpm
    (60.0, 90.0)
    """
    return Scene.of(*written(source))


def mechanism_of(source: SceneLike) -> Mechanism:
    """What a scene says, in any of its forms: everything placed, in SI units.  Raises SceneError."""
    if isinstance(source, Mechanism):
        return source
    return source.mechanism if isinstance(source, Scene) else resolved(*written(source))[1]


def mechanism_of_text(text: str, name: str) -> Mechanism:
    """What the text of a scene file says; ``name`` is the scene's name.  Raises SceneError."""
    return resolved(parsed(text), name)[1]


def written(source: SceneLike) -> tuple[OwnTables, str]:
    """The mapping of a scene's file, as it was written where that is known, and the scene's name.

    Raises
    ------
    SceneError : there is no such scene, or it is no TOML; what stands in it is not looked at
    """
    if isinstance(source, Mechanism):
        return as_mapping(source), source.name
    if isinstance(source, Scene):
        return source.to_dict(), source.name
    if isinstance(source, Mapping):
        from graphkin.scene.reading import plain

        return plain(source), "scene"
    if isinstance(source, str | os.PathLike):
        text = os.fspath(source)
        if isinstance(text, str):
            if "\n" in text and "=" in text:
                raise SceneError(Problem(Phrase("the scene"), Phrase("found the text of a scene file instead"),
                                         Phrase("save it as a file or give tomllib.loads")))
            if isinstance(source, str) and text in library() and not _is_file(text):
                return parsed(library_text(text)), text
            return _beside(parsed(file_text(text)), Path(text)), Path(text).stem
    raise SceneError(Problem(Phrase("the scene"), Phrase("found a", name=type(source).__name__),
                             Phrase("give a file the name of a scene")))


def _beside(made: OwnTables, path: Path) -> OwnTables:
    """The mapping of a file, with the places of the table and the picture that stand beside it."""
    sheet = made.get("sheet")
    scans = made.get("scans")
    tables = [made.get("printed_table"), sheet.get("background") if isinstance(sheet, dict) else None]
    for table in (*tables, *(scans.values() if isinstance(scans, dict) else ())):
        if isinstance(table, dict) and isinstance(table.get("file"), str):
            table["file"] = str(path.parent / table["file"])
    return made


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
            raise SceneError(Problem(Phrase("the file"), Phrase("is not toml a number of thousands of"),
                                     Phrase("no number of a scene may exceed 1e"))) from None
        raise SceneError(
            Problem(Phrase("the file"), Phrase("is not toml of message", message=error), Phrase("see https toml.io"))
        ) from None


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


def _is_file(path: str) -> bool:
    try:
        return os.path.isfile(path)
    except ValueError:
        return False


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
        raise SceneError(
            Problem(shown or Phrase("the scene"), Phrase("cannot be read", reason=from_others(reason)))
        ) from None
    if len(data) > LARGEST_FILE:
        raise SceneError(_too_large())
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise SceneError(
            Problem(
                Phrase("line", line=line), Phrase("is not utf-8 text"), Phrase("a scene file is toml saved as utf-8")
            )
        ) from None


def _too_large() -> Problem:
    return Problem(
        Phrase("the file"),
        Phrase("is larger than kb", largest=LARGEST_FILE // 1000),
        Phrase("a scene file is one mechanism as toml"),
    )


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
