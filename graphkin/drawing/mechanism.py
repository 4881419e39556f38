"""The mechanism: links, pairs and frame in kinematic symbols, drivers and found rates as arcs, names."""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Iterator

from graphkin.drafting.sheet import Arc as Compass
from graphkin.drafting.sheet import Sheet
from graphkin.drawing import strokes, symbols
from graphkin.drawing.arrows import POINTER, arrowhead
from graphkin.drawing.box import Box
from graphkin.drawing.colours import colour_of_link
from graphkin.drawing.conventions import Letters
from graphkin.drawing.layout import Name, Piece, cut_to, ink_box, middle_of
from graphkin.drawing.lengths import LENGTHS, drawn_lengths
from graphkin.drawing.placing import Label
from graphkin.drawing.primitives import Arc, Group, Line, Polygon, Primitive, Stroke, Text
from graphkin.drawing.senses import Clearance
from graphkin.drawing.shapes import GUIDE_LENGTH, Bearing, Shape, bearings, shapes
from graphkin.drawing.typeset import plain, symbol
from graphkin.plane import cross, dot
from graphkin.scene.model import AngleDriver, SlideDriver

__all__ = ["mechanism_piece"]

COMPASS = 4.0  # mm of arc to either side of what it finds
DRIVER_RADIUS, RADIUS = 6.5, 5.5
FOOT = {-math.pi / 2: 0.0, 0.0: 0.5, math.pi: 0.5, math.pi / 2: 0.7}  # where feet may point, and how little liked


def mechanism_piece(sheet: Sheet, letters: Letters, room: tuple[float, float] | None = None) -> tuple[Piece, Box]:
    """Draw the mechanism about the world's origin.

    Parameters
    ----------
    room : width and height (mm) of its panel; None for as much as it takes

    Returns
    -------
    the piece, and the box (mm, y down) that it takes up, names left out.  Where it does not fit the room, dimensions
    are left out first, then bars are cut at the edge of a room about its points.
    """
    piece = _Composer(sheet, letters, None).piece()
    box = ink_box(piece.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    if room is None or _fits(box, room):
        return piece, box
    lengths = [thing for thing in piece.drawn if isinstance(thing, Group) and thing.id == LENGTHS]
    bare = ink_box(thing for thing in piece.drawn if thing not in lengths) or box
    if not _fits(bare, room):
        bare = Box.around(z.conjugate() for z in sheet.points.values())
    half = complex(*room) / 2
    panel = Box.around((bare.centre - half, bare.centre + half))
    piece = _Composer(sheet, letters, panel).piece()
    layers = {name: cut_to(things, panel) for name, things in piece.layers.items()}
    names = tuple(n for n in piece.names if panel.distance(middle_of(n.label.mark)) == 0.0)
    return Piece(layers, names, piece.marks), panel


def _fits(box: Box, room: tuple[float, float]) -> bool:
    return box.width <= room[0] and box.height <= room[1]


class _Composer:
    def __init__(self, sheet: Sheet, letters: Letters, panel: Box | None) -> None:
        self.panel = panel
        self.sheet, self.scene, self.letters = sheet, sheet.scene, letters
        self.ground = sheet.scene.frame.name
        self.shapes = shapes(sheet)
        self.bearings = bearings(sheet)
        self.places = {ref.point: z for ref, z in sheet.points.items() if not ref.link}
        self.cylinders = {b.slide.key for b in self.bearings if b.driven and self._is_cylinder(b)}
        self.names: list[Name] = []
        self.clearance = self._clearance()

    def at(self, z: complex) -> complex:
        return z.conjugate()

    def piece(self) -> Piece:
        areas = [self._link(shape) for shape in self.shapes if shape.corners]
        bars = [self._link(shape) for shape in sorted(self.shapes, key=self._depth) if not shape.corners]
        fixed = list(self._frame())
        links = [*areas, *fixed, *bars]  # feet of pivots stand on the areas of links
        joints = list(self._joints())
        drivers = list(self._drivers())
        found = list(self._found())
        lengths = drawn_lengths(self.sheet, (*links, *joints, *drivers, *found), self.panel)
        self._name_links()
        marks = tuple(self.at(z) for z in self.places.values())
        layers: dict[str, tuple[Primitive, ...]] = {
            "construction": tuple(self._construction()),
            "mechanism": (*links, *joints, *drivers, lengths),
            "answers": tuple(found),
        }
        return Piece(layers, tuple(self.names), marks)

    def colour(self, link: str) -> str:
        return colour_of_link(self.scene, link)

    def _depth(self, shape: Shape) -> int:
        """What carries a block lies under it, what ends in its pin over it."""
        if any(b.slide.b == shape.link for b in self.bearings):
            return 0
        if any(b.slide.a == shape.link for b in self.bearings):
            return 1 + self._nested(shape.link)
        return 9

    def _nested(self, link: str) -> int:
        """How many larger blocks stand around the block of a link: two that slide at one pin lie in each other."""
        mine = next(b for b in self.bearings if b.slide.a == link)
        around = [b for b in self.bearings if not b.slide.slot and b.slide.a != link and abs(b.at - mine.at) < 0.5]
        rank = (mine.slide.b != self.ground, self.scene.order.get(link, 0))
        return sum((b.slide.b != self.ground, self.scene.order.get(b.slide.a, 0)) < rank for b in around)

    def _block(self, b: Bearing) -> tuple[Primitive, ...]:
        shrink = 0.72 ** self._nested(b.slide.a)
        return symbols.block(
            self.at(b.at), phase(b.along), self.colour(b.slide.a),
            symbols.BLOCK_LENGTH * shrink, symbols.BLOCK_WIDTH * shrink,
        )  # fmt: skip

    # -- frame -------------------------------------------------------------------------------------------------------

    def _frame(self) -> Iterator[Primitive]:
        parts: list[Primitive] = []
        for point in self.scene.frame.points:
            if self._moving(point):
                parts += symbols.fixed_pivot(self.at(self.places[point]), self._foot(point))
        for b in self.bearings:
            if self.ground in (b.slide.a, b.slide.b) and not b.slide.slot:
                parts += symbols.guide(self.at(b.at), phase(b.along), GUIDE_LENGTH)
        yield Group(tuple(parts), id=f"link-{self.ground}", classes=("frame",))

    def _moving(self, point: str) -> list[str]:
        return [n for n in self.scene.holders.get(point, ()) if n != self.ground and n in self.sheet.poses]

    def _foot(self, point: str) -> float:
        """Direction of a pivot's foot: down, unless links are in the way."""
        here = self.places[point]
        ways = [phase(w) for w in self._ways(here)]

        def cost(angle: float) -> float:
            nearest = min((_turn(angle, way) for way in ways), default=math.pi)
            end = here + (symbols.FOOT_HEIGHT + 1.0) * complex(math.cos(angle), math.sin(angle))
            covered = sum(_inside(end, shape.corners) for shape in self.shapes)
            return FOOT[angle] + max(0.0, 0.9 - nearest) * 3 + 0.9 * covered

        return min(FOOT, key=cost)

    def _ways(self, here: complex) -> list[complex]:
        """Directions in which bars leave a place."""
        ways = []
        for shape in self.shapes:
            for a, b in shape.segments:
                length = abs(b - a)
                if length < 1e-9 or abs(cross(here - a, b - a)) / length > 1.0:
                    continue
                t = dot(here - a, b - a) / length
                if -1.0 <= t < length - 2.0:
                    ways.append(b - a)
                if 2.0 < t <= length + 1.0:
                    ways.append(a - b)
        return ways

    # -- links -------------------------------------------------------------------------------------------------------

    def _link(self, shape: Shape) -> Group:
        colour = self.colour(shape.link)
        parts: list[Primitive] = []
        stroke = (strokes.REDUNDANT if shape.redundant else strokes.LINK).coloured(colour)
        if shape.corners:
            corners = tuple(map(self.at, shape.corners))
            parts.append(Polygon(corners, "" if shape.redundant else strokes.tint(colour), stroke))
        hidden = {b.slide.b for b in self.bearings if b.slide.key in self.cylinders}
        if shape.link not in hidden:
            parts += [Line(self.at(start), self.at(end), stroke) for start, end in shape.bars]
            parts += self._welds(shape, colour)
        for start, end in shape.slots:
            parts += symbols.slot(self.at(start), self.at(end), colour)
        for b in self.bearings:
            if b.slide.b == shape.link and b.slide.key in self.cylinders:
                parts += self._cylinder(b, colour)
        for b in self.bearings:
            if b.slide.a == shape.link and not b.slide.slot and b.slide.key not in self.cylinders:
                parts += self._block(b)
            if b.slide.a == shape.link and b.slide.key in self.cylinders:
                pivot = self._pivot(b)
                far = pivot + 0.6 * (b.at - pivot)
                parts.append(Line(self.at(far), self.at(b.at), strokes.LINK.coloured(colour)))
        return Group(tuple(parts), id=f"link-{shape.link}", classes=("link",))

    def _welds(self, shape: Shape, colour: str) -> list[Primitive]:
        """Filled corners where two bars of one link meet at an angle with no joint between them."""
        parts: list[Primitive] = []
        for i, (a, b) in enumerate(shape.bars):
            for p, q in shape.bars[i + 1 :]:
                for corner, far in ((p, q), (q, p)):
                    e = (b - a) / abs(b - a)
                    if abs(cross(corner - a, e)) > 1e-3 or abs(cross((far - corner) / abs(far - corner), e)) < 0.1:
                        continue
                    if any(abs(corner - z) < 1.0 for z in self.places.values()):
                        continue
                    along = b if abs(b - corner) > abs(a - corner) else a
                    parts += symbols.weld(self.at(corner), self.at(far), self.at(along), colour)
        return parts

    def _is_cylinder(self, b: Bearing) -> bool:
        if b.slide.b == self.ground or b.slide.slot:
            return False
        pivot = self._pivot(b)
        return abs(cross(b.at - pivot, b.along)) < 1e-3 and dot(b.at - pivot, b.along) > 12.0

    def _pivot(self, b: Bearing) -> complex:
        link = self.scene.by_name[b.slide.b]
        return next((self.places[p] for p in link.points if p in self.places), self.sheet.poses[b.slide.b].origin)

    def _cylinder(self, b: Bearing, colour: str) -> tuple[Primitive, ...]:
        return symbols.cylinder(self.at(self._pivot(b)), self.at(b.at), colour)

    # -- joints ------------------------------------------------------------------------------------------------------

    def _joints(self) -> Iterator[Primitive]:
        blocks = {b.slide.pin for b in self.bearings if not b.slide.slot}
        for point, z in self.places.items():
            moving = self._moving(point)
            held = [n for n in self.scene.holders.get(point, ()) if n in self.sheet.poses or n == self.ground]
            parts: list[Primitive] = []
            if len(held) > 1 and moving:
                radius = symbols.JOINT_RADIUS * (0.85 if point in blocks else 1.0)
                parts += self._over_block(z) if point in blocks else []
                parts += symbols.turning_pair(self.at(z), radius=radius)
                parts += self._through(z, held)
            elif any(p.point == point for p in self.scene.pins):
                parts += symbols.pin(self.at(z), self.colour(moving[0]) if moving else strokes.BLACK)
            elif moving:
                parts += symbols.pin(self.at(z), self.colour(moving[0]))
            elif not moving:
                parts += self._cross(z)
            yield Group(tuple(parts), id=f"point-{point}", classes=("point",))
            away = -sum((w / abs(w) for w in self._ways(z)), 0j)
            letter = symbol(self.letters.point(point))
            text = Text(0j, letter, "start", strokes.BLACK, f"label-point-{point}", ("label",))
            self.names.append(Name(Label(text, self.at(z), (phase(away),) if abs(away) > 0.1 else ()), 0))

    def _cross(self, z: complex) -> list[Primitive]:
        thin = strokes.OUTLINE
        return [Line(self.at(z - 1.2), self.at(z + 1.2), thin), Line(self.at(z - 1.2j), self.at(z + 1.2j), thin)]

    def _over_block(self, z: complex) -> list[Primitive]:
        """Edges of areas that end in the pin of a block, drawn on over it."""
        parts: list[Primitive] = []
        for shape in self.shapes:
            for i, corner in enumerate(shape.corners):
                if abs(corner - z) < 1e-6:
                    stroke = strokes.LINK.coloured(self.colour(shape.link))
                    for other in (shape.corners[i - 1], shape.corners[(i + 1) % len(shape.corners)]):
                        reach = min(symbols.BLOCK_LENGTH * 0.7, abs(other - z))
                        parts.append(Line(self.at(z), self.at(z + reach * (other - z) / abs(other - z)), stroke))
        return parts

    def _through(self, z: complex, held: list[str]) -> list[Primitive]:
        """A bar that goes on beyond a joint is drawn through its circle."""
        parts: list[Primitive] = []
        for shape in self.shapes:
            if shape.link not in held:
                continue
            for a, b in shape.bars:
                e = (b - a) / abs(b - a)
                if abs(cross(z - a, e)) < 1e-3 and 2.0 < dot(z - a, e) < abs(b - a) - 2.0:
                    r = symbols.JOINT_RADIUS
                    stroke = strokes.LINK.coloured(self.colour(shape.link))
                    parts.append(Line(self.at(z - r * e), self.at(z + r * e), stroke))
        return parts

    def _name_links(self) -> None:
        for shape in self.shapes:
            text = Text(0j, plain(shape.link, bold=True), "start", self.colour(shape.link),
                        f"label-link-{shape.link}", ("label", "link-number"))
            whole = self._cylinder_part(shape.link) or shape.longest
            block = next((b.at for b in self.bearings if b.slide.a == shape.link), None)
            if whole is not None:
                self.names.append(Name(Label(text, (self.at(whole[0]), self.at(whole[1]))), 1))
            elif block is not None:
                self.names.append(Name(Label(text, self.at(block)), 1))
        written = {name for step in self.sheet.equations for side in step.sides for term in side
                   if term.direction and len(term.direction.names) == 1 for name in term.direction.names}
        for b in self.bearings:
            if b.slide.guide.name in written:
                edge = GUIDE_LENGTH / 2 if b.slide.b == self.ground else 7.0
                text = Text(0j, symbol(self.letters.guide(b.slide.guide.name, self.ground), 3.0), "start",
                            strokes.BLACK, f"label-guide-{b.slide.b}-{b.slide.guide.name}", ("label",))
                written.discard(b.slide.guide.name)
                end = self.at(b.at + edge * b.along)
                self.names.append(Name(Label(text, end, (phase(b.along),)), 1))
        spots = [self.places[p] for p in self.scene.frame.points if self._moving(p)]
        spots += [b.at for b in self.bearings if self.ground in (b.slide.b, b.slide.a)]
        if spots:
            point = next((p for p in self.scene.frame.points if self._moving(p)), None)
            away = complex(math.cos(self._foot(point)), math.sin(self._foot(point))) * 5 if point else 3.6j
            text = Text(0j, plain(self.ground, bold=True), "start", strokes.BLACK,
                        f"label-link-{self.ground}", ("label", "link-number"))
            self.names.append(Name(Label(text, self.at(spots[0] + away), (phase(away),)), 1))

    def _cylinder_part(self, link: str) -> tuple[complex, complex] | None:
        """The barrel or the rod of a cylinder."""
        for b in self.bearings:
            if b.slide.key in self.cylinders and link in (b.slide.a, b.slide.b):
                pivot = self._pivot(b)
                far = pivot + 0.6 * (b.at - pivot)
                return (pivot, far) if link == b.slide.b else (far, b.at)
        return None

    # -- senses ------------------------------------------------------------------------------------------------------

    def _drivers(self) -> Iterator[Primitive]:
        for driver in self.scene.drivers:
            if isinstance(driver, AngleDriver):
                if driver.omega and driver.link in self.sheet.poses:
                    markup = f"ω_{{{driver.link}}}"
                    if driver.relative_to != self.ground:
                        markup = f"ω_{{{driver.link}{driver.relative_to}}}"
                    centres = self._centres_of_turn(driver.link, driver.relative_to)
                    yield self._sense(centres, driver.link, 1 if driver.omega > 0 else -1, 1, markup,
                                      f"driver-{driver.link}", DRIVER_RADIUS)
            else:
                yield from self._slide_arrow(driver)

    def _slide_arrow(self, driver: SlideDriver) -> Iterator[Primitive]:
        b = next((b for b in self.bearings if b.slide.key == driver.key), None)
        if b is None or not driver.velocity:
            return
        way = b.along * (1 if driver.velocity > 0 else -1)
        side = 1j * b.along * 5.2
        tail, tip = self.at(b.at + side - 5 * way), self.at(b.at + side + 5 * way)
        head = arrowhead(tip, tip - tail, POINTER.head_length, 1.0, self.colour(b.slide.a))
        line = Line(tail, tip, Stroke(0.25, (), self.colour(b.slide.a)), covered=1.6)
        yield Group((line, head), id=f"driver-{driver.key.replace('/', '-')}", classes=("driver",))
        index = b.slide.a if b.slide.b == self.ground else b.slide.a + b.slide.b
        letter = "V" if self.letters.convention == "us" else "v"
        text = Text(0j, symbol(f"{letter}_{{{index}}}"), "start", strokes.BLACK,
                    f"label-driver-{driver.key.replace('/', '-')}", ("label",))
        self.names.append(Name(Label(text, (tail, tip), (phase(side),)), 0))

    def _found(self) -> Iterator[Primitive]:
        """Angular velocities and accelerations measured on the drawing."""
        for sign, own, heads in (("ω", self.sheet.omega, 1), ("α", self.sheet.alpha, 2)):
            for link, rate in own.items():
                if rate.vector is None or rate.same_as or "/" in link or abs(rate.value) < 1e-12:
                    continue
                centres = self._centres_of_turn(link, self.ground)
                kind = "omega" if heads == 1 else "alpha"
                sense = 1 if rate.value > 0 else -1
                yield self._sense(centres, link, sense, heads, f"{sign}_{{{link}}}", f"{kind}-{link}")

    def _centres_of_turn(self, link: str, other: str) -> list[complex]:
        """Where an arc of sense may stand: about the pivot of the link, else about places along it."""
        mine = self.scene.by_name[link].points
        theirs = self.scene.by_name[other].points
        for point in mine:
            if point in theirs and point in self.places:
                return [self.places[point]]
        shape = next((s for s in self.shapes if s.link == link), None)
        if shape is not None and shape.corners:
            return [sum(shape.corners, 0j) / len(shape.corners)]
        if shape is not None and shape.longest is not None:
            a, b = shape.longest
            return [a + share * (b - a) for share in (0.5, 0.34, 0.66)]
        return [self.sheet.poses[link].origin]

    def _sense(
        self, centres: list[complex], link: str, sense: int, heads: int, markup: str, id: str, radius: float = RADIUS
    ) -> Group:
        centre, radius, middle = self.clearance.arc(centres, radius)
        parts = symbols.sense_arc(self.at(centre), radius, middle, sense, colour=self.colour(link), heads=heads)
        text = Text(0j, symbol(markup), "start", strokes.BLACK, f"label-{id}", ("label",))
        top = self.at(centre + radius * complex(math.cos(middle), math.sin(middle)))
        self.names.append(Name(Label(text, top, (middle,)), 0))
        return Group(parts, id=id, classes=("sense",))

    def _clearance(self) -> Clearance:
        """Everything that arcs keep clear of."""
        segments = [segment for shape in self.shapes for segment in shape.segments]
        segments += [(z, z + 0.01) for z in self.places.values()]
        for point in self.scene.frame.points:
            if self._moving(point):
                z, foot = self.places[point], self._foot(point)
                down = complex(math.cos(foot), math.sin(foot))
                end = z + symbols.FOOT_HEIGHT * down
                segments += [(z, end + 3.2j * down), (z, end - 3.2j * down), (end + 4.5j * down, end - 4.5j * down)]
        for b in self.bearings:
            reach = GUIDE_LENGTH / 2 if self.ground in (b.slide.a, b.slide.b) else symbols.BLOCK_LENGTH / 2
            side = 1j * b.along * symbols.BLOCK_WIDTH / 2
            segments += [(b.at + s * side - reach * b.along, b.at + s * side + reach * b.along) for s in (-1, 1)]
        return Clearance(segments)

    # -- construction ------------------------------------------------------------------------------------------------

    def _construction(self) -> Iterator[Primitive]:
        """Compass arcs near the points that they find."""
        for step in self.sheet.steps:
            if step.diagram != "mechanism":
                continue
            for arc in (s for s in step.strokes if isinstance(s, Compass)):
                if arc.radius < 1e-9:
                    continue
                middle, half = phase(arc.at - arc.centre), min(COMPASS / arc.radius, math.pi * 0.9)
                shape = Arc(self.at(arc.centre), arc.radius, middle - half, middle + half, strokes.CONSTRUCTION)
                yield Group((shape,), classes=("compass", f"step-{step.number:02d}"))


def _inside(z: complex, corners: tuple[complex, ...]) -> bool:
    """Whether a place lies in a convex area whose corners run counter-clockwise."""
    ends = zip(corners, (*corners[1:], *corners[:1]), strict=True)
    return len(corners) > 2 and all(cross(b - a, z - a) > 0 for a, b in ends)


def _turn(a: float, b: float) -> float:
    """Angle between two directions (rad, 0 to pi)."""
    return abs((a - b + math.pi) % (2 * math.pi) - math.pi)
