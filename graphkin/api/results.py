"""The common properties of all results: a table, plain data for programs, files, and their display."""

from __future__ import annotations

import os
from abc import abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, Self, TypeVar

from graphkin.api.arguments import known_words, own_folder
from graphkin.errors import CallError, Problem, as_text, did_you_mean
from graphkin.files import Json, write_files
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import Scene
from graphkin.table import Table, Tabled
from graphkin.words import Wording

if TYPE_CHECKING:
    from graphkin.drawing import Drawing
    from graphkin.drawing.chart import ChartPage

T = TypeVar("T")


class OfScene:
    """A result of a mechanism, with the scene of it."""

    if TYPE_CHECKING:

        @property
        def mechanism(self) -> Mechanism: ...

    @property
    def name(self) -> str:
        """The name of the scene."""
        return self.mechanism.name

    @cached_property
    def scene(self) -> Scene:
        """The scene as it was given, for changes by key (``scene.replace("links.1.length", 60)``) and saved."""
        return Scene.saying(self.mechanism)


class Result(Tabled):
    """The result of a public function; ``data`` is the object that the command of its name prints under ``--json``.

    Two results are equal if they are of one kind with the same ``data`` and the same ``table``.  They can be pickled
    and sent to other processes; figures and tables are made anew there.
    """

    figure_formats: ClassVar[Sequence[str]] = ("svg", "pdf", "png", "dxf")
    """What its figures can be written as."""
    table_file: ClassVar[str] = ""
    """The name of the file of its table; "" if this is not written, or elsewhere."""

    @property
    @abstractmethod
    def ok(self) -> bool:
        """Whether the result is as it should be: the exit status of the command of the same name."""

    @property
    @abstractmethod
    def data(self) -> Json:
        """Plain dicts, lists, texts and numbers, as the command of the same name prints them under ``--json``."""

    @property
    @abstractmethod
    def name(self) -> str:
        """Its name; its files go to a folder of that name if none is given."""

    @property
    def figures(self) -> Mapping[str, Drawing | ChartPage]:
        """Its figures by name, with their further pages."""
        return {}

    @property
    def tables(self) -> Mapping[str, Table]:
        """The tables that it writes, by the names of their files."""
        return {self.table_file: self.table} if self.table_file else {}

    @property
    def files(self) -> Mapping[str, bytes | Iterable[bytes]]:
        """Its further files by name, each in one piece or in many."""
        return {}

    def write(
        self, folder: str | os.PathLike[str] | None = None, formats: Sequence[str] = ("svg",), text: str = "glyphs"
    ) -> list[Path]:
        """Write its figures, tables and further files into a folder, by default a folder of its name; returns the
        paths. Each file appears whole or not at all.

        Parameters
        ----------
        formats : of the figures: "svg", "pdf", "png", and of drawings "dxf"
        text : the letters of an SVG: as text with its "glyphs", or as "outlines"

        Raises
        ------
        CallError : an unknown format, a folder that cannot be written
        """
        pages = self.pages(formats, text)
        target = own_folder(folder, self.name)
        paths = write_files(target, pages)
        paths += [table.write(target / name) for name, table in self.tables.items()]
        return paths + write_files(target, self.files)

    def saved(self, folder: str | os.PathLike[str] | None, formats: Sequence[str] = ("svg",)) -> Self:
        """Itself, after it was written into a folder, if one is given."""
        if folder is not None:
            self.write(folder, formats)
        return self

    def pages(self, formats: Sequence[str], text: str = "glyphs") -> dict[str, bytes]:
        """The files of its figures; in PDF further pages of a figure are in its file.  Raises CallError."""
        known_words(formats, text=text, known_formats=self.figure_formats)
        continued = {id(page) for figure in self.figures.values() for page in getattr(figure, "further", ())}
        return {
            f"{name}.{kind}": figure.content(kind, text=text)
            for name, figure in self.figures.items()
            for kind in formats
            if kind != "pdf" or id(figure) not in continued
        }

    def _repr_svg_(self) -> str | None:
        """Its first figure."""
        return next((figure._repr_svg_() for figure in self.figures.values()), None)

    def _repr_html_(self) -> str:
        """Its first figure above its table: of SVG and HTML a notebook shows HTML alone."""
        return (self._repr_svg_() or "") + super()._repr_html_()

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        assert isinstance(other, Result)
        return bool(self.data == other.data and self.table == other.table)

    def __hash__(self) -> int:
        # equal results have equal tables
        return hash((type(self), self.table))


def named(rows: Mapping[str, T], name: str, why: Wording = "", where: str = "") -> T:
    """The row of a result with a name.

    Parameters
    ----------
    why : the sentence on a name that no row has
    where : the kind of the row, if it is said before the name

    Raises
    ------
    CallError : there is no row of that name, with the nearest name
    """
    name = as_text(where or "name", name)
    if name not in rows:
        clauses = (where, f'"{name}"') if where else (f'"{name}"', why)
        raise CallError(Problem(*clauses, did_you_mean(name, rows)))
    return rows[name]
