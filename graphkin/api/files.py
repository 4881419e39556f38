"""Files of a result: all of them in one folder, each whole or not at all."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from graphkin.errors import CallError, Problem

__all__ = ["half_written", "write_files"]


def write_files(folder: Path, files: Mapping[str, bytes]) -> list[Path]:
    """Write files by name into a folder, which is made if it is not there; returns their paths.

    Raises
    ------
    CallError : the folder cannot be written
    """
    from graphkin.drawing.save import write_whole

    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in files.items():
            write_whole(folder / name, content)
    except OSError as error:
        where = Problem(str(folder), f"cannot be written: {error.strerror}", "give another folder with -o")
        raise CallError(where) from None
    return [folder / name for name in files]


def half_written(folder: Path, stem: str) -> list[Path]:
    """What a process that was killed while writing files of this stem has left in a folder."""
    pattern = re.compile(rf"\.{re.escape(stem)}-.*\.[a-z0-9_]{{8}}")
    return [path for path in folder.glob(".*") if pattern.fullmatch(path.name)]
