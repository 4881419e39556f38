"""``graphkin study``: the methods compared, as charts: speed and accuracy, and the positions where each fails."""

from __future__ import annotations

import html
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from graphkin.api.arguments import CHART_FORMATS, as_scene, known_words, unknown_words, whole_number
from graphkin.api.results import Result, named
from graphkin.errors import CallError, as_list
from graphkin.files import Json, path_of
from graphkin.scene.scene import SceneLike
from graphkin.table import Table
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.drawing.chart import ChartPage
    from graphkin.races import Entry, Race
    from graphkin.study.error_laws import Singularity

T = TypeVar("T")


def charts_html(study: Result) -> str:
    """The charts of a study with their titles, for a notebook."""
    return "".join(f"<figure>{f._repr_svg_()}<figcaption>{html.escape(f.title)}</figcaption></figure>"
                   for f in study.figures.values())


@dataclass(frozen=True, repr=False, eq=False)
class SpeedAccuracy(Result):
    """The cost of each method for a position, and its error: measured in one run on this machine."""

    name, table_file = "speed-accuracy", "speed-accuracy.csv"
    figure_formats, _repr_html_ = CHART_FORMATS, charts_html
    race: Race
    language: str

    def __getitem__(self, method: str) -> tuple[Entry, ...]:
        """The results of a method by its name in the table: several entries for several steps, scales or sizes."""
        entries = self.race.entries
        rows = {e.key: tuple(o for o in entries if o.key == e.key) for e in entries}
        return named(rows, method, where="method")

    @cached_property
    def figures(self) -> Mapping[str, ChartPage]:
        """The chart: velocity and acceleration side by side."""
        from graphkin.races import race_page

        return {"speed-accuracy": race_page(self.race, self.language)}

    @property
    def ok(self) -> bool:
        """Whether a method was measured."""
        return bool(self.race.entries)

    @cached_property
    def table(self) -> Table:
        """A row for each method: the cost of a position (s), and its largest errors; first the floor."""
        from graphkin.races import race_table

        return race_table(self.race)

    @cached_property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin study speed-accuracy --json`` prints."""
        from graphkin.races import to_json

        return to_json(self.race)

    def __repr__(self) -> str:
        return f"<SpeedAccuracy {self.race.scene.name}: {len(self.race.entries)} methods>"

def speed_accuracy(
    scene: SceneLike, *, repeats: int = 5, out: str | os.PathLike[str] | None = None, language: str | None = None
) -> SpeedAccuracy:
    """Let every method work the same scene: cost of a position against the largest error.

    Drawing with pencil, on a CAD screen and exactly, instant centres, the closed form in its several forms, Newton's
    method, differences, a complex step, and peers where they are installed.

    Parameters
    ----------
    scene : as for `solve`; a mechanism without groups larger than a dyad
    repeats : runs of each method, the fastest counts
    language : "en" or "zh"; the scene's own if None
    out : folder for the chart (SVG) and speed-accuracy.csv

    Raises
    ------
    SceneError, CallError : the scene or the call is wrong, or mpmath is not installed (extra ``study``)
    Unsolvable : wrong mobility, no position can be assembled
    """
    from graphkin.races import race

    given = as_scene(scene)
    repeats = whole_number("repeats", repeats, 1, 1000)
    known_words(language=language)
    _ = out is None or path_of(out)  # what is wrong with it is said before minutes of work
    return SpeedAccuracy(race(given, repeats), language or given.question.sheet.language).saved(out)


@dataclass(frozen=True, repr=False, eq=False)
class Stability(Result):
    """The error of each method against the distance from each kind of singular position, with fitted slopes."""

    name, table_file = "stability", "stability.csv"
    figure_formats, _repr_html_ = CHART_FORMATS, charts_html
    singularities: tuple[Singularity, ...]
    language: str

    def __getitem__(self, kind: str) -> Singularity:
        """A kind of singular position, by its name."""
        return named({singularity.key: singularity for singularity in self.singularities}, kind, where="kind")

    @cached_property
    def figures(self) -> Mapping[str, ChartPage]:
        """The charts by name, six singularities on each."""
        from graphkin.study.error_laws import stability_pages

        return stability_pages(self.singularities, self.language)

    @property
    def ok(self) -> bool:
        """Whether any error was measured."""
        return bool(self.singularities)

    @cached_property
    def table(self) -> Table:
        """All points of all curves; a point without an error is a refusal."""
        from graphkin.study.error_laws import laws_table

        return laws_table(self.singularities)

    @cached_property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin study stability --json`` prints."""
        from graphkin.study.error_laws import to_json

        return to_json(self.singularities)

    def __repr__(self) -> str:
        return f"<Stability: {', '.join(place.key for place in self.singularities)}>"

def stability(
    *, kinds: Iterable[str] = (), samples: int = 4, out: str | os.PathLike[str] | None = None, language: str = "en"
) -> Stability:
    """Measure the growth of each method's error near singular positions, and where it gives no answer.

    Parameters
    ----------
    kinds : singularities by name ("dead point RRR", "parallel lines", ...); all if none is named
    samples : distances to each half of a decade; the largest error of them counts
    language : "en" or "zh"
    out : folder for the charts (SVG) and stability.csv

    Raises
    ------
    CallError : an unknown name, or mpmath is not installed (extra ``study``)

    Examples
    --------
    >>> found = stability(kinds=["crossing height"], samples=2)
    >>> round(found["crossing height"]["height by squares"].slope, 1)
    -1.0
    """
    from graphkin.study.singular_positions import KINDS, run_singularities

    wanted = tuple(as_list("kinds", kinds, Phrase("give a list of", names='["dead point RRR"]')))
    if wrong := unknown_words("kind", wanted, KINDS):
        raise CallError(*wrong)
    samples = whole_number("samples", samples, 1, 100)
    known_words(language=language)
    _ = out is None or path_of(out)
    return Stability(run_singularities(wanted, samples), language).saved(out)
