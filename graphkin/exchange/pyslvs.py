"""pyslvs: expressions ``M[J[R, P[0, 0], L[ground, link_1]], ...]``, alone or in a .pyslvs project, which also says what
drives.

A joint has its kind (R, P, RP), of a slide the angle ``A[90]`` of its line in degrees on the first of its links, any
colour, its place and its links; the link ``ground`` is fixed (grammar of ``pyslvs.expression_parser``).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

from graphkin.errors import CallError, Problem
from graphkin.exchange.bodies import FRAME, Bodies, BodyDrive, FileJoint, bodies_of, number
from graphkin.words import Phrase

__all__ = ["INPUT_SPEED", "read_pyslvs", "write_pyslvs"]

INPUT_SPEED = 1.0
"""rad/s: an expression says no speed."""
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_JOINT = re.compile(
    rf"J\[\s*(RP|R|P)\s*(?:,\s*A\[\s*({_NUMBER})\s*\])?\s*(?:,\s*color\[[^\]]*\])?\s*,\s*"
    rf"P\[\s*({_NUMBER})\s*,\s*({_NUMBER})\s*\]\s*,\s*L\[([^\]]*)\]\s*\]"
)


def read_pyslvs(text: str, title: str) -> Bodies:
    """The bodies of an expression or a project.  Raises CallError where there is none, or it cannot be read."""
    plain = re.sub(r"#\[[\s\S]*?#\][^\n]*|#[^\n]*", "", text)
    begin = re.search(r"\bM\s*\[", plain)
    if begin is None:
        raise CallError(Problem(title, Phrase("holds no expression m"), Phrase("copy the expression from pyslvs")))
    inner, end = _inside(plain, begin.end(), title)
    joints: list[FileJoint] = []
    rest = _JOINT.sub("", inner)
    if re.sub(r"[\s,]+", "", rest):
        found = Phrase("is no joint", joint=rest.strip(" ,")[:60])
        raise CallError(Problem(title, found, Phrase("write j r p 0 0 l ground")))
    for kind, angle, x, y, links in _JOINT.findall(inner):
        names = tuple(filter(None, (n.strip() for n in links.split(","))))
        if not names:
            raise CallError(
                Problem(title, Phrase("the joint at has no link", value=x, other=y), Phrase("write l ground link_1"))
            )
        place, turn = complex(float(x), float(y)), math.radians(float(angle or 0))
        joints.append(FileJoint(f"P{len(joints)}", kind, place, names, turn))
    made = bodies_of(title, joints)
    points = list(made.places)
    pairs = re.findall(r"base\W+(\d+)\D+?drive\W+(\d+)", plain[end:]) or re.findall(
        r"base\W+(\d+)\D+?drive\W+(\d+)", plain[: begin.start()]
    )
    if not pairs and len(re.findall(r"\bM\s*\[", plain)) == 1:
        pairs = _first_crank(made)
    for base, drive in pairs:
        ends = [points[int(k)] for k in (base, drive) if int(k) < len(points)]
        turned = [n for n, own in made.bodies.items() if n != FRAME and len(ends) == 2 and set(ends) <= set(own)]
        if turned:
            made.drives.append(BodyDrive(turned[0], INPUT_SPEED))
        else:
            made.lost.append(f"input from {base} to {drive} (no link has both)")
    return made


def _inside(text: str, begin: int, title: str) -> tuple[str, int]:
    """What stands in the brackets that open before ``begin``, and where they close."""
    depth = 1
    for k in range(begin, len(text)):
        depth += {"[": 1, "]": -1}.get(text[k], 0)
        if not depth:
            return text[begin:k], k + 1
    raise CallError(Problem(title, Phrase("a bracket is not closed"), Phrase("copy the whole expression")))


def _first_crank(made: Bodies) -> list[tuple[str, str]]:
    """The first bar about a fixed pivot, where nothing says what drives."""
    points = list(made.places)
    for name, own in made.bodies.items():
        fixed = [p for p in own if p in made.bodies[FRAME]]
        free = [p for p in own if p not in made.bodies[FRAME]]
        if name != FRAME and fixed and free:
            return [(str(points.index(fixed[0])), str(points.index(free[0])))]
    return []


def write_pyslvs(bodies: Bodies) -> str:
    """The expression of bodies; what it cannot hold is added to ``left``."""
    joints = []

    def joint(kind: str, place: complex, names: Iterable[str], angle: float | None = None) -> None:
        turned = "" if angle is None else f", A[{number(math.degrees(angle))}]"
        links = ", ".join("ground" if n == FRAME else f"link_{n}" for n in names)
        joints.append(f"J[{kind}{turned}, P[{number(place.real)!r}, {number(place.imag)!r}], L[{links}]]")

    for point, place in bodies.places.items():
        own = [n for n, points in bodies.bodies.items() if point in points]
        slot = next((s for s in bodies.slides if s.point == point and s.turns), None)
        kept = [s for s in bodies.slides if s.point == point and not s.turns]
        if slot is not None:
            joint("RP", place, [slot.on, *(n for n in own if n != slot.on)], slot.angle)
        elif len(own) > 1 or not kept:
            joint("R", place, own)
        for slide in kept:
            joint("P", place, [slide.on, slide.body], slide.angle)
    bodies.left += [f"unit of length {bodies.unit}"] if bodies.unit != "mm" else []
    bodies.left += [f"speed of {drive.body}" for drive in bodies.drives]
    return "M[" + ", ".join(joints) + "]\n"
