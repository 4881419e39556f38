"""A scene as a user holds it: found, read, built in Python, changed by key, saved as a file.

`Scene` is what is written.  What it says, resolved and in SI units, is its ``mechanism``.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any

from graphkin.errors import CallError, Problem, SceneError, as_text, did_you_mean
from graphkin.files import OwnTables, Tables, path_of, whole_file
from graphkin.scene.files import file_text, library, library_text, parsed, toml_text
from graphkin.scene.form import plain
from graphkin.scene.model import Mechanism
from graphkin.scene.scene_tables import SCENE, SceneTables, as_mapping, mechanism_said
from graphkin.scene.tables import item_of
from graphkin.words import Phrase, from_others

__all__ = [
    "Scene", "SceneLike", "mechanism_of", "mechanism_of_text", "put", "read", "resolved", "safe_name", "written",
]  # fmt: skip


def resolved(source: Mapping[Any, object] | SceneTables, name: str) -> tuple[SceneTables, Mechanism]:
    """What is written in a scene, checked, and what it says.  Raises SceneError with all that is wrong."""
    tables, problems, lost = SCENE.checked(plain(source))
    return tables, mechanism_said(tables, safe_name(name), problems, lost)


def safe_name(name: str) -> str:
    """A name that can be a folder's: letters of any language, digits, and - _ . inside.

    >>> safe_name("../my scene: 2?"), safe_name("..")
    ('my-scene-2', 'scene')
    """
    kept = "".join(c if c.isalnum() or c in "-_." else "-" for c in name[:200])
    return re.sub(r"-{2,}", "-", kept)[:60].strip("-_.") or "scene"


@dataclass(frozen=True, kw_only=True, repr=False)
class Scene(SceneTables):
    """A mechanism at one position, with what is asked of it: the keys of a scene file, in its names and units.

    Lengths are in the scene's unit, angles in degrees.  A scene is checked when it is made, as a file is when it is
    read; every problem is told at once.  ``name`` names the folder of its files.

    Raises
    ------
    SceneError : naming everything that is wrong with the scene

    Examples
    --------
    >>> from graphkin import Driver, Frame, Guide, Link, Scene
    >>> slider_crank = Scene(
    ...     title="Offset slider-crank",
    ...     frame=Frame(points={"A": (0, 0)}, guides={"h": Guide(through=(0, -16), angle=0)}),
    ...     links={
    ...         "1": Link(points=["A", "B"], length=23.8),
    ...         "2": Link(points=["B", "C"], length=58.4),
    ...         "3": Link(points=["C"], on="0.h"),
    ...     },
    ...     driver=Driver(link="1", angle=60, omega=10),
    ... )
    >>> longer = slider_crank.replace("links.2.length", 70)
    >>> longer.links["2"].length, slider_crank.links["2"].length
    (70.0, 58.4)
    >>> longer.to_dict()["driver"]
    {'link': '1', 'angle': 60.0, 'omega': 10.0}
    """

    name: str = field(default="scene", compare=False, metadata={"beside": True})

    def __post_init__(self) -> None:
        tables, mechanism = resolved(self, as_text("name", self.name))
        vars(self).update(vars(tables), _mechanism=mechanism)

    @classmethod
    def of(cls, source: Mapping[Any, object], name: str = "scene") -> Scene:
        """The scene of a mapping of the same shape as a file.  Raises SceneError."""
        tables, mechanism = resolved(source, name)
        scene = object.__new__(cls)
        vars(scene).update(vars(tables), name=name, _mechanism=mechanism)
        return scene

    @classmethod
    def saying(cls, mechanism: Mechanism) -> Scene:
        """The scene that says a mechanism: what it was read from, or where links or drivers were replaced since,
        everything placed in the links' own axes."""
        scene = cls.of(plain(mechanism.question.written or {}), mechanism.name)
        read, bodies = scene.mechanism, (mechanism.frame, *mechanism.links)
        kept = all(driver in read.drivers for driver in mechanism.drivers)
        kept = kept and all(read.by_name.get(body.name) == body for body in bodies)
        return scene if kept else cls.of(as_mapping(mechanism), mechanism.name)

    @property
    def mechanism(self) -> Mechanism:
        """What the scene says: everything placed, in SI units."""
        found: Mechanism = vars(self)["_mechanism"]
        return found

    def replace(self, key: str, value: object) -> Scene:
        """The scene with one entry replaced, checked anew.

        Parameters
        ----------
        key : of the file, with dots: ``links.1.length``, ``frame.points.D.x``, ``driver.2.angle`` of the second driver
        value : a number, a text, or for a whole entry a table or a list; None leaves it out

        Raises
        ------
        CallError : the scene has no such key; SceneError : with this value it is no scene
        """
        made = self.to_dict()
        problem = put(made, str(key), plain({"value": value})["value"])
        if problem is not None:
            raise CallError(problem)
        return Scene.of(made, self.name)

    def to_dict(self) -> OwnTables:
        """The scene as a mapping, as a TOML parser gives it; what holds anyway is left out."""
        return plain(self)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the scene as a file, which appears whole or not at all; returns its path.

        Raises
        ------
        CallError : a place that cannot be written
        """
        target = path_of(path)
        try:
            with whole_file(target) as out:
                out.write(toml_text(self.to_dict()).encode())
        except OSError as error:
            found = Phrase("cannot be written", reason=from_others(error.strerror or str(error)))
            raise CallError(Problem(str(path), found)) from None
        return target

    def __hash__(self) -> int:
        return hash((self.title, tuple(self.links)))

    def __repr__(self) -> str:
        return f"<Scene {self.name}: {len(self.links)} moving links>"

    def _repr_html_(self) -> str:
        return f"<pre>{escape(toml_text(self.to_dict()))}</pre>"


SceneLike = Scene | Mechanism | str | os.PathLike[str] | Tables
"""A scene in any of its forms: built, read, a file, the name of one that comes along, or a mapping."""


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


def _is_file(path: str) -> bool:
    try:
        return os.path.isfile(path)
    except ValueError:
        return False


def put(made: OwnTables, key: str, value: object) -> Problem | None:
    """Put a value at a key (with dots) of a scene's mapping, which is changed; the problem if there is no such key."""
    parts = key.split(".")
    whole = isinstance(value, dict | list)
    place: object = made
    for depth, part in enumerate(parts):
        last = depth == len(parts) - 1
        before = ".".join(parts[:depth]) or Phrase("the scene as a whole")
        step: Any = part
        if isinstance(place, list):
            step = item_of(part, len(place))
            if step is None:
                found = Phrase("has no item", before=before, part=part)
                return Problem(key, found, Phrase("it has counted from 1", count=len(place)))
            if last:
                place[step] = value
                return None
        elif not isinstance(place, dict):
            return Problem(key, Phrase("is and has nothing inside", before=before, place=f"{place!r:.40}"))
        elif part not in place:
            drivers = {k for kind in ("<angle>", "<slide>") for k in SCENE.keys_at(("driver", "<one>", kind))}
            known = drivers if parts[:1] == ["driver"] and depth else set(SCENE.keys_at(parts[:depth]))
            if last and part in known:
                place[part] = value
                return None
            return Problem(key, Phrase("has no", before=before, part=part), did_you_mean(part, map(str, place)))
        elif last:
            if isinstance(place[part], dict | list) and not whole:
                inside = ", ".join(map(str, place[part] if isinstance(place[part], dict) else ("x", "y")))
                return Problem(key, Phrase("is a table or a list not a"), Phrase("add one of", inside=inside))
            place[part] = value
            return None
        place = place[step]
    return None
