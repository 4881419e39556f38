"""The failure of methods: the error of each near each kind of singular position, in the order in which they are drawn.

Near the dead point of a dyad its place changes with the root of the distance, so that the error of the place grows as
distance^-1/2, those of velocity and acceleration (relative) as distance^-1, whatever the method; unless the distance
itself is given, not the crank's angle.  Of guide bars: the flip of a bar whose pivot the crank pin passes through, and
sliding that nearly stops.  Elsewhere geometry degenerates: formulas that lose digits, beside those that do not;
differences in place of rates; an instant centre at the crossing of two nearly parallel lines, whose error grows while
velocities through it stay right; a small drawing, in which errors of points count more.
"""

from __future__ import annotations

import math
import random
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from graphkin import solver
from graphkin.checking.report import COVERAGE
from graphkin.checking.uncertainty import predict
from graphkin.construction import EXACT, Scales, execute, pencil, plan
from graphkin.construction.board.instruments import Instrument
from graphkin.construction.centres import find_centres
from graphkin.errors import Unsolvable
from graphkin.plane import added_up, cross_arcs
from graphkin.scene import mechanism_of
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import resolved
from graphkin.scene.scene_tables import Tools
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import put_at
from graphkin.solver import Motion
from graphkin.solver.algebra.pose import Array
from graphkin.solver.drivers import working
from graphkin.solver.path.dead_points import dead_points
from graphkin.solver.prepared import prepare
from graphkin.study.equations import Equations, context, reference, refined
from graphkin.study.error_laws import LOST, Answer, ErrorLaw, Singularity, grid, in_powers, measured
from graphkin.words import Phrase
from graphkin.words.written import true_minus

if TYPE_CHECKING:
    from mpmath import MPContext, mpc, mpf


SCENES = Path(__file__).with_name("singular_scenes.toml")


def _scene(name: str, *values: tuple[str, object]) -> Mechanism:
    """A mechanism of the file of scenes, with values at some keys (with dots)."""
    tables = tomllib.loads(SCENES.read_text(encoding="utf-8"))[name]
    for key, value in values:
        put_at(tables, tuple(key.split(".")), value)
    return resolved(tables, name)[1]


def _turned(scene: Mechanism, angle: float) -> Mechanism:
    """The scene with its crank at another angle (rad)."""
    return replace(scene, drivers=(replace(scene.drivers[0], value=float(angle)),))


def _drawn(scene: Mechanism, rate: Literal["omega", "alpha"], link: str) -> tuple[float, list[str]]:
    """A rate of a link as exact hands draw it, nan where the board refuses, and the keys of the remarks."""
    try:
        sheet = execute(plan(scene), EXACT)
    except Unsolvable:
        return math.nan, []
    return sheet.rates[rate][link].value, [remark.key for remark in sheet.remarks]


def _fates(key: str, /, **values: float | None) -> tuple[Phrase, ...]:
    """A sentence with measured numbers in its gaps; none where a number is missing."""
    numbers = {gap: in_powers(value) for gap, value in values.items() if value is not None}
    return (Phrase(key, **numbers),) if len(numbers) == len(values) else ()


@dataclass(frozen=True)
class Turning:
    """The direction of a link (a unit vector), and rates of its turning, such as omega, alpha, Coriolis."""

    u: mpc | complex
    rates: tuple[mpf | float, ...]

    def off(self, u: complex, *rates: float) -> tuple[float, ...]:
        """Errors of a direction (rad), and of the rates (relative)."""
        turned = abs(u.imag * self.u.real - u.real * self.u.imag)
        return float(turned), *(float(abs(rate / right - 1)) for rate, right in zip(rates, self.rates, strict=True))


# dead points of dyads

FAR, NEAR = 0.3, 1e-15  # rad
NEARBY = (1e-12, 1e-2)  # rad; over which slopes are fitted
STEP = 0.02  # rad; where Newton's method comes from
PATIENCE = 60

FOLLOWERS = {"RRR": "3", "RRP": "2", "RPR": "3"}
SIDES = {"RRR": -1, "RRP": -1, "RPR": 1}
"""+1 where the crank comes to the dead point from greater angles."""


def _dead(kind: str, scene: Mechanism, mp: MPContext) -> mpf:
    """The crank's angle at the dead point (rad), by the law of cosines or the sine."""
    length = {link.name: mp.mpf(link.length or 0.0) for link in scene.links}
    if kind == "RRP":
        return mp.asin(length["2"] / length["1"])
    if kind == "RRR":
        ground, reach = mp.mpf(scene.frame.points["D"].real), length["2"] + length["3"]
    else:
        ground = mp.mpf(scene.frame.points["C"].real)
        reach = mp.mpf(scene.by_name["3"].guides["s"].through.imag)
    a = length["1"]
    return mp.acos((a * a + ground * ground - reach * reach) / (2 * a * ground))


def dead_point(kind: str, mp: MPContext, samples: int = 4) -> Singularity:
    """Errors of all methods beside the dead point of a dyad.

    Parameters
    ----------
    kind : "RRR", "RRP" or "RPR"
    mp : mpmath context of the reference
    samples : distances to each half of a decade
    """
    scene, follower, side = _scene(kind), FOLLOWERS[kind], SIDES[kind]
    driver, dead = scene.drivers[0], _dead(kind, scene, mp)
    reach = max(abs(z) for z in scene.by_name[follower].points.values())
    given = next(p for p in dead_points(solver.structure_of(scene)) if side in p.sides and p.value > 0)
    x = grid(FAR, NEAR, samples)

    def angle(e: float) -> mpf:
        return dead + side * mp.mpf(e)

    def beside(e: float) -> Mechanism:
        return _turned(scene, angle(e))

    right = dict(zip(x, _followed(scene, follower, [angle(e) for e in x], mp), strict=True))

    def errors(motion: Motion, e: float) -> tuple[float, ...]:
        if motion.status[0] != "ok":
            return (math.nan,) * 3
        pose = motion.poses[follower]
        return right[e].off(complex(pose.u[0]), float(pose.omega[0]), float(pose.alpha[0]))

    def closed(e: float) -> Answer:
        """The closed form; the bound of the velocities of points gives that of the follower's rate: both ends of its
        longest line may err."""
        motion = solver.solve(beside(e))
        bound = 2 * float(motion.bound.velocity[0]) / (abs(float(motion.omega(follower)[0])) * reach)
        return Answer(errors(motion, e), bounds=(math.nan, bound, math.nan))

    def from_dead_point(e: float) -> Answer:
        with working():
            value = given.value + Decimal(side * e)
        there = replace(driver, value=float(value), distance=side * e, exact=str(value))
        return Answer((max(errors(solver.solve(replace(scene, drivers=(there,))), e)),))

    def drawn(e: float) -> Answer:
        omega, remarks = _drawn(beside(e), "omega", follower)
        return Answer((float(abs(omega / right[e].rates[0] - 1)),), "sharp crossing" in remarks)

    def by_pencil(e: float) -> Answer:
        omega, remarks = _drawn(beside(e), "omega", follower)
        predicted = predict(plan(beside(e)), "pencil", scene.question.sheet.tools, together=False)
        part = predicted[Symbol("omega", link=follower)].deviation / abs(omega)
        return Answer((part if math.isfinite(part) else math.nan,), "sharp crossing" in remarks)

    computed = [ErrorLaw(f"{measure} closed form", theory=slope, window=NEARBY)
                for measure, slope in (("place", -0.5), ("velocity", -1.0), ("acceleration", -1.0))]
    newton = ErrorLaw("velocity Newton", theory=-1.0, window=NEARBY)
    board = ErrorLaw("velocity exact drawing", theory=-1.0, window=NEARBY)
    # a rate goes as one over the half chord h of the crossing: an error u of it is one of 2 u in the square of h, and
    # where COVERAGE times that is all of it the arcs may miss each other, and first order has no such law
    hand = ErrorLaw("velocity pencil", theory=-1.0, window=(2e-3, 0.4), lost=1 / (2 * COVERAGE))
    few = grid(FAR, 1e-4, 1)
    laws = (
        *measured(computed, x, map(closed, x), samples),
        *measured([newton], x, _newton(beside, x, follower, right), samples),
        *measured([board], x[::samples], map(drawn, x[::samples])),
        *measured([ErrorLaw("all from the dead point", theory=0.0)], x, map(from_dead_point, x), samples),
        *measured([hand], few, map(by_pencil, few)),
    )
    by_key = {law.key: law for law in laws}
    warned, missed = by_key["velocity exact drawing"].warns_from, by_key["velocity pencil"].refuses_from
    fates = (
        *_fates("fate dead closed", distance=by_key["velocity closed form"].refuses_from),
        *_fates("fate dead newton", distance=by_key["velocity Newton"].warns_from),
        *_fates("fate dead drawn", drawn=warned, pencil=missed),
    )
    return Singularity(f"dead point {kind}", "crank before", laws, fates)


def _followed(scene: Mechanism, link: str, angles: Sequence[mpf], mp: MPContext) -> Iterator[Turning]:
    """The motion of a link to 50 digits at angles of the crank, each from the one before: on the same side of a dead
    point Newton's method cannot miss."""
    motion = solver.solve(_turned(scene, angles[0]))
    equations = reference(motion.structure, mp)
    rates = [[d.values[order]] for d in scene.drivers for order in (1, 2)]
    at: Sequence[mpf] = list(equations.start(motion)[:, 0])
    k = equations.column[link] + 2
    for angle in angles:
        solution = refined(equations, mp, at, [angle], *rates)
        at = list(solution.place)
        yield Turning(mp.expj(solution.place[k]), (solution.rate[k], solution.second[k]))


def _newton(
    beside: Callable[[float], Mechanism], x: Sequence[float], follower: str, right: Mapping[float, Turning]
) -> Iterator[Answer]:
    """Newton's method on the closure equations, from the position a degree away, until it converges; it warns where it
    does not."""
    scenes = [beside(e) for e in x]
    starts = [solver.solve(beside(e + STEP)) for e in x]
    equations = Equations(starts[0].structure)
    at = np.concatenate([equations.start(motion) for motion in starts], axis=1)
    values = [np.array([scene.drivers[0].value for scene in scenes])]
    waiting = np.ones(len(x), dtype=bool)
    for _ in range(PATIENCE):
        new = equations.improved(at, values)
        moved = np.max(np.abs(new - at), axis=0)
        at = np.where(waiting, new, at)
        waiting &= ~(moved < 1e-12)
    solution = equations.rates(at, values, [scenes[0].drivers[0].values[1]], [0.0])
    k = equations.column[follower] + 2
    for e, angle, omega, alpha, lost in zip(x, at[k], solution.rate[k], solution.second[k], waiting, strict=True):
        u = complex(math.cos(angle), math.sin(angle))
        yield Answer(right[e].off(u, float(omega), float(alpha))[1:2], bool(lost))


# formulas that lose digits

TRIALS = 6  # at each distance, of which the worst counts


def _worst_of_trials(errors: Callable[[float], Iterable[float]], e: float) -> Answer:
    """The largest error of each formula over some trials; trials without an answer do not count."""
    trials = [tuple(errors(e)) for _ in range(TRIALS)]
    return Answer([max(0.0, *column) for column in zip(*trials, strict=True)])


def crossing_height(mp: MPContext, samples: int = 4) -> Singularity:
    """The height of the crossing of two arcs over the line of their centres, radii nearly reaching across.

    c2 - m2 against Heron's product with the small factor formed first (Kahan, Miscalculating area and angles of a
    needle-like triangle); the error of the square of the height, relative.
    """
    dice = random.Random(1)
    x = grid(0.1, 1e-15, samples)

    def errors(e: float) -> Iterator[float]:
        r, s = dice.uniform(0.1, 1.0), dice.uniform(0.1, 1.0)
        c = (r + s) * (1 - e)
        a, b, d = mp.mpf(r), mp.mpf(s), mp.mpf(c)
        right = (a + b + d) * (a + b - d) * (d + a - b) * (d - a + b) / (4 * d * d)
        middle = (c * c + r * r - s * s) / (2 * c)
        crossing = cross_arcs(0j, r, complex(c), s)
        for height in (r * r - middle * middle, crossing[0].imag ** 2 if crossing else math.nan):
            yield float(abs(height / right - 1))

    stated = (
        ErrorLaw("height by squares", theory=-1.0, window=(1e-13, 1e-1)),
        ErrorLaw("height by Heron", theory=0.0, window=(1e-13, 1e-1)),
    )
    laws = measured(stated, x, map(partial(_worst_of_trials, errors), x), samples)
    fates = _fates("fate height", squares=laws[0].worst, heron=laws[1].worst)
    return Singularity("crossing height", "gap of radii", laws, fates)


def angle_formulas(mp: MPContext, samples: int = 4) -> Singularity:
    """An angle near 0 or 180 degrees from the vectors of its sides: by arccos of their product, and by atan2."""
    dice = random.Random(2)
    x = grid(1.0, 1e-15, samples)

    def errors(phi: float) -> Iterator[float]:
        turn = dice.uniform(0, 2 * math.pi)
        a, b = (complex(math.cos(angle), math.sin(angle)) for angle in (turn, turn + phi))
        over = a.real * b.imag - a.imag * b.real
        along = a.real * b.real + a.imag * b.imag
        right = mp.arg(mp.mpc(b) / mp.mpc(a))
        for angle in (math.acos(max(-1.0, min(1.0, along / (abs(a) * abs(b))))), math.atan2(over, along)):
            yield float(abs(angle - right))

    stated = (
        ErrorLaw("angle by arccos", theory=-1.0, window=(1e-7, 0.5)),
        ErrorLaw("angle by atan2", theory=0.0, window=(1e-7, 0.5)),
    )
    laws = measured(stated, x, map(partial(_worst_of_trials, errors), x), samples)
    fates = _fates("fate arccos", arccos=laws[0].worst, atan2=laws[1].worst)
    return Singularity("angle near zero", "angle of two lines", laws, fates)


# differences in place of rates


def differences(mp: MPContext, samples: int = 4) -> Singularity:
    """Velocity and acceleration of a slider by central differences of its places, over the step; and by complex step.

    The error of differences falls as step^2 and grows again as u/step and u/step^2 (Numerical Recipes, 5.7); a
    complex step does not subtract (Squire and Trapp, SIAM Review 40, 1998).  The worst of four positions to a sample.
    """
    places = 4 * samples
    scene = mechanism_of("slider-crank-offset")
    reach, link = solver.driver_range(scene), scene.links[-1].name
    structure = reach.structure
    (_, rate, second), equations = scene.drivers[0].values, Equations(structure)
    angles = 2 * math.pi * (np.arange(places) + 0.3) / places
    k, slider = equations.column[link], prepare(structure, [Symbol.parse(next(iter(scene.links[-1].points)))])

    def place(values: Array) -> Array:
        x, y = slider.columns(values)[0]
        return np.asarray(x + 1j * y)

    start = equations.start(reach.motion(reach.offsets(angles)))
    precise = reference(structure, mp)
    velocity, acceleration = np.empty(places, dtype=complex), np.empty(places, dtype=complex)
    for i in range(places):
        right = refined(precise, mp, list(start[:, i]), [mp.mpf(float(angles[i]))], [rate], [second])
        velocity[i] = complex(right.rate[k], right.rate[k + 1])
        acceleration[i] = complex(right.second[k], right.second[k + 1])

    def central(step: float) -> Answer:
        before, here, after = place(angles - step), place(angles), place(angles + step)
        speed = _worst((after - before) * (rate / (2 * step)), velocity)
        push = _worst((after - 2 * here + before) * (rate / step) ** 2, acceleration - second * velocity / rate)
        return Answer((speed, speed, push, push))

    def complex_step(step: float) -> Answer:
        """Closure equations solved at a driver value with a small imaginary part; its share in the place is the
        rate."""
        x, t = start.astype(complex), 1j * step / abs(rate)
        values = [angles + rate * t + second * t * t / 2]
        for _ in range(6):
            x = equations.improved(x, values)
        return Answer((_worst((x[k].imag + 1j * x[k + 1].imag) / t.imag, velocity),))

    steps = [10.0 ** (-j / 4) for j in range(2, 45)]
    stated = (
        ErrorLaw("velocity differences", theory=2.0, window=(3e-4, 1e-1)),
        ErrorLaw("velocity differences", theory=-1.0, window=(1e-10, 1e-7)),
        ErrorLaw("acceleration differences", theory=2.0, window=(3e-3, 1e-1)),
        ErrorLaw("acceleration differences", theory=-2.0, window=(1e-7, 2e-5)),
    )
    few = [ErrorLaw("velocity complex step", theory=2.0, window=(1e-6, 0.2))]
    laws = measured(stated, steps, map(central, steps)) + measured(few, steps[::4], map(complex_step, steps[::4]))
    fates = _fates(
        "fate differences", velocity=laws[0].best, acceleration=laws[2].best, complex_step=laws[4].best
    )
    return Singularity("differences", "step", laws, fates)


def _worst(values: Array, right: Array) -> float:
    return float(np.max(np.abs(values - right)) / np.max(np.abs(right)))


# instant centre of nearly parallel lines

SEEDS = 12  # drawings of a pencil


def _four_bar(phi: float, mp: MPContext) -> tuple[Mechanism, mpc, mpc]:
    """A four-bar with its crank AB upright and its rocker DC at an angle to it (rad), whose lines cross in the centre
    of the coupler; to 50 digits that centre (m; None where the coupler does not turn) and the velocity of C (m/s)."""
    c = complex(300, 0) + 120 * complex(math.sin(phi), math.cos(phi))
    scene = _scene("parallel", ("drawn.C", [c.real, c.imag]))
    motion = solver.solve(scene)
    equations, (value, rate, second) = reference(motion.structure, mp), scene.drivers[0].values
    start = list(Equations(motion.structure).start(motion)[:, 0])
    right = refined(equations, mp, start, [mp.mpf(value)], [rate], [second])
    k = equations.column["2"]
    z, v, omega = mp.mpc(*right.place[k : k + 2]), mp.mpc(*right.rate[k : k + 2]), right.rate[k + 2]
    _, _, vx, vy, _, _ = equations.point(right, "3", scene.by_name["3"].points["C"])
    return scene, z + 1j * v / omega if omega else None, mp.mpc(vx, vy)


def _centre_errors(scene: Mechanism, right: mpc, right_velocity: mpc, hand: Instrument) -> tuple[float, float]:
    """Errors of the place of the coupler's centre (of its distance; nan where it is given as a direction only) and of
    the velocity of C through it (relative)."""
    centres = find_centres(scene, instrument=hand)
    velocity, point = centres.velocity(Symbol.parse("v_C")), centres.of("2", "0").point
    error = float(abs(velocity - right_velocity) / abs(right_velocity)) if velocity is not None else math.nan
    return float(abs(point / centres.mm - right) / abs(right)) if point is not None else math.nan, error


def parallel_lines(mp: MPContext, samples: int = 2) -> Singularity:
    """Errors against the angle of the two lines that cross in the centre; of a pencil the root of the mean square."""

    def exactly(phi: float) -> Answer:
        return Answer(_centre_errors(*_four_bar(phi, mp), EXACT))

    def by_pencil(phi: float) -> Answer:
        scene, centre, velocity = _four_bar(phi, mp)
        hands = [pencil(scene.question.sheet.tools, seed) for seed in range(SEEDS)]
        columns = zip(*(_centre_errors(scene, centre, velocity, hand) for hand in hands), strict=True)
        return Answer([math.sqrt(added_up(e * e for e in errors) / SEEDS) for errors in columns])

    exact = (
        ErrorLaw("centre place", theory=-1.0, window=(1e-12, 0.1)),
        ErrorLaw("centre velocity", theory=0.0),
    )
    drawn = (
        ErrorLaw("centre place pencil", theory=-1.0, window=(1e-3, 0.2), lost=1.0),
        ErrorLaw("centre velocity pencil", theory=0.0),
    )
    x, few = grid(0.5, 1e-15, samples), grid(0.5, 1e-5, 1)
    laws = measured(exact, x, map(exactly, x), samples) + measured(drawn, few, map(by_pencil, few))
    fates = (
        *_fates("fate centre", distance=laws[0].refuses_from),
        *_fates("fate centre kept", doubles=laws[1].worst, pencil=laws[3].worst),
    )
    return Singularity("parallel lines", "angle of two lines", laws, fates)


# guide bars

FLOOR = 1e-17  # of the charts
BESIDE_PIVOT = (1e-8, 0.03)  # over which slopes are fitted beside the pivot of a bar
BAR_LAWS = "place bar", "acceleration Coriolis", "acceleration bar"


def _bar(ground: float, crank: float, angle: float) -> tuple[Mechanism, float, float]:
    """A bar that swings about C on the pin B of the crank (lengths in mm, angle in degrees); with the crank's rate
    (rad/s) and length (m)."""
    scene = _scene("bar", ("frame.points.A", [0, ground]), ("links.1.length", crank), ("driver.angle", angle))
    return scene, scene.drivers[0].values[1], abs(scene.by_name["1"].points["B"])


def _exact_bar(mp: MPContext, a: mpf, d: mpf, rate: float, angle: mpf) -> Turning:
    """Direction of the bar, Coriolis and second rate, by the vector w from C to the pin B: omega = Im w'/w,
    sliding = Re w'/w |w|."""
    b = a * mp.expj(angle)
    w, dw, ddw = mp.mpc(0, d) + b, 1j * rate * b, -rate * rate * b
    turn = dw / w
    return Turning(w / abs(w), (2 * turn.imag * turn.real * abs(w), (ddw / w - turn * turn).imag))


def _in_doubles(scene: Mechanism, angle: float) -> Turning:
    """The closed form in doubles only, without more digits where these do not suffice; nan where it refuses."""
    asked = [*map(Symbol.parse, ("theta_3", "omega_3", "alpha_3", "v_B@2/B@3"))]
    values = prepare(_turned(scene, angle), asked).at(angle)
    theta, omega, alpha, x, y = values or (math.nan,) * 5
    u = complex(math.cos(theta), math.sin(theta))
    return Turning(u, (2 * omega * (x * u.real + y * u.imag), alpha))


def near_ground(mp: MPContext, samples: int = 4) -> Singularity:
    """Crank nearly as long as the ground, its pin beside the bar's pivot C, both at a distance of the same order.

    Coriolis grows as distance^-1, the second rate of the bar as distance^-2, their relative errors as distance^-1.
    """
    x = grid(0.3, 1e-8, samples)
    sizes, stated = [], []

    def closed(e: float) -> Answer:
        angle = -math.pi / 2 + e
        scene, rate, a = _bar(100, 100 * (1 - e), -90)
        right = _exact_bar(mp, mp.mpf(a), mp.mpf(scene.frame.points["A"].imag), rate, mp.mpf(angle))
        coriolis, alpha = right.rates
        sizes.append(Answer((float(abs(coriolis / (a * rate**2))), float(abs(alpha / rate**2)))))
        motion = solver.solve(_turned(scene, angle))
        if motion.status[0] == "ok":
            stated.append(float(abs(float(motion.alpha("3")[0]) / alpha - 1)))
        bar = _in_doubles(scene, angle)
        return Answer(right.off(complex(bar.u), *map(float, bar.rates)))

    laws = measured([ErrorLaw(name, theory=-1.0, window=BESIDE_PIVOT) for name in BAR_LAWS], x, map(closed, x), samples)
    growing = [ErrorLaw(f"size {size}", theory=slope, window=(1e-12, 0.03), lost=math.inf)
               for size, slope in (("Coriolis", -1.0), ("bar", -2.0))]
    growth = measured(growing, x, sizes, samples)
    coriolis, bar = (true_minus(f"{law.slope:.2f}") for law in growth)
    fates = _fates("fate near ground", doubles=laws[2].worst, solved=max(stated, default=math.nan))
    grown = Phrase("grows", coriolis=coriolis, bar=bar)
    return Singularity("near ground", "crank from ground", laws, (grown, *fates), growth)


def flip(mp: MPContext, samples: int = 4) -> Singularity:
    """Crank as long as the ground: its pin B passes through the bar's pivot C, and the bar flips over.

    With the crank turned by e from there, CB = 2 a sin(e/2) and the bar turns at half the speed of the crank: no value
    grows, but the direction of CB comes from a length that goes to zero, the rate from it and again from the length.
    Second rates, which are zero, count in parts of the crank's rate squared, and so keep growing.
    """
    scene, rate, a = _bar(100, 100, -80)

    def closed(e: float) -> Answer:
        angle = -math.pi / 2 + e
        right = _exact_bar(mp, mp.mpf(a), mp.mpf(a), rate, mp.mpf(angle))
        bar = _in_doubles(scene, angle)
        coriolis, alpha = map(float, bar.rates)
        direction, error = Turning(right.u, right.rates[:1]).off(complex(bar.u), coriolis)
        return Answer((direction, error, abs(alpha) / rate**2))

    def solved(e: float) -> Answer:
        motion = solver.solve(_turned(scene, -math.pi / 2 + e))
        if motion.status[0] != "ok":
            return Answer((math.nan,))
        alpha, bound = abs(float(motion.alpha("3")[0])), float(motion.bound.alpha[0])
        return Answer((max(alpha / rate**2, FLOOR),), bounds=(bound / rate**2,))

    def drawn(e: float) -> Answer:
        alpha, remarks = _drawn(_turned(scene, -math.pi / 2 + e), "alpha", "3")
        return Answer((abs(alpha) / rate**2,), "short arm" in remarks)

    x = grid(0.5, 1e-9, samples)
    few = x[::samples]
    in_doubles = [ErrorLaw(name, theory=slope, window=BESIDE_PIVOT, lost=lost)
                  for name, slope, lost in zip(BAR_LAWS, (-1.0, -2.0, -3.0), (LOST, LOST, math.inf), strict=True)
                  ]
    board = ErrorLaw("acceleration bar drawn", theory=-3.0, window=(1e-8, 0.1), lost=math.inf)
    laws = (
        *measured(in_doubles, x, map(closed, x), samples),
        *measured([ErrorLaw("acceleration bar solved")], x, map(solved, x), samples),
        *measured([board], few, map(drawn, few)),
    )
    fates = (
        *_fates("fate flip solved", distance=laws[3].refuses_from),
        *_fates("fate flip drawn", distance=laws[4].refuses_from),
    )
    return Singularity("guide flip", "crank from flip", laws, fates)


def slow_sliding(mp: MPContext, samples: int = 4) -> Singularity:
    """Crank and ground in line: the block stands still on its bar.  The sliding velocity goes to zero and loses its
    digits; what it is only a part of does not."""
    scene, rate, _ = _bar(350, 90, 90)
    a, d = mp.mpf(scene.by_name["1"].length), mp.mpf(scene.frame.points["A"].imag)

    def beside(e: float) -> Mechanism:
        return _turned(scene, mp.pi / 2 + mp.mpf(e))

    def right(e: float) -> tuple[mpf, mpf]:
        """Sliding velocity and rate of the bar, the crank turned by e from the prolongation of the ground:
        c2 = a2 + d2 + 2 a d cos e."""
        c = mp.sqrt(a * a + d * d + 2 * a * d * mp.cos(e))
        return -a * d * mp.sin(e) * rate / c, rate * a * (a + d * mp.cos(e)) / (c * c)

    def solved(e: float) -> Answer:
        motion = solver.solve(beside(e))
        rates = float(motion.slide("2/3")[1][0]), float(motion.omega("3")[0])
        return Answer([float(abs(value / exact - 1)) for value, exact in zip(rates, right(e), strict=True)])

    def by_pencil(e: float) -> Answer:
        predicted = predict(plan(beside(e)), "pencil", scene.question.sheet.tools, together=False)
        symbols = Symbol.parse("v_B@3/B@2"), Symbol("omega", link="3")
        return Answer([float(predicted[s].deviation / abs(size)) for s, size in zip(symbols, right(e), strict=True)])

    exact = ErrorLaw("velocity sliding", theory=-1.0, window=(1e-13, 0.1)), ErrorLaw("velocity bar", theory=0.0)
    drawn = [ErrorLaw(f"{law.key} pencil", theory=law.theory, lost=2.0) for law in exact]
    x, few = grid(0.3, 1e-15, samples), grid(0.3, 1e-4, 1)
    laws = measured(exact, x, map(solved, x), samples) + measured(drawn, few, map(by_pencil, few))
    sliding, bar, sliding_pencil, bar_pencil = (law.worst for law in laws)
    fates = _fates("fate sliding", sliding=sliding, bar=bar, sliding_pencil=sliding_pencil, bar_pencil=bar_pencil)
    return Singularity("slow sliding", "crank from line", laws, fates)


# a drawing made small

POINTS_ONLY = Tools(line_width=0.2, ruler=0.0, compass=0.0, set_square=0.0, protractor=0.0)


def drawing_scale(mp: MPContext, samples: int = 1) -> Singularity:
    """Predicted uncertainty of the slider's velocity against the length of the crank on paper, all three figures drawn
    larger alike: errors of points and lengths fall as 1/size, those of set squares stay.

    Parameters
    ----------
    mp, samples : as for the others; not used, since nothing is random here
    """
    scene = mechanism_of("slider-crank-offset")
    symbol = Symbol.parse(f"v_{next(iter(scene.links[-1].points))}")
    planned = plan(scene, find=(symbol,))
    crank = (scene.links[0].length or scene.size) / planned.scales.length
    right = abs(execute(planned, EXACT).vectors["velocity"][symbol].span * planned.scales.velocity)
    sizes = sorted(size for size in (1e3 / v for v in grid(0.3e3, 1.0, 1)) if 3.0 <= size <= 1000.0)

    def errors(size: float) -> Answer:
        times = crank / size
        old = planned.scales
        scales = Scales(*(s * times for s in (old.length, old.velocity, old.acceleration)))
        larger = replace(planned, scales=scales)
        return Answer([predict(larger, "pencil", tools, together=False)[symbol].deviation / right
                       for tools in (POINTS_ONLY, scene.question.sheet.tools)])

    stated = ErrorLaw("pencil points", theory=-1.0, lost=1.0), ErrorLaw("pencil all", lost=1.0)
    laws = measured(stated, sizes, map(errors, sizes))
    points, all_tools = laws
    fate = Phrase(
        "fate scale", small=f"{sizes[0]:.2g}", large=f"{sizes[-1]:.4g}",
        points_small=in_powers(points.error[0]), points_large=in_powers(points.error[-1]),
        all_small=in_powers(all_tools.error[0]), all_large=in_powers(all_tools.error[-1]),
    )
    return Singularity("small scale", "crank on paper", laws, (fate,))


# all of them

KINDS: dict[str, Callable[..., Singularity]] = {
    "dead point RRR": partial(dead_point, "RRR"),
    "dead point RRP": partial(dead_point, "RRP"),
    "dead point RPR": partial(dead_point, "RPR"),
    "crossing height": crossing_height,
    "angle near zero": angle_formulas,
    "differences": differences,
    "parallel lines": parallel_lines,
    "near ground": near_ground,
    "guide flip": flip,
    "slow sliding": slow_sliding,
    "small scale": drawing_scale,
}


def run_singularities(kinds: Iterable[str] = (), samples: int = 4) -> tuple[Singularity, ...]:
    """Measure the errors beside singular positions.

    Parameters
    ----------
    kinds : names from ``KINDS``; all if none is named
    samples : distances to each half of a decade, of which the largest error counts

    Raises
    ------
    CallError : mpmath is not installed
    """
    mp: MPContext = context()
    return tuple(KINDS[kind](mp, samples=samples) for kind in (tuple(kinds) or KINDS))
