"""The joints of a structure as frames of axes: on links, between links held together, under drivers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphkin.exact.dyads import Joints
from graphkin.exact.pose import Array, Pose, rest
from graphkin.scene.model import AngleDriver, Driver, Scene
from graphkin.structure import Body, Driven, Dyad, Pair, Structure, Turn

__all__ = ["Drive", "body_shape", "driven", "driver_text", "dyad_joints", "joint_place", "members"]


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

    def __getitem__(self, which: Array | slice) -> Drive:
        return Drive(self.value[which], self.rate[which], self.second[which])

    def turn(self, column: int) -> Pose:
        """The rotation that an angle driver gives."""
        none = np.zeros(1, dtype=np.complex128)
        return Pose(none, turned(self.value[:, column]), none, self.rate[:, column], none, self.second[:, column])

    def slid(self, column: int, base: Pose) -> Pose:
        """A frame moved along itself as a slide driver gives."""
        return base.along(self.value[:, column], self.rate[:, column], self.second[:, column])


def turned(angle: Array) -> Array:
    """Unit complex numbers at angles, exact at multiples of 90 degrees (within the rounding of the angle itself)."""
    quarters = np.rint(angle / (np.pi / 2))
    rest_of = angle - quarters * (np.pi / 2)
    rest_of = np.where(np.abs(rest_of) <= 4e-16 * np.abs(angle), 0.0, rest_of)
    return np.array([1, 1j, -1, -1j])[quarters.astype(np.int64) % 4] * (np.cos(rest_of) + 1j * np.sin(rest_of))


def driver_text(scene: Scene, driver: Driver, value: float) -> str:
    """A driver value in its own unit."""
    if isinstance(driver, AngleDriver):
        return f"{np.degrees(value):.10g} deg"
    return f"{value / scene.units.metres:.10g} {scene.units.length}"


def joint_place(structure: Structure, pair: Pair, link: str) -> tuple[complex, complex]:
    """Origin and direction of the joint's frame in the axes of one of its links (at a sliding pair: of the guide)."""
    if isinstance(pair, Turn):
        return structure.links[link].points[pair.point], 1 + 0j
    if link == pair.a:
        return 0j, pair.turn.conjugate()
    return pair.guide.through, pair.guide.direction


def _column(structure: Structure, driver: Driver) -> int:
    return structure.scene.drivers.index(driver)


def driven(structure: Structure, element: Driven, poses: Mapping[str, Pose], drive: Drive) -> Pose:
    """The pose of a link that a driver moves from known links: crank, driven slider."""
    pair, link = element.pair, element.link
    column = _column(structure, element.driver)
    base = pair.b if pair.a == link else pair.a
    mine, theirs = joint_place(structure, pair, link), joint_place(structure, pair, base)
    at = poses[base].fixed(*theirs)
    if isinstance(element.driver, AngleDriver):
        given = drive.turn(column)
        forward = element.driver.link == link
        from_ = poses[element.driver.relative_to if forward else element.driver.link]
        seen = from_.of(given if forward else given.inverse())
        return at.hung(rest(mine[0]), seen.u, seen.omega, seen.alpha)
    given = drive.slid(column, rest())
    return at.of(given if pair.a == link else given.inverse()).of(rest(*mine).inverse())


def body_shape(structure: Structure, body: Body, drive: Drive) -> dict[str, Pose]:
    """Every link of a body in the axes of its base."""
    shape = {body.links[0]: rest()}
    for weld in body.welds:
        column = _column(structure, weld.driver)
        on, by = joint_place(structure, weld.pair, weld.a), joint_place(structure, weld.pair, weld.b)
        if isinstance(weld.driver, AngleDriver):
            given = drive.turn(column)
            between = given if weld.sign > 0 else given.inverse()
        else:
            given = drive.slid(column, rest())
            between = given if weld.b == weld.pair.a else given.inverse()
        joint = rest(*on).of(between)
        shape[weld.b] = shape[weld.a].of(joint).of(rest(*by).inverse())
    return shape


def dyad_joints(
    structure: Structure, dyad: Dyad, shapes: tuple[dict[str, Pose], dict[str, Pose]], poses: Mapping[str, Pose]
) -> Joints:
    """The six joint frames of a dyad."""

    def inside(pair: Pair, shape: Mapping[str, Pose]) -> tuple[Pose, str]:
        link = pair.a if pair.a in shape else pair.b
        return shape[link].fixed(*joint_place(structure, pair, link)), link

    def known(pair: Pair, link: str) -> Pose:
        base = pair.b if link == pair.a else pair.a
        return poses[base].fixed(*joint_place(structure, pair, base))

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
        structure.scene.size,
    )


def members(shape: Mapping[str, Pose], base: Pose) -> dict[str, Pose]:
    """The links of a body in the world, from the base's pose."""
    return {link: base.of(pose) for link, pose in shape.items()}
