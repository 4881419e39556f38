"""The forces of a position step by step, each step with its reason: inertia forces off the drawn accelerations, then
group by group cut free, moments, polygon, forces inside, couples, at last the lever."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from graphkin.construction.forces.force_sheet import ForceGroup, ForceSheet, ForceState, ForceVector
from graphkin.construction.sheet import Sheet
from graphkin.drawing.bilingual import all_in_both, in_both
from graphkin.drawing.conventions import Letters, force_letters, pole
from graphkin.drawing.force_chain import closed_by, laid_lines, laid_off
from graphkin.drawing.force_words import (
    ForceSentence,
    couple_sentences,
    group_caption,
    inertia_line,
    lever_sum,
    moment_sentences,
    read_off,
)
from graphkin.drawing.given_loads import spring_lines
from graphkin.drawing.lever import lever_on_page
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase, about, languages, listed, say, word

__all__ = ["ForceStage", "ForceStep", "force_stages"]

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
    spoken: tuple[str, ...]
    last: int

    def step(self, words: Words, work: Sequence[str] = (), found: Sequence[Symbol] = ()) -> ForceStep:
        self.last += 1
        return ForceStep(self.last, words, tuple(work), tuple(found))

    def said(self, key: str, *args: object) -> Words:
        return tuple((each, say(Phrase(key, args), each)) for each in self.spoken)

    def name(self, symbol: Symbol) -> str:
        return f"${force_letters(self.letters.convention, symbol)}$"

    def sentences(self, of: Sequence[Sequence[ForceSentence]]) -> Iterator[tuple[ForceStep, ForceSentence]]:
        """The same steps as they are told in each language."""
        for each in zip(*of, strict=True):
            words = tuple((language, one.reason) for language, one in zip(self.spoken, each, strict=True))
            found = () if each[0].symbol is None else (each[0].symbol,)
            yield self.step(words, all_in_both([one.work for one in each]), found), each[0]


def force_stages(sheet: Sheet, forces: ForceSheet, letters: Letters, language: str) -> tuple[ForceStage, ...]:
    """All steps from the drawn accelerations to what balances; ``sheet`` with the scale of the forces."""
    writer = _StageWriter(sheet, forces, letters, languages(language), sheet.steps[-1].number if sheet.steps else 0)
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
            writer.said("force step inertia", link),
            [inertia_line(writer.sheet, one, writer.letters, writer.spoken[0])],
            [Symbol("Fi", link=link)],
        )
        for link, one in writer.forces.inertias.items()
    ]
    if inertia:
        yield ForceStage("acceleration", writer.said("force inertia"), tuple(inertia), state)
    lines = [spring_lines(writer.sheet, writer.forces, writer.letters, each) for each in writer.spoken]
    pulls = [writer.step(tuple(zip(writer.spoken, each, strict=True))) for each in zip(*lines, strict=True)]
    if pulls:
        yield ForceStage("mechanism", writer.said("force step springs"), tuple(pulls), state)


def _group(writer: _StageWriter, state: ForceState, group: ForceGroup, count: int, again: bool) -> ForceStage:
    sheet, letters, links = writer.sheet, writer.letters, listed(group.links)
    drawn = [*group.polygon, *(v for polygon in group.inner.values() for v in polygon)]
    forces = list(dict.fromkeys(v.symbol for v in drawn if v.known and v.span))
    turning = [t.symbol for t in state.turning if t.moment and t.link in group.links]
    names = [writer.name(s) for s in dict.fromkeys((*forces, *turning))]
    cut = writer.said("force step cut", links, listed(names)) if names else writer.said("force step cut bare", links)
    steps = [writer.step(cut)]
    made = ForceStage("forces", (), (), state, group, again, known=steps[0].number)
    moments: dict[tuple[Symbol, str], int] = {}
    for step, one in writer.sentences([moment_sentences(sheet, group, letters, each) for each in writer.spoken]):
        steps.append(step)
        if one.symbol is not None:
            moments[one.symbol, one.part] = step.number
    read, inside = read_off(sheet, writer.forces, state, group, letters), dict[str, int]()
    laid = made.known
    if group.way == "drawn system":
        steps.append(writer.step(writer.said("force reason system", links)))
    elif len(group.equation) > 1:
        if laid_off(group):
            lines = laid_lines(sheet, writer.forces, group, letters)
            steps.append(writer.step(writer.said("force step lay"), lines))
            laid = steps[-1].number
        own = [s for s in dict.fromkeys(v.symbol for v in group.polygon if not v.known) if s in read]
        frame = sheet.scene.frame.name
        closed = tuple(
            (each, word("between sentences", each).join((why, closed_by(group, letters, frame, each))).strip())
            for each, why in writer.said(about("force polygon closes", group.links), links)
        )
        steps.append(writer.step(closed, [read.pop(s) for s in own], own))
    closing = steps[-1].number
    for link, vectors in group.inner.items():
        own = [s for s in dict.fromkeys(v.symbol for v in vectors if not v.known) if s in read]
        if own:
            found = listed([writer.name(s) for s in own])
            steps.append(writer.step(writer.said("force step inside", link, found), [read.pop(s) for s in own], own))
            inside[link] = steps[-1].number
    couples: dict[Symbol, int] = {}
    for step, one in writer.sentences([couple_sentences(sheet, group, letters, each) for each in writer.spoken]):
        steps.append(step)
        if one.symbol is not None:
            couples[one.symbol] = step.number
    title = tuple((each, group_caption(sheet, group, count, each)) for each in writer.spoken)
    return replace(
        made, title=title, steps=tuple(steps), laid=laid, closing=closing, moments=moments, inside=inside,
        couples=couples,
    )  # fmt: skip


def _levers(writer: _StageWriter) -> Iterator[ForceStage]:
    forces, c = writer.forces, writer.letters.convention
    for k, state in enumerate(forces.states):
        for lever in forces.levers[k]:
            first = writer.said("lever reason", f"${pole(c, 'velocity')}$")
            if lever.virtual:
                first = tuple((each, f"{a} {say(Phrase('lever virtual'), each)}") for each, a in first)
            steps = [writer.step(first), writer.step(writer.said("lever step forces"))]
            shown, _ = lever_on_page(writer.sheet, lever)
            sums = [lever_sum(writer.sheet, state, shown, writer.letters, each) for each in writer.spoken]
            words = tuple((each, balance) for each, (_, balance) in zip(writer.spoken, sums, strict=True))
            steps.append(writer.step(words, in_both([total for total, _ in sums]), [lever.balance]))
            yield ForceStage("lever", writer.said("lever"), tuple(steps), state, again=bool(k))
