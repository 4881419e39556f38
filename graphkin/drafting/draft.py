"""From a scene to everything drawn: position, velocity polygon, acceleration polygon."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from graphkin.drafting.asked import show
from graphkin.drafting.board import Board
from graphkin.drafting.instrument import EXACT, Instrument
from graphkin.drafting.placed import draw_position
from graphkin.drafting.plan import ORDERS, Plan, plan
from graphkin.drafting.polygons import Polygons
from graphkin.drafting.position import place
from graphkin.drafting.scales import Room
from graphkin.drafting.sheet import Sheet
from graphkin.drafting.slip import NO_SLIP, Slip
from graphkin.scene.model import Scene
from graphkin.scene.symbol import PointRef, Symbol

__all__ = ["draft", "execute"]


def execute(what: Plan, instrument: Instrument = EXACT, slip: Slip = NO_SLIP) -> Sheet:
    """Draw a plan with an instrument; with a ``slip``, what follows from it."""
    structure, elements, scales = what.structure, what.elements, what.scales
    board = Board(instrument)
    position = place(structure, elements, 1.0 / scales.length, what.values, what.branches, instrument)
    assembly = draw_position(board, structure, elements, position, what.branches)
    board.causes[:] = position.causes
    polygons = Polygons(board, structure, position.frame, scales, slip)
    polygons.chains.update(what.chains)
    for order in ORDERS:
        for element in what.drawn[order]:
            polygons.draw(order, element)
    show(polygons, what.asked)
    return Sheet(
        scene=structure.scene,
        structure=structure,
        instrument=instrument.name,
        drivers=what.values,
        scales=scales,
        poses=dict(position.frame.poses),
        points={PointRef(p): z for p, z in polygons.places.items()},
        ends={order: dict(ends) for order, ends in polygons.ends.items()},
        omega=dict(polygons.rates["velocity"]),
        alpha=dict(polygons.rates["acceleration"]),
        steps=tuple(board.steps),
        equations=tuple(board.equations),
        assembly=assembly,
        notes=tuple(board.notes),
        stopped=what.stopped,
        left_out=what.left_out,
        causes=tuple(board.causes),
    )


def draft(
    scene: Scene,
    at: Mapping[str, float] | None = None,
    find: Iterable[Symbol] | None = None,
    instrument: Instrument = EXACT,
    room: Room | None = None,
) -> Sheet:
    """Draw a scene: the position, both polygons, all angular rates measured.

    Parameters
    ----------
    at : driver values other than the scene's own (rad or m), by the driver's key
    find : what is asked (the scene's own ``find`` if None; empty: everything)
    instrument : what draws and reads
    room : paper to fill, with scales chosen from the 1-2-2.5-5 series; None takes the scene's own scales where it
        gives them

    Raises
    ------
    Unsolvable
        wrong mobility, a position that cannot be assembled or reached, a dead point.  A group larger than a dyad is no
        error: ``Sheet.stopped`` says which it is, and what stands before it is drawn.
    """
    return execute(plan(scene, at, find, room), instrument)
