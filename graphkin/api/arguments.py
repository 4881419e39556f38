"""Arguments of the public functions: formats, language, convention, instrument, by their words;

a scene in any of its forms, driver values in the driver's own unit, symbols by name, and a folder for the files of the
result.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from importlib.util import find_spec
from numbers import Integral, Real
from pathlib import Path
from typing import TYPE_CHECKING, get_args

from graphkin.errors import CallError, Problem, as_list, did_you_mean, unfit
from graphkin.files import path_of
from graphkin.scene.asked import known_symbol
from graphkin.scene.drivers import at_time
from graphkin.scene.model import Mechanism, force_of, no_force
from graphkin.scene.scene import SceneLike, mechanism_of, safe_name
from graphkin.scene.scene_tables import Convention, SheetWishes
from graphkin.scene.symbol import Symbol
from graphkin.structure import part_of
from graphkin.structure.assembly import ChangePoint
from graphkin.words import BOTH, LANGUAGES, Phrase, Wording, clauses, links_named, listed

if TYPE_CHECKING:
    from graphkin.construction import Instrument

FORMATS = ("svg", "pdf", "png", "dxf")
CHART_FORMATS = ("svg", "pdf", "png")
TEXTS = ("glyphs", "outlines")
TIME = "time"
INSTRUMENTS = ("exact", "cad", "pencil")
CONVENTIONS: tuple[str, ...] = get_args(Convention)
ON_SHEETS = (*LANGUAGES, BOTH)
"""Languages of figures and papers; a table or a report has one."""


def known_words(
    formats: Sequence[str] = FORMATS[:1],
    language: str | None = None,
    convention: str | None = None,
    instrument: str | None = None,
    *,
    text: str | None = None,
    known_formats: Sequence[str] = FORMATS,
    known_languages: Sequence[str] = LANGUAGES,
) -> None:
    """Refuse unknown words, all of them together; None is the scene's own word, or none.

    Raises
    ------
    CallError : every unknown word, with the nearest right one or all of them; no format at all
    """
    if isinstance(formats, str):
        raise CallError.of("format", "is a text", "give a list", formats=formats)
    if not isinstance(formats, Iterable):
        raise unfit("format", formats, "give a list of", names=listed(known_formats))
    formats = [*formats]
    wrong = unknown_words("format", formats, known_formats)
    for where, word, known in (
        ("lang", language, known_languages), ("convention", convention, CONVENTIONS),
        ("instrument", instrument, INSTRUMENTS), ("text", text, TEXTS),
    ):
        if word is not None:
            wrong += unknown_words(where, [word], known)
    if not formats:
        wrong.append(Problem("format", "none given", "known here", names=listed(known_formats)))
    if any(isinstance(word, str) and word == "dxf" for word in formats) and find_spec("ezdxf") is None:
        wrong.append(Problem("format", '"dxf"', "it needs the extra cad pip install graphkin"))
    if wrong:
        raise CallError(*wrong)


def unknown_words(where: str, words: Iterable[object], known: Iterable[str]) -> list[Problem]:
    """The problem of each unknown word, with the nearest right one or all of them."""
    known = list(known)
    return [
        Problem(where, f'"{word!s:.60}"', did_you_mean(str(word)[:60], known))
        for word in words
        if not isinstance(word, str) or word not in known
    ]


def known_workers(executor: object, workers: int | None) -> int | None:
    """The number of processes, if given.  Raises CallError outside 1 to 1024, and for an executor without submit."""
    workers = None if workers is None else whole_number("workers", workers, 1, 1024)
    if executor is not None and not hasattr(executor, "submit"):
        raise CallError.of("executor", "found value", "give one that has submit as those of", value=f"{executor!r:.60}")
    return workers


def whole_number(where: str, value: object, least: int, most: int, counted: str = "") -> int:
    """A whole number, also of NumPy; ``counted`` is the key of the counted things.  Raises CallError for another value,
    and outside the limits."""
    number = isinstance(value, Real) and not isinstance(value, bool)
    if number and isinstance(value, Integral) and least <= int(value) <= most:
        return int(value)
    if not number:
        given: Wording = Phrase("found value", value=f"{value!r:.60}")
    else:
        given = Phrase(counted, number=value) if counted else f"{value}"
    raise CallError.of(where, given, "give a whole number from to", least=least, most=most)


At = float | str | Mapping[str, float] | None
"""A value of the first driver in its own unit, the name of a position, or values by driver; of drivers with a law also
{"time": 0.25}, a moment (s)."""
MOST_DRAWN = 20
MOST_SEED = 10**18


def require_callable(where: str, function: object) -> None:
    """Refuse a value that is neither a function nor None.  Raises CallError."""
    if function is not None and not callable(function):
        raise unfit(where, function, "give a function or leave it out")


def as_scene(scene: SceneLike) -> Mechanism:
    """The mechanism of a file, of a bundled scene's name, of a mapping, or of a scene; a driver's value given from a
    dead point is found, and its rate from the speed of a point."""
    given = mechanism_of(scene)
    if any(d.position or (d.distance is not None and not d.exact) or d.given_speed for d in given.drivers):
        from graphkin.solver.path.named_positions import standing

        return standing(given)
    return given


def for_paper(scene: SceneLike, asked: Sequence[Symbol] = ()) -> Mechanism:
    """The scene, if it is small enough to be read on paper; else the part that leads to the asked quantities.  Raises
    CallError where that has more than 20 moving links."""
    given = as_scene(scene)
    if asked and len(given.links) > MOST_DRAWN:
        from graphkin.solver import structure_of

        given = part_of(structure_of(given), asked)
        ends = {point for link in given.links for point in link.points}
        ends |= {ref.point for symbol in asked for ref in (symbol.of, symbol.to) if ref is not None}
        bearings = {name: z for name, z in given.frame.points.items() if name in ends}
        given = replace(given, frame=replace(given.frame, points=bearings))
    if len(given.links) > MOST_DRAWN:
        raise CallError.of("links", "moving links are too many for a figure", "a sheet shows at most with find only",
                           count=len(given.links), most=MOST_DRAWN)
    return given


def driver_values(scene: Mechanism, at: At) -> dict[str, float] | None:
    """Driver values in SI from values in each driver's own unit (degrees, or travel in the scene's unit).

    A bare number moves the first driver, a text to the position of that name; a mapping names the drivers by link or by
    slide.

    Raises
    ------
    CallError : a driver that the scene does not have, a value that is no finite number
    """
    if at is None:
        return None
    if not scene.drivers:
        raise CallError.of("at", "the scene has no driver", "give one in the file")
    if isinstance(at, str):
        if scene.question.positions is None:
            raise CallError.of(Phrase("position", name=f"{at:.40}"), "the scene has no positions table",
                               "give a value of driver at 75 or", key=scene.drivers[0].key)
        return {scene.drivers[0].key: value_at(scene, at)}
    given = dict(at) if isinstance(at, Mapping) else {scene.drivers[0].key: at}
    # the whole key first: a link that slides may be turned too
    known = {d.key.split("/")[0]: d for d in reversed(scene.drivers)}
    known |= {d.key: d for d in scene.drivers}
    values: dict[str, float] = {}
    for name, value in given.items():
        driver = known.get(str(name))
        if driver is None:
            wanted = did_you_mean(str(name), [d.key for d in scene.drivers])
            raise CallError.of(f"at {name}", "no driver of that name", wanted)
        if isinstance(value, bool) or not isinstance(value, Real) or abs(value) > 1e9 or not math.isfinite(value):
            raise CallError.of(f"at {name}", "is no driver value of value", "give a finite number below 1e9",
                               value=f'{value!r:.60}')
        values[driver.key] = math.radians(value) if driver.turns else value * scene.units.metres
    return values


def placed(scene: Mechanism, at: At) -> tuple[Mechanism, dict[str, float] | None]:
    """A scene with the rates that its drivers have there, and driver values as `driver_values` gives them.

    Drivers that move by a law over time (``law``) have the rates of the asked moment, ``{"time": 0.25}``, or of the
    first moment at which they reach the asked value; the others keep their own rates.

    Raises
    ------
    CallError : as `driver_values`; a moment or a value outside the law
    """
    if at is None or all(d.law is None for d in scene.drivers):
        return scene, driver_values(scene, at)
    if isinstance(at, Mapping) and TIME in at and all(d.key != TIME for d in scene.drivers):
        if len(at) > 1:
            raise CallError.of(f"at {TIME}", "stands beside driver values", "give the time or values")
        time = at[TIME]
        if not isinstance(time, Real) or not math.isfinite(time):
            raise CallError.of(f"at {TIME}", "is no time", "give seconds", time=f'{time!r}')
        return at_time(scene, float(time))
    values = driver_values(scene, at) or {}
    drivers = []
    for driver in scene.drivers:
        law, value = driver.law, values.get(driver.key)
        if law is not None and value is not None:
            moment = law.reached(value)
            if moment is None:
                low, high = (scene.unit_of(driver).said(end) for end in law.span)
                raise CallError.of(f"at {driver.key}", "is not on its way", "its law goes from to",
                                   value=scene.unit_of(driver).said(value), least=low, greatest=high)
            driver = driver.moving(replace(law, time=moment))
        drivers.append(driver)
    return replace(scene, drivers=tuple(drivers)), values


def value_at(scene: Mechanism, name: str) -> float:
    """The value of the first driver (rad, m) at a position by its name.

    Raises
    ------
    CallError : the scene names no such position
    Unsolvable : it lies on the stroke of a slide, but the driver makes no whole turn
    """
    from graphkin.solver.path.named_positions import named_positions

    known = scene.question.positions.names if scene.question.positions else ()
    if name not in known:
        wanted = did_you_mean(name, known) if known else Phrase("name positions in positions")
        raise CallError.of(Phrase("position", name=name), "there is no position of that name", wanted)
    return named_positions(scene)[name]


def in_convention(scene: Mechanism, convention: str | None) -> Mechanism:
    """The scene with the letters and marks of a convention; its own if None.  Raises CallError for an unknown one."""
    if convention is None:
        return scene
    known_words(convention=convention)
    return scene.asking(sheet=replace(scene.question.sheet, convention=convention))  # type: ignore[arg-type]


def passed_words(scene: Mechanism, passed: Iterable[ChangePoint]) -> list[Phrase]:
    """The sentences on change points on the path: the branch kept, the reason, and how to ask for the other."""
    said = []
    for links in dict.fromkeys(point.links for point in passed):
        at = [zip(scene.drivers, point.values, strict=True) for point in passed if point.links == links]
        places = (listed([f"{d.key} = {scene.place_said(d, v)}" for d, v in values]) for values in at)
        said.append(Phrase("passed change point", links=links_named(links), places=clauses([*dict.fromkeys(places)])))
    return said


def asked_symbols(
    scene: Mechanism, find: str | Symbol | Iterable[str | Symbol] | None, drawn: bool = True
) -> tuple[Symbol, ...]:
    """The asked symbols: the given ones (or a single one), or the scene's own; loads by moments are marked.

    Parameters
    ----------
    drawn : whether they are asked of a drawing, which has neither places nor rates of sliding pairs by themselves

    Raises
    ------
    CallError : a symbol that names nothing in the scene
    """
    if find is None:
        return scene.question.find
    asked, problems = list[Symbol](), list[Problem]()
    for text in [find] if isinstance(find, Symbol) else as_list("find", find, Phrase("give symbols v_b omega_3")):
        where = f"find {text!s:.120}"
        symbol = known_symbol(where, str(text), scene, drawn)
        if not isinstance(symbol, Symbol):
            problems += symbol
        elif (no_such := no_force(scene, where, symbol)) is not None:
            problems.append(no_such)
        else:
            asked.append(force_of(scene, symbol) or symbol)
    if problems:
        raise CallError(*problems)
    return tuple(asked)


def drawn_symbols(scene: Mechanism, find: Iterable[str | Symbol] | None) -> tuple[Symbol, ...]:
    """The asked symbols, or the scene's own; of a scene with masses and loads forces are drawn then too."""
    asked = asked_symbols(scene, find)
    if find is not None or not asked or not scene.loading or any(s.scope == "force" for s in asked):
        return asked
    inertia = (Symbol("Fi", link=mass.link) for mass in scene.loading.masses)
    return *asked, *inertia, *scene.loading.applied


def hand_of(wishes: SheetWishes, name: str, seed: int) -> Instrument:
    """The instrument of a name, the pencil with the tools that are wished.  Raises CallError for an unknown name."""
    from graphkin.construction import EXACT, cad, pencil

    if not isinstance(name, str):
        raise unfit("instrument", name, "known here", names=listed(INSTRUMENTS))
    if name == "exact":
        return EXACT
    if name == "cad":
        return cad()
    if name == "pencil":
        return pencil(wishes.tools, whole_number("seed", seed, -MOST_SEED, MOST_SEED))
    raise CallError.of("instrument", f'"{name}"', did_you_mean(str(name), INSTRUMENTS))


def columns_shown(
    scene: Mechanism, find: str | Symbol | Iterable[str | Symbol] | None
) -> tuple[Symbol, ...]:
    """The quantities of names, as columns over the driver's range.  Raises CallError if one is of a single position."""
    shown = asked_symbols(scene, find, drawn=False)
    if elsewhere := [quantity for quantity in shown if quantity.at]:
        raise CallError(*(Problem(f"find {symbol}", Phrase("is of one position no column", position=symbol.at),
                                  Phrase("ask for it alone", symbol=symbol.here)) for symbol in elsewhere))
    return shown


def own_folder(folder: str | os.PathLike[str] | None, name: str) -> Path:
    """The given folder, else one here with the name of the scene.  Raises CallError for a value that is no path."""
    return path_of(folder) if folder is not None else Path(safe_name(name))
