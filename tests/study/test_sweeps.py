"""Sweeps through executors: complete, the same byte for byte, resumed where they stopped."""

from __future__ import annotations

import hashlib
import os
import pickle
import signal
import subprocess
import sys
import time
import tomllib
from collections.abc import Callable
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import graphkin
from graphkin.jobs import Progress, Workers, cluster
from graphkin.scene import library_text, mechanism_of
from graphkin.scene.symbol import Symbol
from graphkin.study import sweeps
from graphkin.study.designs import designs_of
from graphkin.study.sweeps import FollowedDesign, Outcome, Sweep, collect, write_tables


@pytest.fixture
def plan(monkeypatch: pytest.MonkeyPatch) -> Sweep:
    monkeypatch.setattr(sweeps, "BLOCK", 40)
    return new_plan()


def run(
    sweep: Sweep,
    folder: Path,
    executor: Executor | None = None,
    processes: int | None = None,
    parquet: bool = False,
    progress: Progress | None = None,
) -> tuple[tuple[Path, ...], tuple[Outcome, ...], int]:
    with Workers(executor, processes) as workers:
        return write_tables(sweep, folder, workers, parquet, progress)


def watched(name: str) -> Symbol:
    return Symbol.parse(name)


def new_plan() -> Sweep:
    source = tomllib.loads(library_text("fourbar-150-500-300-400"))
    # some of them cannot turn fully, the last cannot be assembled at all
    designs = designs_of({"links.1.length": "100,150,250,1000", "driver.omega": "5,-5"})
    base = FollowedDesign(mechanism_of(source), (watched("omega_3"), watched("v_C")))
    return Sweep(base, "four-bar", 20, designs, source)


def prints(folder: Path) -> dict[str, str]:
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.iterdir())}


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The plan's files, written at one go."""
    folder = tmp_path_factory.mktemp("plan")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sweeps, "BLOCK", 40)
        run(new_plan(), folder)
    return folder


class Synchronous(Executor):
    """An executor that works at once, here; it breaks after some chunks if told to."""

    def __init__(self, most: int = 10**9) -> None:
        self.most, self.given = most, 0

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        self.given += 1
        future: Future[Any] = Future()
        if self.given > self.most:
            future.set_exception(BrokenProcessPool("a worker was lost"))
        else:
            future.set_result(fn(*args, **kwargs))
        return future


def test_every_design_has_its_rows_whatever_became_of_it(whole: Path) -> None:
    _, *lines = (whole / "table.csv").read_text().splitlines()
    assert [str(number) for number in range(1, 9) for _ in range(20)] == [line.split(",")[0] for line in lines]


def test_a_design_that_fails_is_a_row_with_status_and_reason(whole: Path) -> None:
    last = (whole / "designs.csv").read_text().splitlines()[-1]
    assert "not assembled" in last
    assert "do not reach each other" in last


def test_another_executor_gives_the_same_bytes(plan: Sweep, whole: Path, tmp_path: Path) -> None:
    with ThreadPoolExecutor(3) as pool:
        run(plan, tmp_path / "b", pool)
    assert prints(whole) == prints(tmp_path / "b")


def test_processes_give_the_same_bytes_in_files_and_in_memory(plan: Sweep, whole: Path, tmp_path: Path) -> None:
    with Workers(processes=2) as workers:
        write_tables(plan, tmp_path / "b", workers)
        table = collect(plan, workers)[0]
    assert prints(whole) == prints(tmp_path / "b")
    assert (whole / "table.csv").read_text() == table.csv()


def test_a_broken_executor_loses_nothing(plan: Sweep, whole: Path, tmp_path: Path) -> None:
    run(plan, tmp_path / "b", Synchronous(most=2))
    assert prints(whole) == prints(tmp_path / "b")


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no SIGKILL on this system")
def test_a_killed_process_loses_nothing(plan: Sweep, whole: Path, tmp_path: Path) -> None:
    pool = ProcessPoolExecutor(2, mp_context=get_context("spawn"))
    victims = [pool.submit(os.getpid).result()]

    def kill(done: int, total: int) -> None:
        if done > 0 and victims:
            os.kill(victims.pop(), signal.SIGKILL)

    run(plan, tmp_path / "b", pool, progress=kill)
    pool.shutdown()
    assert prints(whole) == prints(tmp_path / "b")


def test_an_interrupted_sweep_goes_on_where_it_stopped(plan: Sweep, whole: Path, tmp_path: Path) -> None:

    def interrupt(done: int, total: int) -> None:
        if done >= total / 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(plan, tmp_path / "b", progress=interrupt)
    rest = Synchronous()
    run(plan, tmp_path / "b", rest)
    assert (2, prints(whole)) == (rest.given, prints(tmp_path / "b"))


def test_a_damaged_piece_is_made_again_and_told(plan: Sweep, whole: Path, tmp_path: Path) -> None:
    def interrupt(done: int, total: int) -> None:
        if done >= total / 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(plan, tmp_path / "b", progress=interrupt)
    piece = min((tmp_path / "b").glob(".sweep-*/0*"))
    text = piece.read_bytes()
    piece.write_bytes(text[:-3] + (b"7" if text[-3:-2] != b"7" else b"8") + text[-2:])
    rest = Synchronous()
    _, _, damaged = run(plan, tmp_path / "b", rest)
    assert (3, 1, prints(whole)) == (rest.given, damaged, prints(tmp_path / "b"))


def test_an_interrupted_sweep_shows_no_table(plan: Sweep, tmp_path: Path) -> None:
    def interrupt(done: int, total: int) -> None:
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(plan, tmp_path, progress=interrupt)
    assert [p for p in tmp_path.iterdir() if not p.name.startswith(".")] == []


def test_chunks_of_another_sweep_are_not_used(plan: Sweep) -> None:
    assert plan.key != replace(plan, positions=21).key


def test_a_finished_sweep_leaves_nothing_behind(whole: Path) -> None:
    assert ["designs.csv", "table.csv"] == sorted(p.name for p in whole.iterdir())


def test_positions_of_a_long_turn_are_the_same_in_one_chunk_or_many(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    long = Sweep(FollowedDesign(mechanism_of("slider-crank-offset")), "x", 100)
    run(long, tmp_path / "a")
    monkeypatch.setattr(sweeps, "BLOCK", 64)
    run(replace(long), tmp_path / "b")
    assert prints(tmp_path / "a") == prints(tmp_path / "b")


def test_a_position_out_of_reach_has_its_reason(tmp_path: Path) -> None:
    run(Sweep(FollowedDesign(mechanism_of("sixbar-AE70")), "x", 12), tmp_path)
    rows = (tmp_path / "table.csv").read_text().splitlines()[1:]
    away = [r for r in rows if "not assembled" in r]
    assert len(away) == 8
    assert all("the motion reaches from" in r for r in away)


def test_parquet_holds_the_numbers_of_the_csv(plan: Sweep, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    csv = pytest.importorskip("pyarrow.csv", reason="pyarrow is not installed")
    run(plan, tmp_path, parquet=True)
    table, text = parquet.read_table(tmp_path / "table.parquet"), csv.read_csv(tmp_path / "table.csv")
    assert text.column("omega_3 (rad/s)").to_pylist() == table.column("omega_3 (rad/s)").to_pylist()


def test_a_dask_cluster_that_loses_a_worker_gives_the_same_bytes(plan: Sweep, whole: Path, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="the extra cluster is not installed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as local:
        victims = [next(iter(local.workers.values())).pid]

        def kill(done: int, total: int) -> None:
            if done > 0 and victims:
                os.kill(victims.pop(), signal.SIGKILL)

        with cluster(local.scheduler_address) as executor:
            run(plan, tmp_path / "b", executor, progress=kill)
    assert prints(whole) == prints(tmp_path / "b")


def test_a_sweep_in_memory_is_the_one_in_the_file(plan: Sweep, whole: Path) -> None:
    with Workers() as workers:
        table = collect(plan, workers)[0]
    assert (whole / "table.csv").read_text() == table.csv()


def test_a_sweep_is_made_when_its_table_is_read(plan: Sweep, whole: Path) -> None:
    assert (whole / "table.csv").read_text() == plan.table.csv()


@pytest.mark.parametrize("name", ["fourbar-150-500-300-400", "sixbar-AE70", "wheel-on-rail", "triad-slider"])
def test_a_design_takes_its_range_to_another_process(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = mechanism_of(name)
    here = FollowedDesign(scene, (watched(f"omega_{scene.links[-1].name}"),))
    _ = here.reach, here.engine
    there = pickle.loads(pickle.dumps(here))
    monkeypatch.delattr(sweeps, "driver_range")  # it is not followed again
    assert here.table(24, 0, 24) == there.table(24, 0, 24)


def test_all_pieces_in_one_process_share_the_scene_that_is_followed(plan: Sweep) -> None:
    assert {id(plan.base)} == {id(plan.piece(number).base) for number in range(plan.pieces)}


LONG = 114_688  # seven pieces


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    folder, name = tmp_path_factory.mktemp("whole"), "fourbar-150-500-300-400"
    run(Sweep(FollowedDesign(mechanism_of(name), (watched("v_C"),)), name, LONG), folder, parquet=True)
    return prints(folder)


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no SIGKILL on this system")
@pytest.mark.parametrize("sent", ["SIGKILL", "SIGINT"])
def test_a_killed_or_interrupted_command_goes_on(tmp_path: Path, sent: str, uninterrupted: dict[str, str]) -> None:
    name = "fourbar-150-500-300-400"
    call = [sys.executable, "-c", "from graphkin.cli import main; main()", "sweep", name, "-q", "--find", "v_C",
            "--positions", str(LONG), "-o"]
    first = subprocess.Popen([*call, str(tmp_path / "b")], stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 60
    while not list(tmp_path.glob("b/.sweep-*/0000001")) and time.monotonic() < deadline:
        time.sleep(0.005)
    first.send_signal(getattr(signal, sent))
    first.wait()
    left = len(list(tmp_path.glob("b/.sweep-*/0*")))
    assert 2 <= left < 7
    subprocess.run([*call, str(tmp_path / "b")], check=True)
    assert uninterrupted.items() <= prints(tmp_path / "b").items()


def test_designs_whose_driver_follows_from_the_speed_of_a_point_have_its_rate() -> None:
    # they were all at rest
    crank = {
        "frame": {"points": {"O": [0, 0]}, "guides": {"h": {"through": [0, -10], "angle": 0}}},
        "links": {
            "1": {"points": ["O", "A"], "length": 40}, "2": {"points": ["A", "B"], "length": 140},
            "3": {"points": ["B"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 70, "speed": 200, "of": "A", "sense": "clockwise"},
    }
    swept = graphkin.sweep(crank, designs={"links.1.length": [40, 50]}, positions=1, find=["v_B"])
    longer = graphkin.read(crank).replace("links.1.length", 50)
    wanted = [abs(graphkin.solve(scene)["v_B"][0]) for scene in (crank, longer)]
    assert wanted == pytest.approx(np.abs(np.ravel(swept["v_B"])).tolist())
