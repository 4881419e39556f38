"""Processes to share work among, which end with the program that started them."""

from __future__ import annotations

import multiprocessing
import os
import threading
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor
from multiprocessing.connection import wait
from typing import Any

__all__ = ["RenewedPool", "process_pool"]


def process_pool(workers: int) -> ProcessPoolExecutor:
    """A pool of so many fresh processes, not copies of this one: safe beside threads, the same on every system.

    They end by themselves when the one that started them is killed.
    """
    return ProcessPoolExecutor(workers, multiprocessing.get_context("spawn"), _end_with_parent)


class RenewedPool(Executor):
    """A process pool that is replaced by a fresh one after so many tasks, so that what libraries keep of each task
    (Typst its words, for one) does not add up."""

    def __init__(self, workers: int, tasks: int = 600) -> None:
        self.workers, self.tasks = workers, tasks
        self.pool, self.given = process_pool(workers), 0

    def submit(self, task: Callable[..., Any], /, *args: Any, **named: Any) -> Future[Any]:
        """Start a task in the present pool; the one before ends by itself when its tasks are done."""
        if self.given == self.tasks:
            self._renew()
        self.given += 1
        try:
            return self.pool.submit(task, *args, **named)
        except BrokenExecutor:  # one of its processes was killed
            self._renew()
            return self.pool.submit(task, *args, **named)

    def _renew(self) -> None:
        self.pool.shutdown(wait=False)
        self.pool, self.given = process_pool(self.workers), 0

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the present pool."""
        self.pool.shutdown(wait, cancel_futures=cancel_futures)


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_watch, args=(parent.sentinel,), daemon=True).start()


def _watch(sentinel: int) -> None:
    # a pool waits for work for ever: its queue stays open while a sister process lives
    wait([sentinel])
    os._exit(1)
