"""``graphkin open``: the drawing board as a local page."""

from __future__ import annotations

from contextlib import suppress
from typing import Annotated

import typer

from graphkin.cli.output import tell

__all__ = ["open_page"]


def open_page(
    scene: Annotated[str, typer.Argument(help="A scene file, a folder of them, a scene that comes along, or a link.")]
    = "",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port to listen on; a free one if 0.")] = 0,
    browser: Annotated[bool, typer.Option(help="Open the page in the browser.")] = True,
) -> None:
    """Edit a mechanism in the browser: text, form and figures together; drag points, build from nothing, print papers.

    The page is for this machine alone and lives until it is interrupted (Ctrl-C).
    """
    from graphkin.board.answers import LINK, Desk, text_of_link
    from graphkin.board.server import Address, needs_live, serve
    from graphkin.board.shelf import Shelf

    needs_live()
    if scene.startswith(LINK):
        desk = Desk(text=text_of_link(scene))
    else:
        shelf, first = Shelf.of(scene)
        desk = Desk(shelf, first)

    def ready(address: Address) -> None:
        tell(f"{address.url}\nCtrl-C ends it")
        if browser:
            import webbrowser

            webbrowser.open(address.url)

    with suppress(KeyboardInterrupt):  # which is how it ends
        serve(desk, port, ready)
