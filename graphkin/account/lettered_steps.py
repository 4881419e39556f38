"""Steps of a polygon as they are said on paper: each from a lettered point, in a sense, to a lettered point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, reduce

from graphkin.account.end_letters import SAME, EndLetters, Markup
from graphkin.account.group_lines import carried_over
from graphkin.account.group_steps import divided, laid_off_by_rate, tried
from graphkin.account.headings import number, written
from graphkin.account.notation import Letters
from graphkin.account.position_steps import PositionSteps
from graphkin.construction.polygon_acts import (
    Asked,
    ByImage,
    ByRate,
    Carried,
    DirectionLine,
    FoundVector,
    LaidOff,
    LinesMeet,
    Named,
    Resultant,
    SeenByRate,
    Superposed,
    TrialDrawn,
)
from graphkin.construction.sheet import Sheet, Step
from graphkin.construction.sizes import Direction, Given, Size
from graphkin.construction.strokes import Aid, Bar, Ray, Vector
from graphkin.plane import dot
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase
from graphkin.words.written import amount, on_paper, pointing, quotient

__all__ = ["LetteredSteps"]

ON_THE_POINT = 1e-9  # of a bar: so near to its end a point divides nothing


@dataclass(frozen=True)
class LetteredSteps:
    """Says the steps of one sheet with the letters that its polygons bear in one convention; where the convention names
    vectors instead, with these."""

    sheet: Sheet
    letters: Letters

    def phrase(self, step: Step) -> Phrase:
        """A step as a sentence to be."""
        return self._said(step) or step.phrase

    def _said(self, step: Step) -> Phrase | None:
        act = step.act
        vector = _drawn(step)
        ray = next((s for s in step.strokes if isinstance(s, Ray)), None)
        if isinstance(act, LaidOff) and vector is not None and not act.is_zero:
            told, why = self._laid_off(step, act, vector), carried_over(self.sheet, step, act)
            return told if why is None else Phrase("in turn", (told or step.phrase, why))
        if isinstance(act, FoundVector) and vector is not None and not act.is_zero:
            name = self._between(step, vector)
            return Phrase("found lettered", (name, act.symbol, on_paper(act.mm))) if name else None
        if isinstance(act, DirectionLine) and ray is not None:
            return self._line(step, act, ray)
        if isinstance(act, LinesMeet | Named):
            letter = self._ends.of(step.diagram, act.point)
            key = "meet in" if isinstance(act, LinesMeet) else "name letter"
            return Phrase(key, (letter, act.point)) if letter else None
        if isinstance(act, Resultant | Asked) and vector is not None:
            name = self._between(step, vector)
            key = "join" if isinstance(act, Resultant) else "asked lettered"
            ends = self._at(step, vector.tail), self._at(step, vector.tip)
            return Phrase(key, (*ends, name, act.symbol)) if name else None
        if isinstance(act, Carried):
            return self._carried(step, act)
        if isinstance(act, TrialDrawn):
            return tried(self.sheet, step, act)
        if isinstance(act, Superposed):
            return divided(self.sheet, step, act, self._ends)
        if isinstance(act, ByRate | SeenByRate):
            return laid_off_by_rate(self.sheet, step, act, self._ends)
        return self._by_image(step, act) if isinstance(act, ByImage) else PositionSteps(self.sheet).phrase(step)

    def _carried(self, step: Step, act: Carried) -> Phrase | None:
        """A known term behind the unknown one, laid off before it."""
        bar = next((s for s in step.strokes if isinstance(s, Bar)), None)
        start = self._start(step, bar.a) if bar else None
        sides = self.sheet.equations[step.equation - 1].sides if step.equation is not None else ()
        term = next((term for side in sides for term in side if term.symbol == act.symbol), None)
        if bar is None or start is None or term is None or term.direction is None:
            return None
        if abs(bar.b - bar.a) < SAME:
            return Phrase("zero vector", (act.symbol,))
        rule = _rule(act.symbol, term.size)
        what = (rule, on_paper(abs(bar.b - bar.a)), _way(term.direction, bar.b - bar.a))
        ends = self._at(step, bar.a), self._at(step, bar.b)
        if None in ends or ends[0] == ends[1]:
            return Phrase("carry from", (start, *what))
        return Phrase("carry lettered", (start, _joined(*ends), *what, ends[1]))

    def _laid_off(self, step: Step, act: LaidOff, vector: Vector | Aid) -> Phrase | None:
        start = self._start(step, vector.tail)
        if start is None:
            return None
        key = {"normal": "as normal", "coriolis": "as Coriolis"}.get(act.role, "as vector")
        rule = _rule(act.symbol, act.size)
        name, end = self._between(step, vector), self._at(step, vector.tip)
        what = (Phrase(key, (rule,)), on_paper(act.mm), _way(act.direction, vector.span))
        if name is None:
            return Phrase("lay off from", (start, *what))
        return Phrase("lay off lettered", (start, name, *what, end))

    def _line(self, step: Step, act: DirectionLine, ray: Ray) -> Phrase | None:
        letter = self._at(step, ray.through)
        what = self._unknown(step, act.symbol)
        if abs(ray.through) < SAME:
            return Phrase("direction from pole", (what, act.direction, letter))
        before = self._before(step, act.symbol, ray.through)
        if letter is None:
            return Phrase("direction from end", (what, act.direction, before)) if before else None
        if before is None:
            return Phrase("direction from point", (what, act.direction, letter))
        return Phrase("direction from lettered end", (what, act.direction, before, letter))

    def _unknown(self, step: Step, of: Symbol) -> Symbol | Phrase:
        """What lies on a line: a vector, or the sum of those of its side whose sizes are unknown along it."""
        sides = self.sheet.equations[step.equation - 1].sides if step.equation is not None else ()
        side = next((side for side in sides if any(term.symbol == of for term in side)), ())
        along = next((term.direction for term in side if term.symbol == of), None)
        return reduce(_sum, (t.symbol for t in side if not t.size_known and t.direction == along), None) or of

    def _by_image(self, step: Step, act: ByImage) -> Phrase | None:
        """The division of a line, with its ratio, or the similar triangle."""
        refs = (act.point, *act.between)
        places = [self.sheet.points.get(PointRef(ref.point)) for ref in refs]
        ends = [self._ends.of(step.diagram, ref) for ref in refs]
        bars = [self.letters.point(ref.point) for ref in refs]
        if not act.on_line:
            if None in ends:
                return None
            return self._triangle(act, places, ends, bars)
        at, a, b = places
        if at is None or a is None or b is None or abs(b - a) < SAME:
            return None
        along = dot(at - a, b - a) / abs(b - a) ** 2
        if abs(along) < ON_THE_POINT:
            return None
        where = "before" if along < 0.0 else "within" if along <= 1.0 else "beyond"
        unit = self.sheet.scales.length / self.sheet.scene.units.metres
        part, bar = (amount(abs(z - a) * unit, 4) for z in (at, b))
        numbers = (written(one) for one in (part, bar, quotient(part, bar, 4)))  # the ratio of what stands there
        whole = (Markup(bars[1] + bars[0]), Markup(bars[1] + bars[2]), *numbers)
        if None in ends or self._at(step, self._ends.place(step.diagram, act.point)) is None:
            return Phrase(f"division {where}", (act.point, *act.between, act.link, *whole))
        names = (ends[0], _joined(*ends[1:]), _joined(ends[1], ends[0]), ends[1], ends[2])
        return Phrase(f"division lettered {where}", (*names, act.link, *whole))

    def _triangle(
        self, act: ByImage, places: Sequence[complex | None], ends: Sequence[Markup | None], bars: Sequence[str]
    ) -> Phrase:
        """The similar triangle, with the ratios by which a compass finds its third corner."""
        names = (ends[0], _joined(*ends[1:], ends[0]), Markup("".join((*bars[1:], bars[0]))), act.link)
        at, a, b = places
        if at is None or a is None or b is None or abs(b - a) < SAME:
            return Phrase("image lettered", names)
        ratios = [number(abs(at - z) / abs(b - a), 4) for z in (a, b)]
        sides = _joined(ends[1], ends[0]), _joined(ends[2], ends[0]), _joined(*ends[1:])
        return Phrase("image with sides", (*names, *sides, *ratios))

    # -- letters -----------------------------------------------------------------------------------------------------

    @cached_property
    def _ends(self) -> EndLetters:
        return EndLetters(self.sheet, self.letters)

    def _at(self, step: Step, at: complex | None) -> Markup | None:
        """The letter of a place of a polygon."""
        return self._ends.at(step.diagram, at)

    def _between(self, step: Step, vector: Vector | Aid) -> Markup | None:
        """A vector by the letters of its ends: ``pb``; None where the convention has no letters, and where it is so
        small that one letter stands for both."""
        ends = self._at(step, vector.tail), self._at(step, vector.tip)
        return None if None in ends or ends[0] == ends[1] else _joined(*ends)

    def _start(self, step: Step, at: complex) -> Phrase | None:
        """Where a vector begins: a letter, or the end of a vector."""
        letter = self._at(step, at)
        if letter is not None:
            return Phrase("the pole" if abs(at) < SAME else "the point", (letter,))
        before = self._before(step, None, at)
        return Phrase("the end of", (before,)) if before else None

    def _before(self, step: Step, symbol: Symbol | None, at: complex) -> Symbol | None:
        """The vector that ends in a place: the one before it in the equation as written, else the one drawn last."""
        drawn: dict[Symbol, complex] = {}
        for one in self.sheet.steps[: self.sheet.steps.index(step)]:
            for stroke in one.strokes if one.diagram == step.diagram else ():
                if isinstance(stroke, Bar) and isinstance(one.act, Carried):
                    drawn[one.act.symbol] = stroke.b
                elif isinstance(stroke, Vector | Aid):
                    drawn[stroke.symbol] = stroke.tip
        there = [s for s, tip in drawn.items() if abs(tip - at) < SAME]
        if step.equation is not None and symbol is not None:
            for side in self.sheet.equations[step.equation - 1].sides:
                terms = [term.symbol for term in side]
                if symbol in terms[1:] and terms[terms.index(symbol) - 1] in there:
                    return terms[terms.index(symbol) - 1]
        return there[-1] if there else None


def _drawn(step: Step) -> Vector | Aid | None:
    """The vector of a step; those of trial polygons bear no letters."""
    vectors = (s for s in step.strokes if isinstance(s, Vector) or (isinstance(s, Aid) and not s.trial))
    return next(vectors, None)


def _rule(symbol: Symbol, size: Size | None) -> Symbol | Phrase:
    """A vector with the rule of its size, where that is not just given."""
    return symbol if size is None or isinstance(size, Given) else Phrase("rule of size", (symbol, size))


def _sum(before: Symbol | Phrase | None, symbol: Symbol) -> Symbol | Phrase:
    return symbol if before is None else Phrase("sum", (before, symbol))


def _way(direction: Direction, span: complex) -> Direction | Phrase:
    """A direction with its sense, where that does not lie in its name."""
    if direction.relation == "towards":
        return direction
    angle = pointing(span)
    return Phrase("pointing", (direction, angle)) if direction.names else Phrase("pointing only", (angle,))


def _joined(*letters: Markup | None) -> Markup:
    return Markup("".join(letter for letter in letters if letter))
