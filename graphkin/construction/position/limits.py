"""Limit positions of a slide or a link over a whole turn of the crank, found on the drawing board.

The mechanism is drawn at many positions of the crank; at the highest and lowest position of the output a smooth curve
through the positions nearby gives the place to the last digits.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial import chebyshev

from graphkin.construction.board.instruments import Instrument
from graphkin.construction.board.scales import Scales
from graphkin.construction.board.sheet import LimitPosition, Limits
from graphkin.construction.position.links_on_paper import moved, travel, walk
from graphkin.construction.position.position import Assembly, assembly_at, found_near, place, poses_at
from graphkin.construction.position.reduced_mechanism import PlacedElements
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import Poses
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import Symbol
from graphkin.search import strokes_between
from graphkin.structure import Element, Structure, analyse
from graphkin.structure.transmission import sliding_pair
from graphkin.words import Phrase

STEP = math.radians(3.0)
SURPRISE, AT_FIRST = 0.05, 0.28  # so far from where it was expected a link may be found, and at first
SMALLEST = 1e-5  # steps shorter than this part of the usual one find nothing
NODES = 16
RESOLVED = 1e-13
CLOSED = 1e-7
STILL = 1e-11
EQUAL = 1e-9
"""Of the swing: extremes that differ by less are equal; and of the crank's angle, within which it is 0 (rad)."""

_NODES = np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES)
_FIT = np.linalg.inv(chebyshev.chebvander(_NODES, NODES - 1))


@dataclass(frozen=True)
class TurnOfCrank:
    """Positions over a whole turn of the first driver, from ``values`` of the drivers (rad, m) on, each followed from
    the one before, on paper of the mechanism's size."""

    placed: PlacedElements
    values: Mapping[str, float]
    positions: tuple[LimitPosition, ...]

    @classmethod
    def of(cls, structure: Structure, elements: Sequence[Element], values: Mapping[str, float], poses: Poses,
           why: str) -> TurnOfCrank:
        """Follow a whole turn from the poses of all links at driver ``values``; ``why`` names the asked quantity in a
        message.

        Raises
        ------
        Unsolvable : the first driver is no crank, or does not turn fully, or the motion does not repeat after one turn
        """
        driver = structure.scene.drivers[0]
        if not driver.turns:
            raise Unsolvable("no whole turn", Problem(why, "belongs to a whole turn but the driver",
                                                      "ask for s_ theta_ or d_ at single"))
        links = {structure.scene.frame.name, *(n for e in elements for n in e.members)}
        start = LimitPosition(values[driver.key], {name: pose for name, pose in poses.items() if name in links})
        turn = cls(PlacedElements(structure, elements), values, (start,))
        end = start.value + math.tau
        steps = walk(turn.near, start.poses, start.value, end, STEP, SMALLEST * STEP, SURPRISE, at_first=AT_FIRST)
        positions = [start, *(LimitPosition(*at) for at in steps)]
        if positions[-1].value < end:
            raise Unsolvable("no whole turn", _short(why, driver.link, positions[-1].value))
        if moved(start.poses, positions[-1].poses) > CLOSED:
            raise Unsolvable("no whole turn", Problem(why, "the motion does not repeat after one turn"))
        return replace(turn, positions=tuple(positions))

    def near(self, value: float, guess: Poses, before: Poses | None = None) -> Poses | None:
        """The links at a crank's value, near their expected places, and followed from others; None where they do not
        fit there."""
        values = {**self.values, self.placed.structure.scene.drivers[0].key: value}
        return found_near(self.placed, values, guess, self.positions[0].poses, before)

    def limits(self, output: Pair | str, why: str) -> Limits:
        """The lowest and the highest position of a slide (by its travel) or of a link (by its angle).  Raises
        Unsolvable for a link that turns on and on.
        """
        travels: list[float] = []
        for here in self.positions:
            travels.append(_along(output, here.poses, travels[-1] if travels else 0.0))
        if isinstance(output, str) and abs(travels[-1] - travels[0]) > 1.0:
            raise Unsolvable("no whole turn", Problem(why, "link turns on and on it has no",
                                                      "ask for a link that swings or a", output=output))
        if max(travels) - min(travels) < STILL:
            name = output if isinstance(output, str) else output.key
            raise Unsolvable("no whole turn", Problem(why, "does not move it has no limit positions",
                                                      "ask for an output that moves", name=name))
        lows, highs = (self._extremes(output, travels, sign) for sign in (-1.0, 1.0))
        sense = -1.0 if self.placed.structure.scene.drivers[0].rate < 0.0 else 1.0
        below, above = ([(sense * limit.value + EQUAL, 0.0) for limit in equal] for equal in (lows, highs))
        strokes = strokes_between(below, above, math.tau)
        low, high = lows[strokes.low], highs[strokes.high]
        if len(lows) == len(highs) == 1:
            return low, high
        between = sense * (high.value - low.value) % math.tau
        return replace(low, rest=math.tau - between - strokes.back), replace(high, rest=between - strokes.out)

    def _extremes(self, output: Pair | str, travels: Sequence[float], sign: float) -> list[LimitPosition]:
        """The highest position (``sign`` 1), or the lowest (-1), and all that are equal to it."""
        height = [sign * value for value in travels]
        before = height[-2], *height
        tops = [k for k in range(len(height) - 1) if before[k] < height[k] >= height[k + 1]]
        best, swing = max(height[k] for k in tops), max(travels) - min(travels)
        extremes = [self._refined(output, k, travels[k]) for k in tops if height[k] > best - 0.02 * swing]
        most = max(sign * value for _, value in extremes)
        turns = isinstance(output, str)
        return [replace(here, angle=value) if turns else here
                for here, value in extremes if sign * value > most - EQUAL * swing]

    def _refined(self, output: Pair | str, k: int, roughly: float) -> tuple[LimitPosition, float]:
        """The extreme of a curve through the positions about the k-th."""
        poses, crank = self.positions[k].poses, self.placed.structure.scene.drivers[0].key
        middle, half = self.positions[k].value, 2 * STEP
        for _ in range(24):
            heights = []
            for at in middle + half * _NODES:
                near = self.near(float(at), poses)
                if near is None:
                    raise Unsolvable("no whole turn", _short(str(output), crank, at))
                poses = near
                heights.append(_along(output, poses, roughly))
            c = _FIT @ np.array(heights)
            roots = chebyshev.chebroots(chebyshev.chebder(c))
            x = min((z.real for z in roots if abs(z.imag) < 1e-6 and abs(z.real) <= 1.0), key=abs, default=0.0)
            good = np.abs(c[-3:]).max() <= RESOLVED * np.abs(c).max()
            curved = np.abs(c[1:]).max() > 1e-3 * abs(c[0]) * SMALLEST
            middle += half * float(x)
            poses = self.near(middle, poses) or poses
            if (good and abs(x) < 0.7) or not curved or half < 1e-3:
                break
            half = half if good else half / 2
        at_rest = self.near(middle, poses)
        limit = self.positions[k] if at_rest is None else LimitPosition(middle, at_rest)
        return limit, _along(output, limit.poses, roughly)


def limits_asked(
    structure: Structure, asked: Sequence[Symbol], elements: Sequence[Element], values: Mapping[str, float],
    poses: Poses,
) -> dict[str, Limits]:
    """The limit positions of every drawn output with an asked quantity of the whole turn, by its name, from driver
    values (rad, m) and the links' poses there, on paper of the mechanism's size.

    Raises
    ------
    Unsolvable : no whole turn, or a link that has no limit positions
    CallError : an unknown sliding pair
    """
    if structure.scene.instead_of is not None:
        return _follower_limits(structure.scene.whole, asked, values)
    limits: dict[str, Limits] = {}
    turn: TurnOfCrank | None = None
    redundant = structure.scene.by_name.keys() - structure.links.keys()
    for symbol in asked:
        if symbol.scope != "turn" or symbol.pair in limits or not redundant.isdisjoint(symbol.links()):
            continue
        output = sliding_pair(structure.slides, symbol) if symbol.other else symbol.link
        if output == structure.scene.drivers[0].link:  # alone it turns on and on: other links may stop it
            elements, turn = structure.elements, None
            poses = poses_at(PlacedElements(structure, elements), values)
        turn = turn or TurnOfCrank.of(structure, elements, values, poses, str(symbol))
        limits[symbol.pair] = turn.limits(output, str(symbol))
    return limits


def _follower_limits(scene: Mechanism, asked: Sequence[Symbol], values: Mapping[str, float]) -> dict[str, Limits]:
    """The limit positions of followers by the law; of a dwell its end.

    Raises
    ------
    Unsolvable : for a link that is no follower of the driven cam
    """
    limits: dict[str, Limits] = {}
    structure, driver = analyse(scene), scene.drivers[0]
    for symbol in asked:
        if symbol.scope != "turn" or symbol.pair in limits:
            continue
        cam = scene.law_of(symbol.pair)
        if cam is None or driver.key != cam.link or not driver.turns_about(scene.frame.name):
            said = Phrase("is drawn of followers of the driven cam"), Phrase("ask for s_ theta_ or d_ at single")
            raise Unsolvable("no whole turn", Problem(str(symbol), *said))
        ends, side = [], cam.motion.side
        for lift in (cam.law.least, cam.law.greatest)[::side]:
            value, rest = cam.leaves(lift, -1 if driver.rate < 0.0 else 1)
            poses = poses_at(PlacedElements(structure, structure.elements), {**values, driver.key: value})
            ends.append(LimitPosition(value, poses, side * lift, rest))
        limits[symbol.pair] = ends[0], ends[1]
    return limits


def limits_on_paper(
    exact: Mapping[str, Limits], structure: Structure, elements: Sequence[Element], values: Mapping[str, float],
    scales: Scales, hand: Instrument,
) -> dict[str, Limits]:
    """Limit positions, found by exact hands on paper of the mechanism's size, drawn at a scale by any hands."""
    mm, key, on_paper = 1.0 / scales.length, structure.scene.drivers[0].key, dict[str, Limits]()
    if hand.faultless or structure.scene.instead_of is not None:
        k = structure.scene.size * mm
        return {pair: (low.scaled(k), high.scaled(k)) for pair, (low, high) in exact.items()}
    for pair, limits in exact.items():
        drawn = []
        for limit in limits:
            there = {**values, key: limit.value}
            assembly = assembly_at(structure, elements, there, Assembly(there, limit.poses))
            drawn.append(replace(limit, poses=place(structure, elements, mm, assembly, hand).poses))
        on_paper[pair] = drawn[0], drawn[1]
    return on_paper


def _short(why: str, link: str, value: float) -> Problem:
    """The problem of a quantity of the whole turn whose crank stops near a value (rad)."""
    end = Phrase("it stops near deg", degrees=f'{math.degrees(value):.2f}')
    return Problem(why, "belongs to a whole turn but driver does", "ask for s_ theta_ or d_ at single", link=link,
                   end=end)


def _along(output: Pair | str, poses: Poses, near: float) -> float:
    """Travel of a slide (mm of paper of the mechanism's size, from anywhere), or a link's angle nearest to a known
    one."""
    if isinstance(output, str):
        angle = cmath.phase(poses[output].axis)
        return angle + math.tau * round((near - angle) / math.tau)
    return travel(output, poses, 0.0)  # from wherever the guide has its origin: only differences are of interest
