"""Forces over the turn, as pages: the diagram of a force or a moment, the polar diagram of a force, and the flywheel of
a scene: driving and needed moment with the areas between them, and the kinetic energy that they store.

Where a load begins, ends or reverses the curve jumps: both its values are shown, joined by a vertical line.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from graphkin.account.spoken import spoken_words
from graphkin.drawing import Box, chart
from graphkin.drawing.ink.primitives import Stroke
from graphkin.scene.model import forces_named
from graphkin.scene.symbol import Symbol
from graphkin.solver import DriverRange
from graphkin.solver.forces import forces_of, value_of
from graphkin.solver.values import FlywheelStudy, load_edges, needed_moment
from graphkin.study import charts
from graphkin.study.extremes import Extreme
from graphkin.study.quantities import course_of
from graphkin.words import Phrase, rich_text, say, word
from graphkin.words.symbols import Words, sign, spaced

JUMP = 1e-8
"""Of the range: so far on both sides of where a load begins or ends its two values are taken."""
GROWS = 50.0
"""Beside the samples next to an end of the motion, and of a hundred times nearer to a place inside: what grows more
there goes away without bound."""
BESIDE = np.array([1e-5, 1e-4, 1e-3])
"""Of the range: so far beside a place inside it is seen whether a force grows without bound there."""
UNKNOWN_HERE = 1e-5
"""Of the range: an extreme this near to a sample without forces stands there."""
PEAK = 20.0
"""Of the middle one of all sizes: a peak that is lower grows nowhere without bound."""
NOUGHT = 1e-12
"""Of the greatest force or moment: less is nothing but rounding."""
TICKS = 12


def whole_turn(axis: charts.DriverAxis) -> charts.Array:
    """Offsets along the axis, with two on both sides of each jump of the forces."""
    low, high = axis.reach.ends
    eps = JUMP * (high - low)
    beside = np.concatenate([[edge - eps, edge + eps] for edge in load_edges(axis.reach)] or [[]])
    if axis.reach.full:
        along = np.concatenate([(axis.offsets[:-1] - axis.first) % high, (beside - axis.first) % high])
        along = np.unique(np.concatenate([along, [0.0, high * (1 - 1e-12)]]))
        return (along + axis.first) % high
    return np.unique(np.concatenate([axis.offsets, beside[(beside > low) & (beside < high)]]))


def force_panel(axis: charts.DriverAxis, quantity: Symbol, offsets: charts.Array) -> charts.Panel:
    """A moment, or the size of a force, over the driver, with its greatest and its least value."""
    values = course_of(quantity, axis.reach, axis.reach.motion(offsets))
    curve, extremes = axis.curve(quantity, offsets, values), _extremes(axis, quantity, offsets, values)
    away = any(math.isinf(e.value) for e in extremes)
    return charts.panel_of(axis, quantity, curve, extremes, away, jumps=jumps_of(curve))


def force_page(reach: DriverRange, quantity: Symbol, language: str) -> chart.ChartPage:
    """The diagram of a moment, or of the size of a force, over the driver."""
    axis = charts.DriverAxis(reach)
    panel = force_panel(axis, quantity, whole_turn(axis))
    title = rich_text(Phrase("diagram of", quantity=charts.lettered(reach.scene, quantity)), language)
    units = quantity.unit(reach.scene.units).written
    return charts.chart_page(axis, [panel], (), language, title=title, units=units)


def jumps_of(curve: charts.Array) -> list[int]:
    """The points after which a curve, shape (n, 2), jumps: two points at the same place of the axis."""
    x, values = curve.T
    wide = float(np.nanmax(np.abs(values), initial=0.0))
    step, leap = np.abs(np.diff(x)), np.abs(np.diff(values))
    return np.flatnonzero((step < 1e-5 * float(np.ptp(x))) & (leap > 1e-6 * wide)).tolist()


def force_extremes(reach: DriverRange) -> dict[str, tuple[Symbol, tuple[Extreme, ...]]]:
    """The greatest and the least of each joint force by size, and of each couple and balance that is not zero, over the
    driver's range (SI); infinite where it grows without bound, at an end of the motion or where a balance does no work.

    Raises
    ------
    Unsolvable : a load acts on a part of a stroke, and the driver makes no whole turn
    """
    quantities = [force for force in forces_named(reach.scene) if force.kind in ("F", "M")]
    axis = charts.DriverAxis(reach)
    offsets = whole_turn(axis)
    motion = reach.motion(offsets)
    forces = forces_of(motion)
    most = max(float(np.nanmax(np.abs(value), initial=0.0)) for value in forces.values.values())
    extremes = dict[str, tuple[Symbol, tuple[Extreme, ...]]]()
    for quantity in quantities:
        value = forces.value(quantity)
        if value is not None and np.nanmax(np.abs(value), initial=0.0) > NOUGHT * most:
            extremes[str(quantity)] = quantity, _extremes(axis, quantity, offsets, course_of(quantity, reach, motion))
    return extremes


def _extremes(
    axis: charts.DriverAxis, quantity: Symbol, offsets: charts.Array, values: charts.Array
) -> tuple[Extreme, ...]:
    """The greatest and the least of a force or moment (SI), a single value of a constant; infinite where it grows
    without bound, at an end of the motion or inside."""
    known = np.flatnonzero(np.isfinite(values))
    if not len(known):
        return ()
    if np.ptp(values[known]) <= NOUGHT * np.abs(values[known]).max():  # it is the same everywhere, but for rounding
        at, value = float(offsets[known[0]]), float(values[known[0]])
        return (Extreme("max", at, axis.driver(at), value),)
    away = [*_away_inside(axis, quantity, offsets, values)]
    if not axis.reach.full:
        away += _away_at_ends(axis, quantity, offsets, values)
    extremes = list[Extreme]()
    for finite in axis.extremes(quantity, offsets, values):
        sign = 1.0 if finite.kind == "max" else -1.0
        places = {place for place, growing in away if growing == sign}
        infinite = [Extreme(finite.kind, place, axis.driver(place), sign * math.inf) for place in places]
        infinite.sort(key=lambda extreme: extreme.driver)
        extremes += infinite or [_at_idle(axis, finite, offsets[~np.isfinite(values)])]
    return tuple(extremes)


def _at_idle(axis: charts.DriverAxis, extreme: Extreme, unknown: charts.Array) -> Extreme:
    """The extreme at the nearest place without forces, as where a balance does no work."""
    distances = np.abs(unknown - extreme.offset)
    if not len(unknown) or distances.min() > UNKNOWN_HERE * float(np.ptp(axis.reach.ends)):
        return extreme
    place = float(unknown[distances.argmin()])
    return replace(extreme, offset=place, driver=axis.driver(place))


_Away: TypeAlias = tuple[float, float]
"""An offset towards which a force grows without bound, and the sign with which it does."""


def _away_at_ends(
    axis: charts.DriverAxis, quantity: Symbol, offsets: charts.Array, values: charts.Array
) -> Iterator[_Away]:
    """The ends of the motion towards which a force grows without bound."""
    usual = float(np.nanmedian(np.abs(values)))
    for end, part, inner in ((0, slice(0, 6), slice(3, 6)), (1, slice(-6, None), slice(-6, -3))):
        if not np.isfinite(values[part]).any():
            continue
        inside = max(usual, float(np.nanmax(np.abs(values[inner]), initial=0.0)))
        for extreme in axis.extremes(quantity, offsets[part], values[part]):
            if abs(extreme.value) > GROWS * inside:
                yield axis.reach.ends[end], math.copysign(1.0, extreme.value)


def _away_inside(
    axis: charts.DriverAxis, quantity: Symbol, offsets: charts.Array, values: charts.Array
) -> Iterator[_Away]:
    """The places inside the motion towards which a force grows without bound, as where a balance does no work: with the
    reciprocal of the distance from there, hundredfold at a hundredth."""
    (low, high), size = axis.reach.ends, np.abs(values)
    before, here, after = size[:-2], size[1:-1], size[2:]
    peaks = np.flatnonzero((here > before) & (here > after) & (here > PEAK * np.nanmedian(size)))
    tops = [max(axis.extremes(quantity, offsets[k : k + 3], values[k : k + 3]), key=lambda e: abs(e.value)).offset
            for k in peaks.tolist()]
    near, known = UNKNOWN_HERE * (high - low), [] if axis.reach.full else [low]
    for place in (*offsets[~np.isfinite(values)].tolist(), *tops):
        if any(abs(math.remainder(place - other, high - low)) <= near for other in known):
            continue
        known.append(place)
        beside = place + np.outer([-1.0, 1.0], BESIDE) * (high - low)
        beside = (beside - low) % (high - low) + low if axis.reach.full else np.clip(beside, low, high)
        nearer, between, farther = axis.values(quantity, beside.ravel()).reshape(beside.shape).T
        # where a load begins the force is more too, but does not grow on
        usual = GROWS * np.maximum(np.abs(farther), 0.1 * np.abs(between))
        for value in nearer[np.abs(nearer) > usual].tolist():
            yield place, math.copysign(1.0, value)


def polar_page(reach: DriverRange, quantity: Symbol, language: str) -> chart.ChartPage:
    """The polar diagram of a force: the end of its vector, drawn from one pole, over the way of the driver."""
    scene, axis = reach.scene, charts.DriverAxis(reach)
    offsets, unit = whole_turn(axis), quantity.unit(scene.units)
    panel = force_panel(axis, quantity, offsets)
    x, sizes = panel.curve.T
    vector = np.asarray(unit.of(value_of(reach.motion(offsets), quantity)), dtype=complex)
    jumps = sorted({j for part in (vector.real, vector.imag) for j in jumps_of(np.stack([x, part], axis=1))})
    name = charts.lettered(scene, quantity)
    title = rich_text(Phrase("polar diagram of", force=name), language)
    mark = "°" if scene.drivers[0].turns else f" {scene.units.length}"
    facts: list[Words] = [name + word("colon", language) + word(panel.without_bound, language)]
    if not panel.unbounded:
        _, driver, greatest = next(extreme for extreme in panel.extremes if extreme[0].kind == "max")
        size, place = f"{charts.number(greatest)} {unit.text}", f"{charts.number(driver, 4)}{mark}"
        facts = [say(Phrase("greatest force at", force=size, place=place), language)]
    most = charts.span_of(panel.curve, charts.EMPTY, not panel.unbounded)[1]
    whole = np.concatenate([vector[sizes <= most], [0j]])
    span = 1.12 * max(float(np.ptp(whole.real)), float(np.ptp(whole.imag))) or 1.0
    middle = complex(whole.real.max() + whole.real.min(), whole.imag.max() + whole.imag.min()) / 2
    ticks = axis.ticks[:-1] if reach.full else axis.ticks
    if len(ticks) > TICKS + 1:
        ticks = ticks[:: -(-len(ticks) // TICKS)]
    at = [(float(tick), j) for tick in ticks if sizes[j := int(np.argmin(np.abs(x - tick)))] <= most]
    side = charts.WIDTH - charts.LEFT - charts.RIGHT

    def paint(figure: chart.Figure) -> None:
        box = Box(charts.LEFT, charts.TOP - 4.0, charts.LEFT + side, charts.TOP - 4.0 + side)
        axes = chart.add_panel(figure, box, str(quantity).replace("/", "-"), name + f" ({unit.text})", f"({unit.text})")
        axes.set_xlim(middle.real - span / 2, middle.real + span / 2)
        axes.set_ylim(middle.imag - span / 2, middle.imag + span / 2)
        chart.count_steps(axes.xaxis)
        chart.count_steps(axes.yaxis)
        axes.axhline(0.0, zorder=chart.BEHIND, **chart.look(charts.ZERO))
        axes.axvline(0.0, zorder=chart.BEHIND, **chart.look(charts.ZERO))
        charts.draw_pieces(axes, np.stack([vector.real, vector.imag], axis=1), jumps)
        labels, toward = [], []
        for tick, j in at:
            place = float(vector[j].real), float(vector[j].imag)
            axes.plot([place[0]], [place[1]], **chart.marker("circle"))
            labels.append((f"{charts.number(tick, 4)}{mark if mark == '°' else ''}", place))
            toward.append((float(np.angle(vector[j])),))
        chart.add_labels(axes, labels, toward=toward)

    return charts.headed_page(
        scene, charts.TOP + side + 16.0, paint, title, facts, language, str(quantity), str(facts[0]),
        units=unit.text, quantity=str(quantity),
    )


MOMENT_TOP, MOMENT_TALL, ENERGY_LOW, ENERGY_GAP = 46.0, 100.0, 62.0, 12.0  # mm
DRIVING = Stroke(0.35, (6.0, 1.2))
MORE, LESS = "#dcdcdc", "#b8b8b8"


def flywheel_page(reach: DriverRange, study: FlywheelStudy, language: str) -> chart.ChartPage:
    """The page of a flywheel."""
    scene, axis = reach.scene, charts.DriverAxis(reach)
    per, moment, inertia = scene.units.newtons, scene.units.of("moment").written, scene.units.of("inertia")
    offsets, moments = whole_turn(axis), Symbol("M", link=study.link)
    curve = axis.curve(moments, offsets, needed_moment(reach, offsets))
    (x, needed), driving = curve.T, study.driving / per
    # gained since the axis begins, by the trapezoidal rule: for the eye
    gain = (driving - (needed[1:] + needed[:-1]) / 2) * np.abs(np.diff(np.radians(x)))
    energy = np.concatenate([[0.0], np.cumsum(gain)])
    panel = charts.panel_of(axis, moments, curve, (), jumps=jumps_of(curve))
    title = word("moments and flywheel", language)
    facts: list[Words] = [
        say(Phrase("driving moment is", moment=f"{charts.number(driving)} {moment}"), language),
        say(Phrase("excess work is", work=f"{charts.number(study.excess / per)} {moment}"), language),
        sign("δ") + f" = {charts.number(study.delta)}",
        sign("J", "F") + f" = {charts.number(study.inertia / inertia.si)} {inertia.written}",
    ]

    def paint(figure: chart.Figure) -> None:
        entries = [(chart.look(chart.SOLID_AND_DASHED[0]), word("needed moment", language)),
                   (chart.look(DRIVING), word("driving moment", language))]
        chart.add_legend(figure, complex(charts.LEFT, MOMENT_TOP - 9.5), entries)
        box = Box(charts.LEFT, MOMENT_TOP, charts.WIDTH - charts.RIGHT, MOMENT_TOP + MOMENT_TALL)
        axes = chart.add_panel(figure, box, "moments", sign("M") + f" ({moment})")
        charts.draw_panel(axes, panel, axis, language)
        low, high = panel.span
        room = charts.MARGIN * (high - low)
        axes.set_ylim(min(low, driving - room), max(high, driving + room))
        axes.axhline(driving, **chart.look(DRIVING))
        for over, colour in ((needed < driving, MORE), (needed > driving, LESS)):
            axes.fill_between(x, needed, driving, where=over, color=colour, linewidth=0.0, zorder=0.5, interpolate=True)
        axes.tick_params(labelbottom=False)
        labels, growing = [], np.argsort(x, kind="stable")
        for (first, last), work in _joined(study.areas, reach.ends[1]).items():
            middle = float(axis.at(np.array([(first + last) / 2 % reach.ends[1]]))[0])
            near = float(np.interp(middle, x[growing], needed[growing]))
            labels.append(("+" * (work > 0) + charts.number(work / per), (middle, (near + driving) / 2)))
        chart.add_labels(axes, labels)
        top = MOMENT_TOP + MOMENT_TALL + ENERGY_GAP
        box = Box(charts.LEFT, top, charts.WIDTH - charts.RIGHT, top + ENERGY_LOW)
        store = chart.add_panel(figure, box, "energy", sign("ΔE") + f" ({moment})", axis.title(language))
        store.set_xlim(*axis.ends)
        least, most = float(energy.min()), float(energy.max())
        room = 1.6 * charts.MARGIN * (most - least) or 0.5
        store.set_ylim(least - room, most + room)
        chart.count_steps(store.xaxis, axis.step)
        chart.count_steps(store.yaxis)
        store.axhline(0.0, zorder=chart.BEHIND, **chart.look(Stroke(0.18)))
        store.plot(x, energy, **chart.look(chart.SOLID_AND_DASHED[0]))
        names = []
        for k, letter in ((int(energy.argmax()), "max"), (int(energy.argmin()), "min")):
            store.plot([x[k]], [energy[k]], **chart.marker("up" if letter == "max" else "down"))
            names.append((sign("ω") + f" {letter}", (float(x[k]), float(energy[k]))))
        chart.add_labels(store, names, toward=[(math.pi / 2,), (-math.pi / 2,)])

    return charts.headed_page(
        scene, MOMENT_TOP + MOMENT_TALL + ENERGY_GAP + ENERGY_LOW + 20.0, paint, title, facts, language, title,
        spoken_words(spaced(word("list semicolon", language), facts), language), units=moment, flywheel=study.link,
    )


def _joined(areas: Mapping[tuple[float, float], float], cycle: float) -> dict[tuple[float, float], float]:
    """The areas of a cycle, the last and the first joined if they have the same sign."""
    kept = {ends: work for ends, work in areas.items() if ends[1] > ends[0]}
    if len(kept) > 1:
        first, *_, last = kept
        if (kept[first] > 0) == (kept[last] > 0):
            kept = {(last[0], first[1] + cycle): kept.pop(last) + kept.pop(first), **kept}
    return kept
