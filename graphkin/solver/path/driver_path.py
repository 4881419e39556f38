"""A straight path of driver values, and the stretches in which groups of two links close along it: their ends, and the
change points at which two assemblies meet.

A group of two links has a discriminant: positive where it can be assembled in two modes, zero where they fall
together.  Along a path the mode is kept while it stays positive.  Where it only touches zero (a change point, the
parallelogram in line) the smooth motion changes to the other mode; where it becomes negative, the group ends.  A group
after others is searched where these close, stretch by stretch, so that none is too short to be found.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from decimal import Decimal
from functools import cached_property, partial

import numpy as np

from graphkin.search import angles_between, last_true, places_between, resolve
from graphkin.solver.algebra.dyads import TOUCH, DyadSolution
from graphkin.solver.algebra.pose import Array, Drive, rest
from graphkin.solver.compiled.engine import (
    SINGULAR,
    ExtendedPrecision,
    State,
    discriminant_of,
    newton,
    positions,
    touch,
)
from graphkin.solver.drivers import meant_value, working
from graphkin.solver.redundant import EXACTLY, redundant_poses
from graphkin.solver.sentences import limit_why
from graphkin.structure import Dyad, Structure
from graphkin.structure.assembly import ChangePoint
from graphkin.words import Phrase

FAR = 4.0
"""Sizes of the mechanism that a slide driver which nothing limits is followed to either side."""
DOUBTFUL = 1e-9
"""Where a least value is nearer to zero, fifty digits tell whether it touches."""
START = 1e-6
"""Of a path: a touch as near to its start as this is the start's own: the mode was chosen there."""
AT_END = 1e-9
"""Of a path: a touch as near to its end is not passed."""
BESIDE = 1e-5
"""Of a path: a least value farther away is another one."""
POLISHED = 1e-6
"""Of a path: so far on both sides of a root its last digit is looked for."""
STEP = Decimal(10) ** -12
PLACED = Decimal(10) ** -17
"""Of a path: a least value is placed, in fifty digits, as well as this at least."""
MOST_GROUPS = 7
"""Of so many groups all assemblies are tried."""
OFF_FLIP = 1e-6
"""Of a path: what follows a group at a change point is watched this far beside it."""
CLEAR = 3.0
"""Times the greatest turn of a link in a step: a sine that is more than that at both its ends is not zero between them,
since the two lines whose sine it is turn by twice that at most."""
FINER, FINEST, MOST_STEPS = 16, 4, 20_000
"""Into so many parts, and so many times, is divided a step that does not tell, as long as these are not more."""


def _scaled(mode: Callable[[Array], Array], by: float, t: Array) -> Array:
    return mode(np.asarray(t) * by)


def _steady(mode: Array, _: Array) -> Array:
    return mode


@dataclass(frozen=True, eq=False, repr=False)
class Path:
    """A straight path of driver values, parameter 0 .. 1, with the assembly mode of each group along it.

    ``limit`` is the parameter where the motion ends (None if it does not), ``by`` the element that ends it.
    Between two ``nodes`` no link turns by more than a few degrees.
    """

    structure: Structure
    start: Array
    end: Array
    modes: Mapping[int, Callable[[Array], Array]] = field(default_factory=dict)
    flips: Array = field(default_factory=lambda: np.zeros(0))
    limit: float | None = None
    by: int | None = None
    nodes: Array = field(default_factory=lambda: np.zeros(1))
    passed: tuple[tuple[int, float], ...] = ()

    @classmethod
    def of_driver(cls, structure: Structure, values: Array) -> Path:
        """The path of the first driver, the others at their values (rad, m): its parameter is the driver's own
        value."""
        start, end = values.astype(float), values.astype(float)
        start[0], end[0] = 0.0, 1.0
        return cls(structure, start, end)

    @property
    def reach(self) -> float:
        """The parameter that the motion reaches."""
        return 1.0 if self.limit is None else self.limit

    def values(self, t: Array) -> Array:
        """Driver values, shape (n, drivers)."""
        return np.asarray(self.start + t[:, None] * (self.end - self.start))

    def rescaled(self, by: float) -> Path:
        """The path with its end moved by a factor: nearer where the motion continues, farther where it has ended."""
        modes = {i: partial(_scaled, mode, by) for i, mode in self.modes.items()}
        nodes, flips = self.nodes / by, self.flips / by
        return replace(
            self,
            end=self.start + by * (self.end - self.start),
            modes=modes,
            flips=flips[flips < 1.0],
            limit=None if self.limit is None else self.limit / by,
            passed=tuple((i, t / by) for i, t in self.passed if t / by < 1.0),
            nodes=np.append(nodes[nodes < 1.0], 1.0) if by < 1.0 else nodes,
        )

    def mode(self, t: Array) -> dict[int, Array]:
        """The assembly mode of each group at these parameters, for ``positions``."""
        return {i: mode(t) for i, mode in self.modes.items()}

    def with_sign(self, i: int, sign: float) -> Path:
        """The path with a dyad in one of its assemblies."""
        return replace(self, modes={**self.modes, i: partial(_steady, np.asarray(sign))})

    def off_flips(self, t: Array) -> Array:
        """Parameters, those at a change point moved slightly off it, since a group has no mode there."""
        for flip in self.flips:
            t = np.where(np.abs(t - flip) < OFF_FLIP, flip + OFF_FLIP, t)
        return t

    def placed(self, t: Array, upto: int | None = None) -> State:
        """The mechanism at parameters, up to an element, without rates; beside change points."""
        t = self.off_flips(t)
        return positions(self.structure, self.drive(t), self.mode(t), upto, rates=False)

    def discriminant(self, i: int, t: Array) -> Array:
        """The discriminant of a dyad with a mode, shape (n,)."""
        solved = self.placed(t, i + 1).groups[i]
        assert isinstance(solved, DyadSolution)
        return np.broadcast_to(solved.discriminant, t.shape)

    @cached_property
    def _spans(self) -> list[tuple[Decimal, Decimal]]:
        """The start of each driver and its way to the end, in fifty digits."""
        drivers = self.structure.scene.drivers
        with working():
            starts, ends = ([meant_value(d, x) for d, x in zip(drivers, values.tolist(), strict=True)]
                            for values in (self.start, self.end))
            return [(start, end - start) for start, end in zip(starts, ends, strict=True)]

    def _meant(self, t: Decimal) -> list[Decimal]:
        """The driver values at a parameter, in fifty digits."""
        return [start + t * span for start, span in self._spans]

    def _exactly(self, i: int, t: float) -> ExtendedPrecision:
        """The discriminant of a dyad in fifty digits, with the modes at a parameter."""
        return discriminant_of(self.structure, i, self.mode(self.off_flips(np.array([t]))))

    def exact_zero(self, i: int, about: float) -> Decimal | None:
        """The parameter at which the discriminant of a dyad goes through zero, near a parameter, in fifty digits; None
        where it does not."""
        discriminant = self._exactly(i, about)
        return newton(lambda t: discriminant(*self._meant(t)), about)

    def exact_touches(self, i: int, about: float, near: float) -> tuple[Decimal, ...] | None:
        """The zeros of a dyad's discriminant near its least value, within ``near`` of a parameter, in fifty digits: one
        where it touches zero within the digits of the file; two between which it is negative; or none.  None where no
        least value is found, and after elements other than dyads."""
        if not all(e.explicit for e in self.structure.elements[:i]):
            return None
        discriminant = self._exactly(i, about)

        def value(t: Decimal) -> Decimal:
            return discriminant(*self._meant(t))

        place = touch(value, about)
        if place is None or abs(place - Decimal(about)) > near:
            return None
        with working():
            least, sign = discriminant.signed(0, self._meant(place))
            second = (value(place + STEP) + value(place - STEP) - 2 * least) / (STEP * STEP)
            if sign > 0 and least > second * PLACED**2:
                return ()
            if sign >= 0:
                return (place,)
            away = (-2 * least / second).sqrt() if second > 0 else Decimal(0)
        ends = (newton(value, place + side * away) for side in (-1, 1) if away)
        return tuple(end for end in ends if end is not None)

    @cached_property
    def change_points(self) -> tuple[ChangePoint, ...]:
        """The change points on the path, at which two assemblies of a group meet and the motion continues smoothly, in
        order."""
        points = []
        for i, t in sorted(self.passed, key=lambda passed: passed[1]):
            element = self.structure.elements[i]
            if t < self.reach and element.order > 1:
                points.append(ChangePoint(element.links, tuple(self.values(np.array([t]))[0].tolist())))
        return tuple(points)

    def why_ended(self, between: tuple[float, float] | None = None) -> Phrase:
        """The reason why it ends, and the values between which the motion runs, if these are known."""
        end = self.values(np.array([self.reach]))[0].tolist()
        return limit_why(self.structure, self.by or 0, np.flatnonzero(self.end != self.start).tolist(), end, between)

    @cached_property
    def last_modes(self) -> dict[int, Array]:
        """The assembly mode of each group at the end of the path."""
        return {i: mode[0] for i, mode in self.mode(np.ones(1)).items()}

    def turned(self, t: Array) -> dict[str, Array]:
        """The angle of each link from the start (rad), whole turns included, to a few degrees."""
        return {name: self.turned_of(name, t) for name in self.angles}

    def turned_of(self, link: str, t: Array) -> Array:
        """The angle of a link from the start."""
        return np.asarray(np.interp(t, self.nodes, self.angles[link]) - self.angles[link][0])

    @cached_property
    def angles(self) -> dict[str, Array]:
        """The angle of each link at the nodes (rad), without jumps; in (-pi, pi] at the start, also in a dead point."""
        angles, n = dict[str, Array](), len(self.nodes)
        poses = {name: pose.spread(n) for name, pose in self.placed(self.nodes).poses.items()}
        poses[self.structure.scene.frame.name] = rest().still(n)
        if any(link.redundant for link in self.structure.scene.links):
            poses |= redundant_poses(self.structure, poses, np.zeros(n, dtype=bool), EXACTLY)
        for name, pose in poses.items():
            u = np.nan_to_num(pose.u, nan=1.0)
            angles[name] = np.angle(u[0]) + turning(u)
        return angles

    @cached_property
    def clear(self) -> Array:
        """The steps between nodes, or parts of them, in which every dyad keeps its assembly and stays away from its
        dead points: the parameters at which each begins and ends, shape (steps, 2)."""
        nodes, steps = self.nodes[self.nodes <= self.reach], list[Array]()
        begin, end = nodes[:-1], nodes[1:]
        for _ in range(FINEST):
            t = np.concatenate([begin, end])
            solved = positions(self.structure, self.drive(t), self.mode(t), rates=False)
            dyads = (group for group in solved.groups.values() if isinstance(group, DyadSolution))
            sines = [np.abs(np.broadcast_to(dyad.sine, t.shape)) for dyad in dyads]
            sine = np.min([np.ones(len(t)), *sines], axis=0).reshape(2, -1).min(axis=0)
            axes = np.array([np.broadcast_to(pose.u, t.shape) for pose in solved.poses.values()])
            turn = np.abs(np.angle(axes[:, len(end) :] / axes[:, : len(end)])).max(axis=0)
            known = (sine > CLEAR * turn) & (sine > SINGULAR)
            steps.append(np.stack([begin[known], end[known]], axis=1))
            finer = np.linspace(begin[~known], end[~known], FINER + 1)
            begin, end = finer[:-1].ravel(), finer[1:].ravel()
            if not 0 < len(end) <= MOST_STEPS:
                break
        return np.concatenate(steps)

    def drive(self, t: Array) -> Drive:
        """The drivers with rates by the path parameter."""
        value = self.values(t)
        return Drive(value, np.broadcast_to(self.end - self.start, value.shape), np.zeros_like(value))


def turning(u: Array) -> Array:
    """The angles (rad), whole turns included, by which a direction has turned since the first position, where it turns
    by less than half a turn from one position to the next."""
    return np.concatenate(([0.0], np.cumsum(np.angle(u[1:] * np.conj(u[:-1])))))


@dataclass(frozen=True)
class Stretch:
    """A stretch of a path in which a group closes, or the whole mechanism.

    low, high : its ends (parameters; of the first driver's path its values)
    ends : whether the motion ends there, or is only followed so far
    touches : change points inside, in increasing order
    """

    low: float
    high: float
    ends: tuple[bool, bool] = (False, False)
    touches: tuple[float, ...] = ()


def stretches(path: Path, i: int, low: float, high: float) -> list[Stretch]:
    """The stretches in which a dyad of a path closes, in increasing order, between two parameters between which all
    earlier ones close."""

    return closed(lambda t: path.discriminant(i, t), low, high,
                  lambda about: path.exact_touches(i, about, BESIDE * (high - low)), path.flips)


def closed(
    gap: Callable[[Array], Array], low: float, high: float,
    touching: Callable[[float], Sequence[Decimal] | None] = lambda _: None, seams: Collection[float] | Array = (),
) -> list[Stretch]:
    """The stretches between two places in which a discriminant is not negative.

    It is represented over an angle whose cosine runs from one place to the other: as a function of that angle it is
    smooth up to the ends of earlier groups.

    Parameters
    ----------
    gap : function of places, shape (n,), to values, shape (n,), without a unit
    touching : function that finds its zeros near a least value more exactly, see ``Path.exact_touches``
    seams : places at which it may be rough
    """
    wide = high - low
    if not wide > 0.0:
        return [Stretch(low, high)]

    def place(angle: Array) -> Array:
        return places_between(angle, low, high)

    known = np.sort(np.array([*seams]))
    known = known[(known > low + START * wide) & (known < high - START * wide)]
    known = known[np.diff(known, prepend=-np.inf) > OFF_FLIP]  # several groups may pass one together
    inner = angles_between(known, low, high)
    pieces = resolve(lambda angle: (gap(place(angle))[:, None], np.zeros((len(angle), 1))), 0.0, math.pi, floor=1.0,
                     seams=inner)
    roots, rests = map(place, pieces.near_zero(0, DOUBTFUL))
    touches, below = list[float](), list[tuple[float, float]]()
    if len(known):
        # where an earlier group passes a change point it is watched beside that: as a square it is a hundredth there
        least, before, behind = (gap(known + away) for away in (0.0, -10 * OFF_FLIP, 10 * OFF_FLIP))
        touches += known[least < 0.03 * np.minimum(before, behind)].tolist()
    for at in touches:
        rests = rests[np.abs(rests - at) > 2 * OFF_FLIP]
        roots = roots[np.abs(gap((roots + at) / 2)) > DOUBTFUL] if len(roots) else roots
    for at, value in zip(rests.tolist(), gap(rests).tolist() if len(rests) else [], strict=True):
        beside = gap(np.clip(np.array([at - BESIDE * wide, at + BESIDE * wide]), low, high))
        if not abs(value) < DOUBTFUL or not (beside > value).all():
            continue
        zeros = touching(at)
        if zeros is None and abs(value) > TOUCH:
            continue
        zeros = (Decimal(at),) if zeros is None else zeros
        # a root beside it is of the same zero
        roots = roots[np.abs(gap((roots + at) / 2)) > DOUBTFUL] if len(roots) else roots
        if len(zeros) == 1 and low + START * wide < zeros[0] < high - AT_END * wide:
            touches.append(float(zeros[0]))
        if len(zeros) == 2:
            below.append((float(zeros[0]), float(zeros[1])))
    cuts = np.unique([low, *roots, *(end for dip in below for end in dip), high])
    middles = (cuts[1:] + cuts[:-1]) / 2
    # what has no roots but rounding ends nothing, as lines that always lie in one
    closing = ~(gap(middles) < (0.0 if len(middles) > 1 else -TOUCH))
    # it may begin and end at zero, but for rounding
    for k, end, next_ in ((0, low, cuts[1]), (-1, high, cuts[-2])):
        closing[k] |= abs(end - next_) < AT_END * wide and bool(gap(np.array([end]))[0] >= -TOUCH)
    for dip in below:
        closing &= ~((middles > dip[0]) & (middles < dip[1]))
    changes = np.flatnonzero(closing[1:] != closing[:-1]) + 1
    ends = [float(cuts[k]) if any(cuts[k] in dip for dip in below) else
            _polished(gap, float(cuts[k]), middles[k - 1 : k + 1][:: 1 if closing[k - 1] else -1], POLISHED * wide)
            for k in changes]
    edges = [*([low] if closing[0] else []), *ends, *([high] if closing[-1] else [])]
    return [
        Stretch(a, b, (a in ends, b in ends), tuple(sorted(t for t in touches if a < t < b)))
        for a, b in zip(edges[::2], edges[1::2], strict=True)
    ]


def _polished(gap: Callable[[Array], Array], root: float, sides: Array, near: float) -> float:
    """The last place at which a discriminant is not negative, near a root; the places on both sides of it, first that
    where it is negative."""
    inside, outside = (root + float(np.clip(side - root, -near, near)) for side in sides)
    if (gap(np.array([inside, outside])) >= 0.0).tolist() != [True, False]:
        return root
    return last_true(lambda t: gap(t) >= 0.0, inside, outside)


def assembled(
    path: Path, dyads: Sequence[int], low: float, high: float, signs: Mapping[int, float]
) -> Iterator[tuple[Path, Stretch]]:
    """The stretches of a path in which some dyads close in turn, each with the path on which these have their modes.

    Parameters
    ----------
    dyads : by their indices among the elements
    signs : the assemblies that are given; of the other dyads both are tried
    """
    if not dyads:
        yield path, Stretch(low, high)
        return
    i, *behind = dyads
    group, parts = path.structure.elements[i], list[Stretch]()
    for sign in (signs[i],) if i in signs else (1.0, -1.0):
        tried = path.with_sign(i, sign)
        # only of two lines it depends on the sign where they cross
        parts = parts if parts and not (isinstance(group, Dyad) and group.is_two_lines) else (
            stretches(tried, i, low, high))
        for stretch in parts:
            if behind:
                yield from assembled(tried, behind, stretch.low, stretch.high, signs)
            else:
                yield tried, stretch


def not_tried(structure: Structure) -> list[tuple[str, ...]]:
    """Links of groups after too many others to try all their assemblies."""
    return [group.links for group in [*structure.dyads.values()][MOST_GROUPS:]]
