"""Speed against accuracy: what every method gets right, never how long it takes."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

import graphkin
import graphkin.races
from graphkin.api.studied import SpeedAccuracy
from graphkin.errors import CallError
from graphkin.races import PEERS_FILE, Race, _peer, lessons, race, race_page, race_table, to_json, work
from graphkin.races.work import Skipped
from graphkin.scene import mechanism_of
from graphkin.words import say
from tests.drawing.chart_words import off_the_page, overlapping

ROOT = Path(__file__).parents[2]
SIXBAR = "sixbar-guide-40deg"
SEEDS = 12  # drawings of a pencil, whose mean error hangs less on one of them than that of a race


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    monkeypatch.setattr(work, "ENOUGH", 0.0)


def raced(name: str = SIXBAR) -> Race:
    """A race run once, for calls with and without the default alike."""
    return _raced(name)


@cache
def _raced(name: str) -> Race:
    """A race, compiled for one mechanism, since numba takes seconds for each."""
    find = importlib.util.find_spec
    hidden = "" if name == SIXBAR else "numba"
    with (
        patch("importlib.util.find_spec", lambda package: None if package == hidden else find(package)),
        patch("graphkin.races.methods.SEEDS", SEEDS),
    ):
        return race(mechanism_of(name), repeats=1, count=480)


def errors(key: str, tag: str = "", name: str = SIXBAR) -> tuple[float | None, float | None]:
    velocity, acceleration = raced(name).of(key, tag).errors
    return velocity, acceleration


@pytest.mark.parametrize("key", ["closed arrays", "closed floats", "whole solve", "complex step", "exact drawing"])
@pytest.mark.parametrize("name", [SIXBAR, "hydraulic-cylinder"])
def test_methods_that_lose_nothing_give_15_digits(key: str, name: str) -> None:
    if key == "whole solve" and name == "hydraulic-cylinder":
        pytest.skip("a limited motion has no turn")
    assert all(e < 2e-14 for e in errors(key, name=name))


def test_compiled_loops_give_15_digits() -> None:
    pytest.importorskip("numba")
    assert all(e < 2e-14 for e in errors("closed compiled"))


def test_single_precision_gives_7_digits() -> None:
    assert all(1e-8 < e < 1e-5 for e in errors("closed single"))


def test_newton_squares_its_error_with_every_step() -> None:
    one, two, three = (errors("Newton", k)[0] for k in "123")
    assert two == pytest.approx(one**2, rel=10)
    assert three < 100 * two**2


def test_four_steps_of_newton_are_enough() -> None:
    assert all(e < 1e-14 for e in errors("Newton", "4"))


def test_differences_of_velocity_are_best_at_a_step_of_1e_5() -> None:
    found = {k: errors("differences", f"1e-{k}")[0] for k in range(1, 10)}
    assert 5 == min(found, key=found.get)


def test_differences_of_acceleration_are_best_at_a_step_of_1e_4() -> None:
    found = {k: errors("differences", f"1e-{k}")[1] for k in range(1, 10)}
    assert 4 == min(found, key=found.get)


def test_instant_centres_give_velocities_to_15_digits() -> None:
    assert errors("instant centres")[0] < 1e-14


def test_instant_centres_give_no_accelerations() -> None:
    assert errors("instant centres")[1] is None


def test_a_cad_screen_gives_four_digits() -> None:
    assert all(1e-6 < e < 1e-3 for e in errors("cad drawing"))


def test_a_pencil_on_a_quarter_of_the_paper_errs_more_than_on_all_of_it() -> None:
    assert errors("pencil", "0.25")[0] > 2 * errors("pencil", "1")[0]


def test_by_hand_errs_as_the_simulated_pencil_does() -> None:
    assert errors("pencil", "1") == errors("by hand", "1")


def test_what_is_asked_for_alone_is_as_exact_as_all_of_it() -> None:
    assert all(e < 1e-14 for key in ("exact drawing", "closed floats") for e in errors(key, "asked"))


def test_pylinkage_agrees_with_the_reference_where_it_is_installed() -> None:
    pytest.importorskip("pylinkage")
    assert all(e < 1e-11 for e in errors("pylinkage", name="fourbar-150-500-300-400"))


def test_a_peer_that_is_not_installed_is_left_out_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(Skipped, match="not installed"):
        next(_peer("pylinkage", None, 1))


def test_what_runs_other_programs_is_not_installed_and_the_race_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    assert Path(graphkin.__file__).parent not in PEERS_FILE.parents
    monkeypatch.setattr(graphkin.races, "PEERS_FILE", Path("no", "peers.py"))
    with pytest.raises(Skipped) as error:
        next(_peer("scipy", None, 1))
    assert "is raced from the repository alone" == say(error.value.why, "en")


def test_a_mechanism_without_closed_form_is_refused_by_name() -> None:
    with pytest.raises(graphkin.CallError, match="no closed form"):
        graphkin.speed_accuracy("double-butterfly")


@pytest.mark.parametrize("name", ["cam-flat-face", "gears-epicyclic", "wheel-on-rail"])
def test_a_mechanism_with_a_cam_or_with_rolling_links_is_refused(name: str) -> None:
    with pytest.raises(graphkin.CallError, match=rf"^{name}: moves by a cam or by rolling"):
        graphkin.speed_accuracy(name)


def test_without_mpmath_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mpmath", None)
    with pytest.raises(graphkin.CallError, match=r"graphkin\[study\]"):
        graphkin.stability(kinds=["crossing height"])


def test_the_caption_tells_cores_versions_and_repeats() -> None:
    found = raced()
    told = race_page(found).desc
    assert f"{found.machine[0]} cores" in told
    assert found.machine[2]["numpy"] in told
    assert "best of 1 runs" in told


def _spread(found: Race) -> Race:
    """The race with costs that depend on no clock: each kind of method half a decade after the one before."""
    keys = list(dict.fromkeys(e.key for e in found.entries))
    costs = {key: 10.0 ** (-8.0 + 0.5 * i) for i, key in enumerate(keys)}
    entries = tuple(replace(e, costs=(costs[e.key],) * 2) for e in found.entries)
    return replace(found, entries=entries, copying=(2e-9, 6e-9))


def _elsewhere(found: Race, seed: int) -> Race:
    """The race as another machine would run it: every cost and error some times larger or smaller."""
    rng = np.random.default_rng(seed)

    def about(x: float | None) -> float | None:
        return x and float(x * 10 ** rng.uniform(-0.7, 0.7))

    return replace(
        found, entries=tuple(replace(e, costs=[*map(about, e.costs)], errors=[*map(about, e.errors)])
                             for e in found.entries)
    )


@pytest.mark.parametrize(("seed", "language"), [(seed, ("en", "zh")[seed % 2]) for seed in range(6)])
def test_no_two_labels_of_the_chart_overlap_on_any_machine(seed: int, language: str) -> None:
    drawn = race_page(_elsewhere(_spread(raced()), seed), language)
    assert [] == overlapping(drawn)
    assert [] == off_the_page(drawn)


@pytest.mark.parametrize(("kind", "order"), [("velocity", 0), ("acceleration", 1)])
def test_every_method_is_a_point_of_the_chart(kind: str, order: int) -> None:
    race = _spread(raced())
    panel = next(axes for axes in race_page(race).figure().axes if axes.get_gid() == f"speed-{kind}")
    shown = {(x, y) for line in panel.lines if line.get_marker() != "None" for x, y in line.get_xydata()}
    assert shown == {
        (e.costs[order], max(e.errors[order], 1.5e-19)) for e in race.entries
        if e.errors[order] is not None and e.errors[order] <= 10.0
    }


def test_the_table_has_a_row_for_every_method_and_the_floor() -> None:
    found = raced()
    floor, first, *others = race_table(found).texts()
    entry = found.entries[0]
    numbers = [*zip(entry.costs, entry.errors, strict=True)]
    assert len(found.entries) == 1 + len(others)
    assert ("copying", "", "floor", f"{found.copying[0]:.3g}", "", f"{found.copying[1]:.3g}", "") == floor
    assert [f"{number:.3g}" for pair in numbers for number in pair] == list(first[3:])


def test_the_result_gives_a_method_by_its_name() -> None:
    found = SpeedAccuracy(raced(), "en")
    assert [str(k) for k in range(1, 7)] == [e.tag for e in found["Newton"]]
    with pytest.raises(graphkin.CallError, match="Newton"):
        found["Newto"]


def test_the_table_is_written_beside_the_chart(tmp_path) -> None:
    SpeedAccuracy(raced(), "en").write(tmp_path)
    assert {"speed-accuracy.csv", "speed-accuracy.svg"} == {p.name for p in tmp_path.iterdir()}
    assert race_table(raced()).csv() == (tmp_path / "speed-accuracy.csv").read_text()


def test_nothing_but_its_own_function_loads_the_races() -> None:
    used = "import graphkin, sys; graphkin.sweep('four-bar-coupler-point').figures; "
    script = used + "print('graphkin.races' in sys.modules)"
    assert "False" in subprocess.run([sys.executable, "-c", script], capture_output=True, text=True).stdout


def test_the_data_name_every_method_once() -> None:
    found = [(m["method"], m["tag"]) for m in to_json(raced())["methods"]]
    assert len(set(found)) == len(found)


@pytest.mark.parametrize("seed", range(4))
def test_every_number_of_what_is_concluded_is_one_of_the_chart(seed: int) -> None:
    found = _elsewhere(_spread(raced()), seed)
    draw, compute, lose = lessons(found)
    hand, large, closed = found.of("by hand", "1"), found.of("by hand", "4"), found.of("closed arrays")
    drawn, single = found.of("exact drawing"), found.of("closed single")
    worst = [100 * max(e.errors) for e in (hand, large)]
    assert hand.costs[1] / 60 == pytest.approx(float(draw.gaps["minutes"]), rel=0.06)
    assert worst == pytest.approx([float(draw.gaps["error"]), float(draw.gaps["large_error"])], rel=0.06)
    assert drawn.costs[1] * 1e3 == pytest.approx(float(draw.gaps["exact_time"]), rel=0.06)
    assert closed.costs[1] / drawn.costs[1] == pytest.approx(float(compute.gaps["times"]), rel=0.01)
    slower = single.costs[1] / closed.costs[1]
    assert slower == pytest.approx(float(lose.gaps["single_times"]), rel=0.01)
    best = min(e.errors[0] for e in found.entries if e.key == "differences")
    assert best == pytest.approx(float(lose.gaps["velocity"]), rel=0.6)


def test_a_moving_link_without_a_point_is_told_to_want_one():
    block = {"frame": {"name": "0", "guides": {"h": {"through": [0, 0], "angle": 0}}}, "links": {"1": {"on": "0.h"}},
             "driver": {"slide": "1/0", "travel": 10, "velocity": 5}}
    with pytest.raises(CallError, match="nothing moves that could be looked at; give a moving link a point"):
        graphkin.speed_accuracy(block, repeats=1)
