"""The board in a notebook: the same page as a widget, whose questions the notebook's own Python answers."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING

from graphkin.board.answers import Desk, answer
from graphkin.board.server import STATIC
from graphkin.errors import CallError, Problem, SceneError
from graphkin.scene.files import library, library_text, toml_text
from graphkin.scene.scene import SceneLike, written
from graphkin.words import Phrase

if TYPE_CHECKING:
    from anywidget import AnyWidget

__all__ = ["open_board"]


def open_board(scene: SceneLike | None = None) -> AnyWidget:
    """Show the drawing board in a notebook, with a scene on it.

    Parameters
    ----------
    scene : in any of its forms; None begins with the choice of the scenes that come along

    Returns
    -------
    a widget, whose ``text`` is the text of the scene as it stands on the board

    Raises
    ------
    SceneError : there is no such scene; CallError : anywidget is not installed (extra ``live``)
    """
    if isinstance(scene, str) and scene in library():
        text = library_text(scene)
    else:
        try:
            text = "" if scene is None else toml_text(written(scene)[0])
        except (TypeError, ValueError) as error:
            said = Problem(
                "scene", Phrase("cannot be written as a file", error=error), Phrase("give texts and numbers")
            )
            raise SceneError(said) from None
    try:
        return _widget_class()(Desk(text=text))
    except ImportError:
        raise CallError(Problem("open_board", Phrase("needs anywidget"), 'pip install "graphkin[live]"')) from None


@cache
def _widget_class() -> Callable[[Desk], AnyWidget]:
    import anywidget
    import traitlets

    class Board(anywidget.AnyWidget):
        """The board as a widget."""

        _esm = STATIC / "board.js"
        _css = STATIC / "board.css"
        text = traitlets.Unicode("").tag(sync=True)

        def __init__(self, desk: Desk) -> None:
            super().__init__(text=desk.text)
            self._desk = desk
            self.on_msg(self._asked)

        def _asked(self, widget: object, content: object, buffers: object) -> None:
            self.send(answer(self._desk, content))

    return Board
