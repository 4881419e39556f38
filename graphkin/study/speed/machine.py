"""What a measurement was made on."""

from __future__ import annotations

import os
import platform
from dataclasses import dataclass
from importlib import metadata

__all__ = ["Machine", "this_machine"]

PACKAGES = ("numpy", "shapely", "numba", "scipy", "pylinkage", "mpmath")


@dataclass(frozen=True)
class Machine:
    """Cores and processor, and the versions of what took part."""

    cores: int
    processor: str
    versions: tuple[tuple[str, str], ...]


def this_machine() -> Machine:
    """The machine that this runs on."""
    from graphkin.version import __version__

    versions = [("graphkin", __version__), ("Python", platform.python_version())]
    for name in PACKAGES:
        try:
            versions.append((name, metadata.version(name)))
        except metadata.PackageNotFoundError:
            continue
    return Machine(os.cpu_count() or 1, _processor(), tuple(versions))


def _processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = [line.partition(":")[2].strip() for line in file if line.startswith("model name")]
    except OSError:
        names = []
    return names[0] if names else platform.processor() or platform.machine()
