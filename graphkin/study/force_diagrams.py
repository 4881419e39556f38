"""Forces over the turn, as pages: the diagram of a force or a moment, the polar diagram of a force, and the flywheel of
a scene: driving and needed moment with the areas between them, and the kinetic energy that they store.

Where a load begins, ends or turns round the curve jumps: both its values stand there, joined by an upright line.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from graphkin.account.notation import force_letters
from graphkin.drawing import Box
from graphkin.drawing.chart import (
    BEHIND,
    SOLID_AND_DASHED,
    ChartPage,
    add_labels,
    add_legend,
    add_panel,
    add_words,
    count_steps,
    look,
    marker,
)
from graphkin.drawing.ink.primitives import Stroke
from graphkin.scene.force_names import force_names
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver import DriverRange, forces_of
from graphkin.solver.values import FlywheelStudy, MomentArea, load_edges, needed_moment
from graphkin.study.charts import (
    EMPTY,
    LEFT,
    MARGIN,
    RIGHT,
    TOP,
    WIDTH,
    ZERO,
    DriverAxis,
    Panel,
    chart_page,
    draw_panel,
    draw_pieces,
    driver_axis,
    heading,
    number,
    span_of,
    title_of,
    whole_span,
)
from graphkin.study.extremes import Extreme
from graphkin.study.quantities import Quantity, named_quantity
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    from graphkin.drawing.chart import Figure

__all__ = ["ForceRun", "flywheel_page", "force_extremes", "force_over_turn", "force_page", "polar_page", "whole_turn"]

Array = NDArray[np.float64]
Marks = tuple[tuple[Extreme, float, float], ...]
"""Extremes with their place on the axis and their value in the scene's units."""

JUMP = 1e-8
"""Of the range: so far on both sides of where a load begins or ends its two values are taken."""
GROWS = 50.0
"""Beside the samples next to an end of the motion: what grows more there goes away without bound."""
NOUGHT = 1e-12
"""Of the greatest force or moment: less is nothing but rounding."""
FINER = 33
TICKS = 12


@dataclass(frozen=True)
class ForceRun:
    """A force (complex) or a moment over the way of the driver, in the scene's units.

    offsets, x, values : shape (n,), as the axis goes; NaN where it has none, and between the two values of a jump
    """

    offsets: Array
    x: Array
    values: NDArray[np.complex128] | Array


def whole_turn(axis: DriverAxis) -> Array:
    """Offsets as the axis goes, with two on both sides of each place where the forces jump."""
    low, high = axis.reach.ends
    eps = JUMP * (high - low)
    beside = np.concatenate([[edge - eps, edge + eps] for edge in load_edges(axis.reach)] or [[]])
    if axis.reach.full:
        along = np.concatenate([(axis.offsets[:-1] - axis.first) % high, (beside - axis.first) % high])
        along = np.unique(np.concatenate([along, [0.0, high * (1 - 1e-12)]]))
        return np.asarray((along + axis.first) % high)
    return np.unique(np.concatenate([axis.offsets, beside[(beside > low) & (beside < high)]]))


def force_over_turn(axis: DriverAxis, name: str) -> ForceRun:
    """A force or a moment by its name over the way of the driver."""
    reach, offsets = axis.reach, whole_turn(axis)
    value = forces_of(reach.motion(offsets)).value(name)
    assert value is not None
    x = axis.at(offsets)
    if reach.full:
        x[0], x[-1] = axis.left, axis.right
    return ForceRun(offsets, x, value / reach.scene.units.newtons)


def _written(scene: Mechanism, name: str) -> str:
    """A force or a moment in the letters of the scene's convention."""
    return f"${force_letters(scene.question.sheet.convention, Symbol.parse(name))}$"


def force_page(reach: DriverRange, quantity: Quantity, language: str) -> ChartPage:
    """A moment, or the size of a force, over the driver, with its greatest and its least value."""
    axis = driver_axis(reach, language)
    found = force_over_turn(axis, quantity.of)
    values = np.abs(found.values) if quantity.is_size else np.asarray(found.values.real)
    unit, name = quantity.unit(reach.scene).written, _written(reach.scene, quantity.of)
    every = _extremes(axis, quantity, found, values)
    marks = [m for m in every if not _unbounded(reach, found.offsets, values, m[0].offset, m[2])]
    panel = course(quantity, f"{name} ({unit})", found, values, tuple(marks), len(marks) < len(every))
    heads = say(Phrase("diagram of", (name,)), language), ()
    facts = {"units": unit, "quantity": quantity.name}
    return chart_page(reach.scene, heads, [panel], axis, language, quantity.name, facts)


def course(
    quantity: Quantity, title: str, found: ForceRun, values: Array, marks: Marks = (), unbounded: bool = False
) -> Panel:
    """A force or a moment over the driver as a panel, with nought in it; of one without bound what most of the way
    needs."""
    curve = np.stack([found.x, values], axis=1)
    low, high = span_of(curve, EMPTY, not unbounded)
    low, high = min(0.0, low), max(0.0, high)
    span = whole_span(low, high) if high > low else (low - 0.5, high + 0.5)
    jumps = tuple(_jumps(found, values))
    return Panel(quantity, title, curve, EMPTY, marks, span, unbounded=unbounded, jumps=jumps)


def _jumps(found: ForceRun, values: Array) -> list[int]:
    """After which values the curve jumps."""
    step = np.abs(np.diff(found.x))
    leap = np.abs(np.diff(values))
    wide = float(np.nanmax(np.abs(values), initial=0.0))
    return np.flatnonzero((step < 1e-5 * float(np.ptp(found.x))) & (leap > 1e-6 * wide)).tolist()


def force_extremes(reach: DriverRange) -> dict[str, tuple[Quantity, list[tuple[str, float, float]]]]:
    """Of each joint force by its size, each couple and balance that is not nought the greatest and the least over the
    way of the driver: ``max`` or ``min``, the driver's value (rad, m), and the value in the scene's units,
    infinite where it goes away without bound at an end of the motion.

    Raises
    ------
    Unsolvable : a load acts on a part of a stroke, and the driver makes no whole turn
    """
    scene, found = reach.scene, dict[str, tuple[Quantity, list[tuple[str, float, float]]]]()
    names = [n for n in force_names(scene) if n.startswith(("F_", "M_"))]
    if not names:
        return found
    axis = driver_axis(reach, "en")
    offsets = whole_turn(axis)
    forces, x = forces_of(reach.motion(offsets)), axis.at(offsets)
    most = max(float(np.nanmax(np.abs(v), initial=0.0)) for v in (*forces.forces.values(), *forces.moments.values()))
    for name in names:
        value, quantity = forces.value(name), named_quantity(scene, name)
        if value is None or quantity is None or not np.nanmax(np.abs(value), initial=0.0) > NOUGHT * most:
            continue
        values = np.asarray(np.abs(value) if quantity.is_size else value.real) / scene.units.newtons
        marks = _extremes(axis, quantity, ForceRun(offsets, x, value), values)
        found[name] = quantity, [
            (e.kind, e.driver, math.inf if _unbounded(reach, offsets, values, e.offset, size) else size)
            for e, _, size in marks
        ]  # fmt: skip
    return found


def _unbounded(reach: DriverRange, offsets: Array, values: Array, at: float, value: float) -> bool:
    """Whether a value goes away without bound at an end of the motion."""
    if reach.full:
        return False
    low, high = (at <= offsets[2], at >= offsets[-3])
    inside = np.abs(values[3:6] if low else values[-6:-3])
    return bool((low or high) and abs(value) > GROWS * np.nanmax(inside, initial=0.0))


def _extremes(axis: DriverAxis, quantity: Quantity, found: ForceRun, values: Array) -> Marks:
    """The greatest and the least, with place on the axis and value."""
    reach, marks = axis.reach, list[tuple[Extreme, float, float]]()
    kinds: tuple[tuple[Literal["max", "min"], Callable[[Array], np.intp]], ...]
    kinds = ("max", np.nanargmax), ("min", np.nanargmin)
    known = values[np.isfinite(values)]
    if len(known) and np.ptp(known) <= NOUGHT * np.abs(known).max():  # it is the same everywhere, but for rounding
        kinds = (("max", lambda each: np.flatnonzero(np.isfinite(each))[0]),)
    for kind, pick in kinds if len(known) else ():
        k = int(pick(values))
        at, x, value = float(found.offsets[k]), float(found.x[k]), float(values[k])
        near = found.offsets[max(k - 1, 0) : k + 2]
        if len(near) == 3 and 0 < near[2] - near[0] < 0.1 * (reach.ends[1] - reach.ends[0]):
            finer = np.concatenate([np.linspace(near[0], near[1], FINER), np.linspace(near[1], near[2], FINER)])
            own = quantity.values(None, reach.motion(finer)) / reach.scene.units.newtons
            best = int(pick(own))
            at, x, value = float(finer[best]), float(axis.at(finer[best : best + 1])[0]), float(own[best])
        driver = float(reach.value(np.array(at)))
        driver = driver % math.tau if reach.full and reach.turns <= 1 else driver
        marks.append((Extreme(kind, at, driver, value), x, value))
    return tuple(marks if marks and marks[0][2] > marks[-1][2] else marks[:1])


def polar_page(reach: DriverRange, quantity: Quantity, language: str) -> ChartPage:
    """The polar diagram of a force: the end of its vector, drawn from one pole, over the way of the driver."""
    scene = reach.scene
    axis = driver_axis(reach, language)
    found = force_over_turn(axis, quantity.of)
    vector = np.asarray(found.values, dtype=complex)
    sizes = np.abs(vector)
    jumps = sorted({*_jumps(found, vector.real), *_jumps(found, vector.imag)})
    unit, name = quantity.unit(scene).text, _written(scene, quantity.of)
    title = say(Phrase("polar diagram of", (name,)), language)
    k = int(np.nanargmax(sizes))
    away = _unbounded(reach, found.offsets, sizes, float(found.offsets[k]), float(sizes[k]))
    mark = "°" if scene.drivers[0].turns else f" {scene.units.length}"
    greatest = f"{number(float(sizes[k]))} {unit}", f"{number(float(found.x[k]), 4)}{mark}"
    facts = [f"{name}{word('colon', language)}{word('unbounded', language)}" if away
             else say(Phrase("greatest force at", greatest), language)]  # fmt: skip
    most = span_of(np.stack([found.x, sizes], axis=1), bounded=not away)[1]
    whole = np.concatenate([vector[sizes <= most], [0j]])
    span = 1.12 * max(float(np.ptp(whole.real)), float(np.ptp(whole.imag))) or 1.0
    middle = complex(whole.real.max() + whole.real.min(), whole.imag.max() + whole.imag.min()) / 2
    ticks = axis.ticks[:-1] if reach.full else axis.ticks
    if len(ticks) > TICKS + 1:
        ticks = ticks[:: -(-len(ticks) // TICKS)]
    at = [int(np.argmin(np.abs(found.x - x))) for x in ticks]
    side = WIDTH - LEFT - RIGHT

    def paint(figure: Figure) -> None:
        add_words(figure, *heading(scene, title, facts, language))
        box = Box(LEFT, TOP - 4.0, LEFT + side, TOP - 4.0 + side)
        axes = add_panel(figure, box, quantity.name.replace("/", "-"), f"{name} ({unit})", f"({unit})")
        axes.set_xlim(middle.real - span / 2, middle.real + span / 2)
        axes.set_ylim(middle.imag - span / 2, middle.imag + span / 2)
        count_steps(axes.xaxis)
        count_steps(axes.yaxis)
        axes.axhline(0.0, zorder=BEHIND, **look(ZERO))
        axes.axvline(0.0, zorder=BEHIND, **look(ZERO))
        draw_pieces(axes, np.stack([vector.real, vector.imag], axis=1), jumps)
        for j in (j for j in at if sizes[j] <= most):
            axes.plot([vector[j].real], [vector[j].imag], **marker("circle"))
        labels = [(f"{number(float(x), 4)}{mark if mark == '°' else ''}", (vector[j].real, vector[j].imag)) for x, j in
                  zip(ticks, at, strict=True) if sizes[j] <= most]  # fmt: skip
        toward = [(float(np.angle(vector[j])),) for j in at if sizes[j] <= most]
        add_labels(axes, labels, toward=toward)

    return ChartPage(
        WIDTH, TOP + side + 16.0, paint, title=f"{quantity.name}: {title_of(scene, language)}",
        desc=facts[0], lang=language, metadata={"scene": scene.name, "units": unit, "quantity": quantity.name},
    )  # fmt: skip


MOMENT_TOP, MOMENT_TALL, ENERGY_LOW, ENERGY_GAP = 46.0, 100.0, 62.0, 12.0  # mm
DRIVING = Stroke(0.35, (6.0, 1.2))
MORE, LESS = "#dcdcdc", "#b8b8b8"


def flywheel_page(reach: DriverRange, found: FlywheelStudy, language: str) -> ChartPage:
    """The page of a flywheel."""
    scene, axis = reach.scene, driver_axis(reach, language)
    per, force = scene.units.newtons, scene.units.force
    moment, inertia = f"{force}·m", f"{scene.units.mass}·{'ft' if scene.units.mass == 'lb' else 'm'}²"
    offsets = whole_turn(axis)
    x = axis.at(offsets)
    x[0], x[-1] = axis.left, axis.right
    needed, driving = needed_moment(reach, offsets) / per, found.driving / per
    # the way that the axis goes, from where it begins
    way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(np.radians(x))))])
    energy = _energy(needed, driving, way)
    panel = course(Quantity("moment", "M"), "", ForceRun(offsets, x, needed), needed)
    title = word("moments and flywheel", language)
    facts = [
        say(Phrase("driving moment is", (f"{number(driving)} {moment}",)), language),
        say(Phrase("excess work is", (f"{number(found.excess / per)} {moment}",)), language),
        f"$δ$ = {number(found.delta)}",
        f"$J_{{F}}$ = {number(found.inertia / scene.units.inertias)} {inertia}",
    ]

    def paint(figure: Figure) -> None:
        add_words(figure, *heading(scene, title, facts, language))
        entries = [(look(SOLID_AND_DASHED[0]), word("needed moment", language)),
                   (look(DRIVING), word("driving moment", language))]  # fmt: skip
        add_legend(figure, complex(LEFT, MOMENT_TOP - 9.5), entries)
        box = Box(LEFT, MOMENT_TOP, WIDTH - RIGHT, MOMENT_TOP + MOMENT_TALL)
        axes = add_panel(figure, box, "moments", f"$M$ ({moment})")
        draw_panel(axes, panel, axis, language)
        low, high = panel.span
        axes.set_ylim(min(low, driving - MARGIN * (high - low)), max(high, driving + MARGIN * (high - low)))
        axes.axhline(driving, **look(DRIVING))
        for over, colour in ((needed < driving, MORE), (needed > driving, LESS)):
            axes.fill_between(x, needed, driving, where=over, color=colour, linewidth=0.0, zorder=0.5, interpolate=True)
        axes.tick_params(labelbottom=False)
        labels = []
        for area in _joined(found.areas, reach.ends[1]):
            middle = float(axis.at(np.array([(area.first + area.last) / 2 % reach.ends[1]]))[0])
            near = float(np.interp(middle, *_growing(x, needed)))
            sign = "+" if area.work > 0 else ""
            labels.append((f"{sign}{number(area.work / per)}", (middle, (near + driving) / 2)))
        add_labels(axes, labels)
        top = MOMENT_TOP + MOMENT_TALL + ENERGY_GAP
        store = add_panel(
            figure, Box(LEFT, top, WIDTH - RIGHT, top + ENERGY_LOW), "energy", f"$ΔE$ ({moment})", axis.title
        )
        store.set_xlim(axis.left, axis.right)
        least, most = float(energy.min()), float(energy.max())
        room = 1.6 * MARGIN * (most - least) or 0.5
        store.set_ylim(least - room, most + room)
        count_steps(store.xaxis, axis.step)
        count_steps(store.yaxis)
        store.axhline(0.0, zorder=BEHIND, **look(Stroke(0.18)))
        store.plot(x, energy, **look(SOLID_AND_DASHED[0]))
        names = []
        for k, sign, letter in ((int(np.argmax(energy)), "up", "max"), (int(np.argmin(energy)), "down", "min")):
            store.plot([x[k]], [energy[k]], **marker("up" if sign == "up" else "down"))
            names.append((f"$ω$ {letter}", (float(x[k]), float(energy[k]))))
        add_labels(store, names, toward=[(math.pi / 2,), (-math.pi / 2,)])

    return ChartPage(
        WIDTH, MOMENT_TOP + MOMENT_TALL + ENERGY_GAP + ENERGY_LOW + 20.0, paint,
        title=f"{title}: {title_of(scene, language)}", desc="; ".join(facts).replace("$", ""), lang=language,
        metadata={"scene": scene.name, "units": moment, "flywheel": found.link},
    )  # fmt: skip


def _growing(x: Array, values: Array) -> tuple[Array, Array]:
    order = np.argsort(x, kind="stable")
    return x[order], values[order]


def _energy(needed: Array, driving: float, way: Array) -> Array:
    """Kinetic energy gained since the axis begins, by the trapezoidal rule: for the eye."""
    gain = (driving - (needed[1:] + needed[:-1]) / 2) * np.diff(way)
    return np.concatenate([[0.0], np.cumsum(gain)])


def _joined(areas: tuple[MomentArea, ...], cycle: float) -> list[MomentArea]:
    """The areas of a cycle, the last and the first being one where both are of one sign."""
    kept = [area for area in areas if area.last > area.first]
    if len(kept) > 1 and (kept[0].work > 0) == (kept[-1].work > 0):
        both = MomentArea(kept[-1].first, kept[0].last + cycle, kept[-1].work + kept[0].work)
        kept = [both, *kept[1:-1]]
    return kept
