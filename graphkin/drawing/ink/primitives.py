"""The primitives of a figure: strokes, fills and texts on a page, in millimetres.

A point of the page is a complex number, x to the right and y **down** from the left upper corner (the user units of
the SVG).  Angles are radians, counter-clockwise as seen on the page.  Every writer draws this same list.  A page has
thousands of them, and each move makes them anew: they are tuples, which are made three times as fast as data classes.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, TypeVar

if TYPE_CHECKING:
    from graphkin.plane import Points

Places = TypeVar("Places", complex, "Points")
PALE = 0.5  # how much of a scan is seen

Segment: TypeAlias = tuple[complex, complex]
"""A straight line from one point to another."""


def page_direction(angle: float) -> complex:
    """Unit step on the page at an angle (rad) counter-clockwise from the x axis."""
    return cmath.rect(1.0, angle).conjugate()


def on_page(z: Places) -> Places:
    """A place (mm) of a mechanism or polygon, whose y axis points up, on the page, whose points down; or places."""
    return z.conjugate()


class Stroke(NamedTuple):
    """The look of a line: width (mm), dashes and gaps in turn (mm; none for a solid line), colour ``#rrggbb``."""

    width: float
    dash: tuple[float, ...] = ()
    colour: str = "#000000"

    @property
    def solid(self) -> bool:
        return not self.dash

    def coloured(self, colour: str) -> Stroke:
        return Stroke(self.width, self.dash, colour)


class Line(NamedTuple):
    """A straight stroke.  ``covered`` mm at its end lie under an arrowhead and get no ink, so that the tip is sharp."""

    start: complex
    end: complex
    stroke: Stroke
    covered: float = 0.0

    @classmethod
    def between(cls, a: complex, b: complex, stroke: Stroke) -> Line:
        """A line between two places (mm) of a mechanism or polygon, whose y axis points up."""
        return cls(on_page(a), on_page(b), stroke)

    @property
    def inked_end(self) -> complex:
        length = abs(self.end - self.start)
        if self.covered == 0.0 or length == 0.0:
            return self.end
        return self.end - (self.end - self.start) * min(1.0, self.covered / length)

    def moved(self, by: complex) -> Line:
        return Line(self.start + by, self.end + by, self.stroke, self.covered)


class Polyline(NamedTuple):
    """An open stroke through points."""

    points: tuple[complex, ...]
    stroke: Stroke

    def moved(self, by: complex) -> Polyline:
        return Polyline(tuple(z + by for z in self.points), self.stroke)


class Polygon(NamedTuple):
    """A closed area, filled, with or without an outline; ``fill`` is "" for the outline alone."""

    points: tuple[complex, ...]
    fill: str = "#000000"
    stroke: Stroke | None = None

    def moved(self, by: complex) -> Polygon:
        return Polygon(tuple(z + by for z in self.points), self.fill, self.stroke)


class Circle(NamedTuple):
    """A full circle, filled or not, with or without an outline; radius in mm."""

    centre: complex
    radius: float
    fill: str = ""
    stroke: Stroke | None = None

    def moved(self, by: complex) -> Circle:
        return Circle(self.centre + by, self.radius, self.fill, self.stroke)


class Arc(NamedTuple):
    """A stroke along a circle from angle ``start`` to angle ``end`` (rad, counter-clockwise positive).

    It runs counter-clockwise where ``end > start``, else clockwise, and is less than a full turn.
    """

    centre: complex
    radius: float
    start: float
    end: float
    stroke: Stroke

    def at(self, angle: float) -> complex:
        return self.centre + self.radius * page_direction(angle)

    def moved(self, by: complex) -> Arc:
        return Arc(self.centre + by, self.radius, self.start, self.end, self.stroke)


class Run(NamedTuple):
    """A stretch of text of one size and face; x and y (mm, y down) of its baseline start from the text's own point."""

    text: str
    x: float = 0.0
    y: float = 0.0
    size: float = 3.5
    italic: bool = False
    bold: bool = False


class Text(NamedTuple):
    """Runs of text about a point of the baseline.

    ``anchor`` is the part of the whole text at the point: "start", "middle" or "end".  ``id`` and ``classes`` belong to
    the element in the SVG, ``step`` is the number of its step, ``since`` of the step from which it is shown.
    """

    at: complex
    runs: tuple[Run, ...]
    anchor: str = "start"
    colour: str = "#000000"
    id: str = ""
    classes: tuple[str, ...] = ()
    step: int | None = None
    since: int | None = None

    @property
    def string(self) -> str:
        """Its words, as a reader copies them."""
        return "".join([run.text for run in self.runs])

    def moved(self, by: complex) -> Text:
        return Text(self.at + by, self.runs, self.anchor, self.colour, self.id, self.classes, self.step, self.since)


@dataclass(frozen=True)
class Scan:
    """A photograph or scan, paled so that lines show over it: its pixel (x, y) lies at ``corner + step (x + iy)``.

    ``data`` is a file of the media type ``kind``, ``width`` and ``height`` are in pixels; it is cut at the corners of
    ``panel``.
    """

    corner: complex
    step: complex
    width: int
    height: int
    kind: str
    data: bytes = field(repr=False)
    panel: tuple[complex, ...] = ()

    def moved(self, by: complex) -> Scan:
        return replace(self, corner=self.corner + by, panel=tuple(z + by for z in self.panel))


@dataclass(frozen=True)
class Travel:
    """The repeated motion of a group on a screen; on paper it stands as it is drawn.

    moves : for each frame its displacement (mm on the page), None where it is hidden; the last frame is the first again
    turns : for each frame its rotation (degrees, clockwise on the page) about ``about``; empty for none
    seconds : the duration of the whole
    """

    moves: tuple[complex | None, ...]
    turns: tuple[float, ...]
    about: complex
    seconds: float


class Group(NamedTuple):
    """A group of primitives: ``layer`` is its name as a layer for Inkscape, ``title`` its description in words,
    ``step`` the number of the step of its strokes, ``since`` of the step from which it is shown, ``motion`` its motion
    on a screen."""

    children: tuple[Primitive, ...]
    id: str = ""
    classes: tuple[str, ...] = ()
    layer: str = ""
    title: str = ""
    step: int | None = None
    motion: Travel | None = None
    since: int | None = None

    def moved(self, by: complex) -> Group:
        """The group with all that it holds."""
        motion = self.motion and replace(self.motion, about=self.motion.about + by)
        return self._replace(children=moved(self.children, by), motion=motion)


Primitive: TypeAlias = Line | Polyline | Polygon | Circle | Arc | Text | Scan | Group


def class_names(classes: tuple[str, ...], step: int | None) -> tuple[str, ...]:
    """The classes of a group or text in the SVG, with the class of its step after the first."""
    stage = () if step is None else (f"step-{step:02d}",)
    return *classes[:1], *stage, *classes[1:]


@dataclass(frozen=True)
class Page:
    """A page for the writers: size in mm, title and description in words, language ("en", "zh"), facts for programs,
    content."""

    width: float
    height: float
    children: tuple[Primitive, ...]
    title: str = ""
    desc: str = ""
    lang: str = "en"
    metadata: Mapping[str, object] = field(default_factory=dict)


def walk(children: Iterable[Primitive]) -> list[Primitive]:
    """All primitives in the order of drawing, groups before their children."""
    primitives: list[Primitive] = []
    for child in children:
        primitives.append(child)
        if isinstance(child, Group):
            primitives += walk(child.children)
    return primitives


def map_tree(
    children: Iterable[Primitive], change: Callable[[Primitive], Primitive | None]
) -> tuple[Primitive, ...]:
    """The primitives, each changed, or left out where ``change`` gives None; groups after their children."""
    primitives: list[Primitive] = []
    for child in children:
        if isinstance(child, Group):
            child = child._replace(children=map_tree(child.children, change))
        changed = change(child)
        if changed is not None:
            primitives.append(changed)
    return tuple(primitives)


def moved(children: Iterable[Primitive], by: complex) -> tuple[Primitive, ...]:
    """The primitives moved on the page (mm)."""
    return tuple([child.moved(by) for child in children])
