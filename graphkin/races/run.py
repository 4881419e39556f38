"""All methods on the same work, in one run; as a table, and as data for programs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from graphkin import solver
from graphkin.construction import plan
from graphkin.files import Json
from graphkin.races.computed import closed_forms, complex_step, copy_time, differences, newton, one_by_one
from graphkin.races.drawn import acts, drawn, instant_centres
from graphkin.races.peers import PEERS, Skipped
from graphkin.races.timing import Entry, Machine, best_time, this_machine
from graphkin.races.work import Work, work_of
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.study.reference import context
from graphkin.table import Table
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    from mpmath import MPContext

__all__ = ["COUNT", "Race", "race", "race_table", "to_json"]

COUNT = 100_800


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
    for name, peer in PEERS.items():
        try:
            entries += _tried(peer, work, repeats)
        except Skipped as why:
            skipped.append((name, why.why))
    by_hand = acts(plan(scene, work.at(0), ()), "acceleration")
    return Race(
        scene, tuple(entries), copy_time(work, repeats), by_hand, repeats, work.count, len(work.values),
        this_machine(), tuple(skipped), work.asked,
    )  # fmt: skip


def _tried(peer: Callable[[Work, int], Iterator[Entry]], work: Work, repeats: int) -> list[Entry]:
    return list(peer(work, repeats))


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
