"""Design files: found, read, every problem of a file at once."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import MISSING, fields, replace
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from graphkin.errors import CallError, Problem, SceneError, did_you_mean
from graphkin.files import OwnTables, Tables
from graphkin.plane import degrees, direction
from graphkin.scene import source as scenes
from graphkin.scene.synthesis import KINDS, BarPlace, BarPositionsTask, Design, DesignTask
from graphkin.scene.written import safe_name

__all__ = ["DesignLike", "design_of", "designs", "is_design"]

LARGEST, SMALLEST = 1e15, 1e-15

DesignLike = Design | str | os.PathLike[str] | Tables


def _shelf() -> Traversable:
    return files("graphkin.scene") / "library" / "designs"


def designs() -> tuple[str, ...]:
    """Names of the design files that come along, sorted."""
    return scenes.files_named(_shelf())


def is_design(source: object) -> bool:
    """Whether this is a design file, the name of one that comes along, or a mapping of the same shape, and no scene."""
    if isinstance(source, Mapping):
        return "design" in source and "links" not in source
    if not isinstance(source, str | os.PathLike):
        return isinstance(source, Design)
    text = os.fspath(source)
    if os.path.isfile(text):
        try:
            raw = scenes.parsed(scenes.file_text(text))
        except SceneError:
            return False
        return is_design(raw)
    return text in designs() and text not in scenes.library()


def design_of(source: DesignLike) -> Design:
    """Read a design file.

    Parameters
    ----------
    source : a path, the name of a design that comes along, or what a TOML parser makes of a design file

    Raises
    ------
    SceneError : everything that is wrong with the file
    """
    from graphkin.scene.reading import plain

    if isinstance(source, Design):
        return source
    if isinstance(source, str) and source in designs() and not os.path.isfile(source):
        raw, name = scenes.parsed((_shelf() / f"{source}.toml").read_text(encoding="utf-8")), source
    elif isinstance(source, str | os.PathLike):
        text = os.fspath(source)
        if "/" not in text and not text.endswith(".toml") and not os.path.isfile(text):
            missing = "there is no such file, and no design of this name comes along"
            raise SceneError(Problem(text[:200], missing, did_you_mean(text[:60], designs())))
        raw, name = scenes.parsed(scenes.file_text(text)), Path(text).stem
    else:
        if not isinstance(source, Mapping):
            wanted = "give a file, the name of a design that comes along, or a mapping of the same shape"
            raise CallError(Problem("design", f"found {source!r:.60}", wanted))
        raw, name = plain(source), "design"
    return _read(raw, safe_name(name))


def _read(raw: Tables, name: str) -> Design:
    problems: list[Problem] = []
    given: OwnTables = {}
    for key, value in raw.items():
        if key not in ("title", "title_zh", "source", "design", "units", "sheet"):
            unknown = "unknown table" if isinstance(value, dict) else "unknown key"
            hint = did_you_mean(key, ["title", "title_zh", "source", "design", "units", "sheet"])
            if key == "links":
                hint = "this is a scene; a design file has a table [design]"
            problems.append(Problem(key[:60], unknown, hint))
        elif key in ("title", "title_zh", "source") and not isinstance(value, str):
            problems.append(Problem(key, f"found {_shown(value)}", "a text is wanted"))
        elif key in ("title", "title_zh", "source"):
            given[key] = value
    task = _task(raw.get("design"), problems)
    given |= _units_and_sheet(raw, problems)
    if problems or task is None:
        raise SceneError(*problems)
    return Design(task=task, name=name, **given)


def _units_and_sheet(raw: Tables, problems: list[Problem]) -> OwnTables:
    """[units] and [sheet], which are those of a scene, read by its reader."""
    from graphkin.scene.reading import checked

    beside = {key: raw[key] for key in ("units", "sheet") if key in raw}
    tables, found, _ = checked({**beside, "links": {"1": {"points": ["A"]}}})
    problems += found
    return {"units": tables.units, "sheet": tables.sheet}


def _task(raw: object, problems: list[Problem]) -> DesignTask | None:
    if raw is None:
        problems.append(Problem("design", "is missing", "a design file has a table [design] with kind and its data"))
        return None
    if not isinstance(raw, dict):
        problems.append(Problem("design", f"found {_shown(raw)}", "a table is wanted"))
        return None
    kind = raw.get("kind")
    if kind is None:
        problems.append(Problem("design.kind", "is missing", f"one of {', '.join(KINDS)}"))
        return None
    if not isinstance(kind, str) or kind not in KINDS:
        problems.append(Problem("design.kind", f"found {_shown(kind)}", _kind_meant(str(kind))))
        return None
    made = KINDS[kind]
    keys = {f.name: f for f in fields(made) if f.metadata["form"] != "beside"}
    values: OwnTables = {}
    before = len(problems)
    for key in raw:
        if key != "kind" and key not in keys:
            problems.append(Problem(f"design.{key[:60]}", "unknown key", did_you_mean(key, keys)))
    for key, one in keys.items():
        where = f"design.{key}"
        if key in raw:
            values[key] = _value(where, one.metadata["form"], raw[key], problems)
        elif one.default is MISSING:
            problems.append(Problem(where, "is missing", one.metadata["description"]))
    if len(problems) > before:
        return None
    if made is BarPositionsTask:
        return _bar_positions(values, problems)
    return made(**values)


def _kind_meant(kind: str) -> str:
    """The kinds that there are, the nearest first."""
    hint, known = did_you_mean(kind, KINDS), ", ".join(KINDS)
    return f"{hint} the kinds are {known}" if hint.startswith("did") else f"the kinds are {known}"


def _value(where: str, form: str, value: object, problems: list[Problem]) -> object:
    """A value in its form; a problem where it is none."""
    if form in ("length", "number", "offset"):
        return _positive(where, value, problems, zero=form == "offset")
    if form == "place":
        return _place(where, value, problems)
    if form == "angles":
        return _pair(where, value, problems, "two angles in degrees are wanted: [-30, 30]")
    wanted = "[crank angle, rocker angle]" if form == "pairs" else "{ B = [x, y], C = [x, y] }"
    if not isinstance(value, list) or len(value) != 3:
        found = f"found {len(value)} of them" if isinstance(value, list) else f"found {_shown(value)}"
        problems.append(Problem(where, found, f"three of {wanted} are wanted"))
        return None
    if form == "pairs":
        return tuple(
            _pair(f"{where}.{i}", one, problems, "two angles in degrees are wanted: [30, 60]")
            for i, one in enumerate(value, 1)
        )
    return [_bar(f"{where}.{i}", one, problems) for i, one in enumerate(value, 1)]


def _bar(where: str, value: object, problems: list[Problem]) -> OwnTables:
    """A place of a bar as it is written: B with C or angle."""
    if not isinstance(value, dict):
        problems.append(Problem(where, f"found {_shown(value)}", "write { B = [x, y], C = [x, y] }"))
        return {}
    problems += [
        Problem(f"{where}.{key[:60]}", "unknown key", did_you_mean(key, ["B", "C", "angle"]))
        for key in value
        if key not in ("B", "C", "angle")
    ]
    if ("C" in value) == ("angle" in value):
        found = "has both C and angle" if "C" in value else "has neither C nor angle"
        problems.append(Problem(where, found, "a bar lies where B and C lie, or B and its angle"))
    made: OwnTables = {}
    if "B" not in value:
        problems.append(Problem(f"{where}.B", "is missing", "the first point of the bar, [x, y]"))
    for key in ("B", "C"):
        if key in value:
            made[key] = _place(f"{where}.{key}", value[key], problems)
    if "angle" in value:
        made["angle"] = _finite(f"{where}.angle", value["angle"], problems)
    return made


def _bar_positions(values: OwnTables, problems: list[Problem]) -> BarPositionsTask | None:
    bars, length = values["positions"], float(values.get("BC") or 0.0)
    by_angle = ["angle" in bar for bar in bars]
    if any(by_angle) and not length:
        problems.append(Problem("design.BC", "is missing", "length of the bar, since its places are told by angles"))
    if not any(by_angle) and length:
        told = abs(bars[0]["C"] - bars[0]["B"])
        if abs(told - length) > 1e-3 * length:
            problems.append(Problem("design.BC", f"found {length:.6g}", f"B and C of position 1 lie {told:.6g} apart"))
    if ("A" in values) != ("D" in values):
        missing = "D" if "A" in values else "A"
        problems.append(Problem(f"design.{missing}", "is missing", "both fixed pivots are given, or none"))
    if problems:
        return None
    placed = [
        BarPlace(bar["B"], bar["C"] if "C" in bar else bar["B"] + length * direction(bar["angle"])) for bar in bars
    ]
    own = abs(placed[0].C - placed[0].B)
    for i, bar in enumerate(placed, 1):
        here = abs(bar.C - bar.B)
        if here < SMALLEST:
            problems.append(Problem(f"design.positions.{i}", "B and C lie at one place", "a bar has a length"))
        elif abs(here - own) > 1e-3 * own:
            problems.append(Problem(f"design.positions.{i}", f"the bar is {here:.6g} long", f"in position 1 {own:.6g}"))
    angles = tuple(degrees(bar.C - bar.B) for bar in placed)
    first, second, third = placed
    task = BarPositionsTask(positions=(first, second, third), BC=length or None, angles=angles)
    return None if problems else replace(task, A=values.get("A"), D=values.get("D"))


def _positive(where: str, value: object, problems: list[Problem], zero: bool = False) -> float:
    number = _finite(where, value, problems)
    if number is None:
        return 0.0
    if number < 0.0 or (number < SMALLEST and not (zero and number == 0.0)):
        what = "a negative number" if number < 0 else "nothing" if number == 0 else "far too small a number"
        problems.append(Problem(where, f"found {number:.15g}, {what}", "it must be positive" + " or 0" * zero))
    return number


def _finite(where: str, value: object, problems: list[Problem]) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        problems.append(Problem(where, f"found {_shown(value)}", "a number is wanted"))
    elif not math.isfinite(value) or abs(value) > LARGEST:
        problems.append(Problem(where, f"found {_shown(value)}", f"a finite number up to {LARGEST:g} is wanted"))
    else:
        return float(value)
    return None


def _pair(where: str, value: object, problems: list[Problem], wanted: str) -> tuple[float, float]:
    if not isinstance(value, list) or len(value) != 2:
        problems.append(Problem(where, f"found {_shown(value)}", wanted))
        return 0.0, 0.0
    first, second = (_finite(where, one, problems) for one in value)
    return first or 0.0, second or 0.0


def _place(where: str, value: object, problems: list[Problem]) -> complex:
    return complex(*_pair(where, value, problems, "a place is [x, y]"))


def _shown(value: object) -> str:
    from graphkin.scene.reading import shown

    return shown(value)
