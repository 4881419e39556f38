"""The command line as a user meets it: what it prints and its exit status, here or in a process of its own."""

from __future__ import annotations

import contextlib
import io
import subprocess
import sys
from pathlib import Path
from unittest import mock

from graphkin.cli import main

__all__ = ["PROGRAM", "run", "start"]

PROGRAM = [sys.executable, "-m", "graphkin"]


def run(*args: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """What a command prints and its exit status, without the second that a process takes to start."""
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8") for _ in range(2))
    status = 0
    with (
        mock.patch.object(sys, "argv", ["graphkin", *args]),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
        contextlib.chdir(cwd or Path.cwd()),
    ):
        try:
            main()
        except SystemExit as end:
            status = end.code or 0
    said = []
    for stream in (out, err):
        stream.flush()
        said.append(stream.buffer.getvalue().decode("utf-8"))
    return subprocess.CompletedProcess(args, status, *said)


def start(*args: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """The same of a process of its own, which imports the graphkin of its folder if there is one."""
    call = [*PROGRAM, *args]
    return subprocess.run(call, capture_output=True, text=True, encoding="utf-8", cwd=cwd, timeout=120, check=False)
