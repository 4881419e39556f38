"""``graphkin explain``: the scene as graphkin understands it, in words."""

from __future__ import annotations

import cmath
import json
import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

from graphkin.account.given import load_given
from graphkin.account.notation import Notation
from graphkin.api.arguments import as_scene, known_words
from graphkin.api.report_text import plain_said
from graphkin.api.results import OfScene, Result
from graphkin.construction import EXACT, execute, plan
from graphkin.errors import GraphkinError, Unsolvable
from graphkin.files import Json
from graphkin.scene.model import Driver, Mechanism, PlacedLink, forces_named
from graphkin.scene.pairs import told
from graphkin.scene.scene import SceneLike
from graphkin.scene.tables import Unit
from graphkin.solver import structure_of
from graphkin.structure import LargerGroup, Structure, mobility_of
from graphkin.table import Table
from graphkin.words import Phrase, Wording, about, class_of, listed, sense_of, word

Sentence = tuple[str, Phrase]
"""What a sentence is about (a heading of the words' area ``explanation``), and the sentence."""


@dataclass(frozen=True, repr=False, eq=False)
class Explained(OfScene, Result):
    """A scene in words: its units, links, joints, mobility, drivers, groups with their assembly, and its question.

    ``why`` is the reason why it cannot move as it is written, "" where it can, ``status`` a word for it as of
    `Unsolvable`, else "ok"; ``exit_code`` is the status of the command.
    """

    mechanism: Mechanism
    sentences: tuple[Sentence, ...]
    why: Wording
    language: str
    exit_code: int = 0
    status: str = "ok"

    @property
    def ok(self) -> bool:
        """Whether the mobility equals the number of drivers, and the position can be assembled."""
        return not self.why

    @property
    def text(self) -> str:
        """The whole text, paragraph by paragraph."""
        lines, before = [self.mechanism.question.title_in(self.language)], ""
        for subject, phrase in self.sentences:
            if subject != before:
                lines += ["", word(subject, self.language)]
            lines.append(f"  {plain_said(phrase, self.language)}")
            before = subject
        return "\n".join(lines)

    @cached_property
    def table(self) -> Table:
        """A row for each sentence, with its subject."""
        rows = [(word(subject, self.language), plain_said(phrase, self.language)) for subject, phrase in self.sentences]
        return Table.of(("subject", "sentence"), rows)

    @cached_property
    def data(self) -> dict[str, Json]:
        """The sentences by subject, in English."""
        sentences: dict[str, list[str]] = {}
        for subject, phrase in self.sentences:
            sentences.setdefault(subject.removeprefix("explained "), []).append(plain_said(phrase, "en"))
        why = {"why": str(self.why)} if self.why else {}
        return {"title": self.mechanism.question.title, "ok": self.ok, **sentences, **why}

    @property
    def files(self) -> Mapping[str, bytes]:
        data = json.dumps(self.data, ensure_ascii=False) + "\n"
        return {"explanation.txt": f"{self.text}\n".encode(), "explanation.json": data.encode()}

    def __repr__(self) -> str:
        return f"<Explained {self.mechanism.name}: {len(self.sentences)} sentences>"


def explain(scene: SceneLike, *, language: str | None = None) -> Explained:
    """Explain in words how graphkin understands a scene.

    Parameters
    ----------
    scene : as for `solve`
    language : "en" or "zh"; the scene's own if None

    Raises
    ------
    SceneError, CallError : the file or the call is wrong.  A mechanism that cannot move as written is no error: ``why``
        tells it

    Examples
    --------
    >>> four_bar = explain("fourbar-150-500-300-400")
    >>> four_bar.data["mobility"]
    ['F = 3·3 − 2·4 − 0 = 1: as many as there are drivers']
    """
    known_words(language=language)
    given = as_scene(scene)
    why: Wording = ""
    status, exit_code = "ok", 0
    groups: list[Phrase] = []
    try:
        groups = [*_groups(structure_of(given), given)]
    except Unsolvable as error:
        why, status, exit_code = error.reason, error.status, error.exit_code
    find = given.question.find
    all_asked = Phrase("explained asked all with forces" if given.loading else "explained asked all")
    subjects: dict[str, Iterable[Phrase]] = {
        "units": _units(given), "links": _links(given), "joints": _joints(given), "mobility": [mobility_said(given)],
        "drivers": [_driver(given, driver) for driver in given.drivers], "groups": groups, "loads": _loads(given),
        "asked": [Phrase("explained asked for", quantities=listed(find)) if find else all_asked],
    }
    sentences = tuple((f"explained {about}", phrase) for about, phrases in subjects.items() for phrase in phrases)
    return Explained(given, sentences, why, language or given.question.sheet.language, exit_code, status)


def _units(scene: Mechanism) -> Iterator[Phrase]:
    yield Phrase("explained unit", length=scene.units.length, velocity=scene.units.of("velocity").text)
    background = scene.question.background
    if background is not None:
        turned = _degrees(background.step)
        step = _number(abs(background.step) / scene.units.metres)
        yield Phrase("explained background", picture=background.name, step=step, unit=scene.units.length, angle=turned)


def _number(value: float) -> str:
    return f"{value + 0.0:.6g}"


def _degrees(direction: complex) -> str:
    return _number(math.degrees(cmath.phase(direction)))


def _place(z: complex, scene: Mechanism) -> str:
    unit = scene.units.metres
    return f"({_number(z.real / unit)}, {_number(z.imag / unit)})"


def _links(scene: Mechanism) -> Iterator[Phrase]:
    name, fixed = scene.frame.name, [f"{p} {_place(z, scene)}" for p, z in scene.frame.points.items()]
    framed = Phrase(about("explained frame", fixed), link=name, points=listed(fixed)) if fixed else None
    yield framed or Phrase("explained bare frame", link=name)
    yield from _outlines(scene.frame, scene)
    roles = {name: role for pair in scene.higher_pairs for name, role in zip(pair.bodies, pair.roles, strict=False)}
    for link in (link for link in scene.links if link.name not in scene.replacing):
        bar, points = link.bar, scene.own_points(link)
        if len(bar) == 2:
            length = _number((link.length or 0.0) / scene.units.metres)
            yield Phrase("explained bar", link=link.name, bar="".join(bar), length=length, unit=scene.units.length)
        elif len(points) < len(link.points) or any(s.a == link.name for s in scene.slidings):
            block = Phrase("explained block without point", link=link.name)
            yield Phrase("explained block", link=link.name, point=bar[0]) if bar else block
        elif bar and link.name in roles:
            yield Phrase(f"explained {roles[link.name]}", link=link.name, point=bar[0])
        elif bar and link.discs:
            yield Phrase("explained disc link", link=link.name, point=bar[0])
        else:
            yield Phrase("explained ray", link=link.name, point=bar[0] if bar else "-")
        further = [f"{p} {_place(link.points[p], scene)}" for p in points if p not in bar]
        if further:
            yield Phrase(about("explained further", further), link=link.name, points=listed(further))
        yield from _outlines(link, scene)
        if link.redundant:
            yield Phrase("explained redundant", link=link.name)


def _outlines(link: PlacedLink, scene: Mechanism) -> Iterator[Phrase]:
    """The discs and the guides of a link."""
    for name, disc in link.discs.items():
        radius = _number(abs(disc.r) / scene.units.metres)
        key = "explained hollow disc" if disc.r < 0 else "explained disc"
        yield Phrase(key, disc=name, centre=disc.centre, radius=radius, unit=scene.units.length)
    for name, guide in link.guides.items():
        if name:
            place, angle = _place(guide.through, scene), _degrees(guide.direction)
            yield Phrase("explained guide", guide=f"{link.name}.{name}", place=place, angle=angle)
    for name, slot in {slot.name: slot for slot in scene.slots if slot.on == link.name}.items():
        radius = _number(slot.radius / scene.units.metres)
        curve = {"guide": f"{link.name}.{name}", "centre": slot.centre, "radius": radius}
        yield Phrase("explained circle", **curve, unit=scene.units.length)


def _joints(scene: Mechanism) -> Iterator[Phrase]:
    counted = {scene.frame.name, *(link.name for link in scene.links if not link.redundant)}
    for point, holders in scene.holders.items():
        links = [name for name in holders if name in counted and point in scene.own_points(scene.by_name[name])]
        if len(links) > 1:
            if len(links) == 2:
                yield Phrase("explained turning", point=point, links=listed(links))
            else:
                yield Phrase("explained turnings", point=point, links=listed(links), number=len(links) - 1)
        for name in holders if links else ():
            if name not in counted:
                yield Phrase("explained uncounted", point=point, links=listed([links[0], name]), link=name)
    yield from (told(pair, "explained") for pair in scene.pairs)


def mobility_said(scene: Mechanism) -> Phrase:
    """The mobility with its numbers, beside the number of drivers."""
    count = mobility_of(scene)
    left = count.value - len(scene.drivers)
    key = "explained count" if left == 0 else "explained undetermined" if left > 0 else "explained miscount"
    numbers = {"links": count.links, "lower": count.lower, "higher": count.higher, "mobility": count.value}
    return Phrase(key, **numbers, drivers=len(scene.drivers))


def _driver(scene: Mechanism, driver: Driver) -> Phrase:
    at = scene.unit_of(driver).said(driver.values[0])
    _, rate, second = driver.values
    if driver.law is not None:
        at = f"{at} ({_number(driver.law.time)} / {_number(driver.law.duration)} s)"
    if driver.turns:
        rpm = _number(abs(rate) * 30 / math.pi)
        turning = Phrase("explained turning rate", sense=sense_of(rate), rate=_number(abs(rate)), rpm=rpm)
        said = turning if rate else Phrase("explained at rest")
        growth = Phrase("explained turning growth", sense=sense_of(second), rate=_number(abs(second)))
        said = Phrase("explained accelerated", motion=said, growth=growth) if second else said
        return Phrase("explained turns", link=driver.link, base=driver.relative_to, value=at, motion=said)
    said = _along(rate, scene.units.of("velocity"))
    if second:
        said = Phrase("explained accelerated", motion=said, growth=_along(second, scene.units.of("acceleration")))
    return Phrase("explained slides", slide=driver.key, value=at, motion=said)


def _along(rate: float, unit: Unit) -> Phrase:
    """The velocity or acceleration of a driven slide (SI) in a unit, along or against its guide."""
    sense = "at rest" if not rate else "forward" if rate > 0 else "back"
    return Phrase(f"explained {sense}", speed=_number(unit.of(abs(rate))), unit=unit.text)


def _groups(structure: Structure, scene: Mechanism) -> Iterator[Phrase]:
    """The groups in the order of solution, with their assembly if it can be drawn; the points sketched for it."""
    assembly: dict[Phrase, Phrase] = {}
    with suppress(GraphkinError):  # the position cannot be had: solve says why
        assembly = dict(execute(plan(structure, None, ()), EXACT).assembly)
    for group in structure.groups:
        larger = Phrase("explained group kind" if group.order > 2 else "explained rolling kind")
        kind, named = larger if isinstance(group, LargerGroup) else group.kind, group.named
        yield Phrase("explained group", links=named, kind=kind, order=class_of(group.order))
        if named in assembly:
            yield Phrase("explained assembly", assembly=assembly[named])
    pointed = [p for p in structure.scene.sketch if p not in scene.sketch]
    if pointed:
        yield Phrase("explained pointed", points=listed(pointed))


def _loads(scene: Mechanism) -> Iterator[Phrase]:
    """Masses and loads, and the load that balances them."""
    units, loading, letters = scene.units, scene.loading, Notation(scene.question.sheet.convention)
    for mass in loading.masses:
        heavy, inertia = f"{mass.mass / units.kilograms:.6g} {units.mass}", units.of("inertia")
        x, y = (f"{part / units.metres:.6g}" for part in (mass.at.real, mass.at.imag))
        about = f"{inertia.of(mass.inertia):.6g} {inertia.text}"
        yield Phrase("explained mass", link=mass.link, mass=heavy, inertia=about, x=x, y=y)
    if loading.gravity:
        angle = math.degrees(cmath.phase(loading.gravity))
        yield Phrase("explained gravity", gravity=f"{abs(loading.gravity):.6g}", angle=f"{angle:.6g}")
    for load in loading.loads:
        size = f"{load.size / units.newtons:.6g} {units.force}" + ("" if load.is_force else " m")
        said = Phrase("explained force" if load.is_force else "explained moment", size=size)
        yield Phrase("explained load", load=load.name, given=load_given(scene, load, said, letters))
    for spring in loading.springs:
        numbers = {gap: f"{value:.6g} {unit}" for gap, (value, unit) in spring.numbers(units).items()}
        yield Phrase(f"explained {spring.kind}", **spring.gaps, **numbers)
    for force in forces_named(scene):
        if force.kind in ("F", "M") and not force.other:
            measure = force.measure.name
            yield Phrase(f"explained balancing {measure}", **{measure: str(force)}, link=force.link)
    if loading.flywheel is not None:
        yield Phrase("explained flywheel", link=loading.flywheel.on, delta=_number(loading.flywheel.delta))
