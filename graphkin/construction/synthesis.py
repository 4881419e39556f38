"""Mechanisms designed on the drawing board: from the task to the lengths, with ruler, compass, protractor.

Each construction is drawn at its true scale and measured; only the data of the task, and angles computed from them, are
taken as given.  Slider-crank, crank-rocker and guide bar by K after Sun Huan, Mechanical Principles, ch. 8; places of a
bar by the circles of its points, or by inversion (Hartenberg and Denavit, Kinematic Synthesis of Linkages, ch. 9).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import singledispatch
from itertools import pairwise

from graphkin.construction.board.instruments import EXACT, Instrument
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import NO_POINT, Angle, Bar, CompassArc, LineKind, Mark, Ray, Stroke
from graphkin.construction.tasks import TaskBoard, not_drawn
from graphkin.plane import cross, cross_arcs, direction, dot, unit
from graphkin.scene.designs import (
    BarPositionsTask,
    CrankRockerTask,
    DesignTask,
    FunctionTask,
    GuideBarTask,
    LimitsTask,
    SliderCrankTask,
)
from graphkin.scene.symbol import PointRef

SEEN = math.radians(0.05)
"""The least angle (rad) between two lines that is drawn."""


def lines(kind: LineKind, *places: complex) -> list[Bar]:
    """Lines from place to place."""
    return [Bar(a, b, kind=kind) for a, b in pairwise(places)]


def fan(kind: LineKind, apex: complex, *ends: complex) -> list[Bar]:
    """Lines from one place."""
    return [Bar(apex, end, kind=kind) for end in ends]


def arcs(centre: complex, radius: float, *near: complex) -> list[CompassArc]:
    """The arcs of a circle near some points."""
    return [CompassArc(centre, radius, at) for at in near]


def angle(apex: complex, first: complex, second: complex, value: float, name: str = "") -> Angle:
    """An angle (rad) from one direction to another."""
    return Angle(apex, apex + first, apex + second, value, name)


def points(*places: complex, **named: complex) -> list[Mark]:
    """Points without and with names."""
    return [*(Mark(NO_POINT, at) for at in places), *(Mark(PointRef(name), at) for name, at in named.items())]


def pivots(**named: complex) -> list[Mark]:
    """Fixed pivots with their names."""
    return [Mark(PointRef(name), at, fixed=True) for name, at in named.items()]


# the tasks


def construct(task: DesignTask, scale: float = 1.0, instrument: Instrument = EXACT) -> Sheet:
    """Draw a task at a scale (units of length for one mm of paper).

    Raises
    ------
    Unsolvable : lines or arcs that should meet do not
    """
    paper = TaskBoard(instrument, scale=scale)
    draw(task, paper)
    return paper.sheet


def _theta(K: float) -> float:
    """Acute angle between the crank's limit positions (rad)."""
    return math.pi * (K - 1.0) / (K + 1.0)


@singledispatch
def draw(task: DesignTask, paper: TaskBoard) -> None:
    """Draw a task on paper, by its kind."""
    raise TypeError(task)


@draw.register
def _(task: SliderCrankTask, paper: TaskBoard) -> None:
    """The stroke on its line, the crank's pivot on the circle from which the stroke is seen under theta, at the offset:
    crank = (AC1 - AC2) / 2, rod = (AC1 + AC2) / 2 (Sun Huan, ch. 8)."""
    stroke, offset = paper.mm(task.stroke), paper.mm(task.offset)
    near = paper.instrument.point(0j)
    far = paper.lay_off(near, 1 + 0j, stroke)
    paper.step("lay off", "design stroke", *lines("given", near, far), *points(C1=far, C2=near), mm=stroke)
    middle, radius = _locus(paper, far, near, 1, task.K)
    # A lies beyond the near end of the stroke, the offset above its line
    height = near + 1j * paper.instrument.length(offset)
    A = paper.cut("A", height, paper.instrument.direction(1 + 0j), middle, radius)[1]
    parallel = Ray(A, 1 + 0j, complex(far.real, A.imag))
    paper.step("cross", "design parallel", parallel, *pivots(A=A), mm=offset)
    _crank_from_limits(paper, A, far, near)


@draw.register
def _(task: CrankRockerTask, paper: TaskBoard) -> None:
    """Both limit places of the rocker, the crank's pivot on the circle from which their ends are seen under theta, on
    their line if K is 1 (Sun Huan, ch. 8)."""
    half, arm = task.swing / 2, paper.mm(task.rocker)
    D = paper.instrument.point(0j)
    first, second = (paper.lay_off_angle(D, direction(90.0 + side * half), arm) for side in (1, -1))
    swing = math.radians(task.swing)
    paper.step("lay off", "design swing", *fan("given", D, first, second), *pivots(D=D),
               *points(C1=first, C2=second), angle(D, second - D, first - D, swing, "ψ"), angles=(swing,),
               mm=arm)
    frame = paper.mm(task.frame)
    if _theta(task.K) == 0.0:  # crank and rod lie in the line C1C2 in both limit positions
        reach = paper.instrument.compass(frame)
        A = paper.cut("A", second, unit(first - second), D, reach)[0]
        paper.step("read", "design theta", angles=(0.0,), K=task.K)
        paper.step("cross", "design line", Bar(second, A), *arcs(D, reach, A), *pivots(A=A), mm=frame)
    else:
        middle, radius = _locus(paper, first, second, -1, task.K)
        reach = paper.instrument.compass(frame)
        met = cross_arcs(D, reach, middle, radius)
        if met is None:
            raise not_drawn("A", "the arc about d does not reach the", "another frame")
        A = paper.instrument.point(min(met, key=lambda z: z.real))
        paper.step("cross", "design arc", *arcs(D, reach, A), *pivots(A=A), mm=frame)
    _crank_from_limits(paper, A, first, second, CD=(first, D), AD=(A, D))


@draw.register
def _(task: LimitsTask, paper: TaskBoard) -> None:
    """Both limit places of the rocker about given pivots: crank = (AC1 - AC2) / 2, coupler = (AC1 + AC2) / 2."""
    A, D, arm = paper.plot(task.A), paper.plot(task.D), paper.mm(task.rocker)
    first, second = (paper.lay_off_angle(D, direction(angle), arm) for angle in task.angles)
    paper.step("lay off", "design limit positions", *fan("given", D, first, second), *pivots(A=A, D=D),
               *points(C1=first, C2=second), angles=tuple(map(math.radians, task.angles)), mm=arm)
    _crank_from_limits(paper, A, first, second, CD=(first, D), AD=(A, D))


def _locus(paper: TaskBoard, first: complex, second: complex, above: int, K: float) -> tuple[complex, float]:
    """The circle over C1C2 from whose points above the chord (-1: below) it is seen under theta: centre and radius."""
    left, right = sorted((first, second), key=lambda z: z.real)
    theta = _theta(K)
    tilt = math.pi / 2 - theta
    midway, square = paper.bisector(first, second)
    leg = paper.instrument.angle(unit(right - left) * complex(math.cos(tilt), above * math.sin(tilt)))
    centre = paper.meet("O", left, leg, midway, square)
    radius = paper.instrument.compass(abs(first - centre))
    paper.step("read", "design theta", angles=(theta,), K=K)
    legs = right - left, (centre - left) or leg
    turn = legs if (tilt > 0) == (above > 0) else legs[::-1]
    paper.step("cross", "design centre", angle(left, *turn, abs(tilt)),
               *fan("construction", left, centre, right), Ray(midway, square, centre), *points(O=centre),
               CompassArc(centre, radius, first, whole=True), angles=(abs(tilt), theta))
    return centre, radius


def _crank_from_limits(
    paper: TaskBoard, A: complex, first: complex, second: complex, **others: tuple[complex, complex]
) -> None:
    """The crank as half the difference of AC1 and AC2, laid off by the compass, with both limit positions; the lengths,
    those of other bars too."""
    (far, i), (near, j) = sorted(((first, 1), (second, 2)), key=lambda end: -abs(end[0] - A))
    reach = paper.instrument.compass(abs(near - A))
    on_far = paper.instrument.point(A + reach * unit(far - A))  # AC2 laid on AC1: what remains is twice the crank
    crank = paper.instrument.compass(abs(far - on_far) / 2)
    ends = (near - A, far - A) if cross(near - A, far - A) > 0 else (far - A, near - A)
    theta = math.atan2(abs(cross(*ends)), dot(*ends))
    shown = [angle(A, *ends, theta, "θ")] if theta > SEEN else []
    paper.step("carry over", "design halve", *shown, *fan("limit", A, far, near), *arcs(A, reach, on_far),
               points=(f"C{i}", f"C{j}"))
    out, back = paper.instrument.point(A + crank * unit(far - A)), paper.instrument.point(A - crank * unit(near - A))
    paper.step("cross", "design crank circle", CompassArc(A, crank, out, whole=True),
               *points(**{f"B{i}": out, f"B{j}": back}), *lines("limit", A, back),
               *lines("mechanism", A, out, far))
    paper.measure(AB=(A, out), BC=(out, far), **others)


@draw.register
def _(task: GuideBarTask, paper: TaskBoard) -> None:
    """The swing of the guide bar is theta: crank = AC sin(theta / 2), square to the bar in its limit places (Sun Huan,
    ch. 8)."""
    hand, theta, centres, reach = paper.instrument, _theta(task.K), paper.mm(task.centres), paper.mm(task.stroke) / 2
    half = theta / 2
    C = hand.point(0j)
    A = paper.lay_off(C, 1j, centres)
    paper.step("lay off", "design centres", *lines("given", C, A), *pivots(A=A, C=C), mm=centres)
    paper.step("read", "design theta", angles=(theta,), K=task.K)
    left, right = (hand.angle(unit(A - C) * complex(math.cos(half), side * math.sin(half))) for side in (1, -1))
    foot = paper.meet("B1", C, left, A, hand.direction(1j * left))
    other = paper.meet("B2", C, right, A, hand.direction(1j * right))
    far = abs(A - C)
    paper.step("lay off", "design bar limits",
               *(Ray(C, bar, C + 1.15 * far * bar) for bar in (left, right)),
               angle(C, far * right, far * left, theta, "θ"), angles=(half,))
    paper.step("cross", "design feet", *lines("mechanism", A, foot), *lines("limit", A, other),
               *points(B1=foot, B2=other), CompassArc(A, abs(foot - A), foot, whole=True))
    length = hand.length(reach)
    first = paper.meet("D1", C, left, C - length, hand.direction(1j))
    second = paper.meet("D2", C, right, C + length, hand.direction(1j))
    top = hand.point(C + 1j * abs(first - C))
    paper.step("cross", "design bar ends", Bar(C - length, first), Bar(C + length, second),
               *points(D1=first, D2=second), *lines("mechanism", C, first), *lines("limit", C, second),
               mm=reach)
    chord = paper.meet("chord", first, unit(second - first), C, 1j)
    level = hand.point((top + chord) / 2)
    rod = hand.compass(paper.mm(task.rod_length))
    paper.step("line", "design sagitta", *arcs(C, abs(first - C), first, top, second),
               Bar(first, second), Ray(level - length, 1 + 0j, level + length + rod))
    E = paper.cut("E", level, 1 + 0j, first, rod)[0]
    paper.step("cross", "design ram", *arcs(first, rod, E), *points(E1=E), *lines("mechanism", first, E),
               mm=paper.mm(task.rod_length))
    paper.measure(AB=(A, foot), AC=(A, C), CD=(C, first), ram=(C, level))


@draw.register
def _(task: BarPositionsTask, paper: TaskBoard) -> None:
    """Each pivot is the centre of the circle through three places of its point, where two bisectors cross; of given
    pivots, turned back with the bar, each joint is that of three pivots (Hartenberg and Denavit, ch. 9)."""
    bars = [(paper.plot(bar.B), paper.plot(bar.C)) for bar in task.positions]
    ends = {f"{name}{i}": at for i, bar in enumerate(bars, 1) for name, at in zip("BC", bar, strict=True)}
    drawn = [bar for i, places in enumerate(bars) for bar in lines("limit" if i else "given", *places)]
    paper.step("mark", "design places", *drawn, *points(**ends))
    (B, C), *_ = bars
    if task.A is None or task.D is None:
        A, D = (_circle_centre(paper, name, [of + i for i in "123"], on, pivots)
                for name, of, on in zip("AD", "BC", zip(*bars, strict=True), strict=True))
        _chain(paper, "CD", A=A, B=B, C=C, D=D)
        return
    A, D = paper.plot(task.A), paper.plot(task.D)
    paper.step("mark", "design pivots", *pivots(A=A, D=D))
    centres = []
    for name, at, new in (("A", A, "M"), ("D", D, "N")):
        # carried along with the bar, by overlay
        turned = [at, *(paper.instrument.point(B + (at - b) * (unit(C - B) / unit(c - b))) for b, c in bars[1:])]
        strokes: list[Stroke] = []
        for i, z in enumerate(turned[1:], 2):
            strokes += [*points(**{f"{name}{i}": z}), Bar(B, z), Bar(C, z)]
        paper.step("carry over", "design inverted", *strokes, point=name)
        centres.append(_circle_centre(paper, new, [name + i for i in ("", "2", "3")], turned, points))
    _chain(paper, "DN", A=A, M=centres[0], N=centres[1], D=D)


def _circle_centre(
    paper: TaskBoard, name: str, of: Sequence[str], on: Sequence[complex],
    marked: Callable[..., list[Mark]],
) -> complex:
    """The centre of the circle through three points named ``of``: the crossing of the perpendicular bisectors of two
    chords."""
    # the two longest sides give the best crossing
    sides = sorted(((i, j) for i, j in ((0, 1), (1, 2), (0, 2))), key=lambda side: -abs(on[side[1]] - on[side[0]]))
    (i, j), (k, m) = sorted(sides[:2])
    p, d = paper.bisector(on[i], on[j])
    q, e = paper.bisector(on[k], on[m])
    at = paper.meet(name, p, d, q, e)
    paper.step("cross", "design bisectors", Bar(on[i], on[j]), Bar(on[k], on[m]), Ray(p, d, at), Ray(q, e, at),
               *arcs(at, abs(on[0] - at), *on), *marked(**{name: at}), point=name,
               points=(of[i], of[j], of[k], of[m]))
    return at


def _chain(paper: TaskBoard, close: str, **chain: complex) -> None:
    """The four bars of a linkage measured and drawn; ``close`` is the name of the third bar."""
    (a, A), (b, B), (c, C), (d, D) = chain.items()
    bars = {a + b: (A, B), b + c: (B, C), close: (C, D), a + d: (A, D)}
    paper.measure(*lines("mechanism", A, B, C, D), **bars)


@draw.register
def _(task: FunctionTask, paper: TaskBoard) -> None:
    """Two trial cranks, each with the rockers that two pairs of angle pairs need; between the reciprocals of crank and
    rocker each relation is a straight line (Freudenstein's equation is linear in them)."""
    hand, frame = paper.instrument, paper.mm(task.frame)
    A = hand.point(0j)
    D = paper.lay_off(A, 1 + 0j, frame)
    phi, psi = ([hand.angle(direction(pair[i])) for pair in task.pairs] for i in (0, 1))
    rays = [Ray(at, along, at + 0.6 * frame * along) for at, of_pairs in ((A, phi), (D, psi)) for along in of_pairs]
    paper.step("lay off", "design pairs", *lines("given", A, D), *pivots(A=A, D=D), *rays, mm=frame)
    trials = [_trials(paper, A, D, frame, phi, psi, other) for other in (1, 2)]
    # one unit of the diagram, so that what was tried fits beside the mechanism
    per_one = frame / max(1.0, *(max(abs(z.real), abs(z.imag)) for ends in trials for z in ends))
    (p, q), (r, s) = ([hand.point(per_one * z) for z in ends] for ends in trials)
    crossing = paper.meet("AB", p, unit(q - p), r, unit(s - r))
    corner = complex(2.2 * frame, 0.0)
    axes = (1 + 0j, crossing.real), (1j, crossing.imag)
    strokes: list[Stroke] = [Ray(corner, axis, corner + axis * max(0.3 * frame, 1.1 * z)) for axis, z in axes]
    strokes += points(*(corner + z for z in (p, q, r, s)))
    for a, b in ((p, q), (r, s)):
        first, _, last = sorted((a, b, crossing), key=lambda z: (z.real, z.imag))
        strokes.append(Bar(corner + first, corner + last))
    paper.step("cross", "design reciprocals", *strokes, *points(Q=corner + crossing), mm=per_one)
    across, upward = hand.read_signed(crossing.real), hand.read_signed(crossing.imag)
    if min(abs(across), abs(upward)) < 1e-9 * per_one:
        raise not_drawn("design.pairs", "they ask for a bar without end", "other angles")
    crank, rocker = frame * per_one / across, frame * per_one / upward
    B = hand.point(A + hand.length(abs(crank)) * math.copysign(1.0, crank) * phi[0])
    C = hand.point(D + hand.length(abs(rocker)) * math.copysign(1.0, rocker) * psi[0])
    radii = frame, per_one, across, upward
    paper.step("lay off", "design reckoned", *points(B=B, C=C), radii=radii)
    _chain(paper, "CD", A=A, B=B, C=C, D=D)


def _trials(
    paper: TaskBoard, A: complex, D: complex, frame: float, phi: list[complex], psi: list[complex], other: int
) -> tuple[complex, complex]:
    """Two points of a line in the diagram of reciprocals: frame over crank, frame over rocker."""
    back = psi[0] / psi[other]
    cranks = []
    for share in (0.4, 0.9, 0.65, 0.3, 1.3):
        crank = paper.instrument.length(share * frame)
        B, moved = A + crank * phi[0], paper.instrument.point(D + (A + crank * phi[other] - D) * back)
        if abs(moved - B) < 1e-9 * frame:
            continue
        p, d = paper.bisector(B, moved)
        normal = -1j * d
        # the ray of the rocker and the bisector meet at frame / reciprocal from D
        level = dot(p - D, normal)
        if abs(level) < 1e-6 * frame:
            continue
        cranks.append((crank, frame * dot(psi[0], normal) / level, B, moved, (p, d)))
        if len(cranks) == 2:
            break
    if len(cranks) < 2:
        raise not_drawn("design.pairs", "no trial crank tells the pairs apart", "other pairs")
    strokes: list[Stroke] = []
    ends = []
    for crank, reciprocal, B, moved, (p, d) in cranks:
        strokes += [*points(B, moved), Bar(B, moved)]
        at = D + psi[0] * (frame / reciprocal) if abs(reciprocal) > 1e-9 else None
        if at is not None and abs(at - D) < 3 * frame:
            strokes += [Ray(p, d, at), *points(at)]
            reciprocal = frame / paper.instrument.read_signed(math.copysign(abs(at - D), reciprocal))
        ends.append(complex(frame / paper.instrument.read(crank), reciprocal))
    paper.step("trial", "design trial", *strokes, point=f"B{other + 1}")
    return ends[0], ends[1]
