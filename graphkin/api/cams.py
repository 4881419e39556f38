"""``graphkin cam``: cams examined, drawn by inversion, written as files for a milling machine."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from decimal import ROUND_DOWN, ROUND_HALF_EVEN, ROUND_UP, Context
from functools import cached_property

import numpy as np

from graphkin.api.arguments import ON_SHEETS, for_paper, known_words
from graphkin.api.results import OfScene, Result
from graphkin.checking.closed_form import CamPoints, compare_cam
from graphkin.construction import Sheet
from graphkin.construction.cam_sheet import divisions
from graphkin.drawing import Drawing
from graphkin.drawing.figures.constructions import cam_figure, scaled_cam
from graphkin.errors import CallError, Disagreement, Problem, unfit
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import LawCam
from graphkin.scene.scene import SceneLike
from graphkin.scene.tables import tidy
from graphkin.solver import structure_of
from graphkin.solver.cams import AtDegree, CamStudy, cam_at, least_base, study_cam
from graphkin.solver.discs import DiscCam, disc_cams, disc_course
from graphkin.table import Array, Column, Table, as_array
from graphkin.words import Neutral, Phrase, say
from graphkin.words.written import true_minus

STEP = 1.0
FINEST, COARSEST = 0.001, 30.0


@dataclass(frozen=True)
class CamMade:
    """A cam: its values, and its construction."""

    mechanism: Mechanism
    cam: LawCam

    @cached_property
    def study(self) -> CamStudy:
        return study_cam(self.cam)

    @cached_property
    def sheet(self) -> Sheet:
        """The construction at the scale of its figure.

        Raises
        ------
        Disagreement : it is not the computed cam
        """
        sheet = scaled_cam(self.mechanism, self.cam)
        off = compare_cam(self.cam, sheet)
        if not off.ok:
            slid, turned = (0.0, off.lift) if self.cam.turns else (off.lift, 0.0)
            most = f"{max(off.pitch, off.profile, slid) / self.mechanism.units.metres:.3g}"
            angle = f"{math.degrees(max(off.pressure, turned)):.3g}"
            fault = Phrase("is drawn off the computed cam", most=most, unit=self.mechanism.units.length, angle=angle)
            said = Phrase("no paper is written please report this scene")
            raise Disagreement(Problem(f"cams.{self.cam.link}", fault, said))
        return sheet

    @cached_property
    def drawn(self) -> CamPoints:
        """The drawn points compared with the computed ones."""
        return compare_cam(self.cam, self.sheet)

    @property
    def ok(self) -> bool:
        return self.study.ok and self.drawn.ok

    @property
    def _rate(self) -> float:
        """The rate of the law's degree (rad/s), where the cam is driven steadily about the frame; else 0."""
        driver = next((d for d in self.mechanism.drivers if d.key == self.cam.link), None)
        if driver is None or driver.relative_to != self.mechanism.frame.name or driver.second or driver.law is not None:
            return 0.0
        return self.cam.sense * driver.rate

    def _length(self, metres: float, rounding: str = ROUND_HALF_EVEN) -> str:
        """A length in the scene's unit; a limit rounded to the side on which it keeps what it is told to keep."""
        length = Context(prec=6, rounding=rounding).create_decimal_from_float(metres / self.mechanism.units.metres)
        return f"{float(length):.6g}"

    @cached_property
    def wanted_base(self) -> float | None:
        """The least base radius of the profile (m) that meets the wishes; None where the cam meets them, or no radius
        does."""
        return None if self.study.ok else least_base(self.cam)

    def phrases(self) -> list[Phrase]:
        """The sentences on it."""
        study, cam = self.study, self.cam
        unit = self.mechanism.units.length
        made = []
        for kind, most, kept, allowed in zip(
            ("rise", "fall"), (study.rise, study.fall), study.judged, cam.allowed, strict=True
        ):
            if most is None:
                continue
            said = Phrase("cam disc no pressure")  # under a flat face square to the line
            if most.value:
                said = Phrase(f"cam pressure {kind}", size=Neutral(f"{_degrees(most.value)}°"), place=_place(most))
            if kept is not None and allowed is not None:
                limit = f"{math.degrees(allowed):.6g}°"
                said = Phrase("cam kept" if kept else "cam exceeded", angle=said, allowed=limit)
            if said not in made:
                made.append(said)
        if study.radius is not None:
            size = Neutral(f"{true_minus(self._length(study.radius.value))} {unit}")
            made.append(Phrase("cam radius", size=size, place=_place(study.radius)))
        made += [self._undercut(start, end) for start, end in study.undercut]
        if self.wanted_base is not None:
            made.append(Phrase("cam base wanted", radius=self._length(self.wanted_base, ROUND_UP), unit=unit))
        made += self._rates()
        edge = "cam impact" if cam.flat or cam.roller else "cam impact corner"
        made += [Phrase(edge, angle=_degrees(jump.degree)) for jump in study.impacts]
        return made + [Phrase("cam soft impact", angle=_degrees(jump.degree)) for jump in study.soft_impacts]

    def _undercut(self, start: float, end: float) -> Phrase:
        unit = self.mechanism.units.length
        between = {"begin": _degrees(start), "end": _degrees(end)}
        if start == end:
            return Phrase("cam undercut corner", angle=_degrees(start))
        least = self.study.radius.value if self.study.radius is not None else 0.0
        if least >= 0.0:
            return Phrase("cam undercut crossing", **between)
        if self.cam.flat:
            radius = self._length(self.cam.base - least, ROUND_UP)
            return Phrase("cam undercut flat", **between, radius=radius, unit=unit)
        most = self._length(max(least + self.cam.roller, 0.0), ROUND_DOWN)
        return Phrase("cam undercut roller", **between, roller=self._length(self.cam.roller), unit=unit, most=most)

    def _rates(self) -> list[Phrase]:
        """The greatest velocity and acceleration: at the cam's own speed, or by its angle."""
        turns, phrases = self._rate, []
        units = self.mechanism.units
        for key, most, order in (("velocity", self.study.velocity, 1), ("acceleration", self.study.acceleration, 2)):
            value = most.value * (turns**order or 1.0)
            per = ("/s", "/s²") if turns else ("/rad", "/rad²")
            if self.cam.turns:
                name = "rad" + per[order - 1]
            else:
                value, name = value / units.metres, units.length + per[order - 1]
            if order == 2 and self.study.impacts:
                key = "acceleration beside impacts"
            size = Neutral(f"{true_minus(f'{value:.6g}')} {name}")
            phrases.append(Phrase(f"cam {key}", size=size, place=_place(most)))
        return phrases

    def sentences(self, language: str) -> list[str]:
        return [say(phrase, language) for phrase in self.phrases()]

    @property
    def data(self) -> dict[str, Json]:
        """Plain data: lengths in the scene's unit, angles in degrees of the cam under ``degree``, else radians."""
        metres, study = self.mechanism.units.metres, self.study
        lift = 1.0 if self.cam.turns else metres

        def degrees(angle: float) -> float:
            return tidy(math.degrees(angle))

        def at(extreme: AtDegree | None, per: float = 1.0) -> dict[str, float] | None:
            return None if extreme is None else {"value": extreme.value / per, "degree": degrees(extreme.degree)}

        return {
            "follower": self.cam.follower,
            "ok": self.ok,
            "base": {"profile": self.cam.base_of_profile / metres, "pitch": self.cam.base / metres},
            "rise": (self.cam.law.greatest - self.cam.law.least) / lift,
            "pressure": {"rise": at(study.rise), "fall": at(study.fall)},
            "kept": {"rise": study.judged[0], "fall": study.judged[1]},
            "velocity": at(study.velocity, lift),
            "acceleration": at(study.acceleration, lift),
            "radius": at(study.radius, metres),
            "undercut": [[degrees(start), degrees(end)] for start, end in study.undercut],
            "jumps": [{"order": order, "degree": degrees(jump.degree), "by": jump.value / lift}
                      for order, jumps in enumerate((study.impacts, study.soft_impacts), 1) for jump in jumps],
            "least_base": None if self.wanted_base is None else self.wanted_base / metres,
            "divisions": [
                {"number": k, "degree": degrees(d.degree), "lift": d.lift / lift, "pressure": d.pressure}
                for k, d in enumerate(divisions(self.sheet))
            ],
            "drawn": {"pitch": self.drawn.pitch / metres, "profile": self.drawn.profile / metres,
                      "pressure": self.drawn.pressure, "lift": self.drawn.lift / lift, "ok": self.drawn.ok},
        }

    def figure(self, language: str) -> Drawing:
        """The cam by inversion, on a page of its own."""
        return cam_figure(self.mechanism, self.cam, self.sheet, self.phrases(), language)

    def profile_dxf(self) -> bytes:
        """The profile true to size, in mm, as a closed curve of arcs.  Raises CallError without the extra ``cad``."""
        from graphkin.drawing.write.dxf import profile_dxf

        return profile_dxf(self.cam)


def _place(at: AtDegree) -> Neutral:
    return Neutral(f"φ = {_degrees(at.degree)}°")


def _degrees(angle: float) -> str:
    """An angle (rad) in degrees, to 4 decimals at most."""
    return f"{round(math.degrees(angle), 4) + 0.0:.4f}".rstrip("0").rstrip(".")


def cam_made(scene: Mechanism) -> tuple[CamMade, ...]:
    """The cams of a scene."""
    return tuple(CamMade(scene, cam) for cam in scene.cams)


def cam_table(scene: Mechanism, step: float = STEP, discs: Sequence[DiscCam] = ()) -> Table:
    """One row a step (degrees) of each cam, of measured discs by the angle of the driver, from 0 on: cam, angle, lift,
    pitch curve, profile and pressure angle, points in the cam's own axes from its axis."""
    metres = scene.units.metres
    count = max(1, round(360.0 / step))
    degree = np.arange(count) * (360.0 / count)
    # a degree is a rotation of the law, whatever way the cam turns
    turned = np.radians(degree)
    courses: list[tuple[str, bool, tuple[Array, Array, Array | None, Array]]] = []
    for cam in scene.cams:
        at = cam_at(cam, turned)
        course = at.lift, at.profile, None if cam.flat else at.pitch, at.pressure
        courses.append((cam.link, cam.turns, course))
    courses += [(disc.link, disc.swings, disc_course(structure_of(scene), disc, turned)) for disc in discs]
    parts: list[list[Array]] = []
    for _, swings, (lift, profile, pitch, pressure) in courses:
        lift, profile = lift / (math.radians(1.0) if swings else metres), profile / metres
        pitch = np.full(count, complex(np.nan, np.nan)) if pitch is None else pitch / metres
        parts.append([degree, lift, pitch.real, pitch.imag, profile.real, profile.imag, np.degrees(pressure)])
    names = ("angle_deg", "lift", "pitch_x", "pitch_y", "profile_x", "profile_y", "pressure_deg")
    joined = (np.concatenate(columns) for columns in zip(*parts, strict=True))
    links = as_array([link for link, *_ in courses for _ in range(count)])
    return Table((Column("cam", links), *(Column(n, v) for n, v in zip(names, joined, strict=True))))


@dataclass(frozen=True, repr=False, eq=False)
class Cams(OfScene, Result):
    """The cams of a scene: the values of each, the table of their points, and their figures; ``discs`` are discs that
    the driver turns, measured as cams.

    ``result["1"]`` is the cam of link 1.
    """

    table_file = "cam.csv"

    mechanism: Mechanism
    made: tuple[CamMade, ...]
    discs: tuple[DiscCam, ...] = ()
    step: float = STEP
    language: str | None = None

    @property
    def ok(self) -> bool:
        """Whether every cam keeps its allowed angles, can be cut, and is drawn as it is computed."""
        return all(cam.ok for cam in self.made)

    @property
    def _links(self) -> str:
        return ", ".join([*(made.cam.link for made in self.made), *(disc.link for disc in self.discs)])

    def __getitem__(self, name: str) -> CamMade | Array:
        """A cam by its link, or a column of the table.  Raises CallError for an unknown one."""
        return next((made for made in self.made if made.cam.link == name), None) or self.table[name]

    @property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin cam --json`` prints."""
        return {
            "title": self.mechanism.question.title,
            "ok": self.ok,
            "units": {"length": self.mechanism.units.length, "angle": "rad"},
            "cams": {made.cam.link: made.data for made in self.made},
            "discs": {disc.contact: self._disc(disc) for disc in self.discs},
        }

    def _disc(self, disc: DiscCam) -> dict[str, Json]:
        """Plain data of a measured disc: lengths in the scene's unit, angles in radians."""
        metres = self.mechanism.units.metres
        return {
            "cam": disc.link,
            "follower": disc.follower,
            "base": {"profile": disc.profile / metres, "pitch": None if disc.pitch is None else disc.pitch / metres},
            "rise": disc.rise / (1.0 if disc.swings else metres),
            "offset": None if disc.offset is None else disc.offset / metres,
            "pressure": {"greatest": disc.most[0], "at": disc.most[1], "here": disc.here},
        }

    def sentences(self, language: str) -> list[str]:
        """The sentences on all of them."""
        sentences = [sentence for made in self.made for sentence in made.sentences(language)]
        return sentences + [say(phrase, language) for disc in self.discs for phrase in self._disc_notes(disc)]

    def _disc_notes(self, disc: DiscCam) -> Iterator[Phrase]:
        unit, metres = self.mechanism.units.length, self.mechanism.units.metres
        base = disc.profile if disc.pitch is None else disc.pitch
        kind = Phrase("cam base profile" if disc.pitch is None else "cam base pitch")
        rise = (math.degrees(disc.rise), "°") if disc.swings else (disc.rise / metres, f" {unit}")
        yield Phrase(
            "cam disc", link=disc.link, follower=disc.follower, radius=f"{base / metres:.6g}", unit=unit, kind=kind,
            rise=f"{rise[0]:.6g}", rise_unit=rise[1],
        )
        yield Phrase("cam disc points", link=disc.link)
        if disc.offset is not None:
            yield Phrase("cam disc offset", offset=f"{disc.offset / metres + 0.0:.6g}", unit=unit)
        if not disc.most[0]:
            yield Phrase("cam disc no pressure")
            return
        here = "–" if disc.here is None else _degrees(disc.here)
        at = _degrees(disc.most[1] % math.tau)
        yield Phrase("cam disc pressure", angle=_degrees(disc.most[0]), place=at, here=here)

    @cached_property
    def table(self) -> Table:
        """Points of pitch curve and profile at every step."""
        return cam_table(self.mechanism, self.step, self.discs)

    @cached_property
    def figures(self) -> dict[str, Drawing]:
        """Each cam by inversion: "cam", and "cam-3" for a further cam of link 3."""
        spoken = self.language or self.mechanism.question.sheet.language
        return {"cam" if i == 0 else f"cam-{made.cam.link}": made.figure(spoken) for i, made in enumerate(self.made)}

    def pages(self, formats: Sequence[str], text: str = "glyphs") -> dict[str, bytes]:
        """The figures of cams by their law, and with the format "dxf" each profile true to size (profile-LINK.dxf).
        Raises CallError."""
        pages = super().pages(formats, text)
        if "dxf" in formats:
            from graphkin.drawing.write.dxf import outline_dxf

            pages |= {f"profile-{disc.link}.dxf": outline_dxf(*disc.outline) for disc in self.discs}
            pages |= {f"profile-{made.cam.link}.dxf": made.profile_dxf() for made in self.made}
        return pages

    def __repr__(self) -> str:
        return f"<Cams {self.mechanism.name}: {self._links}>"


def cam(
    scene: SceneLike,
    *,
    step: float = STEP,
    out: str | os.PathLike[str] | None = None,
    formats: Sequence[str] = ("svg",),
    language: str | None = None,
) -> Cams:
    """Examine the cams of a scene: pressure angles, curvature, undercutting, rates; drawn by inversion.

    Discs that the driver turns under a follower are measured: base radius, rise, offset, pressure angle.

    Parameters
    ----------
    scene : as for `solve`
    out : folder for cam.svg, cam.csv and with the format "dxf" the profile true to size
    language : "en", "zh" or "both" for the figure; the scene's own if None
    step : degrees between two rows of the table

    Raises
    ------
    SceneError, CallError : the file or the call is wrong, or the scene has no cam
    Unsolvable : a follower that does not come to its base circle

    Examples
    --------
    >>> found = cam("cam-offset-roller")
    >>> round(found.data["cams"]["1"]["pressure"]["rise"]["degree"], 4), found.ok
    (56.3214, True)
    """
    known_words(formats, language, None, known_languages=ON_SHEETS)
    if isinstance(step, bool) or not isinstance(step, int | float) or not FINEST <= step <= COARSEST:
        raise unfit("step", step, "degrees from to", finest=f"{FINEST:g}", coarsest=f"{COARSEST:g}")
    given = for_paper(scene)
    discs = disc_cams(structure_of(given))
    if not given.cams and not discs:
        raise CallError.of(given.name or "scene", "has no cam", "a cam is told by its law in")
    return Cams(given, cam_made(given), discs, float(step), language).saved(out, formats)

