"""Other programs on the same work, where they are installed and can do it; one that cannot is named with the reason.

``graphkin study speed-accuracy`` finds it here: whoever races other programs does so from the repository."""

from __future__ import annotations

import cmath
import importlib.util
import math
import warnings
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from graphkin.races.methods import Numeric
from graphkin.races.work import FINE, Entry, Skipped, Work, best_time
from graphkin.scene.model import Driver
from graphkin.solver.algebra.pose import Array
from graphkin.structure import Driven, Dyad

if TYPE_CHECKING:
    from pylinkage.components import Component
    from pylinkage.simulation import Linkage

__all__ = ["PEERS", "pylinkage", "scipy_root"]



def _need(name: str) -> None:
    if importlib.util.find_spec(name) is None:
        raise Skipped("not installed")


def pylinkage(work: Work, repeats: int) -> Iterator[Entry]:
    """pylinkage's compiled sweep with velocities and accelerations (``step_fast_with_kinematics``).

    Raises
    ------
    Skipped : it is not installed, or has no counterpart to one of the groups
    """
    _need("pylinkage")
    if not work.full or len(work.scene.drivers) > 1:
        raise Skipped("one crank")
    if work.scene.drivers[0].values[2]:
        raise Skipped("steady")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = _Model(work)
        places, velocity, acceleration = _complex(model.linkage(FINE).step_fast_with_kinematics(FINE))
        rows = [_row(model, places, work, k) for k in range(len(work.values))]
        outputs = [o for o in work.outputs if not o.link and o.point in model.at]
        own = work.only(outputs)
        columns = [model.at[o.point] for o in outputs]
        v = velocity[rows][:, columns].T
        a = acceleration[rows][:, columns].T
        count = work.count
        linkage = model.linkage(count)
        cost = best_time(lambda: linkage.step_fast_with_kinematics(count), repeats) / count
    yield Entry("peer", "pylinkage", "", (cost, cost), own.errors(v, a))


def _complex(found: Iterable[Array]) -> tuple[Array, Array, Array]:
    """Places, velocities, accelerations of all points as complex numbers, shape (positions, points)."""
    places, velocity, acceleration = (f[..., 0] + 1j * f[..., 1] for f in found)
    return places, velocity, acceleration


def _row(model: _Model, places: Array, work: Work, k: int) -> int:
    """The row of a sweep at which the crank stands as at a place."""
    crank = places[:, model.crank_at] - model.pivot
    right = cmath.rect(1.0, float(work.values[k, 0]) + model.lead)
    return int(np.argmin(np.abs(crank / np.abs(crank) - right)))


class _Model:
    """The scene in pylinkage's terms: points on other points."""

    def __init__(self, work: Work) -> None:
        from pylinkage.components import Ground

        self.work, self.structure = work, work.structure
        self.motion = work.motion
        self.parts: list[Component] = []
        self.at: dict[str, int] = {}
        frame = work.scene.frame
        for point, z in frame.points.items():
            self._add(point, Ground(z.real, z.imag, name=point))
        for element in self.structure.elements:
            if isinstance(element, Driven):
                self._crank(element)
            elif isinstance(element, Dyad):
                self._dyad(element)
        if not any(o.point in self.at for o in work.outputs):
            raise Skipped("points")

    def linkage(self, count: int) -> Linkage:
        """What turns fully in so many steps."""
        from pylinkage.simulation import Linkage

        driver = self.work.scene.drivers[0]
        self.crank.angular_velocity = math.copysign(2 * math.pi / count, driver.values[1])
        made = Linkage(list(self.parts))
        made.set_input_velocity(self.crank, omega=driver.values[1], alpha=0.0)
        made.compile()
        return made

    def _here(self, point: str) -> complex:
        return complex(self.motion.position(point)[0])

    def _add(self, point: str, part: Component) -> None:
        self.at[point] = len(self.parts)
        self.parts.append(part)

    def _part(self, point: str) -> Component:
        return self.parts[self.at[point]]

    def _crank(self, element: Driven) -> None:
        from pylinkage.actuators import Crank

        driver, frame = element.driver, self.work.scene.frame
        turns = isinstance(driver, Driver) and driver.turns and driver.relative_to == frame.name
        if not turns or not element.pair.turns:
            raise Skipped("one crank")
        points = self.structure.links[element.link].points
        pivot = points[element.pair.point]
        far = max(points, key=lambda p: abs(points[p] - pivot))
        arm = points[far] - pivot
        self.pivot, self.lead = self._here(element.pair.point), cmath.phase(arm)
        start = cmath.phase(self._here(far) - self.pivot)
        self.crank = Crank(
            anchor=self._part(element.pair.point), radius=abs(arm), angular_velocity=1e-2, initial_angle=start, name=far
        )
        self.crank_at = len(self.parts)
        self._add(far, self.crank)
        self._rest(element.link)

    def _anchor(self, point: str) -> Component:
        part = self._part(point)
        return part.output if part is self.crank else part

    def _rest(self, link: str) -> None:
        """Further points of a link of which two stand."""
        from pylinkage.dyads import FixedDyad

        points = self.structure.links[link].points
        known = [p for p in points if p in self.at]
        for point in points:
            if point in self.at:
                continue
            if len(known) < 2:
                raise Skipped("points")
            p, q = known[0], max(known[1:], key=lambda n: abs(points[n] - points[known[0]]))
            arm = (points[point] - points[p]) / (points[q] - points[p])
            self._add(point, FixedDyad(
                anchor1=self._anchor(p), anchor2=self._anchor(q), distance=abs(points[point] - points[p]),
                angle=cmath.phase(arm), name=point,
            ))

    def _dyad(self, dyad: Dyad) -> None:
        if any(body.joints for body in dyad.bodies):
            raise Skipped("one crank")
        if dyad.kind == "RRR":
            self._rrr(dyad)
        elif dyad.kind == "RRP":
            self._rrp(dyad)
        elif dyad.kind == "RPR":
            self._rpr(dyad)
        else:
            raise Skipped("group", kind=dyad.kind)
        for name in dyad.links:
            if len([p for p in self.structure.links[name].points if p in self.at]) >= 2:
                self._rest(name)

    def _rrr(self, dyad: Dyad) -> None:
        from pylinkage.dyads import RRRDyad

        one, two = dyad.outer_first, dyad.outer_second
        inner = dyad.inner.point
        reach = [self._length(body.links[0], pair.point, inner)
                 for body, pair in zip(dyad.bodies, (one, two), strict=True)]
        here = self._here(inner)
        self._add(inner, RRRDyad(
            anchor1=self._anchor(one.point), anchor2=self._anchor(two.point),
            distance1=reach[0], distance2=reach[1], x=here.real, y=here.imag, name=inner,
        ))

    def _length(self, link: str, a: str, b: str) -> float:
        points = self.structure.links[link].points
        return abs(points[a] - points[b])

    def _rrp(self, dyad: Dyad) -> None:
        from pylinkage.components import Ground
        from pylinkage.dyads import RRPDyad

        slide, frame = dyad.outer_second, self.work.scene.frame
        if slide.b != frame.name:
            raise Skipped("group", kind="RRP")
        inner = dyad.inner.point
        here = self._here(inner)
        link = dyad.second.links[0]
        if len(self.structure.links[link].points) > 1:
            raise Skipped("points")
        ends = [here, here + slide.guide.direction * self.work.scene.size]
        lines = [Ground(z.real, z.imag, name=f"{inner}{k}") for k, z in enumerate(ends)]
        self.parts += lines
        self._add(inner, RRPDyad(
            revolute_anchor=self._anchor(dyad.outer_first.point), line_anchor1=lines[0], line_anchor2=lines[1],
            distance=self._length(dyad.first.links[0], dyad.outer_first.point, inner), x=here.real, y=here.imag,
            name=inner,
        ))

    def _rpr(self, dyad: Dyad) -> None:
        from pylinkage.dyads import FixedDyad

        one, two, slide = dyad.outer_first, dyad.outer_second, dyad.inner
        sliding, guiding = self.structure.links[slide.a], self.structure.links[slide.b]
        inner = guiding.points[two.point] - slide.guide.through
        if abs((inner * slide.guide.direction.conjugate()).imag) > 1e-12 or abs(sliding.points[one.point]) > 1e-12:
            raise Skipped("group", kind="RPR")
        base, way = self._here(two.point), self._here(one.point) - self._here(two.point)
        for link in (guiding, sliding):
            for point in link.points:
                if point in self.at:
                    continue
                arm = self._here(point) - base
                if abs(link.points[point]) and link is sliding:
                    raise Skipped("points")
                self._add(point, FixedDyad(
                    anchor1=self._anchor(two.point), anchor2=self._anchor(one.point), distance=abs(arm),
                    angle=cmath.phase(arm / way), name=point,
                ))


def scipy_root(work: Work, repeats: int) -> Iterator[Entry]:
    """The usual script: closure equations to ``scipy.optimize.root``, position after position, then linear systems.

    Raises
    ------
    Skipped : scipy is not installed
    """
    _need("scipy")
    from scipy.optimize import root

    numeric = Numeric(work)

    def one(k: int) -> Array:
        values = [v[k : k + 1] for v in numeric.values]

        def gap(x: Array) -> Array:
            return numeric.equations.open(x[:, None], values)[:, 0]

        return np.asarray(root(gap, numeric.before[:, k]).x)

    places = np.array([one(k) for k in range(len(work.values))]).T
    solution = numeric.equations.rates(places, numeric.values, numeric.first, numeric.second)
    first = [v[:1] for v in numeric.values]
    rates = best_time(lambda: numeric.equations.rates(places[:, :1], first, numeric.first, numeric.second), repeats)
    cost = best_time(lambda: one(0), repeats)
    yield Entry("peer", "scipy root", "", (cost + rates / 2, cost + rates), work.errors(*numeric.points(solution)))


PEERS = {"pylinkage": pylinkage, "scipy": scipy_root}
