"""pylinkage: mechanisms as JSON (``mechanism_to_dict``), and the older linkages as lists of joints.

A mechanism has joints with their places (ground, revolute, prismatic with axis and line, tracker) and links with the
joints that they have; one of the type driver turns about its motor joint.  A linkage has joints that refer to those
before them: Static, Crank (distance, angle a step), Fixed (distance and angle from one, against the line to another),
Revolute or Pivot (two distances), Linear (a distance from one, on the line of two others).
"""

from __future__ import annotations

import cmath
import json
import math
from collections.abc import Sequence

from graphkin.errors import CallError, Problem
from graphkin.exchange.bodies import FRAME, Bodies, BodyDrive, BodySlide, number
from graphkin.files import OwnTables, Tables
from graphkin.plane import cross_arcs
from graphkin.words import Phrase

__all__ = ["read_pylinkage", "write_pylinkage"]

STEP = math.tau / 360
"""rad: what a driver turns in a step, where nothing is said; a step is taken for a second."""


def read_pylinkage(text: str, title: str) -> Bodies:
    """The bodies of a file.  Raises CallError where it is none."""
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise CallError(
            Problem(title, Phrase("is not json", error=error), Phrase("save it from pylinkage anew"))
        ) from None
    if not isinstance(data, dict) or not isinstance(data.get("joints"), list):
        raise CallError(Problem(title, Phrase("has no list of joints"), Phrase("a file of pylinkage has joints")))
    made = Bodies(str(data.get("name") or title)[:200])
    try:
        if isinstance(data.get("links"), list):
            _mechanism(made, data)
        else:
            _linkage(made, data["joints"])
    except (KeyError, TypeError, ValueError, AttributeError, IndexError, ArithmeticError) as error:
        raise CallError(
            Problem(title, Phrase("is no mechanism of pylinkage", error=f"{error!r:.100}"), Phrase("save it anew"))
        ) from None
    return made


def _mechanism(made: Bodies, data: Tables) -> None:
    points: dict[str, str] = {}
    sliding: dict[str, OwnTables] = {}
    fixed = {j["id"] for j in data["joints"] if j.get("type") == "ground"}
    fixed |= {str(link.get("motor_joint")) for link in data["links"] if "driver" in str(link.get("type"))}
    fixed |= {key for link in data["links"] if link.get("type") == "ground" for key in link.get("joints", ())}
    trackers = [j for j in data["joints"] if j.get("type") == "tracker"]
    for joint in data["joints"]:
        x, y = joint.get("position") or (None, None)
        if x is None or y is None:
            raise ValueError(Phrase("joint has no place", joint=joint['id']))
        points[joint["id"]] = made.point(str(joint.get("name") or joint["id"]), complex(float(x), float(y)))
        if joint.get("type") == "prismatic":
            sliding[joint["id"]] = joint
    made.body(FRAME, [points[k] for k in points if k in fixed])
    for link in data["links"]:
        if link.get("type") == "ground":
            continue
        own = [points[k] for k in link.get("joints", ()) if k in points]
        own += [points[t["id"]] for t in trackers if {t["ref_joint1_id"], t["ref_joint2_id"]} <= set(link["joints"])]
        name = made.body(str(link.get("name") or link["id"]), dict.fromkeys(own))
        if "driver" in str(link.get("type")):
            made.drives.append(BodyDrive(name, float(link.get("angular_velocity", STEP))))
            if link["type"] == "arc_driver":
                made.left.append(f"ends of the arc of {name}")
    for key, joint in sliding.items():
        line = complex(*map(float, joint.get("line_point", (0, 0))))
        axis = complex(*map(float, joint.get("axis", (1, 0))))
        holders = [n for n, own in made.bodies.items() if n != FRAME and points[key] in own]
        if holders:
            made.slides.append(BodySlide(holders[0], points[key], FRAME, line, cmath.phase(axis), turns=True))
        else:
            made.lost.append(f"slide of joint {key} (no link has it)")


def _linkage(made: Bodies, joints: Sequence[Tables]) -> None:
    """Bars are found from what joints refer to; what refers twice to the same pair belongs to one plate."""
    points: dict[str, str] = {}
    fixed: list[str] = []
    bars: dict[frozenset[str], list[str]] = {}
    lines: list[tuple[str, str, str]] = []

    def refer(value: object) -> str:
        if isinstance(value, dict) and "ref" not in value and "x" in value:  # a static one that stands here alone
            name = f"S{len(points)}"
            points[name] = made.point(name, complex(float(value["x"]), float(value["y"])))
            fixed.append(name)
            return name
        name = str(value["ref"] if isinstance(value, dict) else value)
        if name not in points:
            raise ValueError(Phrase("joint is not there", name=name))
        return name

    def join(name: str, *others: str) -> str:
        """The body of a new point that keeps its distances from others."""
        own = frozenset(others)
        if len(others) == 2 and own <= set(fixed):
            fixed.append(name)
            return FRAME
        held = next((b for b in bars.values() if len(others) == 2 and own <= set(b)), None)
        if held is not None:
            held.append(name)
            return ""
        bars[frozenset((*others, name))] = [*others, name]
        return ""

    for joint in joints:
        kind, name = str(joint["type"]).lower(), str(joint.get("name") or f"J{len(points)}")
        first = refer(joint["joint0"]) if joint.get("joint0") is not None else ""
        second = refer(joint["joint1"]) if joint.get("joint1") is not None else ""
        here = complex(float(joint.get("x") or 0.0), float(joint.get("y") or 0.0))
        if kind == "static":
            points[name] = made.point(name, here)
            fixed.append(name)
            continue
        if not first or (not second and kind != "crank"):
            raise ValueError(Phrase("joint refers to no other", name=name))
        one = made.places[points[first]]
        if kind == "crank":
            way = here - one if joint.get("x") is not None else complex(float(joint["distance"]))
            points[name] = made.point(name, one + float(joint.get("distance", abs(way))) * way / abs(way))
            join(name, first)
            crank = frozenset((first, name))
            made.drives.append(BodyDrive("|".join(sorted(crank)), float(joint.get("angle", STEP))))
            continue
        two = made.places[points[second]]
        if kind == "fixed":
            turn = cmath.phase(two - one) + float(joint["angle"])
            points[name] = made.point(name, one + cmath.rect(float(joint["distance"]), turn))
            join(name, first, second)
        elif kind in ("revolute", "pivot"):
            r, s = float(joint["distance0"]), float(joint["distance1"])
            both = cross_arcs(one, r, two, s)
            if both is None:
                raise ValueError(Phrase("the bars of do not meet", name=name))
            points[name] = made.point(name, min(both, key=lambda z: abs(z - here)))
            join(name, first)
            join(name, second)
        elif kind in ("linear", "prismatic"):
            third = refer(joint["joint2"])
            points[name] = made.point(name, here)
            join(name, first)
            lines.append((name, second, third))
        else:
            made.lost.append(f"joint {name} of the kind {joint['type']}")
    made.body(FRAME, [points[k] for k in dict.fromkeys(fixed)])
    names: dict[str, str] = {}
    for key, own in bars.items():
        names["|".join(sorted(key))] = made.body("".join(points[k] for k in own)[:20], [points[k] for k in own])
    made.drives = [BodyDrive(names[d.body], d.rate) for d in made.drives if d.body in names]
    for name, one_end, two_end in lines:
        a, b = made.places[points[one_end]], made.places[points[two_end]]
        held = next((n for n, own in made.bodies.items() if {points[one_end], points[two_end]} <= set(own)), None)
        holders = [n for n, own in made.bodies.items() if points[name] in own]
        if held is None or not holders:
            made.lost.append(f"joint {name} (its line belongs to no link)")
        else:
            made.slides.append(BodySlide(holders[0], points[name], held, a, cmath.phase(b - a), turns=True))


def write_pylinkage(bodies: Bodies) -> str:
    """The JSON of a mechanism; what it cannot hold is added to ``lost`` or ``left``."""
    bodies = bodies.with_pins()
    fixed = set(bodies.bodies.get(FRAME, ()))
    slides = {s.point: s for s in bodies.slides}
    joints: list[OwnTables] = []
    for point, place in bodies.places.items():
        slide = slides.get(point)
        at = {"id": point, "position": [number(place.real), number(place.imag)]}
        if slide is None:
            joints.append(at | {"type": "ground" if point in fixed else "revolute"})
            continue
        if slide.on != FRAME:
            bodies.lost.append(f"slide of {slide.body} on {slide.on} (its line moves)")
        axis = cmath.rect(1.0, slide.angle)
        line = [number(slide.through.real), number(slide.through.imag)]
        at |= {"type": "prismatic", "axis": [axis.real, axis.imag]}
        joints.append(at | {"line_point": line, "slide_distance": 0})
    pivots = [p for p in bodies.places if p in fixed]
    links: list[OwnTables] = [{"id": "ground", "type": "ground", "joints": pivots}]
    bodies.left += [f"unit of length {bodies.unit}"] if bodies.unit != "mm" else []
    driven = {d.body: d for d in bodies.drives if not d.point}
    bodies.lost += [f"driver of {d.body}" for d in bodies.drives if d.point]
    for name, own in bodies.bodies.items():
        if name == FRAME or (len(own) < 2 and name not in driven):
            continue
        link: OwnTables = {"id": name, "type": "link", "joints": own}
        pivot = next((p for p in own if p in fixed), None)
        if name in driven and (pivot is None or len(own) < 2):
            bodies.lost.append(f"driver of {name} (it has no two points)")
        elif name in driven and pivot is not None:
            way = next(bodies.places[p] - bodies.places[pivot] for p in own if p != pivot)
            link |= {"type": "driver", "motor_joint": pivot, "angular_velocity": number(driven[name].rate),
                     "initial_angle": cmath.phase(way)}  # fmt: skip
        links.append(link)
    data = {"name": bodies.title, "joints": joints, "links": links, "ground": "ground"}
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"
