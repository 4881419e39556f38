"""The examples in Python: each runs, finds what its text says, and gives the picture that is committed beside it."""

from __future__ import annotations

from functools import cache
from typing import Any

import matplotlib
import numpy as np
import pytest

from tests.letters import unpacked

from .test_figures import FIGURES, make


@cache
def ran(example: str) -> tuple[dict[str, Any], bytes]:
    return make.run(example)


@pytest.mark.parametrize("example", make.EXAMPLES)
def test_the_committed_picture_of_an_example_is_redrawn(example: str) -> None:
    committed = (FIGURES / "examples" / f"{example}.svg").read_bytes()
    if b"Matplotlib v" in committed and f"Matplotlib v{matplotlib.__version__}".encode() not in committed:
        pytest.skip("charts change with matplotlib")
    assert unpacked(committed) == unpacked(ran(example)[1])


def test_the_chinese_page_of_the_layouts_is_redrawn() -> None:
    committed = (FIGURES / "examples" / "coriolis_layouts_zh.svg").read_bytes()
    redrawn = ran("coriolis_layouts")[0]["picture_zh"].content("svg")
    assert unpacked(committed) == unpacked(redrawn)


def test_the_crank_found_gives_the_wanted_stroke() -> None:
    # twice the bar's length times the sine of its swing, crank over distance of the pivots
    assert 320 * 350 / (2 * 580) == pytest.approx(ran("optimise_crank")[0]["crank"], rel=1e-12)


def test_every_convention_reads_the_same() -> None:
    readings = ran("compare_conventions")[0]["readings"]
    assert 4 == len(readings)
    assert pytest.approx(readings["chinese"], rel=1e-12) == min(readings.values()) == max(readings.values())


def test_the_driver_makes_the_class() -> None:
    wanted = {"crank": [(2, ["2", "3"]), (2, ["5", "6"])], "last link": [(3, ["1", "2", "3", "5"])]}
    assert wanted == ran("two_drivers")[0]["classes"]


def test_the_crank_turns_as_before_when_the_last_link_drives() -> None:
    assert 1.0 == pytest.approx(ran("two_drivers")[0]["crank_rate"], rel=1e-9)


def test_four_of_eight_layouts_have_a_coriolis_term() -> None:
    wanted = [True, False, False, True, True, True, False, False]
    assert wanted == [*ran("coriolis_layouts")[0]["with_term"].values()]


def test_the_path_of_the_coupler_point_is_closed() -> None:
    path = ran("coupler_curve")[0]["path"]
    assert abs(path[0] - path[-1]) < 2 * np.abs(np.diff(path)).max()


def test_a_longer_crank_gives_a_faster_return() -> None:
    fastest = ran("sweep_xarray")[0]["fastest"].values
    assert (5, True) == (len(fastest), bool((np.diff(fastest) > 0).all()))
