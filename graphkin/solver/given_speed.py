"""The rate of a driver that follows from the speed of a point: velocities are in proportion to it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import AngleDriver
from graphkin.scene.symbol import PointRef
from graphkin.solver.assemblies import choose_forms, own_values
from graphkin.solver.engine import SINGULAR, positions
from graphkin.solver.joints import Drive
from graphkin.structure import Structure, analyse

__all__ = ["at_given_speed"]

STANDS = 1e-9  # of the size a radian: a point that moves by less stands still


def at_given_speed(structure: Structure) -> Structure:
    """The structure of the same scene with the rate of its driver, at which a point has its given speed.

    With the driver at one radian a second the point has the velocity v; at the speed asked the driver turns speed / |v|
    times as fast.

    Raises
    ------
    Unsolvable : "dead point": the point stands still here however fast the driver turns, or a group is at a dead point
    SceneError : a group has several assemblies and no sketch tells which
    """
    scene = structure.scene
    driver = scene.drivers[0]
    assert isinstance(driver, AngleDriver)
    assert driver.given_speed is not None
    name, speed = driver.given_speed
    own = own_values(scene)[None]
    forms = {i: f[None] for i, f in choose_forms(structure).items()}
    state = positions(structure, Drive(own, np.ones((1, 1)), np.zeros((1, 1))), forms, sure=False)
    ref = PointRef(name)
    holder = next(link for link in scene.holders[ref.point] if link != scene.frame.name)
    pose = state.poses[holder]
    arm = pose.u * structure.links[holder].points[name]
    once = abs(complex(np.ravel(pose.v + 1j * pose.omega * arm)[0]))
    if not np.isfinite(once) or once <= STANDS * scene.size or once >= scene.size / SINGULAR:
        said = "has no finite speed here" if once > STANDS * scene.size else "stands still here, however fast it turns"
        raise Unsolvable("dead point", Problem(f'driver "{driver.key}": {name}', said, "give omega, or another place"))
    return analyse(replace(scene, drivers=(replace(driver, omega=speed / once, given_speed=None),)))
