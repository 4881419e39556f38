"""Instant centres on a figure: marks by kind, the lines near what they find, arrows to centres that lie far away."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphkin.account.centres import line_through
from graphkin.account.headings import number
from graphkin.account.notation import Letters
from graphkin.construction.centres import Centre, CentreRelation, Centres
from graphkin.construction.centres import Line as Straight
from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Polygon, Primitive, Text, on_page
from graphkin.drawing.ink.symbols import POINTER, arrow
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.obstacles import distances
from graphkin.drawing.place.piece import Piece, obstacles_of
from graphkin.drawing.text import SMALLEST, rich, stacked
from graphkin.plane import cross, dot, unit

__all__ = ["TOGETHER", "centre_marks", "line_name", "mark_of", "near_box"]

TOGETHER = 1.3  # mm: centres so near to each other share one mark
BEYOND = 5.0  # mm of a construction line beyond what it finds
ARROW = 11.0  # mm, to what lies off the figure
IN_LINE = 4  # names of centres at one place


def mark_of(centre: Centre, frame: str, at: complex) -> tuple[Primitive, ...]:
    """The mark of a centre at a page point: permanent ones in rings (the fixed filled), found ones as dots in a cross,
    those found in another way as lozenges."""
    line = strokes.RELATIVE
    if centre.kind == "permanent":
        inner = strokes.BLACK if frame in centre.pair else strokes.WHITE
        return Circle(at, 2.1, "", line), Circle(at, 1.0, inner, line)
    if centre.way:
        corners = (at - 1.5, at - 1.5j, at + 1.5, at + 1.5j)
        return (Polygon(corners, strokes.WHITE, line),)
    cross_ = tuple(Line(at - 1.7 * w, at + 1.7 * w, strokes.OUTLINE) for w in (1 + 1j, 1 - 1j) for w in (w / abs(w),))
    return *cross_, Circle(at, 0.65, strokes.BLACK)


def line_name(relation: CentreRelation, letters: Letters) -> str:
    """A line on which a centre lies, by the centres that it leads through, or the normal of a pin in a slot."""
    named = line_through(relation, letters.centre, lambda pin: "n_{" + pin.partition("/")[0] + "}")
    return f"${named}$"


def near_box(centres: Centres, mechanism: Box, most: tuple[float, float]) -> Box:
    """The box (mm about the world's origin, y down) of the mechanism and of the centres that lie near enough to be
    shown with it: the nearest first, as long as the whole stays within a width and height."""
    box = mechanism
    spots = [on_page(c.point) for c in centres.found if c.point is not None]
    for z in sorted(spots, key=mechanism.distance):
        larger = box.joined(Box.around((z,)).grown(3.0))
        if larger.width <= most[0] and larger.height <= most[1]:
            box = larger
    return box


def centre_marks(
    centres: Centres, letters: Letters, panel: Box, drawn: tuple[Primitive, ...]
) -> Piece:
    """All centres of a figure about the world's origin (y down); ``drawn`` is the mechanism, of which arrows to what
    lies outside the panel keep clear."""
    return _Marks(centres, letters, panel, drawn).piece()


class _Marks:
    def __init__(
        self, centres: Centres, letters: Letters, panel: Box, drawn: tuple[Primitive, ...]
    ) -> None:
        self.centres, self.letters, self.panel = centres, letters, panel
        self.frame = centres.scene.frame.name
        self.inside = panel.grown(-2.5)
        obstacles = obstacles_of(drawn)
        self.solid = list(obstacles.solid)

    def piece(self) -> Piece:
        near: list[list[Centre]] = []
        far: list[Centre] = []
        for centre in self.centres.found:
            if centre.place is None:
                continue
            if centre.point is None or self.inside.distance(on_page(centre.point)) > 0.0:
                far.append(centre)
                continue
            home = next((g for g in near if abs((g[0].point or 0j) - centre.point) < TOGETHER), None)
            if home is None:
                near.append([centre])
            else:
                home.append(centre)
        names: list[Label] = []
        lines = [line for c in (*(c for group in near for c in group), *far) for line in self._lines(c)]
        names += [label for group in near for label in self._crossings(group)]
        marks: list[Primitive] = []
        for group in near:
            spot = on_page(group[0].point or 0j)
            marks += self._group(group, spot)
            names.append(self._name(group, spot))
        self.solid += [(line.start, line.end) for line in lines]
        for spot in [on_page(g[0].point or 0j) for g in near]:
            self.solid += [(spot - 4.0, spot + 4.0), (spot - 4.0j, spot + 4.0j)]
        for together in self._alike(far):
            tail, tip = self._arrow(together[0])
            self.solid.append((tail, tip))
            marks += [
                Group(arrow(tail, tip, POINTER) if i == 0 else (), id=self._id(c), classes=("centre", "far", c.kind))
                for i, c in enumerate(together)
            ]
            names.append(self._far_name(together, tail, tip))
        # over the tint of links, under the marks
        found_by = Group(tuple(lines), id="centre-lines", classes=("construction",))
        return Piece({"centres": (found_by, *marks)}, tuple(names))

    def _id(self, centre: Centre) -> str:
        return "centre-" + "-".join(sorted(centre.pair))

    def _group(self, group: list[Centre], spot: complex) -> list[Primitive]:
        """One mark for centres that fall together: that of the best known, every name with a group of its own."""
        return [
            Group(
                mark_of(c, self.frame, spot) if i == 0 else (Circle(on_page(c.point or 0j), 0.3, strokes.BLACK),),
                id=self._id(c), classes=("centre", c.kind, *((f"step-{c.number:02d}",) if c.number else ())),
            )
            for i, c in enumerate(group)
        ]

    def _name(self, group: list[Centre], spot: complex) -> Label:
        runs = stacked(self._names(group), 3.5)
        return Label.of(runs, spot, f"label-{self._id(group[0])}", classes=("centre",),
                        key=self._key(group) if len(group) > 1 else None)

    def _names(self, group: Sequence[Centre], tail: str = "") -> list[str]:
        """The names of centres at one place, in lines."""
        names = [f"${self.letters.centre(c.pair)}$" for c in group]
        lines = [", ".join(names[i : i + IN_LINE]) for i in range(0, len(names), IN_LINE)]
        return [*(line + "," for line in lines[:-1]), lines[-1] + tail]

    def _key(self, group: Sequence[Centre]) -> Text:
        """The first of several centres, for all of them."""
        return Text(0j, rich(f"${self.letters.centre(group[0].pair)}$" + ", …" * (len(group) > 1), 3.2))

    def _crossings(self, group: list[Centre]) -> list[Label]:
        """Which lines meet in the centres of one place."""
        labels = []
        for c in group:
            if c.lines:
                words = " × ".join(line_name(line, self.letters) for line in c.lines)
                labels.append(Label.of(rich(words, SMALLEST), on_page(c.point or 0j), f"label-lines-{self._id(c)}",
                                       colour=strokes.GREY, rank=3))
        return labels

    def _lines(self, centre: Centre) -> list[Line]:
        """The two lines that cross in a centre, each from the centres that it leads through to just beyond, cut at the
        panel."""
        found = []
        for relation in centre.lines:
            if abs(complex(*relation.line[:2])) <= 1e-12 * abs(relation.line[2]):
                continue  # the line at infinity
            along = self._along(relation.line)
            known = [on_page(z) for z in self._known(relation)]
            if centre.point is None:
                # towards a centre that lies at infinity, as far as the panel goes
                ends = [self.panel.clip(z - 1e4 * along, z + 1e4 * along) for z in known[:1]]
                found += [Line(*end, strokes.OF_CENTRES) for end in ends if end is not None]
                continue
            here = on_page(centre.point)
            base = known[0] if known else here - BEYOND * along
            shares = [dot(z - base, along) for z in (*known, here)]
            end = shares[-1]
            low, high = min(shares), max(shares)
            low, high = (low - BEYOND if end == low else low), (high + BEYOND if end == high else high)
            line = self.panel.clip(base + low * along, base + high * along)
            if line is not None and line[0] != line[1]:
                found.append(Line(*line, strokes.OF_CENTRES))
        return found

    def _known(self, relation: CentreRelation) -> list[complex]:
        """The places (mm, y up) that a line leads through: those of its two centres, or of the pin whose path it is
        square to."""
        places: list[complex | None] = []
        for one in relation.through:
            if isinstance(one, str):
                name = one.split("/")[0]
                places.append(self.centres.point(name) if name in self.centres.scene.holders else None)
            else:
                places.append(self.centres.of(*one).point)
        return [z for z in places if z is not None]

    def _along(self, line: Straight) -> complex:
        """Direction of a line on the page (y down)."""
        return on_page(unit(complex(-line[1], line[0])))

    # -- far ones ----------------------------------------------------------------------------------------------------

    def _alike(self, far: list[Centre]) -> list[list[Centre]]:
        """Centres at infinity in one direction share an arrow."""
        groups: list[list[Centre]] = []
        for centre in far:
            for group in groups:
                one, two = group[0].direction, centre.direction
                if one is not None and two is not None and abs(cross(one, two)) < 1e-9:
                    group.append(centre)
                    break
            else:
                groups.append([centre])
        return groups

    def _arrow(self, centre: Centre) -> tuple[complex, complex]:
        """Where an arrow to a far centre stands: pointing straight at it, clear of what is drawn, near the edge."""
        middle = self.inside.centre
        best: tuple[float, complex, complex] | None = None
        steps = [s * k * 6.0 for k in range(18) for s in ((1, -1) if k else (1,))]
        for sense in (1, -1) if centre.point is None else (1,):
            for aside in steps:
                towards = self._towards(centre, middle, sense)
                start = middle + 1j * towards * aside
                towards = self._towards(centre, start, sense)
                for back in (0.0, 4.0, 10.0):
                    off = 0.12 * abs(aside) + 0.5 * back + 3.0 * (sense < 0)
                    if best is not None and off >= best[0]:
                        continue
                    chord = self.inside.clip(start, start + 1e4 * towards)
                    if chord is None or abs(chord[1] - chord[0]) < ARROW + back:
                        continue
                    tip = chord[1] - back * towards
                    tail = tip - ARROW * towards
                    cost = off + self._crowd(tail, tip)
                    if best is None or cost < best[0]:
                        best = cost, tail, tip
        assert best is not None, "a panel is larger than an arrow"
        return best[1], best[2]

    def _towards(self, centre: Centre, start: complex, sense: int) -> complex:
        if centre.point is not None:
            return unit(on_page(centre.point) - start)
        assert centre.direction is not None
        return sense * on_page(centre.direction)

    def _crowd(self, tail: complex, tip: complex) -> float:
        """How much is drawn near an arrow."""
        lines = np.array(self.solid, dtype=complex).reshape(-1, 2)
        gaps = distances(tail + (tip - tail) * np.arange(4) / 3, lines).min(axis=0)
        return float(np.maximum(0.0, 7.0 - gaps).sum())

    def _far_name(self, group: list[Centre], tail: complex, tip: complex) -> Label:
        first = group[0]
        words = self._names(group, " → ∞")
        if first.point is not None:
            point, start = self._reference()
            scene = self.centres.scene
            far = abs(first.point - start) / self.centres.mm / scene.units.metres
            words = [f"${point}{self.letters.centre(first.pair)}$ = {number(far, 4)} {scene.units.length}"]
        return Label.of(stacked(words, 3.2), (tail, tip), f"label-{self._id(first)}", classes=("centre",),
                        key=self._key(group))

    def _reference(self) -> tuple[str, complex]:
        """The fixed pivot from which far centres are measured."""
        scene = self.centres.scene
        point = next(iter(scene.frame.points), None) or next(iter(scene.holders))
        letter, rest = point[0], point[1:]
        return (f"{letter}_{{{rest}}}" if rest else letter), self.centres.point(point)
