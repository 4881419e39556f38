"""A figure as far as it is drawn: to each part the step that puts it there, later parts left out, new ones lit.

Vectors, direction lines and arcs are drawn with the class of their step; here names, end points, links and senses get
theirs, from what they belong to.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

from graphkin.construction.polygon_acts import AddedRate, Carried, MeasuredRate, PlanDrawn
from graphkin.construction.sheet import DiagramName, Sheet, Step
from graphkin.construction.steps import links_drawn
from graphkin.construction.strokes import Aid, Mark, TrialCurve, Vector
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polygon, Polyline, Primitive, Stroke, Text
from graphkin.drawing.parts.dimensioning import LENGTHS
from graphkin.drawing.parts.polygon_on_page import details

__all__ = ["births", "so_far", "step_of", "stepped"]

FADED = 0.42  # of its colour is left to what was drawn before
HALO, HALO_WIDTH = "#ffe08a", 2.0  # mm around what is new: pale enough to print as a light grey


def births(sheet: Sheet) -> dict[str, int]:
    """For each id of the figures of a sheet the number of the step that draws it."""
    born: dict[str, int] = {}
    for diagram in ("mechanism", "velocity", "acceleration"):
        steps = [step for step in sheet.steps if step.diagram == diagram]
        if not steps:
            continue
        if diagram == "mechanism":
            born.update(_mechanism(sheet, steps))
        else:
            born[f"pole-{diagram}"] = steps[0].number
            born.update(_polygon(diagram, steps))
            _insets(sheet, diagram, born)
    return born


def _mechanism(sheet: Sheet, steps: list[Step]) -> dict[str, int]:
    born: dict[str, int] = {}
    mentioned: dict[str, int] = {}
    for step in steps:
        for mark in (s for s in step.strokes if isinstance(s, Mark)):
            born.setdefault(f"point-{mark.ref.point}", step.number)
        for curve in (s for s in step.strokes if isinstance(s, TrialCurve)):
            born |= {f"trial-{curve.point}-{i}": step.number for i in range(1, len(curve.at) + 1)}
        for name in links_drawn(step.act):
            mentioned.setdefault(name, step.number)
    # what is found later, in the mechanism that stands, is no part of it
    polygons = min((s.number for s in sheet.steps if s.diagram != "mechanism"), default=math.inf)
    last = max((s.number for s in steps if s.number < polygons), default=steps[-1].number)
    for link in (sheet.scene.frame, *sheet.scene.links):
        points = [born.get(f"point-{p}", last) for p in link.points]
        born[f"link-{link.name}"] = max([*points, mentioned.get(link.name, 0)], default=last) or last
    for cam in sheet.scene.cams:
        born |= dict.fromkeys((f"cam-{cam.link}", f"follower-{cam.follower}", f"touch-{cam.link}"), last)
    for contact in sheet.scene.contacts:
        born |= {f"contact-{contact.name}": last}
        born |= {f"{letter}-{contact.name}-{end}": last for letter in "nt" for end in (1, 2)}
    for driver in sheet.scene.drivers:
        born.setdefault(f"angle-{driver.key}", last)
    born[f"link-{sheet.scene.frame.name}"] = steps[0].number
    for spring in sheet.scene.loading.springs:
        born[f"spring-{spring.name}"] = max(born.get(f"link-{name}", last) for name in spring.links)
    for driver in sheet.scene.drivers:
        for part in ("", "-alpha"):
            born[f"driver-{driver.key.replace('/', '-')}{part}"] = born.get(f"link-{driver.key.split('/')[0]}", last)
        born[f"driven-{driver.key.replace('/', '-')}"] = born[f"driver-{driver.key.replace('/', '-')}"]
    for contact in sheet.scene.contacts:
        sides = [f"{letter}-{contact.name}-{k}" for letter in "nt" for k in (1, 2)]
        born |= dict.fromkeys((f"contact-{contact.name}", *sides), last)
    born[LENGTHS] = last
    for link in sheet.scene.links:
        born.update({f"length-{a}{b}": last for a in link.points for b in link.points})
    for step in sheet.steps:
        if isinstance(step.act, MeasuredRate | AddedRate | PlanDrawn):
            born[f"{step.act.rate}-{step.act.link}"] = step.number
    return born


def _polygon(diagram: DiagramName, steps: list[Step]) -> dict[str, int]:
    born: dict[str, int] = {}
    for step in steps:
        born[f"direction-{step.number:02d}"] = step.number
        if isinstance(step.act, Carried):
            born[f"carried-{step.act.symbol.id}"] = step.number
            born.setdefault(f"foot-{step.act.symbol.id}", step.number)
        for stroke in step.strokes:
            if isinstance(stroke, Mark):
                born.setdefault(f"{diagram}-{stroke.ref}".replace("@", ""), step.number)
            elif isinstance(stroke, Aid):
                born[f"trial-{diagram}-{stroke.trial}-{stroke.symbol.id}"] = step.number
                if not stroke.trial:
                    born.setdefault(f"special-{stroke.symbol.id}", step.number)
                    born.setdefault(f"foot-{stroke.symbol.id}", step.number)
            elif isinstance(stroke, Vector):
                born[stroke.symbol.id] = step.number
                born[f"foot-{stroke.symbol.id}"] = step.number
    return born


def _insets(sheet: Sheet, diagram: DiagramName, born: dict[str, int]) -> None:
    if diagram == "acceleration":
        for symbol in sheet.vectors(diagram):
            if symbol.kind == "ak":
                for part in ("sense", "inset", "inset-v", "inset-omega"):
                    born[f"{part}-{symbol.id}"] = born[symbol.id]
    for number, detail in enumerate(details(sheet, diagram), 1):
        last = max(born[v.symbol.id] for v in detail.vectors)
        born[f"detail-{diagram}-{number}"] = born[f"ring-{diagram}-{number}"] = last
        born.update({f"detail-{v.symbol.id}": last for v in detail.vectors})
        points = [id for id in born if id.startswith((f"{diagram}-", f"pole-{diagram}", f"trial-{diagram}-", "foot-"))]
        born.update({f"detail-{id}": last for id in points})


def step_of(thing: Primitive) -> int | None:
    """Number of the step that puts a thing there; None where none does, and for what is part of a group."""
    return thing.step if isinstance(thing, Group | Text) else None


def stepped(children: Iterable[Primitive], born: dict[str, int]) -> tuple[Primitive, ...]:
    """The same figure with its step on everything that has one; a leader takes that of its name."""
    found: list[Primitive] = []
    children = tuple(children)
    for thing, after in zip(children, (*children[1:], None), strict=False):  # the last has none after it
        if isinstance(thing, Line) and isinstance(after, Text) and "label" in after.classes:
            step = born.get(after.id.removeprefix("label-"), after.step)
            thing = Group((thing,), classes=("leader",), step=step)
        elif isinstance(thing, Group | Text):
            step = born.get(thing.id.removeprefix("listed-").removeprefix("label-"))
            if step is not None and step_of(thing) is None:
                thing = replace(thing, step=step)
            if isinstance(thing, Group):
                thing = replace(thing, children=stepped(thing.children, born))
        found.append(thing)
    return tuple(found)


def so_far(children: Iterable[Primitive], first: int, last: int) -> tuple[Primitive, ...]:
    """The parts up to step ``last``, those before step ``first`` faded, the new ones on a pale band."""
    found: list[Primitive] = []
    for thing in children:
        step = step_of(thing)
        if step is not None and step > last:
            continue
        if step is None and isinstance(thing, Group):
            inside = so_far(thing.children, first, last)
            found += [replace(thing, children=inside)] if inside else []
        elif step is not None and step < first:
            found += strokes.pale((thing,), FADED, FADED + 0.2)
        elif step is not None and isinstance(thing, Group):
            halo = (
                ()
                if {"inset", "ring"} & set(thing.classes)
                else tuple(band for child in thing.children for band in _band(child))
            )
            found += [Group(halo, classes=("new",))] if halo else []
            found.append(thing)
        else:
            found.append(thing)
    return tuple(found)


def _band(thing: Primitive) -> list[Primitive]:
    if isinstance(thing, Line) and thing.start != thing.end:
        return [Line(thing.start, thing.end, Stroke(HALO_WIDTH, (), HALO))]
    if isinstance(thing, Polyline | Arc):
        return [replace(thing, stroke=Stroke(HALO_WIDTH, (), HALO))]
    if isinstance(thing, Polygon) and thing.stroke is not None and not thing.fill:
        return [Polygon(thing.points, "", Stroke(HALO_WIDTH, (), HALO))]
    if isinstance(thing, Circle):
        return [Circle(thing.centre, thing.radius + HALO_WIDTH / 2, HALO)]
    return []
