"""What the tables of a scene file have in common: units, kinds of values, keys, and places by their path.

A table of the file is a class, a key a field of it, made by `key`, which tells what stands there and in which unit:
reading (`in_si`) and writing (`in_units`) take it from there, and so does the JSON schema for editors.  A table holds
what a file says in the file's own names; what may stand in it is asked when a scene is made (`graphkin.scene.form`).
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import MISSING, Field, dataclass, fields, replace
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, NamedTuple, TypeVar, dataclass_transform

from pydantic import Discriminator, Strict, StringConstraints, Tag
from pydantic import Field as Rule

from graphkin.files import OwnTables, Tables
from graphkin.words import LANGUAGES

__all__ = [
    "SMALLEST", "Asked", "Count", "FileTable", "GuideRef", "GuideRefs", "KeyPath", "Language", "Least", "LinkName",
    "LinkNames", "List", "Magnitude", "Measure", "NameOrPlace", "NotNegative", "Number", "NumberOrSquare", "Numbers",
    "Part", "Place", "PointName", "PointNames", "PositionName", "Share", "ShownName", "SlideRef", "Stated", "Switch",
    "Symbols", "Text", "Tool", "TwoLengths", "TwoPoints", "Unit", "Units", "entries", "file_table",
    "file_table_by_name", "form_of_driver", "form_of_list", "forms", "in_si", "in_units", "item_of", "key", "key_of",
    "keys_of", "path_of_key", "put_at", "tidy", "value_at", "xy",
]  # fmt: skip

AnyTable = TypeVar("AnyTable", bound="FileTable")

SMALLEST, LARGEST = 1e-15, 1e15
"""The smallest length, and the smallest rate that is not 0; the largest number."""
LONGEST_TEXT = 300

# -- kinds of values ---------------------------------------------------------------------------------------------------

if TYPE_CHECKING:
    List = Sequence  # what a caller may give; the reader makes lists of it
    Language = str
else:
    List = list
    Language = Literal[LANGUAGES]  # as many as there are tables of words

Switch = Annotated[bool, Strict()]
Number = Annotated[float, Rule(strict=True, allow_inf_nan=False, ge=-LARGEST, le=LARGEST)]
Magnitude = Annotated[float, Rule(strict=True, allow_inf_nan=False, ge=SMALLEST, le=LARGEST)]
Tool = Annotated[float, Rule(strict=True, allow_inf_nan=False, ge=0, le=10)]
NotNegative = Annotated[float, Rule(strict=True, allow_inf_nan=False, ge=0, le=LARGEST)]
Share = Annotated[float, Rule(strict=True, ge=0, le=1)]
Least = Annotated[Number, Rule(ge=0, le=90)]
Part = Annotated[Number, Rule(gt=0, le=0.5)]
Count = Annotated[int, Rule(strict=True, ge=1, le=720)]
Asked = Annotated[int, Rule(strict=True, ge=1, le=100)]
Text = Annotated[str, Rule(strict=True, max_length=LONGEST_TEXT)]
PointName = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Z][A-Za-z0-9]*$", max_length=40)]
LinkName = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Za-z0-9]+$", max_length=40)]
GuideRef = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Za-z0-9]+(\.[A-Za-z0-9]+)?$", max_length=81)]
SlideRef = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Za-z0-9]+(/[A-Za-z0-9]+)?$", max_length=81)]
PositionName = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Za-z0-9'*._-]+$", max_length=20)]
ShownName = Annotated[str, StringConstraints(strict=True, max_length=20)] | Annotated[int, Rule(strict=True, ge=0)]
Place = Annotated[List[Number], Rule(min_length=2, max_length=2, description="[x, y]")]
TwoLengths = Annotated[List[Magnitude], Rule(min_length=2, max_length=2)]
TwoPoints = Annotated[List[PointName], Rule(min_length=2, max_length=2)]
PointNames = List[PointName]
LinkNames = List[LinkName]
Symbols = List[Annotated[str, Strict()]]


def _form(value: object) -> str | None:
    """Which of the forms of a value that may be written in several ways this is."""
    if isinstance(value, str):
        return "<name>"
    if isinstance(value, list):
        return "<list>"
    if isinstance(value, dict):
        return "<compass>" if isinstance(value.get("from"), list) else "<polar>"
    return "<number>" if isinstance(value, int | float) and not isinstance(value, bool) else None


def forms(wanted: str) -> Discriminator:
    """What tells the forms of a value apart; ``wanted`` is the key of the phrase that says which there are."""
    return Discriminator(_form, custom_error_type="form", custom_error_message=wanted)


def form_of_driver(value: object) -> str:
    """Whether a table drives a slide or an angle."""
    return "<slide>" if isinstance(value, dict) and "slide" in value and "link" not in value else "<angle>"


def form_of_list(value: object) -> str:
    """Whether there is one table or a list of them."""
    return "<list>" if isinstance(value, list) else "<one>"


NameOrPlace = Annotated[
    Annotated[PointName, Tag("<name>")] | Annotated[Place, Tag("<list>")], forms("write the name of a point b or")
]
GuideRefs = Annotated[
    Annotated[GuideRef, Tag("<name>")] | Annotated[List[GuideRef], Rule(min_length=1, max_length=2), Tag("<list>")],
    forms("write a guide as link or link.guide or"),
]
Numbers = Annotated[
    Annotated[Number, Tag("<number>")] | Annotated[List[Number], Rule(min_length=1, max_length=2), Tag("<list>")],
    forms("write a number or a list with one"),
]
NumberOrSquare = Annotated[
    Annotated[Number, Tag("<number>")] | Annotated[Literal["square"], Tag("<name>")],
    forms("write degrees or square for square to the"),
]
Stated = Annotated[
    Annotated[Number, Tag("<number>")]
    | Annotated[Place, Tag("<list>")]
    | Annotated[str, StringConstraints(strict=True, max_length=80), Tag("<name>")],
    forms("write a number 1.0 for its digits as"),
]

# -- tables and keys ---------------------------------------------------------------------------------------------------


class FileTable:
    """A table of a scene file."""

    __pydantic_config__: ClassVar = {"extra": "forbid", "defer_build": True}


def key(
    description: str, *, default: Any = MISSING, default_factory: Any = MISSING, name: str = "", unit: str = "",
    closed: bool = False,
) -> Any:  # fmt: skip
    """A key of a table.

    Parameters
    ----------
    default, default_factory : what holds where the key is left out
    name : the key in the file, where Python has that word for itself
    unit : the measure of its numbers, in whose unit the file has them; "" of what bears none or is left as written
    closed : of a table whose keys are names of a pattern: no others may stand in it
    """
    about: dict[str, object] = {"description": description, "unit": unit}
    if name:
        about["alias"] = name
    if closed:
        about["json_schema_extra"] = {"additionalProperties": False}
    if default_factory is not MISSING:
        return dataclasses.field(default_factory=default_factory, metadata=about)
    return dataclasses.field(default=default, metadata=about)


@dataclass_transform(frozen_default=True, field_specifiers=(key, dataclasses.field))
def file_table(kind: type[AnyTable]) -> type[AnyTable]:
    """Make a class of keys a table: an unchangeable dataclass."""
    return dataclass(frozen=True)(kind)


@dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(key, dataclasses.field))
def file_table_by_name(kind: type[AnyTable]) -> type[AnyTable]:
    """The same of a table whose keys are given by name only."""
    return dataclass(frozen=True, kw_only=True)(kind)


def keys_of(table: FileTable | type[FileTable]) -> Iterator[Field[object]]:
    """The fields of a table that stand in a file."""
    return (each for each in fields(table) if not each.metadata.get("beside"))  # type: ignore[arg-type]


def key_of(each: Field[object]) -> str:
    """A field's key in the file."""
    return str(each.metadata.get("alias", each.name))


def entries(table: FileTable) -> dict[str, object]:
    """The keys of a table as they stand in a file, without those that say what holds anyway.

    >>> from graphkin.scene.bodies import Link
    >>> entries(Link(points=["A", "B"], length=120))
    {'points': ['A', 'B'], 'length': 120}
    """
    found = {}
    for each in keys_of(table):
        value = getattr(table, each.name)
        usual = each.default_factory() if each.default_factory is not MISSING else each.default
        empty = usual in ({}, ()) and isinstance(value, Mapping | list | tuple) and not value
        if not empty and not (type(value) is type(usual) and value == usual):
            found[key_of(each)] = value
    return found


# -- units -------------------------------------------------------------------------------------------------------------

Measure = Literal[
    "velocity", "acceleration", "angular velocity", "angular acceleration", "length", "angle", "number", "force",
    "moment", "work", "inertia",
]
"""What a number measures: its unit follows from it and from the units of the scene."""


class Unit(NamedTuple):
    """A unit of one measure.

    text : as in the heads of tables, "mm/s2", "deg", "N m"; "" of a pure number
    si : what one of it is in SI
    """

    text: str
    si: float

    def of(self, value: Any) -> Any:
        """A number, or an array of any numbers, in this unit; given in SI."""
        return value * math.degrees(1.0) if self.text == "deg" else value / self.si

    @property
    def written(self) -> str:
        """As it stands on figures and papers: ``mm/s²``, ``°``, ``N·m``."""
        return self.text.replace("2", "²").replace("deg", "°").replace(" m", "·m")

    def beside(self, number: str) -> str:
        """A number, as it is written, with the unit beside it: ``482.7 mm/s``, ``30°``."""
        return f"{number}{'' if self.text == 'deg' else ' '}{self.written}".rstrip()

    def said(self, value: float) -> str:
        """A value (SI) in this unit, to six figures, with the unit beside it."""
        return self.beside(f"{self.of(value):.6g}")


LENGTHS: Mapping[str, float] = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
FORCES: Mapping[str, float] = {"N": 1.0, "kN": 1e3, "kgf": 9.80665, "lbf": 4.4482216152605}
MASSES: Mapping[str, float] = {"kg": 1.0, "g": 1e-3, "lb": 0.45359237}


@file_table
class Units(FileTable):
    """Units of the file."""

    length: Literal["mm", "cm", "m", "in", "ft"] = key(
        "The unit of every length; speeds are in it per second.", default="mm"
    )
    speed: Literal["mm/s", "cm/s", "m/s", "in/s", "ft/s"] | None = key(
        "The unit of velocities, where it is not the length unit per second; accelerations are per s.", default=None
    )
    force: Literal["N", "kN", "kgf", "lbf"] = key(
        "The unit of every force; moments are in it times metre.", default="N"
    )
    mass: Literal["kg", "g", "lb"] = key(
        "The unit of every mass; inertias are in it times m2 (ft2 with lb).", default="kg"
    )

    @property
    def metres(self) -> float:
        """One length unit in m."""
        return LENGTHS[self.length]

    @property
    def rates(self) -> Units:
        """The units in which the lengths in velocities and accelerations are counted."""
        length: Any = (self.speed or "").removesuffix("/s")
        return replace(self, length=length, speed=None) if length else self

    @property
    def newtons(self) -> float:
        """One force unit in N."""
        return FORCES[self.force]

    @property
    def kilograms(self) -> float:
        """One mass unit in kg."""
        return MASSES[self.mass]

    @property
    def inertias(self) -> float:
        """One unit of inertia in kg m2."""
        return self.of("inertia").si

    @property
    def per_si(self) -> tuple[float, float, float]:
        """What one metre, one radian and one metre in rates are in the units of tables."""
        return 1.0 / self.metres, math.degrees(1.0), 1.0 / self.rates.metres

    def of(self, measure: Measure, radians: bool = False) -> Unit:
        """The unit of a measure: what people read has its angles in degrees, what programs read in radians."""
        return _unit(self, measure, radians)


@cache
def _unit(units: Units, measure: str, radians: bool) -> Unit:
    fast = units.rates
    pounds = units.mass == "lb"
    return {
        "length": Unit(units.length, units.metres),
        "velocity": Unit(f"{fast.length}/s", fast.metres),
        "acceleration": Unit(f"{fast.length}/s2", fast.metres),
        "angle": Unit("rad", 1.0) if radians else Unit("deg", math.radians(1.0)),
        "angular velocity": Unit("rad/s", 1.0),
        "angular acceleration": Unit("rad/s2", 1.0),
        "number": Unit("", 1.0),
        "force": Unit(units.force, units.newtons),
        "moment": Unit(f"{units.force} m", units.newtons),
        "work": Unit(f"{units.force} m", units.newtons),
        "mass": Unit(units.mass, units.kilograms),
        "inertia": Unit(f"{units.mass} {'ft2' if pounds else 'm2'}", units.kilograms * (0.3048**2 if pounds else 1.0)),
        "stiffness": Unit(f"{units.force}/{units.length}", units.newtons / units.metres),
    }[measure]


def in_si(table: AnyTable, units: Units) -> AnyTable:
    """A table of a file, and those in it, with every number whose key tells its unit in SI."""
    return _converted(table, lambda number, measure: number * _unit(units, measure, False).si)


def in_units(table: AnyTable, units: Units) -> AnyTable:
    """A table with its numbers in SI as it stands in a file of these units, without the noise of the conversion."""
    return _converted(table, lambda number, measure: tidy(_unit(units, measure, False).of(number)))


def _converted(table: AnyTable, change: Callable[[float, str], float]) -> AnyTable:
    """A table with its numbers changed by the measures that its keys tell."""

    def changed(value: Any, measure: str) -> Any:
        if isinstance(value, FileTable):
            return _converted(value, change)
        if isinstance(value, Mapping):
            return {name: changed(item, measure) for name, item in value.items()}
        if isinstance(value, list | tuple):
            return type(value)(changed(item, measure) for item in value)
        number = isinstance(value, int | float) and not isinstance(value, bool)
        return change(value, measure) if measure and number else value

    return replace(table, **{each.name: changed(getattr(table, each.name), each.metadata.get("unit", ""))
                           for each in keys_of(table)})  # type: ignore[type-var]


def tidy(value: float) -> float:
    """A number without the noise of unit conversion."""
    return float(f"{value:.13g}") + 0.0


def xy(place: complex) -> list[float]:
    """A place as a file has it: its two coordinates."""
    return [place.real, place.imag]


# -- places by their path ----------------------------------------------------------------------------------------------

KeyPath = tuple[str | int, ...]
"""A place in a file: keys, and numbers of items of lists."""


def item_of(part: str, count: int) -> int | None:
    """Which item of a list of so many a part of a key names: counted from 1, or ``x`` and ``y`` of a place.

    >>> item_of("2", 3), item_of("y", 2), item_of("0", 2), item_of("z", 3)
    (1, 1, None, None)
    """
    index = {"x": 0, "y": 1}.get(part, int(part) - 1 if part.isdecimal() else -1)
    return index if 0 <= index < count else None


def path_of_key(tables: Tables, dotted: str) -> KeyPath | None:
    """The path of a key with dots; None where there is nothing.

    >>> path_of_key({"frame": {"points": {"D": [3, 4]}}}, "frame.points.D.y")
    ('frame', 'points', 'D', 1)
    >>> path_of_key({"frame": {"points": {"D": [3, 4]}}}, "frame.points.E.y") is None
    True
    """
    path: list[str | int] = []
    place: object = tables
    for part in dotted.split("."):
        step = item_of(part, len(place)) if isinstance(place, list | tuple) else part
        place = None if step is None else value_at(place, (step,))
        if step is None or place is None:
            return None
        path.append(step)
    return tuple(path)


def value_at(place: object, path: KeyPath) -> Any:
    """What stands at a path of tables, or of a part of them; None where there is nothing.

    >>> value_at({"driver": [{"angle": 40}]}, ("driver", 0, "angle")), value_at({"driver": []}, ("driver", 0, "angle"))
    (40, None)
    """
    for step in path:
        if isinstance(place, Mapping):
            place = place.get(step)
        elif isinstance(place, list | tuple) and isinstance(step, int) and step < len(place):
            place = place[step]
        else:
            return None
    return place


def put_at(tables: OwnTables, path: KeyPath, value: object) -> None:
    """Put a value at a path whose tables are there.  Raises TypeError where they are not."""
    value_at(tables, path[:-1])[path[-1]] = value
