"""Pictures that a scene file names: a photograph or scan to lie under the mechanism, laid by two points, and scans of
drawings to be judged, with their readings.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import replace
from io import BytesIO
from pathlib import Path

from graphkin.errors import Problem, did_you_mean
from graphkin.files import opened
from graphkin.scene.bodies import Reading
from graphkin.scene.model import PlacedPicture
from graphkin.scene.scene_tables import Background, ReadScan
from graphkin.words import Phrase, from_others

LARGEST, MOST_PIXELS = 10_000_000, 50_000_000
KINDS = {"PNG": "image/png", "JPEG": "image/jpeg"}
TURNED = 0x0112
"""The note in a picture that says how it is turned; 1 where it is upright."""


def scans_of(reading: Reading) -> dict[str, tuple[ReadScan, PlacedPicture | None]]:
    """The scans of a file, each with its picture, if it has one; their problems are noted."""
    scans: dict[str, tuple[ReadScan, PlacedPicture | None]] = {}
    for diagram, scan in reading.file.scans.items():
        where, before = f"scans.{diagram}", len(reading.problems)
        if len(scan.points) != 2 or len({*map(tuple, scan.points.values())}) < 2:
            reading.say(f"{where}.points", "found value", "two ends at two places set scale and",
                        value=len(scan.points))
        for name in sorted(set(scan.points) & set(scan.read)):
            reading.say(f"{where}.read.{name}", "stands in points too", "leave one of them out")
        if not scan.read:
            reading.say(f"{where}.read", "is empty", "write the ends that were read c 812")
        picture = None if scan.file is None else _picture(f"{where}.file", scan.file)
        if isinstance(picture, Problem):
            reading.wrong(picture)
        elif len(reading.problems) == before:
            scans[diagram] = scan, picture
    return scans


def background_of(wish: Background, known: Mapping[str, complex], reading: Reading) -> PlacedPicture | None:
    """The picture of a file, laid by two points of known places (m); None where a problem is noted."""
    where, before = "sheet.background", len(reading.problems)
    picture = _picture(f"{where}.file", wish.file)
    if isinstance(picture, Problem):
        reading.wrong(picture)
    if len(wish.points) != 2:
        reading.say(f"{where}.points", "found value", "two points whose pixels are known set scale",
                    value=len(wish.points))
    for point in wish.points:
        if point not in known:
            reading.say(f"{where}.points.{point}", "is no point that stays where the picture",
                        "write a point of the frame or of", hint=did_you_mean(point, known))
    if isinstance(picture, Problem) or len(reading.problems) > before:
        return None
    (p, q), (pixel, other) = wish.points, (complex(x, -y) for x, y in wish.points.values())
    if pixel == other or known[p] == known[q]:
        reading.say(f"{where}.points", "and lie at the same place", "name two points apart", point=p, other=q)
        return None
    step = (known[q] - known[p]) / (other - pixel)
    return replace(picture, corner=known[p] - step * pixel, step=step)


def _picture(where: str, file: str) -> PlacedPicture | Problem:
    """A picture that can be read, in pixels."""
    from PIL import Image, UnidentifiedImageError

    shown = ascii(file)[1:-1][-80:] if not file.isprintable() else file[-80:]
    try:
        with opened(file) as stream:
            data = stream.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        return Problem(where, "cannot be read of shown and reason", "name a png or jpeg beside the scene", shown=shown,
                       reason=from_others(error))
    if len(data) > LARGEST:
        return Problem(where, "is larger than mb of shown and largest", "save it smaller", shown=shown,
                       largest=LARGEST // 1_000_000)
    try:
        with warnings.catch_warnings(), Image.open(BytesIO(data), formats=list(KINDS)) as image:
            warnings.simplefilter("ignore")
            if image.width * image.height > MOST_PIXELS:
                return Problem(where, "has so many pixels", "at most million are possible", name=shown,
                               width=image.width, height=image.height, most=MOST_PIXELS // 1_000_000)
            if image.getexif().get(TURNED, 1) != 1:
                return Problem(where, "is stored turned and only a note in", "save it upright", shown=shown)
            image.load()
            return PlacedPicture(Path(file).name, KINDS[str(image.format)], image.width, image.height, data)
    except Image.DecompressionBombError:
        return Problem(where, "has too many pixels", "million are possible", shown=shown, most=MOST_PIXELS // 1_000_000)
    except (OSError, SyntaxError, ValueError, EOFError) as error:
        key = "is no picture that can be read" if isinstance(error, UnidentifiedImageError) else "is damaged"
        return Problem(where, Phrase(key, name=shown), "a png or jpeg is wanted")
