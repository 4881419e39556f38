"""All methods on the same work, in one run."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphkin import solver
from graphkin.construction import plan
from graphkin.scene.model import Scene
from graphkin.scene.symbol import Symbol
from graphkin.study.reference import context
from graphkin.study.speed.computed import closed_forms, complex_step, copy_time, differences, newton, one_by_one
from graphkin.study.speed.course import Work, work_of
from graphkin.study.speed.drawings import acts, drawn, instant_centres
from graphkin.study.speed.entry import Entry, best_time
from graphkin.study.speed.machine import Machine, this_machine
from graphkin.study.speed.peers import PEERS, Skipped
from graphkin.words import Phrase

__all__ = ["COUNT", "Race", "race"]

COUNT = 100_800


@dataclass(frozen=True)
class Race:
    """What every method costs and how far it is off.

    copying : cost of copying the velocities of a position, and with the accelerations (s)
    acts : acts of the hand in one drawing
    skipped : peers left out, with the reason
    asked : what the limited runs were asked for
    """

    scene: Scene
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


def race(scene: Scene, repeats: int, count: int = COUNT) -> Race:
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
    mp: Any = context()
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
