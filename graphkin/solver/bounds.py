"""How far every link may be off: its own rounding, and what it inherits from the links it hangs on; as formulas."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Protocol

from graphkin.scene.cams import LawCam, SlidingFollower
from graphkin.scene.model import AngleDriver
from graphkin.solver.dyads import DyadSolution, Joints
from graphkin.solver.expressions import ExpressionGraph, PoseFormula, Real, Vec, fmax, root
from graphkin.solver.frame_errors import FrameError, carried, of_dyad, seen, within
from graphkin.solver.joints import Frames, body_shape
from graphkin.solver.pose import FIELDS
from graphkin.solver.rounding import Rounding
from graphkin.structure import Driven, Dyad, Element, Pair, Rolled, links_of
from graphkin.structure.model import Coordinate

__all__ = ["ErrorFormulas"]

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
            i = next(k for k, e in enumerate(self.structure.elements) if link in links_of(e))
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
        if isinstance(driver, AngleDriver):
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
        found = [_base(element.pair, [element.link])]
        if isinstance(element.driver, LawCam):
            return [*found, element.driver.link]
        if isinstance(element.driver, Rolled):
            return [*found, *(n for n in element.driver.links if n != element.link)]
        if isinstance(element.driver, AngleDriver):
            found += [n for n in (element.driver.link, element.driver.relative_to) if n != element.link]
        return found
    bodies = zip((element.outer_first, element.outer_second), element.bodies, strict=True)
    return [_base(pair, body.links) for pair, body in bodies]
