"""The page of a graphical differentiation or integration: both diagrams true to scale, chords, pole and its lines."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from graphkin.drawing import Drawing
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Polyline, Primitive, Run, Stroke, Text
from graphkin.drawing.ink.symbols import POINTER, arrowhead
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.piece import Piece, layer_groups
from graphkin.drawing.text import fitted, plain, rich, symbol, wrapped
from graphkin.solver import DriverRange
from graphkin.study.driver_axis import number, title_of
from graphkin.study.graphical import Array, Chords, Ordinate
from graphkin.words import Phrase, say, word

__all__ = ["chords_page", "chords_table", "markup_of"]

WIDTH, MARGIN = 210.0, 10.0
ORIGIN = 52.0  # mm from the left edge: room for the pole
ROOM = 7.0  # above and below a diagram
GAP = 16.0
CURVE, EXACT = Stroke(0.5), Stroke(0.25, (2.4, 1.0), "#b0470b")
CHORD = Stroke(0.25, (), "#0b62a5")
RAY, ACROSS = Stroke(0.13, (), "#0b62a5"), Stroke(0.1, (), "#909090")
AXIS, TICK = Stroke(0.25), 1.2
PARTS = 6  # of an interval, in a curve through its ends
_GREEK = {"theta": "θ", "omega": "ω", "alpha": "α"}


def markup_of(one: Ordinate) -> str:
    """The letter of a quantity: ``θ_{4}``, ``s_{61}``, ``v_{Cx}``."""
    kind, _, rest = one.name.partition("_")
    return f"{_GREEK.get(kind, kind)}_{{{rest.replace('/', '').replace('.', '').replace('@', '')}}}"


def _per_mm(unit: str) -> str:
    return f"({unit})/mm" if "/" in unit else f"{unit}/mm"


def chords_page(chords: Chords, reach: DriverRange, language: str) -> Drawing:
    """Draw it.  One mm of the file is one mm on paper, so that what a ruler measures times the scale is the value."""
    scene = reach.scene
    of_given, of_result = scene.units.of(chords.given.measure), scene.units.of(chords.result.measure)
    given, result = markup_of(chords.given), markup_of(chords.result)
    title = say(Phrase(f"graphical {chords.way}", (f"${result}$", f"${given}$")), language)
    per_y, per_found = of_given.of(chords.per_y), of_result.of(chords.per_found)
    scales = (
        f"$μ_{{{given[0]}}}$ = {number(per_y)} {_per_mm(of_given.written)}",
        f"$μ_{{t}}$ = {number(chords.per_x)} s/mm", f"$H$ = {number(chords.pole)} mm",
        f"$μ_{{{result[0]}}}$ = {number(per_found)} {_per_mm(of_result.written)}",
    )  # fmt: skip
    facts = [",  ".join(scales), say(Phrase(f"graphical {chords.way} off", (f"{100 * chords.off:.2g}",)), language)]
    words: list[Primitive] = [
        Text(complex(MARGIN, 15.0), rich(title, 4.6, bold=True), classes=("heading",)),
        Text(complex(MARGIN, 20.5), fitted(title_of(scene, language), 3.2, WIDTH - 2 * MARGIN)),
    ]
    y = 22.0
    for fact in facts:
        for runs in wrapped(fact, 3.0, WIDTH - 2 * MARGIN):
            y += 4.4
            words.append(Text(complex(MARGIN, y), runs))
    exact = chords.exact / chords.per_found
    upper, lower = (chords.y, np.concatenate([chords.found, exact]))
    top = complex(ORIGIN, y + ROOM + 8.0 + max(0.0, float(upper.max())))
    middle = top.imag + max(0.0, -float(upper.min())) + ROOM
    bottom = complex(ORIGIN, middle + GAP + max(0.0, float(lower.max())))
    end = bottom.imag + max(0.0, -float(lower.min())) + ROOM
    drawn = [*_axes(chords, top, chords.y, given, reach), *_axes(chords, bottom, lower, result, reach)]
    thin: list[Primitive] = []
    if chords.way == "derivative":
        _derivative(chords, top, bottom, drawn, thin)
    else:
        _integral(chords, top, bottom, drawn, thin)
    solved = tuple(bottom + complex(x, -v) for x, v in zip(chords.places, exact, strict=True))
    drawn.append(Group((Polyline(_smooth(solved), EXACT),), id="exact", classes=("exact",)))
    foot = complex(MARGIN, end + 8.0)
    words += _legend(foot, chords, language)
    words += check_bar(complex(WIDTH - MARGIN - 50.0, end + 14.0), rich(word("check bar", language), 2.5))
    page = Piece({"construction": tuple(thin), "answers": tuple(drawn), "labels": tuple(words)})
    return Drawing(
        WIDTH, end + 20.0, layer_groups(page), f"{title.replace('$', '')}: {title_of(scene, language)}",
        " ".join(fact.replace("$", "") for fact in facts), language,
        {"scene": scene.name, "units": scene.units.length, "given": chords.given.name, "result": chords.result.name,
         "pole": chords.pole, "scales": {"given": per_y, "time": chords.per_x, "result": per_found}},
    )  # fmt: skip


def chords_table(chords: Chords, reach: DriverRange) -> bytes:
    """What comes out, as CSV."""
    scene, driver = reach.scene, reach.driver
    share = chords.places / chords.x[-1]
    nodes = np.interp(share, [0.0, 1.0], [chords.at[0], chords.at[-1]])
    if chords.way == "integral":  # ordinates stand in the middles
        half = (chords.at[1] - chords.at[0]) / 2
        nodes = np.interp(share, [0.0, 1.0], [chords.at[0] - half, chords.at[-1] + half])
    values = reach.value(nodes)
    unit = scene.unit_of(driver)
    return chords.table(scene, driver.key, np.round(unit.of(values), 9), unit.text).csv().encode("utf-8-sig")


def _axes(chords: Chords, origin: complex, values: Array, letter: str, reach: DriverRange) -> list[Primitive]:
    wide, high, low = float(chords.x[-1]), max(0.0, float(values.max())), max(0.0, -float(values.min()))
    parts: list[Primitive] = []
    for start, tip in ((origin, origin + wide + 8.0), (origin + 1j * low, origin - 1j * (high + 6.0))):
        head = arrowhead(tip, tip - start, POINTER.head_length, POINTER.head_width, strokes.BLACK)
        parts += [Line(start, tip, AXIS, 2.0), head]
    n, below = len(chords.x) - 1, origin.imag + low + 4.2  # no curve runs there
    step = next(k for k in (1, 2, 3, 4, 6, 12, 24, n) if 144.0 / n * k >= 5.5 or k == n)
    for k, x in enumerate(chords.x):
        at = origin + x
        parts.append(Line(at, at + 1j * TICK * (1.0 if k % step else 1.6), AXIS))
        if k and k % step == 0:
            parts.append(Text(complex(at.real, below), plain(str(k), 2.2), "middle", classes=("label",)))
    parts.append(Text(origin - 1j * (high + 7.5), symbol(letter, 3.5), "middle", classes=("label",)))
    parts.append(Text(origin + wide + 9.0 + 1.0j, symbol("t", 3.5), classes=("label",)))
    return [Group(tuple(parts), classes=("axes",))]


def _pole(chords: Chords, origin: complex, thin: list[Primitive]) -> complex:
    """The pole before the ordinate axis, with its distance."""
    pole = origin - chords.pole
    thin += [Line(pole, origin, AXIS), Circle(pole, 0.7, "#ffffff", strokes.OUTLINE)]
    thin.append(Text(pole - 1.8 + 1.0j, symbol("P", 3.5), "end", classes=("label",)))
    above = pole - 1j * (max(0.0, float(chords.rays.max())) + 3.0)
    thin += _dimensioned(above, above + chords.pole, rich(f"$H$ = {number(chords.pole)}", 2.4))
    for tall in chords.rays:
        thin.append(Line(pole, origin - 1j * float(tall), RAY))
    return pole


def _dimensioned(start: complex, end: complex, words: tuple[Run, ...]) -> list[Primitive]:
    """A level dimension line with its value above it."""
    ends = ((start, end), (end, start))
    heads = [arrowhead(tip, tip - tail, POINTER.head_length, POINTER.head_width, strokes.BLACK) for tail, tip in ends]
    bars = [Line(z - 1.2j, z + 1.2j, strokes.DIMENSION) for z in (start, end)]
    middle = (start + end) / 2 - 1.0j
    return [Line(start, end, strokes.DIMENSION), *bars, *heads, Text(middle, words, "middle", classes=("label",))]


def _derivative(chords: Chords, top: complex, bottom: complex, drawn: list[Primitive], thin: list[Primitive]) -> None:
    nodes = tuple(top + complex(x, -v) for x, v in zip(chords.x, chords.y, strict=True))
    thin += [Group((Line(a, b, CHORD),), id=f"chord-{k}", classes=("chord",))
             for k, (a, b) in enumerate(pairwise(nodes), 1)]  # fmt: skip
    drawn += [Polyline(_smooth(nodes), CURVE), *(Circle(z, 0.45, "#000000") for z in nodes)]
    _pole(chords, bottom, thin)
    ends = tuple(bottom + complex(x, -v) for x, v in zip(chords.middles, chords.found, strict=True))
    thin += [Line(complex(bottom.real, z.imag), z, ACROSS) for z in ends]
    thin += [Line(complex(z.real, top.imag), z, ACROSS) for z in ends]
    drawn.append(Group((Polyline(_smooth(ends), CURVE),), id="result", classes=("result",)))
    drawn += [Circle(z, 0.6, "#ffffff", strokes.OUTLINE) for z in ends]


def _integral(chords: Chords, top: complex, bottom: complex, drawn: list[Primitive], thin: list[Primitive]) -> None:
    ends = tuple(top + complex(x, -v) for x, v in zip(chords.middles, chords.y, strict=True))
    drawn += [Polyline(_smooth(ends), CURVE), *(Circle(z, 0.45, "#000000") for z in ends)]
    _pole(chords, top, thin)
    thin += [Line(complex(top.real, z.imag), z, ACROSS) for z in ends]
    thin += [Line(z, complex(z.real, top.imag), ACROSS) for z in ends]
    nodes = tuple(bottom + complex(x, -v) for x, v in zip(chords.x, chords.found, strict=True))
    thin += [Group((Line(a, b, CHORD),), id=f"chord-{k}", classes=("chord",))
             for k, (a, b) in enumerate(pairwise(nodes), 1)]  # fmt: skip
    drawn.append(Group((Polyline(_smooth(nodes), CURVE),), id="result", classes=("result",)))
    drawn += [Circle(z, 0.6, "#ffffff", strokes.OUTLINE) for z in nodes]


def _smooth(points: tuple[complex, ...]) -> tuple[complex, ...]:
    """A curve through points, as one draws it with a French curve: in each the slope of its neighbours' chord."""
    z = np.array(points)
    if len(z) < 3:
        return points
    slopes = np.gradient(z)
    u = np.linspace(0.0, 1.0, PARTS, endpoint=False)[:, None]
    a, b, s, t = z[:-1], z[1:], slopes[:-1], slopes[1:]
    curve = (1 + 2 * u) * (1 - u) ** 2 * a + u * (1 - u) ** 2 * s + u * u * (3 - 2 * u) * b + u * u * (u - 1) * t
    return (*curve.T.ravel().tolist(), points[-1])


def _legend(at: complex, chords: Chords, language: str) -> list[Primitive]:
    entries = ((CURVE, f"by {chords.way}"), (CHORD, "chords"), (EXACT, "analytic curve"))
    parts: list[Primitive] = []
    x = at.real
    for stroke, key in entries:
        parts.append(Line(complex(x, at.imag - 0.9), complex(x + 9.0, at.imag - 0.9), stroke))
        parts.append(Text(complex(x + 11.0, at.imag), rich(word(key, language), 2.8)))
        x += 46.0
    return parts
