"""A velocity or acceleration polygon: vectors, end points, feet of components, direction lines, images."""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from graphkin.drafting.sheet import Bar, DiagramName, Image, Mark, Ray, Sheet, Vector
from graphkin.drawing import strokes
from graphkin.drawing.arrows import COMPONENT, POINTER, RESULTANT, arrowhead, vector_group
from graphkin.drawing.box import Box
from graphkin.drawing.colours import colour_of_link, colour_of_vector, link_of_vector
from graphkin.drawing.conventions import Letters, pole
from graphkin.drawing.describe import spoken_ref, spoken_vector
from graphkin.drawing.detail import Detail
from graphkin.drawing.layout import Name, Piece
from graphkin.drawing.metrics import runs_width
from graphkin.drawing.placing import Label
from graphkin.drawing.primitives import Circle, Group, Line, Polygon, Primitive, Stroke, Text
from graphkin.drawing.typeset import symbol
from graphkin.scene.symbol import PointRef, Symbol

__all__ = ["extent", "polygon_piece"]

POLE_RADIUS, END_RADIUS, FOOT_RADIUS, RING = 0.9, 0.5, 0.4, 0.45
BEYOND = 9.0  # mm: how far a direction line runs past the crossing
SAME = 0.02  # mm: nearer end points fall together on paper
FAR = 60.0  # mm: construction further outside than this is cut off
SHORT = 8.0  # mm: a shorter vector from the pole is named by its end points alone
ZERO = 0.02  # mm: a shorter vector is drawn as a dot
MOST_AT_POLE = 24.0  # mm of names of points at rest beside the letter of the pole


@dataclass(frozen=True)
class _Spot:
    """A place of the polygon with the end points that fall together in it."""

    at: complex
    refs: list[PointRef]


def extent(sheet: Sheet, diagram: DiagramName, within: Box | None = None) -> Box:
    """The box (mm, y down, about the pole) around all vectors of a polygon; lines that lead to them are counted in
    where they do not reach far."""
    ends = [0j, *(z for v in sheet.vectors(diagram).values() for z in (v.tail, v.tip))]
    box = Box.around(z.conjugate() for z in ends)
    for step in sheet.steps:
        for stroke in step.strokes:
            if step.diagram == diagram and isinstance(stroke, Bar):
                wider = box.joined(Box.around((stroke.a.conjugate(), stroke.b.conjugate())))
                if within is None:
                    fits = max(wider.width - box.width, wider.height - box.height) < FAR
                else:
                    fits = wider.width <= within.width and wider.height <= within.height
                box = wider if fits else box
    return box


def polygon_piece(
    sheet: Sheet, diagram: DiagramName, letters: Letters, language: str, panel: Box, origin: complex,
    enlarged: Sequence[Detail] = (),
) -> Piece:  # fmt: skip
    """Draw a polygon with its pole at a point of the page.

    Parameters
    ----------
    panel : lines known by direction only are clipped to it
    origin : page point of the pole (mm)
    enlarged : places that are drawn again larger; they get a ring, and their vectors no names here
    """
    return _Composer(sheet, diagram, letters, language, panel, origin, enlarged).piece()


class _Composer:
    def __init__(
        self, sheet: Sheet, diagram: DiagramName, letters: Letters, language: str, panel: Box, origin: complex,
        enlarged: Sequence[Detail],
    ) -> None:  # fmt: skip
        self.enlarged = enlarged
        self.sheet, self.diagram, self.letters, self.language = sheet, diagram, letters, language
        self.panel, self.origin = panel, origin
        self.vectors: dict[Symbol, tuple[int, Vector]] = {}
        self.steps = [step for step in sheet.steps if step.diagram == diagram]
        for step in self.steps:
            for stroke in step.strokes:
                if isinstance(stroke, Vector):
                    self.vectors[stroke.symbol] = (step.number, stroke)
        self.names: list[Name] = []
        self.marks: list[complex] = []  # points with a dot, named or not

    def at(self, z: complex) -> complex:
        return self.origin + z.conjugate()

    def piece(self) -> Piece:
        spots = self._spots()
        rings = [
            Group((Circle(self.at(d.centre), d.radius + 0.8, stroke=strokes.CONSTRUCTION),),
                  id=f"ring-{self.diagram}-{number}", classes=("ring",))
            for number, d in enumerate(self.enlarged, 1)
        ]  # fmt: skip
        construction = [*rings, *self._images(), *self._bars(), *self._rays()]
        vectors = [self._vector(step, vector) for step, vector in self._in_order()]
        ends = [*self._ends(spots), *self._feet(spots), self._pole(spots)]
        self._name_vectors()
        layers = {"construction": tuple(construction), self.diagram: (*vectors, *ends)}
        return Piece(layers, tuple(self.names), tuple(self.marks))

    def _in_order(self) -> Iterator[tuple[int, Vector]]:
        """Long vectors first, so that short ones lie on top."""
        yield from sorted(self.vectors.values(), key=lambda sv: (-round(abs(sv[1].span), 6), sv[0]))

    # -- vectors -----------------------------------------------------------------------------------------------------

    def _vector(self, step: int, vector: Vector) -> Group:
        kind = RESULTANT if vector.role == "resultant" else COMPONENT
        return vector_group(
            vector.symbol.id,
            step,
            self.at(vector.tail),
            self.at(vector.tip),
            kind,
            colour_of_vector(self.sheet, vector.symbol),
            spoken_vector(vector.symbol, self.language),
            classes=(vector.role,),
        )

    def _name_vectors(self) -> None:
        """One name for vectors that share tail and tip; those of zero length are named in words."""
        groups: dict[tuple[complex, complex], list[Vector]] = {}
        for _, vector in self._in_order():
            key = (_rounded(vector.tail), _rounded(vector.tip))
            groups.setdefault(key, []).append(vector)
        lengths = {key: abs(vectors[0].span) for key, vectors in groups.items()}
        elsewhere = {v.symbol for detail in self.enlarged for v in detail.vectors}
        for key in sorted(groups, key=lambda k: -lengths[k]):
            if groups[key][0].symbol in elsewhere:
                continue
            vectors = sorted(groups[key], key=lambda v: self.vectors[v.symbol][0])
            if lengths[key] < ZERO:
                vectors = [
                    v for v in vectors if v.role != "resultant" or self.letters.convention == "us" or abs(v.tip) < SAME
                ]
            if not vectors:
                continue
            markup = " = ".join(self.letters.vector(v.symbol) for v in vectors)
            colour = colour_of_vector(self.sheet, vectors[0].symbol)
            id = f"label-{vectors[0].symbol.id}"
            if lengths[key] < ZERO:
                text = Text(0j, symbol(markup + " = 0"), "start", strokes.BLACK, id, ("label",))
                self.names.append(Name(Label(text, self.at(vectors[0].tip)), 3))
                continue
            asked = any(v.symbol in self.sheet.scene.find for v in vectors)
            plain = all(v.role == "resultant" for v in vectors) and not asked
            if self.letters.convention != "us" and lengths[key] < SHORT and plain:
                continue  # the letters at its ends say it
            needed = self.letters.convention == "us" or any(v.role != "resultant" for v in vectors)
            text = Text(0j, symbol(markup), "start", colour, id, ("label",))
            mark = (self.at(vectors[0].tail), self.at(vectors[0].tip))
            self.names.append(Name(Label(text, mark), 1 if needed else 2))

    # -- points ------------------------------------------------------------------------------------------------------

    def _spots(self) -> list[_Spot]:
        """End points by place, in the order in which they were found; the pole first, with all points at rest."""
        fixed = [PointRef(p) for p in self.sheet.scene.frame.points]
        spots = [_Spot(0j, list(fixed))]
        seen: set[PointRef] = set(fixed)
        for step in self.steps:
            for stroke in step.strokes:
                if not isinstance(stroke, Mark) or stroke.ref in seen:
                    continue
                if not any(symbol.of == stroke.ref and symbol.to is None for symbol in self.vectors):
                    continue
                seen.add(stroke.ref)
                for spot in spots:
                    if abs(spot.at - stroke.at) <= SAME:
                        spot.refs.append(stroke.ref)
                        break
                else:
                    spots.append(_Spot(stroke.at, [stroke.ref]))
        return spots

    def _ends(self, spots: Sequence[_Spot]) -> Iterator[Primitive]:
        fixed = set(self.sheet.scene.frame.points)
        for number, spot in enumerate(spots):
            moving = [ref for ref in spot.refs if ref.link or ref.point not in fixed]
            for i, ref in enumerate(moving):
                shape = self._dot(spot.at, i + (number == 0))
                id = f"{self.diagram}-{ref}".replace("@", "")
                yield Group((shape,), id=id, classes=("end",), title=spoken_ref(ref, self.language))
                self.marks.append(self.at(spot.at))
            if number and moving:
                markup = ", ".join(filter(None, (self.letters.end(self.diagram, ref) for ref in moving)))
                self._name_point(markup, spot.at, f"label-{self.diagram}-{moving[0]}", 0, away=spot.at)

    def _dot(self, z: complex, ring: int) -> Circle:
        """A dot for the first point of a place, rings round it for those that fall together with it."""
        if ring == 0:
            return Circle(self.at(z), END_RADIUS, fill=strokes.BLACK)
        return Circle(self.at(z), END_RADIUS + ring * RING, stroke=Stroke(0.18))

    def _feet(self, spots: Sequence[_Spot]) -> Iterator[Primitive]:
        """Points between components: where one ends and no end point lies."""
        taken = [spot.at for spot in spots]
        found: list[tuple[Vector, complex]] = []
        for _, vector in self.vectors.values():
            at = vector.tip
            if vector.role in ("resultant", "relative") or abs(vector.span) < ZERO:
                continue
            if all(abs(at - z) > SAME for z in taken):
                taken.append(at)
                found.append((vector, at))
        per_role: dict[str, int] = {}
        per_end: dict[str, int] = {}
        for vector, _ in found:
            per_role[vector.role] = per_role.get(vector.role, 0) + 1
        used: set[str] = set()
        for vector, at in found:
            assert vector.symbol.of is not None
            # counted by the letter that is written: B and B@2 are one end point
            end = self.letters.end(self.diagram, vector.symbol.of)
            per_end[end] = number = per_end.get(end, 0) + 1
            link = link_of_vector(self.sheet, vector.symbol) if per_role[vector.role] > 1 else ""
            markup = self.letters.foot(vector.role, vector.symbol.of, number, link)
            if markup in used:
                index = self.letters.ref(vector.symbol.of)
                index += self.letters.ref(vector.symbol.to) if vector.symbol.to else ""
                markup = self.letters.foot(vector.role, vector.symbol.of, number, index)
            used.add(markup)
            dot = Circle(self.at(at), FOOT_RADIUS, fill=strokes.BLACK)
            yield Group((dot,), id=f"foot-{vector.symbol.id}", classes=("foot",))
            self.marks.append(self.at(at))
            self._name_point(markup, at, f"label-foot-{vector.symbol.id}", 1, away=at)

    def _pole(self, spots: Sequence[_Spot]) -> Group:
        ends = [self.letters.end(self.diagram, ref) for ref in spots[0].refs]
        shown = ", ".join(filter(None, ends))
        letter = pole(self.letters.convention, self.diagram)
        markup = f"{letter} ({shown})" if shown and runs_width(symbol(shown)) < MOST_AT_POLE else letter
        away = -sum((v.span for _, v in self.vectors.values() if abs(v.tail) < SAME), 0j)
        self._name_point(markup, 0j, f"label-pole-{self.diagram}", 0, away)
        shape = Circle(self.at(0j), POLE_RADIUS, fill=strokes.WHITE, stroke=strokes.OUTLINE)
        dot = Circle(self.at(0j), 0.3, fill=strokes.BLACK)
        return Group((shape, dot), id=f"pole-{self.diagram}", classes=("pole",))

    def _name_point(self, markup: str, at: complex, id: str, rank: int, away: complex) -> None:
        if not markup:
            return
        text = Text(0j, symbol(markup), "start", strokes.BLACK, id.replace("@", ""), ("label",))
        toward = (phase(away),) if abs(away) > SAME else ()
        self.names.append(Name(Label(text, self.at(at), toward), rank))

    # -- construction ------------------------------------------------------------------------------------------------

    def _rays(self) -> Iterator[Primitive]:
        named: set[tuple[str, complex]] = set()
        for step in self.steps:
            for ray in (s for s in step.strokes if isinstance(s, Ray)):
                end = ray.to if ray.to is not None else ray.through
                way = end - ray.through
                e = way / abs(way) if abs(way) > 1.0 else ray.along
                first = ray.through if not self._covered(ray.through, end) else end
                clipped = self.panel.clip(self.at(end), self.at(end + BEYOND * e))
                if clipped is None or abs(clipped[1] - clipped[0]) < 5.0:
                    e = -e  # no room beyond: show the line on its other side
                    base = ray.through if abs(way) > 1.0 else end
                    clipped = self.panel.clip(self.at(base), self.at(base + BEYOND * e)) or clipped
                lines = []
                if abs(first - end) > SAME:
                    whole = self.panel.clip(self.at(first), self.at(end))
                    lines += [Line(*whole, strokes.DIRECTION)] if whole else []
                if clipped is not None:
                    lines.append(Line(*clipped, strokes.DIRECTION))
                    markup = self.letters.direction(ray.direction, self.sheet.scene.frame.name)
                    key = (markup, _rounded(end))
                    if key not in named and abs(clipped[1] - clipped[0]) > 1.0:
                        named.add(key)
                        text = Text(
                            0j,
                            symbol(markup, 3.0),
                            "start",
                            strokes.GREY,
                            f"label-direction-{step.number:02d}",
                            ("label", "direction"),
                        )
                        self.names.append(Name(Label(text, clipped), 4))
                yield Group(tuple(lines), classes=("direction", f"step-{step.number:02d}"))

    def _covered(self, a: complex, b: complex) -> bool:
        """Whether a drawn vector lies from a to b or back."""
        return any(
            (abs(v.tail - a) < SAME and abs(v.tip - b) < SAME) or (abs(v.tail - b) < SAME and abs(v.tip - a) < SAME)
            for _, v in self.vectors.values()
        )

    def _images(self) -> Iterator[Primitive]:
        count: dict[str, int] = {}
        for step in self.steps:
            for image in (s for s in step.strokes if isinstance(s, Image)):
                count[image.link] = count.get(image.link, 0) + 1
                tail = f"-{count[image.link]}" if count[image.link] > 1 else ""
                outline = strokes.CONSTRUCTION.coloured(colour_of_link(self.sheet.scene, image.link))
                shape = Polygon(tuple(map(self.at, image.corners)), "", outline)
                yield Group(
                    (shape,),
                    id=f"image-{self.diagram}-{image.link}{tail}",
                    classes=("image", f"step-{step.number:02d}"),
                )

    def _bars(self) -> Iterator[Primitive]:
        for step in self.steps:
            for bar in (s for s in step.strokes if isinstance(s, Bar)):
                if abs(bar.b - bar.a) <= SAME or self._covered(bar.a, bar.b):
                    continue
                start, end = self.at(bar.a), self.at(bar.b)
                clipped = self.panel.clip(start, end)
                if clipped is None:
                    continue
                parts: list[Primitive] = [Line(*clipped, strokes.CONSTRUCTION)]
                if step.phrase.key == "carry":
                    parts += self._carried(step.phrase.args[0], clipped, end)
                yield Group(tuple(parts), classes=("construction", f"step-{step.number:02d}"))

    def _carried(self, moved: object, line: tuple[complex, complex], tip: complex) -> Iterator[Primitive]:
        """A vector added before its turn in the chain: thin, with its name."""
        length = abs(line[1] - line[0])
        if abs(line[1] - tip) < SAME and length > 1.0:
            head = min(POINTER.head_length, 0.7 * length)
            yield arrowhead(tip, line[1] - line[0], head, POINTER.head_width, strokes.BLACK)
        if isinstance(moved, Symbol) and length > 4.0:
            text = Text(
                0j,
                symbol(self.letters.vector(moved), 3.0),
                "start",
                strokes.GREY,
                f"label-carried-{moved.id}",
                ("label",),
            )
            self.names.append(Name(Label(text, line), 4))


def _rounded(z: complex) -> complex:
    return complex(round(z.real / SAME), round(z.imag / SAME))
