"""Titles, driver values and other words at the head of a figure, in one language or both."""

from __future__ import annotations

import math

from graphkin.drafting.sheet import DiagramName, Sheet
from graphkin.drawing.conventions import Letters
from graphkin.scene.model import AngleDriver
from graphkin.version import __version__
from graphkin.words import languages, word

__all__ = ["drivers", "facts", "number", "rates", "term", "titles"]


def term(key: str, language: str) -> str:
    """A word in a language; both beside each other for "both"."""
    return " ".join(dict.fromkeys(word(key, each) for each in languages(language)))


def titles(sheet: Sheet, language: str) -> tuple[str, ...]:
    """Title of the scene, one for each language that it has one in."""
    scene = sheet.scene
    return tuple(dict.fromkeys(_plain(scene.title_in(each) or scene.name) for each in languages(language)))


def number(value: float, digits: int = 6) -> str:
    """A number for people: no exponent where it can be helped, a true minus sign.

    >>> number(-10.0), number(0.1230)
    ('−10', '0.123')
    """
    text = f"{value:.{digits}g}"
    if "e" in text:
        head, power = text.split("e")
        return f"{head}·$10^{{{int(power)}}}$".replace("-", "−")
    return "0" if text == "-0" else text.replace("-", "−")


def drivers(sheet: Sheet, letters: Letters) -> str:
    """Driver values with their rates, as words with symbols between dollar signs."""
    scene = sheet.scene
    unit, metres = scene.units.length, scene.units.metres
    parts = []
    for driver in scene.drivers:
        value = sheet.drivers[driver.key]
        _, rate, second = driver.values
        if isinstance(driver, AngleDriver):
            index = driver.link if driver.relative_to == scene.frame.name else driver.link + driver.relative_to
            parts.append(f"$φ_{{{index}}}$ = {number(math.degrees(value))}°")
            parts.append(f"$ω_{{{index}}}$ = {number(rate)} rad/s")
            if second:
                parts.append(f"$α_{{{index}}}$ = {number(second)} rad/s²")
        else:
            index = _slide_index(sheet, driver.key)
            v, a = ("V", "A") if letters.convention == "us" else ("v", "a")
            parts.append(f"$s_{{{index}}}$ = {number(value / metres)} {unit}")
            parts.append(f"${v}_{{{index}}}$ = {number(rate / metres)} {unit}/s")
            if second:
                parts.append(f"${a}_{{{index}}}$ = {number(second / metres)} {unit}/s²")
    return ",  ".join(parts)


def _slide_index(sheet: Sheet, key: str) -> str:
    sliding, guiding = key.split("/")
    return sliding if guiding == sheet.scene.frame.name else sliding + guiding


def rates(sheet: Sheet, diagram: DiagramName) -> list[tuple[str, str]]:
    """Measured angular velocities or accelerations: symbol and value with its sense, one for each turning motion."""
    own = sheet.omega if diagram == "velocity" else sheet.alpha
    sign, unit = ("ω", "rad/s") if diagram == "velocity" else ("α", "rad/s²")
    rows = []
    for link, rate in own.items():
        if rate.vector is None or rate.same_as or "/" in link:
            continue
        same = [n for n, r in own.items() if r.same_as == link and r.value == rate.value and "/" not in n]
        symbol = " = ".join(f"{sign}_{{{name}}}" for name in (link, *same))
        rows.append((symbol, f"{number(rate.value, 5)} {unit}"))
    return rows


def facts(sheet: Sheet, figure: str) -> dict[str, object]:
    """What a program may want to know of a figure, in scene units: for the metadata of the file."""
    scene = sheet.scene
    metres = scene.units.metres
    at = {
        d.key: round(value if not isinstance(d, AngleDriver) else math.degrees(sheet.drivers[d.key]), 9)
        for d in scene.drivers
        for value in (sheet.drivers[d.key] / metres,)
    }
    scales = {
        "length": float(f"{sheet.scales.length / metres:.12g}"),
        "velocity": float(f"{sheet.scales.velocity / metres:.12g}"),
        "acceleration": float(f"{sheet.scales.acceleration / metres:.12g}"),
    }
    return {
        "figure": figure,
        "scene": scene.name,
        "units": {"length": scene.units.length, "time": "s", "angle": "deg", "paper": "mm"},
        "at": at,
        "scales": scales,
        "instrument": sheet.instrument,
        "graphkin": __version__,
    }


def _plain(text: str) -> str:
    return text.replace("$", "$$")
