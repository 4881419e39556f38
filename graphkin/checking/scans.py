"""Somebody's drawings, judged line by line by the readings from their scans.

Two right ends lay the scan on the exact figure; every line between two read ends is compared with the exact line by
size and direction.  The wrong line is the first, in the order of construction, whose known size or direction is not
kept: the others follow from it.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import combinations

from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import DiagramName
from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.files import Json
from graphkin.scene.model import PlacedPicture
from graphkin.scene.scene_tables import ReadScan
from graphkin.words import Phrase, say, word

POLE = "pole"
SAME = 1e-9
"""Of the largest vector: two ends as near lie at one place."""


@dataclass(frozen=True, eq=False, repr=False)
class ReadLine:
    """A read line beside the exact one, in mm on the paper of the sheet, y up.

    ``tail`` and ``tip`` are the read ends.  ``known`` tells of size and direction whether the construction knows them
    before the line is drawn.
    """

    name: str
    exact: complex
    tail: complex
    tip: complex
    known: tuple[bool, bool]
    room: float

    @property
    def read(self) -> complex:
        return self.tip - self.tail

    @property
    def ok(self) -> bool:
        """Whether it agrees with the exact line."""
        return abs(self.read - self.exact) <= self.room

    @property
    def longer(self) -> float:
        """Its excess of length (mm)."""
        return abs(self.read) - abs(self.exact)

    @property
    def turned(self) -> float:
        """Its angle from the exact line (rad), counter-clockwise; 0 where either has no length."""
        return cmath.phase(self.read / self.exact) if self.exact and self.read else 0.0

    @property
    def breaks_a_rule(self) -> bool:
        """Whether a size or a direction known beforehand is wrong."""
        size, direction = self.known
        off_line = abs(self.exact) * (1.0 if abs(self.turned) > math.pi / 2 else math.sin(abs(self.turned)))
        return (size and abs(self.longer) > self.room) or (direction and off_line > self.room)

    @property
    def said(self) -> Phrase:
        """Its error in words."""
        percent = f"{100 * self.longer / abs(self.exact):+.1f} %" if self.exact else f"{self.longer:+.2f} mm"
        angle = f"{math.degrees(self.turned):+.1f}°"
        if self.ok:
            return Phrase("line right")
        if abs(self.turned) > math.radians(170):
            return Phrase("line reversed")
        length = abs(self.longer) > self.room / 2
        direction = abs(self.exact) * abs(math.sin(self.turned)) > self.room / 2
        if length and direction:
            return Phrase("line both", length=percent, angle=angle)
        return Phrase("line turned", angle=angle) if direction else Phrase("line long", length=percent)


@dataclass(frozen=True, eq=False, repr=False)
class JudgedScan:
    """A scan laid on the exact figure (mm, y up), with its picture, if there is one."""

    diagram: DiagramName
    lines: tuple[ReadLine, ...]
    picture: PlacedPicture | None

    @property
    def ok(self) -> bool:
        return all(line.ok for line in self.lines)

    @property
    def off(self) -> ReadLine | None:
        """The wrong line from which the others follow; None where all are right."""
        wrong = [line for line in self.lines if not line.ok]
        return next((line for line in wrong if line.breaks_a_rule), wrong[0] if wrong else None)

    @property
    def data(self) -> dict[str, Json]:
        """Plain data: lengths in mm, angles in degrees."""
        lines: list[dict[str, Json]] = [
            {
                "line": line.name, "on_paper_mm": abs(line.read), "exact_mm": abs(line.exact),
                "turned_deg": math.degrees(line.turned), "ok": line.ok, "said": say(line.said, "en"),
            }
            for line in self.lines
        ]
        return {"ok": self.ok, "off": self.off.name if self.off else None, "lines": lines}

    def sentences(self, language: str) -> list[str]:
        """The sentences on it: a head, one on each line, and the result."""
        end = Phrase("scan right") if self.off is None else Phrase("scan off", line=self.off.name, slip=self.off.said)
        lines = [f"  {line.name}: {say(line.said, language)}" for line in self.lines]
        head = f"{word(f'scan of {self.diagram}', language)}{word('colon', language)}"
        return [head, *lines, f"  {say(end, language)}"]


def judge_scans(sheet: Sheet, diagram: DiagramName | None = None) -> tuple[JudgedScan, ...]:
    """All scans of a scene, or those of a figure, compared with its sheet.

    Raises
    ------
    CallError : an end that the figure does not have; two ends at the same place; no line between the read ends
    """
    scans = sheet.scene.question.scans.items()
    return tuple(_judged(sheet, of, *scan) for of, scan in scans if diagram in (None, of))  # type: ignore[arg-type]


def _judged(sheet: Sheet, diagram: DiagramName, scan: ReadScan, picture: PlacedPicture | None) -> JudgedScan:
    ends, where = _ends(sheet, diagram), f"scans.{diagram}"
    pixels = {name: complex(x, -y) for name, (x, y) in (*scan.points.items(), *scan.read.items())}
    unknown = [n for n in pixels if n not in ends]
    if unknown:
        raise CallError(
            *(Problem(f"{where}.{n}", Phrase("is no end of this figure"), did_you_mean(n, ends)) for n in unknown)
        )
    p, q = scan.points
    largest = max(abs(a - b) for a, b in combinations(ends.values(), 2))
    if abs(ends[p] - ends[q]) <= SAME * largest:
        raise CallError.of(f"{where}.points", "and lie at one place", "name two ends apart", point=p, other=q)
    step = (ends[q] - ends[p]) / (pixels[q] - pixels[p])
    corner = ends[p] - step * pixels[p]
    places = {name: corner + step * pixel for name, pixel in pixels.items()}
    lines = tuple(_lines(sheet, diagram, ends, places, scan.within))
    if not lines:
        raise CallError.of(where, "no line goes from one of these ends", "read both ends of a line")
    return JudgedScan(diagram, lines, picture and replace(picture, corner=corner, step=step))


def _ends(sheet: Sheet, diagram: DiagramName) -> dict[str, complex]:
    """The ends of the lines of a figure by their names (mm, y up)."""
    if diagram == "mechanism":
        return {str(ref): z for ref, z in sheet.points.items() if not ref.link}
    ends = {POLE: 0j, **{str(ref): z for ref, z in sheet.ends[diagram].items()}}
    return ends | {str(s): v.tip for s, v in sheet.vectors[diagram].items() if s.kind not in ("v", "a")}


def _lines(
    sheet: Sheet, diagram: DiagramName, ends: Mapping[str, complex], places: Mapping[str, complex], within: float
) -> Iterator[ReadLine]:
    """The lines between read ends, in the order of construction."""
    if diagram == "mechanism":
        largest = max(abs(a - b) for a, b in combinations(ends.values(), 2))
        for link in (sheet.scene.frame, *sheet.scene.links):
            for a, b in combinations([p for p in link.points if p in places], 2):
                if abs(ends[b] - ends[a]) > SAME * largest:
                    known = (True, link.name == sheet.scene.frame.name)
                    yield ReadLine(f"{a}{b}", ends[b] - ends[a], places[a], places[b], known, within * largest)
        return
    vectors = sheet.vectors[diagram]
    largest = max((abs(v.span) for v in vectors.values()), default=0.0)
    known_of = {t.symbol: (t.size_known, t.direction_known)
                for e in sheet.equations if e.diagram == diagram for side in e.sides for t in side}
    drawn = sorted(vectors.values(), key=lambda v: known_of.get(v.symbol, (False, False)) == (False, False))
    for vector in drawn:
        tail, tip = (next((name for name in places if abs(ends[name] - end) <= SAME * largest), "")
                     for end in (vector.tail, vector.tip))
        if tail and tip and abs(vector.span) > SAME * largest:
            known = known_of.get(vector.symbol, (False, False))
            yield ReadLine(str(vector.symbol), vector.span, places[tail], places[tip], known, within * largest)
