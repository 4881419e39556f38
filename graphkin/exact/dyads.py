"""The dyads in closed form: position, velocity and acceleration, as arrays over positions.

A dyad is two bodies; each has an outer joint to a known frame and an inner joint to the other body.  Every joint
is a frame of axes: of a turning pair only the origin counts; at a sliding pair the two frames have one direction, that
of the guide, and lie apart along it by the travel.  With that the five kinds need no angle and no special case for
offsets, angles between block and rod, or which side carries the guide.  A body whose own shape changes in a given way
(a driven cylinder) has moving joint frames.

Sources: circle with circle, circle with line, right triangle, line with line as in Waldron and Kinzel,
Kinematics, Dynamics and Design of Machinery, ch. 5; velocity and acceleration by one 2 x 2 system each.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphkin.exact.pose import Array, Pose, cross

__all__ = ["Joints", "Solved", "solve_dyad"]


@dataclass(frozen=True)
class Joints:
    """The joint frames of a dyad.

    ``known1``, ``known2`` in the world; ``outer1``, ``inner1`` in the axes of the first body, ``outer2``, ``inner2``
    in those of the second.  ``sense`` is +1 where, at the sliding pair whose travel is unknown, the body slides
    (RRP, PRP, RPP: the outer one of ``second``), -1 where it carries the guide.  ``size`` (m) makes lengths small.
    """

    known1: Pose
    outer1: Pose
    inner1: Pose
    known2: Pose
    outer2: Pose
    inner2: Pose
    sense: float
    size: float


class Solved(NamedTuple):
    """What a dyad gives.

    first, second : the axes of the two bodies
    discriminant : positive where the dyad can be assembled, zero where its two assemblies meet; no unit
    sine : of the angle at which the two loci cross, signed by assembly; small near a dead point
    e1, e2 : the two directions of the rate equations
    load : right side of the velocity equation
    """

    first: Pose
    second: Pose
    discriminant: Array
    sine: Array
    e1: Array
    e2: Array
    load: Array


def solve_dyad(kind: str, joints: Joints, sign: Array, rates: bool = True) -> Solved:
    """Solve a dyad of the given kind.

    Parameters
    ----------
    sign : real, shape (positions,) or scalar: +1 or -1, the assembly.  RRR: the inner point left or right of the line
        from the first known point to the second; RRP: the greater or smaller travel; RPR: the travel positive or
        negative (but for offsets).  PRP and RPP have one assembly; there it is the sign of the sine that is watched.
    rates : False leaves velocity and acceleration out (they are then those of the joints at standstill)
    """
    return _SOLVERS[kind](joints, sign, rates)


def _two(e1: Array, e2: Array, w: Array) -> tuple[Array, Array]:
    """Solve x e1 + y e2 = w for real x, y."""
    det = cross(e1, e2)
    return cross(w, e2) / det, cross(e1, w) / det


def _arm(body_u: Array, outer: Pose, inner: Pose) -> tuple[Array, Callable[[Array], Array], Array]:
    """Vector from the outer to the inner joint in the world: itself, its own second rate at given omega, its slip."""
    r, dr, ddr = inner.z - outer.z, inner.v - outer.v, inner.a - outer.a

    def bent(omega: Array) -> Array:
        return np.asarray(body_u * (ddr + omega * (2j * dr - omega * r)))

    return body_u * r, bent, body_u * dr


def _rrr(j: Joints, sign: Array, rates: bool) -> Solved:
    r1, r2 = j.inner1.z - j.outer1.z, j.inner2.z - j.outer2.z
    long1, long2 = np.abs(r1), np.abs(r2)
    line = j.known2.z - j.known1.z
    c = np.abs(line)
    lo, mid, hi = np.sort(np.stack(np.broadcast_arrays(long1, long2, c)), axis=0)
    product = (hi + (mid + lo)) * (lo - (hi - mid)) * (lo + (hi - mid)) * (hi + (mid - lo))
    discriminant = product / (2 * long1 * long2) ** 2
    height = np.sqrt(np.maximum(product, 0.0)) / (2 * c)
    along = ((long1 - long2) * (long1 + long2) / c + c) / 2
    e = line / c
    to1 = e * (along + 1j * sign * height)
    to2 = e * (along - c + 1j * sign * height)
    u1, u2 = _unit(to1 * np.conj(r1)), _unit(to2 * np.conj(r2))
    arm1, bent1, slip1 = _arm(u1, j.outer1, j.inner1)
    arm2, bent2, slip2 = _arm(u2, j.outer2, j.inner2)
    e1, e2 = 1j * arm1, -1j * arm2
    load = j.known2.v - j.known1.v + slip2 - slip1
    w1, w2, al1, al2 = _still(c)
    if rates:
        w1, w2 = _two(e1, e2, load)
        al1, al2 = _two(e1, e2, j.known2.a - j.known1.a + bent2(w2) - bent1(w1))
    return Solved(
        j.known1.hung(j.outer1, u1, w1, al1),
        j.known2.hung(j.outer2, u2, w2, al2),
        discriminant,
        cross(arm1, arm2) / (long1 * long2),
        e1,
        e2,
        load,
    )


def _rrp(j: Joints, sign: Array, rates: bool) -> Solved:
    guide = j.known2
    u2 = guide.u * np.conj(j.outer2.u)
    w2, al2 = guide.omega - j.outer2.omega, guide.alpha - j.outer2.alpha
    arm2, bent2, slip2 = _arm(u2, j.outer2, j.inner2)
    r1 = j.inner1.z - j.outer1.z
    radius = np.abs(r1)
    # in the axes of the guide: from the foot of the circle's centre on the path of the inner point
    foot = (j.known1.z - (guide.z + arm2)) * np.conj(guide.u)
    inside = (radius - np.abs(foot.imag)) * (radius + np.abs(foot.imag))
    half = sign * j.sense * np.sqrt(np.maximum(inside, 0.0))
    t = foot.real + half
    u1 = _unit(guide.u * (half - 1j * foot.imag) * np.conj(r1))
    arm1, bent1, slip1 = _arm(u1, j.outer1, j.inner1)
    e1, e2 = 1j * arm1, -guide.u
    moved = guide.along(t, np.zeros(1), np.zeros(1))
    load = moved.v + 1j * w2 * arm2 + slip2 - j.known1.v - slip1
    w1, dt, al1, ddt = _still(radius)
    if rates:
        w1, dt = _two(e1, e2, load)
        moved = guide.along(t, dt, np.zeros(1))
        al1, ddt = _two(e1, e2, moved.a + 1j * al2 * arm2 + bent2(w2) - j.known1.a - bent1(w1))
    return Solved(
        j.known1.hung(j.outer1, u1, w1, al1),
        guide.along(t, dt, ddt).hung(j.outer2, u2, w2, al2),
        inside / radius**2,
        half / radius,
        e1,
        e2,
        load,
    )


def _rpr(j: Joints, sign: Array, rates: bool) -> Solved:
    # both outer points in the axes of the guide: q is what the shapes of the bodies add to the travel
    one, two = j.inner1.inverse().of(j.outer1), j.inner2.inverse().of(j.outer2)
    q, dq, ddq = one.z - two.z, one.v - two.v, one.a - two.a
    line = j.known1.z - j.known2.z
    dline, ddline = j.known1.v - j.known2.v, j.known1.a - j.known2.a
    c = np.abs(line)
    inside = (c - np.abs(q.imag)) * (c + np.abs(q.imag))
    leg = sign * np.sqrt(np.maximum(inside, 0.0))
    d = _unit(line * (leg - 1j * q.imag))
    e1, e2 = d, 1j * line
    load = dline - d * dq
    ds, w, _, al = _still(c)
    if rates:
        ds, w = _two(e1, e2, load)
        _, al = _two(e1, e2, ddline + w * w * line - d * (ddq + 2j * w * (ds + dq)))
    return Solved(
        j.known1.hung(j.outer1, d * np.conj(j.inner1.u), w - j.inner1.omega, al - j.inner1.alpha),
        j.known2.hung(j.outer2, d * np.conj(j.inner2.u), w - j.inner2.omega, al - j.inner2.alpha),
        inside / j.size**2,
        leg / np.maximum(c, j.size),
        e1,
        e2,
        load,
    )


def _prp(j: Joints, sign: Array, rates: bool) -> Solved:
    g1, g2 = j.known1, j.known2
    u1, u2 = g1.u * np.conj(j.outer1.u), g2.u * np.conj(j.outer2.u)
    w1, w2 = g1.omega - j.outer1.omega, g2.omega - j.outer2.omega
    al1, al2 = g1.alpha - j.outer1.alpha, g2.alpha - j.outer2.alpha
    arm1, bent1, slip1 = _arm(u1, j.outer1, j.inner1)
    arm2, bent2, slip2 = _arm(u2, j.outer2, j.inner2)
    e1, e2 = g1.u, -g2.u
    none = np.zeros(1)
    t1, t2 = _two(e1, e2, g2.z + arm2 - g1.z - arm1)
    moved1, moved2 = g1.along(t1, none, none), g2.along(t2, none, none)
    load = moved2.v + 1j * w2 * arm2 + slip2 - moved1.v - 1j * w1 * arm1 - slip1
    dt1, dt2, ddt1, ddt2 = _still(t1)
    if rates:
        dt1, dt2 = _two(e1, e2, load)
        moved1, moved2 = g1.along(t1, dt1, none), g2.along(t2, dt2, none)
        ends = moved2.a + 1j * al2 * arm2 + bent2(w2) - moved1.a - 1j * al1 * arm1 - bent1(w1)
        ddt1, ddt2 = _two(e1, e2, ends)
    sine = cross(e1, e2)
    return Solved(
        g1.along(t1, dt1, ddt1).hung(j.outer1, u1, w1, al1),
        g2.along(t2, dt2, ddt2).hung(j.outer2, u2, w2, al2),
        sign * sine,
        sine,
        e1,
        e2,
        load,
    )


def _rpp(j: Joints, sign: Array, rates: bool) -> Solved:
    guide = j.known2
    u2 = guide.u * np.conj(j.outer2.u)
    w2, al2 = guide.omega - j.outer2.omega, guide.alpha - j.outer2.alpha
    d, w, al = u2 * j.inner2.u, w2 + j.inner2.omega, al2 + j.inner2.alpha
    u1, w1, al1 = d * np.conj(j.inner1.u), w - j.inner1.omega, al - j.inner1.alpha
    first = j.known1.hung(j.outer1, u1, w1, al1)
    end1 = first.of(j.inner1)
    none = np.zeros(1)
    # with no travel at the outer guide the inner joint of the second body would be here
    e1, e2 = guide.u, d

    def inner_at(t: Array, dt: Array) -> Pose:
        return guide.along(t, dt, none).hung(j.outer2, u2, w2, al2).of(j.inner2)

    t, s = _two(e1, e2, end1.z - inner_at(none, none).z)
    load = end1.v - inner_at(t, none).v - 1j * w * s * d
    dt, ds, ddt, _ = _still(t)
    if rates:
        dt, ds = _two(e1, e2, load)
        ddt, _ = _two(e1, e2, end1.a - inner_at(t, dt).a - (2j * w * ds + (1j * al - w * w) * s) * d)
    sine = cross(e1, e2)
    return Solved(first, guide.along(t, dt, ddt).hung(j.outer2, u2, w2, al2), sign * sine, sine, e1, e2, load)


def _unit(z: Array) -> Array:
    return np.asarray(z / np.abs(z))


def _still(like: Array) -> tuple[Array, Array, Array, Array]:
    zero = np.zeros(np.shape(like))
    return zero, zero, zero, zero


_SOLVERS: dict[str, Callable[[Joints, Array, bool], Solved]] = {
    "RRR": _rrr,
    "RRP": _rrp,
    "RPR": _rpr,
    "PRP": _prp,
    "RPP": _rpp,
}
