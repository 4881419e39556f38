"""The account of a polygon: each step from a lettered point, in a sense, to a lettered point; rates with their
quotients; trial polygons with their gaps and the division."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from graphkin.account.arithmetic import (
    bound,
    divisions,
    laid_sum,
    plan_sum,
    rate_sum,
    rule_sum,
    scale_of,
    trials_of,
)
from graphkin.account.headings import number, term
from graphkin.account.notation import unit_of
from graphkin.account.voice import SAME, Telling, numbered
from graphkin.construction.board.sheet import Rate
from graphkin.construction.board.steps import (
    GIVEN,
    ROLES,
    Bar,
    PointNames,
    Ray,
    Reason,
    Size,
    Term,
    Vector,
    end_of,
)
from graphkin.plane import dot
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Neutral, Phrase, joined, languages, listed, sense_of
from graphkin.words.symbols import RichText, Words, rate, sign, spaced
from graphkin.words.written import MOST, amount, on_paper, pointing, printed, quotient, roman, true_minus

SEEN = 0.005  # mm on paper: less than that is not taken off
ON_THE_POINT = 1e-9  # of a bar: so near to its end a point divides nothing
RATIOS = "part", "whole", "ratio", "ratio_a", "ratio_b"


@dataclass(frozen=True, eq=False, repr=False)
class InPolygon(Telling):
    """A step of a polygon.  In the gaps of its sentences a, b are the letters of the given end points, c of the found
    one; A, B, C are the points of the link."""

    def gap(self, name: str) -> object:
        """The value of a gap by its name; None without a value."""
        if set(name) <= set("abcABC"):
            return self._lettered(name)
        return self._ratios[name] if name in RATIOS else super().gap(name)

    def _lettered(self, names: str) -> RichText | None:
        """Several points side by side; None where one has no letter."""
        letters = [letter for name in names if (letter := self._letter(name)) is not None]
        return RichText(*letters) if len(letters) == len(names) else None

    def _letter(self, name: str) -> RichText | None:
        refs = self.step.ref if name in "cC" else self.step.refs["abAB".index(name) % 2]
        account = self.account
        return account.end_of(self.step.diagram, refs) if name.islower() else account.letters.point(refs.point)

    # the letters between which a step goes

    @cached_property
    def drawn(self) -> Vector | None:
        """The vector of a step; vectors of trial polygons have no letters."""
        return next((s for s in self.step.each(Vector) if not s.trial), None)

    @cached_property
    def places(self) -> tuple[complex, complex] | None:
        """The places where its vector begins and ends (mm); of a line, a place on it."""
        if self.drawn is not None:
            return self.drawn.tail, self.drawn.tip
        bars = ((s.a, s.b) for s in self.step.each(Bar))
        rays = ((s.through, s.through) for s in self.step.each(Ray))
        return next(bars, next(rays, None))

    @property
    def begin(self) -> RichText | None:
        """The letter at its beginning."""
        return self.account.end_at(self.step.diagram, self.places and self.places[0])

    @property
    def end(self) -> RichText | None:
        """The letter at its end."""
        return self.account.end_at(self.step.diagram, self.places and self.places[1])

    @property
    def ends(self) -> RichText | None:
        """A vector by the letters of its ends, ``pb``; None where the convention has no letters, and for a vector so
        small that both ends have one letter."""
        begin, end = self.begin, self.end
        return None if begin is None or end is None or begin == end else begin + end

    @property
    def start(self) -> Phrase | None:
        """The beginning of a vector: a letter, or the end of a vector."""
        if self.places is None:
            return None
        if self.begin is not None:
            return Phrase("the pole" if abs(self.places[0]) < SAME else "the point", point=self.begin)
        before = self._before(None)
        return Phrase("the end of", vector=before) if before else None

    @property
    def sides(self) -> tuple[tuple[Term, ...], ...]:
        """The sides of the equation of a step."""
        return self.sheet.equations[self.step.equation - 1].sides if self.step.equation is not None else ()

    @property
    def before(self) -> Symbol | None:
        """The vector from whose end a line goes; None at the pole."""
        return None if self.places is None or abs(self.places[0]) < SAME else self._before(self.step.symbol)

    def _before(self, symbol: Symbol | None) -> Symbol | None:
        """The vector at whose end this begins: that before it in the equation as written, else the last drawn."""
        drawn: dict[Symbol, complex] = {}
        for earlier in self.sheet.before(self.step):
            for stroke in earlier.strokes if earlier.diagram == self.step.diagram else ():
                if isinstance(stroke, Bar) and earlier.reason == "before its turn":
                    drawn[earlier.symbol] = stroke.b
                elif isinstance(stroke, Vector):
                    drawn[stroke.symbol] = stroke.tip
        assert self.places is not None
        there = [s for s, tip in drawn.items() if abs(tip - self.places[0]) < SAME]
        for side in self.sides if symbol is not None else ():
            terms = [term.symbol for term in side]
            if symbol in terms[1:] and terms[terms.index(symbol) - 1] in there:
                return terms[terms.index(symbol) - 1]
        return there[-1] if there else None

    # vectors

    @property
    def length(self) -> str | None:
        """The length of its vector (mm); None without a vector."""
        return on_paper(self.step.mm) if self.step.mm and self.places is not None else None

    @property
    def rule(self) -> Phrase:
        """A vector with the rule of its size, where that is not just given."""
        key = {"normal": "as normal", "coriolis": "as Coriolis"}.get(self.step.reason, "as vector")
        return Phrase(key, vector=_ruled(self.step.symbol, self.step.size))

    @property
    def way(self) -> object:
        """Its direction with its sense, unless its name contains it."""
        direction = self.step.direction
        if direction.relation == "towards" or self.places is None:
            return direction
        angle = pointing(self.places[1] - self.places[0])
        if direction.names:
            return Phrase("pointing", direction=direction, angle=angle)
        return Phrase("pointing only", angle=angle)

    @property
    def nought(self) -> str | None:
        """The key of the sentence on a known vector without length."""
        return "zero vector" if self.places and self.start and abs(self.places[1] - self.places[0]) < SAME else None

    @property
    def what(self) -> object:
        """The vector on a line, or the sum of the vectors of its side with unknown sizes along it."""
        symbol = self.step.symbol
        side = next((side for side in self.sides if any(t.symbol == symbol for t in side)), ())
        along = next((t.direction for t in side if t.symbol == symbol), None)
        unknown: list[object] = [t.symbol for t in side if not t.size_known and t.direction == along]
        return joined("sum", unknown or [symbol])

    @property
    def pole(self) -> str | None:
        """Whether a line goes through the pole, as part of a key."""
        return "pole" if self.places is not None and abs(self.places[0]) < SAME else None

    def _laid_off(self) -> Phrase | None:
        phrase, why = self.first("lay off lettered", "lay off from"), self._carried_over()
        return phrase if why is None else Phrase("in turn", first=phrase or self.step.phrase, second=why)

    def _carried_over(self) -> Phrase | None:
        """The source of a vector between points of two links that is carried over from the motion seen from a held
        link; an acceleration with the Coriolis term of the held link's turning."""
        step = self.step
        of, to = step.symbol.of, step.symbol.to
        if step.size is not None or step.mm == 0.0 or of is None or step.direction.names:
            return None
        before = self.sheet.before(step)
        held = {s.held for s in before if s.reason == "seen from"}
        kind = step.symbol.kind[0]
        gives = (s.symbol for s in reversed(before)
                 if s.reason in ("vector", "pole to end") or s.begins)
        seen = next((
            symbol for symbol in gives if symbol.kind == kind and symbol.of is not None and symbol.to is not None
            and symbol.to.link in held and symbol.of.point == symbol.to.point == of.point
        ), None)
        if seen is None or seen.to is None:
            return None
        against = of.link == seen.to.link
        vector = Phrase("against", vector=seen) if against else seen
        if kind == "v" or to is None or not against:
            return Phrase("written carried over", symbol=step.symbol, vector=vector)
        slip = next(s.symbol for s in before if s.verb == "lay off" and s.symbol.of == of and s.symbol.kind == "v")
        size = Size("rate", (seen.to.link, to.link), slip, twice=True)
        turning = self.sheet.rates["omega"][seen.to.link].value - self.sheet.rates["omega"][to.link].value
        rule = Phrase("rule of size", symbol=size, rule=bound(rule_sum(self.sheet, size, "acceleration")))
        gaps = {"symbol": step.symbol, "vector": vector, "rule": rule, "slip": slip, "sense": sense_of(turning)}
        return Phrase("written carried over coriolis", **gaps)

    def _laid_sums(self) -> Iterable[Words]:
        """The rule of a vector in numbers, and its length on paper."""
        step = self.step
        if step.reason == "before its turn" and (step.size is None or not step.mm):
            return ()
        if self.places is None or not step.mm:
            return self.measured()
        computed, on_scale = laid_sum(self.sheet, step.diagram, step.size, abs(self.places[1] - self.places[0]))
        return self.account.letters.vector(step.symbol) + f" = {computed}", on_scale

    # images

    @property
    def on_link(self) -> tuple[complex, complex, complex] | None:
        """The places on the link of an end point and of the points from which it is found (mm)."""
        a, b, c = (self.sheet.points.get(PointRef(ref.point)) for ref in (*self.step.refs, self.step.ref))
        return None if a is None or b is None or c is None or abs(b - a) < SAME else (a, b, c)

    @property
    def where(self) -> str | None:
        """The place of a point on the line of a bar: between its ends or beyond one."""
        if self.on_link is None:
            return None
        a, b, c = self.on_link
        along = dot(c - a, b - a) / abs(b - a) ** 2
        if abs(along) < ON_THE_POINT:
            return None
        return "before" if along < 0.0 else "within" if along <= 1.0 else "beyond"

    @property
    def _ratios(self) -> Mapping[str, str | None]:
        """A part of a bar, the bar, and their ratio as written; the sides of a triangle at a and b over the side
        between these."""
        if self.on_link is None:
            return dict.fromkeys(RATIOS)
        a, b, c = self.on_link
        unit = self.sheet.scales.length / self.sheet.scene.units.metres
        part, whole = (amount(abs(z - a) * unit, 4) for z in (c, b))
        sides = (number(abs(c - z) / abs(b - a), 4) for z in (a, b))
        texts = printed(part), printed(whole), printed(quotient(part, whole, 4)), *sides
        return dict(zip(RATIOS, texts, strict=True))

    @property
    def _one_place(self) -> bool:
        """Whether the image of a bar is one point, as of a link that does not turn."""
        a, b = (self.sheet.ends[self.step.diagram].get(ref) for ref in self.step.refs)
        return a is not None and b is not None and on_paper(abs(b - a)) == on_paper(0.0)

    def _image(self) -> Phrase | None:
        if self.step.held:
            return None
        if self._one_place:
            return self.first("image in one place lettered", "image in one place")
        if self.step.reason == "division":
            return self.first("division lettered {where}", "division {where}")
        return self.first("image with sides", "image lettered")

    def _image_lines(self, language: str) -> Iterator[Words | Phrase]:
        """``△bce ∼ △BCE``, or ``pm : pd = AM : AD`` for a point between others; where a convention has no end points
        the vector with the similar figure of the link, none for a vector that is not drawn."""
        step, on_line = self.step, self.step.reason == "division"
        if step.held:
            yield Phrase("written image seen", vector=step.symbol, link=step.link)
        elif self._one_place and self._lettered("abc"):
            yield bound(self._side_by_side(" = ", "a", "b", "c"))
        elif self._lettered("abc") is None:
            vector = Symbol("v" if step.diagram == "velocity" else "a", step.ref)
            if self.account.letters.convention == "us" and vector in self.sheet.vectors[step.diagram]:
                similar = self._side_by_side(" : ", "AC", "AB") if on_line else self._side_by_side("△", "", "ABC")
                named = Phrase("written image named", vector=vector, link=step.link, points=Neutral(similar))
                yield from map(bound, self.account.in_each(named, language))
        elif on_line:
            image, bar = (self._side_by_side(" : ", *names) for names in (("ac", "ab"), ("AC", "AB")))
            yield bound(image + " = " + bar)
        else:
            yield bound(self._side_by_side("△", "", "abc") + self._side_by_side(" ∽ △", "", "ABC"))

    def _side_by_side(self, between: str, *names: str) -> RichText:
        """Lettered points or bars with a sign between each two."""
        return spaced(between, (self._lettered(some) or "" for some in names))

    @property
    def parts(self) -> list[tuple[Term, complex]]:
        """The parts that the rates of a link give, each with its vector (mm)."""
        return [(part, part.span) for part in self.step.by_rates if part.span is not None]

    @property
    def laid(self) -> object:
        """The path to an end point from another of its link: the parts by the rates, laid off in order."""
        start = end_of(self.step.begins[0]) if self.step.held else Phrase("the point", point=self.gap("a"))
        if not self.step.held and self.gap("a") is None:
            return None
        phrases = list[Phrase]()
        for part, span in self.parts:
            normal = part.symbol.kind == "an"
            rule = Phrase("as normal" if normal else "as vector", vector=_ruled(part.symbol, part.size))
            direction = part.direction if normal else Phrase("pointing", direction=part.direction, angle=pointing(span))
            phrases.append(Phrase("lay off from", start=start, rule=rule, length=on_paper(abs(span)), way=direction))
            start = Phrase("the end of", vector=part.symbol)
        return joined("in turn", phrases) if phrases else None

    def _by_rates_sums(self) -> Iterator[Words]:
        """The parts of a relative vector that follow from the rates of a link, each with its length and direction."""
        per, unit = scale_of(self.sheet, self.step.diagram), unit_of(self.sheet, self.step.diagram).written
        for said, (_, span) in zip(self._by_rates_lines(""), self.parts, strict=True):
            yield said
            yield f"÷ {number(per)} ({unit})/mm = {printed(on_paper(abs(span)))} mm,  {pointing(span)}°"
        yield from self.measured()

    def _by_rates_lines(self, language: str) -> Iterator[RichText]:
        """``v_CB = ω_3 l_CB = 1.4737 × 151.21 = 222.84 mm/s,  ⊥CB``."""
        letters = self.account.letters
        for part, _ in self.parts:
            assert part.size is not None
            direction = letters.direction(part.direction, self.sheet.scene.frame.name)
            value = bound(rule_sum(self.sheet, part.size, self.step.diagram))
            rule = spaced(" =\u00a0", (self.account.letters.vector(part.symbol), letters.size(part.size), value))
            yield rule + ",  " + direction

    # rates

    @property
    def turning_links(self) -> tuple[str, ...]:
        """The links with the same rate, as its indices."""
        step, rates = self.step, self.sheet.rates[self.step.kind]
        return (step.link + step.held,) if step.held else (step.link, *alike(rates.values(), rates[step.link]))

    def _rate_sums(self) -> Iterable[Words]:
        step = self.step
        value = rate_sum(self.sheet, step) or f"{number(abs(step.value), MOST)} {step.unit}"
        return (rate(step.kind, self.turning_links[0]) + f" = {value}",)

    def _rate_lines(self, language: str) -> Iterator[RichText]:
        """``ω_4 = ω_3 = v_A4 / l_AO4 = 0.74 rad/s, clockwise``: the quotient of a vector and a bar."""
        step, rates = self.step, self.sheet.rates[self.step.kind]
        value = step.value if step.held else rates[step.link].value
        rule = self.account.letters.vector(step.symbol) + " / " + self.account.letters.length(step.points)
        shown = bound(rate_sum(self.sheet, step, units=False)) or f"{number(abs(value), 5)} {step.unit}"
        names = (rate(step.kind, name) for name in self.turning_links)
        yield spaced(" =\u00a0", (*names, rule, shown)) + _turning(value, language)

    def _held_still_lines(self, language: str) -> Iterator[RichText]:
        """``ω_32 = 0.1437 rad/s, clockwise, drawn apart, with one link held still``."""
        step = self.step
        if step.kind in ("omega", "alpha"):
            value = f"{number(abs(step.value), 5)} {step.unit}{_turning(step.value, language)}"
            yield rate(step.kind, step.link + step.held) + f" = {value},  {term('held still', language)}"

    def _plan_lines(self, language: str) -> Iterator[RichText]:
        """``ω_3 = 30.00 mm × 0.25 (rad/s)/mm = 7.5 rad/s, clockwise``: read from the plan of a train."""
        step = self.step
        value = bound(plan_sum(step)) + _turning(step.value, language) if step.value else "0"
        yield rate(step.kind, step.link) + " = " + value

    def _summed_lines(self, language: str) -> Iterator[RichText]:
        """``ω_5 = ω_2 = ω_3 + ω_23 = −0.04162 + 0.08323 = 0.04161 rad/s``: of a link with a known rate relative to a
        link of known rate, and of links that slide on it."""
        others = (rate(self.step.kind, name) for name in self.turning_links[:0:-1])
        yield spaced(" = ", (*others, bound(self.account.say(self.step.phrase, languages(language)[0]))))

    # trial polygons

    def _trial(self) -> Phrase:
        """A trial polygon: its steps, and in the first its reason."""
        step = self.step
        # the steps by which it is drawn like the true polygon
        assumed = {aid.symbol for aid in step.auxiliary}
        later = [s for s in self.sheet.steps[step.number :] if s.diagram == step.diagram]
        first = next(s.number for s in later if s.reason == "open ends") + 1
        drawn = (s for s in later if s.number >= first and any(getattr(x, "symbol", 0) in assumed for x in s.strokes))
        last = max((s.number for s in drawn), default=first)
        rates = listed([
            Phrase("rate is", symbol=symbol, value=true_minus(number(value, 5)), unit=self._unit(symbol))
            for symbol, value in step.rates
        ])
        trial = Phrase("trial lettered", trial=sign(roman(step.trial)), rates=rates, first=first, last=last)
        if step.trial > 1:
            return trial
        if step.far is None:
            return Phrase("superposed since none", reason=trial)
        angle, away = number(math.degrees(step.far.crossing), 2), f"{step.far.away / self.sheet.scales.length:.0f}"
        first_link, second_link = step.far.links
        crossing = {"first": first_link, "second": second_link, "angle": angle, "distance": away}
        return Phrase("superposed since far", reason=trial, **crossing)

    def _superposed(self) -> Phrase:
        """The gaps of the trials, measured from letter to letter, and the proportional division in numbers."""
        divided = self.step
        rows = numbered([true_minus(on_paper(mm)) for mm in row] for row in divided.apart)
        quotients = divisions(self.sheet, divided)
        rates = listed([
            Phrase("rate is", symbol=symbol, value=quotient.value, unit=self._unit(symbol))
            for (symbol, _), quotient in zip(divided.rates, quotients, strict=True)
        ])
        if len(quotients) > 1:
            parts = listed([quotient.part for quotient in quotients])
            return Phrase("superposed several", between=self._left_open(), open=rows, parts=parts, rates=rates)
        return Phrase("superposed one", between=self._left_open(), open=rows, sum=quotients[0].terms, rates=rates)

    def _superposed_lines(self, language: str) -> Iterator[Phrase]:
        """The measured gaps, ``I: ω_3 = 0.2 rad/s; open 3.21 mm``, a line for each trial, and the proportional
        division.
        """
        divided, symbol = self.step, self.account.letters.vector
        trials = trials_of(self.sheet, divided)
        numerals = [sign(roman(trial.trial)) for trial in trials]
        closing = listed([
            Phrase("open pair", pair=name) if "/" in name else Phrase("open link", link=name)
            for name in divided.closing
        ])
        yield Phrase("written trials", trials=listed(numerals), left_out=closing, open=self._left_open())
        for trial, mark, row in zip(trials, numerals, divided.apart, strict=True):
            rates = spaced(", ", (symbol(s) + f" = {number(v, 5)} {self._unit(s)}" for s, v in trial.rates))
            gaps = listed([printed(on_paper(mm)) for mm in row])
            yield Phrase("written trial polygon", trial=mark, rates=Neutral(rates), open=gaps)
        quotients = divisions(self.sheet, divided)
        said = Neutral(spaced("; ", (
            bound(symbol(s) + f" = {division.terms} = {division.value} {self._unit(s)}")
            for (s, _), division in zip(divided.rates, quotients, strict=True)
        )))
        if len(quotients) > 1:
            parts = listed([division.part for division in quotients])
            first, others = sign(roman(1)), listed(numerals[1:])
            yield Phrase("written superposed several", parts=parts, first=first, others=others, rates=said)
        else:
            yield Phrase("written superposed", rates=said)

    def _left_open(self) -> object:
        """The gaps, by their end points and directions."""
        gaps, divided = [], self.step
        for direction, refs, less in zip(divided.ways, divided.between, divided.less, strict=True):
            begin, end = (
                self.account.end_of(self.step.diagram, ref)
                or Phrase("point on link", point=PointNames((ref.point,)), link=ref.link)
                for ref in refs
            )
            across, names = "square" if direction.relation == "square" else "along", tuple(ref.point for ref in refs)
            if names[0] != names[1] or (direction.names == names and not refs[0].link + refs[1].link):
                first, second = (PointNames((name,)) for name in names)
                said = Phrase(f"open {across} bar", begin=begin, end=end, first=first, second=second)
            else:
                said = Phrase(f"open {across} guide", begin=begin, end=end, guide="".join(direction.names))
            for vector, mm in less:
                if abs(mm) >= SEEN:
                    size, symbol = vector.size, vector.symbol
                    rule = symbol if size is None else Phrase("rule of size", symbol=symbol, rule=size)
                    said = Phrase("open less", between=said, rule=rule, length=true_minus(on_paper(mm)))
            gaps.append(said)
        return listed(gaps)

    def _unit(self, symbol: Symbol) -> str:
        return symbol.unit(self.sheet.scene.units).written

    sentences: ClassVar[Mapping[Reason, tuple[str, ...] | Callable[[InPolygon], Phrase | None]]] = {
        **dict.fromkeys(ROLES, _laid_off), "vector": ("found lettered",),
        "direction": (
            "direction from {pole}", "direction from lettered end", "direction from end", "direction from point"
        ),
        "lines": ("meet in",), "letter": ("name letter",), "pole to end": ("{nought}", "join"),
        "asked": ("asked lettered",),
        "before its turn": ("{nought}", "carry lettered", "carry from"), "similar": _image, "division": _image,
        "rates": lambda told: told.first("ends seen" if told.step.held else "ends in"),
        "polygon": _trial, "open ends": _superposed,
    }
    arithmetic: ClassVar[Mapping[Reason, Callable[[InPolygon], Iterable[Words]]]] = {
        **dict.fromkeys((*ROLES, "before its turn"), _laid_sums), "rates": _by_rates_sums, "rate": _rate_sums,
        "plan": lambda told: [rate(told.step.kind, told.step.link) + f" = {plan_sum(told.step)}"],
    }
    lines: ClassVar[Mapping[Reason, Callable[[InPolygon, str], Iterable[Words | Phrase]]]] = {
        **dict.fromkeys(ROLES, lambda told, language: filter(None, [told._carried_over()])),
        "similar": _image_lines, "division": _image_lines,
        "rates": _by_rates_lines, "rate": _rate_lines, "sum of rates": _summed_lines,
        "held still": _held_still_lines, "plan": _plan_lines, "open ends": _superposed_lines,
    }


def alike(rates: Iterable[Rate], turning: Rate) -> list[str]:
    """Links that turn as a link does, without blocks of pins."""
    return [
        other.link for other in rates if other.same_as == (turning.same_as or turning.link)
        and other.value == turning.value and other.link != turning.link and "/" not in other.link
    ]


def _turning(value: float, language: str) -> str:
    return "" if value == 0.0 else f",  {term('clockwise' if value < 0 else 'counter-clockwise', language)}"


def _ruled(symbol: Symbol, size: Size | None) -> Symbol | Phrase:
    """A vector with the rule of its size, where that is not just given."""
    return symbol if size is None or size == GIVEN else Phrase("rule of size", symbol=symbol, rule=size)
