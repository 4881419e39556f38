"""Coupler curves with marks at equal steps of the driver, as pages in scale."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from graphkin.construction.scales import next_of_series
from graphkin.drawing import Box, Circle, Drawing, Group, Line, Polyline, Primitive, Stroke, Text
from graphkin.drawing.font_widths import runs_width
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.symbols import block_with_pin, fixed_pivot, rigid_link, turning_pair
from graphkin.drawing.ink.symbols import guide as guide_symbol
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.obstacles import obstacles_of
from graphkin.drawing.place.placement import place
from graphkin.drawing.text import rich
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.study.driver_axis import (
    HEIGHT,
    LEFT,
    RIGHT,
    WIDTH,
    DriverAxis,
    heading,
    number,
    title_of,
)
from graphkin.study.turn import TurnStudy
from graphkin.words import Phrase, say, word

__all__ = ["coupler_points", "curve_page"]

TICKS = 12
DOT = 0.85  # mm, radius of a mark on the curve


def coupler_points(scene: Mechanism) -> tuple[tuple[str, str], ...]:
    """Points of links that are neither pivoted to the frame nor slide on it, with their link: those that no other kind
    of link carries."""
    frame = scene.frame
    guided = {s.link for s in scene.slidings if s.on == frame.name}
    plain = {link.name for link in scene.links if any(p in frame.points for p in link.points)} | guided
    found: list[tuple[str, str]] = []
    for link in scene.links:
        if link.name in plain:
            continue
        for point in link.points:
            if not any(h in plain for h in scene.holders[point]) and point not in [p for p, _ in found]:
                found.append((point, link.name))
    return tuple(found)


def curve_page(turn: TurnStudy, axis: DriverAxis, point: str, link: str, language: str) -> Drawing:
    """The path of a coupler point in scale, with marks at equal steps of the driver, and the mechanism at its own
    position, or in the middle of its range where that is singular."""
    reach, scene = turn.reach, turn.scene
    low, high = reach.ends
    path = axis.motion.position(point, link)
    steps = TICKS * max(reach.turns, 1)
    if reach.full:
        ticks = (axis.first + np.arange(steps) * (high - low) / steps) % high
    else:
        angle = isinstance(reach.driver, AngleDriver)
        values = np.radians(axis.ticks) if angle else axis.ticks * scene.units.metres
        ticks = (values - reach.start[0]) * reach.sense
    at = reach.motion(ticks).position(point, link)
    here = reach.known
    places = {p: complex(here.position(p)[0]) for p in scene.holders}
    world = Box.around([*path[np.isfinite(path)].tolist(), *places.values()])
    width, height, need = min(((w, h, _need(world, w, h)) for w, h in ((WIDTH, HEIGHT), (HEIGHT, WIDTH))),
                              key=lambda page: next_of_series(page[2]))
    panel = _curve_panel(width, height)
    mm = 1e3 / next_of_series(need)  # of paper for one metre
    middle = world.centre

    def page(z: complex) -> complex:
        w = (z - middle) * mm
        return panel.centre + complex(w.real, -w.imag)

    skeleton = _skeleton(turn, places, page)
    dots = [Circle(page(complex(z)), DOT, strokes.BLACK, Stroke(0.25)) for z in at if math.isfinite(abs(z))]
    axis_unit = "°" if isinstance(reach.driver, AngleDriver) else ""
    numbers = [float(scene.unit_of(scene.drivers[0]).of(reach.value(t))) for t in ticks]
    numbers = [round(n, 9) + 0.0 for n in numbers]
    if reach.full:
        numbers = [n % (360 * reach.turns) for n in numbers]
    labels = [
        Label(Text(0j, rich(f"{number(n, 4)}{axis_unit}", 2.5)), page(complex(z)))
        for n, z in zip(numbers, at, strict=True) if math.isfinite(abs(z))
    ]
    names = [Label(Text(0j, rich(f"${p}$", 3.5)), page(z)) for p, z in places.items()]
    line = Polyline(tuple(page(complex(z)) for z in path[np.isfinite(path)]), Stroke(0.5))
    placed = place([*names, *labels], panel, obstacles_of((*skeleton, line, *dots)))
    words: list[Primitive] = []
    for label in placed:
        words += [label.text] + ([label.leader] if label.leader else [])
    title = say(Phrase("curve of point", (f"${point}$",)), language)
    scale = 1e3 / mm / (scene.units.metres * 1e3)
    facts = [f"1 mm = {scale:g} {scene.units.length}"]
    if isinstance(reach.driver, AngleDriver) and reach.full:
        begin = 0 if reach.sense > 0 else 360
        facts.append(say(Phrase("ticks at", (str(360 // TICKS), str(begin))), language))
    plain = title.replace("$", "")
    return Drawing(
        width,
        height,
        (
            Group(heading(scene, title, facts, language), id="heading"),
            Group(tuple(skeleton), id="mechanism", layer="mechanism"),
            Group((line, *dots), id=f"curve-{point}", layer="curve", title=plain),
            Group(tuple(words), id="labels", layer="labels"),
            *_check_bar(panel, language),
        ),
        title=f"{plain}: {title_of(scene, language)}",
        desc="; ".join(facts),
        lang=language,
        metadata={"scene": scene.name, "units": scene.units.length, "scales": {"length": scale}},
    )


def _curve_panel(width: float, height: float) -> Box:
    return Box(LEFT - 8, 32.0, width - RIGHT + 4, height - 20.0)


def _need(world: Box, width: float, height: float) -> float:
    """Millimetres of mechanism to one of paper, for all to fit."""
    panel = _curve_panel(width, height).grown(-12.0)
    return max(world.width / panel.width, world.height / panel.height) * 1e3 or 1.0


def _skeleton(turn: TurnStudy, places: dict[str, complex], page: Callable[[complex], complex]) -> list[Primitive]:
    """The mechanism at its own position, thin: links, blocks, guides, pivots."""
    scene = turn.scene
    motion = turn.reach.known
    made: list[Primitive] = []
    blocks: list[Primitive] = []
    for pair in motion.slides:
        guide = motion.poses[pair.b]
        at = page(complex(motion.poses[pair.a].z[0]))
        angle = float(np.angle(guide.u[0] * pair.guide.direction))
        if pair.b == scene.frame.name:
            made += guide_symbol(at, angle, 24.0)
        elif scene.by_name[pair.b].points:
            begin = next(iter(scene.by_name[pair.b].points))
            made.append(Line(page(places[begin]), at, strokes.LINK.coloured(strokes.GREY)))
        blocks += block_with_pin(at, angle)
    for each in scene.links:
        corners = tuple(page(places[p]) for p in each.points)
        if len(corners) > 1:
            made += rigid_link(corners, strokes.GREY)
    for p, z in places.items():
        made += fixed_pivot(page(z)) if p in scene.frame.points else turning_pair(page(z))
    return [*made, *blocks]


def _check_bar(panel: Box, language: str) -> tuple[Primitive, ...]:
    y = panel.bottom + 6.0
    runs = rich(word("check bar", language), 2.5)
    end = complex(panel.right, y)
    start = end - 50.0
    ends = [Line(p - 1.2j, p + 1.2j, strokes.DIMENSION) for p in (start, end)]
    text = Text(complex(panel.right - 25 - runs_width(runs) / 2, y + 3.8), runs)
    return Line(start, end, strokes.DIMENSION), *ends, text
