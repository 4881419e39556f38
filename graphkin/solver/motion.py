"""The motion found: position, velocity and acceleration of every link, point and sliding pair, by name and by symbol;
and how it is found at given values of the drivers: what stands there, and where and why nothing does.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import takewhile
from typing import NamedTuple

import numpy as np

from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Measure
from graphkin.solver.assemblies import own_values
from graphkin.solver.diagnosis import singular, without_singular
from graphkin.solver.engine import positions
from graphkin.solver.joints import Drive
from graphkin.solver.pose import FIELDS, Array, Pose, rest
from graphkin.solver.quantities import Posed, value_of_symbol
from graphkin.solver.redundant import all_slides, place_redundant
from graphkin.solver.rounding import ErrorBound
from graphkin.structure import Slide, Structure
from graphkin.structure.assembly import ChangePoint
from graphkin.words import Phrase, Wording

__all__ = ["BLOCK", "SLIGHT", "Motion", "Sliding", "goal_values", "joined", "motion_of"]

BLOCK = 16384
"""Positions that are computed together."""


def goal_values(scene: Mechanism, at: Mapping[str, float] | None) -> Array:
    """The scene's driver values, but for those given by driver key, shape (drivers,).

    Raises
    ------
    CallError : a key that is no driver, a value that is no number
    """
    goal = own_values(scene)
    keys = [d.key for d in scene.drivers]
    for key, value in (at or {}).items():
        if key not in keys:
            raise CallError(Problem(f'at "{key}"', Phrase("there is no such driver"), did_you_mean(key, keys)))
        if not np.isfinite(value):
            raise CallError(Problem(f'at "{key}"', Phrase("is no driver value of value", value=value)))
        goal[keys.index(key)] = value
    return goal


def motion_of(
    structure: Structure,
    drive: Drive,
    forms: Mapping[int, Array],
    assembly: tuple[Phrase, ...],
    good: Array,
    why: Wording = "",
    fine: bool = True,
) -> Motion:
    """Positions in one pass over all driver values, their status, redundant links placed and checked.

    Parameters
    ----------
    forms : the form of each group at each position, as for ``positions``
    assembly : in words
    good, why : which positions the motion reaches, shape (n,), and why it does not reach the others
    fine : False leaves 16 digits where they are rough, and the reasons away
    """
    n = len(drive)
    if n > BLOCK:
        blocks = (slice(first, min(first + BLOCK, n)) for first in range(0, n, BLOCK))
        own = (({i: f[rows] if np.ndim(f) and len(f) == n else f for i, f in forms.items()}, rows) for rows in blocks)
        return joined((motion_of(structure, drive[r], f, assembly, good[r], why, fine) for f, r in own), n)
    state = positions(structure, drive, forms, fine=fine, each=not fine)
    status = np.where(good, "ok", "not assembled").astype("<U13")
    reasons: list[Wording] = ["" if g else why for g in good]
    if fine:
        status, reasons = without_singular(structure, state, drive.value, forms, status, reasons)
    else:
        for _, dead in singular(structure, state, n):
            status[dead & good] = "dead point"
    ok = status == "ok"
    assert state.bounds is not None
    bound = ErrorBound(*(np.where(ok, b, np.nan) for b in state.bounds))
    of_links = {name: ErrorBound(*(np.where(ok, b, np.nan) for b in own)) for name, own in state.each.items()}
    rough = (np.where(ok, state.rough[0], np.nan), np.where(ok, state.rough[1], np.nan))
    poses = {name: pose.spread(n).where(ok) for name, pose in state.poses.items()}
    poses[structure.scene.frame.name] = rest().still(n)
    place_redundant(structure, poses, ok, bound)
    slides = all_slides(structure)
    return Motion(structure, drive.value, status, tuple(reasons), poses, slides, assembly, bound, rough,
                  bounds=of_links)  # fmt: skip


def joined(blocks: Iterable[Motion], n: int) -> Motion:
    """Motions of blocks of positions, one after the other, as one of n positions.

    Each block is let go before the next is found, and what is the same at all positions, or for two links (the angle of
    a block on its guide), is kept once: fields may be read-only, or be the memory of another.
    """
    columns: dict[tuple[str, str], _Column] = {}
    reasons = list[Wording]([""] * n)
    first, some = 0, None
    for some in blocks:
        rows = slice(first, first + len(some))
        parts = {(name, f): np.broadcast_to(getattr(p, f), len(some)) for name, p in some.poses.items() for f in FIELDS}
        parts |= {("bound", str(k)): b for k, b in enumerate((*some.bound, *some.rough))}
        parts |= {("", "status"): some.status, ("", "values"): some.values}
        if not columns:
            columns = {key: _Column(n) for key in parts}
        for key, values in parts.items():
            columns[key].put(rows, values, [c for other, c in columns.items() if other[1] == key[1]])
        reasons[rows] = some.reasons
        first = rows.stop
    assert some is not None
    kept = {key: column.array for key, column in columns.items()}
    numbers = [kept["bound", str(k)] for k in range(8)]
    return replace(
        some,
        values=kept["", "values"],
        status=kept["", "status"],
        reasons=tuple(reasons),
        poses={name: Pose(*(kept[name, field] for field in FIELDS)) for name in some.poses},
        bound=ErrorBound(*numbers[:6]),
        bounds={},
        rough=(numbers[6], numbers[7]),
    )


class _Column:
    """A column of n rows that is filled from the top: one row for all as long as they are the same, bit by bit, nothing
    of its own as long as another column is the same."""

    def __init__(self, n: int) -> None:
        self.n = n
        self.like: _Column | None = None
        self.own: Array | None = None

    @property
    def array(self) -> Array:
        if self.like is not None:
            return self.like.array
        assert self.own is not None
        return self.own if len(self.own) == self.n else np.broadcast_to(self.own, (self.n, *self.own.shape[1:]))

    def put(self, rows: slice, values: Array, others: Iterable[_Column]) -> None:
        """The next rows; ``others`` that come before this one have theirs already."""
        if rows.start == 0:
            one = values[:1]
            if _same(values, np.broadcast_to(one, values.shape)):
                self.own = one.copy()
                return
            before = takewhile(lambda c: c is not self, others)
            self.like = next((c for c in before if c.like is None and _same(values, c.array[rows])), None)
            if self.like is None:
                self._spread(values[:0])[rows] = values
            return
        if self.own is not None and len(self.own) == self.n:
            self.own[rows] = values
        elif not _same(values, self.array[rows]):
            self._spread(self.array[: rows.start])[rows] = values

    def _spread(self, above: Array) -> Array:
        self.own, self.like = np.empty((self.n, *above.shape[1:]), dtype=above.dtype), None
        self.own[: len(above)] = above
        return self.own


def _same(one: Array, other: Array) -> bool:
    """Whether two arrays are the same bit by bit: minus zero is not zero, and NaN is NaN."""
    return one.dtype == other.dtype and one.tobytes() == other.tobytes()


SLIGHT = 1e-9  # of what the drivers alone make: a bound above it does not tell rounding from a small value


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

    @cached_property
    def posed(self) -> Posed:
        """The links where they are."""
        return Posed(self.structure, self.poses, self.slides)

    def link(self, name: str) -> PlacedLink:
        """A link or the block of a pin.  Raises CallError for an unknown name."""
        return self.posed.link(name)

    def point(self, point: str, link: str = "") -> Pose:
        """Axes that move with a point of a link, or with its place that lies at that pin now (see ``Posed.point``)."""
        return self.posed.point(PointRef(point, link))

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
        guide = self.posed.guide(pair)
        seen = guide.inverse().of(self.poses[pair.a])
        return Sliding(seen.z.real, seen.v.real, seen.a.real, 2j * guide.omega * guide.u * seen.v.real)

    @cached_property
    def driven(self) -> tuple[Array, Array]:
        """How fast the drivers move, and how their rates change with the square of that, of slides over the size; shape
        (n,) (rad/s, rad/s2)."""
        size = self.scene.size
        rate, second = np.zeros(len(self)), np.zeros(len(self))
        for driver in self.scene.drivers:
            if driver.turns:
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
        return value_of_symbol(self.posed, symbol)
