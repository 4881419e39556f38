"""What a scene asks for, what was published about it, and the positions and loops that it names."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from typing import Literal

from graphkin.errors import Problem, did_you_mean
from graphkin.scene.asked_tables import Positions, StrokeStart
from graphkin.scene.model import NamedPositions, OnStroke, PinInSlot, SlidingPair, StatedValues
from graphkin.scene.names import Names
from graphkin.scene.printed import Printed, stated
from graphkin.scene.reading import path_name
from graphkin.scene.spelling import Spelling, unit_factor
from graphkin.scene.symbol import Symbol, missing_names
from graphkin.scene.tables import DrivenSlide, SceneTables, Units
from graphkin.words import Phrase

__all__ = ["asked", "loops_named", "position_name", "positions_named", "stated_values"]

BY = ("drawing", "computation")
Stated = float | str | Sequence[float]


def position_name(name: str | int) -> str:
    """The name of a position, which a file may write as a number."""
    return str(name)


def _symbol(where: str, text: str, names: Names, known: Sequence[str]) -> Symbol | Problem:
    """A symbol whose points, links and position exist, or what is wrong with it."""
    try:
        symbol = Symbol.parse(text[:120])
    except ValueError as error:
        return Problem(where, error.args[0])
    missing = missing_names(
        symbol, lambda link: names.no_link(where, link), lambda point: names.no_point(where, point), names.points
    )
    if missing:
        return missing[0]
    if symbol.at and symbol.at not in known:
        wanted = did_you_mean(symbol.at, known) if known else Phrase("name positions in positions")
        return Problem(where, Phrase("there is no position", at=symbol.at), wanted)
    if symbol.of is None:
        return symbol
    if symbol.to == symbol.of:
        return Problem(where, Phrase("is relative to itself", text=text), Phrase("name two different points"))
    if symbol.kind in ("ak", "ar") and symbol.to and symbol.to.point != symbol.of.point:
        return Problem(
            where,
            Phrase("names two different points", text=text),
            Phrase("it is between coincident points of two links", kind=symbol.kind),
        )
    return symbol


def asked(file: SceneTables, names: Names, problems: list[Problem]) -> tuple[Symbol, ...]:
    """The symbols of ``find``, each once, in its order."""
    known = _names_of(file.positions)
    found = [_symbol(path_name(("find", text)), text, names, known) for text in file.find or ()]
    problems += [s for s in found if isinstance(s, Problem)]
    return tuple(dict.fromkeys(s for s in found if isinstance(s, Symbol)))


def stated_values(file: SceneTables, names: Names, problems: list[Problem]) -> tuple[StatedValues, ...]:
    """All values that somebody states: ``[printed]``, ``[[printed_rows]]``, and the file of ``[printed_table]``."""
    known = _names_of(file.positions)
    spelling = Spelling.by_link(names.points, file.units, names.contacts)
    by = file.printed.get("by", "drawing")
    if by not in BY:
        problems.append(
            Problem(
                "printed.by",
                Phrase("found value", value=f"{by!r:.40}"),
                Phrase("one of drawing computation is possible"),
            )
        )
        by = "drawing"
    found = []
    own = _texts("printed", file.printed, names, known, spelling, problems)
    if own:
        found.append(StatedValues(None, own, _how(by)))
    for number, row in enumerate(file.printed_rows, 1):
        where = f"printed_rows.{number}"
        at, how = row.get("at"), row.get("by", by)
        if not isinstance(at, int | float | str):
            problems.append(Problem(f"{where}.at", Phrase("is missing") if at is None else Phrase("is two numbers"),
                                    Phrase("write the driver's value or the name of")))  # fmt: skip
            continue
        if isinstance(at, str) and at not in known:
            wanted = did_you_mean(at, known) if known else Phrase("name positions in positions or write a driver")
            problems.append(Problem(f"{where}.at", Phrase("there is no position", at=at), wanted))
            continue
        if how not in BY:
            problems.append(
                Problem(
                    f"{where}.by",
                    Phrase("found value", value=f"{how!r:.40}"),
                    Phrase("one of drawing computation is possible"),
                )
            )
            continue
        found.append(StatedValues(at, _texts(where, row, names, known, spelling, problems), _how(how)))
    if file.printed_table is not None:
        found.append(StatedValues(None, {}, file.printed_table.by, file.printed_table.file))
    return tuple(found)


def _how(by: object) -> Literal["drawing", "computation"]:
    return "computation" if by == "computation" else "drawing"


def _texts(
    table: str, values: Mapping[str, Stated], names: Names, known: Sequence[str], spelling: Spelling,
    problems: list[Problem],
) -> dict[Symbol, Printed]:  # fmt: skip
    """Stated values by symbol, each as a number or as people write it in a cell (``"0.483 m/s"``, ``"2.82 cw"``).

    A name that is no symbol may be one as people spell it, with a unit (``ω₃``, ``"v_B (m/s)"``).
    """
    found: dict[Symbol, Printed] = {}
    for text, value in values.items():
        if text in ("by", "at"):
            continue
        where = path_name((*table.split("."), text))
        symbol = _symbol(where, text, names, known)
        name, unit = spelling.head(text) if isinstance(symbol, Problem) else (text, "")
        meant = spelling.symbol(name) if isinstance(symbol, Problem) else None
        if meant is not None:
            symbol = _symbol(where, str(meant), names, known)
        if isinstance(symbol, Problem):
            problems.append(symbol)
        elif symbol in found:
            problems.append(Problem(where, Phrase("is given twice", symbol=symbol), Phrase("give it once")))
        elif not isinstance(value, int | float | str) and not symbol.is_vector:
            problems.append(Problem(where, Phrase("found two numbers"), Phrase("it is one number no vector")))
        else:
            try:
                found[symbol] = _printed(symbol, value, unit, spelling.units)
            except ValueError as error:
                like = "-1220 mm/s" if symbol.is_vector else "2.82 cw"
                wanted = Phrase("write a number its digits as printed 1.0", example=like)
                problems.append(Problem(where, error.args[0], wanted))
    return found


def _printed(symbol: Symbol, value: Stated, unit: str, units: Units) -> Printed:
    """One stated value.  Raises ValueError for a text that is none."""
    if isinstance(value, str):
        from graphkin.scene.spelling import read_cell  # only a text needs all the ways in which people write

        plain = value.strip()
        read = read_cell(plain, symbol, units, unit)
        bare = plain.replace("\u2212", "-") in read.texts and not unit  # nothing but digits, in scene units
        return replace(read, shown="") if bare else read
    texts = [_digits_of(value)] if isinstance(value, int | float) else [_digits_of(part) for part in value]
    factor = unit_factor(unit, symbol, units) if unit else None
    return stated(symbol, texts, units, factor)


def _digits_of(number: float) -> str:
    """The text of a number that lost its last zeros in a file or a computation; nobody prints more than 12 digits."""
    text = f"{number:.12g}"
    tiny = abs(number) < 1e-12  # written out it would be longer than a number may be
    return text if "e" not in text or tiny or not math.isfinite(number) else format(Decimal(text), "f")


# -- positions and loops -----------------------------------------------------------------------------------------------


def _names_of(table: Positions | None) -> tuple[str, ...]:
    if table is None:
        return ()
    return *(str(k) for k in range(1, (table.count or 0) + 1)), *table.also


def positions_named(
    file: SceneTables, slidings: Sequence[SlidingPair], pins: Sequence[PinInSlot], metres: float,
    problems: list[Problem],
) -> NamedPositions | None:  # fmt: skip
    """The positions that a scene names; what is wrong with them is added to ``problems``."""
    table = file.positions
    if table is None:
        return None
    first_driver = file.drivers[0] if file.drivers else None
    slides = isinstance(first_driver, DrivenSlide)
    if any(driver.law is not None for driver in file.drivers):
        problems.append(
            Problem("positions", Phrase("stand beside a driver with a law"), Phrase("name a moment at time 0.25"))
        )
    pairs = [*(p.key for p in slidings), *(p.key for p in pins)]
    if slides and (table.count or table.first is not None):
        key = "count" if table.count else "first"
        problems.append(Problem(f"positions.{key}", Phrase("the driver slides it makes no turn"),
                                Phrase("name its positions in positions.also by travel")))  # fmt: skip

    def place(where: str, value: float | StrokeStart) -> float | OnStroke:
        if not isinstance(value, StrokeStart):
            return value * metres if slides else math.radians(value)
        if value.stroke not in pairs:
            wanted = did_you_mean(value.stroke, pairs)
            problems.append(
                Problem(f"{where}.stroke", Phrase("there is no sliding pair of stroke", stroke=value.stroke), wanted)
            )
        if slides:
            problems.append(Problem(where, Phrase("the driver slides there is no stroke of"), Phrase("give a travel")))
        return OnStroke(value.stroke, value.at, value.sense)

    count = table.count or 0
    first = None if table.first is None else place("positions.first", table.first)
    also = {name: place(f"positions.also.{name}", value) for name, value in table.also.items()}
    names = _names_of(table)
    for name in table.also:
        if name in names[:count]:
            problems.append(Problem(f"positions.also.{name}", Phrase("is one of the numbered ones", count=count),
                                    Phrase("give it another name")))  # fmt: skip
    show = tuple(map(position_name, table.show))
    for name in show:
        if name not in ("limits", "all", *names):
            problems.append(Problem("positions.show", Phrase("there is no position", at=name),
                                    did_you_mean(name, ("limits", "all", *names))))  # fmt: skip
    return NamedPositions(count, first, also, show, tuple(table.marks))


def loops_named(file: SceneTables, names: Names, problems: list[Problem]) -> dict[str, tuple[str, ...]]:
    """The vector loops that a scene names, whose points exist."""
    for name, points in file.loops.items():
        where = f"loops.{name}"
        problems += [p for point in points if (p := names.no_point(where, point))]
        if len(points) < 3:
            problems.append(
                Problem(
                    where, Phrase("has points", count=len(points)), Phrase("a loop goes through three points or more")
                )
            )
        elif len(set(points)) < len(points):
            problems.append(
                Problem(where, Phrase("comes twice to one point"), Phrase("name each point once it closes by itself"))
            )
    return {name: tuple(points) for name, points in file.loops.items()}
