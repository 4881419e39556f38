"""The account of a sheet in a school of notation: the telling of its steps, and the points of its polygons with their
letters.

Sums are the same in every language.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar

from graphkin.account.arithmetic import lengths_measured, times_scale
from graphkin.account.notation import Notation, notation_of, pole
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import (
    GIVEN,
    Bar,
    DiagramName,
    Direction,
    Mark,
    PointNames,
    Reason,
    Size,
    Step,
    Vector,
)
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, Wording, clauses, filled, languages, listed, rich_text, word
from graphkin.words.symbols import RichText, Words
from graphkin.words.written import roman

SAME = 0.02  # mm: nearer end points fall together on paper
ZERO = 0.02  # mm: a shorter vector is drawn as a dot
KNOWN = {"an": "normal", "ak": "coriolis"}  # components whose size and direction are known


@dataclass(frozen=True, eq=False, repr=False)
class NamedPoint:
    """A point of a polygon (mm from the pole) and its letter.

    ref : the point of the mechanism of an end point; None for the pole and for feet between components
    symbol, role : of a foot, the component that ends there, which the step of a number draws
    aid : whether the component leads to a special point or is laid off before its turn
    """

    at: complex
    letter: RichText = RichText()  # noqa: RUF009  a value
    ref: PointRef | None = None
    symbol: Symbol | None = None
    role: str = ""
    step: int = 0
    aid: bool = False


@dataclass(frozen=True, eq=False, repr=False)
class PolygonPoints:
    """End points, feet between components and the pole of a polygon, with their letters; ``seen`` tells whether the
    place of a special point (mm from the pole) is on the paper."""

    sheet: Sheet
    diagram: DiagramName
    letters: Notation
    seen: Callable[[complex], bool] = lambda _: True

    @cached_property
    def _steps(self) -> tuple[Step, ...]:
        return self.sheet.of(self.diagram)

    @cached_property
    def vectors(self) -> Mapping[Symbol, tuple[int, Vector]]:
        """Each vector, with the number of the step that drew it last."""
        return {s.symbol: (step.number, s) for step in self._steps for s in step.vectors}

    @cached_property
    def named(self) -> tuple[NamedPoint, ...]:
        """All points with letters, the pole first; where the convention names vectors, only the pole."""
        origin = NamedPoint(0j, pole(self.letters.convention, self.diagram))
        refs = ((at, ref) for at, refs in self.places.items() for ref in refs)
        ends = (NamedPoint(at, self.letters.end(self.diagram, ref), ref) for at, ref in refs)
        return (origin, *(point for point in (*ends, *self.feet) if point.letter))

    @cached_property
    def places(self) -> Mapping[complex, Sequence[PointRef]]:
        """End points by their places (mm from the pole), in the order of construction; the pole first, with all points
        at rest."""
        places = {0j: [PointRef(p) for p in self.sheet.scene.frame.points]}
        known = set(places[0j])
        marks = [mark for step in self._steps for mark in step.each(Mark)]
        special = self.sheet.special_points  # shown where on the paper
        ends = {symbol.of for symbol in self.vectors if symbol.to is None}
        ends |= {mark.ref for mark in marks if mark.ref.point in special and self.seen(mark.at)}
        for mark in marks:
            if mark.ref in ends - known:
                known.add(mark.ref)
                at = next((at for at in places if abs(at - mark.at) <= SAME), mark.at)
                places.setdefault(at, []).append(mark.ref)
        return places

    @cached_property
    def feet(self) -> tuple[NamedPoint, ...]:
        """Points between components, the ends of components without an end point or another component's end, with their
        letters."""
        taken, between = [*self.places], list[NamedPoint]()
        for foot in self._components():
            if all(abs(foot.at - z) > SAME for z in taken):
                taken.append(foot.at)
                between.append(foot)
        special = self.sheet.special_points
        per_role = Counter(foot.role for foot in between)
        per_end: Counter[RichText] = Counter()
        feet: list[NamedPoint] = []
        written = {self.letters.end(self.diagram, ref) for refs in self.places.values() for ref in refs}
        for foot in between:
            assert foot.symbol is not None
            of, to = foot.symbol.of, foot.symbol.to
            assert of is not None
            # counted by the letter that is written: B and B@2 are one end point
            end = self.letters.end(self.diagram, of)
            per_end[end] += 1
            link = next((special[r.point] for r in (of, to) if r and r.point in special), "")
            link = link or link_of_vector(self.sheet, foot.symbol)
            letter = self.letters.foot(foot.role, of, per_end[end], link, per_role[foot.role] == 1)
            if letter in written:
                per_end[end] += 1
                index = RichText(*map(self.letters.ref, (of, to) if to else (of,)))
                letter = self.letters.foot(foot.role, of, per_end[end], index, alone=False)
            written.add(letter)
            feet.append(replace(foot, letter=letter))
        return tuple(feet)

    def _components(self) -> Iterator[NamedPoint]:
        """The ends of components, then of known components that lead to a special point or are laid off before their
        turn."""
        for number, vector in self.vectors.values():
            if vector.role not in ("resultant", "relative") and abs(vector.span) >= ZERO:
                yield NamedPoint(vector.tip, symbol=vector.symbol, role=vector.role, step=number)
        known = set(self.vectors)
        for step, stroke in ((s, stroke) for s in self._steps for stroke in s.strokes):
            if isinstance(stroke, Vector) and stroke.aid and not stroke.trial:
                symbol, tail, tip = stroke.symbol, stroke.tail, stroke.tip
            elif isinstance(stroke, Bar) and step.reason == "before its turn":
                symbol, tail, tip = step.symbol, stroke.a, stroke.b
            else:
                continue
            if symbol.kind in KNOWN and symbol not in known and abs(tip - tail) >= ZERO:
                known.add(symbol)
                yield NamedPoint(tip, symbol=symbol, role=KNOWN[symbol.kind], step=step.number, aid=True)


def link_of_vector(sheet: Sheet, symbol: Symbol) -> str:
    """The link whose motion a vector shows: the link of its point, the common link of two points, or the sliding link
    of two coincident points."""
    scene = sheet.scene
    of, to = symbol.of, symbol.to
    if of is None:
        return symbol.link
    mine = _links(scene.holders, of)
    if to is None:
        moving = [name for name in mine if name != scene.frame.name]
        pivoted = [n for n in moving if scene.pivots(n)]
        return (pivoted or moving or [scene.frame.name])[0]
    theirs = _links(scene.holders, to)
    if of.point != to.point:
        both, links = {of.point, to.point}, sheet.structure.links
        common = [name for name in mine if name in theirs and name != scene.frame.name]
        common += [bar for bar in scene.replaced_by if bar in links and both <= links[bar].points.keys()]
        if common:
            return common[0]
    sliding = {s.a for s in sheet.structure.slides} | {s.body for s in scene.slides}
    for name in (*mine, *theirs):
        if name in sliding:
            return name
    return (mine or theirs or [scene.frame.name])[0]


def _links(holders: Mapping[str, tuple[str, ...]], ref: PointRef) -> list[str]:
    return [ref.link] if ref.link else list(holders.get(ref.point, ()))


# sentences


@dataclass(frozen=True, eq=False, repr=False)
class Account:
    """Tells the construction of one sheet in the letters of one convention."""

    sheet: Sheet
    letters: Notation

    def sentence(self, phrase: Phrase, language: str) -> RichText:
        """A phrase as a sentence with its full stop."""
        return whole_sentence(self.say(phrase, language), language)

    def say(self, phrase: Phrase, language: str) -> RichText:
        """A phrase with its symbols."""
        return rich_text(phrase, language, lambda part: self._show(part, language))

    def in_each(self, phrase: Phrase, language: str) -> Iterable[RichText]:
        """A phrase with its symbols in each language of a sheet, once where they say it alike."""
        return dict.fromkeys(self.say(phrase, each) for each in languages(language))

    def _show(self, part: object, language: str) -> Words:
        if isinstance(part, str | RichText):
            return part
        if isinstance(part, Symbol):
            return self.letters.vector(part)
        if isinstance(part, PointRef):
            return self.letters.coincident(part)
        if isinstance(part, PointNames):
            points = [self.letters.point(name) for name in part.names]
            return RichText(*points) if part.bar else rich_text(listed(points), language)
        if isinstance(part, Direction):
            return self.letters.direction(part, self.sheet.scene.frame.name)
        if isinstance(part, Size):
            return word("given", language).lower() if part == GIVEN else self.letters.size(part)
        return str(part)

    def end_at(self, diagram: DiagramName, at: complex | None) -> RichText | None:
        """The letter of a place of a polygon (mm from the pole); None where the convention names vectors instead."""
        named = self._named.get(diagram, ())
        return next((p.letter for p in named if at is not None and abs(p.at - at) <= SAME and p.letter), None)

    def end_of(self, diagram: DiagramName, ref: PointRef) -> RichText | None:
        """The letter of an end point; for a point at rest the pole."""
        if ref.point in self.sheet.scene.frame.points and ref.link in ("", self.sheet.scene.frame.name):
            return pole(self.letters.convention, diagram)
        point = self.end_point(diagram, ref)
        return None if point is None else point.letter

    def end_point(self, diagram: DiagramName, ref: PointRef) -> NamedPoint | None:
        """An end point with its place and its letter."""
        # where coincident points are told apart the point alone is that of its block
        refs = (ref, PointRef(ref.point)) if self.letters.blocks.get(ref.point) == ref.link else (ref,)
        return next((p for point in refs for p in self._named.get(diagram, ()) if p.ref == point), None)

    @cached_property
    def lengths(self) -> Mapping[int, Sequence[RichText]]:
        """The lengths that are measured for the sums of a step, by its number."""
        measured: dict[int, list[RichText]] = {}
        for step, _, line in lengths_measured(self.sheet, self.letters, images=True):
            measured.setdefault(step, []).append(line)
        return measured

    @cached_property
    def _named(self) -> Mapping[DiagramName, tuple[NamedPoint, ...]]:
        diagrams: tuple[DiagramName, ...] = ("velocity", "acceleration")
        return {diagram: PolygonPoints(self.sheet, diagram, self.letters).named for diagram in diagrams}


def account_of(sheet: Sheet) -> Account:
    """The account of a sheet in the letters of its scene's convention."""
    return Account(sheet, notation_of(sheet, sheet.scene.question.sheet.convention))


@dataclass(frozen=True, eq=False, repr=False)
class Telling:
    """The telling of a step: by its reason its ``sentences``, keys of the table of words from the fullest to the
    barest, of which the first with filled gaps is said; its ``sums``, and the ``lines`` to repeat it."""

    account: Account
    step: Step
    sentences: ClassVar[Mapping[Reason, Any]] = {}
    arithmetic: ClassVar[Mapping[Reason, Callable[[Any], Iterable[Words]]]] = {}
    lines: ClassVar[Mapping[Reason, Callable[[Any, str], Iterable[Words | Phrase]]]] = {}

    @property
    def sheet(self) -> Sheet:
        """The sheet of the step."""
        return self.account.sheet

    def gap(self, name: str) -> object:
        """The value of a gap by its name: a property of the telling, else an argument of the step; None without a
        value."""
        derived = isinstance(getattr(type(self), name, None), property)
        return getattr(self, name) if derived else self.step.gap(name)

    def first(self, *keys: str) -> Phrase | None:
        """The first of some sentences whose gaps can be filled."""
        return filled(keys, self.gap)

    @property
    def said(self) -> Phrase:
        """Its sentence, with the letters and sides of the paper if it has any."""
        keys = self.sentences.get(self.step.reason, ())
        return (keys(self) if callable(keys) else self.first(*keys)) or self.step.phrase

    @property
    def work(self) -> tuple[Words, ...]:
        """Its sums, as lines of symbols and numbers, after the lengths measured for them."""
        lengths = self.account.lengths.get(self.step.number, ())
        return (*lengths, *self.arithmetic.get(self.step.reason, type(self).measured)(self))

    def measured(self) -> Iterable[Words]:
        """Each measured vector of the step."""
        for vector in self.step.vectors:
            size = abs(vector.span)
            value = times_scale(self.sheet, self.step.diagram, size) if size else "0"
            yield self.account.letters.vector(vector.symbol) + f" = {value}"

    def sentence(self, language: str) -> Words:
        """Its sentence in a language, with the letters of its first and last point."""
        return self.account.sentence(self.said, language)

    def written(self, language: str) -> Iterator[Words]:
        """The lines to repeat it."""
        for line in self.lines[self.step.reason](self, language) if self.step.reason in self.lines else ():
            yield from self.account.in_each(line, language) if isinstance(line, Phrase) else (line,)


def numbered(rows: Iterable[Sequence[str]]) -> Wording:
    """Rows of numbers, each with its numeral."""
    return clauses([Phrase("numbered row", number=roman(i), values=listed(row)) for i, row in enumerate(rows, 1)])


def whole_sentence(text: Words, language: str) -> RichText:
    """Words as a sentence, with its capital and its full stop."""
    stop = word("full stop", language)
    return RichText(capital(text)).cut(stop)[0] + stop


def capital(text: Words) -> Words:
    """Words with a capital; a symbol stays as it is.

    >>> capital("the rise"), capital("φ = 140°")
    ('The rise', 'φ = 140°')
    """
    if isinstance(text, str):
        return text[:1].upper() + text[1:] if text[:1].isascii() else text
    first, *others = text.parts or ("",)
    return RichText(capital(first), *others) if isinstance(first, str) else text
