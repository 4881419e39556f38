"""What holds the links of a scene: hinges, slides and drivers as equations between coordinates."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from graphkin.scene.cams import LawCam, SlidingFollower
from graphkin.scene.model import Driver, Mechanism, PlacedGuide, PlacedLink
from graphkin.structure.model import Mobility, Pair
from graphkin.structure.replacement import replacing_link
from graphkin.structure.rolling import followers_of, meshes_of, relations_of

__all__ = ["Constraints", "Node", "Unknown"]

Node = tuple[str, str]  # ("link" | "point", name)
Unknown = tuple[Node, str]  # a node and one of its coordinates x, y, t


class Constraints:
    """The links, blocks, hinges and slides that take part, and their constraints."""

    def __init__(self, scene: Mechanism) -> None:
        self.scene = scene
        links: dict[str, PlacedLink] = {scene.frame.name: scene.frame}
        links.update({link.name: link for link in scene.links if not link.redundant})
        slides = [
            Pair(s.key, s.link, s.on, links[s.on].guides[s.guide], s.turn, s.pin)
            for s in scene.slidings
            if s.link in links and s.on in links
        ]
        for pin in scene.pins:
            if pin.of not in links or pin.on not in links:
                continue
            links[pin.key] = PlacedLink(pin.key, {pin.point: 0j}, (pin.point,), {"": PlacedGuide("", 0j, 1 + 0j)})
            slides.append(Pair(pin.key, pin.key, pin.on, links[pin.on].guides[pin.guide], 1 + 0j, pin.point, True))
        self.contacts = tuple(c for c in scene.contacts if {*c.links, c.carrier} - {""} <= links.keys())
        self.gears = tuple(g for g in scene.gears if {*g.wheels, g.carrier} <= links.keys())
        for contact in self.contacts:
            link, slide = replacing_link(contact, links)
            links[link.name] = link
            slides += [slide] if slide else []
        hinges: dict[str, list[str]] = {}
        for link in links.values():
            for point in link.points:
                hinges.setdefault(point, []).append(link.name)
        self.links: Mapping[str, PlacedLink] = links
        self.slides = tuple(slides)
        self.hinges = {p: tuple(names) for p, names in hinges.items() if len(names) > 1}
        self.cams: tuple[LawCam, ...] = tuple(
            cam for cam in scene.cams if scene.instead_of is None and {cam.link, cam.follower} <= links.keys()
        )
        relations = relations_of(scene, meshes_of(scene, self.contacts, self.gears, links))
        self.followers, self.relations = followers_of(scene, relations, links, self.slides)
        self.drivers: tuple[Driver, ...] = (*scene.drivers, *self.followers)
        self._place = {name: i for i, name in enumerate(links)}

    def place(self, node: Node) -> tuple[int, int, str]:
        """Order of nodes: links as in the file, then blocks, then points."""
        kind, name = node
        return (0, self._place[name], "") if kind == "link" else (1, 0, name)

    def nodes(self) -> list[Node]:
        moving = [name for name in self.links if name != self.scene.frame.name]
        return [("link", name) for name in moving] + [("point", name) for name in self.hinges]

    def mobility(self) -> Mobility:
        frame = self.scene.frame.name
        bars = {s.bar for s in self.scene.slots if not s.block and s.bar in self.links}  # instead of pins in slots
        real = [name for name in self.links if name in self.scene.by_name and name not in bars]
        shared = [sum(name in real for name in names) for names in self.hinges.values()]
        lower = sum(n - 1 for n in shared if n) + sum(not s.slot for s in self.slides)
        rolling = [c for c in self.contacts if c.rolling and not c.carrier]  # two constraints each, as a lower pair
        blocks = sum(s.slot for s in self.slides) - sum(c.flat for c in self.contacts)
        higher = blocks + len(bars) + len(self.contacts) - len(rolling) + len(self.gears) + len(self.cams)
        return Mobility(len([n for n in real if n != frame]), lower + len(rolling), higher)

    def equations(self) -> list[set[Unknown]]:
        """For each scalar constraint the coordinates in it."""
        rows: list[set[Unknown]] = []
        for point, names in self.hinges.items():
            for name in names:
                for axis in "xy":
                    rows.append({(("point", point), axis), *self._coordinates(name, axis + "t")})
        for s in self.slides:
            rows.append({*self._coordinates(s.a, "t"), *self._coordinates(s.b, "t")})
            rows.append({*self._coordinates(s.a, "xy"), *self._coordinates(s.b, "xyt")})
        for cam in self.cams:
            moved = "xy" if isinstance(cam.motion, SlidingFollower) else "t"
            rows.append({*self._coordinates(cam.link, "t"), *self._coordinates(cam.follower, moved)})
        for relation in self.relations:
            row: set[Unknown] = set()
            for kind, name in relation.terms:
                if kind == "angle":
                    row.update(self._coordinates(name, "t"))
                else:
                    s = next(s for s in self.slides if s.key == name)
                    row.update((*self._coordinates(s.a, "xy"), *self._coordinates(s.b, "xyt")))
            rows.append(row)
        for driver in self.drivers:
            driven, base = ("t", "t") if driver.turns else ("xy", "xyt")
            rows.append({*self._coordinates(driver.link, driven), *self._coordinates(driver.relative_to, base)})
        return rows

    def _coordinates(self, name: str, axes: str) -> Iterable[Unknown]:
        if name == self.scene.frame.name:
            return ()
        return [(("link", name), axis) for axis in axes]
