"""Vector loops in numbers: how far they are from closing, their rates as matrix equations, and the root of each.

The sum of all arrows z is zero.  With the arrows' own angular velocities w and, along guides (unit vector u), sliding
velocities v its rates are sum(i w z + v u) = 0 and sum((i a - w^2) z + 2 i w v u + b u) = 0, a and b being the second
rates: two linear equations a loop for the rates of what it gives (Norton, Design of Machinery, ch. 6 and 7).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphkin.plane import added_up, cross, dot
from graphkin.structure.loops import Arrow, Loop, Unknown, angle_of, loops_of
from graphkin.structure.model import Structure

__all__ = ["ArrowValue", "LoopBlock", "LoopValue", "Root", "loops_in_numbers"]

Matrix = NDArray[np.float64]


@dataclass(frozen=True)
class ArrowValue:
    """An arrow here: ``vector`` (m) in the frame; along a guide ``travel`` (m) times the unit vector ``along``."""

    arrow: Arrow
    vector: complex
    along: complex = 0j
    travel: float = 0.0


@dataclass(frozen=True)
class Root:
    """The closed-form root of a loop: ``key`` tells the kind, ``unknown`` what it gives, ``numbers`` are its
    coefficients (SI), ``sign`` of the square root is that of the assembly (0: there is one root only), ``value`` is
    what comes out (rad, m)."""

    key: str
    unknown: Unknown
    numbers: tuple[float, ...]
    sign: int
    value: float


@dataclass(frozen=True)
class LoopValue:
    """A loop here; ``gap`` is the sum of its arrows (m), which is nothing but rounding."""

    loop: Loop
    arrows: tuple[ArrowValue, ...]
    root: Root | None

    @property
    def gap(self) -> complex:
        return added_up((a.vector for a in self.arrows), 0j)


@dataclass(frozen=True)
class LoopBlock:
    """Loops that are solved together: ``matrix`` times the rates of ``unknowns`` is ``velocity``, times their second
    rates ``acceleration``; rows are the x and y components of the loops in turn (m, or 1 for a travel)."""

    loops: tuple[LoopValue, ...]
    unknowns: tuple[Unknown, ...]
    values: tuple[float, ...]
    matrix: Matrix
    velocity: Matrix
    acceleration: Matrix
    rates: tuple[float, ...]
    second_rates: tuple[float, ...]


def loops_in_numbers(
    structure: Structure, axes: Mapping[str, complex], travels: Mapping[str, float]
) -> tuple[LoopBlock, ...]:
    """Every loop at one position, in the order of solution, as far as its links are placed.

    Parameters
    ----------
    axes : unit vector of each link's own x axis
    travels : of each sliding pair (m)

    Raises
    ------
    CallError : see `loops_of`
    """
    turning = _turning(structure)
    angle = {Unknown("theta", structure.scene.frame.name): (0.0, 0.0)}
    for driver in structure.scene.drivers:
        if not driver.turns:
            angle[Unknown("s", driver.key)] = driver.values[1:]
    blocks: dict[int, list[Loop]] = {}
    for loop in loops_of(structure):
        blocks.setdefault(loop.block, []).append(loop)
    made = []
    for block in blocks.values():
        if not all(a.link in axes and (not a.slide or a.slide in travels) for loop in block for a in loop.arrows):
            break
        one = _block(structure, block, axes, travels, turning, angle)
        if one is None:
            break
        angle |= {u: (v, w) for u, v, w in zip(one.unknowns, one.rates, one.second_rates, strict=True)}
        made.append(one)
    return tuple(made)


Turning = Mapping[str, tuple[str, float, float]]
"""For each link the one whose angle stands for its own, and how much faster it turns (rad/s, rad/s2)."""


def _turning(structure: Structure) -> Turning:
    joins: list[tuple[str, str, float, float]] = [(s.b, s.a, 0.0, 0.0) for s in structure.slides]
    for d in structure.scene.drivers:
        if d.turns:
            joins.append((d.relative_to, d.link, d.rate, d.second))
    found: dict[str, tuple[str, float, float]] = {}
    for first in angle_of(structure).values():
        found.setdefault(first, (first, 0.0, 0.0))
    grown = True
    while grown:
        grown = False
        for a, b, rate, second in joins:
            for here, there, sign in ((a, b, 1.0), (b, a, -1.0)):
                if here in found and there not in found:
                    first, omega, alpha = found[here]
                    found[there] = first, omega + sign * rate, alpha + sign * second
                    grown = True
    return found


def _block(
    structure: Structure, block: Sequence[Loop], axes: Mapping[str, complex], travels: Mapping[str, float],
    turning: Turning, known: Mapping[Unknown, tuple[float, float]],
) -> LoopBlock | None:  # fmt: skip
    unknowns = block[0].unknowns
    place = {u: k for k, u in enumerate(unknowns)}
    size = 2 * len(block)
    if len(unknowns) != size:
        return None
    matrix = np.zeros((size, size))
    velocity, acceleration = np.zeros(size), np.zeros(size)
    loops = []
    for n, loop in enumerate(block):
        arrows = tuple(_value(arrow, axes, travels) for arrow in loop.arrows)
        for arrow in arrows:
            first = Unknown("theta", turning[arrow.arrow.link][0])
            _add(matrix, n, place.get(first), 1j * arrow.vector)
            if arrow.arrow.slide:
                _add(matrix, n, place.get(Unknown("s", arrow.arrow.slide)), arrow.along)
        loops.append(LoopValue(loop, arrows, _root(loop, arrows, turning, axes)))
    for n, loop_value in enumerate(loops):
        for arrow in loop_value.arrows:
            (omega, _), (slip, _) = _known_rates(arrow, turning, known)
            _put(velocity, n, -(1j * omega * arrow.vector + slip * arrow.along))
    try:
        rates = np.linalg.solve(matrix, velocity)
    except np.linalg.LinAlgError:
        return None
    now = {**known, **{u: (float(rates[k]), 0.0) for u, k in place.items()}}
    for n, loop_value in enumerate(loops):
        for arrow in loop_value.arrows:
            (omega, alpha), (slip, push) = _known_rates(arrow, turning, now)
            bent = (1j * alpha - omega**2) * arrow.vector + (2j * omega * slip + push) * arrow.along
            _put(acceleration, n, -bent)
    second = np.linalg.solve(matrix, acceleration)
    values = tuple(
        travels[u.of] if u.kind == "s" else cmath.phase(axes[u.of]) for u in unknowns
    )
    return LoopBlock(tuple(loops), unknowns, values, matrix, velocity, acceleration,
                     tuple(map(float, rates)), tuple(map(float, second)))  # fmt: skip


def _value(arrow: Arrow, axes: Mapping[str, complex], travels: Mapping[str, float]) -> ArrowValue:
    z = arrow.vector * axes[arrow.link]
    if not arrow.slide:
        return ArrowValue(arrow, z)
    return ArrowValue(arrow, z * travels[arrow.slide], z, travels[arrow.slide])


def _known_rates(
    arrow: ArrowValue, turning: Turning, known: Mapping[Unknown, tuple[float, float]]
) -> tuple[tuple[float, float], tuple[float, float]]:
    first, more, more_second = turning[arrow.arrow.link]
    omega, alpha = known.get(Unknown("theta", first), (0.0, 0.0))
    slip = known.get(Unknown("s", arrow.arrow.slide), (0.0, 0.0)) if arrow.arrow.slide else (0.0, 0.0)
    return (omega + more, alpha + more_second), slip


def _add(matrix: Matrix, loop: int, column: int | None, z: complex) -> None:
    if column is not None:
        matrix[2 * loop, column] += z.real
        matrix[2 * loop + 1, column] += z.imag


def _put(vector: Matrix, loop: int, z: complex) -> None:
    vector[2 * loop] += z.real
    vector[2 * loop + 1] += z.imag


# -- the root ---------------------------------------------------------------------------------------------------------


def _root(loop: Loop, arrows: Sequence[ArrowValue], turning: Turning, axes: Mapping[str, complex]) -> Root | None:
    """The closed-form root of a loop with two unknowns; None for loops that are solved together."""
    if len(loop.unknowns) != 2:
        return None
    angles = [u for u in loop.unknowns if u.kind == "theta"]
    slides = [u for u in loop.unknowns if u.kind == "s"]
    rigid: dict[str, complex] = {u.of: 0j for u in angles}  # in the axes of the link that stands for the angle
    along: dict[str, tuple[str | None, complex]] = {}  # of a slide: the angle that it turns with, its unit vector
    known = 0j
    for arrow in arrows:
        first = turning[arrow.arrow.link][0]
        turned = axes[first].conjugate() if first in rigid else 1.0
        open_slide = any(u.of == arrow.arrow.slide for u in slides)
        if open_slide:
            along[arrow.arrow.slide] = (first if first in rigid else None), arrow.along * turned
        elif first in rigid:
            rigid[first] += arrow.vector * turned
        else:
            known += arrow.vector
    if len(angles) == 2:
        one, two = angles
        return _two_angles(one, rigid[one.of], rigid[two.of], known, axes[one.of])
    if len(angles) == 1 and len(along) == 1:
        (key, (turns, unit)), angle = next(iter(along.items())), angles[0]
        travel = next(a.travel for a in arrows if a.arrow.slide == key)
        if turns is None:
            # r e^(i theta) + s u + d = 0
            middle, across = -dot(known, unit), cross(unit, known)
            rest = abs(rigid[angle.of]) ** 2 - across**2
        else:
            # (s u + c) e^(i theta) + d = 0
            middle, across = -dot(rigid[angle.of], unit), cross(unit, rigid[angle.of])
            rest = abs(known) ** 2 - across**2
        sign = 1 if travel >= middle else -1
        value = middle + sign * math.sqrt(max(0.0, rest))
        return Root("loop root travel", Unknown("s", key), (middle, rest), sign, value)
    if len(along) == 2 and not angles:
        (one_key, (_, u)), (_, (_, v)) = along.items()
        sine = cross(u, v)
        return None if sine == 0.0 else Root("loop root lines", Unknown("s", one_key), (cross(v, known), sine), 0,
                                             cross(v, known) / sine)  # fmt: skip
    return None


def _two_angles(unknown: Unknown, r: complex, other: complex, d: complex, axis: complex) -> Root | None:
    """|r e^(i theta) + d| = |other|: A cos + B sin = C, theta = 2 atan2(B +- sqrt(A2 + B2 - C2), A + C)."""
    turned = d * r.conjugate()
    a, b = 2 * turned.real, 2 * turned.imag
    c = abs(other) ** 2 - abs(r) ** 2 - abs(d) ** 2
    inside = a * a + b * b - c * c
    if r == 0 or other == 0:
        return None
    here = cmath.phase(axis)

    def root(sign: int) -> float:
        return 2 * math.atan2(b + sign * math.sqrt(max(0.0, inside)), a + c)

    sign = min((1, -1), key=lambda s: abs(math.remainder(root(s) - here, math.tau)))
    return Root("loop root angle", unknown, (a, b, c), sign, math.remainder(root(sign), math.tau))
