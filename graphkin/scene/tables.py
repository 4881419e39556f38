"""The keys of a scene file as typed tables: what a file says, in its own names and units (lengths in the scene's unit,
angles in degrees).

Each class is a table of the file, each field a key.  The classes only hold; what may stand in them is asked when a
scene is made of them (`graphkin.scene.form` has the rules, from which the JSON schema for editors comes too).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal, TypeAlias

from graphkin.scene.cam_tables import Cam
from graphkin.scene.class_tables import Vary
from graphkin.scene.contact_tables import ContactTable, DiscTable, GearTable
from graphkin.scene.file_table import FileTable
from graphkin.scene.file_table import about as _about
from graphkin.scene.file_table import closed as _closed
from graphkin.scene.load_tables import Balance, Flywheel, Gravity, Load, Mass, Spring

SMALLEST = 1e-15
"""The smallest length, and the smallest rate that is not 0."""

Convention = Literal["chinese", "us", "british", "russian"]

if TYPE_CHECKING:
    # what a caller may give; what the reader makes of it, and its rules, are the types of these names in scene.form
    Number = float
    Magnitude = float
    Tool = float
    Switch = bool
    Text = str
    Language = str
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
    Count = int
    Share = float
    NotNegative = float
    PositionName = str
    ShownName = str | int
    Start: TypeAlias = "float | StrokeStart"
    FramePlace: TypeAlias = "Sequence[float] | Polar | Compass"
    At: TypeAlias = "Sequence[float] | Polar | Compass | Literal['drawn']"
    Links: TypeAlias = "Mapping[str, Link]"
    Drivers: TypeAlias = "Driver | DrivenSlide | Sequence[Driver | DrivenSlide]"

__all__ = [
    "Compass",
    "Convention",
    "DrivenSlide",
    "Driver",
    "Frame",
    "Guide",
    "Link",
    "Pin",
    "Polar",
    "Positions",
    "PrintedTable",
    "SceneTables",
    "SheetWishes",
    "StrokeStart",
    "Tools",
    "Units",
    "Vary",
]


@dataclass(frozen=True)
class Units(FileTable):
    """Units of the file."""

    length: Literal["mm", "cm", "m", "in", "ft"] = field(
        default="mm", metadata=_about("The unit of every length; speeds are in it per second.")
    )
    speed: Literal["mm/s", "cm/s", "m/s", "in/s", "ft/s"] | None = field(
        default=None,
        metadata=_about("The unit of velocities, where it is not the length unit per second; accelerations are per s."),
    )
    force: Literal["N", "kN", "kgf", "lbf"] = field(
        default="N", metadata=_about("The unit of every force; moments are in it times metre.")
    )
    mass: Literal["kg", "g", "lb"] = field(
        default="kg", metadata=_about("The unit of every mass; inertias are in it times m2 (ft2 with lb).")
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


@dataclass(frozen=True)
class Guide(FileTable):
    """A straight guide: any point of it and its direction; or a slot along a circle: its centre and radius."""

    through: NameOrPlace | None = field(
        default=None, metadata=_about("A point of the link by name, or [x, y] in the link's own axes.")
    )
    angle: Number | None = field(
        default=None, metadata=_about("Direction in degrees from the link's own x axis.")
    )
    toward: PointName | None = field(
        default=None,
        metadata=_about("Instead of angle: the point that the guide points to (of the link, fixed or drawn)."),
    )
    centre: NameOrPlace | None = field(
        default=None, metadata=_about("Of a circular slot: a point of the link, or [x, y] in the link's own axes.")
    )
    r: Magnitude | None = field(default=None, metadata=_about("Radius of a circular slot."))
    ends: Place | None = field(
        default=None,
        metadata=_about("Where a circular slot is drawn: from one to the other, degrees from the link's own x axis."),
    )


@dataclass(frozen=True)
class Frame(FileTable):
    """The fixed link."""

    name: LinkName = field(default="0", metadata=_about('Name of the fixed link, "0" if not given.'))
    points: dict[PointName, FramePlace] = field(
        default_factory=dict,
        metadata=_closed("Fixed pivots, [x, y] each, or polar from another, or by the distances from two others."),
    )
    guides: dict[LinkName, Guide] = field(default_factory=dict, metadata=_closed("Straight guides by name."))
    discs: dict[LinkName, DiscTable] = field(default_factory=dict, metadata=_closed("Round outlines by name."))


@dataclass(frozen=True)
class Polar(FileTable):
    """A point at a distance and an angle from another point of the link."""

    origin: PointName = field(metadata=_about("The point of the link from which r is measured.", alias="from"))
    r: Magnitude = field(metadata=_about("Distance."))
    angle: Number = field(
        default=0.0, metadata=_about("Degrees from the link's own x axis, or from the direction given by toward.")
    )
    toward: PointName | None = field(
        default=None, metadata=_about("The point of the link at which angle is 0.")
    )


@dataclass(frozen=True)
class Compass(FileTable):
    """A point by its distances from two others of the link: the corner of a plate by its sides."""

    origins: TwoPoints = field(metadata=_about("The two points of the link.", alias="from"))
    r: TwoLengths = field(metadata=_about("The two distances."))
    side: Literal["left", "right"] = field(
        metadata=_about("Side of the directed line from the first to the second.")
    )


@dataclass(frozen=True)
class Link(FileTable):
    """A moving link."""

    points: PointNames = field(
        default=(), metadata=_about("Own points: two for a bar, one for a bar of no fixed length or a block, or none.")
    )
    length: Magnitude | None = field(default=None, metadata=_about("Distance of the two own points."))
    on: GuideRefs | None = field(
        default=None,
        metadata=_about('What the link slides on: "3" (own axis of link 3), "6.h" (a guide), or two of them.'),
    )
    angle_on: Numbers | None = field(
        default=None, metadata=_about("Degrees from the guide to the link's own x axis; one number for each guide.")
    )
    at: dict[PointName, At] = field(default_factory=dict, metadata=_closed("Further points."))
    guides: dict[LinkName, Guide] = field(default_factory=dict, metadata=_closed("Straight guides by name."))
    discs: dict[LinkName, DiscTable] = field(default_factory=dict, metadata=_closed("Round outlines by name."))
    start: Number | None = field(
        default=None,
        metadata=_about("Where rolling leaves it open: degrees of its own axis (of a link with on, its travel) at the "
                        "scene's own driver value; 0 if left out."),
    )
    redundant: Switch = field(default=False, metadata=_about("The link only repeats what others already hold."))


@dataclass(frozen=True)
class Pin(FileTable):
    """A pin that runs in slots."""

    of: LinkName = field(metadata=_about("The link that has the pin."))
    slots: GuideRefs = field(metadata=_about('The guide it runs in ("3.s"), or a list of guides.', alias="in"))


@dataclass(frozen=True)
class Driver(FileTable):
    """A driven angle."""

    link: LinkName = field(metadata=_about("The driven link."))
    angle: Number | None = field(
        default=None, metadata=_about("Degrees, counter-clockwise; may be left out with [drawn].")
    )
    omega: Number | None = field(default=None, metadata=_about("rad/s, counter-clockwise positive."))
    rpm: Number | None = field(default=None, metadata=_about("Instead of omega: turns per minute."))
    speed: Number | None = field(
        default=None,
        metadata=_about("Instead of omega: the speed of the point named by of, with the sign of the driver's turning."),
    )
    of: PointName | None = field(default=None, metadata=_about("The point whose speed is given."))
    alpha: Number = field(default=0.0, metadata=_about("rad/s2."))
    sense: Literal["clockwise", "counter-clockwise"] | None = field(
        default=None,
        metadata=_about("The sense of omega, rpm or speed, which then is a size, and in which alpha counts."),
    )
    relative_to: LinkName | None = field(
        default=None, metadata=_about("Angle from this link's own axis, not the frame's.")
    )
    origin: Literal["dead point"] | None = field(
        default=None,
        metadata=_about('"dead point": the angle counts from a dead point of the mechanism.', alias="from"),
    )
    near: Number | None = field(
        default=None, metadata=_about("Degrees: which dead point, where there are several.")
    )
    position: ShownName | None = field(
        default=None, metadata=_about("Instead of angle: the name of a position of [positions].")
    )


@dataclass(frozen=True)
class DrivenSlide(FileTable):
    """A driven sliding pair."""

    slide: SlideRef = field(metadata=_about('The sliding link ("2"), the pair ("2/3") or a pin in a slot ("B/3").'))
    travel: Number | None = field(
        default=None,
        metadata=_about("From the guide's origin to the sliding link's own; may be left out with [drawn]."),
    )
    velocity: Number | None = field(default=None, metadata=_about("Unit of speed, along the guide's sense."))
    acceleration: Number = field(default=0.0, metadata=_about("Unit of speed per s, along the guide's sense."))
    relative_to: LinkName | None = field(
        default=None, metadata=_about("The guiding link, where there are two.")
    )
    origin: Literal["dead point"] | None = field(
        default=None,
        metadata=_about('"dead point": the travel counts from a dead point of the mechanism.', alias="from"),
    )
    near: Number | None = field(
        default=None, metadata=_about("Travel: which dead point, where there are several.")
    )


@dataclass(frozen=True)
class Tools(FileTable):
    """What the tools of a pencil drawing can do; used with --instrument pencil.

    A step is that to which a value is read or laid off; the others are standard deviations.
    """

    line_width: Tool = field(
        default=0.2, metadata=_about("Width of a pencil line (mm); a point is pricked within half of it.")
    )
    ruler: Tool = field(default=0.1, metadata=_about("Step of the ruler (mm): 0.5, or 0.1 interpolated."))
    compass: Tool = field(default=0.1, metadata=_about("Standard deviation of a compass radius (mm)."))
    set_square: Tool = field(default=0.1, metadata=_about("Standard deviation of a direction set (degrees)."))
    protractor: Tool = field(default=0.5, metadata=_about("Step of the protractor (degrees)."))


PAPERS = {
    "A5": (148.0, 210.0), "A4": (210.0, 297.0), "A3": (297.0, 420.0), "A2": (420.0, 594.0), "A1": (594.0, 841.0),
    "A0": (841.0, 1189.0),
}  # fmt: skip


@dataclass(frozen=True)
class BackgroundFile(FileTable):
    """A photograph or scan to lie under the mechanism."""

    file: Text = field(metadata=_about("A PNG or JPEG, by its path from the scene file."))
    points: dict[PointName, Place] = field(
        metadata=_closed("Two points of the frame or of [drawn], with their pixels [x, y] from the left upper corner.")
    )


@dataclass(frozen=True)
class SheetWishes(FileTable):
    """Wishes for the drawn sheet; scales are None where graphkin is to choose."""

    paper: Literal["A5", "A4", "A3", "A2", "A1", "A0"] = "A4"
    orientation: Literal["portrait", "landscape"] = "portrait"
    length_scale: Magnitude | None = field(default=None, metadata=_about("mm of mechanism per mm of paper."))
    velocity_scale: Magnitude | None = field(default=None, metadata=_about("Units of speed per mm of paper."))
    acceleration_scale: Magnitude | None = field(default=None, metadata=_about("(unit of speed/s) per mm of paper."))
    force_scale: Magnitude | None = field(default=None, metadata=_about("Force units per mm of paper."))
    loops: bool = field(default=False, metadata=_about("Vector loops as a further page of the sheet."))
    convention: Convention = "chinese"
    language: Language = "en"
    tools: Tools = field(default=Tools(), metadata=_about("Tools of a pencil drawing.", alias="instrument"))
    background: BackgroundFile | None = field(
        default=None, metadata=_about("A photograph or scan under the mechanism, at true scale.")
    )

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the paper (mm, ISO 216)."""
        short, long = PAPERS[self.paper]
        return (long, short) if self.orientation == "landscape" else (short, long)


@dataclass(frozen=True)
class StrokeStart(FileTable):
    """A place on the stroke of a slide."""

    stroke: SlideRef = field(metadata=_about('The sliding pair: "5/6".'))
    at: Share = field(default=0.0, metadata=_about("Part of the stroke that is done, 0 to 1."))
    sense: Literal[1, -1] = field(
        default=1, metadata=_about("1: of the stroke that goes along the guide's sense, -1: against it.")
    )


@dataclass(frozen=True)
class Positions(FileTable):
    """Positions with names."""

    count: Count | None = field(
        default=None, metadata=_about("So many positions over a turn, numbered from 1 in the sense of the driver.")
    )
    first: Start | None = field(
        default=None, metadata=_about("Position 1: a driver value, or the start of a stroke; the driver's own value.")
    )
    also: dict[PositionName, Start] = field(
        default_factory=dict, metadata=_closed("Further positions by name, each a driver value or a place of a stroke.")
    )
    show: tuple[ShownName, ...] = field(
        default=("limits", "all"), metadata=_about('On the figure: "limits", "all", or names of positions.')
    )
    marks: tuple[Literal["theta", "stroke", "K", "gamma"], ...] = field(
        default=("theta", "stroke", "K", "gamma"), metadata=_about("What is drawn and dimensioned there.")
    )


@dataclass(frozen=True)
class PrintedTable(FileTable):
    """A table of published values in a file beside the scene."""

    file: Text = field(metadata=_about("A CSV file: heads are symbols, one column is called at."))
    by: Literal["drawing", "computation"] = field(
        default="drawing", metadata=_about("How the values were found; computed ones are judged by their digits.")
    )


@dataclass(frozen=True, kw_only=True)
class SceneTables(FileTable):
    """A mechanism at one position, with what is asked of it: the whole file."""

    title: Text = field(default="", metadata=_about("Title in English."))
    title_zh: Text = field(default="", metadata=_about("Title in Chinese."))
    source: Text = field(default="", metadata=_about("Where the problem comes from."))
    source_zh: Text = field(default="", metadata=_about("The same in Chinese."))
    find: Symbols | None = field(
        default=None,
        metadata=_about(
            "Quantities asked for: v_D, a_B@3, v_B@3/B@2, omega_3, theta_3, d_B/C, K_5/6, ... All motion if left out."
        ),
    )
    units: Units = Units()
    frame: Frame = field(default_factory=Frame)
    links: Links = field(metadata=_closed("The moving links by name."))
    pins: dict[PointName, Pin] = field(default_factory=dict, metadata=_closed("Pins in slots, by the point."))
    contacts: dict[PointName, ContactTable] = field(
        default_factory=dict, metadata=_closed("Outlines that touch, by the name of the point of contact.")
    )
    gears: dict[LinkName, GearTable] = field(default_factory=dict, metadata=_closed("Wheels with teeth by name."))
    driver: Drivers = field(default=(), metadata=_about("What drives: one table [driver], or several [[driver]]."))
    sketch: dict[PointName, Place] = field(
        default_factory=dict, metadata=_closed("Roughly where points lie: picks the assembly.")
    )
    drawn: dict[PointName, Place] = field(
        default_factory=dict, metadata=_closed("Exact places of points of moving links in this position.")
    )
    printed: dict[str, Stated] = field(
        default_factory=dict,
        metadata=_about(
            'Values that somebody published, by symbol, in scene units, degrees, rad/s and rad/s2, as numbers or (with '
            'their digits, a unit, a sense) texts; by = "drawing" or "computation".'
        ),
    )
    printed_rows: tuple[StatedRow, ...] = field(
        default=(), metadata=_about("The same over a turn: tables with at (driver value or name of a position).")
    )
    printed_table: PrintedTable | None = field(default=None, metadata=_about("The same from a CSV file."))
    positions: Positions | None = field(default=None, metadata=_about("Positions with names, and their figure."))
    loops: dict[LinkName, PointNames] = field(
        default_factory=dict, metadata=_closed("Vector loops by name, each the points that it goes through.")
    )
    cams: dict[LinkName, Cam] = field(
        default_factory=dict, metadata=_closed("Cams by the law of their follower, by the link.")
    )
    gravity: Gravity | None = field(default=None, metadata=_about("Weights pull where this table stands."))
    masses: dict[LinkName, Mass] = field(default_factory=dict, metadata=_closed("Masses of moving links."))
    loads: dict[LinkName, Load] = field(default_factory=dict, metadata=_closed("Forces and moments by name."))
    springs: dict[LinkName, Spring] = field(
        default_factory=dict, metadata=_closed("Springs between points of two links, by name.")
    )
    balance: Balance | None = field(
        default=None, metadata=_about("What is unknown besides the joint forces; a moment on the driver if left out.")
    )
    flywheel: Flywheel | None = field(default=None, metadata=_about("A flywheel that evens out the turn."))
    vary: Vary | None = field(default=None, metadata=_about("How a set of problems is drawn from the scene."))
    grading: dict[str, NotNegative] = field(
        default_factory=dict,
        metadata=_about("Points of a class: for equations, drawing, values, and for single quantities by symbol."),
    )
    sheet: SheetWishes = SheetWishes()

    @property
    def drivers(self) -> tuple[Driver | DrivenSlide, ...]:
        """The drivers, whether written as one table or several."""
        return (self.driver,) if isinstance(self.driver, Driver | DrivenSlide) else tuple(self.driver)
