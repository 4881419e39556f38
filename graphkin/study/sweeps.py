"""Sweeps: a mechanism, or many designs of it, followed over the range of the driver; in memory, or into files.

The table is cut into pieces that depend on nothing but the sweep itself, so that it is the same whoever makes them, and
whenever: an interrupted sweep goes on in its folder from the pieces that are done.
"""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from graphkin.errors import GraphkinError, Unsolvable
from graphkin.files import Tables
from graphkin.jobs import key_of
from graphkin.scene import mechanism_of
from graphkin.scene.dimensions import Dimension, dimensions, same_but_for_dimensions
from graphkin.scene.model import Mechanism
from graphkin.solver.designs import PreparedMechanisms
from graphkin.study.designs import Designs, Value, applied
from graphkin.study.sweep_quantities import BLOCK, Arrays, FollowedDesign, SweepQuantity, word_column
from graphkin.table import Column, Table

__all__ = ["Found", "Outcome", "PieceResult", "Sweep", "make"]

MOST_DESIGNS = 64
"""Designs in a piece, so that all workers have some."""
LONG = 5.0
"""Seconds of work (estimated) from which processes pay."""


@dataclass(frozen=True)
class Outcome:
    """How one design came out.

    design : its number from 0
    status, why : "ok"; "partly" (some positions have no values, with the reason of the first); or why none has
    cells : range, strokes, K, least transmission angles (see `graphkin.study.turn_data.design_row`)
    good : positions that are ok
    """

    design: int
    status: str
    why: str
    cells: Mapping[str, float | str | None]
    good: int


@dataclass(frozen=True)
class Found:
    """What a sweep came to: rows in all, rows that are ok, and over designs how each came out.

    table : in memory; None where it was written into files
    damaged : pieces kept from before that were damaged, and were made again
    """

    rows: int
    good: int
    outcomes: tuple[Outcome, ...] = ()
    table: Table | None = None
    files: tuple[Path, ...] = ()
    damaged: int = 0


@dataclass(frozen=True)
class Sweep:
    """A whole sweep: positions of one mechanism, or of many designs of it.

    source : the scene, or the mapping of its file where designs replace numbers in it
    asked, at : as for a `FollowedDesign`
    """

    source: Mechanism | Tables
    name: str
    designs: Designs
    positions: int
    asked: tuple[SweepQuantity, ...] = ()
    at: tuple[tuple[str, float], ...] = ()

    def __getstate__(self) -> dict[str, object]:
        # what is pickled is what was asked: compiled functions are made anew
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def rows(self) -> int:
        """Rows of the table."""
        return len(self.designs) * self.positions

    @property
    def numbers(self) -> int:
        """Numbers in the table, about."""
        return self.rows * (2 * len(self.base.watched) + 1)

    @property
    def scene(self) -> Mechanism:
        """The scene itself, with nothing replaced."""
        return self.base.scene

    @cached_property
    def base(self) -> FollowedDesign:
        """The scene itself as a design."""
        scene = self.source if isinstance(self.source, Mechanism) else mechanism_of(self.source)
        return _same(FollowedDesign(scene, self.asked, self.at))

    @cached_property
    def head(self) -> Table:
        """The table without rows.  Raises Unsolvable for a wrong mobility."""
        values = ["" if word else 0.0 for word in self.designs.worded]
        return _with_design(self.base.blank(0, 0), self.designs.keys, 0, values)

    @cached_property
    def key(self) -> str:
        """A key that two sweeps share only if they give the same results."""
        source = repr(self.source) if isinstance(self.source, Mechanism) else dict(self.source)
        return key_of(BLOCK, source, self.name, repr(self.designs), self.positions, repr(self.asked), self.at)

    @property
    def long(self) -> bool:
        """Whether it takes so long that processes pay."""
        each = 0.05 if self.designs.keys else 0.0
        return len(self.designs) * each + self.numbers * 2e-7 > LONG

    @property
    def pieces(self) -> int:
        """How many pieces the sweep is cut into."""
        if self.positions > BLOCK:
            return len(self.designs) * -(-self.positions // BLOCK)
        return -(-len(self.designs) // self._together)

    @property
    def _together(self) -> int:
        """Designs in a piece."""
        return max(1, min(BLOCK // self.positions, MOST_DESIGNS))

    def piece(self, number: int, text: bool) -> SweepPiece:
        """One piece, with all that is needed to make it."""
        if self.positions > BLOCK:
            design, block = divmod(number, -(-self.positions // BLOCK))
            some, first = range(design, design + 1), block * BLOCK
            last = min(first + BLOCK, self.positions)
        else:
            some = range(number * self._together, min((number + 1) * self._together, len(self.designs)))
            first, last = 0, self.positions
        designs = tuple((k, self.designs[k]) for k in some)
        # the values of all other designs stay at home
        alone = replace(self, designs=Designs(self.designs.keys))
        return SweepPiece(self.key, alone, self.designs.worded, designs, first, last, text)


@dataclass(frozen=True)
class SweepPiece:
    """Some designs of a sweep, or some positions of one; its table is wanted as text or as it is."""

    key: str
    sweep: Sweep
    worded: tuple[bool, ...]
    designs: tuple[tuple[int, tuple[Value, ...]], ...]
    first: int
    last: int
    text: bool


@dataclass(frozen=True)
class PieceResult:
    """What a piece gives: its table, or the text of it, how its designs came out, and rows that are ok."""

    table: Table | None
    text: bytes
    outcomes: tuple[Outcome, ...]
    good: int


_BASE: list[FollowedDesign] = []
"""The scene that was swept last: to sweep it again, it need not be prepared again."""


def _same(design: FollowedDesign) -> FollowedDesign:
    """The design, or that which was swept last where it is the same."""
    for latest in _BASE:
        if latest == design:
            return latest
    _BASE[:] = [design]  # another thread may put its own here
    return design


_LATEST: dict[tuple[str, int], FollowedDesign | tuple[str, str]] = {}
"""The design that was followed last, or why there is none: the pieces of a long one share it."""


def make(piece: SweepPiece) -> PieceResult:
    """Make one piece.  What goes wrong with a design is said in its rows; nothing is raised for it."""
    designs = {number: _design(piece, number, values) for number, values in piece.designs}
    whole = piece.first == 0 and piece.last == piece.sweep.positions
    arrays = _together(piece.sweep, designs) if whole and piece.sweep.designs.keys else {}
    made = [_rows(piece, number, values, designs[number], arrays.get(number)) for number, values in piece.designs]
    table = Table.joined([t for t, _ in made])
    outcomes = tuple(o for _, o in made)
    text = b""
    if piece.text:
        out = io.BytesIO()
        table.write_csv(out, head=False)
        text = out.getvalue()
    good = sum(o.good for o in outcomes)
    return PieceResult(None if piece.text else table, text, outcomes if piece.sweep.designs.keys else (), good)


def _design(piece: SweepPiece, number: int, values: tuple[Value, ...]) -> FollowedDesign | tuple[str, str]:
    """A design whose way is known, or the status and the reason why it has none."""
    design = _LATEST.get((piece.key, number))
    if design is None:
        design = _followed(piece.sweep, values)
        _LATEST.clear()
        _LATEST[piece.key, number] = design
    return design


def _together(sweep: Sweep, designs: Mapping[int, FollowedDesign | tuple[str, str]]) -> dict[int, Arrays]:
    """What the prepared scene gives for those designs that are the scene itself with other dimensions, in the same
    assembly: as ``prepare(...).over(...)``, which is that of no others."""
    try:
        ready = sweep.base.engine
    except Unsolvable:
        return {}
    if ready is None or ready.signs is None:
        return {}
    form, alike = ready.range.forms(np.zeros(1)), dict[int, Mapping[Dimension, complex]]()
    for number, design in designs.items():
        if isinstance(design, FollowedDesign) and same_but_for_dimensions(sweep.scene, design.scene):
            here = design.reach.forms(np.zeros(1))
            if all(np.array_equal(here[i], form[i]) for i in form):
                alike[number] = dimensions(design.scene)
    changed = [name for name, z in ready.dimensions.items() if any(own[name] != z for own in alike.values())]
    given = {name: np.array([own[name] for own in alike.values()]) for name in changed}
    if not given:
        return {}
    together = PreparedMechanisms(ready, given).together
    numbers = np.array([*alike])[together]
    if not len(numbers):
        return {}
    columns, ok, _ = PreparedMechanisms(ready, {name: x[together] for name, x in given.items()}).sweep(sweep.positions)
    return {n: sweep.base.arrays_of(ready, columns[:, k], ok[k]) for k, n in enumerate(numbers.tolist())}


def _rows(
    piece: SweepPiece,
    number: int,
    values: tuple[Value, ...],
    design: FollowedDesign | tuple[str, str],
    arrays: Arrays | None,
) -> tuple[Table, Outcome]:
    keys = piece.sweep.designs.keys
    cells: dict[str, float | str | None] = {}
    if isinstance(design, tuple):
        status, why = design
        good, table = 0, piece.sweep.base.blank(piece.first, piece.last, status, why)
    else:
        n, first, last = piece.sweep.positions, piece.first, piece.last
        table = design.table(n, first, last) if arrays is None else design.table_of(arrays, n, first, last)
        bad = np.flatnonzero(table["status"] != "ok")
        good = len(table) - len(bad)
        status, why = (table["status"][bad[0]], table["why"][bad[0]]) if len(bad) else ("ok", "")
        if keys and piece.first == 0:
            from graphkin.study.turn import study_turn
            from graphkin.study.turn_data import design_row

            cells = design_row(study_turn(design.reach, everything=False))
    shown = [str(v) if word else v for v, word in zip(values, piece.worded, strict=True)]
    return _with_design(table, keys, number, shown), Outcome(number, status, why, cells, good)


def _followed(sweep: Sweep, values: tuple[Value, ...]) -> FollowedDesign | tuple[str, str]:
    """A design whose way is known, or the status and the reason why it has none."""
    try:
        if isinstance(sweep.source, Mechanism):
            design = sweep.base
        else:
            scene = mechanism_of(applied(sweep.source, sweep.designs.keys, values))
            design = FollowedDesign(scene, sweep.asked, sweep.at)
        _ = design.reach
        return design
    except Unsolvable as error:
        return error.status, error.why
    except GraphkinError as error:
        return "wrong scene", " ".join(str(p) for p in error.problems)


def _with_design(table: Table, keys: Sequence[str], number: int, values: Sequence[Value]) -> Table:
    """The table of a design, with its number and what is replaced in it before it."""
    if not keys:
        return table
    n = len(table)
    replaced = (
        word_column(key, [value], n) if isinstance(value, str) else Column(key, np.full(n, float(value)))
        for key, value in zip(keys, values, strict=True)
    )
    return Table((Column("design", np.full(n, number + 1)), *replaced, *table.columns), ("design", "position"))


