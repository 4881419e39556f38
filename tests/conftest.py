"""How the tests run: the whole suite on all cores, a part of it in this process, ``-m quick`` without loading the rest.

``pytestmark = pytest.mark.quick`` stands in the files that say, room by room, whether the core of it holds.
"""

from __future__ import annotations

import builtins
import gc
import os
import shutil
import signal
import sys
from contextlib import suppress
from pathlib import Path

import pytest

TESTS = Path(__file__).parent

# commands that tests start, and the workers, find their byte code, as installed ones do
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# started in the background by a shell, a run inherits that Ctrl-C is ignored, and so would all that it starts and
# interrupts
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    with suppress(ValueError):  # outside of the main thread nothing can be set
        signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_xdist_auto_num_workers(config: pytest.Config) -> int | None:
    """One more than there are cores: some tests wait for what they started."""
    whole = all(config.invocation_params.dir.joinpath(arg).resolve() in (TESTS, TESTS.parent) for arg in config.args)
    return (os.cpu_count() or 1) + 1 if whole else 0


def pytest_collection_finish() -> None:
    """What is loaded by now stays: the collector of garbage need not go through it again and again."""
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Files without a quick test cost seconds to import."""
    if config.option.markexpr != "quick" or collection_path.suffix != ".py":
        return None
    return "mark.quick" not in collection_path.read_text(encoding="utf-8") or None


@pytest.fixture(scope="session", autouse=True)
def _no_builtin_sum_of_floats():
    """What graphkin writes must not hang on the Python that writes it: from 3.12 on ``sum`` adds floats in another way,
    from 3.14 on complex numbers too (`graphkin.plane.added_up` adds them alike everywhere)."""
    builtin = builtins.sum

    def watched(values, /, start=0):
        caller = sys._getframe(1)
        if caller.f_globals.get("__name__", "").split(".")[0] == "graphkin":
            values = list(values)
            where = f"{caller.f_code.co_filename}:{caller.f_lineno} adds floats by the builtin sum: take added_up"
            assert not any(isinstance(value, float | complex) for value in (start, *values)), where
        return builtin(values, start)

    builtins.sum = watched
    yield
    builtins.sum = builtin


CHROMIUM_FLAGS = [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
]


def _missing(why: str) -> None:
    if os.environ.get("GRAPHKIN_BROWSER") == "required":
        pytest.fail(why)
    pytest.skip(why)


@pytest.fixture(scope="session")
def browser():
    """Debian's Chromium (``CHROMIUM`` names another).  Without it tests skip, unless ``GRAPHKIN_BROWSER=required``."""
    chromium = os.environ.get("CHROMIUM") or shutil.which("chromium")
    if not chromium:
        _missing("Chromium is not installed (Debian: chromium); set CHROMIUM to name another place")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        _missing("playwright is not installed (pip install playwright)")
    with sync_playwright() as play:
        started = play.chromium.launch(executable_path=chromium, args=CHROMIUM_FLAGS)
        yield started
        started.close()
