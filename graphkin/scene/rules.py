"""Rules that a file's entries must keep among themselves, before any length is looked at.

Whether what a file gives twice (a length and two drawn points, an angle and a direction) agrees.
"""

from __future__ import annotations

import unicodedata

from graphkin.errors import Problem
from graphkin.plane import cross, degrees
from graphkin.scene.names import Flaws, Names
from graphkin.scene.placing import DrawnPosition, Placement, circle_of_references, place_of, running_points, travel_of
from graphkin.scene.tables import Compass, Polar, SceneTables
from graphkin.words import Phrase, Wording

__all__ = [
    "disagreements",
    "not_held",
    "nowhere_placed",
    "placed_twice",
    "too_far_apart",
    "unwritable_texts",
    "wrong_own_points",
]


def unwritable_texts(file: SceneTables) -> list[Problem]:
    """Texts that cannot be written on one line of a sheet."""
    found = []
    for key in ("title", "title_zh", "source", "source_zh"):
        text = getattr(file, key)
        if any(unicodedata.category(c) in ("Cc", "Cs", "Cn", "Zl", "Zp") for c in text):
            found.append(
                Problem(
                    key, Phrase("holds a control character or a line break"), Phrase("write one line of plain text")
                )
            )
    return found


def wrong_own_points(file: SceneTables, names: Names, flaws: Flaws) -> list[Problem]:
    """What is wrong with the own points of the links."""
    found = []
    if names.frame in file.links:
        found.append(
            Problem(
                "frame.name",
                Phrase("the frame is named as a moving link", frame=names.frame),
                Phrase("give the frame a name of its own"),
            )
        )
    for name, link in file.links.items():
        where, own = f"links.{name}", link.points
        if len(own) > 2:
            found.append(
                Problem(
                    f"{where}.points",
                    Phrase("found names", count=len(own), name=', '.join(own[:6])),
                    Phrase("two at most place in at x y", name=own[2], other=own[2]),
                )
            )
        twice = sorted({p for p in own if own.count(p) > 1})
        if twice:
            found.append(
                Problem(
                    f"{where}.points",
                    Phrase("stands there twice", name=twice[0]),
                    Phrase("a bar has two different points"),
                )
            )
        if link.length is not None and len(own) < 2 and name not in names.unsure:
            found.append(
                Problem(
                    f"{where}.length",
                    Phrase(
                        "found with own points" if len(own) != 1 else "found with own point",
                        length=f"{link.length:g}",
                        count=len(own),
                    ),
                    Phrase("a length needs two names in points"),
                )
            )
        if not own and link.on is None and name not in names.unsure and not flaws.under("links", name, "on"):
            found.append(
                Problem(
                    where,
                    Phrase("has neither points nor on so nothing places"),
                    Phrase("write points a b or on for a"),
                )
            )
    return found


def nowhere_placed(file: SceneTables, names: Names, flaws: Flaws) -> list[Problem]:
    """Points that ``at`` and ``guides`` refer to and that are nowhere placed."""
    found: list[Problem | None] = []
    drawn_lost = flaws.under("drawn")
    for name, link in file.links.items():
        for point, entry in link.at.items():
            where = f"links.{name}.at.{point}"
            if isinstance(entry, Polar):
                refs = [("from", entry.origin)] + ([("toward", entry.toward)] if entry.toward else [])
                found += [names.no_point_of(f"{where}.{key}", name, ref) for key, ref in refs]
            elif isinstance(entry, Compass):
                found += [names.no_point_of(f"{where}.from", name, ref) for ref in entry.origins]
            elif entry == "drawn" and point not in file.drawn and point not in file.frame.points and not drawn_lost:
                found.append(
                    Problem(
                        where,
                        Phrase("is drawn but is not in drawn", point=point),
                        Phrase("write x y in drawn", point=point),
                    )
                )
        circle = circle_of_references(link)
        if circle:
            found.append(
                Problem(
                    f"links.{name}.at",
                    Phrase("are placed from one another", points=', '.join(circle)),
                    Phrase("place one of them by x y or"),
                )
            )
    tables = [(f"links.{n}", n, link.guides) for n, link in file.links.items()]
    for where, name, guides in (*tables, ("frame", names.frame, file.frame.guides)):
        for guide, rail in guides.items():
            here, aim = f"{where}.guides.{guide}", rail.toward
            if rail.through is None:
                hint = Phrase("write a point of the guide a circular")
                found.append(Problem(f"{here}.through", Phrase("is missing"), hint))
            if isinstance(rail.through, str):
                found.append(names.no_point_of(f"{here}.through", name, rail.through))
            if rail.angle is None and aim is None:
                found.append(
                    Problem(here, Phrase("has no direction"), Phrase("write angle in degrees or toward a point"))
                )
            world = {*file.drawn, *file.frame.points}
            if aim and aim not in world and not drawn_lost and names.no_point_of("", name, aim):
                found.append(
                    Problem(
                        f"{here}.toward",
                        Phrase("is no point of link nor fixed or", point=aim, name=name),
                        Phrase("write x y in drawn or the direction", point=aim),
                    )
                )
    return [p for p in found if p]


def not_held(group: tuple[str, ...], names: Names) -> Problem:
    hint = Phrase("share a point with another link or slide", frame=names.frame)
    if len(group) == 1:
        return Problem(f"links.{group[0]}", Phrase("nothing holds this link"), hint)
    return Problem(Phrase("links", links=", ".join(group)), Phrase("nothing joins these links to the frame"), hint)


def placed_twice(position: DrawnPosition) -> list[Problem]:
    """Points that the file places twice in one link, or fixes and draws, at different places."""
    found = []
    for body in position.bodies.values():
        for point in body.own:
            local = place_of(body.where, body.at.get(point), position.metres, body.local)
            if isinstance(local, complex) and point in body.local:
                own = body.local[point]
                if abs(local - own) > position.tolerance:
                    found.append(
                        Problem(
                            f"{body.where}.at.{point}",
                            Phrase(
                                "puts it at but as an own point",
                                pair=_pair(local, position.metres),
                                other=_pair(own, position.metres),
                            ),
                            Phrase("leave one of the two out or correct"),
                        )
                    )
        for point, place in body.local.items() if body.where == "frame" else ():
            drawn = position.drawn.get(point, place)
            if abs(drawn - place) > position.tolerance:
                found.append(
                    Problem(
                        f"drawn.{point}",
                        Phrase(
                            "found but it is a fixed point at",
                            pair=_pair(drawn, position.metres),
                            other=_pair(place, position.metres),
                        ),
                        Phrase("leave it out or correct it"),
                    )
                )
    return found


FARTHEST = 4e10
"""So many times the shortest bar places may lie away: beyond, sixteen digits leave less than five of the bar."""


def too_far_apart(position: DrawnPosition) -> list[Problem]:
    """Places so far away that the digits of a number do not hold a bar of the mechanism beside them."""
    bars = [(b.length, b) for b in position.bodies.values() if b.length]
    if not bars:
        return []
    short, body = min(bars, key=lambda bar: bar[0])
    places = [(abs(z), f"{b.where}.at.{p}" if b.where != "frame" else f"frame.points.{p}")
              for b in position.bodies.values() for p, z in b.local.items() if p not in b.own]  # fmt: skip
    places += [(abs(g.through), f"{b.where}.guides.{n}") for b in position.bodies.values()
               for n, g in b.guides.items() if n]  # fmt: skip
    places += [(length, f"links.{b.name}.length") for length, b in bars]
    far, where = max(places, key=lambda place: place[0])
    if far <= FARTHEST * short:
        return []
    metres = position.metres
    said = Phrase(
        "lies away beside a bar of link", distance=f"{far / metres:.3g}", short=f"{short / metres:.3g}", body=body.name
    )
    return [Problem(where, said, Phrase("too far apart sixteen digits hold at most", farthest=f'{FARTHEST:.0e}'))]


def disagreements(position: DrawnPosition) -> list[Problem]:
    """What is given twice and differs by more than 1e-6 of the size, both values named."""
    found = [p for body in position.bodies.values() for p in _points_apart(position, body)]
    for pair in position.slidings:
        slider, rail = position.bodies[pair.link], position.bodies[pair.on]
        guide = rail.guides.get(pair.guide)
        if guide and slider.turn is not None and rail.turn is not None:
            seen = slider.turn / (rail.turn * guide.direction)
            if _apart(position, seen, pair.turn, slider, rail):
                found.append(_angle_problem(f"links.{pair.link}.angle_on", pair.turn, seen))
    for name, guide_name, what, place in running_points(position):
        rail = position.bodies[name]
        guide = rail.guides.get(guide_name)
        local = None if place is None else rail.in_own_axes(place)
        if guide and local is not None:
            beside = abs(cross(guide.direction, local - guide.through))
            if beside > position.tolerance * _reach(rail, local):
                ref = f"{name}.{guide_name}" if guide_name else name
                where = f"links.{what}.on" if what in position.bodies else f"pins.{what}.in"
                found.append(
                    Problem(
                        where,
                        Phrase(
                            "the given places put it beside the guide",
                            beside=f"{beside / position.metres:.6g}",
                            ref=ref,
                        ),
                        Phrase("correct a coordinate or the guide"),
                    )
                )
    for link, base, turn in position.angles:
        driven, from_body = position.bodies[link], position.bodies[base]
        if driven.turn is not None and from_body.turn is not None:
            seen = driven.turn / from_body.turn
            if _apart(position, seen, turn, driven, from_body):
                found.append(_angle_problem(Phrase("driver.angle of link", link=link), turn, seen))
    for key, travel in position.travels.items():
        seen_travel = travel_of(position, key)
        if seen_travel is not None and abs(seen_travel - travel) > position.tolerance:
            found.append(
                Problem(
                    Phrase("driver.travel of", key=key),
                    Phrase(
                        "found but the given places make it",
                        start=f"{travel / position.metres:.10g}",
                        value=f"{seen_travel / position.metres:.10g}",
                    ),
                    Phrase("one of the two is wrong"),
                )
            )
    return found


def _apart(position: DrawnPosition, one: complex, other: complex, a: Placement, b: Placement) -> bool:
    return abs(one - other) * min(a.arm, b.arm, position.size) > position.tolerance


def _reach(body: Placement, local: complex) -> float:
    """How much an error of the places that gave a link's direction grows out at ``local``."""
    return max(1.0, abs(local) / body.arm)


def _angle_problem(where: Wording, given: complex, seen: complex) -> Problem:
    return Problem(
        where,
        Phrase(
            "found deg but the given places make it", degrees=f"{degrees(given):.10g}", other=f"{degrees(seen):.10g}"
        ),
        Phrase("one of the two is wrong"),
    )


def _points_apart(position: DrawnPosition, body: Placement) -> list[Problem]:
    """Points of one link whose places in the link and in the world differ."""
    own, m = body.own, position.metres
    if len(own) == 2 and body.length is not None and all(p in position.given for p in own):
        drawn = abs(position.given[own[1]] - position.given[own[0]])
        if abs(drawn - body.length) > position.tolerance:
            return [
                Problem(
                    f"links.{body.name}.length",
                    Phrase(
                        "found but and are given apart",
                        length=f"{body.length / m:.10g}",
                        name=own[0],
                        other=own[1],
                        value=f"{drawn / m:.10g}",
                    ),
                    Phrase("one of the two is wrong"),
                )
            ]
    found = []
    for point, local in body.local.items():
        place = body.world(local)
        if place is None or point not in position.given:
            continue
        drawn_at = position.given[point]
        if abs(drawn_at - place) > position.tolerance * _reach(body, local):
            found.append(
                Problem(
                    Phrase("point", point=point),
                    Phrase(
                        "link puts it at but it is given",
                        body=body.name,
                        pair=_pair(place, m),
                        other=_pair(drawn_at, m),
                    ),
                    Phrase("one of the two is wrong"),
                )
            )
    return found


def _pair(z: complex, metres: float) -> str:
    return f"[{z.real / metres:.8g}, {z.imag / metres:.8g}]"
