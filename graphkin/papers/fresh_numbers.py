"""New numbers for a scene file: the varied numbers and their ranges, rounded as in textbook problems; the rules of the
scene's ``[vary]`` (ranges, ties, constant numbers, questions, level); and numbers that must fit each other: teeth that
mesh, discs that roll, pieces of a cam's law, a driver's law and the asked moment.

A candidate depends on the seed, the number of the variant and the attempt alone, so that a set is the same on every
machine.
"""

from __future__ import annotations

import cmath
import copy
import math
import random
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

from graphkin.errors import CallError, Problem
from graphkin.files import OwnTables, Tables
from graphkin.plane import added_up
from graphkin.scene import mechanism_of
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import PlacedContact, PlacedGear
from graphkin.scene.tables import KeyPath, path_of_key, put_at, value_at
from graphkin.words import Phrase

SHY = 0.12  # part of its reach that a driver keeps off both ends
STEPS = (1.0, 2.0, 5.0)
LEAST_TEETH = 8
EARLY = 0.15  # part of a driver's law at its beginning and at its end that no problem asks for
LEAST_PIECE = 10.0  # degrees of a cam
ALIKE = 1e-6


@dataclass(frozen=True)
class Bounds:
    """The limits of a good problem: the least crossing angle (rad), the greatest error of an answer by pencil (part of
    it), the least transmission and the greatest pressure angle (rad)."""

    crossing: float
    tolerance: float = 0.05
    transmission: float = 0.0
    pressure: float = math.pi / 2


LEVELS = {
    "easy": Bounds(math.radians(35.0)),
    "usual": Bounds(math.radians(20.0)),
    "hard": Bounds(math.radians(12.0)),
}
"""At which angle lines must cross is the transmission angle of a group of bars, and the rest to 90 degrees of the
pressure angle of a slider."""


@dataclass(frozen=True)
class Spread:
    """The variation of the data: lengths, rates and teeth by a part of their size, places by a part of theirs, angles
    over the whole turn, or within the ``reach`` (degrees) of a first driver that cannot turn fully."""

    lengths: float = 0.15
    places: float = 0.08
    rates: float = 0.25
    teeth: float = 0.25
    angle_step: float = 5.0
    reach: tuple[float, float] | None = None

    def narrower(self) -> Spread:
        """A smaller variation, for mechanisms that do not assemble with very different lengths."""
        return replace(self, lengths=0.4 * self.lengths, places=0.4 * self.places)


def drivers_of(source: Tables) -> list[tuple[KeyPath, Tables]]:
    """The drivers of a scene file, each with its path: one table, or several."""
    drivers = source.get("driver", [])
    return [(("driver", i), driver) for i, driver in enumerate(drivers)] if isinstance(drivers, list) else [
        (("driver",), drivers)
    ]


_DRIVER = {"angle": "angle", "travel": "travel", "omega": "rate", "rpm": "rate", "velocity": "rate"}
_BY_LAW = {"law.duration": "rate", "law.to": "length", "time": "moment"}
_ROUND = {"r": "length"}
_VARIED: tuple[tuple[str, Mapping[str, str]], ...] = (
    ("links.*", {"length": "length"}), ("frame.points.*", {**_ROUND, "0": "place", "1": "place"}),
    ("frame.guides.*", {"through.*": "place"}), ("cams.*", {"base.r": "length"}),
    ("driver", _DRIVER), ("driver.*", _DRIVER),
    ("frame.discs.*", _ROUND), ("links.*.discs.*", _ROUND), ("gears.*", {"teeth.*": "teeth"}),
    ("cams.*", {"law.*.to": "end", "law.*.rise": "length", "roller": "length"}),
    ("driver", _BY_LAW), ("driver.*", _BY_LAW),
)
"""The varied numbers: in which tables, and under which keys of these, with their kinds."""


def varied_keys(source: Tables) -> tuple[tuple[KeyPath, str], ...]:
    """The numbers of a scene file that variants change, with their kinds: "length", "place", "angle", "rate",
    "travel", "teeth", the "end" of a piece of a cam's law, the "moment" of a driver's.

    Zeros stay zero, and so do accelerations and the directions of guides.  Falls of cams follow the rises, lengths of
    carriers their wheels.
    """
    return tuple(
        (path, kind)
        for where, numbers in _VARIED
        for table in _matching(source, where)
        for key, kind in numbers.items()
        for path in _matching(value_at(source, table), key, table)
        if _is_free(source, path, kind)
    )


def _matching(place: Any, pattern: str, path: KeyPath = ()) -> Iterator[KeyPath]:
    """The paths of a pattern of keys with dots in a part of a file, which lies at ``path``; * stands for every key of a
    table, or every item of a list."""
    step, _, rest = pattern.partition(".")
    keys: Iterable[str | int] = ()
    if isinstance(place, Mapping):
        keys = place
    elif isinstance(place, list | tuple):
        keys = range(len(place))
    for key in keys:
        if step in ("*", str(key)):
            yield from _matching(place[key], rest, (*path, key)) if rest else ((*path, key),)


def _is_free(source: Tables, path: KeyPath, kind: str) -> bool:
    """Whether a number is varied: it is not 0, and neither of a rack, nor the end of a whole law, nor the moment of a
    law of several pieces."""
    value, beside = value_at(source, path), value_at(source, path[:-1])
    if not isinstance(value, int | float) or not (value or kind == "angle"):
        return False
    if kind == "end":
        return path[-2] != len(value_at(source, path[:-2])) - 1
    return "rack" not in beside and (kind != "moment" or bool(value_at(beside, ("law", "duration"))))


def _radii_of_discs(source: Tables) -> Iterator[KeyPath]:
    """The radii of all discs, those of the frame first."""
    return (path for of in ("frame", "links.*") for path in _matching(source, f"{of}.discs.*.r"))


def candidate(source: Tables, spread: Spread, seed: int, number: int, attempt: int) -> OwnTables:
    """A candidate for a variant: every varied number newly drawn and rounded, not examined yet."""
    dice = random.Random(f"{seed}/{number}/{attempt}")
    made = copy.deepcopy(dict(source))
    rules = _vary(source)
    ratios = [key for keys in rules.get("ratios", ()) for key in keys[1:]]
    tied = set(_paths(source, (*rules.get("ranges", {}), *ratios, *rules.get("keep", ()))))
    free = [] if rules.get("only") else [(path, kind) for path, kind in varied_keys(source) if path not in tied]
    for path, kind in free:
        limited = spread.reach if path in (("driver", "angle"), ("driver", 0, "angle")) else None
        value = float(value_at(source, path))
        put_at(made, path, _drawn(dice, value, kind, spread) if limited is None else _within(dice, limited, spread))
    _draw_ruled(source, made, dice, {"angle": spread.angle_step})
    _fit(source, made, lambda path: path not in tied)
    # what other numbers say is not said twice: where a driven link begins to roll, and a cam's offset
    for cam in made.get("cams", {}).values():
        cam.pop("offset", None)
    for _, driver in drivers_of(made):
        made["links"].get(driver.get("link"), {}).pop("start", None)
    pool = list(rules.get("find", ()))
    taken = set(dice.sample(range(len(pool)), min(rules.get("ask") or len(pool), len(pool))))
    asked = [symbol for i, symbol in enumerate(pool) if i in taken]
    return {**made, "find": asked} if asked else made


def _drawn(dice: random.Random, value: float, kind: str, spread: Spread) -> float:
    if kind == "angle":
        turn = round(360.0 / spread.angle_step)
        angle = spread.angle_step * dice.randrange(turn)
        return angle if angle <= 180.0 else angle - 360.0
    if kind == "teeth":
        few, many = (round(abs(value) * (1 + sign * spread.teeth)) for sign in (-1, 1))
        return int(math.copysign(dice.randint(few, many), value))
    if kind == "end":
        return value + spread.angle_step * dice.randint(-3, 3)
    part = {"length": spread.lengths, "travel": spread.lengths, "place": spread.places, "rate": spread.rates,
            "moment": spread.rates}[kind]
    step = round_step(value) * (5.0 if kind == "rate" else 1.0)
    low, high = math.ceil(abs(value) * (1 - part) / step), math.floor(abs(value) * (1 + part) / step)
    steps = dice.randint(low, high) if low <= high else max(1, round(abs(value) / step))
    return math.copysign(float(f"{steps * step:.12g}"), value)


def _within(dice: random.Random, reach: tuple[float, float], spread: Spread) -> float:
    """An angle well inside the reach of a driver, since other lengths move its ends."""
    low, high = reach
    margin = SHY * (high - low)
    step = min(spread.angle_step, round_step((high - low) * 10.0))
    first, last = math.ceil((low + margin) / step), math.floor((high - margin) / step)
    return float(f"{step * dice.randint(first, max(first, last)):.12g}")


def _fit(source: Tables, made: OwnTables, free: Callable[[KeyPath], bool]) -> None:
    """Make the numbers of a candidate fit each other; numbers that cannot fit get their old values.

    Parameters
    ----------
    free : whether a number may follow others
    """
    for name, cam in made.get("cams", {}).items():
        _cam(source["cams"][name], cam)
    for path, driver in drivers_of(made):
        if driver.get("law", {}).get("duration"):
            _set_moment(value_at(made, path), driver["law"])
    rolling = any(contact.get("rolling") for contact in made.get("contacts", {}).values())
    for name, link in made.get("links", {}).items():  # a bar's end stays on the rim of a disc
        was, points = source["links"][name], link.get("points", ())
        for key, disc in link.get("discs", {}).items():
            if disc.get("centre") in points and len(points) == 2 and was.get("length") == was["discs"][key].get("r"):
                disc["r"] = link["length"]
    if made.get("gears") or rolling:
        scene = mechanism_of(source)
        if not _teeth(scene, made, free):
            for name, gear in made.get("gears", {}).items():
                gear["teeth"] = list(source["gears"][name]["teeth"])
        if not _radii(scene, made, free):
            for path in _radii_of_discs(source):
                put_at(made, path, value_at(source, path))


def _cam(was: Tables, cam: OwnTables) -> None:
    """Make the pieces of a cam's law follow each other and return to their beginning."""
    law, old = cam["law"], was["law"]
    ends = [0.0, *(float(piece["to"]) for piece in law)]
    if any(b - a < LEAST_PIECE for a, b in pairwise(ends)):
        for piece, before in zip(law, old, strict=True):
            piece["to"] = before["to"]
    up, down = (added_up(piece.get(key) or 0.0 for piece in law) for key in ("rise", "fall"))
    falls = [piece for piece in law if piece.get("fall")]
    for piece in falls:
        piece["fall"] = float(f"{piece['fall'] * up / down:.9g}")
    if falls:
        falls[-1]["fall"] = float(f"{up - added_up(piece['fall'] for piece in falls[:-1]):.12g}")


def _set_moment(driver: OwnTables, law: Tables) -> None:
    """Set a moment, or an angle, well inside the range of a law."""
    if driver.get("time"):
        within = min(max(driver["time"] / law["duration"], EARLY), 1.0 - EARLY)
        driver["time"] = float(f"{within * law['duration']:.3g}")
    elif driver.get("angle") is not None and law.get("to") is not None:
        begin, end = law.get("from", 0.0), law["to"]
        within = EARLY + (1.0 - 2.0 * EARLY) * (driver["angle"] % 360.0) / 360.0
        driver["angle"] = float(round(begin + within * (end - begin)))


def _axle_key(made: Tables, carrier: str, axes: tuple[str, ...]) -> KeyPath | None:
    """The key of the distance of two axes, the length of their carrier."""
    link = made.get("links", {}).get(carrier, {})
    return ("links", carrier, "length") if set(link.get("points", ())) == set(axes) and "length" in link else None


def _teeth(scene: Mechanism, made: OwnTables, free: Callable[[KeyPath], bool]) -> bool:
    """Fit wheels that mesh with several others, so that each keeps one pitch circle: of wheels about the same two axes
    the last number of teeth follows, else the distance of the axes.  False where neither can."""
    meshes: list[tuple[PlacedGear, list[int]]] = []
    modules: dict[tuple[str, int], float] = {}  # distance of the axes for a tooth, by link and teeth before
    numbers = {  # those that somebody has ranged or kept hold for the whole wheel
        (link, abs(int(z or 0))): abs(int(made["gears"][gear.name]["teeth"][i]))
        for gear in scene.gears if not gear.is_rack
        for i, (link, z) in enumerate(zip(gear.bodies, gear.teeth, strict=True))
        if not free(("gears", gear.name, "teeth", i))
    }
    for gear in scene.gears:
        if gear.is_rack:
            continue
        old = [int(z or 0) for z in gear.teeth]
        wheels = [(link, abs(z)) for link, z in zip(gear.bodies, old, strict=True)]  # one has one number of teeth
        drawn = [int(z) for z in made["gears"][gear.name]["teeth"]]
        teeth = [int(math.copysign(numbers.get(w, abs(z)), z)) for w, z in zip(wheels, drawn, strict=True)]
        here = _axle_key(made, gear.carrier, gear.axes)
        known = next((i for i, wheel in enumerate(wheels) if wheel in modules), None)
        if known is not None:
            twin = next((t for g, t in meshes if g.carrier == gear.carrier and set(g.axes) == set(gear.axes)), None)
            if twin is not None:
                teeth[1 - known] = int(math.copysign(sum(twin), sum(old))) - teeth[known]
            elif here is not None and free(here):
                made["links"][gear.carrier]["length"] = float(f"{modules[wheels[known]] * abs(sum(teeth)):.6g}")
            elif teeth != old:
                return False
        if any(abs(t) < LEAST_TEETH or t * z < 0 for t, z in zip(teeth, old, strict=True)) or not sum(teeth):
            return False
        if (sum(teeth) > 0) != (sum(old) > 0):
            return False
        length = made["links"][gear.carrier]["length"] if here is not None else 1.0
        for wheel, z in zip(wheels, teeth, strict=True):
            modules.setdefault(wheel, length / abs(sum(teeth)))
            numbers.setdefault(wheel, abs(z))
        meshes.append((gear, teeth))
        made["gears"][gear.name]["teeth"] = teeth
    return True


def _radii(scene: Mechanism, made: OwnTables, free: Callable[[KeyPath], bool]) -> bool:
    """Fit the distances of discs that roll on each other to their radii.  False where they cannot fit."""
    for contact in scene.contacts:
        if not contact.rolling:
            continue
        if contact.flat:
            if not _on_its_face(made, contact):
                return False
            continue
        radii = [_disc(made, ref) for ref in made["contacts"][contact.name]["between"]]
        signs = [math.copysign(1.0, radius) for radius in contact.radii]
        here = _axle_key(made, contact.carrier, contact.centres)
        if here is None or not free(here):
            return False
        total = added_up(sign * abs(r) for sign, r in zip(signs, radii, strict=True))
        if abs(total) <= ALIKE * max(map(abs, radii)):
            return False
        made["links"][contact.carrier]["length"] = float(f"{abs(total):.12g}")
    return True


def _on_its_face(made: OwnTables, contact: PlacedContact) -> bool:
    """Move the drawn centre of a disc that rolls on a face of the frame to a radius from it.  False where it cannot."""
    (centre,) = contact.centres
    drawn = made.get("drawn", {}).get(centre)
    if drawn is None:
        return True
    refs = made["contacts"][contact.name]["between"]
    wheel, face = (refs if contact.face == contact.bodies[1] else refs[::-1])
    frame = made.get("frame", {})
    guide = frame.get("guides", {}).get(face.partition(".")[2])
    if guide is None or face.partition(".")[0] != str(frame.get("name", "0")) or not isinstance(guide["through"], list):
        return False
    normal = cmath.rect(1.0 if contact.left else -1.0, math.radians(guide["angle"]) + math.pi / 2)
    through = complex(*guide["through"])
    distance = ((complex(*drawn) - through) * normal.conjugate()).real
    place = complex(*drawn) + normal * (abs(_disc(made, wheel)) - distance)
    made["drawn"][centre] = [float(f"{part:.12g}") for part in (place.real, place.imag)]
    return True


def _disc(made: Tables, ref: str) -> float:
    link, _, name = ref.partition(".")
    return float(made["links"].get(link, made.get("frame", {}))["discs"][name]["r"])


# what [vary] says


def level_of(source: Tables) -> Bounds:
    """The bounds that a scene asks for: those of its level, with its own changes."""
    table = _vary(source)
    keys = ("crossing", "transmission", "pressure", "tolerance")
    levels = {key: table[key] for key in keys if table.get(key) is not None}
    bounds = {key: value if key == "tolerance" else math.radians(value) for key, value in levels.items()}
    return replace(LEVELS[table.get("level", "usual")], **bounds)


def _vary(source: Tables) -> Tables:
    table = source.get("vary") or {}
    return table if isinstance(table, Mapping) else {}


def _path_of_number(source: Tables, key: str) -> KeyPath | None:
    """The place of a number by its key: ``links.2.length``, ``frame.points.D.x``, ``driver.2.angle``; else None."""
    path = path_of_key(source, key)
    value = None if path is None else value_at(source, path)
    return None if isinstance(value, bool) or not isinstance(value, int | float) else path


def rules_checked(source: Tables) -> None:
    """Raise CallError with every key of ``[vary]`` that is no number of the scene, and every wrong range."""
    table = _vary(source)
    keys = [(f"vary.ranges.{k}", k) for k in table.get("ranges", {})]
    keys += [("vary.keep", k) for k in table.get("keep", ())]
    keys += [("vary.ratios", k) for keys in table.get("ratios", ()) for k in keys]
    wanted = Phrase("write a key such as links.2.length or driver.angle")
    problems = [
        Problem(where, Phrase("is no number of the scene", key=key), wanted)
        for where, key in keys if _path_of_number(source, key) is None
    ]
    for key, (low, high) in table.get("ranges", {}).items():
        if low > high:
            problems.append(Problem(f"vary.ranges.{key}", "from to", "give the smaller value first", least=f"{low:g}",
                                    greatest=f"{high:g}"))
    asked, most = table.get("ask"), len(table.get("find", ()))
    if asked is not None and asked > most:
        problems.append(Problem("vary.ask", "of quantities", "list more of them in vary.find", asked=asked, most=most))
    if problems:
        raise CallError(*problems)


def _paths(source: Tables, keys: Iterable[str]) -> list[KeyPath]:
    """The places of existing numbers (see `rules_checked`)."""
    return [path for key in keys if (path := _path_of_number(source, key)) is not None]


def _draw_ruled(source: Tables, made: OwnTables, dice: random.Random, step_of: Mapping[str, float]) -> None:
    """Draw the numbers with a range, compute the tied ones; ``step_of`` gives the steps of angles by the last key."""
    table = _vary(source)
    ranges = table.get("ranges", {})
    for path, (low, high) in zip(_paths(source, ranges), ranges.values(), strict=True):
        whole = "teeth" in path
        step = 1.0 if whole else step_of.get(str(path[-1]), round_step(max(abs(low), abs(high), 1e-9)))
        if high - low < 2 * step and not whole:
            step = round_step(max(high - low, 1e-9)) * 10
        first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
        value = dice.randint(first, last) * step if first <= last else low
        value = min(max(value, low), high)
        put_at(made, path, round(value) if whole else float(f"{value:.12g}"))
    for keys in table.get("ratios", ()):
        lead, *others = _paths(source, keys)
        factor = value_at(made, lead) / value_at(source, lead) if value_at(source, lead) else 1.0
        for other in others:
            put_at(made, other, float(f"{value_at(source, other) * factor:.9g}"))


def round_step(value: float) -> float:
    """The step of the 1-2-5 series of about a sixtieth of a value, so that its multiples look round.

    >>> round_step(580), round_step(90), round_step(0.34)
    (5.0, 1.0, 0.005)
    """
    least = abs(value) / 60.0
    decade = 10.0 ** math.floor(math.log10(least))
    return max(s * decade for s in STEPS if s * decade <= least * (1 + 1e-9))
