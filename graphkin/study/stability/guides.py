"""Guide bars: the flip of a bar whose pivot the crank pin passes through, and sliding that nearly stops."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from graphkin import solver
from graphkin.checking.uncertainty import predict
from graphkin.construction import EXACT, execute, plan
from graphkin.construction.remarks import ShortArm
from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of_text
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.solver import Motion
from graphkin.study.stability.laws import LOST, ErrorLaw, Singularity, binned, grid, in_powers, measured
from graphkin.words import Phrase
from graphkin.words.written import true_minus

if TYPE_CHECKING:
    from mpmath import MPContext, mpc, mpf

__all__ = ["flip", "near_ground", "slow_sliding"]

FLOOR = 1e-17  # of the charts
NEAR = (1e-8, 0.03)  # over which slopes are fitted beside the pivot of a bar
BAR_LAWS = "place bar", "acceleration Coriolis", "acceleration bar"

_BAR = """
[frame]
points = {{ A = [0, {ground}], C = [0, 0] }}
[links.1]
points = ["A", "B"]
length = {crank}
[links.2]
points = ["B"]
on = "3"
[links.3]
points = ["C"]
[driver]
link = "1"
angle = {angle}
omega = 10
"""


def _at(scene: Mechanism, angle: float) -> Mechanism:
    driver = scene.drivers[0]
    return replace(scene, drivers=(replace(driver, value=angle),))


@dataclass(frozen=True)
class _Bar:
    """The motion of a bar that swings about C on the pin of the crank: direction, rate, second rate, Coriolis."""

    u: mpc | complex
    omega: mpf | float
    alpha: mpf | float
    coriolis: mpf | float

    def off(self, found: _Bar) -> tuple[float, float, float]:
        """Errors of another: of the direction (rad), of Coriolis and of the second rate (relative)."""
        turned = abs(found.u.imag * self.u.real - found.u.real * self.u.imag)
        return float(turned), float(abs(found.coriolis / self.coriolis - 1)), float(abs(found.alpha / self.alpha - 1))


def _right(mp: MPContext, a: mpf, d: mpf, rate: float, angle: mpf) -> _Bar:
    """By the way w from C to the pin B: omega = Im w'/w, sliding = Re w'/w |w|."""
    b = a * mp.expj(angle)
    w, dw, ddw = mp.mpc(0, d) + b, 1j * rate * b, -rate * rate * b
    turn = dw / w
    omega, slip = turn.imag, turn.real * abs(w)
    return _Bar(w / abs(w), omega, (ddw / w - turn * turn).imag, 2 * omega * slip)


def _doubles(scene: Mechanism, angle: float) -> _Bar:
    """The closed form in doubles, no more digits where these do not suffice; nan where it refuses."""
    asked = ("theta_3", "omega_3", "alpha_3", "v_B@2/B@3")
    found = solver.prepare(_at(scene, angle), asked).at(angle)
    if found is None:
        return _Bar(complex(math.nan, math.nan), math.nan, math.nan, math.nan)
    theta, omega, alpha, x, y = found
    u = complex(math.cos(theta), math.sin(theta))
    return _Bar(u, omega, alpha, 2 * omega * (x * u.real + y * u.imag))


def _solved(scene: Mechanism) -> tuple[_Bar, Motion] | None:
    """What the solver gives; None where it refuses."""
    motion = solver.solve(scene)
    if motion.status[0] != "ok":
        return None
    slide = motion.slide("2/3")
    u, omega = complex(motion.poses["3"].u[0]), float(motion.omega("3")[0])
    return _Bar(u, omega, float(motion.alpha("3")[0]), 2 * omega * float(slide.velocity[0])), motion


def near_ground(mp: MPContext, samples: int = 4) -> Singularity:
    """Crank nearly as long as the ground, its pin beside the bar's pivot C, both at a distance of the same order.

    Coriolis grows as distance^-1, the second rate of the bar as distance^-2, their relative errors as distance^-1.
    """
    x = grid(0.3, 1e-8, samples)
    rows, sizes, solved = [], [], []
    for e in x:
        scene = mechanism_of_text(_BAR.format(ground=100, crank=repr(100 * (1 - e)), angle=-90), "near")
        rate, a = scene.drivers[0].values[1], abs(scene.by_name["1"].points["B"])
        angle = -math.pi / 2 + e
        right = _right(mp, mp.mpf(a), mp.mpf(scene.frame.points["A"].imag), rate, mp.mpf(angle))
        rows.append(right.off(_doubles(_at(scene, angle), angle)))
        one = _solved(_at(scene, angle))
        solved.append(right.off(one[0])[2] if one else math.nan)
        sizes.append((float(abs(right.coriolis / (a * rate**2))), float(abs(right.alpha / rate**2))))
    laws = [ErrorLaw(name, theory=-1.0, window=NEAR) for name in BAR_LAWS]
    sized = [ErrorLaw("size Coriolis", theory=-1.0, window=(1e-12, 0.03), lost=math.inf),
             ErrorLaw("size bar", theory=-2.0, window=(1e-12, 0.03), lost=math.inf)]  # fmt: skip
    growth = measured(sized, x, sizes, samples)
    grown = Phrase("grows", tuple(true_minus(f"{law.slope:.2f}") for law in growth))
    found = measured(laws, x, rows, samples)
    told = max((e for e in solved if math.isfinite(e)), default=math.nan)
    fates = grown, Phrase("fate near ground", (in_powers(found[2].worst), in_powers(told)))
    return Singularity("near ground", "crank from ground", found, fates, growth)


def flip(mp: MPContext, samples: int = 4) -> Singularity:
    """Crank as long as the ground: its pin B passes through the bar's pivot C, and the bar flips over.

    With the crank turned by e from there, CB = 2 a sin(e/2) and the bar turns at half the speed of the crank: nothing
    grows, but the direction of CB is told by a length that goes to zero, the rate by that and once more by the length.
    """
    scene = mechanism_of_text(_BAR.format(ground=100, crank=100, angle=-80), "flip")
    rate, a = scene.drivers[0].values[1], abs(scene.by_name["1"].points["B"])
    x = grid(0.5, 1e-9, samples)
    plain, refined, bounds, drawn = [], [], [], []
    stops: dict[str, float] = {}
    for k, e in enumerate(x):
        angle = -math.pi / 2 + e
        right = _right(mp, mp.mpf(a), mp.mpf(a), rate, mp.mpf(angle))
        one = _doubles(scene, angle)
        ordinary = _Bar(right.u, right.omega, mp.mpf(rate) ** 2, right.coriolis)
        plain.append((*ordinary.off(one)[:2], abs(one.alpha) / rate**2))
        solved = _solved(_at(scene, angle))
        if solved is None:
            stops.setdefault("solved", e)
        refined.append(abs(solved[0].alpha) / rate**2 if solved else math.nan)
        bounds.append(float(solved[1].bound.alpha[0]) / rate**2 if solved else math.nan)
        if k % samples == 0:
            drawn.append(_drawn(_at(scene, angle)) / rate**2)
            if math.isnan(drawn[-1]):
                stops.setdefault("drawn", e)
    # the last in parts of the crank's own rate squared: it goes on growing
    lost = LOST, LOST, math.inf
    laws = measured([ErrorLaw(name, theory=-slope, window=NEAR, lost=most)
                     for name, slope, most in zip(BAR_LAWS, (1.0, 2.0, 3.0), lost, strict=True)],
                    x, plain, samples)  # fmt: skip
    xs, es = binned(x, refined, samples)
    stated = binned(x, bounds, samples)[1]
    told = next((e for e in x[::samples] if _warns(_at(scene, -math.pi / 2 + e))), stops.get("drawn"))
    laws += (
        ErrorLaw("acceleration bar solved", xs, tuple(max(e, FLOOR) for e in es), refuses_from=stops.get("solved"),
                 bound=stated),
        ErrorLaw("acceleration bar drawn", tuple(x[::samples]), tuple(drawn), -3.0, told, stops.get("drawn"),
                 window=(1e-8, 0.1), lost=math.inf),
    )  # fmt: skip
    ends = ("fate flip solved", stops.get("solved")), ("fate flip drawn", stops.get("drawn"))
    fates = tuple(Phrase(key, (in_powers(at),)) for key, at in ends if at is not None)
    return Singularity("guide flip", "crank from flip", laws, fates)


def _drawn(scene: Mechanism) -> float:
    """The second rate of the bar off the exact drawing; nan where it refuses."""
    try:
        return abs(execute(plan(scene), EXACT).alpha["3"].value)
    except Unsolvable:
        return math.nan


def _warns(scene: Mechanism) -> bool:
    """Whether the drawing warns of the short arm."""
    try:
        return any(isinstance(r, ShortArm) for r in execute(plan(scene), EXACT).remarks)
    except Unsolvable:
        return True


def slow_sliding(mp: MPContext, samples: int = 4) -> Singularity:
    """Crank and ground in line: the block stands still on its bar.  The sliding velocity goes to zero and loses its
    digits; what it is only a part of does not."""
    scene = mechanism_of_text(_BAR.format(ground=350, crank=90, angle=90), "slow")
    rate = scene.drivers[0].values[1]
    a, d = mp.mpf(scene.by_name["1"].length), mp.mpf(scene.frame.points["A"].imag)
    x = grid(0.3, 1e-15, samples)

    def errors(e: float) -> tuple[float, float]:
        motion = solver.solve(_at(scene, float(mp.pi / 2 + mp.mpf(e))))
        slip, omega = _in_line(mp, a, d, rate, e)
        found = float(motion.slide("2/3").velocity[0]), float(motion.omega("3")[0])
        return float(abs(found[0] / slip - 1)), float(abs(found[1] / omega - 1))

    def by_pencil(e: float) -> list[float]:
        what = plan(_at(scene, float(mp.pi / 2 + mp.mpf(e))))
        predicted = predict(what, "pencil", scene.sheet.tools, together=False)
        sizes = zip((Symbol.parse("v_B@3/B@2"), Symbol("omega", link="3")), _in_line(mp, a, d, rate, e), strict=True)
        return [float(predicted[symbol].deviation / abs(size)) for symbol, size in sizes]

    laws = ErrorLaw("velocity sliding", theory=-1.0, window=(1e-13, 0.1)), ErrorLaw("velocity bar", theory=0.0)
    drawn = (
        ErrorLaw("velocity sliding pencil", theory=-1.0, lost=2.0),
        ErrorLaw("velocity bar pencil", theory=0.0, lost=2.0),
    )
    few = grid(0.3, 1e-4, 1)
    found = measured(laws, x, map(errors, x), samples) + measured(drawn, few, map(by_pencil, few))
    fate = Phrase("fate sliding", tuple(in_powers(law.worst) for law in found))
    return Singularity("slow sliding", "crank from line", found, (fate,))


def _in_line(mp: MPContext, a: mpf, d: mpf, rate: float, e: float) -> tuple[mpf, mpf]:
    """Sliding velocity and rate of the bar, the crank turned by e from the prolongation of the ground: c2 = a2 + d2 +
    2 a d cos e."""
    c = mp.sqrt(a * a + d * d + 2 * a * d * mp.cos(e))
    return -a * d * mp.sin(e) * rate / c, rate * a * (a + d * mp.cos(e)) / (c * c)
