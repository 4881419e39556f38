"""What a mechanism weighs and carries, as it is given, in words with symbols."""

from __future__ import annotations

import math
from collections.abc import Iterator

from graphkin.construction.sheet import Sheet
from graphkin.drawing.conventions import Letters
from graphkin.drawing.force_letters import force_letters
from graphkin.drawing.headings import number
from graphkin.drawing.springs import spring_given
from graphkin.scene.loads import LoadOn, Phase
from graphkin.scene.model import AngleDriver, Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase, say

__all__ = ["given_loads"]


def given_loads(sheet: Sheet, letters: Letters, language: str) -> list[str]:
    """Masses, weights, inertias, loads, springs and what balances, a line for each kind."""
    scene, loading = sheet.scene, sheet.scene.loading
    return [
        *filter(None, [";  ".join(_masses(scene, letters, language))]),
        *(_load(scene, load, letters, language) for load in loading.loads),
        *(spring_given(scene, spring, letters, language) for spring in loading.springs),
        _balance(scene, letters, language),
    ]


def _masses(scene: Mechanism, letters: Letters, language: str) -> Iterator[str]:
    units, loading = scene.units, scene.loading
    for mass in loading.masses:
        point = next((p for p, z in scene.by_name[mass.link].points.items() if z == mass.at), "")
        where = f"${letters.point(point)}$" if point else (
            f"({number(mass.at.real / units.metres)}, {number(mass.at.imag / units.metres)}) {units.length}"
        )  # fmt: skip
        said = f"$m_{{{mass.link}}}$ = {number(mass.mass / units.kilograms, 5)} {units.mass}"
        if loading.gravity:
            weight = mass.mass * abs(loading.gravity) / units.newtons
            name = force_letters(letters.convention, Symbol("G", link=mass.link))
            said += f", ${name}$ = {number(weight, 5)} {units.force}"
        if mass.inertia:
            square = "ft²" if units.mass == "lb" else "m²"
            said += f", $J_{{{mass.link}}}$ = {number(mass.inertia / units.inertias, 5)} {units.mass}·{square}"
        yield say(Phrase("given mass", (said, where)), language)


def _load(scene: Mechanism, load: LoadOn, letters: Letters, language: str) -> str:
    units = scene.units
    name = f"${force_letters(letters.convention, Symbol('P', name=load.name, turning=not load.is_force))}$"
    size = f"{name} = {number(load.size / units.newtons)} {units.force}" + ("" if load.is_force else "·m")
    if not load.is_force:
        said = say(Phrase("given moment", (size, load.link)), language)
    elif load.against:
        said = say(Phrase("given against", (size, load.link, load.against)), language)
    else:
        angle = number(math.degrees(math.atan2(load.turn.imag, load.turn.real)), 5)
        key = "given following" if load.follows else "given force"
        said = say(Phrase(key, (size, load.link, angle, load.follows)), language)
    return said + ("" if load.phase is None else _phase(scene, load.phase, language))


def _phase(scene: Mechanism, phase: Phase, language: str) -> str:
    if phase.stroke:
        key = "given on stroke" if phase.sense > 0 else "given on stroke back"
        return say(Phrase(key, (phase.stroke, number(phase.start), number(phase.end))), language)
    driver = scene.drivers[0]
    if isinstance(driver, AngleDriver):
        ends = (number(math.degrees(phase.start)) + "°", number(math.degrees(phase.end)) + "°")
    else:
        metres, unit = scene.units.metres, scene.units.length
        ends = (number(phase.start / metres), f"{number(phase.end / metres)} {unit}")
    return say(Phrase("given while driver", ends), language)


def _balance(scene: Mechanism, letters: Letters, language: str) -> str:
    said = scene.loading.balance
    found = []
    if said is not None:
        found.append(Symbol("M" if said.kind == "moment" else "F", link=said.link))
    else:
        for driver in scene.drivers:
            if isinstance(driver, AngleDriver):
                found.append(Symbol("M", link=driver.link))
            else:
                of = next((p.of for p in scene.pins if p.key == driver.key), driver.key.partition("/")[0])
                found.append(Symbol("F", link=of))
    names = ", ".join(f"${force_letters(letters.convention, s)}$" for s in found)
    return say(Phrase("given balance", (names,)), language)
