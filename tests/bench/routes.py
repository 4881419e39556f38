"""Every number of every scene, changed by each route: run by hand, ``python -m tests.bench.routes [SCENE ...]``.

The edited scene in a process of its own is what is true.  The same in a process that has solved others before,
``sweep`` over designs and ``prepare().over`` give the same values, or refuse the key by name.
"""

from __future__ import annotations

import multiprocessing
import sys
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from typing import Any

import numpy as np

import graphkin
from graphkin.errors import CallError, GraphkinError, SceneError, Unsolvable
from graphkin.scene import mechanism_of
from graphkin.scene.scene import library, written
from graphkin.study.designs import applied

POSITIONS = 3
SAME = 1e-7
"""Of the largest value of a column: near a dead point the routes round in different ways."""
OF_NO_MOTION = ("printed", "printed_at", "sheet", "grading", "vary", "scans", "loops", "positions", "sketch")
"""Tables that give no number of the mechanism; a sketched place may name the other assembly."""

Values = tuple[str, dict[str, list[float]]]
"""How it came out, and a list of values for each column."""


def keys_of(tables: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    """The keys (with dots) of all numbers of a scene that its motion may depend on, and the numbers."""

    def inside(key: str, place: object) -> Iterator[tuple[str, float]]:
        if isinstance(place, int | float) and not isinstance(place, bool):
            yield key, float(place)
        elif isinstance(place, Mapping):
            for part, own in place.items():
                yield from inside(f"{key}.{part}", own)
        elif isinstance(place, list):
            for k, own in enumerate(place, 1):
                yield from inside(f"{key}.{k}", own)

    for name, table in tables.items():
        if name not in OF_NO_MOTION:
            yield from inside(name, table)


def other(key: str, number: float) -> float:
    """Another value of a key, so near that the mechanism keeps its form."""
    if ".teeth." in key or key.endswith((".teeth", ".count", ".to")):
        return number + 1
    return number * 1.01 if number else 0.5


def asked(tables: Mapping[str, Any]) -> list[str]:
    """What is asked of a scene: all angles with their rates, and velocity and acceleration of some points."""
    mechanism = mechanism_of(tables)
    links = [link for link in mechanism.links if not link.redundant]
    points = dict.fromkeys(p for link in links for p in link.points if p not in mechanism.frame.points)
    turning = [f"{kind}_{link.name}" for link in links for kind in ("theta", "omega", "alpha")]
    return turning + [f"{kind}_{point}" for point in list(points)[-2:] for kind in "va"]


def _said(make: Callable[[], tuple[list[bool], dict[str, list[float]]]]) -> Values:
    try:
        ok, columns = make()
    except Unsolvable as error:
        return error.status, {}
    except SceneError:
        return "wrong scene", {}
    return ",".join("ok" if good else "-" for good in ok), columns


def _of_table(table: Any, names: list[str], rows: slice) -> tuple[list[bool], dict[str, list[float]]]:
    heads = [c.name for c in table.columns]
    wanted = [h for h in heads if any(h == n or h.startswith((f"{n}.", "driver_")) for n in names)]
    return [s == "ok" for s in table["status"][rows]], {h: np.asarray(table[h], float)[rows].tolist() for h in wanted}


def solved(tables: Mapping[str, Any], names: list[str]) -> Values:
    """By ``sweep`` of the edited scene itself."""
    return _said(lambda: _of_table(graphkin.sweep(tables, positions=POSITIONS, find=names).table, names, slice(None)))


def designed(tables: Mapping[str, Any], key: str, value: float, names: list[str]) -> Values:
    """By ``sweep`` over designs, the scene's own first."""
    own = dict(keys_of(tables))[key]
    table = graphkin.sweep(tables, designs={key: [own, value]}, positions=POSITIONS, find=names).table
    rows = slice(POSITIONS, 2 * POSITIONS)
    if all(s != "ok" for s in table["status"][rows]):
        status = str(table["status"][rows][0])
        return ",".join("-" * POSITIONS) if status == "not assembled" and POSITIONS == 0 else status, {}
    return _said(lambda: _of_table(table, names, rows))


def prepared(tables: Mapping[str, Any], names: list[str], key: str = "", value: float = 0.0) -> Values:
    """By ``prepare`` of the edited scene, or ``over`` the key."""

    def make() -> tuple[list[bool], dict[str, list[float]]]:
        ready = graphkin.prepare(tables, find=names)
        samples = ready.over({key: value}).sweep(POSITIONS) if key else ready.sweep(POSITIONS)
        columns = {n: np.asarray(samples[n], float).tolist() for n in ready.names}
        driver = f"driver_{ready.mechanism.drivers[0].key}"
        return samples.ok.tolist(), {**columns, driver: samples.driver.tolist()}

    return _said(make)


def apart(one: Values, another: Values) -> str:
    """In what two routes differ; "" where they give the same."""
    if not any("ok" in status.split(",") for status, _ in (one, another)):
        return ""
    if one[0] != another[0]:
        return f"{one[0]} or {another[0]}"
    for name, values in one[1].items():
        mine, theirs = np.array(values), np.array(another[1].get(name, values))
        miss = mine - theirs
        if name.startswith(("theta", "driver")):
            miss = (miss + 180.0) % 360.0 - 180.0
        size = max(1e-3, float(np.nanmax(np.abs(mine), initial=0.0)))
        if bool(np.nanmax(np.abs(miss), initial=0.0) > SAME * size) or (np.isnan(mine) != np.isnan(theirs)).any():
            return f"{name} = {mine.tolist()} or {theirs.tolist()}"
    return ""


def clean_processes() -> ProcessPoolExecutor:
    """Processes that have solved nothing before, one for each piece of work."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["graphkin.api.sweep", "graphkin.api.prepared", "graphkin.solver", __name__])
    return ProcessPoolExecutor(1, context, max_tasks_per_child=1)


def differences(
    name: str, alone: ProcessPoolExecutor, some: Callable[[list[str]], list[str]] = lambda keys: keys
) -> Iterator[str]:
    """What is wrong with a scene: a sentence for each key and route that does not give what is true."""
    # named positions say where a sweep begins, and where a prepared mechanism's does not
    tables = {key: table for key, table in written(name)[0].items() if key != "positions"}
    numbers, names = dict(keys_of(tables)), asked(tables)
    for key in some(list(numbers)):
        value = other(key, numbers[key])
        edited = applied(tables, [key], [value])
        try:
            true = alone.submit(solved, edited, names).result()
        except GraphkinError as error:
            true = f"{error}", {}
        routes: dict[str, Callable[[], Values]] = {
            "sweep in one process": lambda edited=edited: solved(edited, names),
            "sweep over designs": lambda key=key, value=value: designed(tables, key, value, names),
            "prepare": lambda edited=edited: prepared(edited, names),
            "over": lambda key=key, value=value: prepared(tables, names, key, value),
        }
        for route, make in routes.items():
            try:
                given = make()
            except CallError as refusal:
                if key not in str(refusal) and "driver" not in str(refusal) and true[1]:
                    yield f"{name} {key}={value:g} by {route}: refused without its name: {refusal}"
                continue
            if said := apart(true, given):
                yield f"{name} {key}={value:g} by {route}: {said}"


def main(names: list[str]) -> None:
    with clean_processes() as alone:
        for name in names or library():
            for said in differences(name, alone):
                print(said, flush=True)
            print("done", name, file=sys.stderr, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
