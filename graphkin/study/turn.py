"""The motion of a whole turn: range of the driver, limit positions, strokes, K, transmission, classes, extremes; and
the ranges of the driver in which the mechanism can be assembled, with those that the motion reaches."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from graphkin.errors import Unsolvable
from graphkin.plane import added_up
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import Symbol
from graphkin.search import strokes_between
from graphkin.solver import DriverRange, Motion
from graphkin.solver.path.driver_path import FAR, Path, Stretch, assembled, not_tried
from graphkin.solver.path.driver_range import EQUAL as EQUALLY_FAR
from graphkin.solver.values import FlywheelStudy, flywheel_of
from graphkin.structure import Driven, Dyad, DyadKind, Structure
from graphkin.study.extremes import Extreme, Traced, trace
from graphkin.study.quantities import all_that_moves, course_of, link_quantities, rates_of, slide_quantities

EQUAL = 1e-9
"""Lengths that differ by less than this part of the longest count as equal: a change point."""


SAME_ANGLE = 1e-9
"""Transmission angles (rad) that differ by less are equally small."""


@dataclass(frozen=True)
class Output:
    """A link that the mechanism moves about the frame or along it.

    position : its angle or travel over the turn; the extremes are the limit positions, in which the mechanism is at a
        dead point when the output drives it
    turned : its angle, or its travel where the motion is followed no further, over the range of the driver (rad, m; 0
        for what comes back)
    followed : whether it is followed no further where it may go on or turn back: it has turned back once, or a slide
        drives it
    """

    position: Traced
    turned: float = 0.0
    followed: bool = False

    @property
    def swings(self) -> bool:
        """Whether it moves between limit positions: not for a link that rests, or turns on and on."""
        return self.position.constant is None and not self.turned

    @cached_property
    def lows(self) -> tuple[Extreme, ...]:
        """The limit positions at the least value, by the angle of the crank; from the first of them it moves the whole
        stroke to the first of ``highs``.  None where it does not swing."""
        return self._limits(-1.0)

    @cached_property
    def highs(self) -> tuple[Extreme, ...]:
        return self._limits(1.0)

    def _limits(self, sense: float) -> tuple[Extreme, ...]:
        most, extremes = self.position.furthest(sense), self.position.extremes
        if not self.swings or most is None:
            return ()
        if most.kind == "end" or not math.isfinite(most.value):
            return (most,)
        near = EQUALLY_FAR * max(abs(most.value - e.value) for e in extremes)
        equal = [e for e in extremes if e.kind == most.kind and sense * (most.value - e.value) <= near]
        return tuple(sorted(equal, key=lambda e: (e.driver + EQUALLY_FAR) % math.tau))

    @property
    def quantity(self) -> Symbol:
        return self.position.quantity

    @property
    def stroke(self) -> float | None:
        """Stroke (m) or swing (rad); None for a link that turns on and on or goes away without bound, and
        where its value at an end cannot be computed."""
        if not self.lows or not self.highs or not all(math.isfinite(e.value) for e in self.position.extremes):
            return None
        return self.highs[0].value - self.lows[0].value

    @property
    def without(
        self,
    ) -> Literal["goes away", "not computed", "does not move", "nowhere limited", "turns on", "slides on"]:
        """The phrase for an output without a stroke."""
        if any(math.isinf(e.value) for e in self.position.extremes):
            return "goes away"
        if any(math.isnan(e.value) for e in self.position.extremes):
            return "not computed"
        if self.position.constant is not None:
            return "does not move"
        if self.followed:
            return "nowhere limited"
        return "turns on" if self.quantity.is_angle_of_link else "slides on"


@dataclass(frozen=True)
class Least:
    """The least transmission angle of a group (rad), and the values of the driver there (none if it never changes)."""

    group: Dyad
    angle: float
    drivers: tuple[float, ...]

    @property
    def pressure(self) -> float:
        """The greatest pressure angle (rad)."""
        return float(np.pi / 2) - self.angle


@dataclass(frozen=True)
class BasicLoop:
    """A basic mechanism, by its textbook name.

    Grashof's rule for four-bars, its forms for slider-cranks and their inversions, offsets included (Norton, Design of
    Machinery, ch. 2 and 3; 孙桓 《机械原理》, ch. 8; for the offset Hall, Kinematics and Linkage Design).

    kind : "four-bar", "slider-crank", "guide bar", "oscillating block", "double slider"
    name : "crank-rocker", "swinging guide bar", ...
    links : its links, the frame last
    lengths : by their names (m): "crank", "coupler", "rocker", "frame"; "crank", "rod", "offset"; "crank", "centres",
        "offset"
    grashof : whether some link can turn fully about another; None if the rule does not apply
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
    frame, order = structure.scene.frame.name, structure.scene.order

    def place(name: str) -> int:
        return order.get(name, -1)

    basic: list[BasicLoop] = []
    for group in structure.groups:
        if isinstance(group, Dyad) and all(len(body.links) == 1 for body in group.bodies):
            loop = _FINDERS[group.kind](structure, group)
            if loop is not None:
                links = (*sorted(loop.links, key=place), frame)
                basic.append(replace(loop, links=links, turns=tuple(sorted(loop.turns, key=place))))
    return tuple(basic)


def _pivot(structure: Structure, link: str) -> str | None:
    """The point at which a link turns about the frame."""
    frame = structure.links[structure.scene.frame.name].points
    return next((p for p in structure.links[link].points if p in frame), None)


def _mate(structure: Structure, group: Dyad, joint: Pair) -> str:
    """The link outside a group at one of its outer pins: of several the frame, or a link pivoted to the frame."""
    frame = structure.scene.frame.name
    others = [n for n in structure.hinges.get(joint.point, (joint.b,)) if n not in group.links]
    if frame in others or not others:
        return frame if frame in others else joint.b
    return next((n for n in others if _pivot(structure, n) is not None), others[0])


def _between(structure: Structure, link: str, first: str, second: str) -> float:
    points = structure.links[link].points
    return abs(points[first] - points[second])


def _on_crank(structure: Structure, group: Dyad) -> tuple[tuple[Pair, str], tuple[Pair, str], str, str] | None:
    """For a group that turns about a crank and about the frame: both outer pairs, each with the group's link there, the
    crank's first; the crank and its pivot.  None for another group."""
    frame = structure.scene.frame.name
    moving = group.outer_first, group.first.links[0]
    fixed = group.outer_second, group.second.links[0]
    if _mate(structure, group, fixed[0]) != frame:
        moving, fixed = fixed, moving
    crank = _mate(structure, group, moving[0])
    pivot = _pivot(structure, crank)
    if _mate(structure, group, fixed[0]) != frame or crank == frame or pivot in (None, fixed[0].point):
        return None
    assert pivot is not None
    return moving, fixed, crank, pivot


def _four_bar(structure: Structure, group: Dyad) -> BasicLoop | None:
    ends = _on_crank(structure, group)
    if ends is None:
        return None
    (moving, coupler), (fixed, rocker), crank, pivot = ends
    lengths = {
        "crank": _between(structure, crank, pivot, moving.point),
        "coupler": _between(structure, coupler, moving.point, group.inner.point),
        "rocker": _between(structure, rocker, fixed.point, group.inner.point),
        "frame": _between(structure, structure.scene.frame.name, pivot, fixed.point),
    }
    name, grashof, by = four_bar_class(**lengths)
    turns = tuple({"crank": crank, "rocker": rocker}[b] for b in by)
    return BasicLoop("four-bar", name, (crank, coupler, rocker), lengths, grashof, turns)


def four_bar_class(crank: float, coupler: float, rocker: float, frame: float) -> tuple[str, bool, tuple[str, ...]]:
    """Grashof's class of a four-bar, whether it is a Grashof linkage, and those of "crank" and "rocker" (the two links
    pivoted to the frame) that turn fully.

    At a change point each of the shortest bars turns fully against the bars beside it: both pivoted links do where the
    frame is one of them.  A bar as long as the three others together leaves no motion.

    >>> four_bar_class(150, 500, 300, 400)
    ('crank-rocker', True, ('crank',))
    """
    lengths = {"crank": crank, "coupler": coupler, "rocker": rocker, "frame": frame}
    shortest, longest = min(lengths.values()), max(lengths.values())
    excess = 2 * (shortest + longest) - added_up(lengths.values())
    if abs(excess) <= EQUAL * longest:
        short = [k for k, v in lengths.items() if v <= shortest + EQUAL * longest]
        turning = ("crank", "rocker") if "frame" in short else tuple(k for k in ("crank", "rocker") if k in short)
        return "change point", True, turning
    if excess > 0 and 2 * longest - added_up(lengths.values()) >= -EQUAL * longest:
        return "stretched four-bar", False, ()
    if excess > 0:
        return "triple-rocker", False, ()
    short_one = min(lengths, key=lambda k: lengths[k])
    if short_one == "frame":
        return "double-crank", True, ("crank", "rocker")
    if short_one == "coupler":
        return "double-rocker", True, ()
    return "crank-rocker", True, (short_one,)


def _slider_crank(structure: Structure, group: Dyad) -> BasicLoop | None:
    frame = structure.scene.frame.name
    pin, slide, inner = group.outer_first, group.outer_second, group.inner.point
    rod, slider = group.first.links[0], group.second.links[0]
    crank, guiding = _mate(structure, group, pin), slide.b
    turning = crank if guiding == frame else guiding
    pivot = _pivot(structure, turning)
    if slider != slide.a or (crank == frame) == (guiding == frame) or pivot is None:
        return None
    turned = slide.guide.direction * slide.turn
    on_line = slide.guide.through + turned * structure.links[slide.a].points[inner]
    away = (structure.links[guiding].points[pivot] - on_line) * slide.guide.direction.conjugate()
    arm, offset = _between(structure, rod, pin.point, inner), abs(float(away.imag))
    if guiding == frame:
        lengths = {"crank": _between(structure, crank, pivot, pin.point), "rod": arm, "offset": offset}
        return _slider_crank_named(lengths, (crank, rod, slider))
    if pivot == pin.point:
        return None
    # a turning guide carries the block at the end of a crank
    lengths = {"crank": arm, "centres": _between(structure, frame, pivot, pin.point), "offset": offset}
    return _guide_bar(lengths, rod, guiding, (guiding, slider, rod))


def _slider_crank_named(lengths: dict[str, float], links: tuple[str, ...]) -> BasicLoop:
    r, rod, e = lengths["crank"], lengths["rod"], lengths["offset"]
    equal = EQUAL * max(r, rod, e)
    grashof = abs(rod - r) >= e - equal
    turns = links[:1] if grashof and rod >= r - equal else ()
    if abs(abs(rod - r) - e) <= equal:
        name = "slider-crank at a change point"
    elif grashof:
        name = "slider-crank" if turns else "slider-crank whose rod turns fully"
    else:
        name = "rocker-slider"
    return BasicLoop("slider-crank", f"{'in-line' if e <= equal else 'offset'} {name}", links, lengths, grashof, turns)


def _guide_bar(lengths: dict[str, float], crank: str, bar: str, links: tuple[str, ...]) -> BasicLoop:
    r, d, e = lengths["crank"], lengths["centres"], lengths["offset"]
    equal = EQUAL * max(r, d, e)
    turns: tuple[str, ...] = (crank,)
    if abs(abs(r - d) - e) <= equal:
        # a pivot of the bar within the crank's circle, or on it, lets the bar go round too
        name, turns = "guide bar at a change point", (crank, bar) if r - d >= -equal else (crank,)
    elif r - d > e:
        name, turns = "rotating guide bar (Whitworth)", (crank, bar)
    elif d - r > e:
        name = "swinging guide bar"
    else:
        name, turns = "guide bar without a full turn", ()
    return BasicLoop("guide bar", name, links, lengths, bool(turns), turns)


_BLOCKS = {
    "rotating guide bar (Whitworth)": "rotating block", "swinging guide bar": "oscillating block",
    "guide bar at a change point": "block at a change point",
    "guide bar without a full turn": "block without a full turn",
}
"""Names of guide bars where it is the block that is pivoted to the frame."""


def _inverted(structure: Structure, group: Dyad) -> BasicLoop | None:
    ends = _on_crank(structure, group)
    if ends is None:
        return None
    (moving, other), (fixed, swinging), crank, pivot = ends
    inner = group.inner
    pins = {link: structure.links[link].points[pair.point] for pair, link in ends[:2]}
    # of the pivots of both links, the distance at right angles to the guide
    of_guide = ((pins[inner.b] - inner.guide.through) * inner.guide.direction.conjugate()).imag
    of_block = (inner.turn * pins[inner.a]).imag
    lengths = {
        "crank": _between(structure, crank, pivot, moving.point),
        "centres": _between(structure, structure.scene.frame.name, pivot, fixed.point),
        "offset": abs(of_guide - of_block),
    }
    bar = _guide_bar(lengths, crank, swinging, (crank, other, swinging))
    return bar if swinging == inner.b else replace(bar, kind="oscillating block", name=_BLOCKS[bar.name])


def _double_slider(structure: Structure, group: Dyad) -> BasicLoop | None:
    frame = structure.scene.frame.name
    turns = [p for p in group.pairs if p.turns]
    onto = {end for p in group.pairs for end in (p.a, p.b)} - set(group.links)
    if frame not in onto or len(onto) != 2 or group.kind != "RPP":
        return None
    other = next(name for name in onto if name != frame)
    pivot = _pivot(structure, other)
    if pivot is None or not turns or turns[0].b != other:
        return None
    crank = {"crank": _between(structure, other, pivot, turns[0].point)}
    return BasicLoop("double slider", "Scotch yoke", (other, *group.links), crank, True, (other,))


_FINDERS: Mapping[DyadKind, Callable[[Structure, Dyad], BasicLoop | None]] = {
    "RRR": _four_bar,
    "RRP": _slider_crank,
    "RPR": _inverted,
    "PRP": _double_slider,
    "RPP": _double_slider,
}


@dataclass(frozen=True)
class TurnStudy:
    """The study of the motion over a whole turn (SI)."""

    reach: DriverRange
    ranges: tuple[Stretch, ...]
    outputs: tuple[Output, ...]
    curves: tuple[Traced, ...]
    transmission: tuple[Least, ...]
    loops: tuple[BasicLoop, ...]

    @property
    def scene(self) -> Mechanism:
        return self.reach.scene

    @property
    def not_searched(self) -> tuple[str, ...]:
        """Links whose other assemblies, and so further ranges, are unknown."""
        return not_searched(self.reach)

    @cached_property
    def flywheel(self) -> FlywheelStudy | Unsolvable | None:
        """The flywheel that the scene asks for, or the reason why it has none; None if it asks for none."""
        if self.scene.loading.flywheel is None:
            return None
        try:
            return flywheel_of(self.reach)
        except Unsolvable as stop:
            return stop

    def quick_return(self, output: Output) -> tuple[float, float] | None:
        """K of an output (quick-return or time ratio), and the crank angle theta (rad) between its limit positions, as
        `Strokes` have them: dwells and the way between equal limit positions not counted; None where it has none."""
        if not output.lows or not output.highs or self.reach.turns != 1:
            return None
        lows, highs = ([(e.offset, e.rest) for e in equal] for equal in (output.lows, output.highs))
        strokes = strokes_between(lows, highs, math.tau)
        return None if strokes.lag > np.pi * (1 - 2e-12) else (strokes.ratio, strokes.lag)


def study_turn(reach: DriverRange, asked: Sequence[Symbol] = (), everything: bool = True) -> TurnStudy:
    """Study the whole range.

    Parameters
    ----------
    asked : quantities whose extremes and zeros are wanted besides those of the outputs and their rates; without outputs
        those of every link and sliding pair
    everything : False gives only the limit positions of the outputs, transmission and classes
    """
    mains = [link_quantities(name)[0] for name in output_links(reach.scene)]
    mains += [slide_quantities(key)[0] for key in output_slides(reach.known)]
    wanted = list(mains)
    if everything:
        for main in mains:
            wanted += [q for q in rates_of(main) if q not in wanted]
        others = asked or [q for q in all_that_moves(reach.structure) if q.of is None and q.scope != "force"]
        wanted += [q for q in others if q not in wanted]
    groups = {Symbol("transmission", name=d.label): d for d in reach.structure.dyads.values()}
    traced = trace(reach, (*wanted, *groups))
    outputs = tuple(_output(reach, t) for t in traced if t.quantity in mains)
    known = (t for t in traced if t.quantity in groups and not (t.least is None and t.constant is None))
    leasts = tuple(_least(groups[t.quantity], t) for t in known)
    curves = tuple(t for t in traced if t.quantity not in groups)
    return TurnStudy(reach, ranges(reach), outputs, curves, leasts, loops(reach.structure))


def _least(group: Dyad, angle: Traced) -> Least:
    if angle.least is None:
        return Least(group, angle.constant or 0.0, ())
    least = angle.least.value
    if any(e.kind == "max" for e in angle.extremes) and all(abs(e.value - least) <= SAME_ANGLE for e in angle.extremes):
        return Least(group, least, ())  # it changes by rounding alone
    places = [e.driver for e in angle.extremes if e.kind != "max" and abs(e.value - least) <= SAME_ANGLE]
    return Least(group, least, tuple(places))


def output_links(scene: Mechanism) -> tuple[str, ...]:
    """Links pivoted to the frame that no driver turns about it."""
    frame = scene.frame
    driven = {d.link for d in scene.drivers if d.turns_about(frame.name)}
    sliding = {s.a for s in scene.slidings}
    return tuple(
        link.name
        for link in scene.links
        if link.name not in driven
        and not (link.name in sliding and len(link.points) == 1)
        and scene.pivots(link.name)
    )


def output_slides(motion: Motion) -> tuple[str, ...]:
    """Sliding pairs along the frame that no driver moves."""
    scene = motion.scene
    driven = {d.key for d in scene.drivers}
    return tuple(
        s.key for s in motion.slides if scene.frame.name in (s.a, s.b) and s.key not in driven and not s.higher
    )


def _output(reach: DriverRange, position: Traced) -> Output:
    if position.constant is not None or not (reach.full or not all(reach.limited)):
        return Output(position)
    at_ends = course_of(position.quantity, reach, reach.at_ends)
    turned = float(np.diff(at_ends)[0])
    if reach.full:
        return Output(position, turned if position.quantity.is_angle_of_link and abs(turned) > 1.0 else 0.0)
    # where the motion is followed no further, it comes back if its own limits hold it there
    places, room = [e.value for e in position.extremes], BESIDE * (1.0 + abs(turned))
    open_ends = at_ends[~np.array(reach.limited)]
    held = len(places) > 1 and min(places) - room <= min(open_ends) and max(open_ends) <= max(places) + room
    once = sum(e.kind != "end" for e in position.extremes) == 1
    return Output(position) if held else Output(position, turned, once or not reach.driver.turns)


BESIDE = 1e-9
"""Ranges (rad, m) that overlap by less have only their ends in common."""


def ranges(reach: DriverRange) -> tuple[Stretch, ...]:
    """The range that the motion reaches, then all others in which some assembly closes, except those of
    ``not_searched``: within a turn of the driver; of a driven slide within four sizes of the mechanism and twice as far
    as its motion reaches."""
    if reach.full:
        return (Stretch(0.0, 2 * np.pi * reach.turns),)
    low, high = sorted(reach.value(np.array(reach.ends)).tolist())
    below, above = reach.limited if reach.sense > 0 else reach.limited[::-1]
    stretch = Stretch(low, high, (below, above))
    dyads = [*reach.structure.dyads]
    if not dyads or not_searched(reach):
        return (stretch,)
    return stretch, *_elsewhere(reach, dyads, stretch)


def not_searched(reach: DriverRange) -> tuple[str, ...]:
    """Links whose other assemblies, and so further ranges, are unknown: of larger groups (known only along their
    motion), of groups after rolling links (their place differs after each turn), or of too many groups to try."""
    if reach.full:
        return ()
    elements, larger = reach.structure.elements, [e.links for e in reach.structure.larger_groups]
    rolled = next((i for i, e in enumerate(elements) if isinstance(e, Driven) and e.rolled is not None), len(elements))
    behind = [e.links for i, e in reach.structure.dyads.items() if i > rolled]
    many = behind or not_tried(reach.structure) if not larger else []
    return tuple(name for links in (*larger, *many) for name in links)


def _elsewhere(reach: DriverRange, dyads: list[int], reached: Stretch) -> list[Stretch]:
    turning = reach.driver.turns
    wide = max(FAR * reach.scene.size, 2 * abs(reached.low), 2 * abs(reached.high))
    first, last = (reached.low + BESIDE, reached.low + BESIDE + 2 * np.pi) if turning else (-wide, wide)
    stretches = assembled(Path.of_driver(reach.structure, reach.start), dyads, first, last, {})
    joined = list[tuple[float, float]]()
    for low, high in sorted((stretch.low, stretch.high) for _, stretch in stretches):
        if joined and low < joined[-1][1] - BESIDE:
            joined[-1] = joined[-1][0], max(high, joined[-1][1])
        else:
            joined.append((low, high))
    # what the motion reaches stands by itself, of a driver that turns at the beginning
    parts = [part for low, high in joined for part in ((low, min(high, reached.low)), (max(low, reached.high), high))]
    # beyond where it is followed no further the motion goes on
    open_ends = [end for end, limited in zip((reached.low, reached.high), reached.ends, strict=True) if not limited]
    parts = [
        (low, high) for low, high in parts
        if high - low > 2 * BESIDE and not any(end in (low, high) for end in open_ends)
    ]
    if turning:
        # with their middles in (-pi, pi]
        shifts = (2 * np.pi * float(np.ceil(((low + high) / 2 - np.pi - 1e-9) / (2 * np.pi))) for low, high in parts)
        return [Stretch(low - shift, high - shift, (True, True))
                for (low, high), shift in zip(parts, shifts, strict=True)]
    return [Stretch(low, high, (low != first, high != last)) for low, high in parts]
