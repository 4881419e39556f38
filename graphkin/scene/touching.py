"""What touches in a scene, read from its file: round outlines, contacts, wheels with teeth; names are looked up, radii
get the signs with which they meet, the carriers of wheels are found.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from graphkin.errors import Problem, did_you_mean
from graphkin.plane import cross
from graphkin.scene.bodies import Reading, SlidingPair
from graphkin.scene.model import PlacedContact, PlacedDisc, PlacedGear, PlacedGuide
from graphkin.scene.scene_tables import Contact, Gear
from graphkin.words import Phrase

AGREE = 1e-6


# -- contacts ----------------------------------------------------------------------------------------------------------

Discs = Mapping[tuple[str, str], PlacedDisc]
"""Round outlines by link and name."""


def discs_of(reading: Reading) -> dict[tuple[str, str], PlacedDisc]:
    """Every round outline by its link and its name; what is wrong with them is noted."""
    found: dict[tuple[str, str], PlacedDisc] = {}
    for where, link, body in reading.bodies:
        for name, disc in body.discs.items():
            here = f"{where}.discs.{name}"
            if name in reading.guides.get(link, ()):
                reading.say(here, "is the name of a guide too", "give one of them another", link=link, name=name)
            if reading.wrong(reading.no_point_of(f"{here}.centre", link, disc.centre)):
                continue
            if disc.r == 0:
                reading.say(f"{here}.r", "found 0", "write a radius a negative one is a")
            else:
                found[link, name] = PlacedDisc(link, name, disc.centre, disc.r * reading.metres)
    return found


Side = tuple[str, PlacedDisc | None, str]
"""A side of a contact: its link, and its disc or the name of its guide."""


def contacts_of(reading: Reading, discs: Discs) -> tuple[PlacedContact, ...]:
    """The contacts of a file; what is wrong with them is noted."""
    found: list[PlacedContact] = []
    blocks: set[str] = set()
    for name, contact in reading.file.contacts.items():
        where = f"contacts.{name}"
        if any(name in points for points in reading.points.values()):
            reading.say(where, "is a point of a link already", "give the contact a letter of its own", name=name)
        sides = [_side(f"{where}.between", ref, reading, discs) for ref in contact.between]
        known = [side for side in sides if side is not None]
        if len(known) < 2:
            continue
        one, two = known
        if not reading.wrong(*_contact_problems(where, contact, one, two)):
            placed = _contact(name, contact, one, two, reading)
            found.append(replace(placed, again=placed.flat and placed.block in blocks))
            blocks.add(found[-1].block)
    return tuple(found)


def _side(where: str, ref: str, reading: Reading, discs: Discs) -> Side | None:
    """A side of a contact by its name; None where there is none, which is noted here or was before."""
    link, _, part = ref.partition(".")
    if reading.wrong(reading.no_link(where, link)):
        return None
    frame = link == reading.frame.name
    if link not in reading.links and not frame:
        return None
    outlines = (reading.frame if frame else reading.links[link]).discs
    lost = reading.lost_names("links", link, "discs") | (reading.lost_names("frame", "discs") if frame else set())
    if part in outlines or part in lost:
        disc = discs.get((link, part))
        return (link, disc, "") if disc else None  # what is wrong with it is told already
    if not part or part in reading.guides.get(link, ()):
        return link, None, part
    known = [*outlines, *reading.guides.get(link, ())]
    unknown = Phrase("write it in links. discs or links. guides", link=link, other=link)
    reading.say(where, "link has no disc and no guide", did_you_mean(part, known) if known else unknown, link=link,
                part=part)
    return None


def _contact_problems(where: str, contact: Contact, one: Side, two: Side) -> Iterator[Problem]:
    """What is wrong with two sides that there are."""
    refs, between, side = " and ".join(contact.between), f"{where}.between", f"{where}.side"
    if one[0] == two[0]:
        yield Problem(between, "are outlines of the same link", "name two links", refs=refs, link=one[0])
        return
    discs = [disc for _, disc, _ in (one, two) if disc is not None]
    if not discs:
        yield Problem(between, "are two guides", "one of them at least is a disc", refs=refs)
        return
    if len(discs) == 1:
        if contact.side in ("outside", "inside"):
            yield Problem(side, "found with a flat face", "a face has a left and a right", side=contact.side)
        if discs[0].radius < 0:
            yield Problem(between, "is hollow", "no flat face touches a hollow outline", link=discs[0].link,
                          disc=discs[0].name)
        return
    if contact.side in ("left", "right"):
        yield Problem(side, "found with two discs", "two discs touch outside or inside", side=contact.side)
    r1, r2 = (disc.radius for disc in discs)
    hollow = [d for d in discs if d.radius < 0]
    if len(hollow) == 2:
        yield Problem(between, "are both hollow", "one of them has a positive radius", refs=refs)
    elif contact.side == "outside" and hollow:
        yield Problem(side, "found outside with a hollow outline", "leave side out or write inside")
    elif hollow and r1 + r2 >= 0:
        yield Problem(between, "the hollow outline is no larger than what", "its radius must be the larger one",
                      link=hollow[0].link, hollow=hollow[0].name)
    elif contact.side == "inside" and abs(r1) == abs(r2):
        yield Problem(side, "both radii are equal", "inside one must be smaller than the other")


def _contact(name: str, contact: Contact, one: Side, two: Side, reading: Reading) -> PlacedContact:
    """A contact of two sides, radii with the signs with which they meet."""
    (link, first, guide), (other, second, other_guide) = one, two
    carrier = ""
    if first and second:
        if contact.side == "inside" and first.radius > 0 and second.radius > 0:
            if first.radius > second.radius:
                first = replace(first, radius=-first.radius)
            else:
                second = replace(second, radius=-second.radius)
        if contact.rolling:
            both = {first.centre, second.centre}
            others = [n for n, points in reading.points.items() if n not in (link, other) and both <= {*points}]
            others.sort(key=lambda n: n != reading.frame.name)
            carrier = others[0] if others else ""
    left = contact.side != "right"
    return PlacedContact(name, link, other, (first, second), guide or other_guide, left, contact.rolling, carrier)


# -- gears -------------------------------------------------------------------------------------------------------------


def gears_of(reading: Reading) -> tuple[PlacedGear, ...]:
    """The wheels with teeth of a file, with their carriers; what is wrong with them is noted."""
    found = (_gear(f"gears.{name}", name, gear, reading) for name, gear in reading.file.gears.items())
    return tuple(placed for placed in found if placed is not None)


def _gear(where: str, name: str, gear: Gear, reading: Reading) -> PlacedGear | None:
    first, _, part = gear.between[0].partition(".")
    second, _, guide = gear.between[1].partition(".")
    (z1, z2), between, teeth, carrier_key = gear.teeth, f"{where}.between", f"{where}.teeth", f"{where}.carrier"
    rack, before, say = isinstance(z2, str), len(reading.problems), reading.say
    unknown = reading.wrong(*(reading.no_link(between, link) for link in (first, second)))
    if isinstance(z1, str):
        say(teeth, "the first is rack", "the rack is the second one of between")
        return None
    if part or (guide and not rack):
        ref = gear.between[0] if part else gear.between[1]
        say(between, "found of name", "a wheel is named by its link alone", name=ref)
    elif guide and not unknown:
        reading.wrong(reading.no_guide(between, gear.between[1]))
    for z in (z1, z2):
        if not isinstance(z, str) and (z == 0 or not float(z).is_integer()):
            say(teeth, "found value", "write a number of teeth negative for internal", value=f"{z:g}")
    if rack and z1 < 0:
        say(teeth, "found with a rack", "the wheel of a rack has external teeth", teeth=f"{z1:g}")
    if not isinstance(z2, str):
        if z1 < 0 and z2 < 0:
            say(teeth, "both have internal teeth", "one of them has external teeth")
        elif min(z1, z2) < 0 <= z1 + z2:
            say(teeth, "found and", "a ring has more teeth than what runs", teeth=f"{z1:g}", other=f"{z2:g}")
    if first == second:
        say(between, "link meshes with itself", "name two links", first=first)
    missing = gear.carrier is not None and reading.wrong(reading.no_link(carrier_key, gear.carrier))
    if gear.carrier in (first, second) and not missing:
        say(carrier_key, "link is one of the wheels", "name the link that holds both axes", carrier=gear.carrier)
    if len(reading.problems) > before:
        return None
    if "" in reading.unsure or any(n not in reading.points for n in (first, second)):
        return None
    others = [n for n in (reading.frame.name, *reading.links) if n not in (first, second)]
    for carrier in [gear.carrier] if gear.carrier else others:
        axis = _axis(reading, first, carrier)
        if rack:
            pair = next((s for s in reading.slides if {s.link, s.on} == {second, carrier}), None)
            if axis and pair:
                return PlacedGear(name, (first, second), (z1, None), carrier, (axis, ""), guide, pair.key)
            continue
        other = _axis(reading, second, carrier)
        if axis and other and axis != other:
            return PlacedGear(name, (first, second), (z1, float(z2)), carrier, (axis, other))
    held = Phrase("the wheel's axis and the rack's slide") if rack else Phrase("both axes")
    if gear.carrier:
        sharing = "it shares a point with a link and slides" if rack else "it shares a point with each of two links"
        say(carrier_key, "link does not hold", Phrase(sharing, first=first, second=second), carrier=gear.carrier,
            held=held)
    else:
        say(where, "no link holds of wheels and", "pin both wheels to one carrier and name", held=held, first=first,
            second=second)
    return None


def _axis(reading: Reading, wheel: str, carrier: str) -> str:
    """The point that a wheel and its carrier share."""
    held = reading.points.get(carrier, ())
    return next((p for p in reading.points.get(wheel, ()) if p in held), "")


def wrong_distances(
    contacts: tuple[PlacedContact, ...], gears: tuple[PlacedGear, ...], guides: Mapping[str, Mapping[str, PlacedGuide]],
    reading: Reading,
) -> None:  # fmt: skip
    """Note wheels whose carrier does not hold them as far apart as their radii say, or at no distance; pitch lines that
    are not parallel to their slide; centres on the other body.

    Parameters
    ----------
    guides : of each link, in its own axes (m)
    """
    points = reading.places
    for c in contacts:
        where = f"contacts.{c.name}"
        if not c.flat and c.carrier:
            one, two = c.round
            held = abs(points[c.carrier][two.centre] - points[c.carrier][one.centre])
            wanted = abs(one.radius + two.radius)
            if abs(held - wanted) > AGREE * max(abs(one.radius), abs(two.radius)):
                apart = {"held": f"{held / reading.metres:.10g}", "wanted": f"{wanted / reading.metres:.10g}"}
                reading.say(where, Phrase("link holds the centres apart the radii make", carrier=c.carrier, **apart),
                            "correct a radius or the distance")
        if not c.flat and c.round[0].centre == c.round[1].centre:
            reading.say(where, "both outlines have the same centre", "two centres lie apart")
    for g in gears:
        where, carried = f"gears.{g.name}", points[g.carrier]
        if not g.is_rack:
            if abs(carried[g.axes[1]] - carried[g.axes[0]]) == 0:
                reading.say(where, "both axes lie at the same place", "two wheels have axes apart")
            continue
        height, tilt, far = rack_place(g, reading.slides, points, guides)
        if abs(tilt) > AGREE:
            reading.say(where, "the pitch line is not parallel to the", "name a guide of link along which it",
                        slide=g.slide, wheels=g.wheels[1])
        elif abs(height) <= AGREE * max(far, 1e-300):
            reading.say(where, "the wheel's axis lies on the pitch line", "the distance of the two is the radius")


def rack_place(
    gear: PlacedGear, slidings: tuple[SlidingPair, ...],
    points: Mapping[str, Mapping[str, complex]], guides: Mapping[str, Mapping[str, PlacedGuide]],
) -> tuple[float, float, float]:
    """How far the pitch line of a rack lies to the left of the wheel's axis, seen along the guide of its slide (m); the
    sine of its angle with the guide; and a length to compare with (m)."""
    pair = next(s for s in slidings if s.key == gear.slide)
    rail = guides[pair.on][pair.guide]

    def seen(link: str, z: complex) -> complex:
        # in the axes of the guide, but for the travel along it
        return z * pair.turn if link == pair.link else (z - rail.through) / rail.direction

    rack, line = gear.wheels[1], guides[gear.wheels[1]][gear.guide]
    axis = seen(gear.carrier, points[gear.carrier][gear.axes[0]])
    at = seen(rack, line.through)
    along = seen(rack, line.through + line.direction) - at
    far = abs(axis) + abs(at)
    return (at - axis).imag, cross(1 + 0j, along), far
