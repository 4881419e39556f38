"""How soon polygons follow a pulled point, and what the page's server keeps: ``python -m tests.bench.board [SCENE]``.

Each pull goes from the socket's message to the figures in the answer, mechanism and both polygons, and, where Chromium
is, from the pointer's event to the polygons on the screen; then memory over some thousand pulls.  Wanted for the
six-bar: 50 ms in the middle, 100 ms for 95 of 100.
"""

from __future__ import annotations

import math
import shutil
import sys
import tempfile
import time
from pathlib import Path

from graphkin.scene.scene import library_text
from tests.board.served import served, talking
from tests.conftest import CHROMIUM_FLAGS

PULLS = 300
LONG = 3000


def middle_and_95(times: list[float]) -> str:
    ordered = sorted(times)
    return f"{1e3 * ordered[len(ordered) // 2]:6.1f} ms   {1e3 * ordered[int(0.95 * len(ordered))]:6.1f} ms"


def memory(pid: int) -> int:
    """Resident memory of a process, kB (Linux)."""
    status = Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    return int(status.split("VmRSS:")[1].split()[0])


def by_socket(url: str, scene: str, pulls: int) -> list[float]:
    """Seconds from a message to its answer while a point is pulled around."""
    text, found = library_text(scene), []
    with talking(url) as ask:
        now = ask({"do": "show", "text": text})
        point, at = next((p, z) for p, z in now["points"].items() if z["pull"] == "driver")
        far = math.hypot(at["x"], at["y"])
        for i in range(pulls):
            turn = math.radians(3.0 * i)
            pull = {"do": "pull", "text": text, "point": point, "x": far * math.cos(turn), "y": far * math.sin(turn)}
            start = time.perf_counter()
            told = ask({**pull, "quick": True, "final": False, "scales": now["scales"]})
            found.append(time.perf_counter() - start)
            assert told["ok"], told
    return found


def on_screen(url: str, pulls: int) -> list[float]:
    """Seconds from a pointer's event to the velocity polygon that follows it, in Chromium."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=shutil.which("chromium"), args=CHROMIUM_FLAGS)
        page = browser.new_page(viewport={"width": 1400, "height": 1000})
        page.goto(url)
        page.wait_for_selector("[data-point=B]")
        page.wait_for_timeout(1000)
        times = page.evaluate(
            """async pulls => {
              const grip = document.querySelector('[data-point=B]');
              const box = grip.getBoundingClientRect();
              const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
              const area = document.querySelector('.figures');
              area.setPointerCapture = () => {};
              const send = (kind, dx, dy, target) => target.dispatchEvent(new PointerEvent(kind,
                { bubbles: true, clientX: x + dx, clientY: y + dy, pointerId: 1 }));
              send('pointerdown', 0, 0, grip);
              const found = [];
              for (let i = 1; i <= pulls; i++) {
                const shown = () => document.querySelector('[data-figure=velocity] svg');
                const before = shown();
                const start = performance.now();
                send('pointermove', -30 * Math.sin(i / 9), 30 * (1 - Math.cos(i / 9)), area);
                while (shown() === before) await new Promise(requestAnimationFrame);
                found.push((performance.now() - start) / 1000);
              }
              send('pointerup', 0, 0, area);
              return found;
            }""",
            pulls,
        )
        browser.close()
    return times


def main(scene: str) -> None:
    """Print the times of one scene."""
    with tempfile.TemporaryDirectory() as folder, served(scene, cwd=Path(folder)) as (url, process):
        print(f"{scene}: middle and 95 of 100")
        print(f"  message to answer   {middle_and_95(by_socket(url, scene, PULLS))}")
        if shutil.which("chromium"):
            print(f"  pointer to polygons {middle_and_95(on_screen(url, PULLS // 3))}")
        before = memory(process.pid)
        by_socket(url, scene, LONG)
        print(f"  memory of the server over {LONG} pulls: {before} kB, then {memory(process.pid)} kB")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "sixbar-420rpm")
