"""Instant centres: permanent ones, Kennedy's theorem with its circle diagram, velocities by centres, centrodes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from graphkin.construction.centres.find import Centre, Centres, Worked, found_on, worked
from graphkin.construction.centres.speeds import (
    Turning,
    by_centres,
    error_by_centres,
    points_asked,
    speeds,
    velocity_sentences,
)
from graphkin.construction.instruments import EXACT, Instrument
from graphkin.construction.plan import draft
from graphkin.construction.sheet import Sheet
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.structure import Structure, analyse, part_of

__all__ = [
    "Centre",
    "Centres",
    "Turning",
    "by_centres",
    "centres_on",
    "error_by_centres",
    "find_centres",
    "points_asked",
    "speeds",
    "velocity_sentences",
    "work",
]


def work(
    of: Mechanism | Structure,
    at: Mapping[str, float] | None = None,
    instrument: Instrument = EXACT,
    near: Sheet | None = None,
) -> Worked:
    """Draw everything of a scene and measure how it moves; parameters and exceptions are those of `draft`."""
    return worked(draft(of, at, (), instrument, near=near))


def find_centres(
    of: Mechanism | Structure, at: Mapping[str, float] | None = None, instrument: Instrument = EXACT,
    sheet: Sheet | None = None, near: Centres | None = None,
) -> Centres:  # fmt: skip
    """Find every centre of every two links on the drawing board.

    Parameters
    ----------
    of, at, instrument : a mechanism or its structure, and as for `draft`
    sheet : the scene drawn at this position already; it is used if every link stands on it
    near : the centres at other driver values, from which a scene with larger groups is followed; without them the
        scene's own position is found first

    Raises
    ------
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point
    """
    scene = of.scene if isinstance(of, Structure) else of
    moving = _moving(scene)
    if sheet is not None and moving is scene and set(sheet.structure.links) <= set(sheet.poses):
        found = worked(sheet)
    else:
        found = work(of if moving is scene else moving, at, instrument, near.sheet if near is not None else None)
    if scene.cams and scene.instead_of is None:
        scene = found.sheet.scene  # with the pins on pitch curves and faces, which have normals
    return found_on(found, scene, instrument)


def _moving(scene: Mechanism) -> Mechanism:
    """The scene itself, or at unit speed where its one driver stands still: centres do not depend on the speed."""
    if len(scene.drivers) != 1 or scene.drivers[0].values[1] != 0.0:
        return scene
    driver = scene.drivers[0]
    return replace(scene, drivers=(replace(driver, rate=driver.span(scene.size)),))


def centres_on(sheet: Sheet, asked: Sequence[Symbol], instrument: Instrument = EXACT) -> Centres:
    """The centres of what leads to the asked, on a sheet that shows it; errors as for `find_centres`."""
    part = part_of(sheet.structure, asked)
    if part is not sheet.scene:
        sheet = replace(sheet, scene=part, structure=analyse(part))
    return find_centres(part, {d.key: sheet.drivers[d.key] for d in part.drivers}, instrument, sheet)
