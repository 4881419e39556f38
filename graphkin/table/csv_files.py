"""A table that was written as a CSV file: read again, and turned into Parquet in bounded memory."""

from __future__ import annotations

import csv
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import IO, TYPE_CHECKING

import numpy as np

from graphkin.table import Array, Column, Table, have

if TYPE_CHECKING:
    import pyarrow.csv

__all__ = ["parquet_of_csv", "table_of_csv"]


def table_of_csv(path: str | Path, like: Table) -> Table:
    """A table from a CSV file that was written of one with the same columns (``like``, which may be empty)."""
    if have("pyarrow"):
        csv_file = import_module("pyarrow.csv")
        whole = csv_file.read_csv(path, convert_options=_arrow_types(like))
        arrays = [column.to_numpy() for column in whole.columns]
    else:
        with open(path, newline="", encoding="utf-8") as stream:
            cells = np.array(list(csv.reader(stream))[1:], dtype=object).reshape(-1, len(like.columns))
        arrays = [_read(cells[:, k], column) for k, column in enumerate(like.columns)]
    kinds = [c.values.dtype for c in like.columns]
    made = [
        replace(c, values=values.astype(kind))
        for c, values, kind in zip(like.columns, arrays, kinds, strict=True)
    ]
    return Table(tuple(made), like.index)


def _read(cells: Array, like: Column) -> Array:
    """Cells of a CSV file as what a column holds."""
    kind = like.values.dtype.kind
    if kind == "b":
        return np.asarray(cells == "yes")
    return np.where(cells == "", "nan", cells) if kind == "f" else cells


def parquet_of_csv(path: Path, like: Table, out: IO[bytes]) -> None:
    """Write the table of a CSV file (with the columns of ``like``) as Parquet, in bounded memory."""
    from pyarrow import csv as csv_file
    from pyarrow import parquet

    with csv_file.open_csv(path, convert_options=_arrow_types(like)) as reader, \
            parquet.ParquetWriter(out, reader.schema, compression="zstd") as writer:  # fmt: skip
        for batch in reader:
            writer.write_batch(batch)


def _arrow_types(like: Table) -> pyarrow.csv.ConvertOptions:
    import pyarrow as pa
    from pyarrow import csv as csv_file

    kinds = {"f": pa.float64(), "i": pa.int64(), "u": pa.int64(), "b": pa.bool_()}
    types = {c.head: kinds.get(c.values.dtype.kind, pa.string()) for c in like.columns}
    return csv_file.ConvertOptions(
        column_types=types, null_values=[""], true_values=["yes"], false_values=["no"], strings_can_be_null=False
    )
