"""Higher pairs of a scene, read from its file: round outlines, contacts, wheels with teeth, cams by the law of their
follower; names are looked up, radii get the signs with which they meet, the carriers of wheels are found.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from graphkin.errors import Problem, did_you_mean
from graphkin.plane import cross, dot
from graphkin.scene.bodies import Reading
from graphkin.scene.laws import FollowerLaw, LiftPiece, form_of
from graphkin.scene.pairs import (
    LawCam,
    PlacedContact,
    PlacedGear,
    PlacedGuide,
    SlidingFollower,
    SwingingFollower,
)
from graphkin.scene.scene_tables import Cam, Contact, Disc, Gear, LawPiece
from graphkin.scene.tables import in_si
from graphkin.words import Phrase, joined

AGREE = 1e-6
"""Of the greater length: so far a given offset may lie from that which the guide makes."""
ROUNDING = 1e-12
"""Of the way along the guide: a smaller offset is rounding alone."""


# contacts

Discs = Mapping[tuple[str, str], Disc]
"""Round outlines (m) by link and name."""


def discs_of(reading: Reading) -> dict[tuple[str, str], Disc]:
    """Every round outline (m) by its link and its name; their problems are noted."""
    discs: dict[tuple[str, str], Disc] = {}
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
                discs[link, name] = in_si(disc, reading.units)
    return discs


Side = tuple[str, str, Disc | None]
"""A side of a contact: its link, the name of its disc or its guide, and the disc (m)."""


def contacts_of(reading: Reading, discs: Discs) -> tuple[PlacedContact, ...]:
    """The contacts of a file; their problems are noted."""
    contacts: list[PlacedContact] = []
    blocks: set[str] = set()
    for name, contact in reading.file.contacts.items():
        where = f"contacts.{name}"
        if any(name in points for points in reading.points.values()):
            reading.say(where, "is a point of a link already", "give the contact a letter of its own", name=name)
        sides = [_side(f"{where}.between", ref, reading, discs) for ref in contact.between]
        known = [side for side in sides if side is not None]
        if len(known) < 2:
            continue
        first, second = known
        if not reading.wrong(*_contact_problems(where, contact, first, second)):
            placed = _contact(name, contact, first, second, reading)
            contacts.append(replace(placed, again=placed.flat and placed.block in blocks))
            blocks.add(contacts[-1].block)
    return tuple(contacts)


def _side(where: str, ref: str, reading: Reading, discs: Discs) -> Side | None:
    """A side of a contact by its name; None where it does not exist, which is noted."""
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
        return (link, part, disc) if disc else None  # its problem is noted already
    if not part or part in reading.guides.get(link, ()):
        return link, part, None
    if link in reading.unsure:
        return None  # the problem of its outlines is noted already
    known = [*outlines, *reading.guides.get(link, ())]
    unknown = Phrase("write it in links. discs or links. guides", link=link, other=link)
    reading.say(where, "link has no disc and no guide", did_you_mean(part, known) if known else unknown, link=link,
                part=part)
    return None


def _contact_problems(where: str, contact: Contact, first: Side, second: Side) -> Iterator[Problem]:
    """The problems of a contact whose two sides exist."""
    refs, between, side = joined("one and other", contact.between), f"{where}.between", f"{where}.side"
    if first[0] == second[0]:
        yield Problem(between, "are outlines of the same link", "name two links", refs=refs, link=first[0])
        return
    discs = [(link, name, disc.r) for link, name, disc in (first, second) if disc is not None]
    if not discs:
        yield Problem(between, "are two guides", "one of them at least is a disc", refs=refs)
        return
    if len(discs) == 1:
        if contact.side in ("outside", "inside"):
            yield Problem(side, "found with a flat face", "a face has a left and a right", side=contact.side)
        link, name, radius = discs[0]
        if radius < 0:
            yield Problem(between, "is hollow", "no flat face touches a hollow outline", link=link, disc=name)
        return
    if contact.side in ("left", "right"):
        yield Problem(side, "found with two discs", "two discs touch outside or inside", side=contact.side)
    r1, r2 = (radius for *_, radius in discs)
    hollow = [(link, name) for link, name, radius in discs if radius < 0]
    if len(hollow) == 2:
        yield Problem(between, "are both hollow", "one of them has a positive radius", refs=refs)
    elif contact.side == "outside" and hollow:
        yield Problem(side, "found outside with a hollow outline", "leave side out or write inside")
    elif hollow and r1 + r2 >= 0:
        yield Problem(between, "the hollow outline is no larger than what", "its radius must be the larger one",
                      link=hollow[0][0], hollow=hollow[0][1])
    elif contact.side == "inside" and abs(r1) == abs(r2):
        yield Problem(side, "both radii are equal", "inside one must be smaller than the other")


def _contact(name: str, contact: Contact, side: Side, other_side: Side, reading: Reading) -> PlacedContact:
    """A contact of two sides, radii with the signs with which they meet."""
    (link, name_on_link, first), (other, name_on_other, second) = side, other_side
    carrier = ""
    if first and second:
        if contact.side == "inside" and first.r > 0 and second.r > 0:
            if first.r > second.r:
                first = replace(first, r=-first.r)
            else:
                second = replace(second, r=-second.r)
        if contact.rolling:
            both = {first.centre, second.centre}
            others = [n for n, points in reading.points.items() if n not in (link, other) and both <= {*points}]
            others.sort(key=lambda n: n != reading.frame.name)
            carrier = others[0] if others else ""
    left = contact.side != "right"
    outlines = name_on_link, name_on_other
    discs, face = [disc for disc in (first, second) if disc], other if second is None else "" if first else link
    centres, radii = tuple(disc.centre for disc in discs), tuple(disc.r for disc in discs)
    return PlacedContact(name, (link, other), outlines, centres, radii, face, left, contact.rolling, carrier)


# gears


def gears_of(reading: Reading) -> tuple[PlacedGear, ...]:
    """The wheels with teeth of a file, with their carriers; their problems are noted."""
    gears = (_gear(name, gear, reading) for name, gear in reading.file.gears.items())
    return tuple(placed for placed in gears if placed is not None)


def _gear(name: str, gear: Gear, reading: Reading) -> PlacedGear | None:
    first, _, part = gear.between[0].partition(".")
    second, _, guide = gear.between[1].partition(".")
    where = f"gears.{name}"
    z1, z2 = gear.teeth
    between, teeth, carrier_key = f"{where}.between", f"{where}.teeth", f"{where}.carrier"
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
            pair = next((s for s in reading.slides if {s.a, s.b} == {second, carrier}), None)
            if axis and pair:
                sense = 1 if pair.a == second else -1
                return PlacedGear(name, (first, second), (z1, None), carrier, (axis, ""), guide, pair.key, sense)
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


# cams

Line = tuple[str, complex, complex]
"""A guide of the frame on which a link slides: the key of the pair, a point of it (m), its sense."""


def cams_of(
    reading: Reading, guides: Mapping[str, PlacedGuide], given: Mapping[str, complex]
) -> tuple[LawCam, ...]:
    """The cams of a file; their problems are noted.

    Parameters
    ----------
    guides : of the frame
    given : places of points that the file draws (m)
    """
    file = reading.file
    rails = {s.a: (s.key, guides.get(s.guide.name)) for s in reading.slides if s.b == reading.frame.name}
    lines = {name: (pair, rail.through, rail.direction) for name, (pair, rail) in rails.items() if rail is not None}
    drawn = {p: complex(*place) * reading.metres for p, place in file.sketch.items()} | dict(given)
    moved: dict[str, str] = {}
    cams = []
    for name, cam in reading.file.cams.items():
        other = moved.setdefault(cam.follower, name)
        if other != name:
            reading.say(f"cams.{name}.follower", "link is moved by cam already", "a follower has one cam",
                        follower=cam.follower, other=other)
        placed = _cam(name, cam, reading, lines, drawn)
        if placed is not None:
            cams.append(placed)
    return tuple(cams)


def _cam(
    name: str, cam: Cam, reading: Reading, lines: Mapping[str, Line], drawn: Mapping[str, complex]
) -> LawCam | None:
    where, before, si = f"cams.{name}", len(reading.problems), in_si(cam, reading.units)
    point = _axis_of_cam(where, name, reading)
    swings = _swings(where, name, cam, reading, lines)
    law = follower_law(f"{where}.law", cam.law, math.pi / 180 if swings else reading.metres, reading)
    roller = si.roller or 0.0
    base = si.base.r + (roller if cam.base.of == "profile" else 0.0)
    if cam.flat and cam.roller is not None:
        reading.say(f"{where}.flat", "stands beside roller", "the face is flat or it has a")
    if not cam.flat and base <= roller:
        reading.say(f"{where}.base.r", "found with a roller of", "the base circle of the pitch curve is",
                    r=f"{cam.base.r:g}", roller=f"{cam.roller:g}")
    for side in ("rise", "fall"):
        angle = getattr(cam.allow, side, None)
        if angle is not None and not 0.0 < angle < 90.0:
            reading.say(f"{where}.allow.{side}", "found value", "a pressure angle lies between 0 and 90",
                        value=f"{angle:g}")
    if not point or swings is None or len(reading.problems) > before:
        return None
    axis = reading.places[reading.frame.name][point]
    motion: SlidingFollower | SwingingFollower | None
    if swings:
        motion = _swinging(where, cam, reading, axis, drawn)
    else:
        motion = _sliding(where, si, reading, axis, lines[cam.follower])
    if motion is None or law is None or len(reading.problems) > before:
        return None
    allowed = (si.allow.rise, si.allow.fall) if si.allow else (None, None)
    return LawCam(name, cam.follower, point, axis, law, cam.sense, base, roller, cam.flat, motion, allowed)


def _axis_of_cam(where: str, name: str, reading: Reading) -> str:
    """The point of the frame about which a cam turns; "" where there is none."""
    if reading.wrong(reading.no_link(where, name, moving=True)):
        return ""
    if name == reading.frame.name:
        reading.say(where, "link is the frame", "a cam turns", name=name)
        return ""
    link = reading.links.get(name)
    if link is None or reading.lost_under("links", name):
        return ""
    if link.points and link.points[0] in reading.places[reading.frame.name]:
        return link.points[0]
    if not reading.lost_under("frame"):
        no_point = Phrase("link has no point", name=name)
        said = Phrase("is no point of the frame", points=link.points[0]) if link.points else no_point
        reading.say(where, said, "a cam turns about its first point which")
    return ""


def _swings(here: str, name: str, cam: Cam, reading: Reading, lines: Mapping[str, Line]) -> bool | None:
    """Whether the follower swings; None where it neither swings nor slides on the frame."""
    where, follower, frame = f"{here}.follower", cam.follower, reading.frame.name
    if reading.wrong(reading.no_link(where, follower, moving=True)):
        return None
    if follower in (name, frame):
        said = Phrase("the cam itself") if follower == name else Phrase("link is the frame", name=follower)
        reading.say(where, said, "name the link that the cam moves")
        return None
    if follower in lines:
        return False
    link = reading.links.get(follower)
    if link is None or reading.lost_under("links", follower) or reading.lost_under("frame"):
        return None
    pivots = [p for p in link.points if p in reading.places[reading.frame.name]]
    if any(pair.a == follower and pair.b == frame for pair in reading.slides):
        return None  # the problem of its guide is noted already
    if len(pivots) != 1 or link.on is not None:
        reading.say(where, "link neither slides on a guide of the", "write on guide or points with a pivot",
                    follower=follower, frame=frame)
        return None
    if len(link.points) != 2:
        reading.say(where, "link has no point but its pivot", "it is a bar from its pivot to", follower=follower)
        return None
    sliding = {"offset": (cam.offset is not None, Phrase("an offset")), "flat": (cam.flat, Phrase("a flat face"))}
    for beside, (there, kind) in sliding.items():
        if there:
            reading.say(f"{here}.{beside}", "link swings", "is for a sliding follower", name=follower, kind=kind)
    return True


def _sliding(where: str, si: Cam, reading: Reading, axis: complex, line: Line) -> SlidingFollower | None:
    """A follower on a line; of the cam in SI."""
    pair, through, along = line
    offset, metres = cross(along, axis - through), reading.metres
    if si.offset is not None and abs(si.offset - offset) > AGREE * max(abs(axis - through), si.base.r):
        reading.say(f"{where}.offset", "found but the guide makes it", "one is wrong positive where the axis is",
                    offset=f"{si.offset / metres:g}", other=f"{offset / metres:.9g}")
        return None
    travel = dot(along, axis - through)
    if abs(offset) < ROUNDING * abs(axis - through):
        offset = 0.0
    return SlidingFollower(pair, through + along * travel, along, travel, offset)


def _swinging(
    where: str, cam: Cam, reading: Reading, axis: complex, drawn: Mapping[str, complex]
) -> SwingingFollower | None:
    """A follower that swings about a point of the frame."""
    link = reading.links[cam.follower]
    (first, second), places = link.points, reading.places[reading.frame.name]
    pivot, tip = (first, second) if first in places else (second, first)
    centre = places[pivot]
    if centre == axis:
        reading.say(f"{where}.follower", "swings about the cam's own axis", "its pivot lies elsewhere", pivot=pivot)
        return None
    if link.length is None:
        reading.say(f"links.{cam.follower}.length", "is missing", "the length of a swinging follower is written")
        return None
    left = tip not in drawn or cross(axis - centre, drawn[tip] - centre) >= 0.0
    return SwingingFollower(pivot, tip, centre, link.length * reading.metres, 1 if left else -1, pivot == second)


def follower_law(where: str, pieces: Sequence[LawPiece], unit: float, reading: Reading) -> FollowerLaw | None:
    """The law of a cam's follower, over rad, in SI; its problems are noted.

    Parameters
    ----------
    where : its place in the file
    unit : one unit of the lifts in the file in SI (m, or rad of a follower that swings)
    """
    lifts: list[LiftPiece] = []
    start = low = most = 0.0
    before = len(reading.problems)
    for i, piece in enumerate(pieces, 1):
        here = f"{where}.{i}"
        reading.wrong(*piece.problems(here))
        high = low + piece.height
        sense, size = ("rise", piece.rise) if piece.rise is not None else ("fall", piece.fall)
        if size is not None and not size > 0.0:
            reading.say(here, f"{sense} = {size:g}", "it must be positive a dwell has neither")
        if not piece.to > start:
            reading.say(here, "ends at deg where it begins at", "degrees grow from 0 to 360", to=f"{piece.to:g}",
                        start=f"{start:g}")
        elif piece.to > 360.0:
            reading.say(here, "ends at deg", "the law ends at 360", start=f"{piece.to:g}")
        most = max(most, abs(high), abs(low))
        high = 0.0 if abs(high) < 1e-9 * most else high
        lifts.append(LiftPiece(math.radians(start), math.radians(piece.to), low * unit, high * unit, form_of(piece.by)))
        start, low = piece.to, high
    if not pieces:
        reading.say(where, "is empty", "write to 60 rise 28 by harmonic")
    elif len(reading.problems) == before and start != 360.0:
        reading.say(f"{where}.{len(pieces)}", "ends at deg", "the last piece ends at 360", start=f"{start:g}")
    if len(reading.problems) == before and low != 0.0:
        reading.say(where, "does not come back a turn leaves the", "all that rises falls again",
                    lift=f"{low:.9g}")
    return FollowerLaw(tuple(lifts)) if len(reading.problems) == before else None
