"""Rolling without slip: relations between the angles of links and the travels of slides, the motions that follow from
the drivers by them alone, and the start of links that move each other by rolling.

A gear gives z1 (w1 - wc) + z2 (w2 - wc) = 0 (Willis 1841), with internal teeth negative, two rolling discs the same
with their radii, a rack or a rolling disc on a face s' + r (w1 - w2) = 0 along the pitch line.  Angles that these
determine from the drivers' count as driven: their drivers are found here, in exact fractions.

Rolling keeps a sum of angles and travels, but leaves its value open: at one position as many of them are given as there
are relations, by ``start``, by drawn or sketched points, else an angle of 0.  With drivers of these values instead of
its rolling the mechanism stands at that position.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import chain, islice, product

from graphkin.plane import Pose, added_up, dot
from graphkin.scene.model import Driver, Mechanism, PlacedLink
from graphkin.scene.pairs import HigherPair, Pair, PlacedGear
from graphkin.structure.model import Coordinate, LargerGroup, RollingRelation, Structure, carried


def meshes_of(
    scene: Mechanism, pairs: Iterable[HigherPair], links: Mapping[str, PlacedLink]
) -> tuple[PlacedGear, ...]:
    """All pairs of bodies that roll on each other; a rack or a flat face with the signed distance (m) of its line from
    the wheel's axis as the first of the ``teeth``, positive to the left of the guide of ``slide``."""
    points, guides = ({name: getattr(link, of) for name, link in links.items()} for of in ("points", "guides"))
    meshes = (pair.mesh(scene.slidings, points, guides) for pair in pairs)
    return tuple(mesh for mesh in meshes if mesh is not None)


def relations_of(scene: Mechanism, meshes: Iterable[PlacedGear]) -> tuple[RollingRelation, ...]:
    """The relations of all rolling pairs."""
    relations = []
    for mesh in meshes:
        part, other_part = Fraction(mesh.teeth[0]), Fraction(mesh.teeth[1] or 0)
        # the block on a face turns as the face does; the bar between two centres has an angle of its own
        carrier = ("angle", mesh.bodies[1] if mesh.slide == mesh.carrier else mesh.carrier)
        wheel, other = ("angle", mesh.bodies[0]), ("angle", mesh.bodies[1])
        rolled: tuple[tuple[Coordinate, Fraction], ...] = ((wheel, part), (other, other_part))
        if mesh.is_rack:
            rolled = (("travel", mesh.slide), Fraction(mesh.sense)), (wheel, part)
        terms = _summed((*rolled, (carrier, -part - other_part)), scene.frame.name)
        relations.append(RollingRelation(mesh.name, terms, mesh.members))
    return tuple(relations)


def _summed(terms: Iterable[tuple[Coordinate, Fraction]], frame: str) -> dict[Coordinate, Fraction]:
    """A sum with one term for each coordinate, without the angle of the frame."""
    total: dict[Coordinate, Fraction] = {}
    for coordinate, factor in terms:
        total[coordinate] = total.get(coordinate, Fraction(0)) + factor
    return {coordinate: f for coordinate, f in total.items() if f and coordinate != ("angle", frame)}


Unknown = Coordinate | int
"""The rate of a coordinate, or that of a driver by its number."""
Row = dict[Unknown, Fraction]
Rows = dict[Unknown, Row]
"""Linear equations in reduced echelon form, by the coordinates that lead them: coordinates by the rates of drivers."""


def _add(rows: Rows, terms: Mapping[Coordinate, Fraction] | Mapping[Unknown, Fraction]) -> bool:
    """Add an equation, a sum that is 0; False where it follows from the others.  Numbers are the indices of drivers."""
    rest = dict[Unknown, Fraction](terms.items())
    for key in rows.keys() & rest.keys():
        rest = _less(rest, rest[key], rows[key])
    lead = next((k for k in rest if not isinstance(k, int)), None)
    if lead is None:
        return False
    row = {k: f / rest[lead] for k, f in rest.items()}
    for other, before in rows.items():
        rows[other] = _less(before, before.get(lead, Fraction(0)), row)
    rows[lead] = row
    return True


def _less(row: Row, factor: Fraction, other: Row) -> Row:
    """A row less a multiple of another."""
    mixed = {k: row.get(k, Fraction(0)) - factor * other.get(k, Fraction(0)) for k in {**row, **other}}
    return {k: f for k, f in mixed.items() if f}


def _ratios(rows: Rows, coordinate: Coordinate, drivers: int) -> tuple[Fraction, ...] | None:
    """A coordinate's rate by the rates of the drivers; None where they do not determine it."""
    row = rows.get(coordinate)
    if row is None or any(k != coordinate and not isinstance(k, int) for k in row):
        return None
    return tuple(-row.get(k, Fraction(0)) for k in range(drivers))


def followers_of(
    scene: Mechanism, relations: Sequence[RollingRelation], links: Mapping[str, PlacedLink], slides: Sequence[Pair]
) -> tuple[tuple[Driver, ...], tuple[RollingRelation, ...]]:
    """The drivers of links that follow the scene's drivers by rolling in constant ratios; and the other relations,
    between coordinates that also depend on lengths."""
    frame, count = scene.frame.name, len(scene.drivers)

    def turned(link: str, base: str) -> Row:
        return {("angle", name): Fraction(sign) for name, sign in ((link, 1), (base, -1)) if name != frame}

    base: Rows = {}
    for s in slides:
        _add(base, turned(s.a, s.b))
    for k, driver in enumerate(scene.drivers):
        along: Row = {("travel", driver.key): Fraction(1)}
        _add(base, {**(turned(*driver.links) if driver.turns else along), k: Fraction(-1)})
    whole = dict(base)
    # what the drivers and others before it settle holds the links a second time: it stays, and the count finds it
    twice = [relation for relation in relations if not _add(whole, relation.terms)]
    settled = [r for r in relations if r not in twice and all(_ratios(whole, c, count) is not None for c in r.terms)]
    through = tuple(dict.fromkeys(chain.from_iterable(r.links for r in settled)))
    followers: list[Driver] = []
    coordinates = [*(("angle", name) for name in links if name != frame), *(("travel", s.key) for s in slides)]
    rolling = {coordinate for relation in relations for coordinate in relation.terms}
    # what rolls has a start, what only turns with it has none
    for coordinate in sorted(coordinates, key=lambda coordinate: coordinate not in rolling):
        ratios = _ratios(whole, coordinate, count)
        if ratios is None or _ratios(base, coordinate, count) is not None:
            continue
        rate, second = (added_up(float(r) * d.values[k] for r, d in zip(ratios, scene.drivers, strict=True))
                        for k in (1, 2))
        kind, name = coordinate
        start = _start(scene, name)
        follower = Driver(name, frame, start or 0.0, rate, second, ratios=tuple(map(float, ratios)), through=through)
        if kind == "travel":
            slide = next(s for s in slides if s.key == name)
            rail = _sketched(scene, links[slide.b], slides)
            if start is None and rail is not None and slide.pin in scene.sketch:
                start = dot(rail.local(scene.sketch[slide.pin]) - slide.guide.through, slide.guide.direction)
            follower = replace(follower, link=slide.a, relative_to=slide.b, slide=name, value=start or 0.0)
        elif start is None:
            follower = replace(follower, value=drawn_angle(scene, links[name]) or 0.0)
        followers.append(follower)
        follows: Row = {k: -f for k, f in enumerate(ratios)}
        _add(base, {coordinate: Fraction(1), **follows})
    left = tuple(r for r in relations if r in twice or (r not in settled and _add(base, r.terms)))
    return tuple(followers), left


def driven_twice(structure: Structure) -> list[Driver]:
    """The drivers whose rates slides, rolling and the drivers before them give already, so that one contradicts the
    others."""
    scene = structure.scene
    alike: dict[str, str] = {}  # of links that never turn relative to each other, one
    for link in (scene.frame.name, *structure.links):
        for name in structure.turning_with(link):
            alike.setdefault(name, link)

    def row(terms: Iterable[tuple[Coordinate, Fraction]]) -> Mapping[Coordinate, Fraction]:
        named = (((kind, alike[name] if kind == "angle" else name), f) for (kind, name), f in terms)
        return _summed(named, scene.frame.name)

    rows: Rows = {}
    for relation in relations_of(scene, meshes_of(scene, structure.touching, structure.links)):
        _add(rows, row(relation.terms.items()))
    given = ((("angle", d.link), ("angle", d.relative_to)) if d.turns else (("travel", d.key),) for d in scene.drivers)
    driven = (row(zip(terms, (Fraction(1), Fraction(-1)), strict=False)) for terms in given)
    return [driver for driver, terms in zip(scene.drivers, driven, strict=True) if not _add(rows, terms)]


def _start(scene: Mechanism, name: str) -> float | None:
    """The start of a link or slide: its own, or that of another link from which it is turned, or which it turns."""
    tied = [(d.relative_to, d.value) for d in scene.drivers if d.turns and d.link == name]
    tied += [(d.link, -d.value) for d in scene.drivers if d.turns and d.relative_to == name]
    starts = (scene.starts[link] + value for link, value in tied if link in scene.starts)
    return scene.starts.get(name, next(starts, None))


def drawn_angle(scene: Mechanism, link: PlacedLink) -> float | None:
    """The angle of a bar whose ends are given, in the frame or drawn or else sketched; None without them."""
    given = {**scene.sketch, **scene.drawn, **scene.frame.points}
    ends = [given[p] for p in link.bar if p in given]
    return cmath.phase(ends[1] - ends[0]) if len(ends) == 2 and ends[0] != ends[1] else None


def _sketched(scene: Mechanism, link: PlacedLink, slides: Sequence[Pair]) -> Pose | None:
    """The pose (m) of a link that is known before the mechanism is solved: of the frame, or by its direction and a
    point, in the frame, drawn or sketched; None where there are none."""
    still, given = _still(scene, slides), {**scene.sketch, **scene.drawn, **scene.frame.points}
    if link.name == scene.frame.name:
        return Pose(0j, 1 + 0j)
    angles = (d.values[0] for d in scene.drivers if d.turns and d.links == (link.name, scene.frame.name))
    angle = cmath.phase(still[link.name]) if link.name in still else next(angles, drawn_angle(scene, link))
    point = next((p for p in link.points if p in given), None)
    if angle is None or point is None:
        return None
    axis = cmath.rect(1.0, angle)
    return Pose(given[point] - axis * link.points[point], axis)


def rolled_by(scene: Mechanism, relation: RollingRelation, member: str, pair: Pair) -> RollingRelation | None:
    """The relation solved for a link that one pair joins to known links; None where it does not give its motion."""
    coordinate: Coordinate = ("angle", member) if pair.turns else ("travel", pair.key)
    if coordinate not in relation.terms or (coordinate[0] == "travel" and ("angle", member) in relation.terms):
        return None
    return replace(relation, coordinate=coordinate, start=scene.starts.get(coordinate[1], 0.0))


MOST = 200  # choices that are looked at


def unrolled(scene: Mechanism, names: Sequence[str]) -> Mechanism:
    """The scene with sliding contacts in place of some rolling ones, and without the mesh of some wheels."""
    pairs = (pair.unrolled if pair.rolling and pair.name in names else pair for pair in scene.higher_pairs)
    return replace(scene, higher_pairs=tuple(filter(None, pairs)))


def start_drivers(structure: Structure, groups: Sequence[LargerGroup]) -> Iterator[tuple[Driver, ...]]:
    """Drivers for the rolling relations of some groups, in the order of the groups, given ones first.  The caller finds
    which of them hold the mechanism."""
    each = [_of(structure, group, relation) for group in groups for relation in group.rolling]
    taken = {d.key for d in structure.drivers}
    ranked = sorted(
        islice(product(*each), MOST**2),
        key=lambda chosen: (max(rank for rank, _ in chosen), sum(rank for rank, _ in chosen)),
    )
    for chosen in ranked[:MOST]:
        keys = {driver.key for _, driver in chosen}
        if len(keys) == len(chosen) and not keys & taken:
            yield tuple(driver for _, driver in chosen)


def _of(structure: Structure, group: LargerGroup, relation: RollingRelation) -> list[tuple[int, Driver]]:
    """The drivers that may give a coordinate of a relation, ranked: by the start of the rolling link, of another link
    of the group, a sketched bar, no data."""
    scene, inside = structure.scene, set(group.members)
    ranked: list[tuple[int, Driver]] = []
    others = [("angle", n) for n in group.links if ("angle", n) not in relation.terms and n in scene.starts]
    for coordinate in (*reversed(list(relation.terms)), *others):
        kind, name = coordinate
        start = scene.starts.get(name)
        if kind == "travel":
            slide = structure.slide(name)
            if start is not None and inside.intersection(slide.links):
                ranked.append((1, Driver(slide.a, slide.b, start, 0.0, 0.0, name)))
        elif name in inside and name in scene.by_name:
            drawn = None if start is not None else drawn_angle(scene, structure.links[name])
            rank = (0 if coordinate in relation.terms else 1) if start is not None else 2 if drawn is not None else 3
            ranked.append((rank, _turned(structure, name, start if start is not None else drawn or 0.0)))
    return ranked


def _turned(structure: Structure, name: str, angle: float) -> Driver:
    """A driver that puts a link's own axis at an angle (rad): from a link pinned to it that never turns, if there is
    one."""
    frame, still = structure.scene.frame.name, _still(structure.scene, structure.slides)
    pinned = [n for names in structure.hinges.values() if name in names for n in names if n in still]
    base = frame if frame in pinned or not pinned else pinned[0]
    return Driver(name, base, cmath.phase(cmath.rect(1.0, angle) / still[base]), 0.0, 0.0)


def _still(scene: Mechanism, slides: Iterable[Pair]) -> dict[str, complex]:
    """The own axes of the links that never turn: of the frame, and of what slides on it or on such a link."""
    turns = [(s.b, s.a, s.guide.direction * s.turn) for s in slides]
    return carried({scene.frame.name: 1 + 0j}, turns, lambda axis, turn, on: axis * turn if on else axis / turn)
