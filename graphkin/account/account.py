"""The account of a construction, in any school and language: sentence, sums and lines of each step, and the reason of
each equation.

A step is told by its reason, in the tables of `InMechanism` and `InPolygon`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from graphkin.account.arithmetic import bound, factors_of, lengths_measured, rule_sum
from graphkin.account.in_mechanism import InMechanism
from graphkin.account.in_polygon import InPolygon, alike
from graphkin.account.notation import Notation
from graphkin.account.voice import Account, Telling
from graphkin.construction.board.sheet import Equation, Sheet
from graphkin.construction.board.steps import PointNames, Reason, Step, Term, Vector
from graphkin.scene.pairs import Pair
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, sense_of, word
from graphkin.words.symbols import RichText, rate, spaced
from graphkin.words.written import pointing


def telling(account: Account, step: Step) -> Telling:
    """The telling of a step."""
    return InMechanism(account, step) if step.diagram == "mechanism" else InPolygon(account, step)


def why(account: Account, equation: Equation, language: str) -> RichText:
    """The reasons of an equation, in sentences; empty without any."""
    sentences = (account.sentence(phrase, language) for phrase in reasons(account.sheet, equation))
    return spaced(word("between sentences", language), sentences)


# what is written to repeat it

SHARE_A_LINE: Collection[Reason] = ("similar", "division")
"""Reasons of steps that are written on in the line of the step before, where that is one of them."""
TAKEN_FROM_THE_MECHANISM: Collection[Reason] = ("special point", "pitch point")
WrittenLine = Equation | RichText
"""A vector equation, or a rule on one line."""


def written_lines(sheet: Sheet, letters: Notation, language: str) -> list[WrittenLine]:
    """The lines from which a construction can be repeated, in its order: lengths measured on the mechanism, each vector
    equation with its products in numbers, the angular rates as soon as they are known, and the lines of each step."""
    account = Account(sheet, letters)
    lines: list[WrittenLine] = []
    written: set[int] = set()
    lengths = [*lengths_measured(sheet, letters)]
    to_come = {s.point for s in sheet.placing(*TAKEN_FROM_THE_MECHANISM)}
    shared = False  # whether the next step may go on in the line of the one before
    for step in sheet.steps:
        if step.diagram != "mechanism":  # what is measured from the mechanism stands there by now
            ready = [length for length in lengths if to_come.isdisjoint(length[1])]
            lines += [bound(line) for *_, line in ready]
            lengths = [length for length in lengths if length not in ready]
        elif step.reason in TAKEN_FROM_THE_MECHANISM:
            to_come.discard(step.point)
        if step.equation is not None and step.equation not in written:
            written.add(step.equation)
            equation = sheet.equations[step.equation - 1]
            if step.diagram not in {line.diagram for line in lines if isinstance(line, Equation)}:
                lines += _shared_with_drivers(sheet, equation)
            if step.reason == "seen from":  # what the mark of vectors means that are seen from a held link
                lines += account.in_each(Phrase("written seen", link=step.held), language)
            lines.append(equation)
            lines += _products(sheet, equation, letters)
        new = [RichText(line) for line in telling(account, step).written(language)]
        before = [line for line in lines[len(lines) - len(new) :] if isinstance(line, RichText)]
        if shared and step.reason in SHARE_A_LINE and len(before) == len(new):
            del lines[len(lines) - len(new) :]
            new = [start + ";  " + line for start, line in zip(before, new, strict=True)]
        lines += new
        shared = step.reason in SHARE_A_LINE
    return lines


def _products(sheet: Sheet, equation: Equation, letters: Notation) -> list[RichText]:
    """``a^n_CB = 0.7396² × 383.14 = 209.58 mm/s²``: the sizes in an equation that follow from rates, in numbers, each
    once; an equation that is only a rule contains its own."""
    if rule_alone(sheet, equation):
        return []
    steps = [s for s in sheet.steps if s.equation == equation.number]
    laid_off = {s.symbol for s in steps if s.reason == "before its turn" or (s.verb == "lay off" and s.mm)}
    arithmetic = {
        term.symbol: rule_sum(sheet, term.size, equation.diagram)
        for side in equation.sides
        for term in side
        if term.symbol in laid_off and "0" not in factors_of(sheet, term.size)
    }
    said = [letters.vector(symbol) + " =\u00a0" + bound(text) for symbol, text in arithmetic.items() if text]
    return [spaced(";  ", said)] if said else []


def _shared_with_drivers(sheet: Sheet, equation: Equation) -> Iterator[RichText]:
    """``ω_2 = ω_1``: links that slide on a driven one turn as it does; not where its rate is a sum: that has a line."""
    kind = "omega" if equation.diagram == "velocity" else "alpha"
    rates = sheet.rates[kind]
    summed = {step.link for step in sheet.steps if step.reason == "sum of rates"}
    for turning in rates.values():
        if turning.vector is None and not turning.same_as and turning.value != 0.0 and turning.link not in summed:
            others = alike(rates.values(), turning)
            if others:
                yield spaced(" = ", (rate(kind, name) for name in (*others[::-1], turning.link)))


def rule_alone(sheet: Sheet, equation: Equation) -> bool:
    """Whether an equation is only the rule of a vector."""
    last = equation.sides[-1]
    known = len(last) == 1 and last[0].size_known and len(equation.sides) <= 2
    return known and last[0].symbol in sheet.vectors[equation.diagram]


# why an equation is as it is written


def reasons(sheet: Sheet, equation: Equation) -> list[Phrase]:
    """The reasons of one equation, each once."""
    terms = [term for side in equation.sides for term in side]
    phrases = dict.fromkeys(phrase for term in terms for phrase in _why(sheet, equation, term))
    phrases |= dict.fromkeys(phrase for term in terms if term.symbol.kind == "ak" for phrase in _coriolis(sheet, term))
    return list(phrases)


def _why(sheet: Sheet, equation: Equation, term: Term) -> Iterator[Phrase]:
    """The relation of a term's point to its reference point; of a term found before, its step."""
    symbol = term.symbol
    of, to = symbol.of, symbol.to
    if of is None or (symbol.kind in ("ak", "ar") and to is None):
        return
    rolling = {point: c.bodies for point, c in sheet.scene.contact_at.items() if c.rolling}
    rolling |= {s.point: (s.links[0], s.links[1]) for s in sheet.placing("pitch point")}
    for ref in (of, to):
        if ref is not None and (links := rolling.get(ref.point)):
            pitch = PointNames((ref.point,))
            yield Phrase(f"why rolling {equation.diagram}", point=pitch, first=links[0], second=links[1])
    step = _found_before(sheet, equation, term)
    if step:
        yield Phrase("why known", vector=symbol, step=step)
    elif to is None:
        yield from _of_a_point(sheet, symbol)
    elif to.point == of.point:
        guide = sheet.structure.slide(term.pair) if term.pair else None
        if guide is not None and symbol.kind in ("v", "ar"):
            yield _coincident(of, to, guide)
        elif symbol.kind == "an":
            yield Phrase("why curved", point=of, path=to)
    elif symbol.kind in ("v", "an"):
        fixed = symbol.kind == "an" and _rests(sheet, to)
        alone = not any(t.symbol == Symbol("at", of, to) for side in equation.sides for t in side)
        if term.link not in sheet.scene.whole.by_name:  # a bar that stands for a contact
            yield Phrase("why centres", point=of, other=to)
        elif fixed:
            turning = "why turning evenly" if alone else "why turning parts"
            yield Phrase(turning, point=of, pivot=to, link=term.link)
        else:
            yield Phrase("why rigid" if symbol.kind == "v" else "why rigid parts", point=of, other=to, link=term.link)


def _found_before(sheet: Sheet, equation: Equation, term: Term) -> int:
    """The step that found an equation's first term; 0 for a term drawn in it."""
    of, to = term.symbol.of, term.symbol.to
    by_hand = of is not None and to is not None and of.point == to.point and (
        of.point in sheet.special_points
        or any(s.reason == "seen from" and s.held == to.link for s in sheet.steps)
    )
    if term.size is not None or not (to is None or by_hand) or not (term.size_known and term.direction_known):
        return 0
    earlier = (
        s for s in sheet.steps
        if s.diagram == equation.diagram and s.equation != equation.number and s.reason != "polygon"
    )
    return next((s.number for s in earlier for v in s.each(Vector) if v.symbol == term.symbol), 0)


def _rests(sheet: Sheet, ref: PointRef) -> bool:
    """Whether a point is a pivot on the frame, not a point of a moving link over it."""
    return ref.point in sheet.scene.frame.points and (not ref.link or ref.link in sheet.scene.holders[ref.point])


def _coincident(of: PointRef, to: PointRef, slide: Pair) -> Phrase:
    """The reason for two points that coincide under a sliding pair, or at a pin in a slot, where no link slides."""
    if slide.higher:
        return Phrase("why in slot", point=of, other=to, pin=PointRef(slide.pin), link=slide.b)
    return Phrase("why coincident", point=of, other=to, block=slide.a, guide=slide.b)


def _of_a_point(sheet: Sheet, symbol: Symbol) -> Iterator[Phrase]:
    """The reason for a point that a guide of the frame, or a fixed pivot, holds to its path."""
    of = symbol.of
    assert of is not None
    frame = sheet.scene.frame
    for slide in sheet.structure.slides:
        holder, body = (sheet.structure.links.get(name) for name in (slide.a, of.link))
        held = not of.link or of.link == slide.a or (body is not None and of.point in body.points)
        on_slide = of.link == slide.a or (holder is not None and of.point in (slide.pin, *holder.points))
        if slide.b == frame.name and holder is not None and held and on_slide:
            yield Phrase("why runs", point=of) if slide.higher else Phrase("why guided", point=of, link=slide.a)
            return
    for link in sheet.scene.links:
        pivot = next(iter(sheet.scene.pivots(link.name)), None)
        on_link = of.link == link.name or (not of.link and of.point in link.points)
        if on_link and pivot is not None and pivot != of.point and symbol.kind == "v":
            yield Phrase("why turning", point=of, pivot=PointNames((pivot,)), link=link.name)
            return
    under = next((s for s in sheet.structure.slides if s.pin == of.point and of.link in (s.a, s.b)), None)
    if under is not None and of.point in frame.points:
        other = PointRef(of.point, under.b if of.link == under.a else under.body)
        yield _coincident(of, other, under)


def _coriolis(sheet: Sheet, term: Term) -> Iterator[Phrase]:
    """The rule, and its sense from the two arrows: the sliding velocity and the turning of the guide."""
    symbol = term.symbol
    moving = sheet.vectors["velocity"]
    slip = moving.get(Symbol("v", symbol.of, symbol.to))
    if slip is None and symbol.to is not None and _rests(sheet, symbol.to):
        slip = moving.get(Symbol("v", symbol.of))  # relative to a point at rest
    drawn = sheet.vectors["acceleration"].get(symbol)
    guide = sheet.structure.slide(term.pair) if term.pair else None
    if slip is None or drawn is None or guide is None or not slip.span or not drawn.span:
        return
    rate = sheet.rates["omega"].get(guide.b)
    if rate is None or not rate.value:
        return
    angles = [pointing(v.span) for v in (slip, drawn)]
    first = next(s for s in sheet.vectors["acceleration"] if s.kind == "ak")
    yield Phrase(
        "coriolis rule" if first == symbol else "coriolis sense", vector=symbol, angle=angles[1],
        slip=slip.symbol, slip_angle=angles[0], link=guide.b, sense=sense_of(rate.value),
    )
