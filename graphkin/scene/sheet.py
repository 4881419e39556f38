"""The tables of a scene file that wish something of the papers: the drawn sheet with its scales, letters and tools, a
picture below it, scans of drawings to be judged, and how a set of problems varies for a class."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field as Rule
from pydantic import StringConstraints

from graphkin.errors import Problem, did_you_mean
from graphkin.files import opened
from graphkin.scene.bodies import Reading
from graphkin.scene.tables import (
    Asked,
    FileTable,
    Language,
    Least,
    List,
    Magnitude,
    Number,
    Part,
    Place,
    PointName,
    Symbols,
    Text,
    Tool,
    file_table,
    key,
)
from graphkin.words import Phrase, from_others

__all__ = [
    "PAPERS", "Background", "Convention", "Drawing", "Level", "PlacedBackground", "PlacedScan", "ReadScan",
    "SheetWishes", "Tools", "Vary", "background_of", "scans_of",
]  # fmt: skip

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
LARGEST, MOST_PIXELS = 10_000_000, 50_000_000
KINDS = {"PNG": "image/png", "JPEG": "image/jpeg"}
TURNED = 0x0112
"""The note in a picture that says how it is turned; 1 where it is upright."""


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
    file: Text | None = key(
        "The scan itself, under the exact figure: PNG or JPEG, from the scene file.", default=None
    )
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
    crossing: Least | None = key(
        "Degrees at which lines cross at least; that of the level if left out.", default=None
    )
    transmission: Least | None = key(
        "Least transmission angle of two bars at the position, degrees.", default=None
    )
    pressure: Least | None = key("Greatest pressure angle of a slide at the position, degrees.", default=None)
    tolerance: Part | None = key(
        "Part of an answer that a drawing may miss it by at most; 0.05 if left out.", default=None
    )


@dataclass(frozen=True)
class PlacedBackground:
    """A picture under the mechanism: the pixel x to the right and y down from its left upper corner lies at
    ``corner + step (x - iy)`` (m, world axes).  ``data`` is the file as it is, of the media type ``kind``."""

    name: str
    kind: str
    width: int
    height: int
    corner: complex
    step: complex
    data: bytes = field(repr=False)


@dataclass(frozen=True)
class PlacedScan:
    """What was read off the scan of a drawing, in pixels x - iy from its left upper corner, by the names of ends.

    ``points`` are the two that set scale and direction; ``within`` is what a line may be off, as a part of the longest.
    ``kind``, ``width``, ``height`` and ``data`` are those of the picture, "" and 0 where there is none.
    """

    diagram: str
    points: Mapping[str, complex]
    read: Mapping[str, complex]
    within: float
    kind: str = ""
    width: int = 0
    height: int = 0
    data: bytes = field(default=b"", repr=False)


def scans_of(tables: Mapping[Drawing, ReadScan], reading: Reading) -> tuple[PlacedScan, ...]:
    """The scans of a file; what is wrong with them is noted."""
    made = []
    for diagram, scan in tables.items():
        where, before = f"scans.{diagram}", len(reading.problems)
        points, read = ({n: complex(x, -y) for n, (x, y) in ends.items()} for ends in (scan.points, scan.read))
        if len(points) != 2 or len(set(points.values())) < len(points):
            hint = Phrase("two ends at two places set scale and")
            reading.say(f"{where}.points", Phrase("found value", value=len(points)), hint)
        for name in sorted(set(points) & set(read)):
            reading.say(f"{where}.read.{name}", Phrase("stands in points too"), Phrase("leave one of them out"))
        if not read:
            reading.say(f"{where}.read", Phrase("is empty"), Phrase("write the ends that were read c 812"))
        picture = _picture(f"{where}.file", scan.file) if scan.file is not None else ("", 0, 0, b"")
        if isinstance(picture, Problem):
            reading.wrong(picture)
        elif len(reading.problems) == before:
            made.append(PlacedScan(diagram, points, read, scan.within, *picture))
    return tuple(made)


def background_of(
    wish: Background, known: Mapping[str, complex], reading: Reading
) -> PlacedBackground | None:
    """The picture that a file asks for, laid by two points whose places (m) are known; None where something is wrong,
    which is noted."""
    where, before = "sheet.background", len(reading.problems)
    picture = _picture(f"{where}.file", wish.file)
    if isinstance(picture, Problem):
        reading.wrong(picture)
    if len(wish.points) != 2:
        hint = Phrase("two points whose pixels are known set scale")
        reading.say(f"{where}.points", Phrase("found value", value=len(wish.points)), hint)
    for point in wish.points:
        if point not in known:
            hint = Phrase("write a point of the frame or of", hint=did_you_mean(point, known))
            reading.say(f"{where}.points.{point}", Phrase("is no point that stays where the picture"), hint)
    if isinstance(picture, Problem) or len(reading.problems) > before:
        return None
    (p, q), (pixel, other) = wish.points, (complex(x, -y) for x, y in wish.points.values())
    if pixel == other or known[p] == known[q]:
        found = Phrase("and lie at the same place", point=p, other=q)
        reading.say(f"{where}.points", found, Phrase("name two points apart"))
        return None
    step = (known[q] - known[p]) / (other - pixel)
    kind, width, height, data = picture
    return PlacedBackground(Path(wish.file).name, kind, width, height, known[p] - step * pixel, step, data)


def _picture(where: str, file: str) -> tuple[str, int, int, bytes] | Problem:
    """Media type, width and height in pixels, and the bytes of a picture that can be read."""
    from PIL import Image, UnidentifiedImageError

    shown = ascii(file)[1:-1][-80:] if not file.isprintable() else file[-80:]
    try:
        with opened(file) as stream:
            data = stream.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        found = Phrase("cannot be read of shown and reason", shown=shown, reason=from_others(reason))
        return Problem(where, found, Phrase("name a png or jpeg beside the scene"))
    if len(data) > LARGEST:
        found = Phrase("is larger than mb of shown and largest", shown=shown, largest=LARGEST // 1_000_000)
        return Problem(where, found, Phrase("save it smaller"))
    try:
        with warnings.catch_warnings(), Image.open(BytesIO(data), formats=list(KINDS)) as image:
            warnings.simplefilter("ignore")
            if image.width * image.height > MOST_PIXELS:
                found = Phrase("has so many pixels", name=shown, width=image.width, height=image.height)
                return Problem(where, found, Phrase("at most million are possible", most=MOST_PIXELS // 1_000_000))
            if image.getexif().get(TURNED, 1) != 1:
                found = Phrase("is stored turned and only a note in", shown=shown)
                return Problem(where, found, Phrase("save it upright"))
            image.load()
            return KINDS[str(image.format)], image.width, image.height, data
    except Image.DecompressionBombError:
        found = Phrase("has too many pixels", shown=shown)
        return Problem(where, found, Phrase("million are possible", most=MOST_PIXELS // 1_000_000))
    except (OSError, SyntaxError, ValueError, EOFError) as error:
        key = "is no picture that can be read" if isinstance(error, UnidentifiedImageError) else "is damaged"
        return Problem(where, Phrase(key, name=shown), Phrase("a png or jpeg is wanted"))
