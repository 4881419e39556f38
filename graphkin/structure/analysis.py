"""From a scene to its structure: mobility, and the elements in the order of solution; or why there is no such order.

Hinges, slides, drivers and rolling pairs are equations between coordinates of links and points.  A matching gives each
equation a coordinate of its own, if every part of the mechanism has as many equations as coordinates; strongly
connected components of the graph of dependences are solved together, the Assur groups: driven links, dyads of some
kind, or larger groups.  A scene has no such order with too many or too few drivers, or where some parts are
overconstrained and others free.

The matching and the components are our own 60 lines: a graph of some ten nodes does not call for one more dependency
(networkx), or for scipy.sparse.csgraph, which takes longer to import than a mechanism to solve.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from itertools import islice, pairwise, product
from typing import Literal, TypeVar

from graphkin.errors import CallError, NoDriver, Problem, Unsolvable, did_you_mean
from graphkin.scene.model import Driver, Mechanism, PlacedLink
from graphkin.scene.pairs import OWN_AXIS, Pair
from graphkin.structure.model import (
    Body,
    Driven,
    DrivenJoint,
    DrivenTriangle,
    Dyad,
    DyadKind,
    Element,
    LargerGroup,
    Mobility,
    RollingRelation,
    Structure,
    TurnedBy,
    carried,
    driver_pair,
    reached,
)
from graphkin.structure.replacement import replacing_link
from graphkin.structure.rolling import (
    driven_twice,
    followers_of,
    meshes_of,
    relations_of,
    rolled_by,
    start_drivers,
    unrolled,
)
from graphkin.words import Phrase, Wording, about, clauses, listed

Node = tuple[str, str]  # ("link" | "point", name)
Unknown = tuple[Node, str]  # a node and one of its coordinates x, y, t


def analyse(scene: Mechanism | Structure) -> Structure:
    """Find the mobility and the order of solution; a structure is handed back as it is.

    Raises
    ------
    Unsolvable
        status "mobility": the number of drivers is not the mobility, slides and rolling give what a driver gives, or a
        part of the mechanism is overconstrained while another is free. NoDriver of that status: a mechanism that can
        move has no driver at all.
    """
    if isinstance(scene, Structure):
        return scene
    structure = _placed(scene)
    mobility = structure.mobility.value
    if mobility != len(scene.drivers):
        loose = _loose_ends(structure) if mobility > len(scene.drivers) else ()
        refusal = Unsolvable if scene.drivers or mobility <= 0 else NoDriver
        raise refusal("mobility", _wrong_count(structure), *loose)
    turned = _turned_by(structure)
    unknowns = [sorted(row) for row in _equations(structure, turned)]
    given = match([[u for u in row if u[1] != AHEAD] for row in unknowns])
    if len(given) < len(unknowns):
        unknowns = [[(node, "t" if axis == AHEAD else axis) for node, axis in row] for row in unknowns]
        given = match(unknowns)
        raise Unsolvable("mobility", _wrong_part(structure, unknowns, given), *_loose_ends(structure))
    is_relative = structure.touching or any(d.relative_to != scene.frame.name for d in scene.drivers)
    if is_relative and (twice := driven_twice(structure)):
        said = (Phrase("slides wheels and other drivers give", driver=d.key, link=d.link, other=d.relative_to)
                for d in twice)
        where = Phrase("status mobility")
        raise Unsolvable("mobility", *(Problem(where, phrase, "drive another pair") for phrase in said))
    elements = _in_order(structure, _nodes(structure), unknowns, given, {scene.frame.name}, turned)
    return _with_starts(_in_parts(replace(structure, elements=elements)))


def mobility_of(scene: Mechanism) -> Mobility:
    """Links, pairs and F of a scene, whatever its drivers are."""
    return _placed(scene).mobility


# what holds the links


def _placed(scene: Mechanism) -> Structure:
    """The links and blocks of a scene with the pairs that hold them, in no order of solution yet."""
    links: dict[str, PlacedLink] = {scene.frame.name: scene.frame}
    links.update({link.name: link for link in scene.links if not link.redundant})
    slides: list[Pair] = []
    for s in scene.slides:
        if links.keys() >= {*s.bodies}:
            if s.of:
                links[s.a] = PlacedLink(s.a, {s.pin: 0j}, (s.pin,), OWN_AXIS)
            slides.append(s)
    slotted, touching = sum(s.higher for s in slides), [p for p in scene.acting if links.keys() >= {*p.members}]
    for pair in touching:
        if (instead := replacing_link(pair, links)) is not None:
            link, slide = instead
            links[link.name] = link
            slides += [slide] if slide else []
    hinges: dict[str, list[str]] = {}
    for link in links.values():
        for point in link.points:
            hinges.setdefault(point, []).append(link.name)
    relations = relations_of(scene, meshes_of(scene, touching, links)) if touching else ()
    followers, relations = followers_of(scene, relations, links, slides) if relations else ((), ())
    # F counts no blocks, nor bars that stand for pins in slots; what rolls has two constraints, as a lower pair
    bars = scene.replacing.keys() & links.keys()
    real = {name for name in links if name in scene.by_name and name not in bars}
    rolling = sum(pair.means == "rolls" for pair in touching)
    turns = (len(real.intersection(names)) for names in hinges.values())
    lower = sum(n - 1 for n in turns if n) + sum(not s.higher for s in slides) + rolling
    higher = slotted + len(bars) + len(touching) - rolling
    mobility = Mobility(len(real - {scene.frame.name}), lower, higher)
    shared = {p: tuple(names) for p, names in hinges.items() if len(names) > 1}
    return Structure(scene, links, tuple(slides), shared, mobility, (), followers, relations, tuple(touching))


def _nodes(structure: Structure) -> list[Node]:
    moving = [name for name in structure.links if name != structure.scene.frame.name]
    return [("link", name) for name in moving] + [("point", name) for name in structure.hinges]


def _ranks(structure: Structure) -> Callable[[str], int]:
    """The order of links: as in the file, then blocks."""
    return {name: i for i, name in enumerate(structure.links)}.__getitem__


AHEAD = "d"
"""In place of the angle of a link from which another is turned: a direction that drivers give before it is placed."""


def _turned_by(structure: Structure) -> dict[str, TurnedBy]:
    """For each link whose direction drivers and sliding pairs alone give, these, from the frame on."""
    steps: list[Driver | Pair] = [*(driver for driver in structure.drivers if driver.turns), *structure.slides]
    frame: dict[str, TurnedBy] = {structure.scene.frame.name: ()}
    return carried(frame, [(*step.links, step) for step in steps], lambda by, step, back: (*by, (step, not back)))


def _later(turned: Mapping[str, TurnedBy], driver: Driver) -> str | None:
    """Of the two links of a driver that which it turns, where drivers give the direction of the other before."""
    return next((n for n in driver.links if n in turned and (driver, n == driver.link) in turned[n][-1:]), None)


def _equations(structure: Structure, turned: Mapping[str, TurnedBy] | None = None) -> list[set[Unknown]]:
    """For each scalar constraint the coordinates in it; of ``turned`` links drivers give the directions."""
    rows: list[set[Unknown]] = []
    frame = structure.scene.frame.name

    def add(*sides: tuple[str, str]) -> set[Unknown]:
        row = {(("link", name), axis) for name, axes in sides if name != frame for axis in axes}
        rows.append(row)
        return row

    for point, names in structure.hinges.items():
        for name in names:
            for axis in "xy":
                add((name, axis + "t")).add((("point", point), axis))
    for s in structure.slides:
        add((s.a, "t"), (s.b, "t"))
        add((s.a, "xy"), (s.b, "xyt"))
    for pair in structure.lifting:
        add((pair.link, "t"), (pair.follower, "t" if pair.turns else "xy"))
    for relation in structure.relations:
        slides = [structure.slide(name) for kind, name in relation.terms if kind == "travel"]
        add(*((name, "t") for kind, name in relation.terms if kind == "angle"),
            *(side for s in slides for side in ((s.a, "xy"), (s.b, "xyt"))))
    for driver in structure.drivers:
        driven, base = ("t", "t") if driver.turns else ("xy", "xyt")
        link, other = driver.links
        if later := _later(turned or {}, driver):
            link, other, base = later, other if later == link else link, AHEAD
        add((link, driven), (other, base))
    return rows


# what is solved together

N = TypeVar("N", bound=Hashable)


def match(equations: Sequence[Sequence[N]]) -> dict[int, N]:
    """Assign to as many equations as possible one of their unknowns each (augmenting paths).

    Parameters
    ----------
    equations : for each equation its unknowns

    Returns
    -------
    dict from the index of an equation to the unknown it gives; equations left out cannot be served
    """
    given: dict[N, int] = {}
    held: dict[int, N] = {}
    for start in range(len(equations)):
        # breadth-first search for a free unknown, so that depth is no limit
        came_from: dict[N, int] = {}
        queue = [start]
        step: N | None = None
        for equation in queue:  # which grows meanwhile
            fresh = [unknown for unknown in equations[equation] if unknown not in came_from]
            came_from.update(dict.fromkeys(fresh, equation))
            step = next((unknown for unknown in fresh if unknown not in given), None)
            if step is not None:
                break
            queue += [given[unknown] for unknown in fresh]
        while step is not None:
            equation = came_from[step]
            given[step] = equation
            held[equation], step = step, held.get(equation)
    return {equation: unknown for unknown, equation in given.items()}


def components(needs: Mapping[N, Sequence[N]]) -> list[tuple[N, ...]]:
    """Strongly connected components, each after those it ``needs``, by node (Kosaraju; Sharir 1981, without
    recursion)."""
    finished: dict[N, None] = {}
    seen: set[N] = set()
    for root in needs:
        path = [(root, iter(needs[root]))] if root not in seen else []
        seen.add(root)
        while path:
            node, left = path[-1]
            following = next((other for other in left if other not in seen), None)
            if following is None:
                finished[path.pop()[0]] = None
            else:
                seen.add(following)
                path.append((following, iter(needs[following])))
    users: dict[N, list[N]] = {node: [] for node in needs}
    for node, needed in needs.items():
        for other in needed:
            users[other].append(node)
    parts: list[tuple[N, ...]] = []
    while finished:
        root, _ = finished.popitem()
        together = reached([root], lambda node: [user for user in users[node] if user in finished])
        parts.append(tuple(together))
        for node in together:
            finished.pop(node, None)
    return parts[::-1]


def _in_order(
    structure: Structure,
    nodes: Sequence[Node],
    unknowns: Sequence[Sequence[Unknown]],
    given: Mapping[int, Unknown],
    known: set[str],
    turned: Mapping[str, TurnedBy],
) -> tuple[Element, ...]:
    """The elements that place some nodes, each after those it needs."""
    rank = _ranks(structure)

    def parts(nodes: Sequence[Node], ahead: bool = False) -> Iterator[tuple[tuple[Node, ...], list[str]]]:
        """What is solved together, with its links; ``ahead`` of the links whose directions drivers give."""
        needs: dict[Node, dict[Node, None]] = {node: {} for node in nodes}
        for i, (node, _) in given.items():
            others = {n for n, axis in unknowns[i] if n in needs and not (ahead and axis == AHEAD)} - {node}
            if node in needs:
                needs[node].update(
                    dict.fromkeys(sorted(others, key=lambda n: (n[0], rank(n[1]) if n[0] == "link" else n[1]))))
        for component in components({node: list(others) for node, others in needs.items()}):
            members = sorted((name for kind, name in component if kind == "link"), key=rank)
            if members:
                yield component, members

    elements: list[Element] = []
    for component, members in parts(nodes):
        group = _element_of(structure, members, known, turned)
        chosen: list[Element] = [group]
        if isinstance(group, LargerGroup) and any(_later(turned, driver) for driver in group.drivers):
            placed, smaller = {*known}, list[Element]()
            for _, links in parts(component, ahead=True):
                part = _element_of(structure, links, placed, turned)
                smaller.append(part)
                placed.update(links)
                if not isinstance(part, Driven) and any(not placed.issuperset(d.links) for d in part.drivers):
                    break  # only a driven link can be turned from one that is placed later
            else:
                chosen = smaller
        elements += chosen
        known.update(members)
    return tuple(elements)


_KINDS: Mapping[str, tuple[DyadKind, Literal["as found", "the other", "as written", "what slides"]]] = {
    "RRR": ("RRR", "as written"), "PRP": ("PRP", "as written"), "RPR": ("RPR", "what slides"),
    "RRP": ("RRP", "as found"), "PRR": ("RRP", "the other"), "RPP": ("RPP", "as found"), "PPR": ("RPP", "the other"),
}
"""Of three pairs in their order the kind of dyad, and which of its bodies is called the first."""
_SIDES = (True, True), (True, False), (False, True)  # of the inner and the outer pairs of two bodies


def _element_of(
    structure: Structure, members: list[str], known: set[str], turned: Mapping[str, TurnedBy]
) -> Element:
    """The element of links that are solved together, the ``known`` ones before it."""
    scene, inside = structure.scene, set(members)
    later = {d: _later(turned, d) for d in structure.drivers}
    drivers = [d for d in structure.drivers
               if inside & {*d.links} and (later[d] in inside or (not later[d] and {*d.links} <= inside | known))]
    pairs = _pairs(structure, members, known)
    for cam in structure.lifting:
        if members == [cam.follower] and cam.link in known and len(pairs) == 1 and not drivers:
            return Driven(cam.follower, pairs[0], cam)
        if cam.follower in inside or (cam.link in inside and cam.follower in known):
            raise Unsolvable("mobility", Problem(f"cams.{cam.link}", "link is not moved by the cam alone",
                                                 "drive cam what else moves hangs on the", follower=cam.follower,
                                                 link=cam.link))
    rolling = tuple(r for r in structure.relations if _touches(structure, r, inside, known))
    real = tuple(m for m in members if m in scene.by_name)
    if len(members) == 1 and len(pairs) == 1 and len(drivers) + len(rolling) == 1:
        driver = drivers[0] if drivers else rolled_by(scene, rolling[0], members[0], pairs[0])
        if driver is not None:
            base = next((n for n in drivers[0].links if later[drivers[0]] and n not in members), "") if drivers else ""
            return Driven(members[0], pairs[0], driver, () if base in known else turned.get(base, ()))
    bodies, loose = _bodies(structure, members, drivers)
    dyad = _dyad(structure, bodies, pairs, real) if not loose and not rolling else None
    if dyad is not None:
        return dyad
    order = 2 if rolling and _rolls_like_a_dyad(members, pairs, drivers, rolling) else _order(bodies, pairs)
    return LargerGroup(tuple(members), tuple(pairs), tuple(drivers), real, order, rolling=rolling)


def _touches(structure: Structure, relation: RollingRelation, inside: set[str], known: set[str]) -> bool:
    """Whether a relation holds members of a group and otherwise known links only."""
    slides = (structure.slide(name) for kind, name in relation.terms if kind == "travel")
    within = {*relation.links, *(n for s in slides for n in s.links)} - {structure.scene.frame.name}
    return bool(within & inside) and within <= inside | known


def _pairs(structure: Structure, members: list[str], known: set[str]) -> list[Pair]:
    """All pairs that hold the members: to known links, or among themselves."""
    pairs: list[Pair] = []
    inside, rank = set(members), _ranks(structure)
    for point, names in structure.hinges.items():
        if inside.isdisjoint(names):
            continue
        mine = sorted(inside.intersection(names), key=rank)
        base = [n for n in names if n in known]
        pairs += [Pair(point, n, base[0]) for n in mine] if base else [Pair(point, b, a) for a, b in pairwise(mine)]
    return pairs + [s for s in structure.slides if inside.intersection(s.links) and {*s.links} <= inside | known]


def _bodies(
    structure: Structure, members: list[str], drivers: Sequence[Driver]
) -> tuple[list[Body], list[Driver]]:
    """The bodies of a group, links that drivers hold together, and the drivers that act at no pair inside it."""
    joints: list[DrivenJoint] = []
    loose: list[Driver] = []
    for driver in drivers:
        pair = driver_pair(driver, structure.links, structure.slides)
        if pair is None or not {*pair.links} <= set(members):
            loose.append(driver)
        else:
            joints.append(DrivenJoint(pair, driver, pair.b, pair.a))
    bodies: list[Body] = []
    left = list(members)
    while left:
        names, used = [left.pop(0)], list[DrivenJoint]()
        while joint := next((j for j in joints if (j.a in names) != (j.b in names)), None):
            used.append(joint if joint.a in names else DrivenJoint(joint.pair, joint.driver, joint.b, joint.a, -1))
            names.append(used[-1].b)
            left.remove(used[-1].b)
        bodies.append(Body(tuple(names), tuple(used)))
    return bodies, loose


def _dyad(structure: Structure, bodies: list[Body], pairs: list[Pair], links: tuple[str, ...]) -> Dyad | None:
    """Two bodies as a dyad, turned as `Dyad` says; None where they do not hang by one pair each on known links and by
    one on each other, or have three sliding pairs."""
    if len(bodies) != 2:
        return None
    first_body, second_body = bodies
    of_sides: dict[tuple[bool, bool], dict[str, Pair]] = {}  # by the bodies that they hold
    for pair in pairs:
        sides = not {*first_body.links}.isdisjoint(pair.links), not {*second_body.links}.isdisjoint(pair.links)
        if all(sides) or not any({*body.links}.issuperset(pair.links) for body in bodies):
            # links held together by a driver at this very point hang on it once
            of_sides.setdefault(sides, {}).setdefault(pair.point or pair.key, pair)
    held = [[*of_sides.get(sides, {}).values()] for sides in _SIDES]
    if any(len(pairs_there) != 1 for pairs_there in held):
        return None
    (middle,), (outer_first,), (outer_second,) = held
    letters = outer_first.letter + middle.letter + outer_second.letter
    if letters not in _KINDS:
        return None
    kind, begins = _KINDS[letters]
    rank = _ranks(structure)
    sides_of = (outer_first, first_body), (outer_second, second_body)
    first_rank, second_rank = (next(rank(n) for n in pair.links if n in body.links) for pair, body in sides_of)
    if begins == "the other" or (begins == "as written" and second_rank < first_rank) or (
            begins == "what slides" and middle.a in second_body.links):
        first_body, second_body, outer_first, outer_second = second_body, first_body, outer_second, outer_first
    return Dyad(kind, first_body, second_body, middle, outer_first, outer_second, links)


def _rolls_like_a_dyad(
    members: Sequence[str], pairs: Sequence[Pair], drivers: Sequence[Driver], rolling: Sequence[RollingRelation]
) -> bool:
    """Whether a group has the velocities of two links with three joints, one of them at the point of rolling, as if
    hinged there: a link that only carries a wheel follows it, links joined by a driver count as one."""
    carriers = {carrier for relation in rolling for carrier in relation.links[2:]}
    bodies = sum(name not in carriers for name in members)
    joints = sum(not carriers & {pair.a, pair.b} for pair in pairs) + len(rolling)
    return (bodies, joints) == (2 + len(drivers), 3 + len(drivers))


def _order(bodies: Sequence[Body], pairs: Sequence[Pair]) -> int:
    """Class of a group after Assur and Artobolevsky: the most pairs on a body of it (three or more), or the most
    bodies in a shortest closed contour of it (four or more).  Links joined by a driver are one body."""
    body_of = {link: body.links[0] for body in bodies for link in body.links}
    ends = [(body_of.get(p.a, ""), body_of.get(p.b, "")) for p in pairs]
    ends = [(a, b) for a, b in ends if a != b]
    most = max(sum(body in pair for pair in ends) for body in body_of.values())
    edges = [pair for pair in ends if all(pair)]
    contour = 0
    for i, (a, b) in enumerate(edges):
        reach, front, steps = {a}, [a], 1
        while front and b not in reach:
            front = [y for x in front for j, e in enumerate(edges) if j != i and x in e for y in e if y not in reach]
            reach.update(front)
            steps += 1
        if b in reach:
            contour = max(contour, steps)
    return max(3, most, contour if contour >= 4 else 0)


# driven triangles, and what rolls at the scene's own position


def _triangles(structure: Structure, group: LargerGroup, taken: set[str]) -> tuple[DrivenTriangle, ...]:
    """The driven triangles of a larger group; ``taken`` are the keys of drivers, which no other driver may have."""
    triangles: list[DrivenTriangle] = []
    for driver in group.drivers:
        free = (t for t in _closed_by(structure, group, driver) if t.equivalent.key not in taken)
        triangles += islice(free, 1)
        taken.update(t.equivalent.key for t in triangles)
    return tuple(triangles)


def _closed_by(structure: Structure, group: LargerGroup, driver: Driver) -> Iterator[DrivenTriangle]:
    """The triangles that a driven slide closes with a pair of two links not yet known: of tippers, scissor lifts,
    excavators.

    The rod and the cylinder hang on two links that a pair joins.  With one of these held still, the other, the rod and
    the cylinder are a dyad with a given travel in it: the triangle is rigid for the moment, and the motion at the
    common pair follows, whatever the rest of the mechanism does.
    """
    if not driver.slide or not {*driver.links} <= {*group.members}:
        return
    hung: list[list[set[str]]] = []  # for each pair of rod and cylinder besides the slide what it joins them to
    for link in driver.links:
        points = {pair.point for pair in group.pairs if pair.point in structure.links[link].points}
        joints = [{*structure.hinges[point]} - {link} for point in sorted(points)]
        joints += [{p.other(link)} for p in group.pairs if not p.turns and p.key != driver.slide and link in p.links]
        hung.append(joints)
    if any(len(joints) != 1 for joints in hung):
        return
    for a, b in product(*([n for n in group.members if n in joints[0]] for joints in hung)):
        if a == b or {a, b} & {*driver.links}:
            continue
        common = [Pair(point, b, a) for point, names in structure.hinges.items() if a in names and b in names]
        common += [pair for pair in group.pairs if not pair.turns and {*pair.links} == {a, b}]
        first, second = sorted((a, b), key=group.members.index)
        for held, other in ((first, second), (second, first)) if len(common) == 1 else ():
            (pair,) = common
            ends_of_driver, slide = ((other, held), "") if pair.turns else (pair.links, pair.key)
            equivalent = Driver(*ends_of_driver, 0.0, 0.0, 0.0, slide)
            yield DrivenTriangle(held, (other, *driver.links), pair, driver, equivalent)


def _in_parts(structure: Structure) -> Structure:
    """The elements with the larger groups that driven triangles turn into dyads marked as groups of class II."""
    taken = {d.key for d in structure.drivers}
    triangles_of = {group: _triangles(structure, group, taken) for group in structure.larger_groups}
    instead = {t.driver: t.equivalent for triangles in triangles_of.values() for t in triangles}
    if not instead:
        return structure
    try:
        opened = analyse(replace(structure.scene, drivers=tuple(instead.get(d, d) for d in structure.scene.drivers)))
    except Unsolvable:
        return structure
    elements: list[Element] = []
    for e in structure.elements:
        if isinstance(e, LargerGroup) and triangles_of[e]:
            inside = [part for part in opened.elements if set(part.members) & set(e.members)]
            parts = tuple(part for part in inside if isinstance(part, Driven | Dyad))
            if len(parts) == len(inside):
                e = replace(e, order=2, triangles=triangles_of[e], parts=parts)
        elements.append(e)
    return replace(structure, elements=tuple(elements))


def _with_starts(structure: Structure) -> Structure:
    """The elements with the starts of groups whose links move each other by rolling, at the scene's own position."""
    groups = [e for e in structure.larger_groups if e.rolling]
    if not groups:
        return structure
    for drivers in start_drivers(structure, groups):
        left = list(drivers)
        with_starts = {g: replace(g, starts=tuple(left.pop(0) for _ in g.rolling)) for g in groups}
        whole = replace(structure, elements=tuple(with_starts.get(e, e) for e in structure.elements))  # type: ignore[arg-type]
        try:
            started(whole)
        except Unsolvable:
            continue
        return whole
    names = listed([*dict.fromkeys(r.name for g in groups for r in g.rolling)])
    raise Unsolvable("mobility", Problem(names, "nothing tells where what rolls here stands",
                                         "write the start of a link that rolls"))


def started(structure: Structure) -> Structure:
    """The mechanism at the scene's own position, in which drivers replace the rolling of groups whose links move each
    other by it."""
    groups = [e for e in structure.larger_groups if e.starts]
    scene = structure.scene
    names = [r.name for g in groups for r in g.rolling]
    drivers = (*scene.drivers, *(d for g in groups for d in g.starts))
    return analyse(replace(unrolled(scene, names), drivers=drivers))


def regrouped(scene: Mechanism, known: Iterable[str], members: Iterable[str]) -> tuple[Element, ...] | None:
    """The elements that place some links of a scene when others are known; None where the constraints between them are
    too few or too many."""
    structure = _placed(scene)
    placed, wanted = set(known), set(members)

    def settled(node: Node) -> bool:
        kind, name = node
        return name in placed if kind == "link" else not placed.isdisjoint(structure.hinges[name])

    def is_open(node: Node) -> bool:
        """Whether a node must be placed: a wanted link, or a hinge of a wanted link that no known link has."""
        kind, name = node
        return name in wanted if kind == "link" else not (wanted.isdisjoint(structure.hinges[name]) or settled(node))

    nodes = [n for n in _nodes(structure) if is_open(n)]
    free = set(nodes)
    rows = []
    for equation in _equations(structure):
        inside = sorted(u for u in equation if u[0] in free)
        if inside and all(n in free or settled(n) for n, _ in equation):
            rows.append(inside)
    given = match(rows)
    if len(given) < len(rows) or len(rows) != sum(3 if kind == "link" else 2 for kind, _ in nodes):
        return None
    return _in_order(structure, nodes, rows, given, placed, {})


# why there is no order of solution


def _wrong_count(structure: Structure) -> Problem:
    """The sentences on a mechanism with more or fewer drivers than its mobility: the count, and the remedy."""
    scene, mobility = structure.scene, structure.mobility
    given = len(scene.drivers)
    higher = f" - {mobility.higher}" if mobility.higher else ""
    count = f"F = 3*{mobility.links} - 2*{mobility.lower}{higher} = {mobility.value}"
    wanted: list[Wording] = [Phrase("a mechanism of mobility needs as many drivers", mobility=mobility.value)]
    if given > mobility.value > 0:
        names = listed([driver.key for driver in scene.drivers])
        wanted = [Phrase("too many drivers a mechanism of mobility takes", names=names, mobility=mobility.value)]
    idle = [link.name for link in scene.links if link.redundant]
    if idle and mobility.value > given:
        wanted.append(Phrase(about("marked redundant is not counted", idle), links=listed(idle)))
    if given == 0:
        wanted.append(Phrase("write in the file driver with"))
    if mobility.value <= 0:
        loop = _sliding_loop(structure)
        more = Phrase("gruebler's count fails here links slide on each", loop=listed(loop)) if loop else None
        wanted = [more or Phrase("it is a structure no driver can move")]
    counted = Phrase("drivers counted" if given > 1 else "driver counted", count=given)
    drivers = counted if given else Phrase("no driver")
    return Problem(Phrase("status mobility"), "but given", clauses(wanted), count=count, drivers=drivers)


def _sliding_loop(structure: Structure) -> list[str]:
    """Links of a closed loop of sliding pairs only, if there is one."""
    group: dict[str, set[str]] = {name: {name} for name in structure.links}
    for s in structure.slides:
        if group[s.a] is group[s.b]:
            ends = {n for t in structure.slides if group[t.a] is group[s.a] for n in t.links}
            return sorted(ends, key=_ranks(structure))
        merged = group[s.a] | group[s.b]
        group.update(dict.fromkeys(merged, merged))
    return []


def _wrong_part(structure: Structure, unknowns: list[list[Unknown]], given: Mapping[int, Unknown]) -> Problem:
    """Name the overconstrained links and the free ones (the parts of Dulmage and Mendelsohn)."""
    owner = {u: i for i, u in given.items()}
    unserved = (i for i in range(len(unknowns)) if i not in given)
    over = reached(unserved, lambda i: [owner[u] for u in unknowns[i] if u in owner])
    every = ((n, a) for n in _nodes(structure) for a in ("xyt" if n[0] == "link" else "xy"))
    free = reached((u for u in every if u not in owner), lambda u: [v for i, v in given.items() if u in unknowns[i]])

    def names(unknowns_there: Iterable[Unknown]) -> object:
        links = {name for (kind, name), _ in unknowns_there if kind == "link"}
        ranked: list[str] = sorted(links, key=_ranks(structure))
        return listed(ranked) if ranked else Phrase("no link")

    loop = _sliding_loop(structure)
    wanted = Phrase("each part of the mechanism needs as many")
    if loop:
        wanted = Phrase("links slide on each other in a closed", loop=listed(loop))
    held = names(u for i in over for u in unknowns[i])
    where = Phrase("status mobility")
    return Problem(where, "links held too much links left free", wanted, names=held, other=names(free))


def _loose_ends(structure: Structure) -> Iterator[Problem]:
    """The reasons why a mechanism has more freedom than was meant, by name: points that join nothing, links that one
    pair alone holds and no driver moves; none where all links hang together.

    The commonest cause is a slip of the hand, a name written in two ways; the next a roller, whose own turning moves
    nothing else.
    """
    scene, hinges = structure.scene, structure.hinges
    moving = [link for name, link in structure.links.items() if name in scene.by_name and name != scene.frame.name]
    unused = [p for p in scene.frame.points if p not in hinges]
    held = {*hinges, *(p.motion.tip for p in structure.lifting), *(s.pin for s in structure.slides if s.higher)}
    free = {link.name: [p for p in link.bar if p not in held] for link in moving}
    lonely = [p for points in free.values() for p in points]
    driven = {name for driver in scene.drivers for name in driver.links}
    for link in moving:
        joints = [p for p, names in hinges.items() if link.name in names]
        joints += [s.key for s in structure.slides if link.name in s.links]
        joints += [f"cam {p.name}" if p.by_law else p.name for p in structure.touching
                   if (p.rolling or p.by_law) and link.name in p.members]
        where, ends = f"links.{link.name}", free[link.name]
        if len(joints) >= 2:
            continue
        for point in ends:
            like = _like(point, unused) or _like(point, [p for p in lonely if p not in link.points])
            meant = Phrase("did you mean a point of the frame" if like in unused else "did you mean a point", name=like)
            hangs: Wording = Phrase("so that it hangs on one joint alone", joint=joints[0]) if joints else ""
            yield Problem(where, "no other link has its point",
                          meant if like else Phrase("write the same name in the link that"), point=point, link=hangs)
        if not ends and len(joints) == 1 and structure.mobility.value > len(scene.drivers):
            if link.name in driven:
                yield Problem(where, "its driver moves it but nothing else", "join it to another link too")
            elif joints[0] in hinges:
                yield Problem(where, "it hangs on alone and turns there freely", "join it to another link too or leave",
                              joints=joints[0])
            else:
                yield Problem(where, "holds it alone so that it moves", "join it to another link too or drive",
                              pair=joints[0])
        if not ends and not joints:
            yield Problem(where, "nothing holds it", "name a point of another link or a")


def _like(point: str, names: Sequence[str]) -> str:
    """The name most like a point's, "" if none is like it."""
    near = get_close_matches(point, names, n=1, cutoff=0.5)
    return near[0] if near else next((n for n in names if n.lower()[:1] == point.lower()[:1]), "")


def driven_by(scene: Mechanism, link: str) -> Structure:
    """The structure of a mechanism of one driver that another link drives, about the frame or along it.

    Raises
    ------
    CallError : there is no such link, or it neither turns about the frame nor slides on it
    Unsolvable : with this driver it is no mechanism
    """
    where = Phrase("driver of driver", driver=link)
    known = [body.name for body in scene.links]
    if link not in known:
        raise CallError.of(where, "there is no link", did_you_mean(link, known), name=link)
    rail = scene.rail(link)
    if rail is None and not scene.pivots(link):
        raise CallError.of(where, "neither turns about the frame nor slides on")
    driver = Driver(link, scene.frame.name, 0.0, 0.0, 0.0, rail.key if rail else "")
    return analyse(replace(scene, drivers=(driver, *scene.drivers[1:])))
