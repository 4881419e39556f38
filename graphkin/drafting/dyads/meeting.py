"""Two loci that meet, with what was drawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from graphkin.drafting.sheet import Pose, Stroke
from graphkin.words import Phrase

__all__ = ["Meeting", "Story"]

Story = tuple[tuple[Phrase, tuple[Stroke, ...]], ...]


@dataclass(frozen=True)
class Meeting:
    """Two loci that meet.

    ``gap`` is positive where they cross, zero where they touch, negative where they miss each other; for two lines it
    is the sine of their angle.  ``poses`` are the possible places of the group's links, the one of the default rule
    first; ``stories`` what is drawn for each.  ``sine`` of the crossing angle is 0 where the crossing is lost.
    """

    gap: float
    sine: float
    poses: tuple[Mapping[str, Pose], ...]
    stories: tuple[Story, ...]
    two_lines: bool = False
