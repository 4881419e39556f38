"""``graphkin scenes``: what comes along."""

from __future__ import annotations

import html
from dataclasses import dataclass
from typing import Any

from graphkin.scene import library, read
from graphkin.structure import analyse

__all__ = ["Listed", "scenes"]


@dataclass(frozen=True)
class Listed:
    """The scenes that come along: name, title, Chinese title, mobility."""

    rows: tuple[tuple[str, str, str, int], ...]

    @property
    def data(self) -> list[dict[str, Any]]:
        return [{"name": n, "title": t, "title_zh": z, "mobility": f} for n, t, z, f in self.rows]

    def _repr_html_(self) -> str:
        rows = "".join(
            "<tr>" + "".join(f"<td>{html.escape(str(cell))}</td>" for cell in row) + "</tr>" for row in self.rows
        )
        return f"<table><tr><th>scene</th><th>title</th><th></th><th>mobility</th></tr>{rows}</table>"


def scenes() -> Listed:
    """List the scenes that come along, with title and mobility.

    >>> "sixbar-guide-40deg" in [row["name"] for row in scenes().data]
    True
    """
    rows = []
    for name in library():
        scene = read(name)
        rows.append((name, scene.title, scene.title_zh, analyse(scene).mobility.value))
    return Listed(tuple(rows))
