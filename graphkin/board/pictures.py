"""The page's picture of a scene at one position: figures, readings, steps, places of points, range of motion."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from graphkin import solver
from graphkin.account.account import telling
from graphkin.account.forces import force_stages
from graphkin.account.notation import notation_of
from graphkin.account.voice import Account
from graphkin.api.arguments import driver_values, hand_of, placed
from graphkin.api.checked import checked
from graphkin.api.drawn import Drawn, drawn_figure, known_figures
from graphkin.api.explained import mobility_said
from graphkin.api.report_text import plain_said, reading_words
from graphkin.board.building import movable
from graphkin.construction import Plan, execute, plan, plan_with_forces
from graphkin.construction.board.scales import Scales
from graphkin.construction.board.steps import DiagramName
from graphkin.drawing.boxes import FigurePage
from graphkin.drawing.figures.diagrams import figure_in_motion
from graphkin.drawing.write.svg import svg_element
from graphkin.errors import GraphkinError, SceneError, Unsolvable
from graphkin.files import Json, OwnTables
from graphkin.papers.html import words_html
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import naming_files, parsed, resolved
from graphkin.scene.symbol import asked_here
from graphkin.solver import Motion, driver_range, solved_here
from graphkin.solver.path.driver_range import DriverRange
from graphkin.structure import Structure
from graphkin.words import Phrase, Wording, languages, say

NEAR_END = 1e-6  # of the range: so far from its end the drawing is whole
FAST = 1e3  # times a driver's own speed over the size: so fast is what stands beside a dead point


@dataclass(frozen=True)
class FigureOptions:
    """The page's wishes for its figures."""

    figures: tuple[str, ...] = ("mechanism", "velocity", "acceleration")
    language: str | None = None
    convention: str | None = None
    instrument: str = "exact"
    seed: int = 0
    scales: Scales | None = None


@lru_cache(maxsize=16)
def scene_of(text: str, name: str, folder: Path | None) -> Mechanism:
    """The mechanism of a scene's text.

    Parameters
    ----------
    folder : the folder of the files that it names without a path; without a folder no file is read

    Raises
    ------
    SceneError : it is no scene, or names a file elsewhere
    """
    return resolved(with_own_files(parsed(text), folder), name)[1]


def with_own_files(made: OwnTables, folder: Path | None) -> OwnTables:
    """The mapping of a scene, whose files are searched for in one folder only."""
    for where, table in naming_files(made):
        name = table["file"]
        if folder is None or Path(name).name != name or name.startswith(".") or (folder / name).is_symlink():
            raise SceneError.of(f"{where}.file", "found of name", "on this page a scene names files of", name=name[:60])
        table["file"] = str(folder / name)
    return made


def mobility_text(scene: Mechanism, language: str, trial: bool = False) -> str:
    """The mobility with its numbers, in the words of all commands; of a ``trial`` driver is said that there is none."""
    said = mobility_said(scene)
    return plain_said(Phrase("page freedom", **said.gaps) if trial else said, language)


_analysed = lru_cache(maxsize=16)(solver.structure_of)
"""The structure of a scene, with which its range and its last drawing are kept."""


def reach(scene: Mechanism) -> tuple[float, float, bool, Wording]:
    """The range of a scene's first driver: its least and greatest value in its own unit, whether it turns fully, and
    the reason of its ends.  Raises GraphkinError where it cannot be found."""
    structure = _analysed(scene)
    if "range on the page" not in structure.kept:
        structure.kept["range on the page"] = driver_range(structure)
    over: DriverRange = structure.kept["range on the page"]
    unit, law = scene.unit_of(over.driver), over.driver.law
    low, high = sorted(unit.of(float(v)) for v in over.value(np.array(over.ends)))
    if law is None:
        return (0.0, 360.0, True, "") if over.full else (low, high, False, over.limit_why)
    least, greatest = law.span
    why = Phrase("its law goes from to", least=unit.said(least), greatest=unit.said(greatest))
    ends = (-math.inf, math.inf) if over.full else (low, high)
    return max(ends[0], unit.of(least)), min(ends[1], unit.of(greatest)), False, why


def drawn_at(structure: Structure, at: Mapping[str, float] | None, options: FigureOptions) -> tuple[Drawn, Motion]:
    """A scene drawn at a position of its drivers, with its exact motion.

    Raises
    ------
    CallError : unknown figures or drivers; Unsolvable : a position that is not reached
    """
    scene, values = placed(structure.scene, at or None)
    structure = structure if scene is structure.scene else solver.structure_of(scene)
    asked = scene.question.find
    motion = solved_here(structure, values, asked_here(asked))
    planned = plan_with_forces(structure, values, asked_here(asked), asked)
    if options.scales is not None:
        planned = replace(planned, scales=options.scales)
    made = checked(planned, motion, hand_of(scene.question.sheet, options.instrument, options.seed))
    names = known_figures(scene, options.figures)
    return Drawn(made, planned, motion, names, options.seed, options.language, options.convention), motion


def shown(
    scene: Mechanism, at: Mapping[str, float] | None, options: FigureOptions, quick: bool = False
) -> dict[str, Json]:
    """The page's picture of a scene at a position, or with the reason at the end of its range where it is not reached.

    Parameters
    ----------
    at : values of drivers in their own units; the scene's own if None
    quick : figures and places alone, while a hand moves

    Raises
    ------
    Unsolvable : the scene's own position cannot be assembled
    """
    structure = _analysed(scene)
    if quick and options.instrument == "exact":
        return _in_motion(structure, at, options)
    said = ""
    try:
        drawn, motion = drawn_at(structure, at, options)
    except Unsolvable as error:
        if not at or len(scene.drivers) != 1 or error.status not in ("not assembled", "dead point"):
            raise
        at, said = _last(scene, at), _said(error, _spoken(options.language, scene))
        drawn, motion = drawn_at(structure, at, options)
    places = {p: complex(motion.position(p)[0]) for p, holders in scene.holders.items() if holders}
    answer = _answer(scene, _figures(drawn), places, scene.by_driver(motion.values[0]), drawn.plan.scales, said)
    return answer if quick else {**answer, **_whole(drawn, options)}


def _answer(
    scene: Mechanism, figures: Mapping[str, str], places: Mapping[str, complex], values: Mapping[str, float],
    scales: Scales, limit: str,
) -> dict[str, Json]:
    """The page's picture of a position: figures, places of points (m) and the effect of pulling them, values of the
    drivers (rad, m), scales, and the reason of a limit."""
    metres, pulls = scene.units.metres, movable(scene)
    spots = {point: z / metres for point, z in places.items()}
    return {
        "figures": dict(figures),
        "points": {point: {"x": z.real, "y": z.imag, "pull": pulls.get(point, "")} for point, z in spots.items()},
        "at": {d.key: scene.unit_of(d).of(values[d.key]) for d in scene.drivers},
        "scales": [scales.length, scales.velocity, scales.acceleration],
        "perMm": scales.length / metres,
        "limit": limit,
    }


_IN_MOTION: Mapping[str, DiagramName] = {n: n for n in ("mechanism", "velocity", "acceleration")}


def _plan(structure: Structure, values: Mapping[str, float] | None) -> Plan:
    """The plan at values of the drivers, followed from the last drawing.  Raises Unsolvable where it is not reached."""
    by_name, last = structure.scene.question.find, structure.kept.get("last drawing")
    try:
        return plan(structure, values, asked_here(by_name), near=None if last is None else last.exact)
    except Unsolvable:  # the way from there may be barred
        return plan_with_forces(structure, values, asked_here(by_name), by_name)


def _in_motion(structure: Structure, at: Mapping[str, float] | None, options: FigureOptions) -> dict[str, Json]:
    """The picture while a hand moves: without a check, and with names that may overlap."""
    rest = tuple(name for name in options.figures if name not in _IN_MOTION)
    others = structure, at, replace(options, figures=rest)
    scene, values = placed(structure.scene, at or None)
    structure = structure if scene is structure.scene else _analysed(scene)
    said = ""
    try:
        planned = _plan(structure, values)
        if _is_fast(planned):  # beside a limit of the motion the solver has the last word, in fifty digits
            solved_here(structure, values, asked_here(scene.question.find))
    except Unsolvable as error:
        stop = _exactly(structure, values, error)
        if not at or len(scene.drivers) != 1:
            raise stop from None
        said = _said(stop, _spoken(options.language, scene))
        planned = _plan(structure, driver_values(scene, _last(scene, at)))
    structure.kept["last drawing"] = planned
    sheet = execute(replace(planned, scales=options.scales or planned.scales))
    page = FigurePage.of(sheet, "", options.language, options.convention)
    there = [name for name in options.figures if name in _IN_MOTION]
    if not sheet.vectors["acceleration"]:
        there = [name for name in there if name != "acceleration"]
    drawn = {name: figure_in_motion(_IN_MOTION[name], page) for name in there}
    figures = {name: svg_element(figure, named=True) for name, figure in drawn.items()}
    if rest and not said:
        figures |= _figures(drawn_at(*others)[0])
    places = {ref.point: z * sheet.scales.length for ref, z in sheet.points.items() if not ref.link}
    return _answer(scene, figures, places, {k: float(v) for k, v in sheet.drivers.items()}, sheet.scales, said)


def _spoken(language: str | None, scene: Mechanism) -> str:
    """The language of the text outside figures."""
    return languages(language or scene.question.sheet.language)[0]


def _said(error: GraphkinError, language: str) -> str:
    return " ".join(problem.text(language) for problem in error.problems)


def _exactly(structure: Structure, values: Mapping[str, float] | None, stop: Unsolvable) -> Unsolvable:
    """The solver's reason for a position that is not reached, found in fifty digits, if the solver agrees."""
    try:
        solved_here(structure, values, asked_here(structure.scene.question.find))
    except Unsolvable as exact:
        return exact
    return stop


def _is_fast(planned: Plan) -> bool:
    """Whether a link moves so fast beside the drivers that the position may be a dead point or beyond one."""
    scene, sheet = planned.structure.scene, planned.exact
    fastest = max((abs(z) for z in sheet.ends["velocity"].values()), default=0.0) * sheet.scales.velocity
    rates = (abs(d.values[1]) * (scene.size if d.turns else 1.0) for d in scene.drivers)
    return not fastest <= FAST * max(rates, default=0.0)


def _last(scene: Mechanism, at: Mapping[str, float]) -> dict[str, float]:
    """The last position on the path to a position that is not reached.  Raises Unsolvable where there is no path."""
    low, high, *_ = reach(scene)
    key, wanted = next(iter(at.items()))
    inside = NEAR_END * (high - low)
    if scene.drivers[0].turns and not low <= wanted <= high:
        middle = (low + high) / 2
        wanted = middle + (wanted - middle + 180.0) % 360.0 - 180.0
    return {key: min(max(wanted, low + inside), high - inside)}


def _figures(drawn: Drawn) -> dict[str, str]:
    """The figures as elements of the page, which has their fonts; a figure that cannot be drawn gives the reason."""
    figures = {}
    for name in drawn.wanted:
        try:
            made = drawn_figure(drawn, name)
        except GraphkinError as error:
            spoken = _spoken(drawn.language, drawn.mechanism)
            figures[name] = f"<p>{words_html(_said(error, spoken), spoken)}</p>"
            continue
        if made is not None:
            figures[name] = svg_element(made, named=True)
            for number, page in enumerate(made.further, 2):
                figures[f"{name}-{number}"] = svg_element(page, named=True)
    return figures


def _whole(drawn: Drawn, options: FigureOptions) -> dict[str, Json]:
    scene, sheet = drawn.mechanism, drawn.checked.sheet
    spoken = _spoken(options.language, scene)
    account = Account(sheet, notation_of(sheet, options.convention or scene.question.sheet.convention))  # type: ignore[arg-type]
    try:
        low, high, turns, why = reach(scene)
        limits: dict[str, Json] = {"low": low, "high": high, "turns": turns, "why": say(why, spoken)}
    except GraphkinError as error:
        limits = {"low": None, "high": None, "turns": False, "why": _said(error, spoken)}
    motion = (telling(account, step) for step in sheet.steps)
    forces = ((stage.figure, words) for stage in force_stages(account) for words in stage.steps)
    steps = [
        *((words.step.diagram, words, words.work) for words in motion),
        *((figure, words, words.work_in(spoken)) for figure, words in forces),
    ]
    return {
        "readings": [
            [symbol, on_paper, f"{measured} {unit}", f"{exact} {unit}", ok]
            for symbol, on_paper, measured, exact, unit, ok in reading_words(drawn.checked)
        ],
        "agrees": drawn.ok,
        "steps": [
            {"n": words.step.number, "figure": figure, "html": words_html(words.sentence(spoken), spoken),
             "work": [words_html(line, spoken) for line in work]}
            for figure, words, work in steps
        ],
        "range": limits,
        "drivers": [
            {"key": d.key, "angle": d.turns, "now": scene.unit_of(d).said(drawn.motion.values[0][i]),
             "sense": -1 if d.values[1] < 0 else 1}
            for i, d in enumerate(scene.drivers)
        ],
        "mobility": mobility_text(scene, spoken),
        "title": scene.question.title_in(spoken),
        "unit": scene.units.length,
    }


def thumbnail(scene: Mechanism, language: str | None) -> str:
    """The mechanism figure of a scene at its own position."""
    drawn, _ = drawn_at(solver.structure_of(scene), None, FigureOptions(("mechanism",), language))
    return next(iter(_figures(drawn).values()))


