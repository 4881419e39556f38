"""Scenes that the reader's tests start from, and the way they change them."""

from __future__ import annotations

FOUR_BAR = """\
title = "Four-bar"
[frame]
name = "4"
points = { A = [0, 0], D = [400, 0] }
guides = { g = { through = [0, 50], angle = 30 } }
[links.1]
points = ["A", "B"]
length = 150
[links.2]
points = ["B", "C"]
length = 500
at = { E = [100, 50] }
guides = { s = { through = "E", angle = 90 } }
[links.3]
points = ["C", "D"]
length = 300
[driver]
link = "1"
angle = 60
omega = 10
"""

SIX_BAR = """\
title    = "Six-bar with an oscillating guide bar"
[frame]
name   = "6"
points = { A = [0, 280], C = [0, 0] }
guides = { h = { through = [0, -164], angle = 0 } }
[links.1]
points = ["A", "B"]
length = 122
[links.2]
points = ["B"]
on     = "3"
[links.3]
points = ["C"]
[links.4]
points = ["D"]
on     = "3"
[links.5]
points = ["D"]
on     = "6.h"
[driver]
link  = "1"
angle = 50
omega = -10
"""


def changed(text: str, *changes: tuple[str, str]) -> str:
    """The text with each first string, which must be there, replaced by the second."""
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text
