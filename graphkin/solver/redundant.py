"""Redundant links, which only repeat the constraints of others: placed from their joints, and checked to fit in every
rate."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations
from typing import NamedTuple

import numpy as np

from graphkin.errors import Problem, Unsolvable
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.scene.pairs import Pair
from graphkin.solver.algebra.pose import Array, ErrorBound, Pose, aimed, rest
from graphkin.structure import Structure
from graphkin.words import Phrase, links_named

FITS = 1e-9
MOVED = 4.0
"""As many bounds of points come together where a link is laid between two others."""
EXACTLY = ErrorBound(*(np.zeros(1),) * 6)


class Fit(NamedTuple):
    """The fit of a link between the others: its pose, and its misfits, relative to the size and the largest speed and
    acceleration there (``scale``), each of shape (n,)."""

    pose: Pose
    position: Array
    velocity: Array
    acceleration: Array
    scale: tuple[Array, Array, Array]

    def fits_within(self, bound: ErrorBound[Array] = EXACTLY) -> Array:
        """Whether its misfits are within the rounding errors of the ends of both links."""
        residuals = (self.position, self.velocity, self.acceleration)
        allowed = (FITS + MOVED * _part(b, whole) for b, whole in zip(bound.of_point, self.scale, strict=True))
        return np.asarray(np.logical_and.reduce([m < a for m, a in zip(residuals, allowed, strict=True)]))


def redundant_poses(
    structure: Structure, others: Mapping[str, Pose], ok: Array, bound: ErrorBound[Array]
) -> dict[str, Pose]:
    """The poses of the redundant links, from their joints.

    Parameters
    ----------
    others : poses of all other links, each field of shape (n,)
    ok : solved positions, shape (n,)
    bound : bounds of the links' rounding errors

    Raises
    ------
    Unsolvable : "mobility": a link does not fit between the others, or no joint holds it
    """
    poses, placed = dict(others), dict[str, Pose]()
    scene = structure.scene
    waiting = [link for link in scene.links if link.redundant]
    while waiting:
        for link in waiting:
            fitted = fit(scene, link, poses)
            if fitted is not None:
                break
        else:
            raise Unsolvable("mobility", Problem(links_named([link.name for link in waiting]),
                                                 "redundant but nothing holds both ends of them"))
        waiting.remove(link)
        bad = ok & ~fitted.fits_within(bound)
        if bad.any():
            k = int(np.argmax(bad))
            residual = float(fitted.position[k]) * scene.size / scene.units.metres
            how = (
                Phrase("it misses its joints by", missed=f'{residual:.4g}', length=scene.units.length)
                if fitted.position[k] >= FITS
                else Phrase("it fits here but would stop the motion")
            )
            raise Unsolvable("mobility", Problem(f"links.{link.name}.redundant", how,
                                                 "a redundant link must repeat what the others"))
        poses[link.name] = placed[link.name] = fitted.pose
    return placed


@np.errstate(all="ignore")
def fit(scene: Mechanism, link: PlacedLink, poses: Mapping[str, Pose]) -> Fit | None:
    """Place a link from its joints; None if they do not place it."""
    shared = {p: n for p in link.points for n in scene.holders[p] if n in poses and n != link.name}
    slides = [s for s in scene.slidings if s.a == link.name and s.b in poses]
    pose = _between_hinges(scene, link, shared, poses) if len(shared) > 1 else None
    if pose is None:
        pose = _on_guide(scene, link, shared, slides, poses)
    if pose is None:
        return None
    gaps = [(pose.fixed(link.points[p]), poses[n].fixed(scene.by_name[n].points[p])) for p, n in shared.items()]
    everything = list(poses.values())
    size = scene.size
    speed = _most([np.abs(p.v) + np.abs(p.omega) * size for p in everything])
    push = _most([np.abs(p.a) + (np.abs(p.alpha) + p.omega**2) * size for p in everything])
    arm = max((abs(link.points[p] - link.points[q]) for p, q in combinations(shared, 2)), default=size)
    residuals = [[np.abs(a.z - b.z) / size, np.abs(a.v - b.v), np.abs(a.a - b.a)] for a, b in gaps]
    for s in slides:
        seen = poses[s.b].fixed(s.guide.through, s.guide.direction).inverse().of(pose)
        turn = seen.u * np.conj(s.turn)
        residuals.append([np.abs(seen.z.imag) / size, np.abs(seen.v.imag), np.abs(seen.a.imag)])
        residuals.append([np.abs(turn - 1) * arm / size, np.abs(seen.omega) * size, np.abs(seen.alpha) * size])
    place, velocity, acceleration = (_most([m[k] for m in residuals]) for k in range(3))
    scale = np.full_like(speed, size), speed, push
    return Fit(pose, place, _part(velocity, speed), _part(acceleration, push), scale)


def _between_hinges(
    scene: Mechanism, link: PlacedLink, shared: Mapping[str, str], poses: Mapping[str, Pose]
) -> Pose | None:
    p, q = max(combinations(shared, 2), key=lambda ends: abs(link.points[ends[0]] - link.points[ends[1]]))
    arm = link.points[q] - link.points[p]
    if arm == 0:
        return None
    first, second = (poses[shared[name]].fixed(scene.by_name[shared[name]].points[name]) for name in (p, q))
    line = aimed(first, second)
    return first.pinned(rest(link.points[p]), line.u * (abs(arm) / arm), line.omega, line.alpha)


def _on_guide(
    scene: Mechanism, link: PlacedLink, shared: Mapping[str, str], slides: list[Pair], poses: Mapping[str, Pose]
) -> Pose | None:
    if not slides or not shared:
        return None
    pair = slides[0]
    point, holder = next(iter(shared.items()))
    guide = poses[pair.b].fixed(pair.guide.through, pair.guide.direction)
    at = poses[holder].fixed(scene.by_name[holder].points[point])
    return at.pinned(rest(link.points[point]), guide.u * pair.turn, guide.omega, guide.alpha)


def _most(values: list[Array]) -> Array:
    return np.asarray(np.maximum.reduce(np.broadcast_arrays(*values)))


def _part(value: Array, whole: Array) -> Array:
    return np.where(whole > 0, value / np.where(whole > 0, whole, 1.0), value)
