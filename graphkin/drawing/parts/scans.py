"""What lies under a figure: the scene's picture, and scans of drawings with their lines as they were read."""

from __future__ import annotations

from graphkin.checking.scans import judge_scans
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Group, Line, Primitive, Scan, Stroke, Text, on_page
from graphkin.drawing.place.piece import Piece
from graphkin.drawing.text import plain

__all__ = ["background_piece", "scan_piece"]

READ = Stroke(0.3, (1.6, 0.8), "#c2006b")
OFF = Stroke(0.8, (1.6, 0.8), "#c2006b")


def background_piece(sheet: Sheet, origin: complex, panel: Box) -> Piece:
    """The scene's picture, cut to a panel (mm, y down) in which the world's origin lies at ``origin``."""
    under = sheet.scene.background
    if under is None:
        return Piece()
    mm = 1 / sheet.scales.length
    corner, step = (on_page(z) * mm for z in (under.corner, under.step))
    scan = Scan(origin + corner, step, under.width, under.height, under.kind, under.data, panel.corners)
    return Piece({"background": (scan,)})


def scan_piece(sheet: Sheet, diagram: DiagramName, origin: complex, panel: Box) -> Piece:
    """The scans of a figure, cut to a panel (mm, y down) in which the pole, or the world's origin, lies at ``origin``:
    the picture, if there is one, and the lines as they were read, the one that is off bold and with a name."""
    under: list[Primitive] = []
    lines: list[Primitive] = []
    for judged in judge_scans(sheet, diagram):
        scan = judged.scan
        if scan.data:
            corner, step = (on_page(z) for z in (judged.corner, judged.step))
            under.append(Scan(origin + corner, step, scan.width, scan.height, scan.kind, scan.data, panel.corners))
        for line in judged.lines:
            ends = panel.clip(origin + on_page(line.tail), origin + on_page(line.tip))
            if ends is None:
                continue
            wrong = line is judged.off
            drawn: tuple[Primitive, ...] = (Line(*ends, OFF if wrong else READ),)
            if wrong:
                at = (ends[0] + ends[1]) / 2 + 1.2 - 1.2j
                drawn += (Text(at, plain(line.name, 3.0), "start", OFF.colour, classes=("label", "off")),)
            lines.append(Group(drawn, id=f"read-{line.name.replace('/', '-').replace('@', '')}", classes=("read",)))
    return Piece({"background": tuple(under), "answers": tuple(lines)} if under or lines else {})
