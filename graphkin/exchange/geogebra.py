"""GeoGebra constructions (.ggb) that are linkages: free points are the frame, a point on a circle is a crank's end,
crossings of circles and lines are joints, segments say which points belong together.

A file is a ZIP archive with ``geogebra.xml``: elements with their coordinates (homogeneous), commands with inputs and
outputs.  Each kept distance is a bar; three points with all their distances kept are one plate.
"""

from __future__ import annotations

import cmath
import re
import zlib
from io import BytesIO
from xml.etree import ElementTree
from zipfile import BadZipFile, ZipFile

from graphkin.errors import CallError, Problem
from graphkin.exchange.bodies import FRAME, Bodies, BodyDrive, BodySlide
from graphkin.words import Phrase

__all__ = ["read_geogebra"]

INPUT_SPEED = 1.0
"""rad/s: a construction says no speed."""
LARGEST = 20_000_000
DAMAGED = (BadZipFile, LookupError, ElementTree.ParseError, OSError, ValueError, RuntimeError, EOFError, zlib.error)


def read_geogebra(data: bytes, title: str) -> Bodies:
    """The bodies of a construction.  Raises CallError where it is none."""
    try:
        with ZipFile(BytesIO(data)) as archive:
            entry = archive.getinfo("geogebra.xml")
            if entry.file_size > LARGEST:
                raise CallError(
                    Problem(title, Phrase("is too large to be a linkage"), Phrase("save the construction alone"))
                )
            construction = _Construction(title, ElementTree.fromstring(archive.read(entry)))
    except DAMAGED as error:
        raise CallError(
            Problem(title, Phrase("is no file of geogebra", error=error), Phrase("save it as ggb"))
        ) from None
    return construction.bodies()


class _Construction:
    """What the commands of a construction make of its points."""

    def __init__(self, title: str, root: ElementTree.Element) -> None:
        self.made = Bodies(title)
        construction = root.find("construction")
        self.elements = {e.get("label", ""): e for e in (construction if construction is not None else ())
                         if e.tag == "element"}  # fmt: skip
        self.commands = [c for c in (construction if construction is not None else ()) if c.tag == "command"]
        self.circles: dict[str, str] = {}  # by its name the centre
        self.lines: dict[str, tuple[str, str]] = {}  # by its name two points
        self.bars: list[list[str]] = []
        self.moving: set[str] = set()
        self.points: dict[str, str] = {}
        self.slid: list[tuple[str, str]] = []  # a point, and the line it runs on
        self.driven: list[tuple[str, str]] = []  # pivot and end of a crank
        for label, element in self.elements.items():
            if element.get("type") == "point":
                self.points[label] = self.made.point(label, _place(element))

    def bodies(self) -> Bodies:
        """All of it."""
        for command in self.commands:
            given, got = (_arguments(command, tag) for tag in ("input", "output"))
            self._command(command.get("name", ""), given, got)
        used = {p for bar in self.bars for p in bar} | {p for line in self.lines.values() for p in line}
        frame = [p for p in self.points if p not in self.moving and p in used]
        for label in [p for p in self.points if p not in used]:
            self.made.left.append(f"point {label} (nothing holds it)")
            del self.made.places[self.points[label]]
        self.made.body(FRAME, [self.points[p] for p in frame])
        for bar in self._plates():
            if not set(bar) <= set(frame):
                self.made.body("".join(bar), [self.points[p] for p in bar])
        holders = self.made.bodies
        for point, line in self.slid:
            one, two = (self.made.places[self.points[p]] for p in self.lines[line])
            ends = {self.points[p] for p in self.lines[line]}
            on = next((n for n, own in holders.items() if ends <= set(own)), None)
            body = next((n for n, own in holders.items() if n != on and self.points[point] in own), None)
            if on is None or body is None:
                self.made.lost.append(f"point {point} on {line} (no link has that line)")
            else:
                self.made.slides.append(
                    BodySlide(body, self.points[point], on, one, cmath.phase(two - one), turns=True)
                )
        for pivot, end in self.driven:
            ends = {self.points[pivot], self.points[end]}
            crank = next((n for n, own in holders.items() if n != FRAME and ends <= set(own)), None)
            if crank is not None:
                self.made.drives.append(BodyDrive(crank, INPUT_SPEED))
        return self.made

    def _command(self, name: str, given: list[str], got: list[str]) -> None:
        out = got[0] if got else ""
        if name == "Circle" and len(given) == 2 and given[0] in self.points:
            self.circles[out] = given[0]
        elif name in ("Segment", "Line", "Ray") and len(given) == 2 and set(given) <= set(self.points):
            self.lines[out] = (given[0], given[1])
            if name == "Segment":
                self.bars.append(list(given))
        elif name == "Polygon" and len(got) > 1:
            ends = [p for p in given if p in self.points]
            self.bars += [[a, b] for a, b in zip(ends, [*ends[1:], *ends[:1]], strict=True)]
            self.bars.append(ends)
        elif name == "Point" and given and out in self.points and given[0] in self.circles:
            self.moving.add(out)
            self.bars.append([self.circles[given[0]], out])
            self.driven.append((self.circles[given[0]], out))
        elif name == "Point" and given and out in self.points and given[0] in self.lines:
            self.moving.add(out)
            self.slid.append((out, given[0]))
        elif name == "Intersect" and len(given) > 1:
            for point in (p for p in got if p in self.points):
                self.moving.add(point)
                for curve in given[:2]:
                    if curve in self.circles:
                        self.bars.append([self.circles[curve], point])
                    elif curve in self.lines:
                        self.slid.append((point, curve))
                    else:
                        self.made.lost.append(f"curve {curve} through {point}")
        elif name == "Midpoint" and len(given) == 2 and set(given) <= set(self.points) and out in self.points:
            self.moving.add(out)
            self.bars += [[*given, out]]
        elif name not in ("Slider", "Locus", "Distance", "Angle", "Length", "Text"):
            made = {p for p in got if p in self.points}
            (self.made.lost if made else self.made.left).append(f"{name} {', '.join(filter(None, got))}")
            self.moving |= made

    def _plates(self) -> list[list[str]]:
        """Bars that share two points are one body; three bars that close a triangle of moving points too."""
        bodies = [list(dict.fromkeys(bar)) for bar in self.bars]
        changed = True
        while changed:
            changed = False
            for i, one in enumerate(bodies):
                for k in range(len(bodies) - 1, i, -1):
                    if len(set(one) & set(bodies[k])) > 1:
                        one += [p for p in bodies.pop(k) if p not in one]
                        changed = True
            triangle = next((t for t in _triangles(bodies) if any(p in self.moving for p in set().union(*t))), None)
            if triangle is not None and len({p for t in triangle for p in t} & self.moving) > 1:
                whole = list(dict.fromkeys(p for t in triangle for p in t))
                bodies = [b for b in bodies if b not in triangle] + [whole]
                changed = True
        return bodies


def _triangles(bodies: list[list[str]]) -> list[tuple[list[str], list[str], list[str]]]:
    found = []
    for i, a in enumerate(bodies):
        for j in range(i + 1, len(bodies)):
            ab = set(a) & set(bodies[j])
            for c in bodies[j + 1 :]:
                ac, bc = set(a) & set(c), set(bodies[j]) & set(c)
                if len(ab) == len(ac) == len(bc) == 1 and len(ab | ac | bc) == 3:
                    found.append((a, bodies[j], c))
    return found


def _arguments(command: ElementTree.Element, tag: str) -> list[str]:
    """The inputs or the outputs of a command, a0, a1, ..., in their order."""
    found = command.find(tag)
    given = found.attrib if found is not None else {}
    return [given[key] for key in sorted(given, key=lambda key: int(re.sub(r"\D", "", key) or 0))]


def _place(element: ElementTree.Element) -> complex:
    coords = element.find("coords")
    given = coords.attrib if coords is not None else {}
    z = float(given.get("z", 1)) or 1.0
    return complex(float(given.get("x", 0)) / z, float(given.get("y", 0)) / z)
