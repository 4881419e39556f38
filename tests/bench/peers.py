"""The peers' own calls for the mechanisms of the benchmark; each gives the same twelve columns."""

from __future__ import annotations

import math
from collections.abc import Callable
from importlib.util import find_spec

import numpy as np

from .mechanisms import Case

__all__ = ["PEERS", "have"]

Call = Callable[[], np.ndarray]
START = math.radians(30)
OMEGA = 10.0


def have(name: str) -> bool:
    """Whether a peer is installed."""
    return find_spec("sympy" if name.startswith("sympy") else name) is not None


def pylinkage(case: Case, n: int) -> Call:
    """``step_fast_with_kinematics``, the sweep that it compiles with numba."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import FixedDyad, RRPDyad, RRRDyad
    from pylinkage.simulation import Linkage

    step = 2 * math.pi / n

    def crank(x: float, y: float, radius: float) -> tuple[Ground, Crank]:
        pivot = Ground(x, y, name="A")
        # it turns before it records
        return pivot, Crank(anchor=pivot, radius=radius, angular_velocity=step, initial_angle=START - step, name="c")

    if case.name == "four-bar":
        pivot, driver = crank(0.0, 0.0, 0.15)
        other = Ground(0.4, 0.0, name="D")
        end = RRRDyad(anchor1=driver.output, anchor2=other, distance1=0.5, distance2=0.3, x=0.5, y=0.29, name="C")
        parts, which = [pivot, other, driver, end], (2, 3)
    elif case.name == "slider-crank":
        pivot, driver = crank(0.0, 0.0, 0.05)
        one, two = Ground(0.0, 0.02, name="L1"), Ground(0.1, 0.02, name="L2")
        end = RRPDyad(
            revolute_anchor=driver.output, line_anchor1=one, line_anchor2=two, distance=0.15, x=0.19, y=0.02, name="C"
        )
        parts, which = [pivot, one, two, driver, end], (3, 4)
    else:
        long, height, lever, rod, guide = case.sizes
        pivot, driver = crank(0.0, height, long)
        foot = Ground(0.0, 0.0, name="O4")
        one, two = Ground(-0.1, guide, name="L1"), Ground(0.0, guide, name="L2")
        top = FixedDyad(anchor1=foot, anchor2=driver.output, distance=lever, angle=0.0, name="B")
        end = RRPDyad(revolute_anchor=top, line_anchor1=one, line_anchor2=two, distance=rod, x=-0.1, y=guide, name="C")
        parts, which = [pivot, foot, one, two, driver, top, end], (5, 6)
    linkage = Linkage(parts)
    linkage.set_input_velocity(driver, omega=OMEGA, alpha=0.0)
    linkage.compile()

    def call() -> np.ndarray:
        tables = linkage.step_fast_with_kinematics(n)
        return np.array([table[:, joint, axis] for table in tables for joint in which for axis in (0, 1)])

    def only() -> object:
        return linkage.step_fast_with_kinematics(n)

    call.timed = only  # type: ignore[attr-defined]
    return call


def sympy_lambdify(case: Case, n: int) -> Call:
    """The closed form differentiated by sympy and written out for NumPy with common subexpressions."""
    import sympy as sp

    t = sp.Symbol("t")
    angle = START + OMEGA * t
    if case.name == "four-bar":
        bx, by = 0.15 * sp.cos(angle), 0.15 * sp.sin(angle)
        lx, ly = 0.4 - bx, -by
        square = lx**2 + ly**2
        along = (0.5**2 - 0.3**2) / (2 * square) + sp.Rational(1, 2)
        height = sp.sqrt(0.5**2 / square - along**2)
        cx, cy = bx + lx * along - ly * height, by + ly * along + lx * height
    elif case.name == "slider-crank":
        bx, by = 0.05 * sp.cos(angle), 0.05 * sp.sin(angle)
        cx, cy = bx + sp.sqrt(0.15**2 - (0.02 - by) ** 2), sp.Float(0.02) + 0 * t
    else:
        crank, height, lever, rod, guide = case.sizes
        ax, ay = crank * sp.cos(angle), height + crank * sp.sin(angle)
        long = sp.sqrt(ax**2 + ay**2)
        bx, by = lever * ax / long, lever * ay / long
        cx, cy = bx - sp.sqrt(rod**2 - (guide - by) ** 2), sp.Float(guide) + 0 * t
    places = [bx, by, cx, cy]
    columns = [sp.diff(x, t, k) for k in range(3) for x in places]
    function = sp.lambdify(t, columns, "numpy", cse=True)
    times = np.arange(n) * (2 * math.pi / n / OMEGA)
    return lambda: np.array([np.broadcast_to(x, (n,)) for x in function(times)])


def mechanism(case: Case, n: int) -> Call | None:
    """Newton's method from position to position; only where it takes seconds, not hours."""
    if case.name != "four-bar" or n > 360:
        return None
    from mechanism import Mechanism, Vector, get_joints

    o, b, c, d = get_joints("O B C D")
    crank, rod = Vector((o, b), r=0.15), Vector((b, c), r=0.5)
    rocker, ground = Vector((d, c), r=0.3), Vector((o, d), r=0.4, theta=0)

    def loops(x: np.ndarray, i: float) -> np.ndarray:
        gap = crank(i) + rod(x[0]) - rocker(x[1]) - ground()
        return np.asarray(gap).ravel()

    angles = START + np.arange(n) * (2 * math.pi / n)
    made = Mechanism(
        vectors=(crank, rod, rocker, ground), origin=o, loops=loops, pos=angles, vel=np.full(n, OMEGA),
        acc=np.zeros(n), guess=(np.array([0.6, 1.2]), np.zeros(2), np.zeros(2)),
    )

    def call() -> np.ndarray:
        made.iterate()
        found = [(j.x_positions, j.y_positions) for j in (b, c)]
        found += [(j.x_velocities, j.y_velocities) for j in (b, c)]
        found += [(j.x_accelerations, j.y_accelerations) for j in (b, c)]
        return np.array([x for pair in found for x in pair])

    return call


PEERS: dict[str, Callable[[Case, int], Call | None]] = {
    "pylinkage": pylinkage,
    "sympy lambdify": sympy_lambdify,
    "mechanism": mechanism,
}
