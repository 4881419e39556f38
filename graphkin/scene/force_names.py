"""Which joints carry forces in a mechanism, and which forces and moments it has, by name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

from graphkin.errors import Problem, did_you_mean
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol


@dataclass(frozen=True)
class ForceJoint:
    """A joint, with a force of link ``first`` on link ``second``: a turning pair or a pin in a slot at ``point``, or a
    sliding pair (``point`` is the sliding link's first point, or empty), or a cam (``first``) with its follower, or
    what slides or rolls on each other, or meshes, in a contact or gear ``point``.  ``second`` slides, or has the pin.

    name : ``5/6``, or ``5/6@C`` where the two share several joints
    """

    kind: Literal["turning", "sliding", "slot", "cam", "contact", "rolling", "gear"]
    first: str
    second: str
    point: str
    name: str = ""


def joints(mechanism: Mechanism) -> tuple[ForceJoint, ...]:
    """All joints: at each point the first link that has it, the frame if it does, with each later one; then sliding
    pairs, guiding link first, and pins in slots.  Redundant links carry nothing."""
    here = {mechanism.frame.name, *(link.name for link in mechanism.links if not link.redundant)}
    found: list[ForceJoint] = []
    for point, holders in mechanism.holders.items():
        first, *later = [name for name in holders if name in here] or [""]
        found += [ForceJoint("turning", first, second, point) for second in later]
    found += [ForceJoint("slot" if s.of else "sliding", s.on, s.of or s.link, s.point)
              for s in mechanism.slides if {s.on, s.of or s.link} <= here]
    if mechanism.instead_of is None:
        found += [ForceJoint("cam", c.link, c.follower, "") for c in mechanism.cams if {c.link, c.follower} <= here]
    for contact in mechanism.contacts:
        if set(contact.links) <= here:
            # where another link holds the centres apart only the force along the tangent is the contact's
            kind = "contact" if not contact.rolling else "gear" if contact.carrier else "rolling"
            found.append(ForceJoint(kind, *contact.links, contact.name))  # type: ignore[arg-type]
    found += [ForceJoint("gear", *g.wheels, g.name) for g in mechanism.gears if {*g.wheels, g.carrier} <= here]
    shared = Counter(frozenset((joint.first, joint.second)) for joint in found)
    several = [shared[frozenset((joint.first, joint.second))] > 1 and joint.point != "" for joint in found]
    return tuple(
        replace(joint, name=f"{joint.first}/{joint.second}" + (f"@{joint.point}" if more else ""))
        for joint, more in zip(found, several, strict=True)
    )


def force_names(mechanism: Mechanism) -> Mapping[str, Literal["force", "moment"]]:
    """Every force and moment of a mechanism that has masses, loads or springs, in the order in which they are told."""
    loading, made = mechanism.loading, dict[str, Literal["force", "moment"]]()
    if not loading:
        return made
    for mass in loading.masses:
        made |= {f"Fi_{mass.link}": "force", f"Mi_{mass.link}": "moment"}
        if loading.gravity:
            made[f"G_{mass.link}"] = "force"
    for load in loading.loads:
        made[f"P_{load.name}"] = "force" if load.is_force else "moment"
    made |= {f"P_{spring.name}": "force" for spring in loading.springs}
    for joint in joints(mechanism):
        made[f"F_{joint.name}"] = "force"
        if joint.kind == "sliding":
            made[f"M_{joint.name}"] = "moment"
    if loading.balance is not None:
        said = loading.balance
        return made | {_balance(not said.is_force, said.link): "force" if said.is_force else "moment"}
    for driver in mechanism.drivers:
        if driver.turns:
            made[_balance(True, driver.link)] = "moment"
        else:
            pin = next((s.of for s in mechanism.pins if s.key == driver.key), driver.link)
            made[_balance(False, pin)] = "force"
    return made


def _balance(moment: bool, link: str) -> str:
    return f"{'M' if moment else 'F'}_{link}"


def opposite(name: str) -> str:
    """The name of the force or couple of the second link on the first, ``F_6/5@C`` for ``F_5/6@C``; others as they are.

    >>> opposite("F_6/5@C"), opposite("M_2")
    ('F_5/6@C', 'M_2')
    """
    letter, _, rest = name.partition("_")
    pair, at, point = rest.partition("@")
    first, between, second = pair.partition("/")
    return f"{letter}_{second}/{first}{at}{point}" if between else name


def no_force(mechanism: Mechanism, where: str, symbol: Symbol) -> Problem | None:
    """What is wrong with a symbol of a force or a flywheel that the mechanism does not have; None for one that it
    has."""
    if symbol.scope == "cycle" and mechanism.loading.flywheel is None:
        return Problem(where, "belongs to a flywheel but there is none", "give flywheel", symbol=symbol)
    if symbol.scope != "force" or symbol.kind in ("h", "arm"):
        return None
    known = force_names(mechanism)
    if not known:
        return Problem(where, "is a force but nothing makes any", "give masses.link or loads.name or springs.name",
                       symbol=symbol)
    name = str(replace(symbol, at="", plus=False))
    if name in known or opposite(name) in known:
        return None
    return Problem(where, "there is no here", did_you_mean(name, known), symbol=symbol)
