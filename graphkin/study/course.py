"""The range of the first driver over as many turns as close the motion."""

from __future__ import annotations

from collections.abc import Mapping

from graphkin.scene.model import Scene
from graphkin.solver import DriverRange, driver_range
from graphkin.structure import Structure

__all__ = ["Course", "course_of"]

Course = DriverRange


def course_of(scene: Scene | Structure, at: Mapping[str, float] | None = None) -> DriverRange:
    """``driver_range`` until the motion closes."""
    return driver_range(scene, at).until_closed()
