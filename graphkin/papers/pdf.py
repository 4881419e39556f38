"""Documents as typeset PDF, with the extra ``pdf`` (Typst): figures at true scale, page numbers, the same bytes every
time.

Typst stays behind this module.  The template is fixed; the document is handed to it as data, so that no word of a
scene is ever read as a command.
"""

from __future__ import annotations

import io
import json
import math
import re
import warnings
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from importlib.resources import files
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, TypeAlias

from graphkin.drawing.font import FAMILY, FOLDER
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polygon, Primitive, Scan, Text, walk
from graphkin.drawing.text import Atom, is_italic, parsed, start_runs
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers.blocks import Beside, Document, Leaf, Picture, Plate, Said, clean
from graphkin.papers.html import document_page
from graphkin.papers.layout import COLUMN_GAP, HALVES_GAP, MANY_ROWS, Row, lines_of, pages_of
from graphkin.words import word

if TYPE_CHECKING:
    import typst

__all__ = ["can_join", "can_typeset", "one_after_another", "papers_as", "pdf"]

Data: TypeAlias = dict[str, object]
"""What the template reads, as JSON holds it."""

SAG = 0.002  # mm: how far a chord may lie off its arc
CHINESE = (
    "Noto Serif CJK SC", "Noto Serif SC", "Source Han Serif SC", "Source Han Serif CN", "Songti SC", "SimSun", "STSong",
    "Noto Serif CJK JP", "Noto Sans CJK SC", "Source Han Sans SC", "Noto Sans SC", "PingFang SC", "Microsoft YaHei",
    "SimHei", "WenQuanYi Zen Hei", "WenQuanYi Micro Hei", "Droid Sans Fallback",
)  # fmt: skip
SIGNS = ("DejaVu Sans Mono", "New Computer Modern")  # come with Typst: for signs that no other face has


def can_typeset() -> bool:
    """Whether the extra ``pdf`` is installed."""
    return find_spec("typst") is not None


def can_join() -> bool:
    """Whether several PDFs can be made one: the extra ``pdf`` has a library for it."""
    return find_spec("pypdf") is not None


def pdf(document: Document) -> bytes:
    """The document as a PDF on its paper, without a date.

    Raises
    ------
    ImportError : the extra ``pdf`` is not installed (see `can_typeset`)
    """
    import typst

    names, fonts = _fonts()
    template = files("graphkin.papers").joinpath("template.typ").read_bytes()
    frame = {
        "title": clean(document.title),
        "languages": list(document.languages),
        "page": " / ".join(word("page of", each) for each in document.languages),
        "fonts": names,
        "paper": [document.paper.width, document.paper.height],
        "columns": COLUMN_GAP,
        "halves": HALVES_GAP,
        "many": MANY_ROWS,
    }

    def measured(leaves: Sequence[tuple[Leaf, float | None]]) -> list[tuple[float, float]]:
        asked = [{"block": _block(leaf, bare=True), "width": width or 0} for leaf, width in leaves]
        told = typst.query(
            template, "<sizes>", field="value", one=True, format="json", font_paths=fonts,
            sys_inputs=_inputs({**frame, "measure": asked}),
        )  # fmt: skip
        return [(wide, high) for wide, high in json.loads(told)]

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pages = [[[_row(row) for row in half] for half in page] for page in pages_of(document, measured)]
        made = typst.compile(
            template, font_paths=fonts, format="pdf", timestamp=0, sys_inputs=_inputs({**frame, "pages": pages})
        )
    assert isinstance(made, bytes)
    return made


def papers_as(formats: Collection[str], documents: Mapping[str, Document]) -> dict[str, bytes]:
    """Documents as files by name: HTML, and PDF where it can be typeset."""
    made: dict[str, bytes] = {}
    if "html" in formats:
        made |= {f"{name}.html": document_page(document).encode() for name, document in documents.items()}
    if "pdf" in formats and can_typeset():
        made |= {f"{name}.pdf": pdf(document) for name, document in documents.items()}
    return made


def _inputs(data: Data) -> dict[str, str]:
    return {"document": json.dumps(data, ensure_ascii=False, allow_nan=False)}


def one_after_another(papers: Sequence[bytes]) -> bytes:
    """Several PDFs as one, to be printed at once.

    Raises
    ------
    ImportError : the extra ``pdf`` is not installed (see `can_join`)
    """
    from pypdf import PdfWriter

    whole = PdfWriter()
    for paper in papers:
        whole.append(io.BytesIO(paper))
    made = io.BytesIO()
    whole.write(made)
    return made.getvalue()


@lru_cache(maxsize=1)
def _fonts() -> tuple[list[str], typst.Fonts]:
    """Names of the faces in the order of liking, and the faces found, read once."""
    import typst

    fonts = typst.Fonts(font_paths=[str(FOLDER)])
    known = set(fonts.families())
    return [name for name in (FAMILY, *CHINESE, *SIGNS) if name in known], fonts


def _block(block: Leaf, bare: bool = False) -> Data:
    """A leaf as the template reads it, its fields by name; ``bare`` without the ink of figures, where only the size
    counts."""
    if isinstance(block, Beside):
        lines = [{"gap": gap, "block": _block(line)} for gap, line in lines_of(block)]
        return {"kind": "Beside", "lines": lines, "picture": _block(block.picture)}
    if bare and isinstance(block, Picture):
        block = replace(block, drawing=replace(block.drawing, children=()))
    elif bare and isinstance(block, Plate):
        block = replace(block, svg="")
    told = {name: FORMS[name](value) if name in FORMS else value for name, value in vars(block).items()}
    return {"kind": type(block).__name__, **told}


def _row(row: Row) -> Data:
    left, right = ([_block(piece.block) for piece in side] for side in (row.left, row.right))
    return {"gap": row.gap, "left": left, "right": right, "height": row.height}


def _said(said: Said) -> list[tuple[str, list[str | list[Data]]]]:
    return [(language, _words(markup)) for language, markup in said]


def _words(markup: str) -> list[str | list[Data]]:
    """Stretches of words, and symbols as lists of atoms."""
    return [clean(part) if isinstance(part, str) else _atoms(part) for part in parsed(markup)]


def _atoms(atoms: tuple[Atom, ...]) -> list[Data]:
    return [
        {"text": clean(atom.text), "italic": is_italic(atom.text), "sub": _atoms(atom.sub), "sup": _atoms(atom.sup)}
        for atom in atoms
    ]


def _drawing(drawing: Drawing) -> Data:
    things = [inked for thing in walk(drawing.children) for inked in _ink(thing)]
    alt = clean(re.sub(r"\s+", " ", f"{drawing.title}. {drawing.desc}").strip())
    return {"width": _mm(drawing.width), "height": _mm(drawing.height), "alt": alt, "things": things}


def _ink(thing: Primitive) -> list[Data]:
    if isinstance(thing, Group | Scan):  # a handout has no picture under it
        return []
    if isinstance(thing, Text):
        return [
            {
                "kind": "text", "at": (_mm(run.x), _mm(run.y)), "size": _mm(run.size), "italic": run.italic,
                "bold": run.bold, "colour": thing.colour, "text": clean(run.text),
            }
            for run in start_runs(thing)
        ]  # fmt: skip
    pen = thing.stroke
    stroke = pen and {"width": pen.width, "dash": pen.dash, "colour": pen.colour}
    if isinstance(thing, Line):
        return [{"kind": "line", "points": _pairs((thing.start, thing.inked_end)), "stroke": stroke}]
    if isinstance(thing, Circle):
        centre = (_mm(thing.centre.real), _mm(thing.centre.imag))
        return [{"kind": "circle", "at": centre, "radius": _mm(thing.radius), "fill": thing.fill, "stroke": stroke}]
    if isinstance(thing, Polygon):
        return [{"kind": "polygon", "points": _pairs(thing.points), "fill": thing.fill, "stroke": stroke}]
    points = _chords(thing) if isinstance(thing, Arc) else thing.points
    return [{"kind": "polyline", "points": _pairs(points), "stroke": stroke}]


def _chords(arc: Arc) -> tuple[complex, ...]:
    """An arc as chords that lie less than ``SAG`` off it."""
    step = 2 * math.acos(max(0.0, 1 - SAG / max(arc.radius, 2 * SAG)))
    count = max(2, math.ceil(abs(arc.end - arc.start) / step))
    return tuple(arc.at(arc.start + (arc.end - arc.start) * i / count) for i in range(count + 1))


def _pairs(points: tuple[complex, ...]) -> list[tuple[float, float]]:
    return [(_mm(z.real), _mm(z.imag)) for z in points]


def _mm(value: float) -> float:
    return round(value, 4)


FORMS: Mapping[str, Callable[[Any], object]] = {
    "words": _said, "caption": _said, "heads": lambda heads: [*map(_said, heads)], "width": _mm, "height": _mm,
    "names": lambda names: [*map(_said, names)], "work": lambda lines: [*map(_words, lines)], "drawing": _drawing,
    "rows": lambda rows: [[*map(_words, row)] for row in rows], "bold": sorted, "seen": clean,
}  # fmt: skip
"""The fields of blocks that are not handed to the template as they are, and what it reads instead."""
