"""Drawings that degenerate: an instant centre where two nearly parallel lines cross, and a drawing that is made small.

The place of the centre runs away, velocities through it do not; errors of points count the less the larger everything
is drawn.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from graphkin import solver
from graphkin.checking.uncertainty import predict
from graphkin.construction import EXACT, Plan, Scales, execute, pencil, plan
from graphkin.construction.board import Instrument
from graphkin.construction.centres import by_centres, find_centres, speeds
from graphkin.frozen import dataclass
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.model import Mechanism
from graphkin.scene.sheet_tables import Tools
from graphkin.scene.symbol import Symbol
from graphkin.study.equations import Equations
from graphkin.study.reference import reference, refined
from graphkin.study.stability.laws import ErrorLaw, Singularity, binned, grid
from graphkin.words import Phrase

if TYPE_CHECKING:
    from mpmath import MPContext, mpc

__all__ = ["drawing_scale", "parallel_lines"]

SEEDS = 12


def _four_bar(phi: float) -> Mechanism:
    """Crank AB upright, rocker DC at an angle phi to it: their lines cross in the centre of the coupler."""
    c = complex(300, 0) + 120 * complex(math.sin(phi), math.cos(phi))
    return mechanism_of_text(
        f"""
[frame]
points = {{ A = [0, 0], D = [300, 0] }}
[links.1]
points = ["A", "B"]
[links.2]
points = ["B", "C"]
[links.3]
points = ["D", "C"]
[driver]
link = "1"
omega = 10
[drawn]
B = [0, 100]
C = [{c.real!r}, {c.imag!r}]
""",
        "parallel",
    )


@dataclass(frozen=True)
class _Right:
    """The centre of the coupler (m) and the velocity of C (m/s), 50 digits."""

    place: mpc
    velocity: mpc


def _right(scene: Mechanism, mp: MPContext) -> _Right:
    motion = solver.solve(scene)
    equations = reference(motion.structure, mp)
    value, rate, second = scene.drivers[0].values
    start = list(Equations(motion.structure).start(motion)[:, 0])
    found = refined(equations, mp, start, [mp.mpf(value)], [rate], [second])
    k = equations.column["2"]
    z, v, omega = (
        mp.mpc(found.place[k], found.place[k + 1]), mp.mpc(found.rate[k], found.rate[k + 1]), found.rate[k + 2],
    )  # fmt: skip
    _, _, vx, vy, _, _ = equations.point(found, "3", scene.by_name["3"].points["C"])
    return _Right(z + 1j * v / omega if omega else None, mp.mpc(vx, vy))


def _found(scene: Mechanism, right: _Right, hand: Instrument) -> tuple[float, float, bool]:
    """Errors of the centre's place (of its distance) and of the velocity of C through it (relative); whether the
    centre is given as a direction only."""
    centres = find_centres(scene, instrument=hand)
    velocity = by_centres(centres, speeds(centres), Symbol.parse("v_C"))
    off = float(abs(velocity - right.velocity) / abs(right.velocity)) if velocity is not None else math.nan
    point = centres.of("2", "0").point
    if point is None:
        return math.nan, off, True
    place = point / centres.links.mm
    return float(abs(place - right.place) / abs(right.place)), off, False


def parallel_lines(mp: MPContext, samples: int = 2) -> Singularity:
    """Errors against the angle of the two lines that cross in the centre."""
    x = grid(0.5, 1e-15, samples)
    places, velocities = [], []
    stops: float | None = None
    for phi in x:
        scene = _four_bar(phi)
        place, velocity, far = _found(scene, _right(scene, mp), EXACT)
        stops = stops or (phi if far else None)
        places.append(place)
        velocities.append(velocity)
    xs, one = binned(x, places, samples)
    _, two = binned(x, velocities, samples)
    laws = [
        ErrorLaw("centre place", xs, one, -1.0, stops, stops, window=(1e-12, 0.1)),
        ErrorLaw("centre velocity", xs, two, 0.0),
        *_by_pencil(mp),
    ]
    return Singularity("parallel lines", "angle of two lines", tuple(laws), (Phrase("fate centre"),))


def _by_pencil(mp: MPContext) -> list[ErrorLaw]:
    """Root of the mean square over some drawings."""
    x = grid(0.5, 1e-5, 1)
    places, velocities = [], []
    for phi in x:
        scene = _four_bar(phi)
        right = _right(scene, mp)
        rows = [_found(scene, right, pencil(scene.sheet.tools, seed)) for seed in range(SEEDS)]
        places.append(_rms([row[0] for row in rows]))
        velocities.append(_rms([row[1] for row in rows]))
    return [
        ErrorLaw("centre place pencil", tuple(x), tuple(places), -1.0, window=(1e-3, 0.2), lost=1.0),
        ErrorLaw("centre velocity pencil", tuple(x), tuple(velocities), 0.0),
    ]


def _rms(values: list[float]) -> float:
    return math.sqrt(sum(v * v for v in values) / len(values))


POINTS_ONLY = Tools(line_width=0.2, ruler=0.0, compass=0.0, set_square=0.0, protractor=0.0)


def drawing_scale(mp: MPContext, samples: int = 1, name: str = "slider-crank-offset") -> Singularity:
    """Predicted uncertainty of the slider's velocity against the length of the crank on paper, all three figures drawn
    larger alike: errors of points and lengths fall as 1/size, those of set squares stay.

    Parameters
    ----------
    mp, samples : as for the others; not used, since nothing is random here
    """
    scene = mechanism_of(name)
    slider = scene.links[-1]
    symbol = Symbol.parse(f"v_{next(iter(slider.points))}")
    what = plan(scene, find=(symbol,))
    crank = scene.links[0].length or scene.size
    own = crank / what.scales.length
    right = abs(_value(what, symbol))
    x = [1e3 / v for v in grid(0.3e3, 1.0, 1)]  # falling ratios turned into growing sizes, mm
    x = sorted(size for size in x if 3.0 <= size <= 1000.0)
    laws = []
    for key, tools, theory in (("pencil points", POINTS_ONLY, -1.0), ("pencil all", scene.sheet.tools, None)):
        errors = []
        for size in x:
            by = own / size
            scales = Scales(*(s * by for s in (what.scales.length, what.scales.velocity, what.scales.acceleration)))
            predicted = predict(replace(what, scales=scales), "pencil", tools, together=False)
            errors.append(predicted[symbol].deviation / right)
        laws.append(ErrorLaw(key, tuple(x), tuple(errors), theory, lost=1.0))
    return Singularity("small scale", "crank on paper", tuple(laws), (Phrase("fate scale"),))


def _value(what: Plan, symbol: Symbol) -> complex:
    sheet = execute(what, EXACT)
    vector = sheet.vectors("velocity")[symbol]
    return vector.span * sheet.scales.velocity
