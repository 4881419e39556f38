"""Drawings as files: the format by the name, each file whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Protocol

from graphkin.drawing.primitives import Drawing
from graphkin.drawing.svg import svg_bytes
from graphkin.errors import CallError, Problem
from graphkin.jobs import whole_file

__all__ = ["FORMATS", "OtherPage", "drawing_bytes", "save"]

FORMATS = ("svg", "pdf", "png")


class OtherPage(Protocol):
    """A page that is no drawing of primitives (a chart), and knows itself how it becomes a file."""

    def content(self, format: str, dpi: float = 200.0) -> bytes: ...


def drawing_bytes(drawing: Drawing | OtherPage, format: str, dpi: float = 200.0) -> bytes:
    """The drawing as a file of a format, "svg", "pdf" or "png" (``dpi`` for png only).

    Raises
    ------
    CallError : another format
    """
    if not isinstance(drawing, Drawing):
        return drawing.content(format, dpi)
    if format == "svg":
        return svg_bytes(drawing)
    if format in FORMATS:
        from graphkin.drawing.page import pdf_bytes, png_bytes

        return pdf_bytes(drawing) if format == "pdf" else png_bytes(drawing, dpi)
    raise CallError(Problem("format", f'"{format}"', f"known here: {', '.join(FORMATS)}"))


def save(drawing: Drawing | OtherPage, path: str | os.PathLike[str], dpi: float = 200.0) -> Path:
    """Write the drawing to a file, as SVG, PDF or PNG by the ending of its name, and return the path.

    The file appears whole or not at all; one of the same name is replaced.

    Raises
    ------
    CallError : the ending is none of the three
    OSError : the place cannot be written
    """
    target = Path(path)
    content = drawing_bytes(drawing, target.suffix.lower().removeprefix("."), dpi)
    with whole_file(target) as out:
        out.write(content)
    return target
