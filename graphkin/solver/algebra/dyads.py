"""The dyads in closed form: formulas of position, velocity and acceleration.

A dyad is two bodies; each has an outer joint to a known frame and an inner joint to the other body.  Every joint
is a frame of axes: of a turning pair only the origin counts; at a sliding pair the two frames have the direction of the
guide, and their distance along it is the travel.  So the five kinds need no angle and no special case for offsets,
angles between block and rod, or the link with the guide.  A body whose own shape changes in a given way (a driven
cylinder) has moving joint frames.

Sources: circle with circle, circle with line, right triangle, line with line as in Waldron and Kinzel,
Kinematics, Dynamics and Design of Machinery, ch. 5; velocity and acceleration by one 2 x 2 system each, its determinant
taken from the triangle itself, where nothing cancels, not from the directions found.

The functions compute with formulas (``graphkin.solver.algebra.expressions``) as well as with arrays.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, NamedTuple, TypeAlias

from graphkin.plane import Values, cross, dot
from graphkin.solver.algebra.expressions import Real, Vec, fmax, fmin, root, two_sum
from graphkin.solver.algebra.pose import Pose, R, V
from graphkin.structure import DyadKind

TOUCH = 1e-12
"""A least value of a discriminant (no unit) within this of zero is a touch, where it is not known in fifty digits."""


@dataclass(frozen=True, eq=False, repr=False)
class Joints(Generic[V, R]):
    """The joint frames of a dyad.

    ``known1``, ``known2`` in the world; ``outer1``, ``inner1`` in the axes of the first body, ``outer2``, ``inner2``
    in those of the second.  ``sense`` is +1 where the body slides at the sliding pair of unknown travel (RRP, PRP, RPP:
    the outer pair of ``second``), -1 where it has the guide.  Lengths are divided by ``size`` (m).
    """

    known1: Pose[V, R]
    outer1: Pose[V, R]
    inner1: Pose[V, R]
    known2: Pose[V, R]
    outer2: Pose[V, R]
    inner2: Pose[V, R]
    sense: float
    size: R


class DyadSolution(NamedTuple, Generic[V, R]):
    """The solution of a dyad.

    first, second : the axes of the two bodies
    discriminant : positive where the dyad can be assembled, zero where its two assemblies meet; no unit
    sine : of the crossing angle of the two loci, signed by assembly; small near a dead point
    e1, e2 : the two directions of the rate equations
    right_side : right side of the velocity equation
    """

    first: Pose[V, R]
    second: Pose[V, R]
    discriminant: R
    sine: R
    e1: V
    e2: V
    right_side: V


def solve_dyad(kind: DyadKind, joints: Joints[V, R], sign: R) -> DyadSolution[V, R]:
    """Solve a dyad of the given kind.

    Parameters
    ----------
    sign : +1 or -1, the assembly.  RRR: the inner point left or right of the line from the first known point to the
        second; RRP: the greater or smaller travel; RPR: the travel positive or negative (without offsets).  PRP and RPP
        have one assembly; there it is the sign of the sine.
    """
    return _SOLVERS[kind](joints, sign)


def _square(z: Values) -> Values:
    return z.real * z.real + z.imag * z.imag


def _length(z: Values) -> Values:
    return root(_square(z))


def _by(arm: Values, local: Values, long: Values) -> Values:
    """The direction of a body from one of its vectors in the world and in its own axes."""
    return arm * (local * (1.0 / (long * long))).conjugate()


def _slip(u: V, outer: Pose[V, R], inner: Pose[V, R]) -> Values:
    """Rate of the vector from the outer to the inner joint, seen from the body itself."""
    return u * (inner.v - outer.v)


def _bent(arm: V, u: V, outer: Pose[V, R], inner: Pose[V, R], omega: R) -> Values:
    """Second rate of that vector in the world when the body turns with ``omega`` and no angular acceleration."""
    return u * (inner.a - outer.a + omega * (2j * (inner.v - outer.v))) - (omega * omega) * arm


def _rrr(j: Joints[V, R], sign: R) -> DyadSolution[V, R]:
    r1, r2 = j.inner1.z - j.outer1.z, j.inner2.z - j.outer2.z
    long1, long2 = _length(r1), _length(r2)
    line = j.known2.z - j.known1.z
    square = _square(line)
    c = root(square)
    # Heron's product of four sums, the small ones formed without loss
    both, both_rest = two_sum(long1, long2)
    less, less_rest = two_sum(fmax(long1, long2), -fmin(long1, long2))
    product = ((both - c + both_rest) * (both + c)) * ((c - less - less_rest) * (c + less))
    area = root(product)  # four times that of the triangle
    half = (0.5 * sign) / square
    to1 = line * (((long1 + long2) * (long1 - long2) * sign) * half + 0.5 + 1j * (area * half))
    to2 = to1 - line
    u1, u2 = _by(to1, r1, long1), _by(to2, r2, long2)
    # w1 i to1 - w2 i to2 = right_side
    over = (2.0 * sign) / area
    right_side = j.known2.v - j.known1.v + _slip(u2, j.outer2, j.inner2) - _slip(u1, j.outer1, j.inner1)
    w1, w2 = dot(right_side, to2) * over, dot(right_side, to1) * over
    second = j.known2.a - j.known1.a + _bent(to2, u2, j.outer2, j.inner2, w2) - _bent(to1, u1, j.outer1, j.inner1, w1)
    al1, al2 = dot(second, to2) * over, dot(second, to1) * over
    whole = 1.0 / (2.0 * (long1 * long2))
    return DyadSolution(
        j.known1.pinned(j.outer1, u1, w1, al1),
        j.known2.pinned(j.outer2, u2, w2, al2),
        product * (whole * whole),
        area * (sign * whole),
        1j * to1,
        -1j * to2,
        right_side,
    )


def _rrp(j: Joints[V, R], sign: R) -> DyadSolution[V, R]:
    guide = j.known2
    u2 = guide.u * j.outer2.u.conjugate()
    w2, al2 = guide.omega - j.outer2.omega, guide.alpha - j.outer2.alpha
    arm2 = u2 * (j.inner2.z - j.outer2.z)
    r1 = j.inner1.z - j.outer1.z
    radius = _length(r1)
    # in the axes of the guide: from the foot of the circle's centre on the path of the inner point
    foot = (j.known1.z - (guide.z + arm2)) * guide.u.conjugate()
    inside = (radius - abs(foot.imag)) * (radius + abs(foot.imag))
    half = sign * j.sense * root(inside)
    t = foot.real + half
    arm1 = guide.u * (half - 1j * foot.imag)
    u1 = _by(arm1, r1, radius)
    none = 0.0 * half
    moved = guide.along(t, none, none)
    right_side = moved.v + 1j * w2 * arm2 + _slip(u2, j.outer2, j.inner2) - j.known1.v - _slip(u1, j.outer1, j.inner1)
    # w1 (i arm1) - dt guide.u = right_side
    over = 1.0 / half
    w1, dt = cross(guide.u, right_side) * over, -dot(arm1, right_side) * over
    moved = guide.along(t, dt, none)
    second = moved.a + 1j * al2 * arm2 + _bent(arm2, u2, j.outer2, j.inner2, w2)
    second = second - j.known1.a - _bent(arm1, u1, j.outer1, j.inner1, w1)
    al1, ddt = cross(guide.u, second) * over, -dot(arm1, second) * over
    return DyadSolution(
        j.known1.pinned(j.outer1, u1, w1, al1),
        guide.along(t, dt, ddt).pinned(j.outer2, u2, w2, al2),
        inside * (1.0 / (radius * radius)),
        half * (1.0 / radius),
        1j * arm1,
        -guide.u,
        right_side,
    )


def _rpr(j: Joints[V, R], sign: R) -> DyadSolution[V, R]:
    # both outer points in the axes of the guide: q is what the shapes of the bodies add to the travel
    outer1, outer2 = j.inner1.inverse().of(j.outer1), j.inner2.inverse().of(j.outer2)
    q, dq, ddq = outer1.z - outer2.z, outer1.v - outer2.v, outer1.a - outer2.a
    line = j.known1.z - j.known2.z
    dline, ddline = j.known1.v - j.known2.v, j.known1.a - j.known2.a
    square = _square(line)
    c = root(square)
    inside = (c - abs(q.imag)) * (c + abs(q.imag))
    leg = sign * root(inside)
    d = line * ((leg - 1j * q.imag) * (1.0 / square))
    # ds d + w i line = right_side, where d leads line by an angle of cosine leg / c
    over = 1.0 / leg
    right_side = dline - d * dq
    ds, w = dot(right_side, line) * over, cross(d, right_side) * over
    second = ddline + (w * w) * line - d * (ddq + 2j * w * (ds + dq))
    al = cross(d, second) * over
    return DyadSolution(
        j.known1.pinned(j.outer1, d * j.inner1.u.conjugate(), w - j.inner1.omega, al - j.inner1.alpha),
        j.known2.pinned(j.outer2, d * j.inner2.u.conjugate(), w - j.inner2.omega, al - j.inner2.alpha),
        inside * (1.0 / (j.size * j.size)),
        leg / root(square + j.size * j.size),  # over a smooth stand-in for the greater of both lengths
        d,
        1j * line,
        right_side,
    )


def _two(e1: Values, e2: Values, over: Values, w: Values) -> tuple[Values, Values]:
    """Solve x e1 + y e2 = w for real x, y, with over = 1 / (e1 x e2)."""
    return cross(w, e2) * over, cross(e1, w) * over


def _prp(j: Joints[V, R], sign: R) -> DyadSolution[V, R]:
    g1, g2 = j.known1, j.known2
    u1, u2 = g1.u * j.outer1.u.conjugate(), g2.u * j.outer2.u.conjugate()
    w1, w2 = g1.omega - j.outer1.omega, g2.omega - j.outer2.omega
    al1, al2 = g1.alpha - j.outer1.alpha, g2.alpha - j.outer2.alpha
    arm1, arm2 = u1 * (j.inner1.z - j.outer1.z), u2 * (j.inner2.z - j.outer2.z)
    slip = _slip(u2, j.outer2, j.inner2) - _slip(u1, j.outer1, j.inner1)
    e1, e2 = g1.u, -g2.u
    sine = cross(e1, e2)
    over = 1.0 / sine
    none = 0.0 * sine
    t1, t2 = _two(e1, e2, over, g2.z + arm2 - g1.z - arm1)
    moved1, moved2 = g1.along(t1, none, none), g2.along(t2, none, none)
    right_side = moved2.v + 1j * w2 * arm2 - moved1.v - 1j * w1 * arm1 + slip
    dt1, dt2 = _two(e1, e2, over, right_side)
    moved1, moved2 = g1.along(t1, dt1, none), g2.along(t2, dt2, none)
    ends = moved2.a + 1j * al2 * arm2 + _bent(arm2, u2, j.outer2, j.inner2, w2)
    ends = ends - moved1.a - 1j * al1 * arm1 - _bent(arm1, u1, j.outer1, j.inner1, w1)
    ddt1, ddt2 = _two(e1, e2, over, ends)
    return DyadSolution(
        g1.along(t1, dt1, ddt1).pinned(j.outer1, u1, w1, al1),
        g2.along(t2, dt2, ddt2).pinned(j.outer2, u2, w2, al2),
        sign * sine,
        sine,
        e1,
        e2,
        right_side,
    )


def _rpp(j: Joints[V, R], sign: R) -> DyadSolution[V, R]:
    guide = j.known2
    u2 = guide.u * j.outer2.u.conjugate()
    w2, al2 = guide.omega - j.outer2.omega, guide.alpha - j.outer2.alpha
    d, w, al = u2 * j.inner2.u, w2 + j.inner2.omega, al2 + j.inner2.alpha
    u1, w1, al1 = d * j.inner1.u.conjugate(), w - j.inner1.omega, al - j.inner1.alpha
    first = j.known1.pinned(j.outer1, u1, w1, al1)
    end1 = first.of(j.inner1)
    # with no travel at the outer guide the inner joint of the second body would be here
    e1, e2 = guide.u, d
    sine = cross(e1, e2)
    over = 1.0 / sine
    none = 0.0 * sine

    def inner_at(t: R, dt: R) -> Pose[V, R]:
        return guide.along(t, dt, none).pinned(j.outer2, u2, w2, al2).of(j.inner2)

    t, s = _two(e1, e2, over, end1.z - inner_at(none, none).z)
    right_side = end1.v - inner_at(t, none).v - 1j * w * s * d
    dt, ds = _two(e1, e2, over, right_side)
    ddt, _ = _two(e1, e2, over, end1.a - inner_at(t, dt).a - (2j * w * ds + (1j * al - w * w) * s) * d)
    second = guide.along(t, dt, ddt).pinned(j.outer2, u2, w2, al2)
    return DyadSolution(first, second, sign * sine, sine, e1, e2, right_side)


_SOLVERS: dict[DyadKind, Callable[[Joints[Values, Values], Values], DyadSolution[Values, Values]]] = {
    "RRR": _rrr,
    "RRP": _rrp,
    "RPR": _rpr,
    "PRP": _prp,
    "RPP": _rpp,
}

PoseFormula: TypeAlias = "Pose[Vec, Real]"
"""A pose given by formulas."""
