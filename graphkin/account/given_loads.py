"""What a mechanism weighs and carries, as it is given, in words with symbols; springs as they are drawn between their
points, and how their forces were measured."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import reduce

from graphkin.account.headings import number, written
from graphkin.account.notation import Letters, force_letters
from graphkin.construction.forces.force_sheet import ForceSheet
from graphkin.construction.sheet import Sheet
from graphkin.scene.loads import LoadOn, Phase, SpringOn
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.words import Neutral, Phrase
from graphkin.words.written import FINER, MOST, amount

__all__ = ["given_loads", "spring_lines"]


def given_loads(sheet: Sheet, letters: Letters) -> list[Phrase]:
    """Masses, weights, inertias, loads, springs and what balances, a line for each kind."""
    scene, loading = sheet.scene, sheet.scene.loading
    masses = list(_masses(scene, letters))
    return [
        *([reduce(lambda one, other: Phrase("given masses", (one, other)), masses)] if masses else []),
        *(_load(scene, load, letters) for load in loading.loads),
        *(_spring_given(scene, spring, letters) for spring in loading.springs),
        _balance(scene, letters),
    ]


def _masses(scene: Mechanism, letters: Letters) -> Iterator[Phrase]:
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
        yield Phrase("given mass", (Neutral(said), where))


def _load(scene: Mechanism, load: LoadOn, letters: Letters) -> Phrase:
    units = scene.units
    name = f"${force_letters(letters.convention, Symbol('P', name=load.name, turning=not load.is_force))}$"
    size = Neutral(f"{name} = {number(load.size / units.newtons)} {units.force}" + ("" if load.is_force else "·m"))
    if not load.is_force:
        said = Phrase("given moment", (size, load.link))
    elif load.against:
        said = Phrase("given against", (size, load.link, load.against))
    else:
        angle = number(math.degrees(math.atan2(load.turn.imag, load.turn.real)), 5)
        key = "given following" if load.follows else "given force"
        said = Phrase(key, (size, load.link, angle, load.follows))
    return said if load.phase is None else Phrase("given while", (said, _phase(scene, load.phase)))


def _phase(scene: Mechanism, phase: Phase) -> Phrase:
    if phase.stroke:
        key = "given on stroke" if phase.sense > 0 else "given on stroke back"
        return Phrase(key, (phase.stroke, number(phase.start), number(phase.end)))
    driver = scene.drivers[0]
    if driver.turns:
        ends = (number(math.degrees(phase.start)) + "°", number(math.degrees(phase.end)) + "°")
    else:
        metres, unit = scene.units.metres, scene.units.length
        ends = (number(phase.start / metres), f"{number(phase.end / metres)} {unit}")
    return Phrase("given while driver", ends)


def _balance(scene: Mechanism, letters: Letters) -> Phrase:
    said = scene.loading.balance
    found = []
    if said is not None:
        found.append(Symbol("M" if said.kind == "moment" else "F", link=said.link))
    else:
        for driver in scene.drivers:
            if driver.turns:
                found.append(Symbol("M", link=driver.link))
            else:
                of = next((p.of for p in scene.pins if p.key == driver.key), driver.key.partition("/")[0])
                found.append(Symbol("F", link=of))
    names = ", ".join(f"${force_letters(letters.convention, s)}$" for s in found)
    return Phrase("given balance", (names,))


def _spring_given(scene: Mechanism, spring: SpringOn, letters: Letters) -> Phrase:
    """What is given of a spring, in words with symbols."""
    units = scene.units
    one, two = (f"${letters.point(point)}$" for point in spring.points)
    rate = Neutral(f"{number(spring.rate * units.metres / units.newtons)} {units.force}/{units.length}")
    free = Neutral(f"{number(spring.free / units.metres)} {units.length}")
    preload = Neutral(f"{number(spring.preload / units.newtons)} {units.force}")
    name = f"${force_letters(letters.convention, Symbol('P', name=spring.name))}$"
    told = (spring.name, one, spring.links[0], two, spring.links[1], rate, free, preload, name)
    return Phrase("given spring", told)


def _pull(start: str, rate: str, length: str, free: str) -> float:
    """What the numbers come to as they are written, to as many figures as computed numbers have."""
    return float(amount(float(start) + float(rate) * (float(length) - float(free)), MOST))


def spring_lines(sheet: Sheet, forces: ForceSheet, letters: Letters) -> Iterator[Phrase]:
    """The force of each spring from its length as it was measured."""
    units = sheet.scene.units
    for spring in sheet.scene.loading.springs:
        name = Symbol("P", name=spring.name)
        own, other = (one for one in forces.states[0].known if one.symbol == name)
        length = abs(other.at - own.at) * sheet.scales.length
        force = spring.preload + spring.rate * (length - spring.free)
        start, rate = amount(spring.preload / units.newtons), amount(spring.rate * units.metres / units.newtons)
        free, pull = amount(spring.free / units.metres), amount(force / units.newtons, MOST)
        tried = [amount(length / units.metres, carried) for carried in FINER]
        told_length = next((one for one in tried if _pull(start, rate, one, free) == float(pull)), tried[0])
        preload = f"{written(start)} + " if spring.preload else ""
        stretch, rate = f"({written(told_length)} − {written(free)})", written(rate)
        size = f"{written(pull)} {units.force}"
        markup = force_letters(letters.convention, name)
        ends = "".join(letters.point(p) for p in spring.points)
        total = Neutral(f"${markup}$ = {preload}{rate} × {stretch} = {size}")
        key = "force spring" if force >= 0 else "force spring pushes"
        yield Phrase(key, ends=ends, sum=total, link=spring.links[0])
