"""How far every link may be off: its own rounding, and what it inherits from the links it hangs on; as formulas.

Errors reach on through joints to the links that hang on them, to first order.  A worst case carried through every
operation grows with each group as if nothing cancelled; but what a group does with the errors of its neighbours is
known: small errors of the known joints move its bodies as small velocities would, with the same two directions and the
same sine (Higham, Accuracy and Stability of Numerical Algorithms, ch. 1: forward error is condition times backward
error).  Where the errors are not small beside the sine nothing is known.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Protocol

from graphkin.plane import cross
from graphkin.scene.cams import LawCam, SlidingFollower
from graphkin.solver.dyads import DyadSolution, Frames, Joints, PoseFormula, body_shape
from graphkin.solver.expressions import ExpressionGraph, Real, Vec, fmax, root
from graphkin.solver.pose import FIELDS, ErrorBound, Pose
from graphkin.solver.rounding import Rounding
from graphkin.structure import Driven, Dyad, DyadKind, Element, Pair, Rolled
from graphkin.structure.model import Coordinate

__all__ = ["ErrorFormulas", "FrameError", "carried"]

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


FEW = 3.0
"""Roundings in adding a point to the origin of its link."""


class Formulas(Frames, Protocol):
    """What the bounds are made from: the formulas of the poses and of each dyad, by its place among the elements."""

    graph: ExpressionGraph
    poses: dict[str, PoseFormula]
    joints: dict[int, Joints[Vec, Real]]
    groups: dict[int, DyadSolution[Vec, Real]]

    def at_rest(self, place: Vec | complex, direction: Vec | complex) -> PoseFormula:
        """Axes that do not move."""

    def ratio(self, rolled: Rolled, coordinate: Coordinate) -> Real:
        """By how much what rolls goes as one of the angles and travels that it follows."""


class ErrorFormulas:
    """The error bounds of a program of dyads, made as they are asked for."""

    def __init__(self, program: Formulas) -> None:
        self.program, self.structure, self.graph = program, program.structure, program.graph
        self.unit = self.graph.param(("unit",))
        zero = self.graph.const(0)
        self._errors = {self.structure.scene.frame.name: FrameError(zero, zero, zero, zero, zero, zero)}
        self._rest = program.at_rest(0j, 1 + 0j)

    def __call__(self, links: Iterable[str]) -> FrameError:
        """How far rounding may have moved any point of these links and their turning."""
        most: FrameError | None = None
        for link in links:
            own = self.of_link(link)
            most = FrameError(*(fmax(a, b) for a, b in zip(own, most, strict=True))) if most else own
        return most or FrameError(*(self.graph.const(0),) * 6)

    def of_link(self, link: str) -> FrameError:
        """The same for one link."""
        pose = self.program.poses[link]
        r = self.graph.param(("reach", link))
        for slide in self.structure.slides:
            # the coincident point under what slides on this link
            if slide.b == link and slide.a in self.program.poses:
                away = self.program.poses[slide.a].z - pose.z
                r = fmax(abs(away.real) + abs(away.imag), r)
        spin, bend = abs(pose.omega), abs(pose.alpha) + pose.omega * pose.omega
        place, speed, push = (abs(x.real) + abs(x.imag) for x in (pose.z, pose.v, pose.a))
        few = FEW * self.unit
        # what a point of the link adds to its origin, and the roundings of adding it
        found = self._error_of(link).within(r, (place, speed, push), spin, bend, few)
        return replace(found, angle=found.angle + few)

    def under(self, link: str, own: FrameError, arm: Vec, moved: Real) -> tuple[Real, Real]:
        """Velocity and acceleration of the point of a link at the end of an arm, from the bounds of its own points; the
        end may be off by ``moved``."""
        omega, alpha = own.omega, own.alpha
        pose, far = self.program.poses[link], abs(arm.real) + abs(arm.imag)
        spin, turning = abs(pose.omega) + omega, abs(pose.alpha) + alpha
        off = moved + own.position + 8.0 * self.unit * far
        # |d(w r)| <= dw r + w dr, and the same with the square of w beside alpha
        return (
            own.velocity + far * omega + spin * off,
            own.acceleration + far * (alpha + 2.0 * (spin * omega)) + (turning + spin * spin) * off,
        )

    def _error_of(self, link: str) -> FrameError:
        """How far a link may be off: by what it inherits from the links it hangs on, and by its own rounding."""
        if link not in self._errors:
            i = next(k for k, e in enumerate(self.structure.elements) if link in e.members)
            self._errors.update(self._errors_of(i, self.structure.elements[i]))
        return self._errors[link]

    def _errors_of(self, i: int, element: Element) -> dict[str, FrameError]:
        assert isinstance(element, Driven | Dyad)  # larger groups: graphkin.solver.group_errors
        bases = _bases(element)
        inherited = self._driven_error(element) if isinstance(element, Driven) else self._dyad_errors(i, element)
        rounding = Rounding(self.graph, self.error_of, self.unit, self._given(bases))
        return {name: error + self._own(self.program.poses[name], rounding) for name, error in inherited.items()}

    def _given(self, links: Iterable[str]) -> set[int]:
        """The lines of the poses of links, but for numbers of the scene, which others may share."""
        found: set[int] = set()
        for link in links:
            for part in FIELDS:
                z = getattr(self.program.poses[link], part)
                found |= {x.at for x in ((z.real, z.imag) if isinstance(z, Vec) else (z,))}
        lines = self.graph.lines
        return {k for k in found if lines[k][0] != "param" or lines[k][1][0] in ("rate", "second")}

    @staticmethod
    def _own(pose: PoseFormula, rounding: Rounding) -> FrameError:
        def of(z: Real | Vec) -> Real:
            if isinstance(z, Real):
                return rounding.of(z)
            x, y = rounding.of(z.real), rounding.of(z.imag)
            return root(x * x + y * y)

        z, u, v, omega, a, alpha = (of(getattr(pose, part)) for part in FIELDS)
        return FrameError(z, v, a, u, omega, alpha)

    def _at(self, pair: Pair, base: str) -> FrameError:
        """The error of a joint's frame on a known link."""
        at = self.program.rest(pair, base)
        return carried(self._error_of(base), self.program.poses[base], within(self._rest, at))

    def _driven_error(self, element: Driven) -> dict[str, FrameError]:
        pair, link, driver = element.pair, element.link, element.driver
        base = _base(pair, [link])
        if isinstance(driver, LawCam):
            error, pose = self._follower_error(driver, self._at(pair, base)), self.program.poses[link]
            return {link: carried(error, pose, within(self._rest, self.program.rest(pair, link)))}
        if isinstance(driver, Rolled):
            error, pose = self._rolled_error(driver, self._at(pair, base)), self.program.poses[link]
            return {link: carried(error, pose, within(self._rest, self.program.rest(pair, link)))}
        joint, pose = self._at(pair, base), self.program.poses[link]
        mine = self.program.rest(pair, link)
        turning = joint
        if driver.turns:
            other = driver.relative_to if driver.link == link else driver.link
            turning = joint.turning_as(*self._error_of(other).of_turning)
        else:
            at = self.program.rest(pair, base)
            guide = self.program.poses[base].fixed(at.z, at.u)
            turning = carried(joint, guide, seen(guide, pose.of(mine)))
        return {link: carried(turning, pose, within(self._rest, mine))}

    def _follower_error(self, cam: LawCam, joint: FrameError) -> FrameError:
        """What a follower has from its joint, and by its law from the cam's own turning."""
        turn, off = self.program.poses[cam.link], self._error_of(cam.link)
        _, slope, bend = self.program.lift(cam)
        jerk, spin = self.graph.param(("lift", cam.link, "jerk")), abs(turn.omega)
        slope, bend = abs(slope), abs(bend)
        moved = slope * off.angle
        rate = slope * off.omega + bend * (spin * off.angle)
        second = (slope * off.alpha + bend * (2.0 * (spin * off.omega) + abs(turn.alpha) * off.angle)
                  + jerk * (spin * spin * off.angle))  # fmt: skip
        if isinstance(cam.motion, SlidingFollower):
            return replace(joint, position=joint.position + moved, velocity=joint.velocity + rate,
                           acceleration=joint.acceleration + second)  # fmt: skip
        return joint.turning_as(moved, rate, second)

    def _rolled_error(self, rolled: Rolled, joint: FrameError) -> FrameError:
        """What a link that rolls has from its joint, and from what it rolls on, there and in the scene's position."""
        zero = self.graph.const(0)
        moved, rate, second = zero, zero, zero
        for (kind, name), _ in rolled.factors:
            own = self.of_link(name) if kind == "angle" else self.of_link(self.structure.slide(name).a)
            base = None if kind == "angle" else self.of_link(self.structure.slide(name).b)
            one = own.of_turning
            if base is not None:
                one = own.position + base.position, own.velocity + base.velocity, own.acceleration + base.acceleration
            by = abs(self.program.ratio(rolled, (kind, name)))
            moved, rate, second = moved + 2.0 * by * one[0], rate + by * one[1], second + by * one[2]
        if rolled.turns:
            return joint.turning_as(moved, rate, second)
        return replace(joint, position=joint.position + moved, velocity=joint.velocity + rate,
                       acceleration=joint.acceleration + second)  # fmt: skip

    def _dyad_errors(self, i: int, element: Dyad) -> dict[str, FrameError]:
        shapes = tuple(body_shape(self.program, body, self._rest) for body in element.bodies)
        outer = element.outer_first, element.outer_second
        known = [self._at(pair, _base(pair, shape)) for pair, shape in zip(outer, shapes, strict=True)]
        errors = of_dyad(element.kind, self.program.joints[i], self.program.groups[i], known[0], known[1])
        found: dict[str, FrameError] = {}
        for body, shape, error in zip(element.bodies, shapes, errors, strict=True):
            pose = self.program.poses[body.links[0]]
            found |= {name: carried(error, pose, within(self._rest, inner)) for name, inner in shape.items()}
        return found

    def error_of(self, x: Real) -> Real:
        """How far a number that is given may be off."""
        name = x.line[1]
        if name[0] in ("size", "sign", "unit", "reach"):
            return self.graph.const(0)
        if name[0] in ("cos", "sin"):
            return self.graph.param(("error", "angle", name[1]))
        if name[0] in ("lift", "rolled"):
            return self.graph.param(("error", *name))
        if name[0] == "travel":
            return self.graph.param(("error", *name))
        return self.graph.param(("error", *(name[:-1] if name[-1] in ("x", "y") else name)))


def _base(pair: Pair, inside: Iterable[str]) -> str:
    """The link of a joint that is not one of these."""
    return pair.b if pair.a in inside else pair.a


def _bases(element: Driven | Dyad) -> list[str]:
    """The known links that an element hangs on."""
    if isinstance(element, Driven):
        return [_base(element.pair, element.links), *(n for n in element.driver.links if n != element.link)]
    bodies = zip(element.outer, element.bodies, strict=True)
    return [_base(pair, body.links) for pair, body in bodies]
