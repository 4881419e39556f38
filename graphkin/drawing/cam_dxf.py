"""The profile of a cam true to size for a milling machine: a closed curve of arcs that keeps within a millionth of a
millimetre of the computed one."""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

import numpy as np

from graphkin.drawing.write.dxf import closed_curve_dxf
from graphkin.plane import cross, dot
from graphkin.scene.cams import LawCam, SmoothPart
from graphkin.solver.cams import cam_with

__all__ = ["arcs_of_profile", "outline_dxf", "profile_dxf"]

KEEPS = 2e-7
"""mm that an arc may lie off the profile."""
COUNT, ROUNDS = 90, 12

Vertex = tuple[complex, float]
"""A place (mm) and the bulge of the arc to the next one: the tangent of a quarter of its angle."""


def profile_dxf(cam: LawCam) -> bytes:
    """The profile in mm in the cam's own axes from its axis, with the axis marked.  Raises CallError without ezdxf."""
    return closed_curve_dxf(arcs_of_profile(cam), cam.base_of_profile * 1e3)


def outline_dxf(centre: complex, radius: float) -> bytes:
    """A round outline in mm about a centre (m) in the cam's own axes from its axis, with the axis marked.  Raises
    CallError without ezdxf."""
    ends = [((centre + radius * way) * 1e3, 1.0) for way in (-1.0, 1.0)]
    return closed_curve_dxf(ends, radius * 1e3)


def arcs_of_profile(cam: LawCam) -> list[Vertex]:
    """The profile as arcs that touch each other, two between each two of its points (biarcs), finer where it bends."""
    found: list[Vertex] = []
    for part in cam.law.parts:
        count = max(2, math.ceil(COUNT * (part.end - part.start) / math.tau))
        nodes = [part.start + (part.end - part.start) * k / count for k in range(count + 1)]
        for start, end in pairwise(nodes):
            found += _between(cam, part, start, end, ROUNDS)
    return found


def _point(cam: LawCam, part: SmoothPart, degree: float) -> tuple[complex, complex]:
    """A point of the profile (mm) and the direction in which the degree grows there."""
    at = cam_with(cam, np.array([degree]), part.at(np.array([degree]), np))
    # the normal turned by a quarter, towards growing degrees
    return complex(at.profile[0]) * 1e3, complex((at.normal * np.conj(at.turn))[0]) * -1j * cam.sense


def _between(cam: LawCam, part: SmoothPart, start: float, end: float, rounds: int) -> list[Vertex]:
    """Arcs from one angle of the law to another."""
    (p, t), (q, u) = _point(cam, part, start), _point(cam, part, end)
    middle = _point(cam, part, (start + end) / 2)[0]
    t, u = (w if dot(w, q - p) >= 0.0 else -w for w in (t, u))
    two = _biarc(p, t, q, u)
    if two is None:
        return [(p, 0.0)]
    joint, first, second = two
    off = max(_off(p, joint, first, z) if near else _off(joint, q, second, z) for z, near in _probes(
        cam, part, start, end, joint, middle, p, q))  # fmt: skip
    if off > KEEPS and rounds:
        half = (start + end) / 2
        return [*_between(cam, part, start, half, rounds - 1), *_between(cam, part, half, end, rounds - 1)]
    return [(p, first), (joint, second)]


def _probes(
    cam: LawCam, part: SmoothPart, start: float, end: float, joint: complex, middle: complex, p: complex, q: complex
) -> list[tuple[complex, bool]]:
    """Points of the profile in between, and whether they lie on the first arc."""
    found = []
    for share in (0.2, 0.5, 0.8):
        z = middle if share == 0.5 else _point(cam, part, start + share * (end - start))[0]
        found.append((z, dot(z - joint, q - p) < 0.0))
    return found


def _biarc(p: complex, t: complex, q: complex, u: complex) -> tuple[complex, float, float] | None:
    """Two arcs that leave p along t, touch each other, and come to q along u: their joint and both bulges; None where
    the two points are one (Bolton, Biarc curves, Computer-Aided Design 7, 1975)."""
    v = q - p
    if abs(v) < 1e-9:
        return None
    # equal lengths d of both tangents: v.v + 2 d v.(t + u) + 2 d2 (t.u - 1) = 0 with the sign of v turned
    a, b, c = 2.0 * (1.0 - dot(t, u)), 2.0 * dot(v, t + u), -dot(v, v)
    d = -c / b if abs(a) < 1e-14 else 2.0 * -c / (b + math.sqrt(b * b - 4.0 * a * c))
    joint = (p + d * t + q - d * u) / 2.0
    return joint, _bulge(p, t, joint), _bulge(joint, cmath.exp(1j * 2.0 * cmath.phase((joint - p) / t)) * t, q)


def _bulge(p: complex, t: complex, q: complex) -> float:
    """The bulge of the arc from p along t to q."""
    return math.tan(cmath.phase((q - p) / t) / 2.0)


def _off(p: complex, q: complex, bulge: float, z: complex) -> float:
    """How far a place lies off an arc."""
    chord = q - p
    if abs(bulge) < 1e-12:
        return abs(cross(chord, z - p)) / abs(chord)
    radius = abs(chord) * (1.0 + bulge * bulge) / (4.0 * abs(bulge))
    centre = (p + q) / 2.0 + 1j * chord * (1.0 - bulge * bulge) / (4.0 * bulge)
    return abs(abs(z - centre) - radius)
