"""``graphkin solve``: the analytic solution alone."""

from __future__ import annotations

import html
from dataclasses import dataclass
from functools import cached_property
from numbers import Integral
from typing import TYPE_CHECKING, Any

from graphkin.api.arguments import At, SceneLike, as_scene, driver_values
from graphkin.errors import CallError, Problem, Unsolvable
from graphkin.scene.model import SlideDriver
from graphkin.structure import mobility_of

if TYPE_CHECKING:
    from graphkin.solver import Motion

__all__ = ["Solved", "refused", "solve"]


@dataclass(frozen=True, repr=False)
class Solved:
    """The motion of every link, point and sliding pair at one position or over a turn.

    ``motion`` has the arrays (SI); ``data`` is the object that ``graphkin solve --json`` prints.
    """

    motion: Motion

    def __repr__(self) -> str:
        return f"<Solved {self.motion.scene.name}: {int(self.motion.ok.sum())} of {len(self.motion)} positions>"

    @cached_property
    def data(self) -> dict[str, Any]:
        from graphkin.solver import to_json

        return to_json(self.motion)

    @property
    def ok(self) -> bool:
        """Whether one position at least is solved."""
        return any(p["status"] == "ok" for p in self.data["positions"])

    def _repr_html_(self) -> str:
        rows = []
        for position in self.data["positions"]:
            driver = ", ".join(f"{k}: {v:.6g}" for k, v in position["driver"].items())
            if position["status"] != "ok":
                rows.append(f"<tr><td>{html.escape(driver)}</td><td colspan=4>{html.escape(position['why'])}</td></tr>")
                continue
            for name, link in position["links"].items():
                cells = "".join(f"<td>{link[k]:.6g}</td>" for k in ("angle", "omega", "alpha"))
                rows.append(f"<tr><td>{html.escape(driver)}</td><td>{html.escape(name)}</td>{cells}</tr>")
        head = "<tr><th>driver</th><th>link</th><th>angle</th><th>&omega;</th><th>&alpha;</th></tr>"
        return f"<table>{head}{''.join(rows)}</table>"


def refused(scene: SceneLike, at: At, stop: Unsolvable) -> dict[str, Any]:
    """The object of ``solve --json`` for a mechanism that is refused as a whole: its count, and why."""
    given = as_scene(scene)
    values = driver_values(given, at) or {}
    driver = {
        d.key: values.get(d.key, d.values[0]) / (given.units.metres if isinstance(d, SlideDriver) else 1.0)
        for d in given.drivers
    }
    return {
        "title": given.title,
        "units": {"length": given.units.length, "time": "s", "angle": "rad"},
        "mobility": mobility_of(given).value,
        "groups": [],
        "positions": [{"driver": driver, "status": stop.status, "why": stop.why}],
    }


def solve(scene: SceneLike, at: At = None, sweep: int | None = None) -> Solved:
    """Solve a scene analytically: position, velocity, acceleration of everything that moves.

    Parameters
    ----------
    scene : a file, the name of a scene that comes along, a mapping of the same shape, or a `Scene`
    at : driver value other than the scene's own, in the driver's unit (degrees, or travel); with several drivers it
        moves the first, or a mapping names them
    sweep : number of positions over a turn of the first driver (over its range, for a driven slide)

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : wrong mobility.  Positions that cannot be assembled are no error: they carry their status.

    Examples
    --------
    >>> solved = solve("sixbar-guide-40deg")
    >>> round(solved.data["positions"][0]["links"]["3"]["omega"], 4)
    -2.8191
    """
    from graphkin import solver

    given = as_scene(scene)
    if sweep is not None and not (isinstance(sweep, Integral) and 1 <= sweep <= 10_000_000):
        raise CallError(Problem("sweep", f"{sweep} positions", "give a whole number from 1 to 10000000"))
    return Solved(solver.solve(given, at=driver_values(given, at), sweep=sweep))
