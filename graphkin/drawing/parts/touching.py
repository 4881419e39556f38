"""Higher pairs on the drawn mechanism: discs, faces, cams, circular slots, pitch circles of wheels, tangent and normal
of contacts, and the links that replace them.

A pitch circle is dash-dotted (ISO 2203), an outline of the frame is hatched on the side of its body.
"""

from __future__ import annotations

import math
from cmath import phase, rect
from collections.abc import Collection, Iterable, Iterator

from graphkin.account.headings import term
from graphkin.construction.touching import CamOnPaper, Touch
from graphkin.drawing.ink import strokes, symbols
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polygon, Primitive, Stroke, on_page
from graphkin.drawing.parts.mechanism_on_paper import MechanismOnPaper
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.piece import Piece, dated
from graphkin.drawing.text import plain, rich
from graphkin.plane import added_up, unit
from graphkin.scene.pairs import CircularSlot
from graphkin.words.symbols import sign

NORMAL, TANGENT = 15.0, 12.0  # mm of normal and tangent to either side of a contact
FACE = 16.0  # mm of a face of the frame to either side of a contact
AT_CAM, FLAT = 9.0, 13.0
"""mm: how far normal and tangent of a cam go on beyond what they touch, and half the flat face of its follower."""
CURVED_ALONG = 16.0  # mm of a circular slot to either side of what runs in it
TOUCHING = 1e-6  # mm: centres so near lie on each other
HATCHES = 2.6  # mm of outline between two hatches of a hatched ring
IN_BODY = 0.6  # of its radius: how far from the centre of a round body, or the axis of a cam, its number stands


def outlines_of(here: MechanismOnPaper, link: str, replaced: bool = False) -> list[Primitive]:
    """The round outlines of a link, then its pitch circles if it is a wheel, its pitch lines if it is a rack; hollow
    outlines, and those of the frame, are hatched on the side of the body.  With ``replaced`` only rolling outlines:
    bars and blocks replace the others."""
    return [*_discs(here, link, replaced), *_wheels(here, link)]


def _discs(here: MechanismOnPaper, link: str, replaced: bool) -> list[Primitive]:
    if link not in here.sheet.poses:
        return []
    rolling = {name for contact in here.scene.contacts if contact.rolling
               for of, name in zip(contact.bodies, contact.outlines, strict=True) if of == link}
    links, colour = here.touching, here.colour(link)
    parts: list[Primitive] = []
    for name, disc in here.scene.by_name[link].discs.items():
        if replaced and name not in rolling:
            continue
        centre = links.place(link, disc.centre)
        radius = abs(disc.r) * links.mm
        parts += _outline(on_page(centre), radius, strokes.LINK.coloured(colour))
        if link == here.ground or disc.r < 0:
            parts += _ring(centre, radius, disc.r < 0, colour)
    return parts


def _outline(centre: complex, radius: float, stroke: Stroke) -> tuple[Arc, Arc]:
    """A circle in two halves: labels may stand inside, unlike in the symbol of a joint."""
    return Arc(centre, radius, 0.0, math.pi, stroke), Arc(centre, radius, math.pi, 2 * math.pi, stroke)


def _ring(centre: complex, radius: float, outside: bool, colour: str) -> Iterator[Primitive]:
    count = max(12, round(2 * math.pi * radius / HATCHES))
    away = symbols.HATCH_DEPTH if outside else -symbols.HATCH_DEPTH
    for k in range(count):
        spoke = rect(1.0, 2 * math.pi * k / count)
        foot = centre + radius * spoke
        yield Line.between(foot, foot + away * spoke * complex(1, 0.8), strokes.HATCHING.coloured(colour))


def _wheels(here: MechanismOnPaper, link: str) -> list[Primitive]:
    links, colour = here.touching, here.colour(link)
    parts: list[Primitive] = []
    for wheel, centre, radius in links.pitch_circles():
        if wheel == link:
            parts += _outline(on_page(centre), abs(radius), strokes.PITCH.coloured(colour))
            if link == here.ground:
                parts += _ring(centre, abs(radius), radius < 0, colour)
    for rack, foot, body in links.pitch_lines():
        if rack == link:
            reach = 2.2 * FACE * 1j * body
            edge = 2.0 * body
            parts.append(Line.between(foot - reach, foot + reach, strokes.PITCH.coloured(colour)))
            ends = foot - reach + edge, foot + reach + edge
            edge_of_body = Line.between(*ends, strokes.LINK.coloured(colour))
            parts += _hatched(*ends, body) if link == here.ground else [edge_of_body]
    return parts


def _hatched(start: complex, end: complex, body: complex) -> tuple[Primitive, ...]:
    """An edge of the frame, hatched on the side of ``body``."""
    right = on_page(end - start) * 1j
    if (right * on_page(body).conjugate()).real < 0:
        start, end = end, start
    return symbols.hatched_line(on_page(start), on_page(end))


def faces_of_frame(here: MechanismOnPaper) -> list[Primitive]:
    """Flat faces that the frame carries."""
    parts = list[Primitive]()
    for contact, touch in here.touching.contacts():
        if contact.flat and contact.face == here.ground:
            along = 1j * touch.normal * FACE
            parts += _hatched(touch.at - along, touch.at + along, -touch.normal)
    return parts


def within_round_body(here: MechanismOnPaper, link: str) -> complex | None:
    """A place (mm) in the body of a cam, on the way to its farthest point; or of a wheel or disc, on the side away from
    its contacts: inside its circle, outside the circle of an internal wheel; None for a link without any of them."""
    links = here.touching
    if (cam := next((cam for cam in links.cams if cam.cam.link == link), None)) is not None:
        axis = here.sheet.poses[link].origin
        return axis + IN_BODY * (max(cam.profile, key=lambda z: abs(z - axis)) - axis)
    rounds = [(centre, radius) for wheel, centre, radius in links.pitch_circles() if wheel == link]
    if link in here.sheet.poses:
        discs = here.scene.by_name[link].discs.values()
        rounds += [(links.place(link, disc.centre), disc.r * links.mm) for disc in discs]
    if not rounds:
        return None
    centre, radius = max(rounds, key=lambda each: abs(each[1]))
    toward = added_up((touch.at - centre for touch in links.touches() if link in touch.links), 0j)
    away = -unit(toward) if abs(toward) > TOUCHING else 1j
    return centre + (IN_BODY * radius if radius > 0 else abs(radius) + 2 * symbols.HATCH_DEPTH) * away


def beside_face_of_frame(here: MechanismOnPaper) -> tuple[complex, complex] | None:
    """A place (mm) at the end of the hatching where a link touches the frame, and the direction into its body; None
    where no link touches it."""
    for touch in here.touching.touches():
        if here.ground in touch.links:
            centres = [centre for link, (_, centre) in touch.centres.items() if link != here.ground]
            out = unit(centres[0] - touch.at) if centres else touch.normal
            return touch.at - (symbols.HATCH_DEPTH + 0.8j * FACE) * out, -out
    return None


def profiles(here: MechanismOnPaper) -> Iterator[Group]:
    """Cams with their profiles, the rollers or faces of followers, tangents and normals at their contacts."""
    for cam in here.touching.cams:
        across = 1j * cam.normal
        yield Group((_cam_alone(here, cam),), id=f"cam-{cam.cam.link}", classes=("cam",), since=here.stands)
        end = tuple(_follower_end(here, cam))
        if end:
            yield Group(end, id=f"follower-{cam.cam.follower}", classes=("cam",), since=here.stands)
        far_side = cam.contact + cam.roller * cam.normal
        thin = ((cam.contact - AT_CAM * cam.normal, far_side + AT_CAM * cam.normal),
                (cam.point - AT_CAM * across, cam.point + AT_CAM * across))
        lines = tuple(Line.between(a, b, strokes.DIRECTION) for a, b in thin[: 1 if cam.cam.flat else 2])
        yield Group(lines, id=f"touch-{cam.cam.link}", classes=("touch",), since=here.stands)


def cams_alone(here: MechanismOnPaper, names: Collection[str]) -> list[Primitive]:
    """The profiles of cams, then the ends of followers, that are among some links cut free."""
    cams = here.touching.cams
    parts: list[Primitive] = [_cam_alone(here, cam) for cam in cams if cam.cam.link in names]
    return parts + [part for cam in cams if cam.cam.follower in names for part in _follower_end(here, cam)]


def _cam_alone(here: MechanismOnPaper, cam: CamOnPaper) -> Polygon:
    colour = here.colour(cam.cam.link)
    return Polygon(tuple(map(on_page, cam.profile)), strokes.tint(colour), strokes.LINK.coloured(colour))


def _follower_end(here: MechanismOnPaper, cam: CamOnPaper) -> Iterator[Primitive]:
    """The part of a follower that touches its cam: the roller or the flat face."""
    stroke, across = strokes.LINK.coloured(here.colour(cam.cam.follower)), 1j * cam.normal
    if cam.roller:
        yield Circle(on_page(cam.point), cam.roller, stroke=stroke)
    if cam.cam.flat:
        yield Line.between(cam.point - FLAT * across, cam.point + FLAT * across, stroke)
        if abs(cam.contact - cam.point) > FLAT:
            yield Line.between(cam.point, cam.contact, stroke)


def _curved(here: MechanismOnPaper) -> Iterator[tuple[CircularSlot, tuple[float, float]]]:
    """The circular slots between links on paper, and the angles (rad) between which each is drawn."""
    for slot in here.scene.whole.slots:  # what stands for a cam is no slot
        if slot.on not in here.sheet.poses or not {slot.centre, slot.point} <= here.places.keys():
            continue
        centre, at = here.places[slot.centre], here.places[slot.point]
        runs, axis = phase(at - centre), phase(here.sheet.poses[slot.on].axis)
        half = min(CURVED_ALONG / abs(at - centre), math.pi / 3)
        start, end = (runs - half, runs + half) if slot.ends is None else sorted(axis + a for a in slot.ends)
        runs = (start + end) / 2 + math.remainder(runs - (start + end) / 2, math.tau)
        yield slot, (min(start, runs), max(runs, end))  # it runs beyond no end


def circular_slots(here: MechanismOnPaper) -> Iterator[Group]:
    """Circular slots, and the bars that join them to their moving links."""
    for slot, (start, end) in _curved(here):
        centre = here.places[slot.centre]
        radius = abs(here.places[slot.point] - centre)
        colour = strokes.BLACK if slot.on == here.ground else here.colour(slot.on)
        parts = list[Primitive]()
        if slot.on != here.ground:
            rim = centre + radius * rect(1.0, start)
            held = [here.places[p] for p in here.scene.by_name[slot.on].points if p in here.places and p != slot.centre]
            near = min(held or [centre], key=lambda z: abs(z - rim))
            parts.append(Line.between(near, rim, strokes.LINK.coloured(colour)))
        parts += symbols.circular_slot(on_page(centre), radius, start, end, colour)
        yield Group(tuple(parts), id=f"slot-{slot.bar}", classes=("link",), since=here.stands)


def block_on_circle(here: MechanismOnPaper, link: str) -> list[Primitive]:
    """A link that is a block in a circular slot; nothing for other links."""
    parts = list[Primitive]()
    for slot, _ in _curved(here):
        if slot.block and slot.bar == link:
            at = here.places[slot.point]
            parts += symbols.block(on_page(at), phase(1j * (at - here.places[slot.centre])), here.colour(link))
    return parts


def badges(here: MechanismOnPaper, spoken: str) -> list[Label]:
    """The letter of higher pairs at each of them, then the words at rollers, which turn by themselves."""
    whole, cams = here.scene.whole, here.touching.cams
    pairs = [(f"{pin.pin}-{pin.b}", pin.pin) for pin in whole.slides if pin.higher]
    pairs += [(f"{path.point}-{path.on}", path.point) for path in whole.replacing.values()]
    pairs += [(c.name, c.name) for c in here.scene.contacts if c.carrier or not c.rolling]
    places = [(name, here.places[point]) for name, point in pairs if point in here.places]
    places += [(cam.cam.link, cam.contact) for cam in cams]
    letter, words = rich(sign("p", "H"), 3.0), plain(term("own turning", spoken), 2.4)
    return [
        *(Label.of(letter, on_page(z), f"badge-{name}", colour=strokes.GREY, rank=1) for name, z in places),
        *(Label.of(words, on_page(cam.point), f"badge-roller-{cam.cam.follower}", colour=strokes.GREY, rank=1)
          for cam in cams if cam.roller),
    ]


def contact_marks(here: MechanismOnPaper) -> Piece:
    """At every contact the common normal n-n and the common tangent t-t."""
    return dated(_marks(touch for _, touch in here.touching.contacts()), here.stands)


def marks_cut_free(here: MechanismOnPaper, cut: frozenset[str], tag: str) -> Piece:
    """Normals and tangents with their letters where links cut free touch others, also at the pitch points of wheels;
    ``tag`` ends the names of the parts."""
    return _marks((touch for touch in here.touching.touches() if cut.intersection(touch.links)), f"-{tag}")


def _marks(touches: Iterable[Touch], tag: str = "") -> Piece:
    drawn, names = list[Primitive](), list[Label]()
    for name, at, normal in ((touch.name, touch.at, touch.normal) for touch in touches):
        lines = list[Primitive]()
        for letter, along, reach in (("n", normal, NORMAL), ("t", 1j * normal, TANGENT)):
            lines.append(Line.between(at - reach * along, at + reach * along, strokes.AXIS))
            for k, side in enumerate((-along, along), 1):
                id = f"label-{letter}-{name}-{k}{tag}"
                names.append(Label.of(rich(sign(letter), 3.0), on_page(at + reach * side), id, toward=(phase(side),)))
        if tag:
            lines.append(Circle(on_page(at), 0.5, fill=strokes.BLACK))
            names.append(Label.of(rich(sign(name), 3.0), on_page(at), rank=1))
        drawn.append(Group(tuple(lines), id=f"contact-{name}{tag}", classes=("contact",)))
    return Piece({"construction": tuple(drawn)}, tuple(names))


def replacing_links(here: MechanismOnPaper, clear: float = 0.0) -> tuple[Primitive, ...]:
    """The links that replace higher pairs, dashed: the bar between two centres of curvature (of a cam from the centre
    of the pitch curve, with the cam's bar to its axis), or the block at the centre of a disc with its guide along the
    face; bars end ``clear`` mm before the middles of their pins."""
    links, drawn = here.touching, list[Primitive]()
    for contact, touch in links.contacts():
        if contact.rolling:
            continue
        colour = here.colour(contact.block)
        spots = [touch.centres[link][1] for link in contact.round_links]
        if contact.flat:
            along = 1j * touch.normal
            drawn += symbols.block(on_page(spots[0]), phase(along), colour)
            reach = FACE * along
            drawn.append(Line.between(spots[0] - reach, spots[0] + reach, strokes.DIRECTION))
        else:
            drawn += _dashed(spots[0], spots[1], colour, clear)
    whole = here.scene.whole
    for bar, path in here.scene.replacing.items():
        if bar not in whole.replacing and {path.centre, path.point} <= here.places.keys():
            drawn += _dashed(here.places[path.centre], here.places[path.point], here.colour(bar), clear)
    for pin in here.scene.slides:
        if pin not in whole.slides and pin.pin in here.places:
            at = on_page(here.places[pin.pin])
            drawn += symbols.block(at, phase(pin.along(here.sheet.poses)), here.colour(pin.b))
            drawn.append(Circle(at, symbols.JOINT_RADIUS, fill=strokes.WHITE, stroke=strokes.OUTLINE))
    for cam in whole.cams:
        added = (p for p in here.scene.by_name[cam.link].points if p not in whole.by_name[cam.link].points)
        for point in added:
            if point in here.places:
                axis = here.sheet.poses[cam.link].origin
                drawn += _dashed(axis, here.places[point], here.colour(cam.link), clear)
    return tuple(drawn)


def _dashed(start: complex, end: complex, colour: str, clear: float) -> Iterator[Primitive]:
    """A bar that replaces a higher pair; none between pins that cover each other."""
    far = abs(end - start)
    if far > 2 * clear + TOUCHING:
        gap = (end - start) / far * clear
        yield Line.between(start + gap, end - gap, strokes.REDUNDANT.coloured(colour))
