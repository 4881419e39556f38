"""``graphkin draw``: the figures, the readings and the check, as files."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from graphkin.api.arguments import (
    ON_SHEETS,
    At,
    as_scene,
    asked_symbols,
    drawn_symbols,
    driver_values,
    for_paper,
    hand_of,
    in_convention,
    known_words,
    placed,
    unknown_words,
)
from graphkin.api.cams import cam_made, cam_table
from graphkin.api.checked import Checked, checked, settled, with_elsewhere
from graphkin.api.report_text import report_text
from graphkin.api.results import OfScene, Result
from graphkin.checking.readings import report_on
from graphkin.checking.report import ReadValue
from graphkin.construction import EXACT, Instrument, Plan, execute, plan, plan_with_forces
from graphkin.drawing import Drawing
from graphkin.drawing.boxes import FigurePage
from graphkin.drawing.figures import figure_kinds
from graphkin.drawing.figures.positions import shown_positions
from graphkin.drawing.place.obstacles import short_buffers
from graphkin.drawing.sheet_plan import sheet_room
from graphkin.errors import CallError, Problem, Unsolvable, as_list, unfit
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike
from graphkin.scene.symbol import Symbol, asked_here
from graphkin.solver import Motion, solved_here, structure_of
from graphkin.solver.path.named_positions import named_positions
from graphkin.structure.analysis import driven_by
from graphkin.table import Table
from graphkin.words import Phrase, Wording, languages


@dataclass(frozen=True, repr=False, eq=False)
class Drawn(OfScene, Result):
    """The figures of a scene by name, with the check of all their values.

    In a notebook it shows the sheet.  ``wanted`` are the asked figures; with ``by_name`` each was asked by its name,
    and a figure that cannot be drawn is an error.  ``figures["velocity"].save("v.pdf")`` picks the format by the name.
    """

    checked: Checked
    plan: Plan
    motion: Motion
    wanted: tuple[str, ...]
    seed: int = 0
    language: str | None = None
    convention: str | None = None
    driver: str = ""
    beside: tuple[str | float, ...] = ()
    by_name: bool = True

    @property
    def mechanism(self) -> Mechanism:
        return self.checked.mechanism

    @cached_property
    def small(self) -> Checked:
        """The construction at the scales that fit the sheet, with its own readings."""
        fitting = replace(self.plan, scales=self.plan.exact.scales_for(sheet_room(self.mechanism)))
        return checked(fitting, self.motion, self._hand)

    @property
    def whole(self) -> Plan:
        """The plan of all links at the scales of the drawing."""
        planned = plan(self.plan.structure, self.checked.sheet.drivers, (), without_forces=self.plan.without_forces)
        return replace(planned, scales=self.plan.scales)

    @property
    def _hand(self) -> Instrument:
        return hand_of(self.mechanism.question.sheet, self.checked.sheet.instrument, self.seed)

    @property
    def with_forces(self) -> Checked | None:
        """The check with forces; None without masses and loads, or where they are neither asked for nor found."""
        made = self._all_checked
        if isinstance(made, Unsolvable) and self.by_name:
            raise made
        return None if isinstance(made, Unsolvable) else made

    @cached_property
    def _all_checked(self) -> Checked | Unsolvable | None:
        """The check with forces, or the reason why they cannot be found."""
        if self.checked.sheet.has_forces:
            return self.checked
        if self.plan.without_forces or not self.mechanism.loading:
            return self.plan.without_forces
        try:
            return checked(self.whole, solved_here(self.plan.structure, self.checked.sheet.drivers), self._hand)
        except Unsolvable as stop:
            return stop

    @property
    def not_drawn(self) -> Mapping[str, Wording]:
        """The figures asked for by name, or with a table in the scene, that could not be drawn, with the reason."""
        made = {name.split("-")[0] for name in self.figures}
        missing = [name for name in self.wanted if name not in made]
        if self.by_name:
            return dict.fromkeys(missing, Phrase("the scene has nothing of it"))
        missing = [name for name in missing if figure_kinds()[name].needs == "forces"]
        stop = self._all_checked if missing else None
        return dict.fromkeys(missing, stop.reason) if isinstance(stop, Unsolvable) else {}

    @property
    def ok(self) -> bool:
        return self.checked.ok

    @property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin draw --json`` prints: that of the check."""
        return self.checked.data

    @property
    def table(self) -> Table:
        """The readings, in scene units."""
        return self.checked.table

    def __getitem__(self, name: str) -> ReadValue:
        """A reading by its symbol beside the exact value, in the file's units.  Raises CallError for one not drawn."""
        return self.checked[name]

    @cached_property
    def figures(self) -> Mapping[str, Drawing]:
        """The asked figures by name, and their further pages (sheet-2); only these are drawn."""
        made: dict[str, Drawing] = {}
        for name in self.wanted:
            figure = drawn_figure(self, name)
            if figure is not None:
                made[name] = figure
                made.update({f"{name}-{number}": page for number, page in enumerate(figure.further, 2)})
        return made

    @property
    def tables(self) -> Mapping[str, Table]:
        lifts = {"cam.csv": cam_table(self.mechanism)} if "cam" in self.wanted and cam_made(self.mechanism) else {}
        return {**lifts, "readings.csv": self.table}

    @property
    def files(self) -> Mapping[str, bytes]:
        spoken = languages(self.language or self.mechanism.question.sheet.language)[0]
        return {"report.txt": report_text(self.checked, spoken).encode()}

    def pages(self, formats: Sequence[str], text: str = "glyphs") -> dict[str, bytes]:
        """The files of its figures.  Raises Disagreement for a value that was drawn exactly and is out of tolerance."""
        known_words(formats, text=text)
        if self.checked.sheet.instrument == EXACT.name:
            forces = self.with_forces if any(figure_kinds()[name].needs == "forces" for name in self.wanted) else None
            for made in (self.checked, forces):
                if made is not None:
                    made.report.must_agree()
        return super().pages(formats, text)

    def __repr__(self) -> str:
        return f"<Drawn {self.mechanism.name}: {', '.join(self.wanted)}>"

    def _repr_svg_(self) -> str | None:
        return self.figures["sheet"]._repr_svg_() if "sheet" in self.wanted else super()._repr_svg_()


def _centres(drawn: Drawn) -> tuple[Any, ...]:
    from graphkin.api.centred import ROOM, found_centres
    from graphkin.checking.centres import must_agree

    whole = drawn.checked
    # what exact hands have drawn serves this figure too; finite ones draw nothing of the centres
    exact = whole.sheet.instrument == EXACT.name
    values = {d.key: whole.sheet.drivers[d.key] for d in whole.part.drivers}
    centres = whole.centres
    centres = centres.at(centres.sheet.scales_for(ROOM)) if exact else found_centres(whole.part, values)
    must_agree(centres, drawn.motion)
    return centres.sheet, centres


def _forces(drawn: Drawn) -> tuple[Any, ...] | None:
    whole = drawn.with_forces
    if whole is None or not whole.sheet.forces:
        return None
    return whole.sheet, whole.report


def _positions(drawn: Drawn) -> tuple[Any, ...]:
    scene, values = drawn.mechanism, named_positions(drawn.mechanism)
    try:
        shown = shown_positions(drawn.whole, values)
    except Unsolvable:
        for value in values.values():
            solved_here(scene, {**drawn.checked.sheet.drivers, scene.drivers[0].key: value})
        raise
    return shown.own, shown


def _beside(drawn: Drawn) -> tuple[Any, ...]:
    """The constructions at several positions: named, values of the first driver, or else those ``[positions]`` shows.

    Raises
    ------
    CallError : fewer than two positions, or a name of none
    Unsolvable : a position that cannot be assembled or reached; Disagreement : a reading out of tolerance there
    """
    structure, scene = drawn.plan.structure, drawn.plan.structure.scene
    positions = scene.question.positions
    known, shown = (positions.names, positions.show) if positions else ((), ())
    wished = drawn.beside or tuple(n for n in known if n in shown or ("all" in shown and n.isdigit()))
    if len(wished) < 2:
        raise CallError.of("figure polygons", "shows several positions beside each other",
                           "name two or more beside 1 beside 7")
    asked = tuple(s for s in scene.question.find if s.scope == "motion" and not s.at)
    sheets = []
    for name in map(str, wished):
        at: At = name
        if name not in known:
            with suppress(ValueError):
                at = float(name)
        values = {**drawn.checked.sheet.drivers, **(driver_values(scene, at) or {})}
        motion = solved_here(structure, values, asked)
        sheet = execute(plan(structure, values, asked))
        report_on(sheet, motion).must_agree()
        sheets.append((name, sheet))
    return sheets[0][1], sheets


SUPPLIES: Mapping[str, Callable[[Drawn], tuple[Any, ...] | None]] = {
    "sheet": lambda drawn: (drawn.checked.sheet,),
    "small sheet": lambda drawn: (drawn.small.sheet, drawn.small.report),
    "sheet at contacts": lambda drawn: (drawn.checked.at_contacts.sheet,) if drawn.checked.at_contacts else None,
    "sheets beside": _beside,
    "centres": _centres,
    "forces": _forces,
    "structures": lambda drawn: (
        execute(drawn.whole), [driven_by(drawn.mechanism, drawn.driver)] if drawn.driver else []
    ),
    "positions": _positions,
    "cams": lambda drawn: (
        drawn.checked.sheet, [(made.cam, made.sheet, made.phrases()) for made in cam_made(drawn.mechanism)]
    ),
}
"""The sheet and the further needs of figures, by the name under which they ask for them; None where the scene has
nothing of it."""


@short_buffers()
def drawn_figure(drawn: Drawn, name: str) -> Drawing | None:
    """A figure by its name; None where it has no content."""
    figure = figure_kinds()[name]
    given = SUPPLIES[figure.needs](drawn)
    if given is None:
        return None
    sheet, *needs = given
    return figure.draw(FigurePage.of(sheet, name, drawn.language, drawn.convention), *needs)


def known_figures(scene: Mechanism, names: Sequence[str] | None) -> tuple[str, ...]:
    """The asked figures, each once; without names the five of every scene, and those with a table in the scene.

    Raises
    ------
    CallError : every name of no figure
    """
    if names is None:
        return tuple(name for name, figure in figure_kinds().items() if figure.by_itself(scene))
    wanted = Phrase("give a list velocity")
    if isinstance(names, str):
        raise unfit("figures", names, wanted)
    names = as_list("figures", names, wanted)
    if wrong := unknown_words("figure", names, figure_kinds()):
        raise CallError(*wrong)
    return tuple(dict.fromkeys(names))


def draw(
    scene: SceneLike,
    *,
    at: At = None,
    find: Iterable[str | Symbol] | None = None,
    figures: Sequence[str] | None = None,
    driver: str = "",
    beside: Sequence[str | float] = (),
    out: str | os.PathLike[str] | None = None,
    formats: Sequence[str] = ("svg",),
    language: str | None = None,
    convention: str | None = None,
    instrument: str = "exact",
    seed: int = 0,
) -> Drawn:
    """Draw a scene step by step, check it, and write the figures if a folder is given.

    Parameters
    ----------
    scene, at : as for `solve`
    find, instrument, seed : as for `check`
    out : folder for the figures in each of the ``formats``, readings.csv and report.txt
    figures : names of figures, to draw these only; without it mechanism, velocity, acceleration, sheet, centres, and
        those for which the scene has a table
    beside : of the figure "polygons": names of positions, or values of the first driver, whose polygons are compared;
        without it the positions that `[positions]` shows
    driver : of the figure "structure": a link as driver instead of the scene's first driver, shown beside it
    language : "en", "zh" or "both" (on the figures; the report is in English then); the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    known_words(formats, language, convention, instrument, known_languages=ON_SHEETS)
    given = in_convention(as_scene(scene), convention)
    wanted = known_figures(given, figures)
    places = tuple(as_list("beside", beside, Phrase("give names of positions or driver values 1")))
    alone = [("driver", "structure", driver), ("beside", "polygons", places)]
    if wishes := [(name, figure) for name, figure, wish in alone if wish and figure not in wanted]:
        raise CallError(*(Problem(name, "is of one figure alone", "ask for this figure", figure=figure)
                          for name, figure in wishes))
    asked = drawn_symbols(given, find)
    given = for_paper(given, () if any(figure_kinds()[name].of_all for name in wanted) else asked_here(asked))
    given, values = placed(given, at)
    hand = hand_of(given.question.sheet, instrument, seed)
    structure = structure_of(given)
    motion = solved_here(structure, values, asked_here(asked))
    planned = plan_with_forces(structure, values, asked_here(asked), asked_symbols(given, find))
    whole = with_elsewhere(settled(checked(planned, motion, hand), hand), asked, seed)
    by_name = figures is not None
    drawn = Drawn(whole, planned, motion, wanted, seed, language, convention, driver, places, by_name)
    return drawn.saved(out, formats)
