"""Design files: a task that a mechanism shall fulfil, from which its lengths are found; all problems of a file are told
at once.

Each kind of task is a table whose fields are the keys of ``[design]``.  A wish that no mechanism can meet is no problem
of the file.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, get_args

from pydantic import AfterValidator
from pydantic import Field as Rule

from graphkin.errors import Problem, SceneError, did_you_mean, unfit
from graphkin.files import Json, OwnTables, Tables
from graphkin.plane import degrees, direction
from graphkin.scene.scene import file_text, files_named, library, parsed, safe_name, shelf
from graphkin.scene.scene_tables import SMALLEST, List, Magnitude, NotNegative, Number, Place, SheetWishes, Text
from graphkin.scene.tables import FileTable, Form, Units, file_table, file_table_by_name, plain, shown, tidy, xy
from graphkin.words import Phrase, Wording, listed

SAME_BAR = 1e-3
"""Of its length: so much a bar may differ between its places."""

Pair = Annotated[List[Number], Rule(min_length=2, max_length=2)]
if TYPE_CHECKING:
    Point = complex
    FarPoint = complex
    Bars = tuple["BarPlace", "BarPlace", "BarPlace"]
else:
    Point = Annotated[Place, AfterValidator(lambda place: complex(*place))]
    FarPoint = Point | None
    Bars = Annotated[list["BarPlace"], Rule(min_length=3, max_length=3)]


@file_table_by_name
class SliderCrankTask(FileTable):
    """A slider-crank for a stroke, an offset of the slide's line from the crank's pivot, and K."""

    kind: ClassVar = "slider-crank"
    stroke: Magnitude
    offset: NotNegative = 0.0
    K: Magnitude


@file_table_by_name
class CrankRockerTask(FileTable):
    """A crank-rocker for the swing of its rocker and K."""

    kind: ClassVar = "crank-rocker"
    swing: Magnitude
    rocker: Magnitude
    K: Magnitude
    frame: Magnitude


@file_table_by_name
class GuideBarTask(FileTable):
    """A swinging guide bar that moves a ram by a rod, for the ram's stroke and K."""

    kind: ClassVar = "guide-bar"
    stroke: Magnitude
    centres: Magnitude
    K: Magnitude
    rod: Magnitude | None = None

    @property
    def rod_length(self) -> float:
        return self.stroke if self.rod is None else self.rod


@file_table_by_name
class LimitsTask(FileTable):
    """A crank-rocker whose rocker stands at two angles in its limit positions."""

    kind: ClassVar = "limits"
    A: Point
    D: Point
    rocker: Magnitude
    angles: Pair


@file_table
class BarPlace(FileTable):
    """The place of a bar: two points of it, or in a file the first and its angle (degrees)."""

    B: Point
    C: FarPoint = None  # type: ignore[assignment]  # placed when it is read
    angle: Number | None = None

    def moved(self, place: complex, to: BarPlace) -> complex:
        """The place of a point carried along with the bar when the bar lies ``to``."""
        turn = (to.C - to.B) / (self.C - self.B)
        return to.B + (place - self.B) * turn / abs(turn)


@file_table_by_name
class BarPositionsTask(FileTable):
    """A four-bar whose coupler lies in three given places, by its moving pivots B and C, or by its fixed pivots."""

    kind: ClassVar = "three-positions"
    positions: Bars
    BC: Magnitude | None = None
    A: Point | None = None
    D: Point | None = None


@file_table_by_name
class FunctionTask(FileTable):
    """A four-bar whose rocker stands at given angles for three angles of its crank."""

    kind: ClassVar = "function"
    frame: Magnitude = 1.0
    pairs: Annotated[List[Pair], Rule(min_length=3, max_length=3)]


DesignTask = SliderCrankTask | CrankRockerTask | GuideBarTask | LimitsTask | BarPositionsTask | FunctionTask
KINDS: dict[str, type[DesignTask]] = {kind.kind: kind for kind in get_args(DesignTask)}


@file_table_by_name
class Design(FileTable):
    """A design file: a task, read from its table ``design``, with its units and the wishes for its sheet."""

    title: Text = ""
    title_zh: Text = ""
    source: Text = ""
    design: dict[str, Any] = field(default_factory=dict)
    units: Units = Units()
    sheet: SheetWishes = SheetWishes()
    task: DesignTask = field(default=None, metadata={"beside": True})  # type: ignore[assignment]  # read after the file
    name: str = field(default="design", metadata={"beside": True})

    def title_in(self, language: str) -> str:
        """Title in a language, the other where there is none."""
        return (self.title_zh or self.title) if language == "zh" else (self.title or self.title_zh)


DESIGN = Form(Design, "graphkin design")

# finding and reading

DesignLike = Design | str | os.PathLike[str] | Tables


def designs() -> tuple[str, ...]:
    """Names of the bundled design files, sorted."""
    return files_named(shelf() / "designs")


def is_design(source: object) -> bool:
    """Whether this is a design file, the name of a bundled one, or a mapping of the same shape, and no scene."""
    if isinstance(source, Mapping):
        return "design" in source and "links" not in source
    if not isinstance(source, str | os.PathLike):
        return isinstance(source, Design)
    text = os.fspath(source)
    if os.path.isfile(text):
        try:
            raw = parsed(file_text(text))
        except SceneError:
            return False
        return is_design(raw)
    return text in designs() and text not in library()


def design_of(source: DesignLike) -> Design:
    """Read a design file.

    Parameters
    ----------
    source : a path, the name of a bundled design, or the mapping that a TOML parser makes of a design file

    Raises
    ------
    SceneError : with all problems of the file
    """

    if isinstance(source, Design):
        return source
    if isinstance(source, str) and source in designs() and not os.path.isfile(source):
        raw, name = parsed((shelf() / "designs" / f"{source}.toml").read_text(encoding="utf-8")), source
    elif isinstance(source, str | os.PathLike):
        text = os.fspath(source)
        if "/" not in text and not text.endswith(".toml") and not os.path.isfile(text):
            if text in library():
                raise SceneError.of(text, "is a scene no design", "a design file has a table design with")
            raise SceneError.of(text[:200], "there is no such file and no design", did_you_mean(text[:60], designs()))
        raw, name = parsed(file_text(text)), Path(text).stem
    else:
        if not isinstance(source, Mapping):
            raise unfit("design", source, "give a file the name of a design")
        raw, name = plain(source), "design"
    return _read(raw, safe_name(name))


def _read(raw: Tables, name: str) -> Design:
    problems: list[Problem] = []
    given = plain(raw)
    if "links" in given:
        fault = Phrase("unknown table") if isinstance(given.pop("links"), dict) else Phrase("unknown key")
        problems.append(Problem("links", fault, "this is a scene a design file has"))
    if not given.get("design"):
        problems.append(Problem("design", "is missing", "a design file has a table design with"))
    design, wrong, _ = DESIGN.checked(given)
    task = _task(design.design, problems) if design.design else None
    problems += wrong
    if problems or task is None:
        raise SceneError(*problems)
    return replace(design, task=task, name=name)


def _task(raw: OwnTables, problems: list[Problem]) -> DesignTask | None:
    """The task of a table; None where it has problems, which are added to ``problems``."""
    kind = raw.pop("kind", None)
    if kind is None:
        problems.append(Problem("design.kind", "is missing", "one of", names=listed([*KINDS])))
        return None
    if not isinstance(kind, str) or kind not in KINDS:
        near, known = did_you_mean(str(kind), KINDS), Phrase("the kinds are", names=listed([*KINDS]))
        meant = Phrase("two sentences", first=near, second=known) if near.key == "did you mean" else known
        problems.append(Problem("design.kind", "found value", meant, value=shown(kind)))
        return None
    wrong: tuple[Problem, ...] | list[Problem]
    try:
        task, wrong, _ = Form(KINDS[kind], kind).checked(raw)
    except SceneError as error:
        wrong = error.problems
    problems += (replace(problem, where=f"design.{problem.where}") for problem in wrong)
    if wrong:
        return None
    return _bar_positions(task, problems) if isinstance(task, BarPositionsTask) else task


def _bar_positions(task: BarPositionsTask, problems: list[Problem]) -> BarPositionsTask | None:
    """The task with each place of the bar by two points; None where the places do not agree, which is noted."""
    bars: list[BarPlace] = list(task.positions)
    length, before = task.BC or 0.0, len(problems)

    def say(where: str, found: Wording, wanted: Wording, **gaps: object) -> None:
        problems.append(Problem(f"design.{where}", found, wanted, **gaps))

    for i, bar in enumerate(bars, 1):
        if (bar.C is None) == (bar.angle is None):
            fault = Phrase("has neither c nor angle") if bar.C is None else Phrase("has both c and angle")
            say(f"positions.{i}", fault, "a bar lies where b and c lie")
    by_angle = any(bar.angle is not None for bar in bars)
    if by_angle and not length:
        say("BC", "is missing", "length of the bar since its places are")
    if (task.A is None) != (task.D is None):
        missing = "A" if task.A is None else "D"
        say(missing, "is missing", "both fixed pivots are given or none")
    if len(problems) > before:
        return None
    placed = [bar if bar.angle is None else BarPlace(bar.B, bar.B + length * direction(bar.angle)) for bar in bars]
    first_length = abs(placed[0].C - placed[0].B)
    if not by_angle and length and abs(first_length - length) > SAME_BAR * length:
        wanted = Phrase("b and c of position 1 lie apart", value=f"{first_length:.6g}")
        say("BC", Phrase("found value", value=f"{length:.6g}"), wanted)
    for i, place in enumerate(placed, 1):
        here = abs(place.C - place.B)
        if here < SMALLEST:
            say(f"positions.{i}", "b and c lie at one place", "a bar has a length")
        elif abs(here - first_length) > SAME_BAR * first_length:
            say(f"positions.{i}", "the bar is long", "in position 1", value=f"{here:.6g}", name=f"{first_length:.6g}")
    first, second, third = placed
    return None if len(problems) > before else replace(task, positions=(first, second, third))


# the mechanism that was found


def scene_table(design: Design, lengths: Mapping[str, float], places: Mapping[str, complex]) -> dict[str, Json]:
    """The scene of a designed mechanism, as a mapping, in the position with its points at ``places``.

    Frame 0, crank 1, coupler or block 2, output 3 (slider, rocker, guide bar), of a guide bar rod 4 and ram 5.
    """
    task = design.task
    fixed = [name for name in ("A", "C" if isinstance(task, GuideBarTask) else "D") if name in places]
    frame: dict[str, Json] = {"name": "0", "points": {name: xy(places[name]) for name in fixed}}
    links: dict[str, Json]
    moving = "B"
    if isinstance(task, SliderCrankTask):
        frame["guides"] = {"h": {"through": [0.0, places["C"].imag], "angle": 0.0}}
        links = {"1": _bar_link("A", "B", lengths), "2": _bar_link("B", "C", lengths),
                 "3": {"points": ["C"], "on": "0.h"}}
    elif isinstance(task, GuideBarTask):
        frame["guides"] = {"h": {"through": [0.0, places["E"].imag], "angle": 0.0}}
        links = {
            "1": _bar_link("A", "B", lengths), "2": {"points": ["B"], "on": "3"}, "3": _bar_link("C", "D", lengths),
            "4": {"points": ["D", "E"], "length": task.rod_length}, "5": {"points": ["E"], "on": "0.h"},
        }
    elif "M" in places:
        moving = "M"
        coupler = _bar_link("M", "N", lengths)
        turn = (places["N"] - places["M"]).conjugate() / abs(places["N"] - places["M"])
        coupler["at"] = {name: xy((places[name] - places["M"]) * turn) for name in ("B", "C")}
        links = {"1": _bar_link("A", "M", lengths), "2": coupler, "3": _bar_link("D", "N", lengths)}
    else:
        links = {"1": _bar_link("A", "B", lengths), "2": _bar_link("B", "C", lengths),
                 "3": {"points": ["D", "C"], "length": lengths["CD"]}}
    angle = tidy(degrees(places[moving] - places["A"]))
    made = {key: text for key in ("title", "title_zh", "source") if (text := getattr(design, key))}
    return {
        **made, "units": {"length": design.units.length}, "frame": frame, "links": links,
        "driver": {"link": "1", "angle": angle, "omega": 1.0},
        "sketch": {name: xy(z) for name, z in places.items() if name not in fixed},
    }


def _bar_link(first: str, second: str, lengths: Mapping[str, float]) -> dict[str, Json]:
    return {"points": [first, second], "length": lengths[first + second]}
