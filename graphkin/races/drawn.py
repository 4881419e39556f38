"""Methods that draw: the exact board, a drafting program, pencil and ruler at several scales, instant centres."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from graphkin.checking.readings import read_off
from graphkin.construction import EXACT, Cad, Instrument, Plan, Scales, execute, pencil, plan
from graphkin.construction.centres import by_centres, find_centres, speeds
from graphkin.races.timing import Entry, best_time
from graphkin.races.work import ComparedPoint, Work
from graphkin.scene.symbol import Symbol
from graphkin.solver.pose import Array

__all__ = ["SECONDS", "acts", "drawn", "instant_centres"]

EVERY = 4
SEEDS = 3
SCALES = (0.25, 0.5, 1.0, 2.0, 4.0)
SECONDS = 20.0
"""What a person needs for one act at the board: setting a square, laying off, pricking, reading."""


def drawn(work: Work, repeats: int) -> Iterator[Entry]:
    """The whole construction with each instrument; and the exact one only as far as what is asked for."""
    kept, own = work.some(EVERY)
    plans = [plan(work.scene, work.at(k), ()) for k in kept]
    yield _entry(own, plans, "exact drawing", "", [EXACT], repeats)
    yield _entry(own, plans, "cad drawing", "", [Cad()], repeats)
    tools = work.scene.sheet.tools
    for factor in SCALES:
        larger = [_larger(p, factor) for p in plans]
        hands: list[Instrument] = [pencil(tools, seed) for seed in range(SEEDS)]
        entry = _entry(own, larger, "pencil", f"{factor:g}", hands, repeats)
        yield entry
        costs = [acts(p, of_order) * SECONDS for p, of_order in ((larger[0], "velocity"), (larger[0], "acceleration"))]
        yield replace(entry, family="by hand", key="by hand", velocity_cost=costs[0], acceleration_cost=costs[1])
    few = own.only(own.asked_outputs())
    symbols = [Symbol(kind, o.ref) for o in few.outputs for kind in ("v", "a")]
    short = [plan(work.scene, work.at(k), symbols) for k in kept]
    yield _entry(few, short, "exact drawing", "asked", [EXACT], repeats)


def _larger(what: Plan, factor: float) -> Plan:
    s = what.scales
    return replace(what, scales=Scales(s.length / factor, s.velocity / factor, s.acceleration / factor))


def acts(what: Plan, order: str) -> int:
    """Acts of the hand in drawing a plan and reading it off, as far as velocities or with accelerations."""
    hand = pencil(what.structure.scene.sheet.tools, 0)
    sheet = execute(what, hand)
    read_off(sheet, (), hand)
    share = 1.0
    if order == "velocity":
        share = sum(s.diagram != "acceleration" for s in sheet.steps) / len(sheet.steps)
    return round(hand.acts * share)


def _entry(
    work: Work, plans: Sequence[Plan], key: str, tag: str, hands: Sequence[Instrument], repeats: int
) -> Entry:
    worst: list[float | None] = [0.0, 0.0]
    for hand in hands:
        tables = [_readings(p, hand) for p in plans]
        errors = work.errors(*(_columns(work, work.outputs, tables, kind) for kind in ("v", "a")))
        worst = [None if w is None or e is None else max(w, e) for w, e in zip(worst, errors, strict=True)]
    whole = best_time(lambda: [read_off(execute(p, hands[0]), (), hands[0]) for p in plans], repeats) / len(plans)
    part = sum(s.diagram != "acceleration" for s in execute(plans[0], EXACT).steps) / len(execute(plans[0]).steps)
    return Entry("drawn", key, tag, whole * part, whole, worst[0], worst[1])


def _readings(what: Plan, hand: Instrument) -> Mapping[Symbol, complex]:
    return {r.symbol: complex(r.value) for r in read_off(execute(what, hand), (), hand)}


def _columns(
    work: Work, outputs: Sequence[ComparedPoint], tables: Sequence[Mapping[Symbol, complex]], kind: str
) -> Array | None:
    rows = [[table.get(Symbol(kind, o.ref), complex(math.nan)) for table in tables] for o in outputs]
    found = np.array(rows)
    return None if np.isnan(found).any() else found


def instant_centres(work: Work, repeats: int) -> Iterator[Entry]:
    """Velocities by centres, found on the drawn position; they give no accelerations."""
    kept, own = work.some(EVERY)
    sheets = [execute(plan(work.scene, work.at(k), ())) for k in kept]
    tables: list[dict[Symbol, complex]] = []
    symbols = [Symbol("v", o.ref) for o in own.outputs]
    for sheet in sheets:
        centres = find_centres(work.scene, sheet.drivers, sheet=sheet)
        turning = speeds(centres)
        found = {s: by_centres(centres, turning, s) for s in symbols}
        tables.append({s: complex(v) for s, v in found.items() if v is not None})
    error = own.errors(_columns(own, own.outputs, tables, "v"), None)[0]
    if error is None:
        return
    what = [(sheet, sheet.drivers) for sheet in sheets]
    cost = best_time(
        lambda: [speeds(find_centres(work.scene, at, sheet=sheet)) for sheet, at in what], repeats
    ) / len(what)
    yield Entry("drawn", "instant centres", "", cost, cost, error, None)
