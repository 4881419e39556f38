"""Other programs' mechanisms: files of PMKS and PMKS+, Linkage, pyslvs, pylinkage and GeoGebra, read and written; a
file's program is known by its name and its content."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from graphkin.errors import CallError
from graphkin.exchange.bodies import FRAME, Bodies, BodySlide
from graphkin.exchange.constructions import LARGEST, read_geogebra
from graphkin.exchange.joint_lists import is_address, read_address, read_pyslvs, read_table, write_pyslvs
from graphkin.exchange.linkages import read_linkage2, read_pylinkage, write_linkage2, write_pylinkage
from graphkin.files import opened
from graphkin.words import from_others, listed

__all__ = ["FRAME", "READ", "Bodies", "BodySlide", "is_address", "read_bodies", "write_bodies"]

READ = (".linkage2", ".pyslvs", ".json", ".ggb", ".txt", ".csv", ".tsv", ".url")
"""Endings of files that are read; a shared link of PMKS+ may stand instead of a file."""
WRITTEN: Mapping[str, Callable[[Bodies], str]] = {
    ".linkage2": write_linkage2, ".pyslvs": write_pyslvs, ".json": write_pylinkage
}
"""Writers by the ending of the file's name."""


def read_bodies(source: str) -> Bodies:
    """The bodies of a file of another program, or of a shared link of PMKS+.

    Raises
    ------
    CallError : there is no such file, or its program is unknown
    """
    if "://" in source or (is_address(source) and not Path(source[:200]).exists()):
        return read_address(source, "PMKS") if is_address(source) else read_table(source, "PMKS")
    path = Path(source)
    title, kind = path.stem, path.suffix.lower()
    if kind not in READ:
        raise CallError.of(path.name[:100], "is of no program known here", "known", kind=kind, names=listed([*READ]))
    try:
        with opened(path) as stream:
            data = stream.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        raise CallError.of(str(path)[:200], "cannot be read", reason=from_others(error)) from None
    if len(data) > LARGEST:
        raise CallError.of(str(path), "is larger than 20 mb", "a mechanism is smaller")
    if kind == ".ggb":
        return read_geogebra(data, title)
    if data.startswith(b"SQLite format 3"):
        raise CallError.of(path.name, "is a data base of an early pyslvs", "open it in pyslvs and save it as")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    if kind == ".linkage2" or text.lstrip().startswith("<linkage2"):
        return read_linkage2(text, title)
    if kind == ".json":
        return read_pylinkage(text, title)
    if kind == ".pyslvs" or "M[" in text:
        return read_pyslvs(text, title)
    return read_address(text, title) if is_address(text) else read_table(text, title)


def write_bodies(bodies: Bodies, ending: str) -> str:
    """The text of a file for another program, by the ending of its name.  Raises CallError for an unknown one."""
    if ending not in WRITTEN:
        raise CallError.of("convert", "is of no program that is written here", "known", ending=ending,
                           names=listed([".toml", *WRITTEN]))
    return WRITTEN[ending](bodies)
