"""The page as ``graphkin open`` serves it, in a process of its own."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

from tests.command import PROGRAM

__all__ = ["served", "talking"]


@contextlib.contextmanager
def served(*args: str, cwd: Path) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """Its address and its process, which is interrupted in the end."""
    root = Path(__file__).parents[2]
    env = {**os.environ, "PYTHONPATH": str(root)}
    with subprocess.Popen(
        [*PROGRAM, "open", "--no-browser", *args], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=cwd,
        env=env,
    ) as process:
        assert process.stdout is not None
        try:
            yield process.stdout.readline().strip(), process
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(10)


@contextlib.contextmanager
def talking(url: str):
    """Asks over a socket of the page: ``ask({"do": "names"})``."""
    from websockets.sync.client import connect

    host = urlsplit(url).netloc
    with connect(f"ws://{host}{urlsplit(url).path}talk", origin=f"http://{host}", max_size=None, proxy=None) as socket:

        def ask(message: object) -> dict:
            socket.send(message if isinstance(message, str) else json.dumps(message))
            return json.loads(socket.recv())

        yield ask
