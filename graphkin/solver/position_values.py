"""Position values by their symbols: coordinates, angles, distances, travels, transmission and pressure angles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.scene.symbol import Symbol, centre_links
from graphkin.solver.cam_profile import cam_at
from graphkin.solver.pose import Array, Pose
from graphkin.structure import Dyad, Structure
from graphkin.structure.transmission import (
    TransmissionAngle,
    joint_between,
    joint_of_dyad,
    joint_of_follower,
    sliding_pair,
)
from graphkin.words import Phrase

__all__ = ["Crossing", "pole", "position", "transmission"]

Poses = Mapping[str, Pose]


def position(structure: Structure, poses: Poses, symbol: Symbol) -> Array:
    """A position at all n positions of the drivers, shape (n,) (m, rad).

    Raises
    ------
    CallError : a symbol that means nothing in this mechanism, or belongs to the whole turn
    """
    if symbol.kind in ("x", "y", "d"):
        assert symbol.of is not None
        here = _place(structure, poses, symbol, symbol.of.point)
        if symbol.to is None:
            return np.asarray(here.real if symbol.kind == "x" else here.imag)
        return np.asarray(np.abs(here - _place(structure, poses, symbol, symbol.to.point)))
    if symbol.kind == "s":
        pair = sliding_pair(structure, symbol)
        guide = poses[pair.b].fixed(pair.guide.through, pair.guide.direction)
        return np.asarray(((poses[pair.a].z - guide.z) * np.conj(guide.u)).real)
    if symbol.kind == "theta":
        turned = _pose(poses, symbol, symbol.link).u
        turned = turned * np.conj(_pose(poses, symbol, symbol.other).u) if symbol.other else turned
        angle = np.angle(turned)
        return np.where(angle == -np.pi, np.pi, angle)
    if symbol.kind == "gamma":
        return _crossing(poses, joint_between(structure, symbol.link, symbol.other, symbol)).angle
    if symbol.kind == "pressure":
        cam = next((c for c in structure.scene.cams if c.follower == symbol.link), None)
        if cam is not None:
            return cam_at(cam, cam.sense * np.angle(_pose(poses, symbol, cam.link).u)).pressure
        return np.asarray(np.pi / 2 - _crossing(poses, joint_of_follower(structure, symbol.link, symbol)).angle)
    raise CallError(
        Problem(str(symbol), Phrase("belongs to the whole turn not to one"), Phrase("ask check audit or sweep"))
    )


def _pose(poses: Poses, symbol: Symbol, link: str) -> Pose:
    if link not in poses:
        raise CallError(Problem(str(symbol), Phrase("there is no link", name=link), did_you_mean(link, poses)))
    return poses[link]


def _place(structure: Structure, poses: Poses, symbol: Symbol, name: str) -> Array:
    """Where a point or an instant centre lies; NaN for a centre at infinity or of links that move as one."""
    scene = structure.scene
    if name in scene.holders:
        link = scene.holders[name][0]
        return np.asarray(poses[link].fixed(scene.by_name[link].points[name]).z)
    touching = next((c for c in scene.contacts if c.name == name), None)
    if touching is not None:
        held = touching.carrier or touching.block
        return np.asarray(poses[held].fixed(structure.links[held].points[name]).z)
    pair = centre_links(name, scene.by_name)
    if pair is None:
        raise CallError(Problem(str(symbol), Phrase("there is no point", name=name), did_you_mean(name, scene.holders)))
    shared = next((p for p in scene.by_name[pair[0]].points if p in scene.by_name[pair[1]].points), None)
    if shared is not None:  # a joint, whether the two turn or not
        return _place(structure, poses, symbol, shared)
    q, omega = pole(poses[pair[0]], poses[pair[1]])
    with np.errstate(all="ignore"):
        return np.asarray(np.where(omega == 0.0, np.nan, q / omega))


def pole(one: Pose, two: Pose) -> tuple[Array, Array]:
    """The relative rotation of one link against another, as homogeneous coordinates of their instant centre (see
    `graphkin.solver.centres.instant_centre`)."""
    v0 = (one.v - 1j * one.omega * one.z) - (two.v - 1j * two.omega * two.z)
    return np.asarray(1j * v0), np.asarray(one.omega - two.omega)


@dataclass(frozen=True)
class Crossing:
    """Sine and cosine of the angle between the two directions that decide how well a group passes on a force."""

    cosine: Array
    sine: Array

    @property
    def angle(self) -> Array:
        """Transmission angle (rad), in 0 .. pi/2."""
        return np.arctan2(np.abs(self.sine), np.abs(self.cosine))


def transmission(structure: Structure, dyad: Dyad, poses: Poses) -> Crossing:
    """The transmission angle of a group of two links (`graphkin.structure.transmission`); the pressure angle is what it
    lacks to 90 degrees."""
    return _crossing(poses, joint_of_dyad(structure, dyad))


def _crossing(poses: Poses, joint: TransmissionAngle) -> Crossing:
    first, second = (poses[end[0]].fixed(end[1]).z - poses[start[0]].fixed(start[1]).z
                     for start, end in (joint.first, joint.second))  # fmt: skip
    with np.errstate(all="ignore"):
        across = np.conj(first) * second * (1j if joint.square else 1.0) / (np.abs(first) * np.abs(second))
    return Crossing(np.asarray(across.real), np.asarray(across.imag))
