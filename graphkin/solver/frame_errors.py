"""How far the errors of known links reach on: through joints to the links that hang on them, to first order.

A worst case carried through every operation grows with each group as if nothing cancelled; but what a group does with
the errors of its neighbours is known: small errors of the known joints move its bodies as small velocities would, with
the same two directions and the same sine (Higham, Accuracy and Stability of Numerical Algorithms, ch. 1: forward error
is condition times backward error).  Where the errors are not small beside the sine nothing is known.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from graphkin.solver.dyads import Joints, Solved
from graphkin.solver.expressions import Vec, fmax, root
from graphkin.solver.pose import Pose, cross

__all__ = ["Doubt", "carried", "of_dyad", "seen", "within"]

SAFE = 4.0
"""Errors of directions, beside the sine of a group, above a quarter of which first order does not hold."""


@dataclass(frozen=True)
class Doubt:
    """How far a frame of axes may be off: its origin (m) and direction (rad), and the rates of both; formulas."""

    z: Any
    u: Any
    v: Any
    omega: Any
    a: Any
    alpha: Any

    def __add__(self, other: Doubt) -> Doubt:
        return Doubt(
            self.z + other.z,
            self.u + other.u,
            self.v + other.v,
            self.omega + other.omega,
            self.a + other.a,
            self.alpha + other.alpha,
        )

    def turning_as(self, other: Doubt) -> Doubt:
        """The origin of these axes, with the direction of others."""
        return replace(self, u=other.u, omega=other.omega, alpha=other.alpha)


_Off = tuple[Any, Any, Any]
"""Errors of an unknown of a dyad, an angle or a travel, and of its rates."""


_Way = tuple[Any, Any, Any]
"""Lengths of an arm as seen from its frame, and of its rates."""


def _lengths(*vectors: Vec) -> _Way:
    r, s, b = (root(z.real * z.real + z.imag * z.imag) for z in vectors)
    return r, s, b


def within(start: Pose, end: Pose) -> _Way:
    """The arm between two frames of one body, both in its axes."""
    return _lengths(end.z - start.z, end.v - start.v, end.a - start.a)


def seen(frame: Pose, point: Pose) -> _Way:
    """The arm from a frame to a point that moves in it, both in the world."""
    arm, spin = point.z - frame.z, 1j * frame.omega
    slip = point.v - frame.v - spin * arm
    push = point.a - frame.a - (1j * frame.alpha - frame.omega * frame.omega) * arm - 2.0 * (spin * slip)
    return _lengths(arm, slip, push)


def carried(doubt: Doubt, frame: Pose, way: _Way, off: _Off = (0.0, 0.0, 0.0)) -> Doubt:
    """The doubt of a point at the end of an arm, with the direction of the frame that the arm is seen from.

    Parameters
    ----------
    frame : axes in the world; only their rates of turning count
    off : what the arm adds itself along its way
    """
    spin, bend = abs(frame.omega), abs(frame.alpha) + frame.omega * frame.omega
    (r, s, b), (x, dx, ddx) = way, off
    turned = doubt.omega + spin * doubt.u
    return replace(
        doubt,
        z=doubt.z + r * doubt.u + x,
        v=doubt.v + r * turned + s * doubt.u + spin * x + dx,
        a=doubt.a
        + r * (doubt.alpha + bend * doubt.u + 2.0 * (spin * doubt.omega))
        + 2.0 * (s * turned)
        + b * doubt.u
        + bend * x
        + 2.0 * (spin * dx)
        + ddx,
    )


def of_dyad(kind: str, joints: Joints, solved: Solved, first: Doubt, second: Doubt) -> tuple[Doubt, Doubt]:
    """The doubts of the two bodies of a dyad.

    Parameters
    ----------
    first, second : of its two known joint frames
    """
    ends, bodies, rigid = _KINDS[kind](joints, solved, first, second)
    across = abs(cross(solved.e1, solved.e2))
    long1, long2, _ = _lengths(solved.e1, solved.e2, 0.0 * solved.e1)
    # x1 e1 + x2 e2 = w has x1 <= |w| |e2| / |e1 x e2|
    by1, by2 = long2 / across, long1 / across
    none: _Off = (0.0, 0.0, 0.0)
    one, two = none, none
    for order, level in enumerate(("z", "v", "a")):
        a, b = ends(one, two)
        open_ = getattr(a, level) + getattr(b, level)
        if order == 0:
            turned = rigid(by1 * open_, by2 * open_)
            # the sine itself is off by the errors of the two directions
            left = fmax(1.0 - SAFE * turned * (long1 * by1), 0.0 * across)
            open_ = open_ / left
        one = (*one[:order], by1 * open_, *none[order + 1 :])
        two = (*two[:order], by2 * open_, *none[order + 1 :])
    return bodies(one, two)


_Ends = Callable[[_Off, _Off], tuple[Doubt, Doubt]]
_Rigid = Callable[[Any, Any], Any]
_Parts = tuple[_Ends, _Ends, _Rigid]
"""Doubts of the inner joint by both ways to it, doubts of both bodies, errors of the two directions together."""


def _turning(doubt: Doubt, off: _Off) -> Doubt:
    """A joint about which a body turns whose angle is off."""
    return replace(doubt, u=off[0], omega=off[1], alpha=off[2])


def _still(joint: Pose) -> Pose:
    """The origin of a body, in its axes, like a joint."""
    none = 0.0 * joint.z
    return Pose(none, joint.u, none, joint.omega, none, joint.alpha)


def _origin(joint: Pose) -> _Way:
    """The arm from a joint of a body to the body's own origin, both in its axes."""
    return within(_still(joint), joint)


def _rrr(j: Joints, s: Solved, first: Doubt, second: Doubt) -> _Parts:
    arm1, arm2 = within(j.outer1, j.inner1), within(j.outer2, j.inner2)
    back1, back2 = _origin(j.outer1), _origin(j.outer2)

    def ends(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        return carried(_turning(first, one), s.first, arm1), carried(_turning(second, two), s.second, arm2)

    def bodies(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        return carried(_turning(first, one), s.first, back1), carried(_turning(second, two), s.second, back2)

    return ends, bodies, lambda x, y: x + y


def _rrp(j: Joints, s: Solved, first: Doubt, second: Doubt) -> _Parts:
    slid, arm1, arm2 = seen(j.known2, s.second.of(j.outer2)), within(j.outer1, j.inner1), within(j.outer2, j.inner2)
    back1, back2 = _origin(j.outer1), _origin(j.outer2)

    def ends(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        there = carried(second, j.known2, slid, two)
        return carried(_turning(first, one), s.first, arm1), carried(there, s.second, arm2)

    def bodies(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        there = carried(second, j.known2, slid, two)
        return carried(_turning(first, one), s.first, back1), carried(there, s.second, back2)

    return ends, bodies, lambda x, y: x + second.u


def _rpr(j: Joints, s: Solved, first: Doubt, second: Doubt) -> _Parts:
    bar = s.second.of(j.inner2)
    # from one known point to the other, seen from the common direction
    axes = Pose(j.known2.z, bar.u, j.known2.v, bar.omega, j.known2.a, bar.alpha)
    line, back1, back2 = seen(axes, j.known1), _origin(j.outer1), _origin(j.outer2)

    def ends(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        return first, carried(_turning(second, two), axes, line, one)

    def bodies(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        return carried(_turning(first, two), s.first, back1), carried(_turning(second, two), s.second, back2)

    return ends, bodies, lambda x, y: y + y


def _prp(j: Joints, s: Solved, first: Doubt, second: Doubt) -> _Parts:
    slid1, slid2 = seen(j.known1, s.first.of(j.outer1)), seen(j.known2, s.second.of(j.outer2))
    arm1, arm2 = within(j.outer1, j.inner1), within(j.outer2, j.inner2)
    back1, back2 = _origin(j.outer1), _origin(j.outer2)

    def joints(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        return carried(first, j.known1, slid1, one), carried(second, j.known2, slid2, two)

    def ends(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        a, b = joints(one, two)
        return carried(a, s.first, arm1), carried(b, s.second, arm2)

    def bodies(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        a, b = joints(one, two)
        return carried(a, s.first, back1), carried(b, s.second, back2)

    return ends, bodies, lambda x, y: first.u + second.u


def _rpp(j: Joints, s: Solved, first: Doubt, second: Doubt) -> _Parts:
    bar = s.second.of(j.inner2)
    hinge, along = first.turning_as(second), seen(bar, s.first.of(j.inner1))
    slid, arm1, arm2 = seen(j.known2, s.second.of(j.outer2)), within(j.outer1, j.inner1), within(j.outer2, j.inner2)
    back1, back2 = _origin(j.outer1), _origin(j.outer2)

    def ends(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        there = carried(carried(second, j.known2, slid, one), s.second, arm2)
        return carried(hinge, s.first, arm1), carried(there, bar, along, two)

    def bodies(one: _Off, two: _Off) -> tuple[Doubt, Doubt]:
        return carried(hinge, s.first, back1), carried(carried(second, j.known2, slid, one), s.second, back2)

    return ends, bodies, lambda x, y: second.u + second.u


_KINDS: Mapping[str, Callable[[Joints, Solved, Doubt, Doubt], _Parts]] = {
    "RRR": _rrr,
    "RRP": _rrp,
    "RPR": _rpr,
    "PRP": _prp,
    "RPP": _rpp,
}
