"""Every way to the values of a changed scene gives the same: some keys of some scenes, chosen by their names; all keys
of all scenes by hand with ``tests.bench.routes``."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from zlib import crc32

import pytest

from tests.bench.routes import clean_processes, differences

KEYS = 2  # of each scene
SCENES = [
    "cam-eccentric-flat-rocker", "cam-offset-roller", "disc-on-disc", "engine-gas-force", "fourbar-150-500-300-400",
    "gears-epicyclic", "geneva-step", "hydraulic-cylinder", "hypocycloid-straight-line", "oldham-coupling",
    "shaper-forces", "swinging-block", "toggle-press-force", "wheel-on-rail",
]


@pytest.fixture(scope="module")
def alone() -> Iterator[ProcessPoolExecutor]:
    with clean_processes() as processes:
        yield processes


@pytest.mark.parametrize("name", SCENES)
def test_a_changed_number_gives_the_same_by_every_way_or_is_refused_by_name(
    name: str, alone: ProcessPoolExecutor
) -> None:
    def some(keys: list[str]) -> list[str]:
        return sorted(keys, key=lambda key: crc32(f"{name} {key}".encode()))[:KEYS]

    assert [] == list(differences(name, alone, some))
