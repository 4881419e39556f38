"""The cams of a scene file: what is wrong with them, and what they say, in SI units."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from graphkin.errors import Problem
from graphkin.plane import cross, dot
from graphkin.scene.cams import LAWS, FollowerLaw, LawCam, LiftPiece, SlidingFollower, SwingingFollower, form_of
from graphkin.scene.contact_tables import Cam, LawPiece
from graphkin.scene.names import Flaws, Names
from graphkin.scene.tables import SceneTables
from graphkin.words import Phrase, Wording

__all__ = ["cams_of"]

AGREES = 1e-6


def cams_of(
    file: SceneTables, names: Names, flaws: Flaws, lines: Mapping[str, tuple[str, complex, complex]],
    places: Mapping[str, complex], drawn: Mapping[str, complex], problems: list[Problem],
) -> tuple[LawCam, ...]:  # fmt: skip
    """The cams of a file; what is wrong with them is added to ``problems``.

    Parameters
    ----------
    lines : for each link that slides on the frame its pair, and a point (m) and the sense of the guide
    places : points of the frame (m)
    drawn : roughly where points of moving links lie (m)
    """
    reading = _CamReading(file, names, flaws, lines, places, drawn, problems)
    moved: dict[str, str] = {}
    found = []
    for name, table in file.cams.items():
        other = moved.setdefault(table.follower, name)
        if other != name:
            reading.say(
                f"cams.{name}.follower",
                Phrase("link is moved by cam already", follower=table.follower, other=other),
                Phrase("a follower has one cam"),
            )
        one = reading.cam(name, table)
        if one is not None:
            found.append(one)
    return tuple(found)


@dataclass(frozen=True)
class _CamReading:
    """What the cams of a file are read from, and the problems found on the way."""

    file: SceneTables
    names: Names
    flaws: Flaws
    lines: Mapping[str, tuple[str, complex, complex]]
    places: Mapping[str, complex]
    drawn: Mapping[str, complex]
    problems: list[Problem]

    def say(self, where: str, found: Wording, wanted: Wording) -> None:
        self.problems.append(Problem(where, found, wanted))

    def cam(self, name: str, table: Cam) -> LawCam | None:
        where, metres, before = f"cams.{name}", self.file.units.metres, len(self.problems)
        point = self._axis(where, name)
        swings = self._swings(where, name, table)
        law = self._law(where, table.law, metres if not swings else math.pi / 180)
        roller = (table.roller or 0.0) * metres
        base = table.base.r * metres + (roller if table.base.of == "profile" else 0.0)
        if table.flat and table.roller is not None:
            self.say(f"{where}.flat", Phrase("stands beside roller"), Phrase("the face is flat or it has a"))
        if not table.flat and base <= roller:
            self.say(
                f"{where}.base.r",
                Phrase("found with a roller of", r=f"{table.base.r:g}", roller=f"{table.roller:g}"),
                Phrase("the base circle of the pitch curve is"),
            )
        allowed = self._allowed(where, table)
        motion: SlidingFollower | SwingingFollower | None = None
        if point and swings is not None and len(self.problems) == before:
            axis = self.places[point]
            motion = self._swinging(where, table, axis) if swings else self._sliding(where, table, axis)
        if motion is None or law is None or len(self.problems) > before:
            return None
        return LawCam(
            name, table.follower, point, self.places[point], law, table.sense, base, roller, table.flat, motion, allowed
        )

    def _axis(self, where: str, name: str) -> str:
        """The point of the frame about which the cam turns; "" where there is none."""
        missing = self.names.no_link(where, name, moving=True)
        if missing or name == self.names.frame:
            self.problems.append(
                missing or Problem(where, Phrase("link is the frame", name=name), Phrase("a cam turns"))
            )
            return ""
        link = self.file.links.get(name)
        if link is None or self.flaws.under("links", name):
            return ""
        if not link.points or link.points[0] not in self.places:
            if not self.flaws.under("frame"):
                own = (
                    Phrase("is no point of the frame", points=link.points[0])
                    if link.points
                    else Phrase("link has no point", name=name)
                )
                self.say(where, own, Phrase("a cam turns about its first point which"))
            return ""
        return link.points[0]

    def _swings(self, where: str, name: str, table: Cam) -> bool | None:
        """Whether the follower swings; None where it neither swings nor slides on the frame."""
        where, follower = f"{where}.follower", table.follower
        missing = self.names.no_link(where, follower, moving=True)
        if missing:
            self.problems.append(missing)
            return None
        if follower in (name, self.names.frame):
            self.say(
                where,
                Phrase("the cam itself") if follower == name else Phrase("link is the frame", name=follower),
                Phrase("name the link that the cam moves"),
            )
            return None
        if follower in self.lines:
            return False
        link = self.file.links.get(follower)
        if link is None or self.flaws.under("links", follower) or self.flaws.under("frame"):
            return None
        pivots = [p for p in link.points if p in self.places]
        if len(pivots) != 1 or link.on is not None:
            self.say(where, Phrase("link neither slides on a guide of the", follower=follower),
                     Phrase("write on guide or points with a pivot", frame=self.names.frame))  # fmt: skip
            return None
        if len(link.points) != 2:
            self.say(where, Phrase("link has no point but its pivot", follower=follower),
                     Phrase("it is a bar from its pivot to"))  # fmt: skip
            return None
        for key in ("offset", "flat"):
            if getattr(table, key) not in (None, False):
                kind = Phrase("an offset") if key == "offset" else Phrase("a flat face")
                own = where.removesuffix(".follower")
                self.say(
                    f"{own}.{key}", Phrase("link swings", name=follower), Phrase("is for a sliding follower", kind=kind)
                )
        return True

    def _law(self, where: str, pieces: Sequence[LawPiece], unit: float) -> FollowerLaw | None:
        """The law in rad and m, or rad of a follower that swings."""
        found: list[LiftPiece] = []
        start = low = most = 0.0
        good = True

        def wrong(i: int, said: Wording, wanted: Wording) -> None:
            nonlocal good
            good = False
            self.say(f"{where}.law.{i}", said, wanted)

        names = [f'"{name}"' for name in LAWS]
        for i, piece in enumerate(pieces, 1):
            rise = (piece.rise or 0.0) - (piece.fall or 0.0)
            if piece.rise is not None and piece.fall is not None:
                wrong(i, Phrase("has both rise and fall"), Phrase("give one of them or none for a"))
            elif piece.rise is not None or piece.fall is not None:
                key = "rise" if piece.rise is not None else "fall"
                if not getattr(piece, key) > 0.0:
                    wrong(i, f"{key} = {getattr(piece, key):g}", Phrase("it must be positive a dwell has neither"))
                if piece.by is None:
                    wrong(i, Phrase("does not say its law"), f"by = {', '.join(names[:-1])} or {names[-1]}")
            elif piece.by is not None:
                wrong(i, Phrase("has by without rise or fall", by=piece.by), Phrase("a dwell has no law"))
            if not piece.to > start:
                wrong(
                    i,
                    Phrase("ends at deg where it begins at", to=f"{piece.to:g}", start=f"{start:g}"),
                    Phrase("degrees grow from 0 to 360"),
                )
            elif piece.to > 360.0:
                wrong(i, Phrase("ends at deg", start=f'{piece.to:g}'), Phrase("the law ends at 360"))
            high = low + rise
            most = max(most, abs(high), abs(low))
            if abs(high) < 1e-9 * most:
                high = 0.0
            ends = math.radians(start), math.radians(piece.to)
            found.append(LiftPiece(*ends, low * unit, high * unit, form_of(piece.by)))
            start, low = piece.to, high
        if not pieces:
            self.say(f"{where}.law", Phrase("is empty"), Phrase("write to 60 rise 28 by harmonic"))
            return None
        if good and start != 360.0:
            wrong(len(pieces), Phrase("ends at deg", start=f'{start:g}'), Phrase("the last piece ends at 360"))
        if good and low != 0.0:
            way = "up" if low > 0 else "down"
            self.say(f"{where}.law", Phrase("does not come back a turn leaves the", least=f'{abs(low):.9g}', way=way),
                     Phrase("all that rises falls again"))  # fmt: skip
            return None
        return FollowerLaw(tuple(found)) if good else None

    def _allowed(self, where: str, table: Cam) -> tuple[float | None, float | None]:
        found: list[float | None] = []
        for key in ("rise", "fall"):
            value = getattr(table.allow, key) if table.allow else None
            if value is not None and not 0.0 < value < 90.0:
                self.say(
                    f"{where}.allow.{key}",
                    Phrase("found value", value=f"{value:g}"),
                    Phrase("a pressure angle lies between 0 and 90"),
                )
            found.append(None if value is None else math.radians(value))
        return found[0], found[1]

    def _sliding(self, where: str, table: Cam, axis: complex) -> SlidingFollower | None:
        pair, through, along = self.lines[table.follower]
        offset = cross(along, axis - through)
        metres = self.file.units.metres
        size = max(abs(axis - through), table.base.r * metres)
        if table.offset is not None and abs(table.offset * metres - offset) > AGREES * size:
            self.say(
                f"{where}.offset",
                Phrase("found but the guide makes it", offset=f"{table.offset:g}", other=f"{offset / metres:.9g}"),
                Phrase("one is wrong positive where the axis is"),
            )
            return None
        travel = dot(along, axis - through)
        return SlidingFollower(pair, through + along * travel, along, travel, offset)

    def _swinging(self, where: str, table: Cam, axis: complex) -> SwingingFollower | None:
        link = self.file.links[table.follower]
        first, second = link.points
        pivot, tip = (first, second) if first in self.places else (second, first)
        centre = self.places[pivot]
        if centre == axis:
            self.say(
                f"{where}.follower",
                Phrase("swings about the cam's own axis", pivot=pivot),
                Phrase("its pivot lies elsewhere"),
            )
            return None
        if link.length is None:
            self.say(
                f"links.{table.follower}.length",
                Phrase("is missing"),
                Phrase("the length of a swinging follower is written"),
            )
            return None
        side = 1
        if tip in self.drawn:
            side = 1 if cross(axis - centre, self.drawn[tip] - centre) >= 0.0 else -1
        arm = link.length * self.file.units.metres
        return SwingingFollower(pivot, tip, centre, arm, side, pivot == second)
