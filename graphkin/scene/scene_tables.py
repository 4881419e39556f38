"""The scene file, table by table: every key, its unit, and its default.

The tables of words explain each key (``[keys]``), under the names of its table and the key.

The mechanism is made from the tables in `graphkin.scene.scene`.  The docstring of `graphkin.scene` settles the points
that the format leaves open.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import field
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import Discriminator, Strict, StringConstraints, Tag
from pydantic import Field as Rule

from graphkin.errors import Problem, did_you_mean
from graphkin.scene.laws import LAWS
from graphkin.scene.tables import FileTable, Form, Units, file_table, file_table_by_name, key, named
from graphkin.words import LANGUAGES, Phrase, listed

SMALLEST, LARGEST = 1e-15, 1e15
"""The smallest length, and the smallest rate that is not 0; the largest number."""
LONGEST_TEXT = 300

# kinds of values

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
Part = Annotated[Magnitude, Rule(le=0.5)]
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
    """The form of a value that may be written in several forms."""
    if isinstance(value, str):
        return "<name>"
    if isinstance(value, list):
        return "<list>"
    if isinstance(value, dict):
        return "<compass>" if isinstance(value.get("from"), list) else "<polar>"
    return "<number>" if isinstance(value, int | float) and not isinstance(value, bool) else None


def forms(wanted: str) -> Discriminator:
    """The rule that tells the forms of a value apart; ``wanted`` is the key of the phrase that lists them."""
    return Discriminator(_form, custom_error_type="form", custom_error_message=wanted)


NAME, LIST, NUMBER, POLAR, COMPASS = map(Tag, ("<name>", "<list>", "<number>", "<polar>", "<compass>"))
ANumber = Annotated[Number, NUMBER]
APlace = Annotated[Place, LIST]
NameOrPlace = Annotated[Annotated[PointName, NAME] | APlace, forms("write the name of a point b or")]
GuideRefs = Annotated[
    Annotated[GuideRef, NAME] | Annotated[List[GuideRef], Rule(min_length=1, max_length=2), LIST],
    forms("write a guide as link or link.guide or"),
]
Numbers = Annotated[
    ANumber | Annotated[List[Number], Rule(min_length=1, max_length=2), LIST],
    forms("write a number or a list with one"),
]
NumberOrSquare = Annotated[
    ANumber | Annotated[Literal["square"], NAME], forms("write degrees or square for square to the")
]
Stated = Annotated[
    ANumber | APlace | Annotated[str, StringConstraints(strict=True, max_length=80), NAME],
    forms("write a number 1.0 for its digits as"),
]

# bodies of the scene: frame, links, pins


@file_table
class Polar(FileTable):
    """A point at a distance and an angle from another point of the link."""

    origin: PointName = key(name="from")
    r: Magnitude = key(unit="length")
    angle: Number = 0.0
    toward: PointName | None = None


@file_table
class Compass(FileTable):
    """A point by its distances from two others of the link: the corner of a plate by its sides."""

    origins: TwoPoints = key(name="from")
    r: TwoLengths = key(unit="length")
    side: Literal["left", "right"]


APolar = Annotated[Polar, POLAR]
ACompass = Annotated[Compass, COMPASS]
FramePlace = Annotated[APlace | APolar | ACompass, forms("write x y from a r 400 angle")]
At = Annotated[
    APlace | APolar | ACompass | Annotated[Literal["drawn"], NAME], forms("write x y from c r 65 angle")
]


@file_table
class Guide(FileTable):
    """A straight guide: any point of it and its direction; or a slot along a circle: its centre and radius."""

    through: NameOrPlace | None = key(unit="length", default=None)
    angle: Number | None = None
    toward: PointName | None = None
    centre: NameOrPlace | None = key(unit="length", default=None)
    r: Magnitude | None = key(unit="length", default=None)
    ends: Place | None = key(unit="angle", default=None)


@file_table
class Disc(FileTable):
    """A round outline that a link carries."""

    centre: PointName
    r: Number = key(unit="length")


@file_table
class Frame(FileTable):
    """The fixed link."""

    name: LinkName = "0"
    points: dict[PointName, FramePlace] = named("length")
    guides: dict[LinkName, Guide] = named()
    discs: dict[LinkName, Disc] = named()


@file_table
class Link(FileTable):
    """A moving link."""

    points: PointNames = ()
    length: Magnitude | None = key(unit="length", default=None)
    on: GuideRefs | None = None
    angle_on: Numbers | None = None
    at: dict[PointName, At] = named("length")
    guides: dict[LinkName, Guide] = named()
    discs: dict[LinkName, Disc] = named()
    start: Number | None = None
    redundant: Switch = False


@file_table
class Pin(FileTable):
    """A pin that runs in slots."""

    of: LinkName
    slots: GuideRefs = key(name="in")


# what touches, cams


TwoOutlines = Annotated[List[GuideRef], Rule(min_length=2, max_length=2)]
Teeth = Annotated[ANumber | Annotated[Literal["rack"], NAME], forms("write a number of teeth or rack")]
TwoTeeth = Annotated[List[Teeth], Rule(min_length=2, max_length=2)]


@file_table
class Contact(FileTable):
    """Two outlines that touch."""

    between: TwoOutlines
    side: Literal["left", "right", "outside", "inside"] | None = None
    rolling: Switch = False


@file_table
class Gear(FileTable):
    """Two wheels with teeth, or a wheel and a rack."""

    between: TwoOutlines
    teeth: TwoTeeth
    carrier: LinkName | None = None
    rolling: ClassVar[bool] = True


TOUCHING = "contacts", "gears"
"""The tables of bodies that touch, each entry ``between`` two of them, ``rolling`` or not."""


LawName = Literal["uniform", "parabolic", "harmonic", "cycloidal", "345", "4567", "3-4-5", "4-5-6-7"]


@file_table
class LawPiece(FileTable):
    """A piece of the law of a follower or a driver, from where the piece before it ends: a rise, a fall, or a dwell."""

    to: Number
    rise: Number | None = None
    fall: Number | None = None
    by: LawName | None = None

    @property
    def height(self) -> float:
        """Its rise, in the unit of the file."""
        return (self.rise or 0.0) - (self.fall or 0.0)

    def problems(self, where: str) -> Iterator[Problem]:
        """The problems of this piece by itself."""
        moves = self.rise is not None or self.fall is not None
        if self.rise is not None and self.fall is not None:
            yield Problem(where, "has both rise and fall", "give one of them or none for a")
        elif moves and self.by is None:
            *names, last = (f'"{name}"' for name in LAWS)
            yield Problem(where, "does not say its law", "by is one law", names=listed(names), last=last)
        elif self.by is not None and not moves:
            yield Problem(where, "has by without rise or fall", "a dwell has no law", by=self.by)


@file_table
class DriverLaw(FileTable):
    """The motion of a driver over time, from 0 s on: by one law, by several one after the other, or by a table."""

    origin: Number | None = key(name="from", default=None)
    to: Number | None = None
    rise: Number | None = None
    duration: Magnitude | None = None
    by: LawName | None = None
    pieces: Annotated[List[LawPiece], Rule(max_length=1000)] = ()
    table: Annotated[List[Place], Rule(max_length=5000)] = ()


@file_table
class BaseCircle(FileTable):
    """The base circle of a cam."""

    r: Magnitude = key(unit="length")
    of: Literal["profile", "pitch"] = "profile"


@file_table
class AllowedPressure(FileTable):
    """Greatest pressure angles that are allowed."""

    rise: Number | None = key(unit="angle", default=None)
    fall: Number | None = key(unit="angle", default=None)


@file_table
class Cam(FileTable):
    """A cam that turns about its first point, given by the law of its follower."""

    follower: LinkName
    law: List[LawPiece]
    base: BaseCircle
    sense: Literal[1, -1] = 1
    offset: Number | None = key(unit="length", default=None)
    roller: Magnitude | None = key(unit="length", default=None)
    flat: Switch = False
    allow: AllowedPressure | None = None


# what drives


@file_table
class Driver(FileTable):
    """A driven angle."""

    link: LinkName
    angle: Number | None = key(unit="angle", default=None)
    omega: Number | None = key(unit="angular velocity", default=None)
    rpm: Number | None = None
    speed: Number | None = key(unit="velocity", default=None)
    of: PointName | None = None
    alpha: Number = key(unit="angular acceleration", default=0.0)
    sense: Literal["clockwise", "counter-clockwise"] | None = None
    relative_to: LinkName | None = None
    origin: Literal["dead point"] | None = key(name="from", default=None)
    near: Number | None = key(unit="angle", default=None)
    position: ShownName | None = None
    law: DriverLaw | None = None
    time: Number | None = None


@file_table
class DrivenSlide(FileTable):
    """A driven sliding pair."""

    slide: SlideRef
    travel: Number | None = key(unit="length", default=None)
    velocity: Number | None = key(unit="velocity", default=None)
    acceleration: Number = key(unit="acceleration", default=0.0)
    relative_to: LinkName | None = None
    origin: Literal["dead point"] | None = key(name="from", default=None)
    near: Number | None = key(unit="length", default=None)
    law: DriverLaw | None = None
    time: Number | None = None


OneDriver = Annotated[
    Annotated[Driver, Tag("<angle>")] | Annotated[DrivenSlide, Tag("<slide>")],
    Discriminator(lambda value: "<slide>" if isinstance(value, dict) and value.keys() & {"slide", "link"} == {"slide"}
                  else "<angle>"),
]
Drivers = Annotated[
    Annotated[OneDriver, Tag("<one>")] | Annotated[List[OneDriver], Tag("<list>")],
    Discriminator(lambda value: "<list>" if isinstance(value, list) else "<one>"),
]

# what acts


STANDARD_GRAVITY = 9.80665
"""m/s2."""


@file_table
class Gravity(FileTable):
    """Direction and size of gravity."""

    g: Magnitude = STANDARD_GRAVITY
    angle: Number = -90.0


@file_table
class Mass(FileTable):
    """Mass of a moving link."""

    at: NameOrPlace = key(unit="length")
    mass: Magnitude | None = key(unit="mass", default=None)
    weight: Magnitude | None = key(unit="force", default=None)
    inertia: NotNegative = key(unit="inertia", default=0.0)


@file_table
class LoadPhase(FileTable):
    """When a load acts: on a part of a stroke, or between two values of the driver."""

    stroke: SlideRef | None = None
    sense: Number = 1.0
    start: NotNegative = key(name="from", default=0.0)
    end: NotNegative = key(name="to", default=1.0)
    driver: Place | None = None


@file_table
class Load(FileTable):
    """A force or a moment on a moving link."""

    on: LinkName
    at: NameOrPlace | None = key(unit="length", default=None)
    force: Number | None = key(unit="force", default=None)
    moment: Number | None = key(unit="moment", default=None)
    angle: Number | None = None
    follows: LinkName | None = None
    against: SlideRef | None = None
    when: LoadPhase | None = None


@file_table
class Spring(FileTable):
    """A spring between points of two links; its force is preload + rate * (length - free), a pull where positive."""

    between: PointNames
    rate: Magnitude = key(unit="stiffness")
    free: NotNegative = key(unit="length")
    preload: Number = key(unit="force", default=0.0)
    links: LinkNames | None = None


@file_table
class Balance(FileTable):
    """The load that keeps the mechanism in its motion: a moment, or a force through a point along a known line."""

    on: LinkName
    at: NameOrPlace | None = key(unit="length", default=None)
    angle: NumberOrSquare | None = None


@file_table
class Flywheel(FileTable):
    """A flywheel for a wished evenness of the turn."""

    on: LinkName
    delta: Magnitude
    driving: Literal["constant"] = "constant"


# what is asked and stated


@file_table
class StrokeStart(FileTable):
    """A place on the stroke of a slide."""

    stroke: SlideRef
    at: Share = 0.0
    sense: Literal[1, -1] = 1


Start = Annotated[ANumber | Annotated[StrokeStart, POLAR], forms("write a driver value or stroke 5 6")]


@file_table
class Positions(FileTable):
    """Positions with names."""

    count: Count | None = None
    first: Start | None = None
    also: dict[PositionName, Start] = named()
    show: tuple[ShownName, ...] = ("limits", "all")
    marks: tuple[Literal["theta", "stroke", "K", "gamma"], ...] = ("theta", "stroke", "K", "gamma")

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all positions, the numbered ones first."""
        return *map(str, range(1, (self.count or 0) + 1)), *self.also

    def place(self, name: str, first: float | None, sense: float) -> float | StrokeStart | None:
        """The place of a position; of a numbered one an angle (rad) from ``first``, the value of position 1, None if
        that is unknown.  ``sense`` is the driver's sense (1 or -1)."""
        if name in self.also:
            return self.also[name]
        return None if first is None else first + sense * math.tau * (int(name) - 1) / (self.count or 1)


def no_position(where: str, name: str, known: Sequence[str]) -> Problem | None:
    """The problem of a name that no position has, None if it is known."""
    wanted = did_you_mean(name, known) if known else Phrase("name positions in positions")
    return None if name in known else Problem(where, "there is no position", wanted, at=name)


@file_table
class PrintedTable(FileTable):
    """A table of published values in a file beside the scene."""

    file: Text
    by: Literal["drawing", "computation"] = "drawing"


# the sheet, pictures, sets of problems


Convention = Literal["chinese", "us", "british", "russian"]
EndName = Annotated[str, StringConstraints(strict=True, pattern=r"^[A-Za-z][A-Za-z0-9@/_]*$", max_length=80)]
Range = Annotated[List[Number], Rule(min_length=2, max_length=2)]
Keys = List[Annotated[str, StringConstraints(strict=True, max_length=80)]]
Diagram = Literal["mechanism", "velocity", "acceleration"]
DIAGRAMS: tuple[Diagram, ...] = ("mechanism", "velocity", "acceleration")
Level = Literal["easy", "usual", "hard"]
PAPERS = {
    "A5": (148.0, 210.0), "A4": (210.0, 297.0), "A3": (297.0, 420.0), "A2": (420.0, 594.0), "A1": (594.0, 841.0),
    "A0": (841.0, 1189.0),
}


@file_table
class Tools(FileTable):
    """The accuracy of a pencil drawing's tools; used with --instrument pencil.

    A step is the fineness to which a value is read or laid off; the others are standard deviations.
    """

    line_width: Tool = 0.2
    ruler: Tool = 0.1
    compass: Tool = 0.1
    set_square: Tool = 0.1
    protractor: Tool = 0.5


@file_table
class Background(FileTable):
    """A photograph or scan to lie under the mechanism."""

    file: Text
    points: dict[PointName, Place] = key(closed=True)


@file_table
class ReadScan(FileTable):
    """A drawing that somebody made of a figure, with the readings from its scan, in pixels."""

    points: dict[EndName, Place]
    read: dict[EndName, Place]
    file: Text | None = None
    within: Magnitude = 0.01


@file_table
class SheetWishes(FileTable):
    """Wishes for the drawn sheet; scales are None where graphkin chooses them."""

    paper: Literal["A5", "A4", "A3", "A2", "A1", "A0"] = "A4"
    orientation: Literal["portrait", "landscape"] = "portrait"
    length_scale: Magnitude | None = None
    velocity_scale: Magnitude | None = None
    acceleration_scale: Magnitude | None = None
    force_scale: Magnitude | None = None
    loops: Switch = False
    convention: Convention = "chinese"
    language: Language = "en"
    tools: Tools = key(name="instrument", default=Tools())
    background: Background | None = None

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the paper (mm, ISO 216)."""
        short, long = PAPERS[self.paper]
        return (long, short) if self.orientation == "landscape" else (short, long)


@file_table
class Vary(FileTable):
    """The rules by which a set of problems is drawn from a scene."""

    ranges: dict[str, Range] = field(default_factory=dict)
    only: Switch = False
    keep: Keys = ()
    ratios: List[Keys] = ()
    find: Symbols = ()
    ask: Asked | None = None
    level: Level = "usual"
    crossing: Least | None = None
    transmission: Least | None = None
    pressure: Least | None = None
    tolerance: Part | None = None


# the whole file


@file_table_by_name
class SceneTables(FileTable):
    """The whole file: a mechanism at one position, and its question."""

    title: Text = ""
    title_zh: Text = ""
    source: Text = ""
    source_zh: Text = ""
    find: Symbols | None = None
    units: Units = Units()
    frame: Frame = field(default_factory=Frame)
    links: Annotated[dict[LinkName, Link], Rule(min_length=1)] = key(closed=True)
    pins: dict[PointName, Pin] = named()
    contacts: dict[PointName, Contact] = named()
    gears: dict[LinkName, Gear] = named()
    driver: Drivers = ()
    sketch: dict[PointName, Place] = named("length")
    drawn: dict[PointName, Place] = named("length")
    printed: dict[str, Stated] = field(default_factory=dict)
    printed_rows: tuple[dict[str, Stated], ...] = ()
    printed_table: PrintedTable | None = None
    scans: dict[Diagram, ReadScan] = field(default_factory=dict)
    positions: Positions | None = None
    loops: dict[LinkName, PointNames] = named()
    cams: dict[LinkName, Cam] = named()
    gravity: Gravity | None = None
    masses: dict[LinkName, Mass] = named()
    loads: dict[LinkName, Load] = named()
    springs: dict[LinkName, Spring] = named()
    balance: Balance | None = None
    flywheel: Flywheel | None = None
    vary: Vary | None = None
    grading: dict[str, NotNegative] = field(default_factory=dict)
    sheet: SheetWishes = SheetWishes()


SCENE = Form(SceneTables, "graphkin scene", needed="links")
"""What may stand in a scene file."""
