from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import pytest

from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Stroke

pytestmark = pytest.mark.quick


def luminance(colour: str) -> float:
    """Relative luminance after WCAG 2."""
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def as_seen(colour: str, missing: str) -> tuple[float, ...]:
    """A colour as seen without red ("protan") or green ("deutan") cones, by the matrices of Vienot, Brettel and Mollon
    (1999), in linear light."""
    r, g, b = ((int(colour[i : i + 2], 16) / 255) ** 2.2 for i in (1, 3, 5))
    if missing == "protan":
        return 0.11238 * r + 0.88762 * g, 0.11238 * r + 0.88762 * g, 0.00401 * r - 0.00401 * g + b
    return 0.29275 * r + 0.70725 * g, 0.29275 * r + 0.70725 * g, -0.02234 * r + 0.02234 * g + b


@pytest.mark.parametrize("colour", strokes.LINK_COLOURS)
def test_letters_in_a_link_colour_are_readable_on_paper(colour):
    assert 1.05 / (luminance(colour) + 0.05) >= 4.5


@pytest.mark.parametrize("missing", ["protan", "deutan"])
def test_neighbouring_links_differ_for_colour_blind_readers(missing):
    seen = [as_seen(colour, missing) for colour in strokes.LINK_COLOURS[:6]]
    assert min(max(abs(p - q) for p, q in zip(a, b, strict=True)) for a, b in pairwise(seen)) > 0.04


def test_kinds_of_line_are_told_apart_without_colour():
    kinds = [strokes.RESULTANT, strokes.RELATIVE, strokes.DIRECTION, strokes.CONSTRUCTION]
    assert len({(kind.width, kind.dash) for kind in kinds}) == 4


def test_the_colours_come_round_again():
    assert strokes.link_colour(8) == strokes.link_colour(0)


def test_a_tint_is_almost_white():
    assert luminance(strokes.tint("#0067a6")) > 0.6


OF_THE_HOUSE = {(kind.width, kind.dash) for kind in vars(strokes).values() if isinstance(kind, Stroke)}
FOUND = {(0.7, ())}  # the mechanism or the profile that a construction finds


@pytest.mark.parametrize("figure", [
    "cam-offset-roller/cam", "cam-swinging-zh/cam", "cam-flat-face/cam", "design-crank-rocker-zh/design",
    "design-guide-bar/design", "design-slider-crank/design", "design-three-places/design", "gear-train-epicyclic/plan",
])
def test_cams_syntheses_and_trains_are_drawn_in_the_kinds_of_lines_of_all_figures(figure: str) -> None:
    svg = (Path(__file__).parents[2] / "figures" / f"{figure}.svg").read_text(encoding="utf-8")
    drawn = set()
    for shape in re.findall(r"<\w+ [^>]*stroke-width=[^>]*>", svg):
        width, dash = (re.search(rf' stroke-{key}="([^"]*)"', shape) for key in ("width", "dasharray"))
        drawn.add((float(width[1]), tuple(map(float, dash[1].split())) if dash else ()))
    assert set() == drawn - OF_THE_HOUSE - FOUND
