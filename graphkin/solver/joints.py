"""The joints of a structure as frames of axes: on links, between links held together, under drivers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from graphkin.scene.cams import LawCam
from graphkin.scene.model import Driver, Mechanism
from graphkin.solver.dyads import Joints
from graphkin.solver.expressions import PoseFormula, Real, Vec
from graphkin.solver.pose import Array
from graphkin.structure import Body, Driven, Dyad, Pair, Rolled, Structure, Turn
from graphkin.words import Phrase, Wording

__all__ = ["Drive", "Frames", "body_shape", "driven", "driver_text", "dyad_joints", "joint_place", "members", "turned"]


@dataclass(frozen=True)
class Drive:
    """Values of the drivers and their rates: arrays of shape (positions, drivers), SI."""

    value: Array
    rate: Array
    second: Array

    @classmethod
    def at(cls, structure: Structure, value: Array) -> Drive:
        """The drivers at these values, with the rates of the scene."""
        given = np.array([d.values for d in structure.scene.drivers]).reshape(-1, 3)
        shape = value.shape
        return cls(value, np.broadcast_to(given[:, 1], shape), np.broadcast_to(given[:, 2], shape))

    def __len__(self) -> int:
        return len(self.value)

    def followed(self, structure: Structure) -> Drive:
        """With the columns of what follows the drivers by rolling."""
        if self.value.shape[1] == len(structure.drivers):
            return self
        ratios = np.array([f.ratios for f in structure.followers]).T
        own = np.array([d.values[0] for d in structure.scene.drivers])
        start = np.array([f.values[0] for f in structure.followers])
        columns = (self.value, start + (self.value - own) @ ratios), (self.rate, self.rate @ ratios)
        return Drive(*(np.concatenate(pair, axis=1) for pair in (*columns, (self.second, self.second @ ratios))))

    def __getitem__(self, which: Array | slice) -> Drive:
        return Drive(self.value[which], self.rate[which], self.second[which])


def turned(angle: Array) -> Array:
    """Unit complex numbers at angles, exact at multiples of 90 degrees (within the rounding of the angle itself)."""
    u = np.empty(np.shape(angle), dtype=np.complex128)
    zero = np.abs(angle) * 4e-16
    for part, function in ((u.real, np.cos), (u.imag, np.sin)):
        function(angle, part)
        part[np.abs(part) <= zero] = 0.0
    return u


def driver_text(scene: Mechanism, driver: Driver, value: float) -> Wording:
    """A driver value in its own unit."""
    if driver.turns:
        return Phrase("so many degrees", value=f"{np.degrees(value):.10g}")
    return f"{value / scene.units.metres:.10g} {scene.units.length}"


def joint_place(structure: Structure, pair: Pair, link: str) -> tuple[complex, complex]:
    """Origin and direction of the joint's frame in the axes of one of its links (at a sliding pair: of the guide)."""
    if isinstance(pair, Turn):
        return structure.links[link].points[pair.point], 1 + 0j
    if link == pair.a:
        return 0j, pair.turn.conjugate()
    return pair.guide.through, pair.guide.direction


class Frames(Protocol):
    """Where frames of axes come from: those of joints on their links, and what the drivers give."""

    structure: Structure

    def rest(self, pair: Pair, link: str) -> PoseFormula:
        """The joint's frame in the axes of one of its links."""

    def turn(self, driver: Driver) -> PoseFormula:
        """The rotation that an angle driver gives."""

    def travel(self, driver: Driver) -> tuple[Real, Real, Real]:
        """Value, rate and second rate of a slide driver."""

    def lift(self, cam: LawCam) -> tuple[Real | Vec, Real, Real]:
        """Where a follower stands, its travel or the direction of its own axis, and its first and second derivative by
        the angle of the cam."""


    def rolled(self, rolled: Rolled) -> tuple[Real | Vec, Real, Real]:
        """Where what rolls stands, its travel or the direction of its own axis, with its rates."""


def driven(frames: Frames, element: Driven, poses: Mapping[str, PoseFormula]) -> PoseFormula:
    """The pose of a link that a driver or a cam moves from known links: crank, driven slider, follower."""
    pair, link = element.pair, element.link
    base = pair.b if pair.a == link else pair.a
    mine, theirs = frames.rest(pair, link), frames.rest(pair, base)
    at = poses[base].fixed(theirs.z, theirs.u)
    if isinstance(element.driver, LawCam):
        stands, slope, bend = frames.lift(element.driver)
        cam = poses[element.driver.link]
        rate, second = slope * cam.omega, bend * (cam.omega * cam.omega) + slope * cam.alpha
        if isinstance(stands, Vec):
            return at.pinned(mine, stands, rate, second)
        return at.along(stands, rate, second).of(mine.inverse())
    if isinstance(element.driver, Rolled):
        stands, rate, second = frames.rolled(element.driver)
        if isinstance(stands, Vec):
            return at.pinned(mine, stands, rate, second)
        sense = 1.0 if pair.a == link else -1.0
        return at.along(stands * sense, rate * sense, second * sense).of(mine.inverse())
    if element.driver.turns:
        given = frames.turn(element.driver)
        forward = element.driver.link == link
        from_ = poses[element.driver.relative_to if forward else element.driver.link]
        seen = from_.of(given if forward else given.inverse())
        return at.pinned(mine, seen.u, seen.omega, seen.alpha)
    travel, rate, second = frames.travel(element.driver)
    if pair.a == link:
        return at.along(travel, rate, second).of(mine.inverse())
    return at.along(-travel, -rate, -second).of(mine.inverse())


def body_shape(frames: Frames, body: Body, rest: PoseFormula) -> dict[str, PoseFormula]:
    """Every link of a body in the axes of its base; ``rest`` are axes that do not move."""
    shape = {body.links[0]: rest}
    for weld in body.welds:
        joint = shape[weld.a].of(frames.rest(weld.pair, weld.a))
        if weld.driver.turns:
            given = frames.turn(weld.driver)
            joint = joint.of(given if weld.sign > 0 else given.inverse())
        else:
            travel, rate, second = frames.travel(weld.driver)
            if weld.b != weld.pair.a:
                travel, rate, second = -travel, -rate, -second
            joint = joint.along(travel, rate, second)
        shape[weld.b] = joint.of(frames.rest(weld.pair, weld.b).inverse())
    return shape


def dyad_joints(
    frames: Frames, dyad: Dyad, shapes: tuple[dict[str, PoseFormula], dict[str, PoseFormula]],
    poses: Mapping[str, PoseFormula], size: Real,
) -> Joints[Vec, Real]:  # fmt: skip
    """The six joint frames of a dyad."""

    def inside(pair: Pair, shape: Mapping[str, PoseFormula]) -> tuple[PoseFormula, str]:
        link = pair.a if pair.a in shape else pair.b
        at = frames.rest(pair, link)
        return shape[link].fixed(at.z, at.u), link

    def known(pair: Pair, link: str) -> PoseFormula:
        base = pair.b if link == pair.a else pair.a
        at = frames.rest(pair, base)
        return poses[base].fixed(at.z, at.u)

    outer1, link1 = inside(dyad.outer_first, shapes[0])
    outer2, link2 = inside(dyad.outer_second, shapes[1])
    return Joints(
        known(dyad.outer_first, link1),
        outer1,
        inside(dyad.inner, shapes[0])[0],
        known(dyad.outer_second, link2),
        outer2,
        inside(dyad.inner, shapes[1])[0],
        1.0 if link2 == dyad.outer_second.a else -1.0,
        size,
    )


def members(shape: Mapping[str, PoseFormula], base: PoseFormula) -> dict[str, PoseFormula]:
    """The links of a body in the world, from the base's pose."""
    return {link: base.of(pose) for link, pose in shape.items()}
