"""``graphkin draw``: the figures, the readings and the check, as files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphkin.api.arguments import (
    ON_SHEETS,
    At,
    SceneLike,
    asked_symbols,
    driver_values,
    for_paper,
    known_words,
    write_files,
)
from graphkin.api.checked import Checked, checked, hand_of, solved_here
from graphkin.api.report_text import report_text
from graphkin.api.results import Result
from graphkin.construction import EXACT, plan
from graphkin.scene.symbol import Symbol
from graphkin.table import Table
from graphkin.words import languages

if TYPE_CHECKING:
    from graphkin.checking.report import Compared
    from graphkin.drawing import Drawing
    from graphkin.table import Table

__all__ = ["Drawn", "draw"]


@dataclass(frozen=True, repr=False, eq=False)
class Drawn(Result):
    """The figures of a scene by name, with the check of everything on them.

    In a notebook it shows the sheet.  ``figures["velocity"].save("v.pdf")`` picks the format by the name.
    """

    checked: Checked
    small: Checked
    language: str | None
    convention: str | None

    @property
    def ok(self) -> bool:
        return self.checked.ok

    @property
    def data(self) -> dict[str, Any]:
        """The object that ``graphkin draw --json`` prints: that of the check."""
        return self.checked.data

    @property
    def table(self) -> Table:
        """The readings, in scene units."""
        return self.checked.table

    def __getitem__(self, name: str) -> Compared:
        """A reading by its symbol, with the exact value.  Raises CallError for one that was not drawn."""
        return self.checked[name]

    @cached_property
    def figures(self) -> Mapping[str, Drawing]:
        """Figures by name: mechanism, velocity, acceleration, centres, sheet, and sheet-2 where the sheet goes on."""
        from graphkin.api.centred import ROOM, found_centres
        from graphkin.construction.centres import speeds
        from graphkin.drawing import figures
        from graphkin.drawing.centres import centres_figure

        spoken, letters = self.language, self.convention
        made = dict(
            figures(
                self.checked.sheet, self.small.sheet, self.small.report, language=spoken, convention=letters
            )
        )
        part = self.checked.part
        values = {d.key: self.checked.sheet.drivers[d.key] for d in part.drivers}
        # what exact hands have drawn serves this figure too; finite ones draw nothing of the centres
        exact = self.checked.sheet.instrument == EXACT.name
        found = self.checked.centres.in_room(ROOM) if exact else found_centres(part, values)
        made["centres"] = centres_figure(found, speeds(found), language=spoken, convention=letters)
        return made

    def write(self, folder: str | os.PathLike[str] | None = None, formats: Sequence[str] = ("svg",)) -> list[Path]:
        """Write figures, readings.csv and report.txt; returns the paths.  Files appear whole or not at all.

        Raises
        ------
        CallError : an unknown format, a folder that cannot be written
        """
        known_words(formats)
        target = Path(folder) if folder is not None else Path(self.checked.scene.name)
        files: dict[str, bytes] = {}
        figures = self.figures
        overleaf = {id(page) for figure in figures.values() for page in figure.further}
        for name, figure in figures.items():
            for kind in formats:
                if kind == "pdf" and id(figure) in overleaf:
                    continue  # a page of the PDF that it goes on
                files[f"{name}.{kind}"] = figure.content(kind)
        files["readings.csv"] = self.table.csv().encode()
        spoken = languages(self.language or self.checked.scene.sheet.language)[0]
        files["report.txt"] = report_text(self.checked, spoken).encode()
        return write_files(target, files)

    def __repr__(self) -> str:
        return f"<Drawn {self.checked.scene.name}: {', '.join(self.figures)}>"

    def _repr_svg_(self) -> str:
        from graphkin.drawing import svg_bytes

        return svg_bytes(self.figures["sheet"]).decode()


def draw(
    scene: SceneLike,
    out: str | os.PathLike[str] | None = None,
    at: At = None,
    find: Iterable[str | Symbol] | None = None,
    formats: Sequence[str] = ("svg",),
    language: str | None = None,
    convention: str | None = None,
    instrument: str = "exact",
    seed: int = 0,
) -> Drawn:
    """Draw a scene step by step, check it, and write the figures if a folder is given.

    Parameters
    ----------
    scene, at, find, instrument, seed : as for `check`
    out : folder for mechanism, velocity, acceleration and sheet in each of the ``formats``, readings.csv and report.txt
    language : "en", "zh" or "both" (on the figures; the report is in English then); the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    from graphkin import solver
    from graphkin.drawing import sheet_room

    known_words(formats, language, convention, instrument, known_languages=ON_SHEETS)
    given = for_paper(scene)
    asked = asked_symbols(given, find)
    values = driver_values(given, at)
    hand = hand_of(given, instrument, seed)
    structure = solver.structure_of(given)
    motion = solved_here(structure, values, asked)
    what = plan(structure, values, asked)
    whole = checked(what, motion, hand)
    # the sheet shows the same construction at the scales that fit it, and bears its own readings
    fitting = replace(what, scales=what.scales_for(sheet_room(given)))
    small = checked(fitting, motion, hand_of(given, instrument, seed))
    drawn = Drawn(whole, small, language, convention)
    if out is not None:
        drawn.write(out, formats)
    return drawn
