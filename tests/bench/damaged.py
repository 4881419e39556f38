"""Damaged scene files, as people and programs make them: every command gives a status from 0 to 3 and never a
traceback, and takes less than ten seconds.

    python -m tests.bench.damaged 10000 [SEED]

The scenes that come along are changed as text (characters, lines, numbers, ends) and as data (types, nesting, names,
numbers beyond all measure, tables left out or in one another's place).  What gave way becomes a scene of
tests/scene/test_damaged.py by its name.
"""

from __future__ import annotations

import copy
import random
import sys
import time
import tomllib
import warnings
from collections.abc import Callable, Iterator
from typing import Any

import graphkin
from graphkin.scene import library, library_text, mechanism_of_text

__all__ = ["SLOWEST", "commands", "damaged", "what_gives_way"]

SLOWEST = 10.0  # of the processor: others may be at work on the machine
TEXTS = [library_text(name) for name in library()]
SCENES = [tomllib.loads(text) for text in TEXTS]
NUMBERS = [0, -0.0, 1, -1, 1e-300, 1e300, -1e300, 1e15, 1e-15, 10**30, 10**400, 5e-324, 1e9, 1e-9, 89.999999999, 90,
           180, 360, 1e6, float("inf"), float("nan"), 2**63, 0.1 + 0.2]
WORDS = ["A", "B", "C", "D", "O", "1", "2", "3", "4", "6", "6.h", "3.s", "2/3", "", "drawn", "dead point", "v_B",
         "a_B@3", "omega_3", "\u0000", "\x1b[31m", "\u202e", "\ud7ff", "é", "点", "💥", "A" * 300, "1e5"]
PIECES = ["[", "]", "{", "}", "=", '"', "'", '"""', "#", ",", ".", "\n", "\t", "\x00", "\x1b[2J", "\u202e", "\ufeff",
          "💥", "１", "“", "\r", "1e999", "-", "_", "0x1F", "nan", "1979-05-27", "[[driver]]", "[links.1]"]


def damaged(seed: int) -> str | dict[str, Any]:
    """The scene of a number: the text of a file, or a mapping."""
    chance = random.Random(seed)
    if chance.random() < 0.35:
        return _text(chance, chance.choice(TEXTS))
    scene = copy.deepcopy(chance.choice(SCENES))
    for _ in range(chance.choice((1, 1, 1, 2, 3, 6))):
        _change(chance, scene)
    return scene


def _text(chance: random.Random, text: str) -> str:
    for _ in range(chance.choice((1, 1, 2, 4))):
        lines, at = text.split("\n"), chance.randrange(len(text) + 1)
        one, two = (chance.randrange(len(lines)) for _ in range(2))
        kind = chance.randrange(7)
        if kind == 0:
            text = text[:at] + chance.choice(PIECES) + text[at:]
        elif kind == 1:
            text = text[:at] + text[at + chance.choice((1, 1, 3, 20)) :]
        elif kind == 2:
            text = text[:at]
        elif kind == 3:
            del lines[one]
            text = "\n".join(lines)
        elif kind == 4:
            lines[one], lines[two] = lines[two], lines[one]
            text = "\n".join(lines)
        elif kind == 5:
            text = "\n".join([*lines[:one], lines[two], *lines[one:]])
        else:
            digits = [k for k, sign in enumerate(text) if sign.isdigit()] or [0]
            at = chance.choice(digits)
            text = text[:at] + chance.choice(["9" * 40, "-", "1e300", "0", "1e-300", "x", "..", "7"]) + text[at + 1 :]
    return text


def _places(node: Any, here: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    inside = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, child in inside:
        yield (*here, key)
        yield from _places(child, (*here, key))


def _value(chance: random.Random, depth: int = 0) -> Any:
    kind = chance.randrange(9 if depth < 3 else 5)
    if kind < 2:
        return chance.choice(NUMBERS)
    if kind == 2:
        return chance.choice(WORDS)
    if kind == 3:
        return chance.choice([True, False, chance.uniform(-500, 500)])
    if kind == 4:
        return chance.randrange(-400, 400)
    if kind < 7:
        return [_value(chance, depth + 1) for _ in range(chance.randrange(4))]
    return {chance.choice([*WORDS, "points", "length", "angle"]): _value(chance, depth + 1) for _ in range(2)}


def _change(chance: random.Random, scene: dict[str, Any]) -> None:
    """Change one entry of a scene: its value, its size, its name or its place."""
    places = list(_places(scene))
    if not places:
        return
    path = chance.choice(places)
    table: Any = scene
    for part in path[:-1]:
        table = table[part]
    old, kind = table[path[-1]], chance.randrange(8)
    if kind == 0:
        del table[path[-1]]
    elif kind == 1 and isinstance(table, dict):
        table[chance.choice(WORDS)] = table.pop(path[-1])
    elif kind == 2:
        other: Any = scene
        for part in chance.choice(places):
            other = other[part]
        table[path[-1]] = copy.deepcopy(other)
    elif isinstance(old, int | float) and not isinstance(old, bool) and kind < 6:
        factor, more = chance.choice([0, -1, 1e-12, 1e-6, 0.5, 0.99, 1.01, 2, 10, 1e6, 1e12]), [0, 0, 0, 90, 180, 1e-9]
        old = old if abs(old) < 1e300 else 1e300  # an integer may be too large for a product
        table[path[-1]] = old * factor + chance.choice(more)
    elif isinstance(old, str) and kind < 6:
        table[path[-1]] = chance.choice(WORDS)
    else:
        table[path[-1]] = _value(chance)


def commands(drawn: bool) -> list[Callable[[Any], object]]:
    """What is done with a scene."""
    found: list[Callable[[Any], object]] = [graphkin.solve, graphkin.check]
    return [*found, lambda scene: graphkin.draw(scene).figures["sheet"].content("svg")] if drawn else found


def what_gives_way(seed: int, drawn: bool) -> list[str]:
    """What a damaged scene shows that may not be: errors that are no sentences, and what takes too long."""
    source = damaged(seed)
    found: list[str] = []
    begin = time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            scene = mechanism_of_text(source, "damaged") if isinstance(source, str) else source
            for command in commands(drawn):
                try:
                    command(scene)
                except graphkin.Unsolvable:
                    continue
    except graphkin.GraphkinError as error:
        # what would be right may be lines to be pasted
        if not error.problems or "\n" in "".join(f"{p.where}{p.found}" for p in error.problems):
            found.append(f"seed {seed}: no sentence: {error!r:.200}")
    except Exception as error:
        at = error.__traceback__
        while at is not None and at.tb_next is not None:
            at = at.tb_next
        where = f"{at.tb_frame.f_code.co_filename.rpartition('graphkin/')[2]}:{at.tb_lineno}" if at else ""
        found.append(f"seed {seed}: {type(error).__name__} {error!s:.150} at {where}")
    taken = time.process_time() - begin
    return [*found, f"seed {seed}: {taken:.1f} s"] if taken > SLOWEST else found


def main() -> None:
    count, first = (int(sys.argv[1]) if len(sys.argv) > 1 else 10_000), int(sys.argv[2]) if len(sys.argv) > 2 else 0
    bad = 0
    for seed in range(first, first + count):
        for line in what_gives_way(seed, drawn=seed % 4 == 0):
            bad += 1
            print(line, flush=True)
    print(f"{count} damaged scenes, {bad} gave way")


if __name__ == "__main__":
    main()
