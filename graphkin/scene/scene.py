"""A scene as a user holds it: found, read, built in Python, changed by key, saved as a file.

`Scene` holds the file's entries; its ``mechanism`` is their meaning, resolved and in SI units.  Of a file with mistakes
all problems are told at once.  The docstring of `graphkin.scene` settles the points that the format leaves open.
"""

from __future__ import annotations

import math
import os
import re
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import field, replace
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from string import Template
from typing import Any

from graphkin.errors import CallError, Problem, SceneError, as_text, did_you_mean
from graphkin.files import OwnTables, Tables, opened, path_of, whole_file, writing_to
from graphkin.plane import degrees
from graphkin.scene import position as places
from graphkin.scene.asked import asked, at_its_position, loops_named, positions_named, stated_values
from graphkin.scene.bodies import (
    AnyBody,
    Reading,
    check_held,
    check_own_points,
    check_references,
    check_rolling,
    check_size,
    check_texts,
    driver_tables,
    pins_in_slots,
    sliding_pairs,
    with_bars,
    with_carriages,
)
from graphkin.scene.drivers import drives, placed_driver, stated_driver
from graphkin.scene.loads import loading_of
from graphkin.scene.model import Mechanism, PlacedLink, Question, no_force
from graphkin.scene.pairs import HigherPair
from graphkin.scene.pictures import background_of, scans_of
from graphkin.scene.scene_tables import SCENE, Guide, Link, SceneTables
from graphkin.scene.tables import file_table_by_name, path_name, path_of_key, plain, tidy, value_at
from graphkin.scene.touching import cams_of, contacts_of, discs_of, gears_of
from graphkin.words import Phrase, Wording, from_others, listed

# files

LARGEST_FILE = 1_000_000
DEEPEST = 16
"""Levels of a key, and of brackets in brackets: more than any scene has, and few enough for the parser, whose memory
grows with the square of a key's parts."""
_PARTS = re.compile(
    r'''"""(?:[^"\\]|\\.|"(?!""))*+(?:""")?|'{3}(?:[^']|'(?!''))*+(?:'{3})?'''  # strings of several lines
    r'''|"(?:[^"\\\n]|\\.)*+"?|'[^'\n]*+'?|\#[^\n]*+|[][{}.=,\n]''', re.DOTALL)
"""Strings and comments of a TOML text, whole, and the signs that part its keys and values."""
_AT_LINE = re.compile(r"^(.*?)\s*\(at (?:line (\d+), column (\d+)|(end of document))\)$", re.DOTALL)


def files_named(folder: Traversable) -> tuple[str, ...]:
    """Names of the TOML files of a folder without their ending, sorted."""
    return tuple(sorted(f.name.removesuffix(".toml") for f in folder.iterdir() if f.name.endswith(".toml")))


def shelf() -> Traversable:
    """The folder of the bundled scenes."""
    return files("graphkin.scene") / "library"


def library() -> tuple[str, ...]:
    """Names of the bundled scenes, sorted."""
    return files_named(shelf())


def library_text(name: str) -> str:
    """The text of a bundled scene.  Raises SceneError for an unknown name."""
    if name not in library():
        raise SceneError(_no_scene(name))
    return (shelf() / f"{name}.toml").read_text(encoding="utf-8")


def parsed(text: str) -> OwnTables:
    """The mapping of a TOML text.  Raises SceneError with the line that is wrong."""
    if len(text) > LARGEST_FILE:
        raise SceneError(_too_large())
    try:
        if _depth(text) > DEEPEST:
            raise RecursionError
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise SceneError(_syntax(str(error), text)) from None
    except RecursionError:
        raise SceneError.of(
            Phrase("the file"), "is nested too deeply", "a scene needs at most four levels"
        ) from None
    except ValueError:
        raise SceneError.of(Phrase("the file"), "is not toml a number of thousands of",
                            "no number of a scene may exceed 1e") from None


def _depth(text: str) -> int:
    """The greatest number of parts of a key in a TOML text, or of brackets inside each other."""
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
    """The text of a file.  Raises SceneError where it is missing or no text."""
    shown = path if path.isprintable() and len(path) <= 200 else ascii(path)[:200]
    try:
        if os.path.isdir(path):
            raise SceneError.of(shown, "is a directory", "name a scene file in it")
        with opened(path) as stream:
            data = stream.read(LARGEST_FILE + 1)
    except FileNotFoundError:
        raise SceneError(_no_scene(path, shown)) from None
    except (OSError, ValueError) as error:
        raise SceneError.of(shown or Phrase("the scene"), "cannot be read", reason=from_others(error)) from None
    if len(data) > LARGEST_FILE:
        raise SceneError(_too_large())
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise SceneError.of(Phrase("line", line=line), "is not utf-8 text",
                            "a scene file is toml saved as utf-8") from None


def _too_large() -> Problem:
    return Problem(Phrase("the file"), "is larger than kb", "a scene file is one mechanism as toml",
                   largest=LARGEST_FILE // 1000)


def _no_scene(name: str, shown: str = "") -> Problem:
    shown = shown or name
    if name.endswith(".toml") or "/" in name or os.sep in name:
        return Problem(shown, "there is no such file", "name a scene file or a scene that")
    if name in files_named(shelf() / "designs"):
        return Problem(shown, "is no scene", "this is a design file", name=name)
    return Problem(shown or Phrase("the scene"), "there is no such file and no scene",
                   did_you_mean(name[:60], library()))


def _syntax(message: str, text: str) -> Problem:
    """The TOML parser's message, with its line."""
    match = _AT_LINE.match(message)
    if not match:
        return Problem(Phrase("the file"), "is not toml of message", message=message)
    line = int(match[2]) if match[2] else text.count("\n") + 1
    lines = text.splitlines()
    here = lines[line - 1].strip() if line <= len(lines) else ""
    said = from_others(match[1][:1].lower() + match[1][1:])
    if here and here.isprintable():
        said = Phrase("where and what", where=said, found=here[:80])
    hint = _toml_hint(match[1], here)
    return Problem(Phrase("line", line=line), "is not toml", hint, text=said)


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
    from tomlkit.items import AoT, Table

    def value(given: object) -> object:
        if isinstance(given, Mapping):
            return filled(tomlkit.inline_table(), given)
        if isinstance(given, list | tuple):
            return [value(item) for item in given]
        return int(given) if isinstance(given, float) and given.is_integer() and abs(given) < 1e15 else given

    def filled(made: Any, given: Tables, item: Callable[[Any], object] = value) -> Any:
        for key, entry in given.items():
            made.append(key, item(entry))
        return made

    def table(given: Tables) -> Any:
        return filled(tomlkit.table(), given)

    def whole(key: str, given: Any) -> object:
        if isinstance(given, list) and given and all(isinstance(item, Mapping) for item in given):
            return AoT([table(item) for item in given])
        if not isinstance(given, Mapping):
            return value(given)
        if SCENE.holds_tables(key) and all(isinstance(item, Mapping) for item in given.values()):
            return filled(tomlkit.table(is_super_table=True), given, table)
        return table(given)

    entries = {key: whole(key, given) for key, given in mapping.items()}
    text = tomlkit.document()
    for key in sorted(entries, key=lambda key: isinstance(entries[key], Table | AoT)):  # after what stands alone
        text.append(key, entries[key])
    return text.as_string()


# the mechanism of a file


def resolved(source: Mapping[Any, object] | SceneTables, name: str) -> tuple[SceneTables, Mechanism]:
    """The checked entries of a scene, and the mechanism that they describe.

    Parameters
    ----------
    source : the mapping of a file, or its tables
    name : the scene's name

    Raises
    ------
    SceneError : with all problems, those of the form first
    """
    folder = safe_name(name)
    file, problems, lost = SCENE.checked(plain(source))
    reading = Reading(file, lost, problems, file.frame, file.links, file.pins)
    check_size(reading)
    check_texts(reading)
    reading = with_bars(with_carriages(reading))
    check_own_points(reading)
    reading = replace(reading, slides=sliding_pairs(reading))
    reading = replace(reading, slides=(*reading.slides, *pins_in_slots(reading)))
    discs = discs_of(reading) if any(body.discs for _, _, body in reading.bodies) else {}
    touching: tuple[HigherPair, ...] = ()
    if reading.touching:
        touching = *contacts_of(reading, discs), *gears_of(reading)
    for table in ("sketch", "drawn"):
        reading.wrong(*(reading.no_point(f"{table}.{point}", point) for point in getattr(file, table)))
    check_references(reading)
    check_rolling(reading)
    find = asked(reading) if file.find else ()
    stated = stated_values(reading) if file.printed or file.printed_rows or file.printed_table else ()
    positions = positions_named(file.positions, reading) if file.positions else None
    loops = loops_named(reading) if file.loops else {}
    check_held(reading)
    driven = drives(reading)
    position = places.stated_position(reading, driven.values())
    places.check_placed_twice(position)
    if not problems:
        places.check_starts(position)
    if not problems and position.drawn:
        places.check_agreement(position)
        places.check_contacts(touching, position)
    if not problems:
        places.check_all_found(position)
        places.check_distances(position)
    reading = replace(reading, places={name: body.local for name, body in position.bodies.items()})
    lifting = cams_of(reading, position.bodies[reading.frame.name].guides, position.drawn) if file.cams else ()
    if touching and not problems:
        places.check_held_distances(touching, position)
    values = [position.value_of(driver) for driver in driven.values()]
    tables = () if problems else ((reading.frame.name, None), *reading.links.items())
    bodies = [position.placed(link_name, discs, link) for link_name, link in tables]
    loading = loading_of(reading)
    wish = file.sheet.background
    under = background_of(wish, {**position.drawn, **reading.places[reading.frame.name]}, reading) if wish else None
    scans = scans_of(reading) if file.scans else {}
    drivers = [placed_driver(*at, value, reading) for at, value in zip(driven.items(), values, strict=True)]
    if positions is not None and drivers and drivers[0].turns and drivers[0].position:
        drivers[0] = at_its_position(drivers[0], positions)
    if problems:
        raise SceneError(*dict.fromkeys(problems))
    question = Question(
        title=file.title or folder, title_zh=file.title_zh, source=file.source, source_zh=file.source_zh, find=find,
        sheet=file.sheet, stated=stated, positions=positions, loops=loops, vary=file.vary, grading=dict(file.grading),
        background=under, scans=scans, written=file,
    )
    made = Mechanism(
        name=folder, frame=bodies[0], links=tuple(bodies[1:]), slides=reading.slides, drivers=tuple(drivers),
        units=file.units,
        sketch={p: complex(*place) * reading.metres for p, place in file.sketch.items()}, drawn=position.drawn,
        loading=loading, higher_pairs=(*touching, *lifting),
        starts=places.starts_of(position, touching) if touching else {}, slots=reading.slots,
        question=question,
    )
    if find or stated:
        _check_forces(made)
    return file, made


def _check_forces(made: Mechanism) -> None:
    """Raises SceneError for symbols of forces that the mechanism does not have."""
    wanted = [("find", made.question.find), *(("printed", tuple(stated.values)) for stated in made.question.stated)]
    wrong = (no_force(made, path_name((table, str(symbol))), symbol) for table, symbols in wanted for symbol in symbols)
    problems = [problem for problem in wrong if problem is not None]
    if problems:
        raise SceneError(*dict.fromkeys(problems))


# the file of a mechanism

def as_mapping(scene: Mechanism) -> OwnTables:
    """The mapping of a scene file of this mechanism: the file that it was read from, with its drivers as they are now
    and all places in the links' own axes.

    Drawn points, arcs and polar entries become lengths and places.
    """
    file = scene.question.written
    assert file is not None  # a mechanism is made by reading
    held = {contact.centres[0] for contact in scene.contacts if contact.rolling and contact.flat}
    sketch = {point: z for point, z in {**scene.drawn, **scene.sketch}.items() if point not in scene.frame.points}
    tables = driver_tables(file).values()
    drivers = [stated_driver(driver, tables, scene.units) for driver in scene.drivers if driver.given]
    made = plain(replace(
        file, driver=drivers, frame=_body(scene, scene.frame, file.frame, file.frame.points, "points"),
        links={name: _link(scene, scene.by_name[name], table) for name, table in file.links.items()
               if name in scene.by_name},
        sketch={point: _place(scene, z) for point, z in sketch.items()},
        drawn={point: place for point, place in file.drawn.items() if point in held},
    ))
    head: OwnTables = {}
    for text in ("title", "title_zh", "source", "source_zh", "find"):
        if text in made:
            head[text] = made.pop(text)
    return {**head, "units": {"length": scene.units.length, **made.pop("units", {})}, **made}  # always with its unit


def _link(scene: Mechanism, link: PlacedLink, table: Link) -> Link:
    """The table of a link with all its places in its own axes; of a rolling link with its start."""
    pairs = [pair for pair in scene.slidings if pair.a == link.name]
    start, angle_on = table.start, table.angle_on
    if any(pair.rolling for pair in scene.higher_pairs):
        begun = scene.starts.get(pairs[0].key if pairs else link.name)
        start = None if begun is None else tidy(scene.units.of("length" if pairs else "angle").of(begun))
    if angle_on is None and len(pairs) == 1 and pairs[0].turn != 1.0:  # as it was drawn
        angle_on = tidy(degrees(pairs[0].turn))
    length = None if link.length is None else tidy(link.length / scene.units.metres)
    made = replace(table, points=list(link.bar), length=length, angle_on=angle_on, start=start)
    return _body(scene, link, made, [point for point in (*table.points, *table.at) if point not in link.bar], "at")


def _body(scene: Mechanism, link: PlacedLink, table: AnyBody, points: Iterable[str], key: str) -> AnyBody:
    """The table of a link or the frame with these points, under a key, and its straight guides placed."""
    guides = {name: guide for name, guide in link.guides.items() if name}
    straight = {name: Guide(_place(scene, g.through), tidy(degrees(g.direction))) for name, g in guides.items()}
    placed = {point: _place(scene, link.points[point]) for point in points}
    return replace(table, guides={**table.guides, **straight}, **{key: placed})  # type: ignore[arg-type]


def _place(scene: Mechanism, z: complex) -> list[float]:
    """A place in the scene's unit of length."""
    return [tidy(part / scene.units.metres) for part in (z.real, z.imag)]


# scenes


def safe_name(name: str) -> str:
    """A name that can be a folder's: letters of any language, digits, and - _ . inside.

    >>> safe_name("../my scene: 2?"), safe_name("..")
    ('my-scene-2', 'scene')
    """
    kept = "".join(c if c.isalnum() or c in "-_." else "-" for c in name[:200])
    return re.sub(r"-{2,}", "-", kept)[:60].strip("-_.") or "scene"


@file_table_by_name
class Scene(SceneTables):
    """A mechanism at one position, and its question: the keys of a scene file, in its names and units.

    Lengths are in the scene's unit, angles in degrees.  A scene is checked when it is made, as a file is when it is
    read; every problem is told at once.  ``name`` names the folder of its files.

    Raises
    ------
    SceneError : naming everything that is wrong with the scene

    Examples
    --------
    >>> from graphkin.scene import Driver, Frame, Guide, Link, Scene
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
        """The scene of a mechanism: the scene that it was read from, or, where anything of it was replaced since, all
        places in the links' own axes."""
        scene = cls.of(plain(mechanism.question.written or {}), mechanism.name)
        kept = replace(mechanism, question=scene.mechanism.question) == scene.mechanism
        return scene if kept else cls.of(as_mapping(mechanism), mechanism.name)

    @property
    def mechanism(self) -> Mechanism:
        """The scene's mechanism: all places known, in SI units."""
        mechanism: Mechanism = vars(self)["_mechanism"]
        return mechanism

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
        """The scene as a mapping, as a TOML parser gives it, without entries at their defaults."""
        return plain(self)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the scene as a file, which appears whole or not at all; returns its path.

        Raises
        ------
        CallError : a place that cannot be written
        """
        target = path_of(path)
        with writing_to(str(path)), whole_file(target) as out:
            out.write(toml_text(self.to_dict()).encode())
        return target

    def __hash__(self) -> int:
        return hash((self.title, tuple(self.links)))

    def __repr__(self) -> str:
        return f"<Scene {self.name}: {len(self.links)} moving links>"

    def _repr_html_(self) -> str:
        from html import escape

        return f"<pre>{escape(toml_text(self.to_dict()))}</pre>"


SceneLike = Scene | Mechanism | str | os.PathLike[str] | Tables
"""A scene in any of its forms: built, read, a file, the name of one that comes along, or a mapping."""


def read(source: str | os.PathLike[str] | Tables) -> Scene:
    """Read a scene.

    Parameters
    ----------
    source : a path, the name of a bundled scene, or the mapping that a TOML parser makes of a scene file

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
    """The mechanism of a scene in any of its forms: all places known, in SI units.  Raises SceneError."""
    if isinstance(source, Mechanism):
        return source
    return source.mechanism if isinstance(source, Scene) else resolved(*written(source))[1]


def mechanism_of_text(text: str, name: str) -> Mechanism:
    """The mechanism of a scene file's text; ``name`` is the scene's name.  Raises SceneError."""
    return resolved(parsed(text), name)[1]


def written(source: SceneLike) -> tuple[OwnTables, str]:
    """The mapping of a scene's file, as it was written if that is known, and the scene's name.

    Raises
    ------
    SceneError : there is no such scene, or it is no TOML; its entries are not checked
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
                raise SceneError.of(Phrase("the scene"), "found the text of a scene file instead",
                                    "save it as a file or give tomllib.loads")
            if isinstance(source, str) and text in library() and not os.path.isfile(text):
                return parsed(library_text(text)), text
            made = parsed(file_text(text))
            path = Path(text)
            for _, table in naming_files(made):
                table["file"] = str(path.parent / table["file"])
            return made, path.stem
    raise SceneError.of(Phrase("the scene"), "found a", "give a file the name of a scene", name=type(source).__name__)


def naming_files(made: OwnTables) -> Iterator[tuple[str, OwnTables]]:
    """The tables of a scene's mapping that name a file beside it, by their places."""
    scans = made.get("scans")
    paths = [("printed_table",), ("sheet", "background")]
    paths += [("scans", name) for name in (scans if isinstance(scans, dict) else ())]
    for path in paths:
        table = value_at(made, path)
        if isinstance(table, dict) and isinstance(table.get("file"), str):
            yield ".".join(path), table


def put(made: OwnTables, key: str, value: object) -> Problem | None:
    """Put a value at a key (with dots) of a scene's mapping, which is changed; the problem if there is no such key."""
    parts = key.split(".")
    path = path_of_key(made, key)
    if path is not None:
        table, old = value_at(made, path[:-1]), value_at(made, path)
        if isinstance(table, dict) and isinstance(old, dict | list) and not isinstance(value, dict | list):
            inside = listed([*old] if isinstance(old, dict) else ["x", "y"])
            return Problem(key, "is a table or a list not a", "add one of", inside=inside)
        table[path[-1]] = value
        return None
    there = next(n for n in range(len(parts)) if path_of_key(made, ".".join(parts[: n + 1])) is None)
    before, part = ".".join(parts[:there]), parts[there]
    place, said = value_at(made, path_of_key(made, before) or ()), before or Phrase("the scene as a whole")
    if isinstance(place, list):
        return Problem(key, "has no item", "it has counted from 1", before=said, part=part, count=len(place))
    if not isinstance(place, dict):
        return Problem(key, "is and has nothing inside", before=said, place=f"{place!r:.40}")
    known = set(SCENE.keys_at(parts[:there]))
    if parts[:1] == ["driver"] and there:
        known = {k for kind in ("<angle>", "<slide>") for k in SCENE.keys_at(("driver", "<one>", kind))}
    if part in known and there == len(parts) - 1:
        place[part] = value
        return None
    return Problem(key, "has no", did_you_mean(part, map(str, place)), before=said, part=part)


# new scenes

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
    given : lengths and driver by their names, where they differ from the usual ones

    Raises
    ------
    CallError : an unknown kind, an unknown name, a length that is not positive
    """
    if kind not in NEW:
        raise CallError.of("--new", f'"{kind}"', did_you_mean(kind, NEW))
    asks = NEW[kind]
    problems = [Problem(f"--new {kind}", Phrase("asks for no", number=name), did_you_mean(name, asks))
                for name in given if name not in asks]
    for name, value in given.items():
        signed = name in ("offset", "angle", "rpm")
        if not math.isfinite(value) or abs(value) > 1e9 or (not signed and value <= 0):
            wanted = "a length is positive" if not signed and value <= 0 else "give a finite number below 1e9"
            problems.append(Problem(name, "found value", wanted, value=f"{value:g}"))
    if problems:
        raise CallError(*problems)
    text = (shelf() / "new" / f"{kind}.toml").read_text(encoding="utf-8")
    return Template(text).substitute({name: f"{value:g}" for name, value in {**asks, **given}.items()})
