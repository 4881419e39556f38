"""The motion found: position, velocity and acceleration of every link, point and sliding pair, by name and by symbol.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean
from graphkin.plane import dot
from graphkin.scene.model import AngleDriver, Mechanism, PlacedLink
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Measure
from graphkin.solver.pose import Array, Pose
from graphkin.solver.rounding import ErrorBound
from graphkin.structure import Cluster, Slide, Structure, links_of
from graphkin.structure.assembly import ChangePoint
from graphkin.words import Phrase, Wording

__all__ = ["SLIGHT", "Motion", "Sliding", "evaluate"]

SLIGHT = 1e-9  # of what the drivers alone make: a bound above it does not tell rounding from a small value


def evaluate(motion: Motion, symbol: Symbol) -> Array:
    """The value of a symbol (see ``Motion.value``)."""
    if symbol.kind == "omega":
        return motion.omega(symbol.link)
    if symbol.kind == "alpha":
        return motion.alpha(symbol.link)
    if symbol.scope == "force":
        raise CallError(Problem(str(symbol), Phrase("is no motion"), Phrase("forces stand in solve of a scene with")))
    if symbol.scope != "motion":
        from graphkin.solver.position_values import position

        return position(motion.structure, motion.poses, symbol)
    assert symbol.of is not None
    if symbol.kind in ("v", "a"):
        one = motion.point(symbol.of.point, symbol.of.link)
        if symbol.to is None:
            return np.asarray(one.v if symbol.kind == "v" else one.a)
        two = motion.point(symbol.to.point, symbol.to.link)
        return np.asarray(one.v - two.v if symbol.kind == "v" else one.a - two.a)
    curved = symbol.to is not None and symbol.of.point == symbol.to.point and _curved(motion, symbol)
    if curved and symbol.kind in ("an", "ar"):
        assert symbol.to is not None
        whole = _sliding(motion, symbol, symbol.of, symbol.to)
        across = 1j * motion.poses[curved.b].u * curved.guide.direction
        bent = across * dot(across, whole)
        return np.asarray(bent if symbol.kind == "an" else whole - bent)
    if symbol.to is not None and symbol.of.point == symbol.to.point and _touches(motion, symbol.of, symbol.to):
        return _at_contact(motion, symbol, symbol.of, symbol.to)
    hinge = _hinge(motion, symbol.of, symbol.to)
    if symbol.to is not None and hinge is not None:
        return _turned(motion, symbol, symbol.of, symbol.to, hinge)
    if symbol.kind in ("an", "at"):
        return _turning(motion, symbol, symbol.of)
    assert symbol.to is not None
    return _sliding(motion, symbol, symbol.of, symbol.to)


def _curved(motion: Motion, symbol: Symbol) -> Slide | None:
    """The curved guide on which a point slides, if it does."""
    assert symbol.of is not None
    links = {symbol.of.link, symbol.to.link if symbol.to else ""}
    return next((s for s in motion.slides if s.guide.curvature and s.pin == symbol.of.point and s.b in links), None)


def _touches(motion: Motion, of: PointRef, to: PointRef) -> bool:
    return any(c.name == of.point and {of.link, to.link} == set(c.links) for c in motion.scene.contacts)


def _at_contact(motion: Motion, symbol: Symbol, of: PointRef, to: PointRef) -> Array:
    """Coriolis term of the slip at a contact, and what is left of the relative acceleration: along the normal by the
    curvatures, along the tangent."""
    contact = next(c for c in motion.scene.contacts if c.name == of.point)
    one, two = motion.point(of.point, of.link), motion.point(to.point, to.link)
    coriolis = 2j * motion.poses[to.link].omega * (one.v - two.v)
    if symbol.kind == "ak":
        return np.asarray(coriolis)
    # the centre of a disc lies on the normal
    disc = contact.round[0]
    normal = one.z - motion.point(disc.centre, disc.link).z
    if disc.radius == 0.0 and len(contact.round) > 1:
        disc = contact.round[1]
        normal = one.z - motion.point(disc.centre, disc.link).z
    normal = normal / np.abs(normal)
    left = one.a - two.a - coriolis
    across = normal * dot(normal, left)
    return np.asarray(across if symbol.kind == "an" else left - across)


def _is_on(motion: Motion, ref: PointRef, link: str) -> bool:
    """True where the point is one of the link's, or the link's point under that pin."""
    holders = motion.scene.holders
    held = holders.get(ref.point, ())
    if not held:
        motion.point(ref.point, ref.link)
    if ref.link == link:
        return True
    own = not ref.link or ref.link in held
    return own and (link in held or ref.point in motion.link(link).points)


def _hinge(motion: Motion, of: PointRef, to: PointRef | None) -> str | None:
    """The turning pair between the links of two coincident points, where it lies elsewhere."""
    if to is None or of.point != to.point or not (of.link and to.link) or of.link == to.link:
        return None
    links = motion.scene.by_name
    if not {of.link, to.link} <= set(links):
        return None
    return next((p for p in links[of.link].points if p in links[to.link].points and p != of.point), None)


def _turned(motion: Motion, symbol: Symbol, of: PointRef, to: PointRef, hinge: str) -> Array:
    """Parts of the acceleration of a point of a link relative to the coincident one of a link that is hinged to it.

    Seen from the second link the first turns about the hinge at the difference of their rates: normal and tangential
    part of that turn, or both together, and the Coriolis term of the second link's own rate.
    """
    one, base = motion.poses[of.link], motion.poses[to.link]
    arm = motion.point(of.point, of.link).z - motion.point(hinge, of.link).z
    rate = one.omega - base.omega
    normal, tangential = -(rate**2) * arm, 1j * (one.alpha - base.alpha) * arm
    parts = {"an": normal, "at": tangential, "ar": normal + tangential, "ak": -2 * base.omega * rate * arm}
    return np.asarray(parts[symbol.kind])


def _turning(motion: Motion, symbol: Symbol, of: PointRef) -> Array:
    """Normal and tangential part of the acceleration of one point of a link about another."""
    if of.link:
        motion.link(of.link)
    frame = motion.scene.frame
    replacing_links = [name for name in motion.structure.links if name not in motion.scene.by_name]
    for name in (*(link.name for link in motion.scene.links), *replacing_links):
        if not _is_on(motion, of, name):
            continue
        pose = motion.poses[name]
        at = motion.point(of.point, name)
        if symbol.to is not None:
            if not _is_on(motion, symbol.to, name):
                continue
            arm = at.z - motion.point(symbol.to.point, name).z
        else:
            pivot = next((p for p in motion.link(name).points if p in frame.points and p != of.point), None)
            if pivot is None:
                continue
            arm = at.z - motion.point(pivot, name).z
        return np.asarray(-(pose.omega**2) * arm if symbol.kind == "an" else 1j * pose.alpha * arm)
    wanted = (
        Phrase("both points must be on one link")
        if symbol.to
        else Phrase("turns about no fixed point write a with", name=of, symbol=symbol)
    )
    raise CallError(Problem(str(symbol), Phrase("no link makes this part"), wanted))


def _sliding(motion: Motion, symbol: Symbol, of: PointRef, to: PointRef) -> Array:
    """Coriolis and sliding part of the acceleration of a point relative to the coincident one of another link."""
    for ref in (of, to):
        motion.point(ref.point, ref.link)
    for pair in motion.slides:
        block = {pair.a}
        if pair.slot:
            block = {pin.of for pin in motion.scene.pins if pin.key == pair.key}
            block |= {c.round[0].link for c in motion.scene.contacts if c.block == pair.key}
        for slides, guides in ((of, to), (to, of)):
            if of.point != to.point or not any(_is_on(motion, slides, name) for name in block):
                continue
            # another link that is pinned there too has another rate, and so another Coriolis term
            if guides.link == pair.b or (not guides.link and _is_on(motion, guides, pair.b)):
                return _apart(motion, symbol, of, to, pair.b)
    # links of a group that are drawn as one, seen from one of them
    together = [{*group.members} for group in motion.structure.groups if isinstance(group, Cluster)]
    if of.point == to.point and any({of.link, to.link} <= members for members in together):
        return _apart(motion, symbol, of, to, to.link)
    pairs = [s for s in motion.slides if s.pin]
    example = (
        Phrase(
            "write for example of kind and pin and other and pin_2",
            kind=symbol.kind,
            pin=pairs[0].pin,
            other=pairs[0].b,
            pin_2=pairs[0].pin,
        )
        if pairs
        else Phrase("nothing slides here")
    )
    raise CallError(
        Problem(str(symbol), Phrase("these are not coincident points of two links"), example)
    )


def _apart(motion: Motion, symbol: Symbol, of: PointRef, to: PointRef, base: str) -> Array:
    """Coriolis term by the turning of a link, or what is left of the acceleration of one point relative to another."""
    first, second = motion.point(of.point, of.link), motion.point(to.point, to.link)
    coriolis = 2j * motion.poses[base].omega * (first.v - second.v)
    return np.asarray(coriolis if symbol.kind == "ak" else first.a - second.a - coriolis)


class Sliding(NamedTuple):
    """A sliding pair's motion, signed along the guide's sense; ``coriolis`` is a vector (complex), 2 i omega v."""

    travel: Array
    velocity: Array
    acceleration: Array
    coriolis: Array


@dataclass(frozen=True)
class Motion:
    """A mechanism solved at n positions of its drivers.

    structure : the order of solution
    values : real, shape (n, drivers), SI
    status : str, shape (n,): "ok", "dead point" or "not assembled"
    reasons : for each position why it is not "ok", empty where it is; `why` is the same in English
    poses : each moving link, the frame, and the blocks of pins, by name; NaN where the status is not ok
    slides : the sliding pairs and pins in slots, those of redundant links included
    assembly : for each group, in the order of ``structure.groups``, which assembly was taken
    bound : how far rounding may have moved any point, and the angles of links and their rates; NaN where not ok
    rough : what the bounds of velocity and acceleration would be if all were computed in 16 digits, as a drawing is
    bounds : the same of each link alone, along curves of a mechanism of dyads; else empty
    passed : the change points on the way here from the scene's own position
    turned : over a sweep how far each link has turned since its start, to a few degrees (rad): tells whole turns
    onward : in a later block of a sweep, for each link the angle from which it goes on (rad), less what is ``turned``
    """

    structure: Structure
    values: Array
    status: Array
    reasons: tuple[Wording, ...]
    poses: Mapping[str, Pose]
    slides: tuple[Slide, ...]
    assembly: tuple[Phrase, ...]
    bound: ErrorBound[Array]
    rough: tuple[Array, Array]
    turned: Mapping[str, Array] = field(default_factory=dict)
    passed: tuple[ChangePoint, ...] = ()
    bounds: Mapping[str, ErrorBound[Array]] = field(default_factory=dict)
    onward: Mapping[str, float] = field(default_factory=dict)

    @property
    def scene(self) -> Mechanism:
        return self.structure.scene

    @property
    def ok(self) -> Array:
        """bool, shape (n,)."""
        return np.asarray(self.status == "ok")

    def __len__(self) -> int:
        return len(self.values)

    def rows(self, rows: slice) -> Motion:
        """Some of the positions, in the same memory; angles of links begin anew."""
        return replace(
            self,
            values=self.values[rows],
            status=self.status[rows],
            reasons=self.reasons[rows],
            poses={name: pose.rows(rows) for name, pose in self.poses.items()},
            bound=ErrorBound(*(b[rows] for b in self.bound)),
            bounds={name: ErrorBound(*(b[rows] for b in own)) for name, own in self.bounds.items()},
            rough=(self.rough[0][rows], self.rough[1][rows]),
            turned={},
            onward={},
        )

    def after(self, before: Motion) -> Motion:
        """The same as the next block of a sweep: angles of links go on from those of the block before."""
        good = np.flatnonzero(before.ok)
        if not len(good):
            return replace(self, onward=before.onward)
        last = good[-1]
        turned = {name: before.turned[name][last] for name in self.turned}
        ends = {link.name: float(before.angle(link.name)[last]) for link in self.scene.links}
        return replace(self, onward={name: end - turned.get(name, 0.0) for name, end in ends.items()})

    @property
    def why(self) -> tuple[str, ...]:
        """Why a position is not "ok", in English, for each position; "" where it is."""
        return tuple(map(str, self.reasons))

    def said(self, position: int) -> Phrase:
        """The status of a position, and why it is not "ok"."""
        return Phrase("status and why", status=Phrase(f"status {self.status[position]}"), why=self.reasons[position])

    def require(self) -> Motion:
        """Itself, if at least one position is ok.  Raises Unsolvable with the first reason otherwise."""
        if not self.ok.any():
            raise Unsolvable(str(self.status[0]), Problem(self.scene.name or "scene", self.reasons[0]))
        return self

    def link(self, name: str) -> PlacedLink:
        """A link or the block of a pin.  Raises CallError for an unknown name."""
        if name in self.structure.links:
            return self.structure.links[name]
        if name in self.scene.by_name:
            return self.scene.by_name[name]
        raise CallError(
            Problem(Phrase("link", name=name), Phrase("there is no such link"), did_you_mean(name, self.scene.by_name))
        )

    def point(self, point: str, link: str = "") -> Pose:
        """Axes that move with ``link``, their origin at ``point`` of it, or at its point that lies at that pin now.

        Without a link the pin itself: the point of any link that has it, the frame first; of a contact the place where
        it is made, which runs along both outlines.
        """
        of = self.link(link or self._holder(point))
        pose = self.poses[of.name]
        if point in of.points:
            return pose.fixed(of.points[point])
        at = self.link(self._holder(point))
        return pose.carrying(self.poses[at.name].fixed(at.points[point]).z)

    def _holder(self, point: str) -> str:
        """Of the links that have a point the frame, or the first in the order of solution, which is told best; of a
        point of contact what stands for the contact."""
        if point in self.scene.holders:
            order = {name: i for i, e in enumerate(self.structure.elements) for name in links_of(e)}
            order[self.scene.frame.name] = -1
            return min(self.scene.holders[point], key=lambda name: order.get(name, len(order)))
        held = next((name for name, link in self.structure.links.items() if point in link.points), None)
        if held is None:
            known = did_you_mean(point, [*self.scene.holders, *(c.name for c in self.scene.contacts)])
            raise CallError(Problem(Phrase("point of point", point=point), Phrase("there is no such point"), known))
        return held

    def position(self, point: str, link: str = "") -> Array:
        """complex, shape (n,) (m)."""
        return np.asarray(self.point(point, link).z)

    def velocity(self, point: str, link: str = "") -> Array:
        """complex, shape (n,) (m/s)."""
        return np.asarray(self.point(point, link).v)

    def acceleration(self, point: str, link: str = "") -> Array:
        """complex, shape (n,) (m/s2)."""
        return np.asarray(self.point(point, link).a)

    def angle(self, link: str) -> Array:
        """Angle of the link's own x axis (rad): in (-pi, pi] at the first ok position, continuous from there."""
        angle = np.angle(self.poses[self.link(link).name].u)
        angle = np.where(angle == -np.pi, np.pi, angle)
        good = self.ok
        out = np.full(len(self), np.nan)
        out[good] = angle[good]
        if not good.any() or (len(self) == 1 and link not in self.onward):
            return out
        first = int(np.argmax(good))
        turned = self.turned.get(link)
        if turned is None:
            out[good] = np.unwrap(angle[good])
            since = np.full(1, self.onward.get(link, out[first]))
            return np.asarray(out + 2 * np.pi * np.rint((since - out[first]) / (2 * np.pi)))
        since = self.onward.get(link, angle[first] - turned[first]) + turned
        return np.asarray(out + 2 * np.pi * np.rint((since - out) / (2 * np.pi)))

    def omega(self, link: str) -> Array:
        """real, shape (n,) (rad/s), counter-clockwise positive."""
        return np.asarray(self.poses[self.link(link).name].omega)

    def alpha(self, link: str) -> Array:
        """real, shape (n,) (rad/s2), counter-clockwise positive."""
        return np.asarray(self.poses[self.link(link).name].alpha)

    def slide(self, key: str) -> Sliding:
        """A sliding pair or pin in slot by its key ("2/3", "B/3").  Raises CallError for an unknown one."""
        pair = next((s for s in self.slides if s.key == key), None)
        if pair is None:
            raise CallError(
                Problem(
                    Phrase("slide", key=key),
                    Phrase("there is no such sliding pair"),
                    did_you_mean(key, [s.key for s in self.slides]),
                )
            )
        guide = self.poses[pair.b].fixed(pair.guide.through, pair.guide.direction)
        seen = guide.inverse().of(self.poses[pair.a])
        return Sliding(seen.z.real, seen.v.real, seen.a.real, 2j * guide.omega * guide.u * seen.v.real)

    @cached_property
    def driven(self) -> tuple[Array, Array]:
        """How fast the drivers move, and how their rates change with the square of that, of slides over the size; shape
        (n,) (rad/s, rad/s2)."""
        size = self.scene.size
        rate, second = np.zeros(len(self)), np.zeros(len(self))
        for driver in self.scene.drivers:
            if isinstance(driver, AngleDriver):
                one, two = self.poses[driver.link], self.poses[driver.relative_to]
                rate, second = rate + np.abs(one.omega - two.omega), second + np.abs(one.alpha - two.alpha)
            else:
                slide = self.slide(driver.key)
                rate, second = rate + np.abs(slide.velocity) / size, second + np.abs(slide.acceleration) / size
        return rate, second + rate**2

    @cached_property
    def floors(self) -> Mapping[Measure, Array]:
        """What is not above it is nothing but rounding, by measure, shape (n,) (SI): the bound of the error, as far as
        that is slight beside the motion of the drivers.  Where it is more, beside a dead point, nothing is called 0."""
        size = self.scene.size
        rate, second = self.driven
        pairs: dict[Measure, tuple[Array, Array | float]] = {
            "length": (self.bound.position, size), "velocity": (self.bound.velocity, rate * size),
            "acceleration": (self.bound.acceleration, second * size), "angle": (self.bound.angle, 1.0),
            "angular velocity": (self.bound.omega, rate), "angular acceleration": (self.bound.alpha, second),
        }  # fmt: skip
        return {measure: np.where(bound <= SLIGHT * whole, bound, 0.0) for measure, (bound, whole) in pairs.items()}

    def bound_of(self, links: Iterable[str]) -> ErrorBound[Array]:
        """How far rounding may have moved any of these links; any link at all where that is not known of each."""
        held = [self.bounds.get(name) for name in links if name != self.scene.frame.name]
        found = [bound for bound in held if bound is not None]
        if not found or len(found) < len(held):
            return self.bound
        return ErrorBound(*(np.maximum.reduce(some) for some in zip(*found, strict=True)))

    def value(self, symbol: Symbol) -> Array:
        """A quantity by its symbol: complex for vectors, real for others (m, rad, rad/s, rad/s2), shape (n,).

        Raises CallError where the symbol names nothing here.
        """
        return evaluate(self, symbol)
