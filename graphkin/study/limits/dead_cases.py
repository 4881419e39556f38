"""A mechanism with its dead point for each kind of dyad, and where exactly that point lies."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from graphkin.scene import read_text
from graphkin.scene.model import AngleDriver, Scene

__all__ = ["CASES", "Case"]

_RRR = """
[frame]
points = { A = [0, 0], D = [400, 0] }
[links.1]
points = ["A", "B"]
length = 310
[links.2]
points = ["B", "C"]
length = 210
[links.3]
points = ["D", "C"]
length = 290
[driver]
link = "1"
angle = 60
omega = 10
[sketch]
C = [300, 280]
"""
_RRP = """
[frame]
points = { A = [0, 0] }
guides = { h = { through = [0, 0], angle = 0 } }
[links.1]
points = ["A", "B"]
length = 310
[links.2]
points = ["B", "C"]
length = 210
[links.3]
points = ["C"]
on = "0.h"
[driver]
link = "1"
angle = 30
omega = 10
"""
_RPR = """
[frame]
points = { A = [0, 0], C = [310, 0] }
[links.1]
points = ["A", "B"]
length = 110
[links.2]
points = ["B"]
on = "3.s"
[links.3]
points = ["C"]
at = { E = [0, 250] }
guides = { s = { through = "E", angle = 0 } }
[driver]
link = "1"
angle = 120
omega = 10
"""


@dataclass(frozen=True)
class Case:
    """A mechanism with its dead point.

    ``follower`` is the link whose motion is looked at; ``side`` is +1 where the crank comes to the dead point from
    greater angles.
    """

    kind: str
    text: str
    follower: str
    side: int

    @cached_property
    def scene(self) -> Scene:
        return read_text(self.text, self.kind)

    def at(self, angle: float) -> Scene:
        """The scene with its crank at another angle."""
        driver = self.scene.drivers[0]
        assert isinstance(driver, AngleDriver)
        return replace(self.scene, drivers=(replace(driver, angle=angle),))

    @property
    def _lengths(self) -> tuple[float, float, float]:
        """Crank, ground (0 where it takes no part) and the reach of the dyad."""
        links = self.scene.by_name
        crank = links["1"].length
        assert crank is not None
        if self.kind == "RRR":
            return crank, links["0"].points["D"].real, (links["2"].length or 0.0) + (links["3"].length or 0.0)
        if self.kind == "RRP":
            return crank, 0.0, links["2"].length or 0.0
        return crank, links["0"].points["C"].real, links["3"].guides["s"].through.imag

    def dead(self, mp: Any) -> Any:
        """The crank's angle at the dead point, by the law of cosines or the sine."""
        a, d, reach = (mp.mpf(x) for x in self._lengths)
        if self.kind == "RRP":
            return mp.asin(reach / a)
        if self.kind == "RRR":
            links = self.scene.by_name
            reach = mp.mpf(links["2"].length) + mp.mpf(links["3"].length)
        return mp.acos((a * a + d * d - reach * reach) / (2 * a * d))


CASES = {
    "RRR": Case("RRR", _RRR, "3", -1),
    "RRP": Case("RRP", _RRP, "2", -1),
    "RPR": Case("RPR", _RPR, "3", 1),
}
