"""Which of the possible assemblies a scene means."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from graphkin.errors import Problem, SceneError
from graphkin.scene.model import Scene

__all__ = ["Choice", "pick"]


@dataclass(frozen=True)
class Choice:
    """The assembly taken: its place among the candidates, and what decided it."""

    index: int
    by: Literal["only", "drawn", "sketch", "rule"]


def pick(
    scene: Scene, links: Sequence[str], candidates: Sequence[Mapping[str, complex]], default: int | None
) -> Choice:
    """Choose the assembly of a group at the scene's own position.

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
    if scene.drawn:
        _agree(scene, links, candidates)
    if len(candidates) == 1:
        return Choice(0, "only")
    for by, given in (("drawn", scene.drawn), ("sketch", scene.sketch)):
        sums = [sum(abs(z - given[p]) ** 2 for p, z in c.items() if p in given) for c in candidates]
        best = min(range(len(sums)), key=sums.__getitem__)
        rest = min(s for i, s in enumerate(sums) if i != best)
        if rest - sums[best] > 1e-9 * scene.size**2:
            return Choice(best, "drawn" if by == "drawn" else "sketch")
    if default is None:
        raise SceneError(_several(scene, links, candidates))
    return Choice(default, "rule")


def _agree(scene: Scene, links: Sequence[str], candidates: Sequence[Mapping[str, complex]]) -> None:
    def worst(candidate: Mapping[str, complex]) -> tuple[float, str]:
        return max(((abs(z - scene.drawn[p]), p) for p, z in candidate.items() if p in scene.drawn), default=(0.0, ""))

    nearest = min(candidates, key=lambda c: worst(c)[0])
    miss, point = worst(nearest)
    if miss > 1e-6 * scene.size:
        raise SceneError(
            Problem(
                f"drawn.{point}",
                f"drawn at {_place(scene, scene.drawn[point])}, but what is given for links {', '.join(links)} puts it "
                f"at {_place(scene, nearest[point])}",
                "what is given twice must agree to 1e-6 of the size",
            )
        )


def _several(scene: Scene, links: Sequence[str], candidates: Sequence[Mapping[str, complex]]) -> Problem:
    rows = []
    for candidate in candidates:
        places = ", ".join(f"{p} = {_place(scene, z)}" for p, z in candidate.items())
        rows.append(f"  sketch = {{ {places} }}")
    return Problem(
        f"links {', '.join(links)}",
        f"this group has {len(candidates)} assemblies here and no sketch says which is meant",
        "paste one of these at the head of the file:\n" + "\n".join(rows),
    )


def _place(scene: Scene, z: complex) -> str:
    return f"[{z.real / scene.units.metres:.7g}, {z.imag / scene.units.metres:.7g}]"
