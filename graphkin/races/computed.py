"""Methods that compute: the closed form in its several dresses, Newton's method, differences, a complex step."""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial

import numpy as np

from graphkin import solver
from graphkin.races.timing import Entry, best_time
from graphkin.races.work import Work
from graphkin.solver import PreparedMechanism
from graphkin.solver.assemblies import choose_forms
from graphkin.solver.code import Code
from graphkin.solver.expressions import Name
from graphkin.solver.pose import Array
from graphkin.solver.prepared import formulas
from graphkin.solver.program import program_of
from graphkin.study.equations import Equations, Solution

__all__ = ["Numeric", "closed_forms", "complex_step", "copy_time", "differences", "newton", "one_by_one"]

ITERATIONS = range(1, 7)
STEPS = range(1, 10)
COMING = math.radians(5.0)
"""Newton's method starts from the position so far before, as a program does that steps through a turn."""
BATCH = 480
ENOUGH = 10


def copy_time(work: Work, repeats: int) -> tuple[float, float]:
    """What it costs to copy the velocities of a position, and these with the accelerations (s): the floor."""
    whole = np.ones((4 * len(work.outputs), work.count))
    target = np.empty_like(whole)
    half = 2 * len(work.outputs)
    pairs = (target[:half], whole[:half]), (target, whole)
    quick, all_of = (best_time(partial(np.copyto, *pair), repeats) / work.count for pair in pairs)
    return quick, all_of


def columns_of(work: Work, kinds: str = "va") -> list[str]:
    """Names of columns: velocities ("v"), accelerations ("a") and places ("z") of all outputs."""
    return [str(o.ref) if kind == "z" else f"{kind}_{o.ref}" for kind in kinds for o in work.outputs]


def vectors(columns: Array) -> Array:
    """Columns x, y, x, y, ... as complex arrays, shape (vectors, n)."""
    return np.asarray(columns[0::2] + 1j * columns[1::2])


def closed_forms(work: Work, repeats: int) -> Iterator[Entry]:
    """As arrays in double and single precision, compiled where numba is installed, in plain floats one by one."""
    slow, both = (solver.prepare(work.structure, columns_of(work, kinds)) for kinds in ("v", "va"))
    ways, rooms = (slow, both), [np.empty((len(p.names), work.count)) for p in (slow, both)]
    values = work.values[:, 0]
    many = both.range.grid(work.count).values

    def entry(key: str, columns: Array, costs: Sequence[float]) -> Entry:
        found = vectors(columns)
        half = len(work.outputs)
        return Entry("closed", key, "", costs[0], costs[1], *work.errors(found[:half], found[half:]))

    def timed(run: Callable[[PreparedMechanism, Array], object]) -> list[float]:
        return [best_time(partial(run, p, r), repeats) / work.count for p, r in zip(ways, rooms, strict=True)]

    yield entry("closed arrays", both.columns(values)[0], timed(lambda p, r: p.sweep(work.count, r)))
    yield one_by_one(work, repeats, "")
    runs = [single_precision(work, kinds) for kinds in ("v", "va")]
    costs = [best_time(partial(run, many.astype(np.float32)), repeats) / work.count for run in runs]
    yield entry("closed single", runs[1](values.astype(np.float32)).astype(float), costs)
    if importlib.util.find_spec("numba") is not None:
        found = both.columns(values, fast=True)[0]
        with _one_core():
            costs = timed(lambda p, r: p.sweep(work.count, r, fast=True))
        yield entry("closed compiled", found, costs)


@contextmanager
def _one_core() -> Iterator[None]:
    """Compiled code on one core, like all the other methods."""
    import numba

    threads = numba.get_num_threads()
    numba.set_num_threads(1)
    try:
        yield
    finally:
        numba.set_num_threads(threads)


def one_by_one(work: Work, repeats: int, tag: str) -> Entry:
    """The closed form in plain floats, as a drawing of one position needs it."""
    slow, both = (solver.prepare(work.structure, columns_of(work, kinds)) for kinds in ("v", "va"))
    few = [float(v) for v in work.values[:, 0]]
    costs = [best_time(lambda way=p.at: list(map(way, few)), repeats) / len(few) for p in (slow, both)]  # type: ignore[misc]
    found = vectors(np.array([both.at(v) for v in few]).T)
    half = len(work.outputs)
    return Entry("closed", "closed floats", tag, costs[0], costs[1], *work.errors(found[:half], found[half:]))


def single_precision(work: Work, kinds: str) -> Callable[[Array], Array]:
    """The same formulas in numbers of 7 digits: a function of the values of the first driver."""
    structure, drivers = work.structure, work.scene.drivers
    dimensioned = program_of(structure, tuple(d.values[2] != 0 for d in drivers))
    program = dimensioned.program
    code = Code(program.graph, list(formulas(program, structure, columns_of(work, kinds)).values()))
    forms = choose_forms(structure)
    given: dict[Name, float] = {}
    for k, driver in enumerate(drivers):
        value, given["rate", k], given["second", k] = driver.values
        given["cos", k], given["sin", k], given["travel", k] = math.cos(value), math.sin(value), value
    given |= {("sign", i): float(form) for i, form in forms.items()}
    same = [np.asarray(x, dtype=np.float32) for x in code.same(dimensioned.params(code.params, given)) or []]

    def run(values: Array) -> Array:
        moving = {("cos", 0): np.cos(values), ("sin", 0): np.sin(values), ("travel", 0): values}
        inputs = [moving[name] if name in moving else np.full(len(values), given[name], dtype=np.float32)
                  for name in code.inputs]
        out = np.empty((len(code.asked), len(values)), dtype=np.float32)
        code.arrays(same, inputs, list(out))
        return out

    return run


class Numeric:
    """The closure equations at the places, and at a batch of which the time is taken."""

    def __init__(self, work: Work) -> None:
        self.work = work
        self.equations = Equations(work.structure)
        drivers = work.scene.drivers
        self.first, self.second = [d.values[1] for d in drivers], [d.values[2] for d in drivers]
        self.values = [work.values[:, k] for k in range(len(drivers))]
        at = [int(np.argmin(np.max(np.abs(work.motion.values - v), axis=1))) for v in work.values]
        before = self.equations.start(work.motion)[:, at]
        # of a limited motion a step that stays inside it: its ends are left out by twice as much
        step = COMING if work.full else float(np.ptp(work.values[:, 0])) / 48
        earlier = [self.values[0] - math.copysign(step, self.first[0]), *self.values[1:]]
        for _ in range(ENOUGH):
            before = self.equations.improved(before, earlier)
        self.before = before
        times = max(1, BATCH // len(work.values))
        self.many_before = np.tile(before, times)
        self.many_values = [np.tile(v, times) for v in self.values]
        self.count = self.many_before.shape[1]

    def points(self, found: Solution) -> tuple[Array, Array]:
        """Velocities and accelerations of the outputs."""
        structure, rows_v, rows_a = self.work.structure, [], []
        for output in self.work.outputs:
            local: complex | Array = structure.links[output.link].points.get(output.point, 0j)
            if not output.own:
                holder = next(n for n in self.equations.names if output.point in structure.links[n].points)
                x, y = self.equations.point(found, holder, structure.links[holder].points[output.point])[:2]
                k = self.equations.column[output.link]
                own_x, own_y, angle = found.place[k : k + 3]
                local = (x - own_x + 1j * (y - own_y)) * np.exp(-1j * angle)
            _, _, vx, vy, ax, ay = self.equations.point(found, output.link, local)
            rows_v.append(vx + 1j * vy)
            rows_a.append(ax + 1j * ay)
        return np.array(rows_v), np.array(rows_a)


def newton(work: Work, repeats: int) -> Iterator[Entry]:
    """Newton's method on the closure equations, by the number of its steps, then one linear system for the velocities
    and one for the accelerations."""
    own = Numeric(work)

    def solve(x: Array, values: list[Array], steps: int) -> Solution:
        for _ in range(steps):
            x = own.equations.improved(x, values)
        return own.equations.rates(x, values, own.first, own.second)

    def speeds(x: Array, values: list[Array], steps: int) -> Array:
        for _ in range(steps):
            x = own.equations.improved(x, values)
        return own.equations.velocities(x, values, own.first)

    for steps in ITERATIONS:
        errors = work.errors(*own.points(solve(own.before, own.values, steps)))
        quick = best_time(lambda k=steps: speeds(own.many_before, own.many_values, k), repeats)  # type: ignore[misc]
        whole = best_time(lambda k=steps: solve(own.many_before, own.many_values, k), repeats)  # type: ignore[misc]
        yield Entry("newton", "Newton", str(steps), quick / own.count, whole / own.count, *errors)


def complex_step(work: Work, repeats: int) -> Iterator[Entry]:
    """Velocities as the imaginary part of places, accelerations as that of velocities, the time being i h."""
    own = Numeric(work)
    h = 1e-30

    def run(before: Array, values: list[Array], pushes: bool) -> tuple[Array, Array]:
        x, t = before.astype(complex), 1j * h
        shifted = [v + f * t + s * t * t / 2 for v, f, s in zip(values, own.first, own.second, strict=True)]
        for _ in range(ENOUGH - 4):
            x = own.equations.improved(x, shifted)
        first = [f + s * t for f, s in zip(own.first, own.second, strict=True)]
        speed = own.equations.velocities(x, shifted, first) if pushes else x
        return x, speed

    x, speed = run(own.before, own.values, True)
    v, a = own.points(Solution(x.real, x.imag / h, speed.imag / h))
    quick = best_time(lambda: run(own.many_before, own.many_values, False), repeats) / own.count
    whole = best_time(lambda: run(own.many_before, own.many_values, True), repeats) / own.count
    yield Entry("complex step", "complex step", "", quick, whole, *work.errors(v, a))


def differences(work: Work, repeats: int) -> Iterator[Entry]:
    """Central differences of places in closed form, by the step (rad of the crank, or parts of the size); for one
    driver."""
    if len(work.scene.drivers) > 1:
        return
    # a point under a pin is another one of its link at every moment: its places are no path
    work = work.only([o for o in work.outputs if o.own])
    closed = solver.prepare(work.structure, columns_of(work, "z"))
    _, first, second = work.scene.drivers[0].values
    many = closed.range.grid(work.count).values

    def places(values: Array, t: float) -> Array:
        return vectors(closed.columns(values + first * t + second * (t * t / 2))[0])

    def speeds(values: Array, t: float) -> Array:
        return np.asarray((places(values, t) - places(values, -t)) / (2 * t))

    def pushes(values: Array, t: float) -> Array:
        return np.asarray((places(values, t) - 2 * places(values, 0.0) + places(values, -t)) / t**2)

    own = 1.0 if work.scene.drivers[0].turns else work.scene.size
    here = work.values[:, 0]
    quick = best_time(lambda: speeds(many, 1e-4), repeats) / work.count
    whole = quick + best_time(lambda: pushes(many, 1e-4), repeats) / work.count
    for k in STEPS:
        t = 10.0**-k * own / abs(first)
        errors = work.errors(speeds(here, t), pushes(here, t))
        yield Entry("differences", "differences", f"1e-{k}", quick, whole, *errors)
