"""Mechanisms designed on the drawing board: from what they shall do to their lengths, with ruler, compass, protractor.

Each construction is drawn at its true scale and measured; only what the task gives, and angles reckoned from it, are
taken as given.  Slider-crank, crank-rocker and guide bar by K after Sun Huan, Mechanical Principles, ch. 8; places of a
bar by the circles of its points, or by inversion (Hartenberg and Denavit, Kinematic Synthesis of Linkages, ch. 9).
What stands on the paper are strokes in mm, y up, in numbered steps.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import singledispatch
from typing import Literal

from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.sheet import PARALLEL
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, cross_arcs, cross_line_arc, cross_lines, direction, dot, unit
from graphkin.scene.designs import (
    BarPositionsTask,
    CrankRockerTask,
    DesignTask,
    FunctionTask,
    GuideBarTask,
    LimitsTask,
    SliderCrankTask,
)
from graphkin.words import Markup, Phrase

__all__ = [
    "DesignAngle", "DesignCircle", "DesignLine", "DesignPoint", "DesignSheet", "DesignStep", "DesignStroke", "LineKind",
    "construct",
]  # fmt: skip

DECIMALS = range(2, 9)
"""Of lengths (mm) from which others are reckoned, until that is true as it is written."""
SEEN = 0.05
"""Degrees between two lines that are drawn as an angle."""

LineKind = Literal["given", "construction", "direction", "limit", "mechanism"]
"""Lines that the task gives, help lines, lines of which only the direction is known, bars in other positions, and the
mechanism that is found."""


@dataclass(frozen=True)
class DesignLine:
    """A line from a to b."""

    a: complex
    b: complex
    kind: LineKind


@dataclass(frozen=True)
class DesignCircle:
    """A circle, or of it only the arcs near the points ``near``."""

    centre: complex
    radius: float
    near: tuple[complex, ...] = ()


@dataclass(frozen=True)
class DesignPoint:
    """A point with its name ("" for one that needs none); a fixed pivot, or another."""

    name: str
    at: complex
    pivot: bool = False


@dataclass(frozen=True)
class DesignAngle:
    """An angle (degrees) drawn about a point from one direction to another, counter-clockwise."""

    apex: complex
    first: complex
    second: complex
    value: float
    name: str = ""


DesignStroke = DesignLine | DesignCircle | DesignPoint | DesignAngle


@dataclass(frozen=True)
class DesignStep:
    """One action: the sentence to be, and the strokes that it leaves."""

    number: int
    phrase: Phrase
    strokes: tuple[DesignStroke, ...]


def _not_drawn(what: str, found: str, wanted: str) -> Unsolvable:
    return Unsolvable("not drawn", Problem(what, Phrase(found), Phrase(wanted)))


@dataclass
class DesignSheet:
    """A construction on paper, in mm, y up; it grows while it is drawn.

    Parameters
    ----------
    scale : units of the task's length for one mm
    steps : what was done, in order
    lengths : what was measured, mm on paper, by the two points of a bar ("ram": distance of its line from C)
    turned : bars that were found opposite to the angles asked
    """

    task: DesignTask
    scale: float
    hand: Instrument
    steps: list[DesignStep] = field(default_factory=list)
    lengths: dict[str, float] = field(default_factory=dict)
    turned: list[str] = field(default_factory=list)

    @property
    def points(self) -> dict[str, complex]:
        """The places of the named points."""
        strokes = (stroke for step in self.steps for stroke in step.strokes)
        return {stroke.name: stroke.at for stroke in strokes if isinstance(stroke, DesignPoint) and stroke.name}

    # -- acts of the hand ----------------------------------------------------------------------------------------------

    def do(self, key: str, args: tuple[object, ...], *strokes: DesignStroke) -> None:
        """Record one step with the strokes that it leaves."""
        self.steps.append(DesignStep(len(self.steps) + 1, Phrase(key, args), strokes))

    def mm(self, length: float) -> float:
        """A length of the task on paper."""
        return length / self.scale

    def lay_off(self, start: complex, along: complex, mm: float) -> complex:
        """A length in a direction that the set square gives."""
        return self.hand.point(start + self.hand.length(mm) * self.hand.direction(along))

    def lay_off_angle(self, start: complex, along: complex, mm: float) -> complex:
        """A length in a direction that the protractor gives."""
        return self.hand.point(start + self.hand.length(mm) * self.hand.angle(along))

    def plot(self, at: complex) -> complex:
        """A point by its coordinates."""
        return self.hand.point(complex(self.hand.length(self.mm(at.real)), self.hand.length(self.mm(at.imag))))

    def meet(self, what: str, p: complex, d: complex, q: complex, e: complex) -> complex:
        """Where two lines meet, each through a point along a direction.  Raises Unsolvable where they are parallel."""
        at = cross_lines(p, d, q, e)
        if abs(cross(d, e)) < PARALLEL or at is None:
            raise _not_drawn(what, "the lines that should find it are parallel", "other data")
        return self.hand.point(at)

    def cut(self, what: str, p: complex, d: complex, centre: complex, radius: float) -> tuple[complex, complex]:
        """Where a line cuts a circle, the one further along d first.  Raises Unsolvable where it does not."""
        found = cross_line_arc(p, d, centre, radius)
        if found is None:
            raise _not_drawn(what, "the line does not reach the circle", "other data")
        return self.hand.point(found[0]), self.hand.point(found[1])

    def bisector(self, a: complex, b: complex) -> tuple[complex, complex]:
        """A point and the direction of the perpendicular bisector, drawn by two pairs of compass arcs."""
        return self.hand.point((a + b) / 2), self.hand.direction(1j * unit(b - a))

    def measure(self, *bars: tuple[str, complex, complex]) -> list[str]:
        """The lengths of bars off the paper (mm), each by its name, and as they are written."""
        self.lengths |= {name: self.hand.read(abs(b - a)) for name, a, b in bars}
        return [f"{name if name == 'ram' else f'${name}$'} = {self.lengths[name]:.2f} mm" for name, _, _ in bars]


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
    """A length as it is laid off: mm on paper."""
    return f"{length:.2f}"


@singledispatch
def draw(task: DesignTask, paper: DesignSheet) -> None:
    """Draw a task on paper, by its kind."""
    raise TypeError(task)


@draw.register
def _(task: SliderCrankTask, paper: DesignSheet) -> None:
    theta = _theta(task.K)
    near = paper.hand.point(0j)
    far = paper.lay_off(near, 1 + 0j, paper.mm(task.stroke))
    paper.do("design stroke", (Markup("C_{2}C_{1}"), _mm(paper.mm(task.stroke))),
            DesignLine(near, far, "given"), DesignPoint("C1", far), DesignPoint("C2", near))  # fmt: skip
    middle, radius = _locus(paper, far, near, 1, theta, task.K)
    # A lies beyond the near end of the stroke, the offset above its line
    height = near + 1j * paper.hand.length(paper.mm(task.offset))
    along = paper.hand.direction(1 + 0j)
    A = paper.cut("A", height, along, middle, radius)[1]
    paper.do("design parallel", (_mm(paper.mm(task.offset)),),
            DesignLine(A, complex(far.real, A.imag), "direction"), DesignPoint("A", A, pivot=True))  # fmt: skip
    _crank_from_limits(paper, A, far, near)


@draw.register
def _(task: CrankRockerTask, paper: DesignSheet) -> None:
    theta, half = _theta(task.K), task.swing / 2
    D = paper.hand.point(0j)
    arm = paper.mm(task.rocker)
    first = paper.lay_off_angle(D, direction(90.0 + half), arm)
    second = paper.lay_off_angle(D, direction(90.0 - half), arm)
    paper.do("design swing", (f"{task.swing:.6g}", _mm(arm)), DesignPoint("D", D, pivot=True),
            DesignLine(D, first, "given"), DesignLine(D, second, "given"), DesignPoint("C1", first),
            DesignPoint("C2", second),
            DesignAngle(D, second - D, first - D, task.swing, "ψ"))  # fmt: skip
    A = _pivot_on_line(paper, D, first, second, task) if theta == 0.0 else _pivot_on_circle(
        paper, D, _locus(paper, first, second, -1, theta, task.K), task
    )
    _between_limits(paper, A, D, first, second)


def _between_limits(paper: DesignSheet, A: complex, D: complex, first: complex, second: complex) -> None:
    """The crank and the rod from both limit positions of a rocker, then the rocker and the frame."""
    swapped = abs(first - A) < abs(second - A)
    far, near = (second, first) if swapped else (first, second)
    _crank_from_limits(paper, A, far, near, swapped)
    paper.measure(("CD", first, D), ("AD", A, D))


def _pivot_on_circle(paper: DesignSheet, D: complex, circle: tuple[complex, float], task: CrankRockerTask) -> complex:
    """The crank's pivot, where the arc of the frame about D cuts the circle over C1C2."""
    middle, radius = circle
    reach = paper.hand.compass(paper.mm(task.frame))
    if abs(middle - D) < 1e-9 * radius:
        raise _not_drawn("A", "the circle over c1c2 is one about d", "another k or swing")
    met = cross_arcs(D, reach, middle, radius)
    if met is None:
        raise _not_drawn("A", "the arc about d does not reach the", "another frame")
    A = paper.hand.point(min(met, key=lambda z: z.real))
    paper.do("design arc", (Markup("D"), _mm(paper.mm(task.frame)), Markup("A")),
             DesignCircle(D, reach, (A,)), DesignPoint("A", A, pivot=True))  # fmt: skip
    return A


def _pivot_on_line(
    paper: DesignSheet, D: complex, first: complex, second: complex, task: CrankRockerTask
) -> complex:
    """The same for K = 1: crank and rod lie in the line C1C2 in both limit positions."""
    reach = paper.hand.compass(paper.mm(task.frame))
    A = paper.cut("A", second, unit(first - second), D, reach)[0]
    paper.do("design theta", (f"{task.K:.6g}", "0"))
    paper.do("design line", (Markup("D"), _mm(paper.mm(task.frame)), Markup("A")),
             DesignLine(second, A, "construction"), DesignCircle(D, reach, (A,)),
             DesignPoint("A", A, pivot=True))  # fmt: skip
    return A


def _locus(
    paper: DesignSheet, first: complex, second: complex, above: int, theta: float, K: float
) -> tuple[complex, float]:
    """The circle over C1C2 from whose points above the chord (-1: below) it is seen under theta: centre and radius."""
    left, right = sorted((first, second), key=lambda z: z.real)
    tilt = math.pi / 2 - theta
    midway, square = paper.bisector(first, second)
    leg = paper.hand.angle(unit(right - left) * complex(math.cos(tilt), above * math.sin(tilt)))
    centre = paper.meet("O", left, leg, midway, square)
    radius = paper.hand.compass(abs(first - centre))
    shown = f"{math.degrees(theta):.6g}"
    paper.do("design theta", (f"{K:.6g}", shown))
    legs = right - left, (centre - left) or leg
    turn = legs if (tilt > 0) == (above > 0) else legs[::-1]
    paper.do("design centre", (f"{math.degrees(tilt):.6g}", shown), DesignAngle(left, *turn, abs(math.degrees(tilt))),
            DesignLine(left, centre, "construction"), DesignLine(left, right, "construction"),
            DesignLine(midway, centre, "direction"),
            DesignPoint("O", centre), DesignCircle(centre, radius))  # fmt: skip
    return centre, radius


def _crank_from_limits(paper: DesignSheet, A: complex, far: complex, near: complex, swapped: bool = False) -> None:
    """The crank as half the difference of AC1 and AC2, laid off by the compass, with both limit positions."""
    names = ("C_{2}", "C_{1}") if swapped else ("C_{1}", "C_{2}")
    reach = paper.hand.compass(abs(near - A))
    on_far = paper.hand.point(A + reach * unit(far - A))  # AC2 laid on AC1: what remains is twice the crank
    crank = paper.hand.compass(abs(far - on_far) / 2)
    ends = (near, far) if cross(near - A, far - A) > 0 else (far, near)
    theta = math.degrees(math.atan2(abs(cross(near - A, far - A)), dot(near - A, far - A)))
    shown = [DesignAngle(A, ends[0] - A, ends[1] - A, theta, "θ")] if theta > SEEN else []
    paper.do("design halve", (Markup("A" + names[0]), Markup("A" + names[1])), *shown, DesignLine(A, far, "limit"),
            DesignLine(A, near, "limit"), DesignCircle(A, reach, (on_far,)))  # fmt: skip
    out, back = paper.hand.point(A + crank * unit(far - A)), paper.hand.point(A - crank * unit(near - A))
    labels = ("B2", "B1") if swapped else ("B1", "B2")
    paper.do("design crank circle", (), DesignCircle(A, crank), DesignPoint(labels[0], out),
            DesignPoint(labels[1], back), DesignLine(A, back, "limit"),
            DesignLine(A, out, "mechanism"), DesignLine(out, far, "mechanism"))  # fmt: skip
    paper.do("design measured", (",  ".join(paper.measure(("AB", A, out), ("BC", out, far))),))


@draw.register
def _(task: GuideBarTask, paper: DesignSheet) -> None:
    theta = _theta(task.K)
    half = theta / 2
    C = paper.hand.point(0j)
    A = paper.lay_off(C, 1j, paper.mm(task.centres))
    paper.do("design centres", (_mm(paper.mm(task.centres)),), DesignLine(C, A, "given"),
            DesignPoint("A", A, pivot=True), DesignPoint("C", C, pivot=True))  # fmt: skip
    paper.do("design theta", (f"{task.K:.6g}", f"{math.degrees(theta):.6g}"))
    left = paper.hand.angle(unit(A - C) * complex(math.cos(half), math.sin(half)))
    right = paper.hand.angle(unit(A - C) * complex(math.cos(half), -math.sin(half)))
    foot = paper.meet("B1", C, left, A, paper.hand.direction(1j * left))
    other = paper.meet("B2", C, right, A, paper.hand.direction(1j * right))
    reach = abs(A - C)
    paper.do("design bar limits", (f"{math.degrees(half):.6g}",),
            DesignLine(C, C + 1.15 * reach * left, "direction"),
            DesignLine(C, C + 1.15 * reach * right, "direction"),
            DesignAngle(C, reach * right, reach * left, math.degrees(theta), "θ"))  # fmt: skip
    paper.do("design feet", (), DesignLine(A, foot, "mechanism"), DesignLine(A, other, "limit"),
            DesignPoint("B1", foot), DesignPoint("B2", other), DesignCircle(A, abs(foot - A)))  # fmt: skip
    apart = paper.hand.length(paper.mm(task.stroke) / 2)
    first = paper.meet("D1", C, left, C - apart, paper.hand.direction(1j))
    second = paper.meet("D2", C, right, C + apart, paper.hand.direction(1j))
    middle = C + 1j * abs(first - C)
    paper.do("design bar ends", (_mm(paper.mm(task.stroke) / 2),),
            DesignLine(C - apart, first, "construction"), DesignLine(C + apart, second, "construction"),
            DesignPoint("D1", first), DesignPoint("D2", second), DesignLine(C, first, "mechanism"),
            DesignLine(C, second, "limit"))  # fmt: skip
    top = paper.hand.point(middle)
    chord = paper.meet("chord", first, unit(second - first), C, 1j)
    line = paper.hand.point((top + chord) / 2)
    rod = paper.hand.compass(paper.mm(task.rod_length))
    paper.do("design sagitta", (), DesignCircle(C, abs(first - C), (first, top, second)),
            DesignLine(first, second, "construction"),
            DesignLine(line - apart, line + apart + rod, "direction"))  # fmt: skip
    E = paper.cut("E", line, 1 + 0j, first, rod)[0]
    paper.do("design ram", (_mm(paper.mm(task.rod_length)),), DesignCircle(first, rod, (E,)),
            DesignPoint("E1", E), DesignLine(first, E, "mechanism"))  # fmt: skip
    told = paper.measure(("AB", A, foot), ("AC", A, C), ("CD", C, first), ("ram", C, line))
    paper.do("design measured", (",  ".join(told),))


@draw.register
def _(task: LimitsTask, paper: DesignSheet) -> None:
    A, D = paper.plot(task.A), paper.plot(task.D)
    arm = paper.mm(task.rocker)
    first, second = (paper.lay_off_angle(D, direction(angle), arm) for angle in task.angles)
    shown = tuple(f"{angle:.6g}" for angle in task.angles)
    paper.do("design limit positions", (_mm(arm), *shown), DesignPoint("A", A, pivot=True),
            DesignPoint("D", D, pivot=True), DesignLine(D, first, "given"), DesignLine(D, second, "given"),
            DesignPoint("C1", first), DesignPoint("C2", second))  # fmt: skip
    _between_limits(paper, A, D, first, second)


@draw.register
def _(task: BarPositionsTask, paper: DesignSheet) -> None:
    bars = [(paper.plot(bar.B), paper.plot(bar.C)) for bar in task.positions]
    named = [(f"{name}{i}", at) for i, bar in enumerate(bars, 1) for name, at in zip("BC", bar, strict=True)]
    marks = [DesignPoint(name, at) for name, at in named]
    lines = [DesignLine(*bar, "given" if i == 0 else "limit") for i, bar in enumerate(bars)]
    paper.do("design places", (), *lines, *marks)
    if task.A is None or task.D is None:
        A = _circle_centre(paper, "A", "B", [bar[0] for bar in bars], pivot=True)
        D = _circle_centre(paper, "D", "C", [bar[1] for bar in bars], pivot=True)
        chain = ("A", A), ("B", bars[0][0]), ("C", bars[0][1]), ("D", D)
    else:
        A, D = paper.plot(task.A), paper.plot(task.D)
        paper.do("design pivots", (), DesignPoint("A", A, pivot=True), DesignPoint("D", D, pivot=True))
        found = []
        for name, at, new in (("A", A, "M"), ("D", D, "N")):
            turned = [at, *(_carried(paper, at, bar, bars[0]) for bar in bars[1:])]
            paper.do("design inverted", (Markup(name),), *(
                stroke for i, z in enumerate(turned[1:], 2)
                for stroke in (DesignPoint(f"{name}{i}", z), DesignLine(bars[0][0], z, "construction"),
                               DesignLine(bars[0][1], z, "construction"))))  # fmt: skip
            found.append(_circle_centre(paper, new, name, turned, numbered=(2, 3)))
        chain = ("A", A), ("M", found[0]), ("N", found[1]), ("D", D)
    _chain(paper, chain, close="DN" if len(chain) and chain[2][0] == "N" else "CD")


def _carried(paper: DesignSheet, at: complex, bar: tuple[complex, complex], to: tuple[complex, complex]) -> complex:
    """A point carried along with the bar, by overlay."""
    turn = unit(to[1] - to[0]) / unit(bar[1] - bar[0])
    return paper.hand.point(to[0] + (at - bar[0]) * turn)


def _circle_centre(
    paper: DesignSheet, name: str, of: str, points: list[complex], pivot: bool = False,
    numbered: tuple[int, ...] = (1, 2, 3),
) -> complex:
    """The centre of the circle through three points: where the perpendicular bisectors of two chords meet."""
    # the two longest sides give the best crossing
    sides = sorted(((i, j) for i, j in ((0, 1), (1, 2), (0, 2))), key=lambda s: -abs(points[s[1]] - points[s[0]]))
    (i, j), (k, m) = sorted(sides[:2])
    p, d = paper.bisector(points[i], points[j])
    q, e = paper.bisector(points[k], points[m])
    at = paper.meet(name, p, d, q, e)

    def written(n: int) -> str:
        return of if len(numbered) == 2 and n == 0 else f"{of}_{{{n + 1}}}"

    paper.do("design bisectors", (Markup(name), Markup(written(i) + written(j)), Markup(written(k) + written(m))),
            DesignLine(points[i], points[j], "construction"), DesignLine(points[k], points[m], "construction"),
            DesignLine(p, at, "direction"), DesignLine(q, at, "direction"),
            DesignCircle(at, abs(points[0] - at), tuple(points)), DesignPoint(name, at, pivot))  # fmt: skip
    return at


def _chain(paper: DesignSheet, chain: tuple[tuple[str, complex], ...], close: str) -> None:
    """The four bars of a linkage measured, drawn as it stands."""
    (a, A), (b, B), (c, C), (d, D) = chain
    bars = [DesignLine(A, B, "mechanism"), DesignLine(B, C, "mechanism"), DesignLine(C, D, "mechanism")]
    told = paper.measure((a + b, A, B), (b + c, B, C), (close, C, D), (a + d, A, D))
    paper.do("design measured", (",  ".join(told),), *bars)


@draw.register
def _(task: FunctionTask, paper: DesignSheet) -> None:
    """Two trial cranks, each with the rockers that two pairs of pairs ask for; between the reciprocals of crank and
    rocker each relation is a straight line (Freudenstein's equation is linear in them)."""
    frame = paper.mm(task.frame)
    A = paper.hand.point(0j)
    D = paper.lay_off(A, 1 + 0j, frame)
    phi = [paper.hand.angle(direction(pair[0])) for pair in task.pairs]
    psi = [paper.hand.angle(direction(pair[1])) for pair in task.pairs]
    rays = [DesignLine(A, A + 0.6 * frame * way, "direction") for way in phi]
    rays += [DesignLine(D, D + 0.6 * frame * way, "direction") for way in psi]
    paper.do("design pairs", (_mm(frame),), DesignLine(A, D, "given"), DesignPoint("A", A, pivot=True),
            DesignPoint("D", D, pivot=True), *rays)  # fmt: skip
    trials = [_trials(paper, A, D, frame, phi, psi, other) for other in (1, 2)]
    # one unit of the diagram, so that what was tried fits beside the mechanism
    one = frame / max(1.0, *(max(abs(z.real), abs(z.imag)) for line in trials for z in line))
    (p, q), (r, s) = ([paper.hand.point(one * z) for z in line] for line in trials)
    crossing = paper.meet("AB", p, unit(q - p), r, unit(s - r))
    corner = complex(2.2 * frame, 0.0)
    axes = [DesignLine(corner, corner + way * max(0.3 * frame, 1.1 * z), "direction")
            for way, z in ((1, crossing.real), (1j, crossing.imag))]  # fmt: skip
    strokes: list[DesignStroke] = [DesignPoint("", corner + z) for z in (p, q, r, s)]
    for a, b in ((p, q), (r, s)):
        along = sorted((a, b, crossing), key=lambda z: (z.real, z.imag))
        strokes.append(DesignLine(corner + along[0], corner + along[-1], "construction"))
    paper.do("design reciprocals", (_mm(one),), *axes, *strokes, DesignPoint("Q", corner + crossing))
    across, upward = paper.hand.read_signed(crossing.real), paper.hand.read_signed(crossing.imag)
    if min(abs(across), abs(upward)) < 1e-9 * one:
        raise _not_drawn("design.pairs", "they ask for a bar without end", "other angles")
    crank, rocker = frame * one / across, frame * one / upward
    paper.turned += [name for name, mm in (("AB", crank), ("CD", rocker)) if mm < 0]
    B = paper.hand.point(A + paper.hand.length(abs(crank)) * math.copysign(1.0, crank) * phi[0])
    C = paper.hand.point(D + paper.hand.length(abs(rocker)) * math.copysign(1.0, rocker) * psi[0])
    paper.do("design reckoned", _reckoned(frame, one, across, upward),
            DesignPoint("B", B), DesignPoint("C", C))  # fmt: skip
    _chain(paper, (("A", A), ("B", B), ("C", C), ("D", D)), close="CD")


def _reckoned(frame: float, one: float, across: float, upward: float) -> tuple[str, ...]:
    """The coordinates of Q, crank and rocker, and the unit (mm): with as many decimals as the quotients want that are
    to be true as they are written."""
    lengths = [abs(frame * one / side) for side in (across, upward)]
    for decimals in DECIMALS:
        base, unit, *sides = (round(value, decimals) for value in (frame, one, across, upward))
        told = [f"{length:.2f}" for length in lengths]
        if all(f"{abs(base * unit / side):.2f}" == text for side, text in zip(sides, told, strict=True) if side):
            break
    return (*tuple(f"{side:.{decimals}f}" for side in sides), *told, f"{unit:.{decimals}f}")


def _trials(
    paper: DesignSheet, A: complex, D: complex, frame: float, phi: list[complex], psi: list[complex], other: int
) -> tuple[complex, complex]:
    """Two points of a line in the diagram of reciprocals: frame over crank, frame over rocker."""
    back = psi[0] / psi[other]
    found = []
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
        found.append((crank, frame * dot(psi[0], normal) / level, B, moved, p))
        if len(found) == 2:
            break
    if len(found) < 2:
        raise _not_drawn("design.pairs", "no trial crank tells the pairs apart", "other pairs")
    strokes: list[DesignStroke] = []
    ends = []
    for crank, reciprocal, B, moved, p in found:
        at = D + psi[0] * (frame / reciprocal) if abs(reciprocal) > 1e-9 else None
        strokes += [DesignPoint("", B), DesignPoint("", moved), DesignLine(B, moved, "construction")]
        if at is not None and abs(at - D) < 3 * frame:
            strokes += [DesignLine(p, at, "direction"), DesignPoint("", at)]
            reciprocal = frame / paper.hand.read_signed(math.copysign(abs(at - D), reciprocal))
        ends.append(complex(frame / paper.hand.read(crank), reciprocal))
    paper.do("design trial", (str(other + 1),), *strokes)
    return ends[0], ends[1]


def _theta(K: float) -> float:
    """Acute angle between the crank's limit positions (rad)."""
    return math.pi * (K - 1.0) / (K + 1.0)
