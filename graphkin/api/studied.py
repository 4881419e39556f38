"""``graphkin study``: the methods against each other, as charts: speed and accuracy, and where each fails."""

from __future__ import annotations

import html
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphkin.api.arguments import SceneLike, as_scene, known_words, write_files
from graphkin.errors import CallError, Problem, did_you_mean

if TYPE_CHECKING:
    from graphkin.drawing import Chart
    from graphkin.study.limits import Trial
    from graphkin.study.speed import Race

__all__ = ["SpeedAccuracy", "Stability", "speed_accuracy", "stability"]


@dataclass(frozen=True, repr=False)
class SpeedAccuracy:
    """What each method costs for one position, and how far it is off: measured in one run on this machine."""

    race: Race
    language: str

    @cached_property
    def figures(self) -> Mapping[str, Chart]:
        """The chart: velocity and acceleration side by side."""
        from graphkin.study.speed import page

        return {"speed-accuracy": page(self.race, self.language)}

    @property
    def table(self) -> str:
        """A row for each method, as the text of a CSV file."""
        from graphkin.study.speed import race_csv

        return race_csv(self.race)

    @cached_property
    def data(self) -> dict[str, Any]:
        """The object that ``graphkin study speed-accuracy --json`` prints."""
        from graphkin.study.speed import to_json

        return to_json(self.race, self.language)

    def write(self, folder: str | os.PathLike[str] = "speed-accuracy", formats: Sequence[str] = ("svg",)) -> list[Path]:
        """Write the chart and speed-accuracy.csv; returns the paths.  Raises CallError as for `Stability.write`."""
        return _written(Path(folder), self.figures, "speed-accuracy.csv", self.table, formats)

    def __repr__(self) -> str:
        return f"<SpeedAccuracy {self.race.scene.name}: {len(self.race.entries)} methods>"

    def _repr_html_(self) -> str:
        return _shown(self.figures)


def speed_accuracy(
    scene: SceneLike, repeats: int = 5, language: str | None = None, out: str | os.PathLike[str] | None = None
) -> SpeedAccuracy:
    """Let every method work the same scene: cost of a position against the largest error.

    Drawing with pencil, on a CAD screen and exactly, instant centres, the closed form in its several dresses, Newton's
    method, differences, a complex step, and peers where they are installed.

    Parameters
    ----------
    scene : as for `solve`; a mechanism without groups larger than a dyad
    repeats : runs of each method, of which the fastest counts
    language : "en" or "zh"; the scene's own if None
    out : folder for the chart (SVG) and speed-accuracy.csv

    Raises
    ------
    SceneError, CallError : the scene or the call is wrong, or mpmath is not installed (extra ``study``)
    Unsolvable : wrong mobility, no position can be assembled
    """
    from graphkin.study.speed import race

    given = as_scene(scene)
    if not 1 <= repeats <= 1000:
        raise CallError(Problem("repeats", f"{repeats}", "give a number from 1 to 1000"))
    spoken = language or given.sheet.language
    known_words(language=spoken)
    found = SpeedAccuracy(race(given, repeats), spoken)
    if out is not None:
        found.write(out)
    return found


@dataclass(frozen=True, repr=False)
class Stability:
    """The error of each method against the distance from each kind of singular position, with fitted slopes."""

    trials: tuple[Trial, ...]
    language: str

    def __getitem__(self, kind: str) -> Trial:
        return next(trial for trial in self.trials if trial.key == kind)

    @cached_property
    def figures(self) -> Mapping[str, Chart]:
        """The charts by name, six singularities on each."""
        from graphkin.study.limits import pages

        return pages(self.trials, self.language)

    @property
    def table(self) -> str:
        """All points of all curves, as the text of a CSV file."""
        from graphkin.study.limits import laws_csv

        return laws_csv(self.trials)

    @cached_property
    def data(self) -> dict[str, Any]:
        """The object that ``graphkin study stability --json`` prints."""
        from graphkin.study.limits import to_json

        return to_json(self.trials, self.language)

    def write(self, folder: str | os.PathLike[str] = "stability", formats: Sequence[str] = ("svg",)) -> list[Path]:
        """Write the charts and stability.csv; returns the paths.  Raises CallError for an unknown format or a folder
        that cannot be written."""
        return _written(Path(folder), self.figures, "stability.csv", self.table, formats)

    def __repr__(self) -> str:
        return f"<Stability: {', '.join(trial.key for trial in self.trials)}>"

    def _repr_html_(self) -> str:
        return _shown(self.figures)


def stability(
    kinds: Iterable[str] = (), samples: int = 4, language: str = "en", out: str | os.PathLike[str] | None = None
) -> Stability:
    """Measure how the error of each method grows beside singular positions, and where it stops giving an answer.

    Parameters
    ----------
    kinds : which singularities, by name ("dead point RRR", "parallel lines", ...); all if none is named
    samples : distances to each half of a decade; the largest error of them counts
    language : "en" or "zh"
    out : folder for the charts (SVG) and stability.csv

    Raises
    ------
    CallError : an unknown name, or mpmath is not installed (extra ``study``)

    Examples
    --------
    >>> found = stability(["crossing height"], samples=2)
    >>> round(found["crossing height"]["height by squares"].slope, 1)
    -1.0
    """
    from graphkin.study.limits import KINDS, run_trials

    wanted = tuple(kinds)
    wrong = [Problem("kind", f'"{kind}"', did_you_mean(kind, KINDS)) for kind in wanted if kind not in KINDS]
    if not 1 <= samples <= 100:
        wrong.append(Problem("samples", f"{samples}", "give a number from 1 to 100"))
    if wrong:
        raise CallError(*wrong)
    known_words(language=language)
    found = Stability(run_trials(wanted, samples), language)
    if out is not None:
        found.write(out)
    return found


def _written(
    folder: Path, figures: Mapping[str, Chart], name: str, table: str, formats: Sequence[str]
) -> list[Path]:
    known_words(formats)
    files = {f"{n}.{kind}": f.content(kind) for n, f in figures.items() for kind in formats}
    return write_files(folder, {**files, name: table.encode()})


def _shown(figures: Mapping[str, Chart]) -> str:
    return "".join(f"<figure>{f._repr_svg_()}<figcaption>{html.escape(f.title)}</figcaption></figure>"
                   for f in figures.values())
