"""Which basic mechanisms are in a scene, by name, and which of their links can turn fully.

Grashof's rule for four-bars, its forms for slider-cranks and their inversions, offsets included (Norton, Design of
Machinery, ch. 2 and 3; 孙桓 《机械原理》, ch. 8; for the offset Hall, Kinematics and Linkage Design).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from graphkin.plane import added_up
from graphkin.scene.model import Mechanism
from graphkin.structure import Dyad, DyadKind, Pair, Structure

__all__ = ["BasicLoop", "loops"]

EQUAL = 1e-9
"""Lengths that differ by less than this part of the longest count as equal: a change point."""


@dataclass(frozen=True)
class BasicLoop:
    """One basic mechanism.

    kind : "four-bar", "slider-crank", "guide bar", "oscillating block", "double slider"
    name : by name, as in textbooks ("crank-rocker", "swinging guide bar")
    links : its links, the frame last
    lengths : by their names (m): "crank", "coupler", "rocker", "frame"; "crank", "rod", "offset"; "crank", "centres",
        "offset"
    grashof : whether some link can turn fully about another; None where the rule does not apply
    turns : the links that can turn fully about the frame
    """

    kind: str
    name: str
    links: tuple[str, ...]
    lengths: dict[str, float]
    grashof: bool | None
    turns: tuple[str, ...]


def loops(structure: Structure) -> tuple[BasicLoop, ...]:
    """The basic mechanisms of a structure: groups of two links between the frame and a link pivoted to the frame."""
    found: list[BasicLoop] = []
    for group in structure.groups:
        if isinstance(group, Dyad) and all(len(body.links) == 1 for body in group.bodies):
            loop = _FINDERS[group.kind](structure, group)
            if loop is not None:
                order = structure.scene.order
                found.append(replace(loop, turns=tuple(sorted(loop.turns, key=lambda name: order.get(name, -1)))))
    return tuple(found)


def _pivot(structure: Structure, link: str) -> str | None:
    """The point at which a link turns about the frame."""
    frame = structure.links[structure.scene.frame.name].points
    return next((p for p in structure.links[link].points if p in frame), None)


def _mate(structure: Structure, group: Dyad, joint: Pair) -> str:
    """The link outside a group at one of its outer pins: the frame, or one that is pivoted to the frame, if there are
    several."""
    frame = structure.scene.frame.name
    others = [n for n in structure.hinges.get(joint.point, (joint.b,)) if n not in group.links]
    if frame in others or not others:
        return frame if frame in others else joint.b
    return next((n for n in others if _pivot(structure, n) is not None), others[0])


def _between(structure: Structure, link: str, one: str, two: str) -> float:
    points = structure.links[link].points
    return abs(points[one] - points[two])


def _named(scene: Mechanism, links: tuple[str, ...]) -> tuple[str, ...]:
    return (*(sorted(links, key=lambda name: scene.order.get(name, -1))), scene.frame.name)


def _four_bar(structure: Structure, group: Dyad) -> BasicLoop | None:
    scene = structure.scene
    frame = scene.frame.name
    one, two, inner = group.outer_first, group.outer_second, group.inner
    coupler, rocker = group.first.links[0], group.second.links[0]
    if _mate(structure, group, one) == frame:
        one, two, coupler, rocker = two, one, rocker, coupler
    crank = _mate(structure, group, one)
    pivot = _pivot(structure, crank)
    if _mate(structure, group, two) != frame or crank == frame or pivot is None or pivot == two.point:
        return None
    lengths = {
        "crank": _between(structure, crank, pivot, one.point),
        "coupler": _between(structure, coupler, one.point, inner.point),
        "rocker": _between(structure, rocker, two.point, inner.point),
        "frame": _between(structure, frame, pivot, two.point),
    }
    name, grashof, by = four_bar_class(**lengths)
    names = {"crank": crank, "rocker": rocker}
    return BasicLoop(
        "four-bar", name, _named(scene, (crank, coupler, rocker)), lengths, grashof, tuple(names[b] for b in by)
    )


def four_bar_class(crank: float, coupler: float, rocker: float, frame: float) -> tuple[str, bool, tuple[str, ...]]:
    """Grashof's class of a four-bar, whether it is a Grashof linkage, and which of "crank" and "rocker" (the two links
    pivoted to the frame) turn fully.

    >>> four_bar_class(150, 500, 300, 400)
    ('crank-rocker', True, ('crank',))
    """
    lengths = {"crank": crank, "coupler": coupler, "rocker": rocker, "frame": frame}
    shortest, longest = min(lengths.values()), max(lengths.values())
    excess = 2 * (shortest + longest) - added_up(lengths.values())
    if abs(excess) <= EQUAL * longest:
        short = [k for k, v in lengths.items() if v <= shortest + EQUAL * longest]
        turning = {"crank", "rocker"} if len(short) > 1 or short == ["frame"] else set(short) & {"crank", "rocker"}
        return "change point", True, tuple(k for k in ("crank", "rocker") if k in turning)
    if excess > 0:
        return "triple-rocker", False, ()
    short_one = min(lengths, key=lambda k: lengths[k])
    if short_one == "frame":
        return "double-crank", True, ("crank", "rocker")
    if short_one == "coupler":
        return "double-rocker", True, ()
    return "crank-rocker", True, (short_one,)


def _slider_crank(structure: Structure, group: Dyad) -> BasicLoop | None:
    scene = structure.scene
    frame = scene.frame.name
    one, two, inner = group.outer_first, group.outer_second, group.inner
    rod, slider = group.first.links[0], group.second.links[0]
    known = two.b if slider == two.a else two.a
    if slider != two.a:
        return None
    crank = _mate(structure, group, one)
    if known == frame and crank != frame:
        pivot = _pivot(structure, crank)
        if pivot is None:
            return None
        offset = _offset(structure, two, inner.point, structure.links[frame].points[pivot])
        lengths = {
            "crank": _between(structure, crank, pivot, one.point),
            "rod": _between(structure, rod, one.point, inner.point),
            "offset": abs(offset),
        }
        return _slider_crank_named(scene, lengths, (crank, rod, slider), crank)
    pivot = _pivot(structure, known)
    if crank == frame and known != frame and pivot is not None and pivot != one.point:
        # a turning guide carries the block at the end of a crank
        offset = _offset(structure, two, inner.point, structure.links[known].points[pivot])
        lengths = {
            "crank": _between(structure, rod, one.point, inner.point),
            "centres": _between(structure, frame, pivot, one.point),
            "offset": abs(offset),
        }
        return _guide_bar(scene, lengths, rod, known, (known, slider, rod))
    return None


def _offset(structure: Structure, slide: Pair, pin: str, centre: complex) -> float:
    """Distance from a point of the guiding link to the line on which a pin of the sliding link runs."""
    turned = slide.guide.direction * slide.turn
    at = slide.guide.through + turned * structure.links[slide.a].points[pin]
    return float(((centre - at) * slide.guide.direction.conjugate()).imag)


def _slider_crank_named(scene: Mechanism, lengths: dict[str, float], links: tuple[str, ...], crank: str) -> BasicLoop:
    r, rod, e = lengths["crank"], lengths["rod"], lengths["offset"]
    equal = EQUAL * max(r, rod, e)
    place = "in-line" if e <= equal else "offset"
    grashof = abs(rod - r) >= e - equal
    turns = (crank,) if grashof and rod >= r - equal else ()
    if abs(abs(rod - r) - e) <= equal:
        name = f"{place} slider-crank at a change point"
    elif turns:
        name = f"{place} slider-crank"
    elif grashof:
        name = f"{place} slider-crank whose rod turns fully"
    else:
        name = f"{place} rocker-slider"
    return BasicLoop("slider-crank", name, _named(scene, links), lengths, grashof, turns)


def _guide_bar(scene: Mechanism, lengths: dict[str, float], crank: str, bar: str, links: tuple[str, ...]) -> BasicLoop:
    r, d, e = lengths["crank"], lengths["centres"], lengths["offset"]
    equal = EQUAL * max(r, d, e)
    if abs(abs(r - d) - e) <= equal:
        return BasicLoop("guide bar", "guide bar at a change point", _named(scene, links), lengths, True, (crank,))
    if r - d > e:
        return BasicLoop(
            "guide bar", "rotating guide bar (Whitworth)", _named(scene, links), lengths, True, (crank, bar)
        )
    if d - r > e:
        return BasicLoop("guide bar", "swinging guide bar", _named(scene, links), lengths, True, (crank,))
    return BasicLoop("guide bar", "guide bar without a full turn", _named(scene, links), lengths, False, ())


def _inverted(structure: Structure, group: Dyad) -> BasicLoop | None:
    scene = structure.scene
    frame = scene.frame.name
    one, two, inner = group.outer_first, group.outer_second, group.inner
    moving, fixed = (one, two) if _mate(structure, group, two) == frame else (two, one)
    crank = _mate(structure, group, moving)
    if _mate(structure, group, fixed) != frame or crank == frame:
        return None
    pivot = _pivot(structure, crank)
    if pivot is None or pivot == fixed.point:
        return None
    swinging = group.second.links[0] if fixed is two else group.first.links[0]
    other = group.first.links[0] if fixed is two else group.second.links[0]
    turned = inner.guide.direction.conjugate()
    # of the pivots of both links, the distance at right angles to the guide
    of_guide = ((structure.links[inner.b].points[_joint(one, two, inner.b)] - inner.guide.through) * turned).imag
    of_block = (inner.turn * structure.links[inner.a].points[_joint(one, two, inner.a)]).imag
    lengths = {
        "crank": _between(structure, crank, pivot, moving.point),
        "centres": _between(structure, frame, pivot, fixed.point),
        "offset": abs(of_guide - of_block),
    }
    loop = _guide_bar(scene, lengths, crank, swinging, (crank, other, swinging))
    if swinging == inner.b:
        return loop
    name = loop.name.replace("rotating guide bar (Whitworth)", "rotating block").replace(
        "swinging guide bar", "oscillating block"
    )
    name = name.replace("guide bar", "block")
    return BasicLoop("oscillating block", name, loop.links, lengths, loop.grashof, loop.turns)


def _joint(one: Pair, two: Pair, link: str) -> str:
    return one.point if one.a == link else two.point


def _double_slider(structure: Structure, group: Dyad) -> BasicLoop | None:
    scene = structure.scene
    frame = scene.frame.name
    pairs: tuple[Pair, ...] = group.pairs
    turns = [p for p in pairs if p.turns]
    onto = {end for p in pairs for end in (p.a, p.b)} - set(group.links)
    if frame not in onto or len(onto) != 2:
        return None
    other = next(name for name in onto if name != frame)
    pivot = _pivot(structure, other)
    links = _named(scene, (other, *group.links))
    if group.kind == "RPP" and pivot is not None and turns and turns[0].b == other:
        crank = {"crank": _between(structure, other, pivot, turns[0].point)}
        return BasicLoop("double slider", "Scotch yoke", links, crank, True, (other,))
    return None


_FINDERS: Mapping[DyadKind, Callable[[Structure, Dyad], BasicLoop | None]] = {
    "RRR": _four_bar,
    "RRP": _slider_crank,
    "RPR": _inverted,
    "PRP": _double_slider,
    "RPP": _double_slider,
}
