"""Files of links with connectors: Linkage (.linkage2), and mechanisms of pylinkage (JSON).

- Linkage: connectors with places, elements that join them, anchors, sliders, motors, in the form of its own reader and
  writer (``LinkageDoc.cpp``): ``connector`` with id, x, y, anchor, input, rpm, slider with two ``slidelimit``;
  ``element`` (also ``Link``) with its connectors; an actuator is a bar whose length is driven.  Coordinates are in
  millimetres whatever units are shown.  An anchor that is an input turns, once a minute times rpm, counter-clockwise
  positive, the element that has it.
- pylinkage (``mechanism_to_dict``): joints with their places (ground, revolute, prismatic with axis and line, tracker)
  and links with the joints that they have; one of the type driver turns about its motor joint.
"""

from __future__ import annotations

import cmath
import json
import math
from xml.etree import ElementTree

from graphkin.errors import CallError
from graphkin.exchange.bodies import FRAME, Bodies, BodySlide, number
from graphkin.exchange.constructions import STEP, construct_linkage
from graphkin.files import OwnTables, Tables
from graphkin.words import Phrase, from_others

RPM = 15.0
"""Where a motor of Linkage says no speed."""


# Linkage


def read_linkage2(text: str, title: str) -> Bodies:
    """The bodies of a file.  Raises CallError where it is none."""
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise CallError.of(title, "is not xml", "save it from linkage anew", error=from_others(error)) from None
    if root.tag != "linkage2":
        raise CallError.of(title, "begins with", "a file of linkage begins with linkage2", tag=root.tag)
    made = Bodies(title)
    elements = [e for e in root if e.tag in ("element", "Link", "link")]
    used = {c.get("id") for e in elements for c in e}
    nodes = {c.get("id", ""): c for c in root if c.tag == "connector"}
    for key, node in nodes.items():
        if key in used:
            made.point(node.get("name") or f"C{key}", complex(_number(node, "x"), _number(node, "y")), key)
        else:
            made.left.append(Phrase("lost connector", name=node.get("name") or key))
    made.body(FRAME, [key for key, node in nodes.items() if node.get("anchor") == "true"])
    names: dict[str, list[str]] = {}
    for element in elements:
        keys = [c.get("id", "") for c in element if c.tag == "connector" and c.get("id") in made.names]
        label = element.get("name") or f"L{element.get('id', '')}"
        if element.get("gear") == "true":
            made.lost.append(Phrase("lost gear", name=label))
        if all(nodes[k].get("anchor") == "true" for k in keys) and keys:
            continue  # part of the frame
        if element.get("actuator") == "true" and len(keys) == 2:
            _cylinder(made, element, label, keys)
            continue
        name = made.body(label, keys)
        for key in keys:
            names.setdefault(key, []).append(name)
    ratios = root.iterfind("ratios/*")
    made.lost += [Phrase("lost ratio", kind=ratio.get("type", "gears")) for ratio in ratios]
    tags = ("fasten", "fastenlink", "fastenconnector")
    fastened = (node for node in (*nodes.values(), *elements)
                if any(map(node.get, tags)) or node.find("fastenconnector") is not None)
    made.lost += [Phrase("lost fastening", name=node.get("name") or node.get("id")) for node in fastened]
    for key, node in nodes.items():
        if node.get("slider") == "true" and key in made.names:
            holders = names.get(key, []) or [FRAME] * (node.get("anchor") == "true")
            _slider(made, node, holders)
        if node.get("anchor") == "true" and node.get("input") == "true":
            if key in names:
                made.drive(names[key][0], _number(node, "rpm", RPM) * math.tau / 60)
            else:
                made.lost.append(Phrase("lost motor", name=node.get("name") or key))
    return made


def _number(node: ElementTree.Element, key: str, usual: float = 0.0) -> float:
    try:
        value = float(node.get(key) or usual)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise CallError.of(f"{node.tag} {node.get('id')}.{key}", f'"{node.get(key)}"', "a number is wanted")
    return value


def _slider(made: Bodies, node: ElementTree.Element, holders: list[str]) -> None:
    """Add a connector that runs on the straight line between two others of one body."""
    limits = [c.get("id", "") for c in node if c.tag == "slidelimit"][:2]
    point = made.names[node.get("id", "")]
    known = len(limits) == 2 and made.names.keys() >= {*limits}
    on = made.holder(limits) if known else None
    if not known or not holders:
        lost = "lost slider limits"
    elif _number(node, "slideradius"):
        lost = "lost slider round"
    elif on is None:
        lost = "lost slider on two"
    elif point in made.bodies[on]:
        lost = "lost slider of guide"
    else:
        start, end = map(made.place, limits)
        made.slides.append(BodySlide(holders[0], point, on, start, cmath.phase(end - start), turns=True))
        return
    made.lost.append(Phrase(lost, name=node.get("name") or node.get("id")))


def _cylinder(made: Bodies, element: ElementTree.Element, label: str, ends: list[str]) -> None:
    """Add a bar whose length is driven: a cylinder about its first end, and a rod that slides in it."""
    start, end = map(made.place, ends)
    cylinder, rod = made.body(f"{label}c", ends[:1]), made.body(f"{label}r", ends[1:])
    made.slides.append(BodySlide(rod, made.names[ends[1]], cylinder, start, cmath.phase(end - start)))
    throw = _number(element, "throw") or abs(end - start)
    # out and in again once a cycle
    made.drive(rod, 2 * throw * _number(element, "cpm", RPM) / 60, made.names[ends[1]])


def write_linkage2(bodies: Bodies) -> str:
    """The text of a file; parts that it cannot hold are added to ``lost``."""
    bodies = bodies.with_pins()
    root = ElementTree.Element("linkage2")
    ElementTree.SubElement(root, "program", units="Millimeters", zoom="1.000000")
    ids = {point: str(k) for k, point in enumerate(bodies.places)}
    fixed = set(bodies.bodies.get(FRAME, ()))
    motors: dict[str, float] = {}
    for (body, point), rate in bodies.drives.items():
        pivot = next((p for p in bodies.bodies.get(body, ()) if p in fixed), "")
        turning = [name for name in bodies.having(pivot) if name != FRAME]
        if point or turning != [body]:  # a motor stands at a pivot, and turns what there is about it
            bodies.lost.append(Phrase("lost driver of", link=body))
        else:
            motors[pivot] = rate * 60 / math.tau
    on_line = {s.point: [p for p in bodies.bodies[s.on] if p != s.point and _on_line(bodies.places[p], s)]
               for s in bodies.slides}
    scale = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8}[bodies.unit]
    for point, place in bodies.places.items():
        here = {"id": ids[point], "name": point, "layer": "4"}
        here |= {"x": repr(place.real * scale), "y": repr(place.imag * scale)}
        if point in fixed:
            here["anchor"] = "true"
        if point in motors:
            here |= {"input": "true", "rpm": repr(motors[point])}
        if point in on_line:
            here["slider"] = "true"
        node = ElementTree.SubElement(root, "connector", here)
        for end in on_line.get(point, [])[-2:]:
            ElementTree.SubElement(node, "slidelimit", id=ids[end])
    for k, (name, points) in enumerate(bodies.bodies.items()):  # the frame too, or its points would be of no link
        element = ElementTree.SubElement(root, "element", id=str(k), name=name, layer="4", linesize="1")
        for point in points:
            ElementTree.SubElement(element, "connector", id=ids[point])
    ElementTree.indent(root, "\t")
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def _on_line(place: complex, slide: BodySlide) -> bool:
    from_line = (place - slide.through) * cmath.rect(1.0, -slide.angle)
    return abs(from_line.imag) <= 1e-9 * max(1.0, abs(from_line))


# pylinkage


def read_pylinkage(text: str, title: str) -> Bodies:
    """The bodies of a file.  Raises CallError where it is none."""
    try:
        data = json.loads(text)
    except RecursionError:
        raise CallError.of(title, "is nested too deeply", "save it from pylinkage anew") from None
    except ValueError as error:
        raise CallError.of(title, "is not json", "save it from pylinkage anew", error=from_others(error)) from None
    if not isinstance(data, dict) or not isinstance(data.get("joints"), list):
        raise CallError.of(title, "has no list of joints", "a file of pylinkage has joints")
    made = Bodies(str(data.get("name") or title)[:200])
    try:
        if isinstance(data.get("links"), list):
            _mechanism(made, data)
        else:
            construct_linkage(made, data["joints"])
    except (KeyError, TypeError, ValueError, AttributeError, IndexError, ArithmeticError) as error:
        reason = from_others(error)
        if isinstance(error, KeyError):
            reason = Phrase("where and what", where=reason, found=Phrase("is missing"))
        elif not isinstance(reason, Phrase):
            reason = type(error).__name__
        raise CallError.of(title, "is no mechanism of pylinkage", "save it anew", error=reason) from None
    return made


def _mechanism(made: Bodies, data: Tables) -> None:
    sliding: dict[str, OwnTables] = {}
    fixed = {j["id"] for j in data["joints"] if j.get("type") == "ground"}
    fixed |= {str(link.get("motor_joint")) for link in data["links"] if "driver" in str(link.get("type"))}
    fixed |= {key for link in data["links"] if link.get("type") == "ground" for key in link.get("joints", ())}
    trackers = [j for j in data["joints"] if j.get("type") == "tracker"]
    for joint in data["joints"]:
        x, y = joint.get("position") or (None, None)
        if x is None or y is None:
            raise ValueError(Phrase("joint has no place", joint=joint['id']))
        made.point(str(joint.get("name") or joint["id"]), complex(float(x), float(y)), joint["id"])
        if joint.get("type") == "prismatic":
            sliding[joint["id"]] = joint
    made.body(FRAME, [key for key in made.names if key in fixed])
    for link in data["links"]:
        if link.get("type") == "ground":
            continue
        joints = link.get("joints", ())
        keys = [*joints, *(t["id"] for t in trackers if {t["ref_joint1_id"], t["ref_joint2_id"]} <= {*joints})]
        name = made.body(str(link.get("name") or link["id"]), keys)
        if "driver" in str(link.get("type")):
            made.drive(name, float(link.get("angular_velocity", STEP)))
            if link["type"] == "arc_driver":
                made.left.append(Phrase("lost arc ends", link=name))
    for key, joint in sliding.items():
        line = complex(*map(float, joint.get("line_point", (0, 0))))
        axis = complex(*map(float, joint.get("axis", (1, 0))))
        holders = [name for name in made.having(made.names[key]) if name != FRAME]
        if holders:
            made.slides.append(BodySlide(holders[0], made.names[key], FRAME, line, cmath.phase(axis), turns=True))
        else:
            made.lost.append(Phrase("lost slide of joint", name=key))


def write_pylinkage(bodies: Bodies) -> str:
    """The JSON of a mechanism; parts that it cannot hold are added to ``lost`` or ``left``."""
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
            bodies.lost.append(Phrase("lost slide on moving line", link=slide.body, on=slide.on))
        axis = cmath.rect(1.0, slide.angle)
        line = [number(slide.through.real), number(slide.through.imag)]
        at |= {"type": "prismatic", "axis": [axis.real, axis.imag]}
        joints.append(at | {"line_point": line, "slide_distance": 0})
    pivots = [p for p in bodies.places if p in fixed]
    links: list[OwnTables] = [{"id": "ground", "type": "ground", "joints": pivots}]
    bodies.left += [Phrase("lost unit", unit=bodies.unit)] if bodies.unit != "mm" else []
    driven = {body: rate for (body, point), rate in bodies.drives.items() if not point}
    bodies.lost += [Phrase("lost driver of", link=body) for body, point in bodies.drives if point]
    for name, points in bodies.bodies.items():
        if name == FRAME or (len(points) < 2 and name not in driven):
            continue
        link: OwnTables = {"id": name, "type": "link", "joints": points}
        pivot = next((p for p in points if p in fixed), None)
        if name in driven and (pivot is None or len(points) < 2):
            bodies.lost.append(Phrase("lost driver of no bar", link=name))
        elif name in driven and pivot is not None:
            crank = next(bodies.places[p] - bodies.places[pivot] for p in points if p != pivot)
            link |= {"type": "driver", "motor_joint": pivot, "angular_velocity": number(driven[name]),
                     "initial_angle": cmath.phase(crank)}
        links.append(link)
    data = {"name": bodies.title, "joints": joints, "links": links, "ground": "ground"}
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"
