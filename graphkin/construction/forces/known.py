"""What acts on the links from outside: weights, loads, springs, and inertia forces from the drawn accelerations.

F = -m a_S acts at the centre of mass, opposite to its acceleration, M = -J alpha against the angular acceleration; both
together are the force alone, on a line at the distance h = M / F from the centre (Sun Huan, Mechanical Principles,
ch. 4).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from graphkin.construction.board import Instrument
from graphkin.construction.forces.force_sheet import Acting, Inertia, KnownMoment
from graphkin.construction.forces.images import Images
from graphkin.construction.forces.phases import against
from graphkin.construction.sheet import Sheet
from graphkin.errors import Problem, Unsolvable
from graphkin.plane import unit
from graphkin.scene.loads import LinkMass, LoadOn, SpringOn
from graphkin.scene.symbol import PointRef, Symbol

__all__ = ["from_outside", "inertias"]

COINCIDE = 1e-9
"""Of the mechanism's size: points of a spring that lie nearer have no line."""


def inertias(sheet: Sheet, hand: Instrument) -> dict[str, Inertia]:
    """Inertia force and couple of every link that has a mass, off the drawn acceleration polygon."""
    images = Images(sheet)
    return {mass.link: _inertia(sheet, images, mass, hand) for mass in sheet.scene.loading.masses}


def _inertia(sheet: Sheet, images: Images, mass: LinkMass, hand: Instrument) -> Inertia:
    centre = images.place(mass.link, mass.at)
    image = images.acceleration(mass.link, centre)
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
) -> tuple[tuple[Acting, ...], tuple[KnownMoment, ...]]:  # fmt: skip
    """All known forces and moments, those of no size among them.

    Parameters
    ----------
    growing : what tells the sense in which pairs slide
    with_edges : whether loads act that begin or end exactly here
    """
    images, loading = Images(sheet), sheet.scene.loading
    forces: list[Acting] = []
    moments: list[KnownMoment] = []
    for mass in loading.masses:
        one = found[mass.link]
        forces.append(Acting(Symbol("Fi", link=mass.link), mass.link, one.force, one.centre))
        if loading.gravity:
            forces.append(Acting(Symbol("G", link=mass.link), mass.link, mass.mass * loading.gravity, one.centre))
        moments.append(KnownMoment(Symbol("Mi", link=mass.link), mass.link, one.moment))
    for load in loading.loads:
        on = with_edges if acts[load.name] is None else acts[load.name]
        symbol = Symbol("P", name=load.name, turning=not load.is_force)
        if load.is_force:
            force = _force(sheet, growing, load) if on else 0j
            forces.append(Acting(symbol, load.link, force, images.place(load.link, load.at)))
        else:
            moments.append(KnownMoment(symbol, load.link, load.size if on else 0.0))
    for spring in loading.springs:
        forces += _spring(images, spring, hand)
    return tuple(forces), tuple(moments)


def _spring(images: Images, spring: SpringOn, hand: Instrument) -> Iterator[Acting]:
    """Both forces of a spring, from its length and line as they are measured on the drawn mechanism."""
    drawn = (images.sheet.points.get(PointRef(point)) for point in spring.points)
    one, two = (
        images.place(link, at) if z is None else z for z, (link, at) in zip(drawn, spring.ends, strict=True)
    )
    size = abs(two - one)
    if size <= COINCIDE * images.sheet.scene.size * images.mm:
        found = "its two points coincide in this position, so that its force has no line"
        raise Unsolvable("dead point", Problem(f"springs.{spring.name}", found, "move the driver off this position"))
    length = hand.read(size) / images.mm
    force = (spring.preload + spring.rate * (length - spring.free)) * unit(two - one)
    symbol = Symbol("P", name=spring.name)
    yield Acting(symbol, spring.links[0], force, one)
    yield Acting(symbol, spring.links[1], -force, two, turned=True)


def _force(sheet: Sheet, growing: Sheet, load: LoadOn) -> complex:
    """A force load (N), its direction from the drawn links."""
    if load.against:
        along, sense = against(growing, load.against)
        return -load.size * sense * along
    return load.size * load.turn * (sheet.poses[load.follows].axis if load.follows else 1.0)
