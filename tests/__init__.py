"""The tests.  With GRAPHKIN_ALL_POSITIONS in the environment they look at far more of the same, for minutes."""

import os
import re

from graphkin.scene import library, library_text

EVERYTHING = bool(os.environ.get("GRAPHKIN_ALL_POSITIONS"))


def with_tables(*names: str) -> list[str]:
    """The scenes that come along and have one of these tables, found without reading them as mechanisms."""
    wanted = re.compile(rf"(?m)^\[\[?({'|'.join(names)})\b")
    return [name for name in library() if wanted.search(library_text(name))]
