"""Where commands print to: a reader that has gone away ends nothing, a full disk is a sentence."""

from __future__ import annotations

import io
import os
import sys
from contextlib import suppress
from typing import Any

__all__ = ["Unwritable", "own_streams"]


class Unwritable(OSError):
    """What is printed cannot be kept where it goes."""


class _Pipe(io.FileIO):
    """A file of the system.  What nobody reads any more is dropped, so that a command does what it was called for, and
    gives the status of that, also under ``| head``."""

    def write(self, text: Any) -> int:
        try:
            return super().write(text)
        except OSError as error:
            _drop(self.fileno())
            if isinstance(error, BrokenPipeError) or self.fileno() == 2:
                return len(memoryview(text).cast("B"))
            raise Unwritable(error.errno, error.strerror) from None


def _drop(handle: int) -> None:
    """Let everything that is still written to a file of the system go nowhere."""
    with suppress(OSError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, handle)
        os.close(nowhere)


def own_streams() -> None:
    """Standard output and error in UTF-8 whatever the terminal says, and careful of who reads them."""
    for name, handle in (("stdout", 1), ("stderr", 2)):
        stream = getattr(sys, name)
        if stream is None:  # closed by who called
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif stream is getattr(sys, f"__{name}__") and _is(stream, handle):
            careful = io.BufferedWriter(_Pipe(handle, "wb", closefd=False))
            lines = handle == 2 or stream.isatty()
            setattr(sys, name, io.TextIOWrapper(careful, "utf-8", "replace", line_buffering=lines))
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="replace")


def _is(stream: Any, handle: int) -> bool:
    try:
        return bool(stream.fileno() == handle)
    except (OSError, ValueError, AttributeError):
        return False
