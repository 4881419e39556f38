"""The forces of a position step by step, each step with its reason: inertia forces off the drawn accelerations, then
group by group cut free, moments, polygon, forces inside, couples, at last the lever."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from graphkin.account.forces import (
    ForceSentence,
    closed_by,
    couple_sentences,
    group_caption,
    inertia_line,
    laid_lines,
    laid_off,
    lever_sum,
    moment_sentences,
    read_off,
    spring_lines,
)
from graphkin.account.notation import Letters, force_letters, pole
from graphkin.construction.forces.force_sheet import ForceGroup, ForceSheet, ForceState, ForceVector, Lever, MomentTerm
from graphkin.construction.scales import Extent, fitting_scale
from graphkin.construction.sheet import Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import on_page
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase, Wording, about, in_all, languages, listed, say

__all__ = ["SHORT", "ForceStage", "ForceStep", "force_stages", "lever_extent", "lever_on_page"]

WIDEST, HIGHEST = 134.0, 130.0  # mm of a lever
SHORT = 0.3  # mm: a nearer end point is at the pole

Words = tuple[tuple[str, str], ...]
"""(language, words with symbols) for each language."""


@dataclass(frozen=True)
class ForceStep:
    """A step: its number behind those of the motion, why it is taken, what is computed in it, what it finds."""

    number: int
    words: Words
    work: tuple[str, ...] = ()
    found: tuple[Symbol, ...] = ()


@dataclass(frozen=True)
class ForceStage:
    """Steps that belong together: of one group, of the inertia forces, of a lever (these have no ``group``).

    ``figure`` is the one they are drawn on; ``again`` marks what is drawn with a load that begins or ends here.
    ``known`` is the step that shows known forces, ``moments`` those that find parts of forces by moments, ``closing``
    the one that closes the polygon, ``inside`` those of single links.
    """

    figure: Literal["mechanism", "acceleration", "forces", "lever"]
    title: Words
    steps: tuple[ForceStep, ...]
    state: ForceState
    group: ForceGroup | None = None
    again: bool = False
    known: int = 0
    laid: int = 0
    closing: int = 0
    moments: Mapping[tuple[Symbol, str], int] = field(default_factory=dict)
    inside: Mapping[str, int] = field(default_factory=dict)
    couples: Mapping[Symbol, int] = field(default_factory=dict)

    def on_links(self, vector: ForceVector) -> int:
        """The step that draws a force on the links cut free."""
        if vector.known:
            return self.known
        return self.moments.get((vector.symbol, vector.part), self.closing)

    def in_polygon(self, vector: ForceVector, link: str = "") -> int:
        """The step that draws a force in the polygon of the group, or of one link."""
        if link:
            return self.inside.get(link, self.closing)
        laid = vector.known or (self.group is not None and vector in laid_off(self.group))
        return self.laid if laid else self.closing


@dataclass
class _StageWriter:
    """Steps in the making."""

    sheet: Sheet
    forces: ForceSheet
    letters: Letters
    language: str
    last: int

    def step(self, why: Phrase, work: Iterable[Wording] = (), found: Iterable[Symbol] = ()) -> ForceStep:
        self.last += 1
        lines = (line for told in work for line in in_all(told, self.language))
        return ForceStep(self.last, self.said(why), tuple(lines), tuple(found))

    def said(self, phrase: Phrase) -> Words:
        return tuple((each, say(phrase, each)) for each in languages(self.language))

    def name(self, symbol: Symbol) -> str:
        return f"${force_letters(self.letters.convention, symbol)}$"

    def sentence(self, one: ForceSentence) -> ForceStep:
        return self.step(one.reason, one.work, () if one.symbol is None else (one.symbol,))


def force_stages(sheet: Sheet, forces: ForceSheet, letters: Letters, language: str) -> tuple[ForceStage, ...]:
    """All steps from the drawn accelerations to what balances; ``sheet`` with the scale of the forces."""
    writer = _StageWriter(sheet, forces, letters, language, sheet.steps[-1].number if sheet.steps else 0)
    made = [*_known(writer)]
    count = 0
    for number, state in enumerate(forces.states):
        shown = state.groups
        if number:
            shown = tuple(g for g, old in zip(shown, forces.states[0].groups, strict=True) if g != old)
        for group in shown:
            count += 1
            made.append(_group(writer, state, group, count, bool(number)))
    made += _levers(writer)
    return tuple(made)


def _known(writer: _StageWriter) -> Iterator[ForceStage]:
    state = writer.forces.states[0]
    inertia = [
        writer.step(
            Phrase("force step inertia", (link,)), [inertia_line(writer.sheet, one, writer.letters)],
            [Symbol("Fi", link=link)],
        )
        for link, one in writer.forces.inertias.items()
    ]
    if inertia:
        yield ForceStage("acceleration", writer.said(Phrase("force inertia")), tuple(inertia), state)
    pulls = [writer.step(line) for line in spring_lines(writer.sheet, writer.forces, writer.letters)]
    if pulls:
        yield ForceStage("mechanism", writer.said(Phrase("force step springs")), tuple(pulls), state)


def _group(writer: _StageWriter, state: ForceState, group: ForceGroup, count: int, again: bool) -> ForceStage:
    sheet, letters, links = writer.sheet, writer.letters, listed(group.links)
    drawn = [*group.polygon, *(v for polygon in group.inner.values() for v in polygon)]
    forces = list(dict.fromkeys(v.symbol for v in drawn if v.known and v.span))
    turning = [t.symbol for t in state.known if t.moment and t.link in group.links]
    names = [writer.name(s) for s in dict.fromkeys((*forces, *turning))]
    cut = Phrase("force step cut", (links, listed(names))) if names else Phrase("force step cut bare", (links,))
    steps = [writer.step(cut)]
    made = ForceStage("forces", (), (), state, group, again, known=steps[0].number)
    moments: dict[tuple[Symbol, str], int] = {}
    for one in moment_sentences(sheet, group, letters):
        steps.append(writer.sentence(one))
        if one.symbol is not None:
            moments[one.symbol, one.part] = steps[-1].number
    read, inside = read_off(sheet, writer.forces, state, group, letters), dict[str, int]()
    laid = made.known
    if group.way == "drawn system":
        steps.append(writer.step(Phrase("force reason system", (links,))))
    elif len(group.polygon) > 1:
        if laid_off(group):
            lines = laid_lines(sheet, writer.forces, group, letters)
            steps.append(writer.step(Phrase("force step lay"), lines))
            laid = steps[-1].number
        own = [s for s in dict.fromkeys(v.symbol for v in group.polygon if not v.known) if s in read]
        why = Phrase(about("force polygon closes", group.links), (links,))
        by = closed_by(group, letters, sheet.scene.frame.name)
        closed = Phrase("two sentences", (why, by)) if by is not None else why
        steps.append(writer.step(closed, [read.pop(s) for s in own], own))
    closing = steps[-1].number
    for link, vectors in group.inner.items():
        own = [s for s in dict.fromkeys(v.symbol for v in vectors if not v.known) if s in read]
        if own:
            closed = Phrase("force step inside", (link, listed([writer.name(s) for s in own])))
            steps.append(writer.step(closed, [read.pop(s) for s in own], own))
            inside[link] = steps[-1].number
    couples: dict[Symbol, int] = {}
    for one in couple_sentences(sheet, group, letters):
        steps.append(writer.sentence(one))
        if one.symbol is not None:
            couples[one.symbol] = steps[-1].number
    title = writer.said(group_caption(group, count))
    return replace(
        made, title=title, steps=tuple(steps), laid=laid, closing=closing, moments=moments, inside=inside,
        couples=couples,
    )  # fmt: skip


def _levers(writer: _StageWriter) -> Iterator[ForceStage]:
    forces, c = writer.forces, writer.letters.convention
    for k, state in enumerate(forces.states):
        for lever in state.levers:
            why = Phrase("lever reason", (f"${pole(c, 'velocity')}$",))
            first = Phrase("two sentences", (why, Phrase("lever virtual"))) if lever.virtual else why
            steps = [writer.step(first), writer.step(Phrase("lever step forces"))]
            shown, _ = lever_on_page(writer.sheet, lever)
            total, balance = lever_sum(writer.sheet, state, shown, writer.letters)
            steps.append(writer.step(balance, [total], [lever.unknown.symbol]))
            yield ForceStage("lever", writer.said(Phrase("lever")), tuple(steps), state, again=bool(k))


def lever_on_page(sheet: Sheet, lever: Lever) -> tuple[Lever, float]:
    """A lever of a size that a page shows, and m/s for one of its mm: the sheet's own where it is no virtual one."""
    box = lever_extent(lever)
    if not lever.virtual and box.width <= WIDEST and box.height <= HIGHEST:
        return lever, lever.per_mm
    metres = sheet.scene.units.rates.metres
    extent = Extent(box.width * lever.per_mm, box.height * lever.per_mm)
    per_mm = fitting_scale(extent, (WIDEST, HIGHEST), 1.0 / metres) * metres
    times = lever.per_mm / per_mm

    def larger(row: MomentTerm) -> MomentTerm:
        pair = None if row.pair is None else (row.pair[0] * times, row.pair[1] * times)
        arm = None if row.arm is None else row.arm * times
        return replace(row, at=row.at * times, arm=arm, moment=row.moment * times, pair=pair)

    made = replace(
        lever, per_mm=per_mm, ends={name: z * times for name, z in lever.ends.items()},
        rows=tuple(map(larger, lever.rows)), unknown=larger(lever.unknown),
    )  # fmt: skip
    return made, made.per_mm


def lever_extent(lever: Lever) -> Box:
    """The box (mm, y down, about the pole) around the end points and forces of a lever."""
    spots = [0j, *(row.at for row in lever.rows), *(z for row in lever.rows for z in row.pair or ())]
    spots += [z for z in lever.ends.values() if abs(z) > SHORT]
    return Box.around([on_page(z) for z in spots])
