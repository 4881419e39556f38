"""What is unknown in a mechanism that carries loads: the forces and couples of its pairs, and what balances it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphkin.scene.force_names import ForceJoint, joints
from graphkin.scene.loads import BalanceAt
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.solver.cam_profile import contact_of
from graphkin.solver.contacts import contact_motion, pitch_point
from graphkin.solver.motion import Motion
from graphkin.solver.pose import Array
from graphkin.structure import Slide, Structure

__all__ = ["PairForce", "balances", "pair_forces"]


@dataclass(frozen=True)
class PairForce:
    """A force of one direction, or a couple, of ``first`` on ``second``, of unknown size; its opposite acts on
    ``first``.

    along : unit direction of a force: a number where it is the same everywhere, or shape (n,); None for a couple
    at : where the force acts, shape (n,) (m)
    """

    key: str
    first: str
    second: str
    along: complex | Array | None
    at: Array


def pair_forces(motion: Motion) -> list[PairForce]:
    """The forces and couples in the pairs of a motion: of a turning pair the two components of its force, of a sliding
    pair a force square to the guide at the sliding link's first point and a couple, of a pin in a slot a force square
    to the slot, of a cam or a sliding contact one along the normal, of wheels one along the tangent of the pitch
    circles."""
    pairs = _Pairs(motion)
    return [one for joint in joints(motion.scene) for one in pairs.of_joint(joint)]


def balances(motion: Motion) -> list[PairForce]:
    """What drives: for each driver a moment or a force between the two links that it moves relatively, or what the
    scene says instead."""
    return _Pairs(motion).balances()


@dataclass(frozen=True)
class _Pairs:
    """The pairs of a motion."""

    motion: Motion

    @property
    def scene(self) -> Mechanism:
        return self.motion.scene

    @property
    def structure(self) -> Structure:
        return self.motion.structure

    def place(self, link: str, at: complex) -> Array:
        """A place of a link's own axes in the world."""
        pose = self.motion.poses[link]
        return np.asarray(pose.z + pose.u * at)

    def of_joint(self, joint: ForceJoint) -> list[PairForce]:
        name, first, second = f"F_{joint.name}", joint.first, joint.second
        if joint.kind == "turning":
            at = np.asarray(self.motion.point(joint.point).z)
            return [PairForce(name, first, second, way, at) for way in (1 + 0j, 1j)]
        if joint.kind == "slot":
            at = np.asarray(self.motion.point(joint.point, second).z)
            slide = self.structure.slide(f"{joint.point}/{first}")
            return [PairForce(name, first, second, self._square(slide), at)]
        if joint.kind == "cam":
            cam = next(c for c in self.scene.cams if c.link == first)
            turn = self.motion.poses[first]
            touching = contact_of(cam, np.asarray(turn.u), np.asarray(turn.omega))
            return [PairForce(name, first, second, touching.normal, touching.contact)]
        if joint.kind in ("contact", "rolling", "gear"):
            ways, at = self._touching(joint)
            return [PairForce(name, first, second, way, at) for way in ways]
        slide = self.structure.slide(f"{second}/{first}")
        at = self.place(slide.a, self._foot(slide))
        return [
            PairForce(name, first, second, self._square(slide), at),
            PairForce(f"M_{joint.name}", first, second, None, at),
        ]

    def _touching(self, joint: ForceJoint) -> tuple[tuple[complex | Array, ...], Array]:
        """Along what forces act where two links touch, and there: the normal of what slides, the tangent of pitch
        circles, whose centres another link holds apart, both components of what rolls otherwise."""
        contact = next((c for c in self.scene.contacts if c.name == joint.point), None)
        if contact is None:
            gear = next(g for g in self.scene.gears if g.name == joint.point)
            at, _ = pitch_point(self.motion, gear)
            way = at - self.motion.position(gear.axes[0], gear.carrier)
            return (np.asarray(1j * way / np.abs(way)),), at
        touching = contact_motion(self.motion, contact)
        if joint.kind == "rolling":
            return (1 + 0j, 1j), touching.place
        return (touching.normal * (1j if joint.kind == "gear" else 1.0),), touching.place

    def balances(self) -> list[PairForce]:
        if self.scene.loading.balance is not None:
            return [self._said_balance(self.scene.loading.balance)]
        frame, found = self.scene.frame.name, []
        for driver in self.scene.drivers:
            if isinstance(driver, AngleDriver):
                at = np.asarray(self.motion.poses[driver.link].z)
                found.append(PairForce(f"M_{driver.link}", driver.relative_to, driver.link, None, at))
                continue
            slide = self.structure.slide(driver.key)
            pin = next((p for p in self.scene.pins if p.key == driver.key), None)
            link = pin.of if pin else slide.a
            at = np.asarray(self.motion.point(pin.point, link).z) if pin else self.place(slide.a, self._foot(slide))
            found.append(PairForce(f"F_{link}", slide.b or frame, link, -1j * self._square(slide), at))
        return found

    def _said_balance(self, balance: BalanceAt) -> PairForce:
        frame, link = self.scene.frame.name, balance.link
        at = self.place(link, balance.at)
        if balance.kind == "moment":
            return PairForce(f"M_{link}", frame, link, None, at)
        along = 1j * np.asarray(self.motion.poses[link].u) if balance.square else balance.turn
        return PairForce(f"F_{link}", frame, link, along, at)

    def _foot(self, slide: Slide) -> complex:
        return self.structure.links[slide.a].points[slide.pin] if slide.pin else 0j

    def _square(self, slide: Slide) -> complex | Array:
        """Direction square to a guide, to its left."""
        if slide.b == self.scene.frame.name:
            return 1j * slide.guide.direction
        return np.asarray(1j * slide.guide.direction * self.motion.poses[slide.b].u)
