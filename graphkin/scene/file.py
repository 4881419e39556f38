"""The scene file as tables and keys: what may be written in it, each key with its description.

This says form only (which keys, which types, which numbers); what the names refer to and whether the lengths
meet is asked by the modules that resolve a scene.  The JSON schema for editors comes out of the same classes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Discriminator, Field, StringConstraints, Tag

from graphkin.words import LANGUAGES

__all__ = [
    "AngleDriverTable",
    "Compass",
    "DriverTable",
    "FrameTable",
    "GuideTable",
    "LinkTable",
    "Magnitude",
    "PinTable",
    "Polar",
    "SceneFile",
    "SheetTable",
    "SlideDriverTable",
    "UnitsTable",
    "schema",
]

LARGEST = 1e15
SMALLEST = 1e-15
LONGEST_TEXT = 300

if TYPE_CHECKING:
    Language = str
else:
    Language = Literal[LANGUAGES]  # as many as there are tables of words

Number = Annotated[float, Field(allow_inf_nan=False, ge=-LARGEST, le=LARGEST)]
Magnitude = Annotated[float, Field(allow_inf_nan=False, ge=SMALLEST, le=LARGEST)]
Tool = Annotated[float, Field(allow_inf_nan=False, ge=0, le=10)]
Place = Annotated[list[Number], Field(min_length=2, max_length=2, description="[x, y]")]
PointName = Annotated[str, StringConstraints(pattern=r"^[A-Z][A-Za-z0-9]*$", max_length=40)]
LinkName = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9]+$", max_length=40)]
GuideRef = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9]+(\.[A-Za-z0-9]+)?$", max_length=81)]
SlideRef = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9]+(/[A-Za-z0-9]+)?$", max_length=81)]
Text = Annotated[str, Field(max_length=LONGEST_TEXT)]


def _form(value: Any) -> str | None:
    """Which of the forms of a value that may be written in several ways this is."""
    if isinstance(value, str):
        return "<name>"
    if isinstance(value, list):
        return "<list>"
    if isinstance(value, dict):
        return "<compass>" if isinstance(value.get("from"), list) else "<polar>"
    return "<number>" if isinstance(value, int | float) and not isinstance(value, bool) else None


def _driver_form(value: Any) -> str:
    return "<slide>" if isinstance(value, dict) and "slide" in value and "link" not in value else "<angle>"


def _count(value: Any) -> str:
    return "<list>" if isinstance(value, list) else "<one>"


def _forms(wanted: str) -> Discriminator:
    return Discriminator(_form, custom_error_type="form", custom_error_message=wanted)


NameOrPlace = Annotated[
    Annotated[PointName, Tag("<name>")] | Annotated[Place, Tag("<list>")],
    _forms('write the name of a point ("B") or a place [x, y]'),
]
GuideRefs = Annotated[
    Annotated[GuideRef, Tag("<name>")]
    | Annotated[list[GuideRef], Field(min_length=1, max_length=2), Tag("<list>")],
    _forms('write a guide as "LINK" or "LINK.GUIDE", or a list of them'),
]
Numbers = Annotated[
    Annotated[Number, Tag("<number>")] | Annotated[list[Number], Field(min_length=1, max_length=2), Tag("<list>")],
    _forms("write a number, or a list with one number for each guide"),
]
NumberOrPair = Annotated[
    Annotated[Number, Tag("<number>")] | Annotated[Place, Tag("<list>")],
    _forms("write a number, or [x, y] for a vector by its components"),
]


class _Table(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid", frozen=True)


class UnitsTable(_Table):
    """Units of the file."""

    length: Literal["mm", "cm", "m", "in", "ft"] = Field(
        default="mm", description="The unit of every length; speeds are in it per second."
    )


class GuideTable(_Table):
    """A straight guide: any point of it and its direction."""

    through: NameOrPlace = Field(description="A point of the link by name, or [x, y] in the link's own axes.")
    angle: Number | None = Field(default=None, description="Direction in degrees from the link's own x axis.")
    toward: PointName | None = Field(
        default=None, description="Instead of angle: the point that the guide points to (of the link, fixed or drawn)."
    )


class FrameTable(_Table):
    """The fixed link."""

    name: LinkName = Field(default="0", description='Name of the fixed link, "0" if not given.')
    points: dict[PointName, Place] = Field(
        default={}, description="Fixed pivots, [x, y] each.", json_schema_extra={"additionalProperties": False}
    )
    guides: dict[LinkName, GuideTable] = Field(
        default={}, description="Straight guides by name.", json_schema_extra={"additionalProperties": False}
    )


class Polar(_Table):
    """A point at a distance and an angle from another point of the link."""

    origin: PointName = Field(alias="from", description="The point of the link from which r is measured.")
    r: Magnitude = Field(description="Distance.")
    angle: Number = Field(
        default=0.0, description="Degrees from the link's own x axis, or from the direction given by toward."
    )
    toward: PointName | None = Field(default=None, description="The point of the link at which angle is 0.")


class Compass(_Table):
    """A point by its distances from two others of the link."""

    origins: Annotated[list[PointName], Field(min_length=2, max_length=2)] = Field(
        alias="from", description="The two points of the link."
    )
    r: Annotated[list[Magnitude], Field(min_length=2, max_length=2)] = Field(description="The two distances.")
    side: Literal["left", "right"] = Field(description="Side of the directed line from the first to the second.")


At = Annotated[
    Annotated[Place, Tag("<list>")]
    | Annotated[Polar, Tag("<polar>")]
    | Annotated[Compass, Tag("<compass>")]
    | Annotated[Literal["drawn"], Tag("<name>")],
    _forms('write [x, y], { from = "C", r = 65, angle = -60 }, '
           '{ from = ["B", "C"], r = [60, 80], side = "left" } or "drawn"'),
]


class LinkTable(_Table):
    """A moving link."""

    points: list[PointName] = Field(
        default=[], description="Own points: two for a bar, one for a bar of no fixed length or a block, or none."
    )
    length: Magnitude | None = Field(default=None, description="Distance of the two own points.")
    on: GuideRefs | None = Field(
        default=None, description='What the link slides on: "3" (own axis of link 3), "6.h" (a guide), or two of them.'
    )
    angle_on: Numbers | None = Field(
        default=None, description="Degrees from the guide to the link's own x axis; one number for each guide."
    )
    at: dict[PointName, At] = Field(
        default={}, description="Further points.", json_schema_extra={"additionalProperties": False}
    )
    guides: dict[LinkName, GuideTable] = Field(
        default={}, description="Straight guides by name.", json_schema_extra={"additionalProperties": False}
    )
    redundant: bool = Field(default=False, description="The link only repeats what others already hold.")


class PinTable(_Table):
    """A pin that runs in slots."""

    of: LinkName = Field(description="The link that has the pin.")
    slots: GuideRefs = Field(alias="in", description='The guide it runs in ("3.s"), or a list of guides.')


class AngleDriverTable(_Table):
    """A driven angle."""

    link: LinkName = Field(description="The driven link.")
    relative_to: LinkName | None = Field(default=None, description="Angle from this link's own axis, not the frame's.")
    angle: Number | None = Field(default=None, description="Degrees, counter-clockwise; may be left out with [drawn].")
    omega: Number | None = Field(default=None, description="rad/s, counter-clockwise positive.")
    rpm: Number | None = Field(default=None, description="Instead of omega: turns per minute.")
    alpha: Number = Field(default=0.0, description="rad/s2.")
    origin: Literal["dead point"] | None = Field(
        default=None, alias="from", description='"dead point": the angle counts from a dead point of the mechanism.'
    )
    near: Number | None = Field(default=None, description="Degrees: which dead point, where there are several.")


class SlideDriverTable(_Table):
    """A driven sliding pair."""

    slide: SlideRef = Field(description='The sliding link ("2"), the pair ("2/3") or a pin in a slot ("B/3").')
    relative_to: LinkName | None = Field(default=None, description="The guiding link, where there are two.")
    travel: Number | None = Field(
        default=None, description="From the guide's origin to the sliding link's own; may be left out with [drawn]."
    )
    velocity: Number | None = Field(default=None, description="Length unit/s along the guide's sense.")
    acceleration: Number = Field(default=0.0, description="Length unit/s2 along the guide's sense.")
    origin: Literal["dead point"] | None = Field(
        default=None, alias="from", description='"dead point": the travel counts from a dead point of the mechanism.'
    )
    near: Number | None = Field(default=None, description="Travel: which dead point, where there are several.")


DriverTable = Annotated[
    Annotated[AngleDriverTable, Tag("<angle>")] | Annotated[SlideDriverTable, Tag("<slide>")],
    Discriminator(_driver_form),
]


class InstrumentTable(_Table):
    """What the tools of a pencil drawing can do; used with --instrument pencil."""

    line_width: Tool = Field(
        default=0.2, description="Width of a pencil line (mm); a point is pricked within half of it."
    )
    ruler: Tool = Field(default=0.1, description="Step of the ruler (mm): 0.5, or 0.1 interpolated.")
    compass: Tool = Field(default=0.1, description="Standard deviation of a compass radius (mm).")
    set_square: Tool = Field(default=0.1, description="Standard deviation of a direction set (degrees).")
    protractor: Tool = Field(default=0.5, description="Step of the protractor (degrees).")


class SheetTable(_Table):
    """Wishes for the drawn sheet."""

    paper: Literal["A5", "A4", "A3", "A2", "A1", "A0"] = "A4"
    orientation: Literal["portrait", "landscape"] = "portrait"
    length_scale: Magnitude | None = Field(default=None, description="mm of mechanism per mm of paper.")
    velocity_scale: Magnitude | None = Field(default=None, description="(length unit/s) per mm of paper.")
    acceleration_scale: Magnitude | None = Field(default=None, description="(length unit/s2) per mm of paper.")
    convention: Literal["chinese", "us", "british", "russian"] = "chinese"
    language: Language = "en"
    instrument: InstrumentTable = InstrumentTable()


class SceneFile(_Table):
    """A mechanism at one position, with what is asked of it."""

    title: Text = Field(default="", description="Title in English.")
    title_zh: Text = Field(default="", description="Title in Chinese.")
    source: Text = Field(default="", description="Where the problem comes from.")
    find: list[str] | None = Field(
        default=None, description="Quantities asked for: v_D, a_B@3, v_B@3/B@2, omega_3, ... Everything if left out."
    )
    units: UnitsTable = UnitsTable()
    frame: FrameTable = FrameTable()
    links: dict[LinkName, LinkTable] = Field(
        min_length=1, description="The moving links by name.", json_schema_extra={"additionalProperties": False}
    )
    pins: dict[PointName, PinTable] = Field(
        default={}, description="Pins in slots, by the point.", json_schema_extra={"additionalProperties": False}
    )
    driver: Annotated[
        Annotated[DriverTable, Tag("<one>")] | Annotated[list[DriverTable], Tag("<list>")], Discriminator(_count)
    ] = Field(default=[], description="What drives: one table [driver], or several [[driver]].")
    sketch: dict[PointName, Place] = Field(
        default={}, description="Roughly where points lie: picks the assembly.",
        json_schema_extra={"additionalProperties": False},
    )
    drawn: dict[PointName, Place] = Field(
        default={}, description="Exact places of points of moving links in this position.",
        json_schema_extra={"additionalProperties": False},
    )
    printed: dict[str, NumberOrPair] = Field(
        default={}, description="Values that somebody published, by symbol, in scene units, rad/s and rad/s2."
    )
    sheet: SheetTable = SheetTable()

    @property
    def drivers(self) -> tuple[AngleDriverTable | SlideDriverTable, ...]:
        """The drivers, whether written as one table or several."""
        return tuple(self.driver) if isinstance(self.driver, list) else (self.driver,)


def _without_null(node: Any) -> Any:
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
        out = {**rest[0], **out} if len(rest) == 1 else {**out, "anyOf": rest}
    return out


def schema() -> dict[str, Any]:
    """Return the JSON schema (draft 2020-12) of a scene file, for editors that complete and check TOML."""
    made: dict[str, Any] = _without_null(SceneFile.model_json_schema(by_alias=True))
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **made, "title": "graphkin scene"}
