"""All methods on the same work, in one run; as a table, and as data for programs.  Those that draw: the exact board, a
drafting program, pencil and ruler at several scales, instant centres."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from graphkin import solver
from graphkin.checking.readings import read_off
from graphkin.construction import EXACT, Cad, Instrument, Plan, Scales, execute, pencil, plan
from graphkin.construction.centres import by_centres, find_centres, speeds
from graphkin.files import Json
from graphkin.races.computed import closed_forms, complex_step, copy_time, differences, newton, one_by_one
from graphkin.races.timing import Entry, Machine, Skipped, best_time, this_machine
from graphkin.races.work import ComparedPoint, Work, work_of
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver.pose import Array
from graphkin.study.reference import context
from graphkin.table import Table
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    from mpmath import MPContext

__all__ = ["COUNT", "Race", "race", "race_table", "to_json"]

COUNT = 100_800


EVERY = 4
SEEDS = 3
SCALES = (0.25, 0.5, 1.0, 2.0, 4.0)
PEERS = "pylinkage", "scipy"
"""Other programs, by the names in `graphkin.races.peers`."""
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


@dataclass(frozen=True)
class Race:
    """What every method costs and how far it is off.

    copying : cost of copying the velocities of a position, and with the accelerations (s)
    acts : acts of the hand in one drawing
    skipped : peers left out, with the reason
    asked : what the limited runs were asked for
    """

    scene: Mechanism
    entries: tuple[Entry, ...]
    copying: tuple[float, float]
    acts: int
    repeats: int
    count: int
    places: int
    machine: Machine
    skipped: tuple[tuple[str, Phrase], ...]
    asked: tuple[Symbol, ...]

    def of(self, key: str, tag: str = "") -> Entry:
        return next(e for e in self.entries if e.key == key and e.tag == tag)


def race(scene: Mechanism, repeats: int, count: int = COUNT) -> Race:
    """Let all methods run.

    Parameters
    ----------
    repeats : runs of each, of which the fastest counts
    count : positions of which the time is taken, for the methods that compute many at once

    Raises
    ------
    CallError : mpmath is not installed, a group larger than a dyad, nothing that moves
    Unsolvable : as for ``solver.solve``
    """
    mp: MPContext = context()
    work = work_of(scene, mp, count)
    entries: list[Entry] = [*closed_forms(work, repeats), *_solver(work, repeats)]
    for method in (newton, differences, complex_step, drawn, instant_centres):
        entries += method(work, repeats)
    entries.append(one_by_one(work.only(work.asked_outputs()), repeats, "asked"))
    skipped = []
    for name in PEERS:
        try:
            entries += _peer(name, work, repeats)
        except Skipped as why:
            skipped.append((name, why.why))
    by_hand = acts(plan(scene, work.at(0), ()), "acceleration")
    return Race(
        scene, tuple(entries), copy_time(work, repeats), by_hand, repeats, work.count, len(work.values),
        this_machine(), tuple(skipped), work.asked,
    )  # fmt: skip


def _peer(name: str, work: Work, repeats: int) -> list[Entry]:
    """Another program on the work.  Raises Skipped where it cannot do it, or is not raced from here."""
    try:
        from graphkin.races import peers
    except ImportError:  # a wheel has none
        raise Skipped("wheel") from None
    return list(peers.PEERS[name](work, repeats))


def _solver(work: Work, repeats: int) -> Iterator[Entry]:
    """``solver.solve`` over a turn: the closed form with continuity, status and bounds of every position."""
    if not work.full:
        return
    count = work.count // 10
    whole = best_time(lambda: solver.solve(work.scene, sweep=count), repeats) / count
    motion = solver.solve(work.scene, sweep=len(work.motion))
    at = [int(np.argmin(np.max(np.abs(motion.values - v), axis=1))) for v in work.values]
    v = np.array([motion.velocity(o.point, o.link)[at] for o in work.outputs])
    a = np.array([motion.acceleration(o.point, o.link)[at] for o in work.outputs])
    yield Entry("closed", "whole solve", "", whole, whole, *work.errors(v, a))


def race_table(race: Race) -> Table:
    """One row for each method; first the floor."""
    numbers = ("velocity_cost_s", "velocity_error", "acceleration_cost_s", "acceleration_error")
    rows: list[tuple[object, ...]] = [("copying", "", "floor", race.copying[0], None, race.copying[1], None)]
    rows += [
        (e.key, e.tag, e.family, e.velocity_cost, e.velocity_error, e.acceleration_cost, e.acceleration_error)
        for e in race.entries
    ]
    return Table.of(("method", "tag", "family", *numbers), rows, ("", "", "", *(".3g" for _ in numbers)))


def to_json(race: Race, language: str = "en") -> dict[str, Json]:
    """Costs in s for a position, errors in parts of the largest value, and what it was measured on."""
    return {
        "scene": race.scene.name,
        "machine": {
            "cores": race.machine.cores, "processor": race.machine.processor, "versions": dict(race.machine.versions)
        },
        "repeats": race.repeats,
        "positions": race.count,
        "places": race.places,
        "copying_s": list(race.copying),
        "asked": [str(s) for s in race.asked],
        "methods": [
            {
                "method": e.key,
                "tag": e.tag,
                "family": e.family,
                "says": word("differences of" if e.key == "differences" else e.key, language),
                "velocity": {"cost_s": e.velocity_cost, "error": e.velocity_error},
                "acceleration": {"cost_s": e.acceleration_cost, "error": e.acceleration_error},
            }
            for e in race.entries
        ],
        "left_out": [{"peer": name, "why": say(why, language)} for name, why in race.skipped],
    }  # fmt: skip
