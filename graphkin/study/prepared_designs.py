"""A prepared mechanism in many designs: its dimensions are changed in the formulas, without reading or analysing it
again.

If every group of a design stays far from its dead points over the whole turn, its assembly is that of the original
mechanism, and all such designs are computed together.  The others are followed one by one, as any mechanism.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphkin.errors import SceneError, Unsolvable
from graphkin.scene.model import Dimension, Mechanism, with_dimensions
from graphkin.solver.algebra.expressions import Code, Name
from graphkin.solver.algebra.pose import Array, turned
from graphkin.solver.drivers import GivenValues, UniformGrid, own_values
from graphkin.solver.path.assemblies import choose_modes
from graphkin.solver.path.driver_range import DriverRange, range_from
from graphkin.solver.prepared import PreparedMechanism, prepare
from graphkin.structure import analyse

NODES = 360
"""Positions of a turn at which the groups of a design are looked at."""
CLEAR = 0.04
"""A discriminant (no unit) that is greater at all of these, and changes slowly, is zero nowhere between them."""
TOGETHER = 1 << 16
"""Positions that are computed together."""
LOOP = 64
"""From so many positions of each design on its own loop of compiled code pays."""


@dataclass(frozen=True)
class PreparedMechanisms:
    """Designs of a prepared mechanism.

    given : the changed numbers of each, shape (designs,) each, SI
    """

    ready: PreparedMechanism
    given: Mapping[Dimension, Array]

    def __reduce__(self) -> tuple[object, ...]:
        return PreparedMechanisms, (self.ready, self.given)  # open formulas are made anew

    @cached_property
    def count(self) -> int:
        return len(next(iter(self.given.values())))

    @cached_property
    def _open(self) -> dict[Name, Array]:
        """Numbers of the formulas by name, for each design, where it changes them."""
        columns: dict[Name, Array] = {}
        ready = self.ready
        numbers = {name: (values, ready.dimensions[name]) for name, values in self.given.items()}
        for name, (values, old) in {**numbers, **self._guides}.items():
            kind, *rest = name
            if kind in ("rate", "second"):
                columns[name] = values.real
            elif kind == "value" and rest[0]:
                k, u = rest[0], turned(values.real)
                columns |= {("travel", k): values.real, ("cos", k): u.real, ("sin", k): u.imag}
            elif kind in ("point", "turn") or name in self._guides:
                for axis, part, was in (("x", values.real, old.real), ("y", values.imag, old.imag)):
                    if (part != was).any():
                        columns[*name, axis] = part
        return columns

    @cached_property
    def _guides(self) -> dict[Dimension, tuple[Array, complex]]:
        """Place and direction of the guide of each sliding pair that the designs change, and those of the mechanism
        itself.  The centre of a disc on a flat face slides beside the face, by the radius of the disc."""
        dimensions, guides = self.ready.dimensions, dict[Dimension, tuple[Array, complex]]()
        for s in self.ready.structure.slides:
            through, direction = ("through", s.b, s.guide.name), ("direction", s.b, s.guide.name)
            if through in self.given or direction in self.given:
                beside = (s.guide.through - dimensions[through]) / dimensions[direction]
                along = self.given.get(direction, np.full(1, dimensions[direction]))
                at = self.given.get(through, np.full(1, dimensions[through])) + beside * along
                guides["through", s.key] = np.broadcast_to(at, (self.count,)), s.guide.through
                guides["direction", s.key] = np.broadcast_to(along, (self.count,)), s.guide.direction
        return guides

    @cached_property
    def _formulas(self) -> PreparedMechanism:
        """The mechanism with the designs' numbers left open."""
        drivers = self.ready.structure.scene.drivers
        moving = tuple(d.values[2] != 0 or ("second", k) in self.given for k, d in enumerate(drivers))
        return self.ready.opened(frozenset(self._open), moving)

    @cached_property
    def _start(self) -> Array:
        """The beginning of each design's turn, shape (designs,) or (1,)."""
        return self.given.get(("value", 0), self.ready.range.start[:1]).real

    @cached_property
    def _way(self) -> Array:
        """A turn in the sense of each, shape (designs,) or (1,)."""
        rate = self.given.get(("rate", 0), np.array([self.ready.range.wide])).real
        return np.copysign(2 * np.pi, np.where(rate == 0, 1.0, rate))

    def _compute(self, code: Code, which: Array, cosine: Array, sine: Array) -> Array:
        """Formulas of some designs at positions given for each, shapes (designs, n): shape (formulas, designs, n)."""
        which = np.arange(self.count)[which]
        n = cosine.shape[1]
        out = np.empty((len(code.asked), len(which), n))
        each = max(1, TOGETHER // n)
        invariants = self._formulas.invariants(code)
        for low in range(0, len(which), each):
            some = slice(low, low + each)
            changed = [name for name in code.inputs if name in self._open]
            given = {name: np.repeat(self._open[name][which[some]], n) for name in changed}
            given["cos", 0], given["sin", 0] = np.ravel(cosine[some]), np.ravel(sine[some])
            rows = np.empty((len(code.asked), len(which[some]) * n))
            code.arrays(invariants, [given[name] for name in code.inputs], list(rows))
            out[:, some] = rows.reshape(len(rows), len(which[some]), n)
        return out

    @cached_property
    def together(self) -> Array:
        """Designs that are computed together, shape (designs,)."""
        ready = self.ready
        if not ready.whole or ready.signs is None or ready.bounded:  # bounds are made of each mechanism by itself
            return np.zeros(self.count, dtype=bool)
        nodes = UniformGrid(0.0, 2 * np.pi, NODES, 0, NODES).turn
        turn = (np.broadcast_to(x, (self.count, NODES)) for x in nodes)
        seen = self._compute(self._formulas.checks, np.arange(self.count), *turn)
        # so near to each other that nothing happens between two nodes
        steps = np.abs(seen - np.roll(seen, 1, axis=2))
        return np.asarray(((seen > CLEAR) & (steps < seen / 2)).all(axis=(0, 2)))

    @property
    def starts(self) -> Array:
        """The values of the drivers at the own position of each, shape (designs, drivers) (rad, m)."""
        starts = enumerate(self.ready.range.start)
        each = (np.broadcast_to(self.given.get(("value", j), value), self.count).real for j, value in starts)
        return np.stack([*each], axis=1)

    def mechanism(self, k: int) -> Mechanism:
        """A design by its number."""
        changed = {name: complex(numbers[k]) for name, numbers in self.given.items()}
        return with_dimensions(self.ready.structure.scene, changed)

    def reach(self, k: int) -> DriverRange:
        """The range of a design by its number, in the assembly that the mechanism has at its own position.

        Raises
        ------
        Unsolvable, SceneError : it cannot be assembled
        """
        scene = self.mechanism(k)
        structure, own_modes = analyse(scene), self.ready.range.modes(np.zeros(1))
        modes = choose_modes(structure)
        for i, dyad in structure.dyads.items():
            if not dyad.is_two_lines:
                modes[i] = own_modes[i][0]
        return range_from(structure, modes, own_values(scene))

    def _alone(self) -> Iterator[tuple[int, PreparedMechanism]]:
        """The designs followed one by one, by their numbers; without those that cannot be assembled."""
        ready = self.ready
        for k in np.flatnonzero(~self.together).tolist():
            with suppress(Unsolvable, SceneError):
                along = self.reach(k)
                yield k, prepare(along.structure, ready.wanted, ready.units, ready.bounded, along)

    def sweep(self, n: int, fast: bool = False) -> tuple[Array, Array, Array]:
        """The columns of all designs over the whole range, as for one mechanism.

        Returns
        -------
        columns : shape (columns, designs, n), in the units of the mechanism; NaN where not ok
        ok : bool, shape (designs, n)
        values : of the first driver (rad, m), shape (n,), or (designs, n) where they differ
        """
        out = np.empty((self.ready.rows, self.count, n))
        out[:, ~self.together] = np.nan
        ok = np.repeat(self.together[:, None], n, axis=1)
        which = np.flatnonzero(self.together)
        if fast and n >= LOOP:
            self._loops(which, n, out.reshape(len(out), -1))
        elif len(which):
            out[:, which] = self._compute(self._formulas.code, which, *self._turns(which, n))
        values = self._values(n) if self.ready.turns else np.full((self.count, n), np.nan)
        if not self.together.all():
            values = np.array(np.broadcast_to(values, (self.count, n)))
        for k, design in self._alone():
            out[:, k], ok[k] = design.sweep(n)
            values[k] = design.range.grid(n).values
        return out, ok, values

    def _values(self, n: int) -> Array:
        """Values of an angle driver over a turn, shape (n,), or (designs, n) where they differ (rad)."""
        if self.given.keys().isdisjoint({("value", 0), ("rate", 0)}):
            return self.ready.range.grid(n).values
        start, travel = (np.broadcast_to(x, (self.count,)) for x in (self._start, self._way))
        return start[:, None] + travel[:, None] / n * np.arange(n)

    def _turns(self, which: Array, n: int) -> tuple[Array, Array]:
        """Cosines and sines of the driver at n positions of each design, shape (designs, n)."""
        shape = len(which), n
        values = self._values(n)
        if values.ndim == 1:
            c, s = self.ready.range.grid(n).turn
            return np.broadcast_to(c, shape), np.broadcast_to(s, shape)
        c, s = GivenValues(np.ravel(values[which])).turn
        return c.reshape(shape), s.reshape(shape)

    def _loops(self, which: Array, n: int, out: Array) -> None:
        opened = self._formulas
        given = {**opened.fixed, **dict.fromkeys(self._open, 0.0)}
        names = opened.by_design.params
        numbers = np.tile([*opened.dimensioned.params(names, given), 0.0, 0.0], (self.count, 1))
        for j, name in enumerate(names):
            if name in self._open:
                numbers[:, j] = self._open[name]
        numbers[:, -2], numbers[:, -1] = self._start, self._way
        for k in which.tolist():
            opened.on_grid.run(k * n, (k + 1) * n, numbers[k], n, -k * n, out)

    def at(self, value: float | None) -> tuple[Array, Array, Array]:
        """All designs at one value of the first driver (rad, m), or each at its own: columns, shape (columns, designs),
        ok, shape (designs,), and the values, shape () or (designs,)."""
        values = np.array(value) if value is not None else self._start if ("value", 0) in self.given else self._start[0]
        each = np.broadcast_to(values, (self.count,))
        out, ok = np.full((self.ready.rows, self.count), np.nan), self.together.copy()
        which = np.flatnonzero(ok)
        if len(which):
            c, s = (x[:, None] for x in GivenValues(each[which]).turn)
            out[:, which] = self._compute(self._formulas.code, which, c, s)[:, :, 0]
        for k, design in self._alone():
            _, ok[k : k + 1] = design.columns(each[k : k + 1], out[:, k : k + 1])
        return out, ok, np.asarray(values)
