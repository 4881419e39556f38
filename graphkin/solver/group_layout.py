"""Where the joints of a larger group stand in its equations: by which links, in which rows and columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from graphkin.scene.model import AngleDriver
from graphkin.solver.joints import joint_place
from graphkin.solver.pose import Array, Pose
from graphkin.structure import Cluster, Pair, Slide, Structure, Turn

__all__ = ["NOTHING", "Layout", "layout_of"]


class _Ends(NamedTuple):
    """One side of some joints: columns of their links, place and direction of the joint's frame in the link's axes."""

    link: Array
    place: Array
    direction: Array

    def of(self, all_: Pose, order: int) -> Pose:
        """The joints' frames in the world, fields of shape (n, joints); rates up to the order, the others nothing."""
        z, u = all_.z[:, self.link], all_.u[:, self.link]
        arm = u * self.place
        z, u = z + arm, u * self.direction
        if order == 0:
            return Pose(z, u, NOTHING, NOTHING, NOTHING, NOTHING)
        omega, alpha = all_.omega[:, self.link], all_.alpha[:, self.link]
        spin = 1j * omega
        v = all_.v[:, self.link] + spin * arm
        return Pose(z, u, v, omega, all_.a[:, self.link] + (1j * alpha + spin * spin) * arm, alpha)


class _Entries(NamedTuple):
    """Entries of the matrix by links of the group: of which joints, in which row and column, with which sense."""

    joint: Array
    row: Array
    column: Array
    sense: Array


NOTHING = np.zeros(1)


class Layout:
    """What stands where among the constraints of a group: the rows of its pairs, then of its drivers."""

    def __init__(self, structure: Structure, group: Cluster) -> None:
        drivers = structure.drivers
        self.names = (*group.members, *dict.fromkeys(n for n in self._used(group) if n not in group.members))
        self.link = {name: k for k, name in enumerate(self.names)}
        self.members = len(group.members)
        self.size = structure.scene.size
        turns: list[tuple[int, Turn]] = []
        lines: list[tuple[int, Slide, complex]] = []
        slides: list[int] = []
        angles: list[tuple[int, str, str, int]] = []
        self.travels: list[tuple[int, int, int]] = []
        row = 0
        for pair in group.pairs:
            if isinstance(pair, Turn):
                turns.append((row, pair))
            else:
                slides.append(row)
                lines.append((row + 1, pair, -1j))
            row += 2
        self.slides = len(slides)
        for driver in group.drivers:
            i = drivers.index(driver)
            if isinstance(driver, AngleDriver):
                angles.append((row, driver.link, driver.relative_to, i))
            else:
                self.travels.append((row, len(lines), i))
                lines.append((row, structure.slide(driver.key), 1 + 0j))
            row += 1
        weights = [relation.weights(self.size) for relation in group.rolling]
        self.rolling_rows = np.arange(row, row + len(weights))
        self.rolled = np.zeros((len(weights), len(self.names)))
        """How much the turning of each link counts in each relation of what rolls."""
        for k, terms in enumerate(weights):
            for (kind, name), weight in terms.items():
                if kind == "angle":
                    self.rolled[k, self.link[name]] = weight
                else:
                    lines.append((row + k, structure.slide(name), complex(weight * self.size)))
        outside = np.flatnonzero(np.any(self.rolled != 0.0, axis=0))
        self.outside = outside[outside >= self.members]
        """Links that the group hangs on of which the turns count."""
        self.relations_end = self.members + len(weights)
        row += len(weights)
        self.rows = row
        self.turns = [self._ends(structure, [(p, getattr(p, side)) for _, p in turns]) for side in "ab"]
        self.lines = [self._ends(structure, [(p, getattr(p, side)) for _, p, _ in lines]) for side in "ab"]
        self.turn_rows = np.array([r for r, _ in turns], dtype=int)
        self.slide_rows = np.array(slides, dtype=int)
        self.line_rows = np.array([r for r, _, _ in lines], dtype=int)
        self.part = np.array([part for _, _, part in lines], dtype=complex)
        """By this times a number its real part is the part that a line wants: along the guide or across."""
        both = [(link, base) for _, link, base, _ in angles]
        self.angle_rows = np.array([r for r, *_ in angles], dtype=int)
        self.turned = [np.array([self.link[x] for x in side], dtype=int) for side in zip(*both, strict=True)]
        self.angle_drivers = np.array([i for *_, i in angles], dtype=int)
        self.turn_entries = [self._entries(e, self.turn_rows, s) for e, s in zip(self.turns, (1.0, -1.0), strict=True)]
        self.line_entries = [self._entries(e, self.line_rows, s) for e, s in zip(self.lines, (1.0, -1.0), strict=True)]
        self.same = np.zeros((self.rows, 3 * self.members))
        self.same[self.rolling_rows, 2::3] = self.rolled[:, : self.members]
        for entries in self.turn_entries:
            self.same[entries.row, entries.column] = entries.sense
            self.same[entries.row + 1, entries.column + 1] = entries.sense
        turning = [(r, p.a, p.b) for r, (_, p, _) in zip(slides, lines, strict=False)]
        for r, one, two in [*turning, *((r, one, two) for r, one, two, _ in angles)]:
            for name, sign in ((one, 1.0), (two, -1.0)):
                if self.link[name] < self.members:
                    self.same[r, 3 * self.link[name] + 2] += sign

    @staticmethod
    def _used(group: Cluster) -> Iterator[str]:
        for pair in group.pairs:
            yield from (pair.a, pair.b)
        for driver in group.drivers:
            if isinstance(driver, AngleDriver):
                yield from (driver.link, driver.relative_to)
        for relation in group.rolling:
            yield from relation.links

    def _ends(self, structure: Structure, joints: Sequence[tuple[Pair, str]]) -> _Ends:
        frames = [joint_place(structure, pair, link) for pair, link in joints]
        return _Ends(
            np.array([self.link[link] for _, link in joints], dtype=int),
            np.array([place for place, _ in frames], dtype=complex),
            np.array([direction for _, direction in frames], dtype=complex),
        )

    def _entries(self, ends: _Ends, rows: Array, sense: float) -> _Entries:
        own = np.flatnonzero(ends.link < self.members)
        return _Entries(own, rows[own], 3 * ends.link[own], np.full(len(own), sense))


def layout_of(structure: Structure, group: Cluster) -> Layout:
    """The layout of a group, made once; it goes with its structure."""
    drivers = tuple(structure.drivers.index(driver) for driver in group.drivers)
    key = "layout", group.members, group.pairs, drivers, group.rolling
    if key not in structure.kept:
        structure.kept[key] = Layout(structure, group)
    layout: Layout = structure.kept[key]
    return layout
