from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from concurrent.futures import BrokenExecutor
from pathlib import Path

import pytest

from graphkin.study.processes import RenewedPool

PROGRAM = """
import os, time
from graphkin.study.processes import process_pool
if __name__ == "__main__":
    with process_pool(1) as pool:
        print(pool.submit(os.getpid).result(), flush=True)
        time.sleep(60)
"""


def _runs(pid: int) -> bool:
    stat = Path(f"/proc/{pid}/stat")
    if stat.parent.parent.joinpath("self").exists():
        return stat.exists() and stat.read_text().rsplit(")", 1)[1].split()[0] != "Z"
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_the_processes_of_a_pool_end_with_the_one_that_was_killed(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    with subprocess.Popen([sys.executable, program], stdout=subprocess.PIPE, text=True) as parent:
        worker = int(parent.stdout.readline())
        assert _runs(worker)
        parent.send_signal(signal.SIGKILL)
    deadline = time.monotonic() + 20
    while _runs(worker) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not _runs(worker)


def test_a_renewed_pool_takes_fresh_processes_and_loses_no_task():
    with RenewedPool(1, tasks=2) as pool:
        pids = [task.result() for task in [pool.submit(os.getpid) for _ in range(5)]]
    assert (5, 3) == (len(pids), len(set(pids)))


def test_a_pool_whose_process_was_killed_is_replaced():
    with RenewedPool(1) as pool:
        lost = pool.submit(os._exit, 1)
        assert isinstance(lost.exception(timeout=30), BrokenExecutor)
        assert pool.submit(os.getpid).result(timeout=30)
