"""Names beside the curves of a chart: in its panel, clear of everything that is drawn there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from graphkin.drawing import Group, Primitive
from graphkin.drawing.chart import Chart
from graphkin.drawing.obstacles import Obstacles, obstacles_of
from graphkin.drawing.placing import Label, place

__all__ = ["placed_beside"]


def placed_beside(chart: Chart, drawn: Group, names: Sequence[Label]) -> list[Primitive]:
    """The texts and leaders of names in their places.  ``drawn`` is the chart's group, with its group of curves."""
    edges = chart.panel.corners
    frame = Obstacles(solid=tuple(zip(edges, (*edges[1:], edges[0]), strict=True)))
    curves = next(c for c in drawn.children if isinstance(c, Group) and "curves" in c.classes)
    there = obstacles_of((curves,)) + frame
    found: list[Primitive] = []
    for label in place(names, chart.panel, Obstacles(there.solid + there.dashed, areas=there.areas)):
        found.append(replace(label.text, classes=("label",)))
        if label.leader is not None:
            found.append(label.leader)
    return found
