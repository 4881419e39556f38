"""Sliding links with two pins, as people measure them: where the second pin stands along and across the guide, or where
both are drawn, instead of their distance and its angle to the guide.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

from graphkin.scene.tables import Link, SceneTables

__all__ = ["with_carriages"]


def with_carriages(file: SceneTables) -> SceneTables:
    """The file with each sliding link of two own points that says neither their distance nor ``angle_on``, but

    - in ``at`` where the second stands from the first, as a link of one own point: its axes lie along the guide, and
      all its places are in them; or
    - nothing, where both are in ``[drawn]`` and the guide is one of the frame with an angle, at the angle drawn.
    """
    links = {name: _measured(file, link) for name, link in file.links.items()}
    return file if links == dict(file.links) else replace(file, links=links)


def _measured(file: SceneTables, link: Link) -> Link:
    single = link.on is not None and (isinstance(link.on, str) or len(link.on) == 1)
    if len(link.points) != 2 or not single or link.angle_on is not None:
        return link
    first, second = link.points
    if second in link.at and link.at[second] != "drawn" and link.length is None:
        return replace(link, points=[first])
    turned = _drawn(file, link)
    return link if turned is None else replace(link, angle_on=turned)


def _drawn(file: SceneTables, link: Link) -> float | None:
    """The angle (degrees) from the guide to both drawn points, if they tell it."""
    ref = link.on if isinstance(link.on, str) else (link.on or [""])[0]
    on, _, name = ref.partition(".")
    guide = file.frame.guides.get(name)
    if on != file.frame.name or (name and (guide is None or guide.angle is None)):
        return None
    if not all(point in file.drawn for point in link.points):
        return None
    one, two = (complex(*file.drawn[point]) for point in link.points)
    if one == two:
        return None
    angle = math.degrees(cmath.phase(two - one)) - ((guide.angle or 0.0) if guide is not None else 0.0)
    return math.remainder(angle, 360.0)
