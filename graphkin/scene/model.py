"""The one model of a mechanism: links, pairs, drivers, sizes; its question; the numbers in which designs of one
mechanism differ; the joints that carry forces, and its forces by name.

Plane quantities are complex numbers (x + iy), lengths in m, angles in rad, times in s.
A scene is a value: nothing stores results in it.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Literal

from graphkin.errors import Problem, Unsolvable, did_you_mean
from graphkin.scene.laws import MotionLaw
from graphkin.scene.pairs import (
    CircularSlot,
    HigherPair,
    LawCam,
    Pair,
    PlacedContact,
    PlacedGear,
    PlacedGuide,
)
from graphkin.scene.scene_tables import (
    Disc,
    Flywheel,
    LoadPhase,
    Positions,
    ReadScan,
    SceneTables,
    SheetWishes,
    Vary,
    no_position,
)
from graphkin.scene.symbol import PointRef, Printed, Symbol
from graphkin.scene.tables import Unit, Units, derived

SEARCHED = 2e-6  # of a radian, or of the size: a double zero is found no better
EDGE = 1e-9
"""Of the stroke or the turn: a load that begins or ends within this of a position does so exactly there."""


@dataclass(frozen=True)
class LinkMass:
    """Mass (kg) and inertia (kg m2) of a link about its centre of mass, which lies ``at`` in its own axes (m)."""

    link: str
    at: complex
    mass: float
    inertia: float


@dataclass(frozen=True)
class LoadOn:
    """A force (N) on a link at a place of its own axes (m), or a moment (N m; ``size`` of both, ``is_force`` tells).

    ``turn`` is its direction, in the frame or from the axis of link ``follows``; with ``against`` it lies along the
    guide of that sliding pair, opposite to its sliding velocity.  ``phase`` says when it acts, in SI: on a part of the
    stroke of a pair, or while the first driver's value grows from ``start`` to ``end`` (rad, m; at most a turn).
    """

    name: str
    link: str
    size: float
    is_force: bool
    at: complex = 0j
    turn: complex = 1 + 0j
    follows: str = ""
    against: str = ""
    phase: LoadPhase | None = None

    @property
    def symbol(self) -> Symbol:
        """Its symbol ``P_name``; of a balancing load, which has no name, ``F_2`` or ``M_2``."""
        if self.name:
            return Symbol("P", name=self.name, turning=not self.is_force)
        return Symbol("F" if self.is_force else "M", link=self.link)

    def without_stroke(self, stop: Unsolvable) -> Unsolvable:
        """The refusal of the stroke on a part of which it acts, by the load: nobody asked for the stroke."""
        where = f"loads.{self.name}.when.stroke"
        problems = (Problem(where, problem.found, "give when driver from to") for problem in stop.problems)
        return Unsolvable(stop.status, *problems)

    def acts_at(self, value: Any, turns: bool) -> tuple[Any, Any]:
        """Whether it acts where the first driver has a value, and whether it begins or ends exactly there.

        Parameters
        ----------
        value : float, or array of any shape (rad where the driver ``turns``, else m)
        """
        assert self.phase is not None
        start, end = self.phase.start, self.phase.end
        span = end - start
        if not turns:
            near = EDGE * span
            return (start < value) & (value < end), (abs(value - start) < near) | (abs(value - end) < near)
        since, near, always = (value - start) % math.tau, EDGE * math.tau, span >= math.tau * (1 - EDGE)
        edge = (since < near) | (math.tau - since < near) | (abs(since - span) < near)
        return (since < span) | always, edge & (not always)

    def acts_on_stroke(self, part: Any, running: Any) -> tuple[Any, Any]:
        """Whether a load on a part of a stroke acts there, and whether it begins or ends exactly there.

        Parameters
        ----------
        part : of the stroke that lies behind, from its lower end on: float, or array of any shape
        running : whether the slide runs in the sense in which the load acts
        """
        phase = self.phase
        assert phase is not None
        done = part if phase.sense > 0 else 1.0 - part

        def at(edge: float) -> Any:
            turns_back = edge < EDGE or edge > 1.0 - EDGE  # both senses meet there
            return (abs(done - edge) < EDGE) & (running | turns_back)

        return running & (phase.start < done) & (done < phase.end), at(phase.start) | at(phase.end)


@dataclass(frozen=True)
class SpringOn:
    """A spring between points of two links, which lie ``at`` in their own axes (m).

    It pulls them together with preload + rate * (length - free) (N, N/m, m); ``P_name`` is its force on the first
    link, the opposite acts on the second.
    """

    name: str
    points: tuple[str, str]
    links: tuple[str, str]
    at: tuple[complex, complex]
    rate: float
    free: float
    preload: float = 0.0
    kind: ClassVar[str] = "spring"

    @property
    def symbol(self) -> Symbol:
        """The symbol of its force."""
        return Symbol("P", name=self.name)

    def pull(self, length: Any) -> Any:
        """Its pull at a length (N, m): floats, or arrays of one shape."""
        return self.preload + self.rate * (length - self.free)

    @property
    def gaps(self) -> dict[str, object]:
        """The names in its sentences."""
        (point, other_point), (link, other_link) = self.points, self.links
        return {"name": self.name, "point": point, "link": link, "other_point": other_point, "other_link": other_link}

    def numbers(self, units: Units) -> dict[str, tuple[float, str]]:
        """The numbers in its sentences, in the units of a scene, with the unit."""
        return {"rate": (self.rate * units.metres / units.newtons, f"{units.force}/{units.length}"),
                "free": (self.free / units.metres, units.length),
                "preload": (self.preload / units.newtons, units.force)}

    @property
    def where(self) -> str:
        """Its place in the file."""
        return f"{self.kind}s.{self.name}"

    @property
    def ends(self) -> tuple[tuple[str, complex], tuple[str, complex]]:
        """Link and place of either end."""
        return (self.links[0], self.at[0]), (self.links[1], self.at[1])


@dataclass(frozen=True)
class Loading:
    """The causes of forces; ``gravity`` is 0 where weights do not pull (m/s2); ``balance`` is the load that is unknown
    besides the joint forces, None where the driver balances them."""

    gravity: complex = 0j
    masses: tuple[LinkMass, ...] = ()
    loads: tuple[LoadOn, ...] = ()
    balance: LoadOn | None = None
    flywheel: Flywheel | None = None
    springs: tuple[SpringOn, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.masses or self.loads or self.springs)

    @property
    def applied(self) -> tuple[Symbol, ...]:
        """The forces and moments of loads and springs by name."""
        return *(load.symbol for load in self.loads), *(spring.symbol for spring in self.springs)


@dataclass(frozen=True)
class PlacedLink:
    """A rigid link with everything placed in its own axes (for the frame: world axes).

    ``points`` maps names to places (m), the own points first, in the order of the file.
    ``bar`` are the 0, 1 or 2 names in the file's ``points`` key that give the own axes.
    ``guides`` always holds "" (the own x axis).  ``discs`` are its round outlines (m).
    """

    name: str
    points: Mapping[str, complex]
    bar: tuple[str, ...]
    guides: Mapping[str, PlacedGuide]
    redundant: bool = False
    discs: Mapping[str, Disc] = field(default_factory=dict)

    @property
    def length(self) -> float | None:
        """Length of a bar between its two own points (m), None for other links."""
        return abs(self.points[self.bar[1]]) if len(self.bar) == 2 else None


@dataclass(frozen=True)
class Driver:
    """The given motion of a link relative to another: the angle of its own x axis, or its travel in a sliding pair.

    Parameters
    ----------
    link, relative_to : the driven link and the link from which its motion counts; of a travel the link (or the block of
        a pin in a slot) that slides, and the link on which it slides
    value, rate, second : an angle (rad, rad/s, rad/s2), or a travel along the guide's sense (m, m/s, m/s2)
    slide : key of the sliding pair or pin in slot of a travel, "" of an angle
    distance : from a dead point (rad, m), where that gives the value: positive beyond one at which the motion begins,
        negative before one where it ends; until the dead point has been found the value is not known
    near : the value near to which the dead point lies, where there are several
    exact : the value so found, in fifty digits; "" until then
    position : the name of the position, where its angle follows from a stroke that is not known yet
    rpm : the rate in turns per minute, where the problem gives it so
    given_speed : a point and its speed (m/s, with the sign of the turning), from which the rate follows, 0 until it has
        been found
    law : its motion over the time; the rates are those at the moment of the law
    ratios, through : of a follower, whose motion is in constant ratios to the drivers by rolling: its rate over the
        rate of each driver (m/rad where lengths and angles mix), and the links that pass the motion on

    From these follow whether it ``turns`` (gives an angle, not a travel), its ``key`` (the link that it turns, or the
    sliding pair), both ``links``, its three ``values``, what they ``measure``, whether it ``rolls`` (rolling makes it
    follow the drivers) or is ``given`` by the scene.
    """

    link: str
    relative_to: str
    value: float
    rate: float
    second: float
    slide: str = ""
    distance: float | None = None
    position: str = ""
    rpm: float | None = None
    given_speed: tuple[str, float] | None = None
    law: MotionLaw | None = None
    ratios: tuple[float, ...] = ()
    through: tuple[str, ...] = ()
    near: float | None = None
    exact: str = ""

    turns: bool = derived()
    key: str = derived()
    links: tuple[str, str] = derived()
    values: tuple[float, float, float] = derived()
    measure: str = derived()
    rolls: bool = derived()
    given: bool = derived()

    def __post_init__(self) -> None:
        self.__dict__.update(
            turns=not self.slide, links=(self.link, self.relative_to),
            # a driver of the scene may turn a follower too, seen from another link
            key=self.slide or (f"{self.link}'" if self.ratios else self.link),
            values=(self.value, self.rate, self.second), measure="length" if self.slide else "angle",
            rolls=bool(self.ratios), given=not self.ratios,
        )

    def span(self, size: float) -> float:
        """The divisor that frees its values of their unit: 1 rad, or a size (m)."""
        return 1.0 if self.turns else size

    def turns_about(self, link: str) -> bool:
        """Whether it gives an angle from that of a link, as of the frame."""
        return self.turns and self.relative_to == link

    def wrapped(self, change: float) -> float:
        """A change of its value (rad, m); of an angle without whole turns, from half a turn back to half a turn on."""
        return math.remainder(change, math.tau) if self.turns else change

    def at_value(self, value: float) -> Driver:
        """This driver at another value (rad, m)."""
        return replace(self, value=value, distance=None, near=None, exact="", position="")

    def at_rate(self, rate: float) -> Driver:
        """This driver at a steady rate (rad/s, m/s)."""
        return replace(self, rate=rate, second=0.0, rpm=None, law=None)

    def moving(self, law: MotionLaw) -> Driver:
        """This driver with the value and rates of a law at the law's moment."""
        now = law.at(law.time)
        return replace(self, rate=now.slope, second=now.second, law=law)


@dataclass(frozen=True)
class PlacedPicture:
    """A picture: the pixel x to the right and y down from its left upper corner lies at ``corner + step (x - iy)`` (m,
    world axes; of a scan mm on the figure).  ``data`` is the file as it is, of the media type ``kind``."""

    name: str
    kind: str
    width: int
    height: int
    data: bytes = field(repr=False)
    corner: complex = 0j
    step: complex = 1 + 0j


@dataclass(frozen=True)
class StatedValues:
    """Values that somebody states of one position.

    ``at`` is the driver's value in its own unit, the name of a position, or None for the scene's own; ``file`` is a CSV
    file that holds them instead; ``by`` says how they were found.
    """

    at: float | str | None
    values: Mapping[Symbol, Printed]
    by: Literal["drawing", "computation"] = "drawing"
    file: str = ""


@dataclass(frozen=True)
class Question:
    """The question that a problem asks of its mechanism, and the wishes for figures and text.

    ``find`` are the quantities asked for, empty for all; the places of ``positions`` are driver values (rad, m) or
    places on a stroke, the first None for the driver's own value; ``stated`` holds all that somebody printed, digit by
    digit, first that of the scene's own position; ``loops`` are vector loops by name, each through its points;
    ``vary`` gives the rules by which a set of problems is drawn from the scene, ``grading`` the points.  ``background``
    lies under the drawing; ``scans`` are drawings to be judged, by their figures.  ``written`` is the file that was
    read, None where the mechanism was made otherwise.
    """

    title: str = ""
    title_zh: str = ""
    source: str = ""
    source_zh: str = ""
    find: tuple[Symbol, ...] = ()
    sheet: SheetWishes = field(default_factory=SheetWishes)
    stated: tuple[StatedValues, ...] = ()
    positions: Positions | None = None
    loops: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    vary: Vary | None = None
    grading: Mapping[str, float] = field(default_factory=dict)
    background: PlacedPicture | None = None
    scans: Mapping[str, tuple[ReadScan, PlacedPicture | None]] = field(default_factory=dict)
    written: SceneTables | None = field(default=None, compare=False, repr=False)

    @property
    def printed(self) -> dict[Symbol, float | complex]:
        """The printed values of this position by symbol, in SI: a float, or a complex number for two components."""
        here = (stated for stated in self.stated if stated.at is None)
        return {symbol: printed.value for stated in here for symbol, printed in stated.values.items()}

    def title_in(self, language: str) -> str:
        """The title in a language: the Chinese title if there is one and Chinese is asked, else the title."""
        return self.title_zh if language == "zh" and self.title_zh else self.title

    def source_in(self, language: str) -> str:
        """The source of the problem in a language, chosen as the title is."""
        return self.source_zh if language == "zh" and self.source_zh else self.source


@dataclass(frozen=True)
class Mechanism:
    """A mechanism at one position: links, pairs, drivers and sizes, with its ``question``.

    ``links`` are the moving links in the order of the file (redundant ones included, see ``PlacedLink.redundant``);
    ``sketch`` and ``drawn`` give places of points in world axes (m); ``slots`` are the circular ones, for which bars
    and turning pairs stand among the links.  ``slides`` are the sliding pairs (``slidings``) and the pins in slots.
    ``instead_of`` is the mechanism with cams that this one replaces: both have the same velocities and accelerations at
    this position.  ``starts`` give the start of rolling motions at the scene's own position: the angle of a link's own
    axis (rad), or the travel (m) of a sliding pair or of a contact by its block.
    ``higher_pairs`` are the ``contacts``, ``gears`` and ``cams``; those ``acting`` hold links: not the cams that links
    replace.
    ``by_name`` has every link, the frame included; ``order`` the place of each in the file, the frame last; ``holders``
    for each point the links that have it, the frame first; ``size`` (m) is the largest distance given in the file.
    """

    name: str
    frame: PlacedLink
    links: tuple[PlacedLink, ...]
    slides: tuple[Pair, ...]
    drivers: tuple[Driver, ...]
    units: Units = field(default_factory=Units)
    sketch: Mapping[str, complex] = field(default_factory=dict)
    drawn: Mapping[str, complex] = field(default_factory=dict)
    loading: Loading = field(default_factory=Loading)
    higher_pairs: tuple[HigherPair, ...] = ()
    instead_of: Mechanism | None = None
    starts: Mapping[str, float] = field(default_factory=dict)
    slots: tuple[CircularSlot, ...] = ()
    question: Question = field(default_factory=Question)
    slidings: tuple[Pair, ...] = derived()
    contacts: tuple[PlacedContact, ...] = derived()
    gears: tuple[PlacedGear, ...] = derived()
    cams: tuple[LawCam, ...] = derived()
    acting: tuple[HigherPair, ...] = derived()
    contact_at: Mapping[str, PlacedContact] = derived()
    by_name: Mapping[str, PlacedLink] = derived()
    order: Mapping[str, int] = derived()
    holders: Mapping[str, tuple[str, ...]] = derived()
    size: float = derived()

    def __hash__(self) -> int:
        return hash((self.name, tuple(link.name for link in self.links)))

    @property
    def whole(self) -> Mechanism:
        """The mechanism of the file: the mechanism with cams where this one replaces it, else this one."""
        return self if self.instead_of is None else self.instead_of

    @cached_property
    def replacing(self) -> Mapping[str, CircularSlot]:
        """The bars that replace pins in circular slots, or cams at one position, with the path of each."""
        return {slot.bar: slot for slot in self.slots if not slot.block}

    @property
    def pairs(self) -> tuple[Pair | CircularSlot | HigherPair, ...]:
        """All pairs but turning pairs: sliding pairs, pins in slots, what runs along a circle, and what touches."""
        slots = (slot for slot in self.slots if slot.of or slot.block)  # the others stand for cams
        return *self.slides, *slots, *self.higher_pairs

    @cached_property
    def replaced_by(self) -> Mapping[str, HigherPair]:
        """The higher pair that each block or bar stands for."""
        return {pair.block: pair for pair in self.higher_pairs if pair.block}

    def own_points(self, link: PlacedLink) -> list[str]:
        """The points that a link has in the file: a block in a circular slot all but the centre, a bar that stands for
        a pin in one none."""
        slot = next((slot for slot in self.slots if slot.bar == link.name and (slot.of or slot.block)), None)
        return [point for point in link.points if slot is None or (slot.block and point != slot.centre)]

    def body_of(self, name: str) -> str:
        """A link of the file: of the block that stands for a pin in a slot the link that has the pin."""
        return next((pair.of for pair in self.slides if pair.of and pair.a == name), name)

    def law_of(self, name: str) -> LawCam | None:
        """The cam by whose law a link, or a sliding pair, moves; None where there is none."""
        return next((cam for cam in self.cams if name in (cam.follower, cam.motion.pair)), None)

    def pivots(self, link: str) -> list[str]:
        """The points of a link that are points of the frame too."""
        return [point for point in self.by_name[link].points if point in self.frame.points]

    def rail(self, link: str) -> Pair | None:
        """The sliding pair in which a link slides on the frame; None where it does not."""
        return next((pair for pair in self.slidings if pair.links == (link, self.frame.name)), None)

    def slide_on(self, guide: str) -> Pair | None:
        """The first slide on a guide, by its name in a figure, where the frame's own axis is x."""
        name = f"x{self.frame.name}" if guide == "x" else guide
        return next((pair for pair in self.slides if pair.guide_name == name), None)

    def sliding(self, key: str) -> Pair:
        """The sliding pair of that name."""
        return next(pair for pair in self.slidings if pair.key == key)

    @property
    def points(self) -> Mapping[str, tuple[str, ...]]:
        """The names of the points of each link, the frame's first."""
        return {link.name: tuple(link.points) for link in (self.frame, *self.links)}

    def no_link(self, where: str, name: str) -> Problem | None:
        """The problem of a link that does not exist, None if it does."""
        if name in self.by_name:
            return None
        return Problem(where, "there is no link", did_you_mean(name, self.by_name), name=name)

    def no_point(self, where: str, name: str) -> Problem | None:
        """The problem of a point without a link and a contact, None if it has one."""
        known = (*self.holders, *self.contact_at)
        return None if name in known else Problem(where, "there is no point", did_you_mean(name, known), name=name)

    def no_position(self, where: str, name: str) -> Problem | None:
        """The problem of a position that has no such name, None if there is one."""
        known = self.question.positions.names if self.question.positions else ()
        return no_position(where, name, known)

    def asking(self, **changed: Any) -> Mechanism:
        """This mechanism with parts of its question changed: ``find``, the wishes of its ``sheet``, and so on."""
        return replace(self, question=replace(self.question, **changed))

    def unit_of(self, driver: Driver, radians: bool = False) -> Unit:
        """The unit of a driver's value: degrees (radians in JSON), or the scene's unit of length."""
        return self.units.of(driver.measure, radians)

    def by_driver(self, values: Iterable[float]) -> dict[str, float]:
        """Values of the drivers (SI) by their keys."""
        return {d.key: float(value) for d, value in zip(self.drivers, values, strict=True)}

    def place_said(self, driver: Driver, value: float) -> str:
        """A value of a driver that a search has found (SI), with its unit: 0 where it is nearer to 0 than a search
        tells."""
        return self.unit_of(driver).said(value if abs(value) > SEARCHED * driver.span(self.size) else 0.0)

    def __post_init__(self) -> None:
        each = self.frame, *self.links
        holders: dict[str, list[str]] = {}
        for link in each:
            for point in link.points:
                holders.setdefault(point, []).append(link.name)
        contacts, gears, cams = (
            tuple(pair for pair in self.higher_pairs if isinstance(pair, kind))
            for kind in (PlacedContact, PlacedGear, LawCam)
        )
        by_name = {link.name: link for link in each}
        slides = [replace(pair, guide=by_name[pair.b].guides[pair.guide.name]) for pair in self.slides]
        self.__dict__.update(
            contacts=contacts, gears=gears, cams=cams, contact_at={contact.name: contact for contact in contacts},
            acting=tuple(p for p in self.higher_pairs if self.instead_of is None or not p.by_law),
            slides=tuple(slides), slidings=tuple(s for s in slides if not s.higher), by_name=by_name,
            order={link.name: i for i, link in enumerate((*self.links, self.frame))},
            holders={point: tuple(names) for point, names in holders.items()},
            size=self._size() if self.instead_of is None else self.instead_of.size,
        )

    def _size(self) -> float:
        spans = [abs(z) for link in self.links for z in link.points.values()]
        fixed = list(self.frame.points.values()) + [g.through for n, g in self.frame.guides.items() if n]
        spans += [abs(a - b) for i, a in enumerate(fixed) for b in fixed[:i]]
        spans += [abs(z - w) for z in self.drawn.values() for w in fixed]
        spans += [abs(d.value) for d in self.drivers if not d.turns]
        spans += [length for pair in self.higher_pairs for length in pair.lengths]
        return max(spans, default=0.0) or self.units.metres


# the numbers in which the designs of one mechanism differ

Dimension = tuple[str | int, ...]
"""("point", link, point), ("through", link, guide), ("direction", link, guide), ("turn", sliding pair), and of the
driver k ("value", k), ("rate", k), ("second", k)."""


def dimensions(mechanism: Mechanism) -> dict[Dimension, complex]:
    """The numbers of a mechanism by name (SI)."""
    numbers: dict[Dimension, complex] = {}
    for link in (mechanism.frame, *mechanism.links):
        numbers |= {("point", link.name, point): z for point, z in link.points.items()}
        for name, guide in link.guides.items():
            numbers["through", link.name, name], numbers["direction", link.name, name] = guide.through, guide.direction
    numbers |= {("turn", pair.key): pair.turn for pair in mechanism.slidings}
    for k, driver in enumerate(mechanism.drivers):
        numbers |= {(order, k): complex(x) for order, x in zip(("value", "rate", "second"), driver.values, strict=True)}
    return numbers


def with_dimensions(mechanism: Mechanism, changed: Mapping[Dimension, complex]) -> Mechanism:
    """The mechanism with some of its numbers changed; what was drawn is then a sketch."""

    def own(old: complex, *name: str | int) -> complex:
        return changed.get(name, old)

    def link(old: PlacedLink) -> PlacedLink:
        points = {p: own(z, "point", old.name, p) for p, z in old.points.items()}
        guides = {n: replace(g, through=own(g.through, "through", old.name, n),
                             direction=own(g.direction, "direction", old.name, n))
                  for n, g in old.guides.items()}
        return replace(old, points=points, guides=guides)

    def driver(k: int, old: Driver) -> Driver:
        value, rate, second = (own(complex(x), order, k).real
                               for order, x in zip(("value", "rate", "second"), old.values, strict=True))
        return replace(old, value=value, rate=rate, second=second, rpm=None if ("rate", k) in changed else old.rpm)

    return replace(
        mechanism, frame=link(mechanism.frame), links=tuple(map(link, mechanism.links)),
        slides=tuple(replace(pair, turn=own(pair.turn, "turn", pair.key)) for pair in mechanism.slides),
        drivers=tuple(driver(k, d) for k, d in enumerate(mechanism.drivers)),
        sketch={**mechanism.drawn, **mechanism.sketch}, drawn={},
    )


_MOVING = "frame", "links", "slides", "drivers", "higher_pairs", "starts", "slots"
"""The parts of a mechanism on which its motion depends."""


def changed_beside(before: Mechanism, after: Mechanism) -> tuple[str, ...]:
    """The parts that move differently in two mechanisms for another reason than these numbers: the place of a cam, the
    radius of a disc, teeth."""
    numbers = dimensions(before)
    first, second = (with_dimensions(mechanism, numbers) for mechanism in (before, after))
    changed = [part for part in _MOVING if getattr(first, part) != getattr(second, part)]
    touching = {pair.table: None for pair in (*first.higher_pairs, *second.higher_pairs)
                if (pair in first.higher_pairs) != (pair in second.higher_pairs)}
    return tuple(name for part in changed for name in (touching if part == "higher_pairs" else (part,)))


def same_but_for_dimensions(before: Mechanism, after: Mechanism) -> bool:
    """Whether two mechanisms differ in nothing but these numbers, and in what was drawn."""
    numbers = dimensions(before)
    return with_dimensions(before, numbers) == with_dimensions(after, numbers)


# the joints that carry forces, and the forces and moments by name


@dataclass(frozen=True)
class ForceJoint:
    """A joint, with a force of link ``first`` on link ``second``: a turning pair or a pin in a slot at ``point``, a
    sliding pair (``point`` is the sliding link's first point, or empty), or a higher pair (``point`` is its name, empty
    of a cam).
    ``second`` slides, has the pin, or is the second body.

    pair : the higher pair
    slide : the key of a sliding pair or a pin in a slot, "" of others
    couple : whether a couple goes through it too
    several : whether the two share further joints
    """

    kind: Literal["turning", "sliding", "touching"]
    first: str
    second: str
    point: str
    slide: str = ""
    couple: bool = False
    several: bool = False
    pair: HigherPair | None = None

    def symbol(self, kind: Literal["F", "M"]) -> Symbol:
        """The force or the couple that goes through it, ``F_5/6``, or ``F_5/6@C`` where the two share several."""
        return Symbol(kind, PointRef(self.point) if self.several else None, link=self.first, other=self.second)


def hosts_at(mechanism: Mechanism, point: str, holders: Collection[str]) -> dict[str, str]:
    """The links that what guides a pin or a block along a circle is paired with at a point: in its pin the link that
    has the pin, in its centre the link that has the slot.

    Parameters
    ----------
    holders : the links that meet there
    """
    ends = ((slot.bar, host) for slot in mechanism.slots
            for place, host in ((slot.point, slot.of), (slot.centre, slot.on)) if place == point)
    return {bar: host for bar, host in ends if bar in holders and host in holders}


def joints(mechanism: Mechanism) -> tuple[ForceJoint, ...]:
    """All joints: at each point the first link that has it, the frame if it does, with each later one, but what is
    guided along a circle with the link of the pin or of the slot; then sliding pairs, guiding link first, and pins in
    slots.  Redundant links carry nothing."""
    here = {mechanism.frame.name, *(link.name for link in mechanism.links if not link.redundant)}
    pairs: list[ForceJoint] = []
    for point, holders in mechanism.holders.items():
        at_point = [name for name in holders if name in here]
        hosts = hosts_at(mechanism, point, at_point)
        first = next((name for name in at_point if name not in hosts), "")
        pairs += [ForceJoint("turning", hosts.get(name, first), name, point) for name in at_point if name != first]
    pairs += [ForceJoint("sliding", *s.bodies[::-1], s.pin, s.key, not s.of)
              for s in mechanism.slides if {*s.bodies} <= here]
    pairs += [ForceJoint("touching", *pair.bodies, "" if pair.by_law else pair.name, pair=pair)
              for pair in mechanism.acting if {*pair.members} <= here]
    shared = Counter(frozenset((joint.first, joint.second)) for joint in pairs)
    several = (shared[frozenset((joint.first, joint.second))] > 1 and joint.point != "" for joint in pairs)
    return tuple(replace(joint, several=more) for joint, more in zip(pairs, several, strict=True))


def balance_of(mechanism: Mechanism, driver: Driver) -> Symbol:
    """The balancing load in place of a driver: a moment ``M_2``, or a force ``F_2`` along the guide on which link 2
    slides, ``F_2@B`` where other drivers push that link too, ``F_2@B@3`` where they push its point B along guides of
    link 3 and others."""
    if driver.turns:
        return Symbol("M", link=driver.link)
    pushing = [s for s in mechanism.slides if s.key in {d.key for d in mechanism.drivers}]
    pair = next(s for s in pushing if s.key == driver.key)
    others = [s.pin for s in pushing if s.body == pair.body and s is not pair]
    at = PointRef(pair.pin, pair.b if pair.pin in others else "") if others and pair.pin else None
    return Symbol("F", at, link=pair.body)


def forces_named(mechanism: Mechanism) -> tuple[Symbol, ...]:
    """Every force and moment of a mechanism with masses, loads or springs, in the order of their telling."""
    loading = mechanism.loading
    if not loading:
        return ()
    made: list[Symbol] = []
    for mass in loading.masses:
        made += [Symbol(kind, link=mass.link) for kind in ("Fi", "Mi", *(("G",) if loading.gravity else ()))]
    made += loading.applied
    for joint in joints(mechanism):
        made += [joint.symbol("F"), *([joint.symbol("M")] if joint.couple else [])]
    if loading.balance is not None:
        made.append(loading.balance.symbol)
    else:
        made += [balance_of(mechanism, driver) for driver in mechanism.drivers]
    return tuple(dict.fromkeys(made))


def force_of(mechanism: Mechanism, symbol: Symbol) -> Symbol | None:
    """A force or moment of the mechanism or its opposite, with the mark of a load that is a moment; None for a name
    that the mechanism does not have."""
    plain = replace(symbol, at="", plus=False, axis="")
    known = next((force for force in forces_named(mechanism) if force in (plain, plain.opposite)), None)
    return known and replace(symbol, turning=known.turning)


def no_force(mechanism: Mechanism, where: str, symbol: Symbol) -> Problem | None:
    """The problem of a symbol of a force or a flywheel that the mechanism does not have; None if it has it."""
    if symbol.scope == "cycle" and mechanism.loading.flywheel is None:
        return Problem(where, "belongs to a flywheel but there is none", "give flywheel", symbol=symbol)
    if symbol.kind == "h":  # of the inertia force of a link
        return no_force(mechanism, where, Symbol("Fi", link=symbol.link))
    if symbol.kind == "arm":  # of a force on the lever
        return no_force(mechanism, where, Symbol.parse(symbol.name))
    if not symbol.is_load:
        return None
    known = forces_named(mechanism)
    if not known:
        return Problem(where, "is a force but nothing makes any", "give masses.link or loads.name or springs.name",
                       symbol=symbol)
    if force_of(mechanism, symbol) is not None:
        return None
    name = str(replace(symbol, at="", plus=False, axis=""))
    return Problem(where, "there is no here", did_you_mean(name, map(str, known)), symbol=symbol)
