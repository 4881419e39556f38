"""Velocities and accelerations of any place of a link, off its image in the drawn polygons (Mehmke)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from graphkin.construction.forces.joints import BalanceForm
from graphkin.construction.sheet import Sheet
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import dot
from graphkin.scene.symbol import PointRef
from graphkin.structure import Slide
from graphkin.words import Phrase

__all__ = ["Images"]


@dataclass(frozen=True)
class Images:
    """The images of all links of a sheet."""

    sheet: Sheet

    @cached_property
    def mm(self) -> float:
        """Of paper for one m of the mechanism."""
        return 1.0 / self.sheet.scales.length

    def place(self, link: str, at: complex) -> complex:
        """A place of a link's own axes (m), on paper (mm)."""
        pose = self.sheet.poses[link]
        return pose.place(at * self.mm)

    def point(self, link: str, point: str) -> complex:
        """A point of a link, where it was pricked (mm)."""
        drawn = self.sheet.points.get(PointRef(point))
        return self.place(link, self.sheet.structure.links[link].points[point]) if drawn is None else drawn

    def foot(self, slide: Slide) -> complex:
        """Where the force of a sliding pair acts: the sliding link's first point, or its origin (mm)."""
        return self.point(slide.a, slide.pin) if slide.pin else self.sheet.poses[slide.a].origin

    def along(self, slide: Slide) -> complex:
        """The direction of a guide."""
        return self.sheet.poses[slide.b].axis * slide.guide.direction

    def of_balance(self, balance: BalanceForm) -> tuple[complex, complex]:
        """The direction of a balancing force, and where it acts (mm)."""
        if balance.slide:
            slide = self.sheet.structure.slide(balance.slide)
            return self.along(slide), self.foot(slide)
        along = 1j * self.sheet.poses[balance.link].axis if balance.square else balance.along
        return along, self.place(balance.link, balance.at)

    def velocity(self, link: str, at: complex) -> complex:
        """The end point of the velocity of the point of a link that lies at a place of the mechanism (mm)."""
        return self._end("velocity", link, at)

    def acceleration(self, link: str, at: complex) -> complex:
        """The end point of its acceleration (mm)."""
        return self._end("acceleration", link, at)

    def slip(self, slide: Slide) -> tuple[float, float]:
        """The sliding velocity along the guide, and the greatest speed that leads to it (m/s)."""
        at = self.foot(slide)
        a, b = self.velocity(slide.a, at), self.velocity(slide.b, at)
        most = max(abs(a), abs(b), *(abs(z) for z in self.sheet.ends["velocity"].values()))
        return dot(a - b, self.along(slide)) * self.sheet.scales.velocity, most * self.sheet.scales.velocity

    def image(self, order: str, link: str) -> tuple[tuple[complex, complex], tuple[complex, complex]] | None:
        """Two points of a link that lie farthest apart, each with its end point; None where it has no two."""
        known = self._known(order, link)
        far = max(((p, q) for p in known for q in known), key=lambda both: abs(both[0][0] - both[1][0]), default=None)
        return far if far is not None and abs(far[0][0] - far[1][0]) > self._tiny else None

    @cached_property
    def _tiny(self) -> float:
        return 1e-9 * self.sheet.scene.size * self.mm

    def _known(self, order: str, link: str) -> list[tuple[complex, complex]]:
        """Points of a link that have an end point: place on the mechanism and end (mm)."""
        own = self.sheet.structure.links[link].points
        return [
            (self.sheet.points[PointRef(ref.point)], end)
            for ref, end in self.sheet.ends[order].items()
            if PointRef(ref.point) in self.sheet.points and (ref.link == link or (not ref.link and ref.point in own))
        ]

    def _end(self, order: str, link: str, at: complex) -> complex:
        if link == self.sheet.scene.frame.name:
            return 0j
        known = self._known(order, link)
        if not known:
            raise Unsolvable(
                "not drawn", Problem(Phrase("link of name", name=link), Phrase("no point of it stands in the polygons"))
            )
        start, end = min(known, key=lambda one: abs(one[0] - at))
        if abs(start - at) <= self._tiny:
            return end
        far = self.image(order, link)
        if far is not None:
            (a, a_end), (b, b_end) = far
            return a_end + (b_end - a_end) * ((at - a) / (b - a))
        return end + self._by_rates(order, link, at - start)

    def _by_rates(self, order: str, link: str, arm: complex) -> complex:
        scales, omega = self.sheet.scales, self.sheet.omega[link].value
        if order == "velocity":
            return 1j * omega * arm * (scales.length / scales.velocity)
        return (1j * self.sheet.alpha[link].value - omega**2) * arm * (scales.length / scales.acceleration)
