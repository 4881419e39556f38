"""The pairs of a mechanism, in SI units: sliding pairs, pins in slots, contacts, gears, and cams with the laws of their
followers.

A hollow outline (a ring) has a negative radius.  With the signs of the radii two discs touch, inside or outside, where
their centres are r1 + r2 apart, and the point of contact parts the line of centres as r1 : r2.

A cam's sliding follower stands with its first point beyond the foot of the axis on its line by the root of base radius
and offset plus the lift (a flat face: by base radius plus lift); a swinging one's bar turns by the lift from where its
roller's centre lies on the base circle of the pitch curve.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Literal, NamedTuple, TypeAlias

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import Poses, Values, cross, degrees
from graphkin.scene.laws import FollowerLaw, Lift
from graphkin.scene.tables import Units, derived
from graphkin.words import Phrase, gaps_of, has_words

ContactMotion = Literal["slides", "rolls", "meshes"]
"""Two bodies that touch slide on each other, and the force is along the common normal; or roll, with a force of any
direction; or mesh, their centres held apart by another link, with a force along the tangent of the pitch circles."""

# sliding pairs, slots, what touches


@dataclass(frozen=True)
class PlacedGuide:
    """A straight guide of a link, in that link's own axes.

    ``name`` is "" for the link's own x axis.  ``through`` (m) is the guide's origin, from which travel
    counts; ``direction`` is a unit complex number, its sense.  With a ``curvature`` (1/m, positive where it bends to
    the left of its sense) it is the tangent of a curved guide at the point that slides there now.
    """

    name: str
    through: complex = 0j
    direction: complex = 1 + 0j
    curvature: float = 0.0


Points: TypeAlias = Mapping[str, Mapping[str, complex]]
"""The points of each link, in its own axes (m)."""
Guides: TypeAlias = Mapping[str, Mapping[str, PlacedGuide]]
"""The guides of each link, in its own axes (m)."""


NO_GUIDE = PlacedGuide("", 0j, 0j)
"""Where a pair has no direction in which it slides: it turns."""
OWN_AXIS = {"": PlacedGuide("")}
"""The one guide of a link that has no other: its own x axis."""
TOUCHING = 1e-13
"""Of a length: another that differs by less differs by rounding alone."""


def beyond_rounding(length: float, other: float) -> float:
    """A length less another; 0 where they differ by rounding alone: a circle only touches the line or the arc."""
    return length - other if abs(length - other) > TOUCHING * length else 0.0


@dataclass(frozen=True)
class Pair:
    """A lower pair of the links ``a`` and ``b``: both turn about a point, or ``a`` slides by its own origin on a guide
    of ``b``, at a fixed angle.  Or a pin runs in the guide, or a disc on a face: then ``a`` is the block without mass,
    POINT/GUIDING, that stands for it between the guide and the link ``of``.

    Parameters
    ----------
    key : the point of a turning pair; SLIDING/GUIDING of a sliding one, POINT/GUIDING of a pin in a slot
    guide : the guide of link b along which a slides; in a mechanism that of its link by the same name
    turn : unit complex number from the guide's sense to a's own x axis (``angle_on``)
    pin : a's first point, or the pin that runs in the guide, "" where it has no name
    of : the link with the pin in a slot, or with the disc on a face, that the block ``a`` replaces; else ""

    From these follow whether it ``turns`` or is a ``higher`` pair with such a block, both ``links``, the ``body`` of
    the file that slides or has the pin, the ``point`` about which they turn ("" of a sliding pair) and its ``letter``,
    R (revolute) or P (prismatic).
    """

    key: str
    a: str
    b: str
    guide: PlacedGuide = NO_GUIDE
    turn: complex = 1 + 0j
    pin: str = ""
    of: str = ""

    turns: bool = derived()
    higher: bool = derived()
    body: str = derived()
    links: tuple[str, str] = derived()
    point: str = derived()
    letter: str = derived()

    def __post_init__(self) -> None:
        turns = not self.guide.direction
        self.__dict__.update(
            turns=turns, higher=bool(self.of), body=self.of or self.a, links=(self.a, self.b),
            point=self.key if turns else "", letter="R" if turns else "P",
        )

    @classmethod
    def sliding(cls, a: str, b: str, guide: PlacedGuide, turn: complex = 1 + 0j, pin: str = "") -> Pair:
        """A sliding pair: link ``a`` slides on a guide of link ``b``."""
        return cls(f"{a}/{b}", a, b, guide, turn, pin)

    @classmethod
    def of_pin(cls, point: str, of: str, b: str, guide: PlacedGuide) -> Pair:
        """A pin in a slot: point ``point`` of link ``of`` runs in a guide of link ``b``, one constraint."""
        return cls(f"{point}/{b}", f"{point}/{b}", b, guide, pin=point, of=of)

    def other(self, link: str) -> str:
        """The other link of the pair."""
        return self.b if link == self.a else self.a

    @property
    def guide_name(self) -> str:
        """The name of its guide; of a link's own axis x and the link."""
        return self.guide.name or f"x{self.b}"

    def along(self, poses: Poses) -> complex:
        """The unit vector along its guide, in the guide's sense, with the links in these poses."""
        return poses[self.b].axis * self.guide.direction

    @property
    def bodies(self) -> tuple[str, str]:
        """The link that slides, or has the pin, and the link with the guide."""
        return self.body, self.b

    @property
    def kinds(self) -> tuple[str, ...]:
        """The words of its kind, the most special first."""
        return ("pin",) if self.of else ("sliding",) if self.pin else ("sliding without point", "sliding")

    @property
    def gaps(self) -> dict[str, object]:
        """The names in its sentences, and the angle (degrees) of the link's own axis to the guide."""
        guide = f"{self.b}.{self.guide.name}" if self.guide.name else self.b
        return {"point": self.pin, "link": self.body, "on": self.b, "guide": guide,
                "angle": f"{degrees(self.turn) + 0.0:.6g}"}


@dataclass(frozen=True)
class CircularSlot:
    """A slot of link ``on`` along a circle about its point ``centre`` (``radius`` in m), in which ``point`` runs.

    ``bar`` is the link that guides the point: a bar in place of a pin in the slot, or the block itself (``block``).
    ``ends`` are the angles (rad, from the own x axis of ``on``) between which it is drawn, if the file has them.
    ``of`` is the link that has the pin, "" for a block or a cam.
    """

    name: str
    on: str
    centre: str
    radius: float
    bar: str
    point: str
    block: bool = False
    ends: tuple[float, float] | None = None
    of: str = ""

    @property
    def kinds(self) -> tuple[str, ...]:
        """The words of its kind, the most special first."""
        return *(("circular block",) if self.block else ()), "circular slot"

    @property
    def gaps(self) -> dict[str, object]:
        """The names in its sentences."""
        return {"point": self.point, "link": self.of or self.bar, "on": self.on, "guide": f"{self.on}.{self.name}",
                "centre": self.centre, "bar": self.bar}


@dataclass(frozen=True)
class PlacedContact:
    """Two outlines that touch in ``name``.

    ``bodies`` are the two links in the order of the file, ``outlines`` the names of a disc or a guide of each.
    ``centres`` and ``radii`` (m) are those of the discs, one or two, in that order; the radii have the signs with which
    they meet (inside: the larger is hollow).  ``face`` is the link with the flat face, "" where both are discs;
    ``left`` tells on which side of the guide the disc lies.  ``carrier`` is the link that holds both centres of a
    rolling pair, "" where no link does.  ``again`` marks a further contact of the same centre with the same link.
    """

    name: str
    bodies: tuple[str, str]
    outlines: tuple[str, str]
    centres: tuple[str, ...]
    radii: tuple[float, ...]
    face: str
    left: bool
    rolling: bool
    carrier: str = ""
    again: bool = False
    table: ClassVar[str] = "contacts"
    roles: ClassVar[tuple[str, ...]] = ()
    by_law: ClassVar[bool] = False

    @property
    def flat(self) -> bool:
        """Whether one side is a flat face."""
        return self.face != ""

    @property
    def apart(self) -> float:
        """The distance of the centres of two discs (m), negative where one is hollow."""
        return self.radii[0] + self.radii[1]

    @property
    def round_links(self) -> tuple[str, ...]:
        """The links of the discs."""
        return tuple(link for link in self.bodies if link != self.face)

    @property
    def guide(self) -> str:
        """The guide that is the flat face (the link's own axis has no name), "" where there is none."""
        return self.outlines[self.bodies.index(self.face)] if self.flat else ""

    @property
    def block(self) -> str:
        """The name of the block (of a face) or the bar (of two discs) that replaces it."""
        if not self.flat:
            return "".join(self.centres)
        return f"{self.name if self.again else self.centres[0]}/{self.face}"

    @property
    def normal_to_face(self) -> complex:
        """The direction from the face to the disc, counted from the guide's sense."""
        return 1j if self.left else -1j

    @property
    def replaced(self) -> bool:
        """Whether links and lower pairs replace it at every position."""
        return not self.rolling

    @property
    def members(self) -> tuple[str, ...]:
        """The links without which it is none: the two that touch, and the carrier."""
        return (*self.bodies, *((self.carrier,) if self.carrier else ()))

    @property
    def means(self) -> ContactMotion:
        """Whether its bodies slide, roll or mesh."""
        return "slides" if not self.rolling else "meshes" if self.carrier else "rolls"

    @property
    def lengths(self) -> tuple[float, ...]:
        """Its lengths in the file (m)."""
        return tuple(map(abs, self.radii))

    @property
    def unrolled(self) -> PlacedContact | None:
        """The contact with sliding in place of rolling, None where a link holds the centres apart."""
        return None if self.carrier else replace(self, rolling=False)

    def mesh(self, slidings: Sequence[Pair], points: Points, guides: Guides) -> PlacedGear | None:
        """Rolling as a mesh of the bodies, as `PlacedGear.mesh`; None where they slide."""
        if not self.rolling:
            return None
        if self.flat:
            (centre,), (radius,) = self.centres, self.radii
            wheels, height = (self.round_links[0], self.face), -radius if self.left else radius
            return PlacedGear(self.name, wheels, (height, None), self.block, (centre, ""), slide=self.block, sense=-1)
        (first, second), (radius, other) = self.centres, self.radii
        return PlacedGear(self.name, self.bodies, (radius, other), self.carrier or self.block, (first, second))

    @property
    def kinds(self) -> tuple[str, ...]:
        """The words of its kind, the most special first."""
        if self.rolling:
            return *(("held rolling",) if self.carrier else ()), "rolling", "contact"
        return *(("flat contact",) if self.flat else ()), "contact"

    @property
    def gaps(self) -> dict[str, object]:
        """The names in its sentences."""
        sides = (f"{link}.{name}" if name else link for link, name in zip(self.bodies, self.outlines, strict=True))
        return {"contact": self.name, "first": self.bodies[0], "second": self.bodies[1], "carrier": self.carrier,
                "bar": self.block, "centre": self.centres[0],
                **dict(zip(("first_side", "second_side"), sides, strict=True))}


@dataclass(frozen=True)
class PlacedGear:
    """Two wheels with teeth, or a wheel and a rack (``bodies``): pitch circles that roll on each other, their axes held
    by ``carrier``; or two outlines that roll on each other without teeth.

    ``teeth`` are numbers of teeth with signs (negative: internal), None for a rack, or the radii of outlines (m): in
    these parts the point of contact divides the line from the first axis to the second.  ``axes`` are the points of the
    wheels' axes on the carrier (and on the wheels), "" for a rack, whose pitch line is ``guide`` of the second link and
    whose sliding pair with the carrier is ``slide``, in which it is the sliding link (``sense`` 1) or the guide (-1).
    """

    name: str
    bodies: tuple[str, str]
    teeth: tuple[float, float | None]
    carrier: str
    axes: tuple[str, str]
    guide: str = ""
    slide: str = ""
    sense: int = 1
    table: ClassVar[str] = "gears"
    roles: ClassVar[tuple[str, ...]] = ("wheel", "wheel")
    by_law: ClassVar[bool] = False
    rolling: ClassVar[bool] = True
    means: ClassVar[ContactMotion] = "meshes"
    replaced: ClassVar[bool] = False  # by links and lower pairs
    block: ClassVar[str] = ""  # no link replaces it
    lengths: ClassVar[tuple[float, ...]] = ()
    unrolled: ClassVar[None] = None

    @property
    def is_rack(self) -> bool:
        return self.teeth[1] is None

    @property
    def members(self) -> tuple[str, ...]:
        """The links without which it is none, the wheels first."""
        return tuple(dict.fromkeys((*self.bodies, self.carrier)))

    def mesh(self, slidings: Sequence[Pair], points: Points, guides: Guides) -> PlacedGear:
        """The mesh of wheels; of a rack with the signed distance (m) of its line from the wheel's axis as the first of
        the ``teeth``, positive to the left of the guide of ``slide``.

        Parameters
        ----------
        slidings : the sliding pairs of its mechanism
        points, guides : of each link, in its own axes (m)
        """
        return replace(self, teeth=(self.rack_place(slidings, points, guides)[0], None)) if self.is_rack else self

    def rack_place(
        self, slidings: Sequence[Pair], points: Points, guides: Guides
    ) -> tuple[float, float, float]:
        """The distance of a rack's pitch line to the left of the wheel's axis, seen along the guide of its slide (m);
        the sine of its angle with the guide; and a length to compare with (m)."""
        pair = next(s for s in slidings if s.key == self.slide)
        rail = guides[pair.b][pair.guide.name]

        def seen(link: str, z: complex) -> complex:
            # in the axes of the guide, but for the travel along it
            return z * pair.turn if link == pair.a else (z - rail.through) / rail.direction

        rack, line = self.bodies[1], guides[self.bodies[1]][self.guide]
        axis = seen(self.carrier, points[self.carrier][self.axes[0]])
        at = seen(rack, line.through)
        along = seen(rack, line.through + line.direction) - at
        return (at - axis).imag, cross(1 + 0j, along), abs(axis) + abs(at)

    @property
    def kinds(self) -> tuple[str, ...]:
        """The words of its kind, the most special first."""
        return *(("rack",) if self.is_rack else ()), "gear"

    @property
    def gaps(self) -> dict[str, object]:
        """The names in its sentences, and its numbers of teeth."""
        first, second = (None if teeth is None else _counted(teeth) for teeth in self.teeth)
        return {"gear": self.name, "first": self.bodies[0], "second": self.bodies[1], "carrier": self.carrier,
                "teeth_first": first, "teeth_second": second}


def _counted(teeth: float) -> Phrase | str:
    """A number of teeth; of internal ones, negative in the file, in words."""
    number = f"{abs(teeth):.6g}"
    return Phrase("internal teeth of number", number=number) if teeth < 0 else number


# cams


@dataclass(frozen=True)
class SlidingFollower:
    """A follower on a guide of the frame: the ``pair``, the ``foot`` of the cam's axis on the line (m), the sense of
    the line, the travel at the foot (m), and the ``offset`` (m), positive where the axis lies to the left of the line.
    Its point has no name (``tip``), and moves along the line as the lift grows (``side`` 1).
    """

    pair: str
    foot: complex
    along: complex
    travel: float
    offset: float
    side: ClassVar[int] = 1
    turns: ClassVar[bool] = False
    tip: ClassVar[str] = ""


@dataclass(frozen=True)
class SwingingFollower:
    """A follower that swings about ``pivot`` of the frame (at ``centre``, m): its roller's centre ``tip`` lies ``arm``
    m off, on the side of the line from pivot to cam axis on which angles grow (``side`` 1), or on the other (-1).

    ``back`` is true where the link's own axis points from tip to pivot."""

    pivot: str
    tip: str
    centre: complex
    arm: float
    side: int
    back: bool = False
    turns: ClassVar[bool] = True
    pair: ClassVar[str] = ""


class Course(NamedTuple):
    """The follower's point from the cam's axis (m), its first to third derivative by the cam's own angle, and the
    direction in which it moves, unit; complex, or arrays of complex numbers.  ``turning`` is the rate at which that
    direction turns."""

    point: Values
    first: Values
    second: Values
    third: Values
    way: Values
    turning: Values

    @property
    def tangent(self) -> Values:
        """Derivative of the pitch curve, as seen from the cam (in the axes of the frame)."""
        return self.first - 1j * self.point

    @property
    def tangent_rate(self) -> Values:
        """Its second derivative."""
        return self.second - 2j * self.first - self.point

    @property
    def jerk(self) -> Values:
        """Its third derivative."""
        return self.third - 3j * self.second - 3.0 * self.first + 1j * self.point


@dataclass(frozen=True)
class LawCam:
    """A cam that turns about ``point`` of the frame (at ``axis``, m), given by the law of its follower.

    The cam degree is ``sense`` times the link's own angle.  ``base`` is the radius of the base circle of the pitch
    curve (of the profile, where the face is flat), ``roller`` 0 of a knife edge or a flat face (m); ``allowed`` are the
    greatest pressure angles of rise and fall (rad), if the file gives them.
    """

    link: str
    follower: str
    point: str
    axis: complex
    law: FollowerLaw
    sense: int
    base: float
    roller: float
    flat: bool
    motion: SlidingFollower | SwingingFollower
    allowed: tuple[float | None, float | None] = (None, None)
    table: ClassVar[str] = "cams"
    roles: ClassVar[tuple[str, ...]] = ("cam link",)
    unrolled: ClassVar[None] = None
    by_law: ClassVar[bool] = True
    rolling: ClassVar[bool] = False
    means: ClassVar[ContactMotion] = "slides"
    carrier: ClassVar[str] = ""
    # asked of whatever moves a link: it neither rolls, nor does the scene give its value
    rolls: ClassVar[bool] = False
    given: ClassVar[bool] = False
    through: ClassVar[tuple[str, ...]] = ()
    replaced: ClassVar[bool] = True
    block: ClassVar[str] = ""

    @property
    def name(self) -> str:
        """Its name in the file, that of the cam's link."""
        return self.link

    @property
    def key(self) -> str:
        """The key by which it is distinguished from drivers."""
        return f"cam {self.link}"

    @property
    def bodies(self) -> tuple[str, str]:
        """The cam and its follower."""
        return self.link, self.follower

    members = bodies
    """The links without which it is none."""

    @property
    def lengths(self) -> tuple[float, ...]:
        """Its lengths in the file (m)."""
        return (self.base,)

    @property
    def kinds(self) -> tuple[str, ...]:
        """The word of its kind."""
        return ("cam",)

    @property
    def gaps(self) -> dict[str, object]:
        """The names in its sentences, the kind of follower, and the number of pieces of its law."""
        kind = Phrase("cam flat" if self.flat else "cam roller" if self.roller else "cam edge")
        return {"cam": self.link, "follower": self.follower, "kind": kind, "pieces": str(len(self.law.pieces))}

    def mesh(self, slidings: Sequence[Pair], points: Points, guides: Guides) -> None:
        """No mesh: its follower slides on it."""

    @property
    def turns(self) -> bool:
        """Whether its follower swings, so that the lift is an angle."""
        return self.motion.turns

    @property
    def links(self) -> tuple[str, ...]:
        """The links that give its follower's motion."""
        return (self.link,)

    @property
    def base_of_profile(self) -> float:
        """Radius of the base circle of the profile (m)."""
        return self.base - self.roller

    def leaves(self, lift: float, sense: int) -> tuple[float, float]:
        """The angle of the link's own axis (rad, 0 to a turn) from which the follower leaves its least or greatest lift
        where the cam turns in a sense, the smallest of several; and the angle of the dwell before it."""
        moving = [piece for piece in self.law.pieces if piece.low != piece.high]
        ends = [(before.end, after.start) for before, after in zip(moving[-1:] + moving[:-1], moving, strict=True)
                if after.low == lift]
        grows = sense * self.sense > 0
        return min((self.sense * (end if grows else start) % math.tau, (end - start) % math.tau) for start, end in ends)

    def course(self, lift: Lift, exp: Callable[[Values], Values] = cmath.exp) -> Course:
        """The follower's point at a lift.  Raises Unsolvable as `beginning`.

        Parameters
        ----------
        lift : with its derivatives by the degree of the cam
        exp : the exponential function, of NumPy for arrays
        """
        motion, start = self.motion, self.beginning()
        s1, s2, s3 = self.sense * lift.slope, lift.second, self.sense * lift.jerk
        if isinstance(motion, SlidingFollower):
            point = motion.foot - self.axis + motion.along * (start + lift.lift)
            e = motion.along
            return Course(point, e * s1, e * s2, e * s3, e + 0 * point, 0.0 * s1)
        line = self.axis - motion.centre
        bar = motion.arm * line / abs(line) * exp(1j * motion.side * (start + lift.lift))
        t1, t2, t3 = motion.side * s1, motion.side * s2, motion.side * s3
        third = (1j * t3 - 3.0 * t1 * t2 - 1j * t1 * t1 * t1) * bar
        return Course(motion.centre - self.axis + bar, 1j * t1 * bar, (1j * t2 - t1 * t1) * bar, third,
                      1j * motion.side * bar / motion.arm, t1)

    def beginning(self, units: Units | None = None) -> float:
        """Lift 0: of a sliding follower the distance beyond the foot (m), of a swinging one the angle of its bar from
        the line to the cam's axis (rad).

        Parameters
        ----------
        units : units of lengths in the message

        Raises
        ------
        Unsolvable : "not assembled": the follower does not come to the base circle
        """
        motion, length = self.motion, (units or Units()).of("length")
        if isinstance(motion, SlidingFollower):
            beyond = beyond_rounding(self.base, abs(motion.offset))
            if self.flat or beyond >= 0.0:
                return self.base if self.flat else math.sqrt(beyond * (self.base + abs(motion.offset)))
            said = Phrase("the line of follower passes outside the base", follower=self.follower)
            wanted = Phrase("its radius is at least the offset", length=length.said(abs(motion.offset)))
        else:
            # half the angle at the pivot of a triangle with these three sides
            a, b, c = abs(self.axis - motion.centre), motion.arm, self.base
            half = (a + b + c) / 2
            over_a, over_b, over_c = (beyond_rounding(half, side) for side in (a, b, c))
            under, over = over_a * over_b, half * over_c
            if under >= 0.0 <= over:
                return 2.0 * math.atan2(math.sqrt(under), math.sqrt(over))
            said = Phrase("follower does not reach the base circle of", follower=self.follower)
            wanted = Phrase("its radius lies between and", length=length.said(abs(a - b)), other=length.said(a + b))
        raise Unsolvable("not assembled", Problem(f"cams.{self.link}", said, wanted))

    def follower_at(self, angle: float) -> float:
        """The follower's place at an angle of the cam's own axis (rad): the travel of its sliding pair (m), or the
        angle of its own axis (rad).  Raises Unsolvable as `beginning`."""
        motion, moved = self.motion, self.beginning() + float(self.law.at(self.sense * angle).lift)
        if isinstance(motion, SlidingFollower):
            return motion.travel + moved
        line = self.axis - motion.centre
        return cmath.phase(-line if motion.back else line) + motion.side * moved


HigherPair: TypeAlias = PlacedContact | PlacedGear | LawCam
"""Two links that touch.  Every kind has a ``name`` in its ``table`` of the file (that of its point, if that has a
letter), two ``bodies`` and with them all its ``members``.  It ``means`` that they slide, roll or mesh, ``rolling``
perhaps with their centres held apart by a ``carrier``; or moves its follower ``by_law``.  A ``block`` stands for a pair
that is ``replaced``, a sliding one for a pair that is ``unrolled``, a ``mesh`` for all that rolls.  ``lengths`` (m) are
those in the file; ``kinds`` and ``gaps`` its words, ``roles`` the words for the first of its bodies, or both."""


def told(pair: Pair | CircularSlot | HigherPair, about: str) -> Phrase:
    """The sentence on a pair in a list of the table of words ("explained", "left behind", ...), by the most
    special of its kinds that has one there.

    >>> gear = PlacedGear("g", ("2", "4"), (20, None), "3", ("A", ""))
    >>> str(told(gear, "left behind"))
    'gears g of 2 and 4'
    """
    key = next(key for kind in pair.kinds if has_words(key := f"{about} {kind}"))
    return Phrase(key, **{gap: pair.gaps[gap] for gap in gaps_of(key)})
