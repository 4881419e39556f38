"""A photograph or scan under the mechanism: its file, and where it lies by two points that it shares with the scene."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path

from graphkin.errors import Problem, did_you_mean
from graphkin.files import opened
from graphkin.scene.sheet_tables import Background, ReadScan
from graphkin.words import Phrase, from_others

__all__ = ["PlacedBackground", "PlacedScan", "background_of", "scans_of"]

LARGEST, MOST_PIXELS = 10_000_000, 50_000_000
KINDS = {"PNG": "image/png", "JPEG": "image/jpeg"}


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


def scans_of(tables: Mapping[str, ReadScan], problems: list[Problem]) -> tuple[PlacedScan, ...]:
    """The scans of a file; what is wrong with them is added to ``problems``."""
    made = []
    for diagram, table in tables.items():
        where, before = f"scans.{diagram}", len(problems)
        points, read = ({n: complex(x, -y) for n, (x, y) in own.items()} for own in (table.points, table.read))
        if len(points) != 2 or len(set(points.values())) < len(points):
            hint = Phrase("two ends at two places set scale and")
            problems.append(Problem(f"{where}.points", Phrase("found value", value=len(points)), hint))
        for name in sorted(set(points) & set(read)):
            problems.append(
                Problem(f"{where}.read.{name}", Phrase("stands in points too"), Phrase("leave one of them out"))
            )
        if not read:
            problems.append(Problem(f"{where}.read", Phrase("is empty"), Phrase("write the ends that were read c 812")))
        found = _picture(f"{where}.file", table.file) if table.file is not None else ("", 0, 0, b"")
        if isinstance(found, Problem):
            problems.append(found)
        elif len(problems) == before:
            made.append(PlacedScan(diagram, points, read, table.within, *found))
    return tuple(made)


def background_of(
    table: Background, fixed: Mapping[str, complex], drawn: Mapping[str, complex], problems: list[Problem]
) -> PlacedBackground | None:
    """The picture that a file asks for, laid by two points whose places (m) it gives; None where something is wrong."""
    where = "sheet.background"
    found = _picture(f"{where}.file", table.file)
    known = {**drawn, **fixed}
    wrong = [found] if isinstance(found, Problem) else []
    if len(table.points) != 2:
        hint = Phrase("two points whose pixels are known set scale")
        wrong.append(Problem(f"{where}.points", Phrase("found value", value=len(table.points)), hint))
    for point in table.points:
        if point not in known:
            hint = Phrase("write a point of the frame or of", hint=did_you_mean(point, known))
            wrong.append(Problem(f"{where}.points.{point}", Phrase("is no point that stays where the picture"), hint))
    if not wrong:
        (p, q), (one, other) = table.points, (complex(x, -y) for x, y in table.points.values())
        if one == other or known[p] == known[q]:
            wrong.append(
                Problem(
                    f"{where}.points",
                    Phrase("and lie at the same place", point=p, other=q),
                    Phrase("name two points apart"),
                )
            )
    problems += wrong
    if wrong or isinstance(found, Problem):
        return None
    step = (known[q] - known[p]) / (other - one)
    kind, width, height, data = found
    return PlacedBackground(Path(table.file).name, kind, width, height, known[p] - step * one, step, data)


def _picture(where: str, file: str) -> tuple[str, int, int, bytes] | Problem:
    """Media type, width and height in pixels, and the bytes of a picture that can be read."""
    from PIL import Image, UnidentifiedImageError

    shown = ascii(file)[1:-1][-80:] if not file.isprintable() else file[-80:]
    try:
        with opened(file) as stream:
            data = stream.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        return Problem(
            where,
            Phrase("cannot be read of shown and reason", shown=shown, reason=from_others(reason)),
            Phrase("name a png or jpeg beside the scene"),
        )
    if len(data) > LARGEST:
        return Problem(
            where,
            Phrase("is larger than mb of shown and largest", shown=shown, largest=LARGEST // 1_000_000),
            Phrase("save it smaller"),
        )
    hint = Phrase("a png or jpeg is wanted")
    try:
        with warnings.catch_warnings(), Image.open(BytesIO(data), formats=list(KINDS)) as image:
            warnings.simplefilter("ignore")
            if image.width * image.height > MOST_PIXELS:
                found = Phrase("has so many pixels", name=shown, width=image.width, height=image.height)
                return Problem(where, found, Phrase("at most million are possible", most=MOST_PIXELS // 1_000_000))
            if image.getexif().get(0x0112, 1) != 1:
                return Problem(
                    where, Phrase("is stored turned and only a note in", shown=shown), Phrase("save it upright")
                )
            image.load()
            return KINDS[str(image.format)], image.width, image.height, data
    except Image.DecompressionBombError:
        return Problem(
            where,
            Phrase("has too many pixels", shown=shown),
            Phrase("million are possible", most=MOST_PIXELS // 1_000_000),
        )
    except (OSError, SyntaxError, ValueError, EOFError) as error:
        key = (
            "is no picture that can be read"
            if isinstance(error, UnidentifiedImageError)
            else "is damaged"
        )
        return Problem(where, Phrase(key, name=shown), hint)
