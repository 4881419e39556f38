"""``graphkin centres --centrode``: the centrodes of a link over a turn, with the path of a point of it."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from graphkin.api.arguments import ON_SHEETS, At, SceneLike, as_scene, known_words, placed
from graphkin.api.centred import found_centres
from graphkin.api.checked import solved_here
from graphkin.api.results import OfScene, Result
from graphkin.construction.centres import Centres
from graphkin.errors import CallError, as_text, did_you_mean
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.drawing import Drawing
    from graphkin.solver import Motion
    from graphkin.solver.motion import Centrode
    from graphkin.table import Table

__all__ = ["Centroded", "centrodes"]

POSITIONS = 3600
STILL = 1e-9


@dataclass(frozen=True, repr=False, eq=False)
class Centroded(OfScene, Result):
    """The fixed and the moving centrode of a link, and the path of a point of it (complex arrays over the turn, m)."""

    centres: Centres
    motion: Motion
    curves: Centrode
    link: str
    point: str
    language: str | None = None
    convention: str | None = None

    @property
    def mechanism(self) -> Mechanism:
        return self.centres.scene

    @property
    def ok(self) -> bool:
        """Whether the centre drawn at this position lies on the fixed centrode, to 1e-9 of the mechanism's size."""
        centre = self.centres.of(self.link, self.mechanism.frame.name)
        if centre.point is None or not np.isfinite(self.curves.fixed[0]):
            return True
        away = abs(centre.point / self.centres.mm - complex(self.curves.fixed[0]))
        return bool(away <= 1e-9 * max(self.mechanism.size, abs(complex(self.curves.fixed[0]))))

    @property
    def path(self) -> NDArray[np.complex128]:
        """Places of the point over the turn (m), empty without one."""
        return self.motion.position(self.point, self.link) if self.point else np.zeros(0, dtype=np.complex128)

    @property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin centres --centrode --json`` prints, but for the files."""
        return {"link": self.link, "ok": self.ok}

    @cached_property
    def table(self) -> Table:
        """Both curves over the turn and the driver's value in the file's units, the moving one in the link's axes."""
        from graphkin.table import Column, Table

        length, own = self.mechanism.units.of("length"), self.mechanism.unit_of(self.mechanism.drivers[0])
        columns = [Column("driver", own.of(self.motion.values[:, 0]), own.text, form=".12g")]
        for name, curve in (("fixed", self.curves.fixed), ("moving", self.curves.moving)):
            places = np.where(np.isfinite(curve), curve, complex(np.nan, np.nan))
            parts = zip("xy", (places.real, places.imag), strict=True)
            columns += [Column(f"{name}_{axis}", length.of(part), length.text, form=".12g") for axis, part in parts]
        return Table(tuple(columns))

    @cached_property
    def figure(self) -> Drawing:
        from graphkin.drawing.figures.centres_in_motion import centrodes_figure

        mm = self.centres.mm
        pose = self.centres.poses[self.link]
        moving = pose.origin + pose.axis * self.curves.moving * mm
        path = self.path * mm
        whole = np.isfinite(path[:-1]) & np.isfinite(path[1:]) if self.point else np.zeros(0, dtype=bool)
        return centrodes_figure(
            self.centres,
            self.link,
            _branches(self.curves.fixed * mm, self.curves.joined),
            _branches(moving, self.curves.joined),
            _branches(path, whole),
            self.point,
            language=self.language,
            convention=self.convention,
        )

    @property
    def figures(self) -> Mapping[str, Drawing]:
        return {"centrode": self.figure}

    @property
    def tables(self) -> Mapping[str, Table]:
        return {"centrode.csv": self.table}

    def __repr__(self) -> str:
        return f"<Centroded {self.mechanism.name}: link {self.link}>"


def _branches(places: NDArray[np.complex128], joined: NDArray[np.bool_]) -> list[list[complex]]:
    """Places in runs that a pen draws without lifting; the end of a turn joins its start."""
    runs: list[list[complex]] = []
    run: list[complex] = []
    for i, z in enumerate(places.tolist()):
        if np.isfinite(z):
            run.append(z)
        if (i == len(places) - 1 or not joined[i]) and run:
            runs.append(run)
            run = []
    if len(places) and np.isfinite(places[0]) and np.isfinite(places[-1]) and joined[0] and joined[-1]:
        step = abs(places[1] - places[0]) + abs(places[-1] - places[-2])
        if abs(places[0] - places[-1]) <= step:
            runs[-1].append(complex(places[0]))
    return runs


def centrodes(
    scene: SceneLike,
    *,
    at: At = None,
    link: str,
    point: str = "",
    out: str | os.PathLike[str] | None = None,
    formats: Sequence[str] = ("svg",),
    language: str | None = None,
    convention: str | None = None,
) -> Centroded:
    """The fixed and the moving centrode of a link over a turn of the driver.

    Parameters
    ----------
    scene, at : as for `solve`; the moving centrode is shown where it lies at this position
    link : a moving link that neither turns about a fixed pivot nor only slides
    point : a point of the link, whose path is shown too
    out, formats, language, convention : as for `draw`

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    from graphkin.solver import solve
    from graphkin.solver.motion import centrode
    from graphkin.study.centre_paths import steady

    known_words(formats, language, convention, known_languages=ON_SHEETS)
    given = as_scene(scene)
    given, values = placed(given, at)
    _check_names(given, link, point)
    solved_here(given, values)
    given = steady(given)
    motion = solve(given, at=values, sweep=POSITIONS)
    curves = centrode(motion, link)
    turning = np.abs(motion.omega(link)[motion.ok])
    if not len(turning) or turning.max() <= STILL * max(abs(d.values[1]) for d in given.drivers):
        raise CallError.of(f"centrode {link}", "the link never turns its centre is always", "name a link that turns")
    good = curves.fixed[np.isfinite(curves.fixed)]
    if np.abs(good - good[0]).max() <= STILL * given.size:
        raise CallError.of(f"centrode {link}", "the link turns about a fixed pivot its",
                           "name a link with no fixed pivot")
    centroded = Centroded(found_centres(given, values), motion, curves, link, point, language, convention)
    if out is not None:
        centroded.write(out, formats)
    return centroded


def _check_names(scene: Mechanism, link: str, point: str) -> None:
    as_text("point", point)
    names = [n.name for n in scene.links if not n.redundant]
    if as_text("link", link) not in names:
        raise CallError.of(f"centrode {link}", "there is no moving link", did_you_mean(link, names), link=link)
    points = scene.by_name[link].points
    if point and point not in points:
        raise CallError.of(Phrase("point", point=point), "link has no such point", did_you_mean(point, points),
                           link=link)
