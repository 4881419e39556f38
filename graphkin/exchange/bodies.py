"""A mechanism as other programs keep it: bodies with points at places, joined by pins and slides; and its scene."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass, field, replace

from graphkin.errors import CallError
from graphkin.files import Json
from graphkin.words import Phrase, Wording

FRAME = "0"
FARTHEST = 1e12
SAME = 1e-9
"""Share of the size within which two places are one."""


@dataclass
class BodySlide:
    """``body`` slides by its point on a line of body ``on``: through a place, in a direction (rad), both in the world.

    turns : a pin in a slot, which turns in it; else the body keeps its angle to the line
    """

    body: str
    point: str
    on: str
    through: complex
    angle: float
    turns: bool = False


@dataclass
class Bodies:
    """Points at places in the world (length unit), bodies with the points that they have, the fixed one by the name
    ``FRAME``; ``names`` are the names of points by their keys in the file that is read.  ``drives`` are the rates of
    drivers by body and point: of a body that turns (rad/s; "" for the point), or of a slide (length unit/s).  ``lost``
    names the parts that move, drive or load and cannot be carried over, ``left`` other parts that cannot."""

    title: str
    places: dict[str, complex] = field(default_factory=dict)
    bodies: dict[str, list[str]] = field(default_factory=dict)
    slides: list[BodySlide] = field(default_factory=list)
    drives: dict[tuple[str, str], float] = field(default_factory=dict)
    unit: str = "mm"
    left: list[Wording] = field(default_factory=list)
    lost: list[Wording] = field(default_factory=list)
    names: dict[str, str] = field(default_factory=dict)

    def point(self, name: str, place: complex, key: str = "") -> str:
        """Add a point under a name that a scene may have, and return that; ``key`` is its other name in the file."""
        kept = re.sub(r"[^A-Za-z0-9]", "", name)[:30]
        kept = kept[:1].upper() + kept[1:]
        made = _fresh(kept if kept[:1].isalpha() else f"P{kept}", self.places)
        if not abs(place) <= FARTHEST:
            where = Phrase("point", point=made)
            raise CallError.of(where, "lies at", "its coordinates are finite numbers",
                               place=f"({place.real:g}, {place.imag:g})")
        self.places[made], self.names[key or name] = place, made
        return made

    def place(self, key: str) -> complex:
        """The place of a point of the file."""
        return self.places[self.names[key]]

    def body(self, name: str, keys: Iterable[str]) -> str:
        """Add a body under a name that a scene may have, which is returned; points of the frame are collected.  Keys of
        no point are left out."""
        kept = re.sub(r"[^A-Za-z0-9]", "", name)[:30] or "L"
        made = FRAME if name == FRAME else _fresh(kept, {*self.bodies, FRAME})
        points = self.bodies.setdefault(made, [])
        points += [p for p in dict.fromkeys(self.names[k] for k in keys if k in self.names) if p not in points]
        return made

    def having(self, point: str) -> list[str]:
        """The bodies that have a point."""
        return [name for name, points in self.bodies.items() if point in points]

    def holder(self, keys: Iterable[str], but: str | None = None) -> str | None:
        """The first body with these points, except one."""
        points = {self.names[key] for key in keys}
        return next((name for name, held in self.bodies.items() if name != but and points <= {*held}), None)

    def slide_on(self, key: str, line: tuple[str, str], otherwise: Wording) -> None:
        """Add a pin at a point that runs on the line through two others; where no body has these, ``otherwise`` is
        noted as lost."""
        on = self.holder(line)
        body = self.holder((key,), but=on)
        if on is None or body is None:
            self.lost.append(otherwise)
            return
        start, end = map(self.place, line)
        self.slides.append(BodySlide(body, self.names[key], on, start, cmath.phase(end - start), turns=True))

    def turn(self, keys: Iterable[str], rate: float, otherwise: Wording = "") -> None:
        """Let the body with these points turn at a rate (rad/s); where no moving body has them, ``otherwise`` is noted
        as lost."""
        body = self.holder(keys, but=FRAME)
        if body is not None:
            self.drive(body, rate)
        elif otherwise:
            self.lost.append(otherwise)

    def drive(self, body: str, rate: float, point: str = "") -> None:
        """Let a body turn at a rate (rad/s), or a slide of it go (length unit/s); a second rate is noted as lost."""
        if (body, point) in self.drives:
            self.lost.append(Phrase("lost driver of", link=body))
        self.drives.setdefault((body, point), rate)

    def scene(self) -> dict[str, Json]:
        """The mapping of a scene file at this position.

        Raises
        ------
        CallError : no body moves, no body is fixed, or there is no driver
        """
        self._tidy()
        moving = [name for name in self.bodies if name != FRAME]
        if not moving:
            raise CallError.of(self.title, "holds no moving link", "draw one link at least")
        fixed = self.bodies.get(FRAME, [])
        frame: dict[str, Json] = {"name": FRAME, "points": {p: _pair(self.places[p]) for p in fixed}}
        links = {name: self._link(name) for name in moving}
        guides: dict[str, dict[str, Json]] = {}  # of each body by their names
        refs = []
        for slide in self.slides:
            origin, axis = self._axis(slide.on)
            names = guides.setdefault(slide.on, {})
            name = f"s{len(names) + 1}"
            angle = _degrees(slide.angle - cmath.phase(axis))
            names[name] = {"through": _pair((slide.through - origin) / axis), "angle": angle}
            refs.append(f"{slide.on}.{name}")
        for on, names in guides.items():
            (frame if on == FRAME else links[on])["guides"] = names
        pins: dict[str, Json] = {}
        for slide, ref in zip(self.slides, refs, strict=True):
            if slide.turns:
                pins[slide.point] = {"of": slide.body, "in": ref}
            else:
                links[slide.body] |= self._on(slide, ref, links[slide.body])
        joints = {point for point in self.places if len(self.having(point)) > 1}
        joints |= {slide.point for slide in self.slides}
        sketch = {p: _pair(z) for p, z in self.places.items() if p in joints and p not in fixed}
        made: dict[str, Json] = {"title": self.title, "units": {"length": self.unit}, "frame": frame, "links": links}
        if pins:
            made["pins"] = pins
        drivers = [self._driver(*drive, rate) for drive, rate in self.drives.items()]
        if drivers:
            made["driver"] = drivers[0] if len(drivers) == 1 else drivers
        if sketch:
            made["sketch"] = sketch
        return made

    def with_pins(self) -> Bodies:
        """These bodies with pins in slots instead of blocks of a single pin, and with two points of its body on every
        line on which bodies slide: for programs that know no other slides, and only one of each point."""
        made = Bodies(self.title, dict(self.places), {n: list(points) for n, points in self.bodies.items()}, [],
                      dict(self.drives), self.unit, self.left, self.lost)
        guides, driven = {s.on for s in self.slides}, {body for body, point in self.drives if point}
        for slide in self.slides:
            block = slide.body
            alone = [s for s in self.slides if s.body == block] == [slide] and len(self.bodies[block]) == 1
            others = [name for name in made.having(slide.point) if name not in (block, slide.on)]
            if slide.point in {s.point for s in made.slides}:
                self.lost.append(Phrase("lost slide", link=slide.body, on=slide.on))
            elif slide.turns:
                made.slides.append(slide)
            elif alone and others and block not in guides | driven:
                made.slides.append(replace(slide, body=others[0], turns=True))
                del made.bodies[block]
            else:
                self.lost.append(Phrase("lost slide at angle", link=block, on=slide.on))
        size = max((abs(a - b) for a in self.places.values() for b in self.places.values()), default=0.0) or 1.0
        for k, slide in enumerate(made.slides):
            along, points = cmath.rect(size, slide.angle), made.bodies.setdefault(slide.on, [])
            foot = slide.through + along * ((self.places[slide.point] - slide.through) / along).real
            points += [made.point(f"Slot{k}a", foot - along), made.point(f"Slot{k}b", foot + along)]
        return made

    def _tidy(self) -> None:
        """Remove bodies that only hang on another by its pin, and bodies without points."""
        for name in [n for n, points in self.bodies.items() if not points and n != FRAME]:
            del self.bodies[name]
            self.lost += [Phrase("lost slide", link=s.body, on=s.on) for s in self.slides if name in (s.body, s.on)]
            self.slides = [s for s in self.slides if name not in (s.body, s.on)]
        sliding = {s.body for s in self.slides} | {s.on for s in self.slides}
        for name, points in list(self.bodies.items()):
            if name != FRAME and len(points) == 1 and name not in sliding:
                del self.bodies[name]
                self.left.append(Phrase("lost point of one", link=name))
        slid = {(s.body, s.point) for s in self.slides}
        for body, point in list(self.drives):
            if (body, point) not in slid if point else body not in self.bodies:
                self.lost.append(Phrase("lost driver of", link=body))
                del self.drives[body, point]

    def _axis(self, name: str) -> tuple[complex, complex]:
        """Origin and direction of a body's own axes."""
        ends = [] if name == FRAME else self._ordered(name)[0]
        origin = self.places[ends[0]] if ends else 0j
        if len(ends) > 1:
            along = self.places[ends[1]] - origin
            return origin, along / abs(along)
        line = next((s for s in self.slides if s.body == name != FRAME and not s.turns), None)
        return origin, cmath.rect(1.0, line.angle) if line is not None else 1 + 0j

    def _ordered(self, name: str) -> tuple[list[str], list[str]]:
        """The points of a body that give its own axes (first the sliding point, then a point at another place, if there
        is one), and the others."""
        points = list(self.bodies[name])
        first = next((s.point for s in self.slides if s.body == name and not s.turns), points[0] if points else "")
        rest = [p for p in points if p != first]
        size = max((abs(self.places[p] - self.places[first]) for p in rest), default=0.0)
        second = next((p for p in rest if abs(self.places[p] - self.places[first]) > SAME * size), "")
        ends = [p for p in (first, second) if p]
        return ends, [p for p in points if p not in ends]

    def _link(self, name: str) -> dict[str, Json]:
        ends, further = self._ordered(name)
        origin, axis = self._axis(name)
        table: dict[str, Json] = {"points": ends}
        if len(ends) > 1:
            table["length"] = number(abs(self.places[ends[1]] - origin))
        if further:
            table["at"] = {p: _pair((self.places[p] - origin) / axis) for p in further}
        return table

    def _on(self, slide: BodySlide, ref: str, table: dict[str, Json]) -> dict[str, Json]:
        """Add the line on which a link slides to the link's table."""
        angle = _degrees(cmath.phase(self._axis(slide.body)[1]) - slide.angle)
        before, angles = table.get("on"), table.get("angle_on", 0)
        if before is None:
            return {"on": ref} | ({"angle_on": angle} if angle else {})
        if isinstance(before, list):
            where = Phrase("link of name", name=slide.body)
            raise CallError.of(where, "slides on more than two others", "a scene has two at most")
        return {"on": [before, ref], "angle_on": [angles, angle]}

    def _driver(self, body: str, point: str, rate: float) -> dict[str, Json]:
        if point:
            slide = next(s for s in self.slides if s.body == body and s.point == point)
            at = (self.places[slide.point] - slide.through) / cmath.rect(1.0, slide.angle)
            name = slide.point if slide.turns else slide.body
            return {"slide": f"{name}/{slide.on}", "travel": number(at.real), "velocity": number(rate)}
        angle = _degrees(cmath.phase(self._axis(body)[1]))
        return {"link": body, "angle": angle, "omega": number(rate)}


def number(value: float) -> float:
    """A number as people write it, without the rounding of its last digits.  Raises CallError for infinity and NaN."""
    if not math.isfinite(value):
        raise CallError.of(Phrase("the file"), "found value", "a finite number is wanted", value=value)
    near = float(f"{value:.15g}")
    return int(near) if near == int(near) and abs(near) < 1e15 else near


def _pair(place: complex) -> list[float]:
    return [number(place.real), number(place.imag)]


def _degrees(angle: float) -> float:
    turned = math.degrees(math.remainder(angle, math.tau))
    near = round(turned)
    return float(near) if abs(turned - near) < 1e-12 * max(1.0, abs(turned)) else number(turned)


def _fresh(name: str, taken: Collection[str]) -> str:
    names = (name, *(f"{name}x{k}" for k in range(2, len(taken) + 3)))
    return next(made for made in names if made not in taken)
