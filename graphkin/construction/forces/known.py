"""What acts on the links from outside: weights, loads, springs, and inertia forces from the drawn accelerations; and
which loads act at a position, which begin or end exactly there, by what is drawn.

F = -m a_S acts at the centre of mass, opposite to its acceleration, M = -J alpha against the angular acceleration; both
together are the force alone, on a line at the distance h = M / F from the centre (Sun Huan, Mechanical Principles, ch.
4).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from graphkin.construction.forces.force_sheet import ForceVector, Inertia
from graphkin.construction.forces.joints import Images
from graphkin.construction.instruments import Instrument
from graphkin.construction.links_on_paper import travel
from graphkin.construction.sheet import Sheet
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import unit
from graphkin.scene.model import LinkMass, LoadOn, SpringOn
from graphkin.scene.scene_tables import LoadPhase
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Structure

__all__ = ["acting_loads", "from_outside", "inertias", "strokes_of_loads"]

EDGE = 1e-9
"""Of the stroke or the turn: a load that begins or ends within this of a position does so exactly there."""
STILL = 1e-11
"""Of the greatest speed: what slides more slowly rests."""


def strokes_of_loads(structure: Structure) -> tuple[Symbol, ...]:
    """The strokes on parts of which loads act."""
    keys = dict.fromkeys(load.phase.stroke for load in structure.scene.loading.loads if load.phase is not None)
    found = []
    for key in keys:
        if key:
            sliding, _, guiding = key.partition("/")
            found.append(Symbol("stroke", link=sliding, other=guiding))
    return tuple(found)


def acting_loads(sheet: Sheet, growing: Sheet) -> dict[str, bool | None]:
    """For each load whether it acts; None where it begins or ends exactly here.

    Parameters
    ----------
    sheet : the position, with the limit positions of the strokes of loads
    growing : the same with velocities, those of the driver's growing value where the mechanism rests
    """
    return {load.name: _acts(sheet, growing, load.phase) for load in sheet.scene.loading.loads}


def _acts(sheet: Sheet, growing: Sheet, phase: LoadPhase | None) -> bool | None:
    if phase is None:
        return True
    if phase.stroke:
        return _on_stroke(sheet, growing, phase, phase.stroke)
    driver = sheet.scene.drivers[0]
    value = sheet.drivers[driver.key]
    if not driver.turns:
        edge = EDGE * (phase.end - phase.start)
        if min(abs(value - phase.start), abs(value - phase.end)) < edge:
            return None
        return phase.start < value < phase.end
    turn, span = math.tau, phase.end - phase.start
    if span >= turn * (1 - EDGE):
        return True
    since = (value - phase.start) % turn
    if min(since, turn - since, abs(since - span)) < EDGE * turn:
        return None
    return since < span


def _on_stroke(sheet: Sheet, growing: Sheet, phase: LoadPhase, stroke: str) -> bool | None:
    slide, limits = sheet.structure.slide(stroke), sheet.limits[stroke]
    here, low, high = (travel(slide, poses, 0.0) for poses in (sheet.poses, limits.low.poses, limits.high.poses))
    part = (here - low) / (high - low) if high > low else 0.0
    if phase.sense < 0:
        part = 1.0 - part
    slip, most = Images(growing).slip(slide)
    running = abs(slip) > STILL * most and (slip > 0) == (phase.sense > 0)
    for edge in (phase.start, phase.end):
        # where the slide turns back both senses meet
        if abs(part - edge) < EDGE and (running or edge < EDGE or edge > 1.0 - EDGE):
            return None
    return running and phase.start < part < phase.end


COINCIDE = 1e-9
"""Of the mechanism's size: points of a spring that lie nearer have no line."""


def inertias(sheet: Sheet, hand: Instrument) -> dict[str, Inertia]:
    """Inertia force and couple of every link that has a mass, off the drawn acceleration polygon."""
    images = Images(sheet)
    return {mass.link: _inertia(sheet, images, mass, hand) for mass in sheet.scene.loading.masses}


def _inertia(sheet: Sheet, images: Images, mass: LinkMass, hand: Instrument) -> Inertia:
    centre = images.place(mass.link, mass.at)
    image = images.end("acceleration", mass.link, centre)
    size = hand.read(abs(image))
    push = image / abs(image) * size * sheet.scales.acceleration if image else 0j
    alpha = sheet.alpha[mass.link].value
    force, moment = -mass.mass * push, -mass.inertia * alpha
    found = Inertia(mass.link, mass.mass, mass.inertia, centre, image, push, alpha, force, moment)
    if force == 0:
        return found
    h = moment / abs(force)
    # the shifted force turns about the centre as the couple does
    return replace(found, h=h, shifted=centre - 1j * unit(force) * (h * images.mm))


def from_outside(
    sheet: Sheet, growing: Sheet, found: Mapping[str, Inertia], acts: Mapping[str, bool | None], with_edges: bool,
    hand: Instrument,
) -> tuple[ForceVector, ...]:  # fmt: skip
    """All known forces, then couples, those of no size among them.

    Parameters
    ----------
    growing : what tells the sense in which pairs slide
    with_edges : whether loads act that begin or end exactly here
    """
    images, loading = Images(sheet), sheet.scene.loading
    made: list[ForceVector] = []
    for mass in loading.masses:
        one = found[mass.link]
        made.append(ForceVector(Symbol("Fi", link=mass.link), mass.link, one.force, one.centre))
        if loading.gravity:
            made.append(ForceVector(Symbol("G", link=mass.link), mass.link, mass.mass * loading.gravity, one.centre))
        made.append(ForceVector(Symbol("Mi", link=mass.link), mass.link, moment=one.moment))
    for load in loading.loads:
        on = with_edges if acts[load.name] is None else acts[load.name]
        symbol = Symbol("P", name=load.name, turning=not load.is_force)
        if load.is_force:
            force = _force(sheet, growing, load) if on else 0j
            made.append(ForceVector(symbol, load.link, force, images.place(load.link, load.at)))
        else:
            made.append(ForceVector(symbol, load.link, moment=load.size if on else 0.0))
    for spring in loading.springs:
        made += _spring(images, spring, hand)
    return tuple(sorted(made, key=lambda one: not one.symbol.is_vector))


def _spring(images: Images, spring: SpringOn, hand: Instrument) -> Iterator[ForceVector]:
    """Both forces of a spring, from its length and line as they are measured on the drawn mechanism."""
    drawn = (images.sheet.points.get(PointRef(point)) for point in spring.points)
    one, two = (
        images.place(link, at) if z is None else z for z, (link, at) in zip(drawn, spring.ends, strict=True)
    )
    size = abs(two - one)
    if size <= COINCIDE * images.sheet.scene.size * images.mm:
        raise Unsolvable("dead point", Problem(f"springs.{spring.name}", "its two points coincide in this position so",
                                               "move the driver off this position"))
    length = hand.read(size) / images.mm
    force = (spring.preload + spring.rate * (length - spring.free)) * unit(two - one)
    symbol = Symbol("P", name=spring.name)
    yield ForceVector(symbol, spring.links[0], force, one)
    yield ForceVector(symbol, spring.links[1], -force, two, turned=True)


def _force(sheet: Sheet, growing: Sheet, load: LoadOn) -> complex:
    """A force load (N), its direction from the drawn links."""
    if load.against:
        images, slide = Images(growing), growing.structure.slide(load.against)
        slip, most = images.slip(slide)
        return 0j if abs(slip) <= STILL * most else -load.size * math.copysign(1.0, slip) * images.along(slide)
    return load.size * load.turn * (sheet.poses[load.follows].axis if load.follows else 1.0)
