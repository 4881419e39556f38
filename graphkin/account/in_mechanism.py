"""The account of the mechanism's position: each point with the lengths and the side by which ruler and compass find it;
trial positions of larger groups with the order of their points, and their division; special points.  A group can be
drawn again from the sheet alone."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import ClassVar

from graphkin.account.headings import number
from graphkin.account.voice import Telling, numbered
from graphkin.construction.board.steps import (
    FINDS_A_POINT,
    Bar,
    CompassArc,
    Mark,
    MeasuredGap,
    PointNames,
    Reason,
    TrialPositions,
    TrialRow,
)
from graphkin.plane import cross, degrees, dot, unit
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import Neutral, Phrase, clauses, joined, listed, sense_of
from graphkin.words.symbols import RichText, Words, sign, spaced
from graphkin.words.written import on_paper, roman, true_minus

SAME = 1e-6  # mm
STRAIGHT = 1e-6  # of a length: so little beside a line a point lies on it
IN_LINE = 1e-9  # rad, or of a length: so near to an axis or a guide its own points lie


@dataclass(frozen=True, eq=False, repr=False)
class InMechanism(Telling):
    """A step of the mechanism."""

    def at(self, point: str) -> complex | None:
        """The place of a point on paper (mm)."""
        return self.sheet.points.get(PointRef(point))

    @property
    def plain(self) -> Phrase:
        """The step without reference to its place on paper."""
        return self.step.phrase

    @property
    def places(self) -> object:
        """Fixed points and guides by their places on paper."""
        points = ((p, self.at(p)) for p in self.step.points)
        phrases = [Phrase("place of a point", point=_named(p), **_coordinates(z)) for p, z in points if z is not None]
        for guide in self.sheet.scene.frame.guides.values():
            if guide.name:
                through = guide.through / self.sheet.scales.length
                angle = _degrees(guide.direction)
                phrases.append(Phrase("place of a guide", guide=guide.name, angle=angle, **_coordinates(through)))
        return listed(phrases) if phrases else None

    @property
    def angle(self) -> str:
        """The angle at which a link is drawn (degrees)."""
        return true_minus(f"{math.degrees(self.step.value):.6g}")

    @property
    def base(self) -> str | None:
        """The link from which that angle is measured; None for the x axis."""
        return self.step.base or None

    # the points of a link

    def _link_points(self) -> Phrase | None:
        """Each new point of a link from its drawn points."""
        step, link = self.step, self.step.link
        points = self.sheet.structure.links[link].points if link in self.sheet.structure.links else {}
        before = [earlier for earlier in self.sheet.before(step) if earlier.diagram == "mechanism"]
        standing = {s.ref.point for earlier in before for s in earlier.each(Mark)}
        crossed = (earlier for earlier in before if earlier.reason in FINDS_A_POINT)
        crossings = {earlier.point for earlier in crossed} - standing  # on no link yet
        known = [p for p in points if p in standing]
        phrases: list[Phrase] = []
        for name in sorted(step.points, key=lambda p: p not in crossings):
            if name not in crossings:
                said = self._marked(known, name)
            else:
                said = Phrase("place alone", point=_named(name), link=link)
                if link not in self.sheet.scene.by_name:  # what only stands for a pin in a slot
                    said = Phrase("pin alone", point=_named(name))
                elif known:
                    said = Phrase("place joined", other=_named(known[0]), point=_named(name), link=link)
            if said is None:
                return None
            phrases.append(said)
            known.append(name)
        return joined("in turn", phrases) if phrases else None

    def _marked(self, known: list[str], name: str) -> Phrase | None:
        """A new point of a link by its known points, if there are any."""
        link, at = self.step.link, self.at(name)
        places = {p: z for p in known if (z := self.at(p)) is not None}
        if at is None:
            return None
        if not places:
            if link not in self.sheet.scene.by_name:  # what only stands for a pin in a slot
                return Phrase("pin by coordinates", point=_named(name), **_coordinates(at))
            return Phrase("place by coordinates", link=link, point=_named(name), **_coordinates(at))
        bars = [(p, q) for p in places for q in places if abs(places[p] - places[q]) > SAME]
        if bars:
            p, q = max(bars, key=lambda b: abs(places[b[0]] - places[b[1]]))
            a, b = places[p], places[q]
            side = cross(b - a, at - a)
            if abs(side) < STRAIGHT * abs(b - a) ** 2:
                return _on_line((p, a), (q, b), name, at)
            radii = {f"radii.{i}": on_paper(abs(at - z)) for i, z in enumerate((a, b))}
            points = {"points.0": _named(p), "points.1": _named(q), "point": _named(name)}
            return Phrase(f"place by arcs {'left' if side > 0 else 'right'}", **points, **radii)
        (pivot, start), *_ = places.items()
        guides = [s for s in self.sheet.placing("guide") if s.number < self.step.number]
        for s in reversed(guides):  # the pin that has directed a guide from its pivot
            if s.points[0] == pivot and link in s.pairs[0].split("/"):
                through = self.at(s.points[1])
                if through is None:
                    break
                return _along((pivot, start), (s.points[1], through), name, at)
        laid = any(s.reason == "angle" and s.link == link for s in self.sheet.before(self.step))
        span = at - start
        if abs(span) < SAME:
            return None
        on_link, laid_off = self.sheet.structure.links[link].points, {
            "point": _named(name), "bar": PointNames((pivot, name), bar=True), "length": on_paper(abs(span))
        }
        if laid and abs(cmath.phase(on_link[name] - on_link[pivot])) < STRAIGHT:
            return Phrase("points at", link=link, **laid_off)
        return Phrase("place polar", pivot=_named(pivot), angle=_degrees(span), **laid_off)

    # points that are found

    @property
    def side(self) -> str | None:
        """The side of the line between two points on which arcs cross, or the circles for a tangent."""
        first, second = map(self.at, self.step.points[:2])
        arcs = [s.at for s in self.step.each(CompassArc)]
        crossings = [self.at(self.step.point)] if self.step.reason == "arcs" else arcs
        if first is None or second is None or not crossings or crossings[0] is None or abs(second - first) < SAME:
            return None
        return "left" if cross(second - first, crossings[0] - first) > 0 else "right"

    @property
    def crossing(self) -> str | None:
        """The choice between the crossings of an arc with a straight path, as seen on the paper."""
        point, bars = self.step.point, [
            s.b - s.a for step in self.sheet.placing("path") if step.point == self.step.point
            for s in step.each(Bar) if abs(s.b - s.a) > SAME
        ]
        centre, at = self.at(self.step.points[0]), self.at(point)
        if centre is None or at is None or not bars:
            return None
        path = unit(bars[0])
        half = dot(at - centre, path) * path  # from the middle between the crossings
        if abs(half) < SAME:
            return None
        upright = abs(half.imag) > abs(half.real)
        return ("upper" if half.imag > 0 else "lower") if upright else ("right" if half.real > 0 else "left")

    def _special_lines(self, language: str) -> Iterator[Phrase]:
        """The place of the special point."""
        step = self.step
        joints = map(self.account.letters.point, (step.point, *step.points))
        key = "written relative special" if step.base and step.kind != "driven" else "written special"
        point, first, second = joints
        rule = Phrase(key, point=point, first=first, second=second, base=step.base, link=step.link)
        yield Phrase("written sliding leg", rule=rule) if self.sheet.structure.slides else rule

    # trial positions

    def _positions(self) -> Phrase | None:
        """Trial positions with the measured gaps of each, and the division."""
        table = self.step
        assert isinstance(table, TrialPositions)
        if not table.trials:
            return None
        moved, missed = self._moved_and_missed(table)
        values, misses = zip(*(self._row(table, row) for row in table.trials), strict=True)
        if len(table.moved) > 1:
            several = {"values": numbered(values), "misses": numbered(misses)}
            trials = Phrase("trial table several", moved=moved, missed=missed, **several)
            return Phrase("in turn", first=self.plain, second=self._divided_by_parts(table, trials))
        unit = "°" if table.missed[0].angle else " mm"
        measured = clauses([*(miss.removesuffix(unit) for [miss] in misses[:-1]), *misses[-1]])
        trials = Phrase("trial table", moved=moved, values=listed([*chain(*values)]), missed=missed, misses=measured)
        if table.divided:
            before = table.before
            of_two = (table.trials[i][1][0] for i in (before - 1, before))
            part, whole = (f"{abs(self._shown(miss, table.missed[0].angle)):.2f}" for miss in of_two)
            (first_values, first_misses), *rest = (self._row(table, row) for row in table.divided)
            trials = Phrase(
                "trial division", told=trials, first=before, second=before + 1, parts=part, whole=whole,
                values=listed(first_values), misses=listed(first_misses),
            )
            if rest:
                trials = Phrase("trial division again", told=trials, value=listed(rest[-1][0]))
        return Phrase("in turn", first=self.plain, second=trials)

    def _positions_lines(self, language: str) -> Iterator[Phrase]:
        """Trial positions: the moved quantity, the construction of each point, the gap, and the value that closes
        it."""
        trial = self.step
        assert isinstance(trial, TrialPositions)
        out, moved, rolled = map(listed, (trial.left_out, trial.driven, trial.rolling))
        fitted = Phrase("written trial", left_out=out, moved=moved)
        parts = [Phrase("written trial rolling", moved=moved, contact=rolled) if rolled else fitted]
        if trial.trials:
            moved_words, missed = self._moved_and_missed(trial)
            rows = [self._row(trial, row) for row in trial.trials]
            if len(trial.moved) > 1:
                both = ([Neutral(sign(roman(i)), " ", ", ".join(row[k])) for i, row in enumerate(rows, 1)]
                        for k in (0, 1))
                values, misses = map(listed, both)
                parts.append(Phrase("written tried", moved=moved_words, values=values))
                parts.append(Phrase("written missed", missed=missed, misses=misses))
            else:
                values = listed([*chain(*(row[0] for row in rows))])
                parts.append(Phrase("written tried one", moved=moved_words, values=values, trials=len(rows)))
                near = (trial.before, trial.before + 1)
                seen = listed([Phrase("written miss", misses=listed(rows[i - 1][1]), trial=i) for i in near])
                parts.append(Phrase("written missed", missed=missed, misses=seen))
            if trial.divided:
                parts.append(Phrase("written fits", values=listed(self._row(trial, trial.divided[-1])[0])))
        if route := [*self._route()]:
            parts.insert(2, Phrase("written route", route=listed([*map(Neutral, route)])))
        yield joined("in turn", parts)

    def _route(self) -> Iterator[RichText]:
        """Each point with its construction: its link, the centres of its arcs, its guide."""
        paths: dict[str, Words] = {}
        arced: set[str] = set()
        for step in self.sheet.steps[self.step.number :]:
            if step.diagram != "mechanism" or step.reason == "positions":
                return
            guides = [self._guide(pair) for pair in step.pairs]
            match step.reason:
                case "path":
                    paths[step.point] = guides[0]
                case "arcs" | "arc on path" | "paths" | "guide to point":
                    ends = [self._points([name]) for name in step.points]
                    along = [paths.get(step.point, "")] if step.reason == "arc on path" else []
                    arced |= {step.point} if step.reason != "guide to point" else set()
                    yield self._points([step.point]) + " (" + spaced(", ", filter(None, (*ends, *along, *guides))) + ")"
                case "points" | "whole link":
                    new = [name for name in step.points if name not in arced]
                    if new:
                        yield self._points(new) + f" ({step.link})"
                case "guide" | "tangent":
                    yield guides[0] + " (" + self._points(step.points) + ")"

    def _guide(self, pair: str) -> Words:
        """The guide of a sliding pair by its name, or by its pair."""
        name = next((s.guide.name for s in self.sheet.structure.slides if s.key == pair), "")
        return sign(name) if name else pair

    def _points(self, names: Sequence[str]) -> RichText:
        return spaced(", ", map(self.account.letters.point, names))

    def _divided_by_parts(self, table: TrialPositions, trials: Phrase) -> Phrase:
        """The divisions of trials that each moved another unknown."""
        for i, row in enumerate(table.divided):
            values, misses = map(listed, self._row(table, row))
            if i:
                replaced = sign(roman(table.replaced[i - 1]))
                trials = Phrase("trial parts again", division=trials, trial=replaced, values=values, misses=misses)
            else:
                steps = listed([sign(roman(k)) for k in range(2, len(table.trials) + 1)])
                parts = listed([*map(_two_digits, table.parts)])
                trials = Phrase("trial parts", division=trials, parts=parts, trials=steps, values=values, misses=misses)
        return trials

    def _row(self, table: TrialPositions, row: TrialRow) -> tuple[list[str], list[str]]:
        """The values of a trial, and its gaps, each with its unit."""
        values = [  # angles from -180 to 180
            f"{_two_digits(180.0 - (180.0 - math.degrees(v)) % 360.0)}°" if symbol.measure.is_angle
            else f"{_two_digits(self._shown(v))} mm" for v, symbol in zip(row[0], table.moved, strict=True)
        ]
        misses = [_two_digits(self._shown(miss, of.angle)) + ("°" if of.angle else " mm")
                  for miss, of in zip(row[1], table.missed, strict=True)]
        return values, misses

    def _shown(self, value: float, angle: bool = False) -> float:
        """An angle (rad) in degrees, or a length (m) in mm on paper."""
        return math.degrees(value) if angle else value / self.sheet.scales.length

    def _moved_and_missed(self, table: TrialPositions) -> tuple[Phrase, Phrase]:
        """All moved quantities of trial positions, and all gaps."""
        return joined("moved too", map(self._moved, table.moved)), joined("missed too", map(self._missed, table.missed))

    def _missed(self, missed: MeasuredGap) -> Phrase:
        """A measured gap: between the ends of a bar, from a guide, or of a list."""
        if missed.kind != "guide":
            ends = PointNames(missed.names, bar=True)
            named: object = ends if missed.kind == "bar" else listed(missed.names)
            return Phrase(f"missed {missed.kind}", names=named, length=on_paper(self._shown(missed.length)))
        *points, key = missed.names
        slide = self.sheet.structure.slide(key)
        # the outermost points on the guide, in its sense, else its name
        guide, places = slide.guide, self.sheet.structure.links[slide.b].points
        from_guide = {p: (z - guide.through) * guide.direction.conjugate() for p, z in places.items()}
        size = max(map(abs, from_guide.values()), default=0.0)
        on = sorted((along.real, p) for p, along in from_guide.items() if abs(along.imag) <= IN_LINE * size)
        name = PointNames((on[0][1], on[-1][1]), bar=True) if len(on) > 1 else guide.name
        off_guide = {"point": PointNames(tuple(points)), "link": slide.b}
        return Phrase("missed guide", **off_guide, guide=name) if name else Phrase("missed guide of link", **off_guide)

    def _moved(self, moved: Symbol) -> Phrase:
        """A moved quantity of trial positions: a travel, the angle of a link or of its bar, or the angle between
        two."""
        links = self.sheet.structure.links
        if moved.kind == "s":
            return Phrase("trial travel", slide=moved.pair)
        if not moved.other:
            points = links[moved.link].points.items()
            spans = (((p, q), w - z) for p, z in points for q, w in points if z != w)
            # a bar along the axis of the link
            bars = [bar for bar, span in spans if abs(cmath.phase(span)) < IN_LINE]
            if bars:
                return Phrase("trial angle of bar", link=moved.link, bar=PointNames(bars[0], bar=True))
            return Phrase("trial angle", link=moved.link)
        still, turning = links[moved.other], links[moved.link]
        hinge = next((p for p in still.points if p in turning.points), "")
        if len(still.bar) < 2 or len(turning.bar) < 2 or not hinge:
            return Phrase("trial turn", link=moved.link, base=moved.other)
        bar, base = (PointNames(link.bar[:2], bar=True) for link in (turning, still))
        return Phrase("trial turn of bars", link=moved.link, bar=bar, base=base, hinge=_named(hinge))

    sentences: ClassVar[Mapping[Reason, tuple[str, ...] | Callable[[InMechanism], Phrase | None]]] = {
        "frame": ("fixed on paper",), "angle": ("lay off angle from link", "lay off angle from x"),
        "points": _link_points, "whole link": _link_points, "arcs": ("place by arcs {side}",),
        "arc on path": ("crossing {crossing}",), "tangent": ("tangent {side}",), "positions": _positions,
    }
    lines: ClassVar[Mapping[Reason, Callable[[InMechanism, str], Iterable[Phrase]]]] = {
        "positions": _positions_lines, "special point": _special_lines,
    }


def _along(p: tuple[str, complex], q: tuple[str, complex], name: str, at: complex) -> Phrase:
    """A point of a bar with the direction of a line through its pivot: on the line, or at an angle to it."""
    (pivot, a), (_, b) = p, q
    if abs(at - a) < SAME or abs(cross(b - a, at - a)) < STRAIGHT * abs(b - a) * abs(at - a):
        return _on_line(p, q, name, at)
    turn = degrees((at - a) / (b - a))
    return Phrase(
        "place turned", pivot=_named(pivot), angle=number(abs(turn), 4), sense=sense_of(turn),
        base=PointNames((pivot, q[0]), bar=True), bar=PointNames((pivot, name), bar=True), length=on_paper(abs(at - a)),
        point=_named(name),
    )


def _on_line(p: tuple[str, complex], q: tuple[str, complex], name: str, at: complex) -> Phrase:
    (first, a), (second, b) = p, q
    along = dot(at - a, b - a) / abs(b - a) ** 2
    bar, part = (PointNames(ends, bar=True) for ends in ((first, second), (first, name)))
    gaps = {"bar": bar, "point": _named(name), "part": part, "length": on_paper(abs(at - a))}
    if 0.0 <= along <= 1.0:
        return Phrase("place within", **gaps)
    return Phrase("place beyond", **gaps, end=_named(first if along < 0.0 else second))


def _named(point: str) -> PointNames:
    return PointNames((point,))


def _coordinates(z: complex) -> dict[str, str]:
    return {k: true_minus(on_paper(mm if abs(mm) >= SAME else 0.0)) for k, mm in (("x", z.real), ("y", z.imag))}


def _degrees(direction: complex) -> str:
    return true_minus(number(round(degrees(direction), 2) + 0.0))


# trials in words


def _two_digits(value: float) -> str:
    """A number with two decimals, without a sign of zero."""
    return true_minus(f"{round(value, 2) + 0.0:.2f}")
