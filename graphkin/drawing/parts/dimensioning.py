"""The dimensioned lengths and angles of a mechanism, after ISO 129-1: given bars, the places of the frame's points and
guides, the angles and travels of the drivers, places and angles of sliding links; each drawn where it has room, or
written at its bar.
"""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain, pairwise, product
from typing import TypeAlias

from graphkin.account.given import along_its_guide, as_line, off_its_guide, slide_index, used_guides
from graphkin.account.headings import number
from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Line, Primitive, Run, on_page
from graphkin.drawing.parts.mechanism_on_paper import GUIDE_LENGTH, MechanismOnPaper, Slider
from graphkin.drawing.place.dimensions import (
    GAP,
    LEAST_EXTENSION,
    OVERRUN,
    DimensionClearance,
    Part,
    Parts,
    angle_dimension,
    dimension,
)
from graphkin.drawing.place.labels import Label, Mark
from graphkin.drawing.place.piece import Piece, ink_box, obstacles_of
from graphkin.drawing.text import rich
from graphkin.plane import cross, cross_lines, dot
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.words.symbols import sign
from graphkin.words.written import as_given, printed

LENGTHS = "dimensions"  # id of their group
Dimensioner: TypeAlias = Callable[[MechanismOnPaper, DimensionClearance], Iterator[Parts | Label]]
Spot: TypeAlias = tuple[complex, float]
"""Where a dimension begins, on the page: a point, or the middle of a guide, with what is drawn of it to either side
(mm)."""
OFFSETS = (6.0, -6.0, 9.0, -9.0, 12.5, -12.5, 17.0, -17.0, 22.0, -22.0)  # mm from the bar
LEAST, SHORTEST = 9.0, 1.0  # mm: a shorter bar has its number beside it, a shorter distance in the frame no dimension
# mm from the mechanism to the dimensions of the frame, and from one of them to the next: usual, and where room is short
BESIDE = ((6.5, 6.0), (4.5, 4.5))
LINES = 4  # of dimensions beside each other that are tried
INSIDE = (7.0, 10.0, 14.0, 19.0, 25.0, 32.0)  # mm from its points, of one that has no room beside the mechanism
NEAR = 0.5  # mm: so near to its given place a hand has drawn what is fixed
SIZE = 2.8
ANGLE_RADII = (10.0, 13.0, 16.0, 20.0, 25.0, 31.0)
CLOSE_RADII = (8.0, 10.0, 13.0, 16.0, 20.0, 6.5)
WIDEST_ROUND = 16.0  # mm, of an angle beyond 180 degrees
SHARES = (0.5, 0.3, 0.7, 0.15, 0.85)  # of the arc, or the line, where its number may stand
LEAST_ARC = 1.0  # mm: on a shorter one nothing is seen of its arrowhead


def drawn_lengths(
    here: MechanismOnPaper, drawn: Iterable[Primitive], panel: Box | None, most: tuple[float, float] | None = None
) -> Piece | None:
    """Dimensions of the frame, bars, drivers and guides that have room; lengths of bars and values of drivers without
    room for a dimension are labels.  Drivers without room are placed again before all others.

    Parameters
    ----------
    drawn : the mechanism, of which the dimensions keep clear
    panel : no dimension leaves it
    most : greatest width and height (mm) of both together; without a piece where they take more
    """
    drawn = tuple(drawn)
    obstacles, around = obstacles_of(drawn), ink_box(drawn)

    def drawn_by(room: DimensionClearance, *kinds: Dimensioner) -> Iterator[Parts | Label]:
        return (part for kind in kinds for part in kind(here, room))

    room = DimensionClearance(obstacles, panel)
    usual = _placed(drawn_by(room, _frame, _bars, _angles, guide_dimensions, travels), around, most)
    if usual is None or not usual[1]:
        return usual and usual[0]
    room = DimensionClearance(obstacles, panel)
    driven = [*drawn_by(room, _angles, travels)]
    alone = _placed(driven, around, most)
    if alone is None or alone[1] >= usual[1]:  # others are not in their way
        return usual[0]
    drivers_first = _placed(chain(driven, drawn_by(room, _frame, _bars, guide_dimensions)), around, most)
    return min((usual, drivers_first or usual), key=lambda placed: placed[1])[0]


def _placed(
    dimensions: Iterable[Parts | Label], reach: Box | None, most: tuple[float, float] | None
) -> tuple[Piece, int] | None:
    """Dimensions as a piece, and the number of drivers without one; None where they and the mechanism take more than
    ``most``."""
    parts: list[Primitive] = []
    labels: list[Label] = []
    without = 0
    for part in dimensions:
        if isinstance(part, Label):
            without += part.text.id.startswith(DRIVEN)
            labels.append(part)
            continue
        parts += part
        if most is not None and (added := ink_box(part)) is not None:
            reach = added if reach is None else reach.joined(added)
            if reach.width > most[0] or reach.height > most[1]:
                return None
    return Piece({"mechanism": (Group(tuple(parts), id=LENGTHS),)}, tuple(labels)), without


def _bars(here: MechanismOnPaper, room: DimensionClearance) -> Iterator[Parts | Label]:
    """Lengths of bars, and distances of further points from them, as many as a link needs, round ones first."""
    places, scene = here.places, here.scene.whole
    for link in scene.links:
        if link.redundant:
            continue
        spans, corners = _spans(link, here.scene.units.metres)
        if len(link.bar) < 2 and along_its_guide(scene, link):
            beside = off_its_guide(scene, link)  # dimensioned along their guide
            spans = [span for span in spans if span[1] not in beside]
        for start, at, end in (corner for corner in corners if places.keys() >= {*corner}):
            turn, first = _angle(link, start, at, end), phase(places[start] - places[at])
            parts = _turned(room, on_page(places[at]), (first,), turn, ANGLE_RADII)
            if parts is not None:
                yield parts
        for near, far in spans:
            if near not in places or far not in places or abs(places[near] - places[far]) < 1.0:
                continue
            ends = on_page(places[near]), on_page(places[far])
            value = _distance(link, near, far) / here.scene.units.metres
            runs = rich(printed(as_given(value)), SIZE)
            long = abs(ends[1] - ends[0]) >= LEAST
            parts = room.take(dimension(*ends, offset, runs) for offset in OFFSETS) if long else None
            if parts is None and link.name in scene.replacing:  # no bar is drawn: its length is the radius of a slot
                runs, ends = rich(f"R {printed(as_given(value))}", SIZE), (ends[1], ends[1])
            yield parts or Label.of(runs, ends, f"label-length-{near}{far}", rank=1, classes=("length",))


def _spans(link: PlacedLink, metres: float) -> tuple[list[tuple[str, str]], list[tuple[str, str, str]]]:
    """The distances and angles that give a link: its bar, and each further point by a distance from one point of the
    bar if it lies on the bar; else from both, or by a distance and the angle there if these are round numbers."""
    spans = [(link.bar[0], link.bar[1])] if link.length is not None else []
    corners = []
    for further in (p for p in link.points if p not in link.bar):
        far = {p: _distance(link, p, further) / metres for p in link.bar}
        ends = sorted((p for p in link.bar if far[p] > 0.0), key=lambda p: not _round(far[p]))
        on_the_bar = abs(link.points[further].imag) < 1e-9 * abs(link.points[further])
        if len(ends) == 2 and not on_the_bar and not _round(far[ends[1]]):
            angle = math.degrees(_angle(link, ends[1], ends[0], further))
            if abs(angle - round(angle, 2)) < 1e-7:
                corners.append((ends[1], ends[0], further))
                ends = ends[:1]
        spans += [(p, further) for p in (ends[:1] if on_the_bar else ends)]
    return spans, corners


def _angle(link: PlacedLink, start: str, at: str, end: str) -> float:
    """From one point of a link to another about a third (rad, -pi to pi)."""
    z = link.points[at]
    return phase((link.points[end] - z) / (link.points[start] - z))


def _turned(
    room: DimensionClearance, at: complex, starts: Sequence[float], turn: float, radii: Sequence[float]
) -> Parts | None:
    """A turn (rad) about a place on the page from one of some directions."""
    runs = rich(f"{number(abs(math.degrees(turn)), 5)}°", SIZE)
    choices = product(_seen(radii, turn) or radii[::-1], starts)  # of one seen on none the number at least
    drawn = (angle_dimension(at, radius, start, start + turn, runs) for radius, start in choices)
    return room.take(drawn, 0, ends_on_line=True)


def _seen(radii: Sequence[float], turn: float) -> list[float]:
    """The radii (mm) on which an arrowhead is seen on the arc of a turn (rad)."""
    return [radius for radius in radii if radius * abs(turn) >= LEAST_ARC]


def _distance(link: PlacedLink, start: str, end: str) -> float:
    return abs(link.points[end] - link.points[start])


def _round(value: float) -> bool:
    """Whether a value looks like a given one: at most four digits."""
    return abs(float(f"{value:.4g}") - value) < 1e-9 * value


def _frame(here: MechanismOnPaper, room: DimensionClearance) -> Iterator[Parts]:
    """Distances of fixed points from the pivot of the driver, and of guides from the nearest fixed point: across below
    or above the mechanism, upright beside it."""
    scene = here.scene
    spots = {point: on_page(z) for point, z in here.places.items() if point in scene.frame.points}
    pivots = (p for driver in scene.drivers if driver.turns for p in scene.by_name[driver.link].points)
    datum = next((spots[p] for p in (*pivots, *scene.frame.points) if p in spots), None)
    guides: tuple[list[complex], list[complex]] = ([], [])
    on_guides: list[complex] = []  # points of what slides, on the line of its guide
    for slider in here.sliders:
        if slider.slide.b == scene.frame.name and slider.slide.guide.name:
            if abs(slider.along.imag) < 1e-9:
                guides[1].append(on_page(slider.at))
            elif abs(slider.along.real) < 1e-9:
                guides[0].append(on_page(slider.at))
            sliding = scene.by_name.get(slider.slide.a)  # none is the block of a pin, which has no other points
            ends = (here.places.get(p, slider.at) for p in (sliding.points if sliding else ()))
            on_guides += [on_page(z) for z in ends if abs(z - slider.at) > GUIDE_LENGTH / 2]
    for upright in (False, True):
        carried = (z for z in on_guides if any(abs(_part(z - guide, upright)) < 1e-5 for guide in guides[upright]))
        places = [(z, 0.0) for z in spots.values()]
        places += [(z, GUIDE_LENGTH / 2 - 4.0) for z in guides[upright]]
        places += [(z, 0.0) for z in carried]
        pairs = {_levels(datum, spot, upright) for spot in spots.values() if datum is not None and spot != datum}
        for guide in guides[upright] if spots else ():
            levels = {_levels(spot, guide, upright) for spot in spots.values()}
            pairs.add(min(levels, key=lambda pair: (pair[1] - pair[0], pair)))
        wide = [pair for pair in sorted(pairs) if pair[1] - pair[0] >= SHORTEST]
        whole = None
        if len(wide) > 1 and all(lower[1] == upper[0] for lower, upper in pairwise(wide)):
            whole = _beside(here, room, places, (*(low for low, _ in wide), wide[-1][1]), upright)
        if whole is not None:
            yield whole
            continue
        for pair in sorted(wide, key=lambda pair: pair[1] - pair[0]):
            parts = _beside(here, room, places, pair, upright)
            if parts is not None:
                yield parts


def _levels(first: complex, second: complex, upright: bool) -> tuple[float, float]:
    """The levels of two places: lower and upper, or left and right."""
    low, high = sorted((_part(first, upright), _part(second, upright)))
    return round(low, 6), round(high, 6)


def _part(z: complex, imaginary: bool) -> float:
    return z.imag if imaginary else z.real


def _beside(
    here: MechanismOnPaper, room: DimensionClearance, places: Sequence[Spot], levels: Sequence[float], upright: bool
) -> Parts | None:
    """The distances of levels, in order on a line beside the mechanism; inside it if there is no room, over other lines
    only if there is no other place."""
    box = room.content
    sides = (-1, 1) if upright else (1, -1)  # left first, and below
    left, right = (box.left, box.right) if upright else (box.top, box.bottom)
    spots = [[spot for spot in places if abs(_part(spot[0], upright) - level) < 1e-5] for level in levels]
    across = [_part(z, not upright) for each in spots for z, _ in each]
    low, high = min(across), max(across)
    lots = [
        [right + far if side > 0 else left - far for k in range(LINES) for side in sides for far in (near + k * pitch,)]
        for near, pitch in BESIDE
    ]
    within = [high + far if side > 0 else low - far for far in INSIDE for side in sides]
    within += [line for far in INSIDE for line in (low + far, high - far) if low < line < high]
    axes = (1j, 1 + 0j) if upright else (1 + 0j, 1j)
    given = [_given(here, level, upright) for level in levels]
    values = [rich(printed(as_given(high - low)), SIZE) for low, high in pairwise(given)]
    for lines, over_lines in (*((lot, False) for lot in lots), (within, False), (within, True)):
        shares = SHARES[:3] if over_lines else SHARES[:1]
        drawn = (_on_line(spots, levels, line, *axes, values, share) for share in shares for line in lines)
        taken = room.take((parts for parts in drawn if parts is not None), len(levels), over_lines=over_lines)
        if taken is not None:
            return taken
    return None


def _given(here: MechanismOnPaper, level: float, upright: bool) -> float:
    """The given value of a level (mm on paper) drawn by a hand, in its unit."""
    frame = here.scene.frame
    fixed = [*frame.points.values(), *(guide.through for guide in frame.guides.values())]
    given = [_part(on_page(z), upright) / here.sheet.scales.length for z in fixed]
    near = min(given, key=lambda mm: abs(mm - level), default=level)
    return (near if abs(near - level) < NEAR else level) * here.sheet.scales.length / here.scene.units.metres


def _angles(here: MechanismOnPaper, room: DimensionClearance) -> Iterator[Parts | Label]:
    """The angles of drivers, from the x axis or from the axis of another link."""
    for driver in here.scene.drivers:
        if not driver.turns or driver.link not in here.sheet.poses:
            continue
        points = here.scene.by_name[driver.relative_to].points
        pivot = next((here.places[p] for p in here.scene.by_name[driver.link].points if p in points), None)
        value = here.sheet.drivers[driver.key]
        # as it is given, else the shorter way
        turns = tuple(dict.fromkeys((math.fmod(value, 2 * math.pi), math.remainder(value, 2 * math.pi))))
        base = here.sheet.poses.get(driver.relative_to)
        if pivot is None:
            continue
        start = phase(base.axis) if base is not None else 0.0
        at, along = on_page(pivot), complex(math.cos(start), -math.sin(start))
        # rather an arc over the links than none
        arc = None
        for turn, (crossing, radii) in product(turns, ((False, ANGLE_RADII), (True, CLOSE_RADII))):
            runs = rich(f"{number(math.degrees(turn), 5)}°", SIZE)
            choices = (
                (Line(at + 2.2 * along, at + (radius + 3.0) * along, strokes.DIMENSION),
                 *angle_dimension(at, radius, start, start + turn, runs, share))
                for radius, share in product(_seen(radii, turns[-1]), SHARES)
                if radius <= WIDEST_ROUND or abs(turn) <= math.pi
            )
            arc = arc or room.take(choices, 1, over=True, ends_on_line=True, crossing=crossing)
        if arc is not None:
            yield arc
            continue
        index = driver.link if driver.relative_to == here.scene.frame.name else driver.link + driver.relative_to
        words = rich(sign("φ", index) + f" = {number(math.degrees(turns[0]), 5)}°", SIZE)
        yield driven_value(here, driver.key, words, at)


DRIVEN = "label-driven-"  # how the id of a driver's value begins where it is a label
FROM_GUIDE = (6.0, 9.0, 12.5, 17.0, 22.0, 28.0)  # mm from what is dimensioned
RADII = (8.0, 11.0, 14.0, 18.0, 23.0)
LEVEL = 1e-9


def guide_dimensions(here: MechanismOnPaper, room: DimensionClearance) -> Iterator[Parts]:
    """The dimensions of guides that have room: of the frame's guides, then of links."""
    scene = here.scene.whole
    shown = _shown(here)
    tried: list[Parts | None] = []
    slanted: set[str] = set()
    for slider in shown:
        frames = slider.slide.b == scene.frame.name and slider.slide.guide.name not in slanted
        if frames and slider.slide.guide.name and abs(slider.along.real * slider.along.imag) > LEVEL:
            slanted.add(slider.slide.guide.name)
            tried += [_off_pivot(here, room, slider), _slant(room, slider)]
    for parts in tried:
        if parts is not None:
            yield parts
    for link in scene.links:
        if link.name in here.sheet.poses and not link.redundant:
            yield from _on_link(here, scene, link, room, shown)


def travels(here: MechanismOnPaper, room: DimensionClearance) -> Iterator[Parts | Label]:
    """The travel of each driver along its guide, from the guide's origin; a label if there is no room for a
    dimension."""
    for slider in _shown(here):
        if slider.driven:
            key, pose = slider.slide.key, here.sheet.poses[slider.slide.b]
            value = here.sheet.drivers[key] / here.scene.units.metres
            start = pose.origin + pose.axis * slider.slide.guide.through / here.sheet.scales.length
            runs = rich(sign("s", slide_index(here.sheet, key)) + f" = {printed(as_given(value))}", SIZE)
            parts = _apart(room, (start,), (slider.at,), slider.along, abs(value), runs)
            yield parts or driven_value(here, key, runs, (on_page(start), on_page(slider.at)))


def driven_value(here: MechanismOnPaper, key: str, runs: tuple[Run, ...], mark: Mark) -> Label:
    """The value of a driver as a label; it is given, so all other labels give way to it."""
    id, since = f"{DRIVEN}{key.replace('/', '-')}", here.since(key.split("/")[0])
    return Label.of(runs, mark, id, since=since)


def _shown(here: MechanismOnPaper) -> list[Slider]:
    """The sliding pairs of the scene, without those that replace higher pairs."""
    keys = {pair.key for pair in here.scene.whole.slides}
    return [slider for slider in here.sliders if slider.slide.key in keys]


def _off_pivot(here: MechanismOnPaper, room: DimensionClearance, slider: Slider) -> Parts | None:
    """The distance of a slanted guide of the frame from the nearest fixed point, square to the guide."""
    frame = here.scene.frame
    guide = slider.slide.guide
    distances = {p: abs(cross(z - guide.through, guide.direction)) for p, z in frame.points.items() if p in here.places}
    if not distances:
        return None
    nearest = min(distances, key=lambda p: (distances[p], p))
    pivot = here.places[nearest]
    offset = (guide.through - frame.points[nearest]) / here.scene.units.metres
    for axis, given in ((1j, offset.imag), (1 + 0j, offset.real)):
        if abs(given) < LEVEL or abs(offset - given * axis) > LEVEL * abs(offset):
            continue  # the problem gives no distance straight from the pivot
        foot = pivot + given * axis * here.scene.units.metres / here.sheet.scales.length
        end = min((slider.at + s * GUIDE_LENGTH / 2 * slider.along for s in (1, -1)), key=lambda z: abs(z - foot))
        along = (Line.between(end, foot, strokes.DIMENSION),) if abs(end - foot) > SHORTEST else ()
        parts = _apart(room, (pivot,), (foot,), axis, abs(given), also=along)
        if parts is not None:
            return parts
    end = GUIDE_LENGTH / 2 * slider.along
    spots = (slider.at - end, slider.at + end)
    return _apart(room, (pivot,), spots, slider.along * 1j, distances[nearest] / here.scene.units.metres)


def _slant(room: DimensionClearance, slider: Slider) -> Parts | None:
    """The angle of a slanted guide of the frame with the horizontal, at either of its ends."""
    angle = as_line(slider.along)
    runs = rich(f"{number(abs(angle), 5)}°", SIZE)
    choices = []
    for sense in (1, -1):
        along = sense * slider.along
        level = math.copysign(1.0, along.real)
        start = 0.0 if level > 0 else math.pi
        corner = on_page(slider.at + (GUIDE_LENGTH / 2 + 0.5) * along)
        for radius in _seen(RADII, math.radians(angle)) or RADII[::-1]:
            further = radius + OVERRUN
            choices.append((
                Line(corner, corner + further * level, strokes.DIMENSION),
                Line(corner, corner + further * on_page(along), strokes.DIMENSION),
                *angle_dimension(corner, radius, start, start + math.radians(angle), runs),
            ))
    return room.take(choices, 2, ends_on_line=True)


def _on_link(
    here: MechanismOnPaper, scene: Mechanism, link: PlacedLink, room: DimensionClearance, shown: Sequence[Slider]
) -> Iterator[Parts]:
    """The places of a link's points and guides, and its angles, from the guide on which it slides."""
    pairs = along_its_guide(scene, link)
    pose, metres = here.sheet.poses[link.name], scene.units.metres
    tried: list[Parts | None] = []
    if pairs and len(link.bar) < 2:
        along = pose.axis / pairs[0].turn  # of the guide
        for point in off_its_guide(scene, link):
            z = link.points[point] * pairs[0].turn
            if point in here.places:
                ends = (pose.origin,), (here.places[point],)
                tried.append(_apart(room, *ends, along, abs(z.real) / metres))
                tried.append(_apart(room, *ends, along * 1j, abs(z.imag) / metres))
    if len(pairs) == 2:
        axes = [pose.axis / pair.turn for pair in pairs]
        tried.append(_guide_angle(room, pose.origin, axes[0], axes[1]))
    elif pairs and abs(pairs[0].turn.imag) > LEVEL and (  # its own axis is drawn: as a bar, or as a guide in use
        len(link.bar) == 2 or any(s.slide.b == link.name and not s.slide.guide.name for s in shown)
    ):
        tried.append(_guide_angle(room, pose.origin, pose.axis / pairs[0].turn, pose.axis))
    drawn = [end for shape in here.shapes if shape.link == link.name for segment in shape.segments for end in segment]
    for guide in used_guides(scene, link):
        on = next((s for s in shown if s.slide.b == link.name and s.slide.guide.name == guide.name), None)
        if on is None or (abs(cross(guide.direction, 1 + 0j)) < LEVEL and not link.bar):
            continue
        value = abs(cross(guide.through, guide.direction)) / metres
        if _round(value):  # as it is given, no result of slanted places
            tried.append(_apart(room, (pose.origin,), (on.at,), on.along * 1j, value))
        corner = cross_lines(pose.origin, pose.axis, on.at, on.along)
        if corner is None or abs(corner - pose.origin) <= GUIDE_LENGTH / 2:
            continue
        if sum(abs(end - corner) < NEAR for end in drawn) > 1:  # two drawn lines of the link meet there
            tried.append(_guide_angle(room, corner, pose.origin - corner, on.at - corner))
    yield from (parts for parts in tried if parts is not None)


def _guide_angle(room: DimensionClearance, at: complex, first: complex, second: complex) -> Parts | None:
    """The angle between two lines through a place, drawn from the first to the second the shorter way."""
    turn = phase(second / first)
    if abs(turn) > math.pi / 2 + LEVEL:  # between the lines, the smaller angle
        first, turn = -first, turn - math.copysign(math.pi, turn)
    return _turned(room, on_page(at), (phase(first), phase(-first)), turn, RADII)


def _apart(
    room: DimensionClearance, starts: Sequence[complex], ends: Sequence[complex], along: complex, value: float,
    runs: tuple[Run, ...] = (), also: Parts = (),
) -> Parts | None:
    """The distance of two places in a direction, y up, each measured from the nearest of some spots on its level; with
    its further strokes."""
    spots, along = [[(on_page(z), 0.0) for z in each] for each in (starts, ends)], on_page(along)
    aside = -1j * along
    levels = [dot(each[0][0], along) for each in spots]
    if abs(levels[1] - levels[0]) < SHORTEST:
        return None
    away = [dot(z, aside) for each in spots for z, _ in each]
    lines = [edge for far in FROM_GUIDE for edge in (max(away) + far, min(away) - far)]
    written_ = [runs or rich(printed(as_given(value)), SIZE)]
    drawn = (_on_line(spots, levels, line, along, aside, written_, also=also) for line in lines)
    return room.take((parts for parts in drawn if parts is not None), 2)


def _on_line(
    spots: Sequence[Sequence[Spot]], levels: Sequence[float], line: float, along: complex, aside: complex,
    values: Sequence[tuple[Run, ...]], share: float = 0.5, also: Parts = (),
) -> Parts | None:
    """Levels dimensioned in order on one line, each from its spot nearest to the line, the numbers at a share of it;
    None where the line runs through a spot.

    Parameters
    ----------
    levels, line : their distances along and across the line from the page's corner (mm)
    along, aside : directions on the page
    """
    feet = [level * along + line * aside for level in levels]
    parts: list[Part] = []
    for each, foot in zip(spots, feet, strict=True):
        far, at, reach = min(((line - dot(z, aside), z, reach) for z, reach in each), key=lambda s: abs(s[0]) - s[2])
        if abs(far) - reach < LEAST_EXTENSION:
            return None
        out = math.copysign(1.0, far) * aside
        parts.append(Line(at + (reach + GAP) * out, foot + OVERRUN * out, strokes.DIMENSION))
    parts += also
    for (p, q), runs in zip(pairwise(feet), values, strict=True):
        parts += dimension(p, q, 0.0, runs, share)
    return tuple(parts)
