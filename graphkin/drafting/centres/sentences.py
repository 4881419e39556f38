"""How velocities by centres are read off the figure, in sentences: first the links, then the points."""

from __future__ import annotations

from collections.abc import Mapping

from graphkin.drafting.centres.find import Centres
from graphkin.drafting.centres.pairs import Pair
from graphkin.drafting.centres.speeds import Turning, by_centres
from graphkin.plane import dot
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase

__all__ = ["points_asked", "velocity_sentences"]

STILL = 1e-12  # part of the largest speed that is none


def velocity_sentences(centres: Centres, moving: Mapping[str, Turning]) -> tuple[Phrase, ...]:
    """Every link's rate from the link before it in its chain, then every asked point's speed from its link's rate.

    Among the arguments of the phrases, pairs of links stand for centres, `Symbol` for a velocity, `PointRef` for a
    point; distances are those of the figure (mm).
    """
    links = [_of_link(centres, moving, t) for t in moving.values() if len(t.chain) > 1]
    speeds = {s: abs(by_centres(centres, moving, s) or 0.0) for s in points_asked(centres)}
    least = STILL * max(speeds.values(), default=0.0)
    points = [_of_point(centres, moving, s, speed) for s, speed in speeds.items() if speed > least]
    return (*links, *(p for p in points if p is not None))


def points_asked(centres: Centres) -> tuple[Symbol, ...]:
    """The absolute velocities of points that the scene asks for; of every moving pin if it asks for nothing."""
    scene = centres.links.scene
    if scene.find:
        return tuple(s for s in scene.find if s.kind == "v" and s.to is None)
    moving = {name for name in centres.links.names if name != scene.frame.name}
    pins = [p for p, names in scene.holders.items() if p not in scene.frame.points and moving & set(names)]
    return tuple(Symbol("v", PointRef(p)) for p in pins)


def _of_link(centres: Centres, moving: Mapping[str, Turning], turning: Turning) -> Phrase:
    name, known = turning.link, turning.chain[-2]
    frame = centres.links.scene.frame.name
    own, its, common = centres.of(name, frame), centres.of(known, frame), centres.of(name, known)
    pairs: tuple[Pair, ...] = (common.pair, its.pair, own.pair)
    if own.point is None:
        return Phrase("centre slides", (name, known, *pairs))
    if common.point is None:
        return Phrase("centre turns alike", (name, known, *pairs))
    if its.point is None:
        arm = f"{abs(own.point - common.point):.2f}"
        return Phrase("centre from slider", (name, known, *pairs, arm, f"{abs(turning.omega):.6g}"))
    far, near = abs(common.point - its.point), abs(common.point - own.point)
    same = dot(its.point - common.point, own.point - common.point) >= 0.0
    key = "centre same sense" if same else "centre opposite sense"
    return Phrase(key, (name, known, *pairs, f"{far:.2f}", f"{near:.2f}", f"{turning.omega:.6g}".replace("-", "−")))


def _of_point(centres: Centres, moving: Mapping[str, Turning], symbol: Symbol, speed: float) -> Phrase | None:
    """The speed of a point: its distance from the link's centre times the rate; of a link that only translates, the
    speed that the link before it has where both have one velocity."""
    ref, links = symbol.of, centres.links
    assert ref is not None
    frame = links.scene.frame.name
    holders = [ref.link] if ref.link else [n for n in links.scene.holders[ref.point] if n in links.poses]
    turning = next((moving[n] for n in holders if n in moving), None)
    if turning is None:
        return None
    units = links.scene.units
    per_mm = f"{centres.sheet.scales.length / units.metres:.6g} {units.length}/mm"
    said = f"{speed / units.metres:.6g} {units.length}/s"
    own = centres.of(turning.link, frame)
    if own.point is not None:
        arm = abs(links.point(ref.point) - own.point)
        rate, centre = turning, own.pair
        end: PointRef | Pair = ref
    else:
        if len(turning.chain) < 2:
            return None
        rate = moving[turning.chain[-2]]
        its, common = centres.of(rate.link, frame), centres.of(turning.link, rate.link)
        if its.point is None or common.point is None:
            return None
        arm = abs(common.point - its.point)
        centre, end = its.pair, common.pair
    return Phrase(
        "centre speed", (symbol, rate.link, centre, end, f"{abs(rate.omega):.6g}", f"{arm:.2f}", per_mm, said)
    )
