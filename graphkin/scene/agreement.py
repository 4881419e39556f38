"""Whether what a file gives twice (a length and two drawn points, an angle and a direction) agrees."""

from __future__ import annotations

from graphkin.errors import Problem
from graphkin.plane import cross, degrees
from graphkin.scene.placing import Body, place_of
from graphkin.scene.pose import Position, running_points, travel_of

__all__ = ["disagreements", "placed_twice"]


def placed_twice(position: Position) -> list[Problem]:
    """Points that the file places twice in one link, or fixes and draws, at different places."""
    found = []
    for body in position.bodies.values():
        for point in body.own:
            local = place_of(body.where, body.at.get(point), position.metres, body.local)
            if isinstance(local, complex) and point in body.local:
                own = body.local[point]
                if abs(local - own) > position.tolerance:
                    found.append(Problem(f"{body.where}.at.{point}", f"puts it at {_pair(local, position.metres)}, "
                                         f"but as an own point it is at {_pair(own, position.metres)}",
                                         "leave one of the two out, or correct it"))
        for point, place in body.local.items() if body.where == "frame" else ():
            drawn = position.drawn.get(point, place)
            if abs(drawn - place) > position.tolerance:
                found.append(Problem(f"drawn.{point}", f"found {_pair(drawn, position.metres)}, but it is a fixed "
                                     f"point at {_pair(place, position.metres)}", "leave it out, or correct it"))
    return found


def disagreements(position: Position) -> list[Problem]:
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
                found.append(Problem(where, f"the given places put it {beside / position.metres:.6g} beside the guide "
                                     f"{ref}", "correct a coordinate, or the guide"))
    for link, base, turn in position.angles:
        driven, from_body = position.bodies[link], position.bodies[base]
        if driven.turn is not None and from_body.turn is not None:
            seen = driven.turn / from_body.turn
            if _apart(position, seen, turn, driven, from_body):
                found.append(_angle_problem(f"driver.angle of link {link}", turn, seen))
    for key, travel in position.travels.items():
        seen_travel = travel_of(position, key)
        if seen_travel is not None and abs(seen_travel - travel) > position.tolerance:
            found.append(Problem(f"driver.travel of {key}", f"found {travel / position.metres:.10g}, but the given "
                                 f"places make it {seen_travel / position.metres:.10g}", "one of the two is wrong"))
    return found


def _apart(position: Position, one: complex, other: complex, a: Body, b: Body) -> bool:
    return abs(one - other) * min(a.arm, b.arm, position.size) > position.tolerance


def _reach(body: Body, local: complex) -> float:
    """How much an error of the places that gave a link's direction grows out at ``local``."""
    return max(1.0, abs(local) / body.arm)


def _angle_problem(where: str, given: complex, seen: complex) -> Problem:
    return Problem(where, f"found {degrees(given):.10g} deg, but the given places make it "
                   f"{degrees(seen):.10g} deg", "one of the two is wrong")


def _points_apart(position: Position, body: Body) -> list[Problem]:
    """Points of one link whose places in the link and in the world differ."""
    own, m = body.own, position.metres
    if len(own) == 2 and body.length is not None and all(p in position.given for p in own):
        drawn = abs(position.given[own[1]] - position.given[own[0]])
        if abs(drawn - body.length) > position.tolerance:
            return [Problem(f"links.{body.name}.length", f"found {body.length / m:.10g}, but {own[0]} and {own[1]} are "
                            f"given {drawn / m:.10g} apart", "one of the two is wrong")]
    found = []
    for point, local in body.local.items():
        place = body.world(local)
        if place is None or point not in position.given:
            continue
        drawn_at = position.given[point]
        if abs(drawn_at - place) > position.tolerance * _reach(body, local):
            found.append(Problem(f"point {point}", f"link {body.name} puts it at {_pair(place, m)}, but it is given at "
                                 f"{_pair(drawn_at, m)}", "one of the two is wrong"))
    return found


def _pair(z: complex, metres: float) -> str:
    return f"[{z.real / metres:.8g}, {z.imag / metres:.8g}]"
