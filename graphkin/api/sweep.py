"""``graphkin sweep``: what is asked and how far, and the motion of the whole turn, of a scene or of many designs."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from typing import TYPE_CHECKING

from graphkin.api.arguments import (
    CHART_FORMATS,
    At,
    SceneLike,
    as_scene,
    asked_symbols,
    driver_values,
    known_words,
    known_workers,
    require_callable,
    whole_number,
)
from graphkin.api.swept import Swept
from graphkin.errors import CallError, Problem, as_list, as_text
from graphkin.files import path_of
from graphkin.jobs import Progress, Workers, cluster
from graphkin.scene.drivers import moves_by_law
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import written
from graphkin.scene.symbol import KINDS, Symbol
from graphkin.table import have
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.api.answers import AnswersLike
    from graphkin.study.graphical import Way
    from graphkin.study.quantities import Quantity

__all__ = ["sweep"]

MOST_POSITIONS = 1_000_000_000
OF_TURN = tuple(f"{kind.name}_" for kind in KINDS.values() if kind.scope in ("turn", "cycle"))
MOST_MOMENTS = 100_000
ROWS = 36
IN_MEMORY = 200_000_000
"""Numbers of a table that are kept in memory where no folder is given."""


def sweep(
    scene: SceneLike,
    out: str | os.PathLike[str] | None = None,
    positions: int | None = None,
    find: Iterable[str | Symbol] | None = None,
    at: At = None,
    designs: Mapping[str, str | float | Sequence[float | str]] | None = None,
    designs_file: str | os.PathLike[str] | None = None,
    executor: Executor | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    formats: Sequence[str] = ("svg",),
    language: str | None = None,
    progress: Progress | None = None,
    text: str = "glyphs",
    measured: AnswersLike | None = None,
    differentiate: Iterable[str] = (),
    integrate: Iterable[str] = (),
) -> Swept:
    """Follow a scene over the whole turn of its driver, alone or as many designs.

    Velocities, accelerations and rates that ``find`` names come at the speed of the prepared engine (see
    `graphkin.solver.prepare`): a million positions in some milliseconds.  Everything else is made when it is asked for.

    Parameters
    ----------
    scene, at : as for `check`
    find : what the table shows, the symbols of `check` and "C" (place of a point), "theta_3" (angle of a link), "s_3/4"
        (travel of a sliding pair); the scene's own if None, or else everything that moves
    out : folder for table.csv (and table.parquet where pyarrow is installed), designs.csv and the figures; an
        interrupted sweep into the same folder goes on where it stopped
    positions : rows of the table, over a turn from the scene's own value on, or over the range of a driven slide; of a
        scene with named positions from position 1 on, and as many as it counts; else 36
    designs : numbers to replace, by keys of the scene file with dots: {"links.1.length": "40:60:21"} is a grid of 21,
        "40,50,60" or a sequence a list; several keys give every combination
    designs_file : a CSV file whose head names such keys
    executor : any ``concurrent.futures.Executor``; the result is the same, byte for byte
    workers : number of processes instead, for a sweep that takes some seconds; scheduler: address of a Dask cluster
        instead
    progress : called with the rows done and all rows
    text : letters of an SVG as text with its "glyphs", or as "outlines"
    measured : a CSV file with a row for each position (a column ``at``: driver value or name of a position) and symbols
        as heads: values measured elsewhere, laid over the diagrams of these quantities

    differentiate, integrate : angles, travels, coordinates or rates of them ("s_6/1", "theta_4", "omega_4", "x_C",
        "v_C.x") whose diagrams are differentiated or integrated on paper, with chords and a pole, measured and held
        against the solver

    Raises
    ------
    SceneError, CallError : the scene or the call is wrong
    Unsolvable : wrong mobility; without designs also where the scene's own position cannot be assembled

    Examples
    --------
    >>> swept = sweep("slider-crank-s50-e16-K1.2", positions=12)
    >>> slider = swept.data["outputs"][0]
    >>> f"stroke {slider['stroke']:.10f}, K {slider['K']:.10f}"
    'stroke 50.0000000000, K 1.2000000000'
    >>> swept = sweep("shaper-scheme-2", positions=100_000, find=["v_C"])
    >>> f"{abs(swept['v_C']).max():.0f} mm/s at most"
    '1346 mm/s at most'
    """
    from graphkin.solver import structure_of
    from graphkin.study.designs import designs_of
    from graphkin.study.sweeps import Found, Sweep, collect, write_tables

    known_words(formats, language, text=text, known_formats=CHART_FORMATS)
    require_callable("progress", progress)
    positions = None if positions is None else whole_number("positions", positions, 1, MOST_POSITIONS)
    if executor is not None and scheduler is not None:
        raise CallError(Problem("executor", Phrase("is given beside a scheduler"), Phrase("give one of them")))
    workers = known_workers(executor, workers)
    wishes = {
        name: [as_text(name, one) for one in as_list(name, names, Phrase("give names s_6 1"))]
        for name, names in (("differentiate", differentiate), ("integrate", integrate))
    }
    made = designs_of(designs, designs_file)
    source, name = written(scene) if made.keys else (as_scene(scene), "")
    given = as_scene(source)
    if isinstance(source, Mapping) and len(made):
        from graphkin.study.designs import applied

        applied(source, made.keys, made[0])  # keys that the scene does not have
    if not given.drivers:
        structure_of(given)  # a sentence: what drives is missing
    if moves_by_law(given):
        positions = positions if positions is None else whole_number("positions", positions, 1, MOST_MOMENTS)
        _over_time_alone(at=at, measured=measured, **{name: tuple(names) for name, names in wishes.items()})
    start = driver_values(given, at) or {}
    if positions is None:
        positions = (given.positions.count if given.positions is not None else 0) or ROWS
    ways: dict[Way, list[str]] = {"derivative": wishes["differentiate"], "integral": wishes["integrate"]}
    on_paper = tuple((way, name) for way, names in ways.items() for name in names)
    if on_paper:
        from graphkin.study.graphical import known_ordinate  # it loads the drawing board

        for way, name in on_paper:
            known_ordinate(given, name, way)
        if made.keys:
            raise CallError(
                Problem("differentiate, integrate", Phrase("do not go with designs"), Phrase("give one design"))
            )
    elsewhere = () if measured is None else _elsewhere(given, measured)
    if find is None and elsewhere:
        find = list(dict.fromkeys(symbol for symbol, *_ in elsewhere))
    over = Sweep(source, name or given.name, made, positions, _asked(given, find), tuple(sorted(start.items())))
    spoken = language or given.sheet.language
    if out is None:
        if over.numbers > IN_MEMORY:
            raise CallError(Problem("sweep", Phrase("rows", number=over.rows), Phrase("give a folder out or o")))
        arrays = None if made.keys else over.base.arrays(positions)
        if arrays is not None:
            return Swept(over, Found(over.rows, arrays.good, arrays=arrays), spoken, elsewhere, on_paper)
    if not made.keys and over.base.engine is None and not moves_by_law(given):
        _ = over.base.reach  # a start that cannot be assembled
    through = cluster(as_text("scheduler", scheduler)) if scheduler is not None else executor
    try:
        with Workers(through, workers if over.long else None) as working:
            if out is None:
                return Swept(over, collect(over, working, progress), spoken, elsewhere, on_paper)
            found = write_tables(over, path_of(out), working, have("pyarrow"), progress)
    finally:
        if scheduler is not None and through is not None:
            through.shutdown()
    swept = Swept(over, found, spoken, elsewhere, on_paper)
    if not made.keys:
        swept.write_figures(out, formats, text)
    return swept


def _over_time_alone(**wishes: object) -> None:
    """Refuse what counts along the driver, where drivers move by laws over the time."""
    given = [name for name, wish in wishes.items() if wish not in (None, ())]
    if given:
        found = Phrase("does not go with a driver that moves")
        raise CallError(*(Problem(name, found, Phrase("leave it out or give omega instead of")) for name in given))


def _elsewhere(scene: Mechanism, measured: AnswersLike) -> tuple[tuple[Symbol, float, float, bool], ...]:
    """Values measured elsewhere: symbol, value of the first driver (rad, m), value (SI; of a vector its size, or its
    place along the guide on which it lies, where a sign stands in the column), and whether it is along that."""
    from graphkin.api.answers import as_answers
    from graphkin.solver import senses_along, solve

    rows, _ = as_answers(scene, measured)
    if any(row.at is None for row in rows):
        raise CallError(
            Problem("measured", Phrase("has no column at"), Phrase("write the driver's value of each row under"))
        )
    places = [(driver_values(scene, row.at) or {})[scene.drivers[0].key] for row in rows]
    signed = {one.symbol for row in rows for one in row.values if one.shows_sign}
    signed -= {one.symbol for row in rows for one in row.values if isinstance(one.value, complex)}
    along = {s for s in signed if s.is_vector and senses_along(solve(scene), s) is not None}
    sizes = {one.symbol for row in rows for one in row.values if one.symbol.is_vector} - along
    return tuple(
        (one.symbol, place, abs(one.value) if one.symbol in sizes else float(one.value.real), one.symbol in along)
        for row, place in zip(rows, places, strict=True)
        for one in row.values
        if one.symbol.scope != "turn" and not one.symbol.at
    )


def _asked(scene: Mechanism, find: Iterable[str | Symbol] | None) -> tuple[Quantity, ...]:
    """What is asked, in its order.  Raises CallError, naming everything that names nothing."""
    from graphkin.study.quantities import named_quantity, symbol_quantity

    if find is None:
        shown = (s for s in scene.find if s.scope not in ("turn", "cycle") and s.kind not in ("h", "arm") and not s.at)
        forces = {s: named_quantity(scene, str(s)) for s in scene.find if s.scope == "force"}
        return tuple(forces.get(s) or symbol_quantity(s) for s in shown)
    found: list[Quantity] = []
    problems: list[Problem] = []
    for name in [find] if isinstance(find, Symbol) else as_list("find", find, Phrase("give symbols v_b omega_3")):
        named = named_quantity(scene, name) if isinstance(name, str) else None
        if isinstance(name, str) and name.startswith(OF_TURN):
            problems.append(
                Problem(f"find {name}", Phrase("is of the whole turn no column"), Phrase("it stands in the summary"))
            )
            continue
        try:
            found += [named] if named is not None else map(symbol_quantity, asked_symbols(scene, [name]))
        except CallError as error:
            problems += error.problems
    if problems:
        raise CallError(*problems)
    return tuple(found)
