"""The forces of a larger group by one drawn system: for each link two projections and the moments about one point, with
arms measured on the mechanism; then the polygon of each link, which closes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from graphkin.construction.forces.cut_free import CutFree, HeadToTail, across, dead_point
from graphkin.construction.forces.force_sheet import (
    Acting,
    ForceGroup,
    ForceLine,
    ForceTerm,
    ForceVector,
    KnownMoment,
)
from graphkin.construction.forces.joints import BalanceForm, opposite
from graphkin.plane import added_up, cross, unit
from graphkin.scene.symbol import Symbol
from graphkin.structure import Cluster, Slide

__all__ = ["of_larger_group"]

SINGULAR = 1e-13


@dataclass(frozen=True)
class _Unknown:
    """A force along ``along`` at a place (mm), or a couple (``along`` 0), on link ``on``, its opposite on ``off``."""

    symbol: Symbol
    on: str
    off: str
    at: complex
    along: complex
    point: str = ""
    slide: Slide | None = None


def of_larger_group(cut: CutFree, group: Cluster, balances: Sequence[BalanceForm]) -> ForceGroup:
    """The forces of a group larger than a dyad, or of one that a balance holds otherwise than by a driven link."""
    members = group.members
    cut.load_pins(members)
    unknowns = [*_pins(cut, members), *_slides(cut, members), *(_balance(cut, one) for one in balances)]
    values = _solved(cut, members, unknowns)
    figure = _carried_over(cut, members, unknowns, values)
    cut.done |= set(members)
    return figure(group)


def _pins(cut: CutFree, members: Sequence[str]) -> list[_Unknown]:
    found = []
    for point, holders in cut.names.structure.hinges.items():
        mine = [n for n in holders if n in members]
        if not mine:
            continue
        held = any(n not in members and n not in cut.done for n in holders)
        at = cut.images.point(mine[0], point)
        for link in mine if held else mine[1:]:
            symbol = cut.names.of_pin(point, link)
            off = "" if held else mine[0]
            found += [_Unknown(symbol, link, off, at, way, point) for way in (1 + 0j, 1j)]
    return found


def _slides(cut: CutFree, members: Sequence[str]) -> list[_Unknown]:
    found = []
    for slide in cut.names.structure.slides:
        if slide.key in cut.slides or not {slide.a, slide.b} & set(members):
            continue
        at, square = cut.images.foot(slide), 1j * cut.images.along(slide)
        found.append(_Unknown(cut.names.of_slide(slide), slide.a, slide.b, at, square, slide=slide))
        found.append(_Unknown(cut.names.of_slide(slide, "M"), slide.a, slide.b, at, 0j, slide=slide))
    return found


def _balance(cut: CutFree, balance: BalanceForm) -> _Unknown:
    along, at = (0j, 0j) if balance.is_moment else cut.images.of_balance(balance)
    return _Unknown(balance.symbol, balance.link, balance.other, at, along)


def _solved(cut: CutFree, members: Sequence[str], unknowns: Sequence[_Unknown]) -> list[float]:
    """Sizes of the unknowns, N and N m."""
    mm, size = cut.images.mm, cut.images.sheet.scene.size
    row = {name: 3 * i for i, name in enumerate(members)}
    about = {name: cut.images.sheet.poses[name].origin for name in members}
    left, right = np.zeros((3 * len(members), len(unknowns))), np.zeros(3 * len(members))
    for k, one in enumerate(unknowns):
        for link, sign in ((one.on, 1.0), (one.off, -1.0)):
            if link not in row:
                continue
            i = row[link]
            if one.along == 0:
                left[i + 2, k] += sign
                continue
            arm = cross(one.at - about[link], one.along) / mm / size
            left[i : i + 3, k] += [sign * one.along.real, sign * one.along.imag, sign * arm]
    for link, i in row.items():
        for force in cut.forces_on((link,)):
            arm = cross(force.at - about[link], force.force) / mm / size
            right[i : i + 3] -= [force.force.real, force.force.imag, arm]
        right[i + 2] -= added_up(m.moment for m in cut.moments_on((link,))) / size
    if left.shape[0] != left.shape[1] or not np.isfinite(left).all() or np.linalg.cond(left) > 1.0 / SINGULAR:
        raise dead_point(members)
    found = np.linalg.solve(left, right)
    found += np.linalg.solve(left, right - left @ found)  # a second pass takes back the rounding of the first
    return [float(v * (size if one.along == 0 else 1.0)) for v, one in zip(found, unknowns, strict=True)]


@dataclass(frozen=True)
class _Drawn:
    equation: tuple[ForceTerm, ...]
    polygons: Mapping[str, tuple[ForceVector, ...]]
    lines: tuple[ForceLine, ...]

    def __call__(self, group: Cluster) -> ForceGroup:
        return ForceGroup(
            group.links, group.kind, "drawn system", (), self.equation, (), self.polygons, (), self.lines
        )


def _carried_over(
    cut: CutFree, members: Sequence[str], unknowns: Sequence[_Unknown], values: Sequence[float]
) -> _Drawn:
    """Put what was found to the pairs, and draw the polygon of each link."""
    forces: dict[tuple[Symbol, str, str], complex] = {}
    places: dict[tuple[Symbol, str, str], _Unknown] = {}
    couples: dict[str, float] = {}
    frame = cut.names.structure.scene.frame.name
    for one, value in zip(unknowns, values, strict=True):
        if one.along == 0 and one.slide is not None:
            couples[one.slide.key] = value
        elif one.along == 0:
            cut.balances[one.symbol] = value
            for link, sign in ((one.on, 1.0), (one.off, -1.0)):
                if link not in (*members, frame):  # what drives a link of the group from one still to come loads that
                    cut.turn(KnownMoment(one.symbol, link, sign * value, sign < 0))
        else:
            key = one.symbol, one.on, one.off
            forces[key] = forces.get(key, 0j) + value * one.along
            places[key] = one
    polygons: dict[str, HeadToTail] = {name: HeadToTail() for name in members}
    for name in members:
        cut.lay_known(polygons[name], (name,))
    terms = [ForceTerm(f.symbol, "", True, True, None, f.turned) for name in members for f in cut.forces_on((name,))]
    lines = []
    for key, force in forces.items():
        one = places[key]
        if one.point:
            cut.set_pin(one.point, one.on, force)
            if one.off:
                cut.set_pin(one.point, one.off, -force)
        elif one.slide is not None:
            couple = couples[one.slide.key]
            cut.set_slide(one.slide, force, couple, members)
            if force:
                shift = couple / abs(force)
                at = one.at - 1j * unit(force) * (shift * cut.images.mm)
                lines.append(ForceLine(one.symbol, at, unit(force), shift))
        else:
            cut.balances[one.symbol] = force
            for link, sign in ((one.on, 1.0), (one.off, -1.0)):
                if link not in (*members, frame):
                    cut.push(Acting(one.symbol, link, sign * force, one.at, sign < 0))
        # forces from outside the group, whose sum closes
        if one.off not in members:
            guide = None if one.slide is None else across(one.slide)
            terms.append(ForceTerm(one.symbol, "", False, guide is not None, guide))
        for link, sign in ((one.on, 1.0), (one.off, -1.0)):
            if link not in polygons or link == frame:
                continue
            named = one.symbol if sign > 0 else opposite(one.symbol)
            acting = Acting(named if one.symbol.other else one.symbol, link, sign * force, one.at,
                            sign < 0 and not one.symbol.other)  # fmt: skip
            cut.lay(polygons[link], acting, "", False)
    real = {name: tuple(chain.vectors) for name, chain in polygons.items() if name not in cut.names.blocks}
    return _Drawn(tuple(terms), real, tuple(lines))
