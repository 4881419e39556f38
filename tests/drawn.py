"""Scenes that come along, drawn once for all tests that look at them."""

from __future__ import annotations

from functools import cache

from graphkin.construction import Sheet, draft
from graphkin.drawing import Drawing, figures, sheet_room
from graphkin.scene import mechanism_of

__all__ = ["drafted", "drawn"]


@cache
def drafted(name: str) -> tuple[Sheet, Sheet]:
    """The construction for single figures, and for the sheet."""
    scene = mechanism_of(name)
    return draft(scene), draft(scene, room=sheet_room(scene))


@cache
def drawn(name: str, language: str = "en", convention: str = "chinese") -> dict[str, Drawing]:
    """Its figures, without a report."""
    own, on_sheet = drafted(name)
    return figures(own, on_sheet, None, language, convention)
