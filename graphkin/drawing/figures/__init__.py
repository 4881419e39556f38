"""Figures that can be asked for by name.  Each is a file of this folder that gives in its ``FIGURES`` its name, its
needs and its function; besides it needs only its words."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import TYPE_CHECKING

from graphkin.scene.model import Mechanism

if TYPE_CHECKING:
    from graphkin.drawing.write.drawing import Drawing

__all__ = ["Figure", "figure_kinds"]


@dataclass(frozen=True)
class Figure:
    """A figure that can be asked for by name.

    draw : function of its page, a `FigurePage` with the sheet, and of its further needs; None for an empty figure
    needs : the name of its sources ("sheet", "forces", ...), as `graphkin.draw` supplies them
    by_itself : whether it is drawn of a scene if no figure is asked for by name
    of_all : whether it shows all links, whatever the question
    place : its place among the figures
    """

    name: str
    draw: Callable[..., Drawing | None]
    needs: str = "sheet"
    by_itself: Callable[[Mechanism], bool] = lambda scene: False
    of_all: bool = False
    place: float = 100.0


@cache
def figure_kinds() -> Mapping[str, Figure]:
    """Every figure by its name, in their order."""
    modules = (import_module(f"{__name__}.{file.name}") for file in iter_modules(__path__))
    figures = [figure for module in modules for figure in getattr(module, "FIGURES", ())]
    return {figure.name: figure for figure in sorted(figures, key=lambda figure: figure.place)}
