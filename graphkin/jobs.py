"""Long work in pieces: on processes, on a cluster, on any executor; interrupted at any moment, it goes on from there.

`Workers` do the pieces, `Checkpoints` hold the finished ones.  A piece depends on its input alone, so that its result
is the same on every machine, and it is done again if its worker was lost.  A checkpoint is a file that appears whole or
not at all: a process may be killed between any two instructions, and only the pieces under work are lost; nothing is
doubled or half written.
"""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import os
import shutil
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing import resource_tracker
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from types import TracebackType
from typing import IO, TYPE_CHECKING, Any, ParamSpec, TypeVar

from graphkin.errors import CallError, Problem
from graphkin.files import Json, Tables, whole_file
from graphkin.version import __version__
from graphkin.words import Phrase, from_others

if TYPE_CHECKING:
    from distributed import Client

Progress = Callable[[int, int], None]
"""Called with how much is done, and with all there is to do."""
Result = TypeVar("Result")
P = ParamSpec("P")

AHEAD = 4
"""Pieces given out for each worker, so that memory stays bounded and none waits."""
MOST_LOSSES = 5
"""Times that a piece is given out again after its worker was lost."""
LOST = Problem(Phrase("the workers"), Phrase("are lost again and again"), Phrase("run with workers 1"))
RENEWED = 600
"""Pieces after which processes of one's own are replaced by fresh ones, so that what libraries keep of each (Typst its
words, for one) does not add up."""


# what is done


def key_of(*parts: object) -> str:
    """A key that two jobs share only if their parts are the same (as JSON, or else by ``repr``), and the program."""
    key = hashlib.sha256(repr(__version__).encode())
    for part in parts:
        key.update(json.dumps(part, sort_keys=True, default=repr).encode() + b"\n")
    return key.hexdigest()[:24]


@dataclass(frozen=True)
class FinishedPiece:
    """A finished piece of work: facts about it, and where its content begins in its file."""

    facts: Tables
    path: Path
    begin: int

    def copy(self, out: IO[bytes]) -> None:
        """Write the content to an open file."""
        with open(self.path, "rb") as stream:
            stream.seek(self.begin)
            shutil.copyfileobj(stream, out, 1 << 20)


@dataclass(frozen=True)
class Checkpoints:
    """The finished pieces of one job, each a file in a hidden folder: a line with the digest (SHA-256) of the rest, a
    line of facts (JSON), then any content.

    The folder's name holds a key of the job, so that pieces of other jobs are never used; a piece with a wrong digest
    counts as missing.
    """

    place: Path

    @classmethod
    def of(cls, folder: Path, kind: str, key: str) -> Checkpoints:
        """The checkpoints of a job in a folder."""
        return cls(folder / f".{kind}-{key}")

    def open(self, **facts: object) -> None:
        """Make the folder, with a file that explains its content."""
        self.place.mkdir(parents=True, exist_ok=True)
        about = self.place / "about.json"
        if not about.exists():
            words = {"what": "finished pieces of a graphkin job; the same command goes on from here", **facts}
            with whole_file(about) as out:
                out.write(json.dumps(words, indent=1, ensure_ascii=False).encode())

    def done(self) -> tuple[dict[int, FinishedPiece], int]:
        """The finished pieces by their numbers, and how many were damaged since they were written."""
        names = [path.name for path in self.place.iterdir()] if self.place.is_dir() else []
        numbers = sorted(int(name) for name in names if name.isdecimal())
        pieces = {number: piece for number in numbers if (piece := self.load(number)) is not None}
        return pieces, len(numbers) - len(pieces)

    def save(self, number: int, facts: Mapping[str, Json], content: bytes = b"") -> None:
        """Keep a finished piece."""
        line = json.dumps(facts, ensure_ascii=False).encode() + b"\n"
        with whole_file(self.place / f"{number:07d}") as out:
            out.write(hashlib.sha256(line + content).hexdigest().encode() + b"\n")
            out.write(line)
            out.write(content)

    def load(self, number: int) -> FinishedPiece | None:
        """A finished piece; None where it is missing or damaged."""
        path = self.place / f"{number:07d}"
        if not path.is_file():
            return None
        with open(path, "rb") as stream:
            head, line = stream.readline(), stream.readline()
            digest = hashlib.sha256(line)
            while block := stream.read(1 << 20):
                digest.update(block)
        if head != digest.hexdigest().encode() + b"\n":
            return None
        return FinishedPiece(json.loads(line), path, len(head) + len(line))

    def close(self) -> None:
        """Remove them: the job is done."""
        shutil.rmtree(self.place, ignore_errors=True)


# who does it


class Workers:
    """The workers of a job: a given executor (it stays open), a number of own processes, or this process alone.

    Used in a ``with`` statement.  An exception (above all an interruption) ends it at once: waiting pieces are
    cancelled, and own processes are ended.
    """

    def __init__(self, executor: Executor | None = None, processes: int | None = None, renewed: int = RENEWED) -> None:
        self._given = executor
        alone = executor is not None or multiprocessing.current_process().daemon  # who may have no children
        self._processes = processes if not alone and (processes or 1) > 1 else None
        self._renewed = renewed
        self._pool: ProcessPoolExecutor | None = None
        self._count = 0
        self._old: list[BaseProcess] = []
        self._waiting: set[Future[Any]] = set()

    @property
    def ahead(self) -> int:
        """The number of pieces given out beyond the awaited one: a few for each worker; none in this process alone."""
        width = self._processes if self._given is None else _width(self._given)
        return 0 if width is None else AHEAD * max(2, width)

    def start(self, task: Callable[..., Result], *given: object) -> Callable[[], Result]:
        """Give out a piece; the returned function waits for its result.

        A piece whose worker was lost is given out again.  Without an executor, or where it is broken or could not do
        the piece, the piece is done here, which raises its error.
        """
        future = self._submit(task, given)

        def result() -> Result:
            nonlocal future
            for _ in range(MOST_LOSSES):
                if future is None:
                    break
                try:
                    return future.result()
                except (BrokenExecutor, CancelledError):
                    pass
                except Exception as error:
                    if type(error).__name__ not in ("KilledWorker", "CommClosedError", "FutureCancelledError"):
                        future = None
                        break
                future = self._submit(task, given)
            if future is not None and self._processes is not None:
                raise CallError(LOST)
            return task(*given)

        return result

    def results(self, task: Callable[..., Result], pieces: Iterable[tuple[object, ...]]) -> Iterator[Result]:
        """The results of the pieces in their order; a few pieces are always given out ahead."""
        queue: deque[Callable[[], Result]] = deque()
        for given in pieces:
            queue.append(self.start(task, *given))
            if len(queue) > self.ahead:
                yield queue.popleft()()
        while queue:
            yield queue.popleft()()

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        pool, old, self._pool, self._old = self._pool, self._old, None, []
        if pool is None:
            for future in list(self._waiting):
                future.cancel()
        elif kind is None:
            pool.shutdown(wait=True, cancel_futures=True)
        else:
            _end(pool, old)

    def _submit(self, task: Callable[..., Result], given: tuple[object, ...]) -> Future[Result] | None:
        """The future of a piece; None where no executor takes it."""
        future: Future[Result] | None = None
        if self._given is not None:
            with suppress(Exception):
                future = self._given.submit(task, *given)
        elif self._processes is not None:
            future = self._to_pool(task, given)
        if future is not None:
            self._waiting.add(future)
            future.add_done_callback(self._waiting.discard)
        return future

    def _to_pool(self, task: Callable[..., Result], given: tuple[object, ...]) -> Future[Result]:
        for _ in range(MOST_LOSSES):
            if self._pool is None or self._count >= self._renewed:
                if self._pool is not None:
                    # it ends by itself when its pieces are done
                    self._old = [p for p in (*self._old, *_processes(self._pool)) if p.is_alive()]
                    self._pool.shutdown(wait=False)
                self._pool, self._count = process_pool(self._processes or 1), 0
            self._count += 1
            try:
                with _uninterrupted():
                    return self._pool.submit(task, *given)
            except BrokenExecutor:  # one of its processes was killed
                self._count = self._renewed
        raise CallError(LOST)


def process_pool(processes: int) -> ProcessPoolExecutor:
    """A pool of fresh processes, not copies of this one: safe with threads, the same on every system.

    They end by themselves when their parent is killed; only the parent answers an interruption.
    """
    before = os.environ.get("PYTHONWARNINGS")
    # what is killed leaves semaphores behind: they are cleared away by a process that need not tell the user of it
    os.environ["PYTHONWARNINGS"] = ",".join(filter(None, (before, "ignore:resource_tracker")))
    try:
        resource_tracker.ensure_running()
    finally:
        if before is None:
            del os.environ["PYTHONWARNINGS"]
        else:
            os.environ["PYTHONWARNINGS"] = before
    return ProcessPoolExecutor(processes, multiprocessing.get_context("spawn"), _end_with_parent)


def _end(pool: ProcessPoolExecutor, others: Iterable[BaseProcess]) -> None:
    """End a pool at once, and processes of earlier pools, whatever they are doing."""
    running = _processes(pool)
    with suppress(AttributeError, OSError):
        # a result that is half written would be waited for while anybody can write, and this process could
        pool._result_queue._writer.close()  # type: ignore[attr-defined]
    for process in (*others, *running):
        process.kill()
    pool.shutdown(wait=False, cancel_futures=True)


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """A context in which started processes ignore interruptions; this process gets them at its end."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _processes(pool: ProcessPoolExecutor) -> list[BaseProcess]:
    """The processes of a pool; it forgets them when it is shut down."""
    return list((getattr(pool, "_processes", None) or {}).values())


def _end_with_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_watch, args=(parent.sentinel,), daemon=True).start()


def _watch(sentinel: int) -> None:
    # a pool waits for work for ever: its queue stays open while a sister process lives
    wait([sentinel])
    os._exit(1)


def _width(executor: Executor) -> int:
    width = getattr(executor, "_max_workers", None)
    if isinstance(width, int):
        return width
    with suppress(Exception):  # of Dask
        return int(sum(executor._client.nthreads().values()))  # type: ignore[attr-defined]
    return 2


def cluster(address: str) -> Executor:
    """An executor on the Dask cluster at an address; shutting it down leaves the cluster running.

    Raises
    ------
    CallError : the extra ``cluster`` is not installed, or no scheduler answers
    """
    try:
        from distributed import Client
    except ImportError:
        raise CallError.of("--scheduler", "dask is not installed",
                           "install it with pip install graphkin cluster") from None
    try:
        client = Client(address, timeout="10s", set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise CallError.of(f"--scheduler {address}", "no dask scheduler answers", "give tcp host 8786",
                           error=from_others(error)) from None
    return _Cluster(client)


class _Cluster(Executor):
    def __init__(self, client: Client) -> None:
        self._client = client
        # a piece is done anew where the worker that held its result is lost
        self._inner: Executor = client.get_executor(pure=False, retries=MOST_LOSSES)

    def submit(self, fn: Callable[P, Result], /, *args: P.args, **kwargs: P.kwargs) -> Future[Result]:
        return self._inner.submit(fn, *args, **kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        self._inner.shutdown(wait)
        self._client.close()
