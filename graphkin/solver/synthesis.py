"""Lengths of a mechanism that meets a wish, in closed form, and the refusal of a wish that none can meet.

Slider-crank and crank-rocker by K after Sun Huan, Mechanical Principles, ch. 8; three angle pairs after Freudenstein,
Approximate synthesis of four-bar linkages, Trans. ASME 77 (1955).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import singledispatch

import numpy as np
from numpy.typing import NDArray

from graphkin.errors import Problem, Unsolvable
from graphkin.plane import cross, direction, unit
from graphkin.scene.designs import (
    BarPositionsTask,
    CrankRockerTask,
    DesignTask,
    FunctionTask,
    GuideBarTask,
    LimitsTask,
    SliderCrankTask,
)
from graphkin.search import last_true, least_value
from graphkin.words import Phrase, Wording

IN_LINE = 1e-12  # of the size: three points whose circle is larger than this allows lie in one line
ABOUT_D = 1e-6  # of the rocker: a circle over C1C2 that leaves less room for A is that about D


@dataclass(frozen=True)
class Synthesis:
    """The found mechanism, in the unit of the file.

    lengths : of each bar by its two points ("ram": distance of the ram's line from C)
    pivots : the fixed pivots
    places : all points in the scene's position
    turned : bars opposite to the asked angles
    least : the least transmission angle (degrees); None without a changing one
    """

    task: DesignTask
    lengths: Mapping[str, float]
    pivots: Mapping[str, complex]
    places: Mapping[str, complex]
    turned: tuple[str, ...] = ()
    least: float | None = None


@dataclass(frozen=True)
class FreeDatum:
    """A free datum: from ``low`` to ``high`` it meets the rest of the wish; ``best`` gives the
    greatest ``least`` transmission angle (degrees)."""

    key: str
    low: float
    high: float
    best: float
    least: float
    at: Callable[[float], float | None] = field(compare=False)


def _refused(where: str, found: str, wanted: Wording, **gaps: object) -> Unsolvable:
    """The refusal of a datum; numbers in its gaps have six digits."""
    said = {gap: f"{value:.6g}" if isinstance(value, float) else value for gap, value in gaps.items()}
    return Unsolvable("not assembled", Problem(f"design.{where}", found, wanted, **said))


def _quick_return(K: float, most: float | None = None) -> float:
    if K <= 1.0:
        raise _refused("K", "is no quick return", "k must be above 1", key=K)
    return _lag(K, most)


def _lag(K: float, most: float | None = None) -> float:
    """The acute angle of the crank between its limit positions (rad), pi (K - 1) / (K + 1), 0 for K = 1."""
    if K < 1.0:
        raise _refused("K", "is below 1", "k is the longer of two ways over", key=K)
    if most is not None and most <= K:
        raise _refused("K", "cannot be reached", "k must be below here", key=K, most=most)
    return math.pi * (K - 1.0) / (K + 1.0)


@singledispatch
def synthesise(task: DesignTask) -> Synthesis:
    """Find the lengths.

    Raises
    ------
    Unsolvable : no mechanism of this kind meets the wish, with the nearest value that one can meet
    """
    raise TypeError(task)


@synthesise.register
def _(task: SliderCrankTask) -> Synthesis:
    H, e = task.stroke, task.offset
    if task.K == 1.0:
        raise _refused("K", "1 leaves the rod free offset 0 a", "k must be above 1")
    theta = _quick_return(task.K, 3.0)
    if e == 0.0:
        raise _refused("offset", "offset zero gives k 1", "an offset greater than 0", K=task.K)
    greatest = H / math.tan(theta)
    if e >= greatest:
        raise _refused("offset", "is too large for k", "it must be below", value=e, key=task.K, greatest=greatest)
    half = math.tan(theta / 2.0)
    # AC1 = BC + AB and AC2 = BC - AB enclose theta over the chord H, at the height e over it
    crank = math.sqrt(H * (H - 2.0 * e * half)) / 2.0
    rod = math.sqrt(H * (H + 2.0 * e / half)) / 2.0
    at = 60.0
    B = crank * direction(at)
    C = complex(B.real + math.sqrt(rod**2 - (B.imag + e) ** 2), -e)
    least = math.degrees(math.acos((crank + e) / rod))
    return Synthesis(task, {"AB": crank, "BC": rod}, {"A": 0j}, {"A": 0j, "B": B, "C": C}, least=least)


@synthesise.register
def _(task: CrankRockerTask) -> Synthesis:
    c, d = task.rocker, task.frame
    if task.swing >= 180.0:
        raise _refused("swing", "is too wide for a rocker", "it must be below 180 degrees", swing=task.swing)
    psi = math.radians(task.swing)
    # beyond it the circle over the chord lies between the arms of the rocker
    widest = math.pi / 2 + psi / 2
    theta = _lag(task.K, (math.pi + widest) / (math.pi - widest))
    low, high = sorted((c, c * abs(math.sin(psi - theta)) / math.sin(theta) if theta else math.inf))
    if high - low <= ABOUT_D * c:
        raise _refused("swing", "is twice 180 k 1 k 1 the", "another swing or another k", swing=task.swing)
    if not theta and d <= c:
        longer = Phrase("it must be greater than the rocker", name=f"{c:.6g}")
        raise _refused("frame", "with a lies between c1 and c2 on", longer, name=d)
    if not low < d < high:
        found, wanted = "the circle about d with does not cut", "it must lie between and"
        raise _refused("frame", found, wanted, name=d, least=low, greatest=high)
    first, second = c * direction(90.0 + task.swing / 2), c * direction(90.0 - task.swing / 2)
    # A lies so far from D along the middle of the swing, where the circle over the chord and that about D cross; the
    # circle of K = 1 is the line C1C2
    up = (d**2 * math.sin(theta) + c**2 * math.sin(theta - psi)) / (2.0 * c * math.sin(theta - psi / 2))
    A = complex(-math.sqrt(max(0.0, (d - up) * (d + up))), up)
    return _crank_rocker(task, A, 0j, first, second, standing=False)


@synthesise.register
def _(task: LimitsTask) -> Synthesis:
    first, second = (task.D + task.rocker * direction(angle) for angle in task.angles)
    if abs(task.A - task.D) < 1e-12 * task.rocker:
        raise _refused("A", "lies where d lies", "two pivots apart from each other")
    if abs(first - second) < 1e-12 * task.rocker:
        raise _refused("angles", "the two limit positions are one", "two different angles")
    return _crank_rocker(task, task.A, task.D, first, second, standing=True)


def _crank_rocker(
    task: CrankRockerTask | LimitsTask, A: complex, D: complex, first: complex, second: complex, standing: bool
) -> Synthesis:
    """The four-bar with these limit positions, in its place or with A and D on the x axis."""
    far, near = max(abs(first - A), abs(second - A)), min(abs(first - A), abs(second - A))
    AB, BC, CD, AD = (far - near) / 2, (far + near) / 2, abs(first - D), abs(A - D)
    sides = cross(D - A, first - A), cross(D - A, second - A)
    if AB < 1e-12 * BC:
        raise _refused("A", "lies as far from c1 as from c2", "move a off the line midway")
    if sides[0] * sides[1] <= 0.0:
        raise _refused("A", "lies between the lines c1d and c2d so", "move a to one side of both lines")
    side = 1.0 if sides[0] > 0 else -1.0
    if not standing:
        A, D = 0j, complex(AD, 0.0)
    B = A + AB * unit(D - A) * direction(60.0)
    C = _third(B, BC, D, CD, side)
    least = _least_transmission(AB, BC, CD, AD)
    lengths = {"AB": AB, "BC": BC, "CD": CD, "AD": AD}
    return Synthesis(task, lengths, {"A": A, "D": D}, {"A": A, "B": B, "C": C, "D": D}, least=least)


def _third(p: complex, r: float, q: complex, s: float, side: float) -> complex:
    """The corner of a triangle over pq, ``side`` of it: +1 left where r lies on p."""
    c = abs(q - p)
    along = ((r - s) * (r + s) / c + c) / 2.0
    height = math.sqrt(max(0.0, (r - along) * (r + along)))
    # B turns about A: the side of the rocker's point from the line BD is that from AD
    return p + unit(q - p) * complex(along, side * height)


def _least_transmission(AB: float, BC: float, CD: float, AD: float) -> float:
    """The least angle between coupler and rocker, with crank and frame collinear (degrees)."""
    angles = []
    for across in (AD + AB, abs(AD - AB)):
        cosine = (BC**2 + CD**2 - across**2) / (2.0 * BC * CD)
        angle = math.degrees(math.acos(min(1.0, max(-1.0, cosine))))
        angles.append(min(angle, 180.0 - angle))
    return min(angles)


@synthesise.register
def _(task: GuideBarTask) -> Synthesis:
    half = _quick_return(task.K) / 2.0
    AB, CD = task.centres * math.sin(half), task.stroke / (2.0 * math.sin(half))
    ram = CD * (1.0 + math.cos(half)) / 2.0
    sagitta = CD - CD * math.cos(half)
    shortest = sagitta / (2.0 * math.cos(half))
    rod = task.rod_length
    if rod <= shortest:
        raise _refused("rod", "is too short to let the ram rest", "it must exceed", rod=rod, shortest=shortest)
    C = complex(0.0, -task.centres)
    B = AB * direction(30.0)
    D = C + CD * unit(B - C)
    height = C.imag + ram
    E = complex(D.real + math.sqrt(rod**2 - (D.imag - height) ** 2), height)
    lengths = {"AB": AB, "AC": task.centres, "CD": CD, "ram": ram}
    least = math.degrees(math.acos(sagitta / 2.0 / rod))
    places = {"A": 0j, "B": B, "C": C, "D": D, "E": E}
    return Synthesis(task, lengths, {"A": 0j, "C": C}, places, least=least)


@synthesise.register
def _(task: BarPositionsTask) -> Synthesis:
    bars, others = task.positions, "other pivots or other positions"
    ends = {"B": bars[0].B, "C": bars[0].C}
    if task.A is None or task.D is None:
        A, D = (_centre(tuple(getattr(bar, end) for bar in bars), end, "three different places") for end in "BC")
        chain = {"A": A, **ends, "D": D}
        names = "AB", "BC", "CD", "AD"
    else:
        A, D = task.A, task.D
        if abs(A - D) <= IN_LINE * abs(bars[0].C - bars[0].B):
            raise _refused("A", "lies where d lies", "two pivots apart from each other")
        M, N = (_centre(tuple(bar.moved(z, bars[0]) for bar in bars), name, others) for name, z in (("A", A), ("D", D)))
        chain = {"A": A, "M": M, "N": N, "D": D}
        names = "AM", "MN", "DN", "AD"
    lengths = {name: abs(chain[name[1]] - chain[name[0]]) for name in names}
    for name, length in lengths.items():
        if length <= IN_LINE * max(lengths.values()):
            raise _refused("positions", "and fall together", others, key=name[0], other=name[1])
    return Synthesis(task, lengths, {k: z for k, z in chain.items() if k not in ends}, chain | ends)


def _centre(points: tuple[complex, ...], letter: str, apart: str) -> complex:
    """The centre of the circle through three points; ``apart`` names what would make them different."""
    a, b, c = points
    size = max(abs(b - a), abs(c - b), abs(a - c))
    if min(abs(b - a), abs(c - b), abs(a - c)) <= IN_LINE * size:
        raise _refused("positions", "two of the places of are one so", apart, letter=letter)
    area = cross(b - a, c - a)
    if abs(area) <= IN_LINE * size**2:
        found, wanted = "the three places of lie in one line", "a slide along that line or another point"
        raise _refused("positions", found, wanted, letter=letter)
    u, v = b - a, c - a
    return a + 1j * (v * abs(u) ** 2 - u * abs(v) ** 2) / (-2.0 * area)


@synthesise.register
def _(task: FunctionTask) -> Synthesis:
    # Freudenstein: K1 cos psi - K2 cos phi + K3 = cos(phi - psi), K1 = AD/AB, K2 = AD/CD
    phi, psi = (np.radians([pair[i] for pair in task.pairs]) for i in (0, 1))
    lines = np.column_stack([np.cos(psi), -np.cos(phi), np.ones(3)])
    if np.linalg.cond(lines) > 1e12:
        raise _refused("pairs", "the three pairs fix no four-bar", "three pairs that differ in both angles")
    k = np.linalg.solve(lines, np.cos(phi - psi))
    if min(abs(k[0]), abs(k[1])) < 1e-9:
        raise _refused("pairs", "they ask for a bar without end", "change one of the angles")
    AB, CD = (float(task.frame / k[i]) for i in (0, 1))
    A, D = 0j, complex(task.frame, 0.0)
    B, C = A + AB * direction(task.pairs[0][0]), D + CD * direction(task.pairs[0][1])
    turned = tuple(name for name, length in (("AB", AB), ("CD", CD)) if length < 0)
    lengths = {"AB": abs(AB), "BC": abs(C - B), "CD": abs(CD), "AD": task.frame}
    if lengths["BC"] < IN_LINE * max(lengths.values()):
        raise _refused("pairs", "b and c fall together", "change one of the angles")
    return Synthesis(task, lengths, {"A": A, "D": D}, {"A": A, "B": B, "C": C, "D": D}, turned)


_FREE: dict[type[DesignTask], str] = {SliderCrankTask: "offset", CrankRockerTask: "frame", LimitsTask: "rocker"}
_SAMPLES, _NEAR = 400, 1e-9


def choice(task: DesignTask) -> FreeDatum | None:
    """The free datum of a wish, with its best value for the transmission; None without a free datum, or without a best
    value."""
    key = _FREE.get(type(task))
    if key is None:
        return None

    def least(value: float) -> float | None:
        try:
            return synthesise(replace(task, **{key: value})).least  # type: ignore[arg-type]
        except (Unsolvable, ValueError):
            return None

    def transmission(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array([np.nan if (angle := least(float(value))) is None else angle for value in values])

    now = getattr(task, key)
    size = max(now, abs(task.A - task.D) if isinstance(task, LimitsTask) else now)
    grid = np.geomspace(1e-3, 1e2, _SAMPLES) * size
    angles = transmission(grid)
    i = int(np.argmax(np.nan_to_num(angles)))
    if np.isnan(angles[i]) or i in (0, _SAMPLES - 1):  # the better, the smaller or the larger it is
        return None
    # as far to both sides as nothing is refused; what may be as small as one likes may come near 0
    refused = np.flatnonzero(np.isnan(angles))
    first, last = max(refused[refused < i], default=-1) + 1, min(refused[refused > i], default=_SAMPLES) - 1
    low, high = 0.0, float(grid[last])

    def meets(values: NDArray[np.float64]) -> NDArray[np.bool_]:
        return ~np.isnan(transmission(values))

    if first > 0:
        low = last_true(meets, float(grid[first]), float(grid[first - 1]), 2, _NEAR * size)
    if last < _SAMPLES - 1:
        high = last_true(meets, high, float(grid[last + 1]), 2, _NEAR * size)
    around = max(low, float(grid[max(i - 1, 0)])), min(high, float(grid[min(i + 1, _SAMPLES - 1)]))
    best, angle = least_value(lambda values: -transmission(values), *around, within=_NEAR * size)
    return FreeDatum(key, low, high, best, -angle, least)
