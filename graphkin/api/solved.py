"""``graphkin solve``: the analytic solution alone, also in tables for people: the units of the file, degrees, 0 for a
value that is rounding alone."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from graphkin import solver
from graphkin.api.arguments import (
    At,
    as_scene,
    asked_symbols,
    columns_shown,
    known_words,
    placed,
    value_at,
    whole_number,
)
from graphkin.api.results import OfScene, Result
from graphkin.errors import CallError, Problem, Unsolvable, as_list, as_text
from graphkin.files import Json
from graphkin.scene.drivers import moment_of, moments, moves_by_law
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import MEASURES
from graphkin.solver import Motion, listed_points, own_slides
from graphkin.solver.forces import Forces, forces_of
from graphkin.solver.path.named_positions import name_at, named_positions
from graphkin.solver.values import entries, head, json_text
from graphkin.structure import Structure, mobility_of
from graphkin.study.quantities import (
    all_that_moves,
    columns_of,
    link_quantities,
    motion_table,
    parts_of,
    rates_of,
    slide_quantities,
)
from graphkin.table import Array, Column, Table, Values
from graphkin.words import Phrase, Wording, listed, say, word

if TYPE_CHECKING:
    from graphkin.account.loops import LoopText

@dataclass(frozen=True, repr=False, eq=False)
class Solved(OfScene, Result):
    """The motion of every link, point and sliding pair at one position or over a turn.

    ``solved["v_C"]`` is a quantity by its name as an array with its unit, shape (positions,): complex for vectors, in
    the file's units and degrees, NaN where it is missing, 0 where it is rounding alone.  ``table`` has all of them,
    ``motion`` and ``forces`` more, in SI.  ``times`` are the moments (s), if drivers move by laws that
    stand at one moment.

    A long sweep is computed when it is read; ``blocks`` yields it with only some positions in memory.

    values : of drivers (rad, m) by their keys, where they differ from the scene's own
    count : positions of a sweep; None for one position
    part : the positions of a sweep to which it is limited
    """

    table_file = "solution.csv"

    structure: Structure
    values: Mapping[str, float] | None
    count: int | None
    find: tuple[str, ...] = ()
    part: Motion | None = None

    def __repr__(self) -> str:
        return f"<Solved {self.mechanism.name}: {int(self.motion.ok.sum())} of {len(self.motion)} positions>"

    @property
    def mechanism(self) -> Mechanism:
        return self.structure.scene

    @cached_property
    def times(self) -> tuple[float, ...]:
        scene = self.mechanism
        if self.count is not None and moves_by_law(scene):
            return tuple(moments(scene, self.count))
        moment = moment_of(scene)
        return () if moment is None else (moment,)

    def blocks(self) -> Iterator[Solved]:
        """The solution in blocks: itself, or the parts of a long sweep in turn."""
        if self.part is not None or "_moved" in self.__dict__:
            yield self
            return
        yield self.first
        if len(self.first._moved) < (self.count or 1):
            yield from (replace(self, part=motion) for motion in islice(self._motions(), 1, None))

    @cached_property
    def first(self) -> Solved:
        """The first of its ``blocks``."""
        return self if self.part is not None else replace(self, part=next(self._motions()))

    def _motions(self) -> Iterator[Motion]:
        """The motion without regard to forces, of a long sweep part by part."""
        if self.count is None:
            yield solver.solve(self.structure, at=self.values)
        elif self.times:
            yield solver.over_time(self.structure, np.array(self.times))
        else:
            yield from solver.sweep_in_blocks(self.structure, self.values, self.count)

    @cached_property
    def _moved(self) -> Motion:
        """The motion of all positions, without regard to forces."""
        if self.part is not None:
            return self.part
        whole = len(self.first._moved) == (self.count or 1)
        return self.first._moved if whole else solver.solve(self.structure, at=self.values, sweep=self.count)

    @property
    def motion(self) -> Motion:
        """The motion; a position is not solved where asked forces are unknown, as where the balance does no work."""
        if self.find and not any(symbol.is_load for symbol in asked_symbols(self.mechanism, self.find, drawn=False)):
            return self._moved
        return self._moved if self.forces is None else self.forces.known_motion

    @property
    def forces(self) -> Forces | None:
        """All forces; None for a scene without masses and loads, and where a load acts on a part of a stroke without
        a whole turn."""
        return None if isinstance(self._forces, Unsolvable) else self._forces

    @property
    def without_forces(self) -> Phrase | None:
        """The sentence on forces that are not known at any position."""
        stop = self._forces
        return Phrase("forces not known", why=stop.reason) if isinstance(stop, Unsolvable) else None

    @cached_property
    def _forces(self) -> Forces | Unsolvable | None:
        try:
            return forces_of(self._moved) if self._moved.scene.loading else None
        except Unsolvable as stop:
            return stop

    @property
    def said(self) -> Phrase:
        """The status of its first position, and the reason for it."""
        return self.first.motion.said(0)

    def __getitem__(self, name: str) -> Array:
        """A quantity by its name (a symbol, "C", "theta_3", "s_2/3", a column of the table).  Raises CallError."""
        name = as_text("name", name)
        if name.startswith(("driver_", "time", "position", "status", "why")):
            return self.table[name]
        (shown,) = asked_symbols(self.mechanism, [name], drawn=False)
        parts = parts_of(shown, None, self._motion_of(shown))
        values = parts[0] if len(parts) == 1 else parts[0] + 1j * parts[1]
        return Values.of(values, shown.unit(self.mechanism.units).text)

    @cached_property
    def table(self) -> Table:
        """A row for each position: the drivers' values, all motions, the status and its reason."""
        motion, scene = self.motion, self.mechanism
        all_known = all_that_moves(motion.structure)
        if self.without_forces:
            all_known = tuple(quantity for quantity in all_known if not quantity.is_load)
        shown = asked_symbols(scene, self.find, drawn=False) or all_known
        parts = tuple(parts_of(quantity, None, self._motion_of(quantity)) for quantity in shown)
        times = np.array(self.times) if self.times else None
        return motion_table(scene, shown, bool(self.find), 0, motion.values, parts, motion.status, motion.why, times)

    def columns(self, name: str) -> list[Column]:
        """A quantity by its name, as columns of the table: a vector's size and components.  Raises CallError."""
        (shown,) = asked_symbols(self.mechanism, [name], drawn=False)
        return columns_of(shown, self.mechanism, parts_of(shown, None, self._motion_of(shown)))

    def _motion_of(self, quantity: Symbol) -> Motion:
        """The motion of a quantity: its own, or that of its named position ("v_C at 10").

        Raises
        ------
        CallError : a quantity of a named position, of a sweep
        Unsolvable : a position that cannot be assembled or reached, a dead point
        """
        name, driver = quantity.at, self.mechanism.drivers[0].key
        if not name:
            return self._moved
        if self.count is not None:
            columns_shown(self.mechanism, [quantity])
        values = {**(self.values or {}), driver: value_at(self.mechanism, name)}
        there = replace(self, values=values, find=(str(quantity.here),), part=None)
        if not there.motion.ok[0]:
            raise Unsolvable(str(there.motion.status[0]), Problem(Phrase("position", name=name), there.said))
        return there._moved

    @cached_property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin solve --json`` prints."""
        return {**self.head, "positions": list(self.entries())}

    @cached_property
    def head(self) -> dict[str, Json]:
        """The entries of ``data`` before its positions."""
        return head(self.first.motion)

    def entries(self) -> Iterator[dict[str, Json]]:
        """The entry of ``data`` for each position in turn: of a long sweep only some are in memory."""
        for block in self.blocks():
            yield from block._entries()

    def _entries(self) -> Iterator[dict[str, Json]]:
        places = named_positions(self.mechanism) if self.motion.ok.any() else {}
        asked = {name: self._plain(name) for name in self.find}
        for k, entry in enumerate(entries(self.motion, self.forces)):
            if places and (name := name_at(self.mechanism, places, float(self.motion.values[k, 0]))):
                entry["name"] = name
            if self.times:
                entry["time"] = self.times[k]
            if self.without_forces and entry["status"] == "ok":
                entry |= {"forces": None, "moments": None, "why": say(self.without_forces)}
            if self.find:
                kept = ("driver", "time", "name", "status", "why", "error_bound")
                entry = {key: entry[key] for key in kept if key in entry}
                if entry["status"] == "ok":
                    entry["values"] = {name: _finite(values[k]) for name, values in asked.items()}
            yield entry

    def _plain(self, name: str) -> NDArray[np.float64]:
        """A quantity by its name, shape (positions,) or (positions, 2) for vectors; angles in radians."""
        values = self[name]
        values = np.radians(values) if self.columns(name)[0].unit == "deg" else values
        return np.stack([values.real, values.imag], axis=1) if np.iscomplexobj(values) else values

    def loops(self, language: str | None = None, convention: str | None = None) -> LoopText:
        """The vector loops of the first position that is solved, with their equations in numbers; in the scene's
        language and convention where none is given.

        Raises
        ------
        CallError : a chosen loop joins two points that no link and no guide joins, or no position is solved
        """
        from graphkin.account.loops import loops_text

        known_words(language=language, convention=convention)
        solved = next((block for block in self.blocks() if block.motion.ok.any()), self.first)
        sheet = self.mechanism.question.sheet
        return loops_text(solved.motion, language or sheet.language, convention or sheet.convention)  # type: ignore[arg-type]

    @cached_property
    def ok(self) -> bool:
        """Whether at least one position is solved."""
        return any(block.motion.ok.any() for block in self.blocks())

    @property
    def files(self) -> Mapping[str, Iterable[bytes]]:
        return {"solution.json": self.json()}

    def json(self) -> Iterator[bytes]:
        """``data`` as the text of JSON, piece by piece."""
        return (piece.encode() for piece in json_text(self.head, self.entries()))


def _finite(value: NDArray[np.float64] | NDArray[np.complex128]) -> float | list[float] | None:
    """A number or the components of a vector for JSON; None where it is not known."""
    return value.tolist() if np.isfinite(value).all() else None


def refused(scene: SceneLike, at: At, stop: Unsolvable) -> dict[str, Json]:
    """The object of ``solve --json`` for a mechanism that is refused as a whole: its mobility, and the reason."""
    given = as_scene(scene)
    given, values_at = placed(given, at)
    values = values_at or {}
    driver = {d.key: given.unit_of(d, radians=True).of(values.get(d.key, d.value)) for d in given.drivers}
    return {
        "title": given.question.title,
        "units": {"length": given.units.length, "time": "s", "angle": "rad"},
        "mobility": mobility_of(given).value,
        "groups": [],
        "positions": [{"driver": driver, "status": stop.status, "why": stop.why}],
    }


def solve(
    scene: SceneLike,
    *,
    at: At = None,
    find: str | Symbol | Iterable[str | Symbol] | None = None,
    sweep: int | None = None,
) -> Solved:
    """Solve a scene analytically: position, velocity, acceleration of all moving links and points.

    Parameters
    ----------
    scene : a file, the name of a bundled scene, a mapping of the same shape, or a `Scene`
    at : driver value other than the scene's own, in the driver's unit (degrees, or travel); with several drivers it
        moves the first, or a mapping names them
    sweep : number of positions over a turn of the first driver (over its range, for a driven slide); over time, if
        drivers move by laws
    find : the wanted quantities by name ("v_D", "C", "theta_3", "F_5/6"); all if None

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : wrong mobility.  Positions that cannot be assembled are no error: they have their status.

    Examples
    --------
    >>> solved = solve("sixbar-guide-40deg")
    >>> round(float(solved["omega_3"][0]), 4)
    -2.8191
    >>> solved.table["v_D.x"].round(2).tolist()
    [-482.72]
    """
    given = as_scene(scene)
    most = 100_000 if moves_by_law(given) else 10_000_000
    count, values = None if sweep is None else whole_number("sweep", sweep, 1, most, "positions of number"), None
    if count is None or not moves_by_law(given):
        given, values = placed(given, at)
    elif at is not None:
        raise CallError.of("sweep", "stands beside at", "a sweep goes over the whole time of")
    wanted = Phrase("give symbols v_b omega_3")
    names = [] if find is None else [find] if isinstance(find, Symbol) else as_list("find", find, wanted)
    solved = Solved(solver.structure_of(given), values, count, tuple(map(str, names)))
    problems: list[Problem] = []
    for name in solved.find:
        try:
            solved.first.columns(name)
        except CallError as error:
            problems += error.problems
    if problems:
        raise CallError(*problems)
    _ = solved.first.motion
    return solved


# tables for people


Row = tuple[str, Sequence[Sequence[str]]]
"""A name, and for each column its texts over the positions."""
Texts = tuple[Sequence[str], tuple[int, ...], list[Row]]
"""A table of all positions: heads, the columns of numbers, rows."""


def solution_tables(
    solved: Solved, language: str
) -> Iterator[tuple[str, Wording, list[tuple[Sequence[str], list[list[str]], tuple[int, ...]]]]]:
    """For each position the values of the drivers, the reason for a missing solution ("" where it is solved), and the
    tables of what has a value there: heads, rows, the columns of numbers."""
    motion, scene = solved.motion, solved.mechanism
    asked: list[Row] = [
        (column.name, (_texts(column.values), [column.unit] * len(column.values)))
        for name in solved.find for column in solved.columns(name)
    ]
    heads = [word("quantity", language), "", ""]
    tables: list[Texts] = [(heads, (1,), asked)] if solved.find else _whole(solved, language)
    for k, status in enumerate(motion.status):
        drivers = zip(scene.drivers, motion.values[k], strict=True)
        values = [f"{d.key} = {scene.unit_of(d).said(float(v))}" for d, v in drivers]
        values += [f"t = {solved.times[k]:.6g} s"] if solved.times else []
        here = [
            (heads, [[name, *(column[k] for column in columns)] for name, columns in rows if columns[0][k]], right)
            for heads, right, rows in tables
        ]
        yield say(listed(values), language), "" if status == "ok" else motion.said(k), here


def _texts(*parts: Array) -> list[str]:
    """Numbers, or the components of vectors, over the positions; "" for a missing one."""
    return ["" if any(map(math.isnan, row)) else ", ".join(f"{x:.6g}" for x in row) for row in zip(*parts, strict=True)]


def _whole(solved: Solved, language: str) -> list[Texts]:
    scene, motion = solved.mechanism, solved.motion if solved.forces is None else solved.forces.motion
    push = scene.units.of("acceleration")

    def table(of: str, rows: Iterable[Row], *right: int) -> Texts:
        shown = {measure: scene.units.of(measure) for measure in ("length", "velocity", "acceleration", "force")}
        units = {measure: unit.text if language == "en" else unit.written for measure, unit in shown.items()}
        return say(Phrase(f"heads of {of}", **units), language).split("|"), right, [*rows]

    def columns(*quantities: Symbol) -> list[list[str]]:
        return [_texts(*parts_of(quantity, None, motion)) for quantity in quantities]

    links = [(link.name, columns(*link_quantities(link.name))) for link in scene.links]
    pairs = own_slides(scene, motion.slides)
    points, slides = list[Row](), list[Row]()
    for ref, link in listed_points(scene, pairs):
        points.append((f"{ref.point}@{link}", columns(*rates_of(Symbol("place", ref)))))
    for pair in pairs:
        term = push.of(motion.settled(motion.slide(pair.key)[3], MEASURES["acceleration"], 2.0))
        slides.append((pair.key, [*columns(*slide_quantities(pair.key)), _texts(term.real, term.imag)]))
    tables = [table("links", links, 1, 2, 3), table("points", points), table("slides", slides, 1, 2, 3)]
    if solved.forces is not None:
        tables += [table("forces", _forces(solved.forces), 2, 3), table("moments", _moments(solved.forces), 1)]
    return tables


def _forces(forces: Forces) -> Iterator[Row]:
    """Forces by components, size and direction."""
    for quantity in _loads(forces, True):
        x, y = (_there(forces, quantity, part) for part in parts_of(quantity, None, forces.motion))
        angles = ["–" if a == b == 0.0 else f"{math.degrees(math.atan2(b, a)):.6g}" for a, b in zip(x, y, strict=True)]
        yield str(quantity), (_texts(x, y), _texts(np.hypot(x, y)), angles)


def _moments(forces: Forces) -> Iterator[Row]:
    """Moments with their unit; excess work and inertia of the flywheel, if the scene asks for one."""
    motion = forces.motion
    shown = [*_loads(forces, False)]
    if motion.scene.loading.flywheel is not None:
        shown += map(Symbol.parse, ("excess_W", "J_F"))
    for quantity in shown:
        try:
            (values,) = parts_of(quantity, None, motion)
        except Unsolvable:  # no whole turn
            continue
        texts = _texts(_there(forces, quantity, values))
        yield str(quantity), (texts, [quantity.unit(motion.scene.units).text] * len(texts))


def _loads(forces: Forces, vectors: bool) -> Iterator[Symbol]:
    """Forces, or moments, each followed by its value with the loads that begin or end exactly here, if that differs."""
    for symbol in (symbol for symbol in forces.values if symbol.is_vector is vectors):
        yield symbol
        if symbol in forces.beside:
            yield replace(symbol, plus=True)


def _there(forces: Forces, quantity: Symbol, values: Array) -> Array:
    """Values of a force; NaN where the loads that begin or end here do not change it."""
    beside = forces.beside.get(replace(quantity, plus=False)) if quantity.plus else None
    return values if beside is None else np.where(np.isnan(beside), np.nan, values)
