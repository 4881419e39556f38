"""A body of a group with its outer pair, and what is drawn of the group as it grows."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from graphkin.construction.forces.cut_free import CutFree, HeadToTail
from graphkin.construction.forces.force_sheet import (
    Acting,
    ForceGroup,
    ForceLine,
    ForceTerm,
    ForceVector,
    KnownMoment,
    MomentEquation,
    Part,
)
from graphkin.construction.forces.joints import opposite
from graphkin.construction.sizes import Direction
from graphkin.plane import unit
from graphkin.scene.symbol import Symbol
from graphkin.structure import Body, Pair, Slide, Turn

__all__ = [
    "NORMAL", "TANGENT", "CutBody", "GroupFigure", "across", "along_guide", "foot_name", "line_of_action",
    "outer_couple", "slide_found",
]  # fmt: skip

NORMAL, TANGENT = "n-n", "t-t"
"""The common normal and tangent of what touches, by name as a guide."""


@dataclass
class CutBody:
    """A body of a dyad with its outer pair."""

    cut: CutFree
    body: Body
    outer: Pair

    @property
    def links(self) -> tuple[str, ...]:
        return self.body.links

    @property
    def name(self) -> str:
        """The link of the body that the outer pair holds."""
        return self.outer.a if self.outer.a in self.body.links else self.outer.b

    @property
    def at(self) -> complex:
        """Where the outer force acts (mm)."""
        if isinstance(self.outer, Slide):
            return self.cut.images.foot(self.outer)
        return self.cut.images.point(self.outer.a, self.outer.point)

    @property
    def symbol(self) -> Symbol:
        """The outer force on the body."""
        if isinstance(self.outer, Turn):
            return self.cut.names.of_pin(self.outer.point, self.outer.a)
        named = self.cut.names.of_slide(self.outer)
        return named if self.outer.a in self.body.links else opposite(named)

    def outer_force(self, force: complex) -> Acting:
        return Acting(self.symbol, self.name, force, self.at)

    def guide(self) -> complex:
        """Direction of the guide of the outer pair."""
        assert isinstance(self.outer, Slide)
        return self.cut.images.along(self.outer)

    def found(self, force: complex) -> None:
        """The outer force on the body is known (of a slide: with its couple later)."""
        if isinstance(self.outer, Turn):
            self.cut.set_pin(self.outer.point, self.outer.a, force)


@dataclass
class GroupFigure:
    """What is drawn of a group, as it grows."""

    moments: list[MomentEquation] = field(default_factory=list)
    terms: list[ForceTerm] = field(default_factory=list)
    chain: HeadToTail = field(default_factory=HeadToTail)
    inner: dict[str, tuple[ForceVector, ...]] = field(default_factory=dict)
    couples: list[MomentEquation] = field(default_factory=list)
    lines: list[ForceLine] = field(default_factory=list)

    def group(self, links: tuple[str, ...], kind: str, polygon: tuple[ForceVector, ...], driver: bool) -> ForceGroup:
        return ForceGroup(
            links, kind, "driver" if driver else "polygon", tuple(self.moments), tuple(self.terms), polygon,
            self.inner, tuple(self.couples), tuple(self.lines),
        )  # fmt: skip

    def unknown(self, one: Acting, part: Part, way: Direction | None) -> None:
        self.terms.append(ForceTerm(one.symbol, part, False, way is not None, way, one.turned))

    def parted(self, one: Acting, bar: tuple[str, str], last: bool = False) -> Part:
        """A force of which moments gave the part square to a bar: its other part is unknown; how that is marked."""
        if not one.force:  # nothing acts on the bar between its ends
            self.unknown(one, "", Direction("along", bar))
            return ""
        square = ForceTerm(one.symbol, "t", True, True, Direction("square", bar))
        self.terms += [square] if last else []
        self.unknown(one, "n", Direction("along", bar))
        self.terms += [] if last else [square]
        return "n"

    def knowns(self, cut: CutFree, links: tuple[str, ...]) -> None:
        self.terms += [ForceTerm(f.symbol, "", True, True, None, f.turned) for f in cut.forces_on(links)]


def across(pair: Pair) -> Direction:
    """The direction of a sliding pair's force: square to the guide; of what touches along the normal, or the tangent of
    pitch circles."""
    assert isinstance(pair, Slide)
    other = {NORMAL: TANGENT, TANGENT: NORMAL}.get(pair.guide.name.rstrip("'"))
    return Direction("square", _guide(pair)) if other is None else Direction("along", (other,))


def along_guide(pair: Pair) -> Direction:
    """The direction of the guide of a sliding pair."""
    assert isinstance(pair, Slide)
    return Direction("along", _guide(pair))


def _guide(pair: Slide) -> tuple[str, ...]:
    return (pair.guide.name or f"x{pair.b}",)


def foot_name(pair: Pair) -> str:
    """The letter of the point where a sliding pair's force acts, or the link at whose origin it does."""
    assert isinstance(pair, Slide)
    return pair.pin or pair.a


def outer_couple(
    cut: CutFree, side: CutBody, force: Acting, about: complex, letter: str, figure: GroupFigure,
    more: tuple[Acting, ...], turning: tuple[KnownMoment, ...] = (),
) -> float:  # fmt: skip
    """The couple of an outer sliding pair on the body, and the line of action of its force."""
    symbol = replace(side.symbol, kind="M")
    found = cut.couple(side.links, about, letter, symbol, (force, *more), turning)
    figure.couples.append(found)
    line_of_action(cut, figure, force, found.value)
    return found.value


def line_of_action(cut: CutFree, figure: GroupFigure, force: Acting, couple: float) -> None:
    """Where a couple puts the line of action of its force."""
    if not force.force:
        return
    shift = couple / abs(force.force)
    at = force.at - 1j * unit(force.force) * (shift * cut.images.mm)
    figure.lines.append(ForceLine(force.symbol, at, unit(force.force), shift))


def slide_found(cut: CutFree, side: CutBody, force: complex, couple: float, inside: tuple[str, ...]) -> None:
    """Force and couple of an outer sliding pair as they act on the body."""
    assert isinstance(side.outer, Slide)
    sign = 1.0 if side.outer.a in side.body.links else -1.0
    cut.set_slide(side.outer, sign * force, sign * couple, inside)
