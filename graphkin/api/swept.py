"""What a sweep gives: the motion of the whole turn, as a study, tables and diagrams; and the same over designs."""

from __future__ import annotations

import html
import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from graphkin.api.arguments import CHART_FORMATS, write_files
from graphkin.api.results import OfScene, Result
from graphkin.errors import as_text
from graphkin.files import Json, path_of
from graphkin.scene.drivers import moves_by_law
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.table import Table, Values, have
from graphkin.table.csv_files import table_of_csv
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    import xarray

    from graphkin.drawing import Drawing
    from graphkin.drawing.chart import ChartPage
    from graphkin.study.graphical import Chords, Way
    from graphkin.study.over_time import TimeStudy
    from graphkin.study.quantities import Quantity
    from graphkin.study.sweeps import Found, Sweep
    from graphkin.study.turn import TurnStudy
    from graphkin.table import Array

__all__ = ["Swept"]


@dataclass(frozen=True, repr=False, eq=False)
class Swept(OfScene, Result):
    """The motion over a turn of one scene, or of many designs of it.

    ``swept["v_C"]`` is what is asked by its name, as an array: complex for vectors, in the scene's length unit, degrees
    for angles; over designs of shape (designs, positions).  ``table`` has the drivers' values and the status of each
    position besides.  Table, study and figures are made when they are first asked for.
    """

    figure_formats = CHART_FORMATS

    over: Sweep
    found: Found
    language: str
    elsewhere: tuple[tuple[Symbol, float, float, bool], ...] = ()
    on_paper: tuple[tuple[Way, str], ...] = ()

    @property
    def mechanism(self) -> Mechanism:
        return self.over.scene

    @property
    def rows(self) -> int:
        """Positions of all designs."""
        return self.found.rows

    @property
    def good(self) -> int:
        """Positions that are solved."""
        return self.found.good

    @property
    def ok(self) -> bool:
        """Whether one position at least is solved."""
        return self.good > 0

    @property
    def outcomes(self) -> Mapping[str, int]:
        """Over designs how many came out with each status."""
        return Counter(outcome.status for outcome in self.found.outcomes)

    def __getitem__(self, name: str) -> Array:
        """A quantity by its name, as far as it was asked for, or any column of the table: NaN where there is none.
        Raises CallError for an unknown one."""
        name = as_text("name", name)
        watched = self.over.base.watched
        k = next((k for k, w in enumerate(watched) if w.name == name), None)
        if k is not None and self.found.arrays is not None:
            parts = self.found.arrays.parts[k]
        elif k is not None:
            heads = [c.name for c in watched[k].columns(self.mechanism, [np.zeros(0)] * (1 + watched[k].is_vector))]
            parts = tuple(self.table[head] for head in heads[-1 - watched[k].is_vector :])
        else:
            parts = (self.table[name],)
        values = parts[0] if len(parts) == 1 else parts[0] + 1j * parts[1]
        shown = values.reshape(-1, self.over.positions) if self.over.designs.keys else values
        return shown if k is None else Values.of(shown, watched[k].unit(self.mechanism).text)

    @cached_property
    def table(self) -> Table:
        """A row for each position: what is asked in the scene's units, degrees for angles, and its status."""
        if self.found.arrays is not None:
            return self.over.base.table_of(self.found.arrays, self.rows, 0, self.rows)
        if self.found.table is not None:
            return self.found.table
        return table_of_csv(self.found.files[0], self.over.head)

    @cached_property
    def designs(self) -> Table | None:
        """Over designs a row for each: what was replaced, how it came out, strokes, K, least transmission angles."""
        from graphkin.study.sweeps import designs_table

        return designs_table(self.over, self.found.outcomes) if self.over.designs.keys else None

    @cached_property
    def turn(self) -> TurnStudy | None:
        """The study of the scene itself (limit positions, K, transmission, classes, extremes); None over designs."""
        from graphkin.study.turn import study_turn

        if self.over.designs.keys or moves_by_law(self.over.scene):
            return None
        return study_turn(self.over.base.reach, [q for q in self.over.asked if q.kind != "place" and not q.is_load])

    @cached_property
    def time(self) -> TimeStudy | None:
        """The study over the time of a scene whose drivers move by laws; None of others, and over designs."""
        if self.over.designs.keys or not moves_by_law(self.over.scene):
            return None
        from graphkin.study.over_time import study_time  # it loads the drawing board

        return study_time(self.over.scene, self._wished)

    @property
    def _wished(self) -> list[Quantity]:
        """What is asked besides the scene's own wishes: it alone is drawn."""
        own = [str(s) for s in self.over.scene.find]
        wished = [q for q in self.over.asked if q.kind != "place"]
        return wished if [q.name for q in self.over.asked] != own else []

    @cached_property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin sweep --json`` prints."""
        from graphkin.study.turn_data import to_json

        data: dict[str, Json] = to_json(self.turn) if self.turn is not None else {"title": self.over.scene.title}
        if self.time is not None:
            data = dict(self.time.data)
        data["positions"] = {"rows": self.rows, "ok": self.good}
        if self.over.designs.keys:
            data["designs"] = {
                "keys": list(self.over.designs.keys), "count": len(self.over.designs), "outcomes": dict(self.outcomes)
            }
        data["files"] = [str(p) for p in self.found.files]
        return data

    @cached_property
    def figures(self) -> Mapping[str, ChartPage | Drawing]:
        """Motion diagrams of the outputs and coupler curves by name; none over designs."""
        from graphkin.study.diagrams import diagrams
        from graphkin.study.quantities import symbol_quantity

        if self.time is not None:
            return self.time.diagrams(self.language)
        if self.turn is None:
            return {}
        # what is asked alone is drawn alone; without that the outputs and the coupler curves
        asked = self._wished
        over: dict[Quantity, list[tuple[float, float]]] = {}
        for symbol, place, value, along in self.elsewhere:
            offset = float(self.turn.reach.offsets(np.array([place]))[0])
            over.setdefault(replace(symbol_quantity(symbol), along=along), []).append((offset, value))
        if over:
            signed = {replace(quantity, along=False): quantity for quantity in over}
            asked = list(dict.fromkeys((*(signed.get(q, q) for q in asked), *over)))
        pages = {}
        if asked or not self.chords:
            pages = diagrams(self.turn, self.language, asked=asked, over=over)
        if self.chords:
            from graphkin.study.graphical import chords_page

            pages |= {name: chords_page(one, self.turn.reach, self.language) for name, one in self.chords.items()}
        return pages

    @cached_property
    def chords(self) -> Mapping[str, Chords]:
        """What was differentiated or integrated on paper, by the names of their figures."""
        if not self.on_paper:
            return {}
        from graphkin.study.graphical import graphical  # it loads the drawing board

        reach = self.over.base.reach
        return {f"{way}-{name.replace('/', '-')}": graphical(reach, name, way) for way, name in self.on_paper}

    def to_xarray(self) -> xarray.Dataset:
        """The table as a data set of xarray with units, over ``position`` or over ``design`` and ``position``, with
        what is replaced as coordinates of the designs.  Raises CallError where it is not installed."""
        data = self.table.to_xarray()
        return data.assign_coords({key: ("design", data[key].values[:, 0]) for key in self.over.designs.keys})

    @property
    def tables(self) -> Mapping[str, Table]:
        """table.csv, and table.parquet where pyarrow is installed; over designs designs.csv."""
        designs = {"designs.csv": self.designs} if self.designs is not None else {}
        return {"table.csv": self.table, **designs, **({"table.parquet": self.table} if have("pyarrow") else {})}

    @property
    def files(self) -> Mapping[str, bytes]:
        """The tables of what was differentiated or integrated on paper."""
        if not self.on_paper:
            return {}
        from graphkin.study.graphical import chords_table

        return {f"{name}.csv": chords_table(chords, self.over.base.reach) for name, chords in self.chords.items()}

    def write_figures(
        self, folder: str | os.PathLike[str], formats: Sequence[str] = ("svg",), text: str = "glyphs"
    ) -> list[Path]:
        """Write what ``write`` does, but for the tables; returns the paths.  Raises CallError for an unknown format or
        a folder that cannot be written."""
        return write_files(path_of(folder), {**self.pages(formats, text), **self.files})

    @property
    def text(self) -> str:
        """The whole summary as lines of text."""
        from graphkin.api.report_text import turn_text

        lines = [self.mechanism.title_in(self.language)]
        if self.turn is not None:
            lines += turn_text(self.turn, self.language)
        if self.time is not None:
            lines += self.time.lines(self.language)
        if self.over.designs.keys:
            outcomes = ", ".join(
                f"{n} {word('status ' + status, self.language)}" for status, n in self.outcomes.items()
            )
            lines.append(say(Phrase("designs solved", (len(self.over.designs), outcomes)), self.language))
        if self.found.damaged:
            lines.append(say(Phrase("pieces damaged", (self.found.damaged,)), self.language))
        lines.append(say(Phrase("positions solved", (self.good, self.rows)), self.language))
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"<Swept {self.mechanism.name}: {self.good} of {self.rows} positions>"

    def _repr_html_(self) -> str:
        shown = f"<pre>{html.escape(self.text)}</pre>"
        if self.turn is None and self.time is None:
            return shown
        return shown + "".join(f._repr_svg_() for f in list(self.figures.values())[:2])


