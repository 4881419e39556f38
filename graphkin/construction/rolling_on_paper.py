"""Where what rolls stands on paper: the way is gone from the scene's own position in small steps, and how far the links
have turned or slid that it rolls on is read off, whole turns included."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from graphkin.construction.dyads import drive, meet
from graphkin.construction.links_on_paper import PlacedLinks, Poses, apart
from graphkin.construction.position import choose, start_board
from graphkin.construction.touching import coordinate_on_paper
from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import AngleDriver
from graphkin.structure import Driven, Dyad, Element, Rolled, Structure
from graphkin.structure.model import Coordinate
from graphkin.words import Phrase

__all__ = ["rolled_position"]

STEP, SLIDE_STEP = math.radians(3.0), 0.02


def rolled_position(
    structure: Structure, elements: Sequence[Element], own: Mapping[str, float], values: Mapping[str, float]
) -> tuple[dict[str, float], dict[int, int]]:
    """The driver values with those of everything that rolls (rad, m), and the assembly of each dyad there.

    Raises
    ------
    Unsolvable : "not assembled" where the motion does not go on, "not drawn" for groups larger than a dyad
    """
    mm = 1.0 / structure.scene.size
    frame, chosen = start_board(structure, mm, own), dict[int, int]()
    start: dict[Coordinate, float] = {}
    for i, element in enumerate(elements):
        if isinstance(element, Driven) and isinstance(element.driver, Rolled):
            start |= {c: coordinate_on_paper(structure, frame, c) for c, _ in element.driver.factors}
            frame = _with(frame, element.driver.key, element.driver.start)
        elif not isinstance(element, Driven | Dyad):
            names = ", ".join(element.links)
            raise Unsolvable(
                "not drawn", Problem(Phrase("links", links=names), Phrase("a larger group beside what rolls is not"))
            )
        choose(structure, frame, i, element, chosen)
    near = dict(start)
    drivers = structure.scene.drivers
    long = max(abs(values[d.key] - own[d.key]) / (STEP if isinstance(d, AngleDriver) else SLIDE_STEP / mm)
               for d in drivers)  # fmt: skip
    count = max(1, math.ceil(long))
    for k in range(1, count + 1):
        here = {key: own[key] + (values[key] - own[key]) * k / count for key in own}
        if k == count:
            here = dict(values)
        frame = _placed(structure, elements, start_board(structure, mm, here), frame.poses, start, near, chosen)
    return {**values, **{key: v for key, v in frame.values.items() if key not in values}}, chosen


def _placed(
    structure: Structure, elements: Sequence[Element], frame: PlacedLinks, before: Poses,
    start: Mapping[Coordinate, float], near: dict[Coordinate, float], chosen: dict[int, int],
) -> PlacedLinks:  # fmt: skip
    """All links a step further; ``near`` and ``chosen`` go on with them."""
    for i, element in enumerate(elements):
        if isinstance(element, Dyad):
            found = meet(frame, element).poses
            if not found:
                wanted = Phrase("choose a driver value that the motion reaches")
                raise Unsolvable(
                    "not assembled",
                    Problem(
                        Phrase("links", links=", ".join(element.links)),
                        Phrase("their loci do not meet on the way"),
                        wanted,
                    ),
                )
            chosen[i] = min(range(len(found)), key=lambda k, found=found: apart(found[k], before))  # type: ignore[misc]
            frame.poses.update(found[chosen[i]])
        elif isinstance(element, Driven):
            if isinstance(element.driver, Rolled):
                value = element.driver.start
                for coordinate, factor in element.driver.factors:
                    read = coordinate_on_paper(structure, frame, coordinate)
                    if coordinate[0] == "angle":
                        read += math.tau * round((near[coordinate] - read) / math.tau)
                    near[coordinate] = read
                    value += factor * (read - start[coordinate])
                frame = _with(frame, element.driver.key, value)
            frame.poses[element.link], _ = drive(frame, element)
    return frame


def _with(frame: PlacedLinks, key: str, value: float) -> PlacedLinks:
    frame.values = {**frame.values, key: value}
    return frame
