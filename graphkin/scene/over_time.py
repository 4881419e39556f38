"""Drivers over the time: those with a law at the moment of their law, the others on from where they stand."""

from __future__ import annotations

from dataclasses import replace

from graphkin.errors import CallError, Problem
from graphkin.scene.model import Driver, Mechanism
from graphkin.words import Phrase

__all__ = ["asked_time", "at_time", "moments", "moves_by_law", "time_span"]


def moves_by_law(scene: Mechanism) -> bool:
    """Whether a driver moves by a law over the time."""
    return any(d.law is not None for d in scene.drivers)


def asked_time(scene: Mechanism) -> float:
    """The moment (s) at which the scene stands as it is: that of its first law."""
    return next((d.law.time for d in scene.drivers if d.law is not None), 0.0)


def time_span(scene: Mechanism) -> tuple[float, float]:
    """The moments (s) from which and to which laws say how drivers move."""
    laws = [d.law for d in scene.drivers if d.law is not None]
    return min(law.pieces[0].start for law in laws), max(law.duration for law in laws)


def moments(scene: Mechanism, count: int) -> tuple[float, ...]:
    """So many moments (s), evenly from the beginning of the laws to their end."""
    low, high = time_span(scene)
    return (*(low + (high - low) * k / max(count - 1, 1) for k in range(count - 1)), high)


def at_time(scene: Mechanism, time: float) -> tuple[Mechanism, dict[str, float]]:
    """The scene with the rates of its drivers at a moment (s), and their values (rad, m) by their keys.

    A driver without a law goes on from its own value, at the moment that the scene asks, with its omega and alpha.

    Raises
    ------
    CallError : a moment before or after all laws
    """
    low, high = time_span(scene)
    if not low <= time <= high:
        raise CallError(
            Problem(
                "at time",
                Phrase("found s", time=f"{time:g}"),
                Phrase("the law goes from to s", start=f"{low:g}", duration=f"{high:g}"),
            )
        )
    drivers: list[Driver] = []
    values: dict[str, float] = {}
    since = time - asked_time(scene)
    for driver in scene.drivers:
        if driver.law is not None:
            values[driver.key] = driver.law.at(time).lift
            drivers.append(driver.moving(replace(driver.law, time=time)))
            continue
        value, rate, second = driver.values
        values[driver.key] = value + since * (rate + since * second / 2)
        now = rate + since * second
        drivers.append(driver if now == rate else replace(driver, rate=now))
    return replace(scene, drivers=tuple(drivers)), values
