"""The choice of a scene's assembly, and the paths of the drivers to a goal."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from graphkin.errors import Problem, SceneError
from graphkin.scene.model import Driver, Mechanism
from graphkin.words import Phrase, Wording, links_named, listed


def pick(
    scene: Mechanism, links: Sequence[str], candidates: Sequence[Mapping[str, complex]], default: int | None
) -> int:
    """Choose the assembly of a group at the scene's own position, by its index among the candidates: from the drawn
    points, else the sketch, else the rule.

    Parameters
    ----------
    links : the group's links, for the message
    candidates : for each possible assembly the places (m) of the group's points that were not known before
    default : index of the assembly by the rule of the kind; None where there is no rule

    Raises
    ------
    SceneError
        drawn points lie in no assembly, or a group without a rule has several assemblies and no sketch chooses;
        the message lists them, ready to paste
    """
    def shown(z: complex) -> str:
        return f"[{z.real / scene.units.metres:.7g}, {z.imag / scene.units.metres:.7g}]"

    if scene.drawn:
        misses_each = [[(abs(z - scene.drawn[p]), p) for p, z in c.items() if p in scene.drawn] for c in candidates]
        (miss, point), nearest = min((max(misses, default=(0.0, "")), i) for i, misses in enumerate(misses_each))
        if miss > 1e-6 * scene.size:
            raise SceneError.of(f"drawn.{point}", "drawn at but what is given for links",
                                "what is given twice must agree to 1e-6", place=shown(scene.drawn[point]),
                                links=links_named(links), other=shown(candidates[nearest][point]))
    if len(candidates) == 1:
        return 0
    for given in (scene.drawn, scene.sketch):
        squares = [math.fsum(abs(z - given[p]) ** 2 for p, z in c.items() if p in given) for c in candidates]
        best = min(range(len(squares)), key=squares.__getitem__)
        rest = min((s, i) for i, s in enumerate(squares) if i != best)
        # beside a dead point two assemblies lie close to each other, and a sketch still tells them apart
        gap = max((abs(z - candidates[best][p]) for p, z in candidates[rest[1]].items() if p in given), default=0.0)
        if gap > ROUNDED * scene.size and rest[0] - squares[best] > TOLD * scene.size * gap:
            return best
    if default is None:
        places = (", ".join(f"{p} = {shown(z)}" for p, z in candidate.items()) for candidate in candidates)
        rows = "\n".join(f"  sketch = {{ {row} }}" for row in places)
        raise SceneError.of(links_named(links), "this group has assemblies here and no sketch",
                            "paste one of these at the head of the file", count=len(candidates), rows=rows)
    return default


MOST_TURNS = 4
"""A driver that turns is followed this many turns to either side, until its motion closes or ends."""
FOLD = 12 * 2 * math.pi
"""After so much every motion that closes within the most turns stands where it stood."""


def out_of_reach(scene: Mechanism, values: Mapping[str, float], limits: Sequence[Mapping[str, float]]) -> Problem:
    """The sentence on driver values that the motion does not reach: it ends at the limits."""

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
    """Driver values (rad, m) to which the motion may be followed to reach a goal: first the goal itself, whole turns
    included; then, for drivers that turn, the same angle within a turn, the nearer first.  With ``direct`` only the
    first, since rolling does not close with the turn.
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


@dataclass(frozen=True, eq=False, repr=False)
class ChangePoint:
    """A position where two assemblies of the group of some ``links`` meet: the drivers' ``values`` (rad, m)."""

    links: tuple[str, ...]
    values: tuple[float, ...]


ROUNDED = 1e-13
"""Of the size: a point that is no farther apart in two assemblies lies in one place in both, but for rounding."""
TOLD = 1e-9
"""Of the size, by how far two assemblies are apart: by so much their distances from the sketch differ."""
