"""Which of the possible assemblies a scene means, and how it goes on along a path of driver values.

Which ways lead to a goal, where an assembly ends on one of them, and where its two forms pass through each other.

A group of two links has a discriminant: positive where it can be assembled in two forms, zero where they fall
together.  Along a path the form is kept while it stays positive.  Where it only touches zero (a change point, the
parallelogram in line) the smooth motion goes over to the other sign; where it goes below, the motion ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np
from numpy.typing import NDArray

from graphkin.errors import Problem, SceneError
from graphkin.scene.model import Driver, Mechanism
from graphkin.search import last_true, least_value
from graphkin.words import Phrase, Wording, listed


def pick(
    scene: Mechanism, links: Sequence[str], candidates: Sequence[Mapping[str, complex]], default: int | None
) -> int:
    """Choose the assembly of a group at the scene's own position, by its place among the candidates: the one that the
    drawn points tell, else the sketch, else the rule.

    Parameters
    ----------
    links : the group's links, for the message
    candidates : for each possible assembly the places (m) of the group's points that were not known before
    default : index of the assembly that the rule for the kind gives; None where there is no rule

    Raises
    ------
    SceneError
        drawn points lie in no assembly, or a group without a rule has several assemblies and no sketch tells which;
        the message lists them, ready to paste
    """
    def shown(z: complex) -> str:
        return f"[{z.real / scene.units.metres:.7g}, {z.imag / scene.units.metres:.7g}]"

    if scene.drawn:
        off = [[(abs(z - scene.drawn[p]), p) for p, z in c.items() if p in scene.drawn] for c in candidates]
        (miss, point), nearest = min((max(one, default=(0.0, "")), i) for i, one in enumerate(off))
        if miss > 1e-6 * scene.size:
            raise SceneError.of(f"drawn.{point}", "drawn at but what is given for links",
                                "what is given twice must agree to 1e-6", place=shown(scene.drawn[point]),
                                links=", ".join(links), other=shown(candidates[nearest][point]))
    if len(candidates) == 1:
        return 0
    for given in (scene.drawn, scene.sketch):
        sums = [math.fsum(abs(z - given[p]) ** 2 for p, z in c.items() if p in given) for c in candidates]
        best = min(range(len(sums)), key=sums.__getitem__)
        rest = min((s, i) for i, s in enumerate(sums) if i != best)
        # beside a dead point two assemblies lie close to each other, and a sketch still tells them apart
        apart = max((abs(z - candidates[best][p]) for p, z in candidates[rest[1]].items() if p in given), default=0.0)
        if rest[0] - sums[best] > TOLD * scene.size * apart:
            return best
    if default is None:
        places = (", ".join(f"{p} = {shown(z)}" for p, z in candidate.items()) for candidate in candidates)
        rows = "\n".join(f"  sketch = {{ {row} }}" for row in places)
        raise SceneError.of(Phrase("links", links=', '.join(links)), "this group has assemblies here and no sketch",
                            "paste one of these at the head of the file", count=len(candidates), rows=rows)
    return default


MOST_TURNS = 4
"""A driver that turns is followed this many turns to either side, until its motion closes or ends."""
FOLD = 12 * 2 * math.pi
"""After so much every motion that closes within the most turns stands where it stood."""


def out_of_reach(scene: Mechanism, values: Mapping[str, float], limits: Sequence[Mapping[str, float]]) -> Problem:
    """What is said of driver values that the motion does not reach: it ends at the limits."""

    def shown(key: str, value: float) -> Wording:
        unit = scene.unit_of(next(d for d in scene.drivers if d.key == key))
        number = f"{unit.of(value):.6f}"
        return Phrase("so many degrees", value=number) if unit.text == "deg" else f"{number} {unit.text}"

    key = scene.drivers[0].key
    ends = sorted({f(limit[key] for limit in limits) for f in (min, max)})
    asked = listed([Phrase("driver at value", driver=k, value=shown(k, v)) for k, v in values.items()])
    named = [shown(key, end) for end in ends]
    reach = named[0] if len(ends) == 1 else Phrase("one and other", first=named[0], second=named[1])
    range_ = Phrase("driver moves between" if len(ends) > 1 else "driver moves up to", driver=key, reach=reach)
    return Problem(Phrase("driver of driver", driver=asked), "the motion does not reach it", range_)


def ways(
    drivers: Sequence[Driver], start: Sequence[float], goal: Sequence[float], direct: bool = False
) -> Iterator[tuple[float, ...]]:
    """Driver values (rad, m) to which the motion may be followed to come to a goal: straight on to the goal itself,
    whole turns included; then, for drivers that turn, to where they stand the same way within a turn, the nearer first.
    Only the first where it must be ``direct``, for what rolls does not close with the turn.
    """
    if direct:
        yield tuple(goal)
        return
    choices: list[tuple[float, ...]] = []
    for driver, a, b in zip(drivers, start, goal, strict=True):
        if not driver.turns or a == b:
            choices.append((b,))
            continue
        here = b if abs(b - a) <= FOLD else a + math.fmod(b - a, FOLD)
        near = math.remainder(b - a, 2 * math.pi)
        around = (a + near, a + near - math.copysign(2 * math.pi, near)) if abs(near) > SAME_ANGLE else (a,)
        choices.append((here, *(x for x in around if abs(x - here) > SAME_ANGLE)))
    yield from product(*choices)


SAME_ANGLE = 1e-9


@dataclass(frozen=True)
class ChangePoint:
    """Where two assemblies of the group of some ``links`` meet: the drivers' ``values`` there (rad, m)."""

    links: tuple[str, ...]
    values: tuple[float, ...]


Reals = NDArray[np.float64]
TOLD = 1e-9
"""Of the size, by how far two assemblies are apart: by so much their distances from the sketch differ."""
TOUCH = 1e-12
"""A least value of a discriminant (no unit) within this of zero is a touch."""
START = 1e-6
"""A touch as near to the start as this is the start's own: the form was chosen there."""


@dataclass(frozen=True)
class Passage:
    """What happens to one group on the path parameter 0 .. 1.

    ``limit`` is where the motion ends, None if it does not; ``flips`` are the change points before that.
    """

    limit: float | None = None
    flips: Reals = field(default_factory=lambda: np.zeros(0))

    def sign(self, t: Reals) -> Reals:
        """+1 or -1: the sign of the assembly relative to that at the start of the path."""
        return np.where(np.searchsorted(self.flips, t) % 2, -1.0, 1.0)


def follow(
    discriminant: Callable[[Reals], Reals],
    grid: Reals,
    flips: bool = True,
    touch: float = TOUCH,
    least_closes: Callable[[float], tuple[float, int] | None] | None = None,
) -> Passage:
    """Follow one discriminant along a path.

    Parameters
    ----------
    discriminant : function of path parameters, shape (n,), to values, shape (n,), scaled to have no unit
    grid : increasing parameters, fine enough that the discriminant has at most one least value between three of them
    flips : False where a touch of zero ends the motion too (two lines that become parallel)
    touch : a least value within this of zero may be a touch
    least_closes : what tells more exactly where the discriminant is least near a parameter, and whether it is positive
        (1), zero (0) or negative (-1) there; None where it cannot
    """
    value = discriminant(grid)
    touches: list[float] = []
    for i in range(len(grid)):
        if value[i] < -touch:
            return Passage(_end(discriminant, 0.0, grid[max(i - 1, 0)], grid[i]), np.array(touches))
        before, after = max(i - 1, 0), min(i + 1, len(grid) - 1)
        if not np.isfinite(value[[before, i, after]]).all():
            continue
        change = max(abs(value[before] - value[i]), abs(value[after] - value[i]))
        if value[before] < value[i] or value[after] < value[i] or value[i] > change:
            continue
        where, least = least_value(discriminant, grid[before], grid[after], -TOUCH)
        exact = least_closes(where) if least_closes and flips and abs(least) <= touch else None
        where, sign = exact or (where, None)
        if least > touch or where <= grid[0] + START or where >= grid[-1] or sign == 1:
            continue
        if least < -touch or not flips or sign == -1:
            floor = touch if not flips and least >= -touch else 0.0
            return Passage(_end(discriminant, floor, grid[before], where), np.array(touches))
        if not touches or where > touches[-1] + 1e-6:
            touches.append(where)
    return Passage(None, np.array(touches))


def _end(discriminant: Callable[[Reals], Reals], floor: float, low: float, high: float) -> float:
    return last_true(lambda t: discriminant(t) >= floor, low, high)
