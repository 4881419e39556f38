"""Stated error bounds of larger groups against 50 digits: part of ``python -m tests.bench.accuracy``.

Triads with turning and with sliding pairs, groups with a closed contour of four links, groups of six links, drivers on
links that hang on the frame by nothing; driven by a crank or by the coupler of a four-bar, some with a dyad behind
them.  Half of the positions are near the ends of the motion.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from graphkin.errors import GraphkinError
from graphkin.scene import mechanism_of
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.scene.pairs import PlacedGuide
from graphkin.solver.algebra.bounds import most_of
from graphkin.solver.algebra.pose import Drive
from graphkin.solver.compiled.engine import State, positions
from graphkin.solver.drivers import meant, meant_direction, own_values
from graphkin.solver.path.assemblies import choose_modes
from graphkin.solver.path.continuity import Path, follow_path
from graphkin.solver.path.dead_points import singular
from graphkin.structure import Driven, Dyad, LargerGroup, Structure, analyse
from graphkin.study.equations import Arithmetic, Equations, context

from .tally import Tally

__all__ = ["measure_larger", "random_larger"]

Places = dict[str, complex]


def _near(rng: np.random.Generator, centre: complex, wide: float) -> complex:
    z = centre + complex(*rng.uniform(-wide, wide, 2))
    return complex(round(z.real, 3), round(z.imag, 3))


def _pair(z: complex) -> list[float]:
    return [z.real, z.imag]


class _Draft:
    """A scene in the making: where its points lie, its links and guides."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng
        self.at: Places = {}
        self.fixed: list[str] = []
        self.links: dict[str, Any] = {}
        self.guides: dict[str, Any] = {}

    def point(self, name: str, centre: complex, wide: float, fixed: bool = False) -> str:
        self.at[name] = _near(self.rng, centre, wide)
        self.fixed += [name] if fixed else []
        return name

    def link(self, *points: str, guide: str = "") -> str:
        """A link through points; with a guide one that slides."""
        name = str(len(self.links) + 1)
        given: dict[str, Any] = {"points": list(points[:2])}
        if len(points) > 1:
            way = self.at[points[1]] - self.at[points[0]]
            given["length"] = round(abs(way), 3)
            local = {p: (self.at[p] - self.at[points[0]]) * abs(way) / way for p in points[2:]}
            given["at"] = {p: [round(z.real, 3), round(z.imag, 3)] for p, z in local.items()}
        if guide:
            given["on"] = guide
        self.links[name] = given
        return name

    def scene(self, driver: str, first: str, second: str) -> Mechanism:
        angle = math.degrees(np.angle(self.at[second] - self.at[first]))
        rng = self.rng
        return mechanism_of({
            "frame": {"points": {p: _pair(self.at[p]) for p in self.fixed}, "guides": self.guides},
            "links": self.links,
            "driver": {
                "link": driver, "angle": round(angle, 3), "omega": round(float(rng.uniform(-20, 20)), 3),
                "alpha": round(float(rng.uniform(-50, 50)), 3),
            },
            "sketch": {p: _pair(z) for p, z in self.at.items() if p not in self.fixed},
        })


def _triad(d: _Draft, hang: str) -> str:
    for name, centre in (("C", 120 + 90j), ("D", 210 + 90j), ("E", 150 + 170j)):
        d.point(name, centre, 50)
    d.link(hang, "C")
    d.link("C", "D", "E")
    d.link(d.point("G", 250 + 20j, 60, True), "D")
    kind = int(d.rng.integers(3))
    if kind == 0:
        d.link(d.point("H", 60 + 260j, 60, True), "E")
    elif kind == 1:
        angle = round(float(d.rng.uniform(-180, 180)), 2)
        d.guides["g"] = {"through": _pair(d.at["E"]), "angle": angle}
        d.link("E", guide="0.g")
    else:
        bar = d.link(d.point("H", 60 + 260j, 60, True))
        d.link("E", guide=bar)
    return "E"


def _contour(d: _Draft, hang: str) -> str:
    """Two plates joined by two bars: a closed contour of four links."""
    for name, centre in (("C", 130 + 60j), ("D", 130 + 160j), ("E", 250 + 60j), ("F", 250 + 160j)):
        d.point(name, centre, 45)
    d.link(hang, "C", "D")
    d.link("C", "E")
    d.link("D", "F")
    d.link(d.point("G", 330 + 80j, 50, True), "E", "F")
    return "F"


def _six(d: _Draft, hang: str) -> str:
    """Two plates hinged to each other, each on two bars."""
    for name, centre in (("C", 110 + 90j), ("D", 90 + 190j), ("E", 200 + 140j), ("F", 300 + 190j), ("G", 290 + 90j)):
        d.point(name, centre, 45)
    d.link(hang, "C")
    d.link("C", "E", "D")
    d.link(d.point("H", 20 + 260j, 50, True), "D")
    d.link("E", "F", "G")
    d.link(d.point("K", 330 + 280j, 50, True), "F")
    d.link(d.point("L", 340 - 10j, 50, True), "G")
    return "F"


_GROUPS: tuple[Callable[[_Draft, str], str], ...] = (_triad, _triad, _contour, _six)


def random_larger(rng: np.random.Generator) -> Mechanism:
    """A mechanism with a group that has no closed form."""
    d = _Draft(rng)
    d.point("A", 0j, 1, True)
    d.point("B", 0j, 60)
    if rng.random() < 0.2:
        # the coupler of a four-bar is driven, and the crank follows
        d.point("C", 250 + 150j, 60)
        d.link("A", "B")
        coupler = d.link("B", "C")
        d.link(d.point("D", 300 + 0j, 60, True), "C")
        return d.scene(coupler, "B", "C")
    crank, hang = d.link("A", "B"), "B"
    if rng.random() < 0.3:
        d.point("M", -150 + 120j, 50)
        hang = d.point("N", 40 + 90j, 40)
        d.link("B", "M", "N")
        d.link(d.point("O", -200 + 0j, 50, True), "M")
    last = _GROUPS[int(rng.integers(len(_GROUPS)))](d, hang)
    if rng.random() < 0.3:
        d.point("U", d.at[last] + 120, 40)
        d.link(last, "U")
        d.link(d.point("V", d.at[last] + 120 - 150j, 40, True), "U")
    return d.scene(crank, "A", "B")


def measure_larger(positions_: int, seed: int, each: int = 20) -> Tally:
    """Hold bounds against true errors at about so many positions, so many of each mechanism."""
    rng = np.random.default_rng(seed)
    tally = Tally()
    while tally.looked_at < positions_:
        try:
            structure = analyse(random_larger(rng))
            modes = choose_modes(structure)
            path, t = _some(rng, structure, modes, each)
        except GraphkinError:
            continue
        drive = Drive.at(structure, path.values(t))
        state = positions(structure, drive, path.mode(t))
        told = most_of(state.bounds(structure, np.ones(len(t), dtype=bool)).values())
        for k, off in _offs(structure, drive, state, tally):
            bounds = [float(b[k]) for b in told]
            tally.hold(bounds, off, f"at {drive.value[k, 0]!r} of {structure.scene}")
    return tally


def _some(
    rng: np.random.Generator, structure: Structure, modes: dict[int, Any], n: int
) -> tuple[Path, np.ndarray]:
    """A path from the scene's own position, and parameters on it: half anywhere, half near its end."""
    start = own_values(structure.scene)
    path = follow_path(structure, modes, start, start + math.copysign(2 * np.pi, rng.random() - 0.5))
    near = path.reach * (1 - 10.0 ** rng.uniform(-12, -1, n))
    close = (rng.random(n) < 0.5) & (path.limit is not None)
    return path, np.where(close, near, rng.uniform(0, path.reach, n))


def _offs(structure: Structure, drive: Drive, state: State, tally: Tally) -> Iterator[tuple[int, list[float]]]:
    """Number of each position that is given out, and how far it is from the truth: the most of any point of any link in
    place, velocity and acceleration, the most of any link in angle, rate and second rate."""
    n = len(drive)
    dead = np.zeros(n, dtype=bool)
    for _, here in singular(structure, state, n):
        dead |= here
    exact = _Exact(structure)
    for k in range(n):
        if dead[k]:
            tally.refused += 1
            continue
        try:
            yield k, exact.off(drive, state, k)
        except ArithmeticError:
            tally.lost += 1


class _Exact:
    """The closure equations of a mechanism with the numbers that stand in its file, in 50 digits."""

    def __init__(self, structure: Structure) -> None:
        self.mp = context()
        self.structure = structure
        turn = 2 * self.mp.pi
        self.equations = Equations(_meant(structure, self.mp), Arithmetic(
            cos=np.frompyfunc(self.mp.cos, 1, 1),
            sin=np.frompyfunc(self.mp.sin, 1, 1),
            arg=lambda z: self.mp.arg(self.mp.mpc(z)),
            unturned=lambda d: d - turn * self.mp.nint(d / turn),
            solve=self._solve,
        ))

    def _solve(self, matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
        """In 16 digits, again and again on what is left."""
        inverse = np.linalg.inv(matrix.astype(float))
        found = right * 0
        for _ in range(60):
            left = right - matrix @ found
            most = max(abs(x) for x in left)
            if most == 0:
                return found
            step = (inverse @ np.array([float(x / most) for x in left])) * most
            found = found + step
            if max(abs(x) for x in step) < 1e-40 * max(abs(x) for x in found):
                return found
        raise ArithmeticError("no solution")

    def off(self, drive: Drive, state: State, k: int) -> list[float]:
        mp, equations = self.mp, self.equations
        x: list[Any] = []
        for name in equations.names:
            pose = state.poses[name]
            z, u = (complex(np.broadcast_to(p, (len(drive),))[k]) for p in (pose.z, pose.u))
            x += [z.real, z.imag, float(np.angle(u))]
        at = np.array([mp.mpf(v) for v in x], dtype=object)
        values = [mp.mpf(float(v)) for v in drive.value[k]]
        for _ in range(40):
            new = equations.improved(at, values)
            moved, at = max(abs(v) for v in new - at), new
            if moved < mp.mpf(10) ** -38:
                break
        else:
            raise ArithmeticError("Newton's method does not converge")
        rates = ([mp.mpf(str(meant(float(v))[0])) for v in row[k]] for row in (drive.rate, drive.second))
        solved = equations.rates(at, values, *rates)
        worst = [0.0] * 6
        for name in equations.names:
            pose = state.poses[name]
            c = equations.column[name]
            mine = [complex(np.broadcast_to(getattr(pose, f), (len(drive),))[k]) for f in
                    ("z", "u", "v", "omega", "a", "alpha")]
            turned = mp.expj(solved.place[c + 2])
            worst[3] = max(worst[3], float(abs(mp.mpc(mine[1]) - turned)))
            worst[4] = max(worst[4], float(abs(mine[3].real - solved.rate[c + 2])))
            worst[5] = max(worst[5], float(abs(mine[5].real - solved.second[c + 2])))
            places = ([0j, *s.links[name].points.values()] for s in (self.structure, equations.structure))
            for place, own in zip(*places, strict=True):
                point = equations.point(solved, name, own)
                z, u, v, omega, a, alpha = mine
                arm = u * place
                found = z + arm, v + 1j * omega * arm, a + (1j * alpha - omega * omega) * arm
                for order in range(3):
                    far = mp.mpc(found[order]) - mp.mpc(point[2 * order], point[2 * order + 1])
                    worst[order] = max(worst[order], float(abs(far)))
        return worst


def _meant(structure: Structure, mp: Any) -> Structure:
    """The same structure with places and directions in 50 digits, as the file gives them."""

    def number(z: complex) -> Any:
        return mp.mpc(*(mp.mpf(str(meant(x)[0])) for x in (z.real, z.imag)))

    def direction(z: complex) -> Any:
        (x, y), _ = meant_direction(z)
        return mp.mpc(mp.mpf(str(x)), mp.mpf(str(y)))

    def guide(g: PlacedGuide) -> PlacedGuide:
        return replace(g, through=number(g.through), direction=direction(g.direction))

    def link(x: PlacedLink) -> PlacedLink:
        return replace(x, points={p: number(z) for p, z in x.points.items()})

    slides = {s.key: replace(s, guide=guide(s.guide), turn=direction(s.turn)) for s in structure.slides}

    def pairs(found: Sequence[Any]) -> tuple[Any, ...]:
        return tuple(slides.get(getattr(p, "key", ""), p) for p in found)

    def element(e: Driven | Dyad | LargerGroup) -> Driven | Dyad | LargerGroup:
        if isinstance(e, Driven):
            return replace(e, pair=pairs([e.pair])[0])
        if isinstance(e, Dyad):
            inner, first, second = pairs([e.inner, e.outer_first, e.outer_second])
            return replace(e, inner=inner, outer_first=first, outer_second=second)
        return replace(e, pairs=pairs(e.pairs))

    return replace(
        structure, links={n: link(x) for n, x in structure.links.items()}, slides=tuple(slides.values()),
        elements=tuple(element(e) for e in structure.elements),
    )
