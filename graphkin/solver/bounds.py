"""How far every link may be off: its own rounding, and what it inherits from the links it hangs on; as formulas."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from graphkin.scene.model import AngleDriver
from graphkin.solver.expressions import Real, Vec, fmax, root
from graphkin.solver.frame_errors import Doubt, carried, of_dyad, seen, within
from graphkin.solver.joints import body_shape
from graphkin.solver.pose import Pose
from graphkin.solver.rounding import Rounding
from graphkin.structure import Driven, Dyad, Element, Pair, links_of

if TYPE_CHECKING:
    from graphkin.solver.program import Program

__all__ = ["FIELDS", "LinkBounds"]

FIELDS = ("z", "u", "v", "omega", "a", "alpha")
FEW = 3.0
"""Roundings in adding a point to the origin of its link."""


class LinkBounds:
    """The bounds of a program of dyads, made as they are asked for."""

    def __init__(self, program: Program) -> None:
        self.program, self.structure, self.graph = program, program.structure, program.graph
        self.unit = self.graph.param(("unit",))
        zero = self.graph.const(0)
        self._doubts = {self.structure.scene.frame.name: Doubt(zero, zero, zero, zero, zero, zero)}
        self._rest = program.at_rest(0j, 1 + 0j)

    def __call__(self, links: Iterable[str]) -> list[Real]:
        """How far rounding may have moved any point of these links and their turning: position (m), velocity (m/s),
        acceleration (m/s2), angle (rad), its rate (rad/s) and second rate (rad/s2)."""
        most: list[Real] = []
        for link in links:
            own = self.of_link(link)
            most = [fmax(a, b) for a, b in zip(own, most, strict=True)] if most else list(own)
        return most or [self.graph.const(0)] * 6

    def of_link(self, link: str) -> tuple[Real, ...]:
        """The same for one link."""
        pose = self.program.poses[link]
        r = self.graph.param(("reach", link))
        for slide in self.structure.slides:
            # the coincident point under what slides on this link
            if slide.b == link and slide.a in self.program.poses:
                away = self.program.poses[slide.a].z - pose.z
                r = fmax(abs(away.real) + abs(away.imag), r)
        return self._within(link, r)

    def under(self, link: str, own: tuple[Real, ...], arm: Vec, moved: Real) -> tuple[Real, Real]:
        """Velocity and acceleration of the point of a link at the end of an arm, from the bounds of its own points; the
        end may be off by ``moved``."""
        place, speed, push, _, omega, alpha = own
        pose, far = self.program.poses[link], abs(arm.real) + abs(arm.imag)
        spin, turning = abs(pose.omega) + omega, abs(pose.alpha) + alpha
        off = moved + place + 8.0 * self.unit * far
        # |d(w r)| <= dw r + w dr, and the same with the square of w beside alpha
        return (
            speed + far * omega + spin * off,
            push + far * (alpha + 2.0 * (spin * omega)) + (turning + spin * spin) * off,
        )

    def _within(self, link: str, r: Real) -> tuple[Real, ...]:
        """The same for points of a link within a radius."""
        pose = self.program.poses[link]
        doubt = self._doubt(link)
        z, u, v, omega, a, alpha = doubt.z, doubt.u, doubt.v, doubt.omega, doubt.a, doubt.alpha
        spin, bend = abs(pose.omega), abs(pose.alpha) + pose.omega * pose.omega
        place = abs(pose.z.real) + abs(pose.z.imag) + r
        speed = abs(pose.v.real) + abs(pose.v.imag) + spin * r
        push = abs(pose.a.real) + abs(pose.a.imag) + bend * r
        few = FEW * self.unit
        # what a point of the link adds to its origin, and the roundings of adding it
        return (
            z + r * u + few * place,
            v + r * (omega + spin * u) + few * speed,
            a + r * (alpha + bend * u + (2.0 * spin + omega) * omega) + few * push,
            u + few,
            omega,
            alpha,
        )

    def _doubt(self, link: str) -> Doubt:
        """How far a link may be off: by what it inherits from the links it hangs on, and by its own rounding."""
        if link not in self._doubts:
            i = next(k for k, e in enumerate(self.structure.elements) if link in links_of(e))
            self._doubts.update(self._doubts_of(i, self.structure.elements[i]))
        return self._doubts[link]

    def _doubts_of(self, i: int, element: Element) -> dict[str, Doubt]:
        assert isinstance(element, Driven | Dyad)  # larger groups: graphkin.solver.group_errors
        bases = _bases(element)
        inherited = self._driven_doubt(element) if isinstance(element, Driven) else self._dyad_doubts(i, element)
        rounding = Rounding(self.graph, self._error, self.unit, self._given(bases))
        return {name: doubt + self._own(self.program.poses[name], rounding) for name, doubt in inherited.items()}

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
    def _own(pose: Pose, rounding: Rounding) -> Doubt:
        def of(z: Any) -> Real:
            if isinstance(z, Real):
                return rounding.of(z)
            x, y = rounding.of(z.real), rounding.of(z.imag)
            far: Real = root(x * x + y * y)
            return far

        return Doubt(*(of(getattr(pose, part)) for part in FIELDS))

    def _at(self, pair: Pair, base: str) -> Doubt:
        """The doubt of a joint's frame on a known link."""
        at = self.program.rest(pair, base)
        return carried(self._doubt(base), self.program.poses[base], within(self._rest, at))

    def _driven_doubt(self, element: Driven) -> dict[str, Doubt]:
        pair, link, driver = element.pair, element.link, element.driver
        base = _base(pair, [link])
        joint, pose = self._at(pair, base), self.program.poses[link]
        mine = self.program.rest(pair, link)
        turning = joint
        if isinstance(driver, AngleDriver):
            turning = joint.turning_as(self._doubt(driver.relative_to if driver.link == link else driver.link))
        else:
            at = self.program.rest(pair, base)
            guide = self.program.poses[base].fixed(at.z, at.u)
            turning = carried(joint, guide, seen(guide, pose.of(mine)))
        return {link: carried(turning, pose, within(self._rest, mine))}

    def _dyad_doubts(self, i: int, element: Dyad) -> dict[str, Doubt]:
        shapes = tuple(body_shape(self.program, body, self._rest) for body in element.bodies)
        outer = element.outer_first, element.outer_second
        known = [self._at(pair, _base(pair, shape)) for pair, shape in zip(outer, shapes, strict=True)]
        doubts = of_dyad(element.kind, self.program.joints[i], self.program.groups[i], known[0], known[1])
        found: dict[str, Doubt] = {}
        for body, shape, doubt in zip(element.bodies, shapes, doubts, strict=True):
            pose = self.program.poses[body.links[0]]
            found |= {name: carried(doubt, pose, within(self._rest, inner)) for name, inner in shape.items()}
        return found

    def _error(self, x: Real) -> Real:
        name = x.line[1]
        if name[0] in ("size", "sign", "unit", "reach"):
            return self.graph.const(0)
        if name[0] in ("cos", "sin"):
            return self.graph.param(("error", "angle", name[1]))
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
        if isinstance(element.driver, AngleDriver):
            found += [n for n in (element.driver.link, element.driver.relative_to) if n != element.link]
        return found
    bodies = zip((element.outer_first, element.outer_second), element.bodies, strict=True)
    return [_base(pair, body.links) for pair, body in bodies]
