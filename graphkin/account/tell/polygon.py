"""Steps of a polygon as they are told: each from a lettered point, in a sense, to a lettered point; rates with the
quotients that give them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import reduce
from typing import Any, TypeAlias, TypeVar

from graphkin.account.arithmetic import bound, laid_sum, parts_by_rates, plan_sum, rate_sum, rule_sum
from graphkin.account.end_letters import SAME
from graphkin.account.headings import number, term, written
from graphkin.account.measured_lengths import scale_of, unit_of
from graphkin.account.voice import Told
from graphkin.construction.mechanism_acts import HeldStill
from graphkin.construction.polygon_acts import (
    AddedRate,
    Asked,
    ByImage,
    ByRate,
    Carried,
    DirectionLine,
    FoundVector,
    ImageSeen,
    LaidOff,
    LinesMeet,
    MeasuredRate,
    Named,
    PlanDrawn,
    RateSeen,
    Resultant,
    SeenByRate,
    SeenFrom,
    end_of,
)
from graphkin.construction.sheet import Act, Rate, Term
from graphkin.construction.sizes import Direction, Given, RateTimes, Size
from graphkin.construction.strokes import Aid, Bar, Ray, Vector
from graphkin.plane import dot
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Neutral, Phrase, languages
from graphkin.words.rich_text import Markup
from graphkin.words.written import MOST, amount, on_paper, pointing, quotient

__all__ = ["TOLD", "alike", "rate_name"]

ON_THE_POINT = 1e-9  # of a bar: so near to its end a point divides nothing
ActType = TypeVar("ActType", bound=Act)


class _InPolygon(Told[ActType]):
    """A step with the letters of the places between which it goes."""

    @property
    def drawn(self) -> Vector | Aid | None:
        """The vector of the step; those of trial polygons bear no letters."""
        strokes = self.step.strokes
        return next((s for s in strokes if isinstance(s, Vector) or (isinstance(s, Aid) and not s.trial)), None)

    @property
    def sides(self) -> tuple[tuple[Term, ...], ...]:
        """The sides of its equation."""
        return self.sheet.equations[self.step.equation - 1].sides if self.step.equation is not None else ()

    def at(self, place: complex | None) -> Markup | None:
        """The letter of a place of the polygon."""
        return self.voice.ends.at(self.step.diagram, place)

    def end(self, ref: PointRef) -> Markup | None:
        """The letter of an end point."""
        return self.voice.ends.of(self.step.diagram, ref)

    def between(self, vector: Vector | Aid) -> Markup | None:
        """A vector by the letters of its ends: ``pb``; None where the convention has no letters, and where it is so
        small that one letter stands for both."""
        ends = self.at(vector.tail), self.at(vector.tip)
        return None if None in ends or ends[0] == ends[1] else _joined(*ends)

    def start(self, at: complex) -> Phrase | None:
        """Where a vector begins: a letter, or the end of a vector."""
        letter = self.at(at)
        if letter is not None:
            return Phrase("the pole" if abs(at) < SAME else "the point", (letter,))
        before = self.before(None, at)
        return Phrase("the end of", (before,)) if before else None

    def before(self, symbol: Symbol | None, at: complex) -> Symbol | None:
        """The vector that ends in a place: the one before it in the equation as written, else the one drawn last."""
        drawn: dict[Symbol, complex] = {}
        for one in self.sheet.steps[: self.sheet.steps.index(self.step)]:
            for stroke in one.strokes if one.diagram == self.step.diagram else ():
                if isinstance(stroke, Bar) and isinstance(one.act, Carried):
                    drawn[one.act.symbol] = stroke.b
                elif isinstance(stroke, Vector | Aid):
                    drawn[stroke.symbol] = stroke.tip
        there = [s for s, tip in drawn.items() if abs(tip - at) < SAME]
        for side in self.sides if symbol is not None else ():
            terms = [term.symbol for term in side]
            if symbol in terms[1:] and terms[terms.index(symbol) - 1] in there:
                return terms[terms.index(symbol) - 1]
        return there[-1] if there else None

    def laid(self, symbol: Symbol, size: Size | None, length: float) -> tuple[str, str]:
        """The rule of a vector in numbers, and its length on paper."""
        computed, on_scale = laid_sum(self.sheet, self.step.diagram, size, length)
        return f"{self.voice.symbol(symbol)} = {computed}", on_scale


class _LaidOff(_InPolygon[LaidOff]):
    def lettered(self) -> Phrase | None:
        vector = self.drawn
        if vector is None or self.act.is_zero:
            return None
        told, why = self._from_letter(vector), self._carried_over()
        return told if why is None else Phrase("in turn", (told or self.step.phrase, why))

    def _from_letter(self, vector: Vector | Aid) -> Phrase | None:
        act, start = self.act, self.start(vector.tail)
        if start is None:
            return None
        key = {"normal": "as normal", "coriolis": "as Coriolis"}.get(act.role, "as vector")
        name, end = self.between(vector), self.at(vector.tip)
        what = (Phrase(key, (_rule(act.symbol, act.size),)), on_paper(act.mm), _way(act.direction, vector.span))
        if name is None:
            return Phrase("lay off from", (start, *what))
        return Phrase("lay off lettered", (start, name, *what, end))

    def _carried_over(self) -> Phrase | None:
        """From what seen from a held link a vector between points of two links follows, which is laid off as it was
        found; an acceleration with the share of Coriolis that the turning of the other of them adds."""
        act, of, to = self.act, self.act.symbol.of, self.act.symbol.to
        if act.size is not None or act.is_zero or of is None or act.direction.names:
            return None
        before = self.sheet.steps[: self.sheet.steps.index(self.step)]
        held = {s.act.held for s in before if isinstance(s.act, SeenFrom)}
        kind = act.symbol.kind[0]
        seen = next((
            one for s in reversed(before) if (one := _vector_of(s.act)) is not None and one.kind == kind
            and one.of is not None and one.to is not None and one.to.link in held
            and one.of.point == one.to.point == of.point
        ), None)  # fmt: skip
        if seen is None or seen.to is None:
            return None
        against = of.link == seen.to.link
        told = Phrase("against", (seen,)) if against else seen
        if kind == "v" or to is None or not against:
            return Phrase("written carried over", (act.symbol, told))
        slip = next(s.act.symbol for s in before if isinstance(s.act, LaidOff) and s.act.symbol.of == of
                    and s.act.symbol.kind == "v")  # fmt: skip
        size = RateTimes("omega", (seen.to.link, to.link), slip, twice=True)
        turning = self.sheet.omega[seen.to.link].value - self.sheet.omega[to.link].value
        key = "written carried over coriolis cw" if turning < 0.0 else "written carried over coriolis ccw"
        rule = Phrase("rule of size", (size, bound(rule_sum(self.sheet, size, "acceleration"))))
        return Phrase(key, (act.symbol, told, rule, slip))

    def sums(self) -> Iterable[str]:
        if self.act.is_zero:
            return super().sums()
        drawn = next(s for s in self.step.strokes if isinstance(s, Vector | Aid))
        return self.laid(self.act.symbol, self.act.size, abs(drawn.span))

    def lines(self, language: str) -> Iterator[str]:
        told = self._carried_over()
        if told is not None:
            yield self.voice.say(told, languages(language)[0])


def _vector_of(act: object) -> Symbol | None:
    """The vector that an act gives."""
    if isinstance(act, FoundVector | Resultant):
        return act.symbol
    return act.vector if isinstance(act, ImageSeen | SeenByRate) else None


class _Found(_InPolygon[FoundVector]):
    def lettered(self) -> Phrase | None:
        name = self.between(self.drawn) if self.drawn is not None and not self.act.is_zero else None
        return Phrase("found lettered", (name, self.act.symbol, on_paper(self.act.mm))) if name else None


class _Line(_InPolygon[DirectionLine]):
    def lettered(self) -> Phrase | None:
        act, ray = self.act, next((s for s in self.step.strokes if isinstance(s, Ray)), None)
        if ray is None:
            return None
        letter, what = self.at(ray.through), self._unknown()
        if abs(ray.through) < SAME:
            return Phrase("direction from pole", (what, act.direction, letter))
        before = self.before(act.symbol, ray.through)
        if letter is None:
            return Phrase("direction from end", (what, act.direction, before)) if before else None
        if before is None:
            return Phrase("direction from point", (what, act.direction, letter))
        return Phrase("direction from lettered end", (what, act.direction, before, letter))

    def _unknown(self) -> Symbol | Phrase:
        """What lies on the line: a vector, or the sum of those of its side whose sizes are unknown along it."""
        of = self.act.symbol
        side = next((side for side in self.sides if any(term.symbol == of for term in side)), ())
        along = next((term.direction for term in side if term.symbol == of), None)
        return reduce(_sum, (t.symbol for t in side if not t.size_known and t.direction == along), None) or of


class _AtPoint(_InPolygon[Any]):
    """Lines that meet in an end point, or an end point that stands already and gets its letter."""

    key: str

    def lettered(self) -> Phrase | None:
        letter = self.end(self.act.point)
        return Phrase(self.key, (letter, self.act.point)) if letter else None


class _Meeting(_AtPoint):
    key = "meet in"


class _Naming(_AtPoint):
    key = "name letter"


class _Joining(_InPolygon[Any]):
    """A vector drawn from letter to letter."""

    key = "join"

    def lettered(self) -> Phrase | None:
        vector = self.drawn
        name = self.between(vector) if vector is not None else None
        if vector is None or name is None:
            return None
        return Phrase(self.key, (self.at(vector.tail), self.at(vector.tip), name, self.act.symbol))


class _Asked(_Joining):
    key = "asked lettered"


class _Carried(_InPolygon[Carried]):
    def lettered(self) -> Phrase | None:
        """A known term behind the unknown one, laid off before it."""
        bar = next((s for s in self.step.strokes if isinstance(s, Bar)), None)
        start = self.start(bar.a) if bar else None
        term = next((term for side in self.sides for term in side if term.symbol == self.act.symbol), None)
        if bar is None or start is None or term is None or term.direction is None:
            return None
        if abs(bar.b - bar.a) < SAME:
            return Phrase("zero vector", (self.act.symbol,))
        rule = _rule(self.act.symbol, term.size)
        what = (rule, on_paper(abs(bar.b - bar.a)), _way(term.direction, bar.b - bar.a))
        ends = self.at(bar.a), self.at(bar.b)
        if None in ends or ends[0] == ends[1]:
            return Phrase("carry from", (start, *what))
        return Phrase("carry lettered", (start, _joined(*ends), *what, ends[1]))

    def sums(self) -> Iterable[str]:
        if self.step.equation is None:
            return super().sums()
        size = next((t.size for side in self.sides for t in side if t.symbol == self.act.symbol), None)
        bar = next((s for s in self.step.strokes if isinstance(s, Bar) and s.b != s.a), None)
        return self.laid(self.act.symbol, size, abs(bar.b - bar.a)) if bar and size else ()


class _Image(_InPolygon[ByImage]):
    """The division of a line, with its ratio, or the similar triangle."""

    shares_line = True

    def lettered(self) -> Phrase | None:
        act = self.act
        refs = (act.point, *act.between)
        places = [self.sheet.points.get(PointRef(ref.point)) for ref in refs]
        ends = [self.end(ref) for ref in refs]
        bars = [self.voice.letters.point(ref.point) for ref in refs]
        if not act.on_line:
            return None if None in ends else self._triangle(places, ends, bars)
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
        if None in ends or self.at(self.voice.ends.place(self.step.diagram, act.point)) is None:
            return Phrase(f"division {where}", (act.point, *act.between, act.link, *whole))
        names = (ends[0], _joined(*ends[1:]), _joined(ends[1], ends[0]), ends[1], ends[2])
        return Phrase(f"division lettered {where}", (*names, act.link, *whole))

    def _triangle(
        self, places: Sequence[complex | None], ends: Sequence[Markup | None], bars: Sequence[str]
    ) -> Phrase:
        """The similar triangle, with the ratios by which a compass finds its third corner."""
        names = (ends[0], _joined(*ends[1:], ends[0]), Markup("".join((*bars[1:], bars[0]))), self.act.link)
        at, a, b = places
        if at is None or a is None or b is None or abs(b - a) < SAME:
            return Phrase("image lettered", names)
        ratios = [number(abs(at - z) / abs(b - a), 4) for z in (a, b)]
        sides = _joined(ends[1], ends[0]), _joined(ends[2], ends[0]), _joined(*ends[1:])
        return Phrase("image with sides", (*names, *sides, *ratios))

    def lines(self, language: str) -> Iterator[str]:
        """``△bce ∼ △BCE``, or ``pm : pd = AM : AD`` for a point between others; where a convention has no end points
        the vector with what is similar on the link, nothing for one that is not drawn."""
        act, voice = self.act, self.voice
        ends = [self.end(ref) for ref in (*act.between, act.point)]
        one, two, three = (voice.letters.point(ref.point) for ref in (*act.between, act.point))
        if None in ends:
            vector = Symbol("v" if self.step.diagram == "velocity" else "a", act.point)
            if voice.letters.convention == "us" and vector in self.sheet.vectors(self.step.diagram):
                alike = f"${one}{three}$ : ${one}{two}$" if act.on_line else f"△${one}{two}{three}$"
                told = Phrase("written image named", (vector, act.link, Neutral(alike)))
                yield bound(voice.say(told, languages(language)[0]))
            return
        a, b, c = (str(end) for end in ends)
        if act.on_line:
            yield bound(f"${a}{c}$ : ${a}{b}$ = ${one}{three}$ : ${one}{two}$")
        else:
            yield bound(f"△${a}{b}{c}$ ∽ △${one}{two}{three}$")


class _ImageSeen(Told[ImageSeen]):
    shares_line = True

    def lines(self, language: str) -> Iterator[str]:
        told = Phrase("written image seen", (self.act.vector, self.act.link))
        yield self.voice.say(told, languages(language)[0])


class _ByRates(_InPolygon[ActType]):
    """An end point from another of its link: what the rates give, laid off from letter to letter."""

    act: Any

    def _laid_from(self, start: Phrase) -> Phrase | None:
        """The parts laid off one behind the other."""
        laid = list[Phrase]()
        for part in parts_by_rates(self.sheet, self.step.diagram, self.act):
            key = "as normal" if part.rule.square else "as vector"
            way = part.direction if part.rule.square else Phrase("pointing", (part.direction, pointing(part.span)))
            rule = Phrase(key, (Phrase("rule of size", (part.symbol, part.rule)),))
            laid.append(Phrase("lay off from", (start, rule, on_paper(abs(part.span)), way)))
            start = Phrase("the end of", (part.symbol,))
        return reduce(lambda one, other: Phrase("in turn", (one, other)), laid) if laid else None

    def sums(self) -> Iterator[str]:
        """The parts of a relative vector that follow from the rates of a link, each with its length and direction."""
        per, unit = scale_of(self.sheet, self.step.diagram), unit_of(self.sheet, self.step.diagram)
        parts = parts_by_rates(self.sheet, self.step.diagram, self.act)
        for said, part in zip(self.lines("en"), parts, strict=True):
            yield said
            yield f"÷ {number(per)} ({unit})/mm = {written(on_paper(abs(part.span)))} mm,  {pointing(part.span)}°"
        yield from super().sums()

    def lines(self, language: str) -> Iterator[str]:
        """``v_CB = ω_3 l_CB = 1.4737 × 151.21 = 222.84 mm/s,  ⊥CB``."""
        letters = self.voice.letters
        for part in parts_by_rates(self.sheet, self.step.diagram, self.act):
            way = letters.direction(part.direction, self.sheet.scene.frame.name)
            rule = f"${letters.size(part.rule)}$ =\u00a0{bound(rule_sum(self.sheet, part.rule, self.step.diagram))}"
            yield f"{self.voice.symbol(part.symbol)} =\u00a0{rule},  ${way}$"


class _ByRate(_ByRates[ByRate]):
    def lettered(self) -> Phrase | None:
        start, end = self.end(self.act.start), self.end(self.act.point)
        told = self._laid_from(Phrase("the point", (start,))) if start and end else None
        return None if told is None else Phrase("ends in", (told, end))


class _SeenByRate(_ByRates[SeenByRate]):
    def lettered(self) -> Phrase | None:
        told = self._laid_from(end_of(self.act.start))
        return None if told is None else Phrase("ends seen", (told, self.act.vector))


# -- rates -------------------------------------------------------------------------------------------------------------


class _Rates(Told[ActType]):
    """A rate that is the quotient of a vector and a bar."""

    act: Any

    def names(self) -> tuple[str, ...]:
        """The links that turn so, as indices of the rate."""
        return (self.act.link,)

    def sums(self) -> Iterable[str]:
        act, unit = self.act, "rad/s" if self.act.rate == "omega" else "rad/s²"
        value = rate_sum(self.sheet, act) or f"{number(abs(act.value), MOST)} {unit}"
        return (f"{rate_name(act.rate, self.names()[0])} = {value}",)

    def lines(self, language: str) -> Iterator[str]:
        """``ω_4 = ω_3 = v_A4 / l_AO4 = 0.74 rad/s, clockwise``."""
        act, value = self.act, self.value()
        rule = f"{self.voice.symbol(act.vector)} / ${self.voice.letters.length(act.bar)}$"
        unit = "rad/s" if act.rate == "omega" else "rad/s²"
        shown = bound(rate_sum(self.sheet, act, units=False)) or f"{number(abs(value), 5)} {unit}"
        names = (rate_name(act.rate, name) for name in self.names())
        yield " =\u00a0".join((*names, rule, shown)) + _turning(value, language)

    def value(self) -> float:
        return float(self.act.value)


class _Measured(_Rates[MeasuredRate]):
    def names(self) -> tuple[str, ...]:
        rates = self.sheet.omega if self.act.rate == "omega" else self.sheet.alpha
        return (self.act.link, *alike(rates.values(), rates[self.act.link]))

    def value(self) -> float:
        return (self.sheet.omega if self.act.rate == "omega" else self.sheet.alpha)[self.act.link].value


class _Seen(_Rates[RateSeen]):
    """As a link is seen from a held one."""

    def names(self) -> tuple[str, ...]:
        return (self.act.link + self.act.held,)


class _Added(Told[AddedRate]):
    def lines(self, language: str) -> Iterator[str]:
        """``ω_2 = ω_3 + ω_23 = −0.04162 + 0.08323 = 0.04161 rad/s``: a link whose turning relative to another is known,
        as soon as that one turns at a known rate."""
        yield bound(self.voice.say(self.step.phrase, languages(language)[0]))


class _HeldStill(Told[HeldStill]):
    def lines(self, language: str) -> Iterator[str]:
        """``ω_32 = 0.1437 rad/s, clockwise, drawn apart, with one link held still``."""
        act = self.act
        if act.gives in ("omega", "alpha"):
            unit = "rad/s" if act.gives == "omega" else "rad/s²"
            value = f"{number(abs(act.value), 5)} {unit}{_turning(act.value, language)}"
            yield f"{rate_name(act.gives, act.link + act.held)} = {value},  {term('held still', language)}"


class _Plan(Told[PlanDrawn]):
    def sums(self) -> Iterable[str]:
        return () if self.act.known else (f"{rate_name(self.act.rate, self.act.link)} = {plan_sum(self.act)}",)

    def lines(self, language: str) -> Iterator[str]:
        """``ω_3 = 30.00 mm × 0.25 (rad/s)/mm = 7.5 rad/s, clockwise``: read off the plan of a train."""
        act = self.act
        if not act.known:
            value = f"{bound(plan_sum(act))}{_turning(act.value, language)}" if act.value else "0"
            yield f"{rate_name(act.rate, act.link)} = {value}"


def rate_name(kind: str, link: str) -> str:
    """The letter of an angular rate with its link."""
    return f"${'ω' if kind == 'omega' else 'α'}_{{{link}}}$"


def alike(rates: Iterable[Rate], rate: Rate) -> list[str]:
    """Links that turn as another, blocks of pins left out."""
    return [
        other.link for other in rates if other.same_as == rate.link and other.value == rate.value
        and "/" not in other.link
    ]  # fmt: skip


def _turning(value: float, language: str) -> str:
    return "" if value == 0.0 else f",  {term('clockwise' if value < 0 else 'counter-clockwise', language)}"


# -- words -------------------------------------------------------------------------------------------------------------


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


Teller: TypeAlias = type[Told[Any]]

TOLD: Mapping[type, Teller] = {
    LaidOff: _LaidOff, FoundVector: _Found, DirectionLine: _Line, LinesMeet: _Meeting, Named: _Naming,
    Resultant: _Joining, Asked: _Asked, Carried: _Carried, ByImage: _Image, ImageSeen: _ImageSeen, ByRate: _ByRate,
    SeenByRate: _SeenByRate, MeasuredRate: _Measured, RateSeen: _Seen, AddedRate: _Added, HeldStill: _HeldStill,
    PlanDrawn: _Plan,
}  # fmt: skip
