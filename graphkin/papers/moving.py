"""The mechanism in motion, for the screen: places of everything over what the driver reaches, as plain numbers.

All is in mm on paper at the scales of the handout: points and bars, traces, the end points of both polygons, instant
centres.  The page joins them; it computes nothing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import combinations

import numpy as np

from graphkin.account.notation import Letters
from graphkin.construction.sheet import DiagramName, Sheet
from graphkin.files import Json
from graphkin.papers.lesson import plain_words
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import Motion, solve
from graphkin.solver.motion import instant_centre
from graphkin.solver.pose import Array

__all__ = ["FRAMES", "motion_data"]

FRAMES = 72
FAR = 3.0  # mechanisms: a centre that lies farther away is not shown
Array = Array


def motion_data(
    sheet: Sheet, letters: Letters, values: Mapping[str, float] | None, count: int = FRAMES
) -> dict[str, Json]:
    """Everything that moves, ready for the page; empty where the driver reaches no two places.

    Returns
    -------
    ``at`` : values of the first driver (degrees, or travel in scene units); ``tracks`` : coordinates of each place over
    them, [x0, y0, x1, y1, ...]; ``bars`` : places joined, with the number of their link; ``lines`` : ends of guides;
    ``points``, ``centres`` : places with their names; ``fixed`` : places that stand; ``velocity``, ``acceleration`` :
    vectors as pairs of places and names of ends
    """
    scene = sheet.scene.instead_of or sheet.scene  # what stands for a cam does so at one position only
    motion = solve(scene, at=values, sweep=count)
    rows = _in_order(motion)
    if len(rows) < 2:
        return {}
    tracks = _Tracks(rows)
    length = sheet.scales.length
    places = {
        (link.name, point): tracks.add(motion.position(point, link.name) / length)
        for link in scene.links
        for point in link.points
    }
    fixed = {p: tracks.add(np.full(len(motion.ok), z / length)) for p, z in scene.frame.points.items()}
    shared = {point: place for (_, point), place in places.items()} | fixed
    size = scene.size / length
    bars = [
        [number, *(fixed.get(p, places[link.name, p]) for p in link.points)]
        for number, link in enumerate(scene.links)
        if len(link.points) > 1
    ]
    driver = scene.drivers[0]
    unit = scene.units.metres if "/" in driver.key else math.pi / 180.0
    return {
        "at": [round(float(v) / unit, 3) for v in motion.values[rows, 0]],
        "driver": plain_words(f"${'s' if '/' in driver.key else 'φ'}_{{{driver.key}}}$"),
        "unit": f" {scene.units.length}" if "/" in driver.key else "°",
        "bars": bars,
        "lines": [_guide(motion, tracks, on, guide, size, length) for on, guide in _guides_used(scene)],
        "points": [[place, plain_words(f"${letters.point(p)}$")] for p, place in shared.items()],
        "fixed": sorted(fixed.values()),
        "blocks": [[places.get((s.link, s.pin or ""), -1)] for s in scene.slidings if (s.link, s.pin or "") in places],
        "centres": list(_centres(motion, tracks, letters, size, length)),
        "velocity": _vectors(motion, sheet, letters, "velocity", tracks),
        "acceleration": _vectors(motion, sheet, letters, "acceleration", tracks),
        "tracks": tracks.found,
    }


def _in_order(motion: Motion) -> list[int]:
    """The rows that stand, beginning behind the gap where there is one."""
    good = [bool(ok) for ok in motion.ok]
    if all(good):
        return list(range(len(good)))
    cut = next((i for i in range(len(good)) if good[i] and not good[i - 1]), 0)
    return [i for i in (*range(cut, len(good)), *range(cut)) if good[i]]


class _Tracks:
    """Places over the motion, each once, to 0.01 mm."""

    def __init__(self, rows: Sequence[int]) -> None:
        self.rows = list(rows)
        self.found: list[list[float | None]] = []

    def has(self, z: Array) -> bool:
        """Whether there is a place that moves so."""
        return self._flat(z) in self.found

    def add(self, z: Array) -> int:
        flat = self._flat(z)
        if flat in self.found:
            return self.found.index(flat)
        self.found.append(flat)
        return len(self.found) - 1

    def _flat(self, z: Array) -> list[float | None]:
        own = np.asarray(z)[self.rows]
        flat: list[float | None] = []
        for one in own.tolist():
            sound = math.isfinite(one.real) and math.isfinite(one.imag)
            flat += [round(one.real, 2) + 0.0, round(-one.imag, 2) + 0.0] if sound else [None, None]
        return flat


def _guides_used(scene: Mechanism) -> list[tuple[str, str]]:
    return list(dict.fromkeys([(s.on, s.guide) for s in scene.slidings] + [(p.on, p.guide) for p in scene.pins]))


def _guide(motion: Motion, tracks: _Tracks, on: str, guide: str, size: float, length: float) -> list[int]:
    """Both ends of a guide: of the frame's through the whole mechanism, of a link's along the link."""
    placed = motion.link(on).guides[guide]
    reach = size if on == motion.scene.frame.name else 0.6 * size
    if on == motion.scene.frame.name:
        ends = [np.full(len(motion.ok), placed.through / length + way * reach * placed.direction) for way in (-1, 1)]
    else:
        pose = motion.poses[on]
        back = 0.15 * reach
        ends = [(pose.z + pose.u * placed.through) / length + way * pose.u * placed.direction for way in (-back, reach)]
    return [tracks.add(end) for end in ends]


def _centres(motion: Motion, tracks: _Tracks, letters: Letters, size: float, length: float) -> list[list[int | str]]:
    """Instant centres, where they lie within reach."""
    names = [motion.scene.frame.name, *(link.name for link in motion.scene.links)]
    found: list[list[int | str]] = []
    middle = np.mean(list(motion.scene.frame.points.values()) or [0j]) / length
    for a, b in combinations(names, 2):
        q, omega = instant_centre(motion, b, a)
        with np.errstate(all="ignore"):
            z = np.where(np.abs(omega) > 0, q / omega, np.nan) / length
        z = np.where(np.abs(z - middle) < FAR * size, z, np.nan + 0j)
        if np.isfinite(z).any() and not tracks.has(z):  # permanent ones bear the names of their points
            pair = (b, a) if a == motion.scene.frame.name else (a, b)
            found.append([tracks.add(z), plain_words(f"${letters.centre(pair)}$")])
    return found


def _vectors(
    motion: Motion, sheet: Sheet, letters: Letters, diagram: DiagramName, tracks: _Tracks
) -> dict[str, Json]:
    """Absolute vectors from the pole, relative ones between their end points."""
    scale = sheet.scales.of(diagram)
    scene = motion.scene
    kind = "v" if diagram == "velocity" else "a"
    ends: dict[PointRef, int] = {}
    for ref in sheet.ends[diagram]:
        if ref.point in scene.frame.points and ref.link in ("", scene.frame.name):
            continue
        known = any(ref.point in link.points for link in scene.links)
        if ref.link not in ("", *motion.poses) or not known:
            continue  # a point that is only there to draw
        try:
            ends[ref] = tracks.add(motion.value(Symbol(kind, ref)) / scale)
        except (KeyError, ValueError):
            continue
    vectors: list[list[int]] = [[-1, place] for place in dict.fromkeys(ends.values())]
    for symbol in sheet.vectors(diagram):
        if symbol.kind == kind and symbol.to is not None and symbol.of in ends and symbol.to in ends:
            vectors.append([ends[symbol.to], ends[symbol.of]])
    if diagram == "acceleration":  # components hide between two ends that are joined
        pairs = [(s.to, s.of) for s in sheet.vectors(diagram) if s.to is not None]
        vectors += [[ends[a], ends[b]] for a, b in dict.fromkeys(pairs) if a in ends and b in ends]
    named: list[list[Json]] = [
        [place, plain_words(f"${letters.end(diagram, ref) or letters.vector(Symbol(kind, ref))}$")]
        for ref, place in ends.items()
    ]
    return {"vectors": [list(v) for v in dict.fromkeys(map(tuple, vectors))], "ends": named}


