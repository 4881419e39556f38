"""The keys of a scene file as typed tables: what a file says, in its own names and units (lengths in the scene's unit,
angles in degrees).

Each class is a table of the file, each field a key.  The classes only hold; what may stand in them is asked when a
scene is made of them (`graphkin.scene.form` has the rules, from which the JSON schema for editors comes too).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

from graphkin.scene.asked_tables import Positions, PrintedTable, Vary
from graphkin.scene.contact_tables import Cam, Contact, Disc, DriverLaw, Gear
from graphkin.scene.file_table import FileTable, about, closed
from graphkin.scene.load_tables import Balance, Flywheel, Gravity, Load, Mass, Spring
from graphkin.scene.sheet_tables import ReadScan, SheetWishes

SMALLEST = 1e-15
"""The smallest length, and the smallest rate that is not 0."""

if TYPE_CHECKING:
    # what a caller may give; what the reader makes of it, and its rules, are the types of these names in scene.form
    Number = float
    Magnitude = float
    Switch = bool
    Text = str
    PointName = str
    LinkName = str
    SlideRef = str
    Place = Sequence[float]
    TwoLengths = Sequence[float]
    PointNames = Sequence[str]
    TwoPoints = Sequence[str]
    Symbols = Sequence[str]
    NameOrPlace = str | Sequence[float]
    GuideRefs = str | Sequence[str]
    Numbers = float | Sequence[float]
    NumberOrPair = float | Sequence[float]
    Stated = float | str | Sequence[float]
    StatedRow = Mapping[str, float | str | Sequence[float]]
    NotNegative = float
    ShownName = str | int
    FramePlace: TypeAlias = "Sequence[float] | Polar | Compass"
    At: TypeAlias = "Sequence[float] | Polar | Compass | Literal['drawn']"
    Scans: TypeAlias = "Mapping[str, ReadScan]"
    Links: TypeAlias = "Mapping[str, Link]"
    Drivers: TypeAlias = "Driver | DrivenSlide | Sequence[Driver | DrivenSlide]"

__all__ = [
    "Compass",
    "DrivenSlide",
    "Driver",
    "Frame",
    "Guide",
    "Link",
    "Measure",
    "Pin",
    "Polar",
    "SceneTables",
    "Unit",
    "Units",
]

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


@dataclass(frozen=True)
class Units(FileTable):
    """Units of the file."""

    length: Literal["mm", "cm", "m", "in", "ft"] = field(
        default="mm", metadata=about("The unit of every length; speeds are in it per second.")
    )
    speed: Literal["mm/s", "cm/s", "m/s", "in/s", "ft/s"] | None = field(
        default=None,
        metadata=about("The unit of velocities, where it is not the length unit per second; accelerations are per s."),
    )
    force: Literal["N", "kN", "kgf", "lbf"] = field(
        default="N", metadata=about("The unit of every force; moments are in it times metre.")
    )
    mass: Literal["kg", "g", "lb"] = field(
        default="kg", metadata=about("The unit of every mass; inertias are in it times m2 (ft2 with lb).")
    )

    @property
    def metres(self) -> float:
        """One length unit in m."""
        return {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}[self.length]

    @property
    def rates(self) -> Units:
        """The units in which the lengths in velocities and accelerations are counted."""
        lengths: dict[str, Literal["mm", "cm", "m", "in", "ft"]]
        lengths = {"mm/s": "mm", "cm/s": "cm", "m/s": "m", "in/s": "in", "ft/s": "ft"}
        return self if self.speed is None else replace(self, length=lengths[self.speed], speed=None)

    @property
    def newtons(self) -> float:
        """One force unit in N."""
        return {"N": 1.0, "kN": 1e3, "kgf": 9.80665, "lbf": 4.4482216152605}[self.force]

    @property
    def kilograms(self) -> float:
        """One mass unit in kg."""
        return {"kg": 1.0, "g": 1e-3, "lb": 0.45359237}[self.mass]

    @property
    def inertias(self) -> float:
        """One unit of inertia in kg m2."""
        return self.kilograms * (0.3048**2 if self.mass == "lb" else 1.0)

    @property
    def per_si(self) -> tuple[float, float, float]:
        """What one metre, one radian and one metre in rates are in the units of tables."""
        return 1.0 / self.metres, math.degrees(1.0), 1.0 / self.rates.metres

    def of(self, measure: Measure, radians: bool = False) -> Unit:
        """The unit of a measure: what people read has its angles in degrees, what programs read in radians."""
        return _unit(self, measure, radians)


@cache
def _unit(units: Units, measure: Measure, radians: bool) -> Unit:
    fast = units.rates
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
        "inertia": Unit(f"{units.mass} {'ft2' if units.mass == 'lb' else 'm2'}", units.inertias),
    }[measure]


@dataclass(frozen=True)
class Guide(FileTable):
    """A straight guide: any point of it and its direction; or a slot along a circle: its centre and radius."""

    through: NameOrPlace | None = field(
        default=None, metadata=about("A point of the link by name, or [x, y] in the link's own axes.")
    )
    angle: Number | None = field(
        default=None, metadata=about("Direction in degrees from the link's own x axis.")
    )
    toward: PointName | None = field(
        default=None,
        metadata=about("Instead of angle: the point that the guide points to (of the link, fixed or drawn)."),
    )
    centre: NameOrPlace | None = field(
        default=None, metadata=about("Of a circular slot: a point of the link, or [x, y] in the link's own axes.")
    )
    r: Magnitude | None = field(default=None, metadata=about("Radius of a circular slot."))
    ends: Place | None = field(
        default=None,
        metadata=about("Where a circular slot is drawn: from one to the other, degrees from the link's own x axis."),
    )


@dataclass(frozen=True)
class Frame(FileTable):
    """The fixed link."""

    name: LinkName = field(default="0", metadata=about('Name of the fixed link, "0" if not given.'))
    points: dict[PointName, FramePlace] = field(
        default_factory=dict,
        metadata=closed("Fixed pivots, [x, y] each, or polar from another, or by the distances from two others."),
    )
    guides: dict[LinkName, Guide] = field(default_factory=dict, metadata=closed("Straight guides by name."))
    discs: dict[LinkName, Disc] = field(default_factory=dict, metadata=closed("Round outlines by name."))


@dataclass(frozen=True)
class Polar(FileTable):
    """A point at a distance and an angle from another point of the link."""

    origin: PointName = field(metadata=about("The point of the link from which r is measured.", alias="from"))
    r: Magnitude = field(metadata=about("Distance."))
    angle: Number = field(
        default=0.0, metadata=about("Degrees from the link's own x axis, or from the direction given by toward.")
    )
    toward: PointName | None = field(
        default=None, metadata=about("The point of the link at which angle is 0.")
    )


@dataclass(frozen=True)
class Compass(FileTable):
    """A point by its distances from two others of the link: the corner of a plate by its sides."""

    origins: TwoPoints = field(metadata=about("The two points of the link.", alias="from"))
    r: TwoLengths = field(metadata=about("The two distances."))
    side: Literal["left", "right"] = field(
        metadata=about("Side of the directed line from the first to the second.")
    )


@dataclass(frozen=True)
class Link(FileTable):
    """A moving link."""

    points: PointNames = field(
        default=(), metadata=about("Own points: two for a bar, one for a bar of no fixed length or a block, or none.")
    )
    length: Magnitude | None = field(default=None, metadata=about("Distance of the two own points."))
    on: GuideRefs | None = field(
        default=None,
        metadata=about('What the link slides on: "3" (own axis of link 3), "6.h" (a guide), or two of them.'),
    )
    angle_on: Numbers | None = field(
        default=None, metadata=about("Degrees from the guide to the link's own x axis; one number for each guide.")
    )
    at: dict[PointName, At] = field(default_factory=dict, metadata=closed("Further points."))
    guides: dict[LinkName, Guide] = field(default_factory=dict, metadata=closed("Straight guides by name."))
    discs: dict[LinkName, Disc] = field(default_factory=dict, metadata=closed("Round outlines by name."))
    start: Number | None = field(
        default=None,
        metadata=about("Where rolling leaves it open: degrees of its own axis (of a link with on, its travel) at the "
                        "scene's own driver value; 0 if left out."),
    )
    redundant: Switch = field(default=False, metadata=about("The link only repeats what others already hold."))


@dataclass(frozen=True)
class Pin(FileTable):
    """A pin that runs in slots."""

    of: LinkName = field(metadata=about("The link that has the pin."))
    slots: GuideRefs = field(metadata=about('The guide it runs in ("3.s"), or a list of guides.', alias="in"))


@dataclass(frozen=True)
class Driver(FileTable):
    """A driven angle."""

    link: LinkName = field(metadata=about("The driven link."))
    angle: Number | None = field(
        default=None, metadata=about("Degrees, counter-clockwise; may be left out with [drawn].")
    )
    omega: Number | None = field(default=None, metadata=about("rad/s, counter-clockwise positive."))
    rpm: Number | None = field(default=None, metadata=about("Instead of omega: turns per minute."))
    speed: Number | None = field(
        default=None,
        metadata=about("Instead of omega: the speed of the point named by of, with the sign of the driver's turning."),
    )
    of: PointName | None = field(default=None, metadata=about("The point whose speed is given."))
    alpha: Number = field(default=0.0, metadata=about("rad/s2."))
    sense: Literal["clockwise", "counter-clockwise"] | None = field(
        default=None,
        metadata=about("The sense of omega, rpm or speed, which then is a size, and in which alpha counts."),
    )
    relative_to: LinkName | None = field(
        default=None, metadata=about("Angle from this link's own axis, not the frame's.")
    )
    origin: Literal["dead point"] | None = field(
        default=None,
        metadata=about('"dead point": the angle counts from a dead point of the mechanism.', alias="from"),
    )
    near: Number | None = field(
        default=None, metadata=about("Degrees: which dead point, where there are several.")
    )
    position: ShownName | None = field(
        default=None, metadata=about("Instead of angle: the name of a position of [positions].")
    )
    law: DriverLaw | None = field(
        default=None,
        metadata=about("Instead of omega and alpha: how the driver moves over the time."),
    )
    time: Number | None = field(
        default=None, metadata=about("Instead of angle: the moment of the law that is asked, in s.")
    )


@dataclass(frozen=True)
class DrivenSlide(FileTable):
    """A driven sliding pair."""

    slide: SlideRef = field(metadata=about('The sliding link ("2"), the pair ("2/3") or a pin in a slot ("B/3").'))
    travel: Number | None = field(
        default=None,
        metadata=about("From the guide's origin to the sliding link's own; may be left out with [drawn]."),
    )
    velocity: Number | None = field(default=None, metadata=about("Unit of speed, along the guide's sense."))
    acceleration: Number = field(default=0.0, metadata=about("Unit of speed per s, along the guide's sense."))
    relative_to: LinkName | None = field(
        default=None, metadata=about("The guiding link, where there are two.")
    )
    origin: Literal["dead point"] | None = field(
        default=None,
        metadata=about('"dead point": the travel counts from a dead point of the mechanism.', alias="from"),
    )
    near: Number | None = field(
        default=None, metadata=about("Travel: which dead point, where there are several.")
    )
    law: DriverLaw | None = field(
        default=None,
        metadata=about("Instead of velocity and acceleration: how the driver moves over the time."),
    )
    time: Number | None = field(
        default=None, metadata=about("Instead of travel: the moment of the law that is asked, in s.")
    )


@dataclass(frozen=True, kw_only=True)
class SceneTables(FileTable):
    """A mechanism at one position, with what is asked of it: the whole file."""

    title: Text = field(default="", metadata=about("Title in English."))
    title_zh: Text = field(default="", metadata=about("Title in Chinese."))
    source: Text = field(default="", metadata=about("Where the problem comes from."))
    source_zh: Text = field(default="", metadata=about("The same in Chinese."))
    find: Symbols | None = field(
        default=None,
        metadata=about(
            "Quantities asked for: v_D, a_B@3, v_B@3/B@2, omega_3, theta_3, d_B/C, K_5/6, ... All motion if left out."
        ),
    )
    units: Units = Units()
    frame: Frame = field(default_factory=Frame)
    links: Links = field(metadata=closed("The moving links by name."))
    pins: dict[PointName, Pin] = field(default_factory=dict, metadata=closed("Pins in slots, by the point."))
    contacts: dict[PointName, Contact] = field(
        default_factory=dict, metadata=closed("Outlines that touch, by the name of the point of contact.")
    )
    gears: dict[LinkName, Gear] = field(default_factory=dict, metadata=closed("Wheels with teeth by name."))
    driver: Drivers = field(default=(), metadata=about("What drives: one table [driver], or several [[driver]]."))
    sketch: dict[PointName, Place] = field(
        default_factory=dict, metadata=closed("Roughly where points lie: picks the assembly.")
    )
    drawn: dict[PointName, Place] = field(
        default_factory=dict, metadata=closed("Exact places of points of moving links in this position.")
    )
    printed: dict[str, Stated] = field(
        default_factory=dict,
        metadata=about(
            'Values that somebody published, by symbol, in scene units, degrees, rad/s and rad/s2, as numbers or (with '
            'their digits, a unit, a sense) texts; by = "drawing" or "computation".'
        ),
    )
    printed_rows: tuple[StatedRow, ...] = field(
        default=(), metadata=about("The same over a turn: tables with at (driver value or name of a position).")
    )
    printed_table: PrintedTable | None = field(default=None, metadata=about("The same from a CSV file."))
    scans: Scans = field(
        default_factory=dict,
        metadata=about("Drawings to be judged by what was read off their scans: mechanism, velocity, acceleration."),
    )
    positions: Positions | None = field(default=None, metadata=about("Positions with names, and their figure."))
    loops: dict[LinkName, PointNames] = field(
        default_factory=dict, metadata=closed("Vector loops by name, each the points that it goes through.")
    )
    cams: dict[LinkName, Cam] = field(
        default_factory=dict, metadata=closed("Cams by the law of their follower, by the link.")
    )
    gravity: Gravity | None = field(default=None, metadata=about("Weights pull where this table stands."))
    masses: dict[LinkName, Mass] = field(default_factory=dict, metadata=closed("Masses of moving links."))
    loads: dict[LinkName, Load] = field(default_factory=dict, metadata=closed("Forces and moments by name."))
    springs: dict[LinkName, Spring] = field(
        default_factory=dict, metadata=closed("Springs between points of two links, by name.")
    )
    balance: Balance | None = field(
        default=None, metadata=about("What is unknown besides the joint forces; a moment on the driver if left out.")
    )
    flywheel: Flywheel | None = field(default=None, metadata=about("A flywheel that evens out the turn."))
    vary: Vary | None = field(default=None, metadata=about("How a set of problems is drawn from the scene."))
    grading: dict[str, NotNegative] = field(
        default_factory=dict,
        metadata=about("Points of a class: for equations, drawing, values, and for single quantities by symbol."),
    )
    sheet: SheetWishes = field(default=SheetWishes())

    @property
    def drivers(self) -> tuple[Driver | DrivenSlide, ...]:
        """The drivers, whether written as one table or several."""
        return (self.driver,) if isinstance(self.driver, Driver | DrivenSlide) else tuple(self.driver)
