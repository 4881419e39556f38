"""A mechanism built piece by piece: pivots, bars, sliders, pins in slots, written into the text of a scene.

Every point that moves gets its place in ``[sketch]``, which picks the assembly once the mechanism is whole; lengths
are those of the sketch.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from graphkin.board.scene_text import changed
from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.files import OwnTables, Tables
from graphkin.scene.files import parsed
from graphkin.words import Phrase

__all__ = ["EMPTY", "STEPS", "built", "draft", "trial_driver"]

EMPTY = 'title = "New mechanism"\n\n[units]\nlength = "mm"\n\n[frame]\nname = "0"\n'
_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"

Step = Tables
"""What is to be built, as the page asks for it: `what`, and the names and places that it needs."""


def built(text: str, step: Step) -> str:
    """The text of a scene with one piece more, or one less.

    Parameters
    ----------
    step : ``what`` is one of `STEPS`, the rest what it needs: places are ``[x, y]`` in scene units, points and links
        are named.  A bar or a block may begin at a place instead of a point: the point is made.  ``places`` says where
        points lie that the text gives no place.

    Raises
    ------
    SceneError : the text is no TOML; CallError : a piece that cannot be made
    """
    what = str(step.get("what", ""))
    if what not in STEPS:
        raise CallError(Problem("piece", f'"{what[:60]}"', did_you_mean(what[:60], STEPS)))
    text = text if text.strip() else EMPTY
    made = parsed(text)
    seen = {p: z for p, z in _tables(step, "places").items() if _place(z) and p in _points(made)}
    changes = STEPS[what]({**made, "seen": seen}, step)
    return changed(text, changes) if changes else text


def _tables(made: Tables, name: str) -> OwnTables:
    found = made.get(name)
    return dict(found) if isinstance(found, Mapping) else {}


def _frame(made: Tables) -> tuple[str, OwnTables]:
    frame = _tables(made, "frame")
    return str(frame.get("name", "0")), _tables(frame, "points")


def draft(made: Tables) -> OwnTables:
    """What of a mapping can be shown before it is a mechanism: places of points (scene units), and the points of each
    link, whatever is missing still."""
    _, fixed = _frame(made)
    spots = {**_tables(made, "sketch"), **_tables(made, "drawn"), **_tables(made, "seen"), **fixed}
    points = {str(p): list(z) for p, z in spots.items() if _place(z)}
    for name, z in fixed.items():
        if isinstance(z, Mapping) and str(z.get("from")) in points and _place([z.get("r"), z.get("angle", 0.0)]):
            (x, y), turn = points[z["from"]], math.radians(z.get("angle", 0.0))
            points[name] = [x + z["r"] * math.cos(turn), y + z["r"] * math.sin(turn)]
    links = {}
    for name, link in _tables(made, "links").items():
        if isinstance(link, Mapping):
            own = [p for p in (*_list(link.get("points")), *_tables(link, "at")) if p in points]
            links[str(name)] = {"points": own, "block": "on" in link and len(own) < 2}
    guides = []
    for guide in _tables(_tables(made, "frame"), "guides").values():
        through = guide.get("through") if isinstance(guide, Mapping) else None
        through = points.get(through) if isinstance(through, str) else through
        if _place(through):
            turn = guide.get("angle")
            guides.append({"through": through, "angle": turn if isinstance(turn, int | float) else 0.0})
    return {"points": points, "fixed": [p for p in fixed if p in points], "links": links, "guides": guides}


def _list(value: object) -> list[object]:
    return list(value) if isinstance(value, list) else []


def _place(value: object) -> bool:
    if not isinstance(value, list) or len(value) != 2:
        return False
    return all(isinstance(x, int | float) and math.isfinite(x) for x in value)


def _free_letter(made: Tables, taken: set[str]) -> str:
    used = taken | _points(made)
    names: list[str] = [*_LETTERS, *(f"{c}{n}" for n in range(1, 100) for c in _LETTERS)]
    return next(name for name in names if name not in used)


def next_link(made: Tables) -> str:
    """The number of the next link."""
    links = _tables(made, "links")
    fixed, _ = _frame(made)
    return next(str(n) for n in range(1, 10_000) if str(n) not in links and str(n) != fixed)


def _points(made: Tables) -> set[str]:
    found = {*_tables(made, "sketch"), *_tables(made, "drawn"), *_tables(made, "pins"), *_frame(made)[1]}
    for link in _tables(made, "links").values():
        if isinstance(link, Mapping):
            found |= {str(p) for p in (*_list(link.get("points")), *_tables(link, "at"))}
    return found


def _at(step: Step, key: str) -> list[float]:
    value = step.get(key)
    if not isinstance(value, list) or not _place(value):
        raise CallError(
            Problem(key, Phrase("found value", value=f"{value!r:.60}"), Phrase("give a place x y or the name"))
        )
    return [_round(x) for x in value]


def _round(value: float) -> float:
    return float(f"{value:.6g}") + 0.0


def _end(
    made: Tables, step: Step, key: str, changes: OwnTables
) -> tuple[str, list[float]]:
    """A point of the mechanism, or a new one at a place, whose sketch is written."""
    value = step.get(key)
    if isinstance(value, str):
        spots = draft(made)["points"]
        if value not in spots:
            shown = value[:40]
            raise CallError(
                Problem(Phrase("point", point=shown), Phrase("has no place in the sketch"), did_you_mean(shown, spots))
            )
        return value, [float(x) for x in spots[value]]
    place = _at(step, key)
    taken = {name.split(".")[1] for name in changes if name.startswith("sketch.")}
    name = _free_letter(made, taken)
    changes[f"sketch.{name}"] = place
    return name, place


def _link_of(made: Tables, step: Step, key: str) -> str:
    name, links = str(step.get(key, "")), _tables(made, "links")
    if name not in links:
        raise CallError(
            Problem(Phrase("link", name=name[:40]), Phrase("there is no such link"), did_you_mean(name[:40], links))
        )
    return name


def _pivot(made: Tables, step: Step) -> OwnTables:
    return {f"frame.points.{_free_letter(made, set())}": _at(step, "at")}


def _fix(made: Tables, step: Step) -> OwnTables:
    """A point that moved becomes a pivot of the frame."""
    changes: OwnTables = {}
    name, place = _end(made, step, "point", changes)
    return {**changes, f"frame.points.{name}": place, f"sketch.{name}": None}


def _bar(made: Tables, step: Step) -> OwnTables:
    changes: OwnTables = {}
    (one, p), (other, q) = _end(made, step, "from", changes), _end(made, step, "to", changes)
    long = math.dist(p, q)
    if one == other or long == 0.0:
        raise CallError(Problem("bar", Phrase("begins and ends in the same place"), Phrase("pull it to another place")))
    return {f"links.{next_link(made)}": {"points": [one, other], "length": _round(long)}, **changes}


def _point_on(made: Tables, step: Step) -> OwnTables:
    """A further point of a link, in its own axes."""
    name, place = _link_of(made, step, "link"), _at(step, "at")
    own = _list(made["links"][name].get("points"))
    spots = draft(made)["points"]
    if len(own) < 2 or any(p not in spots for p in own):
        raise CallError(
            Problem(
                Phrase("link of name", name=name), Phrase("has no axis of its own"), Phrase("give it two points first")
            )
        )
    origin, end = (complex(*spots[p]) for p in own)
    along = (end - origin) / abs(end - origin)
    z = (complex(*place) - origin) / along
    letter = _free_letter(made, set())
    return {f"links.{name}.at.{letter}": [_round(z.real), _round(z.imag)], f"sketch.{letter}": place}


def _slider(made: Tables, step: Step) -> OwnTables:
    """A block with a pin, on a new guide of the frame through its place."""
    changes: OwnTables = {}
    point, place = _end(made, step, "point", changes)
    fixed, _ = _frame(made)
    guides = _tables(_tables(made, "frame"), "guides")
    guide = next(name for name in ("h", *(f"h{n}" for n in range(2, 1000))) if name not in guides)
    angle = float(step.get("angle", 0.0) or 0.0)
    if not math.isfinite(angle):
        raise CallError(Problem("angle", Phrase("found value", value=angle), Phrase("give degrees")))
    return {
        f"frame.guides.{guide}": {"through": place, "angle": _round(angle)},
        f"links.{next_link(made)}": {"points": [point], "on": f"{fixed}.{guide}"}, **changes,
    }  # fmt: skip


def _block(made: Tables, step: Step) -> OwnTables:
    """A block with a pin that slides along a link's own axis."""
    changes: OwnTables = {}
    point, _ = _end(made, step, "point", changes)
    return {f"links.{next_link(made)}": {"points": [point], "on": _link_of(made, step, "link")}, **changes}


def _slotted(made: Tables, step: Step) -> OwnTables:
    """A bar of no fixed length from a point, along whose axis something else slides."""
    changes: OwnTables = {}
    point, _ = _end(made, step, "point", changes)
    return {f"links.{next_link(made)}": {"points": [point]}, **changes}


def _pin(made: Tables, step: Step) -> OwnTables:
    """A pin of one link in the slot along the axis of another."""
    point = str(step.get("point", ""))
    if point not in _points(made):
        near = did_you_mean(point[:40], _points(made))
        raise CallError(Problem(Phrase("point", point=point[:40]), Phrase("there is no such point"), near))
    return {f"pins.{point}": {"of": _link_of(made, step, "of"), "in": _link_of(made, step, "link")}}


def _drive(made: Tables, step: Step) -> OwnTables:
    """A link that drives: its angle is that of the sketch."""
    name = _link_of(made, step, "link")
    link, spots = made["links"][name], draft(made)["points"]
    own = [p for p in _list(link.get("points")) if p in spots]
    fixed, _ = _frame(made)
    if len(own) < 2:
        on = link.get("on")
        if not own or not isinstance(on, str) or not on.startswith(f"{fixed}."):
            raise CallError(
                Problem(
                    Phrase("link of name", name=name),
                    Phrase("has no axis that could be driven"),
                    Phrase("drive a bar or a slider"),
                )
            )
        guide = _tables(made["frame"], "guides").get(on.partition(".")[2], {})
        through = guide.get("through", [0.0, 0.0])
        start = complex(*spots.get(through, (0, 0))) if isinstance(through, str) else complex(*through)
        turn = math.radians(guide.get("angle", 0.0))
        travel = (complex(*spots[own[0]]) - start) * complex(math.cos(turn), -math.sin(turn))
        return {"driver": {"slide": name, "travel": _round(travel.real), "velocity": float(step.get("speed") or 100.0)}}
    z = complex(*spots[own[1]]) - complex(*spots[own[0]])
    angle = math.degrees(math.atan2(z.imag, z.real))
    return {"driver": {"link": name, "angle": _round(angle), "omega": float(step.get("speed") or 10.0)}}


def _delete(made: Tables, step: Step) -> OwnTables:
    """Take a link or a point out, with what only hung on it."""
    changes: OwnTables = {}
    links = _tables(made, "links")
    if "link" in step:
        gone = {_link_of(made, step, "link")}
    else:
        point = str(step.get("point", ""))
        if point not in _points(made):
            raise CallError(Problem(Phrase("point", point=point[:40]), Phrase("there is no such point")))
        gone = {n for n, link in links.items() if point in _list(link.get("points"))}
        changes |= {f"links.{n}.at.{point}": None for n, link in links.items() if point in _tables(link, "at")}
        if point in _frame(made)[1]:
            changes[f"frame.points.{point}"] = None
    changes |= {f"links.{name}": None for name in gone}
    kept = {p for n, link in links.items() if n not in gone for p in (*_list(link.get("points")), *_tables(link, "at"))}
    for table in ("sketch", "drawn", "pins"):
        for name, entry in _tables(made, table).items():
            of = isinstance(entry, Mapping) and gone & {str(entry.get("of")), str(entry.get("in")).split(".")[0]}
            if name not in kept or of or name == step.get("point"):
                changes[f"{table}.{name}"] = None
    driver = made.get("driver")
    if isinstance(driver, Mapping) and gone & {driver.get("link"), str(driver.get("slide", "")).split("/")[0]}:
        changes["driver"] = None
    return changes


STEPS: Mapping[str, Callable[[Tables, Step], OwnTables]] = {
    "pivot": _pivot, "fix": _fix, "bar": _bar, "point": _point_on, "slider": _slider, "block": _block,
    "slotted": _slotted, "pin": _pin, "drive": _drive, "delete": _delete,
}  # fmt: skip
"""What can be built, by name."""


def trial_driver(made: Tables) -> OwnTables | None:
    """A driver for a mapping that has none yet, so that its freedom can be counted; None where there is no link."""
    if "driver" in made or not _tables(made, "links"):
        return None
    return {"link": next(iter(_tables(made, "links"))), "angle": 0.0, "omega": 1.0}
