"""Random mechanisms of class II: a driver of every kind, and dyads of every kind hung on what is there already.

Every place is chosen first and the given lengths follow from it, so that each mechanism assembles at its own position;
the sketch tells which assembly that is.
"""

from __future__ import annotations

import cmath
import math
import random
from dataclasses import dataclass, field
from typing import Any

import graphkin
from graphkin.errors import GraphkinError

__all__ = ["DRIVES", "KINDS", "floating_cylinder", "random_scene", "redriven"]

KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP", "pin", "slotted")
DRIVES = ("crank", "resting", "slider", "cylinder", "slot")


@dataclass
class _Builder:
    rng: random.Random
    frame: dict[str, Any] = field(default_factory=lambda: {"name": "0", "points": {}, "guides": {}})
    links: dict[str, dict[str, Any]] = field(default_factory=dict)
    pins: dict[str, dict[str, Any]] = field(default_factory=dict)
    sketch: dict[str, list[float]] = field(default_factory=dict)
    pose: dict[str, tuple[complex, complex]] = field(default_factory=lambda: {"0": (0j, 1 + 0j)})
    where: dict[str, tuple[complex, str]] = field(default_factory=dict)  # point: place, a link that has it
    letters: int = 0
    textbook: bool = False  # round places, and angles as teachers set them

    def place(self, spread: float = 100.0) -> complex:
        if self.textbook:
            steps = int(spread // 20)
            return 20.0 * complex(self.rng.randint(-steps, steps), self.rng.randint(-steps, steps))
        return complex(self.rng.uniform(-spread, spread), self.rng.uniform(-spread, spread))

    def angle(self) -> float:
        if self.textbook:
            return float(self.rng.choice([-135, -120, -90, -60, -45, -30, 0, 0, 30, 45, 60, 90, 90, 120, 150, 180]))
        return self.rng.uniform(-180, 180)

    def letter(self) -> str:
        self.letters += 1
        return f"P{self.letters}"

    def link(self) -> str:
        return str(len(self.links) + 1)

    def bar(self, p: str, z: complex, q: str, w: complex) -> str:
        name = self.link()
        self.links[name] = {"points": [p, q], "length": abs(w - z)}
        self.pose[name] = (z, (w - z) / abs(w - z))
        if self.rng.random() < 0.5:
            extra = self.letter()
            r, angle = self.rng.uniform(20, 60), self.angle()
            self.links[name]["at"] = {extra: {"from": q, "r": r, "angle": angle}}
            self.where[extra] = (w + self.pose[name][1] * cmath.rect(r, math.radians(angle)), name)
        return name

    def old(self, besides: str = "") -> tuple[str, complex, str]:
        """A point that is there already, or a new one of the frame."""
        names = [p for p, (_, link) in self.where.items() if link != besides]
        if not names or self.rng.random() < 0.35:
            p, z = self.letter(), self.place()
            self.frame["points"][p] = [z.real, z.imag]
            self.where[p] = (z, "0")
            return p, z, "0"
        p = self.rng.choice(names)
        return p, *self.where[p]

    def guide(self, link: str, on: complex) -> tuple[str, complex]:
        """A new guide of a link through a place, at any angle; its name and its direction."""
        origin, axis = self.pose[link]
        along = cmath.rect(1.0, math.radians(self.angle()))
        start = on - along * self.rng.uniform(20, 80)
        local, turned = (start - origin) / axis, along / axis
        holder = self.frame if link == "0" else self.links[link]
        guides = holder.setdefault("guides", {})
        name = f"g{len(guides) + 1}"
        guides[name] = {"through": [local.real, local.imag], "angle": math.degrees(cmath.phase(turned))}
        return f"{link}.{name}", along

    def block(self, point: str | None, on: str, along: complex, z: complex) -> str:
        name = self.link()
        turn = self.rng.choice([0.0, 0.0, 35.0, -120.0])
        self.links[name] = {"on": on, "angle_on": turn}
        if point:
            self.links[name]["points"] = [point]
        self.pose[name] = (z, along * cmath.rect(1.0, math.radians(turn)))
        return name

    def any_link(self, *besides: str) -> str:
        return self.rng.choice([name for name in self.pose if name not in besides])

    def add(self, kind: str) -> None:
        getattr(self, "_" + kind.lower())()

    def _rrr(self) -> None:
        p, z, link = self.old()
        q, w, _ = self.old(besides=link)
        r, x = self.letter(), self.place()
        self.bar(p, z, r, x)
        name = self.bar(q, w, r, x)
        self._mark(r, x, name)

    def _rrp(self) -> None:
        p, z, link = self.old()
        r, x = self.letter(), self.place()
        on, along = self.guide(self.any_link(link), x)
        self.bar(p, z, r, x)
        self._mark(r, x, self.block(r, on, along, x))

    def _rpr(self) -> None:
        p, z, link = self.old()
        q, w, _ = self.old(besides=link)
        block, name = self.link(), str(len(self.links) + 2)
        offset = self.rng.choice([0.0, 0.0, self.rng.uniform(-15, 15)])
        # a guide at a distance from the pivot: the bar is turned so that it passes through the pin
        span = z - w
        angle = math.asin(max(-0.9, min(0.9, offset / abs(span))))
        axis = span / abs(span) * cmath.rect(1.0, -angle)
        self.links[block] = {"points": [p], "on": f"{name}.s" if offset else name}
        self.links[name] = {"points": [q]}
        if offset:
            self.links[name]["guides"] = {"s": {"through": [0, abs(span) * math.sin(angle)], "angle": 0}}
        self.pose[block], self.pose[name] = (z, axis), (w, axis)
        end = self.letter()
        self.links[name]["at"] = {end: [-40.0, 10.0]}
        self._mark(end, w + axis * (-40 + 10j), name)

    def _prp(self) -> None:
        one = self.any_link()
        two = self.any_link(one)
        r, x = self.letter(), self.place()
        on1, along1 = self.guide(one, x)
        on2, along2 = self.guide(two, x)
        self.block(r, on1, along1, x)
        self._mark(r, x, self.block(r, on2, along2, x))

    def _rpp(self) -> None:
        p, z, link = self.old()
        other = self.any_link(link)
        y = self.place()
        on, along = self.guide(other, y)
        slider = str(len(self.links) + 2)
        block = self.link()
        self.links[block] = {}
        name = self.block(None, on, along, y)
        assert name == slider
        inner, across = self.guide(slider, z)
        self.links[block] = {"points": [p], "on": inner}
        self.pose[block] = (z, across)

    def _pin(self) -> None:
        """A link held by a hinge, with a pin of it in a slot of another link."""
        p, z, link = self.old()
        r, x = self.letter(), self.place()
        slot, _ = self.guide(self.any_link(link), x)
        name = self.bar(p, z, r, x)
        self.pins[r] = {"of": name, "in": slot}
        self._mark(r, x, name)

    def _slotted(self) -> None:
        """A link held by a hinge, a slot of which takes a pin of a link that is there already."""
        q, w, link = self.old()
        pins = [p for p, (_, holder) in self.where.items() if holder not in ("0", link) and p not in self.pins]
        if not pins:
            return self._pin()
        p = self.rng.choice(pins)
        z, holder = self.where[p]
        name = self.link()
        offset = self.rng.choice([0.0, 0.0, self.rng.uniform(-0.4, 0.4) * abs(z - w)])
        axis = (z - w) / complex(math.sqrt(abs(z - w) ** 2 - offset**2), offset)
        axis /= abs(axis)
        self.links[name] = {"points": [q], "guides": {"s": {"through": [0, offset], "angle": 0}}}
        end = self.letter()
        self.links[name]["at"] = {end: [-40.0, 10.0]}
        self.pose[name] = (w, axis)
        self.pins[p] = {"of": holder, "in": f"{name}.s" if offset else name}
        self._mark(end, w + axis * (-40 + 10j), name)
        return None

    def _mark(self, point: str, z: complex, link: str) -> None:
        self.where[point] = (z, link)
        self.sketch[point] = [z.real, z.imag]


    # drivers: each places its links and says what it does

    def crank(self) -> dict[str, Any]:
        a, z = self.letter(), self.place(40)
        self.frame["points"][a] = [z.real, z.imag]
        self.where[a] = (z, "0")
        angle, length = self.angle(), self.rng.uniform(20, 60)
        crank = self.letter()
        w = z + cmath.rect(length, math.radians(angle))
        self.links["1"] = {"points": [a, crank], "length": length}
        self.pose["1"] = (z, cmath.rect(1.0, math.radians(angle)))
        self.where[crank] = (w, "1")
        return {"link": "1", "angle": angle, "omega": self.rng.uniform(-10, 10), "alpha": self.rng.uniform(-20, 20)}

    def _sliding(self, key: str, travel: float) -> dict[str, Any]:
        rates = {"velocity": self.rng.uniform(-80, 80), "acceleration": self.rng.uniform(-100, 100)}
        return {"slide": key, "travel": travel, **rates}

    def _travel(self, on: str, z: complex) -> float:
        link, _, name = on.partition(".")
        origin, axis = self.pose[link]
        guide = (self.frame if link == "0" else self.links[link])["guides"][name]
        start = origin + axis * complex(*guide["through"])
        return abs(z - start)

    def slider(self) -> dict[str, Any]:
        r, x = self.letter(), self.place()
        on, along = self.guide("0", x)
        name = self.block(r if self.rng.random() < 0.8 else None, on, along, x)
        if "points" in self.links[name]:
            self.where[r] = (x, name)
        else:
            self.links[name]["at"] = {r: [30.0, 10.0]}
            self.where[r] = (x + self.pose[name][1] * (30 + 10j), name)
        return self._sliding(name, self._travel(on, x))

    def cylinder(self) -> dict[str, Any]:
        """An arm about the frame, moved by a cylinder about the frame."""
        (a, z, _), (c, y, _) = self.fixed(), self.fixed()
        b, x = self.letter(), self.place()
        arm = self.bar(a, z, b, x)
        self._mark(b, x, arm)
        rod, name = self.link(), str(len(self.links) + 2)
        axis = (x - y) / abs(x - y)
        self.links[rod] = {"points": [b], "on": name}
        self.links[name] = {"points": [c]}
        self.pose[rod], self.pose[name] = (x, axis), (y, axis)
        return self._sliding(rod, abs(x - y))

    def slot(self) -> dict[str, Any]:
        """An arm about the frame with a driven pin in a slot of the frame: of a link about the frame, cylinder-like."""
        (a, z, _), (c, y, _) = self.fixed(), self.fixed()
        b, x = self.letter(), self.place()
        arm = self.bar(a, z, b, x)
        self._mark(b, x, arm)
        name = self.link()
        self.links[name] = {"points": [c]}
        self.pose[name] = (y, (x - y) / abs(x - y))
        self.pins[b] = {"of": arm, "in": name}
        return self._sliding(f"{b}/{name}", abs(x - y))

    def resting(self) -> dict[str, Any]:
        """A crank that stands, and is about to move or is not, or turns evenly."""
        return self.crank() | self.rng.choice([{"omega": 0.0}, {"omega": 0.0, "alpha": 0.0}, {"alpha": 0.0}])

    def fixed(self) -> tuple[str, complex, str]:
        p, z = self.letter(), self.place()
        self.frame["points"][p] = [z.real, z.imag]
        self.where[p] = (z, "0")
        return p, z, "0"


def random_scene(seed: int, kinds: tuple[str, ...], drive: str = "crank", textbook: bool = False) -> dict[str, Any]:
    """A driver and one dyad of each of the given kinds, as a scene mapping."""
    b = _Builder(random.Random(seed), textbook=textbook)
    driver = getattr(b, drive)()
    for kind in kinds:
        b.add(kind)
    scene = {"title": f"random {seed}", "frame": b.frame, "links": b.links, "driver": driver, "sketch": b.sketch}
    if b.pins:
        scene["pins"] = b.pins
    return scene


def floating_cylinder(seed: int) -> dict[str, Any]:
    """Two links that hang together by a hinge or a slide, a driven cylinder between them, and a rest that is known only
    with both: a rod, a slider or a pin in a slot of the frame."""
    r = random.Random(seed)

    def any_place() -> complex:
        return complex(r.uniform(-100, 100), r.uniform(-100, 100))

    def seen(z: complex, origin: complex, axis: complex) -> list[float]:
        local = (z - origin) / axis
        return [local.real, local.imag]

    a, j, p, q, d = (any_place() for _ in range(5))
    if r.random() < 0.2:
        p = j + abs(q - j) * cmath.rect(1.0, r.uniform(-3, 3))  # arms of equal length
    one = (j - a) / abs(j - a)
    frame: dict[str, Any] = {"points": {"A": [a.real, a.imag]}, "guides": {}}
    links: dict[str, dict[str, Any]] = {
        "1": {"points": ["A", "J"], "length": abs(j - a), "at": {"P": seen(p, a, one)}}
    }
    pins: dict[str, dict[str, Any]] = {}
    sketch = {name: [z.real, z.imag] for name, z in (("P", p), ("Q", q), ("D", d))}
    if r.random() < 0.7:
        links["2"] = {"points": ["J", "D"], "length": abs(d - j), "at": {"Q": seen(q, j, (d - j) / abs(d - j))}}
        sketch["J"] = [j.real, j.imag]
    else:
        along = cmath.rect(1.0, r.uniform(-3, 3))
        angle = math.degrees(cmath.phase(along / one))
        links["1"]["guides"] = {"s": {"through": seen(d - along * r.uniform(-50, 50), a, one), "angle": angle}}
        links["2"] = {"points": ["D"], "on": "1.s", "at": {"Q": seen(q, d, along)}}
    rest = r.choice(["slider", "rod", "slot"])
    if rest == "rod":
        foot = any_place()
        frame["points"]["F"] = [foot.real, foot.imag]
        links["5"] = {"points": ["F", "D"], "length": abs(d - foot)}
    else:
        angle = r.uniform(-180, 180)
        start = d - cmath.rect(r.uniform(-50, 50), math.radians(angle))
        frame["guides"]["h"] = {"through": [start.real, start.imag], "angle": angle}
        if rest == "slider":
            links["5"] = {"points": ["D"], "on": "0.h"}
        else:
            pins["D"] = {"of": "2", "in": "0.h"}
    long = abs(q - p)
    off = r.choice([0.0, 0.0, r.uniform(-0.4, 0.4) * long])
    on = "3.s" if off else "3"
    key = "Q/3" if r.random() < 0.3 else "4"
    if key == "4":
        links["4"] = {"points": ["Q"], "on": on}
    else:
        pins["Q"] = {"of": "2", "in": on}
    links["3"] = {"points": ["P"]}
    if off:
        links["3"]["guides"] = {"s": {"through": [0, off], "angle": 0}}
    travel = r.choice([1, 1, -1]) * math.sqrt(long * long - off * off)
    driver = {"slide": key, "travel": travel, "velocity": r.choice([0, 50, -30]), "acceleration": r.choice([0, 20])}
    scene = {"title": f"cylinder {seed}", "frame": frame, "links": links, "driver": driver, "sketch": sketch}
    return scene | ({"pins": pins} if pins else {})


def redriven(seed: int) -> dict[str, Any]:
    """A random mechanism at its own position, driven elsewhere: between any two links, joined or not, or in any sliding
    pair or slot."""
    rng = random.Random(f"redriven {seed}")
    while True:
        kinds = tuple(rng.choice(KINDS) for _ in range(rng.randint(1, 3)))
        try:
            scene = random_scene(rng.randrange(10**9), kinds, rng.choice([d for d in DRIVES if d != "resting"]))
            position = graphkin.solve(scene).data["positions"][0]
        except (ZeroDivisionError, ValueError, GraphkinError):
            continue
        break
    scene["title"] = f"redriven {seed}"
    scene["sketch"] = {}
    for key, point in position["points"].items():
        name, _, link = key.partition("@")
        own = scene["links"].get(link, {})
        if name not in scene["frame"]["points"] and (name in own.get("points", ()) or name in own.get("at", {})):
            scene["sketch"][name] = point["position"]
    if rng.random() < 0.4 and position["slides"]:
        key = rng.choice(list(position["slides"]))
        rates = {"velocity": rng.uniform(-80, 80), "acceleration": rng.uniform(-100, 100)}
        scene["driver"] = {"slide": key, "travel": position["slides"][key]["travel"], **rates}
        return scene
    angles = {"0": 0.0} | {name: link["angle"] for name, link in position["links"].items()}
    link, other = rng.sample(list(angles), 2)
    if link == "0":
        link, other = other, link
    angle = math.degrees(angles[link] - angles[other])
    scene["driver"] = {"link": link, "angle": angle, "omega": rng.uniform(-5, 5), "alpha": rng.uniform(-9, 9)}
    if other != "0":
        scene["driver"]["relative_to"] = other
    return scene
