"""Links cut free, group by group: what acts on them, moments with arms measured on the mechanism, polygons.

Forces are complex numbers in N while they are found; each is taken off the polygon in which it was drawn.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from graphkin.construction.forces.force_sheet import (
    Acting,
    Arm,
    ForceVector,
    KnownMoment,
    MomentEquation,
    MomentTerm,
)
from graphkin.construction.forces.joints import Images, JointNames, opposite
from graphkin.construction.instruments import Instrument
from graphkin.construction.steps import Direction, Part
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import added_up, cross, cross_lines, dot, unit
from graphkin.scene.symbol import Symbol
from graphkin.structure import Pair
from graphkin.words import Phrase

__all__ = ["NORMAL", "TANGENT", "Chain", "CutFree", "across", "dead_point", "end_of", "guide_letters"]

NORMAL, TANGENT = "n-n", "t-t"
"""The common normal and tangent of what touches, by name as a guide."""

PARALLEL = 1e-12


def dead_point(links: Sequence[str]) -> Unsolvable:
    """What is said where the lines that should close a polygon are parallel."""
    found = Phrase("the balance does no work in this position or")
    return Unsolvable(
        "dead point",
        Problem(Phrase("links", links=", ".join(links)), found, Phrase("move the driver off this position")),
    )


Chain = list[ForceVector]
"""Vectors of a polygon laid head to tail, from the origin on."""


def end_of(chain: Chain) -> complex:
    """Where the next vector of a polygon begins (mm)."""
    return chain[-1].tip if chain else 0j


@dataclass
class CutFree:
    """What is known of all links while their forces are found; the last group comes first.

    ``pins`` are the forces of pins on links, ``slides`` force and couple of each guiding link on its sliding one,
    ``done`` the links whose forces are known.
    """

    images: Images
    hand: Instrument
    per_mm: float
    names: JointNames
    forces: dict[str, list[Acting]]
    moments: dict[str, list[KnownMoment]]
    pins: dict[tuple[str, str], complex] = field(default_factory=lambda: defaultdict(complex))
    slides: dict[str, tuple[complex, float]] = field(default_factory=dict)
    balances: dict[Symbol, complex | float] = field(default_factory=dict)
    done: set[str] = field(default_factory=set)

    # -- what acts -----------------------------------------------------------------------------------------------------

    def push(self, one: Acting) -> None:
        self.forces.setdefault(one.link, []).append(one)

    def turn(self, one: KnownMoment) -> None:
        self.moments.setdefault(one.link, []).append(one)

    def load_pins(self, members: Iterable[str]) -> None:
        """Links found before hang on pins of these: what they do there acts on the first that has the pin."""
        inside = set(members)
        for point, holders in self.names.structure.hinges.items():
            mine = [n for n in holders if n in inside]
            others = [n for n in holders if n not in inside]
            if not mine or not others or any(n not in self.done for n in others):
                continue
            carrier, at = mine[0], self.images.point(mine[0], point)
            real = self.names.holders[point]
            if len(holders) == 2 or carrier == real[0]:
                for other in others:
                    symbol = opposite(self.names.of_pin(point, other))
                    self.push(Acting(symbol, carrier, -self.pins[point, other], at))
                    self.pins[point, carrier] -= self.pins[point, other]
            else:
                whole = -added_up((self.pins[point, other] for other in others), 0j)
                self.push(Acting(Symbol("F", link=point, other=carrier), carrier, whole, at))
                self.pins[point, carrier] += whole

    def set_pin(self, point: str, link: str, force: complex) -> None:
        """The force of a pin on a link, besides what hangs on it."""
        self.pins[point, link] += force

    def set_slide(self, slide: Pair, force: complex, couple: float, inside: Iterable[str]) -> None:
        """Force and couple of a sliding pair on the sliding link; they load the other link, if it comes later."""
        self.slides[slide.key] = force, couple
        symbol, turned, at = self.names.of_slide(slide), self.names.of_slide(slide, "M"), self.images.foot(slide)
        for link, sign in ((slide.a, 1.0), (slide.b, -1.0)):
            if link in inside or link == self.names.structure.scene.frame.name:
                continue
            named = (symbol, turned) if sign > 0 else (opposite(symbol), opposite(turned))
            self.push(Acting(named[0], link, sign * force, at))
            if couple:
                self.turn(KnownMoment(named[1], link, sign * couple))

    def forces_on(self, links: Iterable[str]) -> list[Acting]:
        """Known forces on some links, those of no size left out."""
        return [one for link in links for one in self.forces.get(link, ()) if one.force]

    def moments_on(self, links: Iterable[str]) -> list[KnownMoment]:
        return [one for link in links for one in self.moments.get(link, ()) if one.moment]

    # -- moments -------------------------------------------------------------------------------------------------------

    def arm(self, at: complex, about: complex, force: complex) -> Arm:
        """The arm of a force about a point, measured on the mechanism."""
        along = unit(force)
        mm = cross(at - about, along)
        foot = about - 1j * along * mm
        if abs(mm) < 1e-12 * self.size:
            return Arm(about, foot, 0.0)
        read = self.hand.read(abs(mm))
        return Arm(about, foot, read if mm > 0 else -read)

    @property
    def size(self) -> float:
        """The mechanism, in mm on paper."""
        return self.images.sheet.scene.size * self.images.mm

    def term(self, one: Acting, about: complex, part: Part = "") -> MomentTerm:
        arm = self.arm(one.at, about, one.force)
        size = abs(one.force)
        return MomentTerm(one.symbol, part, size, arm, size * arm.mm / self.images.mm, one.turned)

    def terms(self, forces: Iterable[Acting], moments: Iterable[KnownMoment], about: complex) -> list[MomentTerm]:
        found = [self.term(one, about) for one in forces]
        return found + [MomentTerm(m.symbol, "", m.moment, None, m.moment, m.turned) for m in moments]

    def by_moments(
        self, links: Sequence[str], about: complex, letter: str, unknown: Acting, part: Part,
        more: Sequence[Acting] = (),
    ) -> MomentEquation:  # fmt: skip
        """The size of a force of known line from the moments of all that acts on some links.

        Parameters
        ----------
        unknown : the force, of size 1
        more : forces found already that are not yet among the known
        """
        arm = self.arm(unknown.at, about, unknown.force)
        if abs(arm.mm) <= PARALLEL * self.size:
            raise dead_point(links)
        terms = self.terms([*self.forces_on(links), *(m for m in more if m.force)], self.moments_on(links), about)
        value = -added_up(t.moment for t in terms) / (arm.mm / self.images.mm)
        return MomentEquation(tuple(links), letter, tuple(terms), unknown.symbol, part, arm, value, unknown.force)

    def couple(
        self, links: Sequence[str], about: complex, letter: str, symbol: Symbol, more: Sequence[Acting] = (),
        turning: Sequence[KnownMoment] = (),
    ) -> MomentEquation:  # fmt: skip
        """The couple that is left of the moments of all that acts on some links."""
        forces = [*self.forces_on(links), *(m for m in more if m.force)]
        terms = self.terms(forces, [*self.moments_on(links), *turning], about)
        value = -added_up(t.moment for t in terms)
        # what is left of terms that cancel is rounding
        if abs(value) <= 1e-13 * added_up(abs(t.moment) for t in terms):
            value = 0.0
        return MomentEquation(tuple(links), letter, tuple(terms), symbol, "", None, value)

    # -- polygons ------------------------------------------------------------------------------------------------------

    def lay(self, chain: Chain, one: Acting, part: Part = "", known: bool = True) -> complex:
        """Lay off a force head to tail; what it is then in N."""
        mm = abs(one.force) / self.per_mm
        tail = tip = end_of(chain)
        if mm > 0.0:
            tip = self.hand.point(tail + self.hand.direction(unit(one.force)) * self.hand.length(mm))
        chain.append(ForceVector(one.symbol, part, one.link, one.at, tail, tip, known, one.turned))
        return (tip - tail) * self.per_mm

    def lay_known(self, chain: Chain, links: Iterable[str]) -> None:
        for one in self.forces_on(links):
            self.lay(chain, one)

    def closing(self, links: Sequence[str], end: complex, along: complex, start: complex, back: complex) -> complex:
        """Where a polygon closes: on the line from its end along one direction, and on that from its start."""
        d, e = self.hand.direction(along), self.hand.direction(back)
        if abs(cross(d, e)) < PARALLEL:
            raise dead_point(links)
        at = cross_lines(end, d, start, e)
        assert at is not None
        return self.hand.point(at)

    def drawn(
        self, symbol: Symbol, link: str, at: complex, tail: complex, tip: complex, part: Part = ""
    ) -> ForceVector:
        """A force found by its ends."""
        return ForceVector(symbol, part, link, at, tail, tip, False)

    def projected(self, forces: Sequence[Acting], along: complex) -> float:
        """Part of some known forces along a direction (N), laid off and projected."""
        chain: Chain = []
        for one in forces:
            self.lay(chain, one)
        return dot(end_of(chain), along) * self.per_mm


def across(pair: Pair) -> Direction:
    """The direction of a sliding pair's force: square to the guide; of what touches along the normal, or the tangent of
    pitch circles."""
    other = {NORMAL: TANGENT, TANGENT: NORMAL}.get(pair.guide.name.rstrip("'"))
    return Direction("square", guide_letters(pair)) if other is None else Direction("along", (other,))


def guide_letters(pair: Pair) -> tuple[str, ...]:
    """A guide as its direction is written."""
    return (pair.guide.name or f"x{pair.b}",)
