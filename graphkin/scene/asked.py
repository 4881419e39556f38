"""The questions of a scene file, the values published for it, and the positions and loops that it names."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from typing import TYPE_CHECKING, Literal

from graphkin.errors import Problem, did_you_mean
from graphkin.scene.bodies import Reading
from graphkin.scene.model import Driver, Mechanism, StatedValues
from graphkin.scene.scene_tables import Positions, StrokeStart
from graphkin.scene.symbol import Printed, Symbol, centre_links, no_quantity, stated
from graphkin.scene.tables import Units, path_name
from graphkin.words import Phrase, listed

if TYPE_CHECKING:
    # all the ways in which people write are loaded where somebody wrote otherwise than a symbol and its number
    from graphkin.scene.spelling import Spelling

BY = ("drawing", "computation")
Stated = float | str | Sequence[float]


# quantities


def known_symbol(where: str, text: str, scene: Mechanism | Reading, drawn: bool = True) -> Symbol | list[Problem]:
    """The quantity of a scene that a name means, or the problems with the name.

    Parameters
    ----------
    where : where the name stands, as problems tell it
    drawn : whether it is asked of a drawing, which has neither places nor rates of sliding pairs by themselves
    """
    try:
        symbol = Symbol.parse(text)
    except ValueError as error:
        return [Problem(where, error.args[0])]
    if drawn and symbol.kind == "place" and symbol.of and scene.no_point(where, symbol.of.point):
        return [Problem(where, no_quantity(text))]
    pair = symbol.of_pair
    if pair and scene.no_point(where, pair.other) and not scene.no_link(where, pair.other):
        if symbol.axis:
            return [Problem(where, Phrase("is no vector", text=pair))]
        symbol = pair
    of, to = symbol.of, symbol.to
    missing = [scene.no_link(where, name) for name in symbol.links()]
    slides = symbol.is_rate_of_pair or symbol.kind in ("s", "stroke", "K", "theta_lag")
    if slides and symbol.other and symbol.link[:1].isupper() and missing[0]:  # of a pin in a slot
        missing[0] = scene.no_point(where, symbol.link)
    missing += [scene.no_point(where, ref.point) for ref in (of, to)
                if ref and not (symbol.kind == "d" and centre_links(ref.point, scene.points))]
    problems = [problem for problem in missing if problem is not None]
    if problems:
        return problems
    nowhere = scene.no_position(where, symbol.at) if symbol.at else None
    if nowhere:
        return [nowhere]
    if of and to == of:
        return [Problem(where, "is relative to itself", "name two different points", text=text)]
    if symbol.kind in ("ak", "ar") and of and to and to.point != of.point:
        return [Problem(where, "names two different points", "it is between coincident points of two links", text=text,
                        kind=symbol.kind)]
    if drawn and symbol.is_of_tables:
        keys = [pair.key for pair in scene.slides]
        on_outline = scene.contact_at and not scene.no_point(where, symbol.link)
        if symbol.is_rate_of_pair and symbol.pair not in keys and not on_outline:
            known = Phrase("known here", names=listed(keys)) if keys else Phrase("nothing slides here")
            return [Problem(where, "there is no such sliding pair", known)]
        return [Problem(where, "is given by tables alone", "ask a drawing for", text=text,
                        instead=_drawn_instead(symbol, scene))]
    return symbol


def _drawn_instead(symbol: Symbol, scene: Mechanism | Reading) -> str:
    """The quantities of a drawing that tell one that only tables give."""
    if symbol.axis:
        return str(symbol.whole)
    if symbol.entry.instead and symbol.of:
        return symbol.entry.instead.format(point=symbol.of.point, names=str(symbol).partition("_")[2])
    pair = next((pair for pair in scene.slides if pair.key == symbol.pair), None)
    if pair is None:  # of a point on an outline
        return f"{symbol.kind}_{symbol.link}/{symbol.link}@{symbol.other}"
    point = pair.pin or next(iter(scene.points.get(pair.body, ())), "B")
    return f"{symbol.kind}_{point}@{pair.body}/{point}@{symbol.other}"


def spelling_of(scene: Mechanism | Reading) -> Spelling:
    """The reader of a scene's quantities by names as people write them."""
    from graphkin.scene.spelling import Spelling

    owners: dict[str, frozenset[str]] = dict.fromkeys(scene.contact_at, frozenset())
    for link, names in scene.points.items():
        for name in names:
            owners[name] = owners.get(name, frozenset()) | {link}
    return Spelling(owners, frozenset(scene.points), scene.units)


def asked(reading: Reading) -> tuple[Symbol, ...]:
    """The symbols of ``find``, each once, in its order; their problems are noted."""
    symbols = [known_symbol(path_name(("find", text)), text[:120], reading) for text in reading.file.find or ()]
    reading.wrong(*(symbol[0] for symbol in symbols if not isinstance(symbol, Symbol)))
    return tuple(dict.fromkeys(symbol for symbol in symbols if isinstance(symbol, Symbol)))


def stated_values(reading: Reading) -> tuple[StatedValues, ...]:
    """All stated values: ``[printed]``, ``[[printed_rows]]``, and the file of ``[printed_table]``; their problems are
    noted."""
    file, positions = reading.file, reading.positions
    stated = []

    def how(table: str, by: object) -> Literal["drawing", "computation"] | None:
        if by not in BY:
            reading.say(f"{table}.by", "found value", "one of drawing computation is possible", value=f"{by!r:.40}")
            return None
        return "computation" if by == "computation" else "drawing"

    usual = how("printed", file.printed.get("by", "drawing")) or "drawing"
    values = _values("printed", file.printed, reading)
    if values:
        stated.append(StatedValues(None, values, usual))
    for number, row in enumerate(file.printed_rows, 1):
        where, at = f"printed_rows.{number}", row.get("at")
        if not isinstance(at, int | float | str):
            said = Phrase("is missing") if at is None else Phrase("is two numbers")
            if not reading.lost_under("printed_rows", number - 1, "at"):
                reading.say(f"{where}.at", said, "write the driver's value or the name of")
        elif isinstance(at, str) and at not in positions:
            unnamed = Phrase("name positions in positions or write a driver")
            wanted = did_you_mean(at, positions) if positions else unnamed
            reading.say(f"{where}.at", "there is no position", wanted, at=at)
        elif by := how(where, row.get("by", usual)):
            stated.append(StatedValues(at, _values(where, row, reading), by))
    if file.printed_table is not None:
        stated.append(StatedValues(None, {}, file.printed_table.by, file.printed_table.file))
    return tuple(stated)


def _values(table: str, values: Mapping[str, Stated], reading: Reading) -> dict[Symbol, Printed]:
    """Stated values by symbol, each as a number or as people write it in a cell (``"0.483 m/s"``, ``"2.82 cw"``).

    A name that is no symbol may be a spelling of one, with a unit (``ω₃``, ``"v_B (m/s)"``).
    """
    printed: dict[Symbol, Printed] = {}
    for text, value in values.items():
        if text in ("by", "at"):
            continue
        where = path_name((*table.split("."), text))
        symbol, unit = known_symbol(where, text[:120], reading), ""
        if not isinstance(symbol, Symbol):
            spelling = spelling_of(reading)
            name, unit = spelling.head(text)
            meant = spelling.symbol(name)
            symbol = symbol if meant is None else known_symbol(where, str(meant), reading)
        if not isinstance(symbol, Symbol):
            reading.wrong(symbol[0])
        elif symbol in printed:
            reading.say(where, "is given twice", "give it once", symbol=symbol)
        elif not isinstance(value, int | float | str) and not symbol.is_vector:
            reading.say(where, "found two numbers", "it is one number no vector")
        else:
            try:
                printed[symbol] = _printed(symbol, value, unit, reading.units)
            except ValueError as error:
                like = "-1220 mm/s" if symbol.is_vector else "2.82 cw"
                reading.say(where, error.args[0], "write a number its digits as printed 1.0", example=like)
    return printed


def _printed(symbol: Symbol, value: Stated, unit: str, units: Units) -> Printed:
    """One stated value.  Raises ValueError for a text that is none."""
    if isinstance(value, str) or unit:
        from graphkin.scene.spelling import read_cell, unit_factor
    if isinstance(value, str):
        plain = value.strip()
        read = read_cell(plain, symbol, units, unit)
        bare = plain.replace("\u2212", "-") in read.texts and not unit  # nothing but digits, in scene units
        return replace(read, shown="") if bare else read
    texts = [_digits_of(value)] if isinstance(value, int | float) else [_digits_of(part) for part in value]
    return stated(symbol, texts, units, unit_factor(unit, symbol, units) if unit else None)


def _digits_of(number: float) -> str:
    """The text of a number that lost its last zeros in a file or a computation; nobody prints more than 12 digits."""
    text = f"{number:.12g}"
    tiny = abs(number) < 1e-12  # written out it would be longer than a number may be
    return text if "e" not in text or tiny or not math.isfinite(number) else format(Decimal(text), "f")


# positions and loops


def positions_named(table: Positions, reading: Reading) -> Positions:
    """The positions that a scene names, in SI; their problems are noted."""
    slides = reading.along
    if any(driver.law is not None for driver in reading.drivers.values()):
        reading.say("positions", "stand beside a driver with a law", "name a moment at time 0.25")
    if slides and (table.count or table.first is not None):
        reading.say(f"positions.{'count' if table.count else 'first'}", "the driver slides it makes no turn",
                    "name its positions in positions.also by travel")

    def place(where: str, value: float | StrokeStart) -> float | StrokeStart:
        if not isinstance(value, StrokeStart):
            return value * reading.metres if slides else math.radians(value)
        if value.stroke not in reading.pairs and not reading.is_unread(value.stroke):
            reading.say(f"{where}.stroke", "there is no sliding pair of stroke",
                        did_you_mean(value.stroke, reading.pairs), stroke=value.stroke)
        if slides:
            reading.say(where, "the driver slides there is no stroke of", "give a travel")
        return value

    first = None if table.first is None else place("positions.first", table.first)
    also = {name: place(f"positions.also.{name}", value) for name, value in table.also.items()}
    for name in table.also:
        if name in table.names[: table.count or 0]:
            reading.say(f"positions.also.{name}", "is one of the numbered ones", "give it another name",
                        count=table.count)
    show = tuple(map(str, table.show))
    known = ("limits", "all", *table.names)
    for name in show:
        if name not in known:
            reading.say("positions.show", "there is no position", did_you_mean(name, known), at=name)
    return replace(table, count=table.count or 0, first=first, also=also, show=show)


def at_its_position(driver: Driver, positions: Positions) -> Driver:
    """A driver at the position that it names, if its value does not follow from a stroke."""
    first = positions.first if isinstance(positions.first, float) else None
    place = positions.place(driver.position, first, -1.0 if driver.rate < 0 else 1.0)
    return driver.at_value(place) if isinstance(place, float) else driver


def loops_named(reading: Reading) -> dict[str, tuple[str, ...]]:
    """The vector loops that a scene names; problems of their points are noted."""
    loops = reading.file.loops
    for name, points in loops.items():
        where = f"loops.{name}"
        reading.wrong(*(reading.no_point(where, point) for point in points))
        if len(points) < 3:
            reading.say(where, "has points", "a loop goes through three points or more", count=len(points))
        elif len(set(points)) < len(points):
            reading.say(where, "comes twice to one point", "name each point once it closes by itself")
    return {name: tuple(points) for name, points in loops.items()}
