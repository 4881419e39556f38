"""The numbers of the steps at the vectors of a polygon, where they are clear of everything drawn and written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from graphkin.drawing import strokes
from graphkin.drawing.box import Box
from graphkin.drawing.font_widths import text_box
from graphkin.drawing.obstacles import Flags, Obstacles, Points, meets
from graphkin.drawing.primitives import Segment, Text
from graphkin.drawing.text import SMALLEST, plain

__all__ = ["step_number", "step_numbers"]

LEAST = 5.0  # mm: a shorter vector has no room for a number
OFF = 0.9  # mm from the vector to its number
CLEAR = 0.35  # mm around a number
SHARES = np.array((0.5, 0.38, 0.62, 0.26, 0.74, 0.16, 0.84))  # along the vector, in the order of liking


def step_numbers(arrows: Sequence[tuple[int, Segment]], panel: Box, around: Obstacles) -> tuple[Text, ...]:
    """A number in brackets beside each arrow for which there is room.

    Parameters
    ----------
    arrows : number of the step, tail and tip (page points, mm)
    around : everything drawn and written
    """
    shown = [(step, ends) for step, ends in arrows if abs(ends[1] - ends[0]) >= LEAST]
    if not shown:
        return ()
    texts = [step_number(step) for step, _ in shown]
    boxes = [text_box(text) for text in texts]
    half = np.array([complex(box.width, box.height) / 2 for box in boxes])
    tails, tips = (np.array([ends[k] for _, ends in shown]) for k in (0, 1))
    way = (tips - tails) / np.abs(tips - tails)
    off = OFF + np.abs(way.imag) * half.real + np.abs(way.real) * half.imag
    sides = np.array((1.0, -1.0))
    along = tails[:, None] + (tips - tails)[:, None] * SHARES
    places = (along[:, :, None] + (1j * way * off)[:, None, None] * sides).reshape(len(shown), -1)
    reach = half[:, None] + CLEAR * (1 + 1j)
    free = _inside(places, reach, panel) & ~_covered(places, reach, around)
    found: list[Text] = []
    taken: list[Box] = []
    for i, text in enumerate(texts):
        for j in np.flatnonzero(free[i]):
            place = complex(places[i, j])
            box = boxes[i].moved(place - boxes[i].centre)
            if not any(box.overlaps(other) for other in taken):
                taken.append(box.grown(CLEAR))
                at = place - boxes[i].centre
                found.append(replace(text, at=at))
                break
    return tuple(found)


def step_number(step: int, colour: str = strokes.GREY) -> Text:
    """The number of a step in brackets."""
    return Text(0j, plain(f"({step})", SMALLEST), "start", colour, "", ("step-number",), step)


def _inside(places: Points, reach: Points, panel: Box) -> Flags:
    low, high = places - reach, places + reach
    across = (low.real >= panel.left) & (high.real <= panel.right)
    return across & (low.imag >= panel.top) & (high.imag <= panel.bottom)


def _covered(places: Points, reach: Points, around: Obstacles) -> Flags:
    """Whether anything drawn meets a box at a place."""
    lines = np.array((*around.solid, *around.dashed), dtype=complex).reshape(-1, 2)
    at, size = places[..., None], np.broadcast_to(reach, places.shape)[..., None]
    covered: Flags = np.asarray(meets(lines, at, size).any(axis=-1))
    if around.areas:
        middles = np.array([box.centre for box in around.areas])
        sizes = np.array([complex(box.width, box.height) / 2 for box in around.areas])
        off, room = at - middles, size + sizes
        over = (np.abs(off.real) < room.real) & (np.abs(off.imag) < room.imag)
        covered = covered | np.asarray(over.any(axis=-1))
    return covered
