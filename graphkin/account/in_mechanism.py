"""Steps of the mechanism in its position as they are told: each point with the lengths and the side by which a ruler
and a compass find it; trial positions of larger groups with the way from point to point, and what is divided; special
points.  A group can be drawn again from the sheet alone."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import reduce

from graphkin.account.headings import number
from graphkin.account.voice import Voice
from graphkin.construction.sheet import Sheet
from graphkin.construction.steps import (
    FINDS_A_POINT,
    Bar,
    CompassArc,
    Mark,
    Missed,
    Moved,
    Reason,
    Step,
    TrialPositions,
    TrialRow,
    TrialTable,
)
from graphkin.plane import cross, dot, unit
from graphkin.scene.symbol import PointRef
from graphkin.structure import Pair
from graphkin.words import Markup, Neutral, Phrase, in_turn, listed
from graphkin.words.written import in_markup, on_paper, true_minus

__all__ = ["LINES", "SENTENCES", "numeral"]

SAME = 1e-6  # mm
STRAIGHT = 1e-6  # of a length: so little beside a line a point lies on it
IN_LINE = 1e-9  # rad, or of a length: so near to an axis or a guide its own points lie
NUMERALS = "I", "II", "III", "IV", "V"


def _at(sheet: Sheet, point: str) -> complex | None:
    return sheet.points.get(PointRef(point))


def _fixed(voice: Voice, step: Step) -> Phrase | None:
    """Fixed points and guides by their places on paper."""
    sheet = voice.sheet
    places = [(p, _at(sheet, p)) for p in step.points]
    told = [Phrase("place of a point", (p, *_coordinates(z))) for p, z in places if z is not None]
    for guide in sheet.scene.frame.guides.values():
        if guide.name:
            through = guide.through / sheet.scales.length
            angle = math.degrees(cmath.phase(guide.direction))
            told.append(Phrase("place of a guide", (guide.name, *_coordinates(through), _degrees(angle))))
    return Phrase("fixed on paper", (step.link, listed(told))) if told else None


def _angle(voice: Voice, step: Step) -> Phrase:
    key = "lay off angle from link" if step.base else "lay off angle from x"
    return Phrase(key, (step.link, true_minus(f"{math.degrees(step.value):.6g}"), step.point, step.base))


# -- the points of a link ----------------------------------------------------------------------------------------------


def _link_points(voice: Voice, step: Step) -> Phrase | None:
    """Each new point of a link from those that stand there already."""
    sheet, link = voice.sheet, step.link
    own = sheet.structure.links[link].points if link in sheet.structure.links else {}
    before = [one for one in sheet.before(step) if one.diagram == "mechanism"]
    standing = {s.ref.point for one in before for s in one.strokes if isinstance(s, Mark)}
    found = {one.point for one in before if one.reason in FINDS_A_POINT} - standing  # on no link yet
    known = [p for p in own if p in standing]
    told: list[Phrase] = []
    for name in sorted(step.points, key=lambda p: p not in found):
        if name not in found:
            said = _marked(sheet, step, known, name)
        else:
            said = Phrase("place joined", (known[0], name, link)) if known else Phrase("place alone", (name, link))
        if said is None:
            return None
        told.append(said)
        known.append(name)
    return in_turn(told) if told else None


def _marked(sheet: Sheet, step: Step, known: list[str], name: str) -> Phrase | None:
    """A new point of a link by its known points, as far as there are some."""
    link, at = step.link, _at(sheet, name)
    places = {p: z for p in known if (z := _at(sheet, p)) is not None}
    if at is None:
        return None
    if not places:
        if link not in sheet.scene.by_name:  # what only stands for a pin in a slot
            return Phrase("pin by coordinates", (name, *_coordinates(at)))
        return Phrase("place by coordinates", (link, name, *_coordinates(at)))
    bars = [(p, q) for p in places for q in places if abs(places[p] - places[q]) > SAME]
    if bars:
        p, q = max(bars, key=lambda b: abs(places[b[0]] - places[b[1]]))
        a, b = places[p], places[q]
        if abs(cross(b - a, at - a)) < STRAIGHT * abs(b - a) ** 2:
            return _on_line((p, a), (q, b), name, at)
        return _from_arcs((p, q), (abs(at - a), abs(at - b)), name, cross(b - a, at - a))
    (pivot, start), *_ = places.items()
    through = _guide_through(sheet, step, pivot)
    if through is not None:
        return _along((pivot, start), through, name, at)
    laid = any(s.reason == "angle" and s.link == link for s in sheet.before(step))
    span = at - start
    if abs(span) < SAME:
        return None
    own = sheet.structure.links[link].points
    if laid and abs(cmath.phase(own[name] - own[pivot])) < STRAIGHT:
        return Phrase("points at", (link, name, pivot + name, on_paper(abs(span))))
    angle = _degrees(math.degrees(cmath.phase(span)))
    return Phrase("place polar", (pivot, angle, pivot + name, on_paper(abs(span)), name))


def _guide_through(sheet: Sheet, step: Step, pivot: str) -> tuple[str, complex] | None:
    """The pin that has directed a link's guide from its pivot."""
    for s in reversed(sheet.before(step)):
        if s.reason == "guide" and s.points[0] == pivot and step.link in s.pairs[0].split("/"):
            at = _at(sheet, s.points[1])
            return (s.points[1], at) if at is not None else None
    return None


# -- points that are found ---------------------------------------------------------------------------------------------


def _arcs(voice: Voice, step: Step) -> Phrase | None:
    one, other, at = (_at(voice.sheet, p) for p in (*step.points, step.point))
    if one is None or other is None or at is None or abs(other - one) < SAME:
        return None
    return _from_arcs(step.points, step.radii, step.point, cross(other - one, at - one))


def _arc_on_path(voice: Voice, step: Step) -> Phrase | None:
    """Which of the crossings of an arc with a straight path is meant, as it is seen on the paper."""
    centre, at = (_at(voice.sheet, p) for p in (*step.points, step.point))
    bars = (
        s.b - s.a for one in voice.sheet.steps if one.reason == "path" and one.point == step.point
        for s in one.strokes if isinstance(s, Bar) and abs(s.b - s.a) > SAME
    )  # fmt: skip
    path = next(map(unit, bars), None)  # the direction of its straight path
    if centre is None or at is None or path is None:
        return None
    half = dot(at - centre, path) * path  # from the middle between the crossings
    if abs(half) < SAME:
        return None
    upright = abs(half.imag) > abs(half.real)
    side = ("upper" if half.imag > 0 else "lower") if upright else ("right" if half.real > 0 else "left")
    return Phrase(f"crossing {side}", (step.phrase,))


def _tangent(voice: Voice, step: Step) -> Phrase | None:
    """Which of the two tangents: the side of the crossing of its circles."""
    arcs = [s for s in step.strokes if isinstance(s, CompassArc)]
    one, other = (_at(voice.sheet, p) for p in step.points)
    if one is None or other is None or not arcs:
        return None
    side = "left" if cross(other - one, arcs[0].at - one) > 0 else "right"
    return Phrase(f"tangent {side}", (step.phrase, *step.points))


def _from_arcs(about: Sequence[str], radii: Sequence[float], name: str, side: float) -> Phrase:
    """A point where two arcs meet, ``side`` positive to the left of the line between their centres."""
    one, two = map(on_paper, radii)
    return Phrase(f"place by arcs {'left' if side > 0 else 'right'}", (about[0], one, about[1], two, name))


def _along(p: tuple[str, complex], q: tuple[str, complex], name: str, at: complex) -> Phrase:
    """A point of a bar whose direction is that of a line through its pivot: on it, or at an angle to it."""
    (one, a), (_, b) = p, q
    if abs(at - a) < SAME or abs(cross(b - a, at - a)) < STRAIGHT * abs(b - a) * abs(at - a):
        return _on_line(p, q, name, at)
    turn = math.degrees(cmath.phase((at - a) / (b - a)))
    sense = "ccw" if turn > 0 else "cw"
    return Phrase(f"place turned {sense}", (one, number(abs(turn), 4), one + q[0], one + name,
                                            on_paper(abs(at - a)), name))  # fmt: skip


def _on_line(p: tuple[str, complex], q: tuple[str, complex], name: str, at: complex) -> Phrase:
    (one, a), (two, b) = p, q
    along = dot(at - a, b - a) / abs(b - a) ** 2
    if 0.0 <= along <= 1.0:
        return Phrase("place within", (one + two, name, one + name, on_paper(abs(at - a))))
    return Phrase("place beyond", (one + two, name, one + name, on_paper(abs(at - a)), one if along < 0.0 else two))


def _coordinates(z: complex) -> tuple[str, str]:
    return true_minus(on_paper(_clean(z.real))), true_minus(on_paper(_clean(z.imag)))


def _clean(mm: float) -> float:
    return 0.0 if abs(mm) < SAME else mm


def _degrees(angle: float) -> str:
    return true_minus(number(round(angle, 2) + 0.0))


# -- trial positions ---------------------------------------------------------------------------------------------------


def _positions(voice: Voice, step: Step) -> Phrase | None:
    """Trial positions with what is measured in each, and the division."""
    assert isinstance(step.data, TrialPositions)
    sheet, table = voice.sheet, step.data.table
    if table is None:
        return None
    moved, missed = _moved_and_missed(sheet, table)
    values, misses = zip(*(_told_in(table, row) for row in table.trials), strict=True)
    if len(table.moved) > 1:
        told = Phrase("trial table several", (moved, _numbered(values), missed, _numbered(misses)))
        return Phrase("in turn", (step.phrase, _divided_by_parts(table, told)))
    unit = " mm" if not table.missed[0].angle else "°"
    told = Phrase("trial table", (moved, ", ".join(values), missed, "; ".join(misses).replace(unit, "") + unit))
    if table.divided:
        before = table.before
        between = tuple(f"{abs(table.trials[i][1][0]):.2f}" for i in (before - 1, before))
        first, *rest = (_told_in(table, row) for row in table.divided)
        told = Phrase("trial division", (told, before, before + 1, *between, *first))
        if rest:
            told = Phrase("trial division again", (told, rest[-1][0]))
    return Phrase("in turn", (step.phrase, told))


def _positions_lines(voice: Voice, step: Step, language: str) -> Iterator[Phrase]:
    """Trial positions: what is moved, how each point is found with it, what is missed, and where nothing is."""
    trial, sheet = step.data, voice.sheet
    assert isinstance(trial, TrialPositions)
    out, moved, rolled = (", ".join(n) for n in (trial.left_out, trial.driven, trial.rolling))
    told = Phrase("written trial rolling", (moved, rolled)) if rolled else Phrase("written trial", (out, moved))
    parts: list[Phrase] = [told]
    table = trial.table
    if table is not None:
        moved_words, missed = _moved_and_missed(sheet, table)
        rows = [_told_in(table, row) for row in table.trials]
        if len(table.moved) > 1:
            numbered = ([Neutral(f"${numeral(i)}$ {row[k]}") for i, row in enumerate(rows, 1)] for k in (0, 1))
            values, misses = map(listed, numbered)
            parts += [Phrase("written tried", (moved_words, values)), Phrase("written missed", (missed, misses))]
        else:
            values = listed([row[0] for row in rows])
            parts.append(Phrase("written tried one", (moved_words, values, len(rows))))
            near = (table.before, table.before + 1)
            seen = listed([Phrase("written miss", (rows[i - 1][1], i)) for i in near])
            parts.append(Phrase("written missed", (missed, seen)))
        if table.divided:
            parts.append(Phrase("written fits", (_told_in(table, table.divided[-1])[0],)))
    route = [*_route(voice, step)]
    if route:
        parts.insert(2, Phrase("written route", (listed([*map(Neutral, route)]),)))
    yield in_turn(parts)


def _route(voice: Voice, trial: Step) -> Iterator[str]:
    """Each point with what it is found from: the link that it lies on, the centres of its arcs, its guide."""
    paths: dict[str, str] = {}
    arced: set[str] = set()
    for step in voice.sheet.steps[trial.number :]:
        guides = [_guide(voice, pair) for pair in step.pairs]
        match step.reason:
            case _ if step.diagram != "mechanism" or step.verb == "trial":
                return
            case "path":
                paths[step.point] = guides[0]
            case "arcs" | "arc on path" | "paths":
                arced.add(step.point)
                ends = [_points(voice, [name]) for name in step.points]
                along = [paths.get(step.point, "")] if step.reason == "arc on path" else []
                yield _from(voice, step.point, *ends, *along, *guides)
            case "points" | "whole link":
                new = [name for name in step.points if name not in arced]
                if new:
                    yield f"{_points(voice, new)} ({step.link})"
            case "guide" | "tangent":
                yield f"{guides[0]} ({_points(voice, step.points)})"
            case "guide to point":
                yield _from(voice, step.point, *guides)


def _guide(voice: Voice, pair: str) -> str:
    """The guide of a sliding pair by its name, or by its pair."""
    name = next((s.guide.name for s in voice.sheet.structure.slides if s.key == pair), "")
    return f"${in_markup(name)}$" if name else pair


def _from(voice: Voice, point: str, *ways: str) -> str:
    return f"{_points(voice, [point])} ({', '.join(filter(None, ways))})"


def _points(voice: Voice, names: Sequence[str]) -> str:
    return ", ".join(f"${voice.letters.point(name)}$" for name in names)


def _divided_by_parts(table: TrialTable, told: Phrase) -> Phrase:
    """The divisions of trials in each of which another thing was moved."""
    for i, row in enumerate(table.divided):
        values, misses = _told_in(table, row)
        if i:
            told = Phrase("trial parts again", (told, numeral(table.instead[i - 1]), values, misses))
        else:
            steps = ", ".join(numeral(k) for k in range(2, len(table.trials) + 1))
            told = Phrase("trial parts", (told, ", ".join(map(_two_digits, table.parts)), steps, values, misses))
    return told


def _numbered(rows: Sequence[str]) -> str:
    return "; ".join(f"{numeral(i)} {row}" for i, row in enumerate(rows, 1))


def _special_lines(voice: Voice, step: Step, language: str) -> Iterator[Phrase]:
    """Where the special point lies."""
    joints = map(Markup, map(voice.letters.point, (step.point, *step.points)))
    key = "written relative special" if step.base and step.kind != "driven" else "written special"
    told = Phrase(key, (*joints, step.base, step.link))
    yield Phrase("written sliding leg", (told,)) if voice.sheet.structure.slides else told


# -- trials in words ---------------------------------------------------------------------------------------------------


def _moved_and_missed(sheet: Sheet, table: TrialTable) -> tuple[Phrase, Phrase]:
    """All that is moved in trial positions, and all that is missed."""
    moved = reduce(lambda a, b: Phrase("moved too", (a, b)), [_moved(sheet, one) for one in table.moved])
    return moved, reduce(lambda a, b: Phrase("missed too", (a, b)), [_missed(sheet, one) for one in table.missed])


def _missed(sheet: Sheet, missed: Missed) -> Phrase:
    """What is measured: between the ends of a bar, off a guide, or of a list."""
    if missed.kind == "guide":
        *points, key = missed.names
        slide = sheet.structure.slide(key)
        name = _along_guide(slide, sheet.structure.links[slide.b].points)
        off = (", ".join(points), slide.b)
        return Phrase("missed guide", (*off, name)) if name else Phrase("missed guide of link", off)
    named = "".join(missed.names) if missed.kind == "bar" else ", ".join(missed.names)
    return Phrase(f"missed {missed.kind}", (named, on_paper(missed.length)))


def _along_guide(slide: Pair, points: Mapping[str, complex]) -> str:
    """The outermost points on a guide, in its sense, else its name; "" where it has neither."""
    guide = slide.guide
    off = {p: (z - guide.through) * guide.direction.conjugate() for p, z in points.items()}
    size = max(map(abs, off.values()), default=0.0)
    on = sorted((along.real, p) for p, along in off.items() if abs(along.imag) <= IN_LINE * size)
    return on[0][1] + on[-1][1] if len(on) > 1 else guide.name


def _moved(sheet: Sheet, moved: Moved) -> Phrase:
    if not moved.turned:
        return Phrase("trial travel", (moved.name,))
    if not moved.base:
        points = sheet.structure.links[moved.name].points.items()
        spans = ((p + q, w - z) for p, z in points for q, w in points if z != w)
        bar = next((bar for bar, span in spans if abs(cmath.phase(span)) < IN_LINE), "")  # along the axis of the link
        return Phrase("trial angle of bar", (moved.name, bar)) if bar else Phrase("trial angle", (moved.name,))
    one, other = (sheet.structure.links[name] for name in (moved.base, moved.name))
    hinge = next((p for p in one.points if p in other.points), "")
    if len(one.bar) < 2 or len(other.bar) < 2 or not hinge:
        return Phrase("trial turn", (moved.name, moved.base))
    return Phrase("trial turn of bars", (moved.name, "".join(other.bar[:2]), "".join(one.bar[:2]), hinge))


def _told_in(table: TrialTable, row: TrialRow) -> tuple[str, str]:
    """The values of a trial, and what it misses, each with its unit."""
    values = (  # angles from -180 to 180
        f"{_two_digits(180.0 - (180.0 - v) % 360.0)}°" if one.turned else f"{_two_digits(v)} mm"
        for v, one in zip(row[0], table.moved, strict=True)
    )
    misses = (_two_digits(m) + ("°" if one.angle else " mm") for m, one in zip(row[1], table.missed, strict=True))
    return ", ".join(values), ", ".join(misses)


def _two_digits(value: float) -> str:
    """With two digits behind the point, without the sign of a nought."""
    return true_minus(f"{round(value, 2) + 0.0:.2f}")


def numeral(number_of: int) -> str:
    """The numeral of a trial."""
    return NUMERALS[(number_of - 1) % len(NUMERALS)]


SENTENCES: Mapping[Reason, Callable[[Voice, Step], Phrase | None]] = {
    "frame": _fixed, "angle": _angle, "points": _link_points, "whole link": _link_points, "arcs": _arcs,
    "arc on path": _arc_on_path, "tangent": _tangent, "positions": _positions,
}  # fmt: skip
"""The step as it is said with the lengths and sides of the paper, by its reason."""
LINES: Mapping[Reason, Callable[[Voice, Step, str], Iterable[Phrase]]] = {
    "positions": _positions_lines, "special point": _special_lines,
}  # fmt: skip
"""What is written of a step to repeat it, in a language."""
