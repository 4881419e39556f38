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
from graphkin.scene import files as scenes
from graphkin.scene.form import Form, plain, shown
from graphkin.scene.scene import safe_name
from graphkin.scene.sheet import SheetWishes
from graphkin.scene.synthesis import KINDS, BarPlace, BarPositionsTask, Design, DesignTask
from graphkin.scene.tables import FileTable, Units, table
from graphkin.words import Phrase, Wording, from_others

__all__ = ["DesignLike", "design_of", "designs", "is_design"]

LARGEST, SMALLEST = 1e15, 1e-15

@table
class _Papers(FileTable):
    """The tables of a design file that those of a scene share."""

    units: Units = Units()
    sheet: SheetWishes = SheetWishes()


PAPERS = Form(_Papers, "graphkin design")

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

    if isinstance(source, Design):
        return source
    if isinstance(source, str) and source in designs() and not os.path.isfile(source):
        raw, name = scenes.parsed((_shelf() / f"{source}.toml").read_text(encoding="utf-8")), source
    elif isinstance(source, str | os.PathLike):
        text = os.fspath(source)
        if "/" not in text and not text.endswith(".toml") and not os.path.isfile(text):
            missing = Phrase("there is no such file and no design")
            raise SceneError(Problem(text[:200], missing, did_you_mean(text[:60], designs())))
        raw, name = scenes.parsed(scenes.file_text(text)), Path(text).stem
    else:
        if not isinstance(source, Mapping):
            wanted = Phrase("give a file the name of a design")
            raise CallError(Problem("design", Phrase("found value", value=f'{source!r:.60}'), wanted))
        raw, name = plain(source), "design"
    return _read(raw, safe_name(name))


def _read(raw: Tables, name: str) -> Design:
    problems: list[Problem] = []
    given: OwnTables = {}
    for key, value in raw.items():
        if key not in ("title", "title_zh", "source", "design", "units", "sheet"):
            unknown = Phrase("unknown table") if isinstance(value, dict) else Phrase("unknown key")
            hint = did_you_mean(key, ["title", "title_zh", "source", "design", "units", "sheet"])
            if key == "links":
                hint = Phrase("this is a scene a design file has")
            problems.append(Problem(key[:60], unknown, hint))
        elif key in ("title", "title_zh", "source") and not isinstance(value, str):
            problems.append(Problem(key, Phrase("found value", value=shown(value)), Phrase("a text is wanted")))
        elif key in ("title", "title_zh", "source"):
            given[key] = value
    task = _task(raw.get("design"), problems)
    given |= _units_and_sheet(raw, problems)
    if problems or task is None:
        raise SceneError(*problems)
    return Design(task=task, name=name, **given)


def _units_and_sheet(raw: Tables, problems: list[Problem]) -> OwnTables:
    """[units] and [sheet], which are those of a scene, read by its reader."""
    tables, found, _ = PAPERS.checked({key: raw[key] for key in ("units", "sheet") if key in raw})
    problems += found
    return {"units": tables.units, "sheet": tables.sheet}


def _task(raw: object, problems: list[Problem]) -> DesignTask | None:
    if raw is None:
        problems.append(Problem("design", Phrase("is missing"), Phrase("a design file has a table design with")))
        return None
    if not isinstance(raw, dict):
        problems.append(Problem("design", Phrase("found value", value=shown(raw)), Phrase("a table is wanted")))
        return None
    kind = raw.get("kind")
    if kind is None:
        problems.append(Problem("design.kind", Phrase("is missing"), Phrase("one of", names=', '.join(KINDS))))
        return None
    if not isinstance(kind, str) or kind not in KINDS:
        problems.append(Problem("design.kind", Phrase("found value", value=shown(kind)), _kind_meant(str(kind))))
        return None
    made = KINDS[kind]
    keys = {f.name: f for f in fields(made) if f.metadata["form"] != "beside"}
    values: OwnTables = {}
    before = len(problems)
    for key in raw:
        if key != "kind" and key not in keys:
            problems.append(Problem(f"design.{key[:60]}", Phrase("unknown key"), did_you_mean(key, keys)))
    for key, one in keys.items():
        where = f"design.{key}"
        if key in raw:
            values[key] = _value(where, one.metadata["form"], raw[key], problems)
        elif one.default is MISSING:
            problems.append(Problem(where, Phrase("is missing"), from_others(one.metadata["description"])))
    if len(problems) > before:
        return None
    if made is BarPositionsTask:
        return _bar_positions(values, problems)
    return made(**values)


def _kind_meant(kind: str) -> Wording:
    """The kinds that there are, the nearest first."""
    hint, known = did_you_mean(kind, KINDS), Phrase("the kinds are", names=", ".join(KINDS))
    return Phrase("one sentence and another", first=hint, second=known) if hint.key == "did you mean" else known


def _value(where: str, form: str, value: object, problems: list[Problem]) -> object:
    """A value in its form; a problem where it is none."""
    if form in ("length", "number", "offset"):
        return _positive(where, value, problems, zero=form == "offset")
    if form == "place":
        return _place(where, value, problems)
    if form == "angles":
        return _pair(where, value, problems, Phrase("two angles in degrees are wanted 30 30"))
    wanted = Phrase("crank angle rocker angle") if form == "pairs" else "{ B = [x, y], C = [x, y] }"
    if not isinstance(value, list) or len(value) != 3:
        found = (
            Phrase("found of them", count=len(value))
            if isinstance(value, list)
            else Phrase("found value", value=shown(value))
        )
        problems.append(Problem(where, found, Phrase("three of are wanted", wanted=wanted)))
        return None
    if form == "pairs":
        return tuple(
            _pair(f"{where}.{i}", one, problems, Phrase("two angles in degrees are wanted 30 60"))
            for i, one in enumerate(value, 1)
        )
    return [_bar(f"{where}.{i}", one, problems) for i, one in enumerate(value, 1)]


def _bar(where: str, value: object, problems: list[Problem]) -> OwnTables:
    """A place of a bar as it is written: B with C or angle."""
    if not isinstance(value, dict):
        problems.append(Problem(where, Phrase("found value", value=shown(value)), Phrase("write b x y c x y")))
        return {}
    problems += [
        Problem(f"{where}.{key[:60]}", Phrase("unknown key"), did_you_mean(key, ["B", "C", "angle"]))
        for key in value
        if key not in ("B", "C", "angle")
    ]
    if ("C" in value) == ("angle" in value):
        found = Phrase("has both c and angle") if "C" in value else Phrase("has neither c nor angle")
        problems.append(Problem(where, found, Phrase("a bar lies where b and c lie")))
    made: OwnTables = {}
    if "B" not in value:
        problems.append(Problem(f"{where}.B", Phrase("is missing"), Phrase("the first point of the bar x y")))
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
        problems.append(Problem("design.BC", Phrase("is missing"), Phrase("length of the bar since its places are")))
    if not any(by_angle) and length:
        told = abs(bars[0]["C"] - bars[0]["B"])
        if abs(told - length) > 1e-3 * length:
            problems.append(
                Problem(
                    "design.BC",
                    Phrase("found value", value=f"{length:.6g}"),
                    Phrase("b and c of position 1 lie apart", value=f"{told:.6g}"),
                )
            )
    if ("A" in values) != ("D" in values):
        missing = "D" if "A" in values else "A"
        problems.append(
            Problem(f"design.{missing}", Phrase("is missing"), Phrase("both fixed pivots are given or none"))
        )
    if problems:
        return None
    placed = [
        BarPlace(bar["B"], bar["C"] if "C" in bar else bar["B"] + length * direction(bar["angle"])) for bar in bars
    ]
    own = abs(placed[0].C - placed[0].B)
    for i, bar in enumerate(placed, 1):
        here = abs(bar.C - bar.B)
        if here < SMALLEST:
            problems.append(
                Problem(f"design.positions.{i}", Phrase("b and c lie at one place"), Phrase("a bar has a length"))
            )
        elif abs(here - own) > 1e-3 * own:
            problems.append(
                Problem(
                    f"design.positions.{i}",
                    Phrase("the bar is long", value=f"{here:.6g}"),
                    Phrase("in position 1", name=f"{own:.6g}"),
                )
            )
    angles = tuple(degrees(bar.C - bar.B) for bar in placed)
    first, second, third = placed
    task = BarPositionsTask(positions=(first, second, third), BC=length or None, angles=angles)
    return None if problems else replace(task, A=values.get("A"), D=values.get("D"))


def _positive(where: str, value: object, problems: list[Problem], zero: bool = False) -> float:
    number = _finite(where, value, problems)
    if number is None:
        return 0.0
    if number < 0.0 or (number < SMALLEST and not (zero and number == 0.0)):
        key = (
            "found a negative number"
            if number < 0
            else "found nothing"
            if number == 0
            else "found far too small a number"
        )
        wanted = Phrase("it must be positive or 0" if zero else "it must be positive")
        problems.append(Problem(where, Phrase(key, number=f"{number:.15g}"), wanted))
    return number


def _finite(where: str, value: object, problems: list[Problem]) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        problems.append(Problem(where, Phrase("found value", value=shown(value)), Phrase("a number is wanted")))
    elif not math.isfinite(value) or abs(value) > LARGEST:
        problems.append(
            Problem(
                where,
                Phrase("found value", value=shown(value)),
                Phrase("a finite number up to is wanted", largest=f"{LARGEST:g}"),
            )
        )
    else:
        return float(value)
    return None


def _pair(where: str, value: object, problems: list[Problem], wanted: Wording) -> tuple[float, float]:
    if not isinstance(value, list) or len(value) != 2:
        problems.append(Problem(where, Phrase("found value", value=shown(value)), wanted))
        return 0.0, 0.0
    first, second = (_finite(where, one, problems) for one in value)
    return first or 0.0, second or 0.0


def _place(where: str, value: object, problems: list[Problem]) -> complex:
    return complex(*_pair(where, value, problems, Phrase("a place is x y")))
