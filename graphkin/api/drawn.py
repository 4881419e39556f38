"""``graphkin draw``: the figures, the readings and the check, as files."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from graphkin.api.arguments import (
    ON_SHEETS,
    At,
    SceneLike,
    as_scene,
    for_paper,
    known_words,
    placed,
)
from graphkin.api.cams import cam_table
from graphkin.api.checked import Checked, asked_here, checked, drawn_symbols, hand_of, solved_here, with_elsewhere
from graphkin.api.report_text import report_text
from graphkin.api.results import OfScene, Result
from graphkin.construction import EXACT, Plan, execute, plan
from graphkin.errors import CallError, Problem, as_list, did_you_mean
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.table import Table
from graphkin.words import Phrase, languages

if TYPE_CHECKING:
    from graphkin.api.reading_rows import ReadValue
    from graphkin.drawing import Drawing
    from graphkin.solver import Motion
from graphkin.structure.analysis import driven_by

__all__ = ["Drawn", "draw", "known_figures"]


@dataclass(frozen=True, repr=False, eq=False)
class Drawn(OfScene, Result):
    """The figures of a scene by name, with the check of everything on them.

    In a notebook it shows the sheet.  ``wanted`` are the figures asked for.  ``figures["velocity"].save("v.pdf")``
    picks the format by the name.
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

    @property
    def mechanism(self) -> Mechanism:
        return self.checked.mechanism

    @cached_property
    def small(self) -> Checked:
        """The same construction at the scales that fit the sheet, which bears its own readings."""
        from graphkin.drawing.sheet_plan import sheet_room

        fitting = replace(self.plan, scales=self.plan.scales_for(sheet_room(self.mechanism)))
        return checked(fitting, self.motion, hand_of(self.mechanism, self.checked.sheet.instrument, self.seed))

    @cached_property
    def with_forces(self) -> Checked | None:
        """The check of everything, forces included; None of a scene that has neither masses nor loads."""
        if self.checked.sheet.has_forces:
            return self.checked
        if not self.mechanism.loading:
            return None
        structure, values = self.plan.structure, self.checked.sheet.drivers
        whole = replace(plan(structure, values, ()), scales=self.plan.scales)
        hand = hand_of(self.mechanism, self.checked.sheet.instrument, self.seed)
        return checked(whole, solved_here(structure, values), hand)

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
        """The figures that were asked for, by name, and their further pages (sheet-2, where the sheet goes on); only
        these are drawn."""
        made: dict[str, Drawing] = {}
        for name in self.wanted:
            figure = FIGURES[name].make(self)
            if figure is not None:
                made[name] = figure
                made.update({f"{name}-{number}": page for number, page in enumerate(figure.further, 2)})
        return made

    @property
    def tables(self) -> Mapping[str, Table]:
        cams = {"cam.csv": cam_table(self.mechanism)} if self.mechanism.cams and "cam" in self.wanted else {}
        return {**cams, "readings.csv": self.table}

    @property
    def files(self) -> Mapping[str, bytes]:
        spoken = languages(self.language or self.mechanism.sheet.language)[0]
        return {"report.txt": report_text(self.checked, spoken).encode()}

    def pages(self, formats: Sequence[str], text: str = "glyphs") -> dict[str, bytes]:
        """The files of its figures.  Raises Disagreement for a value that was drawn exactly and is out of tolerance."""
        known_words(formats, text=text)
        if self.checked.sheet.instrument == EXACT.name:
            forces = self.with_forces if {"forces", "lever"}.intersection(self.wanted) else None
            for made in (self.checked, forces):
                if made is not None:
                    made.report.must_agree(self.mechanism)
        return super().pages(formats, text)

    def __repr__(self) -> str:
        return f"<Drawn {self.mechanism.name}: {', '.join(self.wanted)}>"

    def _repr_svg_(self) -> str | None:
        return self.figures["sheet"]._repr_svg_() if "sheet" in self.wanted else super()._repr_svg_()


@dataclass(frozen=True)
class FigureKind:
    """A figure that can be asked for by name.

    by_itself : whether it is drawn of a scene where no figure is asked for by name
    make : draws it; None where there is nothing to draw
    of_all : whether it shows all links, whatever is asked
    """

    by_itself: Callable[[Mechanism], bool]
    make: Callable[[Drawn], Drawing | None]
    of_all: bool = False


def _always(scene: Mechanism) -> bool:
    return True


def _mechanism(drawn: Drawn) -> Drawing:
    from graphkin.drawing.figure_pages import mechanism_figure

    return mechanism_figure(drawn.checked.sheet, language=drawn.language, convention=drawn.convention)


def _velocity(drawn: Drawn) -> Drawing:
    from graphkin.drawing.figure_pages import velocity_figure

    return velocity_figure(drawn.checked.sheet, language=drawn.language, convention=drawn.convention)


def _acceleration(drawn: Drawn) -> Drawing | None:
    from graphkin.drawing.figure_pages import acceleration_figure

    if not drawn.checked.sheet.vectors("acceleration"):
        return None
    return acceleration_figure(drawn.checked.sheet, language=drawn.language, convention=drawn.convention)


def _sheet(drawn: Drawn) -> Drawing:
    from graphkin.drawing.sheet import sheet_page

    small = drawn.small
    return sheet_page(small.sheet, small.report, language=drawn.language, convention=drawn.convention)


def _centres(drawn: Drawn) -> Drawing:
    from graphkin.api.centred import ROOM, found_centres
    from graphkin.construction.centres import speeds
    from graphkin.drawing.centres import centres_figure

    whole = drawn.checked
    # what exact hands have drawn serves this figure too; finite ones draw nothing of the centres
    exact = whole.sheet.instrument == EXACT.name
    values = {d.key: whole.sheet.drivers[d.key] for d in whole.part.drivers}
    found = whole.centres.in_room(ROOM) if exact else found_centres(whole.part, values)
    return centres_figure(found, speeds(found), language=drawn.language, convention=drawn.convention)


def _forces(drawn: Drawn) -> Drawing | None:
    from graphkin.drawing.forces import forces_figure

    whole = drawn.with_forces
    if whole is None or whole.forces is None:
        return None
    return forces_figure(
        whole.sheet, whole.forces, whole.report, language=drawn.language, convention=drawn.convention
    )


def _lever(drawn: Drawn) -> Drawing | None:
    from graphkin.drawing.lever import lever_figure

    whole = drawn.with_forces
    if whole is None or whole.forces is None:
        return None
    sheet = replace(whole.sheet, scales=whole.report.scales)
    return lever_figure(sheet, whole.forces, language=drawn.language, convention=drawn.convention)


def _plan(drawn: Drawn) -> Drawing | None:
    from graphkin.drawing.train import train_figure

    return train_figure(drawn.checked.sheet, language=drawn.language, convention=drawn.convention)


def _rolls(scene: Mechanism) -> bool:
    return bool(scene.gears) or any(c.rolling for c in scene.contacts)


def _contacts(drawn: Drawn) -> Drawing | None:
    from graphkin.drawing.figure_pages import acceleration_figure, velocity_figure

    other = drawn.checked.at_contacts
    if other is None:
        return None
    spoken = {"language": drawn.language, "convention": drawn.convention}
    pages = [velocity_figure(other.sheet, **spoken)]
    if other.sheet.vectors("acceleration"):
        pages.append(acceleration_figure(other.sheet, **spoken))
    return replace(pages[0], further=tuple(pages[1:]))


def _touches(scene: Mechanism) -> bool:
    return any(not c.rolling for c in scene.contacts) or bool(scene.cams) or any(not s.block for s in scene.slots)


def _loops(drawn: Drawn) -> Drawing | None:
    from graphkin.drawing.loops import loops_figure

    return loops_figure(drawn.checked.sheet, language=drawn.language, convention=drawn.convention)


def _structure(drawn: Drawn) -> Drawing:
    from graphkin.drawing.structure import structure_figure

    structure = drawn.plan.structure
    whole = execute(replace(plan(structure, drawn.checked.sheet.drivers, ()), scales=drawn.plan.scales))
    others = [driven_by(drawn.mechanism, drawn.driver)] if drawn.driver else []
    return structure_figure(whole, others, language=drawn.language, convention=drawn.convention)


def _positions(drawn: Drawn) -> Drawing:
    from graphkin.api.shown_positions import shown_positions
    from graphkin.drawing.positions import positions_figure
    from graphkin.solver.named_positions import named_positions

    places = named_positions(drawn.mechanism)
    structure = drawn.plan.structure
    whole = replace(plan(structure, drawn.checked.sheet.drivers, ()), scales=drawn.plan.scales)
    shown = shown_positions(whole, places.values if places else {})
    return positions_figure(shown, language=drawn.language, convention=drawn.convention)


def _polygons(drawn: Drawn) -> Drawing:
    from graphkin.api.shown_positions import sheets_beside
    from graphkin.drawing.polygons_beside import polygons_beside

    sheets = sheets_beside(drawn.plan.structure, drawn.checked.sheet.drivers, drawn.beside)
    return polygons_beside(sheets, language=drawn.language, convention=drawn.convention)


def _cams(drawn: Drawn) -> Drawing | None:
    from graphkin.api.cams import cam_made

    spoken = drawn.language or drawn.mechanism.sheet.language
    pages = [one.figure(spoken) for one in cam_made(drawn.mechanism)]
    return replace(pages[0], further=tuple(pages[1:])) if pages else None


FIGURES: Mapping[str, FigureKind] = {
    "mechanism": FigureKind(_always, _mechanism),
    "velocity": FigureKind(_always, _velocity),
    "acceleration": FigureKind(_always, _acceleration),
    "sheet": FigureKind(_always, _sheet),
    "centres": FigureKind(_always, _centres),
    "structure": FigureKind(lambda scene: False, _structure, of_all=True),
    "positions": FigureKind(lambda scene: scene.positions is not None, _positions, of_all=True),
    "polygons": FigureKind(lambda scene: False, _polygons, of_all=True),
    "cam": FigureKind(lambda scene: bool(scene.cams), _cams),
    "contacts": FigureKind(_touches, _contacts, of_all=True),
    "plan": FigureKind(_rolls, _plan, of_all=True),
    "loops": FigureKind(lambda scene: bool(scene.loops), _loops, of_all=True),
    "forces": FigureKind(lambda scene: bool(scene.loading), _forces, of_all=True),
    "lever": FigureKind(lambda scene: bool(scene.loading), _lever, of_all=True),
}
"""Every figure of `draw` by its name: the one place where a further figure is entered."""


def known_figures(scene: Mechanism, names: Sequence[str] | None) -> tuple[str, ...]:
    """The figures asked for, each once; without names the five that every scene has, and those it has a table for.

    Raises
    ------
    CallError : every name that is no figure
    """
    if names is None:
        return tuple(name for name, figure in FIGURES.items() if figure.by_itself(scene))
    wanted = Phrase("give a list velocity")
    if isinstance(names, str):
        raise CallError(Problem("figures", Phrase("found value", value=f'{names!r:.60}'), wanted))
    names = as_list("figures", names, wanted)
    known = [isinstance(name, str) and name in FIGURES for name in names]
    wrong = [
        Problem("figure", f'"{name!s:.60}"', did_you_mean(str(name)[:60], FIGURES))
        for name, right in zip(names, known, strict=True) if not right
    ]  # fmt: skip
    if wrong:
        raise CallError(*wrong)
    return tuple(dict.fromkeys(names))


def draw(
    scene: SceneLike,
    out: str | os.PathLike[str] | None = None,
    at: At = None,
    find: Iterable[str | Symbol] | None = None,
    formats: Sequence[str] = ("svg",),
    language: str | None = None,
    convention: str | None = None,
    instrument: str = "exact",
    seed: int = 0,
    figures: Sequence[str] | None = None,
    driver: str = "",
    beside: Sequence[str | float] = (),
) -> Drawn:
    """Draw a scene step by step, check it, and write the figures if a folder is given.

    Parameters
    ----------
    scene, at, find, instrument, seed : as for `check`
    out : folder for the figures in each of the ``formats``, readings.csv and report.txt
    figures : names of figures, to draw these only; without it mechanism, velocity, acceleration, sheet, centres, and
        those for which the scene has a table
    beside : of the figure "polygons": names of positions, or values of the first driver, whose polygons stand beside
        each other; without it those that `[positions]` shows
    driver : of the figure "structure": a link that drives instead of the scene's first driver, shown beside it
    language : "en", "zh" or "both" (on the figures; the report is in English then); the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    from graphkin import solver

    known_words(formats, language, convention, instrument, known_languages=ON_SHEETS)
    given = as_scene(scene)
    wanted = known_figures(given, figures)
    asked = drawn_symbols(given, find)
    given = for_paper(given, () if any(FIGURES[name].of_all for name in wanted) else asked_here(asked))
    given, values = placed(given, at)
    hand = hand_of(given, instrument, seed)
    structure = solver.structure_of(given)
    motion = solved_here(structure, values, asked_here(asked))
    what = plan(structure, values, asked_here(asked))
    whole = with_elsewhere(checked(what, motion, hand), asked, seed)
    places = tuple(as_list("beside", beside, Phrase("give names of positions or driver values 1")))
    drawn = Drawn(whole, what, motion, wanted, seed, language, convention, driver, places)
    if out is not None:
        drawn.write(out, formats)
    return drawn
