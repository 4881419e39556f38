"""Sweeps through executors: complete, the same byte for byte, resumed where they stopped."""

from __future__ import annotations

import hashlib
import os
import signal
import tomllib
from collections.abc import Callable
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pytest

from graphkin.errors import CallError
from graphkin.scene import library_text, read
from graphkin.scene.symbol import Symbol
from graphkin.study import Plan, designs_of, run, scheduler
from graphkin.study import chunks as chunks_room


@pytest.fixture
def plan(monkeypatch: pytest.MonkeyPatch) -> Plan:
    monkeypatch.setattr(chunks_room, "BLOCK", 40)
    return new_plan()


def new_plan() -> Plan:
    source = tomllib.loads(library_text("fourbar-150-500-300-400"))
    # some of them cannot turn fully, the last cannot be assembled at all
    designs = designs_of({"links.1.length": "100,150,250,1000", "driver.omega": "5,-5"})
    return Plan(source, "four-bar", designs, 20, (Symbol.parse("omega_3"), Symbol.parse("v_C")))


def prints(folder: Path) -> dict[str, str]:
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.iterdir())}


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


def test_every_design_has_its_rows_whatever_became_of_it(plan: Plan, tmp_path: Path) -> None:
    run(plan, tmp_path)
    lines = (tmp_path / "table.csv").read_text().splitlines()
    assert len(lines) == 1 + 8 * 20


def test_a_design_that_fails_is_a_row_with_status_and_reason(plan: Plan, tmp_path: Path) -> None:
    run(plan, tmp_path)
    last = (tmp_path / "designs.csv").read_text().splitlines()[-1]
    assert "not assembled" in last
    assert "do not reach each other" in last


def test_another_executor_gives_the_same_bytes(plan: Plan, tmp_path: Path) -> None:
    run(plan, tmp_path / "a")
    with ThreadPoolExecutor(3) as pool:
        run(plan, tmp_path / "b", pool)
    assert prints(tmp_path / "a") == prints(tmp_path / "b")


def test_processes_give_the_same_bytes(tmp_path: Path) -> None:
    plan = replace(new_plan(), positions=9000)
    run(plan, tmp_path / "a")
    run(plan, tmp_path / "b", workers=2)
    assert prints(tmp_path / "a") == prints(tmp_path / "b")


def test_a_broken_executor_loses_nothing(plan: Plan, tmp_path: Path) -> None:
    run(plan, tmp_path / "a")
    run(plan, tmp_path / "b", Synchronous(most=2))
    assert prints(tmp_path / "a") == prints(tmp_path / "b")


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no SIGKILL on this system")
def test_a_killed_process_loses_nothing(tmp_path: Path) -> None:
    plan = replace(new_plan(), positions=9000)
    run(plan, tmp_path / "a")
    pool = ProcessPoolExecutor(2, mp_context=get_context("spawn"))
    victims = [pool.submit(os.getpid).result()]

    def kill(done: int, total: int) -> None:
        if done > 0 and victims:
            os.kill(victims.pop(), signal.SIGKILL)

    run(plan, tmp_path / "b", pool, progress=kill)
    pool.shutdown()
    assert prints(tmp_path / "a") == prints(tmp_path / "b")


def test_an_interrupted_sweep_goes_on_where_it_stopped(plan: Plan, tmp_path: Path) -> None:
    run(plan, tmp_path / "a")

    def interrupt(done: int, total: int) -> None:
        if done >= total / 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(plan, tmp_path / "b", progress=interrupt)
    rest = Synchronous()
    run(plan, tmp_path / "b", rest)
    assert (2, prints(tmp_path / "a")) == (rest.given, prints(tmp_path / "b"))


def test_an_interrupted_sweep_shows_no_table(plan: Plan, tmp_path: Path) -> None:
    def interrupt(done: int, total: int) -> None:
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(plan, tmp_path, progress=interrupt)
    assert [p for p in tmp_path.iterdir() if not p.name.startswith(".")] == []


def test_chunks_of_another_sweep_are_not_used(plan: Plan) -> None:
    assert plan.key != replace(plan, positions=21).key


def test_a_finished_sweep_leaves_nothing_behind(plan: Plan, tmp_path: Path) -> None:
    run(plan, tmp_path)
    assert ["designs.csv", "table.csv"] == sorted(p.name for p in tmp_path.iterdir())


def test_positions_of_a_long_turn_are_the_same_in_one_chunk_or_many(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    long = Plan(read("slider-crank-offset"), "x", designs_of(None), 100)
    run(long, tmp_path / "a")
    monkeypatch.setattr(chunks_room, "BLOCK", 64)
    run(replace(long), tmp_path / "b")
    assert prints(tmp_path / "a") == prints(tmp_path / "b")


def test_a_position_out_of_reach_has_its_reason(tmp_path: Path) -> None:
    run(Plan(read("sixbar-AE70"), "x", designs_of(None), 12), tmp_path)
    rows = (tmp_path / "table.csv").read_text().splitlines()[1:]
    away = [r for r in rows if "not assembled" in r]
    assert len(away) == 8
    assert all("the motion reaches from" in r for r in away)


def test_parquet_holds_the_numbers_of_the_csv(plan: Plan, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    csv = pytest.importorskip("pyarrow.csv", reason="pyarrow is not installed")
    run(plan, tmp_path, parquet=True)
    table, text = parquet.read_table(tmp_path / "table.parquet"), csv.read_csv(tmp_path / "table.csv")
    assert text.column("omega_3 (rad/s)").to_pylist() == table.column("omega_3 (rad/s)").to_pylist()


def test_a_dask_cluster_that_loses_a_worker_gives_the_same_bytes(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="the extra cluster is not installed")
    plan = replace(new_plan(), positions=9000)
    run(plan, tmp_path / "a")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        victims = [next(iter(cluster.workers.values())).pid]

        def kill(done: int, total: int) -> None:
            if done > 0 and victims:
                os.kill(victims.pop(), signal.SIGKILL)

        with scheduler(cluster.scheduler_address) as executor:
            run(plan, tmp_path / "b", executor, progress=kill)
    assert prints(tmp_path / "a") == prints(tmp_path / "b")


def test_a_scheduler_that_does_not_answer_is_a_wrong_call() -> None:
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    with pytest.raises(CallError, match="no Dask scheduler answers"):
        scheduler("nonsense address")
