"""Speed against accuracy: all methods and other programs on the same work, in one run; as a table, as data for
programs, and as a chart: cost of a position against the largest error, velocity and acceleration side by side.  Only
``graphkin study`` needs it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.util import module_from_spec, spec_from_file_location
from itertools import chain
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

from graphkin.construction import plan
from graphkin.drawing import Box, Stroke, Text
from graphkin.drawing.chart import ChartPage, Shape, add_labels, add_panel, add_words, count_powers, look, marker
from graphkin.drawing.text import rich, wrapped
from graphkin.files import Json
from graphkin.races.methods import METHODS, acts, copy_time, one_by_one
from graphkin.races.work import Entry, Skipped, Work, this_machine, work_of
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.study.equations import context
from graphkin.table import Table
from graphkin.words import Phrase, clauses, listed, rich_text, say, word
from graphkin.words.symbols import RichText, Words, rate, sign
from graphkin.words.written import printed

if TYPE_CHECKING:
    from mpmath import MPContext

    from graphkin.drawing.chart import Figure

__all__ = ["COUNT", "Entry", "Race", "race", "race_page", "race_table", "to_json"]

COUNT = 100_800
KINDS = "velocity", "acceleration"
PEERS = "pylinkage", "scipy"
"""Other programs, by their names in ``PEERS_FILE``."""
PEERS_FILE = Path(__file__).parents[2] / "tests" / "bench" / "raced_peers.py"
"""What runs them: it stands in the repository, and is no part of what is installed."""


@dataclass(frozen=True)
class Race:
    """The cost and the error of every method.

    copying : cost of copying the velocities of a position, and with the accelerations (s)
    acts : acts of the hand in one drawing
    machine : cores, processor, versions of the programs by name
    skipped : peers left out, with the reason
    asked : the quantities of the limited runs
    """

    scene: Mechanism
    entries: tuple[Entry, ...]
    copying: tuple[float, float]
    acts: int
    repeats: int
    count: int
    places: int
    machine: tuple[int, str, Mapping[str, str]]
    skipped: tuple[tuple[str, Phrase], ...]
    asked: tuple[Symbol, ...]

    def of(self, key: str, tag: str = "") -> Entry:
        return next(e for e in self.entries if e.key == key and e.tag == tag)


def race(scene: Mechanism, repeats: int, count: int = COUNT) -> Race:
    """Let all methods run.

    Parameters
    ----------
    repeats : runs of each method, the fastest counts
    count : positions in a timed run, for the methods that compute many at once

    Raises
    ------
    CallError : mpmath is not installed, a group larger than a dyad, no moving link
    Unsolvable : as for ``solver.solve``
    """
    mp: MPContext = context()
    work = work_of(scene, mp, count)
    entries: list[Entry] = [entry for method in METHODS for entry in method(work, repeats)]
    entries.append(one_by_one(work.only(work.asked_outputs()), repeats, "asked"))
    skipped = []
    for name in PEERS:
        try:
            entries += _peer(name, work, repeats)
        except Skipped as why:
            skipped.append((name, why.why))
    _, by_hand = acts(plan(scene, work.positions[0], ()))
    return Race(
        scene, tuple(entries), copy_time(work, repeats), by_hand, repeats, work.count, len(work.rows),
        this_machine(), tuple(skipped), work.asked,
    )


def _peer(name: str, work: Work, repeats: int) -> Iterator[Entry]:
    """Another program on the work.  Raises Skipped where it cannot do the work, or cannot be run from here."""
    spec = spec_from_file_location("raced_peers", PEERS_FILE)
    if spec is None or spec.loader is None or not PEERS_FILE.is_file():
        raise Skipped("wheel")
    peers = module_from_spec(spec)
    spec.loader.exec_module(peers)
    yield from peers.PEERS[name](work, repeats)


def race_table(race: Race) -> Table:
    """One row for each method; first the floor."""
    rows: list[tuple[object, ...]] = [("copying", "", "floor", *chain(*((cost, None) for cost in race.copying)))]
    rows += [(e.key, e.tag, e.family, *chain(*zip(e.costs, e.errors, strict=True))) for e in race.entries]
    numbers = [f"{kind}_{of}" for kind in KINDS for of in ("cost_s", "error")]
    return Table.of(("method", "tag", "family", *numbers), rows, ("", "", "", *(".3g" for _ in numbers)))


def to_json(race: Race) -> dict[str, Json]:
    """Costs in s for a position, errors in parts of the largest value, and the machine."""
    cores, processor, versions = race.machine
    return {
        "scene": race.scene.name,
        "machine": {"cores": cores, "processor": processor, "versions": dict(versions)},
        "repeats": race.repeats,
        "positions": race.count,
        "places": race.places,
        "copying_s": list(race.copying),
        "asked": [str(s) for s in race.asked],
        "methods": [
            {
                "method": e.key,
                "tag": e.tag,
                "family": e.family,
                "says": _named(e, "en"),
                **{kind: {"cost_s": cost, "error": error}
                   for kind, cost, error in zip(KINDS, e.costs, e.errors, strict=True)},
            }
            for e in race.entries
        ],
        "left_out": [{"peer": name, "why": str(why)} for name, why in race.skipped],
    }


WIDTH, HEIGHT = 297.0, 210.0
LEFT, RIGHT, GAP = 22.0, 8.0, 18.0
TOP, BOTTOM = 40.0, 50.0
LETTERS = 2.5
LETTERS_TRIED = (2.5, 2.3, 2.1, 2.0)
"""Letters of the labels, mm: where machine and methods crowd the points, smaller ones."""
LOWEST = 1e-19
HIGHEST = 10.0

SHAPES: dict[str, Shape] = {
    "closed": "disc",
    "newton": "circle",
    "differences": "diamond",
    "complex step": "square",
    "drawn": "cross",
    "by hand": "down",
    "peer": "up",
}
LINES = {
    "newton": Stroke(0.25, (3.0, 1.2)),
    "differences": Stroke(0.25, (0.9, 0.9)),
    "pencil": Stroke(0.25),
    "by hand": Stroke(0.25),
}
FLOOR = Stroke(0.35, (4.0, 1.0, 0.9, 1.0))
SAVED = Stroke(0.18)
NUMBERED = {"newton": ("1", "2", "3", "4"), "differences": ("1e-1", "1e-4", "1e-6", "1e-8")}
"""Which points of a curve bear their number."""


def race_page(race: Race, language: str = "en") -> ChartPage:
    """One page for both."""
    title = word("speed title", language)
    name = race.scene.question.title_in(language)
    cores, processor, programs = race.machine
    versions = listed([f"{program} {version}" for program, version in programs.items()])
    facts = say(Phrase("speed facts", cores=cores, processor=processor, versions=versions, runs=race.repeats,
                       positions=race.count, places=race.places), language)
    half = (WIDTH - LEFT - RIGHT - GAP) / 2

    def paint(figure: Figure) -> None:
        add_words(
            figure,
            Text(complex(LEFT - 12, 13.0), rich(title, 5.0, bold=True)),
            Text(complex(LEFT - 12, 19.0), rich(name, 3.5)),
            *_lines([facts], 24.0, LETTERS, 3.3),
            *_lines(_lessons(race, language), HEIGHT - BOTTOM + 16.0, 2.8, 3.8),
        )
        for order, left in enumerate((LEFT, LEFT + half + GAP)):
            _draw(figure, race, order, Box(left, TOP, left + half, HEIGHT - BOTTOM), language)

    return ChartPage(
        WIDTH, HEIGHT, paint, title=f"{title}: {name}", desc=facts, lang=language,
        metadata={"study": "speed-accuracy", "scene": race.scene.name},
    )


def lessons(race: Race) -> tuple[Phrase, ...]:
    """The conclusions from the entries on drawing and computing accelerations: every number is one of theirs, or a
    quotient."""

    def times(entry: Entry, of: Entry) -> str:
        return f"{entry.costs[1] / of.costs[1]:.3g}"

    hands = sorted((e for e in race.entries if e.key == "by hand"), key=lambda e: float(e.tag))
    drawn, closed = race.of("exact drawing"), race.of("closed arrays")
    phrases = []
    if hands:
        usual, large = next((e for e in hands if e.tag == "1"), hands[0]), hands[-1]
        phrases.append(Phrase(
            "speed lesson draw", minutes=f"{usual.costs[1] / 60:.2g}", error=f"{100 * usual.error:.2g}",
            size=usual.tag, large_error=f"{100 * large.error:.2g}", large_size=large.tag,
            exact_time=f"{1e3 * drawn.costs[1]:.2g}", exact_error=f"{drawn.error:.1g}",
        ))
    phrases.append(Phrase("speed lesson compute", times=times(closed, drawn), error=f"{closed.error:.1g}"))
    steps = [e for e in race.entries if e.key == "differences"]
    by_newton = [e for e in race.entries if e.key == "Newton"]
    newton = min(by_newton, key=lambda e: float(f"{e.error:.1g}"), default=None)
    if steps and newton is not None:
        single = race.of("closed single")
        best = [min(e for e in errors if e is not None) for errors in zip(*(e.errors for e in steps), strict=True)]
        phrases.append(Phrase(
            "speed lesson lose", times=times(steps[0], closed),
            velocity=f"{best[0]:.1g}", acceleration=f"{best[1]:.1g}", single_times=times(single, closed),
            single_error=f"{single.error:.1g}", newton_times=times(newton, closed), newton_error=f"{newton.error:.1g}",
        ))
    return tuple(phrases)


def _lessons(race: Race, language: str) -> list[str]:
    lines = [say(lesson, language) for lesson in lessons(race)]
    lines.append(say(Phrase("speed hand", acts=race.acts), language))
    if race.skipped:
        methods = clauses([f"{peer} {say(why, language)}" for peer, why in race.skipped])
        lines.append(say(Phrase("skipped", methods=methods), language))
    return lines


def _lines(paragraphs: Sequence[str], y: float, letters: float, step: float) -> list[Text]:
    """Paragraphs over the width of the page, from a baseline down."""
    lines = [runs for text in paragraphs for runs in wrapped(text, letters, WIDTH - LEFT - RIGHT + 12)]
    return [Text(complex(LEFT - 12, y + k * step), runs) for k, runs in enumerate(lines)]


def _draw(figure: Figure, race: Race, order: int, box: Box, language: str) -> None:
    """Draw the chart of velocities, or of accelerations: a point for each method that gives them."""
    known = ((e, e.costs[order], e.errors[order]) for e in race.entries)
    points = [(e, c, max(error, LOWEST * 1.5)) for e, c, error in known if error is not None and isfinite(error)]
    costs = [c for _, c, _ in points]
    floor, kind = race.copying[order], KINDS[order]
    title = f"{word(f'speed of {kind}', language)}: {word('largest error', language)}"
    axes = add_panel(figure, box, f"speed-{kind}", title, word("cost of a position", language))
    count_powers(axes, "x", min(floor, *costs) / 1.5, max(costs) * 1.5, most=14)
    count_powers(axes, "y", LOWEST, HIGHEST)
    points = [p for p in points if p[2] <= HIGHEST]
    axes.plot([floor] * 2, [LOWEST, HIGHEST], **look(FLOOR))
    for name, stroke in LINES.items():
        shown = [p for p in points if p[0].family == name or (name == "pencil" and p[0].key == "pencil")]
        axes.plot([c for _, c, _ in shown], [e for _, _, e in shown], **look(stroke))
    for e, cost, error in points:  # lines from each whole run to the one that is limited to what is asked
        whole = next((p for p in points if p[0].key == e.key and not p[0].tag and e.tag == "asked"), None)
        if whole is not None:
            axes.plot([whole[1], cost], [whole[2], error], **look(SAVED))
    for family, shape in SHAPES.items():
        shown = [p for p in points if p[0].family == family]
        axes.plot([c for _, c, _ in shown], [e for _, _, e in shown], **marker(shape))
    named = [(_words(race, e, points, language), (cost, error)) for e, cost, error in points]
    stretch = (floor, HIGHEST / 20), (floor, HIGHEST / 2e4)
    add_labels(axes, [*((w, at) for w, at in named if w), (word("copying", language), stretch)], LETTERS_TRIED)


def _words(race: Race, entry: Entry, points: Sequence[tuple[Entry, float, float]], language: str) -> Words:
    """The name of a method at its point; of a curve's points the first has the name, some have their numbers."""
    if entry.tag == "asked":
        asked = Phrase("only asked", method=word(entry.key, language), quantity=_written(race.asked[0]))
        return rich_text(asked, language)
    if not entry.tag:
        return word(entry.key, language)
    of_curve = [e for e, _, _ in points if e.key == entry.key]
    number = _number(entry.tag)
    if entry is of_curve[0]:
        return f"{_named(entry, language)} {number}"
    numbered = entry.tag in NUMBERED[entry.family] if entry.family in NUMBERED else entry is of_curve[-1]
    return number if numbered else ""


def _named(entry: Entry, language: str) -> str:
    """The name of a method."""
    return word("differences of" if entry.key == "differences" else entry.key, language)


def _written(symbol: Symbol) -> RichText:
    """A symbol: v_B@3 with B3 as its index."""
    if symbol.link:
        return rate(symbol.kind, symbol.link)
    parts = [f"{ref.point}{ref.link}" for ref in (symbol.of, symbol.to) if ref is not None]
    return sign(symbol.kind[0], "/".join(parts))


def _number(tag: str) -> str:
    if "e-" in tag:
        return printed(tag).removeprefix("1·")
    return {"0.25": "1/4", "0.5": "1/2"}.get(tag, tag)
