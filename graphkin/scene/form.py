"""What may be written in a scene file: the rules of each type of value, and the JSON schema for editors.

This says form only (which keys, which types, which numbers); what the names refer to and whether the lengths meet is
asked by the modules that resolve a scene.  The tables are those of `graphkin.scene.tables`, whose annotations name the
types of this module: so only reading a scene waits for pydantic.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, TypeVar, get_args, get_origin, get_type_hints

from pydantic import Discriminator, Field, Strict, StringConstraints, Tag, TypeAdapter
from pydantic_core.core_schema import CoreSchema, no_info_plain_validator_function

from graphkin.files import Json
from graphkin.scene.file_table import FileTable, key_of, keys_of
from graphkin.scene.tables import SMALLEST, SceneTables
from graphkin.words import LANGUAGES

__all__ = ["SCENE", "schema", "table_at"]

AnyTable = TypeVar("AnyTable", bound=FileTable)

LARGEST = 1e15
LONGEST_TEXT = 300

if TYPE_CHECKING:
    from graphkin.scene.asked_tables import StrokeStart
    from graphkin.scene.contact_tables import LawPiece, TimePiece
    from graphkin.scene.sheet_tables import ReadScan
    from graphkin.scene.tables import Compass, DrivenSlide, Driver, Link, Polar

    Language = str
else:
    Language = Literal[LANGUAGES]  # as many as there are tables of words

Switch = Annotated[bool, Strict()]
Number = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-LARGEST, le=LARGEST)]
Magnitude = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=SMALLEST, le=LARGEST)]
Tool = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, le=10)]
NotNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, le=LARGEST)]
Place = Annotated[list[Number], Field(min_length=2, max_length=2, description="[x, y]")]
PointName = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Z][A-Za-z0-9]*$", max_length=40)]
LinkName = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Za-z0-9]+$", max_length=40)]
GuideRef = Annotated[
    str, StringConstraints(strict=True, pattern=r"^[A-Za-z0-9]+(\.[A-Za-z0-9]+)?$", max_length=81)
]
SlideRef = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Za-z0-9]+(/[A-Za-z0-9]+)?$", max_length=81)]
Text = Annotated[str, Field(strict=True, max_length=LONGEST_TEXT)]
Count = Annotated[int, Field(strict=True, ge=1, le=720)]
Share = Annotated[float, Field(strict=True, ge=0, le=1)]
PositionName = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Za-z0-9'*._-]+$", max_length=20)]
ShownName = Annotated[str, StringConstraints(strict=True, max_length=20)] | Annotated[int, Field(strict=True, ge=0)]
Symbols = list[Annotated[str, Strict()]]
PointNames = list[PointName]
LinkNames = list[LinkName]
TwoPoints = Annotated[list[PointName], Field(min_length=2, max_length=2)]
TwoLengths = Annotated[list[Magnitude], Field(min_length=2, max_length=2)]
Links = Annotated[dict[LinkName, "Link"], Field(min_length=1)]
LawPieces = list["LawPiece"]
EndName = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Za-z][A-Za-z0-9@/_]*$", max_length=80)]
Scans = dict[Literal["mechanism", "velocity", "acceleration"], "ReadScan"]
TimePieces = Annotated[list["TimePiece"], Field(max_length=1000)]
Knots = Annotated[list[Place], Field(max_length=5000)]


def _form(value: object) -> str | None:
    """Which of the forms of a value that may be written in several ways this is."""
    if isinstance(value, str):
        return "<name>"
    if isinstance(value, list):
        return "<list>"
    if isinstance(value, dict):
        return "<compass>" if isinstance(value.get("from"), list) else "<polar>"
    return "<number>" if isinstance(value, int | float) and not isinstance(value, bool) else None


def _driver_form(value: object) -> str:
    return "<slide>" if isinstance(value, dict) and "slide" in value and "link" not in value else "<angle>"


def _count(value: object) -> str:
    return "<list>" if isinstance(value, list) else "<one>"


def _forms(wanted: str) -> Discriminator:
    """Which form a value has; ``wanted`` is the key of the phrase that says which there are."""
    return Discriminator(_form, custom_error_type="form", custom_error_message=wanted)


NameOrPlace = Annotated[
    Annotated[PointName, Tag("<name>")] | Annotated[Place, Tag("<list>")],
    _forms("write the name of a point b or"),
]
GuideRefs = Annotated[
    Annotated[GuideRef, Tag("<name>")]
    | Annotated[list[GuideRef], Field(min_length=1, max_length=2), Tag("<list>")],
    _forms("write a guide as link or link.guide or"),
]
Numbers = Annotated[
    Annotated[Number, Tag("<number>")] | Annotated[list[Number], Field(min_length=1, max_length=2), Tag("<list>")],
    _forms("write a number or a list with one"),
]
NumberOrPair = Annotated[
    Annotated[Number, Tag("<number>")] | Annotated[Place, Tag("<list>")],
    _forms("write a number or x y for a"),
]
Stated = Annotated[
    Annotated[Number, Tag("<number>")]
    | Annotated[Place, Tag("<list>")]
    | Annotated[str, StringConstraints(strict=True, max_length=80), Tag("<name>")],
    _forms("write a number 1.0 for its digits as"),
]
Range = Annotated[list[Number], Field(min_length=2, max_length=2)]
Keys = list[Annotated[str, StringConstraints(strict=True, max_length=80)]]
KeyLists = list[Keys]
Asked = Annotated[int, Field(strict=True, ge=1, le=100)]
Least = Annotated[Number, Field(ge=0, le=90)]
Part = Annotated[Number, Field(gt=0, le=0.5)]
StatedRow = dict[str, Stated]
Start = Annotated[
    Annotated[Number, Tag("<number>")] | Annotated["StrokeStart", Tag("<polar>")],
    _forms("write a driver value or stroke 5 6"),
]
FramePlace = Annotated[
    Annotated[Place, Tag("<list>")] | Annotated["Polar", Tag("<polar>")] | Annotated["Compass", Tag("<compass>")],
    _forms("write x y from a r 400 angle"),
]
At = Annotated[
    Annotated[Place, Tag("<list>")]
    | Annotated["Polar", Tag("<polar>")]
    | Annotated["Compass", Tag("<compass>")]
    | Annotated[Literal["drawn"], Tag("<name>")],
    _forms("write x y from c r 65 angle"),
]
TwoOutlines = Annotated[list[GuideRef], Field(min_length=2, max_length=2)]
TwoTeeth = Annotated[
    list[
        Annotated[
            Annotated[Number, Tag("<number>")] | Annotated[Literal["rack"], Tag("<name>")],
            _forms("write a number of teeth or rack"),
        ]
    ],
    Field(min_length=2, max_length=2),
]
NumberOrSquare = Annotated[
    Annotated[Number, Tag("<number>")] | Annotated[Literal["square"], Tag("<name>")],
    _forms("write degrees or square for square to the"),
]
OneDriver = Annotated[
    Annotated["Driver", Tag("<angle>")] | Annotated["DrivenSlide", Tag("<slide>")], Discriminator(_driver_form)
]
Drivers = Annotated[
    Annotated[OneDriver, Tag("<one>")] | Annotated[list[OneDriver], Tag("<list>")], Discriminator(_count)
]


def _rules(table: type[AnyTable], others: Mapping[str, object]) -> TypeAdapter[AnyTable]:
    """The rules of a table by its annotations, which are names of this module and of the other tables in it."""
    made = TypeAdapter(table)
    made.rebuild(_types_namespace={**globals(), **others})
    return made


class _WhenMet:
    """The rules of a table in another: made when a file has such a table, since most have few of the kinds."""

    def __init__(self, table: type[FileTable]) -> None:
        self.rules = cache(lambda: _rules(table, _WHEN_MET))

    def __get_pydantic_core_schema__(self, *_: object) -> CoreSchema:
        return no_info_plain_validator_function(lambda value: self.rules().validate_python(value))


_TABLES = {table.__name__: table for table in FileTable.__subclasses__()}
_WHEN_MET = {name: Annotated[table, _WhenMet(table)] for name, table in _TABLES.items()}

SCENE = _rules(SceneTables, _WHEN_MET)


def table_at(loc: Sequence[str | int]) -> type[FileTable] | None:
    """The table that stands at a place of a file, as pydantic names places: with a tag ("<one>") where a value has
    several forms.  None where there is no table.

    >>> table_at(("links", "2", "guides", "g")).__name__, table_at(("driver", "<list>", 1, "<slide>")).__name__
    ('Guide', 'DrivenSlide')
    """
    return _within(SceneTables, tuple(loc))


def _within(kind: object, loc: tuple[str | int, ...]) -> type[FileTable] | None:
    """The table at ``loc`` inside of a value of a kind; of several kinds that of the tag, or the first that has it."""
    if isinstance(kind, type) and issubclass(kind, FileTable):
        field_type = _field_types(kind).get(str(loc[0])) if loc else None
        return kind if not loc else _within(field_type, loc[1:]) if field_type is not None else None
    if get_origin(kind) is Annotated:
        bare, *marks = get_args(kind)
        tags = [mark.tag for mark in marks if isinstance(mark, Tag)]
        return None if tags and loc[:1] != (tags[0],) else _within(bare, loc[1:] if tags else loc)
    if get_origin(kind) in (dict, list, tuple):
        return _within(get_args(kind)[1 if get_origin(kind) is dict else 0], loc[1:]) if loc else None
    return next((table for part in get_args(kind) if (table := _within(part, loc)) is not None), None)


def _field_types(table: type[FileTable]) -> dict[str, object]:
    """The types of a table's keys, by their names in the file."""
    names = {**vars(sys.modules[table.__module__]), **globals(), **_TABLES, "ClassVar": ClassVar}
    hints = get_type_hints(table, names, include_extras=True)
    return {key_of(key): hints[key.name] for key in keys_of(table)}


def _without_null(node: Json) -> Json:
    """TOML has no null: a key that may be left out keeps the type it has when it is written."""
    if isinstance(node, list):
        return [_without_null(item) for item in node]
    if not isinstance(node, dict):
        return node
    out = {k: _without_null(v) for k, v in node.items() if not (k == "default" and v is None)}
    kinds = out.get("anyOf")
    if isinstance(kinds, list) and {"type": "null"} in kinds:
        rest = [kind for kind in kinds if kind != {"type": "null"}]
        del out["anyOf"]
        out = {**rest[0], **out} if len(rest) == 1 and isinstance(rest[0], dict) else {**out, "anyOf": rest}
    return out


def schema() -> dict[str, Json]:
    """Return the JSON schema (draft 2020-12) of a scene file, for editors that complete and check TOML."""
    made = _without_null(_rules(SceneTables, _TABLES).json_schema(by_alias=True))
    assert isinstance(made, dict)
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **made, "title": "graphkin scene"}
