"""The command line as a user starts it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

__all__ = ["PROGRAM", "run"]

PROGRAM = [sys.executable, "-c", "from graphkin.cli import main; main()"]


def run(*args: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """What a command prints and its exit status."""
    call = [*PROGRAM, *args]
    return subprocess.run(call, capture_output=True, text=True, encoding="utf-8", cwd=cwd, timeout=120, check=False)
