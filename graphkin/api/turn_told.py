"""The study of a turn in words, for the terminal and the notebook."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from graphkin.api.called import own_unit
from graphkin.scene.model import Scene
from graphkin.words import Phrase, say, word

if TYPE_CHECKING:
    from graphkin.api.swept import Swept
    from graphkin.study import Extreme, Output, Turn

__all__ = ["told_turn"]

MOST_CURVES = 40


def told_turn(swept: Swept) -> str:
    """The whole summary as lines of text."""
    language = swept.language
    scene = swept.plan.scene
    title = scene.title_in(language)
    lines = [title]
    if swept.turn is not None:
        lines += _turn(swept.turn, language)
    if swept.plan.designs.keys:
        outcomes = ", ".join(f"{n} {status}" for status, n in swept.outcomes.items())
        lines.append(say(Phrase("designs solved", (len(swept.plan.designs), outcomes)), language))
    lines.append(say(Phrase("positions solved", (swept.good, swept.rows)), language))
    return "\n".join(lines)


def _turn(turn: Turn, language: str) -> list[str]:
    scene = turn.scene
    driver = scene.drivers[0]
    lines: list[str] = []
    own = turn.ranges[0]
    if own.whole:
        said = word("full turn", language)
        if turn.course.turns > 1:
            said += "; " + say(Phrase("turns to close", (turn.course.turns,)), language)
    else:
        said = _between(scene, own.low, own.high, own.open_low, own.open_high)
    lines.append(f"{word('range', language)} {driver.key}: {said}")
    for other in turn.ranges[1:]:
        between = _between(scene, other.low, other.high, other.open_low, other.open_high)
        lines.append("  " + say(Phrase("also assembles", (between,)), language))
    if turn.not_searched:
        lines.append("  " + say(Phrase("not looked for", (", ".join(turn.not_searched),)), language))
    for loop in turn.loops:
        turning = say(Phrase("turns fully", (", ".join(loop.turns) or "–",)), language)
        names = ", ".join(loop.links)
        lines.append(f"{word('basic mechanism', language)} {names}: {word(loop.name, language)}; {turning}")
    for output in turn.outputs:
        lines += _output(turn, output, language)
    for least in turn.transmission:
        where = word("same everywhere", language)
        if least.driver is not None:
            where = f"{driver.key} = {own_unit(scene, driver, least.driver)}"
        pressure = say(Phrase("greatest pressure", (f"{math.degrees(least.pressure):.6g}°",)), language)
        names = f"{least.group.kind} {', '.join(least.group.links)}"
        lines.append(
            f"{word('least transmission', language)} {names}: {math.degrees(least.angle):.6g}° ({where}); {pressure}"
        )
    lines += _curves(turn, language)
    return lines


def _between(scene: Scene, low: float, high: float, open_low: bool = False, open_high: bool = False) -> str:
    ends = [
        "..." if open_ else own_unit(scene, scene.drivers[0], value)
        for value, open_ in ((low, open_low), (high, open_high))
    ]
    return " – ".join(ends)


def _at(scene: Scene, extreme: Extreme) -> str:
    return own_unit(scene, scene.drivers[0], extreme.driver)


def _output(turn: Turn, output: Output, language: str) -> list[str]:
    scene, quantity = turn.scene, output.quantity
    unit = quantity.unit(scene, degrees=True).replace("deg", "°")

    def amount(value: float) -> str:
        return f"{quantity.in_units(scene, value, degrees=True):.10g} {unit}".replace(" °", "°")

    head = f"{word('output', language)} {quantity.of}: "
    if output.stroke is None:
        key = "does not move" if output.position.constant is not None else "turns on"
        return [head + word(key, language)]
    what = "swing is" if quantity.kind == "theta" else "stroke is"
    said = say(Phrase(what, (amount(output.stroke),)), language)
    back = turn.quick_return(output)
    if back is not None:
        said += f", K = {back[0]:.10g} (θ = {math.degrees(back[1]):.8g}°)"
    places = ", ".join(f"{amount(e.value)} @ {_at(scene, e)}" for e in output.position.extremes)
    return [head + said, f"  {word('limit position', language)}: {places}"]


def _curves(turn: Turn, language: str) -> list[str]:
    scene = turn.scene
    lines: list[str] = []
    moving = [t for t in turn.curves if t.constant is None and not t.quantity.is_position]
    for traced in moving[:MOST_CURVES]:
        quantity = traced.quantity
        high = max((e for e in traced.extremes if e.kind == "max"), key=lambda e: e.value, default=None)
        low = min((e for e in traced.extremes if e.kind == "min"), key=lambda e: e.value, default=None)
        parts = []
        for key, extreme in (("greatest", high), ("least", low)):
            if extreme is not None:
                value = quantity.in_units(scene, extreme.value)
                parts.append(f"{word(key, language)} {value:.6g} @ {_at(scene, extreme)}")
        if traced.zeros:
            places = ", ".join(own_unit(scene, scene.drivers[0], z) for z in traced.zeros)
            parts.append(f"{word('zero at', language)} {places}")
        lines.append(f"{quantity.name} ({quantity.unit(scene)}): {'; '.join(parts)}")
    return lines
