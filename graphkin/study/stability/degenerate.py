"""Where geometry degenerates: formulas that lose digits, beside those that do not; differences in place of rates; an
instant centre where two nearly parallel lines cross; a drawing that is made small.

The place of the centre runs away, velocities through it do not; errors of points count the less the larger everything
is drawn.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from graphkin import solver
from graphkin.checking.uncertainty import predict
from graphkin.construction import EXACT, Plan, Scales, execute, pencil, plan
from graphkin.construction.centres import by_centres, find_centres, speeds
from graphkin.construction.instruments import Instrument
from graphkin.plane import added_up, cross_arcs
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.model import Mechanism
from graphkin.scene.sheet_tables import Tools
from graphkin.scene.symbol import Symbol
from graphkin.solver.assemblies import choose_forms
from graphkin.solver.drivers import Drive
from graphkin.solver.engine import positions
from graphkin.solver.pose import Array
from graphkin.study.equations import Equations
from graphkin.study.reference import reference, refined
from graphkin.study.stability.laws import ErrorLaw, Singularity, grid, in_powers, measured
from graphkin.words import Phrase

if TYPE_CHECKING:
    from mpmath import MPContext, mpc, mpf

__all__ = ["angle_formulas", "crossing_height", "differences", "drawing_scale", "parallel_lines"]

TRIALS = 6  # at each distance, of which the worst counts


def crossing_height(mp: MPContext, samples: int = 4) -> Singularity:
    """The height of the crossing of two arcs over the line of their centres, radii nearly reaching across.

    c2 - m2 against Heron's product with the small factor formed first (Kahan, Miscalculating area and angles of a
    needle-like triangle); the error of the square of the height, relative.
    """
    dice = random.Random(1)
    x = grid(0.1, 1e-15, samples)

    def errors(e: float) -> list[float]:
        rows = []
        for _ in range(TRIALS):
            r, s = dice.uniform(0.1, 1.0), dice.uniform(0.1, 1.0)
            c = (r + s) * (1 - e)
            right = _height2(mp.mpf(r), mp.mpf(s), mp.mpf(c))
            middle = (c * c + r * r - s * s) / (2 * c)
            crossing = cross_arcs(0j, r, complex(c), s)
            found = r * r - middle * middle, crossing[0].imag ** 2 if crossing else math.nan
            rows.append([float(abs(value / right - 1)) for value in found])
        return _largest(rows)

    laws = (
        ErrorLaw("height by squares", theory=-1.0, window=(1e-13, 1e-1)),
        ErrorLaw("height by Heron", theory=0.0, window=(1e-13, 1e-1)),
    )
    found = measured(laws, x, map(errors, x), samples)
    fate = Phrase("fate height", tuple(in_powers(law.worst) for law in found))
    return Singularity("crossing height", "gap of radii", found, (fate,))


def _largest(rows: Sequence[Sequence[float]]) -> list[float]:
    """The largest error of each method over some trials; those without an answer do not count."""
    return [max(0.0, *column) for column in zip(*rows, strict=True)]


def _height2(r: mpf, s: mpf, c: mpf) -> mpf:
    return (r + s + c) * (r + s - c) * (c + r - s) * (c - r + s) / (4 * c * c)


def angle_formulas(mp: MPContext, samples: int = 4) -> Singularity:
    """An angle near 0 or 180 degrees from the vectors of its sides: by arccos of their product, and by atan2."""
    dice = random.Random(2)
    x = grid(1.0, 1e-15, samples)

    def errors(phi: float) -> list[float]:
        rows = []
        for _ in range(TRIALS):
            turn = dice.uniform(0, 2 * math.pi)
            a, b = _ray(turn), _ray(turn + phi)
            over = a.real * b.imag - a.imag * b.real
            along = a.real * b.real + a.imag * b.imag
            right = mp.arg(mp.mpc(b) / mp.mpc(a))
            found = math.acos(max(-1.0, min(1.0, along / (abs(a) * abs(b))))), math.atan2(over, along)
            rows.append([float(abs(angle - right)) for angle in found])
        return _largest(rows)

    laws = (
        ErrorLaw("angle by arccos", theory=-1.0, window=(1e-7, 0.5)),
        ErrorLaw("angle by atan2", theory=0.0, window=(1e-7, 0.5)),
    )
    found = measured(laws, x, map(errors, x), samples)
    fate = Phrase("fate arccos", tuple(in_powers(law.worst) for law in found))
    return Singularity("angle near zero", "angle of two lines", found, (fate,))


def _ray(angle: float) -> complex:
    return complex(math.cos(angle), math.sin(angle))


def differences(mp: MPContext, samples: int = 4, name: str = "slider-crank-offset") -> Singularity:
    """Velocity and acceleration of a slider by central differences of its places, over the step; and by complex step.

    The error of differences falls as step^2 and grows again as u/step and u/step^2 (Numerical Recipes, 5.7); a
    complex step does not subtract (Squire and Trapp, SIAM Review 40, 1998).  The worst of four positions to a sample.
    """
    places = 4 * samples
    scene = mechanism_of(name)
    structure = solver.structure_of(scene)
    forms = {i: f[None] for i, f in choose_forms(structure).items()}
    (_, rate, second), equations = scene.drivers[0].values, Equations(structure)
    q = 2 * math.pi * (np.arange(places) + 0.3) / places
    link = scene.links[-1].name

    def at(value: Array) -> Array:
        state = positions(structure, Drive.at(structure, value[:, None]), forms, rates=False)
        return np.broadcast_to(state.poses[link].z, value.shape)

    here = positions(structure, Drive.at(structure, q[:, None]), forms)
    x0 = np.array([f(np.broadcast_to(here.poses[n].z, q.shape)) if f is not np.angle
                   else np.angle(np.broadcast_to(here.poses[n].u, q.shape))
                   for n in equations.names for f in (np.real, np.imag, np.angle)])
    precise = reference(structure, mp)
    k = equations.column[link]
    v, a = np.empty(places, dtype=complex), np.empty(places, dtype=complex)
    for i in range(places):
        s = refined(precise, mp, list(x0[:, i]), [mp.mpf(float(q[i]))], [rate], [second])
        v[i], a[i] = complex(s.rate[k], s.rate[k + 1]), complex(s.second[k], s.second[k + 1])
    w = abs(rate)
    steps = [10.0 ** (-j / 4) for j in range(2, 45)]
    speeds, pushes = [], []
    for h in steps:
        before, after = at(q - h), at(q + h)
        sense = math.copysign(1.0, rate)
        speeds.append(_worst((after - before) * (w * sense / (2 * h)), v))
        pushes.append(_worst((after - 2 * at(q) + before) * (w / h) ** 2, a - second * v / rate))
    laws = (
        ErrorLaw("velocity differences", theory=2.0, window=(3e-4, 1e-1)),
        ErrorLaw("velocity differences", theory=-1.0, window=(1e-10, 1e-7)),
        ErrorLaw("acceleration differences", theory=2.0, window=(3e-3, 1e-1)),
        ErrorLaw("acceleration differences", theory=-2.0, window=(1e-7, 2e-5)),
    )
    found = measured(laws, steps, zip(speeds, speeds, pushes, pushes, strict=True))
    by_step = [[_complex_step(equations, x0, q, (rate, second), k, h, v)] for h in steps[::4]]
    found += measured([ErrorLaw("velocity complex step", theory=2.0, window=(1e-6, 0.2))], steps[::4], by_step)
    fate = Phrase("fate differences", tuple(in_powers(found[k].best) for k in (0, 2, 4)))
    return Singularity("differences", "step", found, (fate,))


def _worst(found: Array, right: Array) -> float:
    return float(np.max(np.abs(found - right)) / np.max(np.abs(right)))


def _complex_step(
    equations: Equations, x0: Array, q: Array, rates: tuple[float, float], k: int, h: float, right: Array
) -> float:
    """Closure equations solved at a driver value with a small imaginary part; its share in the place is the rate."""
    rate, second = rates
    x, t = x0.astype(complex), 1j * h / abs(rate)
    values = [q + rate * t + second * t * t / 2]
    for _ in range(6):
        x = equations.improved(x, values)
    return _worst((x[k].imag + 1j * x[k + 1].imag) / t.imag, right)


SEEDS = 12


def _four_bar(phi: float) -> Mechanism:
    """Crank AB upright, rocker DC at an angle phi to it: their lines cross in the centre of the coupler."""
    c = complex(300, 0) + 120 * complex(math.sin(phi), math.cos(phi))
    return mechanism_of_text(
        f"""
[frame]
points = {{ A = [0, 0], D = [300, 0] }}
[links.1]
points = ["A", "B"]
[links.2]
points = ["B", "C"]
[links.3]
points = ["D", "C"]
[driver]
link = "1"
omega = 10
[drawn]
B = [0, 100]
C = [{c.real!r}, {c.imag!r}]
""",
        "parallel",
    )


@dataclass(frozen=True)
class _Right:
    """The centre of the coupler (m) and the velocity of C (m/s), 50 digits."""

    place: mpc
    velocity: mpc


def _right(scene: Mechanism, mp: MPContext) -> _Right:
    motion = solver.solve(scene)
    equations = reference(motion.structure, mp)
    value, rate, second = scene.drivers[0].values
    start = list(Equations(motion.structure).start(motion)[:, 0])
    found = refined(equations, mp, start, [mp.mpf(value)], [rate], [second])
    k = equations.column["2"]
    z, v, omega = (
        mp.mpc(found.place[k], found.place[k + 1]), mp.mpc(found.rate[k], found.rate[k + 1]), found.rate[k + 2],
    )  # fmt: skip
    _, _, vx, vy, _, _ = equations.point(found, "3", scene.by_name["3"].points["C"])
    return _Right(z + 1j * v / omega if omega else None, mp.mpc(vx, vy))


def _found(scene: Mechanism, right: _Right, hand: Instrument) -> tuple[float, float, bool]:
    """Errors of the centre's place (of its distance) and of the velocity of C through it (relative); whether the
    centre is given as a direction only."""
    centres = find_centres(scene, instrument=hand)
    velocity = by_centres(centres, speeds(centres), Symbol.parse("v_C"))
    off = float(abs(velocity - right.velocity) / abs(right.velocity)) if velocity is not None else math.nan
    point = centres.of("2", "0").point
    if point is None:
        return math.nan, off, True
    place = point / centres.links.mm
    return float(abs(place - right.place) / abs(right.place)), off, False


def parallel_lines(mp: MPContext, samples: int = 2) -> Singularity:
    """Errors against the angle of the two lines that cross in the centre."""
    x = grid(0.5, 1e-15, samples)
    rows = []
    stops: float | None = None
    for phi in x:
        scene = _four_bar(phi)
        place, velocity, far = _found(scene, _right(scene, mp), EXACT)
        stops = stops or (phi if far else None)
        rows.append((place, velocity))
    laws = (
        ErrorLaw("centre place", theory=-1.0, warns_from=stops, refuses_from=stops, window=(1e-12, 0.1)),
        ErrorLaw("centre velocity", theory=0.0),
    )
    found = measured(laws, x, rows, samples) + _by_pencil(mp)
    fates = [Phrase("fate centre kept", (in_powers(found[1].worst), in_powers(found[3].worst)))]
    if stops is not None:
        fates.insert(0, Phrase("fate centre", (in_powers(stops),)))
    return Singularity("parallel lines", "angle of two lines", found, tuple(fates))


def _by_pencil(mp: MPContext) -> tuple[ErrorLaw, ...]:
    """Root of the mean square over some drawings."""

    def errors(phi: float) -> tuple[float, float]:
        scene = _four_bar(phi)
        right = _right(scene, mp)
        rows = [_found(scene, right, pencil(scene.sheet.tools, seed)) for seed in range(SEEDS)]
        return _rms([row[0] for row in rows]), _rms([row[1] for row in rows])

    x = grid(0.5, 1e-5, 1)
    laws = (
        ErrorLaw("centre place pencil", theory=-1.0, window=(1e-3, 0.2), lost=1.0),
        ErrorLaw("centre velocity pencil", theory=0.0),
    )
    return measured(laws, x, map(errors, x))


def _rms(values: list[float]) -> float:
    return math.sqrt(added_up(v * v for v in values) / len(values))


POINTS_ONLY = Tools(line_width=0.2, ruler=0.0, compass=0.0, set_square=0.0, protractor=0.0)


def drawing_scale(mp: MPContext, samples: int = 1, name: str = "slider-crank-offset") -> Singularity:
    """Predicted uncertainty of the slider's velocity against the length of the crank on paper, all three figures drawn
    larger alike: errors of points and lengths fall as 1/size, those of set squares stay.

    Parameters
    ----------
    mp, samples : as for the others; not used, since nothing is random here
    """
    scene = mechanism_of(name)
    slider = scene.links[-1]
    symbol = Symbol.parse(f"v_{next(iter(slider.points))}")
    what = plan(scene, find=(symbol,))
    crank = scene.links[0].length or scene.size
    own = crank / what.scales.length
    right = abs(_value(what, symbol))
    x = [1e3 / v for v in grid(0.3e3, 1.0, 1)]  # falling ratios turned into growing sizes, mm
    x = sorted(size for size in x if 3.0 <= size <= 1000.0)
    hands = POINTS_ONLY, scene.sheet.tools

    def errors(size: float) -> list[float]:
        by = own / size
        scales = Scales(*(s * by for s in (what.scales.length, what.scales.velocity, what.scales.acceleration)))
        larger = replace(what, scales=scales)
        return [predict(larger, "pencil", tools, together=False)[symbol].deviation / right for tools in hands]

    laws = ErrorLaw("pencil points", theory=-1.0, lost=1.0), ErrorLaw("pencil all", lost=1.0)
    found = measured(laws, x, map(errors, x))
    ends = [f"{x[0]:.2g}", f"{x[-1]:.4g}"]
    fate = Phrase("fate scale", (*ends, *(in_powers(law.error[k]) for law in found for k in (0, -1))))
    return Singularity("small scale", "crank on paper", found, (fate,))


def _value(what: Plan, symbol: Symbol) -> complex:
    sheet = execute(what, EXACT)
    vector = sheet.vectors("velocity")[symbol]
    return vector.span * sheet.scales.velocity
