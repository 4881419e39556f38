"""``graphkin explain``: what was understood of a scene, in words."""

from __future__ import annotations

import cmath
import json
import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

from graphkin.api.arguments import SceneLike, as_scene, known_words
from graphkin.api.report_text import plain_said
from graphkin.api.results import OfScene, Result
from graphkin.construction import EXACT, execute, plan
from graphkin.errors import GraphkinError, Unsolvable
from graphkin.files import Json
from graphkin.scene.force_names import force_names
from graphkin.scene.model import Driver, Mechanism, PlacedGuide, PlacedLink
from graphkin.structure import LargerGroup, Structure, mobility_of
from graphkin.table import Table
from graphkin.words import Phrase, Wording, class_of, word

__all__ = ["Explained", "explain"]

Sentence = tuple[str, Phrase]
"""What a sentence is about (a heading of the words' area ``explanation``), and the sentence."""


@dataclass(frozen=True, repr=False, eq=False)
class Explained(OfScene, Result):
    """What a scene says: its units, links, joints, mobility, drivers, groups with their assembly, and what is asked.

    ``why`` is the reason why it cannot move as it is written, "" where it can; ``exit_code`` is the
    status of the command.
    """

    mechanism: Mechanism
    sentences: tuple[Sentence, ...]
    why: Wording
    language: str
    exit_code: int = 0

    @property
    def ok(self) -> bool:
        """Whether the mobility is as many as there are drivers, and the position can be assembled."""
        return not self.why

    @property
    def text(self) -> str:
        """All of it, paragraph by paragraph."""
        lines, before = [self.mechanism.question.title_in(self.language)], ""
        for about, phrase in self.sentences:
            if about != before:
                lines += ["", word(about, self.language)]
            lines.append(f"  {plain_said(phrase, self.language)}")
            before = about
        return "\n".join(lines)

    @cached_property
    def table(self) -> Table:
        """A row for each sentence, with what it is about."""
        rows = [(word(about, self.language), plain_said(phrase, self.language)) for about, phrase in self.sentences]
        return Table.of(("about", "sentence"), rows)

    @cached_property
    def data(self) -> dict[str, Json]:
        """The sentences by what they are about, in English."""
        found: dict[str, list[str]] = {}
        for about, phrase in self.sentences:
            found.setdefault(about.removeprefix("explained "), []).append(plain_said(phrase, "en"))
        why = {"why": str(self.why)} if self.why else {}
        return {"title": self.mechanism.question.title, "ok": self.ok, **found, **why}

    @property
    def files(self) -> Mapping[str, bytes]:
        data = json.dumps(self.data, ensure_ascii=False) + "\n"
        return {"explanation.txt": f"{self.text}\n".encode(), "explanation.json": data.encode()}

    def __repr__(self) -> str:
        return f"<Explained {self.mechanism.name}: {len(self.sentences)} sentences>"


def _loads(scene: Mechanism) -> Iterator[tuple[str, Phrase]]:
    """Masses and loads, and what keeps them in balance."""
    units, loading = scene.units, scene.loading
    for mass in loading.masses:
        heavy, inertia = f"{mass.mass / units.kilograms:.6g} {units.mass}", units.of("inertia")
        x, y = (f"{part / units.metres:.6g}" for part in (mass.at.real, mass.at.imag))
        told = (mass.link, heavy, f"{inertia.of(mass.inertia):.6g} {inertia.text}", x, y)
        yield "explained loads", Phrase("explained mass", told)
    if loading.gravity:
        angle = math.degrees(cmath.phase(loading.gravity))
        yield "explained loads", Phrase("explained gravity", (f"{abs(loading.gravity):.6g}", f"{angle:.6g}"))
    for load in loading.loads:
        size = f"{load.size / units.newtons:.6g} {units.force}" + ("" if load.is_force else " m")
        key = "explained force" if load.is_force else "explained moment"
        yield "explained loads", Phrase(key, (load.name, size, load.link))
    for spring in loading.springs:
        ends = [text for pair in zip(spring.points, spring.links, strict=True) for text in pair]
        rate = f"{spring.rate * units.metres / units.newtons:.6g} {units.force}/{units.length}"
        free, preload = f"{spring.free / units.metres:.6g} {units.length}", spring.preload / units.newtons
        said = (spring.name, *ends, rate, free, f"{preload:.6g} {units.force}")
        yield "explained loads", Phrase("explained spring", said)
    for name, kind in force_names(scene).items():
        if name[:2] in ("F_", "M_") and "/" not in name:
            yield "explained loads", Phrase(f"explained balancing {kind}", (name, name[2:]))


def explain(scene: SceneLike, *, language: str | None = None) -> Explained:
    """Say in words what was understood of a scene.

    Parameters
    ----------
    scene : as for `solve`
    language : "en" or "zh"; the scene's own if None

    Raises
    ------
    SceneError, CallError : the file or the call is wrong.  What cannot move as it is written is no error: ``why`` says
        it

    Examples
    --------
    >>> four_bar = explain("fourbar-150-500-300-400")
    >>> four_bar.data["mobility"]
    ['F = 3·3 - 2·4 - 0 = 1: as many as there are drivers']
    """
    known_words(language=language)
    given = as_scene(scene)
    sentences = [*_units(given), *_links(given), *_joints(given), *_mobility(given), *_drivers(given)]
    why: Wording = ""
    exit_code = 0
    try:
        from graphkin.solver import structure_of

        structure = structure_of(given)
        sentences += _groups(structure)
        pointed = [p for p in structure.scene.sketch if p not in given.sketch]
        if pointed:
            sentences.append(("explained groups", Phrase("explained pointed", (", ".join(pointed),))))
    except Unsolvable as error:
        why, exit_code = error.reason, error.exit_code
    sentences += _loads(given)
    sentences += [("explained asked", Phrase("explained asked all"))] if not given.question.find else [
        ("explained asked", Phrase("explained asked for", (", ".join(map(str, given.question.find)),)))
    ]  # fmt: skip
    return Explained(given, tuple(sentences), why, language or given.question.sheet.language, exit_code)


def _units(scene: Mechanism) -> Iterator[Sentence]:
    yield "explained units", Phrase("explained unit", (scene.units.length, scene.units.of("velocity").text))
    if scene.question.background is not None:
        step = scene.question.background.step
        turned = _number(math.degrees(cmath.phase(step)))
        told = scene.question.background.name, _number(abs(step) / scene.units.metres), scene.units.length, turned
        yield "explained units", Phrase("explained background", told)


def _number(value: float) -> str:
    return f"{value + 0.0:.6g}"


def _place(z: complex, scene: Mechanism) -> str:
    unit = scene.units.metres
    return f"({_number(z.real / unit)}, {_number(z.imag / unit)})"


def _links(scene: Mechanism) -> Iterator[Sentence]:
    about = "explained links"
    fixed = ", ".join(f"{p} {_place(z, scene)}" for p, z in scene.frame.points.items()) or "-"
    yield about, Phrase("explained frame", (scene.frame.name, fixed))
    yield from ((about, phrase) for phrase in (*_outlines(scene.frame, scene), *_guides(scene.frame, scene)))
    for link in scene.links:
        own = link.bar
        if len(own) == 2:
            length = _number((link.length or 0.0) / scene.units.metres)
            yield about, Phrase("explained bar", (link.name, "".join(own), length, scene.units.length))
        elif any(s.link == link.name for s in scene.slidings):
            yield about, Phrase("explained block", (link.name, own[0] if own else "-"))
        elif own and any(cam.link == link.name for cam in scene.cams):
            yield about, Phrase("explained cam link", (link.name, own[0]))
        elif own and any(link.name in gear.wheels for gear in scene.gears):
            yield about, Phrase("explained wheel", (link.name, own[0]))
        else:
            yield about, Phrase("explained ray", (link.name, own[0] if own else "-"))
        further = [f"{p} {_place(z, scene)}" for p, z in link.points.items() if p not in own]
        if further:
            yield about, Phrase("explained further", (link.name, ", ".join(further)))
        yield from ((about, phrase) for phrase in _outlines(link, scene))
        yield from ((about, phrase) for phrase in _guides(link, scene))
        if link.redundant:
            yield about, Phrase("explained redundant", (link.name,))


def _outlines(link: PlacedLink, scene: Mechanism) -> Iterator[Phrase]:
    for disc in link.discs:
        place = disc.name, disc.centre, _number(disc.radius / scene.units.metres), scene.units.length
        yield Phrase("explained disc", place)


def _guides(link: PlacedLink, scene: Mechanism) -> Iterator[Phrase]:
    for name, guide in link.guides.items():
        if name:
            angle = _number(math.degrees(cmath.phase(guide.direction)))
            yield Phrase("explained guide", (f"{link.name}.{name}", _place(guide.through, scene), angle))


def _joints(scene: Mechanism) -> Iterator[Sentence]:
    about = "explained joints"
    counted = {scene.frame.name, *(link.name for link in scene.links if not link.redundant)}
    for point, holders in scene.holders.items():
        own = [name for name in holders if name in counted]
        if len(own) > 1:
            many = (len(own) - 1,) if len(own) > 2 else ()
            yield about, Phrase("explained turnings" if many else "explained turning", (point, ", ".join(own), *many))
    for pair in scene.slidings:
        guide = _guide_name(scene, pair.on, pair.guide)
        angle = _number(math.degrees(cmath.phase(pair.turn)))
        yield about, Phrase("explained sliding", (pair.link, guide, pair.pin or "-", angle))
    for pin in scene.pins:
        yield about, Phrase("explained slot", (pin.point, pin.of, _guide_name(scene, pin.on, pin.guide)))
    for contact in scene.contacts:
        sides = [f"{d.link}.{d.name}" if d else _guide_name(scene, contact.face, contact.guide) for d in contact.discs]
        held = (contact.carrier,) if contact.carrier else ()
        key = "explained contact" if not contact.rolling else "explained held rolling" if held else "explained rolling"
        yield about, Phrase(key, (contact.name, *sides, *held))
    for cam in scene.cams:
        kind = "flat" if cam.flat else "roller" if cam.roller else "edge"
        yield about, Phrase("explained cam", (cam.link, cam.follower, Phrase(f"cam {kind}"), str(len(cam.law.pieces))))
    for gear in scene.gears:
        teeth = [_number(z) for z in gear.teeth if z is not None]
        yield about, Phrase("explained rack" if gear.is_rack else "explained gear",
                            (gear.name, *gear.wheels, *teeth, gear.carrier))  # fmt: skip


def _guide_name(scene: Mechanism, link: str, guide: str) -> str:
    found: PlacedGuide = scene.by_name[link].guides[guide]
    return f"{link}.{found.name}" if found.name else link


def _mobility(scene: Mechanism) -> Iterator[Sentence]:
    count = mobility_of(scene)
    numbers = count.links, count.lower, count.higher, count.value, len(scene.drivers)
    left = count.value - len(scene.drivers)
    key = "explained count" if left == 0 else "explained undetermined" if left > 0 else "explained miscount"
    yield "explained mobility", Phrase(key, numbers)


def _drivers(scene: Mechanism) -> Iterator[Sentence]:
    for driver in scene.drivers:
        yield "explained drivers", _driver(scene, driver)


def _driver(scene: Mechanism, driver: Driver) -> Phrase:
    at = scene.unit_of(driver).said(driver.values[0])
    rate = driver.values[1]
    if driver.law is not None:
        at = f"{at} ({_number(driver.law.time)} / {_number(driver.law.duration)} s)"
    if driver.turns:
        sense = "at rest" if not rate else "counter-clockwise" if rate > 0 else "clockwise"
        said = Phrase(f"explained {sense}", (_number(abs(rate)), _number(abs(rate) * 30 / math.pi)))
        return Phrase("explained turns", (driver.link, driver.relative_to, at, said))
    sense = "at rest" if not rate else "forward" if rate > 0 else "back"
    speed = scene.units.of("velocity")
    said = Phrase(f"explained {sense}", (_number(speed.of(abs(rate))), speed.text))
    return Phrase("explained slides", (driver.key, at, said))


def _groups(structure: Structure) -> Iterator[Sentence]:
    """The groups in the order of solution, and in which assembly each lies, as far as it can be drawn."""
    assembly: dict[str, Phrase] = {}
    with suppress(GraphkinError):  # the position cannot be had: solve says why
        assembly = dict(execute(plan(structure, None, ()), EXACT).assembly)
    for group in structure.groups:
        links = ", ".join(group.links)
        larger = Phrase("explained group kind" if group.order > 2 else "explained rolling kind")
        kind = larger if isinstance(group, LargerGroup) else group.kind
        yield "explained groups", Phrase("explained group", (links, kind, class_of(group.order)))
        taken = assembly.get(links)
        if taken is not None:
            yield "explained groups", Phrase("explained assembly", (taken,))
