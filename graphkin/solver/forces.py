"""Kinetostatics: the forces in all pairs, and the balancing loads of the mechanism in its motion, by Newton and Euler.

Each moving link is cut free: the loads on it, its inertia force -m a and inertia couple -J alpha
(d'Alembert) and the forces of its pairs are in equilibrium.  All links together are one linear system, whose unknowns
are the pair forces and as many balances as the mechanism has drivers (Sun Huan, Mechanical Principles, ch. 4; Norton,
Design of Machinery, ch. 11).

The known actions on the links of a motion: inertia forces, weights, loads, each at its place while it acts.  Values
of the motion and of its forces by symbol.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphkin.errors import CallError, Unsolvable
from graphkin.plane import cross
from graphkin.scene.model import EDGE, ForceJoint, LoadOn, SpringOn, balance_of, joints, no_force
from graphkin.scene.pairs import ContactMotion, Pair
from graphkin.scene.symbol import Symbol
from graphkin.solver.algebra.constraints import solve_all
from graphkin.solver.algebra.pose import Array, known_where
from graphkin.solver.motion import SLIGHT, Motion
from graphkin.solver.quantities import part_along
from graphkin.structure import kept_with
from graphkin.words import Phrase, Wording


def pair_forces(motion: Motion) -> Iterator[Action]:
    """The unknown forces and couples in the pairs of a motion, forces of 1 N, couples of the mechanism's size in N m:
    of a turning pair the two components of its force, of a sliding pair a force square to the guide at the sliding
    link's first point and a couple, of a pin in a slot a force square to the slot, of a cam or a sliding contact one
    along the normal, of wheels one along the tangent of the pitch circles."""
    for joint in joints(motion.scene):
        directions, at = _lines(motion, joint)
        for along in directions:
            yield Action(joint.symbol("F"), joint.second, at, np.asarray(along), other=joint.first)
        if joint.couple:
            yield Action(joint.symbol("M"), joint.second, None, np.asarray(motion.scene.size), other=joint.first)


def _lines(motion: Motion, joint: ForceJoint) -> tuple[Sequence[complex | Array], Array]:
    """The directions and the place of a joint's forces: of rolling both components, but of wheels the tangent alone."""
    both = 1 + 0j, 1j
    if joint.kind == "turning":
        return both, motion.position(joint.point)
    if joint.kind == "sliding":
        slide = motion.structure.slide(joint.slide)
        return [_square(motion, slide)], _foot(motion, slide)
    from graphkin.solver.touching import touch_of

    assert joint.pair is not None
    at, normal = touch_of(motion, joint.pair)
    along: Mapping[ContactMotion, Sequence[complex | Array]] = {
        "slides": [normal], "rolls": both, "meshes": [1j * normal],
    }
    return along[joint.pair.means], at


def balances(motion: Motion) -> Iterator[Action]:
    """The balancing loads, of the sizes of `pair_forces`: for each driver a moment or a force between the two links
    that it moves relatively, or the scene's own balance."""
    scene = motion.scene
    said, couple = scene.loading.balance, np.asarray(scene.size)
    if said is not None:
        pose = motion.poses[said.link]
        along = np.asarray(said.turn * (pose.u if said.follows else 1.0))
        at = np.asarray(pose.fixed(said.at).z) if said.is_force else None
        yield Action(said.symbol, said.link, at, along if said.is_force else couple, other=scene.frame.name)
        return
    for driver in scene.drivers:
        symbol = balance_of(scene, driver)
        if driver.turns:
            yield Action(symbol, driver.link, None, couple, other=driver.relative_to)
            continue
        slide = motion.structure.slide(driver.key)
        along = np.asarray(-1j * _square(motion, slide))
        yield Action(symbol, slide.body, _foot(motion, slide), along, other=slide.b or scene.frame.name)


def _foot(motion: Motion, slide: Pair) -> Array:
    """The place of a sliding pair's force: the pin, the first point of the sliding link, or its origin."""
    at = motion.structure.links[slide.body].points[slide.pin] if slide.pin else 0j
    return motion.poses[slide.body].fixed(at).z


def _square(motion: Motion, slide: Pair) -> complex | Array:
    """Direction square to a guide, to its left."""
    if slide.b == motion.scene.frame.name:
        return 1j * slide.guide.direction
    return 1j * slide.guide.direction * motion.poses[slide.b].u


EPS = float(np.finfo(float).eps)
DEAD = 1e-10
"""Equations with entries of order 1 whose inverse is greater than 1 / DEAD have no answer."""


BALANCE_IDLE = Phrase("the balance does no work in this position")


@dataclass(frozen=True, eq=False, repr=False)
class Forces:
    """Forces and moments at the n positions of a motion: its links cut free, with the known actions on them, and the
    forces of their pairs and the balances as unknowns."""

    motion: Motion
    acting: tuple[Action, ...]

    @cached_property
    def unknowns(self) -> tuple[Action, ...]:
        """The forces of the pairs, and the balances."""
        return *pair_forces(self.motion), *balances(self.motion)

    # the equations

    @cached_property
    def _row(self) -> dict[str, int]:
        """The first of the three equations of each moving link."""
        moving = [link.name for link in self.motion.scene.links if not link.redundant]
        return {name: 3 * i for i, name in enumerate(moving)}

    @property
    def _size(self) -> float:
        return self.motion.scene.size

    def _parts(self, link: str, at: Array | None, value: Array) -> dict[int, Array]:
        """What an action adds to the equations of a link, by their rows; nothing for the frame."""
        row = self._row.get(link)
        if row is None:
            return {}
        if at is None:
            return {row + 2: value / self._size}
        arm = (at - self.motion.poses[link].z) / self._size
        return {row: value.real, row + 1: value.imag, row + 2: cross(arm, value)}

    def _equations(self) -> tuple[Array, Array, Array]:
        """Equilibrium of each link, three rows each: both components of force, and moment about its origin over the
        size; a column for each unknown.

        Returns
        -------
        matrix, inverse : shape (n, rows, columns) and (n, columns, rows)
        good : whether the inverse exists, shape (n,)
        """
        matrix = np.zeros((len(self.motion), 3 * len(self._row), len(self.unknowns)))
        for k, unknown in enumerate(self.unknowns):
            for link, sign in ((unknown.link, 1.0), (unknown.other, -1.0)):
                for row, part in self._parts(link, unknown.at, unknown.value).items():
                    matrix[:, row, k] = sign * part
        good, (rows, columns) = self.motion.ok, matrix.shape[1:]
        if rows != columns:
            return matrix, np.zeros((len(good), columns, rows)), np.zeros_like(good)
        unit = np.eye(rows)
        inverse = solve_all(np.where(good[:, None, None], matrix, unit), np.broadcast_to(unit, matrix.shape))
        good = good & (np.abs(inverse).sum(axis=2).max(axis=1, initial=0.0) < 1.0 / DEAD)  # NaN is not less
        return matrix, np.where(good[:, None, None], inverse, 0.0), good

    def _right(self, values: Iterable[Array]) -> Array:
        """The known actions, with these values, on the other side of the equations, shape (rows, n)."""
        right = np.zeros((3 * len(self._row), len(self.motion)))
        for action, value in zip(self.acting, values, strict=True):
            for row, part in self._parts(action.link, action.at, value).items():
                right[row] -= part
        return right

    @cached_property
    def _found(self) -> list[tuple[Array, Array]]:
        """The unknowns, shape (columns, n), NaN where not found, and whether they are found; then also with the loads
        that begin or end exactly at a position."""
        matrix, inverse, regular = self._equations()
        loads = [[load.value for load in self.acting]]
        if any(load.beside is not None for load in self.acting):
            loads.append([load.value if load.beside is None else load.beside for load in self.acting])
        answers: list[tuple[Array, Array]] = []
        for values in loads:
            right = self._right(values)
            good = regular & np.isfinite(right).all(axis=0)
            column = np.where(good, right, 0.0).T[..., None]
            solution = inverse @ column
            # a second pass takes back the rounding of the first
            solution += inverse @ (column - np.where(good[:, None, None], matrix, 0.0) @ solution)
            answers.append((np.where(good, solution[..., 0].T, np.nan), good))
        return answers

    def _by_symbol(self, sizes: Array) -> dict[Symbol, Array]:
        """The columns of the answer by their symbols, both components of a force together."""
        made: dict[Symbol, Array] = {}
        for unknown, size in zip(self.unknowns, sizes, strict=True):
            symbol, value = unknown.symbol, size * unknown.value
            made[symbol] = made[symbol] + value if unknown.at is not None and symbol in made else value
        return made

    # the answer

    @cached_property
    def ok(self) -> Array:
        """bool, shape (n,): whether the forces are found; numbers elsewhere are NaN."""
        good = self._found[0][1]
        nowhere = np.zeros(len(good), dtype=bool)
        return np.asarray(good & ~np.any([nowhere, *without_line(self.motion).values()], axis=0))

    @cached_property
    def values(self) -> Mapping[Symbol, Array]:
        """Forces and moments by their symbols.  Complex, shape (n,), N: pair forces ``F_5/6`` (of link 5 on link 6),
        inertia forces ``Fi_6``, weights ``G_6``, loads ``P_name``, balancing forces ``F_2``; real, shape (n,), N m:
        couples of sliding pairs ``M_5/6``, inertia couples ``Mi_6``, loads, balancing moments ``M_2``."""
        known = dict[Symbol, Array]()
        for action in self.acting:
            known.setdefault(action.symbol, action.value)  # of a spring the force on its first link
        values = known | self._by_symbol(self._found[0][0])
        return values if self.ok.all() else {symbol: known_where(self.ok, value) for symbol, value in values.items()}

    @cached_property
    def beside(self) -> Mapping[Symbol, Array]:
        """The values with the loads that begin or end exactly at a position; NaN elsewhere, and where they do not
        change."""
        here, ok = self.values, self.ok
        jumping = [load for load in self.acting if load.beside is not None]
        if not jumping:
            return {}
        changed = ok & np.any([load.beside != load.value for load in jumping], axis=0)
        made = {load.symbol: load.beside for load in jumping if load.beside is not None}
        if changed.any():
            made |= self._by_symbol(np.where(changed, self._found[1][0], np.nan))
        least = 1e-6 * EDGE * np.max(np.abs(np.nan_to_num([*here.values(), *made.values()])), axis=0)
        made = {s: known_where(ok & (np.abs(value - here[s]) > least), value) for s, value in made.items()}
        return {symbol: value for symbol, value in made.items() if not np.isnan(value).all()}

    @cached_property
    def known_motion(self) -> Motion:
        """The motion, with a dead point and its reason where the forces are not found."""
        motion, unknown = self.motion, self.motion.ok & ~self.ok
        if not unknown.any():
            return motion
        reasons: list[Wording] = [BALANCE_IDLE if here else why
                                  for here, why in zip(unknown, motion.reasons, strict=True)]
        for spring, where in without_line(motion).items():
            for k in np.flatnonzero(where).tolist():
                reasons[k] = Phrase("the two points of spring coincide in this", name=spring.name)
        return replace(motion, status=np.where(unknown, "dead point", motion.status), reasons=tuple(reasons))

    @cached_property
    def bound(self) -> tuple[Array, Array]:
        """Bounds of the errors of any force (N) and moment (N m), shape (n,) each: of first order, by rounding and by
        the bounds of the motion."""
        matrix, inverse, _ = self._equations()
        motion, size, loading = self.motion, self._size, self.motion.scene.loading
        place, _, push = motion.bound.of_point
        turn = motion.bound.of_turning
        right = np.zeros((3 * len(self._row), len(motion)))
        for mass in loading.masses:
            i = self._row[mass.link]
            centre = motion.poses[mass.link].fixed(mass.at)
            heavy = mass.mass * (push + 4 * EPS * np.abs(centre.a))
            weight = mass.mass * (np.abs(centre.a) + abs(loading.gravity))
            right[i : i + 2] += heavy
            right[i + 2] += heavy + weight * (place / size + 8 * EPS) + mass.inertia * turn[2] / size
        for load in loading.loads:
            i = self._row[load.link]
            right[i : i + 3] += abs(load.size) * (turn[0] + place / size + 8 * EPS if load.is_force else EPS / size)
        for spring in loading.springs:
            force = np.abs(self.values[spring.symbol])
            length = np.abs(np.subtract(*spring_ends(motion, spring)))
            with np.errstate(divide="ignore", invalid="ignore"):  # of a spring without a line
                error = spring.rate * (2 * place + 8 * EPS * length) + force * (2 * place / length + turn[0] + 8 * EPS)
            for link in spring.links:
                if link in self._row:
                    right[self._row[link] : self._row[link] + 3] += np.nan_to_num(error)
        values = (self.values[unknown.symbol] / (size if unknown.at is None else 1.0) for unknown in self.unknowns)
        sizes = np.nan_to_num([np.abs(value) for value in values])
        matrix = np.nan_to_num(matrix)
        error = np.abs(matrix) * 16 * EPS + (matrix != 0.0) * np.nan_to_num(place / size + turn[0])[:, None, None]
        right += (error @ sizes.T[..., None])[..., 0].T
        spread = (np.abs(inverse) @ np.nan_to_num(right).T[..., None])[..., 0].T + 16 * EPS * sizes
        most = np.where(self.ok, spread.max(axis=0), np.nan)
        return most, most * size

    @cached_property
    def floors(self) -> tuple[Array, Array]:
        """The sizes up to which a force (N) and a moment (N m) are rounding alone, shape (n,) each: the bounds, where
        they are slight beside the largest of all."""
        force, moment = (
            np.max([np.abs(v) for symbol, v in self.values.items() if symbol.is_vector is vectors], axis=0, initial=0.0)
            for vectors in (True, False)
        )
        largest = force, np.maximum(moment, force * self.motion.scene.size)
        pairs = zip(self.bound, largest, strict=True)
        forces, moments = (np.where(bound <= SLIGHT * whole, bound, 0.0) for bound, whole in pairs)
        return forces, moments

    @cached_property
    def power(self) -> tuple[Array, Array]:
        """The sum of the powers of all outer actions and of the balances, which is 0 within rounding, and the greatest
        of them (W), shape (n,) each."""
        both = (*actions(self.motion), *self.balancing)
        powers = [action.power(self.motion) for action in both]
        return np.sum(powers, axis=0), np.max(np.abs(powers), axis=0)

    @property
    def balancing(self) -> Iterator[Action]:
        """The balancing loads with their values."""
        return (replace(balance, value=self.values[balance.symbol]) for balance in balances(self.motion))

    def value(self, symbol: Symbol) -> Array | None:
        """A force or a moment, ``F_6/5`` being the opposite of ``F_5/6``, ``F_5/6+`` with the loads that begin or end
        exactly at a position; None for an unknown one."""
        plain = replace(symbol, at="", plus=False)
        for known, sign in ((plain, 1.0), (plain.opposite, -1.0)):
            values = self.values.get(known)
            if values is not None:
                jumped = self.beside.get(known) if symbol.plus else None
                return sign * (values if jumped is None else np.where(np.isnan(jumped), values, jumped))
        return None


@kept_with  # they are found together, and asked for one by one
def forces_of(motion: Motion) -> Forces:
    """All forces of a scene that has masses or loads, at each position of its motion.

    Raises
    ------
    Unsolvable : a load acts on a part of a stroke, and the driver makes no whole turn
    """
    return Forces(motion, tuple(actions(motion)))


# what acts on the links of a motion from outside: inertia forces, weights, loads, each where and while it acts


@dataclass(frozen=True, eq=False, repr=False)
class Action:
    """A force or a couple on a link; of a pair, or a balance, its opposite on another.

    symbol : ``Fi_6``, ``G_6``, ``P_name``, ``F_5/6``; both forces of a spring have the same
    at : the place of a force, complex, shape (n,) (m); None for a couple
    value : force, complex, shape (n,) (N), or couple, real (N m); one that is constant may have shape ()
    beside : the value with the loads that begin or end exactly at a position; None where it does not change
    other : the link on which the opposite acts
    """

    symbol: Symbol
    link: str
    at: Array | None
    value: Array
    beside: Array | None = None
    other: str = ""

    def power(self, motion: Motion) -> Array:
        """Its power (W), that of its opposite included, shape (n,)."""
        if self.other:
            on_link, on_other = (replace(self, link=link, other="") for link in (self.link, self.other))
            return on_link.power(motion) - on_other.power(motion)
        pose = motion.poses[self.link]
        if self.at is None:
            return self.value * pose.omega
        return np.asarray((np.conj(pose.v + 1j * pose.omega * (self.at - pose.z)) * self.value).real)


def actions(motion: Motion) -> Iterator[Action]:
    """All known actions on the links: inertia force -m a and inertia couple -J alpha (d'Alembert)
    and weight of each mass, then loads and springs, of the two forces of a spring one may act on the frame.

    Raises
    ------
    Unsolvable : a load acts on a part of a stroke, and the driver makes no whole turn
    """
    loading = motion.scene.loading
    for mass in loading.masses:
        centre = motion.poses[mass.link].fixed(mass.at)
        at = np.asarray(centre.z)
        yield Action(Symbol("Fi", link=mass.link), mass.link, at, np.asarray(-mass.mass * centre.a))
        yield Action(Symbol("Mi", link=mass.link), mass.link, None, np.asarray(-mass.inertia * centre.alpha))
        if loading.gravity:
            yield Action(Symbol("G", link=mass.link), mass.link, at, np.full(len(motion), mass.mass * loading.gravity))
    yield from (_load(motion, load) for load in loading.loads)
    for spring in loading.springs:
        yield from _spring(motion, spring)


def _spring(motion: Motion, spring: SpringOn) -> Iterator[Action]:
    """The forces of a spring on both its links, along the line of its points."""
    first, second = spring_ends(motion, spring)
    line = second - first
    length = np.abs(line)
    along = np.divide(line, length, out=np.full(len(motion), complex(np.nan, np.nan)), where=_has_line(motion, length))
    force = np.asarray(spring.pull(length) * along)
    yield Action(spring.symbol, spring.links[0], first, force)
    yield Action(spring.symbol, spring.links[1], second, -force)


def spring_ends(motion: Motion, spring: SpringOn) -> tuple[Array, Array]:
    """The places of a spring's two points, complex, shape (n,) each (m)."""
    first, second = (np.broadcast_to(motion.poses[n].z + motion.poses[n].u * at, len(motion)) for n, at in spring.ends)
    return np.asarray(first), np.asarray(second)


def without_line(motion: Motion) -> dict[SpringOn, Array]:
    """For each spring the positions, bool, shape (n,), at which its points coincide, so that its force has no line."""
    springs = motion.scene.loading.springs
    lengths = {spring: np.abs(np.subtract(*spring_ends(motion, spring))) for spring in springs}
    return {spring: motion.ok & ~_has_line(motion, length) for spring, length in lengths.items()}


def _has_line(motion: Motion, length: Array) -> Array:
    return length > EDGE * motion.scene.size


def _load(motion: Motion, load: LoadOn) -> Action:
    acts, edge = _acting(motion, load)
    at = np.asarray(motion.poses[load.link].fixed(load.at).z) if load.is_force else None
    value = _force(motion, load) if load.is_force else np.full(len(motion), load.size)
    beside = np.where(acts | edge, value, 0.0) if edge.any() else None
    surely = acts & ~edge
    return Action(load.symbol, load.link, at, value if surely.all() else np.where(surely, value, 0.0), beside)


def _force(motion: Motion, load: LoadOn) -> Array:
    """A force load as a vector, whether it acts or not."""
    scene = motion.scene
    if load.against:
        slide, growing = next(s for s in motion.slides if s.key == load.against), motion.growing
        moving = [growing.poses[link.name] for link in scene.links if not link.redundant]
        speeds = [np.abs(pose.v) for pose in moving] + [np.abs(pose.omega) * scene.size for pose in moving]
        most = np.max(np.nan_to_num(speeds), axis=0) + np.abs(growing.poses[slide.b].omega) * scene.size
        _, speed, *_ = growing.slide(slide.key)
        sign = np.where(np.abs(speed) > 1e-12 * most, np.sign(speed), 0.0)
        return -load.size * sign * motion.poses[slide.b].u * slide.guide.direction
    if load.follows:
        return load.size * load.turn * motion.poses[load.follows].u
    return np.full(len(motion), load.size * load.turn)


def _acting(motion: Motion, load: LoadOn) -> tuple[Array, Array]:
    """Whether a load acts, and whether it begins or ends exactly; shape (n,) each.  Raises Unsolvable as `actions`."""
    phase = load.phase
    if phase is None:
        return np.ones(len(motion), dtype=bool), np.zeros(len(motion), dtype=bool)
    if not phase.stroke:
        acts, edge = load.acts_at(motion.values[:, 0], motion.scene.drivers[0].turns)
    else:
        try:
            low, high = motion.reach().stroke(phase.stroke)
        except Unsolvable as stop:
            raise load.without_stroke(stop) from None
        travel, speed = motion.slide(phase.stroke)[0], motion.growing.slide(phase.stroke)[1]
        part = (travel - low) / (high - low) if high > low else np.zeros(len(motion))
        acts, edge = load.acts_on_stroke(part, np.sign(speed) == phase.sense)
    return np.asarray(acts), np.asarray(edge)


# values by symbol


def value_of(motion: Motion, symbol: Symbol) -> Array:
    """A quantity of the motion or a force by its symbol: complex for vectors, real for others (SI), shape (n,).

    Raises
    ------
    CallError : the symbol names nothing here
    Unsolvable : a load acts on a part of a stroke, and the driver makes no whole turn
    """
    if symbol.along:
        vector, sense = value_of(motion, symbol.whole), senses_along(motion, symbol)
        return vector.real if sense is None else (vector * sense.conjugate()).real
    if symbol.scope != "force":
        return motion.value(symbol)
    if symbol.axis:
        return np.asarray(part_along(symbol.axis, value_of(motion, symbol.whole)))
    problem = no_force(motion.scene, str(symbol), symbol)
    if problem is not None:
        raise CallError(problem)
    values = forces_of(motion).value(symbol)
    if values is None:
        raise CallError.of(str(symbol), "is read off the drawing alone", "ask check for it")
    return values


def settled_value(motion: Motion, symbol: Symbol) -> Array:
    """A quantity as `value_of` gives it, 0 where it is rounding alone."""
    value, measure = value_of(motion, symbol), symbol.measure
    if symbol.is_load:
        return settled(value, forces_of(motion).floors[measure.length])
    return motion.settled(value, measure, ends_of(symbol))


def ends_of(symbol: Symbol) -> float:
    """The number of places whose errors a quantity has: two for points seen from each other."""
    return 1.0 if symbol.measure.angle or symbol.kind == "place" else 2.0


def settled(value: Array, floor: Array) -> Array:
    """Values, 0 where they are not above what rounding amounts to; complex ones by their parts."""
    if np.iscomplexobj(value):
        return settled(value.real, floor) + 1j * settled(value.imag, floor)
    return np.where(np.abs(value) <= floor, 0.0, value)


def senses_along(motion: Motion, symbol: Symbol) -> Array | None:
    """Unit vectors of the positive sense of a velocity or acceleration that lies along the straight guide of a sliding
    pair, shape (n,): of a point of the sliding link in the frame, and of coincident points relative to each other; None
    for another symbol."""
    of, to, frame = symbol.of, symbol.to, motion.scene.frame.name
    if of is None or symbol.seen or symbol.kind not in ("v", "a", "ar"):
        return None
    for slide in motion.slides:
        if slide.guide.curvature:
            continue
        if to is None:
            mine = motion.structure.links[slide.a].points if slide.a in motion.structure.links else {}
            along = slide.b == frame and (of.link == slide.a or (not of.link and of.point in mine))
        else:
            along = slide.pin == of.point == to.point and {of.link, to.link} - {""} <= {slide.a, slide.b}
        if along:
            return motion.poses[slide.b].u * slide.guide.direction
    return None
