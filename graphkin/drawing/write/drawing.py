"""Drawings and their files: SVG, PDF or PNG by the name, each file whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from graphkin.drawing.font import holds
from graphkin.drawing.ink.primitives import Page, Text, walk
from graphkin.drawing.write.pdf import SvgPage, pdf_bytes, png_bytes
from graphkin.drawing.write.svg import svg_bytes, svg_element
from graphkin.errors import CallError
from graphkin.files import path_of, whole_file
from graphkin.words import listed

FORMATS = ("svg", "pdf", "png", "dxf")
TEXTS = ("glyphs", "outlines")


class Kept:
    """A drawing or a chart: it can be saved in a file, or shown in a notebook."""

    width: float
    height: float
    title: str

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.title!r}: {self.width:.5g} x {self.height:.5g} mm>"

    def content(self, format: str, dpi: float = 200.0, text: str = "glyphs") -> bytes:
        """The page as a file of a format, "svg", "pdf", "png" (at ``dpi``) or "dxf"; the letters of an SVG as text with
        its ``glyphs``, or as ``outlines``, for programs without fonts.

        Raises
        ------
        CallError : another format, or one in which this page cannot be written

        Warns
        -----
        MissingFont : of PDF and PNG, if it has Chinese text and the machine has no face for it
        """
        if not isinstance(format, str) or format not in FORMATS:
            raise CallError.of("format", f'"{format!s:.60}"', "known here", names=listed(FORMATS))
        if not isinstance(text, str) or text not in TEXTS:
            raise CallError.of("text", f'"{text!s:.60}"', "known here", names=listed(TEXTS))
        if format == "svg":
            return self._svg(text == "outlines")
        if format == "dxf":
            return self._dxf()
        pages = self._svg_pages()
        return pdf_bytes(list(pages), self.title) if format == "pdf" else png_bytes(next(pages), self.title, dpi)

    def save(self, path: str | os.PathLike[str], dpi: float = 200.0) -> Path:
        """Write the page to a file, as SVG, PDF, PNG or DXF by the ending of its name; returns the path."""
        return save(self, path, dpi)

    def _repr_svg_(self) -> str:
        return self._svg().decode()

    def _svg(self, outlines: bool = False) -> bytes:
        raise NotImplementedError

    def _dxf(self) -> bytes:
        raise CallError.of("format", '"dxf"', "charts are written as svg pdf or png")

    def _svg_pages(self) -> Iterator[SvgPage]:
        """Its pages for PDF and PNG, on no paper."""
        raise NotImplementedError


@dataclass(frozen=True, repr=False)
class Drawing(Kept, Page):
    """A page of primitives that can be saved; ``further`` are its continuation pages: they follow it in a PDF, and are
    files of their own in other formats.

    It is a type beside `Page`, because the writers, which a drawing calls, know only the content of a page.
    """

    def __hash__(self) -> int:
        return hash((self.width, self.height, self.title, len(self.children)))

    further: tuple[Drawing, ...] = ()

    def _svg(self, outlines: bool = False) -> bytes:
        return svg_bytes(self, outlines=outlines)

    def _dxf(self) -> bytes:
        from graphkin.drawing.write.dxf import dxf_bytes

        return dxf_bytes(self)

    def _svg_pages(self) -> Iterator[SvgPage]:
        for page in (self, *self.further):
            held = all(holds(part.string) for part in walk(page.children) if isinstance(part, Text))
            yield page.width, page.height, svg_element(page, alone=True), page.desc, not held


def save(drawing: Kept, path: str | os.PathLike[str], dpi: float = 200.0) -> Path:
    """Write a drawing or a chart to a file, as SVG, PDF or PNG by the ending of its name, and return the path.

    The file appears whole or not at all; a file of the same name is replaced.

    Raises
    ------
    CallError : the ending is none of the three
    OSError : the place cannot be written
    """
    target = path_of(path)
    content = drawing.content(target.suffix.lower().removeprefix("."), dpi)
    with whole_file(target) as out:
        out.write(content)
    return target
