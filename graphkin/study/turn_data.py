"""The study of a turn as plain data for programs, in the scene's length unit."""

from __future__ import annotations

import math

import numpy as np

from graphkin.errors import Unsolvable
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.study.extremes import Extreme, Traced, driver_value
from graphkin.study.turn import Output, TurnStudy
from graphkin.words import word


def _flywheel(turn: TurnStudy) -> dict[str, Json]:
    """The flywheel, if the scene asks for one, or the reason why there is none: in the scene's units, works in force x
    metre."""
    units, flywheel = turn.scene.units, turn.flywheel
    if flywheel is None:
        return {}
    if isinstance(flywheel, Unsolvable):
        return {"flywheel": {"excess_W": None, "J_F": None, "why": flywheel.why}}
    areas: list[Json] = []
    for offsets, work in flywheel.areas.items():
        first, last = (_driver(turn.scene, value) for value in turn.reach.value(np.array(offsets)).tolist())
        areas.append({"from": first, "to": last, "work": work / units.newtons})
    return {
        "flywheel": {
            "on": flywheel.link,
            "delta": flywheel.delta,
            "driving_moment": flywheel.driving / units.newtons,
            "work": flywheel.work / units.newtons,
            "areas": areas,
            "slowest": _driver(turn.scene, driver_value(turn.reach, flywheel.slowest)),
            "fastest": _driver(turn.scene, driver_value(turn.reach, flywheel.fastest)),
            "excess_W": flywheel.excess / units.newtons,
            "J_F": flywheel.inertia / units.of("inertia").si,
        }
    }


def to_json(turn: TurnStudy) -> dict[str, Json]:
    """The object that ``sweep --json`` prints: numbers in the scene's length unit, seconds, radians.

    A missing value is ``null``, with a ``why`` beside it.
    """
    reach, scene = turn.reach, turn.scene
    driver = reach.driver
    return {
        "title": scene.question.title,
        "units": {"length": scene.units.length, "time": "s", "angle": "rad"},
        "mobility": reach.structure.mobility.value,
        "driver": {"key": driver.key, "full_turn": reach.full, "turns_to_close": reach.turns or None},
        "ranges": [
            {
                "low": _driver(scene, stretch.low) if stretch.ends[0] or reach.full else None,
                "high": _driver(scene, stretch.high) if stretch.ends[1] or reach.full else None,
                "reached": k == 0,
                "full_turn": reach.full,
            }
            for k, stretch in enumerate(turn.ranges)
        ],
        "ranges_not_searched_for": list(turn.not_searched),
        "why": str(reach.limit_why),
        "mechanisms": [
            {
                "kind": loop.kind,
                "name": loop.name,
                "links": list(loop.links),
                "lengths": {k: v / scene.units.metres for k, v in loop.lengths.items()},
                "grashof": loop.grashof,
                "turn_fully": list(loop.turns),
            }
            for loop in turn.loops
        ],
        "outputs": [_output(turn, o) for o in turn.outputs],
        "transmission": [
            {
                "links": list(least.group.links),
                "kind": least.group.kind,
                "least_angle": least.angle,
                "greatest_pressure_angle": least.pressure,
                "driver": _driver(scene, least.drivers[0]) if least.drivers else None,
                **({"drivers": [_driver(scene, x) for x in least.drivers]} if least.drivers else {}),
                **({} if least.drivers else {"why": "the same in every position"}),
            }
            for least in turn.transmission
        ],
        "curves": {str(t.quantity): _curve(turn, t) for t in turn.curves},
        **_forces(turn),
        **_flywheel(turn),
    }


def _forces(turn: TurnStudy) -> dict[str, Json]:
    """Greatest and least of joint forces, couples and balances; nothing without masses and loads."""
    if not turn.scene.loading:
        return {}
    from graphkin.study.force_diagrams import force_extremes  # it loads the drawing board

    try:
        forces = force_extremes(turn.reach)
    except Unsolvable as stop:
        return {"forces": {}, "why_no_forces": stop.why}
    return {"forces": {
        name: {"unit": quantity.unit(turn.scene.units).text,
               "extremes": [_extreme(turn, quantity, e, "grows without bound there") for e in extremes]}
        for name, (quantity, extremes) in forces.items()
    }}


def known(value: float, why: str) -> dict[str, float | str | None]:
    """A value, or the reason why there is none."""
    return {"value": value} if math.isfinite(value) else {"value": None, "why": word(why, "en")}


def _driver(scene: Mechanism, value: float) -> float:
    return float(scene.unit_of(scene.drivers[0], radians=True).of(value))


def _extreme(turn: TurnStudy, quantity: Symbol, extreme: Extreme, away: str = "goes away") -> dict[str, Json]:
    """An extreme; ``away`` is the reason for a value without bound."""
    value = quantity.unit(turn.scene.units, radians=True).of(extreme.value)
    return {
        "kind": extreme.kind,
        "driver": _driver(turn.scene, extreme.driver),
        **known(value, away if math.isinf(extreme.value) else "not computed"),
        **({"local": True} if extreme.local and math.isfinite(value) else {}),
    }


def _curve(turn: TurnStudy, traced: Traced) -> dict[str, Json]:
    quantity, unit = traced.quantity, traced.quantity.unit(turn.scene.units, radians=True)
    data: dict[str, Json] = {
        "unit": unit.text, "extremes": [_extreme(turn, quantity, e) for e in traced.extremes],
    }
    if not quantity.is_angle_of_link:  # where a turning link points along x is not sought
        data["zeros"] = [_driver(turn.scene, z) for z in traced.zeros]
    if traced.constant is not None:
        data["constant"] = unit.of(traced.constant)
    return data


def _output(turn: TurnStudy, output: Output) -> dict[str, Json]:
    quantity, stroke, back = output.quantity, output.stroke, turn.quick_return(output)
    mover, extent = ("link", "swing") if quantity.kind == "theta" else ("slide", "stroke")
    data: dict[str, Json] = {
        mover: quantity.pair,
        "limit_positions": [_extreme(turn, quantity, e) for e in output.position.extremes],
        extent: None if stroke is None else quantity.unit(turn.scene.units, radians=True).of(stroke),
    }
    data["K"], data["theta"] = back if back else (None, None)
    if stroke is None:
        data["why"] = word(output.without, "en")
    elif back is None:
        data["why"] = "K needs a driver that turns fully and a motion that repeats each turn"
    return data


def design_row(turn: TurnStudy) -> dict[str, float | str | None]:
    """A row of a table of designs: strokes and swings (deg), K, the least transmission angle (deg) and its place."""
    scene = turn.scene
    cells: dict[str, float | str | None] = {}
    stretch, unit = turn.ranges[0], scene.unit_of(scene.drivers[0])
    for name, value, limited in zip(("low", "high"), (stretch.low, stretch.high), stretch.ends, strict=True):
        cells[f"range_{name} ({unit.text})"] = unit.of(value) if limited or turn.reach.full else None
    for output in turn.outputs:
        quantity, stroke, back = output.quantity, output.stroke, turn.quick_return(output)
        extent = "swing" if quantity.kind == "theta" else "stroke"
        measured = quantity.unit(scene.units)
        cells[f"{extent}_{quantity.pair} ({measured.text})"] = None if stroke is None else measured.of(stroke)
        cells[f"K_{quantity.pair}"] = back[0] if back else None
    for least in turn.transmission:
        cells[f"least_transmission_{least.group.label} (deg)"] = math.degrees(least.angle)
    cells["mechanisms"] = "; ".join(loop.name for loop in turn.loops)
    return cells
