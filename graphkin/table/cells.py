"""The cells of a table: as arrays from what is found, as text, as CSV has them, for programs, and for pyarrow."""

from __future__ import annotations

import re
from collections.abc import Sequence
from decimal import Decimal
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphkin.files import Json

if TYPE_CHECKING:
    import pyarrow

__all__ = [
    "Array",
    "all_quoted",
    "as_array",
    "formatted",
    "no_formula",
    "numbers_to_arrow",
    "plain",
    "quoted",
    "shortest",
    "words_to_arrow",
]

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
    """Cells for programs: ``None`` where there is no number."""
    found: list[Json] = (values + 0.0 if values.dtype.kind == "f" else values).tolist()
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        return [x if known else None for x, known in zip(found, np.isfinite(values).tolist(), strict=True)]
    return found


def formatted(values: Array, form: str) -> list[str]:
    """Numbers in a format, "" where there is none."""
    # "a: b" and "a: b" alike: one call for each cell, none of them in Python
    found = list(map(("{:" + form + "}").format, values.tolist()))
    found = [text[1:] if text.startswith("-0") and not text.strip("-0.") else text for text in found]
    for k in np.flatnonzero(np.isnan(values)).tolist():
        found[k] = ""
    return found


def shortest(values: Array) -> list[str]:
    """Numbers as the shortest decimals that read back the same."""
    found = list(map(repr, (values + 0.0).tolist()))
    size = np.abs(values)
    other = (size < 1e-4) | ~(size < _MOST) | (values == np.rint(values))
    for k in np.flatnonzero(other).tolist():
        found[k] = _shown(float(values[k]))
    return found


def _shown(value: float) -> str:
    """A number as pyarrow writes it: Python's ``repr`` has the same digits, but other rules for powers."""
    if value != value:
        return ""
    if value in (0.0, np.inf, -np.inf):
        return f"{value + 0.0:g}"
    written_out = _LEAST <= abs(value) < _MOST
    return format(Decimal(repr(value)).normalize(), "f" if written_out else "e")


def no_formula(cell: str) -> str:
    """A cell that no spreadsheet takes for a formula."""
    begins = cell.lstrip(" ")[:1]
    number = re.fullmatch(r"[+\-]?[\d.,\s]*(?:[eE][+\-]?\d+)?[ °%]*", cell)
    return "'" + cell if begins in tuple("=@+-\t\r") and begins and not number else cell


def quoted(cell: str) -> str:
    """A cell as CSV has it, in quotes only where it needs them."""
    return '"' + cell.replace('"', '""') + '"' if any(c in cell for c in ',"\n\r') else cell


def all_quoted(cells: list[str]) -> list[str]:
    """Cells as CSV has them; words repeat, so each is looked at once."""
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
