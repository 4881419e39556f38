"""What joins the links of a file: sliding pairs, pins in slots; whether every link is held."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches

from graphkin.errors import Problem
from graphkin.plane import direction
from graphkin.scene.model import PinInSlot, SlidingPair
from graphkin.scene.names import Flaws, Names
from graphkin.scene.tables import Link, SceneTables
from graphkin.scene.touching import touching_links
from graphkin.words import Phrase

__all__ = ["islands", "pins_in_slots", "sliding_pairs"]


def _as_list(refs: str | Sequence[str]) -> list[str]:
    return [refs] if isinstance(refs, str) else list(refs)


def sliding_pairs(file: SceneTables, names: Names, flaws: Flaws, problems: list[Problem]) -> tuple[SlidingPair, ...]:
    """The sliding pairs of the file; what is wrong with them is added to ``problems``."""
    pairs: list[SlidingPair] = []
    for name, link in file.links.items():
        if link.on is None:
            if link.angle_on is not None and name not in names.unsure and not flaws.under("links", name, "on"):
                problems.append(
                    Problem(
                        f"links.{name}.angle_on", Phrase("stands without on"), Phrase("say what the link slides on")
                    )
                )
            continue
        refs = _as_list(link.on)
        angles = _angles(name, link, len(refs), problems)
        for ref, angle in zip(refs, angles, strict=True):
            on, _, guide = ref.partition(".")
            problem = names.no_guide(f"links.{name}.on", ref) or _sliding_problem(name, on, link, names, pairs)
            if problem:
                problems.append(problem)
                continue
            pairs.append(SlidingPair(name, on, guide, direction(angle), link.points[0] if link.points else None))
    return tuple(pairs)


def _angles(name: str, link: Link, guides: int, problems: list[Problem]) -> list[float]:
    if link.angle_on is None:
        return [0.0] * guides
    angles = [link.angle_on] if isinstance(link.angle_on, int | float) else list(link.angle_on)
    if len(angles) != guides:
        problems.append(
            Problem(
                f"links.{name}.angle_on",
                Phrase("found for guides", count=len(angles), guides=guides),
                Phrase("write one number for each guide"),
            )
        )
        return [0.0] * guides
    return angles


def _sliding_problem(name: str, on: str, link: Link, names: Names, pairs: list[SlidingPair]) -> Problem | None:
    where = f"links.{name}.on"
    if on == name:
        return Problem(where, Phrase("link slides on itself", name=name), Phrase("name the link that guides it"))
    if any({p.link, p.on} == {name, on} for p in pairs):
        return Problem(
            where,
            Phrase("link already has a sliding pair with link", name=name, on=on),
            Phrase("two links have one sliding pair at most"),
        )
    if link.points and link.points[0] in names.points.get(on, ()):
        return Problem(
            where,
            Phrase("is a point of link too which pins", points=link.points[0], on=on),
            Phrase("take away from one of them or do", points=link.points[0], name=name),
        )
    return None


def pins_in_slots(
    file: SceneTables, names: Names, slidings: tuple[SlidingPair, ...], problems: list[Problem]
) -> tuple[PinInSlot, ...]:
    """The pins in slots of the file; what is wrong with them is added to ``problems``."""
    pins: list[PinInSlot] = []
    for point, pin in file.pins.items():
        where = f"pins.{point}"
        problem = names.no_link(f"{where}.of", pin.of) or names.no_point_of(f"{where}.of", pin.of, point)
        if problem:
            problems.append(problem)
        for ref in _as_list(pin.slots):
            on, _, guide = ref.partition(".")
            found = names.no_guide(f"{where}.in", ref)
            if not found and on == pin.of:
                found = Problem(
                    f"{where}.in",
                    Phrase("is a guide of link itself", ref=ref, on=on),
                    Phrase("name the guide of another link"),
                )
            if not found and any(p.point == point and p.on == on for p in pins):
                found = Problem(
                    f"{where}.in",
                    Phrase("runs twice in link", point=point, on=on),
                    Phrase("one slot of link or a turning pair", on=on),
                )
            if not found and point in names.points.get(on, ()):
                found = Problem(
                    f"{where}.in",
                    Phrase("is also a point of link which is", point=point, on=on),
                    Phrase("take away from link or the pin away", point=point, on=on),
                )
            if not found and any(s.key == f"{point}/{on}" for s in slidings):
                found = Problem(
                    where,
                    Phrase("is also the name of a sliding pair", point=point, on=on),
                    Phrase("rename link", point=point),
                )
            if found:
                problems.append(found)
            elif not problem:
                pins.append(PinInSlot(point, pin.of, on, guide))
    return tuple(pins)


def islands(file: SceneTables, names: Names) -> list[tuple[str, ...]]:
    """The sets of links that no chain of joints connects with the frame, in the order of the file.

    A link that does not exist is taken for the one with the nearest name; empty where there is none near, since it
    may stand for the one that seems unheld.
    """
    slides = [(name, ref.partition(".")[0]) for name, link in file.links.items() for ref in _as_list(link.on or [])]
    slides += [(pin.of, ref.partition(".")[0]) for pin in file.pins.values() for ref in _as_list(pin.slots)]
    slides += touching_links(file)
    meant = {n: n if n in names.points else "".join(get_close_matches(n, names.points, n=1)) for p in slides for n in p}
    if "" in meant.values():
        return []
    near: dict[str, set[str]] = {name: set() for name in names.points}
    holders: dict[str, list[str]] = {}
    for name, points in names.points.items():
        for point in points:
            holders.setdefault(point, []).append(name)
    joined = [(a, b) for held in holders.values() for a in held for b in held if a != b]
    for a, b in (*joined, *((meant[a], meant[b]) for a, b in slides)):
        near[a].add(b)
        near[b].add(a)
    apart: list[tuple[str, ...]] = []
    seen: set[str] = set()
    for start in (names.frame, *names.points):
        if start in seen:
            continue
        reached, todo = {start}, [start]
        while todo:
            new = near[todo.pop()] - reached
            reached |= new
            todo += new
        seen |= reached
        if start != names.frame:
            apart.append(tuple(n for n in names.points if n in reached))
    return apart
