"""Why an equation is as it is written: a sentence for each of its terms, and once the rule of the Coriolis term."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from graphkin.construction.mechanism_acts import PitchPoint, SpecialPoint
from graphkin.construction.polygon_acts import SeenFrom, TrialDrawn
from graphkin.construction.sheet import Equation, Sheet, Term
from graphkin.construction.strokes import Aid, Vector
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Pair
from graphkin.words import Phrase
from graphkin.words.written import pointing

__all__ = ["reasons"]


def reasons(sheet: Sheet, equation: Equation) -> list[Phrase]:
    """The reasons of one equation, each once."""
    terms = [term for side in equation.sides for term in side]
    found = dict.fromkeys(phrase for term in terms for phrase in _why(sheet, equation, term))
    found |= dict.fromkeys(phrase for term in terms if term.symbol.kind == "ak" for phrase in _coriolis(sheet, term))
    return list(found)


def _why(sheet: Sheet, equation: Equation, term: Term) -> Iterator[Phrase]:
    """What ties the point of a term to what it is meant relative to; of a term found before, in which step."""
    symbol = term.symbol
    of, to = symbol.of, symbol.to
    if of is None or (symbol.kind in ("ak", "ar") and to is None):
        return
    for ref in (of, to):
        if ref is not None and (links := _rolling_at(sheet).get(ref.point)):
            yield Phrase(f"why rolling {equation.diagram}", (ref.point, *links))
    step = _found_before(sheet, equation, term)
    if step:
        yield Phrase("why known", (symbol, step))
    elif to is None:
        yield from _of_a_point(sheet, symbol)
    elif to.point == of.point:
        slides = sheet.structure.slides
        guide = next((s for s in slides if s.pin == of.point and {of.link or s.a, to.link or s.b} & {s.a, s.b}),
                     next((s for s in slides if {of.link, to.link} == {s.a, s.b}), None))  # fmt: skip
        if guide is not None and symbol.kind in ("v", "ar"):
            yield _coincident(of, to, guide)
        elif symbol.kind == "an":
            yield Phrase("why curved", (of, to))
    elif symbol.kind in ("v", "an"):
        link = _shared(sheet, of, to)
        fixed = symbol.kind == "an" and to.point in sheet.scene.frame.points
        alone = not any(t.symbol == Symbol("at", of, to) for side in equation.sides for t in side)
        turning = "why turning evenly" if alone else "why turning parts"
        key = turning if fixed else "why rigid" if symbol.kind == "v" else "why rigid parts"
        yield Phrase(key, (of, to, link)) if link else Phrase("why centres", (of, to))


def _rolling_at(sheet: Sheet) -> Mapping[str, tuple[str, str]]:
    """The points at which links of a group roll on each other, with the links."""
    scene = sheet.scene
    coupled = {r.name for e in sheet.structure.elements for r in e.rolling}
    found = {c.name: c.links for c in scene.contacts if c.name in coupled}
    return found | {s.act.point: s.act.links for s in sheet.steps if isinstance(s.act, PitchPoint)}


def _found_before(sheet: Sheet, equation: Equation, term: Term) -> int:
    """The step that found a term with which an equation begins; 0 for a term that is drawn in it."""
    of, to = term.symbol.of, term.symbol.to
    apart = of is not None and to is not None and of.point == to.point and (
        _is_special(sheet, of) or _is_seen(sheet, to.link)
    )
    if term.size is not None or not (to is None or apart) or not (term.size_known and term.direction_known):
        return 0
    earlier = (
        s for s in sheet.steps
        if s.diagram == equation.diagram and s.equation != equation.number and not isinstance(s.act, TrialDrawn)
    )  # fmt: skip
    return next(
        (s.number for s in earlier for v in s.strokes if isinstance(v, Vector | Aid) and v.symbol == term.symbol), 0
    )


def _is_special(sheet: Sheet, ref: PointRef) -> bool:
    return any(isinstance(s.act, SpecialPoint) and s.act.point == ref.point for s in sheet.steps)


def _is_seen(sheet: Sheet, held: str) -> bool:
    """Whether a link is held still, and others are seen from it."""
    return any(isinstance(s.act, SeenFrom) and s.act.held == held for s in sheet.steps)


def _coincident(of: PointRef, to: PointRef, slide: Pair) -> Phrase:
    """Two points that coincide under a sliding pair, or under a pin in a slot, of which no link slides."""
    if slide.slot and slide.pin is not None:
        return Phrase("why in slot", (of, to, PointRef(slide.pin), slide.b))
    return Phrase("why coincident", (of, to, slide.a, slide.b))


def _of_a_point(sheet: Sheet, symbol: Symbol) -> Iterator[Phrase]:
    """A point that a guide of the frame, or a fixed pivot, holds to its path."""
    of = symbol.of
    assert of is not None
    frame = sheet.scene.frame
    for slide in sheet.structure.slides:
        holder, body = (sheet.structure.links.get(name) for name in (slide.a, of.link))
        held = not of.link or of.link == slide.a or (body is not None and of.point in body.points)
        own = of.link == slide.a or (holder is not None and of.point in (slide.pin, *holder.points))
        if slide.b == frame.name and holder is not None and held and own:
            yield Phrase("why runs", (of,)) if slide.slot else Phrase("why guided", (of, slide.a))
            return
    for link in sheet.scene.links:
        pivot = next((p for p in link.points if p in frame.points), None)
        own = of.link == link.name or (not of.link and of.point in link.points)
        if own and pivot is not None and pivot != of.point and symbol.kind == "v":
            yield Phrase("why turning", (of, pivot, link.name))
            return
    under = next((s for s in sheet.structure.slides if s.pin == of.point and of.link in (s.a, s.b)), None)
    if under is not None and of.point in frame.points:
        other = PointRef(of.point, under.b if of.link == under.a else under.a)
        yield _coincident(of, other, under)


def _shared(sheet: Sheet, of: PointRef, to: PointRef) -> str:
    """The link that has both points; a special point belongs to the link that it was found for."""
    special = {s.act.point: s.act.link for s in sheet.steps if isinstance(s.act, SpecialPoint)}
    for ref in (of, to):
        if ref.point in special:
            return ref.link or special[ref.point]
    for link in sheet.scene.links:
        if all(ref.link == link.name or (not ref.link and ref.point in link.points) for ref in (of, to)):
            return link.name
    return next((ref.link for ref in (of, to) if ref.link), "")


def _coriolis(sheet: Sheet, term: Term) -> Iterator[Phrase]:
    """The rule, and its sense from the two arrows: the sliding velocity and the turning of the guide."""
    symbol = term.symbol
    moving = sheet.vectors("velocity")
    slip = moving.get(Symbol("v", symbol.of, symbol.to))
    if slip is None and symbol.to is not None and symbol.to.point in sheet.scene.frame.points:
        slip = moving.get(Symbol("v", symbol.of))  # relative to a point at rest
    drawn = sheet.vectors("acceleration").get(symbol)
    guide = next((s for s in sheet.structure.slides if symbol.of is not None and s.pin == symbol.of.point
                  and {symbol.of.link, symbol.to.link if symbol.to else ""} & {s.a, s.b}), None)  # fmt: skip
    if slip is None or drawn is None or guide is None or not slip.span or not drawn.span:
        return
    rate = sheet.omega.get(guide.b)
    if rate is None or not rate.value:
        return
    way = "counter-clockwise" if rate.value > 0 else "clockwise"
    angles = [pointing(v.span) for v in (slip, drawn)]
    first = next(s for s in sheet.vectors("acceleration") if s.kind == "ak")
    key = f"coriolis {'rule' if first == symbol else 'sense'} {way}"
    yield Phrase(key, (slip.symbol, guide.b, angles[0], angles[1], symbol))
