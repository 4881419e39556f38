"""The race drawn: cost of a position against the largest error, velocity and acceleration side by side."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from graphkin.drawing import Box, Drawing, Group, Line, Primitive, Stroke, Text
from graphkin.drawing.chart import Chart, Curve, Marks, Shape, chart_group, log_axis
from graphkin.drawing.layout import wrapped
from graphkin.drawing.obstacles import Obstacles, obstacles_of
from graphkin.drawing.placing import Label, Mark, place
from graphkin.drawing.text import rich
from graphkin.scene.symbol import Symbol
from graphkin.study.speed.entry import Entry
from graphkin.study.speed.run import Race
from graphkin.words import Phrase, say, word

__all__ = ["page"]

WIDTH, HEIGHT = 297.0, 210.0
LEFT, RIGHT, GAP = 22.0, 8.0, 18.0
TOP, BOTTOM = 40.0, 50.0
LETTERS = 2.5
LETTERS_TRIED = (2.5, 2.3, 2.1, 2.0)
"""Letters of the labels, mm: where machine and methods crowd the points, smaller ones."""
LOWEST = 1e-19
HIGHEST = 10.0

SHAPES: dict[str, Shape] = {
    "closed": "disc",
    "newton": "circle",
    "differences": "diamond",
    "complex step": "square",
    "drawn": "cross",
    "by hand": "down",
    "peer": "up",
}
LINES = {
    "newton": Stroke(0.25, (3.0, 1.2)),
    "differences": Stroke(0.25, (0.9, 0.9)),
    "pencil": Stroke(0.25),
    "by hand": Stroke(0.25),
}
FLOOR = Stroke(0.35, (4.0, 1.0, 0.9, 1.0))
SAVED = Stroke(0.18)
NUMBERED = {"newton": ("1", "2", "3", "4"), "differences": ("1e-1", "1e-4", "1e-6", "1e-8")}
"""Which points of a curve bear their number."""


def page(race: Race, language: str = "en") -> Drawing:
    """One page for both."""
    title = word("speed title", language)
    scene = race.scene
    name = scene.title_in(language)
    versions = ", ".join(f"{n} {v}" for n, v in race.machine.versions)
    facts = say(
        Phrase("speed facts", (race.machine.cores, race.machine.processor, versions, race.repeats, race.count,
                               race.places)), language)  # fmt: skip
    wide = WIDTH - LEFT - RIGHT
    words: list[Primitive] = [
        Text(complex(LEFT - 12, 13.0), rich(title, 5.0, bold=True)),
        Text(complex(LEFT - 12, 19.0), rich(name.replace("$", "$$"), 3.5)),
    ]
    y = 24.0
    for runs in wrapped(facts.replace("$", "$$"), LETTERS, wide + 12):
        words.append(Text(complex(LEFT - 12, y), runs))
        y += 3.3
    half = (wide - GAP) / 2
    panels = [Box(x, TOP, x + half, HEIGHT - BOTTOM) for x in (LEFT, LEFT + half + GAP)]
    charts = [
        _chart(race, panel, kind, language) for panel, kind in zip(panels, ("velocity", "acceleration"), strict=True)
    ]
    y = HEIGHT - BOTTOM + 16.0
    lines = [word(f"speed lesson {key}", language) for key in ("draw", "compute", "lose")]
    lines.append(say(Phrase("speed hand", (race.acts,)), language))
    if race.skipped:
        told = "; ".join(f"{peer} {say(why, language)}" for peer, why in race.skipped)
        lines.append(say(Phrase("skipped", (told,)), language))
    for line in lines:
        for runs in wrapped(line, 2.8, wide + 12):
            words.append(Text(complex(LEFT - 12, y), runs))
            y += 3.8
    return Drawing(
        WIDTH, HEIGHT, (Group(tuple(words), id="heading"), *charts), title=f"{title}: {name}", desc=facts,
        lang=language, metadata={"study": "speed-accuracy", "scene": scene.name},
    )  # fmt: skip


def _points(entries: Sequence[Entry], kind: str) -> list[tuple[Entry, float, float]]:
    """Entries that give something, with cost and error."""
    found = []
    for e in entries:
        cost, error = (
            (e.velocity_cost, e.velocity_error) if kind == "velocity" else (e.acceleration_cost, e.acceleration_error)
        )
        if error is not None and math.isfinite(error):
            found.append((e, cost, max(error, LOWEST * 1.5)))
    return found


def _chart(race: Race, panel: Box, kind: str, language: str) -> Group:
    points = _points(race.entries, kind)
    costs = [c for _, c, _ in points]
    floor = race.copying[kind == "acceleration"]
    x_axis = log_axis(min(floor, *costs) / 1.5, max(costs) * 1.5, word("cost of a position", language), most=14)
    y_axis = replace(log_axis(LOWEST, HIGHEST, most=9), title=f"{word(f'speed of {kind}', language)}: "
                     f"{word('largest error', language)}")  # fmt: skip
    points = [p for p in points if p[2] <= HIGHEST]
    curves = [*_curves(points), Curve([floor] * 2, [LOWEST, HIGHEST], FLOOR)]
    marks = []
    for family, shape in SHAPES.items():
        own = [p for p in points if p[0].family == family]
        marks.append(Marks([c for _, c, _ in own], [e for _, _, e in own], shape))
    chart = Chart(panel, x_axis, y_axis, tuple(curves), tuple(marks), id=f"speed-{kind}")
    drawn = chart_group(chart)
    return Group(
        (drawn, *_saved(chart, points), *_labels(race, chart, points, floor, drawn, language)), id=f"panel-{kind}",
        title=word(f"speed of {kind}", language),
    )  # fmt: skip


def _curves(points: Sequence[tuple[Entry, float, float]]) -> list[Curve]:
    found = []
    for name, stroke in LINES.items():
        own = [p for p in points if p[0].family == name or (name == "pencil" and p[0].key == "pencil")]
        if len(own) > 1:
            found.append(Curve([c for _, c, _ in own], [e for _, _, e in own], stroke))
    return found


def _saved(chart: Chart, points: Sequence[tuple[Entry, float, float]]) -> list[Primitive]:
    """Lines from each whole run to the one that is limited to what is asked."""
    found: list[Primitive] = []
    for e, cost, error in points:
        if e.tag == "asked":
            whole = next((p for p in points if p[0].key == e.key and not p[0].tag), None)
            if whole is not None:
                found.append(Line(chart.at(whole[1], whole[2]), chart.at(cost, error), SAVED))
    return found


def _labels(
    race: Race, chart: Chart, points: Sequence[tuple[Entry, float, float]], floor: float, drawn: Group, language: str
) -> list[Primitive]:
    x = chart.at(floor, HIGHEST).real
    stretch = complex(x, chart.panel.top + 6.0), complex(x, chart.panel.top + 24.0)
    named = [(_words(race, e, points, language), chart.at(cost, error)) for e, cost, error in points]
    wishes: list[tuple[str, Mark]] = [(words, at) for words, at in named if words]
    wishes.append((word("copying", language), stretch))
    corners = chart.panel.corners
    frame = Obstacles(solid=tuple(zip(corners, (*corners[1:], corners[0]), strict=True)))
    curves = next(c for c in drawn.children if isinstance(c, Group) and "curves" in c.classes)
    there = obstacles_of((curves,)) + frame
    in_the_way = Obstacles(there.solid + there.dashed, areas=there.areas)
    for size in LETTERS_TRIED:
        asked = [Label(Text(0j, rich(words, size)), mark) for words, mark in wishes]
        placed = place(asked, chart.panel, in_the_way)
        if all(label.clear for label in placed):
            break
    found: list[Primitive] = []
    for label in placed:
        found.append(replace(label.text, classes=("label",)))
        if label.leader is not None:
            found.append(label.leader)
    return found


def _words(race: Race, entry: Entry, points: Sequence[tuple[Entry, float, float]], language: str) -> str:
    """The name of a method at its point; of a curve's points the first bears the name, some their numbers."""
    if entry.tag == "asked":
        return say(Phrase("only asked", (word(entry.key, language), _written(race.asked[0]))), language)
    if not entry.tag:
        return word(entry.key, language)
    name = word("differences of" if entry.key == "differences" else entry.key, language)
    first = next(p[0] for p in points if p[0].key == entry.key)
    number = _number(entry.tag)
    if entry is first:
        return f"{name} {number}"
    if entry.family in NUMBERED:
        return number if entry.tag in NUMBERED[entry.family] else ""
    last = [p[0] for p in points if p[0].key == entry.key][-1]
    return number if entry is last else ""


def _written(symbol: Symbol) -> str:
    """A symbol as it is set: v_B@3 with B3 as its index."""
    if symbol.link:
        return f"${'ω' if symbol.kind == 'omega' else 'α'}_{{{symbol.link}}}$"
    parts = [f"{ref.point}{ref.link}" for ref in (symbol.of, symbol.to) if ref is not None]
    return f"${symbol.kind[0]}_{{{'/'.join(parts)}}}$"


def _number(tag: str) -> str:
    if "e-" in tag:
        return f"$10^{{−{tag.partition('e-')[2]}}}$"
    return {"0.25": "1/4", "0.5": "1/2"}.get(tag, tag)

