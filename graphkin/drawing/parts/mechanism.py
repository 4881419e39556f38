"""The drawn mechanism: its frame and links, its points with their letters, names of links and guides, dimensions, its
compass arcs; the arcs of driving and found angular velocities and accelerations, clear of bars, joints, feet and each
other, and the arrows of driven slides; and for groups larger than a dyad trial positions with the curve of the free
end, and lines to special points.  It is cut to its room if necessary.
"""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Collection, Iterator
from itertools import combinations

from graphkin.account.given import slide_index
from graphkin.account.notation import Notation
from graphkin.account.voice import SAME
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import Bar, CompassArc, Curve
from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import (
    Arc,
    Circle,
    Group,
    Line,
    Polygon,
    Polyline,
    Primitive,
    Segment,
    Stroke,
    on_page,
    page_direction,
)
from graphkin.drawing.ink.symbols import POINTER, arrowhead
from graphkin.drawing.parts import touching
from graphkin.drawing.parts.dimensioning import drawn_lengths
from graphkin.drawing.parts.mechanism_on_paper import GUIDE_LENGTH, LinkShape, MechanismOnPaper
from graphkin.drawing.parts.polygon import same_place
from graphkin.drawing.place.labels import Label, Mark, mapped
from graphkin.drawing.place.obstacles import clearest_arc
from graphkin.drawing.place.piece import Piece, cut_to, dated, ink_box, joined, kept_in, middle_of
from graphkin.drawing.text import plain, rich
from graphkin.plane import added_up, cross, dot, unit
from graphkin.scene.model import Driver
from graphkin.words.symbols import rate, sign

AROUND_POINTS = 5.0  # mm for the symbols of points, which no edge cuts


def links(here: MechanismOnPaper) -> Piece:
    """All links, areas first, so that feet of pivots stand on them and bars lie over them."""
    areas = [_link(here, shape) for shape in here.shapes if shape.corners]
    bars = sorted((shape for shape in here.shapes if not shape.corners), key=lambda shape: _depth(here, shape))
    under = *touching.profiles(here), *areas, _frame(here), *touching.circular_slots(here)
    return Piece({"mechanism": (*under, *(_link(here, shape) for shape in bars))})


def links_alone(
    here: MechanismOnPaper, names: Collection[str], rank: int, replaced: bool = False
) -> tuple[list[Primitive], list[Label]]:
    """Areas and bars of some links cut free, with their numbers as labels of a ``rank``; pairs are left to the caller,
    with ``replaced`` also the contacts that slide on another link's outline."""
    parts = [] if replaced else touching.cams_alone(here, names)
    labels: list[Label] = []
    for shape in here.shapes:
        if shape.link not in names:
            continue
        colour = here.colour(shape.link)
        stroke = strokes.LINK.coloured(colour)
        if shape.corners:
            parts.append(Polygon(tuple(map(on_page, shape.corners)), strokes.tint(colour), stroke))
        parts += [Line.between(a, b, stroke) for a, b in shape.bars]
        parts += touching.outlines_of(here, shape.link, replaced)
        if shape.longest or here.scene.higher_pairs:
            mark = shape.longest or here.sheet.poses[shape.link].origin
            labels.append(Label.of(plain(shape.link, bold=True), mapped(mark, on_page), colour=colour, rank=rank))
    return parts, labels


def _depth(here: MechanismOnPaper, shape: LinkShape) -> int:
    """The order of drawing: a block lies over its guide, and under links that end in its pin."""
    if any(b.slide.b == shape.link for b in here.sliders):
        return 0
    if any(b.slide.a == shape.link for b in here.sliders):
        return 1 + here.nested(shape.link)
    return 9


def _frame(here: MechanismOnPaper) -> Group:
    parts: list[Primitive] = []
    for point, foot in here.feet.items():
        parts += symbols.fixed_pivot(on_page(here.places[point]), foot)
    for b in here.sliders:
        if b.slide.higher and b.slide.b == here.ground:
            reach = GUIDE_LENGTH / 2 * b.along
            parts += symbols.slot(on_page(b.at - reach), on_page(b.at + reach))
            parts += symbols.guide(on_page(b.at), phase(b.along), GUIDE_LENGTH, symbols.SLOT_WIDTH)
        elif here.ground in (b.slide.a, b.slide.b):
            parts += symbols.guide(on_page(b.at), phase(b.along), GUIDE_LENGTH)
    parts += [*touching.outlines_of(here, here.ground), *touching.faces_of_frame(here)]
    return Group(tuple(parts), id=f"link-{here.ground}", classes=("frame",), since=here.since(here.ground))


def _link(here: MechanismOnPaper, shape: LinkShape) -> Group:
    colour = here.colour(shape.link)
    parts: list[Primitive] = []
    stroke = (strokes.REDUNDANT if shape.redundant else strokes.LINK).coloured(colour)
    if shape.corners:
        corners = tuple(map(on_page, shape.corners))
        clear = shape.redundant or here.scene.question.background is not None  # what a scan shows is seen through it
        parts.append(Polygon(corners, "" if clear else strokes.tint(colour), stroke))
    parts += touching.outlines_of(here, shape.link)
    barrels = [b for b in here.sliders if b.slide.b == shape.link and b.slide.key in here.cylinders]
    if not barrels:
        parts += [Line.between(start, end, stroke) for start, end in shape.bars]
        texture = strokes.texture(here.scene.order[shape.link])  # distinguishes its lines in black and white
        if texture is not None and not shape.redundant:
            parts += [Line.between(start, end, texture) for start, end in (*shape.bars, *shape.edges)]
        parts += _welds(here, shape, colour)
    for start, end in shape.slots:
        parts += symbols.slot(on_page(start), on_page(end), colour)
    parts += touching.block_on_circle(here, shape.link)
    for b in barrels:
        parts += symbols.cylinder(on_page(here.pivot(b)), on_page(b.at), colour)
    for b in (slider for slider in here.sliders if slider.slide.a == shape.link):
        if b.slide.key in here.cylinders:
            parts.append(Line.between(*here.rod(b), strokes.LINK.coloured(colour)))
        elif not b.slide.higher:
            shrink = 0.72 ** here.nested(shape.link)
            size = symbols.BLOCK_LENGTH * shrink, symbols.BLOCK_WIDTH * shrink
            parts += symbols.block(on_page(b.at), phase(b.along), colour, *size)
    return Group(tuple(parts), id=f"link-{shape.link}", classes=("link",), since=here.since(shape.link))


def _welds(here: MechanismOnPaper, shape: LinkShape, colour: str) -> list[Primitive]:
    """Filled corners where two bars of one link meet at an angle with no joint between them."""
    parts: list[Primitive] = []
    for (a, b), bar in combinations(shape.bars, 2):
        for corner, far in (bar, bar[::-1]):
            e = unit(b - a)
            if abs(cross(corner - a, e)) > 1e-3 or abs(cross(unit(far - corner), e)) < 0.1:
                continue
            if all(abs(corner - z) >= 1.0 for z in here.places.values()):
                along = b if abs(b - corner) > abs(a - corner) else a
                parts.append(symbols.weld(on_page(corner), on_page(far), on_page(along), colour))
    return parts


def joints(here: MechanismOnPaper, without: Collection[str] = ()) -> Piece:
    """Every point except some with its symbol, and its letters as labels."""
    pieces = [Piece({"mechanism": ()})]
    for point in here.places:
        if point not in without:
            since = here.found.get(point)
            drawn = Group(tuple(_joint(here, point)), id=f"point-{point}", classes=("point",), since=since)
            pieces.append(Piece({"mechanism": (drawn,)}, (_letter(here, point, since),)))
    return joined(pieces)


def _joint(here: MechanismOnPaper, point: str) -> list[Primitive]:
    z, moving = here.places[point], here.moving(point)
    held = [n for n in here.scene.holders.get(point, ()) if n in moving or n == here.ground]
    if len(held) > 1 and moving:
        on_block = point in {b.slide.pin for b in here.sliders if not b.slide.higher}
        radius = symbols.JOINT_RADIUS * (0.85 if on_block else 1.0)
        circle = symbols.turning_pair(on_page(z), radius=radius)
        return [*(_over_block(here, z) if on_block else ()), *circle, *_through(here, z, held)]
    if moving:
        return [*symbols.pin(on_page(z), here.colour(moving[0]))]
    if point in here.scene.contact_at:
        return [Circle(on_page(z), 0.5, fill=strokes.BLACK)]
    if any(s.higher and s.pin == point for s in here.scene.slides):
        return [*symbols.pin(on_page(z), strokes.BLACK)]
    thin = strokes.OUTLINE
    return [Line.between(z - 1.2, z + 1.2, thin), Line.between(z - 1.2j, z + 1.2j, thin)]


def _letter(here: MechanismOnPaper, point: str, since: int | None) -> Label:
    z = here.places[point]
    away = -added_up(map(unit, here.ways(z)), 0j)
    letter, toward = rich(here.letters.point(point)), (phase(away),) if abs(away) > 0.1 else ()
    return Label.of(letter, on_page(z), f"label-point-{point}", toward=toward, since=since)


def _over_block(here: MechanismOnPaper, z: complex) -> list[Primitive]:
    """Edges of areas that end in the pin of a block, drawn over the block."""
    parts: list[Primitive] = []
    for shape in here.shapes:
        for i, corner in enumerate(shape.corners):
            if abs(corner - z) < 1e-6:
                stroke = strokes.LINK.coloured(here.colour(shape.link))
                for other in (shape.corners[i - 1], shape.corners[(i + 1) % len(shape.corners)]):
                    reach = min(symbols.BLOCK_LENGTH * 0.7, abs(other - z))
                    parts.append(Line.between(z, z + reach * unit(other - z), stroke))
    return parts


def _through(here: MechanismOnPaper, z: complex, held: list[str]) -> list[Primitive]:
    """A bar that continues beyond a joint is drawn through its circle."""
    parts: list[Primitive] = []
    for shape in (shape for shape in here.shapes if shape.link in held):
        for a, b in shape.bars:
            e = unit(b - a)
            if abs(cross(z - a, e)) < 1e-3 and 2.0 < dot(z - a, e) < abs(b - a) - 2.0:
                r = symbols.JOINT_RADIUS
                stroke = strokes.LINK.coloured(here.colour(shape.link))
                parts.append(Line.between(z - r * e, z + r * e, stroke))
    return parts


def link_names(here: MechanismOnPaper, panel: Box | None = None) -> Piece:
    """Numbers of links and frame, letters of guides that occur in equations: at the edge of a panel that cuts these."""
    return Piece(labels=(*_numbers(here), *_guides(here, panel), *_frame_name(here)))


def _number(here: MechanismOnPaper, link: str, mark: Mark, *toward: float) -> Label:
    """The number of a link at a part of it."""
    return Label.of(plain(link, bold=True), mapped(mark, on_page), f"label-link-{link}", colour=here.colour(link),
                    rank=1, toward=toward, classes=("link-number",), since=here.since(link))


def _numbers(here: MechanismOnPaper) -> Iterator[Label]:
    for shape in here.shapes:
        mark: Mark | None = _cylinder_part(here, shape.link) or shape.longest
        if mark is None:
            mark = next((b.at for b in here.sliders if b.slide.a == shape.link), None)
        if mark is None:
            mark = touching.within_round_body(here, shape.link)
        if mark is not None:
            yield _number(here, shape.link, mark)


def _cylinder_part(here: MechanismOnPaper, link: str) -> tuple[complex, complex] | None:
    """The barrel or the rod of a cylinder."""
    for b in here.sliders:
        if b.slide.key in here.cylinders and link in (b.slide.a, b.slide.b):
            rod = here.rod(b)
            return (here.pivot(b), rod[0]) if link == b.slide.b else rod
    return None


def _guides(here: MechanismOnPaper, panel: Box | None) -> Iterator[Label]:
    written = {
        name for step in here.sheet.equations for side in step.sides for term in side
        if term.direction and len(term.direction.names) == 1 for name in term.direction.names
    }
    written |= {guide.name for guide in here.scene.frame.guides.values()}  # the given data name them
    for b in here.sliders:
        name = b.slide.guide_name
        if name in written:
            written.discard(name)
            edge = GUIDE_LENGTH / 2 if b.slide.b == here.ground else 7.0
            # a block that stands for a cam slides along the face of its follower
            face = next((touch.point for touch in here.touching.cams if touch.cam.flat
                         and touch.cam.follower == b.slide.b and b.slide.key in here.replaced_pairs), None)
            start, edge = (b.at, edge) if face is None else (face, touching.FLAT)
            letter = rich(here.letters.guide(name, here.ground), 3.0)
            ends = on_page(start), on_page(start + edge * b.along)
            inside = panel.grown(-0.5).clip(*ends) if panel is not None else ends
            id = f"label-guide-{b.slide.b}-{name}"
            yield Label.of(letter, (inside or ends)[1], id, toward=(phase(b.along),))


def _frame_name(here: MechanismOnPaper) -> Iterator[Label]:
    spots = [here.places[pivot] for pivot in here.feet]
    spots += [b.at for b in here.sliders if here.ground in (b.slide.b, b.slide.a)]
    if spots:
        foot = next(iter(here.feet.values()), None)
        away = 3.6j if foot is None else complex(math.cos(foot), math.sin(foot)) * 5
        yield _number(here, here.ground, spots[0] + away, phase(away))
    elif (face := touching.beside_face_of_frame(here)) is not None:
        at, into = face
        yield _number(here, here.ground, at, phase(into))


def mechanism_piece(sheet: Sheet, letters: Notation, room: tuple[float, float] | None = None) -> tuple[Piece, Box]:
    """Draw the mechanism about the world's origin.

    Parameters
    ----------
    room : width and height (mm) of its panel; None for its own size

    Returns
    -------
    the piece, and its box (mm, y down) without names.  If it does not fit the room, dimensions are left out first, then
    strokes far beyond its points are cut at the edge of the room.
    """
    here = MechanismOnPaper(sheet, letters)
    marks, trials = touching.contact_marks(here), trial_marks_in_mechanism(sheet)
    bare = joined((marks, links(here), _springs(here), compass_arcs(here), trials, joints(here), rate_arrows(here)))
    around = ink_box(bare.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    if room is None or _fits(around, room):
        piece = _with_lengths(here, bare, None, room)
        if piece is not None:
            box = ink_box(piece.drawn) or around
            if room is None or _fits(box, room):
                return piece, box
        assert room is not None  # without one everything fits
        centres = [around.centre]
    else:
        points = Box.around(on_page(z) for z in sheet.points.values())
        centres = [_least_cut(around, points, room), points.centre]
    half = complex(*room) / 2
    panels = [Box.around((centre - half, centre + half)) for centre in centres]
    panel = max(panels, key=lambda box: kept_in(bare, box))
    piece = _with_lengths(here, bare, panel) or bare
    layers = {name: cut_to(things, panel, bodies=True) for name, things in piece.layers.items()}
    names = tuple(n for n in piece.labels if panel.distance(middle_of(n.mark)) == 0.0)
    return Piece(layers, names, piece.marks), panel


def _least_cut(ink: Box, points: Box, room: tuple[float, float]) -> complex:
    """The middle of a room around points with their symbols that cuts the fewest strokes."""
    right = max(0.0, (room[0] - points.width) / 2 - AROUND_POINTS)
    down = max(0.0, (room[1] - points.height) / 2 - AROUND_POINTS)
    shift = ink.centre - points.centre
    return points.centre + complex(max(-right, min(right, shift.real)), max(-down, min(down, shift.imag)))


def _fits(box: Box, room: tuple[float, float]) -> bool:
    return box.width <= room[0] and box.height <= room[1]


def bare_mechanism(sheet: Sheet, letters: Notation) -> Piece:
    """Frame, links and points of the mechanism with their names, about the world's origin: without lengths, rate
    arrows, and special points, which only its polygons need."""
    here = MechanismOnPaper(sheet, letters)
    special = sheet.special_points
    return joined((links(here), _springs(here), joints(here, special), link_names(here), _marks(here)))


def _marks(here: MechanismOnPaper) -> Piece:
    return Piece(marks=tuple(on_page(z) for z in here.places.values()))


def _with_lengths(
    here: MechanismOnPaper, bare: Piece, panel: Box | None, most: tuple[float, float] | None = None
) -> Piece | None:
    drawn = [part for layer in ("construction", "mechanism", "answers") for part in bare.layers[layer]]
    lengths = drawn_lengths(here, drawn, panel, most)
    if lengths is None:
        return None
    return joined((bare, dated(lengths, here.stands), link_names(here, panel), _marks(here)))


LEAST_RADII = {"mechanism": 6.5, "answers": 5.5}  # mm, of the arcs of drivers and of measured rates


def _in_the_way(here: MechanismOnPaper) -> Iterator[Segment]:
    """The strokes on the page from which arcs keep clear."""
    for shape in here.shapes:
        yield from ((on_page(a), on_page(b)) for a, b in shape.segments)
    yield from ((on_page(z), on_page(z) + 0.01) for z in here.places.values())
    for point, foot in here.feet.items():
        at, down = on_page(here.places[point]), page_direction(foot)
        end = at + symbols.FOOT_HEIGHT * down
        yield from ((at, end + 3.2j * down), (at, end - 3.2j * down), (end + 4.5j * down, end - 4.5j * down))
    for b in here.sliders:
        reach = GUIDE_LENGTH / 2 if here.ground in (b.slide.a, b.slide.b) else symbols.BLOCK_LENGTH / 2
        at, along = on_page(b.at), on_page(b.along)
        for side in (symbols.BLOCK_WIDTH / 2 * 1j * along, -symbols.BLOCK_WIDTH / 2 * 1j * along):
            yield at + side - reach * along, at + side + reach * along


def rate_arrows(here: MechanismOnPaper) -> Piece:
    """Arrows of the drivers, and arcs of the angular velocities and accelerations measured on the drawing, clear of
    bars, joints, feet and each other."""
    around, pieces = [*_in_the_way(here)], [Piece({"mechanism": (), "answers": ()})]

    def arc(layer: str, id: str, kind: str, link: str, other: str, turning: float, since: int | None) -> None:
        centres = [on_page(z) for z in _centres_of_turn(here, link, other)]
        (centre, radius, middle), taken = clearest_arc(centres, LEAST_RADII[layer], around)
        around.extend(taken)
        heads = 1 if kind == "omega" else 2
        sense, colour = 1 if turning > 0 else -1, here.colour(link)
        parts = symbols.sense_arc(centre, radius, middle, sense, colour=colour, heads=heads)
        index = link if other == here.ground else link + other
        letter, at = rich(rate(kind, index)), centre + radius * page_direction(middle)
        name = Label.of(letter, at, f"label-{id}", toward=(middle,), since=since)
        pieces.append(Piece({layer: (Group(parts, id=id, classes=("sense",), since=since),)}, (name,)))

    for driver in here.scene.drivers:
        link = driver.link
        if not driver.turns:
            pieces.append(_slide_arrow(here, driver))
        elif link in here.sheet.poses:
            for kind, tail, value in (("omega", "", driver.rate), ("alpha", "-alpha", driver.second)):
                if value:
                    arc("mechanism", f"driver-{link}{tail}", kind, link, driver.relative_to, value, here.since(link))
    drawn = [step for step in here.sheet.steps if step.finds_rate or step.reason == "given on plan"]
    numbers = {(step.kind, step.link): step.number for step in drawn}
    named = here.scene.whole.by_name  # not of bars that stand for cams
    for kind, rates in here.sheet.rates.items():
        for link, turning in rates.items():
            if turning.is_own and link in named and abs(turning.value) >= 1e-12:
                arc("answers", f"{kind}-{link}", kind, link, here.ground, turning.value, numbers.get((kind, link)))
    return joined(pieces)


def _slide_arrow(here: MechanismOnPaper, driver: Driver) -> Piece:
    b = next((b for b in here.sliders if b.slide.key == driver.key), None)
    if b is None or not driver.rate:
        return Piece()
    along = b.along * (1 if driver.rate > 0 else -1)
    side = 1j * b.along * 5.2
    tail, tip = on_page(b.at + side - 5 * along), on_page(b.at + side + 5 * along)
    colour, id = here.colour(b.slide.a), f"driver-{driver.key.replace('/', '-')}"
    head = arrowhead(tip, tip - tail, POINTER.head_length, 1.0, colour)
    line = Line(tail, tip, Stroke(0.25, (), colour), covered=1.6)
    letter = "V" if here.letters.convention == "us" else "v"
    letters = rich(sign(letter, slide_index(here.sheet, driver.key)))
    name = Label.of(letters, (tail, tip), f"label-{id}", toward=(phase(side),))
    piece = Piece({"mechanism": (Group((line, head), id=id, classes=("driver",)),)}, (name,))
    return dated(piece, here.since(driver.key.split("/")[0]))


def _centres_of_turn(here: MechanismOnPaper, link: str, other: str) -> list[complex]:
    """The centres for an arc of sense: the pivot of the link, else places along it."""
    theirs = here.scene.by_name[other].points
    for point in here.scene.by_name[link].points:
        if point in theirs and point in here.places:
            return [here.places[point]]
    shape = next((shape for shape in here.shapes if shape.link == link), None)
    if shape is None or shape.longest is None:
        return [here.sheet.poses[link].origin]
    if shape.corners:
        return [added_up(shape.corners, 0j) / len(shape.corners)]
    a, b = shape.longest
    return [a + share * (b - a) for share in (0.5, 0.34, 0.66)]


def _springs(here: MechanismOnPaper) -> Piece:
    """All springs between their points, with their names."""
    drawn, names = [], []
    for spring in here.scene.loading.springs:
        if not {*spring.links} <= {*here.sheet.poses}:
            continue
        poses = [(here.sheet.poses[link], at / here.sheet.scales.length) for link, at in spring.ends]
        a, b = (pose.place(at) for pose, at in poses)
        since = max((number for number in map(here.since, spring.links) if number), default=None)
        shape = symbols.PULLING[spring.kind](on_page(a), on_page(b))
        drawn.append(Group(shape, id=f"{spring.kind}-{spring.name}", classes=(spring.kind,), since=since))
        names.append(Label.of(plain(spring.name), (on_page(a), on_page(b)), f"label-{spring.kind}-{spring.name}",
                              rank=1, since=since))
    return Piece({"mechanism": tuple(drawn)}, tuple(names)) if drawn else Piece()


COMPASS = 7.0  # mm of arc to either side of what it finds
SPLINTER = math.sin(math.radians(15.0))  # a smaller angle of an arc to a bar looks like a splinter of the bar
CROSS = 0.9  # mm: half a cross that marks a trial position


def compass_arcs(here: MechanismOnPaper) -> Piece:
    """Compass arcs near the points that they find, drawn over a block that would hide all but their ends; from the foot
    of a tangent the line to its pivot."""
    under: list[Primitive] = [
        Group((Line.between(s.a, s.b, strokes.CONSTRUCTION),), classes=("tangent",), step=step.number)
        for step in here.steps if step.reason == "tangent" for s in step.each(Bar)
    ]
    over: list[Primitive] = []
    arcs = [(step, arc) for step in here.steps for arc in step.each(CompassArc) if arc.radius > 1e-9]
    bars: dict[complex, set[complex]] = {}
    for _, arc in arcs:
        bars.setdefault(same_place(arc.at), set()).add(unit(arc.centre - arc.at))
    for step, arc in arcs:
        middle = phase(arc.at - arc.centre)
        half = min(COMPASS / arc.radius, math.pi * 0.9)
        there = bars[same_place(arc.at)]
        shown = [not _along_a_bar(arc, side, there) for side in (-1, 1)]
        first, last = (half * (visible or not any(shown)) for visible in shown)
        shape = Arc(on_page(arc.centre), arc.radius, middle - first, middle + last, strokes.CONSTRUCTION)
        covered = any(abs(block.at - arc.at) < SAME for block in here.sliders)
        (over if covered else under).append(Group((shape,), classes=("compass",), step=step.number))
    return Piece({"construction": tuple(under), "mechanism": tuple(over)})


def _along_a_bar(arc: CompassArc, side: int, bars: set[complex]) -> bool:
    """Whether an arc to a side (1 counter-clockwise) begins nearly along a bar that meets it."""
    tangent = side * 1j * unit(arc.at - arc.centre)
    return any(dot(tangent, bar) > 0.0 and abs(cross(tangent, bar)) < SPLINTER for bar in bars)


def trial_marks_in_mechanism(sheet: Sheet) -> Piece:
    """Trial curves with their positions numbered, and the lines of legs drawn on to special points."""
    drawn: list[Primitive] = []
    over: list[Primitive] = []  # lines that run over the areas of links
    labels: list[Label] = []
    curves = 0
    for step in sheet.of("mechanism"):
        if step.reason == "special point":
            lines = tuple(
                Line.between(s.a, s.b, strokes.DIRECTION) for s in step.each(Bar) if abs(s.b - s.a) > SAME
            )
            over.append(Group(lines, id=f"special-{step.point}", classes=("special",), step=step.number))
        for curve in step.each(Curve):
            curves += 1
            parts: list[Primitive] = [Polyline(tuple(map(on_page, curve.curve)), strokes.TRIAL_CURVE)]
            for number, z in enumerate(curve.at, 1):
                parts += [Line.between(z + w, z - w, strokes.CONSTRUCTION) for w in (CROSS, 1j * CROSS)]
                name = f"label-trial-{curve.point}-{number}"
                numeral = rich(str(number), 2.0)
                labels.append(Label.of(numeral, on_page(z), name, colour=strokes.GREY, rank=4, classes=("trial",),
                                       since=step.number))
            id = f"trial-curve-{curve.point}" + (f"-{curves}" if curves > 1 else "")
            drawn.append(Group(tuple(parts), id=id, classes=("trial",), step=step.number))
        if step.reason == "positions":
            bars = [Line.between(goal.a, goal.b, strokes.DIRECTION) for goal in step.each(Bar)]
            drawn += [Group((bar,), classes=("trial",), step=step.number) for bar in bars]
    return Piece({"construction": tuple(drawn), "mechanism": tuple(over)}, tuple(labels))
