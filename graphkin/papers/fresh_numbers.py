"""Fresh numbers for a scene file: which of them vary, by how much, rounded so that they look like a problem's.

A candidate depends on nothing but the seed, the number of the variant and the attempt, so that a set is the same
whatever computes it.
"""

from __future__ import annotations

import copy
import math
import random
from dataclasses import replace

from graphkin.files import OwnTables, Tables
from graphkin.frozen import dataclass
from graphkin.papers.fitting_numbers import fitted, fitting_keys
from graphkin.papers.vary_rules import asked_now, free_of_rules, ruled, ruled_keys
from graphkin.scene.file_keys import KeyPath, put_at, value_at

__all__ = ["Spread", "candidate", "round_step", "varied_keys"]


STEPS = (1.0, 2.0, 5.0)
SHY = 0.12  # part of its reach that a driver keeps off both ends


@dataclass(frozen=True)
class Spread:
    """How far the data vary: lengths, rates and teeth by a part of their size, places by a part of theirs, angles by
    all, or within the ``reach`` (degrees) of a first driver that cannot turn fully."""

    lengths: float = 0.15
    places: float = 0.08
    rates: float = 0.25
    teeth: float = 0.25
    angle_step: float = 5.0
    reach: tuple[float, float] | None = None

    def narrower(self) -> Spread:
        """For mechanisms that do not assemble with lengths much unlike their own."""
        return replace(self, lengths=0.4 * self.lengths, places=0.4 * self.places)


def round_step(value: float) -> float:
    """The step of the 1-2-5 series that is about a sixtieth of a value, so that its multiples look round beside it.

    >>> round_step(580), round_step(90), round_step(0.34)
    (5.0, 1.0, 0.005)
    """
    least = abs(value) / 60.0
    decade = 10.0 ** math.floor(math.log10(least))
    return max(s * decade for s in STEPS if s * decade <= least * (1 + 1e-9))


def varied_keys(source: Tables) -> tuple[tuple[KeyPath, str], ...]:
    """The numbers of a scene file that variants change, with what they are: "length", "place", "angle", "rate",
    "travel", or as `fitting_keys` says.  Zeros stay zero, and so do accelerations and the directions of guides."""
    found: list[tuple[KeyPath, str]] = []
    for name, link in source.get("links", {}).items():
        if "length" in link:
            found.append((("links", name, "length"), "length"))
    frame = source.get("frame", {})
    for point, xy in frame.get("points", {}).items():
        if isinstance(xy, dict):
            found.append((("frame", "points", point, "r"), "length"))
            continue
        found += [(("frame", "points", point, i), "place") for i in (0, 1) if xy[i]]
    for guide, table in frame.get("guides", {}).items():
        if isinstance(table.get("through"), list):
            found += [(("frame", "guides", guide, "through", i), "place") for i in (0, 1) if table["through"][i]]
    for name, cam in source.get("cams", {}).items():
        if cam.get("base", {}).get("r"):
            found.append((("cams", name, "base", "r"), "length"))
    drivers = source.get("driver", [])
    several = isinstance(drivers, list)
    for i, driver in enumerate(drivers if several else [drivers]):
        path: KeyPath = ("driver", i) if several else ("driver",)
        for key in ("angle", "travel", "omega", "rpm", "velocity"):
            if driver.get(key) or (key == "angle" and key in driver):
                kind = key if key in ("angle", "travel") else "rate"
                found.append(((*path, key), kind))
    return (*found, *fitting_keys(source))


def candidate(source: Tables, spread: Spread, seed: int, number: int, attempt: int) -> OwnTables:
    """One try at a variant: every number that varies drawn afresh and rounded; not looked at yet."""
    dice = random.Random(f"{seed}/{number}/{attempt}")
    made = copy.deepcopy(dict(source))
    for path, kind in free_of_rules(source, varied_keys(source)):
        limited = spread.reach if path in (("driver", "angle"), ("driver", 0, "angle")) else None
        value = float(value_at(source, path))
        put_at(made, path, _drawn(dice, value, kind, spread) if limited is None else _within(dice, limited, spread))
    ruled(source, made, dice, {"angle": spread.angle_step})
    tied = ruled_keys(source)
    fitted(source, made, lambda path: path not in tied)
    _said_once(made)
    asked = asked_now(source, dice)
    return {**made, "find": asked} if asked else made


def _said_once(made: OwnTables) -> None:
    """What other numbers say is not said twice: a driven link begins to roll where its driver has it, and a cam's
    offset is that of the guide."""
    for cam in made.get("cams", {}).values():
        cam.pop("offset", None)
    drivers = made.get("driver", [])
    for driver in drivers if isinstance(drivers, list) else [drivers]:
        made["links"].get(driver.get("link"), {}).pop("start", None)


def _drawn(dice: random.Random, value: float, kind: str, spread: Spread) -> float:
    if kind == "angle":
        turn = round(360.0 / spread.angle_step)
        angle = spread.angle_step * dice.randrange(turn)
        return angle if angle <= 180.0 else angle - 360.0
    if kind == "teeth":
        few, many = (round(abs(value) * (1 + sign * spread.teeth)) for sign in (-1, 1))
        return int(math.copysign(dice.randint(few, many), value))
    if kind == "end":
        return value + spread.angle_step * dice.randint(-3, 3)
    part = {"length": spread.lengths, "travel": spread.lengths, "place": spread.places, "rate": spread.rates,
            "moment": spread.rates}[kind]  # fmt: skip
    step = round_step(value) * (5.0 if kind == "rate" else 1.0)
    low, high = math.ceil(abs(value) * (1 - part) / step), math.floor(abs(value) * (1 + part) / step)
    steps = dice.randint(low, high) if low <= high else max(1, round(abs(value) / step))
    return math.copysign(float(f"{steps * step:.12g}"), value)


def _within(dice: random.Random, reach: tuple[float, float], spread: Spread) -> float:
    """An angle well inside the reach of a driver, since other lengths move its ends."""
    low, high = reach
    margin = SHY * (high - low)
    step = min(spread.angle_step, round_step((high - low) * 10.0))
    first, last = math.ceil((low + margin) / step), math.floor((high - margin) / step)
    return float(f"{step * dice.randint(first, max(first, last)):.12g}")
