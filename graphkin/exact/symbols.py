"""Quantities by their symbols, out of a motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from graphkin.errors import CallError, Problem
from graphkin.exact.pose import Array
from graphkin.scene.symbol import PointRef, Symbol

if TYPE_CHECKING:
    from graphkin.exact.motion import Motion

__all__ = ["evaluate"]


def evaluate(motion: Motion, symbol: Symbol) -> Array:
    """The value of a symbol (see ``Motion.value``)."""
    if symbol.kind == "omega":
        return motion.omega(symbol.link)
    if symbol.kind == "alpha":
        return motion.alpha(symbol.link)
    assert symbol.of is not None
    if symbol.kind in ("v", "a"):
        one = motion.point(symbol.of.point, symbol.of.link)
        if symbol.to is None:
            return np.asarray(one.v if symbol.kind == "v" else one.a)
        two = motion.point(symbol.to.point, symbol.to.link)
        return np.asarray(one.v - two.v if symbol.kind == "v" else one.a - two.a)
    hinge = _hinge(motion, symbol.of, symbol.to)
    if symbol.to is not None and hinge is not None and symbol.kind != "ar":
        return _turned(motion, symbol, symbol.of, symbol.to, hinge)
    if symbol.kind in ("an", "at"):
        return _turning(motion, symbol, symbol.of)
    assert symbol.to is not None
    return _sliding(motion, symbol, symbol.of, symbol.to)


def _is_on(motion: Motion, ref: PointRef, link: str) -> bool:
    """True where the point is one of the link's, or the link's point under that pin."""
    holders = motion.scene.holders
    if ref.point not in holders:
        motion.point(ref.point)
    if ref.link == link:
        return True
    own = not ref.link or ref.link in holders[ref.point]
    return own and link in holders[ref.point]


def _hinge(motion: Motion, of: PointRef, to: PointRef | None) -> str | None:
    """The turning pair between the links of two coincident points, where it lies elsewhere."""
    if to is None or of.point != to.point or not (of.link and to.link) or of.link == to.link:
        return None
    links = motion.scene.by_name
    if not {of.link, to.link} <= set(links):
        return None
    return next((p for p in links[of.link].points if p in links[to.link].points and p != of.point), None)


def _turned(motion: Motion, symbol: Symbol, of: PointRef, to: PointRef, hinge: str) -> Array:
    """Parts of the acceleration of a point of a link relative to the coincident one of a link that is hinged to it.

    Seen from the second link the first turns about the hinge at the difference of their rates: normal and tangential
    part of that turn, and the Coriolis term of the second link's own rate.
    """
    one, base = motion.poses[of.link], motion.poses[to.link]
    arm = motion.point(of.point, of.link).z - motion.point(hinge, of.link).z
    rate = one.omega - base.omega
    if symbol.kind == "an":
        return np.asarray(-(rate**2) * arm)
    if symbol.kind == "at":
        return np.asarray(1j * (one.alpha - base.alpha) * arm)
    return np.asarray(-2 * base.omega * rate * arm)


def _turning(motion: Motion, symbol: Symbol, of: PointRef) -> Array:
    """Normal and tangential part of the acceleration of one point of a link about another."""
    if of.link:
        motion.link(of.link)
    frame = motion.scene.frame
    moving = [link.name for link in motion.scene.links]
    for name in moving:
        if not _is_on(motion, of, name):
            continue
        pose = motion.poses[name]
        at = motion.point(of.point, name)
        if symbol.to is not None:
            if not _is_on(motion, symbol.to, name):
                continue
            arm = at.z - motion.point(symbol.to.point, name).z
        else:
            pivot = next((p for p in motion.scene.by_name[name].points if p in frame.points and p != of.point), None)
            if pivot is None:
                continue
            arm = at.z - motion.point(pivot, name).z
        return np.asarray(-(pose.omega**2) * arm if symbol.kind == "an" else 1j * pose.alpha * arm)
    wanted = (
        "both points must be on one link"
        if symbol.to
        else f"{of} turns about no fixed point; write {symbol}/A with A on its link"
    )
    raise CallError(Problem(str(symbol), "no link makes this part", wanted))


def _sliding(motion: Motion, symbol: Symbol, of: PointRef, to: PointRef) -> Array:
    """Coriolis and sliding part of the acceleration of a point relative to the coincident one of another link."""
    for ref in (of, to):
        motion.point(ref.point, ref.link)
    for pair in motion.slides:
        block = {pair.a}
        if pair.slot:
            block = {pin.of for pin in motion.scene.pins if pin.key == pair.key}
        sides = (block, {pair.b})
        for one, two in (sides, sides[::-1]):
            if of.point != to.point:
                continue
            if not any(_is_on(motion, of, n) for n in one) or not any(_is_on(motion, to, n) for n in two):
                continue
            first = motion.point(of.point, of.link)
            second = motion.point(to.point, to.link)
            omega = motion.poses[pair.b].omega
            coriolis = 2j * omega * (first.v - second.v)
            return np.asarray(coriolis if symbol.kind == "ak" else first.a - second.a - coriolis)
    pairs = [s for s in motion.slides if s.pin]
    example = (
        f"write for example {symbol.kind}_{pairs[0].pin}@{pairs[0].b}/{pairs[0].pin}"
        if pairs
        else "nothing slides here"
    )
    raise CallError(
        Problem(str(symbol), "these are not coincident points of two links that slide on each other", example)
    )
