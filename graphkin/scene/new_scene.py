"""New scenes of the usual mechanisms: a commented file with one's own lengths, to go on from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.words import Phrase

__all__ = ["NEW", "NewScene", "new_scene"]


@dataclass(frozen=True)
class NewScene:
    """A kind of mechanism: what it asks for, each with a value that works (mm, degrees, rpm), and its file."""

    asks: Mapping[str, float]
    text: str


_HEAD = """# {title}: lengths in mm, angles in degrees, counter-clockwise from the x axis of the frame
title = "{title}"

[units]
length = "mm"          # or cm, m, in, ft

"""
_CRANK = """[links.1]              # the crank: its own axis runs from A to B
points = ["A", "B"]
length = {crank:g}

"""
_DRIVER = """[driver]
link  = "1"
angle = {angle:g}             # where the crank stands
rpm   = {rpm:g}              # negative: clockwise; or omega = ... in rad/s
"""
NEW: Mapping[str, NewScene] = {
    "four-bar": NewScene(
        {"crank": 150, "coupler": 500, "rocker": 300, "frame": 400, "angle": 60, "rpm": 60},
        _HEAD
        + """[frame]                # the fixed link
name   = "4"
points = {{ A = [0, 0], D = [{frame:g}, 0] }}

"""
        + _CRANK
        + """[links.2]              # the coupler
points = ["B", "C"]
length = {coupler:g}

[links.3]              # the rocker: C lies to the left of the line from B to D, or give [sketch] C = [x, y]
points = ["D", "C"]
length = {rocker:g}

"""
        + _DRIVER,
    ),
    "slider-crank": NewScene(
        {"crank": 50, "rod": 200, "offset": 0, "angle": 60, "rpm": 60},
        _HEAD
        + """[frame]                # the fixed link with the slide's line, {offset:g} from the crank's pivot
name   = "4"
points = {{ A = [0, 0] }}
guides = {{ h = {{ through = [0, {offset:g}], angle = 0 }} }}

"""
        + _CRANK
        + """[links.2]              # the rod
points = ["B", "C"]
length = {rod:g}

[links.3]              # the slider: C takes the place further along the guide
points = ["C"]
on     = "4.h"

"""
        + _DRIVER,
    ),
    "guide-bar": NewScene(
        {"crank": 100, "centres": 250, "angle": 60, "rpm": 60},
        _HEAD
        + """[frame]                # the fixed link: the crank turns about A, the slotted bar about C
name   = "4"
points = {{ A = [0, {centres:g}], C = [0, 0] }}

"""
        + _CRANK
        + """[links.2]              # the block on the crank's pin, which slides on link 3's own axis
points = ["B"]
on     = "3"

[links.3]              # the slotted bar, along its own axis through C
points = ["C"]

"""
        + _DRIVER,
    ),
    "swinging-block": NewScene(
        {"crank": 100, "centres": 250, "angle": 60, "rpm": 60},
        _HEAD
        + """[frame]                # the fixed link: the crank turns about A, the block about C
name   = "4"
points = {{ A = [0, {centres:g}], C = [0, 0] }}

"""
        + _CRANK
        + """[links.2]              # the rod from the crank's pin through the block, along its own axis
points = ["B"]

[links.3]              # the block, pivoted at C, which the rod slides through
points = ["C"]
on     = "2"

"""
        + _DRIVER,
    ),
}
"""Kinds by their names."""


def new_scene(kind: str, given: Mapping[str, float]) -> str:
    """The text of a new scene file.

    Parameters
    ----------
    given : lengths and driver by their names, as far as they are not to be the usual ones

    Raises
    ------
    CallError : an unknown kind, an unknown name, a length that is not positive
    """
    if kind not in NEW:
        raise CallError(Problem("--new", f'"{kind}"', did_you_mean(kind, NEW)))
    made = NEW[kind]
    problems = [Problem(f"--new {kind}", Phrase("asks for no", number=n), did_you_mean(n, made.asks)) for n in given
                if n not in made.asks]  # fmt: skip
    for name, value in given.items():
        signed = name in ("offset", "angle", "rpm")
        if not math.isfinite(value) or abs(value) > 1e9 or (not signed and value <= 0):
            problems.append(
                Problem(
                    name,
                    Phrase("found value", value=f"{value:g}"),
                    Phrase("a finite number") if signed else Phrase("a length is positive"),
                )
            )
    if problems:
        raise CallError(*problems)
    return made.text.format(title=kind.replace("-", " ").capitalize(), **{**made.asks, **given})
