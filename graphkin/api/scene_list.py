"""``graphkin scenes``: the bundled scenes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from graphkin.api.results import Result, named
from graphkin.files import Json
from graphkin.scene.scene import Scene, library, library_text, mechanism_of, read
from graphkin.structure import analyse
from graphkin.table import Table
from graphkin.words import Phrase


@dataclass(frozen=True, repr=False, eq=False)
class Listed(Result):
    """The bundled scenes: name, title, Chinese title, mobility; ``listed[...]`` is a scene by its name."""

    rows: tuple[tuple[str, str, str, int], ...]

    name = "scenes"

    @property
    def ok(self) -> bool:
        return bool(self.rows)

    @property
    def data(self) -> list[dict[str, Json]]:
        """The list that ``graphkin scenes --json`` prints."""
        return [{"name": n, "title": t, "title_zh": z, "mobility": f} for n, t, z, f in self.rows]

    def __getitem__(self, name: str) -> Scene:
        names = {row[0]: row[0] for row in self.rows}
        return read(named(names, name, Phrase("no scene of this name comes along")))

    def __iter__(self) -> Iterator[str]:
        """Their names."""
        return (row[0] for row in self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    @property
    def table(self) -> Table:
        """A row for each scene."""
        return Table.of(("scene", "title", "title_zh", "mobility"), self.rows)

    @property
    def files(self) -> Mapping[str, bytes]:
        """The file of each scene."""
        return {f"{row[0]}.toml": library_text(row[0]).encode() for row in self.rows}

    def __repr__(self) -> str:
        return f"<Listed: {len(self.rows)} scenes>"


def scenes() -> Listed:
    """List the bundled scenes, with title and mobility.

    >>> scenes()["sixbar-guide-40deg"].driver.omega
    -10.0
    """
    rows = []
    for name in library():
        scene = mechanism_of(name)
        rows.append((name, scene.question.title, scene.question.title_zh, analyse(scene).mobility.value))
    return Listed(tuple(rows))
