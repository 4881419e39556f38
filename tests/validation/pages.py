"""Problems of textbooks as pages: what a page says, and what graphkin answers to it.

A page (``problems/*.md``) tells the problem in words, its source, and in a table each value with what is asked of
graphkin: the command whose result has it, and what of that result.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import graphkin
from graphkin.scene import mechanism_of

__all__ = ["PAGES", "PROBLEMS", "Page", "Value", "answer"]

PROBLEMS = Path(__file__).parent / "problems"
UNITS = {"1": 1.0, "mm": 1e-3, "mm/s": 1e-3, "mm/s2": 1e-3, "m/s": 1.0, "m/s2": 1.0, "deg": math.pi / 180, "rad/s": 1.0,
         "rad/s2": 1.0}


@dataclass(frozen=True)
class Value:
    """A line of a page's table, its numbers as the texts that stand there; ``at`` is the driver's value."""

    scene: str
    quantity: str
    asked: str
    at: float | None
    unit: str
    printed: str
    exact: str
    verdict: str

    @property
    def room(self) -> float:
        """Half a unit of the last digit of the exact value, which is exact where it has no decimals (SI)."""
        decimals = len(self.exact.partition(".")[2])
        least = 1e-9 * max(1.0, abs(float(self.exact)))
        return UNITS[self.unit] * (0.501 * 10**-decimals if decimals else least)

    @property
    def si(self) -> float:
        """The exact value (SI)."""
        return float(self.exact) * UNITS[self.unit]

    def __str__(self) -> str:
        place = "" if self.at is None else f" at {self.at:g}"
        said = f", printed {self.printed} is {self.verdict}" if self.printed else ""
        return f"{self.scene}: {self.quantity}{place} is {self.exact} {self.unit}{said}"


@dataclass(frozen=True)
class Page:
    """A problem: its title, its source, the scene that comes along for it, its values."""

    path: Path
    title: str
    source: str
    scene: str
    values: tuple[Value, ...]


def read_page(path: Path) -> Page:
    text = path.read_text(encoding="utf-8")
    (title,) = re.findall(r"(?m)^# (.+)$", text)
    (source,) = re.findall(r"(?ms)^Source: (.+?)\n\n", text)
    (scene,) = re.findall(r"(?m)^Scene: `(.+)`$", text)
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in re.findall(r"(?m)^\|.*\|$", text)]
    values = []
    for line in lines[2:]:
        row = dict(zip(lines[0], line, strict=True))
        at = float(row["at"]) if row.get("at") else None
        values.append(Value(scene, row["quantity"], row["asked of graphkin"].strip("`"), at, row["unit"],
                            row["printed"], row["exact"], row["verdict"]))
    return Page(path, title, source, scene, tuple(values))


PAGES = [read_page(path) for path in sorted(PROBLEMS.glob("*.md"))]


@cache
def _data(command: str, scene: str, at: float | None) -> dict[str, Any]:
    """What a command prints under --json."""
    if command == "sweep":
        return graphkin.sweep(scene, positions=1).data
    if command == "check":
        here = [v for page in PAGES for v in page.values if (v.scene, v.at) == (scene, at)]
        symbols = [v.asked.removeprefix("check ") for v in here if v.asked.startswith("check ")]
        return graphkin.check(scene, at=at, find=symbols).data
    return getattr(graphkin, command)(scene, at=at).data


@cache
def _metres(scene: str) -> float:
    """The length unit of a scene."""
    return mechanism_of(scene).units.metres


def _check(scene: str, at: float | None, symbol: str) -> float:
    (row,) = [r for r in _data("check", scene, at)["readings"] if r["symbol"] == symbol]
    return row["measured"] * (1.0 if symbol.startswith(("omega", "alpha")) else _metres(scene))


def _solve(scene: str, at: float | None, what: str, *names: str) -> float:
    position = _data("solve", scene, at)["positions"][0]
    metres = _metres(scene)

    def point(name: str, kind: str = "position") -> complex:
        return next(complex(*p[kind]) * metres for key, p in position["points"].items() if key.split("@")[0] == name)

    if what == "theta":
        angles = [position["links"][name]["angle"] for name in names]
        return angles[0] - sum(angles[1:])
    if what == "s":
        return position["slides"][names[0]]["travel"] * metres
    if what == "d":
        return abs(point(names[0]) - point(names[1]))
    vector = point(names[0], {"v": "velocity", "a": "acceleration"}.get(what[:-1], "position"))
    return vector.real if what[-1] == "x" else vector.imag


def _centres(scene: str, at: float | None, what: str, along: str = "") -> float:
    data = _data("centres", scene, at)
    if not along:
        return data["velocities"][what]["by_centres"]
    return data["centres"][what]["point"]["xy".index(along)] * _metres(scene)


def _sweep(scene: str, _: float | None, what: str, of: str = "", place: str = "") -> float:
    data = _data("sweep", scene, None)
    if what == "range":
        (reached,) = [r for r in data["ranges"] if r["reached"]]
        return reached[of]
    if what == "turning":
        return len(data["mechanisms"][0]["turn_fully"])
    if what in ("transmission", "pressure"):
        (row,) = [r for r in data["transmission"] if "-".join(r["links"]) == of]
        return row["greatest_pressure_angle" if what == "pressure" else "driver" if place else "least_angle"]
    (output,) = [o for o in data["outputs"] if of in (o.get("slide"), o.get("link"))]
    metres = _metres(scene)
    if what in ("limit", "least", "greatest"):
        kind = place or {"least": "min", "greatest": "max"}[what]
        (limit,) = [x for x in output["limit_positions"] if x["kind"] == kind]
        return limit["driver"] if what == "limit" else limit["value"] * metres
    return output[what] * (metres if what == "stroke" else 1.0)


ANSWERS: dict[str, Callable[..., float]] = {"check": _check, "solve": _solve, "centres": _centres, "sweep": _sweep}


def answer(value: Value) -> float:
    """What graphkin says (SI): of ``check`` what is measured on the drawing."""
    command, *what = value.asked.split()
    return ANSWERS[command](value.scene, value.at, *what)
