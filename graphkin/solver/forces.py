"""Kinetostatics: the forces in all pairs, and what balances the mechanism in its motion, by Newton and Euler.

Each moving link is cut free: what acts on it from outside, its inertia force -m a and inertia couple -J alpha
(d'Alembert) and the forces of its pairs are in equilibrium.  All links together are one linear system, whose unknowns
are the pair forces and as many balances as the mechanism has drivers (Sun Huan, Mechanical Principles, ch. 4; Norton,
Design of Machinery, ch. 11).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphkin.plane import cross
from graphkin.scene.loads import BalanceAt, LoadOn, Phase
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver.driver_range import DriverRange, driver_range
from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array
from graphkin.solver.whole_turn import extremes
from graphkin.structure import Slide, Structure
from graphkin.structure.groups import components, match

__all__ = ["Forces", "forces_of"]

EDGE = 1e-9
"""Of the stroke or the turn: a load that begins or ends within this of a position does so exactly there."""
SINGULAR = 1e-13
"""A system whose reciprocal condition is less than this has no answer: the balance does no work."""
EPS = float(np.finfo(float).eps)


@dataclass(frozen=True)
class Forces:
    """Forces and moments at n positions, by their symbols.

    forces : complex, shape (n,), N: pair forces ``F_5/6`` (of link 5 on link 6), inertia forces ``Fi_6``, weights
        ``G_6``, loads ``P_name``, balancing forces ``F_2``
    moments : real, shape (n,), N m: couples of sliding pairs ``M_5/6``, inertia couples ``Mi_6``, loads, balancing
        moments ``M_2``
    beside : the same with the loads that begin or end exactly at a position; NaN elsewhere, and where it changes
        nothing.  The keys are those of ``forces`` and ``moments``
    ok : bool, shape (n,): where there is an answer; numbers elsewhere are NaN
    """

    motion: Motion

    forces: Mapping[str, Array]
    moments: Mapping[str, Array]
    beside: Mapping[str, Array]
    ok: Array

    @cached_property
    def bound(self) -> tuple[Array, Array]:
        """How far rounding may have moved any force (N) and moment (N m), shape (n,) each."""
        return _Statics(self.motion).bounds(self)

    def value(self, key: str) -> Array | None:
        """A force or a moment by its symbol, ``F_6/5`` being the opposite of ``F_5/6``; None for one that there is
        not."""
        both = {**self.forces, **self.moments}
        if key in both:
            return both[key]
        letter, _, rest = key.partition("_")
        pair, at, point = rest.partition("@")
        first, _, second = pair.partition("/")
        other = both.get(f"{letter}_{second}/{first}{at}{point}")
        return None if other is None else np.asarray(-other)


@dataclass(frozen=True)
class _Unknown:
    """A column of the system: a force of a known or of either direction, or a couple, of ``first`` on ``second``.

    along : unit direction of a force, shape (n,); None for a couple
    at : where the force acts, shape (n,)
    """

    key: str
    first: str
    second: str
    along: Array | None
    at: Array


def forces_of(motion: Motion) -> Forces:
    """All forces of a scene that has masses or loads, at each position of its motion.

    Raises
    ------
    Unsolvable : a load acts on a part of a stroke, and the driver makes no whole turn
    """
    return _Statics(motion).solved()


@dataclass(frozen=True)
class _Statics:
    """The links of a motion cut free."""

    motion: Motion

    @property
    def scene(self) -> Mechanism:
        return self.motion.scene

    @property
    def structure(self) -> Structure:
        return self.motion.structure

    @cached_property
    def moving(self) -> list[str]:
        return [link.name for link in self.scene.links if not link.redundant]

    @cached_property
    def row(self) -> dict[str, int]:
        return {name: 3 * i for i, name in enumerate(self.moving)}

    def origin(self, link: str) -> Array:
        return np.asarray(self.motion.poses[link].z)

    def place(self, link: str, at: complex) -> Array:
        """A place of a link's own axes in the world."""
        pose = self.motion.poses[link]
        return np.asarray(pose.z + pose.u * at)

    # -- unknowns ------------------------------------------------------------------------------------------------------

    @cached_property
    def unknowns(self) -> list[_Unknown]:
        joints = [*self._turning(), *self._sliding(), *self._slots()]
        shared = Counter(frozenset((one.first, one.second)) for group in joints for one in group[:1])
        named: list[_Unknown] = []
        for group in joints:
            several = shared[frozenset((group[0].first, group[0].second))] > 1
            for one in group:
                pair, _, point = one.key.partition("@")
                named.append(one if several and point else replace(one, key=pair))
        return [*named, *self._balances()]

    def _turning(self) -> list[list[_Unknown]]:
        """Turning pairs: at each point the first link that has it with each later one."""
        found = []
        ones = np.ones(len(self.motion), dtype=complex)
        here = {self.scene.frame.name, *self.moving}
        for point, holders in self.scene.holders.items():
            links = [name for name in holders if name in here]
            if len(links) < 2:
                continue
            first, at = links[0], np.asarray(self.motion.point(point).z)
            for second in links[1:]:
                key = f"F_{first}/{second}@{point}"
                found.append([_Unknown(key, first, second, ones * way, at) for way in (1, 1j)])
        return found

    def _sliding(self) -> list[list[_Unknown]]:
        """Sliding pairs: a force square to the guide at the sliding link's first point, and a couple."""
        found = []
        for slide in self.structure.slides:
            if slide.slot:
                continue
            at = self.place(slide.a, self._foot(slide))
            tail = f"{slide.b}/{slide.a}@{slide.pin or ''}"
            square = 1j * self._guide(slide)
            found.append([
                _Unknown(f"F_{tail}", slide.b, slide.a, square, at),
                _Unknown(f"M_{tail}", slide.b, slide.a, None, at),
            ])
        return found

    def _foot(self, slide: Slide) -> complex:
        return self.structure.links[slide.a].points[slide.pin] if slide.pin else 0j

    def _guide(self, slide: Slide) -> Array:
        """Direction of a guide in the world."""
        return np.asarray(self.motion.poses[slide.b].u * slide.guide.direction)

    def _slots(self) -> list[list[_Unknown]]:
        """Pins in slots: a force square to the slot at the pin."""
        found = []
        for pin in self.scene.pins:
            slide = self.structure.slide(pin.key)
            at = np.asarray(self.motion.point(pin.point, pin.of).z)
            found.append([_Unknown(f"F_{pin.on}/{pin.of}@{pin.point}", pin.on, pin.of, 1j * self._guide(slide), at)])
        return found

    def _balances(self) -> list[_Unknown]:
        """What drives: for each driver a moment or a force between the two links, or what the scene says instead."""
        frame = self.scene.frame.name
        if self.scene.loading.balance is not None:
            return [self._said_balance(self.scene.loading.balance)]
        found = []
        for driver in self.scene.drivers:
            if isinstance(driver, AngleDriver):
                at = self.origin(driver.link)
                found.append(_Unknown(f"M_{driver.link}", driver.relative_to, driver.link, None, at))
                continue
            slide = self.structure.slide(driver.key)
            pin = next((p for p in self.scene.pins if p.key == driver.key), None)
            link = pin.of if pin else slide.a
            at = np.asarray(self.motion.point(pin.point, link).z) if pin else self.place(slide.a, self._foot(slide))
            found.append(_Unknown(f"F_{link}", slide.b or frame, link, self._guide(slide), at))
        return found

    def _said_balance(self, balance: BalanceAt) -> _Unknown:
        frame, link = self.scene.frame.name, balance.link
        at = self.place(link, balance.at)
        if balance.kind == "moment":
            return _Unknown(f"M_{link}", frame, link, None, at)
        along = np.full(len(self.motion), balance.turn)
        if balance.square:
            along = 1j * np.asarray(self.motion.poses[link].u)
        return _Unknown(f"F_{link}", frame, link, along, at)

    # -- what is known -------------------------------------------------------------------------------------------------

    def _known(self) -> tuple[dict[str, Array], dict[str, Array], list[tuple[str, Array, Array]]]:
        """Inertia forces and weights, inertia couples; and each with its link and place: (link, force, place)."""
        loading = self.scene.loading
        forces: dict[str, Array] = {}
        moments: dict[str, Array] = {}
        acting = []
        for mass in loading.masses:
            centre = self.motion.poses[mass.link].fixed(mass.at)
            push = np.asarray(-mass.mass * centre.a)
            forces[f"Fi_{mass.link}"] = push
            moments[f"Mi_{mass.link}"] = np.asarray(-mass.inertia * centre.alpha)
            acting.append((mass.link, push, np.asarray(centre.z)))
            if loading.gravity:
                weight = np.full(len(self.motion), mass.mass * loading.gravity)
                forces[f"G_{mass.link}"] = weight
                acting.append((mass.link, weight, np.asarray(centre.z)))
        return forces, moments, acting

    def _load(self, load: LoadOn) -> Array:
        """A force load as a vector, whether it acts or not."""
        n = len(self.motion)
        if load.against:
            slide = next(s for s in self.motion.slides if s.key == load.against)
            speed = self._growing.slide(slide.key).velocity
            most = np.abs(self._growing.poses[slide.b].omega) * self.scene.size + self._scale_of_speed
            sign = np.where(np.abs(speed) > 1e-12 * most, np.sign(speed), 0.0)
            return np.asarray(-load.size * sign * self._guide(slide))
        turn = load.turn * (np.asarray(self.motion.poses[load.follows].u) if load.follows else np.ones(n))
        return np.asarray(load.size * turn)

    @cached_property
    def _growing(self) -> Motion:
        """The motion itself or, at rest, that in which the first driver's value grows."""
        if any(driver.values[1] for driver in self.scene.drivers):
            return self.motion
        return self._reach.motion(self._reach.offsets(self.motion.values[:, 0]), unit=True)

    @cached_property
    def _scale_of_speed(self) -> Array:
        """The largest speed of any link at each position (m/s)."""
        speeds = [np.abs(self._growing.poses[name].v) for name in self.moving]
        speeds += [np.abs(self._growing.poses[name].omega) * self.scene.size for name in self.moving]
        return np.asarray(np.max(np.nan_to_num(speeds), axis=0))

    @cached_property
    def _reach(self) -> DriverRange:
        return driver_range(self.structure)

    def _acts(self, phase: Phase | None) -> tuple[Array, Array]:
        """Where a load acts, and where it begins or ends exactly; shape (n,) each."""
        n = len(self.motion)
        if phase is None:
            return np.ones(n, dtype=bool), np.zeros(n, dtype=bool)
        if phase.stroke:
            return self._on_stroke(phase)
        value = self.motion.values[:, 0]
        if not isinstance(self.scene.drivers[0], AngleDriver):
            edge = EDGE * (phase.end - phase.start)
            near = (np.abs(value - phase.start) < edge) | (np.abs(value - phase.end) < edge)
            return np.asarray((phase.start < value) & (value < phase.end)), np.asarray(near)
        turn, span = 2 * np.pi, phase.end - phase.start
        if span >= turn * (1 - EDGE):
            return np.ones(n, dtype=bool), np.zeros(n, dtype=bool)
        since = np.remainder(value - phase.start, turn)
        near = np.minimum(since, turn - since) < EDGE * turn
        near |= np.abs(since - span) < EDGE * turn
        return np.asarray(since < span), np.asarray(near)

    def _on_stroke(self, phase: Phase) -> tuple[Array, Array]:
        turn = extremes(self._reach, Symbol.parse(f"stroke_{phase.stroke}"))
        low, high = turn.low, turn.high
        travel = self.motion.slide(phase.stroke).travel
        speed = self._growing.slide(phase.stroke).velocity
        part = (travel - low) / (high - low) if high > low else np.zeros(len(self.motion))
        if phase.sense < 0:
            part = 1.0 - part
        running = np.sign(speed) == phase.sense
        near = np.zeros(len(self.motion), dtype=bool)
        for edge in (phase.start, phase.end):
            # where the slide turns back both senses meet
            turns = edge < EDGE or edge > 1.0 - EDGE
            near |= (np.abs(part - edge) < EDGE) & (running | turns)
        return np.asarray(running & (phase.start < part) & (part < phase.end)), np.asarray(near)

    # -- the system ----------------------------------------------------------------------------------------------------

    @cached_property
    def system(self) -> _System:
        """Equilibrium of each link, three rows each: both components of force, and moment about its origin over the
        size; a column for each unknown."""
        size = self.scene.size
        made: dict[tuple[int, int], Array] = {}
        for k, one in enumerate(self.unknowns):
            for link, sign in ((one.second, 1.0), (one.first, -1.0)):
                i = self.row.get(link)
                if i is None:
                    continue
                if one.along is None:
                    made[i + 2, k] = np.full(len(self.motion), sign)
                    continue
                arm = cross(one.at - self.origin(link), one.along) / size
                made |= {(i, k): sign * one.along.real, (i + 1, k): sign * one.along.imag, (i + 2, k): sign * arm}
        return _System(made, 3 * len(self.moving), len(self.unknowns), self.motion.ok)

    def solved(self) -> Forces:
        motion, size = self.motion, self.scene.size
        forces, moments, acting = self._known()
        n = len(motion)
        base = np.zeros((3 * len(self.moving), n))
        self._push(base, acting)
        for mass in self.scene.loading.masses:
            base[self.row[mass.link] + 2] -= moments[f"Mi_{mass.link}"] / size
        with_edges = base.copy()
        beside: dict[str, Array] = {}
        for load in self.scene.loading.loads:
            acts, edge = self._acts(load.phase)
            key = f"P_{load.name}"
            for on, system in ((acts & ~edge, base), (acts | edge, with_edges)):
                if load.is_force:
                    value = np.where(on, self._load(load), 0j)
                    self._push(system, [(load.link, value, self.place(load.link, load.at))])
                else:
                    value = np.where(on, load.size, 0.0)
                    system[self.row[load.link] + 2] -= value / size
                if system is base:
                    (forces if load.is_force else moments)[key] = value
                else:
                    beside[key] = value
        found, ok = self.system.answer(base)
        self._told(found, forces, moments)
        changed = (with_edges != base).any(axis=0) & ok
        if changed.any():
            self._told(np.where(changed, self.system.answer(with_edges)[0], np.nan), beside, beside)
        both = {**forces, **moments}
        for key, value in list(beside.items()):
            least = EDGE * np.nanmax(np.abs(np.nan_to_num(list(both.values()))), axis=0)
            same = np.abs(value - both[key]) <= np.where(np.isnan(value), np.inf, 1e-6 * least)
            beside[key] = np.where(same, np.nan, value)
            if np.isnan(beside[key]).all():
                del beside[key]
        gone = ~ok
        for table in (forces, moments):
            for key, value in table.items():
                table[key] = np.where(gone, np.nan, value)
        return Forces(motion, forces, moments, beside, ok)

    def _push(self, system: Array, acting: Sequence[tuple[str, Array, Array]]) -> None:
        """Known forces brought to the other side."""
        for link, force, at in acting:
            i = self.row[link]
            system[i] -= force.real
            system[i + 1] -= force.imag
            system[i + 2] -= cross(at - self.origin(link), force) / self.scene.size

    def _told(self, found: Array, forces: dict[str, Array], moments: dict[str, Array]) -> None:
        """The columns of the answer by their symbols."""
        for k, one in enumerate(self.unknowns):
            if one.along is None:
                moments[one.key] = found[k] * self.scene.size
            elif one.key in forces and k and self.unknowns[k - 1].key == one.key:
                forces[one.key] = forces[one.key] + found[k] * one.along
            else:
                forces[one.key] = found[k] * one.along

    def bounds(self, forces: Forces) -> tuple[Array, Array]:
        """First-order bound of what rounding and the bounds of the motion do to the answer (N, N m)."""
        size, n = self.scene.size, len(self.motion)
        place, _, push = self.motion.bound.of_point
        turn = self.motion.bound.of_turning
        right = np.zeros((3 * len(self.moving), n))
        for mass in self.scene.loading.masses:
            i = self.row[mass.link]
            centre = self.motion.poses[mass.link].fixed(mass.at)
            heavy = mass.mass * (push + 4 * EPS * np.abs(centre.a))
            weight = mass.mass * (np.abs(centre.a) + abs(self.scene.loading.gravity))
            right[i : i + 2] += heavy
            right[i + 2] += heavy + weight * (place / size + 8 * EPS) + mass.inertia * turn[2] / size
        for load in self.scene.loading.loads:
            i = self.row[load.link]
            right[i : i + 3] += abs(load.size) * (turn[0] + place / size + 8 * EPS if load.is_force else EPS / size)
        found = np.nan_to_num([self._size_of(one, forces) for one in self.unknowns])
        for (i, k), entry in self.system.entries.items():
            right[i] += (np.abs(entry) * 16 * EPS + place / size + turn[0]) * found[k]
        spread = self.system.spread(np.nan_to_num(right)) + 16 * EPS * found
        most = np.where(forces.ok, spread.max(axis=0), np.nan)
        return most, most * size

    def _size_of(self, one: _Unknown, forces: Forces) -> Array:
        value = forces.moments[one.key] / self.scene.size if one.along is None else forces.forces[one.key]
        return np.abs(value)


@dataclass(frozen=True)
class _System:
    """Linear systems of one pattern at n positions, solved block by block in the order that the pattern gives: the
    groups of the mechanism in the reverse order of solution (Dulmage and Mendelsohn, Coverings of bipartite graphs,
    Canad. J. Math. 10, 1958).

    entries : by row and column, shape (n,) each
    good : where there is something to solve, shape (n,)
    """

    entries: Mapping[tuple[int, int], Array]
    rows: int
    columns: int
    good: Array

    @cached_property
    def blocks(self) -> list[tuple[list[int], list[int]]] | None:
        """Rows and columns of each block, each after those it needs; None for a pattern that has no answer."""
        unknowns: list[list[int]] = [[] for _ in range(self.rows)]
        for (row, column), entry in self.entries.items():
            if (np.nan_to_num(entry) != 0.0).any():
                unknowns[row].append(column)
        matched = match(unknowns)
        if self.rows != self.columns or len(matched) < self.rows:
            return None
        row_of = {unknown: row for row, unknown in matched.items()}
        order = components({unknown: unknowns[row] for unknown, row in row_of.items()})
        return [([row_of[k] for k in part], list(part)) for part in order]

    @cached_property
    def inverses(self) -> tuple[list[Array], Array]:
        """The inverse of each block, shape (n, k, k), and where all of them have one."""
        good = self.good & np.isfinite(list(self.entries.values())).all(axis=0)
        made = []
        for rows, columns in self.blocks or ():
            unit = np.eye(len(rows))
            block = np.zeros((len(good), len(rows), len(rows)))
            for i, row in enumerate(rows):
                for k, column in enumerate(columns):
                    if (row, column) in self.entries:
                        block[:, i, k] = self.entries[row, column]
            block = np.where(good[:, None, None], block, unit)
            singular = np.linalg.slogdet(block)[0] == 0.0
            inverse = np.linalg.inv(np.where(singular[:, None, None], unit, block))
            norms = [np.abs(a).sum(axis=1).max(axis=1) for a in (block, inverse)]
            good = good & ~singular & (norms[0] * norms[1] < 1.0 / SINGULAR)
            made.append(inverse)
        return made, good if self.blocks is not None else np.zeros_like(good)

    def answer(self, right: Array) -> tuple[Array, Array]:
        """The solution of each system, shape (columns, n), NaN where there is none, and where there is one."""
        inverses, good = self.inverses
        good = good & np.isfinite(right).all(axis=0)
        found = np.zeros((self.columns, len(good)))
        # a second pass takes back the rounding of the first
        for _ in range(2):
            rest = right - self.times(self.entries, found)
            step = self._swept(self.entries, inverses, np.nan_to_num(rest), -1.0)
            found += step
        return np.where(good, found, np.nan), good

    def spread(self, right: Array) -> Array:
        """How far errors of this size on the right side may move each unknown."""
        sizes = {key: np.nan_to_num(np.abs(entry)) for key, entry in self.entries.items()}
        return self._swept(sizes, [np.abs(inverse) for inverse in self.inverses[0]], right, 1.0)

    def times(self, entries: Mapping[tuple[int, int], Array], found: Array) -> Array:
        """The left side of the equations."""
        left = np.zeros((self.rows, found.shape[1]))
        for (row, column), entry in entries.items():
            left[row] += entry * found[column]
        return left

    def _swept(
        self, entries: Mapping[tuple[int, int], Array], inverses: Sequence[Array], right: Array, sign: float
    ) -> Array:
        """One block after the other, what is found brought to the other side with a sign."""
        found = np.zeros((self.columns, right.shape[1]))
        rest = right.copy()
        for (rows, columns), inverse in zip(self.blocks or (), inverses, strict=True):
            found[columns] = np.einsum("nij,jn->in", inverse, rest[rows])
            own, done = set(columns), set(rows)
            for (row, column), entry in entries.items():
                if column in own and row not in done:
                    rest[row] += sign * np.nan_to_num(entry) * found[column]
        return found
