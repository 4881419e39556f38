"""Why a mechanism has the wrong mobility: redundant but mobile, over-constrained, not to be closed, wrongly counted."""

from __future__ import annotations

from dataclasses import replace

from graphkin.errors import GraphkinError, Problem, Unsolvable
from graphkin.exact.choice import choose_forms, own_values
from graphkin.exact.dead_points import settled
from graphkin.exact.engine import positions
from graphkin.exact.findings import singular
from graphkin.exact.joints import Drive
from graphkin.exact.redundant import Fit, fit
from graphkin.scene.model import Scene
from graphkin.structure import Structure, analyse, mobility_of

__all__ = ["structure_of"]

NEARBY = 0.01


def structure_of(scene: Scene) -> Structure:
    """The structure of a scene, a driver's value that is given from a dead point found.

    Raises
    ------
    Unsolvable
        status "mobility", with the diagnosis: where the count fails, each link is left out in turn, the rest is solved,
        and the link is laid back into it, in position, velocity and acceleration, here and at a position nearby
    """
    try:
        structure = analyse(scene)
    except Unsolvable as stop:
        found = _diagnosis(scene)
        if found is None:
            raise
        raise Unsolvable("mobility", *stop.problems, found) from None
    unsettled = any(d.dead_point and not d.dead_point.exact for d in scene.drivers)
    return settled(structure) if unsettled else structure


def _diagnosis(scene: Scene) -> Problem | None:
    tried: list[tuple[str, Fit, bool]] = []
    for link in reversed(scene.links):
        if link.redundant or any(link.name in d.key.split("/") for d in scene.drivers):
            continue
        without = replace(
            scene, links=tuple(replace(x, redundant=True) if x.name == link.name else x for x in scene.links), drawn={}
        )
        try:
            structure = analyse(without)
            forms = choose_forms(structure)
        except GraphkinError:
            continue
        fits: list[Fit] = []
        for shift in (0.0, NEARBY):
            value = own_values(scene)[None] + shift * _unit(scene)
            state = positions(structure, Drive.at(structure, value), {i: f[None] for i, f in forms.items()})
            laid = fit(without, link, state.poses)
            if laid is None or any(dead[0] for _, dead in singular(structure, state, 1)):
                break
            fits.append(laid)
        if len(fits) == 2:
            tried.append((link.name, fits[0], bool(fits[0].fits[0] and fits[1].position[0] < 1e-9)))
    # a driver too many does not make a link one too many
    counted = 0 < mobility_of(scene).value < len(scene.drivers)
    return _verdict([x for x in tried if x[2] or not counted])


def _unit(scene: Scene) -> float:
    """A small step of every driver: an angle, or a part of the size."""
    return 1.0 if not any("/" in d.key for d in scene.drivers) else scene.size


def _verdict(tried: list[tuple[str, Fit, bool]]) -> Problem | None:
    mobile = [name for name, _, moves in tried if moves]
    if mobile:
        return Problem(
            f"link {mobile[0]}",
            "it only repeats what the other links already hold: the mechanism is redundant but mobile",
            f"write redundant = true in [links.{mobile[0]}]",
        )
    here = [name for name, laid, _ in tried if laid.position[0] < 1e-9]
    if here:
        return Problem(
            f"link {here[0]}",
            "it fits in this position, but locks the others: the mechanism is over-constrained",
            f"leave link {here[0]} out, or one of its joints",
        )
    if tried:
        name, laid, _ = min(tried, key=lambda x: float(x[1].position[0]))
        return Problem(
            f"link {name}",
            f"it does not fit between the others here (by {100 * float(laid.position[0]):.3g} % of the size)",
            f"leave link {name} out, or one of its joints",
        )
    return None
