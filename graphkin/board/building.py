"""Changes of a scene by hand: a mechanism built piece by piece (pivots, bars, sliders, pins in slots), and a point
pulled to another place.

Every point that moves gets its place in ``[sketch]``, which picks the assembly once the mechanism is whole; lengths
are those of the sketch.  A pulled point of the frame moves; a pulled point of the driven link turns the link; any other
pulled point changes the lengths and places of its links, so that it comes to the place while all others stay.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Mapping

from graphkin.board.scene_text import changed, frame_in, names_in, points_in, table_in
from graphkin.errors import CallError, did_you_mean
from graphkin.files import OwnTables, Tables
from graphkin.plane import cross, degrees, direction, dot
from graphkin.scene.model import Driver, Mechanism
from graphkin.scene.scene import parsed
from graphkin.scene.scene_tables import LARGEST
from graphkin.scene.tables import xy
from graphkin.solver import Motion
from graphkin.words import Phrase

EMPTY = 'title = "New mechanism"\n\n[units]\nlength = "mm"\n\n[frame]\nname = "0"\n'
_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"

Step = Tables
"""What is to be built, as the page asks for it: `what`, and the names and places that it needs."""


def built(text: str, step: Step) -> str:
    """The text of a scene with a piece added or removed.

    Parameters
    ----------
    step : ``what`` is one of `STEPS`, the other entries are its arguments: places are ``[x, y]`` in scene units, points
        and links are named.  A bar or a block may begin at a place instead of a point: the point is made.  ``places``
        gives points to which the text gives no place.

    Raises
    ------
    SceneError : the text is no TOML; CallError : a piece that cannot be made
    """
    piece = str(step.get("what", ""))
    if piece not in STEPS:
        raise CallError.of("piece", f'"{piece[:60]}"', did_you_mean(piece[:60], STEPS))
    text = text if text.strip() else EMPTY
    made = parsed(text)
    seen = {p: z for p, z in table_in(step, "places").items() if _place(z) and p in points_in(made)}
    changes = STEPS[piece]({**made, "seen": seen}, step)
    return changed(text, changes) if changes else text


def draft(made: Tables) -> OwnTables:
    """What can be shown of a mapping before it is a mechanism: places of points (scene units), points of links."""
    _, fixed = frame_in(made)
    spots = {**table_in(made, "sketch"), **table_in(made, "drawn"), **table_in(made, "seen"), **fixed}
    points = {str(p): list(z) for p, z in spots.items() if _place(z)}
    for name, z in fixed.items():
        if isinstance(z, Mapping) and str(z.get("from")) in points and _place([z.get("r"), z.get("angle", 0.0)]):
            start, ahead = points[str(z["from"])], z.get("toward")
            axis = 1.0 if ahead is None else complex(*points.get(str(ahead), start)) - complex(*start)
            if axis:
                points[name] = xy(complex(*start) + z["r"] * axis / abs(axis) * direction(z.get("angle", 0.0)))
    links = {}
    for name, link in table_in(made, "links").items():
        if isinstance(link, Mapping):
            ends = [p for p in (*names_in(link.get("points")), *table_in(link, "at")) if p in points]
            links[str(name)] = {"points": ends, "block": "on" in link and len(ends) < 2}
    guides = []
    for guide in table_in(table_in(made, "frame"), "guides").values():
        through = guide.get("through") if isinstance(guide, Mapping) else None
        through = points.get(through) if isinstance(through, str) else through
        if _place(through):
            turn = guide.get("angle")
            guides.append({"through": through, "angle": turn if _number_of_scene(turn) else 0.0})
    return {"points": points, "fixed": [p for p in fixed if p in points], "links": links, "guides": guides}


def _place(value: object) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(map(_number_of_scene, value))


def _number_of_scene(value: object) -> bool:
    return isinstance(value, int | float) and abs(value) <= LARGEST


def _free_letter(made: Tables, changes: Iterable[str] = ()) -> str:
    """The name of the next point, which is neither in the text nor in changes of its sketch."""
    used = points_in(made)
    names: list[str] = [*_LETTERS, *(f"{c}{n}" for n in range(1, 100) for c in _LETTERS)]
    return next(name for name in names if name not in used and f"sketch.{name}" not in changes)


def _next_link(made: Tables) -> str:
    """The number of the next link."""
    taken = {*table_in(made, "links"), frame_in(made)[0]}
    return next(str(n) for n in range(1, 10_000) if str(n) not in taken)


def _at(step: Step, key: str) -> list[float]:
    value = step.get(key)
    if not isinstance(value, list) or not _place(value):
        raise CallError.of(key, "found value", "give a place x y or the name", value=f"{value!r:.60}")
    return [_round(x) for x in value]


def _number(step: Step, key: str, usual: float) -> float:
    value = step.get(key, usual)
    if not isinstance(value, int | float) or not math.isfinite(value):
        needed = "give degrees" if key == "angle" else "give a finite number below 1e9"
        raise CallError.of(key, "found value", needed, value=f"{value!r:.60}")
    return float(value)


def _round(value: float) -> float:
    return float(f"{value:.6g}") + 0.0


def _end(made: Tables, step: Step, key: str, before: OwnTables | None = None) -> tuple[str, list[float], OwnTables]:
    """A point of the mechanism, or a new one at a place, beside those of changes before, with its sketch."""
    value = step.get(key)
    if isinstance(value, str):
        spots = draft(made)["points"]
        if value not in spots:
            shown = value[:40]
            raise CallError.of(Phrase("point", point=shown), "has no place in the sketch", did_you_mean(shown, spots))
        return value, [float(x) for x in spots[value]], {}
    place = _at(step, key)
    name = _free_letter(made, before or {})
    return name, place, {f"sketch.{name}": place}


def _link_of(made: Tables, step: Step, key: str) -> str:
    name, links = str(step.get(key, "")), table_in(made, "links")
    if name not in links:
        raise CallError.of(Phrase("link", name=name[:40]), "there is no such link", did_you_mean(name[:40], links))
    return name


def _pivot(made: Tables, step: Step) -> OwnTables:
    return {f"frame.points.{_free_letter(made)}": _at(step, "at")}


def _fix(made: Tables, step: Step) -> OwnTables:
    """A point that moved becomes a pivot of the frame."""
    name, place, new = _end(made, step, "point")
    return {**new, f"frame.points.{name}": place, f"sketch.{name}": None}


def _bar(made: Tables, step: Step) -> OwnTables:
    first, p, begun = _end(made, step, "from")
    second, q, ended = _end(made, step, "to", begun)
    long = math.dist(p, q)
    if first == second or long == 0.0:
        raise CallError.of("bar", "begins and ends in the same place", "pull it to another place")
    return {f"links.{_next_link(made)}": {"points": [first, second], "length": _round(long)}, **begun, **ended}


def _point_on(made: Tables, step: Step) -> OwnTables:
    """A further point of a link, in its own axes."""
    name, place = _link_of(made, step, "link"), _at(step, "at")
    ends = names_in(table_in(made["links"], name).get("points"))
    spots = draft(made)["points"]
    if len(ends) < 2 or any(p not in spots for p in ends):
        raise CallError.of(Phrase("link of name", name=name), "has no axis of its own", "give it two points first")
    origin, end = (complex(*spots[p]) for p in ends)
    local = (complex(*place) - origin) / ((end - origin) / abs(end - origin))
    letter = _free_letter(made)
    return {f"links.{name}.at.{letter}": [_round(x) for x in xy(local)], f"sketch.{letter}": place}


def _slider(made: Tables, step: Step) -> OwnTables:
    """A block with a pin, on a new guide of the frame through its place."""
    point, place, new = _end(made, step, "point")
    fixed, _ = frame_in(made)
    guides = table_in(table_in(made, "frame"), "guides")
    guide = next(name for name in ("h", *(f"h{n}" for n in range(2, 1000))) if name not in guides)
    return {
        f"frame.guides.{guide}": {"through": place, "angle": _round(_number(step, "angle", 0.0))},
        f"links.{_next_link(made)}": {"points": [point], "on": f"{fixed}.{guide}"}, **new,
    }


def _block(made: Tables, step: Step) -> OwnTables:
    """A block with a pin that slides along a link's own axis."""
    point, _, new = _end(made, step, "point")
    return {f"links.{_next_link(made)}": {"points": [point], "on": _link_of(made, step, "link")}, **new}


def _slotted(made: Tables, step: Step) -> OwnTables:
    """A bar of no fixed length from a point, with a slot along its axis."""
    point, _, new = _end(made, step, "point")
    return {f"links.{_next_link(made)}": {"points": [point]}, **new}


def _pin(made: Tables, step: Step) -> OwnTables:
    """A pin of one link in the slot along the axis of another."""
    point = str(step.get("point", ""))
    if point not in points_in(made):
        near = did_you_mean(point[:40], points_in(made))
        raise CallError.of(Phrase("point", point=point[:40]), "there is no such point", near)
    return {f"pins.{point}": {"of": _link_of(made, step, "of"), "in": _link_of(made, step, "link")}}


def _drive(made: Tables, step: Step) -> OwnTables:
    """A driven link: its angle is that of the sketch."""
    name = _link_of(made, step, "link")
    link, spots = table_in(made["links"], name), draft(made)["points"]
    ends = [p for p in names_in(link.get("points")) if p in spots]
    fixed, _ = frame_in(made)
    if len(ends) < 2:
        on = link.get("on")
        if not ends or not isinstance(on, str) or on.partition(".")[0] != fixed:
            raise CallError.of(Phrase("link of name", name=name), "has no axis that could be driven",
                               "drive a bar or a slider")
        guide = table_in(made["frame"], "guides").get(on.partition(".")[2], {})
        through = guide.get("through", [0.0, 0.0])
        start = complex(*spots.get(through, (0, 0))) if isinstance(through, str) else complex(*through)
        travel = dot(complex(*spots[ends[0]]) - start, direction(guide.get("angle", 0.0)))
        return {"driver": {"slide": name, "travel": _round(travel), "velocity": _number(step, "speed", 100.0)}}
    angle = degrees(complex(*spots[ends[1]]) - complex(*spots[ends[0]]))
    return {"driver": {"link": name, "angle": _round(angle), "omega": _number(step, "speed", 10.0)}}


def _delete(made: Tables, step: Step) -> OwnTables:
    """Remove a link or a point, with the parts that only hung on it."""
    changes: OwnTables = {}
    links = table_in(made, "links")
    if "link" in step:
        gone = {_link_of(made, step, "link")}
    else:
        point = str(step.get("point", ""))
        if point not in points_in(made):
            raise CallError.of(Phrase("point", point=point[:40]), "there is no such point")
        gone = {n for n in links if point in names_in(table_in(links, n).get("points"))}
        changes |= {f"links.{n}.at.{point}": None for n, link in links.items() if point in table_in(link, "at")}
        if point in frame_in(made)[1]:
            changes[f"frame.points.{point}"] = None
    changes |= {f"links.{name}": None for name in gone}
    kept = points_in({"links": {name: link for name, link in links.items() if name not in gone}})
    for table in ("sketch", "drawn", "pins"):
        for name, entry in table_in(made, table).items():
            of = isinstance(entry, Mapping) and gone & {str(entry.get("of")), str(entry.get("in")).split(".")[0]}
            if name not in kept or of or name == step.get("point"):
                changes[f"{table}.{name}"] = None
    driver = made.get("driver")
    if isinstance(driver, Mapping) and gone & {str(driver.get("link")), str(driver.get("slide", "")).split("/")[0]}:
        changes["driver"] = None
    return changes


STEPS: Mapping[str, Callable[[Tables, Step], OwnTables]] = {
    "pivot": _pivot, "fix": _fix, "bar": _bar, "point": _point_on, "slider": _slider, "block": _block,
    "slotted": _slotted, "pin": _pin, "drive": _drive, "delete": _delete,
}
"""What can be built, by name."""


def trial_driver(made: Tables) -> OwnTables | None:
    """A driver for a mapping without one, so that its freedom can be counted; None where there is no link."""
    if "driver" in made or not table_in(made, "links"):
        return None
    return {"link": next(iter(table_in(made, "links"))), "angle": 0.0, "omega": 1.0}


# a point pulled


def movable(scene: Mechanism) -> dict[str, str]:
    """The effect of pulling each point that has one: on the "frame", the "driver" (turned or shifted), or "lengths"."""
    kinds = dict.fromkeys(scene.frame.points, "frame")
    for link in scene.links:
        for point in link.points:
            if point not in kinds and (link.length is not None or point not in link.bar):
                kinds[point] = "lengths"
    for driver in scene.drivers:
        for point in _driven(scene, driver):
            kinds[point] = "driver"
    return kinds


def _driven(scene: Mechanism, driver: Driver) -> list[str]:
    """The points with which a driver is turned or shifted by hand: those of a link about a pivot of the frame, and of
    a link on a guide of the frame."""
    if driver.turns_about(scene.frame.name) and (pivots := scene.pivots(driver.link)):
        return [p for p in scene.by_name[driver.link].points if p not in pivots]
    rail = scene.rail(driver.link)
    return [] if driver.turns or rail is None or rail.key != driver.key else [*scene.by_name[driver.link].points]


def pulled(
    raw: Tables, motion: Motion, point: str, to: complex, lengths: bool = False
) -> tuple[Tables, Mapping[str, float]]:
    """Pull a point to a place.

    Parameters
    ----------
    raw : the mapping of the scene's file
    motion : the present position
    to : the place (m)
    lengths : whether a point of a driven link changes its length instead of driving it

    Returns
    -------
    the changes: entries of the file by key, and the value of a driver in its own unit

    Raises
    ------
    CallError : a point that the scene does not have, or that no entry of the file places
    """
    scene = motion.scene
    kinds = movable(scene)
    if point not in kinds and point not in scene.holders:
        raise CallError.of(Phrase("point", point=point[:60]), "there is no such point", did_you_mean(point[:60], kinds))
    if point not in kinds:
        raise CallError.of(Phrase("point", point=point), "cannot be pulled", "its place follows from the others")
    if point in scene.frame.points:
        entry = raw["frame"]["points"][point]
        return _entry(scene, f"frame.points.{point}", entry, scene.frame.points, point, to), {}
    if kinds[point] == "driver" and not lengths:
        return {}, _driver(motion, point, to)
    if point in raw.get("drawn", {}):
        return _as_drawn(motion, point, to), {}
    for slide in scene.slidings:  # a block of the frame stays on its guide
        if slide.b == scene.frame.name and scene.by_name[slide.a].points.get(point) == 0j:
            guide = slide.guide
            to = guide.through + dot(to - guide.through, guide.direction) * guide.direction
            break
    changes: OwnTables = {}
    for link in scene.links:
        if point in link.points:
            changes |= _of_link(raw, motion, link.name, point, to)
    if not changes:
        raise CallError.of(Phrase("point", point=point), "has no length that could change", "pull another point")
    return changes, {}


def _as_drawn(motion: Motion, point: str, to: complex) -> OwnTables:
    """The place of a point that the file gives as drawn, which holds at the scene's own position."""
    scene = motion.scene
    values = [driver.values[0] for driver in scene.drivers]
    if any(abs(v - o) > 1e-9 * max(1.0, abs(o)) for v, o in zip(motion.values[0], values, strict=True)):
        raise CallError.of(Phrase("point", point=point), "is given as drawn at the scene's own",
                           "go back to that position to pull it")
    return _entry(scene, f"drawn.{point}", None, {}, point, to)


def _driver(motion: Motion, point: str, to: complex) -> dict[str, float]:
    scene, now = motion.scene, complex(motion.position(point)[0])
    index, driver = next(each for each in enumerate(scene.drivers) if point in _driven(scene, each[1]))
    if driver.turns:
        centre = scene.frame.points[scene.pivots(driver.link)[0]]
        if abs(to - centre) == 0.0:
            return {}
        turn = math.degrees(cmath.phase((to - centre) / (now - centre)))
        return {driver.key: math.degrees(float(motion.values[0][index])) + turn}
    travel = float(motion.values[0][index]) + dot(to - now, scene.sliding(driver.key).guide.direction)
    return {driver.key: travel / scene.units.metres}


def _entry(
    scene: Mechanism, key: str, entry: object, places: Mapping[str, complex], point: str, to: complex
) -> OwnTables:
    """An entry that gives the place of a point, or places it from one or two others, so that it lies at a place."""
    if not isinstance(entry, Mapping):
        return {key: [_length(scene, x) for x in xy(to)]}
    if isinstance(entry["from"], str):
        origin = places[entry["from"]]
        now = to - origin
        radius = _length(scene, abs(now))
        if radius == 0.0:  # it stays
            return {f"{key}.r": entry["r"]}
        turned = float(entry.get("angle", 0.0)) + degrees(now / (places[point] - origin))
        return {f"{key}.r": radius, f"{key}.angle": _rounded(math.remainder(turned, 360.0), 0.1)}
    first, second = (places[p] for p in entry["from"])
    side = "left" if cross(second - first, to - first) > 0 else "right"
    return {f"{key}.r": [_length(scene, abs(to - z)) for z in (first, second)], f"{key}.side": side}


def _of_link(raw: Tables, motion: Motion, name: str, point: str, to: complex) -> OwnTables:
    """The new entries of a link with the point at a place and its other points where they are."""
    scene = motion.scene
    link = scene.by_name[name]
    if point in link.bar:
        if link.length is None or len(link.bar) < 2 or "length" not in raw["links"][name]:
            return {}
        other = link.bar[0] if point == link.bar[1] else link.bar[1]
        long = _length(scene, abs(to - complex(motion.position(other, name)[0])))
        return {f"links.{name}.length": long} if long > 0 else {}
    entry = raw["links"][name].get("at", {}).get(point)
    axis = cmath.rect(1.0, float(motion.angle(name)[0]))
    known = next((p for p in link.points if p != point), None)
    if entry is None or known is None:
        return {}
    local = (to - complex(motion.position(known, name)[0])) / axis + link.points[known]
    return _entry(scene, f"links.{name}.at.{point}", entry, link.points, point, local)


def _length(scene: Mechanism, value: float) -> float:
    """A length in the scene's unit, to a few thousandths of the mechanism: the accuracy of a hand."""
    lengths = [link.length for link in scene.links if link.length] + [abs(z) for z in scene.frame.points.values()]
    size = max(lengths, default=1.0) / scene.units.metres
    return _rounded(value / scene.units.metres, 10.0 ** (math.floor(math.log10(size)) - 3) if size > 0 else 1e-3)


def _rounded(value: float, step: float) -> float:
    return float(f"{round(value / step) * step:.10g}") + 0.0
