"""The mechanism: links, pairs and frame in kinematic symbols, drivers and found rates as arcs, names."""

from __future__ import annotations

from graphkin.drawing.mechanism.piece import mechanism_piece

__all__ = ["mechanism_piece"]
