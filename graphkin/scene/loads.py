"""What a mechanism weighs and carries: masses, loads, springs, gravity, balance and flywheel, resolved, in SI units."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from graphkin.errors import Problem, did_you_mean
from graphkin.plane import direction
from graphkin.scene.load_tables import STANDARD_GRAVITY, Load, LoadPhase, Spring
from graphkin.scene.names import Names
from graphkin.scene.tables import SceneTables
from graphkin.words import Phrase, Wording

__all__ = ["BalanceAt", "LinkMass", "LoadOn", "Loading", "Phase", "PlacedFlywheel", "SpringOn", "loading_of"]


TURN = math.tau * (1 + 1e-12)


@dataclass(frozen=True)
class LinkMass:
    """Mass (kg) and inertia (kg m2) of a link about its centre of mass, which lies ``at`` in its own axes (m)."""

    link: str
    at: complex
    mass: float
    inertia: float


@dataclass(frozen=True)
class Phase:
    """When a load acts: while the pair ``stroke`` slides in a ``sense`` along its guide, between two parts of its
    stroke, counted from where that stroke begins; or, without ``stroke``, while the first driver's value grows from
    ``start`` to ``end`` (rad, m; of an angle at most a turn)."""

    stroke: str
    sense: int
    start: float
    end: float


@dataclass(frozen=True)
class LoadOn:
    """A force (N) on a link at a place of its own axes (m), or a moment (N m; ``size`` of both, ``is_force`` tells).

    ``turn`` is its direction, in the frame or from the axis of link ``follows``; with ``against`` it lies along the
    guide of that sliding pair, opposite to its sliding velocity.
    """

    name: str
    link: str
    size: float
    is_force: bool
    at: complex = 0j
    turn: complex = 1 + 0j
    follows: str = ""
    against: str = ""
    phase: Phase | None = None


@dataclass(frozen=True)
class SpringOn:
    """A spring between points of two links, which lie ``at`` in their own axes (m).

    It pulls them together with preload + rate * (length - free) (N, N/m, m); ``P_name`` is its force on the first
    link, the opposite acts on the second.
    """

    name: str
    points: tuple[str, str]
    links: tuple[str, str]
    at: tuple[complex, complex]
    rate: float
    free: float
    preload: float = 0.0

    @property
    def ends(self) -> tuple[tuple[str, complex], tuple[str, complex]]:
        """Link and place of either end."""
        return (self.links[0], self.at[0]), (self.links[1], self.at[1])


@dataclass(frozen=True)
class BalanceAt:
    """What is unknown besides the joint forces: a moment on a link, or a force at a place of it along a line, whose
    direction ``turn`` stands in the frame or, ``square``, is square to the link's own axis."""

    link: str
    kind: Literal["moment", "force"]
    at: complex = 0j
    turn: complex = 1 + 0j
    square: bool = False


@dataclass(frozen=True)
class PlacedFlywheel:
    """A flywheel on a link for a coefficient of speed fluctuation ``delta``."""

    link: str
    delta: float


@dataclass(frozen=True)
class Loading:
    """Everything that makes forces; ``gravity`` is 0 where weights do not pull (m/s2)."""

    gravity: complex = 0j
    masses: tuple[LinkMass, ...] = ()
    loads: tuple[LoadOn, ...] = ()
    balance: BalanceAt | None = None
    flywheel: PlacedFlywheel | None = None
    springs: tuple[SpringOn, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.masses or self.loads or self.springs)


def loading_of(
    file: SceneTables, names: Names, places: Mapping[str, Mapping[str, complex]], pairs: tuple[str, ...],
    problems: list[Problem],
) -> Loading:  # fmt: skip
    """What the file says of forces; what is wrong is added to ``problems``.

    Parameters
    ----------
    places : points of each link in its own axes (m)
    pairs : keys of the sliding pairs and pins in slots
    """
    reading = _LoadReading(file, names, places, pairs, problems)
    g = file.gravity.g if file.gravity else STANDARD_GRAVITY
    down = g * direction(file.gravity.angle) if file.gravity else 0j
    masses = tuple(found for name in file.masses if (found := reading.mass(name, g)) is not None)
    loads = tuple(one for name, load in file.loads.items() if (one := reading.load(name, load)) is not None)
    springs = tuple(spring for name, each in file.springs.items() if (spring := reading.spring(name, each)) is not None)
    balance, flywheel = reading.balance(), None
    if file.flywheel is not None and not reading.not_moving("flywheel.on", file.flywheel.on):
        flywheel = PlacedFlywheel(file.flywheel.on, file.flywheel.delta)
        if file.flywheel.delta >= 2.0:
            reading.say(
                "flywheel.delta",
                Phrase("found value", value=f"{file.flywheel.delta:g}"),
                Phrase("a part of the mean speed below 2"),
            )
    if (balance or flywheel) and not (file.masses or file.loads or file.springs):
        where = "balance" if balance else "flywheel"
        wanted = Phrase("give masses.link loads.name or springs.name")
        problems.append(Problem(where, Phrase("there is nothing to balance"), wanted))
    return Loading(down, masses, loads, balance, flywheel, springs)


@dataclass(frozen=True)
class _LoadReading:
    """What the loads of a file are read from, and the problems found on the way."""

    file: SceneTables
    names: Names
    places: Mapping[str, Mapping[str, complex]]
    pairs: tuple[str, ...]
    problems: list[Problem]

    def say(self, where: str, found: Wording, wanted: Wording) -> None:
        self.problems.append(Problem(where, found, wanted))

    def not_moving(self, where: str, link: str) -> bool:
        """Whether this is no moving link, which is told."""
        missing = self.names.no_link(where, link)
        if missing:
            self.problems.append(missing)
        elif link == self.names.frame:
            self.say(where, Phrase("link is the frame", name=link), Phrase("what acts on the fixed link moves nothing"))
        elif link in self.file.links and self.file.links[link].redundant:
            self.say(where, Phrase("link is redundant", what=link), Phrase("its share of the forces is not determined"))
        else:
            return False
        return True

    def place(self, where: str, link: str, at: str | Sequence[float]) -> complex:
        """A point of a link by name or place, in the link's own axes (m)."""
        if not isinstance(at, str):
            return complex(*at) * self.file.units.metres
        missing = self.names.no_point_of(where, link, at)
        if missing:
            self.problems.append(missing)
        return self.places.get(link, {}).get(at, 0j)

    def pair(self, where: str, ref: str) -> str:
        """The key of a sliding pair, "6" standing for the one pair of link 6."""
        near = [key for key in self.pairs if ref in (key, key.split("/")[0])]
        if len(near) == 1:
            return near[0]
        found = Phrase("is no sliding pair", ref=ref) if not near else Phrase("may be", ref=ref, name=" or ".join(near))
        self.say(where, found, did_you_mean(ref, self.pairs))
        return ""

    def mass(self, link: str, g: float) -> LinkMass | None:
        table, where, units = self.file.masses[link], f"masses.{link}", self.file.units
        if self.not_moving(where, link):
            return None
        if (table.mass is None) == (table.weight is None):
            found = Phrase("has neither mass nor weight") if table.mass is None else Phrase("has both mass and weight")
            self.say(where, found, Phrase("give one of them"))
            return None
        heavy = (table.mass or 0.0) * units.kilograms if table.weight is None else table.weight * units.newtons / g
        return LinkMass(link, self.place(f"{where}.at", link, table.at), heavy, table.inertia * units.inertias)

    def load(self, name: str, load: Load) -> LoadOn | None:
        where, units = f"loads.{name}", self.file.units
        if self.not_moving(f"{where}.on", load.on):
            return None
        if (load.force is None) == (load.moment is None):
            found = (
                Phrase("has neither force nor moment") if load.force is None else Phrase("has both force and moment")
            )
            self.say(where, found, Phrase("give one of them"))
            return None
        phase = self.phase(f"{where}.when", load.when) if load.when is not None else None
        if load.moment is not None:
            for key in ("at", "angle", "follows", "against"):
                if getattr(load, key) is not None:
                    self.say(
                        f"{where}.{key}",
                        Phrase("stands beside moment"),
                        Phrase("a moment has neither place nor direction"),
                    )
            return LoadOn(name, load.on, load.moment * units.newtons, False, phase=phase)
        at = 0j
        if load.at is None:
            self.say(f"{where}.at", Phrase("is missing"), Phrase("a point of the link or x y"))
        else:
            at = self.place(f"{where}.at", load.on, load.at)
        turn = direction(load.angle) if load.angle is not None else 1 + 0j
        follows, against = "", ""
        if load.against is not None:
            against = self.pair(f"{where}.against", load.against)
            if load.angle is not None or load.follows is not None:
                self.say(
                    f"{where}.against", Phrase("stands beside angle or follows"), Phrase("a force has one direction")
                )
        elif load.follows is not None:
            missing = self.names.no_link(f"{where}.follows", load.follows)
            self.problems.extend([missing] if missing else [])
            follows = load.follows
        elif load.angle is None:
            self.say(f"{where}.angle", Phrase("is missing"), Phrase("write angle follows or against a force has"))
        return LoadOn(name, load.on, (load.force or 0.0) * units.newtons, True, at, turn, follows, against, phase)

    def spring(self, name: str, table: Spring) -> SpringOn | None:
        where, units, known = f"springs.{name}", self.file.units, len(self.problems)
        if name in self.file.loads:
            self.say(
                where, Phrase("a load is called too", name=name), Phrase("another name both would be p_", name=name)
            )
        if len(table.between) != 2 or table.between[0] == table.between[1]:
            self.say(
                f"{where}.between",
                Phrase("found value", value=", ".join(table.between) or "nothing"),
                Phrase("two different points"),
            )
        elif table.links is not None and len(table.links) != 2:
            self.say(
                f"{where}.links",
                Phrase("found value", value=", ".join(table.links) or "nothing"),
                Phrase("two links one for each point"),
            )
        if len(self.problems) > known:
            return None
        ends = [self.end(where, point, table.links[k] if table.links else "") for k, point in enumerate(table.between)]
        if len(self.problems) > known or "" in ends:
            return None
        if ends[0] == ends[1]:
            found = Phrase("both ends are on link", ends=ends[0])
            self.say(where, found, Phrase("two links where several have a point write"))
            return None
        (a, b), (p, q) = ends, table.between
        at = self.places.get(a, {}).get(p, 0j), self.places.get(b, {}).get(q, 0j)
        rate, free = table.rate * units.newtons / units.metres, table.free * units.metres
        return SpringOn(name, (p, q), (a, b), at, rate, free, table.preload * units.newtons)

    def end(self, where: str, point: str, link: str) -> str:
        """The link that an end of a spring is on: as it is said, or the first that has the point, the frame if it
        does."""
        if not link:
            missing = self.names.no_point(f"{where}.between", point)
            self.problems.extend([missing] if missing else [])
            order = [self.names.frame, *(n for n in self.file.links if not self.file.links[n].redundant)]
            having = [n for n in order if point in self.places.get(n, {})]
            if not having and not missing:
                self.say(
                    f"{where}.between",
                    Phrase("is placed on no link", point=point),
                    Phrase("a point of a link or the frame"),
                )
            return having[0] if having else ""
        if link != self.names.frame and self.not_moving(f"{where}.links", link):
            return ""
        missing = self.names.no_point_of(f"{where}.links", link, point)
        self.problems.extend([missing] if missing else [])
        return link

    def phase(self, where: str, when: LoadPhase) -> Phase | None:
        if (when.stroke is None) == (when.driver is None):
            self.say(
                where,
                Phrase("has neither stroke nor driver")
                if when.stroke is None
                else Phrase("has both stroke and driver"),
                Phrase("give one of them"),
            )
            return None
        if when.stroke is not None:
            if not when.start < when.end <= 1.0:
                self.say(
                    where,
                    Phrase("from to", least=f"{when.start:g}", greatest=f"{when.end:g}"),
                    Phrase("parts of the stroke grow from 0 to"),
                )
            if when.sense not in (1, -1):
                self.say(
                    f"{where}.sense",
                    Phrase("found value", value=f"{when.sense:g}"),
                    Phrase("1 along the guide's sense 1 against it"),
                )
            return Phase(self.pair(f"{where}.stroke", when.stroke), int(when.sense), when.start, when.end)
        assert when.driver is not None
        for key, said in (("sense", when.sense != 1.0), ("from", when.start != 0.0), ("to", when.end != 1.0)):
            if said:
                self.say(f"{where}.{key}", Phrase("stands beside driver"), Phrase("it is of a stroke the driver's two"))
        drivers = self.file.drivers
        slides = bool(drivers) and hasattr(drivers[0], "slide")
        scale = self.file.units.metres if slides else math.pi / 180
        start, end = (value * scale for value in when.driver)
        if slides and start >= end:
            found = Phrase("found of bounds and fast", bounds=f'{when.driver[0]:g}', fast=f'{when.driver[1]:g}')
            self.say(f"{where}.driver", found, Phrase("the travel grows between them"))
        elif not slides and not 0.0 < (span := end - start if end >= start else end - start + math.tau) <= TURN:
            found = Phrase("found of bounds and fast", bounds=f'{when.driver[0]:g}', fast=f'{when.driver[1]:g}')
            wanted = Phrase("two different values") if span <= 0.0 else Phrase("at most a turn lies between them")
            self.say(f"{where}.driver", found, Phrase("a load that acts always has no when", wanted=wanted))
        return Phase("", 1, start, end if slides or end >= start else end + 2 * math.pi)

    def balance(self) -> BalanceAt | None:
        table = self.file.balance
        if table is None or self.not_moving("balance.on", table.on):
            return None
        if len(self.file.drivers) > 1:
            self.say(
                "balance",
                Phrase("one balance cannot stand for several drivers"),
                Phrase("leave it out each driver has its own"),
            )
        if table.at is None:
            if table.angle is not None:
                self.say("balance.angle", Phrase("stands without at"), Phrase("a force has a place a moment has"))
            return BalanceAt(table.on, "moment")
        at = self.place("balance.at", table.on, table.at)
        if table.angle is None:
            self.say("balance.angle", Phrase("is missing"), Phrase("degrees in the frame or square to the"))
        square = table.angle == "square"
        turn = 1 + 0j if square or not isinstance(table.angle, int | float) else direction(table.angle)
        return BalanceAt(table.on, "force", at, turn, square)
