"""``graphkin centres``: what is printed, what is written, and the exit status."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

import graphkin
from graphkin.scene.symbol import Symbol
from tests import command
from tests.mechanisms import random_scene


def run(*args: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return command.run("centres", *args, cwd=cwd)


def test_the_json_has_the_frame_first_among_the_links(tmp_path: Path) -> None:
    assert ["6", "1", "2", "3", "4", "5"] == json.loads(run("sixbar-420rpm", "--json", cwd=tmp_path).stdout)["links"]


def test_a_pair_is_written_with_the_frame_last(tmp_path: Path) -> None:
    assert "2-1" in json.loads(run("shaper-scheme-2", "--json", cwd=tmp_path).stdout)["centres"]


def test_a_found_centre_says_which_lines_cross_in_it() -> None:
    found = graphkin.centres("sixbar-420rpm").data["centres"]["1-3"]
    assert ("found", [["1-6", "3-6"], ["1-2", "2-3"]]) == (found["kind"], found["by"])


def test_a_centre_at_infinity_has_a_direction_and_no_point() -> None:
    assert {"direction": [0.0, 1.0], "kind": "permanent"} == graphkin.centres("sixbar-420rpm").data["centres"]["5-6"]


def test_a_centre_found_in_another_way_names_it_and_says_why() -> None:
    found = graphkin.centres("double-butterfly").data["centres"]["3-1"]
    assert ("superposition", True) == (found["by"], found["why"].startswith("Kennedy"))


def test_a_check_has_velocities_by_centres_beside_those_of_the_polygon() -> None:
    rows = {r["symbol"]: r for r in graphkin.check("sixbar-guide-40deg").data["readings"]}
    assert rows["v_D"]["by_centres"] == pytest.approx(rows["v_D"]["exact"], rel=1e-12)


def test_an_acceleration_has_no_value_by_centres() -> None:
    rows = {r["symbol"]: r for r in graphkin.check("sixbar-guide-40deg").data["readings"]}
    assert "by_centres" not in rows["a_D"]


def test_the_figure_and_a_table_are_written(tmp_path: Path) -> None:
    run("slider-crank-offset", cwd=tmp_path)
    assert ["centres.csv", "centres.svg"] == sorted(p.name for p in (tmp_path / "slider-crank-offset").iterdir())


def test_json_alone_writes_no_file(tmp_path: Path) -> None:
    run("slider-crank-offset", "--json", cwd=tmp_path)
    assert [] == list(tmp_path.iterdir())


def test_draw_writes_the_centres_too(tmp_path: Path) -> None:
    names = {p.name for p in graphkin.draw("slider-crank-offset").write(tmp_path)}
    assert "centres.svg" in names


def test_a_centrode_is_written_on_request(tmp_path: Path) -> None:
    run("slider-crank-offset", "--centrode", "2", "--point", "S2", "-o", "out", cwd=tmp_path)
    assert ["centrode.csv", "centrode.svg"] == sorted(p.name for p in (tmp_path / "out").iterdir())


def test_a_centrode_for_programs_names_its_files(tmp_path: Path) -> None:
    printed = json.loads(run("four-bar-coupler-point", "--centrode", "2", "--json", "-o", "c", cwd=tmp_path).stdout)
    assert {"link": "2", "ok": True, "files": ["c/centrode.svg", "c/centrode.csv"]} == printed


@pytest.mark.parametrize(
    ("args", "status"),
    [
        (("four-bar-coupler-point",), 0),
        (("four-bar-coupler-point", "--centrode", "9"), 2),
        (("four-bar-coupler-point", "--point", "E"), 2),
        (("four-bar-coupler-point", "--lang", "xx"), 2),
        (("four-bar-coupler-point", "--format", "gif"), 2),
        (("sixbar-AE70", "--at", "120"), 3),
    ],
)
def test_the_exit_status_tells_what_went_wrong(args: tuple[str, ...], status: int, tmp_path: Path) -> None:
    assert status == run(*args, cwd=tmp_path).returncode


def test_a_position_out_of_reach_is_still_json(tmp_path: Path) -> None:
    printed = json.loads(run("sixbar-AE70", "--at", "120", "--json", cwd=tmp_path).stdout)
    assert "not assembled" == printed["status"]


@pytest.mark.parametrize("angle", [30, 45, 60, 90, 180, 270])
def test_a_single_rate_is_judged_by_the_whole_mechanism(angle: float) -> None:
    scene = graphkin.read("slider-crank-s50-e16-K1.2").mechanism
    assert graphkin.centres(scene.asking(find=(Symbol.parse("omega_2"),)), at=angle).ok


def slider_crank(crank: float, rod: float, angle: float) -> dict[str, Any]:
    return {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": crank},
            "2": {"points": ["B", "C"], "length": rod},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": angle, "omega": 10},
    }


@pytest.mark.parametrize("angle", [0.01, 90, 179.99])
def test_velocities_by_centres_hold_near_a_dead_centre(angle: float) -> None:
    assert [True] * 5 == [v.ok for v in graphkin.centres(slider_crank(50, 120, angle)).velocities]


@pytest.mark.parametrize(
    ("mechanism", "at"),
    [
        (random_scene(1016, ("PRP", "RPR", "RRR")), -186.3134797714),
        (random_scene(110, ("PRP", "slotted", "slotted"), "slot"), 82.41120347858725),
    ],
)
def test_centres_may_be_off_by_what_a_rate_loses_over_a_short_arm(mechanism: dict[str, Any], at: float) -> None:
    # two guides turn parallel: short links slide far off, and the velocities of their ends differ by 1e-10
    made = graphkin.centres(mechanism, at=at)
    assert made.ok
    # rates that are read lose nothing
    assert 1e-12 > min(centre.error for centre in made.centres.found if centre.way)


def test_a_tiny_crank_before_a_long_rod_has_its_rate_by_centres_too() -> None:
    assert {True} == {v.ok for v in graphkin.centres(slider_crank(1e-6, 1e3, 40)).velocities}


def test_a_rate_that_no_centre_gives_is_none_with_the_reason() -> None:
    found = graphkin.centres(slider_crank(50, 120, 40))
    found.centres.turning.clear()
    row = found.data["velocities"]["omega_2"]
    assert (None, None, True) == (row["by_centres"], row["ok"], "why" in row)


@pytest.mark.parametrize("name", ["sixbar-guide-40deg", "cam-flat-face", "disc-on-disc", "hydraulic-cylinder"])
def test_centres_of_a_mechanism_at_rest_are_compared_with_those_of_any_motion(name: str) -> None:
    source = graphkin.read(name).to_dict()
    rate = "velocity" if "slide" in source["driver"] else "omega"
    source["driver"] = {k: v for k, v in source["driver"].items() if k not in ("rpm", "alpha")} | {rate: 0}
    rests = graphkin.centres({k: v for k, v in source.items() if k not in ("printed", "find")})
    assert rests.ok
    assert None not in [error for pair, error in rests.errors.items() if rests.centres.table[pair].place is not None]


def test_data_of_centres_are_in_english_in_every_language() -> None:
    one, other = (graphkin.centres("sixbar-coupler-2A", language=language).data for language in ("en", "zh"))
    assert one == other
