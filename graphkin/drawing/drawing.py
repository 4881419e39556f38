"""Drawings and their files: SVG, PDF or PNG by the name, each file whole or not at all."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from graphkin.drawing.primitives import Page
from graphkin.drawing.svg import svg_bytes
from graphkin.errors import CallError, Problem
from graphkin.jobs import whole_file

__all__ = ["FORMATS", "Drawing", "save"]

FORMATS = ("svg", "pdf", "png")


@dataclass(frozen=True)
class Drawing(Page):
    """A page that can be kept: in a file, or shown in a notebook.

    Two types, because the writers, which a drawing calls, know nothing but what is on a page.
    """

    def content(self, format: str, dpi: float = 200.0) -> bytes:
        """The page as a file of a format, "svg", "pdf" or "png" (``dpi`` for png only).

        Raises
        ------
        CallError : another format
        """
        if format == "svg":
            return svg_bytes(self)
        if format in FORMATS:
            from graphkin.drawing.page import pdf_bytes, png_bytes

            return pdf_bytes(self) if format == "pdf" else png_bytes(self, dpi)
        raise CallError(Problem("format", f'"{format}"', f"known here: {', '.join(FORMATS)}"))

    def save(self, path: str | os.PathLike[str], dpi: float = 200.0) -> Path:
        """Write the page to a file, as SVG, PDF or PNG by the ending of its name; returns the path."""
        return save(self, path, dpi)

    def _repr_svg_(self) -> str:
        return svg_bytes(self).decode()


class Kept(Protocol):
    """What knows how it becomes a file: a drawing, or a chart."""

    def content(self, format: str, dpi: float = 200.0) -> bytes: ...


def save(drawing: Kept, path: str | os.PathLike[str], dpi: float = 200.0) -> Path:
    """Write a drawing or a chart to a file, as SVG, PDF or PNG by the ending of its name, and return the path.

    The file appears whole or not at all; one of the same name is replaced.

    Raises
    ------
    CallError : the ending is none of the three
    OSError : the place cannot be written
    """
    target = Path(path)
    content = drawing.content(target.suffix.lower().removeprefix("."), dpi)
    with whole_file(target) as out:
        out.write(content)
    return target
