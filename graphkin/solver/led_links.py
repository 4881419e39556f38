"""Links that a cam or rolling leads, beside larger groups: as good as driven at the places that were found for them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from graphkin.scene.cams import LawCam, SlidingFollower
from graphkin.scene.model import AngleFollower, SlideFollower
from graphkin.solver.expressions import Name
from graphkin.solver.followers import follower_inputs, greatest_jerk
from graphkin.solver.joints import Drive, joint_place
from graphkin.solver.pose import Array, Pose
from graphkin.solver.rounding import ErrorBound
from graphkin.structure import Driven, Rolled, Structure, Turn

__all__ = ["LedLink", "with_led_links"]

Errors = ErrorBound[Array]


@dataclass(frozen=True)
class LedLink:
    """A link that a cam or rolling leads, and the driver that would move it so."""

    element: Driven
    driver: AngleFollower | SlideFollower

    def off(
        self, order: int, structure: Structure, poses: Mapping[str, Pose], errors: Mapping[str, Errors],
        given: Callable[[Name], float],
    ) -> Array:  # fmt: skip
        """How far its value (0), or its first or second rate, may be off (rad, m): by the looking up, and by what leads
        it, with the errors of that."""
        lead = self.element.driver
        if isinstance(lead, LawCam):
            return self._by_cam(order, lead, poses, errors, given)
        assert isinstance(lead, Rolled)
        part = "cos" if lead.turns else "travel"
        found = np.asarray(given(("error", "rolled", lead.key, part)))
        for (kind, name), factor in lead.factors:
            if kind == "angle":
                found = found + abs(factor) * _turning(errors, name, order)
                continue
            slide = structure.slide(name)
            for link in (slide.a, slide.b):
                error, arm = errors.get(link), np.abs(poses[slide.a].z - poses[slide.b].z)
                if error is not None:
                    found = found + abs(factor) * (error.of_point[order] + arm * error.of_turning[order])
        return np.asarray(found)

    def _by_cam(
        self, order: int, cam: LawCam, poses: Mapping[str, Pose], errors: Mapping[str, Errors],
        given: Callable[[Name], float],
    ) -> Array:  # fmt: skip
        own = poses[cam.link]
        inputs = follower_inputs(cam, np.asarray(own.u))
        slope, bend = np.abs(inputs["slope"]), np.abs(inputs["bend"])
        jerk = greatest_jerk(cam.law)
        value = given(("error", "lift", cam.link, "travel" if isinstance(cam.motion, SlidingFollower) else "cos"))
        off = [_turning(errors, cam.link, k) for k in range(3)]
        if order == 0:
            return np.asarray(value + slope * off[0])
        spin, push = np.abs(own.omega), np.abs(own.alpha)
        of_slope = given(("error", "lift", cam.link, "slope")) + bend * off[0]
        if order == 1:
            return np.asarray(of_slope * spin + slope * off[1])
        of_bend = given(("error", "lift", cam.link, "bend")) + jerk * off[0]
        return np.asarray(of_bend * spin**2 + of_slope * push + 2 * bend * spin * off[1] + slope * off[2])


def _turning(errors: Mapping[str, Errors], link: str, order: int) -> Array:
    return errors[link].of_turning[order] if link in errors else np.zeros(1)


def with_led_links(
    structure: Structure, poses: Mapping[str, Pose], drive: Drive
) -> tuple[Structure, Drive, tuple[LedLink, ...]]:
    """The structure with drivers for the links that cams and rolling lead, and their values in these positions."""
    led: list[LedLink] = []
    columns: list[tuple[Array, Array, Array]] = []
    frame = structure.scene.frame.name
    for element in structure.elements:
        if not (isinstance(element, Driven) and isinstance(element.driver, LawCam | Rolled)):
            continue
        pair = element.pair
        if isinstance(pair, Turn):
            pose = poses[element.link]
            led.append(LedLink(element, AngleFollower(element.link, frame, 0.0, 0.0, 0.0)))
            columns.append((np.angle(pose.u), pose.omega, pose.alpha))
            continue
        one, two = (poses[name].fixed(*joint_place(structure, pair, name)) for name in (pair.a, pair.b))
        seen = two.inverse().of(one)
        led.append(LedLink(element, SlideFollower(pair.key, 0.0, 0.0, 0.0)))
        columns.append((seen.z.real, seen.v.real, seen.a.real))
    if not led:
        return structure, drive, ()
    n = len(drive)
    more = [np.stack([np.broadcast_to(c[k], (n,)) for c in columns], axis=1) for k in range(3)]
    whole = Drive(*(np.concatenate((np.asarray(had), add), axis=1)
                    for had, add in zip((drive.value, drive.rate, drive.second), more, strict=True)))  # fmt: skip
    return replace(structure, followers=(*structure.followers, *(one.driver for one in led))), whole, tuple(led)
