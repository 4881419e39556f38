"""Beside the dead point of each dyad: crank a little before the position where the links of the dyad come into line.

There the place goes with the root of the distance, so that its error grows as distance^-1/2, those of velocity and
acceleration (relative) as distance^-1, whatever the method; unless the distance itself is given, not the crank's angle.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from graphkin import solver
from graphkin.checking.uncertainty import COVERAGE, predict
from graphkin.construction import EXACT, execute, plan
from graphkin.construction.remarks import SharpCrossing
from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of_text
from graphkin.scene.model import FromDeadPoint, Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver import Motion
from graphkin.solver.dead_points import dead_points
from graphkin.solver.decimals import working
from graphkin.structure import DyadKind
from graphkin.study.equations import Equations, Solution
from graphkin.study.reference import reference, refined
from graphkin.study.stability.laws import ErrorLaw, Singularity, binned, grid, in_powers, measured
from graphkin.words import Phrase

if TYPE_CHECKING:
    from mpmath import MPContext, mpf

__all__ = ["CASES", "DeadPointCase", "dead_point"]

_RRR = """
[frame]
points = { A = [0, 0], D = [400, 0] }
[links.1]
points = ["A", "B"]
length = 310
[links.2]
points = ["B", "C"]
length = 210
[links.3]
points = ["D", "C"]
length = 290
[driver]
link = "1"
angle = 60
omega = 10
[sketch]
C = [300, 280]
"""
_RRP = """
[frame]
points = { A = [0, 0] }
guides = { h = { through = [0, 0], angle = 0 } }
[links.1]
points = ["A", "B"]
length = 310
[links.2]
points = ["B", "C"]
length = 210
[links.3]
points = ["C"]
on = "0.h"
[driver]
link = "1"
angle = 30
omega = 10
"""
_RPR = """
[frame]
points = { A = [0, 0], C = [310, 0] }
[links.1]
points = ["A", "B"]
length = 110
[links.2]
points = ["B"]
on = "3.s"
[links.3]
points = ["C"]
at = { E = [0, 250] }
guides = { s = { through = "E", angle = 0 } }
[driver]
link = "1"
angle = 120
omega = 10
"""


@dataclass(frozen=True)
class DeadPointCase:
    """A mechanism with its dead point.

    ``follower`` is the link whose motion is looked at; ``side`` is +1 where the crank comes to the dead point from
    greater angles.
    """

    kind: str
    text: str
    follower: str
    side: int

    @cached_property
    def scene(self) -> Mechanism:
        return mechanism_of_text(self.text, self.kind)

    def at(self, angle: float) -> Mechanism:
        """The scene with its crank at another angle."""
        driver = self.scene.drivers[0]
        return replace(self.scene, drivers=(replace(driver, value=angle),))

    @property
    def _lengths(self) -> tuple[float, float, float]:
        """Crank, ground (0 where it takes no part) and the reach of the dyad."""
        links = self.scene.by_name
        crank = links["1"].length
        assert crank is not None
        if self.kind == "RRR":
            return crank, links["0"].points["D"].real, (links["2"].length or 0.0) + (links["3"].length or 0.0)
        if self.kind == "RRP":
            return crank, 0.0, links["2"].length or 0.0
        return crank, links["0"].points["C"].real, links["3"].guides["s"].through.imag

    def dead(self, mp: MPContext) -> mpf:
        """The crank's angle at the dead point, by the law of cosines or the sine."""
        a, d, reach = (mp.mpf(x) for x in self._lengths)
        if self.kind == "RRP":
            return mp.asin(reach / a)
        if self.kind == "RRR":
            links = self.scene.by_name
            reach = mp.mpf(links["2"].length) + mp.mpf(links["3"].length)
        return mp.acos((a * a + d * d - reach * reach) / (2 * a * d))


CASES: Mapping[DyadKind, DeadPointCase] = {
    "RRR": DeadPointCase("RRR", _RRR, "3", -1),
    "RRP": DeadPointCase("RRP", _RRP, "2", -1),
    "RPR": DeadPointCase("RPR", _RPR, "3", 1),
}


NEAR, FAR = 1e-15, 0.3
NEARBY = (1e-12, 1e-2)  # over which slopes are fitted
STEP = 0.02  # rad; where Newton's method comes from
PATIENCE = 60


def dead_point(kind: DyadKind, mp: MPContext, samples: int = 4) -> Singularity:
    """Errors of all methods beside the dead point of a dyad, "RRR", "RRP" or "RPR".

    Parameters
    ----------
    mp : mpmath context of the reference
    samples : distances to each half of a decade
    """
    case = CASES[kind]
    x = grid(FAR, NEAR, samples)
    truth = _truth(case, mp, x)
    laws = [*_closed(case, mp, x, truth, samples), _newton(case, mp, x, truth, samples)]
    laws.append(_drawn(case, mp, x[::samples], truth[::samples]))
    laws += [_given(case, x, truth, samples), _pencil(case, mp)]
    found = {law.key: law for law in laws}
    ends = (
        ("fate dead closed", (found["velocity closed form"].refuses_from,)),
        ("fate dead newton", (found["velocity Newton"].warns_from,)),
        ("fate dead drawn", (found["velocity exact drawing"].warns_from, found["velocity pencil"].refuses_from)),
    )
    fates = [Phrase(key, tuple(in_powers(x) for x in at if x is not None)) for key, at in ends if None not in at]
    return Singularity(f"dead point {kind}", "crank before", tuple(laws), tuple(fates))


@dataclass(frozen=True)
class _Exactly:
    """The follower's motion to 50 digits: its direction as cosine and sine, its rates."""

    cos: mpf
    sin: mpf
    omega: mpf
    alpha: mpf

    def off(self, u: complex, omega: float, alpha: float) -> tuple[float, float, float]:
        """Errors of a direction (rad), and of its rates (relative)."""
        turned = abs(u.imag * self.cos - u.real * self.sin)
        return float(turned), float(abs(omega / self.omega - 1)), float(abs(alpha / self.alpha - 1))


def _truth(case: DeadPointCase, mp: MPContext, x: Sequence[float]) -> list[_Exactly]:
    """The reference at falling distances, each from the one before: on the same side Newton's method cannot miss."""
    motion = solver.solve(case.at(float(case.dead(mp) + case.side * mp.mpf(x[0]))))
    equations = reference(motion.structure, mp)
    rates = [d.values for d in case.scene.drivers]
    at: Sequence[mpf] = list(equations.start(motion)[:, 0])
    found = []
    for e in x:
        value = case.dead(mp) + case.side * mp.mpf(e)
        solution = refined(equations, mp, at, [value], [rates[0][1]], [rates[0][2]])
        at = list(solution.place)
        k = equations.column[case.follower] + 2
        angle = solution.place[k]
        found.append(_Exactly(mp.cos(angle), mp.sin(angle), solution.rate[k], solution.second[k]))
    return found


def _closed(
    case: DeadPointCase, mp: MPContext, x: Sequence[float], truth: Sequence[_Exactly], samples: int
) -> tuple[ErrorLaw, ...]:
    rows: list[tuple[float, float, float]] = []
    bounds: list[float] = []
    stops: float | None = None
    for e, right in zip(x, truth, strict=True):
        motion = solver.solve(case.at(float(case.dead(mp) + case.side * mp.mpf(e))))
        if motion.status[0] != "ok":
            stops = stops or e
            rows.append((math.nan,) * 3)
            bounds.append(math.nan)
            continue
        pose = motion.poses[case.follower]
        rows.append(right.off(complex(pose.u[0]), float(pose.omega[0]), float(pose.alpha[0])))
        bounds.append(_stated(case, motion))
    stated = binned(x, bounds, samples)[1]
    laws = (
        ErrorLaw("place closed form", theory=-0.5, refuses_from=stops, window=NEARBY),
        ErrorLaw("velocity closed form", theory=-1.0, refuses_from=stops, bound=stated, window=NEARBY),
        ErrorLaw("acceleration closed form", theory=-1.0, refuses_from=stops, window=NEARBY),
    )
    return measured(laws, x, rows, samples)


def _stated(case: DeadPointCase, motion: Motion) -> float:
    """The bound that the solver states for the velocities of points, as one of the follower's rate (relative): both
    ends of its longest line may err."""
    reach = max(abs(z) for z in case.scene.by_name[case.follower].points.values())
    return 2 * float(motion.bound.velocity[0]) / (abs(float(motion.omega(case.follower)[0])) * reach)


def _newton(
    case: DeadPointCase, mp: MPContext, x: Sequence[float], truth: Sequence[_Exactly], samples: int
) -> ErrorLaw:
    """Newton's method on the closure equations, from the position a degree away, until it moves no more."""
    dead = case.dead(mp)
    structure = solver.structure_of(case.scene)
    equations = Equations(structure)
    starts = [solver.solve(case.at(float(dead + case.side * mp.mpf(e + STEP)))) for e in x]
    at = np.concatenate([equations.start(m) for m in starts], axis=1)
    values = [np.array([float(dead + case.side * mp.mpf(e)) for e in x])]
    waiting = np.ones(len(x), dtype=bool)
    for _ in range(PATIENCE):
        new = equations.improved(at, values)
        moved = np.max(np.abs(new - at), axis=0)
        at = np.where(waiting, new, at)
        waiting &= ~(moved < 1e-12)
    solution: Solution = equations.rates(at, values, [case.scene.drivers[0].values[1]], [0.0])
    k = equations.column[case.follower] + 2
    error = [
        right.off(complex(math.cos(p), math.sin(p)), float(w), float(b))[1]
        for right, p, w, b in zip(truth, at[k], solution.rate[k], solution.second[k], strict=True)
    ]
    lost = [e for e, w in zip(x, waiting, strict=True) if w]
    xs, es = binned(x, error, samples)
    return ErrorLaw("velocity Newton", xs, es, -1.0, max(lost, default=None), window=NEARBY)


def _given(case: DeadPointCase, x: Sequence[float], truth: Sequence[_Exactly], samples: int) -> ErrorLaw:
    """The solver with the distance from the dead point given, in place of the crank's angle; the largest of the errors
    of direction, rate and second rate."""
    structure = solver.structure_of(case.scene)
    near = next(p for p in dead_points(structure) if case.side in p.sides and p.value > 0)
    driver = case.scene.drivers[0]
    error = []
    for e, right in zip(x, truth, strict=True):
        with working():
            value = near.value + Decimal(case.side * e)
        there = replace(driver, value=float(value), dead_point=FromDeadPoint(case.side * e, None, str(value)))
        motion = solver.solve(replace(case.scene, drivers=(there,)))
        if motion.status[0] != "ok":
            error.append(math.nan)
            continue
        pose = motion.poses[case.follower]
        error.append(max(right.off(complex(pose.u[0]), float(pose.omega[0]), float(pose.alpha[0]))))
    xs, es = binned(x, error, samples)
    return ErrorLaw("all from the dead point", xs, es, 0.0)


def _drawn(case: DeadPointCase, mp: MPContext, x: Sequence[float], truth: Sequence[_Exactly]) -> ErrorLaw:
    """The exact drawing board."""
    error: list[float] = []
    told: float | None = None
    stops: float | None = None
    for e, right in zip(x, truth, strict=True):
        try:
            sheet = execute(plan(case.at(float(case.dead(mp) + case.side * mp.mpf(e)))), EXACT)
        except Unsolvable:
            told, stops = told or e, stops or e
            error.append(math.nan)
            continue
        if any(isinstance(r, SharpCrossing) for r in sheet.remarks):
            told = told or e
        error.append(float(abs(sheet.omega[case.follower].value / right.omega - 1)))
    return ErrorLaw("velocity exact drawing", tuple(x), tuple(error), -1.0, told, stops, window=NEARBY)


def _pencil(case: DeadPointCase, mp: MPContext) -> ErrorLaw:
    """The uncertainty of first order that is predicted for a pencil, relative.

    A rate goes as one over the half chord h of the crossing: an error u of it is one of 2 u in the square of h, and
    where COVERAGE times that is all of it the arcs may miss each other, and first order has no such law.
    """
    x = grid(FAR, 1e-4, 1)
    symbol = Symbol("omega", link=case.follower)
    error: list[float] = []
    told: float | None = None
    stops: float | None = None
    for e in x:
        what = plan(case.at(float(case.dead(mp) + case.side * mp.mpf(e))))
        size = abs(execute(what, EXACT).omega[case.follower].value)
        if any(isinstance(r, SharpCrossing) for r in execute(what, EXACT).remarks):
            told = told or e
        part = predict(what, "pencil", case.scene.sheet.tools, together=False)[symbol].deviation / size
        if not math.isfinite(part):
            stops = stops or e
        error.append(part if math.isfinite(part) else math.nan)
    lost = 1 / (2 * COVERAGE)
    return ErrorLaw("velocity pencil", tuple(x), tuple(error), -1.0, told, stops, window=(2e-3, 0.4), lost=lost)
