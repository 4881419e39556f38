"""Quantities by their symbols, from the poses of the links: an entry a kind.

The poses are arrays over positions, or formulas (``graphkin.solver.compiled.program``).  The entries of `VALUES` take
either, except angles at joints (`ANGLES_AT_JOINTS`): a prepared mechanism and a motion have a quantity from the same
line.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Generic

import numpy as np

from graphkin.errors import CallError, did_you_mean
from graphkin.plane import dot
from graphkin.scene.model import PlacedLink
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import PointRef, Symbol, centre_links
from graphkin.solver.algebra.expressions import angle_of, size
from graphkin.solver.algebra.pose import UNIT, Array, ErrorBound, Pose, R, V
from graphkin.structure import Structure
from graphkin.structure.transmission import (
    TransmissionAngle,
    joint_between,
    joint_of_dyad,
    joint_of_follower,
    sliding_pair,
)
from graphkin.words import Phrase


@dataclass(frozen=True, eq=False, repr=False)
class Posed(Generic[V, R]):
    """The links of a structure in their poses, as arrays of shape (n,) or formulas.

    poses : pose of each link by its name
    slides : the sliding pairs and pins in slots
    number : a place or direction of the scene by its name, as in ``Program.number``; None for the scene's own
    """

    structure: Structure
    poses: Mapping[str, Pose[V, R]]
    slides: tuple[Pair, ...]
    number: Callable[..., V] | None = None

    def pose(self, link: str) -> Pose[V, R]:
        """The pose of a link or the block of a pin.  Raises CallError for an unknown name."""
        if link not in self.poses:
            known = did_you_mean(link, self.structure.scene.by_name)
            raise CallError.of(Phrase("link", name=link), "there is no such link", known)
        return self.poses[link]

    def link(self, name: str) -> PlacedLink:
        """A link or the block of a pin."""
        self.pose(name)
        return self.structure.links.get(name) or self.structure.scene.by_name[name]

    def holder(self, point: str) -> str:
        """Of the links with a point the frame, or the first in the order of solution, which is known best; for a point
        of contact the link that replaces the contact."""
        scene = self.structure.scene
        if point in scene.holders:
            placed = [name for name in scene.holders[point] if name in self.structure.links]
            return min(placed or scene.holders[point], key=lambda name: self.structure.place_of.get(name, -1))
        block = next((name for name, link in self.structure.links.items() if point in link.points), None)
        if block is None:
            known = did_you_mean(point, [*scene.holders, *scene.contact_at])
            raise CallError.of(Phrase("point of point", point=point), "there is no such point", known)
        return block

    def is_under(self, ref: PointRef) -> bool:
        """Whether a point is a link's place at another link's pin."""
        return bool(ref.link) and ref.point not in self.link(ref.link).points

    def point(self, ref: PointRef) -> Pose[V, R]:
        """Axes that move with the point's link, with their origin at its point, or at its place at that pin now.

        Without a link the pin itself: the point of any link that has it; for a contact its place, which runs along both
        outlines.
        """
        if self.is_under(ref):
            return self.pose(ref.link).carrying(self.point(PointRef(ref.point)).z)
        link = ref.link or self.holder(ref.point)
        place = self.link(link).points[ref.point]
        return self.pose(link).fixed(self.number("point", link, ref.point) if self.number else place)

    def guide(self, slide: Pair) -> Pose[V, R]:
        """The guide of a sliding pair, its x axis along the guide's sense."""
        if self.number:
            return self.poses[slide.b].fixed(self.number("through", slide.key), self.number("direction", slide.key))
        return self.poses[slide.b].fixed(slide.guide.through, slide.guide.direction)

    def sliding(self, slide: Pair) -> Pose[V, R]:
        """The sliding link seen from its guide: the x axis is along the guide's sense."""
        return self.guide(slide).inverse().of(self.poses[slide.a])

    def travel(self, slide: Pair) -> R:
        """Of a sliding pair, along the guide's sense (m)."""
        guide = self.guide(slide)
        return ((self.poses[slide.a].z - guide.z) * guide.u.conjugate()).real  # type: ignore[no-any-return]


AnyPosed = Posed[Any, Any]
"""Poses as arrays or as formulas."""
PARALLEL = 1e-12
"""A centre at which the mechanism's size over its distance is no more than this lies at infinity, but for rounding."""


def all_slides(structure: Structure) -> tuple[Pair, ...]:
    """The sliding pairs, those of redundant links after the others."""
    have = {s.key for s in structure.slides}
    return structure.slides + tuple(s for s in structure.scene.slidings if s.key not in have)


def value_of_symbol(posed: Posed, symbol: Symbol) -> Array:
    """The value of a quantity of the motion or of the position: complex for vectors, real for others (SI), shape (n,).

    Raises
    ------
    CallError : a symbol that means nothing in this mechanism, or belongs to the whole turn, or is a force
    """
    if symbol.kind in VALUES:
        return np.asarray(_value(posed, symbol))
    if symbol.scope == "force":
        raise CallError.of(str(symbol), "is no motion", "forces stand in solve of a scene with")
    raise CallError.of(str(symbol), "belongs to the whole turn not to one", "ask check audit or sweep")


def formula_of_symbol(posed: AnyPosed, symbol: Symbol) -> Any:
    """The formula of a quantity, from poses that are formulas; None where it has none: an angle at a joint, a force, an
    instant centre, a link that the formulas leave out."""
    points = () if symbol.kind == "place" else (ref.point for ref in (symbol.of, symbol.to) if ref)
    if symbol.kind not in VALUES or symbol.kind in ANGLES_AT_JOINTS:
        return None
    if symbol.kind in ("x", "y", "d") and not posed.structure.scene.holders.keys() >= {*points}:
        return None
    try:
        return _value(posed, symbol)
    except CallError:
        return None


def _value(posed: AnyPosed, symbol: Symbol) -> Any:
    value = VALUES[symbol.kind](posed, symbol.whole)
    return part_along(symbol.axis, value) if symbol.axis else value


def part_along(axis: str, vector: Any) -> Any:
    """The component of a vector along the "x" or "y" axis of the frame: of numbers, arrays, formulas."""
    return vector.real if axis == "x" else vector.imag


def _rate(field: str) -> Callable[[Posed[V, R], Symbol], V | R]:
    """A velocity or an acceleration: of a point, of one against another, or of a sliding pair along its guide."""

    def value(posed: Posed[V, R], symbol: Symbol) -> V | R:
        if symbol.of is None:
            along: R = getattr(posed.sliding(sliding_pair(posed.slides, symbol)), field).real
            return along
        of: V = getattr(posed.point(symbol.of), field)
        if symbol.to is not None:
            of = of - getattr(posed.point(symbol.to), field)
        return of

    return value


def _theta(posed: AnyPosed, symbol: Symbol) -> Any:
    """The angle of a link's own x axis, or from another link's."""
    turn = posed.pose(symbol.link).u
    return angle_of(turn * posed.pose(symbol.other).u.conjugate() if symbol.other else turn)


def _pressure(posed: Posed, symbol: Symbol) -> Array:
    cam = posed.structure.scene.law_of(symbol.link)
    if cam is not None:
        from graphkin.solver.cams import cam_at

        return cam_at(cam, cam.sense * np.angle(posed.pose(cam.link).u)).pressure
    return np.pi / 2 - _crossing(posed.poses, joint_of_follower(posed.structure, symbol.link, symbol))


def _gamma(posed: Posed, symbol: Symbol) -> Array:
    return _crossing(posed.poses, joint_between(posed.structure, symbol.link, symbol.other, symbol))


def _transmission(posed: Posed, symbol: Symbol) -> Array:
    """The transmission angle of the group with this label."""
    dyad = next(dyad for dyad in posed.structure.dyads.values() if dyad.label == symbol.name)
    return _crossing(posed.poses, joint_of_dyad(posed.structure, dyad))


def _apart(posed: AnyPosed, symbol: Symbol) -> Any:
    assert symbol.of is not None
    assert symbol.to is not None
    return size(_place(posed, symbol, symbol.of.point) - _place(posed, symbol, symbol.to.point))


def _coordinate(posed: AnyPosed, symbol: Symbol) -> Any:
    assert symbol.of is not None
    return part_along(symbol.kind, _place(posed, symbol, symbol.of.point))


def _place(posed: AnyPosed, symbol: Symbol, name: str) -> Any:
    """The place of a point or an instant centre; NaN for a centre at infinity or of links that move as one."""
    scene = posed.structure.scene
    if name in scene.holders:
        return posed.point(PointRef(name)).z
    contact = scene.contact_at.get(name)
    if contact is not None:
        return posed.point(PointRef(name, contact.carrier or contact.block)).z
    pair = centre_links(name, scene.by_name)
    if pair is None:
        raise CallError.of(str(symbol), "there is no point", did_you_mean(name, scene.holders), name=name)
    shared = next((p for p in scene.by_name[pair[0]].points if p in scene.by_name[pair[1]].points), None)
    if shared is not None:  # a joint, whether the two turn or not
        return _place(posed, symbol, shared)
    q, omega = pole(posed.poses[pair[0]], posed.poses[pair[1]])
    with np.errstate(all="ignore"):
        return np.where(scene.size * np.abs(omega) <= PARALLEL * np.abs(q), np.nan, q / omega)


def pole(first: Pose, second: Pose) -> tuple[Array, Array]:
    """The rotation of the first link against the second, as homogeneous coordinates of their instant centre, where both
    have the same velocity.

    Returns
    -------
    q : complex, shape (n,), m rad/s
    omega : real, shape (n,), rad/s
        the centre is q / omega; at infinity in the direction of q where omega is 0; none where both are 0.  With the
        velocity v0 of the point at the world's origin, 0 = v0 + i omega z gives q = i v0.
    """
    v0 = (first.v - 1j * first.omega * first.z) - (second.v - 1j * second.omega * second.z)
    return np.asarray(1j * v0), np.asarray(first.omega - second.omega)


# parts of accelerations


def _part(posed: AnyPosed, symbol: Symbol) -> Any:
    """A part of an acceleration: normal (an), tangential (at), Coriolis (ak), or the rest (ar).

    Seen from a second link a point of a first one runs along a path: its Coriolis term comes from the turning of the
    second link; the component of the rest along the normal of the path comes from its curvature.
    """
    of, to, kind = symbol.of, symbol.to, symbol.kind
    assert of is not None
    path = _path(posed, kind, of, to) if to is not None and of.point == to.point else None
    if path is None and kind in ("an", "at"):
        return _of_turning(posed, symbol, of)
    assert to is not None
    base, normal = path or (_guiding(posed, symbol, of, to), None)
    first, second = posed.point(of), posed.point(to)
    coriolis = 2j * posed.poses[base].omega * (first.v - second.v)
    left = first.a - second.a - coriolis
    if kind == "ak" or normal is None:
        return coriolis if kind == "ak" else left
    across = normal * dot(normal, left)
    return across if kind == "an" else left - across


def _path(posed: AnyPosed, kind: str, of: PointRef, to: PointRef) -> tuple[str, Any] | None:
    """The link from which a point is seen to run along a path, of coincident points of two links, and the unit normal
    of the path, where a part of this kind is told by that; None where it is no path that bends.

    It is the path of a pin in a curved slot, of a contact, or a circle about the hinge of both links.
    """
    links = posed.structure.scene.by_name
    curved = (s for s in posed.slides if s.guide.curvature and s.pin == of.point)
    # another link at the slot's guide has no part in the path
    ends = ((s, guides, slides) for s in curved for slides, guides in ((of, to), (to, of)))
    slide = next((s for s, guides, slides in ends if guides.link == s.b and _is_on(posed, slides, s.body)), None)
    if slide is not None and kind != "at":
        return slide.b, 1j * posed.guide(slide).u
    contact = posed.structure.scene.contact_at.get(of.point)
    if contact is not None and {of.link, to.link} == set(contact.bodies):
        # the centre of a disc lies on the normal
        which = 1 if contact.radii[0] == 0.0 and not contact.flat else 0
        centre = PointRef(contact.centres[which], contact.round_links[which])
        normal = posed.point(of).z - posed.point(centre).z
        return to.link, normal / size(normal)
    if of.link == to.link or not {of.link, to.link} <= set(links):
        return None
    hinge = next((p for p in links[of.link].points if p in links[to.link].points and p != of.point), None)
    if hinge is None:
        return None
    arm = posed.point(of).z - posed.point(PointRef(hinge, of.link)).z
    return to.link, None if kind == "ar" else arm / size(arm)


def _is_on(posed: AnyPosed, ref: PointRef, link: str) -> bool:
    """True where the point is one of the link's, or the link's point under that pin."""
    holders = posed.structure.scene.holders.get(ref.point, ())
    if not holders:
        posed.point(ref)
    if ref.link == link:
        return True
    return (not ref.link or ref.link in holders) and (link in holders or ref.point in posed.link(link).points)


def _of_turning(posed: AnyPosed, symbol: Symbol, of: PointRef) -> Any:
    """Normal and tangential part of the acceleration of one point of a link about another."""
    if of.link:
        posed.link(of.link)
    scene, to = posed.structure.scene, symbol.to
    replacing_links = [name for name in posed.structure.links if name not in scene.by_name]
    for name in (*(link.name for link in scene.links), *replacing_links):
        if name not in posed.poses:  # solved for what leads to the asked alone
            continue
        if not _is_on(posed, of, name) or (to is not None and not _is_on(posed, to, name)):
            continue
        if to is not None:
            centre = to.point
        else:
            fixed = (p for p in posed.link(name).points if p in scene.frame.points and p != of.point)
            if (pivot := next(fixed, None)) is None:
                continue
            centre = pivot
        pose = posed.poses[name]
        arm = posed.point(PointRef(of.point, name)).z - posed.point(PointRef(centre, name)).z
        return -(pose.omega * pose.omega) * arm if symbol.kind == "an" else 1j * pose.alpha * arm
    wanted = (
        Phrase("both points must be on one link")
        if to
        else Phrase("turns about no fixed point write a with", name=of, symbol=symbol)
    )
    raise CallError.of(str(symbol), "no link makes this part", wanted)


def _guiding(posed: AnyPosed, symbol: Symbol, of: PointRef, to: PointRef) -> str:
    """The link along whose guide one of two coincident points slides, by the turning of which the Coriolis term is."""
    for ref in (of, to):
        posed.point(ref)
    for pair in posed.slides:
        for slides, guides in ((of, to), (to, of)):
            if of.point != to.point or not _is_on(posed, slides, pair.body):
                continue
            # another link that is pinned there too has another rate, and so another Coriolis term
            if guides.link == pair.b or (not guides.link and _is_on(posed, guides, pair.b)):
                # a link whose pin runs in a slot turns against it: only its pin moves along the guide
                return to.link if pair.higher and to.link and pair.pin != of.point else pair.b
    # links of a group that are drawn as one, seen from one of them
    together = [{*group.members} for group in posed.structure.larger_groups]
    if of.point == to.point and any({of.link, to.link} <= members for members in together):
        return to.link
    raise CallError.of(str(symbol), "these are not coincident points of two links", _example(symbol, posed.slides))


def _example(symbol: Symbol, slides: Iterable[Pair]) -> Phrase:
    pair = next((s for s in slides if s.pin), None)
    if pair is None:
        return Phrase("nothing slides here")
    return Phrase(
        "write for example of kind and pin and other and pin_2",
        kind=symbol.kind, pin=pair.pin, other=pair.b, pin_2=pair.pin,
    )


ANGLES_AT_JOINTS: Mapping[str, Callable[[Posed, Symbol], Array]] = {
    "gamma": _gamma, "transmission": _transmission, "pressure": _pressure,
}
"""Quantities that are found from arrays alone: their joints have places in numbers."""
VALUES: Mapping[str, Callable[[AnyPosed, Symbol], Any]] = {
    "v": _rate("v"),
    "a": _rate("a"),
    "place": _rate("z"),
    "omega": lambda posed, symbol: posed.pose(symbol.link).omega,
    "alpha": lambda posed, symbol: posed.pose(symbol.link).alpha,
    "theta": _theta,
    "s": lambda posed, symbol: posed.travel(sliding_pair(posed.slides, symbol)),
    "x": _coordinate,
    "y": _coordinate,
    "d": _apart,
    **dict.fromkeys(("an", "at", "ak", "ar"), _part),
    **ANGLES_AT_JOINTS,
}
"""How a quantity of each kind is found from the poses."""


def bound_of_symbol(posed: Posed, symbol: Symbol, bounds: Mapping[str, ErrorBound[Array]]) -> Array:
    """The error bound of a quantity (SI), shape (n,), by the bounds of the links; infinite where it is unknown: of
    rates of sliding pairs, of parts of accelerations, and beyond second rates."""
    frame = posed.structure.scene.frame.name
    order = 0 if symbol.kind in ("x", "y", "d") else symbol.order
    if order is None or order > 2 or symbol.is_rate_of_pair:
        return np.full(np.shape(next(iter(bounds.values())).angle), np.inf)
    known = {frame: ErrorBound(*(np.zeros(1),) * 6), **bounds}

    def of_point(ref: PointRef) -> Array:
        holder = known[posed.holder(ref.point)]
        if not posed.is_under(ref):
            return (known[ref.link] if ref.link else holder).of_point[order]
        # the place lies where the pin is, which may be off
        base, pose = known[ref.link], posed.pose(ref.link)
        arm = np.abs(posed.point(PointRef(ref.point)).z - pose.z)
        spin, turning = np.abs(pose.omega) + base.omega, np.abs(pose.alpha) + base.alpha
        error = holder.position + base.position + 8 * UNIT * arm
        bound: Array = (
            holder.position,
            base.velocity + arm * base.omega + spin * error,
            base.acceleration + arm * (base.alpha + 2 * spin * base.omega) + (turning + spin**2) * error,
        )[order]
        return bound

    if symbol.kind == "s":
        pair = sliding_pair(posed.slides, symbol)
        block, guide = known[pair.a], known[pair.b]
        return np.asarray(block.position + guide.position + np.abs(posed.travel(pair)) * (guide.angle + 4 * UNIT))
    if symbol.of is None:
        turning = [known[posed.link(name).name].of_turning[order] for name in symbol.links()]
        return np.asarray(sum(turning) + (16 * UNIT if symbol.kind == "theta" else 0.0))
    bound = of_point(symbol.of)
    if symbol.to is None:
        return bound
    return bound + of_point(symbol.to) + 4 * UNIT * np.abs(value_of_symbol(posed, symbol))


def _crossing(poses: Mapping[str, Pose], joint: TransmissionAngle) -> Array:
    """The angle between the two directions of a joint's transmission angle, 0 .. pi/2 (rad)."""
    first, second = (poses[end[0]].fixed(end[1]).z - poses[start[0]].fixed(start[1]).z
                     for start, end in (joint.first, joint.second))
    with np.errstate(all="ignore"):
        across = np.conj(first) * second * (1j if joint.square else 1.0) / (np.abs(first) * np.abs(second))
    return np.asarray(np.arctan2(np.abs(across.imag), np.abs(across.real)))
