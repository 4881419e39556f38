"""Where the links of a mechanism with larger groups lie, by trial drawings (method of trial positions).

The trial driver of a reduced mechanism is moved until what was left out fits; from one position of the real driver to
the next the trial starts where the last one ended.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping, Sequence

from graphkin.construction.dyads import drive, meet
from graphkin.construction.follow import Choices, fitted, moved_to
from graphkin.construction.links_on_paper import PlacedLinks, Poses
from graphkin.construction.reduced_mechanism import ReducedMechanism
from graphkin.construction.sheet import Pose
from graphkin.construction.sketched import as_sketched
from graphkin.construction.trial_fits import all_fits, fits_between
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import added_up, dot
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.structure import Cluster, Driven, Dyad, Element, Rolled, Slide, Structure, links_of, pick
from graphkin.words import Phrase

__all__ = ["Known", "found_by_trial"]

TRIALS = 3  # trial drivers used, one after the other, to find all assemblies
# to either side of a sketch, looked at one after the other
WINDOWS = (*map(math.radians, (3.0, 10.0, 30.0, 90.0)), math.pi)
TWINS = 1e-6  # of the size: as near as this places are the same
ROUGHLY = 0.1  # of the size: so far off a sketch may be

Known = tuple[Mapping[str, float], Poses]  # driver values, and every link there with the mechanism of size 1


def found_by_trial(
    choices: Choices, elements: Sequence[Element], values: Mapping[str, float], near: Known | None = None
) -> dict[str, Pose]:
    """Where every link of some elements lies at driver values, with the mechanism of size 1.

    Parameters
    ----------
    near : a position known already, from which the motion is followed; without one the scene's own is found first

    Raises
    ------
    Unsolvable
        "not drawn": no link can be left out so that dyads remain; "not assembled": nothing fits at these values
    SceneError : a group has several assemblies and no sketch says which is meant
    """
    if near is None:
        own: Mapping[str, float] = {d.key: d.values[0] for d in choices.structure.scene.drivers}
        poses: Poses = _own_position(choices.at_start, elements)
    else:
        own, poses = near
    if any(v != own[k] for k, v in values.items()):
        return moved_to(choices, elements, own, values, poses)
    return dict(poses)


# -- the scene's own position: all the places at which the groups close -----------------------------------------------


def _own_position(choices: Choices, elements: Sequence[Element]) -> dict[str, Pose]:
    structure = choices.structure
    scene = structure.scene
    own = {d.key: d.values[0] for d in scene.drivers}
    wanted = {n for element in elements for n in links_of(element)}
    elements = [element for element in structure.elements if wanted.intersection(links_of(element))]
    placed = structure.followed(own)
    frame = PlacedLinks(structure.links, 1.0 / scene.size, placed, {scene.frame.name: Pose(0j, 1 + 0j)})
    for element in elements:
        if isinstance(element, Driven):
            if isinstance(element.driver, Rolled):
                frame.values = {**frame.values, element.driver.key: element.driver.start}
            frame.poses[element.link], _ = drive(frame, element)
        elif isinstance(element, Dyad):
            _dyad_by_sketch(scene, structure, frame, element)
        else:
            _cluster_by_sketch(choices, frame, element)
    return dict(frame.poses)


def _dyad_by_sketch(scene: Mechanism, structure: Structure, frame: PlacedLinks, dyad: Dyad) -> None:
    meeting = meet(frame, dyad)
    if not meeting.poses:
        raise Unsolvable(
            "not assembled",
            Problem(Phrase("links", links=", ".join(dyad.links)), Phrase("their loci do not meet here")),
        )
    candidates = [_fresh(structure, frame, poses) for poses in meeting.poses]
    frame.poses.update(meeting.poses[pick(scene, dyad.links, candidates, 0).index])


def _fresh(structure: Structure, frame: PlacedLinks, poses: Poses) -> dict[str, complex]:
    """Places (m) of the points that were not known before."""
    known = {p for n in frame.poses for p in structure.links[n].points}
    there = PlacedLinks(frame.links, frame.mm, frame.values, {**frame.poses, **poses})
    return {p: there.point(n, p) / frame.mm for n in poses for p in structure.links[n].points if p not in known}


def _cluster_by_sketch(choices: Choices, frame: PlacedLinks, cluster: Cluster) -> None:
    found: list[dict[str, Pose]] = []
    # by several trial drivers: what one passes over at its dead point another sees
    by_driver: dict[tuple[str, ...], ReducedMechanism] = {}
    for reduced in choices.of[cluster]:
        by_driver.setdefault(tuple(d.key for d in reduced.trial), reduced)
    structure = choices.structure
    # where a sketch tells where to look, it is looked there
    ways = sorted(by_driver.values(), key=lambda reduced: _sketched(reduced, frame) is None)
    # the positions that are sketched, improved until everything fits
    near = (
        fit for rough in as_sketched(structure, cluster, frame) for reduced in choices.of[cluster]
        if (fit := fitted(reduced, frame, rough)) is not None
    )  # fmt: skip
    if len(ways[0].trial) > 1:
        # a grid of several trial values is coarse: the sketch comes first, by whichever trial drivers it leads to a fit
        found += _as_told(structure, frame, near)
    for reduced in () if found else ways[:TRIALS]:
        for fit in _nearest_fits(reduced, frame, found):  # a fit at a value of the grid is met from both sides
            if not any(_near(fit, other) for other in found):
                found.append(fit)
    if not any(_is_told(structure, frame, fit) for fit in found):
        # between two values of the grid a fit and a place where nothing can be drawn may lie side by side
        found += [fit for fit in _as_told(structure, frame, near) if not any(_near(fit, other) for other in found)]
    if not found:
        names = ", ".join(cluster.links)
        raise Unsolvable(
            "not assembled", Problem(Phrase("links", links=names), Phrase("no trial position closes this group here"))
        )
    found = _without_twins(structure, frame, cluster, found)
    candidates = [_fresh(structure, frame, poses) for poses in found]
    frame.poses.update(found[pick(structure.scene, cluster.links, candidates, None).index])


def _as_told(structure: Structure, frame: PlacedLinks, fits: Iterator[dict[str, Pose]]) -> list[dict[str, Pose]]:
    """The first fit that has its points about where they are sketched; where none has, all that there are."""
    found: list[dict[str, Pose]] = []
    for poses in fits:
        if _is_told(structure, frame, poses):
            return [poses]
        if not any(_near(poses, other) for other in found):
            found.append(poses)
    return found


def _is_told(structure: Structure, frame: PlacedLinks, poses: Poses) -> bool:
    """Whether all points lie about where they are sketched."""
    told = {**structure.scene.sketch, **structure.scene.drawn}
    off = (abs(z - told[p]) for p, z in _fresh(structure, frame, poses).items() if p in told)
    return max(off, default=0.0) <= ROUGHLY * structure.scene.size


def _without_twins(
    structure: Structure, frame: PlacedLinks, cluster: Cluster, found: Sequence[dict[str, Pose]]
) -> list[dict[str, Pose]]:
    """Of positions whose points all lie in the same places, which differ only in the sense of a bar without length, the
    one where what slides lies on the positive side."""
    slides = [p for p in cluster.pairs if isinstance(p, Slide) and p.a in cluster.members and p.b in cluster.members]

    def positive(poses: Poses) -> float:
        ways = ((poses[s.a].origin - poses[s.b].origin) / poses[s.b].axis - frame.mm * s.guide.through for s in slides)
        return added_up(dot(s.guide.direction, way) for s, way in zip(slides, ways, strict=True))

    kept: list[tuple[dict[str, Pose], dict[str, complex]]] = []
    for poses in sorted(found, key=positive, reverse=True):
        places = _fresh(structure, frame, poses)
        twins = (max((abs(z - other[p]) for p, z in places.items()), default=math.inf) for _, other in kept)
        if all(apart > TWINS * structure.scene.size for apart in twins):
            kept.append((poses, places))
    return [poses for poses in found if any(poses is one for one, _ in kept)]


def _nearest_fits(
    reduced: ReducedMechanism, known: PlacedLinks, before: Sequence[Poses]
) -> Iterator[dict[str, Pose]]:
    """The positions at which a group fits: all of them, or where a point of the trial link is sketched those that can
    be nearest to the sketch, for an assembly that is nearer has that point nearer too."""
    sketched = _sketched(reduced, known)
    if sketched is None:
        yield from all_fits(reduced, known)
        return
    middle, away, distance = sketched
    found = list(before)
    nearest = min((distance(poses) for poses in before), default=0.0)
    least = math.asin(nearest / away) if nearest < away else math.pi
    for half in WINDOWS:
        if half < least and half != WINDOWS[-1]:
            continue
        fresh = list(fits_between(reduced, known, middle - half, middle + half))
        nearest = min((distance(poses) for poses in (*found, *fresh)), default=math.inf)
        wide = math.asin(nearest / away) if nearest < away else math.pi
        if wide <= half or half == WINDOWS[-1]:
            yield from fresh
            return


def _sketched(
    reduced: ReducedMechanism, known: PlacedLinks
) -> tuple[float, float, Callable[[Poses], float]] | None:
    """The trial value of a turned link at which a point of it lies in the direction of its sketch, how far from the
    hinge it is sketched, and how far an assembly lies from the sketch; None where nothing tells."""
    scene, structure = reduced.structure.scene, reduced.structure
    places = {p: z * known.mm for p, z in {**scene.sketch, **scene.drawn}.items()}
    driver = reduced.trial[0]
    if len(reduced.trial) > 1 or not isinstance(driver, AngleDriver) or not places:
        return None
    held, link = known.poses.get(driver.relative_to), structure.links[driver.link]
    hinge = next((p for p in link.points if p in structure.links[driver.relative_to].points), "")
    far = max((p for p in link.points if p in places and p != hinge),
              key=lambda p: abs(link.points[p] - link.points[hinge]) if hinge else 0.0, default="")  # fmt: skip
    if held is None or not hinge or not far:
        return None
    way = places[far] - known.point(driver.relative_to, hinge)
    own = link.points[far] - link.points[hinge]
    if abs(way) == 0.0 or abs(own) == 0.0:
        return None
    axis = way / own
    fresh = {p for n in reduced.cluster.members for p in structure.links[n].points if p in places}
    fresh -= {p for n in known.poses for p in structure.links[n].points}

    def distance(poses: Poses) -> float:
        there = _fresh(structure, known, {n: poses[n] for n in reduced.cluster.members if n in poses})
        return math.sqrt(added_up(abs(there[p] * known.mm - places[p]) ** 2 for p in fresh if p in there))

    return cmath.phase(axis / held.axis), abs(way), distance


def _near(one: Poses, other: Poses) -> bool:
    return all(abs(p.origin - other[n].origin) + abs(p.axis - other[n].axis) < 1e-6 for n, p in one.items())
