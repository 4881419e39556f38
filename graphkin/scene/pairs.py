"""What joins the links of a file: sliding pairs, pins in slots; whether every link is held.

What a file says as people measure and draw it (circular slots, carriages with two pins) is written first as the
tables that say the same by links, lengths and angles.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches

from graphkin.errors import Problem, did_you_mean
from graphkin.files import OwnTables
from graphkin.plane import direction
from graphkin.scene.model import CircularSlot, PinInSlot, SlidingPair
from graphkin.scene.names import Flaws, Names
from graphkin.scene.tables import Guide, Link, Pin, SceneTables
from graphkin.scene.touching import touching_links
from graphkin.words import Phrase

__all__ = ["islands", "pins_in_slots", "sliding_pairs", "with_bars", "with_carriages"]

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


def with_carriages(file: SceneTables) -> SceneTables:
    """The file with each sliding link of two own points that says neither their distance nor ``angle_on``, but

    - in ``at`` where the second stands from the first, as a link of one own point: its axes lie along the guide, and
      all its places are in them; or
    - nothing, where both are in ``[drawn]`` and the guide is one of the frame with an angle, at the angle drawn.
    """
    links = {name: _measured(file, link) for name, link in file.links.items()}
    return file if links == dict(file.links) else replace(file, links=links)


def _measured(file: SceneTables, link: Link) -> Link:
    single = link.on is not None and (isinstance(link.on, str) or len(link.on) == 1)
    if len(link.points) != 2 or not single or link.angle_on is not None:
        return link
    first, second = link.points
    if second in link.at and link.at[second] != "drawn" and link.length is None:
        return replace(link, points=[first])
    turned = _drawn(file, link)
    return link if turned is None else replace(link, angle_on=turned)


def _drawn(file: SceneTables, link: Link) -> float | None:
    """The angle (degrees) from the guide to both drawn points, if they tell it."""
    ref = link.on if isinstance(link.on, str) else (link.on or [""])[0]
    on, _, name = ref.partition(".")
    guide = file.frame.guides.get(name)
    if on != file.frame.name or (name and (guide is None or guide.angle is None)):
        return None
    if not all(point in file.drawn for point in link.points):
        return None
    one, two = (complex(*file.drawn[point]) for point in link.points)
    if one == two:
        return None
    angle = math.degrees(cmath.phase(two - one)) - ((guide.angle or 0.0) if guide is not None else 0.0)
    return math.remainder(angle, 360.0)


class _Slots:
    """The circular slots of a file while they are taken out of it."""

    def __init__(self, file: SceneTables, flaws: Flaws, problems: list[Problem]) -> None:
        self.file, self.flaws, self.problems = file, flaws, problems
        frame = file.frame.name
        self.holders: OwnTables = {**file.links, frame: file.frame}
        self.points = {n: {*getattr(h, "at", {}), *h.points} for n, h in self.holders.items()}
        self.given: dict[str, OwnTables] = {n: {} for n in self.holders}  # points that stand for places of centres
        self.arcs: dict[tuple[str, str], tuple[str, float, Guide]] = {}
        for name, holder in self.holders.items():
            where = "frame" if name == frame and name not in file.links else f"links.{name}"
            for key, guide in holder.guides.items():
                if guide.centre is not None or guide.r is not None or guide.ends is not None:
                    self._slot(f"{where}.guides.{key}", name, key, guide)

    def _slot(self, where: str, name: str, key: str, guide: Guide) -> None:
        both = [k for k in ("through", "angle", "toward") if getattr(guide, k) is not None]
        if both:
            hint = Phrase("a straight guide has through and angle a")
            self.problems.append(Problem(f"{where}.{both[0]}", Phrase("stands in a slot along a circle"), hint))
        if guide.centre is None or guide.r is None:
            missing = "centre" if guide.centre is None else "r"
            wanted = (
                Phrase("write centre m or x y and r") if guide.centre is None else Phrase("write the slot's radius")
            )
            self.problems.append(Problem(f"{where}.{missing}", Phrase("is missing"), wanted))
        centre = guide.centre
        if isinstance(centre, str):
            if centre not in self.points[name] and not self.flaws.under(*where.split(".")[:2]):
                wanted = did_you_mean(centre, sorted(self.points[name]))
                self.problems.append(
                    Problem(
                        f"{where}.centre",
                        Phrase("link has no point of name and centre", name=name, centre=centre),
                        wanted,
                    )
                )
                centre = None
        elif centre is not None:
            point = self._free("M", {p for own in self.points.values() for p in own})
            self.given[name][point] = list(centre)
            self.points[name].add(point)
            centre = point
        self.arcs[name, key] = (str(centre or ""), guide.r or 0.0, guide)

    @staticmethod
    def _free(name: str, taken: set[str]) -> str:
        return next(n for n in (name, *(f"{name}{k}" for k in range(1, 10_000))) if n not in taken)

    def of(self, ref: str) -> tuple[str, str] | None:
        """The link and the name of the circular slot that a guide's name means."""
        link, _, guide = ref.partition(".")
        return (link, guide) if (link, guide) in self.arcs else None


def _refs(refs: str | Sequence[str] | None) -> list[str]:
    return [] if refs is None else [refs] if isinstance(refs, str) else list(refs)


def with_bars(
    file: SceneTables, flaws: Flaws, problems: list[Problem]
) -> tuple[SceneTables, tuple[CircularSlot, ...]]:
    """The file with bars and turning pairs in place of circular slots, and what they stand for; what is wrong is added
    to ``problems``."""
    slots = _Slots(file, flaws, problems)
    if not slots.arcs:
        return file, ()
    metres, found = file.units.metres, list[CircularSlot]()
    taken = {*slots.holders}
    links: dict[str, Link] = {}
    pins: dict[str, Pin] = {}
    bars: dict[str, Link] = {}

    def slot(key: tuple[str, str], bar: str, point: str, block: bool) -> None:
        centre, r, guide = slots.arcs[key]
        ends = None if guide.ends is None else (math.radians(guide.ends[0]), math.radians(guide.ends[1]))
        found.append(CircularSlot(key[1], key[0], centre, r * metres, bar, point, block, ends))

    for point, pin in file.pins.items():
        straight = [ref for ref in _refs(pin.slots) if slots.of(ref) is None]
        if straight:
            pins[point] = replace(pin, slots=straight)
        for key in filter(None, map(slots.of, _refs(pin.slots))):
            where, (centre, r, _) = f"pins.{point}", slots.arcs[key]
            if pin.of not in slots.holders:
                problems.append(
                    Problem(f"{where}.of", Phrase("there is no link", name=pin.of), did_you_mean(pin.of, taken))
                )
            elif point not in slots.points[pin.of]:
                wanted = did_you_mean(point, sorted(slots.points[pin.of]))
                problems.append(
                    Problem(
                        f"{where}.of", Phrase("link has no point of name and centre", name=pin.of, centre=point), wanted
                    )
                )
            elif pin.of == key[0] or point in slots.points[key[0]]:
                problems.append(Problem(f"{where}.in", Phrase("is a point of link itself", point=point, key=key[0]),
                                        Phrase("name the slot of another link")))  # fmt: skip
            elif centre:
                bar = slots._free(key[1], taken)
                taken.add(bar)
                bars[bar] = Link(points=[centre, point], length=r)
                slot(key, bar, point, block=False)
    for name, link in file.links.items():
        refs = _refs(link.on)
        keys = [slots.of(ref) for ref in refs]
        at: OwnTables = {**link.at, **slots.given[name]}
        on, angle_on = link.on, link.angle_on
        if any(keys):
            angles = _refs_of_angles(angle_on, len(refs))
            kept = [k for k, key in enumerate(keys) if key is None]
            on = [refs[k] for k in kept] or None
            angle_on = [angles[k] for k in kept] or None
            at |= _centres(slots, name, link, [(key, angles[k]) for k, key in enumerate(keys) if key], slot)
        links[name] = replace(link, on=on, angle_on=angle_on, at=at, guides=_straight(slots, name, link.guides))
    frame = replace(
        file.frame,
        points={**file.frame.points, **slots.given[file.frame.name]},
        guides=_straight(slots, file.frame.name, file.frame.guides),
    )
    return replace(file, frame=frame, links={**links, **bars}, pins=pins), tuple(found)


def _refs_of_angles(angles: float | Sequence[float] | None, count: int) -> list[float]:
    given = [angles] if isinstance(angles, int | float) else list(angles or [])
    return (given + [0.0] * count)[:count]


def _centres(
    slots: _Slots, name: str, link: Link, keys: Sequence[tuple[tuple[str, str], float]], slot: Callable[..., None]
) -> dict[str, list[float]]:
    """The centres of the slots that a block runs in, as points in its own axes."""
    made: dict[str, list[float]] = {}
    for key, angle in keys:
        centre, r, _ = slots.arcs[key]
        if key[0] == name:
            slots.problems.append(
                Problem(f"links.{name}.on", Phrase("link slides on itself", name=name), Phrase("name another link"))
            )
        elif not link.points:
            slots.problems.append(
                Problem(f"links.{name}.points", Phrase("is missing"), Phrase("name the point of the block that runs"))
            )
        elif centre:
            # along the guide's sense, turned back by angle_on, lies the own x axis: the centre is to the left of it
            way = 1j * direction(-angle)
            made[centre] = [r * way.real, r * way.imag]
            slot(key, name, link.points[0], block=True)
    return made


def _straight(slots: _Slots, name: str, guides: Mapping[str, Guide]) -> dict[str, Guide]:
    return {key: guide for key, guide in guides.items() if (name, key) not in slots.arcs}
