"""A table: columns of numbers or words, each with its name, its unit and its symbol; and its writers.

Columns are arrays; no row is ever an object. pyarrow writes them where it is installed, else Python's own loops in C;
both give the same bytes.  pyarrow, pandas and xarray are imported when a table is first written so, and never before.

Numbers in text are the shortest decimals that read back as the same double.  From 0.000001 to below 10000000000 they
are written out (0.00025, 12, 1500.25), beyond that with a power (1.5e-7, 2e+10), as pyarrow does.  A column may have
another format.  A missing value (NaN) is an empty cell in CSV and HTML, ``null`` in JSON, Parquet and Arrow.
"""

from __future__ import annotations

import csv
import io
import json
import math
import os
import re
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from decimal import Decimal
from functools import cached_property
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphkin.errors import CallError, Problem, as_text, did_you_mean
from graphkin.files import Json, opened, path_of, whole_file, write_files, writing_to
from graphkin.words import Phrase, from_others, listed

if TYPE_CHECKING:
    import pandas
    import pyarrow
    import pyarrow.csv
    import pyarrow.parquet
    import xarray

BLOCK = 16384
"""Rows that are turned into text at once, so that a table of any length needs little more memory."""
FEW = 20_000
"""Cells of a table for which it does not pay to load pyarrow."""
SHOWN = 24
"""Rows of a table that HTML shows; of a longer one the first and the last."""
FILES = (".csv", ".parquet", ".json", ".html")
"""Endings of the files that a table can be written as."""


def have(library: str) -> bool:
    """Whether a library is installed."""
    return find_spec(library) is not None


class Values(np.ndarray[Any, np.dtype[Any]]):
    """Values of a quantity, as an array that shows its unit; results computed from it are plain arrays.

    >>> speeds = Values.of(np.array([1.5, 3.0]), "m/s")
    >>> speeds
    array([1.5, 3. ]) m/s
    >>> speeds[1:], 2 * speeds
    (array([3.]) m/s, array([3., 6.]))
    """

    unit: str

    @classmethod
    def of(cls, values: Array, unit: str) -> Values:
        """Values in a unit, in the same memory."""
        shown = np.asarray(values).view(cls)
        shown.unit = unit
        return shown

    def __array_finalize__(self, source: object) -> None:
        self.unit = getattr(source, "unit", "")

    def __array_wrap__(self, array: Array, context: object = None, return_scalar: bool = False) -> Any:
        return np.asarray(array)[()]

    def __repr__(self) -> str:
        return f"{np.asarray(self)!r} {self.unit}".rstrip()


@dataclass(frozen=True, eq=False)
class Column:
    """One column of a table.

    values : shape (rows,): floats (NaN: no value), whole numbers, bools ("yes" and "no" in text), or words (an object
        array of str)
    unit : "" for pure numbers and words
    symbol : the symbol of its quantity: "v_C" for the column "v_C.x"
    form : the format of numbers in text, as for ``format``; "" is the shortest decimal that reads back the same
    """

    name: str
    values: Array
    unit: str = ""
    symbol: str = ""
    form: str = ""

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Column):
            return NotImplemented
        first, second = (c.values for c in (self, other))
        floats = first.dtype.kind == second.dtype.kind == "f"
        said = all(getattr(self, k) == getattr(other, k) for k in ("name", "unit", "symbol", "form"))
        return said and np.array_equal(first, second, equal_nan=floats)

    def __hash__(self) -> int:
        return hash((self.name, self.unit, len(self.values)))

    @property
    def head(self) -> str:
        """Its name with its unit, as in the head of a CSV file."""
        return f"{self.name} ({self.unit})" if self.unit else self.name

    @property
    def is_text(self) -> bool:
        """Whether it holds words."""
        return self.values.dtype.kind in "OUS"

    def texts(self, rows: slice = slice(None)) -> list[str]:
        """Its cells as text."""
        values = self.values[rows]
        kind = values.dtype.kind
        if self.form and kind in "fiu":
            return formatted(values, self.form)
        if kind == "f":
            return shortest(values)
        if kind == "b":
            return ["yes" if value else "no" for value in values.tolist()]
        return list(map(str, values.tolist()))


@dataclass(frozen=True)
class Table:
    """Columns of the same length, in their order.

    index : names of the columns that number the rows, the last one fastest: the dimensions in xarray

    Examples
    --------
    >>> turn = Table((Column("driver_1", np.array([0.0, 90.0]), "deg"), Column("v_C", np.array([1.5, np.nan]), "m/s")))
    >>> print(turn.csv(), end="")
    driver_1 (deg),v_C (m/s)
    0,1.5
    90,
    >>> turn["v_C"].tolist()
    [1.5, nan]
    """

    columns: tuple[Column, ...]
    index: tuple[str, ...] = ()

    @classmethod
    def of(
        cls,
        heads: Sequence[str],
        rows: Iterable[Sequence[object]],
        forms: Sequence[str] = (),
        units: Sequence[str] = (),
    ) -> Table:
        """A small table from rows of numbers (None: no value), bools or words.

        Parameters
        ----------
        forms : for each column the format of its numbers, "" for the shortest
        units : for each column its unit, "" where it has none
        """
        cells = list(rows)
        columns = []
        none = [""] * len(heads)
        for i, (head, form, unit) in enumerate(zip(heads, forms or none, units or none, strict=True)):
            columns.append(Column(head, as_array([row[i] for row in cells]), unit, form=form))
        return cls(tuple(columns))

    def __len__(self) -> int:
        return len(self.columns[0].values) if self.columns else 0

    def __getitem__(self, name: str) -> Array:
        """The values of a column by its name, or by its head.  Raises CallError for an unknown one."""
        name = as_text("name", name)
        column = self.column(name)
        return Values.of(column.values, column.unit) if column.unit else column.values

    def __iter__(self) -> Iterator[str]:
        """The names of the columns, as a frame of pandas gives them."""
        return iter(self.names)

    def __contains__(self, name: object) -> bool:
        return any(name in (column.name, column.head) for column in self.columns)

    def column(self, name: str) -> Column:
        """A column by its name, or by its head.  Raises CallError for an unknown one."""
        for column in self.columns:
            if name in (column.name, column.head):
                return column
        raise CallError.of(Phrase("column of name", name=name), "there is none", did_you_mean(name, self.names))

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(c.name for c in self.columns)

    @property
    def heads(self) -> tuple[str, ...]:
        """Names with units."""
        return tuple(c.head for c in self.columns)

    @classmethod
    def joined(cls, tables: Sequence[Table]) -> Table:
        """Tables with the same columns, one after the other."""
        rows = zip(*(t.columns for t in tables), strict=True)
        made = tuple(replace(same[0], values=np.concatenate([c.values for c in same])) for same in rows)
        return cls(made, tables[0].index)

    def rows(self, some: slice = slice(None)) -> Table:
        """Some rows of it."""
        return Table(tuple(replace(c, values=c.values[some]) for c in self.columns), self.index)

    def harmless(self) -> Table:
        """The table with words marked as text where a spreadsheet would take them for formulas.

        >>> print(Table.of(["name"], [["=1+1"], ["-2.5"], ["@x"]]).harmless().csv(), end="")
        name
        '=1+1
        -2.5
        '@x
        """
        made = (replace(c, values=np.array(list(map(no_formula, c.texts())), dtype=object)) if c.is_text else c
                for c in self.columns)
        return Table(tuple(made), self.index)

    # text

    def csv(self) -> str:
        """The text of a CSV file."""
        out = io.BytesIO()
        self.write_csv(out)
        return out.getvalue().decode()

    def write_csv(self, out: IO[bytes], head: bool = True) -> None:
        """Write it as CSV: UTF-8, lines that end with a line feed, quotes only where a cell needs them."""
        if head:
            out.write((",".join(map(quoted, self.heads)) + "\n").encode())
        arrow = len(self) * len(self.columns) > FEW and have("pyarrow")
        for first in range(0, len(self), BLOCK):
            some = slice(first, first + BLOCK)
            out.write(self._lines_by_arrow(some) if arrow else self._lines(some))

    def _lines(self, some: slice) -> bytes:
        cells = [all_quoted(c.texts(some)) if c.is_text else c.texts(some) for c in self.columns]
        return ("\n".join(map(",".join, zip(*cells, strict=True))) + "\n").encode()

    def _lines_by_arrow(self, some: slice) -> bytes:
        import pyarrow as pa
        from pyarrow import compute

        # pyarrow's writer of CSV files would put every word into quotes: so its numbers are joined here
        cells = []
        for column in self.columns:
            values = column.values[some]
            if values.dtype.kind in "fiu" and not column.form:
                cells.append(compute.cast(numbers_to_arrow(values), pa.string()))
            else:
                texts = column.texts(some)
                cells.append(words_to_arrow(all_quoted(texts) if column.is_text else texts))
        null = {"null_handling": "replace", "null_replacement": ""}
        comma, nothing, end_of_line = words_to_arrow([",", "", "\n"])
        lines = compute.binary_join_element_wise(*cells, comma, **null)
        lines = compute.binary_join_element_wise(lines, nothing, end_of_line)
        start, end = np.frombuffer(lines.buffers()[1], np.int32)[[lines.offset, lines.offset + len(lines)]]
        return bytes(memoryview(lines.buffers()[2])[start:end])

    def texts(self) -> Iterator[tuple[str, ...]]:
        """Its rows as text cells, for a terminal or a page."""
        return zip(*(c.texts() for c in self.columns), strict=True)

    def _repr_html_(self) -> str:
        import html  # with all its names of characters, of which a table on a terminal needs none

        n, ends = len(self), SHOWN // 2
        parts = [self] if n <= SHOWN else [self.rows(slice(0, ends)), self.rows(slice(n - ends, n))]
        gap = f'<tr><td colspan="{len(self.columns)}">&hellip; {n} rows &hellip;</td></tr>'
        head = "".join(f"<th>{html.escape(h)}</th>" for h in self.heads)
        tags = ["<td>" if c.is_text else '<td style="text-align:right">' for c in self.columns]
        bodies = (
            "".join(
                "<tr>" + "".join(f"{tag}{html.escape(x)}</td>" for tag, x in zip(tags, row, strict=True)) + "</tr>"
                for row in part.texts()
            )
            for part in parts
        )
        return f"<table><tr>{head}</tr>{gap.join(bodies)}</table>"

    # data

    @cached_property
    def data(self) -> dict[str, Json]:
        """For programs: each column with its unit, its symbol and its values; ``None`` where there is none."""
        return {c.name: {**_facts(c), "values": plain(c.values)} for c in self.columns}

    def write_json(self, out: IO[bytes]) -> None:
        """Write ``data`` as JSON, piece by piece."""
        for k, column in enumerate(self.columns):
            facts = json.dumps(_facts(column), ensure_ascii=False)[:-1]
            mark = "{" if k == 0 else ", "
            part = ", " if len(facts) > 1 else ""
            out.write(f'{mark}{json.dumps(column.name, ensure_ascii=False)}: {facts}{part}"values": ['.encode())
            for first in range(0, len(self), BLOCK):
                text = json.dumps(plain(column.values[first : first + BLOCK]), ensure_ascii=False, allow_nan=False)
                out.write((", " * (first > 0) + text[1:-1]).encode())
            out.write(b"]}")
        out.write(b"}\n" if self.columns else b"{}\n")

    # libraries

    def to_arrow(self) -> pyarrow.Table:
        """The table of pyarrow.  Raises CallError where it is not installed."""
        pa = _library("pyarrow")
        columns = {}
        for column in self.columns:
            values = column.values
            mask = np.isnan(values) if values.dtype.kind == "f" else None
            columns[column.head] = pa.array(values, pa.string() if column.is_text else None, mask=mask)
        return pa.table(columns)

    def to_pandas(self) -> pandas.DataFrame:
        """The frame of pandas, its columns named by their heads.  Raises CallError where it is not installed."""
        return _library("pandas").DataFrame({c.head: c.values for c in self.columns}, copy=False)

    def to_xarray(self) -> xarray.Dataset:
        """The data set of xarray: a variable for each column, with its unit, over the columns of ``index``.

        Raises CallError where it is not installed.
        """
        _library("xarray")
        along = self.index or ("row",)
        columns = {c.name: c.values for c in self.columns}
        frame = _library("pandas").DataFrame(columns if self.index else {"row": np.arange(len(self)), **columns})
        dataset = frame.set_index(list(along)).to_xarray()
        if dataset.sizes and math.prod(dataset.sizes.values()) != len(self):
            raise CallError.of("table", "is no grid of", shape=listed(self.index))
        for column in self.columns:  # "units" is the name that xarray's plots look for
            facts = _facts(column).items()
            dataset[column.name].attrs |= {"units" if fact == "unit" else fact: text for fact, text in facts}
        return dataset

    # files

    def write(self, path: str | Path) -> Path:
        """Write it to a file that appears whole or not at all: .csv, .parquet, .json or .html by its name.

        Raises
        ------
        CallError : another ending, pyarrow is missing for .parquet, or a place that cannot be written
        """
        target = path_of(path)
        kind = target.suffix.lower()
        if kind not in FILES:
            raise CallError.of(str(path), "is no table of kind", "known here", kind=kind, names=listed([*FILES]))
        arrow = self.to_arrow() if kind == ".parquet" else None
        with writing_to(str(path)), whole_file(target) as out:
            if kind == ".csv":
                self.write_csv(out)
            elif kind == ".json":
                self.write_json(out)
            elif arrow is None:
                out.write(self._repr_html_().encode())
            else:
                with _parquet(self, arrow.schema, out) as writer:
                    writer.write_table(arrow)
        return target


class Tabled(ABC):
    """A result with a table, its columns, its exports and its display.

    ``tabled["v_C"]`` is a value by its name, in the file's units and degrees, with its unit; ``table`` has all values
    as columns with units, ``data`` for programs, ``write`` makes its files; a notebook shows it.
    """

    __slots__ = ()

    @property
    @abstractmethod
    def table(self) -> Table:
        """Its main table."""

    @property
    def data(self) -> Json:
        """For programs: each column of the table with its unit and its values; ``None`` for a missing value."""
        return self.table.data

    def write(self, folder: str | os.PathLike[str]) -> Sequence[Path]:
        """Write table.csv, and table.parquet where pyarrow is installed, into a folder; or one file, whose name ends in
        .csv, .parquet, .json or .html.  Returns the paths; raises CallError as ``Table.write``."""
        target = path_of(folder)
        if target.suffix.lower() in FILES:
            return [self.table.write(target)]
        write_files(target, {})
        names = ["table.csv", "table.parquet"] if have("pyarrow") else ["table.csv"]
        return [self.table.write(target / name) for name in names]

    def __getitem__(self, name: str) -> Any:
        """A column of the table by its name.  Raises CallError for an unknown one."""
        name = as_text("name", name)
        return self.table[name]

    def __contains__(self, name: object) -> bool:
        """Whether ``tabled[name]`` is there."""
        if not isinstance(name, str):
            return False
        try:
            self[name]
        except CallError:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        """Results are read by name only: Python would ask for 0, 1, 2 ... Raises TypeError."""
        raise TypeError(f"a {type(self).__name__} is asked by name, and has its rows in .table: it is not gone through")

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a frame of pandas.  Raises CallError where that is not installed."""
        return self.table.to_pandas()

    def to_xarray(self) -> xarray.Dataset:
        """The table as a data set of xarray, with units.  Raises CallError where that is not installed."""
        return self.table.to_xarray()

    def _repr_html_(self) -> str:
        return self.table._repr_html_()

    def __getstate__(self) -> dict[str, object]:
        return {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]


def _library(name: str) -> Any:
    try:
        return import_module(name)
    except ImportError:
        raise CallError.of(name, "is not installed", "install it with pip install", name=name) from None


def _facts(column: Column) -> dict[str, str]:
    facts = {"unit": column.unit, "symbol": column.symbol}
    return {key: text for key, text in facts.items() if text}


Array = NDArray[Any]
"""Cells of a column: numbers, words as objects, or whether something is so."""

_LEAST, _MOST = 1e-6, 1e10


def as_array(cells: Sequence[object]) -> Array:
    """Cells of a column: whole numbers, bools or words, or else floats, with NaN for None."""
    for kind in (bool, int, str):
        if cells and all(type(cell) is kind for cell in cells):
            return np.array(cells, dtype=object if kind is str else kind)
    if any(isinstance(cell, str) for cell in cells):
        return np.array(["" if cell is None else str(cell) for cell in cells], dtype=object)
    numbers: ArrayLike = [np.nan if cell is None else float(cell) for cell in cells]  # type: ignore[arg-type]
    return np.array(numbers, dtype=float)


def plain(values: Array) -> list[Json]:
    """Cells for programs: ``None`` for a missing number."""
    cells: list[Json] = (values + 0.0 if values.dtype.kind == "f" else values).tolist()
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        return [x if known else None for x, known in zip(cells, np.isfinite(values).tolist(), strict=True)]
    return cells


def formatted(values: Array, form: str) -> list[str]:
    """Numbers in a format, "" for a missing number."""
    # "a: b" and "a: b" alike: one call for each cell, none of them in Python
    cells = list(map(("{:" + form + "}").format, values.tolist()))
    cells = [text[1:] if text.startswith("-0") and not text.strip("-0.") else text for text in cells]
    for k in np.flatnonzero(np.isnan(values)).tolist():
        cells[k] = ""
    return cells


def shortest(values: Array) -> list[str]:
    """Numbers as the shortest decimals that read back the same."""
    cells = list(map(repr, (values + 0.0).tolist()))
    size = np.abs(values)
    other = (size < 1e-4) | ~(size < _MOST) | (values == np.rint(values))
    for k in np.flatnonzero(other).tolist():
        cells[k] = _shown(float(values[k]))
    return cells


def _shown(value: float) -> str:
    """A number as pyarrow writes it: Python's ``repr`` has the same digits, but other rules for powers."""
    if value != value:
        return ""
    if value in (0.0, np.inf, -np.inf):
        return f"{value + 0.0:g}"
    written_out = _LEAST <= abs(value) < _MOST
    return format(Decimal(repr(value)).normalize(), "f" if written_out else "e")


def no_formula(cell: str) -> str:
    """The cell, marked as text where a spreadsheet would take it for a formula."""
    begins = cell.lstrip(" ")[:1]
    number = re.fullmatch(r"[+\-]?[\d.,\s]*(?:[eE][+\-]?\d+)?[ °%]*", cell)
    return "'" + cell if begins in tuple("=@+-\t\r") and begins and not number else cell


def quoted(cell: str) -> str:
    """A cell as CSV has it, in quotes only where it needs them."""
    return '"' + cell.replace('"', '""') + '"' if any(c in cell for c in ',"\n\r') else cell


def all_quoted(cells: list[str]) -> list[str]:
    """Cells as CSV has them; each different word is quoted once."""
    some = {cell: quoted(cell) for cell in set(cells)}
    return list(map(some.__getitem__, cells))


def numbers_to_arrow(values: Array) -> pyarrow.Array:
    """Numbers as an array of pyarrow, null for NaN; made of its parts, for ``pyarrow.array`` would load pandas."""
    import pyarrow as pa

    if values.dtype.kind != "f":
        return pa.Array.from_buffers(pa.int64(), len(values), [None, pa.py_buffer(values.astype(np.int64))])
    given = ~np.isnan(values)
    mask = None if given.all() else pa.py_buffer(np.packbits(given, bitorder="little"))
    return pa.Array.from_buffers(pa.float64(), len(values), [mask, pa.py_buffer(values + 0.0)])


def words_to_arrow(words: list[str]) -> pyarrow.Array:
    """Words as an array of pyarrow, made of its parts too."""
    import pyarrow as pa

    parts = list(map(str.encode, words))
    ends = np.zeros(len(parts) + 1, np.int32)
    np.cumsum(list(map(len, parts)), out=ends[1:])
    return pa.StringArray.from_buffers(len(parts), pa.py_buffer(ends), pa.py_buffer(b"".join(parts)))


# a table that was written as a CSV file


def table_of_csv(path: str | Path, like: Table) -> Table:
    """A table from a CSV file written from a table with the columns of ``like`` (which may be empty)."""
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
    """Cells of a CSV file as values of a column."""
    kind = like.values.dtype.kind
    if kind == "b":
        return np.asarray(cells == "yes")
    return np.where(cells == "", "nan", cells) if kind == "f" else cells


def parquet_of_csv(path: Path, like: Table, out: IO[bytes]) -> None:
    """Write the table of a CSV file (with the columns of ``like``) as Parquet, in bounded memory."""
    from pyarrow import csv as csv_file

    with csv_file.open_csv(path, convert_options=_arrow_types(like)) as reader, \
            _parquet(like, reader.schema, out) as writer:
        for batch in reader:
            writer.write_batch(batch)


def _parquet(like: Table, schema: pyarrow.Schema, out: IO[bytes]) -> pyarrow.parquet.ParquetWriter:
    """The writer of Parquet: only words are kept in dictionaries, since hardly any number comes twice."""
    words = [column.head for column in like.columns if column.is_text]
    return import_module("pyarrow.parquet").ParquetWriter(out, schema, compression="zstd", use_dictionary=words)


def _arrow_types(like: Table) -> pyarrow.csv.ConvertOptions:
    import pyarrow as pa
    from pyarrow import csv as csv_file

    kinds = {"f": pa.float64(), "i": pa.int64(), "u": pa.int64(), "b": pa.bool_()}
    types = {c.head: kinds.get(c.values.dtype.kind, pa.string()) for c in like.columns}
    return csv_file.ConvertOptions(
        column_types=types, null_values=[""], true_values=["yes"], false_values=["no"], strings_can_be_null=False
    )


# tables as people write them

LARGEST = 10_000_000
"""Bytes of a table that people write."""
_MARKS = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}


@dataclass(frozen=True)
class Rows:
    """A table as read: its heads, its rows with the number of their line, and the sign between their cells."""

    heads: tuple[str, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]
    sign: str = ","


def _decoded(data: bytes) -> str | None:
    """The text of a file; None where it is in none of the encodings, or as likely in the one as in the other."""
    for encoding in (_MARKS.get(data[:2], "utf-8-sig"), "gb18030", "cp1252"):
        with suppress(UnicodeDecodeError):
            text = data.decode(encoding)
            if encoding == "gb18030" and not re.search(rb"[\x80-\xff]{4}", data):
                # accents among letters read as rare characters; the usual ones and signs stand first in GB 2312
                chinese = re.sub(r"(?<=[A-Za-z])[\u3400-\u9fff](?=[A-Za-z])", "", text)
                usual = sum(b"\xa0" < c.encode("gb2312", "ignore")[:1] < b"\xd8" for c in chinese)
                rare = sum(c > "\x7f" for c in text) - usual
                if usual <= rare:
                    with suppress(UnicodeDecodeError):
                        western = data.decode("cp1252")
                        return western if usual < rare else None
            return None if "\0" in text else text
    return None


def table_of(path: str | os.PathLike[str], largest: int = LARGEST) -> Rows:
    """A CSV file in UTF-8, or as Chinese (GB 18030) or Western spreadsheets (Windows-1252) write it.

    Commas, semicolons or tabs part the cells, or what a first line ``sep=;`` tells.  Raises CallError, also for a file
    of more bytes than the ``largest``.
    """
    shown = str(path)[:200]
    try:
        with opened(path_of(path)) as stream:
            data = stream.read(largest + 1)
    except (OSError, ValueError) as error:
        raise CallError.of(shown, "cannot be read", "name a csv file", reason=from_others(error)) from None
    if len(data) > largest:
        raise CallError.of(shown, "is larger than mb", "give fewer rows", largest=largest // 1_000_000)
    text = _decoded(data)
    if text is None:
        raise CallError.of(shown, "is not utf-8 text", "save it as csv utf-8")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    first = next(filter(str.strip, text.split("\n")), "")
    parted = re.fullmatch(r'"?sep=([^"])"?[,;\t]*', first.strip(" "), re.IGNORECASE)
    sign = parted[1] if parted else max(",;\t", key=first.count)
    text = text.replace(first, "", 1) if parted else text
    try:
        reader = csv.reader(io.StringIO(text), delimiter=sign, strict=True)
        lines = [(reader.line_num, tuple(c.strip() for c in row)) for row in reader if any(c.strip() for c in row)]
    except csv.Error as error:
        raise CallError.of(shown, "is no table", "save it as csv", error=from_others(error)) from None
    if len(lines) < 2:
        raise CallError.of(shown, "has no rows", "write a line of heads and a line")
    heads = lines[0][1]
    longer = [  # 150,5 where commas part the cells
        Problem(Phrase("line of students and line", students=shown, line=line), "has cells the head has",
                count=len(cells), other=len(heads))
        for line, cells in lines if any(cells[len(heads) :])
    ]
    if longer:
        raise CallError(*longer[:20])
    return Rows(heads, tuple(lines[1:]), sign)


def with_points(sheet: Rows, path: str | os.PathLike[str]) -> Rows:
    """A table with decimal points in place of commas, where commas do not part its cells.  Raises CallError for a
    number that its others leave open."""
    if sheet.sign == ",":
        return sheet
    number = re.compile(r"[+\-]?\d[\d.,]*(?:[eE][+\-]?\d+)?")
    style = style_of(cell for _, cells in sheet.rows for cell in cells if number.fullmatch(cell))
    rows, problems = [], []
    for line, cells in sheet.rows:
        try:
            rows.append((line, tuple(
                pointed(c, style) if number.fullmatch(c) else re.sub(r"(?<=\d),(?=\d)", ".", c) for c in cells)))
        except ValueError as error:
            problems.append(Problem(Phrase("line of students and line", students=path, line=line), error.args[0]))
    if problems:
        raise CallError(*problems[:20])
    return Rows(sheet.heads, tuple(rows), sheet.sign)


_GROUPED = re.compile(r"[+\-]?[1-9]\d{0,2}(?:,\d{3})+|[+\-]?[1-9]\d{0,2}(?:\.\d{3})+")


def style_of(texts: Iterable[str]) -> str:
    """The decimal sign of the numbers in texts, behind the one that parts thousands if a number has both; "" where none
    tells it, "?" where some have the other.

    >>> style_of(["1.220", "3.936,6"]), style_of(["1.220", "482,7 mm"]), style_of(["1.220"]), style_of(["1,2", "1.2"])
    ('.,', ',', '', '?')
    """
    styles = set[str]()
    for number in re.findall(r"\d[\d.,]*\d", " ".join(texts)):
        signs = re.sub(r"\d", "", number)
        point, aside = signs[-1:], "," if signs.endswith(".") else "."
        if len(signs) == 1 and not _GROUPED.fullmatch(number):
            styles.add(point)
        elif len(signs) > 1:
            styles.add(aside if {*signs} == {point} else aside + point)
    return max(styles, key=len, default="") if len({style[-1] for style in styles}) < 2 else "?"


def pointed(number: str, style: str) -> str:
    """A number with a decimal point and without signs that part thousands, of a style as of ``style_of``; a single sign
    is the decimal one where that is "".  Raises ValueError for 1.220 beside decimal commas: it may be 1220 or 1.22."""
    sign = "," if number.rfind(",") > number.rfind(".") else "."
    aside = "." if sign == "," else ","
    plain, decimal = number.replace(sign, ""), number.replace(sign, ".")
    if aside in number:
        return number.replace(aside, "").replace(sign, ".") if number.count(sign) == 1 else number
    if not _GROUPED.fullmatch(number) or (number.count(sign) == 1 and style in ("", sign, aside + sign)):
        return decimal
    if number.count(sign) == 1 and style != sign + aside:
        raise ValueError(Phrase("cell two ways", cell=number[:40], plain=plain, decimal=decimal))
    return plain
