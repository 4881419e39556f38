"""What the tables of a file have in common: kinds of values, keys, units, places by their path; and the form of a file,
by which every wrong key and value in it is told at once.

A table of the file is a class, a key a field of it, whose type tells what may stand there, and `key` in which unit:
reading (`in_si`) and writing (`in_units`) take it from there, and so does the JSON schema for editors.  The tables of
words explain each key under the names of table and key.  A table holds the values of a file under the file's names;
they are checked when a scene is made (`Form.checked`).

A wrong entry is reported and taken out, a misspelt key is reported and read as the key that was meant.  The rest is a
valid file, of which the later checks (do the names exist, do the lengths meet) can still be made.  The paths of removed
entries are kept, so that nothing is reported twice.
"""

from __future__ import annotations

import dataclasses
import math
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import MISSING, Field, dataclass, fields, replace
from difflib import get_close_matches
from functools import cache
from itertools import takewhile
from numbers import Integral, Real
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    ClassVar,
    Generic,
    Literal,
    NamedTuple,
    Self,
    TypeVar,
    dataclass_transform,
    get_args,
    get_origin,
    get_type_hints,
)

from pydantic import Tag, TypeAdapter, ValidationError
from pydantic_core.core_schema import no_info_plain_validator_function

from graphkin.errors import Problem, SceneError, did_you_mean
from graphkin.files import Json, OwnTables, Tables
from graphkin.words import Phrase, Wording, area, from_others, listed, say

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic.json_schema import JsonSchemaValue
    from pydantic_core.core_schema import CoreSchema

AnyTable = TypeVar("AnyTable", bound="FileTable")

TABLE = "$table"
"""The key of a schema at which a table inside another is named."""

# tables and keys


class FileTable:
    """A table of a scene file; each key is set once, when it is made.

    What a dataclass would write anew for each of the forty tables stands here once: a command loads them all.
    """

    __pydantic_config__: ClassVar = {"extra": "forbid", "defer_build": True}

    def __setattr__(self, name: str, value: object) -> None:
        if name in vars(self):
            raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")
        super().__setattr__(name, value)

    def __delattr__(self, name: str) -> None:
        raise dataclasses.FrozenInstanceError(f"cannot delete field {name!r}")

    def __eq__(self, other: object) -> bool:
        alike = isinstance(other, FileTable) and type(other) is type(self)
        return self._values() == other._values() if alike else NotImplemented  # type: ignore[attr-defined]

    def __hash__(self) -> int:
        return hash(self._values())

    def __repr__(self) -> str:
        keys = ", ".join(f"{each.name}={getattr(self, each.name)!r}" for each in fields(self))  # type: ignore[arg-type]
        return f"{type(self).__qualname__}({keys})"

    def _values(self) -> tuple[object, ...]:
        return tuple(getattr(self, each.name) for each in fields(self) if each.compare)  # type: ignore[arg-type]

    @classmethod
    @cache
    def _rules(cls) -> TypeAdapter[Self]:
        """The rules of the table by its annotations, made once."""
        return TypeAdapter(cls)

    @classmethod
    def __get_pydantic_core_schema__(cls, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        """The rules of a whole file; of a table inside it they are made when a file has such a table, since most files
        have few of them."""
        if handler.field_name is None:
            return handler(source)
        return no_info_plain_validator_function(lambda value: cls._rules().validate_python(value))

    @classmethod
    def __get_pydantic_json_schema__(cls, rules: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        """The schema of a whole file; of a table inside it the name (see `Form.schema`)."""
        return handler(rules) if rules["type"] == "dataclass" else {TABLE: cls.__name__}


def key(*, default: Any = MISSING, name: str = "", unit: str = "", closed: bool = False) -> Any:
    """A key of a table with more rules than its type and its default.

    Parameters
    ----------
    default : the value of a key that is left out
    name : the key in the file, where Python has that word for itself
    unit : the measure of its numbers, in whose unit the file has them; "" for numbers without one or left as written
    closed : of a table of entries by their names: no key may stand there that is no name
    """
    about: dict[str, object] = {"unit": unit}
    if name:
        about["alias"] = name
    if closed:
        about["json_schema_extra"] = {"additionalProperties": False}
    return dataclasses.field(default=default, metadata=about)


def named(unit: str = "") -> Any:
    """A closed key that may be left out: there are no such entries then."""
    return dataclasses.field(default_factory=dict, metadata=key(unit=unit, closed=True).metadata)


def derived() -> Any:
    """A field of a dataclass that follows from the others: it is neither given nor shown nor compared."""
    return dataclasses.field(init=False, repr=False, compare=False)


@dataclass_transform(frozen_default=True, field_specifiers=(key, dataclasses.field))
def file_table(kind: type[AnyTable]) -> type[AnyTable]:
    """Make a class of keys a table."""
    return dataclass(eq=False, repr=False)(kind)


@dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(key, dataclasses.field))
def file_table_by_name(kind: type[AnyTable]) -> type[AnyTable]:
    """Make a class of keys a table whose keys are given by name only."""
    return dataclass(eq=False, repr=False, kw_only=True)(kind)


def keys_of(table: FileTable | type[FileTable]) -> Iterator[Field[object]]:
    """The fields of a table that stand in a file."""
    return (each for each in fields(table) if not each.metadata.get("beside"))  # type: ignore[arg-type]


def key_of(each: Field[object]) -> str:
    """A field's key in the file."""
    return str(each.metadata.get("alias", each.name))


def entries(table: FileTable) -> dict[str, object]:
    """The keys of a table as they stand in a file, without those at their defaults.

    >>> from graphkin.scene.bodies import Link
    >>> entries(Link(points=["A", "B"], length=120))
    {'points': ['A', 'B'], 'length': 120}
    """
    written = {}
    for each in keys_of(table):
        value = getattr(table, each.name)
        usual = each.default_factory() if each.default_factory is not MISSING else each.default
        empty = usual in ({}, ()) and isinstance(value, Mapping | list | tuple) and not value
        if not empty and not (type(value) is type(usual) and value == usual):
            written[key_of(each)] = value
    return written


# units

class Measure(NamedTuple):
    """What a number measures, by its dimension: powers of length, angle, force and mass, and the order of its
    derivative by time.

    Its unit in files, the spellings of that unit, the error bound by which a value is nothing, and the size of such
    values in a mechanism follow from these.  A further measure is a further entry of `MEASURES`.
    """

    name: str
    length: int = 0
    angle: int = 0
    order: int = 0
    force: int = 0
    mass: int = 0

    def usual(self, size: float, rate: Any, second: Any) -> Any:
        """The size of such values of motion in a mechanism (SI): of its ``size`` (m), by the ``rate`` of its drivers
        (rad/s) and their ``second`` rate with the square of the rate (rad/s2)."""
        return size**self.length * (second * rate ** (self.order - 2) if self.order > 1 else rate**self.order)

    @property
    def is_of_motion(self) -> bool:
        """Whether it is a length or an angle, or a derivative of one by time."""
        return self.length + self.angle == 1 and not self.force and not self.mass

    @property
    def is_angle(self) -> bool:
        return self.angle == 1 and not self.order

    @property
    def is_length(self) -> bool:
        return self.is_of_motion and self.length == 1 and not self.order


MEASURES: Mapping[str, Measure] = {
    measure.name: measure
    for measure in (
        Measure("length", length=1), Measure("velocity", length=1, order=1), Measure("acceleration", length=1, order=2),
        Measure("angle", angle=1), Measure("angular velocity", angle=1, order=1),
        Measure("angular acceleration", angle=1, order=2), Measure("number"), Measure("force", force=1),
        Measure("moment", length=1, force=1), Measure("work", length=1, force=1), Measure("mass", mass=1),
        Measure("inertia", length=2, mass=1), Measure("stiffness", length=-1, force=1),
    )
}
"""All measures by name."""


_IN_PRINT = str.maketrans("23 ", "²³·")


class Unit(NamedTuple):
    """A unit of one measure.

    text : as in the heads of tables, "mm/s2", "deg", "N m"; "" of a pure number
    si : one of it in SI
    """

    text: str
    si: float

    def of(self, value: Any) -> Any:
        """A number, or an array of any numbers, in this unit; given in SI."""
        return value * math.degrees(1.0) if self.text == "deg" else value / self.si

    @property
    def written(self) -> str:
        """The unit in print: ``mm/s²``, ``°``, ``N·m``."""
        return self.text.translate(_IN_PRINT).replace("deg", "°")

    def beside(self, number: str) -> str:
        """A number, as it is written, with the unit beside it: ``482.7 mm/s``, ``30°``."""
        return f"{number}{'' if self.text == 'deg' else ' '}{self.written}".rstrip()

    def said(self, value: float) -> str:
        """A value (SI) in this unit, to six figures, with the unit beside it; 0 has no sign."""
        return self.beside(f"{self.of(value) + 0.0:.6g}")


LENGTHS: Mapping[str, float] = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
FORCES: Mapping[str, float] = {"N": 1.0, "kN": 1e3, "kgf": 9.80665, "lbf": 4.4482216152605}
MASSES: Mapping[str, float] = {"kg": 1.0, "g": 1e-3, "lb": 0.45359237}


@file_table
class Units(FileTable):
    """Units of the file."""

    length: Literal["mm", "cm", "m", "in", "ft"] = "mm"
    speed: Literal["mm/s", "cm/s", "m/s", "in/s", "ft/s"] | None = None
    force: Literal["N", "kN", "kgf", "lbf"] = "N"
    mass: Literal["kg", "g", "lb"] = "kg"

    @property
    def metres(self) -> float:
        """One length unit in m."""
        return LENGTHS[self.length]

    @property
    def rates(self) -> Units:
        """The units of the lengths in velocities and accelerations."""
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

    def of(self, measure: Measure | str, radians: bool = False) -> Unit:
        """The unit of a measure, or of one by its name: people read angles in degrees, programs in radians."""
        names = self.length, self.speed, self.force, self.mass
        return _unit(names, MEASURES[measure] if isinstance(measure, str) else measure, radians)


@cache
def _unit(names: tuple[Any, Any, Any, Any], measure: Measure, radians: bool) -> Unit:
    """The product of the units in a measure; the arm of a force is in m, that of a mass in m, or in ft beside lb."""
    units = Units(*names)
    if measure.is_angle and not radians:
        return Unit("deg", math.radians(1.0))
    length = units.rates.length if measure.order else units.length
    if measure.length > 0 and (measure.force or measure.mass):
        length = "ft" if measure.mass and units.mass == "lb" else "m"
    powers = ((units.force, units.newtons, measure.force), (units.mass, units.kilograms, measure.mass),
              (length, LENGTHS[length], measure.length), ("rad", 1.0, measure.angle), ("s", 1.0, -measure.order))
    above, below = ([(f"{name}{abs(power) if abs(power) > 1 else ''}", si ** abs(power)) for name, si, power in powers
                     if power * sign > 0] for sign in (1, -1))
    (over, si), (under, per) = ((" ".join(name for name, _ in part), math.prod(si for _, si in part))
                                for part in (above, below))
    return Unit(f"{over}/{under}" if under else over, si / per)


def in_si(table: AnyTable, units: Units) -> AnyTable:
    """A table of a file, and the tables in it, with every number in SI whose key has a unit."""
    return _converted(table, lambda number, measure: number * units.of(measure).si)


def in_units(table: AnyTable, units: Units) -> AnyTable:
    """A table with its numbers in SI as it stands in a file of these units, without the noise of the conversion."""
    return _converted(table, lambda number, measure: tidy(units.of(measure).of(number)))


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
    """A number without the rounding of a unit's conversion."""
    return float(f"{value:.13g}") + 0.0


def xy(place: complex) -> list[float]:
    """A place as a file has it: its two coordinates."""
    return [place.real, place.imag]


# places by their path

KeyPath = tuple[str | int, ...]
"""A place in a file: keys, and numbers of items of lists."""


def item_of(part: str, count: int) -> int | None:
    """The index of the list's item that a part of a key names: counted from 1, or ``x`` and ``y`` of a place.

    >>> item_of("2", 3), item_of("y", 2), item_of("0", 2), item_of("z", 3)
    (1, 1, None, None)
    """
    index = {"x": 0, "y": 1}.get(part, int(part) - 1 if part.isdecimal() else -1)
    return index if 0 <= index < count else None


def path_of_key(tables: Tables, dotted: str) -> KeyPath | None:
    """The path of a key with dots; None where the tables have no such key.

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
    """The value at a path of tables, or of a part of them; None where there is none.

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


# the form of a file


MOST_VALUES = 20_000
DEEPEST = 8
ROUNDS = 50
"""So often what is left of a file is looked at again."""
UNKNOWN = "unexpected_keyword_argument"


class Form(Generic[AnyTable]):
    """The form of a kind of file.

    Parameters
    ----------
    whole : the type of the whole file, a table of tables
    title : what the schema calls it
    needed : the table without which a file is no scene, "" where every table may be missing
    """

    def __init__(self, whole: type[AnyTable], title: str, needed: str = "") -> None:
        self.whole, self.title, self.needed = whole, title, needed

    def checked(self, raw: OwnTables) -> tuple[AnyTable, list[Problem], frozenset[KeyPath]]:
        """Check the form of a file.  Returns its valid part, the problems, and the paths of the entries taken out.

        ``raw`` comes from `plain` and is changed: wrong entries are taken out of it.
        Raises SceneError where too little of a scene is left to check.
        """
        problems: dict[KeyPath, Problem] = {}
        gone: set[KeyPath] = set()
        for _ in range(ROUNDS):
            try:
                return self.whole._rules().validate_python(raw), list(problems.values()), frozenset(gone)
            except ValidationError as error:
                errors = error.errors(include_url=False)
            for item in sorted(errors, key=lambda e: e["type"] != UNKNOWN):
                loc: KeyPath = tuple(item["loc"])
                path = _written_path(loc)
                missing = item["type"] == "missing"
                if missing and value_at(raw, path) is not None:
                    continue  # it was there under a misspelt name
                if path not in problems and not (missing and path in gone):  # that it is wrong was told
                    problems[path] = self._problem(loc, path, dict(item))
                meant = self._meant(loc, raw) if item["type"] == UNKNOWN else None
                if meant is not None:
                    _read_as(raw, path, meant)
                else:
                    cut = _take_out(raw, self._cut(loc))
                    if item["type"] != UNKNOWN or isinstance(item["input"], list | dict):
                        gone.add(cut)
            if self.needed and not raw.get(self.needed):
                break
        raise SceneError(*problems.values())

    def table_at(self, loc: Sequence[str | int]) -> type[FileTable] | None:
        """The table that stands at a place of a file, as pydantic names places: with a tag ("<one>") where a value has
        several forms.  None where there is no table.

        >>> from graphkin.scene.scene_tables import SCENE
        >>> SCENE.table_at(("links", "2", "guides", "g")).__name__
        'Guide'
        >>> SCENE.table_at(("driver", "<list>", 1, "<slide>")).__name__
        'DrivenSlide'
        """
        return _within(self.whole, tuple(loc))

    def holds_tables(self, key: str) -> bool:
        """Whether the entries of a table are tables by name, each with a head of its own in the file.

        >>> from graphkin.scene.scene_tables import SCENE
        >>> SCENE.holds_tables("masses"), SCENE.holds_tables("frame")
        (True, False)
        """
        return self.table_at((key, "")) is not None

    def keys_at(self, loc: Sequence[str | int]) -> dict[str, Wording]:
        """The keys that may stand in the table at a place, with the explanation of each."""
        table = self.table_at(loc)
        return {} if table is None else {key_of(f): meaning(table, key_of(f)) for f in keys_of(table)}

    def schema(self) -> dict[str, Json]:
        """The JSON schema (draft 2020-12) of such a file, for editors that complete and check TOML."""
        known = {table.__name__: table for table in FileTable.__subclasses__()}
        tables, met = dict[str, Any](), [self.whole.__name__]
        while met:
            if (table := met.pop()) in tables:
                continue
            node: Any = _as_toml(known[table]._rules().json_schema(by_alias=True), met)
            for name, entry in node["properties"].items():
                if said := as_sentence(say(meaning(known[table], name))):
                    entry["description"] = said
            tables[table] = node
        whole = tables.pop(self.whole.__name__)
        head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "$defs": dict(sorted(tables.items()))}
        return {**head, **whole, "title": self.title}

    def _cut(self, loc: KeyPath) -> KeyPath:
        """The smallest entry of the file that can be taken out to remove an error at a place: the key of a table, or a
        name under it, but of tables inside the key's value none; without a needed key the table goes too."""
        tables = {n: table for n in range(len(loc)) if (table := self.table_at(loc[:n])) is not None}
        key, end = [*tables][:2][-1], ([*tables][2:] or [len(loc)])[0]
        needed = {key_of(each) for each in keys_of(tables[key]) if each.default is each.default_factory is MISSING}
        cut = _written_path(loc[:key] if key and loc[key] in needed else loc[:end])
        return cut[: len(cut) - sum(1 for _ in takewhile(lambda part: isinstance(part, int), reversed(cut)))]

    def _meant(self, loc: KeyPath, raw: OwnTables) -> str | None:
        """The key that a misspelt one stands for, where it is near and not written as well, or both are tables."""
        table = value_at(raw, _written_path(loc[:-1]))
        near = get_close_matches(str(loc[-1])[:60], self.keys_at(loc[:-1]), n=1, cutoff=0.75)
        if not near or not isinstance(table, dict) or loc[-1] not in table:
            return None
        both = [table[loc[-1]], table.get(near[0])]
        return near[0] if near[0] not in table or all(isinstance(t, dict) for t in both) else None

    def _problem(self, loc: KeyPath, path: KeyPath, item: OwnTables) -> Problem:
        """The problem at a place, by pydantic's error: the value found and the right form of it."""
        kind, value, ctx = item["type"], item["input"], item.get("ctx", {})

        def problem(found: Wording, wanted: Wording, **gaps: object) -> Problem:
            return Problem(path_name(path), found, wanted, value=shown(value), **gaps)

        wanted: Wording
        if kind == "missing":
            wanted = self.keys_at(loc[:-1]).get(str(loc[-1]), "")
            if loc == ("links",):
                wanted = "a scene has moving links links.1 and so"
            elif loc[0] == "driver" and loc[-1] == "link":
                wanted = "write link 1 for a driven angle or slide"
            return problem("is missing", wanted)
        if kind == UNKNOWN:
            return problem("unknown table" if isinstance(value, dict) else "unknown key", self._about_key(loc))
        if "[key]" in loc or kind == "string_pattern_mismatch":
            return problem("is no name here", _name_rule(ctx))
        for sort in (f"{kind} of {type(value).__name__}", kind):
            if sort in _KINDS:
                return problem("found value", _KINDS[sort])
        if kind == "literal_error":
            choices = re.findall(r"'([^']*)'", ctx["expected"])
            names = listed([f'"{c}"' for c in choices] or [str(ctx["expected"])])
            possible = Phrase("one of is possible" if len(choices) > 1 else "is possible", names=names)
            near = did_you_mean(value[:60], choices) if isinstance(value, str) else possible
            both = Phrase("list comma of two", first=possible, second=near)
            return problem("found value", both if near.key == "did you mean" else possible)
        if kind == "greater_than_equal" and ctx["ge"] > 0:
            sign = "found a negative" if value < 0 else "found a zero" if value == 0 else "found far too small a"
            last = str(path[-1])
            noun = Phrase(f"noun {'scale' if last.endswith('scale') else _NOUNS.get(last, 'length')}")
            return problem(sign, "a must be positive", noun=noun)
        if kind in _BOUNDS:
            limit, wanted = _BOUNDS[kind]
            return problem("found value", wanted, limit=f"{ctx[limit]:g}")
        if kind in ("too_short", "too_long") and loc == ("links",):
            return problem("there is none", "a scene has moving links links.1 and so")
        if kind in ("too_short", "too_long"):
            several = isinstance(value, list) and value and isinstance(value[0], dict | list)
            within = f"{path[-2]}." if isinstance(path[-1], int) else str(path[-1])
            in_print = str(loc[0]).startswith("printed")
            other = "write a number 1.0 for its digits as" if in_print else "a place is x y"
            return problem("found of them" if several else "found value", _SIZES.get(within, other), count=len(value))
        if kind == "string_too_long":
            return problem("is characters long", "at most are possible", count=len(value), limit=ctx["max_length"])
        return problem("found value", item["msg"] if kind == "form" else from_others(str(item["msg"])))

    def _about_key(self, loc: KeyPath) -> Wording:
        """The known keys that an unknown key may mean."""
        key = str(loc[-1])[:60]
        if loc == ("design",):
            return Phrase("this is a design file", name="FILE")
        if key in self.keys_at(()) and len(loc) > 1:
            at_top = key in ("title", "title_zh", "source", "source_zh", "find")
            return Phrase("belongs at the top of the file before" if at_top else "is a table of its own", key=key)
        if loc[0] == "driver" and key == "slide":
            return "a driver has either link a driven angle"
        return did_you_mean(key, self.keys_at(loc[:-1]))


# what is left of a file


def plain(source: Mapping[Any, object] | FileTable) -> OwnTables:
    """Copy a mapping, or typed tables, to plain dict, list, str, bool, int and float, so that the form can be checked
    strictly.

    Raises SceneError where a key is no text, or where the tables are nested too deeply or too many to be a scene.
    """
    left = MOST_VALUES

    def copy(value: object, path: KeyPath) -> object:
        nonlocal left
        left -= 1
        if len(path) > DEEPEST:
            raise SceneError.of(path_name(path[:4]), "is nested more than levels deep", "a scene needs at most four",
                                most=DEEPEST)
        if left < 0:
            raise SceneError.of(Phrase("the file"), "holds more than values", "a scene is one mechanism",
                                most=MOST_VALUES)
        if isinstance(value, FileTable):
            value = entries(value)
        elif hasattr(value, "tolist"):  # arrays and numbers of NumPy
            value = value.tolist()
        if isinstance(value, Mapping):
            for key in value:
                if not isinstance(key, str | int) or str(key).startswith(("<", "[")):  # signs that pydantic's paths use
                    raise SceneError.of(path_name(path), "has the key", "keys are words", key=f"{key!a:.60}")
            return {str(key): copy(item, (*path, str(key))) for key, item in value.items()}
        if isinstance(value, list | tuple):
            return [copy(item, (*path, i)) for i, item in enumerate(value)]
        if isinstance(value, bool):
            return value
        if isinstance(value, str):
            return str(value)
        if isinstance(value, Integral):
            whole = int(value)
            return whole if abs(whole) < 10**300 else math.inf if whole > 0 else -math.inf
        if isinstance(value, Real):
            return float(value)
        return value

    made = copy(source, ())
    assert isinstance(made, dict)
    return made


def _read_as(raw: OwnTables, path: KeyPath, key: str) -> None:
    """Move a misspelt entry to the key that is meant; a table is added to the table there."""
    table = value_at(raw, path[:-1])
    value = table[path[-1]]
    moved = {**value, **table[key]} if key in table else value
    renamed = {key if k == path[-1] else k: v for k, v in table.items()}
    table.clear()
    table.update({**renamed, key: moved})


def _take_out(raw: OwnTables, path: KeyPath) -> KeyPath:
    """Take an entry out, or where it is not there (a required key) the table that misses it; return its path."""
    table = value_at(raw, path[:-1])
    if isinstance(table, dict) and path[-1] in table:
        del table[path[-1]]
        return path
    return _take_out(raw, path[:-1]) if len(path) > 1 else path


# sentences

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_NOUNS = {
    "count": "count", "g": "gravity", "mass": "mass", "rate": "rate", "weight": "weight", "delta": "fluctuation",
    "K": "number", "swing": "number", "tolerance": "number", "duration": "time", "within": "number",
}
"""What must be positive, where it is no length."""
_KINDS = {
    "string_type of int": "a text stands in quotation marks",
    "string_type of float": "a text stands in quotation marks",
    "float_type of str": "a number is written without quotation marks",
    "finite_number": "a finite number is wanted",
    "string_type": "a text is wanted",
    "float_type": "a number is wanted",
    "int_type": "a whole number is wanted",
    "bool_type": "true or false is wanted",
    "list_type": "a list is wanted",
    "tuple_type": "a list is wanted",
    "dict_type": "a table is wanted",
    "dataclass_type": "a table is wanted",
}
_BOUNDS = {
    "greater_than_equal": ("ge", "the least that is possible here"),
    "less_than_equal": ("le", "the most that is possible here"),
}
_SIZES: Mapping[str, Wording] = {
    "on": "one guide or two are possible",
    "in": "one guide or two are possible",
    "angle_on": "one number for each guide is wanted",
    "from": "two points of the link are wanted",
    "r": "two lengths are wanted one for each point",
    "driver": "two values of the driver are wanted",
    "between": "two outlines or wheels are wanted 1.k 2.f",
    "teeth": "two are wanted one for each wheel 20",
    "angles": "two angles in degrees are wanted 30 30",
    "pairs": Phrase("three of are wanted", wanted=Phrase("crank angle rocker angle")),
    "pairs.": "two angles in degrees are wanted 30 60",
    "positions": Phrase("three of are wanted", wanted="{ B = [x, y], C = [x, y] }"),
}
"""How long the list of a key is, or with a point, one in it."""


def shown(value: object) -> Wording:
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
        return str(value) if abs(value) < 10**20 else Phrase("a number of too many digits")
    if isinstance(value, list):
        inner = [said if isinstance(said := shown(item), str) else "..." for item in value[:4]]
        return f"[{', '.join(inner + ['...'] * (len(value) > 4))}]"
    if isinstance(value, dict):
        return Phrase("a table" if value else "an empty table")
    return str(value)[:60] if value is not None else Phrase("nothing")


def path_name(path: Iterable[str | int]) -> str:
    """A path as its name: ``links.3.length``; the second of several drivers is ``driver.2``."""
    parts = []
    for part in path:
        if isinstance(part, int):
            parts.append(str(part + 1))
        else:
            parts.append(part if _BARE.fullmatch(part) and len(part) <= 60 else str(shown(part)))
    return ".".join(parts) or "the file"


def meaning(table: type[FileTable] | str, key: str) -> Wording:
    """The meaning and the default of a table's key as a clause; "" for a key explained by its name and choices."""
    said = f"{table if isinstance(table, str) else table.__name__}.{key}"
    return Phrase(said) if said in area("keys") else ""


def as_sentence(clause: str) -> str:
    """A clause in English as a sentence."""
    return clause and f"{clause[:1].upper()}{clause[1:]}."


def _written_path(loc: KeyPath) -> KeyPath:
    """A place as the file has it, without pydantic's tags."""
    return tuple(part for part in loc if not str(part).startswith(("<", "[key]", "constrained-")))


def _name_rule(ctx: Tables) -> Wording:
    """The rule for writing a name, by the pattern that it misses."""
    if "max_length" in ctx:
        return Phrase("a name has at most letters and digits", limit=ctx["max_length"])
    rules = {r"\.": "a guide is written link for the link's", "/": "a sliding pair is written link or sliding",
             "A-Z][": "a point is named by a capital letter", "": "a link or guide is named by letters"}
    return next(rule for sign, rule in rules.items() if sign in str(ctx.get("pattern", "")))


# rules from types


def _within(kind: object, loc: KeyPath) -> type[FileTable] | None:
    """The table at ``loc`` inside of a value of a kind; of several kinds that of the tag, or the first that has it."""
    if isinstance(kind, type) and issubclass(kind, FileTable):
        if not loc:
            return kind
        hints = get_type_hints(kind, {**vars(sys.modules[kind.__module__]), "ClassVar": ClassVar}, include_extras=True)
        types = {key_of(key): hints[key.name] for key in keys_of(kind)}
        return _within(types[str(loc[0])], loc[1:]) if loc[0] in types else None
    if get_origin(kind) is Annotated:
        bare, *marks = get_args(kind)
        tags = [mark.tag for mark in marks if isinstance(mark, Tag)]
        return None if tags and loc[:1] != (tags[0],) else _within(bare, loc[1:] if tags else loc)
    if get_origin(kind) in (dict, list, tuple):
        return _within(get_args(kind)[1 if get_origin(kind) is dict else 0], loc[1:]) if loc else None
    return next((table for part in get_args(kind) if (table := _within(part, loc)) is not None), None)


def _as_toml(node: Json, met: list[str]) -> Json:
    """A schema with references to its tables, whose names are added to ``met``.  TOML has no null: a key that may be
    left out keeps the type it has when it is written."""
    if isinstance(node, list):
        return [_as_toml(item, met) for item in node]
    if not isinstance(node, dict):
        return node
    out = {k: _as_toml(v, met) for k, v in node.items() if not (k == "default" and v is None)}
    if table := out.pop(TABLE, ""):
        met.append(str(table))
        out = {"$ref": f"#/$defs/{table}", **out}
    kinds = out.get("anyOf")
    if isinstance(kinds, list) and {"type": "null"} in kinds:
        rest = [kind for kind in kinds if kind != {"type": "null"}]
        del out["anyOf"]
        out = {**rest[0], **out} if len(rest) == 1 and isinstance(rest[0], dict) else {**out, "anyOf": rest}
    if "$ref" in out:  # the table has its own title
        out.pop("title", None)
    return out
