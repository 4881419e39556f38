"""The figure of a cam: the displacement diagram divided and numbered, the cam by inversion at its true scale, the
steps, the pressure angle at each division, and what is found of it."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace

from graphkin.account.headings import number, once, term
from graphkin.construction.cam_sheet import CamDivision, CamSheet, cam_sheet
from graphkin.construction.scales import Extent, fitting_scale
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import STEP, WORKED, Block, panel, picture, row, steps, table, worked_page
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Group,
    Line,
    Polygon,
    Polyline,
    Primitive,
    Stroke,
    Text,
    on_page,
)
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, moved_piece
from graphkin.drawing.text import plain, rich, runs_width, symbol
from graphkin.drawing.write.drawing import Drawing
from graphkin.scene.cams import LawCam, SlidingFollower, SwingingFollower
from graphkin.scene.laws import TURN
from graphkin.scene.model import Mechanism
from graphkin.version import __version__
from graphkin.words import Phrase, languages, say, word

__all__ = ["FIGURES", "cam_figure", "cam_given", "cam_pictures", "scaled_cam"]

GUTTER = 8.0  # mm between columns of the table
PANEL = (150.0, 140.0)
"""mm that the cam may fill."""
SMALL = 2.4
LONG = 180.0
"""mm for a turn of the cam in the diagram."""
HIGH = (16.0, 40.0)
"""mm that the lifts take there."""
PAST = 5.0
"""mm that a ray goes on beyond what it carries."""
PITCH, THIN, RAY = Stroke(0.25, (5.0, 1.0, 0.6, 1.0)), Stroke(0.13), Stroke(0.13)
ROWS = 10


def scaled_cam(scene: Mechanism, cam: LawCam) -> CamSheet:
    """The construction of a cam at the scale of its figure: as the scene wishes, or the finest of the series at which
    the cam fits the page."""
    if scene.question.sheet.length_scale:
        return cam_sheet(cam, scene.question.sheet.length_scale * 1e-3)
    natural = cam_sheet(cam, cam.base / 50.0)
    far = [*natural.profile, *natural.pitch, *(d.at.point for d in natural.divisions)]
    far += [d.at.line for d in natural.divisions] if isinstance(cam.motion, SwingingFollower) else []
    box = Box.around(far)
    room = PANEL[0] - 2 * PAST - 8.0, PANEL[1] - 2 * PAST - 8.0
    per = scene.units.metres
    return cam_sheet(cam, fitting_scale(Extent(box.width, box.height), room, natural.scale / per) * per)


def cam_figure(scene: Mechanism, sheet: CamSheet, told: Sequence[Phrase], language: str) -> Drawing:
    """Draw a cam on a page of its own.

    Parameters
    ----------
    told : what is found of it
    language : "en", "zh" or "both"
    """
    first, every = languages(language)[0], languages(language)
    parts = [
        _diagram(scene, sheet, language), _cam(scene, sheet),
        *(steps(enumerate((say(step, each) for step in sheet.steps), 1)) for each in every),
        _table(scene, sheet, language),
    ]  # fmt: skip
    spoken = " ".join([*(say(step, first) + "." for step in sheet.steps), *(say(found, first) for found in told)])
    facts = {"units": {"length": scene.units.length, "paper": "mm"},
             "scales": {"length": sheet.scale / scene.units.metres}, "instrument": "exact"}  # fmt: skip
    return worked_page(
        (scene.question.title_in(each) or scene.name for each in every), _given(scene, sheet.cam, language), parts,
        told, _scale(scene, sheet), title="cam figure", said=spoken, language=language,
        metadata=_facts(scene, sheet) | facts,
    )  # fmt: skip


def _scale(scene: Mechanism, sheet: CamSheet) -> str:
    return f"$μ_{{l}}$ = {number(sheet.scale / scene.units.metres)} {scene.units.length}/mm"


def _facts(scene: Mechanism, sheet: CamSheet) -> dict[str, object]:
    return {"figure": "cam", "scene": scene.name, "cam": sheet.cam.link, "graphkin": __version__}


def cam_pictures(scene: Mechanism, sheet: CamSheet, language: str, begun: bool = False) -> tuple[Drawing, Drawing]:
    """The displacement diagram and the cam, each by itself; ``begun`` leaves out all that is to be found."""
    facts = _facts(scene, sheet)
    return (picture(_diagram(scene, sheet, language, begun), "cam diagram", language, facts),
            picture(_cam(scene, sheet, begun), "cam figure", language, facts, _scale(scene, sheet)))  # fmt: skip


def cam_given(scene: Mechanism, cam: LawCam, language: str) -> str:
    """What is given of a cam, the pieces of its law among it, in one language."""
    swings = isinstance(cam.motion, SwingingFollower)
    unit = "°" if swings else f" {scene.units.length}"
    told = []
    for piece in cam.law.pieces:
        said = f"{number(math.degrees(piece.start))}°–{number(math.degrees(piece.end))}°"
        way = _lift(scene, cam, piece.high - piece.low)
        law = term(f"law {piece.by}", language, piece.by) if piece.by else term("law dwell", language)
        told.append(f"{said} {law}" + (f" {'+' if way > 0 else '−'}{number(abs(way))}{unit}" if piece.by else ""))
    comma = word("list comma", language)
    return f"{_given(scene, cam, language)}{'；' if comma == '，' else '; '}{comma.join(told)}"


def _given(scene: Mechanism, cam: LawCam, language: str) -> str:
    """Base circle, roller, offset, and the law, as they are given."""
    unit, metres = scene.units.length, scene.units.metres
    parts = [f"$r_{{0}}$ = {number(cam.base / metres)} {unit}"]
    if cam.roller:
        parts.append(f"$r_{{r}}$ = {number(cam.roller / metres)} {unit}")
    if isinstance(cam.motion, SlidingFollower):
        if cam.motion.offset:
            parts.append(f"$e$ = {number(cam.motion.offset / metres)} {unit}")
    else:
        parts += [f"$l$ = {number(cam.motion.arm / metres)} {unit}",
                  f"$a$ = {number(abs(cam.axis - cam.motion.centre) / metres)} {unit}"]  # fmt: skip
    kind = term("cam flat" if cam.flat else "cam roller" if cam.roller else "cam edge", language)
    sense = "counter-clockwise" if cam.sense > 0 else "clockwise"
    turns = once(say(Phrase("cam turns", (word(sense, each),)), each) for each in languages(language))
    return f"{kind}; {',  '.join(parts)}; {turns}"


def _lift(scene: Mechanism, cam: LawCam, lift: float) -> float:
    """A lift in the scene's unit, or degrees."""
    return math.degrees(lift) if isinstance(cam.motion, SwingingFollower) else lift / scene.units.metres


def _diagram(scene: Mechanism, sheet: CamSheet, language: str, begun: bool = False) -> Block:
    """The displacement diagram; only ``begun``, its axes with the pieces of the law."""
    cam, law = sheet.cam, sheet.cam.law
    span = _lift(scene, cam, law.greatest - law.least) or 1.0
    own = (law.greatest - law.least) / sheet.scale
    same = isinstance(cam.motion, SlidingFollower) and HIGH[0] <= own <= HIGH[1]
    per = span / own if same else fitting_scale(Extent(span, span), (HIGH[1], HIGH[1]), 1.0)
    left, floor = 5.0, span / per + 6.0
    low = _lift(scene, cam, law.least)

    def at(degree: float, lift: float) -> complex:
        return complex(left + LONG * degree / TURN, floor - (_lift(scene, cam, lift) - low) / per)

    curve: list[complex] = []
    for part in law.parts:
        count = max(2, math.ceil(120 * (part.end - part.start) / TURN))
        degrees = [part.start + (part.end - part.start) * k / count for k in range(count + 1)]
        curve += [at(degree, part.at(degree).lift) for degree in degrees]
    axes = [Line(complex(left, floor), complex(left + LONG + 5.0, floor), strokes.DIMENSION),
            Line(complex(left, floor), complex(left, floor - span / per - 5.0), strokes.DIMENSION)]  # fmt: skip
    rules: list[Primitive] = []
    labels: list[Primitive] = []
    for d in () if begun else (*sheet.divisions, _closing(sheet)):
        foot = at(d.degree, law.least)
        rules.append(Line(foot, at(d.degree, d.lift), THIN))
        if d.degree < TURN:
            labels.append(Text(foot + 3.2j, plain(str(d.number), SMALL), "middle", classes=("cell",)))
    for piece in law.pieces:
        start, end = at(piece.start, law.least) + 6.8j, at(piece.end, law.least) + 6.8j
        said = f"{number(math.degrees(piece.end - piece.start))}°"
        name = term(f"law {piece.by}", language, piece.by) if piece.by else term("law dwell", language)
        text = rich(f"{said} {name}", SMALL)
        short = rich(said, SMALL)
        runs = text if runs_width(text) <= (end - start).real - 2.0 else short
        labels.append(Text((start + end) / 2 + 1.0j, runs, "middle", classes=("cell",)))
        rules += [Line(z - 1.4j, z + 1.4j, THIN) for z in (start, end)]
    unit = "°" if isinstance(cam.motion, SwingingFollower) else f" {scene.units.length}"
    h = "ψ" if unit == "°" else "h"
    scale = f"$μ_{{φ}}$ = {number(360.0 / LONG)}°/mm,  $μ_{{s}}$ = {number(per)}{unit}/mm"
    scale += f",  ${h}$ = {number(span)}{unit}"
    labels.append(Text(complex(left, floor + 13.0), rich(scale, SMALL + 0.4), classes=("cell",)))
    labels.append(Text(complex(left + 1.0, floor - span / per - 3.0), symbol("ψ" if unit == "°" else "s", STEP)))
    labels.append(Text(complex(left + LONG + 5.5, floor - 1.0), symbol("φ", STEP)))
    found = () if begun else (Polyline(tuple(curve), strokes.LINK),)
    shape = Group((*axes, *rules, *found), id="displacement", classes=("diagram",))
    return Block(Piece({"construction": (shape,), "labels": tuple(labels)}), floor + 14.0, WORKED)


def _closing(sheet: CamSheet) -> CamDivision:
    first = sheet.divisions[0]
    return CamDivision(0, TURN, first.lift, first.at, first.pressure)


def _cam(scene: Mechanism, sheet: CamSheet, begun: bool = False) -> Block:
    """The cam with all that finds it; only ``begun``, the circles and the follower where it starts."""
    cam = sheet.cam
    colour, other = strokes.colour_of_link(scene, cam.link), strokes.colour_of_link(scene, cam.follower)
    lines: list[Primitive] = [Circle(0j, sheet.base, stroke=THIN)]
    if sheet.offset > 0.3:
        lines.append(Circle(0j, sheet.offset, stroke=THIN))
    if cam.roller:
        lines.append(Circle(0j, sheet.base - sheet.roller, stroke=THIN))
    labels: list[Label] = []
    far = max(abs(d.at.point) for d in sheet.divisions)
    shown = [] if begun else _shown(sheet)
    for d in shown:
        part, end = _ray(sheet, d, far)
        lines += part
        labels.append(Label.of(plain(str(d.number), SMALL), on_page(end), f"label-division-{d.number}",
                               toward=(cmath.phase(end),), rank=1))  # fmt: skip
    if cam.flat:
        half = 0.35 * sheet.base
        faces = [(d.at.point - half * 1j * d.at.way, d.at.point + half * 1j * d.at.way) for d in shown]
        faces = [_over(d, face) for d, face in zip(shown, faces, strict=True)]
        lines += [Line(on_page(a), on_page(b), strokes.CONSTRUCTION) for a, b in faces]
    else:
        lines += [Circle(on_page(d.at.point), sheet.roller, stroke=THIN) for d in shown if cam.roller]
        if cam.roller and not begun:
            lines.append(Polyline(tuple(map(on_page, sheet.pitch)), PITCH))
        for d in shown:
            lines.append(Line(on_page(d.at.contact), on_page(d.at.point + 6.0 * d.at.normal), strokes.DIRECTION))
    profile = Polygon(tuple(map(on_page, sheet.profile)), strokes.tint(colour), Stroke(0.7, (), colour))
    start = sheet.divisions[0].at
    follower: list[Primitive] = []
    if cam.roller:
        follower.append(Circle(on_page(start.point), sheet.roller, stroke=strokes.LINK.coloured(other)))
    if cam.flat:
        a, b = _over(sheet.divisions[0], (start.point - 8j * start.way, start.point + 8j * start.way))
        follower.append(Line(on_page(a), on_page(b), strokes.LINK.coloured(other)))
    end = start.line
    if isinstance(cam.motion, SlidingFollower):
        end = start.point + (far - abs(start.point) + 12.0) * start.way
    follower.append(Line(on_page(start.point), on_page(end), strokes.LINK.coloured(other)))
    if isinstance(cam.motion, SwingingFollower):
        follower += symbols.fixed_pivot(on_page(start.line))
    elif not cam.flat:
        follower += symbols.pin(on_page(start.point), other)
    axis = Group(tuple(symbols.fixed_pivot(0j)), id=f"point-{cam.point}", classes=("point",))
    named = [(cam.point, 0j)]
    if isinstance(cam.motion, SwingingFollower):
        named += [(cam.motion.pivot, start.line), (cam.motion.tip, start.point)]
    for name, z in named:
        labels.append(Label.of(symbol(name), on_page(z), f"label-point-{name}"))
    turn = _sense(sheet)
    piece = Piece({
        "mechanism": (Group(() if begun else (profile,), id=f"cam-{cam.link}", classes=("cam",)),
                      Group(tuple(follower), id=f"link-{cam.follower}", classes=("link",)), axis),
        "construction": (Group((*lines, *turn), id="inversion", classes=("strokes",)),),
    }, tuple(labels))  # fmt: skip
    # what finds the cam lies over its tint
    piece = Piece({"construction": (*piece.layers["mechanism"][:1], *piece.layers["construction"]),
                   "mechanism": piece.layers["mechanism"][1:]}, piece.labels)  # fmt: skip
    box = ink_box(piece.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    box = box.joined(Box.around(map(on_page, sheet.profile))).grown(6.0)

    def drawn(room: Box) -> Piece:
        origin = room.centre - box.centre
        return moved_piece(with_labels(piece, room.moved(-origin)), origin)

    return panel(WORKED, box.height, drawn)


def _shown(sheet: CamSheet) -> list[CamDivision]:
    """The divisions that are drawn: neighbours keep a millimetre and a half from each other at the base circle."""
    found: list[CamDivision] = []
    for d in sheet.divisions:
        if all(abs(d.at.base - other.at.base) >= 1.5 for other in found):
            found.append(d)
    return found


def _over(d: CamDivision, face: tuple[complex, complex]) -> tuple[complex, complex]:
    """A face that reaches beyond its contact."""
    across = 1j * d.at.way
    ends = [((z - d.at.point) * across.conjugate()).real for z in (*face, d.at.contact)]
    low, high = min(ends[0], ends[2] - 3.0), max(ends[1], ends[2] + 3.0)
    return d.at.point + low * across, d.at.point + high * across


def _ray(sheet: CamSheet, d: CamDivision, far: float) -> tuple[list[Primitive], complex]:
    """What carries a division, turned back about the cam, and where its number stands."""
    motion = sheet.cam.motion
    if isinstance(motion, SlidingFollower):
        beyond = math.sqrt(max((far + sheet.roller + PAST) ** 2 - sheet.offset**2, 0.0))
        end = d.at.line + beyond * d.at.way
        return [Line(on_page(d.at.line), on_page(end), RAY)], end
    pivot = d.at.line
    arm = abs(d.at.point - pivot)
    angles = [cmath.phase(z - pivot) for z in (d.at.base, d.at.point)]
    middle = angles[0] + math.remainder(angles[1] - angles[0], TURN) / 2
    half = abs(math.remainder(angles[1] - angles[0], TURN)) / 2 + 3.0 / arm
    return [Arc(on_page(pivot), arm, middle - half, middle + half, RAY), Circle(on_page(pivot), 0.5, stroke=RAY)], pivot


def _sense(sheet: CamSheet) -> list[Primitive]:
    """The sense in which the cam turns."""
    radius = max(5.0, 0.3 * sheet.base)
    return list(symbols.sense_arc(0j, radius, 0.6, sheet.cam.sense, math.radians(60)))


def _table(scene: Mechanism, sheet: CamSheet, language: str) -> Block:
    """Number, cam degree, lift and pressure angle of each division, in columns beside each other."""
    swings = isinstance(sheet.cam.motion, SwingingFollower)
    unit = "°" if swings else scene.units.length
    heads = ["", "$φ$ (°)", f"${'ψ' if swings else 's'}$ ({unit})", "$α$ (°)"]
    columns = -(-len(sheet.divisions) // ROWS)
    count = -(-len(sheet.divisions) // columns)
    cells = [[str(d.number), f"{math.degrees(d.degree):.2f}", f"{_lift(scene, sheet.cam, d.lift):.3f}",
              f"{math.degrees(d.pressure):.2f}"] for d in sheet.divisions]  # fmt: skip
    wide = (WORKED - GUTTER * (columns - 1)) / columns
    widths = [share * wide for share in (0.16, 0.26, 0.32, 0.26)]
    tables = (table([heads], cells[k : k + count], widths, layer="answers") for k in range(0, len(cells), count))
    return row(*tables, gap=GUTTER)


def cams_figure(
    scene: Mechanism, cams: Sequence[tuple[CamSheet, Sequence[Phrase]]], *, language: str | None = None,
    convention: str | None = None,
) -> Drawing | None:  # fmt: skip
    """A page for each cam; None where there is none.

    Parameters
    ----------
    cams : what was drawn of each, and what is found of it
    language : "en", "zh" or "both"; the scene's own if None
    convention : says nothing here, since the letters of cams are those of all books
    """
    pages = [cam_figure(scene, sheet, told, language or scene.question.sheet.language) for sheet, told in cams]
    return replace(pages[0], further=tuple(pages[1:])) if pages else None


FIGURES = (Figure("cam", cams_figure, "cams", lambda scene: bool(scene.cams), place=9),)
