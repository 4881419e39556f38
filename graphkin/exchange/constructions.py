"""Mechanisms constructed point by point, each from earlier ones: linkages in GeoGebra (.ggb), and the older
linkages of pylinkage.

- A file of GeoGebra is a ZIP archive with ``geogebra.xml``: elements with their coordinates (homogeneous), commands
  with inputs and outputs.  Free points are the frame, a point on a circle is a crank's end, one on a fixed line is
  pulled along it, crossings of circles and lines are joints, segments join the points of a body.
- A linkage of pylinkage has joints that refer to earlier ones: Static, Crank (distance, angle a step), Fixed
  (distance and angle from one, against the line to another), Revolute or Pivot (two distances), Linear (a distance from
  one, on the line of two others).

Each kept distance is a bar; bars that share two points, and three points with all their distances kept, are one plate.
"""

from __future__ import annotations

import cmath
import math
import re
import zlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from io import BytesIO
from itertools import combinations
from xml.etree import ElementTree
from zipfile import BadZipFile, ZipFile

from graphkin.errors import CallError
from graphkin.exchange.bodies import FRAME, Bodies
from graphkin.files import Tables
from graphkin.plane import cross_arcs
from graphkin.words import Phrase, Wording, from_others

STEP = math.tau / 360
"""rad: what a driver of pylinkage turns in a step, where nothing is said; a step is taken for a second."""
INPUT_SPEED = 1.0
"""rad/s, or units of length a second: a construction of GeoGebra says no speed."""
LARGEST = 20_000_000
DAMAGED = (BadZipFile, LookupError, ElementTree.ParseError, OSError, ValueError, RuntimeError, EOFError, zlib.error)


@dataclass
class _Construction:
    """Points, each constructed from others, with their bars and slides, all by the labels of the file.

    moving : points that move
    circles, lines : the centre of a circle, and two points of a line
    bars : pairs of points at a constant distance
    slid : a point, the two points of its line, and the sentence for a line that no link has
    driven : pivot and end of a crank, and its rate (rad/s); no pivot of a point that is pulled along a fixed line, and
        its speed
    """

    made: Bodies
    moving: set[str] = field(default_factory=set)
    circles: dict[str, str] = field(default_factory=dict)
    lines: dict[str, tuple[str, str]] = field(default_factory=dict)
    bars: list[list[str]] = field(default_factory=list)
    slid: list[tuple[str, tuple[str, str], Wording]] = field(default_factory=list)
    driven: list[tuple[str, str, float]] = field(default_factory=list)

    def bodies(self, frame: Sequence[str]) -> Bodies:
        """The bodies that the bars make with the frame, their slides, and the driver."""
        self.made.body(FRAME, frame)
        for bar in self._plates():
            if not set(bar) <= set(frame):
                self.made.body("".join(self.made.names[p] for p in bar)[:20], bar)
        for slid in self.slid:
            self.made.slide_on(*slid)
        for pivot, end, rate in self.driven:
            if pivot:
                self.made.turn((pivot, end), rate)
            for slide in (s for s in self.made.slides if not pivot and s.point == self.made.names[end]):
                self.made.drive(slide.body, rate, slide.point)
        return self.made

    def _plates(self) -> list[list[str]]:
        """The bodies of the bars: bars that share two points are one body, and three bars that close a triangle of
        moving points."""
        bodies = [list(dict.fromkeys(bar)) for bar in self.bars]
        changed = True
        while changed:
            changed = False
            for i, body in enumerate(bodies):
                for k in range(len(bodies) - 1, i, -1):
                    if len(set(body) & set(bodies[k])) > 1:
                        body += [p for p in bodies.pop(k) if p not in body]
                        changed = True
            for triangle in combinations(bodies, 3):
                whole = list(dict.fromkeys(p for bar in triangle for p in bar))
                if _closed(*triangle) and len(self.moving & set(whole)) > 1:
                    bodies = [bar for bar in bodies if bar not in triangle] + [whole]
                    changed = True
                    break
        return bodies


def _closed(a: list[str], b: list[str], c: list[str]) -> bool:
    """Whether three bars meet in three points."""
    shared = [set(bar) & set(other) for bar, other in ((a, b), (a, c), (b, c))]
    return all(len(points) == 1 for points in shared) and len(set().union(*shared)) == 3


# GeoGebra


def read_geogebra(data: bytes, title: str) -> Bodies:
    """The bodies of a construction.  Raises CallError for a file that is none."""
    try:
        with ZipFile(BytesIO(data)) as archive:
            entry = archive.getinfo("geogebra.xml")
            if entry.file_size > LARGEST:
                raise CallError.of(title, "is too large to be a linkage", "save the construction alone")
            root = ElementTree.fromstring(archive.read(entry)).find("construction")
            elements = list(root) if root is not None else []
            made = _Construction(Bodies(title))
            for element in elements:
                if element.tag == "element" and element.get("type") == "point":
                    made.made.point(element.get("label", ""), _place(element))
    except DAMAGED as error:
        raise CallError.of(title, "is no file of geogebra", "save it as ggb", error=from_others(error)) from None
    for command in (element for element in elements if element.tag == "command"):
        _follow(made, command.get("name", ""), *(_arguments(command, tag) for tag in ("input", "output")))
    used = {p for held in (*made.bars, *made.lines.values()) for p in held}
    made.slid = [slide for slide in made.slid if slide[0] in used]
    points = made.made.names
    frame = [p for p in points if p not in made.moving and p in used]
    for label in [p for p in points if p not in used]:
        made.made.left.append(Phrase("lost point", name=label))
        del made.made.places[points[label]]
    return made.bodies(frame)


def _follow(made: _Construction, name: str, given: list[str], got: list[str]) -> None:
    """Follow a command."""
    out, points = got[0] if got else "", made.made.names
    circles, lines = made.circles, made.lines

    def slide(point: str, line: str) -> None:
        made.slid.append((point, lines[line], Phrase("lost point on line", name=point, line=line)))

    def one_body(keys: Sequence[str]) -> bool:
        return any({*keys} <= {*bar} for bar in (*made.bars, points.keys() - made.moving))

    if name == "Circle" and len(given) == 2 and given[0] in points:
        circles[out] = given[0]
    elif name in ("Segment", "Line", "Ray") and len(given) == 2 and set(given) <= set(points):
        lines[out] = (given[0], given[1])
        if name == "Segment":
            made.bars.append(list(given))
    elif name == "Polygon" and len(got) > 1:  # of a regular one its sides make the other corners
        made.bars.append([p for p in (*given, *got) if p in points])
        made.moving |= {p for p in got if p in points}
    elif name == "Point" and given and out in points and given[0] in circles:
        made.moving.add(out)
        made.bars.append([circles[given[0]], out])
        made.driven.append((circles[given[0]], out, INPUT_SPEED))
    elif name == "Point" and given and out in points and given[0] in lines:
        ends = lines[given[0]]
        if made.moving & {*ends} and one_body(ends):  # it keeps its place on a line that moves
            made.bars.append([*ends, out])
        else:
            slide(out, given[0])
            made.driven += [("", out, INPUT_SPEED)] if not made.moving & {*ends} else []
        made.moving.add(out)
    elif name == "Intersect" and len(given) > 1:
        for point in (p for p in got if p in points):
            made.moving.add(point)
            for curve in given[:2]:
                if curve in circles:
                    made.bars.append([circles[curve], point])
                elif curve in lines:
                    slide(point, curve)
                else:
                    made.made.lost.append(Phrase("lost curve", curve=curve, point=point))
    elif name == "Midpoint" and one_body(given):
        made.bars.append([*given, out])
        made.moving |= {out} if made.moving & {*given} else set()
    elif name not in ("Slider", "Locus", "Distance", "Angle", "Length", "Text"):
        moved = {p for p in got if p in points}
        (made.made.lost if moved else made.made.left).append(f"{name} {', '.join(filter(None, got))}")
        made.moving |= moved


def _arguments(command: ElementTree.Element, tag: str) -> list[str]:
    """The inputs or the outputs of a command, a0, a1, ..., in their order."""
    element = command.find(tag)
    given = element.attrib if element is not None else {}
    return [given[key] for key in sorted(given, key=lambda key: int(re.sub(r"\D", "", key) or 0))]


def _place(element: ElementTree.Element) -> complex:
    coords = element.find("coords")
    given = coords.attrib if coords is not None else {}
    z = float(given.get("z", 1)) or 1.0
    return complex(float(given.get("x", 0)) / z, float(given.get("y", 0)) / z)


# linkages of pylinkage


def construct_linkage(bodies: Bodies, joints: Sequence[Tables]) -> None:
    """Add the bodies of a list of joints.  Raises ValueError, LookupError, TypeError for a list that is none."""
    made = _Construction(bodies)
    fixed: list[str] = []

    def refer(value: object) -> str:
        if isinstance(value, dict) and "ref" not in value and "x" in value:  # a static one that stands here alone
            label = f" S{len(bodies.names)}"  # no joint of the file has this name
            bodies.point(label, complex(float(value["x"]), float(value["y"])))
            fixed.append(label)
            return label
        label = str(value["ref"] if isinstance(value, dict) else value)
        if label not in bodies.names:
            raise ValueError(Phrase("joint is not there", name=label))
        return label

    for joint in joints:
        kind, label = str(joint["type"]).lower(), str(joint.get("name") or f"J{len(bodies.names)}")
        first = refer(joint["joint0"]) if joint.get("joint0") is not None else ""
        second = refer(joint["joint1"]) if joint.get("joint1") is not None else ""
        here = complex(float(joint.get("x") or 0.0), float(joint.get("y") or 0.0))
        if kind == "static":
            bodies.point(label, here)
            fixed.append(label)
            continue
        if not first or (not second and kind != "crank"):
            raise ValueError(Phrase("joint refers to no other", name=label))
        start = bodies.place(first)
        if kind == "crank":
            crank = here - start if joint.get("x") is not None else complex(float(joint["distance"]))
            bodies.point(label, start + float(joint.get("distance", abs(crank))) * crank / abs(crank))
            made.bars.append([first, label])
            made.driven.append((first, label, float(joint.get("angle", STEP))))
        elif kind == "fixed":
            turn = cmath.phase(bodies.place(second) - start) + float(joint["angle"])
            bodies.point(label, start + cmath.rect(float(joint["distance"]), turn))
            if {first, second} <= set(fixed):
                fixed.append(label)
                continue
            made.bars.append([first, second, label])
        elif kind in ("revolute", "pivot"):
            both = cross_arcs(start, float(joint["distance0"]), bodies.place(second), float(joint["distance1"]))
            if both is None:
                raise ValueError(Phrase("the bars of do not meet", name=label))
            bodies.point(label, min(both, key=lambda z: abs(z - here)))
            made.bars += [[first, label], [second, label]]
        elif kind in ("linear", "prismatic"):
            line = second, refer(joint["joint2"])
            bodies.point(label, here)
            made.bars.append([first, label])
            made.slid.append((label, line, Phrase("lost joint line", name=label)))
        else:
            bodies.lost.append(Phrase("lost joint kind", name=label, kind=joint["type"]))
            continue
        made.moving.add(label)
    made.bodies(list(dict.fromkeys(fixed)))
