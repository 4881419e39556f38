"""The scene file, table by table: every key that may stand in it, its meaning, its unit, what holds without it.

What a table says is read where the mechanism gets it (`graphkin.scene.reading`).  Where the format leaves something
open, the docstring of `graphkin.scene` says how it is read.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Discriminator, Strict, StringConstraints, Tag
from pydantic import Field as Rule

from graphkin.scene.tables import FileTable, Form, Units, file_table, file_table_by_name, key
from graphkin.words import LANGUAGES

__all__ = [
    "PAPERS", "SCENE", "STANDARD_GRAVITY", "AllowedPressure", "At", "Background", "Balance", "BaseCircle", "Cam",
    "Compass", "Contact", "Convention", "Disc", "Drawing", "DrivenSlide", "Driver", "DriverLaw", "Drivers",
    "EndName", "Flywheel", "Frame", "FramePlace", "Gear", "Gravity", "Guide", "Keys", "LawName", "LawPiece",
    "Level", "Link", "Load", "LoadPhase", "Mass", "OneDriver", "Pin", "Polar", "Positions", "PrintedTable", "Range",
    "ReadScan", "SceneTables", "SheetWishes", "Spring", "Start", "StrokeStart", "Tools", "TwoOutlines", "TwoTeeth",
    "Vary",
]  # fmt: skip

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

# -- bodies of the scene: frame, links, pins ---------------------------------------------------------------------------


@file_table
class Polar(FileTable):
    """A point at a distance and an angle from another point of the link."""

    origin: PointName = key("The point of the link from which r is measured.", name="from")
    r: Magnitude = key("Distance.", unit="length")
    angle: Number = key("Degrees from the link's own x axis, or from the direction given by toward.", default=0.0)
    toward: PointName | None = key("The point of the link at which angle is 0.", default=None)


@file_table
class Compass(FileTable):
    """A point by its distances from two others of the link: the corner of a plate by its sides."""

    origins: TwoPoints = key("The two points of the link.", name="from")
    r: TwoLengths = key("The two distances.", unit="length")
    side: Literal["left", "right"] = key("Side of the directed line from the first to the second.")


FramePlace = Annotated[
    Annotated[Place, Tag("<list>")] | Annotated[Polar, Tag("<polar>")] | Annotated[Compass, Tag("<compass>")],
    forms("write x y from a r 400 angle"),
]
At = Annotated[
    Annotated[Place, Tag("<list>")]
    | Annotated[Polar, Tag("<polar>")]
    | Annotated[Compass, Tag("<compass>")]
    | Annotated[Literal["drawn"], Tag("<name>")],
    forms("write x y from c r 65 angle"),
]


@file_table
class Guide(FileTable):
    """A straight guide: any point of it and its direction; or a slot along a circle: its centre and radius."""

    through: NameOrPlace | None = key(
        "A point of the link by name, or [x, y] in the link's own axes.", unit="length", default=None
    )
    angle: Number | None = key("Direction in degrees from the link's own x axis.", default=None)
    toward: PointName | None = key(
        "Instead of angle: the point that the guide points to (of the link, fixed or drawn).", default=None
    )
    centre: NameOrPlace | None = key(
        "Of a circular slot: a point of the link, or [x, y] in the link's own axes.", unit="length", default=None
    )
    r: Magnitude | None = key("Radius of a circular slot.", unit="length", default=None)
    ends: Place | None = key(
        "Where a circular slot is drawn: from one to the other, degrees from the link's own x axis.", unit="angle",
        default=None,
    )  # fmt: skip


@file_table
class Disc(FileTable):
    """A round outline that a link carries."""

    centre: PointName = key("A point of the link.")
    r: Number = key("Its radius; negative: hollow, the body lies outside (a ring).", unit="length")


@file_table
class Frame(FileTable):
    """The fixed link."""

    name: LinkName = key('Name of the fixed link, "0" if not given.', default="0")
    points: dict[PointName, FramePlace] = key(
        "Fixed pivots, [x, y] each, or polar from another, or by the distances from two others.", unit="length",
        closed=True, default_factory=dict,
    )  # fmt: skip
    guides: dict[LinkName, Guide] = key("Straight guides by name.", closed=True, default_factory=dict)
    discs: dict[LinkName, Disc] = key("Round outlines by name.", closed=True, default_factory=dict)


@file_table
class Link(FileTable):
    """A moving link."""

    points: PointNames = key(
        "Own points: two for a bar, one for a bar of no fixed length or a block, or none.", default=()
    )
    length: Magnitude | None = key("Distance of the two own points.", unit="length", default=None)
    on: GuideRefs | None = key(
        'What the link slides on: "3" (own axis of link 3), "6.h" (a guide), or two of them.', default=None
    )
    angle_on: Numbers | None = key(
        "Degrees from the guide to the link's own x axis; one number for each guide.", default=None
    )
    at: dict[PointName, At] = key("Further points.", unit="length", closed=True, default_factory=dict)
    guides: dict[LinkName, Guide] = key("Straight guides by name.", closed=True, default_factory=dict)
    discs: dict[LinkName, Disc] = key("Round outlines by name.", closed=True, default_factory=dict)
    start: Number | None = key(
        "Where rolling leaves it open: degrees of its own axis (of a link with on, its travel) at the "
        "scene's own driver value; 0 if left out.", default=None,
    )  # fmt: skip
    redundant: Switch = key("The link only repeats what others already hold.", default=False)


@file_table
class Pin(FileTable):
    """A pin that runs in slots."""

    of: LinkName = key("The link that has the pin.")
    slots: GuideRefs = key('The guide it runs in ("3.s"), or a list of guides.', name="in")


# -- what touches, cams ------------------------------------------------------------------------------------------------


TwoOutlines = Annotated[List[GuideRef], Rule(min_length=2, max_length=2)]
TwoTeeth = Annotated[
    List[
        Annotated[
            Annotated[Number, Tag("<number>")] | Annotated[Literal["rack"], Tag("<name>")],
            forms("write a number of teeth or rack"),
        ]
    ],
    Rule(min_length=2, max_length=2),
]


@file_table
class Contact(FileTable):
    """Two outlines that touch."""

    between: TwoOutlines = key('Two discs ("1.k", "2.w"), or a disc and a straight guide (a flat face: "1.k", "2.f").')
    side: Literal["left", "right", "outside", "inside"] | None = key(
        "Of a face: the side of the directed guide on which the disc lies, left if left out. "
        "Of two discs: outside (if left out), or inside, the smaller in the larger.", default=None,
    )  # fmt: skip
    rolling: Switch = key("true: rolls without slip; false: slides.", default=False)


@file_table
class Gear(FileTable):
    """Two wheels with teeth, or a wheel and a rack."""

    between: TwoOutlines = key('The two wheels ("2", "4"); a rack, second, or a guide of it ("3.r").')
    teeth: TwoTeeth = key('Numbers of teeth; negative: internal teeth; "rack" for the second.')
    carrier: LinkName | None = key(
        "The link that holds both axes (the wheel's axis and the rack's slide); found if left out.", default=None
    )


LawName = Literal["uniform", "parabolic", "harmonic", "cycloidal", "345", "4567", "3-4-5", "4-5-6-7"]


@file_table
class LawPiece(FileTable):
    """A piece of the law of a follower or a driver, from where the piece before it ends: a rise, a fall, or a dwell."""

    to: Number = key("Where it ends: degrees of the cam, the last piece at 360; seconds of a driver.")
    rise: Number | None = key(
        "By how much the follower rises (length, or degrees of one that swings), or the driver's value grows.",
        default=None,
    )  # fmt: skip
    fall: Number | None = key("Instead of rise: by how much it falls.", default=None)
    by: LawName | None = key("The law of a rise or fall.", default=None)


@file_table
class DriverLaw(FileTable):
    """How a driver moves over the time, from 0 s on: by one law, by several one after the other, or by a table."""

    origin: Number | None = key("The driver's value at 0 s: degrees, or travel.", name="from", default=None)
    to: Number | None = key("The driver's value at the end.", default=None)
    rise: Number | None = key("Instead of to: by how much the value grows; negative where it falls.", default=None)
    duration: Magnitude | None = key("Seconds from the beginning to the end.", default=None)
    by: LawName | None = key("The law by which it goes from one to the other.", default=None)
    pieces: Annotated[List[LawPiece], Rule(max_length=1000)] = key(
        'Several, with dwells: [{ to = 0.5, rise = 90, by = "cycloidal" }, { to = 0.8 }].', default=()
    )
    table: Annotated[List[Place], Rule(max_length=5000)] = key(
        "Instead of laws: [[time, value], ...], joined by a cubic without acceleration at its ends.", default=()
    )


@file_table
class BaseCircle(FileTable):
    """The base circle of a cam."""

    r: Magnitude = key("Its radius.", unit="length")
    of: Literal["profile", "pitch"] = key(
        "Of the profile, or of the pitch curve, on which the roller's centre runs.", default="profile"
    )


@file_table
class AllowedPressure(FileTable):
    """Greatest pressure angles that are allowed."""

    rise: Number | None = key("Degrees, while the follower rises.", unit="angle", default=None)
    fall: Number | None = key("Degrees, while it falls.", unit="angle", default=None)


@file_table
class Cam(FileTable):
    """A cam that turns about its first point, given by the law of its follower."""

    follower: LinkName = key("The link that it moves: on a guide of the frame, or swinging about a point of the frame.")
    law: List[LawPiece] = key('Pieces of the law: [{ to = 60, rise = 28, by = "harmonic" }, ...].')
    base: BaseCircle = key('The base circle: { r = 30, of = "profile" }.')
    sense: Literal[1, -1] = key(
        "The cam degree is sense times the cam's own angle; -1: a cam that turns clockwise.", default=1
    )
    offset: Number | None = key(
        "Distance of a sliding follower's line from the axis, positive where the axis is to its left.", unit="length",
        default=None,
    )  # fmt: skip
    roller: Magnitude | None = key("Radius of the roller; a knife edge if left out.", unit="length", default=None)
    flat: Switch = key("A flat face square to the line of a sliding follower.", default=False)
    allow: AllowedPressure | None = key("Greatest pressure angles, judged.", default=None)


# -- what drives -------------------------------------------------------------------------------------------------------


@file_table
class Driver(FileTable):
    """A driven angle."""

    link: LinkName = key("The driven link.")
    angle: Number | None = key("Degrees, counter-clockwise; may be left out with [drawn].", unit="angle", default=None)
    omega: Number | None = key("rad/s, counter-clockwise positive.", unit="angular velocity", default=None)
    rpm: Number | None = key("Instead of omega: turns per minute.", default=None)
    speed: Number | None = key(
        "Instead of omega: the speed of the point named by of, with the sign of the driver's turning.",
        unit="velocity", default=None,
    )  # fmt: skip
    of: PointName | None = key("The point whose speed is given.", default=None)
    alpha: Number = key("rad/s2.", unit="angular acceleration", default=0.0)
    sense: Literal["clockwise", "counter-clockwise"] | None = key(
        "The sense of omega, rpm or speed, which then is a size, and in which alpha counts.", default=None
    )
    relative_to: LinkName | None = key("Angle from this link's own axis, not the frame's.", default=None)
    origin: Literal["dead point"] | None = key(
        '"dead point": the angle counts from a dead point of the mechanism.', name="from", default=None
    )
    near: Number | None = key("Degrees: which dead point, where there are several.", unit="angle", default=None)
    position: ShownName | None = key("Instead of angle: the name of a position of [positions].", default=None)
    law: DriverLaw | None = key("Instead of omega and alpha: how the driver moves over the time.", default=None)
    time: Number | None = key("Instead of angle: the moment of the law that is asked, in s.", default=None)


@file_table
class DrivenSlide(FileTable):
    """A driven sliding pair."""

    slide: SlideRef = key('The sliding link ("2"), the pair ("2/3") or a pin in a slot ("B/3").')
    travel: Number | None = key(
        "From the guide's origin to the sliding link's own; may be left out with [drawn].", unit="length", default=None
    )
    velocity: Number | None = key("Unit of speed, along the guide's sense.", unit="velocity", default=None)
    acceleration: Number = key("Unit of speed per s, along the guide's sense.", unit="acceleration", default=0.0)
    relative_to: LinkName | None = key("The guiding link, where there are two.", default=None)
    origin: Literal["dead point"] | None = key(
        '"dead point": the travel counts from a dead point of the mechanism.', name="from", default=None
    )
    near: Number | None = key("Travel: which dead point, where there are several.", unit="length", default=None)
    law: DriverLaw | None = key(
        "Instead of velocity and acceleration: how the driver moves over the time.", default=None
    )
    time: Number | None = key("Instead of travel: the moment of the law that is asked, in s.", default=None)


def _form_of_driver(value: object) -> str:
    """Whether a table drives a slide or an angle."""
    return "<slide>" if isinstance(value, dict) and "slide" in value and "link" not in value else "<angle>"


OneDriver = Annotated[
    Annotated[Driver, Tag("<angle>")] | Annotated[DrivenSlide, Tag("<slide>")], Discriminator(_form_of_driver)
]
Drivers = Annotated[
    Annotated[OneDriver, Tag("<one>")] | Annotated[List[OneDriver], Tag("<list>")],
    Discriminator(lambda value: "<list>" if isinstance(value, list) else "<one>"),
]

# -- what acts ---------------------------------------------------------------------------------------------------------


STANDARD_GRAVITY = 9.80665
"""m/s2."""


@file_table
class Gravity(FileTable):
    """Where weights pull, and how much."""

    g: Magnitude = key("Acceleration of gravity, m/s2.", default=STANDARD_GRAVITY)
    angle: Number = key("Its direction in degrees in the frame.", default=-90.0)


@file_table
class Mass(FileTable):
    """Mass of a moving link."""

    at: NameOrPlace = key("The centre of mass: a point of the link, or [x, y] in its own axes.", unit="length")
    mass: Magnitude | None = key("Its mass.", unit="mass", default=None)
    weight: Magnitude | None = key("Instead of mass: its weight, a force.", unit="force", default=None)
    inertia: NotNegative = key("Moment of inertia about the centre of mass.", unit="inertia", default=0.0)


@file_table
class LoadPhase(FileTable):
    """When a load acts: on a part of a stroke, or between two values of the driver."""

    stroke: SlideRef | None = key("The sliding pair on whose stroke it acts.", default=None)
    sense: Number = key("1: while it slides along the guide's sense; -1: against it.", default=1.0)
    start: NotNegative = key("Part of that stroke at which it begins.", name="from", default=0.0)
    end: NotNegative = key("Part of that stroke at which it ends.", name="to", default=1.0)
    driver: Place | None = key("Instead of stroke: two values of the first driver, growing between them.", default=None)


@file_table
class Load(FileTable):
    """A force or a moment on a moving link."""

    on: LinkName = key("The link.")
    at: NameOrPlace | None = key(
        "Where a force acts: a point of the link, or [x, y] in its own axes.", unit="length", default=None
    )
    force: Number | None = key("Size of a force.", unit="force", default=None)
    moment: Number | None = key("Instead of force: a moment, counter-clockwise positive.", unit="moment", default=None)
    angle: Number | None = key(
        "Direction of a force in degrees in the frame, or from the axis of follows.", default=None
    )
    follows: LinkName | None = key("The link with whose own axis the force turns.", default=None)
    against: SlideRef | None = key(
        "Instead of angle: along this pair's guide, opposite to its sliding velocity.", default=None
    )
    when: LoadPhase | None = key("When it acts; always if left out.", default=None)


@file_table
class Spring(FileTable):
    """A spring between points of two links; its force is preload + rate * (length - free), a pull where positive."""

    between: PointNames = key("The two points that it joins, of two links.")
    rate: Magnitude = key("Its rate: force unit per length unit of the scene.", unit="stiffness")
    free: NotNegative = key("Its free length.", unit="length")
    preload: Number = key("Its pull at the free length (wound-in tension).", unit="force", default=0.0)
    links: LinkNames | None = key(
        "The links of the two points, where several have them; the first that has it.", default=None
    )


@file_table
class Balance(FileTable):
    """What keeps the mechanism in its motion: a moment, or a force through a point along a known line."""

    on: LinkName = key("The link.")
    at: NameOrPlace | None = key(
        "Where a balancing force acts; a moment balances if left out.", unit="length", default=None
    )
    angle: NumberOrSquare | None = key(
        'Its line in degrees in the frame, or "square" to the link\'s own axis.', default=None
    )


@file_table
class Flywheel(FileTable):
    """A flywheel for a wished evenness of the turn."""

    on: LinkName = key("The link that carries it.")
    delta: Magnitude = key("Coefficient of speed fluctuation.")
    driving: Literal["constant"] = key("The driving moment over the turn.", default="constant")


# -- what is asked and stated ------------------------------------------------------------------------------------------


@file_table
class StrokeStart(FileTable):
    """A place on the stroke of a slide."""

    stroke: SlideRef = key('The sliding pair: "5/6".')
    at: Share = key("Part of the stroke that is done, 0 to 1.", default=0.0)
    sense: Literal[1, -1] = key("1: of the stroke that goes along the guide's sense, -1: against it.", default=1)


Start = Annotated[
    Annotated[Number, Tag("<number>")] | Annotated[StrokeStart, Tag("<polar>")],
    forms("write a driver value or stroke 5 6"),
]


@file_table
class Positions(FileTable):
    """Positions with names."""

    count: Count | None = key(
        "So many positions over a turn, numbered from 1 in the sense of the driver.", default=None
    )
    first: Start | None = key(
        "Position 1: a driver value, or the start of a stroke; the driver's own value.", default=None
    )
    also: dict[PositionName, Start] = key(
        "Further positions by name, each a driver value or a place of a stroke.", closed=True, default_factory=dict
    )
    show: tuple[ShownName, ...] = key(
        'On the figure: "limits", "all", or names of positions.', default=("limits", "all")
    )
    marks: tuple[Literal["theta", "stroke", "K", "gamma"], ...] = key(
        "What is drawn and dimensioned there.", default=("theta", "stroke", "K", "gamma")
    )

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all positions, the numbered ones first."""
        return *map(str, range(1, (self.count or 0) + 1)), *self.also

    def place(self, name: str, first: float | None, sense: float) -> float | StrokeStart | None:
        """Where a position lies; of a numbered one (rad) from ``first``, the value of position 1, None if that is not
        known.  ``sense`` is that of the driver (1 or -1)."""
        if name in self.also:
            return self.also[name]
        return None if first is None else first + sense * math.tau * (int(name) - 1) / (self.count or 1)


@file_table
class PrintedTable(FileTable):
    """A table of published values in a file beside the scene."""

    file: Text = key("A CSV file: heads are symbols, one column is called at.")
    by: Literal["drawing", "computation"] = key(
        "How the values were found; computed ones are judged by their digits.", default="drawing"
    )


# -- the sheet, pictures, sets of problems -----------------------------------------------------------------------------


Convention = Literal["chinese", "us", "british", "russian"]
EndName = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Za-z][A-Za-z0-9@/_]*$", max_length=80)]
Range = Annotated[List[Number], Rule(min_length=2, max_length=2)]
Keys = List[Annotated[str, StringConstraints(strict=True, max_length=80)]]
Drawing = Literal["mechanism", "velocity", "acceleration"]
Level = Literal["easy", "usual", "hard"]
PAPERS = {
    "A5": (148.0, 210.0), "A4": (210.0, 297.0), "A3": (297.0, 420.0), "A2": (420.0, 594.0), "A1": (594.0, 841.0),
    "A0": (841.0, 1189.0),
}  # fmt: skip


@file_table
class Tools(FileTable):
    """What the tools of a pencil drawing can do; used with --instrument pencil.

    A step is that to which a value is read or laid off; the others are standard deviations.
    """

    line_width: Tool = key("Width of a pencil line (mm); a point is pricked within half of it.", default=0.2)
    ruler: Tool = key("Step of the ruler (mm): 0.5, or 0.1 interpolated.", default=0.1)
    compass: Tool = key("Standard deviation of a compass radius (mm).", default=0.1)
    set_square: Tool = key("Standard deviation of a direction set (degrees).", default=0.1)
    protractor: Tool = key("Step of the protractor (degrees).", default=0.5)


@file_table
class Background(FileTable):
    """A photograph or scan to lie under the mechanism."""

    file: Text = key("A PNG or JPEG, by its path from the scene file.")
    points: dict[PointName, Place] = key(
        "Two points of the frame or of [drawn], with their pixels [x, y] from the left upper corner.", closed=True
    )


@file_table
class ReadScan(FileTable):
    """A drawing that somebody made of a figure, with what was read off the scan of it, in pixels."""

    points: dict[EndName, Place] = key(
        "Two ends that lie right, and so set scale and direction: of a polygon pole, B, B@3 or the symbol of a "
        "part whose tip it is (an_C/B); of the mechanism points. Pixels [x, y] from the left upper corner."
    )
    read: dict[EndName, Place] = key("The other ends as they were read off, in pixels.")
    file: Text | None = key("The scan itself, under the exact figure: PNG or JPEG, from the scene file.", default=None)
    within: Magnitude = key("What a line may be off, as a part of the longest: 0.01 if left out.", default=0.01)


@file_table
class SheetWishes(FileTable):
    """Wishes for the drawn sheet; scales are None where graphkin is to choose."""

    paper: Literal["A5", "A4", "A3", "A2", "A1", "A0"] = "A4"
    orientation: Literal["portrait", "landscape"] = "portrait"
    length_scale: Magnitude | None = key("mm of mechanism per mm of paper.", default=None)
    velocity_scale: Magnitude | None = key("Units of speed per mm of paper.", default=None)
    acceleration_scale: Magnitude | None = key("(unit of speed/s) per mm of paper.", default=None)
    force_scale: Magnitude | None = key("Force units per mm of paper.", default=None)
    loops: bool = key("Vector loops as a further page of the sheet.", default=False)
    convention: Convention = "chinese"
    language: Language = "en"
    tools: Tools = key("Tools of a pencil drawing.", name="instrument", default=Tools())
    background: Background | None = key("A photograph or scan under the mechanism, at true scale.", default=None)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the paper (mm, ISO 216)."""
        short, long = PAPERS[self.paper]
        return (long, short) if self.orientation == "landscape" else (short, long)


@file_table
class Vary(FileTable):
    """How a set of problems is drawn from a scene."""

    ranges: dict[str, Range] = key(
        'Least and greatest value by key of the scene: "links.2.length" = [80, 120].', default_factory=dict
    )
    only: bool = key("Nothing varies but what has a range or is tied to it.", default=False)
    keep: Keys = key("Keys that stay as they are: driver.omega.", default=())
    ratios: List[Keys] = key("Lists of keys that keep their ratios: the others follow the first.", default=())
    find: Symbols = key("Quantities of which each variant asks some.", default=())
    ask: Asked | None = key("How many of them; all if left out.", default=None)
    level: Level = key(
        "easy: lines cross well, transmission is good; hard: the lines may cross flatter.", default="usual"
    )
    crossing: Least | None = key("Degrees at which lines cross at least; that of the level if left out.", default=None)
    transmission: Least | None = key("Least transmission angle of two bars at the position, degrees.", default=None)
    pressure: Least | None = key("Greatest pressure angle of a slide at the position, degrees.", default=None)
    tolerance: Part | None = key(
        "Part of an answer that a drawing may miss it by at most; 0.05 if left out.", default=None
    )


# -- the whole file ----------------------------------------------------------------------------------------------------


@file_table_by_name
class SceneTables(FileTable):
    """A mechanism at one position, with what is asked of it: the whole file."""

    title: Text = key("Title in English.", default="")
    title_zh: Text = key("Title in Chinese.", default="")
    source: Text = key("Where the problem comes from.", default="")
    source_zh: Text = key("The same in Chinese.", default="")
    find: Symbols | None = key(
        "Quantities asked for: v_D, a_B@3, v_B@3/B@2, omega_3, theta_3, d_B/C, K_5/6, ... All motion if left out.",
        default=None,
    )
    units: Units = Units()
    frame: Frame = dataclasses.field(default_factory=Frame)
    links: Annotated[dict[LinkName, Link], Rule(min_length=1)] = key("The moving links by name.", closed=True)
    pins: dict[PointName, Pin] = key("Pins in slots, by the point.", closed=True, default_factory=dict)
    contacts: dict[PointName, Contact] = key(
        "Outlines that touch, by the name of the point of contact.", closed=True, default_factory=dict
    )
    gears: dict[LinkName, Gear] = key("Wheels with teeth by name.", closed=True, default_factory=dict)
    driver: Drivers = key("What drives: one table [driver], or several [[driver]].", default=())
    sketch: dict[PointName, Place] = key(
        "Roughly where points lie: picks the assembly.", unit="length", closed=True, default_factory=dict
    )
    drawn: dict[PointName, Place] = key(
        "Exact places of points of moving links in this position.", unit="length", closed=True, default_factory=dict
    )
    printed: dict[str, Stated] = key(
        "Values that somebody published, by symbol, in scene units, degrees, rad/s and rad/s2, as numbers or (with "
        'their digits, a unit, a sense) texts; by = "drawing" or "computation".', default_factory=dict,
    )  # fmt: skip
    printed_rows: tuple[dict[str, Stated], ...] = key(
        "The same over a turn: tables with at (driver value or name of a position).", default=()
    )
    printed_table: PrintedTable | None = key("The same from a CSV file.", default=None)
    scans: dict[Drawing, ReadScan] = key(
        "Drawings to be judged by what was read off their scans: mechanism, velocity, acceleration.",
        default_factory=dict,
    )
    positions: Positions | None = key("Positions with names, and their figure.", default=None)
    loops: dict[LinkName, PointNames] = key(
        "Vector loops by name, each the points that it goes through.", closed=True, default_factory=dict
    )
    cams: dict[LinkName, Cam] = key(
        "Cams by the law of their follower, by the link.", closed=True, default_factory=dict
    )
    gravity: Gravity | None = key("Weights pull where this table stands.", default=None)
    masses: dict[LinkName, Mass] = key("Masses of moving links.", closed=True, default_factory=dict)
    loads: dict[LinkName, Load] = key("Forces and moments by name.", closed=True, default_factory=dict)
    springs: dict[LinkName, Spring] = key(
        "Springs between points of two links, by name.", closed=True, default_factory=dict
    )
    balance: Balance | None = key(
        "What is unknown besides the joint forces; a moment on the driver if left out.", default=None
    )
    flywheel: Flywheel | None = key("A flywheel that evens out the turn.", default=None)
    vary: Vary | None = key("How a set of problems is drawn from the scene.", default=None)
    grading: dict[str, NotNegative] = key(
        "Points of a class: for equations, drawing, values, and for single quantities by symbol.", default_factory=dict
    )
    sheet: SheetWishes = SheetWishes()


SCENE = Form(SceneTables, "graphkin scene", needed="links")
"""What may stand in a scene file."""
