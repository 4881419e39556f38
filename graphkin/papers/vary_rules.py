"""What ``[vary]`` of a scene says about its variants: ranges, ties, what stays, what is asked, how hard it may be."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from graphkin.errors import CallError, Problem
from graphkin.files import OwnTables, Tables
from graphkin.scene.tables import KeyPath, path_of_key, put_at, value_at
from graphkin.words import Phrase

__all__ = [
    "LEVELS", "Bounds", "asked_now", "free_of_rules", "level_of", "round_step", "ruled", "ruled_keys", "rules_checked",
]  # fmt: skip


STEPS = (1.0, 2.0, 5.0)


@dataclass(frozen=True)
class Bounds:
    """How badly lines may cross (rad), how far an answer may be missed with a pencil (part of it), the least
    transmission and the greatest pressure angle (rad)."""

    crossing: float
    tolerance: float = 0.05
    transmission: float = 0.0
    pressure: float = math.pi / 2


LEVELS = {
    "easy": Bounds(math.radians(35.0)),
    "usual": Bounds(math.radians(20.0)),
    "hard": Bounds(math.radians(12.0)),
}
"""At which angle lines must cross is the transmission angle of a group of bars, and the rest to 90 degrees of the
pressure angle of a slider."""


def level_of(source: Tables) -> Bounds:
    """The bounds that a scene asks for: those of its level, and what it says itself."""
    table = _table(source)
    keys = ("crossing", "transmission", "pressure", "tolerance")
    own = {key: table[key] for key in keys if table.get(key) is not None}
    bounds = {key: value if key == "tolerance" else math.radians(value) for key, value in own.items()}
    return replace(LEVELS[table.get("level", "usual")], **bounds)


def _table(source: Tables) -> Tables:
    table = source.get("vary") or {}
    return table if isinstance(table, Mapping) else {}


def _path_of_number(source: Tables, key: str) -> KeyPath:
    """The place of a number by its key with dots: ``links.2.length``, ``frame.points.D.x``, ``driver.2.angle``.

    Raises ValueError where there is no number.
    """
    path = path_of_key(source, key)
    value = None if path is None else value_at(source, path)
    if path is None or isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(Phrase("is no number of the scene"))
    return path


def rules_checked(source: Tables) -> None:
    """Raise CallError naming every key of ``[vary]`` that is no number of the scene, and every range that is none."""
    table = _table(source)
    problems = []
    keys = [(f"vary.ranges.{k}", k) for k in table.get("ranges", {})]
    keys += [("vary.keep", k) for k in table.get("keep", ())]
    keys += [("vary.ratios", k) for keys in table.get("ratios", ()) for k in keys]
    for where, key in keys:
        try:
            _path_of_number(source, key)
        except ValueError as error:
            problems.append(
                Problem(where, f'"{key}" {error}', Phrase("write a key such as links.2.length or driver.angle"))
            )
    problems += [
        Problem(
            f"vary.ranges.{k}",
            Phrase("from to", least=f"{low:g}", greatest=f"{high:g}"),
            Phrase("give the smaller value first"),
        )
        for k, (low, high) in table.get("ranges", {}).items()
        if low > high
    ]
    asked, most = table.get("ask"), len(table.get("find", ()))
    if asked is not None and asked > most:
        problems.append(
            Problem(
                "vary.ask", Phrase("of quantities", asked=asked, most=most), Phrase("list more of them in vary.find")
            )
        )
    if problems:
        raise CallError(*problems)


def free_of_rules(source: Tables, paths: Sequence[tuple[KeyPath, str]]) -> list[tuple[KeyPath, str]]:
    """The numbers that vary by themselves: without a range, not tied to another, not kept."""
    table = _table(source)
    if table.get("only"):
        return []
    fixed = ruled_keys(source)
    return [(path, kind) for path, kind in paths if path not in fixed]


def ruled_keys(source: Tables) -> set[KeyPath]:
    """The numbers that have a range, are tied to another, or are kept."""
    table = _table(source)
    tied = [key for keys in table.get("ratios", ()) for key in keys[1:]]
    return {_path_of_number(source, key) for key in (*table.get("ranges", {}), *tied, *table.get("keep", ()))}


def ruled(source: Tables, made: OwnTables, dice: random.Random, step_of: Mapping[str, float]) -> None:
    """Draw what has a range, and let what is tied follow; ``step_of`` gives the steps of angles by the last key."""
    table = _table(source)
    for key, (low, high) in table.get("ranges", {}).items():
        path = _path_of_number(source, key)
        size = max(abs(low), abs(high), 1e-9)
        whole = "teeth" in path
        step = 1.0 if whole else step_of.get(str(path[-1]), round_step(size))
        if high - low < 2 * step and not whole:
            step = round_step(max(high - low, 1e-9)) * 10
        first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
        value = dice.randint(first, last) * step if first <= last else low
        value = min(max(value, low), high)
        put_at(made, path, round(value) if whole else float(f"{value:.12g}"))
    for keys in table.get("ratios", ()):
        lead, *others = [_path_of_number(source, key) for key in keys]
        factor = value_at(made, lead) / value_at(source, lead) if value_at(source, lead) else 1.0
        for other in others:
            put_at(made, other, float(f"{value_at(source, other) * factor:.9g}"))


def asked_now(source: Tables, dice: random.Random) -> list[str]:
    """Which quantities a variant asks for; none where the scene leaves it."""
    table = _table(source)
    pool = list(table.get("find", ()))
    count = table.get("ask") or len(pool)
    taken = set(dice.sample(range(len(pool)), min(count, len(pool))))
    return [symbol for i, symbol in enumerate(pool) if i in taken]


def round_step(value: float) -> float:
    """The step of the 1-2-5 series that is about a sixtieth of a value, so that its multiples look round beside it.

    >>> round_step(580), round_step(90), round_step(0.34)
    (5.0, 1.0, 0.005)
    """
    least = abs(value) / 60.0
    decade = 10.0 ** math.floor(math.log10(least))
    return max(s * decade for s in STEPS if s * decade <= least * (1 + 1e-9))
