"""What only leads on: compass arcs; and where a group is larger than a dyad, trial positions with the curve of the free
end, lines to special points, trial polygons in line kinds of their own.
"""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Iterator

from graphkin.account.end_letters import SAME
from graphkin.account.tell.groups import numeral
from graphkin.construction.mechanism_acts import SpecialPoint, TrialPositions
from graphkin.construction.polygon_acts import SeenFrom
from graphkin.construction.sheet import Sheet
from graphkin.construction.strokes import Aid, Bar, CompassArc, TrialCurve
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Arc, Group, Line, Polyline, Primitive, Text, on_page
from graphkin.drawing.ink.symbols import arrowhead
from graphkin.drawing.parts.mechanism_on_paper import MechanismOnPaper
from graphkin.drawing.parts.polygon_on_page import PolygonOnPage, same_place, step_number
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.piece import Piece, dated
from graphkin.drawing.text import symbol
from graphkin.plane import cross, dot, unit

__all__ = ["compass_arcs", "trial_marks_in_mechanism", "trial_marks_in_polygon"]

COMPASS = 7.0  # mm of arc to either side of what it finds
SPLINTER = math.sin(math.radians(15.0))  # a smaller angle of an arc to a bar looks like a splinter of the bar

CROSS = 0.9  # mm: half a cross that marks a trial position


def compass_arcs(here: MechanismOnPaper) -> Piece:
    """Compass arcs near the points that they find, over a block that would leave but their ends."""
    under: list[Primitive] = []
    over: list[Primitive] = []
    arcs = [
        (step, stroke) for step in here.sheet.steps if step.diagram == "mechanism"
        for stroke in step.strokes if isinstance(stroke, CompassArc) and stroke.radius > 1e-9
    ]  # fmt: skip
    bars: dict[complex, set[complex]] = {}
    for _, arc in arcs:
        bars.setdefault(same_place(arc.at), set()).add(unit(arc.centre - arc.at))
    for step, arc in arcs:
        there = bars[same_place(arc.at)]
        middle = phase(arc.at - arc.centre)
        half = min(COMPASS / arc.radius, math.pi * 0.9)
        shown = [not _along_a_bar(arc, side, there) for side in (-1, 1)]
        first, last = (half * (one or not any(shown)) for one in shown)
        shape = Arc(on_page(arc.centre), arc.radius, middle - first, middle + last, strokes.CONSTRUCTION)
        covered = any(abs(block.at - arc.at) < SAME for block in here.sliders)
        (over if covered else under).append(Group((shape,), classes=("compass",), step=step.number))
    return Piece({"construction": tuple(under), "mechanism": tuple(over)})


def _along_a_bar(arc: CompassArc, side: int, bars: set[complex]) -> bool:
    """Whether an arc, to one side, 1 counter-clockwise, begins nearly along one of the bars that meet there."""
    way = side * 1j * unit(arc.at - arc.centre)
    return any(dot(way, bar) > 0.0 and abs(cross(way, bar)) < SPLINTER for bar in bars)


def trial_marks_in_mechanism(sheet: Sheet) -> Piece:
    """Trial curves with their positions numbered, and the lines of legs drawn on to special points."""
    drawn: list[Primitive] = []
    over: list[Primitive] = []  # lines that run over the areas of links
    labels: list[Label] = []
    curves = 0
    for step in sheet.steps:
        if step.diagram != "mechanism":
            continue
        if isinstance(step.act, SpecialPoint):
            lines = tuple(
                Line(on_page(s.a), on_page(s.b), strokes.DIRECTION)
                for s in step.strokes if isinstance(s, Bar) and abs(s.b - s.a) > SAME
            )  # fmt: skip
            over.append(Group(lines, id=f"special-{step.act.point}", classes=("special",), step=step.number))
        for curve in (s for s in step.strokes if isinstance(s, TrialCurve)):
            curves += 1
            parts: list[Primitive] = [Polyline(tuple(map(on_page, curve.curve)), strokes.TRIAL_CURVE)]
            for number, z in enumerate(curve.at, 1):
                parts += [Line(on_page(z + w), on_page(z - w), strokes.CONSTRUCTION) for w in (CROSS, 1j * CROSS)]
                name = f"label-trial-{curve.point}-{number}"
                numeral = symbol(str(number), 2.0)
                text = Text(0j, numeral, "start", strokes.GREY, name, ("label", "trial"), since=step.number)
                labels.append(Label(text, on_page(z), rank=4))
            id = f"trial-curve-{curve.point}" + (f"-{curves}" if curves > 1 else "")
            drawn.append(Group(tuple(parts), id=id, classes=("trial",), step=step.number))
        if isinstance(step.act, TrialPositions):
            goals = [s for s in step.strokes if isinstance(s, Bar)]
            ways = [Line(on_page(s.a), on_page(s.b), strokes.DIRECTION) for s in goals]
            drawn += [Group((way,), classes=("trial",), step=step.number) for way in ways]
    return Piece({"construction": tuple(drawn), "mechanism": tuple(over)}, tuple(labels))


def trial_marks_in_polygon(here: PolygonOnPage) -> Iterator[Piece]:
    """Trial polygons, each in its own kind of line and with its number at its letters; vectors to special points."""
    held = {step.act.held for step in here.steps if isinstance(step.act, SeenFrom)}
    for step in here.steps:
        aids = [s for s in step.strokes if isinstance(s, Aid) and abs(s.tip - s.tail) > SAME]
        if not aids:
            continue
        trial = aids[0].trial
        stroke = strokes.TRIALS[(trial - 1) % len(strokes.TRIALS)] if trial else strokes.CONSTRUCTION
        parts: list[Primitive] = []
        labels: list[Label] = []
        named: set[complex] = set()
        for aid in aids:
            clipped = here.panel.clip(here.at(aid.tail), here.at(aid.tip))
            if clipped is None or (not trial and here.covered(aid.tail, aid.tip)):
                continue
            parts.append(Line(*clipped, stroke))
            whole = abs(clipped[1] - here.at(aid.tip)) < SAME
            if whole and abs(aid.tip - aid.tail) > 2.5:
                parts.append(arrowhead(here.at(aid.tip), clipped[1] - clipped[0], 1.6, 0.6, strokes.GREY))
            if not trial and (_apart(aid) or aid.symbol.seen) and abs(clipped[1] - clipped[0]) > 4.0:
                text = Text(0j, symbol(here.letters.arrow(aid.symbol), 3.0), "start", strokes.GREY,
                            f"label-special-{aid.symbol.id}", ("label",))  # fmt: skip
                rank = 3 if aid.symbol.to and aid.symbol.to.link in held else 4
                labels.append(Label(text, clipped, rank=rank, key=step_number(step.number)))
            if trial and whole and aid.symbol.to is None and aid.symbol.of is not None and (
                same_place(aid.tip) not in named
            ):  # fmt: skip
                named.add(same_place(aid.tip))
                letter = here.letters.end(here.diagram, aid.symbol.of)
                if letter:
                    above = numeral(trial)
                    name = f"label-trial-{here.diagram}-{trial}-{aid.symbol.id}"
                    text = Text(0j, symbol(f"{letter}^{{{above}}}", 2.5), "start", strokes.GREY, name,
                                ("label", "trial"))  # fmt: skip
                    labels.append(Label(text, here.at(aid.tip), (phase(clipped[1] - clipped[0]),), rank=5))
        classes = (f"trial-{trial}",) if trial else ("special",)
        drawn = Group(tuple(parts), classes=classes, step=step.number)
        yield dated(Piece({"construction": (drawn,)}, tuple(labels)), step.number)


def _apart(aid: Aid) -> bool:
    """Whether a vector is what two points that lie under each other move apart by."""
    of, to = aid.symbol.of, aid.symbol.to
    return of is not None and to is not None and of.point == to.point
