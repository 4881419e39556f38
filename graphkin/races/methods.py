"""graphkin's methods on the same work: the closed form in its several forms, Newton's method, differences, a complex
step; and the drawing methods: the exact board, a drafting program, pencil and ruler at several scales, instant
centres."""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

import numpy as np

from graphkin import solver
from graphkin.checking.readings import read_off
from graphkin.construction import EXACT, Instrument, Plan, Scales, Sheet, cad, execute, pencil, plan
from graphkin.construction.centres import find_centres
from graphkin.races.work import Entry, Work, best_time, point_rates
from graphkin.scene.symbol import Symbol
from graphkin.solver.algebra.expressions import Code
from graphkin.solver.algebra.pose import Array
from graphkin.solver.prepared import PreparedMechanism, prepare
from graphkin.study.equations import Equations, Solution

ITERATIONS = range(1, 7)
STEPS = range(1, 10)
COMING = math.radians(5.0)
"""Newton's method starts from the position so far before, as a program does that steps through a turn."""
BATCH = 480
ENOUGH = 10
EVERY = 4
SEEDS = 3
SCALES = (0.25, 0.5, 1.0, 2.0, 4.0)
SECONDS = 20.0
"""What a person needs for one act at the board: setting a square, laying off, pricking, reading."""


def copy_time(work: Work, repeats: int) -> tuple[float, float]:
    """The time to copy the velocities of a position, and velocities with accelerations (s): the floor."""
    whole = np.ones((4 * len(work.outputs), work.count))
    target = np.empty_like(whole)
    half = 2 * len(work.outputs)
    pairs = (target[:half], whole[:half]), (target, whole)
    quick, all_of = (best_time(partial(np.copyto, *pair), repeats) / work.count for pair in pairs)
    return quick, all_of


# the closed form


def columns_of(work: Work, kinds: str = "va") -> list[Symbol]:
    """Velocities ("v"), accelerations ("a") and places ("z") of all outputs."""
    return [Symbol("place" if kind == "z" else kind, ref) for kind in kinds for ref in work.outputs]


def vectors(columns: Array) -> Array:
    """Columns x, y, x, y, ... as complex arrays, shape (vectors, n)."""
    return np.asarray(columns[0::2] + 1j * columns[1::2])


def _closed(work: Work, key: str, tag: str, columns: Array, costs: Sequence[float]) -> Entry:
    """The entry of columns with velocities first and accelerations after them."""
    values, half = vectors(columns), len(work.outputs)
    return Entry("closed", key, tag, costs, work.errors(values[:half], values[half:]))


def _prepared(work: Work) -> tuple[PreparedMechanism, PreparedMechanism]:
    """The prepared mechanism for velocities alone, and with accelerations."""
    slow, both = (prepare(work.structure, columns_of(work, kinds)) for kinds in ("v", "va"))
    return slow, both


def closed_forms(work: Work, repeats: int) -> Iterator[Entry]:
    """The closed form as arrays in double and single precision, compiled if numba is installed, and in plain floats one
    by one."""
    mechanisms = _prepared(work)
    both = mechanisms[1]
    rooms = [np.empty((len(p.names), work.count)) for p in mechanisms]
    values = work.values[:, 0]
    many = both.range.grid(work.count).values

    def timed(run: Callable[[PreparedMechanism, Array], object]) -> list[float]:
        return [best_time(partial(run, p, room), repeats) / work.count
                for p, room in zip(mechanisms, rooms, strict=True)]

    costs = timed(lambda p, room: p.sweep(work.count, room))
    yield _closed(work, "closed arrays", "", both.columns(values)[0], costs)
    yield one_by_one(work, repeats, "")
    runs = [single_precision(work, kinds) for kinds in ("v", "va")]
    costs = [best_time(partial(run, many.astype(np.float32)), repeats) / work.count for run in runs]
    yield _closed(work, "closed single", "", runs[1](values.astype(np.float32)).astype(float), costs)
    if importlib.util.find_spec("numba") is not None:
        columns = both.columns(values, fast=True)[0]
        with _one_core():
            costs = timed(lambda p, room: p.sweep(work.count, room, fast=True))
        yield _closed(work, "closed compiled", "", columns, costs)


@contextmanager
def _one_core() -> Iterator[None]:
    """A context with compiled code on one core, like all the other methods."""
    import numba

    threads = numba.get_num_threads()
    numba.set_num_threads(1)
    try:
        yield
    finally:
        numba.set_num_threads(threads)


def one_by_one(work: Work, repeats: int, tag: str) -> Entry:
    """The closed form in plain floats, as a drawing of one position needs it."""
    mechanisms = _prepared(work)
    few = [float(v) for v in work.values[:, 0]]
    costs = [best_time(lambda at=p.at: list(map(at, few)), repeats) / len(few)  # type: ignore[misc]
             for p in mechanisms]
    return _closed(work, "closed floats", tag, np.array([mechanisms[1].at(v) for v in few]).T, costs)


def single_precision(work: Work, kinds: str) -> Callable[[Array], Array]:
    """The formulas in numbers of 7 digits: a function of the values of the first driver."""
    ready = prepare(work.structure, columns_of(work, kinds))
    code = Code(ready.dimensioned.program.graph, ready.asked, ready.fixed)
    invariants = code.invariants(ready.given(code), np.float32)

    def run(values: Array) -> Array:
        given = {} if ready.signs is not None else ready.signs_at(values)
        given |= {("cos", 0): np.cos(values), ("sin", 0): np.sin(values), ("travel", 0): values}
        out = np.empty((len(code.asked), len(values)), dtype=np.float32)
        code.arrays(invariants, [given[name] for name in code.inputs], list(out))
        return out

    return run


def whole_solve(work: Work, repeats: int) -> Iterator[Entry]:
    """``solver.solve`` over a turn: the closed form with continuity, status and bounds of every position."""
    if not work.full:
        return
    count = work.count // 10
    whole = best_time(lambda: solver.solve(work.scene, sweep=count), repeats) / count
    points = [work.motion.posed.point(ref) for ref in work.outputs]
    v = np.array([point.v[work.rows] for point in points])
    a = np.array([point.a[work.rows] for point in points])
    yield Entry("closed", "whole solve", "", (whole, whole), work.errors(v, a))


# the closure equations in numbers


class Numeric:
    """The closure equations at the places, and at the positions of a timed batch."""

    def __init__(self, work: Work) -> None:
        self.work = work
        self.equations = Equations(work.structure)
        drivers = work.scene.drivers
        self.first, self.second = [d.values[1] for d in drivers], [d.values[2] for d in drivers]
        self.values = [work.values[:, k] for k in range(len(drivers))]
        before = self.equations.start(work.motion)[:, work.rows]
        # of a limited motion a step that stays inside it: its ends are left out by twice as much
        step = COMING if work.full else float(np.ptp(work.values[:, 0])) / 48
        earlier = [self.values[0] - math.copysign(step, self.first[0]), *self.values[1:]]
        self.before = self.closed(before, earlier, ENOUGH)
        times = max(1, BATCH // len(work.values))
        self.many_before = np.tile(self.before, times)
        self.many_values = [np.tile(v, times) for v in self.values]
        self.count = len(self.many_values[0])

    def closed(self, x: Array, values: list[Array], steps: int) -> Array:
        """The unknowns after some steps of Newton's method."""
        for _ in range(steps):
            x = self.equations.improved(x, values)
        return x

    def points(self, solution: Solution) -> tuple[Array, Array]:
        """Velocities and accelerations of the outputs."""
        return point_rates(self.equations, solution, self.work.outputs)

    def cost(self, run: Callable[[Array, list[Array]], object], repeats: int) -> float:
        """The time of a position (s), of a function of unknowns to start from and driver values."""
        return best_time(lambda: run(self.many_before, self.many_values), repeats) / self.count


def newton(work: Work, repeats: int) -> Iterator[Entry]:
    """Newton's method on the closure equations, by the number of its steps, then one linear system for the velocities
    and one for the accelerations."""
    numeric = Numeric(work)

    def speeds(steps: int, x: Array, values: list[Array]) -> Array:
        return numeric.equations.velocities(numeric.closed(x, values, steps), values, numeric.first)

    def rates(steps: int, x: Array, values: list[Array]) -> Solution:
        return numeric.equations.rates(numeric.closed(x, values, steps), values, numeric.first, numeric.second)

    for steps in ITERATIONS:
        errors = work.errors(*numeric.points(rates(steps, numeric.before, numeric.values)))
        costs = [numeric.cost(partial(run, steps), repeats) for run in (speeds, rates)]
        yield Entry("newton", "Newton", str(steps), costs, errors)


def complex_step(work: Work, repeats: int) -> Iterator[Entry]:
    """Velocities as the imaginary part of places, accelerations as the imaginary part of velocities, at the time i
    h."""
    numeric = Numeric(work)
    h = 1e-30

    def run(before: Array, values: list[Array], pushes: bool) -> tuple[Array, Array]:
        t = 1j * h
        shifted = [v + f * t + s * t * t / 2 for v, f, s in zip(values, numeric.first, numeric.second, strict=True)]
        x = numeric.closed(before.astype(complex), shifted, ENOUGH - 4)
        first = [f + s * t for f, s in zip(numeric.first, numeric.second, strict=True)]
        return x, numeric.equations.velocities(x, shifted, first) if pushes else x

    x, speed = run(numeric.before, numeric.values, True)
    v, a = numeric.points(Solution(x.real, x.imag / h, speed.imag / h))
    costs = [numeric.cost(partial(run, pushes=pushes), repeats) for pushes in (False, True)]
    yield Entry("complex step", "complex step", "", costs, work.errors(v, a))


def differences(work: Work, repeats: int) -> Iterator[Entry]:
    """Central differences of places in closed form, by the step (rad of the crank, or parts of the size); for one
    driver."""
    if len(work.scene.drivers) > 1:
        return
    # a point under a pin is another one of its link at every moment: its places are no path
    work = work.only([ref for ref in work.outputs if not ref.link])
    closed = prepare(work.structure, columns_of(work, "z"))
    _, first, second = work.scene.drivers[0].values
    many = closed.range.grid(work.count).values

    def places(values: Array, t: float) -> Array:
        return vectors(closed.columns(values + first * t + second * (t * t / 2))[0])

    def speeds(values: Array, t: float) -> Array:
        return np.asarray((places(values, t) - places(values, -t)) / (2 * t))

    def pushes(values: Array, t: float) -> Array:
        return np.asarray((places(values, t) - 2 * places(values, 0.0) + places(values, -t)) / t**2)

    unit = 1.0 if work.scene.drivers[0].turns else work.scene.size
    here = work.values[:, 0]
    quick = best_time(lambda: speeds(many, 1e-4), repeats) / work.count
    whole = quick + best_time(lambda: pushes(many, 1e-4), repeats) / work.count
    for k in STEPS:
        t = 10.0**-k * unit / abs(first)
        errors = work.errors(speeds(here, t), pushes(here, t))
        yield Entry("differences", "differences", f"1e-{k}", (quick, whole), errors)


# drawn


def drawn(work: Work, repeats: int) -> Iterator[Entry]:
    """The whole construction with each instrument, and the exact construction of the asked quantities alone."""
    few = work.some(EVERY)
    plans = [plan(work.scene, at, ()) for at in few.positions]
    yield _drawn(few, plans, "exact drawing", "", [EXACT], repeats)
    yield _drawn(few, plans, "cad drawing", "", [cad()], repeats)
    tools = work.scene.question.sheet.tools
    for factor in SCALES:
        larger = [_larger(p, factor) for p in plans]
        hands: list[Instrument] = [pencil(tools, seed) for seed in range(SEEDS)]
        entry = _drawn(few, larger, "pencil", f"{factor:g}", hands, repeats)
        yield entry
        yield replace(entry, family="by hand", key="by hand", costs=[count * SECONDS for count in acts(larger[0])])
    asked = few.only(few.asked_outputs())
    short = [plan(work.scene, at, columns_of(asked)) for at in few.positions]
    yield _drawn(asked, short, "exact drawing", "asked", [EXACT], repeats)


def _larger(planned: Plan, factor: float) -> Plan:
    s = planned.scales
    return replace(planned, scales=Scales(s.length / factor, s.velocity / factor, s.acceleration / factor))


def acts(planned: Plan) -> tuple[int, int]:
    """The number of acts of the hand in drawing a plan and reading it off, for velocities alone and with
    accelerations."""
    hand = pencil(planned.structure.scene.question.sheet.tools, 0)
    sheet = execute(planned, hand)
    read_off(sheet, (), hand)
    return round(hand.acts * _velocity_share(sheet)), hand.acts


def _velocity_share(sheet: Sheet) -> float:
    """The part of the steps that velocities alone need."""
    return sum(s.diagram != "acceleration" for s in sheet.steps) / len(sheet.steps)


def _drawn(work: Work, plans: Sequence[Plan], key: str, tag: str, hands: Sequence[Instrument], repeats: int) -> Entry:
    """The entry of a drawn plan with the largest errors of some hands."""
    worst: list[float | None] = [0.0, 0.0]
    for hand in hands:
        tables = [{r.symbol: r.value for r in read_off(execute(p, hand), (), hand)} for p in plans]
        rows = ([[table.get(Symbol(kind, ref)) for table in tables] for ref in work.outputs] for kind in "va")
        errors = work.errors(*map(_if_all, rows))
        worst = [None if w is None or e is None else max(w, e) for w, e in zip(worst, errors, strict=True)]
    whole = best_time(lambda: [read_off(execute(p, hands[0]), (), hands[0]) for p in plans], repeats) / len(plans)
    part = _velocity_share(execute(plans[0], EXACT))
    return Entry("drawn", key, tag, (whole * part, whole), worst)


def instant_centres(work: Work, repeats: int) -> Iterator[Entry]:
    """Velocities by centres, found on the drawn position; they give no accelerations."""
    few = work.some(EVERY)
    sheets = [execute(plan(work.scene, at, ())) for at in few.positions]
    poles = [find_centres(work.scene, sheet.drivers, sheet=sheet) for sheet in sheets]
    velocities = [[centres.velocity(Symbol("v", ref)) for centres in poles] for ref in few.outputs]
    errors = few.errors(_if_all(velocities), None)
    if errors[0] is None:
        return
    cost = best_time(
        lambda: [find_centres(work.scene, sheet.drivers, sheet=sheet).turning for sheet in sheets], repeats
    ) / len(sheets)
    yield Entry("drawn", "instant centres", "", (cost, cost), errors)


def _if_all(vectors: Sequence[Sequence[complex | float | None]]) -> Array | None:
    """Vectors as an array; None where one is missing."""
    return None if any(v is None for row in vectors for v in row) else np.array(vectors, complex)


METHODS: tuple[Callable[[Work, int], Iterator[Entry]], ...] = (
    closed_forms, whole_solve, newton, differences, complex_step, drawn, instant_centres,
)
"""All of ours, in the order in which they run."""
