"""Long work: the same wherever it is done, nothing lost with a worker, nothing half written, ended at once."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from graphkin.errors import CallError
from graphkin.jobs import Checkpoints, Workers, cluster, key_of

PROGRAM = """
import os, sys, time
from graphkin.jobs import Workers
if __name__ == "__main__":
    with Workers(processes=2) as workers:
        print(workers.start(os.getpid)(), flush=True)
        for _ in workers.results(time.sleep, [(60,)] * 4):
            pass
"""


class Broken(Executor):
    """An executor whose workers are lost after some pieces."""

    def __init__(self, most: int, error: Exception) -> None:
        self.most, self.error, self.given = most, error, 0

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        self.given += 1
        future: Future[Any] = Future()
        if self.given > self.most:
            future.set_exception(self.error)
        else:
            future.set_result(fn(*args, **kwargs))
        return future


def square(x: int) -> int:
    return x * x


def late(x: int) -> int:
    time.sleep(0.05 if x == 0 else 0.0)
    return x


def lost_once(place: str) -> str:
    """Ends the process that does it, the first time."""
    try:
        Path(place).touch(exist_ok=False)
    except FileExistsError:
        return "done"
    os._exit(1)


def _runs(pid: int) -> bool:
    stat = Path(f"/proc/{pid}/stat")
    if stat.parent.parent.joinpath("self").exists():
        return stat.exists() and stat.read_text().rsplit(")", 1)[1].split()[0] != "Z"
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def _ended(pid: int) -> bool:
    deadline = time.monotonic() + 20
    while _runs(pid) and time.monotonic() < deadline:
        time.sleep(0.02)
    return not _runs(pid)


@pytest.mark.parametrize("error", [BrokenExecutor("lost"), RuntimeError("the worker is gone")])
def test_pieces_of_lost_workers_are_done_here(error: Exception) -> None:
    with Workers(Broken(2, error)) as workers:
        assert [0, 1, 4, 9, 16] == list(workers.results(square, [(k,) for k in range(5)]))


def test_results_come_in_the_order_of_the_pieces() -> None:
    with ThreadPoolExecutor(4) as pool, Workers(pool) as workers:
        assert list(range(20)) == list(workers.results(late, [(k,) for k in range(20)]))


def test_what_is_wrong_with_a_piece_is_raised() -> None:
    with ThreadPoolExecutor(1) as pool, Workers(pool) as workers, pytest.raises(TypeError):
        list(workers.results(square, [("x",)]))


def test_memory_stays_bounded() -> None:
    begun: list[int] = []

    def pieces() -> Any:
        for k in range(1000):
            begun.append(k)
            yield (k,)

    with ThreadPoolExecutor(2) as pool, Workers(pool) as workers:
        next(iter(workers.results(square, pieces())))
    assert len(begun) <= 2 * 4 + 1


@pytest.mark.parametrize(("processes", "ahead"), [(None, 0), (1, 0), (2, 8), (3, 12)])
def test_own_processes_have_four_pieces_each_and_this_process_alone_has_none(
    processes: int | None, ahead: int
) -> None:
    assert ahead == Workers(processes=processes).ahead


def test_an_executor_has_four_pieces_for_each_worker_it_tells_of_and_eight_at_least() -> None:
    silent = Broken(0, BrokenExecutor())
    with ThreadPoolExecutor(1) as one, ThreadPoolExecutor(3) as three:
        assert [8, 12, 8] == [Workers(executor).ahead for executor in (one, three, silent)]


def test_a_pool_whose_process_was_killed_is_replaced(tmp_path: Path) -> None:
    with Workers(processes=2) as workers:
        assert "done" == workers.start(lost_once, str(tmp_path / "once"))()


def test_a_piece_that_ends_every_process_is_a_sentence() -> None:
    with pytest.raises(CallError, match="again and again"), Workers(processes=2) as workers:
        workers.start(os._exit, 1)()


def test_a_process_that_may_have_no_children_does_the_pieces_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(multiprocessing.current_process()._config, "daemon", True)  # type: ignore[attr-defined]
    with Workers(processes=2) as workers:
        assert [os.getpid()] * 2 == list(workers.results(os.getpid, [()] * 2))


def test_a_pool_is_renewed_and_loses_no_piece() -> None:
    with Workers(processes=2, renewed=2) as workers:
        pids = list(workers.results(os.getpid, [()] * 5))
    assert (5, True) == (len(pids), len(set(pids)) >= 3)


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize(("sent", "most"), [(signal.SIGKILL, 20.0), (signal.SIGINT, 1.0)])
def test_processes_end_with_the_program_that_is_killed_or_interrupted(
    tmp_path: Path, sent: signal.Signals, most: float
) -> None:
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    with subprocess.Popen([sys.executable, program], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as parent:
        assert parent.stdout is not None
        worker = int(parent.stdout.readline())
        assert _runs(worker)
        parent.send_signal(sent)
        begin = time.monotonic()
        assert _ended(worker)
        parent.wait()
        assert time.monotonic() - begin < most


def test_a_checkpoint_gives_back_facts_and_content(tmp_path: Path) -> None:
    points = Checkpoints.of(tmp_path, "sweep", "1f")
    points.open(rows=3)
    points.save(7, {"good": 3}, b"1,2\n")
    pieces, damaged = points.done()
    with open(tmp_path / "copy", "wb") as out:
        pieces[7].copy(out)
    assert ([7], 0, {"good": 3}) == ([*pieces], damaged, pieces[7].facts)
    assert b"1,2\n" == (tmp_path / "copy").read_bytes()


DAMAGES = {
    "a digit": lambda piece: piece.replace(b"1,2", b"1,3"),
    "a digit of the facts": lambda piece: piece.replace(b"3}", b"8}"),
    "a line lost": lambda piece: piece.replace(b"4,5\n", b""),
    "a line more": lambda piece: piece + b"4,5\n",
    "cut short": lambda piece: piece[:70],
    "empty": lambda piece: b"",
    "no text": lambda piece: b"\xff" * len(piece),
}


@pytest.mark.parametrize("what", DAMAGES)
def test_a_damaged_checkpoint_does_not_count(what: str, tmp_path: Path) -> None:
    points = Checkpoints.of(tmp_path, "sweep", "1f")
    points.open(rows=3)
    points.save(6, {"good": 3}, b"1,2\n4,5\n")
    points.save(7, {"good": 3}, b"1,2\n4,5\n")
    path = points.place / "0000007"
    path.write_bytes(DAMAGES[what](path.read_bytes()))
    pieces, damaged = points.done()
    assert ([6], 1) == ([*pieces], damaged)


def test_a_checkpoint_that_is_half_written_does_not_count(tmp_path: Path) -> None:
    points = Checkpoints.of(tmp_path, "sweep", "1f")
    points.open()
    (points.place / ".0000003.k3j_x9a1").write_bytes(b'{"good": 3}\n1,')
    assert ({}, 0) == points.done()


def test_another_job_has_another_key() -> None:
    assert key_of({"n": 1}, "a") != key_of({"n": 2}, "a")


def test_a_scheduler_that_does_not_answer_is_a_wrong_call() -> None:
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    with pytest.raises(CallError, match="no Dask scheduler answers"):
        cluster("nonsense address")
