"""What all results have in common: a table, plain data for programs, files, and how they show themselves."""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphkin.errors import as_text

if TYPE_CHECKING:
    import pandas
    import xarray

    from graphkin.table import Table

__all__ = ["Result"]


class Result(ABC):
    """What a public function returns.

    ``result["v_C"]`` is one thing of it by its name, ``table`` all of it as columns with units, ``data`` the object
    that the command of the same name prints under ``--json``, ``write`` makes its files; a notebook shows it.

    Two results are equal if they are of one kind and say the same: the same ``data`` and the same ``table``.  They can
    be pickled and sent to other processes; figures and tables are made anew there.
    """

    @property
    @abstractmethod
    def ok(self) -> bool:
        """Whether all is as it should be: what the command of the same name says by its exit status."""

    @property
    @abstractmethod
    def data(self) -> Any:
        """Plain dicts, lists, texts and numbers, as the command of the same name prints them under ``--json``."""

    @property
    @abstractmethod
    def table(self) -> Table:
        """Its main table."""

    @abstractmethod
    def write(self, folder: str | os.PathLike[str]) -> Sequence[Path]:
        """Write its files into a folder; returns their paths.  Raises CallError where it cannot be written."""

    def __getitem__(self, name: str) -> Any:
        """A column of the table by its name.  Raises CallError for an unknown one."""
        name = as_text("name", name)
        return self.table[name]

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a frame of pandas.  Raises CallError where that is not installed."""
        return self.table.to_pandas()

    def to_xarray(self) -> xarray.Dataset:
        """The table as a data set of xarray, with units.  Raises CallError where that is not installed."""
        return self.table.to_xarray()

    def _repr_html_(self) -> str:
        return self.table._repr_html_()

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        assert isinstance(other, Result)
        return bool(self.data == other.data and self.table == other.table)

    def __hash__(self) -> int:
        # equal results have equal tables
        return hash((type(self), self.table))

    def __getstate__(self) -> dict[str, Any]:
        return {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]
