"""The part of a mechanism that leads to what is asked for, and nothing more."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.scene.model import Driver, Mechanism
from graphkin.scene.symbol import Symbol, centre_links
from graphkin.structure.model import Cluster, Driven, Element, Structure, links_of
from graphkin.words import Phrase

__all__ = ["by_drivers_alone", "greatest_before", "in_stages", "links_for", "needed", "part_of"]


def needed(structure: Structure, asked: Sequence[Symbol]) -> list[Element]:
    """The elements on the way to what is asked, in the order of solution; all of them if nothing is asked.

    Raises
    ------
    CallError : a symbol that names no point of a link here
    """
    if not asked or any(symbol.scope in ("force", "cycle") for symbol in asked):  # every link may push any other
        return list(structure.elements)
    wanted = [name for symbol in asked for name in links_for(structure, symbol)]
    kept: set[int] = set()
    while wanted:
        place = structure.place_of.get(wanted.pop())
        if place is not None and place not in kept:
            kept.add(place)
            wanted += structure.hangs_on[place]
    return [structure.elements[place] for place in sorted(kept)]


def by_drivers_alone(structure: Structure, symbol: Symbol) -> bool:
    """Whether a quantity of the motion hangs on no group, but on links that drivers and cams move from the frame: it is
    known where a group is lost in rounding."""
    if symbol.seen or not all(
        name in structure.links for name in symbol.links()
    ):  # of redundant links nothing is asked
        return False
    try:
        return links_for(structure, symbol).isdisjoint(structure.found_by_groups)
    except CallError:  # a special point of the drawing
        return False


def greatest_before(structure: Structure, sizes: Iterable[tuple[Symbol, float]]) -> Callable[[Symbol], float]:
    """For a quantity of the motion the greatest of sizes: of its own, and of those of the links that it hangs on.

    What is greater farther on in the order of solution has no part in it: beside a dead point of the last group the
    rates of the others are as they are.  Of points that are no link's, special points of the drawing, and seen from a
    link that is held still, all sizes count; theirs count from the first larger group on.
    """

    def places(symbol: Symbol) -> list[int] | None:
        try:
            found = None if symbol.seen else links_for(structure, symbol)
        except CallError:
            return None
        return None if found is None else [place for n in found if (place := structure.place_of.get(n)) is not None]

    count = len(structure.elements)
    special = next((i for i, e in enumerate(structure.elements) if isinstance(e, Cluster)), count - 1)
    before = [0.0] * count
    for symbol, size in sizes:
        at = places(symbol)
        if count and at != []:
            last = special if at is None else max(at)
            before[last] = max(before[last], size)
    whole, grows = max(before, default=0.0), True
    while grows:  # what rolls may follow through links that come later
        grows = False
        for i, links in enumerate(structure.hangs_on):
            most = max((before[structure.place_of[n]] for n in links if n in structure.place_of), default=0.0)
            if most > before[i]:
                before[i], grows = most, True

    def greatest(symbol: Symbol) -> float:
        at = places(symbol)
        return whole if at is None else max((before[place] for place in at), default=0.0)

    return greatest


def in_stages(elements: Sequence[Element]) -> bool:
    """Whether some elements are not given by formulas of the drivers alone: larger groups, found by Newton's method,
    followers of cams, whose law has pieces, and what rolls."""
    followers = (isinstance(e, Driven) and not e.driver.given for e in elements)
    return any(isinstance(e, Cluster) or follows for e, follows in zip(elements, followers, strict=True))


def part_of(structure: Structure, asked: Sequence[Symbol]) -> Mechanism:
    """The scene with only the links, pairs and drivers on the way to what is asked; itself if nothing is asked or
    nothing is left out.

    A link that only repeats others is not on the way to anything, unless it is asked for itself: then all is kept.
    """
    scene = structure.scene
    named = {name for s in asked for name in s.links()}
    if not asked or any(link.redundant and link.name in named for link in scene.links):
        return scene
    kept = {scene.frame.name, *(n for e in needed(structure, asked) for n in links_of(e))}
    if all(link.name in kept for link in scene.links):
        return scene
    return _part_scene(scene, kept, tuple(asked))


def _part_scene(scene: Mechanism, kept: set[str], asked: tuple[Symbol, ...]) -> Mechanism:
    """The scene with these links only."""
    return replace(
        scene,
        links=tuple(link for link in scene.links if link.name in kept),
        slidings=tuple(s for s in scene.slidings if {s.link, s.on} <= kept),
        pins=tuple(p for p in scene.pins if {p.of, p.on} <= kept),
        cams=tuple(c for c in scene.cams if {c.link, c.follower} <= kept),
        contacts=tuple(c for c in scene.contacts if set(c.links) <= kept),
        gears=tuple(g for g in scene.gears if {*g.wheels, g.carrier} <= kept),
        drivers=tuple(d for d in scene.drivers if _ends(scene, d) <= kept),
        find=asked,
        stated=(),
        instead_of=None if scene.instead_of is None else _part_scene(scene.instead_of, kept, asked),
    )


def _ends(scene: Mechanism, driver: Driver) -> set[str]:
    """The links that a driver acts between."""
    if driver.turns:
        return {driver.link, driver.relative_to}
    pin = next((p for p in scene.pins if p.key == driver.key), None)
    return {pin.of, pin.on} if pin else set(driver.key.split("/"))


def links_for(structure: Structure, symbol: Symbol) -> frozenset[str]:
    """The links that a quantity names, and those that hold its points.  Raises CallError where there are none."""
    known: dict[Symbol, frozenset[str]] = structure.kept.setdefault("links for", {})
    if symbol not in known:
        known[symbol] = frozenset(_links_for(structure, symbol))
    return known[symbol]


def _links_for(structure: Structure, symbol: Symbol) -> set[str]:
    if symbol.link:
        # of a pin in a slot the block that stands for it
        return {name for name in (symbol.link, symbol.other, symbol.pair) if name in structure.links} or {symbol.link}
    found: set[str] = set()
    for ref in (symbol.of, symbol.to):
        if ref is None:
            continue
        centre = None if ref.point in structure.scene.holders else centre_links(ref.point, structure.scene.by_name)
        if centre is not None:
            found.update(centre)
            continue
        holders = [n for n, link in structure.links.items() if ref.point in link.points]
        if not holders or (ref.link and ref.link not in structure.links):
            wanted = did_you_mean(ref.point, structure.scene.holders)
            raise CallError(Problem(str(symbol), Phrase("names no point of a link here", ref=ref), wanted))
        if ref.link:
            found.add(ref.link)
        if not ref.link or ref.point not in structure.links[ref.link].points:
            # the pin itself must be placed too: by the first link of the order of solution that has it
            found.add(min(holders, key=lambda n: structure.place_of.get(n, -1)))
    return found
