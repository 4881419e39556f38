"""What figures of several positions show: limit positions, numbered ones, the least transmission angle, paths; polygons
beside each other.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from graphkin.api.arguments import driver_values
from graphkin.checking.readings import read_off
from graphkin.construction import Plan, execute, plan
from graphkin.construction.limits import Turned, TurnOfCrank
from graphkin.construction.sheet import Sheet
from graphkin.drawing.figures.positions import Shown
from graphkin.errors import CallError, GraphkinError, Problem, Unsolvable
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.structure import Dyad, Structure, Turn
from graphkin.structure.transmission import TransmissionAngle, joint_of_dyad
from graphkin.words import Phrase, Wording

__all__ = ["sheets_beside", "shown_positions"]

MARKS = ("theta", "stroke", "K", "gamma")
NARROWER = 40  # times that a place is halved in


def shown_positions(what: Plan, values: Mapping[str, float]) -> Shown:
    """What a scene's ``[positions]`` ask for; of a scene without them the limit positions.

    Parameters
    ----------
    what : the plan of the scene's own position
    values : the named positions, the first driver's value (rad, m) at each

    Raises
    ------
    Unsolvable : a named position that cannot be assembled or reached
    """
    structure, scene = what.structure, what.structure.scene
    own = execute(what)
    show = scene.positions.show if scene.positions else ("limits",)
    marks = scene.positions.marks if scene.positions else MARKS
    key = scene.drivers[0].key
    names = [n for n in values if n in show or ("all" in show and n in _numbered(scene))]

    def drawn(value: float) -> Sheet:
        return execute(plan(structure, {**own.drivers, key: value}, ())).at(own.scales)

    numbered = {name: drawn(values[name]) for name in names}
    limits: dict[str, tuple[Sheet, Sheet]] = {}
    without: dict[str, Wording] = {}
    measured: dict[tuple[str, str], float] = {}
    if "limits" in show:
        for output in _outputs(scene, structure):
            kinds = ("stroke" if "/" in output else "swing", "K", "theta_lag")
            asked = tuple(Symbol.parse(f"{kind}_{output}") for kind in kinds)
            try:
                turned = execute(plan(structure, own.drivers, asked)).at(own.scales)
            except Unsolvable as stop:  # no whole turn, or an output that turns on and on
                problem = stop.problems[0]
                without[str(problem.where)] = problem.found
                continue
            found = turned.limits[output]
            limits[output] = drawn(found.low.value), drawn(found.high.value)
            for reading in read_off(turned):
                if reading.symbol in asked:
                    measured[reading.symbol.kind, output] = float(reading.value.real)
            break
    turn = _turn(structure, own)
    least = _least(structure, turn, drawn) if turn and "gamma" in marks else None
    return Shown(own, limits, numbered, least, _paths(structure, turn, own) if turn else {}, measured, tuple(marks),
                 {} if limits else without)  # fmt: skip


def _numbered(scene: Mechanism) -> tuple[str, ...]:
    count = scene.positions.count if scene.positions else 0
    return tuple(str(k) for k in range(1, count + 1))


def _outputs(scene: Mechanism, structure: Structure) -> list[str]:
    """Outputs whose limits are shown, the likeliest first: that of position 1, slides on the frame, rockers."""
    frame, found = scene.frame, []
    if scene.positions is not None:
        places = (scene.positions.first, *scene.positions.also.values())
        found += [place.pair for place in places if place is not None and not isinstance(place, float)]
    last = [n for g in reversed(structure.groups) for n in g.links]
    found += [s.key for name in last for s in structure.slides if s.a == name and s.b == frame.name and not s.slot]
    found += [name for name in last if any(p in frame.points for p in structure.links[name].points)]
    return list(dict.fromkeys(found))


def _turn(structure: Structure, own: Sheet) -> TurnOfCrank | None:
    size = own.scales.length / structure.scene.size
    poses = {name: pose.scaled(size) for name, pose in own.poses.items()}
    if not set(structure.links) <= set(poses) or not isinstance(structure.scene.drivers[0], AngleDriver):
        return None
    try:
        return TurnOfCrank.of(structure, structure.elements, own.drivers, poses, "positions")
    except GraphkinError:
        return None


def _paths(structure: Structure, turn: TurnOfCrank, own: Sheet) -> dict[str, list[complex]]:
    """The ways of points of links that no pivot holds to the frame and no guide: of couplers."""
    frame = structure.scene.frame
    held = {n for n, link in structure.links.items() if any(p in frame.points for p in link.points)}
    held |= {n for s in structure.slides for n in (s.a, s.b) if frame.name in (s.a, s.b)} | {frame.name}
    mm = structure.scene.size / own.scales.length
    found: dict[str, list[complex]] = {}
    for name, link in structure.links.items():
        for point, local in link.points.items():
            if point in structure.scene.holders and not held & set(structure.scene.holders[point]):
                found.setdefault(point, [
                    (one.poses[name].origin + one.poses[name].axis * local / structure.scene.size) * mm
                    for one in turn.positions
                ])  # fmt: skip
    return found


def _least(
    structure: Structure, turn: TurnOfCrank, drawn: Callable[[float], Sheet]
) -> tuple[Sheet, float, tuple[complex, complex, complex]] | None:
    """Where the transmission angle of the last group with a pin inside is least."""
    group = next((g for g in reversed(structure.groups) if isinstance(g, Dyad) and isinstance(g.inner, Turn)), None)
    if group is None:
        return None
    joint = joint_of_dyad(structure, group)

    def gamma(one: Turned) -> float:
        first, second = _ways(structure, joint, one)
        across = first.conjugate() * second
        return math.atan2(abs(across.imag), abs(across.real))

    k = min(range(len(turn.positions)), key=lambda i: gamma(turn.positions[i]))
    best = turn.positions[k]
    step = turn.positions[1].value - turn.positions[0].value
    for _ in range(NARROWER):  # the least lies between its neighbours
        step /= 2
        near = [one for value in (best.value - step, best.value + step) if (one := turn.near(value, best.poses))]
        best = min([best, *near], key=gamma)
    sheet = drawn(best.value)
    inner = group.inner
    assert isinstance(inner, Turn)
    pose = sheet.poses[inner.a]
    at = pose.place(structure.links[inner.a].points[inner.point] / sheet.scales.length)
    first, second = _ways(structure, joint, best)
    return sheet, gamma(best), (at, -first, -second)


def _ways(structure: Structure, joint: TransmissionAngle, one: Turned) -> tuple[complex, complex]:
    def of(spot: tuple[str, complex]) -> complex:
        pose = one.poses[spot[0]]
        return pose.place(spot[1] / structure.scene.size)

    first, second = (of(end) - of(start) for start, end in (joint.first, joint.second))
    return first, second * (1j if joint.square else 1.0)


def sheets_beside(
    structure: Structure, drivers: Mapping[str, float], wished: Sequence[str | float]
) -> list[tuple[str, Sheet]]:
    """The constructions at several positions, for polygons that stand beside each other.

    Parameters
    ----------
    drivers : values of the drivers (rad, m) in the scene's own position
    wished : names of positions, or values of the first driver; without any those that ``[positions]`` shows

    Raises
    ------
    CallError : fewer than two positions, or a name that is none
    Unsolvable : a position that cannot be assembled or reached
    """
    scene = structure.scene
    named = scene.positions.show if scene.positions else ()
    known = scene.positions.names if scene.positions else ()
    wished = wished or tuple(n for n in known if n in named or ("all" in named and n.isdigit()))
    if len(wished) < 2:
        wanted = Phrase("name two or more beside 1 beside 7")
        raise CallError(Problem("figure polygons", Phrase("shows several positions beside each other"), wanted))
    asked = tuple(s for s in scene.find if s.scope == "motion" and not s.at)
    sheets = []
    for name in map(str, wished):
        values = {**drivers, **(driver_values(scene, name if name in known else _number(name)) or {})}
        sheets.append((name, execute(plan(structure, values, asked))))
    return sheets


def _number(text: str) -> float | str:
    """A driver's value, as far as it is one."""
    try:
        return float(text)
    except ValueError:
        return text
