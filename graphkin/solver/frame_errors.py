"""How far the errors of known links reach on: through joints to the links that hang on them, to first order.

A worst case carried through every operation grows with each group as if nothing cancelled; but what a group does with
the errors of its neighbours is known: small errors of the known joints move its bodies as small velocities would, with
the same two directions and the same sine (Higham, Accuracy and Stability of Numerical Algorithms, ch. 1: forward error
is condition times backward error).  Where the errors are not small beside the sine nothing is known.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from graphkin.plane import cross
from graphkin.solver.dyads import DyadSolution, Joints
from graphkin.solver.expressions import PoseFormula, Real, Vec, fmax, root
from graphkin.solver.pose import Pose
from graphkin.solver.rounding import ErrorBound
from graphkin.structure import DyadKind

__all__ = ["FrameError", "carried", "of_dyad", "seen", "within"]

SAFE = 4.0
"""Errors of directions, beside the sine of a group, above a quarter of which first order does not hold."""


FrameError = ErrorBound[Real]
"""How far a frame of axes may be off; formulas."""
_Off = tuple[Real, Real, Real] | tuple[float, float, float]
"""Errors of an unknown of a dyad, an angle or a travel, and of its rates."""


_Way = tuple[Real, Real, Real]
"""Lengths of an arm as seen from its frame, and of its rates."""


def _lengths(*vectors: Vec) -> _Way:
    r, s, b = (root(z.real * z.real + z.imag * z.imag) for z in vectors)
    return r, s, b


def within(start: PoseFormula, end: PoseFormula) -> _Way:
    """The arm between two frames of one body, both in its axes."""
    return _lengths(end.z - start.z, end.v - start.v, end.a - start.a)


def seen(frame: PoseFormula, point: PoseFormula) -> _Way:
    """The arm from a frame to a point that moves in it, both in the world."""
    arm, spin = point.z - frame.z, 1j * frame.omega
    slip = point.v - frame.v - spin * arm
    push = point.a - frame.a - (1j * frame.alpha - frame.omega * frame.omega) * arm - 2.0 * (spin * slip)
    return _lengths(arm, slip, push)


def carried(error: FrameError, frame: PoseFormula, way: _Way, off: _Off = (0.0, 0.0, 0.0)) -> FrameError:
    """The error of a point at the end of an arm, with the direction of the frame that the arm is seen from.

    Parameters
    ----------
    frame : axes in the world; only their rates of turning count
    off : what the arm adds itself along its way
    """
    spin, bend = abs(frame.omega), abs(frame.alpha) + frame.omega * frame.omega
    (r, s, b), (x, dx, ddx) = way, off
    turned = error.omega + spin * error.angle
    return replace(
        error,
        position=error.position + r * error.angle + x,
        velocity=error.velocity + r * turned + s * error.angle + spin * x + dx,
        acceleration=error.acceleration
        + r * (error.alpha + bend * error.angle + 2.0 * (spin * error.omega))
        + 2.0 * (s * turned)
        + b * error.angle
        + bend * x
        + 2.0 * (spin * dx)
        + ddx,
    )


def of_dyad(
    kind: DyadKind, joints: Joints[Vec, Real], solved: DyadSolution[Vec, Real], first: FrameError, second: FrameError
) -> tuple[FrameError, FrameError]:
    """The errors of the two bodies of a dyad.

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
    for order in range(3):
        a, b = ends(one, two)
        open_ = a.of_point[order] + b.of_point[order]
        if order == 0:
            turned = rigid(by1 * open_, by2 * open_)
            # the sine itself is off by the errors of the two directions
            left = fmax(1.0 - SAFE * turned * (long1 * by1), 0.0 * across)
            open_ = open_ / left
        one = (*one[:order], by1 * open_, *none[order + 1 :])
        two = (*two[:order], by2 * open_, *none[order + 1 :])
    return bodies(one, two)


_Ends = Callable[[_Off, _Off], tuple[FrameError, FrameError]]
_Rigid = Callable[[Real, Real], Real]
_Parts = tuple[_Ends, _Ends, _Rigid]
"""FrameErrors of the inner joint by both ways to it, doubts of both bodies, errors of the two directions together."""


def _still(joint: PoseFormula) -> PoseFormula:
    """The origin of a body, in its axes, like a joint."""
    none = 0.0 * joint.z
    return Pose(none, joint.u, none, joint.omega, none, joint.alpha)


def _origin(joint: PoseFormula) -> _Way:
    """The arm from a joint of a body to the body's own origin, both in its axes."""
    return within(_still(joint), joint)


def _rrr(j: Joints[Vec, Real], s: DyadSolution[Vec, Real], first: FrameError, second: FrameError) -> _Parts:
    arm1, arm2 = within(j.outer1, j.inner1), within(j.outer2, j.inner2)
    back1, back2 = _origin(j.outer1), _origin(j.outer2)

    def ends(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        return carried(first.turning_as(*one), s.first, arm1), carried(second.turning_as(*two), s.second, arm2)

    def bodies(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        return carried(first.turning_as(*one), s.first, back1), carried(second.turning_as(*two), s.second, back2)

    return ends, bodies, lambda x, y: x + y


def _rrp(j: Joints[Vec, Real], s: DyadSolution[Vec, Real], first: FrameError, second: FrameError) -> _Parts:
    slid, arm1, arm2 = seen(j.known2, s.second.of(j.outer2)), within(j.outer1, j.inner1), within(j.outer2, j.inner2)
    back1, back2 = _origin(j.outer1), _origin(j.outer2)

    def ends(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        there = carried(second, j.known2, slid, two)
        return carried(first.turning_as(*one), s.first, arm1), carried(there, s.second, arm2)

    def bodies(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        there = carried(second, j.known2, slid, two)
        return carried(first.turning_as(*one), s.first, back1), carried(there, s.second, back2)

    return ends, bodies, lambda x, y: x + second.angle


def _rpr(j: Joints[Vec, Real], s: DyadSolution[Vec, Real], first: FrameError, second: FrameError) -> _Parts:
    bar = s.second.of(j.inner2)
    # from one known point to the other, seen from the common direction
    axes = Pose(j.known2.z, bar.u, j.known2.v, bar.omega, j.known2.a, bar.alpha)
    line, back1, back2 = seen(axes, j.known1), _origin(j.outer1), _origin(j.outer2)

    def ends(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        return first, carried(second.turning_as(*two), axes, line, one)

    def bodies(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        return carried(first.turning_as(*two), s.first, back1), carried(second.turning_as(*two), s.second, back2)

    return ends, bodies, lambda x, y: y + y


def _prp(j: Joints[Vec, Real], s: DyadSolution[Vec, Real], first: FrameError, second: FrameError) -> _Parts:
    slid1, slid2 = seen(j.known1, s.first.of(j.outer1)), seen(j.known2, s.second.of(j.outer2))
    arm1, arm2 = within(j.outer1, j.inner1), within(j.outer2, j.inner2)
    back1, back2 = _origin(j.outer1), _origin(j.outer2)

    def joints(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        return carried(first, j.known1, slid1, one), carried(second, j.known2, slid2, two)

    def ends(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        a, b = joints(one, two)
        return carried(a, s.first, arm1), carried(b, s.second, arm2)

    def bodies(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        a, b = joints(one, two)
        return carried(a, s.first, back1), carried(b, s.second, back2)

    return ends, bodies, lambda x, y: first.angle + second.angle


def _rpp(j: Joints[Vec, Real], s: DyadSolution[Vec, Real], first: FrameError, second: FrameError) -> _Parts:
    bar = s.second.of(j.inner2)
    hinge, along = first.turning_as(*second.of_turning), seen(bar, s.first.of(j.inner1))
    slid, arm1, arm2 = seen(j.known2, s.second.of(j.outer2)), within(j.outer1, j.inner1), within(j.outer2, j.inner2)
    back1, back2 = _origin(j.outer1), _origin(j.outer2)

    def ends(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        there = carried(carried(second, j.known2, slid, one), s.second, arm2)
        return carried(hinge, s.first, arm1), carried(there, bar, along, two)

    def bodies(one: _Off, two: _Off) -> tuple[FrameError, FrameError]:
        return carried(hinge, s.first, back1), carried(carried(second, j.known2, slid, one), s.second, back2)

    return ends, bodies, lambda x, y: second.angle + second.angle


_KINDS: Mapping[DyadKind, Callable[[Joints[Vec, Real], DyadSolution[Vec, Real], FrameError, FrameError], _Parts]] = {
    "RRR": _rrr,
    "RRP": _rrp,
    "RPR": _rpr,
    "PRP": _prp,
    "RPP": _rpp,
}
