"""The content of a page of a PDF, as a reader paints it."""

from __future__ import annotations

import io

from pypdf import PdfReader

MM = 25.4 / 72  # of a point


def size(pdf: bytes) -> tuple[float, float]:
    """Width and height of the first page (mm)."""
    box = PdfReader(io.BytesIO(pdf)).pages[0].mediabox
    return float(box.width) * MM, float(box.height) * MM


def painted(pdf: bytes) -> list[tuple[str, list[complex]]]:
    """The paths of the first page in the order of painting, each with what is done to it ("S" stroked, "f" filled) and
    its corners (mm from the left lower corner, y up); and the runs of text ("Tj"), each with its place."""
    found: list[tuple[str, list[complex]]] = []
    corners: list[complex] = []

    def before(operator: bytes, operands: list[object], matrix: list[float], text_matrix: list[float]) -> None:
        a, b, c, d, e, f = matrix

        def place(x: float, y: float) -> complex:
            return complex(a * x + c * y + e, b * x + d * y + f) * MM

        if operator in (b"m", b"l"):
            corners.append(place(*map(float, operands)))  # type: ignore[arg-type]
        elif operator in (b"S", b"f"):
            found.append((operator.decode(), corners[:]))
        elif operator == b"Tj":
            found.append(("Tj", [place(text_matrix[4], text_matrix[5])]))
        if operator in (b"S", b"f", b"n"):
            corners.clear()

    PdfReader(io.BytesIO(pdf)).pages[0].extract_text(visitor_operand_before=before)
    return found
