"""Files of the program Linkage (.linkage2): connectors with places, elements that join them, anchors, sliders, motors.

The form is that of its own reader and writer (``LinkageDoc.cpp``): ``connector`` with id, x, y, anchor, input, rpm,
slider with two ``slidelimit``; ``element`` (also ``Link``) with its connectors; an actuator is a bar whose length is
driven.  Coordinates are in millimetres whatever units are shown.  An anchor that is an input turns, once a minute times
rpm, counter-clockwise positive, the element that has it.
"""

from __future__ import annotations

import cmath
import math
from xml.etree import ElementTree

from graphkin.errors import CallError, Problem
from graphkin.exchange.bodies import FRAME, Bodies, BodyDrive, BodySlide
from graphkin.words import Phrase

__all__ = ["read_linkage2", "write_linkage2"]

RPM = 15.0
"""Where a motor says no speed."""


def read_linkage2(text: str, title: str) -> Bodies:
    """The bodies of a file.  Raises CallError where it is none."""
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise CallError(
            Problem(title, Phrase("is not xml", error=error), Phrase("save it from linkage anew"))
        ) from None
    if root.tag != "linkage2":
        raise CallError(
            Problem(title, Phrase("begins with", tag=root.tag), Phrase("a file of linkage begins with linkage2"))
        )
    made = Bodies(title)
    elements = [e for e in root if e.tag in ("element", "Link", "link")]
    used = {c.get("id") for e in elements for c in e}
    points: dict[str, str] = {}
    nodes = {c.get("id", ""): c for c in root if c.tag == "connector"}
    for key, node in nodes.items():
        if key in used:
            place = complex(_number(node, "x"), _number(node, "y"))
            points[key] = made.point(node.get("name") or f"C{key}", place)
        else:
            made.left.append(f"connector {node.get('name') or key} (no link has it)")
    made.body(FRAME, [points[k] for k, node in nodes.items() if k in points and node.get("anchor") == "true"])
    names: dict[str, list[str]] = {}
    for element in elements:
        own = [c.get("id", "") for c in element if c.tag == "connector" and c.get("id") in points]
        label = element.get("name") or f"L{element.get('id', '')}"
        if element.get("gear") == "true":
            made.lost.append(f"gear {label}")
        if all(nodes[k].get("anchor") == "true" for k in own) and own:
            continue  # part of the frame
        if element.get("actuator") == "true" and len(own) == 2:
            _cylinder(made, element, label, [points[k] for k in own])
            continue
        name = made.body(label, [points[k] for k in own])
        for key in own:
            names.setdefault(key, []).append(name)
    made.lost += [f"{r.get('type', 'gears')} ratio" for ratios in root if ratios.tag == "ratios" for r in ratios]
    made.lost += [f"fastening of {n.get('name') or n.get('id')}" for n in (*nodes.values(), *elements) if _fastened(n)]
    for key, node in nodes.items():
        if node.get("slider") == "true" and key in points:
            holders = names.get(key, []) or [FRAME] * (node.get("anchor") == "true")
            _slider(made, node, points, holders, names)
        if node.get("anchor") == "true" and node.get("input") == "true":
            turned = names.get(key, [])
            if not turned:
                made.lost.append(f"motor at {node.get('name') or key} (no link turns about it)")
            else:
                made.drives.append(BodyDrive(turned[0], _number(node, "rpm", RPM) * math.tau / 60))
    return made


def _number(node: ElementTree.Element, key: str, usual: float = 0.0) -> float:
    try:
        value = float(node.get(key) or usual)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise CallError(
            Problem(f"{node.tag} {node.get('id')}", f'{key} is "{node.get(key)}"', Phrase("a number is wanted"))
        )
    return value


def _fastened(node: ElementTree.Element) -> bool:
    return any(node.get(key) for key in ("fasten", "fastenlink", "fastenconnector")) or any(
        child.tag == "fastenconnector" for child in node
    )


def _slider(
    made: Bodies, node: ElementTree.Element, points: dict[str, str], own: list[str], names: dict[str, list[str]]
) -> None:
    """A connector that runs on the straight line between two others, which lie on one body."""
    limits = [c.get("id", "") for c in node if c.tag == "slidelimit"][:2]
    label = node.get("name") or node.get("id")
    if len(limits) < 2 or any(k not in points for k in limits) or not own:
        made.lost.append(f"slider {label} (it has no two limits)")
        return
    if _number(node, "slideradius"):
        made.lost.append(f"slider {label} (its slot is round)")
        return
    one, two = (made.places[points[k]] for k in limits)
    fixed = all(points[k] in made.bodies[FRAME] for k in limits)
    shared = [n for n in names.get(limits[0], []) if n in names.get(limits[1], [])]
    if not fixed and not shared:
        made.lost.append(f"slider {label} (its limits lie on two links)")
        return
    point = points[node.get("id", "")]
    on = FRAME if fixed else shared[0]
    if point in made.bodies.get(on, []):
        made.lost.append(f"slider {label} (it is a point of the link that guides it)")
        return
    made.slides.append(BodySlide(own[0], point, on, one, cmath.phase(two - one), turns=True))


def _cylinder(made: Bodies, element: ElementTree.Element, label: str, ends: list[str]) -> None:
    """A bar whose length is driven: a cylinder about its first end, and a rod that slides in it."""
    one, two = (made.places[p] for p in ends)
    cylinder, rod = made.body(f"{label}c", ends[:1]), made.body(f"{label}r", ends[1:])
    made.slides.append(BodySlide(rod, ends[1], cylinder, one, cmath.phase(two - one)))
    throw = _number(element, "throw") or abs(two - one)
    # out and in again once a cycle
    made.drives.append(BodyDrive(rod, 2 * throw * _number(element, "cpm", RPM) / 60, ends[1]))


def write_linkage2(bodies: Bodies) -> str:
    """The text of a file; what it cannot hold is added to ``lost``."""
    bodies = bodies.with_pins()
    root = ElementTree.Element("linkage2")
    ElementTree.SubElement(root, "program", units="Millimeters", zoom="1.000000")
    ids = {point: str(k) for k, point in enumerate(bodies.places)}
    fixed = set(bodies.bodies.get(FRAME, ()))
    motors: dict[str, float] = {}
    for drive in bodies.drives:
        pivot = next((p for p in bodies.bodies.get(drive.body, ()) if p in fixed), "")
        if drive.point or not pivot:
            bodies.lost.append(f"driver of {drive.body}")
        else:
            motors[pivot] = drive.rate * 60 / math.tau
    ends: dict[str, list[str]] = {}
    scale = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8}[bodies.unit]
    for slide in bodies.slides:
        there = [p for p in bodies.bodies[slide.on] if p != slide.point and _on_line(bodies.places[p], slide)]
        ends[slide.point] = there[-2:]
    for point, place in bodies.places.items():
        here = {"id": ids[point], "name": point, "layer": "4"}
        here |= {"x": repr(place.real * scale), "y": repr(place.imag * scale)}
        if point in fixed:
            here["anchor"] = "true"
        if point in motors:
            here |= {"input": "true", "rpm": repr(motors[point])}
        if point in ends:
            here["slider"] = "true"
        node = ElementTree.SubElement(root, "connector", here)
        for end in ends.get(point, ()):
            ElementTree.SubElement(node, "slidelimit", id=ids[end])
    for k, (name, own) in enumerate(bodies.bodies.items()):  # the frame too, or its points would be of no link
        element = ElementTree.SubElement(root, "element", id=str(k), name=name, layer="4", linesize="1")
        for point in own:
            ElementTree.SubElement(element, "connector", id=ids[point])
    ElementTree.indent(root, "\t")
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def _on_line(place: complex, slide: BodySlide) -> bool:
    off = (place - slide.through) * cmath.rect(1.0, -slide.angle)
    return abs(off.imag) <= 1e-9 * max(1.0, abs(off))
