"""The two directions between which the transmission angle of a joint lies.

It is the acute angle between the two paths on which the inner joint of a group can move as a point of either link
(Hall, Kinematics and Linkage Design; Norton, Design of Machinery, ch. 3; 孙桓 《机械原理》, ch. 8):

- RRR: between coupler and rocker, at their common pin
- RRP: between rod and the normal of the guide
- RPR: between the normal of the guide and the line of the two outer pivots; 90 degrees where the guide passes
  through both, as in most guide-bar mechanisms and swinging blocks
- PRP, RPP: between the two guides

At a sliding contact the force acts along the common normal, on the link's point at the contact.

The pressure angle, between the force that drives a link and the velocity of its point, is its complement to 90 degrees.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from graphkin.errors import CallError
from graphkin.scene.model import PlacedLink
from graphkin.scene.pairs import HigherPair, Pair
from graphkin.scene.symbol import Symbol
from graphkin.structure.model import Dyad, Structure
from graphkin.words import Phrase, listed

Spot = tuple[str, complex]
"""A link, and a place in its own axes (m)."""
Way = tuple[Spot, Spot]
"""A direction: from one place to the other."""


@dataclass(frozen=True, eq=False, repr=False)
class TransmissionAngle:
    """Two directions; where they are ``square``, the angle is measured from the first to the normal of the second."""

    first: Way
    second: Way
    square: bool = False

    def directions(self, place: Callable[[str, complex], complex]) -> tuple[complex, complex]:
        """The two directions between which the angle lies; ``place`` gives places of links (link, m in its axes)."""
        first, second = (place(*end) - place(*start) for start, end in (self.first, self.second))
        return first, second * (1j if self.square else 1.0)


def _guide(slide: Pair) -> Way:
    return (slide.b, 0j), (slide.b, slide.guide.direction)


def _spot(structure: Structure, turn: Pair) -> Spot:
    return turn.a, structure.links[turn.a].points[turn.point]


def joint_of_dyad(structure: Structure, dyad: Dyad) -> TransmissionAngle:
    """The joint of a group of two links; where one of them replaces a sliding contact, the contact itself."""
    for pair in structure.scene.higher_pairs:
        if pair.replaced and any(pair.block in body.links for body in dyad.bodies):
            moved = [n for body in dyad.bodies for n in body.links if n in pair.bodies]
            joint = _at_contact(structure, pair, moved[0]) if moved else None
            if joint is not None:
                return joint
    inner, outer_first, outer_second = dyad.inner, dyad.outer_first, dyad.outer_second
    if inner.turns:
        here = _spot(structure, inner)
        first, second = (
            (_spot(structure, pair), here) if pair.turns else _guide(pair) for pair in (outer_first, outer_second)
        )
        return TransmissionAngle(first, second, outer_first.turns != outer_second.turns)
    if outer_first.turns and outer_second.turns:
        return TransmissionAngle(_guide(inner), (_spot(structure, outer_second), _spot(structure, outer_first)), True)
    other = outer_first if outer_second.turns else outer_second
    return TransmissionAngle(_guide(inner), _guide(other))


def joint_between(structure: Structure, a: str, b: str, symbol: Symbol) -> TransmissionAngle:
    """The joint that two links share.  Raises CallError where they share none that has a transmission angle."""
    for dyad in structure.dyads.values():
        first, second = ({*body.links, *map(structure.scene.body_of, body.links)} for body in dyad.bodies)
        if (a in first and b in second) or (b in first and a in second):
            return joint_of_dyad(structure, dyad)
    links = {**structure.scene.by_name, **structure.links}  # redundant ones too
    for point in (p for p in links[a].points if p in links[b].points):
        first_arm, second_arm = (_arm(structure, links[name], point) for name in (a, b))
        if first_arm and second_arm:
            return TransmissionAngle(first_arm, second_arm)
    raise CallError.of(str(symbol), "links and share no joint at which a", "name two links of one joint bars or",
                       name=a, other=b)


def _arm(structure: Structure, link: PlacedLink, point: str) -> Way | None:
    """The path's normal of a point of a link: along its bar, or square to the guide on which it slides."""
    others = [p for p in (*link.bar, *link.points) if p != point and link.points[p] != link.points[point]]
    if others:
        return (link.name, link.points[others[0]]), (link.name, link.points[point])
    slide = next((s for s in (*structure.slides, *structure.scene.slidings) if s.a == link.name), None)
    return ((slide.b, 0j), (slide.b, 1j * slide.guide.direction)) if slide else None


def joint_of_follower(structure: Structure, name: str, symbol: Symbol) -> TransmissionAngle:
    """The joint through which a link is driven, a sliding contact first.  Raises CallError where no joint can be
    named."""
    for pair in structure.scene.higher_pairs:
        joint = _at_contact(structure, pair, name) if pair.replaced and name in pair.bodies else None
        if joint is not None:
            return joint
    for dyad in structure.dyads.values():
        if name in dyad.members:
            return joint_of_dyad(structure, dyad)
    members = {n for group in structure.larger_groups if name in group.links for n in group.links}
    # in a larger group: by a bar of two joints, which passes a force on along itself
    for bar in (link for link in structure.scene.links if link.name in members - {name}):
        ends = [p for p in bar.points if len(structure.scene.holders[p]) > 1]
        if len(ends) != 2 or bar.points[ends[0]] == bar.points[ends[1]]:
            continue
        for point, far in (ends, ends[::-1]):
            points = structure.links[name].points
            if point in points and far not in points and structure.scene.frame.name not in structure.scene.holders[far]:
                line = (bar.name, bar.points[far]), (bar.name, bar.points[point])
                joint = _pushed(structure, name, line, (name, points[point]))
                if joint is not None:
                    return joint
    raise CallError.of(str(symbol), "link is driven through no joint of a", "name a follower", name=name)


def _at_contact(structure: Structure, pair: HigherPair, name: str) -> TransmissionAngle | None:
    """The directions at a contact: a link is pushed along the common normal, on which all points of the bar or the
    block lie that replaces it."""
    block = pair.block
    if block not in structure.links or name not in structure.links:
        return None
    points = structure.links[block].points
    start, end, *_ = points.values()
    return _pushed(structure, name, ((block, start), (block, end)), (block, points[pair.name]))


def _pushed(structure: Structure, name: str, line: Way, at: Spot) -> TransmissionAngle | None:
    """Between the line along which a link is pushed at a place and the normal of its velocity there: square to a guide
    of the frame on which it slides, or along the line to its fixed pivot."""
    frame, points = structure.scene.frame, structure.links[name].points
    slide = next((s for s in structure.slides if s.a == name and s.b == frame.name and not s.higher), None)
    if slide is not None:
        return TransmissionAngle(line, _guide(slide), True)
    pivot = next(((name, z) for p, z in points.items() if p in frame.points and (name, z) != at), None)
    return None if pivot is None else TransmissionAngle(line, (pivot, at))


def sliding_pair(slides: Sequence[Pair], symbol: Symbol) -> Pair:
    """The sliding pair or pin in slot, of several, that a symbol names.  Raises CallError where there is none."""
    named = next((pair for pair in slides if pair.key == symbol.pair), None)
    if named is None:
        known = [pair.key for pair in slides]
        wanted = Phrase("known here", names=listed(known)) if known else Phrase("nothing slides here")
        raise CallError.of(str(symbol), "there is no such sliding pair", wanted)
    return named
