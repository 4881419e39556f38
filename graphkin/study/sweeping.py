"""A sweep run to its end: chunks through any executor, kept as they are done, merged into tables."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import suppress
from pathlib import Path
from typing import Any

from graphkin.errors import CallError, Problem
from graphkin.study.chunks import Done, Plan, work
from graphkin.study.kept import Kept, Swept
from graphkin.study.processes import process_pool

__all__ = ["Progress", "have_parquet", "run", "scheduler"]

Progress = Callable[[int, int], None]
AHEAD = 4
"""Chunks handed out beyond those being worked on, so that memory stays bounded and no worker waits."""
MOST_LOSSES = 5
"""Times that a chunk is given out again after its worker was lost."""


def have_parquet() -> bool:
    """Whether pyarrow is installed."""
    from importlib.util import find_spec

    return find_spec("pyarrow") is not None


def scheduler(address: str) -> Executor:
    """An executor that runs on the Dask cluster at an address.

    Raises
    ------
    CallError : the extra ``cluster`` is not installed, or no scheduler answers
    """
    try:
        from distributed import Client
    except ImportError:
        raise CallError(
            Problem("--scheduler", "Dask is not installed", 'install it with pip install "graphkin[cluster]"')
        ) from None
    try:
        client = Client(address, timeout="10s", set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise CallError(
            Problem(f"--scheduler {address}", f"no Dask scheduler answers: {error}", "give tcp://HOST:8786")
        ) from None
    return _Cluster(client)


class _Cluster(Executor):
    """A Dask cluster as an executor; to shut it down is to leave it."""

    def __init__(self, client: Any) -> None:
        self._client = client
        # a task is computed anew where the worker that held its result is lost
        self._inner: Executor = client.get_executor(pure=False, retries=MOST_LOSSES)

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        return self._inner.submit(fn, *args, **kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        self._inner.shutdown(wait)
        self._client.close()


def run(
    plan: Plan,
    folder: Path,
    executor: Executor | None = None,
    workers: int | None = None,
    parquet: bool = False,
    progress: Progress | None = None,
) -> Swept:
    """Compute what is missing of a sweep and write its tables into a folder; they appear whole or not at all.

    Parameters
    ----------
    executor : anything that follows ``concurrent.futures.Executor``; it stays open.  Where it breaks, what is left is
        computed here.
    workers : without an executor, the number of processes of one's own; none for 1 or None
    progress : called with the rows that are done and all rows

    Raises
    ------
    CallError : the folder cannot be written
    """
    # what is wrong with the scene itself is said before anything is written
    _ = plan.heads
    try:
        folder.mkdir(parents=True, exist_ok=True)
        kept = Kept(folder / f".sweep-{plan.key}", plan, parquet)
        kept.open()
        done = plan.chunks - len(kept.missing())

        def count() -> None:
            if progress is not None:
                progress(min(plan.rows, round(plan.rows * done / plan.chunks)), plan.rows)

        count()
        for chunk, result in _results(plan, kept.missing(), executor, workers, parquet):
            kept.keep(chunk, result)
            done += 1
            count()
        return kept.merge(folder)
    except OSError as error:
        raise CallError(
            Problem(str(folder), f"cannot be written: {error.strerror or error}", "give another folder with -o")
        ) from None


def _results(
    plan: Plan, missing: list[int], executor: Executor | None, workers: int | None, binary: bool
) -> Iterator[tuple[int, Done]]:
    """Each missing chunk with what it gives, in the order in which they are done."""
    if executor is None and (workers or 1) > 1 and len(missing) > 1:
        yield from _own_pool(plan, missing, workers or 1, binary)
        return
    left = list(missing)
    if executor is not None:
        for chunk, done in _through(plan, left, executor, binary):
            left.remove(chunk)
            yield chunk, done
    for chunk in left:
        yield chunk, work(plan.task(chunk, binary))


def _own_pool(plan: Plan, missing: list[int], workers: int, binary: bool) -> Iterator[tuple[int, Done]]:
    """Processes of one's own; a pool that breaks because a worker was killed is replaced."""
    left = list(missing)
    losses = 0
    while left:
        before = len(left)
        with process_pool(min(workers, len(left))) as pool:
            for chunk, done in _through(plan, list(left), pool, binary):
                left.remove(chunk)
                yield chunk, done
        losses = losses + 1 if len(left) == before else 0
        if losses > MOST_LOSSES:
            raise CallError(Problem("the workers", "are lost again and again", "run with --workers 1"))


def _through(plan: Plan, chunks: Sequence[int], executor: Executor, binary: bool) -> Iterator[tuple[int, Done]]:
    """Results of an executor as they come; ends early where the executor is broken."""
    waiting: dict[Future[Done], int] = {}
    lost: dict[int, int] = {}
    ahead = AHEAD * max(2, _width(executor))
    queue = list(reversed(chunks))
    try:
        while queue or waiting:
            while queue and len(waiting) < ahead:
                chunk = queue.pop()
                waiting[executor.submit(work, plan.task(chunk, binary))] = chunk
            finished, _ = wait(waiting, return_when=FIRST_COMPLETED)
            for future in finished:
                chunk = waiting.pop(future)
                error = future.exception()
                if error is None:
                    yield chunk, future.result()
                elif isinstance(error, BrokenExecutor):
                    return
                elif type(error).__name__ in ("KilledWorker", "CancelledError", "CommClosedError"):
                    # the cluster gave the chunk up because workers died under it: ask again
                    lost[chunk] = lost.get(chunk, 0) + 1
                    if lost[chunk] > MOST_LOSSES:
                        raise error
                    queue.append(chunk)
                else:
                    raise error
    except BrokenExecutor:
        return
    finally:
        for future in waiting:
            future.cancel()


def _width(executor: Executor) -> int:
    """How many workers an executor has, as far as it tells."""
    width = getattr(executor, "_max_workers", None)
    if isinstance(width, int):
        return width
    client: Any = getattr(executor, "_client", None)
    with suppress(Exception):
        return int(sum(client.nthreads().values()))
    return 2
