"""From a scene to its structure: mobility, and the elements in the order of solution; or why there is no such order.

A scene has none with too many or too few drivers, and where parts are held too much beside parts left free.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from itertools import islice, product

from graphkin.errors import CallError, NoDriver, Problem, Unsolvable, did_you_mean
from graphkin.scene.model import Driver, Mechanism, PlacedLink
from graphkin.structure.groups import Constraints, Node, Unknown, components, element_of, match
from graphkin.structure.model import Driven, DrivenTriangle, Dyad, Element, LargerGroup, Mobility, Pair, Structure
from graphkin.structure.rolling import start_drivers, unrolled
from graphkin.words import Phrase, Wording, about, clauses

__all__ = ["analyse", "driven_by", "mobility_of", "regrouped", "started"]


def _wrong_count(system: Constraints, mobility: Mobility) -> Problem:
    scene = system.scene
    found = len(scene.drivers)
    higher = f" - {mobility.higher}" if mobility.higher else ""
    count = f"F = 3*{mobility.links} - 2*{mobility.lower}{higher} = {mobility.value}"
    wanted: list[Wording] = [Phrase("a mechanism of mobility needs as many drivers", mobility=mobility.value)]
    if found > mobility.value > 0:
        names = ", ".join(d.key for d in scene.drivers)
        wanted = [Phrase("too many drivers a mechanism of mobility takes", names=names, mobility=mobility.value)]
    idle = [link.name for link in scene.links if link.redundant]
    if idle and mobility.value > found:
        wanted.append(Phrase(about("marked redundant is not counted", idle), links=", ".join(idle)))
    if found == 0:
        wanted.append(Phrase("write in the file driver with"))
    if mobility.value <= 0:
        wanted = [Phrase("it is a structure no driver can move")]
        loop = _sliding_loop(system)
        if loop:
            wanted = [Phrase("gruebler's count fails here links slide on each", loop=", ".join(loop))]
    drivers = (
        Phrase("no driver") if found == 0 else Phrase("drivers counted" if found > 1 else "driver counted", count=found)
    )
    return Problem(Phrase("status mobility"), Phrase("but given", count=count, drivers=drivers), clauses(wanted))


def _sliding_loop(system: Constraints) -> list[str]:
    """Links of a closed loop of sliding pairs only, if there is one."""
    group: dict[str, set[str]] = {name: {name} for name in system.links}
    for s in system.slides:
        if group[s.a] is group[s.b]:
            ends = [t for t in system.slides if group[t.a] is group[s.a]]
            return sorted({n for t in ends for n in (t.a, t.b)}, key=lambda n: system.place(("link", n)))
        merged = group[s.a] | group[s.b]
        for name in merged:
            group[name] = merged
    return []


def _wrong_part(system: Constraints, unknowns: list[list[Unknown]], given: dict[int, Unknown]) -> Problem:
    """Name the links that are held too much and those that are free."""
    users: dict[Unknown, list[int]] = {}
    for i, row in enumerate(unknowns):
        for u in row:
            users.setdefault(u, []).append(i)
    owner = {u: i for i, u in given.items()}
    over: set[str] = set()
    queue = [i for i in range(len(unknowns)) if i not in given]
    seen = set(queue)
    while queue:
        for u in unknowns[queue.pop()]:
            if u[0][0] == "link":
                over.add(u[0][1])
            if u in owner and owner[u] not in seen:
                seen.add(owner[u])
                queue.append(owner[u])
    free: set[str] = set()
    todo = [(n, a) for n in system.nodes() for a in ("xyt" if n[0] == "link" else "xy") if (n, a) not in owner]
    done = set(todo)
    while todo:
        u = todo.pop()
        if u[0][0] == "link":
            free.add(u[0][1])
        for i in users.get(u, []):
            if i in given and given[i] not in done:
                done.add(given[i])
                todo.append(given[i])

    def names(found: set[str]) -> str:
        return ", ".join(sorted(found, key=lambda n: system.place(("link", n)))) or "none"

    loop = _sliding_loop(system)
    wanted = Phrase("each part of the mechanism needs as many")
    if loop:
        wanted = Phrase("links slide on each other in a closed", loop=', '.join(loop))
    return Problem(
        "mobility", Phrase("links held too much links left free", names=names(over), other=names(free)), wanted
    )


def analyse(scene: Mechanism | Structure) -> Structure:
    """Find the mobility and the order of solution; a structure is handed back as it is.

    Each constraint is assigned one coordinate that it gives (a perfect matching exists just when every part of the
    mechanism has as many constraints as coordinates); the strongly connected components of what needs what are then
    the Assur groups, in the order of solution.

    Raises
    ------
    Unsolvable
        status "mobility": the number of drivers is not the mobility, or a part of the mechanism is held too much
        while another is free.
    NoDriver
        of that status: a mechanism that can move has no driver at all.
    """
    if isinstance(scene, Structure):
        return scene
    system = Constraints(scene)
    mobility = system.mobility()
    if mobility.value != len(scene.drivers):
        loose = _loose_ends(system) if mobility.value > len(scene.drivers) else ()
        refusal = Unsolvable if scene.drivers or mobility.value <= 0 else NoDriver
        raise refusal("mobility", _wrong_count(system, mobility), *loose)
    equations = system.equations()
    unknowns = [sorted(e) for e in equations]
    given = match(unknowns)
    if len(given) < len(equations):
        raise Unsolvable("mobility", _wrong_part(system, unknowns, given), *_loose_ends(system))
    elements = _in_order(system, system.nodes(), unknowns, given, {scene.frame.name})
    return _with_starts(_in_parts(Structure(
        scene, system.links, system.slides, system.hinges, mobility, elements, system.followers
    )))


def _in_order(
    system: Constraints,
    nodes: Sequence[Node],
    unknowns: Sequence[Sequence[Unknown]],
    given: Mapping[int, Unknown],
    known: set[str],
) -> tuple[Element, ...]:
    """The elements that place some nodes, each after those it needs."""
    needs: dict[Node, list[Node]] = {node: [] for node in nodes}
    for i, (node, _) in given.items():
        others = sorted({n for n, _ in unknowns[i]} - {node}, key=system.place)
        needs[node] += [n for n in others if n not in needs[node]]
    elements: list[Element] = []
    for component in components(needs):
        members = [name for kind, name in component if kind == "link"]
        if not members:
            continue
        members.sort(key=lambda name: system.place(("link", name)))
        elements.append(element_of(system, members, known))
        known.update(members)
    return tuple(elements)


def _triangles(structure: Structure, group: LargerGroup, taken: set[str]) -> tuple[DrivenTriangle, ...]:
    """The driven triangles of a larger group; ``taken`` are the keys of drivers, which no other may bear."""
    found: list[DrivenTriangle] = []
    for driver in group.drivers:
        if driver.slide and {*driver.links} <= {*group.members}:
            fitting = (t for t in _closed_by(structure, group, driver) if t.equivalent.key not in taken)
            for triangle in islice(fitting, 1):
                taken.add(triangle.equivalent.key)
                found.append(triangle)
    return tuple(found)


def _closed_by(structure: Structure, group: LargerGroup, driver: Driver) -> Iterator[DrivenTriangle]:
    """The triangles that a driven slide closes with a pair of two links not yet known: of tippers, scissor lifts,
    excavators.

    The rod and the cylinder hang on two links that a pair joins.  Seen with one of these held still, the other, the rod
    and the cylinder are a dyad with a given travel between: the triangle is rigid at the moment, and the motion at the
    common pair follows at once, whatever the rest of the mechanism does.
    """
    ends = [_hung_on(structure, group, link, driver.slide) for link in driver.links]
    if any(len(joints) != 1 for joints in ends):
        return
    for a, b in product(ends[0][0], ends[1][0]):
        if a == b or {a, b} & {*driver.links}:
            continue
        joints = [Pair(point, b, a) for point, names in structure.hinges.items() if a in names and b in names]
        joints += [pair for pair in group.pairs if not pair.turns and {*pair.links} == {a, b}]
        first, second = sorted((a, b), key=group.members.index)
        for held, other in ((first, second), (second, first)) if len(joints) == 1 else ():
            (pair,) = joints
            ends_of_driver, slide = ((other, held), "") if pair.turns else (pair.links, pair.key)
            equivalent = Driver(*ends_of_driver, 0.0, 0.0, 0.0, slide)
            yield DrivenTriangle(held, (other, *driver.links), pair, driver, equivalent)


def _hung_on(structure: Structure, group: LargerGroup, link: str, slide: str) -> list[tuple[str, ...]]:
    """For each pair of a link besides a slide the members of the group on its other side, which at a hinge may be
    several."""
    points = {pair.point for pair in group.pairs if pair.point in structure.links[link].points}
    joints = [{*structure.hinges[point]} - {link} for point in sorted(points)]
    joints += [{p.other(link)} for p in group.pairs if not p.turns and p.key != slide and link in p.links]
    return [tuple(name for name in group.members if name in names) for names in joints]


def _in_parts(structure: Structure) -> Structure:
    """Larger groups that driven triangles turn into dyads, told as such: of class II."""
    taken = {d.key for d in structure.drivers}
    found: dict[Element, tuple[DrivenTriangle, ...]] = {}
    for group in structure.larger_groups:
        if triangles := _triangles(structure, group, taken):
            found[group] = triangles
    if not found:
        return structure
    instead: dict[Driver, Driver] = {t.driver: t.equivalent for triangles in found.values() for t in triangles}
    try:
        opened = analyse(replace(structure.scene, drivers=tuple(instead.get(d, d) for d in structure.scene.drivers)))
    except Unsolvable:
        return structure
    elements: list[Element] = []
    for e in structure.elements:
        if e in found and isinstance(e, LargerGroup):
            inside = [part for part in opened.elements if set(part.members) & set(e.members)]
            parts = tuple(part for part in inside if isinstance(part, Driven | Dyad))
            if len(parts) == len(inside):
                e = replace(e, order=2, triangles=found[e], parts=parts)
        elements.append(e)
    return replace(structure, elements=tuple(elements))


def _with_starts(structure: Structure) -> Structure:
    """Groups with links that roll and move each other, told where they stand at the scene's own position."""
    groups = [e for e in structure.larger_groups if e.rolling]
    if not groups:
        return structure
    for drivers in start_drivers(structure, groups):
        left = list(drivers)
        told = {g: replace(g, starts=tuple(left.pop(0) for _ in g.rolling)) for g in groups}
        whole = replace(structure, elements=tuple(told.get(e, e) for e in structure.elements))  # type: ignore[arg-type]
        try:
            started(whole)
        except Unsolvable:
            continue
        return whole
    names = ", ".join(dict.fromkeys(r.name for g in groups for r in g.rolling))
    wanted = Phrase("write the start of a link that rolls")
    raise Unsolvable("mobility", Problem(names, Phrase("nothing tells where what rolls here stands"), wanted))


def started(structure: Structure) -> Structure:
    """The mechanism at the scene's own position, without the rolling of groups in which links move each other by it:
    drivers say where they stand.  Itself where there are none."""
    groups = [e for e in structure.larger_groups if e.starts]
    if not groups:
        return structure
    scene = structure.scene
    names = [r.name for g in groups for r in g.rolling]
    drivers = (*scene.drivers, *(d for g in groups for d in g.starts))
    return analyse(replace(unrolled(scene, names), drivers=drivers))


def regrouped(scene: Mechanism, known: Iterable[str], members: Iterable[str]) -> tuple[Element, ...] | None:
    """The elements that place some links of a scene, others being known; None where what holds them does not place
    them, neither more nor less."""
    system = Constraints(scene)
    placed, wanted = set(known), set(members)
    nodes = [n for n in system.nodes() if _open(system, n, placed, wanted)]
    free = set(nodes)
    rows = []
    for equation in system.equations():
        inside = sorted(u for u in equation if u[0] in free)
        if inside and all(n in free or _settled(system, n, placed) for n, _ in equation):
            rows.append(inside)
    given = match(rows)
    if len(given) < len(rows) or len(rows) != sum(3 if kind == "link" else 2 for kind, _ in nodes):
        return None
    return _in_order(system, nodes, rows, given, placed)


def _settled(system: Constraints, node: Node, placed: set[str]) -> bool:
    kind, name = node
    return name in placed if kind == "link" else bool(placed.intersection(system.hinges[name]))


def _open(system: Constraints, node: Node, placed: set[str], wanted: set[str]) -> bool:
    """Whether a node is to be placed: a wanted link, or a hinge of one that no known link has."""
    kind, name = node
    if kind == "link":
        return name in wanted
    return bool(wanted.intersection(system.hinges[name])) and not _settled(system, node, placed)


def mobility_of(scene: Mechanism) -> Mobility:
    """Links, pairs and F of a scene, whatever its drivers are."""
    return Constraints(scene).mobility()


def _loose_ends(system: Constraints) -> Iterator[Problem]:
    """Why a mechanism has more freedom than was meant, by name: points that nothing joins, links that hang on one pin;
    nothing where all hang together.

    The commonest cause is a slip of the hand, a name written in two ways; the next a roller, whose own turning moves
    nothing else.
    """
    scene = system.scene
    moving = [link for name, link in system.links.items() if name in scene.by_name and name != scene.frame.name]
    unused = [p for p in scene.frame.points if p not in system.hinges]
    free = {link.name: [p for p in link.bar if not _held(system, p)] for link in moving}
    lonely = [p for points in free.values() for p in points]
    for link in moving:
        joints = _joints(system, link)
        ends = free[link.name]
        if len(joints) >= 2:
            continue
        for point in ends:
            like = _like(point, unused) or _like(point, [p for p in lonely if p not in link.points])
            wanted = (
                Phrase("did you mean a point", name=like) if like else Phrase("write the same name in the link that")
            )
            if like in unused:
                wanted = Phrase("did you mean a point of the frame", name=like)
            yield Problem(
                f"links.{link.name}", Phrase("no other link has its point", point=point, link=_hangs(joints)), wanted
            )
        if not ends and len(joints) == 1 and system.mobility().value > len(scene.drivers):
            found = Phrase("it hangs on alone and turns there freely", joints=joints[0])
            wanted = Phrase("join it to another link too or leave")
            yield Problem(f"links.{link.name}", found, wanted)
        if not ends and not joints:
            yield Problem(f"links.{link.name}", Phrase("nothing holds it"), Phrase("name a point of another link or a"))


def _held(system: Constraints, point: str) -> bool:
    """Whether something else has a point too, or a pin of it runs in a slot."""
    on_cam = any(cam.name_of_point == point for cam in system.cams)
    return on_cam or point in system.hinges or any(s.slot and s.pin == point for s in system.slides)


def _joints(system: Constraints, link: PlacedLink) -> list[str]:
    """The hinges and slides of a link."""
    hinges = [p for p, names in system.hinges.items() if link.name in names]
    slides = [s.key for s in system.slides if link.name in (s.a, s.b)]
    return hinges + slides + [cam.key for cam in system.cams if link.name in (cam.link, cam.follower)]


def _hangs(joints: Sequence[str]) -> Wording:
    return Phrase("so that it hangs on one joint alone", joint=joints[0]) if joints else ""


def _like(point: str, names: Sequence[str]) -> str:
    """The name that resembles a point's most, "" if none does."""
    near = get_close_matches(point, names, n=1, cutoff=0.5)
    return near[0] if near else next((n for n in names if n.lower()[:1] == point.lower()[:1]), "")


def driven_by(scene: Mechanism, link: str) -> Structure:
    """The structure of a mechanism of one driver that another link drives, about the frame or along it.

    Raises
    ------
    CallError : there is no such link, or it neither turns about the frame nor slides on it
    Unsolvable : so driven it is no mechanism
    """
    known = [one.name for one in scene.links]
    slide = next((s.key for s in scene.slidings if s.link == link and s.on == scene.frame.name), None)
    if link not in known:
        raise CallError(
            Problem(
                Phrase("driver of driver", driver=link),
                Phrase("there is no link", name=link),
                did_you_mean(link, known),
            )
        )
    driver: Driver = Driver(link, scene.frame.name, 0.0, 0.0, 0.0)
    if slide is not None:
        driver = Driver(link, scene.frame.name, 0.0, 0.0, 0.0, slide)
    elif not any(p in scene.frame.points for p in scene.by_name[link].points):
        raise CallError(
            Problem(Phrase("driver of driver", driver=link), Phrase("neither turns about the frame nor slides on"))
        )
    return analyse(replace(scene, drivers=(driver, *scene.drivers[1:])))
