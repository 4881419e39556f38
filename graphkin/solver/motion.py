"""The solved motion: position, velocity and acceleration of every link, point and sliding pair, by name and by symbol;
with the status of each position and its reason.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.scene.tables import Measure
from graphkin.solver.algebra.bounds import BLOCK, FEW, Accuracy
from graphkin.solver.algebra.pose import UNIT, Array, ErrorBound, Pose
from graphkin.solver.quantities import Posed, all_slides, value_of_symbol
from graphkin.solver.sentences import assembly_words
from graphkin.structure import Structure
from graphkin.structure.assembly import ChangePoint
from graphkin.words import Phrase, Wording

SLIGHT = 1e-9  # of what the drivers alone make: a bound above it does not tell rounding from a small value


@dataclass(frozen=True, eq=False, repr=False)
class Motion:
    """A mechanism solved at n positions of its drivers.

    structure : the order of solution
    values : real, shape (n, drivers), SI
    status : str, shape (n,): "ok", "dead point" or "not assembled"
    reasons : for each position the reason why it is not "ok", else empty; `why` is in English
    poses : each moving link, the frame, and the blocks of pins, by name; NaN where the status is not ok
    modes : the assembly of each group where the motion starts; None if it is assembled nowhere
    accuracy : the source of the bounds of its errors
    reach : function to the ``DriverRange`` of the first driver; raises Unsolvable without one
    passed : the change points on the path from the scene's own position
    turned : over a sweep the angle of each link from its start, to a few degrees (rad): it gives whole turns
    onward : in a later block of a sweep, for each link the angle from which it continues (rad), less ``turned``
    """

    structure: Structure
    values: Array
    status: Array
    reasons: tuple[Wording, ...]
    poses: Mapping[str, Pose]
    modes: Mapping[int, Array] | None
    accuracy: Accuracy
    reach: Callable[[], Any]
    turned: Mapping[str, Array] = field(default_factory=dict)
    passed: tuple[ChangePoint, ...] = ()
    onward: Mapping[str, float] = field(default_factory=dict)

    @property
    def scene(self) -> Mechanism:
        return self.structure.scene

    @cached_property
    def slides(self) -> tuple[Pair, ...]:
        """The sliding pairs and pins in slots, those of redundant links included."""
        return all_slides(self.structure)

    @cached_property
    def assembly(self) -> tuple[Phrase, ...]:
        """The assembly of each group in words, in the order of ``structure.groups``."""
        if self.modes is None:
            return (Phrase("assembled nowhere"),) * len(self.structure.groups)
        return assembly_words(self.structure, self.modes)

    @cached_property
    def growing(self) -> Motion:
        """The positions in motion: of a mechanism at rest with the first driver's value growing at a unit rate."""
        if any(driver.values[1] for driver in self.scene.drivers):
            return self
        reach = self.reach()
        growing: Motion = reach.motion(reach.offsets(self.values[:, 0]), unit=True)
        return growing

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
            accuracy=self.accuracy.rows(rows),
            turned={},
            onward={},
        )

    def after(self, before: Motion) -> Motion:
        """The motion as the next block of a sweep: angles of links continue from those of the block before."""
        good = np.flatnonzero(before.ok)
        if not len(good):
            return replace(self, onward=before.onward)
        last = good[-1]
        turned = {name: before.turned[name][last] for name in self.turned}
        ends = {link.name: float(before.angle(link.name)[last]) for link in self.scene.links}
        return replace(self, onward={name: end - turned.get(name, 0.0) for name, end in ends.items()})

    @property
    def why(self) -> tuple[str, ...]:
        """For each position the reason in English why it is not "ok"; "" where it is."""
        return tuple(map(str, self.reasons))

    def said(self, position: int) -> Phrase:
        """The status of a position, and its reason."""
        return Phrase("status and why", status=Phrase(f"status {self.status[position]}"), why=self.reasons[position])

    def require(self) -> Motion:
        """Itself, if at least one position is ok.  Raises Unsolvable with the first reason otherwise."""
        if not self.ok.any():
            raise Unsolvable(str(self.status[0]), Problem(self.scene.name or "scene", self.reasons[0]))
        return self

    @cached_property
    def posed(self) -> Posed:
        """The links in their poses."""
        return Posed(self.structure, self.poses, self.slides)

    def link(self, name: str) -> PlacedLink:
        """A link or the block of a pin.  Raises CallError for an unknown name."""
        return self.posed.link(name)

    def point(self, point: str, link: str = "") -> Pose:
        """Axes that move with a point of a link, or with the link's place at that pin now (see ``Posed.point``)."""
        return self.posed.point(PointRef(point, link))

    def position(self, point: str, link: str = "") -> Array:
        """complex, shape (n,) (m)."""
        return self.point(point, link).z

    def velocity(self, point: str, link: str = "") -> Array:
        """complex, shape (n,) (m/s)."""
        return self.point(point, link).v

    def acceleration(self, point: str, link: str = "") -> Array:
        """complex, shape (n,) (m/s2)."""
        return self.point(point, link).a

    def angle(self, link: str) -> Array:
        """Angle of the link's own x axis (rad): in (-pi, pi] at the first ok position, continuous from there."""
        angle = np.angle(self.posed.pose(link).u)
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
        return self.posed.pose(link).omega

    def alpha(self, link: str) -> Array:
        """real, shape (n,) (rad/s2), counter-clockwise positive."""
        return self.posed.pose(link).alpha

    def slide(self, key: str) -> tuple[Array, Array, Array, Array]:
        """Travel, velocity and acceleration of a sliding pair or pin in slot by its key ("2/3", "B/3"), signed along
        the guide's sense, and the Coriolis acceleration 2 i omega v, a vector (complex).

        Raises CallError for an unknown one.
        """
        pair = next((s for s in self.slides if s.key == key), None)
        if pair is None:
            raise CallError.of(Phrase("slide", key=key), "there is no such sliding pair",
                               did_you_mean(key, [s.key for s in self.slides]))
        guide, seen = self.posed.guide(pair), self.posed.sliding(pair)
        return seen.z.real, seen.v.real, seen.a.real, 2j * guide.omega * guide.u * seen.v.real

    @cached_property
    def driven(self) -> tuple[Array, Array]:
        """The rate of the drivers, and their second rate with the square of it, of slides over the size; shape (n,)
        (rad/s, rad/s2)."""
        size = self.scene.size
        rate, second = np.zeros(len(self)), np.zeros(len(self))
        for driver in self.scene.drivers:
            if driver.turns:
                pose, base = self.poses[driver.link], self.poses[driver.relative_to]
                rate, second = rate + np.abs(pose.omega - base.omega), second + np.abs(pose.alpha - base.alpha)
            else:
                _, velocity, acceleration, _ = self.slide(driver.key)
                rate, second = rate + np.abs(velocity) / size, second + np.abs(acceleration) / size
        return rate, second + rate**2

    @cached_property
    def _added(self) -> Sequence[Array]:
        """The least rounding in adding a point to its link: of its place, velocity and acceleration."""
        poses = self.accuracy.poses.values()
        return [FEW * UNIT * np.max([np.abs(getattr(p, f)) for p in poses], axis=0) for f in "zva"]

    def settled(self, value: Array, measure: Measure, ends: float = 1.0) -> Array:
        """Values of a measure (SI), shape (n,), 0 where they are rounding alone; complex ones by their parts.

        A value is rounding alone if it is not above the bound of its error, and the bound is slight beside the motion
        of the drivers.  Near a dead point, where the bound is larger, no value becomes 0.

        Parameters
        ----------
        ends : the number of places whose errors it has
        """
        if np.iscomplexobj(value):
            return self.settled(value.real, measure, ends) + 1j * self.settled(value.imag, measure, ends)
        if not measure.is_of_motion:
            return value
        whole = measure.usual(self.scene.size, *self.driven)
        least = self._added[measure.order] if measure.length and measure.order < len(self._added) else 0.0
        large = np.abs(value)
        small = self.ok & (large <= ends * SLIGHT * whole)
        if not small.any():
            return value
        nothing = small & self.accuracy.clear & (large <= least)
        doubtful = np.flatnonzero(small & ~nothing & (value != 0.0))
        if len(doubtful):
            few = len(self) <= BLOCK  # then the bounds of all are found once
            bound = self.bound.of(measure)[doubtful] if few else self.accuracy.rows(doubtful).of(()).of(measure)
            slight = bound <= SLIGHT * np.broadcast_to(whole, value.shape)[doubtful]
            nothing[doubtful] = slight & (large[doubtful] <= ends * bound)
        return np.where(nothing, 0.0, value) + 0.0  # never -0

    @cached_property
    def bound(self) -> ErrorBound[Array]:
        """Bounds of the rounding errors of any point, and of the angles of links and their rates; NaN where not ok."""
        return self.accuracy.of(())

    @cached_property
    def rates_in_double(self) -> tuple[Array, Array]:
        """The bounds of velocity and acceleration of a computation in 16 digits, as of a drawing, for points as far off
        as the mechanism is large."""
        return self.bounds_in_double(())[1:]

    def bounds_in_double(self, links: Iterable[str]) -> tuple[Array, Array, Array]:
        """The bounds of some links in 16 digits: of place, velocity and acceleration."""
        size, error = self.accuracy.structure.scene.size, self.accuracy.of(links, drawn=True)
        return (
            error.position, np.maximum(error.velocity, size * error.omega),
            np.maximum(error.acceleration, size * error.alpha),
        )

    def value(self, symbol: Symbol) -> Array:
        """A quantity by its symbol: complex for vectors, real for others (m, rad, rad/s, rad/s2), shape (n,).

        Raises CallError where the symbol names nothing here.
        """
        value = value_of_symbol(self.posed, symbol)
        if symbol.kind == "d" and np.isnan(value).any() and self.growing is not self:
            value = value_of_symbol(self.growing.posed, symbol)  # centres of links at rest are those of any motion
        return value


# the points and the sliding pairs of a scene


def listed_points(scene: Mechanism, slides: Sequence[Pair]) -> tuple[tuple[PointRef, str], ...]:
    """Every point of a moving link, on every link that has it, every coincident point under a sliding pin, and the
    points of both bodies at a contact: each as in a symbol, where a pin is the same on all its links, and its link; in
    the order of the file."""
    points = [(p, link.name) for link in scene.links for p in link.points]
    moving = {link.name for link in scene.links}
    points += [(point, link) for point, pair in scene.contact_at.items() for link in pair.bodies if link in moving]
    for pair in own_slides(scene, slides):
        if pair.pin and pair.b in moving and (pair.pin, pair.b) not in points:
            points.append((pair.pin, pair.b))
    place = {link.name: i for i, link in enumerate(scene.links)}
    return tuple((PointRef(point, "" if point in scene.by_name[link].points else link), link)
                 for point, link in sorted(points, key=lambda known: place[known[1]]))


def own_slides(scene: Mechanism, slides: Sequence[Pair]) -> tuple[Pair, ...]:
    """The sliding pairs and pins in slots of the scene, and for a sliding contact with a face the slide of the disc's
    centre along it."""
    return tuple(s for s in slides if s.key not in scene.replaced_by or scene.replaced_by[s.key].replaced)
