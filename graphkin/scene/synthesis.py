"""Design files: what a mechanism shall do, from which its lengths are to be found, as typed tables in the file's units.

Each kind of task is a class whose fields are the keys of ``[design]``.  A wish that no mechanism can meet is not asked
here: a file may be right and its wish impossible.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

from graphkin.files import Json
from graphkin.scene.sheet import SheetWishes
from graphkin.scene.tables import Units

__all__ = [
    "KINDS",
    "BarPlace",
    "BarPositionsTask",
    "CrankRockerTask",
    "Design",
    "DesignTask",
    "FunctionTask",
    "GuideBarTask",
    "LimitsTask",
    "SliderCrankTask",
    "scene_table",
]

def _length(description: str, **more: Any) -> Any:
    return field(metadata={"form": "length", "description": description}, **more)


def _number(description: str, **more: Any) -> Any:
    return field(metadata={"form": "number", "description": description}, **more)


@dataclass(frozen=True, kw_only=True)
class SliderCrankTask:
    """A slider-crank for a stroke, an offset of the slide's line from the crank's pivot, and K."""

    kind: ClassVar = "slider-crank"
    stroke: float = _length("stroke of the slider")
    offset: float = field(default=0.0, metadata={"form": "offset", "description": "offset of its line from the pivot"})
    K: float = _number("coefficient of travel-speed variation")


@dataclass(frozen=True, kw_only=True)
class CrankRockerTask:
    """A crank-rocker for the swing of its rocker and K."""

    kind: ClassVar = "crank-rocker"
    swing: float = _number("swing of the rocker in degrees")
    rocker: float = _length("length CD of the rocker")
    K: float = _number("coefficient of travel-speed variation")
    frame: float = _length("distance AD of the fixed pivots")


@dataclass(frozen=True, kw_only=True)
class GuideBarTask:
    """A swinging guide bar that moves a ram by a rod, for the ram's stroke and K."""

    kind: ClassVar = "guide-bar"
    stroke: float = _length("stroke of the ram")
    centres: float = _length("distance AC of the fixed pivots")
    K: float = _number("coefficient of travel-speed variation")
    rod: float | None = _length("length of the rod, as long as the stroke if left out", default=None)

    @property
    def rod_length(self) -> float:
        return self.stroke if self.rod is None else self.rod


@dataclass(frozen=True, kw_only=True)
class LimitsTask:
    """A crank-rocker whose rocker stands at two angles in its limit positions."""

    kind: ClassVar = "limits"
    A: complex = field(metadata={"form": "place", "description": "pivot of the crank, [x, y]"})
    D: complex = field(metadata={"form": "place", "description": "pivot of the rocker, [x, y]"})
    rocker: float = _length("length CD of the rocker")
    angles: tuple[float, float] = field(metadata={"form": "angles", "description": "two angles of DC in degrees"})


@dataclass(frozen=True)
class BarPlace:
    """Where a bar lies: two points of it."""

    B: complex
    C: complex

    def moved(self, place: complex, to: BarPlace) -> complex:
        """Where a place carried along with the bar lies when the bar lies ``to``."""
        turn = (to.C - to.B) / (self.C - self.B)
        return to.B + (place - self.B) * turn / abs(turn)


@dataclass(frozen=True, kw_only=True)
class BarPositionsTask:
    """A four-bar whose coupler lies in three given places, by its moving pivots B and C, or by its fixed pivots."""

    kind: ClassVar = "three-positions"
    positions: tuple[BarPlace, BarPlace, BarPlace] = field(
        metadata={"form": "positions", "description": "three places of the bar"}
    )
    BC: float | None = _length("length of the bar, where its places are told by B and an angle", default=None)
    A: complex | None = field(default=None, metadata={"form": "place", "description": "a fixed pivot, [x, y]"})
    D: complex | None = field(default=None, metadata={"form": "place", "description": "the other fixed pivot, [x, y]"})
    angles: tuple[float, ...] = field(default=(), metadata={"form": "beside"})  # as given, degrees


@dataclass(frozen=True, kw_only=True)
class FunctionTask:
    """A four-bar whose rocker stands at given angles for three angles of its crank."""

    kind: ClassVar = "function"
    frame: float = _length("distance AD of the fixed pivots", default=1.0)
    pairs: tuple[tuple[float, float], tuple[float, float], tuple[float, float]] = field(
        metadata={"form": "pairs", "description": "three of [crank angle, rocker angle] in degrees"}
    )


DesignTask = SliderCrankTask | CrankRockerTask | GuideBarTask | LimitsTask | BarPositionsTask | FunctionTask
KINDS: dict[str, type[DesignTask]] = {
    kind.kind: kind
    for kind in (SliderCrankTask, CrankRockerTask, GuideBarTask, LimitsTask, BarPositionsTask, FunctionTask)
}


@dataclass(frozen=True, kw_only=True)
class Design:
    """A design file: a task with its units and the wishes for its sheet."""

    task: DesignTask
    name: str = "design"
    title: str = ""
    title_zh: str = ""
    source: str = ""
    units: Units = field(default_factory=Units)
    sheet: SheetWishes = field(default_factory=SheetWishes)

    def title_in(self, language: str) -> str:
        """Title in a language, the other where there is none."""
        return (self.title_zh or self.title) if language == "zh" else (self.title or self.title_zh)


def scene_table(design: Design, lengths: Mapping[str, float], places: Mapping[str, complex]) -> dict[str, Json]:
    """The scene of a mechanism that was found, as a mapping, in the position in which its points lie at ``places``.

    Frame 0, crank 1, coupler or block 2, output 3 (slider, rocker, guide bar), of a guide bar rod 4 and ram 5.
    """
    task = design.task
    fixed = [name for name in ("A", "C" if isinstance(task, GuideBarTask) else "D") if name in places]
    frame: dict[str, Json] = {"name": "0", "points": {name: _pair_of(places[name]) for name in fixed}}
    links: dict[str, Json]
    moving = "B"
    if isinstance(task, SliderCrankTask):
        frame["guides"] = {"h": {"through": [0.0, places["C"].imag], "angle": 0.0}}
        links = {"1": _bar_link("A", "B", lengths), "2": _bar_link("B", "C", lengths),
                 "3": {"points": ["C"], "on": "0.h"}}  # fmt: skip
    elif isinstance(task, GuideBarTask):
        frame["guides"] = {"h": {"through": [0.0, places["E"].imag], "angle": 0.0}}
        links = {
            "1": _bar_link("A", "B", lengths), "2": {"points": ["B"], "on": "3"}, "3": _bar_link("C", "D", lengths),
            "4": {"points": ["D", "E"], "length": task.rod_length}, "5": {"points": ["E"], "on": "0.h"},
        }  # fmt: skip
    elif "M" in places:
        moving = "M"
        coupler = _bar_link("M", "N", lengths)
        turn = (places["N"] - places["M"]).conjugate() / abs(places["N"] - places["M"])
        coupler["at"] = {name: _pair_of((places[name] - places["M"]) * turn) for name in ("B", "C")}
        links = {"1": _bar_link("A", "M", lengths), "2": coupler, "3": _bar_link("D", "N", lengths)}
    else:
        links = {"1": _bar_link("A", "B", lengths), "2": _bar_link("B", "C", lengths),
                 "3": {"points": ["D", "C"], "length": lengths["CD"]}}  # fmt: skip
    angle = math.degrees(cmath.phase(places[moving] - places["A"]))
    made = {key: text for key in ("title", "title_zh", "source") if (text := getattr(design, key))}
    return {
        **made, "units": {"length": design.units.length}, "frame": frame, "links": links,
        "driver": {"link": "1", "angle": angle, "omega": 1.0},
        "sketch": {name: _pair_of(z) for name, z in places.items() if name not in fixed},
    }  # fmt: skip


def _bar_link(first: str, second: str, lengths: Mapping[str, float]) -> dict[str, Json]:
    return {"points": [first, second], "length": lengths[first + second]}


def _pair_of(z: complex) -> list[float]:
    return [z.real, z.imag]
