"""All elements of a structure in their order, at many driver values at once; positions near dead points, for which 16
digits are too few, are computed again in 50; and the decision in 50 digits whether a group of two links closes, where
16 are not enough.

The discriminant of a dyad is positive where it closes, zero where its two assemblies meet, negative where its links do
not reach each other.  With it goes the error from the digits that the file leaves open: a number written as a short
decimal is taken for that decimal.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from decimal import Decimal

import numpy as np

from graphkin.scene.pairs import LawCam
from graphkin.solver.algebra.bounds import LOOKED_UP, error_bounds, most_of, roughness
from graphkin.solver.algebra.dyads import DyadSolution
from graphkin.solver.algebra.expressions import DECIMALS, Code, Name, Real, Vec
from graphkin.solver.algebra.larger_groups import GroupSolved, solve_group
from graphkin.solver.algebra.pose import FIELDS, GIVEN, Array, Drive, ErrorBound, Pose, rest, turned
from graphkin.solver.compiled.program import DimensionedProgram, program_of
from graphkin.solver.drivers import cos_sin, law_doubts, meant, meant_angle, working
from graphkin.structure import LargerGroup, RollingRelation, Structure

ROUGH = 1e-10
"""Relative bound of a rate above which a position is computed in more digits."""
CLEAR = 0.05
"""Where the sines of all groups, multiplied, are greater than this no rate is rough."""


@dataclass(frozen=True, eq=False, repr=False)
class ExtendedPrecision:
    """Some formulas of a mechanism in fifty digits, at positions of its drivers.

    drive : of the drivers
    signs : the other inputs of the formulas, by name, shape (n,)
    """

    dimensioned: DimensionedProgram
    code: Code
    drive: Drive
    signs: Mapping[Name, Array]

    def place(self, rows: Array, asked: Sequence[Real | Vec], columns: Sequence[Array]) -> Array:
        """Compute some positions in 50 digits, in ``columns`` of ``asked``; whether each could be computed, bool, shape
        (n,)."""
        done = np.zeros(len(self.drive), dtype=bool)
        with working():
            for k in np.flatnonzero(rows).tolist():
                try:
                    row = [float(x) for x in self.row(k)]
                except ArithmeticError:
                    continue
                for x, column in zip(asked, columns, strict=True):
                    column[k] = complex(row.pop(0), row.pop(0)) if isinstance(x, Vec) else row.pop(0)
                done[k] = True
        return done

    def row(self, k: int, at: Sequence[Decimal] = ()) -> list[Decimal]:
        """The formulas at position ``k``, or with drivers at other values.  Raises ArithmeticError where groups have no
        place."""
        return self._row({name: number for name, (number, _) in self._numbers(k, at).items()})

    def __call__(self, *values: Decimal) -> Decimal:
        """The first formula at values of the drivers."""
        return self.row(0, values)[0]

    def with_doubt(self, k: int, at: Sequence[Decimal] = ()) -> tuple[Decimal, Decimal]:
        """The first of them, and how far the digits that the file leaves open may move it: wholly where groups have no
        place.

        Each number that is open is moved by itself; all together may move a product of small factors by as many times
        the sum of that.
        """
        numbers = self._numbers(k, at)
        given = {name: number for name, (number, _) in numbers.items()}
        errors = [(name, sign * error) for name, (_, error) in numbers.items() if error for sign in (1, -1)]
        try:
            value = self._row(given)[0]
            moved = [abs(self._row({**given, name: given[name] + error})[0] - value) for name, error in errors]
        except ArithmeticError:
            return Decimal(0), UNKNOWN
        return value, len(moved) * sum(moved, Decimal(0))

    def signed(self, k: int, at: Sequence[Decimal] = ()) -> tuple[Decimal, int]:
        """The first formula, and its sign: 0 where it cannot be told from zero."""
        value, doubt = self.with_doubt(k, at)
        return value, _sign(value, doubt)

    def _row(self, numbers: Mapping[Name, Decimal]) -> list[Decimal]:
        return self.code.values(numbers.__getitem__, {}, DECIMALS)

    def _numbers(self, k: int, at: Sequence[Decimal]) -> dict[Name, tuple[Decimal, Decimal]]:
        """The inputs of the formulas at position ``k``, and the error of each number."""
        given = {name: (Decimal(float(column[k])), Decimal(0)) for name, column in self.signs.items()}
        drivers = self.dimensioned.structure.drivers
        for j, (driver, doubts) in enumerate(zip(drivers, law_doubts(drivers).T.tolist(), strict=True)):
            value, first, second = (float(x[k, j]) for x in (self.drive.value, self.drive.rate, self.drive.second))
            number, exact = meant_angle(value) if driver.turns else meant(value)
            if driver.exact and value == driver.values[0]:
                number, exact = Decimal(driver.exact), True
            if j < len(at):
                number, exact, doubts[0] = at[j], True, 0.0
            error = Decimal(doubts[0] + (0 if exact else GIVEN * abs(value)))
            if driver.turns:
                cosine, sine = cos_sin(number)
                given["cos", j], given["sin", j] = (cosine, error), (sine, error)
            else:
                given["travel", j] = number, error
            for name, rate, doubt in (("rate", first, doubts[1]), ("second", second, doubts[2])):
                number, exact = meant(rate)
                given[name, j] = number, Decimal(doubt + (0 if exact else GIVEN * abs(rate)))
        return {name: given.get(name) or self.dimensioned.decimal(name) for name in self.code.leaves}


UNKNOWN = Decimal("Infinity")
SINGULAR = 1e-7
"""A group whose two loci cross at a smaller sine than this is at a dead point."""
TINY = 1e-25
"""The same where the driver's distance from the dead point is known to fifty digits."""


@dataclass(frozen=True, eq=False, repr=False)
class State:
    """The mechanism at n positions.

    poses : each link by its name, fields of shape (n,) or broadcasting to it
    drive : of the drivers and their followers, shape (n, drivers)
    groups : the solution of each group, by its index among the elements
    refined : positions that were computed in 50 digits, shape (n,)
    clear : positions far from every dead point of a dyad, without larger groups, shape (n,)
    slack : errors of lifts and of rolling links, as for ``error_bounds``
    singular : the sine below which a group is at a dead point, smaller if the driver is given from a dead point
    given : the formulas' inputs from followers of cams, rolling links and larger groups, by name, shape (n,)
    """

    poses: Mapping[str, Pose]
    drive: Drive
    groups: Mapping[int, DyadSolution | GroupSolved]
    refined: Array
    clear: Array
    slack: Array
    singular: Array
    given: Mapping[Name, Array] = field(default_factory=dict)

    def bounds(self, structure: Structure, rows: Array) -> dict[str, ErrorBound[Array]]:
        """The error bounds of each link at some of the positions, bool, shape (n,)."""
        poses = {name: pose.spread(len(self.drive)).rows(rows) for name, pose in self.poses.items()}
        return error_bounds(structure, poses, self.drive[rows], self.slack[rows], self.refined[rows])


def positions(
    structure: Structure,
    drive: Drive | None,
    modes: Mapping[int, Array],
    upto: int | None = None,
    rates: bool = True,
    extended: bool = True,
    known: dict[int, float] | None = None,
) -> State:
    """Solve every element at all positions of the drivers, each position by itself.

    Parameters
    ----------
    drive : of the drivers; None for the scene's own position
    modes : the assembly of each group, by its place among the elements: for a dyad the sign, shape (n,); for a larger
        group the poses from which Newton's method starts, shape (n, members, 3)
    upto : solve only the elements before this one
    rates : False leaves out velocity and acceleration
    extended : False keeps 16 digits everywhere: for curves, and along a path
    known : at one position, numbers of the formulas that are the same as in an earlier call, by the indices of their
        lines; new ones are added, so that later elements need no earlier formulas again.  The state then has only the
        last of the elements

    Returns
    -------
    State; at a position that cannot be assembled the discriminant of a group is negative and the poses have no meaning
    """
    with np.errstate(all="ignore"):
        run = _Run(structure, drive, modes, rates, extended, known)
        return run.state(len(structure.elements) if upto is None else upto, whole=known is None)


def own_position(
    structure: Structure, modes: Mapping[int, Array], upto: int | None = None, known: dict[int, float] | None = None
) -> State:
    """The mechanism at the scene's own position, without rates; ``modes`` are those of one position, the other
    parameters as for ``positions``."""
    return positions(structure, None, {i: mode[None] for i, mode in modes.items()}, upto, rates=False, known=known)


def new_places(structure: Structure, i: int, links: Sequence[str], poses: Mapping[str, Pose]) -> dict[str, complex]:
    """The places of the points that only this group has placed."""
    before = {structure.scene.frame.name}
    for element in structure.elements[:i]:
        before.update(element.members)
    known = {p for name in before for p in structure.links[name].points}
    places: dict[str, complex] = {}
    for name in links:
        pose = poses[name]
        for point, place in structure.links[name].points.items():
            if point not in known:
                places[point] = complex(np.ravel(pose.z + pose.u * place)[0])
    return places


def group_at(structure: Structure, drive: Drive, modes: Mapping[int, Array], which: int) -> GroupSolved:
    """A larger group alone, by its index among the elements, with its rates; see ``positions``."""
    with np.errstate(all="ignore"):
        run = _Run(structure, drive, modes, True)
        run.follow(which + 1)
        return run.larger_groups[which]


class _Run:
    """An evaluation: larger groups in order, each from the links on which it depends, then all formulas together."""

    def __init__(
        self,
        structure: Structure,
        drive: Drive | None,
        modes: Mapping[int, Array],
        rates: bool,
        extended: bool = True,
        known: dict[int, float] | None = None,
    ) -> None:
        drive = (Drive.at(structure) if drive is None else drive).followed(structure)
        self.structure, self.drive, self.modes = structure, drive, modes
        self.rates, self.extended = rates, extended
        self.known: dict[int, float] | None = {} if known is None else known
        self.n = len(drive)
        self.larger_groups: dict[int, GroupSolved] = {}
        self.slack: list[Array] = []
        self.frame = rest()
        self.given: dict[Name, Array] = {}
        for k, driver in enumerate(structure.drivers):
            value = drive.value[:, k]
            if driver.turns:
                u = turned(value)
                self.given["cos", k], self.given["sin", k] = u.real, u.imag
            else:
                self.given["travel", k] = value
        self.given |= {("sign", i): np.broadcast_to(modes[i], (self.n,)) for i in modes if i in structure.dyads}
        self.rates_of: dict[Name, float] = {}
        """Rates at the first position: where they change they are given as the values are."""
        self.varying: frozenset[Name] = frozenset()
        for part, rates_here in (("rate", drive.rate), ("second", drive.second)):
            self.rates_of |= {(part, k): rate for k, rate in enumerate(rates_here[0].tolist() if self.n else ())}
            if self.n > 1 and rates_here.strides[0]:
                changing = np.flatnonzero((rates_here != rates_here[0]).any(axis=0)).tolist()
                self.given |= {(part, k): np.ascontiguousarray(rates_here[:, k]) for k in changing}
                self.varying |= {(part, k) for k in changing}
        names = [("second", k) for k in range(drive.value.shape[1])]
        moving = (name in self.varying or bool(self.rates_of.get(name)) for name in names)
        self.dimensioned = program_of(structure, tuple(moving))

    def follow(self, upto: int) -> None:
        """Solve the elements without formulas: larger groups, cams by their law, rolling links."""
        for i, element in enumerate(self.structure.elements[:upto]):
            if isinstance(element, LargerGroup):
                self._together(i, element)
            elif element.lifted is not None:
                self._lift(i, element.lifted)
            elif element.rolled is not None:
                self._roll(i, element.rolled)

    def state(self, upto: int, whole: bool = True) -> State:
        """The mechanism up to an element, or of it the last element alone."""
        self.follow(upto)
        elements = self.structure.elements[:upto]
        program = self.dimensioned.program
        first = 0 if whole else upto - 1
        names = [n for e in elements[first:] for n in e.members]
        dyads = [i for i in self.structure.dyads if first <= i < upto]
        parts = ("discriminant", "sine", *(("e1", "e2", "right_side") if self.rates else ()))
        fields = FIELDS if self.rates else FIELDS[:2]
        asked = [getattr(program.poses[n], f) for n in names for f in fields]
        asked += [getattr(program.groups[i], p) for i in dyads for p in parts]
        columns = self._values((first, upto, self.rates), asked)
        values = iter(columns)
        poses = {self.structure.scene.frame.name: self.frame}
        poses |= {n: _pose(dict(zip(fields, values, strict=False))) for n in names}
        groups: dict[int, DyadSolution | GroupSolved] = dict(self.larger_groups)
        for i in dyads:
            given = dict(zip(parts, values, strict=False))
            groups[i] = DyadSolution(
                *(poses[body.links[0]] for body in elements[i].bodies),  # type: ignore[union-attr, arg-type]
                *(given.get(p, _LOST) for p in DyadSolution._fields[2:]),
            )
        exact = np.zeros(self.n, dtype=bool)  # whether the drivers' values are known to fifty digits
        explicit = all(element.explicit for element in elements)
        for j, driver in enumerate(self.structure.drivers if names and explicit else ()):
            if driver.exact:
                exact |= self.drive.value[:, j] == driver.values[0]
        sharp = np.full(self.n, 0.0 if self.larger_groups else 1.0)
        for i in dyads:
            sharp = sharp * np.abs(groups[i].sine)  # type: ignore[union-attr]
        slack = np.concatenate(self.slack, axis=1) if self.slack else np.zeros((self.n, 0))
        state = State(poses, self.drive, dict(sorted(groups.items())), np.zeros(self.n, dtype=bool), sharp > CLEAR,
                      slack, np.where(exact, TINY, SINGULAR), self._found())
        repeated = exact
        if names and explicit and self.extended and self.rates and upto == len(self.structure.elements):
            repeated = exact | self._in_doubt(state)
        if not repeated.any():
            return state
        extended = self._extended(program.code((first, upto, self.rates), asked, self.varying))
        return replace(state, refined=extended.place(repeated, asked, columns))  # the columns are those of the poses

    def _found(self) -> dict[Name, Array]:
        """The inputs of the formulas from followers of cams, rolling links and larger groups."""
        count = len(self.structure.scene.drivers)
        rolled = ((part, k) for k in range(count, len(self.structure.drivers)) for part in ("cos", "sin", "travel"))
        names = [*rolled, *(name for name in self.given if name[0] in ("lift", "rolled", "pose"))]
        return {name: self.given[name] for name in names if name in self.given}

    def _in_doubt(self, state: State) -> Array:
        """Positions for whose rates sixteen digits are too few."""
        doubtful = ~state.clear
        if doubtful.any():
            bound = most_of(state.bounds(self.structure, doubtful).values())
            poses = {name: pose.spread(self.n).rows(doubtful) for name, pose in state.poses.items()}
            doubtful[doubtful] = ~(roughness(self.structure, poses, bound) < ROUGH)
        return doubtful

    def _lift(self, i: int, cam: LawCam) -> None:
        """Find the place of a cam's follower, by the cam's own turning."""
        from graphkin.solver.cams import follower_inputs

        (turn,) = self._values(("cam", i), [self.dimensioned.program.poses[cam.link].u])
        inputs = follower_inputs(cam, np.broadcast_to(turn, (self.n,)))
        for part, column in inputs.items():
            self.given["lift", cam.link, part] = np.ascontiguousarray(column)
        self.slack.append(LOOKED_UP * np.abs(inputs.get("travel", np.ones(self.n)))[:, None])

    def _roll(self, i: int, rolled: RollingRelation) -> None:
        """How far the links on which a link rolls have turned or gone since the scene's own position, whole turns by
        the element's mode, and so where the link stands."""
        program, mode = self.dimensioned.program, np.broadcast_to(self.modes[i], (self.n, 2 * len(rolled.factors)))
        asked: list[Real | Vec] = []
        for (kind, name), _ in rolled.factors:
            if kind == "angle":
                asked.append(program.poses[name].u)
            else:
                slide = self.structure.slide(name)
                guide = program.guide(slide)
                asked.append(((program.poses[slide.a].z - guide.z) * guide.u.conjugate()).real)
        value = np.full(self.n, rolled.start)
        wide = np.abs(value) + 1.0 * rolled.turns
        for k, (at, (_, factor)) in enumerate(zip(self._values(("rolled", i), asked), rolled.factors, strict=True)):
            at = np.broadcast_to(at, (self.n,))
            if np.iscomplexobj(at):
                angle, near = np.angle(at), mode[:, 2 * k + 1]
                at = angle + 2 * np.pi * np.rint((near - angle) / (2 * np.pi))
            # by how far it has moved since the scene's own position; either may be off
            since = mode[:, 2 * k]
            value, wide = value + factor * (at - since), wide + abs(factor) * (np.abs(at) + np.abs(since))
        u = turned(value)
        parts = {"cos": u.real, "sin": u.imag} if rolled.turns else {"travel": value}
        for part, column in parts.items():
            self.given["rolled", rolled.key, part] = np.ascontiguousarray(column)
        self.slack.append(LOOKED_UP * wide[:, None])

    def _together(self, i: int, group: LargerGroup) -> None:
        """Solve a larger group, and give its poses to the formulas of later elements."""
        program = self.dimensioned.program
        known = [n for n in self.structure.links if n in group.outside and n != self.structure.scene.frame.name]
        values = iter(self._values(("known", i), [getattr(program.poses[n], f) for n in known for f in FIELDS]))
        poses = {n: _pose(dict(zip(FIELDS, values, strict=False))) for n in known}
        poses[self.structure.scene.frame.name] = self.frame
        solved = solve_group(self.structure, group, poses, self.drive, np.asarray(self.modes[i]), self.rates)
        self.larger_groups[i] = solved
        self.slack.append(solved.rolling_residuals)
        for name in group.members:
            pose = solved.poses[name]
            for f in FIELDS:
                value = getattr(pose, f)
                self.given["pose", name, f, "x"] = np.ascontiguousarray(value.real)
                if np.iscomplexobj(value):
                    self.given["pose", name, f, "y"] = np.ascontiguousarray(value.imag)

    def _values(self, key: Hashable, asked: Sequence[Real | Vec]) -> list[Array]:
        """Formulas at all positions: vectors as complex arrays, numbers as real ones."""
        code = self.dimensioned.program.code(key, asked, self.varying)
        if self.known is not None and self.n == 1:
            try:
                row = iter(code.values(self._given_at_first, self.known))
            except (ZeroDivisionError, OverflowError):
                self.known = None
            else:
                return [np.array([complex(next(row), next(row)) if isinstance(x, Vec) else next(row)]) for x in asked]
        params = self.dimensioned.params(code.params, self.rates_of)
        inputs = [self.given[name] for name in code.inputs]
        out: list[Array] = []
        columns = []
        for x in asked:
            columns.append(np.empty(self.n, dtype=np.complex128 if isinstance(x, Vec) else np.float64))
            out += [columns[-1].real, columns[-1].imag] if isinstance(x, Vec) else [columns[-1]]
        code.arrays(code.invariants(params), inputs, out)
        return columns

    def _given_at_first(self, name: Name) -> float:
        """A number that the formulas are given, at the first position."""
        return float(self.given[name][0]) if name in self.given else self.dimensioned.params([name], self.rates_of)[0]

    def _extended(self, code: Code) -> ExtendedPrecision:
        signs = {name: column for name, column in self.given.items() if name[0] == "sign"}
        return ExtendedPrecision(self.dimensioned, code, self.drive, signs)


_LOST = np.full(1, np.nan)


def _pose(given: Mapping[str, Array]) -> Pose:
    zero, none = np.zeros(1), np.zeros(1, dtype=np.complex128)
    still = {"z": none, "u": none, "v": none, "omega": zero, "a": none, "alpha": zero}
    return Pose(**{**still, **given})


# whether a dyad closes

SMALL = Decimal(10) ** -20
LAST_DIGITS = Decimal(10) ** -48
ROUNDING = Decimal(10) ** -36
"""What fifty digits leave open of a discriminant at a place that is found from it."""


def discriminant_of(
    structure: Structure, i: int, modes: Mapping[int, Array], drive: Drive | None = None
) -> ExtendedPrecision:
    """The discriminant of a dyad after dyads only, in fifty digits.

    Parameters
    ----------
    i : the dyad, by its place among the elements
    modes : the assembly of the groups before it
    drive : positions whose driver values are taken as decimals; the scene's own if None
    """
    known = {**{j: mode for j, mode in modes.items() if j < i}, i: np.ones(1)}
    run = _Run(structure, drive, known, False)
    program = run.dimensioned.program
    return run._extended(program.code(("closing", i), [program.groups[i].discriminant]))


def closes(structure: Structure, i: int, modes: Mapping[int, Array], drive: Drive) -> tuple[Array, Array]:
    """Whether a dyad closes at values of the drivers taken as decimals: 1, -1, or 0 where it is at its limit or
    undecided; and whether the file's digits leave it open.  Shapes (n,)."""
    discriminant = discriminant_of(structure, i, modes, drive)
    with working():
        readings = [discriminant.with_doubt(k) for k in range(len(drive))]
    signs = np.array([_sign(*reading) for reading in readings], dtype=int)
    return signs, np.array([not sign and ROUNDING < doubt < UNKNOWN
                            for sign, (_, doubt) in zip(signs, readings, strict=True)], dtype=bool)


def _sign(value: Decimal, doubt: Decimal) -> int:
    return 0 if abs(value) <= max(doubt, ROUNDING) else 1 if value > 0 else -1


def touch(function: Callable[[Decimal], Decimal], about: float) -> Decimal | None:
    """The place of a function's least value, by the zero of its derivative."""
    step = SMALL.sqrt()
    return newton(lambda x: (function(x + step) - function(x - step)) / (2 * step), about)


def newton(function: Callable[[Decimal], Decimal], about: float | Decimal) -> Decimal | None:
    """A zero of a function in fifty digits, its derivative by differences; None without a zero nearby."""
    with working():
        x = Decimal(about)
        try:
            for _ in range(60):
                slope = (function(x + SMALL) - function(x - SMALL)) / (2 * SMALL)
                move = function(x) / slope
                x = x - move
                if abs(move) < LAST_DIGITS * (1 + abs(x)):
                    return x if abs(x) > 100 * LAST_DIGITS else Decimal(0)
        except ArithmeticError:
            return None
    return None
