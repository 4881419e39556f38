"""``graphkin centres``: every instant centre with its construction, the velocities taken through them, and the check;
with ``--centrode`` the centrodes of a link over a turn, and the path of a point of it."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from graphkin.account.centres import how_found, place_of, velocity_sentences
from graphkin.account.notation import Notation
from graphkin.api.arguments import ON_SHEETS, At, as_scene, for_paper, known_words, own_folder, placed
from graphkin.api.results import OfScene, Result
from graphkin.checking.centres import TOLERANCE, SpeedByCentres, centre_errors, velocities_by_centres
from graphkin.construction.board.scales import Room
from graphkin.construction.centres import Centre, Centres, LinkPair, Turning, find_centres
from graphkin.errors import CallError, as_text, did_you_mean
from graphkin.files import Json, write_files
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike
from graphkin.scene.symbol import PointRef
from graphkin.solver import Motion, solved_here
from graphkin.solver.values import as_drawn
from graphkin.structure import Structure
from graphkin.study.centrodes import Centrode, branches, centrode, played, pole_path, steady, turning_centrodes
from graphkin.table import Column, Table
from graphkin.words import Phrase, languages, listed, rich_text, say, word

if TYPE_CHECKING:
    from graphkin.drawing import Drawing


def centres_text(centred: Centred) -> tuple[list[str], list[tuple[str, str, str, str]], list[str]]:
    """All centres of a position in words, in the language of the result: heads and rows of the table, and sentences
    below it."""
    language, centres, scene = centred.spoken, centred.centres, centred.mechanism
    letters = Notation(centred.convention or scene.question.sheet.convention)  # type: ignore[arg-type]

    def name(part: object) -> str:
        if isinstance(part, PointRef):
            return part.point
        return letters.centre(part).plain("") if isinstance(part, tuple) else str(part)

    rows = []
    for centre in centres.found:
        place = ", ".join(f"{x:.6g}" for x in place_of(centres, centre) or ())
        if place:
            place = f"∞ ({place})" if centre.point is None else f"{place} {scene.units.length}"
        how = say(how_found(centres, centre, name), language, name)
        rows.append((str(centre.number or ""), name(centre.pair), place, how))
    why = [say(c.why, language, str) for c in centres.indeterminate if c.why]
    velocities = [rich_text(said, language, name).plain("") for said in velocity_sentences(centres)]
    wrong = [name(p) for p, distance in centred.compared.items() if distance is not None and distance[0] > distance[1]]
    wrong += [str(v.symbol) for v in centred.velocities if v.ok is False]
    near = [v.too_near(language) for v in centred.velocities if v.ok is None]
    count = sum(e is not None for e in centred.errors.values())
    still = [name(centre.pair) for centre in centres.found if centred.errors[centre.pair] is None]
    verdict = Phrase("centres checked", centres=count)
    if wrong:
        verdict = Phrase("check failed", readings=listed(wrong))
    elif still:
        verdict = Phrase("centres checked but", centres=count, still=listed(still))
    heads = ["", *(word(key, language) for key in ("centre", "place", "how found"))]
    head = [*why, *[""] * bool(why), *[word("velocities by centres", language)] * bool(velocities)]
    return heads, rows, [*head, *velocities, *near, say(verdict, language)]


MOST_PLAYED = 6  # links all of whose centres are played
ROOM = Room(mechanism=(90.0, 75.0))  # mm: the mechanism is drawn small, so that its centres find room around it


@dataclass(frozen=True, repr=False)
class PlacedCentre:
    """An instant centre in the file's unit of length.

    pair, kind : as in ``Centred.data``
    place : x + iy; of a centre at infinity (``far``) the direction to it, without a unit; None where it is undetermined
    unit : of ``place``
    """

    pair: str
    kind: str
    place: complex | None
    far: bool
    unit: str

    def __repr__(self) -> str:
        if self.place is None:
            return f"<centre {self.pair}: {self.kind}>"
        where = f"({self.place.real:.6g}, {self.place.imag:.6g})"
        place = f"at infinity, in the direction {where}" if self.far else f"at {where} {self.unit}"
        return f"<centre {self.pair}: {self.kind}, {place}>"


@dataclass(frozen=True, repr=False, eq=False)
class Centred(OfScene, Result):
    """All instant centres of a scene at one position, with their check.

    ``errors`` holds for each centre its distance from the exact one, as an angle seen from the middle of the mechanism
    at half its size (so that far centres are judged by their direction), None where the two links do not move relative
    to each other.  ``moving`` is the motion that has the same centres where the mechanism rests.
    """

    table_file = "centres.csv"

    centres: Centres
    motion: Motion
    language: str | None = None
    convention: str | None = None
    moving: Motion | None = None

    @property
    def mechanism(self) -> Mechanism:
        return self.centres.scene

    @property
    def turning(self) -> Mapping[str, Turning]:
        """The motion of each link by centres."""
        return self.centres.turning

    @property
    def spoken(self) -> str:
        """Its first language."""
        return languages(self.language or self.mechanism.question.sheet.language)[0]

    @cached_property
    def errors(self) -> dict[LinkPair, float | None]:
        return {pair: distance and distance[0] for pair, distance in self.compared.items()}

    @cached_property
    def compared(self) -> dict[LinkPair, tuple[float, float] | None]:
        """For each centre its error and the allowed error."""
        return centre_errors(self.centres, self.moving or self.motion)

    @cached_property
    def velocities(self) -> tuple[SpeedByCentres, ...]:
        """The asked velocities, or the angular velocity of every link and the velocity of every moving pin."""
        return velocities_by_centres(self.centres, self.motion)

    @property
    def ok(self) -> bool:
        """Whether all centres and all velocities through them agree with the analytic solver."""
        near = all(distance is None or distance[0] <= distance[1] for distance in self.compared.values())
        return near and all(v.ok is not False for v in self.velocities)

    @cached_property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin centres --json`` prints."""
        names = self.centres.names
        return {
            "links": list(names),
            "centres": {_name(pair): self._centre(centre) for pair, centre in self.centres.table.items()},
            "velocities": {str(v.symbol): self._velocity(v) for v in self.velocities},
            "ok": self.ok,
        }

    def _centre(self, centre: Centre) -> dict[str, Json]:
        row: dict[str, Json] = {}
        if where := place_of(self.centres, centre):
            row["direction" if centre.point is None else "point"] = list(where)
        row["kind"] = centre.kind
        if centre.lines or centre.way:
            row["by"] = centre.way or _crossing(centre)
        if centre.number and centre.kind == "found":
            row["number"] = centre.number
        if centre.why:
            row["why"] = say(centre.why)
        return row

    def _velocity(self, v: SpeedByCentres) -> dict[str, Json]:
        unit = self.mechanism.units.rates.metres if v.symbol.is_vector else 1.0
        by_centres, exact = (None if x is None else abs(x) / unit if v.symbol.is_vector else float(x.real) + 0.0
                             for x in (v.by_centres, v.exact))
        row: dict[str, Json] = {"by_centres": by_centres, "exact": exact, "chain": list(v.chain), "ok": v.ok}
        if v.ok and v.tolerance > 1.01 * TOLERANCE * v.largest:
            row["tolerance"] = v.tolerance / unit  # worse than everywhere else
        return row if v.ok is not None else row | {"by_centres": None, "why": v.too_near("en")}

    @cached_property
    def in_motion(self) -> Drawing:
        """The centres over the whole motion with their paths: an SVG that plays.  Of many links only the centres
        against the frame."""
        from graphkin.drawing.boxes import FigurePage
        from graphkin.drawing.figures.centres_in_motion import centres_in_motion

        frame, whole = self.mechanism.frame.name, self.mechanism.whole
        few = len(self.centres.names) <= MOST_PLAYED
        # bars for cams at one position are none of the links that move
        pairs = [p for p in self.centres.table if (few or frame in p) and whole.by_name.keys() >= {*p}]
        values = self.mechanism.by_driver(self.motion.values[0])
        (motion, turned), mm = played(self.mechanism, values), self.centres.mm
        moving = [p for p in motion.scene.holders if p not in motion.scene.frame.points]
        origins = {name: np.asarray(motion.poses[name].z * mm, np.complex128) for name in turned}
        points = {p: np.asarray(motion.position(p) * mm, np.complex128) for p in moving}
        paths = {pair: pole_path(motion, pair) * mm for pair in pairs}
        page = FigurePage.of(self.centres.sheet, "centres", self.language, self.convention)
        return centres_in_motion(page, self.centres, origins, turned, points, paths)

    def __getitem__(self, name: str) -> PlacedCentre | SpeedByCentres:
        """A centre by its links ("1-3"), or a velocity by its symbol ("v_D", "omega_3"), in the file's units.  Raises
        CallError."""
        links = tuple(as_text("name", name).split("-"))
        centre = next((c for p, c in self.centres.table.items() if links in (p, p[::-1])), None)
        if centre is not None:
            where, unit = place_of(self.centres, centre), self.mechanism.units.length
            place = complex(*where) if where else None
            return PlacedCentre(_name(centre.pair), centre.kind, place, centre.point is None, unit)
        taken = {str(v.symbol): v for v in self.velocities}
        if name not in taken:
            known = [*map(_name, self.centres.table), *taken]
            raise CallError.of(f'"{name}"', "no centre or velocity of this name", did_you_mean(name, known))
        return taken[name].in_units(self.mechanism)

    @cached_property
    def table(self) -> Table:
        """A row for each centre, in scene units, with its construction and its distance from the exact one."""
        rows = []
        for pair, centre in self.centres.table.items():
            by = centre.way or " x ".join(" ".join(line) for line in _crossing(centre)) or centre.joint
            x, y = place_of(self.centres, centre) or (None, None)
            where = (x, y, None, None) if centre.point is not None else (None, None, x, y)
            rows.append((_name(pair), centre.kind, centre.number or None, *where, by, self.errors[pair]))
        heads = ("pair", "kind", "number", "x", "y", "direction_x", "direction_y", "by", "error")
        length = self.mechanism.units.length
        units = {"x": length, "y": length, "error": "rad"}
        return Table.of(heads, rows, ("", "", "g", *(".12g",) * 4, "", ".3g"), [units.get(head, "") for head in heads])

    @cached_property
    def figure(self) -> Drawing:
        """The mechanism with all its centres, and the circle diagram."""
        from graphkin.drawing.boxes import FigurePage
        from graphkin.drawing.figures.centres import centres_figure

        for_paper(self.mechanism)
        page = FigurePage.of(self.centres.sheet, "centres", self.language, self.convention)
        return centres_figure(page, self.centres)

    @cached_property
    def figures(self) -> Mapping[str, Drawing]:
        """``figure`` ("centres"), and its further pages ("centres-2")."""
        return {"centres": self.figure, **{f"centres-{n}": page for n, page in enumerate(self.figure.further, 2)}}

    def write(
        self, folder: str | os.PathLike[str] | None = None, formats: Sequence[str] = ("svg",), text: str = "glyphs",
        motion: bool = False,
    ) -> list[Path]:
        """Write figures and table as every result does, and with ``motion`` centres-motion.svg, which plays; returns
        the paths.  Raises CallError for an unknown format or a folder that cannot be written."""
        paths = super().write(folder, formats, text)
        if motion:
            playing = self.in_motion.content("svg", text=text)
            paths += write_files(own_folder(folder, self.name), {"centres-motion.svg": playing})
        return paths

    def __repr__(self) -> str:
        return f"<Centred {self.mechanism.name}: {len(self.centres.table)} centres>"


def found_centres(of: Mechanism | Structure, values: Mapping[str, float] | None) -> Centres:
    """All centres at driver values in SI, on a drawing at its own scale with room around the mechanism."""
    centres = find_centres(of, values)
    return centres.at(centres.sheet.scales_for(ROOM))


def _name(pair: LinkPair) -> str:
    return "-".join(pair)


def _crossing(centre: Centre) -> list[list[str]]:
    """The points on each line that crosses at a centre."""
    return [[p if isinstance(p, str) else _name(p) for p in line.through] for line in centre.lines]


def centres(
    scene: SceneLike,
    *,
    at: At = None,
    out: str | os.PathLike[str] | None = None,
    formats: Sequence[str] = ("svg",),
    language: str | None = None,
    convention: str | None = None,
) -> Centred:
    """Find all instant centres on the drawing board, take the velocities through them, and check both.

    Parameters
    ----------
    scene, at : as for `solve`
    out : folder for centres.svg (in each of the ``formats``) and centres.csv; nothing is written without it
    language, convention : as for `draw`

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point

    Examples
    --------
    >>> centred = centres("cam-eccentric-flat-rocker")
    >>> [round(x, 3) for x in centred.data["centres"]["1-2"]["point"]]
    [-28.603, 0.0]
    >>> round(centred.data["velocities"]["omega_2"]["by_centres"], 5)
    2.63374
    """
    known_words(formats, language, convention, known_languages=ON_SHEETS)
    given, values = placed(as_scene(scene), at)
    motion = solved_here(given, values)
    poles = found_centres(motion.structure, values)
    rests = not any(pose.omega[0] or pose.v[0] for pose in motion.poses.values())
    moving = as_drawn(motion.growing, poles.sheet.structure) if rests else None
    drawn = as_drawn(motion, poles.sheet.structure)
    return Centred(poles, drawn, language, convention, moving).saved(out, formats)


# centrodes

@dataclass(frozen=True, repr=False, eq=False)
class Centroded(OfScene, Result):
    """The fixed and the moving centrode of a link, and the path of a point of it (complex arrays over the turn, m);
    ``exact`` is the centre at this position by the solver (m), not a number where the link does not turn."""

    table_file = "centrode.csv"

    centres: Centres
    motion: Motion
    curves: Centrode
    exact: complex
    link: str
    point: str
    language: str | None = None
    convention: str | None = None

    @property
    def mechanism(self) -> Mechanism:
        return self.centres.scene

    @property
    def ok(self) -> bool:
        """Whether the centre drawn at this position is the exact one, to 1e-9 of the mechanism's size."""
        point = self.centres.of(self.link, self.mechanism.frame.name).point
        if point is None or not np.isfinite(self.exact):
            return True
        return abs(point / self.centres.mm - self.exact) <= 1e-9 * max(self.mechanism.size, abs(self.exact))

    @property
    def path(self) -> NDArray[np.complex128]:
        """Places of the point over the turn (m), empty without one."""
        return self.motion.position(self.point, self.link) if self.point else np.zeros(0, dtype=np.complex128)

    @property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin centres --centrode --json`` prints, without the files."""
        return {"link": self.link, "ok": self.ok}

    @cached_property
    def table(self) -> Table:
        """Both curves over the turn and the driver's value in the file's units, the moving one in the link's axes."""
        length, unit = self.mechanism.units.of("length"), self.mechanism.unit_of(self.mechanism.drivers[0])
        columns = [Column("driver", unit.of(self.motion.values[:, 0]), unit.text, form=".12g")]
        for name, curve in (("fixed", self.curves.fixed), ("moving", self.curves.moving)):
            places = np.where(np.isfinite(curve), curve, complex(np.nan, np.nan))
            parts = zip("xy", (places.real, places.imag), strict=True)
            columns += [Column(f"{name}_{axis}", length.of(part), length.text, form=".12g") for axis, part in parts]
        return Table(tuple(columns))

    @cached_property
    def figure(self) -> Drawing:
        from graphkin.drawing.boxes import FigurePage
        from graphkin.drawing.figures.centres_in_motion import centrodes_figure

        mm, pose, joined = self.centres.mm, self.centres.poses[self.link], self.curves.joined
        moving, path = pose.origin + pose.axis * self.curves.moving * mm, self.path * mm
        whole = np.isfinite(path[:-1]) & np.isfinite(path[1:]) if self.point else np.zeros(0, dtype=bool)
        curves = branches(self.curves.fixed * mm, joined), branches(moving, joined), branches(path, whole)
        page = FigurePage.of(self.centres.sheet, "centrodes", self.language, self.convention)
        return centrodes_figure(page, self.centres, self.link, *curves, self.point)

    @property
    def figures(self) -> Mapping[str, Drawing]:
        return {"centrode": self.figure}

    def __repr__(self) -> str:
        return f"<Centroded {self.mechanism.name}: link {self.link}>"


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
    scene, at : as for `solve`; the moving centrode is shown at this position
    link : a moving link that neither turns about a fixed pivot nor only slides
    point : a point of the link, whose path is shown too
    out : folder for centrode.svg (in each of the ``formats``) and centrode.csv; nothing is written without it
    language, convention : as for `draw`

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    known_words(formats, language, convention, known_languages=ON_SHEETS)
    given, values = placed(as_scene(scene), at)
    as_text("point", point)
    names = [n.name for n in given.links if not n.redundant]
    if as_text("link", link) not in names:
        raise CallError.of(f"centrode {link}", "there is no moving link", did_you_mean(link, names), link=link)
    points = given.by_name[link].points
    if point and point not in points:
        raise CallError.of(Phrase("point", point=point), "link has no such point", did_you_mean(point, points),
                           link=link)
    solved_here(given, values)
    given = steady(given)
    motion, curves = turning_centrodes(given, values, link)
    exact = complex(centrode(solved_here(given, values), link).fixed[0])
    poles = found_centres(given, values)
    return Centroded(poles, motion, curves, exact, link, point, language, convention).saved(out, formats)
