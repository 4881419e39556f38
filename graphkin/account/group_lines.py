"""What a sheet writes of groups larger than a dyad, so that they can be drawn again from it alone: trial positions with
the way from point to point, special points, trial polygons with what is left open, links seen from a held one."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce

from graphkin.account.arithmetic import bound, divisions, rule_sum, trials_of
from graphkin.account.end_letters import EndLetters, Markup, names_in_letters
from graphkin.account.headings import number, written
from graphkin.account.notation import Letters
from graphkin.account.trial_words import moved_and_missed, numeral, told_in, what_is_open
from graphkin.construction.mechanism_acts import (
    ArcOnPath,
    CompassArcs,
    GuideThrough,
    GuideTouching,
    LinkPoints,
    PathDrawn,
    PathsCross,
    SlidToMeet,
    SpecialPoint,
    TrialPositions,
)
from graphkin.construction.polygon_acts import (
    AddedRate,
    ByImage,
    FoundVector,
    ImageSeen,
    LaidOff,
    Resultant,
    SeenByRate,
    SeenFrom,
    Superposed,
    polygon_phrase,
)
from graphkin.construction.sheet import Sheet, Step
from graphkin.construction.sizes import Direction, RateTimes
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Phrase, listed, say
from graphkin.words.written import in_markup, on_paper

__all__ = ["GroupLines", "carried_over"]


class _Set(str):
    """Words with their symbols between dollar signs already."""


@dataclass(frozen=True)
class GroupLines:
    """Writes the lines of one sheet in one convention and language."""

    sheet: Sheet
    letters: Letters
    language: str

    # -- the position -------------------------------------------------------------------------------------------------

    def position(self, step: Step, act: TrialPositions) -> str:
        """Trial positions: what is moved, how each point is found with it, what is missed, and where nothing is."""
        out, moved, rolled = (", ".join(n) for n in (act.left_out, act.driven, act.rolling))
        told = Phrase("written trial rolling", (moved, rolled)) if rolled else Phrase("written trial", (out, moved))
        parts: list[Phrase] = [told]
        table = act.table
        if table is not None:
            moved_words, missed = moved_and_missed(self.sheet, table)
            rows = [told_in(table, row) for row in table.trials]
            if len(table.moved) > 1:
                numbered = ([_Set(f"${numeral(i)}$ {row[k]}") for i, row in enumerate(rows, 1)] for k in (0, 1))
                values, misses = map(listed, numbered)
                parts += [Phrase("written tried", (moved_words, values)), Phrase("written missed", (missed, misses))]
            else:
                values = listed([row[0] for row in rows])
                parts.append(Phrase("written tried one", (moved_words, values, len(rows))))
                near = (table.before, table.before + 1)
                seen = listed([Phrase("written miss", (rows[i - 1][1], i)) for i in near])
                parts.append(Phrase("written missed", (missed, seen)))
            if table.divided:
                parts.append(Phrase("written fits", (told_in(table, table.divided[-1])[0],)))
        route = [*self._route(step)]
        if route:
            parts.insert(2, Phrase("written route", (listed([*map(_Set, route)]),)))
        return self._say(reduce(lambda one, other: Phrase("in turn", (one, other)), parts))

    def _route(self, placed: Step) -> Iterator[str]:
        """Each point with what it is found from: the link that it lies on, the centres of its arcs, its guide."""
        paths: dict[str, str] = {}
        arced: set[str] = set()
        for step in self.sheet.steps[self.sheet.steps.index(placed) + 1 :]:
            act = step.act
            if isinstance(act, TrialPositions) or step.diagram != "mechanism":
                return
            if isinstance(act, PathDrawn):
                paths[act.point] = self._guide(act.pair)
            elif isinstance(act, CompassArcs | ArcOnPath | PathsCross):
                arced.add(act.point)
                yield self._from(act.point, *self._ways(act, paths))
            elif isinstance(act, LinkPoints):
                new = [name for name in act.points if name not in arced]
                if new:
                    yield f"{self._points(new)} ({act.link})"
            elif isinstance(act, GuideThrough | GuideTouching):
                yield f"{self._guide(act.pair)} ({self._points((act.pivot, act.through))})"
            elif isinstance(act, SlidToMeet):
                yield self._from(act.point, self._guide(act.along), self._guide(act.until))

    def _ways(self, act: CompassArcs | ArcOnPath | PathsCross, paths: dict[str, str]) -> tuple[str, ...]:
        if isinstance(act, CompassArcs):
            return tuple(self._points([name]) for name in act.about)
        if isinstance(act, ArcOnPath):
            return self._points([act.about]), paths.get(act.point, "")
        return tuple(map(self._guide, act.pairs))

    def _guide(self, pair: str) -> str:
        """The guide of a sliding pair by its name, or by its pair."""
        name = next((s.guide.name for s in self.sheet.structure.slides if s.key == pair), "")
        return f"${in_markup(name)}$" if name else pair

    def _from(self, point: str, *ways: str) -> str:
        return f"{self._points([point])} ({', '.join(filter(None, ways))})"

    def _points(self, names: Sequence[str]) -> str:
        return ", ".join(f"${self.letters.point(name)}$" for name in names)

    def special(self, act: SpecialPoint) -> str:
        """Where a special point lies."""
        joints = map(Markup, map(self.letters.point, (act.point, *act.joints)))
        key = "written relative special" if act.base and not act.driven else "written special"
        told = Phrase(key, (*joints, act.base, act.link))
        return self._say(Phrase("written sliding leg", (told,)) if self.sheet.structure.slides else told)

    # -- the polygons -------------------------------------------------------------------------------------------------

    def trials(self, last: Step, act: Superposed) -> Iterator[str]:
        """What is measured, ``I: ω_3 = 0.2 rad/s; open 3.21 mm``, a line for each trial, and the proportional
        division."""
        units = {"omega": "rad/s", "alpha": "rad/s²", "v": f"{self.sheet.scene.units.rates.length}/s"}
        push = f"{self.sheet.scene.units.rates.length}/s²"

        def rates(found: Sequence[tuple[Symbol, float]]) -> str:
            return ", ".join(
                f"${self.letters.vector(s)}$ = {number(value, 5)} {units.get(s.kind, push)}" for s, value in found
            )

        trials = trials_of(self.sheet, last, act)
        opened = listed([what_is_open(last, act, i, self._ends) for i in range(len(act.ways))])
        numerals = listed([Markup(numeral(trial.number)) for trial in trials])
        yield self._say(Phrase("written trials", (numerals, ", ".join(act.closing), opened)))
        for trial, row in zip(trials, act.apart, strict=True):
            apart = ", ".join(written(on_paper(mm)) for mm in row)
            told = Markup(numeral(trial.number)), _Set(rates(trial.assumed)), apart
            yield self._say(Phrase("written trial polygon", told))
        sums = divisions(self.sheet, last, act)
        said = "; ".join(
            bound(f"${self.letters.vector(s)}$ = {one.terms} = {one.value} {units.get(s.kind, push)}")
            for (s, _), one in zip(act.found, sums, strict=True)
        )
        if len(sums) == 1:
            yield self._say(Phrase("written superposed", (_Set(said),)))
        else:
            others = listed([Markup(numeral(trial.number)) for trial in trials[1:]])
            parts = ", ".join(one.part for one in sums)
            yield self._say(Phrase("written superposed several", (parts, Markup(numeral(1)), others, _Set(said))))

    def seen_from(self, act: SeenFrom) -> str:
        """What the mark of vectors means that are seen from a held link."""
        return self._say(Phrase("written seen", (act.held,)))

    def added(self, act: AddedRate) -> str:
        """``ω_2 = ω_3 + ω_23 = −0.04162 + 0.08323 = 0.04161 rad/s``: a link whose turning relative to another is known,
        as soon as that one turns at a known rate."""
        return bound(re.sub(r"[ωα]_\{[^}]*\}", r"$\g<0>$", say(polygon_phrase(act), self.language)))

    def carried_over(self, step: Step, act: LaidOff) -> str | None:
        """``v_A3 = −v_A2A3``: what a polygon seen from a held link gives of two links."""
        told = carried_over(self.sheet, step, act)
        return None if told is None else self._say(told)

    def image(self, step: Step, act: ByImage | ImageSeen) -> str | None:
        """``△bce ∼ △BCE``, or ``pm : pd = AM : AD`` for a point between others; where a convention has no end points
        the vector with what is similar on the link, None for one that is not drawn."""
        if isinstance(act, ImageSeen):
            return self._say(Phrase("written image seen", (act.vector, act.link)))
        refs = (*act.between, act.point)
        ends = [self._ends.of(step.diagram, ref) for ref in refs]
        one, two, three = (self.letters.point(ref.point) for ref in refs)
        if None in ends:
            vector = Symbol("v" if step.diagram == "velocity" else "a", act.point)
            if self.letters.convention != "us" or vector not in self.sheet.vectors(step.diagram):
                return None
            alike = f"${one}{three}$ : ${one}{two}$" if act.on_line else f"△${one}{two}{three}$"
            return bound(self._say(Phrase("written image named", (vector, act.link, _Set(alike)))))
        a, b, c = (str(end) for end in ends)
        if act.on_line:
            return bound(f"${a}{c}$ : ${a}{b}$ = ${one}{three}$ : ${one}{two}$")
        return bound(f"△${a}{b}{c}$ ∽ △${one}{two}{three}$")

    # -- words --------------------------------------------------------------------------------------------------------

    @cached_property
    def _ends(self) -> EndLetters:
        return EndLetters(self.sheet, self.letters)

    def _say(self, phrase: Phrase) -> str:
        return say(phrase, self.language, self._show).replace("$$", "")  # two symbols side by side are one

    def _show(self, thing: object) -> str:
        if isinstance(thing, _Set):
            return thing
        if isinstance(thing, Markup):
            return f"${thing}$"
        if isinstance(thing, Symbol):
            return f"${self.letters.vector(thing)}$"
        if isinstance(thing, PointRef):
            return f"${self.letters.point(thing.point)}$"
        if isinstance(thing, Direction):
            return f"${self.letters.direction(thing, self.sheet.scene.frame.name)}$"
        if isinstance(thing, RateTimes):
            return f"${self.letters.size(thing)}$"
        names = names_in_letters(self.letters, str(thing))
        return in_markup(str(thing)) if names is None else ", ".join(f"${name}$" for name in names)


def carried_over(sheet: Sheet, step: Step, act: LaidOff) -> Phrase | None:
    """From what seen from a held link a vector between points of two links follows, which is laid off as it was found;
    an acceleration with the share of Coriolis that the turning of the other of them adds."""
    of, to = act.symbol.of, act.symbol.to
    if act.size is not None or act.is_zero or of is None or act.direction.names:
        return None
    before = sheet.steps[: sheet.steps.index(step)]
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
    turning = sheet.omega[seen.to.link].value - sheet.omega[to.link].value
    key = "written carried over coriolis cw" if turning < 0.0 else "written carried over coriolis ccw"
    rule = Phrase("rule of size", (size, bound(rule_sum(sheet, size, "acceleration"))))
    return Phrase(key, (act.symbol, told, rule, slip))


def _vector_of(act: object) -> Symbol | None:
    """The vector that an act gives."""
    if isinstance(act, FoundVector | Resultant):
        return act.symbol
    return act.vector if isinstance(act, ImageSeen | SeenByRate) else None
