"""The board shown: as a local page, by a server for one user on one machine, and in a notebook, as a widget whose
questions the notebook's own Python answers.

The server listens on 127.0.0.1 only.  The address holds a secret; calls without it, and calls from pages of another
origin, are refused.  The page may load nothing from elsewhere.
"""

from __future__ import annotations

import json
import logging
import secrets
import threading
import traceback
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from graphkin.board.answers import answer, language_of
from graphkin.board.shelf import Shelf
from graphkin.errors import CallError, SceneError
from graphkin.scene.scene import SceneLike, library, library_text, toml_text, written
from graphkin.words import LANGUAGES, Phrase, from_others, listed, say

if TYPE_CHECKING:
    import socket

    from anywidget import AnyWidget
    from starlette.applications import Starlette

LARGEST_MESSAGE = 2_000_000
STATIC = Path(__file__).parent / "static"
FONTS = Path(__file__).parent.parent / "drawing" / "fonts"
_FILES = {
    "board.js": (STATIC, "text/javascript"), "board.css": (STATIC, "text/css"),
    "regular.ttf": (FONTS, "font/ttf"), "italic.ttf": (FONTS, "font/ttf"), "bold.ttf": (FONTS, "font/ttf"),
}


@dataclass(frozen=True)
class Address:
    """The address of the page: its port, and its secret."""

    port: int
    secret: str = field(default_factory=lambda: secrets.token_urlsafe(24))

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/{self.secret}/"

    @property
    def hosts(self) -> tuple[str, ...]:
        return f"127.0.0.1:{self.port}", f"localhost:{self.port}"


def needs_live() -> None:
    """Raises CallError where the page's extra is not installed."""
    from graphkin.table import have

    missing = [name for name in ("starlette", "uvicorn", "websockets") if not have(name)]
    if missing:
        raise CallError.of("open", "needs", 'pip install "graphkin[live]"', missing=listed(missing))


def application(shelf: Shelf, address: Address, language: str = "") -> Starlette:
    """The ASGI application of the page.

    Parameters
    ----------
    shelf : the scenes of the page
    address : the port on which it listens, and the secret
    language : that the page begins with; the browser's if empty
    """
    from starlette.applications import Starlette
    from starlette.concurrency import run_in_threadpool
    from starlette.requests import HTTPConnection, Request
    from starlette.responses import PlainTextResponse, Response
    from starlette.routing import Route, WebSocketRoute
    from starlette.websockets import WebSocket, WebSocketDisconnect

    origins = tuple(f"http://{host}" for host in address.hosts)

    def refused(call: HTTPConnection) -> str:
        """The reason why a call is refused, "" where it is not."""
        if call.headers.get("host", "") not in address.hosts:
            return "this page is served to this machine only"
        origin = call.headers.get("origin")
        if origin is not None and origin not in origins:
            return "calls of other pages are refused"
        given = call.path_params.get("secret", "")
        if not secrets.compare_digest(given.encode(), address.secret.encode()):  # in constant time
            return "the secret of this address is wrong: open the one that graphkin printed"
        return ""

    async def served(request: Request) -> Response:
        """The page, or a file that it asks for."""
        name = request.path_params.get("name", "")
        why = refused(request)
        nonce = ""
        response: Response
        if "path" in request.path_params:
            response = PlainTextResponse("open the address that graphkin printed", 403)
        elif why:
            response = PlainTextResponse(why, 403)
        elif name in _FILES:
            folder, kind = _FILES[name]
            response = Response((folder / name).read_bytes(), media_type=kind)
        elif name:
            response = PlainTextResponse(say(Phrase("there is no such file"), LANGUAGES[0]), 404)
        else:
            nonce = secrets.token_urlsafe(16)
            body = (STATIC / "board.html").read_text(encoding="utf-8").replace("NONCE", nonce)
            response = Response(body.replace("LANGUAGE", language), media_type="text/html")
        sockets = " ".join(f"ws://{host}" for host in address.hosts)
        policy = (
            f"default-src 'none'; script-src 'self'; style-src 'self' 'nonce-{nonce}'; img-src 'self' data: blob:; "
            f"font-src 'self'; connect-src 'self' {sockets}; "
            "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        )
        response.headers.update({
            "Content-Security-Policy": policy, "X-Content-Type-Options": "nosniff", "Cache-Control": "no-store",
            "Referrer-Policy": "no-referrer", "Cross-Origin-Resource-Policy": "same-origin",
            "Cross-Origin-Opener-Policy": "same-origin",
        })
        return response

    async def talk(socket: WebSocket) -> None:
        if refused(socket) or socket.headers.get("origin") not in origins:
            await socket.close(1008)
            return
        await socket.accept()
        try:
            while True:
                text = await socket.receive_text()
                answered = await run_in_threadpool(_answered, shelf, text)
                await socket.send_text(answered)
        except (WebSocketDisconnect, KeyError, RuntimeError):  # KeyError: bytes instead of a text
            return

    routes = [
        Route("/{secret}/", served), WebSocketRoute("/{secret}/talk", talk), Route("/{secret}/{name}", served),
        Route("/{path:path}", served, methods=["GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS", "PATCH"]),
    ]
    return Starlette(routes=routes)


def _answered(shelf: Shelf, text: str) -> str:
    """The answer to the text of a message; a text that is no JSON gets a problem; no error ends page or server."""
    message: object = None
    with suppress(ValueError, RecursionError):
        message = json.loads(text)
    try:
        return json.dumps(answer(shelf, message), ensure_ascii=False, allow_nan=False, default=str)
    except Exception as error:
        if threading.main_thread().is_alive():  # after Ctrl-C nobody waits for the answer
            traceback.print_exc()
        number = message.get("id") if isinstance(message, dict) else None
        said = Phrase("this could not be answered the terminal says", name=type(error).__name__)
        text = say(said, language_of(message))
        return json.dumps({"id": number, "ok": False, "problems": [{"text": text, "line": 0}], "kind": "Defect"})


def serve(
    shelf: Shelf, port: int = 0, ready: Callable[[Address], None] | None = None, language: str = ""
) -> None:
    """Serve the page until it is interrupted.

    Parameters
    ----------
    port : to listen on; a free one if 0
    ready : called with the address when the page can be opened
    language : as of `application`

    Raises
    ------
    CallError : the extra ``live`` is not installed, or the port is taken
    """
    needs_live()
    import asyncio
    import gc
    import socket

    listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind(("127.0.0.1", port))
    except (OSError, OverflowError) as error:
        listening.close()
        raise CallError.of("port", "cannot be used", "give another one or none", port=port,
                           error=from_others(error)) from None
    address = Address(listening.getsockname()[1])
    gc.set_threshold(10_000, 10, 10)  # a command that ends at once looks for garbage next to never; this one stays
    try:
        asyncio.run(_run(application(shelf, address, language), listening, lambda: ready(address) if ready else None))
    finally:
        listening.close()


async def _run(app: Starlette, listening: socket.socket, ready: Callable[[], None]) -> None:
    import uvicorn

    config = uvicorn.Config(
        app, log_level="error", access_log=False, ws="websockets-sansio", ws_max_size=LARGEST_MESSAGE, lifespan="off",
        server_header=False, timeout_graceful_shutdown=1, ws_per_message_deflate=False,
    )

    class Server(uvicorn.Server):
        async def startup(self, sockets: list[socket.socket] | None = None) -> None:
            await super().startup(sockets)
            ready()

        async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
            logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)  # an answer that Ctrl-C cuts off is no error
            await super().shutdown(sockets)

    await Server(config).serve(sockets=[listening])


# in a notebook


def open_board(scene: SceneLike | None = None) -> AnyWidget:
    """Show the drawing board in a notebook, with a scene on it.

    Parameters
    ----------
    scene : in any of its forms; None begins with the choice of the bundled scenes

    Returns
    -------
    a widget, whose ``text`` is the present text of the scene

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
            raise SceneError.of("scene", "cannot be written as a file", "give texts and numbers",
                                error=from_others(error)) from None
    try:
        return _widget_class()(Shelf(draft=text))
    except ImportError:
        raise CallError.of("open_board", "needs anywidget", 'pip install "graphkin[live]"') from None


@cache
def _widget_class() -> Callable[[Shelf], AnyWidget]:
    import anywidget
    import traitlets

    class Board(anywidget.AnyWidget):
        """The board as a widget."""

        _esm = STATIC / "board.js"
        _css = STATIC / "board.css"
        text = traitlets.Unicode("").tag(sync=True)

        def __init__(self, shelf: Shelf) -> None:
            super().__init__(text=shelf.draft)
            self._shelf = shelf
            self.on_msg(self._asked)

        def _asked(self, widget: object, content: object, buffers: object) -> None:
            self.send(json.loads(_answered(self._shelf, json.dumps(content))))

    return Board
