"""Mechanisms designed on the drawing board: from the task to the lengths, with ruler, compass, protractor.

Each construction is drawn at its true scale and measured; only the data of the task, and angles computed from them, are
taken as given.  Slider-crank, crank-rocker and guide bar by K after Sun Huan, Mechanical Principles, ch. 8; places of a
bar by the circles of its points, or by inversion (Hartenberg and Denavit, Kinematic Synthesis of Linkages, ch. 9). The
paper has strokes in mm, y up, in steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import singledispatch
from typing import Literal

from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, cross_arcs, cross_line_arc, direction, dot, unit
from graphkin.scene.designs import (
    BarPositionsTask,
    CrankRockerTask,
    DesignTask,
    FunctionTask,
    GuideBarTask,
    LimitsTask,
    SliderCrankTask,
)
from graphkin.words import Phrase
from graphkin.words.symbols import RichText, sign, spaced

DECIMALS = range(2, 9)
"""Of lengths (mm) from which others are reckoned, until that is true as it is written."""
SEEN = 0.05
"""Degrees between two lines that are drawn as an angle."""

LineKind = Literal["given", "construction", "direction", "limit", "mechanism"]
"""Lines that the task gives, help lines, lines of which only the direction is known, bars in other positions, and the
mechanism that is found."""


@dataclass(frozen=True)
class DesignStroke:
    """A stroke of the hand on paper.

    Parameters
    ----------
    kind : of lines (`LineKind`); or a circle, an angle, a point, or the point of a fixed pivot
    places : the ends of lines; the centre of a circle and the points near which it is drawn (none: the whole circle);
        the apex of an angle and a place on each of its legs, counter-clockwise; a point (mm)
    size : radius (mm), angle (degrees)
    name : of a point or an angle, "" without a name
    """

    kind: LineKind | Literal["circle", "angle", "point", "pivot"]
    places: tuple[complex, ...]
    size: float = 0.0
    name: str = ""


def line(kind: LineKind, *places: complex) -> DesignStroke:
    """Lines from place to place."""
    return DesignStroke(kind, places)


def fan(kind: LineKind, apex: complex, *ends: complex) -> list[DesignStroke]:
    """Lines from one place."""
    return [line(kind, apex, end) for end in ends]


def circle(centre: complex, radius: float, *near: complex) -> DesignStroke:
    """A circle, or its arcs near some points."""
    return DesignStroke("circle", (centre, *near), radius)


def angle(apex: complex, first: complex, second: complex, value: float, name: str = "") -> DesignStroke:
    """An angle (degrees) from one direction to another."""
    return DesignStroke("angle", (apex, apex + first, apex + second), value, name)


def dots(*places: complex) -> list[DesignStroke]:
    """Points that need no names."""
    return [DesignStroke("point", (at,)) for at in places]


def points(**named: complex) -> list[DesignStroke]:
    """Points with their names."""
    return [DesignStroke("point", (at,), name=name) for name, at in named.items()]


def pivots(**named: complex) -> list[DesignStroke]:
    """Fixed pivots with their names."""
    return [DesignStroke("pivot", (at,), name=name) for name, at in named.items()]


def _not_drawn(what: str, finding: str, wanted: str) -> Unsolvable:
    return Unsolvable("not drawn", Problem(what, Phrase(finding), Phrase(wanted)))


@dataclass
class DesignSheet:
    """A construction on paper, in mm, y up; it grows while it is drawn.

    Parameters
    ----------
    scale : units of the task's length for one mm
    steps : in order: each a phrase with its strokes
    lengths : measured lengths, mm on paper, by the two points of a bar ("ram": distance of its line from C)
    turned : bars found opposite to the asked angles
    """

    task: DesignTask
    scale: float
    hand: Instrument
    steps: list[tuple[Phrase, tuple[DesignStroke, ...]]] = field(default_factory=list)
    lengths: dict[str, float] = field(default_factory=dict)
    turned: list[str] = field(default_factory=list)

    @property
    def strokes(self) -> list[DesignStroke]:
        """All strokes on the paper."""
        return [stroke for _, strokes in self.steps for stroke in strokes]

    @property
    def points(self) -> dict[str, complex]:
        """The places of the named points."""
        return {s.name: s.places[0] for s in self.strokes if s.kind in ("point", "pivot") and s.name}

    def mm(self, length: float) -> float:
        """A length of the task on paper."""
        return length / self.scale

    def do(self, key: str, *strokes: DesignStroke, **gaps: object) -> None:
        """Record a step by its sentence, with its strokes."""
        self.steps.append((Phrase(key, **gaps), strokes))

    # -- acts of the hand ----------------------------------------------------------------------------------------------

    def lay_off(self, start: complex, along: complex, mm: float) -> complex:
        """Lay off a length in a direction by the set square."""
        return self.hand.point(start + self.hand.length(mm) * self.hand.direction(along))

    def lay_off_angle(self, start: complex, along: complex, mm: float) -> complex:
        """Lay off a length in a direction by the protractor."""
        return self.hand.point(start + self.hand.length(mm) * self.hand.angle(along))

    def plot(self, at: complex) -> complex:
        """A point by its coordinates."""
        return self.hand.point(complex(self.hand.length(self.mm(at.real)), self.hand.length(self.mm(at.imag))))

    def meet(self, what: str, p: complex, d: complex, q: complex, e: complex) -> complex:
        """The crossing of two lines, each through a point along a direction.  Raises Unsolvable where they are
        parallel."""
        return self.hand.crossing(what, p, d, q, e, "not drawn", "other data")

    def cut(self, what: str, p: complex, d: complex, centre: complex, radius: float) -> tuple[complex, complex]:
        """The points where a line cuts a circle, the point farther along d first.  Raises Unsolvable where it does not
        cut it."""
        crossings = cross_line_arc(p, d, centre, radius)
        if crossings is None:
            raise _not_drawn(what, "the line does not reach the circle", "other data")
        return self.hand.point(crossings[0]), self.hand.point(crossings[1])

    def bisector(self, a: complex, b: complex) -> tuple[complex, complex]:
        """A point and the direction of the perpendicular bisector, drawn by two pairs of compass arcs."""
        return self.hand.point((a + b) / 2), self.hand.direction(1j * unit(b - a))

    def measure(self, **bars: tuple[complex, complex]) -> None:
        """The lengths of bars off the paper (mm), each by its name."""
        self.lengths |= {name: self.hand.read(abs(b - a)) for name, (a, b) in bars.items()}

    def told(self, *strokes: DesignStroke, **bars: tuple[complex, complex]) -> None:
        """A step in which bars are measured."""
        self.measure(**bars)
        written = ((name if name == "ram" else sign(name)) + f" = {_mm(self.lengths[name])} mm" for name in bars)
        self.do("design measured", *strokes, lengths=spaced(",  ", written))


# -- the tasks ---------------------------------------------------------------------------------------------------------


def construct(task: DesignTask, scale: float = 1.0, instrument: Instrument = EXACT) -> DesignSheet:
    """Draw a task at a scale (units of length for one mm of paper).

    Raises
    ------
    Unsolvable : lines or arcs that should meet do not
    """
    paper = DesignSheet(task, scale, instrument)
    draw(task, paper)
    return paper


def _mm(length: float) -> str:
    """A length for laying off: mm on paper."""
    return f"{length:.2f}"


def _theta(K: float) -> float:
    """Acute angle between the crank's limit positions (rad)."""
    return math.pi * (K - 1.0) / (K + 1.0)


@singledispatch
def draw(task: DesignTask, paper: DesignSheet) -> None:
    """Draw a task on paper, by its kind."""
    raise TypeError(task)


@draw.register
def _(task: SliderCrankTask, paper: DesignSheet) -> None:
    """The stroke on its line, the crank's pivot on the circle from which the stroke is seen under theta, at the offset:
    crank = (AC1 - AC2) / 2, rod = (AC1 + AC2) / 2 (Sun Huan, ch. 8)."""
    stroke, offset = paper.mm(task.stroke), paper.mm(task.offset)
    near = paper.hand.point(0j)
    far = paper.lay_off(near, 1 + 0j, stroke)
    paper.do("design stroke", line("given", near, far), *points(C1=far, C2=near), mm=_mm(stroke))
    middle, radius = _locus(paper, far, near, 1, task.K)
    # A lies beyond the near end of the stroke, the offset above its line
    height = near + 1j * paper.hand.length(offset)
    A = paper.cut("A", height, paper.hand.direction(1 + 0j), middle, radius)[1]
    paper.do("design parallel", line("direction", A, complex(far.real, A.imag)), *pivots(A=A), mm=_mm(offset))
    _crank_from_limits(paper, A, far, near)


@draw.register
def _(task: CrankRockerTask, paper: DesignSheet) -> None:
    """Both limit places of the rocker, the crank's pivot on the circle from which their ends are seen under theta, on
    their line if K is 1 (Sun Huan, ch. 8)."""
    half, arm = task.swing / 2, paper.mm(task.rocker)
    D = paper.hand.point(0j)
    first, second = (paper.lay_off_angle(D, direction(90.0 + side * half), arm) for side in (1, -1))
    paper.do("design swing", *fan("given", D, first, second), *pivots(D=D), *points(C1=first, C2=second),
             angle(D, second - D, first - D, task.swing, "ψ"), swing=f"{task.swing:.6g}", mm=_mm(arm))  # fmt: skip
    if _theta(task.K) == 0.0:
        A = _pivot_on_line(paper, D, first, second, task)
    else:
        A = _pivot_on_circle(paper, D, _locus(paper, first, second, -1, task.K), task)
    _between_limits(paper, A, D, first, second)


@draw.register
def _(task: LimitsTask, paper: DesignSheet) -> None:
    """Both limit places of the rocker about given pivots: crank = (AC1 - AC2) / 2, coupler = (AC1 + AC2) / 2."""
    A, D, arm = paper.plot(task.A), paper.plot(task.D), paper.mm(task.rocker)
    first, second = (paper.lay_off_angle(D, direction(angle), arm) for angle in task.angles)
    low, high = (f"{angle:.6g}" for angle in task.angles)
    paper.do("design limit positions", *fan("given", D, first, second), *pivots(A=A, D=D),
             *points(C1=first, C2=second), mm=_mm(arm), first=low, second=high)  # fmt: skip
    _between_limits(paper, A, D, first, second)


def _locus(paper: DesignSheet, first: complex, second: complex, above: int, K: float) -> tuple[complex, float]:
    """The circle over C1C2 from whose points above the chord (-1: below) it is seen under theta: centre and radius."""
    left, right = sorted((first, second), key=lambda z: z.real)
    tilt, shown = math.pi / 2 - _theta(K), f"{math.degrees(_theta(K)):.6g}"
    midway, square = paper.bisector(first, second)
    leg = paper.hand.angle(unit(right - left) * complex(math.cos(tilt), above * math.sin(tilt)))
    centre = paper.meet("O", left, leg, midway, square)
    radius = paper.hand.compass(abs(first - centre))
    paper.do("design theta", K=f"{K:.6g}", theta=shown)
    legs = right - left, (centre - left) or leg
    turn = legs if (tilt > 0) == (above > 0) else legs[::-1]
    paper.do("design centre", angle(left, *turn, abs(math.degrees(tilt))), *fan("construction", left, centre, right),
             line("direction", midway, centre), *points(O=centre), circle(centre, radius),
             tilt=f"{math.degrees(tilt):.6g}", theta=shown)  # fmt: skip
    return centre, radius


def _pivot_on_circle(
    paper: DesignSheet, D: complex, locus: tuple[complex, float], task: CrankRockerTask
) -> complex:
    """The crank's pivot, at the crossing of the frame's arc about D and the circle over C1C2."""
    middle, radius = locus
    reach = paper.hand.compass(paper.mm(task.frame))
    if abs(middle - D) < 1e-9 * radius:
        raise _not_drawn("A", "the circle over c1c2 is one about d", "another k or swing")
    met = cross_arcs(D, reach, middle, radius)
    if met is None:
        raise _not_drawn("A", "the arc about d does not reach the", "another frame")
    A = paper.hand.point(min(met, key=lambda z: z.real))
    paper.do("design arc", circle(D, reach, A), *pivots(A=A), mm=_mm(paper.mm(task.frame)))
    return A


def _pivot_on_line(paper: DesignSheet, D: complex, first: complex, second: complex, task: CrankRockerTask) -> complex:
    """The crank's pivot for K = 1: crank and rod lie in the line C1C2 in both limit positions."""
    reach = paper.hand.compass(paper.mm(task.frame))
    A = paper.cut("A", second, unit(first - second), D, reach)[0]
    paper.do("design theta", K=f"{task.K:.6g}", theta="0")
    paper.do("design line", line("construction", second, A), circle(D, reach, A), *pivots(A=A),
             mm=_mm(paper.mm(task.frame)))  # fmt: skip
    return A


def _between_limits(paper: DesignSheet, A: complex, D: complex, first: complex, second: complex) -> None:
    """The crank and the rod from both limit positions of a rocker, then the rocker and the frame."""
    swapped = abs(first - A) < abs(second - A)
    far, near = (second, first) if swapped else (first, second)
    _crank_from_limits(paper, A, far, near, swapped)
    paper.measure(CD=(first, D), AD=(A, D))


def _crank_from_limits(paper: DesignSheet, A: complex, far: complex, near: complex, swapped: bool = False) -> None:
    """The crank as half the difference of AC1 and AC2, laid off by the compass, with both limit positions."""
    i, j = (2, 1) if swapped else (1, 2)
    reach = paper.hand.compass(abs(near - A))
    on_far = paper.hand.point(A + reach * unit(far - A))  # AC2 laid on AC1: what remains is twice the crank
    crank = paper.hand.compass(abs(far - on_far) / 2)
    ends = (near - A, far - A) if cross(near - A, far - A) > 0 else (far - A, near - A)
    theta = math.degrees(math.atan2(abs(cross(*ends)), dot(*ends)))
    shown = [angle(A, *ends, theta, "θ")] if theta > SEEN else []
    paper.do("design halve", *shown, *fan("limit", A, far, near), circle(A, reach, on_far),
             longer=sign("AC", str(i)), shorter=sign("AC", str(j)))  # fmt: skip
    out, back = paper.hand.point(A + crank * unit(far - A)), paper.hand.point(A - crank * unit(near - A))
    paper.do("design crank circle", circle(A, crank), *points(**{f"B{i}": out, f"B{j}": back}),
             line("limit", A, back), line("mechanism", A, out, far))  # fmt: skip
    paper.told(AB=(A, out), BC=(out, far))


@draw.register
def _(task: GuideBarTask, paper: DesignSheet) -> None:
    """The swing of the guide bar is theta: crank = AC sin(theta / 2), square to the bar in its limit places (Sun Huan,
    ch. 8)."""
    hand, theta, centres, reach = paper.hand, _theta(task.K), paper.mm(task.centres), paper.mm(task.stroke) / 2
    half = theta / 2
    C = hand.point(0j)
    A = paper.lay_off(C, 1j, centres)
    paper.do("design centres", line("given", C, A), *pivots(A=A, C=C), mm=_mm(centres))
    paper.do("design theta", K=f"{task.K:.6g}", theta=f"{math.degrees(theta):.6g}")
    left, right = (hand.angle(unit(A - C) * complex(math.cos(half), side * math.sin(half))) for side in (1, -1))
    foot = paper.meet("B1", C, left, A, hand.direction(1j * left))
    other = paper.meet("B2", C, right, A, hand.direction(1j * right))
    far = abs(A - C)
    paper.do("design bar limits", *fan("direction", C, C + 1.15 * far * left, C + 1.15 * far * right),
             angle(C, far * right, far * left, math.degrees(theta), "θ"), half=f"{math.degrees(half):.6g}")  # fmt: skip
    paper.do("design feet", line("mechanism", A, foot), line("limit", A, other), *points(B1=foot, B2=other),
             circle(A, abs(foot - A)))  # fmt: skip
    length = hand.length(reach)
    first = paper.meet("D1", C, left, C - length, hand.direction(1j))
    second = paper.meet("D2", C, right, C + length, hand.direction(1j))
    top = C + 1j * abs(first - C)
    paper.do("design bar ends", line("construction", C - length, first), line("construction", C + length, second),
             *points(D1=first, D2=second), line("mechanism", C, first), line("limit", C, second),
             mm=_mm(reach))  # fmt: skip
    top = hand.point(top)
    chord = paper.meet("chord", first, unit(second - first), C, 1j)
    level = hand.point((top + chord) / 2)
    rod = hand.compass(paper.mm(task.rod_length))
    paper.do("design sagitta", circle(C, abs(first - C), first, top, second), line("construction", first, second),
             line("direction", level - length, level + length + rod))  # fmt: skip
    E = paper.cut("E", level, 1 + 0j, first, rod)[0]
    paper.do("design ram", circle(first, rod, E), *points(E1=E), line("mechanism", first, E),
             mm=_mm(paper.mm(task.rod_length)))  # fmt: skip
    paper.told(AB=(A, foot), AC=(A, C), CD=(C, first), ram=(C, level))


@draw.register
def _(task: BarPositionsTask, paper: DesignSheet) -> None:
    """Each pivot is the centre of the circle through three places of its point, where two bisectors cross; of given
    pivots, turned back with the bar, each joint is that of three pivots (Hartenberg and Denavit, ch. 9)."""
    bars = [(paper.plot(bar.B), paper.plot(bar.C)) for bar in task.positions]
    ends = {f"{name}{i}": at for i, bar in enumerate(bars, 1) for name, at in zip("BC", bar, strict=True)}
    lines = [line("limit" if i else "given", *bar) for i, bar in enumerate(bars)]
    paper.do("design places", *lines, *points(**ends))
    (B, C), *_ = bars
    if task.A is None or task.D is None:
        A, D = (_circle_centre(paper, name, [sign(of, i) for i in "123"], on, pivots)
                for name, of, on in zip("AD", "BC", zip(*bars, strict=True), strict=True))  # fmt: skip
        _chain(paper, "CD", A=A, B=B, C=C, D=D)
        return
    A, D = paper.plot(task.A), paper.plot(task.D)
    paper.do("design pivots", *pivots(A=A, D=D))
    centres = []
    for name, at, new in (("A", A, "M"), ("D", D, "N")):
        # carried along with the bar, by overlay
        turned = [at, *(paper.hand.point(B + (at - b) * (unit(C - B) / unit(c - b))) for b, c in bars[1:])]
        strokes: list[DesignStroke] = []
        for i, z in enumerate(turned[1:], 2):
            strokes += [*points(**{f"{name}{i}": z}), line("construction", B, z), line("construction", C, z)]
        paper.do("design inverted", *strokes, pivot=sign(name))
        centres.append(_circle_centre(paper, new, [sign(name, i) for i in ("", "2", "3")], turned, points))
    _chain(paper, "DN", A=A, M=centres[0], N=centres[1], D=D)


def _circle_centre(
    paper: DesignSheet, name: str, of: Sequence[RichText], on: Sequence[complex],
    marked: Callable[..., list[DesignStroke]],
) -> complex:  # fmt: skip
    """The centre of the circle through three points named ``of``: the crossing of the perpendicular bisectors of two
    chords."""
    # the two longest sides give the best crossing
    sides = sorted(((i, j) for i, j in ((0, 1), (1, 2), (0, 2))), key=lambda side: -abs(on[side[1]] - on[side[0]]))
    (i, j), (k, m) = sorted(sides[:2])
    p, d = paper.bisector(on[i], on[j])
    q, e = paper.bisector(on[k], on[m])
    at = paper.meet(name, p, d, q, e)
    paper.do("design bisectors", line("construction", on[i], on[j]), line("construction", on[k], on[m]),
             line("direction", p, at), line("direction", q, at), circle(at, abs(on[0] - at), *on),
             *marked(**{name: at}), centre=sign(name), first=of[i] + of[j], second=of[k] + of[m])  # fmt: skip
    return at


def _chain(paper: DesignSheet, close: str, **chain: complex) -> None:
    """The four bars of a linkage measured and drawn; ``close`` is the name of the third bar."""
    (a, A), (b, B), (c, C), (d, D) = chain.items()
    bars = {a + b: (A, B), b + c: (B, C), close: (C, D), a + d: (A, D)}
    paper.told(line("mechanism", A, B, C, D), **bars)


@draw.register
def _(task: FunctionTask, paper: DesignSheet) -> None:
    """Two trial cranks, each with the rockers that two pairs of angle pairs need; between the reciprocals of crank and
    rocker each relation is a straight line (Freudenstein's equation is linear in them)."""
    hand, frame = paper.hand, paper.mm(task.frame)
    A = hand.point(0j)
    D = paper.lay_off(A, 1 + 0j, frame)
    phi, psi = ([hand.angle(direction(pair[i])) for pair in task.pairs] for i in (0, 1))
    rays = [line("direction", at, at + 0.6 * frame * ray) for at, ways in ((A, phi), (D, psi)) for ray in ways]
    paper.do("design pairs", line("given", A, D), *pivots(A=A, D=D), *rays, mm=_mm(frame))
    trials = [_trials(paper, A, D, frame, phi, psi, other) for other in (1, 2)]
    # one unit of the diagram, so that what was tried fits beside the mechanism
    per_one = frame / max(1.0, *(max(abs(z.real), abs(z.imag)) for ends in trials for z in ends))
    (p, q), (r, s) = ([hand.point(per_one * z) for z in ends] for ends in trials)
    crossing = paper.meet("AB", p, unit(q - p), r, unit(s - r))
    corner = complex(2.2 * frame, 0.0)
    strokes = [line("direction", corner, corner + ray * max(0.3 * frame, 1.1 * z))
               for ray, z in ((1, crossing.real), (1j, crossing.imag))]  # fmt: skip
    strokes += dots(*(corner + z for z in (p, q, r, s)))
    for a, b in ((p, q), (r, s)):
        first, _, last = sorted((a, b, crossing), key=lambda z: (z.real, z.imag))
        strokes.append(line("construction", corner + first, corner + last))
    paper.do("design reciprocals", *strokes, *points(Q=corner + crossing), unit=_mm(per_one))
    across, upward = hand.read_signed(crossing.real), hand.read_signed(crossing.imag)
    if min(abs(across), abs(upward)) < 1e-9 * per_one:
        raise _not_drawn("design.pairs", "they ask for a bar without end", "other angles")
    crank, rocker = frame * per_one / across, frame * per_one / upward
    paper.turned += [name for name, mm in (("AB", crank), ("CD", rocker)) if mm < 0]
    B = hand.point(A + hand.length(abs(crank)) * math.copysign(1.0, crank) * phi[0])
    C = hand.point(D + hand.length(abs(rocker)) * math.copysign(1.0, rocker) * psi[0])
    paper.do("design reckoned", *points(B=B, C=C), **_reckoned(frame, per_one, across, upward))
    _chain(paper, "CD", A=A, B=B, C=C, D=D)


def _reckoned(frame: float, per_one: float, across: float, upward: float) -> dict[str, str]:
    """The coordinates of Q, crank and rocker, and the unit (mm): with the decimals that make the quotients true as
    written."""
    lengths = [abs(frame * per_one / side) for side in (across, upward)]
    for decimals in DECIMALS:
        base, unit, *sides = (round(value, decimals) for value in (frame, per_one, across, upward))
        written = [_mm(length) for length in lengths]
        if all(_mm(abs(base * unit / side)) == text for side, text in zip(sides, written, strict=True) if side):
            break
    figures = (*(f"{side:.{decimals}f}" for side in sides), *written, f"{unit:.{decimals}f}")
    return dict(zip(("across", "upward", "crank", "rocker", "unit"), figures, strict=True))


def _trials(
    paper: DesignSheet, A: complex, D: complex, frame: float, phi: list[complex], psi: list[complex], other: int
) -> tuple[complex, complex]:
    """Two points of a line in the diagram of reciprocals: frame over crank, frame over rocker."""
    back = psi[0] / psi[other]
    cranks = []
    for share in (0.4, 0.9, 0.65, 0.3, 1.3):
        crank = paper.hand.length(share * frame)
        B, moved = A + crank * phi[0], paper.hand.point(D + (A + crank * phi[other] - D) * back)
        if abs(moved - B) < 1e-9 * frame:
            continue
        p, d = paper.bisector(B, moved)
        normal = -1j * d
        # the ray of the rocker and the bisector meet at frame / reciprocal from D
        level = dot(p - D, normal)
        if abs(level) < 1e-6 * frame:
            continue
        cranks.append((crank, frame * dot(psi[0], normal) / level, B, moved, p))
        if len(cranks) == 2:
            break
    if len(cranks) < 2:
        raise _not_drawn("design.pairs", "no trial crank tells the pairs apart", "other pairs")
    strokes: list[DesignStroke] = []
    ends = []
    for crank, reciprocal, B, moved, p in cranks:
        strokes += [*dots(B, moved), line("construction", B, moved)]
        at = D + psi[0] * (frame / reciprocal) if abs(reciprocal) > 1e-9 else None
        if at is not None and abs(at - D) < 3 * frame:
            strokes += [line("direction", p, at), *dots(at)]
            reciprocal = frame / paper.hand.read_signed(math.copysign(abs(at - D), reciprocal))
        ends.append(complex(frame / paper.hand.read(crank), reciprocal))
    paper.do("design trial", *strokes, pair=str(other + 1))
    return ends[0], ends[1]
