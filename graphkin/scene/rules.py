"""Rules that a file's entries must keep among themselves, before any length is looked at.

Whether what a file gives twice (a length and two drawn points, an angle and a direction) agrees.
"""

from __future__ import annotations

import unicodedata

from graphkin.errors import Problem
from graphkin.plane import cross, degrees
from graphkin.scene.drawn_position import DrawnPosition, running_points, travel_of
from graphkin.scene.names import Flaws, Names
from graphkin.scene.placing import Placement, circle_of_references, place_of
from graphkin.scene.tables import Compass, Polar, SceneTables

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
            found.append(Problem(key, "holds a control character or a line break", "write one line of plain text"))
    return found


def wrong_own_points(file: SceneTables, names: Names, flaws: Flaws) -> list[Problem]:
    """What is wrong with the own points of the links."""
    found = []
    if names.frame in file.links:
        found.append(
            Problem(
                "frame.name",
                f'the frame is named "{names.frame}" as a moving link is',
                "give the frame a name of its own",
            )
        )
    for name, link in file.links.items():
        where, own = f"links.{name}", link.points
        if len(own) > 2:
            found.append(
                Problem(
                    f"{where}.points",
                    f"found {len(own)} names ({', '.join(own[:6])})",
                    f"two at most; place {own[2]} in at = {{ {own[2]} = [x, y] }}",
                )
            )
        twice = sorted({p for p in own if own.count(p) > 1})
        if twice:
            found.append(Problem(f"{where}.points", f"{twice[0]} stands there twice", "a bar has two different points"))
        if link.length is not None and len(own) < 2 and name not in names.unsure:
            found.append(
                Problem(
                    f"{where}.length",
                    f"found {link.length:g} with {len(own)} own point{'' if len(own) == 1 else 's'}",
                    "a length needs two names in points",
                )
            )
        if not own and link.on is None and name not in names.unsure and not flaws.under("links", name, "on"):
            found.append(
                Problem(
                    where,
                    "has neither points nor on, so nothing places or holds it",
                    'write points = ["A", "B"], or on = "..." for a link that slides',
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
                    Problem(where, f'is "drawn", but {point} is not in [drawn]', f"write {point} = [x, y] in [drawn]")
                )
        circle = circle_of_references(link)
        if circle:
            found.append(
                Problem(
                    f"links.{name}.at",
                    f"{', '.join(circle)} are placed from one another",
                    "place one of them by [x, y] or from an own point of the link",
                )
            )
    tables = [(f"links.{n}", n, link.guides) for n, link in file.links.items()]
    for where, name, guides in (*tables, ("frame", names.frame, file.frame.guides)):
        for guide, rail in guides.items():
            here, aim = f"{where}.guides.{guide}", rail.toward
            if rail.through is None:
                hint = "write a point of the guide; a circular slot has centre and r"
                found.append(Problem(f"{here}.through", "is missing", hint))
            if isinstance(rail.through, str):
                found.append(names.no_point_of(f"{here}.through", name, rail.through))
            if rail.angle is None and aim is None:
                found.append(Problem(here, "has no direction", "write angle = ... in degrees, or toward = a point"))
            world = {*file.drawn, *file.frame.points}
            if aim and aim not in world and not drawn_lost and names.no_point_of("", name, aim):
                found.append(
                    Problem(
                        f"{here}.toward",
                        f"{aim} is no point of link {name}, nor fixed or drawn",
                        f"write {aim} = [x, y] in [drawn], or the direction as angle",
                    )
                )
    return [p for p in found if p]


def not_held(group: tuple[str, ...], names: Names) -> Problem:
    hint = f"share a point with another link, or slide; the frame is link {names.frame}"
    if len(group) == 1:
        return Problem(f"links.{group[0]}", "nothing holds this link", hint)
    return Problem("links " + ", ".join(group), "nothing joins these links to the frame", hint)


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
                            f"puts it at {_pair(local, position.metres)}, "
                            f"but as an own point it is at {_pair(own, position.metres)}",
                            "leave one of the two out, or correct it",
                        )
                    )
        for point, place in body.local.items() if body.where == "frame" else ():
            drawn = position.drawn.get(point, place)
            if abs(drawn - place) > position.tolerance:
                found.append(
                    Problem(
                        f"drawn.{point}",
                        f"found {_pair(drawn, position.metres)}, but it is a fixed "
                        f"point at {_pair(place, position.metres)}",
                        "leave it out, or correct it",
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
    said = f"lies {far / metres:.3g} away, beside a bar of {short / metres:.3g} (link {body.name})"
    return [Problem(where, said, f"too far apart: sixteen digits hold at most {FARTHEST:.0e} times the shortest bar")]


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
                        f"the given places put it {beside / position.metres:.6g} beside the guide {ref}",
                        "correct a coordinate, or the guide",
                    )
                )
    for link, base, turn in position.angles:
        driven, from_body = position.bodies[link], position.bodies[base]
        if driven.turn is not None and from_body.turn is not None:
            seen = driven.turn / from_body.turn
            if _apart(position, seen, turn, driven, from_body):
                found.append(_angle_problem(f"driver.angle of link {link}", turn, seen))
    for key, travel in position.travels.items():
        seen_travel = travel_of(position, key)
        if seen_travel is not None and abs(seen_travel - travel) > position.tolerance:
            found.append(
                Problem(
                    f"driver.travel of {key}",
                    f"found {travel / position.metres:.10g}, but the given "
                    f"places make it {seen_travel / position.metres:.10g}",
                    "one of the two is wrong",
                )
            )
    return found


def _apart(position: DrawnPosition, one: complex, other: complex, a: Placement, b: Placement) -> bool:
    return abs(one - other) * min(a.arm, b.arm, position.size) > position.tolerance


def _reach(body: Placement, local: complex) -> float:
    """How much an error of the places that gave a link's direction grows out at ``local``."""
    return max(1.0, abs(local) / body.arm)


def _angle_problem(where: str, given: complex, seen: complex) -> Problem:
    return Problem(
        where,
        f"found {degrees(given):.10g} deg, but the given places make it {degrees(seen):.10g} deg",
        "one of the two is wrong",
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
                    f"found {body.length / m:.10g}, but {own[0]} and {own[1]} are given {drawn / m:.10g} apart",
                    "one of the two is wrong",
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
                    f"point {point}",
                    f"link {body.name} puts it at {_pair(place, m)}, but it is given at {_pair(drawn_at, m)}",
                    "one of the two is wrong",
                )
            )
    return found


def _pair(z: complex, metres: float) -> str:
    return f"[{z.real / metres:.8g}, {z.imag / metres:.8g}]"
