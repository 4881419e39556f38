"""Contacts and gears of a file: names looked up, radii with their signs, the carriers of wheels found."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from graphkin.errors import Problem, did_you_mean
from graphkin.plane import cross, dot
from graphkin.scene.contact_tables import Contact, Gear
from graphkin.scene.contacts import PlacedContact, PlacedDisc, PlacedGear
from graphkin.scene.model import PlacedGuide, SlidingPair
from graphkin.scene.names import Flaws, Names
from graphkin.scene.placing import Placement
from graphkin.scene.tables import SceneTables
from graphkin.words import Phrase

__all__ = ["contacts_of", "discs_of", "drawn_apart", "gears_of", "rack_place", "touching_links", "wrong_distances"]

AGREE = 1e-6


def discs_of(file: SceneTables, names: Names, problems: list[Problem]) -> dict[tuple[str, str], PlacedDisc]:
    """Every round outline by its link and its name."""
    metres, found = file.units.metres, dict[tuple[str, str], PlacedDisc]()
    tables = [(f"links.{n}", n, link.discs) for n, link in file.links.items()]
    for where, link, discs in (*tables, ("frame", names.frame, file.frame.discs)):
        for name, table in discs.items():
            here = f"{where}.discs.{name}"
            if name in names.guides.get(link, ()):
                problems.append(
                    Problem(
                        here,
                        Phrase("is the name of a guide too", link=link, name=name),
                        Phrase("give one of them another"),
                    )
                )
            if missing := names.no_point_of(f"{here}.centre", link, table.centre):
                problems.append(missing)
            elif table.r == 0:
                problems.append(Problem(f"{here}.r", Phrase("found 0"), Phrase("write a radius a negative one is a")))
            else:
                found[link, name] = PlacedDisc(link, name, table.centre, table.r * metres)
    return found


def touching_links(file: SceneTables) -> Iterator[tuple[str, str]]:
    """The links that a contact or a gear joins."""
    for between in (*(c.between for c in file.contacts.values()), *(g.between for g in file.gears.values())):
        one, two = (ref.partition(".")[0] for ref in between)
        yield one, two


@dataclass(frozen=True)
class _Side:
    """One side of a contact: its link, and its disc or the name of its guide."""

    link: str
    disc: PlacedDisc | None
    guide: str


def contacts_of(
    file: SceneTables, names: Names, flaws: Flaws, discs: Mapping[tuple[str, str], PlacedDisc], problems: list[Problem]
) -> tuple[PlacedContact, ...]:
    """The contacts of a file; what is wrong with them is added to ``problems``."""
    lost = {(n, k) for n in names.points for k in flaws.names("links", n, "discs")}
    lost |= {(names.frame, k) for k in flaws.names("frame", "discs")}
    found: list[PlacedContact] = []
    for name, table in file.contacts.items():
        where = f"contacts.{name}"
        if any(name in own for own in names.points.values()):
            wanted = Phrase("give the contact a letter of its own")
            problems.append(Problem(where, Phrase("is a point of a link already", name=name), wanted))
        sides = [_side(f"{where}.between", ref, file, names, discs, lost) for ref in table.between]
        wrong = [s for s in sides if isinstance(s, Problem)]
        problems += wrong
        one, two = sides
        if wrong or not isinstance(one, _Side) or not isinstance(two, _Side):
            continue
        reasons = list(_contact_problems(where, table, one, two))
        problems += reasons
        if not reasons:
            found.append(_contact(name, table, one, two, names))
    blocks: set[str] = set()
    for k, contact in enumerate(found):
        found[k] = replace(contact, again=contact.flat and contact.block in blocks)
        blocks.add(contact.block)
    return tuple(found)


def _side(
    where: str, ref: str, file: SceneTables, names: Names, discs: Mapping[tuple[str, str], PlacedDisc],
    lost: set[tuple[str, str]],
) -> _Side | Problem | None:
    link, _, part = ref.partition(".")
    if missing := names.no_link(where, link):
        return missing
    if link not in file.links and link != names.frame:
        return None
    outlines = (file.frame if link == names.frame else file.links[link]).discs
    if part in outlines or (link, part) in lost:
        disc = discs.get((link, part))
        return _Side(link, disc, "") if disc else None  # what is wrong with it is told already
    if not part or part in names.guides.get(link, ()):
        return _Side(link, None, part)
    known = [*outlines, *names.guides.get(link, ())]
    wanted = (
        did_you_mean(part, known)
        if known
        else Phrase("write it in links. discs or links. guides", link=link, other=link)
    )
    return Problem(where, Phrase("link has no disc and no guide", link=link, part=part), wanted)


def _contact_problems(where: str, table: Contact, one: _Side, two: _Side) -> Iterator[Problem]:
    refs = " and ".join(table.between)
    if one.link == two.link:
        yield Problem(
            f"{where}.between",
            Phrase("are outlines of the same link", refs=refs, link=one.link),
            Phrase("name two links"),
        )
        return
    if one.disc is None and two.disc is None:
        yield Problem(f"{where}.between", Phrase("are two guides", refs=refs), Phrase("one of them at least is a disc"))
        return
    if one.disc is None or two.disc is None:
        disc = one.disc or two.disc
        assert disc is not None
        if table.side in ("outside", "inside"):
            wanted = Phrase("a face has a left and a right")
            yield Problem(f"{where}.side", Phrase("found with a flat face", side=table.side), wanted)
        if disc.radius < 0:
            wanted = Phrase("no flat face touches a hollow outline")
            yield Problem(f"{where}.between", Phrase("is hollow", link=disc.link, disc=disc.name), wanted)
        return
    if table.side in ("left", "right"):
        yield Problem(
            f"{where}.side",
            Phrase("found with two discs", side=table.side),
            Phrase("two discs touch outside or inside"),
        )
    r1, r2 = one.disc.radius, two.disc.radius
    hollow = [d for d in (one.disc, two.disc) if d.radius < 0]
    if len(hollow) == 2:
        yield Problem(
            f"{where}.between", Phrase("are both hollow", refs=refs), Phrase("one of them has a positive radius")
        )
    elif table.side == "outside" and hollow:
        yield Problem(
            f"{where}.side", Phrase("found outside with a hollow outline"), Phrase("leave side out or write inside")
        )
    elif hollow and r1 + r2 >= 0:
        found = Phrase("the hollow outline is no larger than what", link=hollow[0].link, hollow=hollow[0].name)
        yield Problem(f"{where}.between", found, Phrase("its radius must be the larger one"))
    elif table.side == "inside" and abs(r1) == abs(r2):
        yield Problem(
            f"{where}.side", Phrase("both radii are equal"), Phrase("inside one must be smaller than the other")
        )


def _contact(name: str, table: Contact, one: _Side, two: _Side, names: Names) -> PlacedContact:
    first, second, guide = one.disc, two.disc, one.guide or two.guide
    carrier = ""
    if first and second:
        if table.side == "inside" and first.radius > 0 and second.radius > 0:
            if first.radius > second.radius:
                first = replace(first, radius=-first.radius)
            else:
                second = replace(second, radius=-second.radius)
        if table.rolling:
            both = {first.centre, second.centre}
            others = [n for n, own in names.points.items() if n not in (one.link, two.link) and both <= set(own)]
            others.sort(key=lambda n: n != names.frame)
            carrier = others[0] if others else ""
    discs = (first, second)
    return PlacedContact(name, one.link, two.link, discs, guide, table.side != "right", table.rolling, carrier)


def gears_of(
    file: SceneTables, names: Names, slidings: tuple[SlidingPair, ...], problems: list[Problem]
) -> tuple[PlacedGear, ...]:
    """The gears of a file; what is wrong with them is added to ``problems``."""
    found = []
    for name, table in file.gears.items():
        made = _gear(f"gears.{name}", name, table, file, names, slidings)
        if isinstance(made, PlacedGear):
            found.append(made)
        else:
            problems += made
    return tuple(found)


def _gear(
    where: str, name: str, table: Gear, file: SceneTables, names: Names, slidings: tuple[SlidingPair, ...]
) -> PlacedGear | list[Problem]:
    first, _, part = table.between[0].partition(".")
    second, _, guide = table.between[1].partition(".")
    z1, z2 = table.teeth
    rack = isinstance(z2, str)
    problems = [p for link in (first, second) if (p := names.no_link(f"{where}.between", link))]
    if isinstance(z1, str):
        problems.append(
            Problem(f"{where}.teeth", Phrase("the first is rack"), Phrase("the rack is the second one of between"))
        )
        return problems
    if part or (guide and not rack):
        ref = table.between[0] if part else table.between[1]
        problems.append(
            Problem(f"{where}.between", Phrase("found of name", name=ref), Phrase("a wheel is named by its link alone"))
        )
    elif guide and not problems:
        problems += [p for p in [names.no_guide(f"{where}.between", table.between[1])] if p]
    for z in (z1, z2):
        if not isinstance(z, str) and (z == 0 or not float(z).is_integer()):
            wanted = Phrase("write a number of teeth negative for internal")
            problems.append(Problem(f"{where}.teeth", Phrase("found value", value=f'{z:g}'), wanted))
    if rack and z1 < 0:
        wanted = Phrase("the wheel of a rack has external teeth")
        problems.append(Problem(f"{where}.teeth", Phrase("found with a rack", teeth=f'{z1:g}'), wanted))
    if not isinstance(z2, str):
        if z1 < 0 and z2 < 0:
            problems.append(
                Problem(f"{where}.teeth", Phrase("both have internal teeth"), Phrase("one of them has external teeth"))
            )
        elif min(z1, z2) < 0 <= z1 + z2:
            wanted = Phrase("a ring has more teeth than what runs")
            problems.append(Problem(f"{where}.teeth", Phrase("found and", teeth=f'{z1:g}', other=f'{z2:g}'), wanted))
    if first == second:
        problems.append(
            Problem(f"{where}.between", Phrase("link meshes with itself", first=first), Phrase("name two links"))
        )
    if table.carrier is not None and (missing := names.no_link(f"{where}.carrier", table.carrier)):
        problems.append(missing)
    elif table.carrier in (first, second):
        wanted = Phrase("name the link that holds both axes")
        problems.append(Problem(f"{where}.carrier", Phrase("link is one of the wheels", carrier=table.carrier), wanted))
    if problems:
        return problems
    if "" in names.unsure or any(n not in names.points for n in (first, second)):
        return []
    moving = [n for n in file.links if n not in (first, second)]
    candidates = [table.carrier] if table.carrier else [n for n in (names.frame, *moving) if n not in (first, second)]
    for carrier in candidates:
        one = _axis(names, first, carrier)
        if rack:
            pair = next((s for s in slidings if {s.link, s.on} == {second, carrier}), None)
            if one and pair:
                return PlacedGear(name, (first, second), (z1, None), carrier, (one, ""), guide, pair.key)
            continue
        two = _axis(names, second, carrier)
        if one and two and one != two:
            return PlacedGear(name, (first, second), (z1, float(z2)), carrier, (one, two))
    held = Phrase("the wheel's axis and the rack's slide") if rack else Phrase("both axes")
    if table.carrier:
        key = "it shares a point with a link and slides" if rack else "it shares a point with each of two links"
        return [Problem(f"{where}.carrier", Phrase("link does not hold", carrier=table.carrier, held=held),
                        Phrase(key, first=first, second=second))]
    return [Problem(where, Phrase("no link holds of wheels and", held=held, first=first, second=second),
                    Phrase("pin both wheels to one carrier and name"))]


def _axis(names: Names, wheel: str, carrier: str) -> str:
    """The point that a wheel and its carrier share."""
    own = names.points.get(carrier, ())
    return next((p for p in names.points.get(wheel, ()) if p in own), "")


def wrong_distances(
    contacts: tuple[PlacedContact, ...], gears: tuple[PlacedGear, ...], slidings: tuple[SlidingPair, ...],
    points: Mapping[str, Mapping[str, complex]], guides: Mapping[str, Mapping[str, PlacedGuide]], metres: float,
) -> Iterator[Problem]:
    """Wheels whose carrier does not hold them as far apart as their radii say, or at no distance; pitch lines that are
    not parallel to their slide; centres on the other body."""
    for c in contacts:
        if not c.flat and c.carrier:
            one, two = c.round
            held = abs(points[c.carrier][two.centre] - points[c.carrier][one.centre])
            wanted = abs(one.radius + two.radius)
            if abs(held - wanted) > AGREE * max(abs(one.radius), abs(two.radius)):
                yield Problem(
                    f"contacts.{c.name}",
                    Phrase(
                        "link holds the centres apart the radii make",
                        carrier=c.carrier,
                        held=f"{held / metres:.10g}",
                        wanted=f"{wanted / metres:.10g}",
                    ),
                    Phrase("correct a radius or the distance"),
                )
        if not c.flat and c.round[0].centre == c.round[1].centre:
            yield Problem(
                f"contacts.{c.name}", Phrase("both outlines have the same centre"), Phrase("two centres lie apart")
            )
    for g in gears:
        own = points[g.carrier]
        if not g.is_rack:
            if abs(own[g.axes[1]] - own[g.axes[0]]) == 0:
                yield Problem(
                    f"gears.{g.name}", Phrase("both axes lie at the same place"), Phrase("two wheels have axes apart")
                )
            continue
        height, tilt, far = rack_place(g, slidings, points, guides)
        if abs(tilt) > AGREE:
            yield Problem(f"gears.{g.name}", Phrase("the pitch line is not parallel to the", slide=g.slide),
                          Phrase("name a guide of link along which it", wheels=g.wheels[1]))
        elif abs(height) <= AGREE * max(far, 1e-300):
            yield Problem(f"gears.{g.name}", Phrase("the wheel's axis lies on the pitch line"),
                          Phrase("the distance of the two is the radius"))


def drawn_apart(
    contacts: tuple[PlacedContact, ...], bodies: Mapping[str, Placement], places: Mapping[str, complex],
    tolerance: float, metres: float,
) -> Iterator[Problem]:
    """Outlines that do not touch where given places put them: centres too far apart, or not a radius off the face, on
    its side; ``places`` are those in the world (m)."""
    for c in contacts:
        spots = [places.get(d.centre) for d in c.round]
        known = [z for z in spots if z is not None]
        if len(known) < len(spots):
            continue
        if not c.flat:
            found, wanted = abs(known[1] - known[0]), abs(c.round[0].radius + c.round[1].radius)
            key = "puts the centres apart"
        else:
            body, guide = bodies[c.face], bodies[c.face].guides.get(c.guide)
            local = body.in_own_axes(known[0])
            if guide is None or local is None:
                continue
            found, wanted = dot(local - guide.through, guide.direction * c.normal_to_face), c.round[0].radius
            key = "puts the centre to the left of the face" if c.left else "puts the centre to the right of the face"
        if abs(found - wanted) > tolerance:
            drawn = Phrase(key, distance=f"{found / metres:.10g}", given=f"{wanted / metres:.10g}")
            yield Problem(
                f"contacts.{c.name}",
                Phrase("what is drawn", value=drawn),
                Phrase("correct a place a radius or the side"),
            )


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
