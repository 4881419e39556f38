"""The joints of a mechanism that carry forces, and its forces and moments by name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Literal

from graphkin.errors import Problem, did_you_mean
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol


@dataclass(frozen=True)
class ForceJoint:
    """A joint, with a force of link ``first`` on link ``second``: a turning pair or a pin in a slot at ``point``, a
    sliding pair (``point`` is the sliding link's first point, or empty), a cam (``first``) with its follower, or a
    contact or gear ``point``.  ``second`` slides, or has the pin.

    several : whether the two share further joints
    """

    kind: Literal["turning", "sliding", "slot", "cam", "contact", "rolling", "gear"]
    first: str
    second: str
    point: str
    several: bool = False

    def symbol(self, kind: Literal["F", "M"]) -> Symbol:
        """The force or the couple that goes through it, ``F_5/6``, or ``F_5/6@C`` where the two share several."""
        return Symbol(kind, PointRef(self.point) if self.several else None, link=self.first, other=self.second)


def hosts_at(mechanism: Mechanism, point: str, holders: Collection[str]) -> dict[str, str]:
    """The links that what guides a pin or a block along a circle is paired with at a point: in its pin the link that
    has the pin, in its centre the link that has the slot.

    Parameters
    ----------
    holders : the links that meet there
    """
    ends = ((slot.bar, host) for slot in mechanism.slots
            for place, host in ((slot.point, slot.of), (slot.centre, slot.on)) if place == point)  # fmt: skip
    return {bar: host for bar, host in ends if bar in holders and host in holders}


def joints(mechanism: Mechanism) -> tuple[ForceJoint, ...]:
    """All joints: at each point the first link that has it, the frame if it does, with each later one, but what is
    guided along a circle with the link of the pin or of the slot; then sliding pairs, guiding link first, and pins in
    slots.  Redundant links carry nothing."""
    here = {mechanism.frame.name, *(link.name for link in mechanism.links if not link.redundant)}
    found: list[ForceJoint] = []
    for point, holders in mechanism.holders.items():
        meeting = [name for name in holders if name in here]
        hosts = hosts_at(mechanism, point, meeting)
        first = next((name for name in meeting if name not in hosts), "")
        found += [ForceJoint("turning", hosts.get(name, first), name, point) for name in meeting if name != first]
    found += [ForceJoint("slot" if s.of else "sliding", s.on, s.of or s.link, s.point)
              for s in mechanism.slides if {s.on, s.of or s.link} <= here]
    found += [ForceJoint("cam", c.link, c.follower, "") for c in mechanism.driving_cams if {c.link, c.follower} <= here]
    for contact in mechanism.contacts:
        if set(contact.links) <= here:
            # where another link holds the centres apart only the force along the tangent is the contact's
            kind = "contact" if not contact.rolling else "gear" if contact.carrier else "rolling"
            found.append(ForceJoint(kind, *contact.links, contact.name))  # type: ignore[arg-type]
    found += [ForceJoint("gear", *g.wheels, g.name) for g in mechanism.gears if {*g.wheels, g.carrier} <= here]
    shared = Counter(frozenset((joint.first, joint.second)) for joint in found)
    several = (shared[frozenset((joint.first, joint.second))] > 1 and joint.point != "" for joint in found)
    return tuple(replace(joint, several=more) for joint, more in zip(found, several, strict=True))


def forces_named(mechanism: Mechanism) -> tuple[Symbol, ...]:
    """Every force and moment of a mechanism that has masses, loads or springs, in the order in which they are told."""
    loading = mechanism.loading
    if not loading:
        return ()
    made: list[Symbol] = []
    for mass in loading.masses:
        made += [Symbol(kind, link=mass.link) for kind in ("Fi", "Mi", *(("G",) if loading.gravity else ()))]
    made += [Symbol("P", name=load.name, turning=not load.is_force) for load in loading.loads]
    made += [Symbol("P", name=spring.name) for spring in loading.springs]
    for joint in joints(mechanism):
        made += [joint.symbol("F"), *([joint.symbol("M")] if joint.kind == "sliding" else [])]
    if loading.balance is not None:
        balances = [(loading.balance.is_force, loading.balance.link)]
    else:
        pins = {pin.key: pin.of for pin in mechanism.pins}
        balances = [(not d.turns, d.link if d.turns else pins.get(d.key, d.link)) for d in mechanism.drivers]
    made += [Symbol("F" if is_force else "M", link=link) for is_force, link in balances]
    return tuple(dict.fromkeys(made))


def force_of(mechanism: Mechanism, symbol: Symbol) -> Symbol | None:
    """A force or moment of the mechanism or its opposite, with the mark of a load that is a moment; None for a name
    that the mechanism does not have."""
    plain = replace(symbol, at="", plus=False, axis="")
    known = next((force for force in forces_named(mechanism) if force in (plain, plain.opposite)), None)
    return known and replace(symbol, turning=known.turning)


def no_force(mechanism: Mechanism, where: str, symbol: Symbol) -> Problem | None:
    """The problem of a symbol of a force or a flywheel that the mechanism does not have; None if it has it."""
    if symbol.scope == "cycle" and mechanism.loading.flywheel is None:
        return Problem(where, "belongs to a flywheel but there is none", "give flywheel", symbol=symbol)
    if symbol.kind == "h":  # of the inertia force of a link
        return no_force(mechanism, where, Symbol("Fi", link=symbol.link))
    if symbol.kind == "arm":  # of a force on the lever
        return no_force(mechanism, where, Symbol.parse(symbol.name))
    if not symbol.is_load:
        return None
    known = forces_named(mechanism)
    if not known:
        return Problem(where, "is a force but nothing makes any", "give masses.link or loads.name or springs.name",
                       symbol=symbol)
    if force_of(mechanism, symbol) is not None:
        return None
    name = str(replace(symbol, at="", plus=False, axis=""))
    return Problem(where, "there is no here", did_you_mean(name, map(str, known)), symbol=symbol)
