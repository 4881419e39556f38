"""Numbers in free places: of steps beside their vectors or the names of these, and of rings that share them with their
insets.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from graphkin.drawing.box import Box
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Segment, Text, on_page
from graphkin.drawing.place.obstacles import Obstacles, boxes_of, distances, first_free, meets
from graphkin.drawing.text import SMALLEST, plain, text_box

LEAST_NUMBERED = 5.0  # mm: a shorter vector has no room for a number
OFF = 0.9  # mm from the vector to its number
AROUND_NUMBER = 0.35  # mm
BESIDE = 0.5  # mm from a name to the number beside it
# Along the vector, in the order of liking.
SHARES = np.array((0.5, 0.38, 0.62, 0.26, 0.74, 0.16, 0.84, 0.44, 0.56, 0.32, 0.68, 0.2, 0.8, 0.1, 0.9))
# mm from a ring to its numeral, in the order of liking, and around it
GAPS = np.array((0.6, 1.2, 2.0, 3.0, 4.5, 6.5, 9.0, 12.0, 15.0))
WAYS = on_page(np.exp(2j * np.pi * (np.arange(24) + 3) / 24))
UNLED = 4  # so many of these places have no leader


def step_number(step: int, colour: str = strokes.GREY) -> Text:
    """The number of a step in brackets."""
    return Text(0j, plain(f"({step})", SMALLEST), "start", colour, "", ("step-number",), step)


def step_numbers(
    arrows: Sequence[tuple[int, Segment, Box | None]], keyed: Collection[int], panel: Box, around: Obstacles
) -> tuple[Text, ...]:
    """A number in brackets beside each arrow, or beside its name, if there is room; where another arrow is nearer only
    if there is no other place.

    Parameters
    ----------
    arrows : number of the step, tail and tip (page points, mm), and the box of the name
    keyed : steps whose number stands there already
    around : all strokes and texts
    """
    lengths = [abs(tip - tail) for _, (tail, tip), _ in arrows]
    long = [k for k, (step, *_) in enumerate(arrows) if lengths[k] >= LEAST_NUMBERED and step not in keyed]
    if not long:
        return ()
    shown = [arrows[k] for k in long]
    texts = [step_number(step) for step, _, _ in shown]
    boxes = [text_box(text) for text in texts]
    half = np.array([complex(box.width, box.height) / 2 for box in boxes])
    tails, tips = (np.array([ends[k] for _, ends, _ in shown]) for k in (0, 1))
    axes = (tips - tails) / np.abs(tips - tails)
    distance = OFF + np.abs(axes.imag) * half.real + np.abs(axes.real) * half.imag
    sides = np.array((1.0, -1.0))
    along = tails[:, None] + (tips - tails)[:, None] * SHARES
    by_vectors = (along[:, :, None] + (1j * axes * distance)[:, None, None] * sides).reshape(len(shown), -1)
    by_names = [_by_name(name, size) for (_, _, name), size in zip(shown, half.tolist(), strict=True)]
    gaps = distances(by_vectors, np.array([ends for _, ends, _ in arrows]))  # of the middles of numbers
    last = gaps.min(axis=-1) < gaps[np.arange(len(long)), :, long] - 1e-6
    order = np.argsort(np.hstack((last, np.zeros((len(long), 4), dtype=bool))), axis=1, kind="stable")
    places = np.take_along_axis(np.hstack((by_vectors, np.array(by_names))), order, axis=1)
    choices = first_free([*places], half.tolist(), around, AROUND_NUMBER, panel)
    return tuple(
        text._replace(at=complex(row[i]) - box.centre)
        for text, box, row, i in zip(texts, boxes, places, choices, strict=True) if i is not None
    )


def _by_name(name: Box | None, half: complex) -> tuple[complex, ...]:
    """Places for the middle of a number beside a name, nan without a name."""
    if name is None:
        return (complex(np.nan, np.nan),) * 4
    middle, x, y = name.centre, name.width / 2 + BESIDE + half.real, name.height / 2 + BESIDE + half.imag
    return middle - x, middle + x, middle + 1j * y, middle - 1j * y


def beside_ring(
    box: Box, centre: complex, radius: float, around: Obstacles, panel: Box
) -> tuple[complex, Segment | None] | None:
    """The place for the middle of a numeral at a ring where everything ``around`` leaves room, and its leader where it
    stands further off; None without such a place.

    Parameters
    ----------
    box : of the numeral
    centre, radius : of the ring (page point; mm)
    """
    half = complex(box.width, box.height) / 2
    edges = centre + radius * WAYS
    ends = edges + (GAPS[:, None] - AROUND_NUMBER) * WAYS
    # the corner or the edge of the box that looks at the ring slides with the way
    across, down = 1.6 * half.real * WAYS.real, 1.6 * half.imag * WAYS.imag
    hold = np.clip(across, -half.real, half.real) + 1j * np.clip(down, -half.imag, half.imag)
    middles = ends + AROUND_NUMBER * WAYS + hold
    leaders = np.stack(np.broadcast_arrays(edges, ends), axis=-1)[UNLED:].reshape(-1, 2)
    others = boxes_of(area for area in around.areas if area.distance(centre) > 0.0)
    middles[UNLED:].reshape(-1)[meets(leaders, *others)[0]] = np.nan
    (place,) = first_free([middles.ravel()], [half], around, AROUND_NUMBER, panel)
    if place is None:
        return None
    gap, turn = divmod(place, len(WAYS))
    return complex(middles[gap, turn]), (complex(edges[turn]), complex(ends[gap, turn])) if gap >= UNLED else None
