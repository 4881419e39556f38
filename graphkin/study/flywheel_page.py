"""The flywheel of a scene, as a page: driving and needed moment over the driver with the areas between them, and the
kinetic energy that they store."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

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
from graphkin.solver import DriverRange
from graphkin.solver.flywheel import FlywheelStudy, MomentArea, needed_moment
from graphkin.study.driver_axis import LEFT, RIGHT, WIDTH, driver_axis, heading, number, title_of
from graphkin.study.force_diagrams import MARGIN, ForceRun, draw_course, whole_turn
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    from graphkin.drawing.chart import Figure

__all__ = ["flywheel_page"]

Array = NDArray[np.float64]

TOP, TALL, LOW, GAP = 46.0, 100.0, 62.0, 12.0  # mm
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
        add_legend(figure, complex(LEFT, TOP - 9.5), entries)
        axes = add_panel(figure, Box(LEFT, TOP, WIDTH - RIGHT, TOP + TALL), "moments", f"$M$ ({moment})")
        draw_course(axes, axis, ForceRun(offsets, x, needed), needed)
        low, high = axes.get_ylim()
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
        top = TOP + TALL + GAP
        store = add_panel(
            figure, Box(LEFT, top, WIDTH - RIGHT, top + LOW), "energy", f"$ΔE$ ({moment})", axis.title
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
        WIDTH, TOP + TALL + GAP + LOW + 20.0, paint, title=f"{title}: {title_of(scene, language)}",
        desc="; ".join(facts).replace("$", ""), lang=language,
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
